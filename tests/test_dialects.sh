# Mesh files as programs write them: read by tests/test_examples.sh, which has run, says, bad and text.
# Each kind of file has its smallest example and the right answer.

# counts FILE TRIANGLES FORMAT: the file is read as that many triangles
counts() {
    run 0 "$bin/voxelize" "$tmp/$1" --size 1
    says ": $3, $2 triangles"
}

# surface VOXELS FILE SIZE ORIGIN: so many voxels
surface() {
    run 0 "$bin/voxelize" "$tmp/$2" --size "$3" --origin "$4"
    says "surface   $1 voxels"
}

# ---- Concave faces: the same voxels from every first corner, both ways round

# turns VOXELS SIZE ORIGIN 'X Y' ...: one polygon at z = 0.5, from each of its corners, there and back
turns() {
    voxels=$1 size=$2 origin=$3
    shift 3
    corners=$#
    first=0
    while [ "$first" -lt "$corners" ]; do
        for step in 1 -1; do
            {
                for corner in "$@"; do
                    echo "v $corner 0.5"
                done
                printf 'f'
                i=0
                while [ "$i" -lt "$corners" ]; do
                    printf ' %d' $(((first + step * i + corners) % corners + 1))
                    i=$((i + 1))
                done
                echo
            } > "$tmp/concave.obj"
            surface "$voxels" concave.obj "$size" "$origin"
        done
        first=$((first + 1))
    done
}
turns 171 0.5 .25,.25,.25 '0 0' '8 8' '0 3' '-8 8'
turns 145 0.5 .25,.25,.25 '0 0' '8 0' '8 2' '2 2' '2 8' '0 8'
turns 301 0.5 .25,.25,.25 '0 0' '9 0' '9 9' '6 9' '6 3' '3 3' '3 9' '0 9'
turns 411 0.5 .25,.25,.25 '0 0' '10 0' '10 10' '6 10' '6 5' '4 5' '4 10' '0 10'
# an L, a U, a plate with a slot, and a frame whose hole is joined to the outline by a double edge
turns 105 0.5 .05,.05,.05 '0 0' '6 0' '6 2' '2 2' '2 6' '0 6'
turns 235 0.5 .05,.05,.05 '0 0' '9 0' '9 7' '6 7' '6 2' '3 2' '3 7' '0 7'
turns 279 0.5 .05,.05,.05 '0 0' '8 0' '8 8' '5 8' '5 3' '4 3' '4 8' '0 8'
turns 240 0.5 .05,.05,.05 '0 0' '8 0' '8 8' '0 8' '0 0' '2 2' '2 6' '6 6' '6 2' '2 2'
# in other planes: the largest area counts
text wall.obj 'v .5 0 0\nv .5 8 8\nv .5 0 3\nv .5 -8 8\nf 2 3 4 1\n'
surface 171 wall.obj 0.5 .25,.25,.25
text floor.obj 'v 0 .5 0\nv 8 .5 8\nv 0 .5 3\nv -8 .5 8\nf 2 3 4 1\n'
surface 171 floor.obj 0.5 .25,.25,.25
# corners on a line between others, and twice in one place
turns 105 0.5 .05,.05,.05 '0 0' '3 0' '6 0' '6 2' '6 2' '2 2' '2 4' '2 6' '0 6'
# a bow tie is two triangles that meet; five corners that cross are refused with their line
text bow.obj 'v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 4 0\nf 1 2 3 4\n'
surface 72 bow.obj 0.5 .05,.05,.05
text star.obj 'v 10 0 0\nv -8.09 5.878 0\nv 3.09 -9.511 0\nv 3.09 9.511 0\nv -8.09 -5.878 0\n\nf 1 2 3 4 5\n'
bad "$tmp/star.obj" 'line 7: a face of 5 corners crosses itself'

# ---- OBJ

text bom.obj '\357\273\277v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'
counts bom.obj 1 OBJ
text comment.obj '# ends in a backslash \\\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\\\nf 1 2 3 # here, too \\\nf 1 3 2\n'
counts comment.obj 2 OBJ
text glued.obj 'v 0 0 0# c\nv 1 0 0#c\nv 0 1 0\nf 1 2 3# c\n'
counts glued.obj 1 OBJ
text flat.obj 'v 0 0\nv 1 0\nv 0 1\nf 1 2 3\n'
counts flat.obj 1 OBJ
text numbers.obj 'v 0 0 0\nv 3.1+e2 0 0\nv 0 1 0\nv 1.#IND 0 0\nv -1.#QNAN 1.#INF 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n'
counts numbers.obj 3 OBJ
says 'x 0 to 310, y 0 to 1'
says '2 triangles with a NaN or infinite corner'

