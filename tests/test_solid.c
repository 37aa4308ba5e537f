/* The solid: voxels whose centre lies inside a mesh, by the parity of crossings, against exact numbers
 * (solid_truth.h), on lattices where every kind of tie occurs, and what must hold between its answers. */
#include "tribox.h"

#include <limits.h>

#include "question.h"
#include "solid_truth.h"

enum { SOLID_TRIANGLES = 48, SOLID_WORDS = 3 * 9 * 9, SOLID_GUARD = 2 };

static const int64_t solid_no_half[3] = {0, 0, 0};

typedef struct solid_case {
    tribox_grid grid;
    int         n[3];
    int         triangles;
    uint64_t    seed;
    float       positions[9 * SOLID_TRIANGLES];
    double      doubles[9 * SOLID_TRIANGLES];
    size_t      words;
    uint64_t    bits[SOLID_WORDS];
} solid_case;

static float solid_special(int which)
{
    static const uint32_t bits[6] = {0x7fc00000u, 0x7f800001u, 0xffc00000u, 0x7f800000u, 0xff800000u, 0x7f7fffffu};
    float                 x;

    memcpy(&x, &bits[which], sizeof x);
    return x;
}

static double solid_centre(const tribox_grid *g, int k, int i)
{
    return g->origin[k] + (i + 0.5) * g->size[k];
}

/* A mesh about a region up to 3 words wide. kind 0: on a lattice of parts of a voxel, 1: anywhere, 2: floats
 * near tenths of a voxel, 3: on a lattice that the grid misses by a hair, 4: voxels some 2^30 from the origin,
 * where doubles round by parts of a voxel's width, 5: tenths and halves of them, in voxels of a tenth, 6: on a
 * lattice or beside, in voxels as large or small as the fast ways take, or larger and smaller; corners far off
 * along x, and triangles that are nearly a line as seen along x. */
static void solid_make(solid_case *c, int kind)
{
    static const double sizes[6] = {1, 0.5, 3, 0.75, 0.1, 1.0 / 3};
    int                 a;
    int                 i;
    int                 reach = random_below(3) ? 2 : random_below(2) ? 6 : 40;
    int                 scale = random_below(2) ? 0 : random_below(2) ? 58 + random_below(5) : -58 - random_below(5);

    c->seed = random_state;
    for (a = 0; a < 3; a++) {
        c->n[a] = a == 0 ? 1 + random_below(random_below(3) ? 20 : 160) : 1 + random_below(9);
        c->grid.size[a] = sizes[kind % 3 == 0 ? random_below(4) : random_below(6)];
        c->grid.origin[a] = kind == 0 ? c->grid.size[a] * 0.25 * random_below(9) : random_signed();
        c->grid.lo[a] = random_below(9) - 5;
        if (kind == 6) {
            c->grid.size[a] *= power_of_two(scale);
            c->grid.origin[a] = c->grid.size[a] * (0.25 * random_below(5) + (random_below(5) ? 0 : power_of_two(-9)));
            c->grid.origin[a] += random_below(4) ? 0 : c->grid.size[a] * (random_below(2) ? 4194290.0 : 1048570.0);
            if (random_below(24) == 0) { /* the last number that is whole, with the region beyond */
                double extent = 1;
                for (; 2 * extent <= c->n[a] * c->grid.size[a] / power_of_two(scale); extent *= 2) {
                }
                c->grid.size[a] = power_of_two(scale);
                c->grid.origin[a] = (power_of_two(51 - 14) * extent - 1) * c->grid.size[a];
            }
        }
        if (kind == 3) {
            c->grid.origin[a] *= random_below(2) ? 1e-20 : 1e-9;
        } else if (kind == 4) {
            c->grid.lo[a] = (random_below(2) ? 1 : -1) * (1000000000 + random_below(1000000));
            c->grid.origin[a] -= c->grid.lo[a] * c->grid.size[a];
        } else if (kind == 5) {
            c->grid.size[a] = 0.1;
            c->grid.origin[a] = 0.05 * random_below(5);
        }
        c->grid.hi[a] = c->grid.lo[a] + c->n[a];
    }
    c->grid.flags = (unsigned)random_below(8);
    c->triangles = 1 + random_below(SOLID_TRIANGLES);
    for (i = 0; i < 9 * c->triangles; i++) {
        int    k = i % 3;
        int    parts = kind % 3 == 0 ? 4 : 10;
        int    at = random_below(parts * c->n[k] + 2 * parts) - parts;
        double x = solid_centre(&c->grid, k, c->grid.lo[k]) + c->grid.size[k] * at / parts;
        if (i % 9 >= 3 && random_below(4)) {
            x = c->doubles[i - i % 9 + k] + c->grid.size[k] * (random_below(2 * reach + 1) - reach) / parts;
        }
        if (random_below(4) == 0) { /* on the lines of centres */
            x = solid_centre(&c->grid, k, c->grid.lo[k] + random_below(c->n[k]));
        }
        if (kind == 5) {
            const int near = i % 9 < 3 || random_below(3) == 0 ? random_below(2 * c->n[k] + 6) - 3 : 0;
            x = 0.05 * (double)(2 * c->grid.lo[k] + near);
            if (i % 9 >= 3 && random_below(2)) { /* one of the rows beside, or none */
                x = c->doubles[i - i % 9 + k] + 0.05 * (random_below(9) - 4);
            }
        }
        if (kind == 1 && random_below(3)) {
            x += random_signed() * c->grid.size[k];
        }
        c->positions[i] = (float)x;
        c->doubles[i] = random_below(2) ? x : (double)c->positions[i];
        if (kind == 0 && random_below(1000) == 0) { /* as little as there is, one way or the other */
            c->positions[i] += c->positions[i] * FLT_EPSILON;
        }
        if (kind % 6 == 0 && random_below(200) == 0) {
            c->doubles[i] += 1e-14 * c->grid.size[k];
        }
        if (kind == 6 && random_below(8) == 0) {
            x = 0;
            c->doubles[i] = c->positions[i] = 0;
        }
        if (kind == 6 && k == 0 && random_below(20) == 0) {
            c->positions[i] = (float)(x * power_of_two(random_below(40)));
            c->doubles[i] = random_below(4) ? (double)c->positions[i] : c->grid.size[0] * power_of_two(170);
        }
        if (kind == 6 && i % 9 >= 7 && random_below(8) == 0) { /* between the others */
            c->doubles[i] = 0.75 * c->doubles[i - 3] + 0.25 * c->doubles[i - 6];
            if (random_below(2)) {
                c->doubles[i - 1] = 0.75 * c->doubles[i - 4] + 0.25 * c->doubles[i - 7];
            }
            c->positions[i] = (float)c->doubles[i];
            c->positions[i - 1] = (float)c->doubles[i - 1];
        }
        if (kind == 1 && random_below(100) == 0) { /* far out of the region */
            c->doubles[i] += (random_below(2) ? 1e3 : -1e3) * c->grid.size[k];
            c->positions[i] = (float)c->doubles[i];
        }
    }
    c->words = (size_t)((c->n[0] + 63) / 64 * c->n[1] * c->n[2]);
}

static tribox_mesh solid_mesh(const solid_case *c)
{
    tribox_mesh mesh;

    mesh.positions = c->positions;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = (size_t)c->triangles;
    return mesh;
}

static tribox_mesh_f64 solid_mesh_f64(const solid_case *c)
{
    tribox_mesh_f64 mesh;

    mesh.positions = c->doubles;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = (size_t)c->triangles;
    return mesh;
}

