/* Included twice in one unit, with the macros that other headers define in between. */
#include "tribox.h"
#include <math.h>
#include <stdlib.h>
#include "tribox.h"

#include <stdio.h>

#include "every_function.h"

int main(void)
{
    const int wrong = every_function();

    printf("test_twice: %d passed, %d failed\n", wrong == 0, wrong != 0);
    return wrong != 0;
}
