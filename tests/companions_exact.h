/* Exact answers to the questions of companions.h with GMP, for verify, the golden answers and the fuzzers.
 * Like verify_exact.h this uses no floating-point arithmetic and has no code or trick in common with
 * tribox.h. Each answer has a second method that must agree (contact_exact.h has those of contact):
 *
 *   function             companion_judge                      companion_confirm
 *   box_box              intervals in rationals               a corner between corners, per axis
 *   plane_box            all eight corners                    the critical corners
 *   segment_box          13 axis intervals, moving            clipping by the box
 *   ray_box, sweep,      the intersection of the intervals    the solid that the triangle sweeps out against
 *   ray_triangle         of 13 axes, moving                   the box; overlap at the exact ends of contact,
 *                                                             none just before and after
 *   clip                 clipped face by face, then extreme   all points where edges meet faces, in order
 *                        points
 *   closest              the least of seven distances         no corner lies farther towards q (convexity)
 *   octants, query       separating axes                      clipping
 *
 * companion_judge can also be broken on purpose (COMPANION_MUTANTS).
 */
#ifndef COMPANIONS_EXACT_H
#define COMPANIONS_EXACT_H

#include "companions.h"
#include "verify_exact.h"

/* What the judge may get wrong on purpose. 1..13: that axis of a motion is left out. */
enum {
    WRONG_NOTHING,
    WRONG_AXIS_FIRST = 1,
    WRONG_AXIS_LAST = 13,
    WRONG_OPEN_AXES,      /* a motion that only touches misses */
    WRONG_OPEN_ENDS,      /* contact at one moment misses */
    WRONG_NO_START,       /* a motion begins before t_min */
    WRONG_NO_END,         /* and goes on past t_max */
    WRONG_START_NEAREST,  /* ends rounded to nearest */
    WRONG_END_NEAREST,    /**/
    WRONG_LAST_AXIS,      /* the last axis to open instead of the first */
    WRONG_AXIS_REVERSED,  /* the axis from box to triangle */
    WRONG_NO_ZERO_GAP,    /* at t = 0 only axes that open count */
    WRONG_OPEN_BOXES,     /* boxes that touch miss */
    WRONG_OPEN_PLANE,     /* a plane that touches misses */
    WRONG_ONE_CORNER,     /* a plane's upper critical corner only */
    WRONG_NO_MERGE,       /* corners that round alike are kept */
    WRONG_NO_EXTREMES,    /* so are those between others */
    WRONG_FIRST_CORNER,   /* a polygon begins where it happens to */
    WRONG_TURN,           /* a polygon turns the other way */
    WRONG_TRUNCATED,      /* its coordinates and closest's weights are cut off */
    WRONG_NO_FACE_POINT,  /* the nearest point is on an edge */
    WRONG_NO_EDGE_POINT,  /* or never inside an edge */
    WRONG_HIGH_INDEX,     /* weights at the highest indices */
    WRONG_OCTANT_ORDER,   /* octants z + 2y + 4x */
    WRONG_OCTANT_ROUNDED, /* p + size rounded */
    WRONG_QUERY_LAST,     /* the last triangle is left out */
    WRONG_RULE,           /* open as closed */
    WRONG_GAP_SIDE,       /* of two directions that tie the other one */
    WRONG_SEGMENT_ORDER,  /* x before z */
    WRONG_OPEN_BALL,      /* a sphere that touches misses */
    COMPANION_MUTANTS
};

static const char *const companion_mutant_names[COMPANION_MUTANTS] = {
    "none",
    "no face x",
    "no face y",
    "no face z",
    "no normal",
    "no edge 0 x x",
    "no edge 1 x x",
    "no edge 2 x x",
    "no edge 0 x y",
    "no edge 1 x y",
    "no edge 2 x y",
    "no edge 0 x z",
    "no edge 1 x z",
    "no edge 2 x z",
    "touching misses",
    "one moment misses",
    "no t_min",
    "no t_max",
    "t0 to nearest",
    "t1 to nearest",
    "the last axis",
    "axis reversed",
    "no zero gap",
    "boxes open",
    "plane open",
    "one critical corner",
    "not merged",
    "not only extremes",
    "no least corner",
    "wrong winding",
    "truncated",
    "no face point",
    "no edge point",
    "highest indices",
    "octants z y x",
    "octants rounded",
    "query ends early",
    "open as closed",
    "gap's other side",
    "x before z",
    "sphere open",
};

static const char *const companion_names[COMPANIONS] = {
    "box_box", "plane_box", "segment_box", "ray_box", "ray_triangle",
    "sweep",   "clip",      "closest",     "octants", "mesh_query",
    "sweep_rule", "sweep_box", "gap", "grid_segment", "sphere_sphere",
    "plane_sphere", "sphere_box", "sphere_triangle", "ray_sphere"};

static inline int contact_mutant_applies(int which, int mutant);

/* Can it matter to this function? */
static inline int companion_mutant_applies(int which, int mutant)
{
    if (which > COMPANION_QUERY) {
        return contact_mutant_applies(which, mutant);
    }
    switch (which) {
    case COMPANION_SEGMENT_BOX:
        return mutant <= WRONG_AXIS_LAST && mutant != WRONG_AXIS_FIRST + 3;
    case COMPANION_RAY_BOX:
        return mutant <= WRONG_AXIS_FIRST + 2 || (mutant >= WRONG_OPEN_AXES && mutant <= WRONG_END_NEAREST);
    case COMPANION_RAY_TRIANGLE:
        return mutant <= WRONG_START_NEAREST;
    case COMPANION_SWEEP:
        return mutant <= WRONG_NO_ZERO_GAP;
    case COMPANION_BOX_BOX:
        return mutant == WRONG_OPEN_BOXES;
    case COMPANION_PLANE_BOX:
        return mutant == WRONG_OPEN_PLANE || mutant == WRONG_ONE_CORNER;
    case COMPANION_CLIP:
        return mutant >= WRONG_NO_MERGE && mutant <= WRONG_TRUNCATED;
    case COMPANION_CLOSEST:
        return mutant >= WRONG_TRUNCATED && mutant <= WRONG_HIGH_INDEX;
    case COMPANION_OCTANTS:
        return mutant == WRONG_OCTANT_ORDER || mutant == WRONG_OCTANT_ROUNDED;
    default:
        return mutant == WRONG_QUERY_LAST;
    }
}

/* An infinite t as a power of two: finite contacts of floats are before 2^278, of doubles, whose edges and
 * normals have components down to 2^-2148 and differences up to 2^2100 units of them, before 2^7000. */
#define FAR_TIME(f64) ((f64) ? 16000 : 400)
/* An infinite face: a normal's least component (2^-298, 2^-2148) times it is past all. */
#define FAR_FACE(f64) ((f64) ? 9000 : 1000)
#define POLYGON_MAX 64 /* candidates for extreme points */

typedef struct companion_work {
    int f64;
    double x[COMPANION_NUMBERS];
    exact_judge overlap;
    /* a motion: T stands still, the box moves by t * u; all lengths times 2^-scale */
    int scale;
    mpz_t v[3][3], lo[3], hi[3], u[3];
    mpq_t t_min, t_max;
    mpq_t first, last;     /* the interval of contact */
    mpq_t opens[13];       /* where each axis begins to let them meet */
    int has_opens[13];
    int side[13];          /* +1 or -1: the way from T to the box, along the axis; 0: both */
    int zero_gap[13];      /* at t = 0 */
    mpz_t l[3];            /* the axis being tried */
    mpz_t axis[3];         /* of the sweep; 0 if there is none */
    int axis_side;
    mpz_t z[12];
    mpq_t q[24];
    mpq_t points[POLYGON_MAX][3];
    mpq_t others[POLYGON_MAX][3];
    mpq_t corner[5][3];    /* inputs as rationals: v0 v1 v2 w o */
    mpq_t nearest[3];
} companion_work;

