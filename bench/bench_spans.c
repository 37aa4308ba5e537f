/* bench_spans.c - single triangles as large as their region: tribox_grid_spans and tribox_grid_fill against
 * the [SS10] loop, per voxel touched. Spans are counted, emitted into a bit array by a callback, and filled.
 */
#include "bench.h"
#include "baseline_grid.h"
#include "tribox.h"

enum { TRIANGLES = 48 };

typedef struct job {
    float positions[9 * TRIANGLES];
    uint32_t indices[3 * TRIANGLES];
    tribox_grid grid;
    tribox_mesh all;
    uint64_t *bits;
    size_t words;
} job;

static void make_job(job *j, int n, uint64_t seed)
{
    int i;
    for (i = 0; i < 9 * TRIANGLES; i++) {
        j->positions[i] = bench_uniform(&seed, 0.0f, 0.1f * (float)n);
    }
    for (i = 0; i < 3 * TRIANGLES; i++) {
        j->indices[i] = (uint32_t)i;
    }
    for (i = 0; i < 3; i++) {
        j->grid.origin[i] = 0;
        j->grid.size[i] = 0.1;
        j->grid.lo[i] = 0;
        j->grid.hi[i] = n;
    }
    j->grid.flags = 0;
    j->all.positions = j->positions;
    j->all.stride = 0;
    j->all.indices = j->indices;
    j->all.triangles = TRIANGLES;
    j->words = tribox_grid_words(&j->grid);
    j->bits = (uint64_t *)bench_alloc(j->words * sizeof *j->bits);
}

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

static BENCH_NOINLINE uint64_t run_ss10(void *context)
{
    job *j = (job *)context;
    baseline_fill_ss10(&j->grid, &j->all, j->bits, 0);
    return 0;
}

static BENCH_NOINLINE uint64_t run_ss10_early(void *context)
{
    job *j = (job *)context;
    baseline_fill_ss10(&j->grid, &j->all, j->bits, 1);
    return 0;
}

static BENCH_NOINLINE uint64_t run_fill(void *context)
{
    job *j = (job *)context;
    tribox_grid_fill(&j->grid, &j->all, j->bits);
    return 0;
}

static BENCH_NOINLINE uint64_t run_count(void *context)
{
    const job *j = (const job *)context;
    uint64_t sum = 0;
    int i;
    for (i = 0; i < TRIANGLES; i++) {
        const float *v = j->positions + 9 * i;
        sum += tribox_grid_spans(&j->grid, v, v + 3, v + 6, NULL, NULL);
    }
    return sum;
}

/* Sets the bits of a span, whole words at once. */
static void set_span(void *user, int x0, int x1, int y, int z)
{
    const job *j = (const job *)user;
    size_t row_words = ((size_t)j->grid.hi[0] + 63) / 64;
    uint64_t *row = j->bits + ((size_t)z * (size_t)j->grid.hi[1] + (size_t)y) * row_words;
    uint64_t first = ~UINT64_C(0) << (x0 & 63);
    uint64_t last = ~UINT64_C(0) >> (63 - (x1 & 63));
    int word = x0 >> 6;
    int end = x1 >> 6;
    if (word == end) {
        row[word] |= first & last;
        return;
    }
    row[word] |= first;
    while (++word < end) {
        row[word] = ~UINT64_C(0);
    }
    row[end] |= last;
}

static BENCH_NOINLINE uint64_t run_spans(void *context)
{
    job *j = (job *)context;
    uint64_t sum = 0;
    int i;
    for (i = 0; i < TRIANGLES; i++) {
        const float *v = j->positions + 9 * i;
        sum += tribox_grid_spans(&j->grid, v, v + 3, v + 6, set_span, j);
    }
    return sum;
}

int main(int argc, char **argv)
{
    static const int sizes[] = {4, 16, 64, 256, 1024};
    bench_options options;
    size_t s;
    if (!bench_parse(argc, argv, &options)) {
        return 1;
    }
    bench_header("large triangles");
    for (s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        bench_row rows[5];
        char title[80];
        job j;
        uint64_t touched;
        int count = 0;
        int i;
        if (options.n != 0 && options.n != sizes[s]) {
            continue;
        }
        make_job(&j, sizes[s], 8);
        touched = run_count(&j);
        bench_add(rows, &count, "SS10 loop", BENCH_RIVAL, run_ss10);
        bench_add(rows, &count, "SS10 loop, early exits", BENCH_RIVAL, run_ss10_early);
        bench_add(rows, &count, "tribox_grid_spans, counted", BENCH_OURS, run_count);
        bench_add(rows, &count, "tribox_grid_spans, into bits", BENCH_OURS, run_spans);
        bench_add(rows, &count, "tribox_grid_fill", BENCH_OURS, run_fill);
        for (i = 0; i < count; i++) {
            rows[i].prepare = clear;
            rows[i].count = rows[i].run != run_count ? count_bits : NULL;
        }
        snprintf(title, sizeof title, "triangles in a region of %d^3, per voxel touched (%.0f a triangle)",
                 sizes[s], (double)touched / TRIANGLES);
        bench_table(&options, title, rows, count, 30, (double)touched, &j);
        free(j.bits);
    }
    return 0;
}
