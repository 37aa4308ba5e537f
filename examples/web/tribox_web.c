/* tribox_web.c - tribox.h for the page: one triangle in a small grid, and a mesh file into voxels, their faces, a file
 *
 *   clang --target=wasm32 -msimd128 -Os -nostdlib -ffreestanding -nostdlibinc -isystem examples/web/libc -I. \
 *       -Wl,--no-entry examples/web/tribox_web.c -o tribox.wasm
 *
 * What is exported begins with web_. Numbers that the page reads stand in web_numbers.
 */
#include "examples/mesh_exact.h"
#include "examples/teapot.h"
#include "examples/voxel_io.h"

#define WEB_EXPORT(name) __attribute__((export_name(#name))) name

static char error[MESH_ERROR];
static double numbers[16];
static mesh model;
static voxels grid;
static uintptr_t keep;      /* what lies below this is the mesh; the rest is made anew with every fill */

const char *WEB_EXPORT(web_error)(void);
const char *WEB_EXPORT(web_format)(void);
double *WEB_EXPORT(web_numbers)(void);
void *WEB_EXPORT(web_room)(size_t size);
unsigned char *WEB_EXPORT(web_triangle)(const float corners[9], int n, float size, unsigned flags);
int WEB_EXPORT(web_read)(const char *name, unsigned char *bytes, size_t size);
int WEB_EXPORT(web_fill)(int resolution, unsigned flags, int solid);
size_t WEB_EXPORT(web_faces)(void);
unsigned char *WEB_EXPORT(web_save)(int format, int up);

const char *web_error(void) {
    return error;
}

const char *web_format(void) {
    return model.format;
}

double *web_numbers(void) {
    return numbers;
}

void *web_room(size_t size) {
    return malloc(size);
}

/* ---- 1. One triangle */

enum { MOST = 32 };

/* The voxels of an n*n*n grid from 0 on, a byte each: 1, it is set; 2, the published float test would set it. That
 * test is asked where voxels are closed, with boxes from i*size to (i+1)*size as a program of floats has them. */
unsigned char *web_triangle(const float corners[9], int n, float size, unsigned flags) {
    static unsigned char state[MOST * MOST * MOST];
    static uint64_t bits[MOST * MOST];
    tribox_mesh view = {corners, 0, NULL, 1};
    tribox_grid g = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0};
    int a;
    int x;
    int y;
    int z;
    for (a = 0; a < 3; a++) {
        g.size[a] = (double)size;
        g.hi[a] = n;
    }
    g.flags = flags;
    memset(bits, 0, sizeof bits);
    memset(numbers, 0, sizeof numbers);
    tribox_grid_fill(&g, &view, bits);
    for (z = 0; z < n; z++) {
        for (y = 0; y < n; y++) {
            for (x = 0; x < n; x++) {
                const float lo[3] = {(float)x * size, (float)y * size, (float)z * size};
                const float hi[3] = {(float)(x + 1) * size, (float)(y + 1) * size, (float)(z + 1) * size};
                int set = (int)(bits[z * n + y] >> x & 1);
                int guess = flags == 0 ? tribox_sat(corners, corners + 3, corners + 6, lo, hi) : set;
                state[(z * n + y) * n + x] = (unsigned char)(set | guess << 1);
                numbers[0] += set;
                numbers[1] += set && !guess;
                numbers[2] += !set && guess;
            }
        }
    }
    return state;
}

/* ---- 2. A mesh */

/* No bytes: the teapot. numbers: triangles, vertices, 1 if some coordinate is no float, the least and the largest
   corner. web_error() is a warning, or empty. */
int web_read(const char *name, unsigned char *bytes, size_t size) {
    size_t i;
    int a;
    if (!(size ? mesh_read_memory(&model, name, bytes, size, error) : teapot_make(&model, 24, 1, error))) {
        return 0;
    }
    numbers[0] = (double)model.triangles;
    numbers[1] = (double)model.vertices;
    numbers[2] = model.exact ? 1 : 0;
    for (a = 0; a < 3; a++) {
        numbers[3 + a] = HUGE_VAL;
        numbers[6 + a] = -HUGE_VAL;
        for (i = 0; i < model.vertices; i++) {
            double x = model.exact ? model.exact[3 * i + (size_t)a] : (double)model.positions[3 * i + (size_t)a];
            numbers[3 + a] = x < numbers[3 + a] ? x : numbers[3 + a];
            numbers[6 + a] = x > numbers[6 + a] ? x : numbers[6 + a];
        }
    }
    keep = web_end;
    snprintf(error, sizeof error, "%s", model.warning);
    return 1;
}

