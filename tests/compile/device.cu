// The header in device code: the same calls on the host and in a kernel. Without a GPU the program says so
// and passes its host half only.
#include "tribox.h"

#include <cstdio>

__host__ __device__ static int wrong_answers()
{
    const float v0[3] = {.5f, .2f, .6f};
    const float v1[3] = {.3f, .1f, .4f};
    const float v2[3] = {.3f, .6f, .6f};
    const float box_min[3] = {.4f, .4f, .5f};
    const float box_max[3] = {.7f, .5f, .6f};
    const double d0[3] = {0.25, 0.25, 0.5};
    const double d1[3] = {0.75, 0.25, 0.5};
    const double d2[3] = {0.25, 0.75, 1.0};
    const double one[3] = {1, 1, 1};
    const double p[3] = {0, 0, 1};
    tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {4, 4, 4}, TRIBOX_HALF_OPEN};
    tribox_tri tri;
    int index[3];
    int wrong = 0;

    wrong += tribox_overlap(v0, v1, v2, box_min, box_max) != 1;
    wrong += tribox_overlap_rule_f64(d0, d1, d2, p, one, 0) != 1;
    tribox_tri_init_f64(&tri, d0, d1, d2, one, TRIBOX_OPEN);
    wrong += tribox_tri_test_f64(&tri, p) != 0;
    wrong += tribox_grid_spans_f64(&grid, d0, d1, d2, 0, 0) != 2;
    wrong += tribox_grid_locate(&grid, d2, index) != 1 || index[2] != 1;
    return wrong;
}

__global__ void count_wrong_answers(int *wrong)
{
    *wrong = wrong_answers();
}

int main()
{
    int *wrong = 0;
    const int host = wrong_answers();

    if (cudaMallocManaged(&wrong, sizeof *wrong) != cudaSuccess) {
        std::printf("SKIP: no GPU, host half only\ntest_device: %d passed, %d failed\n", host == 0,
                    host != 0);
        return host != 0;
    }
    *wrong = -1;
    count_wrong_answers<<<1, 1>>>(wrong);
    const bool ran = cudaDeviceSynchronize() == cudaSuccess;
    const bool ok = ran && host == 0 && *wrong == 0;
    std::printf("test_device: %d passed, %d failed\n", ok ? 1 : 0, ok ? 0 : 1);
    return ok ? 0 : 1;
}
