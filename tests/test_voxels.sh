# Voxel files of every format that check_voxels reads, and what it says of sets that are wrong in a known way. Sourced by
# test_examples.sh.

check=$bin/check_voxels

# ---- Every format gives back the set ------------------------------------------------------------------

run 0 "$bin/voxelize" teapot 32 -o "$tmp/v.binvox" -o "$tmp/v.npy" -o "$tmp/v.nrrd" -o "$tmp/v.vti" -o "$tmp/v.vox"
for ending in binvox npy nrrd vti; do
    run 0 "$check" teapot "$tmp/v.$ending"
    says 'missing  0'
done
run 0 "$check" teapot "$tmp/v.vox" --up z       # the teapot is no OBJ and no PLY: z points up
run 0 "$bin/voxelize" "$tmp/plain.obj" 300 -o "$tmp/many.vox"      # two models a side, in a scene; y points up
run 0 "$check" "$tmp/plain.obj" "$tmp/many.vox"
says '300 x 300 x 300'

# bytes of one cube's closed voxels of 1, from -1 to 2: 27 ones among 3 x 3 x 3
ones='\001\001\001\001\001\001\001\001\001'
printf "$ones$ones$ones" > "$tmp/c.raw"
run 0 "$check" "$tmp/cube.obj" "$tmp/c.raw" --dims 3 --size 1 --origin=-1
says 'exact    27 voxels'
run 2 "$check" "$tmp/cube.obj" "$tmp/c.raw" --dims 3,3,4 --size 1 --origin=-1
says 'neither a byte nor a bit for each voxel'
run 2 "$check" "$tmp/cube.obj" "$tmp/c.raw"
says 'other files need --dims'
printf '\377\377\377\007' > "$tmp/c.bits"
run 0 "$check" "$tmp/cube.obj" "$tmp/c.bits" --dims 3 --size 1 --origin=-1
printf '\376\377\377\007' > "$tmp/c.bits"
run 1 "$check" "$tmp/cube.obj" "$tmp/c.bits" --dims 3 --size 1 --origin=-1
says 'missing  0,0,0  box -1,-1,-1 to 0,0,0: 0 voxels away'
run 2 "$check" "$tmp/cube.obj" "$tmp/c.raw" --dims 27,1,1
says 'the file does not say where its voxels lie'

# MetaImage: samples at -0.5, 0.5, 1.5; as bytes, as text, and as numbers of another file, in both byte orders
mha() { # mha TYPE LINES FILE
    printf 'ObjectType = Image\nNDims = 3\n%bTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = -0.5 -0.5 -0.5\n' "$2"
    printf 'ElementSpacing = 1 1 1\nDimSize = 3 3 3\nElementType = %s\nElementDataFile = %s\n' "$1" "$3"
}
{ mha MET_UCHAR 'BinaryData = True\n' LOCAL; cat "$tmp/c.raw"; } > "$tmp/c.mha"
run 0 "$check" "$tmp/cube.obj" "$tmp/c.mha"
{ mha MET_FLOAT 'BinaryData = False\n' LOCAL; i=0; while [ $i -lt 27 ]; do echo 0.5; i=$((i + 1)); done; } > "$tmp/text.mha"
run 0 "$check" "$tmp/cube.obj" "$tmp/text.mha"
run 1 "$check" "$tmp/cube.obj" "$tmp/text.mha" --above 0.5 --show 0
says 'missing  27'
mha MET_SHORT 'BinaryDataByteOrderMSB = True\n' short.raw > "$tmp/short.mhd"
i=0; while [ $i -lt 27 ]; do printf '\377\376'; i=$((i + 1)); done > "$tmp/short.raw"
run 0 "$check" "$tmp/cube.obj" "$tmp/short.mhd" --below -1.5
run 1 "$check" "$tmp/cube.obj" "$tmp/short.mhd" --show 0
sed 's/^TransformMatrix = 1 0/TransformMatrix = 0 1/' "$tmp/c.mha" > "$tmp/turned.mha"
run 2 "$check" "$tmp/cube.obj" "$tmp/turned.mha"
says 'turned or mirrored'
sed 's/^DimSize = 3/DimSize = 400000/' "$tmp/c.mha" > "$tmp/long.mha"
run 2 "$check" "$tmp/cube.obj" "$tmp/long.mha"
says 'too short for the voxels that it promises'

