/* sparse - spans into a sparse set of 8x8x8 bricks: a grid far too big for an array of bits
 *
 *   build/sparse [mesh] [resolution]       default: the teapot in a grid of 4096 along its longest side
 *
 * tribox_mesh_spans hands out runs of voxels; each run is cut at brick borders and ORed into a hash table
 * whose entries are a brick's place and its 512 bits. Prints:
 *
 *   grid      4096 x 2547 x 2006, 2616.0 MB as an array of bits
 *   spans     33923917 voxels of 36672 triangles in ... s
 *   set       30658152 different voxels in 477909 bricks of 8x8x8, 64 voxels a brick
 *   memory    75.5 MB, 1/35 of the array
 */
#include "program.h"

typedef struct brick {
    uint64_t key;           /* place + 1; 0: free entry */
    uint64_t layer[8];      /* bit 8 * (y & 7) + (x & 7) of layer z & 7 */
} brick;

typedef struct brick_set {
    brick *table;
    size_t size;            /* a power of two */
    size_t used;
    brick *latest;          /* a triangle's spans come in order: the next bits are often in the same brick */
    int    lo[3];           /* the region's; places count from it */
    int    failed;          /* memory was short */
} brick_set;

/* Places are below 2^24, so a brick's is three numbers of 21 bits. */
static uint64_t brick_key(int x, int y, int z) {
    return ((uint64_t)(z >> 3) << 42 | (uint64_t)(y >> 3) << 21 | (uint64_t)(x >> 3)) + 1;
}

static brick *brick_slot(const brick_set *set, uint64_t key) {
    size_t at = (size_t)((key * 0x9e3779b97f4a7c15u) >> 20) & (set->size - 1);
    while (set->table[at].key != 0 && set->table[at].key != key) {
        at = (at + 1) & (set->size - 1);
    }
    return &set->table[at];
}

/* Twice the entries, once three quarters are used. */
static int brick_grow(brick_set *set) {
    brick_set larger = *set;
    size_t i;
    larger.size = set->size ? 2 * set->size : 1024;
    larger.latest = NULL;
    larger.table = (brick *)calloc(larger.size, sizeof *larger.table);
    if (!larger.table) {
        return 0;
    }
    for (i = 0; i < set->size; i++) {
        if (set->table[i].key) {
            *brick_slot(&larger, set->table[i].key) = set->table[i];
        }
    }
    free(set->table);
    *set = larger;
    return 1;
}

/* The brick of a voxel, made if it is not there; NULL if memory is short. */
static brick *brick_at(brick_set *set, int x, int y, int z) {
    uint64_t key = brick_key(x, y, z);
    if (set->latest && set->latest->key == key) {
        return set->latest;
    }
    if (4 * (set->used + 1) > 3 * set->size && !brick_grow(set)) {
        return NULL;
    }
    set->latest = brick_slot(set, key);
    if (set->latest->key == 0) {
        set->latest->key = key;
        set->used += 1;
    }
    return set->latest;
}

/* A tribox_mesh_span_fn: sets voxels x0..x1 of row (y, z). */
static void add_span(void *user, size_t triangle, int x0, int x1, int y, int z) {
    brick_set *set = (brick_set *)user;
    (void)triangle;
    x0 -= set->lo[0];
    x1 -= set->lo[0];
    y -= set->lo[1];
    z -= set->lo[2];
    while (x0 <= x1) {
        int end = (x0 | 7) < x1 ? x0 | 7 : x1;
        uint64_t run = (((uint64_t)2 << (end - x0)) - 1) << (x0 & 7);
        brick *b = brick_at(set, x0, y, z);
        if (!b) {
            set->failed = 1;        /* what comes after it is in vain, too */
            return;
        }
        b->layer[z & 7] |= run << (8 * (y & 7));
        x0 = end + 1;
    }
}

static double count_voxels(const brick_set *set) {
    double count = 0;
    size_t i;
    int z;
    for (i = 0; i < set->size; i++) {
        for (z = 0; z < 8 && set->table[i].key; z++) {
            uint64_t bits = set->table[i].layer[z];
            for (; bits; bits &= bits - 1) {
                count += 1;
            }
        }
    }
    return count;
}

static int voxelize(const tribox_grid *grid, const mesh *m, char *error) {
    const int *lo = grid->lo;
    const int *hi = grid->hi;
    brick_set set = {NULL, 0, 0, NULL, {0, 0, 0}, 0};
    double start;
    double emitted;
    double voxels;
    double dense = (double)((hi[0] - lo[0] + 63) / 64) * 8 * (hi[1] - lo[1]) * (hi[2] - lo[2]);
    memcpy(set.lo, lo, sizeof set.lo);
    printf("grid      %d x %d x %d, %.1f MB as an array of bits\n", hi[0] - lo[0], hi[1] - lo[1],
           hi[2] - lo[2], dense * 1e-6);
    mesh_say_exact(m);
    start = progress_seconds();
    emitted = (double)mesh_spans(grid, m, add_span, &set);
    if (set.failed) {
        snprintf(error, MESH_ERROR, "out of memory after %lu bricks", (unsigned long)set.used);
        free(set.table);
        return 0;
    }
    voxels = count_voxels(&set);
    printf("spans     %.0f voxels of %lu triangles in %.2f s\n", emitted, (unsigned long)m->triangles,
           progress_seconds() - start);
    printf("set       %.0f different voxels in %lu bricks of 8x8x8, %.0f voxels a brick\n", voxels,
           (unsigned long)set.used, set.used ? voxels / (double)set.used : 0);
    printf("memory    %.1f MB, 1/%.0f of the array\n", (double)set.size * sizeof(brick) * 1e-6,
           dense / ((double)set.size * sizeof(brick)));
    free(set.table);
    return 1;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: sparse [mesh] [resolution from 1 to 1000000]";
    int asked;
    int resolution = 4096;
    tribox_grid grid;
    mesh m;
    int ok;
    if ((asked = program_arguments("sparse", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 3 || (argc > 2 && !program_int(argv[2], 1, 1000000, &resolution))) {
        return program_fails("sparse", error);
    }
    if (!program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("sparse", error);
    }
    ok = mesh_fit(&grid, &m, resolution);
    if (!ok) {
        snprintf(error, sizeof error, "the mesh is a single point, or too large to frame");
    }
    ok = ok && voxelize(&grid, &m, error);
    mesh_free(&m);
    return ok ? 0 : program_fails("sparse", error);
}
