/* mesh_gen.h - the meshes that benches make for themselves: a bumpy scan, terraces on grid planes, and an
 * octahedron whose edges run through grid corners.
 */
#ifndef MESH_GEN_H
#define MESH_GEN_H

#include "bench.h"
#include "mesh_io.h"

#include <math.h>

static inline void mesh_gen_alloc(mesh *m, size_t vertices, size_t triangles)
{
    memset(m, 0, sizeof *m);
    m->positions = (float *)bench_alloc(3 * vertices * sizeof *m->positions);
    m->indices = (uint32_t *)bench_alloc(3 * triangles * sizeof *m->indices);
    m->vertices = vertices;
    m->triangles = triangles;
}

static inline void mesh_gen_triangle(mesh *m, size_t i, size_t a, size_t b, size_t c)
{
    m->indices[3 * i] = (uint32_t)a;
    m->indices[3 * i + 1] = (uint32_t)b;
    m->indices[3 * i + 2] = (uint32_t)c;
}

/* ---- Scan ---------------------------------------------------------------------------------------------- */

/* A point of a tube along a trefoil knot, s and t in turns, its surface raised by broad bumps, folds and fine
 * grain. */
static inline void mesh_gen_knot(double s, double t, double grain, float out_point[3])
{
    const double turn = 6.283185307179586;
    double u = turn * s;
    double v = turn * t;
    double tx = cos(u) + 4 * cos(2 * u);
    double ty = 4 * sin(2 * u) - sin(u);
    double tz = -3 * cos(3 * u);
    double flat = sqrt(tx * tx + ty * ty);
    double length = sqrt(flat * flat + tz * tz);
    double nx =
        ty / flat; /* the normal across the tube that lies level, and the one that completes the frame */
    double ny = -tx / flat;
    double bx = -ny * tz / length;
    double by = nx * tz / length;
    double bz = (tx * ny - ty * nx) / length;
    double radius = 0.36 + 0.07 * sin(5 * u + 2 * v) + 0.03 * sin(23 * u) * sin(3 * v) +
                    0.015 * sin(61 * u + 7 * v) * cos(5 * v - 31 * u) + grain;
    double across = radius * cos(v);
    double up = radius * sin(v);
    out_point[0] = (float)(sin(u) + 2 * sin(2 * u) + across * nx + up * bx);
    out_point[1] = (float)(cos(u) - 2 * cos(2 * u) + across * ny + up * by);
    out_point[2] = (float)(-sin(3 * u) + up * bz);
}

/* A closed surface of 2*along*around small irregular triangles, neighbours stored near each other as scanners
 * do. Each vertex strays by up to 0.3 of its cell along the surface and a little across. */
static inline void mesh_gen_scan(mesh *m, int along, int around)
{
    uint64_t seed = 7;
    size_t triangle = 0;
    int i;
    int j;
    mesh_gen_alloc(m, (size_t)along * (size_t)around, 2 * (size_t)along * (size_t)around);
    for (i = 0; i < along; i++) {
        for (j = 0; j < around; j++) {
            double s = (i + (double)bench_uniform(&seed, -0.3f, 0.3f)) / along;
            double t = (j + (double)bench_uniform(&seed, -0.3f, 0.3f)) / around;
            double grain = (double)bench_uniform(&seed, -0.5f, 0.5f) / around;
            mesh_gen_knot(s, t, grain, m->positions + 3 * (i * around + j));
        }
    }
    for (i = 0; i < along; i++) {
        for (j = 0; j < around; j++) {
            size_t right = (size_t)((j + 1) % around);
            size_t row = (size_t)i * (size_t)around;
            size_t next = (size_t)((i + 1) % along) * (size_t)around;
            mesh_gen_triangle(m, triangle++, row + (size_t)j, row + right, next + (size_t)j);
            mesh_gen_triangle(m, triangle++, next + (size_t)j, row + right, next + right);
        }
    }
}

/* ---- On grid planes and through grid corners ----------------------------------------------------------- */

enum { MESH_GEN_EXTENT = 128 }; /* the lattice meshes lie in [0, 128]^3 */

/* Whether lattice cell (x,y,z) of n^3 belongs to a ball. */
static inline int mesh_gen_in_ball(int x, int y, int z, int n)
{
    double r = 0.47 * n;
    double dx = x + 0.5 - 0.5 * n;
    double dy = y + 0.5 - 0.5 * n;
    double dz = z + 0.5 - 0.5 * n;
    return dx * dx + dy * dy + dz * dz < r * r;
}

