/* mesh_stats.h - what there is to say about a mesh before it is voxelized: extent, odd triangles, edges */
#ifndef EXAMPLES_MESH_STATS_H
#define EXAMPLES_MESH_STATS_H
#include "mesh_io.h"

typedef struct mesh_stats {
    double min[3];          /* of the triangles that are finite; min > max if there is none */
    double max[3];
    size_t nonfinite;       /* triangles with a NaN or infinite corner: no set of points, they set no voxel */
    /* finite triangles without area (in double): segments and points, they do set voxels */
    size_t degenerate;
} mesh_stats;

/* NaN and infinity, told by the bits, so that no compiler flag can fold the question away. */
static inline int mesh_is_finite(const double *position) {
    uint64_t bits[3];
    memcpy(bits, position, sizeof bits);
    return (bits[0] >> 52 & 0x7ff) != 0x7ff && (bits[1] >> 52 & 0x7ff) != 0x7ff && (bits[2] >> 52 & 0x7ff) != 0x7ff;
}

/* The corners of triangle t. Returns 1 if all are finite. */
static inline int mesh_triangle(const mesh *m, size_t t, double out[3][3]) {
    mesh_corner_f64(m, t, 0, out[0]);
    mesh_corner_f64(m, t, 1, out[1]);
    mesh_corner_f64(m, t, 2, out[2]);
    return mesh_is_finite(out[0]) && mesh_is_finite(out[1]) && mesh_is_finite(out[2]);
}

static inline int mesh_is_degenerate(double corner[3][3]) {
    int a;
    for (a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        double pa = corner[1][a] - corner[0][a];
        double pb = corner[1][b] - corner[0][b];
        double qa = corner[2][a] - corner[0][a];
        double qb = corner[2][b] - corner[0][b];
        if (pa * qb != pb * qa) {
            return 0;
        }
    }
    return 1;
}

static inline mesh_stats mesh_measure(const mesh *m) {
    mesh_stats s = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, 0, 0};
    double corner[3][3];
    size_t t;
    int i;
    int a;
    for (t = 0; t < m->triangles; t++) {
        if (!mesh_triangle(m, t, corner)) {
            s.nonfinite += 1;
            continue;
        }
        s.degenerate += mesh_is_degenerate(corner) ? 1 : 0;
        for (i = 0; i < 3; i++) {
            for (a = 0; a < 3; a++) {
                s.min[a] = corner[i][a] < s.min[a] ? corner[i][a] : s.min[a];
                s.max[a] = corner[i][a] > s.max[a] ? corner[i][a] : s.max[a];
            }
        }
    }
    return s;
}

/* A number for each place in space: the slot of a hash table that holds the first corner found there, or an empty
   one. -0 counts as 0. */
static inline size_t mesh_weld(const uint32_t *table, size_t mask, const mesh *m, const double *position) {
    double p[3];
    uint64_t bits[3];
    uint64_t hash;
    size_t at;
    int a;
    for (a = 0; a < 3; a++) {
        p[a] = position[a] + 0.0;
    }
    memcpy(bits, p, sizeof bits);
    hash = (bits[0] * 0x9e3779b97f4a7c15u ^ bits[1]) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ hash >> 29 ^ bits[2]) * 0x94d049bb133111ebu;
    for (at = (size_t)(hash >> 20) & mask; table[at] != UINT32_MAX; at = (at + 1) & mask) {
        double q[3];
        mesh_corner_f64(m, table[at] / 3, table[at] % 3, q);
        if (q[0] == p[0] && q[1] == p[1] && q[2] == p[2]) {
            break;
        }
    }
    return at;
}

static inline int mesh_compare_u64(const void *a, const void *b) {
    uint64_t x;
    uint64_t y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return x < y ? -1 : x > y;
}

/* How many edges belong to an odd number of triangles, corners in one place being one vertex. A closed
 * surface has none.
 *
 * Returns 1, or 0 if memory is short or there are too many triangles.
 */
static inline int mesh_open_edges(const mesh *m, size_t *out_count) {
    size_t corners = 3 * m->triangles;
    size_t slots = 64;
    uint32_t *table = NULL;
    uint64_t *edge = NULL;
    size_t edges = 0;
    size_t i;
    int ok;
    if (m->triangles > UINT32_MAX / 8) {
        return 0;
    }
    while (slots < 2 * corners) {
        slots *= 2;
    }
    table = (uint32_t *)malloc(slots * sizeof *table);
    edge = (uint64_t *)malloc(corners * sizeof *edge + 1);
    ok = table && edge;
    if (ok) {
        memset(table, 0xff, slots * sizeof *table);
    }
    *out_count = 0;
    for (i = 0; ok && i < m->triangles; i++) {
        double corner[3][3];
        uint32_t id[3];
        size_t k;
        if (!mesh_triangle(m, i, corner)) {
            continue;
        }
        for (k = 0; k < 3; k++) {
            size_t slot = mesh_weld(table, slots - 1, m, corner[k]);
            id[k] = (uint32_t)slot;
            if (table[slot] == UINT32_MAX) {
                table[slot] = (uint32_t)(3 * i + k);
            }
        }
        for (k = 0; k < 3; k++) {
            uint32_t a = id[k];
            uint32_t b = id[(k + 1) % 3];
            if (a != b) {
                edge[edges] = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
                edges += 1;
            }
        }
    }
    if (ok) {
        qsort(edge, edges, sizeof *edge, mesh_compare_u64);
    }
    for (i = 0; ok && i < edges;) {
        size_t first = i;
        while (i < edges && edge[i] == edge[first]) {
            i += 1;
        }
        *out_count += (i - first) % 2;
    }
    free(table);
    free(edge);
    return ok;
}

#endif /* EXAMPLES_MESH_STATS_H */
