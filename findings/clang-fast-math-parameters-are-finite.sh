#!/usr/bin/env bash
# clang 19 and later with -ffast-math fold tests of the bits of a float parameter: it is declared neither NaN nor infinite.
#
# The function copies the bits of its parameter into an integer and compares them with those of infinity. -ffast-math is
# about arithmetic on floats; but every float parameter and result carries nofpclass(nan inf) in LLVM's code, from which
# the optimiser knows what the bits cannot be. clang 14 and 16, and gcc 12, say 1.
#
# Seen with clang 22.1.8 and 19.1.7, -O1 and up with -ffast-math or -ffinite-math-only, x86-64. Exits with 1 if that is no longer so.
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
cat >infinite.c <<'C'
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static __attribute__((noinline)) int is_infinite(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits & 0x7fffffffu) == 0x7f800000u;
}

int main(void)
{
    volatile uint32_t bits = 0x7f800000u;
    uint32_t copy = bits;
    float x;
    memcpy(&x, &copy, sizeof x);
    printf("%d", is_infinite(x));
    return 0;
}
C
clang-22 -O1 infinite.c -o plain
clang-22 -O1 -ffast-math infinite.c -o fast
said="$(./plain) $(./fast)"
attribute=$(clang-22 -O1 -ffast-math -Xclang -disable-llvm-passes -S -emit-llvm infinite.c -o - | grep -c 'nofpclass(nan inf)' || true)
echo "the bits of infinity are those of infinity: plain, -ffast-math say $said; nofpclass on $attribute line(s)"
[ "$said" = "1 0" ] && [ "$attribute" -ge 1 ]
