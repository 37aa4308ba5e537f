/* Contact: sweeps under a touching rule, gaps, segments through grids, spheres. Truth by other methods than
 * the header's: overlap at every event and between events (oracle.h), projections of all corners, every voxel
 * asked for itself, and integers of any length. */
#include "tribox.h"

#include "question.h"

#include <float.h>

static float infinity(void)
{
    return nudge_float(FLT_MAX, 1);
}

static float not_a_number(void)
{
    return nudge_float(FLT_MAX, 2);
}

/* Orders as floats do, by their bits: also where subnormals are read as zero. */
static int32_t float_order(float x)
{
    int32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits < 0 ? -(bits & 0x7fffffff) : bits;
}

static float lesser(float x, float y)
{
    return float_order(x) < float_order(y) ? x : y;
}

static float greater(float x, float y)
{
    return float_order(x) < float_order(y) ? y : x;
}

/* ---- fractions of small integers ----------------------------------------------------------------------- */

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
    const int64_t x = a.n * b.d - b.n * a.d;
    return (x > 0) - (x < 0);
}

/* Is f, in [0, 1], the greatest float <= x? The products are below 2^53. */
static int floors_fraction(float f, fraction x)
{
    /* -Ofast may read a subnormal float as zero, so 2^-149 is a double here */
    const double next = f == 0.0f ? power_of_two(-149) : (double)nudge_float(f, 1);
    return (double)f * (double)x.d <= (double)x.n && next * (double)x.d > (double)x.n;
}

static int ceils_fraction(float f, fraction x)
{
    const double before = f == 0.0f ? -1.0 : (double)nudge_float(f, -1);
    return (double)f * (double)x.d >= (double)x.n && before * (double)x.d < (double)x.n;
}

/* ---- scenes on a lattice ------------------------------------------------------------------------------- */

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
        const int64_t x = random_below(n);
        const int64_t y = random_below(n);
        s->lo[a] = x < y ? x : y;
        s->hi[a] = x < y ? y : x;
        s->u[a] = random_below(3) ? random_below(2 * n + 1) - n : 0;
        for (i = 0; i < 3; i++) {
            s->v[i][a] = random_below(n);
        }
    }
    if (random_below(8) == 0) {
        memcpy(s->v[2], s->v[random_below(2)], sizeof s->v[2]);
    }
    if (random_below(4) == 0) { /* level, as floors and walls are */
        a = random_below(3);
        s->v[1][a] = s->v[2][a] = s->v[0][a];
    }
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
        printf("  v%d {%d, %d, %d}", i, (int)s->v[i][0], (int)s->v[i][1], (int)s->v[i][2]);
    }
    printf("\n  lo {%d, %d, %d} hi {%d, %d, %d} u {%d, %d, %d}\n", (int)s->lo[0], (int)s->lo[1],
           (int)s->lo[2], (int)s->hi[0], (int)s->hi[1], (int)s->hi[2], (int)s->u[0], (int)s->u[1],
           (int)s->u[2]);
}

/* Axis 0..12 of the scene, in the order that the header documents. */
static void scene_axis(const scene *s, int axis, int64_t l[3])
{
    const int i = axis < 4 ? 0 : (axis - 4) % 3;
    const int unit = axis < 4 ? axis : (axis - 4) / 3;
    int64_t x[3];
    int64_t y[3];
    int a;
    for (a = 0; a < 3; a++) {
        x[a] = s->v[(i + 1) % 3][a] - s->v[i][a];
        y[a] = axis == 3 ? s->v[2][a] - s->v[0][a] : a == unit;
    }
    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        l[a] = axis < 3 ? a == axis : x[b] * y[c] - x[c] * y[b];
    }
}

typedef struct projection {
    int64_t t_lo;
    int64_t t_hi;
    int64_t b_lo;
    int64_t b_hi;
} projection;

/* Of all corners. */
static projection project(const scene *s, const int64_t l[3])
{
    projection p = {INT64_MAX, INT64_MIN, INT64_MAX, INT64_MIN};
    int i;
    int a;
    for (i = 0; i < 8; i++) {
        int64_t box = 0;
        int64_t corner = 0;
        for (a = 0; a < 3; a++) {
            box += l[a] * (i >> a & 1 ? s->hi[a] : s->lo[a]);
            corner += l[a] * s->v[i % 3][a];
        }
        p.b_lo = box < p.b_lo ? box : p.b_lo;
        p.b_hi = box > p.b_hi ? box : p.b_hi;
        p.t_lo = corner < p.t_lo ? corner : p.t_lo;
        p.t_hi = corner > p.t_hi ? corner : p.t_hi;
    }
    return p;
}

/* Unit to 2^-22 and parallel to side * l to 2^-20. */
static int is_unit_along(const float x[3], const int64_t l[3], int side)
{
    double length2 = 0;
    double l2 = 0;
    double dot = 0;
    double cross2 = 0;
    int a;
    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        const double cross = (double)x[b] * (double)l[c] - (double)x[c] * (double)l[b];
        length2 += (double)x[a] * (double)x[a];
        l2 += (double)l[a] * (double)l[a];
        dot += (double)x[a] * (double)l[a] * side;
        cross2 += cross * cross;
    }
    return length2 > 1 - 2 / 4194304.0 && length2 < 1 + 2 / 4194304.0 && dot > 0 &&
           cross2 <= l2 / (1048576.0 * 1048576.0);
}

/* ---- sweeps under a rule ------------------------------------------------------------------------------- */

/* The rules under which B + t u meets T, by oracle.h, everything times the denominator. */
static unsigned rules_at(const scene *s, fraction t)
{
    static oracle_case c;
    int a;
    int i;
    for (a = 0; a < 3; a++) {
        const int64_t lo = s->lo[a] * t.d + s->u[a] * t.n;
        const int64_t hi = s->hi[a] * t.d + s->u[a] * t.n;
        wide_set(&c.face[0][a], lo < 0 ? -1 : 1, lo < 0 ? (uint64_t)-lo : (uint64_t)lo, 0);
        wide_set(&c.face[1][a], hi < 0 ? -1 : 1, hi < 0 ? (uint64_t)-hi : (uint64_t)hi, 0);
        for (i = 0; i < 3; i++) {
            wide_set(&c.v[i][a], 1, (uint64_t)(s->v[i][a] * t.d), 0);
        }
    }
    return oracle_rules(&c);
}

#define MOMENTS 64

/* 0, 1 and the times between them at which two projections begin or cease to meet on some axis, in order. */
static int moments(const scene *s, fraction t[MOMENTS])
{
    int count = 2;
    int axis;
    int i;
    t[0] = make_fraction(0, 1);
    t[1] = make_fraction(1, 1);
    for (axis = 0; axis < 13; axis++) {
        int64_t l[3];
        projection p;
        int64_t u = 0;
        scene_axis(s, axis, l);
        p = project(s, l);
        for (i = 0; i < 3; i++) {
            u += l[i] * s->u[i];
        }
        for (i = 0; i < 2 && u != 0; i++) {
            const fraction at = make_fraction(i ? p.t_hi - p.b_lo : p.t_lo - p.b_hi, u);
            int j;
            int k;
            for (j = 0; j < count && fraction_order(t[j], at) < 0; j++) {
            }
            if (j == 0 || j == count || fraction_order(t[j], at) == 0) {
                continue;
            }
            for (k = count++; k > j; k--) {
                t[k] = t[k - 1];
            }
            t[j] = at;
        }
    }
    return count;
}

typedef struct contact {
    fraction first;
    fraction last;
    int hit;
    int at_start; /* the interior is met at t = 0 */
} contact;

/* The interior is met in open intervals between moments, or at 0 or 1. */
static contact contact_by_moments(const scene *s)
{
    fraction t[MOMENTS];
    const int count = moments(s, t);
    contact r = {{0, 1}, {0, 1}, 0, 0};
    int i;
    for (i = 0; i < count; i++) {
        if ((rules_at(s, t[i]) & ORACLE_OPEN) != 0) {
            r.at_start |= i == 0;
            r.first = r.hit ? r.first : t[i];
            r.last = t[i];
            r.hit = 1;
        }
        if (i + 1 < count) {
            const fraction between = make_fraction(t[i].n + t[i + 1].n, t[i].d + t[i + 1].d);
            if ((rules_at(s, between) & ORACLE_OPEN) != 0) {
                r.first = r.hit ? r.first : t[i];
                r.last = t[i + 1];
                r.hit = 1;
            }
        }
    }
    return r;
}

/* The first of so many axes whose open interval begins at r's infimum, against the box's movement. */
static int open_axis_is_right(const scene *s, int axes, contact r, const float x[3])
{
    int axis;
    int i;
    if (r.at_start) {
        return memcmp(x, "\0\0\0\0\0\0\0\0\0\0\0\0", 12) == 0;
    }
    for (axis = 0; axis < axes; axis++) {
        int64_t l[3];
        projection p;
        int64_t u = 0;
        scene_axis(s, axis, l);
        p = project(s, l);
        for (i = 0; i < 3; i++) {
            u += l[i] * s->u[i];
        }
        if (u != 0 &&
            fraction_order(make_fraction(u > 0 ? p.t_lo - p.b_hi : p.t_hi - p.b_lo, u), r.first) == 0) {
            return is_unit_along(x, l, u > 0 ? -1 : 1);
        }
    }
    return 0;
}

/* A power of two, or 19 bits times one: the lattice stays exact, but its products no longer fit a double. */
static float any_scale(void)
{
    const double bits = random_below(2) ? 1 : 262145 + 2 * random_below(131071);
    return (float)(bits * power_of_two(random_below(200) - 110));
}

