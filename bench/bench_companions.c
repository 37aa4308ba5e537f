/* bench_companions.c - the companions against what they replace: a query against a loop of tribox_sat over
 * the mesh, octants against eight tests, rays against a plain float slab test. The others are timed for
 * themselves.
 */
#include "bench.h"
#include "tribox.h"

#include <math.h>

enum { SIDE = 224, TRIANGLES = 2 * SIDE * SIDE, RAYS = 1 << 13, NODES = 1 << 12, DESCENTS = 1 << 8 };

/* ---- mesh query ---------------------------------------------------------------------------------------- */

typedef struct query_input {
    tribox_mesh mesh;
    float box_min[3];
    float box_max[3];
    uint32_t found[TRIANGLES];
} query_input;

/* A wavy sheet of quads, indexed row by row, as scans and terrains are. */
static void make_sheet(query_input *input, float *positions, uint32_t *indices)
{
    int x;
    int y;
    for (y = 0; y <= SIDE; y++) {
        for (x = 0; x <= SIDE; x++) {
            float *p = positions + 3 * (y * (SIDE + 1) + x);
            p[0] = (float)x / SIDE;
            p[1] = (float)y / SIDE;
            p[2] = 0.1f * (float)(sin(9.0 * x / SIDE) * cos(7.0 * y / SIDE));
        }
    }
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            uint32_t at = (uint32_t)(y * (SIDE + 1) + x);
            uint32_t *t = indices + 6 * (y * SIDE + x);
            t[0] = at;
            t[1] = at + 1;
            t[2] = at + SIDE + 1;
            t[3] = at + 1;
            t[4] = at + SIDE + 2;
            t[5] = at + SIDE + 1;
        }
    }
    input->mesh.positions = positions;
    input->mesh.stride = 0;
    input->mesh.indices = indices;
    input->mesh.triangles = TRIANGLES;
    for (x = 0; x < 3; x++) {
        input->box_min[x] = x < 2 ? 0.4003f : -1.0f;
        input->box_max[x] = x < 2 ? 0.4957f : 1.0f;
    }
}

static BENCH_NOINLINE uint64_t run_query(void *context)
{
    query_input *input = (query_input *)context;
    return tribox_mesh_query(&input->mesh, input->box_min, input->box_max, input->found, TRIANGLES);
}

#define QUERY_LOOP(name, test)                                                                       \
    static BENCH_NOINLINE uint64_t name(void *context)                                               \
    {                                                                                                \
        query_input *input = (query_input *)context;                                                 \
        const float *p = input->mesh.positions;                                                      \
        const uint32_t *i = input->mesh.indices;                                                     \
        size_t count = 0;                                                                            \
        uint32_t t;                                                                                  \
        for (t = 0; t < TRIANGLES; t++, i += 3) {                                                    \
            if (test(p + 3 * i[0], p + 3 * i[1], p + 3 * i[2], input->box_min, input->box_max)) {    \
                input->found[count++] = t;                                                           \
            }                                                                                        \
        }                                                                                            \
        return count;                                                                                \
    }

QUERY_LOOP(run_sat_loop, tribox_sat)
QUERY_LOOP(run_overlap_loop, tribox_overlap)

/* ---- rays ---------------------------------------------------------------------------------------------- */

typedef struct ray_input {
    float origin[RAYS][3];
    float dir[RAYS][3];
    float box_min[RAYS][3];
    float box_max[RAYS][3];
    float v[RAYS][3][3];
    float entered[RAYS];
} ray_input;

/* A third of the rays hit; the others pass a box of the same size. */
static void make_rays(ray_input *input)
{
    uint64_t seed = 5;
    int i;
    int k;
    for (i = 0; i < RAYS; i++) {
        for (k = 0; k < 3; k++) {
            float centre = bench_uniform(&seed, -1.0f, 1.0f);
            float half = bench_uniform(&seed, 0.1f, 0.5f);
            float aim = centre + 3.0f * half * bench_uniform(&seed, -1.0f, 1.0f);
            input->box_min[i][k] = centre - half;
            input->box_max[i][k] = centre + half;
            input->origin[i][k] = bench_uniform(&seed, -3.0f, 3.0f);
            input->dir[i][k] = aim - input->origin[i][k];
            input->v[i][0][k] = centre + half;
            input->v[i][1][k] = centre + 3.0f * half * bench_uniform(&seed, -1.0f, 1.0f);
            input->v[i][2][k] = centre + 3.0f * half * bench_uniform(&seed, -1.0f, 1.0f);
        }
    }
}

/* [KK86] as renderers write it: one reciprocal and two products an axis, minima and maxima, no branch.
 * Called, as ours is: over an array of rays a compiler would turn the loop into vectors of rays, which no
 * traversal does. */
