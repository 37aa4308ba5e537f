/* The companions' answers and outputs, bit for bit, in every rounding mode and with subnormals read as
 * zero. */
#include "tribox.h"

#include "question.h"

#include <fenv.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

enum { MODE_CASES = 1500 };

typedef struct mode_case {
    float v[3][3];
    float lo[3];
    float hi[3];
    float u[3];
    float q[3];
    float r;
    double from[3];
    double to[3];
    tribox_grid grid;
} mode_case;

static mode_case  mode_cases[MODE_CASES];
static uint64_t   mode_answers[MODE_CASES];

/* Small integers, ordinary floats, a few bits with many ties, and every exponent, made before any mode is
 * changed. In some, one number alone is subnormal. */
static void make_cases(void)
{
    int i;
    int k;
    int j;

    random_seed(71);
    for (i = 0; i < MODE_CASES; i++) {
        mode_case *c = &mode_cases[i];
        int        kind = random_below(4);
        for (k = 0; k < 3; k++) {
            double unit = kind == 3 ? power_of_two(random_below(260) - 145) : 1;
            float  x[7];
            for (j = 0; j < 7; j++) {
                double value = kind == 0   ? random_below(9)
                               : kind == 1 ? random_below(33) / 32.0
                                           : random_signed();
                x[j] = (float)(value * unit);
            }
            c->v[0][k] = x[0];
            c->v[1][k] = x[1];
            c->v[2][k] = x[2];
            c->lo[k] = x[3] < x[4] ? x[3] : x[4];
            c->hi[k] = x[3] < x[4] ? x[4] : x[3];
            c->u[k] = x[5];
            c->q[k] = x[6];
        }
        if (random_below(4) == 0) {
            float *any[6];
            any[0] = c->v[0];
            any[1] = c->lo;
            any[2] = c->hi;
            any[3] = c->q;
            any[4] = c->v[2];
            any[5] = c->u;
            any[random_below(6)][random_below(3)] = random_below(2) ? 1e-45f : -1e-39f;
        }
        c->r = c->u[1] < 0 ? -c->u[1] : c->u[1];
        for (k = 0; k < 3; k++) {
            c->from[k] = (double)c->v[0][k];
            c->to[k] = (double)c->v[1][k];
            c->grid.origin[k] = (double)c->q[k];
            c->grid.size[k] = (double)c->hi[k] - (double)c->lo[k];
            c->grid.lo[k] = -4;
            c->grid.hi[k] = 4;
        }
    }
}

/* FNV-1a over the bits of what was written. */
static uint64_t mix(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *b = (const unsigned char *)bytes;

    while (size-- > 0) {
        hash = (hash ^ *b++) * 0x100000001B3u;
    }
    return hash;
}

/* The functions of contact: verdicts, times and voxels, and the sign of a gap. */
static uint64_t contact(const mode_case *c, uint64_t hash)
{
    static const unsigned rules[3] = {0, TRIBOX_HALF_OPEN, TRIBOX_OPEN};
    const float           r = c->r;
    tribox_grid           grid = c->grid;
    double                s;
    float                 out[8];
    int                   n[12];
    int                   k;

    memset(out, 0, sizeof out);
    memset(n, 0, sizeof n);
    n[0] = tribox_sweep_rule(c->v[0], c->v[1], c->v[2], c->lo, c->hi, c->u, TRIBOX_OPEN, out, out + 1, NULL);
    n[1] = tribox_sweep_box(c->lo, c->hi, c->v[0], c->v[0], c->u, TRIBOX_OPEN, out + 2, out + 3, NULL);
    n[2] = tribox_sphere_sphere(c->q, r, c->v[0], c->hi[0]);
    n[3] = tribox_plane_sphere(c->u, c->v[1][0], c->q, r);
    n[4] = tribox_sphere_box(c->q, r, c->lo, c->hi);
    n[5] = tribox_sphere_triangle(c->q, r, c->v[0], c->v[1], c->v[2]);
    n[6] = tribox_ray_sphere(c->v[0], c->u, 0, 4, c->q, c->hi[1], out + 4, out + 5);
    n[7] = tribox_ray_sphere(c->lo, c->u, -4, 4, c->v[2], r, out + 6, out + 7);
    s = tribox_gap(c->v[0], c->v[1], c->v[2], c->lo, c->hi, NULL);
    n[8] = (s > 0) - (s < 0);
    for (k = 0; k < 3; k++) {
        grid.flags = rules[k];
        n[9 + k] = (int)tribox_grid_segment(&grid, c->from, c->to, NULL, NULL);
    }
    hash = mix(hash, n, sizeof n);
    return mix(hash, out, sizeof out);
}

