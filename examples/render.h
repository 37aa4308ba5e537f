/* render.h - a shaded picture of voxels: rays through the bit array, sun with soft shadows, sky with
 * occlusion
 *
 * Parallel projection from front right above, four rays a pixel. A ray walks bricks of 8x8x8 voxels and
 * goes into a brick only if a voxel in it is set [Amanatides and Woo, A fast voxel traversal algorithm,
 * 1987], so the time depends on the picture's size far more than on the grid's. Lengths are in voxels of
 * the largest side ("units").
 */
#ifndef EXAMPLES_RENDER_H
#define EXAMPLES_RENDER_H
#include "png.h"

enum { RENDER_WIDTH = 1280, RENDER_HEIGHT = 960, RENDER_BRICK = 8, RENDER_CACHE = 1 << 16 };
enum { RENDER_SKY = 24, RENDER_SAMPLES = 16 };          /* rays to the sky a face, parts of the sun */

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

/* What a visible voxel face needs that doesn't change over the face. */
typedef struct render_face {
    size_t key;             /* 6 * voxel + face + 1; 0: empty */
    double open_sky;        /* part of the sky that it sees */
    vec    normal;          /* of the surface around it */
} render_face;

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
    render_face   *cache;
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

/* The surface's normal: exposed faces that look at the camera, counted around the voxel, stand for its
   components. */
static inline vec render_smooth_normal(const render *r, const size_t voxel[3]) {
    enum { REACH = 3 };
    vec sum = vec_make(0, 0, 0);
    long step[3];
    int a;
    long at[3];
    for (a = 0; a < 3; a++) {
        step[a] = r->forward.x[a] > 0 ? -1 : 1;
    }
    for (at[2] = -REACH; at[2] <= REACH; at[2]++) {
        for (at[1] = -REACH; at[1] <= REACH; at[1]++) {
            for (at[0] = -REACH; at[0] <= REACH; at[0]++) {
                long distance = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
                size_t cell[3];
                for (a = 0; a < 3; a++) {
                    cell[a] = (size_t)((long)voxel[a] + at[a]);
                }
                if (distance > REACH * REACH || !voxels_get(r->v, cell[0], cell[1], cell[2])) {
                    continue;
                }
                for (a = 0; a < 3; a++) {
                    cell[a] += (size_t)step[a];
                    if (!voxels_get(r->v, cell[0], cell[1], cell[2])) {
                        sum.x[a] += (double)step[a] * (REACH * REACH + 2 - (double)distance);
                    }
                    cell[a] -= (size_t)step[a];
                }
            }
        }
    }
    return vec_unit(sum);
}

static inline const render_face *render_visit_face(const render *r, const render_hit *hit, vec outward) {
    const size_t *c = hit->voxel;
    size_t voxel = (c[2] * r->v->n[1] + c[1]) * r->v->n[0] + c[0];
    size_t key = 6 * voxel + 2 * (size_t)hit->axis + (outward.x[hit->axis] > 0) + 1;
    render_face *face = &r->cache[key * 0x9e3779b1u % RENDER_CACHE];
    vec middle;
    int a;
    if (face->key != key) {
        for (a = 0; a < 3; a++) {
            middle.x[a] = ((double)c[a] + 0.5 + 0.51 * outward.x[a]) * r->scale.x[a];
        }
        face->key = key;
        face->open_sky = render_open_sky(r, middle, outward, RENDER_SKY, 0);
        face->normal = render_smooth_normal(r, hit->voxel);
    }
    return face;
}

/* 1 if the sun is seen. The 16 rays of 2x2 pixels ask 16 parts of its disc, so that shadows have soft
   borders. */
static inline double render_sun_seen(const render *r, vec point, int sample) {
    double radius = 0.045 * sqrt((sample + 0.5) / RENDER_SAMPLES);
    double angle = 2.399963229728653 * sample;
    render_hit hit;
    vec d = vec_add(vec_add(r->sun, radius * cos(angle), r->sun_side[0]), radius * sin(angle),
                    r->sun_side[1]);
    return render_trace(r, point, d, HUGE_VAL, &hit) ? 0 : 1;
}

/* How near the point is to the border of its voxel's face, 0 at the border, in units. */
static inline double render_border(const render *r, const render_hit *hit, vec point) {
    double least = 1;
    int a;
    for (a = 0; a < 3; a++) {
        double in = point.x[a] / r->scale.x[a] - (double)hit->voxel[a];
        double distance = (in < 0.5 ? in : 1 - in) * r->scale.x[a];
        if (a != hit->axis && distance < least) {
            least = distance;
        }
    }
    return least;
}

