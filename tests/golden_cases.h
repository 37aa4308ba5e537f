/* The golden inputs: deterministic, made as bit patterns by integer arithmetic alone, so that every compiler,
 * machine and mode makes the same ones; and one hash over all answers to them.
 *
 * Whoever includes this says first who answers: golden.c and golden.cu let tribox.h answer, gen_golden.c the
 * exact judge of verify_exact.h. They define GOLDEN_FN (the linkage of functions) and, after the include, the
 * functions
 *
 *   golden_ask_single, golden_ask_grid, golden_ask_fill, golden_ask_solid, golden_ask_locate, golden_ask_fit,
 *   golden_ask_companion
 *
 * C99 that is also C++98 and CUDA; calls no library. No expression draws twice: the order would be the
 * compiler's.
 */
#ifndef GOLDEN_CASES_H
#define GOLDEN_CASES_H

#include "companions.h"

#define GOLDEN_CHUNKS 2048 /* a chunk is hashed alone, so that chunks may run in any order */
#define GOLDEN_EIGHTH 256  /* of them, with a hash of their own, where time is short */
#define GOLDEN_FEW 32      /* and where it is shorter: emulators */
#define GOLDEN_SINGLES 32  /* triangles and boxes in a chunk; beside them one grid and one point */
#define GOLDEN_COMPANIONS 38 /* questions to companions in a chunk */
#define GOLDEN_EDGE 8      /* the region of a golden grid is 8 x 8 x 8 */
#define GOLDEN_HARD 16     /* of either in a chunk: with the numbers that compilers and modes mistake */

/* Told every answer as it is hashed: golden.c and gen_golden.c print them, if compiled with GOLDEN_PRINT. */
#ifndef GOLDEN_SAY
#define GOLDEN_SAY(what, index, word) ((void)0)
#endif

/* A triangle and a box; bit patterns, those of floats in the low half of a word. */
typedef struct golden_single {
    int f64;
    uint64_t v[9];
    uint64_t lo[3]; /* box_min, and p */
    uint64_t hi[3];
    uint64_t size[3];
} golden_single;

typedef struct golden_grid {
    int f64;        /* the triangle's format; the grid's numbers are doubles */
    uint64_t v[18]; /* two triangles; the spans are those of the first, the fill (floats only) that of both */
    uint64_t origin[3];
    uint64_t size[3];
    uint64_t point[3];
    int lo[3];
} golden_grid;

/* The answers, as words to be hashed. */
GOLDEN_FN uint32_t golden_ask_single(const golden_single *c);
GOLDEN_FN uint64_t golden_ask_grid(const golden_grid *g, unsigned flags);
GOLDEN_FN uint64_t golden_ask_fill(const golden_grid *g, unsigned flags);
GOLDEN_FN uint64_t golden_ask_solid(const golden_grid *g);
GOLDEN_FN uint64_t golden_ask_locate(const golden_grid *g);
GOLDEN_FN uint64_t golden_ask_fit(const golden_grid *g);
GOLDEN_FN void golden_ask_companion(const companion *c, companion_answer *out);

/* ---- hash: FNV-1a, 64 bits -------------------------------------------------------------------- */

#define GOLDEN_BASIS (((uint64_t)0xcbf29ce4u << 32) | 0x84222325u)

GOLDEN_FN uint64_t golden_mix(uint64_t hash, uint64_t word)
{
    const uint64_t prime = ((uint64_t)0x100u << 32) | 0x1b3u;
    int i;
    for (i = 0; i < 8; ++i) {
        hash = (hash ^ (word & 0xffu)) * prime;
        word >>= 8;
    }
    return hash;
}

/* one span, or any four ints */
GOLDEN_FN uint64_t golden_mix_span(uint64_t hash, int x0, int x1, int y, int z)
{
    hash = golden_mix(hash, ((uint64_t)(uint32_t)x0 << 32) | (uint32_t)x1);
    return golden_mix(hash, ((uint64_t)(uint32_t)y << 32) | (uint32_t)z);
}

/* ---- dice ------------------------------------------------------------------------------------- */

GOLDEN_FN uint64_t golden_next(uint64_t *state)
{
    uint64_t z = *state += ((uint64_t)0x9e3779b9u << 32) | 0x7f4a7c15u;
    z = (z ^ (z >> 30)) * (((uint64_t)0xbf58476du << 32) | 0x1ce4e5b9u);
    z = (z ^ (z >> 27)) * (((uint64_t)0x94d049bbu << 32) | 0x133111ebu);
    return z ^ (z >> 31);
}

GOLDEN_FN int golden_between(uint64_t *state, int lo, int hi)
{
    return lo + (int)(golden_next(state) % (uint64_t)(hi - lo + 1));
}

/* ---- numbers ---------------------------------------------------------------------------------- */

/* The bits of m * 2^e, rounded to nearest even, subnormals included; what is too large becomes the largest
 * number. */
