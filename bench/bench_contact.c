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

/* ---- spheres ------------------------------------------------------------------------------------------- */

enum { BALLS = 1 << 13 };

typedef struct ball {
    float c[3], radius, b[3], b_radius, n[3], d, lo[3], hi[3], v0[3], v1[3], v2[3], dir[3];
} ball;

static void make_balls(ball *balls)
{
    uint64_t seed = 17;
    int i;
    int k;
    for (i = 0; i < BALLS; i++) {
        ball *x = &balls[i];
        x->radius = bench_uniform(&seed, 0.1f, 1.0f);
        x->b_radius = bench_uniform(&seed, 0.1f, 1.0f);
        x->d = bench_uniform(&seed, -1.0f, 1.0f);
        for (k = 0; k < 3; k++) {
            const float centre = bench_uniform(&seed, -1.0f, 1.0f);
            const float half = bench_uniform(&seed, 0.05f, 0.5f);
            x->c[k] = bench_uniform(&seed, -1.0f, 1.0f);
            x->b[k] = bench_uniform(&seed, -1.0f, 1.0f);
            x->n[k] = bench_uniform(&seed, -1.0f, 1.0f);
            x->lo[k] = centre - half;
            x->hi[k] = centre + half;
            x->v0[k] = bench_uniform(&seed, -1.0f, 1.0f);
            x->v1[k] = bench_uniform(&seed, -1.0f, 1.0f);
            x->v2[k] = bench_uniform(&seed, -1.0f, 1.0f);
            x->dir[k] = bench_uniform(&seed, -1.0f, 1.0f) - x->b[k];
        }
    }
}

static inline float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void minus(float out[3], const float a[3], const float b[3])
{
    out[0] = a[0] - b[0];
    out[1] = a[1] - b[1];
    out[2] = a[2] - b[2];
}

/* Plain float, as engines write it; called, as ours are. */
static BENCH_NOINLINE int float_sphere_sphere(const float a[3], float ra, const float b[3], float rb)
{
    float d[3];
    minus(d, a, b);
    return dot(d, d) <= (ra + rb) * (ra + rb);
}

static BENCH_NOINLINE int float_plane_sphere(const float n[3], float d, const float c[3], float r)
{
    const float v = dot(n, c) + d;
    return v * v <= r * r * dot(n, n) ? 0 : v > 0.0f ? 1 : -1;
}

static BENCH_NOINLINE int float_sphere_box(const float c[3], float r, const float lo[3], const float hi[3])
{
    float sum = 0.0f;
    int k;
    for (k = 0; k < 3; k++) {
        const float x = c[k] < lo[k] ? lo[k] : c[k] > hi[k] ? hi[k] : c[k];
        sum += (c[k] - x) * (c[k] - x);
    }
    return sum <= r * r;
}

/* By the regions of the nearest point: corner, edge or face. */
static BENCH_NOINLINE int float_sphere_triangle(const float c[3], float r, const float v0[3], const float v1[3],
                                                const float v2[3])
{
    float a[3], b[3], p[3], x[3];
    float a0, b0, a1, b1, a2, b2, u, v, w, s, t;
    int k;
    minus(a, v1, v0);
    minus(b, v2, v0);
    minus(p, c, v0);
    a0 = dot(a, p);
    b0 = dot(b, p);
    if (a0 <= 0.0f && b0 <= 0.0f) {
        return dot(p, p) <= r * r;
    }
    minus(p, c, v1);
    a1 = dot(a, p);
    b1 = dot(b, p);
    if (a1 >= 0.0f && b1 <= a1) {
        return dot(p, p) <= r * r;
    }
    w = a0 * b1 - a1 * b0;
    minus(p, c, v2);
    a2 = dot(a, p);
    b2 = dot(b, p);
    if (b2 >= 0.0f && a2 <= b2) {
        return dot(p, p) <= r * r;
    }
    v = a2 * b0 - a0 * b2;
    u = a1 * b2 - a2 * b1;
    if (w <= 0.0f && a0 >= 0.0f && a1 <= 0.0f) {
        s = a0 / (a0 - a1);
        t = 0.0f;
    } else if (v <= 0.0f && b0 >= 0.0f && b2 <= 0.0f) {
        s = 0.0f;
        t = b0 / (b0 - b2);
    } else if (u <= 0.0f && b1 - a1 >= 0.0f && a2 - b2 >= 0.0f) {
        t = (b1 - a1) / ((b1 - a1) + (a2 - b2));
        s = 1.0f - t;
    } else {
        const float inverse = 1.0f / (u + v + w);
        s = v * inverse;
        t = w * inverse;
    }
    for (k = 0; k < 3; k++) {
        x[k] = c[k] - (v0[k] + s * a[k] + t * b[k]);
    }
    return dot(x, x) <= r * r;
}

