/* The ways that a fill has for triangles of few voxels. One triangle goes by rows; as many copies of it as a
 * mesh has go through the short ways and the groups. Both set the voxels of its spans, which test_grid holds
 * against the oracle. */
#include "tribox.h"

#include <fenv.h>
#include <math.h>

#include "voxels.h"

enum { FEW_COPIES = 40, FEW_EDGE = 80, FEW_WORDS = 3 * FEW_EDGE * FEW_EDGE };

/* A triangle somewhere in a region, and the bits of its spans. */
typedef struct few_case {
    tribox_grid grid;
    int         n[3];
    size_t      words;
    uint64_t    seed;
    int         rounding;       /* the fill's; all else is done in the default mode */
    float       copies[9 * FEW_COPIES];
    uint64_t    expected[FEW_WORDS];
    uint64_t    bits[FEW_WORDS];
} few_case;

static few_case few;

static void few_set(void *user, int x0, int x1, int y, int z)
{
    few_case *c = (few_case *)user;
    size_t    in_row = (size_t)(c->n[0] + 63) / 64;
    size_t row = ((size_t)(z - c->grid.lo[2]) * (size_t)c->n[1] + (size_t)(y - c->grid.lo[1])) * in_row;
    int    x;

    for (x = x0 - c->grid.lo[0]; x <= x1 - c->grid.lo[0]; x++) {
        c->expected[row + (size_t)x / 64] |= (uint64_t)1 << (x % 64);
    }
}

/* A region of up to n voxels on each axis, its planes where arithmetic is exact, or where nothing is. */
static void few_grid(few_case *c, int n)
{
    static const double sizes[6] = {1, 0.25, 0.1, 1.0 / 3, 0.7, 1.9};
    int                 a;
    int                 one_size = random_below(2);
    double              far_off = random_below(3) ? 4 : 300;

    c->seed = random_state;
    for (a = 0; a < 3; a++) {
        c->n[a] = 1 + random_below(n);
        c->grid.size[a] = one_size && a > 0 ? c->grid.size[0] : sizes[random_below(6)];
        c->grid.origin[a] = random_below(2) ? 0 : random_signed() * far_off;
        c->grid.lo[a] = random_below(9) - 5;
        c->grid.hi[a] = c->grid.lo[a] + c->n[a];
    }
    c->n[0] += random_below(2) ? 0 : 50 + random_below(60);     /* over the end of a word */
    c->grid.hi[0] = c->grid.lo[0] + c->n[0];
    c->words = (size_t)((c->n[0] + 63) / 64 * c->n[1] * c->n[2]);
}

static void few_copy(few_case *c)
{
    int i;

    for (i = 9; i < 9 * FEW_COPIES; i++) {
        c->copies[i] = c->copies[i - 9];
    }
}

/* Corners within a box of up to n voxels, at simple places of the grid up to rounding: edges and planes pass
 * corners of voxels by a hair. */
static void few_corners(few_case *c, int n)
{
    static const int steps[6] = {1, 2, 3, 4, 8, 64};
    int              i;
    int              a;

    for (a = 0; a < 3; a++) {
        int step = steps[random_below(6)];
        int cells = 1 + random_below(n);
        int first = c->grid.lo[a] + random_below(c->n[a] + 2) - 1;
        for (i = 0; i < 3; i++) {
            double at = (double)random_below(cells * step + 1) / step;
            if (random_below(6) == 0) {
                at = (random_signed() + 1) * 0.5 * cells;
            }
            c->copies[3 * i + a] = (float)(c->grid.origin[a] + (first + at) * c->grid.size[a]);
        }
    }
    if (random_below(12) == 0) {
        memcpy(c->copies + 3, c->copies, 3 * sizeof(float));
    }
    if (random_below(12) == 0) {
        const uint32_t bits = random_below(2) ? 0x7fc00000u : 0x7f800000u;      /* NaN, infinity */
        memcpy(c->copies + random_below(9), &bits, sizeof bits);
    }
    few_copy(c);
}

/* Corners within a box of up to n voxels, none of them at a simple place: but an edge passes by a grid line, or
 * the plane by a grid point, as near as rounding allows. */
