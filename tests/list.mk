# Every tests/test_*.c stands here once; a file that does not fails the build. tests/README.md says what each proves.

# one program, so that the header and the oracle are compiled once, which is most of the time a test takes to build
TEST_SUITE := overlap tri rule thin sat exact symmetry nan mode field grid fill few frame closed solid issues limits
# programs of their own, scalar and with vectors
TEST_TWICE := contact
# programs of their own that know scalar and vectors themselves, or take long
TEST_ALONE := companions_motion companions_cut companions_mode companions_f64
# programs with their own rules in tests.mk
TEST_RULED := oracle simd
