#!/usr/bin/env bash
# clang computes in vector lanes that nobody reads, with numbers that the source never multiplies: overflow is raised.
#
# The source copies lane 1, which is 2, into all lanes, squares them and reads lane 3. clang sees that one lane suffices and
# squares the vector as it was before the copies: lane 0, 1e30, too. FE_OVERFLOW is raised (-fno-trapping-math is clang's
# default: nobody is assumed to read the flags), and a program that has unmasked the exception is stopped. The answer is
# right. gcc 12 squares the copies.
#
# Seen with clang 22.1.8, 19.1.7 and 14, -O1 and up, x86-64. Exits with 1 if that is no longer so.
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
cat >lane.c <<'C'
#include <fenv.h>
#include <stdio.h>

typedef float vector __attribute__((vector_size(16)));

static __attribute__((noinline)) float square_of_lane_1(vector x)
{
    vector y = {x[1], x[1], x[1], x[1]};
    y = y * y;
    return y[3];
}

int main(void)
{
    volatile float large = 1e30f;
    const vector x = {large, 2.0f, 3.0f, 4.0f};
    float square;
    feclearexcept(FE_ALL_EXCEPT);
    square = square_of_lane_1(x);
    printf("%d,%g", fetestexcept(FE_OVERFLOW) != 0, (double)square);
    return 0;
}
C
for level in -O0 -O1 -O2; do
    clang-19 $level lane.c -o lane -lm
    said="${said:-}${said:+ }$(./lane)"
done
echo "overflow raised, and the square of 2: -O0, -O1, -O2 say $said"
[ "$said" = "0,4 1,4 1,4" ]
