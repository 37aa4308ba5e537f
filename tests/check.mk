# The checks that need more than cc and make: verification, golden answers, other platforms, fuzzing,
# mutation, proofs, coverage, CUDA. A missing tool is named by a SKIP line.

VERIFY_THOUSANDS ?= 6000
VERIFY_SEED      ?= 1
VERIFY_JOBS      ?= 2
FUZZ_SECONDS     ?= 60
PLATFORMS_ONLY   ?= .
MUTANT_MESHES    ?= 10000
MUTATE_EVERY     ?= 1
FUZZ_TARGETS     := overlap tri grid mesh volume companions
FUZZ_FLAGS       := -std=c99 -I. -O1 -g -fno-sanitize-recover=all \
                    -fsanitize=fuzzer,address,undefined,float-divide-by-zero,float-cast-overflow
CHECK_PARTS      := test examples demo mpi verify golden-check platforms headers sanitize mesh-mutants proofs errors mutate cuda fuzz coverage

.PHONY: check verify golden golden-check platforms platforms-all headers sanitize mesh-mutants proofs errors mutate cuda fuzz coverage

check: ## all checks below, one after the other, and their sum
	@bash tests/check.sh $(CHECK_PARTS)

$(B)/verify: tests/verify.c $(wildcard tests/verify_*.h tests/companions*.h tests/contact_*.h) tribox.h
	@mkdir -p $(B)
	$(CC_C99) -o $@ tests/verify.c -lgmp

verify: $(B)/verify ## every answer against GMP, by two methods, on millions of hard cases
	$(B)/verify $(VERIFY_THOUSANDS) $(VERIFY_SEED) $(VERIFY_JOBS)

$(B)/gen_golden: tests/gen_golden.c tests/golden_cases.h tests/verify_exact.h tests/verify_solid.h tests/contact_exact.h $(wildcard tests/companions*.h)
	@mkdir -p $(B)
	$(CC_C99) -o $@ tests/gen_golden.c -lgmp

golden: $(B)/gen_golden ## write tests/golden_overlap.h anew, with answers from GMP
	$(B)/gen_golden > $(B)/golden_overlap.h
	mv $(B)/golden_overlap.h tests/golden_overlap.h

golden-check: $(B)/gen_golden ## the committed golden answers are those of GMP
	$(B)/gen_golden | cmp - tests/golden_overlap.h
	@echo '1 passed, 0 failed'

platforms: ## one hash of all answers: compilers, flags, modes, emulated machines, Windows, WebAssembly; traps
	@bash tests/check_platforms.sh '$(PLATFORMS_ONLY)'

platforms-all: ## the same, with more builds of each kind
	@PLATFORMS=all bash tests/check_platforms.sh

headers: ## warnings, includes, macros, symbols, stack, static analysis
	@bash tests/check_header.sh

sanitize: ## the suite under the address, undefined-behaviour and memory sanitizers
	@bash tests/check_sanitize.sh

$(B)/mutated_meshes: tests/mutated_meshes.c tests/test.h $(wildcard examples/*.h) tribox.h
	@mkdir -p $(B)
	clang -std=c99 -I. -O1 -g -DTRIBOX_SIMD=0 -fno-sanitize-recover=all \
	    -fsanitize=address,undefined,float-divide-by-zero,float-cast-overflow -o $@ $< -lm

mesh-mutants: $(B)/mutated_meshes ## the mesh readers under the sanitizers, on MUTANT_MESHES damaged files
	@mkdir -p $(B)/mutants
	@ASAN_OPTIONS=max_allocation_size_mb=64 timeout 900 $(B)/mutated_meshes $(MUTANT_MESHES) $(B)/mutants

proofs: ## the filter's error constants, proved by Gappa
	@bash tests/check_proofs.sh

# The header with its bounds, and what they are told in, still defined at its end.
$(B)/tribox_errors.h: tribox.h
	@mkdir -p $(B)
	sed -E '/^#undef TBX_([A-Z_]*ERROR4?|U32|U64|MARGIN|PIECES)$$/d' tribox.h > $@

$(B)/errors: tests/errors.c $(B)/tribox_errors.h
	$(CC_C99) -I$(B) -frounding-math -o $@ tests/errors.c -lgmp -lm

$(B)/errors_contact: tests/errors_contact.c $(B)/tribox_errors.h
	$(CC_C99) -I$(B) -frounding-math -o $@ tests/errors_contact.c -lgmp -lm

errors: $(B)/errors $(B)/errors_contact ## the filters' worst errors that hill climbing finds, as parts of their bounds
	$(B)/errors
	$(B)/errors_contact

mutate: ## break the header in many ways: the tests must notice each
	@MUTATE_EVERY=$(MUTATE_EVERY) bash tests/mutate.sh

cuda: ## device code for several architectures; run where there is a GPU
	@bash tests/check_cuda.sh

fuzz: $(FUZZ_TARGETS:%=$(B)/fuzz_%) ## fuzz each target for FUZZ_SECONDS, against the exact judge
	@mkdir -p $(FUZZ_TARGETS:%=$(B)/corpus_%)
	@for target in $(FUZZ_TARGETS); do \
	    echo "fuzz_$$target, $(FUZZ_SECONDS) s"; \
	    $(B)/fuzz_$$target -max_total_time=$(FUZZ_SECONDS) -max_len=512 -print_final_stats=1 \
	        -artifact_prefix=$(B)/crash_$${target}_ $(B)/corpus_$$target > $(B)/fuzz_$$target.log 2>&1 || \
	        { tail -n 40 $(B)/fuzz_$$target.log; exit 1; }; \
	    grep number_of_executed_units $(B)/fuzz_$$target.log; \
	done
	@echo '$(words $(FUZZ_TARGETS)) passed, 0 failed'

$(B)/fuzz_%: tests/fuzz_%.c $(wildcard tests/*.h examples/*.h) tribox.h
	@mkdir -p $(B)
	clang $(FUZZ_FLAGS) -o $@ $< -lgmp -lm

coverage: ## lines and branches of the header that make test reaches; fails below every line
	@bash tests/check_coverage.sh
