/* clang -I. -O1 -g -fsanitize=fuzzer,address,undefined tests/fuzz_grid.c -lgmp -o fuzz_grid
 *
 * Spans, fill and solid over a small region anywhere, against the exact judge at every voxel; tribox_grid_locate
 * against exact division. */
#include "fuzz_input.h"
#include "verify_solid.h"

#define EDGE 4

typedef struct region {
    const question *ask;
    unsigned char set[EDGE][EDGE][EDGE]; /* z y x */
    int order;                           /* of the last row */
    int in_order;
} region;

static void take(void *user, int x0, int x1, int y, int z)
{
    region *r = (region *)user;
    const int row = (z - r->ask->index[2]) * EDGE + (y - r->ask->index[1]);
    int x;
    r->in_order &= row > r->order;
    r->order = row;
    for (x = x0; x <= x1; ++x) {
        r->set[z - r->ask->index[2]][y - r->ask->index[1]][x - r->ask->index[0]] += 1;
    }
}

static void try_flags(const question *ask, const unsigned char rules[EDGE][EDGE][EDGE], unsigned flags)
{
    static region r;
    const double *x = ask->x;
    tribox_grid grid;
    uint64_t bits[EDGE * EDGE];
    uint64_t bits_f64[EDGE * EDGE];
    float f[15];
    size_t count;
    int i, j, k, hits = 0;
    memset(&r, 0, sizeof r);
    memset(bits, 0, sizeof bits);
    memset(bits_f64, 0, sizeof bits_f64);
    r.ask = ask;
    r.order = -1;
    r.in_order = 1;
    for (k = 0; k < 3; ++k) {
        grid.origin[k] = x[9 + k];
        grid.size[k] = x[12 + k];
        grid.lo[k] = ask->index[k];
        grid.hi[k] = ask->index[k] + EDGE;
    }
    grid.flags = flags;
    count = tribox_grid_spans_f64(&grid, x, x + 3, x + 6, take, &r);
    require("spans in order", flags, r.in_order, 1, ask);
    {
        tribox_mesh_f64 mesh;
        mesh.positions = x;
        mesh.stride = 0;
        mesh.indices = NULL;
        mesh.triangles = 1;
        tribox_grid_fill_f64(&grid, &mesh, bits_f64);
        require("tribox_mesh_spans_f64", flags, tribox_mesh_spans_f64(&grid, &mesh, NULL, NULL) == count, 1, ask);
    }
    if (floats(x, 9)) {
        static const uint32_t copies[3 * 40] = {        /* so many that a fill takes them several at a time */
            0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2,
            0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2,
            0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2,
            0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2};
        tribox_mesh mesh;
        narrow_all(f, x);
        mesh.positions = f;
        mesh.stride = 0;
        mesh.indices = flags & TRIBOX_OPEN ? NULL : copies;
        mesh.triangles = mesh.indices ? 40 : 1;
        require("tribox_grid_words", flags, (int)tribox_grid_words(&grid),
                floats(x, 9) && ask->x[12] > 0 && ask->x[13] > 0 && ask->x[14] > 0 && is_finite(x[9]) &&
                        is_finite(x[10]) && is_finite(x[11]) && is_finite(x[12]) && is_finite(x[13]) &&
                        is_finite(x[14])
                    ? EDGE * EDGE
                    : 0,
                ask);
        tribox_grid_fill(&grid, &mesh, bits);
    }
    for (k = 0; k < EDGE; ++k) {
        for (j = 0; j < EDGE; ++j) {
            for (i = 0; i < EDGE; ++i) {
                const int want = rules[k][j][i] >> rule_of(flags) & 1;
                hits += want;
                require("voxel of tribox_grid_spans_f64", flags, r.set[k][j][i], want, ask);
                require("voxel of tribox_grid_fill_f64", flags, (int)(bits_f64[k * EDGE + j] >> i & 1u), want, ask);
                if (floats(x, 9)) {
                    require("voxel of tribox_grid_fill", flags, (int)(bits[k * EDGE + j] >> i & 1u), want,
                            ask);
                }
            }
        }
    }
    require("voxels counted", flags, (int)count, hits, ask);
}

static void try_locate(const question *ask)
{
    tribox_grid grid;
    mpz_t index;
    int out[3] = {0, 0, 0};
    int k, want = 1, same = 1;
    mpz_init(index);
    for (k = 0; k < 3; ++k) {
        grid.origin[k] = ask->x[9 + k];
        grid.size[k] = ask->x[12 + k];
        grid.lo[k] = INT32_MIN;
        grid.hi[k] = INT32_MAX;
    }
    grid.flags = 0;
    for (k = 0; k < 3; ++k) {
        want &= exact_index(fuzz_judge(), ask->x[k], ask->x[9 + k], ask->x[12 + k], index) &&
                mpz_cmp_si(index, INT32_MIN) >= 0 && mpz_cmp_si(index, INT32_MAX) < 0;
    }
    require("tribox_grid_locate", 0, tribox_grid_locate(&grid, ask->x, out), want, ask);
    for (k = 0; k < 3 && want; ++k) {
        exact_index(fuzz_judge(), ask->x[k], ask->x[9 + k], ask->x[12 + k], index);
        same &= mpz_cmp_si(index, out[k]) == 0;
    }
    require("index of tribox_grid_locate", 0, same, 1, ask);
    mpz_clear(index);
}

