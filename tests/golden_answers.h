/* The header's answers to the golden inputs: golden.c and golden.cu include this. Numbers travel as bit
 * patterns; nothing here computes with them. */
#ifndef GOLDEN_ANSWERS_H
#define GOLDEN_ANSWERS_H

#include "../tribox.h"

#ifndef GOLDEN_FN
#ifdef __CUDACC__
#define GOLDEN_FN static __host__ __device__
#else
#define GOLDEN_FN static
#endif
#endif

#include "companions_answers.h"
#include "golden_cases.h"

GOLDEN_FN void golden_copy(void *to, const void *from, size_t bytes)
{
    unsigned char *t = (unsigned char *)to;
    const unsigned char *f = (const unsigned char *)from;
    size_t i;
    for (i = 0; i < bytes; ++i) {
        t[i] = f[i];
    }
}

GOLDEN_FN void golden_doubles(double *out, const uint64_t *bits, int n)
{
    golden_copy(out, bits, sizeof *out * (size_t)n);
}

GOLDEN_FN void golden_floats(float *out, const uint64_t *bits, int n)
{
    int i;
    for (i = 0; i < n; ++i) {
        const uint32_t word = (uint32_t)bits[i];
        golden_copy(out + i, &word, sizeof word);
    }
}

/* the double of the same value as the float, by its bits */
GOLDEN_FN uint64_t golden_widen(uint64_t bits)
{
    const uint64_t sign = bits >> 31 << 63;
    const uint64_t exponent = bits >> 23 & 0xff;
    const int64_t mantissa = (int64_t)(bits & 0x7fffff);
    if (exponent == 0xff) {
        return sign | (uint64_t)0x7ff << 52 | (uint64_t)mantissa << 29;
    }
    if (exponent == 0) {
        return sign | golden_encode(mantissa, -149, 1);
    }
    return sign | golden_encode(mantissa | 0x800000, (int)exponent - 150, 1);
}

GOLDEN_FN void golden_widened(double *out, const uint64_t *bits, int n)
{
    int i;
    for (i = 0; i < n; ++i) {
        const uint64_t word = golden_widen(bits[i]);
        golden_copy(out + i, &word, sizeof word);
    }
}

/* Answer bits: 0..3 one box, closed, half-open, open, closed again by the plain entry; 4..7 prepared, closed,
 * half-open, open, thin. Float questions ask the double entries too, in bits 8..15, and prepared ones every
 * pairing of formats. */
GOLDEN_FN uint32_t golden_doubles_say(const double v[9], const double lo[3], const double hi[3],
                                      const double size[3])
{
    uint32_t word = 0;
    unsigned rule;
    for (rule = 0; rule < 3; ++rule) {
        word |= (uint32_t)tribox_overlap_rule_f64(v, v + 3, v + 6, lo, hi, (1u << rule) >> 1) << rule;
    }
    word |= (uint32_t)tribox_overlap_f64(v, v + 3, v + 6, lo, hi) << 3;
    for (rule = 0; rule < 4; ++rule) {
        tribox_tri tri;
        tribox_tri_init_f64(&tri, v, v + 3, v + 6, size, (1u << rule) >> 1);
        word |= (uint32_t)tribox_tri_test_f64(&tri, lo) << (4 + rule);
    }
    return word;
}

GOLDEN_FN uint32_t golden_floats_say(const float v[9], const float lo[3], const float hi[3],
                                     const float size[3], const double wide_lo[3])
{
    uint32_t word = 0;
    unsigned rule;
    for (rule = 0; rule < 3; ++rule) {
        word |= (uint32_t)tribox_overlap_rule(v, v + 3, v + 6, lo, hi, (1u << rule) >> 1) << rule;
    }
    word |= (uint32_t)tribox_overlap(v, v + 3, v + 6, lo, hi) << 3;
    for (rule = 0; rule < 4; ++rule) {
        tribox_tri tri;
        tribox_tri_init(&tri, v, v + 3, v + 6, size, (1u << rule) >> 1);
        word |= (uint32_t)tribox_tri_test(&tri, lo) << (4 + rule);
        word |= (uint32_t)tribox_tri_test_f64(&tri, wide_lo) << (16 + rule);
    }
    return word;
}

