#!/usr/bin/env bash
# gcc's -fpack-struct packs in spite of #pragma pack(push, 16); -fpack-struct=1, which packs as tightly, does not.
#
# A header that must have its layout can guard itself by the pragma against -fpack-struct=1 and against a pack(1) that
# is open where it is included; with the bare option gcc warns that the pragma has no effect and drops it. clang heeds the
# pragma with both.
#
# Seen with gcc 12.2.0, x86-64. Exits with 1 if that is no longer so.
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
fetch gcc-12=12.2.0-14+deb12u1
cat >layout.c <<'C'
#include <stdio.h>
#pragma pack(push, 16)
struct pair { char c; double d; };
#pragma pack(pop)
int main(void)
{
    printf("%d", (int)sizeof(struct pair));
    return 0;
}
C
for option in "" -fpack-struct=1 -fpack-struct; do
    # shellcheck disable=SC2086 # may be nothing
    gcc-12 -w $option layout.c -o layout
    said="${said:-}${said:+ }$(./layout)"
done
echo "size of char and double under pack(16): plain, -fpack-struct=1, -fpack-struct say $said"
[ "$said" = "16 16 9" ]
