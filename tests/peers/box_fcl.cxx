// FCL, doubles: collide of a box and a triangle (GJK of libccd).
#include "peers.h"
#include <cstdio>
#include <fcl/config.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/triangle_p.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
static void peer_begin() {}
static const char *peer_name() { return "FCL " FCL_VERSION ", shapeTriangleIntersect of Box (GJK, libccd)"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    static const fcl::detail::GJKSolver_libccd<double> solver;
    const fcl::Box<double> box(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
    fcl::Transform3<double> at = fcl::Transform3<double>::Identity();
    at.translation() = fcl::Vector3<double>(0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), 0.5 * (lo[2] + hi[2]));
    return solver.shapeTriangleIntersect(box, at, fcl::Vector3<double>(v[0], v[1], v[2]), fcl::Vector3<double>(v[3], v[4], v[5]),
                                         fcl::Vector3<double>(v[6], v[7], v[8]), nullptr, nullptr, nullptr);
}
PEER_MAIN
