/* clang -I. -O1 -g -fsanitize=fuzzer,address,undefined tests/fuzz_tri.c -lgmp -o fuzz_tri
 *
 * The prepared test, every pairing of formats and every flag, against the exact judge; several boxes a setup.
 */
#include "fuzz_input.h"

static void try_flags(const question *ask, const double *more, int n, unsigned flags)
{
    const double *x = ask->x;
    question moved = *ask;
    tribox_tri wide, narrowed;
    float f[15];
    const int narrow_set = floats(x, 9) && floats(x + 12, 3);
    int i, k;
    narrow_all(f, x);
    tribox_tri_init_f64(&wide, x, x + 3, x + 6, x + 12, flags);
    tribox_tri_init(&narrowed, f, f + 3, f + 6, f + 12, flags);
    for (i = 0; i < n; ++i) {
        float p[3];
        int want;
        for (k = 0; k < 3; ++k) {
            moved.x[9 + k] = more[3 * i + k];
            p[k] = is_float(moved.x[9 + k]) ? (float)moved.x[9 + k] : 0.0f;
        }
        want = (int)(exact_axes(fuzz_judge(), &moved) >> rule_of(flags) & 1u);
        require("tribox_tri_init_f64, _test_f64", flags, tribox_tri_test_f64(&wide, moved.x + 9), want,
                &moved);
        if (floats(moved.x + 9, 3)) {
            require("tribox_tri_init_f64, _test", flags, tribox_tri_test(&wide, p), want, &moved);
        }
        if (narrow_set) {
            require("tribox_tri_init, _test_f64", flags, tribox_tri_test_f64(&narrowed, moved.x + 9), want,
                    &moved);
        }
        if (narrow_set && floats(moved.x + 9, 3)) {
            require("tribox_tri_init, _test", flags, tribox_tri_test(&narrowed, p), want, &moved);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes b;
    question ask;
    double more[12];
    unsigned flags;
    int f64, i;
    b.at = data;
    b.left = size;
    f64 = take_byte(&b) & 1;
    take_question(&b, &ask, f64);
    ask.kind = ASK_TRI;
    for (i = 0; i < 12; ++i) {
        more[i] = i < 3 ? ask.x[9 + i] : take_number(&b, ask.x, 15, f64);
    }
    for (flags = 0; flags < 5; ++flags) {
        try_flags(&ask, more, 4, flags);
    }
    return 0;
}
