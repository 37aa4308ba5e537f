/* The one-box test: contacts at each feature of triangle and box, walked by ulps, and every small lattice
 * question. */
#include "tribox.h"

#include "question.h"

static const float box_min[3] = {1.0f, 2.0f, 4.0f};
static const float box_max[3] = {2.0f, 4.0f, 8.0f};

/* Closed box: a corner on the face overlaps; one ulp outside, it does not. */
static void touching_face_overlaps_and_next_float_does_not(void)
{
    int a;

    for (a = 0; a < 3; a++) {
        float t[3][3] = {{1.5f, 3.0f, 5.0f}, {1.5f, 3.0f, 5.0f}, {1.5f, 3.0f, 5.0f}};
        t[0][a] = box_max[a];
        t[1][a] = box_max[a] + 1.0f;
        t[2][a] = box_max[a] + 2.0f;
        CHECK(tribox_overlap(t[0], t[1], t[2], box_min, box_max) == 1);
        t[0][a] = nudge_float(box_max[a], 1);
        CHECK(tribox_overlap(t[0], t[1], t[2], box_min, box_max) == 0);
        t[0][a] = box_min[a];
        t[1][a] = box_min[a] - 1.0f;
        t[2][a] = box_min[a] - 2.0f;
        CHECK(tribox_overlap(t[0], t[1], t[2], box_min, box_max) == 1);
        t[0][a] = nudge_float(box_min[a], -1);
        CHECK(tribox_overlap(t[0], t[1], t[2], box_min, box_max) == 0);
    }
}

/* The plane x + y + z = 14 meets the box in its corner (2,4,8) alone; a corner of the triangle one ulp up
 * lifts it off. */
static void touching_plane_overlaps_and_next_float_does_not(void)
{
    float v0[3] = {14.0f, 0.0f, 0.0f};
    float v1[3] = {0.0f, 14.0f, 0.0f};
    float v2[3] = {0.0f, 0.0f, 14.0f};

    CHECK(tribox_overlap(v0, v1, v2, box_min, box_max) == 1);
    v0[0] = nudge_float(14.0f, 1);
    CHECK(tribox_overlap(v0, v1, v2, box_min, box_max) == 0);
    v0[0] = nudge_float(14.0f, -1);
    CHECK(tribox_overlap(v0, v1, v2, box_min, box_max) == 1);
}

/* An edge from (3,3,z) to (1,5,z) passes through the box edge x = 2, y = 4; lifted by one ulp it passes
 * by. */
static void touching_edges_overlap_and_next_float_does_not(void)
{
    int a;

    for (a = 0; a < 3; a++) {
        int   b = (a + 1) % 3;
        int   c = (a + 2) % 3;
        float t[3][3];
        t[0][a] = t[1][a] = t[2][a] = box_min[a] + 0.5f;
        t[0][b] = box_max[b] + 1.0f;
        t[0][c] = box_max[c] - 1.0f;
        t[1][b] = box_max[b] - 1.0f;
        t[1][c] = box_max[c] + 1.0f;
        t[2][b] = box_max[b] + 1.0f;
        t[2][c] = box_max[c] + 1.0f;
        CHECK(tribox_overlap(t[0], t[1], t[2], box_min, box_max) == 1);
        t[1][c] = nudge_float(t[1][c], 1);
        CHECK(tribox_overlap(t[0], t[1], t[2], box_min, box_max) == 0);
        t[1][c] = nudge_float(t[1][c], -2);
        CHECK(tribox_overlap(t[0], t[1], t[2], box_min, box_max) == 1);
    }
}

/* A point triangle overlaps exactly when its coordinates lie between the faces, on each of 5^3 places. */
static void point_triangle_overlaps_when_inside_the_faces(void)
{
    int i;

    for (i = 0; i < 125; i++) {
        int   place[3];
        float p[3];
        int   inside = 1;
        int   a;
        place[0] = i % 5;
        place[1] = i / 5 % 5;
        place[2] = i / 25;
        for (a = 0; a < 3; a++) {
            p[a] = place[a] == 0 ? nudge_float(box_min[a], -1) : place[a] == 1 ? box_min[a] :
                   place[a] == 2 ? 0.5f * (box_min[a] + box_max[a]) : place[a] == 3 ? box_max[a] :
                   nudge_float(box_max[a], 1);
            inside = inside && place[a] > 0 && place[a] < 4;
        }
        CHECK(tribox_overlap(p, p, p, box_min, box_max) == inside);
    }
}

