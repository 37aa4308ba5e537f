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

int main(int argc, char **argv)
{
    bench_options options;
    pair *pairs = (pair *)bench_alloc(sizeof *pairs * PAIRS);
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
    return 0;
}
