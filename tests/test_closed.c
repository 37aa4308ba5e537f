/* Closed meshes: the thin voxels part inside from outside along face-connected paths, the conservative
 * ones along paths through edges and corners too, for cubic and other voxels.
 *
 * Why thin does: a path of free voxels joins centres of face neighbours. Such a step runs within the two
 * voxels' crosses (centre to face centres). Where it meets the surface at a point of triangle T, that
 * voxel's cross meets T, so the octahedron of its face centres meets T's plane, its diamonds meet T's
 * projections, and its faces hold T's point: all conditions of thin are met, and the voxel was not free. */
#include "tribox.h"

#include <math.h>

#include "question.h"

enum { SIDE = 34, RINGS = 14, SECTORS = 20, CLOSED_TRIANGLES = 2 * RINGS * SECTORS };

typedef struct closed_mesh {
    float    positions[3 * RINGS * SECTORS + 6];
    uint32_t indices[3 * CLOSED_TRIANGLES];
    size_t   triangles;
    int      torus;
    double   radius[3];     /* of the ellipsoid; the torus: outer and inner circle, and height */
} closed_mesh;

/* A point of the surface shrunk towards its core by f. */
static void surface_point(const closed_mesh *m, int ring, int sector, double f, double out[3])
{
    const double pi = 3.14159265358979323846;
    double       u = 2 * pi * sector / SECTORS;

    if (m->torus) {
        double v = 2 * pi * ring / RINGS;
        double r = m->radius[0] + f * m->radius[1] * cos(v);
        out[0] = r * cos(u);
        out[1] = r * sin(u);
        out[2] = f * m->radius[2] * sin(v);
    } else {
        double v = pi * (ring + 1) / (RINGS + 1);
        out[0] = f * m->radius[0] * sin(v) * cos(u);
        out[1] = f * m->radius[1] * sin(v) * sin(u);
        out[2] = f * m->radius[2] * cos(v);
    }
}

static void add_triangle(closed_mesh *m, int a, int b, int c)
{
    m->indices[3 * m->triangles] = (uint32_t)a;
    m->indices[3 * m->triangles + 1] = (uint32_t)b;
    m->indices[3 * m->triangles + 2] = (uint32_t)c;
    m->triangles++;
}

static void make_closed_mesh(closed_mesh *m, const double turn[3])
{
    int ring;
    int sector;
    int i;

    m->triangles = 0;
    for (ring = 0; ring < RINGS; ring++) {
        for (sector = 0; sector < SECTORS; sector++) {
            double p[3];
            surface_point(m, ring, sector, 1, p);
            for (i = 0; i < 3; i++) {
                m->positions[3 * (ring * SECTORS + sector) + i] = (float)(p[i] + turn[i] * p[(i + 1) % 3]);
            }
        }
    }
    for (i = 0; i < 6; i++) {
        double pole[3] = {0, 0, 0};
        pole[2] = i < 3 ? m->radius[2] : -m->radius[2];
        m->positions[3 * RINGS * SECTORS + i] = (float)(pole[i % 3] + turn[i % 3] * pole[(i % 3 + 1) % 3]);
    }
    for (ring = 0; ring < (m->torus ? RINGS : RINGS - 1); ring++) {
        for (sector = 0; sector < SECTORS; sector++) {
            int a = ring * SECTORS + sector;
            int b = ring * SECTORS + (sector + 1) % SECTORS;
            int c = (ring + 1) % RINGS * SECTORS + sector;
            int d = (ring + 1) % RINGS * SECTORS + (sector + 1) % SECTORS;
            add_triangle(m, a, b, c);
            add_triangle(m, b, d, c);
        }
    }
    for (sector = 0; !m->torus && sector < SECTORS; sector++) {
        int next = (sector + 1) % SECTORS;
        add_triangle(m, sector, next, RINGS * SECTORS);
        add_triangle(m, (RINGS - 1) * SECTORS + sector, (RINGS - 1) * SECTORS + next, RINGS * SECTORS + 1);
    }
}

static unsigned char closed_state[SIDE * SIDE * SIDE];      /* 1 set, 2 reached from outside */
static int           closed_queue[SIDE * SIDE * SIDE];

