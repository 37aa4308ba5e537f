/* The grid walk: every voxel of a region against the oracle, for spans of both types and for the fill,
 * under every rule; order, disjointness, maximality and counts of the spans; the ends of the index range. */
#include "tribox.h"

#include <limits.h>
#include <math.h>

#include "voxels.h"

static void every_voxel_agrees_with_the_oracle(int kind, int as_float, int count)
{
    static voxels v;
    int           i;

    random_seed((uint64_t)kind * 7919u + (uint64_t)as_float + 80);
    for (i = 0; i < TEST_LOOPS(count); i++) {
        voxels_make(&v, kind, as_float);
        CHECK(voxels_ask_all(&v));
    }
}

/* Random triangles about regions of any shape, far and near, of negative and large indices. */
static void general_triangles_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_GENERAL, FLOATS, 700);
    every_voxel_agrees_with_the_oracle(GRID_GENERAL, DOUBLES, 500);
}

/* Corners on grid planes: walls, floors, 45-degree faces, cut by the region on every side; ulps off, too. */
static void aligned_triangles_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_ALIGNED, FLOATS, 1000);
    every_voxel_agrees_with_the_oracle(GRID_ALIGNED, DOUBLES, 700);
}

/* Segments and points on the lattice. */
static void degenerate_triangles_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_DEGENERATE, FLOATS, 700);
    every_voxel_agrees_with_the_oracle(GRID_DEGENERATE, DOUBLES, 500);
}

/* Triangles of up to a few voxels take the small paths: within one voxel it is set; one voxel thick on two
 * axes, every voxel of the index box is set (the box is a row, and a connected set that reaches both ends
 * of a row passes all of it); one voxel thick on one axis, the other two axes' conditions are implied.
 * Thin takes none of these. */
static void tiny_triangles_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_TINY, FLOATS, 1500);
    every_voxel_agrees_with_the_oracle(GRID_TINY, DOUBLES, 1000);
}

/* A triangle of up to four voxels on each axis, mostly within the region. kind 0: any; 1: an edge along an axis; 2: corners
 * beside planes; 3: three corners almost on a line; 4: two corners level on an axis; 5: two that are one; 6: an edge, seen
 * along an axis, and 7: the plane passes a grid point by rounding. */
static void make_few(voxels *v, int kind)
{
    const int first = random_below(3);
    const int start = random_below(6);
    int       i;
    int       k;

    make_grid(&v->grid, 1);
    v->seed = random_state;
    for (k = 0; k < 3; k++) {
        double most = 0.1 + (random_signed() + 1) * 1.95;
        double from;

        v->grid.lo[k] = start == 0 ? 524288 - 4 : start == 1 ? -524288 - 2 : v->grid.lo[k];
        v->grid.hi[k] = v->grid.lo[k] + 6;
        from = v->grid.lo[k] + (random_signed() + 1) / 2 * (6 - most);
        for (i = 0; i < 3; i++) {
            double at = from + (random_signed() + 1) / 2 * most;

            if (kind == 2 && random_below(3) == 0) {
                at = floor(at) + random_signed() * pow(2, -18 - random_below(22));
            }
            v->t.v[i][k] = grid_plane(&v->grid, k, at);
        }
    }
    for (k = 0; k < 3; k++) {
        double p = floor((v->grid.lo[k] + 2.5) + random_signed());

        if (kind >= 6) {
            double u = random_signed() * 1.7;
            double w = random_signed() * 1.7;

            v->t.v[0][k] = grid_plane(&v->grid, k, p + u);
            v->t.v[1][k] = grid_plane(&v->grid, k, kind == 6 && k != first ? p - 0.7 * u : p + w);
            v->t.v[2][k] = grid_plane(&v->grid, k, kind == 6 ? p + random_signed() : p - (0.4 * u + 0.7 * w));
        }
        if ((kind == 1 && k != first) || (kind == 4 && k == first) || kind == 5) {
            v->t.v[1][k] = v->t.v[0][k];
        }
        if (kind == 3) {
            v->t.v[2][k] = 0.25 * v->t.v[0][k] + 0.75 * v->t.v[1][k] + random_signed() * 1e-5 * v->grid.size[k];
        }
    }
}

/* Most calls for one triangle end before the walk: boxes of up to 4^3 voxels are decided in floats, unless a bound leaves
 * something unsure, or the numbers are large. An edge along an axis says nothing in the plane across it. */
static void triangles_of_few_voxels_are_exact_on_every_voxel(void)
{
    static voxels v;
    int           i;

    random_seed(4711);
    for (i = 0; i < TEST_LOOPS(2400); i++) {
        make_few(&v, i % 8);
        if (random_below(2)) {
            int j;

            for (j = 0; j < 9; j++) {
                v.t.v[j / 3][j % 3] = (double)(float)v.t.v[j / 3][j % 3];
            }
        }
        voxels_finish(&v);
        CHECK(voxels_ask_spans(&v, 0) && voxels_ask_spans(&v, every_rule[i / 8 % 4]));
    }
}

/* Triangles a million times larger than the region. */
static void huge_triangles_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_HUGE, FLOATS, 600);
    every_voxel_agrees_with_the_oracle(GRID_HUGE, DOUBLES, 500);
}

/* An index box of few voxels says nothing of a corner beyond the region: an edge from one corner within to one as far
 * as 2^40 voxels passes a lattice point by rounding. A mesh of doubles in map coordinates has such. */
static void edges_from_a_small_region_to_far_away_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_PASS, FLOATS, 600);
    every_voxel_agrees_with_the_oracle(GRID_PASS, DOUBLES, 1500);
}

