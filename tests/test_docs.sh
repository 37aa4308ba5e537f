#!/bin/sh
# What README.md says is so: one version and licence everywhere, the quick start is examples/01_overlap.c, and
# every program in it compiles and prints what stands below it.
#
#   CC=cc CFLAGS=-O2 sh tests/test_docs.sh [folder for the programs]
#
# C++ programs are tried where $CXX is there. Run from the repository's root.
set -u

out=${1:-build/tests/readme}
CC=${CC:-cc}
CXX=${CXX:-c++}
passed=0
failed=0
rm -rf "$out"
mkdir -p "$out"

check() { # name, command...
    name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAIL $name"
    fi
}

# ---- one version: the header's first line and macros, README's first paragraph and newest change

macro() { # last part of the name
    sed -n "s/^#define TRIBOX_VERSION_$1 \([0-9]*\)\$/\1/p" tribox.h
}
first_version() { # file, lines
    sed -n "$2" "$1" | grep -o 'v[0-9][0-9]*\.[0-9][0-9]*\.[0-9][0-9]*' | head -n 1
}
versions_agree() {
    version=v$(macro MAJOR).$(macro MINOR).$(macro PATCH)
    echo "$version" | grep -Eqx 'v[0-9]+\.[0-9]+\.[0-9]+' || { echo "macros: $version"; return 1; }
    for place in "tribox.h 1p" "README.md 1,10p" "README.md /^##.Changes/,/^##.References/p"; do
        # shellcheck disable=SC2086 # a file and a sed script
        found=$(first_version $place)
        [ "$found" = "$version" ] || { echo "$place: $found, macros: $version"; return 1; }
    done
}
check "one version" versions_agree

# ---- one licence: the header ends with the text of LICENSE

header_ends_with_licence() {
    sed -n '/^#endif \/\* TRIBOX_H \*\/$/,$p' tribox.h |
        sed -e '1,/^\/\*$/d' -e '$d' -e 's/^ \*$//' -e 's/^ \* //' | cmp - LICENSE
}
check "the header ends with LICENSE" header_ends_with_licence

# ---- every private macro is undefined at the end, and only those

macros_are_undefined() {
    sed -n 's/^ *# *define \(TBX_[A-Za-z0-9_]*\).*/\1/p' tribox.h | sort -u > "$out/defined"
    sed -n 's/^ *# *undef \(TBX_[A-Za-z0-9_]*\).*/\1/p' tribox.h | sort -u | comm -3 "$out/defined" - > "$out/left"
    [ -s "$out/defined" ] && [ ! -s "$out/left" ] || { echo "defined, or undefined, alone:"; cat "$out/left"; return 1; }
}
check "#define and #undef agree" macros_are_undefined

# ---- the code blocks: NUMBER.c or .cpp, and NUMBER.text for the output that follows

awk -v out="$out" '
    /^```/ && inside { close(file); inside = 0; next }
    /^```(c|cpp)$/ { inside = 1; near = 1; program = out "/" ++number
                    file = program "." substr($0, 4); next }
    /^```text$/ && near { inside = 1; near = 0; file = program ".text"; next }
    inside { print > file; next }
    !/^$/ && !/^It prints:$/ { near = 0 }
' README.md

check "the quick start is examples/01_overlap.c" cmp "$out/1.c" examples/01_overlap.c
check "its output is examples/01_overlap.out" cmp "$out/1.text" examples/01_overlap.out

prints_what_it_says() { # program without ending, compiler and flags...
    program=$1
    shift
    "$@" -o "$program" && "$program" > "$program.out" && cmp "$program.out" "$program.text"
}
for source in "$out"/*.c; do
    # shellcheck disable=SC2086 # flags are a list
    check "README's $source" prints_what_it_says "${source%.c}" $CC -std=c99 ${CFLAGS:-} -I. "$source"
done
for source in "$out"/*.cpp; do
    command -v "$CXX" > /dev/null || { echo "SKIP: $CXX not found: $source"; continue; }
    check "README's $source" prints_what_it_says "${source%.cpp}" "$CXX" -std=c++11 -O1 -I. "$source"
done

echo "test_docs: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