/* Floods the free voxels from corner 0 through faces, or through edges and corners too. */
static void flood(const int n[3], int through_corners)
{
    int head = 0;
    int tail = 1;

    closed_queue[0] = 0;
    closed_state[0] = 2;
    while (head < tail) {
        int at = closed_queue[head++];
        int x = at % n[0];
        int y = at / n[0] % n[1];
        int z = at / n[0] / n[1];
        int k;
        for (k = 0; k < 27; k++) {
            int dx = k % 3 - 1;
            int dy = k / 3 % 3 - 1;
            int dz = k / 9 - 1;
            int next = at + dx + (dy + dz * n[1]) * n[0];
            if (!through_corners && dx * dx + dy * dy + dz * dz != 1) {
                continue;
            }
            if (x + dx >= 0 && x + dx < n[0] && y + dy >= 0 && y + dy < n[1] && z + dz >= 0 &&
                z + dz < n[2] && closed_state[next] == 0) {
                closed_state[next] = 2;
                closed_queue[tail++] = next;
            }
        }
    }
}

/* A grid with voxels of the given shape round the mesh, with free layers on all sides. */
static void frame_closed_mesh(const closed_mesh *m, tribox_grid *g, const double shape[3], int n[3])
{
    int a;

    for (a = 0; a < 3; a++) {
        double least = 1e9;
        double greatest = -1e9;
        size_t i;
        for (i = 0; i < 3 * m->triangles; i++) {
            double x = (double)m->positions[3 * m->indices[i] + (unsigned)a];
            least = x < least ? x : least;
            greatest = x > greatest ? x : greatest;
        }
        g->size[a] = shape[a];
        g->origin[a] = least - 2 * shape[a] + random_signed() * 0.3 * shape[a];
        g->lo[a] = 0;
        n[a] = (int)((greatest - least) / shape[a]) + 5;
        n[a] = n[a] < SIDE ? n[a] : SIDE;
        g->hi[a] = n[a];
    }
}

/* Voxels that are surely inside: those holding a point of the surface shrunk by half. None of them may be
 * reached. */
static int count_leaks(const closed_mesh *m, const tribox_grid *g, const int n[3], const double turn[3],
                       int *inner)
{
    int leaks = 0;
    int ring;
    int sector;
    int i;

    for (ring = 0; ring < RINGS; ring++) {
        for (sector = 0; sector < SECTORS; sector++) {
            double core[3];
            double p[3];
            int    index[3];
            int    at;
            surface_point(m, ring, sector, 0.5, core);
            for (i = 0; i < 3; i++) {
                p[i] = core[i] + turn[i] * core[(i + 1) % 3];
            }
            if (!tribox_grid_locate(g, p, index)) {
                continue;
            }
            at = index[0] + (index[1] + index[2] * n[1]) * n[0];
            leaks += closed_state[at] == 2;
            *inner += closed_state[at] == 0;
        }
    }
    return leaks;
}

static size_t fill_state(const closed_mesh *m, const tribox_grid *g, const int n[3], uint64_t *bits)
{
    tribox_mesh mesh;
    size_t      set = 0;
    int         i;

    mesh.positions = m->positions;
    mesh.stride = 0;
    mesh.indices = m->indices;
    mesh.triangles = m->triangles;
    memset(bits, 0, tribox_grid_words(g) * sizeof bits[0]);
    tribox_grid_fill(g, &mesh, bits);
    for (i = 0; i < n[0] * n[1] * n[2]; i++) {
        closed_state[i] = (unsigned char)tribox_grid_get(g, bits, i % n[0], i / n[0] % n[1], i / n[0] / n[1]);
        set += closed_state[i];
    }
    return set;
}

