// Open3D, doubles: IntersectionTest::TriangleAABB.
#include "peers.h"
#include <cstdio>
#include <open3d/geometry/IntersectionTest.h>
static void peer_begin() {}
static const char *peer_name() { return "Open3D 0.16.1, IntersectionTest::TriangleAABB"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    const Eigen::Vector3d a(lo[0], lo[1], lo[2]);
    const Eigen::Vector3d b(hi[0], hi[1], hi[2]);
    return open3d::geometry::IntersectionTest::TriangleAABB(0.5 * (a + b), 0.5 * (b - a), Eigen::Vector3d(v[0], v[1], v[2]),
                                                            Eigen::Vector3d(v[3], v[4], v[5]), Eigen::Vector3d(v[6], v[7], v[8]));
}
PEER_MAIN
