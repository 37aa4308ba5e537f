/* difference.h - the voxels in which two sets differ, and of what kind each difference is
 *
 *   touching    exactly on the border: which side of a face counts
 *   planes      the same, and the deciding triangle lies in a plane of the grid: one side of grid planes
 *   rounding    within 1e-6 voxels of touching
 *   shifted     gone where the grid is moved by half voxels
 *   lost        missing, and so are all voxels that only this triangle sets
 *   streak      of a run along an axis that is long and thin
 *   other
 *   unseen      more than the first 32768, which are not looked at
 */
#ifndef EXAMPLES_DIFFERENCE_H
#define EXAMPLES_DIFFERENCE_H
#include "decide.h"

enum {
    KIND_TOUCHING,
    KIND_PLANES,
    KIND_ROUNDING,
    KIND_SHIFTED,
    KIND_LOST,
    KIND_STREAK,
    KIND_OTHER,
    KIND_UNSEEN,
    KINDS
};

static const char *const kind_names[KINDS] = {"touching", "planes", "rounding", "shifted",
                                              "lost",     "streak", "other",    "unseen"};

typedef struct difference {
    size_t   at[3];
    int      missing;
    int      kind;
    double   voxels;            /* from touching, in voxels (of their shortest side): below 0 is inside */
    decision by;
} difference;

typedef struct differences {
    const mesh       *m;
    const convention *c;
    const voxels     *exact;
    const voxels     *given;
    size_t            missing;
    size_t            extra;
    size_t            kind[2][KINDS];   /* extra, missing */
    difference       *list;             /* the first of them */
    size_t            count;
    size_t            shown;            /* of these the deciding triangle is found however far it is */
    int               shift[3];         /* in half voxels: the grid fits better when moved by that; 0,0,0 */
    voxels            shifted;          /* the exact set there; bits NULL: none */
    size_t            lost;             /* triangles, and the first of them */
    size_t            first_lost;
    unsigned char    *is_lost;
} differences;

enum { DIFFERENCES_LISTED = 1 << 15 };

static inline size_t voxels_differ(const voxels *a, const voxels *b) {
    size_t count = 0;
    size_t i;
    for (i = 0; i < a->words; i++) {
        count += (size_t)voxels_ones(a->bits[i] ^ b->bits[i]);
    }
    return count;
}

/* ---- 1. Shifts of the whole ------------------------------------------------------------------------ */

/* Looks at the 26 moves of the grid by half voxels. Kept is the best if it leaves a tenth of the
   differences. */
static inline int differences_find_shift(differences *d, const tribox_grid *file, char *error) {
    size_t best = (d->missing + d->extra) / 10;
    int move;
    int a;
    for (move = 0; move < 27 && d->missing + d->extra >= 8; move++) {
        int step[3];
        tribox_grid grid = *file;
        voxels now;
        step[0] = move % 3 - 1;
        step[1] = move / 3 % 3 - 1;
        step[2] = move / 9 - 1;
        for (a = 0; a < 3; a++) {
            grid.origin[a] += 0.5 * step[a] * grid.size[a];
        }
        if (move == 13) {
            continue;
        }
        if (!convention_set(d->m, &grid, d->c, &now, error)) {
            return 0;
        }
        if (voxels_differ(&now, d->given) <= best) {
            voxels old = d->shifted;
            best = voxels_differ(&now, d->given);
            memcpy(d->shift, step, sizeof step);
            d->shifted = now;
            now = old;
        }
        voxels_free(&now);
    }
    return 1;
}

/* ---- 2. Lost triangles ------------------------------------------------------------------------------ */

/* How many triangles touch each voxel, up to 2; then, of each triangle, how many voxels are its alone, and in
   the file. */
typedef struct lost_walk {
    const differences *d;
    unsigned char     *touched;
    uint32_t          *own;
    uint32_t          *kept;
} lost_walk;

static inline size_t lost_at(const lost_walk *w, int x, int y, int z) {
    const voxels *v = w->d->exact;
    return ((size_t)(z - v->grid.lo[2]) * v->n[1] + (size_t)(y - v->grid.lo[1])) * v->n[0]
           + (size_t)(x - v->grid.lo[0]);
}

static inline void lost_count_span(void *user, size_t triangle, int x0, int x1, int y, int z) {
    lost_walk *w = (lost_walk *)user;
    unsigned char *at = w->touched + lost_at(w, x0, y, z);
    (void)triangle;
    for (; x0 <= x1; x0++, at++) {
        *at = (unsigned char)(*at < 2 ? *at + 1 : 2);
    }
}

