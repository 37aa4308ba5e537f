#!/usr/bin/env bash
# GTS' gts_bbox_overlaps_triangle takes doubles, but rounds the triangle's edges to float: triangles inside are missed.
#
# Coordinates are doubles (gdouble). What missing shows: the answer depends on whether the edges' components, rounded to
# float, come out smaller: with edges of whole numbers nothing is missed, with tenths most triangles
# that lie 1e-9 below the upper face of a box of side 1, and pass through it, are said not to touch it. (Where a corner of the triangle lies in the box, the answer comes
# before the test.)
#
# Seen with GTS 0.7.6. Exits with 1 if that is no longer so.
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
fetch libgts-dev=0.7.6+darcs121130-5+b1 libgts-0.7-5=0.7.6+darcs121130-5+b1
cat >face.c <<'C'
#include <gts.h>
#include <stdio.h>

static int missed(double step)
{
    int count = 0;
    int i;
    for (i = 1; i <= 1000; i++) {
        GtsVertex *a = gts_vertex_new(gts_vertex_class(), -5, -4, 1 - 1e-9);
        GtsVertex *b = gts_vertex_new(gts_vertex_class(), 9, -5 - i * step, 1 - 1e-9);
        GtsVertex *c = gts_vertex_new(gts_vertex_class(), 2, 12 + 3 * i * step, 1 - 1e-9);
        GtsEdge *ab = gts_edge_new(gts_edge_class(), a, b);
        GtsEdge *bc = gts_edge_new(gts_edge_class(), b, c);
        GtsEdge *ca = gts_edge_new(gts_edge_class(), c, a);
        GtsTriangle *t = gts_triangle_new(gts_triangle_class(), ab, bc, ca);
        GtsBBox *box = gts_bbox_new(gts_bbox_class(), NULL, 0, 0, 0, 1, 1, 1);
        count += !gts_bbox_overlaps_triangle(box, t);
    }
    return count;
}

int main(void)
{
    printf("%d %d", missed(1), missed(0.1));
    return 0;
}
C
# shellcheck disable=SC2046 # flags
cc -w face.c -o face $(pkg-config --cflags --libs gts glib-2.0)
said=$(./face)
echo "of 1000 triangles 1e-9 inside their box, missed with whole numbers, with tenths: $said"
[ "${said% *}" = 0 ] && [ "${said#* }" -ge 500 ]
