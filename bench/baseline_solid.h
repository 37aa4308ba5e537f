/* baseline_solid.h - the solid voxelizers that tribox_grid_fill_solid is timed against, in plain float, written
 * here from [SS10]: each triangle is seen along x, and each row whose centre it covers is crossed once. One
 * flips all voxels behind the crossing at once; the other collects crossings per row, sorts each row's, and
 * fills from the odd ones to the even ones. Both err where floats do: rows leak close to edges.
 */
#ifndef BASELINE_SOLID_H
#define BASELINE_SOLID_H

#include "baseline_grid.h"

/* ---- [SS10]: setup and test ---------------------------------------------------------------------------- */

/* Edge functions in (y, z), each as a*y + b*z + d, positive within, and x = at + slope_y*y + slope_z*z. The
 * point is a row's centre in voxels. An edge that lies on a centre is within if it is a left or a bottom one. */
typedef struct baseline_crossing {
    float a[3];
    float b[3];
    float d[3];
    int owns[3];
    float at;
    float slope_y;
    float slope_z;
} baseline_crossing;

/* Returns 0 for a triangle seen from the side. */
BASELINE_FN int baseline_crossing_setup(baseline_crossing *t, const float v0[3], const float v1[3],
                                        const float v2[3])
{
    const float *v[3];
    float e0[3];
    float e1[3];
    float n[3];
    float sign;
    int i;
    v[0] = v0;
    v[1] = v1;
    v[2] = v2;
    for (i = 0; i < 3; i++) {
        e0[i] = v1[i] - v0[i];
        e1[i] = v2[i] - v0[i];
    }
    n[0] = e0[1] * e1[2] - e0[2] * e1[1];
    n[1] = e0[2] * e1[0] - e0[0] * e1[2];
    n[2] = e0[0] * e1[1] - e0[1] * e1[0];
    if (n[0] == 0) {
        return 0;
    }
    sign = n[0] > 0 ? 1.0f : -1.0f;
    for (i = 0; i < 3; i++) {
        const float *p = v[i];
        const float *q = v[(i + 1) % 3];
        t->a[i] = -sign * (q[2] - p[2]);
        t->b[i] = sign * (q[1] - p[1]);
        t->d[i] = -(t->a[i] * p[1] + t->b[i] * p[2]);
        t->owns[i] = t->a[i] > 0 || (t->a[i] == 0 && t->b[i] > 0);
    }
    t->slope_y = -n[1] / n[0];
    t->slope_z = -n[2] / n[0];
    t->at = v0[0] - t->slope_y * v0[1] - t->slope_z * v0[2];
    return 1;
}

BASELINE_FN int baseline_crossing_covers(const baseline_crossing *t, float y, float z)
{
    int i;
    for (i = 0; i < 3; i++) {
        float e = t->a[i] * y + t->b[i] * z + t->d[i];
        if (!(e > 0 || (e == 0 && t->owns[i]))) {
            return 0;
        }
    }
    return 1;
}

/* ---- A triangle in a region ---------------------------------------------------------------------------- */

/* The first integer that is not below x, for x > -1. */
BASELINE_FN int baseline_up(float x)
{
    int i = (int)x;
    return i + ((float)i < x);
}

/* Triangle i in voxels, and the rows whose centres its box covers; 0 if there is none. */
BASELINE_FN int baseline_place_rows(const baseline_region *r, const tribox_mesh *mesh, size_t i,
                                    baseline_placed *t)
{
    int corner;
    int k;
    for (corner = 0; corner < 3; corner++) {
        const float *p = baseline_corner(mesh, 3 * i + (size_t)corner);
        for (k = 0; k < 3; k++) {
            t->v[corner][k] = (p[k] - r->origin[k]) * r->per_voxel[k];
        }
    }
    for (k = 1; k < 3; k++) {
        float low = baseline_sat_min(baseline_sat_min(t->v[0][k], t->v[1][k]), t->v[2][k]);
        float high = baseline_sat_max(baseline_sat_max(t->v[0][k], t->v[1][k]), t->v[2][k]);
        if (!(high >= 0 && low <= r->top[k])) {
            return 0;
        }
        t->lo[k] = baseline_up(baseline_sat_max(low - 0.5f, 0));
        t->hi[k] = baseline_up(baseline_sat_min(high - 0.5f, r->top[k] - 0.5f)) - 1;
        t->hi[k] = t->hi[k] < r->size[k] ? t->hi[k] : r->size[k] - 1;
        if (t->lo[k] > t->hi[k]) {
            return 0;
        }
    }
    return 1;
}

/* ---- The loops ----------------------------------------------------------------------------------------- */

/* The first voxel behind the crossing. */
BASELINE_FN int baseline_crossing_voxel(const baseline_crossing *t, float y, float z, int n)
{
    float x = t->at + t->slope_y * y + t->slope_z * z - 0.5f;
    return x <= 0 ? 0 : x > (float)n ? n : baseline_up(x);
}

