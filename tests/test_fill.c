/* The fill of a mesh into a bit array: the union of its triangles' spans, at the documented bit, in any
 * slabs, from any stride, alignment and index list, and nothing beside. */
#include "tribox.h"

#include <limits.h>
#include <math.h>

#include "voxels.h"

enum { FILL_TRIANGLES = 70, FILL_WORDS = 3 * 9 * 9, GUARD = 4 };

/* A mesh of triangles of all sizes about a region up to 3 words wide, and the bits it should set, by
 * spans. */
typedef struct fill_case {
    tribox_grid grid;
    int         n[3];
    int         triangles;
    uint64_t    seed;
    float       positions[9 * FILL_TRIANGLES];
    uint64_t    expected[FILL_WORDS];
    size_t      words;
} fill_case;

static void set_expected(void *user, int x0, int x1, int y, int z)
{
    fill_case *c = (fill_case *)user;
    size_t     row_words = (size_t)(c->n[0] + 63) / 64;
    size_t row = ((size_t)(z - c->grid.lo[2]) * (size_t)c->n[1] + (size_t)(y - c->grid.lo[1])) * row_words;
    int        x;

    for (x = x0 - c->grid.lo[0]; x <= x1 - c->grid.lo[0]; x++) {
        c->expected[row + (size_t)x / 64] |= (uint64_t)1 << (x % 64);
    }
}

static void fill_make(fill_case *c)
{
    static const double sizes[5] = {1, 0.5, 0.1, 1.0 / 3, 3};
    int                 a;
    int                 i;
    double              reach = random_below(3) ? 1 : random_below(2) ? 4 : 30;

    c->seed = random_state;
    for (a = 0; a < 3; a++) {
        c->n[a] = a == 0 ? 1 + random_below(160) : 1 + random_below(9);
        c->grid.size[a] = sizes[random_below(5)];
        c->grid.origin[a] = random_below(2) ? 0 : random_signed();
        c->grid.lo[a] = random_below(9) - 5;
        c->grid.hi[a] = c->grid.lo[a] + c->n[a];
    }
    c->grid.flags = every_rule[random_below(4)];
    c->triangles = random_below(3) ? random_below(FILL_TRIANGLES + 1) : 1 + random_below(9);
    for (i = 0; i < 9 * c->triangles; i++) {
        double centre = grid_plane(&c->grid, i % 3, c->grid.lo[i % 3] + c->n[i % 3] * 0.5);
        double x = i % 9 < 3 ? centre + random_signed() * 0.6 * c->n[i % 3] * c->grid.size[i % 3] :
                   (double)c->positions[i - 3] + random_signed() * reach * c->grid.size[i % 3];
        if (random_below(6) == 0) {
            x = grid_plane(&c->grid, i % 3, c->grid.lo[i % 3] + random_below(c->n[i % 3] + 1));
        }
        c->positions[i] = (float)x;
    }
    c->words = (size_t)((c->n[0] + 63) / 64 * c->n[1] * c->n[2]);
    memset(c->expected, 0, sizeof c->expected);
    for (i = 0; i < c->triangles; i++) {
        const float *t = c->positions + 9 * i;
        tribox_grid_spans(&c->grid, t, t + 3, t + 6, set_expected, c);
    }
}

static tribox_mesh plain_mesh(const fill_case *c)
{
    tribox_mesh mesh;

    mesh.positions = c->positions;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = (size_t)c->triangles;
    return mesh;
}

static int same_bits(const fill_case *c, const uint64_t *bits, const char *what)
{
    int same = memcmp(bits, c->expected, c->words * sizeof bits[0]) == 0;

    if (!same && test_wants_details()) {
        printf("  %s, flags %u, %d triangles, seed %llu\n", what, c->grid.flags, c->triangles,
               (unsigned long long)c->seed);
    }
    return same;
}

