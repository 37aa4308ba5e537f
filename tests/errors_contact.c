/* How far are the values of contact's filters from the exact ones, as a part of their bounds? As errors.c does: hill
 * climbing from random questions against rationals (GMP), in every rounding mode, and with subnormals flushed. What
 * tests/proofs/contact.gappa proves from above, this looks at from below: it fails where a value is beyond its bound, and
 * prints the worst that it found. Where a filter tells a verdict only, the part is how far, in units of the bound, a sure
 * verdict reaches over the border: 1 where it is wrong. The header is a copy that keeps its bounds defined.
 *
 *   build/errors_contact [hundreds of questions for each line] [seed] */
#include "tribox_errors.h"

#include <fenv.h>
#include <gmp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BALL, PLANE, TOUCH_POINT, TOUCH_ALONG, LINE_D, LINE_ENDS, SHOT, SEGMENT, GAP_SIZE, GAP_WHOLE, BALL4, BOX4, PLANE4, LINE4, KINDS };
static const char *const names[KINDS] = {
    "sphere, squares",       "plane's value",         "triangle's point",     "triangle along a way",
    "ray, D",                "ray, roots",            "ray, triangle's edge", "segment, times",
    "gap, one axis",         "gap, axes in float",    "sphere in float",      "box in float",
    "plane in float",        "ray in float"};

enum { NUMBERS = 20 };

static uint64_t random_state = 1;

static uint64_t random_bits(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return random_state * 0x2545f4914f6cdd1du;
}

static int random_below(int n)
{
    return (int)((random_bits() >> 33) % (uint64_t)n);
}

static double random_signed(void)
{
    return (double)(int64_t)random_bits() / 9223372036854775808.0;
}

static mpq_t q[16], v[6][3];

static void exact_init(void)
{
    int i;
    for (i = 0; i < 16; i++) {
        mpq_init(q[i]);
    }
    for (i = 0; i < 18; i++) {
        mpq_init(v[i / 3][i % 3]);
    }
}

static void subtract(mpq_t out, double a, double b)
{
    mpq_set_d(out, a);
    mpq_set_d(q[15], b);
    mpq_sub(out, out, q[15]);
}

static void difference(mpq_t out[3], const float a[3], const float b[3])
{
    int k;
    for (k = 0; k < 3; k++) {
        subtract(out[k], (double)a[k], (double)b[k]);
    }
}

static void dot(mpq_t out, mpq_t a[3], mpq_t b[3])
{
    int k;
    mpq_set_ui(q[14], 0, 1);
    for (k = 0; k < 3; k++) {
        mpq_mul(q[15], a[k], b[k]);
        mpq_add(q[14], q[14], q[15]);
    }
    mpq_set(out, q[14]);
}

/* |computed - exact| as a part of the bound; exact is lost */
static double part_of(double computed, mpq_t exact, double bound)
{
    mpq_set_d(q[15], computed);
    mpq_sub(exact, exact, q[15]);
    return bound > 0.0 ? fabs(mpq_get_d(exact)) / bound : mpq_sgn(exact) != 0 ? 2.0 : 0.0;
}

static unsigned mode_flush;
static int mode_rounding;

static void enter(void)
{
    fesetround(mode_rounding);
#if defined(__SSE2__)
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | mode_flush);
#endif
}

static void leave(void)
{
#if defined(__SSE2__)
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() & ~0x8040u);
#endif
    fesetround(FE_TONEAREST);
}

/* ---- the header's values ---------------------------------------------------------------------- */

typedef struct answer {
    double value[4];
    double bound[4];
    int verdict;
    double s[2];
    float axis[2][3];
    tbx_segment segment;
    tbx_touched touched;
    tbx_parabola line;
} answer;

