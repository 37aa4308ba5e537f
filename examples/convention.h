/* convention.h - what a voxelizer's set means: where its voxel i lies, and when it is set
 *
 * Voxelizers differ in three things. Where: the file's origin is a corner of the first voxel, or the place of
 * the first sample, the voxel's middle. What: a voxel is set where its box touches the mesh, where its sample
 * lies inside, or where the nearest point of some triangle lies in the box. Which faces: what of the border
 * counts. A `convention` names the three; convention_set computes exactly the voxels that it sets.
 */
#ifndef EXAMPLES_CONVENTION_H
#define EXAMPLES_CONVENTION_H
#include "mesh_stats.h"
#include "solid.h"

enum { CONVENTION_TOUCHED, CONVENTION_FILLED, CONVENTION_SAMPLES, CONVENTION_NEAREST, CONVENTION_VERTICES };

/* Of the samples that lie on a face across an axis: those on a solid's lower face are in it, on its upper
   face, both, none. */
enum { FACE_LOWER, FACE_UPPER, FACE_BOTH, FACE_NONE };

typedef struct convention {
    const char *name;       /* of --like; NULL: no program's */
    const char *program;
    int         shift;      /* in half voxels: voxel i begins at origin + (i + shift/2) * size */
    int         kind;
    unsigned    flags;      /* tribox's, of the boxes */
    int         mirrored;   /* the boxes are (min, max] instead of [min, max) */
    int         face[3];    /* of CONVENTION_SAMPLES */
    int         below;      /* set is what is below 0: a distance with a sign */
    double      level;      /* set is what is above it */
} convention;

#define FACES(x, y, z) {FACE_##x, FACE_##y, FACE_##z}

/* Measured: tests/peers/README.md has versions and meshes. */
static const convention conventions[] = {
    {"ours", "tribox.h's voxelize", 0, CONVENTION_TOUCHED, 0, 0,
     FACES(LOWER, LOWER, LOWER), 0, 0},
    {"ours-solid", "tribox.h's voxelize --solid", 0, CONVENTION_SAMPLES, 0, 0,
     FACES(LOWER, LOWER, LOWER), 0, 0},
    {"open3d-0.16", "Open3D 0.16 VoxelGrid of a mesh", -1, CONVENTION_TOUCHED, 0, 0,
     FACES(LOWER, LOWER, LOWER), 0, 0},
    {"vtk-modeller", "VTK 9.1 vtkVoxelModeller", -1, CONVENTION_NEAREST, 0, 0,
     FACES(LOWER, LOWER, LOWER), 0, 0},
    {"vtk-stencil", "VTK 9.1 vtkPolyDataToImageStencil", -1, CONVENTION_SAMPLES, 0, 0,
     FACES(BOTH, BOTH, LOWER), 0, 0},
    {"vtk-stencil-0", "the same with tolerance 0", -1, CONVENTION_SAMPLES, 0, 0,
     FACES(UPPER, UPPER, LOWER), 0, 0},
    {"itk", "ITK 5.2 TriangleMeshToBinaryImageFilter", -1, CONVENTION_SAMPLES, 0, 0,
     FACES(BOTH, LOWER, LOWER), 0, 0},
    {"openvdb", "OpenVDB 10.0 meshToLevelSet", -1, CONVENTION_SAMPLES, 0, 0,
     FACES(BOTH, BOTH, BOTH), 1, 0},
    {"mrtrix", "MRtrix 3.0 mesh2voxel, shares of volume above 1/2", -1, CONVENTION_SAMPLES, 0, 0,
     FACES(NONE, NONE, NONE), 0, 0.5},
    {"binvox", "a binvox file of surface voxels", 0, CONVENTION_TOUCHED, 0, 0,
     FACES(LOWER, LOWER, LOWER), 0, 0},
    {"pcl", "PCL's and OctoMap's voxels of points", 0, CONVENTION_VERTICES, TRIBOX_HALF_OPEN, 0,
     FACES(LOWER, LOWER, LOWER), 0, 0},
};

enum { CONVENTION_COUNT = (int)(sizeof conventions / sizeof *conventions) };

static inline const convention *convention_named(const char *name) {
    int i;
    for (i = 0; i < CONVENTION_COUNT; i++) {
        if (strcmp(conventions[i].name, name) == 0) {
            return &conventions[i];
        }
    }
    return NULL;
}

static inline int convention_same(const convention *a, const convention *b) {
    return a->shift == b->shift && a->kind == b->kind && a->flags == b->flags && a->mirrored == b->mirrored
           && (a->kind != CONVENTION_SAMPLES || memcmp(a->face, b->face, sizeof a->face) == 0);
}