static inline vec render_shade_voxel(const render *r, const render_hit *hit, vec point, int sample) {
    double pixels = 1 / r->units;                               /* a voxel's side in the picture */
    double flat = pixels > 8 ? 0.55 : pixels > 2 ? 0.25 + 0.05 * (pixels - 2) : 0.25;
    vec outward = vec_make(0, 0, 0);
    const render_face *face;
    vec normal;
    vec colour;
    double height;
    double sun;
    double sky;
    double shine;
    int a;
    outward.x[hit->axis] = r->forward.x[hit->axis] > 0 ? -1 : 1;
    face = render_visit_face(r, hit, outward);
    normal = vec_unit(vec_add(vec_add(vec_make(0, 0, 0), flat, outward), 1 - flat, face->normal));
    sun = vec_dot(normal, r->sun);
    if (sun > 0) {      /* from a little above, so that the steps of the surface don't shade each other */
        sun *= render_sun_seen(r, vec_add(vec_add(point, 0.05, outward), 1.2, face->normal), sample);
    }
    sun = sun > 0 ? sun : 0;
    sky = (0.6 + 0.4 * vec_dot(normal, r->up)) * face->open_sky;
    shine = vec_dot(face->normal, vec_unit(vec_add(r->sun, -1, r->forward)));
    shine = sun > 0 && shine > 0 ? 0.25 * pow(shine, 40) : 0;
    height = (vec_dot(point, r->up) - r->ground) / (2 * (vec_dot(r->centre, r->up) - r->ground) + 1e-9);
    colour = vec_make(0.80 + 0.08 * height, 0.23 + 0.17 * height, 0.07 + 0.08 * height);
    for (a = 0; a < 3; a++) {
        static const double sunlight[3] = {0.92, 0.85, 0.74};
        static const double skylight[3] = {0.36, 0.41, 0.50};
        static const double bounce[3] = {0.06, 0.05, 0.045};
        colour.x[a] = colour.x[a] * (sun * sunlight[a] + sky * skylight[a] + bounce[a]) + shine;
        if (pixels > 4 && render_border(r, hit, point) < 0.7 * r->units + 0.02) {
            colour.x[a] *= 0.78;
        }
    }
    return colour;
}

/* The floor, which fades into the backdrop, or the backdrop alone. */
static inline vec render_shade_floor(const render *r, vec origin, double picture_height, int sample) {
    vec backdrop = vec_add(vec_make(0.66, 0.70, 0.76), picture_height, vec_make(0.16, 0.15, 0.13));
    double t = (r->ground - vec_dot(origin, r->up)) / vec_dot(r->forward, r->up);
    vec point = vec_add(origin, t, r->forward);
    vec away = vec_add(point, -1, r->centre);
    double reach = 3 * render_reach(r);
    double light;
    int a;
    double fade = exp(-vec_dot(away, away) / (14 * reach * reach));
    point = vec_add(point, 0.01, r->up);
    if (fade < 0.01) {
        return backdrop;
    }
    light = 0.55 * render_sun_seen(r, point, sample)
        + 0.45 * render_open_sky(r, point, r->up, 8, 0.37 * sample);
    for (a = 0; a < 3; a++) {
        backdrop.x[a] *= 1 - fade * (1 - light) * 0.85;
    }
    return backdrop;
}

static inline vec render_ray(const render *r, double x, double y, int sample) {
    double far = 4 * render_reach(r) / 0.15;
    vec origin = vec_add(vec_add(vec_add(r->centre, r->units * (x - RENDER_WIDTH / 2.0), r->right),
                                 r->units * (RENDER_HEIGHT / 2.0 - y), r->top), -far, r->forward);
    render_hit hit;
    if (render_trace(r, origin, r->forward, HUGE_VAL, &hit)) {
        return render_shade_voxel(r, &hit, vec_add(origin, hit.t, r->forward), sample);
    }
    return render_shade_floor(r, origin, 1 - y / RENDER_HEIGHT, sample);
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

static inline unsigned char render_byte(double light) {
    double v = light <= 0 ? 0 : light >= 1 ? 1 : light;
    v = v < 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;        /* sRGB */
    return (unsigned char)(255 * v + 0.5);
}

static inline void render_pixels(const render *r, unsigned char *pixels) {
    int x;
    int y;
    int sample;
    int a;
    for (y = 0; y < RENDER_HEIGHT; y++) {
        for (x = 0; x < RENDER_WIDTH; x++) {
            vec sum = vec_make(0, 0, 0);
            for (sample = 0; sample < 4; sample++) {
                int spread = (4 * sample + x % 2 * 5 + y % 2 * 10) % RENDER_SAMPLES;
                double dx = 0.25 + 0.5 * (sample % 2);
                double dy = 0.25 + 0.5 * (sample / 2);
                sum = vec_add(sum, 0.25, render_ray(r, x + dx, y + dy, spread));
            }
            for (a = 0; a < 3; a++) {
                pixels[3 * (RENDER_WIDTH * y + x) + a] = render_byte(sum.x[a]);
            }
        }
    }
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
    r.brick = (unsigned char *)calloc(r.bricks[0] * r.bricks[1] * r.bricks[2], 1);
    r.cache = (render_face *)calloc(RENDER_CACHE, sizeof *r.cache);
    if (!pixels || !r.brick || !r.cache) {
        ok = voxels_fail(path, "out of memory", error);
    } else if (!render_mark_bricks(&r)) {
        ok = voxels_fail(path, "no voxel is set, so there is nothing to draw", error);
    } else {
        render_aim(&r, up);
        render_pixels(&r, pixels);
        ok = png_write(path, pixels, RENDER_WIDTH, RENDER_HEIGHT, error);
    }
    free(pixels);
    free(r.brick);
    free(r.cache);
    return ok;
}

#endif /* EXAMPLES_RENDER_H */
