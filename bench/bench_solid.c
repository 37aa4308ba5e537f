/* bench_solid.c - tribox_grid_fill_solid against the solid voxelizers of baseline_solid.h, and against
 * tribox_grid_fill of the same mesh and grid.
 *
 * Times exclude clearing the bits, whose pages are touched before. A rival's other voxels are what its float
 * arithmetic gets wrong: rows that leak, to the region's end.
 *
 *   build/native/bench_solid --mesh dragon --n 512 --only solid --runs 20      one row alone, for a profiler
 */
#include "bench.h"
#include "baseline_solid.h"
#include "mesh_gen.h"

typedef struct job {
    tribox_grid grid;
    tribox_mesh mesh;
    tribox_mesh_f64 doubles;
    uint64_t *bits;
    size_t words;
    size_t crossings;
    baseline_lists lists;
} job;

static void clear(void *context)
{
    job *j = (job *)context;
    memset(j->bits, 0, j->words * sizeof *j->bits);
}

static uint64_t count_bits(void *context)
{
    const job *j = (const job *)context;
    return bench_count_bits(j->bits, j->words);
}

static BENCH_NOINLINE uint64_t run_flip(void *context)
{
    job *j = (job *)context;
    j->crossings = baseline_solid_flip(&j->grid, &j->mesh, j->bits);
    return 0;
}

static BENCH_NOINLINE uint64_t run_sort(void *context)
{
    job *j = (job *)context;
    baseline_solid_sort(&j->grid, &j->mesh, j->bits, &j->lists);
    return 0;
}

static BENCH_NOINLINE uint64_t run_fill(void *context)
{
    job *j = (job *)context;
    tribox_grid_fill(&j->grid, &j->mesh, j->bits);
    return 0;
}

static BENCH_NOINLINE uint64_t run_solid(void *context)
{
    job *j = (job *)context;
    tribox_grid_fill_solid(&j->grid, &j->mesh, j->bits);
    return 0;
}

static BENCH_NOINLINE uint64_t run_solid_f64(void *context)
{
    job *j = (job *)context;
    tribox_grid_fill_solid_f64(&j->grid, &j->doubles, j->bits);
    return 0;
}

static void print_heading(const char *title)
{
    printf("\n%s (medians; times in ms)\n%-18s %5s %10s %9s | %8s %8s %8s | %8s %8s | %7s | %s\n", title,
           "mesh", "n", "voxels", "crossings", "flip", "sort", "fill", "solid", "f64", "ns/cros",
           "rival / solid: best median, other voxels; solid / fill");
}

static void print_time(const bench_row *rows, int count, uint64_t (*run)(void *context))
{
    int i;
    for (i = 0; i < count; i++) {
        if (rows[i].run == run) {
            printf(" %8.2f", 1e3 * rows[i].median);
            return;
        }
    }
    printf(" %8s", "-");
}

static const bench_row *find_row(const bench_row *rows, int count, uint64_t (*run)(void *context))
{
    int i;
    for (i = 0; i < count; i++) {
        if (rows[i].run == run) {
            return &rows[i];
        }
    }
    return NULL;
}