/* Under OPEN: the first and the last moment, by overlap before, at and after every event, at any scale. */
static void open_sweeps_are_exact(void)
{
    int hits = 0;
    int starts = 0;
    int i;
    random_seed(61);
    for (i = 0; i < TEST_LOOPS(12000); i++) {
        const unsigned flags = TRIBOX_OPEN | (random_below(2) ? TRIBOX_HALF_OPEN : 0u) |
                               (random_below(4) ? 0u : 0xfffffff8u);
        float scale[3] = {1, 1, 1};
        float v[3][3];
        float lo[3];
        float hi[3];
        float u[3];
        float t[4] = {-7, -7, -7, -7};
        float x[3] = {9, 9, 9};
        scene s;
        contact r;
        int ok;
        any_scene(&s, 3 + random_below(6));
        r = contact_by_moments(&s);
        hits += r.hit;
        starts += r.at_start;
        scene_floats(&s, scale, v, lo, hi, u);
        ok = tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, flags, &t[0], &t[1], x) == r.hit;
        if (ok && r.hit) {
            ok = floors_fraction(t[0], r.first) && ceils_fraction(t[1], r.last) &&
                 open_axis_is_right(&s, 13, r, x);
        } else if (ok) {
            ok = t[0] < -6 && t[1] < -6 && x[0] > 8 && x[1] > 8 && x[2] > 8;
        }
        if (ok && r.hit) {
            scale[0] = any_scale();
            scale[1] = any_scale();
            scale[2] = any_scale();
            scene_floats(&s, scale, v, lo, hi, u);
            ok = tribox_sweep_rule(v[1], v[0], v[2], lo, hi, u, flags, &t[2], &t[3], NULL) == 1 &&
                 memcmp(t, t + 2, 2 * sizeof *t) == 0;
        }
        if (!CHECK(ok) && test_wants_details()) {
            print_scene(&s);
            printf("  t %a %a axis %a %a %a; truth %d start %d %d/%d %d/%d\n", (double)t[0], (double)t[1],
                   (double)x[0], (double)x[1], (double)x[2], r.hit, r.at_start, (int)r.first.n,
                   (int)r.first.d, (int)r.last.n, (int)r.last.d);
        }
    }
    CHECK(hits > i / 8 && hits < i - i / 8 && starts > i / 50);
}

/* Without OPEN, or with THIN, tribox_sweep_rule is tribox_sweep to the last bit. */
static void other_rules_are_closed(void)
{
    static const unsigned flags[6] = {0, TRIBOX_HALF_OPEN, TRIBOX_THIN, TRIBOX_THIN | TRIBOX_OPEN,
                                      TRIBOX_THIN | TRIBOX_OPEN | TRIBOX_HALF_OPEN, 0xfffffff9u};
    int i;
    random_seed(62);
    for (i = 0; i < TEST_LOOPS(3000); i++) {
        const float scale[3] = {any_scale(), 1, any_scale()};
        float v[3][3];
        float lo[3];
        float hi[3];
        float u[3];
        float closed[5] = {0, 0, 0, 0, 0};
        float rule[5] = {0, 0, 0, 0, 0};
        scene s;
        any_scene(&s, 5);
        scene_floats(&s, scale, v, lo, hi, u);
        CHECK(tribox_sweep(v[0], v[1], v[2], lo, hi, u, &closed[0], &closed[1], closed + 2) ==
              tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, flags[i % 6], &rule[0], &rule[1], rule + 2));
        CHECK(memcmp(closed, rule, sizeof rule) == 0);
    }
}

/* The issue that asked for this: a box that slides flush over a floor of two triangles meets no wall at their
 * seam, and one that lies a hair inside is told so. */
static void a_box_slides_over_a_seam(void)
{
    static const float v[4][3] = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
    const float lo[3] = {-2, -.5f, 0};
    const float hi[3] = {-1, .5f, 1};
    float lower[3] = {-2, -.5f, 0};
    float u[3] = {4, 1, 0};
    float t0 = 7;
    float x[3] = {9, 9, 9};
    CHECK(tribox_sweep(v[0], v[1], v[2], lo, hi, u, &t0, NULL, x) == 1);
    CHECK(tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, TRIBOX_OPEN, &t0, NULL, x) == 0);
    CHECK(tribox_sweep_rule(v[0], v[2], v[3], lo, hi, u, TRIBOX_OPEN, &t0, NULL, x) == 0);
    u[2] = -1e-30f;
    CHECK(tribox_sweep_rule(v[0], v[2], v[3], lo, hi, u, TRIBOX_OPEN, &t0, NULL, x) == 1);
    CHECK(t0 >= 0 && t0 <= 0 && x[2] > 0.9999f && x[2] < 1.0001f);
    u[2] = 0;
    lower[2] = -1e-45f;
    CHECK(tribox_sweep_rule(v[0], v[2], v[3], lower, hi, u, TRIBOX_OPEN, &t0, NULL, x) == 1);
    CHECK(t0 >= 0 && t0 <= 0 && x[0] >= 0 && x[0] <= 0 && x[2] <= 0);
}

/* An open flat box holds no point, whatever crosses it; an infinite one is all interior. */
static void open_sweeps_of_flat_and_infinite_boxes(void)
{
    static const float v[3][3] = {{0, 0, -1}, {1, 0, 2}, {0, 1, 2}};
    float lo[3] = {-1, -1, 0};
    float hi[3] = {2, 2, 0};
    float u[3] = {0, 0, 1};
    float t[2];
    float x[3];
    int a;
    CHECK(tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, TRIBOX_OPEN, t, t + 1, x) == 0);
    CHECK(tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, 0, t, t + 1, x) == 1);
    for (a = 0; a < 3; a++) {
        lo[a] = -infinity();
        hi[a] = infinity();
    }
    CHECK(tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, TRIBOX_OPEN, t, t + 1, x) == 1);
    CHECK(t[0] <= 0 && t[1] >= 1 && x[0] <= 0 && x[0] >= 0 && x[2] <= 0 && x[2] >= 0);
    lo[2] = 2;
    u[2] = -1;
    CHECK(tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, TRIBOX_OPEN, t, t + 1, x) == 1);
    CHECK(t[0] <= 0 && t[1] >= 1 && x[2] > 0.9999f);
    lo[2] = 3;
    CHECK(tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, TRIBOX_OPEN, t, t + 1, x) == 0);
    CHECK(tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, 0, t, t + 1, x) == 1);
    lo[2] = not_a_number();
    CHECK(tribox_sweep_rule(v[0], v[1], v[2], lo, hi, u, TRIBOX_OPEN, t, t + 1, x) == 0);
}

/* ---- box against box ----------------------------------------------------------------------------------- */

/* One axis by itself: a from lo[0] to hi[0] moving by u, b from lo[1] to hi[1]. */
typedef struct slab {
    int64_t lo[2];
    int64_t hi[2];
    int64_t u;
} slab;

/* Every integer slab and speed, both rules; the other axes always meet, or are the same motion in x, y, z. */
static void moving_boxes_are_exact(void)
{
    int i;
    int k;
    int hits = 0;
    random_seed(63);
    for (i = 0; i < TEST_LOOPS(60000); i++) {
        const int open = random_below(2);
        const unsigned flags = open ? TRIBOX_OPEN : random_below(2) ? TRIBOX_THIN | TRIBOX_OPEN : 1u;
        fraction first = {0, 1};
        fraction last = {1, 1};
        int64_t l[3] = {0, 0, 0};
        int axis = -1;
        int sides = 0; /* of the axis: bit 0 +, bit 1 - */
        int hit = 1;
        float a[2][3];
        float b[2][3];
        float u[3];
        float t[2] = {-7, -7};
        float x[3] = {9, 9, 9};
        slab s[3];
        int ok;
        for (k = 0; k < 3; k++) {
            const float scale = random_below(2) ? 1.0f : any_scale();
            int j;
            for (j = 0; j < 2; j++) {
                const int64_t p = random_below(5);
                const int64_t q = random_below(5);
                s[k].lo[j] = p < q ? p : q;
                s[k].hi[j] = p < q ? q : p;
            }
            s[k].u = random_below(9) - 4;
            a[0][k] = (float)s[k].lo[0] * scale;
            a[1][k] = (float)s[k].hi[0] * scale;
            b[0][k] = (float)s[k].lo[1] * scale;
            b[1][k] = (float)s[k].hi[1] * scale;
            u[k] = (float)s[k].u * scale;
            hit &= !(open && s[k].lo[0] == s[k].hi[0]);
            if (s[k].u == 0) {
                hit &= open ? s[k].lo[0] < s[k].hi[1] && s[k].hi[0] > s[k].lo[1]
                            : s[k].lo[0] <= s[k].hi[1] && s[k].hi[0] >= s[k].lo[1];
            } else {
                const int up = s[k].u > 0;
                const fraction in = make_fraction(up ? s[k].lo[1] - s[k].hi[0] : s[k].hi[1] - s[k].lo[0], s[k].u);
                const fraction out = make_fraction(up ? s[k].hi[1] - s[k].lo[0] : s[k].lo[1] - s[k].hi[0], s[k].u);
                const int later = fraction_order(in, first);
                if (later > 0 || (later == 0 && axis < 0)) {
                    axis = k;
                    sides = up ? 2 : 1;
                    first = in;
                }
                last = fraction_order(out, last) < 0 ? out : last;
            }
        }
        hit &= fraction_order(first, last) < !open;
        for (k = 0; k < 3 && axis < 0; k++) {
            sides = (s[k].lo[0] == s[k].hi[1]) | (s[k].hi[0] == s[k].lo[1]) << 1;
            axis = sides ? k : -1;
        }
        l[axis < 0 ? 0 : axis] = 1;
        hits += hit;
        ok = tribox_sweep_box(a[0], a[1], b[0], b[1], u, flags, &t[0], &t[1], x) == hit;
        if (ok && hit) {
            ok = floors_fraction(t[0], first) && ceils_fraction(t[1], last) &&
                 (axis < 0 ? memcmp(x, "\0\0\0\0\0\0\0\0\0\0\0\0", 12) == 0
                           : ((sides & 1) && is_unit_along(x, l, 1)) || ((sides & 2) && is_unit_along(x, l, -1)));
        } else if (ok) {
            ok = t[0] < -6 && t[1] < -6 && x[0] > 8;
        }
        CHECK(ok);
    }
    CHECK(hits > i / 8 && hits < i - i / 8);
}

