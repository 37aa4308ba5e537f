/* voxel_test.h - a unit test of your voxelizer in one call: put this file and tribox.h beside your tests
 *
 *   static int set(void *user, int x, int y, int z) { return my_grid_has((my_grid *)user, x, y, z); }
 *   ...
 *   tribox_grid grid = {{0, 0, 0}, {0.1, 0.1, 0.1}, {0, 0, 0}, {64, 64, 64}, 0};      flags: which faces count
 *   tribox_mesh mesh = {positions, 0, indices, triangles};
 *   voxel_test t = voxel_test_run(&grid, &mesh, set, &my_voxels, stderr);
 *   assert(t.missing == 0 && t.extra == 0);
 *
 * Every voxel of the grid is asked once and compared with the exact set. The first differences are printed,
 * each with a triangle that touches the voxel: for a missing one it proves the fault, for an extra one there
 * is none. Where your voxels are [i-1/2, i+1/2], as samples often are, move grid.origin by half a voxel.
 * voxel_test_solid compares samples at the voxels' middles with the inside.
 */
#ifndef VOXEL_TEST_H
#define VOXEL_TEST_H
#include "tribox.h"

#include <stdio.h>
#include <stdlib.h>

#define VOXEL_TEST_SHOWN 10

typedef struct voxel_test {
    size_t exact;               /* voxels of the exact set */
    size_t missing;             /* of these, not set */
    size_t extra;               /* set, but not of these */
    int    valid;               /* 0: the grid is empty or out of memory; nothing was compared */
} voxel_test;

static inline void voxel_test_show(const tribox_grid *grid, const tribox_mesh *mesh, int missing, int x,
                                   int y, int z, FILE *say) {
    tribox_grid one = *grid;
    size_t stride = mesh->stride ? mesh->stride : 3 * sizeof(float);
    size_t t;
    one.lo[0] = x, one.lo[1] = y, one.lo[2] = z;
    one.hi[0] = x + 1, one.hi[1] = y + 1, one.hi[2] = z + 1;
    fprintf(say, "%s voxel %d,%d,%d", missing ? "missing" : "extra", x, y, z);
    for (t = 0; t < mesh->triangles; t++) {
        const char *base = (const char *)mesh->positions;
        const float *v[3];
        size_t i;
        for (i = 0; i < 3; i++) {
            v[i] =
                (const float *)(const void *)(base
                                              + stride
                                                    * (mesh->indices ? mesh->indices[3 * t + i] : 3 * t + i));
        }
        if (tribox_grid_spans(&one, v[0], v[1], v[2], NULL, NULL)) {
            fprintf(say, ": triangle %lu touches it", (unsigned long)t);
            break;
        }
    }
    fprintf(say, "\n");
}

/* Fills `bits` exactly and asks for every voxel; `say` NULL prints nothing. */
static inline voxel_test voxel_test_compare(const tribox_grid *grid, const tribox_mesh *mesh, int solid,
                                            int (*set)(void *user, int x, int y, int z), void *user,
                                            FILE *say) {
    voxel_test result = {0, 0, 0, 0};
    size_t words = tribox_grid_words(grid);
    uint64_t *bits = words ? (uint64_t *)calloc(words, sizeof *bits) : NULL;
    int x, y, z;
    if (!bits) {
        return result;
    }
    if (solid) {
        tribox_grid_fill_solid(grid, mesh, bits);
    } else {
        tribox_grid_fill(grid, mesh, bits);
    }
    result.valid = 1;
    for (z = grid->lo[2]; z < grid->hi[2]; z++) {
        for (y = grid->lo[1]; y < grid->hi[1]; y++) {
            for (x = grid->lo[0]; x < grid->hi[0]; x++) {
                int exact = tribox_grid_get(grid, bits, x, y, z);
                int given = set(user, x, y, z) != 0;
                result.exact += (size_t)exact;
                result.missing += (size_t)(exact && !given);
                result.extra += (size_t)(given && !exact);
                if (exact != given && say && result.missing + result.extra <= VOXEL_TEST_SHOWN) {
                    voxel_test_show(grid, mesh, exact, x, y, z, say);
                }
            }
        }
    }
    free(bits);
    return result;
}

static inline voxel_test voxel_test_run(const tribox_grid *grid, const tribox_mesh *mesh,
                                        int (*set)(void *user, int x, int y, int z), void *user, FILE *say) {
    return voxel_test_compare(grid, mesh, 0, set, user, say);
}

static inline voxel_test voxel_test_solid(const tribox_grid *grid, const tribox_mesh *mesh,
                                          int (*set)(void *user, int x, int y, int z), void *user,
                                          FILE *say) {
    return voxel_test_compare(grid, mesh, 1, set, user, say);
}

#endif /* VOXEL_TEST_H */
