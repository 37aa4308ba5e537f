/* A small region of a grid voxel by voxel: the truth of each voxel by the oracle, the spans that a walk
 * emits, and a generator of grids and triangles that meet. Include "tribox.h" first. */
#ifndef VOXELS_H
#define VOXELS_H

#include "question.h"

enum { VOXELS_MAX = 1024 };

typedef struct voxels {
    tribox_grid grid;
    triangle    t;
    float       ft[3][3];
    int         is_float;
    uint64_t    seed;
    int         n[3];
    int         valid;                      /* 0: some size is not positive (-Ofast may flush it to zero) */
    int         count;                      /* n[0]*n[1]*n[2] <= VOXELS_MAX */
    unsigned char truth[VOXELS_MAX];        /* answer sets */
} voxels;

TEST_FN void voxels_print(const voxels *v, const char *what, unsigned flags)
{
    int i;

    if (!test_wants_details()) {
        return;
    }
    printf("  %s, flags %u, seed %llu\n  {", what, flags, (unsigned long long)v->seed);
    for (i = 0; i < 9; i++) {
        printf("%a%s", v->t.v[i / 3][i % 3], i == 8 ? "}\n" : i % 3 == 2 ? "} {" : ", ");
    }
    printf("  origin {%a, %a, %a} size {%a, %a, %a}\n  lo {%d, %d, %d} hi {%d, %d, %d}\n", v->grid.origin[0],
           v->grid.origin[1], v->grid.origin[2], v->grid.size[0], v->grid.size[1], v->grid.size[2],
           v->grid.lo[0], v->grid.lo[1], v->grid.lo[2], v->grid.hi[0], v->grid.hi[1], v->grid.hi[2]);
}

/* Floats, count and truth, from grid and t. */
TEST_FN void voxels_finish(voxels *v)
{
    float all[9];
    int   i;
    int   a;

    v->valid = 1;
    v->is_float = to_floats(all, &v->t.v[0][0], 9);
    for (i = 0; i < 9; i++) {
        v->ft[i / 3][i % 3] = all[i];
    }
    for (a = 0; a < 3; a++) {
        v->n[a] = v->grid.hi[a] - v->grid.lo[a];
        v->valid = v->valid && oracle_read(&v->grid.size[a]).sign > 0;
    }
    v->count = v->n[0] * v->n[1] * v->n[2];
    for (i = 0; i < v->count; i++) {
        int index[3];
        index[0] = v->grid.lo[0] + i % v->n[0];
        index[1] = v->grid.lo[1] + i / v->n[0] % v->n[1];
        index[2] = v->grid.lo[2] + i / v->n[0] / v->n[1];
        v->truth[i] = v->valid ? (unsigned char)oracle_voxel(&v->t, v->grid.origin, v->grid.size, index) : 0;
    }
}

/* What a walk emitted; `orderly` stays 1 while spans are inside the region, disjoint, maximal and in
 * order. */
typedef struct walk {
    const voxels *v;
    unsigned char set[VOXELS_MAX];
    size_t        total;
    int           orderly;
    int           last_x1;
    int           last_y;
    int           last_z;
    int           any;
} walk;

TEST_FN void walk_emit(void *user, int x0, int x1, int y, int z)
{
    walk              *w = (walk *)user;
    const tribox_grid *g = &w->v->grid;
    int                later = !w->any || z > w->last_z || (z == w->last_z && y > w->last_y);
    /* In the same row a span must leave a gap, or the two were one. */
    int                gap = w->any && z == w->last_z && y == w->last_y && x0 - 1 > w->last_x1;
    int                x;

    w->orderly &= x0 <= x1 && x0 >= g->lo[0] && x1 < g->hi[0] && y >= g->lo[1] && y < g->hi[1] &&
                  z >= g->lo[2] && z < g->hi[2] && (later || gap);
    if (w->orderly) {
        int row = ((z - g->lo[2]) * w->v->n[1] + (y - g->lo[1])) * w->v->n[0];
        for (x = x0; x <= x1; x++) {
            w->set[row + (x - g->lo[0])]++;
            w->total++;
        }
    }
    w->any = 1;
    w->last_x1 = x1;
    w->last_y = y;
    w->last_z = z;
}

