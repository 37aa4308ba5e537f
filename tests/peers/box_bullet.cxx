// Bullet, floats: btAABB::collide_triangle_exact of its GImpact boxes, after the bounding boxes, which it takes for tested.
#include "peers.h"
#include <BulletCollision/Gimpact/btBoxCollision.h>
#include <BulletCollision/Gimpact/btClipPolygon.h>
#include <BulletCollision/Gimpact/btGeometryOperations.h>
#include <cstdio>
static void peer_begin() {}
static const char *peer_name() { return "Bullet 3.24, btAABB::has_collision and collide_triangle_exact"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    btVector3 p[3];
    btVector4 plane;
    btAABB box;
    for (int i = 0; i < 15; i++) {
        const double x = i < 9 ? v[i] : i < 12 ? lo[i - 9] : hi[i - 12];
        if ((double)(float)x != x) {
            return -1;
        }
    }
    for (int i = 0; i < 3; i++) {
        p[i] = btVector3((btScalar)v[3 * i], (btScalar)v[3 * i + 1], (btScalar)v[3 * i + 2]);
    }
    box.m_min = btVector3((btScalar)lo[0], (btScalar)lo[1], (btScalar)lo[2]);
    box.m_max = btVector3((btScalar)hi[0], (btScalar)hi[1], (btScalar)hi[2]);
    const btVector3 n = (p[1] - p[0]).cross(p[2] - p[0]);
    plane.setValue(n[0], n[1], n[2], n.dot(p[0]));
    return btAABB(p[0], p[1], p[2]).has_collision(box) && box.collide_triangle_exact(p[0], p[1], p[2], plane);
}
PEER_MAIN
