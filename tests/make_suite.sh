#!/bin/sh
# Writes one program of several test files: sh tests/make_suite.sh program NAME... where each NAME is a test_NAME.c.
# The program runs all tests, or those whose names contain its argument. Its last line is the count.
program=$1
shift
echo "/* Written by tests/make_suite.sh. */"
for name in "$@"; do
    printf 'int test_%s_main(void);\n#define main test_%s_main\n#include "tests/test_%s.c"\n#undef main\n\n' \
        "$name" "$name" "$name"
done
cat <<'C'
static int suite_passed;
static int suite_failed;

static void suite_run(int (*file)(void))
{
    file();
    suite_passed += test_passed;
    suite_failed += test_failed;
    test_passed = 0;
    test_failed = 0;
}

int main(int argc, char **argv)
{
    test_only = argc > 1 ? argv[1] : NULL;
C
for name in "$@"; do
    echo "    suite_run(test_${name}_main);"
done
cat <<C
    if (test_only != NULL && suite_passed + suite_failed == 0) {
        printf("no test is named %s\n", test_only);
        suite_failed++;
    }
    test_passed = suite_passed;
    test_failed = suite_failed;
    return test_report("$program");
}
C
