/* baseline_grid.h - the voxelizers that tribox_grid_fill is timed against: the [SS10] loop and an [AM01] loop
 * that skips voxels already set. They write the same bit array.
 *
 * Both scale a triangle to voxels of size one with the region's corner at the origin, in float, and visit the
 * voxels of its index box.
 */
#ifndef BASELINE_GRID_H
#define BASELINE_GRID_H

#include "baseline.h"
#include "tribox.h"

/* ---- [SS10]: setup and test ---------------------------------------------------------------------------- */

/* The edge conditions are those of edges 0..2 in the planes xy, yz and zx: a*p + b*q + d >= 0 with (p,q) the
 * voxel's corner in that plane. The plane condition is (n.p + d1)(n.p + d2) <= 0. */
typedef struct baseline_ss10 {
    float low[3], high[3], dp[3];
    float n[3], d1, d2;
    float a[9], b[9], d[9];
} baseline_ss10;

enum { BASELINE_XY = 0, BASELINE_YZ = 3, BASELINE_ZX = 6 };

BASELINE_FN void baseline_ss10_edges(baseline_ss10 *t, int plane, int u, int v, float normal,
                                     const float *const corner[3])
{
    int i;
    for (i = 0; i < 3; i++) {
        const float *from = corner[i];
        const float *to = corner[i == 2 ? 0 : i + 1];
        float side = normal < 0 ? -1.0f : 1.0f;
        float a = side * (from[v] - to[v]);
        float b = side * (to[u] - from[u]);
        t->a[plane + i] = a;
        t->b[plane + i] = b;
        t->d[plane + i] = t->dp[u] * baseline_sat_max(a, 0) + t->dp[v] * baseline_sat_max(b, 0) -
                          (a * from[u] + b * from[v]);
    }
}

BASELINE_FN void baseline_ss10_setup(baseline_ss10 *t, const float v0[3], const float v1[3],
                                     const float v2[3], const float dp[3])
{
    const float *corner[3];
    float e0[3];
    float e1[3];
    float reach = 0;
    float least = 0;
    float at_v0;
    int k;
    corner[0] = v0;
    corner[1] = v1;
    corner[2] = v2;
    for (k = 0; k < 3; k++) {
        t->dp[k] = dp[k];
        t->low[k] = baseline_sat_min(baseline_sat_min(v0[k], v1[k]), v2[k]);
        t->high[k] = baseline_sat_max(baseline_sat_max(v0[k], v1[k]), v2[k]);
        e0[k] = v1[k] - v0[k];
        e1[k] = v2[k] - v1[k];
    }
    t->n[0] = e0[1] * e1[2] - e0[2] * e1[1];
    t->n[1] = e0[2] * e1[0] - e0[0] * e1[2];
    t->n[2] = e0[0] * e1[1] - e0[1] * e1[0];
    for (k = 0; k < 3; k++) {
        reach += baseline_sat_max(t->n[k] * dp[k], 0);
        least += baseline_sat_min(t->n[k] * dp[k], 0);
    }
    at_v0 = t->n[0] * v0[0] + t->n[1] * v0[1] + t->n[2] * v0[2];
    t->d1 = reach - at_v0;
    t->d2 = least - at_v0;
    baseline_ss10_edges(t, BASELINE_XY, 0, 1, t->n[2], corner);
    baseline_ss10_edges(t, BASELINE_YZ, 1, 2, t->n[0], corner);
    baseline_ss10_edges(t, BASELINE_ZX, 2, 0, t->n[1], corner);
}

