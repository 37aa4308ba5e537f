#!/usr/bin/env bash
# The suite of `make test` and the golden inputs under the sanitizers, and the exact judges beside the
# header under the one that matters most there. Run from the repository's root.
set -u
. tests/check_lib.sh

out=$CHECK_DIR/sanitize
scale=${CHECK_SCALE:-8} # loop counts of the tests are divided by this
all=undefined,float-divide-by-zero,float-cast-overflow,bounds
mkdir -p "$out"

# SANITIZE_QUICK=1: the suite with vectors alone, and an eighth of the golden answers: a quarter of the time
suite() { # folder, compiler, flags, scale
    if [ -n "${SANITIZE_QUICK:-}" ]; then
        make -s "$1/tests/default/suite" B="$1" CC="$2" CFLAGS="$3 -DTEST_SCALE=$4" && "$1/tests/default/suite"
    else
        make -s test TEST_JOBS=-j1 B="$1" CC="$2" CFLAGS="$3 -DTEST_SCALE=$4"
    fi
}
golden() { # program, compiler, flags...
    "$2" -std=c99 -I. "${@:3}" tests/golden.c -o "$1" -lm && "$1" ${SANITIZE_QUICK:+eighth} nearest up
}
export -f suite golden

sanitize() { # name, compiler, flags
    have "$2" || return 0
    job "sanitizer $1, make test: $2 $3" suite "$out/$1-$2" "$2" "$3" "$scale"
    # shellcheck disable=SC2086 # flags are a list
    job "sanitizer $1, golden: $2 $3" golden "$out/golden-$1-$2" "$2" $3
}

sanitize address gcc "-O1 -g -fsanitize=address,$all -fno-sanitize-recover=all"
sanitize native clang "-O2 -march=native -g -fsanitize=address,$all -fno-sanitize-recover=all"
sanitize memory clang "-O1 -g -fsanitize=memory -fno-sanitize-recover=all -fsanitize-memory-track-origins"

check_end
