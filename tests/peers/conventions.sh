#!/usr/bin/env bash
# Really runs other voxelizers on our meshes, and asks check_voxels --guess which convention their files follow:
#
#   bash tests/peers/conventions.sh BUILD        BUILD holds check_voxels; works in BUILD/peers
#
# Debian packages: python3-vtk9 python3-openvdb python3-open3d libinsighttoolkit5-dev mrtrix3 python3-gdal libpcl-dev
# liboctomap-dev, and cmake. One that is not there gives a SKIP line. Ends with "N passed, N failed": a file passes
# where the convention that belongs to its program is the best, or as good as the best.
set -u
cd "$(dirname "$0")/../.." || exit 1
bin=${1:-build}
work=$bin/peers
python=${PEERS_PYTHON:-/usr/bin/python3}
peers=tests/peers
passed=0
failed=0
mkdir -p "$work"
$python $peers/meshes.py "$work" || exit 1

# guess MESH FILE NAME OPTIONS...: prints the guess; NAME must be among the best
guess() {
    local mesh=$1 file=$2 name=$3
    shift 3
    "$bin/check_voxels" "$work/$mesh.obj" "$work/$file" --guess --show 0 "$@" >"$work/said" 2>&1
    printf '%-22s %s\n' "$file" "$(sed -n 's/^guess *//p' "$work/said")"
    if sed -n '/^guess/p; /not told apart/p' "$work/said" | grep -qE "(as|:|,) $name([:,]|\$)"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "    FAILED: not as $name"
        cat "$work/said"
    fi
}

# try PROGRAM COMMAND...: runs it, its output in $work/log; SKIP if it cannot
try() {
    local program=$1
    shift
    if "$@" >"$work/log" 2>&1; then
        head -n 1 "$work/log"
        return 0
    fi
    echo "SKIP: $program: $(tail -n 1 "$work/log")"
    return 1
}

have_itk=0
if [ -x "$work/itk/write_itk" ] || { cmake -S $peers -B "$work/itk" -DCMAKE_BUILD_TYPE=Release >"$work/itk.log" 2>&1 &&
        make -C "$work/itk" >>"$work/itk.log" 2>&1; }; then
    have_itk=1
else
    echo "SKIP: ITK: see $work/itk.log"
fi

for mesh in box halves octahedron tilted sphere; do
    out=$work/$mesh
    if try VTK $python $peers/write_vtk.py "$out.obj" "$out"; then
        guess $mesh $mesh.modeller.vti vtk-modeller
        guess $mesh $mesh.stencil.vti "$([ $mesh = octahedron ] && echo openvdb || echo vtk-stencil)"
        guess $mesh $mesh.stencil0.mha vtk-stencil-0
    fi
    if [ $have_itk = 1 ] && try ITK "$work/itk/write_itk" "$out.obj" "$out"; then
        guess $mesh $mesh.itk.mha itk
        guess $mesh $mesh.itk.nrrd itk
    fi
    if try OpenVDB $python $peers/write_openvdb.py "$out.obj" "$out"; then
        guess $mesh $mesh.openvdb.npy openvdb --size 1 --origin=-8
    fi
    if try Open3D $python $peers/write_open3d.py "$out.obj" "$out"; then
        guess $mesh $mesh.open3d.npy open3d-0.16 --size 1 --origin="$(sed -n 's/^origin //p' "$work/log")"
    fi
    # shares of volume: for box and octahedron "above 1/2" is not what fits best
    if [ $mesh != octahedron ] && try MRtrix bash $peers/write_mrtrix.sh "$out.obj" "$out"; then
        guess $mesh $mesh.mrtrix.mha mrtrix
    fi
done

if try GDAL $python $peers/write_gdal.py "$work/flat"; then
    "$bin/check_voxels" "$work/flat.obj" "$work/flat.gdal.mha" --open --show 0
fi
if try points g++ -O1 -w -std=c++17 -I. -I/usr/include/pcl-1.13 -I/usr/include/eigen3 $peers/points.cxx -o "$work/points" \
        -lpcl_common -lpcl_filters -loctomap -loctomath; then
    "$work/points"
fi
echo "conventions: $passed passed, $failed failed"
[ $failed -eq 0 ]