static inline void companion_init(companion_work *c)
{
    int i, k;
    memset(c, 0, sizeof *c);
    exact_init(&c->overlap);
    mpq_inits(c->t_min, c->t_max, c->first, c->last, NULL);
    for (i = 0; i < 3; ++i) {
        mpz_inits(c->v[i][0], c->v[i][1], c->v[i][2], c->lo[i], c->hi[i], c->u[i], c->l[i], c->axis[i], NULL);
        mpq_init(c->nearest[i]);
    }
    for (i = 0; i < 13; ++i) {
        mpq_init(c->opens[i]);
    }
    for (i = 0; i < 12; ++i) {
        mpz_init(c->z[i]);
    }
    for (i = 0; i < 24; ++i) {
        mpq_init(c->q[i]);
    }
    for (k = 0; k < 3; ++k) {
        for (i = 0; i < POLYGON_MAX; ++i) {
            mpq_init(c->points[i][k]);
            mpq_init(c->others[i][k]);
        }
        for (i = 0; i < 5; ++i) {
            mpq_init(c->corner[i][k]);
        }
    }
}

/* ---- numbers in and out ----------------------------------------------------------------------- */

static inline double companion_number(uint64_t bits, int f64)
{
    double d;
    if (f64) {
        memcpy(&d, &bits, sizeof d);
    } else {
        uint32_t word = (uint32_t)bits;
        float f;
        memcpy(&f, &word, sizeof f);
        d = (double)f;
    }
    return d;
}

static inline void companion_rational(mpq_t out, double d)
{
    uint64_t m;
    int e;
    int sign = double_parts(d, &m, &e);
    mpq_set_ui(out, (unsigned long)m, 1);
    if (m != 0 && e > 0) {
        mpq_mul_2exp(out, out, (mp_bitcnt_t)e);
    } else if (m != 0) {
        mpq_div_2exp(out, out, (mp_bitcnt_t)-e);
    }
    if (sign < 0) {
        mpq_neg(out, out);
    }
}

enum { ROUND_DOWN, ROUND_NEAREST, ROUND_UP, ROUND_ZERO };

/* the bits of the rational rounded to the question's format: magnitudes as m * 2^e with 24 (53) bits, or
 * e = -149 (-1074) */
static inline uint64_t companion_round(companion_work *c, const mpq_t x, int rounding)
{
    mpz_ptr m = c->z[10];
    mpz_ptr rest = c->z[11];
    const int digits = c->f64 ? 53 : 24;
    const int least = c->f64 ? -1074 : -149;
    const int most = c->f64 ? 971 : 104;
    const uint64_t infinity = c->f64 ? (uint64_t)0x7ff << 52 : 0x7f800000u;
    const int negative = mpq_sgn(x) < 0;
    const uint64_t sign = negative ? (uint64_t)1 << (c->f64 ? 63 : 31) : 0u;
    long e;
    int up;
    uint64_t bits;
    if (mpq_sgn(x) == 0) {
        return 0;
    }
    e = (long)mpz_sizeinbase(mpq_numref(x), 2) - (long)mpz_sizeinbase(mpq_denref(x), 2) - digits;
    for (;;) { /* the quotient has as many bits, or one more: then once more */
        e = e < least ? least : e;
        mpz_abs(m, mpq_numref(x));
        mpz_set(rest, mpq_denref(x));
        if (e < 0) {
            mpz_mul_2exp(m, m, (mp_bitcnt_t)-e);
        } else {
            mpz_mul_2exp(rest, rest, (mp_bitcnt_t)e);
        }
        mpz_set(c->z[9], rest);
        mpz_fdiv_qr(m, rest, m, rest);
        if (mpz_sizeinbase(m, 2) <= (size_t)digits) {
            break;
        }
        ++e;
    }
    mpz_mul_2exp(rest, rest, 1);
    up = mpz_cmp(rest, c->z[9]);
    if (rounding == ROUND_NEAREST) {
        up = up > 0 || (up == 0 && mpz_odd_p(m));
    } else {
        up = mpz_sgn(rest) != 0 && (rounding == ROUND_UP ? !negative : rounding == ROUND_DOWN && negative);
    }
    if (e > most) { /* too large: the largest number, or beyond it */
        up = rounding == ROUND_NEAREST ||
             (rounding == ROUND_UP ? !negative : rounding == ROUND_DOWN && negative);
        return sign | (infinity - !up);
    }
    bits = (uint64_t)mpz_get_ui(m);
    bits = bits >> (digits - 1) == 0 ? bits : bits + ((uint64_t)(e - least) << (digits - 1));
    bits += (uint64_t)up;
    return bits == 0 ? 0 : sign | bits;
}

/* ---- questions without a set ------------------------------------------------------------------ */

static inline int companion_finite(const double *x, int n)
{
    while (n-- > 0) {
        if (!is_finite(x[n])) {
            return 0;
        }
    }
    return 1;
}

static inline int companion_is_box(const double lo[3], const double hi[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        if (is_nan(lo[k]) || is_nan(hi[k]) || (!is_finite(lo[k]) && sign_of_double(lo[k]) > 0) ||
            (!is_finite(hi[k]) && sign_of_double(hi[k]) < 0)) {
            return 0;
        }
        if (is_finite(lo[k]) && is_finite(hi[k])) {
            int negative = sign_of_double(lo[k]) < 0;
            uint64_t a = double_bits(lo[k]) << 1;
            uint64_t b = double_bits(hi[k]) << 1;
            if (negative != (sign_of_double(hi[k]) < 0) ? !negative : negative ? a < b : a > b) {
                return 0;
            }
        }
    }
    return 1;
}

/* ---- motion: loading -------------------------------------------------------------------------- */

static inline int companion_scale(const double *x, int n)
{
    int i, scale = 2000;
    for (i = 0; i < n; ++i) {
        uint64_t m;
        int e;
        double_parts(x[i], &m, &e);
        if (is_finite(x[i]) && m != 0 && e < scale) {
            scale = e;
        }
    }
    return scale == 2000 ? 0 : scale;
}

static inline void companion_time(const companion_work *c, mpq_t out, double t)
{
    if (is_finite(t)) {
        companion_rational(out, t);
        return;
    }
    mpq_set_si(out, sign_of_double(t), 1);
    mpq_mul_2exp(out, out, (mp_bitcnt_t)FAR_TIME(c->f64));
}

/* T, the box, its velocity; 0 if the motion holds no points */
static inline int motion_load(companion_work *c, const double v[9], const double lo[3], const double hi[3],
                              const double u[3], double t_min, double t_max)
{
    double all[18];
    int i, k;
    if (!companion_finite(v, 9) || !companion_finite(u, 3) || !companion_is_box(lo, hi) || is_nan(t_min) ||
        is_nan(t_max) || (!is_finite(t_min) && sign_of_double(t_min) > 0) ||
        (!is_finite(t_max) && sign_of_double(t_max) < 0)) {
        return 0;
    }
    memcpy(all, v, 9 * sizeof *v);
    memcpy(all + 9, lo, 3 * sizeof *v);
    memcpy(all + 12, hi, 3 * sizeof *v);
    memcpy(all + 15, u, 3 * sizeof *v);
    c->scale = companion_scale(all, 18);
    for (k = 0; k < 3; ++k) {
        for (i = 0; i < 3; ++i) {
            set_scaled(c->v[i][k], v[3 * i + k], c->scale);
        }
        set_scaled(c->u[k], u[k], c->scale);
        for (i = 0; i < 2; ++i) {
            mpz_ptr face = i == 0 ? c->lo[k] : c->hi[k];
            double at = i == 0 ? lo[k] : hi[k];
            if (is_finite(at)) {
                set_scaled(face, at, c->scale);
            } else {
                mpz_set_si(face, sign_of_double(at));
                mpz_mul_2exp(face, face, (mp_bitcnt_t)(FAR_FACE(c->f64) - c->scale));
            }
        }
    }
    companion_time(c, c->t_min, t_min);
    companion_time(c, c->t_max, t_max);
    return mpq_cmp(c->t_min, c->t_max) <= 0;
}

/* ---- motion: 13 axis intervals ---------------------------------------------------------------- */

