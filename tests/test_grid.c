/* The grid walk: every voxel of a region against the oracle, for spans of both types and for the fill,
 * under every rule; order, disjointness, maximality and counts of the spans; the ends of the index range. */
#include "tribox.h"

#include <limits.h>

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

/* Triangles a million times larger than the region. */
static void huge_triangles_are_exact_on_every_voxel(void)
{
    every_voxel_agrees_with_the_oracle(GRID_HUGE, FLOATS, 600);
    every_voxel_agrees_with_the_oracle(GRID_HUGE, DOUBLES, 500);
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
                v.t.v[j][a] = a != far_axis ? 3 * random_signed()
                              : i % 2       ? 1.7e308
                                            : 1.7e308 * random_signed();
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

int main(void)
{
    RUN(general_triangles_are_exact_on_every_voxel);
    RUN(aligned_triangles_are_exact_on_every_voxel);
    RUN(degenerate_triangles_are_exact_on_every_voxel);
    RUN(tiny_triangles_are_exact_on_every_voxel);
    RUN(huge_triangles_are_exact_on_every_voxel);
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
    return test_report("test_grid");
}
