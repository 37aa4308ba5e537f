/* bench_overlap.c - tribox_overlap against the float SAT, on random pairs and on integer coordinates.
 *
 * Pairs come shuffled from arrays too long for a branch predictor to learn. Random: one third overlap, one
 * third are parted by a face, one third by another axis only. Integer: corners and faces in 0..8, where
 * touching is common.
 */
#include "bench.h"
#include "baseline.h"
#include "tribox.h"

enum { PAIRS = 1 << 15 }; /* 1.9 MB of floats: past any predictor, and streamed */

typedef struct pair {
    float v0[3], v1[3], v2[3], box_min[3], box_max[3];
} pair;

typedef struct pair64 {
    double v0[3], v1[3], v2[3], box_min[3], box_max[3];
} pair64;

/* ---- Inputs -------------------------------------------------------------------------------------------- */

enum { OVERLAP, PARTED_BY_FACE, PARTED_BY_OTHER, CLASSES };

static int classify(const pair *p)
{
    int k;
    for (k = 0; k < 3; k++) {
        if (baseline_sat_face_parts(p->v0[k], p->v1[k], p->v2[k], p->box_min[k], p->box_max[k])) {
            return PARTED_BY_FACE;
        }
    }
    return baseline_sat_early(p->v0, p->v1, p->v2, p->box_min, p->box_max) ? OVERLAP : PARTED_BY_OTHER;
}

static void random_pair(pair *p, uint64_t *seed)
{
    int k;
    for (k = 0; k < 3; k++) {
        float centre = bench_uniform(seed, -1.0f, 1.0f);
        float half = bench_uniform(seed, 0.05f, 0.5f);
        p->v0[k] = bench_uniform(seed, -1.0f, 1.0f);
        p->v1[k] = bench_uniform(seed, -1.0f, 1.0f);
        p->v2[k] = bench_uniform(seed, -1.0f, 1.0f);
        p->box_min[k] = centre - half;
        p->box_max[k] = centre + half;
    }
}

static void integer_pair(pair *p, uint64_t *seed)
{
    int k;
    for (k = 0; k < 3; k++) {
        int low = bench_below(seed, 9);
        int high = bench_below(seed, 9);
        p->v0[k] = (float)bench_below(seed, 9);
        p->v1[k] = (float)bench_below(seed, 9);
        p->v2[k] = (float)bench_below(seed, 9);
        p->box_min[k] = (float)(low < high ? low : high);
        p->box_max[k] = (float)(low < high ? high : low);
    }
}

/* Equal thirds of the three classes, in the random order in which they were drawn. */
static void fill_thirds(pair *pairs, void (*draw)(pair *p, uint64_t *seed), uint64_t seed)
{
    int room[CLASSES];
    int filled = 0;
    int i;
    for (i = 0; i < CLASSES; i++) {
        room[i] = (PAIRS + i) / CLASSES;
    }
    while (filled < PAIRS) {
        draw(&pairs[filled], &seed);
        i = classify(&pairs[filled]);
        if (room[i] > 0) {
            room[i]--;
            filled++;
        }
    }
    for (i = PAIRS - 1; i > 0; i--) {
        int j = bench_below(&seed, i + 1);
        pair swapped = pairs[i];
        pairs[i] = pairs[j];
        pairs[j] = swapped;
    }
}

static void fill_any(pair *pairs, void (*draw)(pair *p, uint64_t *seed), uint64_t seed)
{
    int i;
    for (i = 0; i < PAIRS; i++) {
        draw(&pairs[i], &seed);
    }
}

static void widen(pair64 *wide, const pair *pairs)
{
    int i;
    int k;
    for (i = 0; i < PAIRS; i++) {
        for (k = 0; k < 3; k++) {
            wide[i].v0[k] = (double)pairs[i].v0[k];
            wide[i].v1[k] = (double)pairs[i].v1[k];
            wide[i].v2[k] = (double)pairs[i].v2[k];
            wide[i].box_min[k] = (double)pairs[i].box_min[k];
            wide[i].box_max[k] = (double)pairs[i].box_max[k];
        }
    }
}

static void print_shares(const char *name, const pair *pairs)
{
    int count[CLASSES] = {0, 0, 0};
    int i;
    for (i = 0; i < PAIRS; i++) {
        count[classify(&pairs[i])]++;
    }
    printf("# %s: %.1f %% overlap, %.1f %% parted by a face, %.1f %% by another axis\n", name,
           100.0 * count[OVERLAP] / PAIRS, 100.0 * count[PARTED_BY_FACE] / PAIRS,
           100.0 * count[PARTED_BY_OTHER] / PAIRS);
}

/* ---- Contenders ---------------------------------------------------------------------------------------- */

#define CONTENDER(name, type, expression)              \
    static BENCH_NOINLINE uint64_t name(void *context) \
    {                                                  \
        const type *p = (const type *)context;         \
        const type *end = p + PAIRS;                   \
        uint64_t sum = 0;                              \
        for (; p < end; p++) {                         \
            sum += (uint64_t)(expression);             \
        }                                              \
        return sum;                                    \
    }

/* Touches every value that a test reads, and counts something a compiler cannot foresee. */
#define LOADS(p)                                                                                             \
    ((p)->v0[0] + (p)->v0[1] + (p)->v0[2] + (p)->v1[0] + (p)->v1[1] + (p)->v1[2] + (p)->v2[0] + (p)->v2[1] + \
         (p)->v2[2] + (p)->box_min[0] + (p)->box_min[1] + (p)->box_min[2] + (p)->box_max[0] +                \
         (p)->box_max[1] + (p)->box_max[2] >                                                                 \
     0)
