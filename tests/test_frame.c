/* Where a grid stands: the frame that tribox_grid_fit puts round a mesh, and the voxel that
 * tribox_grid_locate finds. */
#include "tribox.h"

#include <fenv.h>
#include <float.h>
#include <limits.h>

#include "voxels.h"

/* Sign of (origin + i*size) - x, by the oracle's integers. */
static int plane_against(const tribox_grid *g, int a, int i, double x)
{
    int  unit = 2000;
    wide plane;
    wide step;
    wide count;
    wide offset;
    wide number;

    oracle_lower_unit(&unit, g->origin[a]);
    oracle_lower_unit(&unit, g->size[a]);
    oracle_lower_unit(&unit, x);
    oracle_integer(&plane, g->origin[a], unit);
    oracle_integer(&step, g->size[a], unit);
    oracle_integer(&number, x, unit);
    wide_set(&count, i < 0 ? -1 : 1, i < 0 ? 0 - (uint64_t)i : (uint64_t)i, 0);
    wide_multiply(&offset, &step, &count);
    wide_add(&plane, &plane, &offset);
    return wide_compare(&plane, &number);
}

/* ---- fit ----------------------------------------------------------------------------------------------- */

enum { FIT_TRIANGLES = 5 };

static void print_frame(const tribox_grid *g, const float *p, int corners, int n)
{
    int i;

    if (!test_wants_details()) {
        return;
    }
    printf("  n %d, origin {%a, %a, %a}, size %a, hi {%d, %d, %d}, corners", n, g->origin[0], g->origin[1],
           g->origin[2], g->size[0], g->hi[0], g->hi[1], g->hi[2]);
    for (i = 0; i < 3 * corners; i++) {
        printf(" %a", (double)p[i]);
    }
    printf("\n");
}

/* Cubic voxels, flags 0, n along the longest side, and each corner strictly between the region's outermost
 * planes: so no voxel outside is touched. */
static int frame_is_right(const tribox_grid *g, const float *p, int corners, int n)
{
    int    ok = g->flags == 0;
    int    most = 0;
    double extent[3];
    int    longest = 0;
    int    a;
    int    i;

    for (a = 0; a < 3; a++) {
        float least = p[a];
        float greatest = p[a];
        ok = ok && oracle_is_finite(&g->origin[a]) && oracle_is_finite(&g->size[a]) &&
             oracle_read(&g->size[a]).sign > 0 && memcmp(&g->size[a], &g->size[0], sizeof g->size[0]) == 0 &&
             g->lo[a] < g->hi[a];
        for (i = 0; ok && i < corners; i++) {
            double x = (double)p[3 * i + a];
            least = p[3 * i + a] < least ? p[3 * i + a] : least;
            greatest = p[3 * i + a] > greatest ? p[3 * i + a] : greatest;
            ok = plane_against(g, a, g->lo[a], x) < 0 && plane_against(g, a, g->hi[a], x) > 0;
        }
        extent[a] = (double)greatest - (double)least;
        longest = extent[a] > extent[longest] ? a : longest;
        most = g->hi[a] - g->lo[a] > most ? g->hi[a] - g->lo[a] : most;
    }
    return ok && most == n && g->hi[longest] - g->lo[longest] == n;
}