GOLDEN_FN uint64_t golden_encode(int64_t m, int e, int f64)
{
    const int digits = f64 ? 53 : 24;
    const int least = f64 ? -1074 : -149;
    const int most = f64 ? 971 : 104; /* exponent of the last bit of the largest number */
    const uint64_t sign = m < 0 ? (uint64_t)1 << (f64 ? 63 : 31) : 0;
    const uint64_t largest =
        (uint64_t)(most - least + 1) << (digits - 1) | (((uint64_t)1 << (digits - 1)) - 1);
    uint64_t a = m < 0 ? 0 - (uint64_t)m : (uint64_t)m;
    int drop = 0;
    if (a == 0) {
        return 0;
    }
    while (a >> (digits - 1) == 0 && e > least) {
        a <<= 1;
        e -= 1;
    }
    while (a >> drop >> digits != 0) {
        drop += 1;
    }
    if (least - e > drop) {
        drop = least - e;
    }
    if (drop > 63) {
        return sign;
    }
    if (drop > 0) {
        const uint64_t half = (uint64_t)1 << (drop - 1);
        const uint64_t rest = a & (2 * half - 1);
        a >>= drop;
        a += rest > half || (rest == half && (a & 1) != 0) ? 1 : 0;
        e += drop;
    }
    if (e > most || (e == most && a >> digits != 0)) {
        return sign | largest;
    }
    if (a >> (digits - 1) == 0) { /* subnormal: e is the least exponent */
        return sign | a;
    }
    return sign | (((uint64_t)(e - least) << (digits - 1)) + a);
}

/* a few places up or down; never past the largest number, and not across zero */
GOLDEN_FN uint64_t golden_nudge(uint64_t bits, int by, int f64)
{
    const uint64_t sign = (uint64_t)1 << (f64 ? 63 : 31);
    const uint64_t infinity = f64 ? (uint64_t)0x7ff << 52 : (uint64_t)0xff << 23;
    const uint64_t magnitude = bits & (sign - 1);
    if (magnitude < 4 || magnitude >= infinity - 4) {
        return bits;
    }
    return bits + (uint64_t)(int64_t)by;
}

GOLDEN_FN uint64_t golden_special(uint64_t *state, int f64)
{
    const int shift = f64 ? 52 : 23;
    const uint64_t sign = (uint64_t)golden_between(state, 0, 1) << (f64 ? 63 : 31);
    const uint64_t infinity = (uint64_t)(f64 ? 0x7ff : 0xff) << shift;
    switch (golden_between(state, 0, 7)) {
    case 0:
        return sign;
    case 1:
        return sign | infinity;
    case 2:
        return sign | infinity | (uint64_t)1 << (shift - 1); /* quiet NaN */
    case 3:
        return sign | (infinity - 1);
    case 4:
        return sign | 1;
    case 5:
        return sign | (uint64_t)1 << shift; /* least normal */
    case 6:
        return sign | (((uint64_t)1 << shift) - 1);
    default:
        return sign | (uint64_t)(f64 ? 0x3ff : 0x7f) << shift;
    }
}

/* ---- shapes, in integers ---------------------------------------------------------------------- */

GOLDEN_FN int golden_sign(int64_t x)
{
    return (x > 0) - (x < 0);
}

/* corners up to `reach`; some triangles aligned, some degenerate */
GOLDEN_FN void golden_triangle(uint64_t *state, int reach, int64_t v[9])
{
    int i;
    int a = golden_between(state, 0, 2);
    int kind = golden_between(state, 0, 9);
    for (i = 0; i < 9; ++i) {
        v[i] = 8 * (int64_t)golden_between(state, -reach, reach);
    }
    if (kind == 0) { /* in an axis plane */
        v[3 + a] = v[a];
        v[6 + a] = v[a];
    } else if (kind == 1) { /* an edge along an axis */
        v[3 + (a + 1) % 3] = v[(a + 1) % 3];
        v[3 + (a + 2) % 3] = v[(a + 2) % 3];
    } else if (kind == 2) { /* a segment with a third corner on it */
        int w = golden_between(state, 0, 4);
        for (i = 0; i < 3; ++i) {
            v[6 + i] = v[i] + (v[3 + i] - v[i]) / 4 * w;
        }
    } else if (kind == 3) { /* a segment with two equal corners, or a point */
        int point = golden_between(state, 0, 2) == 0;
        for (i = 0; i < 3; ++i) {
            v[3 * a + i] = v[3 * ((a + 1) % 3) + i];
            if (point) {
                v[3 * ((a + 2) % 3) + i] = v[3 * ((a + 1) % 3) + i];
            }
        }
    } else if (kind == 4) { /* a sliver: one unit off a line */
        for (i = 0; i < 3; ++i) {
            v[6 + i] = v[i] + (v[3 + i] - v[i]) / 2 + golden_between(state, -1, 1);
        }
    }
}

/* a point of the triangle with weights in eighths, exact because corners are multiples of 8,
 * slivers' nearly */
GOLDEN_FN void golden_point(uint64_t *state, const int64_t v[9], int64_t point[3])
{
    int k;
    int a = golden_between(state, 0, 8);
    int b = golden_between(state, 0, 8 - a);
    for (k = 0; k < 3; ++k) {
        point[k] = (v[k] * a + v[3 + k] * b + v[6 + k] * (8 - a - b)) / 8;
    }
}

/* a box with a corner, an edge or a face at a point of the triangle, outside it as seen along the contact's
 * axis */