__attribute__((noinline)) static void compute(answer *r, int kind, const float x[NUMBERS])
{
    const float *const corners[5] = {x, x + 3, x + 6, x, x + 3};
    const float radius = x[15];
    enter();
    if (kind == BALL) {
        double a[3], b[3];
        tbx_take3_float(a, x);
        tbx_take3_float(b, x + 3);
        tbx_minus3(a, a, b);
        r->value[0] = tbx_dot3(a, a);
        r->bound[0] = r->value[0] * TBX_BALL_ERROR;
    } else if (kind == PLANE) {
        double a[3], b[3], terms[3];
        int k;
        tbx_take3_float(a, x);
        tbx_take3_float(b, x + 3);
        for (k = 0; k < 3; k++) {
            terms[k] = a[k] * b[k];
        }
        r->value[0] = ((double)x[6] + terms[0]) + terms[1] + terms[2];
        r->bound[0] = (fabs((double)x[6]) + tbx_size3(terms)) * TBX_PLANE_SPHERE_ERROR;
    } else if (kind == TOUCH_POINT || kind == TOUCH_ALONG) {
        tbx_touch_set(&r->touched, x + 9, corners);
    } else if (kind == LINE_D || kind == LINE_ENDS) {
        tbx_parabola_set(&r->line, x, x + 3, x + 6, (double)radius);
        if (kind == LINE_ENDS && r->line.d > 1024.0 * r->line.d_error && r->line.a > 0.0) {
            r->bound[0] = tbx_parabola_roots(&r->line, r->value);
        }
    } else if (kind == SHOT) {
        double a[3], b[3], d[3], o[3];
        tbx_take3_float(a, x);
        tbx_take3_float(b, x + 3);
        tbx_take3_float(o, x + 6);
        tbx_take3_float(d, x + 9);
        tbx_minus3(a, a, o);
        tbx_minus3(b, b, o);
        r->value[0] = tbx_shot_det(d, a, b, &r->bound[0]);
    } else if (kind == GAP_SIZE || kind == GAP_WHOLE) {
#if TRIBOX_SIMD
        tbx_gap_roots roots;
        const unsigned mask = tbx_gap_filter(x, x + 3, x + 6, x + 9, x + 12, &roots);
        r->verdict = mask != 0 && (mask & (mask - 1u)) == 0 &&
                     tbx_gap_near(corners, x + 9, x + 12, mask, &roots, &r->s[0], r->axis[0]);
        if (r->verdict) {
            tbx_gap_answer(corners, x + 9, x + 12, kind == GAP_WHOLE ? 0x1fffu : tbx_gap_axes(mask), &r->s[1], r->axis[1]);
        }
#endif
    } else {
#if TRIBOX_SIMD
        r->verdict = kind == BALL4   ? tbx_sphere_sphere4(x, &radius, x + 3, &x[16])
                     : kind == BOX4  ? tbx_sphere_box4(x, &radius, x + 3, x + 6)
                     : kind == LINE4 ? tbx_pierce4(x, x + 3, &x[17], x + 6, &radius)
                                     : tbx_plane_sphere4(x, &x[6], x + 3, &radius);
#endif
    }
    leave();
}

/* A segment is made of doubles: four axes' numbers beside each other. */
__attribute__((noinline)) static void compute_segment(answer *r, const double x[4])
{
    static tribox_grid grid;
    grid.origin[0] = x[0];
    grid.size[0] = x[1];
    r->segment.grid = &grid;
    r->segment.p[0] = x[2];
    r->segment.q[0] = x[3];
    r->segment.way[0] = x[3] > x[2] ? 1 : -1;
    r->segment.error = 0.0;
    enter();
    tbx_segment_times(&r->segment, 0);
    leave();
}

/* ---- their parts ------------------------------------------------------------------------------ */

/* The centre's distance to T, squared, in q[0]: the least of corners, edges, and the plane where the foot is in T. */
static void exact_distance(const float x[NUMBERS])
{
    int i, set = 0;
    for (i = 0; i < 3; i++) {
        difference(v[0], x + 9, x + 3 * i);
        difference(v[1], x + 3 * ((i + 1) % 3), x + 3 * i);
        dot(q[1], v[0], v[0]);
        dot(q[2], v[0], v[1]);
        dot(q[3], v[1], v[1]);
        if (mpq_sgn(q[2]) > 0 && mpq_cmp(q[2], q[3]) <= 0) {
            mpq_mul(q[4], q[2], q[2]);
            mpq_div(q[4], q[4], q[3]);
            mpq_sub(q[1], q[1], q[4]);
        }
        if (!set || mpq_cmp(q[1], q[0]) < 0) {
            mpq_set(q[0], q[1]);
            set = 1;
        }
    }
    difference(v[0], x + 3, x);
    difference(v[1], x + 6, x);
    difference(v[2], x + 9, x);
    dot(q[1], v[0], v[0]);
    dot(q[2], v[0], v[1]);
    dot(q[3], v[1], v[1]);
    dot(q[4], v[0], v[2]);
    dot(q[5], v[1], v[2]);
    dot(q[6], v[2], v[2]);
    mpq_mul(q[7], q[1], q[3]);
    mpq_mul(q[8], q[2], q[2]);
    mpq_sub(q[7], q[7], q[8]);
    if (mpq_sgn(q[7]) > 0) {
        mpq_mul(q[8], q[3], q[4]);
        mpq_mul(q[9], q[2], q[5]);
        mpq_sub(q[8], q[8], q[9]);
        mpq_mul(q[9], q[1], q[5]);
        mpq_mul(q[10], q[2], q[4]);
        mpq_sub(q[9], q[9], q[10]);
        mpq_add(q[10], q[8], q[9]);
        if (mpq_sgn(q[8]) >= 0 && mpq_sgn(q[9]) >= 0 && mpq_cmp(q[10], q[7]) <= 0) {
            mpq_mul(q[8], q[8], q[4]);
            mpq_mul(q[9], q[9], q[5]);
            mpq_add(q[8], q[8], q[9]);
            mpq_div(q[8], q[8], q[7]);
            mpq_sub(q[0], q[6], q[8]);
        }
    }
}

