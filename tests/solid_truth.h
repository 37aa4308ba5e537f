/* Exact truth about the solid, by another method than the header's: the point is moved by a real number e, so
 * small that no sign of the unmoved point's can change, and nothing is degenerate then. Whether the projected
 * triangle holds the point is counted in the plane by the edges that a ray there crosses; no orientation, no
 * rule for ties. Numbers are integers in units of the least bit of all inputs, times e^-3. */
#ifndef SOLID_TRUTH_H
#define SOLID_TRUTH_H

#include "oracle.h"

/* x * times as an integer in units of 2^unit */
TEST_FN void solid_number(wide *r, double x, int64_t times, int unit)
{
    oracle_number n = oracle_read(&x);
    wide          a;
    wide          b;

    wide_set(&a, n.sign, n.mantissa, n.sign != 0 ? n.exponent - unit : 0);
    wide_set(&b, times > 0 ? 1 : times < 0 ? -1 : 0, times < 0 ? 0 - (uint64_t)times : (uint64_t)times, 0);
    wide_multiply(r, &a, &b);
}

TEST_FN int solid_bits(const wide *a)
{
    int      bits = 32 * a->count;
    uint32_t top = a->count > 0 ? a->limb[a->count - 1] : 0x80000000u;

    for (; top < 0x80000000u; top *= 2) {
        bits--;
    }
    return bits;
}

/* A triangle and a point moved by (e, e^2, e^3), all in units of 2^unit * e^3. */
typedef struct solid_question {
    wide v[3][3];
    wide p[3];
} solid_question;

/* The point is base + half * step / 2. Coordinates may span up to 200 bits. */
TEST_FN void solid_ask(solid_question *q, double v[3][3], const double base[3], const double step[3],
                       const int64_t half[3])
{
    int  unit = 4096;
    int  most = 1;
    int  e;
    int  i;
    int  k;
    wide a;
    wide b;
    wide one;

    for (k = 0; k < 3; k++) {
        double all[5];
        all[0] = v[0][k];
        all[1] = v[1][k];
        all[2] = v[2][k];
        all[3] = base[k];
        all[4] = step[k];
        for (i = 0; i < 5; i++) {
            oracle_number n = oracle_read(&all[i]);
            unit = n.sign != 0 && n.exponent - (i == 4) < unit ? n.exponent - (i == 4) : unit;
        }
    }
    unit = unit == 4096 ? 0 : unit;
    for (k = 0; k < 3; k++) {
        for (i = 0; i < 3; i++) {
            solid_number(&q->v[i][k], v[i][k], 1, unit);
        }
        solid_number(&a, base[k], 1, unit);
        solid_number(&b, step[k], half[k], unit + 1);
        wide_add(&q->p[k], &a, &b);
        for (i = 0; i < 4; i++) {
            int bits = solid_bits(i < 3 ? &q->v[i][k] : &q->p[k]);
            most = bits > most ? bits : most;
        }
    }
    e = 3 * most + 8; /* e = 2^-e: n.v < 2^(3 most + 6), and e^2, e^3 are as much below e, e^2 */
    for (k = 0; k < 3; k++) {
        for (i = 0; i < 4; i++) {
            wide *x = i < 3 ? &q->v[i][k] : &q->p[k];
            wide_set(&one, 1, 1, 3 * e);
            wide_multiply(&a, x, &one);
            wide_copy(x, &a);
        }
        wide_set(&one, 1, 1, (2 - k) * e);
        wide_add(&q->p[k], &q->p[k], &one);
    }
}

/* The sign of (b - a) x (p - a) in the plane of axes y, z. */
TEST_FN void solid_cross(wide *r, const wide a[3], const wide b[3], const wide p[3], int y, int z)
{
    wide d;
    wide t;
    wide product;

    wide_subtract(&d, &b[y], &a[y]);
    wide_subtract(&t, &p[z], &a[z]);
    wide_multiply(r, &d, &t);
    wide_subtract(&d, &b[z], &a[z]);
    wide_subtract(&t, &p[y], &a[y]);
    wide_multiply(&product, &d, &t);
    wide_subtract(r, r, &product);
}

TEST_FN int solid_crosses(double v[3][3], const double base[3], const double step[3], const int64_t half[3])
{
    static solid_question q;
    wide                  r;
    wide                  n;
    wide                  d;
    wide                  sum;
    int                   within = 0;
    int                   n_x = 0;
    int                   i;
    int                   k;

    for (i = 0; i < 9; i++) {
        if (!oracle_is_finite(&v[i / 3][i % 3])) {
            return 0;
        }
    }
    solid_ask(&q, v, base, step, half);
    for (i = 0; i < 3; i++) { /* edges that the ray from (y, z) toward -y crosses */
        const wide *a = q.v[i];
        const wide *b = q.v[(i + 1) % 3];
        int         a_below = wide_compare(&a[2], &q.p[2]) < 0;
        int         b_below = wide_compare(&b[2], &q.p[2]) < 0;
        if (a_below != b_below) { /* the edge's y is below p's: (b - a) x (p - a) < 0 for an edge going up */
            solid_cross(&r, a, b, q.p, 1, 2);
            within ^= (r.sign < 0) == a_below;
        }
    }
    wide_set(&sum, 0, 0, 0);
    for (k = 0; k < 3; k++) {
        solid_cross(&n, q.v[0], q.v[1], q.v[2], (k + 1) % 3, (k + 2) % 3);
        wide_subtract(&d, &q.p[k], &q.v[0][k]);
        wide_multiply(&r, &n, &d);
        wide_add(&sum, &sum, &r);
        n_x = k == 0 ? n.sign : n_x;
    }
    return within && n_x * sum.sign > 0;
}

#endif /* SOLID_TRUTH_H */
