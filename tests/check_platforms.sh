#!/usr/bin/env bash
# The same answers everywhere: golden.c built and run by every compiler, flag, mode and platform at hand; traps.c,
# which lets no function raise a flag that somebody may trap; and the whole suite where arithmetic is least to be
# trusted. Each line is one build; its runs must all print the hash in golden_overlap.h.
#
#   tests/check_platforms.sh [pattern]     only the builds whose line matches the extended regular expression
#   PLATFORMS=all                          every combination, and more questions (`make platforms-all`)
#
# The usual run holds each compiler, machine and kind of flag at least once, and takes 20 minutes on two idle cores,
# most of them for compiling.
#
# Run from the repository's root.
set -u
. tests/check_lib.sh

pattern=${1:-.}
if [ -n "${PLATFORMS_COUNT:-}" ]; then # only how many there are, for README.md
    count=0
    job() { count=$((count + 1)); }
    have() { return 0; }
    check_end() { rm -f "$check_results"; echo "$count"; }
fi
PLATFORMS=${PLATFORMS:-}
dir=$CHECK_DIR/golden
mkdir -p "$dir"
WINEPREFIX=$(realpath "$CHECK_DIR")/wine
export WINEPREFIX WINEDEBUG=-all

gccs="gcc-11 gcc-12"
clangs="clang-14 clang-16 clang-19 clang-22"
modes="nearest up down zero daz ftz flush"
before="-include tests/compile/before.h"

# in a job: builds and runs; the runner is "" for none
built_and_run() { # runner, program, arguments, compiler and flags...
    local runner=$1 program=$2 arguments=$3
    shift 3
    "$@" -o "$program" || return 1
    # shellcheck disable=SC2086 # runners and arguments are lists of words
    $runner "$program" $arguments
    local status=$?
    rm -f "$program"
    return $status
}
export -f built_and_run

more() { # is this the long run?
    [ "$PLATFORMS" = all ]
}
if more; then # Debian sid has these; what is not there is left out
    gccs="$gccs gcc-13 gcc-14 gcc-15 gcc-16"
    clangs="$clangs clang-23"
fi
also() { # in the long run only
    if more; then
        "$@"
    fi
}
part=few
if more; then
    part=eighth
fi

builds=0
suffix=
build() { # kind, runner, arguments, compiler and flags...
    local kind=$1 runner=$2 arguments=$3 name tool
    shift 3
    name="$kind: $* ${arguments:+[$arguments]}"
    name=${name//-I. tests\/$kind.c /}
    name=${name// -lm/}
    [[ $name =~ $pattern ]] || return 0
    for tool in "$1" ${runner%% *}; do
        have "$tool" || return 0
    done
    builds=$((builds + 1))
    job "$name" built_and_run "$runner" "$dir/$builds$suffix" "$arguments" "$@"
}
golden() { build golden "$@"; }
# shellcheck disable=SC2086 # flags are lists of words
c() { golden "" "$1" "$2" -I. tests/golden.c ${3:-} -lm; } # arguments, compiler, flags
# shellcheck disable=SC2086
traps() { build traps "" "$1" "$2" -w -I. tests/traps.c ${3:-} -lm; }

cpu_has() {
    grep -qw "$1" /proc/cpuinfo 2>/dev/null
}

# ---- every compiler at every level, with vectors and without, in every mode: the usual run takes a part of the
# table. traps.c asks the golden answers, too, and nothing may raise invalid, divide-by-zero or overflow.

usual() { # compiler, flags
    more && return 0
    case "$1$2" in
    clang-22-O[0-3s]* | clang-22-Oz | clang-22-Ofast) [[ $2 != *-Os*SIMD* && $2 != *-O0*SIMD* && $2 != -O3 ]] ;;
    gcc-12-O0 | gcc-12-O2 | gcc-12-Oz | gcc-12-Ofast | "gcc-12-O3 -march=native"* | "gcc-12-O2 -ffast-math") ;;
    "gcc-12-O2 -DTRIBOX_SIMD=0" | "gcc-11-O2 -ffast-math -DTRIBOX_SIMD=0" | gcc-11-O1 | "gcc-11-O3 -march=native") ;;
    clang-14-O0 | clang-14-O2 | clang-14-Os | clang-14-Ofast | "clang-14-O3 -march=native -DTRIBOX_SIMD=0") ;;
    clang-16-O1 | clang-16-Oz | clang-16-Ofast | "clang-16-O3 -march=native" | "clang-16-O2 -DTRIBOX_SIMD=0") ;;
    clang-19-O1 | clang-19-Os | "clang-19-O3 -march=native" | "clang-19-O2 -ffast-math"*) ;;
    *) return 1 ;;
    esac
}
for cc in $gccs $clangs; do
    for simd in "" " -DTRIBOX_SIMD=0"; do
        for flags in -O0 -O1 -O2 -O3 "-O3 -march=native" -Os -Oz -Ofast "-O2 -ffast-math"; do
            [ "$cc $flags" = "gcc-11 -Oz" ] && continue # gcc 12 was the first
            usual $cc "$flags$simd" || continue
            traps "$part $modes" $cc "$flags$simd"
        done
    done
    also c "up flush" $cc "-O3 -ffast-math -march=native -std=gnu99" # and all questions