/* sqrt of a rational, to 300 bits */
static void exact_root(mpq_t x)
{
    mpz_t z;
    mpz_init(z);
    mpq_mul_2exp(x, x, 1600);
    mpz_tdiv_q(z, mpq_numref(x), mpq_denref(x));
    mpz_sqrt(z, z);
    mpq_set_z(x, z);
    mpq_div_2exp(x, x, 800);
    mpz_clear(z);
}

static double touch_part(const answer *r, const float x[NUMBERS], int along)
{
    const double root = sqrt(r->touched.square);
    exact_distance(x);
    exact_root(q[0]);
    if (!along) { /* |g| >= distance - error */
        mpq_set_d(q[1], r->touched.square);
        exact_root(q[1]);
        mpq_sub(q[0], q[0], q[1]);
        return mpq_get_d(q[0]) / r->touched.error;
    }
    mpq_set_d(q[1], root); /* least <= |g| distance + error size */
    mpq_mul(q[0], q[0], q[1]);
    mpq_set_d(q[1], r->touched.least);
    mpq_sub(q[1], q[1], q[0]);
    return r->touched.size > 0.0 ? mpq_get_d(q[1]) / (r->touched.error * r->touched.size) : 0.0;
}

/* d . (a x b) */
static double shot_part(const answer *r, const float x[NUMBERS])
{
    int k;
    difference(v[0], x, x + 6);
    difference(v[1], x + 3, x + 6);
    mpq_set_ui(q[0], 0, 1);
    for (k = 0; k < 3; k++) {
        mpq_mul(q[1], v[0][(k + 1) % 3], v[1][(k + 2) % 3]);
        mpq_mul(q[2], v[0][(k + 2) % 3], v[1][(k + 1) % 3]);
        mpq_sub(q[1], q[1], q[2]);
        mpq_set_d(q[2], (double)x[9 + k]);
        mpq_mul(q[1], q[1], q[2]);
        mpq_add(q[0], q[0], q[1]);
    }
    return part_of(r->value[0], q[0], r->bound[0]);
}

/* A in q[0], B in q[1], C in q[2], D in q[3], r^2 in q[6] */
static void exact_line(const float x[NUMBERS])
{
    int k;
    difference(v[0], x, x + 6);
    for (k = 0; k < 3; k++) {
        mpq_set_d(v[1][k], (double)x[3 + k]);
    }
    dot(q[0], v[1], v[1]);
    dot(q[1], v[1], v[0]);
    dot(q[2], v[0], v[0]);
    mpq_set_d(q[6], (double)x[15]);
    mpq_mul(q[6], q[6], q[6]);
    mpq_sub(q[2], q[2], q[6]);
    mpq_mul(q[3], q[1], q[1]);
    mpq_mul(q[4], q[0], q[2]);
    mpq_sub(q[3], q[3], q[4]);
}

static double line_part(const answer *r, const float x[NUMBERS], int ends)
{
    double worst = 0.0;
    int e;
    exact_line(x);
    if (!ends) {
        const double b = part_of(r->line.b, q[1], r->line.b_size * TBX_PIERCE_ERROR);
        const double d = part_of(r->line.d, q[3], r->line.d_error);
        return b > d ? b : d;
    }
    if (!(r->bound[0] > 0.0)) {
        return 0.0;
    }
    if (mpq_sgn(q[3]) <= 0) {
        return 2.0;
    }
    exact_root(q[3]);
    for (e = 0; e < 2; e++) {
        double part;
        mpq_set(q[5], q[3]);
        if (e == 0) {
            mpq_neg(q[5], q[5]);
        }
        mpq_sub(q[5], q[5], q[1]);
        mpq_div(q[5], q[5], q[0]);
        part = part_of(r->value[e], q[5], r->bound[0]);
        worst = part > worst ? part : worst;
    }
    return worst;
}

