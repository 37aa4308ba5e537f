/* gen_golden: writes golden_overlap.h: the hash of all answers to the golden inputs and the first few inputs
 * with their answers. The answers are those of the exact judges of verify_exact.h and companions_exact.h, and
 * their two methods must agree; tribox.h has no say. Needs GMP. `make golden` runs it.
 */
#include "companions_exact.h"
#include "verify_solid.h"

#include <stdio.h>

#define GOLDEN_FN static
#ifdef GOLDEN_PRINT
#define GOLDEN_SAY(what, index, word)                                                                       \
    printf("%s %lu %lx%08lx\n", what, (unsigned long)(index), (unsigned long)((uint64_t)(word) >> 32), \
           (unsigned long)((word) & 0xffffffffu))
#endif
#include "golden_cases.h"

#define TABLE 300

static exact_judge judge;
static companion_work work;
static int disagreements;

static unsigned decide(const question *ask)
{
    unsigned rules = exact_axes(&judge, ask);
    if (exact_clip(&judge, ask) != rules) {
        ++disagreements;
    }
    return rules;
}

static void fill_question(question *ask, int kind, const uint64_t *v, const uint64_t *a, const uint64_t *b,
                          int f64)
{
    int i;
    memset(ask, 0, sizeof *ask);
    ask->kind = kind;
    for (i = 0; i < 9; ++i) {
        ask->x[i] = companion_number(v[i], f64);
    }
    for (i = 0; i < 3; ++i) {
        ask->x[9 + i] = companion_number(a[i], f64);
        ask->x[12 + i] = companion_number(b[i], f64);
    }
}

static uint32_t golden_ask_single(const golden_single *c)
{
    question ask;
    uint32_t box, tri, word;
    fill_question(&ask, ASK_BOX, c->v, c->lo, c->hi, c->f64);
    box = decide(&ask) & 7u;
    fill_question(&ask, ASK_TRI, c->v, c->lo, c->size, c->f64);
    tri = decide(&ask);
    word = box | (box & 1u) << 3 | tri << 4;
    return c->f64 ? word : word | word << 8 | tri << 16;
}

typedef struct voxels {
    unsigned char rules[GOLDEN_EDGE][GOLDEN_EDGE][GOLDEN_EDGE]; /* z y x */
} voxels;

static void ask_voxels(const golden_grid *g, int triangle, voxels *out)
{
    question ask;
    int x, y, z, i;
    fill_question(&ask, ASK_GRID, g->v + 9 * triangle, g->origin, g->size, g->f64);
    for (i = 0; i < 3; ++i) {
        ask.x[9 + i] = companion_number(g->origin[i], 1);
        ask.x[12 + i] = companion_number(g->size[i], 1);
    }
    for (z = 0; z < GOLDEN_EDGE; ++z) {
        for (y = 0; y < GOLDEN_EDGE; ++y) {
            for (x = 0; x < GOLDEN_EDGE; ++x) {
                ask.index[0] = g->lo[0] + x;
                ask.index[1] = g->lo[1] + y;
                ask.index[2] = g->lo[2] + z;
                for (i = 0; i < 3; ++i) {
                    ask.last[i] = ask.index[i];
                }
                out->rules[z][y][x] = (unsigned char)decide(&ask);
            }
        }
    }
}

/* the voxels of the grid last asked for: all rules come from one evaluation */
static const voxels *voxels_of(const golden_grid *g, int triangle)
{
    static golden_grid last;
    static voxels out[2];
    if (memcmp(&last, g, sizeof last) != 0) {
        last = *g;
        ask_voxels(g, 0, &out[0]);
        if (!g->f64) {
            ask_voxels(g, 1, &out[1]);
        }
    }
    return &out[triangle];
}

static uint64_t golden_ask_grid(const golden_grid *g, unsigned flags)
{
    const voxels *set = voxels_of(g, 0);
    const unsigned rule = rule_of(flags);
    uint64_t hash = GOLDEN_BASIS;
    uint64_t count = 0;
    int x, y, z;
    for (z = 0; z < GOLDEN_EDGE; ++z) {
        for (y = 0; y < GOLDEN_EDGE; ++y) {
            for (x = 0; x < GOLDEN_EDGE; ++x) {
                int from = x;
                while (x < GOLDEN_EDGE && (set->rules[z][y][x] >> rule & 1) != 0) {
                    ++x;
                }
                if (x > from) {
                    hash =
                        golden_mix_span(hash, g->lo[0] + from, g->lo[0] + x - 1, g->lo[1] + y, g->lo[2] + z);
                    count += (uint64_t)(x - from);
                }
            }
        }
    }
    return golden_mix(hash, count);
}