/* The fill is the union of the spans, bit for bit, and writes no word before or after the array. */
static void fill_is_the_union_of_spans(void)
{
    static fill_case c;
    int              i;

    random_seed(101);
    for (i = 0; i < TEST_LOOPS(1500); i++) {
        uint64_t    bits[FILL_WORDS + 2 * GUARD];
        tribox_mesh mesh;
        size_t      k;
        int         guarded = 1;
        fill_make(&c);
        mesh = plain_mesh(&c);
        for (k = 0; k < FILL_WORDS + 2 * GUARD; k++) {
            bits[k] = k < GUARD || k >= GUARD + c.words ? 0xA5A5A5A5A5A5A5A5u : 0;
        }
        CHECK(tribox_grid_words(&c.grid) == c.words);
        tribox_grid_fill(&c.grid, &mesh, bits + GUARD);
        CHECK(same_bits(&c, bits + GUARD, "fill"));
        for (k = 0; k < FILL_WORDS + 2 * GUARD; k++) {
            guarded = guarded && (!(k < GUARD || k >= GUARD + c.words) || bits[k] == 0xA5A5A5A5A5A5A5A5u);
        }
        CHECK(guarded);
    }
}

/* Bits are set, never cleared: what stood there stays, padding included. */
static void fill_only_adds(void)
{
    static fill_case c;
    int              i;

    random_seed(102);
    for (i = 0; i < TEST_LOOPS(300); i++) {
        uint64_t    bits[FILL_WORDS];
        uint64_t    before[FILL_WORDS];
        tribox_mesh mesh;
        size_t      k;
        int         added = 1;
        fill_make(&c);
        mesh = plain_mesh(&c);
        for (k = 0; k < FILL_WORDS; k++) {
            before[k] = bits[k] = random_below(3) ? random_bits() : random_below(2) ? ~(uint64_t)0 : 0;
        }
        tribox_grid_fill(&c.grid, &mesh, bits);
        for (k = 0; k < c.words; k++) {
            added = added && bits[k] == (before[k] | c.expected[k]);
        }
        CHECK(added);
    }
}

/* Any stride and any alignment, with an index list in any
 * order and corners that no triangle names: NaN there does no harm. */
static void positions_have_any_stride_and_alignment(void)
{
    static const size_t strides[6] = {12, 13, 16, 20, 32, 57};
    static fill_case    c;
    int                 i;

    random_seed(103);
    for (i = 0; i < TEST_LOOPS(600); i++) {
        static unsigned char buffer[57 * 3 * FILL_TRIANGLES + 64];
        static uint32_t      indices[3 * FILL_TRIANGLES];
        uint64_t             bits[FILL_WORDS];
        size_t               stride = strides[i % 6];
        size_t               offset = (size_t)random_below(16);
        tribox_mesh          mesh;
        uint32_t             k;
        uint32_t             corners;
        fill_make(&c);
        corners = (uint32_t)(3 * c.triangles);
        memset(buffer, 0xFF, sizeof buffer);
        for (k = 0; k < corners; k++) {
            indices[k] = (k + (uint32_t)i) % corners;
        }
        for (k = 0; k < corners; k++) {
            memcpy(buffer + offset + indices[k] * stride, c.positions + 3 * k, 12);
        }
        mesh.positions = (const float *)(const void *)(buffer + offset);
        mesh.stride = stride;
        mesh.indices = indices;
        mesh.triangles = (size_t)c.triangles;
        memset(bits, 0, sizeof bits);
        tribox_grid_fill(&c.grid, &mesh, bits);
        CHECK(same_bits(&c, bits, "stride, alignment and indices"));
        for (k = 0; k < corners; k++) {
            memcpy(buffer + offset + k * stride, c.positions + 3 * k, 12);
        }
        mesh.indices = 0;
        memset(bits, 0, sizeof bits);
        tribox_grid_fill(&c.grid, &mesh, bits);
        CHECK(same_bits(&c, bits, "stride and alignment"));
    }
}

/* A stride of 4: corner i starts at number i, so ten numbers make eight corners. */
static void corners_may_overlap_in_memory(void)
{
    const tribox_grid     grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {10, 10, 10}, 0};
    static const float    numbers[10] = {0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f, 8.5f, 9.5f};
    static const uint32_t indices[6] = {0, 3, 7, 6, 6, 6};
    uint64_t              bits[100];
    uint64_t              expected[100];
    tribox_mesh           mesh;
    float                 packed[18];
    int                   i;

    for (i = 0; i < 18; i++) {
        packed[i] = numbers[indices[i / 3] + (uint32_t)i % 3];
    }
    memset(bits, 0, sizeof bits);
    memset(expected, 0, sizeof expected);
    mesh.positions = packed;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 2;
    tribox_grid_fill(&grid, &mesh, expected);
    mesh.positions = numbers;
    mesh.stride = 4;
    mesh.indices = indices;
    tribox_grid_fill(&grid, &mesh, bits);
    CHECK(memcmp(bits, expected, sizeof bits) == 0);
    CHECK(tribox_grid_get(&grid, bits, 0, 1, 2) == 1);
    CHECK(tribox_grid_get(&grid, bits, 7, 8, 9) == 1);
}