static double segment_part(const answer *r, const double x[4], int64_t i)
{
    const double t = r->segment.from[0] + (double)i * r->segment.step[0];
    if (!(r->segment.error < 4.0)) {
        return 0.0;
    }
    mpq_set_d(q[0], x[0]);
    mpq_set_d(q[1], x[1]);
    mpq_set_d(q[2], (double)(i + (r->segment.way[0] > 0)));
    mpq_mul(q[1], q[1], q[2]);
    mpq_add(q[0], q[0], q[1]);
    mpq_set_d(q[1], x[2]);
    mpq_sub(q[0], q[0], q[1]);
    subtract(q[2], x[3], x[2]);
    mpq_div(q[0], q[0], q[2]);
    return part_of(t, q[0], r->segment.error * (1.0 + fabs(t)));
}

/* s to 2^-40 of itself, axes to 2^-22; the other one is of the run with bounds, which ends in integers. */
static double gap_part(const answer *r)
{
    double worst;
    int k;
    if (!r->verdict) {
        return 0.0;
    }
    worst = fabs(r->s[0] - r->s[1]) / (fabs(r->s[1]) * ldexp(1.0, -40));
    for (k = 0; k < 3; k++) {
        const double part = fabs((double)r->axis[0][k] - (double)r->axis[1][k]) * ldexp(1.0, 21);
        worst = part > worst ? part : worst;
    }
    return worst;
}

#if TRIBOX_SIMD
/* How far over the border, which q[0] - q[1] crosses, a sure verdict reaches: its distance from there, in units of the
 * bound, off 1. */
static double verdict_part(int hit, double bound)
{
    const int order = mpq_cmp(q[0], q[1]);
    double away;
    if (order == 0 || (order < 0) != (hit != 0)) {
        return order == 0 && hit ? 1.0 : 2.0;
    }
    mpq_sub(q[2], q[0], q[1]);
    mpq_add(q[3], q[0], q[1]);
    away = mpq_sgn(q[3]) != 0 ? fabs(mpq_get_d(q[2]) / mpq_get_d(q[3])) / bound : 1.0;
    return away < 1.0 ? 1.0 - away : 0.0;
}

static double plane_terms(const float x[NUMBERS])
{
    return fabs((double)x[0] * (double)x[3]) + fabs((double)x[1] * (double)x[4]) + fabs((double)x[2] * (double)x[5]) +
           fabs((double)x[6]);
}

/* A ray that misses: D < 0, how far as a part of A c times the bound, off 1; or it leads away from outside. */
static double miss_part(const answer *r, const float x[NUMBERS])
{
    double part;
    if (r->verdict != TBX_MISS) {
        return 0.0;
    }
    exact_line(x);
    if (x[17] >= 0.0f && mpq_sgn(q[2]) > 0 && mpq_sgn(q[1]) > 0) {
        return 0.0;
    }
    if (mpq_sgn(q[3]) >= 0) {
        return 2.0;
    }
    mpq_add(q[6], q[6], q[6]);
    mpq_add(q[2], q[2], q[6]);
    mpq_mul(q[2], q[2], q[0]);
    part = 1.0 + mpq_get_d(q[3]) / (mpq_get_d(q[2]) * (double)TBX_PIERCE_ERROR4);
    return part > 0.0 ? part : 0.0;
}

