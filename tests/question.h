/* A question: one triangle and one box, to be asked of every entry of the header that can express it, and the
 * generators of hard questions. Include "tribox.h" first. */
#ifndef QUESTION_H
#define QUESTION_H

#include "oracle.h"
#include "test.h"

/* ---- random numbers (SplitMix64) ----------------------------------------------------------------------- */

/* One call per expression: compilers differ in the order of evaluation, and a seed should mean one
 * question. */
static uint64_t random_state;

static inline void random_seed(uint64_t seed)
{
    random_state = seed;
}

static inline uint64_t random_bits(void)
{
    uint64_t z = (random_state += 0x9E3779B97F4A7C15u);

    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* 0 .. n-1 */
static inline int random_below(int n)
{
    return (int)(random_bits() >> 33) % n;
}

/* [-1, 1) */
static inline double random_signed(void)
{
    return (double)(int64_t)(random_bits() & 0xFFFFFFFFFFFFFu) / 2251799813685248.0 - 1.0;
}

/* ---- floats by their bits ------------------------------------------------------------------------------ */

TEST_FN double power_of_two(int e)
{
    double r = 1.0;

    for (; e > 0; e--) {
        r *= 2.0;
    }
    for (; e < 0; e++) {
        r *= 0.5;
    }
    return r;
}

/* Rounded to float. Volatile: gcc 12 -O2 drops the pair of conversions on neighbouring array elements. */
TEST_FN double rounded_to_float(double x)
{
    volatile float f = (float)x;

    return (double)f;
}

/* The float `steps` places above x in the order of floats; -0 and +0 are one place apart. */
TEST_FN float nudge_float(float x, int steps)
{
    uint32_t bits;
    int32_t  key;

    memcpy(&bits, &x, sizeof bits);
    key = bits >> 31 ? -(int32_t)(bits & 0x7FFFFFFFu) - 1 : (int32_t)bits;
    key += steps;
    bits = key < 0 ? (uint32_t)(-(key + 1)) | 0x80000000u : (uint32_t)key;
    memcpy(&x, &bits, sizeof x);
    return x;
}

TEST_FN double nudge_double(double x, int steps)
{
    uint64_t bits;
    int64_t  key;

    memcpy(&bits, &x, sizeof bits);
    key = bits >> 63 ? -(int64_t)(bits & 0x7FFFFFFFFFFFFFFFu) - 1 : (int64_t)bits;
    key += steps;
    bits = key < 0 ? (uint64_t)(-(key + 1)) | (uint64_t)1 << 63 : (uint64_t)key;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The rules, one flag value each. */
static const unsigned every_rule[4] = {0, TRIBOX_HALF_OPEN, TRIBOX_OPEN, TRIBOX_THIN};

/* The type of all numbers of a question. */
enum { DOUBLES, FLOATS };

/* ---- the question -------------------------------------------------------------------------------------- */

typedef struct question {
    triangle t;
    double   lo[3];
    double   hi[3];         /* the one-box form, if has_box */
    double   size[3];       /* the voxel form, if has_voxel */
    int      has_box;
    int      has_voxel;
    uint64_t seed;

    /* the same as floats, where they are floats; filled before any test changes the floating-point mode */
    float    ft[3][3];
    float    flo[3];
    float    fhi[3];
    float    fsize[3];
    int      triangle_is_float;
    int      lo_is_float;
    int      hi_is_float;
    int      size_is_float;
} question;

/* Are all numbers floats? Compared by bits, so that a start with subnormals flushed (-Ofast) finds them to
 * be none. */
TEST_FN int to_floats(float *out, const double *x, int count)
{
    int same = 1;
    int i;

    for (i = 0; i < count; i++) {
        volatile float f = x[i] > 3.4028234663852886e38 || x[i] < -3.4028234663852886e38 ? 0.0f : (float)x[i];
        double         back = (double)f;
        out[i] = f;
        same = same && oracle_is_finite(&x[i]) && memcmp(&back, &x[i], sizeof back) == 0;
    }
    return same;
}

TEST_FN void question_floats(question *q)
{
    float all[9];
    int   i;

    q->triangle_is_float = to_floats(all, &q->t.v[0][0], 9);
    for (i = 0; i < 9; i++) {
        q->ft[i / 3][i % 3] = all[i];
    }
    q->lo_is_float = to_floats(q->flo, q->lo, 3);
    q->hi_is_float = q->has_box && to_floats(q->fhi, q->hi, 3);
    q->size_is_float = q->has_voxel && to_floats(q->fsize, q->size, 3);
}

/* From t, lo and hi; the voxel form is added where hi - lo is a double exactly. */
TEST_FN void question_from_box(question *q)
{
    int a;

    q->has_box = 1;
    q->has_voxel = 1;
    for (a = 0; a < 3; a++) {
        q->size[a] = q->hi[a] - q->lo[a];
        q->has_voxel = q->has_voxel && oracle_sum_is(&q->lo[a], &q->size[a], &q->hi[a]);
    }
    question_floats(q);
}

/* From t, lo and size; the one-box form is added where lo + size is a double exactly. */
TEST_FN void question_from_voxel(question *q)
{
    int a;

    q->has_box = 1;
    q->has_voxel = 1;
    for (a = 0; a < 3; a++) {
        q->hi[a] = q->lo[a] + q->size[a];
        q->has_box = q->has_box && oracle_sum_is(&q->lo[a], &q->size[a], &q->hi[a]);
    }
    question_floats(q);
}

TEST_FN unsigned question_truth(const question *q)
{
    static const int zero[3] = {0, 0, 0};

    return q->has_voxel ? oracle_voxel(&q->t, q->lo, q->size, zero) : oracle_box(&q->t, q->lo, q->hi);
}

TEST_FN void question_print(const question *q, const char *entry, unsigned flags, int truth)
{
    int i;

    printf("  %s, flags %u, truth %d, seed %llu\n  {", entry, flags, truth, (unsigned long long)q->seed);
    for (i = 0; i < 9; i++) {
        printf("%a%s", q->t.v[i / 3][i % 3], i == 8 ? "}\n" : i % 3 == 2 ? "} {" : ", ");
    }
    printf("  lo {%a, %a, %a}", q->lo[0], q->lo[1], q->lo[2]);
    if (q->has_box) {
        printf(" hi {%a, %a, %a}", q->hi[0], q->hi[1], q->hi[2]);
    }
    if (q->has_voxel) {
        printf(" size {%a, %a, %a}", q->size[0], q->size[1], q->size[2]);
    }
    printf("\n");
}

TEST_FN int question_judge(const question *q, const char *entry, unsigned flags, int answer, int truth)
{
    if (answer != truth && test_wants_details()) {
        question_print(q, entry, flags, truth);
    }
    return answer == truth;
}

/* Every one-box entry against `truth`, the answer under the rule in flags. */
TEST_FN int ask_box(const question *q, unsigned flags, int truth)
{
    const double (*d)[3] = (const double (*)[3])q->t.v;
    const float  (*f)[3] = (const float (*)[3])q->ft;
    int            ok = 1;
    int            r;

    if (!q->has_box) {
        return 1;
    }
    r = tribox_overlap_rule_f64(d[0], d[1], d[2], q->lo, q->hi, flags);
    ok &= question_judge(q, "tribox_overlap_rule_f64", flags, r, truth);
    if (flags == 0) {
        r = tribox_overlap_f64(d[0], d[1], d[2], q->lo, q->hi);
        ok &= question_judge(q, "tribox_overlap_f64", flags, r, truth);
    }
    if (!q->triangle_is_float || !q->lo_is_float || !q->hi_is_float) {
        return ok;
    }
    r = tribox_overlap_rule(f[0], f[1], f[2], q->flo, q->fhi, flags);
    ok &= question_judge(q, "tribox_overlap_rule", flags, r, truth);
    if (flags == 0) {
        r = tribox_overlap(f[0], f[1], f[2], q->flo, q->fhi);
        ok &= question_judge(q, "tribox_overlap", flags, r, truth);
    }
    return ok;
}

/* Every pair of prepared entries: float and double init, float and double test. */
TEST_FN int ask_tri(const question *q, unsigned flags, int truth)
{
    const double (*d)[3] = (const double (*)[3])q->t.v;
    const float  (*f)[3] = (const float (*)[3])q->ft;
    tribox_tri     tri;
    int            ok = 1;
    int            r;

    if (!q->has_voxel) {
        return 1;
    }
    tribox_tri_init_f64(&tri, d[0], d[1], d[2], q->size, flags);
    r = tribox_tri_test_f64(&tri, q->lo);
    ok &= question_judge(q, "tribox_tri_init_f64, tribox_tri_test_f64", flags, r, truth);
    if (q->lo_is_float) {
        r = tribox_tri_test(&tri, q->flo);
        ok &= question_judge(q, "tribox_tri_init_f64, tribox_tri_test", flags, r, truth);
    }
    if (!q->triangle_is_float || !q->size_is_float) {
        return ok;
    }
    tribox_tri_init(&tri, f[0], f[1], f[2], q->fsize, flags);
    r = tribox_tri_test_f64(&tri, q->lo);
    ok &= question_judge(q, "tribox_tri_init, tribox_tri_test_f64", flags, r, truth);
    if (q->lo_is_float) {
        r = tribox_tri_test(&tri, q->flo);
        ok &= question_judge(q, "tribox_tri_init, tribox_tri_test", flags, r, truth);
    }
    return ok;
}

TEST_FN int question_has_grid(const question *q)
{
    int a;
    int ok = q->has_voxel;

    for (a = 0; a < 3; a++) {
        ok = ok && oracle_is_finite(&q->size[a]) && oracle_read(&q->size[a]).sign > 0;
    }
    return ok;
}

/* The voxel as the only one of a grid. */
TEST_FN int ask_grid(const question *q, unsigned flags, int truth)
{
    const double (*d)[3] = (const double (*)[3])q->t.v;
    const float  (*f)[3] = (const float (*)[3])q->ft;
    tribox_grid    grid;
    tribox_mesh    mesh;
    uint64_t       bits = 0;
    int            ok = 1;
    int            a;
    int            r;

    if (!question_has_grid(q)) {
        return 1;
    }
    for (a = 0; a < 3; a++) {
        grid.origin[a] = q->lo[a];
        grid.size[a] = q->size[a];
        grid.lo[a] = 0;
        grid.hi[a] = 1;
    }
    grid.flags = flags;
    r = (int)tribox_grid_spans_f64(&grid, d[0], d[1], d[2], 0, 0);
    ok &= question_judge(q, "tribox_grid_spans_f64", flags, r, truth);
    if (!q->triangle_is_float) {
        return ok;
    }
    r = (int)tribox_grid_spans(&grid, f[0], f[1], f[2], 0, 0);
    ok &= question_judge(q, "tribox_grid_spans", flags, r, truth);
    mesh.positions = f[0];
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    tribox_grid_fill(&grid, &mesh, &bits);
    ok &= question_judge(q, "tribox_grid_fill", flags, tribox_grid_get(&grid, &bits, 0, 0, 0), truth);
    ok &= question_judge(q, "tribox_grid_fill, padding", flags, bits >> 1 == 0, 1);
    return ok;
}

/* All entries, under every rule. One-box entries read TRIBOX_THIN as closed. */
TEST_FN int ask_all(const question *q)
{
    unsigned              truth = question_truth(q);
    int                   ok = 1;
    int                   i;

    for (i = 0; i < 4; i++) {
        unsigned flags = every_rule[i];
        ok &= ask_box(q, flags, oracle_says(truth, flags == TRIBOX_THIN ? 0 : flags));
        ok &= ask_tri(q, flags, oracle_says(truth, flags));
        ok &= ask_grid(q, flags, oracle_says(truth, flags));
    }
    return ok;
}

/* ---- generators ---------------------------------------------------------------------------------------- */

enum question_kind {
    LATTICE,        /* small integers: many exact touches */
    TENTHS,         /* multiples of 0.1 */
    THIRDS,         /* multiples of 1/3 */
    FAR_TENTHS,     /* 1e4 + multiples of 0.1 */
    UNIFORM,        /* random numbers, box near the triangle, not cubic */
    SLIVER,         /* third corner within ulps of the line of the others */
    STEEP,          /* nearly parallel to an axis: a component of the normal is noise */
    DEGENERATE,     /* segments and points, exactly */
    TOUCHING,       /* a corner, edge or face of the box through a point of the triangle, rounded */
    MISMATCH,       /* triangle and box of sizes 1e6 apart */
    SKEWED,         /* touching, each axis scaled by a power of two: flat in one direction or two */
    STRETCHED,      /* a lattice question, each axis scaled by a power of two */
    ALIGNED,        /* walls, floors and 45-degree triangles on the lattice */
    MIXED,          /* numbers of many exponents in one question */
    QUESTION_KINDS
};

/* Integers times a step, the product rounded as a user's program would. */
TEST_FN double stepped(int kind, int i)
{
    switch (kind) {
    case TENTHS:     return i / 10.0;
    case THIRDS:     return i / 3.0;
    case FAR_TENTHS: return 1e4 + 0.1 * i;
    default:         return i;
    }
}

TEST_FN void make_stepped(question *q, int kind)
{
    int n = 3 + random_below(6);
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        int lo = random_below(n);
        for (i = 0; i < 3; i++) {
            q->t.v[i][a] = stepped(kind, random_below(n));
        }
        q->lo[a] = stepped(kind, lo);
        q->hi[a] = stepped(kind, lo + random_below(4));
    }
}

TEST_FN void make_uniform(question *q)
{
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        double size = random_below(2) ? 0.5 : 0.05;
        size *= random_signed() + 1.0;
        for (i = 0; i < 3; i++) {
            q->t.v[i][a] = random_signed();
        }
        q->lo[a] = (q->t.v[0][a] + q->t.v[1][a] + q->t.v[2][a]) / 3 + random_signed() * 0.3 - size * 0.5;
        q->hi[a] = q->lo[a] + size;
    }
}

