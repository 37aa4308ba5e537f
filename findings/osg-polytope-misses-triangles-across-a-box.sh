#!/usr/bin/env bash
# OpenSceneGraph's Polytope::contains(triangle) says no to a triangle that passes through the box.
#
# The polytope is that of a bounding box. The triangle's corners lie around it, its middle part inside: contains(point) says yes
# to more than a thousand points of the triangle, contains(triangle) says no. Of random pairs about 0.5 % are missed.
#
# Seen with OpenSceneGraph 3.6.5. Exits with 1 if that is no longer so.
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
fetch libopenscenegraph-dev=3.6.5+dfsg1-8+b2 libopenscenegraph161=3.6.5+dfsg1-8+b2
cat >cross.cxx <<'C'
#include <cstdio>
#include <osg/Polytope>
#include <osg/Version>

int main()
{
    const osg::Vec3f a(0.594f, -0.269f, -0.651f), b(-0.873f, 0.936f, 0.293f), c(-0.837f, -0.686f, 0.708f);
    osg::Polytope box;
    box.setToBoundingBox(osg::BoundingBox(-0.777f, 0.0f, -0.085f, 0.141f, 0.103f, 0.436f));
    int inside = 0;
    const int n = 200;
    for (int i = 0; i <= n; i++) {
        for (int j = 0; i + j <= n; j++) {
            inside += box.contains(a * ((float)i / n) + b * ((float)j / n) + c * ((float)(n - i - j) / n));
        }
    }
    std::printf("%s: %d points of the triangle inside, the triangle: %d", osgGetVersion(), inside, (int)box.contains(a, b, c));
    return 0;
}
C
g++ -w cross.cxx -o cross -losg
said=$(./cross)
echo "$said"
case $said in "3.6.5: 0 points"*) exit 1 ;; "3.6.5: "*" the triangle: 0") ;; *) exit 1 ;; esac
