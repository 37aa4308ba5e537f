/* Clipped polygons, nearest points, mesh queries and octants, against truth by other methods: all
 * candidate points in fractions of integers, all feet with the least distance, and oracle.h. */
#include "tribox.h"

#include "question.h"

#include <float.h>
#include <stdlib.h>

static float infinity(void)
{
    return nudge_float(FLT_MAX, 1);
}

static float not_a_number(void)
{
    return nudge_float(FLT_MAX, 2);
}

static int same_float(float a, float b)
{
    return a <= b && a >= b;
}

/* A power of two, or 19 bits times one: the lattice stays exact, but its products no longer fit a double. */
static float any_scale(void)
{
    double bits = random_below(2) ? 1 : 262145 + 2 * random_below(131071);

    return (float)(bits * power_of_two(random_below(200) - 110));
}

static int same_vector(const float a[3], const float b[3])
{
    return same_float(a[0], b[0]) && same_float(a[1], b[1]) && same_float(a[2], b[2]);
}

typedef struct lattice_case {
    int64_t v[3][3];
    int64_t lo[3];
    int64_t hi[3];
} lattice_case;

static void any_case(lattice_case *s, int n)
{
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        int64_t x = random_below(n);
        int64_t y = random_below(n);
        s->lo[a] = x < y ? x : y;
        s->hi[a] = x < y ? y : x;
        for (i = 0; i < 3; i++) {
            s->v[i][a] = random_below(n);
        }
    }
    if (random_below(8) == 0) {
        int from = random_below(2);
        int to = random_below(3);
        for (a = 0; a < 3; a++) {
            s->v[to][a] = s->v[from][a];
        }
    }
}

static void case_floats(const lattice_case *s, const float scale[3], float v[3][3], float lo[3], float hi[3])
{
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        lo[a] = (float)s->lo[a] * scale[a];
        hi[a] = (float)s->hi[a] * scale[a];
        for (i = 0; i < 3; i++) {
            v[i][a] = (float)s->v[i][a] * scale[a];
        }
    }
}

static void print_case(const lattice_case *s)
{
    int i;

    for (i = 0; i < 3; i++) {
        printf("  v%d {%d, %d, %d}\n", i, (int)s->v[i][0], (int)s->v[i][1], (int)s->v[i][2]);
    }
    printf("  lo {%d, %d, %d} hi {%d, %d, %d}\n", (int)s->lo[0], (int)s->lo[1], (int)s->lo[2], (int)s->hi[0],
           (int)s->hi[1], (int)s->hi[2]);
}

/* ---- clip ---------------------------------------------------------------------------------------------- */

/* A point as x / w, w > 0. On lattices below 8: w <= 98, |x| <= 98 * 7, so all products below fit. */
typedef struct point {
    int64_t x[3];
    int64_t w;
} point;

typedef struct points {
    int   count;
    point p[64];
} points;

static int point_order(const point *a, const point *b)
{
    int k;

    for (k = 0; k < 3; k++) {
        int64_t d = a->x[k] * b->w - b->x[k] * a->w;
        if (d != 0) {
            return d > 0 ? 1 : -1;
        }
    }
    return 0;
}

/* (b - a) x (c - a), up to a positive factor */
static void point_cross(int64_t out[3], const point *a, const point *b, const point *c)
{
    int64_t e[3];
    int64_t f[3];
    int     k;

    for (k = 0; k < 3; k++) {
        e[k] = b->x[k] * a->w - a->x[k] * b->w;
        f[k] = c->x[k] * a->w - a->x[k] * c->w;
    }
    for (k = 0; k < 3; k++) {
        out[k] = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
    }
}

static void add_candidate(points *set, const lattice_case *s, point p)
{
    int i;
    int k;

    if (p.w < 0) {
        p.w = -p.w;
        for (k = 0; k < 3; k++) {
            p.x[k] = -p.x[k];
        }
    }
    for (k = 0; k < 3; k++) {
        if (p.w == 0 || p.x[k] < s->lo[k] * p.w || p.x[k] > s->hi[k] * p.w) {
            return;
        }
    }
    for (i = 0; i < set->count; i++) {
        if (point_order(&set->p[i], &p) == 0) {
            return;
        }
    }
    set->p[set->count++] = p;
}

static void normal_of(const lattice_case *s, int64_t n[3])
{
    point p[3];
    int   i;
    int   k;

    for (i = 0; i < 3; i++) {
        for (k = 0; k < 3; k++) {
            p[i].x[k] = s->v[i][k];
        }
        p[i].w = 1;
    }
    point_cross(n, &p[0], &p[1], &p[2]);
}

/* Corners in B, edges cut by face planes, and box edges cut by T (weights all of one sign): every extreme
 * point. */
