/* The processor's floating-point modes change no answer: rounding directions, subnormals flushed to zero.
 * Questions and truths are made in the default mode; only the header runs in the other. */
#include "tribox.h"

#include <fenv.h>

#include "question.h"

/* Sets flush-to-zero and denormals-are-zero, or restores them; 0 where this file does not know how. */
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__SSE__))
static int flush_subnormals(int on)
{
    unsigned mode;

    __asm__ __volatile__("stmxcsr %0" : "=m"(mode));
    mode = on ? mode | 0x8040u : mode & ~0x8040u;
    __asm__ __volatile__("ldmxcsr %0" : : "m"(mode) : "memory");
    return 1;
}
#elif defined(__GNUC__) && defined(__aarch64__)
static int flush_subnormals(int on)
{
    uint64_t mode;

    __asm__ __volatile__("mrs %0, fpcr" : "=r"(mode));
    mode = on ? mode | (uint64_t)1 << 24 : mode & ~((uint64_t)1 << 24);
    __asm__ __volatile__("msr fpcr, %0" : : "r"(mode) : "memory");
    return 1;
}
#else
static int flush_subnormals(int on)
{
    (void)on;
    return 0;
}
#endif

enum { MODE_QUESTIONS = 64 };

/* Batches of questions made in the default mode, asked in the mode that `enter` sets. */
static void ask_in_mode(int (*enter)(int on), int mode, int count)
{
    static question batch[MODE_QUESTIONS];
    int             done;

    for (done = 0; done < count; done += MODE_QUESTIONS) {
        int bad = 0;
        int i;
        for (i = 0; i < MODE_QUESTIONS; i++) {
            question_make(&batch[i], i % QUESTION_KINDS, i / QUESTION_KINDS & 1);
        }
        enter(mode);
        for (i = 0; i < MODE_QUESTIONS; i++) {
            bad += !ask_all(&batch[i]);
        }
        enter(0);
        CHECK(bad == 0);
    }
}

static int enter_rounding(int mode)
{
    switch (mode) {
#ifdef FE_UPWARD
    case 1:  return fesetround(FE_UPWARD) == 0;
#endif
#ifdef FE_DOWNWARD
    case 2:  return fesetround(FE_DOWNWARD) == 0;
#endif
#ifdef FE_TOWARDZERO
    case 3:  return fesetround(FE_TOWARDZERO) == 0;
#endif
    default: return mode == 0 && fesetround(FE_TONEAREST) == 0;
    }
}

static void ask_in_rounding(int mode)
{
    int known = enter_rounding(mode);

    enter_rounding(0);
    if (!known) {
        printf("SKIP: no rounding mode %d here\n", mode);
        return;
    }
    random_seed(60 + (uint64_t)mode);
    ask_in_mode(enter_rounding, mode, TEST_LOOPS(20000));
}

/* The filter's bound is twice that of round-to-nearest, so it holds for sums and products rounded up, */
static void rounding_up_changes_no_answer(void)
{
    ask_in_rounding(1);
}

/* rounded down, */
static void rounding_down_changes_no_answer(void)
{
    ask_in_rounding(2);
}

/* and cut off. */
static void rounding_toward_zero_changes_no_answer(void)
{
    ask_in_rounding(3);
}

/* Pairs where plain float arithmetic errs most, in one mode or another: the value that the float filter
 * compares is on the wrong side of zero by more than 2.56 of the units that its bound has 256 of. Found by
 * hill climbing, from random corners v0, v1, v2, box_min, box_max. */