/* One sentence of what it means. */
static inline const char *convention_says(const convention *c, char out[160]) {
    static const char *const sides[] = {"lower", "upper", "both", "none"};
    const char *box = c->shift < 0 ? "[i-1/2, i+1/2]" : c->shift > 0 ? "[i+1/2, i+3/2]" : "[i, i+1]";
    const char *rule = c->flags & TRIBOX_THIN        ? "thin"
                       : c->flags & TRIBOX_OPEN      ? "open"
                       : c->mirrored                 ? "upper half-open"
                       : c->flags & TRIBOX_HALF_OPEN ? "half-open"
                                                     : "closed";
    switch (c->kind) {
    case CONVENTION_SAMPLES:
        snprintf(out, 160, "samples at %s inside, faces: x %s, y %s, z %s",
                 c->shift < 0   ? "i"
                 : c->shift > 0 ? "i+1"
                                : "i+1/2",
                 sides[c->face[0]], sides[c->face[1]], sides[c->face[2]]);
        break;
    case CONVENTION_NEAREST:
        snprintf(out, 160, "boxes %s that hold the nearest point of a triangle", box);
        break;
    case CONVENTION_VERTICES: snprintf(out, 160, "boxes %s that hold a vertex, %s", box, rule); break;
    case CONVENTION_FILLED:
        snprintf(out, 160, "boxes %s touched, %s, and the inside filled", box, rule);
        break;
    default: snprintf(out, 160, "boxes %s touched, %s", box, rule); break;
    }
    return out;
}

/* ---- 1. The mesh in doubles, mirrored, or as points ---------------------------------------------- */

/* Axis a is mirrored where bit a is set. Returns 1; view->positions is to be freed. */
static inline int mesh_doubles(const mesh *m, int mirror, tribox_mesh_f64 *view) {
    double *positions = (double *)malloc((3 * m->vertices + 1) * sizeof *positions);
    size_t i;
    memset(view, 0, sizeof *view);
    for (i = 0; positions && i < 3 * m->vertices; i++) {
        double x = m->exact ? m->exact[i] : (double)m->positions[i];
        positions[i] = mirror >> i % 3 & 1 ? -x : x;
    }
    view->positions = positions;
    view->indices = m->indices;
    view->triangles = m->triangles;
    return positions != NULL;
}

static inline void mesh_doubles_free(tribox_mesh_f64 *view) {
    free((double *)(uintptr_t)view->positions);
    view->positions = NULL;
}

/* The vertices, each as a triangle that is a point. */
static inline int mesh_points(mesh *out, const mesh *m) {
    size_t i;
    memset(out, 0, sizeof *out);
    out->positions = (float *)malloc((3 * m->vertices + 1) * sizeof(float));
    out->exact = m->exact ? (double *)malloc((3 * m->vertices + 1) * sizeof(double)) : NULL;
    out->indices = (uint32_t *)malloc((3 * m->vertices + 1) * sizeof(uint32_t));
    if (!out->positions || !out->indices || (m->exact && !out->exact)) {
        mesh_free(out);
        return 0;
    }
    memcpy(out->positions, m->positions, 3 * m->vertices * sizeof(float));
    if (m->exact) {
        memcpy(out->exact, m->exact, 3 * m->vertices * sizeof(double));
    }
    for (i = 0; i < 3 * m->vertices; i++) {
        out->indices[i] = (uint32_t)(i / 3);
    }
    out->vertices = m->vertices;
    out->triangles = m->vertices;
    return 1;
}

/* ---- 2. The sets ------------------------------------------------------------------------------------ */

/* The grid whose voxels are the file's, moved by half voxels. */
static inline tribox_grid convention_grid(const tribox_grid *file, int shift) {
    tribox_grid grid = *file;
    int a;
    for (a = 0; a < 3; a++) {
        grid.origin[a] += 0.5 * shift * grid.size[a];
    }
    return grid;
}

/* Was the origin rounded by that? */
static inline int convention_rounds(const tribox_grid *file, int shift) {
    tribox_grid grid = convention_grid(file, shift);
    int a;
    for (a = 0; a < 3; a++) {
        volatile double step = 0.5 * shift * grid.size[a];
        volatile double back = grid.origin[a] - file->origin[a];
        volatile double rest = grid.origin[a] - back;
        if (back < step || back > step || rest < file->origin[a] || rest > file->origin[a]) {
            return 1;
        }
    }
    return 0;
}

/* Copies voxels that were computed on a mirrored grid. */
static inline void voxels_mirror(const voxels *from, int mirror, voxels *to) {
    size_t at[3];
    size_t there[3];
    size_t word;
    int a;
    for (at[2] = 0; at[2] < from->n[2]; at[2]++) {
        for (at[1] = 0; at[1] < from->n[1]; at[1]++) {
            const uint64_t *row = voxels_row(from, at[1], at[2]);
            for (word = 0; word < from->row_words; word++) {
                uint64_t rest = row[word];
                for (; rest; rest &= rest - 1) {
                    at[0] = 64 * word + voxels_lowest(rest);
                    for (a = 0; a < 3; a++) {
                        there[a] = mirror >> a & 1 ? from->n[a] - 1 - at[a] : at[a];
                    }
                    voxels_row(to, there[1], there[2])[there[0] >> 6] |= (uint64_t)1 << (there[0] & 63);
                }
            }
        }
    }
}