static BENCH_NOINLINE int float_ray_sphere(const float o[3], const float dir[3], float t_min, float t_max,
                                           const float c[3], float r, float *t0, float *t1)
{
    float m[3];
    float a, b, d, root;
    minus(m, o, c);
    a = dot(dir, dir);
    b = dot(dir, m);
    d = b * b - a * (dot(m, m) - r * r);
    if (d < 0.0f) {
        return 0;
    }
    root = sqrtf(d);
    *t0 = (-b - root) / a;
    *t1 = (root - b) / a;
    *t0 = *t0 > t_min ? *t0 : t_min;
    *t1 = *t1 < t_max ? *t1 : t_max;
    return *t0 <= *t1;
}

#define BALL_LOOP(name, expression)                        \
    static BENCH_NOINLINE uint64_t name(void *context)     \
    {                                                      \
        const ball *x = (const ball *)context;             \
        const ball *end = x + BALLS;                       \
        uint64_t sum = 0;                                  \
        float t[2];                                        \
        (void)t;                                           \
        for (; x < end; x++) {                             \
            sum += (uint64_t)((expression) != 0);          \
        }                                                  \
        return sum;                                        \
    }

#define BALL x->c, x->radius
BALL_LOOP(run_float_sphere, float_sphere_sphere(BALL, x->b, x->b_radius))
BALL_LOOP(run_sphere, tribox_sphere_sphere(BALL, x->b, x->b_radius))
BALL_LOOP(run_float_plane, float_plane_sphere(x->n, x->d, BALL))
BALL_LOOP(run_plane, tribox_plane_sphere(x->n, x->d, BALL))
BALL_LOOP(run_float_box, float_sphere_box(BALL, x->lo, x->hi))
BALL_LOOP(run_box, tribox_sphere_box(BALL, x->lo, x->hi))
BALL_LOOP(run_float_triangle, float_sphere_triangle(BALL, x->v0, x->v1, x->v2))
BALL_LOOP(run_triangle, tribox_sphere_triangle(BALL, x->v0, x->v1, x->v2))
BALL_LOOP(run_float_ray, float_ray_sphere(x->b, x->dir, 0.0f, 1e9f, BALL, &t[0], &t[1]))
BALL_LOOP(run_ray, tribox_ray_sphere(x->b, x->dir, 0.0f, 1e9f, BALL, &t[0], &t[1]))

static void bench_balls(const bench_options *options, ball *balls)
{
    static const struct {
        const char *title;
        uint64_t (*rival)(void *);
        uint64_t (*ours)(void *);
    } table[5] = {{"sphere and sphere", run_float_sphere, run_sphere},
                  {"plane and sphere", run_float_plane, run_plane},
                  {"sphere and box", run_float_box, run_box},
                  {"sphere and triangle", run_float_triangle, run_triangle},
                  {"ray and sphere", run_float_ray, run_ray}};
    int i;
    for (i = 0; i < 5; i++) {
        bench_row rows[2];
        int count = 0;
        bench_add(rows, &count, "plain float", BENCH_RIVAL, table[i].rival);
        bench_add(rows, &count, "tribox", BENCH_OURS, table[i].ours);
        bench_table(options, table[i].title, rows, count, 50, BALLS, balls);
    }
}

int main(int argc, char **argv)
{
    bench_options options;
    pair *pairs = (pair *)bench_alloc(sizeof *pairs * PAIRS);
    segments *lines = (segments *)bench_alloc(sizeof *lines);
    ball *balls = (ball *)bench_alloc(sizeof *balls * BALLS);
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
    bench_table(&options, "segment through 512^3, a voxel", rows, count, 20, (double)lines->voxels, lines);
    free(lines);

    make_balls(balls);
    bench_balls(&options, balls);
    free(balls);
    return 0;
}