GOLDEN_FN void golden_box(uint64_t *state, const int64_t v[9], int reach, int64_t lo[3], int64_t hi[3])
{
    int64_t point[3];
    int s[3];
    int k;
    int kind = golden_between(state, 0, 3);
    int side = 2 * golden_between(state, 0, 1) - 1;
    golden_point(state, v, point);
    for (k = 0; k < 3; ++k) {
        int b = (k + 1) % 3;
        int c = (k + 2) % 3;
        int64_t n = (v[3 + b] - v[b]) * (v[6 + c] - v[c]) - (v[3 + c] - v[c]) * (v[6 + b] - v[b]);
        s[k] = kind == 0 ? side * golden_sign(n) : golden_between(state, -1, 1);
    }
    if (kind == 1) { /* the box's edge along axis a against edge i */
        int a = golden_between(state, 0, 2);
        int i = golden_between(state, 0, 2);
        int j = (i + 1) % 3;
        int b = (a + 1) % 3;
        int c = (a + 2) % 3;
        int w = golden_between(state, 0, 8);
        for (k = 0; k < 3; ++k) {
            point[k] = (v[3 * i + k] * w + v[3 * j + k] * (8 - w)) / 8;
        }
        s[a] = 0;
        s[b] = side * golden_sign(v[3 * j + c] - v[3 * i + c]);
        s[c] = side * golden_sign(v[3 * i + b] - v[3 * j + b]);
    }
    for (k = 0; k < 3; ++k) {
        int64_t down = golden_between(state, 0, 8 * reach);
        int64_t up = golden_between(state, 0, 8 * reach);
        lo[k] = point[k] - (s[k] > 0 ? 0 : down);
        hi[k] = point[k] + (s[k] < 0 ? 0 : up);
    }
}

/* ---- questions -------------------------------------------------------------------------------- */

GOLDEN_FN uint64_t golden_any(uint64_t *state, int f64)
{
    uint64_t u = golden_next(state);
    return f64 ? u : u >> 32;
}

/* in [-1, 1] */
GOLDEN_FN uint64_t golden_common(uint64_t *state, int f64)
{
    return golden_encode((int64_t)(golden_next(state) >> 10) - ((int64_t)1 << 53), -53, f64);
}

GOLDEN_FN uint64_t golden_loose(uint64_t *state, int kind, int f64)
{
    return kind == 0 ? golden_any(state, f64) : golden_common(state, f64);
}

GOLDEN_FN void golden_make_loose(uint64_t *state, int kind, golden_single *c)
{
    int i;
    for (i = 0; i < 9; ++i) {
        c->v[i] = golden_loose(state, kind, c->f64);
    }
    for (i = 0; i < 3; ++i) {
        c->lo[i] = golden_loose(state, kind, c->f64);
        c->hi[i] = golden_loose(state, kind, c->f64);
        c->size[i] = golden_loose(state, kind, c->f64);
        if (kind != 0) { /* a box around the origin */
            const uint64_t sign = (uint64_t)1 << (c->f64 ? 63 : 31);
            c->lo[i] |= sign;
            c->hi[i] &= ~sign;
            c->size[i] &= ~sign;
        }
    }
}

GOLDEN_FN void golden_make_single(uint64_t index, golden_single *c)
{
    uint64_t state = index * 977 + 1;
    uint64_t *numbers[4];
    int64_t v[9], lo[3], hi[3];
    int i, e = 0, decimal, reach;
    int kind = golden_between(&state, 0, 15);
    int nudges = golden_between(&state, -3, 3);
    c->f64 = (int)(index & 1);
    numbers[0] = c->v;
    numbers[1] = c->lo;
    numbers[2] = c->hi;
    numbers[3] = c->size;
    if (kind < 2) {
        golden_make_loose(&state, kind, c);
        return;
    }
    reach = kind < 6 ? golden_between(&state, 1, 8) : 1 << golden_between(&state, 3, 17);
    golden_triangle(&state, reach, v);
    if (kind == 6) {
        reach = 1 << golden_between(&state, 0, 22); /* box and triangle of very different sizes */
    }
    golden_box(&state, v, reach, lo, hi);
    decimal = kind == 2 || kind == 3;
    if (decimal) { /* multiples of the number nearest to 0.1, rounded */
        int64_t tenth = c->f64 ? (int64_t)7205759403792794 : 13421773;
        for (i = 0; i < 9; ++i) {
            v[i] = v[i] / 8 * tenth;
        }
        for (i = 0; i < 3; ++i) {
            lo[i] = lo[i] / 8 * tenth;
            hi[i] = hi[i] / 8 * tenth;
        }
        e = c->f64 ? -56 : -27;
    } else if (kind == 7) { /* the least numbers: subnormals */
        e = (c->f64 ? -1074 : -149) + golden_between(&state, -8, 30);
    } else if (kind == 8) { /* the largest */
        e = (c->f64 ? 1024 : 128) - golden_between(&state, 20, 30);
    } else if (kind > 10) {
        e = golden_between(&state, -40, 20);
    }
    for (i = 0; i < 9; ++i) {
        c->v[i] = golden_encode(v[i], e, c->f64);
    }
    for (i = 0; i < 3; ++i) {
        c->lo[i] = golden_encode(lo[i], e, c->f64);
        c->hi[i] = golden_encode(hi[i], e, c->f64);
        c->size[i] = golden_encode(hi[i] - lo[i], e, c->f64);
    }
    for (; nudges > 0; --nudges) {
        uint64_t *group = numbers[golden_between(&state, 0, 3)];
        i = golden_between(&state, 0, group == c->v ? 8 : 2);
        group[i] = golden_nudge(group[i], golden_between(&state, -2, 2), c->f64);
    }
    if (kind == 9) {
        uint64_t *group = numbers[golden_between(&state, 0, 3)];
        i = golden_between(&state, 0, 2);
        group[i] = golden_special(&state, c->f64);
    }
}

