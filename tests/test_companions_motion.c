/* Boxes, planes, segments, rays and sweeps, against truth by other methods: all corners tried, fractions
 * of integers of any length, the thirteen intervals from all corners, and static overlap (oracle.h) at
 * every moment of an event. */
#include "tribox.h"

#include "question.h"

#include <float.h>

static float infinity(void)
{
    return nudge_float(FLT_MAX, 1);
}

/* Orders as floats do, by their bits: also where subnormals are read as zero. */
static int32_t float_order(float x)
{
    int32_t bits;

    memcpy(&bits, &x, sizeof bits);
    return bits < 0 ? -(bits & 0x7fffffff) : bits;
}

/* x as a double, also where the conversion would read a subnormal as zero. */
static double exact(float x)
{
    uint32_t bits;

    memcpy(&bits, &x, sizeof bits);
    if ((bits & 0x7f800000u) != 0) {
        return (double)x;
    }
    return (double)(bits & 0x7fffffu) * (bits >> 31 ? -1.0 : 1.0) * power_of_two(-149);
}

static float not_a_number(void)
{
    return nudge_float(FLT_MAX, 2);
}

/* ---- boxes --------------------------------------------------------------------------------------------- */

/* Every pair of lattice intervals on one axis, the others overlapping: they share a point unless one ends
 * before. */
static void boxes_meet_unless_an_axis_parts_them(void)
{
    int i;
    int a;

    for (i = 0; i < 4 * 4 * 4 * 4; i++) {
        for (a = 0; a < 3; a++) {
            float a_min[3] = {0, 0, 0};
            float a_max[3] = {1, 1, 1};
            float b_min[3] = {1, 1, 1};
            float b_max[3] = {2, 2, 2};
            int   truth = i % 4 <= i / 4 % 4 && i / 16 % 4 <= i / 64 && i % 4 <= i / 64 &&
                          i / 16 % 4 <= i / 4 % 4;
            a_min[a] = (float)(i % 4);
            a_max[a] = (float)(i / 4 % 4);
            b_min[a] = (float)(i / 16 % 4);
            b_max[a] = (float)(i / 64);
            CHECK(tribox_box_box(a_min, a_max, b_min, b_max) == truth);
        }
    }
}

/* One ulp decides, at every scale and sign; infinite faces hold no point at infinity; NaN is no box. */
static void boxes_at_the_ends_of_the_number_line(void)
{
    static const float values[] = {0.0f, -0.0f, 1.0f, -1.0f, FLT_MIN, -FLT_MIN, 1e-45f, -1e-45f, FLT_MAX,
                                   -3e38f};
    float              a_min[3] = {-5, -5, -5};
    float              a_max[3] = {5, 5, 5};
    float              b_min[3] = {-5, -5, -5};
    float              b_max[3] = {5, 5, 5};
    size_t             i;
    int                a;

    for (i = 0; i < sizeof values / sizeof *values; i++) {
        for (a = 0; a < 3; a++) {
            a_min[a] = -infinity();
            a_max[a] = b_min[a] = values[i];
            b_max[a] = infinity();
            CHECK(tribox_box_box(a_min, a_max, b_min, b_max) == 1);
            CHECK(tribox_box_box(b_min, b_max, a_min, a_max) == 1);
            a_max[a] = nudge_float(values[i], float_order(values[i]) != 0 ? -1 : -2);
            CHECK(tribox_box_box(a_min, a_max, b_min, b_max) == 0);
            b_min[a] = infinity();
            CHECK(tribox_box_box(b_min, b_max, b_min, b_max) == 0);
            b_min[a] = not_a_number();
            CHECK(tribox_box_box(a_min, a_max, b_min, b_max) == 0);
            CHECK(tribox_box_box(b_min, b_max, a_min, a_max) == 0);
            b_max[a] = b_min[a]; /* both faces one NaN, and one of the other sign */
            CHECK(tribox_box_box(b_min, b_max, b_min, b_max) == 0);
            b_max[a] = b_min[a] = -b_min[a];
            CHECK(tribox_box_box(b_min, b_max, b_min, b_max) == 0);
            a_min[a] = b_min[a] = -5;
            a_max[a] = b_max[a] = 5;
        }
    }
}

/* ---- random inputs ------------------------------------------------------------------------------------- */

/* A float of one of four kinds: small integer, few bits, all bits, any exponent. */
static float any_float(int kind)
{
    float x;

    if (kind == 0) {
        x = (float)(random_below(9) - 4);
    } else if (kind == 1) {
        x = (float)(random_below(257) - 128) / 32.0f;
    } else {
        x = (float)random_signed();
        if (kind == 3) {
            x = (float)((double)x * power_of_two(random_below(270) - 145));
        }
    }
    return x;
}

static void any_vector(float x[3], int kind)
{
    int a;

    for (a = 0; a < 3; a++) {
        x[a] = any_float(kind);
    }
}

static void any_box(float lo[3], float hi[3], int kind)
{
    int a;

    for (a = 0; a < 3; a++) {
        float x = any_float(kind);
        float y = random_below(8) == 0 ? x : any_float(kind);
        lo[a] = float_order(x) < float_order(y) ? x : y;
        hi[a] = float_order(x) < float_order(y) ? y : x;
    }
}

/* A power of two, or 19 bits times one: the lattice stays exact, but its products no longer fit a double. */
static float any_scale(void)
{
    double bits = random_below(2) ? 1 : 262145 + 2 * random_below(131071);

    return (float)(bits * power_of_two(random_below(200) - 110));
}

static void print_vector(const char *name, const float x[3])
{
    printf("  %s {%a, %a, %a}\n", name, (double)x[0], (double)x[1], (double)x[2]);
}

/* ---- fractions of wide integers ------------------------------------------------------------------------ */

/* n / d, d > 0; d = 0: infinite with the sign of n */
typedef struct ratio {
    wide n;
    wide d;
} ratio;

/* The sign of a - b. */
static int ratio_compare(const ratio *a, const ratio *b)
{
    static wide x;
    static wide y;

    wide_multiply(&x, &a->n, &b->d);
    wide_multiply(&y, &b->n, &a->d);
    return wide_compare(&x, &y);
}

static void ratio_set(ratio *r, double x)
{
    oracle_number number = oracle_read(&x);

    if (number.is_infinite) {
        wide_set(&r->n, number.sign, 1, 0);
        wide_set(&r->d, 1, 0, 0);
    } else {
        wide_set(&r->n, number.sign, number.mantissa,
                 number.sign && number.exponent > 0 ? number.exponent : 0);
        wide_set(&r->d, 1, 1, number.sign && number.exponent < 0 ? -number.exponent : 0);
    }
}

