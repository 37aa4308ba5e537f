/* mesh_exact.h - a mesh as its file has it: the functions of tribox.h for doubles where a coordinate is no float, else
 * those for floats
 */
#ifndef EXAMPLES_MESH_EXACT_H
#define EXAMPLES_MESH_EXACT_H
#include "mesh_io.h"

static inline int mesh_fit(tribox_grid *grid, const mesh *m, int n) {
    tribox_mesh view = mesh_view(m);
    tribox_mesh_f64 exact = mesh_view_f64(m);
    return m->exact ? tribox_grid_fit_f64(grid, &exact, n) : tribox_grid_fit(grid, &view, n);
}

/* Triangles first to end - 1, set or, with `solid`, flipped inside. */
static inline void mesh_fill_part(const tribox_grid *grid, const mesh *m, size_t first, size_t end, int solid, uint64_t *bits) {
    tribox_mesh view = mesh_view(m);
    tribox_mesh_f64 exact = mesh_view_f64(m);
    view.triangles = exact.triangles = end - first;
    if (m->indices) {
        view.indices = exact.indices = m->indices + 3 * first;
    } else {
        view.positions += 9 * first;
        exact.positions = m->exact ? m->exact + 9 * first : NULL;
    }
    if (m->exact) {
        (solid ? tribox_grid_fill_solid_f64 : tribox_grid_fill_f64)(grid, &exact, bits);
    } else {
        (solid ? tribox_grid_fill_solid : tribox_grid_fill)(grid, &view, bits);
    }
}

static inline void mesh_fill(const tribox_grid *grid, const mesh *m, uint64_t *bits) {
    mesh_fill_part(grid, m, 0, m->triangles, 0, bits);
}

static inline void mesh_fill_solid(const tribox_grid *grid, const mesh *m, uint64_t *bits) {
    mesh_fill_part(grid, m, 0, m->triangles, 1, bits);
}

static inline size_t mesh_spans(const tribox_grid *grid, const mesh *m, tribox_mesh_span_fn emit, void *user) {
    tribox_mesh view = mesh_view(m);
    tribox_mesh_f64 exact = mesh_view_f64(m);
    return m->exact ? tribox_mesh_spans_f64(grid, &exact, emit, user) : tribox_mesh_spans(grid, &view, emit, user);
}

/* One line about it. */
static inline void mesh_say_exact(const mesh *m) {
    if (m->exact) {
        printf("doubles   some coordinates are no floats: all is computed in double\n");
    }
}

/* For programs whose own question is in floats: moves the mesh to the origin, by whole numbers, where floats have room
 * for its digits, and says so. */
static inline void mesh_to_floats(mesh *m) {
    double least[3] = {0, 0, 0};
    size_t i;
    size_t k;
    if (!m->exact) {
        return;
    }
    for (k = 0; k < 3; k++) {
        least[k] = HUGE_VAL;
        for (i = 0; i < m->vertices; i++) {
            double x = m->exact[3 * i + k];
            least[k] = x < least[k] ? x : least[k];
        }
        least[k] = fabs(least[k]) < 1e15 ? floor(least[k]) : 0;
    }
    for (i = 0; i < 3 * m->vertices; i++) {
        double x = m->exact[i] - least[i % 3];
        m->positions[i] = x > (double)FLT_MAX ? HUGE_VALF : x < -(double)FLT_MAX ? -HUGE_VALF : (float)x;
    }
    printf("floats    some coordinates are no floats: the mesh is moved by %.17g,%.17g,%.17g and rounded to floats\n",
           0 - least[0], 0 - least[1], 0 - least[2]);
}

#endif /* EXAMPLES_MESH_EXACT_H */