static void solid_corners(const solid_case *c, int t, int is_double, double v[3][3])
{
    int i;

    for (i = 0; i < 9; i++) {
        v[i / 3][i % 3] = is_double ? c->doubles[9 * t + i] : (double)c->positions[9 * t + i];
    }
}

/* The solid voxel by voxel, in c->bits. */
static void solid_expect(solid_case *c, int is_double)
{
    int     x;
    int     y;
    int     z;
    int     t;
    int64_t half[3];

    memset(c->bits, 0, sizeof c->bits);
    for (z = 0; z < c->n[2]; z++) {
        for (y = 0; y < c->n[1]; y++) {
            size_t row = (size_t)(z * c->n[1] + y) * (size_t)((c->n[0] + 63) / 64);
            half[1] = 2 * (int64_t)(c->grid.lo[1] + y) + 1;
            half[2] = 2 * (int64_t)(c->grid.lo[2] + z) + 1;
            for (t = 0; t < c->triangles; t++) { /* whoever is crossed from x is so from all behind it */
                int    first = 0;
                int    end = c->n[0];
                double v[3][3];
                solid_corners(c, t, is_double, v);
                while (first < end) {
                    x = first + (end - first) / 2;
                    half[0] = 2 * (int64_t)(c->grid.lo[0] + x) + 1;
                    if (solid_crosses(v, c->grid.origin, c->grid.size, half)) {
                        end = x;
                    } else {
                        first = x + 1;
                    }
                }
                for (x = first; x < c->n[0]; x++) {
                    c->bits[row + (size_t)x / 64] ^= (uint64_t)1 << (x % 64);
                }
            }
        }
    }
}

static int solid_same(const solid_case *c, const uint64_t *bits, const char *what)
{
    if (memcmp(bits, c->bits, c->words * sizeof *bits) == 0) {
        return 1;
    }
    if (test_wants_details()) {
        printf("  %s, seed %llu: %d triangles, n %d %d %d\n", what, (unsigned long long)c->seed, c->triangles,
               c->n[0], c->n[1], c->n[2]);
    }
    return 0;
}

/* Each voxel has the parity of its crossings, floats and doubles; bits are flipped, not set, and nothing else is
 * touched: neither the words around nor the padding. */
static void solid_check(solid_case *c)
{
    static uint64_t bits[SOLID_WORDS + 2 * SOLID_GUARD];
    static uint64_t before[SOLID_WORDS + 2 * SOLID_GUARD];
    tribox_mesh     mesh = solid_mesh(c);
    tribox_mesh_f64 mesh_f64 = solid_mesh_f64(c);
    int             is_double;
    size_t          w;

    for (is_double = 0; is_double < 2; is_double++) {
        for (w = 0; w < SOLID_WORDS + 2 * SOLID_GUARD; w++) {
            before[w] = bits[w] = random_bits();
        }
        if (is_double) {
            tribox_grid_fill_solid_f64(&c->grid, &mesh_f64, bits + SOLID_GUARD);
        } else {
            tribox_grid_fill_solid(&c->grid, &mesh, bits + SOLID_GUARD);
        }
        for (w = 0; w < SOLID_WORDS + 2 * SOLID_GUARD; w++) {
            bits[w] ^= before[w];
        }
        solid_expect(c, is_double);
        CHECK(solid_same(c, bits + SOLID_GUARD, is_double ? "f64" : "float"));
        CHECK(bits[0] == 0 && bits[1] == 0 && bits[SOLID_GUARD + c->words] == 0 &&
              bits[SOLID_GUARD + c->words + 1] == 0);
    }
}

/* So it is on every kind of mesh. */
static void fill_flips_the_voxels_whose_centre_is_inside(void)
{
    int i;

    random_seed(1201);
    for (i = 0; i < TEST_LOOPS(45); i++) {
        static solid_case c;
        solid_make(&c, i % 3);
        solid_check(&c);
    }
}

/* Voxels of 2^-62 to 2^62, regions some 2^22 voxels off, corners some 2^40 voxels beside. */
static void grids_of_any_scale(void)
{
    int i;

    random_seed(1211);
    for (i = 0; i < 16 + TEST_LOOPS(16); i++) {
        static solid_case c;
        solid_make(&c, 6);
        solid_check(&c);
    }
}

/* Triangles of one row whose middle corner lies beside the row's centre by what a double of a tenth is off. */
static void middle_corners_on_centres_of_tenths(void)
{
    int i;

    random_seed(1218);
    for (i = 0; i < 24; i++) {
        static solid_case c;
        int               t;
        int               k;
        c.seed = random_state;
        for (k = 0; k < 3; k++) {
            c.grid.origin[k] = 0;
            c.grid.size[k] = 0.1;
            c.grid.lo[k] = 0;
            c.grid.hi[k] = c.n[k] = k ? 9 : 15;
        }
        c.grid.flags = 0;
        c.triangles = SOLID_TRIANGLES;
        c.words = 81;
        for (t = 0; t < SOLID_TRIANGLES; t++) {
            const int turned = random_below(2);
            const double y = 0.1 * random_below(9) + 0.05;
            const double z = 0.1 * random_below(9) + 0.05;
            double      *v = c.doubles + 9 * t;
            v[0] = 0.1 * random_below(15);
            v[3] = 0.1 * random_below(15);
            v[6] = 0.1 * random_below(15);
            v[1 + turned] = y - 0.03;
            v[4 + turned] = y + 0.03;
            v[7 + turned] = nudge_double(y, random_below(3) - 1);
            v[2 - turned] = z - 0.03;
            v[5 - turned] = z + 0.02 * random_signed();
            v[8 - turned] = z + 0.03;
        }
        for (k = 0; k < 9 * SOLID_TRIANGLES; k++) {
            c.positions[k] = (float)c.doubles[k];
        }
        solid_check(&c);
    }
}

/* Triangles that are nearly a line through centres as seen along x, and steep: from row to row the plane goes 2^30
 * voxels on. */
static void slivers_through_centres(void)
{
    static const float steep = 1048576;
    int                i;

    for (i = 0; i < 96; i++) {
        static solid_case c;
        const float       eps = 1.0f / 2048 * (float)(1 + i % 4);
        const float       x = (float)(i / 4 % 3) - 1;
        const int         turned = i / 12 % 2;
        int               t;
        int               k;
        c.seed = (uint64_t)i;
        for (k = 0; k < 3; k++) {
            c.grid.origin[k] = 0;
            c.grid.size[k] = 1;
            c.grid.lo[k] = 0;
            c.grid.hi[k] = c.n[k] = k ? 15 : 64;
        }
        c.grid.flags = 0;
        c.triangles = 8;
        c.words = 225;
        for (t = 0; t < 8; t++) { /* enough for lanes */
            float *v = c.positions + 9 * t;
            float  flip = t % 2 ? 1.0f : -1.0f;
            v[0] = 32 + flip * x * steep;
            v[1 + turned] = 0.25f;
            v[2 - turned] = 0.25f + eps;
            v[3] = 32 + flip * steep * (float)(i / 24 % 2);
            v[4 + turned] = 14.75f;
            v[5 - turned] = 14.75f + eps;
            v[6] = 32 - flip * steep;
            v[7 + turned] = (float)t + 3.5f + 4 * eps;
            v[8 - turned] = (float)t + 3.5f;
            if (i % 8 == 7) { /* as thin as triangles on sixteenths can be, lest any error be left */
                v[2 - turned] = 0.25f;
                v[4 + turned] = 0.25f + 231.0f / 16;
                v[5 - turned] = 0.25f + 232.0f / 16;
                v[7 + turned] = 0.25f + 230.0f / 16;
                v[8 - turned] = 0.25f + 231.0f / 16;
            }
        }
        for (k = 0; k < 72; k++) {
            c.doubles[k] = (double)c.positions[k];
        }
        solid_check(&c);
    }
}