static void candidates(points *set, const lattice_case *s)
{
    int64_t n[3];
    int     i;
    int     a;
    int     k;

    set->count = 0;
    normal_of(s, n);
    for (i = 0; i < 3; i++) {
        const int64_t *p = s->v[i];
        const int64_t *q = s->v[(i + 1) % 3];
        point          x;
        x.w = 1;
        for (k = 0; k < 3; k++) {
            x.x[k] = p[k];
        }
        add_candidate(set, s, x);
        for (a = 0; a < 6; a++) {
            int64_t f = a & 1 ? s->hi[a / 2] : s->lo[a / 2];
            int64_t from = f - p[a / 2];
            int64_t to = q[a / 2] - f;
            if (from * to < 0 || from + to == 0) {
                continue;
            }
            x.w = from + to;
            for (k = 0; k < 3; k++) {
                x.x[k] = p[k] * to + q[k] * from;
            }
            add_candidate(set, s, x);
        }
    }
    for (a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        int c = (a + 2) % 3;
        for (k = 0; k < 4; k++) {
            int64_t fb = k & 1 ? s->hi[b] : s->lo[b];
            int64_t fc = k & 2 ? s->hi[c] : s->lo[c];
            point   x;
            int     above = 0;
            int     below = 0;
            x.x[a] = 0;
            x.w = 0;
            for (i = 0; i < 3; i++) {
                const int64_t *p = s->v[(i + 1) % 3];
                const int64_t *q = s->v[(i + 2) % 3];
                int64_t        weight = (p[b] - fb) * (q[c] - fc) - (p[c] - fc) * (q[b] - fb);
                x.x[a] += weight * s->v[i][a];
                x.w += weight;
                above |= weight > 0;
                below |= weight < 0;
            }
            x.x[b] = fb * x.w;
            x.x[c] = fc * x.w;
            if (!(above && below)) {
                add_candidate(set, s, x);
            }
        }
    }
}

/* Drops points strictly between two others. */
static void keep_extremes(points *set)
{
    int i;
    int j;
    int k;

    for (k = set->count - 1; k >= 0; k--) {
        int between = 0;
        for (i = 0; i < set->count; i++) {
            for (j = 0; j < i; j++) {
                int64_t n[3];
                point_cross(n, &set->p[k], &set->p[i], &set->p[j]);
                between |= i != k && j != k && n[0] == 0 && n[1] == 0 && n[2] == 0 &&
                           point_order(&set->p[i], &set->p[k]) * point_order(&set->p[j], &set->p[k]) < 0;
            }
        }
        if (between) {
            set->p[k] = set->p[--set->count];
        }
    }
}

/* From the least point, round with the winding: next is the one with all others on its left, seen along n. */
static void sort_round(points *set, const lattice_case *s)
{
    int64_t n[3];
    int     i;
    int     j;
    int     k;

    normal_of(s, n);
    for (i = 0; i < set->count; i++) {
        int best = i;
        for (j = i + 1; j < set->count; j++) {
            if (i == 0 ? point_order(&set->p[j], &set->p[best]) < 0 : 0) {
                best = j;
            }
            if (i > 0) {
                int64_t m[3];
                double  turn = 0;
                point_cross(m, &set->p[i - 1], &set->p[best], &set->p[j]);
                for (k = 0; k < 3; k++) {
                    turn += (double)m[k] * (double)n[k];
                }
                best = turn < 0 ? j : best;
            }
        }
        if (best != i) {
            point swapped = set->p[i];
            set->p[i] = set->p[best];
            set->p[best] = swapped;
        }
    }
}

static int clip_is_right(const lattice_case *s, const points *truth)
{
    float scale[3] = {1, 1, 1};
    float v[3][3];
    float lo[3];
    float hi[3];
    float p[9][3];
    float q[9][3];
    int   count;
    int   ok;
    int   i;
    int   k;

    case_floats(s, scale, v, lo, hi);
    count = tribox_clip(v[0], v[1], v[2], lo, hi, p);
    ok = count == truth->count;
    for (i = 0; ok && i < count; i++) {
        /* no quotient of such integers is within 2^-53 of half-way unless it is there */
        for (k = 0; k < 3; k++) {
            ok &= same_float(p[i][k], (float)((double)truth->p[i].x[k] / (double)truth->p[i].w));
        }
    }
    for (k = 0; k < 3; k++) {
        scale[k] = any_scale();
    }
    case_floats(s, scale, v, lo, hi);
    ok = ok && tribox_clip(v[0], v[1], v[2], lo, hi, q) == count;
    for (i = 0; ok && i < count; i++) {
        for (k = 0; k < 3; k++) {
            ok &= same_float(q[i][k],
                             (float)((double)truth->p[i].x[k] * (double)scale[k] / (double)truth->p[i].w));
        }
    }
    if (!ok && test_wants_details()) {
        print_case(s);
        for (i = 0; i < truth->count; i++) {
            printf("  truth %d/%d %d/%d %d/%d\n", (int)truth->p[i].x[0], (int)truth->p[i].w,
                   (int)truth->p[i].x[1], (int)truth->p[i].w, (int)truth->p[i].x[2], (int)truth->p[i].w);
        }
        for (i = 0; i < count; i++) {
            printf("  clip %.9g %.9g %.9g\n", (double)p[i][0], (double)p[i][1], (double)p[i][2]);
        }
    }
    return ok;
}