TEST_FN void walk_start(walk *w, const voxels *v)
{
    memset(w, 0, sizeof *w);
    w->v = v;
    w->orderly = 1;
}

/* Is the walk orderly, its count right, and each voxel of the region as the oracle says? */
TEST_FN int walk_is_right(const walk *w, const char *what, unsigned flags, size_t returned)
{
    int ok = w->orderly && w->total == returned;
    int i;

    for (i = 0; ok && i < w->v->count; i++) {
        ok = w->set[i] == oracle_says(w->v->truth[i], flags);
    }
    if (!ok) {
        voxels_print(w->v, what, flags);
    }
    return ok;
}

/* Spans of both types, with and without a callback, under one rule. */
TEST_FN int voxels_ask_spans(voxels *v, unsigned flags)
{
    walk   w;
    size_t returned;
    int    ok;

    v->grid.flags = flags;
    walk_start(&w, v);
    returned = tribox_grid_spans_f64(&v->grid, v->t.v[0], v->t.v[1], v->t.v[2], walk_emit, &w);
    ok = walk_is_right(&w, "tribox_grid_spans_f64", flags, returned);
    ok &= tribox_grid_spans_f64(&v->grid, v->t.v[0], v->t.v[1], v->t.v[2], 0, 0) == returned;
    if (v->is_float) {
        walk_start(&w, v);
        returned = tribox_grid_spans(&v->grid, v->ft[0], v->ft[1], v->ft[2], walk_emit, &w);
        ok &= walk_is_right(&w, "tribox_grid_spans", flags, returned);
        ok &= tribox_grid_spans(&v->grid, v->ft[0], v->ft[1], v->ft[2], 0, 0) == returned;
    }
    return ok;
}

/* The fill of the one triangle, voxel by voxel through tribox_grid_get, if the corners are floats. */
TEST_FN int voxels_ask_fill(voxels *v, unsigned flags)
{
    uint64_t    bits[VOXELS_MAX];
    tribox_mesh mesh;
    size_t      words;
    int         ok = 1;
    int         i;

    if (!v->is_float) {
        return 1;
    }
    v->grid.flags = flags;
    words = tribox_grid_words(&v->grid);
    memset(bits, 0, sizeof bits);
    mesh.positions = v->ft[0];
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    tribox_grid_fill(&v->grid, &mesh, bits);
    for (i = 0; i < v->count; i++) {
        int x = v->grid.lo[0] + i % v->n[0];
        int y = v->grid.lo[1] + i / v->n[0] % v->n[1];
        int z = v->grid.lo[2] + i / v->n[0] / v->n[1];
        ok &= tribox_grid_get(&v->grid, bits, x, y, z) == oracle_says(v->truth[i], flags);
    }
    ok &= words == (v->valid ? (size_t)((v->n[0] + 63) / 64 * v->n[1] * v->n[2]) : 0);
    for (i = (int)words; i < VOXELS_MAX; i++) {
        ok &= bits[i] == 0;
    }
    if (!ok) {
        voxels_print(v, "tribox_grid_fill", flags);
    }
    return ok;
}

TEST_FN int voxels_ask_all(voxels *v)
{
    int                   ok = 1;
    int                   i;

    for (i = 0; i < 4; i++) {
        ok &= voxels_ask_spans(v, every_rule[i]);
        ok &= voxels_ask_fill(v, every_rule[i]);
    }
    return ok;
}

/* ---- generators ---------------------------------------------------------------------------------------- */

