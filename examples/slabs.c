/* slabs - one mesh, several threads, the same bits
 *
 *   build/slabs [mesh] [resolution] [threads]       default: the teapot at 512 on two threads
 *
 * A slab is the grid's region cut smaller in z, and its words are a part of the whole array, so slabs can
 * be filled at once. Two things make that fast. No slab's fill looks at the whole mesh: blocks of 64
 * triangles that follow each other are mostly near each other, so a slab takes the blocks whose extent in
 * z meets it. (Where the mesh has no such order, its triangles are sorted by z first.) And there are more
 * slabs than threads, handed out one by one, so that all threads end at about the same time. Prints the
 * times of one call and of the threads, preparation included, and compares the bits. Exit status: 0 the
 * same bits, 1 not the same, 2 an error.
 */
#if !defined(_MSC_VER) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200112L
#endif
#include "program.h"
#include "voxel_io.h"

/* ---- 1. Threads of POSIX or of C11 ----------------------------------------------------------- */

#if !defined(_MSC_VER)
#include <pthread.h>
typedef pthread_t       thread;
typedef pthread_mutex_t lock;
#define THREAD_RESULT void *
#define THREAD_DONE NULL
#define lock_make(l) (pthread_mutex_init(l, NULL) == 0)
#define lock_take(l) pthread_mutex_lock(l)
#define lock_give(l) pthread_mutex_unlock(l)
#define lock_free(l) pthread_mutex_destroy(l)
#define thread_start(t, run, user) (pthread_create(t, NULL, run, user) == 0)
#define thread_join(t) pthread_join(t, NULL)
#else
#include <threads.h>
typedef thrd_t thread;
typedef mtx_t  lock;
#define THREAD_RESULT int
#define THREAD_DONE 0
#define lock_make(l) (mtx_init(l, mtx_plain) == thrd_success)
#define lock_take(l) mtx_lock(l)
#define lock_give(l) mtx_unlock(l)
#define lock_free(l) mtx_destroy(l)
#define thread_start(t, run, user) (thrd_create(t, run, user) == thrd_success)
#define thread_join(t) thrd_join(t, NULL)
#endif

