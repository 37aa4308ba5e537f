#!/usr/bin/env bash
# Open3D 0.16's voxels of a mesh are reported half a voxel from where they were tested.
#
# VoxelGrid says that voxel i is origin + [i, i+1] * size, and draws it there; create_from_triangle_mesh tests
# origin + [i-1/2, i+1/2] * size against the triangles. So of the voxels of a small tilted triangle, as reported, some
# do not touch it: here one whose box begins above all its corners.
#
# Seen with Open3D 0.16.1. Exits with 1 if that is no longer so.
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
fetch python3-open3d=0.16.1+ds-2+b4
cat >voxels.py <<'P'
import numpy, open3d
corners = numpy.array([[0.2, 0.3, 0.7], [3.7, 0.4, 0.7], [0.5, 3.6, 0.7]])
mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(corners), open3d.utility.Vector3iVector(numpy.array([[0, 1, 2]])))
low = numpy.array([-2.0, -2, -2])
grid = open3d.geometry.VoxelGrid.create_from_triangle_mesh_within_bounds(mesh, 1.0, low, low + 8)
layers = sorted({tuple(v.grid_index)[2] for v in grid.get_voxels()})
bottoms = sorted({grid.get_voxel_bounding_points(v.grid_index)[0][2] for v in grid.get_voxels()})
print(open3d.__version__, "origin", grid.origin[2], "layers", layers, "least z of their boxes", bottoms)
P
said=$(/usr/bin/python3 voxels.py)
echo "a triangle at z = 0.7: $said"
[ "$said" = "0.16.1 origin -2.0 layers [3] least z of their boxes [1.0]" ]