static inline void motion_axis(companion_work *c, int axis, mpz_t l[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        int b = (k + 1) % 3;
        int d = (k + 2) % 3;
        if (axis < 3) {
            mpz_set_ui(l[k], axis == k ? 1 : 0);
        } else if (axis == 3) { /* v0 x v1 + v1 x v2 + v2 x v0 */
            int i;
            mpz_set_ui(l[k], 0);
            for (i = 0; i < 3; ++i) {
                mpz_addmul(l[k], c->v[i][b], c->v[(i + 1) % 3][d]);
                mpz_submul(l[k], c->v[i][d], c->v[(i + 1) % 3][b]);
            }
        } else { /* edge i x unit a */
            int a = (axis - 4) / 3;
            int i = (axis - 4) % 3;
            int j = (i + 1) % 3;
            mpz_set_ui(l[k], 0);
            if (d == a) { /* component k of e x a = e_b a_d - e_d a_b */
                mpz_sub(l[k], c->v[j][b], c->v[i][b]);
            } else if (b == a) {
                mpz_sub(l[k], c->v[i][d], c->v[j][d]);
            }
        }
    }
}

static inline void motion_dot(mpz_t out, mpz_t a[3], mpz_t b[3])
{
    mpz_mul(out, a[0], b[0]);
    mpz_addmul(out, a[1], b[1]);
    mpz_addmul(out, a[2], b[2]);
}

/* T from z[0] to z[1], the box from z[2] to z[3], its speed z[4], along l */
static inline void motion_project(companion_work *c)
{
    int i, k;
    for (i = 0; i < 3; ++i) {
        motion_dot(c->z[8], c->l, c->v[i]);
        if (i == 0 || mpz_cmp(c->z[8], c->z[0]) < 0) {
            mpz_set(c->z[0], c->z[8]);
        }
        if (i == 0 || mpz_cmp(c->z[8], c->z[1]) > 0) {
            mpz_set(c->z[1], c->z[8]);
        }
    }
    mpz_set_ui(c->z[2], 0);
    mpz_set_ui(c->z[3], 0);
    for (k = 0; k < 3; ++k) {
        int s = mpz_sgn(c->l[k]);
        if (s != 0) {
            mpz_addmul(c->z[2], c->l[k], s > 0 ? c->lo[k] : c->hi[k]);
            mpz_addmul(c->z[3], c->l[k], s > 0 ? c->hi[k] : c->lo[k]);
        }
    }
    motion_dot(c->z[4], c->l, c->u);
}

/* Cuts [first, last] by the times at which the projections on one axis meet; 0 if they never do. */
static inline int motion_meet(companion_work *c, int axis, int wrong)
{
    int below, above, moving, rising;
    motion_axis(c, axis, c->l);
    if (mpz_sgn(c->l[0]) == 0 && mpz_sgn(c->l[1]) == 0 && mpz_sgn(c->l[2]) == 0) {
        return 1;
    }
    motion_project(c);
    below = mpz_cmp(c->z[3], c->z[0]); /* < 0: the box is wholly below T at t = 0 */
    above = mpz_cmp(c->z[1], c->z[2]); /* < 0: wholly above */
    moving = mpz_sgn(c->z[4]);
    c->zero_gap[axis] = below == 0 || above == 0;
    c->side[axis] = (above == 0) - (below == 0);
    if (moving == 0) {
        return wrong == WRONG_OPEN_AXES ? below > 0 && above > 0 : below >= 0 && above >= 0;
    }
    rising = moving > 0;
    c->side[axis] = c->zero_gap[axis] ? c->side[axis] : -moving;
    /* the box's top reaches T's bottom, and its bottom leaves T's top; or the other way round */
    mpz_sub(c->z[8], c->z[0], c->z[3]);
    mpz_sub(c->z[9], c->z[1], c->z[2]);
    mpq_set_num(c->q[0], rising ? c->z[8] : c->z[9]);
    mpq_set_den(c->q[0], c->z[4]);
    mpq_set_num(c->q[1], rising ? c->z[9] : c->z[8]);
    mpq_set_den(c->q[1], c->z[4]);
    mpq_canonicalize(c->q[0]);
    mpq_canonicalize(c->q[1]);
    c->has_opens[axis] = 1;
    mpq_set(c->opens[axis], c->q[0]);
    if (mpq_cmp(c->q[0], c->first) > 0) {
        mpq_set(c->first, c->q[0]);
    }
    if (mpq_cmp(c->q[1], c->last) < 0) {
        mpq_set(c->last, c->q[1]);
    }
    return 1;
}

/* The way from T to the box where the axis opens: against the box's movement. */
static inline void motion_opened(companion_work *c, int wrong)
{
    int axis, chosen = -1, k;
    for (axis = 0; axis < 13; ++axis) {
        if (c->has_opens[axis] && mpq_equal(c->opens[axis], c->first) &&
            (chosen < 0 || wrong == WRONG_LAST_AXIS)) {
            chosen = axis;
        }
    }
    if (chosen >= 0) {
        motion_axis(c, chosen, c->axis);
        motion_dot(c->z[0], c->axis, c->u);
        c->axis_side = -mpz_sgn(c->z[0]);
    }
    for (axis = 0; axis < 13 && chosen < 0 && mpq_sgn(c->first) == 0 && wrong != WRONG_NO_ZERO_GAP; ++axis) {
        if (c->zero_gap[axis]) {
            chosen = axis;
            motion_axis(c, axis, c->axis);
            c->axis_side = c->side[axis];
        }
    }
    for (k = 0; k < 3 && chosen < 0; ++k) {
        mpz_set_ui(c->axis[k], 0);
    }
    if (wrong == WRONG_AXIS_REVERSED) {
        c->axis_side = -c->axis_side;
    }
}

/* Do they meet in [t_min, t_max]? Leaves the interval and the axis. */
static inline int motion_judge(companion_work *c, int wrong)
{
    int axis, order;
    mpq_set(c->first, c->t_min);
    mpq_set(c->last, c->t_max);
    if (wrong == WRONG_NO_START) {
        mpq_set_si(c->first, -1, 1);
        mpq_mul_2exp(c->first, c->first, FAR_TIME(c->f64));
    }
    if (wrong == WRONG_NO_END) {
        mpq_set_si(c->last, 1, 1);
        mpq_mul_2exp(c->last, c->last, FAR_TIME(c->f64));
    }
    for (axis = 0; axis < 13; ++axis) {
        c->has_opens[axis] = 0;
        c->zero_gap[axis] = 0;
    }
    for (axis = 0; axis < 13; ++axis) {
        if (wrong == axis + WRONG_AXIS_FIRST) {
            continue;
        }
        if (!motion_meet(c, axis, wrong)) {
            return 0;
        }
    }
    order = mpq_cmp(c->first, c->last);
    if (order > 0 || (order == 0 && wrong == WRONG_OPEN_ENDS)) {
        return 0;
    }
    motion_opened(c, wrong);
    return 1;
}

/* ---- motion: overlap at one moment, and the swept solid --------------------------------------- */

/* Does the box at time t = n / d meet T? Everything times d. */
static inline int motion_overlap_at(companion_work *c, const mpq_t t)
{
    exact_judge *x = &c->overlap;
    int i, k;
    memset(x->lo_inf, 0, sizeof x->lo_inf);
    memset(x->hi_inf, 0, sizeof x->hi_inf);
    for (k = 0; k < 3; ++k) {
        for (i = 0; i < 3; ++i) {
            mpz_mul(x->v[i][k], c->v[i][k], mpq_denref(t));
        }
        mpz_mul(x->lo[k], c->lo[k], mpq_denref(t));
        mpz_mul(x->hi[k], c->hi[k], mpq_denref(t));
        mpz_addmul(x->lo[k], c->u[k], mpq_numref(t));
        mpz_addmul(x->hi[k], c->u[k], mpq_numref(t));
    }
    exact_prepare(x);
    return (int)(clip_conservative(x) & 1u);
}

