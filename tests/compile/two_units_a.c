/* Two units of one program, each with its own copy: no symbol is defined twice, and an object prepared in
 * one unit is tested in the other. */
#include "tribox.h"

#include <stdio.h>

#include "every_function.h"

int unit_b_wrong_answers(void);
int unit_b_test(const tribox_tri *tri, const float p[3]);

int main(void)
{
    const float v0[3] = {0, 0, 0};
    const float v1[3] = {1, 0, 0};
    const float v2[3] = {0, 1, 1};
    const float size[3] = {1, 1, 1};
    const float p[3] = {0, 0, 0};
    const float q[3] = {2, 2, 2};
    tribox_tri  tri;
    int         ok;

    tribox_tri_init(&tri, v0, v1, v2, size, 0);
    ok = unit_b_test(&tri, p) == 1 && unit_b_test(&tri, q) == 0 && every_function() == 0 &&
         unit_b_wrong_answers() == 0;
    printf("test_units: %d passed, %d failed\n", ok, !ok);
    return !ok;
}