/* An origin that differs from 0 by next to nothing moves centres off the faces that they lie on at 0. */
static void origins_next_to_zero(void)
{
    static const float    corners[24] = {0.5f, 0.5f, 0.5f, 2.5f, 0.5f, 0.5f, 0.5f, 2.5f, 0.5f, 2.5f, 2.5f, 0.5f,
                                         0.5f, 0.5f, 2.5f, 2.5f, 0.5f, 2.5f, 0.5f, 2.5f, 2.5f, 2.5f, 2.5f, 2.5f};
    static const uint32_t indices[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    static const double   by[3] = {0, 1e-300, -1e-300};
    int                   i;

    for (i = 0; i < 27; i++) {
        tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {4, 4, 4}, 0};
        tribox_mesh mesh;
        uint64_t    bits[16] = {0};
        const int   from[3] = {i % 3 == 2, i / 3 % 3 == 2, i / 9 == 2};
        int         ok = 1;
        int         k;
        for (k = 0; k < 64; k++) {
            grid.origin[k % 3] = by[k % 3 == 0 ? i % 3 : k % 3 == 1 ? i / 3 % 3 : i / 9];
        }
        mesh.positions = corners;
        mesh.stride = 0;
        mesh.indices = indices;
        mesh.triangles = 12;
        tribox_grid_fill_solid(&grid, &mesh, bits);
        for (k = 0; k < 64; k++) {
            const int x = k % 4 - from[0];
            const int y = k / 4 % 4 - from[1];
            const int z = k / 16 - from[2];
            const int inside = x >= 0 && x < 2 && y >= 0 && y < 2 && z >= 0 && z < 2;
            ok &= tribox_grid_get(&grid, bits, k % 4, k / 4 % 4, k / 16) == inside;
        }
        CHECK(ok);
    }
}

/* Where the grid misses a lattice by less than a centre's double can say, and where its origin is so far off
 * that a centre's double is wrong by parts of a voxel. */
static void centres_are_no_doubles(void)
{
    int i;

    random_seed(1208);
    for (i = 0; i < TEST_LOOPS(60); i++) {
        static solid_case c;
        solid_make(&c, 3 + i % 2);
        solid_check(&c);
    }
}

/* Tenths are no doubles: corners meant to be on lines of centres miss them by the last digit, or by less, or not at
 * all. */
static void tenths_are_no_doubles(void)
{
    int i;

    random_seed(1215);
    for (i = 0; i < TEST_LOOPS(60); i++) {
        static solid_case c;
        solid_make(&c, 5);
        solid_check(&c);
    }
}

/* Edges whose ends are tenths, some voxels to both sides of a centre, pass it by less than doubles can say; so do
 * slivers of floats along a line through it, whose corners are turned by rounding alone. */
static void edges_through_centres_of_tenths(void)
{
    int i;

    random_seed(1216);
    for (i = 0; i < TEST_LOOPS(60); i++) {
        static solid_case c;
        int               t;
        int               k;

        solid_make(&c, 5);
        for (t = 0; t < c.triangles; t++) {
            double     v[3][3];
            const int  sliver = random_below(2);
            const int  a = 1 + random_below(6);
            const int  b = 1 + random_below(6);
            const double along[3] = {random_signed(), random_signed(), random_signed()};
            for (k = 0; k < 3; k++) {
                const int at = 2 * (c.grid.lo[k] + random_below(c.n[k])) + 1 + (int)(c.grid.origin[k] / 0.05 + 0.5);
                const int d = random_below(5) - 2;
                const double slope = random_signed() * 0.1;
                v[0][k] = sliver ? 0.05 * at + slope * along[0] : 0.05 * (at + 2 * a * d);
                v[1][k] = sliver ? 0.05 * at + slope * along[1] : 0.05 * (at - 2 * b * d);
                v[2][k] = sliver ? 0.05 * at + slope * along[2] : 0.05 * (at + random_below(17) - 8);
            }
            for (k = 0; k < 9; k++) {
                c.positions[9 * t + k] = (float)v[k / 3][k % 3];
                c.doubles[9 * t + k] = v[k / 3][k % 3];
            }
        }
        solid_check(&c);
    }
}

/* Doubles on lines of centres, or beside them by less than floats can say: on a lattice of halves, and where the grid
 * is off one of tenths, or of 1 + 2^-36, by 1e-40; and 2^30 voxels from an origin that takes centres back to where
 * they were. Meshes of many triangles: boxes are looked at again where it pays. */
static void doubles_beside_lines_of_centres(void)
{
    enum { N = 9, ACROSS = N + 1 };
    int i;

    random_seed(1217);
    for (i = 0; i < TEST_LOOPS(200); i++) {
        static double   v[2 * N * N * 3][3];
        static double   corner[ACROSS][ACROSS][3];
        const int       far_off = i % 16 == 15;
        const double    size = i % 2 == 0 ? 1.0
                               : i % 8 < 4 ? 0.1
                               : far_off ? 1.0 + power_of_two(-18) - power_of_two(-29)
                                         : 1.0 + 1.0 / 68719476736.0;
        tribox_mesh_f64 mesh;
        tribox_grid     g;
        uint64_t        bits[12 * 12];
        uint64_t        wanted[12 * 12];
        int             t;
        int             y;
        int             z;
        int             k;

        for (k = 0; k < 3; k++) {
            g.origin[k] = i % 2 == 0 ? 0.0 : i % 4 == 1 ? 1e-40 : -1e-40;
            g.size[k] = size;
            g.lo[k] = 0;
            g.hi[k] = 12;
            if (far_off) {
                g.lo[k] = 1 << 30;
                g.hi[k] = (1 << 30) + 12;
                g.origin[k] = -size * power_of_two(30);
            }
        }
        g.flags = 0;
        for (y = 0; y < ACROSS; y++) {
            for (z = 0; z < ACROSS; z++) {
                corner[y][z][0] = size * 0.5 * random_below(24);
                corner[y][z][1] = size * 0.5 * (2 * y + (i % 4 != 2));
                corner[y][z][2] = size * 0.5 * (2 * z + (i % 4 != 2));
                for (k = 0; k < 3 && (i % 2 == 0 || far_off); k++) {
                    corner[y][z][k] += (random_below(3) - 1) * 2.8e-14; /* some 2^-45 */
                }
            }
        }
        for (t = 0; t < 2 * N * N; t++) {
            y = t / 2 / N;
            z = t / 2 % N;
            memcpy(v[3 * t], t % 2 == 0 ? corner[y][z] : corner[y + 1][z + 1], sizeof v[0]);
            memcpy(v[3 * t + 1], corner[y + 1][z], sizeof v[0]);
            memcpy(v[3 * t + 2], corner[y][z + 1], sizeof v[0]);
        }
        mesh.positions = &v[0][0];
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = 2 * N * N;
        memset(bits, 0, sizeof bits);
        memset(wanted, 0, sizeof wanted);
        tribox_grid_fill_solid_f64(&g, &mesh, bits);
        for (t = 0; t < 2 * N * N; t++) {
            mesh.positions = &v[3 * t][0];
            mesh.triangles = 1; /* fewer than go in lanes */
            tribox_grid_fill_solid_f64(&g, &mesh, wanted);
        }
        CHECK(memcmp(bits, wanted, sizeof bits) == 0);
    }
}

