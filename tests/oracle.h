/* Exact truth for the tests, by another method than the header's: no axes, no filter.
 *
 * T is a triangle, B a box, P = T n B. P is convex and compact, so it is empty iff it has no extreme
 * point, and each extreme point is one of three kinds: a corner of T; an edge of T cut by the plane of a
 * face of B; an edge line of B cut by T. All candidates are formed as exact rational points (homogeneous,
 * W > 0) and kept if they lie in B.
 *   Why these are all: let x be extreme, F and G the least faces of T and B that hold it. If the affine
 * hulls of F
 *   and G shared a line, x could move along it both ways; so they share x only. F a corner: first kind. F
 * an edge:
 *   one of the face planes that G lies on is not parallel to F, second kind. F the triangle: two of G's
 * face planes
 *   and T's plane meet in x alone, third kind. A degenerate T is a segment or a point and ends with the
 * first two. Touching rules: a point of P strictly inside every open face exists iff each open face has an
 * extreme point strictly inside it (the mean of the extreme points is then strictly inside all of them).
 * Thin [SS10]: T's plane against the octahedron of the voxel's face centres, each projected edge against
 * the diamond of the projected voxel's edge midpoints, and the whole voxel's faces.
 *
 * Numbers are integers in units of the least bit of all inputs, of any length up to the full range of
 * double, so the answers hold for every finite input. The oracle reads bits and uses integers only: no
 * rounding mode, flush-to-zero or compiler flag changes it. */
#ifndef ORACLE_H
#define ORACLE_H

#include <stdint.h>
#include <string.h>

#include "test.h"

/* ---- integers of any length: sign and magnitude, 32-bit limbs ------------------------------------------ */

/* A coordinate spans 2^-1074 .. 2^1024 and a factor 2^32 for a voxel index, doubled: 2132 bits. A product
 * of three differences, summed: 3 * 2133 + 3 = 6402 bits = 201 limbs. */
#define WIDE_LIMBS 204

typedef struct wide {
    int      sign;      /* -1, 0, 1 */
    int      count;     /* limbs in use; the top one is not 0 */
    uint32_t limb[WIDE_LIMBS];
} wide;

static inline void wide_trim(wide *r)
{
    while (r->count > 0 && r->limb[r->count - 1] == 0) {
        r->count--;
    }
    if (r->count == 0) {
        r->sign = 0;
    }
}

static inline void wide_copy(wide *r, const wide *a)
{
    r->sign = a->sign;
    r->count = a->count;
    memcpy(r->limb, a->limb, sizeof a->limb[0] * (size_t)a->count);
}

/* mantissa * 2^shift, with the given sign; shift >= 0 */
TEST_FN void wide_set(wide *r, int sign, uint64_t mantissa, int shift)
{
    int      low = shift / 32;
    int      bit = shift % 32;
    uint32_t part[3];
    int      i;

    part[0] = (uint32_t)(mantissa << bit);
    part[1] = (uint32_t)((mantissa << bit) >> 32);
    part[2] = bit ? (uint32_t)(mantissa >> (64 - bit)) : 0;
    for (i = 0; i < low; i++) {
        r->limb[i] = 0;
    }
    for (i = 0; i < 3; i++) {
        r->limb[low + i] = part[i];
    }
    r->sign = sign;
    r->count = low + 3;
    wide_trim(r);
}

TEST_FN int wide_compare_magnitude(const wide *a, const wide *b)
{
    int i;

    if (a->count != b->count) {
        return a->count > b->count ? 1 : -1;
    }
    for (i = a->count - 1; i >= 0; i--) {
        if (a->limb[i] != b->limb[i]) {
            return a->limb[i] > b->limb[i] ? 1 : -1;
        }
    }
    return 0;
}