enum voxels_kind {
    GRID_GENERAL,       /* random corners about the region, voxels of any shape */
    GRID_ALIGNED,       /* corners on grid planes and halves, walls, floors, 45 degrees; the region cuts */
    GRID_DEGENERATE,    /* segments and points on the same lattice */
    GRID_TINY,          /* within a voxel or two, corners at grid planes give or take ulps */
    GRID_HUGE,          /* corners up to a million regions away */
    GRID_STEEP,         /* planes nearly parallel to an axis, corners far away */
    GRID_LINE,          /* long and narrow: many rows, few voxels each */
    GRID_PASS,          /* a corner in a small region, two far away: an edge passes a lattice point by rounding */
    GRID_KINDS
};

/* The plane number i of axis a, as a double: rounded as a user would. */
TEST_FN double grid_plane(const tribox_grid *g, int a, double i)
{
    return g->origin[a] + i * g->size[a];
}

/* Whole, half or tenth steps, a common or a different one per axis; origins plain or awkward; indices
 * small, negative or about a million, so that origin + i*size has many bits. */
TEST_FN void make_grid(tribox_grid *g, int large)
{
    static const double sizes[8] = {1, 1, 0.5, 0.25, 0.1, 1.0 / 3, 3, 0.7};
    static const double origins[6] = {0, 0, 0.1, -0.3, 1e4 + 0.1, 1.0 / 3};
    double              size = sizes[random_below(8)];
    int                 shape = random_below(2);
    int                 start = random_below(8);
    int                 a;

    for (a = 0; a < 3; a++) {
        int n = 1 + random_below(large ? 9 : 6);
        g->size[a] = shape ? sizes[random_below(8)] : size;
        g->origin[a] = origins[random_below(6)];
        g->lo[a] = start == 0 ? -1000003 + random_below(9) : start == 1 ? 1000003 : random_below(7) - 5;
        g->hi[a] = g->lo[a] + n;
    }
    g->flags = 0;
}

/* A corner on the lattice of grid planes and half planes, up to two steps outside of the region. */
TEST_FN void make_lattice_corner(const tribox_grid *g, double p[3], int halves)
{
    int a;

    for (a = 0; a < 3; a++) {
        double i = (double)g->lo[a] - 2 + random_below(g->hi[a] - g->lo[a] + 5);
        p[a] = grid_plane(g, a, i + (halves && random_below(2) ? 0.5 : 0));
    }
}

TEST_FN void make_random_corner(const tribox_grid *g, double p[3], double reach)
{
    int a;

    for (a = 0; a < 3; a++) {
        double n = g->hi[a] - g->lo[a];
        p[a] = grid_plane(g, a, g->lo[a] + n / 2 + random_signed() * n * reach);
    }
}

TEST_FN void make_aligned_corners(voxels *v)
{
    int flat = random_below(3);
    int i;

    for (i = 0; i < 3; i++) {
        make_lattice_corner(&v->grid, v->t.v[i], random_below(3) == 0);
    }
    if (random_below(2)) {
        v->t.v[1][flat] = v->t.v[2][flat] = v->t.v[0][flat];
    }
    if (random_below(3) == 0) {
        int b = (flat + 1) % 3;
        v->t.v[1][b] = v->t.v[0][b];
    }
}

TEST_FN void make_tiny_corners(voxels *v)
{
    double reach = random_below(2) ? 0.1 : 1.5;
    int    a;
    int    i;

    make_lattice_corner(&v->grid, v->t.v[0], 1);
    for (a = 0; a < 3; a++) {
        double x = v->t.v[0][a];
        for (i = 0; i < 3; i++) {
            int how = random_below(3);
            v->t.v[i][a] = how == 0 ? x : x + random_signed() * reach * v->grid.size[a];
        }
    }
}

