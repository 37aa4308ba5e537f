/* What TRIBOX_SIMD is worth where make bench does not run: WebAssembly in node, and AArch64 in an emulator, where
 * only instructions can be counted. Compile it with -DTRIBOX_SIMD=0 and =1.
 *
 *   clang-22 --target=wasm32 -msimd128 -DTRIBOX_SIMD=1 -O2 -nostdlib -ffreestanding -I. bench/simd.c -o simd1.wasm \
 *       -Wl,--no-entry -Wl,--export=work -Wl,--export=prepare
 *   node bench/simd.js simd0.wasm simd1.wasm
 *
 *   aarch64-linux-gnu-gcc -static -O2 -DTRIBOX_SIMD=1 -I. bench/simd.c -o simd1
 *   qemu-aarch64 -singlestep -d exec,nochain -D /dev/stdout simd1 KIND TIMES | grep -c '^Trace'
 *
 * KIND is a number of the list in simd.js; the count for TIMES 2 less that for TIMES 1 is what one pass over the
 * inputs takes. */
#include <stddef.h>
#include <stdint.h>
#include "tribox.h"

#ifndef MESH
#define MESH 4096 /* triangles */
#endif
enum { INPUTS = 512, SIDE = 128 };

static float corner[INPUTS][9], box[INPUTS][6], point[INPUTS][3];
static float soup[9 * MESH];
static uint64_t bits[SIDE * SIDE * (SIDE / 64)];
static uint64_t state = 88172645463325252u;

void *memcpy(void *to, const void *from, size_t bytes);
void *memset(void *to, int value, size_t bytes);
void prepare(void);
int work(int kind, int times);

#ifdef __wasm__
void *memcpy(void *to, const void *from, size_t bytes)
{
    size_t i;
    for (i = 0; i < bytes; i++) {
        ((volatile unsigned char *)to)[i] = ((const unsigned char *)from)[i];
    }
    return to;
}

void *memset(void *to, int value, size_t bytes)
{
    size_t i;
    for (i = 0; i < bytes; i++) {
        ((volatile unsigned char *)to)[i] = (unsigned char)value;
    }
    return to;
}
#endif

/* in [0, below) */
static float rnd(float below)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (float)(state >> 40) * 5.9604644775390625e-8f * below;
}

void prepare(void)
{
    int i, k;
    for (i = 0; i < INPUTS; i++) {
        for (k = 0; k < 3; k++) {
            const float c = rnd(4);
            corner[i][k] = c + rnd(3);
            corner[i][3 + k] = c + rnd(3);
            corner[i][6 + k] = c + rnd(3);
            box[i][k] = 1 + rnd(4);
            box[i][3 + k] = box[i][k] + rnd(1);
            point[i][k] = 1 + rnd(4);
        }
    }
    for (i = 0; i < MESH; i++) {
        for (k = 0; k < 3; k++) {
            const float c = rnd(120);
            soup[9 * i + k] = c + rnd(4);
            soup[9 * i + 3 + k] = c + rnd(4);
            soup[9 * i + 6 + k] = c + rnd(4);
        }
    }
}

static void on_span(void *user, int x0, int x1, int y, int z)
{
    *(int *)user += (x1 - x0) ^ y ^ z;
}

int work(int kind, int times)
{
    static const float size[3] = {0.5f, 0.5f, 0.5f};
    const tribox_mesh mesh = {soup, 0, NULL, MESH};
    tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {SIDE, SIDE, SIDE}, 0};
    tribox_tri tri;
    float t0 = 0, t1 = 0, axis[3];
    unsigned sum = 0;
    int i;
    tribox_tri_init(&tri, corner[0], corner[0] + 3, corner[0] + 6, size, 0);
    for (; times > 0; times--) {
        for (i = 0; i < INPUTS && kind < 10; i++) {
            const float *v = corner[i], *b = box[i], *m = soup + 9 * i;
            switch (kind) {
            case 0: sum += (unsigned)tribox_overlap(v, v + 3, v + 6, b, b + 3); break;
            case 1: sum += (unsigned)tribox_tri_test(&tri, point[i]); break;
            case 2: tribox_tri_init(&tri, v, v + 3, v + 6, size, 0); sum += (unsigned)tribox_tri_test(&tri, v); break;
            case 3: sum += (unsigned)tribox_tri_octants(&tri, point[i]); break;
            case 4: sum += (unsigned)tribox_grid_spans(&grid, m, m + 3, m + 6, on_span, &sum); break;
            case 5: sum += (unsigned)tribox_segment_box(v, v + 3, b, b + 3); break;
            case 6: sum += (unsigned)tribox_ray_box(v, point[i], 0, 9, b, b + 3, &t0, &t1) + (unsigned)t0; break;
            case 7: sum += (unsigned)tribox_sphere_triangle(point[i], 0.7f, v, v + 3, v + 6); break;
            case 8: sum += (unsigned)tribox_gap(v, v + 3, v + 6, b, b + 3, axis); break;
            default: break;
            }
        }
        switch (kind) {
        case 10: tribox_grid_fill(&grid, &mesh, bits); sum += (unsigned)bits[SIDE * SIDE]; break;
        case 11: tribox_grid_fill_solid(&grid, &mesh, bits); sum += (unsigned)bits[SIDE * SIDE]; break;
        case 12: sum += (unsigned)tribox_mesh_query(&mesh, soup, soup + 3, NULL, 0); break;
        default: break;
        }
    }
    return (int)sum;
}

#ifndef __wasm__
#include <stdlib.h>

int main(int argc, char **argv)
{
    prepare();
    return argc > 2 && work(atoi(argv[1]), atoi(argv[2])) == 77;
}
#endif