static void worst_float_errors_change_no_answer(void)
{
    static const float worst[16][15] = {
        {0x1.00ecbp-1f, -0x1.6d9894p-3f, 0x1.24012ep+0f, 0x1.6d1a52p+0f, 0x1.774d72p-3f,
         0x1.f97206p-5f, 0x1.51c7bcp-3f, 0x1.768b72p-3f, 0x1.013df2p-4f, -0x1.8c42cap+1f,
         -0x1.4e317ep+1f, -0x1.267c58p-1f, 0x1.8fb894p+1f, 0x1.49d6bep-3f, 0x1.05f3f8p-3f},
        {0x1.4008fep+0f, -0x1.867dbep+2f, 0x1.9796eep-1f, -0x1.832cd2p-4f, -0x1.2165d4p-2f,
         -0x1.4cb444p-3f, -0x1.832f44p-4f, -0x1.21638ap-2f, 0x1.5c1636p+0f, -0x1.67ed8ap-4f,
         -0x1.3edfeep-2f, -0x1.823cc2p+2f, 0x1.4eed4cp+2f, 0x1.12f23ep-1f, 0x1.14461cp+2f},
        {0x1.4f4ed2p-1f, 0x1.67efa6p-4f, 0x1.ecf836p-1f, 0x1.d3138ap-4f, 0x1.ccaa12p-3f,
         -0x1.1fffbep-2f, 0x1.825f6ap-4f, 0x1.d7325p-3f, 0x1.e9bc2ap-2f, -0x1.778aeap+1f,
         0x1.c65488p-4f, -0x1.d239ccp+0f, 0x1.e65846p-4f, 0x1.ca3914p-3f, 0x1.cbefb8p-2f},
        {0x1.2f63dp-1f, 0x1.8a1292p-1f, -0x1.1a84dap+1f, 0x1.3fb236p-5f, -0x1.6b1532p-1f,
         -0x1.0d51e8p+1f, -0x1.0b3742p-7f, -0x1.023d64p-6f, 0x1.bfe79ep-4f, 0x1.e6dca4p-6f,
         -0x1.fdc3fap-4f, -0x1.2c8ccp-5f, 0x1.bba772p-2f, 0x1.e84a8ap-2f, 0x1.f368p+0f},
        {0x1.6acb92p-2f, -0x1.1f9d76p+0f, -0x1.eb048ap-2f, 0x1.067008p+1f, -0x1.378724p+0f,
         0x1.167552p-1f, 0x1.1865a4p+1f, 0x1.354328p-3f, -0x1.262242p-1f, 0x1.a3fa94p-2f,
         0x1.354328p-3f, -0x1.8b0caap-1f, 0x1.c44568p+3f, 0x1.6d748p+3f, 0x1.3df036p+5f},
        {-0x1.402328p+0f, 0x1.62bbccp-1f, 0x1.309dbap-1f, 0x1.ef64fep+0f, 0x1.5f9988p-1f,
         -0x1.858f2cp-2f, -0x1.0b1072p-3f, 0x1.4f57a4p-3f, -0x1.ab0b9p-2f, -0x1.256594p+0f,
         -0x1.2144d8p-1f, -0x1.5ca4e2p-2f, 0x1.231cd8p+0f, 0x1.a152b6p-3f, 0x1.2aee58p-1f},
        {-0x1.fe47d2p-2f, -0x1.454ab2p+2f, -0x1.bf022ap-6f, -0x1.45df84p-4f, 0x1.13387ep-5f,
         0x1.345d6cp-4f, -0x1.45df68p-4f, 0x1.1332dcp-5f, -0x1.b98776p-1f, -0x1.b9fd5cp+2f,
         0x1.13333p-5f, -0x1.3fb7e4p+1f, 0x1.af8c52p-3f, 0x1.438ccp-3f, -0x1.9d7bp-1f},
        {-0x1.474666p-2f, -0x1.108c64p+1f, 0x1.c9dddcp+0f, -0x1.4f2c1ap-4f, 0x1.d14p-3f,
         -0x1.abce68p-1f, -0x1.bbc5dcp+1f, 0x1.a10cbcp-3f, -0x1.9e639ap-1f, -0x1.770448p-1f,
         -0x1.b4cebep-4f, -0x1.daf61ep-2f, 0x1.c98034p-1f, 0x1.7cb192p-4f, 0x1.2a9dd6p+0f},
        {-0x1.c798ccp-2f, -0x1.3cf3f2p-1f, 0x1.766b02p-3f, 0x1.97b602p-3f, 0x1.771b6ap-2f,
         -0x1.8e8fcep-1f, 0x1.a027c8p-3f, 0x1.7a5658p-2f, 0x1.766c0cp-3f, 0x1.f3cb64p-5f,
         -0x1.663d5cp+2f, -0x1.32ba64p+0f, 0x1.365d1ep-2f, 0x1.3885e8p-3f, 0x1.52c8c2p-2f},
        {-0x1.f1f3dcp+0f, 0x1.2d26d4p-1f, -0x1.00e57ap+0f, 0x1.dffa7ep-4f, -0x1.d95acp-5f,
         0x1.644856p-4f, 0x1.7b40d6p-3f, -0x1.43ec8p-4f, -0x1.15fc54p+2f, 0x1.c8f6c2p-4f,
         -0x1.caefdep-5f, -0x1.518f9p+0f, 0x1.dd33fp-1f, 0x1.ee340ep-2f, 0x1.b35ce4p-2f},
        {-0x1.1a473cp+2f, 0x1.096086p-1f, -0x1.c3c43cp+0f, 0x1.c580dep+0f, 0x1.c3b7bap+2f,
         0x1.223d62p-1f, 0x1.c6a3ap+0f, -0x1.5ba4bp+1f, 0x1.2318bap-1f, 0x1.bb2d02p+0f,
         0x1.2a5474p-1f, -0x1.b82b44p+0f, 0x1.06ae7cp+2f, 0x1.8eb626p+0f, 0x1.1a732p-1f},
        {-0x1.b64e18p-3f, -0x1.1e1ff4p-1f, -0x1.8b013p-5f, -0x1.efcb7ep-3f, -0x1.2fef2ap-9f,
         -0x1.42b54cp-4f, 0x1.b04b3cp-2f, -0x1.290bcp-5f, 0x1.49d15cp-1f, 0x1.25901ap-2f,
         -0x1.0217c8p+1f, -0x1.6513ecp+0f, 0x1.54ce1p-1f, -0x1.5dcfcp-5f, 0x1.fca48ap-2f},
        {-0x1.460ac4p+2f, -0x1.26fec4p+3f, -0x1.9bfbf4p-2f, 0x1.9ca6e6p-4f, 0x1.7076bcp-4f,
         0x1.d8bb8ep+2f, 0x1.5db4eep+1f, 0x1.f30058p+0f, -0x1.971ebcp-3f, -0x1.d734b2p+2f,
         -0x1.80b402p-4f, -0x1.000adep-4f, 0x1.37be5p+0f, 0x1.13ed5cp-5f, 0x1.e58f06p-3f},
        {-0x1.1a6f92p-4f, -0x1.0fa7b8p+1f, 0x1.c9b938p+0f, -0x1.109e62p-4f, 0x1.d13cep-3f,
         -0x1.abd5dcp-1f, -0x1.1e7214p+0f, 0x1.a111c2p-3f, -0x1.9e4ea8p-1f, -0x1.c3104ep-1f,
         -0x1.b467c2p-4f, -0x1.d9f472p-2f, 0x1.b230eep-1f, 0x1.61d242p-2f, -0x1.52897ep-8f},
        {0x1.16d4b6p+3f, -0x1.183b5ap+2f, -0x1.7b56f4p+2f, -0x1.902864p-3f, 0x1.2418f4p-4f,
         -0x1.ca70d8p-3f, -0x1.1821p-3f, 0x1.f27ap-5f, -0x1.f637ap-1f, 0x1.b1d7bep-7f,
         -0x1.d80404p-7f, -0x1.2ee46ep+1f, 0x1.98d6bcp-1f, 0x1.a2475cp-1f, 0x1.43b97cp-5f},
        {-0x1.f17338p-2f, -0x1.fb61f4p-5f, 0x1.6a8384p-7f, 0x1.7a6f54p-1f, 0x1.1e0e7ap-3f,
         -0x1.25344cp-2f, -0x1.1aaf84p-3f, -0x1.914336p-5f, 0x1.eae096p-1f, 0x1.c3d9e6p-2f,
         -0x1.1157fep+1f, -0x1.241c7ep-2f, 0x1.ed14e4p+2f, 0x1.5a1bc6p-4f, -0x1.218294p-4f},
    };
    int mode;
    int i;
    int j;

    for (i = 0; i < 16; i++) {
        question q;
        q.seed = 0;
        for (j = 0; j < 15; j++) {
            *(j < 9 ? &q.t.v[j / 3][j % 3] : j < 12 ? &q.lo[j - 9] : &q.hi[j - 12]) = (double)worst[i][j];
        }
        question_from_box(&q);
        for (mode = 0; mode < 4; mode++) {
            int ok;
            enter_rounding(mode);
            ok = ask_all(&q);
            enter_rounding(0);
            CHECK(ok);
        }
    }
}