TEST_FN void make_steep_corners(voxels *v)
{
    int    a = random_below(3);
    double s = random_signed();
    int    i;

    make_random_corner(&v->grid, v->t.v[0], random_below(2) ? 1 : 1000);
    make_random_corner(&v->grid, v->t.v[1], random_below(2) ? 1 : 1000);
    for (i = 0; i < 3; i++) {
        int b = (a + i) % 3;
        v->t.v[2][b] = v->t.v[0][b] + (i == 0 ? random_signed() * 5 : s * (v->t.v[1][b] - v->t.v[0][b]));
    }
}

/* v1 lies on the line from v0 through a lattice point, up to 2^40 times as far, mostly in one direction of an axis. */
TEST_FN void make_passing_corners(voxels *v)
{
    const double far_away = (double)((uint64_t)1 << (8 + random_below(33)));
    const int    down = random_below(3) == 0 ? random_below(8) : 0;
    int          a;

    make_random_corner(&v->grid, v->t.v[0], 1);
    for (a = 0; a < 3; a++) {
        const double size = v->grid.size[a] * (down >> a & 1 ? -1.0 : 1.0);
        const double n = 1 + random_below(v->grid.hi[a] - v->grid.lo[a]);
        const double at = grid_plane(&v->grid, a, size > 0 ? v->grid.lo[a] + n : v->grid.hi[a] - n);
        const double other = (random_signed() + 1.0) * size;
        const double to = (at > v->t.v[0][a]) == (size > 0) ? at - v->t.v[0][a] : other;
        v->t.v[1][a] = v->t.v[0][a] + to * far_away;
        v->t.v[2][a] = v->t.v[0][a] + (random_signed() + 1.0) * size * far_away;
    }
}

/* Corners moved by up to three ulps, half of the time. */
TEST_FN void walk_corners(voxels *v, int as_float)
{
    int moves = random_below(6);

    for (; moves > 0; moves--) {
        int     which = random_below(9);
        double *x = &v->t.v[which / 3][which % 3];
        *x = nudge(*x, random_below(7) - 3, as_float);
    }
}

TEST_FN void voxels_corners(voxels *v, int kind, int as_float)
{
    double reach;
    int    a;
    int    i;

    switch (kind) {
    case GRID_ALIGNED:
        make_aligned_corners(v);
        break;
    case GRID_DEGENERATE:
        make_lattice_corner(&v->grid, v->t.v[0], 1);
        make_lattice_corner(&v->grid, v->t.v[1], 1);
        for (a = 0; a < 3; a++) {
            v->t.v[2][a] = v->t.v[random_below(5) ? 0 : 1][a];
        }
        break;
    case GRID_TINY:
        make_tiny_corners(v);
        break;
    case GRID_STEEP:
        make_steep_corners(v);
        break;
    case GRID_PASS:
        make_passing_corners(v);
        break;
    case GRID_LINE:
        make_random_corner(&v->grid, v->t.v[0], 2);
        make_random_corner(&v->grid, v->t.v[1], 2);
        for (a = 0; a < 3; a++) {
            v->t.v[2][a] = v->t.v[1][a] + random_signed() * 0.1 * v->grid.size[a];
        }
        break;
    default:
        for (i = 0; i < 3; i++) {
            reach = kind == GRID_GENERAL || i == 0 ? 1 : random_below(2) ? 1e6 : 100;
            make_random_corner(&v->grid, v->t.v[i], reach);
        }
        break;
    }
    for (i = 0; as_float && i < 9; i++) {
        v->t.v[i / 3][i % 3] = rounded_to_float(v->t.v[i / 3][i % 3]);
    }
    if (random_below(2)) {
        walk_corners(v, as_float);
    }
}

TEST_FN void voxels_make(voxels *v, int kind, int as_float)
{
    int a;

    v->seed = random_state;
    make_grid(&v->grid, kind == GRID_LINE);
    for (a = 0; kind == GRID_PASS && a < 3; a++) {
        v->grid.hi[a] = v->grid.lo[a] + 1 + random_below(3);
    }
    voxels_corners(v, kind, as_float);
    voxels_finish(v);
}

#endif /* VOXELS_H */
