/* The oracle itself, against a second method: the separating axes in plain integers, written out here for
 * small lattices, and a box shrunk by 1/4096 for the touching rules. */
#include "oracle.h"

#include "test.h"

enum {
    SHRINK = 4096
}; /* conditions are integers and change by at most 96 e: at e = 1/4096 none skips a tie */

typedef struct small_case {
    int v[3][3];
    int lo[3];
    int hi[3];
} small_case;

static uint32_t small_state = 1;

static int small_below(int n)
{
    small_state = small_state * 1664525u + 1013904223u;
    return (int)(small_state >> 16) % n;
}

static int axis_separates(const long v[3][3], const long lo[3], const long hi[3], const long axis[3])
{
    long t_min = 0;
    long t_max = 0;
    long b_min = 0;
    long b_max = 0;
    int  a;
    int  i;

    for (i = 0; i < 3; i++) {
        long d = 0;
        for (a = 0; a < 3; a++) {
            d += v[i][a] * axis[a];
        }
        t_min = i == 0 || d < t_min ? d : t_min;
        t_max = i == 0 || d > t_max ? d : t_max;
    }
    for (a = 0; a < 3; a++) {
        b_min += axis[a] * (axis[a] > 0 ? lo[a] : hi[a]);
        b_max += axis[a] * (axis[a] > 0 ? hi[a] : lo[a]);
    }
    return t_max < b_min || t_min > b_max;
}

/* Thirteen axes, the axes in lattice units (<= 32), the points in units of 1/SHRINK (<= 2^15): no product
 * overflows a 32-bit long. */
static int axes_meet(const small_case *c, int shrink_lo, int shrink_hi)
{
    long v[3][3];
    long lo[3];
    long hi[3];
    int  e[3][3];
    long axis[3];
    int  a;
    int  i;

    for (a = 0; a < 3; a++) {
        lo[a] = (long)c->lo[a] * SHRINK + shrink_lo;
        hi[a] = (long)c->hi[a] * SHRINK - shrink_hi;
        for (i = 0; i < 3; i++) {
            v[i][a] = (long)c->v[i][a] * SHRINK;
            e[i][a] = c->v[(i + 1) % 3][a] - c->v[i][a];
        }
        if (lo[a] > hi[a]) {
            return 0;
        }
    }
    for (a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        int d = (a + 2) % 3;
        axis[a] = 1;
        axis[b] = axis[d] = 0;
        if (axis_separates((const long (*)[3])v, lo, hi, axis)) {
            return 0;
        }
        for (i = 0; i < 3; i++) {
            axis[a] = 0;
            axis[b] = -e[i][d];
            axis[d] = e[i][b];
            if (axis_separates((const long (*)[3])v, lo, hi, axis)) {
                return 0;
            }
        }
    }
    for (a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        int d = (a + 2) % 3;
        axis[a] = (long)e[0][b] * e[1][d] - (long)e[0][d] * e[1][b];
    }
    return !axis_separates((const long (*)[3])v, lo, hi, axis);
}

/* The definition of thin as it is written: supports max |n_a| h_a, all doubled. */
static int thin_by_formula(const small_case *c)
{
    int  e[3][3];
    long n[3];
    long distance = 0;
    long support = 0;
    int  a;
    int  i;

    for (a = 0; a < 3; a++) {
        for (i = 0; i < 3; i++) {
            e[i][a] = c->v[(i + 1) % 3][a] - c->v[i][a];
        }
    }
    for (a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        int d = (a + 2) % 3;
        n[a] = (long)e[0][b] * e[1][d] - (long)e[0][d] * e[1][b];
    }
    for (a = 0; a < 3; a++) {
        int  b = (a + 1) % 3;
        int  d = (a + 2) % 3;
        long s = (n[a] < 0 ? -n[a] : n[a]) * (c->hi[a] - c->lo[a]);
        int  t_min = c->v[0][a];
        int  t_max = c->v[0][a];
        support = s > support ? s : support;
        distance += n[a] * (c->lo[a] + c->hi[a] - 2 * c->v[0][a]);
        for (i = 0; i < 3; i++) {
            int w_b = n[a] >= 0 ? -e[i][d] : e[i][d];
            int w_d = n[a] >= 0 ? e[i][b] : -e[i][b];
            int s_b = (w_b < 0 ? -w_b : w_b) * (c->hi[b] - c->lo[b]);
            int s_d = (w_d < 0 ? -w_d : w_d) * (c->hi[d] - c->lo[d]);
            int at =
                w_b * (c->lo[b] + c->hi[b] - 2 * c->v[i][b]) + w_d * (c->lo[d] + c->hi[d] - 2 * c->v[i][d]);
            if (at + (s_b > s_d ? s_b : s_d) < 0) {
                return 0;
            }
            t_min = c->v[i][a] < t_min ? c->v[i][a] : t_min;
            t_max = c->v[i][a] > t_max ? c->v[i][a] : t_max;
        }
        if (t_min > c->hi[a] || t_max < c->lo[a] || c->lo[a] > c->hi[a]) {
            return 0;
        }
    }
    return distance <= support && -distance <= support;
}