/* numbers: voxels set, the grid's sides in voxels, a voxel's side, the region's least corner. */
int web_fill(int resolution, unsigned flags, int solid) {
    tribox_grid g;
    int a;
    if (!mesh_fit(&g, &model, resolution)) {
        snprintf(error, sizeof error, "the mesh is a single point, or too large to frame");
        return 0;
    }
    g.flags = solid ? 0 : flags;
    web_end = keep;
    web_latest = 0;
    memset(&web_file, 0, sizeof web_file);
    if (!voxels_make(&grid, &g, error)) {
        return 0;
    }
    (solid ? mesh_fill_solid : mesh_fill)(&g, &model, grid.bits);
    numbers[0] = (double)voxels_count(&grid);
    numbers[4] = g.size[0];
    for (a = 0; a < 3; a++) {
        numbers[1 + a] = (double)grid.n[a];
        numbers[5 + a] = g.origin[a] + g.lo[a] * g.size[a];
    }
    return 1;
}

/* How dark a corner of a face is, 0 to 3: by the voxels beside and across, in the layer in front of the face. */
static unsigned shade(const size_t front[3], int b, int db, int c, int dc) {
    size_t at[3];
    unsigned beside;
    unsigned other;
    memcpy(at, front, sizeof at);
    at[b] += (size_t)db;
    beside = (unsigned)voxels_get(&grid, at[0], at[1], at[2]);
    at[c] += (size_t)dc;
    other = (unsigned)voxels_get(&grid, at[0], at[1], at[2]);
    at[b] -= (size_t)db;
    if (beside && voxels_get(&grid, at[0], at[1], at[2])) {
        return 3;
    }
    return beside + other + (unsigned)voxels_get(&grid, at[0], at[1], at[2]);
}

/* The face of a voxel across axis a, towards +a or -a: four corners of x, y, z, and side + 8 * shade. */
static uint16_t *put_face(uint16_t *out, const size_t voxel[3], int a, int positive) {
    static const int turn[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    int b = (a + 1) % 3;
    int c = (a + 2) % 3;
    size_t front[3];
    int i;
    memcpy(front, voxel, sizeof front);
    front[a] += positive ? 1 : (size_t)-1;
    for (i = 0; i < 4; i++) {
        const int *t = turn[positive ? i : 3 - i];
        out[a] = (uint16_t)(voxel[a] + (size_t)positive);
        out[b] = (uint16_t)(voxel[b] + (size_t)t[0]);
        out[c] = (uint16_t)(voxel[c] + (size_t)t[1]);
        out[3] = (uint16_t)((unsigned)(2 * a + positive) + 8 * shade(front, b, t[0] ? 1 : -1, c, t[1] ? 1 : -1));
        out += 4;
    }
    return out;
}

/* Faces between a voxel that is set and one that is not; with out NULL they are only counted. */
static size_t walk_faces(uint16_t *out) {
    size_t count = 0;
    size_t voxel[3];
    size_t word;
    int a;
    int s;
    for (voxel[2] = 0; voxel[2] < grid.n[2]; voxel[2]++) {
        for (voxel[1] = 0; voxel[1] < grid.n[1]; voxel[1]++) {
            for (word = 0; word < grid.row_words; word++) {
                uint64_t rest = voxels_row(&grid, voxel[1], voxel[2])[word];
                for (; rest; rest &= rest - 1) {
                    voxel[0] = 64 * word + (size_t)__builtin_ctzll(rest);
                    for (a = 0; a < 6; a++) {
                        size_t at[3];
                        memcpy(at, voxel, sizeof at);
                        s = a & 1;
                        at[a >> 1] += s ? 1 : (size_t)-1;
                        if (!voxels_get(&grid, at[0], at[1], at[2])) {
                            out = out ? put_face(out, voxel, a >> 1, s) : NULL;
                            count++;
                        }
                    }
                }
            }
        }
    }
    return count;
}

/* How many faces; web_numbers()[1] is where they stand, 16 numbers of 16 bits each. 0, and the error, where memory is short. */
size_t web_faces(void) {
    size_t count = walk_faces(NULL);
    uint16_t *out = (uint16_t *)malloc(32 * count + 1);
    numbers[0] = (double)count;
    numbers[1] = (double)(uintptr_t)out;
    if (!out) {
        snprintf(error, sizeof error, "out of memory for %lu faces", (unsigned long)count);
        return 0;
    }
    walk_faces(out);
    free(out);      /* the page takes them at once */
    return count;
}

/* 0 .vox, 1 .npy, 2 .obj; numbers[0] is the size. NULL, and the error, if that fails. */
unsigned char *web_save(int format, int up) {
    int ok = format == 0 ? vox_write("a.vox", &grid, upright_make((char)up), error)
           : format == 1 ? npy_write("a.npy", &grid, error) : faces_write("a.obj", &grid, error);
    numbers[0] = (double)web_file.size;
    return ok ? web_file.bytes : NULL;
}
