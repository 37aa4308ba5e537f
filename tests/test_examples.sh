#!/bin/sh
# Runs the example programs: output against .out files, every mesh format read alike, bad files refused with
# their line or byte, voxel files that can be read back, slabs and sparse sets that agree with one fill.
#
#   sh tests/test_examples.sh build

bin=${1:-build}
tmp=$bin/test_examples
failures=0
checks=0
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2

fail() {
    failures=$((failures + 1))
    echo "FAIL: $*"
}

# same WHAT FILE FILE: the files hold the same bytes
same() {
    checks=$((checks + 1))
    cmp "$2" "$3" || fail "$1"
}

# run STATUS COMMAND...: the exit status is as given; output goes to $tmp/out
run() {
    want=$1
    shift
    checks=$((checks + 1))
    "$@" > "$tmp/out" 2>&1
    got=$?
    if [ "$got" -ne "$want" ]; then
        fail "exit status $got instead of $want: $*"
        cat "$tmp/out"
    fi
}

# says TEXT: the last output holds the text
says() {
    checks=$((checks + 1))
    grep -qF -e "$1" "$tmp/out" || { fail "expected '$1' in:"; cat "$tmp/out"; }
}

# bad FILE TEXT: the file is refused with the text
bad() {
    run 2 "$bin/voxelize" "$1" 8
    says "$2"
}

# ---- Outputs that never change -------------------------------------------------------------------

run 0 "$bin/01_overlap"
same "01_overlap prints its .out" examples/01_overlap.out "$tmp/out"

# ---- One pyramid in every format: corners of 0, 1 and 2, a square below and four sides ------------

le0='\000\000\000\000' le1='\000\000\200\077' le2='\000\000\000\100'        # floats
be0='\000\000\000\000' be1='\077\200\000\000' be2='\100\000\000\000'
p0="$le0$le0$le0" p1="$le2$le0$le0" p2="$le2$le2$le0" p3="$le0$le2$le0" p4="$le1$le1$le2"

: > "$tmp/x.mtl"      # what plain.obj names: empty
printf 'mtllib x.mtl\n# a comment\nv 0 0 0\nv 2 0 0\nv 2 2 0 1.0\nv 0 2 0\nv 1 1 2\nvt 0 0\nvn 0 0 1
o pyramid\nf 4 3 2 1
f 1/1 2/1 5/1\nf 2//1 3//1 5//1\nf 3/1/1 4/1/1 5/1/1\nf 4 1 5 # the last\n' > "$tmp/plain.obj"
printf 'v 0 0 0\r\nv 2 0 0\r\nv 2 \\\r\n 2 0\r\nv 0 2 0\r\nv 1 1 2\r\n' > "$tmp/other.obj"
printf 'f -2 -3 \\\r\n -4 -5\r\nf -5 -4 -1\r\nf -4 -3 -1\r\nf -3 -2 -1\r\nf -2 -5 -1' >> "$tmp/other.obj"

# facet A B C: one facet of an ASCII STL
facet() {
    printf ' facet normal 0 0 -1.#IND\n  outer loop\n'
    printf '   vertex %s\n' "$@"
    printf '  endloop\n endfacet\n'
}
{
    echo 'solid a pyramid in facets'
    facet '0 2 0' '2 2 0' '2 0 0'
    facet '0 2 0' '2 0 0' '0 0 0'
    facet '0 0 0' '2 0 0' '1 1 2'
    facet '2 0 0' '2e0 2 0' '1 1 2'
    facet '2 2 0' '0 2 0' '+1 1 2'
    facet '0 2 0' '0 0 0' '1 1 2.0'
    echo 'endsolid a pyramid in facets'
} > "$tmp/ascii.stl"

