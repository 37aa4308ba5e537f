/* The inputs that broke other implementations, one function per row, each with its exact truth. Decimals
 * stand for the nearest float; the oracle confirms every truth below. */
#include "tribox.h"

#include "question.h"

static void field_row(const float t[9], const float lo[3], const float hi[3], int truth)
{
    question q;
    int      a;
    int      i;

    q.seed = 0;
    for (a = 0; a < 3; a++) {
        for (i = 0; i < 3; i++) {
            q.t.v[i][a] = (double)t[3 * i + a];
        }
        q.lo[a] = (double)lo[a];
        q.hi[a] = (double)hi[a];
    }
    question_from_box(&q);
    CHECK(oracle_says(question_truth(&q), 0) == truth);
    CHECK(tribox_overlap(t, t + 3, t + 6, lo, hi) == truth);
    CHECK(ask_all(&q));
}

/* 1: eleven plain float tests say 0. */
static void tenths_that_float_tests_miss(void)
{
    static const float t[9] = {.5f, .2f, .6f, .3f, .1f, .4f, .3f, .6f, .6f};
    static const float lo[3] = {.4f, .4f, .5f};
    static const float hi[3] = {.7f, .5f, .6f};

    field_row(t, lo, hi, 1);
}

/* 1: plain double says 0. */
static void tenths_that_double_tests_miss(void)
{
    static const float t[9] = {.3f, .3f, .7f, .8f, .6f, 0, .4f, 0, .4f};
    static const float lo[3] = {.1f, 0, .2f};
    static const float hi[3] = {.4f, .1f, .4f};

    field_row(t, lo, hi, 1);
}

/* 1: lost where the extents of the zx plane are swapped. */
static void swapped_extents_in_the_zx_plane(void)
{
    static const float t[9] = {3, 2, 2, 6, 3, 2, 4, 5, 6};
    static const float lo[3] = {2, 1, 4};
    static const float hi[3] = {4, 4, 5};

    field_row(t, lo, hi, 1);
}

/* 1: the triangle touches the face x = 1 of the unit box by one corner; lost by a box that is half-open by
 * accident. */
static void corner_on_the_upper_face(void)
{
    static const float t[9] = {1, .25f, .25f, 2, .25f, .25f, 2, .75f, .5f};
    static const float lo[3] = {0, 0, 0};
    static const float hi[3] = {1, 1, 1};

    field_row(t, lo, hi, 1);
    CHECK(tribox_overlap_rule(t, t + 3, t + 6, lo, hi, TRIBOX_HALF_OPEN) == 0);
}

/* 1: lost where only three of the box's four diagonals are tested against the plane. */
static void fourth_diagonal(void)
{
    static const float t[9] = {10, -10, -1.75f, -10, 10, -1.75f, 5, 5, 8.25f};
    static const float lo[3] = {0, 0, 0};
    static const float hi[3] = {1, 1, 1};

    field_row(t, lo, hi, 1);
}

/* 0: the edge x + y = .06 passes the corner (.02, .02); an absolute epsilon on an axis' length drops that
 * axis. */
static void short_axis_under_an_absolute_epsilon(void)
{
    static const float t[9] = {.06f, 0, 0, 0, .06f, 0, .06f, .06f, 0};
    static const float lo[3] = {-.02f, -.02f, -.01f};
    static const float hi[3] = {.02f, .02f, .01f};

    field_row(t, lo, hi, 0);
}

/* 1: a segment, its normal is 0; a normalised plane becomes NaN. */
static void segment_with_a_zero_normal(void)
{
    static const float t[9] = {4, 6, 7, 4, 6, 7, 8, 2, 2};
    static const float lo[3] = {5, 4, 3};
    static const float hi[3] = {8, 5, 6};

    field_row(t, lo, hi, 1);
}

/* 0: a segment that an exact library reports as overlapping. */
static void segment_that_misses(void)
{
    static const float t[9] = {7, 3, 3, 3, 8, 3, 3, 8, 3};
    static const float lo[3] = {3, 3, 2};
    static const float hi[3] = {6, 4, 4};

    field_row(t, lo, hi, 0);
}

/* 0: needs the bounding-box axes. */
static void bounding_boxes_apart(void)
{
    static const float t[9] = {7, 2, 2, 6, 3, 4, 6, 4, 5};
    static const float lo[3] = {3, 4, 6};
    static const float hi[3] = {6, 7, 8};

    field_row(t, lo, hi, 0);
}

/* 1: lost by a test that forgets to move the corners to the box's centre. */
static void corners_not_centred(void)
{
    static const float t[9] = {.125f, .125f, .875f, .875f, .125f, .875f, .125f, .875f, .875f};
    static const float lo[3] = {0, 0, 0};
    static const float hi[3] = {1, 1, 1};

    field_row(t, lo, hi, 1);
}

/* A wall on a grid plane sets both layers when closed or thin, the upper one half-open, none open. */
static void wall_on_a_grid_plane(void)
{
    static const float    v0[3] = {.25f, .25f, 1};
    static const float    v1[3] = {.75f, .25f, 1};
    static const float    v2[3] = {.25f, .75f, 1};
    static const int      lower[4] = {1, 0, 0, 1};
    static const int      upper[4] = {1, 1, 0, 1};
    static const float    one[3] = {1, 1, 1};
    static const float    p_lower[3] = {0, 0, 0};
    static const float    p_upper[3] = {0, 0, 1};
    int                   i;

    for (i = 0; i < 4; i++) {
        static const float w0[3] = {-2, -2, 1};
        static const float w1[3] = {4, -2, 1};
        static const float w2[3] = {-2, 4, 1};
        tribox_tri         tri;
        tribox_tri_init(&tri, w0, w1, w2, one, every_rule[i]);
        CHECK(tribox_tri_test(&tri, p_lower) == lower[i]);
        CHECK(tribox_tri_test(&tri, p_upper) == upper[i]);
    }
    CHECK(tribox_overlap_rule(v0, v1, v2, p_lower, one, 0) == 1);
    CHECK(tribox_overlap_rule(v0, v1, v2, p_lower, one, TRIBOX_HALF_OPEN) == 0);
}

/* Negative coordinates are rounded down, not toward zero: -0.5 lies in voxel -1. */
static void negative_coordinates_lie_in_negative_voxels(void)
{
    tribox_grid  grid = {{0, 0, 0}, {1, 1, 1}, {-2, -2, -2}, {2, 2, 2}, TRIBOX_HALF_OPEN};
    const double p[3] = {-0.5, -1.0, 0.5};
    int          index[3];

    CHECK(tribox_grid_locate(&grid, p, index) == 1);
    CHECK(index[0] == -1 && index[1] == -1 && index[2] == 0);
    CHECK(tribox_grid_spans_f64(&grid, p, p, p, 0, 0) == 1);
}

int main(void)
{
    RUN(tenths_that_float_tests_miss);
    RUN(tenths_that_double_tests_miss);
    RUN(swapped_extents_in_the_zx_plane);
    RUN(corner_on_the_upper_face);
    RUN(fourth_diagonal);
    RUN(short_axis_under_an_absolute_epsilon);
    RUN(segment_with_a_zero_normal);
    RUN(segment_that_misses);
    RUN(bounding_boxes_apart);
    RUN(corners_not_centred);
    RUN(wall_on_a_grid_plane);
    RUN(negative_coordinates_lie_in_negative_voxels);
    return test_report("test_field");
}
