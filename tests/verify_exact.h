/* Exact answers with GMP, by two methods that share nothing but the reading of the input:
 *
 *   exact_axes   separating axes in integers: all numbers are brought to one power-of-two scale
 *   exact_clip   the triangle clipped by the box in rationals; thin voxels by their corners
 *
 * Neither uses floating-point arithmetic, and neither has code or tricks in common with tribox.h. Answers are
 * masks, one bit for each rule, so that one evaluation serves every flag. exact_axes can also be broken on
 * purpose (EXACT_MUTANTS), to show that the cases a program tries would reveal such a fault.
 */
#ifndef VERIFY_EXACT_H
#define VERIFY_EXACT_H

#include <gmp.h>
#include <stdint.h>
#include <string.h>

enum { RULE_CLOSED, RULE_HALF_OPEN, RULE_OPEN, RULE_THIN, RULES };

enum { ASK_BOX, ASK_TRI, ASK_GRID };

/* One triangle against one box: numbers 0..8 are the corners, 9..11 box_min, p or origin, 12..14 box_max or
 * size, both of these exact: the box of ASK_TRI is [p, p + size] in real numbers, moved by index * size. */
typedef struct question {
    double x[15];
    int index[3]; /* ASK_GRID: the first voxel */
    int last[3];  /* ASK_GRID: the last voxel; the box is all of them together */
    int kind;
} question;

/* What exact_axes may get wrong on purpose. 1..13: that separating axis is not tested. */
enum {
    MUTANT_NONE,
    MUTANT_AXIS_FIRST = 1,
    MUTANT_AXIS_LAST = 13,
    MUTANT_CLOSED_AS_OPEN,
    MUTANT_OPEN_AS_CLOSED,
    MUTANT_HALF_OPEN_BELOW,
    MUTANT_ONE_SIDED_PLANE,
    MUTANT_SWAPPED_EXTENTS,
    MUTANT_ROUNDED_CORNER,
    MUTANT_THIN_SUM,
    MUTANT_THIN_LARGEST_NORMAL,
    MUTANT_THIN_NO_FACES,
    MUTANT_THIN_REVERSED,
    EXACT_MUTANTS
};

static const char *const exact_mutant_names[EXACT_MUTANTS] = {
    "none",           "no face x",       "no face y",       "no face z",       "no plane",
    "no edge x,0",    "no edge x,1",     "no edge x,2",     "no edge y,0",     "no edge y,1",
    "no edge y,2",    "no edge z,0",     "no edge z,1",     "no edge z,2",     "closed as open",
    "open as closed", "half-open below", "one-sided plane", "swapped extents", "rounded p + size",
    "thin: sum",      "thin: largest n", "thin: no faces",  "thin: xz for zx"};

#define CLIP_MAX 16 /* a triangle clipped by six planes has at most nine corners */

/* The question in integers at one scale, and work space. Infinite box faces are marked, not stored. */
typedef struct exact_judge {
    int meaningful; /* 0: the answer is 0 under every rule */
    int endless;    /* some box face is infinite */
    int lo_inf[3];
    int hi_inf[3];
    mpz_t v[3][3];
    mpz_t lo[3];
    mpz_t hi[3];
    mpz_t tmin[3];
    mpz_t tmax[3];
    mpz_t e[3][3]; /* edge i = v[i + 1] - v[i] */
    mpz_t n[3];
    mpz_t d[3]; /* the axis being tried */
    mpz_t t[8];
    mpq_t polygon[2][CLIP_MAX][3];
    mpq_t q[8];
    int touching; /* some axis had an exact contact */
} exact_judge;

static inline void exact_init(exact_judge *x)
{
    int i, j, k;
    memset(x, 0, sizeof *x);
    for (i = 0; i < 3; ++i) {
        for (j = 0; j < 3; ++j) {
            mpz_init(x->v[i][j]);
            mpz_init(x->e[i][j]);
        }
        mpz_init(x->lo[i]);
        mpz_init(x->hi[i]);
        mpz_init(x->tmin[i]);
        mpz_init(x->tmax[i]);
        mpz_init(x->n[i]);
        mpz_init(x->d[i]);
    }
    for (i = 0; i < 8; ++i) {
        mpz_init(x->t[i]);
        mpq_init(x->q[i]);
    }
    for (i = 0; i < 2; ++i) {
        for (j = 0; j < CLIP_MAX; ++j) {
            for (k = 0; k < 3; ++k) {
                mpq_init(x->polygon[i][j][k]);
            }
        }
    }
}

