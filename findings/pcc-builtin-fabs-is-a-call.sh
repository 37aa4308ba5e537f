#!/usr/bin/env bash
# pcc's __builtin_fabs calls fabs, so a file that includes nothing and calls nothing needs -lm.
#
# gcc and clang make one instruction of it, at every level, without a library.
#
# Seen with pcc 1.2.0~DEVEL+20220331-1, x86-64. Exits with 1 if that is no longer so.
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
fetch pcc=1.2.0~DEVEL+20220331-1
printf 'double magnitude(double x) { return __builtin_fabs(x); }\n' >unit.c
pcc -O -c unit.c -o unit.o 2>/dev/null
calls=$(nm unit.o | awk '$1 == "U" { print $2 }' | tr '\n' ' ')
echo "undefined in the object: $calls"
[ "$calls" = "fabs " ]
