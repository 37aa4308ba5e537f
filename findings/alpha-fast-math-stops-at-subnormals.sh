#!/usr/bin/env bash
# Debian's gcc for Alpha has -mieee by default, but -ffast-math turns it off: then a subnormal operand stops the program.
#
# gcc's manual says that IEEE arithmetic is off on Alpha unless -mieee is given; Debian's compiler defines _IEEE_FP without it.
# Under -ffast-math (and -ffinite-math-only) it no longer does: instructions come without software completion, and an addition
# of a subnormal float, or of a NaN or an infinity, is a SIGFPE, where other processors flush or go on. -ffast-math -mieee
# computes.
#
# Seen with gcc 12.2.0 for alpha, qemu-user 7.2. Exits with 1 if that is no longer so.
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
fetch gcc-12-alpha-linux-gnu=12.2.0-13cross1 cpp-12-alpha-linux-gnu=12.2.0-13cross1 binutils-alpha-linux-gnu=2.40-2 \
    libgcc-12-dev-alpha-cross=12.2.0-13cross1 libc6.1-dev-alpha-cross=2.36-8cross1 libc6.1-alpha-cross=2.36-8cross1 \
    qemu-user=1:7.2+dfsg-7+deb12u18+b3
export QEMU_LD_PREFIX=/usr/alpha-linux-gnu
[ -d $QEMU_LD_PREFIX ] || QEMU_LD_PREFIX=$here/root/usr/alpha-linux-gnu
cat >add.c <<'C'
#include <stdio.h>

int main(int argc, char **argv)
{
    union {
        unsigned bits;
        float number;
    } subnormal;
    volatile float sum;
    (void)argv;
    subnormal.bits = (unsigned)argc;
    sum = subnormal.number + 1.0f;
    printf("%g", (double)sum);
    return 0;
}
C
for flags in -O1 "-O1 -ffast-math" "-O1 -ffast-math -mieee"; do
    # shellcheck disable=SC2086
    alpha-linux-gnu-gcc-12 $flags add.c -o add
    status=0
    sum=$(qemu-alpha ./add 2>/dev/null) || status=$?
    said="${said:-}${said:+ }$sum,$status"
done
echo "1 + 2^-149 and the exit status: plain, -ffast-math, with -mieee: $said"
[ "$said" = "1,0 ,136 1,0" ]