/* Questions of all kinds with subnormals read and written as zero. */
static void flushing_subnormals_changes_no_answer(void)
{
    if (!flush_subnormals(0)) {
        printf("SKIP: no flush-to-zero here\n");
        return;
    }
    random_seed(64);
    ask_in_mode(flush_subnormals, 1, TEST_LOOPS(20000));
}

/* A lattice question times a power of two per axis, subnormal as a float in all numbers or in some. */
static void make_subnormal(question *q, int as_float)
{
    int least = as_float ? -149 : -1074;
    int a;

    q->seed = random_state;
    make_stepped(q, LATTICE);
    for (a = 0; a < 3; a++) {
        double scale = power_of_two(least + (random_below(2) ? 0 : random_below(30)));
        int    i;
        for (i = 0; i < 3; i++) {
            q->t.v[i][a] *= scale;
        }
        q->lo[a] *= scale;
        q->hi[a] *= scale;
    }
    if (random_below(2)) {
        question_walk(q, as_float);
    }
    question_from_box(q);
}

/* Subnormal faces, corners and sizes decide by their bits: 2^-149 is not 0, and a box of that size is not
 * empty. */
static void flushed_subnormals_still_decide(void)
{
    static question batch[MODE_QUESTIONS];
    int             done;

    if (!flush_subnormals(0)) {
        printf("SKIP: no flush-to-zero here\n");
        return;
    }
    random_seed(65);
    for (done = 0; done < TEST_LOOPS(20000); done += MODE_QUESTIONS) {
        int bad = 0;
        int i;
        for (i = 0; i < MODE_QUESTIONS; i++) {
            make_subnormal(&batch[i], i & 1);
        }
        flush_subnormals(1);
        for (i = 0; i < MODE_QUESTIONS; i++) {
            bad += !ask_all(&batch[i]);
        }
        flush_subnormals(0);
        CHECK(bad == 0);
    }
}

