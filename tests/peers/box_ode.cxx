// ODE: contacts of a box and a trimesh of one triangle.
#include "peers.h"
#include <cstdio>
#include <cstring>
#include <ode/ode.h>
static dTriIndex index_of[3] = {0, 1, 2};
static void peer_begin() { dInitODE(); }
static const char *peer_name() { return sizeof(dReal) == 8 ? "ODE 0.16.2 (double), dCollide of box, trimesh" : "ODE 0.16.2 (float), dCollide of box, trimesh"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    dContactGeom contacts[8];
    dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, v, 3 * sizeof(double), 3, index_of, 3, 3 * sizeof(dTriIndex));
    dGeomID mesh = dCreateTriMesh(0, data, 0, 0, 0);
    dGeomID box = dCreateBox(0, hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
    dGeomSetPosition(box, 0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), 0.5 * (lo[2] + hi[2]));
    const int n = dCollide(box, mesh, 8, contacts, sizeof(dContactGeom));
    dGeomDestroy(box);
    dGeomDestroy(mesh);
    dGeomTriMeshDataDestroy(data);
    return n > 0;
}
PEER_MAIN