/* Planes almost parallel to an axis: the bound on i is a quotient of two small differences. */
static void steep_triangles_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_STEEP, FLOATS, 700);
    every_voxel_agrees_with_the_oracle(GRID_STEEP, DOUBLES, 700);
}

/* Narrow triangles across many rows. */
static void narrow_triangles_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_LINE, FLOATS, 300);
    every_voxel_agrees_with_the_oracle(GRID_LINE, DOUBLES, 200);
}

/* Lattice grids scaled by a power of two per axis, from subnormal sizes to 2^900: the truth is that of the
 * unscaled. */
static void extreme_scales_are_exact_on_every_voxel(void)
{
    static const int exponents[6] = {-1070, -600, -140, 90, 600, 1000};
    static voxels    v;
    int              i;

    random_seed(91);
    for (i = 0; i < TEST_LOOPS(400); i++) {
        int a;
        v.seed = random_state;
        for (a = 0; a < 3; a++) {
            double scale = power_of_two(exponents[random_below(6)]);
            int    j;
            scale *= power_of_two(random_below(3));
            v.grid.origin[a] = (random_below(5) - 2) * scale;
            v.grid.size[a] = (1 + random_below(2)) * scale;
            v.grid.lo[a] = random_below(5) - 4;
            v.grid.hi[a] = v.grid.lo[a] + 1 + random_below(5);
            for (j = 0; j < 3; j++) {
                v.t.v[j][a] = (random_below(12) - 6) * scale;
            }
        }
        if (random_below(2)) {
            walk_corners(&v, 0);
        }
        voxels_finish(&v);
        CHECK(voxels_ask_all(&v));
    }
}

/* Regions at both ends of the index range: voxel INT_MAX - 1 is the last, INT_MIN the first. */
static void ends_of_the_index_range_are_exact_on_every_voxel(void)
{
    static voxels v;
    int           i;

    random_seed(92);
    for (i = 0; i < TEST_LOOPS(400); i++) {
        int a;
        v.seed = random_state;
        for (a = 0; a < 3; a++) {
            int n = 1 + random_below(5);
            int end = random_below(3);
            v.grid.size[a] = random_below(2) ? 1 : 0.1;
            v.grid.origin[a] = random_below(2) ? 0 : -7.25;
            v.grid.lo[a] = end == 0 ? INT_MIN : end == 1 ? INT_MAX - n : -n / 2;
            v.grid.hi[a] = v.grid.lo[a] + n;
        }
        voxels_corners(&v, i % GRID_KINDS, i & 1);
        voxels_finish(&v);
        CHECK(voxels_ask_all(&v));
    }
}

/* The walk and the prepared test answer alike where p = origin + i*size is a double. */
static void spans_agree_with_the_prepared_test(void)
{
    static voxels v;
    int           i;

    random_seed(93);
    for (i = 0; i < TEST_LOOPS(500); i++) {
        walk                  w;
        tribox_tri            tri;
        unsigned              flags = every_rule[i % 4];
        int                   ok = 1;
        int                   a;
        int                   k;
        v.seed = random_state;
        for (a = 0; a < 3; a++) {
            v.grid.size[a] = (1 + random_below(4)) / 4.0;
            v.grid.origin[a] = random_below(9) / 4.0;
            v.grid.lo[a] = random_below(9) - 6;
            v.grid.hi[a] = v.grid.lo[a] + 1 + random_below(8);
        }
        voxels_corners(&v, i % GRID_KINDS, 1);
        v.grid.flags = flags;
        for (a = 0; a < 3; a++) {
            v.n[a] = v.grid.hi[a] - v.grid.lo[a];
        }
        walk_start(&w, &v);
        tribox_grid_spans_f64(&v.grid, v.t.v[0], v.t.v[1], v.t.v[2], walk_emit, &w);
        tribox_tri_init_f64(&tri, v.t.v[0], v.t.v[1], v.t.v[2], v.grid.size, flags);
        for (k = 0; k < v.n[0] * v.n[1] * v.n[2]; k++) {
            double p[3];
            p[0] = grid_plane(&v.grid, 0, v.grid.lo[0] + k % v.n[0]);
            p[1] = grid_plane(&v.grid, 1, v.grid.lo[1] + k / v.n[0] % v.n[1]);
            p[2] = grid_plane(&v.grid, 2, v.grid.lo[2] + k / v.n[0] / v.n[1]);
            ok &= tribox_tri_test_f64(&tri, p) == w.set[k];
        }
        if (!CHECK(ok)) {
            voxels_print(&v, "spans and tribox_tri_test_f64 differ", flags);
        }
    }
}

/* Every region of a partition of a large region emits its part of the large region's voxels: cuts on all
 * sides. */
static void cut_regions_emit_their_part_of_the_whole(void)
{
    static voxels v;
    int           i;

    random_seed(94);
    for (i = 0; i < TEST_LOOPS(600); i++) {
        tribox_grid           part;
        size_t                whole;
        size_t                sum = 0;
        int                   cut[3];
        int                   k;
        int                   a;
        v.seed = random_state;
        make_grid(&v.grid, 1);
        voxels_corners(&v, i % GRID_KINDS, 0);
        v.grid.flags = every_rule[random_below(4)];
        for (a = 0; a < 3; a++) {
            v.grid.hi[a] += 20;
            cut[a] = v.grid.lo[a] + random_below(v.grid.hi[a] - v.grid.lo[a] + 1);
        }
        whole = tribox_grid_spans_f64(&v.grid, v.t.v[0], v.t.v[1], v.t.v[2], 0, 0);
        for (k = 0; k < 8; k++) {
            part = v.grid;
            for (a = 0; a < 3; a++) {
                if (k >> a & 1) {
                    part.lo[a] = cut[a];
                } else {
                    part.hi[a] = cut[a];
                }
            }
            sum += tribox_grid_spans_f64(&part, v.t.v[0], v.t.v[1], v.t.v[2], 0, 0);
        }
        if (!CHECK(whole == sum)) {
            voxels_print(&v, "eight parts and the whole differ", v.grid.flags);
        }
    }
}