/* One number alone that the processor reads as zero, in each of a question's fifteen places, is noticed:
 * the float filter looks at every argument, whatever the others are. */
static void one_flushed_number_still_decides(void)
{
    static question batch[15];
    int             round;

    if (!flush_subnormals(0)) {
        printf("SKIP: no flush-to-zero here\n");
        return;
    }
    random_seed(66);
    for (round = 0; round < TEST_LOOPS(400); round++) {
        int bad = 0;
        int i;
        for (i = 0; i < 15; i++) {
            question *q = &batch[i];
            double   *number = i < 9 ? &q->t.v[i / 3][i % 3] : i < 12 ? &q->lo[i - 9] : &q->hi[i - 12];
            int       a;
            int       up = i >= 12 || (i < 9 && random_below(2));
            q->seed = random_state;
            for (a = 0; a < 3; a++) {
                int j;
                for (j = 0; j < 3; j++) {   /* on the number's axis the triangle begins where the box ends */
                    q->t.v[j][a] = a != i % 3 ? random_below(7) - 3 : (up ? 1 : -1) * random_below(3);
                }
                q->lo[a] = a != i % 3 ? -1 - random_below(4) : up ? -3 : 0;
                q->hi[a] = a != i % 3 ? 1 + random_below(4) : up ? 0 : 3;
            }
            *number = (random_below(2) ? 1 : -1) * power_of_two(-127 - random_below(22));
            question_from_box(q);
        }
        flush_subnormals(1);
        for (i = 0; i < 15; i++) {
            bad += !ask_all(&batch[i]);
        }
        flush_subnormals(0);
        CHECK(bad == 0);
    }
}

