/* trace - a small ray tracer: the mesh on a chequered floor, among spheres, as a PNG
 *
 *   build/trace file.png [mesh] [width]       default: the teapot, 640 pixels wide
 *
 * Rays against the mesh go down an octree (ray_tree.h): by tribox_ray_box into its nodes, by tribox_ray_triangle to its
 * triangles, and tribox_closest gives the weights for the normal. Spheres are asked by tribox_ray_sphere. Colours differ at edges, and only there: the corners
 * of all pixels are traced, and where the four of a pixel differ, it is divided into cells with one jittered ray in
 * each [Whitted, An improved illumination model for shaded display, 1980]. Prints:
 *
 *   octree     65473 nodes, 246887 places for 36672 triangles
 *   picture    640 x 400, 16 % of the pixels divided, 10.0 rays for each
 */
#include "program.h"
#include "png.h"
#include "ray_tree.h"

enum { BALLS = 6, BOUNCES = 4, CELLS = 3 };

typedef struct hit {
    float  t;
    double normal[3];
    double colour[3];
    double mirror;          /* how much of the light is the mirror image's */
} hit;

typedef struct scene {
    ray_tree    tree;
    double      rays;
    float       floor;
    float       ball[BALLS][4];
    double      size;       /* of the mesh */
    float       eye[3];
    double      aim[3];     /* where it looks */
    int         width;
    int         height;
} scene;

static const double sun[3] = {-0.48, -0.56, 0.68};

static void paint(hit *h, double red, double green, double blue, double mirror) {
    h->colour[0] = red;
    h->colour[1] = green;
    h->colour[2] = blue;
    h->mirror = mirror;
}

/* What the ray meets first, if it is nearer than h->t. */
static int meet(scene *s, const float o[3], const float d[3], hit *h) {
    const float end = h->t;
    const float down = d[2] < 0 || d[2] > 0 ? (s->floor - o[2]) / d[2] : -1;
    float point[3];
    size_t triangle;
    float from;
    int i;
    int a;
    s->rays++;
    if (down > 0 && down < h->t) {
        const double x = floor(((double)o[0] + (double)down * (double)d[0]) / s->size * 4);
        const double y = floor(((double)o[1] + (double)down * (double)d[1]) / s->size * 4);
        const int dark = fmod(fabs(x + y), 2) > 0.5;
        h->t = down;
        h->normal[0] = h->normal[1] = 0;
        h->normal[2] = 1;
        paint(h, dark ? 0.16 : 0.78, dark ? 0.19 : 0.75, dark ? 0.24 : 0.68, 0.12);
    }
    for (i = 0; i < BALLS; i++) {
        static const double colours[BALLS][4] = {{.95, .35, .25, .12}, {.9, .9, .92, .75}, {.25, .55, .9, .15},
                                                 {.98, .75, .2, .15}, {.35, .75, .4, .12}, {.85, .85, .9, .8}};
        if (tribox_ray_sphere(o, d, 0, h->t, s->ball[i], s->ball[i][3], &from, NULL) && from > 0) {
            h->t = from;
            for (a = 0; a < 3; a++) {
                h->normal[a] = (double)o[a] + (double)from * (double)d[a] - (double)s->ball[i][a];
            }
            ray_unit(h->normal);
            paint(h, colours[i][0], colours[i][1], colours[i][2], colours[i][3]);
        }
    }
    triangle = ray_tree_pick(&s->tree, o, d, &h->t);
    if (triangle < s->tree.m->triangles) {
        for (a = 0; a < 3; a++) {
            point[a] = o[a] + h->t * d[a];
        }
        ray_tree_normal(&s->tree, triangle, point, h->normal);
        paint(h, 0.82, 0.56, 0.38, 0.18);
    }
    return h->t < end;
}