/* Count, order, start and every rounded coordinate; also with scaled axes. */
static void clipped_polygons_are_exact(void)
{
    int by_count[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    int i;

    random_seed(61);
    for (i = 0; i < TEST_LOOPS(60000); i++) {
        lattice_case s;
        points       truth;
        any_case(&s, 2 + random_below(7));
        candidates(&truth, &s);
        keep_extremes(&truth);
        sort_round(&truth, &s);
        by_count[truth.count]++;
        CHECK(clip_is_right(&s, &truth));
    }
    for (i = 0; i < 8 && TEST_SCALE == 1; i++) {
        CHECK(by_count[i] > 0);
    }
}

/* The most there can be: a cube's hexagon with every second corner cut off. */
static void a_clipped_triangle_can_have_nine_corners(void)
{
    static const float v0[3] = {2.75f, -0.75f, 1.0f};
    static const float v1[3] = {1.0f, 2.75f, -0.75f};
    static const float v2[3] = {-0.75f, 1.0f, 2.75f};
    static const float lo[3] = {0, 0, 0};
    static const float hi[3] = {2, 2, 2};
    float              p[9][3];
    int                count = tribox_clip(v0, v1, v2, lo, hi, p);
    int                i;
    int                k;

    CHECK(count == 9);
    for (i = 0; i < count; i++) {
        for (k = 0; k < 3; k++) {
            CHECK(p[i][k] >= 0 && p[i][k] <= 2);
        }
        CHECK(i == 0 || !(p[i][0] < p[0][0]));
    }
}

/* 0 corners exactly where there is no overlap; all corners inside box and bounds; the winding turns one
 * way. */
static void clips_of_any_floats_lie_inside(void)
{
    int hits = 0;
    int i;
    int j;
    int k;

    random_seed(62);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        float v[3][3];
        float lo[3];
        float hi[3];
        float p[9][3];
        int   wild = random_below(3) == 0;
        int   count;
        int   inside = 1;
        for (k = 0; k < 3; k++) {
            double unit = wild ? power_of_two(random_below(250) - 130) : 1;
            float  a = (float)(random_signed() * unit);
            float  b = (float)(random_signed() * unit);
            for (j = 0; j < 3; j++) {
                v[j][k] = (float)(random_signed() * unit);
            }
            lo[k] = a < b ? a : b;
            hi[k] = a < b ? b : a;
            if (random_below(16) == 0) {
                lo[k] = -infinity();
            }
            if (random_below(16) == 0) {
                hi[k] = v[random_below(3)][k];
                lo[k] = lo[k] < hi[k] ? lo[k] : hi[k];
            }
        }
        count = tribox_clip(v[0], v[1], v[2], lo, hi, p);
        CHECK((count > 0) == tribox_overlap(v[0], v[1], v[2], lo, hi));
        hits += count > 0;
        for (j = 0; j < count; j++) {
            for (k = 0; k < 3; k++) {
                inside &= p[j][k] >= lo[k] && p[j][k] <= hi[k];
                inside &= p[j][k] >= v[0][k] || p[j][k] >= v[1][k] || p[j][k] >= v[2][k];
                inside &= p[j][k] <= v[0][k] || p[j][k] <= v[1][k] || p[j][k] <= v[2][k];
            }
            inside &= j == 0 || !same_vector(p[j], p[0]);
        }
        CHECK(inside);
        if (!wild) {                    /* n.((p1 - p0) x (p2 - p0)) > 0 for each corner, to rounding */
            for (j = 0; j < count && count > 2; j++) {
                double turn = 0;
                for (k = 0; k < 3; k++) {
                    int    b = (k + 1) % 3;
                    int    c = (k + 2) % 3;
                    double n = ((double)v[1][b] - (double)v[0][b]) * ((double)v[2][c] - (double)v[0][c]) -
                               ((double)v[1][c] - (double)v[0][c]) * ((double)v[2][b] - (double)v[0][b]);
                    const float *x = p[(j + 1) % count];
                    const float *y = p[(j + 2) % count];
                    turn += n * (((double)x[b] - (double)p[j][b]) * ((double)y[c] - (double)p[j][c]) -
                                 ((double)x[c] - (double)p[j][c]) * ((double)y[b] - (double)p[j][b]));
                }
                CHECK(turn > -1e-6);
            }
        }
    }
    CHECK(hits > i / 8 && hits < i - i / 8);
}

static void clips_without_a_question(void)
{
    static const float v0[3] = {0, 0, 0};
    static const float v1[3] = {4, 0, 0};
    static const float v2[3] = {0, 4, 0};
    float              lo[3] = {0, 0, 0};
    float              hi[3] = {1, 1, 0};
    float              x[3] = {1, 1, 1};
    float              p[9][3];
    int                a;

    CHECK(tribox_clip(v0, v1, v2, lo, hi, p) == 4);
    CHECK(tribox_clip(v0, v1, v2, hi, lo, p) == 0);
    for (a = 0; a < 3; a++) {
        x[a] = infinity();
        CHECK(tribox_clip(v0, v1, x, lo, hi, p) == 0);
        CHECK(tribox_clip(x, v1, v2, lo, hi, p) == 0);
        CHECK(tribox_clip(v0, v1, v2, x, x, p) == 0);
        CHECK(tribox_clip(v0, v1, v2, lo, x, p) >= 4);
        x[a] = not_a_number();
        CHECK(tribox_clip(v0, x, v2, lo, hi, p) == 0);
        CHECK(tribox_clip(v0, v1, v2, x, hi, p) == 0);
        CHECK(tribox_clip(v0, v1, v2, lo, x, p) == 0);
        x[a] = 1;
    }
    hi[2] = nudge_float(0, -2);
    lo[2] = -1;
    CHECK(tribox_clip(v0, v1, v2, lo, hi, p) == 0);
}

/* A corner at the largest float, of either sign, stays there and does not become infinite. */
static void corners_at_the_largest_float_stay(void)
{
    const float lo[3] = {-infinity(), -infinity(), -infinity()};
    const float hi[3] = {infinity(), infinity(), infinity()};
    const float v[3] = {-FLT_MAX, FLT_MAX, -FLT_MAX};
    float       polygon[9][3];

    CHECK(tribox_clip(v, v, v, lo, hi, polygon) == 1);
    CHECK(memcmp(polygon[0], v, sizeof v) == 0);
}