/* Where a number may be read as zero, long boxes are still cut to the triangle: their own centre would be too
 * far off for the filter's bound. */
static void long_boxes_are_cut_where_numbers_flush(void)
{
    int i;

    if (!flush_subnormals(0)) {
        printf("SKIP: no flush-to-zero here\n");
        return;
    }
    random_seed(67);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        double       v[3][3];
        double       lo[3];
        double       hi[3];
        volatile int answer[2];
        int          a;
        for (a = 0; a < 9; a++) {
            v[a / 3][a % 3] = random_below(2000) * 0.001 - 1;
        }
        v[0][i % 3] = power_of_two(-1060);
        for (a = 0; a < 3; a++) {
            lo[a] = -1e15 - random_below(1000);
            hi[a] = random_below(1600) * 0.001 - 0.8;
        }
        answer[0] = tribox_overlap_f64(v[0], v[1], v[2], lo, hi);
        flush_subnormals(1);
        answer[1] = tribox_overlap_f64(v[0], v[1], v[2], lo, hi);
        flush_subnormals(0);
        CHECK(answer[0] == answer[1]);
    }
}

/* Equality of faces one subnormal apart: the point 2^-149 lies on the face of [2^-149, 1], and 0 does not. */
static void flushed_faces_differ_by_one_subnormal(void)
{
    const float  tiny = 1.401298464e-45f;
    float        lo[3];
    const float  hi[3] = {1, 1, 1};
    float        at[3];
    const float  zero[3] = {0, 0, 0};
    volatile int answer[4];
    int          i;

    for (i = 0; i < 3; i++) {
        lo[i] = tiny;
        at[i] = tiny;
    }
    if (!flush_subnormals(1)) {
        printf("SKIP: no flush-to-zero here\n");
        return;
    }
    answer[0] = tribox_overlap(at, at, at, lo, hi);
    answer[1] = tribox_overlap(zero, zero, zero, lo, hi);
    answer[2] = tribox_overlap_rule(zero, zero, zero, zero, lo, TRIBOX_HALF_OPEN);
    answer[3] = tribox_overlap_rule(at, at, at, zero, lo, TRIBOX_HALF_OPEN);
    flush_subnormals(0);
    CHECK(answer[0] == 1);
    CHECK(answer[1] == 0);
    CHECK(answer[2] == 1);
    CHECK(answer[3] == 0);
}

/* A corner that is subnormal lies beyond the centre at 0, also where it is read as zero. */
static void flushed_corners_end_behind_the_centre(void)
{
    static const float v[9] = {-0.25f, -1, 0, -0.25f, 0, -1, -0.25f, 0, 2};
    static const uint32_t tiny = 0x00012345u;
    int k;

    for (k = 0; k < 3; k++) {
        static float positions[9 * 16];
        tribox_grid grid = {{-0.5, -0.5, -0.5}, {1, 1, 1}, {0, 0, 0}, {4, 4, 4}, 0};
        tribox_mesh mesh;
        uint64_t bits[16] = {0};
        memcpy(positions, v, sizeof v);
        memcpy(positions + 4, &tiny, k != 1 ? sizeof tiny : 0);
        memcpy(positions + 7, &tiny, k != 1 ? sizeof tiny : 0);
        mesh.positions = positions;
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = 16;
        flush_subnormals(k == 2);
        tribox_grid_fill_solid(&grid, &mesh, bits);
        flush_subnormals(0);
        CHECK(bits[0] == (k != 1 ? 15u : 0u) && bits[4] == bits[0]);
    }
}