/* |r| = |a| + |b|; r may be a or b, here and below */
TEST_FN void wide_add_magnitude(wide *r, const wide *a, const wide *b)
{
    int      count = a->count > b->count ? a->count : b->count;
    uint64_t carry = 0;
    int      i;

    for (i = 0; i < count; i++) {
        carry += i < a->count ? a->limb[i] : 0u;
        carry += i < b->count ? b->limb[i] : 0u;
        r->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    r->count = count;
    if (carry) {
        r->limb[r->count++] = (uint32_t)carry;
    }
}

/* |r| = |a| - |b|, |a| >= |b| */
TEST_FN void wide_subtract_magnitude(wide *r, const wide *a, const wide *b)
{
    int      count = a->count;
    uint64_t borrow = 0;
    int      i;

    for (i = 0; i < count; i++) {
        uint64_t d = (uint64_t)a->limb[i] - (i < b->count ? b->limb[i] : 0u) - borrow;
        r->limb[i] = (uint32_t)d;
        borrow = d >> 63;
    }
    r->count = count;
}

TEST_FN void wide_add_signed(wide *r, const wide *a, const wide *b, int b_sign)
{
    int a_sign = a->sign;

    if (b_sign == 0) {
        wide_copy(r, a);
    } else if (a_sign == 0) {
        wide_copy(r, b);
        r->sign = b_sign;
    } else if (a_sign == b_sign) {
        wide_add_magnitude(r, a, b);
        r->sign = a_sign;
    } else if (wide_compare_magnitude(a, b) >= 0) {
        wide_subtract_magnitude(r, a, b);
        r->sign = a_sign;
        wide_trim(r);
    } else {
        wide_subtract_magnitude(r, b, a);
        r->sign = b_sign;
        wide_trim(r);
    }
}

static inline void wide_add(wide *r, const wide *a, const wide *b)
{
    wide_add_signed(r, a, b, b->sign);
}

static inline void wide_subtract(wide *r, const wide *a, const wide *b)
{
    wide_add_signed(r, a, b, -b->sign);
}

/* r is neither a nor b */
TEST_FN void wide_multiply(wide *r, const wide *a, const wide *b)
{
    int i;
    int j;

    r->sign = a->sign * b->sign;
    r->count = r->sign ? a->count + b->count : 0;
    for (i = 0; i < r->count; i++) {
        r->limb[i] = 0;
    }
    for (i = 0; r->sign && i < a->count; i++) {
        uint64_t carry = 0;
        for (j = 0; j < b->count; j++) {
            carry += (uint64_t)a->limb[i] * b->limb[j] + r->limb[i + j];
            r->limb[i + j] = (uint32_t)carry;
            carry >>= 32;
        }
        r->limb[i + b->count] = (uint32_t)carry;
    }
    wide_trim(r);
}

static inline int wide_compare(const wide *a, const wide *b)
{
    if (a->sign != b->sign) {
        return a->sign > b->sign ? 1 : -1;
    }
    return a->sign * wide_compare_magnitude(a, b);
}

/* ---- doubles by their bits ----------------------------------------------------------------------------- */

typedef struct oracle_number {
    int      sign;
    int      exponent;      /* value = sign * mantissa * 2^exponent, mantissa odd or 0 */
    uint64_t mantissa;
    int      is_nan;
    int      is_infinite;
} oracle_number;

/* By address, and through a volatile object: under -ffast-math compilers take a double that is passed by value for
 * neither NaN nor infinite, and fold what asks its bits. */
TEST_FN uint64_t oracle_bits(const double *x)
{
    volatile uint64_t bits;
    uint64_t          seen;

    memcpy(&seen, x, sizeof seen);
    bits = seen;
    return bits;
}

TEST_FN oracle_number oracle_read(const double *x)
{
    oracle_number  r;
    const uint64_t bits = oracle_bits(x);
    int            field;
    int            step;

    field = (int)(bits >> 52 & 2047);
    r.sign = bits >> 63 ? -1 : 1;
    r.mantissa = bits & 0xFFFFFFFFFFFFFu;
    r.is_nan = field == 2047 && r.mantissa != 0;
    r.is_infinite = field == 2047 && r.mantissa == 0;
    if (field != 0) {
        r.mantissa |= (uint64_t)1 << 52;
        r.exponent = field - 1075;
    } else {
        r.exponent = -1074;
    }
    if (r.mantissa == 0) {
        r.sign = 0;
    }
    for (step = 32; r.mantissa != 0 && step > 0; step /= 2) {
        if ((r.mantissa & (((uint64_t)1 << step) - 1)) == 0) {
            r.mantissa >>= step;
            r.exponent += step;
        }
    }
    return r;
}

static inline int oracle_is_finite(const double *x)
{
    return (oracle_bits(x) >> 52 & 2047) != 2047;
}

TEST_FN void oracle_lower_unit(int *unit, double x)
{
    oracle_number r = oracle_read(&x);

    if (r.sign != 0 && r.exponent < *unit) {
        *unit = r.exponent;
    }
}

TEST_FN void oracle_integer(wide *out, double x, int unit)
{
    oracle_number r = oracle_read(&x);

    wide_set(out, r.sign, r.mantissa, r.sign ? r.exponent - unit : 0);
}

/* A struct, because C before C23 warns when a two-dimensional array is passed as const. */
typedef struct triangle {
    double v[3][3];
} triangle;

/* ---- one question: a triangle and a box in integers ---------------------------------------------------- */

/* Bit f of an answer set is the truth under flag value f: closed 0, half-open 1, open 2, thin 4. */
#define ORACLE_CLOSED    (1u << 0)
#define ORACLE_HALF_OPEN (1u << 1)
#define ORACLE_OPEN      (1u << 2)
#define ORACLE_THIN      (1u << 4)

typedef struct oracle_case {
    wide v[3][3];
    wide face[2][3];    /* lower and upper faces; empty if crossed */
} oracle_case;

/* The truth for any flags, by the header's order: thin overrides, then open. */
static inline int oracle_says(unsigned answers, unsigned flags)
{
    unsigned rule = flags & 4u ? 4u : flags & 2u ? 2u : flags & 1u;

    return (int)(answers >> rule & 1u);
}

/* Where a homogeneous point lies: 0 outside B, else bit 6 and a bit per face that it is strictly inside
 * of. */
TEST_FN unsigned oracle_place(const oracle_case *c, const wide x[3], const wide *w)
{
    unsigned place = 64;
    int      a;

    for (a = 0; a < 3; a++) {
        wide t;
        int  s;

        wide_multiply(&t, &c->face[0][a], w);
        s = wide_compare(&x[a], &t);
        if (s < 0) {
            return 0;
        }
        place |= s > 0 ? 1u << a : 0u;
        wide_multiply(&t, &c->face[1][a], w);
        s = wide_compare(&x[a], &t);
        if (s > 0) {
            return 0;
        }
        place |= s < 0 ? 8u << a : 0u;
    }
    return place;
}

TEST_FN unsigned oracle_corners(const oracle_case *c)
{
    unsigned seen = 0;
    wide     one;
    int      i;

    wide_set(&one, 1, 1, 0);
    for (i = 0; i < 3; i++) {
        seen |= oracle_place(c, c->v[i], &one);
    }
    return seen;
}

/* The point of edge pq on the plane x_a = f: p * |q_a - f| + q * |p_a - f| over |q_a - p_a|. */
TEST_FN unsigned oracle_edge_and_face(const oracle_case *c, const wide p[3], const wide q[3], int a,
                                      const wide *f)
{
    int  sp = wide_compare(&p[a], f);
    int  sq = wide_compare(&q[a], f);
    wide wp;
    wide wq;
    wide w;
    wide x[3];
    int  b;

    if (sp * sq > 0 || wide_compare(&p[a], &q[a]) == 0) {
        return 0;
    }
    wide_subtract(&wp, &q[a], f);
    wide_subtract(&wq, &p[a], f);
    wp.sign *= wp.sign;
    wq.sign *= wq.sign;
    wide_add(&w, &wp, &wq);
    for (b = 0; b < 3; b++) {
        wide t;
        wide_multiply(&x[b], &p[b], &wp);
        wide_multiply(&t, &q[b], &wq);
        wide_add(&x[b], &x[b], &t);
    }
    return oracle_place(c, x, &w);
}

/* Twice the signed area of p, q, r projected along axis a; r is given by its two coordinates. */
TEST_FN void oracle_area(wide *out, const wide p[3], const wide q[3], int a, const wide *rb, const wide *rc)
{
    int  b = (a + 1) % 3;
    int  e = (a + 2) % 3;
    wide s;
    wide t;
    wide u;

    wide_subtract(&s, &q[b], &p[b]);
    wide_subtract(&t, rc, &p[e]);
    wide_multiply(out, &s, &t);
    wide_subtract(&s, &q[e], &p[e]);
    wide_subtract(&t, rb, &p[b]);
    wide_multiply(&u, &s, &t);
    wide_subtract(out, out, &u);
}

/* The line along axis a through (yb, yc) cut by T: barycentric weights are areas. T parallel to a: no
 * single point. */
TEST_FN unsigned oracle_box_edge(const oracle_case *c, int a, const wide *yb, const wide *yc)
{
    int  b = (a + 1) % 3;
    int  e = (a + 2) % 3;
    wide weight[3];
    wide w;
    wide x[3];
    int  sign = 0;
    int  i;

    for (i = 0; i < 3; i++) {
        oracle_area(&weight[i], c->v[(i + 1) % 3], c->v[(i + 2) % 3], a, yb, yc);
        if (weight[i].sign * sign < 0) {
            return 0;
        }
        sign = weight[i].sign ? weight[i].sign : sign;
    }
    wide_add(&w, &weight[0], &weight[1]);
    wide_add(&w, &w, &weight[2]);
    if (w.sign == 0) {
        return 0;
    }
    wide_set(&x[a], 1, 0, 0);
    for (i = 0; i < 3; i++) {
        wide t;
        weight[i].sign *= sign;
        wide_multiply(&t, &weight[i], &c->v[i][a]);
        wide_add(&x[a], &x[a], &t);
    }
    w.sign = 1;
    wide_multiply(&x[b], yb, &w);
    wide_multiply(&x[e], yc, &w);
    return oracle_place(c, x, &w);
}

/* Is the box empty, or are all corners beyond one of its faces, and so all of T? */
TEST_FN int oracle_beyond_a_face(const oracle_case *c)
{
    int a;

    for (a = 0; a < 3; a++) {
        int below = 0;
        int above = 0;
        int i;
        for (i = 0; i < 3; i++) {
            below += wide_compare(&c->v[i][a], &c->face[0][a]) < 0;
            above += wide_compare(&c->v[i][a], &c->face[1][a]) > 0;
        }
        if (below == 3 || above == 3 || wide_compare(&c->face[0][a], &c->face[1][a]) > 0) {
            return 1;
        }
    }
    return 0;
}

/* Closed, half-open and open answers at once. */
TEST_FN unsigned oracle_rules(const oracle_case *c)
{
    const unsigned upper = 8 + 16 + 32;
    unsigned       seen;
    int            a;
    int            i;
    int            k;

    if (oracle_beyond_a_face(c)) {
        return 0;
    }
    seen = oracle_corners(c);
    for (a = 0; a < 3; a++) {
        for (i = 0; i < 3; i++) {
            for (k = 0; k < 2 && seen != 127; k++) {
                seen |= oracle_edge_and_face(c, c->v[i], c->v[(i + 1) % 3], a, &c->face[k][a]);
            }
        }
    }
    for (a = 0; a < 3; a++) {
        for (k = 0; k < 4 && seen != 127; k++) {
            seen |= oracle_box_edge(c, a, &c->face[k & 1][(a + 1) % 3], &c->face[k >> 1][(a + 2) % 3]);
        }
    }
    if (seen == 0) {
        return 0;
    }
    return ORACLE_CLOSED | ((seen & upper) == upper ? ORACLE_HALF_OPEN : 0) | (seen == 127 ? ORACLE_OPEN : 0);
}

/* ---- thin ---------------------------------------------------------------------------------------------- */

/* The case doubled, so that the voxel's centre is an integer point too. */
typedef struct oracle_thin_case {
    oracle_case c;
    wide        centre[3];
} oracle_thin_case;

TEST_FN void oracle_double(oracle_thin_case *d, const oracle_case *c)
{
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        for (i = 0; i < 3; i++) {
            wide_add(&d->c.v[i][a], &c->v[i][a], &c->v[i][a]);
        }
        for (i = 0; i < 2; i++) {
            wide_add(&d->c.face[i][a], &c->face[i][a], &c->face[i][a]);
        }
        wide_add(&d->centre[a], &c->face[0][a], &c->face[1][a]);
    }
}

