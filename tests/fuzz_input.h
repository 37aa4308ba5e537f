/* What the fuzz targets share: numbers out of bytes, the exact judge, and how a wrong answer ends. A number
 * takes one byte that says what it is and up to eight more, so that changed bytes give small integers,
 * neighbours of earlier numbers, special values or anything at all.
 */
#ifndef FUZZ_INPUT_H
#define FUZZ_INPUT_H

#include "verify_cases.h"
#include "../tribox.h"

#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct bytes {
    const uint8_t *at;
    size_t left;
} bytes;

static inline uint8_t take_byte(bytes *b)
{
    if (b->left == 0) {
        return 0;
    }
    --b->left;
    return *b->at++;
}

static inline uint64_t take_word(bytes *b, int n)
{
    uint64_t word = 0;
    while (n-- > 0) {
        word = word << 8 | take_byte(b);
    }
    return word;
}

/* one number; x[0..i-1] are those before it */
static inline double take_number(bytes *b, const double *x, int i, int f64)
{
    const uint8_t tag = take_byte(b);
    const int arg = tag >> 3;
    double d = 0.0;
    switch (tag & 7) {
    case 0:
        d = (double)arg;
        break;
    case 1:
        d = (double)(int8_t)take_byte(b) / 8.0;
        break;
    case 2: /* an earlier number, or a neighbour of it */
        d = i > 0 ? x[arg % i] : 1.0;
        d = number_step(d, (int8_t)take_byte(b), f64);
        break;
    case 3: /* halfway between two earlier numbers */
        d = i > 0 ? x[arg % i] : 0.5;
        d = d / 2.0 + (i > 0 ? x[take_byte(b) % i] : 0.5) / 2.0;
        break;
    case 4:
        d = (double)(int8_t)take_byte(b) * (arg % 2 ? 0.1 : 1.0 / 3.0);
        break;
    case 5:
        d = power_of_two((int)take_word(b, 2) % 1100) * (arg % 2 ? 1.0 : -1.0);
        if (arg & 2) {
            d = power_of_two(-((int)take_byte(b) * 4 + arg));
        }
        break;
    case 6: {
        static const double special[6] = {
            0.0, -0.0, 0x1p-149, 0x1.fffffep127, 0x1p-1074, 0x1.fffffffffffffp1023};
        d = arg < 6 ? special[arg] : bits_double(UINT64_C(0x7ff) << 52 | (uint64_t)(arg % 3 == 0) << 51);
        break;
    }
    default:
        d = bits_double(take_word(b, 8));
        break;
    }
    if (f64 || is_nan(d)) {
        return d;
    }
    return is_finite(d) ? number_fit(d, 0) : d;
}

static inline void take_question(bytes *b, question *ask, int f64)
{
    int i;
    memset(ask, 0, sizeof *ask);
    for (i = 0; i < 15; ++i) {
        ask->x[i] = take_number(b, ask->x, i, f64);
    }
}

static inline exact_judge *fuzz_judge(void)
{
    static exact_judge x;
    static int ready;
    if (!ready) {
        exact_init(&x);
        ready = 1;
    }
    return &x;
}

static inline void narrow_all(float out[15], const double x[15])
{
    int i;
    for (i = 0; i < 15; ++i) {
        out[i] = is_float(x[i]) ? (float)x[i] : 0.0f;
    }
}

static inline int floats(const double *x, int n)
{
    int i;
    for (i = 0; i < n; ++i) {
        if (!is_float(x[i])) {
            return 0;
        }
    }
    return 1;
}

static inline void require(const char *what, unsigned flags, int got, int want, const question *ask)
{
    int i;
    if (got == want) {
        return;
    }
    printf("WRONG %s flags %u: got %d, exact %d", what, flags, got, want);
    for (i = 0; i < 15; ++i) {
        printf("%s%a", i % 3 == 0 ? "\n    " : ", ", ask->x[i]);
    }
    printf("\n");
    fflush(stdout);
    abort();
}

#endif