typedef struct last_span {
    int x0;
    int x1;
    int y;
    int z;
    int spans;
} last_span;

static void keep_last_span(void *user, int x0, int x1, int y, int z)
{
    last_span *s = (last_span *)user;

    s->x0 = x0;
    s->x1 = x1;
    s->y = y;
    s->z = z;
    s->spans++;
}

/* A segment along x through the whole index range is one span of 2^32 - 1 voxels: lengths are unsigned. */
static void one_row_through_all_indices_is_one_span(void)
{
    tribox_grid  grid = {{0, 0, 0}, {1, 1, 1}, {INT_MIN, 3, -4}, {INT_MAX, 4, -3}, 0};
    const double v0[3] = {-1e12, 3.5, -3.5};
    const double v1[3] = {1e12, 3.5, -3.5};
    last_span    s = {0, 0, 0, 0, 0};

    CHECK(tribox_grid_spans_f64(&grid, v0, v1, v1, keep_last_span, &s) == (size_t)4294967295u);
    CHECK(s.spans == 1 && s.x0 == INT_MIN && s.x1 == INT_MAX - 1 && s.y == 3 && s.z == -4);
    grid.flags = TRIBOX_THIN;
    CHECK(tribox_grid_spans_f64(&grid, v0, v1, v1, 0, 0) == (size_t)4294967295u);
}

/* More voxels than size_t counts saturate it: a sheet of 2^32 - 1 by 3 voxels, twice set as its plane is
 * shared. */
static void counts_saturate(void)
{
    tribox_grid       grid = {{0, 0, 0}, {1, 1, 1}, {INT_MIN, 0, -1}, {INT_MAX, 3, 1}, 0};
    const double      v0[3] = {-1e13, -1e13, 0};
    const double      v1[3] = {1e13, -1e13, 0};
    const double      v2[3] = {0, 1e13, 0};
    const uint64_t    exact = (uint64_t)4294967295u * 6;
    const size_t      expected = exact > SIZE_MAX ? SIZE_MAX : (size_t)exact;

    CHECK(tribox_grid_spans_f64(&grid, v0, v1, v2, 0, 0) == expected);
    /* no grid has the rows for it where size_t has 64 bits, so the sum itself is asked */
    CHECK(tbx_saturating_add((size_t)-1, 2) == (size_t)-1);
    CHECK(tbx_saturating_add((size_t)-3, 2) == (size_t)-1);
}

/* Voxel sizes near 1e308: differences of corner and origin overflow, so the first guess at an index is an
 * end of the region, many voxels off. */
static void grids_over_all_doubles_are_exact_on_every_voxel(void)
{
    static voxels v;
    int           i;

    random_seed(97);
    for (i = 0; i < TEST_LOOPS(60); i++) {
        int far_axis = i % 3;
        int a;
        v.seed = random_state;
        for (a = 0; a < 3; a++) {
            int sign = random_below(2) ? 1 : -1;
            int j;
            v.grid.origin[a] = a == far_axis ? sign * -1.7e308 : 0;
            v.grid.size[a] = a == far_axis ? 1e307 + random_below(9) * 1e307 : 1;
            v.grid.lo[a] = a == far_axis ? -16 : 0;
            v.grid.hi[a] = a == far_axis ? 48 : 3;
            for (j = 0; j < 3; j++) {
                volatile double share = random_signed(); /* -ffast-math would multiply the terms of the sum: infinity */
                v.t.v[j][a] = a != far_axis ? 3 * share : i % 2 ? 1.7e308 : 1.7e308 * share;
            }
        }
        voxels_finish(&v);
        CHECK(voxels_ask_all(&v));
    }
}

/* Triangles in a plane at 1.7e308, where the sum of two coordinates' magnitudes is infinite: a layer of
 * the grid like any other. */
static void layers_at_the_largest_doubles_are_exact_on_every_voxel(void)
{
    static voxels v;
    int           i;

    random_seed(98);
    for (i = 0; i < TEST_LOOPS(60); i++) {
        int flat = i % 3;
        int a;
        v.seed = random_state;
        for (a = 0; a < 3; a++) {
            int j;
            v.grid.origin[a] = a == flat ? 1.7e308 : 0;
            v.grid.size[a] = a == flat ? power_of_two(random_below(1000) - 100) : 1;
            v.grid.lo[a] = a == flat ? -2 : 0;
            v.grid.hi[a] = a == flat ? 2 : 5;
            for (j = 0; j < 3; j++) {
                v.t.v[j][a] = a == flat ? 1.7e308 : 2.5 + 3 * random_signed();
            }
        }
        voxels_finish(&v);
        CHECK(voxels_ask_all(&v));
    }
}