/* a moment just beyond t, by less than two different fractions of this problem can be apart */
static inline int motion_overlap_beside(companion_work *c, const mpq_t t, int side)
{
    size_t bits = 0;
    int i, k;
    for (k = 0; k < 3; ++k) {
        for (i = 0; i < 3; ++i) {
            size_t b = mpz_sizeinbase(c->v[i][k], 2);
            bits = b > bits ? b : bits;
        }
        bits = mpz_sizeinbase(c->lo[k], 2) > bits ? mpz_sizeinbase(c->lo[k], 2) : bits;
        bits = mpz_sizeinbase(c->hi[k], 2) > bits ? mpz_sizeinbase(c->hi[k], 2) : bits;
        bits = mpz_sizeinbase(c->u[k], 2) > bits ? mpz_sizeinbase(c->u[k], 2) : bits;
    }
    mpq_set_si(c->q[2], side, 1);
    mpq_div_2exp(c->q[2], c->q[2], 6 * bits + 320);
    mpq_add(c->q[2], c->q[2], t);
    return motion_overlap_at(c, c->q[2]);
}

/* a corner of the solid that T sweeps out against the box: corner i at t_min (0) or t_max (1), times both
 * denominators */
static inline void solid_corner(companion_work *c, mpz_t out[3], int i, int at)
{
    int k;
    for (k = 0; k < 3; ++k) {
        mpz_mul(out[k], c->v[i][k], mpq_denref(c->t_min));
        mpz_mul(out[k], out[k], mpq_denref(c->t_max));
        mpz_mul(c->z[0], c->u[k], at ? mpq_numref(c->t_max) : mpq_numref(c->t_min));
        mpz_mul(c->z[0], c->z[0], at ? mpq_denref(c->t_min) : mpq_denref(c->t_max));
        mpz_sub(out[k], out[k], c->z[0]);
    }
}

/* does the triangle of three of the solid's corners meet the box? */
static inline int solid_face(companion_work *c, int i, int at_i, int j, int at_j, int k, int at_k)
{
    exact_judge *x = &c->overlap;
    int a;
    memset(x->lo_inf, 0, sizeof x->lo_inf);
    memset(x->hi_inf, 0, sizeof x->hi_inf);
    solid_corner(c, x->v[0], i, at_i);
    solid_corner(c, x->v[1], j, at_j);
    solid_corner(c, x->v[2], k, at_k);
    for (a = 0; a < 3; ++a) {
        mpz_mul(x->lo[a], c->lo[a], mpq_denref(c->t_min));
        mpz_mul(x->lo[a], x->lo[a], mpq_denref(c->t_max));
        mpz_mul(x->hi[a], c->hi[a], mpq_denref(c->t_min));
        mpz_mul(x->hi[a], x->hi[a], mpq_denref(c->t_max));
    }
    exact_prepare(x);
    return (int)(clip_conservative(x) & 1u);
}

/* six times the volume of p, q, r, s; differences in z[0..8] */
static inline int solid_side(companion_work *c, mpz_t p[3], mpz_t q[3], mpz_t r[3], mpz_t s[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        mpz_sub(c->z[k], q[k], p[k]);
        mpz_sub(c->z[3 + k], r[k], p[k]);
        mpz_sub(c->z[6 + k], s[k], p[k]);
    }
    mpz_set_ui(c->z[9], 0);
    for (k = 0; k < 3; ++k) {
        mpz_mul(c->z[10], c->z[3 + (k + 1) % 3], c->z[6 + (k + 2) % 3]);
        mpz_submul(c->z[10], c->z[3 + (k + 2) % 3], c->z[6 + (k + 1) % 3]);
        mpz_addmul(c->z[9], c->z[k], c->z[10]);
    }
    return mpz_sgn(c->z[9]);
}

/* The solid between T and T moved meets the box: one of its eight surface triangles does, or the box's least
 * corner is inside the solid (which has three pairs of sides). A flat solid is all surface. */
static inline int solid_judge(companion_work *c)
{
    exact_judge *x = &c->overlap;
    mpz_t(*p)[3] = x->e; /* room for three corners; for others n, d, tmin, tmax */
    int i, inside = 1;
    if (solid_face(c, 0, 0, 1, 0, 2, 0) || solid_face(c, 0, 1, 1, 1, 2, 1)) {
        return 1;
    }
    for (i = 0; i < 3; ++i) {
        int j = (i + 1) % 3;
        if (solid_face(c, i, 0, j, 0, i, 1) || solid_face(c, j, 0, j, 1, i, 1)) {
            return 1;
        }
    }
    for (i = 0; i < 3; ++i) {
        solid_corner(c, p[i], i, 0);
    }
    solid_corner(c, x->n, 0, 1);
    for (i = 0; i < 3; ++i) { /* x->lo is still the box's corner, scaled alike */
        mpz_set(x->tmin[i], x->lo[i]);
    }
    i = solid_side(c, p[0], p[1], p[2], x->n);
    if (i == 0) {
        return 0;
    }
    inside &= solid_side(c, p[0], p[1], p[2], x->tmin) == i; /* touching faces were met above */
    solid_corner(c, x->d, 1, 1);
    solid_corner(c, x->tmax, 2, 1);
    inside &= solid_side(c, x->n, x->d, x->tmax, x->tmin) == -i;
    for (i = 0; i < 3 && inside; ++i) { /* edge i and its copy: the third corner is on the box's side */
        int j = (i + 1) % 3;
        int side;
        solid_corner(c, x->n, i, 1);
        side = solid_side(c, p[i], p[j], x->n, p[(i + 2) % 3]);
        inside &= solid_side(c, p[i], p[j], x->n, x->tmin) == side;
    }
    return inside;
}

/* The second method: 1 if the answer and the interval [first, last] are right. */
static inline int motion_confirm(companion_work *c, int yes)
{
    if (solid_judge(c) != yes) {
        return 0;
    }
    if (!yes) {
        return 1;
    }
    return motion_overlap_at(c, c->first) && motion_overlap_at(c, c->last) &&
           (mpq_equal(c->first, c->t_min) || !motion_overlap_beside(c, c->first, -1)) &&
           (mpq_equal(c->last, c->t_max) || !motion_overlap_beside(c, c->last, 1));
}

/* Is the float vector within 2^-22 of the exact unit vector? |f|^2 - 2 f.l / |l| + 1 <= 2^-44 */
static inline int motion_axis_is(companion_work *c, const uint32_t word[3])
{
    mpf_t square, dot, norm, term;
    int k, ok, zero = 1;
    double f[3];
    for (k = 0; k < 3; ++k) {
        f[k] = companion_number(word[k], 0);
        zero &= mpz_sgn(c->axis[k]) == 0;
        if (!is_finite(f[k])) {
            return 0;
        }
    }
    if (zero) {
        return (word[0] | word[1] | word[2]) == 0;
    }
    mpf_init2(square, 512);
    mpf_init2(dot, 512);
    mpf_init2(norm, 512);
    mpf_init2(term, 512);
    motion_dot(c->z[0], c->axis, c->axis);
    mpf_set_z(norm, c->z[0]);
    mpf_sqrt(norm, norm);
    for (k = 0; k < 3; ++k) {
        mpf_set_d(term, f[k]);
        mpf_mul(term, term, term);
        mpf_add(square, square, term);
        mpf_set_d(term, f[k]);
        mpf_set_z(norm, c->axis[k]);
        mpf_mul(term, term, norm);
        mpf_add(dot, dot, term);
    }
    mpf_set_z(norm, c->z[0]);
    mpf_sqrt(norm, norm);
    mpf_div(dot, dot, norm);
    mpf_mul_ui(dot, dot, 2);
    if (c->axis_side < 0 || (c->axis_side == 0 && mpf_sgn(dot) < 0)) {
        mpf_neg(dot, dot);
    }
    mpf_sub(square, square, dot);
    mpf_add_ui(square, square, 1);
    mpf_set_ui(term, 1);
    mpf_div_2exp(term, term, 44);
    ok = mpf_cmp(square, term) <= 0;
    mpf_clears(square, dot, norm, term, NULL);
    return ok;
}

/* ---- points in rationals ---------------------------------------------------------------------- */

static inline void point_set(mpq_t out[3], mpq_t a[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        mpq_set(out[k], a[k]);
    }
}

static inline int point_compare(mpq_t a[3], mpq_t b[3])
{
    int k, order = 0;
    for (k = 0; k < 3 && order == 0; ++k) {
        order = mpq_cmp(a[k], b[k]);
    }
    return order;
}