# stl HEADER: a binary STL; the header has 80 characters
stl() {
    printf "%-80s" "$1"
    printf '\006\000\000\000'
    for corners in "$p3$p2$p1" "$p3$p1$p0" "$p0$p1$p4" "$p1$p2$p4" "$p2$p3$p4" "$p3$p0$p4"; do
        printf "$le0$le0$le0$corners\\000\\000"
    done
}
stl 'binary' > "$tmp/binary.stl"
stl 'solid that is binary' > "$tmp/solid.stl"

# ply FORMAT X-TYPE INDEX-TYPE LIST-NAME: a header with extra properties and elements
ply() {
    printf 'ply\nformat %s 1.0\ncomment a pyramid\nelement vertex 5\nproperty uchar red\n' "$1"
    printf 'property %s x\nproperty float y\nproperty float z\nproperty list uchar short extra\n' "$2"
    printf 'element face 5\nproperty list uchar %s %s\nproperty int material\n' "$3" "$4"
    printf 'element edge 1\nproperty short end\nend_header\n'
}
{
    ply ascii double int vertex_index
    printf '255 0 0 0 0\n255 2 0 0 1 7\n255 2 2 0 2 7 7\n255 0 2 0 0\n255 1 1 2 0\n'
    printf '4 3 2 1 0 9\n3 0 1 4 9\n3 1 2 4 9\n3 2 3 4 9\n3 3 0 4 9\n1\n'
} > "$tmp/ascii.ply"
{
    ply binary_little_endian float uchar vertex_indices
    for p in "$p0" "$p1" "$p2" "$p3" "$p4"; do
        printf "\\377$p\\001\\007\\000"
    done
    for f in '\004\003\002\001\000' '\003\000\001\004' '\003\001\002\004' '\003\002\003\004' \
             '\003\003\000\004'; do
        printf "$f\\011\\000\\000\\000"
    done
    printf '\001\000'
} > "$tmp/little.ply"
{
    ply binary_big_endian float ushort vertex_indices
    for p in "$be0$be0$be0" "$be2$be0$be0" "$be2$be2$be0" "$be0$be2$be0" "$be1$be1$be2"; do
        printf "\\377$p\\001\\000\\007"
    done
    for f in '\004\000\003\000\002\000\001\000\000' '\003\000\000\000\001\000\004' \
             '\003\000\001\000\002\000\004' '\003\000\002\000\003\000\004' '\003\000\003\000\000\000\004'; do
        printf "$f\\000\\000\\000\\011"
    done
    printf '\000\001'
} > "$tmp/big.ply"
{
    printf 'ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element tristrips 1\nproperty list int int vertex_indices\nend_header\n'
    printf '0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 2\n'
    printf '18 1 0 2 3 -1 0 1 4 2 -1 2 3 4 -1 3 4 0 -1\n'
} > "$tmp/strips.ply"

for rule in --closed --half-open --open --thin; do
    run 0 "$bin/voxelize" "$tmp/plain.obj" 20 $rule -o "$tmp/plain.binvox"
    for file in other.obj ascii.stl binary.stl solid.stl ascii.ply little.ply big.ply strips.ply; do
        run 0 "$bin/voxelize" "$tmp/$file" 20 $rule -o "$tmp/$file.binvox"
        same "$file and plain.obj give the same voxels under $rule" "$tmp/plain.binvox" "$tmp/$file.binvox"
    done
done
cp "$tmp/big.ply" "$tmp/unnamed"
run 0 "$bin/voxelize" "$tmp/unnamed" 20
says 'binary PLY (big endian), 6 triangles'
says 'closed: every edge'
cp "$tmp/solid.stl" "$tmp/unnamed"
run 0 "$bin/voxelize" "$tmp/unnamed" 20
says 'binary STL, 6 triangles'
"$bin/voxelize" - 20 < "$tmp/ascii.stl" > "$tmp/out" 2>&1 || fail 'the standard input is read'
says 'ASCII STL, 6 triangles'

# ---- Bad files: the sentence names the line or the byte -------------------------------------------

