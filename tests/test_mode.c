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
            q->seed = random_state;
            for (a = 0; a < 3; a++) {
                int j;
                for (j = 0; j < 3; j++) {
                    q->t.v[j][a] = random_below(7) - 3;
                }
                q->lo[a] = random_below(5) - 3;
                q->hi[a] = q->lo[a] + 1 + random_below(3);
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

int main(void)
{
    RUN(rounding_up_changes_no_answer);
    RUN(rounding_down_changes_no_answer);
    RUN(rounding_toward_zero_changes_no_answer);
    RUN(flushing_subnormals_changes_no_answer);
    RUN(flushed_subnormals_still_decide);
    RUN(one_flushed_number_still_decides);
    RUN(flushed_faces_differ_by_one_subnormal);
    return test_report("test_mode");
}