GOLDEN_FN uint32_t golden_ask_single(const golden_single *c)
{
    double v[9], lo[3], hi[3], size[3];
    float fv[9], flo[3], fhi[3], fsize[3];
    if (c->f64) {
        golden_doubles(v, c->v, 9);
        golden_doubles(lo, c->lo, 3);
        golden_doubles(hi, c->hi, 3);
        golden_doubles(size, c->size, 3);
        return golden_doubles_say(v, lo, hi, size);
    }
    golden_widened(v, c->v, 9);
    golden_widened(lo, c->lo, 3);
    golden_widened(hi, c->hi, 3);
    golden_widened(size, c->size, 3);
    golden_floats(fv, c->v, 9);
    golden_floats(flo, c->lo, 3);
    golden_floats(fhi, c->hi, 3);
    golden_floats(fsize, c->size, 3);
    return golden_floats_say(fv, flo, fhi, fsize, lo) | golden_doubles_say(v, lo, hi, size) << 8;
}

GOLDEN_FN void golden_region(const golden_grid *g, unsigned flags, tribox_grid *grid)
{
    int k;
    golden_doubles(grid->origin, g->origin, 3);
    golden_doubles(grid->size, g->size, 3);
    for (k = 0; k < 3; ++k) {
        grid->lo[k] = g->lo[k];
        grid->hi[k] = g->lo[k] + GOLDEN_EDGE;
    }
    grid->flags = flags;
}

GOLDEN_FN void golden_emit(void *user, int x0, int x1, int y, int z)
{
    uint64_t *hash = (uint64_t *)user;
    *hash = golden_mix_span(*hash, x0, x1, y, z);
}

/* Bits of an 8 x 8 x 8 region that begins at voxel lo. */
typedef struct golden_painted {
    uint64_t bits[GOLDEN_EDGE * GOLDEN_EDGE];
    int lo[3];
} golden_painted;

GOLDEN_FN void golden_paint(void *user, size_t triangle, int x0, int x1, int y, int z)
{
    golden_painted *p = (golden_painted *)user;
    (void)triangle;
    for (; x0 <= x1; ++x0) {
        p->bits[(z - p->lo[2]) * GOLDEN_EDGE + (y - p->lo[1])] |= (uint64_t)1 << (x0 - p->lo[0]);
    }
}

GOLDEN_FN void golden_paint_one(void *user, int x0, int x1, int y, int z)
{
    golden_paint(user, 0, x0, x1, y, z);
}

/* One triangle of doubles as a mesh: do the fill and the spans of meshes set the voxels of its spans? */
GOLDEN_FN int golden_fill_is_spans_f64(const tribox_grid *grid, const double v[9])
{
    golden_painted by_one;
    golden_painted by_mesh;
    uint64_t filled[GOLDEN_EDGE * GOLDEN_EDGE];
    tribox_mesh_f64 mesh;
    int same;
    int i;
    mesh.positions = v;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        filled[i] = by_one.bits[i] = by_mesh.bits[i] = 0;
    }
    for (i = 0; i < 3; ++i) {
        by_one.lo[i] = by_mesh.lo[i] = grid->lo[i];
    }
    tribox_grid_fill_f64(grid, &mesh, filled);
    same = tribox_mesh_spans_f64(grid, &mesh, golden_paint, &by_mesh) ==
           tribox_grid_spans_f64(grid, v, v + 3, v + 6, golden_paint_one, &by_one);
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        same &= filled[i] == by_one.bits[i] && by_mesh.bits[i] == by_one.bits[i];
    }
    return same;
}

GOLDEN_FN uint64_t golden_ask_grid(const golden_grid *g, unsigned flags)
{
    tribox_grid grid;
    uint64_t hash = GOLDEN_BASIS;
    size_t count;
    golden_region(g, flags, &grid);
    if (g->f64) {
        double v[9];
        golden_doubles(v, g->v, 9);
        count = tribox_grid_spans_f64(&grid, v, v + 3, v + 6, golden_emit, &hash);
        hash = golden_fill_is_spans_f64(&grid, v) ? hash : ~hash;
    } else {
        float v[9];
        golden_floats(v, g->v, 9);
        count = tribox_grid_spans(&grid, v, v + 3, v + 6, golden_emit, &hash);
    }
    return golden_mix(hash, count);
}

/* Bits of an 8 x 8 x 8 region that begins at voxel 0, as tribox_grid_fill sets them. */
GOLDEN_FN void golden_set(void *user, int x0, int x1, int y, int z)
{
    uint64_t *bits = (uint64_t *)user;
    for (; x0 <= x1; ++x0) {
        bits[z * GOLDEN_EDGE + y] |= (uint64_t)1 << x0;
    }
}