/* Slabs in z, each given its part of the array, write together exactly the whole. */
static void slabs_equal_the_whole(void)
{
    static fill_case c;
    int              i;

    random_seed(104);
    for (i = 0; i < TEST_LOOPS(500); i++) {
        uint64_t    bits[FILL_WORDS];
        size_t      layer;
        tribox_mesh mesh;
        int         z;
        fill_make(&c);
        mesh = plain_mesh(&c);
        layer = (size_t)c.n[1] * ((size_t)(c.n[0] + 63) / 64);
        memset(bits, 0, sizeof bits);
        for (z = c.grid.lo[2]; z < c.grid.hi[2];) {
            tribox_grid slab = c.grid;
            slab.lo[2] = z;
            z += 1 + random_below(4);
            slab.hi[2] = z < c.grid.hi[2] ? z : c.grid.hi[2];
            tribox_grid_fill(&slab, &mesh, bits + (size_t)(slab.lo[2] - c.grid.lo[2]) * layer);
        }
        CHECK(same_bits(&c, bits, "slabs"));
    }
}

/* Regions cut in x and y hold, in arrays of their own, the same voxels as the whole. */
static void cut_regions_hold_the_same_voxels(void)
{
    static fill_case c;
    int              i;

    random_seed(105);
    for (i = 0; i < TEST_LOOPS(300); i++) {
        uint64_t    whole[FILL_WORDS];
        uint64_t    bits[FILL_WORDS];
        tribox_grid part;
        tribox_mesh mesh;
        int         same = 1;
        int         index[3];
        int         a;
        fill_make(&c);
        mesh = plain_mesh(&c);
        part = c.grid;
        for (a = 0; a < 3; a++) {
            part.lo[a] += random_below(c.n[a]);
            part.hi[a] -= random_below(c.grid.hi[a] - part.lo[a]);
        }
        memset(whole, 0, sizeof whole);
        memset(bits, 0, sizeof bits);
        tribox_grid_fill(&c.grid, &mesh, whole);
        tribox_grid_fill(&part, &mesh, bits);
        for (index[2] = part.lo[2]; index[2] < part.hi[2]; index[2]++) {
            for (index[1] = part.lo[1]; index[1] < part.hi[1]; index[1]++) {
                for (index[0] = part.lo[0]; index[0] < part.hi[0]; index[0]++) {
                    same &= tribox_grid_get(&part, bits, index[0], index[1], index[2]) ==
                            tribox_grid_get(&c.grid, whole, index[0], index[1], index[2]);
                }
            }
        }
        CHECK(same);
    }
}

/* get reads the documented bit, takes indices as spans emit them, and is 0 anywhere outside of the region. */
static void get_reads_the_documented_bit(void)
{
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {-70, -2, 5}, {60, 1, 7}, 0};
    uint64_t          bits[3 * 3 * 2];
    int               x;
    int               y;
    int               z;

    CHECK(tribox_grid_words(&grid) == 18);
    for (z = 5; z < 7; z++) {
        for (y = -2; y < 1; y++) {
            for (x = -70; x < 60; x++) {
                memset(bits, 0, sizeof bits);
                bits[((z - 5) * 3 + (y + 2)) * 3 + (x + 70) / 64] = (uint64_t)1 << ((x + 70) % 64);
                CHECK(tribox_grid_get(&grid, bits, x, y, z) == 1);
                memset(bits, 0xFF, sizeof bits);
                bits[((z - 5) * 3 + (y + 2)) * 3 + (x + 70) / 64] ^= (uint64_t)1 << ((x + 70) % 64);
                CHECK(tribox_grid_get(&grid, bits, x, y, z) == 0);
            }
        }
    }
    memset(bits, 0xFF, sizeof bits);
    CHECK(tribox_grid_get(&grid, bits, -71, 0, 5) == 0 && tribox_grid_get(&grid, bits, 60, 0, 5) == 0);
    CHECK(tribox_grid_get(&grid, bits, 0, -3, 5) == 0 && tribox_grid_get(&grid, bits, 0, 1, 5) == 0);
    CHECK(tribox_grid_get(&grid, bits, 0, 0, 4) == 0 && tribox_grid_get(&grid, bits, 0, 0, 7) == 0);
    CHECK(tribox_grid_get(&grid, bits, INT_MAX, 0, 5) == 0 &&
          tribox_grid_get(&grid, bits, INT_MIN, 0, 5) == 0);
    CHECK(tribox_grid_get(&grid, bits, 0, INT_MAX, INT_MIN) == 0);
}