/* Corners that round alike are given once: the box is one float wide, the triangle crosses it at a slant. */
static void corners_that_round_alike_are_merged(void)
{
    float v0[3] = {1, 0, 0};
    float v1[3] = {nudge_float(1, 1), 1, 0};
    float v2[3] = {nudge_float(1, 1), 2, 0};
    float lo[3] = {0, 0.125f, -1};
    float hi[3] = {2, 0.125f, 1};
    float p[9][3];

    CHECK(tribox_clip(v0, v1, v2, lo, hi, p) == 1);
    CHECK(same_float(p[0][0], 1) && same_float(p[0][1], 0.125f) && same_float(p[0][2], 0));
    lo[1] = hi[1] = 0.75f;
    CHECK(tribox_clip(v0, v1, v2, lo, hi, p) == 2);
    CHECK(same_float(p[0][0], 1) && same_float(p[1][0], nudge_float(1, 1)));
}

/* A cut half-way between two floats goes to the even one, above or below. */
static void half_way_cuts_go_to_the_even_float(void)
{
    int i;

    for (i = 0; i < 4; i++) {
        const float below = nudge_float(1, i);
        const float above = nudge_float(1, i + 1);
        const float v0[3] = {0, below, 0};
        const float v1[3] = {2, above, 0};
        const float v2[3] = {2, above, 1};
        const float lo[3] = {1, 0, 0};
        const float hi[3] = {1, 3, 0};
        float       p[9][3];
        CHECK(tribox_clip(v0, v1, v2, lo, hi, p) == 1);
        CHECK(same_float(p[0][0], 1) && same_float(p[0][1], i % 2 ? above : below) && p[0][2] == 0);
    }
}

/* ---- closest ------------------------------------------------------------------------------------------- */

typedef struct weights {
    int64_t w[3];
    int64_t sum;
} weights;

/* |x - q|^2 as n / d^2. On lattices below 5 and |q| below 8 all stays below 2^63. */
static int64_t distance2(const lattice_case *s, const int64_t q[3], const weights *w)
{
    int64_t n = 0;
    int     k;

    for (k = 0; k < 3; k++) {
        int64_t x = w->w[0] * s->v[0][k] + w->w[1] * s->v[1][k] + w->w[2] * s->v[2][k] - w->sum * q[k];
        n += x * x;
    }
    return n;
}

static int64_t dot_from(const int64_t o[3], const int64_t x[3], const int64_t y[3])
{
    return (x[0] - o[0]) * (y[0] - o[0]) + (x[1] - o[1]) * (y[1] - o[1]) + (x[2] - o[2]) * (y[2] - o[2]);
}

/* Of the corners, the feet on edges and the foot in the plane that lie in T: the nearest, the first of
 * equals. */
static weights closest_by_search(const lattice_case *s, const int64_t q[3])
{
    weights best = {{1, 0, 0}, 1};
    weights w;
    int     i;
    int     j;
    int     k;

    for (k = 0; k < 7; k++) {
        int64_t a;
        int64_t b;
        memset(&w, 0, sizeof w);
        if (k < 3) {
            w.w[k] = w.sum = 1;
        } else if (k < 6) {
            i = k == 5 ? 1 : 0;
            j = k == 3 ? 1 : 2;
            w.w[j] = dot_from(s->v[i], s->v[j], q);
            w.sum = dot_from(s->v[i], s->v[j], s->v[j]);
            w.w[i] = w.sum - w.w[j];
        } else {                        /* the foot solves two linear equations; their determinant is |n|^2 */
            int64_t xx = dot_from(s->v[0], s->v[1], s->v[1]);
            int64_t xy = dot_from(s->v[0], s->v[1], s->v[2]);
            int64_t yy = dot_from(s->v[0], s->v[2], s->v[2]);
            a = dot_from(s->v[0], s->v[1], q);
            b = dot_from(s->v[0], s->v[2], q);
            w.w[1] = a * yy - b * xy;
            w.w[2] = b * xx - a * xy;
            w.sum = xx * yy - xy * xy;
            w.w[0] = w.sum - w.w[1] - w.w[2];
        }
        if (w.sum <= 0 || w.w[0] < 0 || w.w[1] < 0 || w.w[2] < 0) {
            continue;
        }
        if (distance2(s, q, &w) * (best.sum * best.sum) < distance2(s, q, &best) * (w.sum * w.sum)) {
            best = w;
        }
    }
    return best;
}

/* Every weight is the nearest float, zeros and all; also with everything scaled. */
static void nearest_points_are_exact(void)
{
    int by_kind[4] = {0, 0, 0, 0};
    int i;
    int k;

    random_seed(63);
    for (i = 0; i < TEST_LOOPS(60000); i++) {
        float        scale[3] = {1, 1, 1};
        lattice_case s;
        int64_t      q[3];
        weights      truth;
        float        v[3][3];
        float        lo[3];
        float        hi[3];
        float        at[3];
        float        w[3] = {9, 9, 9};
        int          ok = 1;
        any_case(&s, 5);
        for (k = 0; k < 3; k++) {
            q[k] = random_below(9) - 2;
        }
        truth = closest_by_search(&s, q);
        by_kind[(truth.w[0] != 0) + (truth.w[1] != 0) + (truth.w[2] != 0)]++;
        if (random_below(2)) {
            scale[0] = scale[1] = scale[2] = any_scale();
        }
        case_floats(&s, scale, v, lo, hi);
        for (k = 0; k < 3; k++) {
            at[k] = (float)q[k] * scale[k];
        }
        tribox_closest(v[0], v[1], v[2], at, w);
        for (k = 0; k < 3; k++) {
            ok &= same_float(w[k], (float)((double)truth.w[k] / (double)truth.sum));
        }
        if (!CHECK(ok) && test_wants_details()) {
            print_case(&s);
            printf("  q {%d, %d, %d}: %.9g %.9g %.9g, truth %d %d %d of %d\n", (int)q[0], (int)q[1],
                   (int)q[2], (double)w[0], (double)w[1], (double)w[2], (int)truth.w[0], (int)truth.w[1],
                   (int)truth.w[2],
                   (int)truth.sum);
        }
    }
    CHECK(by_kind[1] > i / 8 && by_kind[2] > i / 8 && by_kind[3] > i / 32);
}

