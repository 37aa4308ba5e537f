#!/usr/bin/env bash
# PCL's VoxelGrid puts points that lie on voxel borders into other voxels than floor(x / size), on a grid of 0.1f.
#
# It multiplies by the reciprocal, rounded to float (that of 0.1f, which is a little more than 0.1, is 10), and takes the floor.
# The points are float(i * 0.1f), within a rounding of a border: nearly half come out on the other side of it than the
# quotient of the same two floats says.
#
# Seen with PCL 1.13.0. Exits with 1 if that is no longer so.
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
fetch libpcl-dev=1.13.0+dfsg-3
cat >voxel.cxx <<'C'
#include <cmath>
#include <cstdio>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

int main()
{
    int differ = 0;
    pcl::VoxelGrid<pcl::PointXYZ> grid;
    grid.setLeafSize(0.1f, 0.1f, 0.1f);
    for (int i = 1; i <= 4000; i++) {
        const float x = (float)i * 0.1f;
        // x / 0.1f in double is within 2^-53 of the quotient of these two floats, and not a whole number unless it is exactly
        differ += grid.getGridCoordinates(x, 0, 0)[0] != (int)std::floor((double)x / (double)0.1f);
    }
    std::printf("%d", differ);
    return 0;
}
C
g++ -w -std=c++17 -I/usr/include/pcl-1.13 -I/usr/include/eigen3 voxel.cxx -o voxel -lpcl_common -lpcl_filters
differ=$(./voxel)
echo "of 4000 points i * 0.1f, in another voxel than floor(x / size): $differ"
[ "$differ" -ge 100 ]
