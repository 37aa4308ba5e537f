/* Exact answers, with GMP, to the questions of contact in companions.h: sweeps under a rule, gaps, segments through
 * grids, spheres. Included by companions_exact.h, whose words on methods hold here too:
 *
 *   function               judged by                              confirmed by
 *   sweep_rule, sweep_box  open or closed intervals of axes       overlap between the ends, none just beyond
 *   gap                    all corners along all 26 directions    clipping: closed and open overlap
 *   grid_segment           the interval of t in every voxel       clipping, voxel by voxel
 *   sphere_triangle        corners, edges, face in rationals      the nearest point of `closest`
 *   ray_sphere             roots to 4096 bits                     the ray's nearest point, and beside its ends
 *   sphere_sphere          squares in rationals                   a common point
 *   plane_sphere           squares in rationals                   the plane's nearest point
 *   sphere_box             squares in rationals                   `closest` of the box's twelve triangles
 */
#ifndef CONTACT_EXACT_H
#define CONTACT_EXACT_H

/* ---- sweeps under a rule ---------------------------------------------------------------------- */

static inline int contact_is_open(unsigned flags)
{
    return (flags & 6u) == 2u;
}

/* The motion in c (axes 0..axes-1), closed or open. */
static inline int contact_sweep(companion_work *c, int axes, int open, int wrong)
{
    int axis;
    if (wrong == WRONG_RULE) {
        open = 0;
    }
    mpq_set_si(c->first, open ? -1 : 0, 1);
    mpq_set_si(c->last, open ? 2 : 1, 1);
    mpq_mul_2exp(c->first, c->first, FAR_TIME(0));
    for (axis = 0; axis < 13; ++axis) {
        c->has_opens[axis] = 0;
        c->zero_gap[axis] = 0;
    }
    for (axis = 0; axis < axes; ++axis) {
        if (!motion_meet(c, axis, open ? WRONG_OPEN_AXES : WRONG_NOTHING)) {
            return 0;
        }
    }
    axis = mpq_cmp(c->first, c->last);
    if (axis > 0 || (axis == 0 && open)) {
        return 0;
    }
    if (open && (mpq_cmp_ui(c->first, 1, 1) >= 0 || mpq_sgn(c->last) <= 0)) {
        return 0;
    }
    if (!open || mpq_sgn(c->first) >= 0) {
        motion_opened(c, wrong);
    } else { /* met at the start */
        for (axis = 0; axis < 3; ++axis) {
            mpz_set_ui(c->axis[axis], 0);
        }
        mpq_set_ui(c->first, 0, 1);
    }
    if (mpq_cmp_ui(c->last, 1, 1) > 0) {
        mpq_set_ui(c->last, 1, 1);
    }
    return 1;
}

static inline int contact_is_flat(const double lo[3], const double hi[3])
{
    int k, flat = 0;
    for (k = 0; k < 3; ++k) {
        flat |= lo[k] == hi[k] && double_bits(lo[k]) << 1 == double_bits(hi[k]) << 1;
        flat |= double_bits(lo[k]) << 1 == 0 && double_bits(hi[k]) << 1 == 0;
    }
    return flat;
}

static inline void contact_face(const companion_work *c, mpz_t out, double at)
{
    if (is_finite(at)) {
        set_scaled(out, at, c->scale);
    } else {
        mpz_set_si(out, sign_of_double(at));
        mpz_mul_2exp(out, out, (mp_bitcnt_t)(FAR_FACE(0) - c->scale));
    }
}

/* Sets up the motion; T's corners are those of box b for sweep_box. */
static inline int contact_load(companion_work *c, int which, unsigned flags)
{
    static const double nowhere[9];
    const double *x = c->x;
    int k;
    if (contact_is_open(flags) && contact_is_flat(x + COMPANION_LO, x + COMPANION_HI)) {
        return 0;
    }
    if (which == COMPANION_SWEEP_RULE) {
        return motion_load(c, x, x + COMPANION_LO, x + COMPANION_HI, x + COMPANION_W, 0.0, 1.0);
    }
    if (!companion_is_box(x, x + 3) ||
        !motion_load(c, nowhere, x + COMPANION_LO, x + COMPANION_HI, x + COMPANION_W, 0.0, 1.0)) {
        return 0;
    }
    c->scale = companion_scale(x, COMPANION_O);
    for (k = 0; k < 3; ++k) {
        contact_face(c, c->v[0][k], x[k]);
        contact_face(c, c->v[1][k], x[3 + k]);
        contact_face(c, c->v[2][k], x[3 + k]);
        contact_face(c, c->lo[k], x[COMPANION_LO + k]);
        contact_face(c, c->hi[k], x[COMPANION_HI + k]);
        set_scaled(c->u[k], x[COMPANION_W + k], c->scale);
    }
    return 1;
}

/* Do they meet at t, under the rule? Everything times t's denominator. */
static inline int contact_meet_at(companion_work *c, int which, int open, const mpq_t t)
{
    int k, meet = 1;
    if (which == COMPANION_SWEEP_RULE) {
        (void)motion_overlap_at(c, t);
        return (int)(clip_conservative(&c->overlap) >> (open ? RULE_OPEN : RULE_CLOSED) & 1u);
    }
    for (k = 0; k < 3; ++k) {
        mpz_sub(c->z[0], c->hi[k], c->v[0][k]);
        mpz_sub(c->z[1], c->v[1][k], c->lo[k]);
        mpz_mul(c->z[0], c->z[0], mpq_denref(t));
        mpz_mul(c->z[1], c->z[1], mpq_denref(t));
        mpz_addmul(c->z[0], c->u[k], mpq_numref(t));
        mpz_submul(c->z[1], c->u[k], mpq_numref(t));
        meet &= mpz_sgn(c->z[0]) >= open && mpz_sgn(c->z[1]) >= open;
    }
    return meet;
}

