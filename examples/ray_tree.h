/* ray_tree.h - an octree of a mesh's triangles, for rays
 *
 * tribox_tri_octants says which of a node's children a triangle touches, tribox_ray_box which of them a ray enters,
 * tribox_ray_triangle what it hits. All three are exact, so no ray slips between two triangles or two nodes.
 */
#ifndef EXAMPLES_RAY_TREE_H
#define EXAMPLES_RAY_TREE_H
#include "mesh_exact.h"

enum { RAY_LEAF = 8, RAY_DEEPEST = 9 };

typedef struct ray_node {
    struct ray_node *child[8];
    double           lo[3];
    double           hi[3];
    uint32_t        *list;  /* a leaf's triangles */
    size_t           count;
} ray_node;

typedef struct ray_tree {
    const mesh *m;
    double      base[3];    /* where rays have their origin; not 0 only where the mesh is of doubles */
    double     *normals;    /* of the vertices, as long as the triangles around are large */
    ray_node   *root;
    size_t      nodes;
    size_t      places;     /* of triangles in leaves */
    int         failed;     /* memory was short */
} ray_tree;

/* A node of the octree with the triangles of `list`, which it touches. Sizes are powers of two, and lo is a multiple
   of the smallest one: corners are exact. */
static inline ray_node *ray_tree_grow(ray_tree *s, const uint32_t *list, size_t count, const double lo[3], double size,
                                      int depth) {
    ray_node *n = (ray_node *)calloc(1, sizeof *n);
    uint32_t *part = (uint32_t *)malloc((count + 1) * sizeof *part);
    unsigned char *octants = (unsigned char *)malloc(count + 1);
    double corner[3];
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
        octants[i] = (unsigned char)mesh_octants(s->m, list[i], lo, size / 2);
    }
    for (o = 0; o < 8; o++) {
        size_t held = 0;
        for (i = 0; i < count; i++) {
            part[held] = list[i];
            held += octants[i] >> o & 1;
        }
        for (a = 0; a < 3; a++) {
            corner[a] = lo[a] + (o >> a & 1) * (size / 2);
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
static inline size_t ray_tree_descend(const ray_tree *s, const ray_node *n, const double o[3], const double d[3], double *t,
                                      size_t best) {
    const int first = (d[0] < 0) | (d[1] < 0) << 1 | (d[2] < 0) << 2;
    double at;
    size_t j;
    int i;
    for (j = 0; j < n->count; j++) {
        if (mesh_ray_triangle(s->m, n->list[j], o, d, *t, &at) && at < *t) {
            *t = at;
            best = n->list[j];
        }
    }
    for (i = 0; i < 8; i++) {
        const ray_node *child = n->child[i ^ first];
        if (child && mesh_ray_box(s->m, o, d, *t, child->lo, child->hi)) {
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
static inline void ray_flat_normal(double v[3][3], double out[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        out[a] = (v[1][b] - v[0][b]) * (v[2][c] - v[0][c]) - (v[1][c] - v[0][c]) * (v[2][b] - v[0][b]);
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

static inline size_t ray_tree_vertex(const mesh *m, size_t triangle, size_t corner) {
    return m->indices ? m->indices[3 * triangle + corner] : 3 * triangle + corner;
}

/* The tree of tree->m, in the least cube of a power of two that holds the frame, a grid of one voxel around it. Returns
   0 if memory is short. */
static inline int ray_tree_build(ray_tree *tree, const tribox_grid *frame) {
    const mesh *m = tree->m;
    uint32_t *all = (uint32_t *)malloc((m->triangles + 1) * sizeof *all);
    double size = exp2(ceil(log2(frame->size[0])));
    double lo[3];
    size_t i;
    int a;
    for (a = 0; a < 3; a++) {
        const double unit = size / (1 << RAY_DEEPEST);
        lo[a] = floor(frame->origin[a] / unit) * unit;
        if (lo[a] + size < frame->origin[a] + frame->size[0]) {
            size *= 2;
            a = -1;
        }
    }
    tree->normals = (double *)calloc(3 * m->vertices + 3, sizeof *tree->normals);
    tree->root = NULL;
    tree->nodes = tree->places = 0;
    tree->failed = !all || !tree->normals;
    for (i = 0; i < m->triangles && !tree->failed; i++) {
        double v[3][3];
        double flat[3];
        all[i] = (uint32_t)i;
        mesh_triangle_f64(m, i, v);
        ray_flat_normal(v, flat);
        for (a = 0; a < 9; a++) {
            tree->normals[3 * ray_tree_vertex(m, i, (size_t)a / 3) + (size_t)a % 3] += flat[a % 3];
        }
    }
    if (!tree->failed) {
        tree->root = ray_tree_grow(tree, all, m->triangles, lo, size, 0);
    }
    free(all);
    return !tree->failed;
}

/* The nearest triangle within t: its number, and where; the mesh's count if there is none. The ray is given from
   the base on. */
static inline size_t ray_tree_pick(const ray_tree *tree, const float o[3], const float d[3], float *t) {
    double from[3];
    double along[3];
    double at = (double)*t;
    size_t best;
    int a;
    for (a = 0; a < 3; a++) {
        from[a] = tree->base[a] + (double)o[a];
        along[a] = (double)d[a];
    }
    best = ray_tree_descend(tree, tree->root, from, along, &at, tree->m->triangles);
    *t = best < tree->m->triangles ? (float)at : *t;
    return best;
}

/* The unit normal at a point of a triangle: the vertices' by its weights, or the triangle's own, at a sharp edge. */
static inline void ray_tree_normal(const ray_tree *tree, size_t triangle, const float point[3], double out[3]) {
    double v[3][3];
    double there[3];
    double weights[3];
    double flat[3];
    int a;
    for (a = 0; a < 3; a++) {
        there[a] = tree->base[a] + (double)point[a];
    }
    mesh_closest(tree->m, triangle, there, weights);
    mesh_triangle_f64(tree->m, triangle, v);
    ray_flat_normal(v, flat);
    out[0] = out[1] = out[2] = 0;
    for (a = 0; a < 9; a++) {
        out[a % 3] += weights[a / 3] * tree->normals[3 * ray_tree_vertex(tree->m, triangle, (size_t)a / 3) + (size_t)a % 3];
    }
    ray_unit(flat);
    ray_unit(out);
    if (fabs(ray_dot(flat, out)) < 0.7) {
        memcpy(out, flat, sizeof flat);
    }
}

#endif /* EXAMPLES_RAY_TREE_H */