/* Meshes of any size, place and proportion, near the ends of float too; n from 1 to 5000. */
static void frame_holds_the_mesh_strictly_inside(void)
{
    static const int exponents[8] = {-149, -140, -60, -3, 0, 10, 60, 120};
    int              i;

    random_seed(111);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        float       p[9 * FIT_TRIANGLES];
        tribox_mesh mesh;
        tribox_grid grid;
        int         n = random_below(3) ? 1 + random_below(12) : 1 + random_below(5000);
        int         flat = random_below(6);
        double      scale = power_of_two(exponents[random_below(8)]);
        double      centre[3];
        int         triangles = 1 + random_below(FIT_TRIANGLES);
        int         varies = 0;
        int         k;
        for (k = 0; k < 3; k++) {
            centre[k] = random_below(2) ? 0 : random_signed() * scale;
            centre[k] *= power_of_two(random_below(30));
            centre[k] = centre[k] > 1e38 || centre[k] < -1e38 ? 0 : centre[k];
        }
        for (k = 0; k < 9 * triangles; k++) {
            double x = random_below(3) ? random_signed() * 8 : random_below(9) - 4;
            p[k] = (float)(centre[k % 3] + (k % 3 == flat ? 0 : x * scale));
            varies |= p[k] > p[k % 3] || p[k] < p[k % 3];
        }
        mesh.positions = p;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = (size_t)triangles;
        if (!varies) {
            CHECK(tribox_grid_fit(&grid, &mesh, n) == 0);
            continue;
        }
        if (!CHECK(tribox_grid_fit(&grid, &mesh, n) == 1) ||
            !CHECK(frame_is_right(&grid, p, 3 * triangles, n))) {
            print_frame(&grid, p, 3 * triangles, n);
        }
    }
}

/* A mesh that spans all of float, and one of a single subnormal step. */
static void frame_holds_the_largest_and_the_least_mesh(void)
{
    const float largest[9] = {-FLT_MAX, -FLT_MAX, -FLT_MAX, FLT_MAX, FLT_MAX, FLT_MAX, 0, 0, 0};
    const float least[9] = {0, 0, 0, 1.401298464e-45f, 0, 0, 0, 0, 0};
    const float offset[9] = {FLT_MAX, FLT_MAX, 1, FLT_MAX, FLT_MAX, 2, FLT_MAX, FLT_MAX, 1};
    int         n;

    for (n = 1; n < 300; n += 7) {
        tribox_grid grid;
        tribox_mesh mesh;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 1;
        mesh.positions = largest;
        CHECK(tribox_grid_fit(&grid, &mesh, n) == 1 && frame_is_right(&grid, largest, 3, n));
        mesh.positions = least;
        CHECK(tribox_grid_fit(&grid, &mesh, n) == 1 && frame_is_right(&grid, least, 3, n));
        mesh.positions = offset;
        CHECK(tribox_grid_fit(&grid, &mesh, n) == 1 && frame_is_right(&grid, offset, 3, n));
    }
}

/* Meshes of a float or two in extent, far from the origin, in up to 2^31 voxels: sizes are below the
 * spacing of doubles there, so that the first origins that are tried, on either side, leave a face
 * outside. */
static void frame_holds_meshes_small_beside_their_coordinates(void)
{
    int i;

    random_seed(116);
    for (i = 0; i < TEST_LOOPS(400); i++) {
        const int   n = i % 2 ? INT_MAX - random_below(100) : 1 + (1 << random_below(30));
        float       p[9];
        tribox_grid grid;
        tribox_mesh mesh;
        int         k;
        for (k = 0; k < 3; k++) {
            const double scale = power_of_two(random_below(120) - 60);
            const float  x = (float)(scale * (random_below(4) ? random_signed() : -1));
            p[k] = x;
            p[3 + k] = i % 3 == k || random_below(3) ? nudge_float(x, 1 + random_below(2)) : x;
            p[6 + k] = random_below(2) ? x : p[3 + k];
        }
        mesh.positions = p;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 1;
        if (!CHECK(tribox_grid_fit(&grid, &mesh, n) == 1) || !CHECK(frame_is_right(&grid, p, 3, n))) {
            print_frame(&grid, p, 3, n);
        }
    }
}

/* No voxel of the layer round the region is touched. */
static void frame_leaves_its_surroundings_untouched(void)
{
    int i;

    random_seed(112);
    for (i = 0; i < TEST_LOOPS(300); i++) {
        float       p[9];
        tribox_mesh mesh;
        tribox_grid grid;
        tribox_grid around;
        int         k;
        for (k = 0; k < 9; k++) {
            p[k] = random_below(2) ? (float)random_signed() : (float)(random_below(5) - 2) / 10;
        }
        mesh.positions = p;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 1;
        if (!tribox_grid_fit(&grid, &mesh, 1 + random_below(20))) {
            continue;
        }
        around = grid;
        for (k = 0; k < 3; k++) {
            around.lo[k]--;
            around.hi[k]++;
        }
        CHECK(tribox_grid_spans(&around, p, p + 3, p + 6, 0, 0) ==
              tribox_grid_spans(&grid, p, p + 3, p + 6, 0, 0));
    }
}