/* Infinite faces of either, and what is no box. */
static void moving_boxes_without_a_question(void)
{
    float a[2][3] = {{0, 0, 0}, {1, 1, 1}};
    float b[2][3] = {{3, 0, 0}, {4, 1, 1}};
    float u[3] = {4, 0, 0};
    float t[2];
    float x[3];
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, 0, &t[0], &t[1], x) == 1);
    CHECK(t[0] >= .5f && t[0] <= .5f && t[1] >= 1 && x[0] < -0.9999f);
    b[1][0] = infinity();
    b[0][1] = b[0][2] = -infinity();
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, TRIBOX_OPEN, &t[0], &t[1], x) == 1);
    CHECK(t[0] >= .5f && t[0] <= .5f && t[1] >= 1 && x[0] < -0.9999f);
    a[0][0] = -infinity();
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, TRIBOX_OPEN, &t[0], &t[1], x) == 1);
    CHECK(t[0] >= .5f && t[0] <= .5f && t[1] >= 1 && x[0] < -0.9999f);
    b[0][0] = infinity();
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, 0, &t[0], &t[1], x) == 0);
    CHECK(tribox_sweep_box(b[0], b[1], a[0], a[1], u, 0, &t[0], &t[1], x) == 0);
    b[0][0] = 3;
    u[1] = infinity();
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, 0, NULL, NULL, NULL) == 0);
    u[1] = 0;
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, 0, NULL, NULL, NULL) == 1);
    b[1][2] = not_a_number();
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, 0, NULL, NULL, NULL) == 0);
    CHECK(tribox_sweep_box(b[0], b[1], a[0], a[1], u, 0, NULL, NULL, NULL) == 0);
}

/* ---- gap ----------------------------------------------------------------------------------------------- */

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

#define UNIT (-149) /* every float is a multiple of 2^-149 */

typedef struct gap_truth {
    int attained; /* 0: all directions are infinite */
    wide g;       /* the least (b - v).u over all corners */
    wide square;
    wide l[3];    /* u, not of unit length */
} gap_truth;

typedef struct pair {
    float v[3][3];
    float lo[3];
    float hi[3];
} pair;

static void wide_axis(const pair *p, int axis, int sign, wide l[3])
{
    const int i = axis < 4 ? 0 : (axis - 4) % 3;
    const int unit = axis < 4 ? axis : (axis - 4) / 3;
    static wide x[3];
    static wide y[3];
    static wide t;
    int a;
    for (a = 0; a < 3; a++) {
        oracle_integer(&x[a], exact(p->v[(i + 1) % 3][a]), UNIT);
        oracle_integer(&t, exact(p->v[i][a]), UNIT);
        wide_subtract(&x[a], &x[a], &t);
        if (axis == 3) {
            oracle_integer(&y[a], exact(p->v[2][a]), UNIT);
            wide_subtract(&y[a], &y[a], &t);
        } else {
            wide_set(&y[a], a == unit ? 1 : 0, a == unit, 0);
        }
    }
    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        if (axis < 3) {
            wide_set(&l[a], a == axis ? 1 : 0, a == axis, 0);
        } else {
            wide_multiply(&l[a], &x[b], &y[c]);
            wide_multiply(&t, &x[c], &y[b]);
            wide_subtract(&l[a], &l[a], &t);
        }
        l[a].sign *= sign;
    }
}

static int float_is_finite(float x)
{
    return float_order(x) > float_order(-infinity()) && float_order(x) < float_order(infinity());
}

/* The least (b - v).l over the 24 pairs of corners; 0 if a face that l uses is infinite. */
static int wide_least(const pair *p, const wide l[3], wide *least)
{
    static wide term;
    static wide dot;
    static wide x;
    static wide y;
    int i;
    int a;
    for (i = 0; i < 24; i++) {
        wide_set(&dot, 0, 0, 0);
        for (a = 0; a < 3; a++) {
            const float face = i >> a & 1 ? p->hi[a] : p->lo[a];
            if (l[a].sign != 0 && !float_is_finite(l[a].sign > 0 ? p->lo[a] : p->hi[a])) {
                return 0;
            }
            if (l[a].sign != 0) {
                oracle_integer(&x, float_is_finite(face) ? exact(face) : exact(l[a].sign > 0 ? p->lo[a] : p->hi[a]), UNIT);
                oracle_integer(&y, exact(p->v[i / 8][a]), UNIT);
                wide_subtract(&x, &x, &y);
                wide_multiply(&term, &x, &l[a]);
                wide_add(&dot, &dot, &term);
            }
        }
        if (i == 0 || wide_compare(&dot, least) < 0) {
            wide_copy(least, &dot);
        }
    }
    return 1;
}

/* The sign of a/|l_a| - b/|l_b|. */
static int wide_gap_order(const gap_truth *a, const gap_truth *b)
{
    static wide x;
    static wide of_a;
    static wide of_b;
    if (a->g.sign != b->g.sign) {
        return a->g.sign > b->g.sign ? 1 : -1;
    }
    wide_multiply(&x, &a->g, &a->g);
    wide_multiply(&of_a, &x, &b->square);
    wide_multiply(&x, &b->g, &b->g);
    wide_multiply(&of_b, &x, &a->square);
    return a->g.sign * wide_compare(&of_a, &of_b);
}

/* All 13 axes, those that are parallel included, and both directions of each, the positive one first. */
static void find_gap(const pair *p, gap_truth *best)
{
    static gap_truth next;
    int axis;
    int k;
    int way;
    best->attained = 0;
    for (axis = 0; axis < 13; axis++) {
        for (way = 0; way < 2; way++) {
            int sign;
            static wide x;
            wide_axis(p, axis, 1, next.l);
            sign = next.l[0].sign ? next.l[0].sign : next.l[1].sign ? next.l[1].sign : next.l[2].sign;
            if (sign == 0) {
                continue;
            }
            wide_axis(p, axis, way ? -sign : sign, next.l);
            if (!wide_least(p, next.l, &next.g)) {
                continue;
            }
            wide_set(&next.square, 0, 0, 0);
            for (k = 0; k < 3; k++) {
                wide_multiply(&x, &next.l[k], &next.l[k]);
                wide_add(&next.square, &next.square, &x);
            }
            next.attained = 1;
            if (!best->attained || wide_gap_order(&next, best) > 0) {
                *best = next;
            }
        }
    }
}

/* (|s| (1 - 2^-40))^2 |l|^2 <= g^2 <= (|s| (1 + 2^-40))^2 |l|^2 */
static int gap_is_near(double s, const gap_truth *truth)
{
    const oracle_number n = oracle_read(&s);
    static wide x;
    static wide y;
    static wide of_g;
    static wide of_s;
    int way;
    if (n.sign != truth->g.sign || n.is_nan || n.is_infinite) {
        return 0;
    }
    for (way = -1; way <= 1 && n.sign != 0; way += 2) {
        const int shift = 2 * (n.exponent - UNIT);
        wide_set(&x, 1, ((uint64_t)1 << 40) + (uint64_t)(int64_t)way, 0);
        wide_set(&y, 1, n.mantissa, 0);
        wide_multiply(&of_g, &x, &y);
        wide_multiply(&x, &of_g, &of_g);
        wide_set(&y, 1, 1, shift > 0 ? shift : 0);
        wide_multiply(&of_g, &x, &y);
        wide_multiply(&of_s, &of_g, &truth->square);
        wide_multiply(&x, &truth->g, &truth->g);
        wide_set(&y, 1, 1, 80 + (shift < 0 ? -shift : 0));
        wide_multiply(&of_g, &x, &y);
        if (wide_compare(&of_s, &of_g) * way < 0) {
            return 0;
        }
    }
    return 1;
}

/* The vector as doubles of at most 1, by its leading bits. */
static void wide_direction(const wide l[3], double out[3])
{
    int most = 0;
    int k;
    int i;
    for (k = 0; k < 3; k++) {
        most = l[k].count > most ? l[k].count : most;
    }
    for (k = 0; k < 3; k++) {
        out[k] = 0;
        for (i = most > 4 ? most - 4 : 0; i < most; i++) {
            out[k] = (out[k] + (i < l[k].count ? (double)l[k].limb[i] : 0)) / 4294967296.0;
        }
        out[k] *= l[k].sign;
    }
}

static int is_unit_vector(const float x[3], const double l[3])
{
    double length2 = 0;
    double l2 = 0;
    double dot = 0;
    double cross2 = 0;
    int a;
    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        const double cross = (double)x[b] * l[c] - (double)x[c] * l[b];
        length2 += (double)x[a] * (double)x[a];
        l2 += l[a] * l[a];
        dot += (double)x[a] * l[a];
        cross2 += cross * cross;
    }
    return length2 > 1 - 2 / 4194304.0 && length2 < 1 + 2 / 4194304.0 && dot > 0 &&
           cross2 <= l2 / (4194304.0 * 4194304.0);
}

static int gap_is_right(const pair *p)
{
    static gap_truth truth;
    float x[3] = {9, 9, 9};
    const double s = tribox_gap(p->v[0], p->v[1], p->v[2], p->lo, p->hi, x);
    const oracle_number n = oracle_read(&s);
    double l[3];
    int k;
    int flat = 0;
    int ok;
    find_gap(p, &truth);
    if (!truth.attained) {
        return n.is_infinite && n.sign < 0 && x[0] > 8 && x[1] > 8 && x[2] > 8;
    }
    wide_direction(truth.l, l);
    for (k = 0; k < 3; k++) {
        flat |= float_order(p->lo[k]) == float_order(p->hi[k]);
    }
    ok = gap_is_near(s, &truth) && is_unit_vector(x, l) &&
         (n.sign > 0) == !tribox_overlap(p->v[0], p->v[1], p->v[2], p->lo, p->hi) &&
         (flat ||
          (n.sign < 0) == tribox_overlap_rule(p->v[0], p->v[1], p->v[2], p->lo, p->hi, TRIBOX_OPEN));
    if (!ok && test_wants_details()) {
        for (k = 0; k < 3; k++) {
            printf("  v%d {%a, %a, %a}\n", k, (double)p->v[k][0], (double)p->v[k][1], (double)p->v[k][2]);
        }
        printf("  lo {%a, %a, %a}\n  hi {%a, %a, %a}\n", (double)p->lo[0], (double)p->lo[1], (double)p->lo[2],
               (double)p->hi[0], (double)p->hi[1], (double)p->hi[2]);
        printf("  s %a axis %a %a %a; truth sign %d axis %g %g %g\n", s, (double)x[0], (double)x[1],
               (double)x[2], truth.g.sign, l[0], l[1], l[2]);
    }
    return ok;
}

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