static float next_float(float f)
{
    return float_order(f) != 0 ? nudge_float(f, 1) : nudge_float(0.0f, 1);
}

/* Is f the greatest float <= x? */
static int is_floor(float f, const ratio *x)
{
    static ratio y;
    int          ok;

    ratio_set(&y, exact(f));
    ok = ratio_compare(&y, x) <= 0;
    if (float_order(f) < float_order(infinity())) {
        ratio_set(&y, exact(next_float(f)));
        ok &= ratio_compare(&y, x) > 0 || (x->d.sign == 0 && x->n.sign > 0 &&
                                           float_order(f) > float_order(FLT_MAX));
    }
    return ok;
}

static int is_ceiling(float f, const ratio *x)
{
    static ratio y;

    wide_copy(&y.n, &x->n);
    wide_copy(&y.d, &x->d);
    y.n.sign = -y.n.sign;
    return is_floor(-f, &y);
}

/* ---- plane and box ------------------------------------------------------------------------------------- */

/* By all eight corners. */
static int plane_truth(const float n[3], float d, const float lo[3], const float hi[3])
{
    int above = 0;
    int below = 0;
    int i;
    int a;

    for (i = 0; i < 8; i++) {
        static wide sum;
        static wide x;
        static wide y;
        static wide xy;
        oracle_integer(&sum, exact(d), -300);
        for (a = 0; a < 3; a++) {
            oracle_integer(&x, exact(n[a]), -150);
            oracle_integer(&y, exact(i >> a & 1 ? hi[a] : lo[a]), -150);
            wide_multiply(&xy, &x, &y);
            wide_add(&sum, &sum, &xy);
        }
        above += sum.sign > 0;
        below += sum.sign < 0;
    }
    return above == 8 ? 1 : below == 8 ? -1 : 0;
}

/* Half of the planes pass within an ulp of d of a corner. */
static void plane_sides_are_exact(void)
{
    int i;

    random_seed(51);
    for (i = 0; i < TEST_LOOPS(40000); i++) {
        int   kind = random_below(4);
        float n[3];
        float lo[3];
        float hi[3];
        float d = any_float(kind);
        int   answer;
        any_vector(n, random_below(4));
        any_box(lo, hi, kind);
        if (random_below(2) && kind < 3) {
            d = -(n[0] * (random_below(2) ? lo[0] : hi[0]) + n[1] * (random_below(2) ? lo[1] : hi[1]) +
                  n[2] * (random_below(2) ? lo[2] : hi[2]));
            d = nudge_float(d, random_below(3) - 1);
        }
        answer = tribox_plane_box(n, d, lo, hi);
        if (!CHECK(answer == plane_truth(n, d, lo, hi)) && test_wants_details()) {
            print_vector("n", n);
            print_vector("lo", lo);
            print_vector("hi", hi);
            printf("  d %a: %d\n", (double)d, answer);
        }
    }
}

/* An infinite box is on one side only of a plane parallel to all its infinite axes. */
static void plane_and_infinite_boxes(void)
{
    float n[3] = {0, 0, 1};
    float lo[3] = {-1, -1, 2};
    float hi[3] = {1, 1, 3};
    float zero[3] = {0, -0.0f, 0};

    lo[0] = -infinity();
    hi[1] = infinity();
    CHECK(tribox_plane_box(n, -1, lo, hi) == 1);
    CHECK(tribox_plane_box(n, -2, lo, hi) == 0);
    CHECK(tribox_plane_box(n, -4, lo, hi) == -1);
    n[0] = 1e-45f;
    CHECK(tribox_plane_box(n, -1, lo, hi) == 0);
    CHECK(tribox_plane_box(n, infinity(), lo, hi) == 1);
    CHECK(tribox_plane_box(n, -infinity(), lo, hi) == -1);
    CHECK(tribox_plane_box(zero, 1e-45f, lo, hi) == 1);
    CHECK(tribox_plane_box(zero, -1e-45f, lo, hi) == -1);
    CHECK(tribox_plane_box(zero, -0.0f, lo, hi) == 0);
    CHECK(tribox_plane_box(n, not_a_number(), lo, hi) == 2);
    n[1] = infinity();
    CHECK(tribox_plane_box(n, 0, lo, hi) == 2);
    n[1] = not_a_number();
    CHECK(tribox_plane_box(n, 0, lo, hi) == 2);
    n[1] = 0;
    lo[2] = 4;
    CHECK(tribox_plane_box(n, 0, lo, hi) == 2);
    lo[2] = hi[2] = infinity();
    CHECK(tribox_plane_box(n, 0, lo, hi) == 2);
    lo[2] = not_a_number();
    CHECK(tribox_plane_box(n, 0, lo, hi) == 2);
}

/* ---- segment and box ----------------------------------------------------------------------------------- */

static void segments_are_exact(void)
{
    int i;
    int a;

    random_seed(52);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        int      kind = random_below(4);
        float    p[3];
        float    q[3];
        float    lo[3];
        float    hi[3];
        triangle t;
        double   lo_wide[3];
        double   hi_wide[3];
        any_vector(p, kind);
        any_vector(q, kind);
        any_box(lo, hi, kind);
        for (a = 0; a < 3; a++) {
            t.v[0][a] = exact(p[a]);
            t.v[1][a] = t.v[2][a] = exact(q[a]);
            lo_wide[a] = exact(lo[a]);
            hi_wide[a] = exact(hi[a]);
        }
        CHECK(tribox_segment_box(p, q, lo, hi) == (int)(oracle_box(&t, lo_wide, hi_wide) & ORACLE_CLOSED));
        p[i % 3] = i % 2 ? infinity() : not_a_number();
        CHECK(tribox_segment_box(p, q, lo, hi) == 0);
    }
}

/* A segment and a box, all of it made 2^20 to 2^99 times smaller, meet as they did: products of differences are
 * then below all floats. */
static void segments_between_tiny_numbers(void)
{
    int i;
    int a;

    random_seed(92);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        int       halvings = 20 + random_below(80);
        float     unit = 1;
        const float along = 0.5f + 0.4f * (float)random_signed();
        float     x[4][3]; /* p, q, lo, hi */
        float     small[4][3];
        for (a = 0; a < 3; a++) {
            x[0][a] = (float)random_signed();
            x[1][a] = (float)random_signed();
            x[2][a] = x[0][a] + along * (x[1][a] - x[0][a]) + 0.05f * (float)random_signed();
            x[3][a] = x[2][a];
            if (random_below(2)) {
                x[2][a] -= 0.5f + 0.5f * (float)random_signed();
            } else {
                x[3][a] += 0.5f + 0.5f * (float)random_signed();
            }
        }
        for (; halvings > 0; halvings--) {
            unit *= 0.5f;
        }
        for (a = 0; a < 12; a++) {
            small[a / 3][a % 3] = x[a / 3][a % 3] * unit;
        }
        CHECK(tribox_segment_box(small[0], small[1], small[2], small[3]) ==
              tribox_segment_box(x[0], x[1], x[2], x[3]));
    }
}

