#!/usr/bin/env bash
# Which golden answers are wrong, and of which functions: builds golden.c with the compiler and flags given, and
# compares each answer with the exact judges'.
#
#   tests/golden_diff.sh [-m "modes"] [-r runner] compiler [flags]...
#
# Modes are golden.c's arguments; the last one is compared. Prints how many answers of each kind differ and the
# first of each. Needs GMP. Run from the repository's root.
set -u
modes=
runner=
while [ "${1:-}" = -m ] || [ "${1:-}" = -r ]; do
    if [ "$1" = -m ]; then modes=$2; else runner=$2; fi
    shift 2
done
dir=${CHECK_DIR:-build/check}/golden_diff
mkdir -p "$dir"
judge=$dir/judge.$(cat tests/golden_cases.h tests/gen_golden.c tests/companions*.h tests/contact_exact.h tests/verify_*.h | cksum | cut -d' ' -f1)
if [ ! -e "$judge" ]; then
    cc -O2 -w -I. -DGOLDEN_PRINT tests/gen_golden.c -o "$dir/gen" -lgmp && "$dir/gen" >"$judge.$$" &&
        mv "$judge.$$" "$judge" || exit 1
fi
program=$dir/program.$$
"$@" -w -I. -DGOLDEN_PRINT tests/golden.c -o "$program" -lm || exit 1
# shellcheck disable=SC2086 # runners and modes are lists of words
timeout "${CHECK_LIMIT:-120}" $runner "$program" $modes >"$program.out"
status=$?
[ $status -le 1 ] || echo "golden ended with status $status"
# each mode's answers end in its report: those before the last report, or all if it never came
from=$(grep -n '^golden ' "$program.out" | tail -n 2 | head -n -1 | cut -d: -f1)
sed "${from:+1,${from}d}" "$program.out" | grep -Ev '^golden |^    first' | diff - "$judge" | grep '^<' | sed 's/^< //' | awk '{
        kind = $0; sub(/ [0-9]+ [0-9a-f]+$/, "", kind); count[kind]++; if (!(kind in first)) first[kind] = $0
    } END { for (kind in count) { print count[kind] " " kind ", first: " first[kind]; all += count[kind] }
        print all + 0 " answers differ" }' | sort -rn
lines=$(wc -l <"$judge")
echo "of $lines"
rm -f "$program" "$program.out"
