#!/usr/bin/env bash
# VTK's vtkVoxelModeller leaves out voxels that the mesh passes through.
#
# It sets a sample if the nearest point of a cell to the sample lies in the sample's cube. A triangle can pass through a
# corner of the cube while its nearest point to the middle lies outside: such voxels are not set, and the surface has holes.
# Here a large tilted triangle; each voxel is checked by a point of the triangle that lies strictly inside it.
#
# Seen with VTK 9.1.0. Exits with 1 if that is no longer so.
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
fetch python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
cat >voxels.py <<'P'
import math, vtk
corners = [(-5.3, -4.1, -3.7), (5.9, -3.2, 1.4), (-1.6, 6.1, 3.3)]
points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
points.SetDataTypeToDouble()
for p in corners:
    points.InsertNextPoint(p)
cells.InsertNextCell(3, [0, 1, 2])
mesh = vtk.vtkPolyData()
mesh.SetPoints(points)
mesh.SetPolys(cells)
modeller = vtk.vtkVoxelModeller()
modeller.SetInputData(mesh)
modeller.SetSampleDimensions(17, 17, 17)
modeller.SetModelBounds(-8, 8, -8, 8, -8, 8)
modeller.SetMaximumDistance(0.2)
modeller.SetScalarTypeToUnsignedChar()
modeller.Update()
image = modeller.GetOutput()
inside = set()
n = 400
for i in range(n + 1):
    for j in range(n + 1 - i):
        k = n - i - j
        p = [(i * a + j * b + k * c) / n for a, b, c in zip(*corners)]
        if all(abs(abs(x - math.floor(x)) - 0.5) > 1e-6 for x in p):
            inside.add(tuple(math.floor(x + 0.5) + 8 for x in p))
missing = sum(image.GetScalarComponentAsFloat(x, y, z, 0) == 0 for x, y, z in inside)
print(vtk.vtkVersion.GetVTKVersion(), "of", len(inside), "voxels", missing, "are not set")
P
said=$(/usr/bin/python3 voxels.py)
echo "voxels with a point of the triangle inside: $said"
case $said in "9.1.0 of "*" voxels 0 are"*) exit 1 ;; "9.1.0 of "*) ;; *) exit 1 ;; esac