/* words is row_words * ny * nz, or 0 if that many words are more than SIZE_MAX bytes: the true product by
 * the oracle's integers, for regions up to the whole index range. */
static void words_are_exact_or_zero(void)
{
    static const int ends[10] = {INT_MIN, INT_MIN + 1, -65536, -1, 0, 1, 63, 65535, INT_MAX - 1, INT_MAX};
    int              nonzero = 0;
    int              i;

    random_seed(106);
    for (i = 0; i < 20000; i++) {
        tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {0, 0, 0}, 0};
        wide        product;
        wide        limit;
        uint64_t    count[3];
        uint64_t    expected;
        int         empty = 0;
        int         a;
        for (a = 0; a < 3; a++) {
            grid.lo[a] = ends[random_below(10)];
            grid.hi[a] = random_below(3) ? ends[random_below(10)] : random_below(4096);
            empty |= grid.lo[a] >= grid.hi[a];
            count[a] = (uint64_t)((int64_t)grid.hi[a] - grid.lo[a]);
        }
        if (empty) {
            CHECK(tribox_grid_words(&grid) == 0);
            continue;
        }
        count[0] = (count[0] + 63) / 64;
        expected = count[0] * count[1] * count[2];
        wide_set(&product, 1, 8, 0);
        for (a = 0; a < 3; a++) {
            wide next;
            wide factor;
            wide_set(&factor, 1, count[a], 0);
            wide_multiply(&next, &product, &factor);
            wide_copy(&product, &next);
        }
        wide_set(&limit, 1, SIZE_MAX, 0);
        if (wide_compare(&product, &limit) > 0) {
            expected = 0;
        }
        nonzero += expected != 0;
        CHECK((uint64_t)tribox_grid_words(&grid) == expected);
    }
    CHECK(nonzero > 0);
}

/* The largest region of whole layers of 2^31 words whose bytes a size_t counts, and one layer more. */
static void words_end_at_the_last_size_that_fits(void)
{
    tribox_grid    grid = {{0, 0, 0}, {1, 1, 1}, {-64, INT_MIN, 0}, {0, 0, 0}, 0};
    const uint64_t layer = (uint64_t)1 << 31;
    const uint64_t most = SIZE_MAX / 8 / layer;

    grid.hi[2] = (int)most;
    CHECK((uint64_t)tribox_grid_words(&grid) == most * layer);
    grid.hi[2] = (int)most + 1;
    CHECK(tribox_grid_words(&grid) == 0);
}

/* A region that is empty, invalid or too large for an array: the fill touches nothing, not even a null
 * array. */
static void fill_of_no_words_does_nothing(void)
{
    static const float t[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {INT_MIN, INT_MIN, INT_MIN}, {INT_MAX, INT_MAX, INT_MAX}, 0};
    tribox_mesh        mesh;

    mesh.positions = t;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    CHECK(tribox_grid_words(&grid) == 0);
    tribox_grid_fill(&grid, &mesh, 0);
    CHECK(tribox_grid_get(&grid, 0, 0, 0, 0) == 0);
    grid.hi[1] = grid.lo[1];
    tribox_grid_fill(&grid, &mesh, 0);
    CHECK(tribox_grid_words(&grid) == 0);
    CHECK(tribox_grid_get(&grid, 0, 0, 0, 0) == 0);
}

/* Small triangles on both sides of a word's end, in rows of a few words and of more than 65,536 voxels: the
 * voxels of the spans. */
static uint64_t row_want[3 * 3 * 1100];
static uint64_t row_got[3 * 3 * 1100];
static size_t   row_words;