static BENCH_NOINLINE int slab(const float origin[3], const float dir[3], float t_min, float t_max,
                               const float box_min[3],
                       const float box_max[3], float *out_t0, float *out_t1)
{
    int k;
    for (k = 0; k < 3; k++) {
        float inverse = 1.0f / dir[k];
        float a = (box_min[k] - origin[k]) * inverse;
        float b = (box_max[k] - origin[k]) * inverse;
        float lower = a < b ? a : b;
        float upper = a < b ? b : a;
        t_min = t_min > lower ? t_min : lower;
        t_max = t_max < upper ? t_max : upper;
    }
    *out_t0 = t_min;
    *out_t1 = t_max;
    return t_min <= t_max;
}

static BENCH_NOINLINE int ray_box(const float origin[3], const float dir[3], float t_min, float t_max,
                                  const float box_min[3], const float box_max[3], float *out_t0,
                                  float *out_t1)
{
    return tribox_ray_box(origin, dir, t_min, t_max, box_min, box_max, out_t0, out_t1);
}

/* Keeps where the boxes that are hit are entered, as a traversal does. */
#define RAY_LOOP(name, test)                                                                              \
    static BENCH_NOINLINE uint64_t name(void *context)                                                    \
    {                                                                                                     \
        ray_input *r = (ray_input *)context;                                                              \
        uint64_t hits = 0;                                                                                \
        int i;                                                                                            \
        for (i = 0; i < RAYS; i++) {                                                                      \
            float t0 = 0.0f;                                                                              \
            float t1 = 0.0f;                                                                              \
            if (test) {                                                                                   \
                r->entered[hits++] = t0 + t1;                                                             \
            }                                                                                             \
        }                                                                                                 \
        return hits;                                                                                      \
    }

#define RAY_ARGUMENTS r->origin[i], r->dir[i], 0.0f, 1.0e9f
RAY_LOOP(run_ray_loads, (t1 = r->origin[i][0] + r->dir[i][1] + r->box_min[i][2] + r->box_max[i][0]) > 1.0f)
RAY_LOOP(run_slab, slab(RAY_ARGUMENTS, r->box_min[i], r->box_max[i], &t0, &t1))
RAY_LOOP(run_ray_box, ray_box(RAY_ARGUMENTS, r->box_min[i], r->box_max[i], &t0, &t1))
RAY_LOOP(run_ray_triangle, tribox_ray_triangle(RAY_ARGUMENTS, r->v[i][0], r->v[i][1], r->v[i][2], &t0))
RAY_LOOP(run_segment_box, tribox_segment_box(r->origin[i], r->v[i][1], r->box_min[i], r->box_max[i]))
RAY_LOOP(run_plane_box, tribox_plane_box(r->dir[i], r->origin[i][0], r->box_min[i], r->box_max[i]) == 0)
RAY_LOOP(run_box_box, tribox_box_box(r->box_min[i], r->box_max[i], r->box_min[i ^ 1], r->box_max[i ^ 1]))

static BENCH_NOINLINE uint64_t run_sweep(void *context)
{
    const ray_input *r = (const ray_input *)context;
    uint64_t hits = 0;
    float t0;
    float t1;
    float axis[3];
    int i;
    for (i = 0; i < RAYS; i++) {
        hits += (uint64_t)tribox_sweep(r->v[i][0], r->v[i][1], r->v[i][2], r->box_min[i ^ 1],
                                       r->box_max[i ^ 1], r->dir[i], &t0, &t1, axis);
    }
    return hits;
}

static BENCH_NOINLINE uint64_t run_clip(void *context)
{
    const ray_input *r = (const ray_input *)context;
    uint64_t corners = 0;
    float polygon[9][3];
    int i;
    for (i = 0; i < RAYS; i++) {
        corners += (uint64_t)tribox_clip(r->v[i][0], r->v[i][1], r->v[i][2], r->box_min[i], r->box_max[i],
                                         polygon);
    }
    return corners;
}

static BENCH_NOINLINE uint64_t run_closest(void *context)
{
    const ray_input *r = (const ray_input *)context;
    uint64_t inside = 0;
    float weights[3];
    int i;
    for (i = 0; i < RAYS; i++) {
        tribox_closest(r->v[i][0], r->v[i][1], r->v[i][2], r->origin[i], weights);
        inside += weights[0] > 0.0f && weights[1] > 0.0f && weights[2] > 0.0f;
    }
    return inside;
}

/* ---- the same in doubles ------------------------------------------------------------------------------- */

typedef struct wide_input {
    double origin[RAYS][3];
    double dir[RAYS][3];
    double box_min[RAYS][3];
    double box_max[RAYS][3];
    double v[RAYS][3][3];
} wide_input;