/* A mesh on a grid of voxels of 1, 48 triangles that are yet to be made. */
static void solid_plain(solid_case *c, int n_x, int n)
{
    int k;

    c->seed = random_state;
    for (k = 0; k < 3; k++) {
        c->grid.origin[k] = 0;
        c->grid.size[k] = 1;
        c->grid.lo[k] = 0;
        c->grid.hi[k] = c->n[k] = k ? n : n_x;
    }
    c->grid.flags = 0;
    c->triangles = SOLID_TRIANGLES;
    c->words = (size_t)((n_x + 63) / 64 * n * n);
}

static void solid_check_doubles(solid_case *c)
{
    int i;

    for (i = 0; i < 9 * c->triangles; i++) {
        c->positions[i] = (float)c->doubles[i];
    }
    solid_check(c);
}

/* Where the corners are on sixteenths and the centres are not, a centre beside an edge is not on it. */
static void lattices_that_centres_are_beside(void)
{
    int i;
    int k;

    random_seed(1219);
    for (i = 0; i < 4; i++) {
        static solid_case c;
        solid_plain(&c, 12, 9);
        for (k = 0; k < 3; k++) {
            c.grid.size[k] = 1.0009765625;
        }
        for (k = 0; k < 9 * SOLID_TRIANGLES; k++) { /* an edge through some centre but for the size's end */
            const int at = 8 + 16 * random_below(9);
            c.doubles[k] = k % 9 < 3 ? at / 16.0 : c.doubles[k - k % 9 + k % 3] + (random_below(33) - 16) / 16.0;
            if (k % 9 >= 6) {
                const double first = c.doubles[k - 6];
                c.doubles[k] = random_below(2) ? 2 * first - c.doubles[k - 3] : c.doubles[k];
                c.doubles[k] += (random_below(3) - 1) / 16.0;
            }
        }
        solid_check_doubles(&c);
    }
}

/* Three rows are thought, the outer ones are not: what is left is the one about 0, from where doubles are not told
 * exactly. */
static void rows_about_zero(void)
{
    int i;
    int k;

    random_seed(1220);
    for (i = 0; i < 8; i++) {
        const int         a = 1 + i % 2;
        static solid_case c;
        solid_plain(&c, 12, 5);
        c.grid.origin[a] = -2.5;
        for (k = 0; k < SOLID_TRIANGLES; k++) {
            double      *v = c.doubles + 9 * k;
            const double z = 1.5 + random_below(3) + random_signed() * 0.25;
            v[0] = 12 * random_signed();
            v[3] = 12 * random_signed();
            v[6] = 12 * random_signed();
            v[a] = -1 + power_of_two(-40);
            v[3 + a] = 1 - random_below(2) * power_of_two(-41);
            v[6 + a] = random_signed() * (random_below(2) ? 1.0 : power_of_two(-45));
            v[3 - a] = z - 0.125;
            v[6 - a] = z + 0.125;
            v[9 - a] = z + 0.25 * random_signed();
        }
        solid_check_doubles(&c);
    }
}

/* Corners on a lattice but for one that is 2^-80 beside 0: from a centre it seems to be on it, and an edge through the
 * centre. */
static void corners_next_to_zero(void)
{
    int i;
    int k;

    random_seed(1223);
    for (i = 0; i < 4; i++) {
        static solid_case c;
        solid_plain(&c, 12, 5);
        for (k = 0; k < SOLID_TRIANGLES; k++) {
            const int a = 1 + random_below(2);
            const int turn = random_below(2) ? 3 : 0;
            double   *v = c.doubles + 9 * k;
            v[0] = random_below(12);
            v[3] = random_below(12);
            v[6] = random_below(12);
            v[a + turn] = random_below(2) ? (random_below(3) - 1) * power_of_two(-80) : 0;
            v[3 - a + turn] = (random_below(3) - 1) * power_of_two(-80);
            v[a + 3 - turn] = 1;
            v[3 - a + 3 - turn] = 1;
            v[6 + a] = random_below(2) ? 1 : 0.75;
            v[9 - a] = random_below(2) ? 0 : 0.25;
        }
        solid_check_doubles(&c);
    }
}

/* Sixteenths some 2^20 voxels off along x, to both sides of a row whose centre lies on an edge: they are no floats. */
static void sixteenths_far_off_along_x(void)
{
    int i;
    int k;

    random_seed(1221);
    for (i = 0; i < 4; i++) {
        static solid_case c;
        solid_plain(&c, 64, 5);
        for (k = 0; k < SOLID_TRIANGLES; k++) {
            double      *v = c.doubles + 9 * k;
            const double y = 0.5 + random_below(5);
            const double z = 0.5 + random_below(5);
            const double by_y = (random_below(13) - 6) / 16.0;
            const double by_z = (1 + random_below(6)) / 16.0;
            v[0] = -1048576 - random_below(16) / 16.0;
            v[3] = 1048576 + (random_below(960) + random_below(16)) / 16.0;
            v[6] = random_below(64);
            v[1] = y - by_y;
            v[4] = y + by_y;
            v[7] = y + (random_below(15) - 7) / 16.0;
            v[2] = z - by_z;
            v[5] = z + by_z;
            v[8] = z + (random_below(15) - 7) / 16.0;
        }
        solid_check_doubles(&c);
    }
}

/* Origins beyond what floats have digits for, and rows of more voxels than 2^16. */
static void regions_that_floats_do_not_take(void)
{
    static float    v[16][9];
    static uint64_t bits[1025];
    static uint64_t wanted[1025];
    tribox_grid     grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {65537, 1, 1}, 0};
    tribox_mesh     mesh = {v[0], 0, NULL, 16};
    int             i;
    int             k;

    random_seed(1222);
    for (i = 0; i < 4; i++) {
        static solid_case c;
        solid_plain(&c, 12, 5);
        for (k = 0; k < 3; k++) {
            c.grid.size[k] = power_of_two(50);
            c.grid.origin[k] = k == i ? power_of_two(90) : 0;
        }
        for (k = 0; k < 9 * SOLID_TRIANGLES; k++) {
            c.doubles[k] = c.grid.origin[k % 3] + c.grid.size[0] * (6 * random_signed() + 3);
        }
        solid_check_doubles(&c);
    }
    for (i = 0; i < 16; i++) {
        double  corner[3][3];
        int64_t half[3] = {0, 1, 1};
        int     first = 0;
        int     end = 65537;
        for (k = 0; k < 9; k++) {
            v[i][k] = (float)(k % 3 == 0 ? 32768 + random_signed() * 32800 : random_signed() * 2 + (k == 4 || k == 8));
            corner[k / 3][k % 3] = (double)v[i][k];
        }
        while (first < end) {
            k = first + (end - first) / 2;
            half[0] = 2 * k + 1;
            if (solid_crosses(corner, grid.origin, grid.size, half)) {
                end = k;
            } else {
                first = k + 1;
            }
        }
        for (; first < 65537; first++) {
            wanted[first / 64] ^= (uint64_t)1 << (first % 64);
        }
    }
    tribox_grid_fill_solid(&grid, &mesh, bits);
    CHECK(memcmp(bits, wanted, sizeof bits) == 0);
}

/* Corners on a lattice are computed with as they are while they are near the region; farther off, products of them are
 * no doubles. An edge passes a centre by as little as whole numbers can: Fibonacci's f(n) f(n) - f(n - 1) f(n + 1) is
 * 1 or -1. Integers say on which side the centre is. */
