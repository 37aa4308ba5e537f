#!/usr/bin/env bash
# Coverage of tribox.h by the programs of `make test`, all of them together: every line must run; branches
# that no test takes are listed. Run from the repository's root.
set -u
. tests/check_lib.sh

out=$CHECK_DIR/coverage
rm -rf "$out"
mkdir -p "$out"
have gcc && have gcov || exit 0

# A folder for each test and variant, since reports of one name would overwrite each other; -O0, so that
# lines are lines.
run() { # test, variant's flag or nothing
    local name=$1 root=$PWD
    shift
    mkdir -p "$CHECK_DIR/coverage/$name$*"
    cd "$CHECK_DIR/coverage/$name$*" || return 1
    gcc -std=c99 -I"$root" -O0 --coverage -DTEST_SCALE=8 "$@" "$root/tests/test_$name.c" -o test -lm && ./test
}
export -f run

for source in tests/test_*.c; do
    name=${source#tests/test_}
    name=${name%.c}
    [ "$name" = simd ] && continue # two units of one source
    job "coverage run: $name, scalar" run "$name" -DTRIBOX_SIMD=0
    job "coverage run: $name, default" run "$name"
done
wait

# The union over all programs: a line is covered if any of them ran it; likewise a branch.
report() {
    local folder
    for folder in "$CHECK_DIR"/coverage/*/; do
        (cd "$folder" && gcov -b -c -t ./*.gcda 2>/dev/null)
    done | awk -f tests/check_coverage.awk
}
report | tee "$out/report" | tail -n 60
job "every line of tribox.h runs" grep -q '^uncovered lines: 0$' "$out/report"

check_end