/* out = (a - from) . (b - to); q[20], q[21], q[22] are lost */
static inline void point_dot(companion_work *c, mpq_t out, mpq_t a[3], mpq_t from[3], mpq_t b[3], mpq_t to[3])
{
    int k;
    mpq_set_ui(c->q[22], 0, 1);
    for (k = 0; k < 3; ++k) {
        mpq_sub(c->q[20], a[k], from[k]);
        mpq_sub(c->q[21], b[k], to[k]);
        mpq_mul(c->q[20], c->q[20], c->q[21]);
        mpq_add(c->q[22], c->q[22], c->q[20]);
    }
    mpq_set(out, c->q[22]);
}

/* out = component k of (a - o) x (b - o) */
static inline void point_cross(companion_work *c, mpq_t out, mpq_t o[3], mpq_t a[3], mpq_t b[3], int k)
{
    int l = (k + 1) % 3;
    int m = (k + 2) % 3;
    mpq_sub(c->q[20], a[l], o[l]);
    mpq_sub(c->q[21], b[m], o[m]);
    mpq_mul(c->q[22], c->q[20], c->q[21]);
    mpq_sub(c->q[20], a[m], o[m]);
    mpq_sub(c->q[21], b[l], o[l]);
    mpq_mul(c->q[20], c->q[20], c->q[21]);
    mpq_sub(out, c->q[22], c->q[20]);
}

/* Is p strictly between a and b? */
static inline int point_between(companion_work *c, mpq_t p[3], mpq_t a[3], mpq_t b[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        point_cross(c, c->q[19], p, a, b, k);
        if (mpq_sgn(c->q[19]) != 0) {
            return 0;
        }
    }
    point_dot(c, c->q[19], a, p, b, p);
    return mpq_sgn(c->q[19]) < 0;
}

/* Drops what was there before, and (unless all = 1) what lies between two others: of points on the border of
 * a convex figure the extreme ones are left. */
static inline int points_extreme(companion_work *c, mpq_t (*p)[3], int n, int all)
{
    int keep[POLYGON_MAX];
    int i, j, k, left = 0;
    for (i = 0; i < n; ++i) {
        int seen = 0;
        for (j = 0; j < left && !seen; ++j) {
            seen = point_compare(p[i], p[j]) == 0;
        }
        if (!seen) {
            if (left != i) {
                point_set(p[left], p[i]);
            }
            ++left;
        }
    }
    n = left;
    for (i = 0; i < n; ++i) {
        keep[i] = 1;
        for (j = 0; j < n && keep[i] && !all; ++j) {
            for (k = j + 1; k < n && keep[i]; ++k) {
                keep[i] = i == j || i == k || !point_between(c, p[i], p[j], p[k]);
            }
        }
    }
    left = 0;
    for (i = 0; i < n; ++i) {
        if (keep[i]) {
            if (left != i) {
                point_set(p[left], p[i]);
            }
            ++left;
        }
    }
    return left;
}

/* ---- clip ------------------------------------------------------------------------------------- */

static inline void clip_question(const companion_work *c, question *ask)
{
    memset(ask, 0, sizeof *ask);
    memcpy(ask->x, c->x, sizeof ask->x);
    ask->kind = ASK_BOX;
}

/* back to the question's own scale */
static inline void clip_scale(companion_work *c, mpq_t (*p)[3], int n)
{
    int scale = companion_scale(c->x, 15);
    int i, k;
    for (i = 0; i < n; ++i) {
        for (k = 0; k < 3; ++k) {
            if (scale >= 0) {
                mpq_mul_2exp(p[i][k], p[i][k], (mp_bitcnt_t)scale);
            } else {
                mpq_div_2exp(p[i][k], p[i][k], (mp_bitcnt_t)-scale);
            }
        }
    }
}

/* the extreme points of the clipped triangle, in order, at the scale of the loaded question */
static inline int clip_points(companion_work *c, int wrong)
{
    question ask;
    exact_judge *x = &c->overlap;
    int i, n, now;
    clip_question(c, &ask);
    exact_load(x, &ask);
    if (!x->meaningful || exact_nonempty(x) == 0) {
        return 0;
    }
    n = clip_polygon(x, &now);
    for (i = 0; i < n; ++i) {
        point_set(c->points[i], x->polygon[now][i]);
    }
    return points_extreme(c, c->points, n, wrong == WRONG_NO_EXTREMES);
}

static inline void clip_judge(companion_work *c, int wrong, companion_answer *out)
{
    const int rounding = wrong == WRONG_TRUNCATED ? ROUND_ZERO : ROUND_NEAREST;
    int n = clip_points(c, wrong);
    int i, j, k, least = 0;
    clip_scale(c, c->points, n);
    for (i = 1; i < n && wrong != WRONG_FIRST_CORNER; ++i) {
        least = point_compare(c->points[i], c->points[least]) < 0 ? i : least;
    }
    for (i = 0; i < n && out->value < 9; ++i) {
        uint64_t *word = out->word + 3 * out->value;
        int at = wrong == WRONG_TURN ? (least + n - i) % n : (least + i) % n;
        int same = 0;
        for (k = 0; k < 3; ++k) {
            word[k] = companion_round(c, c->points[at][k], rounding);
        }
        for (j = 0; j < out->value && wrong != WRONG_NO_MERGE; ++j) {
            same |= memcmp(out->word + 3 * j, word, 3 * sizeof *word) == 0;
        }
        if (same) {
            memset(word, 0, 3 * sizeof *word);
        }
        out->value += !same;
    }
    out->n = 3 * out->value;
}

/* The point where edge i meets the plane of a face, if it does, added to `others`. */
static inline int clip_edge_meets(companion_work *c, int n, int i, int k, mpz_t face)
{
    exact_judge *x = &c->overlap;
    int a, j = (i + 1) % 3;
    int si = mpz_cmp(x->v[i][k], face);
    int sj = mpz_cmp(x->v[j][k], face);
    if ((si < 0) == (sj < 0) && (si > 0) == (sj > 0)) {
        return n;
    }
    mpz_sub(c->z[0], face, x->v[i][k]);
    mpz_sub(c->z[1], x->v[j][k], x->v[i][k]);
    for (a = 0; a < 3; ++a) { /* v_i + (v_j - v_i) z0 / z1 */
        mpz_sub(c->z[2], x->v[j][a], x->v[i][a]);
        mpz_mul(c->z[2], c->z[2], c->z[0]);
        mpz_addmul(c->z[2], x->v[i][a], c->z[1]);
        mpq_set_num(c->others[n][a], c->z[2]);
        mpq_set_den(c->others[n][a], c->z[1]);
        mpq_canonicalize(c->others[n][a]);
    }
    return n + 1;
}

/* The point where the box's edge along axis k, at two faces, meets the triangle's plane. */
static inline int clip_box_edge_meets(companion_work *c, int n, int k, mpz_t face_b, mpz_t face_d)
{
    exact_judge *x = &c->overlap;
    int b = (k + 1) % 3;
    int d = (k + 2) % 3;
    if (mpz_sgn(x->n[k]) == 0) {
        return n;
    }
    mpz_sub(c->z[0], x->v[0][b], face_b);
    mpz_mul(c->z[1], c->z[0], x->n[b]);
    mpz_sub(c->z[0], x->v[0][d], face_d);
    mpz_addmul(c->z[1], c->z[0], x->n[d]);
    mpz_addmul(c->z[1], x->v[0][k], x->n[k]);
    mpq_set_num(c->others[n][k], c->z[1]);
    mpq_set_den(c->others[n][k], x->n[k]);
    mpq_canonicalize(c->others[n][k]);
    mpq_set_z(c->others[n][b], face_b);
    mpq_set_z(c->others[n][d], face_d);
    return n + 1;
}