/* Right at the ends, between them, and not just beyond; a miss meets at none of some times. */
static inline int contact_sweep_confirm(companion_work *c, int which, int open, int yes)
{
    mpq_t t, step;
    int i, ok = 1;
    mpq_inits(t, step, NULL);
    if (!yes) {
        for (i = 0; i <= 8; ++i) {
            mpq_set_si(t, i, 8);
            mpq_canonicalize(t);
            ok &= !contact_meet_at(c, which, open, t);
        }
    } else {
        mpq_add(t, c->first, c->last);
        mpq_div_2exp(t, t, 1);
        ok &= mpq_equal(c->first, c->last) && open && !mpq_sgn(c->first) ? 1 : contact_meet_at(c, which, open, t);
        mpq_set_ui(step, 1, 1);
        mpq_div_2exp(step, step, 8000);
        mpq_sub(t, c->first, step);
        ok &= mpq_sgn(c->first) == 0 || !contact_meet_at(c, which, open, t);
        mpq_add(t, c->last, step);
        ok &= mpq_cmp_ui(c->last, 1, 1) == 0 || !contact_meet_at(c, which, open, t);
        ok &= open || (contact_meet_at(c, which, open, c->first) && contact_meet_at(c, which, open, c->last));
    }
    mpq_clears(t, step, NULL);
    return ok;
}

/* ---- gap -------------------------------------------------------------------------------------- */

/* z[5] = the gap along side * l: the least of the box less the greatest of T; 0 if the box has no end there. */
static inline int gap_along(companion_work *c, int side)
{
    int i, k;
    mpz_set_ui(c->z[5], 0);
    for (k = 0; k < 3; ++k) {
        const int up = mpz_sgn(c->l[k]) * side > 0;
        const double face = c->x[(up ? COMPANION_LO : COMPANION_HI) + k];
        if (mpz_sgn(c->l[k]) != 0 && !is_finite(face)) {
            return 0;
        }
        if (mpz_sgn(c->l[k]) != 0) {
            mpz_addmul(c->z[5], c->l[k], up ? c->lo[k] : c->hi[k]);
        }
    }
    for (i = 0; i < 3; ++i) {
        motion_dot(c->z[6], c->l, c->v[i]);
        if (side < 0) {
            mpz_neg(c->z[6], c->z[6]);
        }
        if (i == 0 || mpz_cmp(c->z[6], c->z[7]) > 0) {
            mpz_set(c->z[7], c->z[6]);
        }
    }
    if (side < 0) {
        mpz_neg(c->z[5], c->z[5]);
    }
    mpz_sub(c->z[5], c->z[5], c->z[7]);
    return 1;
}

/* the sign of z[5] / sqrt(z[4]) less z[0] / sqrt(z[1]) */
static inline int gap_order(companion_work *c)
{
    const int sign = mpz_sgn(c->z[5]);
    int order;
    if (sign != mpz_sgn(c->z[0]) || sign == 0) {
        return sign - mpz_sgn(c->z[0]);
    }
    mpz_mul(c->z[2], c->z[5], c->z[5]);
    mpz_mul(c->z[2], c->z[2], c->z[1]);
    mpz_mul(c->z[3], c->z[0], c->z[0]);
    mpz_mul(c->z[3], c->z[3], c->z[4]);
    order = mpz_cmp(c->z[2], c->z[3]);
    return sign * order;
}

/* z[6] = |x| / sqrt(square) * 2^shift, cut */
static inline void gap_quotient(companion_work *c, const mpz_t x, const mpz_t square, int shift)
{
    mpz_mul(c->z[6], x, x);
    if (shift >= 0) {
        mpz_mul_2exp(c->z[6], c->z[6], (mp_bitcnt_t)(2 * shift));
    } else {
        mpz_fdiv_q_2exp(c->z[6], c->z[6], (mp_bitcnt_t)(-2 * shift));
    }
    mpz_fdiv_q(c->z[6], c->z[6], square);
    mpz_sqrt(c->z[6], c->z[6]);
}

/* s of the best, z[0] / sqrt(z[1]) * 2^scale, cut to 53 bits */
static inline uint64_t gap_bits(companion_work *c)
{
    const uint64_t sign = mpz_sgn(c->z[0]) < 0 ? (uint64_t)1 << 63 : 0;
    int shift = 60 - (int)mpz_sizeinbase(c->z[0], 2) + (int)mpz_sizeinbase(c->z[1], 2) / 2;
    int bits;
    if (mpz_sgn(c->z[0]) == 0) {
        return 0;
    }
    gap_quotient(c, c->z[0], c->z[1], shift);
    bits = (int)mpz_sizeinbase(c->z[6], 2);
    mpz_fdiv_q_2exp(c->z[6], c->z[6], (mp_bitcnt_t)(bits - 53));
    return sign | (((uint64_t)(bits - 1 - shift + c->scale + 1023) << 52) +
                   ((uint64_t)mpz_get_ui(c->z[6]) - ((uint64_t)1 << 52)));
}

/* the exact unit vector of c->axis, times side, as floats, cut */
static inline void contact_unit(companion_work *c, uint32_t out[3])
{
    int k;
    motion_dot(c->z[8], c->axis, c->axis);
    for (k = 0; k < 3; ++k) {
        out[k] = 0;
        if (mpz_sgn(c->axis[k]) != 0) {
            float f;
            gap_quotient(c, c->axis[k], c->z[8], 40);
            f = (float)mpz_get_d(c->z[6]) / 1099511627776.0f;
            f = mpz_sgn(c->axis[k]) * c->axis_side < 0 ? -f : f;
            memcpy(&out[k], &f, sizeof f);
        }
    }
}

static inline void gap_judge(companion_work *c, int wrong, companion_answer *out)
{
    static const double still[3];
    const double *x = c->x;
    int axis, i, k, infinite = 0;
    int found = 0;
    if (!motion_load(c, x, x + COMPANION_LO, x + COMPANION_HI, still, 0.0, 1.0)) {
        out->value = 2;
        return;
    }
    for (k = 0; k < 6; ++k) {
        infinite += !is_finite(x[COMPANION_LO + k]);
    }
    if (infinite == 6) {
        out->value = -2;
        return;
    }
    for (axis = 0; axis < 13; ++axis) {
        int side;
        motion_axis(c, axis, c->l);
        side = mpz_sgn(c->l[0]) != 0 ? mpz_sgn(c->l[0]) : mpz_sgn(c->l[1]) != 0 ? mpz_sgn(c->l[1]) : mpz_sgn(c->l[2]);
        if (side == 0 || wrong == axis + WRONG_AXIS_FIRST) {
            continue;
        }
        side = wrong == WRONG_GAP_SIDE ? -side : side;
        motion_dot(c->z[4], c->l, c->l);
        for (i = 0; i < 2; ++i, side = -side) {
            if (!gap_along(c, side)) {
                continue;
            }
            k = found ? gap_order(c) : 1;
            if (k > 0 || (k == 0 && wrong == WRONG_LAST_AXIS)) {
                found = 1;
                mpz_set(c->z[0], c->z[5]);
                mpz_set(c->z[1], c->z[4]);
                for (k = 0; k < 3; ++k) {
                    mpz_set(c->axis[k], c->l[k]);
                }
                c->axis_side = side;
            }
        }
    }
    out->value = mpz_sgn(c->z[0]);
    out->s = gap_bits(c);
    contact_unit(c, out->axis);
}

