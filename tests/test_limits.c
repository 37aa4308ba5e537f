/* Questions at the limits of the fast ways: grids far off, of long axes, of sizes that differ in their last bit,
 * of indices beyond a million, of more bits than caches hold; numbers beyond a format, subnormals, NaN. What a
 * fast way leaves must come out as right as what it takes: each answer is known from another function, from the
 * oracle or by hand. */
#include "tribox.h"

#include "voxels.h"

enum { LIMITS_TRIANGLES = 96, LIMITS_WORDS = 65536 };

/* A mesh in doubles and floats, and the bits of its spans. */
typedef struct limits_case {
    tribox_grid grid;
    int         triangles;
    size_t      row_words;
    size_t      words;
    double      d[9 * LIMITS_TRIANGLES];
    float       f[9 * LIMITS_TRIANGLES];
    uint64_t    want[LIMITS_WORDS];
    uint64_t    got[LIMITS_WORDS];
} limits_case;

static limits_case limits;

/* Where a row's words begin. */
static size_t limits_row(const limits_case *c, int y, int z)
{
    const tribox_grid *g = &c->grid;

    return ((size_t)(z - g->lo[2]) * (size_t)(g->hi[1] - g->lo[1]) + (size_t)(y - g->lo[1])) * c->row_words;
}

static void limits_set(void *user, int x0, int x1, int y, int z)
{
    limits_case *c = (limits_case *)user;
    const size_t row = limits_row(c, y, z);
    int          x;

    for (x = x0 - c->grid.lo[0]; x <= x1 - c->grid.lo[0]; x++) {
        c->want[row + (size_t)x / 64] |= (uint64_t)1 << (x % 64);
    }
}

static void limits_region(limits_case *c, int nx, int ny, int nz)
{
    c->grid.hi[0] = c->grid.lo[0] + nx;
    c->grid.hi[1] = c->grid.lo[1] + ny;
    c->grid.hi[2] = c->grid.lo[2] + nz;
    c->row_words = (size_t)(nx + 63) / 64;
    c->words = c->row_words * (size_t)ny * (size_t)nz;
}

/* Corners on, beside and off planes of the region, a few voxels apart. */
static void limits_mesh(limits_case *c)
{
    const int loose = random_below(2); /* none on planes */
    int       i;

    c->triangles = 1 + random_below(LIMITS_TRIANGLES);
    for (i = 0; i < 9 * c->triangles; i++) {
        const int    k = i % 3;
        const int    n = c->grid.hi[k] - c->grid.lo[k];
        const int    by_end = n > 1000 && random_below(2);
        const int    begin = by_end ? n - random_below(random_below(2) ? 6 : 100) : random_below(n + 1);
        const double at = i % 9 < 3 ? c->grid.lo[k] + begin
                                    : (c->d[i - 3] - c->grid.origin[k]) / c->grid.size[k] + random_below(5) - 2;
        double       x = grid_plane(&c->grid, k, i % 9 < 3 ? at : (double)(int64_t)at);
        switch (loose ? 0 : random_below(4)) {
        case 0:  x += random_signed() * c->grid.size[k]; break;
        case 1:  x = nudge_double(x, random_below(5) - 2); break;
        default: break;
        }
        c->d[i] = x;
    }
    for (i = 0; i < 9 * c->triangles; i++) {
        c->f[i] = (float)c->d[i];
    }
}

static void limits_unset(void *user, size_t number, int x0, int x1, int y, int z)
{
    limits_case *c = (limits_case *)user;
    const size_t row = limits_row(c, y, z);
    int          x;

    (void)number;
    for (x = x0 - c->grid.lo[0]; x <= x1 - c->grid.lo[0]; x++) {
        c->got[row + (size_t)x / 64] &= ~((uint64_t)1 << (x % 64));
    }
}

