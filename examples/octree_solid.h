/* octree_solid.h - the octree of a solid, built from the voxels up, some layers at a time
 *
 * A cell is empty, full, or a node with eight cells; a full cell of any level is one leaf, however many voxels it
 * has, so that nodes are where the solid's border is and nowhere else. tribox_grid_fill_solid gives the voxels of
 * LAYERS layers; four by two by two become cells of the next level, two planes of cells one of the level above, and
 * so on. Memory: those layers, two planes a level, and the nodes.
 */
#ifndef EXAMPLES_OCTREE_SOLID_H
#define EXAMPLES_OCTREE_SOLID_H
#include "program.h"

enum { SOLID_LAYERS = 16, SOLID_LEVELS = 17, CELL_EMPTY = 0, CELL_FULL = 1, CELL_NODE = 2 };

typedef uint32_t cell;      /* CELL_NODE + i: node i of its level */

typedef struct solid_level {
    size_t   n[3];          /* cells along x, y, z that may be anything but empty */
    cell    *plane;         /* one that waits for the next */
    cell    *next;
    int      waits;
    cell   (*node)[8];      /* of levels above 1 */
    uint8_t *voxels;        /* of level 1: the voxels of a node as bits */
    size_t   nodes;
    size_t   room;
    size_t   full;          /* leaves of this level in nodes above */
} solid_level;

typedef struct solid_tree {
    int         depth;      /* the root's level; voxels are level 0 */
    solid_level level[SOLID_LEVELS];
    cell        root;
    double      voxels;
    int         failed;
} solid_tree;

static cell solid_add(solid_tree *t, int level, const cell child[8], unsigned bits) {
    solid_level *l = &t->level[level];
    int o;
    if (l->nodes == l->room) {
        size_t room = 2 * l->room + 1024;
        void *grown = level == 1 ? realloc(l->voxels, room) : realloc(l->node, room * sizeof *l->node);
        if (!grown) {
            t->failed = 1;
            return CELL_EMPTY;
        }
        if (level == 1) {
            l->voxels = (uint8_t *)grown;
        } else {
            l->node = (cell (*)[8])grown;
        }
        l->room = room;
    }
    if (level == 1) {
        l->voxels[l->nodes] = (uint8_t)bits;
        for (; bits != 0; bits &= bits - 1) {
            t->level[0].full++;
        }
    } else {
        memcpy(l->node[l->nodes], child, sizeof l->node[0]);
        for (o = 0; o < 8; o++) {
            t->level[level - 1].full += child[o] == CELL_FULL;
        }
    }
    return CELL_NODE + (cell)l->nodes++;
}

static cell solid_cell_of(const cell *plane, const solid_level *l, size_t x, size_t y) {
    return plane && x < l->n[0] && y < l->n[1] ? plane[y * l->n[0] + x] : CELL_EMPTY;
}

/* A plane of cells of a level, or NULL for an empty one, on top of the one that waits. */
static void solid_push(solid_tree *t, int level, const cell *upper) {
    solid_level *l = &t->level[level];
    solid_level *above = &t->level[level + 1];
    size_t x;
    size_t y;
    if (level == t->depth) {
        t->root = upper[0];
        return;
    }
    if (!l->waits) {
        memcpy(l->plane, upper, l->n[0] * l->n[1] * sizeof *upper);
        l->waits = 1;
        return;
    }
    l->waits = 0;
    for (y = 0; y < above->n[1]; y++) {
        for (x = 0; x < above->n[0]; x++) {
            cell child[8];
            unsigned empty = 0;
            unsigned full = 0;
            int o;
            if (upper && 2 * x + 1 < l->n[0] && 2 * y + 1 < l->n[1]) { /* eight alike: most are */
                const cell *a = l->plane + 2 * y * l->n[0] + 2 * x;
                const cell *b = upper + 2 * y * l->n[0] + 2 * x;
                const size_t up = l->n[0];
                const cell all = a[0] | a[1] | a[up] | a[up + 1] | b[0] | b[1] | b[up] | b[up + 1];
                if (all == CELL_EMPTY || (all == CELL_FULL && (a[0] & a[1] & a[up] & a[up + 1] & b[0] & b[1] & b[up] &
                                                               b[up + 1]) == CELL_FULL)) {
                    above->next[y * above->n[0] + x] = all;
                    continue;
                }
            }
            for (o = 0; o < 8; o++) {
                child[o] = solid_cell_of(o < 4 ? l->plane : upper, l, 2 * x + (size_t)(o & 1),
                                         2 * y + (size_t)(o >> 1 & 1));
                empty += child[o] == CELL_EMPTY;
                full += child[o] == CELL_FULL;
            }
            above->next[y * above->n[0] + x] = empty == 8 ? CELL_EMPTY : full == 8 ? CELL_FULL
                                             : solid_add(t, level + 1, child, 0);
        }
    }
    solid_push(t, level + 1, above->next);
}