/* A triangle wholly inside the box touches no face, and a triangle that cuts the box has no corner inside. */
static void inside_and_across_both_overlap(void)
{
    const float in0[3] = {1.25f, 2.5f, 5.0f};
    const float in1[3] = {1.75f, 2.5f, 5.0f};
    const float in2[3] = {1.5f, 3.5f, 7.0f};
    const float across0[3] = {-100.0f, -90.0f, 5.0f};
    const float across1[3] = {100.0f, -90.0f, 6.0f};
    const float across2[3] = {0.0f, 200.0f, 7.0f};

    CHECK(tribox_overlap(in0, in1, in2, box_min, box_max) == 1);
    CHECK(tribox_overlap(across0, across1, across2, box_min, box_max) == 1);
}

/* Projected along each axis, each of the three edges in turn passes by the corner of the unit box at a
 * quarter's distance, while the bounding boxes overlap; moved in by a quarter, it touches the corner. */
static void projected_edges_separate_on_every_axis(void)
{
    int a;
    int b;

    for (a = 0; a < 3; a++) {
        for (b = 0; b < 3; b++) {
            const float lo[3] = {0.0f, 0.0f, 0.0f};
            const float hi[3] = {1.0f, 1.0f, 1.0f};
            float       t[3][3];
            int         u = (a + 1) % 3;
            int         w = (a + 2) % 3;
            int         i = b;
            int         j = (b + 1) % 3;
            int         k = (b + 2) % 3;
            t[i][a] = 0.0f;
            t[i][u] = 2.25f;
            t[i][w] = 0.0f;
            t[j][a] = 1.0f;
            t[j][u] = 0.0f;
            t[j][w] = 2.25f;
            t[k][a] = 0.5f;
            t[k][u] = 1.75f;
            t[k][w] = 1.75f;
            CHECK(tribox_overlap(t[0], t[1], t[2], lo, hi) == 0);
            t[i][u] = 2.0f;
            t[j][w] = 2.0f;
            CHECK(tribox_overlap(t[0], t[1], t[2], lo, hi) == 1);
        }
    }
}

/* Every number of a question in exact contact, moved by -3..3 ulps alone and in pairs. */
static void ulp_walk(question *q, int as_float)
{
    double  *number[15];
    question start = *q;
    int      i;
    int      j;
    int      s;

    for (i = 0; i < 15; i++) {
        number[i] = i < 9 ? &q->t.v[i / 3][i % 3] : i < 12 ? &q->lo[i - 9] : &q->hi[i - 12];
    }
    for (i = 0; i < 15; i++) {
        for (s = -3; s <= 3; s++) {
            *q = start;
            j = random_below(15);
            *number[i] = nudge(*number[i], s, as_float);
            question_from_box(q);
            CHECK(ask_all(q));
            *number[j] = nudge(*number[j], random_below(7) - 3, as_float);
            question_from_box(q);
            CHECK(ask_all(q));
        }
    }
    *q = start;
}

/* A box corner, edge or face centre made to coincide exactly with a corner, edge point or inner point of
 * the triangle; all numbers are small multiples of 1/64, so contact is exact, and the walks leave it by
 * ulps. */
static void walks_round_contacts_are_exact(void)
{
    int i;

    random_seed(5);
    for (i = 0; i < TEST_LOOPS(120); i++) {
        question q;
        int      on_triangle = i % 3;       /* corner, edge, inside */
        int      a;
        q.seed = random_state;
        for (a = 0; a < 3; a++) {
            double v0 = random_below(33) - 16;
            double v1 = random_below(33) - 16;
            double v2 = random_below(33) - 16;
            double x = on_triangle == 0 ? v0 : on_triangle == 1 ? (v0 + 3 * v1) / 4 : (v0 + v1 + 2 * v2) / 4;
            double size = 1 + random_below(8);
            q.t.v[0][a] = v0;
            q.t.v[1][a] = v1;
            q.t.v[2][a] = v2;
            switch (random_below(3)) {
            case 0:  q.lo[a] = x;            break;
            case 1:  q.lo[a] = x - size;     break;
            default: q.lo[a] = x - size / 2; break;
            }
            q.hi[a] = q.lo[a] + size;
        }
        ulp_walk(&q, i & 1);
    }
}