done
c "eighth up flush" clang-22 "-O3 -ffast-math -march=native -std=gnu99"
also traps "" gcc-12 -O2
also traps "" clang-22 -O2
traps $part gcc-12 "-Ofast -march=native"
# arithmetic is moved above tests, as it is by default for most other processors
traps "$part up flush" gcc-12 "-O3 -ffast-math -march=native -fschedule-insns -fsched2-use-superblocks"
traps "$part up flush" gcc-12 "-O2 -fschedule-insns -fsched-pressure -funroll-all-loops"
also traps $part clang-22 "-Ofast -march=native"

# ---- every standard

for std in c99 c2x gnu99 c11 c17; do
    [[ $std = c99 || $std = c2x ]] || more || continue
    c $part gcc-12 "-O0 -std=$std"
    c $part clang-22 "-O0 -std=$std"
done
for std in c++98 c++26 c++11 c++14 c++17 c++20 c++23; do
    [[ $std = c++98 || $std = c++26 ]] || more || continue
    [ $std = c++26 ] || golden "" $part g++-12 -I. -x c++ tests/golden.c -x none -std=$std -O0 -lm
    golden "" $part clang++-22 -I. -x c++ tests/golden.c -x none -std=$std -O0 -lm
done

# ---- flags that let a compiler take liberties, one by one

for flags in -ffinite-math-only "-fno-honor-nans -fno-honor-infinities" -funsafe-math-optimizations \
    "-fassociative-math -fno-signed-zeros -fno-trapping-math" -freciprocal-math -frounding-math \
    -ffp-contract=fast -ffp-contract=off "-fno-strict-aliasing -fwrapv" -ftrapv -flto; do
    for cc in clang-19 clang-22 gcc-12; do
        case "$cc $flags" in
        "gcc-12 -fno-honor-nans"* | "clang-19 -flto") continue ;; # not gcc's word; its plugin is another version's
        "clang-22 -flto") c "$part $modes" $cc "-O2 $flags -fuse-ld=lld-22" && continue ;;
        "clang-19 -ffinite"* | clang-22\ * | "gcc-12 -ffinite"* | "gcc-12 -funsafe"* | "gcc-12 -fassoc"* | "gcc-12 -flto") ;;
        *) more || continue ;;
        esac
        c "$part $modes" $cc "-O2 $flags"
    done
done
c "$part $modes" clang-22 "-O2 -ffp-model=aggressive"
also c "$part $modes" clang-22 "-O2 -ffp-model=strict"
c "$part $modes" clang-22 "-O2 -ffast-math -mdaz-ftz"
c "$part $modes" clang-22 "-O2 -mrecip=all -ffast-math"
for flags in -fsingle-precision-constant "-mrecip -ffast-math" -fpack-struct -fpack-struct=1 \
    "-funsigned-char -fshort-enums"; do
    c "$part up flush" gcc-12 "-O2 $flags"
done
for flags in "-fsingle-precision-constant -ffast-math" -fexcess-precision=standard -fpack-struct=4 -fsigned-char; do
    also c "$part up flush" gcc-12 "-O2 $flags"
done
for cc in gcc-12 clang-22; do
    also c "$part up flush" $cc "-O2 -msse4.2"
    cpu_has fma && c "$part up flush" $cc "-O2 -mfma -ffp-contract=fast"
    cpu_has avx2 && also c "$part up flush" $cc "-O3 -mavx2 -mfma -ffast-math"
done

# ---- 32 bits; x87: every intermediate in 80 bits, or not, as the compiler likes, or cut to 53 or 24

for cc in gcc-12 clang-22 clang-14; do
    [ $cc != clang-14 ] || more || continue
    c "$part $modes" $cc "-m32 -O2 -msse2 -mfpmath=sse"
    also c "$part up" $cc "-m32 -Ofast -msse2 -mfpmath=sse"
