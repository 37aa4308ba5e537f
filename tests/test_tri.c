/* The prepared triangle: one setup, many boxes [p, p + size], the sum in real numbers. */
#include "tribox.h"

#include <float.h>

#include "question.h"

/* One setup answers at every place, in any order, and from a copy of the struct; the truth is the
 * oracle's. */
static void one_setup_answers_at_many_places(void)
{
    int i;

    random_seed(11);
    for (i = 0; i < TEST_LOOPS(800); i++) {
        static const int      zero[3] = {0, 0, 0};
        static const int      kinds[4] = {LATTICE, TENTHS, UNIFORM, STEEP};
        question              q;
        tribox_tri            tri[4];
        tribox_tri            copy;
        float                 start[3];
        int                   a;
        int                   j;
        int                   k;

        question_make(&q, kinds[i % 4], 1);
        for (a = 0; a < 3; a++) {
            q.size[a] = rounded_to_float(q.size[a]);
        }
        question_from_voxel(&q);
        memcpy(start, q.flo, sizeof start);
        for (k = 0; k < 4; k++) {
            tribox_tri_init(&tri[k], q.ft[0], q.ft[1], q.ft[2], q.fsize, every_rule[k]);
        }
        for (j = 0; j < 27; j++) {
            unsigned truth;
            for (a = 0; a < 3; a++) {
                int step = (a == 0 ? j % 3 : a == 1 ? j / 3 % 3 : j / 9) - 1;
                q.lo[a] = rounded_to_float((double)start[a] + step * (double)q.fsize[a]);
            }
            question_from_voxel(&q);
            truth = oracle_voxel(&q.t, q.lo, q.size, zero);
            for (k = 0; k < 4; k++) {
                int expected = oracle_says(truth, every_rule[k]);
                copy = tri[k];
                CHECK(question_judge(&q, "copy, tribox_tri_test", every_rule[k],
                                     tribox_tri_test(&copy, q.flo), expected));
                CHECK(question_judge(&q, "copy, tribox_tri_test_f64", every_rule[k],
                                     tribox_tri_test_f64(&copy, q.lo), expected));
            }
        }
    }
}

/* A corner between p + size and its rounded sum: the box [p, p + size] does not reach up to where fl(p +
 * size) does, or reaches beyond it. */
static void upper_face_is_the_real_sum(void)
{
    int above = 0;
    int below = 0;
    int i;

    random_seed(12);
    for (i = 0; i < TEST_LOOPS(3000); i++) {
        question q;
        int      a;
        float    p = (float)(random_signed() * 8);
        float    size = (float)((random_signed() + 1.0) * 3);
        volatile float sum = p + size;

        q.seed = random_state;
        for (a = 0; a < 3; a++) {
            q.lo[a] = a == i % 3 ? (double)p : 0.0;
            q.size[a] = a == i % 3 ? (double)size : 1.0;
            q.t.v[0][a] = a == i % 3 ? (double)sum : 0.5;
            q.t.v[1][a] = q.t.v[0][a] + (a == i % 3 ? 1.0 : 0.25);
            q.t.v[2][a] = q.t.v[0][a] + (a == i % 3 ? 2.0 : 0.125);
        }
        question_from_voxel(&q);
        above += (double)sum > (double)p + (double)size;
        below += (double)sum < (double)p + (double)size;
        CHECK(ask_all(&q));
    }
    CHECK(above > 0 && below > 0);
}

/* The same in double, where no wider type holds the sum: 0.1 + 0.2 rounds up, to the number below, which
 * lies outside. */
static void upper_face_is_the_real_sum_in_double(void)
{
    const double sum = 0x1.3333333333334p-2;
    const double size[3] = {0.2, 1, 1};
    const double p[3] = {0.1, 0, 0};
    const double v1[3] = {2, 0.5, 0.5};
    const double v2[3] = {2, 0.25, 0.5};
    double       v0[3] = {0, 0.5, 0.5};
    tribox_tri   tri;

    v0[0] = sum;
    tribox_tri_init_f64(&tri, v0, v1, v2, size, 0);
    CHECK(tribox_tri_test_f64(&tri, p) == 0);
    v0[0] = nudge_double(sum, -1);
    tribox_tri_init_f64(&tri, v0, v1, v2, size, 0);
    CHECK(tribox_tri_test_f64(&tri, p) == 1);
}

/* A size that vanishes in fl(p + size) is still positive: [1, 1 + 2^-149) holds the point 1 and nothing
 * beyond. */
