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

/* ---- One triangle. Numbers come as doubles; where the mesh is of floats, these are floats, too. -------------------- */

/* The number as the mesh's functions take it. */
static inline double mesh_number(const mesh *m, double x) {
    return m->exact ? x : (double)(float)x;
}

static inline void mesh_floats(const double x[3], float out[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        out[a] = (float)x[a];
    }
}

static inline void mesh_triangle_f64(const mesh *m, size_t i, double out[3][3]) {
    size_t k;
    for (k = 0; k < 3; k++) {
        mesh_corner_f64(m, i, k, out[k]);
    }
}

static inline size_t mesh_triangle_spans(const tribox_grid *grid, const mesh *m, size_t i, tribox_span_fn emit, void *user) {
    tribox_mesh view = mesh_view(m);
    const float *v[3];
    double w[3][3];
    if (m->exact) {
        mesh_triangle_f64(m, i, w);
        return tribox_grid_spans_f64(grid, w[0], w[1], w[2], emit, user);
    }
    mesh_corners(&view, i, v);
    return tribox_grid_spans(grid, v[0], v[1], v[2], emit, user);
}

/* Which octants of the node at lo, with such children, the triangle touches. */
static inline unsigned mesh_octants(const mesh *m, size_t i, const double lo[3], double half) {
    const double halves[3] = {half, half, half};
    tribox_mesh view = mesh_view(m);
    const float *v[3];
    float lo32[3];
    float halves32[3];
    double w[3][3];
    tribox_tri tri;
    if (m->exact) {
        mesh_triangle_f64(m, i, w);
        tribox_tri_init_f64(&tri, w[0], w[1], w[2], halves, 0);
        return tribox_tri_octants_f64(&tri, lo);
    }
    mesh_corners(&view, i, v);
    mesh_floats(lo, lo32);
    mesh_floats(halves, halves32);
    tribox_tri_init(&tri, v[0], v[1], v[2], halves32, 0);
    return tribox_tri_octants(&tri, lo32);
}

/* Does origin + t*dir meet the box, 0 <= t <= most? */
static inline int mesh_ray_box(const mesh *m, const double origin[3], const double dir[3], double most, const double lo[3],
                               const double hi[3]) {
    float o32[3];
    float d32[3];
    float lo32[3];
    float hi32[3];
    if (m->exact) {
        return tribox_ray_box_f64(origin, dir, 0, most, lo, hi, NULL, NULL);
    }
    mesh_floats(origin, o32);
    mesh_floats(dir, d32);
    mesh_floats(lo, lo32);
    mesh_floats(hi, hi32);
    return tribox_ray_box(o32, d32, 0, (float)most, lo32, hi32, NULL, NULL);
}

/* Does origin + t*dir meet the triangle, 0 <= t <= most, and where? */
static inline int mesh_ray_triangle(const mesh *m, size_t i, const double origin[3], const double dir[3], double most,
                                    double *out_t) {
    tribox_mesh view = mesh_view(m);
    const float *v[3];
    float o32[3];
    float d32[3];
    float t32 = 0;
    double w[3][3];
    int met;
    if (m->exact) {
        mesh_triangle_f64(m, i, w);
        return tribox_ray_triangle_f64(origin, dir, 0, most, w[0], w[1], w[2], out_t);
    }
    mesh_corners(&view, i, v);
    mesh_floats(origin, o32);
    mesh_floats(dir, d32);
    met = tribox_ray_triangle(o32, d32, 0, (float)most, v[0], v[1], v[2], &t32);
    *out_t = (double)t32;
    return met;
}

/* The weights of the triangle's corners at its point nearest to q. */
static inline void mesh_closest(const mesh *m, size_t i, const double q[3], double out_weights[3]) {
    tribox_mesh view = mesh_view(m);
    const float *v[3];
    float q32[3];
    float weights32[3];
    double w[3][3];
    int a;
    if (m->exact) {
        mesh_triangle_f64(m, i, w);
        tribox_closest_f64(w[0], w[1], w[2], q, out_weights);
        return;
    }
    mesh_corners(&view, i, v);
    mesh_floats(q, q32);
    tribox_closest(v[0], v[1], v[2], q32, weights32);
    for (a = 0; a < 3; a++) {
        out_weights[a] = (double)weights32[a];
    }
}

/* For slide, whose sweeps and gaps are of floats alone: moves the mesh to the origin, by whole numbers, where floats
 * have room for its digits, and says so. */
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
