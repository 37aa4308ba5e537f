/* guess.h - which convention fits a file best: all of them are tried, and the number of different voxels
 * tells
 *
 * Boxes and samples, moved by no and by half a voxel, all touching rules, all 64 ways to take the faces of a
 * solid, and where the format leaves it open, which index is x and which numbers mean "set". Conventions that
 * set the same voxels for this mesh cannot be told apart: they share a place.
 */
#ifndef EXAMPLES_GUESS_H
#define EXAMPLES_GUESS_H
#include "convention.h"
#include "volume.h"

typedef struct fit {
    convention c;
    int        turned;          /* the array's first index is x */
    int        below;           /* which numbers are set: below or above the level */
    double     level;
    size_t     common;
    size_t     missing;
    size_t     extra;
    int        number;          /* in the order of trial */
} fit;

enum { GUESS_ROOM = 2048 };

typedef struct guess {
    const mesh   *m;
    fit          *fits;         /* GUESS_ROOM of them */
    int           count;
    fit           now;          /* what is being tried */
    const voxels *given;
} guess;

static inline void guess_add(guess *g, const convention *c, size_t common, size_t missing, size_t extra) {
    fit *f = &g->fits[g->count];
    if (g->count < GUESS_ROOM) {
        *f = g->now;
        f->c = *c;
        f->common = common;
        f->missing = missing;
        f->extra = extra;
        f->number = g->count;
        g->count += 1;
    }
}

static inline void guess_compare(guess *g, const convention *c, const voxels *exact) {
    size_t common = 0;
    size_t missing = 0;
    size_t extra = 0;
    size_t i;
    for (i = 0; i < exact->words; i++) {
        common += (size_t)voxels_ones(exact->bits[i] & g->given->bits[i]);
        missing += (size_t)voxels_ones(exact->bits[i] & ~g->given->bits[i]);
        extra += (size_t)voxels_ones(g->given->bits[i] & ~exact->bits[i]);
    }
    guess_add(g, c, common, missing, extra);
}

static inline int guess_one(guess *g, const convention *c, char *error) {
    voxels exact;
    if (!convention_set(g->m, &g->given->grid, c, &exact, error)) {
        return 0;
    }
    guess_compare(g, c, &exact);
    voxels_free(&exact);
    return 1;
}

/* All 64 ways to take faces, from eight sets. */
static inline int guess_samples(guess *g, int shift, char *error) {
    tribox_grid grid = convention_grid(&g->given->grid, shift);
    convention c;
    voxels exact;
    samples s;
    size_t i;
    int way;
    memset(&c, 0, sizeof c);
    c.kind = CONVENTION_SAMPLES;
    c.shift = shift;
    if (!voxels_make(&exact, &grid, error)) {
        return 0;
    }
    if (!samples_make(&s, g->m, &grid, NULL, error)) {
        voxels_free(&exact);
        return 0;
    }
    for (way = 0; way < 64; way++) {
        c.face[0] = way & 3;
        c.face[1] = way >> 2 & 3;
        c.face[2] = way >> 4;
        for (i = 0; i < exact.words; i++) {
            exact.bits[i] = samples_word(&s, c.face, i);
        }
        guess_compare(g, &c, &exact);
    }
    samples_free(&s);
    voxels_free(&exact);
    return 1;
}

/* Everything, for one reading of the file. */
static inline int guess_reading(guess *g, char *error) {
    static const unsigned flags[] = {0, TRIBOX_HALF_OPEN, TRIBOX_HALF_OPEN, TRIBOX_OPEN, TRIBOX_THIN};
    convention c;
    int shift;
    int rule;
    memset(&c, 0, sizeof c);
    for (shift = -1; shift <= 1; shift++) {
        c.shift = shift;
        c.kind = CONVENTION_TOUCHED;
        for (rule = 0; rule < 5; rule++) {
            c.flags = flags[rule];
            c.mirrored = rule == 2;
            if (!guess_one(g, &c, error)) {
                return 0;
            }
        }
        c.mirrored = 0;
        c.flags = 0;
        c.kind = CONVENTION_FILLED;
        if (!guess_one(g, &c, error)) {
            return 0;
        }
        c.kind = CONVENTION_NEAREST;
        if (!guess_one(g, &c, error)) {
            return 0;
        }
        c.kind = CONVENTION_VERTICES;
        c.flags = TRIBOX_HALF_OPEN;
        if (!guess_one(g, &c, error) || (shift <= 0 && !guess_samples(g, shift, error))) {
            return 0;
        }
        c.flags = 0;
    }
    return 1;
}

/* The fewest differences first; of equals those that have a program's name, then in the order of trial. */
static inline int guess_named(const fit *f) {
    int i;
    for (i = 0; i < CONVENTION_COUNT; i++) {
        if (convention_same(&conventions[i], &f->c)) {
            return CONVENTION_COUNT - i;
        }
    }
    return 0;
}

static inline int guess_order(const void *a, const void *b) {
    const fit *f = (const fit *)a;
    const fit *h = (const fit *)b;
    size_t fd = f->missing + f->extra;
    size_t hd = h->missing + h->extra;
    if (fd != hd) {
        return fd < hd ? -1 : 1;
    }
    if (guess_named(f) != guess_named(h)) {
        return guess_named(f) > guess_named(h) ? -1 : 1;
    }
    return f->number - h->number;
}

/* Tries one reading: set is what is above, or below, the level. */
static inline int guess_level(guess *g, const volume *v, int below, double level, char *error) {
    voxels given;
    int ok;
    g->now.below = below;
    g->now.level = level;
    if (!volume_set(v, below ? VOLUME_BELOW : VOLUME_ABOVE, level, &given, error)) {
        return 0;
    }
    g->given = &given;
    ok = guess_reading(g, error);
    voxels_free(&given);
    return ok;
}

/* Fills `fits`, sorted; the count in *out_count. Returns 1, or 0 with a sentence in `error`. */
static inline int guess_all(const mesh *m, volume *v, fit *fits, int *out_count, char *error) {
    guess g;
    double least;
    double greatest;
    int turns;
    memset(&g, 0, sizeof g);
    g.m = m;
    g.fits = fits;
    volume_range(v, &least, &greatest);
    for (turns = 0; turns < (v->free_order ? 2 : 1); turns++) {
        g.now.turned = turns;
        if (!guess_level(&g, v, 0, 0, error) || (least < 0 && !guess_level(&g, v, 1, 0, error))
            || (v->type.kind == 'f' && least >= 0 && greatest <= 1 && !guess_level(&g, v, 0, 0.5, error))) {
            return 0;
        }
        if (v->free_order) {
            volume_turn(v);         /* the second turn restores it */
        }
    }
    qsort(fits, (size_t)g.count, sizeof *fits, guess_order);
    *out_count = g.count;
    return 1;
}

#endif /* EXAMPLES_GUESS_H */