/* The rays' numbers with all 53 bits. */
static void widen(double *out, const float *x, int n)
{
    int i;
    for (i = 0; i < n; i++) {
        out[i] = (double)x[i] * 1.000000001;
    }
}

static void make_wide(wide_input *out, const ray_input *r)
{
    widen(out->origin[0], r->origin[0], 3 * RAYS);
    widen(out->dir[0], r->dir[0], 3 * RAYS);
    widen(out->box_min[0], r->box_min[0], 3 * RAYS);
    widen(out->box_max[0], r->box_max[0], 3 * RAYS);
    widen(out->v[0][0], r->v[0][0], 9 * RAYS);
}

#define WIDE_LOOP(name, test)                                                                             \
    static BENCH_NOINLINE uint64_t name(void *context)                                                    \
    {                                                                                                     \
        const wide_input *r = (const wide_input *)context;                                                \
        uint64_t sum = 0;                                                                                 \
        double polygon[9][3];                                                                             \
        int i;                                                                                            \
        for (i = 0; i < RAYS; i++) {                                                                      \
            polygon[0][0] = polygon[0][1] = 0.0;                                                          \
            sum += (uint64_t)(test);                                                                      \
        }                                                                                                 \
        return sum;                                                                                       \
    }

#define WIDE_RAY r->origin[i], r->dir[i], 0.0, 1.0e9
#define WIDE_TRIANGLE r->v[i][0], r->v[i][1], r->v[i][2]
WIDE_LOOP(run_box_box_f64, tribox_box_box_f64(r->box_min[i], r->box_max[i], r->box_min[i ^ 1], r->box_max[i ^ 1]))
WIDE_LOOP(run_segment_box_f64, tribox_segment_box_f64(r->origin[i], r->v[i][1], r->box_min[i], r->box_max[i]))
WIDE_LOOP(run_ray_box_f64, tribox_ray_box_f64(WIDE_RAY, r->box_min[i], r->box_max[i], &polygon[0][0], &polygon[0][1]))
WIDE_LOOP(run_ray_meets_f64, tribox_ray_box_f64(WIDE_RAY, r->box_min[i], r->box_max[i], NULL, NULL))
WIDE_LOOP(run_ray_triangle_f64, tribox_ray_triangle_f64(WIDE_RAY, WIDE_TRIANGLE, &polygon[0][0]))
WIDE_LOOP(run_clip_f64, tribox_clip_f64(WIDE_TRIANGLE, r->box_min[i], r->box_max[i], polygon))
WIDE_LOOP(run_closest_f64, (tribox_closest_f64(WIDE_TRIANGLE, r->origin[i], polygon[0]), polygon[0][0] > 0.0))

/* ---- octants ------------------------------------------------------------------------------------------- */

typedef struct octant_input {
    tribox_tri tri[DESCENTS];
    float p[NODES][3];
    float size[3];
} octant_input;

/* Nodes that their triangle touches, sixteen to each, as a descent meets them. */
static void make_nodes(octant_input *input)
{
    uint64_t seed = 9;
    const float node_size[3] = {0.25f, 0.25f, 0.25f};
    int t;
    int i;
    int k;
    for (k = 0; k < 3; k++) {
        input->size[k] = 0.125f;
    }
    for (t = 0; t < DESCENTS; t++) {
        float v[3][3];
        for (k = 0; k < 9; k++) {
            v[k / 3][k % 3] = bench_uniform(&seed, 0.0f, 1.0f);
        }
        tribox_tri_init(&input->tri[t], v[0], v[1], v[2], node_size, 0);
        for (i = t * (NODES / DESCENTS); i < (t + 1) * (NODES / DESCENTS); i++) {
            do {
                for (k = 0; k < 3; k++) {
                    input->p[i][k] = (float)bench_below(&seed, 4) * 0.25f;
                }
            } while (!tribox_tri_test(&input->tri[t], input->p[i]));
        }
        tribox_tri_resize(&input->tri[t], input->size);
    }
}

static BENCH_NOINLINE uint64_t run_octants(void *context)
{
    const octant_input *input = (const octant_input *)context;
    uint64_t sum = 0;
    int i;
    for (i = 0; i < NODES; i++) {
        sum += tribox_tri_octants(&input->tri[i / (NODES / DESCENTS)], input->p[i]);
    }
    return sum;
}