/* Does the fill set what the spans say, of each triangle and of the mesh? */
static int limits_agree(limits_case *c, int is_double)
{
    size_t w;
    int    i;
    int    ok;

    memset(c->want, 0, c->words * sizeof c->want[0]);
    memset(c->got, 0, c->words * sizeof c->got[0]);
    for (i = 0; i < c->triangles; i++) {
        if (is_double) {
            tribox_grid_spans_f64(&c->grid, c->d + 9 * i, c->d + 9 * i + 3, c->d + 9 * i + 6, limits_set, c);
        } else {
            tribox_grid_spans(&c->grid, c->f + 9 * i, c->f + 9 * i + 3, c->f + 9 * i + 6, limits_set, c);
        }
    }
    if (is_double) {
        tribox_mesh_f64 mesh;
        mesh.positions = c->d;
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = (size_t)c->triangles;
        tribox_grid_fill_f64(&c->grid, &mesh, c->got);
        ok = memcmp(c->want, c->got, c->words * sizeof c->got[0]) == 0;
        tribox_mesh_spans_f64(&c->grid, &mesh, limits_unset, c);
    } else {
        tribox_mesh mesh;
        mesh.positions = c->f;
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = (size_t)c->triangles;
        tribox_grid_fill(&c->grid, &mesh, c->got);
        ok = memcmp(c->want, c->got, c->words * sizeof c->got[0]) == 0;
        tribox_mesh_spans(&c->grid, &mesh, limits_unset, c);
    }
    for (w = 0; w < c->words; w++) {
        ok &= c->got[w] == 0;
    }
    if (!ok && test_wants_details()) {
        printf("  %s: origin %a, size %a, lo %d, flags %u\n", is_double ? "doubles" : "floats", c->grid.origin[0],
               c->grid.size[0], c->grid.lo[0], c->grid.flags);
    }
    return ok;
}

/* Grids from near to far beyond where a fill's fast ways hold, by origin or by index: fills are the spans' union. */
static void fills_of_far_grids_are_the_union_of_spans(void)
{
    static const int far_off[8] = {4, 20, 30, 36, 38, 41, 45, 60};
    int              i;

    random_seed(901);
    for (i = 0; i < TEST_LOOPS(800); i++) {
        limits_case *c = &limits;
        int          k;
        for (k = 0; k < 3; k++) {
            const double away = (random_below(2) ? 1 : -1) * power_of_two(far_off[i % 8]);
            c->grid.size[k] = random_below(2) ? 0.1 : 1.0;
            c->grid.lo[k] = random_below(3) ? random_below(9) - 4 : random_below(2) ? 1500000 : -1500000;
            c->grid.origin[k] = (random_below(2) ? away : 0.1) * c->grid.size[k] - c->grid.lo[k] * c->grid.size[k];
        }
        c->grid.flags = every_rule[random_below(4)];
        limits_region(c, 1 + random_below(90), 1 + random_below(9), 1 + random_below(9));
        limits_mesh(c);
        CHECK(limits_agree(c, 1));
        CHECK(limits_agree(c, 0));
        c->d[random_below(9 * c->triangles)] = random_below(2) ? 1e200 : -1e200; /* no number to compute with */
        CHECK(limits_agree(c, 1));
    }
}

/* Where sizes differ in the last bit alone, diagonals go only nearly through grid points. */
static void sizes_that_differ_in_the_last_bit(void)
{
    int i;

    random_seed(902);
    for (i = 0; i < TEST_LOOPS(300); i++) {
        limits_case *c = &limits;
        int          j;
        int          k;
        for (k = 0; k < 3; k++) {
            c->grid.size[k] = nudge_double(0.1, random_below(2));
            c->grid.lo[k] = 0;
            c->grid.origin[k] = 0;
        }
        c->grid.flags = every_rule[random_below(4)];
        limits_region(c, 20, 20, 20);
        limits_mesh(c);
        for (j = 0; j < 9 * c->triangles; j++) {
            if (random_below(2)) { /* tenths */
                c->d[j] = random_below(2) && j % 3 != 0 ? c->d[j - 1] : (int)(10 * c->d[j]) / 10.0;
                c->f[j] = (float)c->d[j];
            }
        }
        CHECK(limits_agree(c, 1));
        CHECK(limits_agree(c, 0));
    }
}

/* The longest axes that go by 16 bits, and one voxel more. */
static void long_axes_are_filled(void)
{
    int i;

    random_seed(903);
    for (i = 0; i < TEST_LOOPS(48); i++) {
        limits_case *c = &limits;
        const int    n = i % 9 == 0 ? 65537 : 65536;
        int          k;
        for (k = 0; k < 3; k++) {
            c->grid.size[k] = random_below(2) ? 0.1 : 1.0;
            c->grid.origin[k] = random_below(2) ? 0.0 : 1e4;
            c->grid.lo[k] = random_below(2) ? 0 : -32768;
        }
        c->grid.flags = every_rule[random_below(4)];
        limits_region(c, i % 3 == 0 ? n : 1, i % 3 == 1 ? 65535 : 1, i % 3 == 2 ? 65535 : 1);
        limits_mesh(c);
        for (k = 0; k < 9 && i % 2 == 0; k++) { /* far before the first voxel, or behind the last */
            c->d[k] = grid_plane(&c->grid, k % 3, c->grid.lo[k % 3] + (random_below(2) ? 1e6 : -1e6));
            c->f[k] = (float)c->d[k];
        }
        CHECK(limits_agree(c, 1));
        CHECK(limits_agree(c, 0));
    }
}

