/* colours - voxels with the colour of the nearest point of the surface
 *
 *   build/colours [mesh] [resolution] [file.ply or file.vox]       default: the teapot at 64, written to nothing
 *
 * Colours are the mesh's own: of its vertices (OBJ, PLY), else of its materials (OBJ Kd, glTF base colours), else each
 * point's place in the mesh's bounds. tribox_mesh_spans gives each triangle's voxels; for each voxel,
 * tribox_closest_f64 gives the weights of the triangle's point nearest to the voxel's centre, and with them colour and
 * distance; the nearest triangle wins. Prints:
 *
 *   voxels    7412 of 64 x 40 x 32, each with a colour: its place
 *   mean      red 0.47 green 0.50 blue 0.43
 */
#include "program.h"
#include "voxel_io.h"

typedef struct cell {
    float colour[3];
    float distance2;        /* of the point that gave the colour; FLT_MAX: not touched */
} cell;

typedef struct painter {
    voxels      v;
    const mesh *m;
    cell       *cells;
    size_t      triangle;   /* at hand, its corners and their colours */
    double      corner[3][3];
    float       colour[3][3];
    int         by_place;
} painter;

static double centre_of(const tribox_grid *g, int a, int i) {
    return g->origin[a] + (i + 0.5) * g->size[a];
}

static size_t number_of(const painter *p, int x, int y, int z) {
    const tribox_grid *g = &p->v.grid;
    size_t row = (size_t)(z - g->lo[2]) * p->v.n[1] + (size_t)(y - g->lo[1]);
    return row * p->v.n[0] + (size_t)(x - g->lo[0]);
}

static void unpack(uint32_t colour, float out[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        out[a] = (float)(colour >> (16 - 8 * a) & 255) / 255.0f;
    }
}

/* Corners and colours of the triangle whose spans come next. */
static void take_triangle(painter *p, size_t triangle) {
    const mesh *m = p->m;
    size_t i;
    p->triangle = triangle;
    for (i = 0; i < 3; i++) {
        size_t vertex = m->indices ? m->indices[3 * triangle + i] : 3 * triangle + i;
        mesh_corner_f64(m, triangle, i, p->corner[i]);
        if (m->vertex_colours) {
            unpack(vertex < m->vertices_coloured ? m->vertex_colours[vertex] : 0xffffffu, p->colour[i]);
        } else if (m->face_colours) {
            unpack(triangle < m->faces_coloured ? m->face_colours[triangle] : 0xffffffu, p->colour[i]);
        }
    }
}

static void paint_voxel(painter *p, int x, int y, int z) {
    const tribox_grid *g = &p->v.grid;
    cell *c = &p->cells[number_of(p, x, y, z)];
    double q[3];
    double w[3];
    double at[3];
    double d2 = 0;
    int a;
    q[0] = centre_of(g, 0, x);
    q[1] = centre_of(g, 1, y);
    q[2] = centre_of(g, 2, z);
    tribox_closest_f64(p->corner[0], p->corner[1], p->corner[2], q, w);
    for (a = 0; a < 3; a++) {
        at[a] = w[0] * p->corner[0][a] + w[1] * p->corner[1][a] + w[2] * p->corner[2][a];
        d2 += (at[a] - q[a]) / g->size[a] * ((at[a] - q[a]) / g->size[a]);
    }
    if (!((float)d2 < c->distance2)) {
        return;
    }
    c->distance2 = (float)d2;
    for (a = 0; a < 3; a++) {       /* colours are linear over the triangle */
        c->colour[a] = p->by_place ? (float)((at[a] - g->origin[a]) / (g->size[a] * (g->hi[a] - g->lo[a])))
                                   : (float)(w[0] * (double)p->colour[0][a] + w[1] * (double)p->colour[1][a]
                                             + w[2] * (double)p->colour[2][a]);
    }
}

/* A tribox_mesh_span_fn. */
static void paint(void *user, size_t triangle, int x0, int x1, int y, int z) {
    painter *p = (painter *)user;
    int x;
    if (triangle != p->triangle) {
        take_triangle(p, triangle);
    }
    for (x = x0; x <= x1; x++) {
        paint_voxel(p, x, y, z);
    }
}

