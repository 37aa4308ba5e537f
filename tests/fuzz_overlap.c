/* clang -I. -O1 -g -fsanitize=fuzzer,address,undefined tests/fuzz_overlap.c -lgmp -o fuzz_overlap
 *
 * One box, all entries and rules, against the exact judge; symmetric under swapping corners. */
#include "fuzz_input.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes b;
    question ask;
    float f[15];
    unsigned flags, rules;
    const double *x = ask.x;
    b.at = data;
    b.left = size;
    take_question(&b, &ask, take_byte(&b) & 1);
    ask.kind = ASK_BOX;
    rules = exact_axes(fuzz_judge(), &ask);
    narrow_all(f, x);
    for (flags = 0; flags < 8; ++flags) {
        const unsigned rule = flags >= 4 ? (unsigned)RULE_CLOSED : rule_of(flags);
        const int want = (int)(rules >> rule & 1u);
        require("tribox_overlap_rule_f64", flags,
                tribox_overlap_rule_f64(x, x + 3, x + 6, x + 9, x + 12, flags), want, &ask);
        require("tribox_overlap_rule_f64, corners turned", flags,
                tribox_overlap_rule_f64(x + 6, x + 3, x, x + 9, x + 12, flags), want, &ask);
        if (floats(x, 15)) {
            require("tribox_overlap_rule", flags, tribox_overlap_rule(f, f + 3, f + 6, f + 9, f + 12, flags),
                    want, &ask);
        }
    }
    require("tribox_overlap_f64", 0, tribox_overlap_f64(x, x + 3, x + 6, x + 9, x + 12), (int)(rules & 1u),
            &ask);
    if (floats(x, 15)) {
        require("tribox_overlap", 0, tribox_overlap(f, f + 3, f + 6, f + 9, f + 12), (int)(rules & 1u), &ask);
        tribox_sat(f, f + 3, f + 6, f + 9, f + 12);
    }
    return 0;
}
