#!/usr/bin/env bash
# The box tests of other libraries on our hard cases: false answers per million, "missed + invented", as a table.
#
#   bash tests/peers/boxes.sh BUILD [cases of each class]        works in BUILD/peers
#
# Debian packages: libgts-dev libcgal-dev libode-dev libbullet-dev libfcl-dev libopenscenegraph-dev libopen3d-dev libvtk9-dev;
# npm for the last rows. Embree has no test of a box against a triangle.
set -u
cd "$(dirname "$0")/../.." || exit 1
work=${1:-build}/peers
count=${2:-20000}
peers=tests/peers
mkdir -p "$work"
cc -std=c99 -O1 -I. $peers/cases.c -o "$work/cases" -lm || exit 1
echo '| test | random | far off (+1000) | tenths | integers | in a face plane | repeated corner | sliver | one ulp | face plane, doubles |'
echo '| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |'

"$work/cases" "$work/cases.bin" "$count" || exit 1

# peer NAME FLAGS...: builds and runs box_NAME.cxx; a row, or what went wrong
peer() {
    local name=$1
    shift
    if ! [ -x "$work/box_$name" ] && ! g++ -O2 -w -std=c++17 -DNDEBUG -I. -I$peers $peers/box_$name.cxx -o "$work/box_$name" "$@" \
        >"$work/box_$name.log" 2>&1; then
        echo "SKIP: $name: $(grep -m 1 -E 'error|undefined|cannot find' "$work/box_$name.log")"
        return
    fi
    timeout 120 "$work/box_$name" "$work/cases.bin" 2>"$work/box_$name.said" || echo "$name: ended with status $?"
}
vtk=/usr/include/vtk-9.1
peer tribox
peer sat
peer gts $(pkg-config --cflags --libs gts glib-2.0 2>/dev/null || echo -lgts -lglib-2.0)
peer cgal -frounding-math -lgmp -lmpfr
peer ode $(pkg-config --cflags --libs ode 2>/dev/null || echo -lode)
peer bullet -I/usr/include/bullet -lBulletCollision -lLinearMath
peer fcl -I/usr/include/eigen3 -lfcl -lccd
peer osg -losg
peer open3d -I/usr/include/eigen3 -lOpen3D
peer vtk -I$vtk -lvtkFiltersGeneral-9.1 -lvtkCommonDataModel-9.1 -lvtkCommonExecutionModel-9.1 -lvtkCommonCore-9.1
if command -v npm >/dev/null; then
    mkdir -p "$work/npm"
    (cd "$work/npm" && { [ -d node_modules ] || npm install --silent three@0.187.0 three-mesh-bvh@0.9.17 \
        @dimforge/rapier3d-compat@0.21.0 >npm.log 2>&1; } && node --no-deprecation "$OLDPWD/$peers/boxes.mjs" ../cases.bin) || echo 'SKIP: npm'
fi
