/* cells - the acceleration grid that everybody builds: for each cell the list of its triangles, then rays
 *
 *   build/cells [mesh] [cells along the longest side] [rays]      default: the teapot, 128, 100000
 *
 * tribox_mesh_spans runs twice over the mesh: once to count each cell's triangles, once, after a prefix sum
 * over the counts, to write their numbers. A cell lists every triangle that touches it, exactly; and
 * tribox_grid_segment hands out every cell that a ray passes. So whatever triangle a ray meets stands in one of
 * the lists that it reads, and no ray slips through a gap: the first 200 rays are answered by asking all triangles,
 * too, and have to agree in how many they meet, and where first. Prints:
 *
 *   grid      128 x 80 x 63 cells, 5.6 triangles in each of the 29972 that have any
 *   lists     167437 numbers in ... s
 *   rays      100000: 67570 meet the mesh, 21.6 tests of a triangle a ray, ... s
 *   check     200 rays against all triangles: the same
 *
 * Exit status: 0 the same, 1 not the same, 2 an error.
 */
#include "program.h"

typedef struct cells {
    tribox_grid    grid;
    mesh           mesh;
    size_t         n[3];
    size_t         count;
    uint32_t      *start;       /* count + 1: where each cell's list begins */
    uint32_t      *list;        /* numbers of triangles */
    uint32_t      *seen;        /* of each triangle, the last ray that asked it, counted from 1 */
} cells;

static size_t cell_at(const cells *c, int x, int y, int z) {
    return ((size_t)z * c->n[1] + (size_t)y) * c->n[0] + (size_t)x;
}

/* A tribox_mesh_span_fn: one more triangle in each of these cells. start[i + 1] counts cell i. */
static void count_span(void *user, size_t triangle, int x0, int x1, int y, int z) {
    cells *c = (cells *)user;
    uint32_t *at = c->start + 1 + cell_at(c, x0, y, z);
    (void)triangle;
    for (; x0 <= x1; x0++) {
        *at++ += 1;
    }
}

/* The same, its number written: start[i] is the next free place of cell i's list. */
static void list_span(void *user, size_t triangle, int x0, int x1, int y, int z) {
    cells *c = (cells *)user;
    uint32_t *at = c->start + cell_at(c, x0, y, z);
    for (; x0 <= x1; x0++) {
        c->list[(*at++)++] = (uint32_t)triangle;
    }
}

static int build(cells *c, char *error) {
    size_t sum;
    size_t i;
    int k;
    c->count = 1;
    for (k = 0; k < 3; k++) {
        c->n[k] = (size_t)c->grid.hi[k];
        c->count *= c->n[k];
    }
    c->start = (uint32_t *)calloc(c->count + 2, sizeof *c->start);
    c->seen = (uint32_t *)calloc(c->mesh.triangles + 1, sizeof *c->seen);
    if (!c->start || !c->seen) {
        snprintf(error, MESH_ERROR, "out of memory for %lu cells", (unsigned long)c->count);
        return 0;
    }
    sum = mesh_spans(&c->grid, &c->mesh, count_span, c);
    if (sum > UINT32_MAX) {
        snprintf(error, MESH_ERROR, "the lists would hold more than 2^32 numbers");
        return 0;
    }
    for (i = 0; i < c->count; i++) {
        c->start[i + 1] += c->start[i];
    }
    c->list = (uint32_t *)malloc((sum + 1) * sizeof *c->list);
    if (!c->list) {
        snprintf(error, MESH_ERROR, "out of memory for %lu numbers", (unsigned long)sum);
        return 0;
    }
    mesh_spans(&c->grid, &c->mesh, list_span, c);
    for (i = c->count; i > 0; i--) {        /* each list has moved to the next one's beginning: back by one */
        c->start[i] = c->start[i - 1];
    }
    c->start[0] = 0;
    return 1;
}

/* ---- Rays */

typedef struct ray {
    cells   *cells;
    double   origin[3];         /* floats, where the mesh is of floats */
    double   dir[3];            /* the ray is origin + t * dir, t from 0 to 1 */
    uint32_t number;
    int      met;               /* triangles that it meets, */
    double   first;             /* and the least t */
    double   asked;
} ray;

static void ask(ray *r, size_t triangle) {
    const mesh *m = &r->cells->mesh;
    const tribox_mesh view = mesh_view(m);
    const float *corner[3];
    double exact[3][3];
    float origin[3];
    float dir[3];
    float near_t = 0;
    double t = 0;
    int met;
    int k;
    for (k = 0; k < 3; k++) {
        mesh_corner_f64(m, triangle, (size_t)k, exact[k]);
        origin[k] = (float)r->origin[k];
        dir[k] = (float)r->dir[k];
    }
    mesh_corners(&view, triangle, corner);
    if (m->exact) {
        met = tribox_ray_triangle_f64(r->origin, r->dir, 0, 1, exact[0], exact[1], exact[2], &t);
    } else {
        met = tribox_ray_triangle(origin, dir, 0, 1, corner[0], corner[1], corner[2], &near_t);
        t = (double)near_t;
    }
    r->asked += 1;
    if (met) {
        r->met += 1;
        r->first = t < r->first ? t : r->first;
    }
}