/* s within 2^-40 of itself, with the exact sign; the axis within 2^-22: asked right after gap_judge */
static inline int gap_is_right(companion_work *c, const companion_answer *got, const companion_answer *want)
{
    const uint64_t apart = got->s > want->s ? got->s - want->s : want->s - got->s;
    if (got->value != want->value || got->value < -1 || got->value > 1) {
        return got->value == want->value && ((got->axis[0] | got->axis[1] | got->axis[2]) == 0);
    }
    return (got->value == 0 ? got->s << 1 == 0 : apart <= 4096) && motion_axis_is(c, got->axis);
}

static inline int gap_confirm(companion_work *c, int value)
{
    question ask;
    unsigned rules;
    memset(&ask, 0, sizeof ask);
    ask.kind = ASK_BOX;
    memcpy(ask.x, c->x, sizeof ask.x);
    rules = exact_clip(&c->overlap, &ask);
    if (value == 2 || value == -2) {
        return value == 2 ? (rules & 1u) == 0 : (rules & 1u) == 1;
    }
    return (value > 0) == ((rules >> RULE_CLOSED & 1u) == 0) &&
           (contact_is_flat(c->x + COMPANION_LO, c->x + COMPANION_HI) ||
            (value < 0) == ((rules >> RULE_OPEN & 1u) != 0));
}

/* ---- segments through grids ------------------------------------------------------------------- */

/* Cuts t in q[0]..q[1], open ends in `open`, by the voxel's interval on one axis: p + t d in from..to, under the
 * rule; q[2] = from - p, q[3] = to - p, q[4] = d. */
static inline int segment_cut(companion_work *c, int rule, int open[2])
{
    const int way = mpq_sgn(c->q[4]);
    const int open_lo = rule == RULE_OPEN;
    const int open_hi = rule != RULE_CLOSED;
    int e;
    if (way == 0) {
        return mpq_sgn(c->q[2]) <= -open_lo && mpq_sgn(c->q[3]) >= open_hi;
    }
    for (e = 0; e < 2; ++e) {
        const int upper = e ^ (way < 0);
        int order;
        mpq_div(c->q[5], c->q[2 + upper], c->q[4]);
        order = mpq_cmp(c->q[5], c->q[e]) * (e == 0 ? 1 : -1);
        if (order > 0) {
            mpq_set(c->q[e], c->q[5]);
            open[e] = 0;
        }
        if (order >= 0) {
            open[e] |= upper ? open_hi : open_lo;
        }
    }
    return 1;
}

/* Does the segment hold a point of the voxel? q[0] is the t at which it enters. */
static inline int segment_meets(companion_work *c, const int at[3], int rule)
{
    int open[2] = {0, 0};
    int k, order;
    mpq_set_ui(c->q[0], 0, 1);
    mpq_set_ui(c->q[1], 1, 1);
    for (k = 0; k < 3; ++k) {
        companion_rational(c->q[6], c->x[k]);
        companion_rational(c->q[7], c->x[3 + k]);
        companion_rational(c->q[8], c->x[COMPANION_W + k]);
        companion_rational(c->q[4], c->x[COMPANION_O + k]);
        mpq_sub(c->q[4], c->q[4], c->q[8]);
        mpq_sub(c->q[6], c->q[6], c->q[8]);
        mpq_set_si(c->q[5], at[k], 1);
        mpq_mul(c->q[5], c->q[5], c->q[7]);
        mpq_add(c->q[2], c->q[6], c->q[5]);
        mpq_add(c->q[3], c->q[2], c->q[7]);
        if (!segment_cut(c, rule, open)) {
            return 0;
        }
    }
    order = mpq_cmp(c->q[0], c->q[1]);
    return order < 0 || (order == 0 && !open[0] && !open[1]);
}

static inline void segment_judge(companion_work *c, const companion *ask, int wrong, companion_answer *out)
{
    enum { MOST = COMPANION_REGION * COMPANION_REGION * COMPANION_REGION };
    static mpq_t when[MOST];
    static int ready;
    int at[3], lo[3], order[MOST], voxel[MOST][3];
    int i, j, n = 0, rank, closed, rule = (int)rule_of(ask->flags);
    const double *x = c->x;
    for (i = 0; !ready && i < MOST; ++i) {
        mpq_init(when[i]);
    }
    ready = 1;
    rule = rule == RULE_THIN || wrong == WRONG_RULE ? RULE_CLOSED : rule;
    out->n = 2;
    out->word[1] = companion_mix_start();
    for (i = 0; i < 3; ++i) {
        if (!is_finite(x[i]) || !is_finite(x[3 + i]) || sign_of_double(x[3 + i]) <= 0 ||
            !is_finite(x[COMPANION_W + i]) || !is_finite(x[COMPANION_O + i])) {
            return;
        }
    }
    companion_region(ask, lo);
    for (i = 0; i < MOST; ++i) { /* in the order of z, y, x, each along the segment */
        rank = i;
        for (j = 0; j < 3; ++j) {
            const int a = wrong == WRONG_SEGMENT_ORDER ? 2 - j : j;
            const int step = rank % COMPANION_REGION;
            companion_rational(c->q[0], x[COMPANION_W + a]);
            companion_rational(c->q[1], x[COMPANION_O + a]);
            at[a] = lo[a] + (mpq_cmp(c->q[0], c->q[1]) <= 0 ? step : COMPANION_REGION - 1 - step);
            rank /= COMPANION_REGION;
        }
        closed = segment_meets(c, at, RULE_CLOSED);
        if (closed) {
            mpq_set(when[n], c->q[0]);
        }
        if (closed && (rule == RULE_CLOSED || segment_meets(c, at, rule))) {
            memcpy(voxel[n], at, sizeof at);
            for (j = n; j > 0 && mpq_cmp(when[order[j - 1]], when[n]) > 0; --j) {
                order[j] = order[j - 1];
            }
            order[j] = n;
            ++n;
        }
    }
    out->value = n;
    out->word[0] = (uint64_t)n;
    for (i = 0; i < n; ++i) {
        const int *v = voxel[order[i]];
        out->word[1] = companion_mix(out->word[1], v[0], v[1], v[2]);
    }
}