TEST_FN void make_sliver(question *q)
{
    double s = random_signed();
    int    a;

    make_uniform(q);
    for (a = 0; a < 3; a++) {
        q->t.v[2][a] = q->t.v[0][a] + s * (q->t.v[1][a] - q->t.v[0][a]);
    }
}

TEST_FN void make_steep(question *q)
{
    int    a = random_below(3);
    double s = random_signed();
    int    i;

    make_uniform(q);
    for (i = 1; i < 3; i++) {
        int b = (a + i) % 3;
        q->t.v[2][b] = q->t.v[0][b] + s * (q->t.v[1][b] - q->t.v[0][b]);
    }
}

TEST_FN void make_degenerate(question *q)
{
    int a;

    make_stepped(q, random_below(3));
    switch (random_below(3)) {
    case 0:
        for (a = 0; a < 3; a++) {
            q->t.v[2][a] = q->t.v[random_below(2) ? 0 : 1][a];
        }
        break;
    case 1:
        for (a = 0; a < 3; a++) {
            q->t.v[1][a] = q->t.v[2][a] = q->t.v[0][a];
        }
        break;
    default:
        for (a = 0; a < 3; a++) {
            int step = random_below(7) - 3;
            int from = random_below(8);
            q->t.v[0][a] = from;
            q->t.v[1][a] = from + step;
            q->t.v[2][a] = from + 3 * step;
        }
        break;
    }
}

