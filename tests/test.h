/* The smallest test frame that names what failed: CHECK counts and goes on, RUN counts test functions.
 * A program ends with `return test_report("test_x");`, which prints "test_x: N passed, N failed". */
#ifndef TEST_H
#define TEST_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Loop counts are divided by this, so that slow targets (emulators, sanitizers) can run the same tests. */
#ifndef TEST_SCALE
#define TEST_SCALE 1
#endif
#define TEST_LOOPS(n) ((n) / TEST_SCALE > 0 ? (n) / TEST_SCALE : 1)
/* For the larger helpers: out of line, or the suite takes twice as long to compile. */
#if defined(__GNUC__)
#define TEST_FN static __attribute__((noinline, unused))
#else
#define TEST_FN static inline
#endif

#define TEST_SHOWN 5    /* failed checks printed in full for one test function; the rest are only counted */

static const char *test_only; /* run only tests whose names contain this; NULL: all */
static int test_passed;
static int test_failed;
static int test_failed_checks;

TEST_FN int test_check(int ok, const char *file, int line, const char *text)
{
    if (!ok) {
        test_failed_checks++;
        if (test_failed_checks <= TEST_SHOWN) {
            printf("%s:%d: CHECK(%s) failed\n", file, line, text);
        }
#ifdef TEST_STOP /* at the first one: it is enough for a broken header */
        exit(1);
#endif
    }
    return ok;
}

/* Is there room for the details of one more failing case? */
static inline int test_wants_details(void)
{
    return test_failed_checks < TEST_SHOWN;
}

TEST_FN void test_run(void (*test)(void), const char *name)
{
    if (test_only != NULL && strstr(name, test_only) == NULL) {
        return;
    }
    test_failed_checks = 0;
    test();
    if (test_failed_checks == 0) {
        test_passed++;
    } else {
        test_failed++;
        printf("FAILED %s: %d checks\n", name, test_failed_checks);
    }
    fflush(stdout);
}

static inline int test_report(const char *program)
{
    if (test_only != NULL && test_passed + test_failed == 0) { /* another file's test was asked for */
        return 0;
    }
    printf("%s: %d passed, %d failed\n", program, test_passed, test_failed);
    return test_failed != 0;
}

#define CHECK(cond) test_check((cond) != 0, __FILE__, __LINE__, #cond)
#define RUN(test)   test_run(test, #test)

#endif /* TEST_H */