if command -v gzip > /dev/null; then
    header=$(grep -an -m 1 '^$' "$tmp/v.nrrd" | cut -d: -f1)
    { head -n "$header" "$tmp/v.nrrd" | sed 's/encoding: raw/encoding: gzip/'
      tail -n +$((header + 1)) "$tmp/v.nrrd" | gzip -9; } > "$tmp/packed.nrrd"
    run 0 "$check" teapot "$tmp/packed.nrrd"
    { head -n "$header" "$tmp/v.nrrd" | sed 's/encoding: raw/encoding: gzip/'
      tail -n +$((header + 1)) "$tmp/v.nrrd" | gzip -9 | head -c 300; } > "$tmp/packed.nrrd"
    run 2 "$check" teapot "$tmp/packed.nrrd"
    says 'damaged'
fi

# A gzip header whose extra field would reach far behind the end
{ printf 'NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 3 3\nencoding: gzip\nspacings: 1 1 1\n\n'
  printf '\037\213\010\004\000\000\000\000\000\000\377\377\000\000\000\000\000\000\000\000'; } > "$tmp/extra.nrrd"
run 2 "$check" "$tmp/cube.obj" "$tmp/extra.nrrd"
says 'damaged'
sed 's/short.raw/..\/short.raw/' "$tmp/short.mhd" > "$tmp/away.mhd"
run 2 "$check" "$tmp/cube.obj" "$tmp/away.mhd"
says 'must lie beside the header'

# VTK image data: text, and base 64, in which 27 ones and their length are 42 characters
vti() { # vti FORMAT TEXT
    printf '<VTKFile type="ImageData" byte_order="LittleEndian" header_type="UInt32">\n<ImageData WholeExtent="%s" ' '1 3 1 3 1 3'
    printf 'Origin="-1.5 -1.5 -1.5" Spacing="1 1 1">\n<Piece Extent="1 3 1 3 1 3">\n<PointData>\n'
    printf '<DataArray type="UInt8" Name="set" format="%s">\n%s\n</DataArray>\n</PointData>\n</Piece>\n' "$1" "$2"
    printf '</ImageData>\n</VTKFile>\n'
}
vti ascii '1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1' > "$tmp/c.vti"
run 0 "$check" "$tmp/cube.obj" "$tmp/c.vti"
vti binary 'GwAAAAEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQ==' > "$tmp/c.vti"
run 0 "$check" "$tmp/cube.obj" "$tmp/c.vti"
vti binary 'GwAAAAABAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQ==' > "$tmp/c.vti"
run 1 "$check" "$tmp/cube.obj" "$tmp/c.vti"
says 'missing  0,0,0'

# Cut short, or with a byte changed: refused or compared, and never a crash.
for file in v.binvox v.npy v.nrrd v.vti v.vox c.mha packed.nrrd; do
    [ -f "$tmp/$file" ] || continue
    size=$(wc -c < "$tmp/$file")
    for at in 1 5 9 14 30 60 90 130 $((size - 60)); do
        head -c "$at" "$tmp/$file" > "$tmp/cut.${file##*.}"
        checks=$((checks + 1))
        "$check" teapot "$tmp/cut.${file##*.}" > "$tmp/out" 2>&1
        [ $? -eq 2 ] || fail "the first $at bytes of $file are taken for a file"
        { head -c "$at" "$tmp/$file"; printf '\377'; tail -c +$((at + 2)) "$tmp/$file"; } > "$tmp/cut.${file##*.}"
        checks=$((checks + 1))
        "$check" teapot "$tmp/cut.${file##*.}" --show 0 > "$tmp/out" 2>&1
        [ $? -le 2 ] || fail "byte $at of $file changed: a crash"
    done
done

# ---- Conventions ---------------------------------------------------------------------------------------

run 0 "$check" --like list
says 'vtk-stencil'
run 2 "$check" teapot "$tmp/v.npy" --like nobody
says "--like: 'nobody' is not such a value"
run 2 "$check" teapot "$tmp/v.npy" --guess --thin
says 'give no other'
run 0 "$check" teapot "$tmp/v.npy" --like ours
run 0 "$bin/voxelize" teapot-closed 32 --solid -o "$tmp/s.npy"
run 0 "$check" teapot-closed "$tmp/s.npy" --like ours-solid
run 0 "$check" teapot-closed "$tmp/s.npy" --guess
says 'as ours-solid: samples at i+1/2 inside'

# A pyramid whose foot and edges lie on planes of the grid tells all rules apart.
for rule in half-open open thin closed; do
    run 0 "$bin/voxelize" "$tmp/plain.obj" --size .25 --$rule -o "$tmp/r.vti"
    run 0 "$check" "$tmp/plain.obj" "$tmp/r.vti" --guess
    says ", $rule"