static void corners_far_off_on_a_lattice(void)
{
    int i;
    int k;

    random_seed(1209);
    for (i = 0; i < TEST_LOOPS(400); i++) {
        static const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, 0};
        static const double      p[3] = {0.5, 0.5, 0.5};
        const int                y = 1 + random_below(2);
        const int                z = 3 - y;
        const double             turn = random_below(2) ? 1 : -1;
        double                   f[3] = {1, 1, 2};
        double                   corner[3][3];
        double                  *v = corner[0];
        uint64_t                 bits = 0;
        tribox_mesh_f64          mesh;
        for (k = 10 + random_below(33); k > 0; k--) {
            f[0] = f[1];
            f[1] = f[2];
            f[2] = f[0] + f[1];
        }
        for (k = 0; k < 9; k++) {
            v[k] = k % 3 == 0 ? -1.0 - random_below(3) : 0.5 + (double)(int)(random_signed() * f[2]);
        }
        v[3 + y] = 0.5 + f[1] * turn;
        v[3 + z] = 0.5 + f[2];
        v[6 + y] = 0.5 - f[0] * turn;
        v[6 + z] = 0.5 - f[1];
        mesh.positions = v;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 1;
        tribox_grid_fill_solid_f64(&grid, &mesh, &bits);
        CHECK((int)bits == solid_crosses(corner, p, grid.size, solid_no_half));
        CHECK((int)bits == tribox_mesh_contains_f64(&mesh, p));
    }
}

/* One triangle, one point: as exact numbers say, for points beside, on and along everything; so is the whole
 * mesh. */
static void rays_cross_as_exact_numbers_say(void)
{
    int i;

    random_seed(1202);
    for (i = 0; i < TEST_LOOPS(3000); i++) {
        static const double no_step[3] = {0, 0, 0};
        double              v[3][3];
        float               f[3][3];
        double              p[3];
        tribox_mesh         mesh;
        tribox_mesh_f64     mesh_f64;
        int                 k;
        int                 got;
        int                 n = 2 + random_below(6);
        int                 kind = random_below(5);
        double              scale = kind == 2 ? 0.1 : kind == 3 ? 1e-30 : 1;
        double              most = 1;
        for (k = 0; k < 200 && kind == 4; k++) {
            most *= 2;
        }
        for (k = 0; k < 12; k++) {
            double x = random_below(n) * scale;
            if (kind == 1) {
                x += random_signed() * 1e-7;
            }
            if (k < 9) {
                v[k / 3][k % 3] = rounded_to_float(x);
                f[k / 3][k % 3] = (float)v[k / 3][k % 3];
            } else {
                p[k - 9] = random_below(3) ? rounded_to_float(x) : x;
            }
        }
        if (random_below(4) == 0) { /* halfway between corners: on an edge where the lattice is fine enough */
            for (k = 0; k < 3; k++) {
                p[k] = (v[0][k] + v[1][k]) * 0.5;
            }
        }
        got = tribox_ray_crosses(f[0], f[1], f[2], p);
        if (!CHECK(got == solid_crosses(v, p, no_step, solid_no_half)) && test_wants_details()) {
            printf("  {%a %a %a} {%a %a %a} {%a %a %a} point %a %a %a: %d\n", v[0][0], v[0][1], v[0][2],
                   v[1][0], v[1][1], v[1][2], v[2][0], v[2][1], v[2][2], p[0], p[1], p[2], got);
        }
        mesh.positions = f[0];
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 1;
        mesh_f64.positions = v[0];
        mesh_f64.stride = 0;
        mesh_f64.indices = 0;
        mesh_f64.triangles = 1;
        CHECK(tribox_mesh_contains(&mesh, p) == got);
        for (k = 0; k < 9; k++) {
            v[k / 3][k % 3] *= most;
            p[k % 3] *= k < 3 ? most : 1;
        }
        CHECK(tribox_mesh_contains_f64(&mesh_f64, p) == got);
        p[i % 3] = (double)solid_special(i % 2);
        CHECK(tribox_ray_crosses(f[0], f[1], f[2], p) == 0);
        f[i % 3][(i / 3) % 3] = solid_special(3 + i % 2);
        p[i % 3] = 0;
        CHECK(tribox_ray_crosses(f[0], f[1], f[2], p) == 0);
        CHECK(tribox_mesh_contains(&mesh, p) == 0);
    }
}

/* Points that lie on an edge or on the plane but for the last bits of doubles: what rounds is asked exactly. */
static void points_beside_edges_and_planes_of_doubles(void)
{
    int i;

    random_seed(1209);
    for (i = 0; i < TEST_LOOPS(2000); i++) {
        static const double no_step[3] = {0, 0, 0};
        double              v[3][3];
        double              p[3];
        double              a = 0.5 + 0.4 * random_signed();
        double              b = i % 2 ? 0 : (1 - a) * 0.5;
        tribox_mesh_f64     mesh;
        int                 k;
        for (k = 0; k < 9; k++) {
            v[k / 3][k % 3] = random_signed();
        }
        for (k = 0; k < 3; k++) {
            p[k] = v[0][k] * (1 - a - b) + v[1][k] * a + v[2][k] * b;
        }
        p[0] += i % 2;
        mesh.positions = v[0];
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 1;
        CHECK(tribox_mesh_contains_f64(&mesh, p) == solid_crosses(v, p, no_step, solid_no_half));
    }
}

/* A slab writes its part, whatever is cut off: the first and last layers, rows and columns alone. */
static void parts_of_a_region_have_the_bits_of_the_whole(void)
{
    int i;

    random_seed(1203);
    for (i = 0; i < TEST_LOOPS(300); i++) {
        static solid_case c;
        static uint64_t   whole[SOLID_WORDS];
        static uint64_t   bits[SOLID_WORDS];
        tribox_mesh       mesh;
        tribox_grid       cut;
        int               a;
        int               x;
        int               y;
        int               z;
        int               same = 1;
        solid_make(&c, i % 3);
        mesh = solid_mesh(&c);
        memset(whole, 0, sizeof whole);
        memset(bits, 0, sizeof bits);
        tribox_grid_fill_solid(&c.grid, &mesh, whole);
        cut = c.grid;
        for (a = 0; a < 3; a++) {
            cut.lo[a] += random_below(c.n[a]);
            cut.hi[a] = cut.lo[a] + 1 + random_below(c.grid.hi[a] - cut.lo[a]);
        }
        tribox_grid_fill_solid(&cut, &mesh, bits);
        for (z = cut.lo[2]; z < cut.hi[2]; z++) {
            for (y = cut.lo[1]; y < cut.hi[1]; y++) {
                for (x = cut.lo[0]; x < cut.hi[0]; x++) {
                    same &= tribox_grid_get(&cut, bits, x, y, z) == tribox_grid_get(&c.grid, whole, x, y, z);
                }
            }
        }
        CHECK(same);
    }
}

/* Winding, order, sharing of corners, stride and turns of the axes of a triangle change nothing; twice is
 * nothing. */