static void row_set(void *user, int x0, int x1, int y, int z)
{
    (void)user;
    for (; x0 <= x1; x0++) {
        row_want[(size_t)(3 * z + y) * row_words + (size_t)x0 / 64] |= (uint64_t)1 << x0 % 64;
    }
}

static void rows_of_many_words_are_filled(void)
{
    int i;

    random_seed(107);
    for (i = 0; i < TEST_LOOPS(64); i++) {
        tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {200, 3, 3}, 0};
        float       p[8 * 9];
        tribox_mesh mesh;
        int         j;
        grid.hi[0] = i % 4 == 0 ? 70000 : 200;
        grid.flags = every_rule[i / 4 % 4];
        row_words = (size_t)(grid.hi[0] + 63) / 64;
        memset(row_want, 0, sizeof row_want);
        memset(row_got, 0, sizeof row_got);
        for (j = 0; j < 8; j++) {
            const double word_end = 64.0 * (1 + random_below(grid.hi[0] / 64));
            int          c;
            for (c = 0; c < 3; c++) {
                p[9 * j + 3 * c] = (float)(word_end + random_signed());
                p[9 * j + 3 * c + 1] = (float)(1.5 + random_signed() * (i % 3 ? 0.25 : 1.25));
                p[9 * j + 3 * c + 2] = (float)(1.5 + random_signed() * (i % 2 ? 0.25 : 1.25));
            }
            tribox_grid_spans(&grid, p + 9 * j, p + 9 * j + 3, p + 9 * j + 6, row_set, 0);
        }
        mesh.positions = p;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 8;
        CHECK(tribox_grid_words(&grid) == 9 * row_words);
        tribox_grid_fill(&grid, &mesh, row_got);
        CHECK(memcmp(row_got, row_want, sizeof row_got) == 0);
    }
}

/* Small triangles of doubles whose edges pass grid edges by a hair, at 0 and in map coordinates, in rows of up to 60,000
 * voxels, far from their middle: what floats lose there is lost to no voxel. */
static void hairs_of_doubles_in_long_rows(void)
{
    static const double hair[4] = {1e-3, 1e-4, 1e-6, 1e-12};
    int                 i;

    random_seed(108);
    for (i = 0; i < TEST_LOOPS(200); i++) {
        tribox_grid     grid = {{0, 0, 0}, {0.1, 0.1, 0.1}, {0, 0, 0}, {60, 3, 3}, 0};
        double          p[8 * 9];
        tribox_mesh_f64 mesh;
        int             j;
        if (i % 2) {
            grid.origin[0] = 448262.25;
            grid.origin[1] = 5411932.7;
            grid.origin[2] = 112.3;
        }
        grid.hi[0] = i % 3 == 0 ? 60 : i % 3 == 1 ? 2000 : 60000;
        grid.flags = every_rule[i / 4 % 4];
        row_words = (size_t)(grid.hi[0] + 63) / 64;
        memset(row_want, 0, sizeof row_want);
        memset(row_got, 0, sizeof row_got);
        for (j = 0; j < 8; j++) {
            const int at[3] = {1 + random_below(grid.hi[0] - 1), 1 + random_below(2), 1 + random_below(2)};
            double   *v = p + 9 * j;
            int       k;
            for (k = 0; k < 3; k++) { /* the middle of the first edge lies beside a corner of voxels */
                const double plane = grid_plane(&grid, k, at[k]);
                v[k] = plane + random_signed() * 0.05;
                v[3 + k] = 2 * plane - v[k] + random_signed() * hair[random_below(4)] * 0.1;
                v[6 + k] = plane + random_signed() * 0.09;
            }
            if (j % 2) { /* in a layer: only the edges decide */
                const double z = grid_plane(&grid, 2, at[2]) + 0.04;
                v[2] = v[5] = v[8] = z;
            }
            tribox_grid_spans_f64(&grid, v, v + 3, v + 6, row_set, 0);
        }
        mesh.positions = p;
        mesh.stride = 0;
        mesh.indices = 0;
        mesh.triangles = 8;
        tribox_grid_fill_f64(&grid, &mesh, row_got);
        CHECK(memcmp(row_got, row_want, 9 * row_words * sizeof *row_got) == 0);
    }
}