static inline void lost_own_span(void *user, size_t triangle, int x0, int x1, int y, int z) {
    lost_walk *w = (lost_walk *)user;
    const tribox_grid *g = &w->d->exact->grid;
    for (; x0 <= x1; x0++) {
        if (w->touched[lost_at(w, x0, y, z)] == 1) {
            w->own[triangle] += 1;
            w->kept[triangle] += (uint32_t)voxels_get(w->d->given, (size_t)(x0 - g->lo[0]),
                                                      (size_t)(y - g->lo[1]), (size_t)(z - g->lo[2]));
        }
    }
}

/* A triangle is lost if it alone sets two voxels or more, and none of them is there. */
static inline int differences_find_lost(differences *d, const tribox_mesh_f64 *view, char *error) {
    size_t cells = d->exact->n[0] * d->exact->n[1] * d->exact->n[2];
    lost_walk w;
    size_t t;
    int ok;
    d->first_lost = SIZE_MAX;
    if (d->missing == 0 || d->c->kind != CONVENTION_TOUCHED) {
        return 1;
    }
    w.d = d;
    w.touched = (unsigned char *)calloc(cells + 1, 1);
    w.own = (uint32_t *)calloc(view->triangles + 1, sizeof *w.own);
    w.kept = (uint32_t *)calloc(view->triangles + 1, sizeof *w.kept);
    d->is_lost = (unsigned char *)calloc(view->triangles + 1, 1);
    ok = w.touched && w.own && w.kept && d->is_lost;
    if (ok) {
        tribox_mesh_spans_f64(&d->exact->grid, view, lost_count_span, &w);
        tribox_mesh_spans_f64(&d->exact->grid, view, lost_own_span, &w);
        for (t = view->triangles; t-- > 0;) {
            d->is_lost[t] = w.own[t] >= 2 && w.kept[t] == 0;
            d->lost += d->is_lost[t];
            d->first_lost = d->is_lost[t] ? t : d->first_lost;
        }
    } else {
        snprintf(error, MESH_ERROR, "out of memory");
    }
    free(w.touched);
    free(w.own);
    free(w.kept);
    return ok;
}

/* ---- 3. Kinds --------------------------------------------------------------------------------------- */

static inline int differences_at(const differences *d, size_t x, size_t y, size_t z, int missing) {
    return voxels_get(d->exact, x, y, z) != voxels_get(d->given, x, y, z)
           && voxels_get(d->exact, x, y, z) == missing;
}

/* How many differences of this sign follow each other along an axis, through this one. */
static inline size_t differences_run(const differences *d, const difference *one, int axis) {
    size_t at[3];
    size_t run = 1;
    int side;
    for (side = -1; side <= 1; side += 2) {
        memcpy(at, one->at, sizeof at);
        for (at[axis] += (size_t)side; differences_at(d, at[0], at[1], at[2], one->missing);
             at[axis] += (size_t)side) {
            run += 1;
        }
    }
    return run;
}

static inline int difference_is_streak(const differences *d, const difference *one) {
    size_t run[3];
    int a;
    for (a = 0; a < 3; a++) {
        run[a] = differences_run(d, one, a);
    }
    for (a = 0; a < 3; a++) {
        if (run[a] >= 8 && run[a] >= 4 * run[(a + 1) % 3] && run[a] >= 4 * run[(a + 2) % 3]) {
            return 1;
        }
    }
    return 0;
}

/* Does the triangle lie in a plane across an axis? */
static inline int decision_is_flat(const decision *by) {
    int a;
    for (a = 0; a < 3; a++) {
        if (!(by->v[0][a] < by->v[1][a] || by->v[0][a] > by->v[1][a] || by->v[0][a] < by->v[2][a]
              || by->v[0][a] > by->v[2][a])) {
            return 1;
        }
    }
    return 0;
}

static inline int difference_kind(const differences *d, const difference *one) {
    if (!(fabs(one->voxels) > 0)) {
        return decision_is_flat(&one->by) ? KIND_PLANES : KIND_TOUCHING;
    }
    if (fabs(one->voxels) <= 1e-6) {
        return KIND_ROUNDING;
    }
    if (d->shifted.bits && voxels_get(&d->shifted, one->at[0], one->at[1], one->at[2])
                               == voxels_get(d->given, one->at[0], one->at[1], one->at[2])) {
        return KIND_SHIFTED;
    }
    if (one->missing && d->is_lost && one->by.triangle != SIZE_MAX && d->is_lost[one->by.triangle]) {
        return KIND_LOST;
    }
    return difference_is_streak(d, one) ? KIND_STREAK : KIND_OTHER;
}