/* Triangles of 1e-200 about a corner of voxels of size 1: their bounds of error are out of every range. */
static void vanishing_triangles_are_exact_on_every_voxel(void)
{
    static voxels v;
    int           i;

    random_seed(99);
    for (i = 0; i < TEST_LOOPS(200); i++) {
        int a;
        v.seed = random_state;
        for (a = 0; a < 3; a++) {
            int j;
            v.grid.origin[a] = 0;
            v.grid.size[a] = 1;
            v.grid.lo[a] = -2;
            v.grid.hi[a] = 2;
            for (j = 0; j < 3; j++) {
                v.t.v[j][a] = (random_below(9) - 4) * power_of_two(-660);
            }
        }
        voxels_finish(&v);
        CHECK(voxels_ask_all(&v));
    }
}

/* Whole coordinates on a grid whose planes are not: sizes, or the origin, of which no power of two makes
 * whole numbers. */
static void whole_corners_on_a_broken_grid_are_exact_on_every_voxel(void)
{
    static voxels v;
    int           i;

    random_seed(100);
    for (i = 0; i < TEST_LOOPS(200); i++) {
        int a;
        v.seed = random_state;
        for (a = 0; a < 3; a++) {
            int j;
            v.grid.origin[a] = i % 2 ? 1 : 0.1;
            v.grid.size[a] = i % 4 == 0 ? 1 : 1.1;
            v.grid.lo[a] = -1;
            v.grid.hi[a] = 6;
            for (j = 0; j < 3; j++) {
                v.t.v[j][a] = random_below(9) - 1;
            }
        }
        voxels_finish(&v);
        CHECK(voxels_ask_all(&v));
    }
}

/* More than 2^20 rows, in y or in z: a segment along each axis is a row of that many voxels. */
static void a_million_rows_are_counted(void)
{
    const size_t n = (size_t)1048580;
    int          a;

    for (a = 0; a < 3; a++) {
        tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {-4, -4, -4}, {2000000, 2000000, 2000000}, 0};
        double      v0[3] = {0.5, 0.5, 0.5};
        double      v1[3] = {0.5, 0.5, 0.5};
        v1[a] = (double)n - 0.5;
        CHECK(tribox_grid_spans_f64(&grid, v0, v1, v1, 0, 0) == n);
        v1[(a + 1) % 3] = 1.25;     /* and one that crosses a grid plane: one voxel more */
        CHECK(tribox_grid_spans_f64(&grid, v0, v1, v1, 0, 0) == n + 1);
    }
}

/* The largest region there is, and a triangle of two voxels: the cost is the triangle's. */
static void small_triangle_in_the_largest_region_is_cheap(void)
{
    tribox_grid  grid = {{0, 0, 0}, {1, 1, 1}, {INT_MIN, INT_MIN, INT_MIN}, {INT_MAX, INT_MAX, INT_MAX}, 0};
    const double v0[3] = {7.5, -8.5, 1000000000.5};
    const double v1[3] = {8.5, -8.5, 1000000000.5};
    last_span    s = {0, 0, 0, 0, 0};

    CHECK(tribox_grid_spans_f64(&grid, v0, v1, v1, keep_last_span, &s) == 2);
    CHECK(s.spans == 1 && s.x0 == 7 && s.x1 == 8 && s.y == -9 && s.z == 1000000000);
}

/* A huge triangle over a small region costs the region: a million of these would never end otherwise. */
static void huge_triangle_over_a_small_region_is_cheap(void)
{
    tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {4, 4, 4}, 0};
    const float v0[3] = {-3e38f, -3e38f, -3e38f};
    const float v1[3] = {3e38f, -3e38f, 3e38f};
    const float v2[3] = {0, 3e38f, 0};
    int         i;

    for (i = 0; i < 1000; i++) {
        size_t count = tribox_grid_spans(&grid, v0, v1, v2, 0, 0);
        CHECK(count > 0 && count <= 64);
    }
}

/* A plane almost parallel to x: the exact crossing is 200.00000000000006 voxels along, plain double
 * arithmetic says something else entirely. Found as: v1 - v0 and v2 - v0 nearly parallel to x, differing
 * in their last bits. */
static void plane_almost_parallel_to_x_is_exact(void)
{
    static voxels v;
    int           i;

    random_seed(95);
    for (i = 0; i < TEST_LOOPS(300); i++) {
        double tilt = power_of_two(-30 - random_below(22));
        int    j;
        v.seed = random_state;
        for (j = 0; j < 3; j++) {
            v.grid.origin[j] = 0;
            v.grid.size[j] = 1;
            v.grid.lo[j] = j == 0 ? 190 + random_below(10) : 0;
            v.grid.hi[j] = v.grid.lo[j] + (j == 0 ? 12 : 3);
        }
        for (j = 0; j < 3; j++) {
            v.t.v[j][0] = j == 1 ? 4096 : -4096 + random_below(3);
            v.t.v[j][1] = j == 2 ? 8 : -5;
            v.t.v[j][2] = 1 + (v.t.v[j][0] - 200) * tilt + (j == 2 ? random_signed() * tilt : 0);
        }
        voxels_finish(&v);
        CHECK(voxels_ask_all(&v));
    }
}

/* Bounds of rows and layers are kept for 64 at a time: triangles over many more, in y and in z, set the
 * voxels that the prepared test finds one by one. */
static size_t rows_emitted;
static unsigned char rows_hit[4][150][150];

static void rows_mark(void *user, int x0, int x1, int y, int z)
{
    (void)user;
    for (; x0 <= x1; x0++) {
        rows_hit[x0][y][z]++;
        rows_emitted++;
    }
}

