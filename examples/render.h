/* render.h - a shaded picture of voxels: sun with soft shadows, sky with occlusion
 *
 * Parallel projection from front right above, four samples a pixel. The exposed faces that look at the camera are
 * drawn into a depth buffer, all of one direction being the same parallelogram; each face that is seen is lit once,
 * by rays, or where faces are smaller than a pixel each block of voxels. A ray walks crates of 8x8x8 bricks of 8x8x8
 * voxels, and goes into one only if a voxel in it is set [Amanatides and Woo, A fast voxel traversal algorithm,
 * 1987]. The floor is lit at every eighth pixel. Lengths are in voxels of the largest side ("units").
 */
#ifndef EXAMPLES_RENDER_H
#define EXAMPLES_RENDER_H
#include "png.h"
#include "progress.h"

enum { RENDER_WIDTH = 1280, RENDER_HEIGHT = 960, RENDER_CACHE = 1 << 18 };
enum { RENDER_FINE = 2 };                               /* samples of a pixel, each way */
enum { RENDER_COLUMNS = RENDER_FINE * RENDER_WIDTH, RENDER_ROWS = RENDER_FINE * RENDER_HEIGHT };
enum { RENDER_LIGHTS = 4096, RENDER_RAYS = 24 };
enum { RENDER_VOXELS, RENDER_BRICKS, RENDER_CRATES, RENDER_LEVELS };
enum { RENDER_REACH = 3 };                              /* voxels around one that make its normal */
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
    double lo[2];           /* from the first corner to the least column and row, and to the largest */
    double hi[2];
} render_side;