/* A grid of unit, decimal or odd steps around some index, and triangles with corners on or near its points */
GOLDEN_FN void golden_make_grid(uint64_t index, golden_grid *g)
{
    uint64_t state = index * 1009 + 5;
    int kind = golden_between(&state, 0, 7);
    int e = kind == 0 ? 0 : kind == 1 ? -56 : golden_between(&state, -60, 10);
    int k, i, base[3];
    int64_t step[3];
    g->f64 = (int)(index & 1);
    for (k = 0; k < 3; ++k) {
        step[k] = kind == 0 ? 1 : kind == 1 ? (int64_t)7205759403792794 : golden_between(&state, 1, 1 << 20);
        base[k] = kind == 1 ? golden_between(&state, -4, 4) : golden_between(&state, -1000000, 1000000);
        if (kind > 5) {
            base[k] = golden_between(&state, -8, 0);
        }
        g->origin[k] = golden_encode(-step[k] * base[k], e, 1);
        g->size[k] = golden_encode(step[k], e, 1);
        g->lo[k] = base[k] - golden_between(&state, 0, 3);
    }
    /* corners within the region or around it, in whole, half, quarter or eighth steps */
    for (i = 0; i < 18; ++i) {
        int fraction = golden_between(&state, 0, 3);
        int64_t eighths = (int64_t)golden_between(&state, -24, 72) & ~(((int64_t)1 << fraction) - 1);
        int fits = kind != 1; /* a decimal step leaves no room for eighths */
        int64_t at = fits ? step[i % 3] * eighths : step[i % 3] * (eighths / 8);
        g->v[i] = golden_encode(at, fits ? e - 3 : e, g->f64);
        if (golden_between(&state, 0, 15) == 0) {
            g->v[i] = golden_nudge(g->v[i], golden_between(&state, -2, 2), g->f64);
        }
    }
    for (k = 0; k < 3; ++k) {
        int64_t at = step[k] * golden_between(&state, -3, 8);
        g->point[k] = golden_nudge(golden_encode(at, e, 1), golden_between(&state, -1, 1), 1);
    }
}

/* ---- questions to companions ------------------------------------------------------------------ */

/* a small direction: along axes and diagonals, or any */
GOLDEN_FN void golden_direction(uint64_t *state, int reach, int64_t w[3])
{
    int k;
    int small = golden_between(state, 0, 1);
    for (k = 0; k < 3; ++k) {
        w[k] = small ? 8 * golden_between(state, -2, 2) : golden_between(state, -8 * reach, 8 * reach);
    }
}

/* a point of the box: on its faces or edges, at its corners, inside */
GOLDEN_FN void golden_box_point(uint64_t *state, const int64_t lo[3], const int64_t hi[3], int64_t point[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        int w = golden_between(state, -2, 6);
        w = w < 0 ? 0 : w > 4 ? 4 : w;
        point[k] = lo[k] + (hi[k] - lo[k]) / 4 * w;
        if (w == 4) {
            point[k] = hi[k];
        }
    }
}

/* an integer vector whose length, which is returned, is an integer, too */
GOLDEN_FN int golden_triple(uint64_t *state, int64_t w[3])
{
    const int which = golden_between(state, 0, 5);
    const int turn = golden_between(state, 0, 2);
    int k;
    int t[4];
    t[0] = which == 0 ? 1 : which == 1 ? 3 : which == 2 ? 1 : which == 3 ? 2 : which == 4 ? 4 : 5;
    t[1] = which == 0 ? 0 : which == 1 ? 4 : which == 2 ? 2 : which == 3 ? 3 : which == 4 ? 4 : 12;
    t[2] = which < 2 || which == 5 ? 0 : which == 2 ? 2 : which == 3 ? 6 : 7;
    t[3] = which == 0 ? 1 : which == 1 ? 5 : which == 2 ? 3 : which == 3 ? 7 : which == 4 ? 9 : 13;
    for (k = 0; k < 3; ++k) {
        w[k] = golden_between(state, 0, 1) ? t[(k + turn) % 3] : -t[(k + turn) % 3];
    }
    return t[3];
}

/* Questions of contact: spheres that touch what they are asked about, or nearly. */
GOLDEN_FN void golden_add_contact(uint64_t *state, int which, int reach, int at, int64_t x[23])
{
    int64_t *w = x + COMPANION_W;
    int64_t *o = x + COMPANION_O;
    int64_t out[3];
    int64_t point[3];
    const int size = golden_between(state, 0, 4 * reach);
    const int length = golden_triple(state, out);
    const int more = golden_between(state, -1, 6);
    int k;
    for (k = 0; k < 3; ++k) {
        const int side = golden_between(state, 0, 2);
        const int across = golden_between(state, 0, 8 * reach);
        if (which == COMPANION_SWEEP_BOX) { /* box b beside, or across, or on a face */
            x[k] = side == 0 ? x[COMPANION_HI + k] : side == 1 ? x[COMPANION_LO + k] - across : x[COMPANION_LO + k];
            x[3 + k] = x[k] + across;
        }
        if (which <= COMPANION_GAP) {
            x[COMPANION_LO + k] -= at * w[k];
            x[COMPANION_HI + k] -= at * w[k];
        }
    }
    if (which == COMPANION_GAP && more > 4) { /* about a corner: directions tie */
        for (k = 0; k < 3; ++k) {
            const int half = 8 * golden_between(state, 0, reach);
            x[COMPANION_LO + k] = x[k] - half;
            x[COMPANION_HI + k] = x[k] + half;
        }
    }
    if (which <= COMPANION_GAP) {
        return;
    }
    golden_point(state, x, point);
    if (which == COMPANION_SPHERE_BOX) {
        golden_box_point(state, x + COMPANION_LO, x + COMPANION_HI, point);
    }
    for (k = 0; k < 3; ++k) {
        o[k] = point[k] + out[k] * size;
    }
    x[COMPANION_T0] = (int64_t)length * size + (more < 0 ? more : 0);
    x[COMPANION_T1] = 8 * at + (more > 2 ? 8 * more : more);
    if (which == COMPANION_SPHERE_SPHERE) {
        for (k = 0; k < 3; ++k) {
            w[k] = point[k];
        }
        x[COMPANION_T1] = golden_between(state, 0, 1) ? x[COMPANION_T0] / 3 : 0;
        x[COMPANION_T0] -= x[COMPANION_T1];
    } else if (which == COMPANION_PLANE_SPHERE) {
        x[COMPANION_T0] = size;
        x[COMPANION_T1] = (more & 1) != 0 ? (int64_t)length * size : -(int64_t)length * size;
        for (k = 0; k < 3; ++k) {
            w[k] = out[k];
            x[COMPANION_T1] -= out[k] * o[k];
        }
    } else if (which == COMPANION_RAY_SPHERE) {
        golden_direction(state, reach, x + COMPANION_LO);
        for (k = 0; k < 3; ++k) { /* through that point of the sphere, or along the sphere there */
            if (more == 6) {
                x[COMPANION_LO + k] = k == 0 ? 0 : k == 1 ? 8 * out[2] : -8 * out[1];
            }
            w[k] = point[k] - at * x[COMPANION_LO + k];
        }
        x[COMPANION_HI] = golden_between(state, 0, 2) ? 0 : 8 * at - golden_between(state, 0, 8);
    }
}