static double ball_part(const answer *r, int kind, const float x[NUMBERS])
{
    int k;
    if (r->verdict == TBX_UNSURE) {
        return 0.0;
    }
    if (kind == PLANE4) {
        for (k = 0; k < 3; k++) {
            mpq_set_d(v[0][k], (double)x[k]);
            mpq_set_d(v[1][k], (double)x[3 + k]);
        }
        dot(q[0], v[0], v[1]);
        dot(q[1], v[0], v[0]);
        mpq_set_d(q[2], (double)x[6]);
        mpq_add(q[0], q[0], q[2]);
        if (r->verdict != 0 && mpq_sgn(q[0]) != r->verdict) {
            return 2.0;
        }
        mpq_set(q[3], q[0]);
        mpq_mul(q[0], q[0], q[0]);
        mpq_set_d(q[2], (double)x[15]);
        mpq_mul(q[2], q[2], q[2]);
        mpq_mul(q[1], q[1], q[2]);
        {
            const double size = fabs(mpq_get_d(q[3]));
            const double error = (double)TBX_PLANE_SPHERE_ERROR4 * plane_terms(x);
            const double band = (2.0 * size + error) * error;
            return verdict_part(r->verdict == 0, band / (mpq_get_d(q[0]) + mpq_get_d(q[1])));
        }
    }
    for (k = 0; k < 3; k++) {
        const float *lo = x + 3, *hi = kind == BOX4 ? x + 6 : lo;
        if (lo[k] > hi[k]) {
            return r->verdict ? 2.0 : 0.0;
        }
        subtract(v[0][k], (double)x[k], (double)(x[k] < lo[k] ? lo[k] : x[k] > hi[k] ? hi[k] : x[k]));
    }
    dot(q[0], v[0], v[0]);
    mpq_set_d(q[1], (double)x[15]);
    mpq_set_d(q[2], kind == BOX4 ? 0.0 : (double)x[16]);
    mpq_add(q[1], q[1], q[2]);
    mpq_mul(q[1], q[1], q[1]);
    return verdict_part(r->verdict != 0, (double)TBX_BALL_ERROR4);
}

#endif

static double ask(int kind, const float x[NUMBERS])
{
    answer r;
    memset(&r, 0, sizeof r);
    if (kind == SEGMENT) { /* doubles, of two floats each */
        double y[4];
        int k;
        for (k = 0; k < 4; k++) {
            y[k] = (double)x[2 * k] + (double)x[2 * k + 1] * 1e-9;
        }
        y[1] = fabs(y[1]) + 1e-30;
        if (!(y[2] < y[3] || y[3] < y[2])) {
            return 0.0;
        }
        compute_segment(&r, y);
        return segment_part(&r, y, (int64_t)((double)x[8] * 1000.0));
    }
    compute(&r, kind, x);
    if (kind == BALL) {
        difference(v[0], x, x + 3);
        dot(q[0], v[0], v[0]);
        return part_of(r.value[0], q[0], r.bound[0]);
    }
    if (kind == PLANE) {
        int k;
        for (k = 0; k < 3; k++) {
            mpq_set_d(v[0][k], (double)x[k]);
            mpq_set_d(v[1][k], (double)x[3 + k]);
        }
        dot(q[0], v[0], v[1]);
        mpq_set_d(q[1], (double)x[6]);
        mpq_add(q[0], q[0], q[1]);
        return part_of(r.value[0], q[0], r.bound[0]);
    }
    return kind == SHOT ? shot_part(&r, x)
           : kind == TOUCH_POINT || kind == TOUCH_ALONG ? touch_part(&r, x, kind == TOUCH_ALONG)
           : kind == LINE_D || kind == LINE_ENDS      ? line_part(&r, x, kind == LINE_ENDS)
           : kind == GAP_SIZE || kind == GAP_WHOLE    ? gap_part(&r)
#if TRIBOX_SIMD
           : kind == LINE4 ? miss_part(&r, x)
           : kind >= BALL4 ? ball_part(&r, kind, x)
#endif
                           : 0.0;
}

/* ---- the search ------------------------------------------------------------------------------- */