static void the_solid_depends_on_the_set_of_triangles_alone(void)
{
    int i;

    random_seed(1204);
    for (i = 0; i < TEST_LOOPS(300); i++) {
        static solid_case c;
        static uint64_t   bits[SOLID_WORDS];
        static uint64_t   none[SOLID_WORDS];
        static float      strided[5 * 3 * SOLID_TRIANGLES];
        static uint32_t   indices[3 * SOLID_TRIANGLES];
        tribox_mesh       mesh;
        tribox_mesh_f64   mesh_f64;
        int               t;
        int               k;
        solid_make(&c, i % 3);
        mesh = solid_mesh(&c);
        memset(c.bits, 0, sizeof c.bits);
        tribox_grid_fill_solid(&c.grid, &mesh, c.bits);
        memset(bits, 0, sizeof bits);
        for (t = 0; t < 3 * c.triangles; t++) {
            for (k = 0; k < 3; k++) {
                strided[5 * t + k] = c.positions[3 * t + k];
            }
            strided[5 * t + 3] = strided[5 * t + 4] = 1e30f;
            indices[t] = (uint32_t)t;
        }
        for (t = c.triangles - 1; t > 0; t--) {
            int other = random_below(t + 1);
            for (k = 0; k < 3; k++) {
                uint32_t moved = indices[3 * t + k];
                indices[3 * t + k] = indices[3 * other + k];
                indices[3 * other + k] = moved;
            }
        }
        for (t = 0; t < c.triangles; t++) {
            int      turn = random_below(3);
            uint32_t a = indices[3 * t];
            indices[3 * t] = indices[3 * t + turn];
            indices[3 * t + turn] = a;
        }
        mesh.indices = indices;
        tribox_grid_fill_solid(&c.grid, &mesh, bits);
        CHECK(solid_same(&c, bits, "shuffled and indexed"));
        memset(bits, 0, sizeof bits);
        mesh.positions = strided;
        mesh.stride = 5 * sizeof(float);
        tribox_grid_fill_solid(&c.grid, &mesh, bits);
        CHECK(solid_same(&c, bits, "strided"));
        tribox_grid_fill_solid(&c.grid, &mesh, bits);
        CHECK(memcmp(bits, none, c.words * sizeof *bits) == 0);
        mesh_f64 = solid_mesh_f64(&c);
        tribox_grid_fill_solid_f64(&c.grid, &mesh_f64, bits);
        mesh_f64.indices = indices;
        tribox_grid_fill_solid_f64(&c.grid, &mesh_f64, bits);
        CHECK(memcmp(bits, none, c.words * sizeof *bits) == 0);
    }
}

/* Numbers of any size: a mesh and its grid times a power of two, however far, have the same bits. */
static void powers_of_two_change_nothing(void)
{
    static const int powers[8] = {-1000, -900, -500, -140, 100, 200, 600, 960};
    int              i;

    random_seed(1205);
    for (i = 0; i < TEST_LOOPS(240); i++) {
        static solid_case c;
        static uint64_t   bits[SOLID_WORDS];
        tribox_mesh_f64   mesh;
        uint64_t          field = (uint64_t)(1023 + powers[i % 8]) << 52;
        double            power;
        int               k;
        solid_make(&c, 0);
        memcpy(&power, &field, sizeof power);
        mesh = solid_mesh_f64(&c);
        memset(c.bits, 0, sizeof c.bits);
        tribox_grid_fill_solid_f64(&c.grid, &mesh, c.bits);
        for (k = 0; k < 9 * c.triangles; k++) {
            c.doubles[k] *= power;
        }
        for (k = 0; k < 3; k++) {
            c.grid.origin[k] *= power;
            c.grid.size[k] *= power;
        }
        memset(bits, 0, sizeof bits);
        tribox_grid_fill_solid_f64(&c.grid, &mesh, bits);
        CHECK(solid_same(&c, bits, "scaled"));
    }
}

/* ---- Closed meshes ------------------------------------------------------------------------------------- */

static size_t solid_add_quad(float *out, size_t at, const int cell[3], int axis, int side, float scale)
{
    static const int corner[6] = {0, 1, 2, 0, 2, 3};
    int              b = (axis + 1) % 3;
    int              c = (axis + 2) % 3;
    int              i;

    for (i = 0; i < 6; i++) {
        float *v = out + 9 * at + 3 * i;
        v[axis] = scale * (float)(cell[axis] + side);
        v[b] = scale * (float)(cell[b] + (corner[i] == 1 || corner[i] == 2));
        v[c] = scale * (float)(cell[c] + (corner[i] >= 2));
    }
    return at + 2;
}

static int solid_count(const uint64_t *bits, size_t words)
{
    int    count = 0;
    size_t i;

    for (i = 0; i < words; i++) {
        uint64_t w;
        for (w = bits[i]; w != 0; w &= w - 1) {
            count++;
        }
    }
    return count;
}

/* A model of 7 x 5 x 3 unit cubes, meshed by its outer faces, is given back voxel by voxel, also where corners
 * lie on the centres (origin 1/2): a point of a face belongs to the solid iff it is a lower one. */
static void voxel_models_come_back(void)
{
    int i;

    random_seed(1206);
    for (i = 0; i < TEST_LOOPS(300); i++) {
        static float positions[9 * 12 * 105];
        char         set[105];
        uint64_t     bits[11 * 9];
        tribox_grid  grid;
        tribox_mesh  mesh;
        size_t       triangles = 0;
        int          left = 67;
        int          shift = i % 3; /* the corners: on the planes, on the centres, between */
        int          same = 1;
        int          cell[3];
        int          k;
        for (k = 0; k < 105; k++) { /* 67 of 105 */
            set[k] = (char)(random_below(105 - k) < left);
            left -= set[k];
        }
        for (k = 0; k < 105; k++) {
            int axis;
            cell[0] = k % 7;
            cell[1] = k / 7 % 5;
            cell[2] = k / 35;
            for (axis = 0; axis < 3; axis++) {
                static const int n[3] = {7, 5, 3};
                static const int step[3] = {1, 7, 35};
                int              side;
                for (side = 0; side < 2; side++) {
                    int beyond = side ? cell[axis] + 1 < n[axis] && set[k + step[axis]] :
                                        cell[axis] > 0 && set[k - step[axis]];
                    if (set[k] && !beyond) {
                        triangles = solid_add_quad(positions, triangles, cell, axis, side, 1);
                    }
                }
            }
        }
        for (k = 0; k < 3; k++) {
            grid.origin[k] = shift == 0 ? 0 : shift == 1 ? -0.5 : 0.25;
            grid.size[k] = 1;
            grid.lo[k] = -2;
            grid.hi[k] = 7 + 2 - 2 * k;
        }
        grid.flags = 0;
        mesh.positions = positions;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = triangles;
        memset(bits, 0, sizeof bits);
        tribox_grid_fill_solid(&grid, &mesh, bits);
        CHECK(solid_count(bits, 99) == 67);
        for (k = 0; k < 105; k++) {
            same &= tribox_grid_get(&grid, bits, k % 7, k / 7 % 5, k / 35) == set[k];
        }
        CHECK(same);
    }
}

/* A cube of 8 with a cavity of 4: 512 - 64 voxels, both windings of the cavity. */
static void cavities_stay_empty(void)
{
    static float positions[9 * 24];
    uint64_t     bits[100];
    tribox_grid  grid;
    tribox_mesh  mesh;
    size_t       triangles = 0;
    int          axis;
    int          k;

    for (axis = 0; axis < 3; axis++) {
        int zero[3] = {0, 0, 0};
        triangles = solid_add_quad(positions, triangles, zero, axis, 0, 8);
        triangles = solid_add_quad(positions, triangles, zero, axis, 1, 8);
    }
    for (axis = 0; axis < 3; axis++) {
        int zero[3] = {0, 0, 0};
        triangles = solid_add_quad(positions, triangles, zero, axis, 0, 4);
        triangles = solid_add_quad(positions, triangles, zero, axis, 1, 4);
    }
    for (k = 9 * 12; k < 9 * 24; k++) {
        positions[k] += 2;
    }
    for (k = 0; k < 3; k++) {
        grid.origin[k] = 0;
        grid.size[k] = 1;
        grid.lo[k] = -1;
        grid.hi[k] = 9;
    }
    grid.flags = 0;
    mesh.positions = positions;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = triangles;
    memset(bits, 0, sizeof bits);
    tribox_grid_fill_solid(&grid, &mesh, bits);
    CHECK(solid_count(bits, 100) == 448);
}