typedef struct render {
    const voxels  *v;
    unsigned char *cell[RENDER_LEVELS];         /* bricks and crates; 1: a voxel in it is set */
    size_t         cells[RENDER_LEVELS][3];     /* how many there are; of voxels, too */
    double         spiral[RENDER_RAYS][2];      /* cosine and sine of multiples of the golden angle */
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
    unsigned char  weight[RENDER_REACH * RENDER_REACH + 1][1 << (2 * RENDER_REACH + 1)];     /* see render_weights_make */
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

/* A ray in index coordinates, and where it ends. */
typedef struct render_ray {
    vec    o;
    vec    d;
    vec    inverse;         /* 1 / d; where d is 0, not used */
    double t1;
} render_ray;

/* A walk of a ray through cells of one size. */
typedef struct render_walk {
    long   cell[3];
    int    step[3];
    double next[3];         /* t at which each axis leaves the cell */
    double delta[3];
    double t;
    int    axis;            /* crossed last */
} render_walk;

static inline void walk_begin(render_walk *w, const render_ray *ray, double t, int level, const long lo[3],
                              const long hi[3], int axis) {
    const double side = (double)(1 << 3 * level);
    const double cells = 1 / side;                      /* a power of two, so nothing rounds */
    int a;
    w->t = t;
    w->axis = axis;
    for (a = 0; a < 3; a++) {
        double d = ray->d.x[a];
        double at = (ray->o.x[a] + t * d) * cells;
        w->cell[a] = at < (double)lo[a] ? lo[a] : at >= (double)hi[a] ? hi[a] - 1 : (long)at;
        w->step[a] = d > 0 ? 1 : -1;
        w->next[a] = d == 0 ? HUGE_VAL : (side * (double)(w->cell[a] + (d > 0)) - ray->o.x[a]) * ray->inverse.x[a];
        w->delta[a] = d == 0 ? 0 : side * fabs(ray->inverse.x[a]);
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

/* The part of the ray in the box of set voxels: moves t0 and t1; 0 if it misses. */
static inline int render_enter(const render *r, render_ray *ray, double *t0, int *axis) {
    int a;
    *axis = 0;
    for (a = 0; a < 3; a++) {
        double d = ray->d.x[a];
        double o = ray->o.x[a];
        double near;
        double far;
        if (d == 0) {
            if (o < (double)r->lo[a] || o > (double)r->hi[a]) {
                return 0;
            }
            continue;
        }
        near = ((double)(d > 0 ? r->lo[a] : r->hi[a]) - o) * ray->inverse.x[a];
        far = ((double)(d > 0 ? r->hi[a] : r->lo[a]) - o) * ray->inverse.x[a];
        if (near > *t0) {
            *t0 = near;
            *axis = a;
        }
        ray->t1 = far < ray->t1 ? far : ray->t1;
    }
    return *t0 <= ray->t1;
}

/* Does the ray meet a set voxel in this brick? */
static inline int render_walk_brick(const render *r, const render_ray *ray, const render_walk *outer, render_hit *hit) {
    long lo[3];
    long hi[3];
    render_walk w;
    int a;
    for (a = 0; a < 3; a++) {
        lo[a] = outer->cell[a] * 8;
        hi[a] = lo[a] + 8 < (long)r->v->n[a] ? lo[a] + 8 : (long)r->v->n[a];
    }
    walk_begin(&w, ray, outer->t, RENDER_VOXELS, lo, hi, outer->axis);
    for (; walk_inside(&w, lo, hi) && w.t <= ray->t1; walk_step(&w)) {
        const uint64_t *row = voxels_row(r->v, (size_t)w.cell[1], (size_t)w.cell[2]);
        if (row[w.cell[0] >> 6] >> (w.cell[0] & 63) & 1) {
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

static inline int render_cell(const render *r, int level, const render_walk *w) {
    const size_t *n = r->cells[level];
    return r->cell[level][((size_t)w->cell[2] * n[1] + (size_t)w->cell[1]) * n[0] + (size_t)w->cell[0]];
}

static inline int render_walk_crate(const render *r, const render_ray *ray, const render_walk *outer, render_hit *hit) {
    long lo[3];
    long hi[3];
    render_walk w;
    int a;
    for (a = 0; a < 3; a++) {
        lo[a] = outer->cell[a] * 8;
        hi[a] = lo[a] + 8 < (long)r->cells[RENDER_BRICKS][a] ? lo[a] + 8 : (long)r->cells[RENDER_BRICKS][a];
    }
    walk_begin(&w, ray, outer->t, RENDER_BRICKS, lo, hi, outer->axis);
    for (; walk_inside(&w, lo, hi) && w.t <= ray->t1; walk_step(&w)) {
        if (render_cell(r, RENDER_BRICKS, &w) && render_walk_brick(r, ray, &w, hit)) {
            return 1;
        }
    }
    return 0;
}

/* The first set voxel on the ray origin + t * direction (in units), 0 <= t <= t1. */
static inline int render_trace(const render *r, vec origin, vec direction, double t1, render_hit *hit) {
    static const long zero[3] = {0, 0, 0};
    double t0 = 0;
    render_ray ray;
    render_walk w;
    long crates[3];
    int axis;
    int a;
    for (a = 0; a < 3; a++) {
        ray.o.x[a] = origin.x[a] / r->scale.x[a];
        ray.d.x[a] = direction.x[a] / r->scale.x[a];
        ray.inverse.x[a] = ray.d.x[a] == 0 ? 0 : 1 / ray.d.x[a];
        crates[a] = (long)r->cells[RENDER_CRATES][a];
    }
    ray.t1 = t1;
    if (!render_enter(r, &ray, &t0, &axis)) {
        return 0;
    }
    walk_begin(&w, &ray, t0, RENDER_CRATES, zero, crates, axis);
    for (; walk_inside(&w, zero, crates) && w.t <= ray.t1; walk_step(&w)) {
        if (render_cell(r, RENDER_CRATES, &w) && render_walk_crate(r, &ray, &w, hit)) {
            return 1;
        }
    }
    return 0;
}

/* ---- 2. Light -------------------------------------------------------------------------------- */

/* A unit vector i of `count`, spread evenly over the half sphere around `normal` and denser towards it (by
   the cosine): a spiral by the golden angle. */
static inline vec render_sky_direction(const render *r, vec normal, int i, int count) {
    double height = sqrt((i + 0.5) / count);
    double radius = sqrt(1 - height * height);
    vec a = vec_unit(vec_cross(normal, fabs(normal.x[0]) < 0.7 ? vec_make(1, 0, 0) : vec_make(0, 1, 0)));
    vec b = vec_cross(normal, a);
    return vec_add(vec_add(vec_make(height * normal.x[0], height * normal.x[1], height * normal.x[2]),
                           radius * r->spiral[i][0], a), radius * r->spiral[i][1], b);
}

static inline double render_reach(const render *r) {
    size_t longest = r->hi[0] - r->lo[0];
    longest = r->hi[1] - r->lo[1] > longest ? r->hi[1] - r->lo[1] : longest;
    longest = r->hi[2] - r->lo[2] > longest ? r->hi[2] - r->lo[2] : longest;
    return 4 + 0.15 * (double)longest;
}

/* How much of the sky a point sees, far things counting less. */
static inline double render_open_sky(const render *r, vec point, vec normal, int count) {
    double reach = render_reach(r);
    double open = 0;
    int i;
    for (i = 0; i < count; i++) {
        render_hit hit;
        vec d = render_sky_direction(r, normal, i, count);
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

/* What the voxels of a row count for the normal of the one at its middle: the nearer the more, none beyond
 * RENDER_REACH. Of 7 bits, and by the square of the row's distance. */
static inline void render_weights_make(render *r) {
    int square;
    int x;
    unsigned bits;
    for (square = 0; square <= RENDER_REACH * RENDER_REACH; square++) {
        for (bits = 0; bits < 1u << (2 * RENDER_REACH + 1); bits++) {
            int sum = 0;
            for (x = -RENDER_REACH; x <= RENDER_REACH; x++) {
                int distance = x * x + square;
                int counts = distance <= RENDER_REACH * RENDER_REACH ? (int)(bits >> (x + RENDER_REACH) & 1u) : 0;
                sum += counts * (RENDER_REACH * RENDER_REACH + 2 - distance);
            }
            r->weight[square][bits] = (unsigned char)sum;
        }
    }
}

/* The surface's normal: exposed faces that look at the camera, counted around the voxel, stand for its
   components. */
static inline vec render_smooth_normal(const render *r, const size_t voxel[3]) {
    enum { SIDE = 2 * RENDER_REACH + 3, BITS = (1 << (2 * RENDER_REACH + 1)) - 1 };
    unsigned window[SIDE][SIDE];        /* of the rows around it, one more on each side */
    int sum[3] = {0, 0, 0};
    int step[3];
    int a;
    int y;
    int z;
    for (a = 0; a < 3; a++) {
        step[a] = r->forward.x[a] > 0 ? -1 : 1;
    }
    for (z = 0; z < SIDE; z++) {
        for (y = 0; y < SIDE; y++) {
            window[z][y] = render_window(r, voxel[0], voxel[1] + (size_t)y - RENDER_REACH - 1,
                                         voxel[2] + (size_t)z - RENDER_REACH - 1);
        }
    }
    for (z = -RENDER_REACH; z <= RENDER_REACH; z++) {
        for (y = -RENDER_REACH; y <= RENDER_REACH; y++) {
            const unsigned *row = &window[z + RENDER_REACH + 1][y + RENDER_REACH + 1];
            const unsigned set = *row;
            const unsigned char *weight;
            if (y * y + z * z > RENDER_REACH * RENDER_REACH || set == 0) {
                continue;
            }
            weight = r->weight[y * y + z * z];
            sum[0] += weight[(set & ~(step[0] > 0 ? set >> 1 : set << 1)) >> 1 & BITS];
            sum[1] += weight[(set & ~row[step[1]]) >> 1 & BITS];
            sum[2] += weight[(set & ~row[step[2] * SIDE]) >> 1 & BITS];
        }
    }
    return vec_unit(vec_make(sum[0] * step[0], sum[1] * step[1], sum[2] * step[2]));
}

/* Kept for the samples that follow; where voxels are much smaller than a pixel, a cube of them has one normal. */
static inline const vec *render_visit_normal(const render *r, const size_t voxel[3]) {
    int few = r->block;
    uint64_t key = ((voxel[2] >> few) * (uint64_t)r->v->n[1] + (voxel[1] >> few)) * r->v->n[0] + (voxel[0] >> few) + 1;
    render_normal *n = &r->normals[key * 0x9e3779b97f4a7c15u >> 46];
    if (n->key != key) {
        n->key = key;
        n->normal = render_smooth_normal(r, voxel);
    }
    return &n->normal;
}

/* 1 if the sun is seen. The rays ask parts of its disc, so that shadows have soft borders. */
static inline double render_sun_seen(const render *r, vec point, int sample, int samples) {
    double radius = 0.045 * sqrt((sample + 0.5) / samples);
    render_hit hit;
    vec d = vec_add(vec_add(r->sun, radius * r->spiral[sample][0], r->sun_side[0]), radius * r->spiral[sample][1],
                    r->sun_side[1]);
    return render_trace(r, point, d, HUGE_VAL, &hit) ? 0 : 1;
}

/* The part of the sun seen from a point, by `rays` of its disc; some at its rim first, and the others where these
   differ. */
static inline double render_sun_part(const render *r, vec point, int rays, int first) {
    double seen = 0;
    int i;
    for (i = rays - 1; i >= 0; i--) {
        seen += render_sun_seen(r, point, i, rays);
        if (i == rays - first && (seen < 0.5 || seen > first - 0.5)) {
            return seen / first;
        }
    }
    return seen / rays;
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

/* The light on a face: large faces are lit with more rays, and the sun at their corners. */
static inline void render_light_face(const render *r, render_light *light, const size_t voxel[3], int axis, vec outward,
                                     vec normal) {
    double pixels = 1 / r->units;
    vec middle;
    int i;
    for (i = 0; i < 3; i++) {
        middle.x[i] = ((double)voxel[i] + 0.5 + 0.51 * outward.x[i]) * r->scale.x[i];
    }
    light->open_sky = render_open_sky(r, middle, outward, pixels > 4 ? RENDER_RAYS : pixels > 1.5 ? 12 : 6);
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
}

/* Where the light of a block of voxels, 2^log2 each way, is kept; `kind` 0 to 2: of faces across that axis. */
static inline render_light *render_slot(const render *r, const size_t voxel[3], int log2, unsigned kind, uint64_t *key) {
    uint64_t x = voxel[0] >> log2;
    uint64_t y = voxel[1] >> log2;
    uint64_t z = voxel[2] >> log2;
    *key = 8 * ((z * r->v->n[1] + y) * r->v->n[0] + x) + kind + 1;
    return &r->lights[*key * 0x9e3779b97f4a7c15u >> 46];
}

enum { RENDER_SUN = 3, RENDER_SKY = 4 };

/* A point a little above a voxel, on the side of the face that is seen and of the normal. */
static inline vec render_above(const render *r, const size_t voxel[3], vec outward, vec normal) {
    vec point;
    int i;
    for (i = 0; i < 3; i++) {
        point.x[i] = ((double)voxel[i] + 0.5) * r->scale.x[i];
    }
    return vec_add(vec_add(point, 0.55, outward), 1.2, normal);
}

/* The sky that a block of voxels sees which are smaller than a pixel: it changes slowly, and larger blocks do. Where
   a thin shell is seen from its edge the normal may point into it; then more is seen across the face itself, which
   sun[0] tells. */
static inline const render_light *render_visit_sky(const render *r, const size_t voxel[3], vec outward, vec normal) {
    enum { RAYS = 8 };
    uint64_t key;
    render_light *light = render_slot(r, voxel, r->block + 1, RENDER_SKY, &key);
    if (light->key != key) {
        double across;
        light->key = key;
        light->open_sky = render_open_sky(r, render_above(r, voxel, outward, normal), normal, RAYS);
        across = light->open_sky < 0.2 ? render_open_sky(r, render_above(r, voxel, outward, outward), outward, RAYS) : 0;
        light->sun[0] = across > light->open_sky ? 1 : 0;
        light->open_sky = across > light->open_sky ? across : light->open_sky;
    }
    return light;
}

/* The light on such a block: that on a plane across the normal. */
static inline void render_light_block(const render *r, render_light *light, const size_t voxel[3], vec outward,
                                      vec normal) {
    enum { RAYS = 6 };
    const render_light *sky;
    double open;
    double sun;
    normal = vec_unit(vec_add(normal, 0.4, outward));
    sky = render_visit_sky(r, voxel, outward, normal);
    open = sky->open_sky;
    normal = sky->sun[0] > 0 ? outward : normal;
    sun = vec_dot(normal, r->sun) > -0.1 ? render_sun_part(r, render_above(r, voxel, outward, normal), RAYS, 2) : 0;
    light->open_sky = open;
    light->sun[0] = light->sun[1] = light->sun[2] = light->sun[3] = sun;
}

/* The light there, kept for the samples that follow. */
static inline const render_light *render_visit_light(const render *r, const size_t voxel[3], int axis, vec outward,
                                                     vec normal) {
    int by_block = r->block > 0 && vec_dot(normal, normal) > 0;
    uint64_t key;
    render_light *light = render_slot(r, voxel, r->block, by_block ? RENDER_SUN : (unsigned)axis, &key);
    if (light->key == key) {
        return light;
    }
    if (by_block) {
        render_light_block(r, light, voxel, outward, normal);
    } else {
        render_light_face(r, light, voxel, axis, outward, normal);
    }
    light->key = key;
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
    double light;
    double fade = exp(-vec_dot(away, away) / (14 * reach * reach));
    int a;
    if (fade < 0.01) {
        return backdrop;
    }
    point = vec_add(point, 0.01, r->up);
    light = 0.55 * render_sun_part(r, point, 12, 3) + 0.45 * render_open_sky(r, point, r->up, 12);
    for (a = 0; a < 3; a++) {
        backdrop.x[a] *= 1 - fade * (1 - light) * 0.85;
    }
    return backdrop;
}

/* ---- 3. The picture -------------------------------------------------------------------------- */

/* Marks one word of voxels, of which one is set: its bricks, their crate, the box. */
static inline void render_mark_word(render *r, uint64_t bits, size_t word, size_t y, size_t z) {
    const size_t *bricks = r->cells[RENDER_BRICKS];
    const size_t *crates = r->cells[RENDER_CRATES];
    size_t base = (z / 8 * bricks[1] + y / 8) * bricks[0] + 8 * word;
    size_t first = 64 * word + voxels_lowest(bits);
    size_t last = 64 * word + 63;
    size_t i;
    for (i = 0; i < 8; i++) {
        if (bits >> (8 * i) & 255) {
            r->cell[RENDER_BRICKS][base + i] = 1;
        }
    }
    r->cell[RENDER_CRATES][(z / 64 * crates[1] + y / 64) * crates[0] + word] = 1;
    for (; !(bits >> 63); last--) {
        bits <<= 1;
    }
    r->lo[0] = first < r->lo[0] ? first : r->lo[0];
    r->hi[0] = last + 1 > r->hi[0] ? last + 1 : r->hi[0];
    r->lo[1] = y < r->lo[1] ? y : r->lo[1];
    r->hi[1] = y + 1 > r->hi[1] ? y + 1 : r->hi[1];
    r->lo[2] = z < r->lo[2] ? z : r->lo[2];
    r->hi[2] = z + 1;
}

/* Marks bricks and crates with set voxels and measures their bounding box. Returns 0 if no voxel is set. */
static inline int render_mark_cells(render *r) {
    size_t word;
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
            for (word = 0; word < r->v->row_words; word++) {
                if (row[word]) {
                    render_mark_word(r, row[word], word, y, z);
                }
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
    int k;
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
        for (k = 0; k < 2; k++) {
            r->side[a].lo[k] = fmin(b[k], 0) + fmin(c[k], 0);
            r->side[a].hi[k] = fmax(b[k], 0) + fmax(c[k], 0);
        }
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
    uint64_t key = 4 * (((uint64_t)voxel[2] * r->v->n[1] + voxel[1]) * r->v->n[0] + voxel[0]) + (uint64_t)a + 1;
    int row;
    int column;
    int row_hi;
    int column_lo;
    int column_hi;
    memcpy(at, voxel, sizeof at);
    at[a] += r->forward.x[a] > 0 ? 0 : 1;
    render_place(r, at, p);
    column_lo = (int)(p[0] + side->lo[0] - slack) + 1;      /* all lie well within the picture, so are above 0 */
    column_hi = (int)(p[0] + side->hi[0] + slack);
    row_hi = (int)(p[1] + side->hi[1] + slack);
    for (row = (int)(p[1] + side->lo[1] - slack) + 1; row <= row_hi; row++) {
        double x = column_lo - p[0];
        double y = row - p[1];
        double u = side->to_b[0] * x + side->to_b[1] * y;
        double v = side->to_c[0] * x + side->to_c[1] * y;
        size_t i = (size_t)row * RENDER_COLUMNS + (size_t)column_lo;
        for (column = column_lo; column <= column_hi; column++, i++) {
            if (u >= -slack && u <= 1 + slack && v >= -slack && v <= 1 + slack) {
                float depth = (float)(p[2] + u * b[2] + v * c[2]);
                if (r->seen[i] == 0 || depth < r->depth[i]) {
                    r->seen[i] = key;
                    r->depth[i] = depth;
                }
            }
            u += side->to_b[0];
            v += side->to_c[0];
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

/* The floor at a point where it is lit, kept; its light is never 0. */
static inline const vec *render_visit_floor(const render *r, int column, int row) {
    vec *at = &r->floor[row * RENDER_FLOOR_COLUMNS + column];
    if (at->x[0] == 0) {
        *at = render_shade_floor(r, column * RENDER_FLOOR, row * RENDER_FLOOR);
    }
    return at;
}

/* The floor between these points. */
static inline vec render_floor_at(const render *r, double x, double y) {
    int i = (int)(x / RENDER_FLOOR);
    int j = (int)(y / RENDER_FLOOR);
    double u = x / RENDER_FLOOR - i;
    double v = y / RENDER_FLOOR - j;
    vec sum = vec_make(0, 0, 0);
    sum = vec_add(sum, (1 - u) * (1 - v), *render_visit_floor(r, i, j));
    sum = vec_add(sum, u * (1 - v), *render_visit_floor(r, i + 1, j));
    sum = vec_add(sum, (1 - u) * v, *render_visit_floor(r, i, j + 1));
    return vec_add(sum, u * v, *render_visit_floor(r, i + 1, j + 1));
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

static inline vec render_spot_shade(const render_spot *s, const render *r) {
    const vec *smooth = render_visit_normal(r, s->voxel);
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
        return vec_add(sum, line, render_spot_shade(&s, r));
    }
    for (i = 0; i < RENDER_FINE * RENDER_FINE; i++) {
        int column = RENDER_FINE * x + i % RENDER_FINE;
        int row = RENDER_FINE * y + i / RENDER_FINE;
        uint64_t key = r->seen[(size_t)row * RENDER_COLUMNS + (size_t)column];
        if (key == 0) {
            sum = vec_add(sum, weight, render_floor_at(r, x + 0.5, y + 0.5));
        } else {
            render_spot_set(&s, r, key, column, row);
            sum = vec_add(sum, weight * render_line(r, s.axis, s.b, s.c), render_spot_shade(&s, r));
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
    int k;
    int a;
    for (k = 0; k < RENDER_LEVELS; k++) {
        for (a = 0; a < 3; a++) {
            size_t n = k == 0 ? r->v->n[a] : (r->cells[k - 1][a] + 7) / 8;
            r->cells[k][a] = k == RENDER_BRICKS && a == 0 ? 8 * r->v->row_words : n;        /* whole words */
        }
        r->cell[k] = k == 0 ? NULL : (unsigned char *)calloc(r->cells[k][0] * r->cells[k][1] * r->cells[k][2], 1);
    }
    r->lights = (render_light *)calloc(RENDER_CACHE, sizeof *r->lights);
    r->normals = (render_normal *)calloc(RENDER_CACHE, sizeof *r->normals);
    r->seen = (uint64_t *)calloc(samples, sizeof *r->seen);
    r->depth = (float *)malloc(samples * sizeof *r->depth);
    r->floor = (vec *)calloc((size_t)RENDER_FLOOR_COLUMNS * RENDER_FLOOR_ROWS, sizeof(vec));
    return r->cell[RENDER_BRICKS] && r->cell[RENDER_CRATES] && r->lights && r->normals && r->seen && r->depth && r->floor;
}

/* Writes a picture of the voxels, with the mesh axis `up` ('x', 'y' or 'z') upwards. */
static inline int render_write(const char *path, const voxels *v, char up, char *error) {
    unsigned char *pixels = (unsigned char *)malloc(3 * (size_t)RENDER_WIDTH * RENDER_HEIGHT);
    render r;
    int ok;
    int i;
    memset(&r, 0, sizeof r);
    r.v = v;
    for (i = 0; i < RENDER_RAYS; i++) {
        r.spiral[i][0] = cos(2.399963229728653 * i);
        r.spiral[i][1] = sin(2.399963229728653 * i);
    }
    if (!render_memory(&r) || !pixels) {
        ok = voxels_fail(path, "out of memory", error);
    } else if (!render_mark_cells(&r)) {
        ok = voxels_fail(path, "no voxel is set, so there is nothing to draw", error);
    } else {
        render_aim(&r, up);
        render_bytes_make(&r);
        render_weights_make(&r);
        render_project(&r);
        render_draw_all(&r);
        render_pixels(&r, pixels);
        ok = png_write(path, pixels, RENDER_WIDTH, RENDER_HEIGHT, error);
    }
    free(pixels);
    free(r.cell[RENDER_BRICKS]);
    free(r.cell[RENDER_CRATES]);
    free(r.lights);
    free(r.normals);
    free(r.seen);
    free(r.depth);
    free(r.floor);
    return ok;
}

#endif /* EXAMPLES_RENDER_H */
