# Benches: built twice, at plain -O2 and at -O3 for this very CPU, and reported apart.
#   make bench CC=clang CSV=results.csv

BENCH_O2     ?= -O2
BENCH_NATIVE ?= -O3 -march=native
BENCHES      := overlap
BENCH_COMMIT := $(shell git describe --always --dirty --exclude '*' 2>/dev/null || echo unknown)
BENCH_CC      = $(CC) -std=c99 -Ibench -I. $(WARN_C) -DBENCH_COMMIT='"$(BENCH_COMMIT)"'
BENCH_DEPS   := tribox.h $(wildcard bench/*.h)
BENCH_ARGS    = $(if $(CSV),--csv $(CSV))

BENCH_BINS   := $(BENCHES:%=$(B)/o2/bench_%) $(BENCHES:%=$(B)/native/bench_%)

.PHONY: bench bench-quick bench-build bench-data

bench-build: $(BENCH_BINS)

# The compiler, its flags and the commit are part of a figure: build anew when any of them changed.
.PHONY: bench-force
bench-force:
$(B)/bench.stamp: bench-force
	@mkdir -p $(B)/o2 $(B)/native
	@echo '$(BENCH_CC) $(BENCH_O2) $(BENCH_NATIVE)' | cmp -s - $@ || echo '$(BENCH_CC) $(BENCH_O2) $(BENCH_NATIVE)' > $@

$(B)/o2/bench_%: bench/bench_%.c $(BENCH_DEPS) $(B)/bench.stamp
	$(BENCH_CC) $(BENCH_O2) -DBENCH_FLAGS='"$(BENCH_O2)"' $< -o $@ -lm -pthread

$(B)/native/bench_%: bench/bench_%.c $(BENCH_DEPS) $(B)/bench.stamp
	$(BENCH_CC) $(BENCH_NATIVE) -DBENCH_FLAGS='"$(BENCH_NATIVE)"' $< -o $@ -lm -pthread

bench: bench-build ## time everything against the float tests of today, at -O2 and -O3 -march=native
	@for b in $(BENCH_BINS); do echo; $$b $(BENCH_ARGS) || exit 1; done

bench-quick: bench-build ## the same with fewer runs
	@for b in $(BENCH_BINS); do echo; $$b --quick $(BENCH_ARGS) || exit 1; done