static void more_rows_than_are_kept_at_once_are_exact(void)
{
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {4, 150, 150}, 0};
    const double size[3] = {1, 1, 1};
    int i;

    for (i = 0; i < TEST_LOOPS(8); i++) {
        double v[3][3];
        tribox_tri tri;
        size_t expected = 0;
        int bad = 0;
        int x;
        int y;
        int z;
        for (x = 0; x < 3; x++) {
            v[x][0] = random_below(5) + random_signed();
            v[x][1] = (x == 0 ? 2 : 75 * x) + random_signed();
            v[x][2] = (x == 2 ? 3 : 140 - 60 * x) + random_signed();
        }
        tribox_tri_init_f64(&tri, v[0], v[1], v[2], size, 0);
        memset(rows_hit, 0, sizeof rows_hit);
        rows_emitted = 0;
        tribox_grid_spans_f64(&grid, v[0], v[1], v[2], rows_mark, NULL);
        for (x = 0; x < 4; x++) {
            for (y = 0; y < 150; y++) {
                for (z = 0; z < 150; z++) {
                    const double p[3] = {x, y, z};
                    const int hit = tribox_tri_test_f64(&tri, p);
                    expected += (size_t)hit;
                    bad += hit != rows_hit[x][y][z];
                }
            }
        }
        CHECK(bad == 0);
        CHECK(rows_emitted == expected && expected > 0);
    }
}

/* ---- spans and fills of meshes ------------------------------------------------------------------------- */

enum { MESH_TRIANGLES = 40, MESH_VOXELS = 24 };

/* What tribox_mesh_spans gives, per triangle: how many spans, a sum that depends on their order, voxels. */
typedef struct mesh_told {
    size_t   spans[MESH_TRIANGLES];
    uint64_t order[MESH_TRIANGLES];
    size_t   voxels[MESH_TRIANGLES];
    int      bad;
    size_t   last;
    int      any;
} mesh_told;

static void tell(mesh_told *m, size_t t, int x0, int x1, int y, int z)
{
    const uint64_t span = (uint64_t)(uint32_t)x0 * 31 + (uint64_t)(uint32_t)x1 * 1009 +
                          (uint64_t)(uint32_t)y * 65537 + (uint64_t)(uint32_t)z * 16777259;

    m->spans[t]++;
    m->order[t] = m->order[t] * UINT64_C(0x9e3779b97f4a7c15) + span;
    m->voxels[t] += (size_t)(x1 - x0 + 1);
}

static void tell_mesh(void *user, size_t t, int x0, int x1, int y, int z)
{
    mesh_told *m = (mesh_told *)user;

    if (t >= MESH_TRIANGLES) {
        m->bad = 1;
        return;
    }
    m->bad |= m->spans[t] != 0 && (!m->any || m->last != t);    /* those of a triangle come together */
    m->last = t;
    m->any = 1;
    tell(m, t, x0, x1, y, z);
}

static size_t one_triangle;

static void tell_one(void *user, int x0, int x1, int y, int z)
{
    tell((mesh_told *)user, one_triangle, x0, x1, y, z);
}

/* A mesh of small and large triangles about a region, on and off its planes, some of them NaN or infinite. */
static void make_mesh(tribox_grid *grid, double v[MESH_TRIANGLES][3][3], int kind)
{
    const uint64_t infinite = UINT64_C(0x7ff0000000000000);
    const uint64_t nan_bits = UINT64_C(0x7ff8000000000000);
    int t;
    int i;
    int k;

    for (k = 0; k < 3; k++) {
        grid->size[k] = kind % 3 == 0 ? 0.1 : kind % 3 == 1 ? 0.25 : 1.0 / 3;
        grid->origin[k] = kind % 5 == 4 ? 448262.25 + 1000 * k : kind % 5 == 3 ? 1e4 + 0.1 : -0.5;
        grid->lo[k] = random_below(9) - 5;
        grid->hi[k] = grid->lo[k] + 1 + random_below(MESH_VOXELS);
    }
    for (t = 0; t < MESH_TRIANGLES; t++) {
        const double extent = t % 4 == 0 ? 30 : t % 4 == 1 ? 2 : t % 4 == 2 ? 4 : 8;
        double centre[3];
        for (k = 0; k < 3; k++) {
            centre[k] = grid->lo[k] + (grid->hi[k] - grid->lo[k]) * (0.5 + random_signed());
        }
        for (i = 0; i < 3; i++) {
            for (k = 0; k < 3; k++) {
                double x = centre[k] + extent * 0.5 * random_signed();
                x = random_below(4) ? x : (double)(int)x;
                x = grid_plane(grid, k, x);
                v[t][i][k] = kind % 2 ? rounded_to_float(x) : x;
                if (random_below(40) == 0 && t > 0) {
                    v[t][i][k] = v[t - 1][i][k];
                }
            }
        }
    }
    memcpy(&v[3][1][2], &infinite, sizeof infinite);
    memcpy(&v[7][0][0], &nan_bits, sizeof nan_bits);
}

/* The spans of a mesh are those of its triangles one by one, in their order; the fill sets their union; floats that are
 * doubles give the same; all with indices and strides, too. */