/* One voxel of the solid, in a region of its own; where its centre is of doubles, that says the same. */
static int solid_alone(const tribox_grid *grid, const tribox_mesh *mesh, int x, int y, int z)
{
    const int   voxel[3] = {x, y, z};
    tribox_grid one = *grid;
    uint64_t    bit = 0;
    double      centre[3];
    int         k;

    for (k = 0; k < 3; k++) {
        one.lo[k] = voxel[k];
        one.hi[k] = voxel[k] + 1;
        centre[k] = grid_plane(grid, k, voxel[k] + 0.5);
    }
    tribox_grid_fill_solid(&one, mesh, &bit);
    if (grid->size[0] == 1 && grid->size[1] == 1 && grid->size[2] == 1) {
        CHECK(tribox_mesh_contains(mesh, centre) == (int)bit);
    }
    return (int)bit;
}

/* The solid on such axes: each voxel near a tetrahedron is as in a region of its own, and as its centre is. */
static void solids_on_long_axes(void)
{
    static const uint32_t indices[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    int                   i;

    random_seed(909);
    for (i = 0; i < TEST_LOOPS(90); i++) {
        limits_case *c = &limits;
        const int    axis = i % 3;
        const int    n = axis == 0 ? 65530 + i % 10 : 65535;
        tribox_mesh  mesh;
        int          first[3];
        int          last[3];
        int          bad = 0;
        int          k;
        int          x;
        int          y;
        int          z;
        c->grid.flags = 0;
        for (k = 0; k < 3; k++) {
            c->grid.size[k] = random_below(2) ? 0.1 : 1.0;
            c->grid.origin[k] = random_below(2) ? 0.0 : 100.0;
            c->grid.lo[k] = random_below(2) ? 0 : -32768;
        }
        limits_region(c, axis == 0 ? n : 1, axis == 1 ? n : 1, axis == 2 ? n : 1);
        for (k = 0; k < 3; k++) {
            const int m = c->grid.hi[k] - c->grid.lo[k];
            const int end = random_below(2) ? m - 1 - random_below(m < 6 ? m : 6) : 0;
            const int at = random_below(3) ? random_below(m) : end;
            int       j;
            first[k] = c->grid.lo[k] + (at > 9 ? at - 9 : 0);
            last[k] = c->grid.lo[k] + (at + 9 < m ? at + 9 : m - 1);
            for (j = 0; j < 4; j++) {
                const double near_at = c->grid.lo[k] + at + random_below(9) - 4 + (random_below(2) ? 0.5 : 0.3);
                c->f[3 * j + k] = (float)grid_plane(&c->grid, k, near_at);
            }
        }
        mesh.positions = c->f;
        mesh.stride = 0;
        mesh.indices = indices;
        mesh.triangles = 4;
        memset(c->got, 0, c->words * sizeof c->got[0]);
        tribox_grid_fill_solid(&c->grid, &mesh, c->got);
        for (z = first[2]; z <= last[2]; z++) {
            for (y = first[1]; y <= last[1]; y++) {
                for (x = first[0]; x <= last[0]; x++) {
                    bad += tribox_grid_get(&c->grid, c->got, x, y, z) != solid_alone(&c->grid, &mesh, x, y, z);
                }
            }
        }
        CHECK(bad == 0);
    }
}

static void large_set(void *user, int x0, int x1, int y, int z)
{
    uint64_t *bits = (uint64_t *)user;
    int       x;

    for (x = x0; x <= x1; x++) {
        bits[((size_t)z * 1024 + (size_t)y) * 16 + (size_t)x / 64] |= (uint64_t)1 << (x % 64);
    }
}

/* Of 34 MiB of bits those of the spans are set, and no other. */
static void large_arrays_are_filled(void)
{
    static float      positions[9 * 3000];
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {1024, 1024, 272}, 0};
    const size_t      words = tribox_grid_words(&grid);
    uint64_t         *want = (uint64_t *)calloc(words, sizeof *want);
    uint64_t         *got = (uint64_t *)calloc(words, sizeof *got);
    tribox_mesh       mesh;
    int               i;

    if (CHECK(want != NULL && got != NULL)) {
        random_seed(904);
        for (i = 0; i < 9 * 3000; i++) {
            const double from = i % 9 < 3 ? 136 : (double)positions[i - 3];
            positions[i] = (float)(from + (i % 9 < 3 ? 136 : 2) * random_signed());
        }
        mesh.positions = positions;
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = 3000;
        for (i = 0; i < 3000; i++) {
            const float *v = positions + 9 * i;
            tribox_grid_spans(&grid, v, v + 3, v + 6, large_set, want);
        }
        tribox_grid_fill(&grid, &mesh, got);
        CHECK(memcmp(want, got, words * sizeof *got) == 0);
    }
    free(want);
    free(got);
}

