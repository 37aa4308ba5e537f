/* The thin (6-separating) test: its definition, the traps in it, and what it leaves out. */
#include "tribox.h"

#include "question.h"

static int thin(const double *t, const double p[3], const double size[3])
{
    tribox_tri tri;

    tribox_tri_init_f64(&tri, t, t + 3, t + 6, size, TRIBOX_THIN);
    return tribox_tri_test_f64(&tri, p);
}

/* A small triangle in a voxel's corner region is cut by no diagonal of face centres: conservative sets it,
 * thin does not; about the centre both do. */
static void triangle_inside_one_voxel_may_set_nothing(void)
{
    const double corner[9] = {.0625, .0625, .125, .125, .0625, .0625, .0625, .125, .0625};
    const double centre[9] = {.375, .5, .5, .625, .5, .5, .5, .625, .5};
    const double p[3] = {0, 0, 0};
    const double one[3] = {1, 1, 1};
    tribox_tri   tri;

    tribox_tri_init_f64(&tri, corner, corner + 3, corner + 6, one, 0);
    CHECK(tribox_tri_test_f64(&tri, p) == 1);
    CHECK(thin(corner, p, one) == 0);
    CHECK(thin(centre, p, one) == 1);
}

/* The support of a non-cubic voxel is the largest product |n_a| h_a, not h at the largest |n_a|. The plane
 * 2x + y = d about the centre of a voxel of half size (1/2, 4, 1/2) has products 1 and 4: thin reaches up
 * to d = 4, exactly. */
static void support_is_the_largest_product(void)
{
    int a;
    int d;

    for (a = 0; a < 3; a++) {
        for (d = -6; d <= 6; d++) {
            int    b = (a + 1) % 3;
            int    c = (a + 2) % 3;
            double t[9];
            double p[3];
            double size[3];
            t[a] = 100;
            t[b] = d - 200;
            t[c] = -90;
            t[3 + a] = -100;
            t[3 + b] = d + 200;
            t[3 + c] = -90;
            t[6 + a] = 0;
            t[6 + b] = d;
            t[6 + c] = 300;
            p[a] = p[c] = -.5;
            p[b] = -4;
            size[a] = size[c] = 1;
            size[b] = 8;
            CHECK(thin(t, p, size) == (d >= -4 && d <= 4));
        }
    }
}

/* A large triangle across an axis' plane, slightly tilted: its middle is set and stays set under every
 * order of the corners. Reading the plane of y as xz instead of zx turns all its edge normals outward and
 * loses it. */
static void middle_of_a_large_triangle_is_set_on_every_axis(void)
{
    const double p[3] = {-.5, -.5, -.5};
    const double one[3] = {1, 1, 1};
    int          a;
    int          turn;

    for (a = 0; a < 3; a++) {
        for (turn = 0; turn < 6; turn++) {
            static const double at[3][2] = {{-40, -30}, {50, -30}, {0, 60}};
            double              t[9];
            int                 i;
            for (i = 0; i < 3; i++) {
                int k = turn < 3 ? (i + turn) % 3 : (5 - i + turn) % 3;
                t[3 * k + a] = at[i][0] / 128;
                t[3 * k + (a + 1) % 3] = at[i][0];
                t[3 * k + (a + 2) % 3] = at[i][1];
            }
            CHECK(thin(t, p, one) == 1);
        }
    }
}

/* The face test with the whole voxel stays: here plane and edges accept and only the faces part the two,
 * so without it thin would set a voxel that the triangle does not touch. */
static void faces_part_what_plane_and_edges_accept(void)
{
    int found = 0;
    int i;

    random_seed(31);
    for (i = 0; i < 200000 && found < 3; i++) {
        question    q;
        oracle_case c;
        int         a;
        int         j;
        q.seed = random_state;
        make_stepped(&q, LATTICE);
        question_from_box(&q);
        oracle_set_triangle(&c, &q.t, 0);
        for (a = 0; a < 3; a++) {
            oracle_integer(&c.face[0][a], q.lo[a], 0);
            oracle_integer(&c.face[1][a], q.hi[a], 0);
        }
        if (oracle_beyond_a_face(&c)) {
            oracle_thin_case d;
            int              accepted = 1;
            oracle_double(&d, &c);
            for (j = 0; j < 3; j++) {
                accepted = accepted && oracle_thin_edges(&d, j);
            }
            if (accepted && oracle_thin_plane(&d)) {
                found++;
                CHECK(thin(&q.t.v[0][0], q.lo, q.size) == 0);
            }
        }
    }
    CHECK(found == 3);
}