static void vanishing_size_is_not_empty(void)
{
    const float tiny[3] = {1.401298464e-45f, 1.401298464e-45f, 1.401298464e-45f};
    const float p[3] = {1, 1, 1};
    const float at[3] = {1, 1, 1};
    float       next[3] = {1, 1, 1};
    tribox_tri  tri;

    tribox_tri_init(&tri, at, at, at, tiny, TRIBOX_HALF_OPEN);
    CHECK(tribox_tri_test(&tri, p) == 1);
    tribox_tri_init(&tri, at, at, at, tiny, TRIBOX_OPEN);
    CHECK(tribox_tri_test(&tri, p) == 0);
    tribox_tri_init(&tri, at, at, at, tiny, 0);
    CHECK(tribox_tri_test(&tri, p) == 1);
    next[1] = nudge_float(1.0f, 1);
    tribox_tri_init(&tri, next, next, next, tiny, 0);
    CHECK(tribox_tri_test(&tri, p) == 0);
}

/* p + size may exceed the type: [FLT_MAX, 2 FLT_MAX] and [DBL_MAX, 2 DBL_MAX] are boxes like others. */
static void sum_may_exceed_the_type(void)
{
    const float  fmax[3] = {FLT_MAX, FLT_MAX, FLT_MAX};
    const double dmax[3] = {DBL_MAX, DBL_MAX, DBL_MAX};
    const float  fneg[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    const double dneg[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    const float  origin[3] = {0, 0, 0};
    const double dorigin[3] = {0, 0, 0};
    tribox_tri   tri;

    tribox_tri_init(&tri, fmax, origin, origin, fmax, 0);
    CHECK(tribox_tri_test(&tri, fmax) == 1);
    CHECK(tribox_tri_test(&tri, fneg) == 1);
    tribox_tri_init(&tri, fneg, origin, fneg, fmax, TRIBOX_HALF_OPEN);
    CHECK(tribox_tri_test(&tri, fmax) == 0);
    CHECK(tribox_tri_test(&tri, fneg) == 1);
    tribox_tri_init_f64(&tri, dmax, dorigin, dorigin, dmax, 0);
    CHECK(tribox_tri_test_f64(&tri, dmax) == 1);
    CHECK(tribox_tri_test_f64(&tri, dneg) == 1);
    tribox_tri_init_f64(&tri, dneg, dorigin, dneg, dmax, TRIBOX_OPEN);
    CHECK(tribox_tri_test_f64(&tri, dmax) == 0);
    CHECK(tribox_tri_test_f64(&tri, dneg) == 1);
}

/* A float setup is asked at doubles between the floats, and a double setup at floats. */
static void float_setup_answers_double_places(void)
{
    static const int zero[3] = {0, 0, 0};
    int              i;

    random_seed(13);
    for (i = 0; i < TEST_LOOPS(10000); i++) {
        question   q;
        tribox_tri tri;
        unsigned   truth;
        int        a;

        question_make(&q, i & 1 ? TOUCHING : UNIFORM, 1);
        if (!q.has_voxel || !q.size_is_float) {
            continue;
        }
        for (a = 0; a < 3; a++) {
            q.lo[a] = nudge_double(q.lo[a], random_below(7) - 3);
        }
        question_from_voxel(&q);
        truth = oracle_voxel(&q.t, q.lo, q.size, zero);
        tribox_tri_init(&tri, q.ft[0], q.ft[1], q.ft[2], q.fsize, 0);
        CHECK(question_judge(&q, "tribox_tri_init, tribox_tri_test_f64", 0, tribox_tri_test_f64(&tri, q.lo),
                             oracle_says(truth, 0)));
        tribox_tri_init(&tri, q.ft[0], q.ft[1], q.ft[2], q.fsize, TRIBOX_THIN);
        CHECK(question_judge(&q, "tribox_tri_init, tribox_tri_test_f64", TRIBOX_THIN,
                             tribox_tri_test_f64(&tri, q.lo), oracle_says(truth, TRIBOX_THIN)));
    }
}

/* A double triangle beyond the floats: p = FLT_MAX reaches it if the size does, and no float reaches
 * further. */
static void last_float_place_reaches_by_its_size_alone(void)
{
    const double beyond = 2 * (double)FLT_MAX;
    int          a;

    for (a = 0; a < 3; a++) {
        double     t[3] = {0.5, 0.5, 0.5};
        float      p[3] = {0, 0, 0};
        double     size[3] = {1, 1, 1};
        tribox_tri tri;
        t[a] = beyond;
        p[a] = FLT_MAX;
        tribox_tri_init_f64(&tri, t, t, t, size, 0);
        CHECK(tribox_tri_test(&tri, p) == 0);
        size[a] = (double)FLT_MAX;
        tribox_tri_init_f64(&tri, t, t, t, size, 0);
        CHECK(tribox_tri_test(&tri, p) == 1);
        tribox_tri_init_f64(&tri, t, t, t, size, TRIBOX_HALF_OPEN);
        CHECK(tribox_tri_test(&tri, p) == 0);
        t[a] = -beyond;
        p[a] = -FLT_MAX;
        tribox_tri_init_f64(&tri, t, t, t, size, 0);
        CHECK(tribox_tri_test(&tri, p) == 0);
    }
}

static float float_of_bits(uint32_t bits)
{
    float x;

    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The float faces are compared as integers: around each face, around both zeros, the infinities and the ends
 * of the NaNs, a float gets the answer of the same double; NaN and infinity get 0. */
static void faces_hold_for_floats_as_for_doubles(void)
{
    static const double ends[12][2] = {{1, 2},      {-2, -1},   {-1, 2},     {-200, 300},  {0, 1},
                                       {-1, 0},     {0, 0},     {-3, -3},    {1e-40, 1},   {-1, -1e-40},
                                       {1e-40, 2e-40}, {-FLT_MAX, FLT_MAX}};
    static const double sizes[6] = {0, 1, 0.1, 3, 1e-42, 2.9387358770557188e-39};
    static const uint32_t middles[6] = {0, 0x7f800000u, 0x7fffffffu, 0x80000000u, 0xff800000u, 0xffffffffu};
    int i;

    for (i = 0; i < 12 * 6 * 3 * 4; i++) {
        const double *t = ends[i % 12];
        const int     a = i / 72 % 3;
        double        v[3][3] = {{0, 0, 0}, {0.25, 0.5, 1}, {1, 0.25, 0.5}};
        double        size[3] = {1, 1, 1};
        uint32_t      middle[8];
        tribox_tri    tri;
        int           k;
        int           n;

        v[0][a] = v[1][a] = t[0];
        v[2][a] = t[1];
        size[a] = sizes[i / 12 % 6];
        tribox_tri_init_f64(&tri, v[0], v[1], v[2], size, every_rule[i / 216]);
        memcpy(middle, middles, sizeof middles);
        for (k = 0; k < 2; k++) {
            float face = (float)(k == 0 ? t[0] - size[a] : t[1]);
            memcpy(middle + 6 + k, &face, sizeof face);
        }
        for (k = 0; k < 8; k++) {
            for (n = -4; n <= 4; n++) {
                float  f[3] = {0, 0, 0};
                double p[3] = {0, 0, 0};
                int    answer;
                f[a] = float_of_bits(middle[k] + (uint32_t)n);
                answer = tribox_tri_test(&tri, f);
                if (((middle[k] + (uint32_t)n) & 0x7f800000u) == 0x7f800000u) {
                    CHECK(answer == 0);
                } else {
                    tbx_widen(&p[a], &f[a]);
                    CHECK(answer == tribox_tri_test_f64(&tri, p));
                }
            }
        }
    }
}

/* Places so far from the triangle that the filter's bound does not hold there: the face test answers. */
static void far_places_miss(void)
{
    const float v0[3] = {0, 0, 0};
    const float v1[3] = {1, 0.5f, 0.25f};
    const float v2[3] = {0.25f, 1, 0.5f};
    const float size[3] = {0.5f, 0.5f, 0.5f};
    tribox_tri  tri;
    int         a;
    int         e;

    for (a = 0; a < 3; a++) {
        for (e = 3; e < 127; e++) {
            float p[3] = {0, 0, 0};
            tribox_tri_init(&tri, v0, v1, v2, size, e & 1 ? TRIBOX_THIN : 0);
            p[a] = (float)power_of_two(e);
            CHECK(tribox_tri_test(&tri, p) == 0);
            p[a] = -p[a];
            CHECK(tribox_tri_test(&tri, p) == 0);
            p[a] = 0;
            CHECK(tribox_tri_test(&tri, p) == 1 || (e & 1));
        }
    }
}

/* Boxes as large as 2^120 and as small as 2^-120 beside a unit triangle. */
static void box_of_any_size_is_exact(void)
{
    int e;

    random_seed(14);
    for (e = -120; e <= 120; e++) {
        question q;
        int      i;
        for (i = 0; i < 8; i++) {
            int a;
            q.seed = random_state;
            make_uniform(&q);
            question_round_to_floats(&q);
            for (a = 0; a < 3; a++) {
                q.size[a] = power_of_two(e + random_below(3));
                q.size[a] = rounded_to_float((1.0 + random_below(3)) * q.size[a]);
                q.lo[a] = i & 1 ? q.t.v[i % 3][a] : rounded_to_float(q.t.v[i % 3][a] - q.size[a]);
            }
            question_from_voxel(&q);
            CHECK(ask_all(&q));
        }
    }
}

int main(void)
{
    RUN(one_setup_answers_at_many_places);
    RUN(upper_face_is_the_real_sum);
    RUN(upper_face_is_the_real_sum_in_double);
    RUN(vanishing_size_is_not_empty);
    RUN(sum_may_exceed_the_type);
    RUN(float_setup_answers_double_places);
    RUN(last_float_place_reaches_by_its_size_alone);
    RUN(faces_hold_for_floats_as_for_doubles);
    RUN(far_places_miss);
    RUN(box_of_any_size_is_exact);
    return test_report("test_tri");
}