/* ax + by = the greatest common divisor, returned. */
static int64_t bezout(int64_t a, int64_t b, int64_t *x, int64_t *y)
{
    int64_t s;
    int64_t g;

    if (b == 0) {
        *x = a < 0 ? -1 : 1;
        *y = 0;
        return a < 0 ? -a : a;
    }
    g = bezout(b, a % b, &s, x);
    *y = s - a / b * *x;
    { /* s b + x (a % b) = g */
        const int64_t t = *x;
        *x = t;
        *y = s - a / b * t;
    }
    return g;
}

/* Whole numbers: a box ends one step of the lattice before the triangle's plane, or behind it, where the plane's
 * value is one unit of some 2^48. */
static void planes_one_step_of_a_lattice_away(void)
{
    int i;
    int asked = 0;

    random_seed(905);
    for (i = 0; i < TEST_LOOPS(3000); i++) {
        question q;
        int64_t  e[2][3];
        int64_t  n[3];
        int64_t  p[3];
        int64_t  x;
        int64_t  y;
        int64_t  u;
        int64_t  w;
        int64_t  g;
        int      j;
        int      k;
        for (j = 0; j < 6; j++) {
            e[j / 3][j % 3] = (int64_t)(16000 * random_signed());
        }
        for (k = 0; k < 3; k++) {
            const int b = (k + 1) % 3;
            const int c = (k + 2) % 3;
            n[k] = e[0][b] * e[1][c] - e[0][c] * e[1][b];
        }
        g = bezout(n[0], n[1], &x, &y);
        if (n[0] == 0 || n[1] == 0 || n[2] == 0 || bezout(g, n[2], &u, &w) != 1) {
            continue;
        }
        u = u % n[2]; /* any u of that class will do; w follows */
        w = (1 - g * u) / n[2];
        p[0] = x * u % n[1];
        /* n_0 p_0 + n_1 p_1 = g u */
        p[1] = (g * u - n[0] * p[0]) / n[1];
        p[2] = w;
        for (j = 0; j < 3; j++) { /* into the parallelogram */
            double s;
            double t;
            double d[3] = {0, 0, 0};
            double a = 0;
            double b = 0;
            double c = 0;
            double f = 0;
            double h = 0;
            for (k = 0; k < 3; k++) {
                d[k] = (double)p[k];
                a += (double)e[0][k] * (double)e[0][k];
                b += (double)e[0][k] * (double)e[1][k];
                c += (double)e[1][k] * (double)e[1][k];
                f += d[k] * (double)e[0][k];
                h += d[k] * (double)e[1][k];
            }
            s = (f * c - h * b) / (a * c - b * b);
            t = (h * a - f * b) / (a * c - b * b);
            for (k = 0; k < 3; k++) {
                p[k] -= (int64_t)(s < 0 ? s - 1 : s) * e[0][k] + (int64_t)(t < 0 ? t - 1 : t) * e[1][k];
            }
        }
        for (k = 0; k < 3; k++) {
            const int away = n[k] > 0; /* the box extends upward along n from p: n p = 1 */
            q.t.v[0][k] = 0;
            q.t.v[1][k] = (double)e[0][k] * 2; /* twice as large: the parallelogram is in it */
            q.t.v[2][k] = (double)e[1][k] * 2;
            q.lo[k] = (double)(p[k] - !away);
            q.hi[k] = (double)(p[k] + away);
        }
        q.seed = random_state;
        question_from_box(&q);
        CHECK(ask_all(&q));
        for (k = 0; k < 3; k++) { /* the other way: the box's last corner is at n p = -1 */
            q.lo[k] = -q.lo[k] + 2 * (double)(e[0][k] + e[1][k]) / 2;
            q.hi[k] = -q.hi[k] + 2 * (double)(e[0][k] + e[1][k]) / 2;
            if (q.lo[k] > q.hi[k]) {
                const double swapped = q.lo[k];
                q.lo[k] = q.hi[k];
                q.hi[k] = swapped;
            }
        }
        question_from_box(&q);
        CHECK(ask_all(&q));
        asked++;
    }
    CHECK(asked > 0);
}

