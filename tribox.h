/* tribox.h - triangle / axis-aligned box overlap tests - v0.2.0 - MIT or Unlicense, see end of file
 *
 * Every number you pass is taken as the exact real number it is. A triangle is the convex hull of its three
 * corners, a box is closed, and the answer is whether the two share a point. The answer is never rounded.
 *
 * QUICK START      Copy this file. No build, no library, no allocation, no global state.
 *
 *     #include "tribox.h"
 *     const float v0[3] = { .5f, .2f, .6f }, v1[3] = { .3f, .1f, .4f }, v2[3] = { .3f, .6f, .6f };
 *     const float box_min[3] = { .4f, .4f, .5f }, box_max[3] = { .7f, .5f, .6f };
 *     int touch = tribox_overlap(v0, v1, v2, box_min, box_max);    // 1; plain float tests say 0
 *
 * WHICH FUNCTION   (most have a version for doubles, _f64)
 *     One triangle, one box                        tribox_overlap; with open faces: tribox_overlap_rule
 *     One triangle, many boxes of one size         tribox_tri_init, then tribox_tri_test; octrees: _octants
 *     One triangle, or a mesh, in a voxel grid     tribox_grid_spans, tribox_mesh_spans: runs to a callback
 *     A mesh into a bit array                      tribox_grid_fit, tribox_grid_words, tribox_grid_fill
 *     The solid within a mesh; is a point inside   tribox_grid_fill_solid, tribox_mesh_contains
 *     Read that array; voxel of a point, of a line tribox_grid_get, tribox_grid_locate, tribox_grid_segment
 *     Boxes, planes, segments, rays, spheres       tribox_box_box, _plane_box, _segment_box, _ray_box, ...
 *     Rays against triangles, moving boxes, depth  tribox_ray_triangle, tribox_sweep, tribox_gap
 *     Cut by a box; nearest point; mesh in a box   tribox_clip, tribox_closest, tribox_mesh_query
 *     The published float test, to compare with    tribox_sat (may err within rounding of touching)
 *
 * CONVENTIONS      A point is float[3] or double[3], x, y, z, in any unit. Any winding. Triangles may be
 *                  segments or points, boxes flat or infinite. Touching counts, unless flags say otherwise.
 *                  Returns are 1 and 0. A triangle with a NaN or infinite corner, and a box with a NaN or
 *                  min > max, hold no points: 0.
 *
 * HOW IT WORKS     Numbers enter as bits (section 4). Floating-point arithmetic evaluates the conditions of
 *                  [AM01] and [SS10] with a proven bound of its error: sure values give HIT or MISS. What is
 *                  UNSURE goes to integers that are wide enough for every input (section 5), never to a
 *                  tolerance. Sections 4 to 10 say all of it in scalar code; section 11 only makes it faster.
 *                  A list of what stands where follows the API.
 *
 * OPTIONS          Define before the #include; they need not agree across files.
 *                  TRIBOX_FN  linkage of the functions; default static inline
 *                  TRIBOX_SIMD  0: scalar code; 1: vectors of gcc and clang; default: 1 where they pay
 *                  TRIBOX_NO_COMPANIONS  leaves out what stands under "Companions"
 *
 * LIMITS           Answers do not depend on compiler, optimisation, fast-math, FMA, rounding mode, x87, or
 *                  flush-to-zero (subnormals still count). A caller compiled with -ffinite-math-only cannot
 *                  pass NaN or infinity by value (t_min, t_max, d, radii), nor read tribox_gap's infinity.
 *                  Voxel indices are int, INT_MAX excluded. Only "inexact" and "underflow" are raised, but by
 *                  tribox_sat. Needs IEEE 754 formats; on Alpha -mieee.
 *
 * REFERENCES       [AM01] Akenine-Moller, Fast 3D triangle-box overlap testing, JGT 6(1), 2001
 *                  [SS10] Schwarz, Seidel, Fast parallel surface and solid voxelization, ACM TOG 29(6), 2010
 *                  [KK86] Kay, Kajiya, Ray tracing complex scenes, 1986  [Sh97] Shewchuk, Adaptive precision
 *                  floating-point arithmetic and fast robust geometric predicates, 1997
 *
 * CHANGES          v0.2.0 2026-11-28  add: solids, meshes of doubles, contact, spheres  fix: newer compilers
 *                  v0.1.0 2026-11-22  add: everything
 */
#if defined(TRIBOX_H) && (TRIBOX_VERSION_MAJOR != 0 || TRIBOX_VERSION_MINOR != 2 || TRIBOX_VERSION_PATCH != 0)
#error "two different versions of tribox.h in one file"
#endif
#ifndef TRIBOX_H
#define TRIBOX_H

/* ---- 1. Version and linkage ---------------------------------------------------------------------------- */

#define TRIBOX_VERSION_MAJOR 0
#define TRIBOX_VERSION_MINOR 2
#define TRIBOX_VERSION_PATCH 0
#define TRIBOX_VERSION (TRIBOX_VERSION_MAJOR * 10000 + TRIBOX_VERSION_MINOR * 100 + TRIBOX_VERSION_PATCH)
#define TRIBOX_VERSION_STRING "0.2.0"

#include <float.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__CUDACC__) || defined(__HIPCC__)
#define TBX_FN __host__ __device__ static inline    /* one set of functions serves host and device */
#elif defined(_MSC_VER) && !defined(__cplusplus)
#define TBX_FN static __inline
#else
#define TBX_FN static inline
#endif
#ifndef TRIBOX_FN
#define TRIBOX_FN TBX_FN
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- 2. API -------------------------------------------------------------------------------------------- */

/* Does the triangle share a point with the closed box?
 *
 *   v0, v1, v2        corners, 3 numbers each, any unit; any winding; may coincide (segment, point)
 *   box_min, box_max  opposite corners, same unit; faces belong to the box; may be infinite
 *
 * Returns     1 = they share a point, 0 = they do not. NaN or an infinite corner: 0. box_min > box_max: 0.
 * Guarantees  Exact for every input; the same answer with any compiler, flags and rounding mode.
 * Cost        About 200 instructions (float), 380 (double). Within 2^-14 (2^-43) of touching, relative to
 *             the triangle's extent, doubles are asked again (float), then integers, whose time grows with
 *             the bits that the coordinates span.
 * Source      [AM01] for the axes; the bound is derived in section 6.
 */
TRIBOX_FN int tribox_overlap(const float v0[3], const float v1[3], const float v2[3],
                             const float box_min[3], const float box_max[3]);
TRIBOX_FN int tribox_overlap_f64(const double v0[3], const double v1[3], const double v2[3],
                                 const double box_min[3], const double box_max[3]);

enum {                      /* flags; 0 = closed, conservative */
    TRIBOX_HALF_OPEN = 1,   /* the box is [min, max) on each axis: every point lies in exactly one
                             * grid voxel */
    TRIBOX_OPEN      = 2,   /* the box is its interior: touching does not count */
    TRIBOX_THIN      = 4    /* 6-separating test of [SS10] instead of the conservative one; always closed */
};

/* The same under a touching rule.
 *
 *   flags  0: closed. TRIBOX_HALF_OPEN: the box is min <= x < max per axis. TRIBOX_OPEN: min < x < max.
 *          Both: open. TRIBOX_THIN means closed here; other bits are ignored.
 *
 * Returns     1 or 0; a flat box holds no points under HALF_OPEN and OPEN.
 * Guarantees, Cost, Source: as tribox_overlap.
 */
TRIBOX_FN int tribox_overlap_rule(const float v0[3], const float v1[3], const float v2[3],
                                  const float box_min[3], const float box_max[3], unsigned flags);
TRIBOX_FN int tribox_overlap_rule_f64(const double v0[3], const double v1[3], const double v2[3],
                                      const double box_min[3], const double box_max[3], unsigned flags);

/* The reference: the 13-axis test as published, in plain float.
 *
 * Returns     1 or 0, as tribox_overlap's arguments.
 * Guarantees  None near touching: it may err either way within rounding of it, misses 2 % of the pairs on a
 *             grid of 0.1f, and depends on compiler and flags. NaN: unspecified, 0 or 1.
 * Cost        About 170 flops.
 * Source      [AM01].
 */
TRIBOX_FN int tribox_sat(const float v0[3], const float v1[3], const float v2[3],
                         const float box_min[3], const float box_max[3]);

/* ---- One triangle, many voxels */

/* Structs are laid out in the same way in every file, also where `#pragma pack(1)` is open. */
#pragma pack(push, 16)

/* Warnings that some users switch on and that this file cannot heed: it is C, where a cast has one form, and
 * its comparisons of numbers for equality are meant. */
#if defined(__GNUC__) && !defined(__TINYC__) && !defined(__PCC__) && !defined(__chibicc__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wfloat-equal"
#ifdef __cplusplus
#pragma GCC diagnostic ignored "-Wold-style-cast"
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wuseless-cast"
#endif
#endif
#endif

/* One triangle prepared for boxes [p, p + size]. Read it freely; only the init and resize functions write it.
 *
 * The conditions are those of [SS10], n its normal, n_e and d_e its edge normals and distances, in float, at
 * q = p - ref. In lane a = 0, 1, 2 are edges 0 and 2 as seen along axis a (x, y, z), b and c being the next
 * two axes in cyclic order; in lane 3 is the triangle's plane, n = (n_e_b[0][3], n_e_c[0][3], n_z[3]):
 *
 *   edge 0, plane   value_0 = n_e_b[0]*q_b + n_e_c[0]*q_c + d_e[0], in lane 3 n.q + d_e[0]
 *   edge 2          value_2 = n_e_b[1]*q_b + n_e_c[1]*q_c + d_e[1], in lane 3 d_e[1]
 *   edge 1, plane   d_e[2] - (value_0 + value_2): edge normals add up to zero, and so do the plane's two
 *                   sides
 *
 * Where a p satisfies the faces, a condition fails if its value is < 0, and holds if it is >= 2: each lane is
 * scaled by a power of two such that rounding changes values by less than 1, and 1 is added. Between 0 and 2,
 * integers decide. */
typedef struct tribox_tri {
    float    ref[4];      /* x, y, z, z of a point beside v[0] */
    float    n_e_b[2][4];
    float    n_e_c[2][4];
    float    n_z[4];      /* 0, 0, 0, z of the normal */
    float    d_e[3][4];
    double   v[3][3];     /* the corners */
    double   size[3];     /* dp, the boxes' size */
    double   t_min[3];    /* the triangle's bounding box */
    double   t_max[3];
    unsigned flags;       /* as they apply: infinite boxes are never thin */
    int      empty;       /* 1: the triangle or every box is the empty set */
    struct {              /* may change with any version */
        unsigned flags;    /* as given */
        int      in_range; /* 0: the conditions are unsure of every p; 2: and all numbers are floats */
        float    step[4];  /* size, as x, y, z, z */
        int32_t  most[4];  /* the faces hold iff the bits of x, y, z, z as integers are <= most, */
        int32_t  shift[4]; /* and, moved by shift, wrapping round, <= span */
        int32_t  span[4];
    } hidden;
} tribox_tri;

/* Prepares a triangle for boxes of one size: the setup of [SS10].
 *
 *   tri         is written; plain data, may be copied, may lie at any address
 *   v0, v1, v2  corners; a triangle with NaN or infinity is empty
 *   size        dp, the boxes' size per axis; 0: flat, +infinity: half-spaces; negative or NaN: empty
 *   flags       0: closed, conservative. TRIBOX_HALF_OPEN, TRIBOX_OPEN: touching rules.
 *               TRIBOX_THIN: the 6-separating test, always closed (conservative where a size is
 *               infinite). Other bits are ignored.
 *
 * Guarantees  Any init may be followed by any test.
 * Cost        30 ns from floats, 90 if they come as doubles; 0.5 us from other doubles, where the sign of a
 *             normal's component is within rounding of 0, and without vectors.
 * Source      [SS10], conservative and 6-separating tests.
 */
TRIBOX_FN void tribox_tri_init(tribox_tri *tri, const float v0[3], const float v1[3], const float v2[3],
                               const float size[3], unsigned flags);
TRIBOX_FN void tribox_tri_init_f64(tribox_tri *tri, const double v0[3], const double v1[3],
                                   const double v2[3], const double size[3], unsigned flags);

/* Does the prepared triangle touch the box [p, p + size], the sum in real numbers?
 *
 *   p  the box's minimum corner, finite, else 0
 *
 * Returns     1 or 0.
 * Guarantees  Exact. p + size is not rounded: [p, p + size] is not [p, fl(p + size)].
 * Cost        Float: 12 conditions in 3 vectors, no early exit, 4 ns; double: 25 ns. Near touching as
 *             tribox_overlap.
 * Source      [SS10], the edge functions and the plane.
 */
TRIBOX_FN int tribox_tri_test(const tribox_tri *tri, const float p[3]);
TRIBOX_FN int tribox_tri_test_f64(const tribox_tri *tri, const double p[3]);

/* ---- Grids */

/* A voxel grid. Voxel (i,j,k) is [origin + (i,j,k)*size, origin + (i+1,j+1,k+1)*size], in real numbers. */
typedef struct tribox_grid {
    double   origin[3];     /* minimum corner of voxel (0,0,0) */
    double   size[3];       /* of a voxel, > 0 */
    int      lo[3];         /* the region that a call works on: lo <= index < hi; indices may be negative */
    int      hi[3];
    unsigned flags;         /* TRIBOX_HALF_OPEN, TRIBOX_OPEN or TRIBOX_THIN; 0 = closed, conservative */
} tribox_grid;

/* Receives voxels x0..x1, both included, of row y, z. */
typedef void (*tribox_span_fn)(void *user, int x0, int x1, int y, int z);

/* The same of a mesh's triangle, its number counted from 0. */
typedef void (*tribox_mesh_span_fn)(void *user, size_t triangle, int x0, int x1, int y, int z);

typedef struct tribox_mesh {
    const float    *positions;  /* x,y,z of vertex i at (const char *)positions + i*stride; any alignment */
    size_t          stride;     /* bytes between vertices; 0 means 3*sizeof(float) */
    const uint32_t *indices;    /* 3 per triangle; NULL means 0,1,2, 3,4,5, ... */
    size_t          triangles;
} tribox_mesh;

typedef struct tribox_mesh_f64 {
    const double   *positions;  /* x,y,z of vertex i at (const char *)positions + i*stride; any alignment */
    size_t          stride;     /* bytes between vertices; 0 means 3*sizeof(double) */
    const uint32_t *indices;    /* 3 per triangle; NULL means 0,1,2, 3,4,5, ... */
    size_t          triangles;
} tribox_mesh_f64;

/* The voxels of the grid's region that the triangle touches, as runs along x.
 *
 *   grid     origin and size finite, size > 0, lo < hi on each axis; else nothing is emitted
 *   on_span  called for each span with user; NULL only counts
 *
 * Returns     How many voxels; saturates at SIZE_MAX.
 * Guarantees  Exact. Spans are disjoint, maximal, ordered by z, then y; each voxel once. With TRIBOX_THIN
 *             enough voxels to block every face-connected path. A face on a grid plane sets both layers when
 *             closed or thin, the upper one under HALF_OPEN, none under OPEN.
 * Cost        In the rows that the triangle crosses in the region, about 10 ns each, after about 400 ns; not
 *             in its size, the voxels' number, or the extent of the indices. Less than 16 KiB of stack.
 * Source      The conditions of [SS10], each solved for x.
 */
TRIBOX_FN size_t tribox_grid_spans(const tribox_grid *grid, const float v0[3], const float v1[3],
                                   const float v2[3], tribox_span_fn on_span, void *user);
TRIBOX_FN size_t tribox_grid_spans_f64(const tribox_grid *grid, const double v0[3], const double v1[3],
                                       const double v2[3], tribox_span_fn on_span, void *user);

/* The spans of a whole mesh, each with the number of its triangle.
 *
 *   grid     as for tribox_grid_spans
 *   mesh     its triangles; indices must be within positions
 *   on_span  called for each span with user and the triangle's number, counted from 0; NULL only counts
 *
 * Returns     The sum of all triangles' voxels: one counts once for each triangle that touches it. Saturates
 *             at SIZE_MAX. 0 for an invalid grid.
 * Guarantees  The spans of one triangle are those of tribox_grid_spans, come together and in its order;
 *             triangles come in any order, each at most once. No allocation, less than 16 KiB of stack.
 */
TRIBOX_FN size_t tribox_mesh_spans(const tribox_grid *grid, const tribox_mesh *mesh,
                                   tribox_mesh_span_fn on_span, void *user);
TRIBOX_FN size_t tribox_mesh_spans_f64(const tribox_grid *grid, const tribox_mesh_f64 *mesh,
                                       tribox_mesh_span_fn on_span, void *user);

/* How many 64-bit words the region's bit array needs: nz*ny*row_words, row_words = (nx + 63)/64. Voxel
 * (x,y,z), counted from lo, is bit (x & 63) of word (z*ny + y)*row_words + (x >> 6).
 *
 * Returns     The words; 0 for an empty or invalid grid, or more than SIZE_MAX bytes.
 */
TRIBOX_FN size_t tribox_grid_words(const tribox_grid *grid);

/* Sets the voxels of the region that a mesh touches.
 *
 *   mesh  its triangles; indices must be within positions
 *   bits  tribox_grid_words(grid) words; bits are ORed, never cleared; padding bits of a row are never set
 *
 * Guarantees  The voxels of tribox_grid_spans for every triangle. A z-slab of the region, given
 *             bits + (slab.lo[2] - whole.lo[2])*ny*row_words, writes exactly its part of the whole, so slabs
 *             can be filled by any number of threads. Where tribox_grid_words is 0, nothing is written.
 * Cost        About 8 ns for a triangle off the region, 15 ns for one whose voxels are all set, 20 to 70 ns
 *             for one of up to 4 voxels on each axis, 0.16 us for 8, then about 5 ns a row. It costs no more
 *             to touch exactly where grid planes and corners are floats, as 1/16 of a voxel of size 1 or 0.25
 *             is; else up to 1 us where a corner is within rounding of a grid plane, or an edge of a voxel's
 *             (gcc 12 -O2, a Xeon). Without vectors three to five times that. Less than 16 KiB of stack.
 */
TRIBOX_FN void tribox_grid_fill(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits);
TRIBOX_FN void tribox_grid_fill_f64(const tribox_grid *grid, const tribox_mesh_f64 *mesh, uint64_t *bits);

/* Flips the bits of the region's voxels whose centre lies inside a mesh: the solid, from bits that are zero.
 *
 *   grid  its flags are ignored
 *   mesh  any triangles, any winding; indices must be within positions
 *   bits  tribox_grid_words(grid) words; XORed; padding bits are never changed
 *
 * A centre c = origin + (index + 1/2)*size, in real numbers, is inside iff the ray from c toward -x crosses
 * an odd number of triangles, c being taken as c + (e, e^2, e^3) for every small enough e > 0. So no case is
 * degenerate: a point of a face belongs to the solid iff the first non-zero of the outward normal's x, y, z
 * is negative, and solids that tile space tile the centres. Triangles parallel to x, degenerate ones, and
 * those with a NaN or infinite corner are never crossed.
 *
 * Guarantees  Exact. Where every edge, as exact points, lies on an even number of triangles (indexed or soup,
 *             any winding, T-junctions whose middle is exact), no row leaks. A z-slab writes exactly its part
 *             of the whole, as with tribox_grid_fill. Where tribox_grid_words is 0, nothing is written.
 * Cost        8 ns for a triangle that holds no centre of a row, seen along x; else 20 to 30 ns for each
 *             centre, with the words from its crossing to the end of a row of 512 voxels (gcc 12 -O2, an
 *             EPYC). Without vectors about ten times the former. Less than 16 KiB of stack.
 * Source      [SS10], solid voxelization.
 */
TRIBOX_FN void tribox_grid_fill_solid(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits);
TRIBOX_FN void tribox_grid_fill_solid_f64(const tribox_grid *grid, const tribox_mesh_f64 *mesh,
                                          uint64_t *bits);

/* Is the point inside the mesh, by the rule of tribox_grid_fill_solid?
 *
 * Returns     1 inside; 0 not, or the point is not finite.
 * Guarantees  Exact.
 * Cost        One pass over the mesh, 18 ns a triangle.
 */
TRIBOX_FN int tribox_mesh_contains(const tribox_mesh *mesh, const double point[3]);
TRIBOX_FN int tribox_mesh_contains_f64(const tribox_mesh_f64 *mesh, const double point[3]);

/* Does the ray from the point toward -x cross the triangle, by the same rule? One triangle's part in
 * tribox_mesh_contains, for trees and sparse grids.
 *
 * Returns     1 or 0; 0 for a point that is not finite.
 * Guarantees  Exact.
 * Cost        80 ns; within rounding of an edge or the plane, a microsecond.
 */
TRIBOX_FN int tribox_ray_crosses(const float v0[3], const float v1[3], const float v2[3],
                                 const double point[3]);

/* Reads a bit array: 1 if voxel (x,y,z), in the grid's indices, is set, else 0; 0 outside the region and for
 * an invalid grid. */
TRIBOX_FN int tribox_grid_get(const tribox_grid *grid, const uint64_t *bits, int x, int y, int z);

/* Frames a mesh: cubic voxels, n along its longest side, flags 0, lo = 0.
 *
 *   grid  is written
 *   n     voxels along the longest side, >= 1
 *
 * Returns     1; 0 and an empty region for a mesh without finite extent (no finite triangle,
 *             or a point) or n < 1.
 * Guarantees  The mesh's finite triangles lie strictly inside the region, so no voxel outside is touched.
 *             Size and origin are numbers of few bits, within 1/500 of a voxel of the tightest fit; they are
 *             chosen in floating point and may differ between compilers in the last place.
 * Cost        One pass over the mesh.
 */
TRIBOX_FN int tribox_grid_fit(tribox_grid *grid, const tribox_mesh *mesh, int n);
TRIBOX_FN int tribox_grid_fit_f64(tribox_grid *grid, const tribox_mesh_f64 *mesh, int n);

/* Finds the voxel whose half-open box [min, max) holds the point.
 *
 *   out_index  its indices, clamped to int; not written if the grid or the point is not finite, or size <= 0
 *
 * Returns     1 if it lies in the region, else 0.
 * Guarantees  Exact: the one voxel that a point triangle sets under TRIBOX_HALF_OPEN.
 */
TRIBOX_FN int tribox_grid_locate(const tribox_grid *grid, const double point[3], int out_index[3]);

/* ---- Companions
 *
 * The questions beside the question, with the same promise: every number is the exact real number it is,
 * sets are closed, and every yes or no is exact. Boxes may have infinite faces; a box with min > max, NaN,
 * or both faces at one infinity is empty. Versions in _f64 take and write doubles: where a float is written
 * that is the greatest <= (least >=, nearest) the exact number, they write such a double. Costs were measured
 * with gcc 12 -O2 on a Xeon or an EPYC; "f64" is the version for doubles, whose ends are found in integers.
 * TRIBOX_NO_COMPANIONS leaves this section out. */

#ifndef TRIBOX_NO_COMPANIONS

/* Do two boxes share a point?
 *
 *   a_min, a_max, b_min, b_max   opposite corners; faces belong to the boxes; may be infinite
 *
 * Returns     1 = they share a point, 0 = they do not, or one of them is empty.
 * Guarantees  Exact.
 * Cost        Six comparisons: 5 ns with its checks, f64 35.
 */
TRIBOX_FN int tribox_box_box(const float a_min[3], const float a_max[3], const float b_min[3],
                             const float b_max[3]);
TRIBOX_FN int tribox_box_box_f64(const double a_min[3], const double a_max[3], const double b_min[3],
                                 const double b_max[3]);

/* On which side of the plane n.x + d = 0 does the box lie?
 *
 *   n, d              any length of n; d may be infinite
 *   box_min, box_max  opposite corners; may be infinite
 *
 * Returns     -1 = the whole box has n.x + d < 0, +1 = the whole box has n.x + d > 0, 0 = it meets the plane.
 *             n = 0: the sign of d. NaN, an infinite n or an empty box: 2.
 * Guarantees  Exact: decided at the two critical points.
 * Cost        60 ns; where a critical point is within 2^-48 of the plane, a microsecond.
 */
TRIBOX_FN int tribox_plane_box(const float n[3], float d, const float box_min[3], const float box_max[3]);

/* Does the segment share a point with the box?
 *
 *   p, q              its ends; may coincide
 *   box_min, box_max  opposite corners; may be infinite
 *
 * Returns     1 or 0. A NaN or infinite end, or an empty box: 0.
 * Guarantees  Exact: the segment is the triangle p, q, q.
 * Cost        10 ns; f64 22 ns; within rounding of touching, as tribox_overlap.
 */
TRIBOX_FN int tribox_segment_box(const float p[3], const float q[3], const float box_min[3],
                                 const float box_max[3]);
TRIBOX_FN int tribox_segment_box_f64(const double p[3], const double q[3], const double box_min[3],
                                     const double box_max[3]);

/* Where is origin + t*dir, t in [t_min, t_max], inside the box?
 *
 *   origin, dir       finite; zero components of dir, and dir = 0, are exact cases like any other
 *   t_min, t_max      0 and 1 for a segment, 0 and infinity for a ray, both infinite for a line
 *   box_min, box_max  opposite corners; may be infinite
 *   out_t0, out_t1    bounds of the interval of t inside; may be NULL; untouched when the answer is 0
 *
 * Returns     1 = some t of the interval is inside. t_min > t_max, NaN, an infinite origin or dir, an empty
 *             box: 0.
 * Guarantees  Exact. out_t0 is the greatest float (or -infinity) that is <= the exact lower end of the
 *             interval, out_t1 the least float (or infinity) that is >= its upper end.
 * Cost        15 ns; 40 ns where dir has a zero component or without vectors; where both ends are floats, and
 *             within rounding of touching, 0.2 to 1 us; f64: 40 ns, and 0.3 us for each end that is asked
 *             for.
 * Source      [KK86], slabs.
 */
TRIBOX_FN int tribox_ray_box(const float origin[3], const float dir[3], float t_min, float t_max,
                             const float box_min[3], const float box_max[3], float *out_t0, float *out_t1);
TRIBOX_FN int tribox_ray_box_f64(const double origin[3], const double dir[3], double t_min, double t_max,
                                 const double box_min[3], const double box_max[3], double *out_t0,
                                 double *out_t1);

/* Does origin + t*dir, t in [t_min, t_max], meet the triangle, sides and border included?
 *
 *   origin, dir, t_min, t_max   as for tribox_ray_box
 *   v0, v1, v2                  corners; any winding; may be collinear or coincide
 *   out_t                       where the ray enters; may be NULL; untouched when the answer is 0
 *
 * Returns     1 or 0. NaN, infinities other than in t, t_min > t_max: 0.
 * Guarantees  Exact, so no ray slips between two triangles that share an edge. A ray in the triangle's plane,
 *             or along a degenerate triangle, has an interval of t inside. out_t is the greatest float (or
 *             -infinity) that is <= its lower end.
 * Cost        50 ns where the ray's line misses, else 200 ns, f64 0.3 us; within 2^-48 of an edge or parallel
 *             to the plane, 3 us.
 */
TRIBOX_FN int tribox_ray_triangle(const float origin[3], const float dir[3], float t_min, float t_max,
                                  const float v0[3], const float v1[3], const float v2[3], float *out_t);
TRIBOX_FN int tribox_ray_triangle_f64(const double origin[3], const double dir[3], double t_min, double t_max,
                                      const double v0[3], const double v1[3], const double v2[3],
                                      double *out_t);

/* When does the box, moving by t*velocity, t in [0, 1], touch the triangle?
 *
 *   v0, v1, v2        corners; any winding; may be collinear or coincide
 *   box_min, box_max  opposite corners at t = 0; may be infinite
 *   velocity          finite; may be 0
 *   out_t0, out_t1    first and last contact, in [0, 1]
 *   out_axis          unit vector, from triangle to box, along which they come into contact
 *
 * Returns     1 = they touch at some t. Otherwise 0, and nothing is written: also for NaN, an infinite corner
 *             or velocity, and an empty box. Every output may be NULL.
 * Guarantees  The answer is exact. out_t0 is the greatest float <= the exact first contact, out_t1 the least
 *             float >= the last. out_axis is within 2^-22 of the exact unit vector of the first axis (the
 *             faces x, y, z; the normal; the edges v0v1, v1v2, v2v0 crossed with x, then with y, then with z)
 *             whose interval opens at the first contact. At t = 0: the first that opens there, else the first
 *             of zero gap, else (0,0,0).
 * Cost        1 us; where two times or an axis cannot be told apart in double, 7 us.
 * Source      The 13 axes of [AM01], moving.
 */
TRIBOX_FN int tribox_sweep(const float v0[3], const float v1[3], const float v2[3],
                           const float box_min[3], const float box_max[3], const float velocity[3],
                           float *out_t0, float *out_t1, float out_axis[3]);

/* tribox_sweep under a touching rule: what a box at rest on a floor, or sliding along it, has to ask.
 *
 *   flags  TRIBOX_OPEN, with or without TRIBOX_HALF_OPEN: the box is its interior, so that touching does not
 *          count. Everything else, TRIBOX_HALF_OPEN alone and TRIBOX_THIN with whatever else, means closed.
 *
 * Returns     OPEN: 1 = at some t in [0, 1] the triangle meets the interior; a flat box has none: 0.
 *             Otherwise as tribox_sweep.
 * Guarantees  As tribox_sweep; under OPEN, out_t0 and out_t1 round the infimum and the supremum of these t,
 *             and out_axis is (0,0,0) if the interior is met at t = 0, else the first axis whose open
 *             interval begins at the infimum.
 * Cost, Source: as tribox_sweep.
 */
TRIBOX_FN int tribox_sweep_rule(const float v0[3], const float v1[3], const float v2[3],
                                const float box_min[3], const float box_max[3], const float velocity[3],
                                unsigned flags, float *out_t0, float *out_t1, float out_axis[3]);

/* When does box a, moving by t*velocity, t in [0, 1], touch box b?
 *
 *   a_min, a_max, b_min, b_max   opposite corners at t = 0; may be infinite
 *   velocity, flags              as for tribox_sweep_rule; OPEN asks for the interior of a
 *   out_t0, out_t1, out_axis     as for tribox_sweep_rule; the axes are the three faces', from b to a
 *
 * Returns     1 or 0. Under OPEN a flat b counts, as a flat triangle does; a flat a does not.
 * Guarantees  As tribox_sweep_rule.
 * Cost        0.5 us; where two times are equal or cannot be told apart in double, 2 us.
 * Source      [KK86], slabs.
 */
TRIBOX_FN int tribox_sweep_box(const float a_min[3], const float a_max[3], const float b_min[3],
                               const float b_max[3], const float velocity[3], unsigned flags, float *out_t0,
                               float *out_t1, float out_axis[3]);

/* How far apart are triangle and box, or how deep is the box in it?
 *
 *   v0, v1, v2        corners; any winding; may be collinear or coincide
 *   box_min, box_max  opposite corners; may be infinite
 *   out_axis          unit vector, from triangle to box, along which that is measured; may be NULL
 *
 * Returns     s = the greatest, over unit vectors u along the axes of tribox_sweep and their opposites, of
 *             (min of u.x over the box) - (max of u.x over the triangle). s > 0: apart, by at least s. s = 0:
 *             they touch. s < 0: no shorter move than -s separates them, and the box moved by -s along
 *             out_axis only touches. +infinity if one of them is empty, also for NaN or an infinite corner;
 *             -infinity if all faces are infinite: then no axis is written.
 * Guarantees  s > 0 exactly where tribox_overlap is 0, s < 0 exactly where, under TRIBOX_OPEN,
 *             tribox_overlap_rule is 1 (a flat box: where the triangle pierces it). s is within 2^-40 of
 *             itself, and a normal double, but its last bits may differ between compilers. out_axis is the
 *             first axis, in tribox_sweep's order, that attains s exactly; of its two directions, if both do,
 *             the one whose first non-zero component is positive; within 2^-22 of the exact unit vector.
 * Cost        60 ns; where two axes cannot be told apart in double, 1 to 8 us.
 * Source      The 13 axes of [AM01].
 */
TRIBOX_FN double tribox_gap(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                            const float box_max[3], float out_axis[3]);

/* Gives a prepared triangle another box size, as a step of an octree descent.
 *
 *   tri   set up by any init
 *   size  3 numbers, as for tribox_tri_init
 *
 * Guarantees  The same answers as after tribox_tri_init with that size.
 * Cost        80 ns where corners and size are floats, else as tribox_tri_init_f64.
 */
TRIBOX_FN void tribox_tri_resize(tribox_tri *tri, const float size[3]);
TRIBOX_FN void tribox_tri_resize_f64(tribox_tri *tri, const double size[3]);

/* Which of the eight boxes of one octree node does a prepared triangle touch?
 *
 *   tri  set up with the size of the eight boxes, that is, half the node's
 *   p    minimum corner of the node: the boxes are at p + {0,1}*size, in real numbers
 *
 * Returns     Bit x + 2y + 4z for the box at p + (x,y,z)*size. p not finite: 0.
 * Guarantees  Each bit is the exact answer for that box, by the rule tri was set up with.
 * Cost        12 ns, double 20; for each box within the filter's bound, as tribox_tri_test there.
 */
TRIBOX_FN unsigned tribox_tri_octants(const tribox_tri *tri, const float p[3]);
TRIBOX_FN unsigned tribox_tri_octants_f64(const tribox_tri *tri, const double p[3]);

/* Cuts the triangle by the box.
 *
 *   v0, v1, v2        corners; may be collinear or coincide
 *   box_min, box_max  opposite corners; may be infinite
 *   out_polygon       room for nine points; those past the answer may be overwritten too
 *
 * Returns     How many corners the polygon has: 0 exactly where tribox_overlap is 0, at most 9.
 * Guarantees  The extreme points of the exact intersection, in the triangle's winding, beginning with the
 *             lexicographically least, each coordinate rounded to nearest (ties to even), so all lie in the
 *             box. A point that rounds like an earlier one is left out.
 * Cost        1 us, f64 2 us; where a cut cannot be decided or rounded in double, 5 us.
 */
TRIBOX_FN int tribox_clip(const float v0[3], const float v1[3], const float v2[3],
                          const float box_min[3], const float box_max[3], float out_polygon[9][3]);
TRIBOX_FN int tribox_clip_f64(const double v0[3], const double v1[3], const double v2[3],
                              const double box_min[3], const double box_max[3], double out_polygon[9][3]);

/* Which point of the triangle is nearest to q? For colours and normals of voxels.
 *
 *   v0, v1, v2   corners; may be collinear or coincide
 *   q            the point
 *   out_weights  its barycentric weights: the point is w0 v0 + w1 v1 + w2 v2
 *
 * Guarantees  The nearest corner, edge or face is chosen exactly, and each weight is the exact one rounded to
 *             nearest. Degenerate triangle: of all weights of that point, those with the fewest non-zeros, at
 *             the lowest indices. NaN or infinity: (1,0,0).
 * Cost        0.3 us, f64 1.1 us; where the feature cannot be decided in double, 3 us.
 */
TRIBOX_FN void tribox_closest(const float v0[3], const float v1[3], const float v2[3], const float q[3],
                              float out_weights[3]);
TRIBOX_FN void tribox_closest_f64(const double v0[3], const double v1[3], const double v2[3],
                                  const double q[3], double out_weights[3]);

/* Which triangles of the mesh touch the box?
 *
 *   mesh               its triangles, fewer than 2^32
 *   box_min, box_max   opposite corners; may be infinite
 *   out_triangles      the first `capacity` of their indices, ascending; may be NULL if capacity is 0
 *
 * Returns     How many touch it, also where that is more than `capacity`.
 * Guarantees  Exact: those for which tribox_overlap is 1.
 * Cost        1.6 ns for a triangle beyond a face of the box, tribox_overlap for the others.
 */
TRIBOX_FN size_t tribox_mesh_query(const tribox_mesh *mesh, const float box_min[3], const float box_max[3],
                                   uint32_t *out_triangles, size_t capacity);
TRIBOX_FN size_t tribox_mesh_query_f64(const tribox_mesh_f64 *mesh, const double box_min[3],
                                       const double box_max[3], uint32_t *out_triangles, size_t capacity);

/* Receives a voxel; non-zero stops the walk. */
typedef int (*tribox_voxel_fn)(void *user, int x, int y, int z);

/* Which voxels does the segment pass, in order?
 *
 *   grid   the region; flags 0: every voxel that it touches. TRIBOX_HALF_OPEN: each of its points in exactly
 *          one voxel. TRIBOX_OPEN: voxels whose interior it meets. TRIBOX_THIN, with whatever else, means
 *          closed here
 *   p, q   its ends; may coincide, may lie anywhere
 *   on_voxel   receives the voxels until it returns non-zero; NULL: only counts
 *   user   handed on to on_voxel
 *
 * Returns     how many were emitted, that at which on_voxel stopped included; saturates at SIZE_MAX. A
 *             non-finite end, or an invalid grid: 0.
 * Guarantees  Exact. Voxels come in the order in which the segment enters them; of those entered at the same
 *             point in the order of z, then y, then x, each ascending where q's coordinate is >= p's, else
 *             descending.
 * Cost        0.3 us, and 6 ns a voxel; a microsecond where two planes are crossed within rounding of each
 *             other. Nothing for what lies outside of the region.
 */
TRIBOX_FN size_t tribox_grid_segment(const tribox_grid *grid, const double p[3], const double q[3],
                                     tribox_voxel_fn on_voxel, void *user);

/* Do two spheres share a point?
 *
 *   a, b                centres
 *   a_radius, b_radius  0 (and -0) is a point; below 0 or NaN, or a centre that is not finite: empty;
 *                       +infinity: all of space
 *
 * Returns     1 = they share a point, 0 = they do not, or one of them is empty. Spheres are closed.
 * Guarantees  Exact: squares are compared.
 * Cost        3 ns; within 2^-46 of touching, a microsecond. tribox_plane_sphere and _sphere_box alike.
 */
TRIBOX_FN int tribox_sphere_sphere(const float a[3], float a_radius, const float b[3], float b_radius);

/* On which side of the plane n.x + d = 0 does the sphere lie?
 *
 * Returns     -1 = it has n.x + d < 0 everywhere, +1 = n.x + d > 0, 0 = it meets the plane. In this order:
 *             NaN, an infinite n or an empty sphere: 2; infinite d, n = 0: the sign of d; an infinite radius:
 *             0.
 * Guarantees  Exact.
 */
TRIBOX_FN int tribox_plane_sphere(const float n[3], float d, const float c[3], float radius);

/* Does the sphere share a point with the box, which may have infinite faces? 1 or 0. Exact. */
TRIBOX_FN int tribox_sphere_box(const float c[3], float radius, const float box_min[3],
                                const float box_max[3]);

/* Does the sphere share a point with the triangle, which may be a segment or a point? 1 or 0. Exact.
 *
 * Cost        20 to 50 ns; within 2^-44 of touching, relative to all extents, 3 us.
 */
TRIBOX_FN int tribox_sphere_triangle(const float c[3], float radius, const float v0[3], const float v1[3],
                                     const float v2[3]);

/* Where is origin + t*dir, t in [t_min, t_max], inside the sphere?
 *
 *   origin, dir, t_min, t_max   as for tribox_ray_box; dir = 0: all of [t_min, t_max], or none
 *   c, radius                   as for tribox_sphere_sphere; +infinity gives [t_min, t_max]
 *   out_t0, out_t1              bounds of the interval of t inside; may be NULL; untouched if it answers 0
 *
 * Returns     1 = some t of the interval is inside. What is no ray, and an empty sphere: 0.
 * Guarantees  The answer is exact. The ends, usually irrational, are rounded outward as tribox_ray_box's.
 * Cost        11 ns; where the ray grazes the sphere, or an end is a float, 10 us.
 */
TRIBOX_FN int tribox_ray_sphere(const float origin[3], const float dir[3], float t_min, float t_max,
                                const float c[3], float radius, float *out_t0, float *out_t1);
#endif /* TRIBOX_NO_COMPANIONS */

/* ---- Where to find what, from here on ---------------------------------------------------------------------
 *
 * The conditions of [SS10] and [AM01]: exact, 5b, tbx_exact_axes; of one box, 6, tbx_filter; of a prepared
 * triangle, 7, tbx_store_edges and tbx_store_plane; of a grid's rows, 8, tbx_walk_groups.
 * The same in vectors, section 11, which is what runs by default: one box, tbx_filter4 (floats) and
 * tbx_filter2; prepared, tbx_store_conditions and tbx_tri_test_simd; fill, boxes of up to 4^3 voxels in
 * "Groups", larger ones in "Rows". Names there end in _simd, _lanes, or the number of lanes.
 * The touching rule: 5b, tbx_lo_is_open and tbx_hi_is_open, and the list of those who ask them.
 * A bound of rounding: in the comment before the macro that names it, TBX_..._ULPS or TBX_..._ERROR. */

/* ---- 3. Platform --------------------------------------------------------------------------------------- */

#if defined(__CUDACC__) || defined(__HIPCC__)
#define TBX_HD __host__ __device__
#else
#define TBX_HD
#endif

/* Compilers that know the attributes, builtins and inline assembly of gcc: gcc, clang (also as clang-cl,
 * which is __clang__ without __GNUC__), icc, nvcc's host side. Others say __GNUC__ and know only some of
 * it. */
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__TINYC__) && !defined(__PCC__) && \
    !defined(__chibicc__)
#define TBX_GNU 1
#else
#define TBX_GNU 0
#endif

#if FLT_MANT_DIG != 24 || DBL_MANT_DIG != 53
#error "tribox.h needs the formats of IEEE 754: a float of 32 bits, a double of 64"
#endif
#if defined(__alpha__) && defined(__GNUC__) && !defined(_IEEE_FP)
#error "tribox.h on Alpha needs -mieee: without it (-ffast-math turns it off) the processor stops at subnormals"
#endif

/* The rare path: kept out of line, so that its stack and code stay out of the callers. Without optimization
 * nothing is inlined anyway, and gcc would compile each of these functions, called or not, as it does with
 * all that are static and not inline: 7 s and 1.4 MB for a file that only includes this one. */
#if defined(__CUDACC__) && !defined(__clang__)
#define TBX_NOINLINE TBX_HD static __noinline__
#define TBX_COLD TBX_NOINLINE
#elif TBX_GNU && !defined(__OPTIMIZE__)
#define TBX_NOINLINE TBX_FN
#define TBX_COLD TBX_NOINLINE
#elif TBX_GNU
#define TBX_NOINLINE TBX_HD static __attribute__((noinline, unused))
#define TBX_COLD TBX_HD static __attribute__((noinline, cold, unused))
#elif defined(_MSC_VER)
#define TBX_NOINLINE __declspec(noinline) TBX_FN /* without inline: C4505 where it is not called */
#define TBX_COLD TBX_NOINLINE
#else
#define TBX_NOINLINE static inline
#define TBX_COLD TBX_NOINLINE
#endif

/* Inlined wherever it is called: a format or a number of voxels is a constant there. */
#if TBX_GNU && !defined(__CUDACC__)
#define TBX_FORCED TBX_FN __attribute__((always_inline))
#elif defined(_MSC_VER) && !defined(__CUDACC__)
#define TBX_FORCED static __forceinline
#else
#define TBX_FORCED TBX_FN
#endif

/* The slow way of a test: rare, and kept to a single branch that the processor can foresee. */
#if TBX_GNU
#define TBX_RARELY(condition) __builtin_expect((condition), 0)
#else
#define TBX_RARELY(condition) (condition)
#endif

/* Asks for memory that will be written soon. The address is an integer: it may lie outside of any array,
 * where pointer arithmetic is undefined. */
#if TBX_GNU && !defined(__CUDA_ARCH__)
#define TBX_PREFETCH(address) __builtin_prefetch((const void *)(address), 1) /* NOLINT(*-no-int-to-ptr) */
#else
#define TBX_PREFETCH(address) ((void)(address))
#endif

/* Copies a few bytes of any alignment; compilers turn it into one move. */
#if TBX_GNU
#define TBX_COPY(dst, src, bytes) ((void)__builtin_memcpy((dst), (src), (bytes)))
#else
#define TBX_COPY(dst, src, bytes) tbx_copy((dst), (src), (bytes))
#endif

/* Vectors of four floats, by the vector extensions of gcc (9 and later) and clang: no header, and the same
 * source on every processor. 0 leaves the scalar body alone. Both give the same answers. */
#if TBX_GNU && (defined(__clang__) || __GNUC__ >= 9) && !defined(__CUDACC__) && !defined(__HIP__) && \
    !defined(__INTEL_COMPILER) && !defined(__NVCOMPILER)
#define TBX_HAS_VECTORS 1
#else
#define TBX_HAS_VECTORS 0
#endif
#ifndef TRIBOX_SIMD
#if TBX_HAS_VECTORS && (defined(__SSE2__) || defined(__aarch64__) || defined(__wasm_simd128__))
#define TRIBOX_SIMD 1
#else
#define TRIBOX_SIMD 0
#endif
#endif
#if TRIBOX_SIMD != 0 && TRIBOX_SIMD != 1
#error "TRIBOX_SIMD must be 0 (scalar) or 1 (vector extensions of gcc and clang)"
#endif
#if TRIBOX_SIMD && !TBX_HAS_VECTORS
#error "TRIBOX_SIMD=1 needs the vector extensions of gcc (9 or later) or clang, and no device code"
#endif

/* Before a short loop of scalar code: unrolled where that is what answers, kept short where section 11 leaves
 * little to it. */
#if TBX_GNU && !defined(__clang__) && !defined(__CUDACC__) && !defined(__EDG__) && __GNUC__ >= 8 && \
    !TRIBOX_SIMD
#define TBX_UNROLL _Pragma("GCC unroll 8")
#else
#define TBX_UNROLL
#endif

/* How to get at the processor's square root, which calls no library: 0 not at all, 1 and 2 by builtins. */
#if !TBX_HAS_VECTORS || !defined(__SSE2_MATH__)
#define TBX_ROOT 0
#elif !defined(__clang__)
#define TBX_ROOT 1
#elif __has_builtin(__builtin_elementwise_sqrt)
#define TBX_ROOT 2
#else
#define TBX_ROOT 1
#endif

/* -fpack-struct packs structs in spite of `#pragma pack`: those of vectors ask for their alignment
 * themselves, and have vectors first. */
#if TBX_GNU
#define TBX_ALIGNED __attribute__((aligned(16)))
#else
#define TBX_ALIGNED
#endif

/* x87 and the 68881 compute in registers whose width the processor's control word sets: 24, 53 or 64 bits,
 * whatever the type. Where that may be so, "double" arithmetic is only known to 24 bits: TBX_U64 below is
 * that of a float, and nothing relies on a double sum or product being exact. */
#if defined(__FLT_EVAL_METHOD__)
#define TBX_EVAL_METHOD __FLT_EVAL_METHOD__
#elif defined(FLT_EVAL_METHOD)
#define TBX_EVAL_METHOD FLT_EVAL_METHOD
#else
#define TBX_EVAL_METHOD (-1)
#endif
#if TBX_EVAL_METHOD == 0 || TBX_EVAL_METHOD == 1 || TBX_EVAL_METHOD == 16
#define TBX_DOUBLE_IS_53_BITS 1
#elif TBX_EVAL_METHOD == 2
#define TBX_DOUBLE_IS_53_BITS 0
#elif defined(__clang__) && !defined(__mc68000__) && (!defined(__i386__) || defined(__SSE2_MATH__))
#define TBX_DOUBLE_IS_53_BITS 1 /* -1: clang's -ffast-math */
#elif !defined(__GNUC__) && \
    (defined(_M_X64) || defined(_M_ARM) || defined(_M_ARM64) || defined(__x86_64__) || defined(__aarch64__))
#define TBX_DOUBLE_IS_53_BITS 1
#elif defined(_M_IX86_FP) && !defined(__GNUC__)
#define TBX_DOUBLE_IS_53_BITS (_M_IX86_FP >= 2)
#else
#define TBX_DOUBLE_IS_53_BITS 0
#endif

/* The door. Compilers reason about floating-point numbers: under -ffast-math they take a parameter for
 * neither NaN nor infinite and fold whatever asks, clang turns tests of a number's bits into comparisons, in
 * which a processor may read subnormals as zero, and -funsafe-math-optimizations (which defines no macro)
 * turns w*(q - v) into w*q - w*v. So after
 *     TBX_KEEP(object)        an object in memory: a number, an array, a struct,
 *     TBX_KEEP_SCALAR(x)      a float or double, in a register where there is a way,
 *     TBX_KEEP_VECTOR(v)      a vector of floats, doubles or integers, likewise,
 *     TBX_KEEP_POINTER(p)     a pointer, and so what is read through it,
 * they know nothing of its value but take it as it stands; what is read from a number's bits by the functions
 * below is unknown to them in the same way. All are volatile: gcc moves other assembly above the test that it
 * stands behind, and the arithmetic with it, whose flags the test was to prevent. */
#if TBX_GNU && !defined(__CUDA_ARCH__) && !defined(__HIP_DEVICE_COMPILE__)
#define TBX_HAS_ASM 1
#define TBX_KEEP(object) __asm__ volatile("" : "+m"(object))
#if defined(__SSE2__)
#define TBX_VECTOR_PLACE "+x"
#elif defined(__aarch64__)
#define TBX_VECTOR_PLACE "+w"
#elif defined(__VSX__)
#define TBX_VECTOR_PLACE "+wa"
#elif defined(__wasm_simd128__)
#define TBX_VECTOR_PLACE "+r"
#else
#define TBX_VECTOR_PLACE "+m"
#endif
#define TBX_KEEP_VECTOR(v) __asm__ volatile("" : TBX_VECTOR_PLACE(v))
#define TBX_KEEP_POINTER(p) __asm__ volatile("" : "+r"(p))
#if defined(__SSE2_MATH__)
#define TBX_KEEP_SCALAR(x) __asm__ volatile("" : "+x"(x))
#elif defined(__aarch64__)
#define TBX_KEEP_SCALAR(x) __asm__ volatile("" : "+w"(x))
#else
#define TBX_KEEP_SCALAR(x) __asm__ volatile("" : "+m"(x))
#endif
#else
#define TBX_HAS_ASM 0
#define TBX_KEEP(object) tbx_keep(&(object), sizeof(object))
#define TBX_KEEP_SCALAR(x) TBX_KEEP(x)
#define TBX_KEEP_POINTER(p) TBX_KEEP(p)
#endif

/* Several of a kind, SCALAR or VECTOR. */
#define TBX_KEEP2(kind, a, b) \
    TBX_KEEP_##kind(a);       \
    TBX_KEEP_##kind(b)
#define TBX_KEEP3(kind, a, b, c) \
    TBX_KEEP_##kind(a);          \
    TBX_KEEP_##kind(b);          \
    TBX_KEEP_##kind(c)
#define TBX_KEEP4(kind, a, b, c, d) \
    TBX_KEEP_##kind(a);             \
    TBX_KEEP_##kind(b);             \
    TBX_KEEP_##kind(c);             \
    TBX_KEEP_##kind(d)

/* What section 11 adds to the scalar code, where TRIBOX_SIMD is 1, and how it is asked: in the place of a
 * value, or first, for an answer that may be UNSURE. */
#if TRIBOX_SIMD
#define TBX_EITHER(by_vectors, scalar) by_vectors
#define TBX_RETURN_IF_SURE(call)                     \
    do {                                             \
        const int by_vectors = call;                 \
        if (!TBX_RARELY(by_vectors == TBX_UNSURE)) { \
            return by_vectors;                       \
        }                                            \
    } while (0)
struct tbx_frame;
struct tbx_solid;
struct tbx_source;
struct tbx_target;
TBX_FN int tbx_filter2(const double v0[3], const double v1[3], const double v2[3], const double box_min[3],
                       const double box_max[3], int rule);
TBX_FN int tbx_filter4(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                       const float box_max[3], int rule);
TBX_FN int tbx_tri_init_simd(tribox_tri *tri, const float v0[3], const float v1[3], const float v2[3],
                             const float size[3], unsigned flags);
TBX_FN int tbx_tri_narrow(float out[4][3], const double v[3][3], const double size[3]);
TBX_FN int tbx_tri_test_simd(const tribox_tri *tri, const float p[3]);
TBX_NOINLINE uint64_t tbx_lone_find(int first[4], const tribox_grid *grid, const float v0[3],
                                    const float v1[3], const float v2[3]);
TBX_NOINLINE uint64_t tbx_lone_find_f64(int first[4], const tribox_grid *grid, const double v0[3],
                                        const double v1[3], const double v2[3]);
TBX_FN size_t tbx_mesh_spans_quick(const struct tbx_frame *f, const struct tbx_source *source,
                                   tribox_mesh_span_fn on_span, void *user, size_t *count);
TBX_FN size_t tbx_fill_quick(const struct tbx_frame *frame, const struct tbx_source *source,
                             const struct tbx_target *target);
TBX_FN size_t tbx_solid_quick_fill(const struct tbx_solid *s, const struct tbx_source *source);
#ifndef TRIBOX_NO_COMPANIONS
TBX_FN unsigned tbx_octant_values_simd(const tribox_tri *tri, const float lower[3], const float upper[3],
                                       unsigned asked, unsigned *out_unsure);
TBX_FN unsigned tbx_octants_simd(const tribox_tri *tri, const float p[3]);
TBX_FN int tbx_box_box4(const float a_min[3], const float a_max[3], const float b_min[3],
                        const float b_max[3]);
TBX_FN int tbx_ray_filter(const float origin[3], const float dir[3], const float t[2], const float box_min[3],
                          const float box_max[3], float *out_t0, float *out_t1);
TBX_FN int tbx_segment_filter(const float p[3], const float q[3], const float box_min[3],
                              const float box_max[3]);
TBX_FN int tbx_odd4(const float a[3], const float b[3], const float c[3], const float d[3]);
TBX_FN int tbx_sphere_sphere4(const float a[3], const float *a_radius, const float b[3],
                              const float *b_radius);
TBX_FN int tbx_plane_sphere4(const float n[3], const float *d, const float c[3], const float *radius);
TBX_FN int tbx_sphere_box4(const float c[3], const float *radius, const float box_min[3],
                           const float box_max[3]);
TBX_FN int tbx_pierce4(const float origin[3], const float dir[3], const float *from, const float center[3],
                       const float *radius);
TBX_FN unsigned tbx_gap_quick(const float *const v[5], const float box_min[3], const float box_max[3],
                              double *out_s, float out_axis[3]);
#endif
#else
#define TBX_EITHER(by_vectors, scalar) scalar
#define TBX_RETURN_IF_SURE(call) ((void)0)
#endif

/* ---- 4. Bits of floating-point numbers ------------------------------------------------------------------
 *
 * Whatever decides is read from the bits, so that no compiler flag (-ffast-math folds x != x) and no
 * processor mode (flush-to-zero reads subnormals as zero) can change it. A number that may be NaN or infinite
 * is passed by address, never by value. */

#if !TBX_GNU
TBX_FN void tbx_copy(void *dst, const void *src, size_t bytes)
{
    size_t i;
#if defined(_MSC_VER) && !defined(__clang__) && !defined(__GNUC__)
    if (bytes == sizeof(uint32_t)) {
        *(__unaligned uint32_t *)dst = *(const __unaligned uint32_t *)src;
        return;
    }
    if (bytes == sizeof(uint64_t)) {
        *(__unaligned uint64_t *)dst = *(const __unaligned uint64_t *)src;
        return;
    }
#endif
    for (i = 0; i < bytes; i++) {
        ((unsigned char *)dst)[i] = ((const unsigned char *)src)[i];
    }
}
#endif

#if TBX_HAS_ASM
TBX_FN uint32_t tbx_opaque32(uint32_t x)
{
    __asm__("" : "+r"(x));
    return x;
}

TBX_FN uint64_t tbx_opaque64(uint64_t x)
{
#if UINTPTR_MAX > 0xffffffffu || defined(__wasm__)
    __asm__("" : "+r"(x));
#else
    __asm__("" : "+m"(x)); /* takes two registers there */
#endif
    return x;
}
#else
/* A volatile object may hold anything. */
TBX_FN uint32_t tbx_opaque32(uint32_t x)
{
    volatile uint32_t seen = x;
    return seen;
}

TBX_FN uint64_t tbx_opaque64(uint64_t x)
{
    volatile uint64_t seen = x;
    return seen;
}

/* Where there is no assembly: every byte is read and written as volatile. Objects of whole words that are
 * read by words in compilers that do not reason about types. */
TBX_FN void tbx_keep(void *object, size_t bytes)
{
    size_t i;
#if defined(_MSC_VER) && !defined(__clang__) && !defined(__GNUC__)
    if (bytes % sizeof(uint64_t) == 0) {
        volatile uint64_t *word = (volatile uint64_t *)object;
        for (i = 0; i < bytes / sizeof(uint64_t); i++) {
            word[i] = word[i];
        }
        return;
    }
#endif
    {
        volatile unsigned char *byte = (volatile unsigned char *)object;
        for (i = 0; i < bytes; i++) {
            byte[i] = byte[i];
        }
    }
}
#endif

TBX_FN uint32_t tbx_bits32(const float *x)
{
    uint32_t bits;
    TBX_COPY(&bits, x, sizeof bits);
    return tbx_opaque32(bits);
}

TBX_FN uint64_t tbx_bits64(const double *x)
{
    uint64_t bits;
    TBX_COPY(&bits, x, sizeof bits);
    return tbx_opaque64(bits);
}

/* The number with these bits, a finite one. */
TBX_FN double tbx_from_bits64(uint64_t bits)
{
    double x;
    TBX_COPY(&x, &bits, sizeof x);
    return x;
}

/* The integer part of a number in range. clang converts what is converted back later in vectors, whose other
 * lanes hold anything: they would raise invalid. */
TBX_FN int32_t tbx_to_int(double x)
{
    return (int32_t)tbx_opaque32((uint32_t)(int32_t)x);
}

TBX_FN int64_t tbx_to_long(double x)
{
    return (int64_t)tbx_opaque64((uint64_t)(int64_t)x);
}

/* a > b, and a <= b, of finite numbers, where two such answers are joined: clang would compare both in one
 * vector, and what the lanes hold that nobody reads may be NaN, which raises "invalid". */
TBX_FN int tbx_more(double a, double b)
{
    return (int)tbx_opaque32((uint32_t)(a > b));
}

TBX_FN int tbx_no_more(double a, double b)
{
    return (int)tbx_opaque32((uint32_t)(a <= b));
}

/* 2^e as a double, -1022 <= e <= 1023: -fsingle-precision-constant takes written ones for floats. */
#define TBX_POW2(e) tbx_from_bits64((uint64_t)(1023 + (e)) << 52)

/* A float subnormal is mantissa * 2^-149, a normal double. NaN stays a quiet NaN, infinity infinity. */
TBX_COLD void tbx_widen_unusual(double *out, uint32_t bits)
{
    const uint32_t mantissa = bits & 0x007fffffu;
    const double subnormal = (double)(int32_t)mantissa * TBX_POW2(-149);
    uint64_t wide = mantissa != 0 ? 0x7ff8000000000000u : 0x7ff0000000000000u;
    if ((bits & 0x7f800000u) == 0) {
        TBX_COPY(&wide, &subnormal, sizeof wide);
    }
    wide |= (uint64_t)(bits & 0x80000000u) << 32;
    TBX_COPY(out, &wide, sizeof wide);
}

/* A float's bits: is it neither 0 nor normal? */
TBX_FN int tbx_is_unusual(uint32_t bits)
{
    const uint32_t magnitude = bits & 0x7fffffffu;
    return (magnitude - 1u < 0x007fffffu) | (magnitude >= 0x7f800000u);
}

/* The float's value as a double, also where the processor would read a subnormal as zero. */
TBX_FN void tbx_widen(double *out, const float *x)
{
    const uint32_t bits = tbx_bits32(x);
    if (TBX_RARELY(tbx_is_unusual(bits))) {
        tbx_widen_unusual(out, bits);
    } else {
        TBX_KEEP_POINTER(x); /* not converted before it is known to be usual */
        *out = (double)*x;
    }
}

TBX_FN void tbx_widen3(double out[3], const float x[3])
{
    tbx_widen(out, x);
    tbx_widen(out + 1, x + 1);
    tbx_widen(out + 2, x + 2);
}

TBX_FN int tbx_is_nan(const double *x)
{
    return (tbx_bits64(x) & 0x7fffffffffffffffu) > 0x7ff0000000000000u;
}

TBX_FN int tbx_is_finite(const double *x)
{
    return (tbx_bits64(x) & 0x7fffffffffffffffu) < 0x7ff0000000000000u;
}

TBX_FN int tbx_finite3(const double x[3])
{
    return tbx_is_finite(&x[0]) & tbx_is_finite(&x[1]) & tbx_is_finite(&x[2]);
}

TBX_COLD int tbx_read_unusual(double out[3], const void *from)
{
    float x[3];
    int finite = 1;
    int k;
    TBX_COPY(x, from, sizeof x);
    for (k = 0; k < 3; k++) {
        tbx_widen(&out[k], &x[k]);
        finite &= tbx_is_finite(&out[k]);
    }
    return finite;
}

/* Two floats' bits in one word: is one of them neither 0 nor normal? Bits 31 and 63 say so, without a carry
 * from one to the other: the first sum of infinity and NaN has them, the second of all but 0, the third of
 * normal numbers, which the second has too. */
#define TBX_PAIR_SIGNS 0x8000000080000000u
TBX_FN uint64_t tbx_unusual_pair(uint64_t pair)
{
    const uint64_t magnitudes = pair & 0x7fffffff7fffffffu;
    return (magnitudes + 0x0080000000800000u) |
           ((magnitudes + 0x7fffffff7fffffffu) ^ (magnitudes + 0x7f8000007f800000u));
}

/* The same of two floats that lie side by side, and of two points. */
TBX_FN uint64_t tbx_unusual2(const float x[2])
{
    uint64_t pair;
    TBX_COPY(&pair, x, sizeof pair);
    return tbx_unusual_pair(tbx_opaque64(pair));
}

TBX_FN uint64_t tbx_unusual6(const float a[3], const float b[3])
{
    return tbx_unusual2(a) | tbx_unusual2(b) |
           tbx_unusual_pair((uint64_t)tbx_bits32(&a[2]) << 32 | tbx_bits32(&b[2]));
}

/* Three floats that were looked at, as doubles; not before: signalling NaN would raise a flag. */
TBX_FORCED void tbx_take3_float(double out[3], const void *x)
{
    const char *there = (const char *)x; /* of any alignment: a mesh has any stride */
    float a;
    float b;
    float c;
    TBX_KEEP_POINTER(there);
    TBX_COPY(&a, there, sizeof a);
    TBX_COPY(&b, there + sizeof a, sizeof b);
    TBX_COPY(&c, there + 2 * sizeof a, sizeof c);
    out[0] = (double)a;
    out[1] = (double)b;
    out[2] = (double)c;
#if TBX_HAS_ASM
    TBX_KEEP3(SCALAR, out[0], out[1], out[2]); /* else minima compare the floats, and branch on that */
#endif
}

/* Three floats as doubles. Returns 0 where one is NaN or infinite. */
TBX_FN int tbx_read_floats(double out[3], const void *from)
{
    const float *x = (const float *)from;
    if (TBX_RARELY(((tbx_unusual2(x) & TBX_PAIR_SIGNS) != 0) | tbx_is_unusual(tbx_bits32(&x[2])))) {
        return tbx_read_unusual(out, from);
    }
    tbx_take3_float(out, from);
    return 1;
}

/* Is x zero, or is its magnitude at least 2^least and less than 2^most? */
TBX_FN int tbx_in_range(const double *x, int least, int most)
{
    const uint64_t magnitude = tbx_bits64(x) & 0x7fffffffffffffffu;
    const unsigned above = (unsigned)(magnitude >> 52) - (unsigned)(1023 + least);
    return magnitude == 0 || above < (unsigned)(most - least);
}

/* An integer that orders as the number does (NaN aside); both zeros give 0. */
TBX_FN int64_t tbx_key_of_bits(uint64_t bits)
{
    const uint64_t sign = bits >> 63; /* no branch: a coin toss */
    return (int64_t)(((bits & 0x7fffffffffffffffu) ^ (0u - sign)) + sign);
}

TBX_FN uint64_t tbx_magnitude64(int64_t key)
{
    return key < 0 ? (uint64_t)0 - (uint64_t)key : (uint64_t)key;
}

/* The finite number with this key. */
TBX_FN double tbx_from_key64(int64_t key)
{
    return tbx_from_bits64(tbx_magnitude64(key) | (uint64_t)(key < 0) << 63);
}

TBX_FN int64_t tbx_key64(const double *x)
{
    return tbx_key_of_bits(tbx_bits64(x));
}

TBX_FN int tbx_less(const double *a, const double *b)
{
    return tbx_key64(a) < tbx_key64(b);
}

TBX_FN int tbx_sign(const double *x)
{
    const int64_t key = tbx_key64(x);
    return (key > 0) - (key < 0);
}

/* The lesser and the greater of two finite numbers. */
TBX_FN double tbx_min(double a, double b)
{
    return tbx_less(&b, &a) ? b : a;
}

TBX_FN double tbx_max(double a, double b)
{
    return tbx_less(&a, &b) ? b : a;
}

/* The number of the lowest bit that is 1; x is not 0. */
TBX_FN int tbx_lowest_bit(uint64_t x)
{
#if TBX_HAS_ASM
    return __builtin_ctzll(x);
#else
    int i = 0;
    for (; (x & 1u) == 0; x >>= 1) {
        i++;
    }
    return i;
#endif
}

/* ---- 5. Exact integers ------------------------------------------------------------------------------------
 *
 * Integers of n limbs, the lowest first, in two's complement, for the signs asked below. Section 10 has
 * numbers of any length for all that companions compute. */

/* WebAssembly multiplies 128 bits by a function of a library, which there need not be. */
#if TBX_GNU && defined(__SIZEOF_INT128__) && !defined(__CUDACC__) && !defined(__HIP__) && !defined(__wasm__)
typedef uint64_t tbx_limb;
typedef int64_t tbx_signed_limb;
__extension__ typedef unsigned __int128 tbx_two_limbs;
__extension__ typedef __int128 tbx_two_signed;
#define TBX_LIMB_BITS 64
#else
typedef uint32_t tbx_limb;
typedef int32_t tbx_signed_limb;
typedef uint64_t tbx_two_limbs;
typedef int64_t tbx_two_signed;
#define TBX_LIMB_BITS 32
#endif

/* to = x + y, or x - y where flip has all bits set, not 0: -y is ~y + 1. */
TBX_NOINLINE void tbx_limbs_add(tbx_limb *to, const tbx_limb *x, const tbx_limb *y, int n, tbx_limb flip)
{
    tbx_two_limbs carry = flip & 1u;
    int i;
    for (i = 0; i < n; i++) {
        carry += (tbx_two_limbs)x[i] + (y[i] ^ flip);
        to[i] = (tbx_limb)carry;
        carry >>= TBX_LIMB_BITS;
    }
}

/* to = x * y, of n and m limbs without signs, m > 0 */
TBX_FN void tbx_limbs_mul(tbx_limb *to, const tbx_limb *x, int n, const tbx_limb *y, int m)
{
    int i;
    int j;
    for (i = 0; i < m; i++) {
        to[i] = 0;
    }
    for (i = 0; i < n; i++) {
        tbx_two_limbs carry = 0;
        for (j = 0; j < m; j++) {
            carry += (tbx_two_limbs)x[i] * y[j] + to[i + j];
            to[i + j] = (tbx_limb)carry;
            carry >>= TBX_LIMB_BITS;
        }
        to[i + m] = (tbx_limb)carry;
    }
}

/* All bits set where x is below 0, else 0. */
TBX_FN tbx_limb tbx_limbs_flip(const tbx_limb *x, int n)
{
    return (tbx_limb)0 - (x[n - 1] >> (TBX_LIMB_BITS - 1));
}

/* to = x * y: without signs a number below 0 is too large by 2^(its bits), and the product by that times the
 * other one. */
TBX_FN void tbx_limbs_product(tbx_limb *to, const tbx_limb *x, int n, const tbx_limb *y, int m)
{
    tbx_limbs_mul(to, x, n, y, m);
    if (tbx_limbs_flip(x, n) != 0) {
        tbx_limbs_add(to + n, to + n, y, m, ~(tbx_limb)0);
    }
    if (tbx_limbs_flip(y, m) != 0) {
        tbx_limbs_add(to + m, to + m, x, n, ~(tbx_limb)0);
    }
}

TBX_FN int tbx_limbs_sign(const tbx_limb *x, int n)
{
    tbx_limb some = 0;
    int i;
    for (i = 0; i < n; i++) {
        some |= x[i];
    }
    return tbx_limbs_flip(x, n) != 0 ? -1 : some != 0;
}

/* to += value * 2^shift */
TBX_FN void tbx_limbs_place(tbx_limb *to, int n, int64_t value, int shift)
{
    const tbx_limb flip = (tbx_limb)0 - (tbx_limb)(value < 0);
    uint64_t rest = tbx_magnitude64(value);
    tbx_two_limbs carry = flip & 1u;
    tbx_two_limbs part = 0;
    int i;
    for (i = shift / TBX_LIMB_BITS; i < n; i++) {
        part += (tbx_two_limbs)(tbx_limb)rest << (shift % TBX_LIMB_BITS);
        carry += (tbx_two_limbs)to[i] + ((tbx_limb)part ^ flip);
        to[i] = (tbx_limb)carry;
        carry >>= TBX_LIMB_BITS;
        part >>= TBX_LIMB_BITS;
        rest = TBX_LIMB_BITS < 64 ? rest >> (TBX_LIMB_BITS & 63) : 0;
    }
}

/* ---- Coordinates
 *
 * A coordinate is base + half*(step/2): a corner (half = 0), a face p + size (half = 2), a grid face
 * origin + i*size (half = 2i), or the centre of a voxel (half = 2i + 1). All coordinates of one question are
 * multiples of one power of two 2^e, so every sign asked below is the sign of an integer.
 *
 * Width: where all are below 2^t, differences are below 2^(t+1), differences of their products below
 * 2^(2t+3), and the sum of three products of those with a difference below 2^(3t+6). In units of 2^e, with a
 * sign, n = t - e + ROOM bits, 2n, and 3n hold them. A finite double is a multiple of 2^-1074, its half of
 * 2^-1075, and below 2^1024; |half| <= 2^32, which has 33 bits. So t is at most 1025, as infinity is read as
 * 2^1024, and with steps 1 + (1025 - 1 + 33) = 1058. */
#define TBX_COORD_ROOM 3
#define TBX_COORD_LIMBS ((1058 + 1075 + TBX_COORD_ROOM + TBX_LIMB_BITS - 1) / TBX_LIMB_BITS)

typedef struct tbx_coord {
    int64_t part[3]; /* the sum of part * 2^exponent: base, and half*(step/2) in two */
    int64_t key;     /* of the base */
    int exponent[3];
    int top; /* the magnitude is below 2^top */
} tbx_coord;

#define TBX_NO_EXPONENT 4096 /* above every exponent: of zero */

/* The double with these bits is mantissa * 2^exponent with an odd mantissa. Returns the exponent, NO_EXPONENT
 * for 0. */
TBX_FN int tbx_split(uint64_t bits, int64_t *out_mantissa)
{
    uint64_t mantissa = bits & 0x000fffffffffffffu;
    int exponent = (int)((bits >> 52) & 0x7ffu);
    if (exponent != 0) {
        mantissa |= 0x0010000000000000u;
    } else {
        exponent = 1;
    }
    if (mantissa == 0) {
        *out_mantissa = 0;
        return TBX_NO_EXPONENT;
    }
    exponent -= 1075;
    exponent += tbx_lowest_bit(mantissa);
    mantissa >>= tbx_lowest_bit(mantissa);
    *out_mantissa = (bits >> 63) != 0 ? -(int64_t)mantissa : (int64_t)mantissa;
    return exponent;
}

/* Numbers with these bits are below 2^(what this returns). */
TBX_FN int tbx_top(uint64_t bits)
{
    const int exponent = (int)((bits >> 52) & 0x7ffu);
    return (exponent != 0 ? exponent : 1) - 1022;
}

/* The coordinate base + half*(step/2); an infinite number is read as 2^1024. */
TBX_NOINLINE tbx_coord tbx_at(const double *base, const double *step, int64_t half)
{
    const uint64_t bits = tbx_bits64(base);
    tbx_coord x;
    x.exponent[0] = tbx_split(bits, &x.part[0]);
    x.exponent[1] = TBX_NO_EXPONENT;
    x.exponent[2] = TBX_NO_EXPONENT;
    x.part[1] = 0;
    x.part[2] = 0;
    x.key = tbx_key_of_bits(bits);
    x.top = tbx_top(bits);
    if (half != 0) {
        const uint64_t step_bits = tbx_bits64(step);
        const int64_t unit = (int64_t)1 << 27; /* below 2^53 = 2^27 * 2^26: products below 2^60 */
        int64_t mantissa;
        int top = tbx_top(step_bits) - 1;
        uint64_t rest;
        x.exponent[1] = tbx_split(step_bits, &mantissa) - 1;
        x.exponent[2] = x.exponent[1] + 27;
        x.part[1] = mantissa % unit * half;
        x.part[2] = mantissa / unit * half;
        for (rest = tbx_magnitude64(half); rest != 0; rest >>= 1) {
            top++;
        }
        x.top = 1 + (top > x.top ? top : x.top);
    }
    return x;
}

/* Points of one question: the corners, and the box's faces and centre planes per axis. */
enum { TBX_LO = 3, TBX_MID = 4, TBX_HI = 5, TBX_ROWS = 6 };

typedef struct tbx_exact {
    tbx_coord x[TBX_ROWS][3]; /* rows 0..2: corners; LO, MID, HI */
    int thin;
    unsigned open[2]; /* bit k: the lower, the upper face across axis k is not in the box */
    int limbs;
    tbx_limb d[TBX_ROWS][3][TBX_COORD_LIMBS]; /* x / 2^e, of so many limbs */
} tbx_exact;

/* The coordinates x as integers, in the greatest unit that they have in common. Returns their limbs. */
TBX_NOINLINE int tbx_coords_place(tbx_limb (*to)[TBX_COORD_LIMBS], const tbx_coord *x, int count)
{
    int e = TBX_NO_EXPONENT;
    int top = -TBX_NO_EXPONENT;
    int n = 1;
    int i;
    int j;
    for (i = 0; i < count; i++) {
        e = x[i].exponent[0] < e ? x[i].exponent[0] : e;
        e = x[i].exponent[1] < e ? x[i].exponent[1] : e;
        top = x[i].top > top ? x[i].top : top;
    }
    if (e < top) { /* else all are 0 */
        n = (top - e + TBX_COORD_ROOM + TBX_LIMB_BITS - 1) / TBX_LIMB_BITS;
    }
    for (i = 0; i < count; i++) {
        for (j = 0; j < n; j++) {
            to[i][j] = 0;
        }
        for (j = 0; j < (x[i].exponent[1] == TBX_NO_EXPONENT ? 1 : 3); j++) {
            const int shift = x[i].exponent[j] - e;
            if (n == 1 && shift < TBX_LIMB_BITS) { /* for speed */
                to[i][0] += (tbx_limb)(uint64_t)x[i].part[j] << shift;
            } else {
                tbx_limbs_place(to[i], n, x[i].part[j], shift);
            }
        }
    }
    return n;
}

TBX_FN void tbx_exact_finish(tbx_exact *f)
{
    f->limbs = tbx_coords_place(f->d[0], f->x[0], 3 * TBX_ROWS);
}

/* The sign of a - b. */
TBX_COLD int tbx_compare(const tbx_coord *a, const tbx_coord *b)
{
    tbx_coord x[2];
    tbx_limb d[2][TBX_COORD_LIMBS];
    int n;
    x[0] = *a;
    x[1] = *b;
    n = tbx_coords_place(d, x, 2);
    tbx_limbs_add(d[0], d[0], d[1], n, ~(tbx_limb)0);
    return tbx_limbs_sign(d[0], n);
}

/* out = (b - a) x (q - a) in the plane of axes x, y, twice f->limbs long; a, b are corners, q is (x of row
 * qx, y of row qy). Of one limb: differences below 2^62, so that nothing overflows. What is behind
 * the result, CROSS_LIMBS in all, is for what is computed on the way. */
#define TBX_CROSS_LIMBS (6 * TBX_COORD_LIMBS)

TBX_NOINLINE void tbx_cross(const tbx_exact *f, tbx_limb *out, int x, int y, int a, int b, int qx, int qy)
{
    const int n = f->limbs;
    tbx_limb *const u = out + 2 * TBX_COORD_LIMBS;
    tbx_limb *const v = out + 3 * TBX_COORD_LIMBS;
    tbx_limb *const second = out + 4 * TBX_COORD_LIMBS;
    if (n == 1) {
        const tbx_signed_limb from_x = (tbx_signed_limb)f->d[a][x][0];
        const tbx_signed_limb from_y = (tbx_signed_limb)f->d[a][y][0];
        const tbx_two_signed r = (tbx_two_signed)((tbx_signed_limb)f->d[b][x][0] - from_x) *
                                     ((tbx_signed_limb)f->d[qy][y][0] - from_y) -
                                 (tbx_two_signed)((tbx_signed_limb)f->d[b][y][0] - from_y) *
                                     ((tbx_signed_limb)f->d[qx][x][0] - from_x);
        out[0] = (tbx_limb)r;
        out[1] = (tbx_limb)((tbx_two_limbs)r >> TBX_LIMB_BITS);
        return;
    }
    tbx_limbs_add(u, f->d[b][x], f->d[a][x], n, ~(tbx_limb)0);
    tbx_limbs_add(v, f->d[qy][y], f->d[a][y], n, ~(tbx_limb)0);
    tbx_limbs_product(out, u, n, v, n);
    tbx_limbs_add(u, f->d[b][y], f->d[a][y], n, ~(tbx_limb)0);
    tbx_limbs_add(v, f->d[qx][x], f->d[a][x], n, ~(tbx_limb)0);
    tbx_limbs_product(second, u, n, v, n);
    tbx_limbs_add(out, out, second, 2 * n, ~(tbx_limb)0);
}

/* The sign of (b - a) x (q - a). */
TBX_COLD int tbx_orient2(const tbx_exact *f, int x, int y, int a, int b, int qx, int qy)
{
    tbx_limb r[TBX_CROSS_LIMBS];
    tbx_cross(f, r, x, y, a, b, qx, qy);
    return tbx_limbs_sign(r, 2 * f->limbs);
}

/* The sign of n.(q - v0), q_k being row q[k] of axis k. */
TBX_COLD int tbx_orient3(const tbx_exact *f, const int q[3])
{
    const int n = f->limbs;
    tbx_limb sum[3 * TBX_COORD_LIMBS];
    int a;
    for (a = 0; a < 3 * n; a++) {
        sum[a] = 0;
    }
    for (a = 0; a < 3; a++) {
        tbx_limb normal[TBX_CROSS_LIMBS];
        tbx_limb *const d = normal + 2 * TBX_COORD_LIMBS;
        tbx_limb *const product = normal + 3 * TBX_COORD_LIMBS;
        tbx_cross(f, normal, (a + 1) % 3, (a + 2) % 3, 0, 1, 2, 2);
        tbx_limbs_add(d, f->d[q[a]][a], f->d[0][a], n, ~(tbx_limb)0);
        tbx_limbs_product(product, normal, 2 * n, d, n);
        tbx_limbs_add(sum, sum, product, 3 * n, 0);
    }
    return tbx_limbs_sign(sum, 3 * n);
}

/* ---- 5b. The exact test -------------------------------------------------------------------------------- */

/* The touching rule: which faces of a box are open, all lower ones, all upper ones. THIN means closed. A rule
 * moves exact zeros only, so no bound of floating-point arithmetic sees it. Who asks these two: of one box
 * tbx_exact_overlap, tbx_clip_box and tbx_clip_axis; of prepared boxes tbx_tri_start, tbx_tri_faces,
 * tbx_octant_faces and, in lanes, tbx_tri_init_simd; of a grid tbx_frame_init and, in lanes,
 * tbx_quick_init; of a sweep tbx_sweep_box_valid; tribox_grid_segment.
 * All of these hold one answer for all three axes; a rule that differs by axis needs a mask in its place.
 * A new flag must pass tbx_rule, too, or one box and grids would take it differently. */
TBX_FN int tbx_lo_is_open(unsigned flags)
{
    return (flags & (TRIBOX_THIN | TRIBOX_OPEN)) == TRIBOX_OPEN;
}

TBX_FN int tbx_hi_is_open(unsigned flags)
{
    return (flags & TRIBOX_THIN) == 0 && (flags & (TRIBOX_OPEN | TRIBOX_HALF_OPEN)) != 0;
}

/* The flags that a one-box question has. */
TBX_FN unsigned tbx_rule(unsigned flags)
{
    return (flags & TRIBOX_THIN) != 0 ? 0u : flags & (TRIBOX_HALF_OPEN | TRIBOX_OPEN);
}

/* The sign of component k of edge v[i+1] - v[i]. */
TBX_FN int tbx_edge_sign(const tbx_exact *f, int i, int k)
{
    const int64_t from = f->x[i][k].key;
    const int64_t to = f->x[(i + 1) % 3][k].key;
    return (to > from) - (to < from);
}

/* The row of the face farthest along a normal component of this sign. */
TBX_FN int tbx_far_row(int sign)
{
    return sign > 0 ? TBX_HI : TBX_LO;
}

/* Does the face that a critical point uses on axis k belong to the box? A zero coefficient uses none. */
TBX_FN int tbx_uses_open(const tbx_exact *f, int k, int sign)
{
    return sign != 0 && ((f->open[sign > 0] >> k) & 1u) != 0;
}

/* Edge i in the plane across axis a, [SS10] with the sign of n_a given: max over the box of w.(q - v_i) >= 0.
 * 6-separating: max |w_k| h_k in place of the sum, so the critical point is the farthest of the voxel's face
 * centres. */
TBX_FN int tbx_exact_edge(const tbx_exact *f, int a, int i, int n_sign)
{
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    const int j = (i + 1) % 3;
    const int w_sign = n_sign >= 0 ? 1 : -1;
    const int w_b = -w_sign * tbx_edge_sign(f, i, c);
    const int w_c = w_sign * tbx_edge_sign(f, i, b);
    int value;
    if (f->thin) {
        return w_sign * tbx_orient2(f, b, c, i, j, tbx_far_row(w_b), TBX_MID) >= 0 ||
               w_sign * tbx_orient2(f, b, c, i, j, TBX_MID, tbx_far_row(w_c)) >= 0;
    }
    value = w_sign * tbx_orient2(f, b, c, i, j, tbx_far_row(w_b), tbx_far_row(w_c));
    return value > 0 || (value == 0 && !tbx_uses_open(f, b, w_b) && !tbx_uses_open(f, c, w_c));
}

/* The plane, one side: side * n.(q - v0) >= 0 at the critical point along side * n, likewise. */
TBX_FN int tbx_exact_plane(const tbx_exact *f, const int n_sign[3], int side)
{
    int q[3];
    int k;
    int value;
    int is_open = 0;
    for (k = 0; k < 3; k++) {
        q[k] = tbx_far_row(side * n_sign[k]);
        is_open |= tbx_uses_open(f, k, side * n_sign[k]);
    }
    for (k = 0; k < 3 && f->thin; k++) {
        int centre[3] = { TBX_MID, TBX_MID, TBX_MID };
        centre[k] = q[k];
        if (side * tbx_orient3(f, centre) >= 0) {
            return 1;
        }
    }
    value = f->thin ? -1 : side * tbx_orient3(f, q);
    return value > 0 || (value == 0 && !is_open);
}

TBX_FN void tbx_exact_normal(const tbx_exact *f, int n_sign[3])
{
    int a;
    for (a = 0; a < 3; a++) {
        n_sign[a] = tbx_orient2(f, (a + 1) % 3, (a + 2) % 3, 0, 1, 2, 2);
    }
}

/* Plane and edges; the faces are known to hold. Bits 0..2 of `asked`: the edges in the plane across that
 * axis, bit 3: the triangle's plane. */
#define TBX_ALL_AXES 15u

TBX_FN int tbx_exact_axes(const tbx_exact *f, unsigned asked)
{
    int n_sign[3];
    int a;
    int i;
    tbx_exact_normal(f, n_sign);
    for (a = 0; a < 3; a++) {
        for (i = 0; i < 3 && ((asked >> a) & 1u) != 0; i++) {
            if (!tbx_exact_edge(f, a, i, n_sign[a])) {
                return 0;
            }
        }
    }
    for (i = 1; i >= -1 && (asked & 8u) != 0; i -= 2) {
        if (!tbx_exact_plane(f, n_sign, i)) {
            return 0;
        }
    }
    return 1;
}

/* The least (side = -1) or greatest (1) corner on axis k. */
TBX_FN tbx_coord tbx_exact_extreme(const tbx_exact *f, int k, int side)
{
    int best = 0;
    int i;
    for (i = 1; i < 3; i++) {
        const int64_t key = f->x[i][k].key;
        best = (side < 0 ? key < f->x[best][k].key : key > f->x[best][k].key) ? i : best;
    }
    return f->x[best][k];
}

/* The exact answer for the triangle f->x[0..2] and the box rows LO..HI (MID for thin), whose faces are known
 * to hold, every sign exact. Conservative: the box is clipped to the triangle's bounding box first, so
 * rows may be infinite (read as +-2^1024, beyond every corner). A face is replaced, and then closed, only
 * where it lies strictly outside. */
TBX_COLD int tbx_exact_overlap(tbx_exact *f, unsigned flags)
{
    const int lo_is_open = tbx_lo_is_open(flags);
    const int hi_is_open = tbx_hi_is_open(flags);
    int k;
    f->thin = (flags & TRIBOX_THIN) != 0;
    for (k = 0; k < 3 && !f->thin; k++) {
        const tbx_coord t_min = tbx_exact_extreme(f, k, -1);
        const tbx_coord t_max = tbx_exact_extreme(f, k, 1);
        tbx_coord *lo = &f->x[TBX_LO][k];
        tbx_coord *hi = &f->x[TBX_HI][k];
        if (tbx_compare(lo, &t_min) < 0) {
            *lo = t_min;
        } else if (lo_is_open) {
            f->open[0] |= 1u << k;
        }
        if (tbx_compare(hi, &t_max) > 0) {
            *hi = t_max;
        } else if (hi_is_open) {
            f->open[1] |= 1u << k;
        }
        f->x[TBX_MID][k] = f->x[0][k]; /* unused: what it was may span more bits */
    }
    tbx_exact_finish(f);
    return tbx_exact_axes(f, TBX_ALL_AXES);
}

/* The corners and two opposite corners of the box, which is closed; its centre is v0 until it is set. */
TBX_NOINLINE void tbx_exact_points(tbx_exact *f, const double v0[3], const double v1[3], const double v2[3],
                                   const double lo[3], const double hi[3])
{
    const double *const x[TBX_ROWS] = { v0, v1, v2, lo, v0, hi };
    int i;
    int k;
    f->thin = 0;
    f->open[0] = f->open[1] = 0;
    for (i = 0; i < TBX_ROWS; i++) {
        for (k = 0; k < 3; k++) {
            f->x[i][k] = i == TBX_MID ? f->x[0][k] : tbx_at(&x[i][k], NULL, 0);
        }
    }
}

/* The corners; the box's rows are v0 until they are set. */
TBX_FN void tbx_exact_corners(tbx_exact *f, const double v0[3], const double v1[3], const double v2[3])
{
    tbx_exact_points(f, v0, v1, v2, v0, v0);
}

/* ---- 6. One box -------------------------------------------------------------------------------------------
 *
 * The filter. T meets B iff T meets B clipped to T's bounding box, so every difference of two coordinates of
 * axis k is at most X_k, the triangle's extent. Twice the clipped box's centre and half size keep halves out:
 * with a_1, a_2 the corners from v_0, h the box's size and m = 2 (lo - v_0) + h,
 *
 *   n = a_1 x a_2,  c_0 = a_1 x m,  c_2 = m x a_2,  c_1 = 2n - c_0 - c_2.
 *
 * Component a of c_i is twice the value of edge i's line of plane a at the centre. Across edge i the triangle
 * covers [0, 2n], the box c_i -+ r_i, r_i = |e_b| h_c + |e_c| h_b.
 *   They meet iff      r_i + |n| - |s_i| >= 0, s_i = n - c_i       (two-sided, so no sign of n is needed)
 *   and the plane iff  |n|.h - |n.m| >= 0.
 * s_1 = c_0 - s_2, so c_1 is never computed.
 *
 * Bound. u bounds the relative error of +, -, x and FMA in every rounding mode: 2^-23 for float, 2^-52 for
 * double. Errors in units of u X_k: a_1, a_2, lo - v_0, h: 1; m: 2 + 1 + 2 = 5; e_1: 3. A triangle covers at
 * most half of a rectangle around it, so in units of u X_b X_c, with |n| <= 1, |c_i| <= 2, |s_i| <= 3:
 *   n: two products of 1 + 1 + 1, and 1 for their difference: 7
 *   c_i: two products of 5 + 2 + 2, and 2: 20
 *   s_0, s_2: 7 + 20 + 3 = 30; s_1: 20 + 30 + 3 = 53
 *   r_i: two products of 3 + 1 + 1: 10; the sum: 10 + 53 + 7, and 3 + 3 + 3 for three additions: 79
 * In units of u X_x X_y X_z:
 *   |n|.h: three products of 7 + 1 + 1, and 2 + 3 for the sums: 32
 *   n.m: three products of 2*7 + 5 + 2, and 4 + 6: 73; their difference 6: 111
 * ULPS = 128 serves both; the rest covers second-order terms, the rounding of the bound and reassociation.
 * The bound may take any x >= X for X.
 *
 * Underflow, and subnormals read as zero, change a number by at most 2^-126 (2^-1022). What stands for an
 * extent is 0 or within [2^-30, 2^40] ([2^-300, 2^301)), so a bound of degree d is at least 2^-16 * 2^-30d
 * (2^-45 * 2^-300d), to which such errors, times the other extents, add less than 2^-18 of it; and nothing
 * overflows. Where X_k = 0, every value with a factor of axis k is exactly 0, and so is its bound:
 * "value >= bound" is right, since that axis then follows from the faces, which lie strictly outside or are
 * closed there under every rule. */
#define TBX_ULPS 128
#define TBX_U32 1.1920928955078125e-07f /* 2^-23 */
#if TBX_DOUBLE_IS_53_BITS
#define TBX_U64 2.220446049250313080847263336e-16 /* 2^-52 */
#else
#define TBX_U64 1.1920928955078125e-07 /* 2^-23 */
#endif
#define TBX_BOUND_ERROR 1.01 /* a computed bound times this: its own rounding, and terms of second order */

enum { TBX_MISS = 0, TBX_HIT = 1, TBX_UNSURE = 2 };

/* The triangle is a set of points: no corner has a NaN or an infinity. */
TBX_FN int tbx_corners_finite(const double v0[3], const double v1[3], const double v2[3])
{
    return tbx_finite3(v0) & tbx_finite3(v1) & tbx_finite3(v2);
}

/* Without a branch where the compiler has a way to say so: signs are coin tosses. */
TBX_FN double tbx_abs(double x)
{
#if TBX_GNU && !defined(__CUDACC__)
    return __builtin_fabs(x);
#else
    return x < 0.0 ? -x : x;
#endif
}

/* Of numbers that can be compared as they are: one instruction each. */
TBX_FN double tbx_lesser(double a, double b)
{
    return a < b ? a : b;
}

TBX_FN double tbx_greater(double a, double b)
{
#if TBX_HAS_ASM && defined(__SSE2_MATH__) && !defined(__clang__)
    TBX_KEEP_SCALAR(a); /* gcc would find the comparison of tbx_lesser, and branch on it for both */
#endif
    return a > b ? a : b;
}

/* Is the magnitude 0 or in [2^-200, 2^300)? Such doubles are multiples of 2^-252, and so are their
 * differences: nothing is flushed to zero, and nothing that the filter computes overflows. */
TBX_FN int tbx_is_usual(const double *x)
{
    const uint64_t magnitude = tbx_bits64(x) & 0x7fffffffffffffffu;
    return (magnitude == 0) | (magnitude - ((uint64_t)(1023 - 200) << 52) < (uint64_t)500 << 52);
}

TBX_FN int tbx_is_usual3(const double x[3])
{
    return tbx_is_usual(&x[0]) & tbx_is_usual(&x[1]) & tbx_is_usual(&x[2]);
}

TBX_NOINLINE int tbx_all_usual(const double v0[3], const double v1[3], const double v2[3],
                               const double box_min[3], const double box_max[3])
{
    const double *const x[5] = { v0, v1, v2, box_min, box_max };
    int usual = 1;
    int i;
    TBX_UNROLL
    for (i = 0; i < 5; i++) {
        usual &= tbx_is_usual3(x[i]);
    }
    return usual;
}

/* The box, clipped to the triangle's bounding box. Bit k of open_lo, open_hi: that face is not in the box. */
typedef struct tbx_clip {
    double lo[3];
    double hi[3];
    unsigned open_lo;
    unsigned open_hi;
} tbx_clip;

/* Decides emptiness and the faces of any numbers, on integer keys: those of NaN are beyond infinity's.
 * Returns 0 if the triangle is no set of points or nothing is left of the box. A face is replaced by the
 * triangle's extent, and then closed, only where it lies strictly outside. */
TBX_COLD int tbx_clip_box(tbx_clip *clip, const double v0[3], const double v1[3], const double v2[3],
                          const double box_min[3], const double box_max[3], unsigned flags)
{
    const int lo_is_open = tbx_lo_is_open(flags);
    const int hi_is_open = tbx_hi_is_open(flags);
    const int64_t infinity = (int64_t)0x7ff0000000000000u;
    int k;
    clip->open_lo = 0;
    clip->open_hi = 0;
    for (k = 0; k < 3; k++) {
        const int64_t a = tbx_key64(&v0[k]);
        const int64_t b = tbx_key64(&v1[k]);
        const int64_t c = tbx_key64(&v2[k]);
        const int64_t lo = tbx_key64(&box_min[k]);
        const int64_t hi = tbx_key64(&box_max[k]);
        const int64_t ab_min = a < b ? a : b;
        const int64_t ab_max = a < b ? b : a;
        const int64_t t_min = ab_min < c ? ab_min : c;
        const int64_t t_max = ab_max > c ? ab_max : c;
        if (t_min <= -infinity || t_max >= infinity || lo < -infinity || hi > infinity ||
            lo + hi_is_open > hi || lo + lo_is_open > t_max || hi - hi_is_open < t_min) {
            return 0;
        }
        clip->lo[k] = tbx_from_key64(lo < t_min ? t_min : lo);
        clip->hi[k] = tbx_from_key64(hi > t_max ? t_max : hi);
        clip->open_lo |= (unsigned)(lo_is_open && lo >= t_min) << k;
        clip->open_hi |= (unsigned)(hi_is_open && hi <= t_max) << k;
    }
    return 1;
}

/* The same of usual numbers, which can be compared as they are, on axis k. Returns 1 where an open face parts
 * them; where a closed one does, or lo > hi, the box that is left has lo > hi. */
TBX_FN int tbx_clip_axis(tbx_clip *clip, int k, double v0, double v1, double v2, double lo, double hi,
                         unsigned flags)
{
    const double t_min = tbx_lesser(tbx_lesser(v0, v1), v2);
    const double t_max = tbx_greater(tbx_greater(v0, v1), v2);
    clip->lo[k] = tbx_greater(lo, t_min);
    clip->hi[k] = tbx_lesser(hi, t_max);
    if (tbx_hi_is_open(flags)) {
        const int lo_is_open = tbx_lo_is_open(flags);
        clip->open_lo |= (unsigned)(lo_is_open & tbx_no_more(t_min, lo)) << k;
        clip->open_hi |= (unsigned)tbx_no_more(hi, t_max) << k;
        return tbx_no_more(hi, lo) | tbx_no_more(hi, t_min) | (lo_is_open & tbx_no_more(t_max, lo));
    }
    return 0;
}

/* The values of the filter: the worst edge of each plane, then the plane; and their bounds. */
typedef struct tbx_values {
    double value[4];
    double bound[4];
    double support; /* |n|.h */
} tbx_values;

/* One axis of a question: a_1, a_2, m, h, the lengths of the edges, and x >= X. */
typedef struct tbx_axis {
    double a1;
    double a2;
    double m;
    double h;
    double e0;
    double e1;
    double e2;
    double x;
} tbx_axis;

/* Corners v of this axis, and the clipped box. */
TBX_FN void tbx_axis_set(tbx_axis *r, double v0, double v1, double v2, double lo, double hi)
{
    double a1 = v1 - v0;
    double a2 = v2 - v0;
    double from = lo - v0;
    double h = hi - lo;
    TBX_KEEP4(SCALAR, a1, a2, from, h);
    r->a1 = a1;
    r->a2 = a2;
    r->m = 2.0 * from + h;
    r->h = h;
    r->e0 = tbx_abs(a1);
    r->e1 = tbx_abs(a2 - a1);
    r->e2 = tbx_abs(a2);
    r->x = r->e0 + r->e2;
}

/* The least value of the three edges in the plane of two axes; out_n: that component of the normal. */
TBX_FN double tbx_filter_edges(const tbx_axis *b, const tbx_axis *c, double *out_n)
{
    const double n = b->a1 * c->a2 - c->a1 * b->a2;
    const double c0 = b->a1 * c->m - c->a1 * b->m;
    const double s0 = n - c0;
    const double s2 = n - (b->m * c->a2 - c->m * b->a2);
    const double s1 = c0 - s2;
    const double g0 = b->e0 * c->h + (c->e0 * b->h - tbx_abs(s0));
    const double g1 = b->e1 * c->h + (c->e1 * b->h - tbx_abs(s1));
    const double g2 = b->e2 * c->h + (c->e2 * b->h - tbx_abs(s2));
    *out_n = n;
    return tbx_lesser(tbx_lesser(g0, g1), g2) + tbx_abs(n);
}

/* Corners and the clipped box are usual. Written out, as are its callers: few compilers unroll loops. */
TBX_FORCED void tbx_filter(tbx_values *out, const tbx_axis x[3])
{
    const double x0 = TBX_ULPS * TBX_U64 * x[0].x;
    double n0;
    double n1;
    double n2;
    out->value[0] = tbx_filter_edges(&x[1], &x[2], &n0);
    out->value[1] = tbx_filter_edges(&x[2], &x[0], &n1);
    out->value[2] = tbx_filter_edges(&x[0], &x[1], &n2);
    out->bound[0] = TBX_ULPS * TBX_U64 * x[1].x * x[2].x;
    out->bound[1] = x0 * x[2].x;
    out->bound[2] = x0 * x[1].x;
    out->bound[3] = out->bound[2] * x[2].x;
    out->support = tbx_abs(n0) * x[0].h + tbx_abs(n1) * x[1].h + tbx_abs(n2) * x[2].h;
    out->value[3] = out->support - tbx_abs(n0 * x[0].m + n1 * x[1].m + n2 * x[2].m);
}

/* The power of two that maps an extent in [2^-300, 2^301) to [2^14, 2^15). */
TBX_FN double tbx_lattice_scale(double extent)
{
    const uint64_t exponent = (tbx_bits64(&extent) >> 52) & 0x7ffu;
    return tbx_from_bits64((uint64_t)(2046 + 14 - exponent) << 52);
}

/* Is x, usual or 0 where subnormals are, a multiple of `unit`, a power of two, and below 2^51 of them? The
 * sum with 1.5 * 2^52 of them is the multiple nearest to x, or beside it. Where doubles may have 24 bits,
 * nothing is. */
TBX_FN int tbx_is_whole(double x, double unit)
{
    const double middle = unit * 6755399441055744.0; /* 1.5 * 2^52 */
    double sum = x + middle;
    TBX_KEEP_SCALAR(sum);
    sum -= middle;
    return TBX_DOUBLE_IS_53_BITS & tbx_no_more(x, sum) & tbx_no_more(sum, x) &
           (tbx_abs(x) < unit * 2251799813685248.0); /* 2^51 */
}

/* The same of any x below 2^900, in units of 1/scale; subnormals, which may be read as zero, are none. */
TBX_FN int tbx_on_lattice(double x, double scale)
{
    const uint64_t magnitude = tbx_bits64(&x) & 0x7fffffffffffffffu;
    const double unit = tbx_from_bits64(((uint64_t)2046 << 52) - tbx_bits64(&scale));
    return (magnitude - 1u >= 0x000fffffffffffffu) & tbx_is_whole(x, unit);
}

/* The unit of which an extent in [2^-300, 2^301) is from 2^14 to 2^15. */
TBX_FN double tbx_lattice_unit(double extent)
{
    return tbx_from_bits64((tbx_bits64(&extent) & 0x7ff0000000000000u) - ((uint64_t)14 << 52));
}

/* The triangle's extent along axis k, or up to twice that. */
TBX_FN double tbx_extent64(const double v0[3], const double v1[3], const double v2[3], int k)
{
    return tbx_abs(v1[k] - v0[k]) + tbx_abs(v2[k] - v0[k]);
}

/* Are all values of the filter exact? Of a triangle that is no point: coordinates that are multiples of some
 * unit, and differ by less than 2^15 of it, make them so: the largest, n.m, is below 3 * 2^31 * 2^17 < 2^53
 * in that unit, cubed. */
TBX_FN int tbx_clip_on_lattice(const double v0[3], const double v1[3], const double v2[3],
                               const tbx_clip *clip)
{
    const double longest = tbx_greater(tbx_greater(tbx_extent64(v0, v1, v2, 0), tbx_extent64(v0, v1, v2, 1)),
                                       tbx_extent64(v0, v1, v2, 2));
    const double unit = tbx_lattice_unit(longest);
    const double *const x[5] = { v0, v1, v2, clip->lo, clip->hi };
    int i;
    int k;
    for (i = 0; i < 5; i++) {
        for (k = 0; k < 3; k++) {
            if (!tbx_is_whole(x[i][k], unit)) {
                return 0;
            }
        }
    }
    return 1;
}

/* What the filter leaves unsure, by exact signs. */
TBX_COLD int tbx_clipped_exact(const double v0[3], const double v1[3], const double v2[3],
                               const tbx_clip *clip, unsigned unsure)
{
    tbx_exact f;
    tbx_exact_points(&f, v0, v1, v2, clip->lo, clip->hi);
    f.open[0] = clip->open_lo;
    f.open[1] = clip->open_hi;
    tbx_exact_finish(&f);
    return tbx_exact_axes(&f, unsure);
}

/* Does t surpass p and q on some axis? */
TBX_FN int tbx_is_outside(const double t[3], const double p[3], const double q[3])
{
    int outside = 0;
    int k;
    for (k = 0; k < 3; k++) {
        outside |= tbx_more(tbx_lesser(p[k], q[k]), t[k]) | tbx_more(t[k], tbx_greater(p[k], q[k]));
    }
    return outside;
}

/* Of a chord p, q, an edge asked alone, n is 0, and for each axis one condition remains: r - |c| >= 0, c =
 * a x m, a = q - p, of the box clipped to it. The bound is the edges' one above: r, 10, c, 20, and their
 * sum, 4, of 128. Where X_b or X_c is 0, so are value and bound: the faces say all. */
typedef struct tbx_chord {
    double a;
    double m;
    double h; /* below 0: a face of the box parts them, or min > max */
    double e; /* |a| */
} tbx_chord;

TBX_FN void tbx_chord_set(tbx_chord *x, double p, double q, double lo, double hi)
{
    const double lower = tbx_greater(lo, tbx_lesser(p, q));
    double a = q - p;
    double from = lower - p;
    double h = tbx_lesser(hi, tbx_greater(p, q)) - lower;
    TBX_KEEP3(SCALAR, a, from, h);
    x->a = a;
    x->m = 2.0 * from + h;
    x->h = h;
    x->e = tbx_abs(a);
}

TBX_FN void tbx_chord_across(const tbx_chord *b, const tbx_chord *c, double *least, double *most)
{
    const double value = b->e * c->h + (c->e * b->h - tbx_abs(b->a * c->m - b->m * c->a));
    const double bound = TBX_ULPS * TBX_U64 * b->e * c->e;
    *least = tbx_lesser(*least, value - bound);
    *most = tbx_lesser(*most, value + bound);
}

/* The verdict of faces and chord, or UNSURE. */
TBX_FORCED int tbx_chord_meets(const double p[3], const double q[3], const double lo[3], const double hi[3])
{
    tbx_chord x[3];
    double least;
    double most;
    tbx_chord_set(&x[0], p[0], q[0], lo[0], hi[0]);
    tbx_chord_set(&x[1], p[1], q[1], lo[1], hi[1]);
    tbx_chord_set(&x[2], p[2], q[2], lo[2], hi[2]);
    most = tbx_lesser(tbx_lesser(x[0].h, x[1].h), x[2].h);
    least = most;
    tbx_chord_across(&x[0], &x[1], &least, &most);
    tbx_chord_across(&x[1], &x[2], &least, &most);
    tbx_chord_across(&x[2], &x[0], &least, &most);
    /* one branch, hardly ever missed: a hit alone is a coin toss */
    if (tbx_more(0.0, most) | tbx_no_more(0.0, least)) {
        return least >= 0.0;
    }
    return TBX_UNSURE;
}

/* Triangles without area, whose plane the filter never decides: corners on a line, or that repeat. An edge
 * with the same bounding box as the triangle is asked alone: where it is surely hit, so is the triangle, and
 * where the third corner is an end of it, they are one. */
TBX_COLD int tbx_clipped_edge(const double v0[3], const double v1[3], const double v2[3],
                              const tbx_clip *clip)
{
    const double *p = v0;
    const double *q = v1;
    const double *t = v2;
    int verdict;
    int is_end;
    int k;
    for (k = 0; tbx_is_outside(t, p, q); k++) {
        const double *const next = p;
        if (k == 2) {
            return TBX_UNSURE;
        }
        p = q;
        q = t;
        t = next;
    }
    verdict = tbx_chord_meets(p, q, clip->lo, clip->hi);
    is_end = !(tbx_is_outside(p, t, t) & tbx_is_outside(q, t, t));
    return verdict == TBX_MISS && !is_end ? TBX_UNSURE : verdict;
}

/* The filter leaves conditions unsure. On a lattice of whole units an edge's value is exact, a multiple of
 * the unit squared; the bound is below 2^-15 of that, so an unsure one is 0. So it is with the plane's value,
 * a multiple of the unit cubed: the bound is below 2^-45 (2^15)^3 of it. Touching counts, or goes to exact
 * signs, as does what then remains. */
TBX_COLD int tbx_clipped_unsure(const double v0[3], const double v1[3], const double v2[3],
                                const tbx_clip *clip, const tbx_values *filter)
{
    const unsigned open = clip->open_lo | clip->open_hi;
    unsigned unsure = 0;
    int k;
    if (filter->support <= filter->bound[3]) {
        const int verdict = tbx_clipped_edge(v0, v1, v2, clip);
        if (verdict != TBX_UNSURE) {
            return verdict;
        }
    }
    if (open == 0 && tbx_clip_on_lattice(v0, v1, v2, clip)) {
        return 1;
    }
    for (k = 0; k < 4; k++) {
        unsure |= (unsigned)!(filter->value[k] >= filter->bound[k]) << k;
    }
    return tbx_clipped_exact(v0, v1, v2, clip, unsure);
}

/* The verdict of the faces, the nine edges and the plane, of usual numbers: by the filter, and what that
 * leaves unsure by other means. parted: an open face is known to part them. */
TBX_FORCED int tbx_clipped(const double v0[3], const double v1[3], const double v2[3], const tbx_clip *clip,
                           int parted)
{
    tbx_axis x[3];
    tbx_values f;
    double least;
    double most;
    tbx_axis_set(&x[0], v0[0], v1[0], v2[0], clip->lo[0], clip->hi[0]);
    tbx_axis_set(&x[1], v0[1], v1[1], v2[1], clip->lo[1], clip->hi[1]);
    tbx_axis_set(&x[2], v0[2], v1[2], v2[2], clip->lo[2], clip->hi[2]);
    if (parted | tbx_more(0.0, tbx_lesser(tbx_lesser(x[0].h, x[1].h), x[2].h))) {
        return TBX_MISS;
    }
    tbx_filter(&f, x);
    least = tbx_lesser(tbx_lesser(f.value[0] - f.bound[0], f.value[1] - f.bound[1]),
                       tbx_lesser(f.value[2] - f.bound[2], f.value[3] - f.bound[3]));
    most = tbx_lesser(tbx_lesser(f.value[0] + f.bound[0], f.value[1] + f.bound[1]),
                      tbx_lesser(f.value[2] + f.bound[2], f.value[3] + f.bound[3]));
    /* one branch, hardly ever missed: a hit alone is a coin toss, and compilers would branch on it */
    if (tbx_more(0.0, most) | tbx_no_more(0.0, least)) {
        return least >= 0.0;
    }
    return tbx_clipped_unsure(v0, v1, v2, clip, &f);
}

TBX_NOINLINE int tbx_clipped_usual(const double v0[3], const double v1[3], const double v2[3],
                                   const tbx_clip *clip, int parted)
{
    return tbx_clipped(v0, v1, v2, clip, parted);
}

/* Clips the box on all axes; returns what tbx_clip_axis does. */
TBX_FORCED int tbx_clip_usual(tbx_clip *clip, const double v0[3], const double v1[3], const double v2[3],
                              const double box_min[3], const double box_max[3], unsigned flags)
{
    clip->open_lo = 0;
    clip->open_hi = 0;
    return tbx_clip_axis(clip, 0, v0[0], v1[0], v2[0], box_min[0], box_max[0], flags) |
           tbx_clip_axis(clip, 1, v0[1], v1[1], v2[1], box_min[1], box_max[1], flags) |
           tbx_clip_axis(clip, 2, v0[2], v1[2], v2[2], box_min[2], box_max[2], flags);
}

/* The verdict for usual numbers: emptiness and the faces first. */
TBX_FORCED int tbx_overlap_plain(const double v0[3], const double v1[3], const double v2[3],
                                 const double box_min[3], const double box_max[3], unsigned flags)
{
    tbx_clip clip;
    const int parted = tbx_clip_usual(&clip, v0, v1, v2, box_min, box_max, flags);
    return tbx_clipped(v0, v1, v2, &clip, parted);
}

TBX_NOINLINE int tbx_overlap_usual(const double v0[3], const double v1[3], const double v2[3],
                                   const double box_min[3], const double box_max[3], unsigned flags)
{
    tbx_clip clip;
    const int parted = tbx_clip_usual(&clip, v0, v1, v2, box_min, box_max, flags);
    return tbx_clipped_usual(v0, v1, v2, &clip, parted);
}

/* Numbers that are not usual: clipped by their keys, then decided by the filter where that is possible. */
TBX_COLD int tbx_overlap_unusual(const double v0[3], const double v1[3], const double v2[3],
                                 const double box_min[3], const double box_max[3], unsigned flags)
{
    tbx_clip clip;
    if (!tbx_clip_box(&clip, v0, v1, v2, box_min, box_max, flags)) {
        return 0;
    }
    /* a box that was infinite is usual once it is clipped */
    if (tbx_all_usual(v0, v1, v2, clip.lo, clip.hi)) {
        return tbx_clipped_usual(v0, v1, v2, &clip, 0);
    }
    return tbx_clipped_exact(v0, v1, v2, &clip, TBX_ALL_AXES);
}

/* The scalar body, which is the specification. */
TBX_NOINLINE int tbx_overlap(const double v0[3], const double v1[3], const double v2[3],
                             const double box_min[3], const double box_max[3], unsigned flags)
{
    if (tbx_all_usual(v0, v1, v2, box_min, box_max)) {
        return TBX_EITHER(tbx_overlap_usual, tbx_overlap_plain)(v0, v1, v2, box_min, box_max, flags);
    }
    return tbx_overlap_unusual(v0, v1, v2, box_min, box_max, flags);
}

TBX_FN float tbx_minf(float a, float b)
{
    return a < b ? a : b;
}

TBX_FN float tbx_maxf(float a, float b)
{
    return a > b ? a : b;
}

TBX_FN float tbx_absf(float a)
{
#if TBX_GNU && !defined(__CUDACC__)
    return __builtin_fabsf(a);
#else
    const float zero = 0.0f; /* a constant might be a double: FLT_EVAL_METHOD 1 */
    return a < zero ? -a : a;
#endif
}

TBX_FN int tbx_overlap_double(const double v0[3], const double v1[3], const double v2[3],
                              const double box_min[3], const double box_max[3], unsigned rule)
{
    TBX_RETURN_IF_SURE(tbx_filter2(v0, v1, v2, box_min, box_max, rule != 0));
    return tbx_overlap(v0, v1, v2, box_min, box_max, rule);
}

TRIBOX_FN int tribox_overlap_rule_f64(const double v0[3], const double v1[3], const double v2[3],
                                      const double box_min[3], const double box_max[3], unsigned flags)
{
    return tbx_overlap_double(v0, v1, v2, box_min, box_max, tbx_rule(flags));
}

TRIBOX_FN int tribox_overlap_f64(const double v0[3], const double v1[3], const double v2[3],
                                 const double box_min[3], const double box_max[3])
{
    return tbx_overlap_double(v0, v1, v2, box_min, box_max, 0);
}

/* The float entry of the scalar body, of any floats. As doubles, all finite floats are usual. */
TBX_COLD int tbx_overlap_unusual_floats(const float v0[3], const float v1[3], const float v2[3],
                                        const float box_min[3], const float box_max[3], unsigned rule)
{
    double wide[5][3];
    int i;
    tbx_widen3(wide[0], v0);
    tbx_widen3(wide[1], v1);
    tbx_widen3(wide[2], v2);
    tbx_widen3(wide[3], box_min);
    tbx_widen3(wide[4], box_max);
    for (i = 0; i < 15; i++) {
        /* a face at infinity is as good at 2^224, which is usual */
        const uint64_t infinity = 0x7ff0000000000000u;
        uint64_t bits = tbx_bits64(&wide[i / 3][i % 3]);
        const uint64_t magnitude = bits & 0x7fffffffffffffffu;
        if (magnitude >= infinity + (uint64_t)(i >= 9)) {
            return 0; /* a corner, or NaN */
        }
        bits -= magnitude == infinity ? (uint64_t)800 << 52 : 0;
        TBX_COPY(&wide[i / 3][i % 3], &bits, sizeof bits);
    }
    return tbx_overlap_usual(wide[0], wide[1], wide[2], wide[3], wide[4], rule);
}

/* The same, where all can be converted at once. */
TBX_NOINLINE int tbx_overlap_widened(const float v0[3], const float v1[3], const float v2[3],
                                     const float box_min[3], const float box_max[3], unsigned rule)
{
    double p[3];
    double q[3];
    double r[3];
    double lo[3];
    double hi[3];
    const uint64_t unusual = tbx_unusual6(v0, v1) | tbx_unusual6(v2, box_min) | tbx_unusual2(box_max);
    if (TBX_RARELY(((unusual & TBX_PAIR_SIGNS) != 0) | tbx_is_unusual(tbx_bits32(&box_max[2])))) {
        return tbx_overlap_unusual_floats(v0, v1, v2, box_min, box_max, rule);
    }
    tbx_take3_float(p, v0);
    tbx_take3_float(q, v1);
    tbx_take3_float(r, v2);
    tbx_take3_float(lo, box_min);
    tbx_take3_float(hi, box_max);
    return TBX_EITHER(tbx_overlap_usual, tbx_overlap_plain)(p, q, r, lo, hi, rule);
}

TBX_FN int tbx_overlap_float(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                             const float box_max[3], unsigned rule)
{
    TBX_RETURN_IF_SURE(tbx_filter4(v0, v1, v2, box_min, box_max, rule != 0));
    return tbx_overlap_widened(v0, v1, v2, box_min, box_max, rule);
}

TRIBOX_FN int tribox_overlap(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                             const float box_max[3])
{
    return tbx_overlap_float(v0, v1, v2, box_min, box_max, 0);
}

TRIBOX_FN int tribox_overlap_rule(const float v0[3], const float v1[3], const float v2[3],
                                  const float box_min[3], const float box_max[3], unsigned flags)
{
    return tbx_overlap_float(v0, v1, v2, box_min, box_max, tbx_rule(flags));
}

/* [AM01] in plain float: box at the origin, nine cross-product axes, three faces, the plane. */
TRIBOX_FN int tribox_sat(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                         const float box_max[3])
{
    float v[3][3];
    float e[3][3];
    float h[3];
    float n[3];
    float d;
    float r;
    int a;
    int i;
    for (a = 0; a < 3; a++) {
        const float centre = (box_min[a] + box_max[a]) * 0.5f;
        h[a] = (box_max[a] - box_min[a]) * 0.5f;
        v[0][a] = v0[a] - centre;
        v[1][a] = v1[a] - centre;
        v[2][a] = v2[a] - centre;
        e[0][a] = v[1][a] - v[0][a];
        e[1][a] = v[2][a] - v[1][a];
        e[2][a] = v[0][a] - v[2][a];
    }
    for (i = 0; i < 3; i++) {
        /* edge i joins corners i and i+1: the one at i and the third differ */
        const int j = (i + 2) % 3;
        for (a = 0; a < 3; a++) {
            const int b = (a + 1) % 3;
            const int c = (a + 2) % 3;
            const float p0 = e[i][b] * v[i][c] - e[i][c] * v[i][b];
            const float p1 = e[i][b] * v[j][c] - e[i][c] * v[j][b];
            r = tbx_absf(e[i][c]) * h[b] + tbx_absf(e[i][b]) * h[c];
            if (tbx_minf(p0, p1) > r || tbx_maxf(p0, p1) < -r) {
                return 0;
            }
        }
    }
    for (a = 0; a < 3; a++) {
        if (tbx_minf(tbx_minf(v[0][a], v[1][a]), v[2][a]) > h[a] ||
            tbx_maxf(tbx_maxf(v[0][a], v[1][a]), v[2][a]) < -h[a]) {
            return 0;
        }
    }
    for (a = 0; a < 3; a++) {
        n[a] = e[0][(a + 1) % 3] * e[1][(a + 2) % 3] - e[0][(a + 2) % 3] * e[1][(a + 1) % 3];
    }
    d = n[0] * v[0][0] + n[1] * v[0][1] + n[2] * v[0][2];
    r = tbx_absf(n[0]) * h[0] + tbx_absf(n[1]) * h[1] + tbx_absf(n[2]) * h[2];
    return d <= r && d >= -r;
}

/* ---- 7. Prepared triangle ---------------------------------------------------------------------------------
 *
 * [SS10] in a frame at ref, a float beside v_0. With w an edge's inward normal in the plane across axis a,
 * which is (-e_c, e_b) or (e_c, -e_b) by the sign of n_a, and the box at p reaching w.x at most, x in [0,
 * size],
 *
 *   edge i    w.(p - v_i) + support(w) >= 0,     support(w) = max(0, w_b) size_b + max(0, w_c) size_c,
 *   plane     n.(p - v_0) + support(n) >= 0 and the same with -n.
 *
 * Thin: support(w) = (w.size + max |w_k| size_k)/2. Edges 0 and 2 meet in v_0, and of edge 1 v_0 lies |n_a|
 * inside. So with q = p - ref and o = v_0 - ref (0 where v_0 is a float), each is w.q + d,
 *
 *   d = support(w) - w.o, and |n_a| more for edge 1.
 *
 * Edge 1 and the plane's second side come from the others: linear parts add up to zero, so
 *
 *   value_1 = (d_0 + d_1 + d_2) - (value_0 + value_2).
 *
 * In arrays edge 2 comes before edge 1: value[1] is value_2 and value[2] is value_1; d_e likewise.
 *
 * Bound. X is the triangle's extent, R = X + size + |o| along an axis, or 2^-30 if that is more: no p that
 * the faces allow is farther from ref.
 * u bounds the error of an operation in every rounding mode, 2^-23. Edges, in units of u and of
 * G = X_b R_c + X_c R_b, which bounds |w_b q_b| + |w_c q_c|, and |d| too, since R holds X, size and o:
 *   w is rounded once: 1. q in octants is p - ref + size, three roundings of at most R: 3. Their products: 1.
 *   d_0, d_2: w, size or o, their product, the sum of at most four: 7; it is the sum stored that counts.
 *   d_1: the same with w_1 = -(w_0 + w_2), 2 more: 9; |n_a| <= X_b X_c <= G/2, of two products of 3 roundings
 *   and their difference, 7/2, and its sum 1: 14.
 *   value_0: 5, two sums of at most 2 G: 4, d_0: 7, together 16, value_2 alike; of value_1 w_0 and w_2: 2, q:
 *   3, products: 2, the sums in value_0 and value_2: 8, their sum 4, the last difference 2, d_0 + d_1 + d_2:
 *   5, d_1: 14, together 40.
 * The plane, in units of u and of V = sum X_b X_c R_a, which bounds sum |n_a q_a| and |d|: n_a has 7 of X_b
 * X_c, so
 *   n.q: 7 + 3 + 1: 11; d: 7 + 1 + 1, and 4 sums: 13; value_0: 11, three sums of at most 2 V: 6, d: 13,
 *   together 30; the other side: 11, 6, the sum with value_2 2, the difference 2, d_0 + d_1: 2, d_1: 13,
 *   together 36.
 * TRI_ULPS = 60 serves both, and leaves room for terms of second order, for 1 and 2 that are added, and for
 * the rounding of the bound. (tests/proofs/products.gappa counts each term's longest chain of roundings
 * instead, 45 and 41.) Conditions are scaled by a power of two that brings their bound to 1/2..1, and 1
 * is added. Where n is made in double, its own error is below 2^-29 of that of floats: its |n_a| takes the
 * place of X_b X_c.
 *
 * Edges along an axis ask what the faces ask, under every rule: 2 more is added to them, so that they are
 * sure. The plane asks what the faces ask where two components of n are 0. Where one is, n_a, the edges
 * across a lie on one line and ask about both its sides, as the plane does; so it is left out there too.
 *
 * Underflow, and subnormals read as zero, add at most 2^-126 to a rounding. Every X is 0 or at least 2^-30,
 * every R at most 2^40: where X_b, X_c > 0, G >= 2^-30 R_b and 2^-30 R_c, so the bound, at least 2^-18 G,
 * exceeds 2^-126 R by 2^78; V >= 2^-60 R_a likewise. Where X_b or X_c is 0, all edges across a are along an
 * axis. Nothing overflows: w is at most 2^30 G, and n_a at most 2^30 V, so scaled they are below 2^48, V is
 * below 2^122, and q below 2^43, even where faces do not hold. */
#if TBX_GNU
#define TBX_PURE __attribute__((pure))
#else
#define TBX_PURE
#endif

#define TBX_TRI_ULPS 60
/* n_a, in units of X_b X_c here: the 7 above, and the rounding of what measures them; of |p| + |q|, where
 * n_a = p - q is made of rounded edges, 3 + 3 and its own. */
#define TBX_NORMAL_ULPS 8

/* Orders as floats do; +0 and -0 are 0. */
TBX_FN int32_t tbx_key32(const float *x)
{
    const uint32_t bits = tbx_bits32(x);
    const uint32_t sign = bits >> 31; /* no branch: a coin toss */
    return (int32_t)(((bits & 0x7fffffffu) ^ (0u - sign)) + sign);
}

#define TBX_KEY32_MAX 0x7f7fffff /* FLT_MAX */

/* The float of a key, moved into the finite range. */
TBX_FN float tbx_key32_float(int32_t key)
{
    const int32_t magnitude = key < 0 ? -key : key;
    const uint32_t bits =
        (uint32_t)(magnitude < TBX_KEY32_MAX ? magnitude : TBX_KEY32_MAX) | (key < 0 ? 0x80000000u : 0u);
    float x;
    TBX_COPY(&x, &bits, sizeof x);
    return x;
}

TBX_FN double tbx_key32_value(int32_t key)
{
    const float x = tbx_key32_float(key);
    double value;
    tbx_widen(&value, &x);
    return value;
}

/* Is s, a rounded a + b, their exact sum? s minus the larger of the two is exact, in every rounding mode, and
 * equals the smaller if and only if s was not rounded. */
TBX_FN int tbx_is_sum(double s, double a, double b)
{
    double without_a;
    double without_b;
    TBX_KEEP_SCALAR(s);
    without_a = s - a;
    without_b = s - b;
    return TBX_DOUBLE_IS_53_BITS && tbx_key64(&without_a) == tbx_key64(&b) &&
           tbx_key64(&without_b) == tbx_key64(&a);
}

/* The sign of p + count*size - t, in real numbers; size >= 0, may be infinite, p and t are finite. Rounding
 * is monotone, in every mode: if the rounded p - t is above, or below, the double -count*size, so is the
 * exact one. */
TBX_FN int tbx_face_sign(const double *p, const double *size, int count, const double *t)
{
    if (!tbx_is_finite(size)) {
        return 1;
    }
    if (TBX_DOUBLE_IS_53_BITS && tbx_in_range(p, -900, 900) && tbx_in_range(size, -900, 900) &&
        tbx_in_range(t, -900, 900)) {
        const double reach = -*size * (double)count;
        double from_t = *p - *t;
        TBX_KEEP_SCALAR(from_t);
        if (from_t > reach || from_t < reach) {
            return from_t > reach ? 1 : -1;
        }
        if (tbx_is_sum(from_t, *p, -*t)) {
            return 0;
        }
    }
    {
        const tbx_coord face = tbx_at(p, size, 2 * count);
        const tbx_coord plane = tbx_at(t, NULL, 0);
        return tbx_compare(&face, &plane);
    }
}

/* The key of the least float x for which x + size reaches t, or, if strict, exceeds it. MAX + 1: none
 * does. */
TBX_FN int32_t tbx_least_key(const double *t, const double *size, int strict)
{
    int64_t from = -(int64_t)TBX_KEY32_MAX;
    int64_t to = (int64_t)TBX_KEY32_MAX + 1;
    if (!tbx_is_finite(size)) {
        return (int32_t)from;
    }
    if (tbx_in_range(t, -100, 100) && tbx_in_range(size, -100, 100)) {
        double at = *t - *size;
        TBX_KEEP_SCALAR(at);
        if (tbx_in_range(&at, -100, 100)) {
            /* a float below the rounded difference is below the exact one, and likewise above */
            float x = (float)at;
            TBX_KEEP_SCALAR(x);
            from = (int64_t)tbx_key32(&x);
            to = from + 1;
            if (!TBX_DOUBLE_IS_53_BITS) {
                from -= 8;
                to += 8;
            } else if ((double)x > at || (double)x < at) {
                return (int32_t)((double)x < at ? to : from);
            } else if (tbx_is_sum(at, *t, -*size)) {
                return (int32_t)(strict ? to : from);
            }
        }
    }
    while (from < to) { /* at most 32 times; one of from..to is the least */
        const int64_t middle = from + (to - from) / 2;
        const double x = tbx_key32_value((int32_t)middle);
        if (tbx_face_sign(&x, size, 1, t) >= strict) {
            to = middle;
        } else {
            from = middle + 1;
        }
    }
    return (int32_t)from;
}

TBX_COLD int tbx_normal_sign_exact(const double v0[3], const double v1[3], const double v2[3], int b, int c)
{
    tbx_exact f;
    tbx_exact_corners(&f, v0, v1, v2);
    tbx_exact_finish(&f);
    return tbx_orient2(&f, b, c, 0, 1, 2, 2);
}

/* The triangle's edges: differences, and their signs, which are exact. */
typedef struct tbx_edges {
    double e[3][3];
    int e_sign[3][3];
    double n[3];   /* n_a = e0_b e1_c - e0_c e1_b */
    int n_sign[3]; /* exact too */
} tbx_edges;

/* n's sign from the difference where that is certain, else exactly. A product with a zero factor is zero. */
TBX_FN void tbx_edges_init(tbx_edges *t, const double v0[3], const double v1[3], const double v2[3])
{
    int a;
    for (a = 0; a < 3; a++) {
        const int64_t k0 = tbx_key64(&v0[a]);
        const int64_t k1 = tbx_key64(&v1[a]);
        const int64_t k2 = tbx_key64(&v2[a]);
        t->e[0][a] = v1[a] - v0[a];
        t->e[1][a] = v2[a] - v1[a];
        t->e[2][a] = v0[a] - v2[a];
        t->e_sign[0][a] = (k1 > k0) - (k1 < k0);
        t->e_sign[1][a] = (k2 > k1) - (k2 < k1);
        t->e_sign[2][a] = (k0 > k2) - (k0 < k2);
    }
    TBX_KEEP(t->e);
    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        const double p = t->e[0][b] * t->e[1][c];
        const double q = t->e[0][c] * t->e[1][b];
        const double error = (tbx_abs(p) + tbx_abs(q)) * (TBX_NORMAL_ULPS * TBX_U64);
        t->n[a] = p - q;
        if ((t->e_sign[0][b] == 0 || t->e_sign[1][c] == 0) &&
            (t->e_sign[0][c] == 0 || t->e_sign[1][b] == 0)) {
            t->n_sign[a] = 0;
            t->n[a] = 0.0;
        } else if (error > TBX_POW2(-930) && (p - q > error || p - q < -error)) {
            t->n_sign[a] = p - q > 0.0 ? 1 : -1;
        } else {
            t->n_sign[a] = tbx_normal_sign_exact(v0, v1, v2, b, c);
        }
    }
}

/* The faces of axis k hold for floats with keys least..most. By its bits, read as an integer, a negative
 * float is -2^31 + its magnitude, so that positive floats above `most` are the largest integers, which the
 * test refuses first. What remains to refuse is one interval of integers, cyclically: adding `shift` moves
 * its end to 2^31 - 1, so that it is exactly what is above `span`. NaN and infinity are refused, too. */
TBX_FN void tbx_store_faces(tribox_tri *tri, int k, int32_t least, int32_t most)
{
    const int32_t zero = -2147483647 - 1; /* -0 */
    int32_t shift = zero;
    int32_t span = -least;
    if (least > most) {
        most = zero; /* -0 alone is left, which `shift` moves above `span` */
        shift = 1;
        span = zero;
    } else if (least > 0) {
        shift = 2147483647 - (least - 1);
        span = -1 - least;
    } else if (most < 0) {
        shift = most;
        span = zero + (most - least);
        most = -1;
    }
    tri->hidden.most[k] = most;
    tri->hidden.shift[k] = shift;
    tri->hidden.span[k] = span;
}

/* What setup knows beside the edges. */
typedef struct tbx_setup {
    tbx_edges t;
    double offset[3]; /* o = v_0 - ref */
    double extent[3]; /* X */
    double reach[3];  /* R */
    double size[3];
    int thin;
} tbx_setup;

/* The power of two that brings a bound > 0 to 1/2..1. */
TBX_FN double tbx_tri_scale(double bound)
{
    const double error = TBX_TRI_ULPS * (double)TBX_U32 * bound;
    return tbx_from_bits64((uint64_t)(2045 - (tbx_bits64(&error) >> 52)) << 52);
}

/* d of the condition along w, but for |n_a|. */
TBX_FN double tbx_distance(const tbx_setup *s, const double w[3])
{
    double d = 0.0;
    double largest = 0.0;
    int k;
    for (k = 0; k < 3; k++) {
        const double along = w[k] * s->size[k];
        const double size = tbx_abs(along);
        d += (s->thin ? 0.5 * along : along > 0.0 ? along : 0.0) - w[k] * s->offset[k];
        largest = size > largest ? size : largest;
    }
    return s->thin ? d + 0.5 * largest : d;
}

/* Writes lane a of n_e_b, n_e_c and d_e: the three edges as seen along axis a. */
TBX_FN void tbx_store_edges(tribox_tri *tri, const tbx_setup *s, int a)
{
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    const double bound = s->extent[b] * s->reach[c] + s->extent[c] * s->reach[b];
    const double scale = tbx_tri_scale(bound);
    const double inward = s->t.n_sign[a] >= 0 ? scale : -scale;
    double d[3];
    int i;
    if (!(bound > 0.0)) {
        return;
    }
    for (i = 0; i < 3; i++) {
        double w[3] = { 0.0, 0.0, 0.0 };
        w[b] = -inward * s->t.e[i][c];
        w[c] = inward * s->t.e[i][b];
        d[i] = tbx_distance(s, w) + (s->t.e_sign[i][b] != 0 && s->t.e_sign[i][c] != 0 ? 1.0 : 3.0);
        if (i != 1) {
            tri->n_e_b[i / 2][a] = (float)w[b];
            tri->n_e_c[i / 2][a] = (float)w[c];
        }
    }
    tri->d_e[0][a] = (float)d[0];
    tri->d_e[1][a] = (float)d[2];
    tri->d_e[2][a] = (float)(d[0] + d[2] + (d[1] + tbx_abs(s->t.n[a]) * scale));
}

/* Both sides of the triangle's plane. */
TBX_FN void tbx_store_plane(tribox_tri *tri, const tbx_setup *s)
{
    const double error_of_n = TBX_U64 / (double)TBX_U32;
    double n[3];
    double minus_n[3];
    double bound = 0.0;
    double scale;
    double d;
    int k;
    if (s->t.n_sign[0] == 0 || s->t.n_sign[1] == 0 || s->t.n_sign[2] == 0) {
        return;
    }
    for (k = 0; k < 3; k++) {
        const double area = s->extent[(k + 1) % 3] * s->extent[(k + 2) % 3];
        bound += (tbx_abs(s->t.n[k]) + error_of_n * area) * s->reach[k];
    }
    scale = tbx_tri_scale(bound);
    for (k = 0; k < 3; k++) {
        n[k] = scale * s->t.n[k];
        minus_n[k] = -n[k];
    }
    d = tbx_distance(s, n) + 1.0;
    tri->n_e_b[0][3] = (float)n[0];
    tri->n_e_c[0][3] = (float)n[1];
    tri->n_z[3] = (float)n[2];
    tri->d_e[0][3] = (float)d;
    tri->d_e[2][3] = (float)(d + (double)tri->d_e[1][3] + (tbx_distance(s, minus_n) + 1.0));
}

/* Fills in *s from *tri: extents, size and offset in the frame at ref. Returns 0 where bounds do not hold. */
TBX_FN int tbx_setup_start(tbx_setup *s, tribox_tri *tri)
{
    const double least = TBX_POW2(-30);
    int in_range = 1;
    int k;
    for (k = 0; k < 3; k++) { /* before any sum of them */
        in_range &= tbx_in_range(&tri->v[0][k], -1022, 41) & tbx_in_range(&tri->size[k], -1022, 41) &
                    tbx_in_range(&tri->t_min[k], -1022, 41) & tbx_in_range(&tri->t_max[k], -1022, 41);
    }
    for (k = 0; k < 3 && in_range; k++) {
        const int has_ref = tbx_in_range(&tri->v[0][k], -100, 41); /* else a float subnormal might come out */
        tri->ref[k] = (float)(has_ref ? tri->v[0][k] : 0.0);
        TBX_KEEP(tri->ref[k]); /* gcc's -Ofast leaves the rounding out of what follows, on x87 */
        s->size[k] = tri->size[k];
        s->offset[k] = tri->v[0][k] - (double)tri->ref[k];
        s->extent[k] = tri->t_max[k] - tri->t_min[k];
        TBX_KEEP(s->extent[k]);
        s->reach[k] = s->extent[k] + s->size[k] + tbx_abs(s->offset[k]);
        s->reach[k] = s->reach[k] > least ? s->reach[k] : least;
        in_range &= tbx_in_range(&s->extent[k], -30, 40) & tbx_in_range(&s->reach[k], -1022, 40) &
                    (tbx_sign(&s->extent[k]) != 0 || tbx_key64(&tri->t_min[k]) == tbx_key64(&tri->t_max[k]));
        tri->hidden.step[k] = (float)s->size[k];
    }
    return in_range;
}

/* Writes all of *tri: whether it is empty, its bounds, its faces, and conditions that are unsure of every p.
 * Returns 0 for the empty set. */
TBX_FN int tbx_tri_start(tribox_tri *tri, const double v[3][3], const double size[3], unsigned flags)
{
    const double zero = 0.0;
    const int finite = tbx_finite3(size);
    const unsigned rule = finite && (flags & TRIBOX_THIN) != 0 ? (unsigned)TRIBOX_THIN : tbx_rule(flags);
    const int lo_is_open = tbx_lo_is_open(rule);
    const int hi_is_open = tbx_hi_is_open(rule);
    int empty = !tbx_corners_finite(v[0], v[1], v[2]);
    int k;
    for (k = 0; k < 4; k++) {
        tri->ref[k] = tri->n_z[k] = tri->hidden.step[k] = 0.0f;
        tri->n_e_b[0][k] = tri->n_e_b[1][k] = tri->n_e_c[0][k] = tri->n_e_c[1][k] = 0.0f;
        tri->d_e[0][k] = tri->d_e[1][k] = 1.0f; /* of any p unsure: between 0 and 2 */
        tri->d_e[2][k] = 3.0f;
        tbx_store_faces(tri, k, 1, 0);
    }
    for (k = 0; k < 3; k++) {
        empty |= tbx_is_nan(&size[k]) || tbx_sign(&size[k]) < hi_is_open;
    }
    TBX_COPY(tri->v, v, sizeof tri->v);
    TBX_COPY(tri->size, size, sizeof tri->size);
    tri->flags = rule;
    tri->empty = empty;
    tri->hidden.flags = flags;
    tri->hidden.in_range = 0;
    for (k = 0; k < 3; k++) {
        double t_min = 0.0;
        double t_max = 0.0;
        if (!empty) {
            t_min = tbx_min(tbx_min(v[0][k], v[1][k]), v[2][k]);
            t_max = tbx_max(tbx_max(v[0][k], v[1][k]), v[2][k]);
            tbx_store_faces(tri, k, tbx_least_key(&t_min, &size[k], hi_is_open),
                            tbx_least_key(&t_max, &zero, !lo_is_open) - 1);
        }
        tri->t_min[k] = t_min;
        tri->t_max[k] = t_max;
    }
    tri->hidden.most[3] = tri->hidden.most[2];
    tri->hidden.shift[3] = tri->hidden.shift[2];
    tri->hidden.span[3] = tri->hidden.span[2];
    return !empty;
}

/* The specification of setup. */
TBX_NOINLINE void tbx_tri_init(tribox_tri *tri, const double v[3][3], const double size[3], unsigned flags)
{
    tbx_setup s;
    int k;
    if (!tbx_tri_start(tri, v, size, flags) || !tbx_setup_start(&s, tri)) {
        return;
    }
    s.thin = (tri->flags & TRIBOX_THIN) != 0;
    tbx_edges_init(&s.t, v[0], v[1], v[2]);
    for (k = 0; k < 4; k++) { /* conditions that always hold: values 3, 3 and 9 - (3 + 3) = 3 */
        tri->d_e[0][k] = tri->d_e[1][k] = 3.0f;
        tri->d_e[2][k] = 9.0f;
    }
    for (k = 0; k < 3; k++) {
        tbx_store_edges(tri, &s, k);
    }
    tbx_store_plane(tri, &s);
    tri->ref[3] = tri->ref[2];
    tri->hidden.step[3] = tri->hidden.step[2];
    tri->hidden.in_range = 1;
}

TBX_NOINLINE void tbx_tri_init_wide(tribox_tri *tri, const double v[3][3], const double size[3],
                                    unsigned flags)
{
#if TRIBOX_SIMD
    float x[4][3];
    if (tbx_tri_narrow(x, v, size) && tbx_tri_init_simd(tri, x[0], x[1], x[2], x[3], flags)) {
        return;
    }
#endif
    tbx_tri_init(tri, v, size, flags);
}

TRIBOX_FN void tribox_tri_init_f64(tribox_tri *tri, const double v0[3], const double v1[3],
                                   const double v2[3], const double size[3], unsigned flags)
{
    double wide[4][3];
    TBX_COPY(wide[0], v0, sizeof wide[0]);
    TBX_COPY(wide[1], v1, sizeof wide[1]);
    TBX_COPY(wide[2], v2, sizeof wide[2]);
    TBX_COPY(wide[3], size, sizeof wide[3]);
    tbx_tri_init_wide(tri, (const double(*)[3])wide, wide[3], flags);
}

/* The float entry of the scalar body. */
TBX_NOINLINE void tbx_tri_init_widened(tribox_tri *tri, const float v0[3], const float v1[3],
                                       const float v2[3], const float size[3], unsigned flags)
{
    double wide[4][3];
    tbx_widen3(wide[0], v0);
    tbx_widen3(wide[1], v1);
    tbx_widen3(wide[2], v2);
    tbx_widen3(wide[3], size);
    tbx_tri_init(tri, (const double(*)[3])wide, wide[3], flags);
}

TRIBOX_FN void tribox_tri_init(tribox_tri *tri, const float v0[3], const float v1[3], const float v2[3],
                               const float size[3], unsigned flags)
{
#if TRIBOX_SIMD
    if (!TBX_RARELY(!tbx_tri_init_simd(tri, v0, v1, v2, size, flags))) {
        return;
    }
#endif
    tbx_tri_init_widened(tri, v0, v1, v2, size, flags);
}

/* The verdict of the conditions at ref + q, for a p whose faces hold. */
TBX_FN int tbx_tri_filter(const tribox_tri *tri, const float q[3])
{
    const float zero = 0.0f;
    const float two = 2.0f;
    float b[4];
    float c[4];
    float value[3][4];
    int verdict = TBX_HIT;
    int k;
    b[0] = q[1];
    b[1] = q[2];
    b[2] = b[3] = q[0];
    c[0] = q[2];
    c[1] = q[0];
    c[2] = c[3] = q[1];
    for (k = 0; k < 4; k++) {
        value[0][k] =
            tri->n_e_b[0][k] * b[k] + (tri->n_e_c[0][k] * c[k] + (tri->n_z[k] * q[2] + tri->d_e[0][k]));
        value[1][k] = tri->n_e_b[1][k] * b[k] + (tri->n_e_c[1][k] * c[k] + tri->d_e[1][k]);
        value[2][k] = tri->d_e[2][k] - (value[0][k] + value[1][k]);
    }
    for (k = 0; k < 4; k++) {
        const float least = tbx_minf(tbx_minf(value[0][k], value[1][k]), value[2][k]);
        if (least < zero) {
            return TBX_MISS;
        }
        verdict = least < two ? TBX_UNSURE : verdict;
    }
    return verdict;
}

/* a + b, if that is a double. */
TBX_FN int tbx_exact_sum(double *out, const double *a, const double *b)
{
    if (!tbx_in_range(a, -1022, 1000) || !tbx_in_range(b, -1022, 1000)) {
        return 0;
    }
    *out = *a + *b;
    return tbx_is_sum(*out, *a, *b);
}

/* The box at p + (octant's bits)*size, its faces being known to hold, by exact signs. */
TBX_COLD int tbx_tri_exact(const tribox_tri *tri, const double p[3], unsigned octant)
{
    double v[3][3];
    double size[3];
    tbx_exact f;
    int k;
    TBX_COPY(v, tri->v, sizeof v);
    TBX_COPY(size, tri->size, sizeof size);
    tbx_exact_corners(&f, v[0], v[1], v[2]);
    for (k = 0; k < 3; k++) {
        const int upper = (int)(octant >> k & 1u);
        f.x[TBX_LO][k] = tbx_at(&p[k], &size[k], 2 * upper);
        f.x[TBX_MID][k] = tbx_at(&p[k], &size[k], 2 * upper + 1);
        /* an infinite step is read as 2^1024; four of them from any p lie beyond every corner */
        f.x[TBX_HI][k] = tbx_at(&p[k], &size[k], tbx_is_finite(&size[k]) ? 2 * upper + 2 : 8);
    }
    return tbx_exact_overlap(&f, tri->flags);
}

/* The same, by the test of one box where the box's faces are doubles. */
TBX_COLD int tbx_tri_decide(const tribox_tri *tri, const double p[3], unsigned octant)
{
    double v[3][3];
    double size[3];
    double lo[3];
    double hi[3];
    int one_box = (tri->flags & TRIBOX_THIN) == 0;
    int k;
    TBX_COPY(v, tri->v, sizeof v);
    TBX_COPY(size, tri->size, sizeof size);
    for (k = 0; k < 3; k++) {
        const int upper = (int)(octant >> k & 1u);
        lo[k] = p[k];
        hi[k] = size[k];
        one_box = one_box && (!upper || tbx_exact_sum(&lo[k], &p[k], &size[k])) &&
                  (!tbx_is_finite(&size[k]) || tbx_exact_sum(&hi[k], &lo[k], &size[k]));
    }
    return one_box ? tribox_overlap_rule_f64(v[0], v[1], v[2], lo, hi, tri->flags)
                   : tbx_tri_exact(tri, p, octant);
}

/* Do the faces of axis k hold for [p, p + size]? */
TBX_FN int tbx_tri_faces(const tribox_tri *tri, int k, const double *p)
{
    const double t_min = tri->t_min[k];
    const double t_max = tri->t_max[k];
    const double size = tri->size[k];
    return tbx_key64(p) + tbx_lo_is_open(tri->flags) <= tbx_key64(&t_max) &&
           tbx_face_sign(p, &size, 1, &t_min) >= tbx_hi_is_open(tri->flags);
}

/* The specification of the test: faces, the conditions in float, and exactly what they leave unsure. */
TBX_NOINLINE int tbx_tri_test(const tribox_tri *tri, const double p[3])
{
    int verdict = TBX_UNSURE;
    int k;
    if (tri->empty || !tbx_finite3(p)) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        if (!tbx_tri_faces(tri, k, &p[k])) {
            return 0;
        }
    }
    if (tri->hidden.in_range) {
        float q[3];
        for (k = 0; k < 3; k++) {
            q[k] = (float)(p[k] - (double)tri->ref[k]);
        }
        TBX_KEEP(q);
        verdict = tbx_tri_filter(tri, q);
    }
    return verdict != TBX_UNSURE ? verdict : tbx_tri_decide(tri, p, 0);
}

TRIBOX_FN int tribox_tri_test_f64(const tribox_tri *tri, const double p[3])
{
    return tbx_tri_test(tri, p);
}

/* The same for floats: faces by integers, to which NaN and infinity are out of range. PURE: a loop may keep a
 * triangle's numbers in registers. */
TBX_NOINLINE TBX_PURE int tbx_tri_test_float(const tribox_tri *tri, const float p[3])
{
    double wide[3];
    float q[3];
    int verdict;
    int k;
    for (k = 0; k < 3; k++) {
        const uint32_t bits = tbx_bits32(&p[k]);
        const uint32_t moved = bits + (uint32_t)tri->hidden.shift[k];
        if ((int32_t)bits > tri->hidden.most[k] || (int32_t)moved > tri->hidden.span[k]) {
            return 0;
        }
    }
    for (k = 0; k < 3; k++) {
        q[k] = p[k] - tri->ref[k];
    }
    TBX_KEEP(q);
    verdict = tbx_tri_filter(tri, q);
    if (verdict != TBX_UNSURE) {
        return verdict;
    }
    tbx_widen3(wide, p);
    return tbx_tri_decide(tri, wide, 0);
}

TRIBOX_FN int tribox_tri_test(const tribox_tri *tri, const float p[3])
{
    TBX_RETURN_IF_SURE(tbx_tri_test_simd(tri, p));
    return tbx_tri_test_float(tri, p);
}

#ifndef TRIBOX_NO_COMPANIONS
/* ---- Octree descent */

#define TBX_OCTANTS_UNSURE 256u

TRIBOX_FN void tribox_tri_resize_f64(tribox_tri *tri, const double size[3])
{
    double wide[4][3];
    TBX_COPY(wide[0], tri->v, sizeof tri->v);
    TBX_COPY(wide[3], size, sizeof wide[3]);
    tbx_tri_init_wide(tri, (const double(*)[3])wide, wide[3], tri->hidden.flags);
}

TRIBOX_FN void tribox_tri_resize(tribox_tri *tri, const float size[3])
{
    double wide[3];
    tbx_widen3(wide, size);
    tribox_tri_resize_f64(tri, wide);
}

/* Bit 0, bit 1: the faces of axis k hold for [p, p + size], for [p + size, p + 2 size]. With an infinite
 * size, only the first is a box. */
TBX_FN unsigned tbx_octant_faces(const tribox_tri *tri, int k, const double *p)
{
    const double t_min = tri->t_min[k];
    const double t_max = tri->t_max[k];
    const double size = tri->size[k];
    const unsigned lower = (unsigned)tbx_tri_faces(tri, k, p);
    const unsigned upper = tbx_is_finite(&size) &&
                           tbx_face_sign(p, &size, 1, &t_max) <= -tbx_lo_is_open(tri->flags) &&
                           tbx_face_sign(p, &size, 2, &t_min) >= tbx_hi_is_open(tri->flags);
    return lower | upper << 1;
}

/* The conditions at the eight octants ref + q, q_k being lower[k] or upper[k]: bits of those where all hold.
 * Those that miss for sure are in neither this nor out_unsure; only `asked` count. */
TBX_FN unsigned tbx_octant_values(const tribox_tri *tri, const float lower[3], const float upper[3],
                                  unsigned asked, unsigned *out_unsure)
{
    unsigned hits = 0;
    unsigned unsure = 0;
    unsigned o;
    for (o = 0; o < 8; o++) {
        if ((asked >> o & 1u) != 0) {
            float q[3];
            int verdict;
            q[0] = (o & 1u) != 0 ? upper[0] : lower[0];
            q[1] = (o & 2u) != 0 ? upper[1] : lower[1];
            q[2] = (o & 4u) != 0 ? upper[2] : lower[2];
            verdict = tbx_tri_filter(tri, q);
            hits |= (unsigned)(verdict == TBX_HIT) << o;
            unsure |= (unsigned)(verdict == TBX_UNSURE) << o;
        }
    }
    *out_unsure = unsure;
    return hits;
}

/* The octants that the faces of axis k leave, the upper ones `shift` bits above the lower ones. */
TBX_FN unsigned tbx_octant_axis(const tribox_tri *tri, int k, const double *p, unsigned lower, int shift)
{
    const unsigned faces = tbx_octant_faces(tri, k, p);
    return lower * ((faces & 1u) | (faces >> 1) << shift);
}

/* The specification of octants: faces, the conditions in float, and exactly what they leave unsure. */
TBX_NOINLINE unsigned tbx_octants(const tribox_tri *tri, const double p[3])
{
    unsigned hits = 0;
    unsigned asked;
    unsigned unsure;
    float lower[3];
    float upper[3];
    unsigned o;
    int k;
    if (tri->empty || !tbx_finite3(p)) {
        return 0;
    }
    asked = tbx_octant_axis(tri, 0, &p[0], 0x55, 1);
    asked &= tbx_octant_axis(tri, 1, &p[1], 0x33, 2);
    asked &= tbx_octant_axis(tri, 2, &p[2], 0x0f, 4);
    unsure = asked;
    if (asked != 0 && tri->hidden.in_range) {
        for (k = 0; k < 3; k++) {
            double q = p[k] - (double)tri->ref[k];
            TBX_KEEP_SCALAR(q);
            lower[k] = (float)q;
            upper[k] = (float)(q + tri->size[k]);
        }
        TBX_KEEP(lower);
        TBX_KEEP(upper);
        hits = TBX_EITHER(tbx_octant_values_simd, tbx_octant_values)(tri, lower, upper, asked, &unsure);
    }
    for (o = 0; TBX_RARELY(unsure >> o != 0); o++) {
        if ((unsure >> o & 1u) != 0) {
            hits |= (unsigned)tbx_tri_decide(tri, p, o) << o;
        }
    }
    return hits;
}

TRIBOX_FN unsigned tribox_tri_octants_f64(const tribox_tri *tri, const double p[3])
{
    return tbx_octants(tri, p);
}

TBX_NOINLINE unsigned tbx_octants_widened(const tribox_tri *tri, const float p[3])
{
    double wide[3];
    tbx_widen3(wide, p);
    return tbx_octants(tri, wide);
}

TRIBOX_FN unsigned tribox_tri_octants(const tribox_tri *tri, const float p[3])
{
    const unsigned octants = TBX_EITHER(tbx_octants_simd(tri, p), TBX_OCTANTS_UNSURE);
    return TBX_RARELY(octants == TBX_OCTANTS_UNSURE) ? tbx_octants_widened(tri, p) : octants;
}
#endif /* TRIBOX_NO_COMPANIONS */

/* ---- 8. Grid ------------------------------------------------------------------------------------------- */

/* The grid's region holds voxels: finite origin and size, size > 0, lo < hi. */
TBX_FN int tbx_grid_valid(const tribox_grid *grid)
{
    int k;
    for (k = 0; k < 3; k++) {
        if (!tbx_is_finite(&grid->origin[k]) || !tbx_is_finite(&grid->size[k]) ||
            tbx_sign(&grid->size[k]) <= 0 || grid->lo[k] >= grid->hi[k]) {
            return 0;
        }
    }
    return 1;
}

TBX_FN size_t tbx_saturating_add(size_t a, size_t b)
{
    return a + b < a ? (size_t)-1 : a + b;
}

/* Is the number 0, or is its magnitude within 2^-e..2^e? Sums, products and quotients of a few such numbers
 * neither overflow nor come near to subnormals. */
TBX_FN int tbx_is_ordinary(const double *x, int e)
{
    return tbx_in_range(x, -e, e);
}

/* Whatever is 2^-ORDINARY..2^ORDINARY, or 0: all floats are. Differences of two such doubles are 0 or at
 * least 2^-(ORDINARY + 52); divided by a size, 2^-(2 ORDINARY + 52); three of those multiplied, 2^-1056. */
#define TBX_ORDINARY 150

/* ---- Grid planes */

/* A double's upper 26 bits. */
TBX_FN double tbx_high_half(double x)
{
    return tbx_from_bits64(tbx_bits64(&x) & ~(uint64_t)0x7ffffff);
}

/* a + b, and what rounding took off: exactly where it is to nearest, else right to 2^-52 of itself. */
TBX_FN double tbx_sum_exact(double a, double b, double *out_lost)
{
    double sum = a + b;
    double of_a;
    double of_b;
    TBX_KEEP_SCALAR(sum);
    of_a = sum - b;
    TBX_KEEP_SCALAR(of_a);
    of_b = sum - of_a;
    TBX_KEEP_SCALAR(of_b);
    of_a = a - of_a;
    of_b = b - of_b;
    TBX_KEEP2(SCALAR, of_a, of_b);
    *out_lost = of_a + of_b;
    return sum;
}

/* Of an axis's origin and size the upper half and the rest, those of the origin in PIECES. */
typedef struct tbx_halves {
    double origin_high;
    double origin_low;
    double high;
    double low;
} tbx_halves;

#define TBX_PIECES 40.0 /* of a voxel: eighths, tenths, twentieths, fortieths */

TBX_FN void tbx_halves_set(tbx_halves *h, const tribox_grid *grid, int k)
{
    const double origin = tbx_high_half(grid->origin[k]);
    h->origin_high = origin * TBX_PIECES;
    h->origin_low = (grid->origin[k] - origin) * TBX_PIECES;
    h->high = tbx_high_half(grid->size[k]);
    h->low = grid->size[k] - h->high;
}

/* How far x is above place `at` of axis k, whole, |at| < 2^26, in units of size / PIECES: decimals that were
 * rounded lie that little beside the places of a grid of decimals that a difference of doubles loses it.
 *
 * With halves of 26 and 27 bits the products are exact. So is the difference of the upper halves where both
 * numbers come back from it. Less at * size they leave what is of the order of the lower halves or, far from
 * the place, of the rest: that difference is exact or right to u of the rest. Three lower parts are added
 * with what rounding takes, off by 2^-104 of their magnitudes where it is not to nearest; a rest of 2^-50 of
 * these is right to 2^-54 and 3 u then, and with the factor 1 / size, in voxels, to 8 u: REST_ERROR. What is
 * less is not known, but that it is 0 where there is one lower part. Returns 0 if it is not known; the
 * numbers are ordinary. tests/errors.c looks for its error.
 *
 * "Exact" above asks that the upper parts' difference, of the order of the lower parts, has 53 bits above the
 * last one of at * size: origins must lie less than 2^47 sizes off. Callers see to 2^40, FARTHEST; a sign
 * alone is right also farther off. */
#define TBX_FARTHEST 1099511627776.0              /* 2^40 */
#define TBX_REST_ERROR (1.0 / 281474976710656.0)  /* 2^-48 */
#define TBX_REST_LEAST (1.0 / 1125899906842624.0) /* 2^-50 */

TBX_FN int tbx_rest(const tbx_halves *h, double x, double at, double *out_rest)
{
    const double x_high = tbx_high_half(x);
    const double above_origin = (x - x_high) * TBX_PIECES;
    const double origin_low = h->origin_low;
    const double part = at * h->low;
    const double from = h->origin_high;
    const double to = x_high * TBX_PIECES;
    double along = to - from;
    double taken;
    double back;
    double lost[2];
    double lows;
    double rest;
    double least;
    TBX_KEEP_SCALAR(along);
    taken = to - along;
    TBX_KEEP_SCALAR(taken);
    back = along + from;
    TBX_KEEP_SCALAR(back);
    along -= at * h->high;
    TBX_KEEP_SCALAR(along);
    if (!(TBX_DOUBLE_IS_53_BITS & (back == to) & (taken == from))) {
        return 0;
    }
    if (origin_low == 0.0 && above_origin == 0.0) {
        *out_rest = along - part;
        return 1;
    }
    lows = tbx_sum_exact(origin_low, -above_origin, &lost[0]);
    lows = tbx_sum_exact(lows, part, &lost[1]);
    rest = along - lows;
    TBX_KEEP_SCALAR(rest);
    rest = (rest - lost[1]) - lost[0];
    *out_rest = rest;
    least = (tbx_abs(origin_low) + tbx_abs(above_origin) + tbx_abs(part)) * TBX_REST_LEAST;
    return tbx_abs(rest) > least;
}

/* The sign of grid plane i of axis k against x, |i| < 2^33: in double where that is certain.
 *
 * Error: i*size, origin - x and their sum are rounded once each, by u of themselves: three u of the sum of
 * magnitudes, and that sum's own rounding; tests/proofs/walk.gappa. */
#define TBX_PLANE_ERROR (8.0 * TBX_U64)

TBX_FN int tbx_plane_compare(const tribox_grid *grid, int k, int64_t i, double x)
{
    const double *origin = &grid->origin[k];
    const double *size = &grid->size[k];
    if (tbx_is_ordinary(origin, 900) & tbx_is_ordinary(size, 900) & tbx_is_ordinary(&x, 900)) {
        double base = *origin; /* kept: clang would compute before the question, and overflow */
        double along = *size;
        double to = x;
        double offset;
        double value;
        double error;
        TBX_KEEP3(SCALAR, base, along, to);
        along *= (double)i;
        offset = base - to;
        TBX_KEEP_SCALAR(offset);
        value = offset + along;
        error = (tbx_abs(base) + tbx_abs(to) + tbx_abs(along)) * TBX_PLANE_ERROR;
        if (value > error || value < -error) {
            return value > 0.0 ? 1 : -1;
        }
        if (i < 1048576 && i > -1048576) {
            tbx_halves h;
            tbx_halves_set(&h, grid, k);
            if (tbx_rest(&h, to, (double)i * TBX_PIECES, &value)) {
                return (value < 0.0) - (value > 0.0);
            }
        }
    }
    {
        const tbx_coord plane = tbx_at(origin, size, 2 * i);
        const tbx_coord point = tbx_at(&x, NULL, 0);
        return tbx_compare(&plane, &point);
    }
}

/* The integer at or below x, moved into [lo, hi]. Only ever a guess: any finite x will do. The conversion
 * takes what a barrier has let through, so that no compiler converts before the comparisons. */
TBX_FN int64_t tbx_guess(double x, int64_t lo, int64_t hi)
{
    const double least = (double)lo;
    const double most = (double)hi;
    double at = x > least ? x : least;
    int64_t i;
    at = at < most ? at : most;
    TBX_KEEP_SCALAR(at);
    i = tbx_to_long(at);
    i -= (double)i > at;
    return i < lo ? lo : i > hi ? hi : i;
}

/* The least plane i in [lo, hi] with plane(i) > x (strict) or >= x; hi if none below hi. */
TBX_FN int64_t tbx_plane_search(const tribox_grid *grid, int k, int64_t lo, int64_t hi, double x, int strict)
{
    int64_t i = lo;
    int steps;
    if (tbx_is_ordinary(&grid->origin[k], 300) & tbx_is_ordinary(&grid->size[k], 300) &
        tbx_is_ordinary(&x, 300)) {
        double size = grid->size[k];
        TBX_KEEP_SCALAR(size);
        i = tbx_guess((x - grid->origin[k]) / size + 1.0, lo, hi);
    }
    for (steps = 0; steps < 3; steps++) {
        if (i < hi && tbx_plane_compare(grid, k, i, x) < strict) {
            lo = ++i;
        } else if (i > lo && tbx_plane_compare(grid, k, i - 1, x) >= strict) {
            hi = --i;
        } else {
            return i;
        }
    }
    while (lo < hi) { /* a far guess: numbers of very different size */
        const int64_t mid = lo + (hi - lo) / 2;
        if (tbx_plane_compare(grid, k, mid, x) < strict) {
            lo = mid + 1;
        } else {
            hi = mid;
        }
    }
    return lo;
}

/* ---- Meshes of floats and of doubles */

typedef struct tbx_source {
    const char *positions;
    size_t stride;
    const uint32_t *indices;
    size_t triangles;
    int is_double;
} tbx_source;

TBX_FN tbx_source tbx_source_of(const void *positions, size_t stride, const uint32_t *indices,
                                size_t triangles, int is_double)
{
    tbx_source s;
    s.positions = (const char *)positions;
    s.stride = stride != 0 ? stride : 3 * (is_double ? sizeof(double) : sizeof(float));
    s.indices = indices;
    s.triangles = triangles;
    s.is_double = is_double;
    return s;
}

TBX_FN tbx_source tbx_source_float(const tribox_mesh *mesh)
{
    return tbx_source_of(mesh->positions, mesh->stride, mesh->indices, mesh->triangles, 0);
}

TBX_FN tbx_source tbx_source_double(const tribox_mesh_f64 *mesh)
{
    return tbx_source_of(mesh->positions, mesh->stride, mesh->indices, mesh->triangles, 1);
}

/* What a triangle's numbers allow. */
enum { TBX_NO_POINTS = 0, TBX_ANY_FINITE = 1, TBX_ALL_ORDINARY = 2 };

TBX_FN int tbx_corners_kind(double v[3][3])
{
    int ordinary = 1;
    int i;
    for (i = 0; i < 3; i++) {
        ordinary &= tbx_is_ordinary(&v[i][0], TBX_ORDINARY) & tbx_is_ordinary(&v[i][1], TBX_ORDINARY) &
                    tbx_is_ordinary(&v[i][2], TBX_ORDINARY);
    }
    if (ordinary) {
        return TBX_ALL_ORDINARY;
    }
    return tbx_corners_finite(v[0], v[1], v[2]) ? TBX_ANY_FINITE : TBX_NO_POINTS;
}

TBX_FN const char *tbx_source_at(const tbx_source *s, size_t t, size_t c)
{
    const size_t at = 3 * t + c;
    return s->positions + (s->indices != NULL ? (size_t)s->indices[at] : at) * s->stride;
}

/* The corners of triangle t. Returns their kind. */
TBX_FN int tbx_source_triangle(const tbx_source *s, size_t t, double v[3][3])
{
    const char *p0 = tbx_source_at(s, t, 0);
    const char *p1 = tbx_source_at(s, t, 1);
    const char *p2 = tbx_source_at(s, t, 2);
    if (s->is_double) {
        TBX_COPY(v[0], p0, sizeof v[0]);
        TBX_COPY(v[1], p1, sizeof v[1]);
        TBX_COPY(v[2], p2, sizeof v[2]);
        return tbx_corners_kind(v);
    }
    return tbx_read_floats(v[0], p0) & tbx_read_floats(v[1], p1) & tbx_read_floats(v[2], p2)
               ? TBX_ALL_ORDINARY
               : TBX_NO_POINTS;
}

/* ---- The walk: one triangle over a region, row by row
 *
 * For a fixed row (y, z) every condition of [SS10] is a bound on x, so the voxels of a row are one span. The
 * edges in the plane xy bound x per y, those in xz bound x per z, those in yz bound y per z; only the
 * triangle's plane couples all three, and it is a slab: x within a half width of a middle that is linear in y
 * and z.
 * These are four groups of lines: in row r, a line lets voxels begin, or end, at floor(at + slope*r). The
 * lines of xy and of the plane count the same rows, and are asked at once.
 *
 * Lines are evaluated in double with a bound of their error. Where the floors of value - error and value +
 * error agree, the bound is certain. Where they do not, first the lattice is tried: if on the line's two axes
 * all corners lie on places of which 2^12 make a voxel, values lie on a lattice, too, and moving a line by
 * half its quantum, up or down as touching counts or not, decides all ties at once. What is left is asked in
 * integers: only the few voxels between the floors, by the conditions of that group. Numbers out of range are
 * the same case, with all voxels of the row between the floors. So each bound is exact, and each span is.
 *
 * Coordinates are voxels from the region's minimum corner, c = (v - origin) * inverse - lo.
 *   Error of a coordinate: u for v - origin, 4 u for the inverse (fast-math divides by approximation), u for
 *   the product, these of |c + lo|; u for the last difference, of |c|. With reach above the largest |c|, |lo|
 *   and |hi| that is at most 6 u times 2 reach, and u reach: less than
 *       delta = COORDINATE_ERROR * reach.
 *   Error of a line, slope s, in row r: the coordinates' (1 + |s|) delta; s is off by 16 u of itself (two
 *   edges, 6 u each, as differences of inputs are rounded once, and the division, 4 u), times at most 2
 *   reach; the sum's roundings, three of at most (1 + 3 |s|) 2 u reach: all less than
 *       LINE_ERROR * delta * (1 + |s|).
 *   Error of the plane's line: the same with 1 + |s_y| + |s_z|; and normals: n = p - q is off by NORMAL_ERROR
 *   times |p| + |q|, which moves the plane, at most m voxels from its corner on each axis, by
 *       2 NORMAL_ERROR m (|p_y| + |q_y| + |p_z| + |q_z| + (|s_y| + |s_z|) (|p_x| + |q_x|)) / |n_x|.
 * tests/proofs/walk.gappa proves them, tests/errors.c looks for the largest errors there are. */
#define TBX_COORDINATE_ERROR (14.0 * TBX_U64)
#define TBX_LINE_ERROR 10.0
#define TBX_NORMAL_ERROR (16.0 * TBX_U64)
#define TBX_MOST_ERROR 0.0625       /* of what is evaluated in double at all */
#define TBX_MOST_SLOPE 1073741824.0 /* 2^30 */

/* The least and greatest of three. */
TBX_FN double tbx_min3(double a, double b, double c)
{
    const double ab = b < a ? b : a;
    return c < ab ? c : ab;
}

TBX_FN double tbx_max3(double a, double b, double c)
{
    const double ab = b > a ? b : a;
    return c > ab ? c : ab;
}

/* A grid's numbers, in double. Faces of index boxes are found in fixed point: x*fixed + fixed_lo, truncated,
 * counts units of 2^-FIXED voxels from BEFORE voxels before the region.
 *
 * Error: with o = |origin / size| and l the largest of |lo|, |hi|, and the region's voxels, the product is
 * off by 6 u (o + l), fixed_lo by 8 u (o + l), the sum by 2 u l: in all less than FIXED_ERROR (o + l) voxels;
 * truncation adds a unit. */
#define TBX_FIXED 20
#define TBX_FIXED_ERROR (32.0 * TBX_U64)
#define TBX_BEFORE 3

typedef struct tbx_frame {
    const tribox_grid *grid;
    double origin[3];
    double inverse[3]; /* 1 / size */
    double lo[3];      /* of the region, */
    double end[3];     /* and its end, in fixed point */
    double fixed[3];
    double fixed_lo[3];
    double reach;
    int64_t slack;  /* the fixed point's error */
    int64_t last_x; /* the region's last voxel on axis x */
    int on;         /* 0: its numbers are out of range */
    int thin;
    int lo_is_open;
    int hi_is_open;
} tbx_frame;

/* Returns 0 for a grid without voxels. */
TBX_FN int tbx_frame_init(tbx_frame *f, const tribox_grid *grid)
{
    const double unit = (double)(1 << TBX_FIXED);
    double farthest = 0.0; /* of all origins */
    int k;
    if (!tbx_grid_valid(grid)) {
        return 0;
    }
    f->grid = grid;
    f->on = 1;
    f->thin = (grid->flags & TRIBOX_THIN) != 0;
    f->lo_is_open = tbx_lo_is_open(grid->flags);
    f->hi_is_open = tbx_hi_is_open(grid->flags);
    f->reach = 16.0;
    for (k = 0; k < 3; k++) {
        const int on =
            tbx_is_ordinary(&grid->origin[k], TBX_ORDINARY) & tbx_is_ordinary(&grid->size[k], TBX_ORDINARY);
        const double lo = (double)grid->lo[k];
        const double hi = (double)grid->hi[k];
        double size = on ? grid->size[k] : 1.0;
        double origin = on ? grid->origin[k] : 0.0;
        double inverse;
        double away;
        TBX_KEEP_SCALAR(size);
        TBX_KEEP_SCALAR(origin);
        inverse = 1.0 / size;
        away = origin * inverse;
        f->on &= on;
        f->origin[k] = origin;
        f->inverse[k] = inverse;
        f->lo[k] = lo;
        f->fixed[k] = inverse * unit;
        f->fixed_lo[k] = ((double)TBX_BEFORE - lo - away) * unit;
        f->end[k] = (hi - lo + 1.5 + (double)TBX_BEFORE) * unit;
        f->reach = tbx_max3(f->reach, tbx_abs(lo), tbx_abs(hi));
        farthest = tbx_abs(away) > farthest ? tbx_abs(away) : farthest;
    }
    farthest = (farthest + 2.0 * f->reach + 8.0) * TBX_FIXED_ERROR;
    f->on &= farthest < 0.0625;
    farthest = farthest < 0.0625 ? farthest * unit : 1.0;
    TBX_KEEP_SCALAR(farthest);
    f->slack = (int64_t)farthest + 2;
    f->last_x = (int64_t)grid->hi[0] - 1 - grid->lo[0];
    return 1;
}

/* Rows y and layers z of a region, first to last. */
typedef struct tbx_part {
    int64_t first[2];
    int64_t last[2];
} tbx_part;

/* Lines of a group. In row r the voxels begin at or after floor(at_lo + slope*r), and end at or before
 * floor(at_hi + slope*r), counted from 1, so that truncation is floor. What does not bound is BEYOND. */
typedef struct tbx_lines {
    double at_lo[4];
    double at_hi[4];
    double slope[4];
    double error; /* more than MOST_ERROR: nothing is certain */
} tbx_lines;

#define TBX_BEYOND 1152921504606846976.0 /* 2^60 */

enum { TBX_XY = 0, TBX_XZ = 1, TBX_YZ = 2, TBX_PLANE = 3 };

#define TBX_CACHED 64 /* rows whose bounds by the xy edges are kept, where they are not sure at once */

typedef struct tbx_row {
    int64_t y;
    int64_t first;
    int64_t last;
} tbx_row;

typedef struct tbx_walk {
    const tbx_frame *frame;
    const double *corner[3];
    int64_t first[3]; /* the triangle's index box within the region, from the region's first voxel */
    int64_t last[3];
    int64_t whole[3];   /* of the whole index box the first voxel, */
    int64_t more[3];    /* and the voxels after it */
    int box_is_strict;  /* the triangle lies strictly inside that, by more than rounding */
    int light;          /* 0: nothing is certain in double */
    int snapped;        /* the lattice has been tried */
    int placed;         /* corners are known as places and rests: 1; not asked yet: 0; they are not: -1 */
    double place[3][3]; /* the nearest, in PIECES from plane 0, */
    double rest[3][3];  /* and what is left, in PIECES, right to REST_ERROR */
    int uses[4];        /* groups whose conditions the index box does not imply */
    int n_sign[3];      /* of those */
    double x[3][3];     /* corners, and */
    double e[3][3];     /* edges, in voxels */
    double n[3];        /* normal, and */
    double n_terms[3];  /* the magnitudes that its components are made of */
    double extent;      /* the longest, and 2 */
    double delta;
    tbx_lines group[4];
    tbx_lines rows;     /* the lines of XY, and of PLANE as the fourth */
    double plane_at[2]; /* of layer 0 */
    double plane_slope_z;
    int64_t y; /* the next row */
    int64_t y_last;
    int64_t z;
    int64_t layer_first; /* bounds of x by the xz edges */
    int64_t layer_last;
    tbx_row row[TBX_CACHED];
} tbx_walk;

/* Corners as places and rests. Returns 0 where they are not known. */
TBX_FN int tbx_walk_place(tbx_walk *w)
{
    const tribox_grid *grid = w->frame->grid;
    int i;
    int k;
    if (w->placed != 0) {
        return w->placed > 0;
    }
    w->placed = -1;
    for (k = 0; k < 3 && w->light; k++) {
        const double units = w->frame->inverse[k] * TBX_PIECES;
        tbx_halves h;
        tbx_halves_set(&h, grid, k);
        if (tbx_abs(w->frame->origin[k]) > TBX_FARTHEST * grid->size[k]) {
            return 0;
        }
        for (i = 0; i < 3; i++) {
            double at = (w->corner[i][k] - w->frame->origin[k]) * units;
            if (!(at < 67108000.0 && at > -67108000.0)) {
                return 0;
            }
            TBX_KEEP_SCALAR(at);
            at = (double)tbx_to_long(at < 0.0 ? at - 0.5 : at + 0.5);
            if (!tbx_rest(&h, w->corner[i][k], at, &w->rest[i][k])) {
                return 0;
            }
            w->place[i][k] = at;
            w->rest[i][k] *= w->frame->inverse[k];
        }
    }
    w->placed = w->light ? 1 : -1;
    return w->light;
}

/* E and D of "Boxes of up to 4^3 voxels", whose coordinates are places P and rests r here, from a grid point:
 *
 *   E = P_i x P_j + G,  G = P_bi r_cj - r_ci v_bj + r_bi v_cj - P_ci r_bj,  v = P + r
 *   D = N . P + (N . r + M . v)
 *
 * N and M the whole and the other part of the normal. The whole parts are exact: places are less than 2^15
 * from the point here, so that N is below 2^33, and N . P below 2^50.
 *
 * Error of G: rests are right to REST_ERROR, 16 u; v, products and sums add 6 u of the magnitudes: less than
 * FINE_ERROR of them. M is made of differences of rests, off by 17 u of both magnitudes, and D of M and v: 30
 * u, less than 2 FINE_ERROR of magnitudes. */
#define TBX_FINE_ERROR (1.0 / 35184372088832.0) /* 2^-45, 128 u */
#define TBX_FINE_REACH 32768.0

/* E or D, and what `rest` may be off by. */
typedef struct tbx_fine {
    double whole;
    double rest;
    double error;
} tbx_fine;

/* Its sign; 0: not known. */
TBX_FN int tbx_fine_sign(const tbx_fine *f)
{
    double sum = f->whole + f->rest;
    double error;
    TBX_KEEP_SCALAR(sum);
    error = f->error + tbx_abs(sum) * TBX_FINE_ERROR;
    return (sum > error) - (sum < -error);
}

/* E of edge i in the plane across axis a, at grid point p. */
TBX_FN void tbx_fine_edge(tbx_fine *out, const tbx_walk *w, int i, int a, const double p[3])
{
    const int j = i < 2 ? i + 1 : 0;
    const int b = a < 2 ? a + 1 : 0;
    const int c = a > 0 ? a - 1 : 2;
    const double b_i = w->place[i][b] - p[b];
    const double b_j = w->place[j][b] - p[b];
    const double c_i = w->place[i][c] - p[c];
    const double c_j = w->place[j][c] - p[c];
    const double g0 = b_i * w->rest[j][c];
    const double g1 = w->rest[i][c] * (b_j + w->rest[j][b]);
    const double h0 = w->rest[i][b] * (c_j + w->rest[j][c]);
    const double h1 = c_i * w->rest[j][b];
    double whole = b_i * c_j - c_i * b_j;
    double rest = (g0 - g1) + (h0 - h1);
    TBX_KEEP_SCALAR(whole);
    TBX_KEEP_SCALAR(rest);
    out->whole = whole;
    out->rest = rest;
    out->error = (tbx_abs(g0) + tbx_abs(g1) + tbx_abs(h0) + tbx_abs(h1)) * TBX_FINE_ERROR;
}

/* D at grid point p. */
TBX_FN void tbx_fine_plane(tbx_fine *out, const tbx_walk *w, const double p[3])
{
    double whole = 0.0;
    double rest = 0.0;
    double bound = 0.0;
    int a;
    for (a = 0; a < 3; a++) {
        const int b = a < 2 ? a + 1 : 0;
        const int c = a > 0 ? a - 1 : 2;
        const double at = w->place[0][a] - p[a];
        const double b_1 = w->place[1][b] - w->place[0][b];
        const double b_2 = w->place[2][b] - w->place[0][b];
        const double c_1 = w->place[1][c] - w->place[0][c];
        const double c_2 = w->place[2][c] - w->place[0][c];
        const double rb_1 = w->rest[1][b] - w->rest[0][b];
        const double rb_2 = w->rest[2][b] - w->rest[0][b];
        const double rc_1 = w->rest[1][c] - w->rest[0][c];
        const double rc_2 = w->rest[2][c] - w->rest[0][c];
        const double most_b = tbx_abs(w->rest[0][b]) + tbx_abs(w->rest[1][b]) + tbx_abs(w->rest[2][b]);
        const double most_c = tbx_abs(w->rest[0][c]) + tbx_abs(w->rest[1][c]) + tbx_abs(w->rest[2][c]);
        const double n = b_1 * c_2 - c_1 * b_2;
        const double m = (b_1 * rc_2 - rc_1 * (b_2 + rb_2)) + (rb_1 * (c_2 + rc_2) - c_1 * rb_2);
        const double most =
            (tbx_abs(b_1) + tbx_abs(b_2) + most_b) * most_c + (tbx_abs(c_1) + tbx_abs(c_2) + most_c) * most_b;
        const double v = at + w->rest[0][a];
        whole += n * at;
        rest += n * w->rest[0][a] + m * v;
        bound += tbx_abs(n * w->rest[0][a]) + most * tbx_abs(v);
    }
    TBX_KEEP_SCALAR(whole);
    TBX_KEEP_SCALAR(rest);
    out->whole = whole;
    out->rest = rest;
    out->error = bound * (2.0 * TBX_FINE_ERROR);
}

/* The sign behind a condition as below, in double; 0: not known. */
TBX_FN int tbx_walk_fine(tbx_walk *w, int id, const int64_t index[3])
{
    const tribox_grid *grid = w->frame->grid;
    const int a = id / 3;
    const int i = id < 9 ? id % 3 : 0;
    const int j = i < 2 ? i + 1 : 0;
    const int b = a < 2 ? a + 1 : 0;
    const int c = a > 0 ? a - 1 : 2;
    const int w_sign = id < 9 ? (w->n_sign[a] >= 0 ? 1 : -1) : id == 9 ? 1 : -1;
    tbx_fine f;
    double p[3];
    int k;
    if (w->frame->thin || !tbx_walk_place(w)) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        int up;
        if (id >= 9) {
            up = w_sign * w->n_sign[k] > 0;
        } else if (k == b) {
            up = tbx_less(w_sign < 0 ? &w->corner[i][c] : &w->corner[j][c],
                          w_sign < 0 ? &w->corner[j][c] : &w->corner[i][c]);
        } else {
            up = tbx_less(w_sign < 0 ? &w->corner[j][b] : &w->corner[i][b],
                          w_sign < 0 ? &w->corner[i][b] : &w->corner[j][b]);
        }
        p[k] = (double)(grid->lo[k] + index[k] + up) * TBX_PIECES;
        if ((id >= 9 || k != a) && !(tbx_max3(tbx_abs(w->place[0][k] - p[k]), tbx_abs(w->place[1][k] - p[k]),
                                              tbx_abs(w->place[2][k] - p[k])) < TBX_FINE_REACH)) {
            return 0;
        }
    }
    if (id < 9) {
        tbx_fine_edge(&f, w, i, a, p);
        return w_sign * tbx_fine_sign(&f);
    }
    tbx_fine_plane(&f, w, p);
    return -w_sign * tbx_fine_sign(&f);
}

/* Does condition id hold at a voxel of the region, by exact signs? id: 3*axis + edge; 9 and 10, the two sides
 * of the plane. Returns 1 or 0. */
TBX_COLD int tbx_walk_exact(const tbx_walk *w, int id, const int64_t index[3])
{
    const tribox_grid *grid = w->frame->grid;
    tbx_exact f;
    int k;
    tbx_exact_corners(&f, w->corner[0], w->corner[1], w->corner[2]);
    for (k = 0; k < 3; k++) {
        const int64_t half = 2 * (grid->lo[k] + index[k]);
        f.x[TBX_LO][k] = tbx_at(&grid->origin[k], &grid->size[k], half);
        f.x[TBX_MID][k] = tbx_at(&grid->origin[k], &grid->size[k], half + 1);
        f.x[TBX_HI][k] = tbx_at(&grid->origin[k], &grid->size[k], half + 2);
    }
    f.thin = w->frame->thin;
    f.open[0] = w->frame->lo_is_open ? 7u : 0u;
    f.open[1] = w->frame->hi_is_open ? 7u : 0u;
    tbx_exact_finish(&f);
    return id < 9 ? tbx_exact_edge(&f, id / 3, id % 3, w->n_sign[id / 3])
                  : tbx_exact_plane(&f, w->n_sign, id == 9 ? 1 : -1);
}

/* The sign with which index `axis` enters a condition; 0 where the condition follows from the faces or other
 * edges. */
TBX_FN int tbx_walk_sign(const tbx_walk *w, int id, int axis)
{
    if (id >= 9) {
        return id == 9 ? w->n_sign[axis] : -w->n_sign[axis];
    } else {
        const int a = id / 3;
        const int i = id % 3;
        const int j = i < 2 ? i + 1 : 0;
        const int b = a < 2 ? a + 1 : 0;
        const int c = a > 0 ? a - 1 : 2;
        const int w_sign = w->n_sign[a] >= 0 ? 1 : -1;
        const int along_b =
            tbx_less(&w->corner[i][b], &w->corner[j][b]) - tbx_less(&w->corner[j][b], &w->corner[i][b]);
        const int along_c =
            tbx_less(&w->corner[i][c], &w->corner[j][c]) - tbx_less(&w->corner[j][c], &w->corner[i][c]);
        return along_b == 0 || along_c == 0 ? 0 : axis == b ? -w_sign * along_c : w_sign * along_b;
    }
}

/* A bound that lies in least..most. */
typedef struct tbx_bracket {
    int64_t least;
    int64_t most;
} tbx_bracket;

/* Brings the bounds of a group in row (y, z) to single voxels, by exact signs. */
TBX_COLD void tbx_walk_bisect(tbx_walk *w, int group, int64_t y, int64_t z, tbx_bracket *first,
                              tbx_bracket *last)
{
    const int axis = group == TBX_YZ ? 1 : 0;
    const int begin = group == TBX_PLANE ? 9 : 3 * (2 - group);
    const int end = group == TBX_PLANE ? 11 : begin + 3;
    int64_t index[3];
    int id;
    index[0] = 0;
    index[1] = y;
    index[2] = z;
    for (id = begin; id < end; id++) {
        const int sign = tbx_walk_sign(w, id, axis);
        int64_t least = sign > 0 ? first->least : last->least;
        int64_t most = sign > 0 ? first->most : last->most;
        while (sign != 0 && least < most) {
            /* first: the least voxel at which it holds, `most` if none before; last: the greatest */
            const int64_t mid = least + (most - least + (sign < 0)) / 2;
            int value;
            index[axis] = mid;
            value = tbx_walk_fine(w, id, index);
            if (value > 0 || (value == 0 && tbx_walk_exact(w, id, index))) {
                most = sign > 0 ? mid : most;
                least = sign > 0 ? least : mid;
            } else {
                most = sign > 0 ? most : mid - 1;
                least = sign > 0 ? mid + 1 : least;
            }
        }
        if (sign > 0) {
            first->least = least;
        } else if (sign < 0) {
            last->most = most;
        }
    }
}

/* The line of edge i in a group: b over r. Returns its steepness, negative where that is out of range. */
TBX_FN double tbx_line_set(tbx_walk *w, tbx_lines *l, int i, int b, int r, int area_is_negative,
                           double quantum)
{
    const tbx_frame *f = w->frame;
    const double e_b = w->e[i][b];
    const double width = tbx_abs(w->e[i][r]);
    double e_r = w->e[i][r];
    double slope;
    double steep;
    double spread;
    double at;
    l->at_lo[i] = -TBX_BEYOND;
    l->at_hi[i] = TBX_BEYOND;
    l->slope[i] = 0.0;
    if (e_b == 0.0 || e_r == 0.0) { /* the faces say it */
        return 0.0;
    }
    if (!(width * TBX_MOST_SLOPE > tbx_abs(e_b) && width > 1.0 / TBX_MOST_SLOPE)) {
        return -1.0;
    }
    TBX_KEEP_SCALAR(e_r);
    slope = e_b / e_r;
    steep = tbx_abs(slope);
    spread = steep;
    if (f->thin) {
        spread = steep > 1.0 ? steep - 1.0 : 0.0;
    }
    spread *= 0.5;
    at = (w->x[i][b] + 1.0) + slope * (0.5 - w->x[i][r]);
    if (quantum > 0.0) {
        const double touch = 0.5 * quantum / width;
        const int is_lower = area_is_negative != (e_r < 0.0);
        const int strict = is_lower ? f->hi_is_open : f->lo_is_open | (f->hi_is_open & (slope > 0.0));
        spread = strict ? spread - touch : spread + touch;
    }
    l->slope[i] = slope;
    if (area_is_negative != (e_r < 0.0)) {
        l->at_lo[i] = at - spread;
    } else {
        l->at_hi[i] = at + spread;
    }
    return steep;
}

/* The lines of a group, b over r. quantum: the product of the lattice's quanta on these two axes, or 0. */
TBX_FN void tbx_lines_set(tbx_walk *w, int group, int b, int r, double quantum)
{
    tbx_lines *l = &w->group[group];
    const int area_is_negative = group == TBX_XZ ? w->n_sign[1] > 0 : w->n_sign[group == TBX_XY ? 2 : 0] < 0;
    const double s0 = tbx_line_set(w, l, 0, b, r, area_is_negative, quantum);
    const double s1 = tbx_line_set(w, l, 1, b, r, area_is_negative, quantum);
    const double s2 = tbx_line_set(w, l, 2, b, r, area_is_negative, quantum);
    l->error = TBX_LINE_ERROR * w->delta * (1.0 + tbx_max3(s0, s1, s2));
    if (TBX_RARELY(tbx_min3(s0, s1, s2) < 0.0)) {
        l->error = 1.0;
    }
}

/* The two sides of the triangle's plane, in layer 0. */
TBX_FN void tbx_walk_plane(tbx_walk *w, double quantum)
{
    tbx_lines *l = &w->group[TBX_PLANE];
    const tbx_frame *f = w->frame;
    const double most = TBX_MOST_SLOPE;
    const double n_y = w->n[1];
    const double n_z = w->n[2];
    const double width = tbx_abs(w->n[0]);
    const int divides = width * most > tbx_abs(n_y) && width * most > tbx_abs(n_z) &&
                        width > 1.0 / (most * most) && width > 2.0 * TBX_NORMAL_ERROR * w->n_terms[0];
    double n_x = divides ? w->n[0] : 1.0;
    double inverse;
    double slope_y;
    double slope_z;
    double steep_y;
    double steep_z;
    double spread;
    double lower;
    double upper;
    TBX_KEEP_SCALAR(n_x);
    inverse = 1.0 / n_x;
    slope_y = -n_y * inverse;
    slope_z = -n_z * inverse;
    steep_y = tbx_abs(slope_y);
    steep_z = tbx_abs(slope_z);
    if (!f->thin) {
        spread = 0.5 * (steep_y + steep_z);
    } else {
        spread = steep_y > steep_z ? steep_y : steep_z;
        spread = spread > 1.0 ? 0.5 * (spread - 1.0) : 0.0;
    }
    lower = (w->x[0][0] + 1.0) + slope_y * (0.5 - w->x[0][1]) + slope_z * (0.5 - w->x[0][2]);
    upper = lower + spread;
    lower = lower - spread;
    if (quantum > 0.0) {
        const double touch = 0.5 * quantum * tbx_abs(inverse);
        const int uphill = tbx_more(slope_y, 0.0) | tbx_more(slope_z, 0.0);
        lower = f->hi_is_open ? lower + touch : lower - touch;
        upper = (f->lo_is_open | (f->hi_is_open & uphill)) != 0 ? upper - touch : upper + touch;
    }
    w->plane_at[0] = lower;
    w->plane_at[1] = upper;
    w->plane_slope_z = slope_z;
    l->slope[0] = slope_y;
    l->error = 1.0;
    if (divides) {
        l->error = TBX_LINE_ERROR * w->delta * (1.0 + steep_y + steep_z) +
                   2.0 * TBX_NORMAL_ERROR * w->extent * tbx_abs(inverse) *
                       (w->n_terms[1] + w->n_terms[2] + (steep_y + steep_z) * w->n_terms[0]);
    }
}

/* Moves the plane's lines to the walk's layer. */
TBX_FN void tbx_walk_plane_to_layer(tbx_walk *w)
{
    const double along = w->plane_slope_z * (double)w->z;
    w->group[TBX_PLANE].at_lo[0] = w->plane_at[0] + along;
    w->group[TBX_PLANE].at_hi[0] = w->plane_at[1] + along;
    w->rows.at_lo[3] = w->group[TBX_PLANE].at_lo[0];
    w->rows.at_hi[3] = w->group[TBX_PLANE].at_hi[0];
}

TBX_FN void tbx_walk_set_lines(tbx_walk *w, const double quantum[3])
{
    int i;
    w->rows.error = 0.0;
    if (w->uses[TBX_XY]) {
        tbx_lines_set(w, TBX_XY, 0, 1, quantum[0] * quantum[1]);
        for (i = 0; i < 3; i++) {
            w->rows.at_lo[i] = w->group[TBX_XY].at_lo[i];
            w->rows.at_hi[i] = w->group[TBX_XY].at_hi[i];
            w->rows.slope[i] = w->group[TBX_XY].slope[i];
        }
        w->rows.error = w->group[TBX_XY].error;
    }
    if (w->uses[TBX_XZ]) {
        tbx_lines_set(w, TBX_XZ, 0, 2, quantum[0] * quantum[2]);
    }
    if (w->uses[TBX_YZ]) {
        tbx_lines_set(w, TBX_YZ, 1, 2, quantum[1] * quantum[2]);
    }
    if (w->uses[TBX_PLANE]) {
        tbx_walk_plane(w, quantum[0] * quantum[1] * quantum[2]);
        w->rows.slope[3] = w->group[TBX_PLANE].slope[0];
        w->rows.error =
            w->rows.error > w->group[TBX_PLANE].error ? w->rows.error : w->group[TBX_PLANE].error;
    }
}

/* ---- The lattice: places of which PLACES make a voxel */
#define TBX_PLACES_LOG2 12
#define TBX_PLACES ((int64_t)1 << TBX_PLACES_LOG2)

/* x = units * 2^exponent, |units| < 2^61. Returns 0 where it is not that. */
TBX_FN int tbx_units(const double *x, int exponent, int64_t *out_units)
{
    int64_t mantissa;
    const int shift = tbx_split(tbx_bits64(x), &mantissa) - exponent;
    *out_units = 0;
    if (mantissa == 0) {
        return 1;
    }
    if (shift < 0 || shift > 60 || (mantissa < 0 ? -mantissa : mantissa) >> (61 - shift) != 0) {
        return 0;
    }
    *out_units = mantissa * ((int64_t)1 << shift);
    return 1;
}

/* The place of x on axis k, from plane 0. Returns 0 where x is on none, or the numbers span too many bits. */
TBX_FN int tbx_place(const tribox_grid *grid, int k, const double *x, int64_t *out_place)
{
    int64_t size;
    int64_t origin;
    int64_t at;
    const int exponent = tbx_split(tbx_bits64(&grid->size[k]), &size) - TBX_PLACES_LOG2;
    if (!tbx_units(&grid->origin[k], exponent, &origin) || !tbx_units(x, exponent, &at) ||
        (at - origin) % size != 0) {
        return 0;
    }
    *out_place = (at - origin) / size;
    return 1;
}

/* Puts the lines of groups whose axes are on the lattice half a quantum off what touches: with q the quanta
 * of two axes, 1/2 voxel or a power of two below, a line's value is a multiple of q_b q_r / e_r, the plane's
 * one of q_x q_y q_z / n_x. Returns 0 the second time. */
TBX_COLD int tbx_walk_snap(tbx_walk *w)
{
    const tbx_frame *f = w->frame;
    double quantum[3];
    int k;
    if (w->snapped || !w->light) {
        return 0;
    }
    w->snapped = 1;
    for (k = 0; k < 3; k++) {
        const int64_t lo = f->grid->lo[k] * TBX_PLACES;
        int64_t place[3];
        int64_t bits;
        int i;
        quantum[k] = 0.0;
        if (!tbx_place(f->grid, k, &w->corner[0][k], &place[0]) ||
            !tbx_place(f->grid, k, &w->corner[1][k], &place[1]) ||
            !tbx_place(f->grid, k, &w->corner[2][k], &place[2])) {
            continue;
        }
        bits = place[0] | place[1] | place[2] | TBX_PLACES / 2;
        quantum[k] = (double)(bits & -bits) / (double)TBX_PLACES;
        for (i = 0; i < 3; i++) {
            w->x[i][k] = (double)(place[i] - lo) / (double)TBX_PLACES;
            w->e[i][k] = (double)(place[i < 2 ? i + 1 : 0] - place[i]) / (double)TBX_PLACES;
        }
    }
    tbx_walk_set_lines(w, quantum);
    tbx_walk_plane_to_layer(w);
    return 1;
}

/* Narrows lower..upper by line i in a row. */
TBX_FN void tbx_line_narrow(const tbx_lines *l, int i, double row, double *lower, double *upper)
{
    const double along = l->slope[i] * row;
    const double at_lo = l->at_lo[i] + along;
    const double at_hi = l->at_hi[i] + along;
    *lower = at_lo > *lower ? at_lo : *lower;
    *upper = at_hi < *upper ? at_hi : *upper;
}

/* Narrows first..last by `count` lines, 1, 3 or 4, in row r. Returns 0 where they are unsure: a bound lies
 * in *first..*first_most, the other in *last_least..*last. */
TBX_FN int tbx_lines_narrow(const tbx_lines *l, int count, int64_t r, int64_t *first, int64_t *last,
                            int64_t *first_most, int64_t *last_least)
{
    const double row = (double)r;
    const double begin = (double)*first + 1.5;
    const double end = (double)*last + 1.5;
    double lower = begin;
    double upper = end;
    tbx_line_narrow(l, 0, row, &lower, &upper);
    if (count > 1) {
        tbx_line_narrow(l, 1, row, &lower, &upper);
        tbx_line_narrow(l, 2, row, &lower, &upper);
    }
    if (count > 3) {
        tbx_line_narrow(l, 3, row, &lower, &upper);
    }
    lower = lower < end + 1.0 ? lower : end + 1.0;
    upper = upper > begin - 1.0 ? upper : begin - 1.0;
    TBX_KEEP_SCALAR(lower);
    TBX_KEEP_SCALAR(upper);
    *first = (int64_t)(lower - l->error) - 1;
    *first_most = (int64_t)(lower + l->error) - 1;
    *last_least = (int64_t)(upper - l->error) - 1;
    *last = (int64_t)(upper + l->error) - 1;
    return (((*first ^ *first_most) | (*last ^ *last_least)) == 0) | (*first > *last);
}

/* What double leaves unsure of a group in row (y, z); r is the row as this group's lines count it. */
TBX_COLD void tbx_walk_unsure(tbx_walk *w, int group, int64_t r, int64_t y, int64_t z, int64_t *first,
                              int64_t *last)
{
    tbx_bracket at_first;
    tbx_bracket at_last;
    do {
        at_first.least = *first;
        at_first.most = *last + 1;
        at_last.least = *first - 1;
        at_last.most = *last;
        if (w->group[group].error <= TBX_MOST_ERROR &&
            tbx_lines_narrow(&w->group[group], group == TBX_PLANE ? 1 : 3, r, &at_first.least, &at_last.most,
                             &at_first.most, &at_last.least)) {
            *first = at_first.least;
            *last = at_last.most;
            return;
        }
    } while (tbx_walk_snap(w));
    tbx_walk_bisect(w, group, y, z, &at_first, &at_last);
    *first = at_first.least;
    *last = at_last.most;
}

/* Narrows first..last of row (y, z) by a group; r is the row in its lines. */
TBX_FN void tbx_walk_narrow(tbx_walk *w, int group, int64_t r, int64_t y, int64_t z, int64_t *first,
                            int64_t *last)
{
    int64_t at_first = *first;
    int64_t at_last = *last;
    int64_t first_most;
    int64_t last_least;
    if (w->group[group].error <= TBX_MOST_ERROR &&
        tbx_lines_narrow(&w->group[group], group == TBX_PLANE ? 1 : 3, r, &at_first, &at_last, &first_most,
                         &last_least)) {
        *first = at_first;
        *last = at_last;
    } else {
        tbx_walk_unsure(w, group, r, y, z, first, last);
    }
}

/* The triangle's least and greatest coordinate. */
TBX_FN void tbx_walk_extremes(const tbx_walk *w, int k, double *out_least, double *out_most)
{
    *out_least = tbx_min(tbx_min(w->corner[0][k], w->corner[1][k]), w->corner[2][k]);
    *out_most = tbx_max(tbx_max(w->corner[0][k], w->corner[1][k]), w->corner[2][k]);
}

/* The whole index box where numbers are out of range, within the region and the voxels round it. */
TBX_COLD void tbx_walk_box_search(tbx_walk *w)
{
    const tbx_frame *f = w->frame;
    int k;
    w->light = 0;
    for (k = 0; k < 3; k++) {
        const int64_t lo = f->grid->lo[k];
        const int64_t hi = f->grid->hi[k];
        double least;
        double most;
        tbx_walk_extremes(w, k, &least, &most);
        w->whole[k] = tbx_plane_search(f->grid, k, lo + 1, hi + 1, least, f->hi_is_open) - 1 - lo;
        w->more[k] = tbx_plane_search(f->grid, k, lo, hi, most, !f->lo_is_open) - 1 - lo - w->whole[k];
    }
}

/* The least and greatest coordinate on axis k, in fixed point; one or two voxels beyond the region stand for
 * all beyond. */
TBX_FN void tbx_fixed_extremes(const tbx_frame *f, int k, double v0, double v1, double v2, int64_t *out_least,
                               int64_t *out_most)
{
    const double begin = (double)(1 << TBX_FIXED);
    double least = tbx_min3(v0, v1, v2) * f->fixed[k] + f->fixed_lo[k];
    double most = tbx_max3(v0, v1, v2) * f->fixed[k] + f->fixed_lo[k];
    least = least > begin ? least : begin;
    least = least < f->end[k] ? least : f->end[k];
    most = most > begin ? most : begin;
    most = most < f->end[k] ? most : f->end[k];
    TBX_KEEP_SCALAR(least);
    TBX_KEEP_SCALAR(most);
    *out_least = (int64_t)least;
    *out_most = (int64_t)most;
}

/* Whole index boxes where a face may lie on a grid plane: of two voxels in question the plane between them
 * decides. */
TBX_COLD void tbx_walk_box_unsure(tbx_walk *w, const int64_t fixed_least[3], const int64_t fixed_most[3])
{
    const tbx_frame *f = w->frame;
    int k;
    w->box_is_strict = 0;
    for (k = 0; k < 3; k++) {
        const int64_t lo = f->grid->lo[k];
        int64_t first = ((fixed_least[k] + f->slack) >> TBX_FIXED) - TBX_BEFORE;
        int64_t last = ((fixed_most[k] + f->slack) >> TBX_FIXED) - TBX_BEFORE;
        double least;
        double most;
        tbx_walk_extremes(w, k, &least, &most);
        first -= first != ((fixed_least[k] - f->slack) >> TBX_FIXED) - TBX_BEFORE &&
                 tbx_plane_compare(f->grid, k, lo + first, least) >= f->hi_is_open;
        last -= last != ((fixed_most[k] - f->slack) >> TBX_FIXED) - TBX_BEFORE &&
                tbx_plane_compare(f->grid, k, lo + last, most) > -f->lo_is_open;
        w->whole[k] = first;
        w->more[k] = last - first;
    }
}

/* Corners and index box. Returns 0 if the triangle has no points, or no voxel of the region's part lies in
 * its index box. v must live as long as the walk. */
TBX_FN int tbx_walk_box(tbx_walk *w, const tbx_frame *f, double v[3][3], int kind, const tbx_part *part)
{
    w->frame = f;
    w->corner[0] = v[0];
    w->corner[1] = v[1];
    w->corner[2] = v[2];
    w->snapped = 0;
    w->placed = 0;
    w->light = f->on & (kind == TBX_ALL_ORDINARY);
    w->box_is_strict = w->light;
    if (TBX_RARELY(!w->light)) {
        if (kind == TBX_NO_POINTS) {
            return 0;
        }
        tbx_walk_box_search(w);
    } else {
        const int64_t slack = f->slack;
        int64_t least[3];
        int64_t most[3];
        int64_t differ;
        tbx_fixed_extremes(f, 0, v[0][0], v[1][0], v[2][0], &least[0], &most[0]);
        tbx_fixed_extremes(f, 1, v[0][1], v[1][1], v[2][1], &least[1], &most[1]);
        tbx_fixed_extremes(f, 2, v[0][2], v[1][2], v[2][2], &least[2], &most[2]);
        differ = ((least[0] + slack) ^ (least[0] - slack)) | ((most[0] + slack) ^ (most[0] - slack)) |
                 ((least[1] + slack) ^ (least[1] - slack)) | ((most[1] + slack) ^ (most[1] - slack)) |
                 ((least[2] + slack) ^ (least[2] - slack)) | ((most[2] + slack) ^ (most[2] - slack));
        if (TBX_RARELY(differ >> TBX_FIXED != 0)) {
            tbx_walk_box_unsure(w, least, most);
        } else {
            w->whole[0] = (least[0] >> TBX_FIXED) - TBX_BEFORE;
            w->whole[1] = (least[1] >> TBX_FIXED) - TBX_BEFORE;
            w->whole[2] = (least[2] >> TBX_FIXED) - TBX_BEFORE;
            w->more[0] = (most[0] >> TBX_FIXED) - (least[0] >> TBX_FIXED);
            w->more[1] = (most[1] >> TBX_FIXED) - (least[1] >> TBX_FIXED);
            w->more[2] = (most[2] >> TBX_FIXED) - (least[2] >> TBX_FIXED);
        }
    }
    {
        const int64_t x = w->whole[0] + w->more[0];
        const int64_t y = w->whole[1] + w->more[1];
        const int64_t z = w->whole[2] + w->more[2];
        w->first[0] = w->whole[0] > 0 ? w->whole[0] : 0;
        w->first[1] = w->whole[1] > part->first[0] ? w->whole[1] : part->first[0];
        w->first[2] = w->whole[2] > part->first[1] ? w->whole[2] : part->first[1];
        w->last[0] = x < f->last_x ? x : f->last_x;
        w->last[1] = y < part->last[0] ? y : part->last[0];
        w->last[2] = z < part->last[1] ? z : part->last[1];
        return (w->first[0] <= w->last[0]) & (w->first[1] <= w->last[1]) & (w->first[2] <= w->last[2]);
    }
}

TBX_FN void tbx_walk_normal(tbx_walk *w, int a, int b, int c)
{
    if (w->light) {
        const double p = w->e[0][b] * w->e[1][c];
        const double q = w->e[0][c] * w->e[1][b];
        const double n = p - q;
        const double terms = tbx_abs(p) + tbx_abs(q);
        w->n[a] = n;
        w->n_terms[a] = terms;
        w->n_sign[a] = (n > 0.0) - (n < 0.0);
        if (tbx_abs(n) > TBX_NORMAL_ERROR * terms || terms == 0.0 ||
            (w->e[2][b] == 0.0 && w->e[2][c] == 0.0)) {
            if (w->e[2][b] == 0.0 && w->e[2][c] == 0.0) {
                w->n_sign[a] = 0;
            }
            return;
        }
    }
    w->n_sign[a] = tbx_normal_sign_exact(w->corner[0], w->corner[1], w->corner[2], b, c);
}

/* Corners and edges in voxels. */
TBX_FN void tbx_walk_axis(tbx_walk *w, int k)
{
    const tbx_frame *f = w->frame;
    const double v0 = w->corner[0][k];
    const double v1 = w->corner[1][k];
    const double v2 = w->corner[2][k];
    double x0 = v0 - f->origin[k];
    double x1 = v1 - f->origin[k];
    double x2 = v2 - f->origin[k];
    double e0 = v1 - v0;
    double e1 = v2 - v1;
    double e2 = v0 - v2;
    double extent;
    TBX_KEEP_SCALAR(x0);
    TBX_KEEP_SCALAR(x1);
    TBX_KEEP_SCALAR(x2);
    TBX_KEEP_SCALAR(e0);
    TBX_KEEP_SCALAR(e1);
    TBX_KEEP_SCALAR(e2);
    x0 = x0 * f->inverse[k] - f->lo[k];
    x1 = x1 * f->inverse[k] - f->lo[k];
    x2 = x2 * f->inverse[k] - f->lo[k];
    w->x[0][k] = x0;
    w->x[1][k] = x1;
    w->x[2][k] = x2;
    w->e[0][k] = e0 *= f->inverse[k];
    w->e[1][k] = e1 *= f->inverse[k];
    w->e[2][k] = e2 *= f->inverse[k];
    extent = tbx_max3(tbx_abs(e0), tbx_abs(e1), tbx_abs(e2));
    w->extent = extent > w->extent ? extent : w->extent;
    extent += tbx_abs(x0);
    w->delta = extent > w->delta ? extent : w->delta;
}

/* Edges, normals and lines: whatever the index box does not imply. A triangle one voxel thick on two axes
 * touches all of its index box; one that is so on one axis is decided by the edges across that axis. Neither
 * holds for thin. */
TBX_FN void tbx_walk_groups(tbx_walk *w)
{
    const double none[3] = { 0.0, 0.0, 0.0 };
    const unsigned more = (unsigned)((w->more[0] > 0) | (w->more[1] > 0) << 1 | (w->more[2] > 0) << 2);
    const unsigned thick = w->frame->thin || !w->light ? 7u : more;
    int i;
    w->uses[TBX_XY] = (thick & 3u) == 3u;
    w->uses[TBX_XZ] = (thick & 5u) == 5u;
    w->uses[TBX_YZ] = (thick & 6u) == 6u;
    w->uses[TBX_PLANE] = 0;
    /* numbers also where nothing bounds: compilers compute with them before they ask */
    w->plane_at[0] = -TBX_BEYOND;
    w->plane_at[1] = TBX_BEYOND;
    w->plane_slope_z = 0.0;
    for (i = 0; i < 4; i++) {
        w->rows.at_lo[i] = -TBX_BEYOND;
        w->rows.at_hi[i] = TBX_BEYOND;
        w->rows.slope[i] = 0.0;
    }
    w->rows.error = 1.0;
    if ((thick & (thick - 1u)) == 0) {
        return;
    }
    w->group[TBX_XY].error = w->group[TBX_XZ].error = w->group[TBX_YZ].error = w->group[TBX_PLANE].error =
        1.0;
    if (w->light) {
        w->extent = 0.0;
        w->delta = w->frame->reach;
        tbx_walk_axis(w, 0);
        tbx_walk_axis(w, 1);
        tbx_walk_axis(w, 2);
        w->extent += 2.0;
        w->delta *= TBX_COORDINATE_ERROR;
        w->light = w->delta <= TBX_MOST_ERROR;
    }
    if (w->uses[TBX_XY]) {
        tbx_walk_normal(w, 2, 0, 1);
    }
    if (w->uses[TBX_XZ]) {
        tbx_walk_normal(w, 1, 2, 0);
    }
    if (w->uses[TBX_YZ]) {
        tbx_walk_normal(w, 0, 1, 2);
    }
    w->uses[TBX_PLANE] = thick == 7u && w->n_sign[0] != 0 && w->n_sign[1] != 0 && w->n_sign[2] != 0;
    if (w->light) {
        tbx_walk_set_lines(w, none);
    }
}

/* Voxels x0..x1 of a row. */
typedef struct tbx_span {
    int x0;
    int x1;
    int y;
    int z;
} tbx_span;

#define TBX_SPANS 32 /* at once */

/* ---- Boxes of up to 4^3 voxels
 *
 * A triangle lies strictly inside its index box. Where a voxel has a face in common with that box, it may as
 * well reach to infinity across the face: what it shares with the triangle stays the same. A separating axis
 * exists only where the support of such a voxel is finite. That leaves two kinds: the normal of an edge in
 * the plane of axes b and c, where the voxel's corner nearest to the triangle is an inner grid point p of
 * that plane; and the triangle's normal, where it is an inner grid point of space. With v relative to p
 *
 *   E(p) = v_i x v_j    its sign against that of the area: outside of edge i, j?
 *   D(p) = n . v_0      its sign: on which side of the plane?
 *
 * If p is outside of the edge, the one cell at p that is missed is where |E| grows: at p + (s_b, s_c), s =
 * sign(E) * (-d_c, d_b), d = v_j - v_i, the gradient of E. The plane misses exactly one voxel at p, at p +
 * (s_x, s_y, s_z), s = -sign(D) * sign(n). All E and D are affine in p.
 *
 * Bounds, with delta that of the coordinates and n <= 4 voxels on the longest axis, none of which stands for
 * all beyond the region:
 *   E     The coordinates 4 (n - 1) delta. Where the sign of d_c is wrong, |d_c| <= 2 delta; since the
 *         triangle meets the plane c = p_c, |E| is at most |d_c| n then. Rounding is below delta / 8. In all
 *         less than SMALL_EDGE_ERROR delta.
 *   area  The sum of three E at the first point: less than that.
 *   D     The normal's 7 n delta times n, three times; its n^2 times delta, three times: less than
 *         SMALL_PLANE_ERROR delta. The signs of n are those of the areas, and sure.
 * tests/proofs/groups.gappa has the rounding. */
#define TBX_SMALL_EDGE_ERROR 48.0   /* 12 n */
#define TBX_SMALL_PLANE_ERROR 512.0 /* 32 n^2 */

typedef struct tbx_small {
    double v[3][3]; /* from the first inner grid point */
    double least;   /* of |E| and |area| */
    int more[3];
    uint64_t missed; /* voxels, bit x + 4 y + 16 z */
} tbx_small;

/* How far the cell that an edge misses is from the point, in bits: d, of the area's sign. */
TBX_FN int tbx_small_cell(double d_b, double d_c, int up_b, int up_c)
{
    return (d_c > 0.0 ? 1 << up_b : 0) + (d_b < 0.0 ? 1 << up_c : 0);
}

/* The edges in the plane of b and c. Returns twice the area there. free: the bits of all voxels of index 0 on
 * b and c. */
TBX_FN double tbx_small_edges(tbx_small *m, int b, int c, uint64_t free)
{
    const double *v0 = m->v[0];
    const double *v1 = m->v[1];
    const double *v2 = m->v[2];
    const int up_b = 2 * b;
    const int up_c = 2 * c;
    const int more_b = m->more[b];
    const int more_c = m->more[c];
    double e0 = v0[b] * v1[c] - v0[c] * v1[b];
    double e1 = v1[b] * v2[c] - v1[c] * v2[b];
    double e2 = v2[b] * v0[c] - v2[c] * v0[b];
    double least = m->least;
    double area;
    double sign;
    double b0;
    double b1;
    double b2;
    double c0;
    double c1;
    double c2;
    uint64_t missed0 = 0;
    uint64_t missed1 = 0;
    uint64_t missed2 = 0;
    int i;
    int j;
    TBX_KEEP3(SCALAR, e0, e1, e2);
    area = (e0 + e1) + e2;
    sign = area < 0.0 ? -1.0 : 1.0;
    least = tbx_abs(area) < least ? tbx_abs(area) : least;
    e0 *= sign;
    e1 *= sign;
    e2 *= sign;
    b0 = (v1[b] - v0[b]) * sign;
    b1 = (v2[b] - v1[b]) * sign;
    b2 = (v0[b] - v2[b]) * sign;
    c0 = (v1[c] - v0[c]) * sign;
    c1 = (v2[c] - v1[c]) * sign;
    c2 = (v0[c] - v2[c]) * sign;
    for (j = 0; j < more_c; j++) {
        double at0 = e0;
        double at1 = e1;
        double at2 = e2;
        uint64_t cell = free;
        for (i = 0; i < more_b; i++) {
            least = tbx_abs(at0) < least ? tbx_abs(at0) : least;
            least = tbx_abs(at1) < least ? tbx_abs(at1) : least;
            least = tbx_abs(at2) < least ? tbx_abs(at2) : least;
            missed0 |= at0 < 0.0 ? cell : 0;
            missed1 |= at1 < 0.0 ? cell : 0;
            missed2 |= at2 < 0.0 ? cell : 0;
            at0 -= c0;
            at1 -= c1;
            at2 -= c2;
            cell <<= 1 << up_b;
        }
        e0 += b0;
        e1 += b1;
        e2 += b2;
        free <<= 1 << up_c;
    }
    m->missed |= missed0 << tbx_small_cell(b0, c0, up_b, up_c) |
                 missed1 << tbx_small_cell(b1, c1, up_b, up_c) |
                 missed2 << tbx_small_cell(b2, c2, up_b, up_c);
    m->least = least;
    return area;
}

/* The plane with normal n. Returns the least |D|. */
TBX_FN double tbx_small_plane(tbx_small *m, double n_x, double n_y, double n_z)
{
    const int up = (n_x < 0.0) + ((n_y < 0.0) << 2) + ((n_z < 0.0) << 4); /* missed where D > 0 */
    double layer = n_x * m->v[0][0] + n_y * m->v[0][1] + n_z * m->v[0][2];
    double least = tbx_abs(layer);
    int x;
    int y;
    int z;
    for (z = 0; z < m->more[2]; z++) {
        double row = layer;
        for (y = 0; y < m->more[1]; y++) {
            double at = row;
            for (x = 0; x < m->more[0]; x++) {
                const double size = tbx_abs(at);
                least = size < least ? size : least;
                m->missed |= (uint64_t)1 << ((at < 0.0 ? 21 - up : up) + x + 4 * y + 16 * z);
                at -= n_x;
            }
            row -= n_y;
        }
        layer -= n_z;
    }
    return least;
}

#define TBX_EACH_LAYER ((uint64_t)0x00010001u << 32 | 0x00010001u)

/* The voxels that are missed, coordinates being off by delta. Returns 0 where something is not sure. */
TBX_FN int tbx_small_decide(tbx_small *m, double delta)
{
    double least = delta * TBX_SMALL_PLANE_ERROR * 2.0;
    double n[3];
    m->missed = 0;
    m->least = 1.0;
    n[0] = n[1] = n[2] = 0.0;
    if (m->more[0] != 0 && m->more[1] != 0) {
        n[2] = tbx_small_edges(m, 0, 1, TBX_EACH_LAYER);
    }
    if (m->more[1] != 0 && m->more[2] != 0) {
        n[0] = tbx_small_edges(m, 1, 2, 15);
    }
    if (m->more[2] != 0 && m->more[0] != 0) {
        n[1] = tbx_small_edges(m, 2, 0, 0x1111);
    }
    if (m->more[0] != 0 && m->more[1] != 0 && m->more[2] != 0) {
        least = tbx_small_plane(m, n[0], n[1], n[2]);
    }
    return m->least > delta * TBX_SMALL_EDGE_ERROR && least > delta * TBX_SMALL_PLANE_ERROR;
}

/* Finds the voxels that the triangle misses of its index box. Returns 0 where it is too large, or something
 * unsure. */
TBX_NOINLINE int tbx_walk_small(const tbx_walk *w, uint64_t *out_missed)
{
    const tbx_frame *f = w->frame;
    tbx_small m;
    int k;
    *out_missed = 0;
    if ((w->light == 0) | f->thin | (((w->more[0] | w->more[1] | w->more[2]) & ~(int64_t)3) != 0)) {
        return 0;
    }
    if ((w->more[0] != 0) + (w->more[1] != 0) + (w->more[2] != 0) <= 1) {
        return 1;
    }
    if (!w->box_is_strict) {
        return 0;
    }
    /* voxels two before the region and one after it stand for all beyond: such a corner may lie anywhere */
    for (k = 0; k < 3; k++) {
        if (w->whole[k] < -1 || w->whole[k] + w->more[k] > (int64_t)f->grid->hi[k] - f->grid->lo[k]) {
            return 0;
        }
    }
    for (k = 0; k < 3; k++) {
        const double at = f->lo[k] + (double)(w->whole[k] + 1);
        double x0 = w->corner[0][k] - f->origin[k];
        double x1 = w->corner[1][k] - f->origin[k];
        double x2 = w->corner[2][k] - f->origin[k];
        TBX_KEEP3(SCALAR, x0, x1, x2);
        m.v[0][k] = x0 * f->inverse[k] - at;
        m.v[1][k] = x1 * f->inverse[k] - at;
        m.v[2][k] = x2 * f->inverse[k] - at;
        m.more[k] = (int)w->more[k];
    }
    if (!tbx_small_decide(&m, TBX_COORDINATE_ERROR * f->reach)) {
        return 0;
    }
    *out_missed = m.missed;
    return 1;
}

/* Takes the lowest row off voxels, bit x + 4 y + 16 z from `first` on. It has no gaps. */
TBX_FN void tbx_next_row(tbx_span *out, uint64_t *voxels, const int first[3])
{
    const int at = tbx_lowest_bit(*voxels);
    const uint64_t row = *voxels >> at & 15u >> (at & 3);
    out->x0 = first[0] + (at & 3);
    out->x1 = out->x0 + tbx_lowest_bit(~row) - 1;
    out->y = first[1] + (at >> 2 & 3);
    out->z = first[2] + (at >> 4);
    *voxels &= ~(uint64_t)0 << (at | 3) << 1;
}

/* The voxels of a box with so many after its first, bits x + 4 y + 16 z: those of y and z given as bits. */
TBX_FN uint64_t tbx_small_box(int more_x, int bits_y, int bits_z)
{
    return (((uint64_t)2 << more_x) - 1) * (0x1111u >> (12 - bits_y)) * (TBX_EACH_LAYER >> (48 - bits_z));
}

/* The spans of a small box within the region, at most 16. */
TBX_NOINLINE int tbx_small_spans(const tbx_walk *w, uint64_t missed, tbx_span *out)
{
    uint64_t voxels = ~missed;
    int more[3];
    int first[3];
    int n = 0;
    int k;
    for (k = 0; k < 3; k++) {
        voxels >>= (w->first[k] - w->whole[k]) << 2 * k;
        more[k] = (int)(w->last[k] - w->first[k]);
        first[k] = (int)(w->frame->grid->lo[k] + w->first[k]);
    }
    voxels &= tbx_small_box(more[0], 4 * more[1], 16 * more[2]);
    while (voxels != 0) {
        tbx_next_row(&out[n++], &voxels, first);
    }
    return n;
}

/* Goes to the next layer. */
TBX_FN void tbx_walk_layer(tbx_walk *w)
{
    const int64_t z = ++w->z;
    w->y = w->first[1];
    w->y_last = w->last[1];
    w->layer_first = w->first[0];
    w->layer_last = w->last[0];
    if (w->uses[TBX_XZ]) {
        tbx_walk_narrow(w, TBX_XZ, z, 0, z, &w->layer_first, &w->layer_last);
        if (w->layer_first > w->layer_last) {
            w->y_last = w->y - 1;
            return;
        }
    }
    if (w->uses[TBX_YZ]) {
        tbx_walk_narrow(w, TBX_YZ, z, 0, z, &w->y, &w->y_last);
    }
    if (w->uses[TBX_PLANE]) {
        tbx_walk_plane_to_layer(w);
    }
}

/* Makes ready for the first row. */
TBX_NOINLINE void tbx_walk_set_out(tbx_walk *w)
{
    int i;
    tbx_walk_groups(w);
    for (i = 0; i < TBX_CACHED && i <= w->last[1] - w->first[1]; i++) {
        w->row[(w->first[1] + i) % TBX_CACHED].y = -1;
    }
    w->z = w->first[2] - 1;
    w->y = 0;
    w->y_last = -1;
}

/* The voxels first..last of a row in the walk's layer, group by group, where they are not sure at once. */
TBX_COLD void tbx_walk_row_unsure(tbx_walk *w, int64_t y, int64_t *first, int64_t *last)
{
    *first = w->layer_first;
    *last = w->layer_last;
    if (w->uses[TBX_XY]) {
        tbx_row *row = &w->row[y % TBX_CACHED];
        if (row->y != y) {
            row->y = y;
            row->first = w->first[0];
            row->last = w->last[0];
            tbx_walk_narrow(w, TBX_XY, y, y, 0, &row->first, &row->last);
        }
        *first = row->first > *first ? row->first : *first;
        *last = row->last < *last ? row->last : *last;
    }
    if (w->uses[TBX_PLANE] && *first <= *last) {
        tbx_walk_narrow(w, TBX_PLANE, y, y, w->z, first, last);
    }
}

/* Adds spans of the layer's next rows to n that there are. Returns how many there are then, up to SPANS. */
TBX_FN int tbx_walk_rows(tbx_walk *w, tbx_span *out, int n)
{
    const int *lo = w->frame->grid->lo;
    const int bounded = w->uses[TBX_XY] | w->uses[TBX_PLANE];
    const int64_t y_last = w->y_last;
    int64_t y;
    for (y = w->y; y <= y_last && n < TBX_SPANS; y++) {
        int64_t first = w->layer_first;
        int64_t last = w->layer_last;
        int64_t first_most;
        int64_t last_least;
        if (bounded &&
            (TBX_RARELY(!(w->rows.error <= TBX_MOST_ERROR)) ||
             TBX_RARELY(!tbx_lines_narrow(&w->rows, 4, y, &first, &last, &first_most, &last_least)))) {
            tbx_walk_row_unsure(w, y, &first_most, &last_least);
            first = first_most;
            last = last_least;
        }
        if (first <= last) {
            out[n].x0 = (int)(lo[0] + first);
            out[n].x1 = (int)(lo[0] + last);
            out[n].y = (int)(lo[1] + y);
            out[n].z = (int)(lo[2] + w->z);
            n++;
        }
    }
    w->y = y;
    return n;
}

/* The next spans, up to SPANS. Fewer: these were the last. */
TBX_NOINLINE int tbx_walk_next(tbx_walk *w, tbx_span *out)
{
    int n = 0;
    while (n < TBX_SPANS) {
        while (w->y > w->y_last) {
            if (w->z >= w->last[2]) {
                return n;
            }
            tbx_walk_layer(w);
        }
        n = tbx_walk_rows(w, out, n);
    }
    return n;
}

/* The first spans after tbx_walk_box, as tbx_walk_next. */
TBX_NOINLINE int tbx_walk_begin(tbx_walk *w, tbx_span *out)
{
    uint64_t missed;
    if (tbx_walk_small(w, &missed)) {
        return tbx_small_spans(w, missed, out);
    }
    tbx_walk_set_out(w);
    return tbx_walk_next(w, out);
}

TBX_FN void tbx_part_all(tbx_part *part, const tribox_grid *grid)
{
    part->first[0] = part->first[1] = 0;
    part->last[0] = (int64_t)grid->hi[1] - 1 - grid->lo[1];
    part->last[1] = (int64_t)grid->hi[2] - 1 - grid->lo[2];
}

/* The spans of one triangle, its corners' kind given. */
TBX_FN size_t tbx_spans(const tribox_grid *grid, double v[3][3], int kind, tribox_span_fn on_span, void *user)
{
    tbx_frame f;
    tbx_part all;
    tbx_walk w;
    tbx_span span[TBX_SPANS];
    size_t count = 0;
    int n;
    if (!tbx_frame_init(&f, grid)) {
        return 0;
    }
    tbx_part_all(&all, grid);
    if (!tbx_walk_box(&w, &f, v, kind, &all)) {
        return 0;
    }
    n = tbx_walk_begin(&w, span);
    for (;;) {
        int i;
        for (i = 0; i < n; i++) {
            count = tbx_saturating_add(count, (size_t)((unsigned)span[i].x1 - (unsigned)span[i].x0) + 1);
            if (on_span != NULL) {
                on_span(user, span[i].x0, span[i].x1, span[i].y, span[i].z);
            }
        }
        if (n < TBX_SPANS) {
            return count;
        }
        n = tbx_walk_next(&w, span);
    }
}

#if TRIBOX_SIMD /* section 11.3 */
/* Tells the spans of a small box's voxels. Returns how many voxels they are. */
TBX_FN size_t tbx_small_tell(uint64_t voxels, const int first[3], tribox_span_fn on_span, void *user)
{
    size_t count = 0;
    if (on_span == NULL) { /* bits in pairs, in fours, in eights, then all */
        voxels -= voxels >> 1 & 0x5555 * TBX_EACH_LAYER;
        voxels = (voxels & 0x3333 * TBX_EACH_LAYER) + (voxels >> 2 & 0x3333 * TBX_EACH_LAYER);
        voxels = (voxels + (voxels >> 4)) & 0x0f0f * TBX_EACH_LAYER;
        return (size_t)(voxels * (0x0101 * TBX_EACH_LAYER) >> 56);
    }
    while (voxels != 0) {
        tbx_span span;
        tbx_next_row(&span, &voxels, first);
        count += (size_t)(span.x1 - span.x0) + 1;
        on_span(user, span.x0, span.x1, span.y, span.z);
    }
    return count;
}
#endif

TRIBOX_FN size_t tribox_grid_spans_f64(const tribox_grid *grid, const double v0[3], const double v1[3],
                                       const double v2[3], tribox_span_fn on_span, void *user)
{
    double v[3][3];
    int k;
#if TRIBOX_SIMD
    int first[4];
    const uint64_t voxels = tbx_lone_find_f64(first, grid, v0, v1, v2);
    if (voxels != 0) {
        return tbx_small_tell(voxels, first, on_span, user);
    }
#endif
    for (k = 0; k < 3; k++) {
        v[0][k] = v0[k];
        v[1][k] = v1[k];
        v[2][k] = v2[k];
    }
    return tbx_spans(grid, v, tbx_corners_kind(v), on_span, user);
}

TRIBOX_FN size_t tribox_grid_spans(const tribox_grid *grid, const float v0[3], const float v1[3],
                                   const float v2[3], tribox_span_fn on_span, void *user)
{
    double v[3][3];
    int finite;
#if TRIBOX_SIMD
    int first[4];
    const uint64_t voxels = tbx_lone_find(first, grid, v0, v1, v2);
    if (voxels != 0) {
        return tbx_small_tell(voxels, first, on_span, user);
    }
#endif
    finite = tbx_read_floats(v[0], v0) & tbx_read_floats(v[1], v1) & tbx_read_floats(v[2], v2);
    return tbx_spans(grid, v, finite ? TBX_ALL_ORDINARY : TBX_NO_POINTS, on_span, user);
}

/* Adds up spans of one triangle and tells them. */
TBX_FN void tbx_tell(const tbx_span *span, int n, size_t triangle, tribox_mesh_span_fn on_span, void *user,
                     size_t *count)
{
    int i;
    for (i = 0; i < n; i++) {
        *count = tbx_saturating_add(*count, (size_t)((unsigned)span[i].x1 - (unsigned)span[i].x0) + 1);
        if (on_span != NULL) {
            on_span(user, triangle, span[i].x0, span[i].x1, span[i].y, span[i].z);
        }
    }
}

/* A walk and what it finds. */
typedef struct tbx_walked {
    tbx_walk walk;
    tbx_span span[TBX_SPANS];
    double v[3][3];
} tbx_walked;

/* The first spans of triangle t. */
TBX_NOINLINE int tbx_walked_begin(tbx_walked *w, const tbx_frame *f, const tbx_source *source, size_t t)
{
    tbx_part all;
    tbx_part_all(&all, f->grid);
    return tbx_walk_box(&w->walk, f, w->v, tbx_source_triangle(source, t, w->v), &all)
               ? tbx_walk_begin(&w->walk, w->span)
               : 0;
}

/* The spans of all triangles, one after the other. */
TBX_FN size_t tbx_mesh_spans(const tribox_grid *grid, const tbx_source *source, tribox_mesh_span_fn on_span,
                             void *user)
{
    tbx_frame f;
    tbx_walked w;
    size_t count = 0;
    size_t t;
    if (!tbx_frame_init(&f, grid)) {
        return 0;
    }
    t = TBX_EITHER(tbx_mesh_spans_quick(&f, source, on_span, user, &count), 0);
    for (; t < source->triangles; t++) {
        int n = tbx_walked_begin(&w, &f, source, t);
        while (n > 0) {
            tbx_tell(w.span, n, t, on_span, user, &count);
            n = n < TBX_SPANS ? 0 : tbx_walk_next(&w.walk, w.span);
        }
    }
    return count;
}

TRIBOX_FN size_t tribox_mesh_spans(const tribox_grid *grid, const tribox_mesh *mesh,
                                   tribox_mesh_span_fn on_span, void *user)
{
    const tbx_source source = tbx_source_float(mesh);
    return tbx_mesh_spans(grid, &source, on_span, user);
}

TRIBOX_FN size_t tribox_mesh_spans_f64(const tribox_grid *grid, const tribox_mesh_f64 *mesh,
                                       tribox_mesh_span_fn on_span, void *user)
{
    const tbx_source source = tbx_source_double(mesh);
    return tbx_mesh_spans(grid, &source, on_span, user);
}

TRIBOX_FN size_t tribox_grid_words(const tribox_grid *grid)
{
    const size_t most = (size_t)-1 / sizeof(uint64_t);
    size_t words;
    int k;
    if (!tbx_grid_valid(grid)) {
        return 0;
    }
    words = (size_t)(((uint64_t)((int64_t)grid->hi[0] - grid->lo[0]) + 63) / 64);
    for (k = 1; k < 3; k++) {
        const uint64_t n = (uint64_t)((int64_t)grid->hi[k] - grid->lo[k]);
        if (n > most / words) {
            return 0;
        }
        words *= (size_t)n;
    }
    return words;
}

/* ---- 9. Fill, solid, fit, get and locate -------------------------------------------------------------- */

/* Places: coordinates in voxels from the region's first plane (fill) or first centre (solid), FIXED added.
 * Within 2^22 voxels a place's whole part stands in its double's upper bits, and the rest in the lower 28, in
 * steps of 2^-28. So integers tell what lies between two places, without a conversion.
 *
 * Error, with o = |origin / size| and l = |lo| + n + 2^22, so that |v / size| is at most o + l: 5 u for v *
 * inverse (a division may be off by 4 u), 5 u for origin * inverse, 1 u for each of its two sums: less than
 * PLACE_ERROR times o + l; and a step for each sum with FIXED. A subnormal corner may be read as 0: that is
 * 2^-26 voxels or less, sizes being 2^-100 or more. What lies farther off has a place that does, too: each
 * operation is monotone. */
#define TBX_PLACE_ERROR (16.0 * TBX_U64)
#define TBX_PLACE_BITS 28
#define TBX_PLACE_STEP (1.0 / 268435456.0)
#define TBX_PLACE_FIXED 25165824.0                /* 3 * 2^23 */
#define TBX_PLACE_OF_0 ((int64_t)0x41780000 * 16) /* its upper bits */

typedef struct tbx_places {
    double inverse[3]; /* v * inverse + base */
    double base[3];
    int64_t last[3]; /* the region's last plane or centre */
    double error;
    uint64_t slack; /* the error in steps */
    int on;         /* 0: numbers are out of range */
} tbx_places;

/* first: 0 for planes, 1/2 for centres. */
TBX_FN void tbx_places_set(tbx_places *p, const tribox_grid *grid, double first)
{
    double farthest = 0.0;
    int k;
    p->on = TBX_DOUBLE_IS_53_BITS;
    for (k = 0; k < 3; k++) {
        const int on = tbx_is_ordinary(&grid->origin[k], TBX_ORDINARY) &
                       tbx_in_range(&grid->size[k], -100, TBX_ORDINARY);
        const double lo = (double)grid->lo[k];
        double size = on ? grid->size[k] : 1.0;
        double origin = on ? grid->origin[k] : 0.0;
        TBX_KEEP2(SCALAR, size, origin);
        p->last[k] = (int64_t)grid->hi[k] - 1 - grid->lo[k];
        p->inverse[k] = 1.0 / size;
        origin *= p->inverse[k];
        p->base[k] = TBX_PLACE_FIXED - (origin + (lo + first));
        p->on &= on & (p->last[k] < 2097152);
        origin = tbx_abs(origin) + tbx_abs(lo) + (double)p->last[k] + 1.0;
        farthest = origin > farthest ? origin : farthest;
    }
    farthest = (farthest + 4194304.0) * TBX_PLACE_ERROR + 4.0 * TBX_PLACE_STEP;
    p->on &= farthest < 0.125;
    p->error = farthest < 0.125 ? farthest : 1.0;
    p->slack = (uint64_t)tbx_to_long(p->error / TBX_PLACE_STEP);
}

/* A triangle's corners in memory. */
typedef struct tbx_vertices {
    const char *at[3];
    int is_double;
} tbx_vertices;

TBX_FORCED void tbx_vertices_find(tbx_vertices *c, const tbx_source *source, size_t t, int is_double)
{
    c->at[0] = tbx_source_at(source, t, 0);
    c->at[1] = tbx_source_at(source, t, 1);
    c->at[2] = tbx_source_at(source, t, 2);
    c->is_double = is_double;
}

/* Top bits: does a float, or each of two, have an exponent of ones? */
TBX_FORCED uint32_t tbx_float_beyond(const char *x)
{
    uint32_t bits;
    TBX_COPY(&bits, x, sizeof bits);
    return (tbx_opaque32(bits) & 0x7fffffffu) + 0x00800000u;
}

TBX_FORCED uint64_t tbx_floats_beyond(const char *x)
{
    uint64_t bits;
    TBX_COPY(&bits, x, sizeof bits);
    return (tbx_opaque64(bits) & 0x7fffffff7fffffffu) + 0x0080000000800000u;
}

TBX_FORCED int tbx_double_beyond(const char *x)
{
    double d;
    TBX_COPY(&d, x, sizeof d);
    return !tbx_is_ordinary(&d, TBX_ORDINARY);
}

/* Can coordinates on axis k, and one more if count is 2, be computed with: finite floats, ordinary doubles?
 * No compiler computes with them before that is known. */
TBX_FORCED int tbx_vertices_fit(tbx_vertices *c, int k, int count)
{
    int beyond;
    if (c->is_double) {
        const size_t at = (size_t)k * sizeof(double);
        const size_t end = at + (size_t)(count - 1) * sizeof(double);
        beyond = tbx_double_beyond(c->at[0] + at) | tbx_double_beyond(c->at[1] + at) |
                 tbx_double_beyond(c->at[2] + at) | tbx_double_beyond(c->at[0] + end) |
                 tbx_double_beyond(c->at[1] + end) | tbx_double_beyond(c->at[2] + end);
    } else if (count == 1) {
        const size_t at = (size_t)k * sizeof(float);
        beyond = ((tbx_float_beyond(c->at[0] + at) | tbx_float_beyond(c->at[1] + at) |
                   tbx_float_beyond(c->at[2] + at)) &
                  0x80000000u) != 0;
    } else {
        const size_t at = (size_t)k * sizeof(float);
        beyond = ((tbx_floats_beyond(c->at[0] + at) | tbx_floats_beyond(c->at[1] + at) |
                   tbx_floats_beyond(c->at[2] + at)) &
                  0x8000000080000000u) != 0;
    }
    TBX_KEEP3(POINTER, c->at[0], c->at[1], c->at[2]);
    return !beyond;
}

TBX_FORCED double tbx_vertices_place1(const tbx_vertices *c, const tbx_places *p, int i, int k)
{
    double x;
    if (c->is_double) {
        TBX_COPY(&x, c->at[i] + (size_t)k * sizeof x, sizeof x);
    } else {
        float f;
        TBX_COPY(&f, c->at[i] + (size_t)k * sizeof f, sizeof f);
        x = (double)f;
    }
    return x * p->inverse[k] + p->base[k];
}

/* Their places on axis k. */
TBX_FORCED void tbx_vertices_place(const tbx_vertices *c, const tbx_places *p, int k, double at[3])
{
    at[0] = tbx_vertices_place1(c, p, 0, k);
    at[1] = tbx_vertices_place1(c, p, 1, k);
    at[2] = tbx_vertices_place1(c, p, 2, k);
}

/* The whole parts of the least and the greatest of three places. Returns 0 where one is not sure. A negative
 * place, 2^24 voxels before the region or more, has a whole part behind all others. */
TBX_FORCED int tbx_places_range(const tbx_places *p, const double at[3], int64_t out_range[2])
{
    const double least = tbx_min3(at[0], at[1], at[2]);
    const double most = tbx_max3(at[0], at[1], at[2]);
    const uint64_t first = tbx_bits64(&least);
    const uint64_t last = tbx_bits64(&most);
    const uint64_t differ =
        ((first - p->slack) ^ (first + p->slack)) | ((last - p->slack) ^ (last + p->slack));
    out_range[0] = (int64_t)(first >> TBX_PLACE_BITS) - TBX_PLACE_OF_0;
    out_range[1] = (int64_t)(last >> TBX_PLACE_BITS) - TBX_PLACE_OF_0;
    return differ >> TBX_PLACE_BITS == 0;
}

/* The bit array of a fill. */
typedef struct tbx_target {
    uint64_t *bits;
    size_t row_words;
    size_t ny;
} tbx_target;

/* Sets bits from..to of a row. */
TBX_FN void tbx_set_run(const tbx_target *t, uint64_t *row, size_t from, size_t to)
{
    const uint64_t head = ~(uint64_t)0 << (from & 63);
    const uint64_t tail = ~(uint64_t)0 >> (63 - (to & 63));
    size_t word = from >> 6;
    const size_t last = to >> 6;
    /* the next layer's */
    TBX_PREFETCH((uintptr_t)(row + word) + sizeof *row * t->ny * t->row_words);
    if (word == last) {
        row[word] |= head & tail;
        return;
    }
    row[word++] |= head;
    while (word < last) {
        row[word++] = ~(uint64_t)0;
    }
    row[last] |= tail;
}

/* A part of one triangle. */
TBX_NOINLINE void tbx_fill_triangle(const tbx_frame *f, const tbx_source *source, size_t triangle,
                                    const tbx_part *part, const tbx_target *target)
{
    const int *lo = f->grid->lo;
    tbx_walk w;
    tbx_span span[TBX_SPANS];
    double v[3][3];
    int n;
    if (!tbx_walk_box(&w, f, v, tbx_source_triangle(source, triangle, v), part)) {
        return;
    }
    n = tbx_walk_begin(&w, span);
    while (n > 0) {
        int i;
        for (i = 0; i < n; i++) {
            const size_t y = (size_t)((int64_t)span[i].y - lo[1]);
            const size_t z = (size_t)((int64_t)span[i].z - lo[2]);
            tbx_set_run(target, target->bits + (z * target->ny + y) * target->row_words,
                        (size_t)((int64_t)span[i].x0 - lo[0]), (size_t)((int64_t)span[i].x1 - lo[0]));
        }
        n = n < TBX_SPANS ? 0 : tbx_walk_next(&w, span);
    }
}

/* The power of two at or below x, x positive and normal. */
TBX_FN double tbx_floor_pow2(double x)
{
    return tbx_from_bits64(tbx_bits64(&x) & 0x7ff0000000000000u);
}

/* The multiple of q, a power of two, at or below x; x itself where its own spacing is no finer. */
TBX_FN double tbx_floor_to(double x, double q)
{
    double units;
    double whole;
    if ((tbx_bits64(&x) >> 52 & 0x7ffu) >= (tbx_bits64(&q) >> 52) + 52) {
        return x;
    }
    TBX_KEEP_SCALAR(q); /* a product: -ffast-math would divide by one factor after the other, to infinity */
    units = x / q;
    TBX_KEEP_SCALAR(units);
    whole = (double)tbx_to_long(units);
    return (whole > units ? whole - 1.0 : whole) * q;
}

/* Sets what a triangle touches of its box of up to 4^3 voxels, in which it lies strictly. Returns 0 where
 * that is not sure. */
TBX_NOINLINE int tbx_fill_box(const tbx_places *p, const tbx_vertices *c, const int64_t first[3],
                              const int64_t more[3], const tbx_target *target)
{
    const int shift = (int)(first[0] & 63);
    const uint64_t here = 15u >> (3 - more[0]);
    tbx_small m;
    int64_t y;
    int64_t z;
    int k;
    TBX_UNROLL
    for (k = 0; k < 3; k++) {
        const double inner = TBX_PLACE_FIXED + (double)(first[k] + 1);
        m.v[0][k] = tbx_vertices_place1(c, p, 0, k) - inner;
        m.v[1][k] = tbx_vertices_place1(c, p, 1, k) - inner;
        m.v[2][k] = tbx_vertices_place1(c, p, 2, k) - inner;
        m.more[k] = (int)more[k];
    }
    if (!tbx_small_decide(&m, p->error)) {
        return 0;
    }
    for (z = 0; z <= more[2]; z++) {
        uint64_t *row = target->bits + (first[0] >> 6) +
                        ((size_t)(first[2] + z) * target->ny + (size_t)first[1]) * target->row_words;
        for (y = 0; y <= more[1]; y++, row += target->row_words) {
            const uint64_t run = ~m.missed >> (4 * y + 16 * z) & here;
            row[0] |= run << shift;
            if (shift + more[0] > 63) {
                row[1] |= run >> (64 - shift);
            }
        }
    }
    return 1;
}

/* Most triangles of a fine mesh have a box of few voxels: the triangle lies strictly within it, and the box
 * within the region. One voxel, or two, are the triangle's; up to 4^3 are decided as in section 8. Returns 0,
 * nothing set, where this is not so, or not sure. Not for the thin rule. */
TBX_FORCED int tbx_fill_few(const tbx_places *p, const tbx_source *source, size_t t, int is_double,
                            const tbx_target *target)
{
    tbx_vertices c;
    double at[3];
    int64_t x[2];
    int64_t y[2];
    int64_t z[2];
    int64_t first[3];
    int64_t more[3];
    int sure;
    tbx_vertices_find(&c, source, t, is_double);
    if (!(tbx_vertices_fit(&c, 0, 2) & tbx_vertices_fit(&c, 2, 1))) {
        return 0;
    }
    tbx_vertices_place(&c, p, 0, at);
    sure = tbx_places_range(p, at, x);
    tbx_vertices_place(&c, p, 1, at);
    sure &= tbx_places_range(p, at, y);
    tbx_vertices_place(&c, p, 2, at);
    sure &= tbx_places_range(p, at, z);
    first[0] = x[0];
    first[1] = y[0];
    first[2] = z[0];
    more[0] = x[1] - x[0];
    more[1] = y[1] - y[0];
    more[2] = z[1] - z[0];
    if (!sure || (more[0] | more[1] | more[2]) < 0) {
        return 0;
    }
    if ((x[0] | y[0] | z[0] | (p->last[0] - x[1]) | (p->last[1] - y[1]) | (p->last[2] - z[1])) < 0) {
        return (x[1] | y[1] | z[1] | (p->last[0] - x[0]) | (p->last[1] - y[0]) | (p->last[2] - z[0])) < 0;
    }
    if (more[0] + more[1] + more[2] <= 1 && (x[0] & 63) + more[0] < 64) {
        const size_t layer = target->row_words * target->ny;
        const uint64_t run = (uint64_t)(1 + 2 * more[0]) << (x[0] & 63);
        uint64_t *row =
            target->bits + layer * (size_t)z[0] + target->row_words * (size_t)y[0] + ((size_t)x[0] >> 6);
        *row |= run;
        row[target->row_words * (size_t)more[1] + layer * (size_t)more[2]] |= run;
        return 1;
    }
    return ((more[0] | more[1] | more[2]) & ~(int64_t)3) == 0 && tbx_fill_box(p, &c, first, more, target);
}

TBX_FN void tbx_fill_mesh(const tribox_grid *grid, const tbx_source *source, uint64_t *bits)
{
    tbx_target target;
    tbx_frame f;
    tbx_part all;
    tbx_places places;
    size_t t;
    if (tribox_grid_words(grid) == 0 || !tbx_frame_init(&f, grid)) {
        return;
    }
    target.bits = bits;
    target.row_words = (size_t)(((int64_t)grid->hi[0] - grid->lo[0] + 63) / 64);
    target.ny = (size_t)((int64_t)grid->hi[1] - grid->lo[1]);
    tbx_part_all(&all, grid);
    t = TBX_EITHER(tbx_fill_quick(&f, source, &target), 0);
    tbx_places_set(&places, grid, 0.0);
    places.on &= !f.thin;
    for (; t < source->triangles; t++) {
        if (!(places.on && (source->is_double ? tbx_fill_few(&places, source, t, 1, &target)
                                              : tbx_fill_few(&places, source, t, 0, &target)))) {
            tbx_fill_triangle(&f, source, t, &all, &target);
        }
    }
}

TRIBOX_FN void tribox_grid_fill(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits)
{
    const tbx_source source = tbx_source_float(mesh);
    tbx_fill_mesh(grid, &source, bits);
}

TRIBOX_FN void tribox_grid_fill_f64(const tribox_grid *grid, const tribox_mesh_f64 *mesh, uint64_t *bits)
{
    const tbx_source source = tbx_source_double(mesh);
    tbx_fill_mesh(grid, &source, bits);
}

/* ---- Solid
 *
 * A ray from c toward -x crosses a triangle iff, for c + (e, e^2, e^3) and every small enough e > 0, it meets
 * the triangle's inner part. Seen along x, in the plane of y and z, the triangle has edges
 * d_i = v_{i+1} - v_i and, s being the sign of n_x, inward normals w_i = s (-d_z, d_y). c lies behind edge i
 * iff s E_i > 0, E_i = d_i x (c - v_i), or E_i = 0 and the shift (e^2, e^3) leads inward: w_y > 0, or w_y = 0
 * and w_z > 0. It lies on or beyond the triangle iff s n.(c - v0) >= 0: at 0 the shift e in x leads beyond.
 * An edge takes the same shift for both of its triangles, and goes to one of them: no row can leak. */

/* The rule, every sign exact; row MID of f is c, and so are LO and HI. */
TBX_COLD int tbx_crosses_exact(tbx_exact *f)
{
    const int q[3] = { TBX_MID, TBX_MID, TBX_MID };
    int s;
    int i;
    tbx_exact_finish(f);
    s = tbx_orient2(f, 1, 2, 0, 1, 2, 2);
    for (i = 0; i < 3; i++) {
        const int side = s * tbx_orient2(f, 1, 2, i, (i + 1) % 3, TBX_MID, TBX_MID);
        const int w_y = -s * tbx_edge_sign(f, i, 2);
        const int w_z = s * tbx_edge_sign(f, i, 1);
        if ((side != 0 ? side : w_y != 0 ? w_y : w_z) <= 0) {
            return 0;
        }
    }
    return s * tbx_orient3(f, q) >= 0;
}

/* Rows MID, LO and HI of axis k. */
TBX_FN void tbx_exact_point(tbx_exact *f, int k, double base, double step, int64_t half)
{
    f->x[TBX_LO][k] = f->x[TBX_MID][k] = f->x[TBX_HI][k] = tbx_at(&base, &step, half);
}

/* Below 2^150, 0 included. Products of three such numbers, and sums of those, are far from overflow; what
 * underflow takes (2^-1022 of a coordinate, or of a product) is, after two more factors, below TINY. */
#define TBX_SOLID_TINY TBX_POW2(-700) /* 2^-700 > 8 * 2^(-1022 + 2 * 151) */

TBX_FN int tbx_solid_in_range(const double *x)
{
    return (tbx_bits64(x) & 0x7fffffffffffffffu) < (uint64_t)(1023 + 150) << 52;
}

/* u = 2^-52; where doubles may be rounded otherwise there is no filter. t_i = v_i - p is off by u of itself;
 * E_i = t_i x t_{i+1}, a sum of two products, by (2 + 1 + 1) u of their magnitudes; E_0 + E_1 + E_2 = n_x. So
 * where all E_i are sure and of one sign, p is within, and s n.(p - v0) = -sum of t_i.x |E_{i+1}|, since
 * n.t0 = t0.(t1 x t2): off by (4 + 1 + 1 + 2) u. Bounds of this section: tests/proofs/solid.gappa. */
#define TBX_CROSS_EDGE_ERROR (6.0 * TBX_U64)
#define TBX_CROSS_PLANE_ERROR (10.0 * TBX_U64)

/* 1 and 0 as the rule, -1 unsure. */
TBX_FN int tbx_crosses_filter(double v[3][3], const double p[3])
{
    double t[3][3];
    double e[3];
    double m[3];
    double value = 0.0;
    double error = TBX_SOLID_TINY;
    int positive = 0;
    int negative = 0;
    int fits = TBX_DOUBLE_IS_53_BITS;
    int i;
    int k;
    for (k = 0; k < 3; k++) {
        fits &= tbx_solid_in_range(p + k);
        for (i = 0; i < 3; i++) {
            fits &= tbx_solid_in_range(&v[i][k]);
        }
    }
    if (!fits) {
        return -1;
    }
    for (i = 0; i < 3; i++) {
        for (k = 0; k < 3; k++) {
            t[i][k] = v[i][k] - p[k];
        }
    }
    TBX_KEEP(t);
    for (i = 0; i < 3; i++) {
        const double *a = t[i < 2 ? i + 1 : 0];
        const double *b = t[i < 1 ? 2 : i - 1]; /* e[i] is E_{i+1}, beside t_i */
        const double forth = a[1] * b[2];
        const double back = a[2] * b[1];
        e[i] = forth - back;
        m[i] = tbx_abs(forth) + tbx_abs(back);
        positive += e[i] > m[i] * TBX_CROSS_EDGE_ERROR + TBX_SOLID_TINY;
        negative += e[i] < -(m[i] * TBX_CROSS_EDGE_ERROR + TBX_SOLID_TINY);
    }
    if (positive != 3 && negative != 3) {
        return positive != 0 && negative != 0 ? 0 : -1;
    }
    for (i = 0; i < 3; i++) {
        value -= t[i][0] * tbx_abs(e[i]);
        error += tbx_abs(t[i][0]) * m[i] * TBX_CROSS_PLANE_ERROR;
    }
    return value > error ? 1 : value < -error ? 0 : -1;
}

TBX_COLD int tbx_crosses_unsure(double v[3][3], const double p[3])
{
    tbx_exact f;
    int k;
    tbx_exact_corners(&f, v[0], v[1], v[2]);
    for (k = 0; k < 3; k++) {
        tbx_exact_point(&f, k, p[k], 0.0, 0);
    }
    return tbx_crosses_exact(&f);
}

/* tribox_ray_crosses, corners and point finite. */
TBX_FN int tbx_crosses(double v[3][3], const double p[3])
{
    int sure;
    int k;
    for (k = 0; k < 3; k++) { /* off the triangle's box */
        const int64_t at = tbx_key64(&p[k]);
        const int64_t k0 = tbx_key64(&v[0][k]);
        const int64_t k1 = tbx_key64(&v[1][k]);
        const int64_t k2 = tbx_key64(&v[2][k]);
        if ((at < k0 && at < k1 && at < k2) || (k > 0 && at > k0 && at > k1 && at > k2)) {
            return 0;
        }
    }
    sure = tbx_crosses_filter(v, p);
    return sure >= 0 ? sure : tbx_crosses_unsure(v, p);
}

TRIBOX_FN int tribox_ray_crosses(const float v0[3], const float v1[3], const float v2[3],
                                 const double point[3])
{
    double v[3][3];
    int k;
    for (k = 0; k < 3; k++) {
        tbx_widen(&v[0][k], v0 + k);
        tbx_widen(&v[1][k], v1 + k);
        tbx_widen(&v[2][k], v2 + k);
    }
    return tbx_finite3(point) && tbx_corners_finite(v[0], v[1], v[2]) && tbx_crosses(v, point);
}

TBX_FN int tbx_contains(const tbx_source *source, const double point[3])
{
    double v[3][3];
    int inside = 0;
    size_t t;
    for (t = 0; tbx_finite3(point) && t < source->triangles; t++) {
        inside ^= tbx_source_triangle(source, t, v) != TBX_NO_POINTS && tbx_crosses(v, point);
    }
    return inside;
}

TRIBOX_FN int tribox_mesh_contains(const tribox_mesh *mesh, const double point[3])
{
    const tbx_source source = tbx_source_float(mesh);
    return tbx_contains(&source, point);
}

TRIBOX_FN int tribox_mesh_contains_f64(const tribox_mesh_f64 *mesh, const double point[3])
{
    const tbx_source source = tbx_source_double(mesh);
    return tbx_contains(&source, point);
}

/* The fill goes triangle by triangle, row by row. In a layer z each edge that is not level bounds y: where
 * the value -d_z E_i, which grows with y, is >= 0, c is past the edge. So the rows within are those from the
 * last edge that is a lower bound to the first that is an upper one: half-open, as the rule has it. Layers
 * are those with z_min <= z < z_max, which is what the rule says of level edges. In a row the voxels from the
 * first one on or beyond the plane flip. Each of these bounds is the least index of which a value that grows
 * with it is >= 0: the value in double, with a bound, decides if it can, else its exact sign.
 *
 * Error, in units of u = 2^-52. Along axis k all coordinates and centres of the region are at most
 * M_k = |origin| + (|lo| + |hi| + 1) size + largest |v|. The centre (middle + i*size) - v is off by no more
 * than 6 M: four roundings of middle's product, two of i*size. With 1 for d_i and 3 for products and sums,
 * E_i is off by 12 (|d_y| M_z + |d_z| M_y). A normal's component n_a is off by 8 X_b X_c, X the extents, and
 * at most 2 X_b X_c: n.(c - v0) is off by the sum of (8 + 2 * 10) X_b X_c M_a.
 *
 * On the lattice all is exact: middle, size and the corners are multiples of a unit per axis, 2^15 of which
 * reach over the region; corners lie no farther off; edges have 34 bits, normals 35, and the plane 53.
 *
 * Where that is not sure, corners are taken from the centre in question. One that is close to it is a whole
 * number of units, exactly; its double is off by u of itself. Others are off as above. So a x b, of two such
 * corners, is off by what they are, times the other factor, and by (1 + 1 + 1) u of its products; the plane's
 * three terms by (2 + 2 + 2) u more: CLOSE_ERROR. A corner on a line of centres, or beside it by as little as
 * decimals are off, makes its products small, so that the rest is sure. */
#define TBX_SOLID_ERROR (8.0 * TBX_U64)
#define TBX_SOLID_EDGE_ERROR (16.0 * TBX_U64)
#define TBX_SOLID_NORMAL_ERROR (10.0 * TBX_U64)
#define TBX_SOLID_PLANE_ERROR (40.0 * TBX_U64)
#define TBX_SOLID_CLOSE_ERROR (8.0 * TBX_U64)

/* Before all that the place is asked at which a value is 0: at + slope * r in row or layer r, as a place. It
 * rounds up to the index that is looked for, unless a whole number is within its error: that of the value,
 * over its step, and what the quotient and the sum round off, LINE_ERROR of |at| + |slope| n + 1; a division
 * may be off by 4 u. FIXED takes a step for each of at, the sum, and the two that the error is added to:
 * PLACE_ROUNDED. */
#define TBX_SOLID_LINE_ERROR (32.0 * TBX_U64)
#define TBX_PLACE_ROUNDED (8.0 * TBX_PLACE_STEP)

/* A region, for the solid. */
typedef struct tbx_solid {
    const tribox_grid *grid;
    uint64_t *bits;
    size_t row_words;
    uint64_t last_word; /* a row's last word without padding */
    int64_t n[3];       /* voxels */
    double middle[3];   /* the first voxel's centre */
    double reach[3];    /* M, without the corners */
    double scale[3];    /* of the lattice: 1 / unit; 0: there is none */
    int fits;           /* the filter's bounds hold */
    double unit[3];     /* that corners close to a centre are told in */
    int exponent[3];    /* of it, a power of two */
    double within[3];   /* how close that is */
    uint64_t origin[3]; /* in such units */
    uint64_t half[3];   /* of a voxel's size */
    tbx_places places;
} tbx_solid;

/* x / 2^exponent modulo 2^64. Returns 0 where that is no whole number. */
TBX_FN int tbx_in_units(const double *x, int exponent, uint64_t *out)
{
    int64_t mantissa;
    const int shift = tbx_split(tbx_bits64(x), &mantissa) - exponent;
    *out = shift < 64 && shift >= 0 ? (uint64_t)mantissa << shift : 0;
    return shift >= 0;
}

/* The unit of axis k divides origin and half a voxel, with two bits to spare for corners. A difference that
 * is below 2^59 of them in double, off by 2^58 of them at most, is below 2^60: what is computed modulo 2^64
 * is that difference itself. */
TBX_FN void tbx_solid_units(tbx_solid *s, int k)
{
    const double *origin = &s->grid->origin[k];
    const double *size = &s->grid->size[k];
    int64_t mantissa;
    const int of_origin = tbx_split(tbx_bits64(origin), &mantissa);
    const int of_half = tbx_split(tbx_bits64(size), &mantissa) - 1;
    const int exponent = (of_origin < of_half ? of_origin : of_half) - 2;
    const double most = tbx_from_bits64((uint64_t)(exponent > -900 ? exponent + 59 + 1023 : 1) << 52);
    s->exponent[k] = exponent;
    s->unit[k] = most * TBX_POW2(-59);
    s->within[k] = most > 4.0 * TBX_SOLID_ERROR * s->reach[k] ? most : 0.0;
    tbx_in_units(origin, exponent, &s->origin[k]);
    tbx_in_units(size, exponent + 1, &s->half[k]);
}

TBX_FN void tbx_solid_init(tbx_solid *s, const tribox_grid *grid, uint64_t *bits)
{
    int k;
    s->grid = grid;
    s->bits = bits;
    s->fits = TBX_DOUBLE_IS_53_BITS;
    for (k = 0; k < 3; k++) {
        const double lo = (double)grid->lo[k];
        const double hi = (double)grid->hi[k];
        s->n[k] = (int64_t)grid->hi[k] - grid->lo[k];
        s->middle[k] = s->reach[k] = s->scale[k] = s->within[k] = 0.0;
        if (tbx_solid_in_range(&grid->origin[k]) && tbx_solid_in_range(&grid->size[k]) &&
            tbx_bits64(&grid->size[k]) >= (uint64_t)(1023 - 150) << 52) {
            const double size = grid->size[k];
            const double scale = tbx_lattice_scale((double)s->n[k] * size);
            s->middle[k] = grid->origin[k] + (lo + 0.5) * size;
            s->reach[k] = tbx_abs(grid->origin[k]) + (tbx_abs(lo) + tbx_abs(hi) + 1.0) * size;
            if (tbx_on_lattice(grid->origin[k], scale) && tbx_on_lattice(0.5 * size, scale) &&
                tbx_on_lattice(s->reach[k], scale)) {
                s->scale[k] = scale;
            }
            tbx_solid_units(s, k);
        } else {
            s->fits = 0;
        }
    }
    s->row_words = (size_t)((s->n[0] + 63) / 64);
    s->last_word = ~(uint64_t)0 >> (63 - ((s->n[0] - 1) & 63));
    tbx_places_set(&s->places, grid, 0.5);
}

/* Flips the voxels from x on in a row. */
TBX_FN void tbx_solid_flip(const tbx_solid *s, int64_t x, int64_t y, int64_t z)
{
    uint64_t *row = s->bits + ((size_t)z * (size_t)s->n[1] + (size_t)y) * s->row_words;
    const size_t last = s->row_words - 1;
    size_t word = (size_t)x >> 6;
    uint64_t flip = ~(uint64_t)0 << (x & 63);
    for (; word < last; word++) {
        row[word] ^= flip;
        flip = ~(uint64_t)0;
    }
    row[word] ^= flip & s->last_word;
}

/* Where a value is 0, in row or layer r: at + slope * r, as a place. */
typedef struct tbx_solid_root {
    double at;
    double slope;
    double error; /* 1: it is not known */
} tbx_solid_root;

/* The least index at or above a place, in 0..n. Returns 0 where that is not sure. */
TBX_FORCED int tbx_solid_above(double place, double error, int64_t n, int64_t *out)
{
    const double first = TBX_PLACE_FIXED - 0.5;
    const double last = TBX_PLACE_FIXED - 0.5 + (double)n;
    double low;
    double high;
    uint64_t bits;
    place = place > first ? place : first;
    place = place < last ? place : last;
    low = place - error;
    high = place + error;
    bits = tbx_bits64(&low) >> TBX_PLACE_BITS;
    *out = (int64_t)bits + 1 - TBX_PLACE_OF_0;
    return bits == tbx_bits64(&high) >> TBX_PLACE_BITS;
}

/* A triangle over a region. */
typedef struct tbx_solid_tri {
    const tbx_solid *solid;
    double v[3][3];
    int sign;        /* of n_x */
    int fits;        /* the filter's bounds hold */
    double least[3]; /* corners' least and greatest */
    double most[3];
    double d[3][3];  /* edges */
    double at[3][3]; /* middle - corners */
    double n[3];     /* sign * normal */
    double edge_error;
    double plane_error;
    tbx_solid_root edge[3];
    tbx_solid_root plane;
    double plane_z; /* the plane's slope from layer to layer */
} tbx_solid_tri;

/* What grows with the index along an axis: rest + step*index, or, exactly, something of that sign. */
typedef struct tbx_growing {
    double rest;
    double step;
    double error; /* 0: exact */
    int axis;
    int id; /* 0..2: edge; 3: plane; 4, 5: centre - least, centre - most */
} tbx_growing;

/* Its sign, by integers as long as it takes. */
TBX_COLD int tbx_solid_sign_exact(const tbx_solid_tri *t, const tbx_growing *g, const int64_t index[3])
{
    const int q[3] = { TBX_MID, TBX_MID, TBX_MID };
    const tribox_grid *grid = t->solid->grid;
    tbx_exact f;
    int k;
    tbx_exact_corners(&f, t->v[0], t->v[1], t->v[2]);
    for (k = 0; k < 3; k++) {
        tbx_exact_point(&f, k, grid->origin[k], grid->size[k], 2 * (grid->lo[k] + index[k]) + 1);
    }
    if (g->id > 3) {
        const double *face = g->id == 4 ? t->least : t->most;
        const tbx_coord bound = tbx_at(&face[g->axis], NULL, 0);
        return tbx_compare(&f.x[TBX_MID][g->axis], &bound);
    }
    tbx_exact_finish(&f);
    if (g->id == 3) {
        return t->sign * tbx_orient3(&f, q);
    }
    return -tbx_edge_sign(&f, g->id, 2) *
           tbx_orient2(&f, 1, 2, g->id, g->id < 2 ? g->id + 1 : 0, TBX_MID, TBX_MID);
}

/* A corner from the centre of a voxel, on an axis: in double, and in units where it is close. */
typedef struct tbx_solid_off {
    double x;
    double error;
    int64_t units;
    int close;
} tbx_solid_off;

/* x, on axis k, from the centre of a voxel, in units. Returns 0 where it is not close. */
TBX_FN int tbx_solid_from_centre(const tbx_solid *s, int k, const double *x, int64_t index, int64_t *out)
{
    uint64_t units;
    if (!(tbx_abs(*x - (s->middle[k] + (double)index * s->grid->size[k])) < s->within[k]) ||
        !tbx_in_units(x, s->exponent[k], &units)) {
        return 0;
    }
    units -= s->origin[k] + (uint64_t)(2 * (s->grid->lo[k] + index) + 1) * s->half[k];
    *out = units >> 63 ? -(int64_t)(~units) - 1 : (int64_t)units;
    return 1;
}

TBX_FN void tbx_solid_off_centre(tbx_solid_off *off, const tbx_solid *s, int k, const double *x,
                                 int64_t index)
{
    off->x = *x - (s->middle[k] + (double)index * s->grid->size[k]);
    off->error = (s->reach[k] + tbx_abs(*x)) * TBX_SOLID_ERROR;
    off->units = 0;
    off->close = tbx_solid_from_centre(s, k, x, index, &off->units);
    if (off->close) {
        off->x = (double)off->units * s->unit[k];
        off->error = tbx_abs(off->x) * TBX_U64;
    }
}

/* The sign of a*b - c*d, magnitudes at most 2^60: as high * 2^60 + middle * 2^30 + low. */
TBX_FN int tbx_compare_products(int64_t a, int64_t b, int64_t c, int64_t d)
{
    const int64_t unit = (int64_t)1 << 30;
    const int64_t a_low = a & (unit - 1);
    const int64_t b_low = b & (unit - 1);
    const int64_t c_low = c & (unit - 1);
    const int64_t d_low = d & (unit - 1);
    const int64_t a_high = (a - a_low) / unit;
    const int64_t b_high = (b - b_low) / unit;
    const int64_t c_high = (c - c_low) / unit;
    const int64_t d_high = (d - d_low) / unit;
    int64_t high = a_high * b_high - c_high * d_high;
    int64_t middle = a_high * b_low + a_low * b_high - c_high * d_low - c_low * d_high;
    int64_t low = a_low * b_low - c_low * d_low;
    int64_t rest = low & (unit - 1);
    middle += (low - rest) / unit;
    low = rest;
    rest = middle & (unit - 1);
    high += (middle - rest) / unit;
    return high != 0 ? (high > 0) - (high < 0) : (rest | low) != 0;
}

/* a x b in the plane of y and z: what double makes of it. */
typedef struct tbx_solid_value {
    double value;
    double error;
} tbx_solid_value;

TBX_FN void tbx_solid_cross(tbx_solid_value *out, const tbx_solid_off a[3], const tbx_solid_off b[3])
{
    const double forth = a[1].x * b[2].x;
    const double back = a[2].x * b[1].x;
    out->value = forth - back;
    out->error =
        (tbx_abs(a[1].x) * b[2].error + tbx_abs(b[2].x) * a[1].error + tbx_abs(a[2].x) * b[1].error +
         tbx_abs(b[1].x) * a[2].error + a[1].error * b[2].error + a[2].error * b[1].error) *
            TBX_BOUND_ERROR +
        (tbx_abs(forth) + tbx_abs(back)) * TBX_SOLID_CLOSE_ERROR;
}

/* The sign of an edge's value, corners a and b from the centre; 2: not sure. */
TBX_FN int tbx_solid_close_edge(const tbx_solid_off a[3], const tbx_solid_off b[3])
{
    tbx_solid_value e;
    tbx_solid_cross(&e, a, b);
    if (tbx_abs(e.value) > e.error) {
        return (e.value > 0.0) - (e.value < 0.0);
    }
    if (a[1].close & a[2].close & b[1].close & b[2].close) {
        return tbx_compare_products(a[1].units, b[2].units, a[2].units, b[1].units);
    }
    return 2;
}

/* The same of the plane, times the sign of n_x: minus the determinant of the corners. Where one of them is at
 * the centre but for a few units, and where all have one x, it is sure. */
TBX_FN int tbx_solid_close_plane(tbx_solid_off v[3][3], int sign)
{
    double value = 0.0;
    double error = 0.0;
    int i;
    if ((v[0][0].close & v[1][0].close & v[2][0].close) && v[0][0].units == v[1][0].units &&
        v[0][0].units == v[2][0].units) {
        return (v[0][0].units < 0) - (v[0][0].units > 0);
    }
    for (i = 0; i < 3; i++) {
        tbx_solid_value e;
        tbx_solid_cross(&e, v[i < 2 ? i + 1 : 0], v[i < 1 ? 2 : i - 1]);
        value -= v[i][0].x * e.value;
        error += (tbx_abs(v[i][0].x) + v[i][0].error) * e.error +
                 (v[i][0].error + tbx_abs(v[i][0].x) * TBX_SOLID_CLOSE_ERROR) * tbx_abs(e.value);
    }
    if (error == 0.0) {
        return 0;
    }
    error *= TBX_BOUND_ERROR;
    return value > error ? sign : value < -error ? -sign : 2;
}

/* The sign of what grows, of corners from close by; 2: not sure. */
TBX_NOINLINE int tbx_solid_sign_close(const tbx_solid_tri *t, const tbx_growing *g, const int64_t index[3])
{
    const tbx_solid *s = t->solid;
    int sign = 2;
    int i;
    int k;
    if (t->fits && g->id > 3) {
        const double *face = g->id == 4 ? t->least : t->most;
        tbx_solid_off off;
        tbx_solid_off_centre(&off, s, g->axis, &face[g->axis], index[g->axis]);
        sign = off.close ? (off.units < 0) - (off.units > 0) : 2;
    } else if (t->fits) {
        tbx_solid_off v[3][3];
        for (i = 0; i < 3; i++) {
            for (k = g->id < 3; k < 3; k++) {
                tbx_solid_off_centre(&v[i][k], s, k, &t->v[i][k], index[k]);
            }
        }
        if (g->id < 3) {
            const int j = g->id < 2 ? g->id + 1 : 0;
            const int rises = tbx_less(&t->v[g->id][2], &t->v[j][2]);
            sign = tbx_solid_close_edge(v[g->id], v[j]);
            sign = sign == 2 || !rises ? sign : -sign;
        } else {
            sign = tbx_solid_close_plane(v, t->sign);
        }
    }
    return sign;
}

TBX_FN int tbx_solid_sign(const tbx_solid_tri *t, const tbx_growing *g, const int64_t index[3])
{
    const int sign = tbx_solid_sign_close(t, g, index);
    return sign != 2 ? sign : tbx_solid_sign_exact(t, g, index);
}

/* The least index in [lo, hi) at which the value is >= 0; hi if there is none. The quotient is a guess; what
 * counts is that the value is sure on both sides of it. Where it is not, it mostly is two steps off, and few
 * are left to ask. */
TBX_FN int64_t tbx_solid_least(const tbx_solid_tri *t, const tbx_growing *g, int64_t index[3], int64_t lo,
                               int64_t hi)
{
    if (t->fits && lo < hi) {
        int64_t i = tbx_guess(1.0 - g->rest / g->step, lo, hi);
        double before = g->rest + g->step * (double)(i - 1);
        double value = g->rest + g->step * (double)i;
        if (i > lo && before >= g->error) { /* a zero, or the quotient was rounded */
            i--;
            value = before;
            before = g->rest + g->step * (double)(i - 1);
        }
        if ((i == hi || value >= g->error) && (i == lo || (before < 0.0 && before <= -g->error))) {
            return i;
        }
        value = g->rest + g->step * (double)(i + 1);
        before = g->rest + g->step * (double)(i - 2);
        hi = i + 1 < hi && value > g->error ? i + 1 : hi;
        lo = i - 2 >= lo && before < -g->error ? i - 1 : lo;
    }
    while (lo < hi) {
        const int64_t at = lo + (hi - lo) / 2;
        index[g->axis] = at;
        if (tbx_solid_sign(t, g, index) >= 0) {
            hi = at;
        } else {
            lo = at + 1;
        }
    }
    return lo;
}

/* Is x, on axis k, on the lattice, and near the region? */
TBX_FN int tbx_solid_on_lattice(const tbx_solid *s, int k, double x)
{
    const double units = (s->middle[k] - x) * s->scale[k];
    return s->scale[k] > 0.0 && units <= 32768.0 && units >= -32768.0 && tbx_on_lattice(x, s->scale[k]);
}

/* The rows of axis k, 1 or 2, whose centres are in [least, most). */
TBX_FN void tbx_solid_range(const tbx_solid_tri *t, int k, int64_t out_range[2])
{
    const tbx_solid *s = t->solid;
    const tbx_places *p = &s->places;
    int64_t index[3] = { 0, 0, 0 };
    int side;
    out_range[0] = 0;
    for (side = 0; side < 2; side++) {
        const double face = side == 0 ? t->least[k] : t->most[k];
        tbx_growing g;
        if (t->fits && p->on &&
            tbx_solid_above(face * p->inverse[k] + p->base[k], p->error, s->n[k], &out_range[side])) {
            continue;
        }
        g.axis = k;
        g.id = 4 + side;
        g.rest = g.step = g.error = 1.0;
        if (t->fits) {
            g.rest = s->middle[k] - face;
            g.step = s->grid->size[k];
            g.error =
                tbx_solid_on_lattice(s, k, face) ? 0.0 : (s->reach[k] + tbx_abs(face)) * TBX_SOLID_ERROR;
        }
        out_range[side] = tbx_solid_least(t, &g, index, out_range[0], s->n[k]);
    }
}

/* Corners, finite, of a kind, and what depends on them alone. */
TBX_FN void tbx_solid_tri_set(tbx_solid_tri *t, const tbx_solid *s, double v[3][3], int kind)
{
    int k;
    t->solid = s;
    t->fits = s->fits && kind == TBX_ALL_ORDINARY;
    TBX_COPY(t->v, v, sizeof t->v);
    for (k = 0; k < 3; k++) {
        const double a = v[0][k];
        const double b = v[1][k];
        const double c = v[2][k];
        if (t->fits) {
            const double least = a < b ? a : b;
            const double most = a < b ? b : a;
            t->least[k] = c < least ? c : least;
            t->most[k] = c > most ? c : most;
        } else {
            t->least[k] = tbx_min(tbx_min(a, b), c);
            t->most[k] = tbx_max(tbx_max(a, b), c);
        }
    }
}

/* Are two corners one in y and z? Then the triangle is parallel to x. */
TBX_FN int tbx_solid_is_wall(const tbx_solid_tri *t)
{
    int wall = 0;
    int i;
    for (i = 0; i < 3; i++) {
        const double *a = t->v[i];
        const double *b = t->v[i < 2 ? i + 1 : 0];
        if (t->fits) {
            wall |= (t->d[i][1] == 0.0) & (t->d[i][2] == 0.0);
        } else {
            wall |= tbx_key64(&a[1]) == tbx_key64(&b[1]) && tbx_key64(&a[2]) == tbx_key64(&b[2]);
        }
    }
    return wall;
}

/* 1 / step; 0 where that is too large. */
TBX_FN double tbx_solid_inverse(double step)
{
    const int divides = step > TBX_POW2(-400);
    double divisor = divides ? step : 1.0;
    TBX_KEEP_SCALAR(divisor);
    return divides ? 1.0 / divisor : 0.0;
}

/* The root of a value, at most `most` in all rows and off by error, that grows by 1 / inverse with an index
 * and by `along` with a row. */
TBX_FN void tbx_solid_root_set(tbx_solid_root *root, double value, double along, double inverse, double most,
                               double error)
{
    root->at = TBX_PLACE_FIXED - value * inverse;
    root->slope = -along * inverse;
    root->error =
        (most * TBX_SOLID_LINE_ERROR + TBX_BOUND_ERROR * error) * inverse +
        (TBX_SOLID_LINE_ERROR + TBX_PLACE_ROUNDED);
    root->error = inverse > 0.0 ? root->error : 1.0;
}

/* Where edges and plane have their roots. */
TBX_FN void tbx_solid_tri_roots(tbx_solid_tri *t)
{
    const tbx_solid *s = t->solid;
    const double *size = s->grid->size;
    const double n_y = (double)s->n[1];
    const double n_z = (double)s->n[2];
    double value;
    double by_row;
    double by_layer;
    double inverse;
    int i;
    for (i = 0; i < 3; i++) {
        const double across = tbx_abs(t->d[i][2]);
        const double along = t->d[i][2] < 0.0 ? t->d[i][1] : -t->d[i][1];
        inverse = tbx_solid_inverse(across * size[1]);
        value = along * t->at[i][2] + across * t->at[i][1];
        by_layer = along * size[2];
        tbx_solid_root_set(&t->edge[i], value, by_layer, inverse, tbx_abs(value) + tbx_abs(by_layer) * n_z,
                           t->edge_error);
    }
    inverse = tbx_solid_inverse(t->n[0] * size[0]);
    value = t->n[0] * t->at[0][0] + t->n[1] * t->at[0][1] + t->n[2] * t->at[0][2];
    by_row = t->n[1] * size[1];
    by_layer = t->n[2] * size[2];
    tbx_solid_root_set(&t->plane, value, by_row, inverse,
                       tbx_abs(value) + tbx_abs(by_row) * n_y + tbx_abs(by_layer) * n_z, t->plane_error);
    t->plane_z = -by_layer * inverse;
    if (!t->fits) {
        t->plane.error = 1.0;
    }
}

/* The same where numbers are out of range: there are none. */
TBX_COLD void tbx_solid_tri_wild(tbx_solid_tri *t)
{
    int i;
    t->plane.at = t->plane.slope = t->plane_z = 0.0;
    t->plane.error = 1.0;
    for (i = 0; i < 3; i++) {
        t->edge[i] = t->plane;
    }
    t->sign = tbx_normal_sign_exact(t->v[0], t->v[1], t->v[2], 1, 2);
}

/* Edges and normal, with their bounds. Returns 0 if n_x is 0. */
TBX_FN int tbx_solid_tri_edges(tbx_solid_tri *t)
{
    const tbx_solid *s = t->solid;
    double m[3];
    double x[3];
    double area;
    int on_lattice = s->scale[0] > 0.0 && s->scale[1] > 0.0 && s->scale[2] > 0.0;
    int i;
    int k;
    for (k = 0; k < 3 && t->fits; k++) {
        for (i = 0; i < 3; i++) {
            t->d[i][k] = t->v[i < 2 ? i + 1 : 0][k] - t->v[i][k];
            t->at[i][k] = s->middle[k] - t->v[i][k];
        }
    }
    TBX_KEEP(t->d);
    TBX_KEEP(t->at);
    if (tbx_solid_is_wall(t)) {
        return 0;
    }
    if (!t->fits) {
        tbx_solid_tri_wild(t);
        return t->sign;
    }
    for (k = 0; k < 3; k++) {
        const double least = tbx_abs(t->least[k]);
        const double most = tbx_abs(t->most[k]);
        m[k] = s->reach[k] + (least > most ? least : most);
        x[k] = t->most[k] - t->least[k];
        for (i = 0; i < 3 && on_lattice; i++) {
            on_lattice = tbx_solid_on_lattice(s, k, t->v[i][k]);
        }
    }
    t->n[0] = t->d[0][1] * t->d[1][2] - t->d[0][2] * t->d[1][1];
    t->n[1] = t->d[0][2] * t->d[1][0] - t->d[0][0] * t->d[1][2];
    t->n[2] = t->d[0][0] * t->d[1][1] - t->d[0][1] * t->d[1][0];
    area = t->plane_error = t->edge_error = 0.0;
    if (!on_lattice) {
        area = x[1] * x[2] * TBX_SOLID_NORMAL_ERROR + TBX_SOLID_TINY;
        t->plane_error =
            (x[1] * x[2] * m[0] + x[2] * x[0] * m[1] + x[0] * x[1] * m[2]) * TBX_SOLID_PLANE_ERROR +
            TBX_SOLID_TINY;
        t->edge_error = (x[1] * m[2] + x[2] * m[1]) * TBX_SOLID_EDGE_ERROR + TBX_SOLID_TINY;
    }
    t->sign = (t->n[0] > area) - (t->n[0] < -area);
    t->fits = tbx_abs(t->n[0]) >= TBX_POW2(-400); /* quotients of values, below 2^460, are finite */
    if (t->sign == 0 && area > 0.0) {
        t->sign = tbx_normal_sign_exact(t->v[0], t->v[1], t->v[2], 1, 2);
        t->fits = 0; /* the plane's step is not sure */
    }
    if (t->sign < 0) {
        t->n[0] = -t->n[0];
        t->n[1] = -t->n[1];
        t->n[2] = -t->n[2];
    }
    tbx_solid_tri_roots(t);
    return t->sign;
}

/* The first row of layer z, from..to, past edge i, as values have it. */
TBX_NOINLINE int64_t tbx_solid_row(const tbx_solid_tri *t, int i, int64_t z, int64_t from, int64_t to)
{
    const tbx_solid *s = t->solid;
    int64_t index[3] = { 0, 0, 0 };
    tbx_growing g;
    index[2] = z;
    g.axis = 1;
    g.id = i;
    g.rest = g.step = g.error = 1.0;
    if (t->fits) {
        const double to_z = t->at[i][2] + (double)z * s->grid->size[2];
        const double across = tbx_abs(t->d[i][2]);
        g.rest = (t->d[i][2] < 0.0 ? t->d[i][1] : -t->d[i][1]) * to_z + across * t->at[i][1];
        g.step = across * s->grid->size[1];
        g.error = t->edge_error;
    }
    return tbx_solid_least(t, &g, index, from, to);
}

/* The rows of layer z within the edges. */
TBX_FN void tbx_solid_rows(const tbx_solid_tri *t, int64_t z, int64_t rows[2])
{
    int i;
    for (i = 0; i < 3; i++) {
        const tbx_solid_root *edge = &t->edge[i];
        const int j = i < 2 ? i + 1 : 0;
        const int rises = tbx_less(&t->v[i][2], &t->v[j][2]);
        int64_t row;
        if (rises | tbx_less(&t->v[j][2], &t->v[i][2])) {
            if (!tbx_solid_above(edge->at + edge->slope * (double)z, edge->error, t->solid->n[1], &row)) {
                row = tbx_solid_row(t, i, z, rows[0], rows[1]);
            }
            /* inward is +y where -sign * d_z > 0 */
            if ((t->sign > 0) != rises) {
                rows[0] = row > rows[0] ? row : rows[0];
            } else {
                rows[1] = row < rows[1] ? row : rows[1];
            }
        }
    }
}

/* The first voxel of row y of layer z on or beyond the plane, as values have it. */
TBX_NOINLINE int64_t tbx_solid_voxel(const tbx_solid_tri *t, int64_t y, int64_t z)
{
    const tbx_solid *s = t->solid;
    int64_t index[3];
    tbx_growing g;
    index[0] = 0;
    index[1] = y;
    index[2] = z;
    g.axis = 0;
    g.id = 3;
    g.rest = g.step = g.error = 1.0;
    if (t->fits) {
        const double to_y = t->at[0][1] + (double)y * s->grid->size[1];
        const double to_z = t->at[0][2] + (double)z * s->grid->size[2];
        g.rest = t->n[0] * t->at[0][0] + t->n[1] * to_y + t->n[2] * to_z;
        g.step = t->n[0] * s->grid->size[0];
        g.error = t->plane_error;
    }
    return tbx_solid_least(t, &g, index, 0, s->n[0]);
}

/* A triangle, and the rows and layers of its box. Returns 0 where it crosses nothing. */
TBX_FN int tbx_solid_begin(tbx_solid_tri *t, const tbx_solid *s, double v[3][3], int kind, int64_t y_range[2],
                           int64_t z_range[2])
{
    tbx_solid_tri_set(t, s, v, kind);
    tbx_solid_range(t, 2, z_range);
    if (z_range[0] == z_range[1]) {
        return 0;
    }
    tbx_solid_range(t, 1, y_range);
    return y_range[0] < y_range[1] && tbx_solid_tri_edges(t) != 0;
}

/* Flips what one triangle crosses from a layer on. */
TBX_NOINLINE void tbx_solid_part(const tbx_solid *s, double v[3][3], int kind, int64_t first)
{
    tbx_solid_tri t;
    int64_t y_range[2];
    int64_t z_range[2];
    int64_t y;
    int64_t z;
    if (!tbx_solid_begin(&t, s, v, kind, y_range, z_range)) {
        return;
    }
    for (z = z_range[0] > first ? z_range[0] : first; z < z_range[1]; z++) {
        const double at_z = t.plane.at + t.plane_z * (double)z;
        int64_t rows[2];
        rows[0] = y_range[0];
        rows[1] = y_range[1];
        tbx_solid_rows(&t, z, rows);
        for (y = rows[0]; y < rows[1]; y++) {
            int64_t x;
            if (!tbx_solid_above(at_z + t.plane.slope * (double)y, t.plane.error, s->n[0], &x)) {
                x = tbx_solid_voxel(&t, y, z);
            }
            if (x < s->n[0]) {
                tbx_solid_flip(s, x, y, z);
            }
        }
    }
}

/* Small boxes. Most triangles of a fine mesh have no row's centre, or no layer's, between their least and
 * greatest place; most others a few. About the first of these, coordinates are those of places, exactly, and
 * at most R = CELLS; E_i = v_i x v_{i+1}, and, j rows and k layers on, E_i + j (z_i - z_{i+1}) + k (y_{i+1} -
 * y_i). With e the places' error, 2^-26 or more, that is off by 4 R e, by 2 e for each of j + k steps, and by
 * roundings, which are 2^-44: less than CELL_ERROR e. A centre is within where all three are of one sign, by
 * more than that, and not where two are not. Along x the plane is at
 *
 *   x_0 + ((x_1 - x_0) E_2 + (x_2 - x_0) E_0) / (E_0 + E_1 + E_2),
 *
 * weights being 1 at most: off by (|x_1 - x_0| + |x_2 - x_0|) / |E_0 + E_1 + E_2| times E's error, once for
 * itself and thrice for the sum, roundings far below another one; and by 5 e for the three x. */
#define TBX_SOLID_CELLS 4
#define TBX_SOLID_CELL_ERROR 32.0
#define TBX_SOLID_CELL_SUMS 5.0

typedef struct tbx_solid_small {
    int64_t first[3]; /* row and layer; x is not used */
    int rows;
    int layers;
    double at[3][3]; /* axis, corner */
    double e[3];
    double by_row[3];
    double by_layer[3];
} tbx_solid_small;

/* The centres within, row j and layer k a bit 4 k + j. Returns 0 where one is not sure. */
TBX_FN int tbx_solid_within(tbx_solid_small *m, double error, unsigned *out_within)
{
    const double y = TBX_PLACE_FIXED + (double)m->first[1];
    const double z = TBX_PLACE_FIXED + (double)m->first[2];
    const double y0 = m->at[1][0] - y;
    const double y1 = m->at[1][1] - y;
    const double y2 = m->at[1][2] - y;
    const double z0 = m->at[2][0] - z;
    const double z1 = m->at[2][1] - z;
    const double z2 = m->at[2][2] - z;
    double layer[3];
    unsigned sure = 1;
    unsigned within = 0;
    int j;
    int k;
    layer[0] = m->e[0] = y0 * z1 - z0 * y1;
    layer[1] = m->e[1] = y1 * z2 - z1 * y2;
    layer[2] = m->e[2] = y2 * z0 - z2 * y0;
    m->by_row[0] = z0 - z1;
    m->by_row[1] = z1 - z2;
    m->by_row[2] = z2 - z0;
    m->by_layer[0] = y1 - y0;
    m->by_layer[1] = y2 - y1;
    m->by_layer[2] = y0 - y2;
    for (k = 0; k < m->layers; k++) {
        double e0 = layer[0];
        double e1 = layer[1];
        double e2 = layer[2];
        for (j = 0; j < m->rows; j++) {
            const double least = tbx_min3(e0, e1, e2);
            const double most = tbx_max3(e0, e1, e2);
            const unsigned in = (unsigned)((least > error) | (most < -error));
            const unsigned out = (unsigned)((least < -error) & (most > error));
            within |= in << (4 * k + j);
            sure &= in | out;
            e0 += m->by_row[0];
            e1 += m->by_row[1];
            e2 += m->by_row[2];
        }
        layer[0] += m->by_layer[0];
        layer[1] += m->by_layer[1];
        layer[2] += m->by_layer[2];
    }
    *out_within = within;
    return (int)sure;
}

/* Flips their rows. Returns 0, none flipped, where one is not sure. */
TBX_FN int tbx_solid_flip_small(const tbx_solid *s, tbx_vertices *c, tbx_solid_small *m, unsigned within,
                                double error)
{
    const double most = 2097152.0; /* 2^21 */
    int64_t x[16];
    double along[2];
    double at;
    double by_row;
    double by_layer;
    double inverse = m->e[0] + m->e[1] + m->e[2];
    double off;
    int i;
    if (!tbx_vertices_fit(c, 0, 1)) {
        return 0;
    }
    tbx_vertices_place(c, &s->places, 0, m->at[0]);
    along[0] = m->at[0][1] - m->at[0][0];
    along[1] = m->at[0][2] - m->at[0][0];
    off = tbx_abs(along[0]) + tbx_abs(along[1]);
    if (!(tbx_abs(m->at[0][0] - TBX_PLACE_FIXED) + off < most)) {
        return 0;
    }
    TBX_KEEP_SCALAR(inverse);
    inverse = 1.0 / inverse;
    off = off * tbx_abs(inverse) * (TBX_SOLID_CELL_SUMS * error) + 8.0 * s->places.error;
    at = m->at[0][0] + (along[0] * m->e[2] + along[1] * m->e[0]) * inverse;
    by_row = (along[0] * m->by_row[2] + along[1] * m->by_row[0]) * inverse;
    by_layer = (along[0] * m->by_layer[2] + along[1] * m->by_layer[0]) * inverse;
    for (i = 0; within >> i != 0; i++) {
        if ((within >> i & 1u) != 0 &&
            !tbx_solid_above(at + by_row * (double)(i & 3) + by_layer * (double)(i >> 2), off, s->n[0],
                             &x[i])) {
            return 0;
        }
    }
    for (i = 0; within >> i != 0; i++) {
        if ((within >> i & 1u) != 0 && x[i] < s->n[0]) {
            tbx_solid_flip(s, x[i], m->first[1] + (i & 3), m->first[2] + (i >> 2));
        }
    }
    return 1;
}

/* Flips what a triangle crosses, of rows y[0] + 1 to y[1] and layers z[0] + 1 to z[1], if these are few and
 * all is sure. Returns 0, nothing flipped, if not. */
TBX_NOINLINE int tbx_solid_by_cells(const tbx_solid *s, tbx_vertices *c, tbx_solid_small *m,
                                    const int64_t y[2], const int64_t z[2])
{
    const tbx_places *p = &s->places;
    const double error = TBX_SOLID_CELL_ERROR * p->error;
    unsigned within;
    if ((y[1] - y[0] > TBX_SOLID_CELLS) | (z[1] - z[0] > TBX_SOLID_CELLS) | (y[0] < -1) | (z[0] < -1) |
        (y[1] > p->last[1]) | (z[1] > p->last[2])) {
        return 0;
    }
    m->first[1] = y[0] + 1;
    m->first[2] = z[0] + 1;
    m->rows = (int)(y[1] - y[0]);
    m->layers = (int)(z[1] - z[0]);
    return tbx_solid_within(m, error, &within) &&
           (within == 0 || tbx_solid_flip_small(s, c, m, within, error));
}

/* Flips what triangle t crosses, mostly nothing. Returns 0, nothing flipped, where that is not sure. */
TBX_FORCED int tbx_solid_quickly(const tbx_solid *s, const tbx_source *source, size_t t, int is_double)
{
    const tbx_places *p = &s->places;
    tbx_vertices c;
    tbx_solid_small m;
    int64_t y[2];
    int64_t z[2];
    tbx_vertices_find(&c, source, t, is_double);
    if (!tbx_vertices_fit(&c, 1, 2)) {
        return 0;
    }
    tbx_vertices_place(&c, p, 2, m.at[2]);
    if (!tbx_places_range(p, m.at[2], z)) {
        return 0;
    }
    if (z[1] <= z[0]) {
        return z[1] == z[0];
    }
    tbx_vertices_place(&c, p, 1, m.at[1]);
    if (!tbx_places_range(p, m.at[1], y)) {
        return 0;
    }
    if (y[1] <= y[0]) {
        return y[1] == y[0];
    }
    if ((z[1] < 0) | (z[0] >= p->last[2]) | (y[1] < 0) | (y[0] >= p->last[1])) {
        return 1; /* off the region */
    }
    return tbx_solid_by_cells(s, &c, &m, y, z);
}

TBX_FN void tbx_solid_fill_mesh(const tribox_grid *grid, const tbx_source *source, uint64_t *bits)
{
    tbx_solid s;
    double v[3][3];
    size_t t;
    if (tribox_grid_words(grid) == 0) {
        return;
    }
    tbx_solid_init(&s, grid, bits);
    t = TBX_EITHER(tbx_solid_quick_fill(&s, source), 0);
    for (; t < source->triangles; t++) {
        if (!(s.places.on && (source->is_double ? tbx_solid_quickly(&s, source, t, 1)
                                                : tbx_solid_quickly(&s, source, t, 0)))) {
            const int kind = tbx_source_triangle(source, t, v);
            if (kind != TBX_NO_POINTS) {
                tbx_solid_part(&s, v, kind, 0);
            }
        }
    }
}

TRIBOX_FN void tribox_grid_fill_solid(const tribox_grid *grid, const tribox_mesh *mesh, uint64_t *bits)
{
    const tbx_source source = tbx_source_float(mesh);
    tbx_solid_fill_mesh(grid, &source, bits);
}

TRIBOX_FN void tribox_grid_fill_solid_f64(const tribox_grid *grid, const tribox_mesh_f64 *mesh,
                                          uint64_t *bits)
{
    const tbx_source source = tbx_source_double(mesh);
    tbx_solid_fill_mesh(grid, &source, bits);
}

TRIBOX_FN int tribox_grid_get(const tribox_grid *grid, const uint64_t *bits, int x, int y, int z)
{
    size_t row;
    size_t column;
    if (tribox_grid_words(grid) == 0 || x < grid->lo[0] || x >= grid->hi[0] || y < grid->lo[1] ||
        y >= grid->hi[1] || z < grid->lo[2] || z >= grid->hi[2]) {
        return 0;
    }
    column = (size_t)((int64_t)x - grid->lo[0]);
    row = (size_t)((int64_t)z - grid->lo[2]) * (size_t)((int64_t)grid->hi[1] - grid->lo[1]) +
          (size_t)((int64_t)y - grid->lo[1]);
    row *= (size_t)(((int64_t)grid->hi[0] - grid->lo[0] + 63) / 64);
    return (int)((bits[row + (column >> 6)] >> (column & 63)) & 1u);
}

TRIBOX_FN int tribox_grid_locate(const tribox_grid *grid, const double point[3], int out_index[3])
{
    const int64_t least = -((int64_t)1 << 31);
    const int64_t most = ((int64_t)1 << 31) - 1;
    int inside = 1;
    int k;
    for (k = 0; k < 3; k++) {
        if (!tbx_is_finite(&grid->origin[k]) || !tbx_is_finite(&grid->size[k]) ||
            tbx_sign(&grid->size[k]) <= 0 || !tbx_is_finite(&point[k])) {
            return 0;
        }
    }
    for (k = 0; k < 3; k++) {
        const int64_t i = tbx_plane_search(grid, k, least + 1, most + 1, point[k], 1) - 1;
        inside &= i >= grid->lo[k] && i < grid->hi[k] &&
                  (i > least || tbx_plane_compare(grid, k, i, point[k]) <= 0);
        out_index[k] = (int)i;
    }
    return inside;
}

/* Bounds of the mesh's triangles, those with a NaN or infinite corner left out. Returns 0 if there is
 * none. */
TBX_FN int tbx_source_bounds(const tbx_source *source, double out_min[3], double out_max[3])
{
    int any = 0;
    size_t t;
    for (t = 0; t < source->triangles; t++) {
        double v[3][3];
        int c;
        int k;
        if (tbx_source_triangle(source, t, v) == TBX_NO_POINTS) {
            continue;
        }
        for (c = 0; c < 3; c++) {
            for (k = 0; k < 3; k++) {
                out_min[k] = any ? tbx_min(out_min[k], v[c][k]) : v[c][k];
                out_max[k] = any ? tbx_max(out_max[k], v[c][k]) : v[c][k];
            }
            any = 1;
        }
    }
    return any;
}

/* Kept, because -ffast-math adds before it halves, and a sum of large doubles is infinite. */
TBX_FN double tbx_half(double x)
{
    double half = x * 0.5;
    TBX_KEEP_SCALAR(half);
    return half;
}

/* Voxels of this size along an extent: up to n, so that the conversion is in range. */
TBX_FN int tbx_fit_cells(double extent, double size, int n)
{
    double cells = extent / size;
    TBX_KEEP_SCALAR(cells);
    cells = cells * (1.0 + 1.0 / 4096.0 / n) + 1.0;
    cells = cells < (double)n ? cells : (double)n;
    TBX_KEEP_SCALAR(cells);
    return tbx_to_int(cells);
}

/* A frame of `size`: origins to 2^-12 of a voxel, in the middle of the mesh. Returns 0 where rounding has
 * left a face of the mesh on or beyond one of the region's. */
TBX_FN int tbx_fit_try(tribox_grid *grid, const double t_min[3], const double t_max[3], double longest,
                       double size, int n)
{
    const double q = tbx_floor_pow2(size) * (1.0 / 4096.0);
    int fits = 1;
    int k;
    for (k = 0; k < 3; k++) {
        const double extent = t_max[k] - t_min[k];
        const int cells = extent < longest ? tbx_fit_cells(extent, size, n) : n;
        double middle = tbx_half(t_min[k]) + tbx_half(t_max[k]);
        TBX_KEEP_SCALAR(middle);
        grid->size[k] = size;
        grid->hi[k] = cells;
        grid->origin[k] = tbx_floor_to(middle - cells * (size * 0.5), q);
        fits &=
            tbx_plane_compare(grid, k, 0, t_min[k]) < 0 && tbx_plane_compare(grid, k, cells, t_max[k]) > 0;
    }
    return fits;
}

/* Voxel size and origin are kept to few bits (24 and 2^-12 of a voxel), which keeps later exact signs short.
 * Sizes are at least 2^-900. */
TBX_FN int tbx_fit(tribox_grid *grid, const tbx_source *source, int n)
{
    const double least = TBX_POW2(-900);
    double t_min[3];
    double t_max[3];
    double longest = 0.0;
    double size;
    double margin;
    double bump = 0.0; /* doubles, for a mesh that is small beside its coordinates */
    int varies = 0;
    int fits = 0;
    int tries;
    int k;
    grid->flags = 0;
    for (k = 0; k < 3; k++) {
        grid->origin[k] = 0.0;
        grid->size[k] = 1.0;
        grid->lo[k] = 0;
        grid->hi[k] = 0;
    }
    if (n < 1 || !tbx_source_bounds(source, t_min, t_max)) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        double half = tbx_half(t_max[k]) - tbx_half(t_min[k]);
        TBX_KEEP_SCALAR(half);
        if (!(half < TBX_POW2(1020))) { /* the extent is no double */
            return 0;
        }
        varies |= tbx_less(&t_min[k], &t_max[k]);
        longest = 2.0 * half > longest ? t_max[k] - t_min[k] : longest;
    }
    if (!varies) {
        return 0;
    }
    size = longest / n;
    margin = 1.0 + 1.0 / 512.0 / n;
    TBX_KEEP_SCALAR(size); /* n * n is not multiplied out by -ffast-math: it overflows */
    TBX_KEEP_SCALAR(margin);
    size *= margin;
    size = size > least ? size : least;
    for (tries = 0; !fits && tries < 4096; tries++) { /* each doubles the bump: in the end above any error */
        const double q = tbx_floor_pow2(size) * (1.0 / 8388608.0); /* 2^-23: 24 bits of size */
        size = tbx_floor_to(size + bump, q) + q;
        bump = 2.0 * bump + q;
        fits = tbx_fit_try(grid, t_min, t_max, longest, size, n);
    }
    grid->hi[0] = fits ? grid->hi[0] : 0;
    return fits;
}

TRIBOX_FN int tribox_grid_fit(tribox_grid *grid, const tribox_mesh *mesh, int n)
{
    const tbx_source source = tbx_source_float(mesh);
    return tbx_fit(grid, &source, n);
}

TRIBOX_FN int tribox_grid_fit_f64(tribox_grid *grid, const tribox_mesh_f64 *mesh, int n)
{
    const tbx_source source = tbx_source_double(mesh);
    return tbx_fit(grid, &source, n);
}
#ifndef TRIBOX_NO_COMPANIONS
/* ---- 10. Companions ---------------------------------------------------------------------------------------
 *
 * Each algorithm is written once, over tbx_num, for floats and for doubles, and runs at most twice: first in
 * double with a bound of the error beside each value, then, only if some sign was unsure, in integers. Both
 * runs take the same branches on signs that are certain, so an answer of the first run is the answer of the
 * second. What is written out is a fraction; where double cannot tell how it rounds, that fraction alone is
 * evaluated again in integers.
 *
 * In double: |exact - mid| <= 2 rad. The inputs are 0 or within [2^-97, 2^130) (floats always are: those
 * below 2^-97 are multiples of 2^-149), so a degree-d number is a multiple of 2^-150d below 2^(130d + 8), d
 * <= 6, and rounding to 53 bits keeps it so: nothing overflows, mid is 0 or at least 2^-900, rad 0 or at
 * least 2^-1000; so there are no subnormals. Each operation adds U |mid|, U twice what its rounding needs.
 * The roundings of rad itself, at most 2^6 operations, are covered by the 2. Sums are kept in the order
 * written; a reassociated product has no more roundings, a fused one fewer. rad = 0 says that no rounding
 * took part: numbers of 24 bits have exact products, and exact sums where their exponents differ by at most
 * 28. So on small integers every sign is sure, zeros too. Where registers may be wider or narrower than a
 * double (x87, whose control word may say 24 bits), U is that of 24 bits, and no rounding is taken for exact.
 *
 * In integers: sign * limbs * base^exponent, of any exponent, so that ordinary inputs take one or two
 * limbs. */
#if TBX_DOUBLE_IS_53_BITS
#define TBX_NUM_ERROR 4.44089209850062616169452667236328125e-16 /* 2^-51 */
#else
#define TBX_NUM_ERROR 2.384185791015625e-07 /* 2^-22 */
#endif

/* ---- numbers at the door */

enum { TBX_FLOAT, TBX_DOUBLE }; /* formats of the numbers that come and go */

/* A number as it came in. Whatever decides looks at the key, an integer that orders as numbers do: the bits
 * of the double of the same value, negated where that is negative, so both zeros are 0; NaN lies beyond the
 * infinities. Arithmetic takes the value, which is 0 where the number is not finite. */
typedef struct tbx_real {
    int64_t key;
    double value;
} tbx_real;

#define TBX_KEY_INFINITY ((int64_t)2047 << 52)

/* The sign of a - b. */
TBX_FN int tbx_key_order(int64_t a, int64_t b)
{
    return (a > b) - (a < b);
}

TBX_FN int tbx_key_sign(int64_t key)
{
    return tbx_key_order(key, 0);
}

TBX_FN int tbx_key_is_finite(int64_t key)
{
    return key < TBX_KEY_INFINITY && key > -TBX_KEY_INFINITY;
}

TBX_FN int tbx_key_is_nan(int64_t key)
{
    return key > TBX_KEY_INFINITY || key < -TBX_KEY_INFINITY;
}

/* The magnitude of a float's bits as a double's. */
TBX_FN uint64_t tbx_widen_magnitude(uint32_t magnitude)
{
    if (TBX_RARELY(magnitude - 0x00800000u >= 0x7f000000u)) {
        double wide = 0.0;
        if (magnitude != 0) {
            tbx_widen_unusual(&wide, magnitude);
        }
        return tbx_bits64(&wide);
    }
    return ((uint64_t)magnitude << 29) + ((uint64_t)(1023 - 127) << 52);
}

/* Numbers of doubles' magnitudes for which the run in double holds. */
TBX_FN int tbx_is_odd(uint64_t magnitude)
{
    const uint64_t least = (uint64_t)(1023 - 97) << 52;
    const uint64_t most = (uint64_t)(1023 + 130) << 52;
    return (magnitude - 1u < least - 1u) | (magnitude >= most);
}

/* Reads a number of the format, at any alignment. Returns 1 if it is finite, and beyond the range of the run
 * in double. */
TBX_FN int tbx_read1(tbx_real *out, const void *x, int format)
{
    uint64_t magnitude;
    uint64_t sign;
    uint64_t finite;
    if (format == TBX_FLOAT) {
        uint32_t bits;
        TBX_COPY(&bits, x, sizeof bits);
        bits = tbx_opaque32(bits);
        magnitude = tbx_widen_magnitude(bits & 0x7fffffffu);
        sign = bits >> 31;
    } else {
        uint64_t bits;
        TBX_COPY(&bits, x, sizeof bits);
        bits = tbx_opaque64(bits);
        magnitude = bits & 0x7fffffffffffffffu;
        sign = bits >> 63;
    }
    finite = magnitude < (uint64_t)TBX_KEY_INFINITY ? magnitude : 0;
    out->key = (int64_t)((magnitude ^ (0u - sign)) + sign);
    out->value = tbx_from_bits64(finite | (sign << 63));
    return format == TBX_DOUBLE && tbx_is_odd(finite);
}

/* Reads n numbers, likewise. */
TBX_NOINLINE int tbx_read(tbx_real *out, const void *x, int n, int format)
{
    int odd = 0;
    int i;
    for (i = 0; i < n && format == TBX_FLOAT; i++) {
        (void)tbx_read1(&out[i], (const char *)x + 4 * i, TBX_FLOAT);
    }
    for (i = 0; i < n && format == TBX_DOUBLE; i++) {
        odd |= tbx_read1(&out[i], (const char *)x + 8 * i, TBX_DOUBLE);
    }
    return odd;
}

/* Three points. */
TBX_FN int tbx_read3(tbx_real out[3][3], const void *x, const void *y, const void *z, int format)
{
    return tbx_read(out[0], x, 3, format) | tbx_read(out[1], y, 3, format) | tbx_read(out[2], z, 3, format);
}

/* Looks at a double: negative unless it is 0, or finite and in the range of the run in double. */
TBX_FN int64_t tbx_scan(const double *x)
{
    const int64_t magnitude = (int64_t)(tbx_bits64(x) & 0x7fffffffffffffffu);
    const int64_t least = (int64_t)(1023 - 97) << 52;
    const int64_t most = ((int64_t)(1023 + 130) << 52) - 1;
    return ((magnitude - least) & -magnitude) | (most - magnitude);
}

TBX_FN int64_t tbx_scan3(const double x[3])
{
    return tbx_scan(x) | tbx_scan(x + 1) | tbx_scan(x + 2);
}

/* A float that was looked at, as a double; not before: signalling NaN would raise a flag. */
TBX_FN double tbx_take(const float *x)
{
    float narrow = *x;
    TBX_KEEP_SCALAR(narrow);
    return (double)narrow;
}

/* Three numbers, likewise. */
TBX_FORCED void tbx_take3(double out[3], const void *x, int format)
{
    if (format == TBX_FLOAT) {
        tbx_take3_float(out, x);
    } else {
        TBX_COPY(out, x, 3 * sizeof *out);
    }
}

/* Is the float subnormal, infinite or NaN, which plain double does not take? */
TBX_FN int tbx_odd1(const float *x)
{
    return tbx_is_unusual(tbx_bits32(x));
}

#if !TRIBOX_SIMD
/* Is one of twelve floats odd? */
TBX_FN int tbx_odd4(const float a[3], const float b[3], const float c[3], const float d[3])
{
    return ((tbx_unusual6(a, b) | tbx_unusual6(c, d)) & TBX_PAIR_SIGNS) != 0;
}
#endif

/* Four points of the format, as doubles. Returns 0 where plain double does not take some number. */
TBX_FORCED int tbx_take12(double out[4][3], const void *a, const void *b, const void *c, const void *d,
                          int format)
{
    if (format == TBX_FLOAT
            ? tbx_odd4((const float *)a, (const float *)b, (const float *)c, (const float *)d)
            : (tbx_scan3((const double *)a) | tbx_scan3((const double *)b) | tbx_scan3((const double *)c) |
               tbx_scan3((const double *)d)) < 0) {
        return 0;
    }
    tbx_take3(out[0], a, format);
    tbx_take3(out[1], b, format);
    tbx_take3(out[2], c, format);
    tbx_take3(out[3], d, format);
    return 1;
}

TBX_FN void tbx_minus3(double out[3], const double a[3], const double b[3])
{
    out[0] = a[0] - b[0];
    out[1] = a[1] - b[1];
    out[2] = a[2] - b[2];
}

TBX_FN double tbx_dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

#define TBX_FLOAT_INFINITY ((int64_t)0x7f800000)

/* The key in the format of a double's key whose number the format holds. */
TBX_FN int64_t tbx_format_key(int64_t key, int format)
{
    const uint64_t magnitude = tbx_magnitude64(key);
    const int exponent = (int)(magnitude >> 52) - (1023 - 127);
    int64_t narrow;
    if (format == TBX_DOUBLE) {
        return key;
    }
    if (exponent >= 255) {
        narrow = TBX_FLOAT_INFINITY;
    } else if (exponent >= 1) {
        narrow = (int64_t)(magnitude >> 29) - ((int64_t)(1023 - 127) << 23);
    } else {
        narrow =
            exponent <= -24
                ? 0
                : (int64_t)(((magnitude & 0x000fffffffffffffu) | 0x0010000000000000u) >> (30 - exponent));
    }
    return key < 0 ? -narrow : narrow;
}

/* Writes number i of an array of the format, if it is wanted. */
TBX_FN void tbx_write(void *out, int i, int format, int64_t key)
{
    if (out == NULL) {
        return;
    }
    if (format == TBX_FLOAT) {
        const uint32_t bits = (uint32_t)tbx_magnitude64(key) | (key < 0 ? 0x80000000u : 0u);
        TBX_COPY((char *)out + 4 * i, &bits, sizeof bits);
    } else {
        const uint64_t bits = tbx_magnitude64(key) | (key < 0 ? (uint64_t)1 << 63 : 0u);
        TBX_COPY((char *)out + 8 * i, &bits, sizeof bits);
    }
}

TBX_FN int tbx_finite(const tbx_real *x, int n)
{
    int finite = 1;
    int i;
    for (i = 0; i < n; i++) {
        finite &= tbx_key_is_finite(x[i].key);
    }
    return finite;
}

/* Does lo..hi hold a real number? Not with NaN, lo > hi, or both at one infinity. */
TBX_FN int tbx_range_valid(const tbx_real *lo, const tbx_real *hi)
{
    return lo->key <= hi->key && lo->key >= -TBX_KEY_INFINITY && lo->key < TBX_KEY_INFINITY &&
           hi->key <= TBX_KEY_INFINITY && hi->key > -TBX_KEY_INFINITY;
}

TBX_FN int tbx_box_valid(const tbx_real lo[3], const tbx_real hi[3])
{
    return tbx_range_valid(&lo[0], &hi[0]) & tbx_range_valid(&lo[1], &hi[1]) &
           tbx_range_valid(&lo[2], &hi[2]);
}

/* ---- numbers of the two runs: tbx_num */

/* Where the limbs of a calculation's numbers lie, one behind the other. */
typedef struct tbx_calc {
    int exact;       /* 1: in integers; 0: in double */
    int unsure;      /* in double: some sign was not certain, what follows means nothing */
    int used;        /* limbs of the store */
    tbx_limb *store; /* in integers */
} tbx_calc;

TBX_FN void tbx_calc_begin(tbx_calc *c, int exact, tbx_limb *store)
{
    c->exact = exact;
    c->unsure = 0;
    c->used = 0;
    c->store = store;
}

/* Behind a run: is another one needed, in integers? These are never unsure. */
TBX_FN int tbx_calc_again(tbx_calc *c)
{
    const int unsure = c->unsure;
    tbx_calc_begin(c, 1, c->store);
    return unsure;
}

/* A value of either kind. Limbs are never changed once they are written, so numbers may be copied. */
typedef struct tbx_num {
    double mid; /* in double: see above */
    double rad;
    int sign; /* in integers: sign * sum of store[at + i] * base^(exponent + i), i < n, base 2^LIMB_BITS */
    int exponent;
    int at;
    int n; /* the first and the last limb are not 0; no limbs, no sign, for 0 */
} tbx_num;

/* Ends a number whose n limbs were written at the end of the store: drops zeros at both ends. */
TBX_FN void tbx_num_end(tbx_calc *c, tbx_num *r, int n, int exponent, int sign)
{
    r->at = c->used;
    c->used += n;
    while (n > 0 && c->store[r->at + n - 1] == 0) {
        n--;
    }
    while (n > 0 && c->store[r->at] == 0) {
        r->at++;
        exponent++;
        n--;
    }
    r->mid = 0.0; /* unused; compilers warn of what they cannot see */
    r->rad = 0.0;
    r->n = n;
    r->exponent = exponent;
    r->sign = n == 0 ? 0 : sign;
}

/* Moves a number's limbs. */
TBX_FN void tbx_num_move(const tbx_calc *c, tbx_num *r, int at)
{
    int i;
    for (i = 0; i < r->n; i++) {
        c->store[at + i] = c->store[r->at + i];
    }
    r->at = at;
}

/* Gives back what was used since `mark`, but for the numbers r, in the order in which they were made, whose
 * limbs are moved there. */
TBX_FN void tbx_num_keep(tbx_calc *c, int mark, tbx_num *r, int count)
{
    int i;
    for (i = 0; i < count && c->exact; i++) {
        tbx_num_move(c, &r[i], mark);
        mark += r[i].n;
    }
    c->used = mark;
}

/* r = mantissa * 2^exponent */
TBX_NOINLINE void tbx_num_set_exact(tbx_calc *c, tbx_num *r, int64_t mantissa, int exponent)
{
    uint64_t rest = tbx_magnitude64(mantissa);
    const int limb = (exponent + 128 * TBX_LIMB_BITS) / TBX_LIMB_BITS - 128; /* rounded down */
    const int shift = exponent - limb * TBX_LIMB_BITS;
    tbx_limb *to = c->store + c->used;
    tbx_two_limbs carry = 0;
    int n = 0;
    while (rest != 0 || carry != 0) {
        carry += (tbx_two_limbs)(tbx_limb)rest << shift;
        to[n++] = (tbx_limb)carry;
        carry >>= TBX_LIMB_BITS;
        rest = TBX_LIMB_BITS < 64 ? rest >> (TBX_LIMB_BITS & 63) : 0;
    }
    tbx_num_end(c, r, n, limb, mantissa < 0 ? -1 : 1);
}

/* The limb worth base^i. */
TBX_FN tbx_limb tbx_num_limb(const tbx_calc *c, const tbx_num *a, int i)
{
    return i >= a->exponent && i - a->exponent < a->n ? c->store[a->at + i - a->exponent] : 0;
}

/* r = a + sign * b. Where signs differ, the magnitudes' difference in two's complement, negated if it is
 * below 0. */
TBX_NOINLINE void tbx_num_add_exact(tbx_calc *c, tbx_num *r, const tbx_num *a, const tbx_num *b, int sign)
{
    const int b_sign = sign * b->sign;
    const int a_hi = a->exponent + a->n;
    const int b_hi = b->exponent + b->n;
    const int lo = a->exponent < b->exponent ? a->exponent : b->exponent;
    const int n = (a_hi > b_hi ? a_hi : b_hi) - lo + 1;
    const int opposite = a->sign != b_sign;
    const tbx_limb flip = (tbx_limb)0 - (tbx_limb)opposite;
    tbx_limb *to = c->store + c->used;
    tbx_two_limbs carry = (tbx_two_limbs)opposite;
    int i;
    if (a->sign == 0 || b_sign == 0) {
        const int r_sign = a->sign + b_sign;
        *r = a->sign != 0 ? *a : *b;
        r->sign = r_sign;
        return;
    }
    for (i = 0; i < n; i++) {
        carry += (tbx_two_limbs)tbx_num_limb(c, a, lo + i) + (tbx_num_limb(c, b, lo + i) ^ flip);
        to[i] = (tbx_limb)carry;
        carry >>= TBX_LIMB_BITS;
    }
    if (opposite && to[n - 1] != 0) {
        carry = 1;
        for (i = 0; i < n; i++) {
            carry += (tbx_limb)~to[i];
            to[i] = (tbx_limb)carry;
            carry >>= TBX_LIMB_BITS;
        }
        tbx_num_end(c, r, n, lo, b_sign);
    } else {
        tbx_num_end(c, r, n, lo, a->sign);
    }
}

/* r = a * b */
TBX_NOINLINE void tbx_num_mul_exact(tbx_calc *c, tbx_num *r, const tbx_num *a, const tbx_num *b)
{
    const int sign = a->sign * b->sign;
    if (sign != 0) {
        tbx_limbs_mul(c->store + c->used, c->store + a->at, a->n, c->store + b->at, b->n);
    }
    tbx_num_end(c, r, sign != 0 ? a->n + b->n : 0, a->exponent + b->exponent, sign);
}

/* The limbs of the numbers of one run in integers; at most 12 KiB are ever used (the tests look). A number of
 * degree d takes at most 280 d + 8 bits from floats, 2100 d + 8 from doubles, and two limbs for its unaligned
 * ends. */
#define TBX_STORE (98304 / TBX_LIMB_BITS)

/* |a|, not 0, cut to its 64 highest bits, the first of them set, times 2^exponent. */
TBX_FN uint64_t tbx_num_top(const tbx_calc *c, const tbx_num *a, int *out_exponent)
{
    int i = a->exponent + a->n - 1;
    int shift = 0;
    uint64_t top = (uint64_t)tbx_num_limb(c, a, i);
    uint64_t rest = (uint64_t)tbx_num_limb(c, a, i - 1);
#if TBX_LIMB_BITS == 32
    top = top << 32 | rest;
    rest = (uint64_t)tbx_num_limb(c, a, i - 2) << 32;
    i--;
#endif
#if TBX_HAS_ASM
    shift = __builtin_clzll(top);
#else
    while (top << shift >> 63 == 0) {
        shift++;
    }
#endif
    *out_exponent = i * TBX_LIMB_BITS - shift;
    return shift != 0 ? top << shift | rest >> (64 - shift) : top;
}

/* |a|, not 0, as out_value * 2^(the exponent returned), to a few ulp of double. */
TBX_COLD int tbx_num_value_exact(const tbx_calc *c, const tbx_num *a, double *out_value)
{
    int exponent;
    *out_value = (double)(int64_t)(tbx_num_top(c, a, &exponent) >> 1);
    return exponent + 1;
}

/* r = mantissa * 2^exponent; in double, |mantissa| <= 2^53 and the value in range */
TBX_FN void tbx_num_integer(tbx_calc *c, tbx_num *r, int64_t mantissa, int exponent)
{
    if (c->exact) {
        tbx_num_set_exact(c, r, mantissa, exponent);
    } else {
        r->mid = (double)mantissa * tbx_from_bits64((uint64_t)(1023 + exponent) << 52);
        r->rad = 0.0;
    }
}

/* The finite number of a format's key is mantissa * 2^exponent. */
TBX_FN int tbx_key_split(int64_t key, int format, int64_t *out_mantissa)
{
    const int bits = format == TBX_FLOAT ? 23 : 52;
    const int64_t magnitude = key < 0 ? -key : key;
    const int64_t one = (int64_t)1 << bits;
    int64_t mantissa = magnitude & (one - 1);
    int exponent = (int)(magnitude >> bits);
    mantissa += exponent != 0 ? one : 0;
    exponent += exponent == 0;
    *out_mantissa = key < 0 ? -mantissa : mantissa;
    return exponent - (format == TBX_FLOAT ? 150 : 1075);
}

/* r = x, which is finite */
TBX_FN void tbx_num_of(tbx_calc *c, tbx_num *r, const tbx_real *x)
{
    if (c->exact) {
        int64_t mantissa;
        const int exponent = tbx_key_split(x->key, TBX_DOUBLE, &mantissa);
        tbx_num_set_exact(c, r, mantissa, exponent);
    } else {
        r->mid = x->value;
        r->rad = 0.0;
    }
}

/* Have both numbers at most 24 bits? */
TBX_FN int tbx_both_short(double a, double b)
{
    return TBX_DOUBLE_IS_53_BITS && ((tbx_bits64(&a) | tbx_bits64(&b)) & 0x1fffffffu) == 0;
}

TBX_FN int tbx_sum_is_exact(double a, double b)
{
    const int64_t e = (int64_t)(tbx_bits64(&a) >> 52 & 0x7ffu);
    const int64_t f = (int64_t)(tbx_bits64(&b) >> 52 & 0x7ffu);
    return TBX_DOUBLE_IS_53_BITS &&
           (e == 0 || f == 0 || (e - f <= 28 && f - e <= 28 && tbx_both_short(a, b)));
}

/* r = a + sign * b; r may be a or b, here and below */
TBX_FN void tbx_num_add(tbx_calc *c, tbx_num *r, const tbx_num *a, const tbx_num *b, int sign)
{
    if (c->exact) {
        tbx_num_add_exact(c, r, a, b, sign);
    } else {
        const double rad = a->rad + b->rad;
        double mid = sign > 0 ? a->mid + b->mid : a->mid - b->mid;
        TBX_KEEP_SCALAR(mid);
        r->rad = rad > 0.0 || !tbx_sum_is_exact(a->mid, b->mid) ? rad + TBX_NUM_ERROR * tbx_abs(mid) : 0.0;
        r->mid = mid;
    }
}

TBX_FN void tbx_num_mul(tbx_calc *c, tbx_num *r, const tbx_num *a, const tbx_num *b)
{
    if (c->exact) {
        tbx_num_mul_exact(c, r, a, b);
    } else {
        const double mid = a->mid * b->mid;
        const double rad = tbx_abs(a->mid) * b->rad + tbx_abs(b->mid) * a->rad + a->rad * b->rad;
        r->rad = rad > 0.0 || !tbx_both_short(a->mid, b->mid) ? rad + TBX_NUM_ERROR * tbx_abs(mid) : 0.0;
        r->mid = mid;
    }
}

TBX_NOINLINE void tbx_num_difference_exact(tbx_calc *c, tbx_num *r, const tbx_real *x, const tbx_real *y)
{
    const int mark = c->used;
    tbx_num a;
    tbx_num b;
    tbx_num_of(c, &a, x);
    tbx_num_of(c, &b, y);
    tbx_num_add_exact(c, r, &a, &b, -1);
    tbx_num_keep(c, mark, r, 1);
}

/* r = x - y, of two inputs */
TBX_FN void tbx_num_difference(tbx_calc *c, tbx_num *r, const tbx_real *x, const tbx_real *y)
{
    if (c->exact) {
        tbx_num_difference_exact(c, r, x, y);
    } else {
        double mid = x->value - y->value;
        TBX_KEEP_SCALAR(mid);
        r->rad = tbx_sum_is_exact(x->value, y->value) ? 0.0 : TBX_NUM_ERROR * tbx_abs(mid);
        r->mid = mid;
    }
}

TBX_FN void tbx_num_flip(const tbx_calc *c, tbx_num *r, int sign)
{
    if (c->exact) {
        r->sign *= sign;
    } else {
        r->mid = sign < 0 ? -r->mid : r->mid;
    }
}

TBX_FN int tbx_num_sign(tbx_calc *c, const tbx_num *a)
{
    if (c->exact) {
        return a->sign;
    }
    if (a->mid > 2.0 * a->rad) {
        return 1;
    }
    if (-a->mid > 2.0 * a->rad) {
        return -1;
    }
    c->unsure |= a->rad > 0.0;
    return 0;
}

/* r = x.y */
TBX_FN void tbx_num_dot(tbx_calc *c, tbx_num *r, const tbx_num x[3], const tbx_num y[3])
{
    const int mark = c->used;
    tbx_num sum;
    int k;
    tbx_num_mul(c, &sum, &x[0], &y[0]);
    for (k = 1; k < 3; k++) {
        tbx_num xy;
        tbx_num_mul(c, &xy, &x[k], &y[k]);
        tbx_num_add(c, &sum, &sum, &xy, 1);
        tbx_num_keep(c, mark, &sum, 1);
    }
    *r = sum;
}

/* r = x * y, r neither x nor y */
TBX_FN void tbx_num_cross(tbx_calc *c, tbx_num r[3], const tbx_num x[3], const tbx_num y[3])
{
    int k;
    for (k = 0; k < 3; k++) {
        const int mark = c->used;
        const int l = (k + 1) % 3;
        const int m = (k + 2) % 3;
        tbx_num xy;
        tbx_num_mul(c, &r[k], &x[l], &y[m]);
        tbx_num_mul(c, &xy, &x[m], &y[l]);
        tbx_num_add(c, &r[k], &r[k], &xy, -1);
        tbx_num_keep(c, mark, &r[k], 1);
    }
}

TBX_FN void tbx_num_difference3(tbx_calc *c, tbx_num r[3], const tbx_real x[3], const tbx_real y[3])
{
    int k;
    for (k = 0; k < 3; k++) {
        tbx_num_difference(c, &r[k], &x[k], &y[k]);
    }
}

/* (v1 - v0) x (v2 - v0) */
TBX_FN void tbx_num_normal(tbx_calc *c, tbx_num r[3], const tbx_real v0[3], const tbx_real v1[3],
                           const tbx_real v2[3])
{
    const int mark = c->used;
    tbx_num x[3];
    tbx_num y[3];
    tbx_num_difference3(c, x, v1, v0);
    tbx_num_difference3(c, y, v2, v0);
    tbx_num_cross(c, r, x, y);
    tbx_num_keep(c, mark, r, 3);
}

/* ---- fractions */

/* n / d with d > 0, or d = 0: infinite with the sign of n. A plain struct of two, never stored reduced. */
typedef struct tbx_fraction {
    tbx_num n;
    tbx_num d;
} tbx_fraction;

/* The fraction of a number that is not NaN. */
TBX_FN void tbx_fraction_of(tbx_calc *c, tbx_fraction *r, const tbx_real *x)
{
    const int finite = tbx_key_is_finite(x->key);
    if (finite) {
        tbx_num_of(c, &r->n, x);
    } else {
        tbx_num_integer(c, &r->n, tbx_key_sign(x->key), 0);
    }
    tbx_num_integer(c, &r->d, finite, 0);
}

/* Makes d positive, by a sign that is certain. */
TBX_FN void tbx_fraction_orient(const tbx_calc *c, tbx_fraction *r, int d_sign)
{
    tbx_num_flip(c, &r->n, d_sign);
    tbx_num_flip(c, &r->d, d_sign);
}

/* The sign of a - b; equal infinities give 0. */
TBX_FN int tbx_fraction_compare(tbx_calc *c, const tbx_fraction *a, const tbx_fraction *b)
{
    const int mark = c->used;
    tbx_num x;
    tbx_num y;
    tbx_num_mul(c, &x, &a->n, &b->d);
    tbx_num_mul(c, &y, &b->n, &a->d);
    tbx_num_add(c, &x, &x, &y, -1);
    c->used = mark;
    return tbx_num_sign(c, &x);
}

enum { TBX_DOWN, TBX_NEAREST, TBX_UP }; /* NEAREST: ties to even */

/* The infinity's key in a format; the keys before it are those of the finite numbers. */
TBX_FN int64_t tbx_key_infinity(int format)
{
    return format == TBX_FLOAT ? TBX_FLOAT_INFINITY : TBX_KEY_INFINITY;
}

/* Is x, rounded, at least the number with this key? The least x for which it is: the number itself (down),
 * just above the one before (up), or half-way between the two, itself included for an even number
 * (nearest; x is then no larger than the largest number). Half-way: of two neighbours the one nearer to 0 is
 * mantissa * 2^exponent, the other one unit of that exponent farther. */
TBX_FN int tbx_rounds_to_at_least(tbx_calc *c, const tbx_fraction *x, int format, int64_t key, int rounding)
{
    const int mark = c->used;
    const int64_t infinity = tbx_key_infinity(format);
    const int64_t from = rounding == TBX_DOWN || (rounding == TBX_NEAREST && key <= 0) ? key : key - 1;
    tbx_num border;
    int64_t mantissa;
    int exponent;
    int order;
    if (key - (rounding != TBX_DOWN) <= -infinity) {
        return 1;
    }
    if (key - (rounding == TBX_UP) >= infinity) {
        return 0;
    }
    exponent = tbx_key_split(from, format, &mantissa);
    if (rounding == TBX_NEAREST) {
        mantissa = 2 * mantissa + (key <= 0 ? -1 : 1);
        exponent--;
    }
    tbx_num_integer(c, &border, mantissa, exponent);
    tbx_num_mul(c, &border, &border, &x->d);
    tbx_num_add(c, &border, &x->n, &border, -1);
    c->used = mark;
    order = tbx_num_sign(c, &border);
    return order > 0 || (order == 0 && (rounding == TBX_DOWN || (rounding == TBX_NEAREST && (key & 1) == 0)));
}

/* |a|, not 0, as m * 2^(the exponent returned), about: out_bits are those of m, a double in [1, 2). */
TBX_FN int tbx_num_split(const tbx_calc *c, const tbx_num *a, uint64_t *out_bits)
{
    double value = a->mid;
    int exponent = 0;
    uint64_t bits;
    if (c->exact) {
        exponent = tbx_num_value_exact(c, a, &value);
    }
    bits = tbx_bits64(&value);
    *out_bits = (bits & 0x000fffffffffffffu) | (uint64_t)1023 << 52;
    return exponent + (int)(bits >> 52 & 0x7ffu) - 1023;
}

/* Where to look for the fraction: a key near that of n / d. The quotient is one of numbers in [1, 2),
 * whatever n and d are. */
TBX_FN int64_t tbx_fraction_guess(tbx_calc *c, const tbx_fraction *x, int format, int rounding)
{
    const int bits = format == TBX_FLOAT ? 23 : 52;
    const int bias = format == TBX_FLOAT ? 127 : 1023;
    const int64_t most = tbx_key_infinity(format) - 1;
    const int sign = tbx_num_sign(c, &x->n);
    uint64_t n_bits;
    uint64_t d_bits;
    uint64_t mantissa;
    double quotient;
    int64_t magnitude;
    int exponent;
    int shift = 52 - bits;
    if (sign == 0) {
        return 0;
    }
    exponent = tbx_num_split(c, &x->n, &n_bits) - tbx_num_split(c, &x->d, &d_bits);
    quotient = tbx_from_bits64(n_bits) / tbx_from_bits64(d_bits);
    mantissa = tbx_bits64(&quotient);
    exponent += (int)(mantissa >> 52) - 1023 + bias;
    mantissa = (mantissa & 0x000fffffffffffffu) | 0x0010000000000000u;
    if (exponent > 2 * bias) {
        return sign * most;
    }
    if (exponent < 1) { /* subnormal */
        shift += 1 - exponent;
        exponent = 1;
    }
    shift = shift < 62 ? shift : 62;
    /* the leading bit adds one to the exponent */
    magnitude = ((int64_t)(exponent - 1) << bits) + (int64_t)(mantissa >> shift);
    if (rounding == TBX_NEAREST ? shift > 0 && (mantissa >> (shift - 1) & 1u) != 0
                                : (rounding == TBX_UP) == (sign > 0)) {
        magnitude++;
    }
    return sign * (magnitude < most ? magnitude : most);
}

/* The fraction, which is finite, in a format, as a key. From the guess, steps that double, then halve, find
 * the greatest number that x rounds to at least. In double the digits of a double are never certain. */
TBX_FN int64_t tbx_fraction_round(tbx_calc *c, const tbx_fraction *x, int format, int rounding)
{
    const int64_t infinity = tbx_key_infinity(format);
    int64_t lo = -infinity; /* x rounds to at least lo and to less than hi */
    int64_t hi = infinity + 1;
    int64_t step = 1;
    int64_t key;
    if (format == TBX_DOUBLE && !c->exact) {
        c->unsure = 1;
    }
    if (c->unsure) {
        return 0;
    }
    key = tbx_fraction_guess(c, x, format, rounding);
    if (tbx_rounds_to_at_least(c, x, format, key, rounding)) {
        lo = key;
        while (lo + step < hi && tbx_rounds_to_at_least(c, x, format, lo + step, rounding)) {
            lo += step;
            step *= 2;
        }
        hi = lo + step < hi ? lo + step : hi;
    } else {
        hi = key;
        while (hi - step > lo && !tbx_rounds_to_at_least(c, x, format, hi - step, rounding)) {
            hi -= step;
            step *= 2;
        }
        lo = hi - step > lo ? hi - step : lo;
    }
    while (hi - lo > 1) {
        const int64_t mid = lo + (hi - lo) / 2;
        if (tbx_rounds_to_at_least(c, x, format, mid, rounding)) {
            lo = mid;
        } else {
            hi = mid;
        }
    }
    return lo;
}

/* ---- two boxes */

/* A number's key in its own format. */
TBX_FORCED int64_t tbx_own_key(const void *x, int k, int format)
{
    return format == TBX_FLOAT ? (int64_t)tbx_key32((const float *)x + k) : tbx_key64((const double *)x + k);
}

TBX_FORCED int tbx_box_box(const void *a_min, const void *a_max, const void *b_min, const void *b_max,
                               int format)
{
    const int64_t infinity = format == TBX_FLOAT ? TBX_FLOAT_INFINITY : TBX_KEY_INFINITY;
    int meet = 1;
    int k;
    for (k = 0; k < 3; k++) {
        const int64_t a = tbx_own_key(a_min, k, format);
        const int64_t b = tbx_own_key(a_max, k, format);
        const int64_t c = tbx_own_key(b_min, k, format);
        const int64_t d = tbx_own_key(b_max, k, format);
        meet &= (a <= b) & (c <= d) & (a <= d) & (c <= b);
        meet &= (a >= -infinity) & (a < infinity) & (b <= infinity) & (b > -infinity);
        meet &= (c >= -infinity) & (c < infinity) & (d <= infinity) & (d > -infinity);
    }
    return meet;
}

/* Of floats that can be compared as they are: what both have in common is not empty. */
TBX_FN int tbx_box_box_floats(const float a_min[3], const float a_max[3], const float b_min[3],
                              const float b_max[3])
{
    uint32_t meet = 1;
    int k;
    if (TBX_RARELY(tbx_odd4(a_min, a_max, b_min, b_max))) {
        return tbx_box_box(a_min, a_max, b_min, b_max, TBX_FLOAT);
    }
    TBX_UNROLL
    for (k = 0; k < 3; k++) {
        meet &= tbx_opaque32(tbx_maxf(a_min[k], b_min[k]) <= tbx_minf(a_max[k], b_max[k])); /* see tbx_more */
    }
    return (int)meet;
}

TRIBOX_FN int tribox_box_box(const float a_min[3], const float a_max[3], const float b_min[3],
                             const float b_max[3])
{
    return TBX_EITHER(tbx_box_box4, tbx_box_box_floats)(a_min, a_max, b_min, b_max);
}

TRIBOX_FN int tribox_box_box_f64(const double a_min[3], const double a_max[3], const double b_min[3],
                                 const double b_max[3])
{
    return tbx_box_box(a_min, a_max, b_min, b_max, TBX_DOUBLE);
}

/* ---- plane and box */

typedef struct tbx_plane {
    tbx_real n[3];
    tbx_real d;
    tbx_real lo[3];
    tbx_real hi[3];
} tbx_plane;

/* The sign of the greatest value of side * (n.q + d) over the box; an infinite face decides it. */
TBX_FN int tbx_plane_side(tbx_calc *c, const tbx_plane *p, int side)
{
    tbx_num sum;
    int k;
    tbx_num_of(c, &sum, &p->d);
    for (k = 0; k < 3; k++) {
        const int n_sign = tbx_key_sign(p->n[k].key);
        const tbx_real *q = side * n_sign > 0 ? &p->hi[k] : &p->lo[k];
        tbx_num x;
        tbx_num y;
        if (n_sign == 0) {
            continue;
        }
        if (!tbx_key_is_finite(q->key)) {
            return 1;
        }
        tbx_num_of(c, &x, &p->n[k]);
        tbx_num_of(c, &y, q);
        tbx_num_mul(c, &x, &x, &y);
        tbx_num_add(c, &sum, &sum, &x, 1);
    }
    return side * tbx_num_sign(c, &sum);
}

TBX_NOINLINE int tbx_plane_box(const tbx_plane *p)
{
    tbx_limb store[TBX_STORE];
    tbx_calc c;
    int side;
    tbx_calc_begin(&c, 0, store);
    do { /* 1: all of the box is below; -1: above; else -3 */
        for (side = 1; side >= -1 && tbx_plane_side(&c, p, side) >= 0; side -= 2) {
        }
    } while (tbx_calc_again(&c));
    return side >= -1 ? -side : 0;
}

TRIBOX_FN int tribox_plane_box(const float n[3], float d, const float box_min[3], const float box_max[3])
{
    tbx_plane p;
    int k;
    tbx_read1(&p.d, &d, TBX_FLOAT);
    for (k = 0; k < 3; k++) {
        tbx_read1(&p.n[k], &n[k], TBX_FLOAT);
        tbx_read1(&p.lo[k], &box_min[k], TBX_FLOAT);
        tbx_read1(&p.hi[k], &box_max[k], TBX_FLOAT);
    }
    if (!tbx_finite(p.n, 3) || tbx_key_is_nan(p.d.key) || !tbx_box_valid(p.lo, p.hi)) {
        return 2;
    }
    if (!tbx_key_is_finite(p.d.key)) {
        return tbx_key_sign(p.d.key);
    }
    return tbx_plane_box(&p);
}

/* ---- ray and box */

typedef struct tbx_ray {
    tbx_real origin[3];
    tbx_real dir[3];
    tbx_real t[2]; /* t_min, t_max */
} tbx_ray;

/* Reads a ray, t_min and t_max together. Returns what tbx_read does. */
TBX_FN int tbx_ray_read(tbx_ray *r, const void *origin, const void *dir, const void *t, int format)
{
    return tbx_read(r->origin, origin, 3, format) | tbx_read(r->dir, dir, 3, format) |
           tbx_read(r->t, t, 2, format);
}

/* A ray as a question: origin and direction finite, some real t in [t_min, t_max]. */
TBX_FN int tbx_ray_valid(const tbx_ray *r)
{
    return tbx_finite(r->origin, 3) & tbx_finite(r->dir, 3) & tbx_range_valid(&r->t[0], &r->t[1]);
}

typedef struct tbx_slabs {
    tbx_ray ray;
    tbx_real face[2][3]; /* lower, upper */
    int axis[2];         /* whose face the ray meets first, and last; -1: t_min or t_max comes first, last */
} tbx_slabs;

/* The face of axis k through which the ray enters (end 0) or leaves (1) its slab; dir is not 0 there. */
TBX_FN const tbx_real *tbx_slab_face(const tbx_slabs *s, int k, int end)
{
    return &s->face[end ^ (s->ray.dir[k].key < 0)][k];
}

/* When the ray meets that face, which is finite. */
TBX_FN void tbx_slab_time(tbx_calc *c, const tbx_slabs *s, int k, int end, tbx_fraction *out)
{
    tbx_num_difference(c, &out->n, tbx_slab_face(s, k, end), &s->ray.origin[k]);
    tbx_num_of(c, &out->d, &s->ray.dir[k]);
    tbx_fraction_orient(c, out, tbx_key_sign(s->ray.dir[k].key));
}

/* [KK86]: the ray is inside the box where it is inside all three slabs. One run; leaves s->axis. */
TBX_FN int tbx_slabs_run(tbx_calc *c, tbx_slabs *s)
{
    tbx_fraction end[2];
    int e;
    int k;
    for (e = 0; e < 2; e++) {
        s->axis[e] = -1;
        tbx_fraction_of(c, &end[e], &s->ray.t[e]);
    }
    for (k = 0; k < 3; k++) {
        if (s->ray.dir[k].key == 0) {
            if (s->ray.origin[k].key < s->face[0][k].key || s->ray.origin[k].key > s->face[1][k].key) {
                return 0;
            }
            continue;
        }
        for (e = 0; e < 2; e++) {
            tbx_fraction t;
            if (!tbx_key_is_finite(tbx_slab_face(s, k, e)->key)) {
                continue;
            }
            tbx_slab_time(c, s, k, e, &t);
            if (tbx_fraction_compare(c, &t, &end[e]) * (e == 0 ? 1 : -1) > 0) {
                end[e] = t;
                s->axis[e] = k;
            }
        }
    }
    return tbx_fraction_compare(c, &end[0], &end[1]) <= 0;
}

/* An end of the interval inside, outward, as a key of the format. */
TBX_FN int64_t tbx_slabs_end(tbx_calc *c, const tbx_slabs *s, int e, int format)
{
    tbx_fraction t;
    if (s->axis[e] < 0) {
        return tbx_format_key(s->ray.t[e].key, format);
    }
    tbx_slab_time(c, s, s->axis[e], e, &t);
    return tbx_fraction_round(c, &t, format, e == 0 ? TBX_DOWN : TBX_UP);
}

/* Bounds of the filter below. A difference, a reciprocal and their product are each rounded once, by 2^-52 in
 * any mode; the reciprocal, which fast-math may approximate, is checked to 2^-48: 2^-47 in all, and as much
 * again for the sum that compares two times. Nothing underflows: differences are 0 or at least 2^-149, dir is
 * below 2^130. */
#define TBX_SLAB_INVERSE_ERROR 3.552713678800501e-15 /* 2^-48 */
#define TBX_SLAB_ERROR 1.4210854715202004e-14        /* 2^-46 */

/* The key of the float at or below (up = 0) or above (1) every number nearer to t than error; 0 where
 * these have several, or t is not within the floats' normal range: the bits that a float has not are cut
 * off. */
TBX_FN int64_t tbx_round_outward(double t, double error, int up)
{
    const double x = t - error;
    const double y = t + error;
    const uint64_t bits = tbx_bits64(&x);
    const uint64_t magnitude = bits & 0x7fffffffffffffffu;
    const int64_t key = (int64_t)(magnitude >> 29) - ((int64_t)(1023 - 127) << 23);
    if (TBX_RARELY((bits ^ tbx_bits64(&y)) >> 29 != 0 ||
                   magnitude - ((uint64_t)(1023 - 120) << 52) > (uint64_t)240 << 52)) {
        return 0;
    }
    return bits >> 63 != 0 ? -(key + !up) : key + up;
}

#define TBX_SLAB_BEYOND TBX_POW2(300) /* past every time */

/* A ray and a box as they came. */
typedef struct tbx_ray_ask {
    const void *origin;
    const void *dir;
    const void *t; /* t_min and t_max */
    const void *box_min;
    const void *box_max;
    int format;
} tbx_ray_ask;

/* When a ray is inside the slab of axis k: in [out_first, out_last]. x: origin, dir, box_min, box_max.
 * Returns 1 where lo > hi, or the reciprocal is not known well enough. */
TBX_FN int tbx_slab_times(double x[4][3], int k, double *out_first, double *out_last, int *outside)
{
    const double o = x[0][k];
    const double d = x[1][k];
    const double lo = x[2][k];
    const double hi = x[3][k];
    const int flat = !(tbx_abs(d) > 0.0);
    double divisor = flat ? 1.0 : d;
    double inverse;
    double from = lo - o;
    double to = hi - o;
    TBX_KEEP_SCALAR(divisor);
    inverse = 1.0 / divisor;
    TBX_KEEP3(SCALAR, inverse, from, to);
    from = from * inverse;
    to = to * inverse;
    *out_first = tbx_lesser(from, to);
    *out_last = tbx_greater(from, to);
    if (TBX_RARELY(flat)) {
        *outside |= tbx_more(lo, o) | tbx_more(o, hi);
        *out_first = -TBX_SLAB_BEYOND;
        *out_last = TBX_SLAB_BEYOND;
    }
    return tbx_more(lo, hi) | !tbx_no_more(tbx_abs(inverse * divisor - 1.0), TBX_SLAB_INVERSE_ERROR);
}

/* A finite t or one past every time. */
TBX_FN double tbx_slab_limit(const tbx_real *t)
{
    return tbx_key_is_finite(t->key) ? t->value : t->key < 0 ? -TBX_SLAB_BEYOND : TBX_SLAB_BEYOND;
}

/* t_min and t_max alike. Returns 0 where plain double does not take them. */
TBX_NOINLINE int tbx_slab_limits(double out[2], const void *t, int format)
{
    tbx_real own[2];
    const int odd = tbx_read(own, t, 2, format);
    out[0] = tbx_slab_limit(&own[0]);
    out[1] = tbx_slab_limit(&own[1]);
    return !(odd | tbx_key_is_nan(own[0].key) | tbx_key_is_nan(own[1].key));
}

/* The same, where both are usual at once. */
TBX_FORCED int tbx_slab_ends(double out[2], const void *t, int format)
{
    const double *there = (const double *)t;
    if (format == TBX_FLOAT) {
        const float *narrow = (const float *)t;
        if (TBX_RARELY((tbx_unusual2(narrow) & TBX_PAIR_SIGNS) != 0)) {
            return tbx_slab_limits(out, t, format);
        }
        TBX_KEEP_POINTER(narrow);
        out[0] = (double)narrow[0];
        out[1] = (double)narrow[1];
        return 1;
    }
    if (TBX_RARELY((tbx_scan(there) | tbx_scan(there + 1)) < 0)) {
        return tbx_slab_limits(out, t, format);
    }
    TBX_COPY(out, t, 2 * sizeof *out);
    return 1;
}

/* Which of four times is the one at t? Its number, -1 for the fourth, or -2: several may be. */
TBX_FN int tbx_slabs_only(const double ends[4], double t)
{
    const double error = 2.0 * TBX_SLAB_ERROR * tbx_abs(t);
    const int reached = (tbx_abs(ends[0] - t) <= error) | (tbx_abs(ends[1] - t) <= error) << 1 |
                        (tbx_abs(ends[2] - t) <= error) << 2 | (tbx_abs(ends[3] - t) <= error) << 3;
    return (reached & (reached - 1)) != 0 ? -2 : reached == 8 ? -1 : reached >> 1; /* 1, 2, 4: 0, 1, 2 */
}

/* The slabs in double. A time is at most 2^131 * 2^97. The largest lower and the least upper end are no
 * farther from the exact ones than their errors. On a hit: axis[e] is the only one that may bring that end
 * (-1: t_min, t_max), t its time. */
TBX_FORCED int tbx_slabs_filter(const tbx_ray_ask *a, double t[2], int axis[2], int format)
{
    double x[4][3];
    double own[2];
    double first[4];
    double last[4];
    double error;
    int outside = 0;
    int unsure;
    if (!TBX_DOUBLE_IS_53_BITS || !tbx_slab_ends(own, a->t, format) ||
        !tbx_take12(x, a->origin, a->dir, a->box_min, a->box_max, format)) {
        return TBX_UNSURE;
    }
    unsure = tbx_slab_times(x, 0, &first[0], &last[0], &outside);
    unsure |= tbx_slab_times(x, 1, &first[1], &last[1], &outside);
    unsure |= tbx_slab_times(x, 2, &first[2], &last[2], &outside);
    first[3] = own[0];
    last[3] = own[1];
    t[0] = tbx_greater(tbx_greater(first[0], first[1]), tbx_greater(first[2], first[3]));
    t[1] = tbx_lesser(tbx_lesser(last[0], last[1]), tbx_lesser(last[2], last[3]));
    error = TBX_SLAB_ERROR * (tbx_abs(t[0]) + tbx_abs(t[1]));
    if (unsure) {
        return TBX_UNSURE;
    }
    if (outside | (t[0] - t[1] > error)) {
        return TBX_MISS;
    }
    axis[0] = tbx_slabs_only(first, t[0]);
    axis[1] = tbx_slabs_only(last, t[1]);
    return t[1] - t[0] > error && axis[0] != -2 && axis[1] != -2 ? TBX_HIT : TBX_UNSURE;
}

TBX_NOINLINE int tbx_slabs_filter_float(const tbx_ray_ask *a, double t[2], int axis[2])
{
    return tbx_slabs_filter(a, t, axis, TBX_FLOAT);
}

TBX_NOINLINE int tbx_slabs_filter_double(const tbx_ray_ask *a, double t[2], int axis[2])
{
    return tbx_slabs_filter(a, t, axis, TBX_DOUBLE);
}

TBX_FN int tbx_slabs_read(tbx_slabs *s, const tbx_ray_ask *a)
{
    return tbx_ray_read(&s->ray, a->origin, a->dir, a->t, a->format) |
           tbx_read(s->face[0], a->box_min, 3, a->format) | tbx_read(s->face[1], a->box_max, 3, a->format);
}

/* An end of the interval that one axis is known to bring. */
TBX_NOINLINE int64_t tbx_slabs_round(const tbx_ray_ask *a, int axis, int e)
{
    tbx_limb store[TBX_STORE];
    tbx_calc c;
    tbx_slabs s;
    int64_t key;
    tbx_calc_begin(&c, tbx_slabs_read(&s, a), store);
    s.axis[e] = axis;
    do {
        key = tbx_slabs_end(&c, &s, e, a->format);
    } while (tbx_calc_again(&c));
    return key;
}

/* What the filter leaves open. Leaves the axes. */
TBX_NOINLINE int tbx_slabs_slow(const tbx_ray_ask *a, int axis[2])
{
    tbx_limb store[TBX_STORE];
    tbx_calc c;
    tbx_slabs s;
    int hit;
    tbx_calc_begin(&c, tbx_slabs_read(&s, a), store);
    if (!tbx_ray_valid(&s.ray) || !tbx_box_valid(s.face[0], s.face[1])) {
        return 0;
    }
    do {
        hit = tbx_slabs_run(&c, &s);
    } while (tbx_calc_again(&c));
    axis[0] = s.axis[0];
    axis[1] = s.axis[1];
    return hit;
}

TBX_NOINLINE int tbx_ray_box(const tbx_ray_ask *a, void *out_t0, void *out_t1)
{
    void *out[2];
    double t[2];
    int axis[2] = { -1, -1 };
    int verdict =
        a->format == TBX_FLOAT ? tbx_slabs_filter_float(a, t, axis) : tbx_slabs_filter_double(a, t, axis);
    int sure = 1;
    int e;
    if (TBX_RARELY(verdict == TBX_UNSURE)) {
        verdict = tbx_slabs_slow(a, axis);
        sure = 0;
    }
    out[0] = out_t0;
    out[1] = out_t1;
    for (e = 0; e < 2 && verdict == TBX_HIT; e++) {
        if (out[e] != NULL) {
            int64_t key = 0;
            if (sure && axis[e] >= 0 && a->format == TBX_FLOAT) {
                key = tbx_round_outward(t[e], TBX_SLAB_ERROR * tbx_abs(t[e]), e);
            }
            tbx_write(out[e], 0, a->format, key != 0 ? key : tbx_slabs_round(a, axis[e], e));
        }
    }
    return verdict;
}

TBX_FN tbx_ray_ask tbx_ray_asked(const void *origin, const void *dir, const void *t, const void *box_min,
                                 const void *box_max, int format)
{
    tbx_ray_ask a;
    /* gcc warned of code for doubles, where it knew that floats are there */
    TBX_KEEP4(POINTER, origin, dir, box_min, box_max);
    a.origin = origin;
    a.dir = dir;
    a.t = t;
    a.box_min = box_min;
    a.box_max = box_max;
    a.format = format;
    return a;
}

TRIBOX_FN int tribox_ray_box(const float origin[3], const float dir[3], float t_min, float t_max,
                             const float box_min[3], const float box_max[3], float *out_t0, float *out_t1)
{
    tbx_ray_ask a;
    float t[2];
    TBX_COPY(&t[0], &t_min, sizeof t_min);
    TBX_COPY(&t[1], &t_max, sizeof t_max);
    TBX_RETURN_IF_SURE(tbx_ray_filter(origin, dir, t, box_min, box_max, out_t0, out_t1));
    a = tbx_ray_asked(origin, dir, t, box_min, box_max, TBX_FLOAT);
    return tbx_ray_box(&a, out_t0, out_t1);
}

TRIBOX_FN int tribox_ray_box_f64(const double origin[3], const double dir[3], double t_min, double t_max,
                                 const double box_min[3], const double box_max[3], double *out_t0,
                                 double *out_t1)
{
    tbx_ray_ask a;
    double t[2];
    TBX_COPY(&t[0], &t_min, sizeof t_min);
    TBX_COPY(&t[1], &t_max, sizeof t_max);
    a = tbx_ray_asked(origin, dir, t, box_min, box_max, TBX_DOUBLE);
    return tbx_ray_box(&a, out_t0, out_t1);
}

/* ---- segment and box
 *
 * The segment is the triangle p, q, q, whose normal is 0: of "one box" there remain the faces, and the edges'
 * conditions of a chord. */

TBX_FORCED int tbx_segment_filter64(const void *p, const void *q, const void *box_min, const void *box_max,
                                    int format)
{
    double x[4][3];
    if (!TBX_DOUBLE_IS_53_BITS || !tbx_take12(x, p, q, box_min, box_max, format)) {
        return TBX_UNSURE;
    }
    return tbx_chord_meets(x[0], x[1], x[2], x[3]);
}

TBX_NOINLINE int tbx_segment_float(const float *p, const float *q, const float *box_min, const float *box_max)
{
    return tbx_segment_filter64(p, q, box_min, box_max, TBX_FLOAT);
}

TRIBOX_FN int tribox_segment_box(const float p[3], const float q[3], const float box_min[3],
                                 const float box_max[3])
{
    int verdict;
    TBX_RETURN_IF_SURE(tbx_segment_filter(p, q, box_min, box_max));
    verdict = tbx_segment_float(p, q, box_min, box_max);
    return verdict != TBX_UNSURE ? verdict : tbx_overlap_widened(p, q, q, box_min, box_max, 0);
}

TRIBOX_FN int tribox_segment_box_f64(const double p[3], const double q[3], const double box_min[3],
                                     const double box_max[3])
{
    const int verdict = tbx_segment_filter64(p, q, box_min, box_max, TBX_DOUBLE);
    return verdict != TBX_UNSURE ? verdict : tribox_overlap_f64(p, q, q, box_min, box_max);
}

/* ---- motion: sweeps, and rays in a triangle's plane
 *
 * The box B + t u meets T iff each of the 13 axes l lets their projections meet ("the exact test", at any
 * t), and each axis gives two conditions that are linear in t: for both l' = +-l,
 *
 *   max over B of l'.b - min over T of l'.v  +  t (l'.u)  >=  0.
 *
 * So the times of contact are one interval, and its ends are fractions. A ray is a box of one point, moving
 * by dir. */
/* 0..2 faces; 4 + 3a + i: edge i x axis a */
enum { TBX_AXIS_NORMAL = 3, TBX_AXES = 13 };

/* In integers the ends' limbs lie at the beginning of the store, each number's in a slot: degree 3 from
 * floats, degree 2 from doubles. */
#define TBX_MOTION_SLOT (4352 / TBX_LIMB_BITS)

typedef struct tbx_motion {
    tbx_calc calc;
    tbx_real v[3][3];
    tbx_real lo[3];
    tbx_real hi[3];
    tbx_real velocity[3];
    tbx_real t[2];       /* t_min, t_max */
    int axes;            /* so many of the 13 are asked */
    int open;            /* 1: touching does not count, every condition is strict */
    tbx_fraction end[2]; /* of the interval of t so far */
    int end_axis[2];     /* the axis that brought it, -1: t_min, t_max */
    int empty;
    int n_sign[3]; /* of the normal */
    int opens;     /* the axis whose interval opens at `first`, -1 if none; its side of T: */
    int opens_side;
    int touches; /* the first axis of zero gap at t = 0, -1 if none */
    int touches_side;
} tbx_motion;

TBX_FN void tbx_motion_set_end(tbx_motion *m, int e, const tbx_fraction *t)
{
    m->end[e] = *t;
    if (m->calc.exact) {
        tbx_num_move(&m->calc, &m->end[e].n, 2 * e * TBX_MOTION_SLOT);
        tbx_num_move(&m->calc, &m->end[e].d, (2 * e + 1) * TBX_MOTION_SLOT);
    }
}

/* Keeps those t of the interval for which c0 + t c1 >= 0, by axis and side of T. */
TBX_FN void tbx_motion_keep(tbx_motion *m, const tbx_num *c0, const tbx_num *c1, int axis, int side)
{
    tbx_calc *c = &m->calc;
    const int direction = tbx_num_sign(c, c1);
    const int gap = tbx_num_sign(c, c0);
    const int e = direction < 0;
    tbx_fraction t;
    int tighter;
    if (gap == 0 && m->touches < 0) {
        m->touches = axis;
        m->touches_side = side;
    }
    if (direction == 0) {
        m->empty |= gap < m->open;
        return;
    }
    t.n = *c0;
    t.d = *c1;
    tbx_fraction_orient(c, &t, direction);
    tbx_num_flip(c, &t.n, -1);
    tighter = direction * tbx_fraction_compare(c, &t, &m->end[e]);
    if (direction > 0 && (tighter > 0 || (tighter == 0 && m->opens < 0))) {
        m->opens = axis;
        m->opens_side = side;
    }
    if (tighter > 0) {
        tbx_motion_set_end(m, e, &t);
        m->end_axis[e] = axis;
    }
}

/* The axis as a vector: unit, normal, or edge i x unit a = (0, e_c, -e_b) from component a on. */
TBX_FN void tbx_motion_axis(tbx_motion *m, int axis, tbx_num l[3])
{
    tbx_calc *c = &m->calc;
    int k;
    if (axis < TBX_AXIS_NORMAL) {
        for (k = 0; k < 3; k++) {
            tbx_num_integer(c, &l[k], k == axis, 0);
        }
    } else if (axis == TBX_AXIS_NORMAL) {
        tbx_num_normal(c, l, m->v[0], m->v[1], m->v[2]);
    } else {
        const int a = (axis - 4) / 3;
        const int i = (axis - 4) % 3;
        const int b = (a + 1) % 3;
        const int e = (a + 2) % 3;
        const int j = (i + 1) % 3;
        tbx_num_integer(c, &l[a], 0, 0);
        tbx_num_difference(c, &l[b], &m->v[j][e], &m->v[i][e]);
        tbx_num_difference(c, &l[e], &m->v[i][b], &m->v[j][b]);
    }
}

/* The corner of T that is least (want = 1) or greatest (-1) along the axis. Along edge i x unit a: the
 * third corner lies at -n_a from corner i. */
TBX_FN int tbx_motion_corner(const tbx_motion *m, int axis, int want)
{
    int best = 0;
    int i;
    if (axis > TBX_AXIS_NORMAL) {
        i = (axis - 4) % 3;
        return m->n_sign[(axis - 4) / 3] * want > 0 ? (i + 2) % 3 : i;
    }
    for (i = 1; i < 3 && axis < TBX_AXIS_NORMAL; i++) {
        const int64_t key = m->v[i][axis].key;
        const int64_t best_key = m->v[best][axis].key;
        best = (want > 0 ? key < best_key : key > best_key) ? i : best;
    }
    return best;
}

/* r = l.x, where x is set only where l is not 0: two components of an edge's axis, one of a face's. */
TBX_FN void tbx_motion_dot(tbx_calc *c, tbx_num *r, const tbx_num l[3], const int l_sign[3],
                           const tbx_num x[3])
{
    const int mark = c->used;
    tbx_num sum;
    int terms = 0;
    int k;
    for (k = 0; k < 3; k++) {
        if (l_sign[k] != 0) {
            tbx_num term;
            tbx_num_mul(c, &term, &l[k], &x[k]);
            if (terms++ != 0) {
                tbx_num_add(c, &term, &term, &sum, 1);
            }
            tbx_num_keep(c, mark, &term, 1);
            sum = term;
        }
    }
    *r = sum;
}

/* The gap at t = 0 between T and the box's far face on a side of the axis: max over B of l'.b - min over T
 * of l'.v, l' = side * l. Returns 0 where the box has no end there. */
TBX_FN int tbx_motion_gap(tbx_motion *m, int axis, int side, const tbx_num l[3], const int l_sign[3],
                          tbx_num *out)
{
    tbx_calc *c = &m->calc;
    const tbx_real *v = m->v[tbx_motion_corner(m, axis, side)];
    const int mark = c->used;
    tbx_num gap[3];
    int k;
    if (axis < TBX_AXIS_NORMAL) {
        const tbx_real *q = side > 0 ? &m->hi[axis] : &m->lo[axis];
        if (!(tbx_key_is_finite(q->key) & tbx_key_is_finite(v[axis].key))) {
            return 0;
        }
        tbx_num_difference(c, out, q, &v[axis]);
        tbx_num_flip(c, out, side);
        return 1;
    }
    for (k = 0; k < 3; k++) {
        const tbx_real *q = l_sign[k] * side > 0 ? &m->hi[k] : &m->lo[k];
        if (l_sign[k] != 0) {
            if (!(tbx_key_is_finite(q->key) & tbx_key_is_finite(v[k].key))) {
                return 0;
            }
            tbx_num_difference(c, &gap[k], q, &v[k]);
        }
    }
    tbx_motion_dot(c, out, l, l_sign, gap);
    tbx_num_flip(c, out, side);
    tbx_num_keep(c, mark, out, 1);
    return 1;
}

/* The axis and the signs of its components. Returns 0 for one that is zero, and says nothing, or along a unit
 * vector, and says what a face says. */
TBX_FN int tbx_motion_signs(tbx_motion *m, int axis, tbx_num l[3], int l_sign[3])
{
    int k;
    tbx_motion_axis(m, axis, l);
    for (k = 0; k < 3; k++) {
        l_sign[k] = axis < TBX_AXIS_NORMAL ? k == axis : tbx_num_sign(&m->calc, &l[k]);
        if (axis == TBX_AXIS_NORMAL) {
            m->n_sign[k] = l_sign[k];
        }
    }
    return axis < TBX_AXIS_NORMAL || (l_sign[0] != 0) + (l_sign[1] != 0) + (l_sign[2] != 0) > 1;
}

/* How fast the box moves along the axis: r = l.u */
TBX_FN void tbx_motion_speed(tbx_motion *m, int axis, const tbx_num l[3], const int l_sign[3], tbx_num *r)
{
    tbx_num u[3];
    int k;
    if (axis < TBX_AXIS_NORMAL) {
        tbx_num_of(&m->calc, r, &m->velocity[axis]);
        return;
    }
    for (k = 0; k < 3; k++) {
        if (l_sign[k] != 0) {
            tbx_num_of(&m->calc, &u[k], &m->velocity[k]);
        }
    }
    tbx_motion_dot(&m->calc, r, l, l_sign, u);
}

/* Both conditions of one axis. */
TBX_FN void tbx_motion_clip(tbx_motion *m, int axis)
{
    tbx_calc *c = &m->calc;
    const int mark = c->used;
    tbx_num l[3];
    tbx_num speed;
    tbx_num gap;
    int l_sign[3];
    int side;
    if (tbx_motion_signs(m, axis, l, l_sign)) {
        tbx_motion_speed(m, axis, l, l_sign, &speed);
        for (side = 1; side >= -1; side -= 2) {
            if (tbx_motion_gap(m, axis, side, l, l_sign, &gap)) {
                tbx_num_flip(c, &speed, side);
                tbx_motion_keep(m, &gap, &speed, axis, -side);
                tbx_num_flip(c, &speed, side);
            }
        }
    }
    c->used = mark;
}

/* Do T and the moving box meet at some t in [t_min, t_max]? One run; leaves the interval in m. */
TBX_NOINLINE int tbx_motion_run(tbx_motion *m)
{
    tbx_calc *c = &m->calc;
    int axis;
    int e;
    c->unsure = 0;
    m->empty = 0;
    m->opens = -1;
    m->touches = -1;
    for (e = 0; e < 2; e++) {
        tbx_fraction t;
        c->used = c->exact ? 4 * TBX_MOTION_SLOT : 0;
        tbx_fraction_of(c, &t, &m->t[e]);
        tbx_motion_set_end(m, e, &t);
        m->end_axis[e] = -1;
    }
    for (axis = 0; axis < m->axes && !c->unsure && !m->empty; axis++) {
        tbx_motion_clip(m, axis);
        if (axis == TBX_AXIS_NORMAL - 1 || axis == m->axes - 1) {
            m->empty |= tbx_fraction_compare(c, &m->end[0], &m->end[1]) > -m->open;
        }
    }
    return !m->empty;
}

/* An end of the interval, found in this run, outward. */
TBX_FN int64_t tbx_motion_round(tbx_motion *m, int e, int format)
{
    return m->end_axis[e] < 0 ? tbx_format_key(m->t[e].key, format)
                              : tbx_fraction_round(&m->calc, &m->end[e], format, e == 0 ? TBX_DOWN : TBX_UP);
}

/* ---- ray and triangle */

typedef struct tbx_shot {
    tbx_ray ray;
    tbx_real v[3][3];
} tbx_shot;

/* When the line crosses the plane of T: n.(v0 - o) / n.dir. Returns the sign of the denominator; 0: never, or
 * always. */
TBX_FN int tbx_shot_time(tbx_calc *c, const tbx_shot *s, tbx_fraction *t)
{
    const int mark = c->used;
    tbx_num n[3];
    tbx_num x[3];
    int sign;
    int k;
    tbx_num_normal(c, n, s->v[0], s->v[1], s->v[2]);
    for (k = 0; k < 3; k++) {
        tbx_num_of(c, &x[k], &s->ray.dir[k]);
    }
    tbx_num_dot(c, &t->d, n, x);
    tbx_num_difference3(c, x, s->v[0], s->ray.origin);
    tbx_num_dot(c, &t->n, n, x);
    sign = tbx_num_sign(c, &t->d);
    tbx_fraction_orient(c, t, sign);
    if (c->exact) {
        tbx_num both[2];
        both[0] = t->d;
        both[1] = t->n;
        tbx_num_keep(c, mark, both, 2);
        t->d = both[0];
        t->n = both[1];
    }
    return sign;
}

/* On which sides of the triangle's edges does the line pass? det_i is six times the volume of the tetrahedron
 * dir, v_i - o, v_i+1 - o. Returns 1 if two differ in sign: then the line misses T, also if it lies in T's
 * plane (then all are 0) or T is a segment (then a line that meets it makes all 0). */
TBX_FN int tbx_shot_passes(tbx_calc *c, const tbx_shot *s)
{
    const int mark = c->used;
    tbx_num a[3][3];
    tbx_num d[3];
    int above = 0;
    int below = 0;
    int i;
    for (i = 0; i < 3; i++) {
        tbx_num_difference3(c, a[i], s->v[i], s->ray.origin);
        tbx_num_of(c, &d[i], &s->ray.dir[i]);
    }
    for (i = 0; i < 3; i++) {
        const int here = c->used;
        tbx_num n[3];
        tbx_num det;
        int sign;
        tbx_num_cross(c, n, a[i], a[(i + 1) % 3]);
        tbx_num_dot(c, &det, d, n);
        sign = tbx_num_sign(c, &det);
        above += sign > 0;
        below += sign < 0;
        c->used = here;
    }
    c->used = mark;
    return above > 0 && below > 0;
}

/* The same in plain double, for floats of the usual size: is a miss certain? A term of det_i, with its
 * share of the sums, errs by 7 u. */
#define TBX_SHOT_ERROR (9.0 * TBX_U64)

TBX_FN double tbx_shot_det(const double d[3], const double a[3], const double b[3], double *out_error)
{
    const double yz = d[0] * (a[1] * b[2]);
    const double zy = d[0] * (a[2] * b[1]);
    const double zx = d[1] * (a[2] * b[0]);
    const double xz = d[1] * (a[0] * b[2]);
    const double xy = d[2] * (a[0] * b[1]);
    const double yx = d[2] * (a[1] * b[0]);
    *out_error =
        (tbx_abs(yz) + tbx_abs(zy) + tbx_abs(zx) + tbx_abs(xz) + tbx_abs(xy) + tbx_abs(yx)) * TBX_SHOT_ERROR;
    return (yz - zy) + (zx - xz) + (xy - yx);
}

TBX_FN int tbx_shot_misses(const float origin[3], const float dir[3], const float *const v[3])
{
    double x[4][3];
    double d[3];
    int above = 0;
    int below = 0;
    int i;
    if (!TBX_DOUBLE_IS_53_BITS || tbx_odd4(origin, dir, v[0], v[1]) || tbx_odd4(v[2], v[2], v[2], v[2])) {
        return 0;
    }
    tbx_take3_float(x[3], origin);
    tbx_take3_float(d, dir);
    for (i = 0; i < 3; i++) {
        tbx_take3_float(x[i], v[i]);
        tbx_minus3(x[i], x[i], x[3]);
    }
    for (i = 0; i < 3; i++) {
        double error;
        const double det = tbx_shot_det(d, x[i], x[i == 2 ? 0 : i + 1], &error);
        above |= det > error;
        below |= det < -error;
    }
    return above & below;
}

/* The usual case: the line crosses the plane of T at one point. UNSURE: it does not, or nobody knows in
 * double. */
TBX_FN int tbx_shot_run(tbx_calc *c, const tbx_shot *s, tbx_fraction *t)
{
    tbx_fraction end;
    int e;
    if (tbx_shot_passes(c, s)) {
        c->unsure = 0; /* of those two signs we are sure */
        return TBX_MISS;
    }
    if (tbx_shot_time(c, s, t) == 0 || c->unsure) {
        return TBX_UNSURE;
    }
    for (e = 0; e < 2; e++) {
        const int mark = c->used;
        tbx_fraction_of(c, &end, &s->ray.t[e]);
        if (tbx_fraction_compare(c, t, &end) * (e == 0 ? 1 : -1) < 0) {
            return TBX_MISS;
        }
        c->used = mark;
    }
    return c->unsure ? TBX_UNSURE : TBX_HIT;
}

/* A line in the plane of T, or a T without a plane, by the 13 axes; m->calc is that of a run in integers. */
TBX_FN int tbx_shot_flat(tbx_motion *m, const tbx_shot *s)
{
    int k;
    for (k = 0; k < 3; k++) {
        m->v[0][k] = s->v[0][k];
        m->v[1][k] = s->v[1][k];
        m->v[2][k] = s->v[2][k];
        m->lo[k] = s->ray.origin[k];
        m->hi[k] = s->ray.origin[k];
        m->velocity[k] = s->ray.dir[k];
    }
    m->axes = TBX_AXES;
    m->open = 0;
    m->t[0] = s->ray.t[0];
    m->t[1] = s->ray.t[1];
    return tbx_motion_run(m);
}

/* Reads the question and answers it. A hit that was found in double is only rounded again. */
TBX_NOINLINE int tbx_shot_answer(const void *origin, const void *dir, const void *t_ends, const void *v0,
                                 const void *v1, const void *v2, int format, void *out_t)
{
    tbx_limb store[TBX_STORE];
    tbx_motion m;
    tbx_shot s;
    tbx_fraction t;
    int64_t key = 0;
    int verdict = TBX_UNSURE;
    const int odd = tbx_ray_read(&s.ray, origin, dir, t_ends, format) | tbx_read3(s.v, v0, v1, v2, format);
    if (!tbx_ray_valid(&s.ray) || !tbx_finite(s.v[0], 9)) {
        return 0;
    }
    tbx_calc_begin(&m.calc, odd, store);
    do {
        if (verdict == TBX_HIT) {
            (void)tbx_shot_time(&m.calc, &s, &t);
        } else {
            verdict = tbx_shot_run(&m.calc, &s, &t);
        }
        if (verdict == TBX_HIT && out_t != NULL) {
            key = tbx_fraction_round(&m.calc, &t, format, TBX_DOWN);
        }
        m.calc.unsure |= verdict == TBX_UNSURE && !m.calc.exact;
    } while (tbx_calc_again(&m.calc));
    if (verdict == TBX_UNSURE) {
        verdict = tbx_shot_flat(&m, &s);
        key = verdict ? tbx_motion_round(&m, 0, format) : 0;
    }
    if (verdict == TBX_HIT) {
        tbx_write(out_t, 0, format, key);
    }
    return verdict;
}

TRIBOX_FN int tribox_ray_triangle(const float origin[3], const float dir[3], float t_min, float t_max,
                                  const float v0[3], const float v1[3], const float v2[3], float *out_t)
{
    const float *const v[3] = { v0, v1, v2 };
    float t[2];
    if (tbx_shot_misses(origin, dir, v)) { /* most rays */
        return 0;
    }
    TBX_COPY(&t[0], &t_min, sizeof t_min);
    TBX_COPY(&t[1], &t_max, sizeof t_max);
    return tbx_shot_answer(origin, dir, t, v0, v1, v2, TBX_FLOAT, out_t);
}

TRIBOX_FN int tribox_ray_triangle_f64(const double origin[3], const double dir[3], double t_min, double t_max,
                                      const double v0[3], const double v1[3], const double v2[3],
                                      double *out_t)
{
    double t[2];
    TBX_COPY(&t[0], &t_min, sizeof t_min);
    TBX_COPY(&t[1], &t_max, sizeof t_max);
    return tbx_shot_answer(origin, dir, t, v0, v1, v2, TBX_DOUBLE, out_t);
}

/* ---- sweep */

/* The number's value, to a few ulp of double. Numbers of degree 2 from floats neither overflow nor vanish. */
TBX_FN double tbx_num_value(const tbx_calc *c, const tbx_num *a)
{
    double value = a->mid;
    if (c->exact) {
        int exponent = 0;
        value = 0.0;
        if (a->sign != 0) {
            exponent = tbx_num_value_exact(c, a, &value);
        }
        value *= tbx_from_bits64((uint64_t)(1023 + exponent) << 52);
        value = a->sign < 0 ? -value : value;
    }
    return value;
}

/* 1/sqrt(x). The first guess is off by less than 4 %; each step squares that, times 1.5: 2^-9, 2^-17, 2^-34,
 * 2^-50. */
TBX_FN double tbx_inverse_root(double x)
{
    double y = tbx_from_bits64(0x5fe6eb50c7b537a9u - (tbx_bits64(&x) >> 1));
    int k;
    for (k = 0; k < 4; k++) {
        y = y * (1.5 - 0.5 * x * y * y);
    }
    return y;
}

/* sqrt(x), x > 0, to 5 u: by the processor where compilers have a name for that, which calls no library. */
TBX_FN double tbx_root(double x)
{
#if TBX_ROOT == 2
    return __builtin_elementwise_sqrt(x);
#elif TBX_ROOT == 1
    typedef double tbx_pair __attribute__((vector_size(16)));
    tbx_pair both = { x, x };
    both = __builtin_ia32_sqrtsd(both);
    return both[0];
#else
    return x * tbx_inverse_root(x);
#endif
}

/* side * x / |x|. Squares of degree 2 neither overflow nor underflow. */
TBX_FN void tbx_unit(const double x[3], int side, float out[3])
{
    const double y = tbx_inverse_root(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    int k;
    for (k = 0; k < 3; k++) {
        out[k] = (float)(side * x[k] * y);
    }
}

/* The axis as a unit vector, times side. In double, unsure unless it is known to 2^-30 of its length, where
 * three components err by 2 rad each. */
#define TBX_UNIT_ERROR 2.3283064365386963e-10 /* 2^-32 */

TBX_FN void tbx_motion_unit(tbx_motion *m, int axis, int side, float out_axis[3])
{
    const int mark = m->calc.used;
    tbx_num l[3];
    double x[3];
    double rad = 0.0;
    double longest = 0.0;
    int k;
    tbx_motion_axis(m, axis, l);
    for (k = 0; k < 3; k++) {
        x[k] = tbx_num_value(&m->calc, &l[k]);
        if (!m->calc.exact) {
            rad += l[k].rad;
            longest = tbx_abs(x[k]) > longest ? tbx_abs(x[k]) : longest;
        }
    }
    m->calc.used = mark;
    m->calc.unsure |= rad > longest * TBX_UNIT_ERROR;
    tbx_unit(x, side, out_axis);
}

/* Only contacts at the start have no axis that opens there. */
TBX_FN void tbx_motion_contact(tbx_motion *m, float out_axis[3])
{
    if (m->opens >= 0) {
        tbx_motion_unit(m, m->opens, m->opens_side, out_axis);
    } else if (m->touches >= 0) {
        tbx_motion_unit(m, m->touches, m->touches_side, out_axis);
    } else {
        out_axis[0] = out_axis[1] = out_axis[2] = 0.0f;
    }
}

/* Everything about the sweep in one of the two runs. */
TBX_FN int tbx_sweep_run(tbx_motion *m, int64_t out_t[2], float out_axis[3])
{
    const int hit = tbx_motion_run(m);
    if (hit && !m->calc.unsure) {
        tbx_motion_contact(m, out_axis);
        out_t[0] = tbx_motion_round(m, 0, TBX_FLOAT);
        out_t[1] = tbx_motion_round(m, 1, TBX_FLOAT);
    }
    return hit;
}

/* The answer by the first so many axes, and what the caller wants of the outputs. */
TBX_NOINLINE int tbx_sweep_answer(tbx_motion *m, int axes, float *out_t0, float *out_t1, float out_axis[3])
{
    const float t[2] = { 0.0f, 1.0f };
    tbx_limb store[TBX_STORE];
    int64_t key[2] = { 0, 0 };
    float axis[3];
    int hit;
    tbx_read(m->t, t, 2, TBX_FLOAT);
    m->axes = axes;
    tbx_calc_begin(&m->calc, 0, store);
    do {
        hit = tbx_sweep_run(m, key, axis);
    } while (tbx_calc_again(&m->calc));
    if (hit) {
        tbx_write(out_t0, 0, TBX_FLOAT, key[0]);
        tbx_write(out_t1, 0, TBX_FLOAT, key[1]);
    }
    if (hit && out_axis != NULL) {
        TBX_COPY(out_axis, axis, sizeof axis);
    }
    return hit;
}

/* Sets up the moving box and the rule; 0 if no point of it counts. Under OPEN all 13 conditions are strict: T
 * meets the interior iff it meets the box with every face moved inward by some e > 0, which takes e times the
 * sum of |l_k| from the gap on axis l. */
TBX_FN int tbx_sweep_box_valid(tbx_motion *m, const float box_min[3], const float box_max[3],
                               const float velocity[3], unsigned flags)
{
    int flat = 0;
    int k;
    m->open = tbx_lo_is_open(flags);
    tbx_read(m->lo, box_min, 3, TBX_FLOAT);
    tbx_read(m->hi, box_max, 3, TBX_FLOAT);
    tbx_read(m->velocity, velocity, 3, TBX_FLOAT);
    for (k = 0; k < 3; k++) {
        flat |= m->lo[k].key == m->hi[k].key;
    }
    return tbx_finite(m->velocity, 3) && tbx_box_valid(m->lo, m->hi) && !(m->open && flat);
}

TRIBOX_FN int tribox_sweep_rule(const float v0[3], const float v1[3], const float v2[3],
                                const float box_min[3], const float box_max[3], const float velocity[3],
                                unsigned flags, float *out_t0, float *out_t1, float out_axis[3])
{
    tbx_motion m;
    tbx_read3(m.v, v0, v1, v2, TBX_FLOAT);
    if (!tbx_finite(m.v[0], 9) || !tbx_sweep_box_valid(&m, box_min, box_max, velocity, flags)) {
        return 0;
    }
    return tbx_sweep_answer(&m, TBX_AXES, out_t0, out_t1, out_axis);
}

TRIBOX_FN int tribox_sweep(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                           const float box_max[3], const float velocity[3], float *out_t0, float *out_t1,
                           float out_axis[3])
{
    return tribox_sweep_rule(v0, v1, v2, box_min, box_max, velocity, 0, out_t0, out_t1, out_axis);
}

/* Along a face's axis, box b is the triangle of its two corners: only their extent counts. */
TRIBOX_FN int tribox_sweep_box(const float a_min[3], const float a_max[3], const float b_min[3],
                               const float b_max[3], const float velocity[3], unsigned flags, float *out_t0,
                               float *out_t1, float out_axis[3])
{
    tbx_motion m;
    tbx_read3(m.v, b_min, b_max, b_max, TBX_FLOAT);
    if (!tbx_box_valid(m.v[0], m.v[1]) || !tbx_sweep_box_valid(&m, a_min, a_max, velocity, flags)) {
        return 0;
    }
    return tbx_sweep_answer(&m, TBX_AXIS_NORMAL, out_t0, out_t1, out_axis);
}

/* ---- gap
 *
 * s is the greatest g/|l| over the 13 axes l and their two directions, g = min over B of l.b - max over T of
 * l.v, which is minus the motion's gap along -l. In double two of them are told apart by their errors; in
 * integers by the signs of g, then by g_a^2 |l_b|^2 against g_b^2 |l_a|^2, of degree 8 (2,250 bits). Axes
 * that tie because they are parallel are passed over: an edge x unit a is along a unit vector where it has
 * one component, and along the normal where the normal has no component a. */
#define TBX_GAP_ALL ((1u << TBX_AXES) - 1u)
#define TBX_GAP_CLOSE 9.094947017729282379150390625e-13 /* 2^-40: s is this near, relative to itself */

typedef struct tbx_gap {
    tbx_num g;
    tbx_num square; /* |l|^2 */
    double s;       /* in double: g/|l|, and a bound of its error */
    double error;
    int axis;
    int side; /* the direction is side * l */
} tbx_gap;

/* In double: g errs by 2 rad, |l|^2 by 2 rad, half of which is the root's relative error; 1/sqrt and the
 * products by 2^-46. */
#define TBX_GAP_MEASURE_ERROR 1.4210854715202004e-14 /* 2^-46 */

TBX_FN void tbx_gap_measure(tbx_calc *c, tbx_gap *a)
{
    double y;
    double root_error;
    if (c->exact) {
        return;
    }
    if (!(a->square.mid * 1e-3 > a->square.rad)) {
        c->unsure = 1;
        a->s = a->error = 0.0;
        return;
    }
    y = tbx_inverse_root(a->square.mid);
    root_error = a->square.rad * y * y * 1.5;
    a->s = a->g.mid * y;
    a->error = 3.0 * a->g.rad * y + (root_error + TBX_GAP_MEASURE_ERROR) * tbx_abs(a->s);
    if (a->g.rad == 0.0 && a->square.rad == 0.0 && a->square.mid == 1.0) {
        a->error = 0.0; /* a face: s = g */
    }
}

/* The sign of a - b in integers. */
TBX_COLD int tbx_gap_compare_exact(tbx_calc *c, const tbx_gap *a, const tbx_gap *b)
{
    const int mark = c->used;
    tbx_num x;
    tbx_num y;
    int order;
    if (a->g.sign != b->g.sign || a->g.sign == 0) {
        return (a->g.sign > b->g.sign) - (a->g.sign < b->g.sign);
    }
    tbx_num_mul(c, &x, &a->g, &a->g);
    tbx_num_mul(c, &x, &x, &b->square);
    tbx_num_mul(c, &y, &b->g, &b->g);
    tbx_num_mul(c, &y, &y, &a->square);
    tbx_num_add(c, &x, &x, &y, -1);
    order = a->g.sign * x.sign;
    c->used = mark;
    return order;
}

TBX_FN int tbx_gap_compare(tbx_calc *c, const tbx_gap *a, const tbx_gap *b)
{
    double error;
    double difference;
    if (c->exact) {
        return tbx_gap_compare_exact(c, a, b);
    }
    error = a->error + b->error;
    difference = a->s - b->s;
    c->unsure |= !(tbx_abs(difference) > error) && error > 0.0;
    return (difference > 0.0) - (difference < 0.0);
}

/* g/|l| in integers, to 2^-51 of itself: the root to 60 bits and the quotient to 58, digit by digit. Every
 * remainder stays below 2^63. The result is below 2^131 and, if not 0, above 2^-706. */
TBX_COLD double tbx_gap_value_exact(const tbx_calc *c, const tbx_gap *a)
{
    uint64_t square;
    uint64_t rest = 0;
    uint64_t root = 0;
    uint64_t g;
    uint64_t quotient = 0;
    int e_square;
    int e_g;
    int i;
    if (a->g.sign == 0) {
        return 0.0;
    }
    square = tbx_num_top(c, &a->square, &e_square);
    if ((e_square & 1) != 0) {
        square >>= 1;
        e_square++;
    }
    for (i = 0; i < 60; i++) { /* root = sqrt(square * 2^56) */
        rest = rest << 2 | square >> 62;
        square <<= 2;
        root <<= 1;
        if (rest > 2 * root) {
            rest -= 2 * root + 1;
            root++;
        }
    }
    g = tbx_num_top(c, &a->g, &e_g);
    rest = g >> 5; /* below 2^59 <= root */
    g <<= 59;
    for (i = 0; i < 60; i++) { /* quotient = g * 2^55 / root */
        rest = rest << 1 | g >> 63;
        g <<= 1;
        quotient <<= 1;
        if (rest >= root) {
            rest -= root;
            quotient++;
        }
    }
    e_g -= 55 + (e_square - 56) / 2;
    while (quotient >> 53 != 0) {
        quotient >>= 1;
        e_g++;
    }
    return a->g.sign *
           tbx_from_bits64(((uint64_t)(1023 + 52 + e_g) << 52) + (quotient - ((uint64_t)1 << 52)));
}

/* Is edge axis `axis` parallel to one before? Where n_a = 0 the three edges x unit a are along n, or, of a
 * segment, along each other: `planes` has those that were asked. */
TBX_FN int tbx_gap_parallel(const tbx_motion *m, int axis, int *planes)
{
    const int a = axis > TBX_AXIS_NORMAL ? (axis - 4) / 3 : 0;
    const int asked = *planes >> a & 1;
    if (axis <= TBX_AXIS_NORMAL || m->n_sign[a] != 0) {
        return 0; /* the normal's signs are not asked for faces alone */
    }
    *planes |= 1 << a;
    return (m->n_sign[0] | m->n_sign[1] | m->n_sign[2] | asked) != 0;
}

/* Takes what was found in the place of the best. Its limbs go to the slots of a motion's ends. */
TBX_FN void tbx_gap_take(tbx_calc *c, tbx_gap *best, const tbx_gap *found)
{
    *best = *found;
    if (c->exact) {
        tbx_num_move(c, &best->g, 0);
        tbx_num_move(c, &best->square, TBX_MOTION_SLOT);
    }
}

/* Both directions of one axis, the one whose first component is positive first. */
TBX_FN void tbx_gap_try(tbx_motion *m, int axis, tbx_gap *best, const tbx_num l[3], const int l_sign[3])
{
    tbx_calc *c = &m->calc;
    int side = l_sign[0] != 0 ? l_sign[0] : l_sign[1] != 0 ? l_sign[1] : l_sign[2];
    tbx_gap next;
    int i;
    tbx_num_dot(c, &next.square, l, l);
    next.axis = axis;
    for (i = 0; i < 2; i++, side = -side) {
        if (tbx_motion_gap(m, axis, -side, l, l_sign, &next.g)) {
            tbx_num_flip(c, &next.g, -1);
            next.side = side;
            tbx_gap_measure(c, &next);
            if (best->axis < 0 || tbx_gap_compare(c, &next, best) > 0) {
                tbx_gap_take(c, best, &next);
            }
        }
    }
}

/* The sign of n_a for the edge axis l that is asked alone: the third corner lies at -n_a from corner i. */
TBX_FN void tbx_gap_alone(tbx_motion *m, int axis, const tbx_num l[3])
{
    if (axis > TBX_AXIS_NORMAL) {
        const int i = (axis - 4) % 3;
        tbx_num d[3];
        tbx_num_difference3(&m->calc, d, m->v[(i + 2) % 3], m->v[i]);
        tbx_num_dot(&m->calc, &d[0], l, d);
        m->n_sign[(axis - 4) / 3] = -tbx_num_sign(&m->calc, &d[0]);
    }
}

/* Of these axes the first that attains the greatest s, in one run. Some face is finite. */
TBX_FN double tbx_gap_run(tbx_motion *m, unsigned axes, float out_axis[3])
{
    tbx_calc *c = &m->calc;
    const int mark = c->exact ? 2 * TBX_MOTION_SLOT : 0;
    tbx_gap best;
    tbx_num l[3];
    int l_sign[3];
    int planes = 0;
    int axis;
    c->unsure = 0;
    best.axis = -1;
    if (axes >> (TBX_AXIS_NORMAL + 1) != 0 && (axes & (axes - 1u)) != 0) {
        axes |= 1u << TBX_AXIS_NORMAL; /* its signs say where corners lie, and what is parallel */
    }
    for (axis = 0; axis < TBX_AXES && !c->unsure; axis++) {
        c->used = mark;
        if ((axes >> axis & 1u) == 0 || !tbx_motion_signs(m, axis, l, l_sign)) {
            continue;
        }
        if (axes == 1u << axis) {
            tbx_gap_alone(m, axis, l);
        } else if (tbx_gap_parallel(m, axis, &planes)) {
            continue;
        }
        tbx_gap_try(m, axis, &best, l, l_sign);
    }
    if (c->unsure) {
        return 0.0;
    }
    c->used = mark;
    tbx_motion_unit(m, best.axis, best.side, out_axis);
    if (c->exact) {
        return tbx_gap_value_exact(c, &best);
    }
    c->unsure |= !(best.error <= TBX_GAP_CLOSE * tbx_abs(best.s));
    return best.s;
}

/* Whatever the floats are, by these axes. The result may be infinite, so it goes by its bits. */
TBX_NOINLINE void tbx_gap_answer(const float *const v[3], const float box_min[3], const float box_max[3],
                                 unsigned axes, double *out_s, float out_axis[3])
{
    tbx_limb store[TBX_STORE];
    tbx_motion m;
    uint64_t bits = (uint64_t)TBX_KEY_INFINITY;
    float axis[3];
    int bounded = 0;
    int k;
    tbx_read3(m.v, v[0], v[1], v[2], TBX_FLOAT);
    tbx_read(m.lo, box_min, 3, TBX_FLOAT);
    tbx_read(m.hi, box_max, 3, TBX_FLOAT);
    if (!tbx_finite(m.v[0], 9) || !tbx_box_valid(m.lo, m.hi)) {
        TBX_COPY(out_s, &bits, sizeof bits);
        return;
    }
    for (k = 0; k < 3; k++) {
        bounded |= tbx_key_is_finite(m.lo[k].key) | tbx_key_is_finite(m.hi[k].key);
    }
    if (!bounded) {
        bits |= (uint64_t)1 << 63;
        TBX_COPY(out_s, &bits, sizeof bits);
        return;
    }
    /* one axis alone has been asked in double */
    tbx_calc_begin(&m.calc, !TBX_DOUBLE_IS_53_BITS || (axes & (axes - 1u)) == 0, store);
    do {
        *out_s = tbx_gap_run(&m, axes, axis);
    } while (tbx_calc_again(&m.calc));
    if (out_axis != NULL) {
        TBX_COPY(out_axis, axis, sizeof axis);
    }
}

TRIBOX_FN double tribox_gap(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                            const float box_max[3], float out_axis[3])
{
    const float *const v[5] = { v0, v1, v2, v0, v1 };
    double s = 0.0;
    const unsigned axes = TBX_EITHER(tbx_gap_quick(v, box_min, box_max, &s, out_axis), TBX_GAP_ALL);
    if (TBX_RARELY(axes != 0)) {
        tbx_gap_answer(v, box_min, box_max, axes, &s, out_axis);
        TBX_KEEP(s); /* it may be infinite */
    }
    return s;
}

/* ---- closest point
 *
 * The point x of T nearest to q is the one with (q - x).(v - x) <= 0 for every corner v. With D_ij = (q -
 * v_i).(v_j - v_i): corner i is nearest iff D_ij <= 0 for both j. The foot of q on edge ij is strictly
 * inside the edge iff D_ij > 0 and D_ji > 0, and divides it as D_ij : D_ji; it is nearest iff the third
 * corner is not on q's side of the edge, that is, iff the third weight W_k of q's foot in the plane is <=
 * 0; W_k = n.((v_i - q) x (v_j - q)), 0 if T is a segment. Otherwise the foot in the plane is in T. */
typedef struct tbx_nearest {
    tbx_real v[3][3];
    tbx_real q[3];
} tbx_nearest;

/* Differences that all are made of: from corner i to q, and edge i, from corner i to i + 1. */
typedef struct tbx_nearest_work {
    tbx_num to_q[3][3];
    tbx_num edge[3][3];
    tbx_num n[3]; /* normal */
} tbx_nearest_work;

/* D_ij; edge j leads to corner i, against its direction, where i is not before j. */
TBX_FN void tbx_nearest_dot(tbx_calc *c, const tbx_nearest_work *w, int i, int j, tbx_num *r)
{
    const int ahead = j == (i + 1) % 3;
    tbx_num_dot(c, r, w->to_q[i], w->edge[ahead ? i : j]);
    tbx_num_flip(c, r, ahead ? 1 : -1);
}

/* W_k: (v_i - q) x (v_j - q) is that of the differences to q, too */
TBX_FN void tbx_nearest_face(tbx_calc *c, const tbx_nearest_work *w, int k, tbx_num *r)
{
    const int mark = c->used;
    tbx_num x[3];
    tbx_num_cross(c, x, w->to_q[(k + 1) % 3], w->to_q[(k + 2) % 3]);
    tbx_num_dot(c, r, w->n, x);
    tbx_num_keep(c, mark, r, 1);
}

/* Which corner (its number), edge (3 + the corner across it) or face (6) is nearest? Leaves the work. */
TBX_FN int tbx_nearest_feature(tbx_calc *c, const tbx_nearest *p, tbx_nearest_work *w)
{
    int along[3][3];
    int i;
    int j;
    int k;
    for (k = 0; k < 3; k++) {
        tbx_num_difference3(c, w->to_q[k], p->q, p->v[k]);
        tbx_num_difference3(c, w->edge[k], p->v[(k + 1) % 3], p->v[k]);
    }
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            const int mark = c->used;
            tbx_num dot;
            along[i][j] = 0;
            if (j != i) {
                tbx_nearest_dot(c, w, i, j, &dot);
                along[i][j] = tbx_num_sign(c, &dot);
            }
            c->used = mark;
        }
    }
    for (i = 0; i < 3; i++) {
        if (along[i][(i + 1) % 3] <= 0 && along[i][(i + 2) % 3] <= 0) {
            return i;
        }
    }
    tbx_num_cross(c, w->n, w->edge[0], w->edge[1]);
    for (k = 2; k >= 0; k--) { /* edges 01, 02, 12 */
        const int mark = c->used;
        tbx_num face;
        i = (k + 1) % 3;
        j = (k + 2) % 3;
        tbx_nearest_face(c, w, k, &face);
        c->used = mark;
        if (tbx_num_sign(c, &face) <= 0 && along[i][j] > 0 && along[j][i] > 0) {
            return 3 + k;
        }
    }
    return 6;
}

/* The weights as keys of the format, which has them 0 to begin with; `one` is the key of 1. */
TBX_FN void tbx_nearest_run(tbx_calc *c, const tbx_nearest *p, int format, int64_t one, int64_t weights[3])
{
    tbx_nearest_work work;
    tbx_fraction w;
    const int feature = tbx_nearest_feature(c, p, &work);
    int k;
    if (c->unsure) {
        return;
    }
    if (feature < 3) {
        weights[feature] = one;
    } else if (feature < 6) {
        const int i = (feature + 1) % 3;
        const int j = (feature + 2) % 3;
        tbx_num other;
        tbx_nearest_dot(c, &work, i, j, &other);
        tbx_nearest_dot(c, &work, j, i, &w.n);
        tbx_num_add(c, &w.d, &w.n, &other, 1);
        weights[i] = tbx_fraction_round(c, &w, format, TBX_NEAREST);
        w.n = other;
        weights[j] = tbx_fraction_round(c, &w, format, TBX_NEAREST);
    } else {
        tbx_num_dot(c, &w.d, work.n, work.n);
        for (k = 0; k < 3; k++) {
            const int mark = c->used;
            tbx_nearest_face(c, &work, k, &w.n);
            weights[k] = tbx_fraction_round(c, &w, format, TBX_NEAREST);
            c->used = mark;
        }
    }
}

/* Reads the question and answers it. */
TBX_NOINLINE void tbx_nearest_answer(const void *const v[3], const void *q, int format, void *out_weights)
{
    const int64_t one = format == TBX_FLOAT ? (int64_t)127 << 23 : (int64_t)1023 << 52;
    tbx_limb store[TBX_STORE];
    tbx_calc c;
    tbx_nearest p;
    int64_t weights[3];
    int k;
    const int odd = tbx_read3(p.v, v[0], v[1], v[2], format) | tbx_read(p.q, q, 3, format);
    tbx_calc_begin(&c, odd, store);
    do {
        weights[0] = weights[1] = weights[2] = 0;
        if (!tbx_finite(p.v[0], 9) || !tbx_finite(p.q, 3)) {
            weights[0] = one;
        } else {
            tbx_nearest_run(&c, &p, format, one, weights);
        }
    } while (tbx_calc_again(&c));
    for (k = 0; k < 3; k++) {
        tbx_write(out_weights, k, format, weights[k]);
    }
}

TRIBOX_FN void tribox_closest(const float v0[3], const float v1[3], const float v2[3], const float q[3],
                              float out_weights[3])
{
    const void *const v[3] = { v0, v1, v2 };
    tbx_nearest_answer(v, q, TBX_FLOAT, out_weights);
}

TRIBOX_FN void tribox_closest_f64(const double v0[3], const double v1[3], const double v2[3],
                                  const double q[3], double out_weights[3])
{
    const void *const v[3] = { v0, v1, v2 };
    tbx_nearest_answer(v, q, TBX_DOUBLE, out_weights);
}

/* ---- clip
 *
 * The lines that bound T n B within T's plane are numbered: 0..2 the edges of T, 3 + 2a and 4 + 2a the
 * lower and upper face across axis a. A vertex is a corner of T (b = -1) or where two lines a and b meet,
 * so it is known exactly and its coordinates keep a low degree, however often the polygon is cut. Cut by
 * exact signs, a strictly convex polygon stays one, so its vertices are extreme points of T n B, and
 * distinct. One point, or two joined by line[0], are a polygon too: of a degenerate T, or of a T that
 * touches the box. */
typedef struct tbx_vertex {
    int a;
    int b;
} tbx_vertex;

typedef struct tbx_polygon {
    int count;
    int first; /* the least vertex */
    tbx_vertex vertex[9];
    int line[9]; /* from this vertex to the next */
} tbx_polygon;

typedef struct tbx_cut {
    tbx_calc calc;
    tbx_real v[3][3];
    tbx_real face[2][3]; /* of the box: lower, upper */
    tbx_num n[3];        /* normal of T */
} tbx_cut;

TBX_FN int tbx_line_axis(int line)
{
    return (line - 3) / 2;
}

TBX_FN const tbx_real *tbx_line_face(const tbx_cut *t, int line)
{
    return &t->face[(line - 3) % 2][tbx_line_axis(line)];
}

/* r += n_axis * (v0_axis - face), of a line that is a face */
TBX_FN void tbx_cut_add_face(tbx_cut *t, tbx_num *r, int line)
{
    const int axis = tbx_line_axis(line);
    tbx_num x;
    tbx_num_difference(&t->calc, &x, &t->v[0][axis], tbx_line_face(t, line));
    tbx_num_mul(&t->calc, &x, &x, &t->n[axis]);
    tbx_num_add(&t->calc, r, r, &x, 1);
}

/* Coordinate k of a vertex, if that is a number that came in; else NULL. */
TBX_FN const tbx_real *tbx_cut_given(const tbx_cut *t, tbx_vertex x, int k)
{
    if (x.b < 0) {
        return &t->v[x.a][k];
    }
    if (tbx_line_axis(x.b) == k) {
        return tbx_line_face(t, x.b);
    }
    return x.a >= 3 && tbx_line_axis(x.a) == k ? tbx_line_face(t, x.a) : NULL;
}

/* Coordinate k of a vertex. Edge pq and face f across axis a: (p_k (q_a - f) + q_k (f - p_a)) / (q_a -
 * p_a). Two faces: from n.(x - v0) = 0, with the faces' two coordinates put in. */
TBX_FN void tbx_cut_coordinate(tbx_cut *t, tbx_vertex x, int k, tbx_fraction *r)
{
    tbx_calc *c = &t->calc;
    const tbx_real *given = tbx_cut_given(t, x, k);
    tbx_num y;
    tbx_num z;
    int mark = c->used;
    if (given != NULL) {
        tbx_fraction_of(c, r, given);
        return;
    }
    if (x.a < 3) {
        const int a = tbx_line_axis(x.b);
        const tbx_real *f = tbx_line_face(t, x.b);
        const tbx_real *p = t->v[x.a];
        const tbx_real *q = t->v[(x.a + 1) % 3];
        tbx_num_difference(c, &r->d, &q[a], &p[a]);
        mark = c->used;
        tbx_num_difference(c, &y, &q[a], f);
        tbx_num_of(c, &z, &p[k]);
        tbx_num_mul(c, &r->n, &y, &z);
        tbx_num_difference(c, &y, f, &p[a]);
        tbx_num_of(c, &z, &q[k]);
        tbx_num_mul(c, &y, &y, &z);
        tbx_num_add(c, &r->n, &r->n, &y, 1);
    } else {
        r->d = t->n[k];
        tbx_num_of(c, &z, &t->v[0][k]);
        tbx_num_mul(c, &r->n, &z, &t->n[k]);
        tbx_cut_add_face(t, &r->n, x.a);
        tbx_cut_add_face(t, &r->n, x.b);
    }
    tbx_num_keep(c, mark, &r->n, 1);
    tbx_fraction_orient(c, r, tbx_num_sign(c, &r->d));
}

/* The sign of the vertex's distance to the face, positive inside the box. */
TBX_FN int tbx_cut_side(tbx_cut *t, tbx_vertex x, int line)
{
    const int inward = (line - 3) % 2 == 0 ? 1 : -1;
    const tbx_real *given = tbx_cut_given(t, x, tbx_line_axis(line));
    const tbx_real *f = tbx_line_face(t, line);
    const int mark = t->calc.used;
    tbx_fraction at;
    tbx_fraction face;
    int order;
    if (given != NULL) {
        return inward * tbx_key_order(given->key, f->key);
    }
    tbx_cut_coordinate(t, x, tbx_line_axis(line), &at);
    tbx_fraction_of(&t->calc, &face, f);
    order = tbx_fraction_compare(&t->calc, &at, &face);
    t->calc.used = mark;
    return order * inward;
}

TBX_FN void tbx_polygon_add(tbx_polygon *p, int a, int b, int line)
{
    p->vertex[p->count].a = a;
    p->vertex[p->count].b = b;
    p->line[p->count] = line;
    p->count++;
}

/* Cuts the polygon by one face. New vertices lie strictly inside an edge, never at a vertex. */
TBX_FN void tbx_cut_by(tbx_cut *t, tbx_polygon *p, int line)
{
    const tbx_polygon old = *p;
    int side[9];
    int i;
    for (i = 0; i < old.count; i++) {
        side[i] = tbx_cut_side(t, old.vertex[i], line);
    }
    if (t->calc.unsure) {
        return;
    }
    p->count = 0;
    for (i = 0; i < old.count; i++) {
        const int last_of_chain = old.count <= 2 && i == old.count - 1;
        const int next = last_of_chain ? side[i] : side[(i + 1) % old.count];
        if (side[i] >= 0) {
            tbx_polygon_add(p, old.vertex[i].a, old.vertex[i].b,
                            side[i] == 0 && next < 0 ? line : old.line[i]);
        }
        if (side[i] * next < 0) {
            tbx_polygon_add(p, old.line[i], line, next < 0 ? line : old.line[i]);
        }
    }
}

/* The sign of x - y, by the first coordinate that differs. */
TBX_FN int tbx_cut_compare(tbx_cut *t, tbx_vertex x, tbx_vertex y)
{
    int order = 0;
    int k;
    for (k = 0; k < 3 && order == 0; k++) {
        const tbx_real *x_given = tbx_cut_given(t, x, k);
        const tbx_real *y_given = tbx_cut_given(t, y, k);
        if (x_given != NULL && y_given != NULL) {
            order = tbx_key_order(x_given->key, y_given->key);
        } else {
            const int mark = t->calc.used;
            tbx_fraction x_k;
            tbx_fraction y_k;
            tbx_cut_coordinate(t, x, k, &x_k);
            tbx_cut_coordinate(t, y, k, &y_k);
            order = tbx_fraction_compare(&t->calc, &x_k, &y_k);
            t->calc.used = mark;
        }
    }
    return order;
}

/* T itself: its corners; or, if it is a segment or a point, the ends. */
TBX_FN void tbx_cut_start(tbx_cut *t, tbx_polygon *p)
{
    tbx_vertex corner = { 0, -1 };
    int flat = 1;
    int least = 0;
    int most = 0;
    int i;
    p->count = 0;
    p->first = 0;
    for (i = 0; i < 3; i++) {
        flat &= tbx_num_sign(&t->calc, &t->n[i]) == 0;
    }
    for (i = 0; i < 3 && !flat; i++) {
        tbx_polygon_add(p, i, -1, i);
    }
    for (i = 1; i < 3 && flat; i++) {
        tbx_vertex end = { 0, -1 };
        corner.a = i;
        end.a = least;
        least = tbx_cut_compare(t, corner, end) < 0 ? i : least;
        end.a = most;
        most = tbx_cut_compare(t, corner, end) > 0 ? i : most;
    }
    if (flat) {
        tbx_polygon_add(p, least, -1, (least + 1) % 3 == most ? least : most);
    }
    if (least != most) {
        tbx_polygon_add(p, most, -1, p->line[0]);
    }
}

/* The polygon, in one of the two runs. */
TBX_FN void tbx_cut_run(tbx_cut *t, tbx_polygon *p)
{
    int line;
    int i;
    tbx_num_normal(&t->calc, t->n, t->v[0], t->v[1], t->v[2]);
    tbx_cut_start(t, p);
    for (line = 3; line < 9 && !t->calc.unsure; line++) {
        if (tbx_key_is_finite(tbx_line_face(t, line)->key)) {
            tbx_cut_by(t, p, line);
        }
    }
    for (i = 1; i < p->count && !t->calc.unsure; i++) {
        p->first = tbx_cut_compare(t, p->vertex[i], p->vertex[p->first]) < 0 ? i : p->first;
    }
}

/* Its corners as keys of the format, in one of the two runs. */
TBX_FN int tbx_cut_round(tbx_cut *t, const tbx_polygon *p, int format, int64_t out[9][3])
{
    int count = 0;
    int i;
    for (i = 0; i < p->count && !t->calc.unsure; i++) {
        const tbx_vertex at = p->vertex[(p->first + i) % p->count];
        int same = 0;
        int j;
        int k;
        for (k = 0; k < 3; k++) {
            const tbx_real *given = tbx_cut_given(t, at, k);
            if (given != NULL) {
                out[count][k] = tbx_format_key(given->key, format);
            } else {
                const int mark = t->calc.used;
                tbx_fraction x;
                tbx_cut_coordinate(t, at, k, &x);
                out[count][k] = tbx_fraction_round(&t->calc, &x, format, TBX_NEAREST);
                t->calc.used = mark;
            }
        }
        for (j = 0; j < count; j++) {
            same |= out[j][0] == out[count][0] && out[j][1] == out[count][1] && out[j][2] == out[count][2];
        }
        count += !same;
    }
    return count;
}

/* Reads the question and answers it. The corners of a polygon that was found in double are only rounded
 * again. */
TBX_NOINLINE int tbx_cut_answer(const void *const v[3], const void *const box[2], int format,
                                void *out_polygon)
{
    tbx_limb store[TBX_STORE];
    tbx_cut t;
    tbx_polygon p;
    int64_t corner[9][3];
    int found = 0;
    int count;
    int i;
    const int odd = tbx_read3(t.v, v[0], v[1], v[2], format) | tbx_read(t.face[0], box[0], 3, format) |
                    tbx_read(t.face[1], box[1], 3, format);
    if (!tbx_finite(t.v[0], 9) || !tbx_box_valid(t.face[0], t.face[1])) {
        return 0;
    }
    tbx_calc_begin(&t.calc, odd, store);
    do {
        if (found) {
            tbx_num_normal(&t.calc, t.n, t.v[0], t.v[1], t.v[2]);
        } else {
            tbx_cut_run(&t, &p);
            found = !t.calc.unsure;
        }
        count = tbx_cut_round(&t, &p, format, corner);
    } while (tbx_calc_again(&t.calc));
    for (i = 0; i < 3 * count; i++) {
        tbx_write(out_polygon, i, format, corner[i / 3][i % 3]);
    }
    return count;
}

TRIBOX_FN int tribox_clip(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                          const float box_max[3], float out_polygon[9][3])
{
    const void *const v[3] = { v0, v1, v2 };
    const void *const box[2] = { box_min, box_max };
    return tbx_cut_answer(v, box, TBX_FLOAT, out_polygon);
}

TRIBOX_FN int tribox_clip_f64(const double v0[3], const double v1[3], const double v2[3],
                              const double box_min[3], const double box_max[3], double out_polygon[9][3])
{
    const void *const v[3] = { v0, v1, v2 };
    const void *const box[2] = { box_min, box_max };
    return tbx_cut_answer(v, box, TBX_DOUBLE, out_polygon);
}

/* ---- meshes */

/* A mesh, and what is asked of it. */
typedef struct tbx_query {
    tbx_source mesh;
    const void *box_min;
    const void *box_max;
    uint32_t *out_triangles;
    size_t capacity;
} tbx_query;

/* A face of the box: a number x lies beyond it iff the integer of its bits, xor `flip`, is less than `at`.
 * Positive numbers order as the integers of their bits, above all negative ones, which order the other way
 * round: where the face is negative, or a lower face at 0, the magnitudes are flipped; for an upper face all
 * bits are, which turns the order round. Both zeros lie on a face at 0. */
typedef struct tbx_query_face {
    size_t offset; /* of the coordinate */
    int64_t flip;
    int64_t at;
} tbx_query_face;

TBX_FORCED int64_t tbx_query_bits(const char *x, int format)
{
    if (format == TBX_FLOAT) {
        int32_t bits;
        TBX_COPY(&bits, x, sizeof bits);
        return bits;
    } else {
        int64_t bits;
        TBX_COPY(&bits, x, sizeof bits);
        return bits;
    }
}

TBX_FORCED void tbx_query_set_face(tbx_query_face *face, const void *box, int axis, int is_upper,
                                       int format)
{
    const int64_t magnitudes = format == TBX_FLOAT ? 0x7fffffff : (int64_t)0x7fffffffffffffffu;
    int64_t bits;
    face->offset = (size_t)axis * (format == TBX_FLOAT ? sizeof(float) : sizeof(double));
    bits = tbx_query_bits((const char *)box + face->offset, format);
    if ((bits & magnitudes) == 0) {
        bits = is_upper ? 0 : -magnitudes - 1;
    }
    face->flip = (bits < 0 ? magnitudes : 0) ^ (is_upper ? -1 : 0);
    face->at = bits ^ face->flip;
}

/* Do all three corners lie beyond the face? NaN and infinite corners may: they touch nothing. In floats
 * one after the other, which is 1.3 x faster, since neighbours are alike. */
TBX_FORCED int tbx_beyond(const char *const corner[3], const tbx_query_face *face, int format)
{
    if (format == TBX_FLOAT) {
        const int32_t flip = (int32_t)face->flip;
        const int32_t at = (int32_t)face->at;
        const char *const a = corner[0] + face->offset;
        const char *const b = corner[1] + face->offset;
        const char *const c = corner[2] + face->offset;
        return ((int32_t)tbx_query_bits(a, format) ^ flip) < at &&
               ((int32_t)tbx_query_bits(b, format) ^ flip) < at &&
               ((int32_t)tbx_query_bits(c, format) ^ flip) < at;
    } else {
        const int64_t a = tbx_query_bits(corner[0] + face->offset, format) ^ face->flip;
        const int64_t b = tbx_query_bits(corner[1] + face->offset, format) ^ face->flip;
        const int64_t c = tbx_query_bits(corner[2] + face->offset, format) ^ face->flip;
        return (a < face->at) & (b < face->at) & (c < face->at);
    }
}

/* Out of line, so that the loop below keeps its constants in registers. */
TBX_NOINLINE int tbx_query_touches(const char *v0, const char *v1, const char *v2, const tbx_query *q,
                                   int format)
{
    if (format == TBX_FLOAT) {
        float x[5][3];
        TBX_COPY(x[0], v0, sizeof x[0]);
        TBX_COPY(x[1], v1, sizeof x[1]);
        TBX_COPY(x[2], v2, sizeof x[2]);
        TBX_COPY(x[3], q->box_min, sizeof x[3]);
        TBX_COPY(x[4], q->box_max, sizeof x[4]);
        return tribox_overlap(x[0], x[1], x[2], x[3], x[4]);
    } else {
        double x[5][3];
        TBX_COPY(x[0], v0, sizeof x[0]);
        TBX_COPY(x[1], v1, sizeof x[1]);
        TBX_COPY(x[2], v2, sizeof x[2]);
        TBX_COPY(x[3], q->box_min, sizeof x[3]);
        TBX_COPY(x[4], q->box_max, sizeof x[4]);
        return tribox_overlap_f64(x[0], x[1], x[2], x[3], x[4]);
    }
}

/* Neighbours in a mesh lie beyond the same face: the one that served last is asked first. */
TBX_FORCED size_t tbx_query_run(const tbx_query *q, const uint32_t *index, size_t stride, int format)
{
    const char *positions = q->mesh.positions;
    const size_t triangles = q->mesh.triangles;
    tbx_query_face faces[6];
    tbx_query_face last;
    size_t count = 0;
    size_t i;
    int f;
    for (f = 0; f < 6; f++) {
        tbx_query_set_face(&faces[f], f % 2 == 0 ? q->box_min : q->box_max, f / 2, f % 2, format);
    }
    last = faces[0];
    for (i = 0; i < triangles; i++) {
        const size_t at = 3 * i;
        const char *corner[3];
        corner[0] = positions + (index != NULL ? index[at] : at) * stride;
        corner[1] = positions + (index != NULL ? index[at + 1] : at + 1) * stride;
        corner[2] = positions + (index != NULL ? index[at + 2] : at + 2) * stride;
        if (tbx_beyond(corner, &last, format)) {
            continue;
        }
        for (f = 0; f < 6 && !tbx_beyond(corner, &faces[f], format); f++) {
        }
        if (f < 6) {
            last = faces[f];
        } else if (tbx_query_touches(corner[0], corner[1], corner[2], q, format)) {
            if (count < q->capacity) {
                q->out_triangles[count] = (uint32_t)i;
            }
            count++;
        }
    }
    return count;
}

/* Packed vertices with indices, the usual mesh, need no multiplication by the stride. */
TBX_NOINLINE size_t tbx_query_float(const tbx_query *q)
{
    const size_t packed = 3 * sizeof(float);
    if (q->mesh.indices != NULL && q->mesh.stride == packed) {
        return tbx_query_run(q, q->mesh.indices, packed, TBX_FLOAT);
    }
    return tbx_query_run(q, q->mesh.indices, q->mesh.stride, TBX_FLOAT);
}

TRIBOX_FN size_t tribox_mesh_query(const tribox_mesh *mesh, const float box_min[3], const float box_max[3],
                                   uint32_t *out_triangles, size_t capacity)
{
    tbx_query q;
    q.mesh = tbx_source_float(mesh);
    q.box_min = box_min;
    q.box_max = box_max;
    q.out_triangles = out_triangles;
    q.capacity = capacity;
    return tbx_query_float(&q);
}

TRIBOX_FN size_t tribox_mesh_query_f64(const tribox_mesh_f64 *mesh, const double box_min[3],
                                       const double box_max[3], uint32_t *out_triangles, size_t capacity)
{
    tbx_query q;
    q.mesh = tbx_source_double(mesh);
    q.box_min = box_min;
    q.box_max = box_max;
    q.out_triangles = out_triangles;
    q.capacity = capacity;
    return tbx_query_run(&q, q.mesh.indices, q.mesh.stride, TBX_DOUBLE);
}

/* ---- segment through a grid
 *
 * On each axis the segment crosses planes one after the other, plane i at t_i = (origin + i*size - p) / (q -
 * p). What happens at one t is an event: on the axes that cross a plane there, the voxel before it and the
 * one after are touched, on the others one voxel (two, where the segment runs along a plane). The voxels of
 * an event are entered at the same point; most events cross one plane, and enter one voxel. The times are
 * known in double to within an error; integers tell those apart that are closer.
 *
 * The walk begins where the region does, at its last entry, and counts the planes that are left within region
 * and segment, so no end depends on a comparison of floating-point numbers. */

typedef struct tbx_segment {
    const tribox_grid *grid;
    tribox_voxel_fn on_voxel;
    void *user;
    size_t count;
    int stopped;
    int lo_is_open; /* the touching rule */
    int hi_is_open;
    double p[3];
    double q[3];
    int way[3];       /* 1, -1, or 0: q = p on this axis */
    int two[3];       /* closed, and the segment runs along the plane above the voxel */
    int64_t voxel[3]; /* where the segment is */
    int64_t left[3];  /* how many planes it crosses from there */
    double from[3];   /* t of the plane behind a voxel is from + voxel*step, to within error*(1 + |t|) */
    double step[3];
    double error;
    double t[3]; /* of the next plane, if any are left */
} tbx_segment;

#define TBX_SEGMENT_ERROR (32.0 * TBX_U64)

/* The plane behind the segment's voxel on axis k. */
TBX_FN int64_t tbx_segment_plane(const tbx_segment *s, int k)
{
    return s->voxel[k] + (s->way[k] > 0);
}

/* r = plane i of axis k - p */
TBX_FN void tbx_segment_offset(tbx_calc *c, const tbx_segment *s, int k, int64_t i, tbx_num *r)
{
    tbx_real x[3];
    tbx_num y;
    tbx_num z;
    tbx_read1(&x[0], &s->grid->origin[k], TBX_DOUBLE);
    tbx_read1(&x[1], &s->grid->size[k], TBX_DOUBLE);
    tbx_read1(&x[2], &s->p[k], TBX_DOUBLE);
    tbx_num_difference(c, r, &x[0], &x[2]);
    tbx_num_of(c, &y, &x[1]);
    tbx_num_integer(c, &z, i, 0);
    tbx_num_mul(c, &y, &y, &z);
    tbx_num_add(c, r, r, &y, 1);
}

/* The sign of t_i of axis k less t_j of axis l, both not 0: of (plane_i - p_k)(q_l - p_l) - (plane_j -
 * p_l)(q_k - p_k), times the signs of the divisors. */
TBX_COLD int tbx_segment_order_exact(const tbx_segment *s, int k, int64_t i, int l, int64_t j)
{
    tbx_limb store[TBX_STORE];
    tbx_calc c;
    tbx_real x[4];
    tbx_num a;
    tbx_num b;
    tbx_num d;
    tbx_calc_begin(&c, 1, store);
    tbx_read1(&x[0], &s->q[l], TBX_DOUBLE);
    tbx_read1(&x[1], &s->p[l], TBX_DOUBLE);
    tbx_read1(&x[2], &s->q[k], TBX_DOUBLE);
    tbx_read1(&x[3], &s->p[k], TBX_DOUBLE);
    tbx_segment_offset(&c, s, k, i, &a);
    tbx_num_difference(&c, &d, &x[0], &x[1]);
    tbx_num_mul(&c, &a, &a, &d);
    tbx_segment_offset(&c, s, l, j, &b);
    tbx_num_difference(&c, &d, &x[2], &x[3]);
    tbx_num_mul(&c, &b, &b, &d);
    tbx_num_add(&c, &a, &a, &b, -1);
    return a.sign * s->way[k] * s->way[l];
}

/* The sign of the difference of the times at which the planes behind voxel i of axis k and voxel j of axis l
 * are crossed, in double where that is certain. */
TBX_FN int tbx_segment_order(const tbx_segment *s, int k, int64_t i, int l, int64_t j)
{
    const double t = s->from[k] + (double)i * s->step[k];
    const double u = s->from[l] + (double)j * s->step[l];
    const double error = s->error * (2.0 + tbx_abs(t) + tbx_abs(u));
    if (t - u > error || u - t > error) {
        return t > u ? 1 : -1;
    }
    return tbx_segment_order_exact(s, k, i + (s->way[k] > 0), l, j + (s->way[l] > 0));
}

/* Emits a voxel, if it lies in the region. */
TBX_FN void tbx_segment_emit(tbx_segment *s, int64_t x, int64_t y, int64_t z)
{
    const tribox_grid *g = s->grid;
    if (!s->stopped && x >= g->lo[0] && x < g->hi[0] && y >= g->lo[1] && y < g->hi[1] && z >= g->lo[2] &&
        z < g->hi[2]) {
        s->count = tbx_saturating_add(s->count, 1);
        s->stopped = s->on_voxel != NULL && s->on_voxel(s->user, (int)x, (int)y, (int)z) != 0;
    }
}

/* The voxels touched where the planes of the axes in `crossed` are: before and after each, in the order of z,
 * y, x. Those before all planes were entered earlier, but for the first event. */
TBX_FN void tbx_segment_closed(tbx_segment *s, unsigned crossed, int first)
{
    int more[3]; /* the second voxel on the axis, if there is one */
    int x;
    int y;
    int z;
    int k;
    for (k = 0; k < 3; k++) {
        more[k] = (crossed >> k & 1u) != 0 ? s->way[k] : s->two[k];
    }
    for (z = 0; z <= (more[2] != 0); z++) {
        for (y = 0; y <= (more[1] != 0); y++) {
            for (x = 0; x <= (more[0] != 0); x++) {
                const unsigned after = (unsigned)(x | y << 1 | z << 2) & crossed;
                if (first || after != 0) {
                    tbx_segment_emit(s, s->voxel[0] + x * more[0], s->voxel[1] + y * more[1],
                                     s->voxel[2] + z * more[2]);
                }
            }
        }
    }
}

/* One event, by the rule. HALF_OPEN: the point itself belongs to the upper voxels; then those after it, where
 * it crosses a plane downward, which is none at its end. OPEN: those after it. */
TBX_NOINLINE void tbx_segment_event(tbx_segment *s, unsigned crossed, int first)
{
    unsigned up = 0;
    int64_t at[3];
    int64_t after[3];
    int k;
    if (!s->hi_is_open) {
        tbx_segment_closed(s, crossed, first);
    } else {
        for (k = 0; k < 3; k++) {
            const int crosses = (int)(crossed >> k & 1u);
            up |= (unsigned)(crosses && s->way[k] > 0) << k;
            after[k] = s->voxel[k] + crosses * s->way[k];
            at[k] = s->way[k] > 0 ? after[k] : s->voxel[k];
        }
        if (!s->lo_is_open && (first || up != 0)) {
            tbx_segment_emit(s, at[0], at[1], at[2]);
        }
        if (s->lo_is_open || crossed != up) {
            tbx_segment_emit(s, after[0], after[1], after[2]);
        }
    }
    for (k = 0; k < 3; k++) {
        s->voxel[k] += (crossed >> k & 1u) != 0 ? s->way[k] : 0;
    }
}

/* The next plane of an axis, whose voxel has been moved over one, or none. */
TBX_FN void tbx_segment_next(tbx_segment *s, int k)
{
    s->left[k]--;
    s->t[k] = s->left[k] > 0 ? s->from[k] + (double)s->voxel[k] * s->step[k] : 4.0;
}

/* The axes whose next plane is crossed first. */
TBX_NOINLINE unsigned tbx_segment_first(const tbx_segment *s)
{
    unsigned axes = 0;
    int best = -1;
    int k;
    for (k = 0; k < 3; k++) {
        if (s->left[k] > 0) {
            const int order = best < 0 ? -1 : tbx_segment_order(s, k, s->voxel[k], best, s->voxel[best]);
            if (order <= 0) {
                axes = order < 0 ? 1u << k : axes | 1u << k;
                best = order < 0 ? k : best;
            }
        }
    }
    return axes;
}

TBX_FN int tbx_segment_inside(const tbx_segment *s, int k)
{
    return s->two[k] || (s->voxel[k] >= s->grid->lo[k] && s->voxel[k] < s->grid->hi[k]);
}

/* One plane of axis k, at a time of its own, into the next voxel: only the last may lie outside of the
 * region. */
TBX_FN void tbx_segment_cross(tbx_segment *s, int k)
{
    s->voxel[k] += s->way[k];
    if (s->left[k] == 1 && !tbx_segment_inside(s, k)) {
        s->stopped = 1;
        return;
    }
    tbx_segment_next(s, k);
    s->count += s->count != (size_t)-1;
    if (s->on_voxel != NULL &&
        s->on_voxel(s->user, (int)s->voxel[0], (int)s->voxel[1], (int)s->voxel[2]) != 0) {
        s->stopped = 1;
    }
}

/* One event in the midst of the walk. */
TBX_NOINLINE void tbx_segment_tie(tbx_segment *s)
{
    const unsigned crossed = tbx_segment_first(s);
    int k;
    tbx_segment_event(s, crossed, 0);
    for (k = 0; k < 3; k++) {
        if ((crossed >> k & 1u) != 0) {
            s->stopped |= !tbx_segment_inside(s, k);
            tbx_segment_next(s, k);
        }
    }
}

/* From the first event on. Where the segment runs along a plane, each event is of several voxels. */
TBX_FN void tbx_segment_walk(tbx_segment *s)
{
    const double error = s->two[0] | s->two[1] | s->two[2] ? 4.0 : 8.0 * s->error;
    int k;
    for (k = 0; k < 3; k++) {
        s->t[k] = s->left[k] > 0 ? s->from[k] + (double)s->voxel[k] * s->step[k] : 4.0;
        s->stopped |= !tbx_segment_inside(s, k);
    }
    while (!s->stopped && (s->left[0] | s->left[1] | s->left[2]) != 0) {
        const double x = s->t[0];
        const double y = s->t[1];
        const double z = s->t[2];
        if (x + error < y) {
            if (x + error < z) {
                tbx_segment_cross(s, 0);
                continue;
            }
        } else if (y + error < x && y + error < z) {
            tbx_segment_cross(s, 1);
            continue;
        }
        if (z + error < x && z + error < y) {
            tbx_segment_cross(s, 2);
        } else {
            tbx_segment_tie(s);
        }
    }
}

/* Times in double on axis k, on which p and q differ, in units of u, with Q = (|origin| + |p| + |q| + size) /
 * |q - p| + 1: the difference of origin and p, their distance, the division (4), and two sums, 8 of Q; the
 * step alike, 7 of it in `from` and of step * voxel, which is at most Q + |t|: 22 of Q, 7 of |t|. */
TBX_FN void tbx_segment_times(tbx_segment *s, int k)
{
    const double *origin = &s->grid->origin[k];
    const double *size = &s->grid->size[k];
    double p = s->p[k];
    double q = s->q[k];
    if (TBX_DOUBLE_IS_53_BITS && tbx_is_ordinary(origin, 300) && tbx_is_ordinary(size, 300) &&
        tbx_is_ordinary(&p, 300) && tbx_is_ordinary(&q, 300)) {
        double start = *origin;
        double voxel = *size;
        double d;
        double error;
        TBX_KEEP_SCALAR(p); /* or compilers subtract and divide before they ask */
        TBX_KEEP3(SCALAR, q, start, voxel);
        d = q - p; /* at least 2^-352 */
        TBX_KEEP_SCALAR(d);
        error = (tbx_abs(start) + tbx_abs(p) + tbx_abs(q) + voxel) / tbx_abs(d) + 1.0;
        s->step[k] = voxel / d;
        s->from[k] = (start - p) / d + (s->way[k] > 0 ? s->step[k] : 0.0);
        s->error = s->error < TBX_SEGMENT_ERROR * error ? TBX_SEGMENT_ERROR * error : s->error;
    } else {
        s->from[k] = s->step[k] = 0.0;
        s->error = s->error < 4.0 ? 4.0 : s->error; /* integers alone */
    }
}

/* Where axis k is at the beginning, p, and what is left of it. Sets the voxel, the plane at or after p, and
 * whether that is at p. Returns 0 if the region is not touched. */
TBX_FN int tbx_segment_axis(tbx_segment *s, int k, int *on)
{
    const tribox_grid *g = s->grid;
    const int64_t lo = g->lo[k];
    const int64_t hi = g->hi[k];
    const double p = s->p[k];
    const double q = s->q[k];
    const int64_t up = tbx_plane_search(g, k, lo, hi + 1, p, 0); /* the least >= p */
    const int64_t up_q = tbx_plane_search(g, k, lo, hi + 1, q, 0);
    const int at_p = up <= hi && tbx_plane_compare(g, k, up, p) == 0;
    const int at_q = up_q <= hi && tbx_plane_compare(g, k, up_q, q) == 0;
    const int lower_p = up == lo && !at_p; /* below the region, or on the way into it */
    const int lower_q = up_q == lo && !at_q;
    const int way = (tbx_less(&p, &q) != 0) - (tbx_less(&q, &p) != 0);
    int64_t last;
    s->way[k] = way;
    s->two[k] = 0;
    s->left[k] = 0;
    *on = at_p;
    if ((lower_p && lower_q) || (up > hi && up_q > hi)) {
        return 0;
    }
    if (way == 0) {
        s->voxel[k] = up - 1;
        *on = 0;
        if (at_p && s->hi_is_open && !s->lo_is_open) {
            s->voxel[k] = up;
        }
        s->two[k] = at_p && !s->hi_is_open;
        return !s->hi_is_open || (tbx_segment_inside(s, k) && !(at_p && s->lo_is_open));
    }
    if (way > 0) {
        s->voxel[k] = up - 1;
        last = at_q ? up_q : up_q - 1;
        last -= at_q && s->lo_is_open;
    } else {
        s->voxel[k] = at_p ? up : up - 1;
        last = up_q + (at_q && s->hi_is_open);
    }
    s->left[k] = (last - tbx_segment_plane(s, k)) * way + 1;
    s->left[k] = s->left[k] > 0 ? s->left[k] : 0;
    return 1;
}

/* Moves axis k to the time at which the plane behind voxel i of axis e is crossed: over the planes that it
 * crosses before. Returns 1 if it crosses one just then. */
TBX_FN int tbx_segment_advance(tbx_segment *s, int k, int e, int64_t i)
{
    int64_t lo = 0;
    int64_t hi = s->left[k];
    while (lo < hi) {
        const int64_t mid = lo + (hi - lo) / 2;
        if (tbx_segment_order(s, k, s->voxel[k] + mid * s->way[k], e, i) < 0) {
            lo = mid + 1;
        } else {
            hi = mid;
        }
    }
    s->voxel[k] += lo * s->way[k];
    s->left[k] -= lo;
    return s->left[k] > 0 && tbx_segment_order(s, k, s->voxel[k], e, i) == 0;
}

/* The first event: at p, or, if that is outside of the region on some axes, where the last of these is
 * entered. Returns 0 if it never is. */
TBX_FN int tbx_segment_start(tbx_segment *s, const int on[3])
{
    unsigned crossed = 0;
    int e = -1; /* the last to be entered */
    int64_t i = 0;
    int k;
    for (k = 0; k < 3; k++) {
        if (s->way[k] != 0 && !on[k] && !tbx_segment_inside(s, k)) {
            if (s->left[k] == 0) {
                return 0;
            }
            if (e < 0 || tbx_segment_order(s, k, s->voxel[k], e, i) > 0) {
                e = k;
                i = s->voxel[k];
            }
        }
    }
    for (k = 0; k < 3; k++) {
        const int crosses = e < 0 ? on[k] : s->way[k] != 0 && tbx_segment_advance(s, k, e, i);
        crossed |= (unsigned)crosses << k;
    }
    tbx_segment_event(s, crossed, 1);
    for (k = 0; k < 3; k++) {
        if ((crossed >> k & 1u) != 0) {
            tbx_segment_next(s, k);
        }
    }
    return 1;
}

TRIBOX_FN size_t tribox_grid_segment(const tribox_grid *grid, const double p[3], const double q[3],
                                     tribox_voxel_fn on_voxel, void *user)
{
    tbx_segment s;
    int on[3];
    int k;
    if (!tbx_grid_valid(grid) || !tbx_finite3(p) || !tbx_finite3(q)) {
        return 0;
    }
    s.grid = grid;
    s.on_voxel = on_voxel;
    s.user = user;
    s.count = 0;
    s.stopped = 0;
    s.error = 0.0;
    s.lo_is_open = tbx_lo_is_open(grid->flags);
    s.hi_is_open = tbx_hi_is_open(grid->flags);
    for (k = 0; k < 3; k++) {
        s.p[k] = p[k];
        s.q[k] = q[k];
        if (!tbx_segment_axis(&s, k, &on[k])) {
            return 0;
        }
        s.from[k] = s.step[k] = 0.0;
        if (s.way[k] != 0) {
            tbx_segment_times(&s, k);
        }
    }
    if (tbx_segment_start(&s, on)) {
        tbx_segment_walk(&s);
    }
    return s.count;
}

/* ---- spheres
 *
 * Squares are compared: distances are roots, but no root is needed to compare them. Plain double decides all
 * but what is within a few units of rounding of touching; the rest goes to integers, of degree 2 to 6. */
enum { TBX_BALL_EMPTY, TBX_BALL, TBX_BALL_SPACE };

TBX_FN int tbx_ball_kind(const tbx_real c[3], const tbx_real *r)
{
    if (!tbx_finite(c, 3) || r->key < 0 || r->key > TBX_KEY_INFINITY) {
        return TBX_BALL_EMPTY;
    }
    return r->key == TBX_KEY_INFINITY ? TBX_BALL_SPACE : TBX_BALL;
}

/* As a radius: also what is below 0. */
TBX_FN int tbx_odd_radius(const float *r)
{
    return tbx_odd1(r) | (int)(tbx_bits32(r) >> 31);
}

/* Squares of differences and their sum err by less than 6 u of themselves, a radius squared and a sum of
 * radii by 4 u; their rounding in the comparison by as much again. Floats that are not odd neither over- nor
 * underflow. */
#define TBX_BALL_ERROR (16.0 * TBX_U64)

/* Is a <= b, squares each within BALL_ERROR of itself? */
TBX_FN int tbx_ball_less(double a, double b)
{
    const double error = (a + b) * TBX_BALL_ERROR;
    return a < b - error ? TBX_HIT : a > b + error ? TBX_MISS : TBX_UNSURE;
}

/* The sign of |x|^2 - r^2 in integers. */
TBX_FN int tbx_ball_compare(tbx_calc *c, const tbx_num x[3], const tbx_num *r)
{
    const int mark = c->used;
    tbx_num a;
    tbx_num b;
    tbx_num_dot(c, &a, x, x);
    tbx_num_mul(c, &b, r, r);
    tbx_num_add(c, &a, &a, &b, -1);
    c->used = mark;
    return tbx_num_sign(c, &a);
}

/* Two spheres are a box of one point, and both radii. The point of the box that is nearest to the centre is
 * known by comparisons alone. */
TBX_COLD int tbx_sphere_box_exact(const float center[3], const float box_min[3], const float box_max[3],
                                  const float radius[2])
{
    tbx_limb store[TBX_STORE];
    tbx_calc c;
    tbx_real x[3];
    tbx_real lo[3];
    tbx_real hi[3];
    tbx_real r[2];
    tbx_num d[3];
    tbx_num sum;
    tbx_num other;
    int k;
    tbx_calc_begin(&c, 1, store);
    tbx_read(x, center, 3, TBX_FLOAT);
    tbx_read(lo, box_min, 3, TBX_FLOAT);
    tbx_read(hi, box_max, 3, TBX_FLOAT);
    tbx_read(r, radius, 2, TBX_FLOAT);
    if (!tbx_box_valid(lo, hi) || tbx_ball_kind(x, &r[0]) == TBX_BALL_EMPTY ||
        tbx_ball_kind(x, &r[1]) == TBX_BALL_EMPTY) {
        return 0;
    }
    if (r[0].key == TBX_KEY_INFINITY || r[1].key == TBX_KEY_INFINITY) {
        return 1;
    }
    for (k = 0; k < 3; k++) {
        if (x[k].key < lo[k].key) {
            tbx_num_difference(&c, &d[k], &lo[k], &x[k]);
        } else if (x[k].key > hi[k].key) {
            tbx_num_difference(&c, &d[k], &x[k], &hi[k]);
        } else {
            tbx_num_integer(&c, &d[k], 0, 0);
        }
    }
    tbx_num_of(&c, &sum, &r[0]);
    tbx_num_of(&c, &other, &r[1]);
    tbx_num_add(&c, &sum, &sum, &other, 1);
    return tbx_ball_compare(&c, d, &sum) <= 0;
}

/* How far x lies outside of lo..hi. */
TBX_FN double tbx_outside(double x, double lo, double hi)
{
    const double below = lo - x;
    const double above = x - hi;
    const double farther = below > above ? below : above;
    return farther > 0.0 ? farther : 0.0;
}

/* Empty boxes are unsure, too. */
TBX_FN int tbx_sphere_box_filter(const float center[3], double r, const float box_min[3],
                                 const float box_max[3])
{
    double c[3];
    double lo[3];
    double hi[3];
    double x;
    double y;
    double z;
    tbx_take3_float(c, center);
    tbx_take3_float(lo, box_min);
    tbx_take3_float(hi, box_max);
    x = tbx_outside(c[0], lo[0], hi[0]);
    y = tbx_outside(c[1], lo[1], hi[1]);
    z = tbx_outside(c[2], lo[2], hi[2]);
    if (TBX_RARELY(tbx_more(lo[0], hi[0]) | tbx_more(lo[1], hi[1]) | tbx_more(lo[2], hi[2]))) {
        return TBX_UNSURE;
    }
    return tbx_ball_less(x * x + y * y + z * z, r * r);
}

/* A float that came by value, and may be anything, goes out of line as its bits: kept in a register until
 * here. */
TBX_FN void tbx_float_of(float *out, uint32_t bits)
{
    TBX_COPY(out, &bits, sizeof bits);
}

/* In double, then in integers; both radii count. */
TBX_NOINLINE int tbx_sphere_box_wide(const float c[3], const float box_min[3], const float box_max[3],
                                     uint32_t radius_bits, uint32_t other_bits)
{
    float radius[2];
    tbx_float_of(&radius[0], radius_bits);
    tbx_float_of(&radius[1], other_bits);
#if TBX_DOUBLE_IS_53_BITS
    if (!TBX_RARELY(tbx_odd4(c, c, box_min, box_max) ||
                    (tbx_odd_radius(&radius[0]) | tbx_odd_radius(&radius[1])))) {
        const double r = tbx_take(&radius[0]) + tbx_take(&radius[1]);
        const int verdict = tbx_sphere_box_filter(c, r, box_min, box_max);
        if (!TBX_RARELY(verdict == TBX_UNSURE)) {
            return verdict;
        }
    }
#endif
    return tbx_sphere_box_exact(c, box_min, box_max, radius);
}

TRIBOX_FN int tribox_sphere_sphere(const float a[3], float a_radius, const float b[3], float b_radius)
{
    TBX_RETURN_IF_SURE(tbx_sphere_sphere4(a, &a_radius, b, &b_radius));
    return tbx_sphere_box_wide(a, b, b, tbx_bits32(&a_radius), tbx_bits32(&b_radius));
}

TRIBOX_FN int tribox_sphere_box(const float c[3], float radius, const float box_min[3],
                                const float box_max[3])
{
    TBX_RETURN_IF_SURE(tbx_sphere_box4(c, &radius, box_min, box_max));
    return tbx_sphere_box_wide(c, box_min, box_max, tbx_bits32(&radius), 0);
}

/* By the sign of v = n.c + d, and of v^2 - r^2 |n|^2. */
TBX_COLD int tbx_plane_sphere_exact(const float n[3], const float *d, const float center[3],
                                    const float *radius)
{
    tbx_limb store[TBX_STORE];
    tbx_calc c;
    tbx_real x[2][3];
    tbx_real of[2];
    tbx_num normal[3];
    tbx_num point[3];
    tbx_num v;
    tbx_num r;
    int sign;
    int k;
    tbx_calc_begin(&c, 1, store);
    tbx_read(x[0], n, 3, TBX_FLOAT);
    tbx_read(x[1], center, 3, TBX_FLOAT);
    tbx_read1(&of[0], d, TBX_FLOAT);
    tbx_read1(&of[1], radius, TBX_FLOAT);
    if (!tbx_finite(x[0], 3) || tbx_key_is_nan(of[0].key) || tbx_ball_kind(x[1], &of[1]) == TBX_BALL_EMPTY) {
        return 2;
    }
    if (!tbx_key_is_finite(of[0].key) || (x[0][0].key == 0 && x[0][1].key == 0 && x[0][2].key == 0)) {
        return tbx_key_sign(of[0].key);
    }
    if (!tbx_key_is_finite(of[1].key)) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        tbx_num_of(&c, &normal[k], &x[0][k]);
        tbx_num_of(&c, &point[k], &x[1][k]);
    }
    tbx_num_dot(&c, &v, normal, point);
    tbx_num_of(&c, &r, &of[0]);
    tbx_num_add(&c, &v, &v, &r, 1);
    sign = tbx_num_sign(&c, &v);
    tbx_num_of(&c, &r, &of[1]);
    for (k = 0; k < 3; k++) {
        tbx_num_mul(&c, &normal[k], &normal[k], &r);
    }
    return tbx_ball_compare(&c, normal, &v) < 0 ? sign : 0;
}

/* v errs by 4 u of the magnitudes of its four terms, whose sum errs by as much of itself; its square and
 * r^2 |n|^2 are compared with that taken off, or put on. */
#define TBX_PLANE_SPHERE_ERROR (6.0 * TBX_U64)

/* What tribox_plane_sphere returns, or UNSURE. */
TBX_FN int tbx_plane_sphere_filter(const float n[3], double d, const float center[3], double r)
{
    double x[3];
    double c[3];
    double v = d;
    double mag = tbx_abs(d);
    double square = 0.0;
    double least;
    double most;
    int k;
    tbx_take3_float(x, n);
    tbx_take3_float(c, center);
    for (k = 0; k < 3; k++) {
        const double term = x[k] * c[k];
        v += term;
        mag += tbx_abs(term);
        square += x[k] * x[k];
    }
    square *= r * r;
    least = tbx_abs(v) - mag * TBX_PLANE_SPHERE_ERROR;
    most = tbx_abs(v) + mag * TBX_PLANE_SPHERE_ERROR;
    if (most * most < square * (1.0 - TBX_BALL_ERROR)) {
        return 0;
    }
    if (least > 0.0 && least * least > square * (1.0 + TBX_BALL_ERROR)) {
        return v > 0.0 ? 1 : -1;
    }
    return TBX_UNSURE;
}

TBX_NOINLINE int tbx_plane_sphere_wide(const float n[3], uint32_t d_bits, const float c[3],
                                       uint32_t radius_bits)
{
    float d;
    float radius;
    tbx_float_of(&d, d_bits);
    tbx_float_of(&radius, radius_bits);
#if TBX_DOUBLE_IS_53_BITS
    if (!TBX_RARELY(tbx_odd4(n, n, c, c) || (tbx_odd1(&d) | tbx_odd_radius(&radius)))) {
        const int verdict = tbx_plane_sphere_filter(n, tbx_take(&d), c, tbx_take(&radius));
        if (!TBX_RARELY(verdict == TBX_UNSURE)) {
            return verdict;
        }
    }
#endif
    return tbx_plane_sphere_exact(n, &d, c, &radius);
}

TRIBOX_FN int tribox_plane_sphere(const float n[3], float d, const float c[3], float radius)
{
    TBX_RETURN_IF_SURE(tbx_plane_sphere4(n, &d, c, &radius));
    return tbx_plane_sphere_wide(n, tbx_bits32(&d), c, tbx_bits32(&radius));
}

/* ---- sphere and triangle */

/* By what of T is nearest to the centre, d from a corner of it: the corner, |d|^2 <= r^2; an edge e,
 * |e x d|^2 <= r^2 |e|^2; the face, (n.d)^2 <= r^2 |n|^2. */
TBX_COLD int tbx_sphere_triangle_exact(const float center[3], const float *radius, const float *const v[3])
{
    tbx_limb store[TBX_STORE];
    tbx_calc c;
    tbx_nearest p;
    tbx_nearest_work work;
    tbx_real radius_read;
    const tbx_num *d;
    const tbx_num *l;
    tbx_num r;
    tbx_num x[3];
    tbx_num square;
    int kind;
    int feature;
    tbx_calc_begin(&c, 1, store);
    tbx_read(p.q, center, 3, TBX_FLOAT);
    tbx_read1(&radius_read, radius, TBX_FLOAT);
    tbx_read3(p.v, v[0], v[1], v[2], TBX_FLOAT);
    kind = tbx_ball_kind(p.q, &radius_read);
    if (kind != TBX_BALL || !tbx_finite(p.v[0], 9)) {
        return kind == TBX_BALL_SPACE && tbx_finite(p.v[0], 9);
    }
    tbx_num_of(&c, &r, &radius_read);
    feature = tbx_nearest_feature(&c, &p, &work);
    if (feature < 3) {
        return tbx_ball_compare(&c, work.to_q[feature], &r) <= 0;
    }
    d = work.to_q[(feature + 1) % 3];
    if (feature < 6) {
        l = work.edge[(feature + 1) % 3];
        tbx_num_cross(&c, x, l, d);
    } else {
        l = work.n;
        tbx_num_dot(&c, &x[0], l, d);
        tbx_num_integer(&c, &x[1], 0, 0);
        x[2] = x[1];
    }
    tbx_num_dot(&c, &square, l, l);
    tbx_num_mul(&c, &square, &square, &r);
    tbx_num_mul(&c, &square, &square, &r);
    tbx_num_dot(&c, &r, x, x);
    tbx_num_add(&c, &square, &square, &r, -1);
    return square.sign >= 0;
}

/* Weights of v1 and v2 for a point of T near the one that is nearest to the centre. a, b: v1 - v0, v2 - v0;
 * p: the centre - v0. Corner, edge or face is told from five dot products; where rounding picks the wrong
 * one, the point is a little farther, and decides a little less. */
TBX_FN void tbx_touch_weights(const double a[3], const double b[3], const double p[3], double out[2])
{
    const double aa = tbx_dot3(a, a);
    const double ab = tbx_dot3(a, b);
    const double bb = tbx_dot3(b, b);
    const double a0 = tbx_dot3(a, p); /* a.(centre - v0), then from v1, v2 */
    const double b0 = tbx_dot3(b, p);
    const double a1 = a0 - aa;
    const double b1 = b0 - ab;
    const double a2 = a0 - ab;
    const double b2 = b0 - bb;
    double v = a2 * b0 - a0 * b2; /* of v1: twice the area across it, times that of T */
    double w = a0 * b1 - a1 * b0;
    double size = v + w + (a1 * b2 - a2 * b1);
    if (a0 <= 0.0 && b0 <= 0.0) {
        v = w = 0.0;
        size = 1.0;
    } else if (a1 >= 0.0 && b1 <= a1) {
        v = size = 1.0;
        w = 0.0;
    } else if (b2 >= 0.0 && a2 <= b2) {
        w = size = 1.0;
        v = 0.0;
    } else if (w <= 0.0 && a0 >= 0.0 && a1 <= 0.0) {
        v = a0;
        w = 0.0;
        size = aa;
    } else if (v <= 0.0 && b0 >= 0.0 && b2 <= 0.0) {
        v = 0.0;
        w = b0;
        size = bb;
    } else if (a1 * b2 - a2 * b1 <= 0.0) {
        w = b1 - a1;
        v = a2 - b2;
        size = v + w;
    }
    v = v > 0.0 ? v : 0.0;
    w = w > 0.0 ? w : 0.0;
    size = size > v + w ? size : v + w;
    size = size > 0.0 ? size : 1.0;
    TBX_KEEP_SCALAR(size); /* divides only if it is not 0 */
    size = 1.0 / size;
    out[0] = v * size;
    out[1] = w * size;
}

/* The sum of three magnitudes. */
TBX_FN double tbx_size3(const double x[3])
{
    return tbx_abs(x[0]) + tbx_abs(x[1]) + tbx_abs(x[2]);
}

/* In double: a point of T within r is a hit; a plane across the way from the nearest point to the centre,
 * with T beyond r behind it, is a miss. With M the sum of all coordinates' magnitudes, counted from v0: the
 * point errs by 10 u M from one of T, to which weights of a sum above 1 belong as well, and a corner's
 * distance along the way g by 6 u M |g|. */
#define TBX_TOUCH_ERROR (16.0 * TBX_U64)

typedef struct tbx_touched {
    double square; /* |g|^2 */
    double size;   /* the sum of g's magnitudes */
    double least;  /* how far T stays behind the centre along g, times |g| */
    double error;  /* of the point; times size, of least */
} tbx_touched;

TBX_FN void tbx_touch_set(tbx_touched *t, const float center[3], const float *const v[3])
{
    double x[4][3];
    double a[3];
    double b[3];
    double p[3];
    double g[3];
    double weight[2];
    double of_a;
    double of_b;
    tbx_take3_float(x[0], v[0]);
    tbx_take3_float(x[1], v[1]);
    tbx_take3_float(x[2], v[2]);
    tbx_take3_float(x[3], center);
    tbx_minus3(a, x[1], x[0]);
    tbx_minus3(b, x[2], x[0]);
    tbx_minus3(p, x[3], x[0]);
    tbx_touch_weights(a, b, p, weight);
    g[0] = p[0] - (weight[0] * a[0] + weight[1] * b[0]);
    g[1] = p[1] - (weight[0] * a[1] + weight[1] * b[1]);
    g[2] = p[2] - (weight[0] * a[2] + weight[1] * b[2]);
    of_a = tbx_dot3(g, a);
    of_b = tbx_dot3(g, b);
    of_a = of_a > of_b ? of_a : of_b;
    t->square = tbx_dot3(g, g);
    t->size = tbx_size3(g);
    t->least = tbx_dot3(g, p) - (of_a > 0.0 ? of_a : 0.0);
    t->error = (tbx_size3(a) + tbx_size3(b) + tbx_size3(p)) * TBX_TOUCH_ERROR;
}

TBX_FN int tbx_touch_filter(const float center[3], double r, const float *const v[3])
{
    tbx_touched t;
    double least;
    tbx_touch_set(&t, center, v);
    if (t.square + 4.0 * t.error * (r + t.error) < r * r * (1.0 - TBX_BALL_ERROR)) {
        return TBX_HIT;
    }
    least = t.least - t.error * t.size;
    if (least > 0.0 && least * least > r * r * t.square * (1.0 + 2.0 * TBX_BALL_ERROR)) {
        return TBX_MISS;
    }
    return TBX_UNSURE;
}

TRIBOX_FN int tribox_sphere_triangle(const float c[3], float radius, const float v0[3], const float v1[3],
                                     const float v2[3])
{
    const float *const v[3] = { v0, v1, v2 };
#if TBX_DOUBLE_IS_53_BITS
    if (!TBX_RARELY(tbx_odd4(c, v0, v1, v2) || tbx_odd_radius(&radius))) {
        const int verdict = tbx_touch_filter(c, tbx_take(&radius), v);
        if (!TBX_RARELY(verdict == TBX_UNSURE)) {
            return verdict;
        }
    }
#endif
    return tbx_sphere_triangle_exact(c, &radius, v);
}

/* ---- ray and sphere
 *
 * With m = origin - c, the ray is inside where f(t) = A t^2 + 2 B t + C <= 0, A = dir.dir, B = dir.m, C = m.m
 * - r^2: nowhere if B^2 < A C, else between two roots about -B/A. A float t lies before the first iff A t + B
 * <= 0 and f(t) >= 0, so the ends are rounded without a root. */
typedef struct tbx_pierce {
    tbx_calc calc;
    tbx_real t[2];
    tbx_num a;
    tbx_num b;
    tbx_num c;
} tbx_pierce;

/* Where the number with this key lies, as seen from end e towards the middle of the sphere: -1 outside, 0 at
 * the end, 1 inside or beyond the middle. */
TBX_FN int tbx_pierce_side(tbx_pierce *x, int e, const tbx_real *t)
{
    tbx_calc *c = &x->calc;
    const int mark = c->used;
    tbx_num at;
    tbx_num value;
    tbx_num slope;
    int before;
    int sign;
    if (!tbx_key_is_finite(t->key)) {
        return (t->key < 0) == (e == 0) ? -1 : 1;
    }
    tbx_num_of(c, &at, t);
    tbx_num_mul(c, &slope, &x->a, &at);
    tbx_num_add(c, &slope, &slope, &x->b, 1);
    tbx_num_add(c, &value, &slope, &x->b, 1);
    tbx_num_mul(c, &value, &value, &at);
    tbx_num_add(c, &value, &value, &x->c, 1);
    before = tbx_num_sign(c, &slope) * (e == 0 ? 1 : -1);
    sign = tbx_num_sign(c, &value);
    c->used = mark;
    return before > 0 || sign < 0 ? 1 : sign == 0 ? 0 : -1;
}

/* End e, outward: for e = 0 the greatest float that is outside or at the end, for 1 the least. */
TBX_FN int64_t tbx_pierce_round(tbx_pierce *x, int e)
{
    const int64_t way = e == 0 ? 1 : -1;
    int64_t lo = -TBX_FLOAT_INFINITY; /* way * lo is outside, way * hi is not */
    int64_t hi = TBX_FLOAT_INFINITY + 1;
    while (hi - lo > 1) {
        const int64_t mid = lo + (hi - lo) / 2;
        float number;
        tbx_real t;
        tbx_write(&number, 0, TBX_FLOAT, way * mid);
        tbx_read1(&t, &number, TBX_FLOAT);
        if (tbx_pierce_side(x, e, &t) <= 0) {
            lo = mid;
        } else {
            hi = mid;
        }
    }
    return way * lo;
}

/* Some t of t[0]..t[1] is inside: the ends of the ray are not both before, nor both behind. */
TBX_FN int tbx_pierce_run(tbx_pierce *x, int64_t out[2])
{
    tbx_calc *c = &x->calc;
    const int mark = c->used;
    tbx_num d;
    tbx_num ac;
    int sign;
    int e;
    if (x->a.sign == 0) {
        out[0] = tbx_format_key(x->t[0].key, TBX_FLOAT);
        out[1] = tbx_format_key(x->t[1].key, TBX_FLOAT);
        return tbx_num_sign(c, &x->c) <= 0;
    }
    tbx_num_mul(c, &d, &x->b, &x->b);
    tbx_num_mul(c, &ac, &x->a, &x->c);
    tbx_num_add(c, &d, &d, &ac, -1);
    sign = tbx_num_sign(c, &d);
    c->used = mark;
    if (sign < 0 || tbx_pierce_side(x, 0, &x->t[1]) < 0 || tbx_pierce_side(x, 1, &x->t[0]) < 0) {
        return 0;
    }
    for (e = 0; e < 2; e++) {
        out[e] = tbx_pierce_side(x, e, &x->t[e]) < 0 ? tbx_pierce_round(x, e)
                                                     : tbx_format_key(x->t[e].key, TBX_FLOAT);
    }
    return 1;
}

TBX_COLD int tbx_ray_sphere_exact(const float origin[3], const float dir[3], const float t_ends[2],
                                  const float center[3], const float *radius, int64_t out[2])
{
    tbx_limb store[TBX_STORE];
    tbx_pierce x;
    tbx_ray ray;
    tbx_real middle[3];
    tbx_real r;
    tbx_num m[3];
    tbx_num d[3];
    tbx_num square;
    int kind;
    int k;
    tbx_calc_begin(&x.calc, 1, store);
    tbx_ray_read(&ray, origin, dir, t_ends, TBX_FLOAT);
    tbx_read(middle, center, 3, TBX_FLOAT);
    tbx_read1(&r, radius, TBX_FLOAT);
    kind = tbx_ball_kind(middle, &r);
    if (kind == TBX_BALL_EMPTY || !tbx_ray_valid(&ray)) {
        return 0;
    }
    for (k = 0; k < 2; k++) {
        x.t[k] = ray.t[k];
        out[k] = tbx_format_key(ray.t[k].key, TBX_FLOAT);
    }
    if (kind == TBX_BALL_SPACE) {
        return 1;
    }
    for (k = 0; k < 3; k++) {
        tbx_num_of(&x.calc, &d[k], &ray.dir[k]);
    }
    tbx_num_difference3(&x.calc, m, ray.origin, middle);
    tbx_num_dot(&x.calc, &x.a, d, d);
    tbx_num_dot(&x.calc, &x.b, d, m);
    tbx_num_dot(&x.calc, &x.c, m, m);
    tbx_num_of(&x.calc, &square, &r);
    tbx_num_mul(&x.calc, &square, &square, &square);
    tbx_num_add(&x.calc, &x.c, &x.c, &square, -1);
    return tbx_pierce_run(&x, out);
}

/* A ray's ends in double; an infinite one is past every time, |B| / A < 2^256. 0 for NaN, subnormals, and
 * what is no ray. */
TBX_FN int tbx_pierce_ends(const float t[2], double out[2])
{
    const int32_t infinity = 0x7f800000;
    const int32_t from = tbx_key32(&t[0]);
    const int32_t to = tbx_key32(&t[1]);
    const int from_infinite = from == -infinity;
    const int to_infinite = to == infinity;
    if (from > to || (!from_infinite && tbx_odd1(&t[0])) || (!to_infinite && tbx_odd1(&t[1]))) {
        return 0;
    }
    out[0] = from_infinite ? -TBX_SLAB_BEYOND : tbx_take(&t[0]);
    out[1] = to_infinite ? TBX_SLAB_BEYOND : tbx_take(&t[1]);
    return 1;
}

/* Where the ray enters (e = 0) or leaves (1), as a key: at t, or at its own end, a float. Which one comes
 * first needs no test of its own: a float nearer to t than error leaves no single key to round to. */
TBX_FN int64_t tbx_pierce_end(double t, double error, int e, double own, const float *own_float, int *unsure)
{
    const double beyond = e == 0 ? own - t : t - own;
    const int64_t key = tbx_round_outward(t, error, e);
    const int64_t is_own = -(int64_t)(beyond >= error); /* a coin toss: no branch */
    *unsure |= (key | is_own) == 0;
    return (key & ~is_own) | ((int64_t)tbx_key32(own_float) & is_own);
}

/* In double. In units of u: B errs by 4 of the magnitudes b of its terms, C by 6 of c = m.m + r^2, so D =
 * B^2 - A C by 10 b^2 + 11 A c, its root by half of that over the root and by 5 of itself, and a root of f
 * by what both add up to, over A, and 11 of itself (4 of them a division's). Returns MISS, HIT with the ends
 * as keys, or UNSURE. */
#define TBX_PIERCE_ERROR (32.0 * TBX_U64)

typedef struct tbx_parabola {
    double a;
    double b;
    double d;
    double b_size;
    double d_error;
} tbx_parabola;

TBX_FN void tbx_parabola_set(tbx_parabola *f, const float origin[3], const float dir[3],
                             const float center[3], double r)
{
    double w[3];
    double m[3];
    double mm;
    tbx_take3_float(w, center);
    tbx_take3_float(m, origin);
    tbx_minus3(m, m, w);
    tbx_take3_float(w, dir);
    r = r * r;
    mm = tbx_dot3(m, m);
    f->a = tbx_dot3(w, w);
    f->b = tbx_dot3(w, m);
    f->d = f->b * f->b - f->a * (mm - r);
    f->b_size = tbx_abs(w[0] * m[0]) + tbx_abs(w[1] * m[1]) + tbx_abs(w[2] * m[2]);
    f->d_error = (f->b_size * f->b_size + f->a * (mm + r)) * TBX_PIERCE_ERROR;
}

/* The roots where A > 0 and D is well above its error. Returns their error. */
TBX_FN double tbx_parabola_roots(const tbx_parabola *f, double out[2])
{
    double a = f->a;
    double root = f->d;
    double inverse;
    double error;
    TBX_KEEP_SCALAR(a); /* divides only if it is not 0 */
    TBX_KEEP_SCALAR(root);
    root = tbx_root(root);
    inverse = 1.0 / (a * root);
    error = (f->d_error + (f->b_size + root) * TBX_PIERCE_ERROR * root) * inverse;
    inverse *= root;
    out[0] = (-f->b - root) * inverse;
    out[1] = (root - f->b) * inverse;
    return error;
}

TBX_FN int tbx_pierce_filter(const float origin[3], const float dir[3], const float t[2],
                             const float center[3], double r, int64_t out[2])
{
    tbx_parabola f;
    double ends[2];
    double roots[2];
    double error;
    int unsure = 0;
    tbx_parabola_set(&f, origin, dir, center, r);
    if (f.d < -f.d_error) {
        return TBX_MISS; /* NaN is no ray, too */
    }
    if (!(f.d > 1024.0 * f.d_error) || !tbx_pierce_ends(t, ends)) {
        return TBX_UNSURE;
    }
    error = tbx_parabola_roots(&f, roots);
    if (tbx_more(ends[0], roots[1] + error) | tbx_more(roots[0] - error, ends[1])) {
        return TBX_MISS;
    }
    out[0] = tbx_pierce_end(roots[0], error, 0, ends[0], &t[0], &unsure);
    out[1] = tbx_pierce_end(roots[1], error, 1, ends[1], &t[1], &unsure);
    unsure |= !(tbx_more(roots[1] - error, ends[0]) & tbx_more(ends[1], roots[0] + error));
    return unsure ? TBX_UNSURE : TBX_HIT;
}

TRIBOX_FN int tribox_ray_sphere(const float origin[3], const float dir[3], float t_min, float t_max,
                                const float c[3], float radius, float *out_t0, float *out_t1)
{
    float t[2];
    int64_t key[2];
    int hit = TBX_UNSURE;
    int usual = TBX_UNSURE; /* MISS, or HIT: numbers are */
    TBX_COPY(&t[0], &t_min, sizeof t_min);
    TBX_COPY(&t[1], &t_max, sizeof t_max);
#if TRIBOX_SIMD
    usual = tbx_pierce4(origin, dir, t, c, &radius);
    if (usual == TBX_MISS) { /* most rays */
        return 0;
    }
#endif
    (void)usual;
#if TBX_DOUBLE_IS_53_BITS
    if (usual == TBX_HIT || !(tbx_odd4(origin, dir, c, c) || tbx_odd_radius(&radius))) {
        hit = tbx_pierce_filter(origin, dir, t, c, tbx_take(&radius), key);
    }
#endif
    if (TBX_RARELY(hit == TBX_UNSURE)) {
        hit = tbx_ray_sphere_exact(origin, dir, t, c, &radius, key);
    }
    if (hit) {
        tbx_write(out_t0, 0, TBX_FLOAT, key[0]);
        tbx_write(out_t1, 0, TBX_FLOAT, key[1]);
    }
    return hit;
}

#endif /* TRIBOX_NO_COMPANIONS */

/* ---- 11. SIMD ------------------------------------------------------------------------------------------ */
/* All that is faster, nothing that is needed: leave this section out and the answers are the same. */

#if TRIBOX_SIMD
/* ---- 11.1 Kit, and the filters of one box */

/* The same filter in float, x, y, z in three lanes; the fourth stays 0.
 * A cross product comes out as z, x, y. */
typedef float tbx_f4 __attribute__((vector_size(16)));
typedef int32_t tbx_i4 __attribute__((vector_size(16)));
typedef uint32_t tbx_u4 __attribute__((vector_size(16)));
typedef double tbx_d2 __attribute__((vector_size(16)));
typedef int64_t tbx_l2 __attribute__((vector_size(16)));

/* Lanes i, j, k, l of a (0..3) and b (4..7). */
#if defined(__clang__)
#define TBX_LANES(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#else
TBX_FN tbx_i4 tbx_order(int32_t i, int32_t j, int32_t k, int32_t l)
{
    const tbx_i4 r = { i, j, k, l };
    return r;
}
#define TBX_LANES(a, b, i, j, k, l) __builtin_shuffle(a, b, tbx_order(i, j, k, l))
#endif

/* Lanes 0, 1, 2 of a, and lane i of b: one instruction, or two, which gcc has to be told. */
#if defined(__SSE2__) && !defined(__SSE4_1__)
#define TBX_JOIN(a, b, i) TBX_LANES(a, TBX_LANES(a, b, 2, 2, 4 + (i), 4 + (i)), 0, 1, 4, 6)
#else
#define TBX_JOIN(a, b, i) TBX_LANES(a, b, 0, 1, 2, 4 + (i))
#endif

/* Three floats' bits, and 0. */
TBX_FN tbx_i4 tbx_load3i(const void *v)
{
    tbx_i4 z = { 0, 0, 0, 0 };
    tbx_l2 xy = { 0, 0 };
    int64_t pair;
    int32_t last;
    TBX_COPY(&pair, v, sizeof pair);
    TBX_COPY(&last, (const char *)v + sizeof pair, sizeof last);
    xy[0] = pair;
    z[0] = last;
    return TBX_LANES((tbx_i4)xy, z, 0, 1, 4, 5);
}

TBX_FN tbx_f4 tbx_load3(const void *v)
{
    return (tbx_f4)tbx_load3i(v);
}

/* Two floats, and zeros. */
TBX_FN tbx_f4 tbx_load_pair(const float v[2])
{
    tbx_l2 xy = { 0, 0 };
    int64_t pair;
    TBX_COPY(&pair, v, sizeof pair);
    xy[0] = pair;
    return (tbx_f4)xy;
}

TBX_FN tbx_f4 tbx_load4(const float v[4])
{
    tbx_f4 r;
    TBX_COPY(&r, v, sizeof r);
    return r;
}

TBX_FN tbx_i4 tbx_load4i(const int32_t v[4])
{
    tbx_i4 r;
    TBX_COPY(&r, v, sizeof r);
    return r;
}

TBX_FN tbx_f4 tbx_splat(float x)
{
    const tbx_f4 r = { x, x, x, x };
    return r;
}

TBX_FN tbx_i4 tbx_splat_int(int32_t x)
{
    const tbx_i4 r = { x, x, x, x };
    return r;
}

TBX_FN tbx_f4 tbx_yzx(tbx_f4 a)
{
    return TBX_LANES(a, a, 1, 2, 0, 3);
}

#if defined(__SSE2__)
TBX_FN tbx_f4 tbx_min4(tbx_f4 a, tbx_f4 b)
{
    return __builtin_ia32_minps(a, b);
}

TBX_FN tbx_f4 tbx_max4(tbx_f4 a, tbx_f4 b)
{
    return __builtin_ia32_maxps(a, b);
}

/* The sign bits of the four lanes. */
TBX_FN int tbx_signs(tbx_i4 mask)
{
    return __builtin_ia32_movmskps((tbx_f4)mask);
}
#elif defined(__wasm_simd128__)
TBX_FN tbx_f4 tbx_min4(tbx_f4 a, tbx_f4 b)
{
    return __builtin_wasm_pmin_f32x4(b, a);
}

TBX_FN tbx_f4 tbx_max4(tbx_f4 a, tbx_f4 b)
{
    return __builtin_wasm_pmax_f32x4(b, a);
}

TBX_FN int tbx_signs(tbx_i4 mask)
{
    return (int)__builtin_wasm_bitmask_i32x4(mask);
}
#else
TBX_FN tbx_f4 tbx_min4(tbx_f4 a, tbx_f4 b)
{
    const tbx_i4 less = a < b;
    return (tbx_f4)(((tbx_i4)a & less) | ((tbx_i4)b & ~less));
}

TBX_FN tbx_f4 tbx_max4(tbx_f4 a, tbx_f4 b)
{
    const tbx_i4 more = a > b;
    return (tbx_f4)(((tbx_i4)a & more) | ((tbx_i4)b & ~more));
}

TBX_FN int tbx_signs(tbx_i4 mask)
{
    const tbx_i4 weight = { 1, 2, 4, 8 };
    const tbx_i4 bits = (mask < 0) & weight;
    return bits[0] + bits[1] + bits[2] + bits[3];
}
#endif

/* a*b + c: fused where that is one instruction. clang contracts on its own; gcc does not under -std=c99. */
TBX_FN tbx_f4 tbx_fma4(tbx_f4 a, tbx_f4 b, tbx_f4 c)
{
#if defined(__FMA__) && !defined(__clang__)
    return __builtin_ia32_vfmaddps(a, b, c);
#else
    return a * b + c;
#endif
}

/* The sign bits of four vectors, those of the first lowest. */
TBX_FN unsigned tbx_signs16(tbx_i4 a, tbx_i4 b, tbx_i4 c, tbx_i4 d)
{
#if defined(__SSE2__)
    return (unsigned)__builtin_ia32_pmovmskb128(
        __builtin_ia32_packsswb128(__builtin_ia32_packssdw128(a, b), __builtin_ia32_packssdw128(c, d)));
#else
    return (unsigned)(tbx_signs(a) | tbx_signs(b) << 4 | tbx_signs(c) << 8 | tbx_signs(d) << 12);
#endif
}

TBX_FN int tbx_any(tbx_i4 mask)
{
    return tbx_signs(mask) != 0;
}

TBX_FN tbx_i4 tbx_magnitude(tbx_f4 a)
{
    return (tbx_i4)a & tbx_splat_int(0x7fffffff);
}

TBX_FN tbx_f4 tbx_abs4(tbx_f4 a)
{
    return (tbx_f4)tbx_magnitude(a);
}

/* r_i = |e_b| h_c + |e_c| h_b, as z, x, y; e absolute */
TBX_FN tbx_f4 tbx_radius4(tbx_f4 e, tbx_f4 h, tbx_f4 h_yzx)
{
    return e * h_yzx + tbx_yzx(e) * h;
}

/* The sums of three lanes of a and of b, in lanes 0 and 1. */
TBX_FN tbx_f4 tbx_sums3(tbx_f4 a, tbx_f4 b)
{
    const tbx_f4 low = TBX_LANES(a, b, 0, 4, 1, 5);
    const tbx_f4 high = TBX_LANES(a, b, 2, 6, 3, 7);
    return low + TBX_LANES(low, low, 2, 3, 2, 3) + high;
}

/* The sums of three lanes of each, in order. */
TBX_FN tbx_f4 tbx_three_sums3(tbx_f4 a, tbx_f4 b, tbx_f4 c)
{
    const tbx_f4 ab = TBX_LANES(a, b, 0, 4, 1, 5);
    const tbx_f4 ab_high = TBX_LANES(a, b, 2, 6, 3, 7);
    return (TBX_LANES(ab, c, 0, 1, 4, 4) + TBX_LANES(ab, c, 2, 3, 5, 5)) + TBX_LANES(ab_high, c, 0, 1, 6, 6);
}

/* Sign bits: lanes whose magnitude, given by its bits, exceeds the float with bits `most`;
 * NaN exceeds all. The difference wraps around where a number below zero is asked, whose sign decides
 * elsewhere. */
TBX_FN tbx_i4 tbx_above(tbx_f4 magnitude, int32_t most)
{
    return (tbx_i4)((tbx_u4)tbx_splat_int(most) - (tbx_u4)magnitude);
}

/* Sign bits: lanes that are not 0 and whose magnitude is below the float with bits `least`. */
TBX_FN tbx_i4 tbx_below(tbx_f4 magnitude, int32_t least)
{
    const tbx_u4 bits = (tbx_u4)magnitude;
    return (tbx_i4)((bits - (tbx_u4)tbx_splat_int(least)) & (0u - bits));
}

/* Floats of at least 2^-100 are multiples of 2^-123, and so are their differences: none is flushed to zero.
 * Sign bits: those that may be. */
TBX_FN tbx_i4 tbx_flushes(tbx_f4 v)
{
    return tbx_below(tbx_abs4(v), 0x0d800000);
}

TBX_FN int tbx_may_flush(const float v[3])
{
    return tbx_any(tbx_flushes(tbx_load3(v)));
}

/* An edge's value less |n|, as z, x, y: |e_b| h_c + |e_c| h_b - |s|. e: absolute. */
TBX_FN tbx_f4 tbx_edge4(tbx_f4 e, tbx_f4 e_yzx, tbx_f4 h, tbx_f4 h_yzx, tbx_f4 s)
{
    return e * h_yzx + (e_yzx * h - tbx_abs4(s));
}

/* Lanes whose upper 16 bits are the greater of a's and b's, both of positive numbers; the lower are
 * anything. */
TBX_FN tbx_i4 tbx_greater_high(tbx_i4 a, tbx_i4 b)
{
#if defined(__SSE2__) && !defined(__clang__)
    typedef short tbx_s8 __attribute__((vector_size(16)));
    return (tbx_i4)__builtin_ia32_pmaxsw128((tbx_s8)a, (tbx_s8)b);
#elif defined(__SSE2__)
    typedef short tbx_s8 __attribute__((vector_size(16)));
    const tbx_s8 more = (tbx_s8)a > (tbx_s8)b; /* with the next line, one instruction of clang's */
    return (tbx_i4)(((tbx_s8)a & more) | ((tbx_s8)b & ~more));
#else
    const tbx_i4 more = a > b;
    return (a & more) | (b & ~more);
#endif
}

/* The greatest upper halves of three vectors of bits, without their signs; of five. */
TBX_FN tbx_i4 tbx_greatest3(tbx_i4 a, tbx_i4 b, tbx_i4 c)
{
    const tbx_i4 positive = tbx_splat_int(0x7fffffff);
    return tbx_greater_high(tbx_greater_high(a & positive, b & positive), c & positive);
}

TBX_FN tbx_i4 tbx_greatest5(tbx_i4 a, tbx_i4 b, tbx_i4 c, tbx_i4 d, tbx_i4 e)
{
    const tbx_i4 positive = tbx_splat_int(0x7fffffff);
    return tbx_greater_high(tbx_greatest3(a, b, c), tbx_greater_high(d & positive, e & positive));
}

/* A segment in float: is the clipped box hit? Where lower > upper a face parts them, or min > max. Range is
 * checked. out_open: that is unsure; out_refused: axes (bits 0 to 2) on which the ends differ by so little
 * that products may underflow; bit 3 unless this processor reads or writes subnormals as zero. */
TBX_FN int tbx_segment4(tbx_f4 p, tbx_f4 q, tbx_f4 lower, tbx_f4 upper, int *out_open, int *out_refused)
{
    const tbx_i4 tiny_bits = { 0, 0, 0, 1 }; /* as in tbx_filter4 */
    tbx_f4 a = q - p;
    tbx_f4 l = lower - p;
    tbx_f4 h = upper - lower;
    TBX_KEEP3(VECTOR, a, l, h);
    {
        const tbx_f4 m = l + l + h;
        const tbx_f4 e = tbx_abs4(a);
        const tbx_f4 c = a * tbx_yzx(m) - tbx_yzx(a) * m;
        const tbx_f4 value = tbx_radius4(e, h, tbx_yzx(h)) - tbx_abs4(c);
        const tbx_f4 bound = tbx_splat(TBX_ULPS * TBX_U32) * e * tbx_yzx(e);
        const int miss = tbx_any((lower > upper) | (value < -bound));
        *out_open = tbx_any(value < bound) & !miss;
        *out_refused = tbx_signs(tbx_below(e + (tbx_f4)tiny_bits, 0x30800000));
        return !miss;
    }
}

/* Does t surpass p and q on some axis? */
TBX_FN int tbx_is_outside4(tbx_f4 t, tbx_f4 p, tbx_f4 q)
{
    return tbx_any((t < tbx_min4(p, q)) | (t > tbx_max4(p, q)));
}

/* The rare cases of the float filter. found: UNSURE, where the box's faces are known to hold, or the verdict
 * where subnormals may have been read as zero. */
TBX_COLD int tbx_filter4_rare(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                              const float box_max[3], int found)
{
    tbx_f4 p = tbx_load3(v0);
    tbx_f4 q = tbx_load3(v1);
    tbx_f4 t = tbx_load3(v2);
    const tbx_f4 lo = tbx_load3(box_min);
    const tbx_f4 hi = tbx_load3(box_max);
    int i;
    if (tbx_any(tbx_flushes(p) | tbx_flushes(q) | tbx_flushes(t) | tbx_flushes(lo) | tbx_flushes(hi))) {
        return TBX_UNSURE;
    }
    for (i = 0; i < 3 && found == TBX_UNSURE; i++) {
        if (!tbx_is_outside4(t, p, q)) {
            /* An edge with the triangle's bounding box: as in tbx_clipped_edge. */
            const int is_end = !(tbx_any((t < p) | (t > p)) && tbx_any((t < q) | (t > q)));
            int open;
            int refused;
            const int hit = tbx_segment4(p, q, tbx_max4(lo, tbx_min4(p, q)), tbx_min4(hi, tbx_max4(p, q)),
                                         &open, &refused);
            return open || (refused & 7) != 0 || (!hit && !is_end) ? TBX_UNSURE : hit;
        } else {
            const tbx_f4 next = p;
            p = q;
            q = t;
            t = next;
        }
    }
    return found;
}

/* The verdict of the float filter. rule: the box is not closed, so equality at a face is unsure. Coordinates
 * of 2^39 and more, infinity and NaN are refused by their bits, before anything is computed with them. */
TBX_FN int tbx_filter4(const float v0[3], const float v1[3], const float v2[3], const float box_min[3],
                       const float box_max[3], int rule)
{
    const tbx_i4 tiny_bits = { 0, 0, 0, 1 }; /* 2^-149 */
    const tbx_f4 zero = { 0.0f, 0.0f, 0.0f, 0.0f };
    tbx_f4 p0 = tbx_load3(v0);
    tbx_f4 p1 = tbx_load3(v1);
    tbx_f4 p2 = tbx_load3(v2);
    tbx_f4 lo = tbx_load3(box_min);
    tbx_f4 hi = tbx_load3(box_max);
    const tbx_i4 greatest = tbx_greatest5((tbx_i4)p0, (tbx_i4)p1, (tbx_i4)p2, (tbx_i4)lo, (tbx_i4)hi);
    if (TBX_RARELY(tbx_any(tbx_splat_int(0x52ffffff) - greatest))) {
        return TBX_UNSURE;
    }
    TBX_KEEP3(VECTOR, p0, p1, p2);
    TBX_KEEP2(VECTOR, lo, hi);
    {
        const tbx_f4 t_min = tbx_min4(tbx_min4(p0, p1), p2);
        const tbx_f4 t_max = tbx_max4(tbx_max4(p0, p1), p2);
        const tbx_f4 lower = tbx_max4(lo, t_min);
        tbx_f4 a1 = p1 - p0;
        tbx_f4 a2 = p2 - p0;
        tbx_f4 l = lower - p0;
        tbx_f4 h = tbx_min4(hi, t_max) - lower;
        TBX_KEEP4(VECTOR, a1, a2, l, h);
        {
            const tbx_f4 m = l * tbx_splat(2.0f) + h;
            const tbx_f4 e0 = tbx_abs4(a1);
            const tbx_f4 e1 = tbx_abs4(a2 - a1);
            const tbx_f4 e2 = tbx_abs4(a2);
            const tbx_f4 m_yzx = tbx_yzx(m);
            const tbx_f4 h_yzx = tbx_yzx(h);
            const tbx_f4 a1_yzx = tbx_yzx(a1);
            const tbx_f4 a2_yzx = tbx_yzx(a2);
            const tbx_f4 c0 = a1 * m_yzx - a1_yzx * m;
            const tbx_f4 c2 = m * a2_yzx - m_yzx * a2;
            const tbx_f4 n = a1 * a2_yzx - a1_yzx * a2;
            const tbx_f4 n_xyz = tbx_yzx(n);
            const tbx_f4 sums = tbx_sums3(n_xyz * m, tbx_abs4(n_xyz) * h);
            const tbx_f4 s0 = n - c0;
            const tbx_f4 s2 = n - c2;
            const tbx_f4 s1 = c0 - s2;
            /* lane 3: -|n.m| here, and |n|.h in place of |n| make it the plane */
            const tbx_f4 g0 = tbx_edge4(e0, tbx_abs4(a1_yzx), h, h_yzx, TBX_JOIN(s0, sums, 0));
            const tbx_f4 g1 = tbx_edge4(e1, tbx_yzx(e1), h, h_yzx, s1);
            const tbx_f4 g2 = tbx_edge4(e2, tbx_abs4(a2_yzx), h, h_yzx, s2);
            const tbx_f4 g = tbx_min4(tbx_min4(g1, g2), g0);
            const tbx_f4 value = g + TBX_JOIN(tbx_abs4(n), sums, 1);
            const tbx_f4 x = e0 + e2; /* from X to 2X */
            const tbx_f4 x_yzx = tbx_yzx(x);
            const tbx_f4 area = x * x_yzx;
            const tbx_f4 volume = area * tbx_yzx(x_yzx);
            const tbx_f4 bound = tbx_splat(TBX_ULPS * TBX_U32) * TBX_JOIN(area, volume, 0);
            /* lane 3 of `tiny` is seen as too small unless this processor reads or writes subnormals as
             * zero */
            const int refused = tbx_signs(tbx_below(x + (tbx_f4)tiny_bits, 0x30800000));
            /* h < 0: a face parts them, or min > max */
            const int miss = tbx_signs((tbx_i4)(tbx_min4(h, value + bound) < zero)) != 0;
            const int at_face = rule ? tbx_signs((lo >= t_max) | (t_min >= hi) | (lo >= hi)) & 7 : 0;
            const int unsure = (tbx_signs((tbx_i4)(value - bound)) | at_face) != 0;
            const int open = unsure & !miss;
            /* one branch, hardly ever taken: miss alone is a coin toss */
            if (TBX_RARELY((refused != 8) | open)) {
                int found = TBX_UNSURE;
                if ((refused & 7) != 0 || (open && at_face != 0)) {
                    return TBX_UNSURE;
                }
                found = open != 0 ? found : !miss;
                return tbx_filter4_rare(v0, v1, v2, box_min, box_max, found);
            }
            return !miss;
        }
    }
}

/* The same filter in double. What each axis does alone: x and y in two lanes, then z and 0. The planes:
 * edges 0 and 2 in two lanes, edge 1 in both. */
#if defined(__clang__)
#define TBX_PAIR(a, b, i, j) __builtin_shufflevector(a, b, i, j)
#else
TBX_FN tbx_l2 tbx_order2(int64_t i, int64_t j)
{
    const tbx_l2 r = { i, j };
    return r;
}
#define TBX_PAIR(a, b, i, j) __builtin_shuffle(a, b, tbx_order2(i, j))
#endif

TBX_FN tbx_d2 tbx_pair(double x, double y)
{
    const tbx_d2 r = { x, y };
    return r;
}

TBX_FN tbx_d2 tbx_load2(const void *v)
{
    tbx_d2 r;
    TBX_COPY(&r, v, sizeof r);
    return r;
}

/* A double, and 0. */
TBX_FN tbx_d2 tbx_load1(const void *v)
{
    tbx_l2 r = { 0, 0 };
    int64_t bits;
    TBX_COPY(&bits, v, sizeof bits);
    r[0] = bits;
    return (tbx_d2)r;
}

TBX_FN tbx_l2 tbx_splat_long(int64_t x)
{
    const tbx_l2 r = { x, x };
    return r;
}

TBX_FN tbx_d2 tbx_swap(tbx_d2 a)
{
    return TBX_PAIR(a, a, 1, 0);
}

TBX_FN tbx_d2 tbx_abs2(tbx_d2 a)
{
    return (tbx_d2)((tbx_l2)a & tbx_splat_long((int64_t)0x7fffffffffffffffu));
}

#if defined(__SSE2__)
TBX_FN tbx_d2 tbx_min2(tbx_d2 a, tbx_d2 b)
{
    return __builtin_ia32_minpd(a, b);
}

TBX_FN tbx_d2 tbx_max2(tbx_d2 a, tbx_d2 b)
{
    return __builtin_ia32_maxpd(a, b);
}

TBX_FN int tbx_signs2(tbx_l2 mask)
{
    return __builtin_ia32_movmskpd((tbx_d2)mask);
}
#else
TBX_FN tbx_d2 tbx_min2(tbx_d2 a, tbx_d2 b)
{
    const tbx_l2 less = a < b;
    return (tbx_d2)(((tbx_l2)a & less) | ((tbx_l2)b & ~less));
}

TBX_FN tbx_d2 tbx_max2(tbx_d2 a, tbx_d2 b)
{
    const tbx_l2 more = a > b;
    return (tbx_d2)(((tbx_l2)a & more) | ((tbx_l2)b & ~more));
}

TBX_FN int tbx_signs2(tbx_l2 mask)
{
    return (mask[0] < 0) | (mask[1] < 0) << 1;
}
#endif

/* The upper 32 bits, and the lower ones, of two 64-bit lanes of a and two of b. */
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define TBX_HIGH_WORDS(a, b) TBX_LANES((tbx_i4)(a), (tbx_i4)(b), 0, 2, 4, 6)
#define TBX_LOW_WORDS(a, b) TBX_LANES((tbx_i4)(a), (tbx_i4)(b), 1, 3, 5, 7)
#else
#define TBX_HIGH_WORDS(a, b) TBX_LANES((tbx_i4)(a), (tbx_i4)(b), 1, 3, 5, 7)
#define TBX_LOW_WORDS(a, b) TBX_LANES((tbx_i4)(a), (tbx_i4)(b), 0, 2, 4, 6)
#endif

/* Two axes of the question; names as in tbx_filter4. */
typedef struct tbx_axes {
    tbx_d2 a1;
    tbx_d2 a2;
    tbx_d2 m;
    tbx_d2 h;
    tbx_d2 x;
    tbx_l2 refused; /* sign bits */
    tbx_l2 at_face;
} TBX_ALIGNED tbx_axes;

/* tiny: 0, or 2^-1074 in a lane without a coordinate: refused unless this processor reads or writes
 * subnormals as zero. */
TBX_FN void tbx_axes_set(tbx_axes *r, tbx_d2 p0, tbx_d2 p1, tbx_d2 p2, tbx_d2 lo, tbx_d2 hi, tbx_l2 tiny)
{
    const tbx_l2 least = tbx_splat_long((int64_t)(1023 - 300) << 52);
    const tbx_d2 two = { 2.0, 2.0 };
    {
        const tbx_d2 t_min = tbx_min2(tbx_min2(p0, p1), p2);
        const tbx_d2 t_max = tbx_max2(tbx_max2(p0, p1), p2);
        const tbx_d2 lower = tbx_max2(lo, t_min);
        const tbx_d2 upper = tbx_min2(hi, t_max);
        tbx_d2 a1 = p1 - p0;
        tbx_d2 a2 = p2 - p0;
        tbx_d2 l = lower - p0;
        tbx_d2 h = upper - lower;
        TBX_KEEP4(VECTOR, a1, a2, l, h);
        {
            const tbx_d2 x = tbx_abs2(a1) + tbx_abs2(a2);
            const tbx_l2 bits = (tbx_l2)(x + (tbx_d2)tiny);
            r->a1 = a1;
            r->a2 = a2;
            r->m = l * two + h;
            r->h = h;
            r->x = x;
            r->refused = (bits - least) & -bits;
            r->at_face = (tbx_l2)((lo >= t_max) | (t_min >= hi) | (lo >= hi));
        }
    }
}

/* One axis of a plane. */
typedef struct tbx_side {
    tbx_d2 a; /* a_1, a_2 */
    tbx_d2 a_swap;
    tbx_d2 e;  /* absolute edges 0 and 2 */
    tbx_d2 e1; /* twice the same, as all below */
    tbx_d2 m;
    tbx_d2 h;
    tbx_d2 x;
} TBX_ALIGNED tbx_side;

TBX_FN void tbx_side_set(tbx_side *r, tbx_d2 a, tbx_d2 m, tbx_d2 h, tbx_d2 x)
{
    r->a = a;
    r->a_swap = tbx_swap(a);
    r->e = tbx_abs2(a);
    r->e1 = tbx_abs2(a - r->a_swap);
    r->m = m;
    r->h = h;
    r->x = x;
}

/* The lesser values of edges 0 and 1, and of 2 and 1. out_n: the normal's component, and its negative. */
TBX_FN tbx_d2 tbx_edges2(const tbx_side *b, const tbx_side *c, tbx_d2 *out_n)
{
    const tbx_d2 product = b->a * c->a_swap;
    const tbx_d2 n = product - tbx_swap(product);
    const tbx_d2 line = b->a * c->m - c->a * b->m; /* c_0, -c_2 */
    const tbx_d2 s = n - line;                     /* s_0, -s_2 */
    const tbx_d2 s1 = line + tbx_swap(s);
    const tbx_d2 g = b->e * c->h + (c->e * b->h - tbx_abs2(s));
    const tbx_d2 g1 = b->e1 * c->h + (c->e1 * b->h - tbx_abs2(s1));
    *out_n = n;
    return tbx_min2(g, g1) + tbx_abs2(n);
}

/* The plane is unsure, of a box whose faces hold. */
TBX_COLD int tbx_filter2_flat(const double v0[3], const double v1[3], const double v2[3],
                              const double box_min[3], const double box_max[3])
{
    tbx_clip clip;
    int k;
    for (k = 0; k < 3; k++) {
        tbx_clip_axis(&clip, k, v0[k], v1[k], v2[k], box_min[k], box_max[k], 0);
    }
    return tbx_clipped_edge(v0, v1, v2, &clip);
}

/* The verdict of the double filter. rule as in tbx_filter4. Coordinates of 2^300 and more are refused. */
TBX_FN int tbx_filter2(const double v0[3], const double v1[3], const double v2[3], const double box_min[3],
                       const double box_max[3], int rule)
{
    const tbx_d2 zero = { 0.0, 0.0 };
    const tbx_l2 none = { 0, 0 };
    const tbx_l2 tiny = { 0, 1 }; /* 2^-1074 */
    const tbx_d2 ulps = tbx_pair(TBX_ULPS * TBX_U64, TBX_ULPS * TBX_U64);
    tbx_d2 p0 = tbx_load2(v0);
    tbx_d2 p1 = tbx_load2(v1);
    tbx_d2 p2 = tbx_load2(v2);
    tbx_d2 lo = tbx_load2(box_min);
    tbx_d2 hi = tbx_load2(box_max);
    tbx_d2 z0 = tbx_load1(v0 + 2);
    tbx_d2 z1 = tbx_load1(v1 + 2);
    tbx_d2 z2 = tbx_load1(v2 + 2);
    tbx_d2 z_lo = tbx_load1(box_min + 2);
    tbx_d2 z_hi = tbx_load1(box_max + 2);
    tbx_axes xy;
    tbx_axes z;
    tbx_side sx;
    tbx_side sy;
    tbx_side sz;
    tbx_d2 n_x;
    tbx_d2 n_y;
    tbx_d2 n_z;
    tbx_i4 greatest = tbx_greatest5(TBX_HIGH_WORDS(p0, p1), TBX_HIGH_WORDS(p2, lo), TBX_HIGH_WORDS(hi, z0),
                                    TBX_HIGH_WORDS(z1, z2), TBX_HIGH_WORDS(z_lo, z_hi));
    if (TBX_RARELY(tbx_any(tbx_splat_int(((1023 + 300) << 20) - 1) - greatest))) {
        return TBX_UNSURE;
    }
    TBX_KEEP4(VECTOR, p0, p1, p2, lo);
    TBX_KEEP3(VECTOR, hi, z0, z1);
    TBX_KEEP3(VECTOR, z2, z_lo, z_hi);
    tbx_axes_set(&xy, p0, p1, p2, lo, hi, none);
    tbx_axes_set(&z, z0, z1, z2, z_lo, z_hi, tiny);
    tbx_side_set(&sx, TBX_PAIR(xy.a1, xy.a2, 0, 2), TBX_PAIR(xy.m, xy.m, 0, 0), TBX_PAIR(xy.h, xy.h, 0, 0),
                 TBX_PAIR(xy.x, xy.x, 0, 0));
    tbx_side_set(&sy, TBX_PAIR(xy.a1, xy.a2, 1, 3), TBX_PAIR(xy.m, xy.m, 1, 1), TBX_PAIR(xy.h, xy.h, 1, 1),
                 TBX_PAIR(xy.x, xy.x, 1, 1));
    tbx_side_set(&sz, TBX_PAIR(z.a1, z.a2, 0, 2), TBX_PAIR(z.m, z.m, 0, 0), TBX_PAIR(z.h, z.h, 0, 0),
                 TBX_PAIR(z.x, z.x, 0, 0));
    {
        const tbx_d2 g_x = tbx_edges2(&sy, &sz, &n_x);
        const tbx_d2 g_y = tbx_edges2(&sz, &sx, &n_y);
        const tbx_d2 g_z = tbx_edges2(&sx, &sy, &n_z);
        const tbx_d2 support = tbx_abs2(n_x) * sx.h + tbx_abs2(n_y) * sy.h + tbx_abs2(n_z) * sz.h;
        const tbx_d2 plane = support - tbx_abs2(n_x * sx.m + n_y * sy.m + n_z * sz.m);
        const tbx_d2 area_x = sy.x * sz.x;
        const tbx_d2 area_y = sz.x * sx.x;
        const tbx_d2 area_z = sx.x * sy.x;
        const tbx_d2 volume = area_z * sz.x;
        const tbx_d2 edges_xy = tbx_min2(g_x + ulps * area_x, g_y + ulps * area_y);
        const tbx_d2 rest = tbx_min2(g_z + ulps * area_z, plane + ulps * volume);
        const tbx_l2 axes = (tbx_l2)(tbx_min2(edges_xy, rest) < zero);
        const tbx_l2 faces = (tbx_l2)(tbx_min2(xy.h, z.h) < zero);
        const tbx_l2 below = (tbx_l2)(g_x - ulps * area_x) | (tbx_l2)(g_y - ulps * area_y) |
                             (tbx_l2)(g_z - ulps * area_z) | (tbx_l2)(plane - ulps * volume);
        const int refused = tbx_signs2(z.refused) | tbx_signs2(xy.refused) << 2;
        const int miss = tbx_signs2(faces | axes) != 0;
        const int at_face = rule ? tbx_signs2(xy.at_face) | (tbx_signs2(z.at_face) & 1) : 0;
        const int unsure = (tbx_signs2(below) | at_face) != 0;
        const int open = unsure & !miss;
        if (TBX_RARELY((refused != 2) | open)) {
            if ((refused == 2) & !at_face & tbx_signs2((tbx_l2)(support <= ulps * volume))) {
                return tbx_filter2_flat(v0, v1, v2, box_min, box_max);
            }
            if (open || (refused & ~2) != 0 || !tbx_all_usual(v0, v1, v2, box_min, box_max)) {
                return TBX_UNSURE;
            }
        }
        return !miss;
    }
}

/* ---- 11.2 Prepared triangle */

/* x, y, z, z of p; one by one: p was often written just before. */
TBX_FN tbx_f4 tbx_load_xyzz(const float p[3])
{
    tbx_f4 x = { 0.0f, 0.0f, 0.0f, 0.0f };
    tbx_f4 y = x;
    tbx_f4 z = x;
    x[0] = p[0];
    y[0] = p[1];
    z[0] = p[2];
    TBX_KEEP_VECTOR(x); /* of two shuffles gcc would make three: 1.04x */
    return TBX_LANES(TBX_LANES(x, y, 0, 4, 1, 5), z, 0, 1, 4, 4);
}

/* tbx_key32 in lanes. */
TBX_FN tbx_i4 tbx_keys(tbx_f4 x)
{
    const tbx_i4 negative = (tbx_i4)x >> 31;
    return (tbx_magnitude(x) ^ negative) - negative;
}

/* Lanes whose sum wraps round. */
TBX_FN tbx_i4 tbx_wrapping_sum(tbx_i4 a, tbx_i4 b)
{
    return (tbx_i4)((tbx_u4)a + (tbx_u4)b);
}

TBX_FN void tbx_store4(void *out, tbx_f4 x)
{
    TBX_COPY(out, &x, sizeof x);
}

/* Lanes 0 and 1 as doubles, and lanes 2 and 3. */
TBX_FN void tbx_widen4(tbx_d2 *low, tbx_d2 *high, tbx_f4 x)
{
#if defined(__SSE2__) && defined(__clang__)
    *low = __builtin_convertvector(__builtin_shufflevector(x, x, 0, 1), tbx_d2);
    *high = __builtin_convertvector(__builtin_shufflevector(x, x, 2, 3), tbx_d2);
#elif defined(__SSE2__)
    *low = __builtin_ia32_cvtps2pd(x);
    *high = __builtin_ia32_cvtps2pd(TBX_LANES(x, x, 2, 3, 2, 3));
#else
    *low = tbx_pair((double)x[0], (double)x[1]);
    *high = tbx_pair((double)x[2], (double)x[3]);
#endif
}

/* Two doubles as floats, in lanes 0 and 1. */
TBX_FORCED tbx_f4 tbx_narrow(tbx_d2 x)
{
#if defined(__SSE2__)
    return (tbx_f4)__builtin_ia32_cvtpd2ps(x);
#else
    const tbx_f4 r = { (float)x[0], (float)x[1], 0.0f, 0.0f };
    return r;
#endif
}

/* Three lanes as doubles. */
TBX_FN void tbx_store3_wide(double *out, tbx_f4 x)
{
    tbx_d2 xy;
    tbx_d2 z;
    double last;
    tbx_widen4(&xy, &z, x);
    last = z[0];
    TBX_COPY(out, &xy, sizeof xy);
    TBX_COPY(out + 2, &last, sizeof last);
}

/* The keys of the least floats x for which x + size reaches t, or, if strict, exceeds it, in lanes. f = t -
 * size rounded is the answer, or the float before it. Less the larger of t and -size, f is a float, in every
 * rounding mode: what is missing to the other one is the difference's error, whose sign survives its
 * rounding. */
TBX_FN tbx_i4 tbx_least_keys(tbx_f4 t, tbx_f4 size, int strict)
{
    const tbx_i4 sign = tbx_splat_int(-2147483647 - 1);
    const tbx_f4 minus = (tbx_f4)((tbx_i4)size ^ sign);
    const tbx_i4 swap = tbx_abs4(t) < size;
    const tbx_f4 larger = (tbx_f4)(((tbx_i4)minus & swap) | ((tbx_i4)t & ~swap));
    const tbx_f4 smaller = (tbx_f4)(((tbx_i4)t & swap) | ((tbx_i4)minus & ~swap));
    tbx_f4 f = t - size;
    tbx_f4 part;
    TBX_KEEP_VECTOR(f);
    part = f - larger;
    TBX_KEEP_VECTOR(part);
    return tbx_keys(f) - (strict ? smaller >= part : smaller > part);
}

TBX_FN tbx_i4 tbx_select(tbx_i4 mask, tbx_i4 a, tbx_i4 b)
{
    return (a & mask) | (b & ~mask);
}

/* Lane 2 again in lane 3. */
TBX_FN tbx_i4 tbx_xyzz(tbx_i4 a)
{
    return (tbx_i4)TBX_LANES((tbx_f4)a, (tbx_f4)a, 0, 1, 2, 2);
}

/* tbx_store_faces in lanes. */
TBX_FN void tbx_store_face_lanes(tribox_tri *tri, tbx_i4 least, tbx_i4 most)
{
    const tbx_i4 zero = tbx_splat_int(-2147483647 - 1);
    const tbx_i4 none = least > most;
    const tbx_i4 is_below = most >> 31;
    const tbx_i4 is_above = least > 0;
    const tbx_i4 shift = tbx_select(is_below, most, tbx_wrapping_sum(zero, -(least & is_above)));
    const tbx_i4 span = tbx_wrapping_sum(is_above - least, (tbx_wrapping_sum(most, zero)) & is_below);
    tbx_store4(tri->hidden.most, (tbx_f4)tbx_xyzz(tbx_select(none, zero, most | is_below)));
    tbx_store4(tri->hidden.shift, (tbx_f4)tbx_xyzz(tbx_select(none, tbx_splat_int(1), shift)));
    tbx_store4(tri->hidden.span, (tbx_f4)tbx_xyzz(tbx_select(none, zero, span)));
}

/* Lanes whose faces do not hold, as none do where p is NaN or infinite. */
TBX_FN tbx_i4 tbx_parted(const tribox_tri *tri, tbx_i4 bits)
{
    const tbx_i4 moved = tbx_wrapping_sum(bits, tbx_load4i(tri->hidden.shift));
    return (bits > tbx_load4i(tri->hidden.most)) | (moved > tbx_load4i(tri->hidden.span));
}

/* support(w) for w in lanes b and c, and z in lane 3 of z. */
TBX_FN tbx_f4 tbx_support(tbx_f4 b, tbx_f4 c, tbx_f4 z, tbx_f4 size, int thin)
{
    const tbx_f4 zero = { 0.0f, 0.0f, 0.0f, 0.0f };
    const tbx_f4 size_b = TBX_LANES(size, size, 1, 2, 0, 0);
    const tbx_f4 size_c = TBX_LANES(size, size, 2, 0, 1, 1);
    const tbx_f4 size_z = TBX_LANES(size, size, 2, 2, 2, 2);
    if (thin) {
        const tbx_f4 at_b = b * size_b;
        const tbx_f4 at_c = c * size_c;
        const tbx_f4 at_z = z * size_z;
        const tbx_f4 largest = tbx_max4(tbx_max4(tbx_abs4(at_b), tbx_abs4(at_c)), tbx_abs4(at_z));
        return (at_b + at_c + at_z + largest) * tbx_splat(0.5f);
    }
    return tbx_max4(b, zero) * size_b + tbx_max4(c, zero) * size_c + tbx_max4(z, zero) * size_z;
}

/* The edges of a triangle in lanes. */
typedef struct tbx_edge_lanes {
    tbx_f4 e[3]; /* x, y, z, 0 */
    tbx_f4 extent;
    tbx_f4 reach;
    tbx_f4 size;
} TBX_ALIGNED tbx_edge_lanes;

/* 1, and 3 for edges along an axis. */
TBX_FN tbx_f4 tbx_one_or_three(tbx_i4 is_along_axis)
{
    const tbx_f4 one = tbx_splat(1.0f);
    return one + (tbx_f4)((tbx_i4)tbx_splat(2.0f) & is_along_axis);
}

/* Writes the conditions. Returns 0, having written nothing, if the sign of the normal is unsure. */
TBX_FN int tbx_store_conditions(tribox_tri *tri, const tbx_edge_lanes *s, int thin)
{
    const tbx_f4 zero = { 0.0f, 0.0f, 0.0f, 0.0f };
    const tbx_i4 sign = tbx_splat_int(-2147483647 - 1);
    const tbx_f4 e0_b = tbx_yzx(s->e[0]);
    const tbx_f4 e1_b = tbx_yzx(s->e[1]);
    const tbx_f4 e2_b = tbx_yzx(s->e[2]);
    const tbx_f4 e0_c = tbx_yzx(e0_b);
    const tbx_f4 e1_c = tbx_yzx(e1_b);
    const tbx_f4 e2_c = tbx_yzx(e2_b);
    const tbx_f4 extent_b = tbx_yzx(s->extent);
    const tbx_f4 extent_c = tbx_yzx(extent_b);
    const tbx_f4 reach_b = tbx_yzx(s->reach);
    const tbx_f4 reach_c = tbx_yzx(reach_b);
    const tbx_f4 area = extent_b * extent_c;
    const tbx_f4 n = e0_b * e1_c - e0_c * e1_b;
    const tbx_i4 zero_0b = e0_b == zero;
    const tbx_i4 zero_0c = e0_c == zero;
    const tbx_i4 zero_1b = e1_b == zero;
    const tbx_i4 zero_1c = e1_c == zero;
    const tbx_i4 n_is_zero = (zero_0b | zero_1c) & (zero_0c | zero_1b);
    const tbx_i4 unsure = (tbx_abs4(n) <= area * tbx_splat(TBX_NORMAL_ULPS * TBX_U32)) & ~n_is_zero;
    if (TBX_RARELY(tbx_any(unsure))) {
        return 0;
    }
    {
        const tbx_i4 inward = (tbx_i4)n & sign;
        const tbx_i4 outward = inward ^ sign;
        const int is_flat = (tbx_signs(n_is_zero) & 7) != 0;
        const tbx_i4 flat = tbx_splat_int(is_flat ? -1 : 0);
        const tbx_f4 plane = (tbx_f4)((tbx_i4)n & ~flat);
        const tbx_f4 volumes = area * s->reach;
        const tbx_f4 volumes_b = tbx_yzx(volumes);
        const tbx_f4 volume = volumes + volumes_b + tbx_yzx(volumes_b);
        const tbx_f4 bound =
            TBX_JOIN(extent_b * reach_c + extent_c * reach_b, volume, 0) * tbx_splat(TBX_TRI_ULPS * TBX_U32);
        const tbx_f4 scale = (tbx_f4)(tbx_splat_int(253 << 23) - ((tbx_i4)bound & tbx_splat_int(0xff << 23)));
        const tbx_f4 n_z = TBX_JOIN(zero, plane, 2) * scale;
        const tbx_f4 b0 = TBX_JOIN((tbx_f4)((tbx_i4)e0_c ^ outward), plane, 0) * scale;
        const tbx_f4 c0 = TBX_JOIN((tbx_f4)((tbx_i4)e0_b ^ inward), plane, 1) * scale;
        const tbx_f4 b2 = (tbx_f4)((tbx_i4)e2_c ^ outward) * scale;
        const tbx_f4 c2 = (tbx_f4)((tbx_i4)e2_b ^ inward) * scale;
        /* in lane 3 all of edges 1 and 2 is 0, and so they are along an axis */
        const tbx_f4 inside = TBX_JOIN(tbx_abs4(n), zero, 0) * scale;
        const tbx_f4 d0 = tbx_support(b0, c0, n_z, s->size, thin) +
                          tbx_one_or_three((tbx_i4)TBX_JOIN((tbx_f4)(zero_0b | zero_0c), (tbx_f4)flat, 0));
        const tbx_f4 d2 =
            tbx_support(b2, c2, zero, s->size, thin) + tbx_one_or_three((e2_b == zero) | (e2_c == zero));
        const tbx_f4 d1 = tbx_support(-(b0 + b2), -(c0 + c2), -n_z, s->size, thin) + inside +
                          tbx_one_or_three((tbx_i4)TBX_JOIN((tbx_f4)(zero_1b | zero_1c), (tbx_f4)flat, 0));
        tbx_store4(tri->n_e_b[0], b0);
        tbx_store4(tri->n_e_b[1], b2);
        tbx_store4(tri->n_e_c[0], c0);
        tbx_store4(tri->n_e_c[1], c2);
        tbx_store4(tri->n_z, n_z);
        tbx_store4(tri->d_e[0], d0);
        tbx_store4(tri->d_e[1], d2);
        tbx_store4(tri->d_e[2], d0 + d2 + d1);
        return 1;
    }
}

/* tribox_tri_init in lanes. Returns 0 where it is not for these: what is empty, infinite, beyond the bounds'
 * range, may be read as zero, or whose normal has an unsure sign. */
TBX_FN int tbx_tri_init_simd(tribox_tri *tri, const float v0[3], const float v1[3], const float v2[3],
                             const float size[3], unsigned flags)
{
    const int32_t most = 0x53800000;                                  /* 2^40 */
    const tbx_f4 tiny = { 0.0f, 0.0f, 0.0f, 1.401298464324817e-45f }; /* 2^-149 */
    const int thin = (flags & TRIBOX_THIN) != 0;
    const unsigned rule = thin ? (unsigned)TRIBOX_THIN : tbx_rule(flags);
    const int lo_is_open = tbx_lo_is_open(rule);
    const int hi_is_open = tbx_hi_is_open(rule);
    tbx_f4 p0 = tbx_load3(v0);
    tbx_f4 p1 = tbx_load3(v1);
    tbx_f4 p2 = tbx_load3(v2);
    tbx_i4 sizes = (tbx_i4)tbx_load3(size);
    /* sizes of -0 wrap, as unsigned */
    const tbx_i4 far_off = tbx_above(tbx_abs4(p0), most) | tbx_above(tbx_abs4(p1), most) |
                           tbx_above(tbx_abs4(p2), most) | tbx_above((tbx_f4)sizes, most) |
                           (tbx_i4)((tbx_u4)sizes - (tbx_u4)tbx_splat_int(hi_is_open));
    if (TBX_RARELY((tbx_signs(far_off | sizes) & 7) != 0)) {
        return 0;
    }
    TBX_KEEP4(VECTOR, p0, p1, p2, sizes);
    {
        const tbx_f4 t_min = tbx_min4(tbx_min4(p0, p1), p2);
        const tbx_f4 t_max = tbx_max4(tbx_max4(p0, p1), p2);
        tbx_edge_lanes s;
        int refused;
        s.size = (tbx_f4)sizes;
        s.e[0] = p1 - p0;
        s.e[1] = p2 - p1;
        s.e[2] = p0 - p2;
        s.extent = t_max - t_min;
        TBX_KEEP4(VECTOR, s.e[0], s.e[1], s.e[2], s.extent);
        s.reach = tbx_max4(s.extent + s.size, tbx_splat(9.313225746154785e-10f)); /* 2^-30 */
        /* lane 3 of `tiny` is seen as too small unless this processor reads or writes subnormals as zero */
        refused = tbx_signs(tbx_above(s.reach, most) | tbx_below(s.extent + tiny, 0x30800000));
        if (TBX_RARELY(refused != 8)) {
            if ((refused & 7) != 0 || tbx_may_flush(v0) || tbx_may_flush(v1) || tbx_may_flush(v2) ||
                tbx_may_flush(size)) {
                return 0;
            }
        }
        if (TBX_RARELY(!tbx_store_conditions(tri, &s, thin))) {
            return 0;
        }
        tbx_store_face_lanes(tri, tbx_least_keys(t_min, s.size, hi_is_open),
                             tbx_keys(t_max) - tbx_splat_int(lo_is_open));
        tbx_store4(tri->ref, TBX_LANES(p0, p0, 0, 1, 2, 2));
        tbx_store4(tri->hidden.step, TBX_LANES(s.size, s.size, 0, 1, 2, 2));
        tbx_store3_wide(tri->v[0], p0);
        tbx_store3_wide(tri->v[1], p1);
        tbx_store3_wide(tri->v[2], p2);
        tbx_store3_wide(tri->size, s.size);
        tbx_store3_wide(tri->t_min, t_min);
        tbx_store3_wide(tri->t_max, t_max);
        tri->flags = rule;
        tri->empty = 0;
        tri->hidden.flags = flags;
        tri->hidden.in_range = 2;
        return 1;
    }
}

/* The doubles as floats, if they are, and of no unusual size. */
TBX_FN int tbx_tri_narrow(float out[4][3], const double v[3][3], const double size[3])
{
    const double(*corners)[3] = v;
    const double *extents = size;
    int fits = 1;
    int i;
    for (i = 0; i < 12; i++) {
        const double *x = i < 9 ? &corners[i / 3][i % 3] : &extents[i - 9];
        fits &= tbx_in_range(x, -100, 100) & ((tbx_bits64(x) & 0x1fffffffu) == 0);
    }
    if (!fits) {
        return 0;
    }
    TBX_KEEP_POINTER(corners); /* not converted before: overflow */
    TBX_KEEP_POINTER(extents);
    for (i = 0; i < 12; i++) {
        out[i / 3][i % 3] = (float)(i < 9 ? corners[i / 3][i % 3] : extents[i - 9]);
    }
    return 1;
}

/* Is a magnitude of p, of which x has the lanes, 2^42 or more, where a product might overflow, or NaN? By the
 * bits of x and y in one integer, and those of z, beside what the vectors do. */
TBX_FN int tbx_is_far_off(tbx_f4 x, const float p[3])
{
    const uint64_t xy = (uint64_t)((tbx_l2)x)[0] & 0x7fffffff7fffffffu;
    const uint64_t z = tbx_bits32(&p[2]) & 0x7fffffffu;
    return (((xy + 0x2b8000002b800000u) | (z + 0x2b800000u)) & 0x8000000080000000u) != 0;
}

/* What the test reads of a triangle: n_e_b, n_e_c and d_e of edges 0, 2, 1. */
typedef struct tbx_conditions {
    tbx_f4 n_z;
    tbx_f4 b0;
    tbx_f4 b2;
    tbx_f4 c0;
    tbx_f4 c2;
    tbx_f4 d0;
    tbx_f4 d2;
    tbx_f4 d1;
} TBX_ALIGNED tbx_conditions;

TBX_FN void tbx_conditions_read(tbx_conditions *t, const tribox_tri *tri)
{
    t->n_z = tbx_load4(tri->n_z);
    t->b0 = tbx_load4(tri->n_e_b[0]);
    t->b2 = tbx_load4(tri->n_e_b[1]);
    t->c0 = tbx_load4(tri->n_e_c[0]);
    t->c2 = tbx_load4(tri->n_e_c[1]);
    t->d0 = tbx_load4(tri->d_e[0]);
    t->d2 = tbx_load4(tri->d_e[1]);
    t->d1 = tbx_load4(tri->d_e[2]);
}

/* The test in lanes: HIT, MISS or UNSURE. gcc would go by mask registers for AVX-512; kept in vectors, the
 * test gains 1.04x. It keeps a triangle in registers through a loop only if that is read before any branch:
 * 1.13x; clang never does, and loses 1.03x by it. */
TBX_FN int tbx_tri_test_simd(const tribox_tri *tri, const float p[3])
{
    const tbx_f4 ref = tbx_load4(tri->ref);
    tbx_conditions t;
    tbx_f4 x = tbx_load_xyzz(p);
    tbx_i4 parted = tbx_parted(tri, (tbx_i4)x);
    tbx_f4 q;
    TBX_KEEP_VECTOR(parted);
#if !defined(__clang__)
    tbx_conditions_read(&t, tri);
#endif
    if (TBX_RARELY(tbx_is_far_off(x, p))) {
        return TBX_UNSURE;
    }
    TBX_KEEP_VECTOR(x);
    q = x - ref;
    TBX_KEEP_VECTOR(q);
#if defined(__clang__)
    tbx_conditions_read(&t, tri);
#endif
    {
        const tbx_f4 q_b = TBX_LANES(q, q, 1, 2, 0, 0);
        const tbx_f4 q_c = TBX_LANES(q, q, 2, 0, 1, 1);
        const tbx_f4 value0 = tbx_fma4(t.b0, q_b, tbx_fma4(t.c0, q_c, tbx_fma4(t.n_z, q, t.d0)));
        const tbx_f4 value2 = tbx_fma4(t.b2, q_b, tbx_fma4(t.c2, q_c, t.d2));
        const tbx_f4 least = tbx_min4(tbx_min4(value0, value2), t.d1 - (value0 + value2));
        /* a condition or face that fails, by their sign bits; conditions that are sure: from 2 on floats have
         * bit 30 */
        const int miss = tbx_signs((tbx_i4)least | parted);
        const int sure = tbx_signs((tbx_i4)least << 1);
        const unsigned verdict = (unsigned)((miss << 4) + 14 - sure); /* a hit wraps round */
        if (TBX_RARELY(verdict < 15u)) {                              /* no miss, but one is not sure */
            return TBX_UNSURE;
        }
        return (int)(verdict >> 31);
    }
}

#ifndef TRIBOX_NO_COMPANIONS
/* Lane k of four numbers, in all lanes. */
#if defined(__AVX__)
#define TBX_EACH(v, k) tbx_splat((v)[k])
#else
#define TBX_EACH(v, k) \
    (tbx_f4) TBX_LANES(tbx_load4i((const int32_t *)(v)), tbx_load4i((const int32_t *)(v)), k, k, k, k)
#endif

/* Condition i of lane k at q_b = b, q_c = c. */
#define TBX_VALUE(i, k, b, c) \
    tbx_fma4(TBX_EACH(tri->n_e_b[i], k), b, tbx_fma4(TBX_EACH(tri->n_e_c[i], k), c, TBX_EACH(tri->d_e[i], k)))

/* The least of the three edge conditions of lane k. */
#define TBX_EDGES(k, b, c) \
    tbx_least_edge(TBX_VALUE(0, k, b, c), TBX_VALUE(1, k, b, c), TBX_EACH(tri->d_e[2], k))

TBX_FN tbx_f4 tbx_least_edge(tbx_f4 first, tbx_f4 second, tbx_f4 sum)
{
    return tbx_min4(tbx_min4(first, second), sum - (first + second));
}

/* The conditions in float at the eight octants ref + q, q being lower or upper on each axis: bits of those
 * where all hold, and of those where that is unsure. Edges see two axes: in lanes at the four pairs of their
 * lower and upper, for both halves of the third. */
TBX_FN unsigned tbx_octant_lanes(const tribox_tri *tri, tbx_f4 lower, tbx_f4 upper, unsigned *out_unsure)
{
    const tbx_f4 both = TBX_LANES(lower, upper, 0, 4, 1, 5);
    const tbx_f4 both_z = TBX_LANES(lower, upper, 2, 6, 2, 6);
    const tbx_f4 x = TBX_LANES(both, both, 0, 1, 0, 1);
    const tbx_f4 y = TBX_LANES(both, both, 2, 2, 3, 3);
    const tbx_f4 z = TBX_LANES(both_z, both_z, 0, 0, 1, 1);
    const tbx_f4 yz = TBX_EDGES(0, TBX_LANES(both, both, 2, 3, 2, 3), z);
    const tbx_f4 zx = TBX_EDGES(1, z, x);
    const tbx_f4 xy = TBX_EDGES(2, x, y);
    const tbx_f4 n_z = tbx_splat(tri->n_z[3]);
    const tbx_f4 plane = TBX_VALUE(0, 3, x, y);
    const tbx_f4 below = tbx_fma4(n_z, TBX_LANES(lower, lower, 2, 2, 2, 2), plane);
    const tbx_f4 above = tbx_fma4(n_z, TBX_LANES(upper, upper, 2, 2, 2, 2), plane);
    const tbx_f4 sides = tbx_splat(tri->d_e[2][3] - tri->d_e[1][3]);
    const tbx_f4 least_below =
        tbx_min4(tbx_min4(tbx_min4(xy, TBX_LANES(yz, yz, 0, 0, 1, 1)), TBX_LANES(zx, zx, 0, 1, 0, 1)),
                 tbx_min4(below, sides - below));
    const tbx_f4 least_above =
        tbx_min4(tbx_min4(tbx_min4(xy, TBX_LANES(yz, yz, 2, 2, 3, 3)), TBX_LANES(zx, zx, 2, 3, 2, 3)),
                 tbx_min4(above, sides - above));
    /* by their sign bits, as tribox_tri_test */
    const int miss = tbx_signs((tbx_i4)least_below) | tbx_signs((tbx_i4)least_above) << 4;
    const int sure = tbx_signs((tbx_i4)least_below << 1) | tbx_signs((tbx_i4)least_above << 1) << 4;
    *out_unsure = (unsigned)~(sure | miss);
    return (unsigned)(sure & ~miss);
}

/* tbx_octant_values in lanes. */
TBX_FN unsigned tbx_octant_values_simd(const tribox_tri *tri, const float lower[3], const float upper[3],
                                       unsigned asked, unsigned *out_unsure)
{
    const unsigned hits = tbx_octant_lanes(tri, tbx_load3(lower), tbx_load3(upper), out_unsure);
    *out_unsure &= asked;
    return hits & asked;
}

/* The octants in the lower, or the upper, halves of axes that bits 0..2 name. */
TBX_FN unsigned tbx_lower_halves(unsigned axes)
{
    return (unsigned)(0x7f3f5f0f77335500u >> (axes << 3)) & 0xffu;
}

TBX_FN unsigned tbx_upper_halves(unsigned axes)
{
    return (unsigned)(0xfefcfaf0eeccaa00u >> (axes << 3)) & 0xffu;
}

/* tribox_tri_octants in lanes; OCTANTS_UNSURE where some octant cannot be decided. Rounding is monotone:
 * where p + size is no float, its rounded sum tells that of the faces unless it is next to where they begin
 * or cease to hold. */
TBX_FN unsigned tbx_octants_simd(const tribox_tri *tri, const float p[3])
{
    tbx_f4 x = tbx_load_xyzz(p);
    const tbx_f4 step = tbx_load4(tri->hidden.step);
    tbx_f4 lower;
    tbx_f4 upper;
    tbx_f4 sum;
    tbx_f4 without_x;
    tbx_f4 without_step;
    if (TBX_RARELY(tbx_is_far_off(x, p) | (tri->hidden.in_range != 2))) {
        return TBX_OCTANTS_UNSURE;
    }
    TBX_KEEP_VECTOR(x);
    lower = x - tbx_load4(tri->ref);
    sum = x + step;
    TBX_KEEP2(VECTOR, lower, sum);
    upper = lower + step;
    without_x = sum - x;
    without_step = sum - step;
    TBX_KEEP3(VECTOR, upper, without_x, without_step);
    {
        const tbx_i4 out = tbx_parted(tri, (tbx_i4)x);
        const tbx_i4 out_up = tbx_parted(tri, (tbx_i4)sum);
        const tbx_i4 is_close =
            (tbx_parted(tri, (tbx_i4)sum - 1) ^ out_up) | (tbx_parted(tri, (tbx_i4)sum + 1) ^ out_up);
        const tbx_i4 is_exact = ((tbx_i4)without_x == (tbx_i4)step) & ((tbx_i4)without_step == (tbx_i4)x);
        const tbx_i4 unsure = is_close & ~is_exact;
        const unsigned asked = ~(tbx_lower_halves((unsigned)tbx_signs(out) & 7u) |
                                 tbx_upper_halves((unsigned)tbx_signs(out_up) & 7u)) &
                               0xffu;
        unsigned unsure_octants;
        const unsigned hits = tbx_octant_lanes(tri, lower, upper, &unsure_octants);
        if (TBX_RARELY(((unsure_octants & asked) | (unsigned)tbx_signs(unsure)) != 0)) {
            return TBX_OCTANTS_UNSURE;
        }
        return hits & asked;
    }
}
#endif

/* ---- 11.3 Fill */

/* ---- Meshes, many triangles at once -----------------------------------------------------------------------
 *
 * Most triangles of a mesh touch few voxels. Their index boxes are found several at a time. A box whose
 * voxels are all set is done; one that is longer than one voxel on one axis at most is set whole; boxes of up
 * to 2^3, 3^3 and 4^3 voxels wait in groups and are decided together, all others of up to 64^3 in groups,
 * too, row by row. Each way computes in float or double with proven bounds; a triangle that comes within
 * them, or some of its rows, goes to the next way, the last two being double and the row walk. Where all
 * values are beyond their bounds nothing touches by a hair, so that every rule gives the same voxels.
 *
 * u = 2^-23 bounds a relative rounding error in every mode. Coordinates below are voxels. */
#if defined(__AVX2__)
#define TBX_WIDE 8
#define TBX_ALL(x) \
    { \
        x, x, x, x, x, x, x, x \
    }
#else
#define TBX_WIDE 4
#define TBX_ALL(x) \
    { \
        x, x, x, x \
    }
#endif
#define TBX_SIGN_BIT (-2147483647 - 1)
#define TBX_MOST_INDEX 268435456.0f /* 2^28: what follows fits integers */

typedef float tbx_fw __attribute__((vector_size(4 * TBX_WIDE), aligned(16)));
typedef int32_t tbx_iw __attribute__((vector_size(4 * TBX_WIDE), aligned(16)));
typedef uint32_t tbx_uw __attribute__((vector_size(4 * TBX_WIDE), aligned(16)));

typedef double tbx_dw __attribute__((vector_size(8 * TBX_WIDE), aligned(16)));

TBX_FORCED tbx_fw tbx_wide_all(float x)
{
    const tbx_fw r = TBX_ALL(x);
    return r;
}

TBX_FORCED tbx_iw tbx_wide_int(int32_t x)
{
    const tbx_iw r = TBX_ALL(x);
    return r;
}

#if defined(__AVX2__)
TBX_FORCED tbx_fw tbx_wide_min(tbx_fw a, tbx_fw b)
{
    return __builtin_ia32_minps256(a, b);
}

TBX_FORCED tbx_fw tbx_wide_max(tbx_fw a, tbx_fw b)
{
    return __builtin_ia32_maxps256(a, b);
}
#else
TBX_FORCED tbx_fw tbx_wide_min(tbx_fw a, tbx_fw b)
{
    return (tbx_fw)tbx_min4((tbx_f4)a, (tbx_f4)b);
}

TBX_FORCED tbx_fw tbx_wide_max(tbx_fw a, tbx_fw b)
{
    return (tbx_fw)tbx_max4((tbx_f4)a, (tbx_f4)b);
}
#endif

TBX_FORCED tbx_fw tbx_wide_abs(tbx_fw a)
{
    return (tbx_fw)((tbx_iw)a & tbx_wide_int(0x7fffffff));
}

/* All bits of a lane: its sign. */
TBX_FORCED tbx_iw tbx_wide_sign(tbx_fw a)
{
    return (tbx_iw)a < tbx_wide_int(0);
}

TBX_FORCED tbx_fw tbx_wide_flip(tbx_fw a, tbx_iw sign)
{
    return (tbx_fw)((tbx_iw)a ^ sign);
}

TBX_FORCED tbx_iw tbx_wide_up(tbx_iw a, int bits)
{
    return a << tbx_wide_int(bits);
}

/* Lanes of a where mask, of b elsewhere; lanes of a where mask, 0 elsewhere. */
TBX_FORCED tbx_iw tbx_wide_select(tbx_iw mask, tbx_iw a, tbx_iw b)
{
    return (mask & a) | (~mask & b);
}

TBX_FORCED tbx_fw tbx_wide_choose(tbx_iw mask, tbx_fw a, tbx_fw b)
{
    return (tbx_fw)tbx_wide_select(mask, (tbx_iw)a, (tbx_iw)b);
}

/* 1/x in lanes `has`, else 1. The divisor is chosen first: clang would divide by x in every lane, and raise
 * divide-by-zero, and choose a quotient. */
TBX_FORCED tbx_fw tbx_wide_inverse(tbx_iw has, tbx_fw x)
{
    tbx_fw divisor = tbx_wide_choose(has, x, tbx_wide_all(1.0f));
    TBX_KEEP_VECTOR(divisor);
    return tbx_wide_all(1.0f) / divisor;
}

TBX_FORCED tbx_fw tbx_wide_where(tbx_iw mask, tbx_fw a)
{
    return (tbx_fw)(mask & (tbx_iw)a);
}

/* One vector x, y, z for each of WIDE points. */
typedef struct tbx_points {
    tbx_fw x;
    tbx_fw y;
    tbx_fw z;
} TBX_ALIGNED tbx_points;

/* A wide vector of parts of four lanes, and its part i: through memory gcc would write twice and read once,
 * which stalls. */
TBX_FORCED tbx_fw tbx_wide_of(const tbx_f4 part[TBX_WIDE / 4])
{
#if TBX_WIDE == 4
    return (tbx_fw)part[0];
#elif defined(__clang__)
    return __builtin_shufflevector(part[0], part[1], 0, 1, 2, 3, 4, 5, 6, 7);
#else
    return __builtin_ia32_vinsertf128_ps256(__builtin_ia32_ps256_ps(part[0]), part[1], 1);
#endif
}

TBX_FORCED void tbx_wide_parts(tbx_f4 out_part[TBX_WIDE / 4], tbx_fw a)
{
#if TBX_WIDE == 4
    out_part[0] = (tbx_f4)a;
#elif defined(__clang__)
    out_part[0] = __builtin_shufflevector(a, a, 0, 1, 2, 3);
    out_part[1] = __builtin_shufflevector(a, a, 4, 5, 6, 7);
#else
    out_part[0] = __builtin_ia32_vextractf128_ps256(a, 0);
    out_part[1] = __builtin_ia32_vextractf128_ps256(a, 1);
#endif
}

/* The sign bits of the lanes. */
TBX_FORCED unsigned tbx_wide_signs(tbx_iw mask)
{
    tbx_f4 part[TBX_WIDE / 4];
    tbx_wide_parts(part, (tbx_fw)mask);
#if TBX_WIDE == 4
    return (unsigned)tbx_signs((tbx_i4)part[0]);
#else
    return (unsigned)tbx_signs((tbx_i4)part[0]) | (unsigned)tbx_signs((tbx_i4)part[1]) << 4;
#endif
}

TBX_FORCED int tbx_wide_any(tbx_iw mask)
{
    tbx_f4 part[TBX_WIDE / 4];
    tbx_wide_parts(part, (tbx_fw)mask);
#if TBX_WIDE == 4
    return tbx_any((tbx_i4)part[0]);
#else
    return tbx_any((tbx_i4)part[0] | (tbx_i4)part[1]);
#endif
}

/* Lanes 0..2 of v as points, lane 3 as `last`, and back. */
TBX_FORCED void tbx_points_from(tbx_points *out, tbx_iw *out_last, const tbx_i4 *v)
{
    tbx_f4 x[TBX_WIDE / 4];
    tbx_f4 y[TBX_WIDE / 4];
    tbx_f4 z[TBX_WIDE / 4];
    tbx_f4 w[TBX_WIDE / 4];
    int i;
    for (i = 0; i < TBX_WIDE / 4; i++, v += 4) {
        const tbx_f4 v0 = (tbx_f4)v[0];
        const tbx_f4 v1 = (tbx_f4)v[1];
        const tbx_f4 v2 = (tbx_f4)v[2];
        const tbx_f4 v3 = (tbx_f4)v[3];
        const tbx_f4 a = TBX_LANES(v0, v1, 0, 4, 1, 5);
        const tbx_f4 b = TBX_LANES(v2, v3, 0, 4, 1, 5);
        const tbx_f4 c = TBX_LANES(v0, v1, 2, 6, 3, 7);
        const tbx_f4 d = TBX_LANES(v2, v3, 2, 6, 3, 7);
        x[i] = TBX_LANES(a, b, 0, 1, 4, 5);
        y[i] = TBX_LANES(a, b, 2, 3, 6, 7);
        z[i] = TBX_LANES(c, d, 0, 1, 4, 5);
        w[i] = TBX_LANES(c, d, 2, 3, 6, 7);
    }
    out->x = tbx_wide_of(x);
    out->y = tbx_wide_of(y);
    out->z = tbx_wide_of(z);
    *out_last = (tbx_iw)tbx_wide_of(w);
}

TBX_FORCED void tbx_points_to(tbx_i4 *out, tbx_iw first, tbx_iw second, tbx_iw third, tbx_iw last)
{
    tbx_f4 x[TBX_WIDE / 4];
    tbx_f4 y[TBX_WIDE / 4];
    tbx_f4 z[TBX_WIDE / 4];
    tbx_f4 w[TBX_WIDE / 4];
    int i;
    tbx_wide_parts(x, (tbx_fw)first);
    tbx_wide_parts(y, (tbx_fw)second);
    tbx_wide_parts(z, (tbx_fw)third);
    tbx_wide_parts(w, (tbx_fw)last);
    for (i = 0; i < TBX_WIDE / 4; i++, out += 4) {
        const tbx_f4 a = TBX_LANES(x[i], y[i], 0, 4, 1, 5);
        const tbx_f4 b = TBX_LANES(z[i], w[i], 0, 4, 1, 5);
        const tbx_f4 c = TBX_LANES(x[i], y[i], 2, 6, 3, 7);
        const tbx_f4 d = TBX_LANES(z[i], w[i], 2, 6, 3, 7);
        out[0] = (tbx_i4)TBX_LANES(a, b, 0, 1, 4, 5);
        out[1] = (tbx_i4)TBX_LANES(a, b, 2, 3, 6, 7);
        out[2] = (tbx_i4)TBX_LANES(c, d, 0, 1, 4, 5);
        out[3] = (tbx_i4)TBX_LANES(c, d, 2, 3, 6, 7);
    }
}

TBX_FORCED tbx_f4 tbx_load_xy(const void *a, const void *b)
{
    tbx_d2 r;
    double pair;
    TBX_COPY(&pair, a, sizeof pair);
    r[0] = pair;
    TBX_COPY(&pair, b, sizeof pair);
    r[1] = pair;
    return (tbx_f4)r;
}

TBX_FORCED float tbx_load_z(const void *a)
{
    float r;
    TBX_COPY(&r, (const char *)a + 2 * sizeof r, sizeof r);
    return r;
}

TBX_FORCED void tbx_load_points(tbx_f4 *x, tbx_f4 *y, tbx_f4 *z, const void *a, const void *b, const void *c,
                                const void *d)
{
    const tbx_f4 ab = tbx_load_xy(a, b);
    const tbx_f4 cd = tbx_load_xy(c, d);
    const tbx_f4 third = { tbx_load_z(a), tbx_load_z(b), tbx_load_z(c), tbx_load_z(d) };
    *x = TBX_LANES(ab, cd, 0, 2, 4, 6);
    *y = TBX_LANES(ab, cd, 1, 3, 5, 7);
    *z = third;
}

/* Corner c of the WIDE triangles listed; of doubles that are floats, too. */
TBX_FORCED void tbx_load_corner(tbx_points *out, const tbx_source *s, int indexed, const size_t *list,
                                size_t c)
{
    const char *positions = s->positions;
    const uint32_t *indices = s->indices;
    const size_t stride = s->stride;
    float narrow[TBX_WIDE][3];
    const char *at[TBX_WIDE];
    tbx_f4 x[TBX_WIDE / 4];
    tbx_f4 y[TBX_WIDE / 4];
    tbx_f4 z[TBX_WIDE / 4];
    int i;
#define TBX_AT(i) (3 * list[i] + c)
#define TBX_POINT(i) (positions + stride * (indexed ? (size_t)indices[TBX_AT(i)] : TBX_AT(i)))
    for (i = 0; i < TBX_WIDE; i++) {
        at[i] = TBX_POINT(i);
    }
    for (i = 0; i < TBX_WIDE && s->is_double; i++) {
        double v[3];
        TBX_COPY(v, at[i], sizeof v);
        narrow[i][0] = (float)v[0];
        narrow[i][1] = (float)v[1];
        narrow[i][2] = (float)v[2];
        at[i] = (const char *)narrow[i];
    }
    for (i = 0; i < TBX_WIDE / 4; i++) {
        tbx_load_points(&x[i], &y[i], &z[i], at[4 * i], at[4 * i + 1], at[4 * i + 2], at[4 * i + 3]);
    }
#undef TBX_POINT
#undef TBX_AT
    out->x = tbx_wide_of(x);
    out->y = tbx_wide_of(y);
    out->z = tbx_wide_of(z);
}

TBX_FORCED void tbx_load_corners(tbx_points out[3], const tbx_source *s, const size_t *list)
{
    if (s->indices != NULL) {
        tbx_load_corner(&out[0], s, 1, list, 0);
        tbx_load_corner(&out[1], s, 1, list, 1);
        tbx_load_corner(&out[2], s, 1, list, 2);
    } else {
        tbx_load_corner(&out[0], s, 0, list, 0);
        tbx_load_corner(&out[1], s, 0, list, 1);
        tbx_load_corner(&out[2], s, 0, list, 2);
    }
}

/* ---- The fill's grid
 *
 * Index boxes come from fixed point: in steps of 2^-16 of a voxel the least and the greatest coordinate of a
 * triangle are whole numbers, index in the upper half, place within the voxel in the lower. With t = v -
 * centre, centre a float near the region's middle, y = t * steps is off by 3 u |y| (the difference, the
 * factor, the product), |y| <= (n / 2 + 2 + u |centre| / size) * 2^16 about the region, by truncation less
 * than 1, by the whole number added less than 1, and by what doubles add. All of this is `slack`. Coordinates
 * that lie within it of a grid plane, boxes not all in the region, and corners that are not finite or beyond
 * `far` take the careful way: X = v * inverse - origin / size, plus MARGIN: the product is off by 2 u |v| *
 * inverse, the constant by u |origin| / size, the sum by u |X|, where v lies within MARGIN of the region;
 * doubles add less than 1e-9, and the corners of doubles `rounded`, which is what they took to become floats.
 * Subnormals read as zero move X by less than 2^-126 * inverse, inverse <= 2^60. What that leaves unsure is
 * asked exactly.
 *
 * A grid plane i is high + low, where high = base_high + i * size_high is exact: both are multiples of
 * `spacing`, and with them every high is, below 2^24 of it. low = base_low + i * size_low, at most
 * rho = spacing * (n + 34) / size. (v - high - low) * inverse, v within m voxels, is then off by at most
 *   (m + rho) + 3 rho (low itself) + m + 2 m (the inverse, the product) = 4 (m + rho)
 * in units of u, and what doubles add: delta(m) = PLACED_ERROR m + delta_low. Corners of doubles are floats
 * from the centre on, t above, and so are the planes: that adds what rounding t took, u (n / 2 + 34 + u
 * |centre| / size).
 *
 * Meshes on grid planes touch voxels exactly, which no bound decides. But where all planes are whole numbers
 * of `spacing`, and the places between them that cut a voxel into PARTS, too, all these are floats, exactly;
 * so a corner is compared with the place next to it, and known exactly if it is there: on the lattice. What
 * decides about a voxel is then 0 or at least some step away from it, and half that step, added or taken off
 * as touching counts under the rule, leaves nothing near 0 and no sign wrong.
 *   closed, thin   Touching counts.
 *   HALF_OPEN      Closed boxes [i, i + 1 - e], e > 0 as small as you like: touching does not count where it
 *                  takes an upper face.
 *   OPEN           [i + e, i + 1 - e]: it never counts. */
#define TBX_STEPS 65536.0    /* of a voxel in fixed point */
#define TBX_STEPS_ULPS 3.0   /* of y, in units of u |y|: as above */
#define TBX_PLACED_ERROR (4.1f * TBX_U32)

typedef struct tbx_quick {
    double origin[3]; /* of the region */
    double units[3];  /* 1 / size */
    double delta;     /* of a coordinate in voxels, in double */
    int n[3];
    float centre[4];     /* fixed point; x, y, z in lanes 1, 2, 3, as wherever there are four */
    float subtrahend[4]; /* that, or 0 where it is taken off already */
    float steps[4];
    int32_t near_bits[4]; /* of the greatest magnitude that converts without care */
    int32_t far_bits[4];  /* of the greatest magnitude it is used for */
    int32_t bias[4];      /* of index 0, less the slack */
    int32_t limit[4];     /* what is above in either half is unsure, or outside */
    int32_t off_below[4]; /* from the centre: boxes that end below, */
    int32_t off_above[4]; /* or begin above, are off the region */
    float inverse[4];
    float shift_down[3]; /* MARGIN - origin, less and plus the bound */
    float shift_up[3];
    float base_high[4]; /* of the first inner plane of the box at index 0 */
    float base_low[4];
    float size_high[4];
    float size_low[4];
    float step[3];          /* of the lattice; 0: there is none on this axis */
    int32_t end[3];         /* the region's last voxel, MARGIN added */
    double whole_origin[3]; /* of the grid, as such and PIECES times, in two parts; so is the size */
    tbx_halves halves[3];
    int32_t lo[3];
    double box_origin[4]; /* of the region, in lanes 1 to 3; lane 0 lies on nothing */
    double box_units[4];
    double beside[4]; /* what is so near to a grid plane is unsure in fixed point */
    int precise;      /* all of these are in range */
    int is_double;
    float delta_low;
    size_t layer_words;
    int on; /* 0: this grid's numbers are out of range */
    int thin;
    int lattice;    /* some step is not 0 */
    int upper_open; /* touching a voxel's upper faces does not count */
    int lower_open;
    int fetch;      /* the bits exceed a small cache, 2: a large one */
    int short_axes; /* all below 2^15 voxels */
    uintptr_t bits;
    size_t row_words;
} tbx_quick;

#define TBX_MARGIN 16 /* voxels beyond the region in which X is still used */
#define TBX_PARTS_LOG2 4
#define TBX_PARTS (1 << TBX_PARTS_LOG2) /* of a voxel, in the lattice */

/* The step of the lattice on axis k, or 0 if there is none. Origins are compared by their bits, subnormals
 * being no 0. */
TBX_FN float tbx_lattice_step(const tribox_grid *grid, int k, double spacing)
{
    const double step = grid->size[k] * (1.0 / TBX_PARTS);
    const double origin = tbx_abs(grid->origin[k]);
    const double origin_down = tbx_floor_to(origin, spacing);
    const double most = spacing * 1125899906842624.0; /* 2^50 */
    int exact = tbx_bits64(&origin) == tbx_bits64(&origin_down);
    exact &= tbx_floor_to(step, spacing) >= step;
    exact &= origin < most;
    exact &= tbx_abs((double)grid->lo[k]) * step < most;
    return exact ? (float)step : 0.0f;
}

/* Classes of boxes. */
enum {
    TBX_CLASS_ONE, /* voxel; two along x; two along y or z */
    TBX_CLASS_RUN,
    TBX_CLASS_PAIR,
    TBX_CLASS_FLAT_X, /* two on two axes, one on this */
    TBX_CLASS_FLAT_Y,
    TBX_CLASS_FLAT_Z,
    TBX_CLASS_2, /* 2^3, up to 3^3, 4^3 */
    TBX_CLASS_3,
    TBX_CLASS_4,
    TBX_CLASS_ON_3, /* up to 3^3, 4^3, with some axis on the lattice */
    TBX_CLASS_ON_4,
    TBX_CLASS_LARGE,
    TBX_CLASS_AGAIN, /* up to FEW^3, with a corner beside a grid plane */
    TBX_CLASS_OTHER, /* not known yet */
    TBX_CLASSES
};

/* Of what lies beyond the fixed point's numbers the last one, that none is beyond. */
TBX_FN int32_t tbx_off_place(double x)
{
    double place = x < 2147483647.0 ? x : 2147483647.0;
    place = place > -2147483648.0 ? place : -2147483648.0;
    TBX_KEEP_SCALAR(place);
    return (int32_t)place;
}

/* Fixed point on axis k. Origins are less than 2^37 sizes off, as delta is below QUICK_MOST: so the error is
 * below an eighth of a voxel, and the bias below 2^32. */
TBX_FN void tbx_fixed_init(tbx_quick *q, int k, int is_double)
{
    const double u = (double)TBX_U32;
    const double n = (double)q->n[k];
    const double steps = TBX_STEPS * q->units[k];
    const double most = 1.329227995784916e36 / steps; /* 2^120 */
    double least_far = most < 1e38 ? most : 1e38;
    float far_off;
    double error = (0.5 * n + 2.0) * TBX_STEPS_ULPS * u + 2.0 * q->delta;
    double slack;
    double bias;
    double near_by;
    float near_float;
    TBX_KEEP_SCALAR(least_far); /* not narrowed before it is known to fit */
    far_off = (float)least_far;
    q->centre[k + 1] = (float)(q->origin[k] + 0.5 * n / q->units[k]);
    TBX_KEEP(q->centre[k + 1]);
    error += TBX_STEPS_ULPS * u * u * tbx_abs((double)q->centre[k + 1]) * q->units[k];
    slack = TBX_BOUND_ERROR * TBX_STEPS * error + 4.0;
    TBX_KEEP_SCALAR(slack);
    q->subtrahend[k + 1] = is_double ? 0.0f : q->centre[k + 1];
    q->steps[k + 1] = (float)steps;
    q->far_bits[k + 1] = (int32_t)tbx_bits32(&far_off);
    bias = ((double)q->centre[k + 1] - q->origin[k]) * steps - slack;
    TBX_KEEP_SCALAR(bias);
    q->off_below[k + 1] = tbx_off_place(-bias - 2.0 * slack - 2.0);
    q->off_above[k + 1] = tbx_off_place(n * TBX_STEPS - bias + 2.0);
    q->bias[k + 1] = (int32_t)(uint32_t)(uint64_t)(int64_t)bias;
    near_by = 2113929216.0 / steps - tbx_abs((double)q->subtrahend[k + 1]); /* 2^31 less a 64th */
    near_by = near_by > 0.0 ? near_by : 0.0;
    TBX_KEEP_SCALAR(near_by);
    near_float = (float)(near_by * 0.999);
    q->near_bits[k + 1] = (int32_t)tbx_bits32(&near_float);
    q->box_origin[k + 1] = q->origin[k];
    q->box_units[k + 1] = q->units[k];
    q->beside[k + 1] = (2.0 * slack + 2.0) / TBX_STEPS;
    q->limit[k + 1] = (int32_t)(((uint32_t)q->n[k] - 1u) << 16 | (65535u - 2u * (uint32_t)slack));
}

/* The fill's grid on axis k, as long as its numbers are in range. */
TBX_FN void tbx_quick_axis(tbx_quick *q, const tribox_grid *grid, int k, int is_double)
{
    const double u = (double)TBX_U32;
    const double margin = (double)TBX_MARGIN;
    const double size = grid->size[k];
    const double n = (double)q->n[k];
    const double units = q->units[k];
    const double from = is_double ? (double)q->centre[k + 1] : 0.0; /* where the corners' floats count from */
    const double origin = q->origin[k] - from;
    const double rounded =
        is_double ? TBX_BOUND_ERROR * u * (0.5 * n + 34.0 + u * tbx_abs(from) * units) : 0.0;
    const double start = tbx_abs(origin) * units;
    const double end = tbx_abs(origin * units + n);
    const double slack =
        TBX_BOUND_ERROR * u * (2.0 * (start > end ? start : end) + start + n + 128.0) + rounded + 1e-9;
    const double base = origin + size;
    const double before = tbx_abs(origin - margin * size);
    const double last = tbx_abs(origin + (n + 2.0 * margin) * size);
    const double most = before > last ? before : last;
    double spacing;
    double base_high;
    double size_high;
    double delta_low;
    q->on = tbx_more(0.125, slack);
    spacing = tbx_floor_pow2(most) * (1.0 / 4194304.0); /* 2^-22 */
    base_high = tbx_floor_to(base, spacing);
    size_high = tbx_floor_to(size, spacing);
    TBX_KEEP(base_high);
    TBX_KEEP(size_high);
    delta_low =
        (double)TBX_PLACED_ERROR * spacing * (n + 34.0) * units + 2.0 * q->delta + rounded + 1e-12;
    q->inverse[k + 1] = (float)units;
    q->shift_down[k] = (float)(margin - origin * units - slack);
    q->shift_up[k] = (float)(margin - origin * units + slack);
    q->base_high[k + 1] = (float)base_high;
    q->base_low[k + 1] = (float)(base - base_high);
    q->size_high[k + 1] = (float)size_high;
    q->size_low[k + 1] = (float)(size - size_high);
    q->step[k] = tbx_lattice_step(grid, k, spacing);
    q->delta_low = (float)delta_low > q->delta_low ? (float)delta_low : q->delta_low;
    q->end[k] = TBX_MARGIN + q->n[k] - 1;
}

/* For a source of doubles or floats. A coordinate in voxels, (v - origin) * units, is off by less than
 * QUICK_ERROR times |origin| / size + |lo| + n + 64: of the region's origin a product and a sum, the
 * difference, 1 / size (4 u) and the product, u each. It counts up to QUICK_MOST. */
#define TBX_QUICK_ERROR (8.0 * TBX_U64)
#define TBX_QUICK_MOST 1e-4

TBX_FN void tbx_quick_init(tbx_quick *q, const tribox_grid *grid, const tbx_target *t, int is_double)
{
    int k;
    q->on = TBX_DOUBLE_IS_53_BITS;
    q->is_double = is_double;
    q->thin = (grid->flags & TRIBOX_THIN) != 0;
    q->upper_open = tbx_hi_is_open(grid->flags);
    q->lower_open = tbx_lo_is_open(grid->flags);
    q->layer_words = t->ny * t->row_words;
    q->delta = 0.0;
    q->delta_low = 0.0f;
    q->box_origin[0] = q->box_units[0] = q->beside[0] = 0.0;
    q->centre[0] = q->subtrahend[0] = q->steps[0] = q->inverse[0] = 0.0f;
    q->base_high[0] = q->base_low[0] = q->size_high[0] = q->size_low[0] = 0.0f;
    q->near_bits[0] = 0x7f7fffff;
    q->far_bits[0] = 0x7fffffff;
    q->bias[0] = 0;
    q->limit[0] = -1;
    q->off_below[0] = -2147483647 - 1;
    q->off_above[0] = 2147483647;
    for (k = 0; k < 3; k++) {
        const double n = (double)grid->hi[k] - (double)grid->lo[k];
        if (!(tbx_is_ordinary(&grid->origin[k], 100) & tbx_is_ordinary(&grid->size[k], 60)) || n > 65536.0) {
            q->on = 0;
            return;
        } else {
            const double offset = (double)grid->lo[k] * grid->size[k];
            double size = grid->size[k];
            double delta;
            TBX_KEEP_SCALAR(size);
            q->units[k] = 1.0 / size;
            q->origin[k] = grid->origin[k] + offset;
            q->n[k] = (int)n;
            delta = (tbx_abs(grid->origin[k]) + tbx_abs(offset)) * q->units[k] + n + 64.0;
            delta *= TBX_QUICK_ERROR;
            q->delta = delta > q->delta ? delta : q->delta;
        }
    }
    q->on &= q->delta < TBX_QUICK_MOST;
    q->fetch = 0;
    if (t->bits != NULL) { /* 1 MiB, 32 MiB */
        q->fetch = (q->layer_words > 131072 / (size_t)q->n[2]) + (q->layer_words > 4194304 / (size_t)q->n[2]);
    }
    q->bits = (uintptr_t)t->bits;
    q->short_axes = (q->n[0] | q->n[1] | q->n[2]) < 32768;
    q->row_words = t->row_words;
    for (k = 0; k < 3 && q->on; k++) {
        tbx_fixed_init(q, k, is_double);
        tbx_quick_axis(q, grid, k, is_double);
    }
    q->precise = q->on;
    for (k = 0; k < 3; k++) {
        q->whole_origin[k] = grid->origin[k];
        tbx_halves_set(&q->halves[k], grid, k);
        q->lo[k] = grid->lo[k];
        q->precise &= grid->lo[k] > -1000000 && grid->hi[k] < 1000000;
    }
    q->lattice = q->on && !is_double && q->step[0] + q->step[1] + q->step[2] > 0.0f;
}

/* Index boxes as the ways of a fill take them: x, y, z of the first voxel, from the region's first; in the
 * last lane a byte for each extent, that is the voxels less 1, and these: */
#define TBX_ON_LATTICE (1 << 24)
#define TBX_IS_CUT (1 << 25) /* not all of it is in the region */
#define TBX_BESIDE (1 << 26) /* a corner is beside a grid plane */
#define TBX_OFF (-2)         /* none of it is */
#define TBX_NOT_KNOWN (-1)   /* or it is too large, or too far off the region */

/* Boxes of WIDE triangles. */
typedef struct tbx_group {
    tbx_i4 box[TBX_WIDE];
    size_t triangle[TBX_WIDE];
    int n;
} TBX_ALIGNED tbx_group;

/* Returns 1 when the group is full. */
TBX_FORCED int tbx_group_add(tbx_group *g, tbx_i4 box, size_t triangle)
{
    const int n = g->n;
    g->box[n] = box;
    g->triangle[n] = triangle;
    g->n = n + 1;
    return n + 1 == TBX_WIDE;
}

/* Fills the lanes that are left with the first one's triangle. */
TBX_FN void tbx_group_pad(tbx_group *g)
{
    int i;
    for (i = g->n; i < TBX_WIDE; i++) {
        g->triangle[i] = g->triangle[0];
        g->box[i] = g->box[0];
    }
}

#define TBX_BLOCK 64 /* a bit of 64 for each triangle */

/* What a triangle leaves for the row walk: how many triangles before the next block's first it is, and its
 * rows and layers. */
typedef struct tbx_later {
    uint16_t back;
    uint16_t first[2];
    uint16_t last[2];
} tbx_later;

/* What the ways of a fill share. What is unsure waits until the stack is free of all else. */
typedef struct tbx_fill {
    tbx_group rows[2]; /* boxes of up to FEW^3, ROWS^3 */
    tbx_group again;   /* of up to FEW^3, unsure in floats */
    const tbx_frame *frame;
    const tbx_source *source;
    const tbx_target *target;
    tbx_quick quick;
    size_t next;     /* the first triangle of the next block */
    int habit;       /* of the last block */
    int later_count; /* a block's, and of what waited in groups, at most */
    tbx_later later[TBX_BLOCK + 3 * TBX_WIDE];
} TBX_ALIGNED tbx_fill;

TBX_FN tbx_later *tbx_fill_later(tbx_fill *fill, size_t triangle)
{
    tbx_later *d = &fill->later[fill->later_count];
    d->back = (uint16_t)(fill->next - triangle);
    d->first[0] = d->first[1] = 0;
    d->last[0] = (uint16_t)(fill->quick.n[1] - 1);
    d->last[1] = (uint16_t)(fill->quick.n[2] - 1);
    fill->later_count++;
    return d;
}

/* ---- Blocks of triangles: their boxes, and lists of them by class
 *
 * Of a box there are the first voxel, from the region's first, x, y, z modulo 2^16 from bit 16 on (that of a
 * cut box may lie before it); and in four bytes its flags, the lowest, and the extents, that is the voxels
 * less 1, of x, y, z. A key is the first voxel, and below it extents of up to 3 in two bits each. Corners are
 * rows of four floats: x, y, z in lanes 1 to 3, anything finite in lane 0, so that a row of a mesh is one
 * load. */
typedef struct tbx_block {
    uint64_t first[TBX_BLOCK + 2]; /* that each has a successor */
    uint32_t more[TBX_BLOCK + 4];
    uint64_t word[TBX_BLOCK]; /* of the bits, in which the first voxel is */
    uint64_t of[TBX_CLASSES]; /* a bit for each triangle of a class, */
    uint64_t same;            /* and for each that has its predecessor's box, which is sure */
    size_t start;             /* the first triangle */
} tbx_block;

typedef union tbx_corners {
    tbx_f4 row[3][TBX_BLOCK];
    tbx_fw some[3][TBX_BLOCK * 4 / TBX_WIDE];
} TBX_ALIGNED tbx_corners;

typedef uint16_t tbx_hw __attribute__((vector_size(4 * TBX_WIDE), aligned(16)));
typedef int16_t tbx_sw __attribute__((vector_size(4 * TBX_WIDE), aligned(16)));
typedef uint64_t tbx_mw __attribute__((vector_size(4 * TBX_WIDE), aligned(16)));
typedef int16_t tbx_s8 __attribute__((vector_size(16)));
typedef uint16_t tbx_h8 __attribute__((vector_size(16)));
typedef signed char tbx_b16 __attribute__((vector_size(16)));
typedef char tbx_c16 __attribute__((vector_size(16)));

TBX_FORCED tbx_h8 tbx_load_words(const void *from)
{
    tbx_h8 r;
    TBX_COPY(&r, from, sizeof r);
    return r;
}

/* How far each word of a is above that of b, 0 where it is not. */
TBX_FORCED tbx_uw tbx_words_above(tbx_uw a, tbx_uw b)
{
#if defined(__AVX2__) && !defined(__clang__) /* which finds these instructions itself */
    return (tbx_uw)__builtin_ia32_psubusw256((tbx_sw)a, (tbx_sw)b);
#elif defined(__SSE2__) && !defined(__clang__)
    return (tbx_uw)__builtin_ia32_psubusw128((tbx_s8)a, (tbx_s8)b);
#else
    const tbx_hw above = (tbx_hw)((tbx_hw)a > (tbx_hw)b);
    return (tbx_uw)(((tbx_hw)a - (tbx_hw)b) & above);
#endif
}

/* The words of a's lanes, then b's; what is no 16-bit number becomes the one next to it. */
TBX_FORCED tbx_sw tbx_words_join(tbx_iw a, tbx_iw b)
{
#if defined(__AVX2__) /* packs halves with halves */
    const tbx_mw r = (tbx_mw)__builtin_ia32_packssdw256(a, b);
#if defined(__clang__)
    return (tbx_sw)__builtin_shufflevector(r, r, 0, 2, 1, 3);
#else
    const tbx_mw order = { 0, 2, 1, 3 };
    return (tbx_sw)__builtin_shuffle(r, order);
#endif
#elif defined(__SSE2__)
    return (tbx_sw)__builtin_ia32_packssdw128(a, b);
#else
    tbx_sw r = (tbx_sw)tbx_wide_int(0);
    int i;
    for (i = 0; i < 4; i++) {
        r[i] = (int16_t)(a[i] > 32767 ? 32767 : a[i] < -32768 ? -32768 : a[i]);
        r[4 + i] = (int16_t)(b[i] > 32767 ? 32767 : b[i] < -32768 ? -32768 : b[i]);
    }
    return r;
#endif
}

/* Words in fours as bytes of a number, from the lowest on; what is no byte becomes the one next to it. */
TBX_FORCED tbx_i4 tbx_bytes_join(const tbx_sw words[8 / TBX_WIDE])
{
#if defined(__AVX2__)
    tbx_f4 part[2];
    tbx_wide_parts(part, (tbx_fw)words[0]);
    return (tbx_i4)__builtin_ia32_packsswb128((tbx_s8)part[0], (tbx_s8)part[1]);
#elif defined(__SSE2__)
    return (tbx_i4)__builtin_ia32_packsswb128(words[0], words[1]);
#else
    tbx_i4 r = tbx_splat_int(0);
    int i;
    for (i = 0; i < 16; i++) {
        const int word = words[i >> 3][i & 7];
        const int byte = word > 127 ? 127 : word < -128 ? -128 : word;
        r[i >> 2] |= (int32_t)((uint32_t)(byte & 255) << 8 * (i & 3));
    }
    return r;
#endif
}

/* Numbers of 64 bits to memory, with the first word the lowest. */
TBX_FORCED void tbx_words_to(uint64_t out[TBX_WIDE / 2], tbx_sw words)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    int i;
    out[0] = out[1] = 0;
    for (i = 7; i >= 0; i--) {
        out[i >> 2] = out[i >> 2] << 16 | (uint16_t)words[i];
    }
#else
    TBX_COPY(out, &words, sizeof words);
#endif
}

TBX_FORCED uint32_t tbx_key_axis(uint64_t key, int k)
{
    return (uint32_t)(key >> (16 + 16 * k)) & 65535u;
}

/* A row at `from`: lane 0 holds the four bytes before it, or 0. */
TBX_FORCED tbx_i4 tbx_corner_at(const char *from, int packed)
{
    tbx_i4 r = tbx_splat_int(0);
    if (packed) {
        TBX_COPY(&r, from - sizeof(float), sizeof r);
    } else {
        const tbx_i4 v = tbx_load3i(from);
        r = TBX_LANES(v, v, 3, 0, 1, 2);
    }
    TBX_KEEP_VECTOR(r);
    return r;
}

/* The region's centre, as doubles: x and y; 0 and z. */
typedef struct tbx_centre {
    tbx_d2 xy;
    tbx_d2 z;
} TBX_ALIGNED tbx_centre;

/* What doubles lose as floats, joined: words that end in 29 bits of 0 where they are floats, and what is not
 * 0 where one, itself not 0, is outside of 2^-126..2^100. */
typedef struct tbx_lost {
    tbx_i4 low;
    tbx_i4 beyond;
} TBX_ALIGNED tbx_lost;

/* A row of doubles, less the region's centre, in floats. That rounds once, as the difference of floats does.
 * Numbers that no float would hold are infinite. Adds to *lost, if there is one. */
TBX_FORCED tbx_i4 tbx_corner_at_f64(const char *from, const tbx_centre *centre, tbx_lost *lost)
{
    tbx_i4 bits = tbx_splat_int(0x7f800000);
    tbx_d2 xy = tbx_load2(from);
    tbx_d2 z = tbx_swap(tbx_load1(from + sizeof xy));
    const tbx_i4 upper = TBX_HIGH_WORDS(xy, z) & tbx_splat_int(0x7fffffff);
    if (lost != NULL) {
        const tbx_i4 lower = TBX_LOW_WORDS(xy, z);
        lost->low |= lower;
        lost->beyond |= (upper > tbx_splat_int((1023 + 100) << 20)) |
                        ((upper < tbx_splat_int((1023 - 126) << 20)) & ((upper | lower) != tbx_splat_int(0)));
    }
    if (!TBX_RARELY(tbx_any(upper > tbx_splat_int((1023 + 100) << 20)))) {
        tbx_f4 row;
        TBX_KEEP2(VECTOR, xy, z); /* not converted before: overflow */
        row = TBX_LANES(tbx_narrow(xy - centre->xy), tbx_narrow(z - centre->z), 0, 1, 4, 5);
        TBX_KEEP_VECTOR(row); /* two moves; as one they become eight */
        bits = (tbx_i4)TBX_LANES(row, row, 2, 0, 1, 3);
    }
    TBX_KEEP_VECTOR(bits);
    return bits;
}

/* Corner k, vertex number `at` of the mesh. */
TBX_FORCED tbx_i4 tbx_block_corner(const tbx_source *source, const tbx_centre *centre, tbx_lost *lost,
                                   int indexed, int packed, size_t at)
{
    const size_t vertex = indexed ? (size_t)source->indices[at] : at;
    const char *p = source->positions + vertex * (packed ? 3 * sizeof(float) : source->stride);
    return source->is_double ? tbx_corner_at_f64(p, centre, lost) : tbx_corner_at(p, packed);
}

TBX_FORCED int tbx_all_near(const tbx_quick *q, tbx_i4 bits)
{
    return !tbx_any((bits & tbx_splat_int(0x7fffffff)) > tbx_load4i(q->near_bits));
}

/* Are all of a block's corners near enough, and finite, for boxes without care? */
TBX_NOINLINE int tbx_block_is_near(const tbx_corners *corners, const tbx_quick *q, int count)
{
    const tbx_i4 magnitude = tbx_splat_int(0x7fffffff);
    const tbx_i4 near_bits = tbx_load4i(q->near_bits);
    tbx_i4 beyond = tbx_splat_int(0);
    int i;
    int c;
    for (c = 0; c < 3; c++) {
        for (i = 0; i < count; i++) {
            beyond |= ((tbx_i4)corners->row[c][i] & magnitude) > near_bits;
        }
    }
    return !tbx_any(beyond);
}

/* The corners of triangle i of a block. Returns their bits, joined. */
TBX_FORCED tbx_i4 tbx_block_triangle(tbx_corners *out, int i, const tbx_source *source,
                                     const tbx_centre *centre, tbx_lost *lost, int indexed, int packed,
                                     size_t first)
{
    const size_t at = 3 * (first + (size_t)i);
    const tbx_i4 v0 = tbx_block_corner(source, centre, lost, indexed, packed, at);
    const tbx_i4 v1 = tbx_block_corner(source, centre, lost, indexed, packed, at + 1);
    const tbx_i4 v2 = tbx_block_corner(source, centre, lost, indexed, packed, at + 2);
    out->row[0][i] = (tbx_f4)v0;
    out->row[1][i] = (tbx_f4)v1;
    out->row[2][i] = (tbx_f4)v2;
    return v0 | v1 | v2;
}

/* The corners of so many triangles. Returns 1 if they are all near enough, and finite, for boxes without
 * care. No magnitude is greater than all of them with their bits joined, which mostly suffices. as_floats:
 * takes doubles for floats, and returns -1 where one is none. */
TBX_FORCED int tbx_block_corners(tbx_corners *out, const tbx_quick *q, const tbx_source *from, int indexed,
                                 int packed, int as_floats, size_t first, int count)
{
    const tbx_source source = *from; /* what is stored does not change these */
    const tbx_centre centre = { { as_floats ? 0.0 : (double)q->centre[1],
                                  as_floats ? 0.0 : (double)q->centre[2] },
                                { 0.0, as_floats ? 0.0 : (double)q->centre[3] } };
    tbx_lost lost = { tbx_splat_int(0), tbx_splat_int(0) };
    tbx_lost *const losing = as_floats ? &lost : NULL;
    tbx_i4 bits = tbx_splat_int(0);
    int i = 0;
    for (; packed && i + 1 < count; i += 2) {
        bits |= tbx_block_triangle(out, i, &source, &centre, losing, indexed, packed, first);
        bits |= tbx_block_triangle(out, i + 1, &source, &centre, losing, indexed, packed, first);
    }
    for (; i < count; i++) {
        bits |= tbx_block_triangle(out, i, &source, &centre, losing, indexed, packed, first);
    }
    for (; i % 4 != 0; i++) {
        out->row[0][i] = out->row[1][i] = out->row[2][i] = out->row[0][count - 1];
    }
    if (as_floats && tbx_any(((lost.low & tbx_splat_int(0x1fffffff)) | lost.beyond) != tbx_splat_int(0))) {
        return -1;
    }
    return tbx_all_near(q, bits) || tbx_block_is_near(out, q, count);
}

/* Is the first vertex a corner of the block? Nothing may be read before it. */
TBX_FORCED int tbx_block_has_first(const tbx_source *source, size_t first, int count)
{
    const uint32_t *index = source->indices;
    int zero = 0;
    int i = 0;
    if (index == NULL) {
        return first == 0;
    }
    index += 3 * first;
#if defined(__SSE2__)
    tbx_b16 none = (tbx_b16)tbx_splat_int(0);
    for (; i + 16 <= 3 * count; i += 16) { /* bytes: of what is not 0, none becomes 0 */
        const tbx_s8 low = __builtin_ia32_packssdw128((tbx_i4)tbx_load_words(index + i),
                                                      (tbx_i4)tbx_load_words(index + i + 4));
        const tbx_s8 high = __builtin_ia32_packssdw128((tbx_i4)tbx_load_words(index + i + 8),
                                                       (tbx_i4)tbx_load_words(index + i + 12));
        none |= (tbx_b16)((tbx_b16)__builtin_ia32_packsswb128(low, high) == (tbx_b16)tbx_splat_int(0));
    }
    zero = tbx_any((tbx_i4)none != tbx_splat_int(0));
#endif
    for (; i < 3 * count; i++) {
        zero |= index[i] == 0;
    }
    return zero;
}

TBX_FN int tbx_block_load(tbx_corners *out, const tbx_quick *q, const tbx_source *source, size_t first,
                          int count)
{
    if (source->is_double && !q->is_double) {
        return tbx_block_corners(out, q, source, source->indices != NULL, 0, 1, first, count);
    } else if (source->is_double || source->stride != 3 * sizeof(float) ||
               tbx_block_has_first(source, first, count)) {
        return source->indices != NULL ? tbx_block_corners(out, q, source, 1, 0, 0, first, count)
                                       : tbx_block_corners(out, q, source, 0, 0, 0, first, count);
    } else {
        return source->indices != NULL ? tbx_block_corners(out, q, source, 1, 1, 0, first, count)
                                       : tbx_block_corners(out, q, source, 0, 1, 0, first, count);
    }
}

/* Of tbx_quick, what fixed point takes, for WIDE / 4 triangles. */
typedef struct tbx_fixed {
    tbx_fw base;
    tbx_fw steps;
    tbx_uw bias;
    tbx_uw limit;
    tbx_sw rows; /* y and z times these are a row's number */
    tbx_mw row_words;
} TBX_ALIGNED tbx_fixed;

TBX_FORCED tbx_iw tbx_wide_repeat(tbx_i4 a)
{
    tbx_f4 part[TBX_WIDE / 4];
    int i;
    for (i = 0; i < TBX_WIDE / 4; i++) {
        part[i] = (tbx_f4)a;
    }
    return (tbx_iw)tbx_wide_of(part);
}

TBX_FORCED void tbx_fixed_of(tbx_fixed *f, const tbx_quick *q)
{
    const tbx_s8 rows = { 0, 0, 1, (int16_t)q->n[1], 0, 0, 1, (int16_t)q->n[1] };
    const tbx_l2 row_words = { (int64_t)q->row_words, (int64_t)q->row_words };
    f->base = (tbx_fw)tbx_wide_repeat((tbx_i4)tbx_load4(q->subtrahend));
    f->steps = (tbx_fw)tbx_wide_repeat((tbx_i4)tbx_load4(q->steps));
    f->bias = (tbx_uw)tbx_wide_repeat(tbx_load4i(q->bias));
    f->limit = (tbx_uw)tbx_wide_repeat(tbx_load4i(q->limit));
    f->rows = (tbx_sw)tbx_wide_repeat((tbx_i4)rows);
    f->row_words = (tbx_mw)tbx_wide_repeat((tbx_i4)row_words);
}

/* Boxes of WIDE / 4 triangles, index by index: the first and the last voxel, what is above the limit, and -1
 * where it is off the region. */
typedef struct tbx_ends {
    tbx_iw first;
    tbx_iw last;
    tbx_iw above;
    tbx_iw off;
} TBX_ALIGNED tbx_ends;

/* These, by the least and the greatest place in fixed point; number `at` of a block's vectors. */
TBX_FORCED void tbx_ends_find(tbx_ends *out, const tbx_quick *q, const tbx_fixed *f,
                              const tbx_corners *corners, int at, int careful)
{
    const tbx_iw half = tbx_wide_int(16);
    tbx_fw v0 = corners->some[0][at];
    tbx_fw v1 = corners->some[1][at];
    tbx_fw v2 = corners->some[2][at];
    tbx_fw least;
    tbx_fw most;
    tbx_iw low;
    tbx_iw high;
    if (careful) { /* nothing is computed before the question whether it may be */
        TBX_KEEP3(VECTOR, v0, v1, v2);
    }
    least = tbx_wide_min(tbx_wide_min(v0, v1), v2) - f->base;
    most = tbx_wide_max(tbx_wide_max(v0, v1), v2) - f->base;
    TBX_KEEP2(VECTOR, least, most);
    least *= f->steps;
    most *= f->steps;
    if (careful) {
        const tbx_fw end = tbx_wide_all(2147483392.0f); /* 2^31 - 2^8 */
        least = tbx_wide_min(tbx_wide_max(least, -end), end);
        most = tbx_wide_min(tbx_wide_max(most, -end), end);
    }
    low = __builtin_convertvector(least, tbx_iw);
    high = __builtin_convertvector(most, tbx_iw);
    if (careful) {
        out->off = (high < tbx_wide_repeat(tbx_load4i(q->off_below))) |
                   (low > tbx_wide_repeat(tbx_load4i(q->off_above)));
    }
    low = (tbx_iw)((tbx_uw)low + f->bias);
    high = (tbx_iw)((tbx_uw)high + f->bias);
    out->above = (tbx_iw)(tbx_words_above((tbx_uw)low, f->limit) | tbx_words_above((tbx_uw)high, f->limit));
    out->first = low >> half;
    out->last = high >> half;
}

/* Boxes of four triangles, as in a block; -1 where they are sure, or not off the region. */
typedef struct tbx_four {
    tbx_sw first[8 / TBX_WIDE];
    tbx_i4 more;
    tbx_i4 sure;
    tbx_i4 on;
} TBX_ALIGNED tbx_four;

/* Of four triangles from `at` on; with care `on` is told. gcc -O2 unrolls no loop. */
TBX_FORCED void tbx_four_find(tbx_four *out, const tbx_quick *q, const tbx_fixed *f,
                              const tbx_corners *corners, int at, int careful)
{
    tbx_sw more[8 / TBX_WIDE];
    tbx_sw above[8 / TBX_WIDE];
    tbx_sw off[8 / TBX_WIDE];
    tbx_ends a;
    tbx_ends b;
    at /= TBX_WIDE / 4;
    tbx_ends_find(&a, q, f, corners, at, careful);
    tbx_ends_find(&b, q, f, corners, at + 1, careful);
    out->first[0] = tbx_words_join(a.first, b.first);
    more[0] = (tbx_sw)((tbx_hw)tbx_words_join(a.last, b.last) - (tbx_hw)out->first[0]);
    above[0] = tbx_words_join(a.above, b.above);
    if (careful) {
        off[0] = tbx_words_join(a.off, b.off);
    }
#if TBX_WIDE == 4
    tbx_ends_find(&a, q, f, corners, at + 2, careful);
    tbx_ends_find(&b, q, f, corners, at + 3, careful);
    out->first[1] = tbx_words_join(a.first, b.first);
    more[1] = (tbx_sw)((tbx_hw)tbx_words_join(a.last, b.last) - (tbx_hw)out->first[1]);
    above[1] = tbx_words_join(a.above, b.above);
    if (careful) {
        off[1] = tbx_words_join(a.off, b.off);
    }
#endif
    out->more = tbx_bytes_join(more);
    out->sure = tbx_bytes_join(above) == tbx_splat_int(0);
    if (careful) {
        out->on = tbx_bytes_join(off) == tbx_splat_int(0);
    }
}

/* The word of a box's first voxel. */
TBX_FORCED uint64_t tbx_first_word(const tbx_quick *q, uint64_t first)
{
    return (uint64_t)tbx_key_axis(first, 2) * q->layer_words +
           (uint64_t)tbx_key_axis(first, 1) * q->row_words + (uint64_t)(tbx_key_axis(first, 0) >> 6);
}

/* Those of WIDE / 2 boxes, where all axes are below 2^15. */
TBX_FORCED void tbx_first_words(uint64_t out[TBX_WIDE / 2], const tbx_quick *q, const tbx_fixed *f,
                                tbx_sw first)
{
#if defined(__AVX2__)
    tbx_mw word = (tbx_mw)__builtin_ia32_pmaddwd256(first, f->rows) >> 32;
#elif defined(__SSE2__)
    tbx_mw word = (tbx_mw)__builtin_ia32_pmaddwd128(first, f->rows) >> 32;
#endif
#if !defined(__SSE2__)
    uint64_t at[2];
    (void)f;
    tbx_words_to(at, first);
    out[0] = tbx_first_word(q, at[0]);
    out[1] = tbx_first_word(q, at[1]);
#else
#if defined(__clang__)
    word = (word & 0xffffffffu) * (f->row_words & 0xffffffffu);
#elif defined(__AVX2__)
    word = (tbx_mw)__builtin_ia32_pmuludq256((tbx_iw)word, (tbx_iw)f->row_words);
#else
    word = (tbx_mw)__builtin_ia32_pmuludq128((tbx_iw)word, (tbx_iw)f->row_words);
#endif
    word += ((tbx_mw)first >> 22) & 1023;
    (void)q;
    TBX_COPY(out, &word, sizeof word);
#endif
}

TBX_FORCED void tbx_four_store(tbx_block *b, int at, const tbx_quick *q, const tbx_fixed *f,
                               const tbx_four *four)
{
    TBX_COPY(&b->more[at], &four->more, sizeof four->more);
    tbx_words_to(&b->first[at], four->first[0]);
    tbx_first_words(&b->word[at], q, f, four->first[0]);
#if TBX_WIDE == 4
    tbx_words_to(&b->first[at + 2], four->first[1]);
    tbx_first_words(&b->word[at + 2], q, f, four->first[1]);
#endif
}

/* The words, where an axis is longer. */
TBX_NOINLINE void tbx_block_words(tbx_block *b, const tbx_quick *q, int count)
{
    int i;
    for (i = 0; i < count; i++) {
        b->word[i] = tbx_first_word(q, b->first[i]);
    }
}

/* The class of a box, by its extents. */
TBX_FORCED unsigned tbx_class_of(uint32_t more)
{
    const unsigned x = more >> 8 & 255;
    const unsigned y = more >> 16 & 255;
    const unsigned z = more >> 24;
    const unsigned most = x | y | z;
    if (most > 3) {
        return TBX_CLASS_LARGE;
    } else if (most > 1) {
        return x == 3 || y == 3 || z == 3 ? TBX_CLASS_4 : TBX_CLASS_3;
    } else if (x + y + z < 2) {
        return x != 0 ? TBX_CLASS_RUN : most != 0 ? TBX_CLASS_PAIR : TBX_CLASS_ONE;
    } else {
        return x == 0   ? TBX_CLASS_FLAT_X
               : y == 0 ? TBX_CLASS_FLAT_Y
               : z == 0 ? TBX_CLASS_FLAT_Z
                        : TBX_CLASS_2;
    }
}

#if defined(__SSE2__)
/* Words below 256 as bytes. */
TBX_FORCED tbx_h8 tbx_bytes_of(tbx_h8 a, tbx_h8 b)
{
    return (tbx_h8)__builtin_ia32_packuswb128((tbx_s8)a, (tbx_s8)b);
}

/* A bit for each of 16 bytes that is negative, as -1 is. */
TBX_FORCED uint64_t tbx_bytes_signs(tbx_b16 bytes)
{
    return (uint64_t)(unsigned)__builtin_ia32_pmovmskb128((tbx_c16)bytes);
}

/* A bit for each of 16 boxes from number `at` on that is the successor's. */
TBX_FORCED tbx_i4 tbx_four_alike(const tbx_block *b, int at)
{
    const tbx_i4 low = (tbx_i4)tbx_load_words(&b->first[at]) == (tbx_i4)tbx_load_words(&b->first[at + 1]);
    const tbx_i4 high =
        (tbx_i4)tbx_load_words(&b->first[at + 2]) == (tbx_i4)tbx_load_words(&b->first[at + 3]);
    const tbx_i4 more = (tbx_i4)tbx_load_words(&b->more[at]) == (tbx_i4)tbx_load_words(&b->more[at + 1]);
    return ((tbx_i4)__builtin_ia32_packssdw128(low, high) == tbx_splat_int(-1)) & more;
}

TBX_FORCED uint64_t tbx_boxes_alike(const tbx_block *b, int at)
{
    const tbx_i4 a0 = tbx_four_alike(b, at);
    const tbx_i4 a1 = tbx_four_alike(b, at + 4);
    const tbx_i4 a2 = tbx_four_alike(b, at + 8);
    const tbx_i4 a3 = tbx_four_alike(b, at + 12);
    return tbx_bytes_signs((tbx_b16)__builtin_ia32_packsswb128(__builtin_ia32_packssdw128(a0, a1),
                                                               __builtin_ia32_packssdw128(a2, a3)));
}

/* The extents of boxes, x, y and z apart. */
typedef struct tbx_sizes {
    tbx_b16 x[TBX_BLOCK / 16];
    tbx_b16 y[TBX_BLOCK / 16];
    tbx_b16 z[TBX_BLOCK / 16];
} TBX_ALIGNED tbx_sizes;

/* Of 16 boxes from number `at` on, flags being 0. */
TBX_FORCED void tbx_sizes_of(tbx_b16 *x, tbx_b16 *y, tbx_b16 *z, const uint32_t *more)
{
    const tbx_h8 low = (tbx_h8)tbx_splat_int(0x00ff00ff);
    const tbx_h8 m0 = tbx_load_words(more);
    const tbx_h8 m1 = tbx_load_words(more + 4);
    const tbx_h8 m2 = tbx_load_words(more + 8);
    const tbx_h8 m3 = tbx_load_words(more + 12);
    const tbx_h8 y0 = tbx_bytes_of(m0 & low, m1 & low);
    const tbx_h8 y1 = tbx_bytes_of(m2 & low, m3 & low);
    const tbx_h8 xz0 = tbx_bytes_of(m0 >> 8, m1 >> 8);
    const tbx_h8 xz1 = tbx_bytes_of(m2 >> 8, m3 >> 8);
    *x = (tbx_b16)tbx_bytes_of(xz0 & low, xz1 & low);
    *y = (tbx_b16)tbx_bytes_of(y0 >> 8, y1 >> 8);
    *z = (tbx_b16)tbx_bytes_of(xz0 >> 8, xz1 >> 8);
}

/* The classes of the boxes in `some`, which are larger than 2^3 voxels. */
TBX_FORCED void tbx_block_larger(tbx_block *b, const tbx_sizes *e, uint64_t some)
{
    const tbx_b16 three = (tbx_b16)tbx_splat_int(0x03030303);
    uint64_t above = 0;
    uint64_t has = 0;
    int i;
    for (i = TBX_BLOCK / 16 - 1; i >= 0; i--) {
        const tbx_b16 any = e->x[i] | e->y[i] | e->z[i];
        above = above << 16 | tbx_bytes_signs(any | (tbx_b16)(any > three));
        has = has << 16 | tbx_bytes_signs((tbx_b16)(e->x[i] == three) | (tbx_b16)(e->y[i] == three) |
                                          (tbx_b16)(e->z[i] == three));
    }
    b->of[TBX_CLASS_3] = some & ~(above | has);
    b->of[TBX_CLASS_4] = some & has & ~above;
    b->of[TBX_CLASS_LARGE] = some & above;
}

/* The classes of the boxes in `some`. Returns which are the same as their successors. */
TBX_FORCED uint64_t tbx_block_classes(tbx_block *b, uint64_t some)
{
    const tbx_b16 none = (tbx_b16)tbx_splat_int(0);
    const tbx_b16 one = (tbx_b16)tbx_splat_int(0x01010101);
    tbx_sizes e;
    uint64_t larger = 0;
    uint64_t alike = 0;
    uint64_t x = 0;
    uint64_t y = 0;
    uint64_t z = 0;
    uint64_t flat;
    int i;
    for (i = TBX_BLOCK / 16 - 1; i >= 0; i--) {
        tbx_b16 any;
        tbx_sizes_of(&e.x[i], &e.y[i], &e.z[i], &b->more[16 * i]);
        any = e.x[i] | e.y[i] | e.z[i];
        x = x << 16 | tbx_bytes_signs((tbx_b16)(e.x[i] > none));
        y = y << 16 | tbx_bytes_signs((tbx_b16)(e.y[i] > none));
        z = z << 16 | tbx_bytes_signs((tbx_b16)(e.z[i] > none));
        larger = larger << 16 | tbx_bytes_signs(any | (tbx_b16)(any > one));
        alike = alike << 16 | tbx_boxes_alike(b, 16 * i);
    }
    larger &= some;
    some ^= larger;
    b->of[TBX_CLASS_ONE] = some & ~(x | y | z);
    b->of[TBX_CLASS_RUN] = some & x & ~(y | z);
    b->of[TBX_CLASS_PAIR] = some & ~x & (y ^ z);
    flat = some & ((x & (y ^ z)) | (y & z & ~x));
    b->of[TBX_CLASS_FLAT_X] = flat & ~x;
    b->of[TBX_CLASS_FLAT_Y] = flat & ~y;
    b->of[TBX_CLASS_FLAT_Z] = flat & ~z;
    b->of[TBX_CLASS_2] = some & x & y & z;
    if (larger != 0) {
        tbx_block_larger(b, &e, larger);
    }
    return alike;
}
#else
TBX_FORCED uint64_t tbx_block_classes(tbx_block *b, uint64_t some)
{
    uint64_t rest;
    uint64_t alike = 0;
    for (rest = some; rest != 0; rest &= rest - 1) {
        const int i = __builtin_ctzll(rest);
        b->of[tbx_class_of(b->more[i])] |= rest & (0 - rest);
        alike |= (uint64_t)(b->first[i] == b->first[i + 1] && b->more[i] == b->more[i + 1]) << i;
    }
    return alike;
}
#endif

/* Asks for the memory of boxes' voxels. */
TBX_FORCED void tbx_block_fetch(const tbx_block *b, const tbx_quick *q, int count)
{
    const uintptr_t layer = sizeof(uint64_t) * q->layer_words;
    int i;
    for (i = 0; i < count; i++) {
        const uintptr_t row = q->bits + sizeof(uint64_t) * (size_t)b->word[i];
        const uintptr_t third = row + 2 * sizeof(uint64_t) * q->row_words;
        TBX_PREFETCH(row);
        TBX_PREFETCH(row + layer);
        TBX_PREFETCH(row + 2 * layer);
        if (q->fetch > 1) {
            TBX_PREFETCH(third);
            TBX_PREFETCH(third + layer);
            TBX_PREFETCH(third + 2 * layer);
        }
    }
}

/* Boxes of a block and their classes, OTHER where they are not sure. */
TBX_FORCED void tbx_block_boxes(tbx_block *b, const tbx_quick *q, const tbx_corners *corners, int count)
{
    const uint64_t all = ~(uint64_t)0 >> (64 - count);
    uint64_t sure = 0;
    tbx_fixed f;
    int i;
    TBX_KEEP_POINTER(corners); /* nothing is computed before they are known to be near */
    tbx_fixed_of(&f, q);
    for (i = 0; i < count; i += 4) {
        tbx_four four;
        tbx_four_find(&four, q, &f, corners, i, 0);
        tbx_four_store(b, i, q, &f, &four);
        sure = sure >> 4 | (uint64_t)(unsigned)tbx_signs(four.sure) << 60;
    }
    for (; i < TBX_BLOCK; i++) {
        b->first[i] = b->more[i] = 0;
        sure >>= 1;
    }
    b->first[TBX_BLOCK] = b->first[TBX_BLOCK + 1] = 0;
    b->more[TBX_BLOCK] = b->more[TBX_BLOCK + 1] = b->more[TBX_BLOCK + 2] = b->more[TBX_BLOCK + 3] = 0;
    sure &= all;
    b->of[TBX_CLASS_OTHER] = all ^ sure;
    if (q->thin) {
        b->of[TBX_CLASS_LARGE] = sure;
    } else {
        const uint64_t same = tbx_block_classes(b, sure) << 1;
        b->same = same & sure & sure << 1; /* others will have other boxes */
    }
    if (!q->short_axes) {
        tbx_block_words(b, q, count);
    }
    if (q->fetch) {
        tbx_block_fetch(b, q, count);
    }
}

/* A box, of lanes 0 to 2 and those of `more` that are extents, as a key. */
TBX_FORCED uint64_t tbx_key_set(tbx_i4 box)
{
    const uint64_t few = (uint32_t)(((uint32_t)box[3] & 0x030303u) * 0x04104000u) >> 26;
    return few | (uint64_t)(uint16_t)box[0] << 16 | (uint64_t)(uint16_t)box[1] << 32 |
           (uint64_t)(uint16_t)box[2] << 48;
}

/* And back. Whose last voxel is beyond 16 bits has begun before the region. */
TBX_FORCED tbx_i4 tbx_key_box(uint64_t key, int32_t more)
{
    const uint32_t x = tbx_key_axis(key, 0);
    const uint32_t y = tbx_key_axis(key, 1);
    const uint32_t z = tbx_key_axis(key, 2);
    const uint32_t last_x = x + ((uint32_t)more & 255u);
    const uint32_t last_y = y + ((uint32_t)more >> 8 & 255u);
    const uint32_t last_z = z + ((uint32_t)more >> 16 & 255u);
    const tbx_i4 r = { (int32_t)x - (int32_t)(last_x & 65536u), (int32_t)y - (int32_t)(last_y & 65536u),
                       (int32_t)z - (int32_t)(last_z & 65536u), more };
    return r;
}

/* The key of a box of up to 4^3. */
TBX_FORCED uint64_t tbx_block_key(const tbx_block *b, int i)
{
    return b->first[i] | (uint32_t)((b->more[i] & 0x03030300u) * 0x041040u) >> 26;
}

/* `more` of a box of any kind; extents above 63 are there as such. */
TBX_FORCED int32_t tbx_block_more(const tbx_block *b, int i)
{
    return (int32_t)(b->more[i] >> 8 | b->more[i] << 24);
}

TBX_FORCED int32_t tbx_key_more(uint64_t key)
{
    return (int32_t)((key & 3) | (key >> 2 & 3) << 8 | (key >> 4 & 3) << 16);
}

/* The voxels of a box of up to 4^3. */
TBX_FORCED uint64_t tbx_key_voxels(uint64_t key)
{
    return tbx_small_box((int)key & 3, (int)key & 12, (int)key & 48);
}

/* Puts triangle i of the block, with its box, into its class. */
TBX_FORCED void tbx_block_add(tbx_block *b, const tbx_quick *q, int i, tbx_i4 box)
{
    const uint32_t flags = (uint32_t)box[3] >> 24;
    const uint32_t more = (uint32_t)box[3] << 8 | (flags & (255u ^ TBX_BESIDE >> 24)); /* it has its class */
    const unsigned not_whole = TBX_ON_LATTICE >> 24 ^ 255; /* flags but that one: cut, or not known */
    const int is_again = (box[3] & (TBX_BESIDE | TBX_ON_LATTICE | TBX_IS_CUT | 0xf8f8f8)) == TBX_BESIDE;
    unsigned c = q->thin || (more & not_whole) != 0 ? (unsigned)TBX_CLASS_LARGE : tbx_class_of(more);
    if (is_again && q->precise && c > TBX_CLASS_PAIR && !q->thin) {
        c = TBX_CLASS_AGAIN;
    } else if ((box[3] & TBX_ON_LATTICE) != 0 && c > TBX_CLASS_PAIR) {
        c = q->upper_open || c == TBX_CLASS_LARGE ? (unsigned)TBX_CLASS_LARGE
            : c == TBX_CLASS_4                    ? (unsigned)TBX_CLASS_ON_4
                                                  : (unsigned)TBX_CLASS_ON_3;
    }
    b->first[i] = tbx_key_set(box) & ~(uint64_t)65535;
    b->more[i] = more;
    b->word[i] = tbx_first_word(q, b->first[i]);
    b->of[c] |= (uint64_t)1 << i;
}

/* OTHER boxes with care: those that are sure to their classes, those that are off the region to none. */
TBX_NOINLINE void tbx_block_careful(tbx_block *b, const tbx_quick *q, const tbx_corners *corners, int count,
                                    int is_near)
{
    const tbx_i4 magnitude = tbx_splat_int(0x7fffffff);
    const tbx_i4 far_bits = tbx_load4i(q->far_bits);
    uint64_t *other = &b->of[TBX_CLASS_OTHER];
    tbx_fixed f;
    int i;
    int j;
    int c;
    tbx_fixed_of(&f, q);
    for (i = 0; i < count; i += 4) {
        const unsigned some = (unsigned)(*other >> i) & 15u;
        tbx_i4 beyond = tbx_splat_int(0);
        tbx_four four;
        unsigned sure;
        unsigned off;
        for (c = 0; c < 3 && !is_near; c++) {
            for (j = i; j < i + 4; j++) {
                beyond |= ((tbx_i4)corners->row[c][j] & magnitude) > far_bits;
            }
        }
        if (some == 0 || tbx_any(beyond)) {
            continue;
        }
        tbx_four_find(&four, q, &f, corners, i, 1);
        off = ~(unsigned)tbx_signs(four.on) & some;
        if (off == some) {
            *other ^= (uint64_t)some << i;
            continue;
        }
        tbx_four_store(b, i, q, &f, &four);
        sure = (unsigned)tbx_signs(four.sure) & some;
        *other ^= (uint64_t)(sure | off) << i;
        for (j = i; sure != 0; j++, sure >>= 1) {
            if ((sure & 1u) != 0) {
                b->of[q->thin ? (unsigned)TBX_CLASS_LARGE : tbx_class_of(b->more[j])] |= (uint64_t)1 << j;
            }
        }
    }
    if (!q->short_axes) {
        tbx_block_words(b, q, count);
    }
}

#define TBX_LIST (TBX_BLOCK + TBX_WIDE)

/* Repeats a list's last one, so that WIDE can be taken. */
TBX_FORCED void tbx_list_end(unsigned char *list, int n)
{
    int i;
    for (i = n; i < n + TBX_WIDE && n > 0; i++) {
        list[i] = list[n - 1];
    }
}

/* The triangles of a class, in a list. */
TBX_FORCED int tbx_list_of(unsigned char *list, uint64_t of)
{
    int n = 0;
    for (; of != 0; of &= of - 1) {
        list[n++] = (unsigned char)__builtin_ctzll(of);
    }
    tbx_list_end(list, n);
    return n;
}

/* Lanes 1, 2, 3 of WIDE rows that are listed. */
TBX_FORCED void tbx_points_at(tbx_points *out, const tbx_f4 *row, const unsigned char *list)
{
    tbx_f4 x[TBX_WIDE / 4];
    tbx_f4 y[TBX_WIDE / 4];
    tbx_f4 z[TBX_WIDE / 4];
    int i;
    for (i = 0; i < TBX_WIDE / 4; i++, list += 4) {
        const tbx_f4 r0 = row[list[0]];
        const tbx_f4 r1 = row[list[1]];
        const tbx_f4 r2 = row[list[2]];
        const tbx_f4 r3 = row[list[3]];
        const tbx_f4 a = TBX_LANES(r0, r1, 0, 4, 1, 5);
        const tbx_f4 b = TBX_LANES(r2, r3, 0, 4, 1, 5);
        const tbx_f4 c = TBX_LANES(r0, r1, 2, 6, 3, 7);
        const tbx_f4 d = TBX_LANES(r2, r3, 2, 6, 3, 7);
        x[i] = TBX_LANES(a, b, 2, 3, 6, 7);
        y[i] = TBX_LANES(c, d, 0, 1, 4, 5);
        z[i] = TBX_LANES(c, d, 2, 3, 6, 7);
    }
    out->x = tbx_wide_of(x);
    out->y = tbx_wide_of(y);
    out->z = tbx_wide_of(z);
}

/* Corners of the WIDE triangles of a block that are listed. */
TBX_FORCED void tbx_points_listed(tbx_points out[3], const tbx_corners *corners, const unsigned char *list)
{
    tbx_points_at(&out[0], corners->row[0], list);
    tbx_points_at(&out[1], corners->row[1], list);
    tbx_points_at(&out[2], corners->row[2], list);
}

/* The first voxels of boxes in the region that are listed, as integers. */
TBX_FORCED void tbx_firsts_listed(tbx_iw out[3], const tbx_block *b, const unsigned char *list)
{
    const tbx_uw half = (tbx_uw)tbx_wide_int(16);
    tbx_f4 wx[TBX_WIDE / 4];
    tbx_f4 yz[TBX_WIDE / 4];
    int i;
    for (i = 0; i < TBX_WIDE / 4; i++, list += 4) {
        const tbx_l2 ab = { (int64_t)b->first[list[0]], (int64_t)b->first[list[1]] };
        const tbx_l2 cd = { (int64_t)b->first[list[2]], (int64_t)b->first[list[3]] };
        wx[i] = (tbx_f4)TBX_LOW_WORDS(ab, cd);
        yz[i] = (tbx_f4)TBX_HIGH_WORDS(ab, cd);
    }
    out[0] = (tbx_iw)((tbx_uw)tbx_wide_of(wx) >> half);
    out[1] = (tbx_iw)tbx_wide_of(yz) & tbx_wide_int(65535);
    out[2] = (tbx_iw)((tbx_uw)tbx_wide_of(yz) >> half);
}

/* ---- Boxes that take the careful way, WIDE at a time */

typedef struct tbx_boxes {
    tbx_iw first[3]; /* MARGIN added */
    tbx_iw last[3];
    tbx_iw cut;     /* negative: not all in the region, by the guess */
    tbx_iw unsure;  /* not 0: a face is too near to a grid plane */
    tbx_iw lattice; /* not 0: on some axis all corners are on the lattice */
} TBX_ALIGNED tbx_boxes;

TBX_FORCED tbx_iw tbx_box_round(tbx_fw x)
{
    const tbx_fw most = tbx_wide_all(TBX_MOST_INDEX);
    const tbx_fw clamped = tbx_wide_min(tbx_wide_max(x, -most), most);
    return __builtin_convertvector(clamped, tbx_iw);
}

/* The place next to x on axis k's lattice, in PARTS of a voxel from MARGIN voxels before the region. Clears
 * lanes of `on` where x is not there; its bits tell, but for the sign of 0. */
TBX_FORCED tbx_fw tbx_lattice_place(const tbx_quick *q, int k, tbx_fw x, tbx_iw *on)
{
    const tbx_fw parts = tbx_wide_all((float)TBX_PARTS);
    const tbx_fw guess = x * tbx_wide_all(q->inverse[k + 1]) + tbx_wide_all(q->shift_down[k]);
    const tbx_fw place = __builtin_convertvector(tbx_box_round(guess * parts + tbx_wide_all(0.5f)), tbx_fw);
    const tbx_fw first_plane = tbx_wide_all((float)((TBX_MARGIN + 1) * TBX_PARTS));
    tbx_fw there = tbx_wide_all(q->base_high[k + 1]) + (place - first_plane) * tbx_wide_all(q->step[k]);
    tbx_iw is_zero;
    TBX_KEEP_VECTOR(there);
    is_zero = (((tbx_iw)there | (tbx_iw)x) & tbx_wide_int(0x7fffffff)) == tbx_wide_int(0);
    *on &= ((tbx_iw)there == (tbx_iw)x) | is_zero;
    return place;
}

/* Index boxes on axis k, exactly where all corners are on the lattice. */
TBX_NOINLINE void tbx_box_axis(const tbx_quick *q, int k, tbx_fw x0, tbx_fw x1, tbx_fw x2, tbx_boxes *out)
{
    const tbx_fw inverse = tbx_wide_all(q->inverse[k + 1]);
    const tbx_fw down = tbx_wide_all(q->shift_down[k]);
    const tbx_fw up = tbx_wide_all(q->shift_up[k]);
    const tbx_fw low = tbx_wide_min(tbx_wide_min(x0, x1), x2) * inverse;
    const tbx_fw high = tbx_wide_max(tbx_wide_max(x0, x1), x2) * inverse;
    tbx_iw first = tbx_box_round(low + down);
    tbx_iw last = tbx_box_round(high + up);
    /* truncation is towards 0: below it is unsure, and cut; where the two guesses differ, a face is near */
    tbx_iw unsure = (first ^ tbx_box_round(low + up)) | (last ^ tbx_box_round(high + down));
    if (q->step[k] > 0.0f) {
        const tbx_iw to_voxels = tbx_wide_int(TBX_PARTS_LOG2);
        tbx_iw on = tbx_wide_int(-1);
        const tbx_fw p0 = tbx_lattice_place(q, k, x0, &on);
        const tbx_fw p1 = tbx_lattice_place(q, k, x1, &on);
        const tbx_fw p2 = tbx_lattice_place(q, k, x2, &on);
        const tbx_iw least = __builtin_convertvector(tbx_wide_min(tbx_wide_min(p0, p1), p2), tbx_iw);
        const tbx_iw most = __builtin_convertvector(tbx_wide_max(tbx_wide_max(p0, p1), p2), tbx_iw);
        first = tbx_wide_select(on, (least - tbx_wide_int(!q->upper_open)) >> to_voxels, first);
        last = tbx_wide_select(on, (most - tbx_wide_int(q->lower_open)) >> to_voxels, last);
        unsure &= ~on;
        out->lattice |= on;
    }
    out->unsure |= unsure;
    out->cut |= (first - tbx_wide_int(TBX_MARGIN)) | (tbx_wide_int(q->end[k]) - last);
    out->first[k] = first;
    out->last[k] = last;
}

/* Numbers that cannot overflow: those beyond q->most are moved there. */
TBX_FORCED tbx_fw tbx_box_tame(const tbx_quick *q, int k, tbx_fw x, tbx_iw *finite)
{
    const tbx_iw size = (tbx_iw)x & tbx_wide_int(0x7fffffff);
    const tbx_iw most = tbx_wide_int(q->far_bits[k + 1]);
    *finite &= size < tbx_wide_int(0x7f800000);
    return (tbx_fw)tbx_wide_select(size > most, most | ((tbx_iw)x & tbx_wide_int(TBX_SIGN_BIT)), (tbx_iw)x);
}

TBX_FORCED tbx_iw tbx_extents(const tbx_boxes *box)
{
    return (box->last[0] - box->first[0]) | tbx_wide_up(box->last[1] - box->first[1], 8) |
           tbx_wide_up(box->last[2] - box->first[2], 16);
}

#define TBX_ROWS 64
#define TBX_LAST_FIRST (65535 - TBX_ROWS) /* first voxels up to here are told from those before the region */

/* Boxes of the WIDE triangles listed. Lanes that are off the region, by the guess on that side, are OFF: X is
 * off by its bound at most within MARGIN, by 2^-20 of itself beyond; so are empty boxes, and triangles that
 * are not finite. */
TBX_NOINLINE void tbx_boxes_special(const tbx_quick *q, const tbx_corners *corners, const unsigned char *list,
                                    tbx_i4 out[TBX_WIDE])
{
    const tbx_iw none = tbx_wide_int(0);
    tbx_points v[3];
    tbx_boxes box;
    tbx_iw finite = tbx_wide_int(-1);
    tbx_iw off = none;
    tbx_iw other = none;
    tbx_iw beyond = none;
    tbx_iw last;
    int i;
    int k;
    tbx_points_listed(v, corners, list);
    for (i = 0; i < 3; i++) {
        v[i].x = tbx_box_tame(q, 0, v[i].x, &finite);
        v[i].y = tbx_box_tame(q, 1, v[i].y, &finite);
        v[i].z = tbx_box_tame(q, 2, v[i].z, &finite);
    }
    box.cut = box.lattice = box.unsure = none;
    tbx_box_axis(q, 0, v[0].x, v[1].x, v[2].x, &box);
    tbx_box_axis(q, 1, v[0].y, v[1].y, v[2].y, &box);
    tbx_box_axis(q, 2, v[0].z, v[1].z, v[2].z, &box);
    for (k = 0; k < 3; k++) {
        const tbx_iw extent = box.last[k] - box.first[k];
        off |= (box.last[k] - tbx_wide_int(TBX_MARGIN)) | (tbx_wide_int(q->end[k]) - box.first[k]) | extent;
        beyond |= (box.first[k] - tbx_wide_int(1)) | (tbx_wide_int(q->end[k] + TBX_MARGIN) - box.last[k]) |
                  (tbx_wide_int(TBX_LAST_FIRST + TBX_MARGIN) - box.first[k]);
        other |= extent;
    }
    other = (box.unsure != none) | (beyond < none) | ((other & tbx_wide_int(~(TBX_ROWS - 1))) != none);
    last = tbx_extents(&box) | (box.lattice & tbx_wide_int(TBX_ON_LATTICE)) |
           ((box.cut < none) & tbx_wide_int(TBX_IS_CUT));
    last = tbx_wide_select(other, tbx_wide_int(TBX_NOT_KNOWN), last);
    last = tbx_wide_select((off < none) | ~finite, tbx_wide_int(TBX_OFF), last);
    tbx_points_to(out, box.first[0] - tbx_wide_int(TBX_MARGIN), box.first[1] - tbx_wide_int(TBX_MARGIN),
                  box.first[2] - tbx_wide_int(TBX_MARGIN), last);
}

TBX_FN int tbx_is_hair(double x, double hair)
{
    return (x != 0.0) & tbx_more(hair, x) & tbx_more(x, -hair);
}

/* Voxels of a box's faces on the axes of lanes 1 to 3, faces that are beside a grid plane, and those that are
 * not sure: a bit for each lane. */
typedef struct tbx_faces {
    tbx_i4 voxel;
    unsigned beside;
    unsigned unsure;
} TBX_ALIGNED tbx_faces;

/* Two doubles of 0 to 2^21, truncated, in the lower lanes. */
TBX_FORCED tbx_i4 tbx_pair_to_int(tbx_d2 a)
{
#if defined(__SSE2__)
    return (tbx_i4)__builtin_ia32_cvttpd2dq(a);
#else
    const tbx_i4 r = { (int32_t)a[0], (int32_t)a[1], 0, 0 };
    return r;
#endif
}

TBX_FORCED tbx_d2 tbx_pair_of_ints(tbx_i4 a)
{
#if defined(__SSE2__) && !defined(__clang__)
    return __builtin_ia32_cvtdq2pd(a);
#else
    return tbx_pair((double)a[0], (double)a[1]);
#endif
}

/* The planes next to coordinates x of lanes `at` and at + 1 of four, in lanes 0 and 1, from 2^20 before the
 * region; -1 in lanes 0 and 2 of *out_below where x is below. Doubles are off by less than delta, the sum
 * with 2^20 by 2^-30. */
TBX_FORCED tbx_i4 tbx_faces_pair(tbx_faces *f, tbx_i4 *out_below, const tbx_quick *q, int at, tbx_d2 x)
{
    const double most = 1048576.0;
    const double off = 2.0 * q->delta + 1.0 / 1073741824.0;
    const tbx_d2 zero = { 0.0, 0.0 };
    const tbx_d2 half = { 0.5, 0.5 };
    const tbx_d2 middle = { most, most };
    const tbx_d2 end = { 2.0 * most, 2.0 * most };
    const tbx_d2 error = { off, off };
    tbx_d2 place = (x - tbx_load2(q->box_origin + at)) * tbx_load2(q->box_units + at) + middle;
    tbx_i4 i;
    tbx_d2 part;
    place = tbx_min2(tbx_max2(place, zero), end);
    TBX_KEEP_VECTOR(place);
    i = tbx_pair_to_int(place + half);
    part = place - tbx_pair_of_ints(i);
    f->beside |= (unsigned)tbx_signs2((tbx_l2)(tbx_abs2(part) < tbx_load2(q->beside + at))) << at;
    f->unsure |= (unsigned)tbx_signs2((tbx_l2)(tbx_abs2(part) <= error)) << at;
    *out_below = (tbx_i4)(part < zero);
    return i;
}

/* The voxels of three faces x, in lanes 1 to 3; beside planes exactly: `upper` the one above it, if it is on
 * it. */
TBX_FORCED void tbx_faces_find(tbx_faces *f, const tribox_grid *grid, const tbx_quick *q, const tbx_d2 x[2],
                               int upper)
{
    tbx_i4 below[2];
    tbx_i4 pair[2];
    tbx_i4 next;
    f->beside = f->unsure = 0;
    pair[0] = tbx_faces_pair(f, &below[0], q, 0, x[0]);
    pair[1] = tbx_faces_pair(f, &below[1], q, 2, x[1]);
    next = TBX_LANES(pair[0], pair[1], 0, 1, 4, 5) - tbx_splat_int(1048576);
    f->voxel = next + TBX_LANES(below[0], below[1], 0, 2, 4, 6);
    f->unsure &= 14u;
    if (f->unsure != 0) {
        double face[4];
        int32_t voxel[4];
        int32_t plane[4];
        TBX_COPY(face, x, sizeof face);
        TBX_COPY(voxel, &f->voxel, sizeof voxel);
        TBX_COPY(plane, &next, sizeof plane);
        for (; f->unsure != 0; f->unsure &= f->unsure - 1) {
            const int k = __builtin_ctz(f->unsure) - 1;
            const int32_t i = plane[k + 1];
            double rest;
            int side;
            if (q->precise &&
                tbx_rest(&q->halves[k], face[k + 1], (double)(i + grid->lo[k]) * TBX_PIECES, &rest)) {
                side = (rest < 0.0) - (rest > 0.0);
            } else {
                side = tbx_plane_compare(grid, k, i + grid->lo[k], face[k + 1]);
            }
            voxel[k + 1] = side < 0 || (side == 0 && upper) ? i : i - 1;
        }
        f->voxel = tbx_load4i(voxel);
    }
}

/* A box by its least and greatest coordinates, in lanes 1 to 3. */
TBX_NOINLINE tbx_i4 tbx_box_exact(const tribox_grid *grid, const tbx_quick *q, const tbx_d2 least[2],
                                const tbx_d2 most[2])
{
    const tbx_i4 n = { 1, q->n[0], q->n[1], q->n[2] };
    const tbx_i4 none = tbx_splat_int(0);
    const tbx_i4 margin = tbx_splat_int(TBX_MARGIN);
    tbx_faces first;
    tbx_faces last;
    tbx_i4 extent;
    tbx_i4 box;
    tbx_faces_find(&first, grid, q, least, q->upper_open);
    tbx_faces_find(&last, grid, q, most, !q->lower_open);
    extent = last.voxel - first.voxel;
    box = TBX_LANES(first.voxel, first.voxel, 1, 2, 3, 0);
    if (tbx_any((last.voxel < none) | (first.voxel >= n) | (extent < none))) {
        box[3] = TBX_OFF;
    } else if (tbx_any((extent >= tbx_splat_int(TBX_ROWS)) | (first.voxel <= -margin) |
                       (last.voxel >= n + margin - tbx_splat_int(1)) |
                       (first.voxel > tbx_splat_int(TBX_LAST_FIRST)))) {
        box[3] = TBX_NOT_KNOWN;
    } else {
        box[3] = extent[1] | extent[2] << 8 | extent[3] << 16 |
                 (tbx_any((last.voxel >= n) | (first.voxel < none)) ? TBX_IS_CUT : 0) |
                 (((first.beside | last.beside) & 14u) != 0 ? TBX_BESIDE : 0);
    }
    return box;
}

/* The same of any finite triangle. */
TBX_NOINLINE tbx_i4 tbx_box_slowly(const tribox_grid *grid, const tbx_quick *q, const tbx_source *source,
                                   size_t triangle)
{
    const tbx_i4 off = { 0, 0, 0, TBX_OFF };
    const tbx_i4 not_known = { 0, 0, 0, TBX_NOT_KNOWN };
    double v[3][3];
    tbx_d2 least[2];
    tbx_d2 most[2];
    const int kind = tbx_source_triangle(source, triangle, v);
    if (kind != TBX_ALL_ORDINARY) {
        return kind == TBX_NO_POINTS ? off : not_known;
    }
    least[0] = tbx_pair(0.0, tbx_min3(v[0][0], v[1][0], v[2][0]));
    least[1] = tbx_pair(tbx_min3(v[0][1], v[1][1], v[2][1]), tbx_min3(v[0][2], v[1][2], v[2][2]));
    most[0] = tbx_pair(0.0, tbx_max3(v[0][0], v[1][0], v[2][0]));
    most[1] = tbx_pair(tbx_max3(v[0][1], v[1][1], v[2][1]), tbx_max3(v[0][2], v[1][2], v[2][2]));
    return tbx_box_exact(grid, q, least, most);
}

/* Is an edge level but for a hair? "Rows" takes such an edge for one within a row, and it may be in two. */
TBX_NOINLINE int tbx_box_has_hair(const tribox_grid *grid, const tbx_source *source, size_t triangle)
{
    double v[3][3];
    int has = 0;
    int k;
    (void)tbx_source_triangle(source, triangle, v);
    for (k = 0; k < 3; k++) {
        const double hair = 1e-15 * grid->size[k];
        has |= tbx_is_hair(v[0][k] - v[1][k], hair) | tbx_is_hair(v[1][k] - v[2][k], hair) |
               tbx_is_hair(v[2][k] - v[0][k], hair);
    }
    return has;
}

/* A box and the extremes it was found by. */
typedef struct tbx_boxed {
    tbx_i4 box;
    tbx_f4 least;
    tbx_f4 most;
} TBX_ALIGNED tbx_boxed;

/* Box of triangle i of a block, by exact signs of corners against grid planes; the last one's where the
 * extremes are the same, as two triangles of a quad have them. */
TBX_FORCED void tbx_block_box(tbx_boxed *last, const tbx_block *b, const tribox_grid *grid,
                              const tbx_quick *q, const tbx_source *source, const tbx_corners *corners, int i)
{
    const tbx_i4 used = { 0, -1, -1, -1 };
    const tbx_i4 magnitude = { 0, 0x7fffffff, 0x7fffffff, 0x7fffffff };
    const tbx_i4 exponent = { 1, 0x7f800000, 0x7f800000, 0x7f800000 };
    const tbx_i4 other = { 1, 0, 0, 0 };
    const tbx_i4 none = tbx_splat_int(0);
    tbx_i4 v0 = (tbx_i4)corners->row[0][i] & used;
    tbx_i4 v1 = (tbx_i4)corners->row[1][i] & used;
    tbx_i4 v2 = (tbx_i4)corners->row[2][i] & used;
    const tbx_i4 all = (v0 | v1 | v2) & magnitude; /* no exponent is above this one's */
    /* 0 or subnormal, infinite or no number */
    if (q->is_double || tbx_any((((v0 | other) & exponent) == none) | (((v1 | other) & exponent) == none) |
                                (((v2 | other) & exponent) == none) | (all > tbx_splat_int(0x7f7fffff)))) {
        last->box = tbx_box_slowly(grid, q, source, b->start + (size_t)i);
        last->least = last->most = (tbx_f4)tbx_splat_int(-1); /* no number */
    } else {
        tbx_f4 low;
        tbx_f4 high;
        TBX_KEEP3(VECTOR, v0, v1, v2);
        low = tbx_min4(tbx_min4((tbx_f4)v0, (tbx_f4)v1), (tbx_f4)v2);
        high = tbx_max4(tbx_max4((tbx_f4)v0, (tbx_f4)v1), (tbx_f4)v2);
        if (tbx_any(((tbx_i4)low != (tbx_i4)last->least) | ((tbx_i4)high != (tbx_i4)last->most))) {
            tbx_d2 least[2];
            tbx_d2 most[2];
            tbx_widen4(&least[0], &least[1], low);
            tbx_widen4(&most[0], &most[1], high);
            last->least = low;
            last->most = high;
            last->box = tbx_box_exact(grid, q, least, most);
        }
    }
    if (last->box[3] >= 0 && (q->thin | ((last->box[3] & (TBX_IS_CUT | 0xf8f8f8)) != 0) | !q->precise) &&
        !q->is_double && tbx_box_has_hair(grid, source, b->start + (size_t)i)) {
        last->box[3] = TBX_NOT_KNOWN;
        last->least = (tbx_f4)tbx_splat_int(-1);
    }
}

/* Boxes of the triangles that are not as simple as can be; those that are not known are LARGE. Returns how
 * many are on the lattice, or beside a plane. */
TBX_NOINLINE int tbx_block_special(tbx_block *b, const tribox_grid *grid, const tbx_quick *q,
                                   const tbx_source *source, const tbx_corners *corners)
{
    unsigned char list[TBX_LIST];
    const int count = tbx_list_of(list, b->of[TBX_CLASS_OTHER]);
    tbx_boxed last;
    int on_planes = 0;
    int i;
    int j;
    last.box = tbx_splat_int(TBX_OFF);
    last.least = last.most = (tbx_f4)tbx_splat_int(-1);
    for (i = 0; i < count; i += TBX_WIDE) {
        tbx_i4 box[TBX_WIDE];
        if (q->lattice) {
            tbx_boxes_special(q, corners, list + i, box);
        }
        for (j = 0; j < TBX_WIDE && i + j < count; j++) {
            if (!q->lattice || box[j][3] == TBX_NOT_KNOWN) {
                tbx_block_box(&last, b, grid, q, source, corners, list[i + j]);
                box[j] = last.box;
            }
            if (box[j][3] != TBX_OFF) {
                tbx_block_add(b, q, list[i + j], box[j]);
                on_planes += box[j][3] != TBX_NOT_KNOWN && (box[j][3] & (TBX_ON_LATTICE | TBX_BESIDE)) != 0;
            }
        }
    }
    return on_planes;
}

/* What a block tells the next one about: boxes that were mostly beside grid planes, or all off the region; or
 * that its doubles were to be floats, and are not, so that it has to be done again. */
enum { TBX_HABIT_NONE, TBX_HABIT_PLANES, TBX_HABIT_OFF, TBX_HABIT_NO_FLOATS };

/* Boxes of so many triangles from the first, BLOCK at most, by class; none where they are NO_FLOATS. By
 * *habit all are found with care at once. */
TBX_NOINLINE void tbx_block_find(tbx_block *b, tbx_corners *corners, const tribox_grid *grid,
                                 const tbx_quick *q, const tbx_source *source, size_t first, int count,
                                 int *habit)
{
    const int is_near = tbx_block_load(corners, q, source, first, count);
    uint64_t found = 0;
    int on_planes = 0;
    int c;
    for (c = 0; c < TBX_CLASSES; c++) {
        b->of[c] = 0;
        TBX_KEEP_POINTER(b); /* or gcc calls for the slow start of a string instruction */
    }
    b->start = first;
    b->same = 0;
    if (is_near < 0) {
        *habit = TBX_HABIT_NO_FLOATS;
        return;
    }
    b->of[TBX_CLASS_OTHER] = ~(uint64_t)0 >> (64 - count);
    if (is_near && *habit == TBX_HABIT_NONE) {
        tbx_block_boxes(b, q, corners, count);
    }
    if (b->of[TBX_CLASS_OTHER] != 0) {
        if (*habit != TBX_HABIT_PLANES) {
            tbx_block_careful(b, q, corners, count, is_near);
        }
        on_planes = tbx_block_special(b, grid, q, source, corners);
    }
    for (c = 0; c < TBX_CLASSES; c++) {
        found |= b->of[c];
    }
    *habit = 2 * on_planes > count ? TBX_HABIT_PLANES : found == 0 ? TBX_HABIT_OFF : TBX_HABIT_NONE;
}

/* ---- Groups: boxes of up to n^3 voxels, n = 2, 3 or 4
 *
 * Decided as "Boxes of up to 4^3 voxels" in section 8, by the signs of E and D at inner grid points p, here
 * 1 <= p_b, p_c <= n - 1 for every box of the class: points on or beyond the far faces of a box smaller than
 * n^3 separate nothing that is in it, truly.
 *
 * Bounds, delta = delta(n) >= PLACED_ERROR n, |v| <= n - 1 as computed; tests/proofs/groups.gappa has the
 * rounding:
 *   E     The coordinates 4 (n - 1) delta. Rounding, in units of u: 4 (n - 1)^2 at the first point, 2 n and
 *         4 (n - 1)^2 for each of at most n - 2 steps on both axes: at most 4, 38, 124 for n = 2, 3, 4, which
 *         is 0.5, 3.2, 7.8 delta. Where the sign of d_c is wrong, |d_c| <= 2 delta + u n; since the triangle
 *         meets the plane c = p_c, |E| is at most |d_c| n then, 2.3 n delta. Beyond a far face it need not
 *         meet it; but then |E| above another 2.3 n delta makes the sign of d_b right, and the cell that is
 *         missed lies beyond that face. In all less than GROUP_EDGE_ERROR n delta.
 *   area  The sum of three E at the first point: 4 n delta and 20 (n - 1)^2 u, less than that.
 *   D     The normal's 7 n delta times n, three times; its n^2 times delta, three times; rounding
 *         (8 + 9 (n - 2)) n^3 u: less than GROUP_PLANE_ERROR n^2 delta. The signs of n are those of the
 *         areas, and sure.
 * What is left covers second-order terms. No value is NaN: a sure box has finite corners within it.
 *
 * On the lattice, closed boxes only: a triangle lies strictly inside its box here, too, and at a point of
 * E = 0 or D = 0 nothing is missed. With a step of q = 1 / PARTS, E is a multiple of q^2; E + q^2 / 2 is
 * outside where E < 0, and beyond the bound. An area of 0 may have any sign: its edges run to and fro, and
 * bound the segment from both sides; the plane then says what they say. All of it is exact in floats: corners
 * are up to 3 voxels off, areas up to 2^14 q^2, D up to 2^21 q^3. Where a triangle is level on an axis on the
 * lattice, E is 0 at the inner points of its box in the planes of that axis, whatever the other one is. */

#define TBX_GROUP_EDGE_ERROR 12.0f
#define TBX_GROUP_PLANE_ERROR 32.0f

/* Coordinates of one axis from the first inner grid plane of box `first`. */
TBX_FORCED void tbx_group_place(const tbx_quick *q, int k, tbx_iw first, tbx_fw *x0, tbx_fw *x1, tbx_fw *x2)
{
    const tbx_fw at = __builtin_convertvector(first, tbx_fw);
    const tbx_fw inverse = tbx_wide_all(q->inverse[k + 1]);
    const tbx_fw size_low = tbx_wide_all(q->size_low[k + 1]);
    const tbx_fw size_high = tbx_wide_all(q->size_high[k + 1]);
    const tbx_fw low = tbx_wide_all(q->base_low[k + 1]) + at * size_low;
    tbx_fw high = tbx_wide_all(q->base_high[k + 1]) + at * size_high;
    TBX_KEEP_VECTOR(high);
    *x0 -= high;
    *x1 -= high;
    *x2 -= high;
    TBX_KEEP3(VECTOR, *x0, *x1, *x2);
    *x0 = (*x0 - low) * inverse;
    *x1 = (*x1 - low) * inverse;
    *x2 = (*x2 - low) * inverse;
    TBX_KEEP3(VECTOR, *x0, *x1, *x2);
}

/* The triangles that a kernel decides: so many of a list of a block's. */
typedef struct tbx_some {
    const tbx_block *block;
    const tbx_corners *corners;
    const unsigned char *list;
    int count; /* 1 to WIDE */
} tbx_some;

/* Notes that E = e at a point, and whether it is outside, as `bit`. */
TBX_FORCED void tbx_note_point(tbx_uw *outside, tbx_fw *least, tbx_fw e, int bit)
{
    *least = tbx_wide_min(*least, tbx_wide_abs(e));
    *outside |= (tbx_uw)(tbx_wide_sign(e) & tbx_wide_int((int32_t)((uint32_t)1 << bit)));
}

TBX_FORCED tbx_uw tbx_wide_shift(tbx_uw a, int bits)
{
    return a << (tbx_uw)tbx_wide_int(bits);
}

/* Moves what is noted by so many bits where `up`. */
TBX_FORCED tbx_uw tbx_note_move(tbx_uw a, tbx_iw up, int bits)
{
    if (bits == 1) {
        return a + (a & (tbx_uw)up);
    } else {
        return ((tbx_uw)up & tbx_wide_shift(a, bits)) | (a & ~(tbx_uw)up);
    }
}

/* A triangle in the plane of axes b and c, from the first inner point. */
typedef struct tbx_outline {
    tbx_fw b[3];
    tbx_fw c[3];
    tbx_fw touch; /* |E| up to which an edge touches */
    tbx_fw least; /* of |E| and |area| */
    tbx_iw s;     /* the area's sign bit */
} TBX_ALIGNED tbx_outline;

/* The edge from v_i to v_j, E = e at the first inner point. Returns the cells it misses in the plane: bit
 * x stride_b + y stride_c. */
TBX_FORCED tbx_uw tbx_note_edge(tbx_outline *p, tbx_fw e, int i, int j, int n, int stride_b, int stride_c)
{
    tbx_fw *const least = &p->least;
    const tbx_fw e00 = tbx_wide_flip(e, p->s) + p->touch;
    const tbx_fw from_b = tbx_wide_flip(p->c[j] - p->c[i], p->s);
    const tbx_fw to_c = tbx_wide_flip(p->b[j] - p->b[i], p->s);
    const tbx_iw up_b = ~tbx_wide_sign(from_b);
    const tbx_iw up_c = tbx_wide_sign(to_c);
    tbx_uw m = (tbx_uw)tbx_wide_int(0);
    tbx_fw e10;
    tbx_fw e01;
    tbx_fw e11;
    if (n == 2) { /* one point has four cells */
        const int32_t b0 = 1 | 1 << stride_c;
        const int32_t c0 = 1 | 1 << stride_b;
        const tbx_iw sign = tbx_wide_int(31);
        const tbx_iw at_b =
            (((tbx_iw)from_b >> sign) & tbx_wide_int(b0 ^ b0 << stride_b)) ^ tbx_wide_int(b0 << stride_b);
        const tbx_iw at_c = (((tbx_iw)to_c >> sign) & tbx_wide_int(c0 ^ c0 << stride_c)) ^ tbx_wide_int(c0);
        *least = tbx_wide_min(*least, tbx_wide_abs(e00));
        return (tbx_uw)(at_b & at_c & ((tbx_iw)e00 >> sign));
    }
    e10 = e00 - from_b;
    e01 = e00 + to_c;
    e11 = e10 + to_c;
    tbx_note_point(&m, least, e00, 0);
    tbx_note_point(&m, least, e10, stride_b);
    tbx_note_point(&m, least, e01, stride_c);
    tbx_note_point(&m, least, e11, stride_b + stride_c);
    if (n > 3) {
        const tbx_fw e20 = e10 - from_b;
        const tbx_fw e21 = e20 + to_c;
        tbx_note_point(&m, least, e20, 2 * stride_b);
        tbx_note_point(&m, least, e21, 2 * stride_b + stride_c);
        tbx_note_point(&m, least, e21 + to_c, 2 * stride_b + 2 * stride_c);
        tbx_note_point(&m, least, e01 + to_c, 2 * stride_c);
        tbx_note_point(&m, least, e11 + to_c, stride_b + 2 * stride_c);
    }
    return tbx_note_move(tbx_note_move(m, up_b, stride_b), up_c, stride_c);
}

/* The cells that the three edges miss. Returns twice the area in the plane. */
TBX_FORCED tbx_fw tbx_note_edges(tbx_uw *missed, tbx_outline *p, int n, int stride_b, int stride_c)
{
    tbx_fw e0 = p->b[0] * p->c[1] - p->c[0] * p->b[1];
    tbx_fw e1 = p->b[1] * p->c[2] - p->c[1] * p->b[2];
    tbx_fw e2 = p->b[2] * p->c[0] - p->c[2] * p->b[0];
    tbx_fw area;
    TBX_KEEP3(VECTOR, e0, e1, e2);
    area = (e0 + e1) + e2;
    p->s = (tbx_iw)area & tbx_wide_int(TBX_SIGN_BIT);
    p->least = tbx_wide_min(tbx_wide_all(1.0f), tbx_wide_abs(area) + p->touch);
    *missed = tbx_note_edge(p, e0, 0, 1, n, stride_b, stride_c);
    *missed |= tbx_note_edge(p, e1, 1, 2, n, stride_b, stride_c);
    *missed |= tbx_note_edge(p, e2, 2, 0, n, stride_b, stride_c);
    return area;
}

/* The same of boxes of 3 and 4 voxels, out of line: three planes, on the lattice or not, have one code. */
TBX_NOINLINE tbx_fw tbx_note_edges3(tbx_uw *missed, tbx_outline *p)
{
    return tbx_note_edges(missed, p, 3, 1, 4);
}

TBX_NOINLINE tbx_fw tbx_note_edges4(tbx_uw *missed, tbx_outline *p)
{
    return tbx_note_edges(missed, p, 4, 1, 4);
}

TBX_FORCED tbx_fw tbx_note_edges_of(tbx_uw *missed, tbx_outline *p, int n)
{
    return n == 2   ? tbx_note_edges(missed, p, 2, 1, 4)
           : n == 3 ? tbx_note_edges3(missed, p)
                    : tbx_note_edges4(missed, p);
}

TBX_FORCED const tbx_fw *tbx_axis_of(const tbx_points *p, int k)
{
    return k == 0 ? &p->x : k == 1 ? &p->y : &p->z;
}

/* Corners v in the plane of axes b and c. */
TBX_FORCED void tbx_outline_of(tbx_outline *p, const tbx_points v[3], int b, int c)
{
    p->b[0] = *tbx_axis_of(&v[0], b);
    p->b[1] = *tbx_axis_of(&v[1], b);
    p->b[2] = *tbx_axis_of(&v[2], b);
    p->c[0] = *tbx_axis_of(&v[0], c);
    p->c[1] = *tbx_axis_of(&v[1], c);
    p->c[2] = *tbx_axis_of(&v[2], c);
    p->touch = tbx_wide_all(0.0f);
}

/* The plane at the inner points of WIDE boxes: bit x + 4 y + 16 z. */
typedef struct tbx_sides {
    tbx_uw below[2]; /* D < 0, of layers 0 and 1, and of layer 2 */
    tbx_uw above[2];
    tbx_fw least; /* of |D| */
    tbx_fw touch; /* |D| up to which the plane touches */
} TBX_ALIGNED tbx_sides;

TBX_FORCED void tbx_note_side(tbx_sides *p, tbx_fw d, int lattice, int x, int y, int z)
{
    const tbx_iw bit = tbx_wide_int((int32_t)((uint32_t)1 << (x + 4 * y + 16 * (z & 1))));
    const tbx_fw size = tbx_wide_abs(d);
    p->least = tbx_wide_min(p->least, size);
    if (lattice) {
        const tbx_iw apart = (size > p->touch) & bit;
        p->below[z >> 1] |= (tbx_uw)(tbx_wide_sign(d) & apart);
        p->above[z >> 1] |= (tbx_uw)(~tbx_wide_sign(d) & apart);
    } else {
        p->below[z >> 1] |= (tbx_uw)(tbx_wide_sign(d) & bit);
    }
}

TBX_FORCED void tbx_note_row(tbx_sides *p, tbx_fw d, tbx_fw n_x, int lattice, int n, int y, int z)
{
    tbx_note_side(p, d, lattice, 0, y, z);
    if (n > 2) {
        const tbx_fw d1 = d - n_x;
        tbx_note_side(p, d1, lattice, 1, y, z);
        if (n > 3) {
            tbx_note_side(p, d1 - n_x, lattice, 2, y, z);
        }
    }
}

/* D = d at the first inner point, n its gradient, turned round. */
TBX_FORCED void tbx_note_plane(tbx_sides *p, tbx_fw d, const tbx_points *normal, int lattice, int n)
{
    const tbx_fw n_x = normal->x;
    const tbx_fw n_y = normal->y;
    const tbx_fw n_z = normal->z;
    p->least = tbx_wide_abs(d);
    p->below[0] = p->below[1] = p->above[0] = p->above[1] = (tbx_uw)tbx_wide_int(0);
    tbx_note_row(p, d, n_x, lattice, n, 0, 0);
    if (n > 2) {
        const tbx_fw d10 = d - n_y;
        const tbx_fw d01 = d - n_z;
        const tbx_fw d11 = d10 - n_z;
        tbx_note_row(p, d10, n_x, lattice, n, 1, 0);
        tbx_note_row(p, d01, n_x, lattice, n, 0, 1);
        tbx_note_row(p, d11, n_x, lattice, n, 1, 1);
        if (n > 3) {
            const tbx_fw d20 = d10 - n_y;
            const tbx_fw d21 = d20 - n_z;
            tbx_note_row(p, d20, n_x, lattice, n, 2, 0);
            tbx_note_row(p, d21, n_x, lattice, n, 2, 1);
            tbx_note_row(p, d01 - n_z, n_x, lattice, n, 0, 2);
            tbx_note_row(p, d11 - n_z, n_x, lattice, n, 1, 2);
            tbx_note_row(p, d21 - n_z, n_x, lattice, n, 2, 2);
        }
    }
}

/* Corners of a group from the first inner grid point, and |E| (in the planes xy, yz, zx) and |D| up to which
 * an edge and the plane touch; lanes `plane_sure` are sure of D. */
typedef struct tbx_group_placed {
    tbx_points v[3];
    tbx_fw touch[3];
    tbx_fw touch_plane;
    tbx_iw plane_sure;
} TBX_ALIGNED tbx_group_placed;

/* Corners of a group's triangles, and their boxes. */
TBX_FORCED void tbx_group_corners(tbx_points out_v[3], tbx_points *out_first, tbx_iw *out_extents,
                                  const tbx_group *g, const tbx_source *source)
{
    tbx_load_corners(out_v, source, g->triangle);
    tbx_points_from(out_first, out_extents, g->box);
}

/* Coordinates on axis k of corners v from the first inner grid plane, exactly where they are on the lattice.
 * Returns these lanes, in out_level those in which all three are the same. */
TBX_FORCED tbx_iw tbx_group_snap(const tbx_quick *q, int k, tbx_iw first, const tbx_points v[3],
                                 tbx_points out[3], tbx_iw *out_level)
{
    const tbx_fw at = __builtin_convertvector(first, tbx_fw) + tbx_wide_all((float)(TBX_MARGIN + 1));
    const tbx_fw part = tbx_wide_all(1.0f / TBX_PARTS);
    tbx_iw on = tbx_wide_int(q->step[k] > 0.0f ? -1 : 0);
    tbx_fw p[3];
    int i;
    for (i = 0; i < 3; i++) {
        p[i] = tbx_lattice_place(q, k, *tbx_axis_of(&v[i], k), &on) * part - at;
    }
    for (i = 0; i < 3; i++) {
        tbx_fw *const x = k == 0 ? &out[i].x : k == 1 ? &out[i].y : &out[i].z;
        *x = tbx_wide_choose(on, p[i], *x);
    }
    *out_level = (p[0] == p[1]) & (p[1] == p[2]) & on;
    return on;
}

/* The lanes in which a triangle is a segment in a plane, of those on the lattice on both axes, and of those
 * level on one; and |E| up to which an edge touches there. */
TBX_FORCED tbx_iw tbx_group_flat(tbx_group_placed *p, int b, int c, const tbx_iw on_axis[3],
                                 const tbx_iw level_axis[3])
{
    const tbx_iw on = on_axis[b] & on_axis[c];
    const tbx_iw level = level_axis[b] | level_axis[c];
    const tbx_fw half = tbx_wide_all(0.5f / (TBX_PARTS * TBX_PARTS));
    tbx_outline o;
    tbx_fw area;
    tbx_outline_of(&o, p->v, b, c);
    area = (o.b[1] - o.b[0]) * (o.c[2] - o.c[0]) - (o.c[1] - o.c[0]) * (o.b[2] - o.b[0]);
    p->touch[b] = tbx_wide_where(on | level, half);
    return ((area == tbx_wide_all(0.0f)) & on) | level;
}

TBX_NOINLINE void tbx_group_on_lattice(const tbx_quick *q, const tbx_some *some, tbx_group_placed *p)
{
    tbx_points v[3];
    tbx_iw first[3];
    tbx_iw level[3];
    tbx_iw on[3];
    tbx_iw flat;
    int k;
    tbx_points_listed(v, some->corners, some->list);
    tbx_firsts_listed(first, some->block, some->list);
    for (k = 0; k < 3; k++) {
        on[k] = tbx_group_snap(q, k, first[k], v, p->v, &level[k]);
    }
    flat = tbx_group_flat(p, 0, 1, on, level) | tbx_group_flat(p, 1, 2, on, level) |
           tbx_group_flat(p, 2, 0, on, level);
    p->plane_sure = flat | (on[0] & on[1] & on[2]);
    p->touch_plane = tbx_wide_where(flat, tbx_wide_all(TBX_MOST_INDEX));
}

/* Lanes of two halves, as 64 bits. */
TBX_FORCED void tbx_halves_to(uint64_t out[TBX_WIDE], tbx_uw low, tbx_uw high)
{
    tbx_f4 l[TBX_WIDE / 4];
    tbx_f4 h[TBX_WIDE / 4];
    int i;
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    const tbx_uw swapped = low;
    low = high;
    high = swapped;
#endif
    tbx_wide_parts(l, (tbx_fw)low);
    tbx_wide_parts(h, (tbx_fw)high);
    for (i = 0; i < TBX_WIDE / 4; i++) {
        const tbx_f4 first = TBX_LANES(l[i], h[i], 0, 4, 1, 5);
        const tbx_f4 second = TBX_LANES(l[i], h[i], 2, 6, 3, 7);
        TBX_COPY(out + 4 * i, &first, sizeof first);
        TBX_COPY(out + 4 * i + 2, &second, sizeof second);
    }
}

/* Cells of two layers of a plane, bits b + 4 c of 2^3..2^7 of WIDE boxes, to bits b + 16 c; c from `layer`
 * on. */
TBX_FORCED tbx_uw tbx_cells_apart(tbx_uw cells, int layer)
{
    const tbx_uw pair = layer == 0 ? cells : cells >> (tbx_uw)tbx_wide_int(4 * layer);
    return (pair | tbx_wide_shift(pair, 12)) & (tbx_uw)tbx_wide_int(0x000f000f);
}

/* Missed voxels of two layers from those of the planes: xy for each z, zx for each y, yz for each x. */
TBX_FORCED tbx_uw tbx_cells_join(tbx_uw xy, tbx_uw yz, tbx_uw zx, int layer)
{
    tbx_uw x = tbx_cells_apart(zx, layer);
    tbx_uw y = tbx_cells_apart(yz, layer);
    x |= tbx_wide_shift(x, 4);
    x |= tbx_wide_shift(x, 8);
    y = (y | tbx_wide_shift(y, 6)) & (tbx_uw)tbx_wide_int(0x03030303);
    y = (y | tbx_wide_shift(y, 3)) & (tbx_uw)tbx_wide_int(0x11111111);
    y = tbx_wide_shift(y, 4) - y;
    return xy | tbx_wide_shift(xy, 16) | x | y;
}

/* Corners from the first inner grid planes. */
TBX_FORCED void tbx_some_place(tbx_points v[3], const tbx_quick *q, const tbx_some *some)
{
    tbx_iw first[3];
    tbx_points_listed(v, some->corners, some->list);
    tbx_firsts_listed(first, some->block, some->list);
    tbx_group_place(q, 0, first[0], &v[0].x, &v[1].x, &v[2].x);
    tbx_group_place(q, 1, first[1], &v[0].y, &v[1].y, &v[2].y);
    tbx_group_place(q, 2, first[2], &v[0].z, &v[1].z, &v[2].z);
}

/* The cell that the plane misses at the one inner point of 2^3 voxels. */
TBX_FORCED tbx_uw tbx_plane_cell(tbx_fw d, const tbx_points *normal)
{
    const tbx_iw sign = tbx_wide_int(31);
    const tbx_iw x = ((tbx_iw)d ^ (tbx_iw)normal->x) >> sign;
    const tbx_iw y = ((tbx_iw)d ^ (tbx_iw)normal->y) >> sign;
    const tbx_iw z = ((tbx_iw)d ^ (tbx_iw)normal->z) >> sign;
    return (tbx_uw)(((x & tbx_wide_int(0x330033)) ^ tbx_wide_int(0x110011)) &
                    ((y & tbx_wide_int(0x330033)) ^ tbx_wide_int(0x030003)) &
                    ((z & tbx_wide_int(0x330033)) ^ tbx_wide_int(0x000033)));
}

/* The voxels of boxes of up to n^3, as bits x + 4 y + 16 z. Returns a bit for each lane that is unsure. */
TBX_FORCED unsigned tbx_decide(uint64_t out[TBX_WIDE], const tbx_quick *q, const tbx_some *some, int n,
                               int lattice)
{
    const float delta = TBX_PLACED_ERROR * (float)n + q->delta_low;
    const tbx_fw edge_error = tbx_wide_all(TBX_GROUP_EDGE_ERROR * (float)n * delta);
    const tbx_fw plane_error = tbx_wide_all(TBX_GROUP_PLANE_ERROR * (float)(n * n) * delta);
    const tbx_uw none = (tbx_uw)tbx_wide_int(0);
    uint64_t missed[TBX_WIDE];
    uint64_t below[TBX_WIDE];
    uint64_t above[TBX_WIDE];
    uint32_t octant[TBX_WIDE];
    tbx_group_placed p;
    tbx_points normal;
    tbx_sides side;
    tbx_uw plane[3];
    tbx_uw cells[2];
    tbx_outline xy;
    tbx_outline yz;
    tbx_outline xz; /* seen from behind: its area is the normal's y turned round */
    tbx_fw d;
    tbx_iw unsure;
    tbx_uw octants;
    int i;
    tbx_some_place(p.v, q, some);
    p.touch_plane = tbx_wide_all(0.0f);
    p.plane_sure = (tbx_iw)none;
    if (lattice) {
        tbx_group_placed on_lattice = p;
        tbx_group_on_lattice(q, some, &on_lattice);
        p = on_lattice;
    }
    side.touch = p.touch_plane;
    tbx_outline_of(&xy, p.v, 0, 1);
    tbx_outline_of(&yz, p.v, 1, 2);
    tbx_outline_of(&xz, p.v, 0, 2);
    if (lattice) {
        xy.touch = p.touch[0];
        yz.touch = p.touch[1];
        xz.touch = p.touch[2];
    }
    normal.z = tbx_note_edges_of(&plane[0], &xy, n);
    normal.x = tbx_note_edges_of(&plane[1], &yz, n);
    normal.y = -tbx_note_edges_of(&plane[2], &xz, n);
    d = (normal.x * p.v[0].x + normal.y * p.v[0].y) + normal.z * p.v[0].z;
    cells[0] = tbx_cells_join(plane[0], plane[1], plane[2], 0);
    cells[1] = n > 2 ? tbx_cells_join(plane[0], plane[1], plane[2], 2) : none;
    unsure = tbx_wide_min(tbx_wide_min(xy.least, yz.least), xz.least) <= edge_error;
    if (n == 2 && !lattice) {
        tbx_halves_to(out, ~(cells[0] | tbx_plane_cell(d, &normal)) & (tbx_uw)tbx_wide_int(0x330033), none);
        return tbx_wide_signs(unsure | (tbx_wide_abs(d) <= plane_error));
    }
    tbx_note_plane(&side, d, &normal, lattice, n);
    unsure |= (side.least <= plane_error) & ~p.plane_sure;
    octants =
        (tbx_uw)((tbx_wide_sign(normal.x) & tbx_wide_int(1)) | (tbx_wide_sign(normal.y) & tbx_wide_int(4)) |
                 (tbx_wide_sign(normal.z) & tbx_wide_int(16)));
    TBX_COPY(octant, &octants, sizeof octant);
    tbx_halves_to(missed, cells[0], cells[1]);
    tbx_halves_to(below, side.below[0], side.below[1]);
    if (lattice) {
        tbx_halves_to(above, side.above[0], side.above[1]);
    }
    for (i = 0; i < TBX_WIDE; i++) {
        const uint64_t points = n == 2 ? 1 : n == 3 ? 0x330033u : (uint64_t)0x777 << 32 | 0x07770777u;
        const uint64_t over = lattice ? above[i] : below[i] ^ points;
        const uint64_t plane_missed = over << octant[i] | below[i] << (21u ^ octant[i]);
        out[i] = ~(missed[i] | plane_missed) & tbx_key_voxels(tbx_block_key(some->block, some->list[i]));
    }
    return tbx_wide_signs(unsure);
}

/* The same for boxes of 2x2x1 voxels, one thick on an axis: the edges in the plane of the others are all that
 * can miss any. */
TBX_FORCED unsigned tbx_decide_flat(uint64_t out[TBX_WIDE], const tbx_quick *q, const tbx_some *some,
                                    int thin)
{
    const float delta = TBX_PLACED_ERROR * 2.0f + q->delta_low;
    const int b = thin == 0 ? 4 : 1; /* strides of the two axes */
    const int c = thin == 2 ? 4 : 16;
    const uint32_t all = 1u | 1u << b | 1u << c | 1u << (b + c);
    tbx_points v[3];
    tbx_outline p;
    tbx_uw missed;
    tbx_some_place(v, q, some);
    tbx_outline_of(&p, v, thin == 0, thin == 2 ? 1 : 2);
    (void)tbx_note_edges(&missed, &p, 2, b, c);
    tbx_halves_to(out, ~missed & (tbx_uw)tbx_wide_int((int32_t)all), (tbx_uw)tbx_wide_int(0));
    return tbx_wide_signs(p.least <= tbx_wide_all(TBX_GROUP_EDGE_ERROR * 2.0f * delta));
}

/* Each out of line: in one function gcc has fewer registers for each, and fills take 1.02 times as long. */
#define TBX_DECIDES(name, call)                                                                  \
    TBX_NOINLINE unsigned name(uint64_t out[TBX_WIDE], const tbx_quick *q, const tbx_some *some) \
    {                                                                                            \
        return call;                                                                             \
    }
TBX_DECIDES(tbx_decide_flat_x, tbx_decide_flat(out, q, some, 0))
TBX_DECIDES(tbx_decide_flat_y, tbx_decide_flat(out, q, some, 1))
TBX_DECIDES(tbx_decide_flat_z, tbx_decide_flat(out, q, some, 2))
TBX_DECIDES(tbx_decide2, tbx_decide(out, q, some, 2, 0))
TBX_DECIDES(tbx_decide3, tbx_decide(out, q, some, 3, 0))
TBX_DECIDES(tbx_decide4, tbx_decide(out, q, some, 4, 0))
TBX_DECIDES(tbx_decide_on_3, tbx_decide(out, q, some, 3, 1))
TBX_DECIDES(tbx_decide_on_4, tbx_decide(out, q, some, 4, 1))

/* Decides by class, FLAT_X to ON_4. */
TBX_FN unsigned tbx_decide_class(uint64_t out[TBX_WIDE], const tbx_quick *q, const tbx_some *some, unsigned c)
{
    switch (c) {
    case TBX_CLASS_FLAT_X: return tbx_decide_flat_x(out, q, some);
    case TBX_CLASS_FLAT_Y: return tbx_decide_flat_y(out, q, some);
    case TBX_CLASS_FLAT_Z: return tbx_decide_flat_z(out, q, some);
    case TBX_CLASS_2: return tbx_decide2(out, q, some);
    case TBX_CLASS_3: return tbx_decide3(out, q, some);
    case TBX_CLASS_4: return tbx_decide4(out, q, some);
    case TBX_CLASS_ON_3: return tbx_decide_on_3(out, q, some);
    default: return tbx_decide_on_4(out, q, some);
    }
}

/* ---- Groups again, precisely
 *
 * Triangles that a group is unsure of mostly have corners near grid planes, or near places that cut a voxel
 * into few parts: decimals, in a grid of decimals. Here boxes have up to FEW voxels on each axis, and a
 * coordinate is P + r, in PIECES of a voxel from the first inner grid plane: P whole, r the rest, right to
 * REST_ERROR, as in tbx_walk_place. Then
 *
 *   E = P_i x P_j + G,  G = P_bi r_cj - r_ci v_bj + r_bi v_cj - P_ci r_bj,  v = P + r
 *   D = N . P + (N . r + M . v)
 *
 * N and M the whole and the other part of the normal, sums of those of E. From one grid point to the next
 * either part of E and of D steps by as much; the whole parts stay exact, P is at most FEW PIECES = 320, E's
 * 2^18 and D's 2^28.
 *
 * Error of G, S the sum of both corners' |r| on both axes, in units of 320 u S: rests are right to 16 u, v
 * and products add 3, three sums 3, and fourteen steps, made of two roundings each and of up to 2 * 320 S,
 * 34: 60, less than FINE_ERROR. Of N . r + M . v, R the sum of all |r|: |N| is at most 2 * 320^2; M, a sum of
 * G, at most 320 times 4 R, and off by 60 u of that; |v| is at most 320.5. That is 2^24.6 u R for M's error,
 * and for up to 52 roundings of at most 2^19.3 R 2^25: less than 2^20 FINE_ERROR R. tests/errors.c looks for
 * the largest. Where nothing is rounded, E = 0 touches: closed boxes only. */
#define TBX_FEW 8
#define TBX_PRECISE_EDGE_ERROR ((double)TBX_FEW * TBX_PIECES * TBX_FINE_ERROR)
#define TBX_PRECISE_PLANE_ERROR (1048576.0 * TBX_FINE_ERROR)
#define TBX_PRECISE_LEAST 1e-30    /* 0 is not sure, nor is what underflow, 2^-1022 of each product, leaves */
#define TBX_PRECISE (TBX_WIDE / 2) /* triangles at once */

typedef double tbx_dp __attribute__((vector_size(4 * TBX_WIDE), aligned(16)));
typedef uint64_t tbx_mp __attribute__((vector_size(4 * TBX_WIDE), aligned(16)));

TBX_FORCED tbx_dp tbx_pair_all(double x)
{
#if TBX_WIDE == 8
    const tbx_dp r = { x, x, x, x };
#else
    const tbx_dp r = { x, x };
#endif
    return r;
}

TBX_FORCED tbx_mp tbx_pair_bits(uint64_t x)
{
#if TBX_WIDE == 8
    const tbx_mp r = { x, x, x, x };
#else
    const tbx_mp r = { x, x };
#endif
    return r;
}

TBX_FORCED tbx_dp tbx_pair_of(const double x[TBX_PRECISE])
{
#if TBX_WIDE == 8
    const tbx_dp r = { x[0], x[1], x[2], x[3] };
#else
    const tbx_dp r = { x[0], x[1] };
#endif
    return r;
}

TBX_FORCED tbx_dp tbx_pair_abs(tbx_dp a)
{
    return (tbx_dp)((tbx_mp)a & tbx_pair_bits(~(uint64_t)0 >> 1));
}

TBX_FORCED tbx_dp tbx_pair_where(tbx_mp mask, tbx_dp a)
{
    return (tbx_dp)((tbx_mp)a & mask);
}

TBX_FORCED tbx_dp tbx_pair_flip(tbx_dp a, tbx_mp sign)
{
    return (tbx_dp)((tbx_mp)a ^ sign);
}

/* Lanes that are less. */
TBX_FORCED tbx_mp tbx_pair_less(tbx_dp a, tbx_dp b)
{
    return (tbx_mp)(a < b);
}

TBX_FORCED tbx_dp tbx_pair_min(tbx_dp a, tbx_dp b)
{
#if TBX_WIDE == 8
    return __builtin_ia32_minpd256(a, b);
#else
    return tbx_min2(a, b);
#endif
}

TBX_FORCED tbx_dp tbx_pair_kept(tbx_dp a)
{
    TBX_KEEP_VECTOR(a);
    return a;
}

/* Corner 3 is corner 0. */
typedef struct tbx_precise_axis {
    tbx_dp x[4];
    tbx_dp place[4]; /* P */
    tbx_dp rest[4];  /* r */
    tbx_dp size[3];  /* of edge i's rests: |r| of both corners */
    tbx_mp same[3];  /* edge i's corners have one coordinate */
    tbx_mp whole;    /* all rests are 0 */
    int points;      /* inner grid planes that some box has */
} TBX_ALIGNED tbx_precise_axis;

/* Twice the area in a plane, whole and other part, what the other may be off by, and where there is none. */
typedef struct tbx_precise_normal {
    tbx_dp whole;
    tbx_dp rest;
    tbx_dp error;
    tbx_mp flat;
} TBX_ALIGNED tbx_precise_normal;

/* Missed cells of the planes yz (bit y + 8 z), xz and xy (bits x + 8 z, x + 8 y); layers of inner points on
 * either side of the triangle's plane (bits x + 8 y). */
typedef struct tbx_precise_found {
    tbx_mp missed[3];
    tbx_mp above[TBX_FEW];
    tbx_mp below[TBX_FEW];
    tbx_mp up; /* 1, 2, 4: n is negative on axis x, y, z */
    tbx_mp unsure;
} TBX_ALIGNED tbx_precise_found;

/* The voxels of WIDE boxes, by layers: bits x + 8 y. */
typedef struct tbx_precise_voxels {
    uint64_t layer[TBX_WIDE][TBX_FEW];
} tbx_precise_voxels;

/* As tbx_sum_exact. */
TBX_FORCED tbx_dp tbx_pair_sum(tbx_dp a, tbx_dp b, tbx_dp *out_lost)
{
    const tbx_dp sum = tbx_pair_kept(a + b);
    const tbx_dp of_a = tbx_pair_kept(sum - b);
    const tbx_dp of_b = tbx_pair_kept(sum - of_a);
    *out_lost = tbx_pair_kept(a - of_a) + tbx_pair_kept(b - of_b);
    return sum;
}

/* Places and rests on axis k, as in tbx_rest, from place `base`. Lanes of *unsure are not known. */
TBX_FORCED void tbx_precise_set(tbx_precise_axis *a, const tbx_quick *q, int k, tbx_dp base, tbx_mp *unsure)
{
    const tbx_dp pieces = tbx_pair_all(TBX_PIECES);
    const tbx_dp round = tbx_pair_all(6755399441055744.0); /* 3 * 2^51: what is added to it becomes whole */
    const tbx_mp upper = tbx_pair_bits(~(uint64_t)0x7ffffff);
    const tbx_dp from = tbx_pair_all(q->halves[k].origin_high);
    const tbx_dp origin_low = tbx_pair_all(q->halves[k].origin_low);
    const tbx_dp zero = tbx_pair_all(0.0);
    const int is_simple = q->halves[k].origin_low == 0.0 && !q->is_double;
    int i;
    a->whole = tbx_pair_bits(~(uint64_t)0);
    for (i = 0; i < 3; i++) {
        const tbx_dp x = a->x[i];
        const tbx_dp x_high = (tbx_dp)((tbx_mp)x & upper);
        const tbx_dp to = x_high * pieces;
        const tbx_dp whole = tbx_pair_kept(
            (x - tbx_pair_all(q->whole_origin[k])) * tbx_pair_all(q->units[k] * TBX_PIECES) + round);
        const tbx_dp at = tbx_pair_kept(whole - round);
        const tbx_dp along = tbx_pair_kept(to - from);
        const tbx_dp part = at * tbx_pair_all(q->halves[k].low);
        tbx_dp rest = tbx_pair_kept(along - at * tbx_pair_all(q->halves[k].high));
        if (q->halves[k].origin_high != 0.0) { /* else nothing is rounded */
            *unsure |=
                (tbx_mp)(tbx_pair_kept(to - along) != from) | (tbx_mp)(tbx_pair_kept(along + from) != to);
        }
        if (is_simple) {
            rest -= part;
        } else {
            const tbx_dp above = (x - x_high) * pieces;
            const tbx_dp least = (tbx_pair_abs(origin_low) + tbx_pair_abs(above) + tbx_pair_abs(part)) *
                                 tbx_pair_all(TBX_REST_LEAST);
            tbx_dp lost[2];
            tbx_dp lows = tbx_pair_sum(origin_low, -above, &lost[0]);
            lows = tbx_pair_sum(lows, part, &lost[1]);
            rest = tbx_pair_kept(rest - lows);
            rest = (rest - lost[1]) - lost[0];
            *unsure |= ~tbx_pair_less(least, tbx_pair_abs(rest));
        }
        a->place[i] = at - base;
        a->rest[i] = tbx_pair_kept(rest * tbx_pair_all(q->units[k]));
        a->whole &= (tbx_mp)(a->rest[i] == zero);
    }
    a->x[3] = a->x[0];
    a->place[3] = a->place[0];
    a->rest[3] = a->rest[0];
    {
        const tbx_dp size0 = tbx_pair_abs(a->rest[0]);
        const tbx_dp size1 = tbx_pair_abs(a->rest[1]);
        const tbx_dp size2 = tbx_pair_abs(a->rest[2]);
        a->size[0] = size0 + size1;
        a->size[1] = size1 + size2;
        a->size[2] = size2 + size0;
    }
    a->same[0] = (tbx_mp)(a->x[0] == a->x[1]);
    a->same[1] = (tbx_mp)(a->x[1] == a->x[2]);
    a->same[2] = (tbx_mp)(a->x[2] == a->x[0]);
}

/* What E of an edge is made of, or D: turned so that E is negative outside. */
typedef struct tbx_precise_line {
    tbx_dp whole;
    tbx_dp rest;
    tbx_dp step_x[2]; /* of both parts from one point to the next */
    tbx_dp step_y[2];
    tbx_dp error;
} TBX_ALIGNED tbx_precise_line;

/* E of edge i at the first inner point. */
TBX_FORCED void tbx_precise_edge(tbx_precise_line *out, const tbx_precise_axis *x, const tbx_precise_axis *y,
                                 int i)
{
    const int j = i + 1;
    const tbx_dp g0 = x->place[i] * y->rest[j];
    const tbx_dp g1 = y->rest[i] * (x->place[j] + x->rest[j]);
    const tbx_dp h0 = x->rest[i] * (y->place[j] + y->rest[j]);
    const tbx_dp h1 = y->place[i] * x->rest[j];
    out->whole = tbx_pair_kept(x->place[i] * y->place[j] - y->place[i] * x->place[j]);
    out->rest = tbx_pair_kept((g0 - g1) + (h0 - h1));
    out->error =
        (x->size[i] + y->size[i]) * tbx_pair_all(TBX_PRECISE_EDGE_ERROR) + tbx_pair_all(TBX_PRECISE_LEAST);
}

/* The points at which an edge is outside, and lanes in which that is unsure. */
TBX_FORCED tbx_mp tbx_precise_outside(const tbx_precise_line *l, int points_x, int points_y, tbx_mp *unsure)
{
    const tbx_dp zero = tbx_pair_all(0.0);
    const tbx_dp step = l->step_x[0];
    const tbx_dp step_rest = l->step_x[1];
    tbx_dp least = tbx_pair_all(TBX_BEYOND);
    tbx_mp outside = tbx_pair_bits(0);
    tbx_mp cell = tbx_pair_bits(1);
    tbx_dp row = l->whole;
    tbx_dp row_rest = l->rest;
    int y = points_y;
    do {
        tbx_mp bit = cell;
        tbx_dp whole = row;
        tbx_dp rest = row_rest;
        int x = points_x;
        do {
            const tbx_dp e = tbx_pair_kept(whole) + tbx_pair_kept(rest);
            outside |= tbx_pair_less(e, zero) & bit;
            least = tbx_pair_min(least, tbx_pair_abs(e));
            whole -= step;
            rest -= step_rest;
            bit += bit;
        } while (--x > 0);
        row += l->step_y[0];
        row_rest += l->step_y[1];
        cell = cell << tbx_pair_bits(8);
    } while (--y > 0);
    *unsure |= tbx_pair_less(least, l->error);
    return outside;
}

/* What is missed moved by so many bits where `up`. */
TBX_FORCED tbx_mp tbx_precise_move(tbx_mp missed, tbx_mp up, int bits)
{
    return bits == 1 ? missed + (missed & up)
                     : (missed & ~up) | ((missed << tbx_pair_bits((uint64_t)bits)) & up);
}

/* Is any lane not 0? */
TBX_FORCED int tbx_pair_any(tbx_mp a)
{
    uint64_t lane[TBX_PRECISE];
    TBX_COPY(lane, &a, sizeof lane);
#if TBX_WIDE == 8
    return (lane[0] | lane[1] | lane[2] | lane[3]) != 0;
#else
    return (lane[0] | lane[1]) != 0;
#endif
}

/* Where an edge decides nothing, E is 0, and what E is made of is exact on a diagonal, and where nothing is
 * rounded: closed boxes touch at 0. */
TBX_FORCED void tbx_precise_exact(tbx_precise_line *l, tbx_mp decides, tbx_mp is_rounded)
{
    l->whole = tbx_pair_where(decides, l->whole);
    l->step_x[0] = tbx_pair_where(decides, l->step_x[0]);
    l->step_y[0] = tbx_pair_where(decides, l->step_y[0]);
    l->rest = tbx_pair_where(is_rounded, l->rest);
    l->step_x[1] = tbx_pair_where(is_rounded, l->step_x[1]);
    l->step_y[1] = tbx_pair_where(is_rounded, l->step_y[1]);
    l->error = tbx_pair_where(is_rounded, l->error);
}

/* The three edges in the plane across axis a, of both other axes in their order: that of y is seen from
 * behind. Where the grid has the same numbers on both, corners with equal coordinates lie on a line through
 * grid points, exactly. */
TBX_NOINLINE void tbx_precise_edges(tbx_precise_found *found, tbx_precise_normal *n,
                                  const tbx_precise_axis axis[3], const tbx_quick *q, int a)
{
    const int b = a == 0;
    const int c = a == 2 ? 1 : 2;
    const tbx_precise_axis *x = &axis[b];
    const tbx_precise_axis *y = &axis[c];
    const tbx_dp zero = tbx_pair_all(0.0);
    const tbx_mp closed = tbx_pair_bits(q->upper_open ? 0 : ~(uint64_t)0);
    const tbx_mp alike =
        tbx_pair_bits(q->whole_origin[b] == q->whole_origin[c] && q->halves[b].high == q->halves[c].high &&
                              q->halves[b].low == q->halves[c].low
                          ? ~(uint64_t)0
                          : 0);
    const tbx_mp across = (x->same[0] & x->same[1]) | (y->same[0] & y->same[1]); /* their box says it all */
    const tbx_mp whole = x->whole & y->whole;
    tbx_precise_line line[3];
    tbx_mp on_line[4];
    tbx_mp special = across | whole; /* some edge is to be asked whether it is exact */
    tbx_mp turned;
    tbx_mp flip;
    tbx_dp pieces;
    int is_special;
    int i;
    n->whole = n->rest = n->error = zero;
    n->flat = across;
    for (i = 0; i < 3; i++) {
        tbx_precise_edge(&line[i], x, y, i);
        on_line[i] = (tbx_mp)(x->x[i] == y->x[i]) & alike;
        n->whole += line[i].whole;
        n->rest += line[i].rest;
        n->error += line[i].error;
        n->flat |= x->same[i] & y->same[i];
        special |= on_line[i];
    }
    TBX_KEEP2(VECTOR, n->whole, n->rest);
    on_line[3] = on_line[0];
    is_special = tbx_pair_any(special | n->flat);
    n->flat |= (on_line[0] & on_line[1] & on_line[2]) | (whole & (tbx_mp)(n->whole == zero));
    turned = tbx_pair_less(n->whole + n->rest, zero);
    flip = turned & tbx_pair_bits((uint64_t)1 << 63);
    pieces = tbx_pair_flip(tbx_pair_all(TBX_PIECES), flip);
    found->unsure |= ~tbx_pair_less(n->error, tbx_pair_abs(n->whole + n->rest)) & ~n->flat;
    for (i = 0; i < 3; i++) {
        const int j = i + 1;
        const tbx_mp to_y = tbx_pair_less(x->x[j], x->x[i]) ^ turned; /* or either, if they are the same */
        const tbx_mp to_x = tbx_pair_less(y->x[i], y->x[j]) ^ turned;
        tbx_precise_line *l = &line[i];
        l->whole = tbx_pair_flip(l->whole, flip);
        l->rest = tbx_pair_flip(l->rest, flip);
        l->step_x[0] = (y->place[j] - y->place[i]) * pieces;
        l->step_x[1] = (y->rest[j] - y->rest[i]) * pieces;
        l->step_y[0] = (x->place[j] - x->place[i]) * pieces;
        l->step_y[1] = (x->rest[j] - x->rest[i]) * pieces;
        if (is_special) {
            const tbx_mp decides = ~(across | (x->same[i] & y->same[i]));
            const tbx_mp diagonal = on_line[i] & on_line[j] & (tbx_mp)(x->place[i] != x->place[j]);
            tbx_precise_exact(l, decides, decides & ~(closed & (diagonal | whole)));
        }
        found->missed[a] |= tbx_precise_move(
            tbx_precise_move(tbx_precise_outside(l, x->points, y->points, &found->unsure), to_x, 1), to_y, 8);
    }
    if (a == 1) {
        n->whole = -n->whole;
        n->rest = -n->rest;
    }
}

/* D at the first inner point, n the normal. */
TBX_FORCED void tbx_precise_plane_at(tbx_precise_line *out, const tbx_precise_axis axis[3],
                                     const tbx_precise_normal n[3])
{
    tbx_dp error = tbx_pair_all(0.0);
    int i;
    out->whole = out->rest = error;
    for (i = 0; i < 3; i++) {
        const tbx_precise_axis *a = &axis[i];
        out->whole += n[i].whole * a->place[0];
        out->rest += n[i].whole * a->rest[0] + n[i].rest * (a->place[0] + a->rest[0]);
        error += a->size[0] + a->size[1];
    }
    out->error = error * tbx_pair_all(TBX_PRECISE_PLANE_ERROR) + tbx_pair_all(TBX_PRECISE_LEAST);
}

/* The plane: of each voxel's box the sides of its inner points. */
TBX_NOINLINE void tbx_precise_plane(tbx_precise_found *found, const tbx_precise_axis axis[3],
                                    const tbx_precise_normal n[3], const tbx_quick *q)
{
    const tbx_dp zero = tbx_pair_all(0.0);
    const tbx_dp pieces = tbx_pair_all(TBX_PIECES);
    const tbx_mp decides = ~(n[0].flat | n[1].flat | n[2].flat);
    const tbx_mp whole = axis[0].whole & axis[1].whole & axis[2].whole;
    const tbx_mp is_rounded = decides & ~(whole & tbx_pair_bits(q->upper_open ? 0 : ~(uint64_t)0));
    tbx_precise_line d_at;
    tbx_dp step[3][2];
    tbx_dp layer;
    tbx_dp layer_rest;
    tbx_dp error;
    int i;
    int x;
    int y;
    int z;
    tbx_dp least = tbx_pair_all(TBX_BEYOND);
    tbx_precise_plane_at(&d_at, axis, n);
    for (i = 0; i < 3; i++) {
        step[i][0] = tbx_pair_where(decides, n[i].whole * pieces);
        step[i][1] = tbx_pair_where(is_rounded, n[i].rest * pieces);
        found->up |= tbx_pair_less(n[i].whole + n[i].rest, zero) & tbx_pair_bits((uint64_t)1 << i);
    }
    layer = tbx_pair_where(decides, d_at.whole);
    layer_rest = tbx_pair_where(is_rounded, d_at.rest);
    error = tbx_pair_where(is_rounded, d_at.error);
    for (z = 0; z < axis[2].points; z++) {
        tbx_dp row = layer;
        tbx_dp row_rest = layer_rest;
        tbx_mp above = tbx_pair_bits(0);
        tbx_mp below = above;
        for (y = 0; y < axis[1].points; y++) {
            tbx_mp bit = tbx_pair_bits((uint64_t)1 << 8 * y);
            tbx_dp at = row;
            tbx_dp rest = row_rest;
            for (x = 0; x < axis[0].points; x++) {
                const tbx_dp d = tbx_pair_kept(at) + tbx_pair_kept(rest);
                below |= tbx_pair_less(d, zero) & bit;
                above |= tbx_pair_less(zero, d) & bit;
                bit += bit;
                least = tbx_pair_min(least, tbx_pair_abs(d));
                at -= step[0][0];
                rest -= step[0][1];
            }
            row -= step[1][0];
            row_rest -= step[1][1];
        }
        found->above[z] = above;
        found->below[z] = below;
        layer -= step[2][0];
        layer_rest -= step[2][1];
    }
    found->unsure |= tbx_pair_less(least, error);
}

/* The voxels of lane i, box `more`. */
TBX_FN void tbx_precise_join(uint64_t layer[TBX_FEW], const tbx_precise_found *found, int i, int32_t more)
{
    const uint64_t each = (uint64_t)0x01010101u << 32 | 0x01010101u;     /* bit 0 of each byte, */
    const uint64_t diagonal = (uint64_t)0x80402010u << 32 | 0x08040201u; /* and bit k of byte k */
    const int more_z = more >> 16 & 255;
    const uint64_t row = (((uint64_t)2 << (more & 255)) - 1) * each;
    const uint64_t box = row & (~(uint64_t)0 >> (56 - 8 * (more >> 8 & 255)));
    const uint64_t xy = found->missed[2][i];
    uint64_t yz = found->missed[0][i];
    uint64_t zx = found->missed[1][i];
    int z;
    for (z = 0; z <= more_z; z++, yz >>= 8, zx >>= 8) {
        const uint64_t rows = ((((yz & 255) * each) & diagonal) + 127 * each) >> 7 & each;
        layer[z] = box & ~(xy | (zx & 255) * each | rows * 255);
    }
    if ((more & 255) != 0 && (more & 255 << 8) != 0 && more_z != 0) {
        const uint64_t up = found->up[i];
        const int to_z = (int)(up >> 2 & 1);
        const uint64_t from = (up & 1) + 8 * (up >> 1 & 1);
        for (z = 0; z < more_z; z++) {
            layer[z + to_z] &= ~(found->above[z][i] << from);
            layer[z + 1 - to_z] &= ~(found->below[z][i] << (9 - from));
        }
    }
}

/* Corner coordinates of lanes as doubles. */
TBX_FORCED tbx_dp tbx_precise_load(const char *const at[TBX_PRECISE], int k, int is_double)
{
    double x[TBX_PRECISE];
    int i;
    for (i = 0; i < TBX_PRECISE; i++) {
        if (is_double) {
            TBX_COPY(&x[i], at[i] + (size_t)k * sizeof x[i], sizeof x[i]);
        } else {
            float from;
            TBX_COPY(&from, at[i] + (size_t)k * sizeof from, sizeof from);
            x[i] = (double)from;
        }
    }
    return tbx_pair_of(x);
}

/* Is a coordinate a subnormal float, which may be read as 0? */
TBX_NOINLINE int tbx_precise_is_tiny(const char *at)
{
    int32_t bits;
    TBX_COPY(&bits, at, sizeof bits);
    return (bits & 0x7f800000) == 0 && (bits & 0x7fffffff) != 0;
}

/* The voxels of PRECISE of a group's boxes, from `from` on. Returns a bit for each lane that is unsure. */
TBX_NOINLINE unsigned tbx_precise_some(const tbx_quick *q, const tbx_source *source, const tbx_group *g,
                                       int from, tbx_precise_voxels *out)
{
    const tbx_dp zero = tbx_pair_all(0.0);
    tbx_precise_axis axis[3];
    tbx_precise_normal n[3];
    tbx_precise_found found;
    const char *at[3][TBX_PRECISE];
    uint64_t doubt[TBX_PRECISE];
    unsigned unsure = 0;
    int thick = 0;
    int i;
    int k;
    found.missed[0] = found.missed[1] = found.missed[2] = found.up = found.unsure = tbx_pair_bits(0);
    for (i = 0; i < TBX_PRECISE; i++) {
        at[0][i] = tbx_source_at(source, g->triangle[from + i], 0);
        at[1][i] = tbx_source_at(source, g->triangle[from + i], 1);
        at[2][i] = tbx_source_at(source, g->triangle[from + i], 2);
        thick |= g->box[from + i][3];
    }
    for (k = 0; k < 3; k++) {
        tbx_precise_axis *a = &axis[k];
        double base[TBX_PRECISE];
        tbx_mp is_zero;
        a->points = 0;
        if ((thick >> 8 * k & 255) == 0) {
            continue;
        }
        for (i = 0; i < TBX_PRECISE; i++) {
            const int extent = g->box[from + i][3] >> 8 * k & 255;
            a->points = extent > a->points ? extent : a->points;
            base[i] = (double)(g->box[from + i][k] + q->lo[k] + 1) * TBX_PIECES;
        }
        a->x[0] = tbx_precise_load(at[0], k, source->is_double);
        a->x[1] = tbx_precise_load(at[1], k, source->is_double);
        a->x[2] = tbx_precise_load(at[2], k, source->is_double);
        is_zero = (tbx_mp)(a->x[0] == zero) | (tbx_mp)(a->x[1] == zero) | (tbx_mp)(a->x[2] == zero);
        TBX_COPY(doubt, &is_zero, sizeof is_zero);
        for (i = 0; i < TBX_PRECISE; i++) {
            const size_t by = (size_t)k * sizeof(float);
            if (TBX_RARELY(doubt[i] != 0) && !source->is_double &&
                (tbx_precise_is_tiny(at[0][i] + by) | tbx_precise_is_tiny(at[1][i] + by) |
                 tbx_precise_is_tiny(at[2][i] + by))) {
                unsure |= 1u << (from + i);
            }
        }
        tbx_precise_set(a, q, k, tbx_pair_of(base), &found.unsure);
    }
    if (axis[1].points != 0 && axis[2].points != 0) {
        tbx_precise_edges(&found, &n[0], axis, q, 0);
    }
    if (axis[2].points != 0 && axis[0].points != 0) {
        tbx_precise_edges(&found, &n[1], axis, q, 1);
    }
    if (axis[0].points != 0 && axis[1].points != 0) {
        tbx_precise_edges(&found, &n[2], axis, q, 2);
        if (axis[2].points != 0) {
            tbx_precise_plane(&found, axis, n, q);
        }
    }
    TBX_COPY(doubt, &found.unsure, sizeof doubt);
    for (i = 0; i < TBX_PRECISE; i++) {
        tbx_precise_join(out->layer[from + i], &found, i, g->box[from + i][3]);
        unsure |= (unsigned)(doubt[i] != 0) << (from + i);
    }
    return unsure;
}

/* The same of all of a group's. */
TBX_NOINLINE unsigned tbx_precise_decide(const tbx_quick *q, const tbx_source *source, tbx_group *g,
                                         tbx_precise_voxels *out)
{
    unsigned unsure;
    tbx_group_pad(g);
    unsure = tbx_precise_some(q, source, g, 0, out);
    if (g->n > TBX_PRECISE) {
        unsure |= tbx_precise_some(q, source, g, TBX_PRECISE, out);
    }
    return unsure;
}

/* Where voxels go. Stores to the bits might change what the target and the grid hold. */
typedef struct tbx_bits {
    uint64_t *bits;
    size_t row_words;
    size_t layer_words;
} tbx_bits;

TBX_FORCED tbx_bits tbx_bits_of(const tbx_fill *fill)
{
    tbx_bits r;
    r.bits = fill->target->bits;
    r.row_words = fill->target->row_words;
    r.layer_words = fill->quick.layer_words;
    return r;
}

/* ORs a layer's n rows, 3 or 4, nibbles of v moved to where `run` is, and turns v to the next layer. */
TBX_FORCED uint64_t tbx_layer_or(uint64_t *row, size_t y1, size_t y2, size_t y3, uint64_t v, uint64_t run,
                                 int n)
{
    row[0] |= v & run;
    v = v >> 4 | v << 60;
    row[y1] |= v & run;
    v = v >> 4 | v << 60;
    row[y2] |= v & run;
    if (n > 3) {
        v = v >> 4 | v << 60;
        row[y3] |= v & run;
    }
    return v >> 4 * (5 - n) | v << (64 - 4 * (5 - n));
}

/* A run of a few bits from bit x of a word on, which may go on in the next word. */
TBX_FORCED void tbx_run_or(uint64_t *word, uint64_t run, unsigned x)
{
    word[0] |= run << x;
    if (TBX_RARELY(x > 64 - TBX_FEW) && run >> (64 - x) != 0) {
        word[1] |= run >> (64 - x);
    }
}

/* Voxels of a box whose rows start at one of a word's last three bits. */
TBX_NOINLINE void tbx_voxels_set_two(const tbx_bits *to, uint64_t *row, uint64_t key, uint64_t voxels)
{
    const unsigned x = (unsigned)(key >> 16) & 63u;
    const int more_y = (int)(key >> 2 & 3);
    const int more_z = (int)(key >> 4 & 3);
    int y;
    int z;
    for (z = 0; z <= more_z; z++, row += to->layer_words) {
        uint64_t *word = row;
        for (y = 0; y <= more_y; y++, word += to->row_words) {
            tbx_run_or(word, voxels >> (4 * y + 16 * z) & 15, x);
        }
    }
}

/* Sets voxels, bits x + 4 y + 16 z, of a box of up to n^3, n = 3 or 4; rows and layers not in the box have no
 * bits, and go where others are. */
TBX_FORCED void tbx_voxels_set(const tbx_bits *to, uint64_t *row, uint64_t key, uint64_t voxels, int n)
{
    const size_t row_words = to->row_words;
    const size_t layer_words = to->layer_words;
    const unsigned x = (unsigned)(key >> 16) & 63u;
    if (TBX_RARELY(x > 64u - (unsigned)n)) {
        tbx_voxels_set_two(to, row, key, voxels);
    } else {
        const uint64_t run = (((uint64_t)1 << n) - 1) << x;
        const size_t y1 = (key & 12) != 0 ? row_words : 0;
        const size_t y2 = (key & 8) != 0 ? 2 * row_words : 0;
        const size_t y3 = (key & 12) == 12 ? 3 * row_words : 0;
        uint64_t v = voxels << x | voxels >> ((64 - x) & 63);
        v = tbx_layer_or(row, y1, y2, y3, v, run, n);
        row += (key & 48) != 0 ? layer_words : 0;
        v = tbx_layer_or(row, y1, y2, y3, v, run, n);
        row += (key & 32) != 0 ? layer_words : 0;
        v = tbx_layer_or(row, y1, y2, y3, v, run, n);
        if (n > 3) {
            row += (key & 48) == 48 ? layer_words : 0;
            (void)tbx_layer_or(row, y1, y2, y3, v, run, n);
        }
    }
}

/* ---- Rows: boxes of up to ROWS voxels on each axis
 *
 * As in the row walk, a row's voxels are those between bounds from the xy edges (one for each y), the xz
 * edges (for each z) and the plane, and rows y are bounded by the yz edges for each z. With b the bounded
 * axis, r that of the rows, an edge lies on the line b = L(r), slope g = d_b / d_r. Its condition bounds
 * cells from below or from above, as the sign of area * d_r says:
 *
 *   floor(M(r) - h) <= b,  or  b <= floor(M(r) + h),     M(r) = L(r + 1/2)
 *
 * h = |g| / 2, and in the thin test max(|g| - 1, 0) / 2. The plane does both: M(y, z) = x of the plane over
 * the middle of the row, h = (|n_y| + |n_z|) / (2 |n_x|), thin: max(|n_y| - |n_x|, |n_z| - |n_x|, 0) / (2
 * |n_x|). Each bound is computed twice, less and plus its error; a row where the floors differ is unsure.
 * Edges with |d_r| < ROW_LEAST bound nothing: such an edge crosses its row of cells from end to end, or it is
 * a point, and its other corner's edges are those of a segment.
 *
 * Error, in units of u; m: the box's longest side. Corners are off by delta(m), 4.1 m; edges, normals and the
 * plane's slopes are doubles, rounded to float; 1 / d_r is taken for off by 4, as fast-math divides.
 *   edge    Corner and sums 4 m + 6 (m + 2); for each |g| the slope's roundings, 7 m, the corner, 4 m,
 *           products and sums 8 m + 12: less than 24 (1 + |g|) (m + 2), and 2 delta_low for each 1 + |g|.
 *   plane   10 (m + 2), and for |g_y| + |g_z| 18 (m + 2): the same.
 *   area    Products of differences, which are exact in double: off by 16 m^2 2^-52, sure above four times
 *           that, tau. Below it the triangle is a segment in that plane up to tau / |d_r|, and each of its
 *           edges bounds from both sides. If that plane is yz, the plane's condition follows from theirs: a
 *           cell that passes them does so by their error, 8192 tau m^2 / |d_r|, while n_x moves the plane by
 *           at most tau m, and n_y, n_z, of which |n_y| + |n_z| > ROW_TILT, by as much. Else n_x and its
 *           bound move it by 4 tau / |n_x| (1 + |g_y| + |g_z|) (m + 2).
 *
 * On the lattice, with q the coarsest step of the corners' places, 1/2 at most, and s that of an edge's d_b
 * and d_r, a bound times d_r is a multiple of q s; where d_b is 0 it is one of q, whatever the rows' axis;
 * the plane's, times n_x, is one of q times the step of the normal. An area may be 0 exactly, or known to be
 * where all corners are level; again its edges run to and fro, and the plane says what they say. */
#define TBX_ROW_ERROR (24.0f * TBX_U32) /* times 1 + |g| and m + 2 */
#define TBX_AREA_ERROR (64.0 * TBX_U64) /* tau, times m^2 */
#define TBX_ROW_LEAST 1e-18f /* its inverse, times all that it is multiplied with, is a float */
#define TBX_ROW_TILT 1e-3f
#define TBX_NOWHERE 65536.0f

/* What the lines of rows are made of, in lanes of triangles. */
typedef struct tbx_row_parts {
    tbx_points v[3]; /* from the first inner grid planes */
    tbx_points e[3]; /* edges */
    tbx_points n;
    tbx_fw slope_y; /* of the plane: -n_y / n_x, -n_z / n_x */
    tbx_fw slope_z;
    tbx_fw inverse;  /* 1 / n_x */
    tbx_fw reach;    /* m */
    tbx_fw rounding; /* 24 u (m + 2) + 2 delta_low */
    tbx_fw tau;
    tbx_points step;   /* of the lattice in planes yz, zx, xy, if both axes are on it, */
    tbx_points step_b; /* or the bounded one, */
    tbx_fw step_plane; /* or all, times that of n */
    tbx_iw flat_x;     /* n is exactly 0 on this axis */
    tbx_iw flat_y;
    tbx_iw flat_z;
    int on_lattice; /* 0: all of step and flat are 0 */
} TBX_ALIGNED tbx_row_parts;

/* A line for each edge in the plane of axes b and r: its bounds in row r are those in row 0 plus slope * r;
 * NOWHERE where it does not bound. Voxels are counted from 1, so that truncation is floor. */
typedef struct tbx_row_lines {
    tbx_fw lo_least[3];
    tbx_fw lo_most[3];
    tbx_fw lo_slope[3];
    tbx_fw hi_least[3];
    tbx_fw hi_most[3];
    tbx_fw hi_slope[3];
} TBX_ALIGNED tbx_row_lines;

/* The plane's middle in row (y, z) is at + y * slope_y + z * slope_z, voxels counted from 1; its bounds are
 * these more. */
typedef struct tbx_rows {
    tbx_row_lines x_of_y;
    tbx_row_lines x_of_z;
    tbx_row_lines y_of_z;
    tbx_fw at;
    tbx_fw slope_y;
    tbx_fw slope_z;
    tbx_fw lo_least;
    tbx_fw lo_most;
    tbx_fw hi_least;
    tbx_fw hi_most;
    tbx_iw extents;
    tbx_iw unsure;
} TBX_ALIGNED tbx_rows;

/* The first two edges on one axis, and all three in floats. */
TBX_FORCED void tbx_row_axis(tbx_dw out[2], tbx_fw *e0, tbx_fw *e1, tbx_fw *e2, tbx_fw x0, tbx_fw x1,
                             tbx_fw x2, double inverse)
{
    const tbx_dw scale = TBX_ALL(inverse);
    const tbx_dw d0 = __builtin_convertvector(x0, tbx_dw);
    const tbx_dw d1 = __builtin_convertvector(x1, tbx_dw);
    const tbx_dw d2 = __builtin_convertvector(x2, tbx_dw);
    tbx_dw d[3];
    d[0] = d1 - d0;
    d[1] = d2 - d1;
    d[2] = d0 - d2;
    TBX_KEEP(d[0]);
    TBX_KEEP(d[1]);
    TBX_KEEP(d[2]);
    out[0] = d[0] * scale;
    out[1] = d[1] * scale;
    *e0 = __builtin_convertvector(out[0], tbx_fw);
    *e1 = __builtin_convertvector(out[1], tbx_fw);
    *e2 = __builtin_convertvector(d[2] * scale, tbx_fw);
}

/* Edges, normals and slopes, which floats would not do for. */
TBX_FORCED void tbx_row_normals(tbx_row_parts *p, const double inverse[3], const tbx_points v[3])
{
    tbx_dw x[2];
    tbx_dw y[2];
    tbx_dw z[2];
    tbx_dw n_x;
    tbx_dw n_y;
    tbx_dw n_z;
    tbx_fw one;
    tbx_dw over_n_x = TBX_ALL(1.0);
    tbx_row_axis(x, &p->e[0].x, &p->e[1].x, &p->e[2].x, v[0].x, v[1].x, v[2].x, inverse[0]);
    tbx_row_axis(y, &p->e[0].y, &p->e[1].y, &p->e[2].y, v[0].y, v[1].y, v[2].y, inverse[1]);
    tbx_row_axis(z, &p->e[0].z, &p->e[1].z, &p->e[2].z, v[0].z, v[1].z, v[2].z, inverse[2]);
    n_x = y[0] * z[1] - z[0] * y[1];
    n_y = z[0] * x[1] - x[0] * z[1];
    n_z = x[0] * y[1] - y[0] * x[1];
    p->n.x = __builtin_convertvector(n_x, tbx_fw);
    p->n.y = __builtin_convertvector(n_y, tbx_fw);
    p->n.z = __builtin_convertvector(n_z, tbx_fw);
    /* where n_x is too small to divide by, nobody asks for the slopes */
    one = tbx_wide_where(tbx_wide_abs(p->n.x) <= p->tau, tbx_wide_all(1.0f));
    over_n_x /= n_x + __builtin_convertvector(one, tbx_dw);
    p->inverse = __builtin_convertvector(over_n_x, tbx_fw);
    p->slope_y = __builtin_convertvector(-n_y * over_n_x, tbx_fw);
    p->slope_z = __builtin_convertvector(-n_z * over_n_x, tbx_fw);
}

/* The greatest power of two of which a, b and c are multiples; they are of 1 / parts. */
TBX_FORCED tbx_fw tbx_step_of(tbx_fw a, tbx_fw b, tbx_fw c, int parts)
{
    const tbx_fw in_all = tbx_wide_all((float)parts);
    const tbx_iw bits = __builtin_convertvector(a * in_all, tbx_iw) |
                        __builtin_convertvector(b * in_all, tbx_iw) |
                        __builtin_convertvector(c * in_all, tbx_iw);
    return __builtin_convertvector(bits & -bits, tbx_fw) * tbx_wide_all(1.0f / (float)parts);
}

/* Edges of one axis that are on the lattice, and the bits of their places. */
TBX_FORCED tbx_iw tbx_row_snap(tbx_iw on, tbx_fw v0, tbx_fw v1, tbx_fw v2, tbx_fw *e0, tbx_fw *e1, tbx_fw *e2)
{
    const tbx_fw parts = tbx_wide_all((float)TBX_PARTS);
    *e0 = tbx_wide_choose(on, v1 - v0, *e0);
    *e1 = tbx_wide_choose(on, v2 - v1, *e1);
    *e2 = tbx_wide_choose(on, v0 - v2, *e2);
    return on & (__builtin_convertvector(v0 * parts, tbx_iw) | __builtin_convertvector(v1 * parts, tbx_iw) |
                 __builtin_convertvector(v2 * parts, tbx_iw));
}

/* All of this that is on the lattice, exactly. */
TBX_NOINLINE void tbx_row_parts_snap(tbx_row_parts *p, const tbx_quick *q, const tbx_points v[3],
                                     const tbx_points *first)
{
    const tbx_fw zero = tbx_wide_all(0.0f);
    tbx_iw level_x;
    tbx_iw level_y;
    tbx_iw level_z;
    const tbx_iw on_x = tbx_group_snap(q, 0, (tbx_iw)first->x, v, p->v, &level_x);
    const tbx_iw on_y = tbx_group_snap(q, 1, (tbx_iw)first->y, v, p->v, &level_y);
    const tbx_iw on_z = tbx_group_snap(q, 2, (tbx_iw)first->z, v, p->v, &level_z);
    const tbx_iw places =
        tbx_row_snap(on_x, p->v[0].x, p->v[1].x, p->v[2].x, &p->e[0].x, &p->e[1].x, &p->e[2].x) |
        tbx_row_snap(on_y, p->v[0].y, p->v[1].y, p->v[2].y, &p->e[0].y, &p->e[1].y, &p->e[2].y) |
        tbx_row_snap(on_z, p->v[0].z, p->v[1].z, p->v[2].z, &p->e[0].z, &p->e[1].z, &p->e[2].z) |
        tbx_wide_int(TBX_PARTS / 2);
    const tbx_fw step =
        __builtin_convertvector(places & -places, tbx_fw) * tbx_wide_all(1.0f / TBX_PARTS); /* the coarsest */
    p->n.x = tbx_wide_choose(on_y & on_z, p->e[0].y * p->e[1].z - p->e[0].z * p->e[1].y, p->n.x);
    p->n.y = tbx_wide_choose(on_z & on_x, p->e[0].z * p->e[1].x - p->e[0].x * p->e[1].z, p->n.y);
    p->n.z = tbx_wide_choose(on_x & on_y, p->e[0].x * p->e[1].y - p->e[0].y * p->e[1].x, p->n.z);
    p->flat_x = level_y | level_z | (on_y & on_z & (p->n.x == zero));
    p->flat_y = level_z | level_x | (on_z & on_x & (p->n.y == zero));
    p->flat_z = level_x | level_y | (on_x & on_y & (p->n.z == zero));
    p->step.x = tbx_wide_where(on_y & on_z, step);
    p->step.y = tbx_wide_where(on_z & on_x, step);
    p->step.z = tbx_wide_where(on_x & on_y, step);
    p->step_b.x = tbx_wide_where(on_y, step);
    p->step_b.y = p->step_b.z = tbx_wide_where(on_x, step);
    p->step_plane =
        tbx_wide_where(on_x & on_y & on_z, step * tbx_step_of(p->n.x, p->n.y, p->n.z, TBX_PARTS * TBX_PARTS));
    p->on_lattice = 1;
}

/* Widens bounds, or narrows them, so that what lies on them counts as the rule says; uphill where the upper
 * one is attained on an upper face of its row. */
TBX_FORCED void tbx_row_touch(tbx_fw *lo_spread, tbx_fw *hi_spread, const tbx_quick *q, tbx_fw touch,
                              tbx_iw uphill)
{
    const tbx_iw sign = tbx_wide_int(TBX_SIGN_BIT);
    const tbx_iw upper_open = tbx_wide_int(-q->upper_open);
    const tbx_iw lower_open = tbx_wide_int(-q->lower_open);
    *lo_spread += tbx_wide_flip(touch, sign & upper_open);
    *hi_spread += tbx_wide_flip(touch, sign & (lower_open | (upper_open & uphill)));
}

/* Of a plane, b over r: twice the area; the lanes in which edges bound from both sides, and how far they may
 * be off then, times d_r; the lattice's steps. */
typedef struct tbx_row_sides {
    tbx_fw area;
    tbx_iw two;
    tbx_fw off;
    tbx_fw step;
    tbx_fw step_b;
} TBX_ALIGNED tbx_row_sides;

TBX_FORCED void tbx_row_sides_set(tbx_row_sides *out, tbx_fw area, tbx_iw two, tbx_fw off, tbx_fw step,
                                  tbx_fw step_b)
{
    out->area = area;
    out->two = two;
    out->off = tbx_wide_where(two, off);
    out->step = step;
    out->step_b = step_b;
}

/* A corner, and the edge from it, in a plane. */
typedef struct tbx_row_edge {
    tbx_fw v_b;
    tbx_fw v_r;
    tbx_fw e_b;
    tbx_fw e_r;
} TBX_ALIGNED tbx_row_edge;

TBX_FORCED tbx_row_edge tbx_row_edge_of(tbx_fw v_b, tbx_fw v_r, tbx_fw e_b, tbx_fw e_r)
{
    tbx_row_edge r;
    r.v_b = v_b;
    r.v_r = v_r;
    r.e_b = e_b;
    r.e_r = e_r;
    return r;
}

/* Edge i's line in a plane. */
TBX_FORCED void tbx_row_line(tbx_row_lines *out, const tbx_row_parts *p, const tbx_quick *q, int i,
                             const tbx_row_sides *side, tbx_row_edge edge)
{
    const tbx_fw e_b = edge.e_b;
    const tbx_fw e_r = edge.e_r;
    const tbx_fw zero = tbx_wide_all(0.0f);
    const tbx_fw half = tbx_wide_all(0.5f);
    const tbx_fw one = tbx_wide_all(1.0f);
    const tbx_fw nowhere = tbx_wide_all(TBX_NOWHERE);
    const tbx_iw has = tbx_wide_abs(e_r) > tbx_wide_all(TBX_ROW_LEAST);
    const tbx_fw inverse = tbx_wide_inverse(has, e_r);
    const tbx_fw slope = tbx_wide_where(has, e_b * inverse);
    const tbx_fw steep = tbx_wide_abs(slope);
    const tbx_fw middle = (edge.v_b + tbx_wide_all(2.0f)) - slope * (edge.v_r + half);
    const tbx_fw error = (steep + one) * (p->rounding + side->off * tbx_wide_abs(inverse));
    const tbx_iw below = ((tbx_iw)side->area ^ (tbx_iw)e_r) < tbx_wide_int(0);
    const tbx_iw is_lo = (below | side->two) & has;
    const tbx_iw is_hi = (~below | side->two) & has;
    tbx_fw lo_spread = half * (q->thin ? tbx_wide_max(steep - one, zero) : steep);
    tbx_fw hi_spread = lo_spread;
    tbx_fw lo;
    tbx_fw hi;
    if (p->on_lattice) {
        const tbx_fw times_d_r = side->step * tbx_step_of(e_b, e_r, zero, TBX_PARTS);
        tbx_row_touch(&lo_spread, &hi_spread, q,
                      half * tbx_wide_choose(e_b == zero, side->step_b, times_d_r * tbx_wide_abs(inverse)),
                      slope > zero);
    }
    lo = tbx_wide_choose(is_lo, middle - lo_spread, -nowhere);
    hi = tbx_wide_choose(is_hi, middle + hi_spread, nowhere);
    out->lo_least[i] = lo - error;
    out->lo_most[i] = lo + error;
    out->lo_slope[i] = tbx_wide_where(is_lo, slope);
    out->hi_least[i] = hi - error;
    out->hi_most[i] = hi + error;
    out->hi_slope[i] = tbx_wide_where(is_hi, slope);
}

/* The plane's bounds; in lanes `vacuous` its condition follows from the edges'. */
TBX_FORCED void tbx_row_plane(tbx_rows *out, const tbx_row_parts *p, const tbx_quick *q, tbx_iw vacuous)
{
    const tbx_fw zero = tbx_wide_all(0.0f);
    const tbx_fw half = tbx_wide_all(0.5f);
    const tbx_fw one = tbx_wide_all(1.0f);
    const tbx_fw two = tbx_wide_all(2.0f);
    const tbx_fw nowhere = tbx_wide_all(TBX_NOWHERE);
    const tbx_fw slope_y = tbx_wide_where(~vacuous, p->slope_y);
    const tbx_fw slope_z = tbx_wide_where(~vacuous, p->slope_z);
    const tbx_fw steep_y = tbx_wide_abs(slope_y);
    const tbx_fw steep_z = tbx_wide_abs(slope_z);
    const tbx_fw inverse = tbx_wide_abs(p->inverse);
    const tbx_fw by_n_x = tbx_wide_all(4.0f) * p->tau * inverse * (p->reach + two);
    const tbx_fw error = tbx_wide_where(~vacuous, (one + steep_y + steep_z) * (p->rounding + by_n_x));
    const tbx_fw thin = tbx_wide_max(tbx_wide_max(steep_y, steep_z) - one, zero);
    tbx_fw lo_spread = half * (q->thin ? thin : steep_y + steep_z);
    tbx_fw hi_spread = lo_spread;
    if (p->on_lattice) {
        tbx_row_touch(&lo_spread, &hi_spread, q, half * p->step_plane * inverse,
                      (slope_y > zero) | (slope_z > zero));
    }
    lo_spread = tbx_wide_choose(vacuous, nowhere, lo_spread);
    hi_spread = tbx_wide_choose(vacuous, nowhere, hi_spread);
    out->at = (p->v[0].x + two) - slope_y * (p->v[0].y + half) - slope_z * (p->v[0].z + half);
    out->slope_y = slope_y;
    out->slope_z = slope_z;
    out->lo_least = -lo_spread - error;
    out->lo_most = error - lo_spread;
    out->hi_least = hi_spread - error;
    out->hi_most = hi_spread + error;
    out->unsure = ~(error < tbx_wide_all(0.125f));
}

/* Extents along axis k. */
TBX_FORCED tbx_iw tbx_extent(tbx_iw extents, int k)
{
    return (extents >> tbx_wide_int(8 * k)) & tbx_wide_int(255);
}

/* The lines and planes of a group. */
TBX_NOINLINE void tbx_rows_set(tbx_rows *out, const tbx_quick *q, const tbx_group *g,
                               const tbx_source *source)
{
    const tbx_fw one = tbx_wide_all(1.0f);
    const tbx_fw zero = tbx_wide_all(0.0f);
    tbx_row_parts p;
    tbx_points v[3];
    tbx_points first;
    tbx_row_sides xy;
    tbx_row_sides xz;
    tbx_row_sides yz;
    tbx_fw off;
    tbx_iw near_x; /* n might be 0 on this axis, */
    tbx_iw near_y;
    tbx_iw near_z;
    tbx_iw flat; /* or is on some */
    int i;
    tbx_group_corners(v, &first, &out->extents, g, source);
    p.reach = one + tbx_wide_max(tbx_wide_max(__builtin_convertvector(tbx_extent(out->extents, 0), tbx_fw),
                                              __builtin_convertvector(tbx_extent(out->extents, 1), tbx_fw)),
                                 __builtin_convertvector(tbx_extent(out->extents, 2), tbx_fw));
    p.rounding = tbx_wide_all(TBX_ROW_ERROR) * (p.reach + one + one) + tbx_wide_all(2.0f * q->delta_low);
    p.tau = tbx_wide_all((float)TBX_AREA_ERROR) * p.reach * p.reach;
    p.v[0] = v[0];
    p.v[1] = v[1];
    p.v[2] = v[2];
    tbx_group_place(q, 0, (tbx_iw)first.x, &p.v[0].x, &p.v[1].x, &p.v[2].x);
    tbx_group_place(q, 1, (tbx_iw)first.y, &p.v[0].y, &p.v[1].y, &p.v[2].y);
    tbx_group_place(q, 2, (tbx_iw)first.z, &p.v[0].z, &p.v[1].z, &p.v[2].z);
    tbx_row_normals(&p, q->units, v);
    p.on_lattice = 0;
    p.step.x = p.step.y = p.step.z = zero;
    p.step_b = p.step;
    p.step_plane = zero;
    p.flat_x = p.flat_y = p.flat_z = tbx_wide_int(0);
    if (q->lattice) {
        tbx_row_parts_snap(&p, q, v, &first);
    }
    flat = p.flat_x | p.flat_y | p.flat_z;
    near_x = (tbx_wide_abs(p.n.x) <= p.tau) & ~p.flat_x;
    near_y = (tbx_wide_abs(p.n.y) <= p.tau) & ~p.flat_y;
    near_z = (tbx_wide_abs(p.n.z) <= p.tau) & ~p.flat_z;
    tbx_row_plane(out, &p, q, flat | near_x);
    out->unsure |= near_x & ~flat & (tbx_wide_abs(p.n.y) + tbx_wide_abs(p.n.z) <= tbx_wide_all(TBX_ROW_TILT));
    if (q->thin) { /* it has to know */
        out->unsure |= near_x | near_y | near_z;
    }
    off = tbx_wide_all(8192.0f) * p.tau * p.reach * p.reach;
    tbx_row_sides_set(&xy, p.n.z, near_z, off, p.step.z, p.step_b.z);
    tbx_row_sides_set(&xz, -p.n.y, near_y, off, p.step.y, p.step_b.y);
    tbx_row_sides_set(&yz, p.n.x, near_x, off, p.step.x, p.step_b.x);
    for (i = 0; i < 3; i++) {
        const tbx_points *a = &p.v[i];
        const tbx_points *e = &p.e[i];
        tbx_row_line(&out->x_of_y, &p, q, i, &xy, tbx_row_edge_of(a->x, a->y, e->x, e->y));
        tbx_row_line(&out->x_of_z, &p, q, i, &xz, tbx_row_edge_of(a->x, a->z, e->x, e->z));
        tbx_row_line(&out->y_of_z, &p, q, i, &yz, tbx_row_edge_of(a->y, a->z, e->y, e->z));
    }
}

/* ---- Rows of boxes of up to FEW voxels on each axis, in lanes of triangles */

typedef struct tbx_row_bounds {
    tbx_fw lo_least;
    tbx_fw lo_most;
    tbx_fw hi_least;
    tbx_fw hi_most;
} TBX_ALIGNED tbx_row_bounds;

TBX_FORCED tbx_fw tbx_row_most(const tbx_fw at[3], const tbx_fw step[3])
{
    return tbx_wide_max(tbx_wide_max(at[0] + step[0], at[1] + step[1]), at[2] + step[2]);
}

TBX_FORCED tbx_fw tbx_row_least(const tbx_fw at[3], const tbx_fw step[3])
{
    return tbx_wide_min(tbx_wide_min(at[0] + step[0], at[1] + step[1]), at[2] + step[2]);
}

/* Within lo..hi. */
TBX_FORCED tbx_fw tbx_row_within(tbx_fw bound, tbx_fw lo, tbx_fw hi)
{
    return tbx_wide_min(tbx_wide_max(bound, lo), hi);
}

/* The bounds of a row, within voxels 1..extent + 1; half a voxel off what might be unsure. */
TBX_FORCED void tbx_row_bounds_set(tbx_row_bounds *out, const tbx_row_lines *l, int row, tbx_iw extent)
{
    const tbx_fw at = tbx_wide_all((float)row);
    const tbx_fw first = tbx_wide_all(1.5f);
    const tbx_fw before = tbx_wide_all(0.5f);
    const tbx_fw last = __builtin_convertvector(extent, tbx_fw) + first;
    const tbx_fw after = last + tbx_wide_all(1.0f);
    tbx_fw lo[3];
    tbx_fw hi[3];
    lo[0] = l->lo_slope[0] * at;
    lo[1] = l->lo_slope[1] * at;
    lo[2] = l->lo_slope[2] * at;
    hi[0] = l->hi_slope[0] * at;
    hi[1] = l->hi_slope[1] * at;
    hi[2] = l->hi_slope[2] * at;
    out->lo_least = tbx_row_within(tbx_row_most(l->lo_least, lo), first, after);
    out->lo_most = tbx_row_within(tbx_row_most(l->lo_most, lo), first, after);
    out->hi_least = tbx_row_within(tbx_row_least(l->hi_least, hi), before, last);
    out->hi_most = tbx_row_within(tbx_row_least(l->hi_most, hi), before, last);
}

TBX_FORCED tbx_iw tbx_row_voxel(tbx_fw x)
{
    return __builtin_convertvector(x, tbx_iw);
}

/* 2^i for i within 0..15, which bits of a row are; else anything, but in range of the conversion, which
 * raises no flag then. */
TBX_FORCED tbx_uw tbx_wide_bit(tbx_uw i)
{
    const tbx_uw place = i & (tbx_uw)tbx_wide_int(15);
#if defined(__AVX2__)
    return (tbx_uw)tbx_wide_int(1) << place;
#else
    const tbx_uw bias = (tbx_uw)tbx_wide_int(127);
    const tbx_uw exponent = (place + bias) << (tbx_uw)tbx_wide_int(23);
    return (tbx_uw) __builtin_convertvector((tbx_fw)exponent, tbx_iw);
#endif
}

/* Voxels by rows: bit x of [z][y][lane]; first and last rows of a layer, counted from 1. */
typedef struct tbx_few {
    tbx_iw x[TBX_FEW][TBX_FEW];
    tbx_iw first_y[TBX_FEW];
    tbx_iw last_y[TBX_FEW];
    tbx_iw unsure;
} TBX_ALIGNED tbx_few;

TBX_FORCED void tbx_few_set(tbx_few *out, const tbx_rows *r, int rows, int layers)
{
    const tbx_iw extent_x = tbx_extent(r->extents, 0);
    const tbx_iw extent_y = tbx_extent(r->extents, 1);
    const tbx_iw extent_z = tbx_extent(r->extents, 2);
    tbx_row_bounds x_of_y[TBX_FEW];
    tbx_iw first_y;
    tbx_iw last_y;
    int y;
    int z;
    out->unsure = r->unsure;
    for (y = 0; y < rows; y++) {
        tbx_row_bounds_set(&x_of_y[y], &r->x_of_y, y, extent_x);
    }
    for (z = 0; z < layers; z++) {
        tbx_row_bounds x_of_z;
        tbx_row_bounds y_of_z;
        const tbx_fw at = r->at + tbx_wide_all((float)z) * r->slope_z;
        const tbx_fw lo_least = at + r->lo_least;
        const tbx_fw lo_most = at + r->lo_most;
        const tbx_fw hi_least = at + r->hi_least;
        const tbx_fw hi_most = at + r->hi_most;
        tbx_row_bounds_set(&x_of_z, &r->x_of_z, z, extent_x);
        tbx_row_bounds_set(&y_of_z, &r->y_of_z, z, extent_y);
        first_y = tbx_row_voxel(y_of_z.lo_least);
        last_y = tbx_row_voxel(y_of_z.hi_most) & ~(tbx_wide_int(z) > extent_z);
        out->unsure |=
            ((first_y != tbx_row_voxel(y_of_z.lo_most)) | (last_y != tbx_row_voxel(y_of_z.hi_least))) &
            ~(first_y > last_y);
        out->first_y[z] = first_y;
        out->last_y[z] = last_y;
        for (y = 0; y < rows; y++) {
            const tbx_fw step = tbx_wide_all((float)y) * r->slope_y;
            const tbx_iw first = tbx_row_voxel(
                tbx_wide_max(tbx_wide_max(x_of_y[y].lo_least, x_of_z.lo_least), lo_least + step));
            const tbx_iw first_most =
                tbx_row_voxel(tbx_wide_max(tbx_wide_max(x_of_y[y].lo_most, x_of_z.lo_most), lo_most + step));
            const tbx_iw last_least = tbx_row_voxel(
                tbx_wide_min(tbx_wide_min(x_of_y[y].hi_least, x_of_z.hi_least), hi_least + step));
            const tbx_iw last =
                tbx_row_voxel(tbx_wide_min(tbx_wide_min(x_of_y[y].hi_most, x_of_z.hi_most), hi_most + step));
            const tbx_iw row = tbx_wide_int(y + 1);
            const tbx_iw none = (first > last) | (first_y > row) | (row > last_y);
            const tbx_uw before = (tbx_uw)first - (tbx_uw)tbx_wide_int(1);
            const tbx_uw voxels = tbx_wide_bit((tbx_uw)last) - tbx_wide_bit(before);
            out->unsure |= ((first != first_most) | (last != last_least)) & ~none;
            out->x[z][y] = (tbx_iw)voxels & ~none;
        }
    }
}

/* Sets the voxels of lane i; asks for the memory of the layer above each. */
TBX_FN void tbx_few_store(const tbx_few *few, const tbx_fill *fill, const tbx_group *g, int i)
{
    const size_t row_words = fill->target->row_words;
    const size_t layer_words = fill->quick.layer_words;
    const int x = g->box[i][0] & 63;
    const int layers = (g->box[i][3] >> 16 & 255) + 1;
    const tbx_bits to = tbx_bits_of(fill);
    uint64_t *layer = to.bits + (size_t)tbx_first_word(&fill->quick, tbx_key_set(g->box[i]));
    int z;
    for (z = 0; z < layers; z++, layer += layer_words) {
        const int last_y = few->last_y[z][i];
        int y;
        for (y = few->first_y[z][i]; y <= last_y; y++) {
            const uint64_t voxels = (uint64_t)(uint32_t)few->x[z][y - 1][i];
            uint64_t *row = layer + (size_t)(y - 1) * row_words;
            TBX_PREFETCH((uintptr_t)row + sizeof *row * layer_words);
            if (voxels != 0) {
                row[0] |= voxels << x;
                if (TBX_RARELY(x > 64 - TBX_FEW) && voxels >> (64 - x) != 0) {
                    row[1] |= voxels >> (64 - x);
                }
            }
        }
    }
}

/* ---- Rows of larger boxes, four at a time */

/* Of all rows in one plane. */
typedef struct tbx_lane_bounds {
    float lo_least[TBX_ROWS];
    float lo_most[TBX_ROWS];
    float hi_least[TBX_ROWS];
    float hi_most[TBX_ROWS];
} tbx_lane_bounds;

/* The greatest and the least of three lines in four rows, from their values in row 0 and their steps. */
TBX_FORCED tbx_f4 tbx_lane_most(const tbx_fw at[3], int lane, const tbx_f4 step[3])
{
    const tbx_f4 ab = tbx_max4(tbx_splat(at[0][lane]) + step[0], tbx_splat(at[1][lane]) + step[1]);
    return tbx_max4(ab, tbx_splat(at[2][lane]) + step[2]);
}

TBX_FORCED tbx_f4 tbx_lane_least(const tbx_fw at[3], int lane, const tbx_f4 step[3])
{
    const tbx_f4 ab = tbx_min4(tbx_splat(at[0][lane]) + step[0], tbx_splat(at[1][lane]) + step[1]);
    return tbx_min4(ab, tbx_splat(at[2][lane]) + step[2]);
}

/* Within lo..hi. */
TBX_FORCED void tbx_lane_store(float *out, tbx_f4 bound, float lo, float hi)
{
    bound = tbx_min4(tbx_max4(bound, tbx_splat(lo)), tbx_splat(hi));
    TBX_COPY(out, &bound, sizeof bound);
}

/* The bounds of so many rows, within voxels lo..hi - 1; half a voxel off what might be unsure. */
TBX_FN void tbx_lane_bounds_set(tbx_lane_bounds *out, const tbx_row_lines *l, int lane, int rows, int lo,
                                int hi)
{
    const tbx_f4 four = { 0.0f, 1.0f, 2.0f, 3.0f };
    const float first = (float)lo + 1.5f;
    const float last = (float)hi + 0.5f;
    int i;
    for (i = 0; i < rows; i += 4) {
        const tbx_f4 row = tbx_splat((float)i) + four;
        tbx_f4 lo_step[3];
        tbx_f4 hi_step[3];
        lo_step[0] = tbx_splat(l->lo_slope[0][lane]) * row;
        lo_step[1] = tbx_splat(l->lo_slope[1][lane]) * row;
        lo_step[2] = tbx_splat(l->lo_slope[2][lane]) * row;
        hi_step[0] = tbx_splat(l->hi_slope[0][lane]) * row;
        hi_step[1] = tbx_splat(l->hi_slope[1][lane]) * row;
        hi_step[2] = tbx_splat(l->hi_slope[2][lane]) * row;
        tbx_lane_store(out->lo_least + i, tbx_lane_most(l->lo_least, lane, lo_step), first, last + 1.0f);
        tbx_lane_store(out->lo_most + i, tbx_lane_most(l->lo_most, lane, lo_step), first, last + 1.0f);
        tbx_lane_store(out->hi_least + i, tbx_lane_least(l->hi_least, lane, hi_step), 0.5f, last);
        tbx_lane_store(out->hi_most + i, tbx_lane_least(l->hi_most, lane, hi_step), 0.5f, last);
    }
}

/* A bound as a whole voxel; a plane's may be far away. */
TBX_FORCED tbx_i4 tbx_lane_voxel(tbx_f4 a)
{
    return __builtin_convertvector(tbx_min4(tbx_max4(a, tbx_splat(0.5f)), tbx_splat(TBX_NOWHERE)), tbx_i4);
}

/* Bounds of one layer z: those of the edges in xz, and of the plane in row 0. */
typedef struct tbx_layer {
    tbx_f4 lo_least, lo_most, hi_least, hi_most;
    tbx_f4 plane_lo_least, plane_lo_most, plane_hi_least, plane_hi_most;
    tbx_f4 slope;
} TBX_ALIGNED tbx_layer;

/* Voxels of rows y..y + 3. Returns the lanes that are unsure. */
TBX_FORCED tbx_i4 tbx_layer_rows(const tbx_layer *l, const tbx_lane_bounds *x_of_y, int y, tbx_i4 *out_first,
                                 tbx_i4 *out_last)
{
    const tbx_f4 four = { 0.0f, 1.0f, 2.0f, 3.0f };
    const tbx_f4 step = (tbx_splat((float)y) + four) * l->slope;
    const tbx_i4 first_least = tbx_lane_voxel(
        tbx_max4(tbx_max4(tbx_load4(x_of_y->lo_least + y), l->lo_least), l->plane_lo_least + step));
    const tbx_i4 first_most = tbx_lane_voxel(
        tbx_max4(tbx_max4(tbx_load4(x_of_y->lo_most + y), l->lo_most), l->plane_lo_most + step));
    const tbx_i4 last_least = tbx_lane_voxel(
        tbx_min4(tbx_min4(tbx_load4(x_of_y->hi_least + y), l->hi_least), l->plane_hi_least + step));
    const tbx_i4 last_most = tbx_lane_voxel(
        tbx_min4(tbx_min4(tbx_load4(x_of_y->hi_most + y), l->hi_most), l->plane_hi_most + step));
    const tbx_i4 differ = (first_least ^ first_most) | (last_least ^ last_most);
    *out_first = first_least;
    *out_last = last_most;
    return (differ > tbx_splat_int(0)) & ~(first_least > last_most);
}

/* Sets voxels first[i]..last[i] of rows from..to, `row` being the first of them; asks for those above. */
TBX_FORCED void tbx_layer_set(const tbx_target *t, uint64_t *row, size_t row_words, size_t layer_words,
                              tbx_i4 first, tbx_i4 last, int from, int to)
{
    int32_t first_x[4];
    int32_t last_x[4];
    int i;
    TBX_COPY(first_x, &first, sizeof first);
    TBX_COPY(last_x, &last, sizeof last);
    for (i = from; i <= to; i++, row += row_words) {
        const int32_t begin = first_x[i];
        const int32_t end = last_x[i];
        if (begin <= end) {
            uint64_t *word = row + (begin >> 6);
            TBX_PREFETCH((uintptr_t)word + sizeof *word * layer_words);
            if (TBX_RARELY((begin ^ end) > 63)) {
                tbx_set_run(t, row, (size_t)begin, (size_t)end);
            } else {
                *word |= (~(uint64_t)0 << (begin & 63)) & (~(uint64_t)0 >> (63 - (end & 63)));
            }
        }
    }
}

/* Adds layer z and its rows first_y..last_y, unless they are none, to what is left of a triangle. */
TBX_FN void tbx_later_add(tbx_later *d, int z, int first_y, int last_y)
{
    d->first[0] = (uint16_t)(first_y < d->first[0] ? first_y : d->first[0]);
    d->last[0] = (uint16_t)(last_y > d->last[0] ? last_y : d->last[0]);
    d->first[1] = (uint16_t)(z < d->first[1] ? z : d->first[1]);
    d->last[1] = (uint16_t)z;
}

/* Lane i of a group, whose box has up to ROWS voxels on each axis. */
TBX_FN void tbx_lane_fill(tbx_fill *fill, const tbx_rows *rows, const tbx_group *g, int lane)
{
    const tbx_quick *q = &fill->quick;
    const tbx_target *t = fill->target;
    uint64_t *const bits = t->bits; /* stores to the bits might change what t and q hold */
    const size_t row_words = t->row_words;
    const size_t layer_words = q->layer_words;
    const int *n = fill->quick.n;
    const tbx_i4 box = g->box[lane];
    const int at[3] = { box[0], box[1], box[2] };
    const int count[3] = { (box[3] & 255) + 1, (box[3] >> 8 & 255) + 1, (box[3] >> 16 & 255) + 1 };
    tbx_lane_bounds x_of_y;
    tbx_lane_bounds x_of_z;
    tbx_lane_bounds y_of_z;
    tbx_later later;
    int start[3];
    int end[3];
    int i;
    int z;
    later.first[0] = later.first[1] = 65535;
    later.last[0] = later.last[1] = 0;
    for (i = 0; i < 3; i++) {
        start[i] = at[i] < 0 ? -at[i] : 0;
        end[i] = count[i] < n[i] - at[i] ? count[i] : n[i] - at[i];
    }
    tbx_lane_bounds_set(&x_of_y, &rows->x_of_y, lane, end[1], start[0], end[0]);
    tbx_lane_bounds_set(&x_of_z, &rows->x_of_z, lane, end[2], start[0], end[0]);
    tbx_lane_bounds_set(&y_of_z, &rows->y_of_z, lane, end[2], start[1], end[1]);
    for (z = start[2]; z < end[2]; z++) {
        const float middle = rows->at[lane] + rows->slope_z[lane] * (float)z;
        const int first_y = (int)y_of_z.lo_least[z] - 1;
        const int last_y = (int)y_of_z.hi_most[z] - 1;
        uint64_t *layer = bits + (size_t)(at[2] + z) * layer_words;
        tbx_layer l;
        int y;
        if (first_y > last_y) {
            continue;
        }
        if (first_y != (int)y_of_z.lo_most[z] - 1 || last_y != (int)y_of_z.hi_least[z] - 1) {
            tbx_later_add(&later, at[2] + z, at[1] + first_y, at[1] + last_y);
            continue;
        }
        l.lo_least = tbx_splat(x_of_z.lo_least[z]);
        l.lo_most = tbx_splat(x_of_z.lo_most[z]);
        l.hi_least = tbx_splat(x_of_z.hi_least[z]);
        l.hi_most = tbx_splat(x_of_z.hi_most[z]);
        l.plane_lo_least = tbx_splat(middle + rows->lo_least[lane]);
        l.plane_lo_most = tbx_splat(middle + rows->lo_most[lane]);
        l.plane_hi_least = tbx_splat(middle + rows->hi_least[lane]);
        l.plane_hi_most = tbx_splat(middle + rows->hi_most[lane]);
        l.slope = tbx_splat(rows->slope_y[lane]);
        for (y = first_y & ~3; y <= last_y; y += 4) {
            const int from = y < first_y ? first_y - y : 0;
            const int to = last_y - y < 3 ? last_y - y : 3;
            uint64_t *row = layer + (size_t)(at[1] + y + from) * row_words;
            tbx_i4 first;
            tbx_i4 last;
            const tbx_i4 unsure = tbx_layer_rows(&l, &x_of_y, y, &first, &last);
            if (TBX_RARELY(tbx_any(unsure))) {
                for (i = from; i <= to; i++) {
                    if (unsure[i] != 0) {
                        tbx_later_add(&later, at[2] + z, at[1] + y + i, at[1] + y + i);
                    }
                }
                last |= unsure; /* nothing */
            }
            tbx_layer_set(t, row, row_words, layer_words, first + tbx_splat_int(at[0] - 1),
                          last + tbx_splat_int(at[0] - 1), from, to);
        }
    }
    if (later.first[0] <= later.last[0]) {
        tbx_later *slot = tbx_fill_later(fill, g->triangle[lane]);
        later.back = slot->back;
        *slot = later;
    }
}

TBX_NOINLINE void tbx_rows_flush_few(tbx_fill *fill, tbx_group *g)
{
    tbx_rows rows;
    tbx_few few;
    int rows_y = 0;
    int layers = 0;
    int i;
    if (g->n == 0) {
        return;
    }
    tbx_group_pad(g);
    for (i = 0; i < TBX_WIDE; i++) {
        const int more = g->box[i][3];
        const int y = (more >> 8 & 255) + 1;
        const int z = (more >> 16 & 255) + 1;
        rows_y = y > rows_y ? y : rows_y;
        layers = z > layers ? z : layers;
    }
    tbx_rows_set(&rows, &fill->quick, g, fill->source);
    tbx_few_set(&few, &rows, rows_y, layers);
    for (i = 0; i < g->n; i++) {
        if (few.unsure[i] != 0) {
            tbx_fill_later(fill, g->triangle[i]);
        } else {
            tbx_few_store(&few, fill, g, i);
        }
    }
    g->n = 0;
}

TBX_NOINLINE void tbx_rows_flush(tbx_fill *fill, tbx_group *g)
{
    tbx_rows rows;
    int i;
    if (g->n == 0) {
        return;
    }
    tbx_group_pad(g);
    tbx_rows_set(&rows, &fill->quick, g, fill->source);
    for (i = 0; i < g->n; i++) {
        if (rows.unsure[i] != 0) {
            tbx_fill_later(fill, g->triangle[i]);
        } else {
            tbx_lane_fill(fill, &rows, g, i);
        }
    }
    g->n = 0;
}

/* ---- All ways together */

/* A box of any kind, by rows or exactly. */
TBX_FN void tbx_fill_any(tbx_fill *fill, tbx_i4 box, size_t triangle)
{
    const int by_rows = !fill->quick.is_double; /* rows take corners for floats */
    if (by_rows && (box[3] & ~(TBX_ON_LATTICE | 0x010101 * (TBX_FEW - 1))) == 0) {
        if (tbx_group_add(&fill->rows[0], box, triangle)) {
            tbx_rows_flush_few(fill, &fill->rows[0]);
        }
    } else if (by_rows && (box[3] & 0xc0c0c0) == 0) {
        if (tbx_group_add(&fill->rows[1], box, triangle)) {
            tbx_rows_flush(fill, &fill->rows[1]);
        }
    } else {
        tbx_fill_later(fill, triangle);
    }
}

/* The triangles that groups were unsure of, precisely. */
TBX_NOINLINE void tbx_fill_again(tbx_fill *fill, tbx_group *g)
{
    const tbx_bits to = tbx_bits_of(fill);
    tbx_precise_voxels voxels;
    unsigned unsure;
    int i;
    if (g->n == 0) {
        return;
    }
    unsure = tbx_precise_decide(&fill->quick, fill->source, g, &voxels);
    for (i = 0; i < g->n; i++, unsure >>= 1) {
        const tbx_i4 box = g->box[i];
        const int more_y = box[3] >> 8 & 255;
        const int more_z = box[3] >> 16 & 255;
        const unsigned x = (unsigned)box[0] & 63u;
        uint64_t *row = to.bits + (size_t)tbx_first_word(&fill->quick, tbx_key_set(box));
        int y;
        int z;
        if ((unsure & 1u) != 0) {
            tbx_fill_later(fill, g->triangle[i]);
            continue;
        }
        for (z = 0; z <= more_z; z++, row += to.layer_words) {
            uint64_t layer = voxels.layer[i][z];
            uint64_t *word = row;
            for (y = 0; y <= more_y; y++, word += to.row_words, layer >>= 8) {
                tbx_run_or(word, layer & 255, x);
            }
        }
    }
    g->n = 0;
}

/* Sets the voxels of some that are not all sure; those that are unsure go the precise way. */
TBX_NOINLINE void tbx_some_set_sure(tbx_fill *fill, const tbx_some *some, unsigned unsure,
                                    const uint64_t voxels[TBX_WIDE])
{
    const tbx_bits to = tbx_bits_of(fill);
    int j;
    for (j = 0; j < some->count; j++) {
        const size_t i = some->list[j];
        const uint64_t key = tbx_block_key(some->block, (int)i);
        if ((unsure >> j & 1u) == 0) {
            tbx_voxels_set(&to, to.bits + some->block->word[i], key, voxels[j], 4);
        } else if (!fill->quick.precise) {
            tbx_fill_later(fill, some->block->start + i);
        } else if (tbx_group_add(&fill->again, tbx_key_box(key, tbx_key_more(key)), some->block->start + i)) {
            tbx_fill_again(fill, &fill->again);
        }
    }
}

/* Sets the voxels of boxes of up to n^3; 2: each has two rows in two layers, or 1: two rows, which are two
 * layers apart where `by_layers`. */
TBX_FORCED void tbx_some_set(tbx_fill *fill, const tbx_some *some, int n, const uint64_t voxels[TBX_WIDE],
                             int by_layers)
{
    const tbx_bits to = tbx_bits_of(fill);
    const size_t step = by_layers ? to.layer_words : to.row_words;
    const int shift = by_layers ? 16 : 4;
    int j;
    for (j = 0; j < some->count; j++) {
        const int i = some->list[j];
        const unsigned x = (unsigned)(some->block->first[i] >> 16) & 63u;
        uint64_t *row = to.bits + some->block->word[i];
        const uint64_t v = voxels[j];
        if (n > 2) {
            tbx_voxels_set(&to, row, tbx_block_key(some->block, i), v, n);
        } else if (TBX_RARELY(x > 62)) {
            tbx_voxels_set_two(&to, row, tbx_block_key(some->block, i), v);
        } else if (n == 1) {
            row[0] |= (v & 3) << x;
            row[step] |= (v >> shift & 3) << x;
        } else {
            row[0] |= (v & 3) << x;
            row[to.row_words] |= (v >> 4 & 3) << x;
            row[to.layer_words] |= (v >> 16 & 3) << x;
            row[to.row_words + to.layer_words] |= (v >> 20 & 3) << x;
        }
    }
}

/* Decides a list of a class, and sets its voxels. */
TBX_FN void tbx_block_decide(tbx_fill *fill, const tbx_block *b, const tbx_corners *corners, unsigned c,
                             const unsigned char *list, int count)
{
    tbx_some some;
    some.block = b;
    some.corners = corners;
    some.list = list;
    for (; count > 0; count -= TBX_WIDE, some.list += TBX_WIDE) {
        uint64_t voxels[TBX_WIDE];
        unsigned unsure;
        some.count = count < TBX_WIDE ? count : TBX_WIDE;
        unsure = tbx_decide_class(voxels, &fill->quick, &some, c) & ((1u << some.count) - 1);
        if (TBX_RARELY(unsure != 0)) {
            tbx_some_set_sure(fill, &some, unsure, voxels);
        } else if (c == TBX_CLASS_FLAT_Y || c == TBX_CLASS_FLAT_Z) {
            tbx_some_set(fill, &some, 1, voxels, c == TBX_CLASS_FLAT_Y);
        } else if (c <= TBX_CLASS_2) {
            tbx_some_set(fill, &some, 2, voxels, 0);
        } else if (c == TBX_CLASS_3 || c == TBX_CLASS_ON_3) {
            tbx_some_set(fill, &some, 3, voxels, 0);
        } else {
            tbx_some_set(fill, &some, 4, voxels, 0);
        }
    }
}

/* Sets boxes of one voxel or two; that of the predecessor is set. */
TBX_FN void tbx_block_short(const tbx_block *b, const tbx_fill *fill)
{
    const tbx_bits to = tbx_bits_of(fill);
    uint64_t rest;
    for (rest = b->of[TBX_CLASS_ONE] & ~b->same; rest != 0; rest &= rest - 1) {
        const int i = __builtin_ctzll(rest);
        to.bits[b->word[i]] |= (uint64_t)1 << (b->first[i] >> 16 & 63);
    }
    for (rest = b->of[TBX_CLASS_PAIR] & ~b->same; rest != 0; rest &= rest - 1) {
        const int i = __builtin_ctzll(rest);
        const uint64_t bit = (uint64_t)1 << (b->first[i] >> 16 & 63);
        uint64_t *row = to.bits + b->word[i];
        row[0] |= bit;
        row[b->more[i] >> 24 != 0 ? to.layer_words : to.row_words] |= bit;
    }
    for (rest = b->of[TBX_CLASS_RUN] & ~b->same; rest != 0; rest &= rest - 1) {
        const int i = __builtin_ctzll(rest);
        const unsigned x = (unsigned)(b->first[i] >> 16) & 63u;
        uint64_t *row = to.bits + b->word[i];
        row[0] |= (uint64_t)3 << x;
        if (TBX_RARELY(x == 63)) {
            row[1] |= 1;
        }
    }
}

/* So many triangles from t, BLOCK at most: boxes, and the voxels of those of up to 4^3. */
TBX_NOINLINE void tbx_fill_small(tbx_fill *fill, tbx_block *b, size_t t, int count)
{
    tbx_corners corners;
    unsigned c;
    tbx_block_find(b, &corners, fill->frame->grid, &fill->quick, fill->source, t, count, &fill->habit);
    tbx_block_short(b, fill);
    for (c = TBX_CLASS_FLAT_X; c < TBX_CLASS_LARGE; c++) {
        if (b->of[c] != 0) {
            unsigned char list[TBX_LIST];
            const int count_of = tbx_list_of(list, b->of[c]);
            tbx_block_decide(fill, b, &corners, c, list, count_of);
        }
    }
}

/* The same, and the larger ones by rows, when the corners are off the stack. */
TBX_NOINLINE void tbx_fill_block(tbx_fill *fill, size_t t, int count)
{
    tbx_block b;
    uint64_t rest;
    tbx_fill_small(fill, &b, t, count);
    for (rest = b.of[TBX_CLASS_LARGE]; rest != 0; rest &= rest - 1) {
        const int i = __builtin_ctzll(rest);
        tbx_fill_any(fill, tbx_key_box(b.first[i], tbx_block_more(&b, i)), t + (size_t)i);
    }
    for (rest = b.of[TBX_CLASS_AGAIN]; rest != 0; rest &= rest - 1) {
        const int i = __builtin_ctzll(rest);
        if (tbx_group_add(&fill->again, tbx_key_box(b.first[i], tbx_block_more(&b, i)), t + (size_t)i)) {
            tbx_fill_again(fill, &fill->again);
        }
    }
}

/* What the other ways have left. */
TBX_FN void tbx_fill_all_later(tbx_fill *fill)
{
    int i;
    int k;
    for (i = 0; i < fill->later_count; i++) {
        const tbx_later *d = &fill->later[i];
        tbx_part part;
        for (k = 0; k < 2; k++) {
            part.first[k] = d->first[k];
            part.last[k] = d->last[k];
        }
        tbx_fill_triangle(fill->frame, fill->source, fill->next - d->back, &part, fill->target);
    }
    fill->later_count = 0;
}

/* For a source's first triangles. Doubles are taken for floats as long as they are floats: that is faster,
 * and floats are known on lattices. */
TBX_FN void tbx_quick_start(tbx_quick *q, const tribox_grid *grid, const tbx_source *source,
                            const tbx_target *t)
{
    tbx_quick_init(q, grid, t, 0);
    if (source->is_double && !q->on) {
        tbx_quick_init(q, grid, t, 1);
    }
}

/* All triangles. Returns how many are done: 0 if the grid's numbers are out of range. */
TBX_FN size_t tbx_fill_quick(const tbx_frame *frame, const tbx_source *source, const tbx_target *target)
{
    tbx_fill fill;
    size_t t = 0;
    fill.frame = frame;
    fill.source = source;
    fill.target = target;
    fill.later_count = 0;
    fill.rows[0].n = fill.rows[1].n = fill.again.n = 0;
    tbx_quick_start(&fill.quick, frame->grid, source, target);
    fill.habit = TBX_HABIT_NONE;
    while (fill.quick.on && t < source->triangles) {
        const size_t rest = source->triangles - t;
        const int count = rest < TBX_BLOCK ? (int)rest : TBX_BLOCK;
        int no_floats;
        fill.next = t + (size_t)count;
        tbx_fill_block(&fill, t, count);
        no_floats = fill.habit == TBX_HABIT_NO_FLOATS;
        /* also so that `back` fits */
        if (no_floats || fill.next / TBX_BLOCK % 256 == 0 || fill.next == source->triangles) {
            tbx_rows_flush_few(&fill, &fill.rows[0]);
            tbx_rows_flush(&fill, &fill.rows[1]);
            tbx_fill_again(&fill, &fill.again);
        }
        tbx_fill_all_later(&fill);
        if (no_floats) {
            tbx_quick_init(&fill.quick, frame->grid, target, 1);
            fill.habit = TBX_HABIT_NONE;
        } else {
            t = fill.next;
        }
    }
    return t;
}

/* ---- Spans of meshes */

/* A block whose small boxes are decided: bit x + 4 y + 16 z of `voxels`; none: walk. */
typedef struct tbx_decided {
    tbx_block block;
    uint64_t voxels[TBX_BLOCK];
} TBX_ALIGNED tbx_decided;

/* Its boxes with corners beside grid planes. */
TBX_NOINLINE void tbx_decide_again(tbx_decided *d, const tbx_quick *q, const tbx_source *source, size_t first)
{
    const tbx_block *b = &d->block;
    uint64_t rest = b->of[TBX_CLASS_AGAIN];
    tbx_group g;
    while (rest != 0) {
        tbx_precise_voxels voxels;
        unsigned unsure;
        int i;
        int z;
        for (g.n = 0; g.n < TBX_WIDE && rest != 0; rest &= rest - 1) {
            const int at = __builtin_ctzll(rest);
            (void)tbx_group_add(&g, tbx_key_box(b->first[at], tbx_block_more(b, at)), first + (size_t)at);
        }
        unsure = tbx_precise_decide(q, source, &g, &voxels);
        for (i = 0; i < g.n; i++) {
            const int more = g.box[i][3];
            uint64_t *out = &d->voxels[g.triangle[i] - first];
            *out = 0;
            for (z = more >> 16 & 255; z >= 0 && (unsure >> i & 1u) == 0 && (more & 0x040404) == 0; z--) {
                const uint64_t four = voxels.layer[i][z];
                *out = *out << 16 | (four & 15) | (four >> 4 & 0xf0) | (four >> 8 & 0xf00) |
                       (four >> 12 & 0xf000);
            }
        }
    }
}

TBX_NOINLINE void tbx_decide_block(tbx_decided *d, const tbx_quick *q, const tribox_grid *grid,
                                   const tbx_source *source, size_t first, int count, int *habit)
{
    tbx_corners corners;
    tbx_some some;
    unsigned c;
    tbx_block_find(&d->block, &corners, grid, q, source, first, count, habit);
    some.block = &d->block;
    some.corners = &corners;
    for (c = TBX_CLASS_FLAT_X; c < TBX_CLASS_LARGE; c++) {
        unsigned char list[TBX_LIST];
        int left = tbx_list_of(list, d->block.of[c]);
        some.list = list;
        for (; left > 0; left -= TBX_WIDE, some.list += TBX_WIDE) {
            uint64_t voxels[TBX_WIDE];
            unsigned unsure;
            int i;
            some.count = left < TBX_WIDE ? left : TBX_WIDE;
            unsure = tbx_decide_class(voxels, q, &some, c);
            for (i = 0; i < some.count; i++) {
                d->voxels[some.list[i]] = (unsure >> i & 1u) != 0 ? 0 : voxels[i];
            }
        }
    }
    tbx_decide_again(d, q, source, first);
}

/* The spans of a decided box, 16 at most. */
TBX_NOINLINE int tbx_decided_spans(const tbx_decided *d, int at, const int lo[3], tbx_span *out)
{
    const uint64_t key = tbx_block_key(&d->block, at);
    uint64_t voxels = d->voxels[at];
    int first[3];
    int n = 0;
    int k;
    for (k = 0; k < 3; k++) {
        first[k] = lo[k] + (int)tbx_key_axis(key, k);
    }
    while (voxels != 0) {
        tbx_next_row(&out[n++], &voxels, first);
    }
    return n;
}

/* The spans of all triangles, a block at a time: first those that vectors decide, then, in the same memory,
 * the others. Returns how many triangles are done: 0 if the grid's numbers are out of range. */
TBX_FN size_t tbx_mesh_spans_quick(const tbx_frame *f, const tbx_source *source, tribox_mesh_span_fn on_span,
                                   void *user, size_t *count)
{
    union {
        tbx_decided decided;
        tbx_walked walked;
    } u;
    const int *lo = f->grid->lo;
    tbx_quick q;
    tbx_target target;
    size_t t = 0;
    int habit = TBX_HABIT_NONE;
    target.bits = NULL;
    target.row_words = (size_t)(f->last_x + 64) / 64;
    target.ny = (size_t)((int64_t)f->grid->hi[1] - lo[1]);
    tbx_quick_start(&q, f->grid, source, &target);
    while (q.on && t < source->triangles) {
        const size_t rest = source->triangles - t;
        const int in_block = rest < TBX_BLOCK ? (int)rest : TBX_BLOCK;
        unsigned char later[TBX_BLOCK];
        tbx_span span[16];
        uint64_t rest_of;
        int left = 0;
        unsigned c;
        int j;
        tbx_decide_block(&u.decided, &q, f->grid, source, t, in_block, &habit);
        if (habit == TBX_HABIT_NO_FLOATS) {
            tbx_quick_init(&q, f->grid, &target, 1);
            habit = TBX_HABIT_NONE;
            continue;
        }
        rest_of = u.decided.block.of[TBX_CLASS_ONE] | u.decided.block.of[TBX_CLASS_RUN] |
                  u.decided.block.of[TBX_CLASS_PAIR];
        for (; rest_of != 0; rest_of &= rest_of - 1) {
            const int i = __builtin_ctzll(rest_of);
            const uint64_t key = tbx_block_key(&u.decided.block, i);
            span[0].x0 = span[1].x0 = span[1].x1 = lo[0] + (int)tbx_key_axis(key, 0);
            span[0].x1 = span[0].x0 + (int)(key & 1);
            span[0].y = lo[1] + (int)tbx_key_axis(key, 1);
            span[1].y = span[0].y + (int)(key >> 2 & 1);
            span[0].z = lo[2] + (int)tbx_key_axis(key, 2);
            span[1].z = span[0].z + (int)(key >> 4 & 1);
            tbx_tell(span, 1 + (int)((key >> 2 | key >> 4) & 1), t + (size_t)i, on_span, user, count);
        }
        for (c = TBX_CLASS_FLAT_X; c <= TBX_CLASS_AGAIN; c++) {
            for (rest_of = u.decided.block.of[c]; rest_of != 0; rest_of &= rest_of - 1) {
                const int i = __builtin_ctzll(rest_of);
                if (c == TBX_CLASS_LARGE || u.decided.voxels[i] == 0) {
                    later[left++] = (unsigned char)i;
                } else {
                    tbx_tell(span, tbx_decided_spans(&u.decided, i, lo, span), t + (size_t)i, on_span, user,
                             count);
                }
            }
        }
        for (j = 0; j < left; j++) {
            int n = tbx_walked_begin(&u.walked, f, source, t + later[j]);
            while (n > 0) {
                tbx_tell(u.walked.span, n, t + later[j], on_span, user, count);
                n = n < TBX_SPANS ? 0 : tbx_walk_next(&u.walked.walk, u.walked.span);
            }
        }
        t += (size_t)in_block;
    }
    return t;
}

/* ---- Spans of one triangle
 *
 * A call for one triangle mostly pays for what is done once. So here the grid's numbers are looked at, and
 * the corners' coordinates and index box found, on several axes at once, and what is left to decide about a
 * box of up to 4^3 voxels, as in section 8, is decided in floats from its first inner grid point. E of an
 * edge is taken at each cell's critical corner, that farthest inside: a cell is missed where the least of the
 * three is negative. Lanes are the planes yz, zx, xy. What is unsure, thin, larger, or not wholly in the
 * region walks.
 *
 * Index boxes: c = (v - origin) * inverse, |c| < 2^19, is off by 6 u64 |c|, and the sum with LONE_PLACE,
 * whose upper half is a whole number and whose lower half counts units of 2^-32, by one more: less than NEAR
 * units. Subnormals read as zero add 2^-126 * 2^90 at most.
 *
 * Error of what decides, in units of u = 2^-23, coordinates v being within -1..3 and off by 3.1 (they are
 * rounded to floats, and c by 2^-30):
 *   E      Four coordinates, times 3: 38; two products of 9, their difference of 18: 36. Steps are off by
 *          6.2 + 4. Two of them at most lead to the first cell, 20.4 and two sums of at most 26, six to the
 *          others, each 10.2 and a sum of 32, or as much for its product and sum: less than EDGE_ERROR.
 *   area   Three E of 74, two sums of 36 and 17: less than that.
 *   D      Three areas off by 275, times 3; coordinates times 16; products of 48; sums of 96 and 144: 3,008.
 *          Three steps along x at once, 3 * 275 + 48 + 192, and two along y and z, each 275 + 192: less than
 *          PLANE_ERROR.
 * tests/proofs/lone.gappa has the rounding. */
#define TBX_LONE_PLACE 1572864.0  /* 2^20 + 2^19 */
#define TBX_LONE_HIGH 0x41380000  /* the upper half of its bits, */
#define TBX_LONE_RANGE 0x41300000 /* and what sums with less than 2^19 have in common, above 20 bits */
#define TBX_LONE_NEAR 16
#define TBX_LONE_EDGE_ERROR (512.0f * TBX_U32)
#define TBX_LONE_PLANE_ERROR (8192.0f * TBX_U32)

/* Corners: x and y; z of corners 0 and 1; z of corner 2, twice. */
typedef struct tbx_lone_corners {
    tbx_d2 xy[3];
    tbx_d2 z01;
    tbx_d2 z2;
    const void *from[3];
    int is_double;
} TBX_ALIGNED tbx_lone_corners;

/* Corners from the first inner grid point of a box of up to 4^3 voxels. */
typedef struct tbx_lone {
    tbx_f4 v[3];
    int32_t first[4];
    int32_t more[4];
} TBX_ALIGNED tbx_lone;

TBX_FORCED tbx_d2 tbx_kept2(tbx_d2 a)
{
    TBX_KEEP_VECTOR(a);
    return a;
}

TBX_FORCED tbx_f4 tbx_zxy(tbx_f4 a)
{
    return TBX_LANES(a, a, 2, 0, 1, 3);
}

TBX_FORCED tbx_f4 tbx_lanes_where(tbx_i4 mask, tbx_f4 a)
{
    return (tbx_f4)((tbx_i4)a & mask);
}

/* Returns 0 where a corner is NaN or infinite; of doubles also where it is beyond 2^150. */
TBX_FORCED int tbx_lone_load(tbx_lone_corners *c)
{
    const tbx_i4 magnitude = tbx_splat_int(0x7fffffff);
    const tbx_i4 most = tbx_splat_int(c->is_double ? (1023 + 150) << 20 : 0x7f7fffff);
    tbx_f4 x01 = tbx_splat(0.0f); /* x, y of corners 0 and 1, */
    tbx_f4 x2 = x01;              /* of corner 2, z of 0 and 1, */
    tbx_f4 z2 = x01;              /* z of corner 2 */
    tbx_i4 a;
    tbx_i4 b;
    tbx_i4 last;
    if (c->is_double) {
        const double *const v0 = (const double *)c->from[0];
        const double *const v1 = (const double *)c->from[1];
        const double *const v2 = (const double *)c->from[2];
        c->xy[0] = tbx_load2(v0);
        c->xy[1] = tbx_load2(v1);
        c->xy[2] = tbx_load2(v2);
        c->z01 = (tbx_d2)tbx_load_xy(v0 + 2, v1 + 2);
        c->z2 = (tbx_d2)tbx_load_xy(v2 + 2, v2 + 2);
        a = TBX_HIGH_WORDS(c->xy[0], c->xy[1]);
        b = TBX_HIGH_WORDS(c->xy[2], c->z01);
        last = TBX_HIGH_WORDS(c->z2, c->z2);
    } else {
        const float *const v0 = (const float *)c->from[0];
        const float *const v1 = (const float *)c->from[1];
        const float *const v2 = (const float *)c->from[2];
        const tbx_f4 z01 = { tbx_load_z(v0), tbx_load_z(v1), 0.0f, 0.0f };
        x01 = tbx_load_xy(v0, v1);
        x2 = TBX_LANES(tbx_load_pair(v2), z01, 0, 1, 4, 5);
        z2 = tbx_splat(tbx_load_z(v2));
        TBX_KEEP3(VECTOR, x01, x2, z2);
        a = (tbx_i4)x01;
        b = (tbx_i4)x2;
        last = (tbx_i4)z2;
    }
    TBX_KEEP3(VECTOR, a, b, last);
    if (TBX_RARELY(
            tbx_any(((a & magnitude) > most) | ((b & magnitude) > most) | ((last & magnitude) > most)))) {
        return 0;
    }
    if (!c->is_double) {
        tbx_d2 again;
        TBX_KEEP_VECTOR(x01); /* not converted before they are known to be finite */
        TBX_KEEP2(VECTOR, x2, z2);
        tbx_widen4(&c->xy[0], &c->xy[1], x01);
        tbx_widen4(&c->xy[2], &c->z01, x2);
        tbx_widen4(&c->z2, &again, z2);
    }
    return 1;
}

/* Origin and 1 / size, of x and y, and of z twice. Returns 0 where they are out of range, or no numbers. */
TBX_FORCED int tbx_lone_grid(tbx_d2 origin[2], tbx_d2 inverse[2], const tribox_grid *grid)
{
    const tbx_i4 magnitude = { 0x7fffffff, 0x7fffffff, -1, -1 };
    const tbx_i4 least = { -1, -1, (1023 - 90) << 20, (1023 - 90) << 20 };
    const tbx_i4 most = tbx_splat_int((1023 + 150) << 20);
    const tbx_d2 one = tbx_pair(1.0, 1.0);
    tbx_d2 size[2];
    tbx_i4 xy;
    tbx_i4 z;
    origin[0] = tbx_load2(grid->origin);
    size[0] = tbx_load2(grid->size);
    origin[1] = (tbx_d2)tbx_load_xy(&grid->origin[2], &grid->size[2]);
    TBX_KEEP3(VECTOR, origin[0], size[0], origin[1]);
    size[1] = TBX_PAIR(origin[1], origin[1], 1, 1);
    origin[1] = TBX_PAIR(origin[1], origin[1], 0, 0);
    xy = TBX_HIGH_WORDS(origin[0], size[0]) & magnitude;
    z = TBX_HIGH_WORDS(origin[1], size[1]) & magnitude;
    if (TBX_RARELY(tbx_any((xy > most) | (least > xy) | (z > most) | (least > z)))) {
        return 0;
    }
    TBX_KEEP2(VECTOR, size[0], size[1]);
    inverse[0] = one / size[0];
    inverse[1] = one / size[1];
    return 1;
}

/* Four numbers' sums with PLACE, of x and y, and of z. */
typedef struct tbx_lone_places {
    tbx_d2 xy;
    tbx_d2 z;
} TBX_ALIGNED tbx_lone_places;

/* Lanes in which such numbers are out of range, or near to a grid plane. */
TBX_FORCED tbx_i4 tbx_lone_unsure(const tbx_lone_places *p, const tbx_lone_places *q)
{
    const tbx_i4 range = tbx_splat_int(TBX_LONE_RANGE);
    const tbx_i4 near_by = tbx_splat_int(TBX_SIGN_BIT + 2 * TBX_LONE_NEAR);
    const tbx_i4 shift = tbx_splat_int(TBX_SIGN_BIT + TBX_LONE_NEAR);
    const tbx_i4 far_off = (TBX_HIGH_WORDS(p->xy, p->z) ^ range) | (TBX_HIGH_WORDS(q->xy, q->z) ^ range);
    return (near_by > tbx_wrapping_sum(TBX_LOW_WORDS(p->xy, p->z), shift)) |
           (near_by > tbx_wrapping_sum(TBX_LOW_WORDS(q->xy, q->z), shift)) |
           ((tbx_i4)((tbx_u4)far_off >> (tbx_u4)tbx_splat_int(20)) > tbx_splat_int(0));
}

/* The index box, and corners from its first inner grid point. Returns 0 if it is not sure, has more than 4^3
 * voxels, or not all of them are in the region. */
TBX_FORCED int tbx_lone_box(tbx_lone *r, const tribox_grid *grid, const tbx_lone_corners *c)
{
    const tbx_d2 place = tbx_pair(TBX_LONE_PLACE, TBX_LONE_PLACE);
    const tbx_d2 before = tbx_pair(TBX_LONE_PLACE - 1.0, TBX_LONE_PLACE - 1.0);
    const tbx_l2 upper = tbx_splat_long(-((int64_t)1 << 32));
    tbx_d2 origin[2];
    tbx_d2 inverse[2];
    tbx_d2 xy[3];
    tbx_d2 z[2];
    tbx_lone_places least;
    tbx_lone_places most;
    tbx_i4 first;
    tbx_i4 last;
    tbx_i4 more;
    tbx_i4 wrong;
    if (!tbx_lone_grid(origin, inverse, grid)) {
        return 0;
    }
    xy[0] = tbx_kept2(c->xy[0] - origin[0]) * inverse[0];
    xy[1] = tbx_kept2(c->xy[1] - origin[0]) * inverse[0];
    xy[2] = tbx_kept2(c->xy[2] - origin[0]) * inverse[0];
    z[0] = tbx_kept2(c->z01 - origin[1]) * inverse[1];
    z[1] = tbx_kept2(c->z2 - origin[1]) * inverse[1];
    least.z = tbx_min2(z[0], z[1]);
    most.z = tbx_max2(z[0], z[1]);
    least.xy = tbx_kept2(tbx_min2(tbx_min2(xy[0], xy[1]), xy[2]) + place);
    most.xy = tbx_kept2(tbx_max2(tbx_max2(xy[0], xy[1]), xy[2]) + place);
    least.z = tbx_kept2(tbx_min2(least.z, tbx_swap(least.z)) + place);
    most.z = tbx_kept2(tbx_max2(most.z, tbx_swap(most.z)) + place);
    first = tbx_wrapping_sum(TBX_HIGH_WORDS(least.xy, least.z), tbx_splat_int(-TBX_LONE_HIGH));
    last = tbx_wrapping_sum(TBX_HIGH_WORDS(most.xy, most.z), tbx_splat_int(-TBX_LONE_HIGH));
    more = (tbx_i4)((tbx_u4)last - (tbx_u4)first);
    wrong = tbx_lone_unsure(&least, &most) | (more > tbx_splat_int(3)) |
            ((tbx_i4)tbx_load_words((const char *)grid + offsetof(tribox_grid, lo)) > first) |
            ~((tbx_i4)tbx_load_words((const char *)grid + offsetof(tribox_grid, hi)) > last);
    if (TBX_RARELY((tbx_signs(wrong) & 7) != 0)) { /* lanes of both arrays' fourth number */
        return 0;
    }
    TBX_COPY(r->first, &first, sizeof first);
    TBX_COPY(r->more, &more, sizeof more);
    TBX_KEEP_VECTOR(least.xy); /* nothing is narrowed before it is known to be small */
    TBX_KEEP_VECTOR(least.z);
    least.xy = (tbx_d2)((tbx_l2)least.xy & upper) - before;
    least.z = (tbx_d2)((tbx_l2)least.z & upper) - before;
    {
        const tbx_f4 z01 = tbx_narrow(z[0] - least.z);
        const tbx_f4 z2 = tbx_narrow(z[1] - least.z);
        r->v[0] = TBX_LANES(tbx_narrow(xy[0] - least.xy), z01, 0, 1, 4, 5);
        r->v[1] = TBX_LANES(tbx_narrow(xy[1] - least.xy), z01, 0, 1, 5, 5);
        r->v[2] = TBX_LANES(tbx_narrow(xy[2] - least.xy), z2, 0, 1, 4, 5);
    }
    return 1;
}

/* An edge in the planes yz, zx and xy, lane by lane: E at the first cell's critical corner, and its steps
 * from cell to cell along y, x, x, and across, along z, z, y. */
typedef struct tbx_lone_edge {
    tbx_f4 at;
    tbx_f4 along;
    tbx_f4 across;
} TBX_ALIGNED tbx_lone_edge;

/* e: E at the first inner grid point; d: from corner to corner; s: the areas' signs. */
TBX_FORCED void tbx_lone_edge_set(tbx_lone_edge *r, tbx_f4 e, tbx_f4 d, tbx_i4 s)
{
    const tbx_i4 along = { TBX_SIGN_BIT, 0, TBX_SIGN_BIT, 0 };
    const tbx_i4 across = { 0, TBX_SIGN_BIT, 0, 0 };
    const tbx_f4 zero = tbx_splat(0.0f);
    r->along = (tbx_f4)((tbx_i4)TBX_LANES(d, d, 2, 2, 1, 3) ^ (s ^ along));
    r->across = (tbx_f4)((tbx_i4)TBX_LANES(d, d, 1, 0, 0, 3) ^ (s ^ across));
    r->at = ((tbx_f4)((tbx_i4)e ^ s) - tbx_min4(r->along, zero)) - tbx_min4(r->across, zero);
}

/* Of a cell the edge that leaves most of it outside. */
TBX_FORCED tbx_f4 tbx_lone_cell(tbx_f4 *least, tbx_f4 e0, tbx_f4 e1, tbx_f4 e2)
{
    const tbx_f4 value = tbx_min4(tbx_min4(e0, e1), e2);
    *least = tbx_min4(*least, tbx_abs4(value));
    return value;
}

/* The cells that the edges miss: bit `lane` + 4 * along + 16 * across. */
TBX_FORCED uint64_t tbx_lone_cells(tbx_f4 *least, const tbx_lone_edge edge[3], int rows)
{
    tbx_f4 at0 = edge[0].at;
    tbx_f4 at1 = edge[1].at;
    tbx_f4 at2 = edge[2].at;
    uint64_t missed = 0;
    int at = 0;
    do {
        tbx_f4 e0 = at0;
        tbx_f4 e1 = at1;
        tbx_f4 e2 = at2;
        tbx_f4 cell[4];
        cell[0] = tbx_lone_cell(least, e0, e1, e2);
        e0 += edge[0].along;
        e1 += edge[1].along;
        e2 += edge[2].along;
        cell[1] = tbx_lone_cell(least, e0, e1, e2);
        e0 += edge[0].along;
        e1 += edge[1].along;
        e2 += edge[2].along;
        cell[2] = tbx_lone_cell(least, e0, e1, e2);
        cell[3] = tbx_lone_cell(least, e0 + edge[0].along, e1 + edge[1].along, e2 + edge[2].along);
        missed |= (uint64_t)tbx_signs16((tbx_i4)cell[0], (tbx_i4)cell[1], (tbx_i4)cell[2], (tbx_i4)cell[3])
                  << at;
        at0 += edge[0].across;
        at1 += edge[1].across;
        at2 += edge[2].across;
        at += 16;
    } while (at < 16 * rows);
    return missed;
}

/* E of three edges of corners v at the first inner grid point. */
TBX_FORCED void tbx_lone_products(tbx_f4 e[3], const tbx_f4 v[3])
{
    const tbx_f4 b0 = tbx_yzx(v[0]);
    const tbx_f4 b1 = tbx_yzx(v[1]);
    const tbx_f4 b2 = tbx_yzx(v[2]);
    const tbx_f4 c0 = tbx_zxy(v[0]);
    const tbx_f4 c1 = tbx_zxy(v[1]);
    const tbx_f4 c2 = tbx_zxy(v[2]);
    e[0] = b0 * c1 - c0 * b1;
    e[1] = b1 * c2 - c1 * b2;
    e[2] = b2 * c0 - c2 * b0;
    TBX_KEEP3(VECTOR, e[0], e[1], e[2]);
}

/* The voxels that such cells miss. */
TBX_FORCED uint64_t tbx_lone_join(uint64_t cells)
{
    const uint64_t each = 0x1111 * TBX_EACH_LAYER;
    uint64_t x_z = cells >> 1 & each;
    uint64_t x_y = cells >> 2 & each;
    x_z = (x_z | x_z >> 3) & 0x0303 * TBX_EACH_LAYER;
    x_y = (x_y | x_y >> 3) & 0x0303 * TBX_EACH_LAYER;
    x_z = (x_z | x_z >> 6) & 15 * TBX_EACH_LAYER;
    x_y = (x_y | x_y >> 6) & 15 * TBX_EACH_LAYER;
    x_y = (x_y | x_y >> 12) & ((uint64_t)255 << 32 | 255);
    x_y = (x_y | x_y >> 24) & 65535;
    return x_y * TBX_EACH_LAYER | x_z * 0x1111 | (cells & each) * 15;
}

/* The voxels that the plane misses, n its normal. */
TBX_FORCED uint64_t tbx_lone_plane(tbx_f4 *least, const tbx_lone *r, tbx_f4 n)
{
    const tbx_f4 index = { 0.0f, 1.0f, 2.0f, 3.0f };
    const tbx_f4 products = n * r->v[0];
    const tbx_f4 n_x = TBX_LANES(n, n, 0, 0, 0, 0);
    const tbx_f4 n_y = TBX_LANES(n, n, 1, 1, 1, 1);
    const tbx_f4 n_z = TBX_LANES(n, n, 2, 2, 2, 2);
    const uint64_t steps = (uint64_t)0x15141110u << 32 | 0x05040100u; /* of n's signs, x + 4 y + 16 z */
    const int up = (int)(steps >> 8 * (tbx_signs((tbx_i4)n) & 7) & 255);
    const uint64_t points =
        (uint64_t)(0x777u >> 4 * (3 - r->more[1])) * (TBX_EACH_LAYER >> 16 * (4 - r->more[2]));
    tbx_f4 layer = ((TBX_LANES(products, products, 0, 0, 0, 0) + TBX_LANES(products, products, 1, 1, 1, 1)) +
                    TBX_LANES(products, products, 2, 2, 2, 2)) -
                   n_x * index;
    uint64_t below = 0;
    int at = 0;
    do {
        const tbx_f4 row1 = layer - n_y;
        const tbx_f4 row2 = row1 - n_y;
        *least = tbx_min4(tbx_min4(*least, tbx_abs4(layer)), tbx_min4(tbx_abs4(row1), tbx_abs4(row2)));
        below |= (uint64_t)tbx_signs16((tbx_i4)layer, (tbx_i4)row1, (tbx_i4)row2, (tbx_i4)row2) << at;
        layer -= n_z;
        at += 16;
    } while (at < 16 * r->more[2]);
    below &= points;
    return below << (21 - up) | (points ^ below) << up;
}

/* -1 in lanes of planes in which corners i and j are one point. */
TBX_FORCED tbx_i4 tbx_lone_point(const tbx_lone_corners *c, int i, int j)
{
    tbx_i4 same = tbx_load3i(c->from[i]) == tbx_load3i(c->from[j]);
    if (c->is_double) {
        const char *const p = (const char *)c->from[i];
        const char *const q = (const char *)c->from[j];
        const tbx_i4 xy = (tbx_i4)tbx_load_words(p) == (tbx_i4)tbx_load_words(q);
        const tbx_i4 yz =
            (tbx_i4)tbx_load_words(p + sizeof(double)) == (tbx_i4)tbx_load_words(q + sizeof(double));
        same = TBX_LANES(xy, yz, 0, 2, 6, 6) & TBX_LANES(xy, yz, 1, 3, 7, 7);
    }
    return TBX_LANES(same, same, 1, 2, 0, 3) & TBX_LANES(same, same, 2, 0, 1, 3);
}

/* The voxels; 0 where something is unsure. An edge along an axis is a point in the plane across it, and
 * decides nothing there; the triangle is a line, which the other two bound from both sides, whatever sign its
 * area of 0 has. So is the sign of that component of the normal: D does not change along the axis. */
TBX_FORCED uint64_t tbx_lone_voxels(const tbx_lone *r, const tbx_lone_corners *c)
{
    const tbx_f4 error = tbx_splat(TBX_LONE_EDGE_ERROR);
    const int32_t *const more = r->more;
    const int most = more[0] > more[1] ? more[0] : more[1];
    const int rows = 1 + (more[2] > most ? more[2] : most);
    const uint64_t box = tbx_small_box(more[0], 4 * more[1], 16 * more[2]);
    const int thick = tbx_signs(tbx_load4i(more) > tbx_splat_int(0)) & 7;
    const unsigned needs = 0x71204000u >> 4 * thick & 7; /* planes yz, zx, xy: 1, 2, 4 */
    tbx_lone_edge edge[3];
    tbx_f4 e[3];
    tbx_f4 n;
    tbx_f4 least = tbx_splat(1.0f);
    tbx_i4 flat = tbx_splat_int(0);
    tbx_i4 sign;
    uint64_t cells;
    uint64_t missed;
    int repeats; /* x, y, z that corners share */
    if (needs == 0) {
        return box;
    }
    tbx_lone_products(e, r->v);
    n = (e[0] + e[1]) + e[2];
    sign = (tbx_i4)n & tbx_splat_int(TBX_SIGN_BIT);
    tbx_lone_edge_set(&edge[0], e[0], r->v[1] - r->v[0], sign);
    tbx_lone_edge_set(&edge[1], e[1], r->v[2] - r->v[1], sign);
    tbx_lone_edge_set(&edge[2], e[2], r->v[0] - r->v[2], sign);
    repeats = tbx_signs((r->v[0] == r->v[1]) | (r->v[1] == r->v[2]) | (r->v[2] == r->v[0])) & 7;
    if (TBX_RARELY(repeats != 0)) {
        const tbx_f4 inside = tbx_splat(64.0f);
        const tbx_i4 point[3] = { tbx_lone_point(c, 0, 1), tbx_lone_point(c, 1, 2), tbx_lone_point(c, 2, 0) };
        edge[0].at += tbx_lanes_where(point[0], inside);
        edge[1].at += tbx_lanes_where(point[1], inside);
        edge[2].at += tbx_lanes_where(point[2], inside);
        flat = point[0] | point[1] | point[2];
    }
    cells = tbx_lone_cells(&least, edge, rows);
    if (TBX_RARELY((tbx_signs(((tbx_abs4(n) <= error) & ~flat) | (least <= error)) & (int)needs) != 0)) {
        return 0;
    }
    missed = tbx_lone_join(cells & needs * (0x1111 * TBX_EACH_LAYER));
    if (needs == 7) {
        least = tbx_splat(1.0f);
        missed |= tbx_lone_plane(&least, r, n);
        if (TBX_RARELY(tbx_any(least <= tbx_splat(TBX_LONE_PLANE_ERROR)))) {
            return 0;
        }
    }
    return box & ~missed;
}

/* The voxels of a box of up to 4^3, bit x + 4 y + 16 z from `first` on, that the triangle touches; 0 where
 * that is not sure. */
TBX_FORCED uint64_t tbx_lone_ask(int first[4], const tribox_grid *grid, const void *v0, const void *v1,
                                 const void *v2, int is_double)
{
    tbx_lone_corners c;
    tbx_lone r;
    c.from[0] = v0;
    c.from[1] = v1;
    c.from[2] = v2;
    c.is_double = is_double;
    if (!TBX_DOUBLE_IS_53_BITS || (grid->flags & TRIBOX_THIN) != 0 || !tbx_lone_load(&c) ||
        !tbx_lone_box(&r, grid, &c)) {
        return 0;
    }
    TBX_COPY(first, r.first, sizeof r.first);
    return tbx_lone_voxels(&r, &c);
}

TBX_NOINLINE uint64_t tbx_lone_find(int first[4], const tribox_grid *grid, const float v0[3],
                                    const float v1[3], const float v2[3])
{
    return tbx_lone_ask(first, grid, v0, v1, v2, 0);
}

TBX_NOINLINE uint64_t tbx_lone_find_f64(int first[4], const tribox_grid *grid, const double v0[3],
                                        const double v1[3], const double v2[3])
{
    return tbx_lone_ask(first, grid, v0, v1, v2, 1);
}

/* ---- 11.4 Companions */

#ifndef TRIBOX_NO_COMPANIONS
/* Lanes in which a closed box holds no real number: not lo <= hi, lo = infinity, hi = -infinity, NaN. */
TBX_FN tbx_i4 tbx_box_empty4(tbx_i4 lo, tbx_i4 hi)
{
    const tbx_i4 infinity = tbx_splat_int(0x7f800000);
    return (lo > hi) | (lo < -infinity) | (hi > infinity) | (lo == infinity) | (hi == -infinity);
}

TBX_FN int tbx_box_box4(const float a_min[3], const float a_max[3], const float b_min[3],
                        const float b_max[3])
{
    tbx_i4 a_lo = tbx_load3i(a_min);
    tbx_i4 a_hi = tbx_load3i(a_max);
    tbx_i4 b_lo = tbx_load3i(b_min);
    tbx_i4 b_hi = tbx_load3i(b_max);
    TBX_KEEP4(VECTOR, a_lo, a_hi, b_lo, b_hi);
    a_lo = tbx_keys((tbx_f4)a_lo);
    a_hi = tbx_keys((tbx_f4)a_hi);
    b_lo = tbx_keys((tbx_f4)b_lo);
    b_hi = tbx_keys((tbx_f4)b_hi);
    return !tbx_any(tbx_box_empty4(a_lo, a_hi) | tbx_box_empty4(b_lo, b_hi) | (b_lo > a_hi) | (a_lo > b_hi));
}

/* The end of the interval inside on axis k alone, read anew. */
TBX_COLD int64_t tbx_ray_end_again(const float origin[3], const float dir[3], const float box_min[3],
                                   const float box_max[3], int k, int e)
{
    const float t[2] = { 0.0f, 0.0f };
    const tbx_ray_ask a = tbx_ray_asked(origin, dir, t, box_min, box_max, TBX_FLOAT);
    return tbx_slabs_round(&a, k, e);
}

/* Where the ray enters (e = 0) or leaves (1) the slab of axis k, rounded outward. The difference of floats
 * errs by 2^-52 of itself, and by 2^-125 for what was read as zero, which is less than 2^-51 of it above
 * 1e-22; the quotient is checked to 2^-48 and 2^-51: less than 2^-47. */
TBX_FN int64_t tbx_ray_end(const float origin[3], const float dir[3], const float box_min[3],
                           const float box_max[3], int k, int e)
{
    const double d = (double)dir[k];
    const float *face = (d < 0.0) ^ e ? box_max : box_min;
    double a = (double)face[k] - (double)origin[k];
    double t;
    int64_t key;
    TBX_KEEP_SCALAR(a);
    t = a / d;
    TBX_KEEP_SCALAR(t);
    key = tbx_round_outward(t, TBX_SLAB_ERROR * tbx_abs(t), e);
    if (TBX_RARELY(!TBX_DOUBLE_IS_53_BITS || key == 0 ||
                   !(tbx_abs(t * d - a) < tbx_abs(a) * TBX_SLAB_INVERSE_ERROR && tbx_abs(a) > 1e-22))) {
        return tbx_ray_end_again(origin, dir, box_min, box_max, k, e);
    }
    return key;
}

/* Bounds of the filter in float. */
#define TBX_RAY_ERROR 1.9073486328125e-06f     /* 2^-19 */
#define TBX_RAY_NOTHING 8.673617379884035e-19f /* 2^-60 */

/* Writes an end of the interval inside: that of the axis (1, 2, 4: 0, 1, 2), or the ray's own (8). */
TBX_FN void tbx_ray_write(float *out, const float origin[3], const float dir[3], const float box_min[3],
                          const float box_max[3], int reached, int e, const float *own)
{
    if (out != NULL) {
        tbx_write(out, 0, TBX_FLOAT,
                  reached < 8 ? tbx_ray_end(origin, dir, box_min, box_max, reached >> 1, e)
                              : (int64_t)tbx_key32(own));
    }
}

/* Slabs in float, x, y, z in three lanes. Coordinates are below 2^40, so differences are at most 2^41, and
 * components of dir within [2^-64, 2^64), so every t in a box is at most 2^105; t_min and t_max are moved
 * into [-2^110, 2^110]. A difference errs by 2^-23 of itself, a reciprocal is checked to 2^-20, a product
 * errs by 2^-23: 2^-19 in all, and 2^-60 for what was flushed or read as zero (2^-125 * 2^64). The largest
 * lower and the least upper end are no farther from the exact ones than that. */
TBX_FN int tbx_ray_filter(const float origin[3], const float dir[3], const float t[2], const float box_min[3],
                          const float box_max[3], float *out_t0, float *out_t1)
{
    const tbx_i4 last_one = { 0, 0, 0, 0x3f800000 };
    const tbx_i4 least_exponent = tbx_splat_int(63 << 24);
    const tbx_f4 one = tbx_splat(1.0f);
    const tbx_f4 most = tbx_splat(1.2980742146337069e+33f); /* 2^110 */
    tbx_f4 o = tbx_load3(origin);
    tbx_f4 d = (tbx_f4)(tbx_load3i(dir) | last_one);
    tbx_f4 lo = tbx_load3(box_min);
    tbx_f4 hi = tbx_load3(box_max);
    tbx_f4 own = tbx_load_pair(t);
    const tbx_i4 greatest = tbx_greatest3((tbx_i4)o, (tbx_i4)lo, (tbx_i4)hi);
    tbx_f4 inverse;
    tbx_f4 a;
    tbx_f4 b;
    tbx_f4 lower;
    tbx_f4 upper;
    tbx_f4 ends;
    float first;
    float last;
    float error;
    int reached0;
    int reached1;
    /* by sign bits: out of range, also NaN and infinities; twice the bits of d have no sign */
    if (TBX_RARELY(tbx_any((tbx_splat_int(0x537fffff) - greatest) |
                           (tbx_i4)((tbx_u4)d + (tbx_u4)d - (tbx_u4)least_exponent) |
                           tbx_above(tbx_abs4(own), 0x7f800000)))) {
        return TBX_UNSURE;
    }
    TBX_KEEP3(VECTOR, o, d, lo);
    TBX_KEEP2(VECTOR, hi, own);
    inverse = one / d;
    a = lo - o;
    b = hi - o;
    TBX_KEEP3(VECTOR, inverse, a, b);
    /* by their sign bits: a reciprocal off by 2^-20; lo > hi */
    if (TBX_RARELY(
            tbx_any((tbx_splat_int(0x35800000) - tbx_magnitude(inverse * d - one)) | (tbx_i4)(hi - lo)))) {
        return TBX_UNSURE;
    }
    a = a * inverse;
    b = b * inverse;
    lower = tbx_min4(a, b);
    upper = tbx_max4(a, b);
    own = tbx_max4(tbx_min4(own, most), -most);
    ends = tbx_min4(TBX_LANES(-lower, upper, 0, 1, 4, 5), TBX_LANES(-lower, upper, 2, 2, 6, 6));
    ends = tbx_min4(ends, TBX_LANES(ends, ends, 1, 0, 3, 2));
    ends = tbx_min4(ends, TBX_LANES(-own, own, 0, 0, 5, 5));
    first = -ends[0];
    last = ends[2];
    error = TBX_RAY_ERROR * (tbx_absf(first) + tbx_absf(last)) + TBX_RAY_NOTHING;
    if (first - last > error) {
        return TBX_MISS;
    }
    if (!(last - first > error)) {
        return TBX_UNSURE;
    }
    error = first - (2.0f * TBX_RAY_ERROR * tbx_absf(first) + 2.0f * TBX_RAY_NOTHING);
    reached0 = (tbx_signs(lower >= tbx_splat(error)) & 7) | (own[0] >= error) << 3;
    error = last + (2.0f * TBX_RAY_ERROR * tbx_absf(last) + 2.0f * TBX_RAY_NOTHING);
    reached1 = (tbx_signs(upper <= tbx_splat(error)) & 7) | (own[1] <= error) << 3;
    if (TBX_RARELY(((reached0 & (reached0 - 1)) | (reached1 & (reached1 - 1))) != 0)) {
        return TBX_UNSURE; /* more than one axis may be the first or last */
    }
    tbx_ray_write(out_t0, origin, dir, box_min, box_max, reached0, 0, &t[0]);
    tbx_ray_write(out_t1, origin, dir, box_min, box_max, reached1, 1, &t[1]);
    return TBX_HIT;
}

/* The segment's conditions in float ("segment and box"). */
TBX_FN int tbx_segment_filter(const float p[3], const float q[3], const float box_min[3],
                              const float box_max[3])
{
    tbx_f4 p0 = tbx_load3(p);
    tbx_f4 p1 = tbx_load3(q);
    tbx_f4 lo = tbx_load3(box_min);
    tbx_f4 hi = tbx_load3(box_max);
    const tbx_i4 greatest =
        tbx_greater_high(tbx_greatest3((tbx_i4)p0, (tbx_i4)p1, (tbx_i4)lo), tbx_magnitude(hi));
    int hit;
    int open;
    int refused;
    if (TBX_RARELY(tbx_any(tbx_splat_int(0x52ffffff) - greatest))) {
        return TBX_UNSURE;
    }
    TBX_KEEP4(VECTOR, p0, p1, lo, hi);
    hit = tbx_segment4(p0, p1, tbx_max4(lo, tbx_min4(p0, p1)), tbx_min4(hi, tbx_max4(p0, p1)), &open,
                       &refused);
    if (TBX_RARELY(open | (refused != 8))) { /* one branch, hardly ever taken */
        if (open || (refused & 7) != 0 || tbx_may_flush(p) || tbx_may_flush(q) || tbx_may_flush(box_min) ||
            tbx_may_flush(box_max)) {
            return TBX_UNSURE;
        }
    }
    return hit;
}

/* ---- Spheres */

/* Is one of twelve floats subnormal, infinite or NaN? */
TBX_FN int tbx_odd4(const float a[3], const float b[3], const float c[3], const float d[3])
{
    const tbx_f4 w = tbx_abs4(tbx_load3(a));
    const tbx_f4 x = tbx_abs4(tbx_load3(b));
    const tbx_f4 y = tbx_abs4(tbx_load3(c));
    const tbx_f4 z = tbx_abs4(tbx_load3(d));
    return tbx_any(tbx_above(w, 0x7f7fffff) | tbx_above(x, 0x7f7fffff) | tbx_above(y, 0x7f7fffff) |
                   tbx_above(z, 0x7f7fffff) | tbx_below(w, 0x00800000) | tbx_below(x, 0x00800000) |
                   tbx_below(y, 0x00800000) | tbx_below(z, 0x00800000));
}

/* Is a float, above 0, within [least, most), given by their bits? */
TBX_FN int tbx_within(const float *x, uint32_t least, uint32_t most)
{
    return tbx_bits32(x) - least < most - least;
}

/* Both sides err by less than 6 u of themselves, u = 2^-23, and are compared with another u of them.
 * Centres are below 2^60 and radii at least 2^-40, so that what is flushed, 2^-126 of a difference or of a
 * square, is nothing to 2^-19 of their squares. */
#define TBX_BALL_ERROR4 (16.0f * TBX_U32)

/* Is |d| <= r? */
TBX_FN int tbx_ball4(tbx_f4 d, float r)
{
    float apart;
    float error;
    TBX_KEEP_VECTOR(d);
    d = d * d;
    apart = (d[0] + d[1]) + d[2];
    error = (apart + r * r) * TBX_BALL_ERROR4;
    apart -= r * r;
    return TBX_RARELY(!(tbx_absf(apart) > error)) ? TBX_UNSURE : (int)(apart < 0.0f);
}

TBX_FN int tbx_sphere_sphere4(const float a[3], const float *a_radius, const float b[3],
                              const float *b_radius)
{
    tbx_f4 p = tbx_load3(a);
    tbx_f4 q = tbx_load3(b);
    float of_a = *a_radius;
    float of_b = *b_radius;
    const tbx_i4 greatest = tbx_greater_high(tbx_magnitude(p), tbx_magnitude(q));
    if (TBX_RARELY(tbx_any(tbx_splat_int(0x5d7fffff) - greatest) ||
                   !tbx_within(a_radius, 0x2b800000u, 0x5d800000u) ||
                   !tbx_within(b_radius, 0x2b800000u, 0x5d800000u))) {
        return TBX_UNSURE;
    }
    TBX_KEEP_VECTOR(p); /* nothing is computed before it is known to be in range */
    TBX_KEEP_VECTOR(q);
    TBX_KEEP2(SCALAR, of_a, of_b);
    return tbx_ball4(p - q, of_a + of_b);
}

/* Faces that seem equal but differ in their bits may be subnormals read as zero, of which the lower may be
 * the greater; to a distance they add nothing. */
TBX_FN int tbx_sphere_box4(const float c[3], const float *radius, const float box_min[3],
                           const float box_max[3])
{
    const tbx_f4 zero = { 0.0f, 0.0f, 0.0f, 0.0f };
    tbx_f4 p = tbx_load3(c);
    tbx_f4 lo = tbx_load3(box_min);
    tbx_f4 hi = tbx_load3(box_max);
    float r = *radius;
    const tbx_i4 greatest = tbx_greatest3((tbx_i4)p, (tbx_i4)lo, (tbx_i4)hi);
    if (TBX_RARELY(tbx_any(tbx_splat_int(0x5d7fffff) - greatest) ||
                   !tbx_within(radius, 0x2b800000u, 0x5d800000u))) {
        return TBX_UNSURE;
    }
    TBX_KEEP3(VECTOR, p, lo, hi);
    TBX_KEEP_SCALAR(r);
    if (TBX_RARELY(tbx_any((lo > hi) | ((lo == hi) & ~((tbx_i4)lo == (tbx_i4)hi))))) {
        return TBX_UNSURE;
    }
    {
        tbx_f4 below = lo - p;
        tbx_f4 above = p - hi;
        TBX_KEEP2(VECTOR, below, above);
        return tbx_ball4(tbx_max4(tbx_max4(below, above), zero), r);
    }
}

/* v errs by 4 u of the magnitudes of its terms, and their sum m by as much of itself, so v is within 8 u m of
 * exact; v^2 errs by 2 u, r^2 |n|^2 by 6 u of itself. So v^2 - r^2 |n|^2 is sure beyond (2 |v| + error) error
 * with an error of 8 + 5 of m, as |v| is at most m. |n|^2 is at least 2^-40 and r at least 2^-30, so what is
 * flushed or read as 0, 2^-94 of v, is nothing to that. Returns what tribox_plane_sphere does, or UNSURE. */
#define TBX_PLANE_SPHERE_ERROR4 (16.0f * TBX_U32)

TBX_FN int tbx_plane_sphere4(const float n[3], const float *d, const float c[3], const float *radius)
{
    tbx_f4 x = tbx_load3(n);
    tbx_f4 y = tbx_load3(c);
    tbx_f4 of_d = { *d, 0.0f, 0.0f, 0.0f };
    float r = *radius;
    tbx_i4 greatest;
    TBX_KEEP_VECTOR(of_d);
    greatest = tbx_greatest3((tbx_i4)x, (tbx_i4)y, (tbx_i4)of_d);
    if (TBX_RARELY(tbx_any(tbx_splat_int(0x4e7fffff) - greatest) ||
                   !tbx_within(radius, 0x30800000u, 0x4e800000u))) { /* 2^30, 2^-30..2^30 */
        return TBX_UNSURE;
    }
    TBX_KEEP3(VECTOR, x, y, of_d);
    TBX_KEEP_SCALAR(r);
    {
        const tbx_f4 xy = x * y;
        const tbx_f4 xx = x * x;
        const tbx_f4 sums = tbx_three_sums3(xy, xx, tbx_abs4(xy));
        const float v = sums[0] + of_d[0];
        const float size = tbx_absf(v);
        const float error = (sums[2] + tbx_absf(of_d[0])) * TBX_PLANE_SPHERE_ERROR4;
        const float apart = v * v - r * r * sums[1];
        const float band = (size + size + error) * error;
        if (TBX_RARELY(!(tbx_absf(apart) > band)) || TBX_RARELY(!(sums[1] > 9.094947017729282e-13f))) {
            return TBX_UNSURE; /* 2^-40 */
        }
        return (-(int)(tbx_bits32(&v) >> 31) | 1) & ((int)(tbx_bits32(&apart) >> 31) - 1);
    }
}

/* Ray and sphere, with A, B, C and D as in section 10. MISS if it is certain that D < 0, or, from t >= 0 on,
 * that B > 0 and C > 0: most rays. HIT: numbers are in range, also for the run in double. Or UNSURE.
 *
 * In units of u: A errs by 3 of itself, B by 4 of the magnitudes b of its terms, b^2 <= A m.m, C by 6 of c =
 * m.m + r^2. So D < 0 where B^2 < A (C - K c) with K = 32: B^2 and A C err by 21 of A c. Where C > K c, and B
 * is not above 0, but seems so, B^2 is below 2^-40 A c, and D < 0.
 *
 * Numbers are below 2^28, r at least 2^-30. What is flushed or read as 0, 2^-125 of m and of dir, is 2^-94 of
 * c, and moves B by at most 2^-94 and A by 2^-124 or 2^-125 of its root: so A counts as 2^-60 less, B as
 * 2^-90 less, which is nothing to A c u where A is above 2^-60. */
#define TBX_PIERCE_ERROR4 (32.0f * TBX_U32)

TBX_FN int tbx_pierce4(const float origin[3], const float dir[3], const float *from, const float center[3],
                       const float *radius)
{
    const tbx_f4 flushed = { 8.673617379884035e-19f, 8.077935669463161e-28f, 0.0f, 0.0f };
    tbx_f4 m = tbx_load3(origin);
    tbx_f4 w = tbx_load3(dir);
    tbx_f4 x = tbx_load3(center);
    float r = *radius;
    const tbx_i4 greatest = tbx_greatest3((tbx_i4)m, (tbx_i4)x, (tbx_i4)w);
    if (TBX_RARELY(tbx_any(tbx_splat_int(0x4d7fffff) - greatest) ||
                   !tbx_within(radius, 0x30800000u, 0x4d800000u))) { /* 2^28, 2^-30..2^28 */
        return TBX_UNSURE;
    }
    TBX_KEEP3(VECTOR, m, w, x);
    TBX_KEEP_SCALAR(r);
    m = m - x;
    TBX_KEEP_VECTOR(m);
    {
        const tbx_f4 sums = tbx_three_sums3(w * w, w * m, m * m) - flushed;
        const float least = (sums[2] - r * r) - (sums[2] + r * r) * TBX_PIERCE_ERROR4;
        const int behind = (tbx_bits32(from) >> 31 == 0) & (sums[1] > 0.0f);
        const int beside = sums[0] * least > sums[1] * sums[1];
        return !((beside | behind) & (least > 0.0f));
    }
}

/* ---- Gap */

#if TBX_DOUBLE_IS_53_BITS
/* 1/|l|, about, of edges 0..2 with units z, x, y, and, in the first row's last place, of the normal. */
typedef struct tbx_gap_roots {
    float of[12];
} tbx_gap_roots;

/* 1/sqrt(x) to 1.5 * 2^-12: the processor's guess; or one that is off by 4 %, and two steps, each of which
 * squares that, times 1.5. x counts as 2^-113 at least, so that no square overflows. */
TBX_FN tbx_f4 tbx_inverse_root4(tbx_f4 x)
{
    const tbx_f4 most = tbx_max4(x, tbx_splat(9.62964972193618e-35f));
#if defined(__SSE2__)
    return __builtin_ia32_rsqrtps(most);
#else
    const tbx_f4 half = most * tbx_splat(0.5f);
    const tbx_f4 much = tbx_splat(1.5f);
    tbx_f4 y = (tbx_f4)(tbx_splat_int(0x5f375a86) - (tbx_i4)((tbx_u4)most >> 1));
    y = y * (much - half * y * y);
    return y * (much - half * y * y);
#endif
}

/* Twice the s of the edge e x unit a, a = z, x, y: T covers `width` about a line, from which the box's centre
 * lies `centre` away; the box reaches r; all doubled and times |l|, whose inverse is `root`. Lane 3 is as
 * given. */
TBX_FN tbx_f4 tbx_gap_edge4(tbx_f4 e, tbx_f4 h, tbx_f4 h_yzx, tbx_f4 centre, tbx_f4 width, tbx_f4 root)
{
    return (tbx_abs4(centre) - width - tbx_radius4(tbx_abs4(e), h, h_yzx)) * root;
}

/* Which axes may attain s: those whose s is near enough to the greatest. As bits: 0..2 the faces, 4 + 4i the
 * edges i x unit z, x, y, 7 the normal; 0: out of range. Names as in tbx_filter4; D is the sum of all
 * magnitudes.
 *
 * In units of u = 2^-23: a difference errs by 1 of itself, w by 2 of what it is made of; an edge: a term of
 * its sums by 9 of itself, and all terms are at most 2 |l| D: less than 32 |l| D, so twice its s by less than
 * 2^-18 D, and by 2^-11 of itself for the root; a face's by less. n_k errs by 4 of g_k, the magnitudes of its
 * two products, so a term of n.w or |n|.h, with its share of the sums, by 11 g_k D; |n| itself by 4 of all
 * g_k, over |n| times twice the s, which is at most D: together less than 32 D times the sum of all g_k. What
 * the root adds to the greatest and to one as great, 3 * 2^-12, is less than 2^-10 of it.
 *
 * An axis that is 0 has the root 2^56, so what is subtracted as `void` drives it far below; others are moved
 * by 2^-26 D, as their roots are at most 2^24, but for normals: these count it as an error.
 *
 * In range: corners below 2^26, differences of corners, and of the two faces, 0 or at least 2^-24: products
 * of degree 4 are below 2^112, the error of a normal that is 0, 2^-18 * 3 * 2^55 * 2^29 * 2^57, below 2^125;
 * what is flushed is below 2^-100. */
#define TBX_GAP_ERROR4 (32.0f * TBX_U32)
#define TBX_GAP_ROOT 0.0009765625f           /* 2^-10 */
#define TBX_GAP_VOID 8.8817841970012523e-16f /* 2^-50 */

/* The error of the normal's s, in lane 3. All lanes are kept, as compilers put what they like, however large,
 * in those that nobody reads. */
TBX_FN tbx_f4 tbx_gap_of_normal(tbx_f4 sums, tbx_f4 error, tbx_f4 nothing, tbx_f4 root0)
{
    tbx_f4 terms = TBX_LANES(sums, sums, 1, 1, 1, 1);
    TBX_KEEP_VECTOR(terms);
    return (terms * error + nothing) * root0;
}

/* Twice the s of the faces; lane 3 is far below all. */
TBX_FN tbx_f4 tbx_gap_faces4(tbx_f4 p0, tbx_f4 p1, tbx_f4 p2, tbx_f4 lo, tbx_f4 hi)
{
    const tbx_f4 below_all = { 0.0f, 0.0f, 0.0f, -1099511627776.0f }; /* -2^40 */
    const tbx_f4 t_min = tbx_min4(tbx_min4(p0, p1), p2);
    const tbx_f4 t_max = tbx_max4(tbx_max4(p0, p1), p2);
    const tbx_f4 apart = tbx_max4(lo - t_max, t_min - hi);
    return apart + apart + below_all;
}

/* Differences of corners; h: of the faces; and for each edge the lanes of units z, x, y with which it makes
 * what a face says already: along which it has no length, so that it is along a unit vector. */
typedef struct tbx_gap_sides {
    tbx_f4 a1;
    tbx_f4 a2;
    tbx_f4 e1;
    tbx_f4 h;
    tbx_i4 said0;
    tbx_i4 said1;
    tbx_i4 said2;
} tbx_gap_sides;

/* The mask of numbers whose magnitudes are in range. w: the box's middle, twice, from p0; s: the faces'. */
TBX_FN unsigned tbx_gap_mask(const tbx_gap_sides *x, tbx_f4 w, tbx_f4 s, tbx_gap_roots *out_roots)
{
    const tbx_f4 a1 = x->a1;
    const tbx_f4 a2 = x->a2;
    const tbx_f4 e1 = x->e1;
    const tbx_f4 h = x->h;
    const tbx_f4 w_yzx = tbx_yzx(w);
    const tbx_f4 h_yzx = tbx_yzx(h);
    const tbx_f4 a1_yzx = tbx_yzx(a1);
    const tbx_f4 a2_yzx = tbx_yzx(a2);
    const tbx_f4 e1_yzx = tbx_yzx(e1);
    const tbx_f4 plus = a1 * a2_yzx;
    const tbx_f4 minus = a1_yzx * a2;
    const tbx_f4 n = plus - minus; /* z, x, y */
    const tbx_f4 n1 = a1 * e1_yzx - a1_yzx * e1;
    const tbx_f4 n_xyz = tbx_yzx(n);
    const tbx_f4 size = tbx_abs4(a1) + tbx_abs4(a2) + (tbx_abs4(w) + h);
    const tbx_f4 partial = size + TBX_LANES(size, size, 1, 2, 0, 0);
    const tbx_f4 d = TBX_LANES(partial, partial, 0, 0, 0, 0) + TBX_LANES(size, size, 2, 2, 2, 2);
    const tbx_f4 sums = tbx_sums3(n_xyz * w, tbx_abs4(n_xyz) * h);
    const tbx_f4 squares = tbx_sums3(n * n, tbx_abs4(plus) + tbx_abs4(minus));
    const tbx_f4 nothing = d * tbx_splat(TBX_GAP_VOID);
    const tbx_f4 error = d * tbx_splat(TBX_GAP_ERROR4);
    const tbx_f4 width = tbx_abs4(n) + nothing;
    const tbx_f4 root0 = tbx_inverse_root4(TBX_JOIN(a1 * a1 + a1_yzx * a1_yzx, squares, 0));
    const tbx_f4 root1 = tbx_inverse_root4(e1 * e1 + e1_yzx * e1_yzx);
    const tbx_f4 root2 = tbx_inverse_root4(a2 * a2 + a2_yzx * a2_yzx);
    const tbx_f4 error0 = TBX_JOIN(error, tbx_gap_of_normal(squares, error, nothing, root0), 3);
    const tbx_f4 s0 = tbx_gap_edge4(a1, h, h_yzx, TBX_JOIN(a1 * w_yzx - a1_yzx * w - n, sums, 0),
                                    TBX_JOIN(width, sums, 1), root0);
    const tbx_f4 s1 =
        tbx_gap_edge4(e1, h, h_yzx, e1 * w_yzx - e1_yzx * w + n1, tbx_abs4(n1) + nothing, root1);
    const tbx_f4 s2 = tbx_gap_edge4(a2, h, h_yzx, a2 * w_yzx - a2_yzx * w + n, width, root2);
    const tbx_f4 all = tbx_max4(tbx_max4(tbx_max4(s, s1), s2) - error, s0 - error0);
    const tbx_f4 pairs = tbx_max4(all, TBX_LANES(all, all, 2, 3, 0, 1));
    const tbx_f4 most = tbx_max4(pairs, TBX_LANES(pairs, pairs, 1, 0, 3, 2));
    const tbx_f4 least = most - tbx_splat(TBX_GAP_ROOT) * (tbx_abs4(most) + error) - error;
    TBX_COPY(out_roots->of, &root0, sizeof root0);
    TBX_COPY(out_roots->of + 4, &root1, sizeof root1);
    TBX_COPY(out_roots->of + 8, &root2, sizeof root2);
    return tbx_signs16(s >= least, (s0 + error0 >= least + error) & ~x->said0, (s1 >= least) & ~x->said1,
                       (s2 >= least) & ~x->said2);
}

/* Two corners differ, by a number that is subnormal or tiny: by the bits, whatever the processor reads
 * subnormals as. */
TBX_FN tbx_i4 tbx_gap_tiny4(tbx_f4 p, tbx_f4 q, tbx_i4 same)
{
    return ~same & (tbx_magnitude(q - p) - tbx_splat_int(0x33800000)); /* 2^-24 */
}

/* Sets what faces say already, also of the normal of a level triangle. Returns 1 if a difference is tiny, or
 * min > max. */
TBX_FN int tbx_gap_level(tbx_gap_sides *x, tbx_f4 p0, tbx_f4 p1, tbx_f4 p2, tbx_f4 lo, tbx_f4 hi)
{
    const tbx_i4 normal = { 0, 0, 0, -1 };
    const tbx_i4 same0 = (tbx_i4)p0 == (tbx_i4)p1;
    const tbx_i4 same1 = (tbx_i4)p1 == (tbx_i4)p2;
    const tbx_i4 same2 = (tbx_i4)p2 == (tbx_i4)p0;
    const tbx_i4 flat = (tbx_i4)lo == (tbx_i4)hi;
    const tbx_i4 refused = tbx_gap_tiny4(p0, p1, same0) | tbx_gap_tiny4(p1, p2, same1) |
                           tbx_gap_tiny4(p0, p2, same2) | tbx_gap_tiny4(lo, hi, flat) |
                           (~flat & (tbx_i4)x->h);
    x->said0 = (same0 | (tbx_i4)tbx_yzx((tbx_f4)same0)) & ~normal;
    x->said1 = same1 | (tbx_i4)tbx_yzx((tbx_f4)same1);
    x->said2 = same2 | (tbx_i4)tbx_yzx((tbx_f4)same2);
    if ((tbx_signs(same0 & same2) & 7) != 0) {
        x->said0 |= normal;
    }
    return tbx_any(refused);
}

TBX_FN unsigned tbx_gap_filter(const float v0[3], const float v1[3], const float v2[3],
                               const float box_min[3], const float box_max[3], tbx_gap_roots *out_roots)
{
    const tbx_f4 tiny = tbx_splat(5.9604644775390625e-08f); /* 2^-24 */
    tbx_f4 p0 = tbx_load3(v0);
    tbx_f4 p1 = tbx_load3(v1);
    tbx_f4 p2 = tbx_load3(v2);
    tbx_f4 lo = tbx_load3(box_min);
    tbx_f4 hi = tbx_load3(box_max);
    const tbx_i4 greatest = tbx_greatest5((tbx_i4)p0, (tbx_i4)p1, (tbx_i4)p2, (tbx_i4)lo, (tbx_i4)hi);
    tbx_gap_sides x;
    tbx_f4 l;
    tbx_f4 u;
    if (TBX_RARELY(tbx_any(tbx_splat_int(0x4c7fffff) - greatest))) { /* 2^26 */
        return 0;
    }
    TBX_KEEP3(VECTOR, p0, p1, p2);
    TBX_KEEP2(VECTOR, lo, hi);
    x.a1 = p1 - p0;
    x.a2 = p2 - p0;
    x.e1 = p2 - p1;
    x.h = hi - lo;
    l = lo - p0;
    u = hi - p0;
    TBX_KEEP3(VECTOR, x.a1, x.a2, x.e1);
    TBX_KEEP3(VECTOR, x.h, l, u);
    x.said0 = x.said1 = x.said2 = tbx_splat_int(0);
    if ((tbx_signs(tbx_min4(tbx_min4(tbx_abs4(x.a1), tbx_abs4(x.a2)), tbx_min4(tbx_abs4(x.e1), x.h)) < tiny) &
         7) != 0 &&
        TBX_RARELY(tbx_gap_level(&x, p0, p1, p2, lo, hi))) {
        return 0;
    }
    return tbx_gap_mask(&x, l + u, tbx_gap_faces4(p0, p1, p2, lo, hi), out_roots);
}

/* The filter's mask in tribox_sweep's order. */
TBX_FN unsigned tbx_gap_axes(unsigned mask)
{
    unsigned axes = (mask & 7u) | (mask >> 4 & 8u);
    unsigned i;
    for (i = 0; i < 3; i++) {
        const unsigned edge = mask >> (4 + 4 * i) & 7u; /* units z, x, y */
        axes |= ((edge & 1u) << 6 | (edge >> 1 & 1u) | (edge >> 2 & 1u) << 3) << (4 + i);
    }
    return mask == 0 ? TBX_GAP_ALL : axes;
}

/* x > 0 with the sign of y, without a branch. */
TBX_FN double tbx_with_sign(double x, double y)
{
    return tbx_from_bits64(tbx_bits64(&x) | (tbx_bits64(&y) & ((uint64_t)1 << 63)));
}

/* Of a face: differences of two floats err by u of themselves, and are 0 only if they are exactly; their own
 * difference by as much again. */
#define TBX_GAP_FACE_ERROR (8.0 * TBX_U64)

TBX_FN int tbx_gap_near_face(const float *const v[3], const float lo[3], const float hi[3], unsigned axis,
                             double *out_s, double out_axis[3])
{
    double x[5];
    double least;
    double most;
    double up;
    double down;
    tbx_widen(&x[0], &v[0][axis]); /* a subnormal is all that s may be */
    tbx_widen(&x[1], &v[1][axis]);
    tbx_widen(&x[2], &v[2][axis]);
    tbx_widen(&x[3], &lo[axis]);
    tbx_widen(&x[4], &hi[axis]);
    least = x[0] < x[1] ? x[0] : x[1];
    most = x[0] < x[1] ? x[1] : x[0];
    least = x[2] < least ? x[2] : least;
    most = x[2] > most ? x[2] : most;
    up = x[3] - most;
    down = least - x[4];
    *out_s = up > down ? up : down;
    out_axis[0] = out_axis[1] = out_axis[2] = 0.0;
    out_axis[axis] = tbx_with_sign(1.0, up - down);
    return tbx_abs(up - down) > TBX_GAP_FACE_ERROR * (tbx_abs(up) + tbx_abs(down));
}

/* g/|l| and the direction from what an axis l adds up to: twice the box's centre along it, less that of T,
 * and twice what both reach. 0 unless sure to 2^-40, given the error of both sums, and the square of what the
 * terms of l measure: l errs by 4 u of these, at most 2^7 of itself, which is 2^-43 of s. The root is a guess
 * from floats, whose l may have errors of its own: where its square is off by 2^-9 at most, a step of fifth
 * order leaves a quarter of the fifth power, 2^-47. The error may be .8 * 2^-40. */
#define TBX_GAP_SURE 1374389534720.0   /* 1.25 * 2^40 */
#define TBX_GAP_LENGTH 6.103515625e-05 /* 2^-14, of squares */
#define TBX_GAP_GUESS 0.001953125      /* 2^-9 */

TBX_FN int tbx_gap_near_end(double centre, double reach, double error, double square, double terms,
                            double *out_s, double *in_out_root)
{
    const double s = tbx_abs(centre) - reach;
    double root = *in_out_root;
    const double rest = 1.0 - square * root * root;
    root += root * rest * ((0.5 + 0.375 * rest) + rest * rest * (0.3125 + 0.2734375 * rest));
    *out_s = 0.5 * s * root;
    *in_out_root = tbx_with_sign(root, centre);
    return tbx_more(tbx_abs(s), TBX_GAP_SURE * error) & tbx_more(tbx_abs(centre), error) &
           tbx_more(square, TBX_GAP_LENGTH * terms) & tbx_more(TBX_GAP_GUESS, tbx_abs(rest));
}

/* An edge x a unit vector, counted from corner p. A difference errs by u, w by 2 u (|w| + h); a term of
 * the sums, with its share of these, by 7 u of its magnitude. */
#define TBX_GAP_EDGE_ERROR (11.0 * TBX_U64)

TBX_FN int tbx_gap_near_edge(const float *const v[5], const float lo[3], const float hi[3], unsigned edge,
                             unsigned unit, double root, double *out_s, double out_axis[3])
{
    const float *p = v[edge];
    const float *q = v[edge + 1];
    const float *r = v[edge + 2];
    const unsigned b = 9u >> 2 * unit & 3u;
    const unsigned c = 18u >> 2 * unit & 3u;
    const double e_b = (double)q[b] - (double)p[b];
    const double e_c = (double)q[c] - (double)p[c];
    const double r_b = (double)r[b] - (double)p[b];
    const double r_c = (double)r[c] - (double)p[c];
    const double w_b = ((double)lo[b] - (double)p[b]) + ((double)hi[b] - (double)p[b]);
    const double w_c = ((double)lo[c] - (double)p[c]) + ((double)hi[c] - (double)p[c]);
    const double h_b = (double)hi[b] - (double)lo[b];
    const double h_c = (double)hi[c] - (double)lo[c];
    const double x_b = tbx_abs(e_b);
    const double x_c = tbx_abs(e_c);
    const double t = e_c * r_b - e_b * r_c;
    const double mag =
        x_c * (tbx_abs(w_b) + h_b + 2.0 * tbx_abs(r_b)) + x_b * (tbx_abs(w_c) + h_c + 2.0 * tbx_abs(r_c));
    const double square = e_b * e_b + e_c * e_c;
    const int sure = tbx_gap_near_end((e_c * w_b - e_b * w_c) - t, x_c * h_b + x_b * h_c + tbx_abs(t),
                                      TBX_GAP_EDGE_ERROR * mag, square, 0.0, out_s, &root);
    out_axis[unit] = 0.0;
    out_axis[b] = e_c * root;
    out_axis[c] = -e_b * root;
    return sure;
}

/* The normal, counted from v0: n_k errs by 4 u of g_k, the magnitudes of its two products, a term of the
 * sums, with its share of these, by 10 u g_k (|w_k| + h_k). */
#define TBX_GAP_NORMAL_ERROR (14.0 * TBX_U64)

TBX_FN int tbx_gap_near_normal(const float *const v[3], const float lo[3], const float hi[3], double root,
                               double *out_s, double out_axis[3])
{
    double x[3];
    double y[3];
    double centre = 0.0;
    double reach = 0.0;
    double mag = 0.0;
    double square = 0.0;
    double terms = 0.0;
    int sure;
    int k;
    for (k = 0; k < 3; k++) {
        x[k] = (double)v[1][k] - (double)v[0][k];
        y[k] = (double)v[2][k] - (double)v[0][k];
    }
    for (k = 0; k < 3; k++) {
        const unsigned i = 9u >> 2 * k & 3u;
        const unsigned j = 18u >> 2 * k & 3u;
        const double plus = x[i] * y[j];
        const double minus = x[j] * y[i];
        const double n = plus - minus;
        const double g = tbx_abs(plus) + tbx_abs(minus);
        const double w = ((double)lo[k] - (double)v[0][k]) + ((double)hi[k] - (double)v[0][k]);
        const double h = (double)hi[k] - (double)lo[k];
        centre += n * w;
        reach += tbx_abs(n) * h;
        mag += g * (tbx_abs(w) + h);
        square += n * n;
        terms += g * g;
        out_axis[k] = n;
    }
    sure = tbx_gap_near_end(centre, reach, TBX_GAP_NORMAL_ERROR * mag, square, terms, out_s, &root);
    for (k = 0; k < 3; k++) {
        out_axis[k] *= root;
    }
    return sure;
}

#if TBX_LIMB_BITS == 64
__extension__ typedef __int128 tbx_i128;

/* The number as a double, to 2^-52. */
TBX_FN double tbx_gap_double(tbx_i128 x)
{
    const tbx_i128 size = x < 0 ? -x : x;
    const double high = (double)(int64_t)(size >> 62);
    const double low = (double)(int64_t)(size & (((tbx_i128)1 << 62) - 1));
    const double sum = high * 4611686018427387904.0 + low;
    return x < 0 ? -sum : sum;
}

/* The floats as integers in the unit of the least, if each takes 40 bits at most. */
TBX_FN int tbx_gap_integers(const float *const v[5], int64_t out[5][3], double *out_unit)
{
    uint32_t least = 255;
    uint32_t most = 1;
    int i;
    for (i = 0; i < 15; i++) {
        const uint32_t bits = tbx_bits32(v[i / 3] + i % 3) & 0x7fffffffu;
        const uint32_t exponent = bits >> 23 != 0 ? bits >> 23 : 1u;
        least = bits != 0 && exponent < least ? exponent : least;
        most = bits != 0 && exponent > most ? exponent : most;
    }
    if (most - least > 16u) {
        return 0;
    }
    for (i = 0; i < 15; i++) {
        const uint32_t bits = tbx_bits32(v[i / 3] + i % 3);
        const uint32_t field = bits >> 23 & 255u;
        const int64_t mantissa = (int64_t)((bits & 0x7fffffu) | (field != 0 ? 0x800000u : 0u));
        const int64_t size = mantissa == 0 ? 0 : mantissa << ((field != 0 ? field : 1u) - least);
        out[i / 3][i % 3] = bits >> 31 != 0 ? -size : size;
    }
    *out_unit = tbx_from_bits64((uint64_t)(1023 - 150 + least) << 52);
    return 1;
}

/* The same where double is not enough, in integers: l below 2^83, g below 2^126. 0 if the numbers are too
 * long, or both directions tie. */
TBX_COLD int tbx_gap_near_long(const float *const v[5], const float lo[3], const float hi[3], unsigned bit,
                               double *out_s, double out_axis[3])
{
    const float *const all[5] = { v[0], v[1], v[2], lo, hi };
    const int normal = bit == 7;
    const unsigned edge = (bit >> 2) - 1u;
    const unsigned unit = 18u >> 2 * (bit & 3u) & 3u; /* 2 0 1 */
    int64_t x[5][3];
    tbx_i128 l[3] = { 0, 0, 0 };
    tbx_i128 up = 0;
    tbx_i128 down = 0;
    tbx_i128 t = 0;
    double scale;
    unsigned k;
    if (!tbx_gap_integers(all, x, &scale)) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        const unsigned i = 9u >> 2 * k & 3u;
        const unsigned j = 18u >> 2 * k & 3u;
        const int64_t *p = x[edge];
        const int64_t *q = x[9u >> 2 * edge & 3u];
        const int64_t *r = x[18u >> 2 * edge & 3u];
        l[k] = (tbx_i128)(q[i] - p[i]) * (normal ? r[j] - p[j] : j == unit) -
               (tbx_i128)(q[j] - p[j]) * (normal ? r[i] - p[i] : i == unit);
        t += normal ? 0 : l[k] * (r[k] - p[k]);
        up += l[k] * ((l[k] > 0 ? x[3][k] : x[4][k]) - p[k]);
        down -= l[k] * ((l[k] > 0 ? x[4][k] : x[3][k]) - p[k]);
    }
    up -= t > 0 ? t : 0;
    down += t > 0 ? 0 : t;
    if (up == down) { /* also where the axis has no length */
        return 0;
    }
    for (k = 0; k < 3; k++) {
        out_axis[k] = tbx_gap_double(up > down ? l[k] : -l[k]);
    }
    *out_s = tbx_gap_double(up > down ? up : down) * scale;
    scale = out_axis[0] * out_axis[0] + out_axis[1] * out_axis[1] + out_axis[2] * out_axis[2];
    TBX_KEEP_SCALAR(scale);
    scale = tbx_inverse_root(scale);
    *out_s *= scale;
    for (k = 0; k < 3; k++) {
        out_axis[k] *= scale;
    }
    return 1;
}
#endif

/* Of the one axis with this bit; 0 where neither double nor 128 bits will do. */
TBX_FN int tbx_gap_near_one(const float *const v[5], const float lo[3], const float hi[3], unsigned bit,
                            const tbx_gap_roots *roots, double *out_s, double out_axis[3])
{
    int sure;
    if (bit < 3) {
        return tbx_gap_near_face(v, lo, hi, bit, out_s, out_axis);
    }
    sure = bit == 7 ? tbx_gap_near_normal(v, lo, hi, (double)roots->of[3], out_s, out_axis)
                    : tbx_gap_near_edge(v, lo, hi, (bit >> 2) - 1u, 18u >> 2 * (bit & 3u) & 3u,
                                        (double)roots->of[bit - 4], out_s, out_axis);
#if TBX_LIMB_BITS == 64
    if (TBX_RARELY(!sure)) {
        sure = tbx_gap_near_long(v, lo, hi, bit, out_s, out_axis);
    }
#endif
    return sure;
}

/* Of several, where one is the greatest by more than their errors. */
TBX_COLD int tbx_gap_near_several(const float *const v[5], const float lo[3], const float hi[3],
                                  unsigned mask, const tbx_gap_roots *roots, double *out_s,
                                  double out_axis[3])
{
    double axis[3];
    double s;
    int sure = tbx_gap_near_one(v, lo, hi, (unsigned)__builtin_ctz(mask), roots, out_s, out_axis);
    while (sure && (mask &= mask - 1u) != 0) {
        double apart;
        sure = tbx_gap_near_one(v, lo, hi, (unsigned)__builtin_ctz(mask), roots, &s, axis);
        apart = 2.0 * TBX_GAP_CLOSE * (tbx_abs(s) + tbx_abs(*out_s));
        sure &= tbx_more(tbx_abs(s - *out_s), apart);
        if (sure && s > *out_s) {
            *out_s = s;
            TBX_COPY(out_axis, axis, sizeof axis);
        }
    }
    return sure;
}

/* s and the direction of the axes that the filter named. */
TBX_FN int tbx_gap_near(const float *const v[5], const float lo[3], const float hi[3], unsigned mask,
                        const tbx_gap_roots *roots, double *out_s, float out_axis[3])
{
    double axis[3];
    const int sure = TBX_RARELY((mask & (mask - 1u)) != 0)
                         ? tbx_gap_near_several(v, lo, hi, mask, roots, out_s, axis)
                         : tbx_gap_near_one(v, lo, hi, (unsigned)__builtin_ctz(mask), roots, out_s, axis);
    if (sure && out_axis != NULL) {
        TBX_KEEP_SCALAR(axis[0]); /* what is not sure may be too large for a float */
        TBX_KEEP2(SCALAR, axis[1], axis[2]);
        out_axis[0] = (float)axis[0];
        out_axis[1] = (float)axis[1];
        out_axis[2] = (float)axis[2];
    }
    return sure;
}
#endif

/* tribox_gap in lanes: the axes that are left to ask, none where it is sure. */
TBX_FN unsigned tbx_gap_quick(const float *const v[5], const float box_min[3], const float box_max[3],
                              double *out_s, float out_axis[3])
{
#if TBX_DOUBLE_IS_53_BITS
    tbx_gap_roots roots;
    const unsigned mask = tbx_gap_filter(v[0], v[1], v[2], box_min, box_max, &roots);
    if (!TBX_RARELY(mask == 0) &&
        !TBX_RARELY(tbx_gap_near(v, box_min, box_max, mask, &roots, out_s, out_axis) == 0)) {
        return 0;
    }
    return tbx_gap_axes(mask);
#else
    (void)v, (void)box_min, (void)box_max, (void)out_s, (void)out_axis;
    return TBX_GAP_ALL;
#endif
}

#endif

/* ---- 11.5 Solid
 *
 * Seen along x, most triangles of a fine mesh hold no row's centre: their boxes tell, WIDE at a time. Those
 * of up to SOLID_ROWS rows on each axis wait in lists, and all rows of WIDE boxes are decided together, in
 * float; larger ones go line by line, in double. Whoever comes within the bounds goes the scalar way.
 *
 * Boxes. Row centres are whole numbers Y = (v - origin) inverse + rest, origin being the first centre as a
 * float, rest what that leaves; of doubles, v - origin is a float computed in double, and rest a MARGIN. Y is
 * off by u |Y| for each of the difference, inverse, product and sum, by u |rest|, and by u more for what rest
 * is widened by: 7 u (n + |rest| + 2) between the region's ends; beyond them it does not come back, since
 * each operation is monotone: the least corner has the least Y. Triangles with a corner beyond 2^22 voxels go
 * the scalar way. The first centre itself is off by 2 * 2^-52 M (section 9): MIDDLE_ERROR allows for twice
 * that.
 *
 * A box of one row is looked at again, before it waits, Y about that row: from its centre corners lie at most
 * R = 1.1 voxels, and are off by e = slack + 2 u R, so E_i is off by less than error = 4 R e + 5 u R^2. Where
 * one, times the sign of their sum, is below -2.1 error, another is above error: the centre is not within.
 *
 * Rows. Lengths are scaled by a power of two that takes a voxel's size to [1, 2). A centre i is high + low,
 * where high = base_high + i * size_high is exact: both are multiples of `spacing`, below 2^24 of it. low is
 * at most rho = spacing * (n + 34). (v - high) - low, v within m of the centre, is off by
 * delta(m) = 4 u (m + rho) + u m < 5 u (m + rho); of doubles, v - centre is computed in double, and rounded
 * once to float. In boxes of c rows all corners and centres are within R = 2 c + 0.1 of the first centre.
 * With e = delta(R),
 *   E_i = v_i x v_{i+1}, about the first centre      off by 4 R e + 4 u R^2,
 *   E_i there + j step_y A + k step_z B, in steps    R (2 e + 4 u R) more for each of j and k, and 36 u R^2,
 *   n_x = E_0 + E_1 + E_2, at the first centre       off by 3 of the first line and 16 u R^2:
 * all less than error = 16 R e + 64 u R^2. Where all s E_i are above it, s n_x > 0, and the centre is within;
 * where one is below -2 error, s cannot be wrong: the others would have to add up to less than -error.
 *
 * x = x_0 + ((x_1 - x_0) E_2 + (x_2 - x_0) E_0) / n_x, where the weights E / n_x of a centre within are at
 * most 1 and off by 2 error / n_x + 16 u, also where division is approximate: x is off by
 * (|x_1 - x_0| + |x_2 - x_0|) (2 error / n_x + 24 u) + 4 delta(m).
 *
 * From close by. Boxes of up to ROWS rows may be looked at again: a corner is off by 5 u (m + rho), m being
 * how far from the centre it seems, so the sign of what is above 6 u rho is sure. Of one row corners are
 * within R = 2.2, scaled; y_i z_j - z_i y_j is off by (5 + 5 + 1 + 1) u of its products, and by 5 u rho of
 * each of four factors: 45 u rho. An edge's sign is sure then, if the sum's is.
 *
 * On the lattice, that is where corners and centres are multiples of a PART of the unit of length, all E_i
 * are exact; half the least step, added where an edge's tie counts and taken off where not, leaves none at
 * 0. */
#define TBX_SOLID_ROWS 4
#define TBX_SOLID_PARTS 16
#define TBX_SOLID_MARGIN 16
#define TBX_SOLID_BLOCK 32
#define TBX_SOLID_CROSSINGS 24
#define TBX_SOLID_MIDDLE_ERROR (4.0 * TBX_U64)
#define TBX_SOLID_BOX_ERROR (7.0f * TBX_U32)
#define TBX_SOLID_PLACE_ERROR (5.0f * TBX_U32)
#define TBX_SOLID_NEAR_ERROR (6.0f * TBX_U32)
#define TBX_SOLID_ALONE_ERROR (13.0f * TBX_U32)
#define TBX_SOLID_ALONE_REST (45.0f * TBX_U32)
#define TBX_SOLID_LEAST 1e-18f /* 0 is not sure, nor what is flushed: 2^-126 of each product */
#define TBX_SOLID_ROW_ERROR 16.0f
#define TBX_SOLID_ROW_ULPS (64.0f * TBX_U32)

/* Centres of y and z in double: high + low, each exact; `least`: no high is closer to 0. */
typedef struct tbx_solid_exact {
    double base_high[2];
    double base_low[2];
    double size_high[2];
    double size_low[2];
    double least[2];
    int on;
} tbx_solid_exact;

/* y or z, for boxes. */
typedef struct tbx_solid_axis {
    tbx_fw origin;
    tbx_fw inverse;
    tbx_fw rest;      /* MARGIN added */
    tbx_fw rest_low;  /* less the slack */
    tbx_fw rest_high; /* and the slack */
    tbx_fw outside;   /* less than it, and more than minus it, lies the region */
    tbx_iw last;      /* behind it the region ends */
} TBX_ALIGNED tbx_solid_axis;

/* Centres of an axis, for rows. */
typedef struct tbx_solid_centres {
    tbx_fw scale;
    tbx_fw base_high;
    tbx_fw base_low;
    tbx_fw size_high;
    tbx_fw size_low;
} TBX_ALIGNED tbx_solid_centres;

typedef struct tbx_solid_quick {
    tbx_solid_axis axis[2];
    tbx_fw one_error;
    const tbx_solid *solid;
    const tbx_source *source;
    float origin[3];
    float inverse[3];
    int32_t most[3]; /* magnitudes above it, as integers, go the scalar way */
    float scale[3];
    float step[3];       /* size * scale */
    float over_step;     /* 1 / step[0] */
    float part[3];       /* a PART, not scaled */
    float near_error[2]; /* of y and z, close by; 0 on the lattice */
    tbx_solid_centres centres[3];
    float rho;            /* scaled, the largest */
    double most_reach[3]; /* M of corners within 2^21 voxels */
    tbx_solid_exact exact;
    int lattice;
    int on; /* 0: this grid's numbers are out of range */
} TBX_ALIGNED tbx_solid_quick;

/* What boxes need of axis k, 1 or 2. Returns slack. */
TBX_FN double tbx_solid_axis_init(tbx_solid_quick *q, int k)
{
    const tbx_solid *s = q->solid;
    const double size = s->grid->size[k];
    const double n = (double)s->n[k];
    const double left = q->source->is_double ? 0.0 : ((double)q->origin[k] - s->middle[k]) / size;
    const double source_middle = q->source->is_double ? 0.0 : tbx_abs(s->middle[k]);
    const double slack = TBX_BOUND_ERROR *
                         ((double)TBX_SOLID_BOX_ERROR * (n + 2.0 * TBX_SOLID_MARGIN + tbx_abs(left)) +
                          TBX_SOLID_MIDDLE_ERROR * s->reach[k] / size);
    tbx_solid_axis *axis = &q->axis[k - 1];
    axis->origin = tbx_wide_all(q->source->is_double ? 0.0f : q->origin[k]);
    axis->inverse = tbx_wide_all(q->inverse[k]);
    axis->rest = tbx_wide_all((float)(left + (double)TBX_SOLID_MARGIN));
    axis->rest_low = tbx_wide_all((float)(left + (double)TBX_SOLID_MARGIN - slack));
    axis->rest_high = tbx_wide_all((float)(left + (double)TBX_SOLID_MARGIN + slack));
    axis->outside = tbx_wide_all((float)(source_middle + 4194304.0 * size));
    axis->last = tbx_wide_int(TBX_SOLID_MARGIN + (int32_t)s->n[k] - 2);
    return slack;
}

/* Centres of axis k. All parts are whole units (section 9): low ones, below 2^52 of them, are exact. */
TBX_FN void tbx_solid_exact_init(tbx_solid_exact *e, const tbx_solid *s, int k, double most)
{
    const double size = s->grid->size[k];
    const double origin = s->grid->origin[k];
    const double spacing = tbx_floor_pow2(most) * TBX_POW2(-50);
    const double rest = spacing * ((double)s->n[k] + 34.0);
    const int64_t halves = 2 * (int64_t)s->grid->lo[k] + 1;
    const double half_high = tbx_floor_to(0.5 * size, spacing);
    const double origin_high = tbx_floor_to(origin, spacing);
    double half_low = 0.5 * size - half_high;
    double low = origin - origin_high;
    TBX_KEEP_SCALAR(half_low); /* not multiplied out */
    TBX_KEEP_SCALAR(low);
    low += (double)halves * half_low;
    e->base_high[k - 1] = origin_high + (double)halves * half_high;
    e->base_low[k - 1] = low;
    e->size_high[k - 1] = tbx_floor_to(size, spacing);
    e->size_low[k - 1] = size - e->size_high[k - 1];
    e->least[k - 1] = 16.0 * (rest + tbx_abs(low));
    TBX_KEEP(*e);
    e->on &= e->least[k - 1] < s->unit[k] * 4503599627370496.0;
}

/* Can axis k be computed with in float? */
TBX_FN int tbx_solid_suits(const tbx_solid *s, int k)
{
    const double *size = &s->grid->size[k];
    return s->n[k] <= 65536 && tbx_bits64(size) - ((uint64_t)(1023 - 60) << 52) < (uint64_t)120 << 52 &&
           tbx_abs(s->middle[k]) < 67108864.0 * tbx_floor_pow2(*size); /* 2^26 */
}

/* Numbers of axis k. */
TBX_FN void tbx_solid_centres_init(tbx_solid_quick *q, int k)
{
    const tbx_solid *s = q->solid;
    const double parts = (double)TBX_SOLID_PARTS;
    const double size = s->grid->size[k];
    const double n = (double)s->n[k];
    const double middle = s->middle[k];
    const double below = tbx_abs(middle - (n + 17.0) * size);
    const double above = tbx_abs(middle + (n + 17.0) * size);
    const double spacing = tbx_floor_pow2(below > above ? below : above) * (1.0 / 4194304.0); /* 2^-22 */
    const double scale = 1.0 / tbx_floor_pow2(size);
    const double rho =
        (spacing * (n + 34.0) + TBX_SOLID_MIDDLE_ERROR / (double)TBX_U32 * s->reach[k]) * scale;
    const double most = tbx_abs(middle) + 4194304.0 * size;
    const float most_float = (float)most;
    tbx_solid_centres *centres = &q->centres[k];
    double base_high = tbx_floor_to(middle, spacing);
    double size_high = tbx_floor_to(size, spacing);
    TBX_KEEP(base_high);
    TBX_KEEP(size_high);
    q->on &= tbx_more(2048.0, rho);
    q->rho = (float)rho > q->rho ? (float)rho : q->rho;
    q->origin[k] = (float)middle;
    TBX_KEEP(q->origin[k]); /* clang 22's -ffast-math leaves the rounding out of what follows */
    q->most_reach[k] = s->reach[k] + tbx_abs(middle) + 2097152.0 * size;
    q->inverse[k] = (float)(1.0 / size);
    q->most[k] =
        q->source->is_double ? (int32_t)(tbx_bits64(&most) >> 32) : (int32_t)tbx_bits32(&most_float);
    q->scale[k] = (float)scale;
    q->step[k] = (float)(size * scale);
    q->part[k] = (float)(1.0 / (scale * parts));
    centres->scale = tbx_wide_all((float)scale);
    centres->base_high = tbx_wide_all((float)base_high);
    centres->base_low = tbx_wide_all((float)(middle - base_high));
    centres->size_high = tbx_wide_all((float)size_high);
    centres->size_low = tbx_wide_all((float)(size - size_high));
    q->lattice &= middle == base_high && size == size_high &&
                  tbx_on_lattice(s->grid->origin[k], scale * parts) &&
                  tbx_on_lattice(middle, scale * parts) && s->reach[k] * scale * parts < 8388608.0;
}

TBX_FN void tbx_solid_quick_init(tbx_solid_quick *q, const tbx_solid *s, const tbx_source *source)
{
    const double u = (double)TBX_U32;
    double slack[2];
    int k;
    q->solid = s;
    q->source = source;
    q->rho = 0.0f;
    q->lattice = 1;
    q->on = s->fits && tbx_solid_suits(s, 0) && tbx_solid_suits(s, 1) && tbx_solid_suits(s, 2);
    for (k = 0; k < 3 && q->on; k++) {
        tbx_solid_centres_init(q, k);
    }
    if (!q->on) {
        return;
    }
    q->over_step = (float)(1.0 / (s->grid->size[0] * (double)q->scale[0]));
    q->exact.on = source->is_double;
    for (k = 0; k < 2; k++) {
        slack[k] = tbx_solid_axis_init(q, k + 1);
        q->near_error[k] =
            q->lattice ? 0.0f : TBX_SOLID_NEAR_ERROR * q->rho * q->part[k + 1] * (float)TBX_SOLID_PARTS;
        tbx_solid_exact_init(&q->exact, s, k + 1, q->most_reach[k + 1]);
    }
    slack[0] = slack[0] > slack[1] ? slack[0] : slack[1];
    q->one_error = tbx_wide_all((float)(2.2 * (4.0 * 1.1 * (slack[0] + 2.2 * u) + 5.0 * 1.21 * u)));
    q->on = slack[0] < 0.03;
}

/* Triangles that wait: their first rows. */
typedef struct tbx_solid_list {
    size_t triangle[TBX_SOLID_BLOCK + TBX_WIDE];
    int32_t y[TBX_SOLID_BLOCK + TBX_WIDE];
    int32_t z[TBX_SOLID_BLOCK + TBX_WIDE];
    int n;
} tbx_solid_list;

/* A row, and the first voxel to flip in it. */
typedef struct tbx_solid_crossing {
    uint64_t *row;
    size_t x;
} tbx_solid_crossing;

typedef struct tbx_solid_fill {
    tbx_solid_quick quick;
    tbx_solid_list list[TBX_SOLID_ROWS];      /* of up to 1, 2, ... rows on each axis */
    size_t large[TBX_SOLID_BLOCK + TBX_WIDE]; /* that go one by one */
    int larges;
    int32_t from[2]; /* layers, of the last two */
    tbx_solid_crossing crossing[TBX_SOLID_CROSSINGS + TBX_SOLID_ROWS * TBX_WIDE + 1];
    int crossings;    /* that wait: their rows are on the way to the cache */
    int refines;      /* whether boxes are looked at again; it pays where corners lie on lines of centres */
    unsigned narrows; /* not 0: some had less rows then */
    int32_t y[TBX_SOLID_BLOCK]; /* of a block of triangles */
    int32_t z[TBX_SOLID_BLOCK];
    int32_t extent[TBX_SOLID_BLOCK];
} TBX_ALIGNED tbx_solid_fill;

/* Differences of the corners of WIDE triangles to the first centre, y and z. */
TBX_FORCED tbx_iw tbx_solid_wild(tbx_fw x, int32_t most)
{
    return ((tbx_iw)x & tbx_wide_int(0x7fffffff)) > tbx_wide_int(most);
}

/* In rows, counted from MARGIN before the first. */
TBX_FORCED tbx_fw tbx_solid_in_rows(const tbx_solid_axis *axis, tbx_fw x, tbx_fw rest)
{
    x -= axis->origin;
    TBX_KEEP_VECTOR(x);
    return x * axis->inverse + rest;
}

/* Rows whose centres lie between the corners of WIDE triangles, or are within the bounds of it: those behind
 * `before`, to `end`. Rounded toward 0; where that is up, both lie before the region, or 16 rows apart. */
TBX_FORCED void tbx_solid_rows_between(const tbx_solid_axis *axis, tbx_fw x0, tbx_fw x1, tbx_fw x2,
                                       tbx_iw *out_before, tbx_iw *out_end)
{
    const tbx_fw low = tbx_wide_min(tbx_wide_min(x0, x1), x2);
    const tbx_fw high = tbx_wide_max(tbx_wide_max(x0, x1), x2);
    *out_before = __builtin_convertvector(tbx_solid_in_rows(axis, low, axis->rest_low), tbx_iw);
    *out_end = __builtin_convertvector(tbx_solid_in_rows(axis, high, axis->rest_high), tbx_iw);
}

/* Edge functions at the centre that y and z are told from, what they grow by with y and z of the centre, and
 * their sum, twice the area: all times the sign of that sum, so that they are positive within. */
typedef struct tbx_solid_edges {
    tbx_fw e0;
    tbx_fw e1;
    tbx_fw e2;
    tbx_fw by_y[3];
    tbx_fw by_z[3];
    tbx_fw area;
} TBX_ALIGNED tbx_solid_edges;

TBX_FORCED void tbx_solid_edges_set(tbx_solid_edges *out, const tbx_fw y[3], const tbx_fw z[3])
{
    const tbx_fw e0 = y[0] * z[1] - z[0] * y[1];
    const tbx_fw e1 = y[1] * z[2] - z[1] * y[2];
    const tbx_fw e2 = y[2] * z[0] - z[2] * y[0];
    const tbx_fw area = e0 + e1 + e2;
    const tbx_iw sign = (tbx_iw)area & tbx_wide_int(TBX_SIGN_BIT);
    out->e0 = tbx_wide_flip(e0, sign);
    out->e1 = tbx_wide_flip(e1, sign);
    out->e2 = tbx_wide_flip(e2, sign);
    out->by_y[0] = tbx_wide_flip(z[0] - z[1], sign);
    out->by_y[1] = tbx_wide_flip(z[1] - z[2], sign);
    out->by_y[2] = tbx_wide_flip(z[2] - z[0], sign);
    out->by_z[0] = tbx_wide_flip(y[1] - y[0], sign);
    out->by_z[1] = tbx_wide_flip(y[2] - y[1], sign);
    out->by_z[2] = tbx_wide_flip(y[0] - y[2], sign);
    out->area = tbx_wide_abs(area);
}

TBX_FORCED tbx_fw tbx_solid_least_edge(const tbx_solid_edges *e)
{
    return tbx_wide_min(tbx_wide_min(e->e0, e->e1), e->e2);
}

/* Lanes whose triangle does not hold the centre of the row behind `before`. */
TBX_FORCED tbx_iw tbx_solid_missed(const tbx_solid_quick *q, const tbx_points v[3], tbx_iw row_y,
                                   tbx_iw row_z)
{
    const tbx_fw one = tbx_wide_all(1.0f);
    const tbx_fw to_y = q->axis[0].rest - (__builtin_convertvector(row_y, tbx_fw) + one);
    const tbx_fw to_z = q->axis[1].rest - (__builtin_convertvector(row_z, tbx_fw) + one);
    tbx_fw y[3];
    tbx_fw z[3];
    tbx_solid_edges e;
    y[0] = tbx_solid_in_rows(&q->axis[0], v[0].y, to_y);
    y[1] = tbx_solid_in_rows(&q->axis[0], v[1].y, to_y);
    y[2] = tbx_solid_in_rows(&q->axis[0], v[2].y, to_y);
    z[0] = tbx_solid_in_rows(&q->axis[1], v[0].z, to_z);
    z[1] = tbx_solid_in_rows(&q->axis[1], v[1].z, to_z);
    z[2] = tbx_solid_in_rows(&q->axis[1], v[2].z, to_z);
    tbx_solid_edges_set(&e, y, z);
    return tbx_solid_least_edge(&e) < -q->one_error;
}

/* x from the centre i. */
TBX_FORCED tbx_fw tbx_solid_from(const tbx_solid_centres *centres, tbx_fw i, tbx_fw x)
{
    x -= centres->base_high + i * centres->size_high;
    TBX_KEEP_VECTOR(x);
    return x - (centres->base_low + i * centres->size_low);
}

/* The corners on an axis, in lengths scaled. */
TBX_FORCED void tbx_solid_place(const tbx_solid_centres *centres, tbx_iw i, tbx_fw *x0, tbx_fw *x1,
                                tbx_fw *x2)
{
    const tbx_fw at = __builtin_convertvector(i, tbx_fw);
    *x0 = tbx_solid_from(centres, at, *x0) * centres->scale;
    *x1 = tbx_solid_from(centres, at, *x1) * centres->scale;
    *x2 = tbx_solid_from(centres, at, *x2) * centres->scale;
}

/* Lanes whose x is a multiple of a PART, less than 2^22 of them: the sum is one. What is flushed to 0 has
 * other bits. */
TBX_FORCED tbx_iw tbx_solid_whole(const tbx_solid_quick *q, int k, tbx_fw x)
{
    const tbx_fw middle = tbx_wide_all(q->part[k] * 12582912.0f); /* 1.5 * 2^23 */
    tbx_fw sum = x + middle;
    TBX_KEEP_VECTOR(sum);
    sum -= middle;
    return ((((tbx_iw)sum ^ (tbx_iw)x) & tbx_wide_int(0x7fffffff)) == tbx_wide_int(0)) &
           (tbx_wide_abs(x) < tbx_wide_all(q->part[k] * 4194304.0f));
}

/* Half the least step of an edge function on the lattice, up where a tie counts, else down. */
TBX_FORCED tbx_fw tbx_solid_tie(tbx_fw by_y, tbx_fw by_z, tbx_iw on_lattice)
{
    const tbx_fw half = tbx_wide_all(0.5f / (TBX_SOLID_PARTS * TBX_SOLID_PARTS));
    const tbx_fw zero = tbx_wide_all(0.0f);
    const tbx_iw counts = (by_y > zero) | ((by_y == zero) & (by_z > zero));
    return tbx_wide_where(on_lattice, tbx_wide_choose(counts, half, -half));
}

TBX_FORCED void tbx_solid_ties(tbx_solid_edges *e, tbx_iw on_lattice)
{
    e->e0 += tbx_solid_tie(e->by_y[0], e->by_z[0], on_lattice);
    e->e1 += tbx_solid_tie(e->by_y[1], e->by_z[1], on_lattice);
    e->e2 += tbx_solid_tie(e->by_y[2], e->by_z[2], on_lattice);
}

/* WIDE triangles, and their rows: n of them behind `before`. */
typedef struct tbx_solid_boxed {
    tbx_fw v[2][3]; /* y and z of the corners */
    tbx_iw before[2];
    tbx_iw n[2];
    tbx_iw some;    /* lanes that have rows */
    tbx_iw narrow;  /* lanes that have less of them than was thought */
    tbx_iw rounded; /* of doubles, v being from the first row's centre: lanes where it was rounded */
} TBX_ALIGNED tbx_solid_boxed;

/* Lanes above 0 that may be flushed to it. */
TBX_FORCED tbx_iw tbx_solid_tiny(tbx_fw x)
{
    return ((tbx_iw)x > tbx_wide_int(0)) & ((tbx_iw)x < tbx_wide_int(0x00800000));
}

/* Rows on an axis without the first one, where the least corner lies behind its centre, and the last one,
 * where the greatest does not. */
TBX_FORCED void tbx_solid_narrow(tbx_solid_boxed *b, const tbx_solid_quick *q, int k)
{
    const tbx_solid_centres *centres = &q->centres[k + 1];
    const tbx_fw *v = b->v[k];
    const tbx_fw first = __builtin_convertvector(b->before[k] - tbx_wide_int(TBX_SOLID_MARGIN - 1), tbx_fw);
    const tbx_fw last = first + __builtin_convertvector(b->n[k] - tbx_wide_int(1), tbx_fw);
    const tbx_fw most = tbx_wide_max(tbx_wide_max(v[0], v[1]), v[2]);
    const tbx_fw low = tbx_solid_from(centres, first, tbx_wide_min(tbx_wide_min(v[0], v[1]), v[2]));
    const tbx_fw high = tbx_solid_from(centres, last, most);
    const tbx_fw error = tbx_wide_all(q->near_error[k]);
    const tbx_iw tiny = tbx_solid_tiny(v[0]) | tbx_solid_tiny(v[1]) | tbx_solid_tiny(v[2]);
    const tbx_iw not_first = low > error;
    const tbx_iw not_last = ~((high > -error) | tiny);
    b->before[k] -= not_first;
    b->n[k] += not_first + not_last;
    b->narrow |= not_first | not_last;
}

/* Lanes whose triangle, of one row, does not hold its centre; only `asked` count. */
TBX_FORCED tbx_iw tbx_solid_outside(const tbx_solid_boxed *b, const tbx_solid_quick *q, tbx_iw asked)
{
    const tbx_iw to_first = tbx_wide_int(TBX_SOLID_MARGIN - 1);
    tbx_fw y[3];
    tbx_fw z[3];
    tbx_solid_edges e;
    tbx_iw on = tbx_wide_int(0);
    tbx_iw out = tbx_wide_int(0);
    float rest = TBX_SOLID_ALONE_REST * q->rho;
    y[0] = b->v[0][0];
    y[1] = b->v[0][1];
    y[2] = b->v[0][2];
    z[0] = b->v[1][0];
    z[1] = b->v[1][1];
    z[2] = b->v[1][2];
    if (q->lattice) {
        on = tbx_solid_whole(q, 1, y[0]) & tbx_solid_whole(q, 1, y[1]) & tbx_solid_whole(q, 1, y[2]) &
             tbx_solid_whole(q, 2, z[0]) & tbx_solid_whole(q, 2, z[1]) & tbx_solid_whole(q, 2, z[2]);
        on &= ~b->rounded;
    }
    if (q->source->is_double) {
        int c;
        rest = 0.0f; /* corners are off by 2 u of themselves */
        for (c = 0; c < 3; c++) {
            y[c] = y[c] * q->centres[1].scale;
            z[c] = z[c] * q->centres[2].scale;
        }
    } else {
        tbx_solid_place(&q->centres[1], b->before[0] - to_first, &y[0], &y[1], &y[2]);
        tbx_solid_place(&q->centres[2], b->before[1] - to_first, &z[0], &z[1], &z[2]);
    }
    tbx_solid_edges_set(&e, y, z);
    if (tbx_wide_any(asked & ~on)) {
        const tbx_fw relative = tbx_wide_all(TBX_SOLID_ALONE_ERROR);
        const tbx_fw absolute = tbx_wide_all(rest + TBX_SOLID_LEAST);
        const tbx_fw error0 = relative * (tbx_wide_abs(y[0] * z[1]) + tbx_wide_abs(z[0] * y[1])) + absolute;
        const tbx_fw error1 = relative * (tbx_wide_abs(y[1] * z[2]) + tbx_wide_abs(z[1] * y[2])) + absolute;
        const tbx_fw error2 = relative * (tbx_wide_abs(y[2] * z[0]) + tbx_wide_abs(z[2] * y[0])) + absolute;
        out = (e.e0 < -error0) | (e.e1 < -error1) | (e.e2 < -error2);
        out &= ~on & (e.area > tbx_wide_all(2.0f) * (error0 + error1 + error2));
    }
    if (q->lattice) {
        const tbx_fw zero = tbx_wide_all(0.0f);
        tbx_solid_ties(&e, on);
        out |= on & ((tbx_solid_least_edge(&e) < zero) | (e.area == zero));
    }
    return out;
}

/* Two doubles. */
TBX_FORCED tbx_d2 tbx_solid_yz(const void *from)
{
    tbx_d2 r;
    TBX_COPY(&r, from, sizeof r);
    return r;
}

/* y and z from the centres i, high + low, with the exact sign: v - high is exact where v is up to twice as
 * far from 0, or half; elsewhere it is half of high at least, and low does not turn its sign. */
TBX_FORCED tbx_d2 tbx_solid_exact_from(const tbx_solid_exact *e, tbx_d2 i, tbx_d2 x, tbx_d2 *high)
{
    *high = tbx_pair(e->base_high[0], e->base_high[1]) + i * tbx_pair(e->size_high[0], e->size_high[1]);
    TBX_KEEP_VECTOR(*high);
    x -= *high;
    i = tbx_pair(e->base_low[0], e->base_low[1]) + i * tbx_pair(e->size_low[0], e->size_low[1]);
    TBX_KEEP_VECTOR(x);
    TBX_KEEP_VECTOR(i);
    return x - i;
}

/* tbx_solid_narrow of doubles, one triangle after another; where one row is left, corners from its centre. */
TBX_NOINLINE void tbx_solid_narrow_doubles(tbx_solid_boxed *b, const tbx_solid_quick *q, size_t first)
{
    const tbx_solid_exact *e = &q->exact;
    const tbx_d2 least = tbx_pair(e->least[0], e->least[1]);
    const tbx_d2 one = tbx_pair(1.0, 1.0);
    const tbx_d2 zero = tbx_pair(0.0, 0.0);
    unsigned left = tbx_wide_signs(b->some);
    float from[6][TBX_WIDE] = { { 0.0f } };
    int32_t before[2][TBX_WIDE];
    int32_t n[2][TBX_WIDE];
    int32_t narrow[TBX_WIDE] = { 0 };
    int32_t rounded[TBX_WIDE];
    int c;
    TBX_COPY(before, b->before, sizeof before);
    TBX_COPY(n, b->n, sizeof n);
    TBX_COPY(rounded, &b->some, sizeof rounded);
    for (; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const double to_first = (double)(TBX_SOLID_MARGIN - 1);
        tbx_d2 at = tbx_pair((double)before[0][lane] - to_first, (double)before[1][lane] - to_first);
        const tbx_d2 last = at + tbx_pair((double)n[0][lane], (double)n[1][lane]) - one;
        tbx_d2 v[3];
        tbx_d2 low;
        tbx_d2 high;
        tbx_d2 place;
        tbx_d2 last_place;
        int not_first;
        int not_last;
        int exact = -1;
        for (c = 0; c < 3; c++) {
            v[c] = tbx_solid_yz(tbx_source_at(q->source, first + (size_t)lane, (size_t)c) + sizeof(double));
        }
        low = tbx_solid_exact_from(e, at, tbx_min2(tbx_min2(v[0], v[1]), v[2]), &place);
        high = tbx_solid_exact_from(e, last, tbx_max2(tbx_max2(v[0], v[1]), v[2]), &last_place);
        if (tbx_signs2((tbx_l2)(tbx_abs2(place) < least) | (tbx_l2)(tbx_abs2(last_place) < least)) != 0) {
            continue;
        }
        not_first = tbx_signs2((tbx_l2)(low > zero));
        not_last = tbx_signs2((tbx_l2)(high <= zero));
        before[0][lane] += not_first & 1;
        before[1][lane] += not_first >> 1;
        n[0][lane] -= (not_first & 1) + (not_last & 1);
        n[1][lane] -= (not_first >> 1) + (not_last >> 1);
        narrow[lane] = -(int32_t)((not_first | not_last) != 0);
        if (n[0][lane] != 1 || n[1][lane] != 1) {
            continue;
        }
        at += tbx_pair((double)(not_first & 1), (double)(not_first >> 1));
        for (c = 0; c < 3; c++) {
            const tbx_d2 x = tbx_solid_exact_from(e, at, v[c], &place);
            tbx_d2 back = x + place; /* on the lattice this is exact, and low is 0 */
            TBX_KEEP_VECTOR(back);
            if (tbx_signs2((tbx_l2)(tbx_abs2(place) < least)) != 0) {
                exact = 0;
                break; /* of all three */
            }
            from[c][lane] = (float)x[0];
            from[c + 3][lane] = (float)x[1];
            TBX_KEEP(from); /* clang 22 with -ffast-math takes (double)(float)x for x */
            exact &= -(int)(((double)from[c][lane] == x[0]) & ((double)from[c + 3][lane] == x[1]));
            exact &= -(int)(tbx_signs2((tbx_l2)(back == v[c])) == 3);
        }
        rounded[lane] = ~exact;
    }
    TBX_COPY(b->v, from, sizeof b->v);
    TBX_COPY(b->before, before, sizeof before);
    TBX_COPY(b->n, n, sizeof n);
    TBX_COPY(&b->narrow, narrow, sizeof narrow);
    TBX_COPY(&b->rounded, rounded, sizeof rounded);
}

/* Boxes looked at from close by: where corners lie on lines of centres, up to three of four rows are none of
 * theirs. Of one row it is decided whether it is within, if that is sure. */
TBX_NOINLINE void tbx_solid_refine(tbx_solid_boxed *b, const tbx_solid_quick *q, size_t first)
{
    const tbx_iw one = tbx_wide_int(1);
    tbx_iw alone;
    b->narrow = b->rounded = tbx_wide_int(0);
    if (q->source->is_double) {
        tbx_solid_narrow_doubles(b, q, first);
    } else {
        tbx_solid_narrow(b, q, 0);
        tbx_solid_narrow(b, q, 1);
    }
    b->some &= (b->n[0] > tbx_wide_int(0)) & (b->n[1] > tbx_wide_int(0));
    alone = b->some & (b->n[0] == one) & (b->n[1] == one);
    if (tbx_wide_any(alone)) {
        b->some &= ~(alone & tbx_solid_outside(b, q, alone));
    }
}

/* WIDE triangles, in lengths scaled, from their first rows; x from the centre of a voxel near v_0. */
typedef struct tbx_solid_placed {
    tbx_points v[3];
    tbx_iw x_first;
    tbx_iw unsure;
    tbx_iw on_lattice;
} TBX_ALIGNED tbx_solid_placed;

/* The triangles listed from i on. */
TBX_FORCED void tbx_solid_place_floats(tbx_solid_placed *p, const tbx_solid_quick *q,
                                       const tbx_solid_list *list, int i)
{
    const int32_t end = (int32_t)q->solid->n[0] + 16;
    tbx_iw y;
    tbx_iw z;
    tbx_fw x;
    int c;
    TBX_COPY(&y, list->y + i, sizeof y);
    TBX_COPY(&z, list->z + i, sizeof z);
    tbx_load_corners(p->v, q->source, list->triangle + i);
    p->unsure = tbx_solid_wild(p->v[0].x, q->most[0]) | tbx_solid_wild(p->v[1].x, q->most[0]) |
                tbx_solid_wild(p->v[2].x, q->most[0]);
    if (TBX_RARELY(tbx_wide_any(p->unsure))) { /* too large to compute with */
        for (c = 0; c < 3; c++) {
            p->v[c].x = tbx_wide_where(~p->unsure, p->v[c].x);
        }
    }
    if (q->lattice) {
        p->on_lattice = ~p->unsure;
        for (c = 0; c < 3; c++) {
            p->on_lattice &= tbx_solid_whole(q, 0, p->v[c].x) & tbx_solid_whole(q, 1, p->v[c].y) &
                             tbx_solid_whole(q, 2, p->v[c].z);
        }
    }
    x = p->v[0].x - tbx_wide_all(q->origin[0]);
    TBX_KEEP_VECTOR(x);
    x = x * tbx_wide_all(q->inverse[0]);
    x = tbx_wide_min(tbx_wide_max(x, tbx_wide_all(-16.0f)), tbx_wide_all((float)end));
    p->x_first = __builtin_convertvector(x, tbx_iw);
    tbx_solid_place(&q->centres[0], p->x_first, &p->v[0].x, &p->v[1].x, &p->v[2].x);
    tbx_solid_place(&q->centres[1], y, &p->v[0].y, &p->v[1].y, &p->v[2].y);
    tbx_solid_place(&q->centres[2], z, &p->v[0].z, &p->v[1].z, &p->v[2].z);
}

/* Corners of one triangle, as doubles: are they on the lattice? */
TBX_FN int tbx_solid_whole_doubles(const tbx_solid_quick *q, double v[3][3])
{
    int whole = 1;
    int c;
    int k;
    for (c = 0; c < 3; c++) {
        for (k = 0; k < 3; k++) {
            const double scale = (double)q->scale[k] * (double)TBX_SOLID_PARTS;
            whole &= tbx_on_lattice(v[c][k], scale) && tbx_abs(v[c][k]) * scale < 8388608.0;
        }
    }
    return whole;
}

/* The same of doubles, one by one. */
TBX_NOINLINE void tbx_solid_place_doubles(tbx_solid_placed *p, const tbx_solid_quick *q,
                                          const tbx_solid_list *list, int i)
{
    const tbx_solid *s = q->solid;
    const double *size = s->grid->size;
    const double over_size = 1.0 / size[0];
    const double scale[3] = { (double)q->scale[0], (double)q->scale[1], (double)q->scale[2] };
    const double most = (double)s->n[0] + 16.0;
    float x[9][TBX_WIDE];
    int32_t flags[3][TBX_WIDE];
    int lane;
    int c;
    for (lane = 0; lane < TBX_WIDE; lane++) {
        const size_t triangle = list->triangle[i + lane];
        double v[3][3];
        double at[3];
        double first;
        int wild = 0;
        for (c = 0; c < 3; c++) {
            TBX_COPY(v[c], tbx_source_at(q->source, triangle, (size_t)c), sizeof v[c]);
            if (TBX_RARELY((tbx_bits64(&v[c][0]) >> 32 & 0x7fffffffu) > (uint32_t)q->most[0])) {
                v[c][0] = 0.0;
                wild = -1;
            }
        }
        TBX_KEEP(v[0][0]);
        TBX_KEEP(v[1][0]);
        TBX_KEEP(v[2][0]);
        first = (v[0][0] - s->middle[0]) * over_size;
        first = first > -16.0 ? first : -16.0;
        first = first < most ? first : most;
        TBX_KEEP_SCALAR(first);
        flags[0][lane] = (int32_t)first;
        flags[1][lane] = wild;
        flags[2][lane] = q->lattice && wild == 0 && tbx_solid_whole_doubles(q, v) ? -1 : 0;
        at[0] = s->middle[0] + (double)flags[0][lane] * size[0];
        at[1] = s->middle[1] + (double)list->y[i + lane] * size[1];
        at[2] = s->middle[2] + (double)list->z[i + lane] * size[2];
        TBX_KEEP_SCALAR(at[0]);
        TBX_KEEP_SCALAR(at[1]);
        TBX_KEEP_SCALAR(at[2]);
        for (c = 0; c < 3; c++) {
            x[3 * c][lane] = (float)((v[c][0] - at[0]) * scale[0]);
            x[3 * c + 1][lane] = (float)((v[c][1] - at[1]) * scale[1]);
            x[3 * c + 2][lane] = (float)((v[c][2] - at[2]) * scale[2]);
        }
    }
    for (c = 0; c < 3; c++) {
        TBX_COPY(&p->v[c].x, x[3 * c], sizeof p->v[c].x);
        TBX_COPY(&p->v[c].y, x[3 * c + 1], sizeof p->v[c].y);
        TBX_COPY(&p->v[c].z, x[3 * c + 2], sizeof p->v[c].z);
    }
    TBX_COPY(&p->x_first, flags[0], sizeof p->x_first);
    TBX_COPY(&p->unsure, flags[1], sizeof p->unsure);
    TBX_COPY(&p->on_lattice, flags[2], sizeof p->on_lattice);
}

/* What the rows of WIDE boxes of n rows on each axis have: which are crossed, bit lane + WIDE * j of layer k,
 * and the first voxels behind. */
typedef struct tbx_solid_rows_of {
    uint32_t within[TBX_SOLID_ROWS];
    unsigned unsure;
    int32_t voxel[TBX_SOLID_ROWS * TBX_SOLID_ROWS * TBX_WIDE];
} tbx_solid_rows_of;

TBX_FORCED void tbx_solid_decide(tbx_solid_rows_of *out, const tbx_solid_quick *q, const tbx_solid_placed *p,
                                 int n)
{
    const float reach = 2.0f * (float)n + 0.1f;
    const float place = TBX_SOLID_PLACE_ERROR * (reach + q->rho);
    const float error_all = TBX_SOLID_ROW_ERROR * reach * place + TBX_SOLID_ROW_ULPS * reach * reach;
    const tbx_fw one = tbx_wide_all(1.0f);
    const tbx_fw y[3] = { p->v[0].y, p->v[1].y, p->v[2].y };
    const tbx_fw z[3] = { p->v[0].z, p->v[1].z, p->v[2].z };
    tbx_fw error = tbx_wide_all(error_all);
    const tbx_fw over_step = tbx_wide_all(q->over_step);
    const tbx_fw step_y = tbx_wide_all(q->step[1]);
    const tbx_fw step_z = tbx_wide_all(q->step[2]);
    const tbx_fw dx1 = p->v[1].x - p->v[0].x;
    const tbx_fw dx2 = p->v[2].x - p->v[0].x;
    const tbx_fw spread = tbx_wide_abs(dx1) + tbx_wide_abs(dx2);
    const tbx_fw m = tbx_wide_abs(p->v[0].x) + spread;
    const tbx_fw x0 = p->v[0].x * over_step;
    const tbx_iw end = tbx_wide_int((int32_t)q->solid->n[0]);
    tbx_iw unsure = p->unsure;
    tbx_solid_edges e;
    tbx_fw over_area;
    tbx_fw x_error;
    tbx_fw below;
    tbx_iw tiny;
    int j;
    int k;
    tbx_solid_edges_set(&e, y, z);
    tiny = e.area <= error;
    over_area = tbx_wide_inverse(~tiny, e.area);
    x_error = spread * (tbx_wide_all(2.0f * error_all) * over_area + tbx_wide_all(24.0f * TBX_U32)) +
              tbx_wide_all(20.0f * TBX_U32) * (m + tbx_wide_all(q->rho));
    x_error = x_error * over_step;
    over_area = over_area * over_step;
    if (q->lattice && tbx_wide_any(p->on_lattice)) {
        tbx_solid_ties(&e, p->on_lattice);
        error = tbx_wide_where(~p->on_lattice, error);
        x_error = tbx_wide_choose(p->on_lattice, -one, x_error); /* never unsure */
        tiny = e.area <= error;
    }
    below = error * tbx_wide_all(-2.0f);
    for (k = 0; k < n; k++) {
        tbx_fw r0 = e.e0;
        tbx_fw r1 = e.e1;
        tbx_fw r2 = e.e2;
        uint32_t layer = 0;
        for (j = 0; j < n; j++) {
            const tbx_fw least = tbx_wide_min(tbx_wide_min(r0, r1), r2);
            const tbx_iw within =
                (least > error) & ~tiny; /* on the lattice: a segment, whatever the ties say */
            const tbx_fw x = tbx_wide_where(within, x0 + (dx1 * over_area * r2 + dx2 * over_area * r0));
            tbx_iw voxel = __builtin_convertvector(x, tbx_iw);
            const tbx_fw past = x - __builtin_convertvector(voxel, tbx_fw);
            const tbx_fw off = tbx_wide_abs(past);
            unsure |= (least >= below) & (~within | (off <= x_error) | (off >= one - x_error));
            voxel = p->x_first + voxel - (past > tbx_wide_all(0.0f));
            layer |= (uint32_t)tbx_wide_signs(within & ((voxel < end) | p->on_lattice)) << (TBX_WIDE * j);
            voxel &= voxel > tbx_wide_int(0);
            TBX_COPY(out->voxel + TBX_WIDE * (j + n * k), &voxel, sizeof voxel);
            r0 += step_y * e.by_y[0];
            r1 += step_y * e.by_y[1];
            r2 += step_y * e.by_y[2];
        }
        out->within[k] = layer;
        e.e0 += step_z * e.by_z[0];
        e.e1 += step_z * e.by_z[1];
        e.e2 += step_z * e.by_z[2];
    }
    out->unsure = tbx_wide_signs(unsure);
}

/* The first voxel behind a crossing on the lattice: N / D rounded up, both of them multiples of 1 /
 * PARTS^3. */
TBX_FN int64_t tbx_solid_lattice_voxel(const tbx_solid_quick *q, const tbx_points v[3], int lane, int j,
                                       int k)
{
    const double half = 0.5 / ((double)TBX_SOLID_PARTS * TBX_SOLID_PARTS * TBX_SOLID_PARTS);
    const double to_y = (double)j * (double)q->step[1];
    const double to_z = (double)k * (double)q->step[2];
    double y[3];
    double z[3];
    double weight[3];
    double top;
    double bottom;
    double x;
    int64_t voxel;
    int i;
    for (i = 0; i < 3; i++) {
        y[i] = (double)v[i].y[lane] - to_y;
        z[i] = (double)v[i].z[lane] - to_z;
    }
    TBX_KEEP(y);
    TBX_KEEP(z);
    for (i = 0; i < 3; i++) {
        const int a = i < 2 ? i + 1 : 0;
        const int b = i > 0 ? i - 1 : 2;
        weight[i] = y[a] * z[b] - z[a] * y[b];
    }
    top = (double)v[0].x[lane] * weight[0] + (double)v[1].x[lane] * weight[1] +
          (double)v[2].x[lane] * weight[2];
    bottom = weight[0] + weight[1] + weight[2];
    top = bottom < 0.0 ? -top : top;
    bottom = (bottom < 0.0 ? -bottom : bottom) * (double)q->step[0];
    x = (top - half) / bottom;
    voxel = tbx_to_long(x);
    return voxel + ((double)voxel <= x);
}

/* tbx_solid_flip, some words at a time, from bit x & 63 of the first of the row's `left` last words. */
TBX_FORCED void tbx_solid_flip_wide(uint64_t *word, size_t left, uint64_t padding, size_t x)
{
    const size_t some = TBX_WIDE / 2;
    uint64_t *last = word + left - 1;
    *word ^= ~(uint64_t)0 << (x & 63);
    for (; left > some; left -= some) {
        tbx_uw a;
        TBX_COPY(&a, word + left - some, sizeof a);
        a = ~a;
        TBX_COPY(word + left - some, &a, sizeof a);
    }
    for (; left > 1; left--) {
        word[left - 1] = ~word[left - 1];
    }
    if (padding != 0) {
        *last ^= padding; /* which was flipped with the rest */
    }
}

/* Lines. What tbx_solid_least looks for, in row or layer r, is at + slope * r, rounded up, if that is not
 * within an error of a whole number: the value's own bound (section 9) over its step, and what the quotient
 * and the sum round off; a division may be off by 4 u. On the lattice half the least step of the value goes
 * on top, and no quotient is whole. The edges that bound y from below are lower[0] and [1], maybe one twice.
 *
 * Such a place, as FIXED is added to it, is a whole number of steps of 2^-28 in its double's last bits, and
 * off by one more. Corners are within 2^21 voxels along x, and so is the plane where it counts. */
#define TBX_SOLID_FIXED 25165824.0 /* 3 * 2^23 */
#define TBX_SOLID_LAYERS 32

typedef struct tbx_solid_line {
    double at;
    double slope;
} tbx_solid_line;

/* Two triangles. */
typedef struct tbx_solid_two {
    tbx_d2 at[3][3]; /* first centre - corners */
    tbx_d2 d[3][3];  /* edges */
    tbx_l2 on_lattice;
    tbx_d2 edge_at[3];
    tbx_d2 edge_slope[3];
    tbx_d2 error;
    tbx_d2 plane_at;
    tbx_d2 plane_slope;
    tbx_d2 plane_z; /* the plane's slope from layer to layer */
    tbx_d2 plane_error;
    tbx_d2 layers[2]; /* as FIXED */
    int lower[3];     /* a bit for each triangle */
    int upper[3];
    int inside; /* all crossings are before the region's last voxel, and behind its first */
    int sure;
    int flat; /* parallel to x */
} tbx_solid_two;

/* The lines of one of them. */
typedef struct tbx_solid_lines {
    tbx_solid_line lower[2]; /* maybe one twice */
    tbx_solid_line upper[2];
    tbx_solid_line plane;
    double plane_z;
    uint32_t unsure;       /* in steps of 2^-32 */
    uint32_t plane_unsure; /* at any row */
    int inside;
} tbx_solid_lines;

/* The places of layers: y of the first row and of that behind the last, as FIXED, and x at row 0. */
typedef struct tbx_solid_places {
    uint64_t low[TBX_SOLID_LAYERS];
    uint64_t high[TBX_SOLID_LAYERS];
    double x[TBX_SOLID_LAYERS];
} tbx_solid_places;

TBX_FORCED tbx_d2 tbx_twice(double x)
{
    return tbx_pair(x, x);
}

/* x where mask, else 0. */
TBX_FORCED tbx_d2 tbx_where2(tbx_l2 mask, tbx_d2 x)
{
    return (tbx_d2)(mask & (tbx_l2)x);
}

/* 1/x in lanes `has`, else 1: as tbx_wide_inverse. */
TBX_FORCED tbx_d2 tbx_inverse2(tbx_l2 has, tbx_d2 x)
{
    tbx_d2 divisor = (tbx_d2)((has & (tbx_l2)x) | (~has & (tbx_l2)tbx_twice(1.0)));
    TBX_KEEP_VECTOR(divisor);
    return tbx_twice(1.0) / divisor;
}

/* x rounded up to [0, n], as FIXED; last: n - 1/2. */
TBX_FORCED tbx_d2 tbx_solid_up(tbx_d2 x, tbx_d2 last)
{
    return tbx_min2(tbx_max2(x, tbx_twice(-0.5)), last) + tbx_twice(1.0) + tbx_twice(TBX_SOLID_FIXED);
}

/* The whole part of what is FIXED; is the rest, in steps of 2^-32, within `unsure` of a whole number? */
TBX_FORCED int32_t tbx_solid_whole_of(uint64_t bits)
{
    return (int32_t)(bits >> 28) & 0x7fffff;
}

TBX_FORCED int tbx_solid_is_near(uint32_t rest, uint32_t unsure)
{
    return rest + unsure < 2 * unsure;
}

/* Corners of two triangles: differences, and whether they are on the lattice. */
TBX_FORCED void tbx_solid_two_set(tbx_solid_two *t, const tbx_solid *s, double v[2][3][3])
{
    const int lattice = s->scale[0] > 0.0 && s->scale[1] > 0.0 && s->scale[2] > 0.0;
    int64_t on[2];
    int i;
    int k;
    for (i = 0; i < 2; i++) {
        on[i] = -(int64_t)lattice;
        for (k = 0; k < 9 && on[i] != 0; k++) {
            on[i] = -(int64_t)tbx_solid_on_lattice(s, k % 3, v[i][k / 3][k % 3]);
        }
    }
    TBX_COPY(&t->on_lattice, on, sizeof t->on_lattice);
    for (k = 0; k < 3; k++) {
        const tbx_d2 middle = tbx_twice(s->middle[k]);
        const tbx_d2 v0 = tbx_pair(v[0][0][k], v[1][0][k]);
        const tbx_d2 v1 = tbx_pair(v[0][1][k], v[1][1][k]);
        const tbx_d2 v2 = tbx_pair(v[0][2][k], v[1][2][k]);
        t->at[0][k] = middle - v0;
        t->at[1][k] = middle - v1;
        t->at[2][k] = middle - v2;
        t->d[0][k] = v1 - v0;
        t->d[1][k] = v2 - v1;
        t->d[2][k] = v0 - v2;
    }
    TBX_KEEP(t->at);
    TBX_KEEP(t->d);
}

/* Edge i's lines. Raises over: the largest 1 / step; off: what the line's own size rounds off. */
TBX_FORCED void tbx_solid_edge(tbx_solid_two *t, const tbx_solid *s, int i, tbx_l2 lower_falls, tbx_d2 half,
                               tbx_d2 *over, tbx_d2 *off)
{
    const tbx_d2 zero = tbx_twice(0.0);
    const tbx_l2 falls = (tbx_l2)(t->d[i][2] < zero);
    const tbx_d2 across = tbx_abs2(t->d[i][2]);
    const tbx_l2 leans = (tbx_l2)(across > zero);
    const tbx_l2 flip = ~falls & tbx_splat_long((int64_t)((uint64_t)1 << 63));
    const tbx_d2 along = (tbx_d2)((tbx_l2)t->d[i][1] ^ flip);
    const tbx_d2 inverse = tbx_where2(leans, tbx_inverse2(leans, across * tbx_twice(s->grid->size[1])));
    const tbx_d2 at = -((along * t->at[i][2] + across * t->at[i][1] + half) * inverse);
    const tbx_d2 slope = -(along * tbx_twice(s->grid->size[2]) * inverse);
    t->edge_at[i] = at;
    t->edge_slope[i] = slope;
    t->lower[i] = tbx_signs2(leans & ~(falls ^ lower_falls));
    t->upper[i] = tbx_signs2(leans & (falls ^ lower_falls));
    *over = tbx_max2(*over, inverse);
    *off = tbx_max2(*off, tbx_abs2(at) + tbx_abs2(slope) * tbx_twice((double)s->n[2]));
}

/* All lines. m: no coordinate and no centre is more, where a triangle is sure. */
TBX_FORCED void tbx_solid_two_lines(tbx_solid_two *t, const tbx_solid *s, const double m[3])
{
    const double *size = s->grid->size;
    const tbx_d2 tiny = tbx_twice(TBX_SOLID_TINY);
    const tbx_d2 line_error = tbx_twice(TBX_SOLID_LINE_ERROR);
    const tbx_d2 one = tbx_twice(1.0);
    const tbx_l2 on = t->on_lattice;
    tbx_d2 low[3]; /* of the first centre, from corners */
    tbx_d2 high[3];
    tbx_d2 x[3];
    tbx_d2 n[3];
    tbx_d2 half = tbx_twice(0.0);
    tbx_d2 half_x = half;
    tbx_d2 half_z = half;
    tbx_d2 edge_error;
    tbx_d2 plane_error;
    tbx_d2 layer_error = tbx_twice(m[2] * TBX_SOLID_ERROR);
    tbx_d2 over = half;
    tbx_d2 off = half;
    tbx_l2 wide;
    tbx_l2 sure;
    tbx_l2 lower_falls;
    int k;
    for (k = 0; k < 3; k++) {
        low[k] = tbx_min2(tbx_min2(t->at[0][k], t->at[1][k]), t->at[2][k]);
        high[k] = tbx_max2(tbx_max2(t->at[0][k], t->at[1][k]), t->at[2][k]);
        x[k] = tbx_max2(tbx_max2(tbx_abs2(t->d[0][k]), tbx_abs2(t->d[1][k])), tbx_abs2(t->d[2][k]));
    }
    n[0] = t->d[0][1] * t->d[1][2] - t->d[0][2] * t->d[1][1];
    n[1] = t->d[0][2] * t->d[1][0] - t->d[0][0] * t->d[1][2];
    n[2] = t->d[0][0] * t->d[1][1] - t->d[0][1] * t->d[1][0];
    edge_error = (x[1] * tbx_twice(m[2]) + x[2] * tbx_twice(m[1])) * tbx_twice(TBX_SOLID_EDGE_ERROR) + tiny;
    plane_error =
        (x[1] * x[2] * tbx_twice(m[0]) + x[2] * x[0] * tbx_twice(m[1]) + x[0] * x[1] * tbx_twice(m[2])) *
            tbx_twice(TBX_SOLID_PLANE_ERROR) +
        tiny;
    if (tbx_signs2(on) != 0) {
        half = tbx_where2(on, tbx_twice(0.5 / (s->scale[1] * s->scale[2])));
        half_x = tbx_where2(on, tbx_twice(0.5 / (s->scale[0] * s->scale[1] * s->scale[2])));
        half_z = tbx_where2(on, tbx_twice(0.5 / s->scale[2]));
        edge_error = tbx_where2(~on, edge_error);
        plane_error = tbx_where2(~on, plane_error);
        layer_error = tbx_where2(~on, layer_error);
    }
    lower_falls = (tbx_l2)(n[0] > tbx_twice(0.0));
    for (k = 0; k < 3; k++) {
        n[k] = (tbx_d2)((tbx_l2)n[k] ^ (~lower_falls & tbx_splat_long((int64_t)((uint64_t)1 << 63))));
    }
    wide = (tbx_l2)(n[0] > x[1] * x[2] * tbx_twice(TBX_SOLID_NORMAL_ERROR) + tbx_twice(TBX_POW2(-400)));
    tbx_solid_edge(t, s, 0, lower_falls, half, &over, &off);
    tbx_solid_edge(t, s, 1, lower_falls, half, &over, &off);
    tbx_solid_edge(t, s, 2, lower_falls, half, &over, &off);
    t->error = line_error * (off + one) + tbx_twice(TBX_BOUND_ERROR) * edge_error * over;
    over = tbx_inverse2(wide, n[0] * tbx_twice(size[0]));
    t->plane_at = -((n[0] * t->at[0][0] + n[1] * t->at[0][1] + n[2] * t->at[0][2] + half_x) * over);
    t->plane_slope = -(n[1] * tbx_twice(size[1]) * over);
    t->plane_z = -(n[2] * tbx_twice(size[2]) * over);
    t->plane_error =
        line_error * (tbx_abs2(t->plane_at) + tbx_abs2(t->plane_slope) * tbx_twice((double)s->n[1]) +
                      tbx_abs2(t->plane_z) * tbx_twice((double)s->n[2]) + one) +
        tbx_twice(TBX_BOUND_ERROR) * plane_error * over;
    over = tbx_twice(1.0 / size[2]);
    t->layers[0] = tbx_solid_up(-(high[2] + half_z) * over, tbx_twice((double)s->n[2] - 0.5));
    t->layers[1] = tbx_solid_up(-(low[2] + half_z) * over, tbx_twice((double)s->n[2] - 0.5));
    t->error = tbx_max2(t->error, line_error * ((tbx_abs2(low[2]) + tbx_abs2(high[2])) * over + one) +
                                      tbx_twice(TBX_BOUND_ERROR) * layer_error * over);
    sure = wide & (tbx_l2)(tbx_max2(t->error, t->plane_error) < tbx_twice(0.1)) &
           (tbx_l2)(tbx_abs2(t->plane_slope) < tbx_twice(268435456.0)); /* 2^28 */
    for (k = 0; k < 3; k++) {
        sure &= (tbx_l2)(tbx_max2(high[k], -low[k]) < tbx_twice(size[k] * 2097152.0)); /* 2^21 voxels */
    }
    t->sure = tbx_signs2(sure);
    t->flat = tbx_signs2(on & (tbx_l2)(n[0] == tbx_twice(0.0))); /* on the lattice n_x is exact */
    t->inside = tbx_signs2((tbx_l2)(high[0] < tbx_twice(-size[0])) &
                           (tbx_l2)(low[0] > tbx_twice(size[0] * (2.0 - (double)s->n[0]))));
}

/* The lines of triangle i of two, which is sure: its errors are below 0.1. */
TBX_FORCED void tbx_solid_lines_set(tbx_solid_lines *l, const tbx_solid_two *t, int i, uint32_t n_y)
{
    double error = t->error[i];
    double plane_error = t->plane_error[i];
    unsigned lower = 0;
    unsigned upper = 0;
    int k;
    TBX_KEEP_SCALAR(error); /* not converted before the triangle is known to be sure */
    TBX_KEEP_SCALAR(plane_error);
    for (k = 0; k < 3; k++) {
        lower |= (unsigned)(t->lower[k] >> i & 1) << k;
        upper |= (unsigned)(t->upper[k] >> i & 1) << k;
    }
    for (k = 0; k < 2; k++) { /* the first edge of them, and the last */
        const int below = k == 0 ? __builtin_ctz(lower) : lower > 3 ? 2 : (int)(lower >> 1);
        const int above = k == 0 ? __builtin_ctz(upper) : upper > 3 ? 2 : (int)(upper >> 1);
        l->lower[k].at = t->edge_at[below][i];
        l->lower[k].slope = t->edge_slope[below][i];
        l->upper[k].at = t->edge_at[above][i];
        l->upper[k].slope = t->edge_slope[above][i];
    }
    l->plane.at = t->plane_at[i];
    l->plane.slope = t->plane_slope[i];
    l->plane_z = t->plane_z[i];
    l->unsure = (uint32_t)(error * 4294967296.0) + 32;
    l->plane_unsure = (uint32_t)(plane_error * 4294967296.0) + n_y + 34;
    l->inside = t->inside >> i & 1;
}

/* Layers z to z + count, count at most LAYERS. */
TBX_FORCED void tbx_solid_places_set(tbx_solid_places *p, const tbx_solid_lines *l, double last_y, double z,
                                     int count)
{
    const tbx_d2 last = tbx_twice(last_y);
    const tbx_d2 two = tbx_twice(2.0);
    tbx_d2 at = tbx_pair(z, z + 1.0);
    int i;
#define TBX_LINE(l) (tbx_twice((l).at) + tbx_twice((l).slope) * at)
    for (i = 0; i < count; i += 2, at += two) {
        const tbx_d2 low = tbx_solid_up(tbx_max2(TBX_LINE(l->lower[0]), TBX_LINE(l->lower[1])), last);
        const tbx_d2 high = tbx_solid_up(tbx_min2(TBX_LINE(l->upper[0]), TBX_LINE(l->upper[1])), last);
        const tbx_d2 x = tbx_twice(l->plane.at) + tbx_twice(l->plane_z) * at + tbx_twice(1.0);
        TBX_COPY(p->low + i, &low, sizeof low);
        TBX_COPY(p->high + i, &high, sizeof high);
        TBX_COPY(p->x + i, &x, sizeof x);
    }
#undef TBX_LINE
}

/* Rows of a layer, x in steps of 2^-32, `aligned`: all in the region and in one word of their rows. Returns
 * how many were sure, one after another, and are flipped. */
TBX_FORCED int32_t tbx_solid_layer(const tbx_solid *s, uint32_t unsure, int aligned, uint64_t *row,
                                   int32_t rows, uint64_t at, uint64_t slope)
{
    const int64_t n_x = s->n[0];
    const size_t row_words = s->row_words;
    const uint64_t padding = ~s->last_word;
    const size_t first = at >> 38;
    int32_t y;
    for (y = 0; y < rows; y++, row += row_words, at += slope) {
        const int64_t x = (int64_t)at >> 32;
        const size_t word = aligned ? first : x > 0 ? (size_t)x >> 6 : 0;
        if (TBX_RARELY(tbx_solid_is_near((uint32_t)at, unsure))) {
            break;
        }
        if (aligned || x < n_x) {
            tbx_solid_flip_wide(row + word, row_words - word, padding, aligned || x > 0 ? (size_t)x : 0);
        }
    }
    return y;
}

/* A step from row to row, of a triangle that is sure. */
TBX_FORCED uint64_t tbx_solid_slope(double x)
{
    TBX_KEEP_SCALAR(x); /* not converted before */
    return (uint64_t)(int64_t)(x * 4294967296.0);
}

/* Layers of a triangle whose lines are sure. Returns the first layer whose rows are not, or the end. */
TBX_FORCED int32_t tbx_solid_sweep(const tbx_solid *s, const tbx_solid_lines *l, int32_t z, int32_t end)
{
    const uint64_t slope = tbx_solid_slope(l->plane.slope);
    const size_t layer_words = s->row_words * (size_t)s->n[1];
    tbx_solid_places p;
    for (; z < end; z += TBX_SOLID_LAYERS) {
        const int count = end - z < TBX_SOLID_LAYERS ? end - z : TBX_SOLID_LAYERS;
        uint64_t *layer = s->bits + layer_words * (size_t)z;
        int i;
        tbx_solid_places_set(&p, l, (double)s->n[1] - 0.5, (double)z, count);
        for (i = 0; i < count; i++, layer += layer_words) {
            const int32_t first = tbx_solid_whole_of(p.low[i]);
            const int32_t rows = tbx_solid_whole_of(p.high[i]) - first;
            int sure = !tbx_solid_is_near((uint32_t)(p.low[i] << 4), l->unsure) &&
                       !tbx_solid_is_near((uint32_t)(p.high[i] << 4), l->unsure);
            if (sure && rows > 0) {
                const double x = p.x[i] + l->plane.slope * (double)first + TBX_SOLID_FIXED;
                const uint64_t at = ((tbx_bits64(&x) & 0xfffffffffffffu) - ((uint64_t)1 << 51)) << 4;
                const uint64_t to = at + slope * (uint64_t)(rows - 1);
                uint64_t *row = layer + (size_t)first * s->row_words;
                const int32_t flipped = l->inside && at >> 38 == to >> 38
                                            ? tbx_solid_layer(s, l->plane_unsure, 1, row, rows, at, slope)
                                            : tbx_solid_layer(s, l->plane_unsure, 0, row, rows, at, slope);
                if (TBX_RARELY(flipped < rows)) { /* back */
                    tbx_solid_layer(s, l->plane_unsure, 0, row, flipped, at, slope);
                    sure = 0;
                }
            }
            if (TBX_RARELY(!sure)) {
                return z + i;
            }
        }
    }
    return end;
}

/* The last two that wait, or the last one, of any size. Returns a bit for each that has to go the scalar way,
 * from a layer on; they stay behind the list. */
TBX_NOINLINE int tbx_solid_large(tbx_solid_fill *fill)
{
    const tbx_solid *s = fill->quick.solid;
    const int count = fill->larges > 1 ? 2 : 1;
    const int first = fill->larges - count;
    double v[2][3][3];
    int sure = 0;
    tbx_solid_two two;
    tbx_solid_lines l;
    int i;
    int k;
    for (i = 0; i < count; i++) {
        const int kind = tbx_source_triangle(fill->quick.source, fill->large[first + i], v[i]);
        sure |= (kind == TBX_ALL_ORDINARY) << i;
    }
    fill->larges = first;
    for (i = 0; i < 2; i++) { /* numbers that can be computed with */
        for (k = 0; k < 9 && (sure >> i & 1) == 0; k++) {
            v[i][k / 3][k % 3] = 0.0;
        }
    }
    tbx_solid_two_set(&two, s, v);
    tbx_solid_two_lines(&two, s, fill->quick.most_reach);
    sure &= two.sure;
    for (i = 0; i < count; i++) {
        const uint64_t low = (uint64_t)((tbx_l2)two.layers[0])[i];
        const uint64_t high = (uint64_t)((tbx_l2)two.layers[1])[i];
        fill->from[i] = 0;
        if ((sure >> i & 1) == 0) {
            continue;
        }
        tbx_solid_lines_set(&l, &two, i, (uint32_t)s->n[1]);
        if (tbx_solid_is_near((uint32_t)(low << 4), l.unsure) ||
            tbx_solid_is_near((uint32_t)(high << 4), l.unsure)) {
            sure &= ~(1 << i);
        } else {
            const int32_t end = tbx_solid_whole_of(high);
            fill->from[i] = tbx_solid_sweep(s, &l, tbx_solid_whole_of(low), end);
            sure &= ~((fill->from[i] < end) << i);
        }
    }
    return ~sure & ~two.flat & ((1 << count) - 1);
}

/* A triangle of few rows that float is not sure of, in units (section 9) from the centre of a voxel by it.
 * Corners close to it are exact so, and off by u of themselves as doubles, products of two by (1 + 1 + 1) u:
 * E_i is off by less than CLOSE_ERROR of its products, and compared exactly where it may be 0. x of the
 * crossing is that of corners, in voxels, off by 3 u, weighted with E / n_x: in products, over n_x, times the
 * largest x, it is off by (8 + 3 + 1 + 2) u, and by 10 u for n_x itself. */
#define TBX_SOLID_FEW_ERROR (32.0 * TBX_U64)
#define TBX_SOLID_FEW 32

typedef struct tbx_solid_few {
    int64_t units[3][3]; /* axis, corner: from the centre of a voxel that is close to the first one */
    int64_t least[3];
    int64_t most[3];
    int64_t step[3];  /* a voxel's size */
    int64_t voxel[3]; /* that voxel's number */
    int64_t from[3];  /* rows, layers: from that voxel's on */
    int64_t count[3];
    int sign;           /* of n_x */
    double corner_x[3]; /* in voxels */
    double x;           /* the largest magnitude of them */
} tbx_solid_few;

/* Axis k. Returns 0 where a corner is not close, or a voxel, below 2^56 units but for odd origins, is larger:
 * ROWS of them and a corner are below 2^61. */
TBX_FN int tbx_solid_few_axis(tbx_solid_few *f, const tbx_solid *s, double v[3][3], int k)
{
    const double size = s->grid->size[k];
    const double end = (double)s->n[k] + 16.0;
    double voxel = (v[0][k] - s->middle[k]) / size;
    int i;
    voxel = voxel > -16.0 ? voxel : -16.0;
    voxel = voxel < end ? voxel : end;
    TBX_KEEP_SCALAR(voxel);
    f->voxel[k] = (int64_t)voxel;
    f->step[k] = (int64_t)(2 * s->half[k]);
    for (i = 0; i < 3; i++) {
        int64_t x;
        if (!tbx_solid_from_centre(s, k, &v[i][k], f->voxel[k], &x)) {
            return 0;
        }
        f->units[k][i] = x;
        f->least[k] = i == 0 || x < f->least[k] ? x : f->least[k];
        f->most[k] = i == 0 || x > f->most[k] ? x : f->most[k];
    }
    return size * 8.0 <= s->within[k];
}

/* A quotient rounded up. */
TBX_FN int64_t tbx_solid_quotient(int64_t x, int64_t step)
{
    return x / step + (x > 0 && x % step != 0);
}

/* The rows of axis k, 1 or 2, whose centres are in [least, most), in the region, from row `first` on. */
TBX_FN void tbx_solid_few_rows(tbx_solid_few *f, const tbx_solid *s, int k, int64_t first)
{
    int64_t from = tbx_solid_quotient(f->least[k], f->step[k]);
    int64_t end = tbx_solid_quotient(f->most[k], f->step[k]);
    from = from + f->voxel[k] > first ? from : first - f->voxel[k];
    end = end + f->voxel[k] < s->n[k] ? end : s->n[k] - f->voxel[k];
    f->from[k] = from;
    f->count[k] = end > from ? end - from : 0;
}

/* The sign of n_x; 2: not sure. */
TBX_FN int tbx_solid_few_sign(const tbx_solid_few *f)
{
    const int64_t *y = f->units[1];
    const int64_t *z = f->units[2];
    const double forth = (double)(y[1] - y[0]) * (double)(z[2] - z[0]);
    const double back = (double)(z[1] - z[0]) * (double)(y[2] - y[0]);
    const double error = (tbx_abs(forth) + tbx_abs(back)) * TBX_SOLID_CLOSE_ERROR;
    const double area = forth - back;
    const int wall = y[1] == y[2] && z[1] == z[2];
    return area > error ? 1 : area < -error ? -1 : error == 0.0 || wall ? 0 : 2;
}

/* A number in three limbs, of 30 bits but the last, which has its sign; the same of sums of products. */
TBX_FN void tbx_solid_carry(int64_t *limbs, int n)
{
    const int64_t unit = (int64_t)1 << 30;
    int i;
    for (i = 0; i + 1 < n; i++) {
        const int64_t rest = limbs[i] & (unit - 1);
        limbs[i + 1] += (limbs[i] - rest) / unit;
        limbs[i] = rest;
    }
}

TBX_FN void tbx_solid_limbs(int64_t out[3], int64_t x)
{
    out[0] = x;
    out[1] = out[2] = 0;
    tbx_solid_carry(out, 3);
}

/* The sign of the plane's value at a centre, exactly: the sum of x_i E_{i+1}. */
TBX_NOINLINE int tbx_solid_few_plane(const tbx_solid_few *f, int64_t j, int64_t k, int64_t voxel)
{
    int64_t sum[8] = { 0, 0, 0, 0, 0, 0, 0, 0 };
    int i;
    int p;
    int q;
    for (i = 0; i < 3; i++) {
        const int a = i < 2 ? i + 1 : 0;
        const int b = i > 0 ? i - 1 : 2;
        int64_t e[6] = { 0, 0, 0, 0, 0, 0 };
        int64_t x[3];
        int64_t y[2][3];
        int64_t z[2][3];
        tbx_solid_limbs(x, f->units[0][i] - voxel * f->step[0]);
        tbx_solid_limbs(y[0], f->units[1][a] - j * f->step[1]);
        tbx_solid_limbs(y[1], f->units[1][b] - j * f->step[1]);
        tbx_solid_limbs(z[0], f->units[2][a] - k * f->step[2]);
        tbx_solid_limbs(z[1], f->units[2][b] - k * f->step[2]);
        for (p = 0; p < 9; p++) {
            e[p / 3 + p % 3] += y[0][p / 3] * z[1][p % 3] - z[0][p / 3] * y[1][p % 3];
        }
        tbx_solid_carry(e, 6);
        for (p = 0; p < 6; p++) {
            for (q = 0; q < 3; q++) {
                sum[p + q] += e[p] * x[q];
            }
        }
        tbx_solid_carry(sum, 8);
    }
    for (i = 7; i > 0 && sum[i] == 0; i--) {
    }
    return f->sign * ((sum[i] > 0) - (sum[i] < 0));
}

/* x of the crossing of row j in layer k, in voxels, rounded up: where the quotient is not sure, the sign at
 * the centre it is close to is asked. Returns 0 where the edges' values are not sure. */
TBX_FN int tbx_solid_few_voxel(const tbx_solid_few *f, int64_t j, int64_t k, const double value[3],
                               const double m[3], int64_t *out)
{
    const double bottom = value[0] + value[1] + value[2];
    const double off = (m[0] + m[1] + m[2]) * TBX_SOLID_FEW_ERROR * (f->x + 1.0);
    double top = 0.0;
    double past;
    double error = 0.0;
    int i;
    if (!(tbx_abs(bottom) > 8.0 * off)) {
        return 0;
    }
    top = (f->corner_x[0] * value[1] + f->corner_x[1] * value[2] + f->corner_x[2] * value[0]) / bottom;
    *out = tbx_to_long(top);
    past = top - (double)*out;
    *out += past > 0.5 ? 1 : past < -0.5 ? -1 : 0;
    past = top - (double)*out; /* the nearest */
    if (tbx_abs(past * bottom) > off) {
        *out += past > 0.0;
        return 1;
    }
    for (top = 0.0, i = 0; i < 3; i++) {
        const int b = i < 2 ? i + 1 : 0;
        const double x = (double)(f->units[0][i] - *out * f->step[0]);
        top += x * value[b];
        error += tbx_abs(x) * m[b];
    }
    error *= TBX_SOLID_FEW_ERROR;
    if (tbx_abs(top) > error) {
        *out += (f->sign > 0 ? top : -top) > 0.0;
    } else {
        *out += tbx_solid_few_plane(f, j, k, *out) > 0;
    }
    return 1;
}

/* Row j of layer k: the first voxel behind the crossing, or n_x where there is none. Returns 0 where that is
 * not sure. */
TBX_FN int tbx_solid_few_row(const tbx_solid_few *f, int64_t j, int64_t k, int64_t n_x, int64_t *out_x)
{
    double value[3];
    double m[3];
    int64_t x;
    int i;
    *out_x = n_x;
    for (i = 0; i < 3; i++) {
        const int b = i < 2 ? i + 1 : 0;
        const int64_t y_a = f->units[1][i] - j * f->step[1];
        const int64_t y_b = f->units[1][b] - j * f->step[1];
        const int64_t z_a = f->units[2][i] - k * f->step[2];
        const int64_t z_b = f->units[2][b] - k * f->step[2];
        const double forth = (double)y_a * (double)z_b;
        const double back = (double)z_a * (double)y_b;
        int side;
        value[i] = forth - back;
        m[i] = tbx_abs(forth) + tbx_abs(back);
        if (tbx_abs(value[i]) > m[i] * TBX_SOLID_CLOSE_ERROR) {
            side = value[i] > 0.0 ? 1 : -1;
        } else {
            side = tbx_compare_products(y_a, z_b, z_a, y_b);
            side = side != 0 ? side : z_a != z_b ? (z_a > z_b) - (z_a < z_b) : (y_b > y_a) - (y_b < y_a);
        }
        if (side != f->sign) {
            return 1;
        }
    }
    x = f->least[0];
    if (x == f->most[0]) { /* the quotient, rounded up */
        x = tbx_solid_quotient(x, f->step[0]);
    } else if (!tbx_solid_few_voxel(f, j, k, value, m, &x)) {
        return 0;
    }
    *out_x = f->voxel[0] + x;
    return 1;
}

/* Flips what a triangle of few rows crosses from a layer on. Returns 0, and flips nothing, where that is not
 * sure. */
TBX_NOINLINE int tbx_solid_by_units(const tbx_solid *s, double v[3][3], int64_t first)
{
    tbx_solid_few f;
    int64_t x[TBX_SOLID_FEW];
    int64_t rows;
    int64_t i;
    f.count[1] = f.count[2] = 0;
    for (i = 1; i < 3; i++) {
        if (!tbx_solid_few_axis(&f, s, v, (int)i)) {
            return 0;
        }
        tbx_solid_few_rows(&f, s, (int)i, i == 2 ? first : 0);
        if (f.count[i] == 0) {
            return 1;
        }
    }
    rows = f.count[1] * f.count[2];
    f.sign = tbx_solid_few_sign(&f);
    if (f.sign == 0) {
        return 1;
    }
    if (rows > TBX_SOLID_FEW || f.sign == 2 || !tbx_solid_few_axis(&f, s, v, 0)) {
        return 0;
    }
    f.x = 0.0;
    for (i = 0; i < 3; i++) {
        f.corner_x[i] = (double)f.units[0][i] / (double)f.step[0];
        f.x = tbx_abs(f.corner_x[i]) > f.x ? tbx_abs(f.corner_x[i]) : f.x;
    }
    for (i = 0; i < rows; i++) {
        if (!tbx_solid_few_row(&f, f.from[1] + i % f.count[1], f.from[2] + i / f.count[1], s->n[0], &x[i])) {
            return 0;
        }
    }
    for (i = 0; i < rows; i++) {
        if (x[i] < s->n[0]) {
            tbx_solid_flip(s, x[i] > 0 ? x[i] : 0, f.voxel[1] + f.from[1] + i % f.count[1],
                           f.voxel[2] + f.from[2] + i / f.count[1]);
        }
    }
    return 1;
}

/* The scalar way. */
TBX_NOINLINE void tbx_solid_careful(const tbx_solid_quick *q, size_t triangle, int32_t first)
{
    double v[3][3];
    const int kind = tbx_source_triangle(q->source, triangle, v);
    if (kind == TBX_ALL_ORDINARY && tbx_solid_by_units(q->solid, v, first)) {
        return;
    }
    if (kind != TBX_NO_POINTS) {
        tbx_solid_part(q->solid, v, kind, first);
    }
}

/* Flips the rows that wait. */
TBX_NOINLINE void tbx_solid_flip_all(tbx_solid_fill *fill)
{
    const tbx_solid *s = fill->quick.solid;
    const size_t row_words = s->row_words;
    const uint64_t padding = ~s->last_word;
    int i;
    for (i = 0; i < fill->crossings; i++) {
        const size_t x = fill->crossing[i].x;
        const size_t word = x >> 6;
        tbx_solid_flip_wide(fill->crossing[i].row + word, row_words - word, padding, x);
    }
    fill->crossings = 0;
}

/* Rows of lanes whose box is partly out of the region. */
TBX_NOINLINE void tbx_solid_cut(tbx_solid_rows_of *rows, const tbx_solid *s, const int32_t *y,
                                const int32_t *z, int n)
{
    int lane;
    int j;
    int k;
    for (k = 0; k < n; k++) {
        for (j = 0; j < n; j++) {
            for (lane = 0; lane < TBX_WIDE; lane++) {
                if ((uint32_t)(y[lane] + j) >= (uint32_t)s->n[1] ||
                    (uint32_t)(z[lane] + k) >= (uint32_t)s->n[2]) {
                    rows->within[k] &= ~((uint32_t)1 << (lane + TBX_WIDE * j));
                }
            }
        }
    }
}

/* The voxels of lanes on the lattice. */
TBX_NOINLINE void tbx_solid_lattice(tbx_solid_rows_of *rows, const tbx_solid_quick *q,
                                    const tbx_solid_placed *p, int n)
{
    const int32_t n_x = (int32_t)q->solid->n[0];
    int k;
    for (k = 0; k < n; k++) {
        uint32_t left = rows->within[k];
        for (; left != 0; left &= left - 1) {
            const int bit = __builtin_ctz(left);
            const int lane = bit % TBX_WIDE;
            if (p->on_lattice[lane] != 0) {
                const int64_t x =
                    p->x_first[lane] + tbx_solid_lattice_voxel(q, p->v, lane, bit / TBX_WIDE, k);
                rows->voxel[TBX_WIDE * n * k + bit] = x > 0 ? (int32_t)x : 0;
                if (x >= n_x) {
                    rows->within[k] &= ~((uint32_t)1 << bit);
                }
            }
        }
    }
}

/* `count` triangles of a list, WIDE at most, from i on. Returns those that are not sure. */
TBX_FORCED unsigned tbx_solid_flush(tbx_solid_fill *fill, const tbx_solid_list *list, int i, int count, int n)
{
    const tbx_solid_quick *q = &fill->quick;
    const tbx_solid *s = q->solid;
    const size_t row_words = s->row_words;
    const size_t layer_words = row_words * (size_t)s->n[1];
    tbx_solid_placed p;
    tbx_solid_rows_of rows;
    size_t first[TBX_WIDE];
    uint32_t sure;
    int lane;
    int k;
    p.unsure = tbx_wide_int(0);
    p.on_lattice = tbx_wide_int(0);
    if (q->source->is_double) {
        tbx_solid_place_doubles(&p, q, list, i);
    } else {
        tbx_solid_place_floats(&p, q, list, i);
    }
    tbx_solid_decide(&rows, q, &p, n);
    if (q->lattice) {
        tbx_solid_lattice(&rows, q, &p, n);
    }
    if (n > 1) {
        tbx_iw y;
        tbx_iw z;
        TBX_COPY(&y, list->y + i, sizeof y);
        TBX_COPY(&z, list->z + i, sizeof z);
        if (TBX_RARELY(tbx_wide_any(y | z | (tbx_wide_int((int32_t)s->n[1] - n) - y) |
                                    (tbx_wide_int((int32_t)s->n[2] - n) - z)))) {
            tbx_solid_cut(&rows, s, list->y + i, list->z + i, n);
        }
    }
    sure = (uint32_t)(~rows.unsure & ((1u << count) - 1u));
    if (n > 1) {
        sure |= sure << TBX_WIDE;
    }
    if (n > 2) {
        sure |= sure << 2 * TBX_WIDE;
    }
    for (lane = 0; lane < TBX_WIDE; lane++) {
        first[lane] = (size_t)((int64_t)list->z[i + lane] * s->n[1] + list->y[i + lane]) * row_words;
    }
    for (k = 0; k < n; k++) {
        uint32_t left = rows.within[k] & sure;
        const size_t layer = layer_words * (size_t)k;
        int crossings = fill->crossings;
        for (; left != 0; left &= left - 1) {
            const int bit = __builtin_ctz(left);
            const size_t row = first[bit % TBX_WIDE] + row_words * (size_t)(n > 1 ? bit / TBX_WIDE : 0);
            tbx_solid_crossing *c = &fill->crossing[crossings++];
            c->x = (size_t)rows.voxel[TBX_WIDE * n * k + bit];
            c->row = s->bits + (layer + row); /* both may wrap, their sum is a row's */
            TBX_PREFETCH(c->row + (c->x >> 6));
        }
        fill->crossings = crossings;
        if (crossings > TBX_SOLID_CROSSINGS) {
            tbx_solid_flip_all(fill);
        }
    }
    return rows.unsure & ((1u << count) - 1u);
}

#define TBX_FLUSH(name, n)                                                                                \
    TBX_NOINLINE unsigned name(tbx_solid_fill *fill, const tbx_solid_list *list, int i, int count)        \
    {                                                                                                     \
        return tbx_solid_flush(fill, list, i, count, n);                                                  \
    }
TBX_FLUSH(tbx_solid_flush1, 1)
TBX_FLUSH(tbx_solid_flush2, 2)
TBX_FLUSH(tbx_solid_flush3, 3)
TBX_FLUSH(tbx_solid_flush4, 4)
#undef TBX_FLUSH

/* Two by two, each way outside of the way before: their stacks do not add up. */
TBX_FORCED void tbx_solid_work_large(tbx_solid_fill *fill)
{
    while (fill->larges > 0) {
        int careful = tbx_solid_large(fill);
        for (; careful != 0; careful &= careful - 1) {
            const int i = __builtin_ctz((unsigned)careful);
            tbx_solid_careful(&fill->quick, fill->large[fill->larges + i], fill->from[i]);
        }
    }
}

/* Works a list off, WIDE at a time from its end; to the last one if `all`. */
TBX_FORCED void tbx_solid_work(tbx_solid_fill *fill, int extent, int all)
{
    tbx_solid_list *list = &fill->list[extent - 1];
    while (list->n >= TBX_WIDE || (all && list->n > 0)) {
        const int count = list->n < TBX_WIDE ? list->n : TBX_WIDE;
        const int i = list->n - count;
        unsigned unsure;
        int lane;
        for (lane = count; lane < TBX_WIDE; lane++) {
            list->triangle[lane] = list->triangle[0];
            list->y[lane] = list->y[0];
            list->z[lane] = list->z[0];
        }
        list->n = i;
        switch (extent) {
        case 1: unsure = tbx_solid_flush1(fill, list, i, count); break;
        case 2: unsure = tbx_solid_flush2(fill, list, i, count); break;
        case 3: unsure = tbx_solid_flush3(fill, list, i, count); break;
        default: unsure = tbx_solid_flush4(fill, list, i, count); break;
        }
        for (; unsure != 0; unsure &= unsure - 1) {
            tbx_solid_careful(&fill->quick, list->triangle[i + __builtin_ctz(unsure)], 0);
        }
    }
}

/* Triangles of a block that have rows go to their lists, and full lists are worked off. */
TBX_NOINLINE void tbx_solid_sort(tbx_solid_fill *fill, size_t first, uint32_t live, int all)
{
    for (; live != 0; live &= live - 1) {
        const int of = __builtin_ctz(live);
        const size_t triangle = first + (size_t)of;
        const int extent = fill->extent[of];
        if (TBX_RARELY(extent > TBX_SOLID_ROWS)) {
            fill->large[fill->larges++] = triangle;
        } else {
            tbx_solid_list *list = &fill->list[extent - 1];
            const int n = list->n;
            list->triangle[n] = triangle;
            list->y[n] = fill->y[of];
            list->z[n] = fill->z[of];
            list->n = n + 1;
        }
    }
    tbx_solid_work_large(fill);
    tbx_solid_work(fill, 1, all);
    tbx_solid_work(fill, 2, all);
    tbx_solid_work(fill, 3, all);
    tbx_solid_work(fill, 4, all);
}

/* y and z of corner c of WIDE triangles, as tbx_load_corner. */
TBX_FORCED void tbx_solid_load(tbx_points *out, const tbx_source *source, int indexed, size_t stride,
                               size_t first, size_t c)
{
    const char *positions = source->positions + sizeof(float);
    const uint32_t *indices = source->indices;
    tbx_f4 y[TBX_WIDE / 4];
    tbx_f4 z[TBX_WIDE / 4];
    int i;
#define TBX_AT(i) (3 * (first + (size_t)(i)) + c)
#define TBX_POINT(i) (positions + stride * (indexed ? (size_t)indices[TBX_AT(i)] : TBX_AT(i)))
    for (i = 0; i < TBX_WIDE / 4; i++) {
        const tbx_f4 ab = tbx_load_xy(TBX_POINT(4 * i), TBX_POINT(4 * i + 1));
        const tbx_f4 cd = tbx_load_xy(TBX_POINT(4 * i + 2), TBX_POINT(4 * i + 3));
        y[i] = TBX_LANES(ab, cd, 0, 2, 4, 6);
        z[i] = TBX_LANES(ab, cd, 1, 3, 5, 7);
    }
#undef TBX_POINT
#undef TBX_AT
    out->y = tbx_wide_of(y);
    out->z = tbx_wide_of(z);
}

/* The same of doubles, less the first centre: what is too large becomes 0, and its lane of `wild` is set. */
TBX_FORCED void tbx_solid_load_f64(tbx_points *out, const tbx_solid_quick *q, int indexed, size_t first,
                                   size_t c, tbx_iw *wild)
{
    const uint32_t *indices = q->source->indices;
    const char *positions = q->source->positions + sizeof(double);
    const size_t stride = q->source->stride;
    const tbx_d2 middle = { q->solid->middle[1], q->solid->middle[2] };
    const tbx_i4 most = { q->most[1], q->most[2], q->most[1], q->most[2] };
    tbx_f4 y[TBX_WIDE / 4];
    tbx_f4 z[TBX_WIDE / 4];
    tbx_f4 odd[TBX_WIDE / 4];
    int i;
#define TBX_AT(i) (3 * (first + (size_t)(i)) + c)
#define TBX_POINT(i) (positions + stride * (indexed ? (size_t)indices[TBX_AT(i)] : TBX_AT(i)))
    for (i = 0; i < TBX_WIDE / 4; i++) {
        tbx_d2 x0 = tbx_solid_yz(TBX_POINT(4 * i));
        tbx_d2 x1 = tbx_solid_yz(TBX_POINT(4 * i + 1));
        tbx_d2 x2 = tbx_solid_yz(TBX_POINT(4 * i + 2));
        tbx_d2 x3 = tbx_solid_yz(TBX_POINT(4 * i + 3));
        const tbx_i4 above = (TBX_LANES((tbx_i4)x0, (tbx_i4)x1, 1, 3, 5, 7) & 0x7fffffff) > most;
        const tbx_i4 below = (TBX_LANES((tbx_i4)x2, (tbx_i4)x3, 1, 3, 5, 7) & 0x7fffffff) > most;
        tbx_f4 ab;
        tbx_f4 cd;
        odd[i] = tbx_splat(0.0f);
        if (TBX_RARELY(tbx_any(above | below))) {
            x0 = (tbx_d2)((tbx_i4)x0 & ~TBX_LANES(above, above, 0, 0, 1, 1));
            x1 = (tbx_d2)((tbx_i4)x1 & ~TBX_LANES(above, above, 2, 2, 3, 3));
            x2 = (tbx_d2)((tbx_i4)x2 & ~TBX_LANES(below, below, 0, 0, 1, 1));
            x3 = (tbx_d2)((tbx_i4)x3 & ~TBX_LANES(below, below, 2, 2, 3, 3));
            odd[i] = (tbx_f4)(TBX_LANES(above, below, 0, 2, 4, 6) | TBX_LANES(above, below, 1, 3, 5, 7));
        }
        x0 -= middle;
        x1 -= middle;
        x2 -= middle;
        x3 -= middle;
        TBX_KEEP_VECTOR(x0);
        TBX_KEEP_VECTOR(x1);
        TBX_KEEP_VECTOR(x2);
        TBX_KEEP_VECTOR(x3);
        ab = TBX_LANES(tbx_narrow(x0), tbx_narrow(x1), 0, 1, 4, 5);
        cd = TBX_LANES(tbx_narrow(x2), tbx_narrow(x3), 0, 1, 4, 5);
        y[i] = TBX_LANES(ab, cd, 0, 2, 4, 6);
        z[i] = TBX_LANES(ab, cd, 1, 3, 5, 7);
    }
#undef TBX_POINT
#undef TBX_AT
    out->y = tbx_wide_of(y);
    out->z = tbx_wide_of(z);
    *wild |= (tbx_iw)tbx_wide_of(odd);
}

/* y and z of WIDE triangles from the first on; those of triangles that have one too large reach over the
 * region. */
TBX_FORCED void tbx_solid_corners(tbx_points v[3], const tbx_solid_quick *q, int indexed, size_t stride,
                                  size_t first, int is_double)
{
    const int32_t y = q->most[1];
    const int32_t z = q->most[2];
    tbx_iw wild = tbx_wide_int(0);
    if (is_double) {
        tbx_solid_load_f64(&v[0], q, indexed, first, 0, &wild);
        tbx_solid_load_f64(&v[1], q, indexed, first, 1, &wild);
        tbx_solid_load_f64(&v[2], q, indexed, first, 2, &wild);
    } else {
        tbx_solid_load(&v[0], q->source, indexed, stride, first, 0);
        tbx_solid_load(&v[1], q->source, indexed, stride, first, 1);
        tbx_solid_load(&v[2], q->source, indexed, stride, first, 2);
        wild = tbx_solid_wild(v[0].y, y) | tbx_solid_wild(v[1].y, y) | tbx_solid_wild(v[2].y, y) |
               tbx_solid_wild(v[0].z, z) | tbx_solid_wild(v[1].z, z) | tbx_solid_wild(v[2].z, z);
    }
    if (TBX_RARELY(tbx_wide_any(wild))) {
        v[0].y = tbx_wide_choose(wild, q->axis[0].outside, v[0].y);
        v[0].z = tbx_wide_choose(wild, q->axis[1].outside, v[0].z);
        v[1].y = tbx_wide_choose(wild, -q->axis[0].outside, v[1].y);
        v[1].z = tbx_wide_choose(wild, -q->axis[1].outside, v[1].z);
        v[2].y = tbx_wide_where(~wild, v[2].y);
        v[2].z = tbx_wide_where(~wild, v[2].z);
    }
}

/* The boxes of up to ROWS rows on each axis are looked at again. */
TBX_FORCED tbx_iw tbx_solid_refined(tbx_solid_fill *fill, const tbx_points v[3], size_t first, tbx_iw some,
                                    tbx_iw *y, tbx_iw *z, tbx_iw *n_y, tbx_iw *n_z)
{
    const tbx_iw rows = tbx_wide_int(TBX_SOLID_ROWS);
    const tbx_iw few = some & ~((*n_y > rows) | (*n_z > rows));
    tbx_solid_boxed b;
    int c;
    if (!tbx_wide_any(few)) {
        return some;
    }
    for (c = 0; c < 3; c++) {
        b.v[0][c] = v[c].y;
        b.v[1][c] = v[c].z;
    }
    b.before[0] = *y;
    b.before[1] = *z;
    b.n[0] = *n_y;
    b.n[1] = *n_z;
    b.some = few;
    tbx_solid_refine(&b, &fill->quick, first);
    fill->narrows |= tbx_wide_signs(b.narrow & few);
    *y = tbx_wide_select(few, b.before[0], *y);
    *z = tbx_wide_select(few, b.before[1], *z);
    *n_y = tbx_wide_select(few, b.n[0], *n_y);
    *n_z = tbx_wide_select(few, b.n[1], *n_z);
    return b.some | (some & ~few);
}

/* A block of `count` triangles, a multiple of WIDE. Returns a bit for each that has rows. */
TBX_FORCED uint32_t tbx_solid_boxes(tbx_solid_fill *fill, int indexed, size_t stride, size_t first, int count,
                                    int is_double)
{
    const tbx_solid_quick *q = &fill->quick;
    const tbx_iw before_first = tbx_wide_int(TBX_SOLID_MARGIN - 1);
    uint32_t live = 0;
    int i;
    for (i = 0; i < count; i += TBX_WIDE) {
        tbx_points v[3];
        tbx_iw y;
        tbx_iw z;
        tbx_iw end_y;
        tbx_iw end_z;
        tbx_iw some;
        tbx_solid_corners(v, q, indexed, stride, first + (size_t)i, is_double);
        tbx_solid_rows_between(&q->axis[0], v[0].y, v[1].y, v[2].y, &y, &end_y);
        tbx_solid_rows_between(&q->axis[1], v[0].z, v[1].z, v[2].z, &z, &end_z);
        some = (end_y > y) & (end_z > z);
        if (tbx_wide_any(some)) {
            tbx_iw n_y = end_y - y;
            tbx_iw n_z = end_z - z;
            tbx_iw extent;
            tbx_iw one;
            if (fill->refines) {
                some = tbx_solid_refined(fill, v, first + (size_t)i, some, &y, &z, &n_y, &n_z);
            }
            some &= (y + n_y > before_first) & (z + n_z > before_first);
            some &= ~((y > q->axis[0].last) | (z > q->axis[1].last));
            extent = tbx_wide_select(n_y > n_z, n_y, n_z);
            one = some & (extent == tbx_wide_int(1));
            if (!fill->refines && tbx_wide_any(one)) {
                some &= ~(one & tbx_solid_missed(q, v, y, z));
            }
            live |= (uint32_t)tbx_wide_signs(some) << i;
            y -= before_first;
            z -= before_first;
            TBX_COPY(fill->y + i, &y, sizeof y);
            TBX_COPY(fill->z + i, &z, sizeof z);
            TBX_COPY(fill->extent + i, &extent, sizeof extent);
        }
    }
    return live;
}

/* The same, by what kind of mesh it is. */
TBX_NOINLINE uint32_t tbx_solid_block(tbx_solid_fill *fill, size_t first, int count)
{
    const size_t packed = 3 * sizeof(float);
    const tbx_source *source = fill->quick.source;
    const int indexed = source->indices != NULL;
    if (source->is_double) {
        return indexed ? tbx_solid_boxes(fill, 1, source->stride, first, count, 1)
                       : tbx_solid_boxes(fill, 0, source->stride, first, count, 1);
    }
    if (!indexed) {
        return tbx_solid_boxes(fill, 0, source->stride, first, count, 0);
    }
    return source->stride == packed ? tbx_solid_boxes(fill, 1, packed, first, count, 0)
                                    : tbx_solid_boxes(fill, 1, source->stride, first, count, 0);
}

/* All triangles but the last few. Returns how many are done: 0 if the grid's numbers are out of range. */
TBX_FN size_t tbx_solid_quick_fill(const tbx_solid *s, const tbx_source *source)
{
    const size_t triangles = source->triangles - source->triangles % TBX_WIDE;
    tbx_solid_fill fill;
    size_t t;
    int i;
    tbx_solid_quick_init(&fill.quick, s, source);
    if (!fill.quick.on) {
        return 0;
    }
    for (i = 0; i < TBX_SOLID_ROWS; i++) {
        fill.list[i].n = 0;
    }
    fill.larges = fill.crossings = 0;
    fill.narrows = 0;
    for (t = 0; t < triangles; t += TBX_SOLID_BLOCK) {
        const size_t left = triangles - t;
        uint32_t live;
        fill.refines = (!source->is_double || fill.quick.exact.on) &&
                       (fill.narrows != 0 || t / TBX_SOLID_BLOCK % 16 == 0);
        fill.narrows = 0;
        live = tbx_solid_block(&fill, t, left < TBX_SOLID_BLOCK ? (int)left : TBX_SOLID_BLOCK);
        tbx_solid_sort(&fill, t, live, left <= TBX_SOLID_BLOCK);
    }
    tbx_solid_flip_all(&fill);
    return triangles;
}
#endif /* TRIBOX_SIMD */

/* ---- 12. Undefine private macros ----------------------------------------------------------------------- */

#undef TBX_HD
#undef TBX_FN
#undef TBX_COLD
#undef TBX_NOINLINE
#undef TBX_RARELY
#undef TBX_UNROLL
#undef TBX_PREFETCH
#undef TBX_ROOT
#undef TBX_COPY
#undef TBX_KEEP
#undef TBX_KEEP_SCALAR
#undef TBX_KEEP_VECTOR
#undef TBX_KEEP_POINTER
#undef TBX_KEEP2
#undef TBX_KEEP3
#undef TBX_KEEP4
#undef TBX_VECTOR_PLACE
#undef TBX_HAS_ASM
#undef TBX_HAS_VECTORS
#undef TBX_GNU
#undef TBX_ALIGNED
#undef TBX_EVAL_METHOD
#undef TBX_DECIDES
#undef TBX_PLACED_ERROR
#undef TBX_GROUP_EDGE_ERROR
#undef TBX_GROUP_PLANE_ERROR
#undef TBX_QUICK_ERROR
#undef TBX_QUICK_MOST
#undef TBX_PRECISE_LEAST
#undef TBX_ROW_LEAST
#undef TBX_ROW_TILT
#undef TBX_SOLID_LEAST
#undef TBX_DOUBLE_IS_53_BITS
#undef TBX_EITHER
#undef TBX_RETURN_IF_SURE
#undef TBX_PAIR_SIGNS
#undef TBX_POW2
#undef TBX_LONE_RANGE
#undef TBX_LONE_PLANE_ERROR
#undef TBX_LONE_PLACE
#undef TBX_LONE_NEAR
#undef TBX_LONE_HIGH
#undef TBX_LONE_EDGE_ERROR
#undef TBX_EACH_LAYER
#undef TBX_COORD_ROOM
#undef TBX_COORD_LIMBS
#undef TBX_CROSS_LIMBS
#undef TBX_OCTANTS_UNSURE
#undef TBX_TRI_ULPS
#undef TBX_NORMAL_ULPS
#undef TBX_PURE
#undef TBX_EACH
#undef TBX_VALUE
#undef TBX_EDGES
#undef TBX_NO_EXPONENT
#undef TBX_ALL_AXES
#undef TBX_ULPS
#undef TBX_U32
#undef TBX_U64
#undef TBX_LANES
#undef TBX_HIGH_WORDS
#undef TBX_LOW_WORDS
#undef TBX_LIST
#undef TBX_JOIN
#undef TBX_PAIR
#undef TBX_KEY32_MAX
#undef TBX_SIGN_BIT
#undef TBX_FORCED
#undef TBX_MARGIN
#undef TBX_PARTS
#undef TBX_PARTS_LOG2
#undef TBX_ON_LATTICE
#undef TBX_IS_CUT
#undef TBX_OFF
#undef TBX_NOT_KNOWN
#undef TBX_FEW
#undef TBX_ALL
#undef TBX_MOST_INDEX
#undef TBX_BLOCK
#undef TBX_PIECES
#undef TBX_BESIDE
#undef TBX_FINE_ERROR
#undef TBX_FINE_REACH
#undef TBX_PRECISE
#undef TBX_PRECISE_EDGE_ERROR
#undef TBX_REST_ERROR
#undef TBX_FARTHEST
#undef TBX_REST_LEAST
#undef TBX_PRECISE_PLANE_ERROR
#undef TBX_CACHED
#undef TBX_FIXED
#undef TBX_FIXED_ERROR
#undef TBX_BEFORE
#undef TBX_SMALL_EDGE_ERROR
#undef TBX_SMALL_PLANE_ERROR
#undef TBX_BEYOND
#undef TBX_COORDINATE_ERROR
#undef TBX_LINE_ERROR
#undef TBX_MOST_ERROR
#undef TBX_MOST_SLOPE
#undef TBX_NORMAL_ERROR
#undef TBX_ORDINARY
#undef TBX_PLACES
#undef TBX_PLACES_LOG2
#undef TBX_PLANE_ERROR
#undef TBX_SPANS
#undef TBX_NOWHERE
#undef TBX_ROW_ERROR
#undef TBX_AREA_ERROR
#undef TBX_ROWS
#undef TBX_LAST_FIRST
#undef TBX_WIDE
#undef TBX_SOLID_ROWS
#undef TBX_SOLID_NEAR_ERROR
#undef TBX_SOLID_ALONE_ERROR
#undef TBX_SOLID_ALONE_REST
#undef TBX_SOLID_CLOSE_ERROR
#undef TBX_SOLID_FEW
#undef TBX_SOLID_FEW_ERROR
#undef TBX_PLACE_BITS
#undef TBX_PLACE_ERROR
#undef TBX_PLACE_FIXED
#undef TBX_PLACE_OF_0
#undef TBX_PLACE_ROUNDED
#undef TBX_PLACE_STEP
#undef TBX_SOLID_CELLS
#undef TBX_SOLID_CELL_ERROR
#undef TBX_SOLID_CELL_SUMS
#undef TBX_SOLID_PARTS
#undef TBX_SOLID_MARGIN
#undef TBX_SOLID_LINE_ERROR
#undef TBX_SOLID_FIXED
#undef TBX_SOLID_LAYERS
#undef TBX_SOLID_BLOCK
#undef TBX_SOLID_BOX_ERROR
#undef TBX_SOLID_PLACE_ERROR
#undef TBX_SOLID_ROW_ERROR
#undef TBX_SOLID_ROW_ULPS
#undef TBX_SOLID_CROSSINGS
#undef TBX_SOLID_TINY
#undef TBX_CROSS_EDGE_ERROR
#undef TBX_CROSS_PLANE_ERROR
#undef TBX_SOLID_ERROR
#undef TBX_SOLID_EDGE_ERROR
#undef TBX_SOLID_NORMAL_ERROR
#undef TBX_SOLID_PLANE_ERROR
#undef TBX_GAP_ALL
#undef TBX_SEGMENT_ERROR
#undef TBX_BALL_ERROR
#undef TBX_PLANE_SPHERE_ERROR
#undef TBX_TOUCH_ERROR
#undef TBX_PIERCE_ERROR
#undef TBX_PIERCE_ERROR4
#undef TBX_SHOT_ERROR
#undef TBX_BALL_ERROR4
#undef TBX_PLANE_SPHERE_ERROR4
#undef TBX_GAP_CLOSE
#undef TBX_GAP_MEASURE_ERROR
#undef TBX_GAP_FACE_ERROR
#undef TBX_UNIT_ERROR
#undef TBX_GAP_ERROR4
#undef TBX_GAP_ROOT
#undef TBX_GAP_VOID
#undef TBX_GAP_SURE
#undef TBX_GAP_GUESS
#undef TBX_GAP_NORMAL_ERROR
#undef TBX_GAP_EDGE_ERROR
#undef TBX_GAP_LENGTH
#undef TBX_KEY_INFINITY
#undef TBX_FLOAT_INFINITY
#undef TBX_LIMB_BITS
#undef TBX_MOTION_SLOT
#undef TBX_NUM_ERROR
#undef TBX_RAY_ERROR
#undef TBX_RAY_NOTHING
#undef TBX_SLAB_BEYOND
#undef TBX_SLAB_ERROR
#undef TBX_SLAB_INVERSE_ERROR
#undef TBX_SOLID_MIDDLE_ERROR
#undef TBX_STEPS
#undef TBX_STEPS_ULPS
#undef TBX_BOUND_ERROR
#undef TBX_STORE

#if defined(__GNUC__) && !defined(__TINYC__) && !defined(__PCC__) && !defined(__chibicc__)
#pragma GCC diagnostic pop
#endif
#pragma pack(pop)

#ifdef __cplusplus
}
#endif

#endif /* TRIBOX_H */

/*
 * tribox.h is available under two licences. Choose the one you prefer.
 *
 * ------------------------------------------------------------------------------
 * ALTERNATIVE A - MIT License
 *
 * Copyright (c) 2026 the tribox.h authors
 *
 * Permission is hereby granted, free of charge, to any person obtaining a copy
 * of this software and associated documentation files (the "Software"), to deal
 * in the Software without restriction, including without limitation the rights
 * to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
 * copies of the Software, and to permit persons to whom the Software is
 * furnished to do so, subject to the following conditions:
 *
 * The above copyright notice and this permission notice shall be included in all
 * copies or substantial portions of the Software.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
 * IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
 * FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
 * AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
 * LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
 * OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
 * SOFTWARE.
 *
 * ------------------------------------------------------------------------------
 * ALTERNATIVE B - Public domain (Unlicense, https://unlicense.org)
 *
 * This is free and unencumbered software released into the public domain.
 *
 * Anyone is free to copy, modify, publish, use, compile, sell, or distribute
 * this software, either in source code form or as a compiled binary, for any
 * purpose, commercial or non-commercial, and by any means.
 *
 * In jurisdictions that recognize copyright laws, the author or authors of this
 * software dedicate any and all copyright interest in the software to the public
 * domain. We make this dedication for the benefit of the public at large and to
 * the detriment of our heirs and successors. We intend this dedication to be an
 * overt act of relinquishment in perpetuity of all present and future rights to
 * this software under copyright law.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
 * IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
 * FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
 * AUTHORS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN
 * ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION
 * WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
 */