/* ---- ray and box --------------------------------------------------------------------------------------- */

/* The interval of t by fractions, face by face. */
static int ray_truth(const float o[3], const float d[3], float t_min, float t_max, const float lo[3],
                     const float hi[3], ratio *first, ratio *last)
{
    int a;
    int k;

    ratio_set(first, exact(t_min));
    ratio_set(last, exact(t_max));
    for (a = 0; a < 3; a++) {
        for (k = 0; k < 2; k++) {
            float        face = k ? hi[a] : lo[a];
            static ratio t;
            static wide  origin;
            if (float_order(face) <= float_order(-infinity()) || float_order(face) >= float_order(infinity())) {
                continue;
            }
            oracle_integer(&t.n, exact(face), -150);
            oracle_integer(&origin, exact(o[a]), -150);
            wide_subtract(&t.n, &t.n, &origin);
            oracle_integer(&t.d, exact(d[a]), -150);
            if (t.d.sign == 0) {
                if (k ? t.n.sign < 0 : t.n.sign > 0) {
                    return 0;
                }
                continue;
            }
            if ((t.d.sign > 0) == (k == 0)) {
                t.n.sign *= t.d.sign;
                t.d.sign = 1;
                if (ratio_compare(&t, first) > 0) {
                    *first = t;
                }
            } else {
                t.n.sign *= t.d.sign;
                t.d.sign = 1;
                if (ratio_compare(&t, last) < 0) {
                    *last = t;
                }
            }
        }
    }
    return ratio_compare(first, last) <= 0;
}

/* The answer, both ends to the last bit, and outputs untouched on a miss. */
static int ray_is_right(const float o[3], const float d[3], float t_min, float t_max, const float lo[3],
                        const float hi[3])
{
    static ratio first;
    static ratio last;
    float        t0 = 123.0f;
    float        t1 = 456.0f;
    int          truth = ray_truth(o, d, t_min, t_max, lo, hi, &first, &last);
    int          answer = tribox_ray_box(o, d, t_min, t_max, lo, hi, &t0, &t1);
    int          ok = answer == truth && tribox_ray_box(o, d, t_min, t_max, lo, hi, NULL, NULL) == truth;

    if (ok && truth) {
        float only0 = 0;
        float only1 = 0;
        ok = is_floor(t0, &first) && is_ceiling(t1, &last);
        tribox_ray_box(o, d, t_min, t_max, lo, hi, &only0, NULL);
        tribox_ray_box(o, d, t_min, t_max, lo, hi, NULL, &only1);
        ok = ok && memcmp(&only0, &t0, sizeof t0) == 0 && memcmp(&only1, &t1, sizeof t1) == 0;
    } else if (ok) {
        ok = t0 > 122.5f && t0 < 123.5f && t1 > 455.5f && t1 < 456.5f;
    }
    if (!ok && test_wants_details()) {
        print_vector("origin", o);
        print_vector("dir", d);
        print_vector("lo", lo);
        print_vector("hi", hi);
        printf("  t in [%a, %a]: answer %d, truth %d, t0 %a, t1 %a\n", (double)t_min, (double)t_max, answer,
               truth, (double)t0, (double)t1);
    }
    return ok;
}

static float any_time(int side)
{
    switch (random_below(4)) {
    case 0:
        return side ? infinity() : -infinity();
    case 1:
        return (float)side;
    case 2:
        return (float)(side ? random_below(9) : -random_below(9));
    default:
        return any_float(1 + random_below(3));
    }
}

static void rays_and_boxes_are_exact(void)
{
    int i;
    int a;

    random_seed(53);
    for (i = 0; i < TEST_LOOPS(60000); i++) {
        int   kind = random_below(4);
        float o[3];
        float d[3];
        float lo[3];
        float hi[3];
        any_vector(o, kind);
        any_vector(d, random_below(2) ? kind : random_below(4));
        any_box(lo, hi, kind);
        a = random_below(3);
        if (random_below(2)) {      /* aim at a point of the box, so that ordinary floats hit too */
            for (a = 0; a < 3; a++) {
                d[a] = (random_below(2) ? lo[a] : random_below(2) ? hi[a] : (lo[a] + hi[a]) * 0.5f) - o[a];
            }
        }
        if (random_below(4) == 0) {
            d[random_below(3)] = 0.0f;
        }
        if (random_below(4) == 0) {
            a = random_below(3);
            o[a] = random_below(2) ? lo[a] : hi[a];
        }
        if (random_below(8) == 0) {
            lo[random_below(3)] = -infinity();
            hi[random_below(3)] = infinity();
        }
        if (d[0] - d[0] < 1.0f && d[1] - d[1] < 1.0f && d[2] - d[2] < 1.0f) {
            CHECK(ray_is_right(o, d, any_time(0), any_time(1), lo, hi));
        }
    }
}

/* A ray at a box's edge and corner, moved by ulps; along a face; from a face; of zero length. */
static void rays_that_graze(void)
{
    static const float lo[3] = {1, 2, 4};
    static const float hi[3] = {2, 4, 8};
    int                a;
    int                i;

    for (a = 0; a < 3; a++) {
        int   b = (a + 1) % 3;
        int   c = (a + 2) % 3;
        float o[3];
        float d[3] = {0, 0, 0};
        for (i = -2; i <= 2; i++) {     /* past the edge (hi_b, lo_c), through any c */
            o[a] = lo[a] + 0.5f;
            o[b] = nudge_float(hi[b] + (hi[b] - lo[b]), i);
            o[c] = lo[c] + (hi[c] - lo[c]);
            d[a] = 0;
            d[b] = -(hi[b] - lo[b]);
            d[c] = -(hi[c] - lo[c]);
            CHECK(ray_is_right(o, d, 0, 1, lo, hi));
            CHECK(ray_is_right(o, d, -infinity(), infinity(), lo, hi));
            d[a] = nudge_float(0, i);
            CHECK(ray_is_right(o, d, 0, 1e30f, lo, hi));
            o[b] = nudge_float(hi[b], i);       /* along the face */
            d[b] = -0.0f;
            CHECK(ray_is_right(o, d, -2, 2, lo, hi));
            d[a] = d[c] = 0;                    /* no direction */
            CHECK(ray_is_right(o, d, -1, 3, lo, hi));
            CHECK(ray_is_right(o, d, -infinity(), infinity(), lo, hi));
        }
    }
}

/* A ray across an axis, which no t brings into a slab or out of it: the origin decides, to the last ulp, and
 * NaN and infinities are no question. */