/* Three corners on a line, the third between the others, or nearly, and a box that the line clearly misses. */
static void lines_that_clearly_miss_a_box(void)
{
    int i;

    random_seed(906);
    for (i = 0; i < TEST_LOOPS(3000); i++) {
        question     q;
        const double t = 0.5 + 0.4 * random_signed();
        int          k;
        for (k = 0; k < 3; k++) {
            const double scale = random_below(4) ? 1 : power_of_two(-31); /* extents next to what floats can decide */
            const double from = rounded_to_float(scale * random_signed());
            const double to = rounded_to_float(from + scale * (1 + random_signed()));
            const double s = 0.5 + 0.4 * random_signed();
            const int    last = random_below(3);
            q.t.v[last][k] = rounded_to_float(from + t * (to - from));
            q.t.v[(last + 1) % 3][k] = from;
            q.t.v[(last + 2) % 3][k] = to;
            q.lo[k] = rounded_to_float(from + s * (to - from));
            q.hi[k] = rounded_to_float(q.lo[k] + 0.01 * scale);
        }
        if (random_below(2)) { /* one of the corners is always between */
            for (k = 0; k < 3; k++) {
                const double from = q.t.v[0][k];
                q.t.v[2][k] = rounded_to_float(from + t * (q.t.v[1][k] - from));
            }
        }
        q.seed = random_state;
        question_from_box(&q);
        CHECK(ask_all(&q));
    }
}

/* Does this program's own arithmetic read subnormals as zero, as when it is linked with -ffast-math? */
static int subnormals_are_zero(void)
{
    static const uint32_t least = 1;
    volatile float        x;
    float                 tiny;

    memcpy(&tiny, &least, sizeof least);
    x = tiny;
    return x == 0;
}

/* Times that no float holds come out as the nearest floats outside. */
static void times_beyond_floats_are_rounded_outward(void)
{
    static const uint32_t infinity_bits = 0x7F800000u;
    static const uint32_t most_bits = 0x7F7FFFFFu;
    static const float    lo[3] = {0, 0, 0};
    static const float    hi[3] = {1, 1, 1};
    float                 origin[3] = {3e38f, 0.5f, 0.5f};
    float                 dir[3] = {1e-44f, 0, 0};
    float                 infinity;
    float                 most;
    float                 t[2];

    memcpy(&infinity, &infinity_bits, sizeof infinity);
    memcpy(&most, &most_bits, sizeof most);
#if !defined(__FINITE_MATH_ONLY__) || !__FINITE_MATH_ONLY__
    CHECK(tribox_ray_box(origin, dir, -infinity, infinity, lo, hi, &t[0], &t[1]) == 1);
    CHECK(t[0] == -infinity && t[1] == -most);
    dir[0] = -1e-44f;
    CHECK(tribox_ray_box(origin, dir, -infinity, infinity, lo, hi, &t[0], &t[1]) == 1);
    CHECK(t[0] == most && t[1] == infinity);
    dir[0] = 1e-30f;
    CHECK(tribox_ray_box(origin, dir, -infinity, infinity, lo, hi, &t[0], &t[1]) == 1);
    CHECK(t[0] == -infinity && t[1] == -most);
#endif
    { /* from 0 to a face that is nearly there */
        static const float near_by[3] = {1e-25f, -1, -1};
        static const float slanted[3] = {3, 0.5f, 0.25f};
        origin[0] = origin[1] = origin[2] = 0;
        CHECK(tribox_ray_box(origin, slanted, -1, 9, near_by, hi, &t[0], &t[1]) == 1);
        CHECK(3 * (double)t[0] < (double)near_by[0] && 3.0000004 * (double)t[0] > (double)near_by[0]);
        CHECK(t[1] > 0.333333f);
        dir[0] = 1;
        CHECK(tribox_ray_box(origin, dir, -1, 9, near_by, hi, &t[0], &t[1]) == 1);
        CHECK(t[0] == near_by[0] && t[1] == 1);
    }
    if (subnormals_are_zero()) { /* cannot compare what follows */
        return;
    }
    origin[1] = origin[2] = 0.5f;
    dir[0] = 1e38f; /* from 1e-10 before the box: 1e-48 is less than the least float */
    origin[0] = -1e-10f;
    CHECK(tribox_ray_box(origin, dir, -1, 1, lo, hi, &t[0], &t[1]) == 1);
    CHECK(t[0] == 0 && t[1] > 0.9e-38f && t[1] < 1.1e-38f);
    origin[0] = 1 + 1.0f / 8388608; /* and a little behind it, backward */
    CHECK(tribox_ray_box(origin, dir, -1, 1, lo, hi, &t[0], &t[1]) == 1);
    CHECK(t[0] < -0.9e-38f && t[1] <= 0 && t[1] > -1.3e-45f);
}