/* as a triangle p, q, q, voxel by voxel */
static inline int segment_confirm(companion_work *c, const companion *ask, int value)
{
    question part;
    int lo[3], i, k, n = 0, rule = (int)rule_of(ask->flags);
    memset(&part, 0, sizeof part);
    part.kind = ASK_GRID;
    for (k = 0; k < 3; ++k) {
        part.x[k] = c->x[COMPANION_W + k];
        part.x[3 + k] = part.x[6 + k] = c->x[COMPANION_O + k];
        part.x[9 + k] = c->x[k];
        part.x[12 + k] = c->x[3 + k];
    }
    companion_region(ask, lo);
    for (i = 0; i < COMPANION_REGION * COMPANION_REGION * COMPANION_REGION; ++i) {
        int rest = i;
        for (k = 0; k < 3; ++k) {
            part.index[k] = part.last[k] = lo[k] + rest % COMPANION_REGION;
            rest /= COMPANION_REGION;
        }
        n += (int)(exact_clip(&c->overlap, &part) >> (rule == RULE_THIN ? RULE_CLOSED : rule) & 1u);
    }
    return n == value;
}

/* ---- spheres ---------------------------------------------------------------------------------- */

enum { BALL_EMPTY, BALL_FINITE, BALL_SPACE };

static inline int ball_kind(const double center[3], double r)
{
    if (!companion_finite(center, 3) || is_nan(r) || sign_of_double(r) < 0) {
        return BALL_EMPTY;
    }
    return is_finite(r) ? BALL_FINITE : BALL_SPACE;
}

/* out = |a - b|^2; q[20], q[21] are lost */
static inline void ball_distance(companion_work *c, mpq_t out, const double a[3], const double b[3])
{
    int k;
    mpq_set_ui(out, 0, 1);
    for (k = 0; k < 3; ++k) {
        companion_rational(c->q[20], a[k]);
        companion_rational(c->q[21], b[k]);
        mpq_sub(c->q[20], c->q[20], c->q[21]);
        mpq_mul(c->q[20], c->q[20], c->q[20]);
        mpq_add(out, out, c->q[20]);
    }
}

static inline int ball_touches(int order, int wrong)
{
    return wrong == WRONG_OPEN_BALL ? order < 0 : order <= 0;
}

static inline int sphere_sphere_judge(companion_work *c, int wrong)
{
    const double *x = c->x;
    const int a = ball_kind(x + COMPANION_W, x[COMPANION_T1]);
    const int b = ball_kind(x + COMPANION_O, x[COMPANION_T0]);
    if (a != BALL_FINITE || b != BALL_FINITE) {
        return a != BALL_EMPTY && b != BALL_EMPTY;
    }
    ball_distance(c, c->q[0], x + COMPANION_W, x + COMPANION_O);
    companion_rational(c->q[1], x[COMPANION_T0]);
    companion_rational(c->q[2], x[COMPANION_T1]);
    mpq_add(c->q[1], c->q[1], c->q[2]);
    mpq_mul(c->q[1], c->q[1], c->q[1]);
    return ball_touches(mpq_cmp(c->q[0], c->q[1]), wrong);
}

static inline int plane_sphere_judge(companion_work *c, int wrong)
{
    const double *x = c->x;
    const double d = x[COMPANION_T1];
    const int kind = ball_kind(x + COMPANION_O, x[COMPANION_T0]);
    int k, sign;
    if (!companion_finite(x + COMPANION_W, 3) || is_nan(d) || kind == BALL_EMPTY) {
        return 2;
    }
    mpq_set_ui(c->q[1], 0, 1);
    for (k = 0; k < 3; ++k) {
        companion_rational(c->q[2], x[COMPANION_W + k]);
        mpq_mul(c->q[2], c->q[2], c->q[2]);
        mpq_add(c->q[1], c->q[1], c->q[2]);
    }
    if (!is_finite(d) || mpq_sgn(c->q[1]) == 0) {
        return sign_of_double(d);
    }
    if (kind == BALL_SPACE) {
        return 0;
    }
    companion_rational(c->q[0], d);
    for (k = 0; k < 3; ++k) {
        companion_rational(c->q[2], x[COMPANION_W + k]);
        companion_rational(c->q[3], x[COMPANION_O + k]);
        mpq_mul(c->q[2], c->q[2], c->q[3]);
        mpq_add(c->q[0], c->q[0], c->q[2]);
    }
    sign = mpq_sgn(c->q[0]);
    mpq_mul(c->q[0], c->q[0], c->q[0]);
    companion_rational(c->q[2], x[COMPANION_T0]);
    mpq_mul(c->q[1], c->q[1], c->q[2]);
    mpq_mul(c->q[1], c->q[1], c->q[2]);
    return ball_touches(mpq_cmp(c->q[0], c->q[1]), wrong) ? 0 : sign;
}

static inline int sphere_box_judge(companion_work *c, int wrong)
{
    const double *x = c->x;
    const int kind = ball_kind(x + COMPANION_O, x[COMPANION_T0]);
    int k;
    if (kind != BALL_FINITE || !companion_is_box(x + COMPANION_LO, x + COMPANION_HI)) {
        return kind == BALL_SPACE && companion_is_box(x + COMPANION_LO, x + COMPANION_HI);
    }
    mpq_set_ui(c->q[0], 0, 1);
    for (k = 0; k < 3; ++k) {
        companion_rational(c->q[1], x[COMPANION_O + k]);
        companion_bound(c, c->q[2], x[COMPANION_LO + k]);
        companion_bound(c, c->q[3], x[COMPANION_HI + k]);
        if (mpq_cmp(c->q[1], c->q[2]) < 0) {
            mpq_sub(c->q[1], c->q[2], c->q[1]);
        } else if (mpq_cmp(c->q[1], c->q[3]) > 0) {
            mpq_sub(c->q[1], c->q[1], c->q[3]);
        } else {
            continue;
        }
        mpq_mul(c->q[1], c->q[1], c->q[1]);
        mpq_add(c->q[0], c->q[0], c->q[1]);
    }
    companion_rational(c->q[1], x[COMPANION_T0]);
    mpq_mul(c->q[1], c->q[1], c->q[1]);
    return ball_touches(mpq_cmp(c->q[0], c->q[1]), wrong);
}

