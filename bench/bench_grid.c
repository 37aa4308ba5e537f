/* bench_grid.c - tribox_grid_fill against the voxelizers of baseline_grid.h.
 *
 * A row is one mesh in one region. Times exclude clearing the bits, whose pages are touched before. A row of
 * other voxels in the rival is what its float arithmetic gets wrong close to touching.
 *
 *   build/native/bench_grid --mesh scan --n 512 --only fill --runs 20      one row alone, for a profiler
 */
#include "bench.h"
#include "baseline_grid.h"
#include "mesh_gen.h"

#include <pthread.h>

/* ---- One mesh in one region ---------------------------------------------------------------------------- */

typedef struct job {
    tribox_grid grid;
    tribox_mesh mesh;
    uint64_t *bits;
    size_t words;
    int middle; /* z at which the region is cut for two threads */
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

static BENCH_NOINLINE uint64_t run_loads(void *context)
{
    const job *j = (const job *)context;
    float sum = 0;
    size_t i;
    for (i = 0; i < j->mesh.triangles; i++) {
        const float *a = baseline_corner(&j->mesh, 3 * i);
        const float *b = baseline_corner(&j->mesh, 3 * i + 1);
        const float *c = baseline_corner(&j->mesh, 3 * i + 2);
        sum += (a[0] + a[1] + a[2]) + (b[0] + b[1] + b[2]) + (c[0] + c[1] + c[2]);
    }
    return sum > 0;
}

static BENCH_NOINLINE uint64_t run_ss10(void *context)
{
    job *j = (job *)context;
    baseline_fill_ss10(&j->grid, &j->mesh, j->bits, 0);
    return 0;
}

static BENCH_NOINLINE uint64_t run_ss10_early(void *context)
{
    job *j = (job *)context;
    baseline_fill_ss10(&j->grid, &j->mesh, j->bits, 1);
    return 0;
}

static BENCH_NOINLINE uint64_t run_ss10_skip(void *context)
{
    job *j = (job *)context;
    baseline_fill_ss10_skip(&j->grid, &j->mesh, j->bits);
    return 0;
}

static BENCH_NOINLINE uint64_t run_am(void *context)
{
    job *j = (job *)context;
    baseline_fill_am(&j->grid, &j->mesh, j->bits, 0);
    return 0;
}

static BENCH_NOINLINE uint64_t run_am_early(void *context)
{
    job *j = (job *)context;
    baseline_fill_am(&j->grid, &j->mesh, j->bits, 1);
    return 0;
}

static BENCH_NOINLINE uint64_t run_fill(void *context)
{
    job *j = (job *)context;
    tribox_grid_fill(&j->grid, &j->mesh, j->bits);
    return 0;
}

/* ---- Two threads --------------------------------------------------------------------------------------- */

static void fill_slab(const job *j, int lo, int hi)
{
    tribox_grid slab = j->grid;
    size_t ny = (size_t)(slab.hi[1] - slab.lo[1]);
    size_t row_words = ((size_t)(slab.hi[0] - slab.lo[0]) + 63) / 64;
    slab.lo[2] = lo;
    slab.hi[2] = hi;
    tribox_grid_fill(&slab, &j->mesh, j->bits + (size_t)(lo - j->grid.lo[2]) * ny * row_words);
}

static void *upper_slab(void *context)
{
    const job *j = (const job *)context;
    fill_slab(j, j->middle, j->grid.hi[2]);
    return NULL;
}

static BENCH_NOINLINE uint64_t run_two_threads(void *context)
{
    job *j = (job *)context;
    pthread_t thread;
    if (pthread_create(&thread, NULL, upper_slab, j) != 0) {
        fprintf(stderr, "cannot start a thread\n");
        exit(1);
    }
    fill_slab(j, j->grid.lo[2], j->middle);
    pthread_join(thread, NULL);
    return 0;
}

/* Of three runs the best, since others may have the processor for a while. */
static double slab_seconds(job *j, int lo, int hi)
{
    double best = 0.0;
    int run;
    for (run = 0; run < 3; run++) {
        double start;
        double seconds;
        clear(j);
        start = bench_now();
        fill_slab(j, lo, hi);
        seconds = bench_now() - start;
        best = run == 0 || seconds < best ? seconds : best;
    }
    return best;
}

/* The z that cuts the region into two slabs of equal work, found by timing them. */
static void find_middle(job *j)
{
    int lo = j->grid.lo[2];
    int hi = j->grid.hi[2];
    while (hi - lo > 2) {
        j->middle = lo + (hi - lo) / 2;
        if (slab_seconds(j, j->grid.lo[2], j->middle) < slab_seconds(j, j->middle, j->grid.hi[2])) {
            lo = j->middle;
        } else {
            hi = j->middle;
        }
    }
}

/* ---- Tables -------------------------------------------------------------------------------------------- */

static void job_start(job *j, const tribox_grid *grid, const tribox_mesh *view)
{
    j->grid = *grid;
    j->mesh = *view;
    j->middle = 0;
    j->words = tribox_grid_words(grid);
    j->bits = (uint64_t *)bench_alloc(j->words * sizeof *j->bits);
}

static int wanted(const bench_options *options, const char *name, int n)
{
    return (options->mesh == NULL || strcmp(options->mesh, name) == 0) &&
           (options->n == 0 || options->n == n);
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

/* With --mesh one heading does for all. */
static void print_heading(const bench_options *options, const char *title)
{
    static int printed;
    if (options->mesh != NULL && printed++ > 0) {
        return;
    }
    printf("\n%s (medians; times in ms)\n"
           "%-16s %5s %9s %6s | %7s %8s %8s %8s %8s %8s %8s | %7s %8s | %s\n",
           title, "mesh", "n", "voxels", "MiB", "loads", "SS10", "early", "skip", "AM", "early", "fill",
           "ns/tri", "ns/voxel", "rival / fill: best median, other voxels");
}

static void print_time(const bench_row *row)
{
    if (row != NULL) {
        printf(" %8.2f", 1e3 * row->median);
    } else {
        printf(" %8s", "-");
    }
}

/* Measures one mesh in one region, prints a line, and returns our nanoseconds per voxel set (0: not
 * measured). */
static double bench_job(const bench_options *options, const char *name, int n, const tribox_grid *grid,
                        const tribox_mesh *view)
{
    bench_row rows[7];
    const bench_row *rival;
    const bench_row *ours;
    char title[64];
    double per_voxel = 0;
    double triangles = (double)view->triangles;
    job j;
    int count = 0;
    int runs;
    int i;
    job_start(&j, grid, view);
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_loads);
    bench_add(rows, &count, "SS10", BENCH_RIVAL, run_ss10);
    bench_add(rows, &count, "SS10, early exits", BENCH_RIVAL, run_ss10_early);
    bench_add(rows, &count, "SS10, skips set", BENCH_RIVAL, run_ss10_skip);
    bench_add(rows, &count, "AM, skips set", BENCH_RIVAL, run_am);
    bench_add(rows, &count, "AM, skips set, early exits", BENCH_RIVAL, run_am_early);
    bench_add(rows, &count, "fill", BENCH_OURS, run_fill);
    count = bench_keep(options, rows, count);
    for (i = 0; i < count; i++) {
        rows[i].prepare = clear;
        rows[i].count = rows[i].role != BENCH_REFERENCE ? count_bits : NULL;
    }
    runs = bench_measure(rows, count, bench_runs(options, 15), options->quick ? 0.5 : 2.0, &j);
    rival = bench_rival(rows, count);
    ours = find_row(rows, count, run_fill);
    printf("%-16s %5d %9llu %6.1f |", name, n,
           (unsigned long long)(ours != NULL    ? ours
                                : rival != NULL ? rival
                                                : rows)
               ->sum,
           (double)j.words * 8 / 1048576);
    print_time(find_row(rows, count, run_loads));
    print_time(find_row(rows, count, run_ss10));
    print_time(find_row(rows, count, run_ss10_early));
    print_time(find_row(rows, count, run_ss10_skip));
    print_time(find_row(rows, count, run_am));
    print_time(find_row(rows, count, run_am_early));
    print_time(ours);
    if (ours != NULL) {
        per_voxel = 1e9 * ours->median / (double)ours->sum;
        printf(" | %7.1f %8.2f |", 1e9 * ours->median / triangles, per_voxel);
    }
    if (ours != NULL && rival != NULL) {
        printf(" %5.2f %5.2f %+lld", rival->best / ours->best, bench_ratio(rival, ours, runs),
               (long long)(rival->sum - ours->sum));
    }
    putchar('\n');
    fflush(stdout);
    snprintf(title, sizeof title, "grid %s %d", name, n);
    for (i = 0; i < count; i++) {
        bench_csv(options, title, &rows[i], 1e3, rival != NULL ? rows[i].best / rival->best : 0,
                  rival != NULL ? bench_ratio(&rows[i], rival, runs) : 0);
    }
    free(j.bits);
    return per_voxel;
}

/* The mesh framed by tribox_grid_fit at each resolution. */
static void bench_fitted(const bench_options *options, const char *name, const tribox_mesh *view,
                         const int *sizes)
{
    for (; *sizes > 0; sizes++) {
        tribox_grid grid;
        if (wanted(options, name, *sizes) && tribox_grid_fit(&grid, view, *sizes)) {
            bench_job(options, name, *sizes, &grid, view);
        }
    }
}

static void bench_threads(const bench_options *options, const char *name, int n, const tribox_mesh *view)
{
    bench_row rows[2];
    job j;
    tribox_grid grid;
    int count = 0;
    int runs;
    int i;
    if (!wanted(options, name, n) || options->only != NULL || !tribox_grid_fit(&grid, view, n)) {
        return;
    }
    job_start(&j, &grid, view);
    find_middle(&j);
    bench_add(rows, &count, "one call", BENCH_RIVAL, run_fill);
    bench_add(rows, &count, "two slabs, two threads", BENCH_OURS, run_two_threads);
    for (i = 0; i < count; i++) {
        rows[i].prepare = clear;
        rows[i].count = count_bits;
    }
    runs = bench_measure(rows, count, bench_runs(options, 25), options->quick ? 0.5 : 2.0, &j);
    printf("\nTwo z-slabs of equal work on two threads\n%-16s %5d: one thread %8.2f ms, two %8.2f ms, %4.2f "
           "x faster (best %4.2f), %s\n",
           name, n, 1e3 * rows[0].median, 1e3 * rows[1].median, bench_ratio(&rows[0], &rows[1], runs),
           rows[0].best / rows[1].best, rows[0].sum == rows[1].sum ? "same voxels" : "DIFFERENT VOXELS");
    bench_csv(options, "threads", &rows[0], 1e3, 1, 1);
    bench_csv(options, "threads", &rows[1], 1e3, rows[1].best / rows[0].best,
              bench_ratio(&rows[1], &rows[0], runs));
    free(j.bits);
}

/* Voxels of MESH_GEN_EXTENT / n, their corners on the lattice, in a region around the mesh. */
static void lattice_grid(tribox_grid *grid, const mesh *m, int n)
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
        grid->origin[k] = 0;
        grid->size[k] = (double)MESH_GEN_EXTENT / n;
        grid->lo[k] = (int)floor((double)low / grid->size[k]) - 1;
        grid->hi[k] = (int)ceil((double)high / grid->size[k]) + 1;
    }
    grid->flags = 0;
}

