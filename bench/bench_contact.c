/* bench_contact.c - contact: gaps and sweeps against tribox_overlap and tribox_sweep, a segment through a grid
 * against the traversal of Amanatides and Woo in float, spheres against plain float code.
 */
#include "bench.h"
#include "tribox.h"

#include <math.h>

enum { PAIRS = 1 << 14 };

/* ---- triangle and box ---------------------------------------------------------------------------------- */

typedef struct pair {
    float v0[3], v1[3], v2[3], box_min[3], box_max[3], velocity[3];
} pair;

/* Random pairs, or with the triangle level on one axis, as floors and walls are. */
static void make_pairs(pair *pairs, int level, uint64_t seed)
{
    int i;
    int k;
    for (i = 0; i < PAIRS; i++) {
        pair *p = &pairs[i];
        for (k = 0; k < 3; k++) {
            float centre = bench_uniform(&seed, -1.0f, 1.0f);
            float half = bench_uniform(&seed, 0.05f, 0.5f);
            p->v0[k] = bench_uniform(&seed, -1.0f, 1.0f);
            p->v1[k] = bench_uniform(&seed, -1.0f, 1.0f);
            p->v2[k] = bench_uniform(&seed, -1.0f, 1.0f);
            p->velocity[k] = bench_uniform(&seed, -1.0f, 1.0f);
            p->box_min[k] = centre - half;
            p->box_max[k] = centre + half;
        }
        if (level) {
            k = bench_below(&seed, 3);
            p->v1[k] = p->v2[k] = p->v0[k];
        }
    }
}

#define PAIR_LOOP(name, expression)                        \
    static BENCH_NOINLINE uint64_t name(void *context)     \
    {                                                      \
        const pair *p = (const pair *)context;             \
        const pair *end = p + PAIRS;                       \
        uint64_t sum = 0;                                  \
        float t[2];                                        \
        float axis[3];                                     \
        (void)t;                                           \
        (void)axis;                                        \
        for (; p < end; p++) {                             \
            sum += (uint64_t)(expression);                 \
        }                                                  \
        return sum;                                        \
    }

#define TRIANGLE p->v0, p->v1, p->v2
#define BOX p->box_min, p->box_max
PAIR_LOOP(run_overlap, tribox_overlap(TRIANGLE, BOX))
PAIR_LOOP(run_gap, tribox_gap(TRIANGLE, BOX, axis) <= 0.0)
PAIR_LOOP(run_sweep, tribox_sweep(TRIANGLE, BOX, p->velocity, &t[0], &t[1], axis))
PAIR_LOOP(run_sweep_rule, tribox_sweep_rule(TRIANGLE, BOX, p->velocity, TRIBOX_OPEN, &t[0], &t[1], axis))
PAIR_LOOP(run_sweep_box, tribox_sweep_box(BOX, p->v0, p->v0, p->velocity, TRIBOX_OPEN, &t[0], &t[1], axis))

static void bench_gap(const bench_options *options, const char *title, pair *pairs)
{
    bench_row rows[4];
    int count = 0;
    bench_add(rows, &count, "tribox_overlap", BENCH_RIVAL, run_overlap);
    bench_add(rows, &count, "tribox_gap", BENCH_OURS, run_gap);
    bench_table(options, title, rows, count, 50, PAIRS, pairs);
}

/* ---- a segment through a grid -------------------------------------------------------------------------- */

enum { SEGMENTS = 512, SIDE = 512 };

typedef struct segments {
    double p[SEGMENTS][3];
    double q[SEGMENTS][3];
    float p32[SEGMENTS][3];
    float q32[SEGMENTS][3];
    tribox_grid grid;
    uint64_t voxels;
} segments;

static void make_segments(segments *s)
{
    uint64_t seed = 11;
    int i;
    int k;
    for (k = 0; k < 3; k++) {
        s->grid.origin[k] = 0.0;
        s->grid.size[k] = 1.0 / SIDE;
        s->grid.lo[k] = 0;
        s->grid.hi[k] = SIDE;
    }
    s->grid.flags = 0;
    s->voxels = 0;
    for (i = 0; i < SEGMENTS; i++) {
        for (k = 0; k < 3; k++) {
            s->p32[i][k] = bench_uniform(&seed, 0.0f, 1.0f);
            s->q32[i][k] = bench_uniform(&seed, 0.0f, 1.0f);
            s->p[i][k] = (double)s->p32[i][k];
            s->q[i][k] = (double)s->q32[i][k];
        }
        s->voxels += tribox_grid_segment(&s->grid, s->p[i], s->q[i], NULL, NULL);
    }
}