static void spans_and_fills_of_meshes_are_those_of_their_triangles(void)
{
    int run;

    random_seed(140);
    for (run = 0; run < TEST_LOOPS(600); run++) {
        static double      v[MESH_TRIANGLES][3][3];
        static float       f[MESH_TRIANGLES * 9];
        static uint64_t    bits[3][MESH_VOXELS * MESH_VOXELS];
        static mesh_told   by_mesh;
        static mesh_told   by_float;
        static mesh_told   one_by_one;
        uint32_t           index[MESH_TRIANGLES * 3];
        tribox_grid        grid;
        tribox_mesh_f64    mesh;
        tribox_mesh        narrow;
        size_t             sum = 0;
        size_t             t;
        size_t             words;
        int                i;
        grid.flags = every_rule[run % 4];
        make_mesh(&grid, v, run);
        for (i = 0; i < MESH_TRIANGLES * 9; i++) {
            const uint32_t infinite = 0x7f800000u;
            if (i / 9 == 3 || i / 9 == 7) { /* neither is a number to convert */
                memcpy(&f[i], &infinite, sizeof infinite);
            } else {
                f[i] = (float)v[i / 9][i / 3 % 3][i % 3];
            }
        }
        for (i = 0; i < MESH_TRIANGLES * 3; i++) {
            index[i] = (uint32_t)i;
        }
        mesh.positions = &v[0][0][0];
        mesh.stride = run & 4 ? 3 * sizeof(double) : 0;
        mesh.indices = run & 8 ? index : 0;
        mesh.triangles = MESH_TRIANGLES;
        narrow.positions = f;
        narrow.stride = 0;
        narrow.indices = mesh.indices;
        narrow.triangles = MESH_TRIANGLES;
        memset(bits, 0, sizeof bits);
        memset(&by_mesh, 0, sizeof by_mesh);
        memset(&by_float, 0, sizeof by_float);
        memset(&one_by_one, 0, sizeof one_by_one);
        words = tribox_grid_words(&grid);
        for (t = 0; t < MESH_TRIANGLES; t++) {
            one_triangle = t;
            sum += tribox_grid_spans_f64(&grid, v[t][0], v[t][1], v[t][2], tell_one, &one_by_one);
        }
        CHECK(tribox_mesh_spans_f64(&grid, &mesh, tell_mesh, &by_mesh) == sum);
        CHECK(tribox_mesh_spans_f64(&grid, &mesh, 0, 0) == sum);
        CHECK(!by_mesh.bad && memcmp(by_mesh.spans, one_by_one.spans, sizeof by_mesh.spans) == 0);
        if (!CHECK(memcmp(by_mesh.order, one_by_one.order, sizeof by_mesh.order) == 0)) {
            printf("  run %d\n", run);
        }
        tribox_grid_fill_f64(&grid, &mesh, bits[0]);
        for (t = 0; t < MESH_TRIANGLES; t++) {
            tribox_mesh_f64 single = mesh;
            single.positions = v[t][0];
            single.indices = 0;
            single.triangles = 1;
            tribox_grid_fill_f64(&grid, &single, bits[1]);
        }
        CHECK(memcmp(bits[0], bits[1], words * sizeof(uint64_t)) == 0);
        for (t = 0, sum = 0; t < words; t++) {
            uint64_t w = bits[0][t];
            for (; w != 0; w &= w - 1) {
                sum++;
            }
        }
        {
            size_t found = 0;
            int x;
            int y;
            int z;
            for (z = grid.lo[2]; z < grid.hi[2]; z++) {
                for (y = grid.lo[1]; y < grid.hi[1]; y++) {
                    for (x = grid.lo[0]; x < grid.hi[0]; x++) {
                        found += (size_t)tribox_grid_get(&grid, bits[0], x, y, z);
                    }
                }
            }
            CHECK(found == sum);
        }
        if (run & 1) { /* all of it floats */
            CHECK(tribox_mesh_spans(&grid, &narrow, tell_mesh, &by_float) ==
                  tribox_mesh_spans_f64(&grid, &mesh, 0, 0));
            CHECK(memcmp(by_float.order, by_mesh.order, sizeof by_mesh.order) == 0 && !by_float.bad);
            tribox_grid_fill(&grid, &narrow, bits[2]);
            CHECK(memcmp(bits[0], bits[2], words * sizeof(uint64_t)) == 0);
        }
    }
}

typedef struct painted {
    const tribox_grid *grid;
    uint64_t          *bits;
} painted;

static void paint(void *user, size_t t, int x0, int x1, int y, int z)
{
    const painted     *p = (const painted *)user;
    const tribox_grid *g = p->grid;
    const size_t       row_words = (size_t)(g->hi[0] - g->lo[0] + 63) / 64;
    const size_t       row = (size_t)(z - g->lo[2]) * (size_t)(g->hi[1] - g->lo[1]) + (size_t)(y - g->lo[1]);
    int                x;

    (void)t;
    for (x = x0 - g->lo[0]; x <= x1 - g->lo[0]; x++) {
        p->bits[row * row_words + (size_t)(x >> 6)] |= (uint64_t)1 << (x & 63);
    }
}