/* Is the number a time, in eighths, or of a plane's normal, in units? All others are lengths. */
GOLDEN_FN int golden_is_time(int which, int i)
{
    return which > COMPANION_QUERY ? which == COMPANION_RAY_SPHERE && (i == COMPANION_HI || i == COMPANION_T1)
                                   : i >= COMPANION_T0 && which != COMPANION_PLANE_BOX;
}

GOLDEN_FN int golden_is_normal(int which, int i)
{
    return (which == COMPANION_PLANE_BOX || which == COMPANION_PLANE_SPHERE) && i >= COMPANION_W &&
           (which == COMPANION_PLANE_BOX ? i < COMPANION_T0 : i < COMPANION_O);
}

/* What the function adds to triangle and box: x[15..20] at the scale of the others; t in eighths. */
GOLDEN_FN void golden_add_numbers(uint64_t *state, int which, int reach, int64_t x[23])
{
    int64_t *lo = x + COMPANION_LO;
    int64_t *hi = x + COMPANION_HI;
    int64_t *w = x + COMPANION_W;
    int64_t *o = x + COMPANION_O;
    int64_t point[3];
    int64_t sum = 0;
    int k;
    int at = golden_between(state, -2, 4);
    golden_direction(state, reach, w);
    if (which == COMPANION_RAY_TRIANGLE || which == COMPANION_CLOSEST) {
        golden_point(state, x, point);
    } else {
        golden_box_point(state, lo, hi, point);
    }
    for (k = 0; k < 3; ++k) {
        const int64_t size = hi[k] - lo[k];
        const int more = golden_between(state, 0, 8 * reach);
        o[k] = point[k] - at * w[k];
        if (which == COMPANION_BOX_BOX) {
            w[k] = golden_between(state, 0, 1) ? hi[k] : lo[k] - more;
            o[k] = golden_between(state, 0, 1) ? w[k] + more : w[k] > lo[k] ? w[k] : lo[k];
        } else if (which == COMPANION_SEGMENT_BOX) {
            w[k] = golden_between(state, 0, 3) ? point[k] + w[k] : point[k];
        } else if (which == COMPANION_SWEEP) {
            lo[k] -= at * w[k];
            hi[k] -= at * w[k];
        } else if (which == COMPANION_PLANE_BOX) {
            w[k] = golden_between(state, -3, 3);
            sum -= w[k] * point[k];
        } else if (which == COMPANION_OCTANTS) {
            lo[k] -= golden_between(state, 0, 1) ? size : 0;
            hi[k] = size;
            w[k] = more;
        }
    }
    x[COMPANION_T0] = golden_between(state, 0, 2) ? 0 : 8 * at - golden_between(state, 0, 8);
    x[COMPANION_T1] = 8 * at + (golden_between(state, 0, 1) ? golden_between(state, -2, 16) : 0);
    if (which == COMPANION_PLANE_BOX) {
        x[COMPANION_T0] = sum;
    }
    if (which > COMPANION_QUERY) {
        golden_add_contact(state, which, reach, at, x);
    }
}

GOLDEN_FN void golden_make_hard_grid(uint64_t index, golden_grid *g);

/* A segment through a golden grid, hard or not: from v0 to v1 there. */
GOLDEN_FN void golden_make_segment(uint64_t index, int hard, companion *c)
{
    golden_grid g;
    int k;
    if (hard) {
        golden_make_hard_grid(index | 1, &g);
    } else {
        golden_make_grid(index | 1, &g);
    }
    for (k = 0; k < COMPANION_NUMBERS; ++k) {
        c->x[k] = 0;
    }
    for (k = 0; k < 3; ++k) {
        c->x[k] = g.origin[k];
        c->x[3 + k] = g.size[k];
        c->x[6 + k] = (uint64_t)(uint32_t)(g.lo[k] + 0x800000);
        c->x[COMPANION_W + k] = g.v[k];
        c->x[COMPANION_O + k] = g.v[3 + (int)(index >> 8 & 1) * 3 + k];
    }
    if ((index >> 9 & 3) == 0) { /* along a plane, perhaps */
        k = (int)(index >> 11 & 0xffff) % 3;
        c->x[COMPANION_O + k] = c->x[COMPANION_W + k];
    }
}

