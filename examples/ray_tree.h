/* ray_tree.h - an octree of a mesh's triangles, for rays
 *
 * tribox_tri_octants says which of a node's children a triangle touches, tribox_ray_box which of them a ray enters,
 * tribox_ray_triangle what it hits. All three are exact, so no ray slips between two triangles or two nodes.
 */
#ifndef EXAMPLES_RAY_TREE_H
#define EXAMPLES_RAY_TREE_H
#include "mesh_io.h"

enum { RAY_LEAF = 8, RAY_DEEPEST = 9 };

typedef struct ray_node {
    struct ray_node *child[8];
    float            lo[3];
    float            hi[3];
    uint32_t        *list;  /* a leaf's triangles */
    size_t           count;
} ray_node;

typedef struct ray_tree {
    tribox_mesh mesh;
    double     *normals;    /* of the vertices, as long as the triangles around are large */
    ray_node   *root;
    size_t      nodes;
    size_t      places;     /* of triangles in leaves */
    int         failed;     /* memory was short */
} ray_tree;

/* A node of the octree with the triangles of `list`, which it touches. Sizes are powers of two: corners are exact. */
static inline ray_node *ray_tree_grow(ray_tree *s, const uint32_t *list, size_t count, const float lo[3], float size, int depth) {
    const float halves[3] = {size / 2, size / 2, size / 2};
    ray_node *n = (ray_node *)calloc(1, sizeof *n);
    uint32_t *part = (uint32_t *)malloc((count + 1) * sizeof *part);
    unsigned char *octants = (unsigned char *)malloc(count + 1);
    float corner[3];
    size_t i;
    int o;
    int a;
    if (!n || !part || !octants) {
        free(n);
        free(part);
        free(octants);
        s->failed = 1;
        return NULL;
    }
    s->nodes++;
    for (a = 0; a < 3; a++) {
        n->lo[a] = lo[a];
        n->hi[a] = lo[a] + size;
    }
    if (count <= RAY_LEAF || depth == RAY_DEEPEST) {
        n->list = (uint32_t *)memcpy(part, list, count * sizeof *part);
        n->count = count;
        s->places += count;
        free(octants);
        return n;
    }
    for (i = 0; i < count; i++) {
        const float *v[3];
        tribox_tri tri;
        mesh_corners(&s->mesh, list[i], v);
        tribox_tri_init(&tri, v[0], v[1], v[2], halves, 0);
        octants[i] = (unsigned char)tribox_tri_octants(&tri, lo);
    }
    for (o = 0; o < 8; o++) {
        size_t held = 0;
        for (i = 0; i < count; i++) {
            part[held] = list[i];
            held += octants[i] >> o & 1;
        }
        for (a = 0; a < 3; a++) {
            corner[a] = lo[a] + (float)(o >> a & 1) * halves[a];
        }
        n->child[o] = held ? ray_tree_grow(s, part, held, corner, size / 2, depth + 1) : NULL;
        if (held && !n->child[o]) {
            o = 8;      /* memory is short */
            s->failed = 1;
        }
    }
    free(part);
    free(octants);
    return n;
}

/* The nearest triangle along the ray that is nearer than *t: its number, or `best`. Children from front to back. */
static inline size_t ray_tree_descend(const ray_tree *s, const ray_node *n, const float o[3], const float d[3], float *t, size_t best) {
    const int first = (d[0] < 0) | (d[1] < 0) << 1 | (d[2] < 0) << 2;
    float at;
    size_t j;
    int i;
    for (j = 0; j < n->count; j++) {
        const float *v[3];
        mesh_corners(&s->mesh, n->list[j], v);
        if (tribox_ray_triangle(o, d, 0, *t, v[0], v[1], v[2], &at) && at < *t) {
            *t = at;
            best = n->list[j];
        }
    }
    for (i = 0; i < 8; i++) {
        const ray_node *child = n->child[i ^ first];
        if (child && tribox_ray_box(o, d, 0, *t, child->lo, child->hi, NULL, NULL)) {
            best = ray_tree_descend(s, child, o, d, t, best);
        }
    }
    return best;
}

static inline double ray_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void ray_unit(double x[3]) {
    const double length = sqrt(ray_dot(x, x));
    int a;
    for (a = 0; a < 3; a++) {
        x[a] /= length > 0 ? length : 1;
    }
}

/* The triangle's normal, as long as twice its area. */
static inline void ray_flat_normal(const float *const v[3], double out[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        out[a] = (double)(v[1][b] - v[0][b]) * (double)(v[2][c] - v[0][c]) -
                 (double)(v[1][c] - v[0][c]) * (double)(v[2][b] - v[0][b]);
    }
}

static inline void ray_tree_free_node(ray_node *n) {
    int o;
    for (o = 0; n && o < 8; o++) {
        ray_tree_free_node(n->child[o]);
    }
    if (n) {
        free(n->list);
        free(n);
    }
}

static inline void ray_tree_free(ray_tree *tree) {
    ray_tree_free_node(tree->root);
    free(tree->normals);
}

/* The tree of tree->mesh, in a cube of which lo is the least corner. Returns 0 if memory is short. */
static inline int ray_tree_build(ray_tree *tree, size_t vertices, const float lo[3], float size) {
    uint32_t *all = (uint32_t *)malloc((tree->mesh.triangles + 1) * sizeof *all);
    size_t i;
    int a;
    tree->normals = (double *)calloc(3 * vertices + 3, sizeof *tree->normals);
    tree->root = NULL;
    tree->nodes = tree->places = 0;
    tree->failed = !all || !tree->normals;
    for (i = 0; i < tree->mesh.triangles && !tree->failed; i++) {
        const float *v[3];
        double flat[3];
        all[i] = (uint32_t)i;
        mesh_corners(&tree->mesh, i, v);
        ray_flat_normal(v, flat);
        for (a = 0; a < 9; a++) {
            tree->normals[(v[a / 3] - tree->mesh.positions) + a % 3] += flat[a % 3];
        }
    }
    if (!tree->failed) {
        tree->root = ray_tree_grow(tree, all, tree->mesh.triangles, lo, size, 0);
    }
    free(all);
    return !tree->failed;
}

/* The nearest triangle within t: its number, and where; the mesh's count if there is none. */
static inline size_t ray_tree_pick(const ray_tree *tree, const float o[3], const float d[3], float *t) {
    return ray_tree_descend(tree, tree->root, o, d, t, tree->mesh.triangles);
}

/* The unit normal at a point of a triangle: the vertices' by its weights, or the triangle's own, at a sharp edge. */
static inline void ray_tree_normal(const ray_tree *tree, size_t triangle, const float point[3], double out[3]) {
    const float *v[3];
    float weights[3];
    double flat[3];
    int a;
    mesh_corners(&tree->mesh, triangle, v);
    tribox_closest(v[0], v[1], v[2], point, weights);
    ray_flat_normal(v, flat);
    out[0] = out[1] = out[2] = 0;
    for (a = 0; a < 9; a++) {
        out[a % 3] += (double)weights[a / 3] * tree->normals[(v[a / 3] - tree->mesh.positions) + a % 3];
    }
    ray_unit(flat);
    ray_unit(out);
    if (fabs(ray_dot(flat, out)) < 0.7) {
        memcpy(out, flat, sizeof flat);
    }
}

#endif /* EXAMPLES_RAY_TREE_H */