/* The conditions of the nearest point, x in T and (q - x).(v - x) <= 0, hold to rounding for ordinary
 * floats. */
static void nearest_points_of_any_floats(void)
{
    int i;
    int j;
    int k;

    random_seed(64);
    for (i = 0; i < TEST_LOOPS(40000); i++) {
        float  v[3][3];
        float  q[3];
        float  w[3];
        double x[3];
        for (k = 0; k < 3; k++) {
            for (j = 0; j < 3; j++) {
                v[j][k] = (float)random_signed();
            }
            q[k] = (float)random_signed() * 2.0f;
        }
        tribox_closest(v[0], v[1], v[2], q, w);
        CHECK(w[0] >= 0 && w[1] >= 0 && w[2] >= 0 && w[0] + w[1] + w[2] > 0.999999f &&
              w[0] + w[1] + w[2] < 1.000001f);
        for (k = 0; k < 3; k++) {
            x[k] = (double)w[0] * (double)v[0][k] + (double)w[1] * (double)v[1][k] +
                   (double)w[2] * (double)v[2][k];
        }
        for (j = 0; j < 3; j++) {
            double dot = 0;
            for (k = 0; k < 3; k++) {
                dot += ((double)q[k] - x[k]) * ((double)v[j][k] - x[k]);
            }
            CHECK(dot < 1e-5);
        }
    }
}

static void nearest_without_a_question(void)
{
    static const float v0[3] = {0, 0, 0};
    static const float v1[3] = {4, 0, 0};
    static const float v2[3] = {0, 4, 0};
    float              q[3] = {1, 1, 1};
    float              w[3];
    int                a;

    for (a = 0; a < 6; a++) {
        q[a % 3] = a < 3 ? infinity() : not_a_number();
        tribox_closest(v0, v1, v2, q, w);
        CHECK(same_float(w[0], 1) && same_float(w[1], 0) && same_float(w[2], 0));
        tribox_closest(v0, q, v2, v1, w);
        CHECK(same_float(w[0], 1) && same_float(w[1], 0) && same_float(w[2], 0));
        q[a % 3] = 1;
    }
}

/* ---- both runs of one algorithm ------------------------------------------------------------------------ */

/* More limbs than any run takes. */
static tbx_limb test_store[16384];

static void test_exactly(tbx_calc *c)
{
    c->exact = 1;
    c->unsure = 0;
    c->used = 0;
    c->store = test_store;
}

static void test_real(tbx_real *r, double x)
{
    tbx_read(r, &x, 1, TBX_DOUBLE);
}

static void test_real_float(tbx_real *r, double x)
{
    const float narrow = (float)x;
    tbx_read(r, &narrow, 1, TBX_FLOAT);
}

/* Where the run in double is sure of itself, the run in integers gives the same bits: on random floats,
 * nearly always. */
static void sure_runs_equal_exact_runs(void)
{
    int unsure = 0;
    int i;
    int j;
    int k;

    random_seed(65);
    for (i = 0; i < TEST_LOOPS(10000); i++) {
        tbx_calc    fast = {0, 0, 0, NULL};
        tbx_calc    exact = {1, 0, 0, test_store};
        tbx_nearest nearest;
        tbx_cut     cut;
        tbx_polygon polygon[2];
        tbx_motion  m;
        int64_t     w[2][3] = {{0, 0, 0}, {0, 0, 0}};
        int64_t     p[2][9][3];
        int64_t     t[2][2];
        float       axis[2][3];
        int         count;
        int         hit;
        for (k = 0; k < 3; k++) {
            double unit = i % 4 ? 1 : power_of_two(random_below(250) - 130);
            double a = (float)(random_signed() * unit);
            double b = (float)(random_signed() * unit);
            for (j = 0; j < 3; j++) {
                test_real_float(&m.v[j][k], random_signed() * unit);
                cut.v[j][k] = nearest.v[j][k] = m.v[j][k];
            }
            test_real_float(&nearest.q[k], random_signed() * unit);
            m.velocity[k] = nearest.q[k];
            test_real_float(&m.lo[k], a < b ? a : b);
            test_real_float(&m.hi[k], a < b ? b : a);
            cut.face[0][k] = m.lo[k];
            cut.face[1][k] = m.hi[k];
        }
        test_real(&m.t[0], 0);
        test_real(&m.t[1], 1);
        m.axes = 13;
        m.open = i & 1;
        tbx_nearest_run(&fast, &nearest, TBX_FLOAT, 1, w[0]);
        tbx_nearest_run(&exact, &nearest, TBX_FLOAT, 1, w[1]);
        CHECK(fast.unsure || memcmp(w[0], w[1], sizeof w[0]) == 0);
        unsure += fast.unsure;
        m.calc = fast;
        hit = tbx_sweep_run(&m, t[0], axis[0]);
        unsure += m.calc.unsure;
        if (!m.calc.unsure) {
            test_exactly(&m.calc);
            CHECK(hit == tbx_sweep_run(&m, t[1], axis[1]));
            CHECK(!hit || memcmp(t[0], t[1], sizeof t[0]) == 0);
            for (k = 0; k < 3; k++) {
                float apart = hit ? axis[0][k] - axis[1][k] : 0;
                CHECK(apart < 2.4e-7f && apart > -2.4e-7f);
            }
        }
        fast.unsure = 0;
        cut.calc = fast;
        tbx_cut_run(&cut, &polygon[0]);
        count = tbx_cut_round(&cut, &polygon[0], TBX_FLOAT, p[0]);
        unsure += cut.calc.unsure;
        if (!cut.calc.unsure) {
            test_exactly(&cut.calc);
            tbx_cut_run(&cut, &polygon[1]);
            CHECK(count == tbx_cut_round(&cut, &polygon[1], TBX_FLOAT, p[1]));
            CHECK(memcmp(p[0], p[1], sizeof p[0][0] * (size_t)count) == 0);
        }
    }
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD == 0 /* 24 bits decide less */
    CHECK(unsure < i / 50);
#else
    (void)unsure;
#endif
}