/* Does some vertex of the projected diamond lie on the inner side of each projected edge? n_a >= 0 turns
 * left. */
TEST_FN int oracle_thin_edges(const oracle_thin_case *d, int a)
{
    const oracle_case *c = &d->c;
    int                b = (a + 1) % 3;
    int                e = (a + 2) % 3;
    wide               area;
    int                side;
    int                i;

    oracle_area(&area, c->v[0], c->v[1], a, &c->v[2][b], &c->v[2][e]);
    side = area.sign >= 0 ? 1 : -1;
    for (i = 0; i < 3; i++) {
        int inside = 0;
        int k;
        for (k = 0; k < 4 && !inside; k++) {
            const wide *qb = k < 2 ? &c->face[k][b] : &d->centre[b];
            const wide *qe = k < 2 ? &d->centre[e] : &c->face[k - 2][e];
            oracle_area(&area, c->v[i], c->v[(i + 1) % 3], a, qb, qe);
            inside = area.sign * side >= 0;
        }
        if (!inside) {
            return 0;
        }
    }
    return 1;
}

/* Do face centres of the voxel lie on both closed sides of T's plane? */
TEST_FN int oracle_thin_plane(const oracle_thin_case *d)
{
    const oracle_case *c = &d->c;
    int                above = 0;
    int                below = 0;
    wide               n[3];
    int                a;
    int                b;
    int                k;

    for (a = 0; a < 3; a++) {
        oracle_area(&n[a], c->v[0], c->v[1], a, &c->v[2][(a + 1) % 3], &c->v[2][(a + 2) % 3]);
    }
    for (k = 0; k < 6 && !(above && below); k++) {
        wide sum;
        a = k % 3;
        wide_set(&sum, 1, 0, 0);
        for (b = 0; b < 3; b++) {
            wide s;
            wide t;
            wide_subtract(&s, b == a ? &c->face[k / 3][b] : &d->centre[b], &c->v[0][b]);
            wide_multiply(&t, &s, &n[b]);
            wide_add(&sum, &sum, &t);
        }
        above |= sum.sign >= 0;
        below |= sum.sign <= 0;
    }
    return above && below;
}

