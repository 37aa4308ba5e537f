/* bench_tri.c - tribox_tri_test at every voxel of a triangle's index box, against the textbook test of [SS10]
 * called at each voxel's corner; and the two setups.
 */
#include "bench.h"
#include "baseline_grid.h"
#include "tribox.h"

enum { TRIANGLES = 128 };

/* Voxel (i,j,k) is the box at origin + (i,j,k)*size, computed in float as a caller would. */
typedef struct job {
    float corner[TRIANGLES][3][3];
    int lo[TRIANGLES][3], hi[TRIANGLES][3]; /* the index box, hi excluded */
    float size[3];
    size_t voxels[TRIANGLES], total; /* in the index boxes */
    float *points;                   /* the corners of all their voxels */
    baseline_ss10 ss10[TRIANGLES];
    tribox_tri tri[TRIANGLES];
} job;

static void make_job(job *j, uint64_t seed)
{
    int i;
    int c;
    int k;
    j->total = 0;
    for (k = 0; k < 3; k++) {
        j->size[k] = 0.1f;
    }
    for (i = 0; i < TRIANGLES; i++) {
        float reach = bench_uniform(&seed, 0.05f, 1.0f); /* boxes from one voxel to twenty a side */
        j->voxels[i] = 1;
        for (k = 0; k < 3; k++) {
            float middle = bench_uniform(&seed, -10.0f, 10.0f);
            float low = middle + reach;
            float high = middle - reach;
            for (c = 0; c < 3; c++) {
                float x = middle + bench_uniform(&seed, -reach, reach);
                j->corner[i][c][k] = x;
                low = x < low ? x : low;
                high = x > high ? x : high;
            }
            j->lo[i][k] = (int)floorf(low / j->size[k]);
            j->hi[i][k] = (int)floorf(high / j->size[k]) + 1;
            j->voxels[i] *= (size_t)(j->hi[i][k] - j->lo[i][k]);
        }
        j->total += j->voxels[i];
        baseline_ss10_setup(&j->ss10[i], j->corner[i][0], j->corner[i][1], j->corner[i][2], j->size);
        tribox_tri_init(&j->tri[i], j->corner[i][0], j->corner[i][1], j->corner[i][2], j->size, 0);
    }
}

static void make_points(job *j)
{
    float *p;
    int i;
    j->points = (float *)bench_alloc(3 * j->total * sizeof *j->points);
    p = j->points;
    for (i = 0; i < TRIANGLES; i++) {
        int x;
        int y;
        int z;
        for (z = j->lo[i][2]; z < j->hi[i][2]; z++) {
            for (y = j->lo[i][1]; y < j->hi[i][1]; y++) {
                for (x = j->lo[i][0]; x < j->hi[i][0]; x++) {
                    *p++ = (float)x * j->size[0];
                    *p++ = (float)y * j->size[1];
                    *p++ = (float)z * j->size[2];
                }
            }
        }
    }
}

/* ---- Tests --------------------------------------------------------------------------------------------- */

/* The test at one p after another, each on its own: a program that calls it can share nothing between them.
 */
#define CALLED(name, type, member, expression)         \
    static BENCH_NOINLINE uint64_t name(void *context) \
    {                                                  \
        const job *j = (const job *)context;           \
        const float *p = j->points;                    \
        uint64_t sum = 0;                              \
        int i;                                         \
        for (i = 0; i < TRIANGLES; i++) {              \
            const type *t = &j->member[i];             \
            const float *end = p + 3 * j->voxels[i];   \
            for (; p < end; p += 3) {                  \
                BENCH_HIDE(p);                         \
                sum += (uint64_t)(expression);         \
            }                                          \
        }                                              \
        return sum;                                    \
    }

CALLED(run_loads, baseline_ss10, ss10, p[0] + p[1] + p[2] > t->low[0])
CALLED(run_ss10, baseline_ss10, ss10, baseline_ss10_test(t, p))
CALLED(run_ss10_branchless, baseline_ss10, ss10, baseline_ss10_test_branchless(t, p))
CALLED(run_test, tribox_tri, tri, tribox_tri_test(t, p))

/* The test inlined into three loops, where the compiler may hoist what a row shares and take several voxels
 * at once. */
#define LOOPED(name, type, member, expression)                    \
    static BENCH_NOINLINE uint64_t name(void *context)            \
    {                                                             \
        const job *j = (const job *)context;                      \
        uint64_t sum = 0;                                         \
        int i;                                                    \
        for (i = 0; i < TRIANGLES; i++) {                         \
            const type *t = &j->member[i];                        \
            int x;                                                \
            int y;                                                \
            int z;                                                \
            for (z = j->lo[i][2]; z < j->hi[i][2]; z++) {         \
                for (y = j->lo[i][1]; y < j->hi[i][1]; y++) {     \
                    for (x = j->lo[i][0]; x < j->hi[i][0]; x++) { \
                        float p[3];                               \
                        p[0] = (float)x * j->size[0];             \
                        p[1] = (float)y * j->size[1];             \
                        p[2] = (float)z * j->size[2];             \
                        sum += (uint64_t)(expression);            \
                    }                                             \
                }                                                 \
            }                                                     \
        }                                                         \
        return sum;                                               \
    }