/* A double of 1 to 53 bits and an exponent near 0. */
static double any_bits(void)
{
    double whole = (double)(int64_t)(random_bits() >> (11 + random_below(53)));

    return (random_below(2) ? whole : -whole) * power_of_two(random_below(70) - 70);
}

/* Sums and products in double lie within twice their bound of the exact ones; a bound of 0 says that they
 * are exact. */
static void numbers_in_double_hold_their_bound(void)
{
    tbx_calc fast = {0, 0, 0, NULL};
    tbx_calc exact = {1, 0, 0, test_store};
    int      exactly = 0;
    int      i;
    int      side;

    random_seed(68);
    for (i = 0; i < TEST_LOOPS(40000); i++) {
        tbx_real x;
        tbx_real y;
        tbx_real z;
        tbx_num a;
        tbx_num b;
        tbx_num r;
        tbx_num truth;
        tbx_num bound;
        test_real(&x, any_bits());
        test_real(&y, any_bits());
        tbx_num_of(&fast, &a, &x);
        tbx_num_of(&fast, &b, &y);
        if (i % 2) {
            tbx_num_mul(&fast, &r, &a, &b);
        } else {
            tbx_num_add(&fast, &r, &a, &b, -1);
        }
        exact.used = 0;
        tbx_num_of(&exact, &a, &x);
        tbx_num_of(&exact, &b, &y);
        if (i % 2) {
            tbx_num_mul(&exact, &truth, &a, &b);
        } else {
            tbx_num_add(&exact, &truth, &a, &b, -1);
        }
        exactly += !(r.rad > 0);
        test_real(&z, 2 * r.rad);
        tbx_num_of(&exact, &bound, &z);
        test_real(&z, r.mid);
        tbx_num_of(&exact, &a, &z);
        tbx_num_add(&exact, &truth, &truth, &a, -1);
        for (side = -1; side <= 1; side += 2) {
            tbx_num_add(&exact, &a, &bound, &truth, side);
            CHECK(a.sign >= 0);
        }
    }
    CHECK(exactly > i / 16 || FLT_EVAL_METHOD != 0);
}

/* ---- meshes -------------------------------------------------------------------------------------------- */

enum { MESH_TRIANGLES = 700, MESH_VERTICES = 400 };

/* Any stride and indexing, any box: the triangles that tribox_overlap names, the first `capacity` of them. */
static void mesh_queries_are_exact(void)
{
    static float    positions[MESH_TRIANGLES * 3 * 5];
    static uint32_t indices[MESH_TRIANGLES * 3];
    static uint32_t found[MESH_TRIANGLES + 1];
    int             i;

    random_seed(66);
    for (i = 0; i < TEST_LOOPS(600); i++) {
        tribox_mesh mesh;
        int         lattice = random_below(2);
        int         floats = 3 + random_below(3);
        float       lo[3];
        float       hi[3];
        size_t      capacity;
        size_t      expected = 0;
        size_t      count;
        size_t      t;
        int         ok = 1;
        int         k;
        for (k = 0; k < MESH_TRIANGLES * 3 * 5; k++) {
            positions[k] = lattice ? (float)random_below(9) : (float)random_signed() * 4.0f + 4.0f;
        }
        for (k = 0; k < MESH_TRIANGLES * 3; k++) {
            indices[k] = (uint32_t)random_below(MESH_VERTICES);
        }
        positions[random_below(2000)] = random_below(2) ? not_a_number() : infinity();
        positions[random_below(2000)] = random_below(2) ? 1e-45f : FLT_MAX;
        mesh.positions = positions;
        mesh.stride = floats == 3 ? 0 : (size_t)floats * sizeof(float);
        mesh.indices = random_below(2) ? indices : NULL;
        mesh.triangles = (size_t)random_below(MESH_TRIANGLES + 1);
        for (k = 0; k < 3; k++) {
            lo[k] = lattice ? (float)random_below(9) : (float)random_signed() * 4.0f + 4.0f;
            hi[k] = lo[k] + (float)random_below(3);
        }
        if (random_below(16) == 0) {
            lo[random_below(3)] = -infinity();
            hi[random_below(3)] = infinity();
        }
        if (random_below(32) == 0) {
            lo[random_below(3)] = random_below(2) ? infinity() : not_a_number();
        }
        capacity = random_below(2) ? MESH_TRIANGLES : (size_t)random_below(20);
        memset(found, 0xff, sizeof found);
        count = tribox_mesh_query(&mesh, lo, hi, found, capacity);
        for (t = 0; t < mesh.triangles; t++) {
            float v[3][3];
            for (k = 0; k < 3; k++) {
                size_t vertex = mesh.indices ? indices[3 * t + (size_t)k] : 3 * t + (size_t)k;
                memcpy(v[k], positions + vertex * (size_t)floats, sizeof v[k]);
            }
            if (tribox_overlap(v[0], v[1], v[2], lo, hi)) {
                ok &= expected >= capacity || found[expected] == (uint32_t)t;
                expected++;
            }
        }
        ok &= count == expected && found[count < capacity ? count : capacity] == 0xffffffffu;
        ok &= tribox_mesh_query(&mesh, lo, hi, NULL, 0) == expected;
        CHECK(ok);
    }
}

