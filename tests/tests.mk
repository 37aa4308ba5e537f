# The tests of `make test`: the suite twice, with the scalar code and with the best instruction set of CFLAGS.
# A program's last line is "name: N passed, N failed", N counting test functions; the sum of these lines ends
# the run.
# One file alone: make build/tests/default/test_grid, then run it. One test: build/tests/default/suite NAME, part of
# its name.
# TEST_FLAGS=-DTEST_SCALE=10 asks a tenth of the random questions (emulators, sanitizers).

include tests/list.mk
TEST_COMPILES := c99 include_twice two_units hostile_macros hostile_goto hostile_7
TEST_HEADERS  := tribox.h tests/test.h tests/oracle.h tests/question.h tests/voxels.h tests/solid_truth.h
TEST_UNITS    := tests/compile/two_units_a.c tests/compile/two_units_b.c
TEST_SOURCES  := $(wildcard tests/test_*.c)
TEST_LISTED   := $(patsubst %,tests/test_%.c,$(TEST_SUITE) $(TEST_TWICE) $(TEST_ALONE) $(TEST_RULED))
ifneq ($(sort $(TEST_SOURCES)),$(sort $(TEST_LISTED)))
$(error tests/list.mk and tests/ differ: $(filter-out $(TEST_LISTED),$(TEST_SOURCES)) $(filter-out $(TEST_SOURCES),$(TEST_LISTED)))
endif

TEST_PROGRAMS := $(B)/tests/scalar/suite $(B)/tests/default/suite \
                 $(TEST_TWICE:%=$(B)/tests/scalar/test_%) $(TEST_TWICE:%=$(B)/tests/default/test_%) \
                 $(TEST_ALONE:%=$(B)/tests/default/test_%) \
                 $(B)/tests/test_oracle $(B)/tests/test_simd $(TEST_COMPILES:%=$(B)/tests/compile/%)
TEST_LOGS     := $(TEST_PROGRAMS:%=%.log)

# Two jobs unless make was told how many.
TEST_JOBS     = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j2)

.PHONY: build-tests test

build-tests: $(TEST_PROGRAMS) ## build the tests

$(B)/tests/test_oracle: tests/test_oracle.c $(TEST_HEADERS)
	@mkdir -p $(@D)
	$(CC_C99) $(TEST_FLAGS) $< -o $@

$(B)/tests/suite.c: tests/list.mk tests/make_suite.sh
	@mkdir -p $(@D)
	@sh tests/make_suite.sh suite $(TEST_SUITE) > $@

.PRECIOUS: $(B)/tests/test_%.c
$(B)/tests/test_%.c: tests/test_%.c tests/make_suite.sh
	@mkdir -p $(@D)
	@sh tests/make_suite.sh test_$* $* > $@

$(B)/tests/scalar/%: $(B)/tests/%.c $(TEST_HEADERS) $(TEST_SOURCES)
	@mkdir -p $(@D)
	$(CC_C99) -Itests $(TEST_FLAGS) -DTRIBOX_SIMD=0 $< -o $@ -lm

$(B)/tests/default/%: $(B)/tests/%.c $(TEST_HEADERS) $(TEST_SOURCES)
	@mkdir -p $(@D)
	$(CC_C99) -Itests $(TEST_FLAGS) $< -o $@ -lm

# The same file as two units, one scalar, one with the best instruction set.
$(B)/tests/test_simd: tests/test_simd.c $(TEST_HEADERS)
	@mkdir -p $(@D)
	$(CC_C99) $(TEST_FLAGS) -DTRIBOX_SIMD=0 -DSIMD_UNIT=simd_scalar_answers -c $< -o $@_scalar.o
	$(CC_C99) $(TEST_FLAGS) -DSIMD_UNIT=simd_best_answers -DSIMD_MAIN $< $@_scalar.o -o $@

$(B)/tests/compile/two_units: $(TEST_UNITS) tests/compile/every_function.h tribox.h
	@mkdir -p $(@D)
	$(CC_C99) $(TEST_UNITS) -o $@

$(patsubst %,$(B)/tests/compile/hostile_%,macros goto 7): $(B)/tests/compile/hostile_%: tests/compile/hostile_macros.c tests/compile/every_function.h tribox.h
	@mkdir -p $(@D)
	$(CC_C99) -DHOSTILE=$(filter-out macros,$*) $< -o $@

$(B)/tests/compile/%: tests/compile/%.c tests/compile/every_function.h tribox.h
	@mkdir -p $(@D)
	$(CC_C99) $< -o $@

# A program that dies leaves a log without its last line, which counts as a failure.
$(B)/tests/%.log: $(B)/tests/%
	@$< > $@ 2>&1 || true

# README.md: its version, licence and programs.
TEST_LOGS += $(B)/tests/docs.log
$(B)/tests/docs.log: tests/test_docs.sh README.md LICENSE tribox.h
	@mkdir -p $(@D)
	@CC='$(CC)' CXX='$(CXX)' CFLAGS='$(CFLAGS)' sh $< $(B)/tests/readme > $@ 2>&1 || true

test: ## run the tests: scalar, then best instruction set
	@rm -f $(TEST_LOGS)
	@$(MAKE) --no-print-directory $(TEST_JOBS) $(TEST_LOGS)
	@passed=0; failed=0; \
	for log in $(TEST_LOGS); do \
	    sed '$$d' $$log; \
	    set -- $$(tail -n 1 $$log); \
	    if [ "$$3 $$5" = "passed, failed" ]; then \
	        passed=$$((passed + $$2)); failed=$$((failed + $$4)); \
	        name=$${log#$(B)/tests/}; echo "$${name%.log}: $$2 passed, $$4 failed"; \
	    else \
	        tail -n 1 $$log; failed=$$((failed + 1)); echo "FAILED $${log%.log}: ended before its last line"; \
	    fi; \
	done; \
	echo "$$passed passed, $$failed failed"; \
	[ $$failed -eq 0 ]