/* Is a point of the triangle's plane in the triangle? By the signs of the three turns, times the normal. */
static inline int clip_in_triangle(companion_work *c, mpq_t p[3])
{
    exact_judge *x = &c->overlap;
    int i, k;
    for (i = 0; i < 3; ++i) {
        int j = (i + 1) % 3;
        mpq_set_ui(c->q[0], 0, 1);
        for (k = 0; k < 3; ++k) {
            mpq_set_z(c->corner[0][k], x->v[i][k]);
            mpq_set_z(c->corner[1][k], x->v[j][k]);
        }
        for (k = 0; k < 3; ++k) {
            point_cross(c, c->q[1], c->corner[0], c->corner[1], p, k);
            mpq_set_z(c->q[2], x->n[k]);
            mpq_mul(c->q[1], c->q[1], c->q[2]);
            mpq_add(c->q[0], c->q[0], c->q[1]);
        }
        if (mpq_sgn(c->q[0]) < 0) {
            return 0;
        }
    }
    return 1;
}

static inline int clip_in_box(companion_work *c, mpq_t p[3])
{
    exact_judge *x = &c->overlap;
    int k;
    for (k = 0; k < 3; ++k) {
        mpq_set_z(c->q[0], x->lo[k]);
        mpq_set_z(c->q[1], x->hi[k]);
        if ((!x->lo_inf[k] && mpq_cmp(p[k], c->q[0]) < 0) || (!x->hi_inf[k] && mpq_cmp(p[k], c->q[1]) > 0)) {
            return 0;
        }
    }
    return 1;
}

/* all points that can be extreme, in `others` */
static inline int clip_candidates(companion_work *c)
{
    exact_judge *x = &c->overlap;
    int i, k, n = 0, left = 0;
    for (i = 0; i < 3; ++i) {
        for (k = 0; k < 3; ++k) {
            mpq_set_z(c->others[n][k], x->v[i][k]);
        }
        ++n;
        for (k = 0; k < 3; ++k) {
            n = x->lo_inf[k] ? n : clip_edge_meets(c, n, i, k, x->lo[k]);
            n = x->hi_inf[k] ? n : clip_edge_meets(c, n, i, k, x->hi[k]);
        }
    }
    exact_normal(x);
    for (k = 0; k < 3; ++k) {
        for (i = 0; i < 4; ++i) {
            int b = (k + 1) % 3;
            int d = (k + 2) % 3;
            int before = n;
            if ((i & 1 ? x->hi_inf[b] : x->lo_inf[b]) || (i & 2 ? x->hi_inf[d] : x->lo_inf[d])) {
                continue;
            }
            n = clip_box_edge_meets(c, n, k, i & 1 ? x->hi[b] : x->lo[b], i & 2 ? x->hi[d] : x->lo[d]);
            n -= n > before && !clip_in_triangle(c, c->others[before]);
        }
    }
    for (i = 0; i < n; ++i) {
        if (clip_in_box(c, c->others[i])) {
            if (left != i) {
                point_set(c->others[left], c->others[i]);
            }
            ++left;
        }
    }
    return points_extreme(c, c->others, left, 0);
}

/* The second method: the same points, and they turn with the triangle. */
static inline int clip_confirm(companion_work *c)
{
    int n = clip_points(c, WRONG_NOTHING);
    int m, i, j, k, found;
    if (!c->overlap.meaningful || exact_nonempty(&c->overlap) == 0) {
        return n == 0;
    }
    m = clip_candidates(c);
    if (m != n) {
        return 0;
    }
    for (i = 0; i < n; ++i) {
        found = 0;
        for (j = 0; j < n; ++j) {
            found |= point_compare(c->points[i], c->others[j]) == 0;
        }
        if (!found) {
            return 0;
        }
        mpq_set_ui(c->q[0], 0, 1);
        for (k = 0; k < 3 && n > 2; ++k) {
            point_cross(c, c->q[1], c->points[i], c->points[(i + 1) % n], c->points[(i + 2) % n], k);
            mpq_set_z(c->q[2], c->overlap.n[k]);
            mpq_mul(c->q[1], c->q[1], c->q[2]);
            mpq_add(c->q[0], c->q[0], c->q[1]);
        }
        if (n > 2 && mpq_sgn(c->q[0]) <= 0) {
            return 0;
        }
    }
    return 1;
}

/* ---- closest ---------------------------------------------------------------------------------- */

static inline void closest_load(companion_work *c)
{
    int i, k;
    for (k = 0; k < 3; ++k) {
        for (i = 0; i < 3; ++i) {
            companion_rational(c->corner[i][k], c->x[3 * i + k]);
        }
        companion_rational(c->corner[4][k], c->x[COMPANION_O + k]);
    }
}

/* takes the point in others[0] if it is nearer than `nearest`; its distance so far is in q[10] */
static inline void closest_take(companion_work *c, int first)
{
    point_dot(c, c->q[11], c->others[0], c->corner[4], c->others[0], c->corner[4]);
    if (first || mpq_cmp(c->q[11], c->q[10]) < 0) {
        mpq_set(c->q[10], c->q[11]);
        point_set(c->nearest, c->others[0]);
    }
}

/* the foot of q on the line through corners i and j, if it is between them */
static inline void closest_edge(companion_work *c, int i, int j)
{
    int k;
    point_dot(c, c->q[0], c->corner[4], c->corner[i], c->corner[j], c->corner[i]);
    point_dot(c, c->q[1], c->corner[j], c->corner[i], c->corner[j], c->corner[i]);
    if (mpq_sgn(c->q[0]) <= 0 || mpq_cmp(c->q[0], c->q[1]) >= 0) {
        return;
    }
    mpq_div(c->q[0], c->q[0], c->q[1]);
    for (k = 0; k < 3; ++k) {
        mpq_sub(c->q[1], c->corner[j][k], c->corner[i][k]);
        mpq_mul(c->q[1], c->q[1], c->q[0]);
        mpq_add(c->others[0][k], c->corner[i][k], c->q[1]);
    }
    closest_take(c, 0);
}

/* The weights of the point of the plane nearest to p, in q[3], q[4], q[5], by the Gram matrix; 0 if T is
 * degenerate. */
static inline int closest_plane(companion_work *c, mpq_t p[3])
{
    mpq_t *q = c->q;
    point_dot(c, q[6], c->corner[1], c->corner[0], c->corner[1], c->corner[0]);
    point_dot(c, q[7], c->corner[1], c->corner[0], c->corner[2], c->corner[0]);
    point_dot(c, q[8], c->corner[2], c->corner[0], c->corner[2], c->corner[0]);
    point_dot(c, q[0], p, c->corner[0], c->corner[1], c->corner[0]);
    point_dot(c, q[1], p, c->corner[0], c->corner[2], c->corner[0]);
    mpq_mul(q[9], q[6], q[8]);
    mpq_mul(q[2], q[7], q[7]);
    mpq_sub(q[9], q[9], q[2]);
    if (mpq_sgn(q[9]) == 0) {
        return 0;
    }
    mpq_mul(q[4], q[0], q[8]);
    mpq_mul(q[2], q[1], q[7]);
    mpq_sub(q[4], q[4], q[2]);
    mpq_div(q[4], q[4], q[9]);
    mpq_mul(q[5], q[1], q[6]);
    mpq_mul(q[2], q[0], q[7]);
    mpq_sub(q[5], q[5], q[2]);
    mpq_div(q[5], q[5], q[9]);
    mpq_set_ui(q[3], 1, 1);
    mpq_sub(q[3], q[3], q[4]);
    mpq_sub(q[3], q[3], q[5]);
    return 1;
}

static inline void closest_face(companion_work *c)
{
    int k;
    if (!closest_plane(c, c->corner[4]) || mpq_sgn(c->q[3]) <= 0 || mpq_sgn(c->q[4]) <= 0 ||
        mpq_sgn(c->q[5]) <= 0) {
        return;
    }
    for (k = 0; k < 3; ++k) {
        mpq_mul(c->others[0][k], c->corner[0][k], c->q[3]);
        mpq_mul(c->q[0], c->corner[1][k], c->q[4]);
        mpq_add(c->others[0][k], c->others[0][k], c->q[0]);
        mpq_mul(c->q[0], c->corner[2][k], c->q[5]);
        mpq_add(c->others[0][k], c->others[0][k], c->q[0]);
    }
    closest_take(c, 0);
}