# ---- STL

stl_text() { # NAME, text of the facet's lines
    text "$1" "solid a\n$2"
}
loop='outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop'
stl_text open.stl "facet normal 0 0 1\n$loop\nendfacet\n"
counts open.stl 1 'ASCII STL'
stl_text tail.stl "facet normal 0 0 1\n$loop\nendfacet\nendsolid a\nwritten by hand\n\032"
counts tail.stl 1 'ASCII STL'
stl_text zeros.stl "facet normal 0 0 1\n$loop\nendfacet\nendsolid a\n\000\000\000"
counts zeros.stl 1 'ASCII STL'
stl_text facet.stl "facet normal\n$loop\nendfacet 7\nfacet normal 0 0 1 0 9\n$loop\nendfacet\nend solid\n"
counts facet.stl 2 'ASCII STL'
stl_text colour.stl "color 1 0 0\nfacet normal 0 0 1\n$loop\nendfacet\ncolor 0 1 0\nendsolid\n"
counts colour.stl 1 'ASCII STL'
stl_text quad.stl 'facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 2 2 0\nvertex 0 2 0\nendloop
endfacet\nendsolid\n'
counts quad.stl 2 'ASCII STL'
text nul.stl "solid a\000b\nfacet normal 0 0 1\n$loop\nendfacet\nendsolid\n"
counts nul.stl 1 'ASCII STL'
text line.stl "solid a\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n"
counts line.stl 1 'ASCII STL'

# binary COUNT-BYTES TRAILING: the pyramid of six triangles, which counts COUNT and ends in TRAILING
binary_stl() {
    dd if="$tmp/binary.stl" bs=1 count=80 2> /dev/null
    printf "$1"
    dd if="$tmp/binary.stl" bs=1 skip=84 2> /dev/null
    printf "$2"
}
for count in '\000\000\000\000' '\377\377\377\377' '\002\000\000\000'; do
    binary_stl "$count" '' > "$tmp/count.stl"
    counts count.stl 6 'binary STL'
    says "the file's size says 6; 6 are read"
done
binary_stl '\006\000\000\000' 'tail' > "$tmp/trail.stl"
counts trail.stl 6 'binary STL'
says '4 bytes follow the 6 triangles'
checks=$((checks + 1))
"$bin/voxelize" - --size 1 < "$tmp/trail.stl" > "$tmp/out" 2>&1 || fail 'trailing bytes through a pipe'
says 'binary STL, 6 triangles'

# ---- PLY

ply_text() { # NAME, header lines, body
    text "$1" "ply\nformat ascii 1.0\n$2element vertex 3\nproperty float x\nproperty float y\nproperty float z
element face 2\nproperty list uchar int vertex_indices\nend_header\n$3"
}
ply_text beyond.ply '' '0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0\n3 2 1 0 0\n'
counts beyond.ply 2 'ASCII PLY'
ply_text split.ply '' '0 0\n0\n1 0 0\n0 1 0\n3 0\n1 2\n3 2 1 0\n'
counts split.ply 2 'ASCII PLY'
ply_text joined.ply '' '0 0 0 1 0 0 0 1 0\n3 0 1 2 3 2 1 0\n'
counts joined.ply 2 'ASCII PLY'
ply_text unknown.ply 'generator somebody\n' '0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n'
counts unknown.ply 2 'ASCII PLY'
says "line 3: a header line that is none of PLY's is ignored"
sed '1s/.*/PLY/' "$tmp/beyond.ply" > "$tmp/capital.ply"
counts capital.ply 2 'ASCII PLY'
{ echo; echo; cat "$tmp/beyond.ply"; } > "$tmp/blank.ply"
counts blank.ply 2 'ASCII PLY'
{ printf '\357\273\277'; cat "$tmp/beyond.ply"; } > "$tmp/bom.ply"
counts bom.ply 2 'ASCII PLY'

# ---- OFF

