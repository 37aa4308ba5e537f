/* Every entry under every rule against the exact oracle, on seeded hard questions of each kind. A failing
 * question is printed with its seed and its numbers in hex, ready to paste into test_issues.c. */
#include "tribox.h"

#include "question.h"

static void every_entry_agrees_with_the_oracle(int kind, int as_float, int count)
{
    question q;
    int      i;

    random_seed((uint64_t)kind * 1000003u + (uint64_t)as_float);
    for (i = 0; i < TEST_LOOPS(count); i++) {
        question_make(&q, kind, as_float);
        CHECK(ask_all(&q));
    }
}

/* Small integers touch exactly in most questions; no rounding happens anywhere, only ties. */
static void lattice_questions_are_exact(void)
{
    every_entry_agrees_with_the_oracle(LATTICE, FLOATS, 15000);
}

/* Multiples of 0.1f touch in the decimals that users think in, and miss or overlap by an ulp in truth. */
static void tenths_are_exact(void)
{
    every_entry_agrees_with_the_oracle(TENTHS, FLOATS, 7500);
    every_entry_agrees_with_the_oracle(TENTHS, DOUBLES, 7500);
}

/* The same for thirds. */
static void thirds_are_exact(void)
{
    every_entry_agrees_with_the_oracle(THIRDS, FLOATS, 5000);
    every_entry_agrees_with_the_oracle(THIRDS, DOUBLES, 5000);
}

/* Far from the origin few bits remain for the differences: 1e4 + 0.1 i. */
static void far_tenths_are_exact(void)
{
    every_entry_agrees_with_the_oracle(FAR_TENTHS, FLOATS, 5000);
    every_entry_agrees_with_the_oracle(FAR_TENTHS, DOUBLES, 5000);
}

/* Random numbers: what the filter decides must be right too. */
static void random_questions_are_exact(void)
{
    every_entry_agrees_with_the_oracle(UNIFORM, FLOATS, 10000);
    every_entry_agrees_with_the_oracle(UNIFORM, DOUBLES, 10000);
}

/* Three corners within ulps of one line: the normal and all its signs are noise to plain arithmetic. */
static void slivers_are_exact(void)
{
    every_entry_agrees_with_the_oracle(SLIVER, FLOATS, 7500);
    every_entry_agrees_with_the_oracle(SLIVER, DOUBLES, 7500);
}

/* A component of the normal that is nearly zero: its sign decides which side of three edges is inside. */
static void steep_triangles_are_exact(void)
{
    every_entry_agrees_with_the_oracle(STEEP, FLOATS, 7500);
    every_entry_agrees_with_the_oracle(STEEP, DOUBLES, 7500);
}

/* Segments and points are triangles like any other. */
static void degenerate_triangles_are_exact(void)
{
    every_entry_agrees_with_the_oracle(DEGENERATE, FLOATS, 7500);
    every_entry_agrees_with_the_oracle(DEGENERATE, DOUBLES, 2500);
}

/* One-ulp walks round contacts of a box corner, edge or face with a corner, an edge or the inside of the
 * triangle. */
static void contacts_within_ulps_are_exact(void)
{
    every_entry_agrees_with_the_oracle(TOUCHING, FLOATS, 15000);
    every_entry_agrees_with_the_oracle(TOUCHING, DOUBLES, 10000);
}

/* The same contacts, one axis up to 2^40 times longer than another: no condition may borrow another's
 * bound. */
static void skewed_contacts_are_exact(void)
{
    every_entry_agrees_with_the_oracle(SKEWED, FLOATS, 10000);
    every_entry_agrees_with_the_oracle(SKEWED, DOUBLES, 10000);
}

/* Triangle and box a million times larger or smaller than each other, in contact or nearly so. */
static void mismatched_scales_are_exact(void)
{
    every_entry_agrees_with_the_oracle(MISMATCH, FLOATS, 7500);
    every_entry_agrees_with_the_oracle(MISMATCH, DOUBLES, 5000);
}

/* Powers of two per axis keep the truth: subnormals and the largest numbers of both types answer like the
 * lattice. */
static void extreme_exponents_are_exact(void)
{
    every_entry_agrees_with_the_oracle(STRETCHED, FLOATS, 5000);
    every_entry_agrees_with_the_oracle(STRETCHED, DOUBLES, 2500);
}

/* Walls, floors and 45-degree faces on the lattice: exact zeros in most conditions. */
static void aligned_triangles_are_exact(void)
{
    every_entry_agrees_with_the_oracle(ALIGNED, FLOATS, 10000);
    every_entry_agrees_with_the_oracle(ALIGNED, DOUBLES, 5000);
}

/* Numbers of many exponents in one question need the longest integers: up to the whole range of double. */
static void mixed_exponents_are_exact(void)
{
    every_entry_agrees_with_the_oracle(MIXED, FLOATS, 2500);
    every_entry_agrees_with_the_oracle(MIXED, DOUBLES, 1000);
}

/* Neighbouring floats between which the answer changes, found by bisection along one coordinate of a
 * corner: the header must change its answer between the same two. */
static void answers_flip_between_the_right_neighbours(void)
{
    int i;

    random_seed(77);
    for (i = 0; i < TEST_LOOPS(1500); i++) {
        question q;
        int      which = random_below(9);
        double  *x;
        int      low = 0;
        int      high = 1 << 22;
        int      first;
        float    start;

        question_make(&q, UNIFORM, 1);
        x = &q.t.v[which / 3][which % 3];
        start = (float)*x;
        q.has_voxel = 0;
        q.has_box = 1;
        first = oracle_says(question_truth(&q), 0);
        while (high - low > 1) {
            int middle = low + (high - low) / 2;
            *x = (double)nudge_float(start, middle);
            if (oracle_says(question_truth(&q), 0) == first) {
                low = middle;
            } else {
                high = middle;
            }
        }
        *x = (double)nudge_float(start, low);
        question_from_box(&q);
        CHECK(ask_all(&q));
        *x = (double)nudge_float(start, high);
        question_from_box(&q);
        CHECK(ask_all(&q));
    }
}

int main(void)
{
    RUN(lattice_questions_are_exact);
    RUN(tenths_are_exact);
    RUN(thirds_are_exact);
    RUN(far_tenths_are_exact);
    RUN(random_questions_are_exact);
    RUN(slivers_are_exact);
    RUN(steep_triangles_are_exact);
    RUN(degenerate_triangles_are_exact);
    RUN(contacts_within_ulps_are_exact);
    RUN(skewed_contacts_are_exact);
    RUN(mismatched_scales_are_exact);
    RUN(extreme_exponents_are_exact);
    RUN(aligned_triangles_are_exact);
    RUN(mixed_exponents_are_exact);
    RUN(answers_flip_between_the_right_neighbours);
    return test_report("test_exact");
}
