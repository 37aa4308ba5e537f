/* slabs - one mesh, several threads, the same bits
 *
 *   build/slabs [mesh] [resolution] [threads]       default: the teapot at 512 on two threads
 *
 * A slab is the grid's region cut smaller in z, and its words are a part of the whole array, so slabs can be filled at
 * once. Two things make that fast. Triangles are sorted into the slabs they can touch first, on all threads, so that no
 * slab's fill has to look at the whole mesh; and there are many more slabs than threads, handed out one by one, so that
 * all threads end at about the same time. Prints the times of one call and of the threads, sorting included, and
 * compares the bits. Exit status: 0 the same bits, 1 not the same, 2 an error.
 */
#if !defined(_WIN32) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200112L
#endif
#include "program.h"
#include "voxel_io.h"

/* ---- 1. Threads of POSIX or of C11 ----------------------------------------------------------- */

#if !defined(_WIN32)
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
#if !defined(_WIN32)
    clock_gettime(CLOCK_MONOTONIC, &now);
#else
    timespec_get(&now, TIME_UTC);
#endif
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- 2. The work ----------------------------------------------------------------------------- */

enum { MAX_THREADS = 256, SLABS_PER_THREAD = 16 };

typedef struct job {
    const tribox_mesh *mesh;
    voxels            *v;
    int                threads;
    int                height;          /* layers in a slab; the last may have fewer */
    size_t             slabs;
    size_t            *count;           /* [slab * threads + thread]: triangles, then where the next one's indices go */
    size_t            *first;           /* [slab]: its first triangle in `indices`; one more entry ends the last */
    uint32_t          *indices;
    lock               lock;
    size_t             next_slab;       /* under the lock */
} job;

typedef struct worker {
    job   *job;
    int    number;
    thread thread;
    void (*run)(struct worker *w);
} worker;

static float float_min3(float a, float b, float c) {
    float least = a < b ? a : b;
    return least < c ? least : c;
}

/* Slabs that the triangle can touch, first to last; 0 if there is none. z and origin are exact, so the quotient is off by
   a few units of 2^-53 of itself: 1e-9 of it is on the safe side. */
static int slab_range(const job *j, const float *const corner[3], size_t *out_first, size_t *out_last) {
    const tribox_grid *g = &j->v->grid;
    double lo = ((double)float_min3(corner[0][2], corner[1][2], corner[2][2]) - g->origin[2]) / g->size[2] - g->lo[2];
    double hi = (-(double)float_min3(-corner[0][2], -corner[1][2], -corner[2][2]) - g->origin[2]) / g->size[2] - g->lo[2];
    double layers = (double)j->v->n[2];
    lo -= 1e-9 * (fabs(lo) + fabs((double)g->lo[2]) + 1);
    hi += 1e-9 * (fabs(hi) + fabs((double)g->lo[2]) + 1);
    if (!(lo <= layers && hi >= 0)) {       /* NaN ends here too */
        return 0;
    }
    /* the layer below is touched by what lies on its upper border, and lo is already less than that border */
    lo = lo < 0 ? 0 : lo >= layers ? layers - 1 : lo;
    hi = hi >= layers ? layers - 1 : hi;
    *out_first = (size_t)lo / (size_t)j->height;
    *out_last = (size_t)hi / (size_t)j->height;
    return 1;
}

/* Thread w's share of the triangles. */
static size_t share(const worker *w, int end) {
    return (size_t)((double)w->job->mesh->triangles * (w->number + end) / w->job->threads);
}

static void count_triangles(worker *w) {
    size_t *count = w->job->count;
    size_t threads = (size_t)w->job->threads;
    size_t t;
    size_t slab;
    size_t last;
    for (t = share(w, 0); t < share(w, 1); t++) {
        const float *corner[3];
        mesh_corners(w->job->mesh, t, corner);
        if (slab_range(w->job, corner, &slab, &last)) {
            for (; slab <= last; slab++) {
                count[slab * threads + (size_t)w->number] += 1;
            }
        }
    }
}

/* Turns counts into places: slab after slab, in it thread after thread. Returns 0 if memory is short. */
static int place_triangles(job *j) {
    size_t threads = (size_t)j->threads;
    size_t total = 0;
    size_t i;
    for (i = 0; i < j->slabs * threads; i++) {
        size_t count = j->count[i];
        if (i % threads == 0) {
            j->first[i / threads] = total;
        }
        j->count[i] = total;
        total += count;
    }
    j->first[j->slabs] = total;
    j->indices = total <= SIZE_MAX / 12 ? (uint32_t *)malloc(12 * total + 1) : NULL;
    return j->indices != NULL;
}