static int byte_of(float x) {
    return x < 0 ? 0 : x > 1 ? 255 : (int)(x * 255.0f + 0.5f);
}

/* Calls `visit` for each voxel that has a colour, and counts them. */
static size_t each(const painter *p, void (*visit)(const painter *, const cell *, const int *, void *), void *user) {
    const int *lo = p->v.grid.lo;
    const int *hi = p->v.grid.hi;
    size_t count = 0;
    int at[3];
    for (at[2] = lo[2]; at[2] < hi[2]; at[2]++) {
        for (at[1] = lo[1]; at[1] < hi[1]; at[1]++) {
            for (at[0] = lo[0]; at[0] < hi[0]; at[0]++) {
                const cell *c = &p->cells[number_of(p, at[0], at[1], at[2])];
                if (c->distance2 < FLT_MAX) {
                    count += 1;
                    visit(p, c, at, user);
                }
            }
        }
    }
    return count;
}

static void add_up(const painter *p, const cell *c, const int *at, void *user) {
    double *sum = (double *)user;
    (void)p;
    (void)at;
    sum[0] += (double)c->colour[0];
    sum[1] += (double)c->colour[1];
    sum[2] += (double)c->colour[2];
}

/* ---- Files ------------------------------------------------------------------------------------- */

static void write_point(const painter *p, const cell *c, const int *at, void *user) {
    const tribox_grid *g = &p->v.grid;
    fprintf((FILE *)user, "%.9g %.9g %.9g %d %d %d\n", centre_of(g, 0, at[0]), centre_of(g, 1, at[1]),
            centre_of(g, 2, at[2]), byte_of(c->colour[0]), byte_of(c->colour[1]), byte_of(c->colour[2]));
}

/* One coloured point a voxel. */
static int write_ply(const painter *p, const char *path, size_t count, char *error) {
    FILE *file = voxels_create(path, error);
    if (!file) {
        return 0;
    }
    fprintf(file, "ply\nformat ascii 1.0\nelement vertex %lu\nproperty double x\nproperty double y\nproperty double z\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n", (unsigned long)count);
    each(p, write_point, file);
    return voxels_close(file, path, error);
}

/* The colours of a palette: as they are, up to 255 of them, else the nearest of 6 x 7 x 6. */
typedef struct picker {
    uint32_t       palette[255];
    size_t         colours;         /* 256: too many */
    unsigned char *index;
    voxels        *v;
} picker;

static uint32_t packed(const cell *c) {
    return (uint32_t)byte_of(c->colour[0]) << 16 | (uint32_t)byte_of(c->colour[1]) << 8 | (uint32_t)byte_of(c->colour[2]);
}

static size_t find_colour(const picker *k, uint32_t colour) {
    size_t i = 0;
    while (i < k->colours && k->palette[i] != colour) {
        i++;
    }
    return i;
}

static void collect(const painter *p, const cell *c, const int *at, void *user) {
    picker *k = (picker *)user;
    (void)p;
    (void)at;
    if (k->colours < 256 && find_colour(k, packed(c)) == k->colours) {
        if (k->colours < 255) {
            k->palette[k->colours] = packed(c);
        }
        k->colours += 1;
    }
}

static void index_voxel(const painter *p, const cell *c, const int *at, void *user) {
    picker *k = (picker *)user;
    size_t n = number_of(p, at[0], at[1], at[2]);
    size_t x = (size_t)(at[0] - p->v.grid.lo[0]);
    int r = byte_of(c->colour[0]) * 6 / 256;
    int g = byte_of(c->colour[1]) * 7 / 256;
    int b = byte_of(c->colour[2]) * 6 / 256;
    k->index[n] = (unsigned char)(1 + (k->colours < 256 ? (int)find_colour(k, packed(c)) : (r * 7 + g) * 6 + b));
    voxels_row(k->v, (size_t)(at[1] - p->v.grid.lo[1]), (size_t)(at[2] - p->v.grid.lo[2]))[x >> 6] |= (uint64_t)1
                                                                                                     << (x & 63);
}