/* The touched boxes, or the solid's samples, of space seen in a mirror: [min, max) is (min, max] there, and a
   sample on a lower face lies on an upper one. The mirror negates numbers, so nothing is rounded. `out` is
   cleared before. */
static inline int convention_mirrored(const mesh *m, int inside, int mirror, voxels *out, char *error) {
    tribox_mesh_f64 view;
    tribox_grid grid = out->grid;
    voxels work;
    int a;
    for (a = 0; a < 3; a++) {
        if (mirror >> a & 1) {
            grid.origin[a] = -grid.origin[a];
            grid.lo[a] = -out->grid.hi[a];
            grid.hi[a] = -out->grid.lo[a];
        }
    }
    if (!mesh_doubles(m, mirror, &view)) {
        snprintf(error, MESH_ERROR, "out of memory");
        return 0;
    }
    if (!voxels_make(&work, &grid, error)) {
        mesh_doubles_free(&view);
        return 0;
    }
    if (inside) {
        tribox_grid_fill_solid_f64(&grid, &view, work.bits);
    } else {
        tribox_grid_fill_f64(&grid, &view, work.bits);
    }
    memset(out->bits, 0, out->words * sizeof *out->bits);
    voxels_mirror(&work, mirror, out);
    voxels_free(&work);
    mesh_doubles_free(&view);
    return 1;
}

static inline int convention_plain(const mesh *m, int inside, voxels *out, char *error) {
    tribox_mesh view = mesh_view(m);
    memset(out->bits, 0, out->words * sizeof *out->bits);
    if (m->exact) {
        return convention_mirrored(m, inside, 0, out, error);
    }
    if (inside) {
        tribox_grid_fill_solid(&out->grid, &view, out->bits);
    } else {
        tribox_grid_fill(&out->grid, &view, out->bits);
    }
    return 1;
}

/* Sets the boxes that hold the nearest point of some triangle to their middle, or, `on_it`, whose middle is
   such a point. Only a touched box can. */
typedef struct nearest_walk {
    const tribox_mesh_f64 *mesh;
    voxels                *out;
    int                    on_it;
} nearest_walk;

static inline int nearest_holds(const double v[3][3], const tribox_grid *g, int x, int y, int z, int on_it) {
    double middle[3];
    double weight[3];
    int i[3];
    int a;
    i[0] = x;
    i[1] = y;
    i[2] = z;
    for (a = 0; a < 3; a++) {
        middle[a] = g->origin[a] + (i[a] + 0.5) * g->size[a];
    }
    if (on_it) {
        return tribox_overlap_f64(v[0], v[1], v[2], middle, middle);
    }
    tribox_closest_f64(v[0], v[1], v[2], middle, weight);
    for (a = 0; a < 3; a++) {
        double away = weight[0] * (v[0][a] - middle[a]) + weight[1] * (v[1][a] - middle[a])
                      + weight[2] * (v[2][a] - middle[a]);
        if (!(fabs(away) <= 0.5 * g->size[a])) {
            return 0;
        }
    }
    return 1;
}

static inline void nearest_span(void *user, size_t triangle, int x0, int x1, int y, int z) {
    const nearest_walk *w = (const nearest_walk *)user;
    const tribox_grid *g = &w->out->grid;
    uint64_t *row = voxels_row(w->out, (size_t)(y - g->lo[1]), (size_t)(z - g->lo[2]));
    double v[3][3];
    int i;
    for (i = 0; i < 3; i++) {
        size_t vertex =
            w->mesh->indices ? w->mesh->indices[3 * triangle + (size_t)i] : 3 * triangle + (size_t)i;
        memcpy(v[i], w->mesh->positions + 3 * vertex, sizeof v[i]);
    }
    for (; x0 <= x1; x0++) {
        size_t x = (size_t)(x0 - g->lo[0]);
        if (!(row[x >> 6] >> (x & 63) & 1) && nearest_holds((const double(*)[3])v, g, x0, y, z, w->on_it)) {
            row[x >> 6] |= (uint64_t)1 << (x & 63);
        }
    }
}

