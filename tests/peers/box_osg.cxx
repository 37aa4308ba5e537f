// OpenSceneGraph: osg::Polytope of a box, contains(triangle).
#include "peers.h"
#include <cstdio>
#include <osg/Polytope>
#include <osg/Version>
static char name[100];
static void peer_begin() { std::snprintf(name, sizeof name, "OpenSceneGraph %s, osg::Polytope::contains", osgGetVersion()); }
static const char *peer_name() { return name; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    osg::Polytope box;
    for (int i = 0; i < 15; i++) {
        const double x = i < 9 ? v[i] : i < 12 ? lo[i - 9] : hi[i - 12];
        if ((double)(float)x != x) {
            return -1;
        }
    }
    box.setToBoundingBox(osg::BoundingBox((float)lo[0], (float)lo[1], (float)lo[2], (float)hi[0], (float)hi[1], (float)hi[2]));
    return box.contains(osg::Vec3f((float)v[0], (float)v[1], (float)v[2]), osg::Vec3f((float)v[3], (float)v[4], (float)v[5]),
                        osg::Vec3f((float)v[6], (float)v[7], (float)v[8]));
}
PEER_MAIN