/* Spans painted are the fill, as floats and as doubles: a mesh of a few hundred small triangles, corners on and off planes. */
static void spans_of_a_mesh_paint_its_fill(void)
{
    int run;

    random_seed(141);
    for (run = 0; run < TEST_LOOPS(60); run++) {
        enum { TRIANGLES = 700, N = 80 };
        static float    f[TRIANGLES * 9];
        static double   d[TRIANGLES * 9];
        static uint64_t bits[4][N * N * 2];
        tribox_grid     grid = {{0, 0, 0}, {0.1, 0.1, 0.1}, {0, 0, 0}, {N, N, N}, 0};
        tribox_mesh     mesh;
        tribox_mesh_f64 mesh_f64;
        painted         to;
        int             t;
        int             k;
        grid.flags = every_rule[run % 4];
        for (k = 0; k < 3; k++) {
            grid.size[k] = run % 3 == 0 ? 0.1 : run % 3 == 1 ? 0.0625 : 0.75;
        }
        for (t = 0; t < TRIANGLES; t++) {
            const double extent = t % 5 == 0 ? 9 : t % 5 == 1 ? 1 : t % 5 == 2 ? 2 : t % 5 == 3 ? 3.5 : 20;
            double       c[3];
            for (k = 0; k < 3; k++) {
                c[k] = N * (0.5 + 0.55 * random_signed());
            }
            for (k = 0; k < 9; k++) {
                double x = c[k % 3] + extent * 0.5 * random_signed();
                x = run % 4 == 3 ? (double)(int)(2 * x) / 2 : x;
                d[9 * t + k] = rounded_to_float(x * grid.size[k % 3]);
                f[9 * t + k] = (float)d[9 * t + k];
            }
        }
        mesh.positions = f;
        mesh_f64.positions = d;
        mesh.stride = mesh_f64.stride = 0;
        mesh.indices = mesh_f64.indices = 0;
        mesh.triangles = mesh_f64.triangles = TRIANGLES;
        memset(bits, 0, sizeof bits);
        to.grid = &grid;
        to.bits = bits[0];
        CHECK(tribox_mesh_spans(&grid, &mesh, paint, &to) == tribox_mesh_spans_f64(&grid, &mesh_f64, 0, 0));
        to.bits = bits[1];
        tribox_mesh_spans_f64(&grid, &mesh_f64, paint, &to);
        tribox_grid_fill(&grid, &mesh, bits[2]);
        tribox_grid_fill_f64(&grid, &mesh_f64, bits[3]);
        CHECK(memcmp(bits[0], bits[1], sizeof bits[0]) == 0);
        CHECK(memcmp(bits[0], bits[2], sizeof bits[0]) == 0);
        CHECK(memcmp(bits[0], bits[3], sizeof bits[0]) == 0);
    }
}

typedef struct told_rows {
    int x[1024][4];
    int n;
} told_rows;

static void tell_row(void *user, int x0, int x1, int y, int z)
{
    told_rows *to = (told_rows *)user;
    to->x[to->n][0] = x0;
    to->x[to->n][1] = x1;
    to->x[to->n][2] = y;
    to->x[to->n++][3] = z;
}

/* Numbers that no sum of products would hold have the rows of the same numbers in range, more rows than are
 * remembered, too. */
static void rows_of_numbers_out_of_range_are_those_in_range(void)
{
    static told_rows in;
    static told_rows out;
    tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {64, 160, 4}, 0};
    int         run;
    int         i;
    for (run = 0; run < 2; run++) {
        tribox_grid huge_grid = grid;
        double v[9];
        double far_off[9];
        for (i = 0; i < 9; i++) {
            static const double at[2][9] = {{1.5, 2.5, 0.25, 60.25, 70.5, 3.75, 20.5, 157.25, 1.5},
                                            {3.0, 150.75, 0.5, 30.5, 3.5, 1.25, 62.5, 80.0, 3.5}};
            v[i] = at[run][i];
            far_off[i] = ldexp(v[i], 400);
        }
        for (i = 0; i < 3; i++) {
            huge_grid.size[i] = ldexp(1.0, 400);
        }
        in.n = out.n = 0;
        CHECK(tribox_grid_spans_f64(&grid, v, v + 3, v + 6, tell_row, &in) ==
              tribox_grid_spans_f64(&huge_grid, far_off, far_off + 3, far_off + 6, tell_row, &out));
        CHECK(in.n > 150 && in.n == out.n && memcmp(in.x, out.x, sizeof in.x) == 0);
    }
}

/* More bits than the caches hold are asked for ahead of their use: the fill is still what its spans paint. */
static void a_fill_of_two_mebibytes_is_its_spans(void)
{
    enum { TRIANGLES = 2000, N = 256 };
    static float    f[TRIANGLES * 9];
    static uint64_t bits[2][N * N * N / 64];
    tribox_grid     grid = {{-0.5, 0, 0.5}, {1, 1, 1}, {0, 0, 0}, {N, N, N}, 0};
    tribox_mesh     mesh;
    painted         to;
    int             t;
    int             k;

    random_seed(142);
    for (t = 0; t < TRIANGLES; t++) {
        const double extent = t % 3 == 0 ? 1 : t % 3 == 1 ? 3 : 12;
        double       c[3];
        for (k = 0; k < 3; k++) {
            c[k] = N * (0.5 + 0.52 * random_signed());
        }
        for (k = 0; k < 9; k++) {
            f[9 * t + k] = (float)(c[k % 3] + extent * 0.5 * random_signed());
        }
    }
    mesh.positions = f;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = TRIANGLES;
    memset(bits, 0, sizeof bits);
    to.grid = &grid;
    to.bits = bits[0];
    CHECK(tribox_mesh_spans(&grid, &mesh, paint, &to) > TRIANGLES);
    tribox_grid_fill(&grid, &mesh, bits[1]);
    CHECK(memcmp(bits[0], bits[1], sizeof bits[0]) == 0);
}

/* A cube of side .9 in map coordinates, which floats would round to 1/32: voxels of 1/8, whose faces are doubles, are
 * set exactly where a triangle touches them, in the fill and in the spans. */
