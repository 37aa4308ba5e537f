#!/usr/bin/env bash
# clang -O2 divides by zero where the source does not: vectorised, a guarded division is made in every lane.
#
# The loop divides only where the divisor is not zero. clang assumes that nobody reads the exception flags
# (-fno-trapping-math is its default), divides in all lanes and selects afterwards: FE_DIVBYZERO is raised, and a program
# that has unmasked it is stopped. gcc 12 (-ftrapping-math by default) does not; -O1, which does not vectorise, neither.
#
# Seen with clang 22.1.8, 19.1.7, 16 and 14, -O2, x86-64. Exits with 1 if that is no longer so.
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
fetch clang-19=1:19.1.7-3~deb12u1 libclang-common-19-dev=1:19.1.7-3~deb12u1 libclang-cpp19=1:19.1.7-3~deb12u1 \
    libllvm19=1:19.1.7-3~deb12u1
cat >divide.c <<'C'
#include <fenv.h>
#include <stdio.h>

int main(void)
{
    volatile float zero = 0.0f;
    float divisor[8];
    float quotient[8];
    int i;
    for (i = 0; i < 8; i++) {
        divisor[i] = i % 2 ? zero : 2.0f;
    }
    feclearexcept(FE_ALL_EXCEPT);
    for (i = 0; i < 8; i++) {
        quotient[i] = divisor[i] != 0.0f ? 1.0f / divisor[i] : 0.0f;
    }
    i = fetestexcept(FE_DIVBYZERO) != 0;
    printf("%d,%g", i, (double)(quotient[0] + quotient[1]));
    return 0;
}
C
for level in -O1 -O2; do
    clang-19 $level divide.c -o divide -lm
    said="${said:-}${said:+ }$(./divide)"
done
echo "divide-by-zero raised, and the sum: -O1, -O2 say $said"
[ "$said" = "0,0.5 1,0.5" ]
