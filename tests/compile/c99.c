/* The header is C99 as it stands: the only include, before any other, in a strict unit. Exit status 0 is a
 * pass. */
#include "tribox.h"

#include <stdio.h>

int main(void)
{
    const float v0[3] = {.5f, .2f, .6f};
    const float v1[3] = {.3f, .1f, .4f};
    const float v2[3] = {.3f, .6f, .6f};
    const float box_min[3] = {.4f, .4f, .5f};
    const float box_max[3] = {.7f, .5f, .6f};
    const int   ok =
        tribox_overlap(v0, v1, v2, box_min, box_max) == 1 &&
        TRIBOX_VERSION == TRIBOX_VERSION_MAJOR * 10000 + TRIBOX_VERSION_MINOR * 100 + TRIBOX_VERSION_PATCH;

    printf("test_c99: %d passed, %d failed\n", ok, !ok);
    return !ok;
}