static void any_pair(pair *p, int kind)
{
    int a;
    int i;
    for (a = 0; a < 3; a++) {
        const float x = any_float(kind);
        const float y = random_below(8) ? any_float(kind) : x;
        p->lo[a] = lesser(x, y);
        p->hi[a] = greater(x, y);
        for (i = 0; i < 3; i++) {
            p->v[i][a] = any_float(kind);
        }
    }
    if (random_below(8) == 0) { /* a segment, a level triangle, a ramp */
        memcpy(p->v[2], p->v[random_below(2)], sizeof p->v[2]);
    } else if (random_below(4) == 0) {
        a = random_below(3);
        p->v[1][a] = p->v[0][a];
        if (random_below(2)) {
            p->v[2][a] = p->v[0][a];
        } else {
            p->v[1][(a + 1) % 3] = p->v[0][(a + 1) % 3];
        }
    }
    if (random_below(16) == 0) {
        a = random_below(3);
        *(random_below(2) ? &p->lo[a] : &p->hi[a]) = a == 0 ? p->lo[a] : p->v[1][a];
        p->hi[a] = greater(p->lo[a], p->hi[a]);
    }
    for (a = 0; a < 3 && random_below(12) == 0; a++) {
        if (random_below(2)) {
            p->lo[a] = -infinity();
        }
        if (random_below(2)) {
            p->hi[a] = infinity();
        }
    }
}

/* Floats of any kind, so also ties of all kinds; every exponent; infinite faces. */
static void gaps_are_exact(void)
{
    int i;
    random_seed(64);
    for (i = 0; i < TEST_LOOPS(8000); i++) {
        pair p;
        any_pair(&p, i % 4);
        CHECK(gap_is_right(&p));
    }
}

/* On a lattice that no longer fits doubles' products, the same at every power of two. */
static void gaps_on_a_lattice(void)
{
    int i;
    int k;
    random_seed(65);
    for (i = 0; i < TEST_LOOPS(6000); i++) {
        scene s;
        pair p;
        float u[3];
        float scale[3];
        scale[0] = scale[1] = scale[2] = any_scale();
        if (random_below(2)) {
            scale[1] = any_scale();
        }
        any_scene(&s, 2 + random_below(7));
        scene_floats(&s, scale, p.v, p.lo, p.hi, u);
        if (random_below(4) == 0) {
            k = random_below(9);
            p.v[k / 3][k % 3] = nudge_float(p.v[k / 3][k % 3], random_below(3) - 1);
        }
        CHECK(gap_is_right(&p));
    }
}

/* Slivers and needles: normals and edges that are nearly 0 beside the rest. */
static void gaps_of_slivers(void)
{
    int i;
    int a;
    random_seed(66);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        const double thin = power_of_two(-random_below(30));
        pair p;
        any_pair(&p, 2);
        for (a = 0; a < 3; a++) {
            const double w = random_signed();
            p.v[2][a] = (float)((double)p.v[0][a] + w * ((double)p.v[1][a] - (double)p.v[0][a]) +
                                thin * random_signed());
            if (i % 3 == 0) {
                p.v[1][a] = (float)((double)p.v[0][a] + thin * random_signed());
            }
        }
        CHECK(gap_is_right(&p));
    }
}

/* A box's corner is all but on the face, so the sum that is s loses most of its digits: it is told to 2^-40 where
 * double does not suffice, and, if one number is much smaller than the others, nor do 128 bits. */
static void gaps_next_to_a_face(void)
{
    int i;
    int a;
    random_seed(72);
    for (i = 0; i < TEST_LOOPS(2000); i++) {
        const double of_x = 0.2 + 0.1 * random_signed();
        const double of_y = 0.2 + 0.1 * random_signed();
        const int way = random_below(2);
        double x[3];
        double y[3];
        pair p;
        for (a = 0; a < 9; a++) {
            p.v[a / 3][a % 3] = any_float(2);
        }
        if (i % 2) {
            a = random_below(9);
            p.v[a / 3][a % 3] *= 3.814697265625e-06f; /* 2^-18 */
        }
        for (a = 0; a < 3; a++) {
            x[a] = (double)p.v[1][a] - (double)p.v[0][a];
            y[a] = (double)p.v[2][a] - (double)p.v[0][a];
        }
        for (a = 0; a < 3; a++) {
            const int b = (a + 1) % 3;
            const int c = (a + 2) % 3;
            const float at = (float)((double)p.v[0][a] + of_x * x[a] + of_y * y[a]);
            const float size = any_float(2);
            const int up = (x[b] * y[c] - x[c] * y[b] > 0) == way;
            p.lo[a] = up ? at : at - (size < 0 ? -size : size);
            p.hi[a] = up ? at + (size < 0 ? -size : size) : at;
        }
        CHECK(gap_is_right(&p));
    }
}

/* A small box past whose middle a large triangle's edge goes: it leaves by that edge, whose third corner is far
 * away on the other side. */
static void gaps_of_small_boxes_at_edges(void)
{
    int i;
    int a;
    random_seed(73);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        const double along = 0.5 + 0.25 * random_signed();
        pair p;
        for (a = 0; a < 9; a++) {
            p.v[a / 3][a % 3] = 2048 * any_float(2);
        }
        for (a = 0; a < 3; a++) {
            const double at = (double)p.v[0][a] + along * ((double)p.v[1][a] - (double)p.v[0][a]);
            p.lo[a] = (float)(at - 0.5 + 0.2 * random_signed());
            p.hi[a] = p.lo[a] + 1;
        }
        CHECK(gap_is_right(&p));
    }
}

/* Nothing, and everything. */
static void gaps_without_a_question(void)
{
    pair p = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 0, 2}, {1, 1, 3}};
    float x[3] = {9, 9, 9};
    double s = tribox_gap(p.v[0], p.v[1], p.v[2], p.lo, p.hi, NULL);
    int i;
    CHECK(s > 1.999999 && s < 2.000001);
    for (i = 0; i < 15; i++) {
        float *at = i < 9 ? &p.v[i / 3][i % 3] : i < 12 ? &p.lo[i - 9] : &p.hi[i - 12];
        const float was = *at;
        *at = not_a_number();
        s = tribox_gap(p.v[0], p.v[1], p.v[2], p.lo, p.hi, x);
        CHECK(oracle_read(&s).is_infinite && oracle_read(&s).sign > 0 && x[0] > 8);
        *at = i >= 9 && i < 12 ? infinity() : -infinity();
        s = tribox_gap(p.v[0], p.v[1], p.v[2], p.lo, p.hi, x);
        CHECK(oracle_read(&s).is_infinite && oracle_read(&s).sign > 0 && x[0] > 8);
        *at = i >= 9 && i < 12 ? 4.0f : -4.0f;
        s = tribox_gap(p.v[0], p.v[1], p.v[2], p.lo, p.hi, x);
        CHECK(i < 9 ? !oracle_read(&s).is_infinite : oracle_read(&s).is_infinite && x[0] > 8);
        *at = was;
        x[0] = 9;
    }
    for (i = 0; i < 3; i++) {
        p.lo[i] = -infinity();
        p.hi[i] = infinity();
    }
    s = tribox_gap(p.v[0], p.v[1], p.v[2], p.lo, p.hi, x);
    CHECK(oracle_read(&s).is_infinite && oracle_read(&s).sign < 0 && x[0] > 8);
    p.hi[1] = -2;
    s = tribox_gap(p.v[0], p.v[1], p.v[2], p.lo, p.hi, x);
    CHECK(s > 1.999999 && s < 2.000001 && x[1] < -0.9999f);
}

/* ---- segments through grids ---------------------------------------------------------------------------- */

#define EDGE 5 /* voxels of the region on each axis */

/* On a lattice: one axis of grid and segment, in small integers. */
typedef struct way {
    int64_t origin;
    int64_t size;
    int64_t p;
    int64_t q;
    int lo;
    int hi;
} way;

/* The t in [0, 1] of one voxel on one axis or on all. Strict ends do not belong. */
typedef struct span_of_t {
    fraction from;
    fraction to;
    int from_strict;
    int to_strict;
    fraction entry; /* where the closed voxel is entered */
    int none;
} span_of_t;

static void narrow_from(span_of_t *r, fraction t, int strict)
{
    const int order = fraction_order(t, r->from);
    if (order >= 0) {
        r->from_strict = order > 0 ? strict : r->from_strict | strict;
        r->from = t;
    }
    r->entry = fraction_order(t, r->entry) > 0 ? t : r->entry;
}

static void narrow_to(span_of_t *r, fraction t, int strict)
{
    const int order = fraction_order(t, r->to);
    if (order <= 0) {
        r->to_strict = order < 0 ? strict : r->to_strict | strict;
        r->to = t;
    }
}

/* rule: 0 closed, 1 half-open, 2 open */
static void narrow(span_of_t *r, const way *w, int voxel, int rule)
{
    const int64_t lower = w->origin + voxel * w->size;
    const int64_t upper = lower + w->size;
    const int64_t d = w->q - w->p;
    const int lower_strict = rule == 2;
    const int upper_strict = rule != 0;
    if (d == 0) {
        r->none |= w->p < lower + lower_strict || w->p > upper - upper_strict;
    } else {
        narrow_from(r, make_fraction(d > 0 ? lower - w->p : upper - w->p, d), d > 0 ? lower_strict : upper_strict);
        narrow_to(r, make_fraction(d > 0 ? upper - w->p : lower - w->p, d), d > 0 ? upper_strict : lower_strict);
    }
}