/* Two layers of voxels into a plane of level 1; the upper one may be NULL. */
static void solid_pair(solid_tree *t, const tribox_grid *g, const uint64_t *lower, const uint64_t *upper) {
    solid_level *l = &t->level[1];
    size_t ny = (size_t)(g->hi[1] - g->lo[1]);
    size_t row_words = ((size_t)(g->hi[0] - g->lo[0]) + 63) / 64;
    size_t x;
    size_t y;
    for (y = 0; y < l->n[1]; y++) {
        const uint64_t *row[4];
        int i;
        for (i = 0; i < 4; i++) {
            const uint64_t *layer = i < 2 ? lower : upper;
            row[i] = layer && 2 * y + (size_t)(i & 1) < ny ? layer + (2 * y + (size_t)(i & 1)) * row_words : NULL;
        }
        for (x = 0; x < l->n[0]; x++) {
            unsigned bits = 0;
            if ((x & 31) == 0 && l->n[0] - x >= 32 && row[1] && row[3]) { /* 32 cells alike: most are */
                uint64_t word = row[0][x >> 5];
                if (word + 1 <= 1 && word == row[1][x >> 5] && word == row[2][x >> 5] && word == row[3][x >> 5]) {
                    for (i = 0; i < 32; i++) {
                        l->next[y * l->n[0] + x + (size_t)i] = word ? CELL_FULL : CELL_EMPTY;
                    }
                    x += 31;
                    continue;
                }
            }
            for (i = 0; i < 4; i++) {
                bits |= row[i] ? (unsigned)(row[i][x >> 5] >> (2 * x & 63) & 3) << 2 * i : 0;
            }
            l->next[y * l->n[0] + x] = bits == 0 ? CELL_EMPTY : bits == 255 ? CELL_FULL : solid_add(t, 1, NULL, bits);
        }
    }
    solid_push(t, 1, l->next);
}

/* The tree of a mesh in a region of at most 2^depth voxels a side, depth at least 1. Returns 0 if memory is short. */
static int solid_build(solid_tree *t, const tribox_grid *g, const mesh *m, int depth) {
    tribox_grid slab = *g;
    size_t layer;
    uint64_t *bits;
    int z;
    int k;
    memset(t, 0, sizeof *t);
    t->depth = depth;
    for (k = 0; k <= depth; k++) {
        solid_level *l = &t->level[k];
        int a;
        for (a = 0; a < 3; a++) {
            l->n[a] = (((size_t)(g->hi[a] - g->lo[a]) - 1) >> k) + 1;
        }
        l->plane = k > 0 ? (cell *)malloc(l->n[0] * l->n[1] * sizeof *l->plane) : NULL;
        l->next = k > 0 ? (cell *)malloc(l->n[0] * l->n[1] * sizeof *l->next) : NULL;
        t->failed |= k > 0 && (!l->plane || !l->next);
    }
    layer = t->level[0].n[1] * ((t->level[0].n[0] + 63) / 64);
    bits = (uint64_t *)malloc(SOLID_LAYERS * layer * sizeof *bits);
    t->failed |= !bits;
    for (z = g->lo[2]; z < g->hi[2] && !t->failed; z += SOLID_LAYERS) {
        slab.lo[2] = z;
        slab.hi[2] = z + SOLID_LAYERS < g->hi[2] ? z + SOLID_LAYERS : g->hi[2];
        memset(bits, 0, SOLID_LAYERS * layer * sizeof *bits);
        mesh_fill_solid(&slab, m, bits);
        for (k = slab.lo[2]; k < slab.hi[2]; k += 2) {
            const uint64_t *lower = bits + (size_t)(k - z) * layer;
            solid_pair(t, g, lower, k + 1 < slab.hi[2] ? lower + layer : NULL);
        }
    }
    for (k = 1; k < depth && !t->failed; k++) { /* nothing follows the planes that still wait */
        if (t->level[k].waits) {
            solid_push(t, k, NULL);
        }
    }
    free(bits);
    for (k = 0; k <= depth; k++) {
        t->voxels += (double)(k == depth ? (size_t)(t->root == CELL_FULL) : t->level[k].full) * pow(8, k);
        free(t->level[k].plane);
        free(t->level[k].next);
    }
    return !t->failed;
}

