/* One function per reported bug. None so far.
 *
 * The form, with the numbers of the failing question as the tests print them:
 *
 *     (Comment: Issue 17, reported by A. User: a wall on a grid plane was lost at x = 0.1f.)
 *     static void issue_17_wall_on_a_grid_plane(void)
 *     {
 *         static const float t[9] = {0x1.99999ap-4f, ...};
 *         static const float lo[3] = {...};
 *         static const float hi[3] = {...};
 *
 *         CHECK(tribox_overlap(t, t + 3, t + 6, lo, hi) == 1);
 *     }
 *
 * and RUN(issue_17_wall_on_a_grid_plane) in main. */
#include "tribox.h"

#include "question.h"

int main(void)
{
    return test_report("test_issues");
}
