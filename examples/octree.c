/* octree - a sparse voxel octree built by descent, without a dense grid
 *
 *   build/octree [mesh] [depth] [file]       default: the teapot, 9 levels, saved to nothing
 *
 * Each triangle goes down the tree on its own: tribox_tri_octants says which of a node's eight children it
 * touches, tribox_tri_resize halves the boxes for the next level. The leaves are those voxels that
 * tribox_grid_fill sets. The file is a line of text, then one byte a node, level by level: its children.
 * Prints:
 *
 *   level 1           4 nodes
 *   ...
 *   level 9      477813 nodes: the leaves, 0.36 % of a dense grid
 *   saved as 159542 bytes, in ... s
 *
 *   build/octree --solid [mesh] [depth]
 *
 * The tree of the solid (octree_solid.h): full cells of any size within, nodes only along the border. Its levels,
 * and up to 9 of them whether it equals the dense solid. The dragon at 4096 a side, 12 levels: 177 MB.
 */
#include "program.h"
#include "octree_solid.h"

enum { MOST_LEVELS = 16 };

typedef struct node {
    uint32_t child[8];      /* index into nodes; 0: none. On the last level, 1: a leaf */
} node;

typedef struct octree {
    int        depth;
    double     origin[3];
    double     size[MOST_LEVELS + 1];   /* of a node, by level; the root is level 0 */
    tribox_tri tri[MOST_LEVELS];        /* the triangle at hand, prepared for the children of each level */
    node      *nodes;
    size_t     count;
    size_t     room;
} octree;

/* A new node's index; 0 if memory is short (the root is never asked for). */
static uint32_t add_node(octree *tree) {
    if (tree->count == tree->room) {
        size_t room = 2 * tree->room + 1024;
        node *nodes = room < 0xffffffffu ? (node *)realloc(tree->nodes, room * sizeof *nodes) : NULL;
        if (!nodes) {
            return 0;
        }
        tree->nodes = nodes;
        tree->room = room;
    }
    memset(&tree->nodes[tree->count], 0, sizeof(node));
    return (uint32_t)tree->count++;
}

/* The corners are sums of a few sizes, each half of the last: exact in double. */
static int descend(octree *tree, uint32_t at, int level, const double p[3]) {
    unsigned octants = tribox_tri_octants_f64(&tree->tri[level], p);
    int o;
    for (o = 0; o < 8; o++) {
        double corner[3];
        int a;
        if (!(octants >> o & 1u)) {
            continue;
        }
        if (level == tree->depth - 1) {
            tree->nodes[at].child[o] = 1;
            continue;
        }
        if (tree->nodes[at].child[o] == 0) {
            uint32_t child = add_node(tree);
            if (child == 0) {
                return 0;
            }
            tree->nodes[at].child[o] = child;
        }
        for (a = 0; a < 3; a++) {
            corner[a] = p[a] + (o >> a & 1 ? tree->size[level + 1] : 0);
        }
        if (!descend(tree, tree->nodes[at].child[o], level + 1, corner)) {
            return 0;
        }
    }
    return 1;
}

/* Triangle t of the mesh into the tree. */
static int insert(octree *tree, const mesh *m, size_t t) {
    const tribox_mesh view = mesh_view(m);
    const float *v[3];
    double exact[3][3];
    int level;
    int i;
    mesh_corners(&view, t, v);
    for (i = 0; m->exact && i < 3; i++) {
        mesh_corner_f64(m, t, (size_t)i, exact[i]);
    }
    for (level = 0; level < tree->depth; level++) {
        const double half = tree->size[level + 1];
        const double size[3] = {half, half, half};
        const float root[3] = {1, 1, 1};
        if (level == 0 && m->exact) {
            tribox_tri_init_f64(&tree->tri[0], exact[0], exact[1], exact[2], size, 0);
        } else if (level == 0) {
            tribox_tri_init(&tree->tri[0], v[0], v[1], v[2], root, 0);
        } else {
            tree->tri[level] = tree->tri[level - 1];
        }
        tribox_tri_resize_f64(&tree->tri[level], size);
    }
    return descend(tree, 0, 0, tree->origin);
}

static unsigned child_byte(const node *n) {
    unsigned byte = 0;
    int o;
    for (o = 0; o < 8; o++) {
        byte |= (unsigned)(n->child[o] != 0) << o;
    }
    return byte;
}

/* Visits level by level: counts, prints, and writes one byte a node if there is a file. */
static int save(const octree *tree, FILE *file) {
    uint32_t *row = (uint32_t *)calloc(1, sizeof *row);
    size_t count = 1;
    int level;
    if (file) {
        fprintf(file, "octree %d %.17g %.17g %.17g %.17g\n", tree->depth, tree->origin[0], tree->origin[1],
                tree->origin[2], tree->size[0]);
    }
    for (level = 1; level <= tree->depth && row; level++) {
        uint32_t *next = (uint32_t *)malloc(8 * count * sizeof *next);
        size_t below = 0;
        size_t i;
        int o;
        for (i = 0; i < count && next; i++) {
            const node *n = &tree->nodes[row[i]];
            for (o = 0; o < 8; o++) {
                if (n->child[o]) {
                    next[below++] = n->child[o];
                }
            }
            if (file) {
                putc((int)child_byte(n), file);
            }
        }
        free(row);
        row = next;
        count = below;
        printf("level %-2d %10lu nodes", level, (unsigned long)count);
        printf(level < tree->depth ? "\n" : ": the leaves, %.2f %% of a dense grid\n",
               100.0 * (double)count / pow(8, level));
    }
    free(row);
    return row != NULL;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: octree [--solid] [mesh] [depth from 1 to 16] [file]";
    int solid = 0;
    int asked;
    double start = progress_seconds();
    static octree tree;
    tribox_grid grid;
    mesh m;
    size_t t;
    FILE *file;
    int a;
    tree.depth = 9;
    if (argc > 1 && strcmp(argv[1], "--solid") == 0) {
        solid = 1;
        argc -= 1;
        argv += 1;
    }
    if ((asked = program_arguments("octree", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 4 || (argc > 2 && !program_int(argv[2], 1, MOST_LEVELS, &tree.depth)) ||
        !program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("octree", error);
    }
    mesh_say_exact(&m);
    if (solid) {
        asked = solid_octree(&m, tree.depth);
        mesh_free(&m);
        return asked;
    }
    if (!mesh_fit(&grid, &m, 1 << tree.depth) || (add_node(&tree), tree.count == 0)) {
        return program_fails("octree", "the mesh is a single point, or too large to frame");
    }
    for (a = 0; a < 3; a++) {
        tree.origin[a] = grid.origin[a];
    }
    tree.size[tree.depth] = grid.size[0];
    for (a = tree.depth; a > 0; a--) {
        tree.size[a - 1] = 2 * tree.size[a];
    }
    for (t = 0; t < m.triangles; t++) {
        if (!insert(&tree, &m, t)) {
            return program_fails("octree", "out of memory");
        }
    }
    file = argc > 3 ? fopen(argv[3], "wb") : NULL;
    if ((argc > 3 && !file) || !save(&tree, file)) {
        return program_fails("octree", "cannot write the file, or out of memory");
    }
    printf("saved as %lu bytes, in %.2f s\n", (unsigned long)tree.count, progress_seconds() - start);
    if (file && fclose(file) != 0) {
        return program_fails("octree", "cannot write the file");
    }
    free(tree.nodes);
    mesh_free(&m);
    return 0;
}
