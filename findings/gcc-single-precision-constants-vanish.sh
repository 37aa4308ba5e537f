#!/usr/bin/env bash
# gcc -fsingle-precision-constant makes 0 of 1e-290 and infinity of 1e300, in double variables, too.
#
# The option is meant to keep float code from being promoted to double. It reads every unsuffixed constant as a float,
# also the one that initialises a double, so what a float cannot hold is lost. The compiler says so as a warning
# (-Woverflow). A program that needs such doubles builds them from their bits.
#
# Seen with gcc 12.2.0, x86-64. Exits with 1 if that is no longer so.
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
cat >constants.c <<'C'
#include <stdio.h>

int main(void)
{
    volatile double least = 1e-290;
    volatile double large = 1e300;
    printf("%g %g", least, large);
    return 0;
}
C
gcc-12 -w constants.c -o plain
gcc-12 -w -fsingle-precision-constant constants.c -o single
said="$(./plain), $(./single)"
echo "1e-290 and 1e300: plain, -fsingle-precision-constant: $said"
[ "$said" = "1e-290 1e+300, 0 inf" ]