/* The test as in the paper, for any p: bounding box, plane, three edges in each of three planes. */
BASELINE_FN int baseline_ss10_test(const baseline_ss10 *t, const float p[3])
{
    float np = t->n[0] * p[0] + t->n[1] * p[1] + t->n[2] * p[2];
    int i;
    if (p[0] > t->high[0] || p[1] > t->high[1] || p[2] > t->high[2] || p[0] + t->dp[0] < t->low[0] ||
        p[1] + t->dp[1] < t->low[1] || p[2] + t->dp[2] < t->low[2]) {
        return 0;
    }
    if ((np + t->d1) * (np + t->d2) > 0) {
        return 0;
    }
    for (i = 0; i < 3; i++) {
        if (t->a[BASELINE_XY + i] * p[0] + t->b[BASELINE_XY + i] * p[1] + t->d[BASELINE_XY + i] < 0) {
            return 0;
        }
    }
    for (i = 0; i < 3; i++) {
        if (t->a[BASELINE_YZ + i] * p[1] + t->b[BASELINE_YZ + i] * p[2] + t->d[BASELINE_YZ + i] < 0) {
            return 0;
        }
    }
    for (i = 0; i < 3; i++) {
        if (t->a[BASELINE_ZX + i] * p[2] + t->b[BASELINE_ZX + i] * p[0] + t->d[BASELINE_ZX + i] < 0) {
            return 0;
        }
    }
    return 1;
}

/* The least of three edge functions at (p,q). */
BASELINE_FN float baseline_ss10_least(const baseline_ss10 *t, int plane, float p, float q)
{
    float f0 = t->a[plane] * p + t->b[plane] * q + t->d[plane];
    float f1 = t->a[plane + 1] * p + t->b[plane + 1] * q + t->d[plane + 1];
    float f2 = t->a[plane + 2] * p + t->b[plane + 2] * q + t->d[plane + 2];
    return baseline_sat_min(baseline_sat_min(f0, f1), f2);
}

/* The same test without a branch. */
BASELINE_FN int baseline_ss10_test_branchless(const baseline_ss10 *t, const float p[3])
{
    float np = t->n[0] * p[0] + t->n[1] * p[1] + t->n[2] * p[2];
    float least = baseline_sat_min(np + t->d1, -(np + t->d2));
    int k;
    least = baseline_sat_min(least, baseline_ss10_least(t, BASELINE_XY, p[0], p[1]));
    least = baseline_sat_min(least, baseline_ss10_least(t, BASELINE_YZ, p[1], p[2]));
    least = baseline_sat_min(least, baseline_ss10_least(t, BASELINE_ZX, p[2], p[0]));
    for (k = 0; k < 3; k++) {
        least = baseline_sat_min(least, baseline_sat_min(t->high[k] - p[k], p[k] + t->dp[k] - t->low[k]));
    }
    return least >= 0;
}

/* ---- A triangle in a region ---------------------------------------------------------------------------- */

typedef struct baseline_region {
    float origin[3], per_voxel[3]; /* to voxel units: (v - origin) * per_voxel */
    float top[3];                  /* the region's size in voxels */
    int size[3];
    size_t row_words;
    uint64_t *bits;
} baseline_region;

typedef struct baseline_placed {
    float v[3][3];
    int lo[3], hi[3]; /* the index box, both ends included */
} baseline_placed;

static inline void baseline_region_init(baseline_region *r, const tribox_grid *grid, uint64_t *bits)
{
    int k;
    for (k = 0; k < 3; k++) {
        r->origin[k] = (float)(grid->origin[k] + grid->lo[k] * grid->size[k]);
        r->per_voxel[k] = (float)(1.0 / grid->size[k]);
        r->size[k] = grid->hi[k] - grid->lo[k];
        r->top[k] = (float)r->size[k];
    }
    r->row_words = ((size_t)r->size[0] + 63) / 64;
    r->bits = bits;
}

BASELINE_FN const float *baseline_corner(const tribox_mesh *mesh, size_t i)
{
    return mesh->positions + 3 * (size_t)mesh->indices[i];
}