/* Where the difference of two corners is read as zero, the prepared test still knows that they differ. */
static void flushed_extents_are_extents(void)
{
    const double m = power_of_two(-1022);
    int          i;

    random_seed(68);
    for (i = 0; i < TEST_LOOPS(2000); i++) {
        double     v[3][3];
        double     size[3] = {m, 1, 1};
        double     p[3];
        tribox_tri tri;
        int        answer[2];
        int        mode;
        int        j;
        for (j = 0; j < 3; j++) {
            v[j][0] = m * (1 + 0.25 * random_below(4));
            v[j][1] = random_below(9) / 4.0;
            v[j][2] = random_below(9) / 4.0;
        }
        p[0] = m * (random_below(9) / 4.0 - 0.25);
        p[1] = random_below(9) / 4.0 - 0.5;
        p[2] = random_below(9) / 4.0 - 0.5;
        for (mode = 0; mode < 2; mode++) {
            flush_subnormals(mode);
            tribox_tri_init_f64(&tri, v[0], v[1], v[2], size, TRIBOX_HALF_OPEN);
            answer[mode] = tribox_tri_test_f64(&tri, p);
            flush_subnormals(0);
        }
        CHECK(answer[0] == answer[1]);
    }
}

/* Meshes of decimals on a grid of decimals, with corners that may be read as zero, on the plane at 0. */
static void flushed_corners_of_decimals(void)
{
    static float positions[9 * 64];
    int          i;

    random_seed(69);
    for (i = 0; i < TEST_LOOPS(400); i++) {
        const tribox_grid grid = {{0, 0, 0}, {0.1, 0.1, 0.1}, {-8, -8, -8}, {8, 8, 8}, every_rule[random_below(4)]};
        tribox_mesh       mesh;
        uint64_t          bits[2][256];
        int               mode;
        int               j;
        for (j = 0; j < 9 * 64; j++) {
            const float tiny = (float)((random_below(2) ? 1 : -1) * power_of_two(-130));
            const int   from = j % 9 < 3 ? random_below(9) - 4 : (int)(10 * (double)positions[j - 3]);
            const int   whole = from + (j % 9 < 3 ? 0 : random_below(5) - 2);
            positions[j] = whole == 0 && random_below(2) ? tiny : (float)(whole / 10.0);
        }
        mesh.positions = positions;
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = 64;
        memset(bits, 0, sizeof bits);
        for (mode = 0; mode < 2; mode++) {
            flush_subnormals(mode);
            tribox_grid_fill(&grid, &mesh, bits[mode]);
            flush_subnormals(0);
        }
        CHECK(memcmp(bits[0], bits[1], sizeof bits[0]) == 0);
    }
}

int main(void)
{
    RUN(rounding_up_changes_no_answer);
    RUN(rounding_down_changes_no_answer);
    RUN(rounding_toward_zero_changes_no_answer);
    RUN(worst_float_errors_change_no_answer);
    RUN(flushing_subnormals_changes_no_answer);
    RUN(flushed_subnormals_still_decide);
    RUN(one_flushed_number_still_decides);
    RUN(long_boxes_are_cut_where_numbers_flush);
    RUN(flushed_faces_differ_by_one_subnormal);
    RUN(flushed_corners_end_behind_the_centre);
    RUN(flushed_extents_are_extents);
    RUN(flushed_corners_of_decimals);
    return test_report("test_mode");
}