/* the nearest point's weights, in q[3], q[4], q[5]: a corner, an edge, or all three */
static inline void closest_weights(companion_work *c, int wrong)
{
    int at, i, j, k, high = wrong == WRONG_HIGH_INDEX;
    for (i = 0; i < 3; ++i) {
        at = high ? 2 - i : i;
        if (point_compare(c->nearest, c->corner[at]) == 0) {
            mpq_set_ui(c->q[3 + at], 1, 1);
            mpq_set_ui(c->q[3 + (at + 1) % 3], 0, 1);
            mpq_set_ui(c->q[3 + (at + 2) % 3], 0, 1);
            return;
        }
    }
    for (i = 0; i < 3; ++i) { /* 01, 02, 12 */
        at = high ? 2 - i : i;
        j = at == 2 ? 1 : 0;
        k = at == 0 ? 1 : 2;
        if (point_between(c, c->nearest, c->corner[j], c->corner[k])) {
            point_dot(c, c->q[0], c->nearest, c->corner[j], c->corner[k], c->corner[j]);
            point_dot(c, c->q[1], c->corner[k], c->corner[j], c->corner[k], c->corner[j]);
            mpq_div(c->q[3 + k], c->q[0], c->q[1]);
            mpq_set_ui(c->q[3 + j], 1, 1);
            mpq_sub(c->q[3 + j], c->q[3 + j], c->q[3 + k]);
            mpq_set_ui(c->q[6 - j - k], 0, 1);
            return;
        }
    }
    closest_plane(c, c->nearest);
}

static inline void closest_judge(companion_work *c, int wrong, companion_answer *out)
{
    int i;
    out->n = 3;
    if (!companion_finite(c->x, 9) || !companion_finite(c->x + COMPANION_O, 3)) {
        out->word[0] = c->f64 ? (uint64_t)1023 << 52 : 0x3f800000u;
        return;
    }
    closest_load(c);
    for (i = 0; i < 3; ++i) {
        point_set(c->others[0], c->corner[i]);
        closest_take(c, i == 0);
    }
    for (i = 0; i < 3 && wrong != WRONG_NO_EDGE_POINT; ++i) {
        closest_edge(c, i, (i + 1) % 3);
    }
    if (wrong != WRONG_NO_FACE_POINT) {
        closest_face(c);
    }
    closest_weights(c, wrong);
    for (i = 0; i < 3; ++i) {
        out->word[i] = companion_round(c, c->q[3 + i], wrong == WRONG_TRUNCATED ? ROUND_ZERO : ROUND_NEAREST);
    }
}

/* (q - nearest) . (v - nearest) <= 0 for each corner, and the nearest point is in T: its weights, here by
 * sums of the corners, are at least 0 and give it. */
static inline int closest_confirm(companion_work *c)
{
    companion_answer out;
    int i, k, ok = 1;
    memset(&out, 0, sizeof out);
    closest_judge(c, WRONG_NOTHING, &out);
    if (!companion_finite(c->x, 9) || !companion_finite(c->x + COMPANION_O, 3)) {
        return 1;
    }
    for (i = 0; i < 3; ++i) {
        ok &= mpq_sgn(c->q[3 + i]) >= 0;
    }
    for (k = 0; k < 3; ++k) {
        mpq_set_ui(c->q[0], 0, 1);
        for (i = 0; i < 3; ++i) {
            mpq_mul(c->q[1], c->corner[i][k], c->q[3 + i]);
            mpq_add(c->q[0], c->q[0], c->q[1]);
        }
        ok &= mpq_equal(c->q[0], c->nearest[k]) != 0;
    }
    for (i = 0; i < 3; ++i) {
        point_dot(c, c->q[0], c->corner[4], c->nearest, c->corner[i], c->nearest);
        ok &= mpq_sgn(c->q[0]) <= 0;
    }
    return ok;
}

/* ---- boxes and planes ------------------------------------------------------------------------- */

static inline void companion_bound(const companion_work *c, mpq_t out, double d)
{
    if (is_finite(d)) {
        companion_rational(out, d);
    } else {
        mpq_set_si(out, sign_of_double(d), 1);
        mpq_mul_2exp(out, out, (mp_bitcnt_t)FAR_FACE(c->f64));
    }
}

/* max of the lower bounds <= min of the upper ones, on each axis */
static inline int boxes_judge(companion_work *c, int wrong)
{
    const double *x = c->x;
    int k, order;
    if (!companion_is_box(x + COMPANION_LO, x + COMPANION_HI) ||
        !companion_is_box(x + COMPANION_W, x + COMPANION_O)) {
        return 0;
    }
    for (k = 0; k < 3; ++k) {
        companion_bound(c, c->q[0], x[COMPANION_LO + k]);
        companion_bound(c, c->q[1], x[COMPANION_W + k]);
        companion_bound(c, c->q[2], x[COMPANION_HI + k]);
        companion_bound(c, c->q[3], x[COMPANION_O + k]);
        order = mpq_cmp(mpq_cmp(c->q[0], c->q[1]) > 0 ? c->q[0] : c->q[1],
                        mpq_cmp(c->q[2], c->q[3]) < 0 ? c->q[2] : c->q[3]);
        if (order > 0 || (order == 0 && wrong == WRONG_OPEN_BOXES)) {
            return 0;
        }
    }
    return 1;
}

/* on each axis the lower end of one is between the ends of the other */
static inline int boxes_confirm(companion_work *c)
{
    const double *x = c->x;
    int k;
    if (!companion_is_box(x + COMPANION_LO, x + COMPANION_HI) ||
        !companion_is_box(x + COMPANION_W, x + COMPANION_O)) {
        return 0;
    }
    for (k = 0; k < 3; ++k) {
        companion_bound(c, c->q[0], x[COMPANION_LO + k]);
        companion_bound(c, c->q[1], x[COMPANION_W + k]);
        companion_bound(c, c->q[2], x[COMPANION_HI + k]);
        companion_bound(c, c->q[3], x[COMPANION_O + k]);
        if (!(mpq_cmp(c->q[0], c->q[1]) <= 0 && mpq_cmp(c->q[1], c->q[2]) <= 0) &&
            !(mpq_cmp(c->q[1], c->q[0]) <= 0 && mpq_cmp(c->q[0], c->q[3]) <= 0)) {
            return 0;
        }
    }
    return 1;
}

static inline int plane_is_odd(const companion_work *c, int *out)
{
    const double d = c->x[COMPANION_T0];
    if (!companion_finite(c->x + COMPANION_W, 3) || is_nan(d) ||
        !companion_is_box(c->x + COMPANION_LO, c->x + COMPANION_HI)) {
        *out = 2;
        return 1;
    }
    *out = sign_of_double(d);
    return !is_finite(d);
}

/* n.x + d at a corner of the box: bits of `corner` say where it is the upper one */
static inline int plane_value(companion_work *c, int corner)
{
    int k;
    companion_rational(c->q[0], c->x[COMPANION_T0]);
    for (k = 0; k < 3; ++k) {
        companion_rational(c->q[1], c->x[COMPANION_W + k]);
        companion_bound(c, c->q[2], c->x[(corner >> k & 1 ? COMPANION_HI : COMPANION_LO) + k]);
        mpq_mul(c->q[1], c->q[1], c->q[2]);
        mpq_add(c->q[0], c->q[0], c->q[1]);
    }
    return mpq_sgn(c->q[0]);
}

/* all eight corners on one side? */
static inline int plane_judge(companion_work *c, int wrong)
{
    int corner, odd;
    int least = 1, most = -1;
    if (plane_is_odd(c, &odd)) {
        return odd;
    }
    for (corner = 0; corner < 8; ++corner) {
        int s = plane_value(c, corner);
        least = s < least ? s : least;
        most = s > most ? s : most;
    }
    if (wrong == WRONG_OPEN_PLANE) {
        return most <= 0 ? -1 : least >= 0;
    }
    return most < 0 ? -1 : wrong == WRONG_ONE_CORNER ? most > 0 : least > 0;
}

static inline int plane_confirm(companion_work *c)
{
    int k, odd, up = 0;
    if (plane_is_odd(c, &odd)) {
        return odd;
    }
    for (k = 0; k < 3; ++k) {
        up |= (sign_of_double(c->x[COMPANION_W + k]) > 0) << k;
    }
    return plane_value(c, up) < 0 ? -1 : plane_value(c, 7 - up) > 0;
}

