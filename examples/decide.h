/* decide.h - which triangle decides whether a box is touched, and how far it is from touching
 *
 * Triangles are listed in coarse cells. For a box that is touched the one that reaches deepest decides; for
 * one that is not, the one that is nearest. The measure is tribox_gap's: above 0 the two are apart by at
 * least that, below 0 no shorter move parts them; 0 is exact touching. Where corners or faces are no floats,
 * the same is computed in double.
 */
#ifndef EXAMPLES_DECIDE_H
#define EXAMPLES_DECIDE_H
#include "convention.h"

typedef struct decider {
    tribox_mesh_f64 mesh;
    tribox_grid     cells;
    size_t         *start;      /* where each cell's list begins */
    uint32_t       *list;
} decider;

typedef struct decision {
    double gap;                 /* as tribox_gap; of a sample its distance; infinite without triangles */
    int    exact;               /* numbers were floats: within 2^-40 of itself, its sign exact */
    size_t triangle;
    double v[3][3];
} decision;

/* ---- 1. Lists ------------------------------------------------------------------------------------- */

static inline size_t decider_cell(const decider *d, int x, int y, int z) {
    return ((size_t)z * (size_t)d->cells.hi[1] + (size_t)y) * (size_t)d->cells.hi[0] + (size_t)x;
}

static inline void decider_count_span(void *user, size_t triangle, int x0, int x1, int y, int z) {
    decider *d = (decider *)user;
    (void)triangle;
    for (; x0 <= x1; x0++) {
        d->start[decider_cell(d, x0, y, z) + 1] += 1;
    }
}

static inline void decider_list_span(void *user, size_t triangle, int x0, int x1, int y, int z) {
    decider *d = (decider *)user;
    for (; x0 <= x1; x0++) {
        d->list[d->start[decider_cell(d, x0, y, z)]++] = (uint32_t)triangle;
    }
}

static inline void decider_free(decider *d) {
    mesh_doubles_free(&d->mesh);
    free(d->start);
    free(d->list);
}

/* Returns 1, or 0 if memory is out. */
static inline int decider_make(decider *d, const mesh *m) {
    size_t cells;
    size_t i;
    int n;
    memset(d, 0, sizeof *d);
    if (!mesh_doubles(m, 0, &d->mesh)) {
        return 0;
    }
    n = (int)(2 * sqrt((double)m->triangles / 6) + 2);
    if (!tribox_grid_fit_f64(&d->cells, &d->mesh, n < 128 ? n : 128)) {
        memset(&d->cells, 0, sizeof d->cells);      /* a point, or nothing finite: no lists */
        return 1;
    }
    cells = (size_t)d->cells.hi[0] * (size_t)d->cells.hi[1] * (size_t)d->cells.hi[2];
    d->start = (size_t *)calloc(cells + 2, sizeof *d->start);
    if (d->start) {
        tribox_mesh_spans_f64(&d->cells, &d->mesh, decider_count_span, d);
        for (i = 0; i < cells; i++) {
            d->start[i + 1] += d->start[i];
        }
        d->list = (uint32_t *)malloc((d->start[cells] + 1) * sizeof *d->list);
    }
    if (!d->list) {
        decider_free(d);
        return 0;
    }
    tribox_mesh_spans_f64(&d->cells, &d->mesh, decider_list_span, d);
    for (i = cells; i > 0; i--) {       /* each list's beginning has moved to the next one's */
        d->start[i] = d->start[i - 1];
    }
    d->start[0] = 0;
    return 1;
}

/* ---- 2. One triangle ------------------------------------------------------------------------------ */

static inline int decide_floats(const double *x, size_t count, float *out) {
    size_t i;
    for (i = 0; i < count; i++) {
        out[i] = (float)x[i];
        if ((double)out[i] < x[i] || (double)out[i] > x[i]) {
            return 0;
        }
    }
    return 1;
}

/* tribox_gap in double, rounded: the largest, over 13 axes and their opposites, of the box's least less the
   triangle's most. */
static inline double decide_gap_rounded(const double v[3][3], const double lo[3], const double hi[3]) {
    double edge[3][3];
    double best = -HUGE_VAL;
    int axis;
    int i;
    int a;
    for (i = 0; i < 3; i++) {
        for (a = 0; a < 3; a++) {
            edge[i][a] = v[(i + 1) % 3][a] - v[i][a];
        }
    }
    for (axis = 0; axis < 13; axis++) {
        double u[3] = {0, 0, 0};
        double length;
        double middle = 0;
        double reach = 0;
        double least = HUGE_VAL;
        double most = -HUGE_VAL;
        if (axis < 3) {
            u[axis] = 1;
        } else if (axis == 3) {
            for (a = 0; a < 3; a++) {
                int b = (a + 1) % 3;
                int c = (a + 2) % 3;
                u[a] = edge[0][b] * edge[1][c] - edge[0][c] * edge[1][b];
            }
        } else {        /* an edge crossed with a coordinate axis */
            a = (axis - 4) % 3;
            u[(a + 1) % 3] = edge[(axis - 4) / 3][(a + 2) % 3];
            u[(a + 2) % 3] = -edge[(axis - 4) / 3][(a + 1) % 3];
        }
        length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        if (!(length > 0)) {
            continue;
        }
        for (a = 0; a < 3; a++) {
            u[a] /= length;
            middle += 0.5 * u[a] * ((lo[a] - v[0][a]) + (hi[a] - v[0][a]));
            reach += 0.5 * fabs(u[a]) * (hi[a] - lo[a]);
        }
        for (i = 0; i < 3; i++) {
            double at = u[0] * (v[i][0] - v[0][0]) + u[1] * (v[i][1] - v[0][1]) + u[2] * (v[i][2] - v[0][2]);
            least = fmin(least, at);
            most = fmax(most, at);
        }
        best = fmax(best, fmax(middle - reach - most, least - middle - reach));
    }
    return best;
}