/* Numbers of one size or of several; triangles thin or level; spheres that just touch. */
static void any_question(float x[NUMBERS], int kind)
{
    const int how = random_below(6);
    const double scale = how == 0 ? ldexp(1.0, random_below(40) - 20) : 1.0;
    int k;
    for (k = 0; k < NUMBERS; k++) {
        x[k] = (float)(random_signed() * scale * (how == 1 ? ldexp(1.0, -random_below(24)) : 1.0));
    }
    if (how == 2 || how == 3) { /* a sliver, perhaps nearly level */
        const double width = ldexp(1.0, -random_below(20));
        const double t = fabs(random_signed());
        const int a = random_below(3);
        x[3 + a] = how == 3 ? x[a] + (float)(random_signed() * ldexp(1.0, -random_below(24))) : x[3 + a];
        for (k = 0; k < 3; k++) {
            x[6 + k] = (float)((double)x[k] + t * ((double)x[3 + k] - (double)x[k]) + width * random_signed());
        }
    }
    x[15] = fabsf(x[15]);
    x[16] = fabsf(x[16]);
    if (kind == GAP_SIZE || kind == GAP_WHOLE || kind == BOX4) { /* low corner first */
        const int lo = kind == BOX4 ? 3 : 9;
        for (k = 0; k < 3; k++) {
            const float size = random_below(4) == 0 ? 0.0f : fabsf(x[lo + 3 + k]) * (random_below(2) ? 1.0f : 0.01f);
            x[lo + 3 + k] = x[lo + k] + size;
        }
    }
    if (kind == LINE4) { /* nearly grazing */
        double a = 0.0;
        double b = 0.0;
        double c = 0.0;
        for (k = 0; k < 3; k++) {
            const double m = (double)x[k] - (double)x[6 + k];
            a += (double)x[3 + k] * (double)x[3 + k];
            b += (double)x[3 + k] * m;
            c += m * m;
        }
        b = c - b * b / a;
        if (b > 0.0) { /* by as much as the filter asks for */
            x[15] = (float)(sqrt(b) * (1.0 - (c + b) / b * 1.9e-6 * (1.0 + 0.2 * random_signed())));
        }
    } else if (kind >= BALL4) { /* nearly touching */
        double d = 0.0;
        double nn = 0.0;
        for (k = 0; k < 3; k++) {
            const double c = (double)x[k];
            const double lo = (double)x[3 + k];
            const double hi = kind == BOX4 ? (double)x[6 + k] : lo;
            const double out = c < lo ? lo - c : c > hi ? c - hi : 0.0;
            d += kind == PLANE4 ? c * lo : out * out;
            nn += c * c;
        }
        d = kind == PLANE4 ? fabs(d + (double)x[6]) / sqrt(nn) : sqrt(d) - (kind == BOX4 ? 0.0 : (double)x[16]);
        if (d > 0.0) {
            x[15] = (float)(d * (1.0 + 4e-6 * random_signed()));
        }
    }
}

static void change(float x[NUMBERS])
{
    const int k = random_below(NUMBERS);
    if (random_below(2) == 0) {
        x[k] = nextafterf(x[k], random_below(2) == 0 ? FLT_MAX : -FLT_MAX);
    } else {
        x[k] = (float)((double)x[k] * (1.0 + random_signed() * ldexp(1.0, -random_below(24))));
    }
    x[15] = fabsf(x[15]);
    x[16] = fabsf(x[16]);
}

int main(int argc, char **argv)
{
    static const int modes[5] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST};
    static const char *const mode_names[5] = {"to nearest", "up", "down", "to zero", "nearest, flushed"};
    const long hundreds = argc > 1 ? atol(argv[1]) : 400;
    int failed = 0;
    int lines = 0;
    int kind, mode;
    random_state = (argc > 2 ? strtoull(argv[2], NULL, 10) : 1) * 0x9e3779b97f4a7c15u | 1u;
    exact_init();
    for (kind = 0; kind < KINDS; kind++) {
        for (mode = 0; mode < 5; mode++) {
            double worst = 0.0;
            long done;
            mode_rounding = modes[mode];
            mode_flush = mode == 4 ? 0x8040u : 0u;
#if !TRIBOX_SIMD
            if (kind >= GAP_SIZE) {
                continue;
            }
#endif
            for (done = 0; done < hundreds; done++) {
                float best[NUMBERS];
                double part = 0.0;
                int step;
                for (step = 0; step < 100; step++) {
                    float next[NUMBERS];
                    double at;
                    if (part > 0.0 && random_below(3) != 0) {
                        memcpy(next, best, sizeof next);
                        change(next);
                    } else {
                        any_question(next, kind);
                    }
                    at = ask(kind, next);
                    if (at > part) {
                        part = at;
                        memcpy(best, next, sizeof next);
                    }
                }
                if (part >= 1.0 && worst < 1.0) {
                    for (step = 0; step < NUMBERS; step++) {
                        printf("%a%s", (double)best[step], step == NUMBERS - 1 ? "\n" : ", ");
                    }
                }
                worst = part > worst ? part : worst;
            }
            printf("%-21s rounded %-16s worst error %.4f of the bound\n", names[kind], mode_names[mode], worst);
            lines++;
            failed += !(worst > 0.0 && worst < 1.0);
        }
    }
    printf("%d passed, %d failed\n", lines - failed, failed);
    return failed != 0;
}
