/* tribox.h's answers to the questions of companions.h, for golden.c, golden.cu, verify.c and
 * fuzz_companions.c. Numbers are only copied, never computed with. */
#ifndef COMPANIONS_ANSWERS_H
#define COMPANIONS_ANSWERS_H

#include "../tribox.h"
#include "companions.h"

COMPANION_FN void companion_copy(void *to, const void *from, size_t bytes)
{
    unsigned char *t = (unsigned char *)to;
    const unsigned char *f = (const unsigned char *)from;
    size_t i;
    for (i = 0; i < bytes; ++i) {
        t[i] = f[i];
    }
}

COMPANION_FN void companion_floats(float *out, const uint64_t *bits, int n)
{
    int i;
    for (i = 0; i < n; ++i) {
        const uint32_t word = (uint32_t)bits[i];
        companion_copy(out + i, &word, sizeof word);
    }
}

COMPANION_FN void companion_wrote(companion_answer *out, const float *x, int n)
{
    int i;
    for (i = 0; i < n; ++i) {
        uint32_t word;
        companion_copy(&word, x + i, sizeof word);
        out->word[out->n++] = word;
    }
}

COMPANION_FN void companion_wrote_f64(companion_answer *out, const double *x, int n)
{
    companion_copy(out->word + out->n, x, sizeof *x * (size_t)n);
    out->n += n;
}

COMPANION_FN int companion_octants(const companion *c)
{
    tribox_tri tri;
    if (c->f64) {
        double x[18];
        companion_copy(x, c->x, sizeof x);
        tribox_tri_init_f64(&tri, x, x + 3, x + 6, x + 15, c->flags);
        tribox_tri_resize_f64(&tri, x + 12);
        return (int)tribox_tri_octants_f64(&tri, x + 9);
    } else {
        float x[18];
        companion_floats(x, c->x, 18);
        tribox_tri_init(&tri, x, x + 3, x + 6, x + 15, c->flags);
        tribox_tri_resize(&tri, x + 12);
        return (int)tribox_tri_octants(&tri, x + 9);
    }
}

/* How many triangles of the indexed mesh touch the box, and 256 more if the one without indices does:
 * box_max w o. */
COMPANION_FN void companion_query(const float x[COMPANION_NUMBERS], companion_answer *out)
{
    uint32_t indices[3 * COMPANION_MESH];
    uint32_t found[COMPANION_CAPACITY];
    float corners[5][4];
    tribox_mesh mesh;
    int i;
    size_t touching;
    for (i = 0; i < 5; ++i) {
        companion_copy(corners[i], x + (i < 3 ? 3 * i : COMPANION_W + 3 * (i - 3)), 3 * sizeof(float));
    }
    companion_mesh(indices);
    mesh.positions = corners[0];
    mesh.stride = sizeof corners[0];
    mesh.indices = indices;
    mesh.triangles = COMPANION_MESH;
    touching = tribox_mesh_query(&mesh, x + COMPANION_LO, x + COMPANION_HI, found, COMPANION_CAPACITY);
    out->n = touching < COMPANION_CAPACITY ? (int)touching : COMPANION_CAPACITY;
    for (i = 0; i < out->n; ++i) {
        out->word[i] = found[i];
    }
    mesh.positions = x + COMPANION_HI;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    out->value = (int)touching;
    out->value += 256 * (int)tribox_mesh_query(&mesh, x + COMPANION_LO, x + COMPANION_HI, NULL, 0);
}

COMPANION_FN void companion_query_f64(const double x[COMPANION_NUMBERS], companion_answer *out)
{
    uint32_t indices[3 * COMPANION_MESH];
    uint32_t found[COMPANION_CAPACITY];
    double corners[5][4];
    tribox_mesh_f64 mesh;
    int i;
    size_t touching;
    for (i = 0; i < 5; ++i) {
        companion_copy(corners[i], x + (i < 3 ? 3 * i : COMPANION_W + 3 * (i - 3)), 3 * sizeof(double));
    }
    companion_mesh(indices);
    mesh.positions = corners[0];
    mesh.stride = sizeof corners[0];
    mesh.indices = indices;
    mesh.triangles = COMPANION_MESH;
    touching =
        tribox_mesh_query_f64(&mesh, x + COMPANION_LO, x + COMPANION_HI, found, COMPANION_CAPACITY);
    out->n = touching < COMPANION_CAPACITY ? (int)touching : COMPANION_CAPACITY;
    for (i = 0; i < out->n; ++i) {
        out->word[i] = found[i];
    }
    mesh.positions = x + COMPANION_HI;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    out->value = (int)touching;
    out->value += 256 * (int)tribox_mesh_query_f64(&mesh, x + COMPANION_LO, x + COMPANION_HI, NULL, 0);
}

