/* bench_companions.c - the questions beside the question: mesh_query against a loop of tribox_sat, octants
 * against eight tests, ray_box against a plain float slab test; and what one call of each of the others
 * takes.
 */
#include "bench.h"
#include "baseline.h"
#include "mesh_gen.h"
#include "tribox.h"

#define CONTENDER(name, context_type, expression)              \
    static BENCH_NOINLINE uint64_t name(void *context)         \
    {                                                          \
        const context_type *j = (const context_type *)context; \
        uint64_t sum = 0;                                      \
        size_t i;                                              \
        for (i = 0; i < j->count; i++) {                       \
            sum += (uint64_t)(expression);                     \
        }                                                      \
        return sum;                                            \
    }

/* ---- Which triangles touch a box ----------------------------------------------------------------------- */

typedef struct query {
    tribox_mesh mesh;
    size_t count; /* of triangles */
    float box_min[3], box_max[3];
    uint32_t *found;
} query;

BASELINE_FN const float *query_corner(const query *q, size_t i)
{
    return q->mesh.positions + 3 * (size_t)q->mesh.indices[i];
}

typedef int (*box_test)(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                        const float box_max[3]);

/* The loop a program writes for itself. It is inlined below with its test, which is then no call through a
 * pointer. */
BASELINE_FN uint64_t query_loop(const query *j, box_test test)
{
    uint64_t found = 0;
    size_t i;
    for (i = 0; i < j->count; i++) {
        if (test(query_corner(j, 3 * i), query_corner(j, 3 * i + 1), query_corner(j, 3 * i + 2), j->box_min,
                 j->box_max)) {
            j->found[found++] = (uint32_t)i;
        }
    }
    return found;
}

static BENCH_NOINLINE uint64_t run_query_sat(void *context)
{
    return query_loop((const query *)context, tribox_sat);
}

static BENCH_NOINLINE uint64_t run_query_tuned(void *context)
{
    return query_loop((const query *)context, baseline_sat_early);
}

static BENCH_NOINLINE uint64_t run_query_overlap(void *context)
{
    return query_loop((const query *)context, tribox_overlap);
}

static BENCH_NOINLINE uint64_t run_query(void *context)
{
    const query *j = (const query *)context;
    return tribox_mesh_query(&j->mesh, j->box_min, j->box_max, j->found, j->count);
}

CONTENDER(run_query_loads, query,
          query_corner(j, 3 * i)[0] + query_corner(j, 3 * i + 1)[1] + query_corner(j, 3 * i + 2)[2] > 0)

/* A cube round a vertex that touches `share` of the triangles. */
static void query_box(query *q, double share)
{
    const float *centre = query_corner(q, 0);
    float low = 0;
    float high = 8;
    int step;
    int k;
    for (step = 0; step < 24; step++) {
        float half = 0.5f * (low + high);
        for (k = 0; k < 3; k++) {
            q->box_min[k] = centre[k] - half;
            q->box_max[k] = centre[k] + half;
        }
        if ((double)query_loop(q, baseline_sat_early) < share * (double)q->count) {
            low = half;
        } else {
            high = half;
        }
    }
}

static void bench_query(const bench_options *options, int along, int around)
{
    bench_row rows[5];
    char title[80];
    int count = 0;
    mesh m;
    query q;
    mesh_gen_scan(&m, along, around);
    q.mesh = mesh_view(&m);
    q.count = m.triangles;
    q.found = (uint32_t *)bench_alloc(m.triangles * sizeof *q.found);
    query_box(&q, 0.01);
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_query_loads);
    bench_add(rows, &count, "loop of tribox_sat", BENCH_RIVAL, run_query_sat);
    bench_add(rows, &count, "loop of the tuned float SAT", BENCH_NOTE, run_query_tuned);
    bench_add(rows, &count, "loop of tribox_overlap", BENCH_NOTE, run_query_overlap);
    bench_add(rows, &count, "tribox_mesh_query", BENCH_OURS, run_query);
    snprintf(title, sizeof title, "a box that touches 1 %% of %lu triangles, per triangle",
             (unsigned long)q.count);
    bench_table(options, title, rows, count, 30, (double)q.count, &q);
    free(q.found);
    mesh_free(&m);
}

/* ---- Eight boxes at once ------------------------------------------------------------------------------- */

enum { TRIANGLES = 64, CELLS = 1 << 14 };

/* Cells of an octree that their triangle touches; the eight children are asked for. */
typedef struct cell {
    const tribox_tri *tri; /* prepared for a child */
    float p[3];
} cell;

typedef struct descent {
    tribox_tri tri[TRIANGLES];
    cell cells[CELLS];
    float size[3];
    size_t count;
} descent;