TEST_FN int oracle_thin(const oracle_case *c)
{
    oracle_thin_case d;
    int              a;

    if (oracle_beyond_a_face(c)) {
        return 0;
    }
    oracle_double(&d, c);
    for (a = 0; a < 3; a++) {
        if (!oracle_thin_edges(&d, a)) {
            return 0;
        }
    }
    return oracle_thin_plane(&d);
}

/* ---- the questions of the interface -------------------------------------------------------------------- */

TEST_FN int oracle_triangle_is_a_set(const triangle *t)
{
    int i;

    for (i = 0; i < 9; i++) {
        if (!oracle_is_finite(&t->v[i / 3][i % 3])) {
            return 0;
        }
    }
    return 1;
}

/* An infinite upper (side 1) or lower (side 0) face stands just beyond the triangle: it cuts nothing away. */
TEST_FN void oracle_face_beyond(oracle_case *c, int side, int a)
{
    wide one;
    int  i;

    wide_copy(&c->face[side][a], &c->v[0][a]);
    for (i = 1; i < 3; i++) {
        if (wide_compare(&c->v[i][a], &c->face[side][a]) == (side ? 1 : -1)) {
            wide_copy(&c->face[side][a], &c->v[i][a]);
        }
    }
    wide_set(&one, side ? 1 : -1, 1, 0);
    wide_add(&c->face[side][a], &c->face[side][a], &one);
}