/* One mesh in one region. Returns our nanoseconds for each crossing, 0 if it was not measured. */
static double bench_job(const bench_options *options, const char *name, int n, const tribox_grid *grid,
                        const mesh *m)
{
    bench_row rows[5];
    const bench_row *rival;
    const bench_row *ours;
    const bench_row *surface;
    char title[64];
    double per_crossing = 0;
    double *positions = (double *)bench_alloc(3 * m->vertices * sizeof *positions);
    size_t rows_in_grid = (size_t)(grid->hi[1] - grid->lo[1]) * (size_t)(grid->hi[2] - grid->lo[2]);
    job j;
    int count = 0;
    int runs;
    int i;
    size_t k;
    for (k = 0; k < 3 * m->vertices; k++) {
        positions[k] = (double)m->positions[k];
    }
    j.grid = *grid;
    j.mesh = mesh_view(m);
    j.doubles.positions = positions;
    j.doubles.stride = 0;
    j.doubles.indices = j.mesh.indices;
    j.doubles.triangles = j.mesh.triangles;
    j.words = tribox_grid_words(grid);
    j.bits = (uint64_t *)bench_alloc(j.words * sizeof *j.bits);
    clear(&j);
    run_flip(&j);
    j.lists.capacity = j.crossings + 1;
    j.lists.head = (int32_t *)bench_alloc(rows_in_grid * sizeof *j.lists.head);
    j.lists.node = (baseline_node *)bench_alloc(j.lists.capacity * sizeof *j.lists.node);
    bench_add(rows, &count, "flip", BENCH_RIVAL, run_flip);
    bench_add(rows, &count, "sort", BENCH_RIVAL, run_sort);
    bench_add(rows, &count, "fill", BENCH_NOTE, run_fill);
    bench_add(rows, &count, "solid", BENCH_OURS, run_solid);
    bench_add(rows, &count, "doubles", BENCH_NOTE, run_solid_f64);
    count = bench_keep(options, rows, count);
    for (i = 0; i < count; i++) {
        rows[i].prepare = clear;
        rows[i].count = count_bits;
    }
    runs = bench_measure(rows, count, bench_runs(options, 21), options->quick ? 0.5 : 2.0, &j);
    rival = bench_rival(rows, count);
    ours = find_row(rows, count, run_solid);
    surface = find_row(rows, count, run_fill);
    printf("%-18s %5d %10llu %9lu |", name, n,
           (unsigned long long)(ours != NULL ? ours : rows)->sum, (unsigned long)j.crossings);
    print_time(rows, count, run_flip);
    print_time(rows, count, run_sort);
    print_time(rows, count, run_fill);
    printf(" |");
    print_time(rows, count, run_solid);
    print_time(rows, count, run_solid_f64);
    if (ours != NULL) {
        per_crossing = 1e9 * ours->median / (double)j.crossings;
        printf(" | %7.1f |", per_crossing);
    }
    if (ours != NULL && rival != NULL) {
        printf(" %5.2f %5.2f %+lld;", rival->best / ours->best, bench_ratio(rival, ours, runs),
               (long long)(rival->sum - ours->sum));
    }
    if (ours != NULL && surface != NULL) {
        printf(" %.2f", bench_ratio(ours, surface, runs));
    }
    putchar('\n');
    fflush(stdout);
    snprintf(title, sizeof title, "solid %s %d", name, n);
    for (i = 0; i < count; i++) {
        bench_csv(options, title, &rows[i], 1e3, rival != NULL ? rows[i].best / rival->best : 0,
                  rival != NULL ? bench_ratio(&rows[i], rival, runs) : 0);
    }
    free(j.bits);
    free(j.lists.head);
    free(j.lists.node);
    free(positions);
    return per_crossing;
}

static int wanted(const bench_options *options, const char *name, int n)
{
    return (options->mesh == NULL || strcmp(options->mesh, name) == 0) &&
           (options->n == 0 || options->n == n);
}

static void bench_fitted(const bench_options *options, const char *name, const mesh *m, const int *sizes)
{
    tribox_mesh view = mesh_view(m);
    for (; *sizes > 0; sizes++) {
        tribox_grid grid;
        if (wanted(options, name, *sizes) && tribox_grid_fit(&grid, &view, *sizes)) {
            bench_job(options, name, *sizes, &grid, m);
        }
    }
}

static void bench_file(const bench_options *options, const char *name, const char *path, const int *sizes)
{
    char error[MESH_ERROR];
    FILE *file = fopen(path, "rb");
    mesh m;
    if (file == NULL) {
        printf("%s: not fetched (make bench-data)\n", name);
        return;
    }
    fclose(file);
    if (!mesh_read(&m, path, error)) {
        fprintf(stderr, "%s\n", error);
        exit(1);
    }
    bench_fitted(options, name, &m, sizes);
    mesh_free(&m);
}

/* A height field over n x n cells, closed below: whole heights, so every corner is on the lattice of n cells a
 * side of MESH_GEN_EXTENT. Steps of up to 2 in the direction of `up`. */