/* ---- reading the input ------------------------------------------------------------------------ */

static inline uint64_t double_bits(double d)
{
    uint64_t u;
    memcpy(&u, &d, sizeof u);
    return u;
}

static inline int is_finite(double d)
{
    return ((double_bits(d) >> 52) & 0x7ff) != 0x7ff;
}

static inline int is_nan(double d)
{
    return (double_bits(d) << 1) > UINT64_C(0xffe0000000000000);
}

/* d = sign * mantissa * 2^exponent, the mantissa odd or 0 */
static inline int double_parts(double d, uint64_t *mantissa, int *exponent)
{
    uint64_t u = double_bits(d);
    uint64_t m = u & UINT64_C(0xfffffffffffff);
    int e = (int)((u >> 52) & 0x7ff);
    if (e == 0) {
        e = 1;
    } else {
        m |= UINT64_C(1) << 52;
    }
    if (m != 0) {
        int zeros = __builtin_ctzll(m);
        m >>= zeros;
        e += zeros;
    }
    *mantissa = m;
    *exponent = e - 1075;
    return u >> 63 != 0 ? -1 : 1;
}

static inline void set_scaled(mpz_t out, double d, int scale)
{
    uint64_t m;
    int e;
    int sign = double_parts(d, &m, &e);
    mpz_set_ui(out, (unsigned long)m);
    if (m != 0) {
        mpz_mul_2exp(out, out, (mp_bitcnt_t)(e - scale));
    }
    if (sign < 0) {
        mpz_neg(out, out);
    }
}

static inline int sign_of_double(double d)
{
    uint64_t u = double_bits(d);
    return (u << 1) == 0 ? 0 : u >> 63 != 0 ? -1 : 1;
}

/* the parts of a question that are no sets of points, by DESIGN's words on odd inputs */
static inline int exact_meaningful(exact_judge *x, const question *ask)
{
    int i;
    for (i = 0; i < 9; ++i) {
        if (!is_finite(ask->x[i])) {
            return 0;
        }
    }
    x->endless = 0;
    for (i = 0; i < 3; ++i) {
        double a = ask->x[9 + i];
        double b = ask->x[12 + i];
        x->lo_inf[i] = 0;
        x->hi_inf[i] = 0;
        if (is_nan(a) || is_nan(b)) {
            return 0;
        }
        if (ask->kind == ASK_BOX) {
            if ((!is_finite(a) && sign_of_double(a) > 0) || (!is_finite(b) && sign_of_double(b) < 0)) {
                return 0;
            }
            x->lo_inf[i] = !is_finite(a);
        } else if (!is_finite(a) || sign_of_double(b) < 0) {
            return 0;
        }
        if (ask->kind == ASK_GRID && (!is_finite(b) || sign_of_double(b) <= 0)) {
            return 0;
        }
        if (ask->kind == ASK_TRI && !is_finite(b) && ask->index[i] != 0) { /* [inf, inf] */
            return 0;
        }
        x->hi_inf[i] = !is_finite(b);
        x->endless |= x->lo_inf[i] | x->hi_inf[i];
    }
    return 1;
}

/* what follows from the corners: edges and bounds */
static inline void exact_prepare(exact_judge *x)
{
    int i, j;
    for (i = 0; i < 3; ++i) {
        for (j = 0; j < 3; ++j) {
            mpz_sub(x->e[i][j], x->v[(i + 1) % 3][j], x->v[i][j]);
        }
        mpz_set(x->tmin[i], x->v[0][i]);
        mpz_set(x->tmax[i], x->v[0][i]);
        for (j = 1; j < 3; ++j) {
            if (mpz_cmp(x->v[j][i], x->tmin[i]) < 0) {
                mpz_set(x->tmin[i], x->v[j][i]);
            }
            if (mpz_cmp(x->v[j][i], x->tmax[i]) > 0) {
                mpz_set(x->tmax[i], x->v[j][i]);
            }
        }
    }
}