static void closed_meshes_hold_tight(int cubic)
{
    static closed_mesh m;
    static uint64_t    thin_bits[SIDE * SIDE];
    static uint64_t    bits[SIDE * SIDE];
    int                inner_thin = 0;
    int                inner = 0;
    int                fewer = 0;
    int                i;

    random_seed(121 + (uint64_t)cubic);
    for (i = 0; i < TEST_LOOPS(60); i++) {
        double      shape[3] = {0.1, 0.1, 0.1};
        double      turn[3];
        tribox_grid grid;
        int         n[3];
        size_t      thin_set;
        size_t      set;
        int         a;
        int         k;
        int         subset = 1;
        m.torus = i & 1;
        for (a = 0; a < 3; a++) {
            shape[a] = cubic ? 0.15 : 0.08 * (1 + random_below(5));
            turn[a] = random_signed() * 0.4;
            m.radius[a] = m.torus ? (a == 0 ? 1.1 : 0.7) : 0.9 + 0.4 * random_signed();
        }
        make_closed_mesh(&m, turn);
        frame_closed_mesh(&m, &grid, shape, n);
        grid.flags = TRIBOX_THIN;
        thin_set = fill_state(&m, &grid, n, thin_bits);
        flood(n, 0);
        CHECK(count_leaks(&m, &grid, n, turn, &inner_thin) == 0);
        grid.flags = 0;
        set = fill_state(&m, &grid, n, bits);
        flood(n, 1);
        CHECK(count_leaks(&m, &grid, n, turn, &inner) == 0);
        for (k = 0; k < (int)tribox_grid_words(&grid); k++) {
            subset = subset && (thin_bits[k] & ~bits[k]) == 0;
        }
        CHECK(subset);
        fewer += thin_set < set;
    }
    CHECK(inner_thin > 0 && inner > 0);
    CHECK(fewer == TEST_LOOPS(60));
}

/* Cubic voxels. */
static void closed_meshes_hold_tight_in_cubic_voxels(void)
{
    closed_meshes_hold_tight(1);
}

/* Voxels up to five times as long as wide: the support must be the largest product |n_a| h_a. */
static void closed_meshes_hold_tight_in_other_voxels(void)
{
    closed_meshes_hold_tight(0);
}

/* A closed box with faces on grid planes: both layers of each face are set, closed and thin alike;
 * half-open sets the upper layer, open none; and the thin shell is tight. */
static void box_on_grid_planes_sets_the_documented_layers(void)
{
    static const float    p[24] = {2, 2, 2, 6, 2, 2, 2, 6, 2, 6, 6, 2, 2, 2, 6, 6, 2, 6, 2, 6, 6, 6, 6, 6};
    static const uint32_t t[36] = {0, 1, 2, 1, 3, 2, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                   2, 3, 6, 3, 7, 6, 0, 2, 4, 2, 6, 4, 1, 3, 5, 3, 7, 5};
    static const int      lower[4] = {1, 0, 0, 1};
    static const int      upper[4] = {1, 1, 0, 1};
    tribox_grid           grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {8, 8, 8}, 0};
    const int             n[3] = {8, 8, 8};
    uint64_t              bits[64];
    tribox_mesh           mesh;
    int                   k;
    int                   i;

    mesh.positions = p;
    mesh.stride = 0;
    mesh.indices = t;
    mesh.triangles = 12;
    for (k = 0; k < 4; k++) {
        grid.flags = every_rule[k];
        memset(bits, 0, sizeof bits);
        tribox_grid_fill(&grid, &mesh, bits);
        CHECK(tribox_grid_get(&grid, bits, 3, 3, 1) == lower[k]);
        CHECK(tribox_grid_get(&grid, bits, 3, 3, 2) == upper[k]);
        CHECK(tribox_grid_get(&grid, bits, 3, 5, 4) == lower[k]);
        CHECK(tribox_grid_get(&grid, bits, 3, 6, 4) == upper[k]);
        CHECK(tribox_grid_get(&grid, bits, 1, 4, 4) == lower[k]);
        CHECK(tribox_grid_get(&grid, bits, 2, 4, 4) == upper[k]);
        CHECK(tribox_grid_get(&grid, bits, 4, 4, 4) == 0 && tribox_grid_get(&grid, bits, 0, 4, 4) == 0);
    }
    for (i = 0; i < 512; i++) {
        closed_state[i] = (unsigned char)tribox_grid_get(&grid, bits, i % 8, i / 8 % 8, i / 64);
    }
    flood(n, 0);
    CHECK(closed_state[4 + 8 * 4 + 64 * 4] == 0 && closed_state[0] == 2);
}

int main(void)
{
    RUN(closed_meshes_hold_tight_in_cubic_voxels);
    RUN(closed_meshes_hold_tight_in_other_voxels);
    RUN(box_on_grid_planes_sets_the_documented_layers);
    return test_report("test_closed");
}
