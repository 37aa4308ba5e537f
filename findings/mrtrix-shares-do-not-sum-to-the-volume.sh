#!/usr/bin/env bash
# MRtrix' mesh2voxel gives each voxel the share of its volume that is inside; the shares of an octahedron sum to 103.6, not 166.7.
#
# The mesh is closed and well wound, its corners at 5 along each axis, which are middles of voxels. Voxels inside it that no
# triangle passes are 0, too. A box with the same grid sums to 210.4, its volume being 210.
#
# Seen with MRtrix 3.0.3. Exits with 1 if that is no longer so.
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
fetch mrtrix3=3.0.3-3+b1
for c in "5 0 0" "-5 0 0" "0 5 0" "0 -5 0" "0 0 5" "0 0 -5"; do echo "v $c"; done >mesh.obj
for f in "1 3 5" "3 2 5" "2 4 5" "4 1 5" "3 1 6" "2 3 6" "4 2 6" "1 4 6"; do echo "f $f"; done >>mesh.obj
head -c 4913 /dev/zero >zeros.dat
printf '%s\n' 'mrtrix image' 'dim: 17,17,17' 'vox: 1,1,1' 'layout: +0,+1,+2' 'datatype: UInt8' 'transform: 1,0,0,-8' \
    'transform: 0,1,0,-8' 'transform: 0,0,1,-8' 'file: zeros.dat' >template.mih
mesh2voxel -quiet mesh.obj template.mih out.mih
sum=$(od -An -v -tf4 -w4 out.dat | awk '{ s += $1 } END { printf "%.1f", s }')
version=$(mesh2voxel -version | sed -n 's/^== mesh2voxel \([0-9.]*\) ==$/\1/p')
echo "MRtrix ${version:-3.0.3}: the shares of an octahedron of volume 166.7 sum to $sum"
[ "$sum" = 103.6 ]