static double wall_seconds(void) {
    struct timespec now;
#if !defined(_MSC_VER)
    clock_gettime(CLOCK_MONOTONIC, &now);
#else
    timespec_get(&now, TIME_UTC);
#endif
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- 2. The work ----------------------------------------------------------------------------- */

enum { MAX_THREADS = 256, SLABS_PER_THREAD = 8, BLOCK = 64 };

typedef struct block {
    uint32_t first;                     /* slabs that it meets; first > last: none */
    uint32_t last;
} block;

typedef struct job {
    mesh               mesh;            /* borrowed; `indices` is the sorted one's, if it was sorted */
    const voxels      *v;
    int                threads;
    int                height;          /* layers in a slab; the last may have fewer */
    size_t             slabs;
    block             *blocks;
    size_t             block_count;
    size_t            *count;           /* [slab * threads + thread]: triangles, then the next one's place */
    uint32_t          *sorted;          /* indices of the sorted mesh */
    lock               lock;
    size_t             next_slab;       /* under the lock */
} job;

typedef struct worker {
    job   *job;
    int    number;
    thread thread;
    void (*run)(struct worker *w);
} worker;

/* Slabs that a set from lo to hi in z can touch. z and origin are exact, so the quotient is off by a few
   units of 2^-53 of itself: 1e-9 of it is on the safe side. What lies on a layer's lower border touches
   the layer below too, and the lowered `low` is already in that one. */
static block slabs_between(const job *j, double lo, double hi) {
    const tribox_grid *g = &j->v->grid;
    double low = (lo - g->origin[2]) / g->size[2] - g->lo[2];
    double high = (hi - g->origin[2]) / g->size[2] - g->lo[2];
    double layers = (double)j->v->n[2];
    block none = {1, 0};
    block met;
    low -= 1e-9 * (fabs(low) + fabs((double)g->lo[2]) + 1);
    high += 1e-9 * (fabs(high) + fabs((double)g->lo[2]) + 1);
    if (!(low < layers && high >= 0)) {     /* NaN ends here too */
        return none;
    }
    met.first = (uint32_t)((low < 0 ? 0 : low) / j->height);
    met.last = (uint32_t)((high < layers ? high : layers - 1) / j->height);
    return met;
}

/* Slabs that the triangles from `begin` up to `end` meet. A NaN never compares, and its triangle sets
   nothing anyway. */
static block slabs_of_triangles(const job *j, size_t begin, size_t end) {
    double lo = HUGE_VAL;
    double hi = -HUGE_VAL;
    size_t t;
    int i;
    for (t = begin; t < end; t++) {
        for (i = 0; i < 3; i++) {
            double corner[3];
            mesh_corner_f64(&j->mesh, t, (size_t)i, corner);
            lo = corner[2] < lo ? corner[2] : lo;
            hi = corner[2] > hi ? corner[2] : hi;
        }
    }
    return slabs_between(j, lo, hi);
}

/* Thread w's share of n things: from share(w, 0, n) up to share(w, 1, n). */
static size_t share(const worker *w, int end, size_t n) {
    return (size_t)((double)n * (w->number + end) / w->job->threads);
}

static void measure_blocks(worker *w) {
    const job *j = w->job;
    size_t i;
    for (i = share(w, 0, j->block_count); i < share(w, 1, j->block_count); i++) {
        size_t end = (i + 1) * BLOCK;
        j->blocks[i] = slabs_of_triangles(j, i * BLOCK, end < j->mesh.triangles ? end : j->mesh.triangles);
    }
}

/* How many slabs a block meets on average. */
static double slabs_per_block(const job *j) {
    double sum = 0;
    size_t i;
    for (i = 0; i < j->block_count; i++) {
        sum += (double)j->blocks[i].last + 1 - j->blocks[i].first;
    }
    return sum / (double)j->block_count;
}

/* The place of triangle t's count: by its lowest slab; those that meet none stand with slab 0. */
static size_t *count_of(const worker *w, size_t t) {
    block met = slabs_of_triangles(w->job, t, t + 1);
    size_t slab = met.first <= met.last ? met.first : 0;
    return &w->job->count[slab * (size_t)w->job->threads + (size_t)w->number];
}

static void count_triangles(worker *w) {
    size_t t;
    for (t = share(w, 0, w->job->mesh.triangles); t < share(w, 1, w->job->mesh.triangles); t++) {
        *count_of(w, t) += 1;
    }
}

/* Counts become places: slab after slab, in it thread after thread. */
static void place_triangles(job *j) {
    size_t total = 0;
    size_t i;
    for (i = 0; i < j->slabs * (size_t)j->threads; i++) {
        size_t count = j->count[i];
        j->count[i] = total;
        total += count;
    }
}

static void sort_triangles(worker *w) {
    const mesh *m = &w->job->mesh;
    size_t t;
    size_t i;
    for (t = share(w, 0, m->triangles); t < share(w, 1, m->triangles); t++) {
        size_t *place = count_of(w, t);
        for (i = 0; i < 3; i++) {
            w->job->sorted[3 * *place + i] = m->indices ? m->indices[3 * t + i] : (uint32_t)(3 * t + i);
        }
        *place += 1;
    }
}

/* Fills slab i with the blocks that meet it; blocks that follow each other go in one call. */
static void fill_slab(const job *j, size_t i) {
    tribox_grid slab = j->v->grid;
    int64_t top = (int64_t)slab.lo[2] + (int64_t)(i + 1) * j->height;
    size_t b = 0;
    slab.lo[2] += (int)i * j->height;
    slab.hi[2] = top < slab.hi[2] ? (int)top : slab.hi[2];
    while (b < j->block_count) {
        size_t first = b;
        size_t end;
        while (b < j->block_count && j->blocks[b].first <= i && i <= j->blocks[b].last) {
            b += 1;
        }
        if (b == first) {
            b += 1;
            continue;
        }
        end = b * BLOCK < j->mesh.triangles ? b * BLOCK : j->mesh.triangles;
        mesh_fill_part(&slab, &j->mesh, first * BLOCK, end, 0, voxels_row(j->v, 0, i * (size_t)j->height));
    }
}

static void fill_slabs(worker *w) {
    job *j = w->job;
    for (;;) {
        size_t i;
        lock_take(&j->lock);
        i = j->next_slab;
        j->next_slab += 1;
        lock_give(&j->lock);
        if (i >= j->slabs) {
            return;
        }
        fill_slab(j, i);
    }
}

static THREAD_RESULT run_worker(void *user) {
    worker *w = (worker *)user;
    w->run(w);
    return THREAD_DONE;
}

/* Runs one step on all threads, this one among them. */
static void run_step(worker *workers, void (*run)(worker *w)) {
    int started[MAX_THREADS] = {0};
    int i;
    for (i = workers[0].job->threads - 1; i >= 0; i--) {
        workers[i].run = run;
        started[i] = i > 0 && thread_start(&workers[i].thread, run_worker, &workers[i]);
        if (!started[i]) {
            run(&workers[i]);       /* also where the system gives no more threads */
        }
    }
    for (i = 1; i < workers[0].job->threads; i++) {
        if (started[i]) {
            thread_join(workers[i].thread);
        }
    }
}

/* The mesh with its triangles in the order of their lowest slab. Returns 0 if memory is short. */
static int sort_mesh(job *j, worker *workers) {
    j->count = (size_t *)calloc(j->slabs * (size_t)j->threads, sizeof *j->count);
    j->sorted = j->mesh.triangles <= SIZE_MAX / 12 ? (uint32_t *)malloc(12 * j->mesh.triangles) : NULL;
    if (!j->count || !j->sorted) {
        return 0;
    }
    run_step(workers, count_triangles);
    place_triangles(j);
    run_step(workers, sort_triangles);
    j->mesh.indices = j->sorted;
    run_step(workers, measure_blocks);
    return 1;
}

/* Fills the whole region on several threads. Returns 1, or 0 if memory is short. */
static int fill_threaded(const voxels *v, const mesh *m, int threads) {
    worker workers[MAX_THREADS];
    job j;
    int i;
    int ok;
    memset(&j, 0, sizeof j);
    j.mesh = *m;
    j.v = v;
    j.threads = threads;
    j.height = (int)((v->n[2] - 1) / (size_t)(threads * SLABS_PER_THREAD) + 1);
    j.slabs = (v->n[2] - 1) / (size_t)j.height + 1;
    j.block_count = (m->triangles + BLOCK - 1) / BLOCK;
    j.blocks = (block *)malloc(j.block_count * sizeof *j.blocks);
    for (i = 0; i < threads; i++) {
        workers[i].job = &j;
        workers[i].number = i;
    }
    ok = j.blocks && lock_make(&j.lock);
    if (ok) {
        run_step(workers, measure_blocks);
        if (slabs_per_block(&j) > 2) {
            ok = sort_mesh(&j, workers);
        }
        if (ok) {
            run_step(workers, fill_slabs);
        }
        lock_free(&j.lock);
    }
    free(j.blocks);
    free(j.count);
    free(j.sorted);
    return ok;
}

/* ---- 3. The comparison ----------------------------------------------------------------------- */

enum { RUNS = 3 };

/* The best of a few runs; threads = 0 is one call for the whole. Returns a negative time if memory
   is short. */
static double best_time(voxels *v, const mesh *m, int threads) {
    double best = HUGE_VAL;
    int run;
    for (run = 0; run < RUNS; run++) {
        double start;
        int ok = 1;
        memset(v->bits, 0, v->words * sizeof *v->bits);
        start = wall_seconds();
        if (threads == 0) {
            mesh_fill(&v->grid, m, v->bits);
        } else {
            ok = fill_threaded(v, m, threads);
        }
        best = ok ? fmin(best, wall_seconds() - start) : -1;
    }
    return best;
}

static int compare(const tribox_grid *grid, const mesh *m, int threads, char *error) {
    voxels whole;
    voxels slabs;
    double one_call;
    double one;
    double many;
    int same;
    if (!voxels_make(&whole, grid, error)) {
        return 2;
    }
    if (!voxels_make(&slabs, grid, error)) {
        voxels_free(&whole);
        return 2;
    }
    one_call = best_time(&whole, m, 0);
    one = best_time(&slabs, m, 1);
    many = best_time(&slabs, m, threads);
    same = memcmp(whole.bits, slabs.bits, whole.words * sizeof *whole.bits) == 0;
    printf("grid        %lu x %lu x %lu, %lu triangles, %lu voxels\n", (unsigned long)whole.n[0],
           (unsigned long)whole.n[1], (unsigned long)whole.n[2], (unsigned long)m->triangles,
           (unsigned long)voxels_count(&whole));
    printf("one call    %.4f s\n", one_call);
    printf("1 thread    %.4f s in slabs\n", one);
    printf("%d threads   %.4f s, %.2f times one call, %.2f times one thread\n", threads, many,
           one_call / many, one / many);
    printf("bits        %s\n", same ? "the same" : "NOT the same");
    voxels_free(&whole);
    voxels_free(&slabs);
    snprintf(error, MESH_ERROR, "out of memory");
    return one < 0 || many < 0 ? 2 : same ? 0 : 1;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: slabs [mesh] [resolution from 1 to 65536] [threads from 1 to 256]";
    int asked;
    int resolution = 512;
    int threads = 2;
    int status = 2;
    tribox_grid grid;
    mesh m;
    if ((asked = program_arguments("slabs", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 4 || (argc > 2 && !program_int(argv[2], 1, 65536, &resolution))
        || (argc > 3 && !program_int(argv[3], 1, MAX_THREADS, &threads))) {
        return program_fails("slabs", error);
    }
    if (!program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("slabs", error);
    }
    mesh_say_exact(&m);
    if (mesh_fit(&grid, &m, resolution)) {
        status = compare(&grid, &m, threads, error);
    } else {
        snprintf(error, sizeof error, "the mesh is a single point, or too large to frame");
    }
    mesh_free(&m);
    return status == 2 ? program_fails("slabs", error) : status;
}
