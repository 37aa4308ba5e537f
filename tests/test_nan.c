/* The odd inputs, decided by sets: NaN, infinities, empty and flat boxes, half-spaces, -0.0; for the
 * one-box test, the prepared test and the grid. NaN and infinity are made from bits, so that -ffast-math
 * folds nothing here. */
#include "tribox.h"

#include "question.h"

static double from_bits(uint64_t bits)
{
    double x;

    memcpy(&x, &bits, sizeof x);
    return x;
}

static float float_from_bits(uint32_t bits)
{
    float x;

    memcpy(&x, &bits, sizeof x);
    return x;
}

/* +inf, -inf, a quiet NaN, the same negative, and the least (signalling) NaN */
static double odd_double(int i)
{
    static const uint64_t bits[5] = {0x7FF0000000000000u, 0xFFF0000000000000u, 0x7FF8000000000000u,
                                     0xFFF8000000000001u, 0x7FF0000000000001u};

    return from_bits(bits[i]);
}

static float odd_float(int i)
{
    static const uint32_t bits[5] = {0x7F800000u, 0xFF800000u, 0x7FC00000u, 0xFFC00001u, 0x7F800001u};

    return float_from_bits(bits[i]);
}

/* The same numbers in both types; a number is replaced in both at once. */
typedef struct odd_case {
    double d[18];       /* three corners, min or p, max, size */
    float  f[18];
} odd_case;

enum { CORNERS = 0, LOWER = 9, UPPER = 12, SIZE = 15 };

static void put(odd_case *c, int i, double x)
{
    c->d[i] = x;
    c->f[i] = (float)x;
}

static void put_odd(odd_case *c, int i, int odd)
{
    c->d[i] = odd_double(odd);
    c->f[i] = odd_float(odd);
}

/* A triangle through the middle of the unit box: 1 under every rule, thin included. */
static void plain_case(odd_case *c)
{
    static const double plain[18] = {.25, .25, .5, .75, .25, .5, .25, .75, .625, 0, 0, 0, 1, 1, 1, 1, 1, 1};
    int                 i;

    for (i = 0; i < 18; i++) {
        put(c, i, plain[i]);
    }
}

/* Both types and both spellings must agree; the common answer, or 2. */
static int one_box(const odd_case *c, unsigned flags)
{
    int r = tribox_overlap_rule_f64(c->d, c->d + 3, c->d + 6, c->d + LOWER, c->d + UPPER, flags);
    int same = r == tribox_overlap_rule(c->f, c->f + 3, c->f + 6, c->f + LOWER, c->f + UPPER, flags);

    if (flags == 0) {
        same = same && r == tribox_overlap_f64(c->d, c->d + 3, c->d + 6, c->d + LOWER, c->d + UPPER);
        same = same && r == tribox_overlap(c->f, c->f + 3, c->f + 6, c->f + LOWER, c->f + UPPER);
    }
    return same ? r : 2;
}

static int prepared(const odd_case *c, unsigned flags)
{
    tribox_tri t64;
    tribox_tri t32;
    int        r;

    tribox_tri_init_f64(&t64, c->d, c->d + 3, c->d + 6, c->d + SIZE, flags);
    tribox_tri_init(&t32, c->f, c->f + 3, c->f + 6, c->f + SIZE, flags);
    r = tribox_tri_test_f64(&t64, c->d + LOWER);
    return r == tribox_tri_test(&t64, c->f + LOWER) && r == tribox_tri_test_f64(&t32, c->d + LOWER) &&
           r == tribox_tri_test(&t32, c->f + LOWER) ? r : 2;
}

static int grid_voxel(const odd_case *c, unsigned flags)
{
    tribox_grid grid;
    tribox_mesh mesh;
    uint64_t    bits = 0;
    int         a;
    int         r;

    for (a = 0; a < 3; a++) {
        grid.origin[a] = c->d[LOWER + a];
        grid.size[a] = c->d[SIZE + a];
        grid.lo[a] = 0;
        grid.hi[a] = 1;
    }
    grid.flags = flags;
    mesh.positions = c->f;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    r = (int)tribox_grid_spans_f64(&grid, c->d, c->d + 3, c->d + 6, 0, 0);
    tribox_grid_fill(&grid, &mesh, &bits);
    return r == (int)tribox_grid_spans(&grid, c->f, c->f + 3, c->f + 6, 0, 0) && bits == (uint64_t)r ? r : 2;
}

