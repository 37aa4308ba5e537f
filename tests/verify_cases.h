/* Hard questions for verify.c and the fuzzers' seeds: triangles and boxes that almost touch, touch exactly,
 * or have unusual numbers. Everything is drawn from one seeded generator; nothing here knows an answer.
 */
#ifndef VERIFY_CASES_H
#define VERIFY_CASES_H

#include "verify_exact.h"

enum {
    CASE_RANDOM,
    CASE_LATTICE,
    CASE_DECIMAL,
    CASE_CONTACT,
    CASE_SLIVER,
    CASE_DEGENERATE,
    CASE_SCALES,
    CASE_EXTREME,
    CASE_FLAT,
    CASE_ALIGNED,
    CASE_FAR,
    CASE_SPECIAL,
    CASE_BITS,
    CASES
};

static const char *const case_names[CASES] = {"random",     "lattice", "decimal grid", "contact",  "sliver",
                                              "degenerate", "scales",  "extreme",      "flat box", "aligned",
                                              "far away",   "special", "any bits"};

typedef struct dice {
    uint64_t state;
} dice;

/* ---- numbers ---------------------------------------------------------------------------------- */

static inline uint64_t dice_bits(dice *d)
{
    uint64_t z = d->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static inline int dice_below(dice *d, int n)
{
    return (int)(dice_bits(d) % (uint64_t)n);
}

static inline int dice_between(dice *d, int lo, int hi)
{
    return lo + dice_below(d, hi - lo + 1);
}

static inline int dice_once_in(dice *d, int n)
{
    return dice_below(d, n) == 0;
}

/* in [0, 1) */
static inline double dice_unit(dice *d)
{
    return (double)(dice_bits(d) >> 11) / 9007199254740992.0;
}

/* in [-1, 1) */
static inline double dice_signed(dice *d)
{
    return 2.0 * dice_unit(d) - 1.0;
}

static inline double bits_double(uint64_t u)
{
    double d;
    memcpy(&d, &u, sizeof d);
    return d;
}

/* 2^e for any e, saturating at 0 and infinity */
static inline double power_of_two(int e)
{
    if (e > 1023) {
        return bits_double(UINT64_C(0x7ff) << 52);
    }
    if (e >= -1022) {
        return bits_double((uint64_t)(e + 1023) << 52);
    }
    return e < -1074 ? 0.0 : bits_double(UINT64_C(1) << (e + 1074));
}

/* order-preserving integers of the numbers of one format */
static inline int64_t number_key(double d, int f64)
{
    if (f64) {
        int64_t k;
        memcpy(&k, &d, sizeof k);
        return k < 0 ? INT64_MIN - k : k;
    } else {
        float f = (float)d;
        int32_t k;
        memcpy(&k, &f, sizeof k);
        return k < 0 ? (int64_t)INT32_MIN - k : k;
    }
}

static inline double key_number(int64_t key, int f64)
{
    if (f64) {
        double d;
        int64_t k = key < 0 ? INT64_MIN - key : key;
        memcpy(&d, &k, sizeof d);
        return d;
    } else {
        float f;
        int32_t k = (int32_t)(key < 0 ? (int64_t)INT32_MIN - key : key);
        memcpy(&f, &k, sizeof f);
        return (double)f;
    }
}

/* The nearest float, as a double. Through memory: gcc 12 drops neighbouring (double)(float) pairs when it
 * vectorises. */
static inline double nearest_float(double d)
{
    volatile float f = (float)d;
    return (double)f;
}

/* d rounded to the format; what is too large for it becomes its largest number */
static inline double number_fit(double d, int f64)
{
    double most = 0x1.fffffep127;
    if (f64) {
        return d;
    }
    return d > most ? most : d < -most ? -most : nearest_float(d);
}

/* the number `ulps` places further up in its format; stays finite */
static inline double number_step(double d, int ulps, int f64)
{
    int64_t most = f64 ? INT64_C(0x7fefffffffffffff) : INT64_C(0x7f7fffff);
    int64_t key = number_key(d, f64);
    if (!is_finite(d)) {
        return d;
    }
    key += ulps;
    return key_number(key > most ? most : key < -most ? -most : key, f64);
}

static inline int is_float(double d)
{
    uint64_t bits;
    int exponent;
    if (!is_finite(d)) {
        return 1;
    }
    memcpy(&bits, &d, sizeof bits); /* a processor that flushes reads 2^-1074 as 0 */
    exponent = (int)(bits >> 52 & 0x7ff) - 1023;
    bits = (bits & 0xfffffffffffffu) | (uint64_t)1 << 52;
    if (exponent < -149 || exponent > 127) {
        return exponent == -1023 && bits == (uint64_t)1 << 52; /* zero */
    }
    return bits % ((uint64_t)1 << (exponent < -126 ? 29 - 126 - exponent : 29)) == 0;
}

/* ---- shapes ----------------------------------------------------------------------------------- */

static inline void shape_triangle(dice *d, double v[9], double reach)
{
    int i;
    for (i = 0; i < 9; ++i) {
        v[i] = reach * dice_signed(d);
    }
}

/* the third corner close to the line through the first two, or the second close to the first */
static inline void shape_sliver(dice *d, double v[9], int f64)
{
    double t = dice_once_in(d, 2) ? dice_unit(d) : 3.0 * dice_signed(d);
    double thin = power_of_two(-dice_between(d, 4, f64 ? 60 : 30));
    int k;
    for (k = 0; k < 3; ++k) {
        v[6 + k] = v[k] + t * (v[3 + k] - v[k]) + thin * dice_signed(d);
    }
    if (dice_once_in(d, 4)) {
        for (k = 0; k < 3; ++k) {
            v[3 + k] = v[k] + thin * dice_signed(d);
        }
    }
}

/* a segment (two equal corners, or a third one on the line) or a point */
static inline void shape_degenerate(dice *d, double v[9])
{
    int how = dice_below(d, 4);
    int from = dice_below(d, 3);
    int to = (from + dice_between(d, 1, 2)) % 3;
    int k;
    for (k = 0; k < 3; ++k) {
        if (how == 0) {
            v[3 * to + k] = v[3 * from + k];
        } else if (how == 1) {
            v[3 + k] = v[k];
            v[6 + k] = v[k];
        } else {
            /* quarter steps, so that the middle corner is exactly on the line when the ends allow it */
            double q = how == 2 ? 0.5 : 0.25;
            v[k] = (double)dice_between(d, -64, 64) / 16.0;
            v[3 + k] = (double)dice_between(d, -64, 64) / 16.0;
            v[6 + k] = v[k] + q * (v[3 + k] - v[k]);
        }
    }
}

/* the triangle in an axis plane, or with an edge along an axis or a diagonal */
static inline void shape_aligned(dice *d, double v[9])
{
    int a = dice_below(d, 3);
    int b = (a + 1) % 3;
    int c = (a + 2) % 3;
    int how = dice_below(d, 4);
    if (how <= 1) {
        v[3 + a] = v[a];
        v[6 + a] = v[a];
    }
    if (how == 1) {
        v[3 + b] = v[b];
        v[6 + c] = v[c];
    }
    if (how == 2) {
        v[3 + b] = v[b];
        v[3 + c] = v[c];
    }
    if (how == 3) {
        double t = (double)dice_between(d, 1, 8) / 8.0;
        v[3 + a] = v[a] + t;
        v[3 + b] = v[b] + (dice_once_in(d, 2) ? t : -t);
        v[3 + c] = v[c];
    }
}

static inline void shape_normal(const double v[9], double n[3])
{
    int a;
    for (a = 0; a < 3; ++a) {
        int b = (a + 1) % 3;
        int c = (a + 2) % 3;
        n[a] = (v[3 + b] - v[b]) * (v[6 + c] - v[c]) - (v[3 + c] - v[c]) * (v[6 + b] - v[b]);
    }
}

static inline int sign_of(double x)
{
    return (x > 0.0) - (x < 0.0);
}

/* a point of the triangle: a corner, a point of an edge, or an inner point */
static inline void shape_point(dice *d, const double v[9], int corners, double out[3])
{
    double w[3];
    int i, k, first = dice_below(d, 3);
    double a = dice_unit(d);
    double b = dice_unit(d) * (1.0 - a);
    if (dice_once_in(d, 2)) { /* exact weights */
        a = (double)dice_between(d, 0, 4) / 8.0;
        b = (double)dice_between(d, 0, 4) / 8.0;
    }
    for (i = 0; i < 3; ++i) {
        w[i] = 0.0;
    }
    w[first] = corners == 1 ? 1.0 : a;
    w[(first + 1) % 3] = corners == 1 ? 0.0 : corners == 2 ? 1.0 - a : b;
    w[(first + 2) % 3] = corners == 3 ? 1.0 - a - b : 0.0;
    for (k = 0; k < 3; ++k) {
        out[k] = w[0] * v[k] + w[1] * v[3 + k] + w[2] * v[6 + k];
    }
}

/* lays a box against the point on the sides s: +1 above it, -1 below, 0 around it */
static inline void box_against(dice *d, const double point[3], const int s[3], double reach, double box[6])
{
    int k;
    for (k = 0; k < 3; ++k) {
        double down = reach * dice_unit(d) * power_of_two(-dice_below(d, 6));
        double up = reach * dice_unit(d) * power_of_two(-dice_below(d, 6));
        box[k] = point[k] - (s[k] > 0 ? 0.0 : down);
        box[3 + k] = point[k] + (s[k] < 0 ? 0.0 : up);
    }
}

/* A box that touches the triangle, up to rounding: its corner at the plane, its edge at an edge, its face at
 * a corner, or any of its features at any point. */
static inline void box_touching(dice *d, const double v[9], double reach, double box[6])
{
    double n[3], point[3];
    int s[3];
    int k, how = dice_below(d, 8);
    int side = dice_once_in(d, 2) ? 1 : -1;
    shape_normal(v, n);
    if (how < 2) { /* plane */
        shape_point(d, v, 3, point);
        for (k = 0; k < 3; ++k) {
            s[k] = side * sign_of(n[k]);
        }
    } else if (how < 5) { /* edge, along axis a: outward from the triangle seen along a */
        int a = dice_below(d, 3);
        int b = (a + 1) % 3;
        int c = (a + 2) % 3;
        int i = dice_below(d, 3);
        int j = (i + 1) % 3;
        double t = dice_once_in(d, 2) ? dice_unit(d) : (double)dice_between(d, 0, 8) / 8.0;
        double up = n[a] >= 0.0 ? 1.0 : -1.0;
        for (k = 0; k < 3; ++k) {
            point[k] = v[3 * i + k] + t * (v[3 * j + k] - v[3 * i + k]);
        }
        s[a] = 0;
        s[b] = sign_of(up * (v[3 * j + c] - v[3 * i + c]));
        s[c] = sign_of(up * (v[3 * i + b] - v[3 * j + b]));
    } else if (how == 5) { /* the farthest corner along axis a */
        int a = dice_below(d, 3);
        int best = 0, i;
        for (i = 1; i < 3; ++i) {
            if (side * v[3 * i + a] > side * v[3 * best + a]) {
                best = i;
            }
        }
        for (k = 0; k < 3; ++k) {
            point[k] = v[3 * best + k];
            s[k] = k == a ? side : 0;
        }
    } else {
        shape_point(d, v, dice_between(d, 1, 3), point);
        for (k = 0; k < 3; ++k) {
            s[k] = dice_between(d, -1, 1);
        }
    }
    box_against(d, point, s, reach, box);
}

static inline void box_anywhere(dice *d, double reach, double box[6])
{
    int k;
    for (k = 0; k < 3; ++k) {
        box[k] = reach * dice_signed(d);
        box[3 + k] = box[k] + reach * dice_unit(d);
    }
}

static inline void scale_all(double x[15], double factor)
{
    int i;
    for (i = 0; i < 15; ++i) {
        x[i] *= factor;
    }
}

static inline void nudge_some(dice *d, double x[15], int f64)
{
    int times = dice_below(d, 4);
    while (times-- > 0) {
        int i = dice_below(d, 15);
        x[i] = number_step(x[i], dice_between(d, -2, 2), f64);
    }
}

/* ---- one question of a class ------------------------------------------------------------------ */

static inline void case_lattice(dice *d, double x[15])
{
    int i;
    int most = dice_once_in(d, 2) ? 8 : 3;
    for (i = 0; i < 15; ++i) {
        x[i] = (double)dice_between(d, 0, most);
    }
    for (i = 9; i < 12; ++i) {
        x[i + 3] = x[i] + (double)dice_between(d, 0, most - 1);
    }
}

/* multiples of a step that binary has no exact form for, with an offset, each rounded */
static inline void case_decimal(dice *d, double x[15], int f64)
{
    static const double steps[6] = {0.1, 1.0 / 3.0, 0.01, 0.7, 0.3, 1e-3};
    static const double offsets[5] = {0.0, 0.0, 1e4 + 0.1, -5.5, 123.456};
    double step = number_fit(steps[dice_below(d, 6)], f64);
    double offset = offsets[dice_below(d, 5)];
    int i;
    for (i = 0; i < 15; ++i) {
        x[i] = number_fit(offset + step * (double)dice_between(d, -8, 8), f64);
    }
    for (i = 9; i < 12; ++i) {
        double far = x[i] + step * (double)dice_between(d, 0, 6);
        x[i + 3] = number_fit(far, f64);
    }
}

static inline double special_number(dice *d, int f64)
{
    double most = f64 ? 0x1.fffffffffffffp1023 : 0x1.fffffep127;
    double least = f64 ? 0x1p-1074 : 0x1p-149;
    double normal = f64 ? 0x1p-1022 : 0x1p-126;
    double table[10];
    table[0] = 0.0;
    table[1] = -0.0;
    table[2] = bits_double(UINT64_C(0x7ff) << 52);
    table[3] = -table[2];
    table[4] = bits_double(UINT64_C(0x7ff8) << 48);
    table[5] = most;
    table[6] = -most;
    table[7] = dice_once_in(d, 2) ? least : -least;
    table[8] = normal;
    table[9] = number_step(normal, -1, f64);
    return table[dice_below(d, 10)];
}

static inline double any_bits(dice *d, int f64)
{
    if (f64) {
        return bits_double(dice_bits(d));
    } else {
        uint32_t u = (uint32_t)dice_bits(d);
        float f;
        memcpy(&f, &u, sizeof f);
        return (double)f;
    }
}

/* fills x with a question of the class; kind ASK_BOX */
static inline void case_make(dice *d, int which, int f64, double x[15])
{
    double *box = x + 9;
    double reach = power_of_two(dice_between(d, -4, 2));
    int i;
    shape_triangle(d, x, 1.0);
    switch (which) {
    case CASE_LATTICE:
        case_lattice(d, x);
        if (dice_once_in(d, 8)) {
            nudge_some(d, x, f64);
        }
        return;
    case CASE_DECIMAL:
        case_decimal(d, x, f64);
        if (dice_once_in(d, 8)) {
            nudge_some(d, x, f64);
        }
        return;
    case CASE_BITS:
        for (i = 0; i < 15; ++i) {
            x[i] = any_bits(d, f64);
        }
        return;
    case CASE_SLIVER:
        shape_sliver(d, x, f64);
        break;
    case CASE_DEGENERATE:
        shape_degenerate(d, x);
        break;
    case CASE_ALIGNED:
        shape_aligned(d, x);
        break;
    case CASE_SCALES:
        reach = power_of_two(dice_between(d, -24, 24));
        break;
    case CASE_FAR: {
        double offset = power_of_two(dice_between(d, 2, f64 ? 40 : 18));
        for (i = 0; i < 9; ++i) {
            x[i] += offset * (double)(1 + i % 3);
        }
        break;
    }
    case CASE_EXTREME:
        switch (dice_below(d, 3)) {
        case 0:
            shape_sliver(d, x, f64);
            break;
        case 1:
            shape_degenerate(d, x);
            break;
        default:
            break;
        }
        break;
    default:
        break;
    }
    for (i = 0; i < 9; ++i) {
        x[i] = number_fit(x[i], f64);
    }
    if (which == CASE_RANDOM) {
        box_anywhere(d, 1.0, box);
    } else {
        box_touching(d, x, reach, box);
    }
    if (which == CASE_FLAT) {
        for (i = 0; i < 3; ++i) {
            if (dice_once_in(d, 2)) {
                box[3 + i] = box[i];
            }
        }
    }
    if (which == CASE_EXTREME) {
        /* past both ends of the format: what does not fit saturates or becomes subnormal */
        int top = f64 ? 1022 : 126;
        int bottom = f64 ? -1070 : -146;
        int e = dice_once_in(d, 2) ? dice_between(d, top - 8, top) : dice_between(d, bottom, bottom + 60);
        scale_all(x, power_of_two(e));
        if (dice_once_in(d, 4)) { /* one number out of all proportion */
            x[dice_below(d, 15)] =
                number_fit(dice_signed(d) * power_of_two(dice_between(d, bottom, top)), f64);
        }
    }
    for (i = 0; i < 15; ++i) {
        x[i] = number_fit(x[i], f64);
    }
    if (which == CASE_SPECIAL) {
        int times = dice_between(d, 1, 3);
        while (times-- > 0) {
            x[dice_once_in(d, 3) ? dice_below(d, 9) : dice_between(d, 9, 14)] = special_number(d, f64);
        }
        return;
    }
    if (which != CASE_RANDOM) {
        nudge_some(d, x, f64);
    }
}

/* turns [min, max] into p and size. The size has the given format; what does not come out finite stays as it
 * is. */
static inline void case_as_tri(question *ask, int f64)
{
    int i;
    ask->kind = ASK_TRI;
    for (i = 0; i < 3; ++i) {
        double size = ask->x[12 + i] - ask->x[9 + i];
        if (is_finite(ask->x[12 + i]) && is_finite(ask->x[9 + i])) {
            ask->x[12 + i] = number_fit(size, f64);
        }
    }
}

/* turns [min, max] into a voxel of a grid: a box of about that place and size */
static inline void case_as_grid(dice *d, question *ask)
{
    int i;
    int reach = dice_once_in(d, 4) ? 2000000000 : 40;
    case_as_tri(ask, 1);
    ask->kind = ASK_GRID;
    for (i = 0; i < 3; ++i) {
        int index = dice_between(d, -reach, reach);
        double at = ask->x[9 + i] - (double)index * ask->x[12 + i];
        ask->index[i] = index;
        ask->last[i] = index;
        if (is_finite(at)) {
            ask->x[9 + i] = at;
        } else {
            ask->index[i] = 0;
            ask->last[i] = 0;
        }
    }
}

#endif