/* A mesh of no triangles needs no positions and sets nothing. */
static void empty_mesh_sets_nothing(void)
{
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {4, 4, 4}, 0};
    tribox_mesh       mesh;
    uint64_t          bits[16];
    int               i;
    uint64_t          all = 0;

    mesh.positions = 0;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 0;
    memset(bits, 0, sizeof bits);
    tribox_grid_fill(&grid, &mesh, bits);
    for (i = 0; i < 16; i++) {
        all |= bits[i];
    }
    CHECK(all == 0);
}

/* A triangle just beyond a plane is, but for its last digits, in the voxel before it: what follows there is set. */
static void a_box_beside_a_plane_sets_no_other(void)
{
    static const float first[9] = {3.000004f, 2.2f, 2.2f, 3.000005f, 2.7f, 2.3f, 3.000006f, 2.4f, 2.8f};
    static const float second[9] = {2.2f, 2.2f, 2.2f, 2.8f, 2.7f, 2.3f, 2.4f, 2.4f, 2.8f};
    tribox_grid        grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {8, 8, 8}, 0};
    float              p[4 * 18];
    tribox_mesh        mesh;
    uint64_t           bits[64];
    int                i;

    memset(bits, 0, sizeof bits);
    for (i = 0; i < 4; i++) {
        memcpy(p + 18 * i, first, sizeof first);
        memcpy(p + 18 * i + 9, second, sizeof second);
    }
    memcpy(p, p + 9, sizeof second); /* a sure one comes first, elsewhere */
    p[0] = p[3] = p[6] = 5.5f;
    mesh.positions = p;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 8;
    for (grid.flags = 0; grid.flags <= TRIBOX_OPEN; grid.flags++) {
        for (i = 0; i < 2; i++) { /* then without the first pair: what follows a box that is not sure */
            memset(bits, 0, sizeof bits);
            mesh.positions = p + 18 * i;
            mesh.triangles = (size_t)(8 - 2 * i);
            tribox_grid_fill(&grid, &mesh, bits);
            CHECK(bits[2 * 8 + 2] == (uint64_t)(i == 0 ? 0x2c : 0x0c));
        }
    }
}

/* Corners are read as 16 bytes from before their first number, so the first vertex goes another way, wherever in a
 * block its number stands: nothing before the positions is read, as the address sanitizer can tell, and the bits
 * are those of the same corner last in the array. */
static void nothing_is_read_before_the_first_vertex(void)
{
    enum { TRIANGLES = 70, VERTICES = 300 };
    static uint32_t index[2][3 * TRIANGLES];
    static uint64_t bits[2][16 * 16];
    float          *positions = (float *)malloc((VERTICES + 1) * 3 * sizeof(float)); /* no padding before it */
    tribox_grid     grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {16, 16, 16}, 0};
    tribox_mesh     mesh;
    int             at;
    int             i;
    if (!CHECK(positions != NULL)) {
        return;
    }
    random_seed(271);
    for (i = 0; i < 3 * VERTICES; i++) {
        positions[i] = 0.01f * (float)random_below(1600);
    }
    memcpy(positions + 3 * VERTICES, positions, 3 * sizeof(float));
    mesh.positions = positions;
    mesh.stride = 0;
    mesh.triangles = TRIANGLES;
    for (at = 0; at < 3 * TRIANGLES; at++) {
        for (i = 0; i < 3 * TRIANGLES; i++) { /* also where the numbers' bytes are 0 */
            index[0][i] = index[1][i] = i % 5 ? (uint32_t)(1 + random_below(VERTICES - 1)) : 256;
        }
        index[0][at] = 0;
        index[1][at] = VERTICES;
        memset(bits, 0, sizeof bits);
        for (i = 0; i < 2; i++) {
            mesh.indices = index[i];
            tribox_grid_fill(&grid, &mesh, bits[i]);
        }
        CHECK(memcmp(bits[0], bits[1], sizeof bits[0]) == 0);
    }
    free(positions);
}

static void tenths_set(void *user, int x0, int x1, int y, int z)
{
    uint64_t *bits = (uint64_t *)user;
    int       x;
    for (x = x0; x <= x1; x++) {
        bits[8 * z + y] |= (uint64_t)1 << x;
    }
}

static void tenths_of_mesh(void *user, size_t which, int x0, int x1, int y, int z)
{
    (void)which;
    tenths_set(user, x0, x1, y, z);
}

/* Corners at thirds of voxels of a tenth, edges through grid points but for what such numbers are rounded by: as
 * near as that, boxes of few voxels are not sure in double. */