/* q[0] = the square of the distance from w to the segment ij, if less than it is or not yet set */
static inline void touch_edge(companion_work *c, int i, int j, int *set)
{
    mpq_t *v = c->corner[i];
    mpq_t *q = c->corner[4];
    point_dot(c, c->q[1], c->corner[j], v, c->corner[j], v);
    point_dot(c, c->q[2], q, v, c->corner[j], v);
    point_dot(c, c->q[3], q, v, q, v);
    if (mpq_sgn(c->q[1]) != 0 && mpq_sgn(c->q[2]) > 0) {
        if (mpq_cmp(c->q[2], c->q[1]) > 0) {
            return; /* nearest to j, whose turn comes */
        }
        mpq_mul(c->q[2], c->q[2], c->q[2]);
        mpq_div(c->q[2], c->q[2], c->q[1]);
        mpq_sub(c->q[3], c->q[3], c->q[2]);
    }
    if (!*set || mpq_cmp(c->q[3], c->q[0]) < 0) {
        mpq_set(c->q[0], c->q[3]);
        *set = 1;
    }
}

/* The least of the distances to three edges; 0 and more of the plane, where the foot lies in T: its weights, as
 * solutions of two equations with a.a, a.b, b.b, are in [0, 1]. */
static inline int sphere_triangle_judge(companion_work *c, int wrong)
{
    const double *x = c->x;
    const int kind = ball_kind(x + COMPANION_O, x[COMPANION_T0]);
    mpq_t *q = c->q;
    int i, set = 0;
    if (kind != BALL_FINITE || !companion_finite(x, 9)) {
        return kind == BALL_SPACE && companion_finite(x, 9);
    }
    closest_load(c);
    for (i = 0; i < 3; ++i) {
        touch_edge(c, i, (i + 1) % 3, &set);
        touch_edge(c, (i + 1) % 3, i, &set);
    }
    point_dot(c, q[1], c->corner[1], c->corner[0], c->corner[1], c->corner[0]); /* aa */
    point_dot(c, q[2], c->corner[1], c->corner[0], c->corner[2], c->corner[0]); /* ab */
    point_dot(c, q[3], c->corner[2], c->corner[0], c->corner[2], c->corner[0]); /* bb */
    point_dot(c, q[4], c->corner[4], c->corner[0], c->corner[1], c->corner[0]); /* ap */
    point_dot(c, q[5], c->corner[4], c->corner[0], c->corner[2], c->corner[0]); /* bp */
    point_dot(c, q[6], c->corner[4], c->corner[0], c->corner[4], c->corner[0]); /* pp */
    mpq_mul(q[7], q[1], q[3]);
    mpq_mul(q[8], q[2], q[2]);
    mpq_sub(q[7], q[7], q[8]);
    if (mpq_sgn(q[7]) != 0 && wrong != WRONG_NO_FACE_POINT) {
        mpq_mul(q[8], q[3], q[4]);
        mpq_mul(q[9], q[2], q[5]);
        mpq_sub(q[8], q[8], q[9]);
        mpq_div(q[8], q[8], q[7]); /* weight of v1 */
        mpq_mul(q[9], q[1], q[5]);
        mpq_mul(q[10], q[2], q[4]);
        mpq_sub(q[9], q[9], q[10]);
        mpq_div(q[9], q[9], q[7]); /* of v2 */
        mpq_add(q[10], q[8], q[9]);
        if (mpq_sgn(q[8]) >= 0 && mpq_sgn(q[9]) >= 0 && mpq_cmp_ui(q[10], 1, 1) <= 0) {
            mpq_mul(q[8], q[8], q[4]);
            mpq_mul(q[9], q[9], q[5]);
            mpq_sub(q[0], q[6], q[8]);
            mpq_sub(q[0], q[0], q[9]);
        }
    }
    companion_rational(q[1], x[COMPANION_T0]);
    mpq_mul(q[1], q[1], q[1]);
    return ball_touches(mpq_cmp(q[0], q[1]), wrong);
}

static inline int sphere_triangle_confirm(companion_work *c, int value)
{
    const double *x = c->x;
    companion_answer out;
    if (ball_kind(x + COMPANION_O, x[COMPANION_T0]) != BALL_FINITE || !companion_finite(x, 9)) {
        return 1;
    }
    memset(&out, 0, sizeof out);
    closest_judge(c, WRONG_NOTHING, &out);
    point_dot(c, c->q[0], c->corner[4], c->nearest, c->corner[4], c->nearest);
    companion_rational(c->q[1], x[COMPANION_T0]);
    mpq_mul(c->q[1], c->q[1], c->q[1]);
    return (mpq_cmp(c->q[0], c->q[1]) <= 0) == value;
}

/* q[10 + 2e], q[11 + 2e]: below and above root e of A t^2 + 2 B t + C, equal if it is rational. A, B, C in q[0..2]. */
static inline int pierce_roots(companion_work *c)
{
    enum { BITS = 4096 };
    int e, i, square;
    mpq_mul(c->q[3], c->q[1], c->q[1]);
    mpq_mul(c->q[4], c->q[0], c->q[2]);
    mpq_sub(c->q[3], c->q[3], c->q[4]);
    if (mpq_sgn(c->q[3]) < 0) {
        return 0;
    }
    mpz_mul(c->z[0], mpq_numref(c->q[3]), mpq_denref(c->q[3])); /* the root of n / d is that of n d, over d */
    square = mpz_perfect_square_p(c->z[0]) != 0;
    mpz_mul_2exp(c->z[0], c->z[0], 2 * BITS);
    mpz_sqrt(c->z[0], c->z[0]);
    for (e = 0; e < 2; ++e) {
        for (i = 0; i < 2; ++i) { /* below, above */
            mpq_ptr t = c->q[10 + 2 * e + i];
            mpz_add_ui(c->z[1], c->z[0], (unsigned long)(!square && i == e));
            mpq_set_z(t, c->z[1]);
            mpq_div_2exp(t, t, BITS);
            mpq_set_z(c->q[5], mpq_denref(c->q[3]));
            mpq_div(t, t, c->q[5]);
            if (e == 0) {
                mpq_neg(t, t);
            }
            mpq_sub(t, t, c->q[1]);
            mpq_div(t, t, c->q[0]);
        }
    }
    return 1;
}

