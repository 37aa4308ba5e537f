/* golden: the header's answers to the golden inputs, as one hash that must be the same everywhere.
 *
 *   golden [eighth | few] [nearest | up | down | zero | daz | ftz | flush | x87-24 | x87-53]...
 *
 * Each argument asks again under that rounding mode, or with subnormals read as zero, or results flushed to
 * zero, or both, or with x87 computing to so many bits; modes add up. "eighth", and "few" (a 64th; also -DGOLDEN_ASK_FEW),
 * ask only the first of the inputs, which have hashes of their own. The expected hash in golden_overlap.h was computed by
 * exact judges (gen_golden.c), not by this header. Compiled with GOLDEN_PRINT, every answer is printed: gen_golden.c
 * then prints the same lines (tests/golden_diff.sh compares them).
 * Also compiles as C++; with GOLDEN_FREESTANDING it needs no library and exports golden_hash_high() and so on, for
 * WebAssembly, and brings a Windows program's entry.
 */
#ifdef GOLDEN_FREESTANDING
#include <stddef.h>
#include <stdint.h>
#else
#include <fenv.h>
#include <stdio.h>
#include <string.h>
#endif

#ifdef GOLDEN_PRINT
#define GOLDEN_SAY(what, index, word)                                                                       \
    printf("%s %lu %lx%08lx\n", what, (unsigned long)(index), (unsigned long)((uint64_t)(word) >> 32), \
           (unsigned long)((word) & 0xffffffffu))
#endif
#include "golden_answers.h"
#include "golden_overlap.h"

#ifdef GOLDEN_ASK_FEW
static uint32_t golden_chunks = GOLDEN_FEW;
#else
static uint32_t golden_chunks = GOLDEN_CHUNKS;
#endif

static uint64_t golden_expected(void)
{
    return golden_chunks == GOLDEN_CHUNKS   ? GOLDEN_HASH
           : golden_chunks == GOLDEN_EIGHTH ? GOLDEN_HASH_EIGHTH
                                            : GOLDEN_HASH_FEW;
}

static uint64_t golden_all(void)
{
    uint64_t hash = GOLDEN_BASIS;
    uint32_t chunk;
    for (chunk = 0; chunk < golden_chunks; ++chunk) {
        hash = golden_mix(hash, golden_chunk(chunk));
    }
    return hash;
}

/* 0, or 1 + the first committed input whose answer differs */
static int golden_first_wrong(void)
{
    int i;
    for (i = 0; i < GOLDEN_TABLE; ++i) {
        golden_single c;
        int k;
        c.f64 = golden_table[i].f64;
        for (k = 0; k < 9; ++k) {
            c.v[k] = golden_table[i].bits[k];
        }
        for (k = 0; k < 3; ++k) {
            c.lo[k] = golden_table[i].bits[9 + k];
            c.hi[k] = golden_table[i].bits[12 + k];
            c.size[k] = golden_table[i].bits[15 + k];
        }
        if (golden_ask_single(&c) != golden_table[i].answer) {
            return 1 + i;
        }
    }
    return 0;
}

#ifdef GOLDEN_FREESTANDING

/* What compilers may call on their own. */
void *memcpy(void *to, const void *from, size_t bytes);
void *memset(void *to, int value, size_t bytes);
uint32_t golden_hash_high(void);
uint32_t golden_hash_low(void);
uint32_t golden_expected_high(void);
uint32_t golden_expected_low(void);
uint32_t golden_wrong(void);

void *memcpy(void *to, const void *from, size_t bytes)
{
    volatile unsigned char *t = (volatile unsigned char *)to;
    const unsigned char *f = (const unsigned char *)from;
    while (bytes-- > 0) {
        *t++ = *f++;
    }
    return to;
}

void *memset(void *to, int value, size_t bytes)
{
    volatile unsigned char *t = (volatile unsigned char *)to;
    while (bytes-- > 0) {
        *t++ = (unsigned char)value;
    }
    return to;
}

uint32_t golden_hash_high(void)
{
    return (uint32_t)(golden_all() >> 32);
}

uint32_t golden_hash_low(void)
{
    return (uint32_t)golden_all();
}

uint32_t golden_expected_high(void)
{
    return (uint32_t)(golden_expected() >> 32);
}

uint32_t golden_expected_low(void)
{
    return (uint32_t)golden_expected();
}

uint32_t golden_wrong(void)
{
    return (uint32_t)golden_first_wrong();
}

#ifdef _WIN32
#include "windows_entry.h"
#endif

#else

