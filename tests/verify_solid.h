/* The solid with GMP: does the ray from a point toward -x cross a triangle? The point is moved by (e, e^2, e^3),
 * e a positive infinitesimal: every sign asked is that of a polynomial in e, its first coefficient that is not 0.
 *
 */
#ifndef VERIFY_SOLID_H
#define VERIFY_SOLID_H

#include "verify_exact.h"

typedef struct crossing_judge {
    mpz_t v[9];
    mpz_t p[3];
    mpz_t n;
    mpz_t a;
    mpz_t b;
    mpz_t sum;
} crossing_judge;

static inline void crossing_init(crossing_judge *j)
{
    int i;
    for (i = 0; i < 9; ++i) {
        mpz_init(j->v[i]);
    }
    for (i = 0; i < 3; ++i) {
        mpz_init(j->p[i]);
    }
    mpz_init(j->n);
    mpz_init(j->a);
    mpz_init(j->b);
    mpz_init(j->sum);
}

/* out = (y1 - y0) * (z2 - z0) - (z1 - z0) * (y2 - y0) */
static inline void crossing_turn(crossing_judge *j, mpz_t out, mpz_t y0, mpz_t z0, mpz_t y1, mpz_t z1, mpz_t y2, mpz_t z2)
{
    mpz_sub(j->a, y1, y0);
    mpz_sub(j->b, z2, z0);
    mpz_mul(out, j->a, j->b);
    mpz_sub(j->a, z1, z0);
    mpz_sub(j->b, y2, y0);
    mpz_submul(out, j->a, j->b);
}

/* the point is base + half * step / 2 */
static inline int crossing_crosses(crossing_judge *j, const double v[9], const double base[3],
                                      const double step[3], const int64_t half[3])
{
    enum { SCALE = -1075 };
    int n_x, beyond, i, k;
    for (i = 0; i < 9; ++i) {
        if (!is_finite(v[i])) {
            return 0;
        }
        set_scaled(j->v[i], v[i], SCALE);
    }
    for (k = 0; k < 3; ++k) {
        set_scaled(j->p[k], base[k], SCALE);
        set_scaled(j->a, step[k], SCALE + 1);
        mpz_set_si(j->b, (long)half[k]);
        mpz_addmul(j->p[k], j->a, j->b);
    }
    crossing_turn(j, j->n, j->v[1], j->v[2], j->v[4], j->v[5], j->v[7], j->v[8]);
    n_x = mpz_sgn(j->n);
    for (i = 0; i < 3; ++i) {
        const int a = 3 * i;
        const int b = 3 * ((i + 1) % 3);
        int side;
        crossing_turn(j, j->n, j->v[a + 1], j->v[a + 2], j->v[b + 1], j->v[b + 2], j->p[1], j->p[2]);
        side = mpz_sgn(j->n);
        side = side != 0 ? side : mpz_cmp(j->v[a + 2], j->v[b + 2]);     /* e^2 */
        side = side != 0 ? side : mpz_cmp(j->v[b + 1], j->v[a + 1]);     /* e^3 */
        if (n_x == 0 || (side > 0) != (n_x > 0)) {
            return 0;
        }
    }
    mpz_set_ui(j->sum, 0);
    for (k = 0; k < 3; ++k) {
        const int b = (k + 1) % 3;
        const int c = (k + 2) % 3;
        crossing_turn(j, j->n, j->v[b], j->v[c], j->v[3 + b], j->v[3 + c], j->v[6 + b], j->v[6 + c]);
        mpz_sub(j->a, j->p[k], j->v[k]);
        mpz_addmul(j->sum, j->n, j->a);
    }
    beyond = mpz_sgn(j->sum);
    return beyond == 0 || (beyond > 0) == (n_x > 0);
}

/* the first voxel of lo..lo + n - 1 in a row, whose y and z are in half, from which the triangle is crossed; n if
 * there is none */
static inline int crossing_first(crossing_judge *j, const double v[9], const double base[3], const double step[3],
                                    int64_t half[3], int lo, int n)
{
    int first = 0, end = n;
    while (first < end) {
        const int at = first + (end - first) / 2;
        half[0] = 2 * (int64_t)(lo + at) + 1;
        if (crossing_crosses(j, v, base, step, half)) {
            end = at;
        } else {
            first = at + 1;
        }
    }
    return first;
}

#endif /* VERIFY_SOLID_H */