/* ---- octree descent ------------------------------------------------------------------------------------ */

/* Each bit is the voxel's truth in real numbers, under every rule, after any resize; and tribox_tri_test
 * agrees. */
static void octants_are_exact(void)
{
    static const unsigned rules[4] = {0, TRIBOX_HALF_OPEN, TRIBOX_OPEN, TRIBOX_THIN};
    int                   i;
    int                   k;

    random_seed(67);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        unsigned   flags = rules[random_below(4)];
        int        kind = random_below(3);
        int        as_float = random_below(2);
        int        unbounded;
        triangle   t;
        double     p[3];
        double     size[3];
        double     other[3];
        tribox_tri tri;
        tribox_tri fresh;
        unsigned   hits;
        unsigned   truth = 0;
        int        ok;
        int        o;
        for (k = 0; k < 9; k++) {
            t.v[k / 3][k % 3] = kind ? random_signed() * 4 : (double)random_below(9);
            t.v[k / 3][k % 3] = rounded_to_float(t.v[k / 3][k % 3]);
        }
        for (k = 0; k < 3; k++) {
            p[k] = rounded_to_float(kind ? random_signed() * 4 : (double)random_below(9));
            size[k] = rounded_to_float(kind ? random_signed() + 1.25 : (double)random_below(4));
            other[k] = random_signed() + 2;
            if (kind == 2 && !as_float) {       /* p + size needs more bits than a double has */
                p[k] = p[k] * (1 + power_of_two(-40));
                size[k] = size[k] * power_of_two(-random_below(60));
                if (random_below(3) == 0) {         /* a face within an ulp of a corner */
                    p[k] = t.v[random_below(3)][k] - random_below(3) * size[k];
                }
            }
        }
        unbounded = !as_float && random_below(8) == 0 ? random_below(3) : -1;
        if (unbounded >= 0) {
            size[unbounded] = (double)infinity();
        }
        if (as_float) {
            float t32[3][3];
            float p32[3];
            float size32[3];
            float other32[3];
            for (k = 0; k < 3; k++) {
                for (o = 0; o < 3; o++) {
                    t32[o][k] = (float)t.v[o][k];
                }
                p32[k] = (float)p[k];
                size32[k] = (float)size[k];
                other32[k] = (float)other[k];
            }
            tribox_tri_init(&tri, t32[0], t32[1], t32[2], other32, flags);
            tribox_tri_resize(&tri, size32);
            hits = tribox_tri_octants(&tri, p32);
        } else {
            tribox_tri_init_f64(&tri, t.v[0], t.v[1], t.v[2], other, flags);
            tribox_tri_resize_f64(&tri, size);
            hits = tribox_tri_octants_f64(&tri, p);
        }
        tribox_tri_init_f64(&fresh, t.v[0], t.v[1], t.v[2], size, flags);
        ok = tribox_tri_test_f64(&tri, p) == tribox_tri_test_f64(&fresh, p) &&
             (hits & 1u) == (unsigned)tribox_tri_test_f64(&fresh, p) && hits == tribox_tri_octants_f64(&fresh,
                                                                                                       p);
        for (o = 0; o < 8; o++) {
            const int index[3] = {o & 1, o >> 1 & 1, o >> 2};
            if (unbounded >= 0 && index[unbounded]) {
                continue;       /* no box begins at infinity */
            }
            truth |= (unsigned)oracle_says(oracle_voxel(&t, p, size, index), flags) << o;
        }
        ok &= hits == truth;
        if (!CHECK(ok) && test_wants_details()) {
            printf("  flags %u, octants %02x, truth %02x\n", flags, hits, truth);
            for (k = 0; k < 9; k++) {
                printf("  %a%s", t.v[k / 3][k % 3], k % 3 == 2 ? "\n" : "");
            }
            printf("  p %a %a %a size %a %a %a\n", p[0], p[1], p[2], size[0], size[1], size[2]);
        }
    }
}

static void octants_of_odd_sizes(void)
{
    static const double v0[3] = {1, 1, 1};
    static const double v1[3] = {3, 1, 1};
    static const double v2[3] = {1, 3, 1.5};
    double              size[3] = {1, 1, 1};
    double              p[3] = {0, 0, 0};
    double              infinite = (double)infinity();
    float               p32[3] = {0, 0, 0};
    tribox_tri          tri;
    tribox_tri          fresh;
    int                 i;

    tribox_tri_init_f64(&tri, v0, v1, v2, size, 0);
    CHECK(tribox_tri_octants_f64(&tri, p) == 0xff);
    CHECK(tribox_tri_octants(&tri, p32) == 0xff);
    for (i = 0; i < 2; i++) {       /* the second time for boxes without an end */
        p32[2] = not_a_number();
        CHECK(tribox_tri_octants(&tri, p32) == 0);
        p32[2] = infinity();
        CHECK(tribox_tri_octants(&tri, p32) == 0);
        p32[2] = -infinity();
        CHECK(tribox_tri_octants(&tri, p32) == 0);
        p32[2] = 0;
        size[0] = infinite;
        tribox_tri_resize_f64(&tri, size);
        CHECK(tribox_tri_octants(&tri, p32) == 0x55);
    }
    size[0] = 1;
    tribox_tri_resize_f64(&tri, size);
    p[0] = infinite;
    CHECK(tribox_tri_octants_f64(&tri, p) == 0);
    p[0] = (double)not_a_number();
    CHECK(tribox_tri_octants_f64(&tri, p) == 0);
    p[0] = 1;
    size[0] = -1;
    tribox_tri_resize_f64(&tri, size);
    CHECK(tribox_tri_octants_f64(&tri, p) == 0);
    size[0] = 0;
    size[1] = 2;
    tribox_tri_resize_f64(&tri, size);
    CHECK(tribox_tri_octants_f64(&tri, p) == 0xf3);
    tribox_tri_init_f64(&tri, v0, v1, v2, size, TRIBOX_OPEN);
    CHECK(tribox_tri_octants_f64(&tri, p) == 0);
    size[0] = 1;
    tribox_tri_resize_f64(&tri, size);
    CHECK(tribox_tri_octants_f64(&tri, p) == 0x70);
    size[0] = infinite;
    tribox_tri_init_f64(&tri, v0, v1, v2, size, TRIBOX_THIN);
    size[0] = 1;
    tribox_tri_init_f64(&fresh, v0, v1, v2, size, TRIBOX_THIN);
    tribox_tri_resize_f64(&tri, size);
    CHECK(tribox_tri_octants_f64(&tri, p) == tribox_tri_octants_f64(&fresh, p));
    tribox_tri_init_f64(&fresh, v0, v1, v2, size, 0);
    CHECK(tribox_tri_octants_f64(&tri, p) != tribox_tri_octants_f64(&fresh, p));
}