/* Small triangles, so many that a fill takes them several at a time, and the golden ones never are: do they
 * set the voxels of their spans, which the other golden answers hold against GMP? They lie at no simple
 * places, or on sixteenths of voxels whose planes are floats. */
GOLDEN_FN int golden_fill_is_spans(uint64_t seed, unsigned flags)
{
    enum { TRIANGLES = 40 };
    tribox_grid grid;
    tribox_mesh mesh;
    float v[9 * TRIANGLES];
    uint64_t filled[GOLDEN_EDGE * GOLDEN_EDGE];
    uint64_t spanned[GOLDEN_EDGE * GOLDEN_EDGE];
    const int on_lattice = (int)(seed >> 17 & 1);
    int same = 1;
    int i, k;
    for (k = 0; k < 3; ++k) {
        grid.origin[k] = -0.25;
        grid.size[k] = on_lattice ? 0.5 + 0.25 * k : 0.1 + 0.2 * k;
        grid.lo[k] = 0;
        grid.hi[k] = GOLDEN_EDGE;
    }
    grid.flags = flags;
    for (i = 0; i < 9 * TRIANGLES; ++i) {
        const int extent = 1 + i / 9 % 4;
        const int room = GOLDEN_EDGE + 1 - extent;
        const int first = (int)(golden_mix(seed, (uint64_t)(i / 9 * 3 + i % 3)) >> 40) % room;
        const uint64_t part = golden_mix(~seed, (uint64_t)i) >> 44;
        const double at = on_lattice ? (double)((part >> 12) % 17) / 16.0 : (double)part / 1048576.0;
        v[i] = (float)(grid.origin[i % 3] + grid.size[i % 3] * (first + extent * at));
    }
    for (i = 0; i < 3; ++i) { /* and some that are none, or nearly: infinity, NaN, subnormals, the largest number */
        const uint64_t dice = golden_mix(seed, (uint64_t)(1000 + i));
        const uint64_t odd[5] = {0x7f800000u, 0xff800000u, 0x7fc00000u, 0x00000001u, 0x7f7fffffu};
        golden_floats(v + (dice >> 40) % (9 * TRIANGLES), &odd[(dice >> 20) % 5], 1);
    }
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        filled[i] = spanned[i] = 0;
    }
    mesh.positions = v;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = TRIANGLES;
    tribox_grid_fill(&grid, &mesh, filled);
    for (i = 0; i < TRIANGLES; ++i) {
        tribox_grid_spans(&grid, v + 9 * i, v + 9 * i + 3, v + 9 * i + 6, golden_set, spanned);
    }
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        same &= filled[i] == spanned[i];
    }
    return same;
}

/* The same mesh as doubles, and as spans of both: the same voxels? */
GOLDEN_FN int golden_fill_is_same(const golden_grid *g, const tribox_grid *grid, const tribox_mesh *mesh,
                                  const uint64_t *bits)
{
    double wide[18];
    uint64_t filled[GOLDEN_EDGE * GOLDEN_EDGE];
    golden_painted by_float;
    golden_painted by_double;
    tribox_mesh_f64 mesh_f64;
    int same;
    int i;
    golden_widened(wide, g->v, 18);
    mesh_f64.positions = wide;
    mesh_f64.stride = 0;
    mesh_f64.indices = NULL;
    mesh_f64.triangles = 2;
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        filled[i] = by_float.bits[i] = by_double.bits[i] = 0;
    }
    for (i = 0; i < 3; ++i) {
        by_float.lo[i] = by_double.lo[i] = grid->lo[i];
    }
    tribox_grid_fill_f64(grid, &mesh_f64, filled);
    same = tribox_mesh_spans(grid, mesh, golden_paint, &by_float) ==
           tribox_mesh_spans_f64(grid, &mesh_f64, golden_paint, &by_double);
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        same &= filled[i] == bits[i] && by_float.bits[i] == bits[i] && by_double.bits[i] == bits[i];
    }
    return same;
}

