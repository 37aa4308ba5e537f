/* kdtree - a kd-tree whose splits see only what lies in a node
 *
 *   build/kdtree [mesh] [triangles a leaf]       default: the teapot, 8
 *
 * A node keeps, for each of its triangles, the bounds of the part inside the node: tribox_clip's polygon. Its
 * own bounds shrink to their union before it is split in the middle of the longest side, and a triangle goes
 * only to the sides that its part reaches. With whole bounding boxes instead, triangles land in nodes that
 * they never touch. Prints both:
 *
 *   clipped         32924 leaves   210145 references, 5.73 a triangle, surface of the leaves 220.7
 *   whole boxes    139001 leaves  1367603 references, 37.29 a triangle, surface of the leaves 406.4
 */
#include "program.h"

enum { MOST_DEPTH = 24 };

/* Its corners are floats where the mesh's are. */
typedef struct box {
    double lo[3];
    double hi[3];
} box;

typedef struct builder {
    const mesh *mesh;
    int         clips;
    size_t      leaf_size;
    size_t      leaves;
    size_t      references;
    double      surface;
    int         failed;
} builder;

static const box nothing = {{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}};

static void grow(box *b, const double x[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        b->lo[a] = x[a] < b->lo[a] ? x[a] : b->lo[a];
        b->hi[a] = x[a] > b->hi[a] ? x[a] : b->hi[a];
    }
}

/* The corners of triangle t's part in a node: exact, or where the mesh is of floats, floats. */
static int clip(const builder *k, uint32_t t, const box *node, double out[9][3]) {
    const tribox_mesh view = mesh_view(k->mesh);
    const float *v[3];
    double exact[3][3];
    float polygon[9][3];
    float lo[3];
    float hi[3];
    int corners;
    int a;
    if (k->mesh->exact) {
        for (a = 0; a < 3; a++) {
            mesh_corner_f64(k->mesh, t, (size_t)a, exact[a]);
        }
        return tribox_clip_f64(exact[0], exact[1], exact[2], node->lo, node->hi, out);
    }
    for (a = 0; a < 3; a++) {
        lo[a] = node->lo[a] < -(double)FLT_MAX ? -FLT_MAX : (float)node->lo[a];
        hi[a] = node->hi[a] > (double)FLT_MAX ? FLT_MAX : (float)node->hi[a];
    }
    mesh_corners(&view, t, v);
    corners = tribox_clip(v[0], v[1], v[2], lo, hi, polygon);
    for (a = 0; a < 3 * corners; a++) {
        out[a / 3][a % 3] = (double)polygon[a / 3][a % 3];
    }
    return corners;
}

/* The bounds of triangle t's part in a node; returns 0 if there is none. */
static int part_of(const builder *k, uint32_t t, const box *node, box *out_part) {
    double polygon[9][3];
    int corners = 3;
    int a;
    *out_part = nothing;
    if (k->clips) {
        corners = clip(k, t, node, polygon);
    } else {
        for (a = 0; a < 3; a++) {
            mesh_corner_f64(k->mesh, t, (size_t)a, polygon[a]);
        }
    }
    for (a = 0; a < corners; a++) {
        grow(out_part, polygon[a]);
    }
    for (a = 0; a < 3 && !k->clips; a++) {
        out_part->lo[a] = out_part->lo[a] > node->lo[a] ? out_part->lo[a] : node->lo[a];
        out_part->hi[a] = out_part->hi[a] < node->hi[a] ? out_part->hi[a] : node->hi[a];
        corners = out_part->lo[a] > out_part->hi[a] ? 0 : corners;
    }
    return corners > 0;
}

static int longest_side(const box *b) {
    const double x = b->hi[0] - b->lo[0];
    const double y = b->hi[1] - b->lo[1];
    const double z = b->hi[2] - b->lo[2];
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

static void split(builder *k, const box *node, const uint32_t *candidates, size_t candidate_count,
                  int depth) {
    uint32_t *inside = (uint32_t *)malloc((candidate_count + 1) * sizeof *inside);
    box bounds = nothing;
    size_t count = 0;
    size_t i;
    for (i = 0; i < candidate_count && inside; i++) {
        box part;
        if (part_of(k, candidates[i], node, &part)) {
            inside[count++] = candidates[i];
            grow(&bounds, part.lo);
            grow(&bounds, part.hi);
        }
    }
    k->failed |= inside == NULL;
    if (count > k->leaf_size && depth < MOST_DEPTH && !k->failed) {
        const int a = longest_side(&bounds);
        box half = bounds;
        half.hi[a] = (bounds.lo[a] + bounds.hi[a]) * 0.5;
        half.hi[a] = k->mesh->exact ? half.hi[a] : (double)(float)half.hi[a];
        split(k, &half, inside, count, depth + 1);
        half.lo[a] = half.hi[a];        /* closed on both sides: what lies in the plane goes to both */
        half.hi[a] = bounds.hi[a];
        split(k, &half, inside, count, depth + 1);
    } else if (count > 0) {
        const double x = bounds.hi[0] - bounds.lo[0];
        const double y = bounds.hi[1] - bounds.lo[1];
        const double z = bounds.hi[2] - bounds.lo[2];
        k->leaves += 1;
        k->references += count;
        k->surface += 2 * (x * y + y * z + z * x);
    }
    free(inside);
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: kdtree [mesh] [triangles a leaf, from 1 to 10000]";
    int asked;
    int leaf_size = 8;
    uint32_t *all;
    size_t t;
    mesh m;
    int clips;
    if ((asked = program_arguments("kdtree", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 3 || (argc > 2 && !program_int(argv[2], 1, 10000, &leaf_size)) ||
        !program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("kdtree", error);
    }
    mesh_say_exact(&m);
    all = (uint32_t *)malloc((m.triangles + 1) * sizeof *all);
    if (!all) {
        return program_fails("kdtree", "out of memory");
    }
    for (t = 0; t < m.triangles; t++) {
        all[t] = (uint32_t)t;
    }
    for (clips = 1; clips >= 0; clips--) {
        const box everything = {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}};
        builder k = {NULL, 0, 0, 0, 0, 0, 0};
        k.mesh = &m;
        k.clips = clips;
        k.leaf_size = (size_t)leaf_size;
        split(&k, &everything, all, m.triangles, 0);
        if (k.failed) {
            return program_fails("kdtree", "out of memory");
        }
        printf("%-12s %8lu leaves %8lu references, %.2f a triangle, surface of the leaves %.1f\n",
               clips ? "clipped" : "whole boxes", (unsigned long)k.leaves, (unsigned long)k.references,
               (double)k.references / (double)m.triangles, k.surface);
    }
    free(all);
    mesh_free(&m);
    return 0;
}