TEST_FN void make_touching(question *q)
{
    int    kind = random_below(4);
    double w0 = kind == 0 ? 1.0 : kind == 1 ? 0.5 : kind == 2 ? 0.25 : (random_signed() + 1.0) * 0.5;
    double w1 = kind == 0 ? 0.0 : kind == 3 ? (1.0 - w0) * (random_signed() + 1.0) * 0.5 : 0.5;
    int    a;

    make_uniform(q);
    if (random_below(2)) {
        make_stepped(q, random_below(4));
    }
    for (a = 0; a < 3; a++) {
        double size = q->hi[a] - q->lo[a];
        double x = w0 * q->t.v[0][a] + w1 * q->t.v[1][a] + (1.0 - w0 - w1) * q->t.v[2][a];
        switch (random_below(3)) {
        case 0:  q->lo[a] = x;              q->hi[a] = x + size;       break;
        case 1:  q->lo[a] = x - size;       q->hi[a] = x;              break;
        default: q->lo[a] = x - size * 0.5; q->hi[a] = x + size * 0.5; break;
        }
    }
}

TEST_FN void make_mismatch(question *q)
{
    double scale = random_below(2) ? 1e6 : 1e-6;
    int    a;
    int    i;

    make_touching(q);
    for (a = 0; a < 3; a++) {
        double x = q->lo[a];
        for (i = 0; i < 3; i++) {
            q->t.v[i][a] = x + (q->t.v[i][a] - x) * scale;
        }
    }
}