TEST_FN void oracle_set_triangle(oracle_case *c, const triangle *t, int unit)
{
    int i;

    for (i = 0; i < 9; i++) {
        oracle_integer(&c->v[i / 3][i % 3], t->v[i / 3][i % 3], unit);
    }
}

TEST_FN int oracle_unit(const triangle *t)
{
    int unit = 2000;
    int i;

    for (i = 0; i < 9; i++) {
        oracle_lower_unit(&unit, t->v[i / 3][i % 3]);
    }
    return unit;
}

/* The answer set for the box of real points min <= x <= max (the rules: <). No thin bit: that needs a
 * voxel. */
TEST_FN unsigned oracle_box(const triangle *t, const double box_min[3], const double box_max[3])
{
    oracle_case c;
    int         unit = oracle_unit(t);
    int         a;

    if (!oracle_triangle_is_a_set(t)) {
        return 0;
    }
    for (a = 0; a < 3; a++) {
        oracle_number lo = oracle_read(&box_min[a]);
        oracle_number hi = oracle_read(&box_max[a]);
        if (lo.is_nan || hi.is_nan || (lo.is_infinite && lo.sign > 0) || (hi.is_infinite && hi.sign < 0)) {
            return 0;
        }
        if (!lo.is_infinite) {
            oracle_lower_unit(&unit, box_min[a]);
        }
        if (!hi.is_infinite) {
            oracle_lower_unit(&unit, box_max[a]);
        }
    }
    oracle_set_triangle(&c, t, unit);
    for (a = 0; a < 3; a++) {
        if (oracle_is_finite(&box_min[a])) {
            oracle_integer(&c.face[0][a], box_min[a], unit);
        } else {
            oracle_face_beyond(&c, 0, a);
        }
        if (oracle_is_finite(&box_max[a])) {
            oracle_integer(&c.face[1][a], box_max[a], unit);
        } else {
            oracle_face_beyond(&c, 1, a);
        }
        /* A box wholly beyond the triangle on an axis with an infinite face: both replacements would
         * cross. */
        if (wide_compare(&c.face[0][a], &c.face[1][a]) > 0) {
            return 0;
        }
    }
    return oracle_rules(&c);
}