static void make_descent(descent *d, uint64_t seed)
{
    int i;
    int k;
    d->count = 0;
    for (k = 0; k < 3; k++) {
        d->size[k] = 0.05f;
    }
    for (i = 0; i < TRIANGLES; i++) {
        float corner[3][3];
        float parent_size[3];
        tribox_tri parent;
        int cell_index[3];
        for (k = 0; k < 3; k++) {
            corner[0][k] = bench_uniform(&seed, 0.0f, 1.0f);
            corner[1][k] = bench_uniform(&seed, 0.0f, 1.0f);
            corner[2][k] = bench_uniform(&seed, 0.0f, 1.0f);
            parent_size[k] = 2 * d->size[k];
        }
        tribox_tri_init(&d->tri[i], corner[0], corner[1], corner[2], d->size, 0);
        tribox_tri_init(&parent, corner[0], corner[1], corner[2], parent_size, 0);
        for (cell_index[2] = 0; cell_index[2] < 10; cell_index[2]++) {
            for (cell_index[1] = 0; cell_index[1] < 10; cell_index[1]++) {
                for (cell_index[0] = 0; cell_index[0] < 10; cell_index[0]++) {
                    cell *c = &d->cells[d->count];
                    c->tri = &d->tri[i];
                    for (k = 0; k < 3; k++) {
                        c->p[k] = (float)cell_index[k] * parent_size[k];
                    }
                    d->count += d->count + 1 < CELLS && tribox_tri_test(&parent, c->p);
                }
            }
        }
    }
}

BASELINE_FN unsigned eight_tests(const cell *c, const float size[3])
{
    unsigned mask = 0;
    unsigned i;
    for (i = 0; i < 8; i++) {
        float p[3];
        p[0] = c->p[0] + (i & 1 ? size[0] : 0.0f);
        p[1] = c->p[1] + (i & 2 ? size[1] : 0.0f);
        p[2] = c->p[2] + (i & 4 ? size[2] : 0.0f);
        mask |= (unsigned)tribox_tri_test(c->tri, p) << i;
    }
    return mask;
}

CONTENDER(run_cells_loads, descent, j->cells[i].p[0] + j->cells[i].p[1] + j->cells[i].p[2] > 1.0f)
CONTENDER(run_eight, descent, eight_tests(&j->cells[i], j->size))
CONTENDER(run_octants, descent, tribox_tri_octants(j->cells[i].tri, j->cells[i].p))

static void bench_octants(const bench_options *options)
{
    bench_row rows[3];
    int count = 0;
    descent *d = (descent *)bench_alloc(sizeof *d);
    make_descent(d, 5);
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_cells_loads);
    bench_add(rows, &count, "eight tribox_tri_test", BENCH_RIVAL, run_eight);
    bench_add(rows, &count, "tribox_tri_octants", BENCH_OURS, run_octants);
    bench_table(options, "eight children of a cell, per cell", rows, count, 50, (double)d->count, d);
    free(d);
}

/* ---- Rays, and one call of each of the others ---------------------------------------------------------- */

typedef struct question {
    float v0[3], v1[3], v2[3], box_min[3], box_max[3], origin[3], direction[3];
} question;

typedef struct questions {
    size_t count;
    question q[1 << 14];
} questions;

static void make_questions(questions *j, uint64_t seed)
{
    size_t i;
    int k;
    j->count = sizeof j->q / sizeof *j->q;
    for (i = 0; i < j->count; i++) {
        question *q = &j->q[i];
        for (k = 0; k < 3; k++) {
            float centre = bench_uniform(&seed, -0.5f, 0.5f);
            float half = bench_uniform(&seed, 0.1f, 0.6f);
            q->v0[k] = bench_uniform(&seed, -1.0f, 1.0f);
            q->v1[k] = bench_uniform(&seed, -1.0f, 1.0f);
            q->v2[k] = bench_uniform(&seed, -1.0f, 1.0f);
            q->box_min[k] = centre - half;
            q->box_max[k] = centre + half;
            q->origin[k] = bench_uniform(&seed, -2.0f, 2.0f);
            q->direction[k] =
                bench_uniform(&seed, -0.5f, 0.5f) - q->origin[k]; /* about half of the rays hit */
        }
    }
}

/* [KK86] in plain float: the interval of t in three slabs. */
BASELINE_FN int slab_test(const float origin[3], const float direction[3], float t_min, float t_max,
                          const float box_min[3], const float box_max[3], float *out_t0, float *out_t1)
{
    int k;
    for (k = 0; k < 3; k++) {
        float inverse = 1.0f / direction[k];
        float a = (box_min[k] - origin[k]) * inverse;
        float b = (box_max[k] - origin[k]) * inverse;
        t_min = baseline_sat_max(t_min, baseline_sat_min(a, b));
        t_max = baseline_sat_min(t_max, baseline_sat_max(a, b));
    }
    *out_t0 = t_min;
    *out_t1 = t_max;
    return t_min <= t_max;
}

