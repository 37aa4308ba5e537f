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
    const double next = f == 0.0f ? 1.0 / 713623846352979940529142984724747568191373312.0
                                  : (double)nudge_float(f, 1);
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
    CHECK(t0 >= 0 && t0 <= 0 && x[2] >= 1 && x[2] <= 1);
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
    CHECK(t[0] <= 0 && t[1] >= 1 && x[2] >= 1);
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
    CHECK(t[0] >= .5f && t[0] <= .5f && t[1] >= 1 && x[0] <= -1);
    b[1][0] = infinity();
    b[0][1] = b[0][2] = -infinity();
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, TRIBOX_OPEN, &t[0], &t[1], x) == 1);
    CHECK(t[0] >= .5f && t[0] <= .5f && t[1] >= 1 && x[0] <= -1);
    a[0][0] = -infinity();
    CHECK(tribox_sweep_box(a[0], a[1], b[0], b[1], u, TRIBOX_OPEN, &t[0], &t[1], x) == 1);
    CHECK(t[0] >= .5f && t[0] <= .5f && t[1] >= 1 && x[0] <= -1);
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

int main(void)
{
    (void)lesser;
    (void)greater;
    RUN(open_sweeps_are_exact);
    RUN(other_rules_are_closed);
    RUN(a_box_slides_over_a_seam);
    RUN(open_sweeps_of_flat_and_infinite_boxes);
    RUN(moving_boxes_are_exact);
    RUN(moving_boxes_without_a_question);
    return test_report("test_contact");
}
