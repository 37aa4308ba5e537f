// GTS, doubles: gts_bbox_overlaps_triangle.
#include "peers.h"
#include <cstdio>
#include <gts.h>
static GtsVertex *corner[3];
static GtsTriangle *triangle;
static GtsBBox *box;
static void peer_begin()
{
    for (int i = 0; i < 3; i++) {
        corner[i] = gts_vertex_new(gts_vertex_class(), 0, 0, 0);
    }
    triangle = gts_triangle_new(gts_triangle_class(), gts_edge_new(gts_edge_class(), corner[0], corner[1]),
                                gts_edge_new(gts_edge_class(), corner[1], corner[2]),
                                gts_edge_new(gts_edge_class(), corner[2], corner[0]));
    box = gts_bbox_new(gts_bbox_class(), NULL, 0, 0, 0, 1, 1, 1);
}
static const char *peer_name() { return "GTS 0.7.6, gts_bbox_overlaps_triangle"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    for (int i = 0; i < 3; i++) {
        gts_point_set(GTS_POINT(corner[i]), v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    }
    gts_bbox_set(box, NULL, lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
    return gts_bbox_overlaps_triangle(box, triangle) != 0;
}
PEER_MAIN
