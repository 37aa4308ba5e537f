/* The second unit; see two_units_a.c. */
#include "tribox.h"

#include "every_function.h"

int unit_b_wrong_answers(void);
int unit_b_test(const tribox_tri *tri, const float p[3]);

int unit_b_wrong_answers(void)
{
    return every_function();
}

int unit_b_test(const tribox_tri *tri, const float p[3])
{
    return tribox_tri_test(tri, p);
}
