/* 01_overlap - does a triangle touch a box? Prints:
 *
 *   touches the box:                  1
 *   the box moved by one float:       0
 */
#include "tribox.h"

#include <stdio.h>

int main(void) {
    const float v0[3] = {0, 0, 0}, v1[3] = {1, 0, 0}, v2[3] = {0, 1, 0};
    const float box_min[3] = {0.5f, 0.5f, -1}, box_max[3] = {2, 2, 1};
    const float moved[3] = {0.50000006f, 0.5f, -1};             /* the next float after 0.5 */
    printf("touches the box:                  %d\n", tribox_overlap(v0, v1, v2, box_min, box_max));
    printf("the box moved by one float:       %d\n", tribox_overlap(v0, v1, v2, moved, box_max));
    return 0;
}