#define ARGUMENTS(p) (p)->v0, (p)->v1, (p)->v2, (p)->box_min, (p)->box_max

CONTENDER(run_loads, pair, LOADS(p))
CONTENDER(run_early, pair, baseline_sat_early(ARGUMENTS(p)))
CONTENDER(run_faces_first, pair, baseline_sat_faces_first(ARGUMENTS(p)))
CONTENDER(run_branchless, pair, baseline_sat_branchless(ARGUMENTS(p)))
#ifdef BASELINE_SSE
CONTENDER(run_sse, pair, baseline_sat_sse(ARGUMENTS(p)))
#endif
CONTENDER(run_crossed, pair, baseline_sat_crossed(ARGUMENTS(p)))
CONTENDER(run_crossed_branchless, pair, baseline_sat_crossed_branchless(ARGUMENTS(p)))
CONTENDER(run_reference, pair, tribox_sat(ARGUMENTS(p)))
CONTENDER(run_overlap, pair, tribox_overlap(ARGUMENTS(p)))
CONTENDER(run_half_open, pair, tribox_overlap_rule(ARGUMENTS(p), TRIBOX_HALF_OPEN))

CONTENDER(run_loads64, pair64, LOADS(p))
CONTENDER(run_early64, pair64, baseline_sat64_early(ARGUMENTS(p)))
CONTENDER(run_faces_first64, pair64, baseline_sat64_faces_first(ARGUMENTS(p)))
CONTENDER(run_branchless64, pair64, baseline_sat64_branchless(ARGUMENTS(p)))
CONTENDER(run_crossed64, pair64, baseline_sat64_crossed(ARGUMENTS(p)))
CONTENDER(run_crossed_branchless64, pair64, baseline_sat64_crossed_branchless(ARGUMENTS(p)))
CONTENDER(run_overlap64, pair64, tribox_overlap_f64(ARGUMENTS(p)))

/* Returns the median of tribox_overlap in seconds, 0 when --only left it out. */
static double bench_float(const bench_options *options, const char *title, pair *pairs)
{
    bench_row rows[10];
    int count = 0;
    int i;
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_loads);
    bench_add(rows, &count, "SAT, early exits", BENCH_RIVAL, run_early);
    bench_add(rows, &count, "SAT, faces then no branch", BENCH_RIVAL, run_faces_first);
    bench_add(rows, &count, "SAT, no branch", BENCH_RIVAL, run_branchless);
    bench_add(rows, &count, "SAT, shared cross products", BENCH_RIVAL, run_crossed);
    bench_add(rows, &count, "SAT, shared cross, no branch", BENCH_RIVAL, run_crossed_branchless);
#ifdef BASELINE_SSE
    bench_add(rows, &count, "SAT, SSE2 intrinsics", BENCH_NOTE, run_sse);
#endif
    bench_add(rows, &count, "tribox_sat, as published", BENCH_NOTE, run_reference);
    bench_add(rows, &count, "tribox_overlap", BENCH_OURS, run_overlap);
    bench_add(rows, &count, "tribox_overlap_rule, half-open", BENCH_OURS, run_half_open);
    count = bench_table(options, title, rows, count, 50, PAIRS, pairs);
    for (i = 0; i < count; i++) {
        if (rows[i].run == run_overlap) {
            return rows[i].median;
        }
    }
    return 0;
}

static void bench_double(const bench_options *options, const char *title, pair64 *pairs)
{
    bench_row rows[10];
    int count = 0;
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_loads64);
    bench_add(rows, &count, "SAT, early exits", BENCH_RIVAL, run_early64);
    bench_add(rows, &count, "SAT, faces then no branch", BENCH_RIVAL, run_faces_first64);
    bench_add(rows, &count, "SAT, no branch", BENCH_RIVAL, run_branchless64);
    bench_add(rows, &count, "SAT, shared cross products", BENCH_RIVAL, run_crossed64);
    bench_add(rows, &count, "SAT, shared cross, no branch", BENCH_RIVAL, run_crossed_branchless64);
    bench_add(rows, &count, "tribox_overlap_f64", BENCH_OURS, run_overlap64);
    bench_table(options, title, rows, count, 50, PAIRS, pairs);
}

int main(int argc, char **argv)
{
    bench_options options;
    pair *pairs = (pair *)bench_alloc(PAIRS * sizeof *pairs);
    pair64 *wide = (pair64 *)bench_alloc(PAIRS * sizeof *wide);
    double random_time;
    double integer_time;
    if (!bench_parse(argc, argv, &options)) {
        return 1;
    }
    bench_header("one triangle, one box");

    fill_thirds(pairs, random_pair, 1);
    print_shares("random pairs", pairs);
    random_time = bench_float(&options, "random pairs, float", pairs);
    widen(wide, pairs);
    bench_double(&options, "random pairs, double", wide);

    fill_any(pairs, integer_pair, 2);
    putchar('\n');
    print_shares("integer coordinates 0..8", pairs);
    integer_time = bench_float(&options, "integer coordinates 0..8, float", pairs);
    widen(wide, pairs);
    bench_double(&options, "integer coordinates 0..8, double", wide);

    fill_thirds(pairs, integer_pair, 3);
    putchar('\n');
    print_shares("integer coordinates 0..8 in thirds", pairs);
    bench_float(&options, "integer coordinates 0..8 in thirds, float", pairs);
    if (random_time > 0) {
        printf("\ntribox_overlap: integer coordinates take %.2f x the time of random pairs\n",
               integer_time / random_time);
    }
    free(pairs);
    free(wide);
    return 0;
}