/* receives a voxel; `user` holds the hash and counts */
typedef struct companion_voxels {
    uint64_t hash;
    int count;
} companion_voxels;

COMPANION_FN int companion_see_voxel(void *user, int x, int y, int z)
{
    companion_voxels *v = (companion_voxels *)user;
    v->hash = companion_mix(v->hash, x, y, z);
    v->count++;
    return 0;
}

COMPANION_FN void companion_segment(const companion *c, companion_answer *out)
{
    double x[COMPANION_NUMBERS];
    companion_voxels seen;
    tribox_grid grid;
    int k;
    companion_copy(x, c->x, sizeof x);
    companion_copy(grid.origin, x, sizeof grid.origin);
    companion_copy(grid.size, x + 3, sizeof grid.size);
    companion_region(c, grid.lo);
    for (k = 0; k < 3; ++k) {
        grid.hi[k] = grid.lo[k] + COMPANION_REGION;
    }
    grid.flags = c->flags;
    seen.hash = companion_mix_start();
    seen.count = 0;
    out->value = (int)tribox_grid_segment(&grid, x + COMPANION_W, x + COMPANION_O, companion_see_voxel, &seen);
    out->n = 2;
    out->word[0] = (uint64_t)seen.count;
    out->word[1] = seen.hash;
}

/* The sign of s, twice if it is infinite. */
COMPANION_FN void companion_gap(const float x[COMPANION_NUMBERS], companion_answer *out)
{
    const uint64_t infinity = (uint64_t)0x7ff << 52;
    float axis[3];
    double s;
    int size;
    companion_copy(axis, out->axis, sizeof axis);
    s = tribox_gap(x, x + 3, x + 6, x + COMPANION_LO, x + COMPANION_HI, axis);
    companion_copy(&out->s, &s, sizeof s);
    companion_copy(out->axis, axis, sizeof axis);
    size = out->s << 1 == 0 ? 0 : out->s << 1 == infinity << 1 ? 2 : out->s << 1 > infinity << 1 ? 3 : 1;
    out->value = out->s >> 63 != 0 ? -size : size;
    out->s = size > 1 ? 0 : out->s;
}

/* Spheres. */
COMPANION_FN int companion_ball(int which, const float x[COMPANION_NUMBERS], companion_answer *out)
{
    const float *c = x + COMPANION_O;
    const float *w = x + COMPANION_W;
    const float *lo = x + COMPANION_LO;
    const float *hi = x + COMPANION_HI;
    float t[2];
    switch (which) {
    case COMPANION_SPHERE_SPHERE:
        return tribox_sphere_sphere(w, x[COMPANION_T1], c, x[COMPANION_T0]);
    case COMPANION_PLANE_SPHERE:
        return tribox_plane_sphere(w, x[COMPANION_T1], c, x[COMPANION_T0]);
    case COMPANION_SPHERE_BOX:
        return tribox_sphere_box(c, x[COMPANION_T0], lo, hi);
    case COMPANION_SPHERE_TRIANGLE:
        return tribox_sphere_triangle(c, x[COMPANION_T0], x, x + 3, x + 6);
    default:
        if (!tribox_ray_sphere(w, lo, hi[0], x[COMPANION_T1], c, x[COMPANION_T0], &t[0], &t[1])) {
            return 0;
        }
        companion_wrote(out, t, 2);
        return 1;
    }
}