static void expect_no_frame(const float *p, size_t triangles, int n)
{
    tribox_grid grid;
    tribox_mesh mesh;

    mesh.positions = p;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = triangles;
    CHECK(tribox_grid_fit(&grid, &mesh, n) == 0);
    CHECK(tribox_grid_words(&grid) == 0);
    CHECK(grid.flags == 0);
}

/* A mesh without finite extent, of no triangles, of one point, or of triangles that are no sets, and
 * n < 1: 0 and an empty region. */
static void mesh_without_extent_has_no_frame(void)
{
    const uint32_t infinite = 0x7F800000u;
    float          p[9] = {1, 2, 3, 1, 2, 3, 1, 2, 3};
    const float    good[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

    expect_no_frame(p, 0, 8);
    expect_no_frame(0, 0, 8);
    expect_no_frame(p, 1, 8);
    p[4] = 7;
    memcpy(&p[0], &infinite, sizeof p[0]);
    expect_no_frame(p, 1, 8);
    expect_no_frame(good, 1, 0);
    expect_no_frame(good, 1, -1);
    expect_no_frame(good, 1, INT_MIN);
}

/* A triangle with an infinite or NaN corner is no part of the frame, and no reason to look for one for ever. */
static void fit_returns_for_corners_that_are_no_numbers(void)
{
    static const uint32_t bad[4] = {0x7f800000u, 0xff800000u, 0x7fc00000u, 0x7f800001u};
    int i;

    for (i = 0; i < 36; i++) {
        const uint64_t  bad_f64[4] = {UINT64_C(0x7ff0000000000000), UINT64_C(0xfff0000000000000),
                                      UINT64_C(0x7ff8000000000000), UINT64_C(0x7ff0000000000001)};
        float           p[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 10};
        double          d[18];
        tribox_grid     grid;
        tribox_mesh     mesh;
        tribox_mesh_f64 mesh_f64;
        int             k;
        for (k = 0; k < 18; k++) {
            d[k] = (double)p[k];
        }
        memcpy(&p[i % 9], &bad[i / 9], sizeof p[0]);
        memcpy(&d[i % 9], &bad_f64[i / 9], sizeof d[0]);
        mesh.positions = p;
        mesh_f64.positions = d;
        mesh.stride = mesh_f64.stride = 0;
        mesh.indices = mesh_f64.indices = 0;
        mesh.triangles = mesh_f64.triangles = 1;
        CHECK(tribox_grid_fit(&grid, &mesh, 8) == 0 && tribox_grid_words(&grid) == 0);
        CHECK(tribox_grid_fit_f64(&grid, &mesh_f64, 8) == 0 && tribox_grid_words(&grid) == 0);
        mesh.triangles = mesh_f64.triangles = 2;
        CHECK(tribox_grid_fit(&grid, &mesh, 8) == 1 && frame_is_right(&grid, p + 9, 3, 8));
        CHECK(tribox_grid_fit_f64(&grid, &mesh_f64, 8) == 1 && frame_is_right(&grid, p + 9, 3, 8));
    }
}

/* Double meshes of any place and size, from subnormal to 2^1018: strictly inside, n voxels along the longest side. An
 * extent that is no double has no frame. */
static void frame_holds_double_meshes_strictly_inside(void)
{
    static const int exponents[10] = {-1074, -1030, -900, -300, -20, 0, 20, 300, 900, 1015};
    int i;

    random_seed(117);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        const int       n = 1 + random_below(i % 2 ? 20 : 5000);
        const int       e = exponents[random_below(10)];
        const int       away = random_below(2) ? random_below(50) : 0;
        double          d[9];
        tribox_grid     grid;
        tribox_mesh_f64 mesh;
        int             varies = 0;
        int             ok;
        int             a;
        int             k;
        for (k = 0; k < 9; k++) {
            d[k] = (random_below(3) ? 8 * random_signed() : random_below(9) - 4) * power_of_two(e) +
                   (away && e + away < 1015 ? power_of_two(e + away) : 0);
            varies |= oracle_read(&d[k]).sign != oracle_read(&d[k % 3]).sign || d[k] > d[k % 3] || d[k] < d[k % 3];
        }
        mesh.positions = d;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 1;
        ok = tribox_grid_fit_f64(&grid, &mesh, n);
        if (!varies) {
            continue; /* subnormals may be all one to this test's arithmetic */
        }
        CHECK(ok == 1);
        for (a = 0; a < 3 && ok; a++) {
            for (k = a; k < 9; k += 3) {
                CHECK(plane_against(&grid, a, grid.lo[a], d[k]) < 0 && plane_against(&grid, a, grid.hi[a], d[k]) > 0);
            }
        }
        CHECK(grid.hi[0] == n || grid.hi[1] == n || grid.hi[2] == n);
    }
    {
        const double    d[9] = {-DBL_MAX, 0, 0, DBL_MAX, 0, 0, 0, 1, 0};
        tribox_grid     grid;
        tribox_mesh_f64 mesh = {0, 0, 0, 1};
        mesh.positions = d;
        CHECK(tribox_grid_fit_f64(&grid, &mesh, 8) == 0 && tribox_grid_words(&grid) == 0);
    }
}

