#!/usr/bin/env bash
# The same answers everywhere: golden.c built and run by every compiler, flag, mode and platform at hand.
# Each line is one build; its runs must all print the hash in golden_overlap.h. Run from the repository's
# root.
set -u
. tests/check_lib.sh

modes="nearest up down zero flush"
mkdir -p "$CHECK_DIR/golden"
export WINEPREFIX=$PWD/$CHECK_DIR/wine WINEDEBUG=-all

# in a job: builds and runs; the runner is "" for none
golden_run() { # runner, program, arguments, compiler and flags...
    local runner=$1 program=$2 arguments=$3
    shift 3
    "$@" -o "$program" || return 1
    # shellcheck disable=SC2086 # runners and arguments are lists of words
    $runner "$program" $arguments
    local status=$?
    rm -f "$program"
    return $status
}
export -f golden_run

builds=0
golden() { # runner, arguments, compiler and flags...
    local runner=$1 arguments=$2 name
    shift 2
    have "$1" || return 0
    if [ -n "$runner" ]; then
        have "${runner%% *}" || return 0
    fi
    builds=$((builds + 1))
    name="$* ${arguments:+[$arguments]}"
    job "golden: ${name//-I. tests\/golden.c /}" \
        golden_run "$runner" "$CHECK_DIR/golden/$builds$suffix" "$arguments" "$@"
}

# the header of this file, then flags; -lm for fesetround
c() { golden "" "$1" "$2" -I. tests/golden.c "${@:3}" -lm; }
suffix=""

cpu_has() {
    grep -qw "$1" /proc/cpuinfo 2>/dev/null
}

for cc in gcc clang; do
    c "$modes" $cc -std=c99 -O2
    c "$modes" $cc -std=c99 -O3 -march=native
    c "$modes" $cc -O3 -march=native
    c "$modes" $cc -Ofast
    c "$modes" $cc -Ofast -march=native
    c "$modes" $cc -O2 -frounding-math
    for flags in -O0 -O1 -O3 -Os "-O2 -funsafe-math-optimizations" "-O3 -ffast-math" "-O2 -std=gnu99" \
        "-O2 -std=c11" "-O2 -std=c17" "-O2 -DTRIBOX_SIMD=0" "-O3 -march=native -DTRIBOX_SIMD=0" \
        "-O2 -fno-strict-aliasing -fwrapv" "-O2 -ffp-contract=fast" "-O2 -ffp-contract=off" "-O2 -msse4.2"; do
        # shellcheck disable=SC2086
        c "" $cc $flags
    done
    if cpu_has fma; then
        for flags in "-O2 -mfma" "-O2 -mfma -ffp-contract=fast" "-O2 -mfma -ffp-contract=off" \
            "-O3 -mavx2 -mfma -ffast-math"; do
            # shellcheck disable=SC2086
            c "up flush" $cc $flags
        done
    fi
    c "$modes" $cc -m32 -O2 -msse2 -mfpmath=sse
    c "" $cc -m32 -Ofast -msse2 -mfpmath=sse
done

# x87: every intermediate in 80 bits, or not, as the compiler likes
for flags in -O0 -O2 -O3 -Os -Ofast; do
    c "nearest up down zero" gcc -m32 -mfpmath=387 -mno-sse $flags
done
c "" gcc -mfpmath=387 -O2
c "" gcc -m32 -mfpmath=387 -mno-sse -O2 -ffloat-store
c "" clang -m32 -mno-sse -O2

c "" tcc
c "" tcc -DTRIBOX_SIMD=0

for std in c++98 c++11 c++17 c++20; do
    for cc in g++ clang++; do
        golden "" "" $cc -I. -x c++ tests/golden.c -x none -std=$std -O2 -lm
    done
done

# the whole suite where floating-point arithmetic is least to be trusted
suite() { # compiler, flags
    make -s test B="$CHECK_DIR/suite/$1${2//[^[:alnum:]]/}" CC="$1" CFLAGS="$2" # make splits names at spaces
}
export -f suite
for cc in gcc clang; do
    have $cc && job "make test: $cc -Ofast -march=native" suite $cc "-Ofast -march=native"
done
# not -Ofast: the tests' own conversions to float would then round nowhere
have gcc && job "make test: gcc -O2, x87" suite gcc "-O2 -m32 -mfpmath=387 -mno-sse"

# Emulated machines; static, so that the emulator needs no libraries of theirs. All three fuse by default.
for arch in aarch64 s390x riscv64; do
    for flags in -O0 -O2 "-O3 -ffast-math"; do
        # shellcheck disable=SC2086
        golden qemu-$arch "" $arch-linux-gnu-gcc -static -I. tests/golden.c $flags -lm
    done
    golden qemu-$arch "up down" $arch-linux-gnu-gcc -static -I. tests/golden.c -std=c99 -O2 -lm
done
golden qemu-aarch64 "flush" aarch64-linux-gnu-gcc -static -I. tests/golden.c -O2 -lm

# 64-bit Windows
if have x86_64-w64-mingw32-gcc && have wine; then
    wait
    wine wineboot --init </dev/null >/dev/null 2>&1 # once, so that parallel runs find their folder ready
    suffix=.exe
    for flags in -O0 -O2 -Ofast "-O3 -march=x86-64-v2"; do
        # shellcheck disable=SC2086
        golden wine "up" x86_64-w64-mingw32-gcc -static -I. tests/golden.c $flags
    done
    suffix=""
fi

# WebAssembly without any library, run by node
wasm() { # flags...
    have node || return 0
    builds=$((builds + 1))
    job "golden: wasm32 $*" golden_run "node tests/check_wasm.js" "$CHECK_DIR/golden/$builds.wasm" "" \
        clang --target=wasm32 -nostdlib -ffreestanding -I. -DGOLDEN_FREESTANDING tests/golden.c "$@" \
        -Wl,--no-entry -Wl,--export=golden_hash_high -Wl,--export=golden_hash_low -Wl,--export=golden_wrong \
        -Wl,--export=golden_expected_high -Wl,--export=golden_expected_low
}
if have clang && have wasm-ld; then
    wasm -O0
    wasm -O2
    wasm -O3 -ffast-math
    wasm -O2 -msimd128
fi

check_end