/* The six tetrahedra of Kuhn tile a lattice of skew cells: every centre, on faces, edges and corners, too, lies
 * in exactly one. */
static void solids_that_tile_space_tile_the_centres(void)
{
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    static const int face[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    int              i;

    random_seed(1207);
    for (i = 0; i < TEST_LOOPS(8); i++) {
        uint64_t    once[64];
        uint64_t    twice[64];
        tribox_grid grid;
        double      edge[3][3];
        int         cells = 0;
        int         cell;
        int         k;
        int         w;
        for (k = 0; k < 9; k++) {
            edge[k / 3][k % 3] = 0.5 * (random_below(5) - 2) + (k % 4 == 0 ? 6 : 0);
        }
        for (k = 0; k < 3; k++) {
            grid.origin[k] = 0.5 * random_below(2);
            grid.size[k] = random_below(2) ? 1 : 0.5;
            grid.lo[k] = -4;
            grid.hi[k] = 4;
        }
        grid.flags = 0;
        memset(once, 0, sizeof once);
        memset(twice, 0, sizeof twice);
        for (cell = 0; cell < 343; cell++) { /* 7^3 cells about the origin cover the region */
            int t;
            for (t = 0; t < 6; t++) {
                float       corner[4][3];
                float       v[4][9];
                uint64_t    bits[64];
                tribox_mesh mesh;
                int         j;
                for (k = 0; k < 3; k++) {
                    double x = (cell % 7 - 3) * edge[0][k] + (cell / 7 % 7 - 3) * edge[1][k] +
                               (cell / 49 - 3) * edge[2][k];
                    corner[0][k] = (float)x;
                    for (j = 0; j < 3; j++) {
                        x += edge[order[t][j]][k];
                        corner[j + 1][k] = (float)x;
                    }
                }
                for (j = 0; j < 12; j++) {
                    memcpy(v[j / 3] + j % 3 * 3, corner[face[j / 3][j % 3]], sizeof corner[0]);
                }
                mesh.positions = v[0];
                mesh.stride = 0;
                mesh.indices = 0;
                mesh.triangles = 4;
                memset(bits, 0, sizeof bits);
                tribox_grid_fill_solid(&grid, &mesh, bits);
                for (w = 0; w < 64; w++) {
                    twice[w] |= once[w] & bits[w];
                    once[w] |= bits[w];
                }
                cells++;
            }
        }
        CHECK(solid_count(twice, 64) == 0);
        CHECK(solid_count(once, 64) == 512);
    }
}

/* Closed meshes of any shape: beyond the mesh in +x every row is even, however its corners lie. */
static void no_row_of_a_closed_mesh_leaks(void)
{
    int i;

    random_seed(1208);
    for (i = 0; i < TEST_LOOPS(2000); i++) {
        static float positions[9 * 4 * 8];
        uint64_t     bits[81];
        tribox_grid  grid;
        tribox_mesh  mesh;
        int          t;
        int          k;
        int          even = 1;
        int          kind = random_below(3);
        for (t = 0; t < 8; t++) {
            static const int face[12] = {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3};
            float            corner[4][3];
            for (k = 0; k < 12; k++) {
                corner[k / 3][k % 3] = (float)(kind == 0 ? 0.5 * random_below(17) :
                                               kind == 1 ? 0.1 * random_below(80) :
                                                           4 + 4 * random_signed());
            }
            for (k = 0; k < 12; k++) {
                memcpy(positions + 36 * t + 3 * k, corner[face[k]], sizeof corner[0]);
            }
        }
        for (k = 0; k < 3; k++) {
            grid.origin[k] = kind == 1 ? 0.05 * random_below(3) : 0.25 * random_below(4);
            grid.size[k] = kind == 1 ? 0.1 * (1 + random_below(10)) : 0.5 * (1 + random_below(3));
            grid.lo[k] = 0;
            grid.hi[k] = 9;
        }
        grid.hi[0] = 64;
        grid.size[0] = 0.25;
        grid.flags = 0;
        mesh.positions = positions;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 32;
        memset(bits, 0, sizeof bits);
        tribox_grid_fill_solid(&grid, &mesh, bits);
        for (k = 0; k < 81; k++) {
            even &= (int)(~bits[k] >> 63);
        }
        CHECK(even);
    }
}

/* ---- Odd inputs ---------------------------------------------------------------------------------------- */

/* NaN and infinite corners are no triangle; the others beside them are what they were. The largest floats
 * are numbers like any other. */
static void corners_that_are_no_points_cross_nothing(void)
{
    int i;

    random_seed(1209);
    for (i = 0; i < TEST_LOOPS(30); i++) {
        static solid_case c;
        static uint64_t   bits[SOLID_WORDS];
        tribox_mesh       mesh;
        tribox_mesh_f64   mesh_f64;
        int               t;
        solid_make(&c, i % 3);
        for (t = 0; t < c.triangles; t++) {
            if (random_below(3) == 0) {
                int k = 9 * t + random_below(9);
                c.positions[k] = solid_special(random_below(6));
            }
        }
        for (t = 0; t < 9 * c.triangles; t++) {
            uint32_t as_float;
            memcpy(&as_float, &c.positions[t], sizeof as_float);
            if ((as_float & 0x7f800000u) == 0x7f800000u) { /* doubles of the same kind, made of bits */
                uint64_t as_double = (uint64_t)(as_float >> 31) << 63 | (uint64_t)0x7ff0000000000000u |
                                     (uint64_t)(as_float & 0x7fffffu) << 29;
                memcpy(&c.doubles[t], &as_double, sizeof as_double);
            } else {
                c.doubles[t] = (double)c.positions[t];
            }
        }
        mesh = solid_mesh(&c);
        mesh_f64 = solid_mesh_f64(&c);
        solid_expect(&c, 1);
        memset(bits, 0, sizeof bits);
        tribox_grid_fill_solid(&c.grid, &mesh, bits);
        CHECK(solid_same(&c, bits, "special floats"));
        memset(bits, 0, sizeof bits);
        tribox_grid_fill_solid_f64(&c.grid, &mesh_f64, bits);
        CHECK(solid_same(&c, bits, "special doubles"));
    }
}

/* A triangle far larger than the region, and one of subnormals in a region of them. */
static void triangles_of_any_size_cross(void)
{
    static const float huge_one[9] = {-3e38f, -3e38f, -3e38f, 3e38f, 3e38f, -3e38f, 1e38f, -2e38f, 3e38f};
    static const float tiny[9] = {3e-45f, 0, 0, 3e-45f, 6e-45f, 0, 3e-45f, 0, 6e-45f};
    double             v[3][3];
    int                which;

    for (which = 0; which < 2; which++) {
        static const double    sizes[2] = {1, 1.4012984643248171e-45};
        const float           *t = which ? tiny : huge_one;
        uint64_t               bits[64];
        tribox_grid            grid;
        tribox_mesh            mesh;
        int                    k;
        int                    x;
        int                    same = 1;
        for (k = 0; k < 9; k++) {
            v[k / 3][k % 3] = (double)t[k];
        }
        if (which) { /* 2^-149 times 2, 4: a processor that flushes reads them as 0 */
            for (k = 0; k < 9; k++) {
                v[k / 3][k % 3] = k % 3 == 0 ? 2 * sizes[1] : (k == 4 || k == 8) ? 4 * sizes[1] : 0;
            }
        }
        for (k = 0; k < 3; k++) {
            grid.origin[k] = 0;
            grid.size[k] = sizes[which];
            grid.lo[k] = -4;
            grid.hi[k] = 4;
        }
        grid.flags = 0;
        mesh.positions = t;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 1;
        memset(bits, 0, sizeof bits);
        tribox_grid_fill_solid(&grid, &mesh, bits);
        for (k = 0; k < 64; k++) {
            for (x = 0; x < 8; x++) {
                int64_t half[3];
                half[0] = 2 * (x - 4) + 1;
                half[1] = 2 * (k % 8 - 4) + 1;
                half[2] = 2 * (k / 8 - 4) + 1;
                same &= (int)(bits[k] >> x & 1) == solid_crosses(v, grid.origin, grid.size, half);
            }
        }
        CHECK(same);
    }
}

/* A triangle whose corners lie up to 2^60 voxels off along x crosses rows in the region where its plane does: a bit array
 * of 64 x 20 x 20, the triangle among enough others that are points. */
static void corners_far_off_along_x(void)
{
    int i;

    random_seed(1210);
    for (i = 0; i < TEST_LOOPS(200); i++) {
        static uint64_t bits[400];
        float           t[8][9];
        double          v[3][3];
        tribox_grid     grid;
        tribox_mesh     mesh;
        int             same = 1;
        int             k;
        int             x;
        memset(t, 0, sizeof t);
        memset(bits, 0, sizeof bits);
        for (k = 0; k < 9; k++) {
            double far_off = random_below(2) ? (double)((uint64_t)1 << (20 + random_below(41))) : 64;
            t[3][k] = (float)(k % 3 ? 30 * random_signed() + 10 : far_off * random_signed());
            v[k / 3][k % 3] = (double)t[3][k];
        }
        for (k = 0; k < 3; k++) {
            grid.origin[k] = 0;
            grid.size[k] = 1;
            grid.lo[k] = 0;
            grid.hi[k] = k ? 20 : 64;
        }
        grid.flags = 0;
        mesh.positions = t[0];
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 8;
        tribox_grid_fill_solid(&grid, &mesh, bits);
        for (k = 0; k < 400; k++) {
            for (x = 0; x < 64; x += 9) {
                int64_t half[3];
                half[0] = 2 * x + 1;
                half[1] = 2 * (k % 20) + 1;
                half[2] = 2 * (k / 20) + 1;
                same &= (int)(bits[k] >> x & 1) == solid_crosses(v, grid.origin, grid.size, half);
            }
        }
        CHECK(same);
    }
}

/* The last indices there are, and origins far off; empty regions and points that are none answer nothing. */
static void indices_reach_to_the_end_and_odd_regions_stay_as_they_are(void)
{
    static const double t[9] = {(double)2147483600 + 0.25, 0, 0, (double)2147483600 + 0.25, 9, 0, (double)2147483600 + 0.25, 0, 9};
    static const double far_off[3] = {(double)2147483601, 1.0, 1.0};
    tribox_mesh_f64     mesh;
    tribox_mesh         floats;
    tribox_grid         grid;
    uint64_t            bits[64];
    double              p[3];
    int                 k;

    for (k = 0; k < 3; k++) {
        grid.origin[k] = 0;
        grid.size[k] = 1;
        grid.lo[k] = 0;
        grid.hi[k] = 4;
    }
    grid.lo[0] = INT_MAX - 60;
    grid.hi[0] = INT_MAX;
    grid.flags = 0;
    mesh.positions = t;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    memset(bits, 0, sizeof bits);
    tribox_grid_fill_solid_f64(&grid, &mesh, bits);
    CHECK(bits[0] == (((uint64_t)1 << 60) - 1) >> 13 << 13);
    CHECK(tribox_mesh_contains_f64(&mesh, far_off) == 1);
    for (k = 0; k < 3; k++) {
        memcpy(p, far_off, sizeof p);
        p[k] = (double)solid_special(3 + k % 2);
        CHECK(tribox_mesh_contains_f64(&mesh, p) == 0);
        p[k] = (double)solid_special(0);
        CHECK(tribox_mesh_contains_f64(&mesh, p) == 0);
    }
    grid.hi[1] = 0;
    memset(bits, 0, sizeof bits);
    tribox_grid_fill_solid_f64(&grid, &mesh, bits);
    floats.positions = 0;
    floats.stride = 0;
    floats.indices = 0;
    floats.triangles = 0;
    grid.hi[1] = 4;
    tribox_grid_fill_solid(&grid, &floats, bits);
    grid.size[2] = 0;
    tribox_grid_fill_solid_f64(&grid, &mesh, bits);
    CHECK(solid_count(bits, 64) == 0);
    CHECK(tribox_mesh_contains(&floats, far_off) == 0);
}

/* Rows of whole words have no padding: a crossing right behind the last voxel flips nothing of the next row. */
static void crossings_behind_whole_words_flip_nothing(void)
{
    static const float v[9] = {64.2f, 0.2f, 0.2f, 64.2f, 0.9f, 0.3f, 64.2f, 0.4f, 0.9f};
    tribox_grid        grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {64, 2, 2}, 0};
    tribox_mesh        mesh = {v, 0, NULL, 1};
    uint64_t           bits[4] = {0, 0, 0, 0};

    tribox_grid_fill_solid(&grid, &mesh, bits);
    CHECK((bits[0] | bits[1] | bits[2] | bits[3]) == 0);
    grid.hi[0] = 128;
    grid.hi[1] = 1;
    tribox_grid_fill_solid(&grid, &mesh, bits);
    CHECK(bits[0] == 0 && bits[1] == ~(uint64_t)0 && bits[2] == 0 && bits[3] == 0);
}