static void every_box(const triangle *t, int points)
{
    int boxes = points * (points + 1) / 2;
    int lo_of[32];
    int hi_of[32];
    int count = 0;
    int i;
    int j;

    for (i = 0; i < points; i++) {
        for (j = i; j < points; j++) {
            lo_of[count] = i;
            hi_of[count++] = j;
        }
    }
    for (i = 0; i < boxes * boxes * boxes; i++) {
        question q;
        int      which[3];
        int      a;
        which[0] = i % boxes;
        which[1] = i / boxes % boxes;
        which[2] = i / boxes / boxes;
        q.seed = 0;
        q.t = *t;
        for (a = 0; a < 3; a++) {
            q.lo[a] = lo_of[which[a]];
            q.hi[a] = hi_of[which[a]];
        }
        question_from_box(&q);
        CHECK(ask_all(&q));
    }
}

static void lattice_point(double p[3], int i, int points)
{
    p[0] = i % points;
    p[1] = i / points % points;
    p[2] = i / points / points;
}

/* All triangles with corners in {0,1}^3, every order, against all boxes with faces in {0,1}: points,
 * segments and triangles by boxes that are flat in none to three axes. */
static void all_questions_on_two_points_a_side_are_exact(void)
{
    int i;

    for (i = 0; i < 512; i += TEST_LOOPS(10) == 10 ? 1 : 7) {
        triangle t;
        lattice_point(t.v[0], i % 8, 2);
        lattice_point(t.v[1], i / 8 % 8, 2);
        lattice_point(t.v[2], i / 64, 2);
        every_box(&t, 2);
    }
}

/* Triangles with corners in {0,1,2}^3 up to order (every seventh, all segments and points), against all
 * 216 boxes. */
static void questions_on_three_points_a_side_are_exact(void)
{
    int step = 7 * TEST_SCALE;
    int seen = 0;
    int i;
    int j;
    int k;

    for (i = 0; i < 27; i++) {
        for (j = i; j < 27; j++) {
            for (k = j; k < 27; k++) {
                triangle t;
                seen++;
                if (seen % step != 0 && (k != j || TEST_SCALE > 1)) {
                    continue;
                }
                lattice_point(t.v[seen % 3], i, 3);
                lattice_point(t.v[(seen + 1) % 3], j, 3);
                lattice_point(t.v[(seen + 2) % 3], k, 3);
                every_box(&t, 3);
            }
        }
    }
}

/* Where coordinates are whole and values exact, their sign decides, also within the bound: a corner of the
 * box misses the plane by one unit cubed, the least there is, 32,000 units from corner to corner; as far on
 * the other side of the plane, it touches. One corner is the origin; q lies over the triangle's inside. */