static void rays_across_an_axis(void)
{
    const float values[6] = {not_a_number(), -not_a_number(), infinity(), -infinity(), -1.0f, 1.0f};
    int         a;
    int         i;

    for (a = 0; a < 3; a++) {
        const float d[3] = {a == 0 ? -0.0f : 0.625f, a == 1 ? 0.0f : 0.625f, a == 2 ? 0.0f : -0.625f};
        for (i = 0; i < 6; i++) {
            float o[3] = {0.25f, 0.125f, 0.375f};
            float lo[3] = {-1, -1, -1};
            float hi[3] = {1, 1, 1};
            float t0;
            CHECK(tribox_ray_box(o, d, -9, 9, lo, hi, &t0, NULL) == 1);
            o[a] = values[i];
            CHECK(tribox_ray_box(o, d, -9, 9, lo, hi, &t0, NULL) == (i >= 4));
            lo[a] = -infinity();
            hi[a] = infinity();
            CHECK(tribox_ray_box(o, d, -9, 9, lo, hi, &t0, NULL) == (i >= 4));
            o[a] = 0.25f;
            lo[a] = values[i];
            CHECK(tribox_ray_box(o, d, -9, 9, lo, hi, &t0, NULL) == (i == 3 || i == 4));
            lo[a] = -1;
            hi[a] = values[i];
            CHECK(tribox_ray_box(o, d, -9, 9, lo, hi, &t0, NULL) == (i == 2 || i == 5));
            hi[a] = 1;
            o[a] = nudge_float(i & 1 ? 1.0f : -1.0f, i == 4 ? -1 : i == 5 ? 1 : 0);
            CHECK(tribox_ray_box(o, d, -9, 9, lo, hi, &t0, NULL) == (i < 4));
        }
    }
}

/* An end that is zero is +0 on every path: t = -0 within the slabs, and where the direction takes the slow
 * way. */
static void ends_at_minus_zero_are_zero(void)
{
    static const float dirs[2][3] = {{1.0f, 0.75f, 0.5f}, {1.0f, 0.0f, 0.0f}};
    const float        origin[3] = {0.25f, 0.125f, 0.375f};
    const float        lo[3] = {-1, -1, -1};
    const float        hi[3] = {1, 1, 1};
    int                i;

    for (i = 0; i < 2; i++) {
        float    t0 = 5;
        float    t1 = 5;
        uint32_t bits0;
        uint32_t bits1;
        CHECK(tribox_ray_box(origin, dirs[i], -10.0f, -0.0f, lo, hi, NULL, &t1) == 1);
        CHECK(tribox_ray_box(origin, dirs[i], -0.0f, 10.0f, lo, hi, &t0, NULL) == 1);
        memcpy(&bits0, &t0, sizeof t0);
        memcpy(&bits1, &t1, sizeof t1);
        CHECK(bits0 == 0);
        CHECK(bits1 == 0);
    }
}

static void rays_without_a_question(void)
{
    static const float lo[3] = {-1, -1, -1};
    static const float hi[3] = {1, 1, 1};
    float              o[3] = {0, 0, 0};
    float              d[3] = {1, 2, 3};
    float              x[3] = {0, 0, 0};
    int                a;

    CHECK(tribox_ray_box(o, d, 0, 0, lo, hi, NULL, NULL) == 1);
    CHECK(tribox_ray_box(o, d, 1e-45f, 0, lo, hi, NULL, NULL) == 0);
    CHECK(tribox_ray_box(o, d, not_a_number(), 1, lo, hi, NULL, NULL) == 0);
    CHECK(tribox_ray_box(o, d, 0, not_a_number(), lo, hi, NULL, NULL) == 0);
    CHECK(tribox_ray_box(o, x, infinity(), infinity(), lo, hi, NULL, NULL) == 0);
    CHECK(tribox_ray_box(o, x, -infinity(), -infinity(), lo, hi, NULL, NULL) == 0);
    CHECK(tribox_ray_box(o, d, 0, 1, hi, lo, NULL, NULL) == 0);
    CHECK(tribox_ray_triangle(o, d, -1, 1, lo, hi, o, NULL) == 1);
    CHECK(tribox_ray_triangle(o, d, not_a_number(), 1, lo, hi, o, NULL) == 0);
    CHECK(tribox_ray_triangle(o, d, -1, not_a_number(), lo, hi, o, NULL) == 0);
    for (a = 0; a < 3; a++) {
        x[a] = infinity();
        CHECK(tribox_ray_box(x, d, 0, 1, lo, hi, NULL, NULL) == 0);
        CHECK(tribox_ray_box(o, x, 0, 1, lo, hi, NULL, NULL) == 0);
        CHECK(tribox_ray_box(o, d, 0, 1, x, x, NULL, NULL) == 0);
        x[a] = not_a_number();
        CHECK(tribox_ray_box(x, d, 0, 1, lo, hi, NULL, NULL) == 0);
        CHECK(tribox_ray_box(o, x, 0, 1, lo, hi, NULL, NULL) == 0);
        CHECK(tribox_ray_box(o, d, 0, 1, x, hi, NULL, NULL) == 0);
        CHECK(tribox_ray_box(o, d, 0, 1, lo, x, NULL, NULL) == 0);
        x[a] = 0;
    }
}

/* ---- motion on a lattice ------------------------------------------------------------------------------- */

/* n / d, d > 0 */
typedef struct fraction {
    int64_t n;
    int64_t d;
} fraction;

static fraction make_fraction(int64_t n, int64_t d)
{
    fraction r;

    r.n = d < 0 ? -n : n;
    r.d = d < 0 ? -d : d;
    return r;
}

static int fraction_order(fraction a, fraction b)
{
    int64_t x = a.n * b.d - b.n * a.d;

    return (x > 0) - (x < 0);
}

static fraction later(int there_is_one, fraction a, fraction b)
{
    return there_is_one && fraction_order(a, b) > 0 ? a : b;
}

static fraction sooner(int there_is_one, fraction a, fraction b)
{
    return there_is_one && fraction_order(a, b) < 0 ? a : b;
}

/* Is f the greatest float <= x? Both products are below 2^53. */
static int floors_fraction(float f, fraction x)
{
    /* -Ofast may read a subnormal float as zero, so 2^-149 is a double here */
    const double next = f == 0 ? 1.0 / 713623846352979940529142984724747568191373312.0 : (double)next_float(f);

    return (double)f * (double)x.d <= (double)x.n && next * (double)x.d > (double)x.n;
}

typedef struct scene {
    int64_t v[3][3];
    int64_t lo[3];
    int64_t hi[3];
    int64_t u[3];
} scene;

