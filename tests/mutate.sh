#!/usr/bin/env bash
# Breaks tribox.h on purpose, in one way after another, and shows that the tests of `make test` notice.
#
#   tests/mutate.sh [number of a mutant]...
#   tests/mutate.sh stale                      lists those whose text is no longer found exactly once
#   MUTATE_EVERY=8 tests/mutate.sh             every eighth, and a shorter look at the header as it is
#
# tests/mutants*.txt list the ways, by function name and a short text of it. A stale mutant counts as a failure, so
# that the list follows the header. A mutant is caught by the first program that does not
# compile, fails, crashes or hangs. Run from the repository's root.
set -u
. tests/check_lib.sh

out=$CHECK_DIR/mutate
programs=${MUTATE_PROGRAMS:-$(sed -n 's/^TEST_\(SUITE\|TWICE\|ALONE\) := //p' tests/list.mk | tr '\n' ' ')}
first= # programs to try before the others
limit=${MUTATE_LIMIT:-20}
cc=${MUTATE_CC:-gcc -std=c99 -O1}
every=${MUTATE_EVERY:-1}
export programs first limit cc every
CHECK_SHOW=1
mkdir -p "$out"

# 0 if some test program notices the broken header in the folder: first with few random questions, then as make test asks
caught() { # folder, one of the flags below alone
    local name flags folder=$1
    for flags in "-DTEST_SCALE=8" "" "-DTRIBOX_SIMD=0"; do
        [ -n "${2:-}" ] && [ "$flags" != "$2" ] && continue
        for name in $first $programs; do
            [ -e "tests/test_$name.c" ] || continue
            # shellcheck disable=SC2086 # the compiler and flags are a list
            $cc $flags -w -I"$folder" "$folder/tests/test_$name.c" -o "$folder/test" -lm || return 0
            if ! timeout "$limit" "$folder/test" >"$folder/log" 2>&1; then
                echo "caught by test_$name $flags"
                return 0
            fi
        done
    done
    echo "not caught"
    return 1
}

# makes a folder with the broken header and the tests; the text must occur exactly once
mutant() { # number, old, new, function
    local folder=$CHECK_DIR/mutate/$1 status
    rm -rf "$folder"
    mkdir -p "$folder"
    if ! OLD=$2 NEW=$3 IN=$4 awk -f tests/mutate.awk tribox.h >"$folder/tribox.h"; then
        rm -rf "$folder"
        echo "stale: the text is not found exactly once"
        return 1
    fi
    cp -r tests "$folder/"
    caught "$folder"
    status=$?
    rm -rf "$folder"
    return $status
}

# the header as it is, on the same terms: else "caught" would mean nothing
unbroken() {
    local folder=$CHECK_DIR/mutate/0 status
    mkdir -p "$folder"
    cp -r tribox.h tests "$folder/"
    if [ "$every" -gt 1 ]; then
        ! caught "$folder" "-DTEST_SCALE=8"
    else
        ! caught "$folder"
    fi
    status=$?
    tail -n 5 "$folder/log"
    rm -rf "$folder"
    return $status
}
export -f caught mutant unbroken
[ "${1:-}" = stale ] || job "the header as it is passes" unbroken

# The list: "# name", "in FUNCTION" or macro (else the whole file), then "- old" lines, then "+ new" lines; several
# lines of one kind are joined. "@ programs" are tried first from there on.
number=0
stale=0
name=
function=
old=
new=
finish() {
    if [ -n "$old" ]; then
        number=$((number + 1))
        if [ "${1:-}" = stale ]; then
            if ! OLD=$old NEW=$new IN=$function awk -f tests/mutate.awk tribox.h >/dev/null; then
                echo "stale $number: $name"
                stale=$((stale + 1))
            fi
        elif [ "$#" -eq 0 ] && [ $((number % every)) -eq 0 ] || [[ " $* " == *" $number "* ]]; then
            job "mutant $number: $name" mutant "$number" "$old" "$new" "$function"
        fi
    fi
    old=
    new=
    function=
}
newline=$'\n'
while IFS= read -r line || [ -n "$line" ]; do
    case $line in
    '# '*) finish "$@"; name=${line#\# } ;;
    'in '*) function=${line#in } ;;
    '@ '*) finish "$@"; first=${line#@ } ;;
    '- '*) old=${old:+$old$newline}${line#- } ;;
    '+ '*) new=${new:+$new$newline}${line#+ } ;;
    '+') new= ;;
    esac
done < <(cat tests/mutants*.txt)
finish "$@"

if [ "${1:-}" = stale ]; then
    rm -f "$check_results"
    echo "$number mutants, $stale stale"
    exit $((stale > 0))
fi
echo "$number mutants"
check_end