/* tests/compile/before.h says it too, before it hides the compiler from the header */
#if defined(__GNUC__) && !defined(GOLDEN_ASM)
#define GOLDEN_ASM
#endif

/* 1 if the processor now reads subnormals as zero (bit 0) or writes zeros for them (bit 1), 0 if this program
 * knows no way to make it */
static int golden_flush(unsigned what)
{
#if (defined(__x86_64__) || defined(__SSE2__)) && defined(GOLDEN_ASM)
    unsigned control = 0;
    __asm__ volatile("stmxcsr %0" : "=m"(control));
    control &= ~0x8040u;
    control |= ((what & 1u) != 0 ? 0x40u : 0u) | ((what & 2u) != 0 ? 0x8000u : 0u);
    __asm__ volatile("ldmxcsr %0" : : "m"(control));
    return 1;
#elif defined(__aarch64__) && defined(GOLDEN_ASM)
    uint64_t control;
    if (what != 3) { /* one bit does both */
        return 0;
    }
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    control |= (uint64_t)1 << 24;
    __asm__ volatile("msr fpcr, %0" : : "r"(control));
    return 1;
#elif defined(__arm__) && defined(__ARM_FP) && defined(GOLDEN_ASM)
    unsigned control;
    if (what != 3) {
        return 0;
    }
    __asm__ volatile("vmrs %0, fpscr" : "=r"(control));
    control |= 1u << 24;
    __asm__ volatile("vmsr fpscr, %0" : : "r"(control));
    return 1;
#else
    (void)what;
    return 0;
#endif
}

/* x87's precision: 0 for 24 bits, 2 for 53, 3 for 64 */
static int golden_precision(unsigned what)
{
#if (defined(__x86_64__) || defined(__i386__)) && defined(GOLDEN_ASM)
    unsigned short control = 0;
    __asm__ volatile("fnstcw %0" : "=m"(control));
    control = (unsigned short)((control & ~0x300u) | what << 8);
    __asm__ volatile("fldcw %0" : : "m"(control));
    return 1;
#else
    (void)what;
    return 0;
#endif
}

/* sets the mode; 1 if it is known here */
static int golden_mode(const char *name)
{
    if (strcmp(name, "daz") == 0) {
        return golden_flush(1);
    }
    if (strcmp(name, "ftz") == 0) {
        return golden_flush(2);
    }
    if (strcmp(name, "flush") == 0) {
        return golden_flush(3);
    }
    if (strcmp(name, "x87-24") == 0) {
        return golden_precision(0);
    }
    if (strcmp(name, "x87-53") == 0) {
        return golden_precision(2);
    }
    if (strcmp(name, "nearest") == 0) {
        return fesetround(FE_TONEAREST) == 0;
    }
#ifdef FE_UPWARD
    if (strcmp(name, "up") == 0) {
        return fesetround(FE_UPWARD) == 0;
    }
#endif
#ifdef FE_DOWNWARD
    if (strcmp(name, "down") == 0) {
        return fesetround(FE_DOWNWARD) == 0;
    }
#endif
#ifdef FE_TOWARDZERO
    if (strcmp(name, "zero") == 0) {
        return fesetround(FE_TOWARDZERO) == 0;
    }
#endif
    return 0;
}

/* Does the word say that only a part of the inputs is asked? */
static int golden_part(const char *word)
{
    if (strcmp(word, "eighth") == 0) {
        golden_chunks = GOLDEN_EIGHTH;
    } else if (strcmp(word, "few") == 0) {
        golden_chunks = GOLDEN_FEW;
    } else {
        return 0;
    }
    return 1;
}

static int golden_report(const char *mode)
{
    const uint64_t hash = golden_all();
    const int wrong = golden_first_wrong();
    const int ok = hash == golden_expected() && wrong == 0;
    printf("golden %-8s %08lx%08lx %s\n", mode, (unsigned long)(hash >> 32),
           (unsigned long)(hash & 0xffffffffu), ok ? "ok" : "DIFFERS");
    if (wrong != 0) {
        printf("    first wrong answer: golden_table[%d]\n", wrong - 1);
    }
    return ok;
}

int main(int argc, char **argv)
{
    const int part = golden_part(argc > 1 ? argv[1] : "");
    int i, ok;
    ok = golden_report("default");
    for (i = 1 + part; i < argc; ++i) {
        if (!golden_mode(argv[i])) {
            printf("golden %-8s not known here\n", argv[i]);
            continue;
        }
        ok &= golden_report(argv[i]);
    }
    return ok ? 0 : 1;
}

#endif