static void any_scene(scene *s, int n)
{
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        int64_t x = random_below(n);
        int64_t y = random_below(n);
        s->lo[a] = x < y ? x : y;
        s->hi[a] = x < y ? y : x;
        s->u[a] = random_below(3) ? random_below(2 * n + 1) - n : 0;
        for (i = 0; i < 3; i++) {
            s->v[i][a] = random_below(n);
        }
    }
    if (random_below(8) == 0) {
        for (a = 0; a < 3; a++) {
            s->v[2][a] = s->v[random_below(2)][a];
        }
    }
}

/* Does B + t u meet T, by oracle.h, everything times the denominator? */
static int meets_at(const scene *s, fraction t)
{
    static oracle_case c;
    int                a;
    int                i;

    for (a = 0; a < 3; a++) {
        int64_t lo = s->lo[a] * t.d + s->u[a] * t.n;
        int64_t hi = s->hi[a] * t.d + s->u[a] * t.n;
        wide_set(&c.face[0][a], lo < 0 ? -1 : 1, lo < 0 ? (uint64_t)-lo : (uint64_t)lo, 0);
        wide_set(&c.face[1][a], hi < 0 ? -1 : 1, hi < 0 ? (uint64_t)-hi : (uint64_t)hi, 0);
        for (i = 0; i < 3; i++) {
            wide_set(&c.v[i][a], 1, (uint64_t)(s->v[i][a] * t.d), 0);
        }
    }
    return (oracle_rules(&c) & ORACLE_CLOSED) != 0;
}

typedef struct interval {
    fraction first;
    fraction last;
    int      hit;
} interval;

static void consider(interval *r, const scene *s, int64_t n, int64_t d, fraction t_min, fraction t_max)
{
    fraction t;

    if (d == 0) {
        return;
    }
    t = make_fraction(n, d);
    if (fraction_order(t, t_min) < 0 || fraction_order(t, t_max) > 0 ||
        (r->hit && fraction_order(t, r->first) >= 0 && fraction_order(t, r->last) <= 0) || !meets_at(s, t)) {
        return;
    }
    if (!r->hit || fraction_order(t, r->first) < 0) {
        r->first = t;
    }
    if (!r->hit || fraction_order(t, r->last) > 0) {
        r->last = t;
    }
    r->hit = 1;
}

/* The contact begins and ends at t_min, t_max or an event: a corner of T in a face plane of B, a corner of
 * B in T's plane, an edge of T crossing an edge line of B as seen along that line. */
static interval contact_by_events(const scene *s, fraction t_min, fraction t_max)
{
    interval r = {{0, 1}, {0, 1}, 0};
    int64_t  n[3];
    int      a;
    int      i;
    int      k;

    consider(&r, s, t_min.n, t_min.d, t_min, t_max);
    consider(&r, s, t_max.n, t_max.d, t_min, t_max);
    for (a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        int c = (a + 2) % 3;
        n[a] = (s->v[1][b] - s->v[0][b]) * (s->v[2][c] - s->v[0][c]) -
               (s->v[1][c] - s->v[0][c]) * (s->v[2][b] - s->v[0][b]);
        for (i = 0; i < 3; i++) {
            const int64_t *p = s->v[i];
            const int64_t *q = s->v[(i + 1) % 3];
            consider(&r, s, p[a] - s->lo[a], s->u[a], t_min, t_max);
            consider(&r, s, p[a] - s->hi[a], s->u[a], t_min, t_max);
            for (k = 0; k < 4; k++) {
                int64_t db = p[b] - (k & 1 ? s->hi[b] : s->lo[b]);
                int64_t dc = p[c] - (k & 2 ? s->hi[c] : s->lo[c]);
                consider(&r, s, db * (q[c] - p[c]) - dc * (q[b] - p[b]),
                         s->u[b] * (q[c] - p[c]) - s->u[c] * (q[b] - p[b]), t_min, t_max);
            }
        }
    }
    for (k = 0; k < 8; k++) {
        int64_t top = 0;
        int64_t rate = 0;
        for (a = 0; a < 3; a++) {
            top += n[a] * (s->v[0][a] - (k >> a & 1 ? s->hi[a] : s->lo[a]));
            rate += n[a] * s->u[a];
        }
        consider(&r, s, top, rate, t_min, t_max);
    }
    return r;
}

/* ---- sweep --------------------------------------------------------------------------------------------- */

typedef struct axis_motion {
    int64_t  l[3];
    int      zero;          /* no axis */
    int      never;         /* parted at every t */
    int      opens;         /* at t = `open`, with the box on side `open_side` of T */
    fraction open;
    int      open_side;
    int      gap_sides;     /* zero gap at t = 0: bit 0 box on the side of l, bit 1 on the side of -l */
    int      closes;
    fraction close;
} axis_motion;

/* One of the thirteen, by the projections of all corners. */
static axis_motion move_along(const scene *s, int axis)
{
    axis_motion r;
    int64_t     t_lo = INT64_MAX;
    int64_t     t_hi = INT64_MIN;
    int64_t     b_lo = INT64_MAX;
    int64_t     b_hi = INT64_MIN;
    int64_t     u = 0;
    int         i;
    int         a;

    memset(&r, 0, sizeof r);
    for (a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        int c = (a + 2) % 3;
        if (axis < 3) {
            r.l[a] = a == axis;
        } else if (axis == 3) {
            r.l[a] = (s->v[1][b] - s->v[0][b]) * (s->v[2][c] - s->v[0][c]) -
                     (s->v[1][c] - s->v[0][c]) * (s->v[2][b] - s->v[0][b]);
        } else {
            int     x = (axis - 4) / 3;
            int64_t e[3];
            int64_t unit[3] = {0, 0, 0};
            i = (axis - 4) % 3;
            for (b = 0; b < 3; b++) {
                e[b] = s->v[(i + 1) % 3][b] - s->v[i][b];
            }
            unit[x] = 1;
            b = (a + 1) % 3;
            r.l[a] = e[b] * unit[c] - e[c] * unit[b];
        }
    }
    r.zero = r.l[0] == 0 && r.l[1] == 0 && r.l[2] == 0;
    for (i = 0; i < 8; i++) {
        int64_t box = 0;
        int64_t corner = 0;
        for (a = 0; a < 3; a++) {
            box += r.l[a] * (i >> a & 1 ? s->hi[a] : s->lo[a]);
            corner += r.l[a] * s->v[i % 3][a];
        }
        b_lo = box < b_lo ? box : b_lo;
        b_hi = box > b_hi ? box : b_hi;
        t_lo = corner < t_lo ? corner : t_lo;
        t_hi = corner > t_hi ? corner : t_hi;
    }
    for (a = 0; a < 3; a++) {
        u += r.l[a] * s->u[a];
    }
    r.gap_sides = (b_lo == t_hi) | (b_hi == t_lo) << 1;
    if (u == 0) {
        r.never = b_lo > t_hi || b_hi < t_lo;
        return r;
    }
    r.opens = r.closes = 1;
    r.open_side = u < 0 ? 1 : -1;
    r.open = u < 0 ? make_fraction(t_hi - b_lo, u) : make_fraction(t_lo - b_hi, u);
    r.close = u < 0 ? make_fraction(t_lo - b_hi, u) : make_fraction(t_hi - b_lo, u);
    return r;
}