/* The colour that comes along the ray. */
static void look(scene *s, const float o[3], const double d[3], int bounces, double out[3]) {
    const float d32[3] = {(float)d[0], (float)d[1], (float)d[2]};
    const float sun32[3] = {(float)sun[0], (float)sun[1], (float)sun[2]};
    hit h;
    hit shade;
    float start[3];
    double light;
    double shine;
    double mirrored[3];
    double beyond[3] = {0, 0, 0};
    int a;
    h.t = FLT_MAX;
    if (!meet(s, o, d32, &h)) {         /* the sky */
        const double up = d[2] > 0 ? d[2] : 0;
        out[0] = 0.86 - 0.56 * sqrt(up);
        out[1] = 0.90 - 0.38 * sqrt(up);
        out[2] = 0.96 - 0.10 * sqrt(up);
        return;
    }
    if (ray_dot(h.normal, d) > 0) {
        for (a = 0; a < 3; a++) {
            h.normal[a] = -h.normal[a];
        }
    }
    for (a = 0; a < 3; a++) {
        mirrored[a] = d[a] - 2 * ray_dot(d, h.normal) * h.normal[a];
        start[a] = (float)((double)o[a] + (double)h.t * d[a] + 1e-4 * s->size * h.normal[a]);
    }
    light = ray_dot(h.normal, sun);
    shade.t = FLT_MAX;
    if (light > 0 && meet(s, start, sun32, &shade)) {
        light = 0;
    }
    shine = light > 0 ? pow(fmax(ray_dot(mirrored, sun), 0), 60) : 0;
    if (bounces > 0) {
        h.mirror += (1 - h.mirror) * pow(1 + ray_dot(d, h.normal), 5) * 0.6;
        look(s, start, mirrored, bounces - 1, beyond);
    }
    for (a = 0; a < 3; a++) {
        const double ambient = 0.24 + 0.12 * h.normal[2] + (a == 2 ? 0.04 : 0);
        out[a] = (1 - h.mirror) * h.colour[a] * (ambient + 0.85 * fmax(light, 0)) + h.mirror * beyond[a] + 0.5 * shine;
        out[a] += (1 - exp(-(double)h.t / s->size / 30)) * ((a == 0 ? 0.86 : a == 1 ? 0.90 : 0.96) - out[a]);
    }
}

/* Normals, the tree, a floor below and a ring of spheres around. The picture's own numbers are floats: where the mesh
 * is of doubles, they count from a base near it. */
static int prepare(scene *s, const mesh *m) {
    tribox_grid frame;
    size_t i;
    size_t k;
    int a;
    if (!mesh_fit(&frame, m, 1)) {
        return 0;
    }
    s->tree.m = m;
    for (a = 0; a < 3; a++) {
        s->tree.base[a] = m->exact ? frame.origin[a] : 0;
    }
    s->size = frame.size[0];
    s->floor = FLT_MAX;
    for (i = 0; i < m->triangles; i++) {
        for (k = 0; k < 3; k++) {
            double corner[3];
            mesh_corner_f64(m, i, k, corner);
            s->floor = fminf(s->floor, (float)(corner[2] - s->tree.base[2]));
        }
    }
    for (a = 0; a < 3; a++) {
        s->aim[a] = frame.origin[a] - s->tree.base[a] + s->size / 2 - (a == 2 ? 0.22 * s->size : 0);
        s->eye[a] = (float)(s->aim[a] + s->size * (a == 0 ? 0.55 : a == 1 ? -1.25 : 0.55));
    }
    for (a = 0; a < BALLS; a++) {
        const double turn = 1.05 * a + 0.35;
        const double radius = s->size * (0.08 + 0.03 * (a * 7 % 4));
        s->ball[a][0] = (float)(s->aim[0] + 0.78 * s->size * cos(turn));
        s->ball[a][1] = (float)(s->aim[1] + 0.72 * s->size * sin(turn));
        s->ball[a][2] = s->floor + (float)radius;
        s->ball[a][3] = (float)radius;
    }
    return ray_tree_build(&s->tree, &frame);
}

/* The colour at a point of the picture, in pixels from its top left. */
static void sample(scene *s, double x, double y, double out[3]) {
    double d[3];
    double right[3];
    double up[3];
    int a;
    for (a = 0; a < 3; a++) {
        d[a] = s->aim[a] - (double)s->eye[a];
    }
    ray_unit(d);
    right[0] = d[1];
    right[1] = -d[0];
    right[2] = 0;
    ray_unit(right);
    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        up[a] = right[b] * d[c] - right[c] * d[b];
    }
    for (a = 0; a < 3; a++) {
        d[a] += (2 * x / s->width - 1) * 0.56 * right[a] + (s->height - 2 * y) / s->width * 0.56 * up[a];
    }
    ray_unit(d);
    look(s, s->eye, d, BOUNCES, out);
}