done
for flags in -O2 -Ofast -O0 -O3 -Os; do
    [[ $flags = -O2 || $flags = -Ofast ]] || more || continue
    c "$part nearest up down zero x87-53 x87-24" gcc-12 "-m32 -mfpmath=387 -mno-sse $flags"
done
also c "x87-24" gcc-12 "-m32 -mfpmath=387 -mno-sse -O2"
c "$part x87-24" gcc-12 "-m32 -O2 -mfpmath=387 -mpc32"
c "$part x87-24" gcc-12 "-mfpmath=387 -O2"
also c "$part x87-24" gcc-12 "-m32 -mfpmath=387 -mno-sse -O2 -ffloat-store"
also c "$part x87-24" clang-14 "-m32 -mno-sse -O2"
c "$part x87-24" clang-22 "-m32 -mno-sse -O2 -ffast-math"

# ---- what may stand before the header: other compilers' branches, packing, other people's macros

msvc="$before -DBEFORE_MSVC -fno-strict-aliasing" # nor does MSVC reason about types
for cc in gcc-12 clang-22 clang-19; do
    traps "$part up flush" $cc "-O2 $msvc"
    [ $cc != clang-19 ] || more || continue
    c "$part up flush" $cc "-O3 -ffast-math $before -DBEFORE_NO_GNU"
    c "$part up" $cc "-O2 $before -DBEFORE_PACK=1"
    for flags in -O0 "-O3 -ffast-math"; do
        also c "$part up flush" $cc "$flags $msvc"
    done
    for flags in -O0 -O2; do
        also c "$part up flush" $cc "$flags $before -DBEFORE_NO_GNU"
    done
    also c "$part up" $cc "-O3 -march=native $before -DBEFORE_PACK=4"
    also c $part $cc "-O1 $before -DBEFORE_QT -DTRIBOX_SIMD=0"
done
c "$part up flush" clang-22 "-O3 -ffast-math $msvc"
c $part clang-22 "-O1 $before -DBEFORE_QT"
if [ -e /usr/include/term.h ]; then
    c $part gcc-12 "-O1 $before -DBEFORE_TERM"
fi

# ---- small compilers

c $part tcc
c $part pcc "-w"
chibicc_golden() { # Debian's package has no headers of its own
    local shim=$CHECK_DIR/chibicc
    mkdir -p "$shim"
    printf '%s\n' 'typedef unsigned long size_t;' 'typedef long ptrdiff_t;' '#undef NULL' \
        '#define NULL ((void *)0)' >"$shim/stddef.h"
    printf '%s\n' 'typedef struct { unsigned gp, fp; void *overflow, *save; } __va;' 'typedef __va va_list[1];' \
        'typedef va_list __gnuc_va_list;' >"$shim/stdarg.h"
    printf '%s\n' '#define FLT_EVAL_METHOD 0' '#define FLT_MANT_DIG 24' '#define DBL_MANT_DIG 53' \
        '#define FLT_MAX 0x1.fffffep+127f' '#define FLT_MIN 0x1p-126f' '#define DBL_MAX 0x1.fffffffffffffp+1023' \
        '#define DBL_MIN 0x1p-1022' >"$shim/float.h"
    chibicc -I"$shim" -I. -c tests/golden.c -o "$shim/golden.o" && gcc -z execstack "$shim/golden.o" \
        -o "$shim/golden" -lm && "$shim/golden" few up flush
}
export -f chibicc_golden
if [[ "golden: chibicc" =~ $pattern ]] && have chibicc; then
    job "golden: chibicc" chibicc_golden
fi

# ---- HIP, compiled for a device by clang, and for the host, with the few words of its runtime that there are here

hip() { # flags
    printf '%s\n' '#define __host__ __attribute__((host))' '#define __device__ __attribute__((device))' \
        '#define __global__ __attribute__((global))' \
        'typedef struct dim3 { unsigned x, y, z; } dim3;' 'typedef struct ihipStream_t *hipStream_t;' \
        'extern "C" int hipLaunchKernel(const void *, dim3, dim3, void **, unsigned long, hipStream_t);' \
        '#include "tribox.h"' '#include "every_function.h"' \
        '__global__ void ask(int *out) { *out = every_function(); }' >"$CHECK_DIR/device.hip"
    sed 's/^static /static __host__ __device__ /' tests/compile/every_function.h >"$CHECK_DIR/every_function.h"
    clang-22 -x hip -nogpulib -nogpuinc -I. -I"$CHECK_DIR" -Werror -Wno-unused-function "$@" -S \
        "$CHECK_DIR/device.hip" -o /dev/null
}
export -f hip
if have clang-22; then
    for flags in "--cuda-device-only --offload-arch=gfx90a -O2" "--cuda-host-only -O2" \
        "--cuda-device-only --offload-arch=gfx1100 -O3 -ffast-math"; do
        [[ $flags != *gfx1100* ]] || more || continue
        # shellcheck disable=SC2086
        [[ "hip: $flags" =~ $pattern ]] && job "hip: compiled, clang-22 $flags" hip $flags
    done
