#!/usr/bin/env bash
# VTK's solid of a mesh counts a sample on a face as inside or not by the face's axis: x and y both sides, z the lower only.
#
# vtkPolyDataToImageStencil on a cube whose six faces lie on samples: along x and y both faces are in, along z the lower.
# With tolerance 0 it is the upper of x, the upper of y, the lower of z. So the solid of a mesh that was turned by 90 degrees is
# not the turned solid.
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
cat >stencil.py <<'P'
import vtk
def extent(tolerance):
    cube = vtk.vtkCubeSource()
    cube.SetBounds(2, 5, 2, 5, 2, 5)
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(cube.GetOutputPort())
    cut = vtk.vtkPolyDataToImageStencil()
    cut.SetInputConnection(triangles.GetOutputPort())
    cut.SetOutputOrigin(0, 0, 0)
    cut.SetOutputSpacing(1, 1, 1)
    cut.SetOutputWholeExtent(0, 7, 0, 7, 0, 7)
    if tolerance is not None:
        cut.SetTolerance(tolerance)
    image = vtk.vtkImageStencilToImage()
    image.SetInputConnection(cut.GetOutputPort())
    image.SetInsideValue(1)
    image.SetOutsideValue(0)
    image.Update()
    out = image.GetOutput()
    inside = [(x, y, z) for x in range(8) for y in range(8) for z in range(8) if out.GetScalarComponentAsFloat(x, y, z, 0)]
    return " ".join("%d-%d" % (min(p[a] for p in inside), max(p[a] for p in inside)) for a in range(3))
print(vtk.vtkVersion.GetVTKVersion() + ": " + extent(None) + ", tolerance 0: " + extent(0))
P
said=$(/usr/bin/python3 stencil.py)
echo "samples inside a cube from 2 to 5, along x, y, z: $said"
[ "$said" = "9.1.0: 2-5 2-5 2-4, tolerance 0: 3-5 3-5 2-4" ]