typedef struct passed {
    fraction entry;
    int at[3];
} passed;

static int passed_before(const passed *a, const passed *b, const way w[3])
{
    const int order = fraction_order(a->entry, b->entry);
    int k;
    for (k = 2; k >= 0 && order == 0; k--) {
        if (a->at[k] != b->at[k]) {
            return (a->at[k] < b->at[k]) == (w[k].q >= w[k].p);
        }
    }
    return order < 0;
}

/* Every voxel of the region asked for itself; sorted. */
static int find_passed(const way w[3], int rule, passed *out)
{
    int count = 0;
    int at[3];
    int k;
    for (at[2] = w[2].lo; at[2] < w[2].hi; at[2]++) {
        for (at[1] = w[1].lo; at[1] < w[1].hi; at[1]++) {
            for (at[0] = w[0].lo; at[0] < w[0].hi; at[0]++) {
                span_of_t r = {{0, 1}, {1, 1}, 0, 0, {0, 1}, 0};
                passed v;
                int i;
                int order;
                for (k = 0; k < 3; k++) {
                    narrow(&r, &w[k], at[k], rule);
                }
                order = fraction_order(r.from, r.to);
                if (r.none || order > 0 || (order == 0 && (r.from_strict || r.to_strict))) {
                    continue;
                }
                v.entry = r.entry;
                memcpy(v.at, at, sizeof at);
                for (i = count++; i > 0 && passed_before(&v, &out[i - 1], w); i--) {
                    out[i] = out[i - 1];
                }
                out[i] = v;
            }
        }
    }
    return count;
}

typedef struct walked {
    int at[EDGE * EDGE * EDGE + 1][3];
    int count;
    int stop_at; /* non-zero is returned there */
} walked;

static int walk(void *user, int x, int y, int z)
{
    walked *w = (walked *)user;
    if (w->count <= EDGE * EDGE * EDGE) {
        w->at[w->count][0] = x;
        w->at[w->count][1] = y;
        w->at[w->count][2] = z;
    }
    w->count++;
    return w->count == w->stop_at;
}

static void any_way(way *w)
{
    const int reach = 1 + random_below(3); /* lattice of whole, half or third voxels */
    w->size = reach;
    w->origin = random_below(7) - 3;
    w->lo = random_below(7) - 3;
    w->hi = w->lo + 1 + random_below(EDGE);
    w->p = w->origin + w->lo * w->size + random_below((int)((w->hi - w->lo + 4) * w->size)) - 2 * w->size;
    w->q = w->origin + w->lo * w->size + random_below((int)((w->hi - w->lo + 4) * w->size)) - 2 * w->size;
    if (random_below(5) == 0) {
        w->q = w->p;
    }
}

/* Every rule, on a lattice, where many planes are crossed at once, begun and ended on planes; at scales at which
 * doubles round. */
static void segments_pass_voxels_in_order(void)
{
    static const unsigned flags[8] = {0, TRIBOX_HALF_OPEN, TRIBOX_OPEN, TRIBOX_OPEN | TRIBOX_HALF_OPEN,
                                      TRIBOX_THIN, TRIBOX_THIN | TRIBOX_OPEN | TRIBOX_HALF_OPEN, 8u, 0xfffffff9u};
    static const int rules[8] = {0, 1, 2, 2, 0, 0, 0, 1};
    int i;
    int k;
    int hits = 0;
    random_seed(67);
    for (i = 0; i < TEST_LOOPS(40000); i++) {
        static passed truth[EDGE * EDGE * EDGE];
        static walked got;
        const int kind = random_below(8);
        tribox_grid grid;
        double p[3];
        double q[3];
        way w[3];
        int count;
        int ok;
        for (k = 0; k < 3; k++) {
            double scale = 1;
            if (random_below(2)) {
                scale = (double)(134217729 + 2 * random_below(1 << 20)) * power_of_two(random_below(1800) - 950);
            }
            any_way(&w[k]);
            if (random_below(4) == 0 && k > 0) {
                w[k] = w[k - 1];
            }
            grid.origin[k] = (double)w[k].origin * scale;
            grid.size[k] = (double)w[k].size * scale;
            p[k] = (double)w[k].p * scale;
            q[k] = (double)w[k].q * scale;
            grid.lo[k] = w[k].lo;
            grid.hi[k] = w[k].hi;
        }
        grid.flags = flags[kind];
        count = find_passed(w, rules[kind], truth);
        hits += count > 0;
        got.count = 0;
        got.stop_at = -1;
        ok = tribox_grid_segment(&grid, p, q, walk, &got) == (size_t)count && got.count == count;
        for (k = 0; k < count && ok; k++) {
            ok = memcmp(got.at[k], truth[k].at, sizeof truth[k].at) == 0;
        }
        ok = ok && tribox_grid_segment(&grid, p, q, NULL, NULL) == (size_t)count;
        if (ok && count > 0) {
            got.stop_at = 1 + random_below(count);
            got.count = 0;
            ok = tribox_grid_segment(&grid, p, q, walk, &got) == (size_t)got.stop_at && got.count == got.stop_at;
        }
        if (!CHECK(ok) && test_wants_details()) {
            for (k = 0; k < 3; k++) {
                printf("  axis %d: origin %d size %d p %d q %d region %d..%d\n", k, (int)w[k].origin,
                       (int)w[k].size, (int)w[k].p, (int)w[k].q, w[k].lo, w[k].hi);
            }
            printf("  flags %x: %d voxels, truth %d:", grid.flags, got.count, count);
            for (k = 0; k < count || k < got.count; k++) {
                if (k < count) {
                    printf(" (%d %d %d)", truth[k].at[0], truth[k].at[1], truth[k].at[2]);
                }
                if (k < got.count) {
                    printf("[%d %d %d]", got.at[k][0], got.at[k][1], got.at[k][2]);
                }
            }
            printf("\n");
        }
    }
    CHECK(hits > i / 4 && hits < i - i / 8);
}

/* Where one axis is left to the integers, the others' larger error still counts. */
static void segments_of_any_magnitude_are_in_order(void)
{
    const tribox_grid grid = {{-9.75, -58, 15}, {.25, 2, .5}, {30, 20, -40}, {50, 40, -20}, 0};
    const double p[3] = {-power_of_two(-271), power_of_two(-519), power_of_two(-468)};
    const double q[3] = {power_of_two(-65), -power_of_two(-178), power_of_two(-230)};
    const tribox_grid part = {{-9.75, -58, 15}, {.25, 2, .5}, {35, 29, -34}, {40, 34, -29}, 0};
    const double from[3] = {-0x1.1c1f190158a51p-271, 0x1.51714e012436p-519, 0x1.264524f363dabp-468};
    const double to[3] = {0x1.2a91dc2da2ed9p-65, -0x1.00332edf9c1abp-178, 0x1.fea57ea9f10d2p-230};
    walked got;
    got.count = 0;
    got.stop_at = -1;
    CHECK(tribox_grid_segment(&grid, p, q, walk, &got) == 3);
    CHECK(got.at[0][0] == 38 && got.at[0][1] == 29 && got.at[1][0] == 38 && got.at[1][1] == 28 && got.at[2][0] == 39);
    CHECK(tribox_grid_segment(&part, from, to, NULL, NULL) == 1); /* an axis left to integers keeps the others' error */
}

/* What lies outside of the region costs nothing, and INT_MAX voxels are counted; what is no number is nothing. */
static void segments_far_and_none(void)
{
    tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {2, 2, 2}, 0};
    double p[3] = {-power_of_two(1000), .5, .5};
    double q[3] = {power_of_two(1000), .5, .5};
    walked got;
    int k;
    got.count = 0;
    got.stop_at = -1;
    CHECK(tribox_grid_segment(&grid, p, q, walk, &got) == 2 && got.at[0][0] == 0 && got.at[1][0] == 1);
    grid.flags = TRIBOX_OPEN;
    p[2] = q[2] = 1;
    grid.lo[0] = -2147483647 - 1;
    grid.hi[0] = 2147483647;
    CHECK(tribox_grid_segment(&grid, p, q, NULL, NULL) == 0);
    grid.flags = 0;
    p[0] = -10;
    q[0] = 1e4;
    CHECK(tribox_grid_segment(&grid, p, q, NULL, NULL) == 2 * (11 + 10001)); /* both ends on planes */
    for (k = 0; k < 9; k++) {
        double *at = k < 3 ? &p[k] : k < 6 ? &q[k - 3] : &grid.size[k - 6];
        const double was = *at;
        *at = k < 6 ? (double)infinity() : -1.0;
        CHECK(tribox_grid_segment(&grid, p, q, NULL, NULL) == 0);
        *at = (double)not_a_number();
        CHECK(tribox_grid_segment(&grid, p, q, NULL, NULL) == 0);
        *at = was;
    }
    grid.hi[1] = grid.lo[1];
    CHECK(tribox_grid_segment(&grid, p, q, NULL, NULL) == 0);
}

/* Any doubles: under HALF_OPEN the voxels form a path of neighbours from the end's to the other's, and are those
 * of tribox_grid_spans for the segment as a triangle; closed, as many as its spans hold. */
static void segments_are_thin_triangles(void)
{
    int i;
    int k;
    random_seed(68);
    for (i = 0; i < TEST_LOOPS(6000); i++) {
        tribox_grid grid;
        double p[3];
        double q[3];
        for (k = 0; k < 3; k++) {
            const double scale = random_below(3) ? 1.0 : power_of_two(random_below(600) - 300);
            grid.size[k] = (0.1 + (double)random_below(100) / 100.0) * scale;
            grid.origin[k] = random_signed() * 3 * scale;
            p[k] = random_signed() * 4 * scale;
            q[k] = random_below(6) ? random_signed() * 4 * scale : p[k];
            grid.lo[k] = random_below(10) - 9;
            grid.hi[k] = grid.lo[k] + 1 + random_below(12);
        }
        for (k = 0; k < 3; k++) {
            grid.flags = (1u << k) >> 1;
            CHECK(tribox_grid_segment(&grid, p, q, NULL, NULL) ==
                  tribox_grid_spans_f64(&grid, p, q, q, NULL, NULL));
        }
    }
}

