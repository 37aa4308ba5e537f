#!/usr/bin/env bash
# Coverage of tribox.h by the programs of `make test`, all of them together: every line must run, and every
# branch be taken, or tests/branches.txt say why no test can. Run from the repository's root.
set -u
. tests/check_lib.sh

out=$CHECK_DIR/coverage
rm -rf "$out"
mkdir -p "$out"
have gcc && have gcov || exit 0

# A folder for each test and variant, since reports of one name would overwrite each other; -O0, so that
# lines are lines; not one copy of a function for each call, so that branches are those of the text.
run() { # test, variant's flag or nothing
    local name=$1 root=$PWD scale=8
    shift
    [ "$name" = solid ] && scale=1 # rare cases by chance
    mkdir -p "$CHECK_DIR/coverage/$name$*"
    cd "$CHECK_DIR/coverage/$name$*" || return 1
    gcc -std=c99 -I"$root" -O0 --coverage -Dalways_inline=unused -DTEST_SCALE=$scale "$@" "$root/tests/test_$name.c" -o test -lm && ./test
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
    done | awk -v reasons=tests/branches.txt -f tests/check_coverage.awk
}
report | tee "$out/report" | tail -n 60
job "every line of tribox.h runs" grep -q '^lines: [1-9][0-9]*, never run: 0$' "$out/report"
job "every branch is taken, or its reason is known" grep -q 'without a reason: 0$' "$out/report"

check_end
