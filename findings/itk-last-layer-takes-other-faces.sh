#!/usr/bin/env bash
# ITK's solid of a mesh counts a sample on the upper face across y as inside in the last layer of z only, and of some boxes only.
#
# TriangleMeshToBinaryImageFilter on boxes whose faces lie on samples: along x both faces are in, along z the lower one, along y
# the lower one. But of a box of 3 x 3 x 7 the last layer that holds anything has the upper face of y, too; one of 3 x 3 x 3 has not.
#
# Seen with ITK 5.2.1. Exits with 1 if that is no longer so.
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
fetch libinsighttoolkit5-dev=5.2.1-5+deb12u1
cat >CMakeLists.txt <<'C'
cmake_minimum_required(VERSION 3.10)
project(solid C CXX)
find_package(ITK REQUIRED COMPONENTS ITKMesh)
include(${ITK_USE_FILE})
add_executable(solid solid.cxx)
target_link_libraries(solid ${ITK_LIBRARIES})
C
cat >solid.cxx <<'C'
#include <itkImage.h>
#include <itkMesh.h>
#include <itkTriangleCell.h>
#include <itkTriangleMeshToBinaryImageFilter.h>
#include <itkVersion.h>

#include <cstdio>
#include <cstdlib>

int main(int, char **argument)
{
    typedef itk::Mesh<double, 3> Mesh;
    typedef itk::Image<unsigned char, 3> Image;
    static const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    Mesh::Pointer mesh = Mesh::New();
    for (unsigned i = 0; i < 8; i++) {
        Mesh::PointType p;
        for (unsigned a = 0; a < 3; a++) {
            p[a] = i >> a & 1 ? (a == 2 ? std::atoi(argument[1]) : 5) : 2;
        }
        mesh->SetPoint(i, p);
    }
    for (unsigned t = 0; t < 12; t++) {
        Mesh::CellAutoPointer cell;
        cell.TakeOwnership(new itk::TriangleCell<Mesh::CellType>);
        cell->SetPointId(0, quads[t / 2][0]);
        cell->SetPointId(1, quads[t / 2][1 + t % 2]);
        cell->SetPointId(2, quads[t / 2][2 + t % 2]);
        mesh->SetCell(t, cell);
    }
    typedef itk::TriangleMeshToBinaryImageFilter<Mesh, Image> Filter;
    Filter::Pointer filter = Filter::New();
    Filter::SizeType size;
    size.Fill(12);
    filter->SetInput(mesh);
    filter->SetSize(size);
    filter->SetInsideValue(1);
    filter->SetOutsideValue(0);
    filter->Update();
    std::printf("%s:", itk::Version::GetITKVersion());
    for (int z = 0; z < 12; z++) {
        int inside = 0;
        int upper = 0;
        for (int y = 0; y < 12; y++) {
            for (int x = 0; x < 12; x++) {
                Image::IndexType at = {{x, y, z}};
                inside += filter->GetOutput()->GetPixel(at) != 0;
                upper += y == 5 && filter->GetOutput()->GetPixel(at) != 0;
            }
        }
        if (inside) {
            std::printf(" %d", upper);
        }
    }
    return 0;
}
C
cmake -DCMAKE_BUILD_TYPE=Debug . >log 2>&1 && make >>log 2>&1
said="$(./solid 5), $(./solid 9)"
echo "samples on the upper face of y, layer by layer, of boxes of height 3, 7: $said"
[ "$said" = "5.2.1: 0 0 0, 5.2.1: 0 0 0 0 0 0 4" ]