/* The corners of a voxel, rounded; of samples both are the sample. */
static inline void difference_box(const voxels *v, int sample, const size_t at[3], double lo[3],
                                  double hi[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        double i = (double)v->grid.lo[a] + (double)at[a];
        lo[a] = v->grid.origin[a] + (i + (sample ? 0.5 : 0)) * v->grid.size[a];
        hi[a] = v->grid.origin[a] + (i + (sample ? 0.5 : 1)) * v->grid.size[a];
    }
}

static inline void differences_take(differences *d, const decider *triangles, const size_t at[3],
                                    int missing) {
    int sample = d->c->kind == CONVENTION_SAMPLES;
    const double *size = d->exact->grid.size;
    difference one;
    double lo[3];
    double hi[3];
    memset(&one, 0, sizeof one);
    memcpy(one.at, at, sizeof one.at);
    one.missing = missing;
    if (d->count >= DIFFERENCES_LISTED) {
        d->kind[missing][KIND_UNSEEN] += 1;
        return;
    }
    difference_box(d->exact, sample, at, lo, hi);
    one.by = decide(triangles, lo, hi, sample, d->count >= d->shown);
    one.voxels = one.by.gap / fmin(size[0], fmin(size[1], size[2]));
    one.kind = difference_kind(d, &one);
    d->kind[missing][one.kind] += 1;
    d->list[d->count] = one;
    d->count += 1;
}

/* Visits the differences in the order of z, y, x. */
static inline void differences_walk(differences *d, const decider *triangles) {
    size_t at[3];
    size_t word;
    for (at[2] = 0; at[2] < d->exact->n[2]; at[2]++) {
        for (at[1] = 0; at[1] < d->exact->n[1]; at[1]++) {
            const uint64_t *exact = voxels_row(d->exact, at[1], at[2]);
            const uint64_t *given = voxels_row(d->given, at[1], at[2]);
            for (word = 0; word < d->exact->row_words; word++) {
                uint64_t rest = exact[word] ^ given[word];
                for (; rest; rest &= rest - 1) {
                    at[0] = 64 * word + voxels_lowest(rest);
                    differences_take(d, triangles, at, (int)(exact[word] >> (at[0] & 63) & 1));
                }
            }
        }
    }
}

static inline void differences_free(differences *d) {
    voxels_free(&d->shifted);
    free(d->is_lost);
    free(d->list);
}

/* Compares; `file` is the file's grid, from which the convention shifts; `shown` differences will be shown.
   Returns 1, or 0 with a sentence in `error`; then there is nothing to free. */
static inline int differences_find(differences *d, const mesh *m, const convention *c,
                                   const tribox_grid *file, const voxels *exact, const voxels *given,
                                   size_t shown, char *error) {
    mesh points;
    decider triangles;
    size_t i;
    int ok;
    memset(d, 0, sizeof *d);
    memset(&points, 0, sizeof points);
    d->m = m;
    d->c = c;
    d->exact = exact;
    d->given = given;
    d->shown = shown;
    for (i = 0; i < exact->words; i++) {
        d->missing += (size_t)voxels_ones(exact->bits[i] & ~given->bits[i]);
        d->extra += (size_t)voxels_ones(given->bits[i] & ~exact->bits[i]);
    }
    if (d->missing + d->extra == 0) {
        return 1;
    }
    if (c->kind == CONVENTION_VERTICES && !mesh_points(&points, m)) {
        snprintf(error, MESH_ERROR, "out of memory");
        return 0;
    }
    if (!decider_make(&triangles, c->kind == CONVENTION_VERTICES ? &points : m)) {
        snprintf(error, MESH_ERROR, "out of memory");
        mesh_free(&points);
        return 0;
    }
    i = d->missing + d->extra;
    d->list = (difference *)malloc((i < (size_t)DIFFERENCES_LISTED ? i : (size_t)DIFFERENCES_LISTED)
                                   * sizeof *d->list);
    ok =
        d->list && differences_find_shift(d, file, error) && differences_find_lost(d, &triangles.mesh, error);
    if (ok) {
        differences_walk(d, &triangles);
    } else {
        differences_free(d);
    }
    decider_free(&triangles);
    mesh_free(&points);
    return ok;
}

#endif /* EXAMPLES_DIFFERENCE_H */