COMPANION_FN void companion_ask_f64(const companion *c, companion_answer *out)
{
    double x[COMPANION_NUMBERS];
    double polygon[9][3];
    double t[2];
    double three[3];
    const double *v = x;
    const double *lo = x + COMPANION_LO;
    const double *hi = x + COMPANION_HI;
    const double *w = x + COMPANION_W;
    const double *o = x + COMPANION_O;
    int i;
    companion_copy(x, c->x, sizeof x);
    switch (c->which) {
    case COMPANION_BOX_BOX:
        out->value = tribox_box_box_f64(lo, hi, w, o);
        break;
    case COMPANION_SEGMENT_BOX:
        out->value = tribox_segment_box_f64(w, o, lo, hi);
        break;
    case COMPANION_RAY_BOX:
        out->value = tribox_ray_box_f64(o, w, x[COMPANION_T0], x[COMPANION_T1], lo, hi, &t[0], &t[1]);
        companion_wrote_f64(out, t, out->value ? 2 : 0);
        break;
    case COMPANION_RAY_TRIANGLE:
        out->value = tribox_ray_triangle_f64(o, w, x[COMPANION_T0], x[COMPANION_T1], v, v + 3, v + 6, t);
        companion_wrote_f64(out, t, out->value ? 1 : 0);
        break;
    case COMPANION_CLIP:
        out->value = tribox_clip_f64(v, v + 3, v + 6, lo, hi, polygon);
        for (i = 0; i < out->value; ++i) {
            companion_wrote_f64(out, polygon[i], 3);
        }
        break;
    case COMPANION_CLOSEST:
        tribox_closest_f64(v, v + 3, v + 6, o, three);
        companion_wrote_f64(out, three, 3);
        break;
    case COMPANION_OCTANTS:
        out->value = companion_octants(c);
        break;
    case COMPANION_GRID_SEGMENT:
        companion_segment(c, out);
        break;
    default:
        companion_query_f64(x, out);
        break;
    }
}

COMPANION_FN void companion_ask(const companion *c, companion_answer *out)
{
    float x[COMPANION_NUMBERS];
    float polygon[9][3];
    float t[2];
    float three[3];
    const float *v = x;
    const float *lo = x + COMPANION_LO;
    const float *hi = x + COMPANION_HI;
    const float *w = x + COMPANION_W;
    const float *o = x + COMPANION_O;
    int i;
    out->value = 0;
    out->n = 0;
    for (i = 0; i < 27; ++i) {
        out->word[i] = 0;
    }
    for (i = 0; i < 3; ++i) {
        out->axis[i] = 0;
    }
    out->s = 0;
    if (c->f64) {
        companion_ask_f64(c, out);
        return;
    }
    companion_floats(x, c->x, COMPANION_NUMBERS);
    switch (c->which) {
    case COMPANION_BOX_BOX:
        out->value = tribox_box_box(lo, hi, w, o);
        break;
    case COMPANION_PLANE_BOX:
        out->value = tribox_plane_box(w, x[COMPANION_T0], lo, hi);
        break;
    case COMPANION_SEGMENT_BOX:
        out->value = tribox_segment_box(w, o, lo, hi);
        break;
    case COMPANION_RAY_BOX:
        out->value = tribox_ray_box(o, w, x[COMPANION_T0], x[COMPANION_T1], lo, hi, &t[0], &t[1]);
        companion_wrote(out, t, out->value ? 2 : 0);
        break;
    case COMPANION_RAY_TRIANGLE:
        out->value = tribox_ray_triangle(o, w, x[COMPANION_T0], x[COMPANION_T1], v, v + 3, v + 6, t);
        companion_wrote(out, t, out->value ? 1 : 0);
        break;
    case COMPANION_SWEEP:
    case COMPANION_SWEEP_RULE:
    case COMPANION_SWEEP_BOX:
        out->value = c->which == COMPANION_SWEEP ? tribox_sweep(v, v + 3, v + 6, lo, hi, w, &t[0], &t[1], three)
                     : c->which == COMPANION_SWEEP_RULE
                         ? tribox_sweep_rule(v, v + 3, v + 6, lo, hi, w, c->flags, &t[0], &t[1], three)
                         : tribox_sweep_box(lo, hi, v, v + 3, w, c->flags, &t[0], &t[1], three);
        companion_wrote(out, t, out->value ? 2 : 0);
        if (out->value) {
            companion_copy(out->axis, three, sizeof three);
        }
        break;
    case COMPANION_CLIP:
        out->value = tribox_clip(v, v + 3, v + 6, lo, hi, polygon);
        for (i = 0; i < out->value; ++i) {
            companion_wrote(out, polygon[i], 3);
        }
        break;
    case COMPANION_CLOSEST:
        tribox_closest(v, v + 3, v + 6, o, three);
        companion_wrote(out, three, 3);
        break;
    case COMPANION_OCTANTS:
        out->value = companion_octants(c);
        break;
    case COMPANION_QUERY:
        companion_query(x, out);
        break;
    case COMPANION_GAP:
        companion_gap(x, out);
        break;
    default:
        out->value = companion_ball(c->which, x, out);
        break;
    }
}

#endif
