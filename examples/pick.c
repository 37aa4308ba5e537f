/* pick - which triangle is under the pointer, where, and in which voxel? Rays through a mesh, drawn in letters
 *
 *   build/pick [mesh] [columns]       default: the teapot, 76 columns
 *
 * The triangles are sorted into a grid once: tribox_grid_spans says which voxels each touches. A ray then walks the
 * grid: tribox_grid_segment hands over the voxels in the order in which it enters them, tribox_ray_triangle asks
 * those voxels' triangles, and the walk stops where a hit is nearer than the next voxel. The nearer a point, the
 * heavier its letter. The ray through the middle is picked; tribox_closest gives the weights of its point. Where a
 * coordinate of the file is no float, all is asked in double:
 *
 *   picked triangle 8117 at t = 0.88, voxel (24, 3, 17), weights 0.93 0.02 0.05
 *   of 13 voxels and 52 triangles asked
 */
#include "program.h"

enum { SIDE = 48 };

typedef struct scene {
    const mesh *m;
    tribox_grid grid;
    size_t     *first;      /* where each voxel's triangles begin in `list`; one more than there are voxels */
    uint32_t   *list;
} scene;

typedef struct ray {
    const scene *scene;
    double       origin[3];
    double       dir[3];
    double       t;         /* of the nearest hit so far */
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
    if (!mesh_fit(&s->grid, s->m, SIDE)) {
        return 0;
    }
    voxels = (size_t)s->grid.hi[0] * (size_t)s->grid.hi[1] * (size_t)s->grid.hi[2];
    s->first = (size_t *)calloc(voxels + 1, sizeof *s->first);
    s->list = NULL;
    t.s = s;
    for (t.filling = 0; t.filling < 2 && s->first; t.filling++) {
        for (i = 0; i < s->m->triangles; i++) {
            t.triangle = (uint32_t)i;
            mesh_triangle_spans(&s->grid, s->m, i, sort_span, &t);
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
    double lo[3];
    double hi[3];
    size_t i;
    int a;
    r->asked_voxels++;
    for (a = 0; a < 3; a++) {       /* outward by a float or a double */
        lo[a] = s->grid.origin[a] + at[a] * s->grid.size[a];
        hi[a] = s->grid.origin[a] + (at[a] + 1) * s->grid.size[a];
        lo[a] = s->m->exact ? nextafter(lo[a], -HUGE_VAL) : (double)nextafterf((float)lo[a], -HUGE_VALF);
        hi[a] = s->m->exact ? nextafter(hi[a], HUGE_VAL) : (double)nextafterf((float)hi[a], HUGE_VALF);
    }
    if (r->triangle < s->m->triangles && !mesh_ray_box(s->m, r->origin, r->dir, r->t, lo, hi)) {
        return 1;       /* what was found is nearer */
    }
    for (i = s->first[voxel]; i < s->first[voxel + 1]; i++) {
        double t;
        r->asked_triangles++;
        if (mesh_ray_triangle(s->m, s->list[i], r->origin, r->dir, r->t, &t) &&
            (r->triangle == s->m->triangles || t < r->t)) {
            r->t = t;
            r->triangle = s->list[i];
        }
    }
    return 0;
}

/* The first triangle along the ray; the mesh's count if there is none. */
static void pick(const scene *s, ray *r) {
    double q[3];
    double point[3];
    int a;
    r->scene = s;
    r->t = 4;
    r->triangle = s->m->triangles;
    r->asked_voxels = r->asked_triangles = 0;
    for (a = 0; a < 3; a++) {
        q[a] = r->origin[a] + 4 * r->dir[a];
    }
    tribox_grid_segment(&s->grid, r->origin, q, look, r);
    for (a = 0; a < 3; a++) {
        point[a] = r->origin[a] + r->t * r->dir[a];
    }
    tribox_grid_locate(&s->grid, point, r->voxel);
}

static void describe(const scene *s, const ray *r) {
    if (r->triangle < s->m->triangles) {
        double point[3];
        double weights[3];
        int a;
        for (a = 0; a < 3; a++) {
            point[a] = r->origin[a] + r->t * r->dir[a];
        }
        mesh_closest(s->m, r->triangle, point, weights);
        printf("picked triangle %lu at t = %.2f, voxel (%d, %d, %d), weights %.2f %.2f %.2f\n",
               (unsigned long)r->triangle, r->t, r->voxel[0], r->voxel[1], r->voxel[2], weights[0], weights[1],
               weights[2]);
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
    mesh_say_exact(&m);
    s.m = &m;
    if (!prepare(&s)) {
        return program_fails("pick", "out of memory, or a mesh without extent");
    }
    longest = s.grid.size[0] * SIDE;
    for (a = 0; a < 3; a++) {
        middle[a] = s.grid.origin[a] + s.grid.size[a] * s.grid.hi[a] / 2;
    }
    r.origin[0] = mesh_number(&m, middle[0]);             /* in front (-y) and above, looking along y */
    r.origin[1] = mesh_number(&m, middle[1] - 2 * longest);
    r.origin[2] = mesh_number(&m, middle[2] + longest);
    rows = columns * 2 / 5;
    for (y = 0; y < rows; y++) {
        for (x = 0; x < columns; x++) {
            const double right = (2.0 * x + 1) / columns - 1;
            const double up = (rows - 2.0 * y - 1) / columns * 2;
            r.dir[0] = mesh_number(&m, longest * right * 0.6);
            r.dir[1] = mesh_number(&m, 2 * longest + longest * up * 0.25);
            r.dir[2] = mesh_number(&m, -longest + longest * up * 0.6);
            pick(&s, &r);
            a = (int)((r.t - 0.75) / 0.5 * 9);
            putchar(r.triangle == m.triangles ? ' ' : letters[a < 0 ? 0 : a > 8 ? 8 : a]);
        }
        putchar('\n');
    }
    for (a = 0; a < 3; a++) {
        r.dir[a] = mesh_number(&m, middle[a] - r.origin[a]);
    }
    pick(&s, &r);
    describe(&s, &r);
    free(s.first);
    free(s.list);
    mesh_free(&m);
    return 0;
}
