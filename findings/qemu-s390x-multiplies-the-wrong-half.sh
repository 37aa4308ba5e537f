#!/usr/bin/env bash
# qemu-user 7.2 multiplies two floats to a double wrongly on s390x: mdebr reads the wrong half of a register, 1.5 * 1.5 is 0.
#
# A float lies in the upper half of a floating-point register there. mdebr (multiply short to long) takes it from the lower
# half of its first operand, in Debian 12's emulator, so the product is whatever lay there; here the registers were cleared
# first. clang -O2 writes the instruction for (double)a * b. Multiplied as doubles, the same numbers come out right. A
# program that "fails on s390x" under that emulator may be right.
#
# Seen with qemu-user 7.2 and gcc 12.2.0 for s390x. Exits with 1 if that is no longer so.
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
fetch gcc-12-s390x-linux-gnu=12.2.0-14cross1 cpp-12-s390x-linux-gnu=12.2.0-14cross1 binutils-s390x-linux-gnu=2.40-2 \
    libgcc-12-dev-s390x-cross=12.2.0-14cross1 libc6-dev-s390x-cross=2.36-8cross1 libc6-s390x-cross=2.36-8cross1 \
    qemu-user=1:7.2+dfsg-7+deb12u18+b3
cat >product.c <<'C'
#include <stdio.h>

int main(void)
{
    volatile float a = 1.5f;
    double narrow;
    double wide;
    __asm__("lzdr %%f0\n lzdr %%f2\n le %%f0,%1\n le %%f2,%1\n mdebr %%f0,%%f2\n std %%f0,%0"
            : "=m"(narrow) : "m"(a) : "f0", "f2");
    __asm__("ldeb %%f0,%1\n ldeb %%f2,%1\n mdbr %%f0,%%f2\n std %%f0,%0" : "=m"(wide) : "m"(a) : "f0", "f2");
    printf("%g,%g", narrow, wide);
    return 0;
}
C
s390x-linux-gnu-gcc-12 -static product.c -o product
said=$(qemu-s390x ./product)
echo "1.5 * 1.5 by mdebr, by mdbr: $said"
[ "$said" = "0,2.25" ]