/* Triangle i in voxel units with its index box; 0 if that lies outside the region. */
BASELINE_FN int baseline_place(const baseline_region *r, const tribox_mesh *mesh, size_t i,
                               baseline_placed *t)
{
    const float *corner[3];
    int c;
    int k;
    for (c = 0; c < 3; c++) {
        corner[c] = baseline_corner(mesh, 3 * i + (size_t)c);
    }
    for (k = 0; k < 3; k++) {
        float low;
        float high;
        for (c = 0; c < 3; c++) {
            t->v[c][k] = (corner[c][k] - r->origin[k]) * r->per_voxel[k];
        }
        low = baseline_sat_min(baseline_sat_min(t->v[0][k], t->v[1][k]), t->v[2][k]);
        high = baseline_sat_max(baseline_sat_max(t->v[0][k], t->v[1][k]), t->v[2][k]);
        if (!(high >= 0 && low <= r->top[k])) {
            return 0;
        }
        t->lo[k] = (int)baseline_sat_max(low, 0);
        t->hi[k] = (int)baseline_sat_min(high, r->top[k]);
        t->lo[k] = t->lo[k] < r->size[k] ? t->lo[k] : r->size[k] - 1;
        t->hi[k] = t->hi[k] < r->size[k] ? t->hi[k] : r->size[k] - 1;
    }
    return 1;
}

BASELINE_FN uint64_t *baseline_row(const baseline_region *r, int y, int z)
{
    return r->bits + ((size_t)z * (size_t)r->size[1] + (size_t)y) * r->row_words;
}

/* ---- The loops ----------------------------------------------------------------------------------------- */

static const float baseline_unit[3] = {1.0f, 1.0f, 1.0f};

/* What does not depend on x in one row: plane, edges in xy, edges in zx. */
typedef struct baseline_ss10_terms {
    float high, low, xy[3], zx[3];
} baseline_ss10_terms;

BASELINE_FN void baseline_ss10_hoist(baseline_ss10_terms *h, const baseline_ss10 *t, float y, float z)
{
    float plane = t->n[1] * y + t->n[2] * z;
    int i;
    h->high = plane + t->d1;
    h->low = plane + t->d2;
    for (i = 0; i < 3; i++) {
        h->xy[i] = t->b[BASELINE_XY + i] * y + t->d[BASELINE_XY + i];
        h->zx[i] = t->a[BASELINE_ZX + i] * z + t->d[BASELINE_ZX + i];
    }
}

/* Voxels x..last of a row, whole words at a time, without a branch on an answer. */
BASELINE_FN void baseline_ss10_row(const baseline_ss10 *t, uint64_t *row, int x, int last, float y, float z)
{
    const float *xy = t->a + BASELINE_XY;
    const float *zx = t->b + BASELINE_ZX;
    baseline_ss10_terms h;
    baseline_ss10_hoist(&h, t, y, z);
    while (x <= last) {
        int word = x >> 6;
        int end = (word << 6) + 63;
        uint64_t hits = 0;
        for (end = end < last ? end : last; x <= end; x++) {
            float fx = (float)x;
            float np = t->n[0] * fx;
            float a = baseline_sat_min(xy[0] * fx + h.xy[0], xy[1] * fx + h.xy[1]);
            float b = baseline_sat_min(zx[0] * fx + h.zx[0], zx[1] * fx + h.zx[1]);
            float c = baseline_sat_min(xy[2] * fx + h.xy[2], zx[2] * fx + h.zx[2]);
            float d = baseline_sat_min(np + h.high, -(np + h.low));
            int hit = baseline_sat_min(baseline_sat_min(a, b), baseline_sat_min(c, d)) >= 0;
            hits |= (uint64_t)(unsigned)hit << (x & 63);
        }
        row[word] |= hits;
    }
}

/* The same with early exits, a voxel at a time. */
BASELINE_FN void baseline_ss10_row_early(const baseline_ss10 *t, uint64_t *row, int x, int last, float y,
                                         float z)
{
    const float *xy = t->a + BASELINE_XY;
    const float *zx = t->b + BASELINE_ZX;
    baseline_ss10_terms h;
    baseline_ss10_hoist(&h, t, y, z);
    for (; x <= last; x++) {
        float fx = (float)x;
        float np = t->n[0] * fx;
        if ((np + h.high) * (np + h.low) > 0 || xy[0] * fx + h.xy[0] < 0 || xy[1] * fx + h.xy[1] < 0 ||
            xy[2] * fx + h.xy[2] < 0 || zx[0] * fx + h.zx[0] < 0 || zx[1] * fx + h.zx[1] < 0 ||
            zx[2] * fx + h.zx[2] < 0) {
            continue;
        }
        row[x >> 6] |= UINT64_C(1) << (x & 63);
    }
}