static inline void exact_load(exact_judge *x, const question *ask)
{
    int i, scale = 2000;
    x->touching = 0;
    x->meaningful = exact_meaningful(x, ask);
    if (!x->meaningful) {
        return;
    }
    for (i = 0; i < 15; ++i) {
        uint64_t m;
        int e;
        double_parts(ask->x[i], &m, &e);
        if (is_finite(ask->x[i]) && m != 0 && e < scale) {
            scale = e;
        }
    }
    for (i = 0; i < 9; ++i) {
        set_scaled(x->v[i / 3][i % 3], ask->x[i], scale);
    }
    for (i = 0; i < 3; ++i) {
        if (!x->lo_inf[i]) {
            set_scaled(x->lo[i], ask->x[9 + i], scale);
        }
        if (!x->hi_inf[i]) {
            set_scaled(x->hi[i], ask->x[12 + i], scale);
        }
        if (ask->kind == ASK_GRID) {
            mpz_set(x->t[2], x->lo[i]);
            mpz_set(x->t[3], x->hi[i]);
            mpz_set_si(x->t[0], ask->index[i]);
            mpz_set_si(x->t[1], ask->last[i]);
            mpz_add_ui(x->t[1], x->t[1], 1);
            mpz_addmul(x->lo[i], x->t[3], x->t[0]);
            mpz_set(x->hi[i], x->t[2]);
            mpz_addmul(x->hi[i], x->t[3], x->t[1]);
        } else if (ask->kind == ASK_TRI && !x->hi_inf[i]) {
            mpz_set_si(x->t[0], ask->index[i]);
            mpz_addmul(x->lo[i], x->hi[i], x->t[0]);
            mpz_add(x->hi[i], x->lo[i], x->hi[i]);
        }
    }
    exact_prepare(x);
}

/* the rules under which the box holds points at all */
static inline unsigned exact_nonempty(const exact_judge *x)
{
    unsigned rules = 1u << RULE_CLOSED | 1u << RULE_HALF_OPEN | 1u << RULE_OPEN;
    int i;
    for (i = 0; i < 3; ++i) {
        if (!x->lo_inf[i] && !x->hi_inf[i]) {
            int order = mpz_cmp(x->lo[i], x->hi[i]);
            if (order > 0) {
                return 0;
            }
            if (order == 0) {
                rules &= 1u << RULE_CLOSED;
            }
        }
    }
    return rules;
}

/* ---- separating axes, in integers ------------------------------------------------------------- */

/* An infinite face may as well stand anywhere beyond the triangle: the part of the box there is the same. */
static inline void axes_bound(exact_judge *x)
{
    int i;
    for (i = 0; i < 3; ++i) {
        if (x->lo_inf[i]) {
            mpz_sub_ui(x->lo[i], x->tmin[i], 1);
            if (!x->hi_inf[i] && mpz_cmp(x->hi[i], x->lo[i]) <= 0) {
                mpz_sub_ui(x->lo[i], x->hi[i], 1);
            }
        }
        if (x->hi_inf[i]) {
            mpz_add_ui(x->hi[i], x->tmax[i], 1);
            if (mpz_cmp(x->hi[i], x->lo[i]) <= 0) {
                mpz_add_ui(x->hi[i], x->lo[i], 1);
            }
        }
    }
}

/* sign of the gap between two ends: the rules that survive when `gap` > 0 means apart, 0 means contact */
static inline unsigned axes_gap(exact_judge *x, int gap, int uses_lo, int uses_hi, int mutant)
{
    unsigned closed = 1u << RULE_CLOSED;
    unsigned half = 1u << RULE_HALF_OPEN;
    unsigned open = 1u << RULE_OPEN;
    if (gap > 0) {
        return 0;
    }
    if (gap < 0) {
        return closed | half | open;
    }
    x->touching = 1;
    if (mutant == MUTANT_CLOSED_AS_OPEN) {
        closed = 0;
    }
    if (mutant == MUTANT_HALF_OPEN_BELOW ? uses_lo : uses_hi) {
        half = 0;
    }
    if (mutant != MUTANT_OPEN_AS_CLOSED && (uses_lo || uses_hi)) {
        open = 0;
    }
    return closed | half | open;
}

