// CGAL: do_intersect of an iso-cuboid and a triangle, in the kernel of exact predicates.
#include "peers.h"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <CGAL/version.h>
#include <cstdio>
typedef CGAL::Exact_predicates_inexact_constructions_kernel K;
static void peer_begin() {}
static const char *peer_name() { return "CGAL " CGAL_VERSION_STR ", do_intersect of Bbox_3, Triangle_3 (Epick)"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    const K::Triangle_3 t(K::Point_3(v[0], v[1], v[2]), K::Point_3(v[3], v[4], v[5]), K::Point_3(v[6], v[7], v[8]));
    return CGAL::do_intersect(CGAL::Bbox_3(lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]), t);
}
PEER_MAIN