BASELINE_FN void baseline_fill_ss10(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits,
                                    int early)
{
    baseline_region r;
    size_t i;
    baseline_region_init(&r, grid, bits);
    for (i = 0; i < mesh->triangles; i++) {
        baseline_placed t;
        baseline_ss10 s;
        int y;
        int z;
        if (!baseline_place(&r, mesh, i, &t)) {
            continue;
        }
        baseline_ss10_setup(&s, t.v[0], t.v[1], t.v[2], baseline_unit);
        for (z = t.lo[2]; z <= t.hi[2]; z++) {
            for (y = t.lo[1]; y <= t.hi[1]; y++) {
                if (baseline_ss10_least(&s, BASELINE_YZ, (float)y, (float)z) < 0) {
                    continue;
                }
                if (early) {
                    baseline_ss10_row_early(&s, baseline_row(&r, y, z), t.lo[0], t.hi[0], (float)y, (float)z);
                } else {
                    baseline_ss10_row(&s, baseline_row(&r, y, z), t.lo[0], t.hi[0], (float)y, (float)z);
                }
            }
        }
    }
}

/* [SS10] that tests only voxels not yet set, and sets up a triangle at the first of them. */
BASELINE_FN void baseline_fill_ss10_skip(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits)
{
    baseline_region r;
    size_t i;
    baseline_region_init(&r, grid, bits);
    for (i = 0; i < mesh->triangles; i++) {
        baseline_placed t;
        baseline_ss10 s;
        int ready = 0;
        int x;
        int y;
        int z;
        if (!baseline_place(&r, mesh, i, &t)) {
            continue;
        }
        for (z = t.lo[2]; z <= t.hi[2]; z++) {
            for (y = t.lo[1]; y <= t.hi[1]; y++) {
                uint64_t *row = baseline_row(&r, y, z);
                for (x = t.lo[0]; x <= t.hi[0] && (row[x >> 6] >> (x & 63) & 1) != 0; x++) {
                }
                if (x > t.hi[0]) {
                    continue;
                }
                if (!ready) {
                    baseline_ss10_setup(&s, t.v[0], t.v[1], t.v[2], baseline_unit);
                    ready = 1;
                }
                if (baseline_ss10_least(&s, BASELINE_YZ, (float)y, (float)z) >= 0) {
                    baseline_ss10_row(&s, row, x, t.hi[0], (float)y, (float)z);
                }
            }
        }
    }
}

/* [AM01] at every voxel of the index box that is not yet set. The faces cannot part them there. */
BASELINE_FN void baseline_fill_am(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits, int early)
{
    baseline_region r;
    size_t i;
    baseline_region_init(&r, grid, bits);
    for (i = 0; i < mesh->triangles; i++) {
        baseline_placed t;
        int x;
        int y;
        int z;
        if (!baseline_place(&r, mesh, i, &t)) {
            continue;
        }
        for (z = t.lo[2]; z <= t.hi[2]; z++) {
            for (y = t.lo[1]; y <= t.hi[1]; y++) {
                uint64_t *row = baseline_row(&r, y, z);
                for (x = t.lo[0]; x <= t.hi[0]; x++) {
                    float low[3];
                    float high[3];
                    baseline_sat_frame f;
                    if ((row[x >> 6] >> (x & 63) & 1) != 0) {
                        continue;
                    }
                    low[0] = (float)x;
                    low[1] = (float)y;
                    low[2] = (float)z;
                    high[0] = low[0] + 1.0f;
                    high[1] = low[1] + 1.0f;
                    high[2] = low[2] + 1.0f;
                    baseline_sat_centre(&f, t.v[0], t.v[1], t.v[2], low, high);
                    if (early ? baseline_sat_centred_early(&f) : !(baseline_sat_crossed_gap(&f) > 0)) {
                        row[x >> 6] |= UINT64_C(1) << (x & 63);
                    }
                }
            }
        }
    }
}

#endif /* BASELINE_GRID_H */