/* rules not separated along x->d: the projections of the triangle, t[0]..t[1], and of the box, t[2]..t[3],
 * meet */
static inline unsigned axes_along(exact_judge *x, int mutant, int axis)
{
    int i, j;
    unsigned rules;
    int low_lo = 0, low_hi = 0, high_lo = 0, high_hi = 0;
    int one_sided = mutant == MUTANT_ONE_SIDED_PLANE && axis == 3;
    int swapped = mutant == MUTANT_SWAPPED_EXTENTS && axis >= 7 && axis < 10;
    for (i = 0; i < 3; ++i) {
        mpz_set_ui(x->t[4], 0);
        for (j = 0; j < 3; ++j) {
            if (mpz_sgn(x->d[j]) != 0) {
                mpz_addmul(x->t[4], x->d[j], x->v[i][j]);
            }
        }
        if (i == 0 || mpz_cmp(x->t[4], x->t[0]) < 0) {
            mpz_set(x->t[0], x->t[4]);
        }
        if (i == 0 || mpz_cmp(x->t[4], x->t[1]) > 0) {
            mpz_set(x->t[1], x->t[4]);
        }
    }
    mpz_set_ui(x->t[2], 0);
    mpz_set_ui(x->t[3], 0);
    for (j = 0; j < 3; ++j) {
        int s = mpz_sgn(x->d[j]);
        int k = swapped ? 2 - j : j; /* the zx plane's two extents are those of x and z */
        mpz_ptr lo = x->lo[j];
        mpz_ptr hi = x->hi[j];
        if (swapped) {
            /* centre of j, extent of k: lo' = (lo_j + hi_j - (hi_k - lo_k)) / 2; rounding does not matter
             * here */
            mpz_add(x->t[5], x->lo[j], x->hi[j]);
            mpz_sub(x->t[6], x->hi[k], x->lo[k]);
            mpz_sub(x->t[7], x->t[5], x->t[6]);
            mpz_add(x->t[6], x->t[5], x->t[6]);
            mpz_fdiv_q_2exp(x->t[7], x->t[7], 1);
            mpz_fdiv_q_2exp(x->t[6], x->t[6], 1);
            lo = x->t[7];
            hi = x->t[6];
        }
        if (s > 0) {
            mpz_addmul(x->t[2], x->d[j], lo);
            mpz_addmul(x->t[3], x->d[j], hi);
            low_lo = 1;
            high_hi = 1;
        } else if (s < 0) {
            mpz_addmul(x->t[2], x->d[j], hi);
            mpz_addmul(x->t[3], x->d[j], lo);
            low_hi = 1;
            high_lo = 1;
        }
    }
    rules = axes_gap(x, mpz_cmp(x->t[0], x->t[3]), high_lo, high_hi, mutant);
    if (!one_sided && rules != 0) {
        rules &= axes_gap(x, mpz_cmp(x->t[2], x->t[1]), low_lo, low_hi, mutant);
    }
    return rules;
}

static inline void exact_normal(exact_judge *x)
{
    int i;
    for (i = 0; i < 3; ++i) {
        int b = (i + 1) % 3;
        int c = (i + 2) % 3;
        mpz_mul(x->n[i], x->e[0][b], x->e[1][c]);
        mpz_submul(x->n[i], x->e[0][c], x->e[1][b]);
    }
}