/* ---- spheres ------------------------------------------------------------------------------------------- */

/* out = sum of (a - b)^2, of floats, in units of 2^-298 */
static void wide_square_distance(wide *out, const float a[3], const float b[3])
{
    static wide x;
    static wide y;
    int k;
    wide_set(out, 0, 0, 0);
    for (k = 0; k < 3; k++) {
        oracle_integer(&x, exact(a[k]), UNIT);
        oracle_integer(&y, exact(b[k]), UNIT);
        wide_subtract(&x, &x, &y);
        wide_multiply(&y, &x, &x);
        wide_add(out, out, &y);
    }
}

/* A radius that is about, or exactly, the root of x: squares of a lattice have many whole roots. */
static float radius_about(double square)
{
    double r = square > 0 ? square : 0;
    int i;
    for (i = 0; i < 60 && square > 0; i++) {
        r = 0.5 * (r + square / r);
    }
    return nudge_float((float)(r < 1e30 ? r : 1e30), random_below(3) - 1);
}

static double about_square_distance(const float a[3], const float b[3])
{
    double sum = 0;
    int k;
    for (k = 0; k < 3; k++) {
        sum += ((double)a[k] - (double)b[k]) * ((double)a[k] - (double)b[k]);
    }
    return sum;
}

/* Balls, boxes, planes: half of them within a float of touching. */
static void spheres_are_exact(void)
{
    static wide square;
    static wide r;
    static wide of_b;
    static wide rr;
    static wide v;
    int i;
    int k;
    random_seed(69);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        const int kind = i % 4;
        float a[3];
        float b[3];
        float lo[3];
        float hi[3];
        float nearest[3];
        float d;
        float ra = (float)(random_below(4) ? 1 : 0) * (float)((double)any_float(kind == 3 ? 2 : kind));
        float rb;
        ra = ra < 0 ? -ra : ra;
        for (k = 0; k < 3; k++) {
            const float x = any_float(kind);
            const float y = any_float(kind);
            a[k] = any_float(kind);
            b[k] = any_float(kind);
            lo[k] = lesser(x, y);
            hi[k] = greater(x, y);
            nearest[k] = lesser(greater(a[k], lo[k]), hi[k]);
        }
        rb = radius_about(about_square_distance(a, b)) - ra;
        rb = rb > 0 ? rb : 0;
        wide_square_distance(&square, a, b);
        oracle_integer(&r, exact(ra), UNIT);
        oracle_integer(&of_b, exact(rb), UNIT);
        wide_add(&r, &r, &of_b);
        wide_multiply(&rr, &r, &r);
        CHECK(tribox_sphere_sphere(a, ra, b, rb) == (wide_compare(&square, &rr) <= 0));
        CHECK(tribox_sphere_sphere(b, rb, a, ra) == (wide_compare(&square, &rr) <= 0));
        rb = radius_about(about_square_distance(a, nearest));
        wide_square_distance(&square, a, nearest);
        oracle_integer(&r, exact(rb), UNIT);
        wide_multiply(&rr, &r, &r);
        CHECK(tribox_sphere_box(a, rb, lo, hi) == (rb >= 0 && wide_compare(&square, &rr) <= 0));
        /* n = b: v = b.a + d, against r |b| */
        wide_set(&v, 0, 0, 0);
        for (k = 0; k < 3; k++) {
            oracle_integer(&r, exact(a[k]), UNIT);
            oracle_integer(&of_b, exact(b[k]), UNIT);
            wide_multiply(&rr, &r, &of_b);
            wide_add(&v, &v, &rr);
        }
        d = random_below(2) ? any_float(kind) : (float)(rb * b[0] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]);
        if (float_is_finite(d)) {
            int sign;
            int truth;
            oracle_integer(&r, exact(d), 2 * UNIT);
            wide_add(&v, &v, &r);
            sign = v.sign;
            wide_multiply(&rr, &v, &v);
            wide_set(&square, 0, 0, 0);
            for (k = 0; k < 3; k++) {
                oracle_integer(&r, exact(b[k]), UNIT);
                wide_multiply(&of_b, &r, &r);
                wide_add(&square, &square, &of_b);
            }
            oracle_integer(&r, exact(rb), UNIT);
            wide_multiply(&of_b, &r, &r);
            wide_multiply(&r, &of_b, &square);
            truth = wide_compare(&rr, &r) > 0 ? sign : 0;
            if (square.sign == 0) {
                truth = (float_order(d) > 0) - (float_order(d) < 0);
            }
            CHECK(rb < 0 || tribox_plane_sphere(b, d, a, rb) == truth);
        }
    }
}

/* One sphere is so small that sums of radii and of squares lose in double what decides. */
static void large_and_small_spheres_are_exact(void)
{
    static const float origin[3] = {0, 0, 0};
    static wide square;
    static wide sum;
    static wide r;
    int i;
    random_seed(74);
    for (i = 0; i < TEST_LOOPS(6400); i++) {
        const float x = 1.5f + 0.5f * any_float(2);
        const double y = (1.5 + 0.5 * random_signed()) * power_of_two(-20);
        float at[3] = {0, 0, 0};
        float radius;
        at[i % 3] = x;
        at[(i + 1) % 3] = (float)y;
        radius = nudge_float((float)(y * y / (2 * (double)x)), random_below(3) - 1);
        wide_square_distance(&square, at, origin);
        oracle_integer(&sum, exact(x), UNIT);
        oracle_integer(&r, exact(radius), UNIT);
        wide_add(&sum, &sum, &r);
        wide_multiply(&r, &sum, &sum);
        CHECK(tribox_sphere_sphere(at, x, origin, radius) == (wide_compare(&square, &r) <= 0));
        CHECK(tribox_sphere_sphere(at, radius, origin, x) == (wide_compare(&square, &r) <= 0));
    }
}

/* A box of min above max holds no point: a sphere that reaches both faces touches nothing. */
static void spheres_miss_boxes_of_min_above_max(void)
{
    const float c[3] = {.5f, 1.5f, 1.5f};
    int a;
    for (a = 0; a < 3; a++) {
        float lo[3] = {1, 1, 1};
        float hi[3] = {2, 2, 2};
        CHECK(tribox_sphere_box(c, 5, lo, hi) == 1);
        hi[a] = .75f;
        CHECK(tribox_sphere_box(c, 5, lo, hi) == 0);
        CHECK(tribox_sphere_box(c, 1e-6f, lo, hi) == 0);
    }
}

/* The square of the distance to a triangle on a lattice: the least over corners, edges whose foot lies on them,
 * and the face if the foot lies in it. */
static fraction triangle_distance(int64_t v[3][3], const int64_t c[3])
{
    fraction best = {INT32_MAX, 1};
    int64_t e[3][3];
    int64_t n[3];
    int64_t nn = 0;
    int64_t height = 0;
    int inside = 1;
    int i;
    int k;
    for (i = 0; i < 3; i++) {
        int64_t dd = 0;
        int64_t along = 0;
        int64_t ee = 0;
        fraction f;
        for (k = 0; k < 3; k++) {
            const int64_t d = c[k] - v[i][k];
            e[i][k] = v[(i + 1) % 3][k] - v[i][k];
            dd += d * d;
            along += d * e[i][k];
            ee += e[i][k] * e[i][k];
        }
        f = make_fraction(dd, 1);
        best = fraction_order(f, best) < 0 ? f : best;
        if (ee > 0 && along >= 0 && along <= ee) {
            f = make_fraction(dd * ee - along * along, ee);
            best = fraction_order(f, best) < 0 ? f : best;
        }
    }
    for (k = 0; k < 3; k++) {
        const int b = (k + 1) % 3;
        const int a = (k + 2) % 3;
        n[k] = e[0][b] * e[1][a] - e[0][a] * e[1][b];
        nn += n[k] * n[k];
        height += n[k] * (c[k] - v[0][k]);
    }
    for (i = 0; i < 3; i++) {
        int64_t side = 0;
        for (k = 0; k < 3; k++) {
            const int b = (k + 1) % 3;
            const int a = (k + 2) % 3;
            side += n[k] * (e[i][b] * (c[a] - v[i][a]) - e[i][a] * (c[b] - v[i][b]));
        }
        inside &= side >= 0;
    }
    if (nn > 0 && inside) {
        const fraction f = make_fraction(height * height, nn);
        best = fraction_order(f, best) < 0 ? f : best;
    }
    return best;
}

/* On a lattice, with radii that touch exactly, and those beside; at scales at which doubles round. */
static void spheres_and_triangles_are_exact(void)
{
    int touches = 0;
    int i;
    int k;
    random_seed(70);
    for (i = 0; i < TEST_LOOPS(30000); i++) {
        const float scale = random_below(2) ? 1.0f : any_scale() / 64.0f;
        const int n = 3 + random_below(6);
        int64_t v[3][3];
        int64_t c[3];
        float corner[3][3];
        float center[3];
        float radius;
        fraction distance;
        int64_t r = random_below(2 * n);
        int truth;
        for (k = 0; k < 9; k++) {
            v[k / 3][k % 3] = random_below(n);
            c[k % 3] = random_below(n);
        }
        if (random_below(8) == 0) {
            memcpy(v[2], v[random_below(2)], sizeof v[2]);
        }
        distance = triangle_distance(v, c);
        if (random_below(2)) { /* a whole root nearby, if there is one */
            for (r = 0; r * r * distance.d < distance.n; r++) {
            }
        }
        truth = distance.n - r * r * distance.d <= 0;
        touches += distance.n == r * r * distance.d;
        for (k = 0; k < 9; k++) {
            corner[k / 3][k % 3] = (float)v[k / 3][k % 3] * scale;
            center[k % 3] = (float)c[k % 3] * scale;
        }
        radius = (float)r * scale;
        if (!CHECK(tribox_sphere_triangle(center, radius, corner[0], corner[1], corner[2]) == truth) &&
            test_wants_details()) {
            for (k = 0; k < 3; k++) {
                printf("  v%d {%d, %d, %d}", k, (int)v[k][0], (int)v[k][1], (int)v[k][2]);
            }
            printf(" c {%d, %d, %d} r %d * %a: distance^2 %d/%d\n", (int)c[0], (int)c[1], (int)c[2], (int)r,
                   (double)scale, (int)distance.n, (int)distance.d);
        }
        if (distance.n == r * r * distance.d && r > 0) {
            CHECK(tribox_sphere_triangle(center, nudge_float(radius, -1), corner[1], corner[0], corner[2]) == 0);
            CHECK(tribox_sphere_triangle(center, nudge_float(radius, 1), corner[2], corner[0], corner[1]) == 1);
        }
    }
    CHECK(touches > i / 50);
}