/* ---- locate -------------------------------------------------------------------------------------------- */

/* Points on grid planes as a user computes them, give or take ulps, and anywhere: planes i and i + 1
 * enclose the point, the lower included, and the answer says whether the voxel lies in the region. */
static void located_voxel_holds_the_point(void)
{
    int found = 0;
    int i;

    random_seed(113);
    for (i = 0; i < TEST_LOOPS(40000); i++) {
        tribox_grid grid;
        double      p[3];
        int         index[3] = {0, 0, 0};
        int         inside = 1;
        int         answer;
        int         a;
        make_grid(&grid, 1);
        for (a = 0; a < 3; a++) {
            int j = grid.lo[a] - 1 + random_below(grid.hi[a] - grid.lo[a] + 2);
            p[a] = grid_plane(&grid, a, random_below(2) ? j : j + random_signed());
            p[a] = nudge_double(p[a], random_below(7) - 3);
        }
        answer = tribox_grid_locate(&grid, p, index);
        for (a = 0; a < 3; a++) {
            CHECK(plane_against(&grid, a, index[a], p[a]) <= 0 &&
                  plane_against(&grid, a, index[a] + 1, p[a]) > 0);
            inside = inside && index[a] >= grid.lo[a] && index[a] < grid.hi[a];
        }
        CHECK(answer == inside);
        found += answer;
    }
    CHECK(found > 0);
}

/* Rounded up or down, origin - x and i*size err in one direction: points within an ulp or two of a plane, in
 * every rounding mode. */
static void located_voxel_holds_the_point_in_every_rounding_mode(void)
{
    static const int modes[] = {
        FE_TONEAREST,
#ifdef FE_UPWARD
        FE_UPWARD,
#endif
#ifdef FE_DOWNWARD
        FE_DOWNWARD,
#endif
#ifdef FE_TOWARDZERO
        FE_TOWARDZERO,
#endif
    };
    int i;

    random_seed(115);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        const int   mode = modes[(size_t)random_below(4) % (sizeof modes / sizeof *modes)];
        tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {-2000, -2000, -2000}, {2000, 2000, 2000}, 0};
        double      p[3];
        int         index[3] = {0, 0, 0};
        int         a;
        for (a = 0; a < 3; a++) {
            grid.origin[a] = random_signed();
            grid.size[a] = 0.001 + 0.001 * random_signed() * random_signed();
            p[a] = nudge_double(grid_plane(&grid, a, random_below(2000) - 1000), random_below(5) - 2);
        }
        fesetround(mode);
        tribox_grid_locate(&grid, p, index);
        fesetround(FE_TONEAREST);
        for (a = 0; a < 3; a++) {
            CHECK(plane_against(&grid, a, index[a], p[a]) <= 0 &&
                  plane_against(&grid, a, index[a] + 1, p[a]) > 0);
        }
    }
}