/* faces x y z, the plane, then edges 0 1 2 for axes x y z: the mask of rules under which they overlap */
static inline unsigned axes_conservative(exact_judge *x, int mutant)
{
    unsigned rules = exact_nonempty(x);
    int axis;
    if (rules == 0) {
        return 0;
    }
    axes_bound(x);
    exact_normal(x);
    for (axis = 0; axis < 13 && rules != 0; ++axis) {
        int i;
        if (mutant >= MUTANT_AXIS_FIRST && mutant <= MUTANT_AXIS_LAST && axis == mutant - MUTANT_AXIS_FIRST) {
            continue;
        }
        for (i = 0; i < 3; ++i) {
            mpz_set_ui(x->d[i], axis < 3 && axis == i ? 1 : 0);
        }
        if (axis == 3) {
            for (i = 0; i < 3; ++i) {
                mpz_set(x->d[i], x->n[i]);
            }
        } else if (axis > 3) {
            int a = (axis - 4) / 3;
            int e = (axis - 4) % 3;
            mpz_neg(x->d[(a + 1) % 3], x->e[e][(a + 2) % 3]);
            mpz_set(x->d[(a + 2) % 3], x->e[e][(a + 1) % 3]);
        }
        rules &= axes_along(x, mutant, axis);
    }
    return rules;
}

/* out = |a| * (hi - lo) of axis k: the support of a thin voxel along one axis, doubled */
static inline void thin_support(exact_judge *x, mpz_t out, mpz_t a, int k)
{
    mpz_sub(out, x->hi[k], x->lo[k]);
    mpz_mul(out, out, a);
    mpz_abs(out, out);
}

/* keep the larger support (as defined), their sum, or the one of the larger |a| (mutants) */
static inline void thin_gather(exact_judge *x, mpz_t best, mpz_t largest, mpz_t a, int k, int mutant)
{
    thin_support(x, x->t[7], a, k);
    if (mutant == MUTANT_THIN_SUM) {
        mpz_add(best, best, x->t[7]);
    } else if (mutant == MUTANT_THIN_LARGEST_NORMAL) {
        if (mpz_cmpabs(a, largest) > 0) {
            mpz_set(best, x->t[7]);
            mpz_set(largest, a);
        }
    } else if (mpz_cmp(x->t[7], best) > 0) {
        mpz_set(best, x->t[7]);
    }
}

/* [SS10] 6-separating with the products |n_a| h_a, the centre and half size of the whole voxel; everything
 * doubled */
static inline int axes_thin(exact_judge *x, int mutant)
{
    int a, i;
    if ((exact_nonempty(x) & 1u << RULE_CLOSED) == 0) {
        return 0;
    }
    for (a = 0; a < 3 && mutant != MUTANT_THIN_NO_FACES; ++a) {
        if (mpz_cmp(x->lo[a], x->tmax[a]) > 0 || mpz_cmp(x->hi[a], x->tmin[a]) < 0) {
            return 0;
        }
    }
    exact_normal(x);
    mpz_set_ui(x->t[0], 0);
    mpz_set_ui(x->t[1], 0);
    mpz_set_ui(x->t[2], 0);
    for (a = 0; a < 3; ++a) {
        mpz_add(x->t[3], x->lo[a], x->hi[a]);
        mpz_submul_ui(x->t[3], x->v[0][a], 2);
        mpz_addmul(x->t[0], x->n[a], x->t[3]);
        thin_gather(x, x->t[1], x->t[2], x->n[a], a, mutant);
    }
    if (mpz_cmpabs(x->t[0], x->t[1]) > 0) {
        return 0;
    }
    for (a = 0; a < 3; ++a) {
        int b = (a + 1) % 3;
        int c = (a + 2) % 3;
        int s = mpz_sgn(x->n[a]);
        int flip = mutant == MUTANT_THIN_REVERSED && a == 1 ? s > 0 : s < 0;
        for (i = 0; i < 3; ++i) {
            mpz_add(x->t[3], x->lo[b], x->hi[b]);
            mpz_submul_ui(x->t[3], x->v[i][b], 2);
            mpz_add(x->t[4], x->lo[c], x->hi[c]);
            mpz_submul_ui(x->t[4], x->v[i][c], 2);
            mpz_mul(x->t[0], x->e[i][b], x->t[4]);
            mpz_submul(x->t[0], x->e[i][c], x->t[3]);
            if (flip) {
                mpz_neg(x->t[0], x->t[0]);
            }
            mpz_set_ui(x->t[1], 0);
            mpz_set_ui(x->t[2], 0);
            thin_gather(x, x->t[1], x->t[2], x->e[i][c], b, mutant);
            thin_gather(x, x->t[1], x->t[2], x->e[i][b], c, mutant);
            mpz_add(x->t[0], x->t[0], x->t[1]);
            if (mpz_sgn(x->t[0]) < 0) {
                return 0;
            }
        }
    }
    return 1;
}