/* A triangle of 2^23 and a point of it, rounded: where the radius is its distance to the plane as a float, double
 * errs by more than what is left. */
static void small_spheres_and_large_triangles_are_exact(void)
{
    int touches = 0;
    int i;
    int a;
    random_seed(75);
    for (i = 0; i < TEST_LOOPS(6400); i++) {
        static wide l[3];
        static wide dot;
        static wide square;
        static wide x;
        static wide y;
        const double of_x = 0.3 + 0.1 * random_signed();
        const double of_y = 0.3 + 0.1 * random_signed();
        double e[3];
        double f[3];
        double d = 0;
        double nn = 0;
        float c[3];
        float radius;
        int truth;
        pair p;
        for (a = 0; a < 9; a++) {
            p.v[a / 3][a % 3] = 8388608 * any_float(2);
        }
        for (a = 0; a < 3; a++) {
            e[a] = (double)p.v[1][a] - (double)p.v[0][a];
            f[a] = (double)p.v[2][a] - (double)p.v[0][a];
            c[a] = (float)((double)p.v[0][a] + of_x * e[a] + of_y * f[a]);
        }
        wide_axis(&p, 3, 1, l);
        wide_set(&dot, 0, 0, 0);
        wide_set(&square, 0, 0, 0);
        for (a = 0; a < 3; a++) {
            const double n = e[(a + 1) % 3] * f[(a + 2) % 3] - e[(a + 2) % 3] * f[(a + 1) % 3];
            d += n * ((double)c[a] - (double)p.v[0][a]);
            nn += n * n;
            oracle_integer(&x, exact(c[a]), UNIT);
            oracle_integer(&y, exact(p.v[0][a]), UNIT);
            wide_subtract(&x, &x, &y);
            wide_multiply(&y, &x, &l[a]);
            wide_add(&dot, &dot, &y);
            wide_multiply(&x, &l[a], &l[a]);
            wide_add(&square, &square, &x);
        }
        radius = radius_about(d * (d / nn));
        oracle_integer(&x, exact(radius), UNIT);
        wide_multiply(&y, &x, &x);
        wide_multiply(&x, &y, &square);
        wide_multiply(&y, &dot, &dot);
        truth = wide_compare(&y, &x) <= 0;
        touches += truth;
        CHECK(tribox_sphere_triangle(c, radius, p.v[0], p.v[1], p.v[2]) == truth);
    }
    CHECK(touches > i / 4 && touches < i - i / 4);
}

/* A sphere that reaches the line of an edge beyond the corner, or the plane beyond the edge, touches nothing; the
 * centre's subnormal height leaves that to the integers. */
static void lines_and_planes_go_on_where_triangles_end(void)
{
    static const float v[3][3] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}};
    static const float beyond[6][3] = {{-2, 1, 1e-45f}, {6, -1, 1e-45f}, {5, -2, 1e-45f},
                                       {3, 6, 1e-45f},  {5, 6, 1e-45f},  {-2, -1, 1e-45f}};
    static const float beside[3][3] = {{2, -3, 1e-45f}, {7, 2, 1e-45f}, {0, 4, 1e-45f}};
    int i;
    int k;
    for (k = 0; k < 3; k++) {
        const float *const a = v[k];
        const float *const b = v[(k + 1) % 3];
        const float *const c = v[(k + 2) % 3];
        for (i = 0; i < 6; i++) {
            CHECK(tribox_sphere_triangle(beyond[i], 1.5f, a, b, c) == 0);
            CHECK(tribox_sphere_triangle(beyond[i], 1.5f, b, a, c) == 0);
            CHECK(tribox_sphere_triangle(beyond[i], 2.5f, a, b, c) == 1);
        }
        for (i = 0; i < 3; i++) {
            CHECK(tribox_sphere_triangle(beside[i], 2.5f, a, b, c) == 0);
            CHECK(tribox_sphere_triangle(beside[i], 2.5f, b, a, c) == 0);
            CHECK(tribox_sphere_triangle(beside[i], 3, a, b, c) == (i == 2)); /* the height counts */
        }
    }
}

/* f(t) = A t^2 + 2 B t + C and its slope A t + B at a float t, by their signs, in integers. */
typedef struct quadratic {
    wide a;
    wide b;
    wide c;
} quadratic;

static int quadratic_sign(const quadratic *f, float t, int *slope)
{
    static wide x;
    static wide y;
    static wide z;
    static wide one;
    static wide s;
    wide_set(&one, 1, 1, -UNIT);
    oracle_integer(&x, exact(t), UNIT);
    wide_multiply(&y, &f->a, &x);
    wide_multiply(&z, &f->b, &one);
    wide_add(&s, &y, &z); /* times 2^-149 more */
    *slope = s.sign;
    wide_add(&y, &s, &z);
    wide_multiply(&z, &y, &x);
    wide_multiply(&y, &f->c, &one);
    wide_multiply(&s, &y, &one);
    wide_add(&y, &z, &s);
    return y.sign;
}

/* Is t outside of the sphere, before it (end 0) or behind (1)? */
static int is_outside(const quadratic *f, float t, int end)
{
    int slope;
    int sign;
    if (!float_is_finite(t)) {
        return (float_order(t) < 0) == (end == 0);
    }
    sign = quadratic_sign(f, t, &slope);
    return sign > 0 && (end == 0 ? slope < 0 : slope > 0);
}

static void quadratic_of(quadratic *f, const float o[3], const float d[3], const float c[3], float r)
{
    static wide x;
    static wide y;
    static wide m;
    int k;
    wide_set(&f->a, 0, 0, 0);
    wide_set(&f->b, 0, 0, 0);
    wide_square_distance(&f->c, o, c);
    for (k = 0; k < 3; k++) {
        oracle_integer(&x, exact(o[k]), UNIT);
        oracle_integer(&y, exact(c[k]), UNIT);
        wide_subtract(&m, &x, &y);
        oracle_integer(&x, exact(d[k]), UNIT);
        wide_multiply(&y, &x, &x);
        wide_add(&f->a, &f->a, &y);
        wide_multiply(&y, &x, &m);
        wide_add(&f->b, &f->b, &y);
    }
    oracle_integer(&x, exact(r), UNIT);
    wide_multiply(&y, &x, &x);
    wide_subtract(&f->c, &f->c, &y);
}

/* t0 and t1 are the floats next to the ends of the interval, or the ray's own ends. */
static int pierce_is_right(const quadratic *f, int got, float t_min, float t_max, float t0, float t1)
{
    static wide d;
    static wide x;
    int truth;
    if (f->a.sign == 0) {
        truth = f->c.sign <= 0;
        return got == truth && (!truth || (float_order(t0) == float_order(t_min) && float_order(t1) == float_order(t_max)));
    }
    wide_multiply(&d, &f->b, &f->b);
    wide_multiply(&x, &f->a, &f->c);
    wide_subtract(&d, &d, &x);
    truth = d.sign >= 0 && !is_outside(f, t_max, 0) && !is_outside(f, t_min, 1);
    if (got != truth || !truth) {
        return got == truth;
    }
    if (is_outside(f, t_min, 0)) {
        const float next = float_order(t0) == float_order(-FLT_MAX) - 1 ? -FLT_MAX : nudge_float(t0, 1);
        int slope;
        const int sign = float_is_finite(t0) ? quadratic_sign(f, t0, &slope) : 1;
        if (!(is_outside(f, t0, 0) || (sign == 0 && slope <= 0)) || (is_outside(f, next, 0)) ) {
            return 0;
        }
        if (float_is_finite(next) && quadratic_sign(f, next, &slope) == 0 && slope <= 0) {
            return 0;
        }
    } else if (float_order(t0) != float_order(t_min)) {
        return 0;
    }
    if (is_outside(f, t_max, 1)) {
        const float before = nudge_float(t1, float_order(t1) == 0 ? -2 : -1);
        int slope;
        const int sign = float_is_finite(t1) ? quadratic_sign(f, t1, &slope) : 1;
        if (!(is_outside(f, t1, 1) || (sign == 0 && slope >= 0)) || is_outside(f, before, 1)) {
            return 0;
        }
        if (float_is_finite(before) && quadratic_sign(f, before, &slope) == 0 && slope >= 0) {
            return 0;
        }
    } else if (float_order(t1) != float_order(t_max)) {
        return 0;
    }
    return 1;
}

/* Any floats; small integers, where roots are floats and rays graze. */
static void rays_and_spheres_are_exact(void)
{
    int hits = 0;
    int i;
    int k;
    random_seed(71);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        static quadratic f;
        const int kind = i % 4;
        float o[3];
        float d[3];
        float c[3];
        float r = any_float(kind);
        float t_min = random_below(3) ? any_float(random_below(3)) : -infinity();
        float t_max = random_below(3) ? any_float(random_below(3)) : infinity();
        float t[2] = {-7, -7};
        int hit;
        r = r < 0 ? -r : r;
        for (k = 0; k < 3; k++) {
            o[k] = any_float(kind);
            c[k] = any_float(kind);
            d[k] = random_below(4) ? any_float(kind) : 0;
            if (kind == 2 && random_below(2)) {
                d[k] = c[k] - o[k];
            }
        }
        if (float_order(t_min) > float_order(t_max)) {
            const float swap = t_min;
            t_min = t_max;
            t_max = swap;
        }
        if ((float_order(t_min) == float_order(t_max) && !float_is_finite(t_min)) || t_min > FLT_MAX ||
            t_max < -FLT_MAX) {
            continue;
        }
        quadratic_of(&f, o, d, c, r);
        hit = tribox_ray_sphere(o, d, t_min, t_max, c, r, &t[0], &t[1]);
        hits += hit;
        if (!CHECK(pierce_is_right(&f, hit, t_min, t_max, t[0], t[1])) && test_wants_details()) {
            printf("  o %a %a %a d %a %a %a c %a %a %a r %a t %a..%a: %d %a %a\n", (double)o[0], (double)o[1],
                   (double)o[2], (double)d[0], (double)d[1], (double)d[2], (double)c[0], (double)c[1],
                   (double)c[2], (double)r, (double)t_min, (double)t_max, hit, (double)t[0], (double)t[1]);
        }
    }
    CHECK(hits > i / 8 && hits < i - i / 8);
}

