#!/usr/bin/env bash
# gcc moves assembly, and a vector maximum behind it, out of a loop and before the test that they stand behind: a flag is raised.
#
# The loop takes the maximum only where it is allowed, and an empty assembly statement before it was to keep it there. Such a
# statement, if not volatile, may leave the loop (gcc's manual says so), and gcc, though -ftrapping-math is its default,
# takes along __builtin_ia32_maxps, which raises FE_INVALID for NaN: a builtin of the processor counts as something that
# raises nothing. A program that has unmasked the exception is stopped by an operation that it never asked for. Volatile
# assembly stays, and with it what depends on it.
#
# Seen with gcc 12.2.0, -O1 and -O2, x86-64. Exits with 1 if that is no longer so.
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
fetch gcc-12=12.2.0-14+deb12u1
cat >loop.c <<'C'
#include <fenv.h>
#include <stdio.h>

typedef float vector __attribute__((vector_size(16)));

static __attribute__((noinline)) vector sum(vector x, vector y, const int *forbidden, int n)
{
    vector s = {0};
    int i;
    for (i = 0; i < n; i++) {
        if (!forbidden[i]) {
            vector z = x;
            __asm__ KIND("" : "+x"(z));
            s += __builtin_ia32_maxps(z, y);
        }
    }
    return s;
}

int main(void)
{
    const int forbidden[4] = {1, 1, 1, 1};
    volatile float zero = 0.0f;
    const vector nan = {zero / zero};
    vector s;
    feclearexcept(FE_ALL_EXCEPT);
    s = sum(nan, nan, forbidden, 4);
    printf("%d,%g", fetestexcept(FE_INVALID) != 0, (double)s[0]);
    return 0;
}
C
for level in -O1 -O2; do
    for kind in "" volatile; do
        gcc-12 $level "-DKIND=$kind" loop.c -o loop -lm
        said="${said:-}${said:+ }$(./loop)"
    done
done
echo "invalid raised, and the sum: -O1 plain and volatile, -O2 plain and volatile say $said"
[ "$said" = "1,0 0,0 1,0 0,0" ]