static inline void ray_sphere_judge(companion_work *c, int wrong, companion_answer *out)
{
    const double *x = c->x;
    const double *o = x + COMPANION_W;
    const double *d = x + COMPANION_LO;
    const double t_min = x[COMPANION_HI];
    const double t_max = x[COMPANION_T1];
    const int kind = ball_kind(x + COMPANION_O, x[COMPANION_T0]);
    int k;
    if (kind == BALL_EMPTY || !companion_finite(o, 3) || !companion_finite(d, 3) || is_nan(t_min) || is_nan(t_max) ||
        (!is_finite(t_min) && sign_of_double(t_min) > 0) || (!is_finite(t_max) && sign_of_double(t_max) < 0)) {
        return;
    }
    companion_time(c, c->t_min, t_min);
    companion_time(c, c->t_max, t_max);
    if (mpq_cmp(c->t_min, c->t_max) > 0) {
        return;
    }
    mpq_set(c->first, c->t_min);
    mpq_set(c->last, c->t_max);
    mpq_set_ui(c->q[0], 0, 1);
    mpq_set_ui(c->q[1], 0, 1);
    for (k = 0; k < 3 && kind == BALL_FINITE; ++k) {
        companion_rational(c->q[3], d[k]);
        companion_rational(c->q[4], o[k]);
        companion_rational(c->q[5], x[COMPANION_O + k]);
        mpq_sub(c->q[4], c->q[4], c->q[5]);
        mpq_mul(c->q[4], c->q[4], c->q[3]);
        mpq_add(c->q[1], c->q[1], c->q[4]);
        mpq_mul(c->q[3], c->q[3], c->q[3]);
        mpq_add(c->q[0], c->q[0], c->q[3]);
    }
    if (kind == BALL_FINITE) {
        ball_distance(c, c->q[2], o, x + COMPANION_O);
        companion_rational(c->q[3], x[COMPANION_T0]);
        mpq_mul(c->q[3], c->q[3], c->q[3]);
        mpq_sub(c->q[2], c->q[2], c->q[3]);
        if (mpq_sgn(c->q[0]) == 0) {
            if (mpq_sgn(c->q[2]) > 0) {
                return;
            }
        } else {
            if (!pierce_roots(c) || (wrong == WRONG_OPEN_BALL && mpq_equal(c->q[10], c->q[13])) ||
                mpq_cmp(c->q[11], c->t_max) > 0 || mpq_cmp(c->q[12], c->t_min) < 0) {
                return;
            }
            if (mpq_cmp(c->q[10], c->first) > 0) {
                mpq_set(c->first, c->q[10]);
            }
            if (mpq_cmp(c->q[13], c->last) < 0) {
                mpq_set(c->last, c->q[13]);
            }
        }
    }
    out->value = 1;
    out->n = 2;
    out->word[0] = companion_round(c, c->first, wrong == WRONG_START_NEAREST ? ROUND_NEAREST : ROUND_DOWN);
    out->word[1] = companion_round(c, c->last, wrong == WRONG_END_NEAREST ? ROUND_NEAREST : ROUND_UP);
    if (!is_finite(t_min) && mpq_equal(c->first, c->t_min)) {
        out->word[0] = 0xff800000u;
    }
    if (!is_finite(t_max) && mpq_equal(c->last, c->t_max)) {
        out->word[1] = 0x7f800000u;
    }
}

/* ---- spheres, by second methods --------------------------------------------------------------- */

/* The next float, upwards or downwards. */
static inline double contact_beside(double x, int up)
{
    float f = (float)x;
    int32_t bits;
    memcpy(&bits, &f, sizeof bits);
    bits = bits < 0 ? -(bits & 0x7fffffff) : bits;
    bits += up ? 1 : -1;
    bits = bits < 0 ? (int32_t)(0x80000000u | (uint32_t)-bits) : bits;
    memcpy(&f, &bits, sizeof f);
    return (double)f;
}

/* A common point, if there is one: on the way from a to b, where the radii part it. */
static inline int sphere_sphere_confirm(companion_work *c, int value)
{
    const double *x = c->x;
    mpq_t *q = c->q;
    int k, inside = 1, ball;
    if (ball_kind(x + COMPANION_W, x[COMPANION_T1]) != BALL_FINITE ||
        ball_kind(x + COMPANION_O, x[COMPANION_T0]) != BALL_FINITE) {
        return 1;
    }
    companion_rational(q[0], x[COMPANION_T1]);
    companion_rational(q[1], x[COMPANION_T0]);
    mpq_add(q[2], q[0], q[1]);
    if (mpq_sgn(q[2]) != 0) {
        mpq_div(q[2], q[0], q[2]);
    }
    for (ball = 0; ball < 2; ++ball) {
        mpq_set_ui(q[3], 0, 1);
        for (k = 0; k < 3; ++k) { /* the point less a centre */
            companion_rational(q[4], x[COMPANION_W + k]);
            companion_rational(q[5], x[COMPANION_O + k]);
            mpq_sub(q[6], q[5], q[4]);
            mpq_mul(q[6], q[6], q[2]);
            mpq_add(q[6], q[6], q[4]);
            mpq_sub(q[6], q[6], q[4 + ball]);
            mpq_mul(q[6], q[6], q[6]);
            mpq_add(q[3], q[3], q[6]);
        }
        mpq_mul(q[6], q[ball], q[ball]);
        inside &= mpq_cmp(q[3], q[6]) <= 0;
    }
    return inside == value;
}