LOOPED(run_ss10_loop, baseline_ss10, ss10, baseline_ss10_test(t, p))
LOOPED(run_ss10_loop_branchless, baseline_ss10, ss10, baseline_ss10_test_branchless(t, p))
LOOPED(run_test_loop, tribox_tri, tri, tribox_tri_test(t, p))

/* ---- Setups -------------------------------------------------------------------------------------------- */

static BENCH_NOINLINE uint64_t run_ss10_setup(void *context)
{
    job *j = (job *)context;
    uint64_t sum = 0;
    int i;
    for (i = 0; i < TRIANGLES; i++) {
        baseline_ss10_setup(&j->ss10[i], j->corner[i][0], j->corner[i][1], j->corner[i][2], j->size);
        sum += j->ss10[i].d1 > 0;
    }
    return sum;
}

static BENCH_NOINLINE uint64_t run_tri_init(void *context)
{
    job *j = (job *)context;
    uint64_t sum = 0;
    int i;
    for (i = 0; i < TRIANGLES; i++) {
        unsigned char first;
        tribox_tri_init(&j->tri[i], j->corner[i][0], j->corner[i][1], j->corner[i][2], j->size, 0);
        memcpy(&first, &j->tri[i], 1);
        sum += first;
    }
    return sum;
}

/* A setup and eight tests, at voxels spread over the index box. */
#define EIGHT(name, type, member, setup, test)                                        \
    static BENCH_NOINLINE uint64_t name(void *context)                                \
    {                                                                                 \
        job *j = (job *)context;                                                      \
        const float *p = j->points;                                                   \
        uint64_t sum = 0;                                                             \
        int i;                                                                        \
        for (i = 0; i < TRIANGLES; i++) {                                             \
            type *t = &j->member[i];                                                  \
            size_t k;                                                                 \
            setup(t, j->corner[i][0], j->corner[i][1], j->corner[i][2], j->size);     \
            for (k = 0; k < 8; k++) {                                                 \
                sum += (uint64_t)test(t, p + k * j->voxels[i] / 8 * 3);               \
            }                                                                         \
            p += 3 * j->voxels[i];                                                    \
        }                                                                             \
        return sum;                                                                   \
    }

#define INIT(t, v0, v1, v2, size) tribox_tri_init(t, v0, v1, v2, size, 0)
EIGHT(run_ss10_eight, baseline_ss10, ss10, baseline_ss10_setup, baseline_ss10_test)
EIGHT(run_tri_eight, tribox_tri, tri, INIT, tribox_tri_test)

int main(int argc, char **argv)
{
    bench_options options;
    bench_row rows[4];
    int count = 0;
    job *j = (job *)bench_alloc(sizeof *j);
    if (!bench_parse(argc, argv, &options)) {
        return 1;
    }
    make_job(j, 4);
    make_points(j);
    bench_header("one triangle, many voxels");
    printf("# %d triangles, %.0f voxels in their index boxes, %.1f %% touched\n", TRIANGLES, (double)j->total,
           100.0 * (double)run_ss10(j) / (double)j->total);
    bench_add(rows, &count, "loads only", BENCH_REFERENCE, run_loads);
    bench_add(rows, &count, "textbook test, early exits", BENCH_RIVAL, run_ss10);
    bench_add(rows, &count, "textbook test, no branch", BENCH_RIVAL, run_ss10_branchless);
    bench_add(rows, &count, "tribox_tri_test", BENCH_OURS, run_test);
    bench_table(&options, "all voxels of the index box, called at each", rows, count, 50, (double)j->total,
                j);
    count = 0;
    bench_add(rows, &count, "textbook test, early exits", BENCH_RIVAL, run_ss10_loop);
    bench_add(rows, &count, "textbook test, no branch", BENCH_RIVAL, run_ss10_loop_branchless);
    bench_add(rows, &count, "tribox_tri_test", BENCH_OURS, run_test_loop);
    bench_table(&options, "the same in a loop open to the compiler", rows, count, 50, (double)j->total, j);
    count = 0;
    bench_add(rows, &count, "textbook setup", BENCH_RIVAL, run_ss10_setup);
    bench_add(rows, &count, "tribox_tri_init", BENCH_OURS, run_tri_init);
    bench_table(&options, "setup", rows, count, 50, TRIANGLES, j);
    count = 0;
    bench_add(rows, &count, "textbook setup, 8 tests", BENCH_RIVAL, run_ss10_eight);
    bench_add(rows, &count, "tribox_tri_init, 8 tests", BENCH_OURS, run_tri_eight);
    bench_table(&options, "setup and 8 tests", rows, count, 50, TRIANGLES, j);
    free(j->points);
    free(j);
    return 0;
}