done
# A box from 1 to 4.
sed 's/1/4/g; s/0/1/g; /^f/d' "$tmp/cube.obj" > "$tmp/planes.obj"
grep '^f' "$tmp/cube.obj" >> "$tmp/planes.obj"
# Samples of a file of points, in which the upper faces along x and z, the lower along y are inside: 3 x 3 x 3 from 2, 1, 2
{
    mha MET_UCHAR 'BinaryData = False\n' LOCAL | sed 's/^Offset.*/Offset = 0 0 0/; s/^DimSize.*/DimSize = 6 6 6/'
    for z in 0 1 2 3 4 5; do for y in 0 1 2 3 4 5; do for x in 0 1 2 3 4 5; do
        if [ $x -ge 2 ] && [ $x -le 4 ] && [ $y -ge 1 ] && [ $y -le 3 ] && [ $z -ge 2 ] && [ $z -le 4 ]; then echo 1; else echo 0; fi
    done; done; done
} > "$tmp/faces.mha"
run 0 "$check" "$tmp/planes.obj" "$tmp/faces.mha" --guess
says 'guess    27 of 27 as samples at i inside, faces: x upper, y lower, z upper'
run 1 "$check" "$tmp/planes.obj" "$tmp/faces.mha" --like itk --show 0
says 'planes    18 missing, 9 extra'
# The boxes of its corners
run 0 "$bin/voxelize" "$tmp/planes.obj" --size 1 -o "$tmp/r.vti"
run 1 "$check" "$tmp/planes.obj" "$tmp/r.vti" --like pcl --show 0
says 'exact    8 voxels'

# ---- Kinds of differences -------------------------------------------------------------------------------

sed 's/^centerings: cell cell cell/centerings: node node node/' "$tmp/v.nrrd" > "$tmp/node.nrrd"
run 0 "$check" teapot "$tmp/node.nrrd"                  # a sample is the middle of its voxel
run 1 "$check" teapot "$tmp/node.nrrd" --like pcl --show 0
run 1 "$check" teapot "$tmp/node.nrrd" --like binvox --show 0
says 'by -0.5,-0.5,-0.5 voxels'
grep -v '^f 3/1/1' "$tmp/plain.obj" > "$tmp/fewer.obj"
run 0 "$bin/voxelize" "$tmp/fewer.obj" 20 -o "$tmp/fewer.binvox"
run 1 "$check" "$tmp/plain.obj" "$tmp/fewer.binvox" --show 0
says 'triangles that are lost: 1, the first is 4'
{ printf '\001\001\001\001\001\001\001\001\001\001'; head -c 80 /dev/zero; } > "$tmp/streak.raw"
run 1 "$check" "$tmp/cube.obj" "$tmp/streak.raw" --dims 10,3,3 --size 1 --origin 5,5,5 --show 0
says 'streak    0 missing, 10 extra'
run 0 "$bin/voxelize" "$tmp/plain.obj" --size .25 --half-open -o "$tmp/h.nrrd"
run 1 "$check" "$tmp/plain.obj" "$tmp/h.nrrd" --open --show 1
run 1 "$check" "$tmp/plain.obj" "$tmp/h.nrrd" --json --thin --show 3
says '"kinds": {"touching": ['
if command -v python3 > /dev/null; then
    checks=$((checks + 1))
    python3 -m json.tool "$tmp/out" > /dev/null || fail 'no JSON'
fi

# The line of C holds: a missing voxel is touched by that triangle, an extra one is not.
run 0 "$bin/voxelize" "$tmp/plain.obj" 20 -o "$tmp/whole.binvox"
if command -v "${CC:-cc}" > /dev/null; then
    {
        echo '#include "tribox.h"'
        echo '#include <assert.h>'
        echo 'int main(void) {'
        "$check" "$tmp/plain.obj" "$tmp/fewer.binvox" --show 4 | grep '{ tribox_grid g'
        "$check" "$tmp/fewer.obj" "$tmp/whole.binvox" --show 4 | grep '{ tribox_grid g'
        echo 'return 0; }'
    } > "$tmp/pasted.c"
    checks=$((checks + 1))
    [ "$(grep -c 'NULL) == 1' "$tmp/pasted.c")" = 4 ] || fail 'four lines of missing voxels expected'
    run 0 "${CC:-cc}" -std=c99 -O0 -I. "$tmp/pasted.c" -o "$tmp/pasted" -lm
    run 0 "$tmp/pasted"
fi

# ---- voxel_test.h, to include in somebody's tests --------------------------------------------------------

if command -v "${CC:-cc}" > /dev/null; then
    run 0 "${CC:-cc}" -std=c99 -O1 -I. -Wall -Wextra -Wconversion tests/voxel_test.c -o "$tmp/voxel_test" -lm
    run 0 "$tmp/voxel_test"
    says 'missing voxel 0,0,0: triangle 0 touches it'
fi