static void planes_missed_by_one_unit_cubed_are_exact(void)
{
    static const int cases[6][3][3] = {     /* v1, v2, q: n.q = 1, found by Euclid's algorithm */
        {{3566, 28895, 31786}, {31285, 1370, 408}, {8282, 8328, 8905}},
        {{30421, 29085, 31046}, {28773, 2704, 3089}, {14777, 4735, 5131}},
        {{29793, 0, 29242}, {0, 30653, 3672}, {7975, 8811, 8883}},
        {{31013, 0, 1220}, {30324, 28393, 28357}, {22726, 17675, 17804}},
        {{29689, 30993, 0}, {0, 1065, 30142}, {13751, 14435, 2265}},
        {{3481, 29546, 28821}, {31451, 30948, 0}, {18241, 24607, 7346}},
    };
    int i;
    int side;
    int as_voxel;

    for (i = 0; i < 6; i++) {
        const int(*c)[3] = cases[i];
        int64_t  n[3];
        int64_t  value = 0;
        int      a;
        for (a = 0; a < 3; a++) {
            const int b = (a + 1) % 3;
            const int d = (a + 2) % 3;
            n[a] = (int64_t)c[0][b] * c[1][d] - (int64_t)c[0][d] * c[1][b];
            value += n[a] * c[2][a];
        }
        CHECK(value == 1);
        for (side = -1; side <= 1; side += 2) {     /* the box is at q and on, along n or against it */
            for (as_voxel = 0; as_voxel < 2; as_voxel++) {
                question q;
                q.seed = 0;
                for (a = 0; a < 3; a++) {
                    q.t.v[0][a] = 0;
                    q.t.v[1][a] = c[0][a];
                    q.t.v[2][a] = c[1][a];
                    q.lo[a] = side * n[a] > 0 ? c[2][a] : c[2][a] - 6;
                    q.hi[a] = q.lo[a] + 6;
                    q.size[a] = 6;
                }
                if (as_voxel) {
                    question_from_voxel(&q);
                } else {
                    question_from_box(&q);
                }
                CHECK(ask_all(&q));
            }
            {
                double corner[3][3];
                double lo[3];
                double hi[3];
                for (a = 0; a < 3; a++) {
                    corner[0][a] = 0;
                    corner[1][a] = c[0][a];
                    corner[2][a] = c[1][a];
                    lo[a] = side * n[a] > 0 ? c[2][a] : c[2][a] - 6;
                    hi[a] = lo[a] + 6;
                }
                CHECK(tribox_overlap_f64(corner[0], corner[1], corner[2], lo, hi) == (side < 0));
            }
        }
    }
}

/* The same by exact signs alone. */
static int by_signs(const double x[15])
{
    tbx_clip clip;

    return tbx_clip_box(&clip, x, x + 3, x + 6, x + 9, x + 12, 0) &&
           tbx_clipped_exact(x, x + 3, x + 6, &clip, 15u);
}

/* Triangles without area have filters of their own; they agree with exact signs: corners that repeat, three on a
 * line (whole numbers of a unit), and along an axis (tenths). */
static void triangles_without_area_are_as_their_signs_say(void)
{
    uint64_t seed = 7;
    int i;

    for (i = 0; i < 60000 / TEST_SCALE; i++) {
        float f[15];
        double x[15];
        double tenths[15];
        int k;

        for (k = 0; k < 15; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            f[k] = (float)((int64_t)seed >> 40) / 8388608.0f;
        }
        for (k = 0; k < 3; k++) {
            const float size = (float)((seed >> (20 + k)) & 255u) / 256.0f;

            f[12 + k] = f[9 + k] + size;
            if (i % 5 < 3) {        /* v0 = v1, v1 = v2, v2 = v0 */
                f[3 * ((i + 1) % 3) + k] = f[3 * (i % 3) + k];
            } else if (i % 5 == 3) {
                f[k] = (float)(int)(f[k] * 64.0f) / 64.0f;
                f[3 + k] = f[k] + (float)(int)(f[3 + k] * 16.0f) / 16.0f;
                f[6 + k] = f[k] + 2.0f * (f[3 + k] - f[k]);
            } else if (k > 0) {
                f[3 + k] = f[6 + k] = f[k];
            }
        }
        for (k = 0; k < 15; k++) {
            x[k] = (double)f[k];
            tenths[k] = (double)(int)(f[k] * 10.0f) / 10.0;
        }
        CHECK(tribox_overlap(f, f + 3, f + 6, f + 9, f + 12) == by_signs(x));
        CHECK(tribox_overlap_f64(x, x + 3, x + 6, x + 9, x + 12) == by_signs(x));
        CHECK(tribox_overlap_f64(tenths, tenths + 3, tenths + 6, tenths + 9, tenths + 12) == by_signs(tenths));
    }
}

int main(void)
{
    RUN(triangles_without_area_are_as_their_signs_say);
    RUN(touching_face_overlaps_and_next_float_does_not);
    RUN(touching_plane_overlaps_and_next_float_does_not);
    RUN(touching_edges_overlap_and_next_float_does_not);
    RUN(point_triangle_overlaps_when_inside_the_faces);
    RUN(inside_and_across_both_overlap);
    RUN(projected_edges_separate_on_every_axis);
    RUN(walks_round_contacts_are_exact);
    RUN(all_questions_on_two_points_a_side_are_exact);
    RUN(questions_on_three_points_a_side_are_exact);
    RUN(planes_missed_by_one_unit_cubed_are_exact);
    return test_report("test_overlap");
}