/* One axis much longer than another, within ulps of touching: each condition has an error bound of its own
 * size. */
TEST_FN void make_skewed(question *q)
{
    int a;

    make_touching(q);
    for (a = 0; a < 3; a++) {
        double scale = power_of_two(random_below(41) - 20);
        int    i;
        for (i = 0; i < 3; i++) {
            q->t.v[i][a] *= scale;
        }
        q->lo[a] *= scale;
        q->hi[a] *= scale;
    }
}

/* Truth is kept by the scaling, so the exponents may be extreme: subnormals to 2^100 as floats, to 2^1000
 * as doubles. */
TEST_FN void make_stretched(question *q, int as_float)
{
    static const int float_base[4] = {-149, -126, -60, 100};
    static const int double_base[4] = {-1074, -1022, -500, 1000};
    int              base = as_float ? float_base[random_below(4)] : double_base[random_below(4)];
    int              a;
    int              i;

    make_stepped(q, LATTICE);
    for (a = 0; a < 3; a++) {
        double scale = power_of_two(base + random_below(12));
        for (i = 0; i < 3; i++) {
            q->t.v[i][a] *= scale;
        }
        q->lo[a] *= scale;
        q->hi[a] *= scale;
    }
}

TEST_FN void make_aligned(question *q)
{
    int flat = random_below(3);
    int i;

    make_stepped(q, random_below(3));
    for (i = 1; i < 3; i++) {
        q->t.v[i][flat] = random_below(3) ? q->t.v[0][flat] : q->t.v[i][(flat + 1) % 3];
    }
    if (random_below(2)) {
        q->t.v[1][(flat + 1) % 3] = q->t.v[0][(flat + 1) % 3];
        q->t.v[2][(flat + 2) % 3] = q->t.v[0][(flat + 2) % 3];
    }
}