/* Unit to 2^-22 and parallel to side * l to 2^-20. */
static int is_unit_along(const float x[3], const int64_t l[3], int side)
{
    double length2 = 0;
    double l2 = 0;
    double dot = 0;
    double cross2 = 0;
    int    a;

    for (a = 0; a < 3; a++) {
        int    b = (a + 1) % 3;
        int    c = (a + 2) % 3;
        double cross = (double)x[b] * (double)l[c] - (double)x[c] * (double)l[b];
        length2 += (double)x[a] * (double)x[a];
        l2 += (double)l[a] * (double)l[a];
        dot += (double)x[a] * (double)l[a] * side;
        cross2 += cross * cross;
    }
    return length2 > 1 - 2 / 4194304.0 && length2 < 1 + 2 / 4194304.0 && dot > 0 &&
           cross2 <= l2 / (1048576.0 * 1048576.0);
}

static int axis_is_right(const axis_motion axes[13], fraction first, const float x[3])
{
    int any_gap = 0;
    int i;

    for (i = 0; i < 13; i++) {
        if (!axes[i].zero && axes[i].opens && fraction_order(axes[i].open, first) == 0) {
            return is_unit_along(x, axes[i].l, axes[i].open_side);
        }
    }
    for (i = 0; i < 13; i++) {
        if (!axes[i].zero && axes[i].gap_sides) {
            any_gap = 1;
            if (((axes[i].gap_sides & 1) && is_unit_along(x, axes[i].l, 1)) ||
                ((axes[i].gap_sides & 2) && is_unit_along(x, axes[i].l, -1))) {
                return 1;
            }
        }
    }
    return !any_gap && memcmp(x, "\0\0\0\0\0\0\0\0\0\0\0\0", 12) == 0;
}

static void scene_floats(const scene *s, const float scale[3], float v[3][3], float lo[3], float hi[3],
                         float u[3])
{
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        lo[a] = (float)s->lo[a] * scale[a];
        hi[a] = (float)s->hi[a] * scale[a];
        u[a] = (float)s->u[a] * scale[a];
        for (i = 0; i < 3; i++) {
            v[i][a] = (float)s->v[i][a] * scale[a];
        }
    }
}

static void print_scene(const scene *s)
{
    int i;

    for (i = 0; i < 3; i++) {
        printf("  v%d {%d, %d, %d}\n", i, (int)s->v[i][0], (int)s->v[i][1], (int)s->v[i][2]);
    }
    printf("  lo {%d, %d, %d} hi {%d, %d, %d} u {%d, %d, %d}\n", (int)s->lo[0], (int)s->lo[1], (int)s->lo[2],
           (int)s->hi[0], (int)s->hi[1], (int)s->hi[2], (int)s->u[0], (int)s->u[1], (int)s->u[2]);
}

static int sweep_is_right(const scene *s, const axis_motion axes[13], interval truth)
{
    float scale[3] = {1, 1, 1};
    float v[3][3];
    float lo[3];
    float hi[3];
    float u[3];
    float t0 = -1;
    float t1 = -1;
    float x[3] = {9, 9, 9};
    int   answer;
    int   ok;
    int   a;

    scene_floats(s, scale, v, lo, hi, u);
    answer = tribox_sweep(v[0], v[1], v[2], lo, hi, u, &t0, &t1, x);
    ok = answer == truth.hit && answer == tribox_sweep(v[0], v[1], v[2], lo, hi, u, NULL, NULL, NULL);
    if (answer && ok) {
        float    scaled0 = 0;
        float    scaled1 = 0;
        fraction minus = {0, 0};
        minus.n = -truth.last.n;
        minus.d = truth.last.d;
        ok = floors_fraction(t0, truth.first) && floors_fraction(-t1, minus) &&
             axis_is_right(axes, truth.first, x);
        for (a = 0; a < 3; a++) {       /* a scale per axis changes no time */
            scale[a] = any_scale();
        }
        scene_floats(s, scale, v, lo, hi, u);
        ok = ok && tribox_sweep(v[0], v[1], v[2], lo, hi, u, &scaled0, &scaled1, NULL) == 1;
        ok = ok && memcmp(&scaled0, &t0, sizeof t0) == 0 && memcmp(&scaled1, &t1, sizeof t1) == 0;
    } else if (ok) {
        ok = t0 < 0 && t1 < 0 && x[0] > 8 && x[1] > 8 && x[2] > 8;
    }
    if (!ok && test_wants_details()) {
        print_scene(s);
        printf("  answer %d, t [%a, %a], axis %g %g %g; truth %d, [%d/%d, %d/%d]\n", answer, (double)t0,
               (double)t1, (double)x[0], (double)x[1], (double)x[2], truth.hit, (int)truth.first.n,
               (int)truth.first.d,
               (int)truth.last.n, (int)truth.last.d);
    }
    return ok;
}

/* The thirteen intervals in fractions give the header's answer, times and axis; for one scene in eight,
 * events and static overlap give the same interval. */
static void sweeps_are_exact(void)
{
    fraction zero = {0, 1};
    fraction one = {1, 1};
    int      hits = 0;
    int      i;
    int      k;

    random_seed(54);
    for (i = 0; i < TEST_LOOPS(40000); i++) {
        scene       s;
        axis_motion axes[13];
        interval    truth;
        any_scene(&s, 3 + random_below(6));
        truth.first = zero;
        truth.last = one;
        truth.hit = 1;
        for (k = 0; k < 13; k++) {
            axes[k] = move_along(&s, k);
            if (!axes[k].zero) {
                truth.hit &= !axes[k].never;
                truth.first = later(axes[k].opens, axes[k].open, truth.first);
                truth.last = sooner(axes[k].closes, axes[k].close, truth.last);
            }
        }
        truth.hit &= fraction_order(truth.first, truth.last) <= 0;
        hits += truth.hit;
        CHECK(sweep_is_right(&s, axes, truth));
        if (i % 8 == 0) {
            interval events = contact_by_events(&s, zero, one);
            CHECK(events.hit == truth.hit);
            CHECK(!truth.hit || (fraction_order(events.first, truth.first) == 0 &&
                                 fraction_order(events.last, truth.last) == 0));
        }
    }
    CHECK(hits > i / 8 && hits < i - i / 8);
}