static uint64_t answer(const mode_case *c)
{
    float      out[30];
    float      polygon[9][3];
    int        n[12];
    tribox_tri tri;
    uint64_t   hash = 0xCBF29CE484222325u;

    memset(out, 0, sizeof out);
    memset(n, 0, sizeof n);
    n[0] = tribox_box_box(c->lo, c->hi, c->v[0], c->v[1]);
    n[1] = tribox_plane_box(c->u, c->q[0], c->lo, c->hi);
    n[2] = tribox_segment_box(c->v[0], c->q, c->lo, c->hi);
    n[3] = tribox_ray_box(c->q, c->u, 0, 4, c->lo, c->hi, out, out + 1);
    n[4] = tribox_ray_triangle(c->q, c->u, -4, 4, c->v[0], c->v[1], c->v[2], out + 2);
    n[5] = tribox_sweep(c->v[0], c->v[1], c->v[2], c->lo, c->hi, c->u, out + 3, out + 4, NULL);
    n[6] = tribox_clip(c->v[0], c->v[1], c->v[2], c->lo, c->hi, polygon);
    tribox_closest(c->v[0], c->v[1], c->v[2], c->q, out + 5);
    tribox_tri_init(&tri, c->v[0], c->v[1], c->v[2], c->hi, 0);
    tribox_tri_resize(&tri, c->q);
    n[7] = (int)tribox_tri_octants(&tri, c->lo);
    hash = contact(c, hash);
    hash = mix(hash, n, sizeof n);
    hash = mix(hash, out, sizeof out);
    return mix(hash, polygon, (size_t)n[6] * sizeof polygon[0]);
}

static int same_answers(void)
{
    int same = 0;
    int i;

    for (i = 0; i < MODE_CASES; i++) {
        same += answer(&mode_cases[i]) == mode_answers[i];
    }
    return same == MODE_CASES;
}

static void no_rounding_mode_changes_a_bit(void)
{
    static const int modes[3] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    int              k;

    for (k = 0; k < 3; k++) {
        int ok;
        fesetround(modes[k]);
        ok = same_answers();
        fesetround(FE_TONEAREST);
        CHECK(ok);
    }
}

/* The axis is compared too, to the promised 2^-22. */
static void the_axis_keeps_its_bound(void)
{
    static const int modes[4] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    float            axis[4][3];
    int              i;
    int              k;
    int              a;

    for (i = 0; i < MODE_CASES; i++) {
        const mode_case *c = &mode_cases[i];
        int              hit = 0;
        for (k = 0; k < 4; k++) {
            fesetround(modes[k]);
            hit = tribox_sweep(c->v[0], c->v[1], c->v[2], c->lo, c->hi, c->u, NULL, NULL, axis[k]);
        }
        fesetround(FE_TONEAREST);
        for (k = 1; k < 4 && hit; k++) {
            for (a = 0; a < 3; a++) {
                double apart = (double)axis[k][a] - (double)axis[0][a];
                CHECK(apart < 1.0 / 4194304.0 && apart > -1.0 / 4194304.0);
            }
        }
    }
}

static void subnormals_read_as_zero_change_no_bit(void)
{
#if defined(__SSE2__)
    unsigned before = _mm_getcsr();
    int      ok;

    _mm_setcsr(before | 0x8040u);       /* flush to zero, denormals are zero */
    ok = same_answers();
    _mm_setcsr(before);
    CHECK(ok);
#endif
}

/* A box whose lower face lies above the upper one by a subnormal has no points, also where both are read as
 * zero. */
static void boxes_that_are_empty_by_a_subnormal(void)
{
#if defined(__SSE2__)
    static const float centre[3] = {0.25f, 0.5f, -0.5f};
    unsigned           before = _mm_getcsr();
    int                k;

    for (k = 0; k < 3; k++) {
        float lo[3] = {-1, -1, -1};
        float hi[3] = {1, 1, 1};
        int   found[2];
        lo[k] = 3e-45f;
        hi[k] = 1e-45f;
        _mm_setcsr(before | 0x8040u);
        found[0] = tribox_sphere_box(centre, 8, lo, hi);
        lo[k] = 1e-45f;
        found[1] = tribox_sphere_box(centre, 8, lo, hi);
        _mm_setcsr(before);
        CHECK(found[0] == 0);
        CHECK(found[1] == 1);
    }
#endif
}

/* The origin lies outside of a sphere by 2^-60 of its radius, which double rounds off: the ray enters after 0, at a
 * time that rounding must not move before it, and the float below it is not 0. */
static void rays_from_just_outside(void)
{
    static const int modes[4] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    const float      centre[3] = {0, 0, 0};
    int              i;
    int              k;

    random_seed(73);
    for (i = 0; i < 200; i++) {
        const float origin[3] = {(float)(1 + random_below(1000)), 1e-9f, 0};
        float       dir[3];
        float       t[2] = {-1, -1};
        dir[0] = (float)-(1 + random_below(1000));
        dir[1] = 0;
        dir[2] = (float)random_below(10);
        for (k = 0; k < 4; k++) {
            int hit;
            fesetround(modes[k]);
            hit = tribox_ray_sphere(origin, dir, 0, 4, centre, origin[0], &t[0], &t[1]);
            fesetround(FE_TONEAREST);
            CHECK(hit == 1);
            CHECK(t[0] > 0 && t[0] < 1e-17f);
        }
    }
}

int main(void)
{
    int i;

    make_cases();
    for (i = 0; i < MODE_CASES; i++) {
        mode_answers[i] = answer(&mode_cases[i]);
    }
    RUN(no_rounding_mode_changes_a_bit);
    RUN(the_axis_keeps_its_bound);
    RUN(subnormals_read_as_zero_change_no_bit);
    RUN(boxes_that_are_empty_by_a_subnormal);
    RUN(rays_from_just_outside);
    return test_report("test_companions_mode");
}