/* The point of the plane below the centre, and the side on which the centre's mirror image is not. */
static inline int plane_sphere_confirm(companion_work *c, int value)
{
    const double *x = c->x;
    mpq_t *q = c->q;
    int k, side;
    if (value == 2 || !is_finite(x[COMPANION_T1]) || !is_finite(x[COMPANION_T0])) {
        return 1;
    }
    mpq_set_ui(q[0], 0, 1);
    companion_rational(q[1], x[COMPANION_T1]);
    for (k = 0; k < 3; ++k) {
        companion_rational(c->corner[0][k], x[COMPANION_W + k]);
        companion_rational(c->corner[1][k], x[COMPANION_O + k]);
        mpq_mul(q[2], c->corner[0][k], c->corner[0][k]);
        mpq_add(q[0], q[0], q[2]);
        mpq_mul(q[2], c->corner[0][k], c->corner[1][k]);
        mpq_add(q[1], q[1], q[2]);
    }
    if (mpq_sgn(q[0]) == 0) {
        return mpq_sgn(q[1]) == value;
    }
    side = mpq_sgn(q[1]);
    mpq_div(q[1], q[1], q[0]);
    mpq_set_ui(q[3], 0, 1);
    companion_rational(q[4], x[COMPANION_T1]);
    for (k = 0; k < 3; ++k) { /* the foot is in the plane, and so far from the centre */
        mpq_mul(q[2], q[1], c->corner[0][k]);
        mpq_sub(c->others[0][k], c->corner[1][k], q[2]);
        mpq_mul(q[5], c->others[0][k], c->corner[0][k]);
        mpq_add(q[4], q[4], q[5]);
        mpq_mul(q[2], q[2], q[2]);
        mpq_add(q[3], q[3], q[2]);
    }
    companion_rational(q[5], x[COMPANION_T0]);
    mpq_mul(q[5], q[5], q[5]);
    return mpq_sgn(q[4]) == 0 && (mpq_cmp(q[3], q[5]) <= 0 ? 0 : side) == value;
}

/* The centre is inside, or near one of the twelve triangles of the box's faces. */
static inline int sphere_box_confirm(companion_work *c, int value)
{
    double x[COMPANION_NUMBERS];
    companion_answer out;
    int face, half, k, touches = 1;
    memcpy(x, c->x, sizeof x);
    if (ball_kind(x + COMPANION_O, x[COMPANION_T0]) != BALL_FINITE || !companion_finite(x + COMPANION_LO, 6) ||
        !companion_is_box(x + COMPANION_LO, x + COMPANION_HI)) {
        return 1;
    }
    for (k = 0; k < 3; ++k) {
        companion_rational(c->q[0], x[COMPANION_LO + k]);
        companion_rational(c->q[1], x[COMPANION_O + k]);
        companion_rational(c->q[2], x[COMPANION_HI + k]);
        touches &= mpq_cmp(c->q[0], c->q[1]) <= 0 && mpq_cmp(c->q[1], c->q[2]) <= 0;
    }
    for (face = 0; face < 6; ++face) {
        for (half = 0; half < 2; ++half) {
            const int a = face % 3, b = (a + 1) % 3, d = (a + 2) % 3;
            for (k = 0; k < 3; ++k) { /* corners 00, 11, and 01 or 10 */
                c->x[3 * k + a] = x[(face < 3 ? COMPANION_LO : COMPANION_HI) + a];
                c->x[3 * k + b] = x[((k == 1 || (k == 2 && half)) ? COMPANION_HI : COMPANION_LO) + b];
                c->x[3 * k + d] = x[((k == 1 || (k == 2 && !half)) ? COMPANION_HI : COMPANION_LO) + d];
            }
            memset(&out, 0, sizeof out);
            closest_judge(c, WRONG_NOTHING, &out);
            point_dot(c, c->q[0], c->corner[4], c->nearest, c->corner[4], c->nearest);
            companion_rational(c->q[1], x[COMPANION_T0]);
            mpq_mul(c->q[1], c->q[1], c->q[1]);
            touches |= mpq_cmp(c->q[0], c->q[1]) <= 0;
        }
    }
    memcpy(c->x, x, sizeof x);
    return touches == value;
}

/* out = A t^2 + 2 B t + C at the rational t, as the square of the distance of that point less r^2. */
static inline void pierce_at(companion_work *c, mpq_t out, const mpq_t t)
{
    const double *x = c->x;
    int k;
    mpq_set_ui(out, 0, 1);
    for (k = 0; k < 3; ++k) {
        companion_rational(c->q[20], x[COMPANION_LO + k]);
        mpq_mul(c->q[20], c->q[20], t);
        companion_rational(c->q[21], x[COMPANION_W + k]);
        mpq_add(c->q[20], c->q[20], c->q[21]);
        companion_rational(c->q[21], x[COMPANION_O + k]);
        mpq_sub(c->q[20], c->q[20], c->q[21]);
        mpq_mul(c->q[20], c->q[20], c->q[20]);
        mpq_add(out, out, c->q[20]);
    }
    companion_rational(c->q[20], x[COMPANION_T0]);
    mpq_mul(c->q[20], c->q[20], c->q[20]);
    mpq_sub(out, out, c->q[20]);
}

/* Without roots: the point of the ray that is nearest to the centre is inside, the ends that were told are outside, or
 * the ray's own, and the next floats from them are inside, or past the nearest point. */