/* Faces at p + size and p + 2 size that are no doubles, 2^-60 beside 1: the plane x + y = 0 meets the boxes
 * with upper x and lower y at one corner, exactly. */
static void octants_whose_corners_are_no_doubles(void)
{
    static const double v[9] = {-2, 2, -1, 2, -2, -1, 0, 0, 3};
    const double        s = power_of_two(-60);
    const double        p[3] = {-1, 1 - power_of_two(-53), -1};
    const double        size[3] = {s, power_of_two(-53) - 2 * s, 0.5};
    tribox_tri          tri;

    tribox_tri_init_f64(&tri, v, v + 3, v + 6, size, 0);
    CHECK(tribox_tri_octants_f64(&tri, p) == 0xee);
    tribox_tri_init_f64(&tri, v, v + 3, v + 6, size, TRIBOX_HALF_OPEN);
    CHECK(tribox_tri_octants_f64(&tri, p) == 0xcc);
    tribox_tri_init_f64(&tri, v, v + 3, v + 6, size, TRIBOX_OPEN);
    CHECK(tribox_tri_octants_f64(&tri, p) == 0xcc);
}

/* Octants of doubles too large for floats: a small question times 2^e has the same answer for every e. */
static void octants_of_doubles_beyond_floats(void)
{
    int i;

    random_seed(71);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        const unsigned flags = (1u << random_below(4)) >> 1;
#ifdef __FAST_MATH__
        const int      least = -1000;   /* such a program may read subnormals as zero before it asks */
#else
        const int      least = -1050;
#endif
        const int      e = random_below(4) ? least + random_below(1010 - least) : 90 + random_below(40);
        const double   scale = power_of_two(e);
        double         x[15];
        double         large[15];
        tribox_tri     tri;
        unsigned       truth;
        int            k;
        for (k = 0; k < 15; k++) {
            x[k] = (double)(k < 12 ? random_below(17) : 1 + random_below(8));
            large[k] = x[k] * scale;
        }
        tribox_tri_init_f64(&tri, x, x + 3, x + 6, x + 12, flags);
        truth = tribox_tri_octants_f64(&tri, x + 9);
        tribox_tri_init_f64(&tri, large, large + 3, large + 6, large + 12, flags);
        CHECK(tribox_tri_octants_f64(&tri, large + 9) == truth);
        if (e >= -126 && e < 124) {
            const float p32[3] = {(float)large[9], (float)large[10], (float)large[11]};
            CHECK(tribox_tri_octants(&tri, p32) == truth);
        }
    }
}

/* A small triangle far from the origin, where no difference may be taken apart. */
static void octants_far_from_the_origin(void)
{
    int i;
    int k;

    random_seed(73);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        const double corner = rounded_to_float(random_signed() * 1e5);
        const float  p32[3] = {(float)corner, (float)corner, (float)corner};
        double       p[3];
        double       v[9];
        double       size[3];
        tribox_tri   tri;
        for (k = 0; k < 9; k++) {
            p[k % 3] = corner;
            v[k] = k < 3 ? corner : corner + random_signed() * 5e-10;
            size[k % 3] = (random_signed() + 1) * 5e-11;
        }
        tribox_tri_init_f64(&tri, v, v + 3, v + 6, size, 0);
        CHECK(tribox_tri_octants(&tri, p32) == tribox_tri_octants_f64(&tri, p));
    }
}

int main(void)
{
    RUN(clipped_polygons_are_exact);
    RUN(a_clipped_triangle_can_have_nine_corners);
    RUN(clips_of_any_floats_lie_inside);
    RUN(clips_without_a_question);
    RUN(corners_at_the_largest_float_stay);
    RUN(corners_that_round_alike_are_merged);
    RUN(half_way_cuts_go_to_the_even_float);
    RUN(nearest_points_are_exact);
    RUN(nearest_points_of_any_floats);
    RUN(nearest_without_a_question);
    RUN(sure_runs_equal_exact_runs);
    RUN(numbers_in_double_hold_their_bound);
    RUN(mesh_queries_are_exact);
    RUN(octants_are_exact);
    RUN(octants_of_odd_sizes);
    RUN(octants_whose_corners_are_no_doubles);
    RUN(octants_of_doubles_beyond_floats);
    RUN(octants_far_from_the_origin);
    return test_report("test_companions_cut");
}
