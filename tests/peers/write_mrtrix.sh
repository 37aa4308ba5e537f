#!/usr/bin/env bash
# MRtrix' shares of voxels' volume: write_mrtrix.sh MESH.obj OUT    writes OUT.mrtrix.mha
# Samples at whole numbers from -8 to 8, each the middle of its voxel.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
head -c $((17 * 17 * 17)) /dev/zero >"$here/zeros.dat"
cat >"$here/template.mih" <<'T'
mrtrix image
dim: 17,17,17
vox: 1,1,1
layout: +0,+1,+2
datatype: UInt8
transform: 1,0,0,-8
transform: 0,1,0,-8
transform: 0,0,1,-8
file: zeros.dat
T
mesh2voxel -quiet "$1" "$here/template.mih" "$here/out.mih"
grep -q '^layout: +0,+1,+2' "$here/out.mih" && grep -q '^datatype: Float32LE' "$here/out.mih"
{
    printf 'ObjectType = Image\nNDims = 3\nOffset = -8 -8 -8\nElementSpacing = 1 1 1\nDimSize = 17 17 17\n'
    printf 'ElementType = MET_FLOAT\nElementDataFile = LOCAL\n'
    cat "$here/out.dat"
} >"$2.mrtrix.mha"
mesh2voxel -version | head -n 1 | tr -d '=\b' | awk '{ print "MRtrix", $2 }'