/* An endless ray may enter a sphere past all floats, and one that ends at the last float then misses it. */
static void endless_rays_go_past_all_floats(void)
{
    const float o[3] = {0, 0, 0};
    const float d[3] = {0, (float)power_of_two(-65), 0};
    const float c[3] = {0, (float)power_of_two(95), 0};
    const float r = (float)power_of_two(90);
    float t[2] = {9, 9};
    CHECK(tribox_ray_sphere(o, d, 0, infinity(), c, r, &t[0], &t[1]) == 1);
    CHECK(float_order(t[0]) == float_order(FLT_MAX) && float_order(t[1]) == float_order(infinity()));
    CHECK(tribox_ray_sphere(o, d, 0, FLT_MAX, c, r, NULL, NULL) == 0);
    CHECK(tribox_ray_sphere(o, d, -infinity(), FLT_MAX, c, r, NULL, NULL) == 0);
}

/* Radii that are no lengths, and centres that are no points. */
/* n = a (3, 4, 0) in some order has length 5 a: with d so that the value is 5 a r, the sphere just touches the plane,
 * whatever squares of floats round to. */
static void planes_that_just_touch(void)
{
    int i;
    for (i = 0; i < 3000 / TEST_SCALE + 100; i++) {
        const int a = 1 + random_below(255);
        const int r = 1 + random_below(4095);
        const int first = random_below(3);
        const int side = random_below(2) ? 1 : -1;
        int d = side * 5 * a * r;
        int k;
        float n[3];
        float c[3];
        n[first] = (float)(3 * a);
        n[(first + 1) % 3] = (float)(4 * a);
        n[(first + 2) % 3] = 0;
        for (k = 0; k < 3; k++) {
            const int x = random_below(4096) - 2048;
            c[k] = (float)x;
            d -= (int)n[k] * x;
        }
        CHECK(tribox_plane_sphere(n, (float)d, c, (float)r) == 0);
        CHECK(tribox_plane_sphere(n, (float)(d + side), c, (float)r) == side);
        CHECK(tribox_plane_sphere(n, (float)(d - side), c, (float)r) == 0);
    }
}

/* A ray to the middle of an edge meets it, whatever the products of its long integers round to. */
static void rays_through_edges_meet_them(void)
{
    int i;
    for (i = 0; i < 3000 / TEST_SCALE + 100; i++) {
        float v[3][3];
        float o[3];
        float dir[3];
        float t = -1;
        int k;
        for (k = 0; k < 3; k++) {
            const int p = random_below(1 << 21);
            const int half = random_below(1 << 21);
            const int from = random_below(1 << 22);
            v[0][k] = (float)p;
            v[1][k] = (float)(p + 2 * half);
            v[2][k] = (float)random_below(1 << 22);
            o[k] = (float)from;
            dir[k] = (float)(p + half - from);
        }
        k = random_below(3);
        CHECK(tribox_ray_triangle(o, dir, 0, 2, v[k], v[(k + 1) % 3], v[(k + 2) % 3], &t) == 1);
        CHECK(t > 0 && t <= 1);
    }
}

static void spheres_without_a_question(void)
{
    const float v0[3] = {0, 0, 0};
    const float v1[3] = {1, 0, 0};
    const float v2[3] = {0, 1, 0};
    const float p[3] = {3, 4, 0};
    float n[3] = {1, 0, 0};
    float bad[3] = {0, 0, 0};
    float t[2] = {9, 9};
    int i;
    CHECK(tribox_sphere_sphere(v0, 2, p, 3) == 1 && tribox_sphere_sphere(v0, 2, p, nudge_float(3, -1)) == 0);
    CHECK(tribox_sphere_sphere(v0, infinity(), p, 0) == 1 && tribox_sphere_sphere(v0, -0.0f, v0, -0.0f) == 1);
    CHECK(tribox_plane_sphere(n, -2, p, 1) == 0 && tribox_plane_sphere(n, -2, p, nudge_float(1, -1)) == 1);
    CHECK(tribox_plane_sphere(n, -4, p, nudge_float(1, -1)) == -1 && tribox_plane_sphere(n, infinity(), p, 1) == 1);
    CHECK(tribox_plane_sphere(n, -infinity(), p, infinity()) == -1 && tribox_plane_sphere(bad, -1, p, infinity()) == -1);
    CHECK(tribox_plane_sphere(bad, -0.0f, p, 1) == 0 && tribox_plane_sphere(n, 1, p, infinity()) == 0);
    CHECK(tribox_ray_sphere(v0, p, 0, infinity(), p, 5, &t[0], &t[1]) == 1 && t[0] <= 0 && t[0] >= 0);
    CHECK(t[1] >= 2 && t[1] <= 2);
    CHECK(tribox_ray_sphere(v0, n, 0, infinity(), p, 4, &t[0], &t[1]) == 1 && t[0] >= 3 && t[0] <= 3 && t[1] <= 3);
    CHECK(tribox_ray_sphere(v0, n, -1, 1, p, infinity(), &t[0], &t[1]) == 1 && t[0] <= -1 && t[1] >= 1);
    CHECK(tribox_ray_sphere(v0, bad, -1, 7, p, 5, &t[0], &t[1]) == 1 && t[0] <= -1 && t[1] >= 7);
    CHECK(tribox_ray_sphere(v0, bad, -1, 7, p, nudge_float(5, -1), &t[0], &t[1]) == 0);
    CHECK(tribox_ray_sphere(v0, n, 1, 0, p, 4, NULL, NULL) == 0 && tribox_ray_sphere(v0, n, 0, 4, p, 4, NULL, NULL) == 1);
    for (i = 0; i < 3; i++) {
        const float odd[3] = {-1e-45f, -infinity(), not_a_number()};
        CHECK(tribox_sphere_sphere(v0, odd[i], v0, 5) == 0 && tribox_sphere_sphere(v0, 5, v0, odd[i]) == 0);
        CHECK(tribox_plane_sphere(n, 1, v0, odd[i]) == 2 && tribox_sphere_box(v0, odd[i], v0, p) == 0);
        CHECK(tribox_sphere_triangle(v0, odd[i], v0, v1, v2) == 0);
        CHECK(tribox_ray_sphere(v0, n, 0, 1, v0, odd[i], NULL, NULL) == 0);
        bad[i] = i == 1 ? not_a_number() : infinity();
        CHECK(tribox_sphere_sphere(bad, infinity(), v0, 1) == 0 && tribox_plane_sphere(n, 1, bad, infinity()) == 2);
        CHECK(tribox_plane_sphere(bad, 1, v0, 1) == 2 && tribox_plane_sphere(n, not_a_number(), v0, 1) == 2);
        CHECK(tribox_sphere_box(bad, infinity(), v0, p) == 0 && tribox_sphere_box(v0, infinity(), p, v0) == 0);
        CHECK(tribox_sphere_triangle(bad, infinity(), v0, v1, v2) == 0);
        CHECK(tribox_sphere_triangle(v0, infinity(), bad, v1, v2) == 0);
        CHECK(tribox_ray_sphere(v0, n, 0, 1, bad, infinity(), NULL, NULL) == 0);
        CHECK(tribox_ray_sphere(v0, bad, 0, 1, v0, 1, NULL, NULL) == 0);
        bad[i] = 0;
    }
    CHECK(tribox_sphere_triangle(p, infinity(), v0, v1, v2) == 1 && tribox_sphere_box(p, infinity(), v0, v0) == 1);
    CHECK(tribox_ray_sphere(v0, n, not_a_number(), 1, v0, 1, NULL, NULL) == 0);
    bad[0] = -infinity();
    CHECK(tribox_sphere_box(p, 1, bad, v0) == 0 && tribox_sphere_box(p, 4, bad, v0) == 0 && tribox_sphere_box(p, 5, bad, v0) == 1);
}

int main(void)
{
    RUN(open_sweeps_are_exact);
    RUN(other_rules_are_closed);
    RUN(a_box_slides_over_a_seam);
    RUN(open_sweeps_of_flat_and_infinite_boxes);
    RUN(moving_boxes_are_exact);
    RUN(moving_boxes_without_a_question);
    RUN(gaps_are_exact);
    RUN(gaps_on_a_lattice);
    RUN(gaps_of_slivers);
    RUN(gaps_next_to_a_face);
    RUN(gaps_of_small_boxes_at_edges);
    RUN(gaps_without_a_question);
    RUN(segments_pass_voxels_in_order);
    RUN(segments_far_and_none);
    RUN(segments_of_any_magnitude_are_in_order);
    RUN(segments_are_thin_triangles);
    RUN(spheres_are_exact);
    RUN(large_and_small_spheres_are_exact);
    RUN(spheres_miss_boxes_of_min_above_max);
    RUN(spheres_and_triangles_are_exact);
    RUN(small_spheres_and_large_triangles_are_exact);
    RUN(lines_and_planes_go_on_where_triangles_end);
    RUN(rays_and_spheres_are_exact);
    RUN(endless_rays_go_past_all_floats);
    RUN(planes_that_just_touch);
    RUN(rays_through_edges_meet_them);
    RUN(spheres_without_a_question);
    return test_report("test_contact");
}
