/* examples/voxel_test.h: a voxelizer that is right passes; one that marks the bounding boxes, one that leaves out a face
 * on a grid plane, and one that is off by half a voxel are found, with their counts. Also compiled as C++98. */
#include "examples/voxel_test.h"

static int failures;

static void expect(const char *what, voxel_test t, int valid, size_t exact, size_t missing, size_t extra) {
    if (t.valid != valid || t.exact != exact || t.missing != missing || t.extra != extra) {
        printf("FAIL: %s: valid %d, exact %lu, missing %lu, extra %lu\n", what, t.valid, (unsigned long)t.exact,
               (unsigned long)t.missing, (unsigned long)t.extra);
        failures++;
    }
}

/* The triangle (1,1,1) (3,1,1) (1,3,1): a right angle of two in the plane z = 1. */
static const float positions[9] = {1, 1, 1, 3, 1, 1, 1, 3, 1};

/* Closed: layers z = 0 and 1, in each the voxels x, y of 0..3 but those beyond x + y = 4, touched by no corner. */
static int right(void *user, int x, int y, int z) {
    (void)user;
    return (z == 0 || z == 1) && x >= 0 && y >= 0 && x + y <= 4 && x <= 3 && y <= 3;
}

static int bounds(void *user, int x, int y, int z) {
    (void)user;
    return (z == 0 || z == 1) && x >= 0 && y >= 0 && x <= 3 && y <= 3;
}

static int one_side(void *user, int x, int y, int z) {
    return z == 1 && right(user, x, y, z);
}

static int moved(void *user, int x, int y, int z) {
    return right(user, x - 1, y, z);
}

static int nothing(void *user, int x, int y, int z) {
    (void)user;
    (void)x;
    (void)y;
    (void)z;
    return 0;
}

int main(void) {
    tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {-1, -1, -1}, {6, 6, 6}, 0};
    tribox_mesh mesh = {NULL, 0, NULL, 1};
    FILE *said = tmpfile();
    char line[200] = "";
    mesh.positions = positions;
    expect("right", voxel_test_run(&grid, &mesh, right, NULL, NULL), 1, 26, 0, 0);
    expect("bounding boxes", voxel_test_run(&grid, &mesh, bounds, NULL, NULL), 1, 26, 0, 6);
    expect("one side of a grid plane", voxel_test_run(&grid, &mesh, one_side, NULL, said), 1, 26, 13, 0);
    expect("moved", voxel_test_run(&grid, &mesh, moved, NULL, NULL), 1, 26, 8, 8);
    expect("nothing inside", voxel_test_solid(&grid, &mesh, nothing, NULL, NULL), 1, 0, 0, 0);
    grid.flags = TRIBOX_OPEN;
    expect("open", voxel_test_run(&grid, &mesh, nothing, NULL, NULL), 1, 0, 0, 0);
    grid.hi[0] = -1;
    expect("an empty grid", voxel_test_run(&grid, &mesh, nothing, NULL, NULL), 0, 0, 0, 0);
    if (said) {
        rewind(said);
        if (!fgets(line, sizeof line, said) || line[0] != 'm') {
            printf("FAIL: it says '%s'\n", line);
            failures++;
        }
        fclose(said);
    }
    printf("voxel_test: %s", line);
    return failures != 0;
}
