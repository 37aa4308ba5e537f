/* Touching rules: closed, half-open, open, in the one-box and the prepared test. */
#include "tribox.h"

#include "question.h"

static const double unit_min[3] = {0, 0, 0};
static const double unit_max[3] = {1, 1, 1};

/* The answers under closed, half-open and open as bits 0, 1 and 2. Both entries must agree. */
static unsigned answers(const double t[9], const double lo[3], const double hi[3])
{
    static const unsigned rules[3] = {0, TRIBOX_HALF_OPEN, TRIBOX_OPEN};
    double                size[3];
    unsigned              result = 0;
    int                   i;

    for (i = 0; i < 3; i++) {
        size[i] = hi[i] - lo[i];
    }
    for (i = 0; i < 3; i++) {
        tribox_tri tri;
        int        one_box = tribox_overlap_rule_f64(t, t + 3, t + 6, lo, hi, rules[i]);
        tribox_tri_init_f64(&tri, t, t + 3, t + 6, size, rules[i]);
        CHECK(tribox_tri_test_f64(&tri, lo) == one_box);
        result |= (unsigned)one_box << i;
    }
    return result;
}

/* A corner on the upper face counts when closed only; on the lower face also when half-open; inside
 * always. */
static void corner_on_a_face_follows_the_rule(void)
{
    int a;

    for (a = 0; a < 3; a++) {
        double t[9] = {.5, .5, .5, .5, .5, .5, .5, .5, .5};
        t[a] = 1;
        t[3 + a] = 2;
        t[6 + a] = 3;
        CHECK(answers(t, unit_min, unit_max) == 1);
        t[a] = 0;
        t[3 + a] = -1;
        t[6 + a] = -2;
        CHECK(answers(t, unit_min, unit_max) == 3);
        t[a] = .5;
        CHECK(answers(t, unit_min, unit_max) == 7);
    }
}

/* A face of the triangle in the plane of a box face: no inner point, so the same as a corner there. */
static void triangle_in_a_face_follows_the_rule(void)
{
    int a;

    for (a = 0; a < 3; a++) {
        double t[9] = {.25, .25, .25, .75, .75, .75, .25, .25, .25};
        t[3 + (a + 1) % 3] = .25;
        t[6 + (a + 2) % 3] = .75;
        t[a] = t[3 + a] = t[6 + a] = 1;
        CHECK(answers(t, unit_min, unit_max) == 1);
        t[a] = t[3 + a] = t[6 + a] = 0;
        CHECK(answers(t, unit_min, unit_max) == 3);
    }
}

/* Only part of the triangle lies on the face: after the clip, the box's own face stays open at equality,
 * and the inner points decide. */
static void corner_on_a_face_with_inner_points_overlaps(void)
{
    int a;

    for (a = 0; a < 3; a++) {
        double t[9] = {.5, .5, .5, .5, .5, .5, .25, .75, .25};
        t[a] = 1;
        CHECK(answers(t, unit_min, unit_max) == 7);
        t[a] = 0;
        CHECK(answers(t, unit_min, unit_max) == 7);
    }
}

/* A plane through one corner of the box alone: it counts half-open only at the corner (0,0,0), which uses
 * no open face; at the seven others some open face has a non-zero coefficient. */
static void plane_through_a_corner_follows_the_rule(void)
{
    int corner;

    for (corner = 0; corner < 8; corner++) {
        double t[9];
        int    a;
        int    i;
        for (i = 0; i < 3; i++) {
            for (a = 0; a < 3; a++) {
                /* In-plane directions (2,-1,-1) and so on; the outward normal is (+-1,+-1,+-1). */
                double outward = corner >> a & 1 ? 1 : -1;
                t[3 * i + a] = (corner >> a & 1) + (a == i ? 2 : -1) * outward;
            }
        }
        CHECK(answers(t, unit_min, unit_max) == (corner == 0 ? 3u : 1u));
    }
}

/* An edge of the triangle across an edge of the box: half-open counts it if the edge belongs to no open
 * face. */
static void edge_across_an_edge_follows_the_rule(void)
{
    int a;
    int side;

    for (a = 0; a < 3; a++) {
        for (side = 0; side < 4; side++) {
            int    b = (a + 1) % 3;
            int    c = (a + 2) % 3;
            double xb = side & 1;
            double xc = side >> 1;
            double sb = side & 1 ? 1 : -1;
            double sc = side >> 1 ? 1 : -1;
            double t[9];
            t[a] = t[3 + a] = .5;
            t[6 + a] = .25;
            t[b] = xb + sb;
            t[c] = xc - sc;
            t[3 + b] = xb - sb;
            t[3 + c] = xc + sc;
            t[6 + b] = xb + sb;
            t[6 + c] = xc + sc;
            CHECK(answers(t, unit_min, unit_max) == (side == 0 ? 3u : 1u));
        }
    }
}

/* A flat box counts when closed and is empty under the other rules. */
static void flat_box_is_empty_unless_closed(void)
{
    int a;

    for (a = 0; a < 3; a++) {
        const double t[9] = {-4, -4, .25, 6, -4, .5, .5, 8, .75};
        double       lo[3] = {0, 0, 0};
        double       hi[3] = {1, 1, 1};
        CHECK(answers(t, lo, hi) == 7);
        lo[a] = hi[a] = .5;
        CHECK(answers(t, lo, hi) == 1);
    }
}

/* Flag arithmetic: HALF_OPEN|OPEN is OPEN; THIN overrides and means closed for one box; other bits are
 * ignored. */
