#!/usr/bin/env bash
# The header as text and as object code: no warning in any standard, nothing included or called or left
# behind that should not be, little stack, nothing for the static analysers to say. Run from the
# repository's root.
set -u
. tests/check_lib.sh

out=$CHECK_DIR/header
mkdir -p "$out"
warn="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wundef -Wcast-qual"
warn="$warn -Wdouble-promotion -Werror -Wno-unused-command-line-argument"
warn_c="$warn -Wstrict-prototypes -Wmissing-prototypes"

# The header alone, its functions as real symbols: what a user of another language would build.
alone=$out/alone.c
printf '#define TRIBOX_FN\n#include "tribox.h"\n' >"$alone"

# ---- warnings: compilers and levels, since some warnings need the optimiser; standards

quiet() { # compiler, standard, flags, sources...
    local cc=$1 std=$2 flags=$3 source
    shift 3
    for source in "$@"; do
        # shellcheck disable=SC2086 # flags are a list
        "$cc" "-std=$std" -I. $flags -c "$source" -o /dev/null || return 1
    done
}
export -f quiet

# The header as an object: no warning, undefined symbols and writable data, and with gcc the deepest chain of calls
clean() { # standard and warnings, compiler, flags...
    local object bad graph= status=0
    object=$(mktemp -d "$CHECK_DIR/header/object.XXXXXX")
    [ "$2" = gcc ] && graph=-fcallgraph-info=su
    # shellcheck disable=SC2086 # flags are a list
    "$2" $1 -I. "${@:3}" $graph -c "$CHECK_DIR/header/alone.c" -o "$object/alone.o" || return 1
    bad=$(nm "$object/alone.o" |
        awk '$1 == "U" && $2 !~ /^_?(memcpy|memset|_GLOBAL_OFFSET_TABLE_)$/ || $2 ~ /^[BbCDdGSs]$/')
    nm "$object/alone.o" | grep -q ' T tribox_overlap$' || bad="$bad no tribox_overlap"
    if [ -n "$bad" ]; then
        echo "calls or data: $bad"
        status=1
    fi
    if [ -n "$graph" ] && [[ " $* " == *" -O"[23]* ]]; then # a frame of -O0 holds every temporary
        awk -v limit=16384 -f tests/check_stack.awk "$object"/*.ci || status=1
    fi
    rm -rf "$object"
    return $status
}
export -f clean

small="tests/compile/c99.c tests/compile/constants.c tests/compile/include_twice.c tests/compile/two_units_a.c"
small="$small tests/compile/two_units_b.c"
for cc in gcc clang; do
    have $cc || continue
    extra=
    if [ $cc = clang ]; then
        extra=-Wreserved-identifier
    fi
    for level in "-O0" "-O2" "-O3 -march=native" "-O2 -ffast-math" "-O2 -DTRIBOX_SIMD=0" "-Os"; do
        # shellcheck disable=SC2086
        job "no warning, call, writable data, much stack: $cc -std=c99 $level" clean "-std=c99 $warn_c $extra" $cc $level
    done
    # shellcheck disable=SC2086 # small is a list
    job "no warning: $cc -std=c99 -O2, users' files" quiet $cc c99 "$warn_c $extra -O2" tests/golden.c $small
    # shellcheck disable=SC2086 # a list
    for level in "-O1" "-O3 -DTRIBOX_SIMD=0"; do
        job "no warning: $cc -std=c99 $level, constants" quiet $cc c99 "$warn_c $extra $level" tests/compile/constants.c
    done
    for std in c11 c17; do # another standard is another grammar, not another optimiser
        # shellcheck disable=SC2086
        job "no warning: $cc -std=$std" quiet $cc $std "$warn_c $extra -fsyntax-only" "$alone" $small
    done
done
for cc in g++ clang++; do
    have $cc || continue
    for level in "-O0" "-O2" "-O2 -DTRIBOX_SIMD=0"; do
        job "no warning: $cc -std=c++98 $level" quiet $cc c++98 "$warn $level" tests/compile/cpp98.cc
    done
    for std in c++11 c++17 c++20; do
        source=tests/compile/cpp98.cc
        if [ $std = c++20 ]; then
            source=tests/compile/cpp20.cc
        fi
        job "no warning: $cc -std=$std" quiet $cc $std "$warn -fsyntax-only" "$source"
    done
done
# what some users switch on besides
have gcc && job "no warning: gcc -Wfloat-equal" quiet gcc c99 "$warn_c -Wfloat-equal -fsyntax-only" "$alone"
have g++ && job "no warning: g++ -Wold-style-cast -Wuseless-cast" quiet g++ c++11 \
    "$warn -Wfloat-equal -Wold-style-cast -Wuseless-cast -Wzero-as-null-pointer-constant -fsyntax-only -x c++" "$alone"
for cc in clang-19 clang-22; do
    have $cc || continue
    job "no warning: $cc -Wfloat-equal -Wvector-conversion" quiet $cc c99 \
        "$warn_c -Wfloat-equal -Wvector-conversion -fsyntax-only" "$alone"
    job "no warning: $cc, C++, -Wold-style-cast" quiet $cc c++11 \
        "$warn -Wfloat-equal -Wold-style-cast -Wzero-as-null-pointer-constant -fsyntax-only -x c++" "$alone"
done
for cross in aarch64-linux-gnu-gcc riscv64-linux-gnu-gcc s390x-linux-gnu-gcc x86_64-w64-mingw32-gcc; do
    have $cross && job "no warning: $cross" quiet $cross c99 "$warn_c -O2" "$alone"
done
have gcc && job "no warning: gcc -m32" quiet gcc c99 "$warn_c -O2 -m32" "$alone"

# ---- what the header includes and leaves defined

includes_only_three() {
    local found
    found=$(gcc -std=c99 -H -fsyntax-only tribox.h 2>&1 | sed -n 's/^\. .*\///p' | sort -u | tr '\n' ' ')
    echo "includes: $found"
    [ "$found" = "float.h stddef.h stdint.h " ]
}

# macros defined after the header that the three standard headers do not define
leaves_only_tribox_macros() {
    local leaked
    printf '#include <float.h>\n#include <stddef.h>\n#include <stdint.h>\n' |
        gcc -std=c99 -dM -E -x c - | sort >"$CHECK_DIR/header/before"
    printf '#include "tribox.h"\n' | gcc -std=c99 -I. -dM -E -x c - | sort >"$CHECK_DIR/header/after"
    leaked=$(comm -13 "$CHECK_DIR/header/before" "$CHECK_DIR/header/after" | grep -v '^#define TRIBOX_')
    echo "leaked: $leaked"
    [ -z "$leaked" ] && grep -q '^#define TRIBOX_VERSION ' "$CHECK_DIR/header/after"
}

# gcc without optimization compiles what is static and not inline, called or not: seconds and a megabyte in each
# file of a debug build
costs_nothing_uncalled() {
    local compiler object=$CHECK_DIR/header/uncalled.o
    for compiler in "gcc -x c" "g++ -x c++"; do
        # shellcheck disable=SC2086 # a compiler and its language
        echo '#include "tribox.h"' | $compiler -O0 -I. -c - -o "$object" || return 1
        [ -z "$(nm "$object")" ] || { echo "$compiler -O0: $(nm "$object" | wc -l) symbols"; return 1; }
    done
}

export -f includes_only_three leaves_only_tribox_macros costs_nothing_uncalled

job "README.md's counts, sizes and names are those of the code" bash tests/doc_counts.sh
have gcc && job "its words are nobody's macros" bash tests/check_words.sh
have gcc && job "includes float.h, stddef.h, stdint.h alone" includes_only_three
have gcc && job "leaves TRIBOX_ macros alone" leaves_only_tribox_macros
have gcc && have g++ && job "no code in a file that calls nothing, gcc and g++ -O0" costs_nothing_uncalled

# ---- static analysis. What is switched off, and why:
# easily-swappable-parameters: triangles and boxes are alike by nature
# implicit-widening, narrowing: the compilers' -Wconversion and -Wsign-conversion decide
# confusable-identifiers: compares all names with all others
# reserved-identifier, dcl37, dcl51: the system's <stdint.h>, not the header's names
# The header itself is the file, since the analyser looks into no function of an included one.

# clang-analyzer: takes many minutes; gcc's analyser follows the paths
tidy_checks='-*,bugprone-*,cert-*,misc-*,performance-*,portability-*,-misc-confusable-identifiers'
tidy_checks=$tidy_checks',-bugprone-easily-swappable-parameters'
tidy_checks=$tidy_checks',-bugprone-implicit-widening-of-multiplication-result'
tidy_checks=$tidy_checks',-bugprone-narrowing-conversions,-bugprone-reserved-identifier'
tidy_checks=$tidy_checks',-cert-dcl37-c,-cert-dcl51-cpp'

tidy() {
    clang-tidy --quiet --warnings-as-errors='*' --checks="$1" tribox.h -- -x c -std=c99 -DTRIBOX_FN= "${@:2}"
}

# uninitvar: does not see that a door writes what a void pointer names; selfAssignment: it is volatile, a barrier;
# compareBoolExpressionWithInt: compares the order of two numbers with a flag, on purpose
# The numbers of <float.h>, which it does not find, are told: else it would stop at an #error and say nothing.
# missingIncludeSystem, toomanyconfigs, normalCheckLevelMaxBranches: remarks on its own limits
check_cpp() {
    cppcheck --quiet --error-exitcode=1 --std=c99 --enable=warning,performance,portability --inline-suppr \
        --suppress=uninitvar --suppress=selfAssignment --suppress=compareBoolExpressionWithInt \
        --suppress=missingIncludeSystem --suppress=toomanyconfigs --suppress=normalCheckLevelMaxBranches \
        -DFLT_RADIX=2 -DFLT_MANT_DIG=24 -DFLT_MIN_EXP=-125 -DFLT_MAX_EXP=128 -DFLT_EVAL_METHOD=0 \
        -DDBL_MANT_DIG=53 -DDBL_MIN_EXP=-1021 -DDBL_MAX_EXP=1024 -D__GNUC__=12 -D__x86_64__ -D__SSE2__ \
        -DTRIBOX_SIMD=0 -I. "$CHECK_DIR/header/alone.c"
}
export -f tidy check_cpp

have clang-tidy && job "clang-tidy" tidy "$tidy_checks"
have cppcheck && job "cppcheck" check_cpp
# the specification alone: of all of it the analyser is not done in ten minutes
have gcc && job "gcc -fanalyzer" quiet gcc c99 \
    "-O1 -fanalyzer -Werror -DTRIBOX_NO_COMPANIONS -DTRIBOX_SIMD=0" "$alone"

check_end