# text NAME LINES: makes a file of text
text() {
    printf "$2" > "$tmp/$1"
}
text number.obj 'v 0 0 0\nv 1,5 0 0\n'
bad "$tmp/number.obj" "line 2: number expected, found '1,5'"
text short.obj 'v 0 0 0\nv \\\n 0\nf 1 1 1\n'
bad "$tmp/short.obj" 'line 3: number expected, found the end of the line'
text zero.obj 'v 0 0 0\nf 0 1 1\n'
bad "$tmp/zero.obj" "line 2: vertex index from 1 expected, found '0'"
text past.obj 'v 0 0 0\nf 1 1 1\nf 1 1 2\n'
bad "$tmp/past.obj" 'line 3: vertex number 2 (from 1), but the file has 1 vertices'
text back.obj 'v 0 0 0\nf -1 -1 -2\n'
bad "$tmp/back.obj" 'line 2: vertex index -2, but only 1 vertices stand above'
text huge.obj 'v 0 0 0\nf 1 1 99999999999999999999\n'
bad "$tmp/huge.obj" 'line 2: vertex index expected'
text word.obj 'v 0 0 0\nf 1 1 1x\n'
bad "$tmp/word.obj" "line 2: vertex index expected, found '1x'"
text points.obj 'v 0 0 0\nv 1 0 0\n'
bad "$tmp/points.obj" 'no triangles'
text prose.txt 'Dear reader,\nthis is no mesh.\n'
bad "$tmp/prose.txt" 'not an OBJ, STL, PLY, OFF or glTF file'
text empty.stl ''
bad "$tmp/empty.stl" 'the file is empty'
text one.obj 'v 1 2 3\nf 1 1 1\n'
bad "$tmp/one.obj" 'the mesh is a single point'
text nan.obj 'v nan 2 3\nv 0 0 inf\nf 1 2 1\n'
bad "$tmp/nan.obj" 'no triangle is finite'
bad "$tmp/missing.obj" 'No such file or directory'
bad "$tmp" 'Is a directory'
text facet.stl 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\nvertex 0 0 0\n'
bad "$tmp/facet.stl" "line 6: number expected, found 'vertex'"
text loop.stl 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n'
bad "$tmp/loop.stl" "line 6: vertex expected, found 'endloop'"
text end.stl 'solid x\n'
bad "$tmp/end.stl" 'facet or endsolid expected, found the end of the file'
dd if="$tmp/binary.stl" of="$tmp/cut.stl" bs=1 count=300 2> /dev/null
bad "$tmp/cut.stl" 'byte 80: 6 triangles promised, which takes 384 bytes, but the file has 300'
text head.ply 'ply\nformat ascii 1.0\nelement vertex 1\n'
bad "$tmp/head.ply" 'end_header expected, found the end of the file'
text form.ply 'ply\nformat binary 1.0\nend_header\n'
bad "$tmp/form.ply" "line 2: ascii, binary_little_endian or binary_big_endian expected, found 'binary'"
text type.ply 'ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n'
bad "$tmp/type.ply" "line 4: property type expected, found 'half'"
text count.ply 'ply\nformat ascii 1.0\nelement vertex -1\nend_header\n'
bad "$tmp/count.ply" "line 3: element count expected, found '-1'"
text many.ply 'ply\nformat ascii 1.0\nelement vertex 999999999999\nproperty float x\nproperty float y
property float z\nend_header\n0 0 0\n'
bad "$tmp/many.ply" "line 8: 999999999999 rows of 'vertex' promised"
text axis.ply 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n'
bad "$tmp/axis.ply" "lacks one of the properties x, y, z"
text cloud.ply 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z
end_header\n0 0 0\n'
bad "$tmp/cloud.ply" 'points without triangles'
sed 's/^3 1 2 4 9/3 1 2 5 9/' "$tmp/ascii.ply" > "$tmp/index.ply"
bad "$tmp/index.ply" 'line 23: vertex number 5 (from 0), but the file has 5 vertices'
sed 's/^3 1 2 4 9/3 1 2 0.5 9/' "$tmp/ascii.ply" > "$tmp/half.ply"
bad "$tmp/half.ply" 'line 23: vertex index 0.5'

