// In which voxel PCL and OctoMap put a point: points.cxx prints, for points on multiples of 1/4 and of 0.1 (as floats),
// how many lie in another voxel than floor(x/s) of the exact numbers.
#include <octomap/OcTree.h>
#include <octomap/octomap.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/pcl_config.h>
#include <pcl/point_types.h>

#include <cstdio>

#include "tribox.h"

// floor((x - 0)/s), exactly
static int exact(double x, double s)
{
    tribox_grid g = {{0, 0, 0}, {s, s, s}, {-100000, -1, -1}, {100000, 1, 1}, 0};
    const double p[3] = {x, 0, 0};
    int index[3];
    tribox_grid_locate(&g, p, index);
    return index[0];
}

int main()
{
    const float sizes[2] = {0.25f, 0.1f};
    std::printf("PCL %s\n", PCL_VERSION_PRETTY);
    for (int k = 0; k < 2; k++) {
        octomap::OcTree tree((double)sizes[k]);
        int pcl_wrong = 0, octomap_wrong = 0, octomap_decimal = 0;
        octomap::OcTree decimal(k ? 0.1 : 0.25);
        for (int i = -4000; i < 4000; i++) {
            const float x = (float)i * sizes[k];
            pcl::VoxelGrid<pcl::PointXYZ> grid;
            grid.setLeafSize(sizes[k], sizes[k], sizes[k]);
            grid.setMinimumPointsNumberPerVoxel(1);
            // getGridCoordinates is PCL's own floor(x * (1 / leaf))
            pcl_wrong += grid.getGridCoordinates(x, 0, 0)[0] != exact((double)x, (double)sizes[k]);
            octomap_wrong += (int)tree.coordToKey((double)x) - 32768 != exact((double)x, (double)sizes[k]);
            octomap_decimal += (int)decimal.coordToKey(i * 0.1) - 32768 != exact(i * 0.1, 0.1);
        }
        std::printf("size %-5g of 8000 points: PCL %d, OctoMap %d in another voxel than floor(x/s)%s", (double)sizes[k],
                    pcl_wrong, octomap_wrong, k ? "" : "\n");
        if (k) {
            std::printf("; doubles i * 0.1 in 0.1: OctoMap %d\n", octomap_decimal);
        }
    }
    return 0;
}