typedef int (*ray_test)(const float origin[3], const float direction[3], float t_min, float t_max,
                        const float box_min[3], const float box_max[3], float *out_t0, float *out_t1);

/* Counts the hits, and among them the intervals longer than 1/4, so that both ends are needed. */
BASELINE_FN uint64_t ray_loop(const questions *j, ray_test test)
{
    uint64_t sum = 0;
    size_t i;
    for (i = 0; i < j->count; i++) {
        const question *q = &j->q[i];
        float t0 = 0;
        float t1 = 0;
        int hit = test(q->origin, q->direction, 0.0f, 1e30f, q->box_min, q->box_max, &t0, &t1);
        sum += (uint64_t)(hit + (hit & (t1 - t0 > 0.25f)));
    }
    return sum;
}

static BENCH_NOINLINE uint64_t run_slab(void *context)
{
    return ray_loop((const questions *)context, slab_test);
}

static BENCH_NOINLINE uint64_t run_ray_box(void *context)
{
    return ray_loop((const questions *)context, tribox_ray_box);
}

#define Q          (&j->q[i])
#define Q_TRIANGLE Q->v0, Q->v1, Q->v2
#define Q_BOX      Q->box_min, Q->box_max

BASELINE_FN int sweep_all(const question *q)
{
    float t[2];
    float axis[3];
    return tribox_sweep(q->v0, q->v1, q->v2, q->box_min, q->box_max, q->direction, &t[0], &t[1], axis);
}

BASELINE_FN int clip_all(const question *q)
{
    float polygon[9][3];
    return tribox_clip(q->v0, q->v1, q->v2, q->box_min, q->box_max, polygon);
}

BASELINE_FN int closest_all(const question *q)
{
    float weights[3];
    tribox_closest(q->v0, q->v1, q->v2, q->origin, weights);
    return weights[0] > 0;
}

BASELINE_FN int ray_triangle_all(const question *q)
{
    float t;
    return tribox_ray_triangle(q->origin, q->direction, 0.0f, 2.0f, q->v0, q->v1, q->v2, &t);
}

CONTENDER(run_loads, questions,
          Q->v0[0] + Q->v1[0] + Q->v2[0] + Q->box_min[0] + Q->box_max[0] + Q->origin[0] + Q->direction[0] > 0)
CONTENDER(run_box_box, questions, tribox_box_box(Q_BOX, j->q[i ^ 1].box_min, j->q[i ^ 1].box_max))
CONTENDER(run_plane_box, questions, tribox_plane_box(Q->direction, 0.5f, Q_BOX) + 1)
CONTENDER(run_segment_box, questions, tribox_segment_box(Q->v0, Q->v1, Q_BOX))
CONTENDER(run_sweep, questions, sweep_all(Q))
CONTENDER(run_clip, questions, clip_all(Q))
CONTENDER(run_closest, questions, closest_all(Q))
CONTENDER(run_ray_triangle, questions, ray_triangle_all(Q))

static void bench_questions(const bench_options *options)
{
    bench_row rows[8];
    int count = 0;
    questions *j = (questions *)bench_alloc(sizeof *j);
    make_questions(j, 6);
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_loads);
    bench_add(rows, &count, "plain float slab test", BENCH_RIVAL, run_slab);
    bench_add(rows, &count, "tribox_ray_box", BENCH_OURS, run_ray_box);
    bench_table(options, "ray and box", rows, count, 50, (double)j->count, j);
    count = 0;
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_loads);
    bench_add(rows, &count, "tribox_box_box", BENCH_OURS, run_box_box);
    bench_add(rows, &count, "tribox_plane_box", BENCH_OURS, run_plane_box);
    bench_add(rows, &count, "tribox_segment_box", BENCH_OURS, run_segment_box);
    bench_add(rows, &count, "tribox_ray_triangle", BENCH_OURS, run_ray_triangle);
    bench_add(rows, &count, "tribox_closest", BENCH_OURS, run_closest);
    bench_add(rows, &count, "tribox_clip", BENCH_OURS, run_clip);
    bench_add(rows, &count, "tribox_sweep", BENCH_OURS, run_sweep);
    bench_table(options, "one call each", rows, count, 20, (double)j->count, j);
    free(j);
}

int main(int argc, char **argv)
{
    bench_options options;
    if (!bench_parse(argc, argv, &options)) {
        return 1;
    }
    bench_header("the questions beside the question");
    bench_query(&options, 829, 60);   /* 99k triangles, in cache */
    bench_query(&options, 2447, 178); /* 871k, streamed */
    bench_octants(&options);
    bench_questions(&options);
    return 0;
}