static int solid_at(const solid_tree *t, size_t x, size_t y, size_t z) {
    cell c = t->root;
    int level = t->depth;
    while (c >= CELL_NODE && level > 1) {
        level -= 1;
        c = t->level[level + 1].node[c - CELL_NODE][(x >> level & 1) | (y >> level & 1) << 1 | (z >> level & 1) << 2];
    }
    return c < CELL_NODE ? c == CELL_FULL
                         : t->level[1].voxels[c - CELL_NODE] >> ((x & 1) | (y & 1) << 1 | (z & 1) << 2) & 1;
}

/* Does every voxel of the tree have the bit of the dense solid? */
static int solid_is_dense(const solid_tree *t, const tribox_grid *g, const mesh *m) {
    uint64_t *bits = (uint64_t *)calloc(tribox_grid_words(g), sizeof *bits);
    int same = bits != NULL;
    int x;
    int y;
    int z;
    if (bits) {
        mesh_fill_solid(g, m, bits);
    }
    for (z = g->lo[2]; z < g->hi[2] && same; z++) {
        for (y = g->lo[1]; y < g->hi[1]; y++) {
            for (x = g->lo[0]; x < g->hi[0]; x++) {
                same &= tribox_grid_get(g, bits, x, y, z) == solid_at(t, (size_t)(x - g->lo[0]),
                                                                      (size_t)(y - g->lo[1]), (size_t)(z - g->lo[2]));
            }
        }
    }
    free(bits);
    return same;
}

/* Builds, prints, compares where the dense solid is small. Returns the exit status. */
static int solid_octree(const mesh *m, int depth) {
    static solid_tree tree;
    double start = progress_seconds();
    tribox_grid grid;
    size_t bytes = 0;
    int k;
    if (!mesh_fit(&grid, m, 1 << depth)) {
        return program_fails("octree", "the mesh is a single point, or too large to frame");
    }
    if (!solid_build(&tree, &grid, m, depth)) {
        return program_fails("octree", "out of memory");
    }
    for (k = depth; k >= 0; k--) {
        const solid_level *l = &tree.level[k];
        bytes += l->nodes * (k == 1 ? 1 : sizeof *l->node);
        printf("level %-2d %10lu nodes, %10lu full\n", depth - k, (unsigned long)l->nodes,
               (unsigned long)(k == depth ? tree.root == CELL_FULL : l->full));
    }
    printf("%.0f voxels in %.1f MB of nodes, in %.2f s\n", tree.voxels, (double)bytes * 1e-6,
           progress_seconds() - start);
    if (depth <= 9) {
        int same = solid_is_dense(&tree, &grid, m);
        printf("%s\n", same ? "equal to the dense solid" : "NOT the dense solid");
        return same ? 0 : 1;
    }
    return 0;
}

#endif /* EXAMPLES_OCTREE_SOLID_H */
