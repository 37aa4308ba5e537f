/* How far are the filters' values from the exact ones, as a part of their bounds? Hill climbing from random
 * questions, in every rounding mode, against rationals (GMP). What tests/proofs prove from above, this looks
 * at from below: it fails where a value is beyond its bound, and prints the worst that it found.
 *
 *   build/errors [thousands of questions for each line] [seed] */
#include "tribox.h"

#include <fenv.h>
#include <gmp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ONE_BOX, PREPARED, PREPARED_FLOAT, WALK, KINDS };
enum { VALUES = 11 };

static const char *const kind_names[KINDS] = {"one box, double", "prepared, double", "prepared, float",
                                              "grid walk"};

/* v0, v1, v2, then box_min and box_max, or p and size, or origin and size */
typedef struct numbers {
    double x[15];
    int    index[3];    /* of the walk's voxel */
    int    thin;
} numbers;

/* What the header computed. bound 0: no value. */
typedef struct computed {
    double value[VALUES];
    double bound[VALUES];
    double slope[VALUES][3];    /* a prepared condition's scaled normal */
    int    index[3];            /* the voxel asked about */
    tribox_impl_clip clip;
} computed;

static uint64_t random_state = 1;

static uint64_t random_bits(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return random_state * 0x2545f4914f6cdd1du;
}

static int random_below(int n)
{
    return (int)((random_bits() >> 33) % (uint64_t)n);
}

static double random_signed(void)
{
    return (double)(int64_t)random_bits() / 9223372036854775808.0;
}

/* ---- the header's values, in the rounding mode of the moment ------------------------------------------- */

__attribute__((noinline)) static void one_box(computed *r, const numbers *q)
{
    tribox_impl_values values;
    int k;

    if (!tribox_impl_clip_box(&r->clip, q->x, q->x + 3, q->x + 6, q->x + 9, q->x + 12, 0)) {
        return;
    }
    tribox_impl_filter(&values, q->x, q->x + 3, q->x + 6, &r->clip);
    for (k = 0; k < 4 && values.in_range; k++) {
        r->value[k] = values.value[k];
        r->bound[k] = values.bound[k];
    }
}

__attribute__((noinline)) static void prepared(computed *r, const numbers *q, int as_float)
{
    tribox_tri tri;
    double p[3];
    int i;
    int k;

    tribox_tri_init_f64(&tri, q->x, q->x + 3, q->x + 6, q->x + 12, q->thin ? TRIBOX_THIN : 0u);
    for (k = 0; k < 3; k++) {
        p[k] = q->x[9 + k];
        if (tri.empty || p[k] > tri.t_max[k] || tribox_impl_far_face(p[k], tri.size[k], tri.t_min[k]) < 0) {
            return;     /* the bound holds where the faces do */
        }
    }
    for (i = 0; i < VALUES; i++) {
        if (as_float) {
            const float x = (float)p[0] - tri.ref[0];
            const float y = (float)p[1] - tri.ref[1];
            const float z = (float)p[2] - tri.ref[2];
            r->value[i] = (double)(tri.n_x[i] * x + tri.n_y[i] * y + (tri.n_z[i] * z + tri.d[i]));
            r->slope[i][0] = (double)tri.n_x[i];
            r->slope[i][1] = (double)tri.n_y[i];
            r->slope[i][2] = (double)tri.n_z[i];
        } else {
            r->value[i] = tri.n_x_f64[i] * (p[0] - (double)tri.ref[0]) +
                          tri.n_y_f64[i] * (p[1] - (double)tri.ref[1]) +
                          tri.n_z_f64[i] * (p[2] - (double)tri.ref[2]) + tri.d_f64[i];
            r->slope[i][0] = tri.n_x_f64[i];
            r->slope[i][1] = tri.n_y_f64[i];
            r->slope[i][2] = tri.n_z_f64[i];
        }
        for (k = 0; k < 3; k++) {
            r->bound[i] = r->slope[i][k] != 0.0 ? 1.0 : r->bound[i];
        }
    }
}