/* A sign and mantissa at random, times a power of two between -range and range. */
TEST_FN double random_of_range(int range)
{
    double x = random_signed();

    return x * power_of_two(random_below(2 * range) - range);
}

TEST_FN void make_mixed(question *q, int as_float)
{
    int range = random_below(4) ? 20 : as_float ? 120 : random_below(4) ? 200 : 1000;
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        double x;
        double y;
        for (i = 0; i < 3; i++) {
            q->t.v[i][a] = random_of_range(range);
        }
        x = random_of_range(range);
        y = random_below(3) ? q->t.v[random_below(3)][a] : random_of_range(range);
        q->lo[a] = x < y ? x : y;
        q->hi[a] = x < y ? y : x;
    }
}

TEST_FN double nudge(double x, int steps, int as_float)
{
    return as_float ? (double)nudge_float((float)x, steps) : nudge_double(x, steps);
}

/* A few numbers of the question, each moved by up to three ulps. */
TEST_FN void question_walk(question *q, int as_float)
{
    int moves = random_below(4);

    for (; moves > 0; moves--) {
        int steps = random_below(7) - 3;
        int which = random_below(15);
        if (which < 9) {
            q->t.v[which / 3][which % 3] = nudge(q->t.v[which / 3][which % 3], steps, as_float);
        } else if (which < 12) {
            q->lo[which - 9] = nudge(q->lo[which - 9], steps, as_float);
        } else {
            q->hi[which - 12] = nudge(q->hi[which - 12], steps, as_float);
        }
    }
}

TEST_FN void question_round_to_floats(question *q)
{
    int a;
    int i;

    for (a = 0; a < 3; a++) {
        for (i = 0; i < 3; i++) {
            q->t.v[i][a] = rounded_to_float(q->t.v[i][a]);
        }
        q->lo[a] = rounded_to_float(q->lo[a]);
        q->hi[a] = rounded_to_float(q->hi[a]);
    }
}

/* One hard question of a kind, all numbers floats if as_float; half of them as a box, half as a voxel
 * whose upper face may be no double. */
TEST_FN void question_make(question *q, int kind, int as_float)
{
    int a;

    q->seed = random_state;
    switch (kind) {
    case UNIFORM:    make_uniform(q); break;
    case SLIVER:     make_sliver(q); break;
    case STEEP:      make_steep(q); break;
    case DEGENERATE: make_degenerate(q); break;
    case TOUCHING:   make_touching(q); break;
    case MISMATCH:   make_mismatch(q); break;
    case SKEWED:     make_skewed(q); break;
    case STRETCHED:  make_stretched(q, as_float); break;
    case ALIGNED:    make_aligned(q); break;
    case MIXED:      make_mixed(q, as_float); break;
    default:         make_stepped(q, kind); break;
    }
    if (as_float) {
        question_round_to_floats(q);
    }
    if (random_below(2)) {
        question_walk(q, as_float);
    }
    if (random_below(2)) {
        question_from_box(q);
        return;
    }
    for (a = 0; a < 3; a++) {
        q->size[a] = q->hi[a] - q->lo[a];
        if (as_float) {
            q->size[a] = rounded_to_float(q->size[a]);
        }
    }
    question_from_voxel(q);
}

#endif /* QUESTION_H */