square='4 1 4\n0 0 .5\n8 8 .5\n0 3 .5\n-8 8 .5\n'
text plain.off "OFF\n# a comment\n${square}4 1 2 3 0 255 0 0\n"
surface 171 plain.off 0.5 .25,.25,.25
text above.off "# a tool\n\n#CBP\nOFF\n${square}4 1 2 3 0\n"
surface 171 above.off 0.5 .25,.25,.25
text line.off "OFF $square 4 1 2 3 0\n"
surface 171 line.off 0.5 .25,.25,.25
text colour.off 'COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n'
counts colour.off 1 OFF
text normal.off 'NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n'
counts normal.off 1 OFF
text four.off '4OFF\n1 0 0\n0 0 0 1\n'
bad "$tmp/four.off" 'more than three dimensions'
text packed.off 'OFF BINARY\n'
bad "$tmp/packed.off" 'a binary OFF file'
text index.off 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n'
bad "$tmp/index.off" 'line 6: vertex number 3 (from 0), but the file has 3 vertices'

# ---- glTF: one triangle, turned by a quarter about z and moved to x = 10

positions='\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000\000\000\000\000'
positions="$positions"'\000\000\000\000\000\000\200\077\000\000\000\000'
base64='AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA'
# gltf INDEX-TYPE INDEX-BYTES URI: the JSON
gltf() {
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],'
    printf '"nodes":[{"children":[1],"translation":[10,0,0]},{"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,0,1]}],'
    printf '"meshes":[{"primitives":[{"mode":1,"attributes":{"POSITION":0}},{"attributes":{"POSITION":0},"indices":1}]}],'
    printf '"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},'
    printf '{"bufferView":1,"componentType":%s,"count":3,"type":"SCALAR"}],' "$1"
    printf '"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":%s}],' "$2"
    printf '"buffers":[{"byteLength":%s%s}]}' $((36 + $2)) "$3"
}
gltf 5123 6 ',"uri":"data:application/octet-stream;base64,'"$base64"'AAABAAIA"' > "$tmp/data.gltf"
printf "$positions"'\000\001\002' > "$tmp/a mesh.bin"
gltf 5121 3 ',"uri":"a%20mesh.bin"' > "$tmp/beside.gltf"
json=$(gltf 5125 12 '')
while [ $((${#json} % 4)) -ne 0 ]; do
    json="$json "
done
le32() { # a number as four bytes
    printf "\\$(printf %o $(($1 % 256)))\\$(printf %o $(($1 / 256 % 256)))\\000\\000"
}
{
    printf 'glTF\002\000\000\000'
    le32 $((20 + ${#json} + 8 + 48))
    le32 ${#json}
    printf 'JSON%s' "$json"
    le32 48
    printf 'BIN\000'"$positions"'\000\000\000\000\001\000\000\000\002\000\000\000'
} > "$tmp/binary.glb"
for file in data.gltf beside.gltf binary.glb; do
    run 0 "$bin/voxelize" "$tmp/$file" --size 1
    says 'glTF, 1 triangles'
    says 'x 9 to 10, y 0 to 1, z 0 to 0'
done
sed 's/a%20mesh/no%20mesh/' "$tmp/beside.gltf" > "$tmp/lost.gltf"
bad "$tmp/lost.gltf" 'no mesh.bin: No such file'
sed 's/"count":3,"type":"VEC3"/"count":4,"type":"VEC3"/' "$tmp/beside.gltf" > "$tmp/reach.gltf"
bad "$tmp/reach.gltf" 'accessor 0 reaches beyond its buffer'
sed 's/"children":\[1\]/"children":[1,1]/' "$tmp/data.gltf" > "$tmp/twice.gltf"
bad "$tmp/twice.gltf" 'node 1 is not there, has two parents'
text other.gltf '{"a": [1, 2, {"b": "c"}]}'
bad "$tmp/other.gltf" 'it has no asset.version'
text old.gltf '{"asset": {"version": "1.0"}, "meshes": {}}'
bad "$tmp/old.gltf" 'this is glTF 1.0'
text cut.gltf '{"asset": '
bad "$tmp/cut.gltf" 'the file ends within its JSON'

# Half a turn about z by a quaternion, larger, moved; and of two scenes the one that is asked for
sed 's/"matrix":\[[^]]*\]/"rotation":[0,0,1,0],"scale":[2,3,4]/' "$tmp/data.gltf" > "$tmp/turned.gltf"
run 0 "$bin/voxelize" "$tmp/turned.gltf" --size 1
says 'x 8 to 10, y -3 to 0, z 0 to 0'
sed 's/"scene":0,"scenes":\[{"nodes":\[0\]}\]/"scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}]/; s/"children":\[1\],//' \
    "$tmp/data.gltf" > "$tmp/scenes.gltf"
run 0 "$bin/voxelize" "$tmp/scenes.gltf" --size 1
says 'x -1 to 0, y 0 to 1'

# ---- A byte order mark before the others

for file in ascii.stl:'ASCII STL, 6' plain.off:'OFF, 2' data.gltf:'glTF, 1'; do
    { printf '\357\273\277'; cat "$tmp/${file%%:*}"; } > "$tmp/marked"
    run 0 "$bin/voxelize" "$tmp/marked" --size 1
    says "${file#*:} triangles"
done

# ---- What is named in the error

text a.gz '\037\213\010\000'
bad "$tmp/a.gz" 'this is a gzip file: unpack it first'
text a.3mf 'PK\003\004'
bad "$tmp/a.3mf" 'this is a zip archive (3MF'
text a.dae '<?xml version="1.0"?>\n<COLLADA></COLLADA>\n'
bad "$tmp/a.dae" 'this is a COLLADA (DAE) file'
text a.step 'ISO-10303-21;\n'
bad "$tmp/a.step" 'this is a STEP file'
text a.txt '\377\376v\000 \000'
bad "$tmp/a.txt" 'this text is UTF-16'

# ---- Digits: a coordinate that is no float is kept as a double

text digits.obj 'v 5411932.7 0 0\nv 5411933.7 0.1 0\nv 5411932.7 1 0\nf 1 2 3\n'
run 0 "$bin/voxelize" "$tmp/digits.obj" --size 1
says 'x 5411932.7 to 5411933.7, y 0 to 1'
text floats.obj 'v 0.1 0.3 0.7\nv 1.1 0.3 0.7\nv 0.1 123456.7 0.7\nf 1 2 3\n'
run 0 "$bin/voxelize" "$tmp/floats.obj" --size 1000
says 'x 0.1 to 1.1, y 0.3 to 123456.7'

# ---- Colours: of the vertices, of the materials, into a palette

printf 'newmtl red one\nKd 1 0 0\nnewmtl blue\nKd 0 0 .5\n' > "$tmp/colours.mtl"
text colours.obj 'mtllib colours.mtl\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 4 4 0\nusemtl red one\nf 1 2 3\nusemtl blue\nf 2 4 3\n'
run 0 "$bin/colours" "$tmp/colours.obj" 16 "$tmp/colours.vox"
says 'each with a colour: of the materials'
checks=$((checks + 1))     # the palette begins with the two: red and blue
od -An -v -tx1 "$tmp/colours.vox" | tr -d ' \n' | grep -Eq '524742410004000000000000(ff0000ff000080ff|000080ffff0000ff)' ||
    fail 'the palette holds the materials'
text vertex.obj 'v 0 0 0 1 0 0\nv 4 0 0 1 0 0\nv 0 4 0 1 0 0\nf 1 2 3\n'
run 0 "$bin/colours" "$tmp/vertex.obj" 16 "$tmp/vertex.ply"
says 'mean      red 1.00 green 0.00 blue 0.00'
checks=$((checks + 1))
grep -q ' 255 0 0$' "$tmp/vertex.ply" || fail 'the PLY holds the colours'
text lost.obj 'mtllib lost.mtl\nv 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n'
run 0 "$bin/voxelize" "$tmp/lost.obj" 8
says "warning: $tmp/lost.obj: line 1: the materials of 'lost.mtl' are not read"
sed 's/property float z/&\nproperty uchar red\nproperty uchar green\nproperty uchar blue/; s/^0 0 0$/0 0 0 0 255 0/; s/^1 0 0$/1 0 0 0 255 0/; s/^0 1 0$/0 1 0 0 255 0/' \
    "$tmp/beyond.ply" > "$tmp/green.ply"
run 0 "$bin/colours" "$tmp/green.ply" 16
says 'mean      red 0.00 green 1.00 blue 0.00'
sed 's/"indices":1}/"indices":1,"material":0}/; s/"accessors"/"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0,1,1]}}],&/' \
    "$tmp/data.gltf" > "$tmp/material.gltf"
run 0 "$bin/colours" "$tmp/material.gltf" 8
says 'mean      red 0.74 green 0.00 blue 1.00'
