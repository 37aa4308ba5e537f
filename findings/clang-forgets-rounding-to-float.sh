#!/usr/bin/env bash
# clang 22 with -ffast-math takes (double)(float)x for x: a double that is rounded to float and widened again keeps all its bits.
#
# So the usual test whether a double is a float, (double)(float)x == x, is always true, and the lower half of a number split by
# that rounding is always 0. It takes all that -ffast-math means: without -ffinite-math-only, which has nothing to do with
# it, the rounding stays. clang 14, 16 and 19 and gcc 12 round with -ffast-math, too.
#
# Seen with clang 22.1.8, -O1 and up, x86-64. Exits with 1 if that is no longer so.
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
    export LD_LIBRARY_PATH=$here/root/usr/lib/x86_64-linux-gnu:$here/root/usr/lib/llvm-22/lib
}
fetch clang-22=1:22.1.8-1~deb12u1 libclang-common-22-dev=1:22.1.8-1~deb12u1 libclang-cpp22=1:22.1.8-1~deb12u1 \
    libllvm22=1:22.1.8-1~deb12u1
cat >rounded.c <<'C'
#include <stdio.h>

__attribute__((noinline)) static double rounded(double x)
{
    return (double)(float)x;
}

__attribute__((noinline)) static int is_float(double x)
{
    return (double)(float)x == x;
}

int main(void)
{
    volatile double tenth = 0.1;
    printf("%.17g %d\n", rounded(tenth), is_float(tenth));
    return 0;
}
C
clang-22 -O2 rounded.c -o exact
clang-22 -O2 -ffast-math rounded.c -o fast
echo "clang 22 -O2:             (double)(float)0.1, and is 0.1 a float: $(./exact)"
echo "clang 22 -O2 -ffast-math: the same:                               $(./fast)"
[ "$(./exact)" = "0.10000000149011612 0" ] && [ "$(./fast)" = "0.10000000000000001 1" ]