GOLDEN_FN void golden_make_companion(uint64_t index, companion *c)
{
    uint64_t state = index * 1013 + 3;
    int64_t x[COMPANION_NUMBERS];
    int i, e = 0, decimal, reach;
    int kind = golden_between(&state, 0, 15);
    int nudges = golden_between(&state, -3, 3);
    int endless = golden_between(&state, 0, 7);
    c->which = (int)(index % COMPANIONS);
    c->f64 = !companion_has_float(c->which) || (companion_has_f64(c->which) && index / COMPANIONS % 3 == 2);
    c->flags = (1u << golden_between(&state, 0, 3)) >> 1;
    if (c->which == COMPANION_GRID_SEGMENT) {
        golden_make_segment(index, 0, c);
        return;
    }
    if (kind < 2) {
        for (i = 0; i < COMPANION_NUMBERS; ++i) {
            c->x[i] = golden_loose(&state, kind, c->f64);
        }
        return;
    }
    for (i = 0; i < COMPANION_NUMBERS; ++i) {
        x[i] = 0;
    }
    reach = kind < 6 ? golden_between(&state, 1, 8) : 1 << golden_between(&state, 3, 17);
    golden_triangle(&state, reach, x);
    if (kind == 6) {
        reach = 1 << golden_between(&state, 0, 20); /* box and triangle of very different sizes */
    }
    golden_box(&state, x, reach, x + COMPANION_LO, x + COMPANION_HI);
    golden_add_numbers(&state, c->which, reach, x);
    decimal = kind == 2 || kind == 3;
    if (decimal) { /* multiples of the number nearest to 0.1, rounded */
        for (i = 0; i < COMPANION_NUMBERS; ++i) {
            if (!golden_is_time(c->which, i) && !golden_is_normal(c->which, i)) {
                x[i] = x[i] / 8 * (c->f64 ? (int64_t)7205759403792794 : 13421773);
            }
        }
        e = c->f64 ? -56 : -27;
    } else if (kind == 7) { /* the least numbers: subnormals */
        e = (c->f64 ? -1074 : -149) + golden_between(&state, -8, 30);
    } else if (kind == 8) { /* the largest */
        e = (c->f64 ? 1024 : 128) - golden_between(&state, 20, 30);
    } else if (kind > 10) {
        e = golden_between(&state, -40, 20);
    }
    for (i = 0; i < COMPANION_NUMBERS; ++i) {
        int scale = golden_is_time(c->which, i) ? -3 : golden_is_normal(c->which, i) ? 0 : e;
        c->x[i] = golden_encode(x[i], scale, c->f64);
    }
    if (endless < 2 && golden_is_time(c->which, COMPANION_T1)) { /* rays and lines */
        c->x[COMPANION_T1] = c->f64 ? (uint64_t)0x7ff << 52 : (uint64_t)0xff << 23;
        if (endless == 0) {
            c->x[c->which == COMPANION_RAY_SPHERE ? COMPANION_HI : COMPANION_T0] = c->f64 ? (uint64_t)0xfff << 52 : (uint64_t)0x1ff << 23;
        }
    }
    for (; nudges > 0; --nudges) {
        i = golden_between(&state, 0, COMPANION_NUMBERS - 1);
        c->x[i] = golden_nudge(c->x[i], golden_between(&state, -2, 2), c->f64);
    }
    if (kind == 9) {
        i = golden_between(&state, 0, COMPANION_NUMBERS - 1);
        c->x[i] = golden_special(&state, c->f64);
    }
}

/* ---- hard numbers: NaN, infinity, subnormals, zeros and huge ones for every function; a grid of tenths --- */

/* Replaces one to three of the numbers by special ones, or by subnormals, or zeros, or numbers of 2^41 and
 * 2^64, whose products do not fit a float. */
GOLDEN_FN void golden_harden(uint64_t *state, uint64_t *numbers, int n, int f64)
{
    const int kind = golden_between(state, 0, 5);
    int times = golden_between(state, 1, 3);
    for (; times > 0; --times) {
        const int i = golden_between(state, 0, n - 1);
        const int64_t m = golden_between(state, -9, 9);
        switch (kind) {
        case 0: /* a subnormal among ordinary numbers */
            numbers[i] = golden_encode(m * 1234567, f64 ? -1074 : -149, f64);
            break;
        case 1:
            numbers[i] = golden_encode(0, 0, f64) | (m < 0 ? (uint64_t)1 << (f64 ? 63 : 31) : 0);
            break;
        case 2:
            numbers[i] = golden_encode(m, golden_between(state, 0, 1) ? 41 : 64, f64);
            break;
        default:
            numbers[i] = golden_special(state, f64);
            break;
        }
    }
}

/* the number nearest to k tenths */
GOLDEN_FN uint64_t golden_tenths(int k, int f64)
{
    const int64_t magnitude = k < 0 ? -(int64_t)k : k;
    const int64_t scaled = (magnitude << 43) / 10 | (k % 10 != 0); /* what is cut off is no tie */
    return golden_encode(k < 0 ? -scaled : scaled, -43, f64);
}