static void make_terrain(mesh *m, int n, int up)
{
    uint64_t seed = 11;
    float scale = (float)MESH_GEN_EXTENT / (float)n;
    size_t side = (size_t)n + 1;
    size_t triangle = 0;
    size_t layer;
    size_t i;
    size_t j;
    mesh_gen_alloc(m, 2 * side * side, 4 * (size_t)n * (size_t)n);
    for (layer = 0; layer < 2; layer++) {
        for (i = 0; i < side; i++) {
            for (j = 0; j < side; j++) {
                float *v = m->positions + 3 * ((layer * side + i) * side + j);
                int border = i == 0 || j == 0 || i == side - 1 || j == side - 1;
                int height = layer == 0 || border ? 0 : n / 4 + bench_below(&seed, 3);
                v[up] = scale * (float)height;
                v[(up + 1) % 3] = scale * (float)i;
                v[(up + 2) % 3] = scale * (float)j;
            }
        }
        for (i = 0; i + 1 < side; i++) {
            for (j = 0; j + 1 < side; j++) {
                size_t a = (layer * side + i) * side + j;
                mesh_gen_triangle(m, triangle++, a, a + side, a + 1);
                mesh_gen_triangle(m, triangle++, a + 1, a + side, a + side + 1);
            }
        }
    }
}

/* Voxels of MESH_GEN_EXTENT / n in a region around the mesh, which is on their planes (shift 0) or on their
 * centres' lines (shift 0.5). */
static void lattice_grid(tribox_grid *grid, const mesh *m, int n, double shift)
{
    size_t i;
    int k;
    for (k = 0; k < 3; k++) {
        float low = m->positions[k];
        float high = low;
        for (i = 1; i < m->vertices; i++) {
            low = m->positions[3 * i + (size_t)k] < low ? m->positions[3 * i + (size_t)k] : low;
            high = m->positions[3 * i + (size_t)k] > high ? m->positions[3 * i + (size_t)k] : high;
        }
        grid->size[k] = (double)MESH_GEN_EXTENT / n;
        grid->origin[k] = shift * grid->size[k];
        grid->lo[k] = (int)floor((double)low / grid->size[k]) - 1;
        grid->hi[k] = (int)ceil((double)high / grid->size[k]) + 1;
    }
    grid->flags = 0;
}

static void bench_lattice(const bench_options *options, const char *name, mesh *m, const int *sizes)
{
    static const char *const kinds[3] = {"", " half", " tilted"};
    double cost[3][8];
    int kind;
    int i;
    for (kind = 0; kind < 3; kind++) {
        if (kind == 2) {
            mesh_gen_tilt(m);
        }
        for (i = 0; sizes[i] > 0; i++) {
            char title[64];
            tribox_grid grid;
            snprintf(title, sizeof title, "%s%s", name, kinds[kind]);
            lattice_grid(&grid, m, sizes[i], kind == 1 ? 0.5 : 0);
            cost[kind][i] =
                wanted(options, title, sizes[i]) ? bench_job(options, title, sizes[i], &grid, m) : 0;
            if (kind == 2 && cost[2][i] > 0 && cost[1][i] > 0) {
                printf("%-18s %5d: a crossing takes %.2f (planes) and %.2f (centres) x that of the tilted one\n",
                       name, sizes[i], cost[0][i] / cost[2][i], cost[1][i] / cost[2][i]);
            }
        }
    }
    mesh_free(m);
}

int main(int argc, char **argv)
{
    static const int all[] = {64, 128, 256, 512, 1024, 0};
    static const int quick[] = {128, 512, 0};
    bench_options options;
    const int *sizes;
    mesh m;
    if (!bench_parse(argc, argv, &options)) {
        return 1;
    }
    sizes = options.quick ? quick : all;
    bench_header("meshes into the solid");
    print_heading("Scans");
    mesh_gen_scan(&m, 2447, 178);
    bench_fitted(&options, "scan", &m, sizes);
    mesh_free(&m);
    bench_file(&options, "dragon", "bench/data/dragon.ply", sizes);
    print_heading("Few triangles");
    mesh_gen_scan(&m, 180, 14);
    bench_fitted(&options, "scan5k", &m, sizes);
    mesh_free(&m);
    mesh_gen_scan(&m, 275, 20);
    bench_fitted(&options, "scan11k", &m, sizes);
    mesh_free(&m);
    bench_file(&options, "bunny", "bench/data/bunny.ply", sizes);
    print_heading("On planes of the grid, on lines of centres, and tilted");
    mesh_gen_terraces(&m, 128);
    bench_lattice(&options, "terraces", &m, quick);
    mesh_gen_octahedron(&m, 64);
    bench_lattice(&options, "octahedron", &m, quick);
    make_terrain(&m, 256, 2);
    bench_lattice(&options, "terrain", &m, quick);
    make_terrain(&m, 256, 0);
    bench_lattice(&options, "terrain along x", &m, quick);
    return 0;
}