/* A tribox_voxel_fn: asks the triangles of a cell, each once a ray. */
static int ask_cell(void *user, int x, int y, int z) {
    ray *r = (ray *)user;
    const cells *c = r->cells;
    const size_t cell = cell_at(c, x, y, z);
    uint32_t i;
    for (i = c->start[cell]; i < c->start[cell + 1]; i++) {
        if (c->seen[c->list[i]] != r->number) {
            c->seen[c->list[i]] = r->number;
            ask(r, c->list[i]);
        }
    }
    return 0;
}

static void ask_cells(ray *r) {
    double p[3];
    double q[3];
    int k;
    for (k = 0; k < 3; k++) {
        p[k] = r->origin[k];
        q[k] = r->origin[k] + r->dir[k];        /* no digit is lost: see make_ray */
    }
    r->met = 0;
    r->first = 2;
    tribox_grid_segment(&r->cells->grid, p, q, ask_cell, r);
}

static uint64_t dice(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return *state >> 33;
}

/* From a point on one side of the mesh's bounds through a point within. All numbers are multiples of one unit, with 16 bits
 * or so, or with 44 where the mesh is of doubles, so that origin + dir is a double. */
static void make_ray(ray *r, uint64_t *state) {
    const tribox_grid *g = &r->cells->grid;
    const int side = (int)(dice(state) % 3);
    const double unit = ldexp(1, ilogb(g->size[0] * g->hi[0] + fabs(g->origin[0]) + g->size[1] * g->hi[1] +
                                       fabs(g->origin[1]) + g->size[2] * g->hi[2] + fabs(g->origin[2])) -
                               (r->cells->mesh.exact ? 44 : 16));
    int k;
    for (k = 0; k < 3; k++) {
        const double extent = g->size[k] * g->hi[k];
        const double within = g->origin[k] + extent * (double)(dice(state) % 1000) / 1000;
        double from = g->origin[k] + extent * (double)(dice(state) % 1000) / 1000;
        if (k == side) {
            from = dice(state) & 1 ? g->origin[k] - 0.25 * extent : g->origin[k] + 1.25 * extent;
        }
        from = floor(from / unit) * unit;
        r->origin[k] = from;
        r->dir[k] = floor(2 * (within - from) / unit) * unit;
    }
}

static int shoot(cells *c, uint32_t rays) {
    const uint32_t sample = rays < 200 ? rays : 200;
    uint64_t state = 1;
    double start = progress_seconds();
    double asked = 0;
    uint32_t hits = 0;
    uint32_t wrong = 0;
    uint32_t i;
    ray r;
    r.cells = c;
    for (i = 0; i < rays; i++) {
        r.number = i + 1;
        r.asked = 0;
        make_ray(&r, &state);
        ask_cells(&r);
        hits += r.met > 0;
        asked += r.asked;
    }
    printf("rays      %lu: %lu meet the mesh, %.1f tests of a triangle a ray, %.2f s\n", (unsigned long)rays,
           (unsigned long)hits, rays ? asked / rays : 0, progress_seconds() - start);
    state = 1;
    memset(c->seen, 0, c->mesh.triangles * sizeof *c->seen);
    for (i = 0; i < sample; i++) {
        int met;
        double first;
        size_t t;
        r.number = i + 1;
        make_ray(&r, &state);
        ask_cells(&r);
        met = r.met;
        first = r.first;
        r.met = 0;
        r.first = 2;
        for (t = 0; t < c->mesh.triangles; t++) {
            ask(&r, t);
        }
        wrong += met != r.met || first < r.first || first > r.first;
    }
    printf("check     %lu rays against all triangles: %s\n", (unsigned long)sample, wrong ? "NOT the same" : "the same");
    return wrong == 0;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: cells [mesh] [cells along the longest side, from 1 to 1000] [rays, up to 100000000]";
    int asked;
    int resolution = 128;
    int rays = 100000;
    int same = 0;
    cells c;
    mesh m;
    int ok;
    memset(&c, 0, sizeof c);
    if ((asked = program_arguments("cells", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 4 || (argc > 2 && !program_int(argv[2], 1, 1000, &resolution)) ||
        (argc > 3 && !program_int(argv[3], 0, 100000000, &rays))) {
        return program_fails("cells", error);
    }
    if (!program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("cells", error);
    }
    mesh_say_exact(&m);
    c.mesh = m;
    ok = mesh_fit(&c.grid, &m, resolution);
    if (!ok) {
        snprintf(error, sizeof error, "the mesh is a single point, or too large to frame");
    } else {
        double start = progress_seconds();
        ok = build(&c, error);
        if (ok) {
            size_t any = 0;
            size_t i;
            for (i = 0; i < c.count; i++) {
                any += c.start[i + 1] > c.start[i];
            }
            printf("grid      %lu x %lu x %lu cells, %.1f triangles in each of the %lu that have any\n",
                   (unsigned long)c.n[0], (unsigned long)c.n[1], (unsigned long)c.n[2],
                   any ? (double)c.start[c.count] / (double)any : 0, (unsigned long)any);
            printf("lists     %lu numbers in %.3f s\n", (unsigned long)c.start[c.count], progress_seconds() - start);
            same = shoot(&c, (uint32_t)rays);
        }
    }
    free(c.start);
    free(c.list);
    free(c.seen);
    mesh_free(&m);
    return !ok ? program_fails("cells", error) : !same;
}