__attribute__((noinline)) static void walked(computed *r, const numbers *q)
{
    tribox_impl_walk w;
    tribox_grid grid;
    int i;
    int k;

    for (k = 0; k < 3; k++) {
        grid.origin[k] = q->x[9 + k];
        grid.size[k] = q->x[12 + k];
        grid.lo[k] = -1000;
        grid.hi[k] = 1000;
    }
    grid.flags = q->thin ? TRIBOX_THIN : 0u;
    if (!tribox_impl_grid_valid(&grid) || !tribox_impl_walk_start(&w, &grid, q->x, q->x + 3, q->x + 6) ||
        w.on_lattice || !w.in_range) {
        return;
    }
    for (i = 0; i < w.limits; i++) {
        const tribox_impl_limit *c = &w.limit[i];
        int64_t at[3];
        for (k = 0; k < 3; k++) {
            at[k] = q->index[k] % w.count[k];
            r->index[k] = (int)(w.base[k] + at[k]);
        }
        r->value[c->id] = c->a[0] * (double)at[0] + c->a[1] * (double)at[1] + c->a[2] * (double)at[2] + c->d;
        r->bound[c->id] = c->bound;
    }
}

/* ---- the exact values ---------------------------------------------------------------------------------- */

static mpq_t v[3][3], low[3], extent[3], w[3], t, u, sum, largest, n[3], half_n[3];

static void exact_init(void)
{
    int i;

    for (i = 0; i < 9; i++) {
        mpq_init(v[i / 3][i % 3]);
    }
    for (i = 0; i < 3; i++) {
        mpq_inits(low[i], extent[i], w[i], n[i], half_n[i], (void *)0);
    }
    mpq_inits(t, u, sum, largest, (void *)0);
}

/* (v_j - v_i) . k */
static void edge(mpq_t r, int i, int j, int k)
{
    mpq_sub(r, v[j][k], v[i][k]);
}

static void exact_normal(void)
{
    int a;

    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        edge(t, 0, 1, b);
        edge(u, 1, 2, c);
        mpq_mul(n[a], t, u);
        edge(t, 0, 1, c);
        edge(u, 1, 2, b);
        mpq_mul(t, t, u);
        mpq_sub(n[a], n[a], t);
    }
}

/* w of condition id, and sum = w.(centre - v_i) + the support of w: sum |w| h, or max |w| h */
static void exact_condition(int id, int thin)
{
    const int i = id < 9 ? id % 3 : 0;
    int k;

    for (k = 0; k < 3; k++) {
        mpq_set_si(w[k], 0, 1);
    }
    if (id < 9) {
        const int a = id / 3;
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        edge(w[b], i, (i + 1) % 3, c);
        edge(w[c], i, (i + 1) % 3, b);
        mpq_neg(w[mpq_sgn(n[a]) >= 0 ? b : c], w[mpq_sgn(n[a]) >= 0 ? b : c]);
    } else {
        for (k = 0; k < 3; k++) {
            mpq_set(w[k], n[k]);
            if (id == 10) {
                mpq_neg(w[k], w[k]);
            }
        }
    }
    mpq_set_si(sum, 0, 1);
    mpq_set_si(largest, 0, 1);
    for (k = 0; k < 3; k++) {
        mpq_div_2exp(t, extent[k], 1);
        mpq_add(u, low[k], t);
        mpq_sub(u, u, v[i][k]);
        mpq_mul(u, u, w[k]);
        mpq_add(sum, sum, u);
        mpq_mul(t, t, w[k]);
        mpq_abs(t, t);
        if (!thin) {
            mpq_add(sum, sum, t);
        } else if (mpq_cmp(t, largest) > 0) {
            mpq_set(largest, t);
        }
    }
    mpq_add(sum, sum, largest);
}

/* sum = the filter's value k, of the box low, extent: the least of r_i + |n/2| - |n/2 - c_i| with c_i = w_i x
 * w_i+1 about the box's centre, r_i = |e_b| h_c + |e_c| h_b; or |n|.h - |n.(centre - v0)| */