/* The answer set for [p + index*size, p + (index+1)*size], in real numbers. An infinite size (then index
 * is 0) is [p, +inf), under thin too, where the voxel then counts as conservative. */
TEST_FN unsigned oracle_voxel(const triangle *t, const double p[3], const double size[3], const int index[3])
{
    oracle_case c;
    unsigned    answers;
    int         unit = oracle_unit(t);
    int         unbounded = 0;
    int         a;

    if (!oracle_triangle_is_a_set(t)) {
        return 0;
    }
    for (a = 0; a < 3; a++) {
        oracle_number s = oracle_read(&size[a]);
        if (!oracle_is_finite(&p[a]) || s.is_nan || s.sign < 0) {
            return 0;
        }
        oracle_lower_unit(&unit, p[a]);
        if (!s.is_infinite) {
            oracle_lower_unit(&unit, size[a]);
        }
    }
    oracle_set_triangle(&c, t, unit);
    for (a = 0; a < 3; a++) {
        oracle_integer(&c.face[0][a], p[a], unit);
        if (oracle_is_finite(&size[a])) {
            wide step;
            wide count;
            wide offset;
            oracle_integer(&step, size[a], unit);
            wide_set(&count, index[a] < 0 ? -1 : 1,
                     index[a] < 0 ? 0 - (uint64_t)index[a] : (uint64_t)index[a], 0);
            wide_multiply(&offset, &step, &count);
            wide_add(&c.face[0][a], &c.face[0][a], &offset);
            wide_add(&c.face[1][a], &c.face[0][a], &step);
        } else {
            unbounded = 1;
            oracle_face_beyond(&c, 1, a);
            if (wide_compare(&c.face[0][a], &c.face[1][a]) > 0) {
                return 0;
            }
        }
    }
    answers = oracle_rules(&c);
    if (unbounded ? (answers & ORACLE_CLOSED) != 0 : oracle_thin(&c)) {
        answers |= ORACLE_THIN;
    }
    return answers;
}

/* Is the double sum exactly p + size? */
TEST_FN int oracle_sum_is(const double *p, const double *size, const double *sum)
{
    int  unit = 2000;
    wide a;
    wide b;
    wide s;

    if (!oracle_is_finite(p) || !oracle_is_finite(size) || !oracle_is_finite(sum)) {
        return 0;
    }
    oracle_lower_unit(&unit, *p);
    oracle_lower_unit(&unit, *size);
    oracle_lower_unit(&unit, *sum);
    oracle_integer(&a, *p, unit);
    oracle_integer(&b, *size, unit);
    oracle_integer(&s, *sum, unit);
    wide_add(&a, &a, &b);
    return wide_compare(&a, &s) == 0;
}

#endif /* ORACLE_H */