GOLDEN_FN uint64_t golden_ask_fill(const golden_grid *g, unsigned flags)
{
    tribox_grid grid;
    tribox_mesh mesh;
    float v[18];
    uint64_t bits[GOLDEN_EDGE * GOLDEN_EDGE];
    uint64_t hash = GOLDEN_BASIS;
    int i;
    golden_region(g, flags, &grid);
    golden_floats(v, g->v, 18);
    mesh.positions = v;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 2;
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        bits[i] = 0;
    }
    if (tribox_grid_words(&grid) != GOLDEN_EDGE * GOLDEN_EDGE) {
        return 0;
    }
    tribox_grid_fill(&grid, &mesh, bits);
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        hash = golden_mix(hash, bits[i]);
    }
    return golden_fill_is_spans(g->v[0] ^ g->v[3], flags) && golden_fill_is_same(g, &grid, &mesh, bits) ? hash : ~hash;
}

/* The solid of both triangles, or of the first where they are doubles; is the point inside of it? */
GOLDEN_FN uint64_t golden_ask_solid(const golden_grid *g)
{
    tribox_grid grid;
    double point[3];
    uint64_t bits[GOLDEN_EDGE * GOLDEN_EDGE];
    uint64_t hash = GOLDEN_BASIS;
    int inside;
    int i;
    golden_region(g, 0, &grid);
    golden_doubles(point, g->point, 3);
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        bits[i] = 0;
    }
    if (g->f64) {
        double v[9];
        tribox_mesh_f64 mesh;
        golden_doubles(v, g->v, 9);
        mesh.positions = v;
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = 1;
        inside = tribox_mesh_contains_f64(&mesh, point);
        tribox_grid_fill_solid_f64(&grid, &mesh, bits);
    } else {
        float v[18];
        tribox_mesh mesh;
        golden_floats(v, g->v, 18);
        mesh.positions = v;
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = 2;
        inside = tribox_mesh_contains(&mesh, point);
        tribox_grid_fill_solid(&grid, &mesh, bits);
        inside |= tribox_ray_crosses(v, v + 3, v + 6, point) << 1;
    }
    for (i = 0; i < GOLDEN_EDGE * GOLDEN_EDGE; ++i) {
        hash = golden_mix(hash, bits[i]);
    }
    return golden_mix(hash, (uint64_t)inside);
}

GOLDEN_FN uint64_t golden_ask_locate(const golden_grid *g)
{
    tribox_grid grid;
    double point[3];
    int at[3];
    golden_region(g, 0, &grid);
    golden_doubles(point, g->point, 3);
    if (!tribox_grid_locate(&grid, point, at)) {
        return GOLDEN_BASIS;
    }
    return golden_mix_span(GOLDEN_BASIS, at[0], at[1], at[2], 0);
}

/* Does each corner of a finite triangle lie in a voxel of the region? */
GOLDEN_FN int golden_is_inside(const golden_grid *g, const tribox_grid *grid, const double wide[18])
{
    int inside = 1;
    int i, k;
    for (i = 0; i < 2; ++i) {
        int finite = 1;
        for (k = 0; k < 9; ++k) {
            finite &= (g->v[9 * i + k] >> 23 & 0xff) != 0xff;
        }
        for (k = 0; k < 3 && finite; ++k) {
            int at[3];
            inside &= tribox_grid_locate(grid, wide + 9 * i + 3 * k, at);
        }
    }
    return inside;
}

/* Does a mesh framed as floats and as doubles lie strictly inside? Bit 0: it was framed; bit 1: and each corner of a finite
 * triangle lies in a voxel of the region, and not on its lower faces. What the frame is, is not golden. */
GOLDEN_FN uint64_t golden_ask_fit(const golden_grid *g)
{
    tribox_grid grid;
    tribox_mesh mesh;
    float v[18];
    double wide[18];
    const int n = 5 + (int)(g->v[0] & 63);
    tribox_mesh_f64 mesh_f64;
    int fits, inside;
    golden_floats(v, g->v, 18);
    golden_widened(wide, g->v, 18);
    mesh.positions = v;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 2;
    mesh_f64.positions = wide;
    mesh_f64.stride = 0;
    mesh_f64.indices = NULL;
    mesh_f64.triangles = 2;
    fits = tribox_grid_fit_f64(&grid, &mesh_f64, n);
    inside = golden_is_inside(g, &grid, wide);
    if (tribox_grid_fit(&grid, &mesh, n) != fits) {
        return 8;
    }
    if (!fits) {
        return tribox_grid_words(&grid) == 0 ? 0 : 4;
    }
    return 1u | (unsigned)(inside & golden_is_inside(g, &grid, wide)) << 1;
}

GOLDEN_FN void golden_ask_companion(const companion *c, companion_answer *out)
{
    companion_ask(c, out);
}

#endif