/* The plain case is 1 everywhere, so the zeros below have a cause. */
static void plain_case_overlaps_everywhere(void)
{
    odd_case c;
    int      k;

    plain_case(&c);
    for (k = 0; k < 4; k++) {
        CHECK(one_box(&c, every_rule[k]) == 1);
        CHECK(prepared(&c, every_rule[k]) == 1);
        CHECK(grid_voxel(&c, every_rule[k]) == 1);
    }
}

/* A triangle with a NaN or infinite corner is no set of points: 0, even for the box that is all of space. */
static void triangle_with_an_odd_corner_is_no_set(void)
{
    int i;
    int odd;
    int k;

    for (i = 0; i < 9; i++) {
        for (odd = 0; odd < 5; odd++) {
            for (k = 0; k < 4; k++) {
                odd_case c;
                int      a;
                plain_case(&c);
                put_odd(&c, CORNERS + i, odd);
                CHECK(one_box(&c, every_rule[k]) == 0);
                CHECK(prepared(&c, every_rule[k]) == 0);
                CHECK(grid_voxel(&c, every_rule[k]) == 0);
                for (a = 0; a < 3; a++) {
                    put_odd(&c, SIZE + a, 0);
                    put_odd(&c, LOWER + a, 1);
                    put_odd(&c, UPPER + a, 0);
                }
                CHECK(one_box(&c, every_rule[k]) == 0);
                for (a = 0; a < 3; a++) {
                    put(&c, LOWER + a, -100);
                }
                CHECK(prepared(&c, every_rule[k]) == 0);
            }
        }
    }
}

/* min > max on any axis is the empty set, by one ulp too, and for a point triangle between the two. */
static void inverted_box_is_empty(void)
{
    int a;
    int k;

    for (a = 0; a < 3; a++) {
        for (k = 0; k < 4; k++) {
            odd_case c;
            int      i;
            plain_case(&c);
            put(&c, LOWER + a, 1);
            put(&c, UPPER + a, 0);
            CHECK(one_box(&c, every_rule[k]) == 0);
            for (i = 0; i < 9; i++) {
                put(&c, CORNERS + i, .5);
            }
            CHECK(one_box(&c, every_rule[k]) == 0);
            put(&c, LOWER + a, (double)nudge_float(.5f, 1));
            put(&c, UPPER + a, .5);
            CHECK(one_box(&c, every_rule[k]) == 0);
            put(&c, LOWER + a, .5);
            CHECK(one_box(&c, every_rule[k]) == (k == 0 || k == 3));
        }
    }
}

/* NaN in any number of the box: 0. */
static void nan_in_the_box_is_empty(void)
{
    int i;
    int odd;
    int k;

    for (i = 0; i < 3; i++) {
        for (odd = 2; odd < 5; odd++) {
            for (k = 0; k < 4; k++) {
                odd_case c;
                plain_case(&c);
                put_odd(&c, LOWER + i, odd);
                CHECK(one_box(&c, every_rule[k]) == 0);
                CHECK(prepared(&c, every_rule[k]) == 0);
                CHECK(grid_voxel(&c, every_rule[k]) == 0);
                plain_case(&c);
                put_odd(&c, UPPER + i, odd);
                CHECK(one_box(&c, every_rule[k]) == 0);
                plain_case(&c);
                put_odd(&c, SIZE + i, odd);
                CHECK(prepared(&c, every_rule[k]) == 0);
                CHECK(grid_voxel(&c, every_rule[k]) == 0);
            }
        }
    }
}

/* An infinite face is a half-space: every choice of infinite faces, against the oracle, on lattice
 * triangles. */