/* Numbers first..first+n-1 on a grid of tenths far from zero, a few steps around base, some one place off. */
GOLDEN_FN void golden_on_tenths(uint64_t *state, uint64_t *numbers, int n, const int base[3], int reach, int f64)
{
    int i;
    for (i = 0; i < n; ++i) {
        numbers[i] = golden_tenths(base[i % 3] + golden_between(state, -reach, reach), f64);
        if (golden_between(state, 0, 3) == 0) {
            numbers[i] = golden_nudge(numbers[i], golden_between(state, -1, 1), f64);
        }
    }
}

GOLDEN_FN void golden_tenths_base(uint64_t *state, int base[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        const int far_out = golden_between(state, 0, 2) == 0 ? 100000 : 100;
        base[k] = golden_between(state, -far_out, far_out);
    }
}

GOLDEN_FN void golden_make_hard_single(uint64_t index, golden_single *c)
{
    uint64_t state = index * 1019 + 7;
    const int tenths = golden_between(&state, 0, 3) == 0;
    const int reach = golden_between(&state, 1, 3);
    const int none[3] = {0, 0, 0};
    int base[3];
    uint64_t *numbers[4];
    int group;
    golden_make_single(index, c);
    golden_tenths_base(&state, base);
    if (tenths) {
        golden_on_tenths(&state, c->v, 9, base, reach, c->f64);
        golden_on_tenths(&state, c->lo, 3, base, reach, c->f64);
        golden_on_tenths(&state, c->hi, 3, base, reach + 1, c->f64);
        golden_on_tenths(&state, c->size, 3, none, 2, c->f64);
        return;
    }
    numbers[0] = c->v;
    numbers[1] = c->lo;
    numbers[2] = c->hi;
    numbers[3] = c->size;
    group = golden_between(&state, 0, 3);
    golden_harden(&state, numbers[group], group == 0 ? 9 : 3, c->f64);
}

GOLDEN_FN void golden_make_hard_companion(uint64_t index, companion *c)
{
    uint64_t state = index * 1021 + 9;
    const int tenths = golden_between(&state, 0, 2) == 0;
    const int reach = golden_between(&state, 1, 3);
    const int none[3] = {0, 0, 0};
    int base[3];
    golden_make_companion(index, c);
    golden_tenths_base(&state, base);
    if (c->which == COMPANION_GRID_SEGMENT) {
        golden_make_segment(index, 1, c);
        return;
    }
    if (tenths && c->which != COMPANION_PLANE_BOX && c->which != COMPANION_PLANE_SPHERE) {
        golden_on_tenths(&state, c->x, COMPANION_W, base, reach, c->f64);
        if (c->which == COMPANION_OCTANTS) { /* sizes: a twentieth, a tenth and the like, or nearly */
            golden_on_tenths(&state, c->x + COMPANION_HI, 3, none, 1, c->f64);
            golden_on_tenths(&state, c->x + COMPANION_W, 3, none, 3, c->f64);
            c->x[COMPANION_HI] -= c->x[COMPANION_HI] != 0 ? (uint64_t)1 << (c->f64 ? 52 : 23) : 0;
        } else {
            golden_on_tenths(&state, c->x + COMPANION_W, 6, base, reach, c->f64);
        }
        if (c->which >= COMPANION_SPHERE_SPHERE) { /* radii, too; a direction */
            golden_on_tenths(&state, c->x + COMPANION_T0, 1, none, 3, c->f64);
        }
        if (c->which == COMPANION_RAY_SPHERE) {
            golden_on_tenths(&state, c->x + COMPANION_LO, 3, none, 3, c->f64);
        }
        return;
    }
    golden_harden(&state, c->x, COMPANION_NUMBERS, c->f64);
}

GOLDEN_FN void golden_make_hard_grid(uint64_t index, golden_grid *g)
{
    uint64_t state = index * 1031 + 11;
    const int kind = golden_between(&state, 0, 5);
    const int none[3] = {0, 0, 0};
    int base[3];
    int k;
    golden_make_grid(index, g);
    golden_tenths_base(&state, base);
    if (kind == 0) { /* tenths, and an origin that is a tenth */
        golden_on_tenths(&state, g->v, 18, base, 4, g->f64);
        golden_on_tenths(&state, g->point, 3, base, 4, 1);
        golden_on_tenths(&state, g->origin, 3, base, 4, 1);
        for (k = 0; k < 3; ++k) {
            const int tenths = golden_between(&state, 1, 2);
            g->size[k] = golden_nudge(golden_tenths(tenths, 1), golden_between(&state, -1, 1), 1);
            g->lo[k] = golden_between(&state, -4, 0);
        }
    } else if (kind == 1) { /* the least numbers */
        const int e = (g->f64 ? -1074 : -149) + golden_between(&state, 0, 3);
        for (k = 0; k < 3; ++k) {
            g->origin[k] = golden_encode(golden_between(&state, -3, 3), e, 1);
            g->size[k] = golden_encode(golden_between(&state, 1, 3), e, 1);
            g->point[k] = golden_encode(golden_between(&state, -9, 30), e, 1);
            g->lo[k] = golden_between(&state, -2, 0);
        }
        for (k = 0; k < 18; ++k) {
            g->v[k] = golden_encode(golden_between(&state, -9, 20), e, g->f64);
        }
    } else if (kind == 2) {
        golden_harden(&state, g->origin, 3, 1);
        golden_harden(&state, g->point, 3, 1);
    } else if (kind == 3) {
        golden_harden(&state, g->size, 3, 1);
    } else {
        golden_harden(&state, g->v, golden_between(&state, 0, 1) ? 9 : 18, g->f64);
        if (kind == 5) {
            golden_on_tenths(&state, g->v + 9, 9, none, 30, g->f64);
        }
    }
}

