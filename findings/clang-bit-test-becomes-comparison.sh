#!/usr/bin/env bash
# clang 19 and later turn an integer test of a float's bits into a float comparison, which denormals-are-zero changes.
#
# The function copies a float's bits into an integer and asks whether they are zero but for the sign. No arithmetic on
# floats stands in the source. With DAZ set, 1e-40, whose bits are not zero, is said to be zero: the compiler asks with
# ucomiss or cmpss. clang 14 and 16, and gcc 12, ask the bits.
#
# Seen with clang 22.1.8 and 19.1.7, -O1 and up, x86-64. Exits with 1 if that is no longer so.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"

# Debian's package of that version: the installed one, or unpacked here
fetch() { # package=version...
    local package
    for package in "$@"; do
        if [ "$(dpkg-query -W -f='${Version}' "${package%%=*}" 2>/dev/null)" != "${package#*=}" ]; then
            apt-get -qq download "$package"
            dpkg -x "${package%%=*}"_*.deb root
        fi
    done
    export PATH=$here/root/usr/bin:$PATH
    export LD_LIBRARY_PATH=$here/root/usr/lib/x86_64-linux-gnu:$here/root/usr/lib/llvm-22/lib:$here/root/usr/lib/llvm-19/lib
}
fetch clang-22=1:22.1.8-1~deb12u1 libclang-common-22-dev=1:22.1.8-1~deb12u1 libclang-cpp22=1:22.1.8-1~deb12u1 \
    libllvm22=1:22.1.8-1~deb12u1
cat >bits.c <<'C'
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <xmmintrin.h>

static int is_zero(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits & 0x7fffffffu) == 0;
}

int main(void)
{
    volatile float tiny = 1e-40f;
    _mm_setcsr(_mm_getcsr() | 0x40u);
    printf("%d", is_zero(tiny));
    return 0;
}
C
for level in -O0 -O1 -O2; do
    clang-22 $level bits.c -o bits
    said="${said:-}${said:+ }$(./bits)"
done
echo "1e-40 is zero, by its bits: -O0, -O1, -O2 say $said"
[ "$said" = "0 1 1" ]
