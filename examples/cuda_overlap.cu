/* cuda_overlap - tribox.h in device code: one triangle a thread, against boxes
 *
 *   nvcc -I. -o build/cuda_overlap examples/cuda_overlap.cu && build/cuda_overlap
 *
 * Coordinates are multiples of 0.1f and 0.125f in a small range, so that many pairs touch by exactly a
 * point, an edge or a plane. The device's answers are compared with the host's, bit for bit; so are those
 * of prepared triangles. Prints:
 *
 *   100000 triangles, 64 boxes each: 654849 overlaps on the device, 654849 on the host
 *   the same answers for all 6400000 pairs, from tribox_overlap and from tribox_tri_test
 *
 * Exit status: 0 the same, 1 not the same, 77 no device.
 */
#include "tribox.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TRIANGLES = 100000, BOXES = 64, THREADS = 128 };

typedef struct answers {
    uint64_t direct;        /* bit b: tribox_overlap with box b */
    uint64_t prepared;      /* bit b: tribox_tri_test at box b's corner */
} answers;

/* A prepared triangle is tested against [p, p + size] in real numbers. Here p and size are multiples of
   1/8, so p + size is a float, and the direct test gets the same box. */
__host__ __device__ static answers test_triangle(const float *corners, const float *boxes) {
    const float size[3] = {0.125f, 0.25f, 0.5f};
    const float *v0 = corners;
    const float *v1 = corners + 3;
    const float *v2 = corners + 6;
    answers result = {0, 0};
    tribox_tri tri;
    int b;
    tribox_tri_init(&tri, v0, v1, v2, size, 0);
    for (b = 0; b < BOXES; b++) {
        const float *p = boxes + 3 * b;
        const float q[3] = {p[0] + size[0], p[1] + size[1], p[2] + size[2]};
        result.direct |= (uint64_t)tribox_overlap(v0, v1, v2, p, q) << b;
        result.prepared |= (uint64_t)tribox_tri_test(&tri, p) << b;
    }
    return result;
}

__global__ void test_triangles(const float *corners, const float *boxes, answers *out) {
    int t = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (t < TRIANGLES) {
        out[t] = test_triangle(corners + 9 * t, boxes);
    }
}

static unsigned random_below(uint64_t *state, unsigned n) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(*state >> 33) % n;
}

static void stop(const char *what, cudaError_t error) {
    fprintf(stderr, "cuda_overlap: %s: %s\n", what, cudaGetErrorString(error));
    exit(error == cudaErrorNoDevice || error == cudaErrorInsufficientDriver ? 77 : 1);
}

static void check(const char *what, cudaError_t error) {
    if (error != cudaSuccess) {
        stop(what, error);
    }
}

static int compare(const float *corners, const float *boxes, const answers *device) {
    size_t device_hits = 0;
    size_t host_hits = 0;
    size_t differing = 0;
    int t;
    int b;
    for (t = 0; t < TRIANGLES; t++) {
        answers host = test_triangle(corners + 9 * t, boxes);
        differing += host.direct != device[t].direct || host.prepared != device[t].prepared
                  || host.direct != host.prepared;
        for (b = 0; b < BOXES; b++) {
            device_hits += device[t].direct >> b & 1;
            host_hits += host.direct >> b & 1;
        }
    }
    printf("%d triangles, %d boxes each: %lu overlaps on the device, %lu on the host\n", TRIANGLES, BOXES,
           (unsigned long)device_hits, (unsigned long)host_hits);
    if (differing) {
        printf("NOT the same answers for %lu triangles\n", (unsigned long)differing);
        return 1;
    }
    printf("the same answers for all %d pairs, from tribox_overlap and from tribox_tri_test\n",
           TRIANGLES * BOXES);
    return 0;
}

int main(void) {
    float *corners = (float *)malloc(TRIANGLES * 9 * sizeof *corners);
    float *boxes = (float *)malloc(BOXES * 3 * sizeof *boxes);
    answers *result = (answers *)malloc(TRIANGLES * sizeof *result);
    float *device_corners = NULL;
    float *device_boxes = NULL;
    answers *device_result = NULL;
    uint64_t state = 1;
    int devices = 0;
    int status;
    int i;
    if (!corners || !boxes || !result) {
        fprintf(stderr, "cuda_overlap: out of memory\n");
        return 1;
    }
    check("no device", cudaGetDeviceCount(&devices));
    for (i = 0; i < TRIANGLES * 9; i++) {
        corners[i] = (float)random_below(&state, 17) * (i % 2 ? 0.1f : 0.125f);
    }
    for (i = 0; i < BOXES * 3; i++) {
        boxes[i] = (float)random_below(&state, 12) * 0.125f;
    }
    check("memory for corners", cudaMalloc((void **)&device_corners, TRIANGLES * 9 * sizeof *corners));
    check("memory for boxes", cudaMalloc((void **)&device_boxes, BOXES * 3 * sizeof *boxes));
    check("memory for answers", cudaMalloc((void **)&device_result, TRIANGLES * sizeof *result));
    check("corners", cudaMemcpy(device_corners, corners, TRIANGLES * 9 * sizeof *corners,
                                cudaMemcpyHostToDevice));
    check("boxes", cudaMemcpy(device_boxes, boxes, BOXES * 3 * sizeof *boxes, cudaMemcpyHostToDevice));
    test_triangles<<<(TRIANGLES + THREADS - 1) / THREADS, THREADS>>>(device_corners, device_boxes,
                                                                     device_result);
    check("kernel", cudaGetLastError());
    check("answers", cudaMemcpy(result, device_result, TRIANGLES * sizeof *result, cudaMemcpyDeviceToHost));
    status = compare(corners, boxes, result);
    cudaFree(device_corners);
    cudaFree(device_boxes);
    cudaFree(device_result);
    free(corners);
    free(boxes);
    free(result);
    return status;
}
