# The checks that need more than cc and make: verification, proofs, other platforms, mutation, fuzzing.