int main(void)
{
    RUN(fill_flips_the_voxels_whose_centre_is_inside);
    RUN(grids_of_any_scale);
    RUN(middle_corners_on_centres_of_tenths);
    RUN(slivers_through_centres);
    RUN(origins_next_to_zero);
    RUN(centres_are_no_doubles);
    RUN(tenths_are_no_doubles);
    RUN(edges_through_centres_of_tenths);
    RUN(doubles_beside_lines_of_centres);
    RUN(lattices_that_centres_are_beside);
    RUN(rows_about_zero);
    RUN(corners_next_to_zero);
    RUN(sixteenths_far_off_along_x);
    RUN(regions_that_floats_do_not_take);
    RUN(corners_far_off_on_a_lattice);
    RUN(rays_cross_as_exact_numbers_say);
    RUN(points_beside_edges_and_planes_of_doubles);
    RUN(parts_of_a_region_have_the_bits_of_the_whole);
    RUN(the_solid_depends_on_the_set_of_triangles_alone);
    RUN(powers_of_two_change_nothing);
    RUN(voxel_models_come_back);
    RUN(cavities_stay_empty);
    RUN(solids_that_tile_space_tile_the_centres);
    RUN(no_row_of_a_closed_mesh_leaks);
    RUN(corners_that_are_no_points_cross_nothing);
    RUN(triangles_of_any_size_cross);
    RUN(corners_far_off_along_x);
    RUN(indices_reach_to_the_end_and_odd_regions_stay_as_they_are);
    RUN(crossings_behind_whole_words_flip_nothing);
    return test_report("test_solid");
}