/* A mesh on the lattice against the same mesh tilted, voxels of one size: what exact touching costs. */
static void bench_lattice(const bench_options *options, const char *name, mesh *m, const int *sizes)
{
    char tilted[32];
    double on_lattice[8];
    int i;
    snprintf(tilted, sizeof tilted, "%s tilted", name);
    for (i = 0; sizes[i] > 0; i++) {
        tribox_mesh view = mesh_view(m);
        tribox_grid grid;
        lattice_grid(&grid, m, sizes[i]);
        on_lattice[i] =
            wanted(options, name, sizes[i]) ? bench_job(options, name, sizes[i], &grid, &view) : 0;
    }
    mesh_gen_tilt(m);
    for (i = 0; sizes[i] > 0; i++) {
        tribox_mesh view = mesh_view(m);
        tribox_grid grid;
        double general;
        lattice_grid(&grid, m, sizes[i]);
        general = wanted(options, tilted, sizes[i]) ? bench_job(options, tilted, sizes[i], &grid, &view) : 0;
        if (general > 0 && on_lattice[i] > 0) {
            printf("%-16s %5d: %.2f x the time per voxel of the tilted one\n", name, sizes[i],
                   on_lattice[i] / general);
        }
    }
    mesh_free(m);
}

static int any_wanted(const bench_options *options, const char *name)
{
    return options->mesh == NULL || strncmp(options->mesh, name, strlen(name)) == 0;
}