fi

# ---- the whole suite where floating-point arithmetic is least to be trusted

suite() { # compiler, flags
    make -s test B="$CHECK_DIR/suite/$1${2//[^[:alnum:]]/}" CC="$1" CFLAGS="$2" # make splits names at spaces
}
export -f suite
suites() { # compiler, flags
    [[ "make test: $*" =~ $pattern ]] && have "$1" && job "make test: $*" suite "$@"
}
suites clang-22 "-O2 -ffast-math -DTEST_SCALE=4"
suites gcc-12 "-O2 -m32 -mfpmath=387 -mno-sse -DTEST_SCALE=4" # not -Ofast: the tests' own conversions would not round
if more; then
    suites gcc-12 "-Ofast -march=native"
    suites clang-14 "-Ofast -march=native"
    suites clang-19 "-O3 -ffast-math -march=native"
    suites clang-22 "-O2 -DTRIBOX_SIMD=0"
fi

# ---- emulated machines; static, so that the emulator needs no libraries of theirs

export QEMU_LD_PREFIX=/usr/alpha-linux-gnu
emulated() { # emulator, compiler, flags...
    local machine=$1 cc=$2 flags=$3 simd static=-static kind=golden
    case $machine in # elsewhere the emulator knows no flags, or no masks
    aarch64 | s390x | riscv64 | ppc64le | mips64el | sparc64) kind=traps ;;
    esac
    [ $machine = alpha ] && static= # static programs, hello too, crash in this emulator (qemu 7.2)
    [ $machine = hppa ] && static="-static -ffunction-sections" # else calls beyond 256 KB go astray: no room for stubs
    build $kind "qemu-$machine" "few up down" $cc $static -w -I. tests/$kind.c -O3 -ffast-math $flags -lm
    simd=${4:-}
    if [ -n "$simd" ]; then
        golden "qemu-$machine" "few up" $cc $static -I. tests/golden.c -O2 -DTRIBOX_SIMD=1 $flags $simd -lm
    fi
    if more || [ -z "$simd" ]; then
        golden "qemu-$machine" few $cc $static -I. tests/golden.c -O1 $flags -lm
    fi
    if more; then
        golden "qemu-$machine" few $cc $static -I. tests/golden.c -O0 $flags -lm
        golden "qemu-$machine" few $cc $static -I. tests/golden.c -O2 $flags -lm
        golden "qemu-$machine" "few up down zero" $cc $static -I. tests/golden.c -Os $flags -lm
    fi
}
# vectors by name where gcc has them by instructions: elsewhere they are the same scalar code, slower
emulated aarch64 aarch64-linux-gnu-gcc "" " "
emulated s390x s390x-linux-gnu-gcc "" "-march=z14"
emulated riscv64 riscv64-linux-gnu-gcc ""
emulated ppc64le powerpc64le-linux-gnu-gcc "" " "
emulated ppc64 powerpc64-linux-gnu-gcc "" "-maltivec"
emulated ppc powerpc-linux-gnu-gcc "" " "
emulated mips mips-linux-gnu-gcc ""
emulated mipsel mipsel-linux-gnu-gcc ""
emulated mips64el mips64el-linux-gnuabi64-gcc ""
emulated arm arm-linux-gnueabi-gcc ""
emulated arm arm-linux-gnueabihf-gcc "" "-mfpu=neon"
emulated hppa hppa-linux-gnu-gcc ""
emulated m68k m68k-linux-gnu-gcc ""
emulated sparc64 sparc64-linux-gnu-gcc ""
emulated alpha alpha-linux-gnu-gcc -mieee # which -ffast-math turns off in Debian's gcc; the header refuses to do without
golden qemu-aarch64 "few flush" aarch64-linux-gnu-gcc -static -I. tests/golden.c -O3 -march=armv8.2-a+sve -ffast-math -lm
golden qemu-aarch64 "few flush up" aarch64-linux-gnu-gcc -static -I. tests/golden.c -O2 -lm
golden qemu-arm "few flush" arm-linux-gnueabihf-gcc -static -I. tests/golden.c -O2 -mfpu=neon -lm
for cc in clang-22 clang-19; do # with gcc's C library for that machine
    build traps qemu-aarch64 "few flush up" $cc --target=aarch64-linux-gnu -static -w -I. tests/traps.c -O3 \
        -ffast-math -lm
    [ $cc = clang-22 ] || more || continue
    also golden qemu-aarch64 "few flush up" $cc --target=aarch64-linux-gnu -static -I. tests/golden.c -O2 -lm
    golden qemu-arm "few flush" $cc --target=arm-linux-gnueabihf -mfpu=neon -static -I. tests/golden.c -O2 \
        -ffast-math -lm
    golden qemu-riscv64 "few up" $cc --target=riscv64-linux-gnu -static -I. tests/golden.c -O2 -ffast-math -lm
    # optimised, clang has mdebr, which this emulator computes wrongly (findings/qemu-s390x-multiplies-by-a-double.sh)
    golden qemu-s390x "few up" $cc --target=s390x-linux-gnu -static -I. tests/golden.c -O0 -ffast-math -lm
    golden qemu-ppc64le "few up" $cc --target=powerpc64le-linux-gnu -static -I. tests/golden.c -O2 -ffast-math -lm
