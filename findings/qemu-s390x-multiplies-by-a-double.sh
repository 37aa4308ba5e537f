#!/usr/bin/env bash
# qemu-user 7.2 multiplies two floats to a double wrongly on s390x: mdebr takes its first factor for a double, 1.5 * 1.5 is 0.1875.
#
# mdebr (multiply short to long) has two floats, each in the upper half of a floating-point register. Debian 12's emulator reads
# the whole first register as a double: the bits of 1.5f, then zeros, are the double 0.125. clang -O2 writes the instruction
# for (double)a * b. Multiplied as doubles (mdbr), the same numbers come out right. A program that "fails on s390x" under that
# emulator may be right.
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
[ "$said" = "0.1875,2.25" ]