/* Out of line: what a traversal does with a voxel. */
static BENCH_NOINLINE int see_voxel(void *user, int x, int y, int z)
{
    *(uint64_t *)user += (uint64_t)(x ^ y ^ z) & 1u;
    return 0;
}

/* Amanatides and Woo, A fast voxel traversal algorithm for ray tracing, 1987: in float, from the first voxel,
 * by the least of three times, until the segment's end. */
static BENCH_NOINLINE void amanatides_woo(const float p[3], const float q[3], int (*emit)(void *, int, int, int),
                                          void *user)
{
    int at[3];
    int step[3];
    float next[3];
    float delta[3];
    int k;
    for (k = 0; k < 3; k++) {
        const float d = (q[k] - p[k]) * SIDE;
        const float x = p[k] * SIDE;
        at[k] = (int)x;
        step[k] = d > 0.0f ? 1 : -1;
        delta[k] = d > 0.0f ? 1.0f / d : d < 0.0f ? -1.0f / d : 1e30f;
        next[k] = d > 0.0f   ? ((float)(at[k] + 1) - x) * delta[k]
                  : d < 0.0f ? (x - (float)at[k]) * delta[k]
                             : 1e30f;
    }
    for (;;) {
        if (emit(user, at[0], at[1], at[2]) != 0) {
            return;
        }
        if (next[0] < next[1] && next[0] < next[2]) {
            if (next[0] > 1.0f) {
                return;
            }
            at[0] += step[0];
            if (at[0] < 0 || at[0] >= SIDE) {
                return;
            }
            next[0] += delta[0];
        } else if (next[1] < next[2]) {
            if (next[1] > 1.0f) {
                return;
            }
            at[1] += step[1];
            if (at[1] < 0 || at[1] >= SIDE) {
                return;
            }
            next[1] += delta[1];
        } else {
            if (next[2] > 1.0f) {
                return;
            }
            at[2] += step[2];
            if (at[2] < 0 || at[2] >= SIDE) {
                return;
            }
            next[2] += delta[2];
        }
    }
}

static BENCH_NOINLINE uint64_t run_amanatides_woo(void *context)
{
    const segments *s = (const segments *)context;
    uint64_t sum = 0;
    int i;
    for (i = 0; i < SEGMENTS; i++) {
        amanatides_woo(s->p32[i], s->q32[i], see_voxel, &sum);
    }
    return sum;
}

static BENCH_NOINLINE uint64_t run_segment(void *context)
{
    const segments *s = (const segments *)context;
    uint64_t sum = 0;
    int i;
    for (i = 0; i < SEGMENTS; i++) {
        tribox_grid_segment(&s->grid, s->p[i], s->q[i], see_voxel, &sum);
    }
    return sum;
}

int main(int argc, char **argv)
{
    bench_options options;
    pair *pairs = (pair *)bench_alloc(sizeof *pairs * PAIRS);
    segments *lines = (segments *)bench_alloc(sizeof *lines);
    bench_row rows[8];
    int count = 0;
    if (!bench_parse(argc, argv, &options)) {
        return 1;
    }
    bench_header("contact");
    make_pairs(pairs, 1, 3);
    bench_gap(&options, "gap, level triangles", pairs);
    make_pairs(pairs, 0, 5);
    bench_gap(&options, "gap, random pairs", pairs);
    bench_add(rows, &count, "tribox_sweep", BENCH_RIVAL, run_sweep);
    bench_add(rows, &count, "tribox_sweep_rule, open", BENCH_OURS, run_sweep_rule);
    bench_add(rows, &count, "tribox_sweep_box, open", BENCH_NOTE, run_sweep_box);
    bench_add(rows, &count, "tribox_gap", BENCH_NOTE, run_gap);
    bench_table(&options, "sweep", rows, count, 20, PAIRS, pairs);
    free(pairs);

    make_segments(lines);
    printf("# %d segments, %.0f voxels each\n", SEGMENTS, (double)lines->voxels / SEGMENTS);
    count = 0;
    bench_add(rows, &count, "Amanatides and Woo, float", BENCH_RIVAL, run_amanatides_woo);
    bench_add(rows, &count, "tribox_grid_segment", BENCH_OURS, run_segment);
    bench_table(&options, "segment through 512^3, a voxel", rows, count, 20, (long)lines->voxels, lines);
    free(lines);
    return 0;
}
