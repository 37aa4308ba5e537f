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
static inline int mesh_is_finite(const float *position) {
    uint32_t bits[3];
    memcpy(bits, position, sizeof bits);
    return (bits[0] & 0x7f800000u) != 0x7f800000u && (bits[1] & 0x7f800000u) != 0x7f800000u
        && (bits[2] & 0x7f800000u) != 0x7f800000u;
}

static inline int mesh_is_degenerate(const float *const corner[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        double pa = (double)corner[1][a] - (double)corner[0][a];
        double pb = (double)corner[1][b] - (double)corner[0][b];
        double qa = (double)corner[2][a] - (double)corner[0][a];
        double qb = (double)corner[2][b] - (double)corner[0][b];
        if (pa * qb != pb * qa) {
            return 0;
        }
    }
    return 1;
}

static inline mesh_stats mesh_measure(const tribox_mesh *m) {
    mesh_stats s = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, 0, 0};
    size_t t;
    int i;
    int a;
    for (t = 0; t < m->triangles; t++) {
        const float *corner[3];
        mesh_corners(m, t, corner);
        if (!mesh_is_finite(corner[0]) || !mesh_is_finite(corner[1]) || !mesh_is_finite(corner[2])) {
            s.nonfinite += 1;
            continue;
        }
        s.degenerate += mesh_is_degenerate(corner) ? 1 : 0;
        for (i = 0; i < 3; i++) {
            for (a = 0; a < 3; a++) {
                s.min[a] = (double)corner[i][a] < s.min[a] ? (double)corner[i][a] : s.min[a];
                s.max[a] = (double)corner[i][a] > s.max[a] ? (double)corner[i][a] : s.max[a];
            }
        }
    }
    return s;
}

/* A number for each place in space: the first vertex found there, by a hash table of vertices. -0 counts
   as 0. */
static inline uint32_t mesh_weld(uint32_t *table, size_t mask, const float *const *slots,
                                 const float *position) {
    float p[3];
    uint32_t bits[3];
    uint64_t hash;
    size_t at;
    int a;
    for (a = 0; a < 3; a++) {
        p[a] = position[a] + 0.0f;
    }
    memcpy(bits, p, sizeof bits);
    hash = (bits[0] * 0x9e3779b97f4a7c15u ^ bits[1]) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ hash >> 29 ^ bits[2]) * 0x94d049bb133111ebu;
    for (at = (size_t)(hash >> 20) & mask; table[at] != UINT32_MAX; at = (at + 1) & mask) {
        const float *q = slots[table[at]];
        if (q[0] == p[0] && q[1] == p[1] && q[2] == p[2]) {
            break;
        }
    }
    return (uint32_t)at;
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
static inline int mesh_open_edges(const tribox_mesh *m, size_t *out_count) {
    size_t corners = 3 * m->triangles;
    size_t slots = 64;
    const float **vertex = NULL;
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
    vertex = (const float **)malloc(corners * sizeof *vertex + 1);
    table = (uint32_t *)malloc(slots * sizeof *table);
    edge = (uint64_t *)malloc(corners * sizeof *edge + 1);
    ok = vertex && table && edge;
    if (ok) {
        memset(table, 0xff, slots * sizeof *table);
    }
    *out_count = 0;
    for (i = 0; ok && i < m->triangles; i++) {
        const float *corner[3];
        uint32_t id[3];
        size_t k;
        mesh_corners(m, i, corner);
        if (!mesh_is_finite(corner[0]) || !mesh_is_finite(corner[1]) || !mesh_is_finite(corner[2])) {
            continue;
        }
        for (k = 0; k < 3; k++) {
            id[k] = mesh_weld(table, slots - 1, vertex, corner[k]);
            if (table[id[k]] == UINT32_MAX) {
                vertex[3 * i + k] = corner[k];
                table[id[k]] = (uint32_t)(3 * i + k);
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
    free(vertex);
    free(table);
    free(edge);
    return ok;
}

#endif /* EXAMPLES_MESH_STATS_H */