static void few_near_miss(few_case *c, int n)
{
    double at[3][3];
    double to = 0.2 + 0.8 * random_below(1000) / 1000;
    double on = 0.2 + 0.8 * random_below(1000) / 1000;
    int    kind = random_below(4);
    int    i;
    int    a;

    for (a = 0; a < 3; a++) {
        int plane = c->grid.lo[a] + random_below(c->n[a] + 1);
        for (i = 0; i < 3; i++) {
            at[i][a] = random_signed() * 0.5 * n;
        }
        if (kind == 3) {
            at[1][a] = (random_below(2) ? 0.5 : -0.5) * n * (0.8 + 0.2 * random_signed());
            at[2][a] = -to * at[0][a] - on * at[1][a];      /* the point is in the plane */
        } else if (a != kind) {
            at[1][a] = -to * at[0][a];                      /* the line across axis `kind` meets edge 0 */
        }
        for (i = 0; i < 3; i++) {
            c->copies[3 * i + a] = (float)(c->grid.origin[a] + (plane + at[i][a]) * c->grid.size[a]);
        }
    }
    few_copy(c);
}

/* Corners within a box of up to n voxels, on grid planes and simple parts of a voxel, which floats hold exactly
 * here: level on an axis, in a plane through grid points, a hair off now and then. */
static void few_on_lattice(few_case *c, int n)
{
    static const double sizes[4] = {1, 0.25, 0.375, 5};
    static const int    steps[7] = {1, 2, 4, 8, 16, 16, 16};
    const int           one_step = random_below(2) ? steps[random_below(7)] : 0;
    int                 at[3][3];
    int                 i;
    int                 a;

    for (a = 0; a < 3; a++) {
        int step = one_step ? one_step : steps[random_below(7)];
        int cells = 1 + random_below(n);
        int level = random_below(6) == 0;
        int first = c->grid.lo[a] + random_below(c->n[a] + 2) - 1;
        c->grid.size[a] = sizes[random_below(4)];
        c->grid.origin[a] = random_below(2) ? 0 : (random_below(400) - 200) * 0.125 * c->grid.size[a];
        for (i = 0; i < 3; i++) {
            at[i][a] = random_below(cells * step + 1);
            if (level && i > 0) {
                at[i][a] = at[0][a];
            }
            if (a == 2 && one_step && random_below(8) > 0) {    /* x + y + z, or x - y + z */
                at[i][2] = (random_below(8) ? cells * step : 0) - at[i][0] + (first & 1 ? at[i][1] : -at[i][1]);
            }
            c->copies[3 * i + a] =
                (float)(c->grid.origin[a] + (first + (double)at[i][a] / step) * c->grid.size[a]);
            if (random_below(100) == 0) {
                c->copies[3 * i + a] = nextafterf(c->copies[3 * i + a], random_below(2) ? 1e9f : -1e9f);
            }
        }
    }
    few_copy(c);
}

/* Corners that are decimals, rounded to floats, in a grid of decimals: beside grid planes by less than a float's
 * spacing, on some exactly; edges pass by corners of voxels as near; x equal to y, corners that coincide. */
static void few_decimals(few_case *c, int n)
{
    static const double sizes[8] = {0.1, 0.05, 0.2, 0.3, 0.7, 0.01, 1.0 / 3, 1};
    static const double origins[8] = {0, 0, 0.1, -0.3, -7, 5.05, 10000.1, 448262.25};
    static const int    steps[6] = {1, 1, 2, 5, 10, 8};
    const int           step = steps[random_below(6)];
    const double        size = sizes[random_below(8)];
    const double        origin = origins[random_below(8)];
    const int           same = random_below(3);
    int                 i;
    int                 a;

    for (a = 0; a < 3; a++) {
        int first = c->grid.lo[a] + random_below(c->n[a] + 2) - 1;
        c->grid.size[a] = same ? size : sizes[random_below(8)];
        c->grid.origin[a] = same ? origin : origins[random_below(8)];
        for (i = 0; i < 3; i++) {
            double at = first + (double)random_below(n * step + 1) / step;
            c->copies[3 * i + a] = (float)(c->grid.origin[a] + at * c->grid.size[a]);
        }
        if (random_below(6) == 0) {
            c->copies[3 + a] = c->copies[a];
        }
    }
    if (random_below(4) == 0) {
        for (i = 0; i < 3; i++) {
            c->copies[3 * i + 1] = c->copies[3 * i];
        }
    }
    few_copy(c);
}

static int few_fill_is_expected(few_case *c, int copies)
{
    tribox_mesh mesh;
    int         same;

    mesh.positions = c->copies;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = (size_t)copies;
    memset(c->bits, 0, c->words * sizeof *c->bits);
    fesetround(c->rounding);
    tribox_grid_fill(&c->grid, &mesh, c->bits);
    fesetround(FE_TONEAREST);
    same = memcmp(c->bits, c->expected, c->words * sizeof *c->bits) == 0;
    if (!same && test_wants_details()) {
        printf("  %d copies, flags %u, seed %llu\n", copies, c->grid.flags, (unsigned long long)c->seed);
    }
    return same;
}

typedef void few_make(few_case *c, int n);

