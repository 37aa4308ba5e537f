#!/usr/bin/env bash
# README's counts are those of the code: each sentence below, wherever README.md has it, holds the number that is
# counted here.
#
#   bash tests/doc_counts.sh          says which do not, and fails
#   bash tests/doc_counts.sh fix      writes the right ones into README.md
#
# Run from the repository's root.
set -u
mode=${1:-check}
wrong=0

with_commas() {
    echo "$1" | sed -E ':a; s/^([0-9]+)([0-9]{3})/\1,\2/; ta'
}

# The regular expression has the number as @; it must occur in README.md.
fact() { # what, regular expression, number
    local number have pattern
    number=$(with_commas "$3")
    pattern=${2//@/([0-9][0-9,]*)}
    have=$(grep -oE "$pattern" README.md | head -n 1 | sed -E "s/^$pattern\$/\1/")
    if [ -z "$have" ]; then
        echo "README.md does not say: $1 (${2//@/$number})"
        wrong=$((wrong + 1))
    elif [ "$have" != "$number" ]; then
        if [ "$mode" = fix ]; then
            sed -i -E "s/(${2//@/)[0-9][0-9,]*(})/\1$number\2/" README.md
            echo "$1: $have, now $number"
        else
            echo "$1: README.md says $have, it is $number"
            wrong=$((wrong + 1))
        fi
    fi
}

golden() { # a word of the golden answers' first comment: the number before it
    sed -nE "s/.*[^0-9]([0-9]+) $1.*/\1/p" tests/golden_overlap.h | head -n 1
}
suite=$(sed -n 's/^TEST_SUITE := //p' tests/list.mk)
# shellcheck disable=SC2086 # the suite is a list
fact "tests of the suite" "the suite of @" "$(for t in $suite; do cat tests/test_$t.c; done | grep -c '^ *RUN(')"
fact "golden triangles and boxes" "@ triangles and boxes" "$(golden "triangles and boxes")"
fact "golden grids" "triangles and boxes, @ grids" "$(golden grids)"
fact "golden questions to companions" "@ questions to companions" "$(golden "questions to companions")"
fact "builds of make platforms" "@ builds" "$(PLATFORMS_COUNT=1 bash tests/check_platforms.sh)"
fact "mutants" "@ mutants" "$(cat tests/mutants*.txt | grep -c '^# ')"
broken=$(awk '/mutant_names\[.*\] = \{/ { on = 1 } on { count += gsub(/"[^"]*"/, "") } /\};/ { on = 0 } END { print count - 2 }' \
    tests/verify_exact.h tests/companions_exact.h)
fact "judges broken on purpose" "; @ judges" "$broken"
fact "kilobytes of the header" "The header is @ KB" "$((($(wc -c <tribox.h) + 500) / 1000))"

targets=$(sed -n 's/^FUZZ_TARGETS *:= //p' tests/check.mk)
# shellcheck disable=SC2086 # a list
fact "targets of make fuzz" "@ targets" "$(echo $targets | wc -w)"

# a cost: what gcc 12 takes for a file with one call, in tenths of a second of its own time; a machine may be twice as
# fast or half
if command -v gcc-12 >"${TMPDIR:-/tmp}/cost.$$"; then
    printf '#include "tribox.h"\nint f(const float *t);\nint f(const float *t) { return tribox_overlap(t, t, t, t, t); }\n' >"${TMPDIR:-/tmp}/cost.$$.c"
    TIMEFORMAT=%U
    took=$({ time gcc-12 -O2 -I. -S "${TMPDIR:-/tmp}/cost.$$.c" -o "${TMPDIR:-/tmp}/cost.$$"; } 2>&1 | tr -d .)
    said=$(grep -oE 'takes gcc 12 about [0-9.]+ s' README.md | tr -dc '0-9. ' | awk '{ print $2 * 1000 }')
    if [ "$((10#$took))" -gt "$((2 * said))" ] || [ "$((2 * 10#$took))" -lt "$said" ]; then
        echo "README.md says that a file with tribox_overlap takes gcc 12 $said ms, it takes $((10#$took))"
        wrong=$((wrong + 1))
    fi
fi
rm -f "${TMPDIR:-/tmp}/cost.$$" "${TMPDIR:-/tmp}/cost.$$.c"

# sizes, where README.md tells them
size=$(printf '#include "tribox.h"\n#include <stdio.h>\nint main(void) { printf("%%d\\n", (int)sizeof(tribox_tri)); return 0; }\n' |
    ${CC:-cc} -x c -I. -w - -o "${TMPDIR:-/tmp}/sizes.$$" && "${TMPDIR:-/tmp}/sizes.$$")
rm -f "${TMPDIR:-/tmp}/sizes.$$"
grep -qE 'tribox_tri`? is [0-9]+ bytes' README.md && fact "bytes of tribox_tri" 'tribox_tri`? is @ bytes' "$size"

# every function of the API is named; NAME_f64 may be told as `NAME`, `_f64`
for name in $(sed -n '/^\/\* ---- 2\. API/,/^\/\* ---- 3\. /s/^TRIBOX_FN .*[ *]\(tribox_[a-z0-9_]*\)(.*/\1/p' tribox.h | sort -u); do
    if ! grep -q "$name" README.md && ! { [ "$name" != "${name%_f64}" ] && grep -q "${name%_f64}.*_f64" README.md; }; then
        echo "README.md does not name $name"
        wrong=$((wrong + 1))
    fi
done

[ "$wrong" -eq 0 ]