/* Ends of rays that are NaN of either sign, infinite on one side, or subnormal. */
static void ends_of_rays_of_every_kind(void)
{
#if !defined(__FINITE_MATH_ONLY__) || !__FINITE_MATH_ONLY__
    static const uint64_t nan64[2] = {0x7FF8000000000000u, 0xFFF8000000000000u};
    static const uint32_t nan32[2] = {0x7FC00000u, 0xFFC00000u};
    static const uint64_t infinity64 = 0x7FF0000000000000u;
    static const float    lo[3] = {1, -1, -1};
    static const float    hi[3] = {2, 1, 1};
    static const double   lo64[3] = {1, -1, -1};
    static const double   hi64[3] = {2, 1, 1};
    static const float    v[3][3] = {{1, -1, -1}, {1, 3, -1}, {1, -1, 3}};
    static const float    zero[3] = {0, 0, 0};
    static const double   zero64[3] = {0, 0, 0};
    static const float    along[3] = {1, 0, 0};
    static const double   along64[3] = {1, 0, 0};
    int                   way;
    double                infinite;

    memcpy(&infinite, &infinity64, sizeof infinite);
    for (way = 0; way < 8; way++) { /* an ordinary direction, and one that only integers take */
        const float  dir[3] = {1, way & 4 ? 1e-44f : 0, 0};
        const double dir64[3] = {1, way & 4 ? 1e-320 : 0, 0};
        float        n32;
        double       n64;
        float        t[2];
        double       t64[2];
        memcpy(&n32, &nan32[way & 1], sizeof n32);
        memcpy(&n64, &nan64[way & 1], sizeof n64);
        CHECK(tribox_ray_box(zero, dir, way & 2 ? n32 : 0, way & 2 ? 9 : n32, lo, hi, t, t + 1) == 0);
        CHECK(tribox_ray_box_f64(zero64, dir64, way & 2 ? n64 : 0, way & 2 ? 9 : n64, lo64, hi64, t64, t64 + 1) ==
              0);
        CHECK(tribox_ray_triangle(zero, dir, way & 2 ? n32 : 0, way & 2 ? 9 : n32, v[0], v[1], v[2], t) == 0);
        CHECK(tribox_ray_sphere(zero, dir, way & 2 ? n32 : 0, way & 2 ? 9 : n32, lo, 1.5f, t, t + 1) == 0);
        CHECK(tribox_ray_box_f64(zero64, dir64, infinite, infinite, lo64, hi64, t64, t64 + 1) == 0);
        CHECK(tribox_ray_box_f64(zero64, dir64, -infinite, -infinite, lo64, hi64, t64, t64 + 1) == 0);
        CHECK(tribox_ray_sphere(zero, dir, -(float)infinite, 9, lo, 1.75f, t, t + 1) == 1 && t[0] < 0 && t[1] > 2);
        CHECK(tribox_ray_sphere(zero, dir, 1e-44f, (float)infinite, lo, 1.75f, t, t + 1) == 1 && t[1] > 2);
        CHECK(tribox_ray_sphere(zero, dir, -9, 1e-44f, lo, 1.75f, t, t + 1) == 1 && t[0] < 0);
        CHECK(tribox_ray_sphere(zero, dir, 9, 1, lo, 1.75f, t, t + 1) == 0);
        if (dir[0] == 1) { /* subnormal ends */
            CHECK(tribox_ray_box(zero, along, 1e-44f, 9, lo, hi, t, t + 1) == 1 && t[0] == 1 && t[1] == 2);
            CHECK(tribox_ray_box_f64(zero64, along64, 1e-320, 9, lo64, hi64, t64, t64 + 1) == 1 && t64[0] == 1);
        }
    }
#endif
}