static void exact_one_box(int k)
{
    int i;
    int a;

    for (a = 0; a < 3; a++) {
        mpq_abs(half_n[a], n[a]);
        mpq_div_2exp(half_n[a], half_n[a], 1);
    }
    if (k == 3) {
        mpq_set_si(sum, 0, 1);
        mpq_set_si(largest, 0, 1);
        for (a = 0; a < 3; a++) {
            mpq_mul(t, half_n[a], extent[a]);
            mpq_add(sum, sum, t);
            mpq_div_2exp(t, extent[a], 1);
            mpq_add(t, t, low[a]);
            mpq_sub(t, t, v[0][a]);
            mpq_mul(t, t, n[a]);
            mpq_add(largest, largest, t);
        }
        mpq_abs(largest, largest);
        mpq_sub(sum, sum, largest);
        return;
    }
    for (i = 0; i < 3; i++) {
        const int b = (k + 1) % 3;
        const int c = (k + 2) % 3;
        const int j = (i + 1) % 3;
        mpq_t from[2], to[2], value;
        mpq_inits(from[0], from[1], to[0], to[1], value, (void *)0);
        for (a = 0; a < 2; a++) {
            const int axis = a == 0 ? b : c;
            mpq_div_2exp(t, extent[axis], 1);
            mpq_add(t, t, low[axis]);
            mpq_sub(from[a], v[i][axis], t);
            mpq_sub(to[a], v[j][axis], t);
        }
        mpq_mul(value, from[0], to[1]);
        mpq_mul(t, from[1], to[0]);
        mpq_sub(value, value, t);           /* c_i */
        mpq_div_2exp(t, n[k], 1);
        mpq_sub(value, t, value);
        mpq_abs(value, value);
        mpq_neg(value, value);
        mpq_add(value, value, half_n[k]);
        edge(t, i, j, b);
        mpq_abs(t, t);
        mpq_mul(t, t, extent[c]);
        mpq_div_2exp(t, t, 1);
        mpq_add(value, value, t);
        edge(t, i, j, c);
        mpq_abs(t, t);
        mpq_mul(t, t, extent[b]);
        mpq_div_2exp(t, t, 1);
        mpq_add(value, value, t);
        if (i == 0 || mpq_cmp(value, sum) < 0) {
            mpq_set(sum, value);
        }
        mpq_clears(from[0], from[1], to[0], to[1], value, (void *)0);
    }
}

/* The power of two by which a prepared condition was scaled: its largest slope tells. */
static int scale_exponent(const double slope[3])
{
    int most = 0;
    int k;

    for (k = 1; k < 3; k++) {
        most = fabs(slope[k]) > fabs(slope[most]) ? k : most;
    }
    return (int)lround(log2(fabs(slope[most]) / fabs(mpq_get_d(w[most]))));
}

/* The largest |value - exact| / bound. */
static double worst_part(const computed *r, const numbers *q, int kind)
{
    double worst = 0.0;
    int i;
    int k;

    for (i = 0; i < 9; i++) {
        mpq_set_d(v[i / 3][i % 3], q->x[i]);
    }
    for (k = 0; k < 3; k++) {
        mpq_set_d(low[k], kind == ONE_BOX ? r->clip.lo[k] : q->x[9 + k]);
        mpq_set_d(extent[k], kind == ONE_BOX ? r->clip.hi[k] : q->x[12 + k]);
        if (kind == ONE_BOX) {
            mpq_sub(extent[k], extent[k], low[k]);
        } else if (kind == WALK) {
            mpq_set_si(t, r->index[k], 1);
            mpq_mul(t, t, extent[k]);
            mpq_add(low[k], low[k], t);
        }
    }
    exact_normal();
    for (i = 0; i < VALUES; i++) {
        if (!(r->bound[i] > 0.0)) {
            continue;
        }
        if (kind == ONE_BOX) {
            exact_one_box(i);
        } else {
            exact_condition(i, q->thin);
        }
        if (kind == PREPARED || kind == PREPARED_FLOAT) {
            const int scale = scale_exponent(r->slope[i]);
            if (scale > 0) {
                mpq_mul_2exp(sum, sum, (mp_bitcnt_t)scale);
            } else {
                mpq_div_2exp(sum, sum, (mp_bitcnt_t)-scale);
            }
        }
        mpq_set_d(t, r->value[i]);
        mpq_sub(t, t, sum);
        mpq_set_d(u, r->bound[i]);
        mpq_div(t, t, u);
        worst = fabs(mpq_get_d(t)) > worst ? fabs(mpq_get_d(t)) : worst;
    }
    return worst;
}