/* The solid of one triangle, so many times that a fill takes them several at a time; the first centre's ray. */
static void try_solid(const question *ask)
{
    enum { TIMES = 33 };
    static crossing_judge judge;
    static int ready;
    static uint32_t indices[3 * TIMES];
    const double *x = ask->x;
    tribox_grid grid;
    tribox_mesh mesh;
    tribox_mesh_f64 mesh_f64;
    uint64_t bits[EDGE * EDGE];
    uint64_t bits_f64[EDGE * EDGE];
    float f[15];
    int64_t half[3];
    int j, k, on = 1;
    if (!ready) {
        crossing_init(&judge);
        for (k = 0; k < 3 * TIMES; ++k) {
            indices[k] = (uint32_t)(k % 3);
        }
        ready = 1;
    }
    for (k = 0; k < 3; ++k) {
        grid.origin[k] = x[9 + k];
        grid.size[k] = x[12 + k];
        grid.lo[k] = ask->index[k];
        grid.hi[k] = ask->index[k] + EDGE;
        on &= is_finite(x[9 + k]) && is_finite(x[12 + k]) && x[12 + k] > 0;
    }
    grid.flags = 0;
    memset(bits, 0, sizeof bits);
    memset(bits_f64, 0, sizeof bits_f64);
    mesh_f64.positions = x;
    mesh_f64.stride = 0;
    mesh_f64.indices = indices;
    mesh_f64.triangles = TIMES;
    tribox_grid_fill_solid_f64(&grid, &mesh_f64, bits_f64);
    if (floats(x, 9)) {
        narrow_all(f, x);
        mesh.positions = f;
        mesh.stride = 0;
        mesh.indices = indices;
        mesh.triangles = TIMES;
        tribox_grid_fill_solid(&grid, &mesh, bits);
    }
    for (k = 0; k < EDGE; ++k) {
        for (j = 0; j < EDGE; ++j) {
            const int row = k * EDGE + j;
            uint64_t want = 0;
            half[1] = 2 * ((int64_t)ask->index[1] + j) + 1;
            half[2] = 2 * ((int64_t)ask->index[2] + k) + 1;
            if (on) {
                want = (uint64_t)15 << crossing_first(&judge, x, x + 9, x + 12, half, ask->index[0], EDGE) & 15u;
            }
            require("row of tribox_grid_fill_solid_f64", 0, bits_f64[row] == want, 1, ask);
            if (floats(x, 9)) {
                require("row of tribox_grid_fill_solid", 0, bits[row] == want, 1, ask);
            }
        }
    }
    half[0] = half[1] = half[2] = 0;
    on = is_finite(x[9]) && is_finite(x[10]) && is_finite(x[11]);
    require("tribox_mesh_contains_f64", 0, tribox_mesh_contains_f64(&mesh_f64, x + 9),
            on && crossing_crosses(&judge, x, x + 9, x + 9, half), ask);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static unsigned char rules[EDGE][EDGE][EDGE];
    bytes b;
    question ask;
    unsigned flags;
    int i, j, k, f64, wide;
    b.at = data;
    b.left = size;
    k = take_byte(&b);
    f64 = k & 1;
    wide = k & 2;
    take_question(&b, &ask, f64);
    ask.kind = ASK_GRID;
    try_locate(&ask);
    for (i = 0; i < 3; ++i) {
        ask.index[i] = wide ? (int)(int32_t)(uint32_t)take_word(&b, 4) : (int8_t)take_byte(&b) / 8;
        if (ask.index[i] > INT32_MAX - EDGE) {
            ask.index[i] = INT32_MAX - EDGE;
        }
    }
    try_solid(&ask);
    for (k = 0; k < EDGE; ++k) {
        for (j = 0; j < EDGE; ++j) {
            for (i = 0; i < EDGE; ++i) {
                question voxel = ask;
                voxel.index[0] += i;
                voxel.index[1] += j;
                voxel.index[2] += k;
                memcpy(voxel.last, voxel.index, sizeof voxel.last);
                rules[k][j][i] = (unsigned char)exact_axes(fuzz_judge(), &voxel);
            }
        }
    }
    for (flags = 0; flags < 5; flags += flags == 2 ? 2 : 1) {
        try_flags(&ask, rules, flags);
    }
    return 0;
}
