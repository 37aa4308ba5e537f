// The header in C++20: a lambda as the span callback, a container's data as the bit array.
#include <vector>

#include "tribox.h"

#include <cstdio>

#include "every_function.h"

int main()
{
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {8, 8, 8}, 0};
    const float v0[3] = {0.5f, 0.5f, 0.5f};
    const float v1[3] = {7.5f, 0.5f, 0.5f};
    std::vector<int> rows;
    std::vector<uint64_t> bits(tribox_grid_words(&grid));
    const std::size_t     voxels = tribox_grid_spans(
            &grid, v0, v1, v1,
            [](void *user, int x0, int x1, int, int) {
            static_cast<std::vector<int> *>(user)->push_back(x1 - x0);
        },
            &rows);
    const bool ok =
        every_function() == 0 && voxels == 8 && rows.size() == 1 && rows[0] == 7 && bits.size() == 64;

    std::printf("test_cpp: %d passed, %d failed\n", ok ? 1 : 0, ok ? 0 : 1);
    return ok ? 0 : 1;
}