/* Half-open voxels partition space: a point triangle sets exactly the voxel that locate finds. */
static void point_triangle_sets_exactly_the_located_voxel(void)
{
    int i;

    random_seed(114);
    for (i = 0; i < TEST_LOOPS(10000); i++) {
        static voxels v;
        walk          w;
        int           index[3] = {0, 0, 0};
        size_t        count;
        int           inside;
        int           a;
        v.seed = random_state;
        make_grid(&v.grid, 1);
        v.grid.flags = TRIBOX_HALF_OPEN;
        for (a = 0; a < 3; a++) {
            v.n[a] = v.grid.hi[a] - v.grid.lo[a];
            v.t.v[0][a] = v.grid.lo[a] + random_below(v.n[a] + 1);
            v.t.v[0][a] = grid_plane(&v.grid, a, v.t.v[0][a] + (random_below(4) ? 0 : 0.3));
            v.t.v[0][a] = nudge_double(v.t.v[0][a], random_below(7) - 3);
            v.t.v[1][a] = v.t.v[2][a] = v.t.v[0][a];
        }
        inside = tribox_grid_locate(&v.grid, v.t.v[0], index);
        walk_start(&w, &v);
        count = tribox_grid_spans_f64(&v.grid, v.t.v[0], v.t.v[1], v.t.v[2], walk_emit, &w);
        CHECK(count == (size_t)inside);
        if (count == 1) {
            CHECK(w.last_x1 == index[0] && w.last_y == index[1] && w.last_z == index[2]);
        }
    }
}

/* The ends of the index range: voxel INT_MAX - 1 is the last of the largest region, INT_MIN the first, and
 * points beyond lie in no region. */
static void locate_reaches_the_ends_of_the_index_range(void)
{
    const tribox_grid grid = {
        {0, 0, 0}, {1, 1, 1}, {INT_MIN, INT_MIN, INT_MIN}, {INT_MAX, INT_MAX, INT_MAX}, 0};
    double            p[3] = {0.5, 0.5, 0.5};
    int               index[3];
    int               a;

    for (a = 0; a < 3; a++) {
        p[a] = 2147483646.75;
        CHECK(tribox_grid_locate(&grid, p, index) == 1 && index[a] == INT_MAX - 1);
        p[a] = 2147483647.0;
        CHECK(tribox_grid_locate(&grid, p, index) == 0);
        p[a] = -2147483648.0;
        CHECK(tribox_grid_locate(&grid, p, index) == 1 && index[a] == INT_MIN);
        p[a] = -2147483648.25;
        CHECK(tribox_grid_locate(&grid, p, index) == 0);
        p[a] = 1e300;
        CHECK(tribox_grid_locate(&grid, p, index) == 0);
        p[a] = -DBL_MAX;
        CHECK(tribox_grid_locate(&grid, p, index) == 0);
        p[a] = -0.0;
        CHECK(tribox_grid_locate(&grid, p, index) == 1 && index[a] == 0);
        p[a] = 0.5;
    }
}

int main(void)
{
    RUN(frame_holds_the_mesh_strictly_inside);
    RUN(frame_holds_the_largest_and_the_least_mesh);
    RUN(frame_holds_meshes_small_beside_their_coordinates);
    RUN(frame_leaves_its_surroundings_untouched);
    RUN(mesh_without_extent_has_no_frame);
    RUN(fit_returns_for_corners_that_are_no_numbers);
    RUN(frame_holds_double_meshes_strictly_inside);
    RUN(located_voxel_holds_the_point);
    RUN(located_voxel_holds_the_point_in_every_rounding_mode);
    RUN(point_triangle_sets_exactly_the_located_voxel);
    RUN(locate_reaches_the_ends_of_the_index_range);
    return test_report("test_frame");
}
