/* A question to one of the companions of tribox.h and its answer, as bit patterns: what verify, the golden
 * answers and the fuzzers share. Nothing here computes with floating-point numbers, so that questions and
 * answers are the same everywhere. C99 that is also C++98 and CUDA; calls no library.
 */
#ifndef COMPANIONS_H
#define COMPANIONS_H

#include <stddef.h>
#include <stdint.h>

enum {
    COMPANION_BOX_BOX,      /* the box, and the box from w to o */
    COMPANION_PLANE_BOX,    /* normal w, d = t_min */
    COMPANION_SEGMENT_BOX,  /* from w to o */
    COMPANION_RAY_BOX,      /* o + t w */
    COMPANION_RAY_TRIANGLE, /* o + t w */
    COMPANION_SWEEP,        /* velocity w */
    COMPANION_CLIP,
    COMPANION_CLOSEST, /* to o */
    COMPANION_OCTANTS, /* p and size for the box; first set up with size w */
    COMPANION_QUERY,   /* triangles among v0 v1 v2 w o, see companion_mesh */
    COMPANION_SWEEP_RULE,   /* velocity w */
    COMPANION_SWEEP_BOX,    /* velocity w; box b from v0 to v1 */
    COMPANION_GAP,
    COMPANION_GRID_SEGMENT, /* origin v0, size v1, from w to o; region: companion_region */
    COMPANION_SPHERE_SPHERE,   /* centre w, radius t_max, and as all below centre o, radius t_min */
    COMPANION_PLANE_SPHERE,    /* normal w, d = t_max */
    COMPANION_SPHERE_BOX,
    COMPANION_SPHERE_TRIANGLE,
    COMPANION_RAY_SPHERE,   /* w + t box_min, t from the first of box_max to t_max */
    COMPANIONS
};

/* Numbers of a question: where each begins. Bits of floats in the low half, of doubles if f64. */
enum {
    COMPANION_V = 0,
    COMPANION_LO = 9,
    COMPANION_HI = 12,
    COMPANION_W = 15,
    COMPANION_O = 18,
    COMPANION_T0 = 21,
    COMPANION_T1 = 22,
    COMPANION_NUMBERS = 23
};

typedef struct companion {
    int which;
    int f64;        /* in doubles */
    unsigned flags; /* of the prepared triangle, for octants; of a sweep; of a grid */
    uint64_t x[COMPANION_NUMBERS];
} companion;

/* value: what the function returns. word: bits of the floats or doubles (or the indices) written, n of them;
 * what is not written stays 0. A sweep's or gap's axis, and the gap's s, stand apart: their last bits are the compiler's.
 * A gap's value is the sign of s, twice if s is infinite; a segment's two words are its count and companion_mix of its
 * voxels. */
typedef struct companion_answer {
    int value;
    int n;
    uint64_t word[27];
    uint32_t axis[3];
    uint64_t s;
} companion_answer;

#define COMPANION_MESH 7     /* triangles of the indexed mesh */
#define COMPANION_CAPACITY 4 /* how many indices are asked for */
#define COMPANION_REGION 5   /* a segment's region has so many voxels on each axis */

#ifndef COMPANION_FN
#ifdef __CUDACC__
#define COMPANION_FN static inline __host__ __device__
#else
#define COMPANION_FN static inline
#endif
#endif

/* Has the function a version for doubles? */
COMPANION_FN int companion_has_f64(int which)
{
    return which != COMPANION_PLANE_BOX && which != COMPANION_SWEEP &&
           (which <= COMPANION_QUERY || which == COMPANION_GRID_SEGMENT);
}

COMPANION_FN int companion_has_float(int which)
{
    return which != COMPANION_GRID_SEGMENT;
}

/* The region of a segment's grid: from lo on, which is the lower bits of v2. */
COMPANION_FN void companion_region(const companion *c, int lo[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        lo[k] = (int)(c->x[6 + k] & 0xffffffu) - 0x800000;
    }
}

/* A hash of a sequence of voxels. */
COMPANION_FN uint64_t companion_mix_start(void)
{
    return 0x9e3779b9u;
}

COMPANION_FN uint64_t companion_mix(uint64_t hash, int x, int y, int z)
{
    const uint64_t odd = (uint64_t)0x9e3779b9u << 32 | 0x7f4a7c15u;
    hash = (hash ^ (uint32_t)x) * odd;
    hash = (hash ^ (hash >> 29) ^ (uint32_t)y) * odd;
    return (hash ^ (hash >> 31) ^ (uint32_t)z) * odd;
}

/* The indexed mesh: which of v0 v1 v2 w o are the corners of each triangle. */
COMPANION_FN void companion_mesh(uint32_t indices[3 * COMPANION_MESH])
{
    const unsigned char corners[3 * COMPANION_MESH] = {0, 1, 2, 0, 1, 3, 4, 2, 1, 3, 2, 0,
                                                       4, 4, 3, 0, 4, 1, 2, 2, 2};
    int i;
    for (i = 0; i < 3 * COMPANION_MESH; ++i) {
        indices[i] = corners[i];
    }
}

#endif
