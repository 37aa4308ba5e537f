/* The reference, Akenine-Moller's test in plain float: right where no rounding happens, wrong within
 * rounding of touching. */
#include "tribox.h"

#include "question.h"

static int ask_sat(const question *q)
{
    const float (*f)[3] = (const float (*)[3])q->ft;

    return tribox_sat(f[0], f[1], f[2], q->flo, q->fhi);
}

/* On small integers centres are halves and all products are exact: the reference gives the truth,
 * degenerate triangles and flat boxes included. */
static void reference_is_exact_on_small_integers(void)
{
    int i;

    random_seed(1);
    for (i = 0; i < TEST_LOOPS(50000); i++) {
        question q;
        q.seed = random_state;
        make_stepped(&q, LATTICE);
        question_from_box(&q);
        CHECK(question_judge(&q, "tribox_sat", 0, ask_sat(&q), oracle_says(question_truth(&q), 0)));
    }
}

/* Where boxes a thousandth smaller and larger have the same answer, rounding of 2^-24 cannot change it. */
static void reference_is_right_away_from_touching(void)
{
    int clear = 0;
    int i;

    random_seed(2);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        question q;
        question smaller;
        question larger;
        int      truth;
        int      a;

        q.seed = random_state;
        make_uniform(&q);
        question_round_to_floats(&q);
        question_from_box(&q);
        smaller = q;
        larger = q;
        for (a = 0; a < 3; a++) {
            smaller.lo[a] += 0.001;
            smaller.hi[a] -= 0.001;
            larger.lo[a] -= 0.001;
            larger.hi[a] += 0.001;
        }
        smaller.has_voxel = larger.has_voxel = 0;
        truth = oracle_says(question_truth(&larger), 0);
        if (truth == oracle_says(question_truth(&smaller), 0)) {
            clear++;
            CHECK(question_judge(&q, "tribox_sat", 0, ask_sat(&q), truth));
        }
    }
    CHECK(clear > TEST_LOOPS(20000) / 2);
}

/* The known failure: on a 0.1f grid some answers are wrong, where tribox_overlap's are right. Which ones
 * depends on the compiler's use of fused or wider arithmetic, hence the search. */
static void reference_errs_on_a_grid_of_tenths(void)
{
    int wrong = 0;
    int i;

    random_seed(3);
    for (i = 0; i < 20000; i++) {
        question q;
        q.seed = random_state;
        make_stepped(&q, TENTHS);
        question_round_to_floats(&q);
        question_from_box(&q);
        wrong += ask_sat(&q) != oracle_says(question_truth(&q), 0);
    }
    CHECK(wrong > 0);
}

int main(void)
{
    RUN(reference_is_exact_on_small_integers);
    RUN(reference_is_right_away_from_touching);
    RUN(reference_errs_on_a_grid_of_tenths);
    return test_report("test_sat");
}
