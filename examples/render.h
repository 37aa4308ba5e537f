/* render.h - a shaded picture of voxels: sun with soft shadows, sky with occlusion
 *
 * Parallel projection from front right above, four samples a pixel. The exposed faces that look at the camera are
 * drawn into a depth buffer, all of one direction being the same parallelogram; each face that is seen is lit once,
 * by rays. A ray walks bricks of 8x8x8 voxels and goes into a brick only if a voxel in it is set [Amanatides and
 * Woo, A fast voxel traversal algorithm, 1987]. The floor is lit at every eighth pixel. Lengths are in voxels of
 * the largest side ("units").
 */
#ifndef EXAMPLES_RENDER_H
#define EXAMPLES_RENDER_H
#include "png.h"
#include "progress.h"

enum { RENDER_WIDTH = 1280, RENDER_HEIGHT = 960, RENDER_BRICK = 8, RENDER_CACHE = 1 << 18 };
enum { RENDER_FINE = 2 };                               /* samples of a pixel, each way */
enum { RENDER_COLUMNS = RENDER_FINE * RENDER_WIDTH, RENDER_ROWS = RENDER_FINE * RENDER_HEIGHT };
enum { RENDER_LIGHTS = 4096 };
enum { RENDER_FLOOR = 8 };                              /* pixels between the points where the floor is lit */

typedef struct vec { double x[3]; } vec;

static inline vec vec_make(double x, double y, double z) {
    vec v;
    v.x[0] = x;
    v.x[1] = y;
    v.x[2] = z;
    return v;
}

/* a + s * b */
static inline vec vec_add(vec a, double s, vec b) {
    return vec_make(a.x[0] + s * b.x[0], a.x[1] + s * b.x[1], a.x[2] + s * b.x[2]);
}