/* Static overlap at a float moment, in full-length integers. */
static int overlaps_at(const float v[3][3], const float lo[3], const float hi[3], const float u[3], float t)
{
    static oracle_case c;
    static wide        time;
    static wide        step;
    static wide        shift;
    int                a;
    int                i;

    oracle_integer(&time, exact(t), -150);
    for (a = 0; a < 3; a++) {
        static wide x;
        oracle_integer(&x, exact(u[a]), -150);
        wide_multiply(&shift, &x, &time);
        for (i = 0; i < 3; i++) {
            oracle_integer(&c.v[i][a], exact(v[i][a]), -300);
        }
        for (i = 0; i < 2; i++) {
            oracle_integer(&step, exact(i ? hi[a] : lo[a]), -300);
            wide_add(&c.face[i][a], &step, &shift);
        }
    }
    return (oracle_rules(&c) & ORACLE_CLOSED) != 0;
}

/* Ordinary and wild floats: parted one float before t0 and one after t1, in contact just within. */
static void sweeps_of_any_floats_stop_at_contact(void)
{
    int hits = 0;
    int i;
    int k;

    random_seed(55);
    for (i = 0; i < TEST_LOOPS(6000); i++) {
        int   kind = 1 + random_below(3);
        float v[3][3];
        float lo[3];
        float hi[3];
        float u[3];
        float t0;
        float t1;
        float x[3];
        for (k = 0; k < 3; k++) {
            any_vector(v[k], kind);
        }
        any_box(lo, hi, kind);
        for (k = 0; k < 3; k++) {
            float centre = (lo[k] + hi[k]) * 0.5f;
            hi[k] = centre + (hi[k] - centre) * 0.25f;
            lo[k] = lo[k] < centre ? centre - (centre - lo[k]) * 0.25f : centre;
            u[k] = random_below(4) ? 2.0f * (v[random_below(3)][k] - lo[k]) : any_float(kind);
            hi[k] = float_order(hi[k]) < float_order(lo[k]) ? lo[k] : hi[k];
        }
        if (!(u[0] - u[0] < 1.0f && u[1] - u[1] < 1.0f && u[2] - u[2] < 1.0f)) {
            continue;
        }
        if (tribox_sweep(v[0], v[1], v[2], lo, hi, u, &t0, &t1, x)) {
            float inner0 = nudge_float(t0, 1);
            float inner1 = nudge_float(t1, -1);
            hits++;
            CHECK(t0 >= 0.0f && t0 <= t1 && t1 <= 1.0f);
            CHECK(float_order(inner0) > float_order(inner1) ||
                  (overlaps_at((const float (*)[3])v, lo, hi, u, inner0) &&
                                      overlaps_at((const float (*)[3])v, lo, hi, u, inner1)));
            CHECK(float_order(t0) == 0 ||
                  !overlaps_at((const float (*)[3])v, lo, hi, u, nudge_float(t0, -1)));
            CHECK(!(t1 < 1.0f) || !overlaps_at((const float (*)[3])v, lo, hi, u, nudge_float(t1, 1)));
        } else {
            for (k = 0; k < 5; k++) {
                CHECK(!overlaps_at((const float (*)[3])v, lo, hi, u, (float)k * 0.25f));
            }
        }
    }
    CHECK(hits > i / 8 && hits < i - i / 8);
}

static void sweeps_without_a_question(void)
{
    static const float v0[3] = {0, 0, 0};
    static const float v1[3] = {4, 0, 0};
    static const float v2[3] = {0, 4, 0};
    float              lo[3] = {1, 1, 2};
    float              hi[3] = {2, 2, 3};
    float              u[3] = {0, 0, -2};
    float              x[3];
    float              t0;
    float              t1;

    CHECK(tribox_sweep(v0, v1, v2, lo, hi, u, &t0, &t1, x) == 1);
    CHECK(t0 >= 1.0f && t0 <= 1.0f && t1 >= 1.0f && t1 <= 1.0f && x[2] >= 1.0f && x[2] <= 1.0f);
    u[2] = nudge_float(-2, 1);
    CHECK(tribox_sweep(v0, v1, v2, lo, hi, u, NULL, NULL, NULL) == 0);
    u[2] = not_a_number();
    CHECK(tribox_sweep(v0, v1, v2, lo, hi, u, NULL, NULL, NULL) == 0);
    u[2] = -infinity();
    CHECK(tribox_sweep(v0, v1, v2, lo, hi, u, NULL, NULL, NULL) == 0);
    u[2] = -4;
    CHECK(tribox_sweep(u, v1, v2, lo, hi, u, NULL, NULL, NULL) == 1);
    lo[0] = not_a_number();
    CHECK(tribox_sweep(v0, v1, v2, lo, hi, u, NULL, NULL, NULL) == 0);
    CHECK(tribox_sweep(lo, v1, v2, v0, v0, u, NULL, NULL, NULL) == 0);
    lo[0] = -infinity();
    hi[1] = infinity();
    CHECK(tribox_sweep(v0, v1, v2, lo, hi, u, &t0, &t1, x) == 1);
    CHECK(t0 >= 0.5f && t0 <= 0.5f && t1 >= 0.75f && t1 <= 0.75f && x[2] >= 1.0f);
    hi[2] = infinity();
    CHECK(tribox_sweep(v0, v1, v2, lo, hi, u, &t0, &t1, x) == 1);
    CHECK(t0 >= 0.5f && t0 <= 0.5f && t1 >= 1.0f);
    lo[0] = hi[0] = -infinity();
    CHECK(tribox_sweep(v0, v1, v2, lo, hi, u, NULL, NULL, NULL) == 0);
}

/* ---- ray and triangle ---------------------------------------------------------------------------------- */