done

# ---- Windows: MinGW, with <windows.h> first, too; clang as MSVC, without Microsoft's SDK

if [ -z "${PLATFORMS_COUNT:-}" ] && have wine && [[ "golden: windows msvc mingw /O wine" =~ $pattern || $pattern = . ]]; then
    wait
    wine wineboot --init </dev/null >/dev/null 2>&1 # once, so that parallel runs find their folder ready
fi
suffix=.exe
mingw=x86_64-w64-mingw32-gcc
for flags in -O2 -Ofast -O0 "-O3 -march=x86-64-v2"; do
    [[ $flags = -O2 || $flags = -Ofast ]] || more || continue
    # shellcheck disable=SC2086
    golden wine "$part up" $mingw -static -I. tests/golden.c $flags
done
# shellcheck disable=SC2086
golden wine $part $mingw -static -I. tests/golden.c -O1 $before -DBEFORE_WINDOWS
suffix=

msvc() { # clang-cl's flags... No probes of the stack: their code is Microsoft's
    local out
    out=$(mktemp -d "$CHECK_DIR/msvc.XXXXXX")
    llvm-dlltool -d tests/windows.def -l "$out/kernel32.lib" -m i386:x86-64
    clang-cl-22 /c /I. /GS- /Gs999999 /W4 /WX -Wno-unused-function /DGOLDEN_FREESTANDING /DGOLDEN_ASK_FEW "$@" \
        tests/golden.c "/Fo$out/golden.obj" &&
        lld-link-22 /nodefaultlib /subsystem:console /entry:windows_entry /stack:1048576,1048576 "$out/golden.obj" "$out/kernel32.lib" \
            "/out:$out/golden.exe" &&
        wine "$out/golden.exe"
    local status=$?
    rm -rf "$out"
    return $status
}
export -f msvc
if have clang-cl-22 && have lld-link-22 && have wine && have llvm-dlltool; then
    for flags in /O1 "/O2 /fp:fast" "/O2 /Zp1" "/O2 /fp:fast /DTRIBOX_SIMD=0" /Od /O2 "/O2 /arch:AVX2" "/O2 /DTRIBOX_SIMD=0"; do
        [[ $flags = /O1 || $flags = */fp:fast* || $flags = */Zp1 ]] || more || continue
        name="golden: windows msvc: clang-cl-22 $flags"
        # shellcheck disable=SC2086
        [[ $name =~ $pattern ]] && job "$name" msvc $flags
    done
fi

# ---- WebAssembly without any library, run by node

wasm() { # clang, flags...
    local cc=$1
    shift
    [[ "golden: wasm32 $cc $*" =~ $pattern ]] && have node && have $cc || return 0
    builds=$((builds + 1))
    job "golden: wasm32 $cc $*" built_and_run "node tests/check_wasm.js" "$dir/$builds.wasm" "" \
        "$cc" --target=wasm32 -nostdlib -ffreestanding -I. -DGOLDEN_FREESTANDING -DGOLDEN_ASK_FEW tests/golden.c "$@" \
        -Wl,--no-entry -Wl,--export=golden_hash_high -Wl,--export=golden_hash_low -Wl,--export=golden_wrong \
        -Wl,--export=golden_expected_high -Wl,--export=golden_expected_low
}
wasm clang-14 -O2
wasm clang-22 -O3 -ffast-math
wasm clang-22 -O2 -msimd128 -DTRIBOX_SIMD=1
if more; then
    for cc in clang-14 clang-22; do
        wasm $cc -O0
        wasm $cc -O2 -msimd128
        wasm $cc -O2 -msimd128 -DTRIBOX_SIMD=1 -ffast-math
    done
fi

check_end