static void infinite_face_is_a_half_space(void)
{
    int i;

    random_seed(51);
    for (i = 0; i < TEST_LOOPS(30000); i++) {
        question q;
        odd_case c;
        unsigned truth;
        int      a;
        int      k;
        q.seed = random_state;
        make_stepped(&q, i & 1 ? LATTICE : TENTHS);
        question_round_to_floats(&q);
        for (a = 0; a < 3; a++) {
            int infinite = random_below(4);
            put(&c, LOWER + a, q.lo[a]);
            put(&c, UPPER + a, q.hi[a]);
            if (infinite & 1) {
                put_odd(&c, LOWER + a, 1);
            }
            if (infinite & 2) {
                put_odd(&c, UPPER + a, 0);
            }
            for (k = 0; k < 3; k++) {
                put(&c, CORNERS + 3 * k + a, q.t.v[k][a]);
            }
        }
        memcpy(q.lo, c.d + LOWER, sizeof q.lo);
        memcpy(q.hi, c.d + UPPER, sizeof q.hi);
        q.has_box = 1;
        q.has_voxel = 0;
        truth = oracle_box(&q.t, q.lo, q.hi);
        for (k = 0; k < 4; k++) {
            unsigned rule = every_rule[k] == TRIBOX_THIN ? 0 : every_rule[k];
            CHECK(question_judge(&q, "half-space", every_rule[k], one_box(&c, every_rule[k]),
                                 oracle_says(truth, rule)));
        }
    }
}

/* All of space holds every triangle under every rule; [inf, inf] and [-inf, -inf] hold no real point. */
static void space_is_full_and_infinity_is_empty(void)
{
    int a;
    int k;

    for (k = 0; k < 4; k++) {
        odd_case c;
        plain_case(&c);
        for (a = 0; a < 3; a++) {
            put_odd(&c, LOWER + a, 1);
            put_odd(&c, UPPER + a, 0);
        }
        CHECK(one_box(&c, every_rule[k]) == 1);
        for (a = 0; a < 9; a++) {
            put(&c, CORNERS + a, a & 1 ? 3.4028234663852886e38 : -3.4028234663852886e38);
        }
        CHECK(one_box(&c, every_rule[k]) == 1);
        for (a = 0; a < 3; a++) {
            put_odd(&c, LOWER + a, 0);
            CHECK(one_box(&c, every_rule[k]) == 0);
            put_odd(&c, LOWER + a, 1);
            put_odd(&c, UPPER + a, 1);
            CHECK(one_box(&c, every_rule[k]) == 0);
            put_odd(&c, LOWER + a, 0);
            CHECK(one_box(&c, every_rule[k]) == 0);
            put_odd(&c, LOWER + a, 1);
            put_odd(&c, UPPER + a, 0);
        }
    }
}

/* A flat box counts when closed and thin, and is empty under the other rules: size 0 is flat. */
static void flat_box_counts_when_closed(void)
{
    int a;
    int k;

    for (a = 0; a < 3; a++) {
        for (k = 0; k < 4; k++) {
            odd_case c;
            int      i;
            plain_case(&c);
            put(&c, LOWER + a, .5);
            put(&c, UPPER + a, .5);
            put(&c, SIZE + a, 0);
            for (i = 0; i < 9; i++) {
                put(&c, CORNERS + i, .5);
            }
            CHECK(one_box(&c, every_rule[k]) == (k == 0 || k == 3));
            CHECK(prepared(&c, every_rule[k]) == (k == 0 || k == 3));
            put(&c, SIZE + a, -0.0);
            CHECK(prepared(&c, every_rule[k]) == (k == 0 || k == 3));
            CHECK(grid_voxel(&c, every_rule[k]) == 0);
        }
    }
}

/* p must be finite, else 0: also at infinity with an infinite size. */
static void infinite_place_is_empty(void)
{
    int a;
    int odd;
    int k;

    for (a = 0; a < 3; a++) {
        for (odd = 0; odd < 2; odd++) {
            for (k = 0; k < 4; k++) {
                odd_case c;
                plain_case(&c);
                put_odd(&c, LOWER + a, odd);
                CHECK(prepared(&c, every_rule[k]) == 0);
                CHECK(grid_voxel(&c, every_rule[k]) == 0);
                put_odd(&c, SIZE + a, 0);
                CHECK(prepared(&c, every_rule[k]) == 0);
                CHECK(grid_voxel(&c, every_rule[k]) == 0);
            }
        }
    }
}

