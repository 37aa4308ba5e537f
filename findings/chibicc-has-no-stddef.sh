#!/usr/bin/env bash
# Debian's chibicc cannot compile #include <stddef.h>: the package has the compiler, but not its headers.
#
# chibicc looks for stddef.h, stdarg.h and float.h in include/ beside its program; the package ships neither, and the
# C library leaves them to the compiler. gcc's own do not do: they ask for __builtin_va_list, which chibicc has not.
#
# Seen with chibicc 0+git20220719+ds-4. Exits with 1 if that is no longer so.
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
fetch chibicc=0+git20220719+ds-4
printf '#include <stddef.h>\nsize_t n;\n' >unit.c
if chibicc -c unit.c -o unit.o 2>said; then
    echo "it compiled"
    exit 1
fi
echo "it says: $(tail -n 1 said | sed 's/^ *//')"
grep -q 'stddef.h: cannot open file' said
printf 'unsigned long n;\n' >unit.c
chibicc -c unit.c -o unit.o