/* The sign is that of the exact answer. */
static inline double decide_gap(const double v[3][3], const double lo[3], const double hi[3], int *exact) {
    float f[3][3];
    float box[2][3];
    double gap;
    *exact = decide_floats(v[0], 9, f[0]) && decide_floats(lo, 3, box[0]) && decide_floats(hi, 3, box[1]);
    if (*exact) {
        return tribox_gap(f[0], f[1], f[2], box[0], box[1], NULL);
    }
    gap = decide_gap_rounded(v, lo, hi);
    return tribox_overlap_f64(v[0], v[1], v[2], lo, hi) ? fmin(gap, 0) : fmax(gap, 0);
}

static inline double decide_distance(const double v[3][3], const double q[3]) {
    double weight[3];
    double sum = 0;
    int a;
    if (tribox_overlap_f64(v[0], v[1], v[2], q, q)) {
        return 0;
    }
    tribox_closest_f64(v[0], v[1], v[2], q, weight);
    for (a = 0; a < 3; a++) {
        double away =
            weight[0] * (v[0][a] - q[a]) + weight[1] * (v[1][a] - q[a]) + weight[2] * (v[2][a] - q[a]);
        sum += away * away;
    }
    return sqrt(sum);
}

/* ---- 3. All triangles ----------------------------------------------------------------------------- */

/* Is the triangle farther than `limit` along an axis? Then nothing of it counts. */
static inline int decide_is_far(const double v[3][3], const double lo[3], const double hi[3], double limit) {
    int a;
    for (a = 0; a < 3; a++) {
        double least = fmin(v[0][a], fmin(v[1][a], v[2][a]));
        double most = fmax(v[0][a], fmax(v[1][a], v[2][a]));
        if (fmax(least - hi[a], lo[a] - most) > limit) {
            return 1;
        }
    }
    return 0;
}

/* Takes the triangles of the cells within `reach` of the box. Returns 1 if that were all cells. */
static inline int decide_within(const decider *d, const double lo[3], const double hi[3], double reach,
                                int sample, decision *best) {
    const tribox_grid *g = &d->cells;
    int first[3];
    int last[3];
    int all = 1;
    int x;
    int y;
    int z;
    int a;
    size_t i;
    for (a = 0; a < 3; a++) {
        double from = floor((lo[a] - reach - g->origin[a]) / g->size[a]) - 1;     /* a cell more: this is rounded */
        double to = floor((hi[a] + reach - g->origin[a]) / g->size[a]) + 1;
        first[a] = from > 0 ? (from < g->hi[a] ? (int)from : g->hi[a]) : 0;
        last[a] = to < g->hi[a] - 1 ? (to >= 0 ? (int)to : -1) : g->hi[a] - 1;
        all = all && first[a] == 0 && last[a] == g->hi[a] - 1;
    }
    for (z = first[2]; z <= last[2]; z++) {
        for (y = first[1]; y <= last[1]; y++) {
            for (x = first[0]; x <= last[0]; x++) {
                size_t cell = decider_cell(d, x, y, z);
                for (i = d->start[cell]; i < d->start[cell + 1]; i++) {
                    decision now;
                    int k;
                    now.triangle = d->list[i];
                    now.exact = 1;
                    for (k = 0; k < 3; k++) {
                        size_t vertex = d->mesh.indices ? d->mesh.indices[3 * now.triangle + (size_t)k]
                                                        : 3 * now.triangle + (size_t)k;
                        memcpy(now.v[k], d->mesh.positions + 3 * vertex, sizeof now.v[k]);
                    }
                    if (best->gap > 0 && decide_is_far((const double(*)[3])now.v, lo, hi, best->gap)) {
                        continue;
                    }
                    now.gap = sample ? decide_distance((const double(*)[3])now.v, lo)
                                     : decide_gap((const double(*)[3])now.v, lo, hi, &now.exact);
                    if (now.gap < best->gap || (!(now.gap > best->gap) && now.triangle < best->triangle)) {
                        *best = now;
                    }
                }
            }
        }
    }
    return all;
}

/* The triangle that decides about a box, or with `sample` about the point lo. `near_only` looks no farther
   than a cell away: it may find none (SIZE_MAX, infinitely far), or one that is not the nearest, but never
   misses one that touches. */
static inline decision decide(const decider *d, const double lo[3], const double hi[3], int sample,
                              int near_only) {
    decision best;
    double reach = 0;
    memset(&best, 0, sizeof best);
    best.gap = HUGE_VAL;
    best.triangle = SIZE_MAX;
    if (!d->start) {
        return best;
    }
    while (!decide_within(d, lo, hi, reach, sample, &best) && best.gap > reach && !near_only) {
        reach = reach > 0 ? 2 * reach : d->cells.size[0];
    }
    return best;
}

#endif /* EXAMPLES_DECIDE_H */