/* size < 0 and -inf are empty, however small; in a grid size must also be finite and not 0. */
static void negative_size_is_empty(void)
{
    int a;
    int k;

    for (a = 0; a < 3; a++) {
        for (k = 0; k < 4; k++) {
            odd_case c;
            plain_case(&c);
            put(&c, SIZE + a, -1);
            CHECK(prepared(&c, every_rule[k]) == 0);
            CHECK(grid_voxel(&c, every_rule[k]) == 0);
            put(&c, SIZE + a, (double)float_from_bits(0x80000001u));
            CHECK(prepared(&c, every_rule[k]) == 0);
            CHECK(grid_voxel(&c, every_rule[k]) == 0);
            put_odd(&c, SIZE + a, 1);
            CHECK(prepared(&c, every_rule[k]) == 0);
            CHECK(grid_voxel(&c, every_rule[k]) == 0);
            put_odd(&c, SIZE + a, 0);
            CHECK(grid_voxel(&c, every_rule[k]) == 0);
        }
    }
}

/* size = +inf is [p, +inf), and thin then answers as conservative: every choice of infinite sizes. */
static void infinite_size_is_a_half_space(void)
{
    static const int zero[3] = {0, 0, 0};
    int              i;

    random_seed(52);
    for (i = 0; i < TEST_LOOPS(30000); i++) {
        question q;
        odd_case c;
        unsigned truth;
        int      infinite = 1 + random_below(7);
        int      a;
        int      k;
        q.seed = random_state;
        make_stepped(&q, i & 1 ? LATTICE : TENTHS);
        question_round_to_floats(&q);
        for (a = 0; a < 3; a++) {
            put(&c, LOWER + a, q.lo[a]);
            put(&c, SIZE + a, random_below(3));
            if (infinite >> a & 1) {
                put_odd(&c, SIZE + a, 0);
            }
            for (k = 0; k < 3; k++) {
                put(&c, CORNERS + 3 * k + a, q.t.v[k][a]);
            }
        }
        memcpy(q.size, c.d + SIZE, sizeof q.size);
        q.has_box = 0;
        q.has_voxel = 1;
        truth = oracle_voxel(&q.t, q.lo, q.size, zero);
        for (k = 0; k < 4; k++) {
            CHECK(question_judge(&q, "infinite size", every_rule[k], prepared(&c, every_rule[k]),
                                 oracle_says(truth, every_rule[k])));
        }
    }
}

/* An infinite size beside an empty one is still empty, and beside a flat one under a strict rule too. */
static void infinite_size_does_not_mend_an_empty_one(void)
{
    int k;

    for (k = 0; k < 4; k++) {
        odd_case c;
        plain_case(&c);
        put_odd(&c, SIZE + 0, 0);
        CHECK(prepared(&c, every_rule[k]) == 1);
        put(&c, SIZE + 1, -1);
        CHECK(prepared(&c, every_rule[k]) == 0);
        put_odd(&c, SIZE + 1, 2);
        CHECK(prepared(&c, every_rule[k]) == 0);
        put(&c, SIZE + 1, 0);
        put(&c, LOWER + 1, .5);
        CHECK(prepared(&c, every_rule[k]) == (k == 0 || k == 3));
    }
}

/* -0.0 is 0.0 in every place: a box from 0 to -0 is flat, not inverted, and corners on it touch. */
static void minus_zero_is_zero(void)
{
    int i;

    random_seed(53);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        odd_case c;
        odd_case m;
        int      k;
        for (k = 0; k < 18; k++) {
            double x = k < SIZE ? random_below(3) - 1 : random_below(2);
            put(&c, k, x);
            put(&m, k, x);
            if (x >= 0 && x <= 0 && random_below(2)) {
                put(&m, k, from_bits(0x8000000000000000u));
            }
        }
        for (k = 0; k < 4; k++) {
            CHECK(one_box(&c, every_rule[k]) == one_box(&m, every_rule[k]));
            CHECK(prepared(&c, every_rule[k]) == prepared(&m, every_rule[k]));
            CHECK(grid_voxel(&c, every_rule[k]) == grid_voxel(&m, every_rule[k]));
        }
    }
}

static void emit_nothing(void *user, int x0, int x1, int y, int z)
{
    (void)x0;
    (void)x1;
    (void)y;
    (void)z;
    ++*(int *)user;
}