static inline int convention_nearest(const mesh *m, int on_it, voxels *out, char *error) {
    tribox_mesh_f64 view;
    nearest_walk w;
    if (!mesh_doubles(m, 0, &view)) {
        snprintf(error, MESH_ERROR, "out of memory");
        return 0;
    }
    memset(out->bits, 0, out->words * sizeof *out->bits);
    w.mesh = &view;
    w.out = out;
    w.on_it = on_it;
    tribox_mesh_spans_f64(&out->grid, &view, nearest_span, &w);
    mesh_doubles_free(&view);
    return 1;
}

/* Eight sets of samples: each moved a little up or down along each axis, down where the bit of its number is
   set. A sample that lies on no face is in all of them or in none. And those that lie on the surface: of a
   corner all eight may miss. */
typedef struct samples {
    voxels set[8];
    voxels surface;
} samples;

static inline void samples_free(samples *s) {
    int i;
    for (i = 0; i < 8; i++) {
        voxels_free(&s->set[i]);
    }
    voxels_free(&s->surface);
}

/* Is set `number` needed for these faces? */
static inline int samples_needed(const int face[3], int number) {
    int a;
    for (a = 0; a < 3; a++) {
        if (face[a] == (number >> a & 1 ? FACE_LOWER : FACE_UPPER)) {
            return 0;
        }
    }
    return 1;
}

/* The sets that these faces need; face NULL: all. The others stay empty. */
static inline int samples_make(samples *s, const mesh *m, const tribox_grid *grid, const int face[3],
                               char *error) {
    int i;
    memset(s, 0, sizeof *s);
    for (i = 0; i < 8; i++) {
        if (face && !samples_needed(face, i)) {
            continue;
        }
        if (!voxels_make(&s->set[i], grid, error)
            || !(i ? convention_mirrored(m, 1, i, &s->set[i], error)
                   : convention_plain(m, 1, &s->set[i], error))) {
            samples_free(s);
            return 0;
        }
    }
    if ((!face || (face[0] == face[1] && face[1] == face[2] && face[0] >= FACE_BOTH))
        && (!voxels_make(&s->surface, grid, error) || !convention_nearest(m, 1, &s->surface, error))) {
        samples_free(s);
        return 0;
    }
    return 1;
}

/* One word of the set by these faces: both is one or the other, none is one and the other; both along all
   axes is the whole surface, none nothing of it. */
static inline uint64_t samples_word(const samples *s, const int face[3], size_t word) {
    uint64_t w[8];
    int a;
    int i;
    for (i = 0; i < 8; i++) {
        w[i] = s->set[i].bits ? s->set[i].bits[word] : 0;
    }
    for (a = 2; a >= 0; a--) {
        for (i = 0; i < 1 << a; i++) {
            uint64_t low = w[i];
            uint64_t high = w[i | 1 << a];
            w[i] = face[a] == FACE_LOWER   ? low
                   : face[a] == FACE_UPPER ? high
                   : face[a] == FACE_BOTH  ? low | high
                                           : low & high;
        }
    }
    if (face[0] == face[1] && face[1] == face[2] && face[0] >= FACE_BOTH) {
        return face[0] == FACE_BOTH ? w[0] | s->surface.bits[word] : w[0] & ~s->surface.bits[word];
    }
    return w[0];
}

static inline int convention_vertices(const mesh *m, voxels *out, char *error) {
    mesh points;
    int ok = mesh_points(&points, m);
    if (!ok) {
        snprintf(error, MESH_ERROR, "out of memory");
        return 0;
    }
    ok = convention_plain(&points, 0, out, error);
    mesh_free(&points);
    return ok;
}

/* The voxels that the convention sets in the file's grid. Returns 1, or 0 with a sentence in `error`; out is
   to be freed. */
static inline int convention_set(const mesh *m, const tribox_grid *file, const convention *c, voxels *out,
                                 char *error) {
    tribox_grid grid = convention_grid(file, c->shift);
    samples s;
    size_t inside;
    size_t i;
    int ok;
    grid.flags = c->flags;
    if (!voxels_make(out, &grid, error)) {
        return 0;
    }
    switch (c->kind) {
    case CONVENTION_SAMPLES:
        ok = samples_make(&s, m, &grid, c->face, error);
        for (i = 0; ok && i < out->words; i++) {
            out->bits[i] = samples_word(&s, c->face, i);
        }
        if (ok) {
            samples_free(&s);
        }
        break;
    case CONVENTION_NEAREST: ok = convention_nearest(m, 0, out, error); break;
    case CONVENTION_VERTICES: ok = convention_vertices(m, out, error); break;
    default:
        ok = c->mirrored ? convention_mirrored(m, 0, 7, out, error) : convention_plain(m, 0, out, error);
        if (ok && c->kind == CONVENTION_FILLED && !solid_fill(out, &inside)) {
            snprintf(error, MESH_ERROR, "out of memory");
            ok = 0;
        }
    }
    if (!ok) {
        voxels_free(out);
    }
    return ok;
}

#endif /* EXAMPLES_CONVENTION_H */
