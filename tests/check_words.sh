#!/usr/bin/env bash
# The header's own words - its parameters, fields, locals and private macros - are no macros of the headers that
# people include before it. Reads the macros of every header below that this machine has. Run from the
# repository's root.
set -u

here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT

# identifiers of the code, without comments, strings, what begins with our prefixes, and the compilers' own
sed -e 's/"[^"]*"//g' tribox.h | gcc -fpreprocessed -dD -E -P -x c - 2>/dev/null | grep -v '^# *error' |
    tee "$here/code" | grep -o '[A-Za-z_][A-Za-z_0-9]*' | grep -Ev '^(tribox|TRIBOX|tbx|TBX)_|^__' | sort -u >"$here/words"
# only these are hit by a macro that takes arguments
grep -o '[A-Za-z_][A-Za-z_0-9]* *(' "$here/code" | tr -d ' (' | sort -u >"$here/called"
# what is meant: the standard headers' names, and macros that only preprocessor lines ask for
sed -e ':join' -e '/\\$/{N;s/\\\n//;b join' -e '}' tribox.h |
    sed -n 's/^ *# *\(if\|elif\|ifdef\|ifndef\|error\|pragma\)\(.*\)/\2/p' | grep -o '[A-Za-z_][A-Za-z_0-9]*' |
    sort -u >"$here/asked"
printf '#include <stdint.h>\n#include <stddef.h>\n#include <float.h>\n' | gcc -dM -E -x c - |
    sed -n 's/^#define \([A-Za-z_0-9]*\).*/\1/p' | sort -u >"$here/meant"
printf '%s\n' inline const static unused noinline cold __declspec __attribute__ __asm__ >>"$here/meant"

macros() { # compiler, headers...
    local cc=$1 header
    shift
    for header in "$@"; do
        printf '#include <stdio.h>\n#include <%s>\n' "$header" >"$here/unit.c"
        "$cc" -dM -E "$here/unit.c" 2>/dev/null |
            sed -n -e "s|^#define \([A-Za-z_0-9]*\)(.*|\1 ( <$header>|p" -e "s|^#define \([A-Za-z_0-9]*\) .*|\1 = <$header>|p" \
                -e "s|^#define \([A-Za-z_0-9]*\)$|\1 = <$header>|p"
    done
}
{
    macros gcc assert.h complex.h ctype.h curses.h term.h dirent.h elf.h errno.h fenv.h inttypes.h limits.h locale.h math.h \
        net/if.h netinet/in.h obstack.h poll.h pthread.h resolv.h search.h setjmp.h signal.h stdbool.h stdlib.h \
        string.h strings.h sys/ioctl.h sys/mman.h sys/param.h sys/socket.h sys/stat.h sys/sysmacros.h sys/time.h \
        sys/wait.h termios.h tgmath.h threads.h time.h ucontext.h unistd.h wchar.h immintrin.h mpi.h gmp.h
    command -v x86_64-w64-mingw32-gcc >/dev/null &&
        macros x86_64-w64-mingw32-gcc windows.h winsock2.h ole2.h commctrl.h d3d9.h rpc.h math.h
    sed -n 's|^#define \([A-Za-z_0-9]*\) .*|\1 = Qt, X11 and others: tests/compile/hostile_macros.c|p' tests/compile/hostile_macros.c
} | sort -u >"$here/macros"

{
    join "$here/words" "$here/macros" | grep ' = '
    join "$here/called" "$here/macros" | grep ' ( '
} | sort | join -v 1 - <(sort -u "$here/meant" "$here/asked") >"$here/found"
echo "$(wc -l <"$here/words") words of the header, $(cut -d' ' -f1 "$here/macros" | sort -u | wc -l) macros of others"
if [ -s "$here/found" ]; then
    echo "the header's words that others take as macros:"
    cat "$here/found"
    exit 1
fi