/* Reads a fetched mesh, if it is there. */
static int read_data(const bench_options *options, const char *name, const char *path, mesh *m)
{
    char error[MESH_ERROR];
    FILE *file;
    if (!any_wanted(options, name)) {
        return 0;
    }
    file = fopen(path, "rb");
    if (file == NULL) {
        printf("%s: not fetched (make bench-data)\n", name);
        return 0;
    }
    fclose(file);
    if (!mesh_read(m, path, error)) {
        fprintf(stderr, "%s\n", error);
        exit(1);
    }
    return 1;
}

int main(int argc, char **argv)
{
    static const int all[] = {64, 128, 256, 512, 1024, 2048, 0};
    static const int quick[] = {128, 512, 0};
    static const int some[] = {128, 512, 1024, 0};
    static const int coarse[] = {128, 512, 0};
    bench_options options;
    const int *sizes;
    mesh scan;
    mesh m;
    tribox_mesh view;
    if (!bench_parse(argc, argv, &options)) {
        return 1;
    }
    sizes = options.quick ? quick : all;
    bench_header("meshes into a bit array");
    print_heading(&options, "Scans");
    mesh_gen_scan(&scan, 2447, 178);
    view = mesh_view(&scan);
    bench_fitted(&options, "scan", &view, sizes);
    if (read_data(&options, "dragon", "bench/data/dragon.ply", &m)) {
        view = mesh_view(&m);
        bench_fitted(&options, "dragon", &view, sizes);
        mesh_free(&m);
    }
    print_heading(&options, "Few triangles");
    sizes = options.quick ? quick : some;
    mesh_gen_scan(&m, 180, 14);
    view = mesh_view(&m);
    bench_fitted(&options, "scan5k", &view, sizes);
    mesh_free(&m);
    mesh_gen_scan(&m, 275, 20);
    view = mesh_view(&m);
    bench_fitted(&options, "scan11k", &view, sizes);
    mesh_free(&m);
    if (read_data(&options, "bunny", "bench/data/bunny.ply", &m)) {
        view = mesh_view(&m);
        bench_fitted(&options, "bunny", &view, sizes);
        mesh_free(&m);
    }

    print_heading(&options, "On grid planes and through grid corners, against the same meshes tilted");
    if (any_wanted(&options, "terraces")) {
        mesh_gen_terraces(&m, 128);
        bench_lattice(&options, "terraces", &m, sizes);
    }
    if (any_wanted(&options, "blocks")) {
        mesh_gen_terraces(&m, 16);
        bench_lattice(&options, "blocks", &m, coarse);
    }
    if (any_wanted(&options, "octahedron")) {
        mesh_gen_octahedron(&m, 64);
        bench_lattice(&options, "octahedron", &m, sizes);
    }
    if (any_wanted(&options, "diamond")) {
        mesh_gen_octahedron(&m, 8);
        bench_lattice(&options, "diamond", &m, coarse);
    }

    view = mesh_view(&scan);
    bench_threads(&options, "scan", 1024, &view);
    mesh_free(&scan);
    return 0;
}