static double jitter(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

/* A pixel from its corners; from a ray in each of its cells where they differ. Returns 1 if it was divided. */
static int shade(scene *s, int x, int y, double corners[4][3], double out[3]) {
    uint32_t state = (uint32_t)(y * s->width + x) * 2654435761u;
    double differ = 0;
    int i;
    int a;
    for (a = 0; a < 3; a++) {
        const double least = fmin(fmin(corners[0][a], corners[1][a]), fmin(corners[2][a], corners[3][a]));
        const double most = fmax(fmax(corners[0][a], corners[1][a]), fmax(corners[2][a], corners[3][a]));
        out[a] = (corners[0][a] + corners[1][a] + corners[2][a] + corners[3][a]) / 4;
        differ = fmax(differ, most - least);
    }
    for (i = 0; i < CELLS * CELLS && differ > 0.06; i++) {
        double colour[3];
        const double right = (i % CELLS + jitter(&state)) / CELLS;
        sample(s, x + right, y + (i / CELLS + jitter(&state)) / CELLS, colour);
        for (a = 0; a < 3; a++) {
            out[a] = (i ? out[a] : 0) + colour[a] / (CELLS * CELLS);
        }
    }
    return differ > 0.06;
}

/* Row by row; two rows of corners are kept. Returns how many pixels were divided. */
static size_t render(scene *s, unsigned char *pixels, double (*rows)[3]) {
    size_t divided = 0;
    int x;
    int y;
    int a;
    for (y = 0; y <= s->height; y++) {
        double(*above)[3] = rows + (y % 2 ? 0 : s->width + 1);
        double(*below)[3] = rows + (y % 2 ? s->width + 1 : 0);
        for (x = 0; x <= s->width; x++) {
            sample(s, x, y, below[x]);
        }
        for (x = 0; x < s->width && y > 0; x++) {
            double corners[4][3];
            double colour[3];
            memcpy(corners[0], above[x], sizeof corners[0] * 2);
            memcpy(corners[2], below[x], sizeof corners[0] * 2);
            divided += (size_t)shade(s, x, y - 1, corners, colour);
            for (a = 0; a < 3; a++) {
                *pixels++ = (unsigned char)(255 * pow(fmin(fmax(colour[a], 0), 1), 1 / 1.6) + 0.5);
            }
        }
    }
    return divided;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: trace file.png [mesh] [width from 16 to 4096]";
    unsigned char *pixels;
    double(*rows)[3];
    size_t divided;
    scene s;
    mesh m;
    int asked;
    s.width = 640;
    s.rays = 0;
    if ((asked = program_arguments("trace", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc < 2 || argc > 4 || (argc > 3 && !program_int(argv[3], 16, 4096, &s.width)) ||
        !voxels_check(argv[1], argc > 2 ? argv[2] : "teapot", error) ||
        !program_mesh(&m, argc > 2 ? argv[2] : "teapot", error)) {
        return program_fails("trace", error);
    }
    s.height = s.width * 5 / 8;
    mesh_say_exact(&m);
    pixels = (unsigned char *)malloc((size_t)s.width * (size_t)s.height * 3);
    rows = (double(*)[3])malloc(2 * ((size_t)s.width + 1) * sizeof *rows);
    if (!pixels || !rows || !prepare(&s, &m)) {
        return program_fails("trace", "out of memory, or a mesh without extent");
    }
    printf("octree     %lu nodes, %lu places for %lu triangles\n", (unsigned long)s.tree.nodes,
           (unsigned long)s.tree.places, (unsigned long)m.triangles);
    divided = render(&s, pixels, rows);
    printf("picture    %d x %d, %.0f %% of the pixels divided, %.1f rays for each\n", s.width, s.height,
           100.0 * (double)divided / s.width / s.height, s.rays / s.width / s.height);
    asked = png_write(argv[1], pixels, (size_t)s.width, (size_t)s.height, error) ? 0 : program_fails("trace", error);
    ray_tree_free(&s.tree);
    free(pixels);
    free(rows);
    mesh_free(&m);
    return asked;
}