static void sort_triangles(worker *w) {
    const tribox_mesh *m = w->job->mesh;
    size_t threads = (size_t)w->job->threads;
    size_t t;
    size_t slab;
    size_t last;
    size_t i;
    for (t = share(w, 0); t < share(w, 1); t++) {
        const float *corner[3];
        mesh_corners(m, t, corner);
        if (slab_range(w->job, corner, &slab, &last)) {
            for (; slab <= last; slab++) {
                size_t *place = &w->job->count[slab * threads + (size_t)w->number];
                for (i = 0; i < 3; i++) {
                    w->job->indices[3 * *place + i] = m->indices ? m->indices[3 * t + i] : (uint32_t)(3 * t + i);
                }
                *place += 1;
            }
        }
    }
}

static void fill_slabs(worker *w) {
    job *j = w->job;
    for (;;) {
        tribox_grid slab = j->v->grid;
        tribox_mesh part = *j->mesh;
        size_t i;
        int64_t end;
        lock_take(&j->lock);
        i = j->next_slab;
        j->next_slab += 1;
        lock_give(&j->lock);
        if (i >= j->slabs) {
            return;
        }
        slab.lo[2] += (int)i * j->height;
        end = (int64_t)slab.lo[2] + j->height;
        slab.hi[2] = end < slab.hi[2] ? (int)end : slab.hi[2];
        part.indices = j->indices + 3 * j->first[i];
        part.triangles = j->first[i + 1] - j->first[i];
        tribox_grid_fill(&slab, &part, voxels_row(j->v, 0, i * (size_t)j->height));
    }
}

static THREAD_RESULT run_worker(void *user) {
    worker *w = (worker *)user;
    w->run(w);
    return THREAD_DONE;
}

/* Runs one step on all threads, this one among them. */
static void run_step(worker *workers, void (*run)(worker *w)) {
    int started[MAX_THREADS];
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

/* Fills the whole region on several threads. Returns 1, or 0 if memory is short. */
static int fill_threaded(voxels *v, const tribox_mesh *m, int threads) {
    worker workers[MAX_THREADS];
    job j;
    int i;
    int ok;
    memset(&j, 0, sizeof j);
    j.mesh = m;
    j.v = v;
    j.threads = threads;
    j.height = (int)((v->n[2] - 1) / (size_t)(threads * SLABS_PER_THREAD) + 1);
    j.slabs = (v->n[2] - 1) / (size_t)j.height + 1;
    j.count = (size_t *)calloc(j.slabs * (size_t)threads, sizeof *j.count);
    j.first = (size_t *)malloc((j.slabs + 1) * sizeof *j.first);
    ok = j.count && j.first && lock_make(&j.lock);
    for (i = 0; i < threads; i++) {
        workers[i].job = &j;
        workers[i].number = i;
    }
    if (ok) {
        run_step(workers, count_triangles);
        ok = place_triangles(&j);
        if (ok) {
            run_step(workers, sort_triangles);
            run_step(workers, fill_slabs);
        }
        lock_free(&j.lock);
    }
    free(j.count);
    free(j.first);
    free(j.indices);
    return ok;
}

/* ---- 3. The comparison ----------------------------------------------------------------------- */

enum { RUNS = 3 };

/* The best of a few runs; threads = 0 is one call of tribox_grid_fill. Returns a negative time if memory is short. */
static double best_time(voxels *v, const tribox_mesh *m, int threads) {
    double best = HUGE_VAL;
    int run;
    for (run = 0; run < RUNS; run++) {
        double start;
        int ok = 1;
        memset(v->bits, 0, v->words * sizeof *v->bits);
        start = wall_seconds();
        if (threads == 0) {
            tribox_grid_fill(&v->grid, m, v->bits);
        } else {
            ok = fill_threaded(v, m, threads);
        }
        best = ok ? fmin(best, wall_seconds() - start) : -1;
    }
    return best;
}

static int compare(const tribox_grid *grid, const tribox_mesh *m, int threads, char *error) {
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
    printf("%d threads   %.4f s, %.2f times one call, %.2f times one thread\n", threads, many, one_call / many, one / many);
    printf("bits        %s\n", same ? "the same" : "NOT the same");
    voxels_free(&whole);
    voxels_free(&slabs);
    snprintf(error, MESH_ERROR, "out of memory");
    return one < 0 || many < 0 ? 2 : same ? 0 : 1;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: slabs [mesh] [resolution from 1 to 65536] [threads from 1 to 256]";
    int resolution = 512;
    int threads = 2;
    int status = 2;
    tribox_grid grid;
    tribox_mesh view;
    mesh m;
    if (argc > 4 || (argc > 1 && strcmp(argv[1], "--help") == 0)
        || (argc > 2 && !program_int(argv[2], 1, 65536, &resolution))
        || (argc > 3 && !program_int(argv[3], 1, MAX_THREADS, &threads))) {
        return program_fails("slabs", error);
    }
    if (!program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("slabs", error);
    }
    view = mesh_view(&m);
    if (tribox_grid_fit(&grid, &view, resolution)) {
        status = compare(&grid, &view, threads, error);
    } else {
        snprintf(error, sizeof error, "the mesh is a single point, or too large to frame");
    }
    mesh_free(&m);
    return status == 2 ? program_fails("slabs", error) : status;
}