static int write_vox(painter *p, const char *path, char *error) {
    static picker k;
    char up = strstr(p->m->format, "PLY") || strstr(p->m->format, "OBJ") || strstr(p->m->format, "glTF") ? 'y' : 'z';
    uint32_t i;
    int ok;
    k.v = &p->v;
    k.index = (unsigned char *)calloc(p->v.n[0] * p->v.n[1], p->v.n[2]);
    if (!k.index) {
        return voxels_fail(path, "out of memory", error);
    }
    each(p, collect, &k);
    for (i = 0; k.colours > 255 && i < 252; i++) {
        k.palette[i] = (i / 42 * 51) << 16 | (i / 6 % 7 * 85 / 2) << 8 | i % 6 * 51;
    }
    each(p, index_voxel, &k);
    ok = vox_write_coloured(path, &p->v, upright_make(up), k.index, k.palette, error);
    free(k.index);
    return ok;
}

/* ---- The program --------------------------------------------------------------------------------- */

static void paint_all(painter *p) {
    tribox_mesh view = mesh_view(p->m);
    tribox_mesh_f64 exact = mesh_view_f64(p->m);
    p->triangle = SIZE_MAX;
    if (p->m->exact) {
        tribox_mesh_spans_f64(&p->v.grid, &exact, paint, p);
    } else {
        tribox_mesh_spans(&p->v.grid, &view, paint, p);
    }
}

static int run(painter *p, const char *path, char *error) {
    double sum[3] = {0, 0, 0};
    size_t cells = p->v.n[0] * p->v.n[1] * p->v.n[2];
    size_t count;
    size_t i;
    p->cells = (cell *)malloc(cells * sizeof *p->cells);
    if (!p->cells) {
        return voxels_fail("colours", "out of memory", error);
    }
    for (i = 0; i < cells; i++) {
        p->cells[i].distance2 = FLT_MAX;
    }
    p->by_place = !p->m->vertex_colours && !p->m->face_colours;
    paint_all(p);
    count = each(p, add_up, sum);
    printf("voxels    %lu of %lu x %lu x %lu, each with a colour: %s\n", (unsigned long)count, (unsigned long)p->v.n[0],
           (unsigned long)p->v.n[1], (unsigned long)p->v.n[2],
           p->by_place ? "its place" : p->m->vertex_colours ? "of the vertices" : "of the materials");
    printf("mean      red %.2f green %.2f blue %.2f\n", sum[0] / (double)count, sum[1] / (double)count,
           sum[2] / (double)count);
    return !path || (mesh_name_ends(path, ".vox") ? write_vox(p, path, error) : write_ply(p, path, count, error));
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: colours [mesh] [resolution from 1 to 512] [file.ply or file.vox]";
    const char *path;
    int asked;
    int resolution = 64;
    int ok;
    tribox_grid grid;
    painter p;
    mesh m;
    if ((asked = program_arguments("colours", error, &argc, argv)) >= 0) {
        return asked;
    }
    path = argc > 3 ? argv[3] : NULL;
    if (argc > 4 || (argc > 2 && !program_int(argv[2], 1, 512, &resolution))
        || (path && !mesh_name_ends(path, ".ply") && !mesh_name_ends(path, ".vox"))
        || (path && !voxels_check(path, argc > 1 ? argv[1] : "teapot", error)) || !program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("colours", error);
    }
    memset(&p, 0, sizeof p);
    p.m = &m;
    mesh_say_exact(&m);
    ok = mesh_fit(&grid, &m, resolution);
    if (!ok) {
        snprintf(error, sizeof error, "the mesh is a single point, or too large to frame");
    }
    ok = ok && voxels_make(&p.v, &grid, error);
    ok = ok && run(&p, path, error);
    free(p.cells);
    voxels_free(&p.v);
    mesh_free(&m);
    return ok ? 0 : program_fails("colours", error);
}