/* The quad between cell and its neighbour at +axis, as two triangles. */
static inline void mesh_gen_quad(mesh *m, size_t quad, const int cell[3], int axis, float scale)
{
    int b = (axis + 1) % 3;
    int c = (axis + 2) % 3;
    size_t k;
    for (k = 0; k < 4; k++) {
        float *v = m->positions + 3 * (4 * quad + k);
        v[axis] = scale * (float)(cell[axis] + 1);
        v[b] = scale * (float)(cell[b] + (k == 1 || k == 2));
        v[c] = scale * (float)(cell[c] + (k >= 2));
    }
    mesh_gen_triangle(m, 2 * quad, 4 * quad, 4 * quad + 1, 4 * quad + 2);
    mesh_gen_triangle(m, 2 * quad + 1, 4 * quad, 4 * quad + 2, 4 * quad + 3);
}

/* A ball of terraces, as parts cut on a lattice of n^3 cells are: every face on a grid plane, every diagonal
 * at 45 degrees through grid corners. With m NULL only counts. Returns the quads. */
static inline size_t mesh_gen_terrace_quads(mesh *m, int n)
{
    size_t quads = 0;
    int cell[3];
    for (cell[2] = -1; cell[2] < n; cell[2]++) {
        for (cell[1] = -1; cell[1] < n; cell[1]++) {
            for (cell[0] = -1; cell[0] < n; cell[0]++) {
                int here = mesh_gen_in_ball(cell[0], cell[1], cell[2], n);
                int axis;
                for (axis = 0; axis < 3; axis++) {
                    int beyond = mesh_gen_in_ball(cell[0] + (axis == 0), cell[1] + (axis == 1),
                                                  cell[2] + (axis == 2), n);
                    if (here != beyond) {
                        if (m != NULL) {
                            mesh_gen_quad(m, quads, cell, axis, (float)MESH_GEN_EXTENT / (float)n);
                        }
                        quads++;
                    }
                }
            }
        }
    }
    return quads;
}

static inline void mesh_gen_terraces(mesh *m, int n)
{
    size_t quads = mesh_gen_terrace_quads(NULL, n);
    mesh_gen_alloc(m, 4 * quads, 2 * quads);
    mesh_gen_terrace_quads(m, n);
}

/* An octahedron, each face cut into n^2 triangles with corners on the lattice: every edge at 45 degrees
 * through grid corners in projection, every face's plane through grid corners too. */
static inline void mesh_gen_octahedron(mesh *m, int n)
{
    float half = 0.5f * (float)MESH_GEN_EXTENT;
    size_t per_face = (size_t)(n + 1) * (size_t)(n + 2) / 2;
    size_t vertex = 0;
    size_t triangle = 0;
    int face;
    mesh_gen_alloc(m, 8 * per_face, 8 * (size_t)n * (size_t)n);
    for (face = 0; face < 8; face++) {
        int i;
        int j;
        for (i = 0; i <= n; i++) {
            for (j = 0; j <= n - i; j++) {
                float *v = m->positions + 3 * vertex;
                size_t below = vertex + (size_t)(n - i + 1); /* the vertex (i + 1, j) */
                v[0] = half + half * (float)(face & 1 ? i : -i) / (float)n;
                v[1] = half + half * (float)(face & 2 ? j : -j) / (float)n;
                v[2] = half + half * (float)(face & 4 ? n - i - j : i + j - n) / (float)n;
                if (i + j < n) {
                    mesh_gen_triangle(m, triangle++, vertex, vertex + 1, below);
                }
                if (i + j < n - 1) {
                    mesh_gen_triangle(m, triangle++, vertex + 1, below + 1, below);
                }
                vertex++;
            }
        }
    }
}

/* Turns and shifts the mesh in general directions: the same triangles with nothing on a grid plane. */
static inline void mesh_gen_tilt(mesh *m)
{
    /* 193 times the rotation of the quaternion 12 + 2i + 3j + 6k */
    static const double turn[3][3] = {{103, -132, 96}, {156, 113, -12}, {-48, 84, 167}};
    size_t i;
    int k;
    for (i = 0; i < m->vertices; i++) {
        float *v = m->positions + 3 * i;
        double p[3];
        for (k = 0; k < 3; k++) {
            p[k] =
                (turn[k][0] * (double)v[0] + turn[k][1] * (double)v[1] + turn[k][2] * (double)v[2]) / 193.0;
        }
        for (k = 0; k < 3; k++) {
            v[k] = (float)(p[k] + 0.3713);
        }
    }
}

#endif /* MESH_GEN_H */
