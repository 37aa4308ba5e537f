/* Exact answers are symmetrical: corner order, axis order, mirroring and power-of-two scaling keep them. */
#include "tribox.h"

#include "question.h"

/* One bit per rule from the one-box test and one from the prepared test, over the rules given. */
static unsigned all_answers(const question *q, const unsigned *rules, int count)
{
    unsigned result = 0;
    int      i;

    for (i = 0; i < count; i++) {
        tribox_tri tri;
        tribox_tri_init_f64(&tri, q->t.v[0], q->t.v[1], q->t.v[2], q->size, rules[i]);
        result |= (unsigned)tribox_tri_test_f64(&tri, q->lo) << (2 * i);
        if (q->has_box) {
            result |=
                (unsigned)tribox_overlap_rule_f64(q->t.v[0], q->t.v[1], q->t.v[2], q->lo, q->hi, rules[i])
                << (2 * i + 1);
        }
    }
    return result;
}

static const unsigned even_rules[3] = {0, TRIBOX_OPEN, TRIBOX_THIN};      /* those a mirror keeps */

static void symmetry_question(question *q, int i)
{
    do {
        question_make(q, i % QUESTION_KINDS, i & 1);
    } while (!q->has_voxel);
}

/* Any winding and any first corner: six orders, one answer. */
static void corner_order_keeps_the_answer(void)
{
    int i;

    random_seed(41);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        question q;
        question turned;
        unsigned expected;
        int      k;
        symmetry_question(&q, i);
        expected = all_answers(&q, every_rule, 4);
        for (k = 1; k < 6; k++) {
            int j;
            turned = q;
            for (j = 0; j < 3; j++) {
                memcpy(turned.t.v[j], q.t.v[k < 3 ? (j + k) % 3 : (k - j) % 3], sizeof q.t.v[0]);
            }
            CHECK(question_judge(&q, "corner order", (unsigned)k,
                                 all_answers(&turned, every_rule, 4) == expected, 1));
        }
    }
}

/* The axes have no names: six orders, one answer. */
static void axis_order_keeps_the_answer(void)
{
    int i;

    random_seed(42);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        question q;
        question turned;
        unsigned expected;
        int      k;
        symmetry_question(&q, i);
        expected = all_answers(&q, every_rule, 4);
        for (k = 1; k < 6; k++) {
            int a;
            turned = q;
            for (a = 0; a < 3; a++) {
                int from = k < 3 ? (a + k) % 3 : (k - a) % 3;
                int j;
                for (j = 0; j < 3; j++) {
                    turned.t.v[j][a] = q.t.v[j][from];
                }
                turned.lo[a] = q.lo[from];
                turned.hi[a] = q.hi[from];
                turned.size[a] = q.size[from];
            }
            CHECK(question_judge(&q, "axis order", (unsigned)k,
                                 all_answers(&turned, every_rule, 4) == expected, 1));
        }
    }
}

/* Mirrored along any set of axes: [lo, hi] becomes [-hi, -lo]. Half-open becomes open below and is left
 * out. */
static void mirroring_keeps_the_answer(void)
{
    int i;

    random_seed(43);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        question q;
        question turned;
        unsigned expected;
        int      k;
        symmetry_question(&q, i);
        if (!q.has_box) {
            continue;
        }
        expected = all_answers(&q, even_rules, 3);
        for (k = 1; k < 8; k++) {
            int a;
            turned = q;
            for (a = 0; a < 3; a++) {
                if (k >> a & 1) {
                    int j;
                    for (j = 0; j < 3; j++) {
                        turned.t.v[j][a] = -q.t.v[j][a];
                    }
                    turned.lo[a] = -q.hi[a];
                    turned.hi[a] = -q.lo[a];
                }
            }
            CHECK(question_judge(&q, "mirror", (unsigned)k, all_answers(&turned, even_rules, 3) == expected,
                                 1));
        }
    }
}

/* x * scale, and whether no bit was lost: the odd mantissa is the same */
static double scaled(double x, double scale, int *exact)
{
    double        y = x * scale;
    oracle_number before = oracle_read(&x);
    oracle_number after = oracle_read(&y);

    *exact = *exact && before.mantissa == after.mantissa && before.sign == after.sign &&
             before.is_infinite == after.is_infinite;
    return y;
}

/* Every axis scaled by its own power of two, far beyond what products of three can hold in a double. */
static void power_of_two_scaling_keeps_the_answer(void)
{
    static const int exponents[8] = {-900, -400, -100, -1, 1, 100, 400, 900};
    int              asked = 0;
    int              i;

    random_seed(44);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        question q;
        question turned;
        int      exact = 1;
        int      a;
        symmetry_question(&q, i);
        turned = q;
        for (a = 0; a < 3; a++) {
            double scale = power_of_two(exponents[random_below(8)]);
            int    j;
            for (j = 0; j < 3; j++) {
                turned.t.v[j][a] = scaled(q.t.v[j][a], scale, &exact);
            }
            turned.lo[a] = scaled(q.lo[a], scale, &exact);
            turned.hi[a] = scaled(q.hi[a], scale, &exact);
            turned.size[a] = scaled(q.size[a], scale, &exact);
        }
        if (exact) {
            asked++;
            CHECK(question_judge(&q, "scaling", 0,
                                 all_answers(&turned, every_rule, 4) == all_answers(&q, every_rule, 4), 1));
        }
    }
    CHECK(asked > TEST_LOOPS(4000) / 2);
}

/* Moved by whole lattice steps, however far: integers below 2^53 stay exact. */
static void translation_on_a_lattice_keeps_the_answer(void)
{
    int i;

    random_seed(45);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        question q;
        question turned;
        int      a;
        make_stepped(&q, LATTICE);
        q.seed = random_state;
        question_from_box(&q);
        turned = q;
        for (a = 0; a < 3; a++) {
            double far_step = power_of_two(random_below(52));
            int    j;
            far_step = random_below(2) ? far_step : -far_step;
            for (j = 0; j < 3; j++) {
                turned.t.v[j][a] += far_step;
            }
            turned.lo[a] += far_step;
            turned.hi[a] += far_step;
        }
        CHECK(question_judge(&q, "translation", 0,
                             all_answers(&turned, every_rule, 4) == all_answers(&q, every_rule, 4), 1));
    }
}

int main(void)
{
    RUN(corner_order_keeps_the_answer);
    RUN(axis_order_keeps_the_answer);
    RUN(mirroring_keeps_the_answer);
    RUN(power_of_two_scaling_keeps_the_answer);
    RUN(translation_on_a_lattice_keeps_the_answer);
    return test_report("test_symmetry");
}