static BENCH_NOINLINE uint64_t run_eight_tests(void *context)
{
    const octant_input *input = (const octant_input *)context;
    uint64_t sum = 0;
    int i;
    for (i = 0; i < NODES; i++) {
        const tribox_tri *tri = &input->tri[i / (NODES / DESCENTS)];
        unsigned bits = 0;
        int o;
        for (o = 0; o < 8; o++) {
            float p[3];
            p[0] = input->p[i][0] + (o & 1 ? input->size[0] : 0.0f);
            p[1] = input->p[i][1] + (o & 2 ? input->size[1] : 0.0f);
            p[2] = input->p[i][2] + (o & 4 ? input->size[2] : 0.0f);
            bits |= (unsigned)tribox_tri_test(tri, p) << o;
        }
        sum += bits;
    }
    return sum;
}

static BENCH_NOINLINE uint64_t run_resize(void *context)
{
    octant_input *input = (octant_input *)context;
    int i;
    for (i = 0; i < NODES; i++) {
        tribox_tri_resize(&input->tri[i % DESCENTS], input->size);
    }
    return NODES;
}

int main(int argc, char **argv)
{
    bench_options options;
    query_input *query = (query_input *)bench_alloc(sizeof *query);
    float *positions = (float *)bench_alloc(3 * sizeof(float) * (SIDE + 1) * (SIDE + 1));
    uint32_t *indices = (uint32_t *)bench_alloc(3 * sizeof(uint32_t) * TRIANGLES);
    ray_input *rays = (ray_input *)bench_alloc(sizeof *rays);
    wide_input *wide = (wide_input *)bench_alloc(sizeof *wide);
    octant_input *nodes = (octant_input *)bench_alloc(sizeof *nodes);
    bench_row rows[8];
    int count = 0;
    if (!bench_parse(argc, argv, &options)) {
        return 1;
    }
    bench_header("companions");

    make_sheet(query, positions, indices);
    printf("# %d triangles, %.2f %% of them touch the box\n", TRIANGLES,
           100.0 * (double)run_query(query) / TRIANGLES);
    bench_add(rows, &count, "loop of tribox_sat", BENCH_RIVAL, run_sat_loop);
    bench_add(rows, &count, "loop of tribox_overlap", BENCH_NOTE, run_overlap_loop);
    bench_add(rows, &count, "tribox_mesh_query", BENCH_OURS, run_query);
    bench_table(&options, "mesh query, a triangle", rows, count, 50, TRIANGLES, query);

    make_rays(rays);
    count = 0;
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_ray_loads);
    bench_add(rows, &count, "plain float slabs", BENCH_RIVAL, run_slab);
    bench_add(rows, &count, "tribox_ray_box", BENCH_OURS, run_ray_box);
    bench_table(&options, "ray and box", rows, count, 50, RAYS, rays);

    make_nodes(nodes);
    count = 0;
    bench_add(rows, &count, "eight times tribox_tri_test", BENCH_RIVAL, run_eight_tests);
    bench_add(rows, &count, "tribox_tri_octants", BENCH_OURS, run_octants);
    bench_add(rows, &count, "tribox_tri_resize", BENCH_NOTE, run_resize);
    bench_table(&options, "octree node", rows, count, 50, NODES, nodes);

    count = 0;
    bench_add(rows, &count, "tribox_box_box", BENCH_NOTE, run_box_box);
    bench_add(rows, &count, "tribox_plane_box", BENCH_NOTE, run_plane_box);
    bench_add(rows, &count, "tribox_segment_box", BENCH_NOTE, run_segment_box);
    bench_add(rows, &count, "tribox_ray_triangle", BENCH_NOTE, run_ray_triangle);
    bench_add(rows, &count, "tribox_closest", BENCH_NOTE, run_closest);
    bench_add(rows, &count, "tribox_sweep", BENCH_NOTE, run_sweep);
    bench_add(rows, &count, "tribox_clip", BENCH_NOTE, run_clip);
    bench_table(&options, "the others, timed for themselves", rows, count, 20, RAYS, rays);

    make_wide(wide, rays);
    count = 0;
    bench_add(rows, &count, "tribox_box_box_f64", BENCH_NOTE, run_box_box_f64);
    bench_add(rows, &count, "tribox_segment_box_f64", BENCH_NOTE, run_segment_box_f64);
    bench_add(rows, &count, "tribox_ray_box_f64", BENCH_NOTE, run_ray_box_f64);
    bench_add(rows, &count, "tribox_ray_box_f64, no outputs", BENCH_NOTE, run_ray_meets_f64);
    bench_add(rows, &count, "tribox_ray_triangle_f64", BENCH_NOTE, run_ray_triangle_f64);
    bench_add(rows, &count, "tribox_clip_f64", BENCH_NOTE, run_clip_f64);
    bench_add(rows, &count, "tribox_closest_f64", BENCH_NOTE, run_closest_f64);
    bench_table(&options, "in doubles, timed for themselves", rows, count, 20, RAYS, wide);

    free(query);
    free(positions);
    free(indices);
    free(rays);
    free(wide);
    free(nodes);
    return 0;
}