/* A thin voxel without end has no centre: it counts as the conservative one. A one-box test is never thin. */
static inline int exact_thin_as_closed(const exact_judge *x, const question *ask)
{
    return x->endless || ask->kind == ASK_BOX;
}

static inline unsigned exact_axes_mutant(exact_judge *x, const question *ask, int mutant)
{
    unsigned rules;
    question rounded;
    if (mutant == MUTANT_ROUNDED_CORNER && ask->kind == ASK_TRI) {
        int i;
        rounded = *ask;
        rounded.kind = ASK_BOX;
        for (i = 0; i < 3; ++i) {
            rounded.x[12 + i] = ask->x[9 + i] + ask->x[12 + i];
        }
        ask = &rounded;
    }
    exact_load(x, ask);
    if (!x->meaningful) {
        return 0;
    }
    if (exact_thin_as_closed(x, ask)) {
        rules = axes_conservative(x, mutant);
        return rules | (rules & 1u << RULE_CLOSED) << RULE_THIN;
    }
    rules = (unsigned)axes_thin(x, mutant) << RULE_THIN;
    return rules | axes_conservative(x, mutant);
}

static inline unsigned exact_axes(exact_judge *x, const question *ask)
{
    return exact_axes_mutant(x, ask, MUTANT_NONE);
}

/* ---- clipping, in rationals ------------------------------------------------------------------- */

/* keeps the part of polygon `from` with sign * (coordinate a - face) >= 0; returns the number of corners left
 */
static inline int clip_by_face(exact_judge *x, int from, int corners, int a, mpz_t face, int sign)
{
    mpq_t(*in)[3] = x->polygon[from];
    mpq_t(*out)[3] = x->polygon[1 - from];
    int i, k, n = 0;
    mpq_set_z(x->q[0], face);
    for (i = 0; i < corners; ++i) {
        int j = (i + 1) % corners;
        int si = sign * mpq_cmp(in[i][a], x->q[0]);
        int sj = sign * mpq_cmp(in[j][a], x->q[0]);
        if (si >= 0) {
            for (k = 0; k < 3; ++k) {
                mpq_set(out[n][k], in[i][k]);
            }
            ++n;
        }
        if ((si > 0 && sj < 0) || (si < 0 && sj > 0)) {
            /* t = (face - in_i) / (in_j - in_i) */
            mpq_sub(x->q[1], x->q[0], in[i][a]);
            mpq_sub(x->q[2], in[j][a], in[i][a]);
            mpq_div(x->q[1], x->q[1], x->q[2]);
            for (k = 0; k < 3; ++k) {
                mpq_sub(x->q[2], in[j][k], in[i][k]);
                mpq_mul(x->q[2], x->q[2], x->q[1]);
                mpq_add(out[n][k], in[i][k], x->q[2]);
            }
            ++n;
        }
    }
    return n;
}

/* Some corner of the polygon lies strictly inside the face; by convexity, if that holds for each open face,
 * the mean of such corners lies inside all of them. */
static inline int clip_reaches_inside(exact_judge *x, int from, int corners, int a, mpz_t face, int sign)
{
    int i;
    mpq_set_z(x->q[0], face);
    for (i = 0; i < corners; ++i) {
        if (sign * mpq_cmp(x->polygon[from][i][a], x->q[0]) > 0) {
            return 1;
        }
    }
    return 0;
}