static double ask(const numbers *q, int kind, int mode)
{
    computed r;

    memset(&r, 0, sizeof r);
    fesetround(mode);
    if (kind == ONE_BOX) {
        one_box(&r, q);
    } else if (kind == WALK) {
        walked(&r, q);
    } else {
        prepared(&r, q, kind == PREPARED_FLOAT);
    }
    fesetround(FE_TONEAREST);
    return worst_part(&r, q, kind);
}

/* ---- the search ---------------------------------------------------------------------------------------- */

static double any_number(int kind)
{
    const double x = random_signed();
    return kind == PREPARED_FLOAT ? (double)(float)x : x;
}

static void any_question(numbers *q, int kind)
{
    const double far_off = random_below(3) == 0 ? ldexp(random_signed(), random_below(12)) : 0.0;
    int i;

    for (i = 0; i < 15; i++) {
        const double x = any_number(kind) + far_off;
        q->x[i] = kind == PREPARED_FLOAT ? (double)(float)x : x;
    }
    for (i = 0; i < 3; i++) {
        if (kind == ONE_BOX) {
            const double a = q->x[9 + i];
            const double b = q->x[12 + i];
            q->x[9 + i] = a < b ? a : b;
            q->x[12 + i] = a < b ? b : a;
        } else {
            q->x[12 + i] = fabs(any_number(kind)) / (kind == WALK ? 1 << random_below(6) : 1);
        }
        q->index[i] = random_below(1000);
    }
    q->thin = random_below(4) == 0;
}

static void change(numbers *q, int kind)
{
    const int i = random_below(15);
    double x = q->x[i] + random_signed() * ldexp(1.0, -random_below(kind == PREPARED_FLOAT ? 26 : 55));

    x = kind == PREPARED_FLOAT ? (double)(float)x : x;
    q->x[i] = i >= 12 && kind != ONE_BOX ? fabs(x) : x;
    if (random_below(4) == 0) {
        q->index[random_below(3)] = random_below(1000);
    }
}

int main(int argc, char **argv)
{
    static const int modes[4] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    static const char *const mode_names[4] = {"to nearest", "up", "down", "to zero"};
    const long thousands = argc > 1 ? atol(argv[1]) : 40;
    int failed = 0;
    int kind;
    int mode;

    random_state = (argc > 2 ? strtoull(argv[2], NULL, 10) : 1) * 0x9e3779b97f4a7c15u | 1u;
    exact_init();
    for (kind = 0; kind < KINDS; kind++) {
        for (mode = 0; mode < 4; mode++) {
            double worst = 0.0;
            long   done;
            for (done = 0; done < thousands; done++) {
                numbers best;
                double  part = 0.0;
                int     step;
                any_question(&best, kind);
                for (step = 0; step < 1000; step++) {
                    numbers next = best;
                    double  at;
                    if (step > 0) {
                        change(&next, kind);
                    }
                    at = ask(&next, kind, modes[mode]);
                    if (at >= part) {
                        part = at;
                        best = next;
                    }
                }
                worst = part > worst ? part : worst;
            }
            printf("%-18s rounded %-11s worst error %.4f of the bound\n", kind_names[kind], mode_names[mode],
                   worst);
            failed += !(worst > 0.0 && worst <= 1.0);
        }
    }
    printf("%d passed, %d failed\n", 4 * KINDS - failed, failed);
    return failed != 0;
}