static void a_cube_in_map_coordinates_keeps_its_digits(void)
{
    static const unsigned char side[36] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                           2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    const double    corner[3] = {448262.25, 411932.7, 112.3};
    double          v[24];
    uint32_t        index[36];
    uint64_t        bits[16 * 16];
    uint64_t        painted_bits[16 * 16];
    tribox_grid     grid;
    tribox_mesh_f64 mesh;
    painted         to;
    int             set = 0;
    int             i;
    int             k;

    for (i = 0; i < 8; i++) {
        for (k = 0; k < 3; k++) {
            v[3 * i + k] = corner[k] + (i >> k & 1 ? 0.9 : 0);
        }
    }
    for (i = 0; i < 36; i++) {
        index[i] = side[i];
    }
    for (k = 0; k < 3; k++) {
        grid.size[k] = 0.125;
        grid.origin[k] = (double)(int)corner[k] - 0.5;
        grid.lo[k] = 0;
        grid.hi[k] = 16;
    }
    grid.flags = 0;
    mesh.positions = v;
    mesh.stride = 0;
    mesh.indices = index;
    mesh.triangles = 12;
    memset(bits, 0, sizeof bits);
    memset(painted_bits, 0, sizeof painted_bits);
    tribox_grid_fill_f64(&grid, &mesh, bits);
    to.grid = &grid;
    to.bits = painted_bits;
    tribox_mesh_spans_f64(&grid, &mesh, paint, &to);
    CHECK(memcmp(bits, painted_bits, sizeof bits) == 0);
    for (i = 0; i < 16 * 16 * 16; i++) {
        double lo[3];
        double hi[3];
        int    touches = 0;
        int    t;
        lo[0] = grid.origin[0] + 0.125 * (i % 16);
        lo[1] = grid.origin[1] + 0.125 * (i / 16 % 16);
        lo[2] = grid.origin[2] + 0.125 * (i / 256);
        for (k = 0; k < 3; k++) {
            hi[k] = lo[k] + 0.125;
        }
        for (t = 0; t < 12 && !touches; t++) {
            touches = tribox_overlap_f64(v + 3 * index[3 * t], v + 3 * index[3 * t + 1], v + 3 * index[3 * t + 2],
                                         lo, hi);
        }
        CHECK(tribox_grid_get(&grid, bits, i % 16, i / 16 % 16, i / 256) == touches);
        set += touches;
    }
    CHECK(set > 150);
}

/* No triangles, no mesh, an empty grid, one of NaN: nothing, and no voxel is counted. */
static void spans_of_nothing_are_none(void)
{
    tribox_grid     grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {4, 4, 4}, 0};
    const float     f[9] = {1, 1, 1, 2, 1, 1, 1, 2, 1};
    const double    d[9] = {1, 1, 1, 2, 1, 1, 1, 2, 1};
    tribox_mesh     mesh = {0, 0, 0, 0};
    tribox_mesh_f64 mesh_f64 = {0, 0, 0, 0};

    CHECK(tribox_mesh_spans(&grid, &mesh, 0, 0) == 0 && tribox_mesh_spans_f64(&grid, &mesh_f64, 0, 0) == 0);
    mesh.positions = f;
    mesh_f64.positions = d;
    mesh.triangles = mesh_f64.triangles = 1;
    CHECK(tribox_mesh_spans(&grid, &mesh, 0, 0) > 0 && tribox_mesh_spans_f64(&grid, &mesh_f64, 0, 0) > 0);
    grid.size[1] = 0;
    CHECK(tribox_mesh_spans(&grid, &mesh, 0, 0) == 0 && tribox_mesh_spans_f64(&grid, &mesh_f64, 0, 0) == 0);
    grid.size[1] = 1;
    grid.hi[2] = 0;
    CHECK(tribox_mesh_spans(&grid, &mesh, 0, 0) == 0 && tribox_mesh_spans_f64(&grid, &mesh_f64, 0, 0) == 0);
}

int main(void)
{
    RUN(general_triangles_are_exact_on_every_voxel);
    RUN(aligned_triangles_are_exact_on_every_voxel);
    RUN(degenerate_triangles_are_exact_on_every_voxel);
    RUN(tiny_triangles_are_exact_on_every_voxel);
    RUN(triangles_of_few_voxels_are_exact_on_every_voxel);
    RUN(huge_triangles_are_exact_on_every_voxel);
    RUN(edges_from_a_small_region_to_far_away_are_exact_on_every_voxel);
    RUN(steep_triangles_are_exact_on_every_voxel);
    RUN(narrow_triangles_are_exact_on_every_voxel);
    RUN(extreme_scales_are_exact_on_every_voxel);
    RUN(ends_of_the_index_range_are_exact_on_every_voxel);
    RUN(spans_agree_with_the_prepared_test);
    RUN(cut_regions_emit_their_part_of_the_whole);
    RUN(one_row_through_all_indices_is_one_span);
    RUN(counts_saturate);
    RUN(grids_over_all_doubles_are_exact_on_every_voxel);
    RUN(layers_at_the_largest_doubles_are_exact_on_every_voxel);
    RUN(vanishing_triangles_are_exact_on_every_voxel);
    RUN(whole_corners_on_a_broken_grid_are_exact_on_every_voxel);
    RUN(a_million_rows_are_counted);
    RUN(small_triangle_in_the_largest_region_is_cheap);
    RUN(huge_triangle_over_a_small_region_is_cheap);
    RUN(plane_almost_parallel_to_x_is_exact);
    RUN(more_rows_than_are_kept_at_once_are_exact);
    RUN(spans_and_fills_of_meshes_are_those_of_their_triangles);
    RUN(spans_of_a_mesh_paint_its_fill);
    RUN(rows_of_numbers_out_of_range_are_those_in_range);
    RUN(a_fill_of_two_mebibytes_is_its_spans);
    RUN(a_cube_in_map_coordinates_keeps_its_digits);
    RUN(spans_of_nothing_are_none);
    return test_report("test_grid");
}