/* What thin sets, the closed conservative test sets too: on hard questions of all kinds. */
static void thin_is_a_subset_of_conservative(void)
{
    int set = 0;
    int less = 0;
    int i;

    random_seed(32);
    for (i = 0; i < TEST_LOOPS(40000); i++) {
        question   q;
        tribox_tri tri;
        int        conservative;
        int        is_thin;
        question_make(&q, i % MIXED, 0);
        if (!q.has_voxel) {
            continue;
        }
        tribox_tri_init_f64(&tri, q.t.v[0], q.t.v[1], q.t.v[2], q.size, 0);
        conservative = tribox_tri_test_f64(&tri, q.lo);
        is_thin = thin(&q.t.v[0][0], q.lo, q.size);
        CHECK(question_judge(&q, "thin beyond conservative", TRIBOX_THIN, is_thin && !conservative, 0));
        set += is_thin;
        less += conservative && !is_thin;
    }
    CHECK(set > 0 && less > 0);
}

/* Thin is always closed: a triangle in the plane of a shared face sets both voxels, whatever other flags
 * say. */
static void thin_counts_touching_under_every_flag(void)
{
    int a;
    int f;

    for (a = 0; a < 3; a++) {
        for (f = 4; f < 8; f++) {
            const double one[3] = {1, 1, 1};
            double       t[9];
            double       p[3] = {0, 0, 0};
            tribox_tri   tri;
            int          i;
            for (i = 0; i < 3; i++) {
                t[3 * i + a] = 1;
                t[3 * i + (a + 1) % 3] = i == 1 ? 9 : -3;
                t[3 * i + (a + 2) % 3] = i == 2 ? 9 : -3;
            }
            tribox_tri_init_f64(&tri, t, t + 3, t + 6, one, (unsigned)f);
            CHECK(tribox_tri_test_f64(&tri, p) == 1);
            p[a] = 1;
            CHECK(tribox_tri_test_f64(&tri, p) == 1);
            p[a] = 2;
            CHECK(tribox_tri_test_f64(&tri, p) == 0);
            p[a] = -1;
            CHECK(tribox_tri_test_f64(&tri, p) == 0);
        }
    }
}

/* A normal with an exactly zero component projects to a segment: both sides of its line are tested, in
 * either order of the corners. The wall x = y passes the voxel centred at (d, 0) within the diamond's
 * reach, 1/2, or not. */
static void vertical_wall_reaches_the_diamond(void)
{
    int d;
    int turn;

    for (d = -8; d <= 8; d++) {
        for (turn = 0; turn < 2; turn++) {
            double       t[9] = {-50, -50, -20, 50, 50, -20, 10, 10, 70};
            const double one[3] = {1, 1, 1};
            double       p[3] = {-.5, -.5, -.5};
            if (turn) {
                double swap;
                int    a;
                for (a = 0; a < 3; a++) {
                    swap = t[a];
                    t[a] = t[3 + a];
                    t[3 + a] = swap;
                }
            }
            p[0] += d / 8.0;
            CHECK(thin(t, p, one) == (d >= -4 && d <= 4));
        }
    }
}

/* Steep and nearly degenerate triangles, boxes at a contact: the sign of a nearly zero n_a flips three
 * edges, so it has to be exact. Against the oracle, with random voxel shapes. */
static void nearly_zero_normals_keep_their_sign(void)
{
    int i;

    random_seed(33);
    for (i = 0; i < TEST_LOOPS(30000); i++) {
        static const int zero[3] = {0, 0, 0};
        question         q;
        double           s;
        int              axis = i % 3;
        int              a;
        q.seed = random_state;
        make_steep(&q);
        s = (random_signed() + 1) * 0.5;
        for (a = 0; a < 3; a++) {
            /* The voxel's diamond or a face centre near a point of edge v0v1. */
            double x = q.t.v[0][a] + s * (q.t.v[1][a] - q.t.v[0][a]);
            q.size[a] = (1 + random_below(4)) / 8.0;
            q.lo[a] = x - (a == axis ? 0 : q.size[a] / 2);
        }
        question_from_voxel(&q);
        CHECK(question_judge(&q, "thin", TRIBOX_THIN, thin(&q.t.v[0][0], q.lo, q.size),
                             oracle_says(oracle_voxel(&q.t, q.lo, q.size, zero), TRIBOX_THIN)));
    }
}

int main(void)
{
    RUN(triangle_inside_one_voxel_may_set_nothing);
    RUN(support_is_the_largest_product);
    RUN(middle_of_a_large_triangle_is_set_on_every_axis);
    RUN(faces_part_what_plane_and_edges_accept);
    RUN(thin_is_a_subset_of_conservative);
    RUN(thin_counts_touching_under_every_flag);
    RUN(vertical_wall_reaches_the_diamond);
    RUN(nearly_zero_normals_keep_their_sign);
    return test_report("test_thin");
}