/* The triangle clipped by the box, in polygon[*out_now]: corners may coincide or lie between others. */
static inline int clip_polygon(exact_judge *x, int *out_now)
{
    int i, k, now = 0, corners = 3;
    for (i = 0; i < 3; ++i) {
        for (k = 0; k < 3; ++k) {
            mpq_set_z(x->polygon[0][i][k], x->v[i][k]);
        }
    }
    for (k = 0; k < 3 && corners > 0; ++k) {
        if (!x->lo_inf[k]) {
            corners = clip_by_face(x, now, corners, k, x->lo[k], 1);
            now = 1 - now;
        }
        if (!x->hi_inf[k]) {
            corners = clip_by_face(x, now, corners, k, x->hi[k], -1);
            now = 1 - now;
        }
    }
    *out_now = now;
    return corners;
}

static inline unsigned clip_conservative(exact_judge *x)
{
    unsigned rules = exact_nonempty(x);
    int k, now, corners;
    if (rules == 0) {
        return 0;
    }
    corners = clip_polygon(x, &now);
    if (corners == 0) {
        return 0;
    }
    for (k = 0; k < 3; ++k) {
        if (!x->hi_inf[k] && !clip_reaches_inside(x, now, corners, k, x->hi[k], -1)) {
            rules &= 1u << RULE_CLOSED;
        }
        if (!x->lo_inf[k] && !clip_reaches_inside(x, now, corners, k, x->lo[k], 1)) {
            rules &= 1u << RULE_CLOSED | 1u << RULE_HALF_OPEN;
        }
    }
    return rules;
}

/* out = coordinate k of corner `which` of a thin voxel: 0 and 1 its ends along axis 0, 2 and 3 along 1, 4 and
 * 5 along 2 */
static inline void thin_corner(exact_judge *x, mpq_t out, int which, int k)
{
    if (which / 2 == k) {
        mpq_set_z(out, which % 2 == 0 ? x->lo[k] : x->hi[k]);
        return;
    }
    mpz_add(x->t[0], x->lo[k], x->hi[k]);
    mpq_set_z(out, x->t[0]);
    mpq_div_2exp(out, out, 1);
}

/* orientation of triangle corners i, j and the thin voxel's corner, seen along axis a */
static inline int thin_side(exact_judge *x, int i, int j, int which, int a)
{
    int b = (a + 1) % 3;
    int c = (a + 2) % 3;
    thin_corner(x, x->q[0], which, b);
    thin_corner(x, x->q[1], which, c);
    mpq_set_z(x->q[2], x->v[i][b]);
    mpq_set_z(x->q[3], x->v[i][c]);
    mpq_sub(x->q[0], x->q[0], x->q[2]);
    mpq_sub(x->q[1], x->q[1], x->q[3]);
    mpq_set_z(x->q[4], x->v[j][b]);
    mpq_set_z(x->q[5], x->v[j][c]);
    mpq_sub(x->q[4], x->q[4], x->q[2]);
    mpq_sub(x->q[5], x->q[5], x->q[3]);
    mpq_mul(x->q[4], x->q[4], x->q[1]);
    mpq_mul(x->q[5], x->q[5], x->q[0]);
    return mpq_cmp(x->q[4], x->q[5]);
}

/* orientation of the triangle seen along axis a */
static inline int thin_turn(exact_judge *x, int a)
{
    int b = (a + 1) % 3;
    int c = (a + 2) % 3;
    mpz_sub(x->t[0], x->v[1][b], x->v[0][b]);
    mpz_sub(x->t[1], x->v[2][c], x->v[0][c]);
    mpz_mul(x->t[2], x->t[0], x->t[1]);
    mpz_sub(x->t[0], x->v[1][c], x->v[0][c]);
    mpz_sub(x->t[1], x->v[2][b], x->v[0][b]);
    mpz_submul(x->t[2], x->t[0], x->t[1]);
    return mpz_sgn(x->t[2]);
}

