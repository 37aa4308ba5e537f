/* solid.h - fills the inside of voxelized surfaces: what a flood from the border of the grid does not reach
 *
 * Voxels are joined across faces. Both the conservative and the thin rule set enough voxels to stop that
 * flood, so the inside of a closed mesh is found at every resolution. A hole in the mesh that is wider
 * than a voxel lets the flood in.
 */
#ifndef EXAMPLES_SOLID_H
#define EXAMPLES_SOLID_H
#include "voxel_io.h"

typedef struct solid {
    const voxels  *v;
    uint64_t      *reached;     /* as v->bits: free voxels that the flood has reached */
    unsigned char *waiting;     /* row is on the stack */
    size_t        *stack;       /* rows whose neighbours may have more to reach */
    size_t         depth;
    size_t         rows;
} solid;

static inline uint64_t solid_valid(const voxels *v, size_t word) {
    size_t rest = v->n[0] - 64 * word;
    return rest >= 64 ? UINT64_MAX : ((uint64_t)1 << rest) - 1;
}

/* Runs of free bits that hold a seed, whole: seeds spread by 1, 2, 4, ... 32 bits both ways. */
static inline uint64_t solid_spread(uint64_t seed, uint64_t open) {
    uint64_t up = open;
    uint64_t down = open;
    int shift;
    for (shift = 1; shift < 64; shift *= 2) {
        seed |= up & (seed << shift);
        up &= up << shift;
    }
    for (shift = 1; shift < 64; shift *= 2) {
        seed |= down & (seed >> shift);
        down &= down >> shift;
    }
    return seed;
}

static inline void solid_push(solid *s, size_t row) {
    if (!s->waiting[row]) {
        s->waiting[row] = 1;
        s->stack[s->depth] = row;
        s->depth += 1;
    }
}

/* Spreads along the row what is reached in it and `more` (NULL: nothing). Returns 1 if something new was
   reached. */
static inline int solid_flood_row(solid *s, size_t row, const uint64_t *more) {
    uint64_t *reached = s->reached + row * s->v->row_words;
    const uint64_t *set = s->v->bits + row * s->v->row_words;
    size_t words = s->v->row_words;
    uint64_t carry = 0;
    int changed = 0;
    size_t i;
    for (i = 0; i < words; i++) {       /* upwards, then downwards: a run may go on in the next word */
        uint64_t open = ~set[i] & solid_valid(s->v, i);
        uint64_t now = solid_spread((reached[i] | (more ? more[i] : 0) | carry) & open, open);
        changed |= now != reached[i];
        reached[i] = now;
        carry = now >> 63;
    }
    carry = 0;
    for (i = words; i-- > 0;) {
        uint64_t open = ~set[i] & solid_valid(s->v, i);
        uint64_t now = solid_spread((reached[i] | carry << 63) & open, open);
        changed |= now != reached[i];
        reached[i] = now;
        carry = now & 1;
    }
    return changed;
}

static inline void solid_flood(solid *s) {
    size_t ny = s->v->n[1];
    size_t nz = s->v->n[2];
    while (s->depth > 0) {
        size_t row;
        size_t y;
        size_t z;
        int side;
        s->depth -= 1;
        row = s->stack[s->depth];
        s->waiting[row] = 0;
        y = row % ny;
        z = row / ny;
        for (side = 0; side < 4; side++) {
            size_t y2 = side == 0 ? y - 1 : side == 1 ? y + 1 : y;      /* "-1" is a large number */
            size_t z2 = side == 2 ? z - 1 : side == 3 ? z + 1 : z;
            if (y2 < ny && z2 < nz && solid_flood_row(s, z2 * ny + y2, s->reached + row * s->v->row_words)) {
                solid_push(s, z2 * ny + y2);
            }
        }
    }
}

/* All free voxels on the grid's border are outside. */
static inline void solid_seed(solid *s) {
    size_t last = s->v->n[0] - 1;
    size_t row;
    size_t i;
    for (row = 0; row < s->rows; row++) {
        uint64_t *reached = s->reached + row * s->v->row_words;
        const uint64_t *set = s->v->bits + row * s->v->row_words;
        size_t y = row % s->v->n[1];
        size_t z = row / s->v->n[1];
        int border = y == 0 || z == 0 || y + 1 == s->v->n[1] || z + 1 == s->v->n[2];
        reached[0] |= 1;
        reached[last >> 6] |= (uint64_t)1 << (last & 63);
        for (i = 0; i < s->v->row_words; i++) {
            reached[i] = (border ? solid_valid(s->v, i) : reached[i]) & ~set[i];
        }
        solid_flood_row(s, row, NULL);
        solid_push(s, row);
    }
}

/* Sets the voxels inside. Returns 1, or 0 if memory is short; the count of new voxels in out_inside. */
static inline int solid_fill(voxels *v, size_t *out_inside) {
    solid s;
    size_t row;
    size_t i;
    int ok;
    s.v = v;
    s.rows = v->n[1] * v->n[2];
    s.depth = 0;
    s.reached = (uint64_t *)calloc(v->words, sizeof *s.reached);
    s.waiting = (unsigned char *)calloc(s.rows, 1);
    s.stack = (size_t *)malloc(s.rows * sizeof *s.stack);
    ok = s.reached && s.waiting && s.stack;
    *out_inside = 0;
    if (ok) {
        solid_seed(&s);
        solid_flood(&s);
        for (row = 0; row < s.rows; row++) {
            for (i = 0; i < v->row_words; i++) {
                uint64_t *word = &v->bits[row * v->row_words + i];
                uint64_t inside = ~*word & ~s.reached[row * v->row_words + i] & solid_valid(v, i);
                *out_inside += (size_t)voxels_ones(inside);
                *word |= inside;
            }
        }
    }
    free(s.reached);
    free(s.waiting);
    free(s.stack);
    return ok;
}

#endif /* EXAMPLES_SOLID_H */