static void small_case_make(small_case *c, int n)
{
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        for (i = 0; i < 3; i++) {
            c->v[i][a] = small_below(n);
        }
        c->lo[a] = small_below(n);
        c->hi[a] = c->lo[a] + small_below(3);
    }
}

static unsigned small_case_oracle(const small_case *c)
{
    static const int zero[3] = {0, 0, 0};
    triangle         t;
    double           lo[3];
    double           size[3];
    int              a;
    int              i;

    for (a = 0; a < 3; a++) {
        for (i = 0; i < 3; i++) {
            t.v[i][a] = c->v[i][a];
        }
        lo[a] = c->lo[a];
        size[a] = c->hi[a] - c->lo[a];
    }
    return oracle_voxel(&t, lo, size, zero);
}

/* The candidate points of the oracle and the thirteen axes are two proofs of one answer; all dimensions of
 * triangle and box occur on a lattice of 2 to 5 points a side. */
static void oracle_agrees_with_integer_axes(void)
{
    int i;

    for (i = 0; i < TEST_LOOPS(100000); i++) {
        small_case c;
        unsigned   answers;

        small_case_make(&c, 2 + i % 4);
        answers = small_case_oracle(&c);
        CHECK(oracle_says(answers, 0) == axes_meet(&c, 0, 0));
        CHECK(oracle_says(answers, 1) == axes_meet(&c, 0, 1));
        CHECK(oracle_says(answers, 2) == axes_meet(&c, 1, 1));
    }
}

/* Octahedron and diamonds are another reading of the supports max |n_a| h_a. */
static void oracle_agrees_with_the_thin_formula(void)
{
    int i;

    for (i = 0; i < TEST_LOOPS(100000); i++) {
        small_case c;

        small_case_make(&c, 2 + i % 4);
        CHECK(oracle_says(small_case_oracle(&c), 4) == thin_by_formula(&c));
    }
}

/* A run of ones of any sign, length and place. */
static void small_wide(wide *r)
{
    int      sign = small_below(2) ? 1 : -1;
    uint64_t mantissa = (uint64_t)0xFFFFFFFFFFFFFFFFu >> small_below(60);

    wide_set(r, sign, mantissa, small_below(1000));
}

/* (a+b)(a-b) = a*a - b*b at many lengths and signs: carries, borrows and partial products. */
static void wide_integers_obey_the_square_rule(void)
{
    int i;

    for (i = 0; i < 2000; i++) {
        wide a;
        wide b;
        wide sum;
        wide difference;
        wide left;
        wide a2;
        wide b2;

        small_wide(&a);
        small_wide(&b);
        wide_add(&sum, &a, &b);
        wide_subtract(&difference, &a, &b);
        wide_multiply(&left, &sum, &difference);
        wide_multiply(&a2, &a, &a);
        wide_multiply(&b2, &b, &b);
        wide_subtract(&a2, &a2, &b2);
        CHECK(wide_compare(&left, &a2) == 0);
    }
}

/* A sum is exact only if no bit is lost: 1e4 + 0.1 is not, 0.5 + 0.25 is, nor is 2^53 + 1. */
static void oracle_tells_exact_sums(void)
{
    const double far_sum[3] = {1e4, 0.1, 1e4 + 0.1};
    const double sum[3] = {0.5, 0.25, 0.75};
    const double odd_sum[3] = {9007199254740992.0, 1.0, 9007199254740992.0 + 1.0};

    CHECK(!oracle_sum_is(&far_sum[0], &far_sum[1], &far_sum[2]));
    CHECK(oracle_sum_is(&sum[0], &sum[1], &sum[2]));
    CHECK(!oracle_sum_is(&odd_sum[0], &odd_sum[1], &odd_sum[2]));
}

int main(void)
{
    RUN(oracle_agrees_with_integer_axes);
    RUN(oracle_agrees_with_the_thin_formula);
    RUN(wide_integers_obey_the_square_rule);
    RUN(oracle_tells_exact_sums);
    return test_report("test_oracle");
}