/* A ray that ends where its own hit was found, or beside: as the times' order says. */
static void rays_that_end_at_their_hit(void)
{
    int i;
    int hits = 0;

    random_seed(907);
    for (i = 0; i < TEST_LOOPS(4000); i++) {
        double o[3];
        double d[3];
        double v[3][3];
        double t;
        double again;
        int    k;
        for (k = 0; k < 3; k++) {
            int j;
            o[k] = random_signed();
            d[k] = 0;
            for (j = 0; j < 3; j++) {
                v[j][k] = random_signed();
                d[k] += (v[j][k] - o[k]) * (j == 2 ? 0.3 : 0.35);
            }
        }
        if (!tribox_ray_triangle_f64(o, d, 0, 2, v[0], v[1], v[2], &t)) {
            continue;
        }
        hits++;
        again = 0;
        CHECK(tribox_ray_triangle_f64(o, d, 0, nudge_double(t, 1), v[0], v[1], v[2], &again) == 1 && again == t);
        CHECK(tribox_ray_triangle_f64(o, d, 0, nudge_double(t, -1), v[0], v[1], v[2], &again) == 0);
        CHECK(tribox_ray_triangle_f64(o, d, nudge_double(t, 1), 2, v[0], v[1], v[2], &again) == 0 || again > t);
        CHECK(tribox_ray_triangle_f64(o, d, nudge_double(t, -1), 2, v[0], v[1], v[2], &again) == 1 && again == t);
        {
            const int before = tribox_ray_triangle_f64(o, d, 0, t, v[0], v[1], v[2], &again);
            const int after = tribox_ray_triangle_f64(o, d, t, 2, v[0], v[1], v[2], &again);
            CHECK(before | after); /* t is rounded: the hit is on one side of it, or there */
        }
    }
    CHECK(hits > 0);
}

/* A corner that is no number makes a triangle that no sphere meets, also one of all of space. */
static void spheres_meet_no_triangle_of_nan(void)
{
    static const uint32_t odd[4] = {0x7FC00000u, 0xFFC00000u, 0x7F800000u, 0xFF800000u};
    static const float    center[3] = {0, 0, 0};
    int                   i;

    for (i = 0; i < 36; i++) {
        float v[9] = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
        CHECK(tribox_sphere_triangle(center, 1, v, v + 3, v + 6) == 1);
        memcpy(v + i / 4, &odd[i % 4], sizeof v[0]);
        CHECK(tribox_sphere_triangle(center, 1, v, v + 3, v + 6) == 0);
        CHECK(tribox_sphere_triangle(center, 1e-44f, v, v + 3, v + 6) == 0);
    }
}