static void edges_through_grid_points_of_tenths(void)
{
    tribox_grid     grid = {{0, 0, 0}, {0.1, 0.1, 0.1}, {0, 0, 0}, {8, 8, 8}, 0};
    tribox_mesh_f64 mesh;
    double          v[9];
    uint64_t        bits[2][64];
    int             i;
    int             k;
    mesh.positions = v;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    for (i = 0; i < 20000 / TEST_SCALE; i++) {
        const int first[3] = {random_below(5), random_below(5), random_below(5)};
        for (k = 0; k < 9; k++) {
            v[k] = (3 * (first[k % 3] + random_below(4)) + 1 + random_below(2)) / 30.0;
        }
        memset(bits, 0, sizeof bits);
        grid.flags = (unsigned)random_below(3);
        tribox_grid_fill_f64(&grid, &mesh, bits[0]);
        tribox_grid_spans_f64(&grid, v, v + 3, v + 6, tenths_set, bits[1]);
        if (!CHECK(memcmp(bits[0], bits[1], sizeof bits[0]) == 0)) {
            break;
        }
    }
}

/* Doubles that are floats may be taken for floats: but not from the corner on that is none, is too large for one, or
 * too small; nor are the ones before it forgotten. */
static void doubles_that_are_floats_until_one_is_none(void)
{
    enum { TRIANGLES = 200 };
    static double v[9 * TRIANGLES];
    tribox_grid     grid = {{-1, -1, -1}, {0.5, 0.5, 0.5}, {0, 0, 0}, {8, 8, 8}, 0};
    tribox_mesh_f64 mesh;
    int             run;
    mesh.positions = v;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = TRIANGLES;
    for (run = 0; run < 64; run++) {
        const double odd[4] = {0.1, ldexp(1.0, -200), ldexp(1.0, 200), ldexp(1.0, -149)};
        const int from = run % 4 == 0 ? random_below(4) : run % 4 == 1 ? TRIANGLES : random_below(TRIANGLES);
        uint64_t  bits[3][64];
        int       t;
        int       k;
        for (t = 0; t < TRIANGLES; t++) {
            const int first[3] = {random_below(7), random_below(7), random_below(7)};
            const int extent = t % 3 == 0 ? 9 : 3;
            for (k = 0; k < 9; k++) {
                v[9 * t + k] = (first[k % 3] + random_below(extent)) / 4.0 - 1.0;
            }
            if (t >= from) {
                k = random_below(9);
                v[9 * t + k] = run % 3 == 0 ? v[9 * t + k] + 1e-12 : odd[run / 8 % 4];
            }
        }
        memset(bits, 0, sizeof bits);
        grid.flags = (unsigned)(run % 5);
        tribox_grid_fill_f64(&grid, &mesh, bits[0]);
        CHECK(tribox_mesh_spans_f64(&grid, &mesh, tenths_of_mesh, bits[1]) > 0);
        for (t = 0; t < TRIANGLES; t++) {
            tribox_grid_spans_f64(&grid, v + 9 * t, v + 9 * t + 3, v + 9 * t + 6, tenths_set, bits[2]);
        }
        CHECK(memcmp(bits[0], bits[2], sizeof bits[0]) == 0);
        CHECK(memcmp(bits[1], bits[2], sizeof bits[0]) == 0);
    }
}

int main(void)
{
    RUN(fill_is_the_union_of_spans);
    RUN(fill_only_adds);
    RUN(positions_have_any_stride_and_alignment);
    RUN(corners_may_overlap_in_memory);
    RUN(slabs_equal_the_whole);
    RUN(cut_regions_hold_the_same_voxels);
    RUN(get_reads_the_documented_bit);
    RUN(words_are_exact_or_zero);
    RUN(words_end_at_the_last_size_that_fits);
    RUN(fill_of_no_words_does_nothing);
    RUN(rows_of_many_words_are_filled);
    RUN(hairs_of_doubles_in_long_rows);
    RUN(empty_mesh_sets_nothing);
    RUN(a_box_beside_a_plane_sets_no_other);
    RUN(nothing_is_read_before_the_first_vertex);
    RUN(edges_through_grid_points_of_tenths);
    RUN(doubles_that_are_floats_until_one_is_none);
    return test_report("test_fill");
}