static void flags_combine_as_documented(void)
{
    unsigned high;
    int      i;

    random_seed(21);
    for (i = 0; i < TEST_LOOPS(1000); i++) {
        question q;
        unsigned truth;
        unsigned f;
        question_make(&q, i & 1 ? LATTICE : ALIGNED, 1);
        truth = question_truth(&q);
        high = 0xFFFFFFF8u & (unsigned)random_bits();
        for (f = 0; f < 8; f++) {
            int ok = ask_box(&q, f | high, oracle_says(truth, f & 4 ? 0 : f));
            CHECK(ok);
            ok = ask_tri(&q, f | high, oracle_says(truth, f));
            CHECK(ok);
            ok = ask_grid(&q, f | high, oracle_says(truth, f));
            CHECK(ok);
        }
    }
}

/* Half-open is closed with the upper faces moved in by a small enough e, open also the lower ones.
 * Conditions on lattice numbers below 16 are integers of slope below 2^12, so e = 2^-20 is small enough:
 * the rule is the limit. */
static void rules_are_limits_of_smaller_boxes(void)
{
    const double e = 1.0 / 1048576;
    int          i;

    random_seed(22);
    for (i = 0; i < TEST_LOOPS(30000); i++) {
        question q;
        double   hi[3];
        double   lo[3];
        int      a;
        q.seed = random_state;
        make_stepped(&q, LATTICE);
        question_from_box(&q);
        for (a = 0; a < 3; a++) {
            hi[a] = q.hi[a] - e;
            lo[a] = q.lo[a] + e;
        }
        CHECK(question_judge(
            &q, "half-open as a limit", TRIBOX_HALF_OPEN,
            tribox_overlap_rule_f64(q.t.v[0], q.t.v[1], q.t.v[2], q.lo, q.hi, TRIBOX_HALF_OPEN),
            tribox_overlap_f64(q.t.v[0], q.t.v[1], q.t.v[2], q.lo, hi)));
        CHECK(question_judge(&q, "open as a limit", TRIBOX_OPEN,
                             tribox_overlap_rule_f64(q.t.v[0], q.t.v[1], q.t.v[2], q.lo, q.hi, TRIBOX_OPEN),
                             tribox_overlap_f64(q.t.v[0], q.t.v[1], q.t.v[2], lo, hi)));
    }
}

/* Half-open boxes tile space: a point lies in exactly one of the 27 boxes round it, a triangle in at least
 * one, and the tiles [0,1) and [1,2) together answer as [0,2) does. */
static void half_open_boxes_partition_space(void)
{
    int i;

    random_seed(23);
    for (i = 0; i < TEST_LOOPS(3000); i++) {
        question q;
        double   p[3];
        double   t[9];
        int      boxes = 0;
        int      together = 0;
        int      j;
        q.seed = random_state;
        make_stepped(&q, LATTICE);
        for (j = 0; j < 3; j++) {
            p[j] = random_below(2) ? 1.0 : 1.0 + random_signed();
        }
        for (j = 0; j < 9; j++) {
            t[j] = q.t.v[j / 3][j % 3] / 2;
        }
        for (j = 0; j < 27; j++) {
            double lo[3];
            double hi[3];
            int    hit;
            lo[0] = j % 3;
            lo[1] = j / 3 % 3;
            lo[2] = j / 9;
            hi[0] = lo[0] + 1;
            hi[1] = lo[1] + 1;
            hi[2] = lo[2] + 1;
            boxes += tribox_overlap_rule_f64(p, p, p, lo, hi, TRIBOX_HALF_OPEN);
            hit = tribox_overlap_rule_f64(t, t + 3, t + 6, lo, hi, TRIBOX_HALF_OPEN);
            together |= lo[0] < 2 && lo[1] < 2 && lo[2] < 2 ? hit : 0;
        }
        {
            const double two[3] = {2, 2, 2};
            CHECK(boxes == 1);
            CHECK(together == tribox_overlap_rule_f64(t, t + 3, t + 6, unit_min, two, TRIBOX_HALF_OPEN));
        }
    }
}

/* Open implies half-open implies closed, on contacts within ulps. */
static void stricter_rules_answer_less(void)
{
    int i;

    random_seed(24);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        question q;
        int      closed;
        int      half;
        int      open;
        question_make(&q, i & 1 ? TOUCHING : TENTHS, 0);
        closed = tribox_overlap_rule_f64(q.t.v[0], q.t.v[1], q.t.v[2], q.lo, q.hi, 0);
        half = tribox_overlap_rule_f64(q.t.v[0], q.t.v[1], q.t.v[2], q.lo, q.hi, TRIBOX_HALF_OPEN);
        open = tribox_overlap_rule_f64(q.t.v[0], q.t.v[1], q.t.v[2], q.lo, q.hi, TRIBOX_OPEN);
        CHECK(open <= half && half <= closed);
    }
}

int main(void)
{
    RUN(corner_on_a_face_follows_the_rule);
    RUN(triangle_in_a_face_follows_the_rule);
    RUN(corner_on_a_face_with_inner_points_overlaps);
    RUN(plane_through_a_corner_follows_the_rule);
    RUN(edge_across_an_edge_follows_the_rule);
    RUN(flat_box_is_empty_unless_closed);
    RUN(flags_combine_as_documented);
    RUN(rules_are_limits_of_smaller_boxes);
    RUN(half_open_boxes_partition_space);
    RUN(stricter_rules_answer_less);
    return test_report("test_rule");
}
