/* Names that other headers take as macros before ours comes, replaced by what breaks a file that uses them: nothing,
 * a keyword (-DHOSTILE=goto) or a number (-DHOSTILE=7). A macro that stands for another name would prove nothing: it
 * would rename ours everywhere. tests/check_words.sh looks for further ones in the headers at hand. */
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

#ifndef HOSTILE
#define HOSTILE
#endif

/* <windows.h>, and its years of 16 bits */
#define min(a, b)   HOSTILE
#define max(a, b)   HOSTILE
#define near        HOSTILE
#define far         HOSTILE
#define huge        HOSTILE
#define small       HOSTILE
#define interface   HOSTILE
#define pascal      HOSTILE
#define cdecl       HOSTILE
#define IN          HOSTILE
#define OUT         HOSTILE
#define OPTIONAL    HOSTILE
#define THIS        HOSTILE
#define ERROR       HOSTILE
#define TRUE        HOSTILE
#define FALSE       HOSTILE
#define grp1        HOSTILE
#define hyper       HOSTILE
/* Qt */
#define emit        HOSTILE
#define signals     HOSTILE
#define slots       HOSTILE
#define foreach     HOSTILE
#define forever     HOSTILE
/* <term.h>, <curses.h> */
#define lines       HOSTILE
#define columns     HOSTILE
#define newline     HOSTILE
#define tab         HOSTILE
#define bell        HOSTILE
#define clear_screen HOSTILE
#define reset_2string HOSTILE
#define over_strike HOSTILE
#define plab_norm   HOSTILE
#define enter_bold_mode HOSTILE
/* <complex.h>, <termios.h>, <ctype.h>, <sys/sysmacros.h>, gcc's own in gnu modes, math's */
#define I           HOSTILE
#define complex     HOSTILE
#define imaginary   HOSTILE
#define B0          HOSTILE
#define _N          HOSTILE
#define minor       HOSTILE
#define major       HOSTILE
#undef linux
#define linux       HOSTILE
#undef unix
#define unix        HOSTILE
#undef i386
#define i386        HOSTILE
#define sun         HOSTILE
#define mips        HOSTILE
#define vector      HOSTILE
#define pixel       HOSTILE
#define bool        HOSTILE
#define true        HOSTILE
#define false       HOSTILE
#define DOMAIN      HOSTILE
#define OVERFLOW    HOSTILE
#define UNDERFLOW   HOSTILE
#define HUGE        HOSTILE
#define abs(a)      HOSTILE
#define fabs(a)     HOSTILE
#define assert(x)   HOSTILE
#define memcpy      HOSTILE
#define memset      HOSTILE
/* <X11/X.h> */
#define None        HOSTILE
#define Bool        HOSTILE
#define Status      HOSTILE
#define Above       HOSTILE
#define Below       HOSTILE
#define Always      HOSTILE
/* what people write by hand, in programs like ours above all */
#define N           HOSTILE
#define E           HOSTILE
#define PI          HOSTILE
#define EPSILON     HOSTILE
#define SWAP        HOSTILE
#define CROSS       HOSTILE
#define DOT         HOSTILE
#define SUB         HOSTILE
#define FINDMINMAX  HOSTILE
#define PLANETEST   HOSTILE
#define X           HOSTILE
#define Y           HOSTILE
#define Z           HOSTILE
#define SIGN        HOSTILE
#define CLAMP       HOSTILE
#define MIN         HOSTILE
#define MAX         HOSTILE
#define HIT         HOSTILE
#define MISS        HOSTILE
#define UNSURE      HOSTILE
#define real        HOSTILE
#define string      HOSTILE
#define uint        HOSTILE
#define restrict    HOSTILE
#define noreturn    HOSTILE
#define likely(x)   HOSTILE
#define unlikely(x) HOSTILE

#include "tribox.h"

#include "every_function.h"

int main(void)
{
    const int wrong = every_function();

    printf("test_macros: %d passed, %d failed\n", wrong == 0, wrong != 0);
    return wrong != 0;
}
