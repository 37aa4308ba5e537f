/* Names that other headers take as macros before ours comes: <windows.h> (min, max, near, far, small,
 * interface), <complex.h> (I), <termios.h> and <ctype.h> of old (B0, _N), and what people write by hand.
 * The header's own names must neither be hit by these nor disturb them. */
#include <float.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#if defined(__GNUC__) && defined(__SSE2__)
#include <immintrin.h>
#endif
#if defined(__ARM_NEON)
#include <arm_neon.h>
#endif

#define min(a, b)   HOSTILE
#define max(a, b)   HOSTILE
#define abs(a)      HOSTILE
#define fabs(a)     HOSTILE
#define near        HOSTILE
#define far         HOSTILE
#define small       HOSTILE
#define interface   HOSTILE
#define huge        HOSTILE
#define I           HOSTILE
#define N           HOSTILE
#define E           HOSTILE
#define B0          HOSTILE
#define PI          HOSTILE
#define EPSILON     HOSTILE
#define SWAP        HOSTILE
#define CROSS       HOSTILE
#define DOT         HOSTILE
#define SUB         HOSTILE
#define FINDMINMAX  HOSTILE
#define X           HOSTILE
#define Y           HOSTILE
#define Z           HOSTILE
#define TRUE        HOSTILE
#define FALSE       HOSTILE
#define SIGN        HOSTILE
#define CLAMP       HOSTILE
#define minor       HOSTILE
#define major       HOSTILE
#define unix_time   HOSTILE
#define assert(x)   HOSTILE
#define memcpy      HOSTILE
#define memset      HOSTILE

#include "tribox.h"

#include "every_function.h"

int main(void)
{
    const int wrong = every_function();

    printf("test_macros: %d passed, %d failed\n", wrong == 0, wrong != 0);
    return wrong != 0;
}