/* Corners of doubles lie `stride` bytes apart; 0: three doubles. */
static void queries_of_doubles_have_any_stride(void)
{
    static const double packed[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const double apart[15] = {0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 0, 1, 0, 9, 9};
    static const double lo[3] = {0.25, 0.25, 0};
    static const double hi[3] = {0.5, 0.5, 0};
    tribox_mesh_f64     mesh;
    uint32_t            found[1] = {7};

    mesh.positions = packed;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    CHECK(tribox_mesh_query_f64(&mesh, lo, hi, found, 1) == 1 && found[0] == 0);
    mesh.positions = apart;
    mesh.stride = 5 * sizeof(double);
    found[0] = 7;
    CHECK(tribox_mesh_query_f64(&mesh, lo, hi, found, 1) == 1 && found[0] == 0);
}

/* Gaps scale with the numbers, down to subnormals, where each step is a whole number of units. */
static void gaps_of_subnormals(void)
{
    const float unit = (float)power_of_two(-149);
    int         i;

    if (subnormals_are_zero()) { /* cannot make them */
        return;
    }
    random_seed(908);
    for (i = 0; i < TEST_LOOPS(2000); i++) {
        float  v[2][3][3];
        float  lo[2][3];
        float  hi[2][3];
        float  axis[2][3];
        double gap[2];
        int    level = random_below(4); /* the triangle's plane is across that axis */
        int    k;
        for (k = 0; k < 3; k++) {
            const int whole = random_below(9) - 4;
            int       j;
            for (j = 0; j < 3; j++) {
                v[0][j][k] = (float)(level == k ? whole : random_below(9) - 4);
                v[1][j][k] = v[0][j][k] * unit;
            }
            lo[0][k] = (float)(random_below(9) - 4);
            hi[0][k] = lo[0][k] + (float)random_below(4);
            lo[1][k] = lo[0][k] * unit;
            hi[1][k] = hi[0][k] * unit;
        }
        gap[0] = tribox_gap(v[0][0], v[0][1], v[0][2], lo[0], hi[0], axis[0]);
        gap[1] = tribox_gap(v[1][0], v[1][1], v[1][2], lo[1], hi[1], axis[1]);
        CHECK((gap[0] > 0) == (gap[1] > 0) && (gap[0] < 0) == (gap[1] < 0));
        CHECK(gap[0] - gap[1] * power_of_two(149) < 1e-9 && gap[0] - gap[1] * power_of_two(149) > -1e-9);
        for (k = 0; k < 3; k++) {
            CHECK(axis[0][k] - axis[1][k] < 1e-6f && axis[0][k] - axis[1][k] > -1e-6f);
        }
    }
}

/* Gaps are the same when axes are turned: those of floors and walls, too, and of numbers so unlike that only integers
 * decide. */
static void gaps_turn_with_the_axes(void)
{
    int i;

    random_seed(910);
    for (i = 0; i < TEST_LOOPS(2000); i++) {
        float  v[3][3][3];
        float  lo[3][3];
        float  hi[3][3];
        float  axis[3][3];
        double gap[3];
        int    level = random_below(4);
        int    turn;
        int    k;
        for (k = 0; k < 3; k++) {
            const float whole = (float)(random_signed() * power_of_two(random_below(80) - 40));
            int         j;
            for (j = 0; j < 3; j++) {
                v[0][j][k] = level == k ? whole : (float)(random_signed() * power_of_two(random_below(80) - 40));
            }
            lo[0][k] = (float)(random_signed() * power_of_two(random_below(80) - 40));
            hi[0][k] = lo[0][k] + (float)power_of_two(random_below(80) - 40);
        }
        for (turn = 0; turn < 3; turn++) {
            for (k = 0; k < 3; k++) {
                int j;
                for (j = 0; j < 3; j++) {
                    v[turn][j][k] = v[0][j][(k + turn) % 3];
                }
                lo[turn][k] = lo[0][(k + turn) % 3];
                hi[turn][k] = hi[0][(k + turn) % 3];
            }
            gap[turn] = tribox_gap(v[turn][0], v[turn][1], v[turn][2], lo[turn], hi[turn], axis[turn]);
            CHECK((gap[turn] > 0) == (gap[0] > 0) && (gap[turn] < 0) == (gap[0] < 0));
            CHECK((gap[turn] - gap[0]) * (gap[turn] - gap[0]) <= 1e-20 * gap[0] * gap[0]);
        }
    }
}

typedef struct passed {
    int count;
    int last;
} passed;

static int pass(void *user, int x, int y, int z)
{
    passed *p = (passed *)user;

    p->last = x;
    p->count += y == 0 && z == 0;
    return 0;
}

/* Segments whose ends only integers hold, and ends at planes, by every rule. */
static void segments_with_far_ends(void)
{
    static const double from[3] = {0.5, 0.5, 0.5};
    static const double far_end[4][3] = {{1e305, 0.5, 0.5}, {2, 0.5, 0.5}, {2.5, 0.5, 0.5}, {-1e305, 0.5, 0.5}};
    static const int    want[4][3] = {{8, 8, 8}, {3, 3, 2}, {3, 3, 3}, {1, 1, 1}}; /* closed, half-open, open */
    static const unsigned rules[3] = {0, TRIBOX_HALF_OPEN, TRIBOX_OPEN};
    int                 i;

    for (i = 0; i < 24; i++) {
        tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {8, 1, 1}, 0};
        passed      p = {0, -1};
        const int   back = i / 12;
        grid.flags = rules[i % 3];
        const double *end = far_end[i / 3 % 4];
        const int     n = want[i / 3 % 4][i % 3];
        CHECK(tribox_grid_segment(&grid, back ? end : from, back ? from : end, pass, &p) == (size_t)n);
        CHECK(p.count == n);
    }
}

int main(void)
{
    RUN(fills_of_far_grids_are_the_union_of_spans);
    RUN(sizes_that_differ_in_the_last_bit);
    RUN(long_axes_are_filled);
    RUN(solids_on_long_axes);
    RUN(large_arrays_are_filled);
    RUN(planes_one_step_of_a_lattice_away);
    RUN(lines_that_clearly_miss_a_box);
    RUN(times_beyond_floats_are_rounded_outward);
    RUN(ends_of_rays_of_every_kind);
    RUN(rays_that_end_at_their_hit);
    RUN(spheres_meet_no_triangle_of_nan);
    RUN(queries_of_doubles_have_any_stride);
    RUN(gaps_of_subnormals);
    RUN(gaps_turn_with_the_axes);
    RUN(segments_with_far_ends);
    return test_report("test_limits");
}