/* The ray as a box of one point in motion. */
static void rays_and_triangles_are_exact(void)
{
    static const int ends[5] = {-64, -1, 0, 1, 64};
    int              hits = 0;
    int              i;
    int              a;

    random_seed(56);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        float    scale[3] = {1, 1, 1};
        scene    s;
        interval truth;
        fraction t_min = {0, 1};
        fraction t_max = {0, 1};
        float    v[3][3];
        float    o[3];
        float    hi[3];
        float    d[3];
        float    t = -1000;
        float    scaled = 0;
        int      from = random_below(5);
        int      to = from + random_below(5 - from);
        int      answer;
        int      ok;
        any_scene(&s, 3 + random_below(4));
        if (random_below(2)) {          /* to a corner, an edge or the middle of T; often within its plane */
            int64_t w0 = random_below(3);
            int64_t w1 = random_below(3);
            int     k = random_below(3);
            for (a = 0; a < 3; a++) {
                s.u[a] = w0 * s.v[0][a] + w1 * s.v[1][a] + (2 - w0) * s.v[2][a] - (2 + w1) * s.lo[a];
                s.lo[a] = random_below(8) == 0 ? s.v[k][a] : s.lo[a];
            }
        }
        for (a = 0; a < 3; a++) {
            s.hi[a] = s.lo[a];
        }
        t_min.n = ends[from];
        t_max.n = ends[to];
        truth = contact_by_events(&s, t_min, t_max);
        hits += truth.hit;
        scene_floats(&s, scale, v, o, hi, d);
        answer = tribox_ray_triangle(o, d, (float)ends[from], (float)ends[to], v[0], v[1], v[2], &t);
        ok = answer == truth.hit &&
             answer == tribox_ray_triangle(o, d, (float)ends[from], (float)ends[to], v[2], v[1], v[0], NULL);
        if (ok && answer) {
            ok = floors_fraction(t, truth.first);
            for (a = 0; a < 3; a++) {
                scale[a] = any_scale();
            }
            scene_floats(&s, scale, v, o, hi, d);
            ok = ok && tribox_ray_triangle(o, d, (float)ends[from], (float)ends[to], v[0], v[1], v[2],
                                           &scaled) == 1;
            ok = ok && memcmp(&scaled, &t, sizeof t) == 0;
        } else if (ok) {
            ok = t < -999.0f;
        }
        if (!CHECK(ok) && test_wants_details()) {
            print_scene(&s);
            printf("  t in [%d, %d]: answer %d, t %a; truth %d, %d/%d\n", ends[from], ends[to], answer,
                   (double)t, truth.hit, (int)truth.first.n, (int)truth.first.d);
        }
    }
    CHECK(hits > i / 8 && hits < i - i / 8);
}

/* A line in T's plane, and one along a segment, enter at the first point; a line of no direction stays. */
static void lines_within_a_triangle(void)
{
    static const float v0[3] = {1, 1, 3};
    static const float v1[3] = {5, 1, 3};
    static const float v2[3] = {1, 5, 3};
    float              o[3] = {0, 2, 3};
    float              d[3] = {1, 0, 0};
    float              t = 0;

    CHECK(tribox_ray_triangle(o, d, -infinity(), infinity(), v0, v1, v2, &t) && t >= 1 && t <= 1);
    CHECK(tribox_ray_triangle(o, d, 2, infinity(), v0, v1, v2, &t) && t >= 2 && t <= 2);
    CHECK(!tribox_ray_triangle(o, d, nudge_float(4, 1), infinity(), v0, v1, v2, &t));
    CHECK(!tribox_ray_triangle(o, d, -infinity(), nudge_float(1, -1), v0, v1, v2, &t));
    o[2] = nudge_float(3, 1);
    CHECK(!tribox_ray_triangle(o, d, -infinity(), infinity(), v0, v1, v2, &t));
    o[2] = 3;
    o[1] = 1;
    CHECK(tribox_ray_triangle(o, d, -infinity(), infinity(), v0, v1, v1, &t) && t >= 1 && t <= 1);
    CHECK(tribox_ray_triangle(o, d, -infinity(), infinity(), v1, v1, v1, &t) && t >= 5 && t <= 5);
    CHECK(tribox_ray_triangle(o, d, -infinity(), infinity(), v1, v0, v2, &t) && t >= 1 && t <= 1);
    d[0] = 0;
    CHECK(!tribox_ray_triangle(o, d, -infinity(), infinity(), v0, v1, v2, &t));
    CHECK(tribox_ray_triangle(v1, d, -infinity(), infinity(), v0, v1, v2, &t) && t < -FLT_MAX);
    CHECK(tribox_ray_triangle(v1, d, -7, infinity(), v0, v1, v2, &t) && t >= -7 && t <= -7);
    d[0] = not_a_number();
    CHECK(!tribox_ray_triangle(v1, d, -7, infinity(), v0, v1, v2, &t));
    CHECK(!tribox_ray_triangle(v1, v2, -7, infinity(), d, v1, v2, &t));
    CHECK(!tribox_ray_triangle(v1, v2, 1, 0, v0, v1, v2, &t));
    CHECK(!tribox_ray_triangle(v1, v2, not_a_number(), 0, v0, v1, v2, &t));
    CHECK(!tribox_ray_triangle(v1, v2, infinity(), infinity(), v0, v1, v2, &t));
}

/* Rays at points near the shared edge of two triangles of any floats never slip through: seen from o, the
 * two cover a neighbourhood of the edge's inner points. */
static void no_ray_slips_between_two_triangles(void)
{
    int i;
    int a;

    random_seed(57);
    for (i = 0; i < TEST_LOOPS(60000); i++) {
        float v[4][3];
        float o[3];
        float d[3];
        float w = (float)(random_below(98) + 1) * 0.01f;
        for (a = 0; a < 3; a++) {
            v[0][a] = any_float(2);
            v[1][a] = any_float(2);
            o[a] = any_float(2);
        }
        for (a = 0; a < 3; a++) {       /* wings to both sides, as seen from o */
            float side = ((v[0][(a + 1) % 3] - o[(a + 1) % 3]) * (v[1][(a + 2) % 3] - o[(a + 2) % 3]) -
                          (v[0][(a + 2) % 3] - o[(a + 2) % 3]) * (v[1][(a + 1) % 3] - o[(a + 1) % 3]));
            v[2][a] = (v[0][a] + v[1][a]) * 0.5f + side;
            v[3][a] = (v[0][a] + v[1][a]) * 0.5f - side * 0.75f;
            d[a] = v[0][a] + (v[1][a] - v[0][a]) * w - o[a];
        }
        CHECK(tribox_ray_triangle(o, d, 0, infinity(), v[0], v[1], v[2], NULL) ||
              tribox_ray_triangle(o, d, 0, infinity(), v[1], v[0], v[3], NULL));
    }
}

int main(void)
{
    RUN(boxes_meet_unless_an_axis_parts_them);
    RUN(boxes_at_the_ends_of_the_number_line);
    RUN(plane_sides_are_exact);
    RUN(plane_and_infinite_boxes);
    RUN(segments_are_exact);
    RUN(segments_between_tiny_numbers);
    RUN(rays_and_boxes_are_exact);
    RUN(rays_that_graze);
    RUN(rays_across_an_axis);
    RUN(ends_at_minus_zero_are_zero);
    RUN(rays_without_a_question);
    RUN(sweeps_are_exact);
    RUN(sweeps_of_any_floats_stop_at_contact);
    RUN(sweeps_without_a_question);
    RUN(rays_and_triangles_are_exact);
    RUN(lines_within_a_triangle);
    RUN(no_ray_slips_between_two_triangles);
    return test_report("test_companions_motion");
}
