#!/usr/bin/env bash
# Breaks tribox.h on purpose, in one way after another, and shows that the tests of `make test` notice.
#
#   tests/mutate.sh [number or first..last of mutants]...
#   tests/mutate.sh stale                      lists those whose text is no longer found exactly once
#   MUTATE_EVERY=8 tests/mutate.sh             every eighth, and a shorter look at the header as it is
#
# MUTATE_TRUST=1: the header as it is passes, do not ask.
#
# tests/mutants*.txt list the ways, by function name and a short text of it. A stale mutant counts as a failure, so
# that the list follows the header. A mutant is caught by the first program that does not compile, fails, crashes or
# hangs: the quick builds come first, most of all those of tcc, which compiles a program in no time. Run from the
# repository's root.
set -u
. tests/check_lib.sh

out=$CHECK_DIR/mutate
suite=$(sed -n 's/^TEST_SUITE := //p' tests/list.mk)
all="suite $(sed -n 's/^TEST_\(TWICE\|ALONE\) := //p' tests/list.mk | tr '\n' ' ')"
programs=${MUTATE_PROGRAMS:-$all}
limit=${MUTATE_LIMIT:-60}
cc=${MUTATE_CC:-gcc -std=c99 -O1}
every=${MUTATE_EVERY:-1}
quick=$(command -v tcc)
export suite programs limit cc every quick
CHECK_SHOW=1
mkdir -p "$out"

# 0 if a build of a test program notices the broken header in the folder
build_catches() { # folder, program, compiler and flags...
    local folder=$1 name=$2 source=$1/tests/test_$2.c
    shift 2
    if [ "$name" = suite ]; then
        source=$folder/suite.c
        # shellcheck disable=SC2086 # a list
        sh tests/make_suite.sh suite $suite >"$source"
    fi
    "$@" -DTEST_STOP -w -I"$folder" -I"$folder/tests" "$source" -o "$folder/test" -lm >"$folder/log" 2>&1 &&
        timeout "$limit" "$folder/test" >"$folder/log" 2>&1 && return 1
    echo "caught by $name: $*"
}

# the header without vectors, as text
scalar_text() {
    gcc -E -P -DTRIBOX_SIMD=0 "$1"
}

# 0 if some test program notices: first with few random questions, then as make test asks
caught() { # folder, programs, anything: only few questions
    local name flags folder=$1 scalar=1
    if [ -z "${3:-}" ] && cmp -s <(scalar_text tribox.h) <(scalar_text "$folder/tribox.h"); then
        scalar= # only vectors differ
    fi
    for name in $2; do
        if [ -n "$quick" ] && [ -n "$scalar" ]; then
            build_catches "$folder" "$name" "$quick" -DTRIBOX_SIMD=0 -DTEST_SCALE=32 && return 0
        fi
    done
    for flags in "-DTEST_SCALE=8" "-DTRIBOX_SIMD=0 -DTEST_SCALE=8" "" "-DTRIBOX_SIMD=0"; do
        [ -n "${3:-}" ] && [ "$flags" = "" ] && break
        [ -z "$scalar" ] && [[ $flags == *SIMD=0* ]] && continue
        for name in $2; do
            # shellcheck disable=SC2086 # the compiler and flags are a list
            build_catches "$folder" "$name" $cc $flags && return 0
        done
    done
    echo "not caught"
    return 1
}

# makes a folder with the broken header and the tests; the text must occur exactly once
mutant() { # number, old, new, function, programs
    local folder=$CHECK_DIR/mutate/$1 status
    rm -rf "$folder"
    mkdir -p "$folder"
    if ! OLD=$2 NEW=$3 IN=$4 awk -f tests/mutate.awk tribox.h >"$folder/tribox.h"; then
        rm -rf "$folder"
        echo "stale: the text is not found exactly once"
        return 1
    fi
    cp -r tests "$folder/"
    caught "$folder" "$5"
    status=$?
    rm -rf "$folder"
    return $status
}

# the header as it is, on the same terms: else "caught" would mean nothing
unbroken() {
    local folder=$CHECK_DIR/mutate/0 status
    mkdir -p "$folder"
    cp -r tribox.h tests "$folder/"
    ! caught "$folder" "$programs" few
    status=$?
    tail -n 5 "$folder/log"
    rm -rf "$folder"
    return $status
}
export -f build_catches scalar_text caught mutant unbroken
[ "${1:-}" = stale ] || [ -n "${MUTATE_TRUST:-}" ] || job "the header as it is passes" unbroken

# The list: "# name", "in FUNCTION" or macro (else the whole file), then "- old" lines, then "+ new" lines; several
# lines of one kind are joined. "@ programs" are those that must catch what follows in that file, else it is all.
chosen() { # numbers or ranges; none: every so many
    local range
    [ "$#" -gt 0 ] || return $((number % every != 0))
    for range in "$@"; do
        [ "$number" -ge "${range%..*}" ] && [ "$number" -le "${range#*..}" ] && return 0
    done
    return 1
}
number=0
stale=0
only=
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
        elif chosen "$@"; then
            job "mutant $number: $name" mutant "$number" "$old" "$new" "$function" "${only:-$programs}"
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
    '@'*) finish "$@"; only=${line#@}; only=${only# } ;;
    '- '*) old=${old:+$old$newline}${line#- } ;;
    '+ '*) new=${new:+$new$newline}${line#+ } ;;
    '+') new= ;;
    esac
done < <(for list in tests/mutants*.txt; do printf '@\n'; cat "$list"; echo; done)
finish "$@"

if [ "${1:-}" = stale ]; then
    rm -f "$check_results"
    echo "$number mutants, $stale stale"
    exit $((stale > 0))
fi
echo "$number mutants"
check_end
