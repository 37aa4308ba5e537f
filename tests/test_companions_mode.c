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
            float *any[4];
            any[0] = c->v[0];
            any[1] = c->lo;
            any[2] = c->hi;
            any[3] = c->q;
            any[random_below(4)][random_below(3)] = random_below(2) ? 1e-45f : -1e-39f;
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
    return test_report("test_companions_mode");
}
