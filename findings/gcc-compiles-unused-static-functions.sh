#!/usr/bin/env bash
# gcc -O0 compiles static functions that nobody calls, also those marked unused; not those declared inline. clang compiles none.
#
# A file that only includes a header of static functions, some of them kept out of line by the attribute noinline, becomes
# megabytes of object code and seconds of compilation in builds without optimization, and in no other. Marking them
# inline, too, makes gcc warn (g++ without a way to switch that off); so the attribute is for optimized builds alone.
#
# Seen with gcc 12.2.0 and clang 14.0.6, x86-64. Exits with 1 if that is no longer so.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"

# Debian's packages of these versions: the installed ones, or with all that they need unpacked here
fetch() { # package=version...
    local package
    local missing=
    for package in "$@"; do
        [ "$(dpkg-query -W -f='${Version}' "${package%%=*}" 2>/dev/null)" = "${package#*=}" ] || missing="$missing $package"
    done
    [ -n "$missing" ] || return 0
    mkdir -p debs/partial
    touch none
    # shellcheck disable=SC2086 # a list
    apt-get -qq -y -o Dir::State::status="$here/none" -o Dir::Cache::archives="$here/debs" --no-install-recommends \
        --download-only install $missing
    for package in debs/*.deb; do
        dpkg -x "$package" root
    done
    export PATH=$here/root/usr/bin:$PATH PYTHONPATH=$here/root/usr/lib/python3/dist-packages
    export LD_LIBRARY_PATH=$here/root/usr/lib/x86_64-linux-gnu:$here/root/lib/x86_64-linux-gnu
    export CPATH=$here/root/usr/include LIBRARY_PATH=$LD_LIBRARY_PATH
}
fetch gcc-12=12.2.0-14+deb12u1 clang-14=1:14.0.6-12
cat >functions.c <<'C'
static __attribute__((unused)) int plain(int x) { return x * 3; }
static __attribute__((unused, noinline)) int out_of_line(int x) { return x * 5; }
static inline int in_line(int x) { return x * 7; }
C
kept() { # compiler, flags...
    "$@" -c functions.c -o functions.o
    nm functions.o | awk '{ print $3 }' | tr '\n' ' '
}
said="gcc -O0: $(kept gcc-12 -O0); gcc -O1: $(kept gcc-12 -O1); clang -O0: $(kept clang-14 -O0)"
echo "functions in the object: $said"
[ "$said" = "gcc -O0: out_of_line plain ; gcc -O1: ; clang -O0: " ]