/* ---- octants and meshes ----------------------------------------------------------------------- */

static inline int octants_judge(companion_work *c, unsigned flags, int wrong, int clip)
{
    question ask;
    int octant, k, set = 0;
    clip_question(c, &ask);
    ask.kind = ASK_TRI;
    for (octant = 0; octant < 8; ++octant) {
        question part = ask;
        unsigned rules;
        for (k = 0; k < 3; ++k) {
            part.index[k] = octant >> (wrong == WRONG_OCTANT_ORDER ? 2 - k : k) & 1;
            if (wrong == WRONG_OCTANT_ROUNDED && part.index[k] != 0) {
                volatile double corner = part.x[9 + k] + part.x[12 + k];
                part.x[9 + k] = corner;
                part.index[k] = 0;
            }
        }
        rules = clip ? exact_clip(&c->overlap, &part) : exact_axes(&c->overlap, &part);
        set |= (int)(rules >> rule_of(flags) & 1u) << octant;
    }
    return set;
}

static inline int query_touches(companion_work *c, const double *v0, const double *v1, const double *v2,
                                int clip)
{
    question ask;
    clip_question(c, &ask);
    memcpy(ask.x, v0, 3 * sizeof *v0);
    memcpy(ask.x + 3, v1, 3 * sizeof *v1);
    memcpy(ask.x + 6, v2, 3 * sizeof *v2);
    return (int)((clip ? exact_clip(&c->overlap, &ask) : exact_axes(&c->overlap, &ask)) & 1u);
}

static inline void query_judge(companion_work *c, int wrong, int clip, companion_answer *out)
{
    static const int at[5] = {0, 3, 6, COMPANION_W, COMPANION_O};
    uint32_t indices[3 * COMPANION_MESH];
    int i;
    companion_mesh(indices);
    for (i = 0; i < COMPANION_MESH - (wrong == WRONG_QUERY_LAST); ++i) {
        if (query_touches(c, c->x + at[indices[3 * i]], c->x + at[indices[3 * i + 1]],
                          c->x + at[indices[3 * i + 2]], clip)) {
            if (out->n < COMPANION_CAPACITY) {
                out->word[out->n++] = (uint32_t)i;
            }
            ++out->value;
        }
    }
    out->value += 256 * query_touches(c, c->x + COMPANION_HI, c->x + COMPANION_W, c->x + COMPANION_O, clip);
}

#include "contact_exact.h"

/* ---- the whole -------------------------------------------------------------------------------- */

/* Sets up the motion of a question; 0 if it holds no points. T for a ray is its origin, for a segment the
 * segment itself. */
static inline int companion_motion(companion_work *c, const companion *ask)
{
    const double *x = c->x;
    double v[9], u[3];
    int k;
    switch (ask->which) {
    case COMPANION_SEGMENT_BOX:
        memcpy(v, x + COMPANION_W, 3 * sizeof *v);
        memcpy(v + 3, x + COMPANION_O, 3 * sizeof *v);
        memcpy(v + 6, x + COMPANION_O, 3 * sizeof *v);
        memset(u, 0, sizeof u);
        return motion_load(c, v, x + COMPANION_LO, x + COMPANION_HI, u, 0.0, 1.0);
    case COMPANION_RAY_BOX:
        for (k = 0; k < 9; ++k) {
            v[k] = x[COMPANION_O + k % 3];
        }
        for (k = 0; k < 3; ++k) {
            u[k] = -x[COMPANION_W + k];
        }
        return motion_load(c, v, x + COMPANION_LO, x + COMPANION_HI, u, x[COMPANION_T0], x[COMPANION_T1]);
    case COMPANION_RAY_TRIANGLE:
        return companion_finite(x + COMPANION_O, 3) &&
               motion_load(c, x, x + COMPANION_O, x + COMPANION_O, x + COMPANION_W, x[COMPANION_T0],
                           x[COMPANION_T1]);
    default:
        return motion_load(c, x, x + COMPANION_LO, x + COMPANION_HI, x + COMPANION_W, 0.0, 1.0);
    }
}

static inline int companion_moves(int which)
{
    return which == COMPANION_SEGMENT_BOX || which == COMPANION_RAY_BOX || which == COMPANION_RAY_TRIANGLE ||
           which == COMPANION_SWEEP;
}

static inline void companion_read(companion_work *c, const companion *ask)
{
    int i;
    c->f64 = ask->f64;
    for (i = 0; i < COMPANION_NUMBERS; ++i) {
        c->x[i] = companion_number(ask->x[i], ask->f64);
    }
}

/* The answer, but for the sweep's axis: motion_axis_is(c, ...) judges that one, right after this. */
static inline void companion_judge(companion_work *c, const companion *ask, int wrong, companion_answer *out)
{
    memset(out, 0, sizeof *out);
    companion_read(c, ask);
    if (contact_owns(ask->which)) {
        contact_judge(c, ask, wrong, out);
        return;
    }
    if (companion_moves(ask->which)) {
        out->value = companion_motion(c, ask) && motion_judge(c, wrong);
        if (out->value && ask->which != COMPANION_SEGMENT_BOX) {
            out->n = ask->which == COMPANION_RAY_TRIANGLE ? 1 : 2;
            out->word[0] =
                companion_round(c, c->first, wrong == WRONG_START_NEAREST ? ROUND_NEAREST : ROUND_DOWN);
            if (out->n == 2) {
                out->word[1] =
                    companion_round(c, c->last, wrong == WRONG_END_NEAREST ? ROUND_NEAREST : ROUND_UP);
            }
        }
        if (out->value && ask->which == COMPANION_SWEEP) {
            contact_unit(c, out->axis);
        }
        return;
    }
    switch (ask->which) {
    case COMPANION_BOX_BOX:
        out->value = boxes_judge(c, wrong);
        break;
    case COMPANION_PLANE_BOX:
        out->value = plane_judge(c, wrong);
        break;
    case COMPANION_CLIP:
        clip_judge(c, wrong, out);
        break;
    case COMPANION_CLOSEST:
        closest_judge(c, wrong, out);
        break;
    case COMPANION_OCTANTS:
        out->value = octants_judge(c, ask->flags, wrong, 0);
        break;
    default:
        query_judge(c, wrong, 0, out);
        break;
    }
}

/* The other method: 1 if it agrees with companion_judge, which was asked just before. */
static inline int companion_confirm(companion_work *c, const companion *ask, const companion_answer *answer)
{
    companion_answer other;
    memset(&other, 0, sizeof other);
    if (contact_owns(ask->which)) {
        return contact_confirm(c, ask, answer);
    }
    if (companion_moves(ask->which)) {
        return companion_motion(c, ask) ? motion_confirm(c, answer->value) : !answer->value;
    }
    switch (ask->which) {
    case COMPANION_BOX_BOX:
        return boxes_confirm(c) == answer->value;
    case COMPANION_PLANE_BOX:
        return plane_confirm(c) == answer->value;
    case COMPANION_CLIP:
        return clip_confirm(c);
    case COMPANION_CLOSEST:
        return closest_confirm(c);
    case COMPANION_OCTANTS:
        return octants_judge(c, ask->flags, WRONG_NOTHING, 1) == answer->value;
    default:
        query_judge(c, WRONG_NOTHING, 1, &other);
        return memcmp(&other, answer, sizeof other) == 0;
    }
}

/* The same value and the same bits written? */
static inline int companion_same(const companion_answer *a, const companion_answer *b)
{
    return a->value == b->value && a->n == b->n && memcmp(a->word, b->word, sizeof a->word) == 0;
}

/* Is what is written but for its last bits near enough to the exact answer, which was judged just before? */
static inline int companion_is_near(companion_work *c, int which, const companion_answer *got,
                                    const companion_answer *want)
{
    if (which == COMPANION_GAP) {
        return gap_is_right(c, got, want);
    }
    if ((which == COMPANION_SWEEP || which == COMPANION_SWEEP_RULE || which == COMPANION_SWEEP_BOX) && want->value) {
        return motion_axis_is(c, got->axis);
    }
    return 1;
}

#endif