static uint64_t golden_ask_fill(const golden_grid *g, unsigned flags)
{
    const voxels *a = voxels_of(g, 0);
    const voxels *b = voxels_of(g, 1);
    const unsigned rule = rule_of(flags);
    uint64_t hash = GOLDEN_BASIS;
    int x, y, z;
    for (x = 0; x < 3; ++x) { /* an invalid grid needs no words */
        const double size = companion_number(g->size[x], 1);
        if (!is_finite(companion_number(g->origin[x], 1)) || !is_finite(size) || sign_of_double(size) <= 0) {
            return 0;
        }
    }
    for (z = 0; z < GOLDEN_EDGE; ++z) {
        for (y = 0; y < GOLDEN_EDGE; ++y) {
            uint64_t word = 0;
            for (x = 0; x < GOLDEN_EDGE; ++x) {
                word |= (uint64_t)((a->rules[z][y][x] | b->rules[z][y][x]) >> rule & 1) << x;
            }
            hash = golden_mix(hash, word);
        }
    }
    return hash;
}

static uint64_t golden_ask_solid(const golden_grid *g)
{
    static const double no_step[3] = {0, 0, 0};
    static const int64_t no_half[3] = {0, 0, 0};
    static crossing_judge j;
    static int ready;
    double v[18], origin[3], size[3], point[3];
    uint64_t hash = GOLDEN_BASIS;
    int valid = 1, finite = 1, inside = 0, t, k, y, z;
    if (!ready) {
        crossing_init(&j);
        ready = 1;
    }
    for (k = 0; k < (g->f64 ? 9 : 18); ++k) {
        v[k] = companion_number(g->v[k], g->f64);
    }
    for (k = 0; k < 3; ++k) {
        origin[k] = companion_number(g->origin[k], 1);
        size[k] = companion_number(g->size[k], 1);
        point[k] = companion_number(g->point[k], 1);
        valid &= is_finite(origin[k]) && is_finite(size[k]) && sign_of_double(size[k]) > 0;
        finite &= is_finite(point[k]);
    }
    for (z = 0; z < GOLDEN_EDGE; ++z) {
        for (y = 0; y < GOLDEN_EDGE; ++y) {
            uint64_t word = 0;
            for (t = 0; t < (g->f64 ? 1 : 2) && valid; ++t) {
                int64_t half[3];
                half[1] = 2 * (int64_t)(g->lo[1] + y) + 1;
                half[2] = 2 * (int64_t)(g->lo[2] + z) + 1;
                word ^= ((uint64_t)1 << GOLDEN_EDGE) -
                        ((uint64_t)1 << crossing_first(&j, v + 9 * t, origin, size, half, g->lo[0], GOLDEN_EDGE));
            }
            hash = golden_mix(hash, word);
        }
    }
    for (t = 0; t < (g->f64 ? 1 : 2) && finite; ++t) {
        int crosses = crossing_crosses(&j, v + 9 * t, point, no_step, no_half);
        inside ^= crosses | (t == 0 && !g->f64 ? crosses << 1 : 0);
    }
    return golden_mix(hash, (uint64_t)inside);
}

static uint64_t golden_ask_locate(const golden_grid *g)
{
    int at[3];
    mpz_t index;
    int k, inside = 1;
    for (k = 0; k < 3; ++k) {
        const double size = companion_number(g->size[k], 1);
        if (!is_finite(companion_number(g->point[k], 1)) || !is_finite(companion_number(g->origin[k], 1)) ||
            !is_finite(size) || sign_of_double(size) <= 0) {
            return GOLDEN_BASIS;
        }
    }
    mpz_init(index);
    for (k = 0; k < 3; ++k) {
        inside &= exact_index(&judge, companion_number(g->point[k], 1), companion_number(g->origin[k], 1),
                              companion_number(g->size[k], 1), index);
        at[k] = mpz_fits_sint_p(index) ? (int)mpz_get_si(index) : INT32_MIN;
        inside &= at[k] >= g->lo[k] && at[k] < g->lo[k] + GOLDEN_EDGE;
    }
    mpz_clear(index);
    return inside ? golden_mix_span(GOLDEN_BASIS, at[0], at[1], at[2], 0) : GOLDEN_BASIS;
}

/* a mesh can be framed if its finite triangles, taken together, are more than a point */
static uint64_t golden_ask_fit(const golden_grid *g)
{
    const uint64_t *first = NULL;
    int i, k;
    for (i = 0; i < 2; ++i) {
        int finite = 1;
        for (k = 0; k < 9; ++k) {
            finite &= (g->v[9 * i + k] >> 23 & 0xff) != 0xff;
        }
        for (k = 0; k < 9 && finite; ++k) {
            if (first == NULL) {
                first = g->v + 9 * i;
            }
            if (g->v[9 * i + k] != first[k % 3] && (g->v[9 * i + k] | first[k % 3]) << 33 != 0) {
                return 3; /* not the same number, nor both zero */
            }
        }
    }
    return 0;
}