static void expect_empty_grid(const tribox_grid *grid)
{
    static const float  f[9] = {.25f, .25f, .5f, .75f, .25f, .5f, .25f, .75f, .625f};
    static const double p[3] = {.5, .5, .5};
    double              d[9];
    tribox_mesh         mesh;
    uint64_t            bits[2] = {0, 0};
    int                 index[3];
    int                 emitted = 0;
    int                 i;

    for (i = 0; i < 9; i++) {
        d[i] = (double)f[i];
    }
    mesh.positions = f;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    CHECK(tribox_grid_spans(grid, f, f + 3, f + 6, emit_nothing, &emitted) == 0);
    CHECK(tribox_grid_spans_f64(grid, d, d + 3, d + 6, emit_nothing, &emitted) == 0);
    CHECK(emitted == 0);
    CHECK(tribox_grid_words(grid) == 0);
    tribox_grid_fill(grid, &mesh, bits);
    CHECK(bits[0] == 0 && bits[1] == 0);
    CHECK(tribox_grid_get(grid, bits, 0, 0, 0) == 0);
    CHECK(tribox_grid_locate(grid, p, index) == 0);
}

/* A grid with a non-finite origin, a non-finite or non-positive size, or an empty region emits nothing. */
static void odd_grid_emits_nothing(void)
{
    int a;
    int k;
    int odd;

    for (a = 0; a < 3; a++) {
        for (k = 0; k < 4; k++) {
            tribox_grid plain = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, 0};
            tribox_grid grid;
            plain.flags = every_rule[k];
            for (odd = 0; odd < 5; odd++) {
                grid = plain;
                grid.origin[a] = odd_double(odd);
                expect_empty_grid(&grid);
                grid = plain;
                grid.size[a] = odd_double(odd);
                expect_empty_grid(&grid);
            }
            grid = plain;
            grid.size[a] = 0;
            expect_empty_grid(&grid);
            grid.size[a] = from_bits(0x8000000000000000u);
            expect_empty_grid(&grid);
            grid.size[a] = -1;
            expect_empty_grid(&grid);
            grid = plain;
            grid.hi[a] = 0;
            expect_empty_grid(&grid);
            grid.hi[a] = -1;
            expect_empty_grid(&grid);
            grid.lo[a] = 2147483647;
            grid.hi[a] = -2147483647 - 1;
            expect_empty_grid(&grid);
        }
    }
}

/* A point with a NaN or infinite coordinate lies in no voxel. */
static void odd_point_lies_in_no_voxel(void)
{
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, 0};
    int               a;
    int               odd;

    for (a = 0; a < 3; a++) {
        for (odd = 0; odd < 5; odd++) {
            double p[3] = {.5, .5, .5};
            int    index[3];
            CHECK(tribox_grid_locate(&grid, p, index) == 1);
            p[a] = odd_double(odd);
            CHECK(tribox_grid_locate(&grid, p, index) == 0);
        }
    }
}

/* Odd triangles in a mesh are skipped; the others are set. */
static void odd_triangles_of_a_mesh_are_skipped(void)
{
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {4, 1, 1}, 0};
    float             f[36];
    tribox_mesh       mesh;
    uint64_t          bits = 0;
    int               i;

    for (i = 0; i < 36; i++) {
        f[i] = i % 3 == 0 ? (float)(i / 9) + .5f : .5f;
    }
    f[9] = odd_float(2);
    f[20] = odd_float(0);
    mesh.positions = f;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 4;
    tribox_grid_fill(&grid, &mesh, &bits);
    CHECK(bits == 9);
}

int main(void)
{
    RUN(plain_case_overlaps_everywhere);
    RUN(triangle_with_an_odd_corner_is_no_set);
    RUN(inverted_box_is_empty);
    RUN(nan_in_the_box_is_empty);
    RUN(infinite_face_is_a_half_space);
    RUN(space_is_full_and_infinity_is_empty);
    RUN(flat_box_counts_when_closed);
    RUN(infinite_place_is_empty);
    RUN(negative_size_is_empty);
    RUN(infinite_size_is_a_half_space);
    RUN(infinite_size_does_not_mend_an_empty_one);
    RUN(minus_zero_is_zero);
    RUN(odd_grid_emits_nothing);
    RUN(odd_point_lies_in_no_voxel);
    RUN(odd_triangles_of_a_mesh_are_skipped);
    return test_report("test_nan");
}