static inline double vec_dot(vec a, vec b) {
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static inline vec vec_cross(vec a, vec b) {
    return vec_make(a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                    a.x[0] * b.x[1] - a.x[1] * b.x[0]);
}

static inline vec vec_unit(vec a) {
    double length = sqrt(vec_dot(a, a));
    return length > 0 ? vec_make(a.x[0] / length, a.x[1] / length, a.x[2] / length) : a;
}

/* The light that a face sees, or all faces of one direction in a block of voxels where these are smaller than a
 * pixel; the sun at the face's corners, which are those at (0,0), (1,0), (0,1), (1,1) of the two axes after its own. */
typedef struct render_light {
    uint64_t key;           /* 0: empty */
    double   open_sky;      /* part of the sky that it sees */
    double   sun[4];        /* part of the sun */
} render_light;

/* The normal of the surface around a voxel. */
typedef struct render_normal {
    uint64_t key;           /* voxel + 1; 0: empty */
    vec      normal;
} render_normal;

/* How a direction of faces lies in the picture, in samples: where steps along the three axes lead, and the way
 * back to the face's own two axes b and c. */
typedef struct render_side {
    double to_b[2];         /* b of (column, row) */
    double to_c[2];
} render_side;

typedef struct render {
    const voxels  *v;
    unsigned char *brick;               /* 1: a voxel in it is set */
    size_t         bricks[3];
    size_t         lo[3];               /* bounding box of the set voxels */
    size_t         hi[3];
    vec            scale;               /* a voxel's sides in units */
    vec            up;
    vec            right;
    vec            top;                 /* up in the picture */
    vec            forward;
    vec            centre;
    vec            sun;
    vec            sun_side[2];         /* two directions across it, for its width */
    double         ground;              /* height of the floor along up */
    double         units;               /* per pixel */
    double         start[3];            /* column, row and depth of the corner of voxel (0,0,0), in samples */
    double         step[3][3];          /* the same of a step along each axis */
    render_side    side[3];
    uint64_t      *seen;                /* of each sample, the key of the face; 0: none */
    float         *depth;
    unsigned char  byte[4097];          /* sRGB of light in 4096ths */
    vec           *floor;               /* light on the floor, at every RENDER_FLOOR-th pixel */
    int            block;               /* log2 of the voxels of a block with one light, each way */
    render_light  *lights;
    render_normal *normals;
} render;

typedef struct render_hit {
    double t;
    size_t voxel[3];
    int    axis;            /* of the face; its outward normal is against the ray */
} render_hit;

/* ---- 1. Rays --------------------------------------------------------------------------------- */

/* A walk of a ray through cells of one size; all in index coordinates. */
typedef struct render_walk {
    long   cell[3];
    int    step[3];
    double next[3];         /* t at which each axis leaves the cell */
    double delta[3];
    double t;
    int    axis;            /* crossed last */
} render_walk;

static inline void walk_begin(render_walk *w, vec o, vec d, double t, double cell, const long lo[3],
                              const long hi[3], int axis) {
    int a;
    w->t = t;
    w->axis = axis;
    for (a = 0; a < 3; a++) {
        double at = floor((o.x[a] + t * d.x[a]) / cell);
        w->cell[a] = at < (double)lo[a] ? lo[a] : at >= (double)hi[a] ? hi[a] - 1 : (long)at;
        w->step[a] = d.x[a] > 0 ? 1 : -1;
        w->next[a] = d.x[a] == 0 ? HUGE_VAL : (cell * (double)(w->cell[a] + (d.x[a] > 0)) - o.x[a]) / d.x[a];
        w->delta[a] = d.x[a] == 0 ? 0 : cell / fabs(d.x[a]);
    }
}

static inline void walk_step(render_walk *w) {
    int a = w->next[0] < w->next[1] ? (w->next[0] < w->next[2] ? 0 : 2) : w->next[1] < w->next[2] ? 1 : 2;
    w->t = w->next[a];
    w->axis = a;
    w->cell[a] += w->step[a];
    w->next[a] += w->delta[a];
}

static inline int walk_inside(const render_walk *w, const long lo[3], const long hi[3]) {
    return w->cell[0] >= lo[0] && w->cell[0] < hi[0] && w->cell[1] >= lo[1] && w->cell[1] < hi[1]
        && w->cell[2] >= lo[2] && w->cell[2] < hi[2];
}

/* The part [t0, t1] of the ray in the box of set voxels; 0 if it misses. */
static inline int render_enter(const render *r, vec o, vec d, double *t0, double *t1, int *axis) {
    int a;
    *axis = 0;
    for (a = 0; a < 3; a++) {
        double near;
        double far;
        if (d.x[a] == 0) {
            if (o.x[a] < (double)r->lo[a] || o.x[a] > (double)r->hi[a]) {
                return 0;
            }
            continue;
        }
        near = ((double)(d.x[a] > 0 ? r->lo[a] : r->hi[a]) - o.x[a]) / d.x[a];
        far = ((double)(d.x[a] > 0 ? r->hi[a] : r->lo[a]) - o.x[a]) / d.x[a];
        if (near > *t0) {
            *t0 = near;
            *axis = a;
        }
        *t1 = far < *t1 ? far : *t1;
    }
    return *t0 <= *t1;
}

static inline int render_walk_brick(const render *r, const render_walk *outer, vec o, vec d, double t1,
                                    render_hit *hit) {
    long lo[3];
    long hi[3];
    render_walk w;
    int a;
    for (a = 0; a < 3; a++) {
        lo[a] = outer->cell[a] * RENDER_BRICK;
        hi[a] = lo[a] + RENDER_BRICK;
        hi[a] = hi[a] < (long)r->v->n[a] ? hi[a] : (long)r->v->n[a];
    }
    walk_begin(&w, o, d, outer->t, 1, lo, hi, outer->axis);
    for (; walk_inside(&w, lo, hi) && w.t <= t1; walk_step(&w)) {
        if (voxels_get(r->v, (size_t)w.cell[0], (size_t)w.cell[1], (size_t)w.cell[2])) {
            hit->t = w.t;
            hit->axis = w.axis;
            for (a = 0; a < 3; a++) {
                hit->voxel[a] = (size_t)w.cell[a];
            }
            return 1;
        }
    }
    return 0;
}

/* The first set voxel on the ray origin + t * direction (in units), 0 <= t <= t1. */
static inline int render_trace(const render *r, vec origin, vec direction, double t1, render_hit *hit) {
    static const long zero[3] = {0, 0, 0};
    double t0 = 0;
    render_walk w;
    vec o;
    vec d;
    long bricks[3];
    int axis;
    int a;
    for (a = 0; a < 3; a++) {
        o.x[a] = origin.x[a] / r->scale.x[a];
        d.x[a] = direction.x[a] / r->scale.x[a];
        bricks[a] = (long)r->bricks[a];
    }
    if (!render_enter(r, o, d, &t0, &t1, &axis)) {
        return 0;
    }
    walk_begin(&w, o, d, t0, RENDER_BRICK, zero, bricks, axis);
    for (; walk_inside(&w, zero, bricks) && w.t <= t1; walk_step(&w)) {
        size_t at = ((size_t)w.cell[2] * r->bricks[1] + (size_t)w.cell[1]) * r->bricks[0] + (size_t)w.cell[0];
        if (r->brick[at] && render_walk_brick(r, &w, o, d, t1, hit)) {
            return 1;
        }
    }
    return 0;
}

/* ---- 2. Light -------------------------------------------------------------------------------- */

/* A unit vector i of `count`, spread evenly over the half sphere around `normal` and denser towards it (by
   the cosine). */
static inline vec render_sky_direction(vec normal, int i, int count, double turn) {
    double height = sqrt((i + 0.5) / count);
    double angle = 2.399963229728653 * i + turn;      /* the golden angle */
    double radius = sqrt(1 - height * height);
    vec a = vec_unit(vec_cross(normal, fabs(normal.x[0]) < 0.7 ? vec_make(1, 0, 0) : vec_make(0, 1, 0)));
    vec b = vec_cross(normal, a);
    return vec_add(vec_add(vec_make(height * normal.x[0], height * normal.x[1], height * normal.x[2]),
                           radius * cos(angle), a), radius * sin(angle), b);
}

static inline double render_reach(const render *r) {
    size_t longest = r->hi[0] - r->lo[0];
    longest = r->hi[1] - r->lo[1] > longest ? r->hi[1] - r->lo[1] : longest;
    longest = r->hi[2] - r->lo[2] > longest ? r->hi[2] - r->lo[2] : longest;
    return 4 + 0.15 * (double)longest;
}

/* How much of the sky a point sees, far things counting less. */
static inline double render_open_sky(const render *r, vec point, vec normal, int count, double turn) {
    double reach = render_reach(r);
    double open = 0;
    int i;
    for (i = 0; i < count; i++) {
        render_hit hit;
        vec d = render_sky_direction(normal, i, count, turn);
        open += render_trace(r, point, d, reach, &hit) ? hit.t / reach : 1;
    }
    return open / count;
}

/* Voxels x - 4 to x + 4 of a row, from the lowest bit on; outside the grid none is set. */
static inline unsigned render_window(const render *r, size_t x, size_t y, size_t z) {
    const uint64_t *row;
    size_t first = x - 4;
    uint64_t bits;
    if (y >= r->v->n[1] || z >= r->v->n[2]) {
        return 0;
    }
    row = voxels_row(r->v, y, z);
    if (x < 4) {
        return (unsigned)(row[0] << (4 - x)) & 511u;
    }
    bits = row[first >> 6] >> (first & 63);
    if ((first & 63) > 55 && (first >> 6) + 1 < r->v->row_words) {
        bits |= row[(first >> 6) + 1] << (64 - (first & 63));
    }
    return (unsigned)bits & 511u;
}

/* The surface's normal: exposed faces that look at the camera, counted around the voxel, stand for its
   components. */
static inline vec render_smooth_normal(const render *r, const size_t voxel[3]) {
    enum { REACH = 3 };
    int sum[3] = {0, 0, 0};
    int step[3];
    int a;
    int y;
    int z;
    for (a = 0; a < 3; a++) {
        step[a] = r->forward.x[a] > 0 ? -1 : 1;
    }
    for (z = -REACH; z <= REACH; z++) {
        for (y = -REACH; y <= REACH; y++) {
            size_t at_y = (size_t)((long)voxel[1] + y);
            size_t at_z = (size_t)((long)voxel[2] + z);
            unsigned set = render_window(r, voxel[0], at_y, at_z);
            unsigned open[3];
            int x;
            if (y * y + z * z > REACH * REACH || set == 0) {
                continue;
            }
            open[0] = set & ~(step[0] > 0 ? set >> 1 : set << 1);
            open[1] = set & ~render_window(r, voxel[0], at_y + (size_t)step[1], at_z);
            open[2] = set & ~render_window(r, voxel[0], at_y, at_z + (size_t)step[2]);
            for (x = -REACH; x <= REACH; x++) {
                int distance = x * x + y * y + z * z;
                for (a = 0; distance <= REACH * REACH && a < 3; a++) {
                    sum[a] += (int)(open[a] >> (x + 4) & 1u) * step[a] * (REACH * REACH + 2 - distance);
                }
            }
        }
    }
    return vec_unit(vec_make(sum[0], sum[1], sum[2]));
}

static inline const vec *render_visit_normal(const render *r, uint64_t voxel_number, const size_t voxel[3]) {
    render_normal *n = &r->normals[(voxel_number + 1) * 0x9e3779b97f4a7c15u >> 46];
    if (n->key != voxel_number + 1) {
        n->key = voxel_number + 1;
        n->normal = render_smooth_normal(r, voxel);
    }
    return &n->normal;
}

/* 1 if the sun is seen. The rays ask parts of its disc, so that shadows have soft borders. */
static inline double render_sun_seen(const render *r, vec point, int sample, int samples) {
    double radius = 0.045 * sqrt((sample + 0.5) / samples);
    double angle = 2.399963229728653 * sample;
    render_hit hit;
    vec d = vec_add(vec_add(r->sun, radius * cos(angle), r->sun_side[0]), radius * sin(angle),
                    r->sun_side[1]);
    return render_trace(r, point, d, HUGE_VAL, &hit) ? 0 : 1;
}

/* The part of the sun seen from a face at (b, c) of its own axes; from a little above, so that the steps of the
   surface don't shade each other. */
static inline double render_face_sun(const render *r, vec normal, const size_t voxel[3], int axis, vec outward,
                                     double b, double c, int samples) {
    vec point;
    double seen = 0;
    int i;
    for (i = 0; i < 3; i++) {
        double in = i == axis ? 0.5 + 0.5 * outward.x[i] : i == (axis + 1) % 3 ? b : c;
        point.x[i] = ((double)voxel[i] + in) * r->scale.x[i];
    }
    point = vec_add(vec_add(point, 0.05, outward), 1.2, normal);
    for (i = 0; i < samples; i++) {
        seen += render_sun_seen(r, point, i, samples);
    }
    return seen / samples;
}

/* The light on a face, kept for the samples that follow. Large faces are lit with more rays, and the sun at their
   corners. */
static inline const render_light *render_visit_light(const render *r, const size_t voxel[3], int axis, vec outward,
                                                     vec normal) {
    uint64_t x = voxel[0] >> r->block;
    uint64_t y = voxel[1] >> r->block;
    uint64_t z = voxel[2] >> r->block;
    uint64_t key = 4 * ((z * r->v->n[1] + y) * r->v->n[0] + x) + (uint64_t)axis + 1;
    render_light *light = &r->lights[key * 0x9e3779b97f4a7c15u >> 46];
    double pixels = 1 / r->units;
    vec middle;
    int i;
    if (light->key == key) {
        return light;
    }
    for (i = 0; i < 3; i++) {
        middle.x[i] = ((double)voxel[i] + 0.5 + 0.51 * outward.x[i]) * r->scale.x[i];
    }
    light->key = key;
    light->open_sky = render_open_sky(r, middle, outward, pixels > 4 ? 24 : pixels > 1.5 ? 12 : 6, 0);
    if (vec_dot(outward, r->sun) < -0.5 && vec_dot(normal, r->sun) < 0) {
        memset(light->sun, 0, sizeof light->sun);
    } else if (pixels > 4) {
        for (i = 0; i < 4; i++) {
            light->sun[i] = render_face_sun(r, normal, voxel, axis, outward, 0.15 + 0.7 * (i & 1), 0.15 + 0.7 * (i >> 1), 5);
        }
    } else {
        light->sun[0] = render_face_sun(r, normal, voxel, axis, outward, 0.5, 0.5, pixels > 1.5 ? 6 : 3);
        light->sun[1] = light->sun[2] = light->sun[3] = light->sun[0];
    }
    return light;
}

static inline vec render_shade_face(const render *r, const render_light *light, vec smooth, vec outward, double b,
                                    double c, vec point) {
    double pixels = 1 / r->units;                               /* a voxel's side in the picture */
    double flat = pixels > 8 ? 0.55 : pixels > 2 ? 0.25 + 0.05 * (pixels - 2) : 0.25;
    vec normal = vec_unit(vec_add(vec_add(vec_make(0, 0, 0), flat, outward), 1 - flat, smooth));
    vec colour;
    double sun = vec_dot(normal, r->sun);
    double sky = (0.6 + 0.4 * vec_dot(normal, r->up)) * light->open_sky;
    double shine = vec_dot(smooth, vec_unit(vec_add(r->sun, -1, r->forward)));
    double height = (vec_dot(point, r->up) - r->ground) / (2 * (vec_dot(r->centre, r->up) - r->ground) + 1e-9);
    int a;
    sun = sun > 0 ? sun * ((1 - c) * ((1 - b) * light->sun[0] + b * light->sun[1])
                           + c * ((1 - b) * light->sun[2] + b * light->sun[3])) : 0;
    shine = sun > 0 && shine > 0.8 ? 0.25 * pow(shine, 40) : 0;
    colour = vec_make(0.80 + 0.08 * height, 0.23 + 0.17 * height, 0.07 + 0.08 * height);
    for (a = 0; a < 3; a++) {
        static const double sunlight[3] = {0.92, 0.85, 0.74};
        static const double skylight[3] = {0.36, 0.41, 0.50};
        static const double bounce[3] = {0.06, 0.05, 0.045};
        colour.x[a] = colour.x[a] * (sun * sunlight[a] + sky * skylight[a] + bounce[a]) + shine;
    }
    return colour;
}

/* The floor at a pixel, which fades into the backdrop, or the backdrop alone. */
static inline vec render_shade_floor(const render *r, double x, double y) {
    vec backdrop = vec_add(vec_make(0.66, 0.70, 0.76), 1 - y / RENDER_HEIGHT, vec_make(0.16, 0.15, 0.13));
    double far = 4 * render_reach(r) / 0.15;
    vec origin = vec_add(vec_add(vec_add(r->centre, r->units * (x - RENDER_WIDTH / 2.0), r->right),
                                 r->units * (RENDER_HEIGHT / 2.0 - y), r->top), -far, r->forward);
    double t = (r->ground - vec_dot(origin, r->up)) / vec_dot(r->forward, r->up);
    vec point = vec_add(origin, t, r->forward);
    vec away = vec_add(point, -1, r->centre);
    double reach = 3 * render_reach(r);
    double light = 0;
    double fade = exp(-vec_dot(away, away) / (14 * reach * reach));
    int a;
    if (fade < 0.01) {
        return backdrop;
    }
    point = vec_add(point, 0.01, r->up);
    for (a = 0; a < 12; a++) {
        light += render_sun_seen(r, point, a, 12) / 12;
    }
    light = 0.55 * light + 0.45 * render_open_sky(r, point, r->up, 12, 0);
    for (a = 0; a < 3; a++) {
        backdrop.x[a] *= 1 - fade * (1 - light) * 0.85;
    }
    return backdrop;
}

/* ---- 3. The picture -------------------------------------------------------------------------- */

/* Marks bricks with set voxels and measures their bounding box. Returns 0 if no voxel is set. */
static inline int render_mark_bricks(render *r) {
    size_t x;
    size_t y;
    size_t z;
    int a;
    for (a = 0; a < 3; a++) {
        r->lo[a] = r->v->n[a];
        r->hi[a] = 0;
    }
    for (z = 0; z < r->v->n[2]; z++) {
        for (y = 0; y < r->v->n[1]; y++) {
            const uint64_t *row = voxels_row(r->v, y, z);
            size_t base = (z / RENDER_BRICK * r->bricks[1] + y / RENDER_BRICK) * r->bricks[0];
            for (x = 0; x < r->bricks[0]; x++) {
                unsigned part = (unsigned)(row[x / 8] >> (8 * (x % 8)) & 255);
                size_t first;
                size_t last;
                if (!part) {
                    continue;
                }
                r->brick[base + x] = 1;
                first = 8 * x + voxels_lowest(part);
                for (last = 8 * x + 7; !(part & 0x80); last--) {
                    part <<= 1;
                }
                r->lo[0] = first < r->lo[0] ? first : r->lo[0];
                r->hi[0] = last + 1 > r->hi[0] ? last + 1 : r->hi[0];
                r->lo[1] = y < r->lo[1] ? y : r->lo[1];
                r->hi[1] = y + 1 > r->hi[1] ? y + 1 : r->hi[1];
                r->lo[2] = z < r->lo[2] ? z : r->lo[2];
                r->hi[2] = z + 1;
            }
        }
    }
    return r->hi[2] > 0;
}

/* Directions for the given up axis: the camera stands 25 degrees right of the front and 24 degrees up. */
static inline void render_aim(render *r, char up) {
    upright turn = upright_make(up);
    vec axis[3];
    vec box;
    double width = 0;
    double height = 0;
    double least = 1e300;
    int a;
    int i;
    for (a = 0; a < 3; a++) {
        double size = r->v->grid.size[a];
        double largest = fmax(r->v->grid.size[0], fmax(r->v->grid.size[1], r->v->grid.size[2]));
        axis[a] = vec_make(0, 0, 0);
        axis[a].x[turn.axis[a]] = turn.flip[a] ? -1 : 1;
        r->scale.x[a] = size / largest;
        box.x[a] = 0.5 * (double)(r->hi[a] - r->lo[a]) * r->scale.x[a];
        r->centre.x[a] = 0.5 * (double)(r->hi[a] + r->lo[a]) * r->scale.x[a];
    }
    r->up = axis[2];
    r->forward = vec_unit(vec_add(vec_add(vec_add(vec_make(0, 0, 0), -0.386, axis[0]), 0.828, axis[1]),
                                  -0.407, axis[2]));
    r->right = vec_unit(vec_cross(r->forward, r->up));
    r->top = vec_cross(r->right, r->forward);
    r->sun = vec_unit(vec_add(vec_add(vec_add(vec_make(0, 0, 0), -0.55, axis[0]), -0.42, axis[1]), 1.0,
                              axis[2]));
    r->sun_side[0] = vec_unit(vec_cross(r->sun, r->up));
    r->sun_side[1] = vec_cross(r->sun, r->sun_side[0]);
    for (i = 0; i < 8; i++) {
        vec corner = box;
        for (a = 0; a < 3; a++) {
            corner.x[a] *= i >> a & 1 ? 1 : -1;
        }
        width = fmax(width, fabs(vec_dot(corner, r->right)));
        height = fmax(height, fabs(vec_dot(corner, r->top)));
        least = fmin(least, vec_dot(corner, r->up));
    }
    r->ground = vec_dot(r->centre, r->up) + least;
    r->units = fmax(2 * width / (0.92 * RENDER_WIDTH), 2 * height / (0.88 * RENDER_HEIGHT));
}

/* sRGB of a light, by a table of 4096 steps: 0.0002 apart, less than a tenth of the least step in sRGB's bytes
   from 1/64 of white on. */
static inline void render_bytes_make(render *r) {
    int i;
    for (i = 0; i <= RENDER_LIGHTS; i++) {
        double v = (double)i / RENDER_LIGHTS;
        v = v < 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
        r->byte[i] = (unsigned char)(255 * v + 0.5);
    }
}

static inline unsigned char render_byte(const render *r, double light) {
    return r->byte[light <= 0 ? 0 : light >= 1 ? RENDER_LIGHTS : (int)(light * RENDER_LIGHTS + 0.5)];
}

/* Where corners and steps lie in the picture, in samples. */
static inline void render_project(render *r) {
    vec zero = vec_add(vec_make(0, 0, 0), -1, r->centre);
    double fine = RENDER_FINE / r->units;
    int a;
    for (r->block = 0; r->units > 0.7 * (1 << r->block); r->block++) {
    }
    r->start[0] = fine * vec_dot(zero, r->right) + RENDER_COLUMNS / 2.0 - 0.5;
    r->start[1] = RENDER_ROWS / 2.0 - 0.5 - fine * vec_dot(zero, r->top);
    r->start[2] = vec_dot(zero, r->forward);
    for (a = 0; a < 3; a++) {
        r->step[a][0] = fine * r->scale.x[a] * r->right.x[a];
        r->step[a][1] = -fine * r->scale.x[a] * r->top.x[a];
        r->step[a][2] = r->scale.x[a] * r->forward.x[a];
    }
    for (a = 0; a < 3; a++) {
        const double *b = r->step[(a + 1) % 3];
        const double *c = r->step[(a + 2) % 3];
        double area = b[0] * c[1] - b[1] * c[0];
        r->side[a].to_b[0] = c[1] / area;
        r->side[a].to_b[1] = -c[0] / area;
        r->side[a].to_c[0] = -b[1] / area;
        r->side[a].to_c[1] = b[0] / area;
    }
}

/* Column, row and depth of a corner. */
static inline void render_place(const render *r, const size_t at[3], double out[3]) {
    int k;
    for (k = 0; k < 3; k++) {
        out[k] = r->start[k] + (double)at[0] * r->step[0][k] + (double)at[1] * r->step[1][k] + (double)at[2] * r->step[2][k];
    }
}

/* Draws a voxel's face across axis a: the samples in its parallelogram that nothing nearer covers. Its border belongs
   to it, so that no sample slips between two faces. */
static inline void render_draw(render *r, const size_t voxel[3], int a) {
    const double *b = r->step[(a + 1) % 3];
    const double *c = r->step[(a + 2) % 3];
    const render_side *side = &r->side[a];
    const double slack = 1e-6;
    size_t at[3];
    double p[3];
    double column_lo;
    double column_hi;
    double row_lo;
    double row_hi;
    uint64_t key = ((uint64_t)voxel[2] * r->v->n[1] + voxel[1]) * r->v->n[0] + voxel[0];
    int row;
    int column;
    memcpy(at, voxel, sizeof at);
    at[a] += r->forward.x[a] > 0 ? 0 : 1;
    render_place(r, at, p);
    key = 4 * key + (uint64_t)a + 1;
    column_lo = p[0] + fmin(b[0], 0) + fmin(c[0], 0);
    column_hi = p[0] + fmax(b[0], 0) + fmax(c[0], 0);
    row_lo = p[1] + fmin(b[1], 0) + fmin(c[1], 0);
    row_hi = p[1] + fmax(b[1], 0) + fmax(c[1], 0);
    for (row = (int)ceil(row_lo - slack); row <= row_hi + slack; row++) {
        for (column = (int)ceil(column_lo - slack); column <= column_hi + slack; column++) {
            double x = column - p[0];
            double y = row - p[1];
            double u = side->to_b[0] * x + side->to_b[1] * y;
            double v = side->to_c[0] * x + side->to_c[1] * y;
            size_t i = (size_t)row * RENDER_COLUMNS + (size_t)column;
            float depth = (float)(p[2] + u * b[2] + v * c[2]);
            if (u >= -slack && u <= 1 + slack && v >= -slack && v <= 1 + slack
                && (r->seen[i] == 0 || depth < r->depth[i])) {
                r->seen[i] = key;
                r->depth[i] = depth;
            }
        }
    }
}

/* Draws the exposed faces of a word of voxels that look at the camera. */
static inline void render_draw_word(render *r, size_t word, size_t y, size_t z) {
    const uint64_t *row = voxels_row(r->v, y, z);
    const uint64_t bits = row[word];
    int up[3];
    int a;
    for (a = 0; a < 3; a++) {
        up[a] = r->forward.x[a] <= 0;
    }
    for (a = 0; a < 3; a++) {
        uint64_t covered = 0;
        uint64_t open;
        if (a == 0) {
            covered = up[0] ? bits >> 1 | (word + 1 < r->v->row_words ? row[word + 1] << 63 : 0)
                            : bits << 1 | (word > 0 ? row[word - 1] >> 63 : 0);
        } else if (a == 1 && (up[1] ? y + 1 < r->v->n[1] : y > 0)) {
            covered = voxels_row(r->v, up[1] ? y + 1 : y - 1, z)[word];
        } else if (a == 2 && (up[2] ? z + 1 < r->v->n[2] : z > 0)) {
            covered = voxels_row(r->v, y, up[2] ? z + 1 : z - 1)[word];
        }
        for (open = bits & ~covered; open; open &= open - 1) {
            size_t voxel[3];
            voxel[0] = 64 * word + voxels_lowest(open);
            voxel[1] = y;
            voxel[2] = z;
            render_draw(r, voxel, a);
        }
    }
}

static inline void render_draw_all(render *r) {
    size_t word;
    size_t y;
    size_t z;
    for (z = r->lo[2]; z < r->hi[2]; z++) {
        for (y = r->lo[1]; y < r->hi[1]; y++) {
            for (word = r->lo[0] / 64; word <= (r->hi[0] - 1) / 64; word++) {
                if (voxels_row(r->v, y, z)[word]) {
                    render_draw_word(r, word, y, z);
                }
            }
        }
    }
}

enum { RENDER_FLOOR_COLUMNS = RENDER_WIDTH / RENDER_FLOOR + 1, RENDER_FLOOR_ROWS = RENDER_HEIGHT / RENDER_FLOOR + 1 };

static inline void render_light_floor(render *r) {
    int x;
    int y;
    for (y = 0; y < RENDER_FLOOR_ROWS; y++) {
        for (x = 0; x < RENDER_FLOOR_COLUMNS; x++) {
            r->floor[y * RENDER_FLOOR_COLUMNS + x] = render_shade_floor(r, x * RENDER_FLOOR, y * RENDER_FLOOR);
        }
    }
}

/* The floor between the points where it is lit. */
static inline vec render_floor_at(const render *r, double x, double y) {
    int i = (int)(x / RENDER_FLOOR);
    int j = (int)(y / RENDER_FLOOR);
    double u = x / RENDER_FLOOR - i;
    double v = y / RENDER_FLOOR - j;
    const vec *p = &r->floor[j * RENDER_FLOOR_COLUMNS + i];
    vec sum = vec_make(0, 0, 0);
    sum = vec_add(sum, (1 - u) * (1 - v), p[0]);
    sum = vec_add(sum, u * (1 - v), p[1]);
    sum = vec_add(sum, (1 - u) * v, p[RENDER_FLOOR_COLUMNS]);
    return vec_add(sum, u * v, p[RENDER_FLOOR_COLUMNS + 1]);
}

/* A place on a face. */
typedef struct render_spot {
    size_t voxel[3];
    int    axis;
    double b;               /* along the two axes after its own, 0 to 1 */
    double c;
    vec    outward;
    vec    point;
} render_spot;

static inline void render_spot_set(render_spot *s, const render *r, uint64_t key, double column, double row) {
    uint64_t index = (key - 1) / 4;
    size_t at[3];
    double p[3];
    int a;
    s->axis = (int)((key - 1) % 4);
    s->voxel[0] = (size_t)(index % r->v->n[0]);
    s->voxel[1] = (size_t)(index / r->v->n[0] % r->v->n[1]);
    s->voxel[2] = (size_t)(index / r->v->n[0] / r->v->n[1]);
    s->outward = vec_make(0, 0, 0);
    s->outward.x[s->axis] = r->forward.x[s->axis] > 0 ? -1 : 1;
    memcpy(at, s->voxel, sizeof at);
    at[s->axis] += s->outward.x[s->axis] > 0 ? 1 : 0;
    render_place(r, at, p);
    s->b = r->side[s->axis].to_b[0] * (column - p[0]) + r->side[s->axis].to_b[1] * (row - p[1]);
    s->c = r->side[s->axis].to_c[0] * (column - p[0]) + r->side[s->axis].to_c[1] * (row - p[1]);
    for (a = 0; a < 3; a++) {
        double in = a == s->axis ? 0 : a == (s->axis + 1) % 3 ? s->b : s->c;
        s->point.x[a] = ((double)at[a] + in) * r->scale.x[a];
    }
}

static inline vec render_spot_shade(const render_spot *s, const render *r, uint64_t key) {
    const vec *smooth = render_visit_normal(r, (key - 1) / 4, s->voxel);
    const render_light *light = render_visit_light(r, s->voxel, s->axis, s->outward, *smooth);
    return render_shade_face(r, light, *smooth, s->outward, s->b, s->c, s->point);
}

/* The dark line round a face, where faces are large: less than 1 within a pixel of the border. */
static inline double render_line(const render *r, int axis, double b, double c) {
    double border = fmin(fmin(b, 1 - b) * r->scale.x[(axis + 1) % 3], fmin(c, 1 - c) * r->scale.x[(axis + 2) % 3]);
    return r->units < 0.25 && border < 0.7 * r->units + 0.02 ? 0.78 : 1;
}

/* A pixel of one face is shaded once; its line is that of the four samples. */
static inline vec render_pixel(const render *r, int x, int y) {
    const double weight = 1.0 / (RENDER_FINE * RENDER_FINE);
    const uint64_t *seen = &r->seen[(size_t)(RENDER_FINE * y) * RENDER_COLUMNS + (size_t)(RENDER_FINE * x)];
    int one = seen[0] == seen[1] && seen[0] == seen[RENDER_COLUMNS] && seen[0] == seen[RENDER_COLUMNS + 1];
    vec sum = vec_make(0, 0, 0);
    render_spot s;
    int i;
    if (one && seen[0] == 0) {
        return render_floor_at(r, x + 0.5, y + 0.5);
    }
    if (one) {
        double line = 0;
        render_spot_set(&s, r, seen[0], RENDER_FINE * x + 0.5, RENDER_FINE * y + 0.5);
        for (i = 0; i < 4; i++) {
            double dx = i % 2 - 0.5;
            double dy = i / 2 - 0.5;
            line += weight * render_line(r, s.axis, s.b + r->side[s.axis].to_b[0] * dx + r->side[s.axis].to_b[1] * dy,
                                         s.c + r->side[s.axis].to_c[0] * dx + r->side[s.axis].to_c[1] * dy);
        }
        return vec_add(sum, line, render_spot_shade(&s, r, seen[0]));
    }
    for (i = 0; i < RENDER_FINE * RENDER_FINE; i++) {
        int column = RENDER_FINE * x + i % RENDER_FINE;
        int row = RENDER_FINE * y + i / RENDER_FINE;
        uint64_t key = r->seen[(size_t)row * RENDER_COLUMNS + (size_t)column];
        if (key == 0) {
            sum = vec_add(sum, weight, render_floor_at(r, x + 0.5, y + 0.5));
        } else {
            render_spot_set(&s, r, key, column, row);
            sum = vec_add(sum, weight * render_line(r, s.axis, s.b, s.c), render_spot_shade(&s, r, key));
        }
    }
    return sum;
}

static inline void render_pixels(const render *r, unsigned char *pixels) {
    progress p = progress_begin("picture");
    int x;
    int y;
    int a;
    for (y = 0; y < RENDER_HEIGHT; y++) {
        for (x = 0; x < RENDER_WIDTH; x++) {
            vec sum = render_pixel(r, x, y);
            for (a = 0; a < 3; a++) {
                pixels[3 * (RENDER_WIDTH * y + x) + a] = render_byte(r, sum.x[a]);
            }
        }
        progress_show(&p, y, RENDER_HEIGHT);
    }
    progress_end(&p);
}

static inline int render_memory(render *r) {
    const size_t samples = (size_t)RENDER_COLUMNS * RENDER_ROWS;
    r->brick = (unsigned char *)calloc(r->bricks[0] * r->bricks[1] * r->bricks[2], 1);
    r->lights = (render_light *)calloc(RENDER_CACHE, sizeof *r->lights);
    r->normals = (render_normal *)calloc(RENDER_CACHE, sizeof *r->normals);
    r->seen = (uint64_t *)calloc(samples, sizeof *r->seen);
    r->depth = (float *)malloc(samples * sizeof *r->depth);
    r->floor = (vec *)malloc(sizeof(vec) * RENDER_FLOOR_COLUMNS * RENDER_FLOOR_ROWS);
    return r->brick && r->lights && r->normals && r->seen && r->depth && r->floor;
}

/* Writes a picture of the voxels, with the mesh axis `up` ('x', 'y' or 'z') upwards. */
static inline int render_write(const char *path, const voxels *v, char up, char *error) {
    unsigned char *pixels = (unsigned char *)malloc(3 * (size_t)RENDER_WIDTH * RENDER_HEIGHT);
    render r;
    int ok;
    int a;
    memset(&r, 0, sizeof r);
    r.v = v;
    for (a = 0; a < 3; a++) {
        r.bricks[a] = (v->n[a] + RENDER_BRICK - 1) / RENDER_BRICK;
    }
    if (!render_memory(&r) || !pixels) {
        ok = voxels_fail(path, "out of memory", error);
    } else if (!render_mark_bricks(&r)) {
        ok = voxels_fail(path, "no voxel is set, so there is nothing to draw", error);
    } else {
        render_aim(&r, up);
        render_bytes_make(&r);
        render_project(&r);
        render_draw_all(&r);
        render_light_floor(&r);
        render_pixels(&r, pixels);
        ok = png_write(path, pixels, RENDER_WIDTH, RENDER_HEIGHT, error);
    }
    free(pixels);
    free(r.brick);
    free(r.lights);
    free(r.normals);
    free(r.seen);
    free(r.depth);
    free(r.floor);
    return ok;
}

#endif /* EXAMPLES_RENDER_H */