# Every file cut short, at many places: refused or read, and never a crash.
for file in plain.obj other.obj ascii.stl binary.stl ascii.ply little.ply big.ply strips.ply plain.binvox; do
    size=$(wc -c < "$tmp/$file")
    at=1
    ending=${file##*.}
    while [ "$at" -lt "$size" ]; do
        dd if="$tmp/$file" of="$tmp/cut.$ending" bs="$at" count=1 2> /dev/null
        checks=$((checks + 1))
        if [ "$ending" = binvox ]; then
            "$bin/check_voxels" "$tmp/plain.obj" "$tmp/cut.$ending" > "$tmp/out" 2>&1
        else
            "$bin/voxelize" "$tmp/cut.$ending" 4 > "$tmp/out" 2>&1
        fi
        status=$?
        [ "$status" -le 2 ] || fail "exit status $status for the first $at bytes of $file"
        at=$((at + 23))
    done
done

# ---- Dialects: every kind of file that some program writes ------------------------------------------

. tests/test_dialects.sh

# ---- Options ---------------------------------------------------------------------------------------

run 0 "$bin/voxelize" --help
says 'usage: voxelize'
run 2 "$bin/voxelize" teapot 0
says "resolution '0' should be a number from 1 to 65536"
run 2 "$bin/voxelize" teapot 8 9
says "'9' is one argument too many"
run 2 "$bin/voxelize" teapot --size 1,0,1
says "--size: '1,0,1' should be one or three numbers above 0"
run 2 "$bin/voxelize" teapot 8 --size 1
says 'a resolution or --size, not both'
run 2 "$bin/voxelize" teapot -o
says '-o needs a value'
run 2 "$bin/voxelize" teapot -o teapot.gif
says 'should end in .binvox, .vox, .npy, .nrrd, .vti, .png, .obj or .stl'
run 2 "$bin/voxelize" teapot --thick
says "unknown option '--thick'"
run 2 "$bin/voxelize" teapot 16 -o "$tmp/no/such/folder.vox"
says 'No such file or directory'
run 2 "$bin/voxelize" teapot --size 1e-300
says 'too many voxels along x'
run 2 "$bin/voxelize" teapot --size 0.1,0.1,0.2 -o "$tmp/flat.binvox"
says 'a binvox file holds cubic voxels only'
run 2 "$bin/voxelize" "$tmp/plain.obj" 8 -o "$tmp/plain.obj"
says 'this is the mesh: it would be overwritten'
run 2 "$bin/voxelize" "$tmp/plain.obj" 8 -o "$tmp/./plain.obj"       # by another name
says 'this is the mesh: it would be overwritten'
cp "$tmp/ascii.ply" "$tmp/written.ply"
run 2 "$bin/colours" "$tmp/written.ply" 8 "$tmp/./written.ply"
says 'this is the mesh: it would be overwritten'
same 'the mesh is as it was' "$tmp/ascii.ply" "$tmp/written.ply"
run 2 "$bin/trace" "$tmp/no/such/folder.png"
says 'No such file or directory'
run 2 "$bin/voxelize" teapot 8 -o "$tmp/a.npy" -o "$tmp/a.npy"
says 'is named twice'
run 2 "$bin/voxelize" teapot 8 -o -
says 'needs --format'
run 0 "$bin/voxelize" teapot --size=0.5 --origin=0.25 -o "$tmp/a.npy"
run 2 "$bin/voxelize" teapot --thin=1
says '--thin takes no value'
run 0 "$bin/voxelize" --version
says 'voxelize, tribox.h '
run 2 "$bin/voxelize" -- --no-such-file
says 'No such file or directory'
for program in slabs sparse cells octree kdtree slide pick trace colours; do
    run 0 "$bin/$program" -h
    says "usage: $program"
    run 0 "$bin/$program" --version
    run 2 "$bin/$program" --sideways
    says "unknown option '--sideways'"
done
if [ -c /dev/full ]; then      # a full disk: exit status 1, the name, the cause
    run 1 "$bin/voxelize" teapot 64 -o /dev/full --format npy
    says '/dev/full: No space left on device'
fi
run 2 "$bin/check_voxels" teapot
says 'a mesh and a file of voxels are needed'
run 2 "$bin/check_voxels" teapot "$tmp/plain.obj"
says 'should end in .binvox, .vox, .npy, .nrrd, .vti or .mha'
cp "$tmp/plain.obj" "$tmp/mesh.binvox"
run 2 "$bin/check_voxels" teapot "$tmp/mesh.binvox"
says "line 1: a binvox file begins with '#binvox 1'"
run 2 "$bin/slide" teapot 0
run 0 "$bin/slide" teapot 60
says 'z = 0: 200 steps, 0 stops; at z = 0.1: 200 steps, 0 stops'
says 'at 5000: 400 steps, 0 places inside'
says '60 steps, 0 inside the mesh'
run 0 "$bin/pick" teapot 20
says 'picked triangle 8117 at t = 0.88, voxel (24, 3, 17)'
run 2 "$bin/trace"
run 0 "$bin/trace" "$tmp/trace.png" teapot 48
says 'picture    48 x 30'
run 2 "$bin/slabs" teapot 8 0
run 2 "$bin/sparse" teapot many
run 2 "$bin/cells" teapot 64 -1

# ---- Voxels out and in again -----------------------------------------------------------------------

for rule in --closed --half-open --open --thin; do
    for n in 1 7 64 100; do
        run 0 "$bin/voxelize" teapot $n $rule -o "$tmp/teapot.binvox"
        run 0 "$bin/check_voxels" teapot "$tmp/teapot.binvox" $rule
        says 'missing  0'
        says 'extra    0'
    done
done
run 1 "$bin/check_voxels" teapot "$tmp/teapot.binvox" --closed     # the last was thin
says 'extra    0'
says 'voxels deep in triangle'
run 0 "$bin/voxelize" teapot --size 0.1 -o "$tmp/size.binvox"
run 0 "$bin/check_voxels" teapot "$tmp/size.binvox" --size 0.1
run 0 "$bin/voxelize" teapot-closed 64 --solid -o "$tmp/solid.binvox"
run 0 "$bin/check_voxels" teapot-closed "$tmp/solid.binvox" --solid
run 0 "$bin/voxelize" teapot-closed 64 --solid=flood -o "$tmp/solid.binvox"
says 'closed: every edge'
run 0 "$bin/check_voxels" teapot-closed "$tmp/solid.binvox" --solid=flood
run 1 "$bin/check_voxels" teapot-closed "$tmp/solid.binvox" --show 1
says 'missing  0'
says ' voxels from triangle '

# A cube from 0 to 1 in voxels of 1: what touches is decided by the faces alone.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n' > "$tmp/cube.obj"
printf 'f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n' >> "$tmp/cube.obj"
for row in '--closed 27' '--half-open 8' '--open 0' '--thin 27'; do
    run 0 "$bin/voxelize" "$tmp/cube.obj" --size 1 ${row% *}
    says "surface   ${row#* } voxels"
done
run 0 "$bin/voxelize" "$tmp/cube.obj" --size 0.125 --solid --origin 0.0625,0,0
says 'solid     512 voxels'
run 0 "$bin/voxelize" "$tmp/cube.obj" --size 0.5,0.25,0.125 --solid=parts --surface
says 'solid     1 parts, 0 cavities in them: 64 voxels'
says 'with the surface 240 voxels'
grep -v 'f 4 1' "$tmp/cube.obj" > "$tmp/open.obj"  # without the side x = 0: 8 x 8 rows leak, from the other side on
run 0 "$bin/voxelize" "$tmp/open.obj" --size 0.125 --solid
says 'the mesh is open: 64 rows along x'
says 'y,z = 0,0 1,0 2,0, ...'
run 2 "$bin/voxelize" "$tmp/cube.obj" 8 --surface
run 2 "$bin/voxelize" "$tmp/cube.obj" 8 --solid=more

# The octree of a solid, of sides that are and are not whole cells.
for n in 1 2 5 7; do
    run 0 "$bin/octree" --solid teapot-closed $n
    says 'equal to the dense solid'
done

# A cube of 8 with a cavity of 4, wound inwards, and another cube of 3 that overlaps one corner: 448 + 27 - 1.
box() { # box LOW HIGH FIRST_VERTEX WINDING
    for z in $1 $2; do for y in $1 $2; do for x in $1 $2; do echo "v $x $y $z"; done; done; done
    for f in '1 3 4 2' '5 6 8 7' '1 2 6 5' '3 7 8 4' '1 5 7 3' '2 4 8 6'; do
        set -- "$1" "$2" "$3" "$4" $f
        if [ "$4" = out ]; then echo "f $(($5 + $3)) $(($6 + $3)) $(($7 + $3)) $(($8 + $3))"
        else echo "f $(($8 + $3)) $(($7 + $3)) $(($6 + $3)) $(($5 + $3))"; fi
    done
}
{ box 0 8 0 out; box 2 6 8 in; } > "$tmp/cavity.obj"
run 0 "$bin/voxelize" "$tmp/cavity.obj" --size 1 --solid
says 'solid     448 voxels'
{ box 0 8 0 out; box 2 6 8 in; box 7 10 16 out; } > "$tmp/parts.obj"
run 0 "$bin/voxelize" "$tmp/parts.obj" --size 1 --solid=parts
says 'solid     2 parts, 1 cavities in them: 474 voxels'
# Two cubes that touch in one corner are one part, which parity fills as well.
{ box 0 4 0 out; box 4 8 8 out; } > "$tmp/touch.obj"
run 0 "$bin/voxelize" "$tmp/touch.obj" --size 1 --solid=parts
says 'solid     1 parts, 0 cavities in them: 128 voxels'
run 0 "$bin/voxelize" "$tmp/cube.obj" --size 0.125,0.25,0.5 --origin 0.0625,0.125,0.25 --solid=flood
says 'surface   114 voxels'
says 'inside    21 voxels'

# The .obj of a solid teapot is closed, and its faces set again the voxels they bound.
run 0 "$bin/voxelize" teapot-closed 48 --solid -o "$tmp/shell.obj" -o "$tmp/shell.png" -o "$tmp/shell.vox"
run 0 "$bin/voxelize" "$tmp/shell.obj" 48
says 'closed: every edge'

# vox FILE: walks its chunks, and prints models, voxels, voxels outside their model, scenes, and odd sizes in a scene
vox() {
    od -An -v -tu1 "$1" | tr -s ' \n' '\n\n' | sed '/^$/d' | awk '
        { byte[NR - 1] = $1 }
        function half(at) { return byte[at] + 256 * byte[at + 1] }
        function word(at) { return half(at) + 65536 * half(at + 2) }
        END {
            if (word(0) != 542658390 || word(16) != NR - 20) { print "bad sizes"; exit }
            for (at = 20; at < NR; at += 12 + word(at + 4)) {
                if (word(at) == 1163544915) {
                    models++
                    for (a = 0; a < 3; a++) {
                        side[a] = word(at + 12 + 4 * a)
                        odd += side[a] % 2
                    }
                }
                scenes += word(at) == 1347569518
                if (word(at) == 1230657880) {
                    voxels += word(at + 12)
                    for (i = 0; i < word(at + 12); i++) {
                        for (a = 0; a < 3; a++) if (byte[at + 16 + 4 * i + a] >= side[a]) outside++
                    }
                }
            }
            print models + 0, voxels + 0, outside + 0, at == NR ? "whole" : "cut", scenes + 0, (scenes > 0) * odd
        }'
}
for size in 0.1 0.02,0.1,0.1; do
    run 0 "$bin/voxelize" teapot --size $size -o "$tmp/teapot.vox"
    count=$(sed -n 's/^surface *\([0-9]*\) voxels.*/\1/p' "$tmp/out")
    models=$([ $size = 0.1 ] && echo 1 || echo 2)
    vox "$tmp/teapot.vox" > "$tmp/out"
    says "$models $count 0 whole $((models - 1)) 0"
done
# 324 x 43 x 34: models of 256 and 68, both of 44 x 34, whose middles lie at 128 and 290 of 324, and at 22 of 43
grep -ao '_t.\{4\}-*[0-9]* -*[0-9]* [0-9]*' "$tmp/teapot.vox" | sed 's/_t....//' > "$tmp/out"
says '-34 1 17'
says '128 1 17'
run 0 "$bin/voxelize" teapot --size 0.003,0.1,0.1 -o "$tmp/teapot.vox"
says 'the scene reaches beyond 1000 voxels from its middle'
printf 'v 0 0 0\nv 1 0 0\nv 0 2100 1\nf 1 2 3\n' > "$tmp/high.obj"      # y is up: from -1051 to 1051, and not from 0
run 0 "$bin/voxelize" "$tmp/high.obj" --size 1 -o "$tmp/high.vox"
grep -ao '_t.\{4\}-*[0-9]* -*[0-9]* -*[0-9]*' "$tmp/high.vox" | sed 's/_t....//' > "$tmp/out"
says ' -923'

# Arrays hold as many ones as there are voxels; nothing is left of a file's first name.
run 0 "$bin/voxelize" teapot 50 -o "$tmp/a.npy" -o "$tmp/a.nrrd" -o "$tmp/a.vti" -o "$tmp/a.stl"
count=$(sed -n 's/^surface *\([0-9]*\) voxels.*/\1/p' "$tmp/out")
checks=$((checks + 1))
[ -z "$(ls "$tmp" | grep '\.part$')" ] || fail 'a .part file is left'
"$bin/voxelize" teapot 50 -o - --format npy > "$tmp/b.npy" 2> "$tmp/out" || fail 'voxels to the standard output'
says 'surface '
same 'the standard output gets the same file' "$tmp/a.npy" "$tmp/b.npy"
ones() { # FILE BYTES-OF-HEADER
    tail -c +$(($2 + 1)) "$1" | tr -d '\000' | tr '\001' 1 | grep -ao '1' | wc -l | tr -d ' '
}
checks=$((checks + 3))
head -c 128 "$tmp/a.npy" | grep -aq "'descr': '|b1', 'fortran_order': False, 'shape': (25, 32, 50)" || fail '.npy: header'
[ "$(ones "$tmp/a.npy" 128)" = "$count" ] || fail '.npy: other voxels'
header=$(grep -an -m 1 '^$' "$tmp/a.nrrd" | cut -d: -f1)
[ "$(ones "$tmp/a.nrrd" "$(head -n "$header" "$tmp/a.nrrd" | wc -c)")" = "$count" ] || fail '.nrrd: other voxels'
run 0 "$bin/voxelize" "$tmp/a.stl" 50
says 'closed: every edge'

# A cube of 0.9 far from 0, in doubles: 0.1 voxels, 524 of them.
{
    printf 'ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n'
    printf 'element face 6\nproperty list uchar int vertex_indices\nend_header\n'
    for z in 112.3 113.2; do
        for y in 5411932.7 5411933.6000000006; do
            for x in 448262.25 448263.15000000002; do
                echo "$x $y $z"
            done
        done
    done
    printf '4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 1 3 7 5\n4 3 2 6 7\n4 2 0 4 6\n'
} > "$tmp/far.ply"
run 0 "$bin/voxelize" "$tmp/far.ply" --size .1
says 'some coordinates are no floats: all is computed in double'
says 'surface   524 voxels'
# Every program goes on in double, and says so; they agree.
for n in 8 64; do
    run 0 "$bin/voxelize" "$tmp/far.ply" $n
    count=$(sed -n 's/^surface *\([0-9]*\) voxels.*/\1/p' "$tmp/out")
    run 0 "$bin/sparse" "$tmp/far.ply" $n
    says 'all is computed in double'
    says "set       $count different voxels"
    run 0 "$bin/octree" "$tmp/far.ply" $([ $n = 8 ] && echo 3 || echo 6)
    says 'all is computed in double'
    says " $count nodes: the leaves"
    run 0 "$bin/octree" --solid "$tmp/far.ply" $([ $n = 8 ] && echo 3 || echo 6)
    says 'equal to the dense solid'
    run 0 "$bin/slabs" "$tmp/far.ply" $n 3
    says 'all is computed in double'
    says "$count voxels"
    says 'the same'
    run 0 "$bin/cells" "$tmp/far.ply" $n 500
    says 'all is computed in double'
    says 'check     200 rays against all triangles: the same'
done
run 0 "$bin/kdtree" "$tmp/far.ply" 2
says 'all is computed in double'
says 'clipped           418 leaves      820 references'
run 0 "$bin/colours" "$tmp/far.ply" 8 "$tmp/far.vox"
says 'in double'
run 0 "$bin/pick" "$tmp/far.ply" 8
says 'all is computed in double'
says 'picked triangle '
run 0 "$bin/trace" "$tmp/far.png" "$tmp/far.ply" 32
says 'all is computed in double'
run 0 "$bin/slide" "$tmp/far.ply" 9
says 'the mesh is moved by -448262,-5411932,-112 and rounded to floats'

od -An -v -tx1 "$tmp/shell.png" | tr -d ' \n' > "$tmp/out"
says 89504e470d0a1a0a0000000d4948445200000500000003c00802000000
says 0000000049454e44ae426082

. tests/test_voxels.sh

# ---- Threads and sparse sets agree with one fill ----------------------------------------------------

for threads in 1 2 7; do
    run 0 "$bin/slabs" teapot 60 $threads
    says 'the same'
done
run 0 "$bin/slabs" "$tmp/cube.obj" 5 9
says 'the same'
# Triangles in an order that has nothing to do with their place are sorted first.
awk 'BEGIN {
    for (i = 0; i < 3000; i++) {
        s = (s * 16807 + 12345) % 2147483647
        z = s / 21474836
        printf "v %d %d %.3f\nv %d %d %.3f\n", i % 7, i % 11, z, i % 5, i % 13, z + i % 3
        printf "v %d 2 %.3f\nf -1 -2 -3\n", i % 17, z - 1
    }
}' > "$tmp/shuffled.obj"
for threads in 1 2 5; do
    run 0 "$bin/slabs" "$tmp/shuffled.obj" 80 $threads
    says 'the same'
done
run 0 "$bin/voxelize" teapot 90
count=$(sed -n 's/^surface *\([0-9]*\) voxels.*/\1/p' "$tmp/out")
run 0 "$bin/sparse" teapot 90
says "set       $count different voxels"

# ---- Lists of triangles in cells: rays agree with asking all triangles ------------------------------

run 0 "$bin/cells" teapot 20 2000
says 'check     200 rays against all triangles: the same'
run 0 "$bin/cells" "$tmp/cube.obj" 3 500
says 'check     200 rays against all triangles: the same'

echo "examples: $((checks - failures)) passed, $failures failed"
[ "$failures" -eq 0 ]
