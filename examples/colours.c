/* colours - voxels with the colour of the nearest point of the surface
 *
 *   build/colours [mesh] [resolution] [file.ply]       default: the teapot at 64, written to nothing
 *
 * Every vertex has a colour, here its place in the mesh's bounds. Each triangle's spans give its voxels; for
 * each, tribox_closest gives the weights of the triangle's point nearest to the voxel's centre, and with them
 * colour and distance; the nearest triangle wins. Prints:
 *
 *   voxels    7412 of 64 x 40 x 32, each with a colour
 *   mean      red 0.47 green 0.50 blue 0.43
 */
#include "program.h"

typedef struct cell {
    float colour[3];
    float distance2;        /* of the point that gave the colour; FLT_MAX: not touched */
} cell;

typedef struct painter {
    tribox_grid  grid;
    tribox_mesh  mesh;
    cell        *cells;
    const float *v[3];      /* the triangle at hand */
} painter;

static float centre_of(const tribox_grid *g, int a, int i) {
    return (float)(g->origin[a] + (i + 0.5) * g->size[a]);
}

static cell *cell_at(const painter *p, int x, int y, int z) {
    const tribox_grid *g = &p->grid;
    size_t row = (size_t)(z - g->lo[2]) * (size_t)(g->hi[1] - g->lo[1]) + (size_t)(y - g->lo[1]);
    return &p->cells[row * (size_t)(g->hi[0] - g->lo[0]) + (size_t)(x - g->lo[0])];
}

/* A tribox_span_fn. */
static void paint(void *user, int x0, int x1, int y, int z) {
    painter *p = (painter *)user;
    int x;
    for (x = x0; x <= x1; x++) {
        const float q[3] = {centre_of(&p->grid, 0, x), centre_of(&p->grid, 1, y), centre_of(&p->grid, 2, z)};
        cell *c = cell_at(p, x, y, z);
        float w[3];
        float d2 = 0;
        float at[3];
        int a;
        tribox_closest(p->v[0], p->v[1], p->v[2], q, w);
        for (a = 0; a < 3; a++) {
            at[a] = w[0] * p->v[0][a] + w[1] * p->v[1][a] + w[2] * p->v[2][a];
            d2 += (at[a] - q[a]) * (at[a] - q[a]);
        }
        if (d2 < c->distance2) {
            c->distance2 = d2;
            /* the colour is linear over the triangle, so the point's place gives it */
            for (a = 0; a < 3; a++) {
                const double side = p->grid.size[a] * (p->grid.hi[a] - p->grid.lo[a]);
                c->colour[a] = (float)(((double)at[a] - p->grid.origin[a]) / side);
            }
        }
    }
}

static int byte_of(float x) {
    return x < 0 ? 0 : x > 1 ? 255 : (int)(x * 255.0f + 0.5f);
}

/* Counts and, if there is a file, writes one coloured point a voxel. */
static void report(const painter *p, FILE *file) {
    const int *hi = p->grid.hi;
    double sum[3] = {0, 0, 0};
    unsigned long count = 0;
    int pass;
    int x;
    int y;
    int z;
    for (pass = 0; pass < 2; pass++) {
        if (pass == 1 && file) {
            fprintf(file, "ply\nformat ascii 1.0\nelement vertex %lu\nproperty float x\nproperty float y\n"
                    "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                    "end_header\n",
                    count);
        }
        for (z = 0; z < hi[2]; z++) {
            for (y = 0; y < hi[1]; y++) {
                for (x = 0; x < hi[0]; x++) {
                    const cell *c = cell_at(p, x, y, z);
                    if (c->distance2 >= FLT_MAX) {
                        continue;
                    }
                    if (pass == 0) {
                        count++;
                        sum[0] += (double)c->colour[0];
                        sum[1] += (double)c->colour[1];
                        sum[2] += (double)c->colour[2];
                    } else if (file) {
                        fprintf(file, "%.9g %.9g %.9g %d %d %d\n", (double)centre_of(&p->grid, 0, x),
                                (double)centre_of(&p->grid, 1, y), (double)centre_of(&p->grid, 2, z),
                                byte_of(c->colour[0]), byte_of(c->colour[1]), byte_of(c->colour[2]));
                    }
                }
            }
        }
    }
    printf("voxels    %lu of %d x %d x %d, each with a colour\n", count, hi[0], hi[1], hi[2]);
    printf("mean      red %.2f green %.2f blue %.2f\n", sum[0] / (double)count, sum[1] / (double)count,
           sum[2] / (double)count);
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: colours [mesh] [resolution from 1 to 512] [file.ply]";
    int asked;
    int resolution = 64;
    FILE *file = NULL;
    painter p;
    mesh m;
    size_t cells;
    size_t i;
    if ((asked = program_arguments("colours", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 4 || (argc > 2 && !program_int(argv[2], 1, 512, &resolution)) ||
        !program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("colours", error);
    }
    p.mesh = mesh_view(&m);
    if (!tribox_grid_fit(&p.grid, &p.mesh, resolution)) {
        return program_fails("colours", "the mesh is a single point, or too large to frame");
    }
    cells = (size_t)p.grid.hi[0] * (size_t)p.grid.hi[1] * (size_t)p.grid.hi[2];
    p.cells = (cell *)malloc(cells * sizeof *p.cells);
    if (!p.cells || (argc > 3 && (file = fopen(argv[3], "w")) == NULL)) {
        return program_fails("colours", "out of memory, or cannot write the file");
    }
    for (i = 0; i < cells; i++) {
        p.cells[i].distance2 = FLT_MAX;
    }
    for (i = 0; i < p.mesh.triangles; i++) {
        mesh_corners(&p.mesh, i, p.v);
        tribox_grid_spans(&p.grid, p.v[0], p.v[1], p.v[2], paint, &p);
    }
    report(&p, file);
    if (file && fclose(file) != 0) {
        return program_fails("colours", "cannot write the file");
    }
    free(p.cells);
    mesh_free(&m);
    return 0;
}
