/* clang -I. -O1 -g -fsanitize=fuzzer,address,undefined tests/fuzz_companions.c -lgmp -o fuzz_companions
 *
 * Every companion against the exact judge, to the last bit of what it writes; axes and gaps within their bounds.
 */
#include "companions_answers.h"
#include "fuzz_input.h"
#include "verify_companions.h"

static void print_answer(const char *who, const companion_answer *a, int f64)
{
    int i;
    printf("\n    %s %d:", who, a->value);
    for (i = 0; i < a->n; ++i) {
        printf(" %a", companion_number(a->word[i], f64));
    }
    for (i = 0; i < 3; ++i) {
        printf(" %a", companion_number(a->axis[i], 0));
    }
}

static void wrong_answer(const companion *c, const companion_answer *got, const companion_answer *want)
{
    int i;
    printf("WRONG %s f64 %d flags %u", companion_names[c->which], c->f64, c->flags);
    for (i = 0; i < COMPANION_NUMBERS; ++i) {
        printf("%s%a", i == COMPANION_T1 || i % 3 != 0 ? ", " : "\n    ", companion_number(c->x[i], c->f64));
    }
    print_answer("got", got, c->f64);
    print_answer("exact", want, c->f64);
    printf("\n");
    fflush(stdout);
    abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static companion_work work;
    static int ready;
    bytes b;
    companion c;
    companion_answer got, want;
    double x[COMPANION_NUMBERS];
    int i;
    if (!ready) {
        companion_init(&work);
        ready = 1;
    }
    b.at = data;
    b.left = size;
    memset(&c, 0, sizeof c);
    c.which = take_byte(&b) % COMPANIONS;
    c.flags = take_byte(&b);
    c.f64 = !companion_has_float(c.which) || (companion_has_f64(c.which) && (c.flags & 128u) != 0);
    for (i = 0; i < COMPANION_NUMBERS; ++i) {
        x[i] = take_number(&b, x, i, c.f64);
    }
    companion_write(&c, x);
    companion_ask(&c, &got);
    companion_judge(&work, &c, WRONG_NOTHING, &want);
    if (!companion_same(&got, &want) || !companion_is_near(&work, c.which, &got, &want)) {
        wrong_answer(&c, &got, &want);
    }
    return 0;
}