static void few_ask(int edge, int n, int count, few_make *one, few_make *other)
{
    static const int roundings[] = {
        FE_TONEAREST,
#ifdef FE_UPWARD
        FE_UPWARD,
#endif
#ifdef FE_DOWNWARD
        FE_DOWNWARD,
#endif
    };
    int i;
    int k;

    for (i = 0; i < TEST_LOOPS(count); i++) {
        few_grid(&few, edge);
        few.rounding = roundings[(size_t)i % (sizeof roundings / sizeof *roundings)];
        (random_below(2) ? one : other)(&few, n);
        for (k = 0; k < 4; k++) {
            few.grid.flags = every_rule[k];
            memset(few.expected, 0, few.words * sizeof *few.expected);
            tribox_grid_spans(&few.grid, few.copies, few.copies + 3, few.copies + 6, few_set, &few);
            CHECK(few_fill_is_expected(&few, 1));
            CHECK(few_fill_is_expected(&few, FEW_COPIES));
        }
    }
}

/* Boxes of up to 2^3 voxels: the short ways, and the first group. */
static void two_voxels_an_axis_are_exact(void)
{
    random_seed(201);
    few_ask(6, 2, 12000, few_corners, few_near_miss);
}

/* Boxes of up to 3^3 and 4^3 voxels: the other groups. */
static void three_and_four_voxels_an_axis_are_exact(void)
{
    random_seed(202);
    few_ask(6, 3, 12000, few_corners, few_near_miss);
    few_ask(7, 4, 12000, few_corners, few_near_miss);
}

/* Boxes up to what goes by rows, and beyond. */
static void up_to_eighty_voxels_an_axis_are_exact(void)
{
    random_seed(203);
    few_ask(12, 9, 4000, few_corners, few_near_miss);
    few_ask(30, 24, 300, few_corners, few_near_miss);
    few_ask(80, 80, 40, few_corners, few_near_miss);
}

/* Exact touching, which no bound decides: all ways know corners on grid planes and between for what they are. */
static void corners_on_the_lattice_are_exact(void)
{
    random_seed(204);
    few_ask(6, 2, 20000, few_on_lattice, few_on_lattice);
    few_ask(6, 3, 20000, few_on_lattice, few_on_lattice);
    few_ask(7, 4, 10000, few_on_lattice, few_on_lattice);
    few_ask(12, 9, 3000, few_on_lattice, few_on_lattice);
    few_ask(80, 60, 60, few_on_lattice, few_on_lattice);
}

/* Decimals: what floats round off decides, and exact signs where that is nothing, too. */
static void decimals_are_exact(void)
{
    random_seed(205);
    few_ask(6, 2, 12000, few_decimals, few_decimals);
    few_ask(7, 4, 12000, few_decimals, few_decimals);
    few_ask(12, 9, 2000, few_decimals, few_decimals);
}

/* Whole and rest of an edge must not be added before their differences are taken: with -ffast-math, rounding down,
 * clang lost a voxel of this triangle. */
static void rests_are_kept_apart(void)
{
    static const float v[9] = {-0x1.666666p+0f, -0x1.666666p+1f, -0x1.666666p-1f, -0x1.666666p+0f, -0x1.666666p-1f,
                               -0x1.666666p+0f, -0x1.0cccccp+1f, -0x1.7f7ceep+0f, -0x1.666666p+1f};
    int                a;

    memset(&few.seed, 0, sizeof few.seed);
    few.n[0] = few.n[1] = few.n[2] = 12;
    few.words = 12 * 12;
    few.rounding = FE_TONEAREST;
#ifdef FE_DOWNWARD
    few.rounding = FE_DOWNWARD;
#endif
    for (a = 0; a < 3; a++) {
        few.grid.origin[a] = -7;
        few.grid.size[a] = 0.7;
        few.grid.lo[a] = a == 0 ? -1 : 1;
        few.grid.hi[a] = few.grid.lo[a] + 12;
    }
    memcpy(few.copies, v, sizeof v);
    few_copy(&few);
    few.grid.flags = 0;
    memset(few.expected, 0, few.words * sizeof *few.expected);
    tribox_grid_spans(&few.grid, few.copies, few.copies + 3, few.copies + 6, few_set, &few);
    CHECK(few_fill_is_expected(&few, 1));
    CHECK(few_fill_is_expected(&few, FEW_COPIES));
}

int main(void)
{
    RUN(two_voxels_an_axis_are_exact);
    RUN(three_and_four_voxels_an_axis_are_exact);
    RUN(up_to_eighty_voxels_an_axis_are_exact);
    RUN(corners_on_the_lattice_are_exact);
    RUN(decimals_are_exact);
    RUN(rests_are_kept_apart);
    return test_report("test_few");
}
