/* All tests as one program: the header and the oracle are compiled once, which is most of the time that a
 * test program takes to build. Each file is a program of its own too: `make
 * build/tests/default/test_grid`. */

int test_overlap_main(void);
int test_tri_main(void);
int test_rule_main(void);
int test_thin_main(void);
int test_sat_main(void);
int test_exact_main(void);
int test_symmetry_main(void);
int test_nan_main(void);
int test_mode_main(void);
int test_field_main(void);
int test_grid_main(void);
int test_fill_main(void);
int test_few_main(void);
int test_frame_main(void);
int test_closed_main(void);
int test_solid_main(void);
int test_issues_main(void);

#define main test_overlap_main
#include "test_overlap.c"
#undef main

#define main test_tri_main
#include "test_tri.c"
#undef main

#define main test_rule_main
#include "test_rule.c"
#undef main

#define main test_thin_main
#include "test_thin.c"
#undef main

#define main test_sat_main
#include "test_sat.c"
#undef main

#define main test_exact_main
#include "test_exact.c"
#undef main

#define main test_symmetry_main
#include "test_symmetry.c"
#undef main

#define main test_nan_main
#include "test_nan.c"
#undef main

#define main test_mode_main
#include "test_mode.c"
#undef main

#define main test_field_main
#include "test_field.c"
#undef main

#define main test_grid_main
#include "test_grid.c"
#undef main

#define main test_fill_main
#include "test_fill.c"
#undef main

#define main test_few_main
#include "test_few.c"
#undef main

#define main test_frame_main
#include "test_frame.c"
#undef main

#define main test_closed_main
#include "test_closed.c"
#undef main

#define main test_solid_main
#include "test_solid.c"
#undef main

#define main test_issues_main
#include "test_issues.c"
#undef main

static int suite_passed;
static int suite_failed;

static void suite_run(int (*program)(void))
{
    program();
    suite_passed += test_passed;
    suite_failed += test_failed;
    test_passed = 0;
    test_failed = 0;
}

int main(void)
{
    suite_run(test_overlap_main);
    suite_run(test_tri_main);
    suite_run(test_rule_main);
    suite_run(test_thin_main);
    suite_run(test_sat_main);
    suite_run(test_exact_main);
    suite_run(test_symmetry_main);
    suite_run(test_nan_main);
    suite_run(test_mode_main);
    suite_run(test_field_main);
    suite_run(test_grid_main);
    suite_run(test_fill_main);
    suite_run(test_few_main);
    suite_run(test_frame_main);
    suite_run(test_closed_main);
    suite_run(test_solid_main);
    suite_run(test_issues_main);
    test_passed = suite_passed;
    test_failed = suite_failed;
    return test_report("suite");
}
