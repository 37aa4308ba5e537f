# The checks that need more than cc and make: verification, proofs, other platforms, mutation, fuzzing.

VERIFY_THOUSANDS ?= 1000
VERIFY_SEED      ?= 1
VERIFY_JOBS      ?= 2

.PHONY: verify

$(B)/verify: tests/verify.c tests/verify_cases.h tests/verify_exact.h tribox.h
	@mkdir -p $(B)
	$(CC_C99) -o $@ tests/verify.c -lgmp

verify: $(B)/verify ## every answer against GMP, by two methods, on millions of hard cases
	$(B)/verify $(VERIFY_THOUSANDS) $(VERIFY_SEED) $(VERIFY_JOBS)