static int unsafe;

/* Would all answers within their bounds be as rough as this one? 2^-22 of an axis, 2^-40 of a gap, both with more. */
static void rough_is_safe(const companion_answer *a)
{
    companion_answer less = *a;
    companion_answer more = *a;
    int k, safe = 1;
    for (k = 0; k < 3; ++k) {
        const int fixed = golden_fixed(a->axis[k]);
        safe &= golden_step(fixed - 3) == golden_step(fixed + 3);
        less.axis[k] = more.axis[k] = 0;
    }
    less.s -= 16384;
    more.s += 16384;
    safe &= a->s << 1 == 0 || golden_rough(&less, 1) == golden_rough(&more, 1);
    unsafe += !safe;
}

static void golden_ask_companion(const companion *c, companion_answer *out)
{
    companion_judge(&work, c, WRONG_NOTHING, out);
    rough_is_safe(out);
    if (!companion_confirm(&work, c, out)) {
        ++disagreements;
    }
}

static void print_words(const uint64_t *words, int n)
{
    int i;
    for (i = 0; i < n; ++i) {
        printf("%s0x%llxu%s", i % 5 == 0 ? "\n     " : " ", (unsigned long long)words[i],
               i + 1 < n ? "," : "");
    }
}

int main(void)
{
    uint64_t hash = GOLDEN_BASIS;
    uint64_t eighth = GOLDEN_BASIS;
    uint64_t few = GOLDEN_BASIS;
    uint32_t i;
    exact_init(&judge);
    companion_init(&work);
    for (i = 0; i < GOLDEN_CHUNKS; ++i) {
        hash = golden_mix(hash, golden_chunk(i));
        eighth = i < GOLDEN_EIGHTH ? hash : eighth;
        few = i < GOLDEN_FEW ? hash : few;
    }
    if (unsafe != 0) {
        fprintf(stderr, "gen_golden: %d axes or gaps are too near the border of two steps\n", unsafe);
        return 1;
    }
    if (disagreements != 0) {
        fprintf(stderr, "gen_golden: the judges disagree on %d answers\n", disagreements);
        return 1;
    }
#ifndef GOLDEN_PRINT
    printf("/* Written by gen_golden.c (`make golden`): do not edit. The first golden inputs as bit\n"
           " * patterns (v0 v1 v2, box_min or p, box_max, size), the exact answers to them, and the hash"
           " of all\n"
           " * answers, to %d triangles and boxes, %d grids and %d questions to companions.\n"
           " * golden_answers.h says what the bits of an answer mean. */\n"
           "#ifndef GOLDEN_OVERLAP_H\n#define GOLDEN_OVERLAP_H\n\n",
           GOLDEN_CHUNKS * (GOLDEN_SINGLES + GOLDEN_HARD), 2 * GOLDEN_CHUNKS,
           GOLDEN_CHUNKS * (GOLDEN_COMPANIONS + GOLDEN_HARD));
    printf("#define GOLDEN_HASH (((uint64_t)0x%08lxu << 32) | 0x%08lxu)\n", (unsigned long)(hash >> 32),
           (unsigned long)(hash & 0xffffffffu));
    printf("#define GOLDEN_HASH_EIGHTH (((uint64_t)0x%08lxu << 32) | 0x%08lxu)\n", (unsigned long)(eighth >> 32),
           (unsigned long)(eighth & 0xffffffffu));
    printf("#define GOLDEN_HASH_FEW (((uint64_t)0x%08lxu << 32) | 0x%08lxu)\n", (unsigned long)(few >> 32),
           (unsigned long)(few & 0xffffffffu));
    printf("#define GOLDEN_TABLE %d\n\n", TABLE);
    printf("static const struct {\n    int f64;\n    uint32_t answer;\n    uint64_t bits[18];\n"
           "} golden_table[GOLDEN_TABLE] = {\n");
    for (i = 0; i < TABLE; ++i) {
        golden_single c;
        uint64_t words[18];
        golden_make_single(i, &c);
        memcpy(words, c.v, sizeof c.v);
        memcpy(words + 9, c.lo, sizeof c.lo);
        memcpy(words + 12, c.hi, sizeof c.hi);
        memcpy(words + 15, c.size, sizeof c.size);
        printf("    {%d, 0x%xu, {", c.f64, (unsigned)golden_ask_single(&c));
        print_words(words, 18);
        printf("}},\n");
    }
    printf("};\n\n#endif\n");
#endif
    return 0;
}