/* side of the triangle's plane on which a thin voxel's corner lies */
static inline int thin_plane_side(exact_judge *x, int which)
{
    int k;
    mpq_set_ui(x->q[6], 0, 1);
    for (k = 0; k < 3; ++k) {
        int b = (k + 1) % 3;
        int c = (k + 2) % 3;
        mpz_sub(x->t[1], x->v[1][b], x->v[0][b]);
        mpz_sub(x->t[2], x->v[2][c], x->v[0][c]);
        mpz_mul(x->t[3], x->t[1], x->t[2]);
        mpz_sub(x->t[1], x->v[1][c], x->v[0][c]);
        mpz_sub(x->t[2], x->v[2][b], x->v[0][b]);
        mpz_submul(x->t[3], x->t[1], x->t[2]);
        thin_corner(x, x->q[0], which, k);
        mpq_set_z(x->q[1], x->v[0][k]);
        mpq_sub(x->q[0], x->q[0], x->q[1]);
        mpq_set_z(x->q[1], x->t[3]);
        mpq_mul(x->q[0], x->q[0], x->q[1]);
        mpq_add(x->q[6], x->q[6], x->q[0]);
    }
    return mpq_sgn(x->q[6]);
}

/* Thin support max |n_a| h_a is that of the six face centres: some centre must lie on or inside each edge
 * line of each projection, and centres on both sides of, or on, the plane; and the box must meet the
 * triangle's. */
static inline int clip_thin(exact_judge *x)
{
    int a, i, which, above = 0, below = 0;
    if ((exact_nonempty(x) & 1u << RULE_CLOSED) == 0) {
        return 0;
    }
    for (a = 0; a < 3; ++a) {
        int under = 0, over = 0;
        for (i = 0; i < 3; ++i) {
            under += mpz_cmp(x->v[i][a], x->lo[a]) < 0;
            over += mpz_cmp(x->v[i][a], x->hi[a]) > 0;
        }
        if (under == 3 || over == 3) {
            return 0;
        }
    }
    for (which = 0; which < 6; ++which) {
        int s = thin_plane_side(x, which);
        above |= s >= 0;
        below |= s <= 0;
    }
    if (!above || !below) {
        return 0;
    }
    for (a = 0; a < 3; ++a) {
        int turn = thin_turn(x, a);
        for (i = 0; i < 3; ++i) {
            int from = turn >= 0 ? i : (i + 1) % 3;
            int to = turn >= 0 ? (i + 1) % 3 : i;
            int inside = 0;
            for (which = 0; which < 6; ++which) {
                inside |= which / 2 != a && thin_side(x, from, to, which, a) >= 0;
            }
            if (!inside) {
                return 0;
            }
        }
    }
    return 1;
}

static inline unsigned exact_clip(exact_judge *x, const question *ask)
{
    unsigned rules;
    exact_load(x, ask);
    if (!x->meaningful) {
        return 0;
    }
    rules = clip_conservative(x);
    if (exact_thin_as_closed(x, ask)) {
        return rules | (rules & 1u << RULE_CLOSED) << RULE_THIN;
    }
    return rules | (unsigned)clip_thin(x) << RULE_THIN;
}

/* ---- grid indices ----------------------------------------------------------------------------- */

/* out = floor((point - origin) / size); 0 when there is no such integer */
static inline int exact_index(exact_judge *x, double point, double origin, double size, mpz_t out)
{
    uint64_t m;
    int e, i, scale = 2000;
    double all[3];
    if (!is_finite(point) || !is_finite(origin) || !is_finite(size) || sign_of_double(size) <= 0) {
        return 0;
    }
    all[0] = point;
    all[1] = origin;
    all[2] = size;
    for (i = 0; i < 3; ++i) {
        double_parts(all[i], &m, &e);
        if (m != 0 && e < scale) {
            scale = e;
        }
    }
    set_scaled(x->t[0], point, scale);
    set_scaled(x->t[1], origin, scale);
    set_scaled(x->t[2], size, scale);
    mpz_sub(x->t[0], x->t[0], x->t[1]);
    mpz_fdiv_q(out, x->t[0], x->t[2]);
    return 1;
}

static inline unsigned rule_of(unsigned flags)
{
    return (flags & 4u) != 0   ? RULE_THIN
           : (flags & 2u) != 0 ? RULE_OPEN
           : (flags & 1u) != 0 ? RULE_HALF_OPEN
                               : RULE_CLOSED;
}

#endif