static inline int ray_sphere_confirm(companion_work *c, const companion_answer *answer)
{
    const double *x = c->x;
    mpq_t *q = c->q;
    double t[2];
    int e, k, ok;
    if (ball_kind(x + COMPANION_O, x[COMPANION_T0]) != BALL_FINITE || !companion_finite(x + COMPANION_W, 3) ||
        !companion_finite(x + COMPANION_LO, 3) || is_nan(x[COMPANION_HI]) || is_nan(x[COMPANION_T1])) {
        return 1;
    }
    t[0] = x[COMPANION_HI];
    t[1] = x[COMPANION_T1];
    companion_time(c, q[2], t[0]);
    companion_time(c, q[3], t[1]);
    if (mpq_cmp(q[2], q[3]) > 0 || (!is_finite(t[0]) && sign_of_double(t[0]) > 0) ||
        (!is_finite(t[1]) && sign_of_double(t[1]) < 0)) {
        return answer->value == 0;
    }
    mpq_set_ui(q[0], 0, 1);
    mpq_set_ui(q[1], 0, 1);
    for (k = 0; k < 3; ++k) {
        companion_rational(q[2], x[COMPANION_LO + k]);
        companion_rational(q[3], x[COMPANION_O + k]);
        companion_rational(q[4], x[COMPANION_W + k]);
        mpq_sub(q[3], q[3], q[4]);
        mpq_mul(q[3], q[3], q[2]);
        mpq_add(q[1], q[1], q[3]);
        mpq_mul(q[2], q[2], q[2]);
        mpq_add(q[0], q[0], q[2]);
    }
    if (mpq_sgn(q[0]) != 0) {
        mpq_div(q[1], q[1], q[0]); /* the nearest t of the line, then of the ray */
    }
    companion_time(c, q[2], t[0]);
    companion_time(c, q[3], t[1]);
    mpq_set(q[4], mpq_cmp(q[1], q[2]) < 0 ? q[2] : mpq_cmp(q[1], q[3]) > 0 ? q[3] : q[1]);
    pierce_at(c, q[5], q[4]);
    ok = (mpq_sgn(q[5]) <= 0) == answer->value;
    for (e = 0; e < 2 && answer->value && ok; ++e) {
        const double end = companion_number(answer->word[e], 0);
        companion_time(c, q[6], end);
        if (mpq_equal(q[6], q[2 + e])) { /* so is all from there to the nearest point */
            if (is_finite(end)) {
                pierce_at(c, q[5], q[2 + e]);
                ok = mpq_sgn(q[5]) <= 0;
                if (!ok) { /* or the sphere begins less than a float away */
                    companion_time(c, q[6], contact_beside(end, e == 0));
                    ok = e == 0 ? mpq_cmp(q[6], q[4]) > 0 : mpq_cmp(q[6], q[4]) < 0;
                    pierce_at(c, q[5], q[6]);
                    ok = ok || mpq_sgn(q[5]) < 0;
                }
            }
            continue;
        }
        pierce_at(c, q[5], q[6]);
        ok = (e == 0 ? mpq_cmp(q[6], q[4]) <= 0 : mpq_cmp(q[6], q[4]) >= 0) &&
             (!is_finite(end) || mpq_sgn(q[5]) >= 0);
        companion_time(c, q[6], contact_beside(end, e == 0));
        pierce_at(c, q[5], q[6]);
        ok = ok && ((e == 0 ? mpq_cmp(q[6], q[4]) > 0 : mpq_cmp(q[6], q[4]) < 0) || mpq_sgn(q[5]) < 0);
    }
    return ok;
}

/* ---- the whole -------------------------------------------------------------------------------- */

static inline int contact_owns(int which)
{
    return which >= COMPANION_SWEEP_RULE;
}

static inline void contact_judge(companion_work *c, const companion *ask, int wrong, companion_answer *out)
{
    switch (ask->which) {
    case COMPANION_SWEEP_RULE:
    case COMPANION_SWEEP_BOX:
        out->value = contact_load(c, ask->which, ask->flags) &&
                     contact_sweep(c, ask->which == COMPANION_SWEEP_BOX ? 3 : 13, contact_is_open(ask->flags), wrong);
        if (out->value) {
            out->n = 2;
            out->word[0] = companion_round(c, c->first, wrong == WRONG_START_NEAREST ? ROUND_NEAREST : ROUND_DOWN);
            out->word[1] = companion_round(c, c->last, wrong == WRONG_END_NEAREST ? ROUND_NEAREST : ROUND_UP);
            contact_unit(c, out->axis);
        }
        break;
    case COMPANION_GAP:
        gap_judge(c, wrong, out);
        break;
    case COMPANION_GRID_SEGMENT:
        segment_judge(c, ask, wrong, out);
        break;
    case COMPANION_SPHERE_SPHERE:
        out->value = sphere_sphere_judge(c, wrong);
        break;
    case COMPANION_PLANE_SPHERE:
        out->value = plane_sphere_judge(c, wrong);
        break;
    case COMPANION_SPHERE_BOX:
        out->value = sphere_box_judge(c, wrong);
        break;
    case COMPANION_SPHERE_TRIANGLE:
        out->value = sphere_triangle_judge(c, wrong);
        break;
    default:
        ray_sphere_judge(c, wrong, out);
        break;
    }
}

static inline int contact_confirm(companion_work *c, const companion *ask, const companion_answer *answer)
{
    switch (ask->which) {
    case COMPANION_SWEEP_RULE:
    case COMPANION_SWEEP_BOX:
        return contact_load(c, ask->which, ask->flags)
                   ? contact_sweep_confirm(c, ask->which, contact_is_open(ask->flags), answer->value)
                   : !answer->value;
    case COMPANION_GAP:
        return gap_confirm(c, answer->value);
    case COMPANION_GRID_SEGMENT:
        return segment_confirm(c, ask, answer->value);
    case COMPANION_SPHERE_SPHERE:
        return sphere_sphere_confirm(c, answer->value);
    case COMPANION_PLANE_SPHERE:
        return plane_sphere_confirm(c, answer->value);
    case COMPANION_SPHERE_BOX:
        return sphere_box_confirm(c, answer->value);
    case COMPANION_SPHERE_TRIANGLE:
        return sphere_triangle_confirm(c, answer->value);
    default:
        return ray_sphere_confirm(c, answer);
    }
}

/* Is the mutant one that can matter to the function? */
static inline int contact_mutant_applies(int which, int mutant)
{
    switch (which) {
    case COMPANION_SWEEP_RULE:
    case COMPANION_SWEEP_BOX:
        return mutant == WRONG_RULE || mutant == WRONG_START_NEAREST || mutant == WRONG_END_NEAREST;
    case COMPANION_GAP:
        return mutant <= WRONG_AXIS_LAST || mutant == WRONG_GAP_SIDE || mutant == WRONG_LAST_AXIS;
    case COMPANION_GRID_SEGMENT:
        return mutant == WRONG_RULE || mutant == WRONG_SEGMENT_ORDER;
    case COMPANION_SPHERE_TRIANGLE:
        return mutant == WRONG_OPEN_BALL || mutant == WRONG_NO_FACE_POINT;
    case COMPANION_RAY_SPHERE:
        return mutant == WRONG_OPEN_BALL || mutant == WRONG_START_NEAREST || mutant == WRONG_END_NEAREST;
    default:
        return mutant == WRONG_OPEN_BALL;
    }
}

#endif
