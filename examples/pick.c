/* pick - which triangle is under the pointer, where, and in which voxel? Rays through a mesh, drawn in letters
 *
 *   build/pick [mesh] [columns]       default: the teapot, 76 columns
 *
 * The triangles are sorted into a grid once: tribox_grid_spans says which voxels each touches. A ray then walks the
 * grid: tribox_grid_segment hands over the voxels in the order in which it enters them, tribox_ray_triangle asks
 * those voxels' triangles, and the walk stops where a hit is nearer than the next voxel. The nearer a point, the
 * heavier its letter. The ray through the middle is picked; tribox_closest gives the weights of its point:
 *
 *   picked triangle 8117 at t = 0.88, voxel (24, 3, 17), weights 0.93 0.02 0.05
 *   of 13 voxels and 52 triangles asked
 */
#include "program.h"

enum { SIDE = 48 };

typedef struct scene {
    tribox_mesh mesh;
    tribox_grid grid;
    size_t     *first;      /* where each voxel's triangles begin in `list`; one more than there are voxels */
    uint32_t   *list;
} scene;

typedef struct ray {
    const scene *scene;
    float        origin[3];
    float        dir[3];
    float        t;         /* of the nearest hit so far */
    size_t       triangle;
    int          voxel[3];
    size_t       asked_voxels;
    size_t       asked_triangles;
} ray;

static size_t voxel_index(const tribox_grid *g, int x, int y, int z) {
    return ((size_t)z * (size_t)g->hi[1] + (size_t)y) * (size_t)g->hi[0] + (size_t)x;
}

/* Two passes: how many triangles a voxel has, then which. */
typedef struct sorter {
    scene   *s;
    uint32_t triangle;
    int      filling;
} sorter;

static void sort_span(void *user, int x0, int x1, int y, int z) {
    sorter *t = (sorter *)user;
    int x;
    for (x = x0; x <= x1; x++) {
        size_t *at = &t->s->first[voxel_index(&t->s->grid, x, y, z)];
        if (t->filling) {
            t->s->list[*at] = t->triangle;
        }
        *at += 1;
    }
}

static int prepare(scene *s) {
    size_t voxels;
    size_t sum = 0;
    size_t i;
    sorter t;
    if (!tribox_grid_fit(&s->grid, &s->mesh, SIDE)) {
        return 0;
    }
    voxels = (size_t)s->grid.hi[0] * (size_t)s->grid.hi[1] * (size_t)s->grid.hi[2];
    s->first = (size_t *)calloc(voxels + 1, sizeof *s->first);
    s->list = NULL;
    t.s = s;
    for (t.filling = 0; t.filling < 2 && s->first; t.filling++) {
        for (i = 0; i < s->mesh.triangles; i++) {
            const float *v[3];
            mesh_corners(&s->mesh, i, v);
            t.triangle = (uint32_t)i;
            tribox_grid_spans(&s->grid, v[0], v[1], v[2], sort_span, &t);
        }
        if (!t.filling) {       /* counts become places */
            for (i = 0; i <= voxels; i++) {
                const size_t count = s->first[i];
                s->first[i] = sum;
                sum += count;
            }
            s->list = (uint32_t *)malloc((sum + 1) * sizeof *s->list);
            if (!s->list) {
                return 0;
            }
        }
    }
    if (!s->first) {
        return 0;
    }
    memmove(s->first + 1, s->first, voxels * sizeof *s->first);     /* each place has moved to the next one */
    s->first[0] = 0;
    return 1;
}

/* One voxel on the ray's way: returns 1 to stop. */
static int look(void *user, int x, int y, int z) {
    ray *r = (ray *)user;
    const scene *s = r->scene;
    const int at[3] = {x, y, z};
    const size_t voxel = voxel_index(&s->grid, x, y, z);
    float lo[3];
    float hi[3];
    size_t i;
    int a;
    r->asked_voxels++;
    for (a = 0; a < 3; a++) {
        lo[a] = nextafterf((float)(s->grid.origin[a] + at[a] * s->grid.size[a]), -INFINITY);
        hi[a] = nextafterf((float)(s->grid.origin[a] + (at[a] + 1) * s->grid.size[a]), INFINITY);
    }
    if (r->triangle < s->mesh.triangles &&
        !tribox_ray_box(r->origin, r->dir, 0, r->t, lo, hi, NULL, NULL)) {
        return 1;       /* what was found is nearer */
    }
    for (i = s->first[voxel]; i < s->first[voxel + 1]; i++) {
        const float *v[3];
        float t;
        r->asked_triangles++;
        mesh_corners(&s->mesh, s->list[i], v);
        if (tribox_ray_triangle(r->origin, r->dir, 0, r->t, v[0], v[1], v[2], &t) &&
            (r->triangle == s->mesh.triangles || t < r->t)) {
            r->t = t;
            r->triangle = s->list[i];
        }
    }
    return 0;
}