/* ---- the hash --------------------------------------------------------------------------------- */

/* A component of an axis, in [-1, 1], in units of 2^-20, cut. */
GOLDEN_FN int golden_fixed(uint32_t bits)
{
    const int exponent = (int)(bits >> 23 & 255u);
    const int mantissa = (int)((bits & 0x7fffffu) | 0x800000u);
    const int fixed = 130 - exponent > 24 ? 0 : exponent > 127 ? 0x400000 : mantissa >> (130 - exponent);
    return bits >> 31 != 0 ? -fixed : fixed;
}

/* ... in sixteen steps, none of which begins near a number that axes like to be. */
GOLDEN_FN int golden_step(int fixed)
{
    return (fixed + 0x405a5a3) >> 16;
}

/* An axis and a gap as roughly as they are the same everywhere. Of the sweep's axis only the magnitudes: at rest it may
 * point either way. gen_golden.c shows that none of them is near the border of two steps. */
GOLDEN_FN uint64_t golden_rough(const companion_answer *a, int is_gap)
{
    const uint64_t size = a->s << 1 >> 1;
    uint64_t rough = is_gap && size != 0 ? (size + (((uint64_t)0x9u << 32) | 0xe3779b97u)) >> 36 : 0;
    int k;
    for (k = 0; k < 3; ++k) {
        const int fixed = golden_fixed(is_gap ? a->axis[k] : a->axis[k] & 0x7fffffffu);
        rough = rough << 12 | (uint64_t)(golden_step(fixed) & 0xfff);
    }
    return rough;
}

GOLDEN_FN uint64_t golden_mix_companion(uint64_t hash, uint64_t index, int hard)
{
    companion c;
    companion_answer answer;
    int i;
    if (hard) {
        golden_make_hard_companion(index, &c);
    } else {
        golden_make_companion(index, &c);
    }
    golden_ask_companion(&c, &answer);
    GOLDEN_SAY(hard ? "hard companion" : "companion", index, ((uint64_t)(uint32_t)answer.value << 8) | (uint32_t)answer.n);
    hash = golden_mix(hash, ((uint64_t)(uint32_t)answer.value << 32) | (uint32_t)answer.n);
    if (c.which == COMPANION_SWEEP || (c.which >= COMPANION_SWEEP_RULE && c.which <= COMPANION_GAP)) {
        const uint64_t rough = golden_rough(&answer, c.which == COMPANION_GAP);
        hash = golden_mix(hash, rough);
        GOLDEN_SAY(hard ? "    axis, hard" : "    axis", index, rough);
    }
    for (i = 0; i < answer.n; ++i) {
        hash = golden_mix(hash, answer.word[i]);
        GOLDEN_SAY(hard ? "    wrote, hard" : "    wrote", index, answer.word[i]);
    }
    return hash;
}

GOLDEN_FN uint64_t golden_mix_single(uint64_t hash, uint64_t index, int hard)
{
    golden_single c;
    uint32_t word;
    if (hard) {
        golden_make_hard_single(index, &c);
    } else {
        golden_make_single(index, &c);
    }
    word = golden_ask_single(&c);
    GOLDEN_SAY(hard ? "hard single" : "single", index, word);
    return golden_mix(hash, word);
}

GOLDEN_FN uint64_t golden_mix_grid(uint64_t hash, uint64_t index, int hard)
{
    golden_grid g;
    unsigned rule;
    uint64_t word;
    if (hard) {
        golden_make_hard_grid(index, &g);
    } else {
        golden_make_grid(index, &g);
    }
    for (rule = 0; rule < 4; ++rule) {
        unsigned flags = (1u << rule) >> 1; /* closed, half-open, open, thin */
        word = golden_ask_grid(&g, flags);
        GOLDEN_SAY(hard ? "hard spans" : "spans", index, word);
        hash = golden_mix(hash, word);
        if (!g.f64) {
            word = golden_ask_fill(&g, flags);
            GOLDEN_SAY(hard ? "hard fill" : "fill", index, word);
            hash = golden_mix(hash, word);
        }
    }
    word = golden_ask_solid(&g);
    GOLDEN_SAY(hard ? "hard solid" : "solid", index, word);
    hash = golden_mix(hash, word);
    word = golden_ask_locate(&g);
    GOLDEN_SAY(hard ? "hard locate" : "locate", index, word);
    hash = golden_mix(hash, word);
    if (!g.f64) {
        word = golden_ask_fit(&g);
        GOLDEN_SAY(hard ? "hard fit" : "fit", index, word);
        hash = golden_mix(hash, word);
    }
    return hash;
}

GOLDEN_FN uint64_t golden_chunk(uint32_t chunk)
{
    uint64_t hash = GOLDEN_BASIS;
    uint32_t i;
    for (i = 0; i < GOLDEN_SINGLES; ++i) {
        hash = golden_mix_single(hash, (uint64_t)chunk * GOLDEN_SINGLES + i, 0);
    }
    for (i = 0; i < GOLDEN_COMPANIONS; ++i) {
        hash = golden_mix_companion(hash, (uint64_t)chunk * GOLDEN_COMPANIONS + i, 0);
    }
    hash = golden_mix_grid(hash, chunk, 0);
    for (i = 0; i < GOLDEN_HARD; ++i) {
        hash = golden_mix_single(hash, (uint64_t)chunk * GOLDEN_HARD + i, 1);
        hash = golden_mix_companion(hash, (uint64_t)chunk * GOLDEN_HARD + i, 1);
    }
    return golden_mix_grid(hash, chunk, 1);
}

#endif