/* Returns how many crossings there are. */
BASELINE_FN size_t baseline_solid_flip(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits)
{
    baseline_region r;
    size_t crossings = 0;
    size_t i;
    baseline_region_init(&r, grid, bits);
    for (i = 0; i < mesh->triangles; i++) {
        baseline_placed t;
        baseline_crossing c;
        int y;
        int z;
        if (!baseline_place_rows(&r, mesh, i, &t) ||
            !baseline_crossing_setup(&c, t.v[0], t.v[1], t.v[2])) {
            continue;
        }
        for (z = t.lo[2]; z <= t.hi[2]; z++) {
            for (y = t.lo[1]; y <= t.hi[1]; y++) {
                float centre_y = (float)y + 0.5f;
                float centre_z = (float)z + 0.5f;
                uint64_t *row = baseline_row(&r, y, z);
                size_t word;
                int x;
                if (!baseline_crossing_covers(&c, centre_y, centre_z)) {
                    continue;
                }
                crossings++;
                x = baseline_crossing_voxel(&c, centre_y, centre_z, r.size[0]);
                if (x >= r.size[0]) {
                    continue;
                }
                word = (size_t)x >> 6;
                row[word] ^= ~UINT64_C(0) << (x & 63);
                for (word++; word < r.row_words; word++) {
                    row[word] ^= ~UINT64_C(0);
                }
                if ((r.size[0] & 63) != 0) { /* padding stays */
                    row[r.row_words - 1] ^= ~UINT64_C(0) << (r.size[0] & 63);
                }
            }
        }
    }
    return crossings;
}

/* A crossing, and the one of its row that came before. */
typedef struct baseline_node {
    int32_t x;
    int32_t next;
} baseline_node;

typedef struct baseline_lists {
    int32_t *head; /* a row's last crossing, or -1; one for each row of the region */
    baseline_node *node;
    size_t capacity;
} baseline_lists;

enum { BASELINE_ROW = 1024 }; /* crossings of a row, at most */

BASELINE_FN void baseline_fill_row(uint64_t *row, int from, int to)
{
    size_t word = (size_t)from >> 6;
    size_t last = (size_t)to >> 6;
    uint64_t head = ~UINT64_C(0) << (from & 63);
    uint64_t tail = (to & 63) != 0 ? ~UINT64_C(0) >> (64 - (to & 63)) : 0;
    if (word == last) {
        row[word] ^= head & tail;
        return;
    }
    row[word] ^= head;
    for (word++; word < last; word++) {
        row[word] ^= ~UINT64_C(0);
    }
    if (tail != 0) {
        row[last] ^= tail;
    }
}

BASELINE_FN size_t baseline_solid_sort(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits,
                                       const baseline_lists *lists)
{
    baseline_region r;
    size_t rows;
    size_t crossings = 0;
    size_t i;
    baseline_region_init(&r, grid, bits);
    rows = (size_t)r.size[1] * (size_t)r.size[2];
    memset(lists->head, 255, rows * sizeof *lists->head);
    for (i = 0; i < mesh->triangles; i++) {
        baseline_placed t;
        baseline_crossing c;
        int y;
        int z;
        if (!baseline_place_rows(&r, mesh, i, &t) ||
            !baseline_crossing_setup(&c, t.v[0], t.v[1], t.v[2])) {
            continue;
        }
        for (z = t.lo[2]; z <= t.hi[2]; z++) {
            for (y = t.lo[1]; y <= t.hi[1]; y++) {
                float centre_y = (float)y + 0.5f;
                float centre_z = (float)z + 0.5f;
                int32_t *head = &lists->head[z * r.size[1] + y];
                if (baseline_crossing_covers(&c, centre_y, centre_z) && crossings < lists->capacity) {
                    lists->node[crossings].x = baseline_crossing_voxel(&c, centre_y, centre_z, r.size[0]);
                    lists->node[crossings].next = *head;
                    *head = (int32_t)crossings++;
                }
            }
        }
    }
    for (i = 0; i < rows; i++) {
        int x[BASELINE_ROW];
        int n = 0;
        int j;
        int32_t at;
        for (at = lists->head[i]; at >= 0 && n < BASELINE_ROW; at = lists->node[at].next) {
            for (j = n++; j > 0 && x[j - 1] > lists->node[at].x; j--) {
                x[j] = x[j - 1];
            }
            x[j] = lists->node[at].x;
        }
        for (j = 0; j < n; j += 2) {
            baseline_fill_row(bits + i * r.row_words, x[j], j + 1 < n ? x[j + 1] : r.size[0]);
        }
    }
    return crossings;
}

#endif /* BASELINE_SOLID_H */