/* The first triangle along the ray; the mesh's count if there is none. */
static void pick(const scene *s, ray *r) {
    double p[3];
    double q[3];
    double point[3];
    int a;
    r->scene = s;
    r->t = 4;
    r->triangle = s->mesh.triangles;
    r->asked_voxels = r->asked_triangles = 0;
    for (a = 0; a < 3; a++) {
        p[a] = (double)r->origin[a];
        q[a] = p[a] + 4 * (double)r->dir[a];
    }
    tribox_grid_segment(&s->grid, p, q, look, r);
    for (a = 0; a < 3; a++) {
        point[a] = p[a] + (double)r->t * (double)r->dir[a];
    }
    tribox_grid_locate(&s->grid, point, r->voxel);
}

static void describe(const scene *s, const ray *r) {
    if (r->triangle < s->mesh.triangles) {
        const float *v[3];
        float point[3];
        float weights[3];
        int a;
        for (a = 0; a < 3; a++) {
            point[a] = r->origin[a] + r->t * r->dir[a];
        }
        mesh_corners(&s->mesh, r->triangle, v);
        tribox_closest(v[0], v[1], v[2], point, weights);
        printf("picked triangle %lu at t = %.2f, voxel (%d, %d, %d), weights %.2f %.2f %.2f\n",
               (unsigned long)r->triangle, (double)r->t, r->voxel[0], r->voxel[1], r->voxel[2], (double)weights[0],
               (double)weights[1], (double)weights[2]);
    } else {
        printf("nothing in the middle\n");
    }
    printf("of %lu voxels and %lu triangles asked\n", (unsigned long)r->asked_voxels,
           (unsigned long)r->asked_triangles);
}

int main(int argc, char **argv) {
    static const char letters[] = "@%#*+=-:.";
    char error[MESH_ERROR] = "usage: pick [mesh] [columns from 8 to 400]";
    int asked;
    int columns = 76;
    double longest;
    double middle[3];
    scene s;
    mesh m;
    ray r;
    int rows;
    int x;
    int y;
    int a;
    if ((asked = program_arguments("pick", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 3 || (argc > 2 && !program_int(argv[2], 8, 400, &columns)) ||
        !program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("pick", error);
    }
    mesh_to_floats(&m);
    s.mesh = mesh_view(&m);
    if (!prepare(&s)) {
        return program_fails("pick", "out of memory, or a mesh without extent");
    }
    longest = s.grid.size[0] * SIDE;
    for (a = 0; a < 3; a++) {
        middle[a] = s.grid.origin[a] + s.grid.size[a] * s.grid.hi[a] / 2;
    }
    r.origin[0] = (float)middle[0];                       /* in front (-y) and above, looking along y */
    r.origin[1] = (float)(middle[1] - 2 * longest);
    r.origin[2] = (float)(middle[2] + longest);
    rows = columns * 2 / 5;
    for (y = 0; y < rows; y++) {
        for (x = 0; x < columns; x++) {
            const double right = (2.0 * x + 1) / columns - 1;
            const double up = (rows - 2.0 * y - 1) / columns * 2;
            r.dir[0] = (float)(longest * right * 0.6);
            r.dir[1] = (float)(2 * longest + longest * up * 0.25);
            r.dir[2] = (float)(-longest + longest * up * 0.6);
            pick(&s, &r);
            a = (int)(((double)r.t - 0.75) / 0.5 * 9);
            putchar(r.triangle == s.mesh.triangles ? ' ' : letters[a < 0 ? 0 : a > 8 ? 8 : a]);
        }
        putchar('\n');
    }
    for (a = 0; a < 3; a++) {
        r.dir[a] = (float)(middle[a] - (double)r.origin[a]);
    }
    pick(&s, &r);
    describe(&s, &r);
    free(s.first);
    free(s.list);
    mesh_free(&m);
    return 0;
}
