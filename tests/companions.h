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
    int f64;        /* in doubles; never for planes and sweeps */
    unsigned flags; /* of the prepared triangle, for octants */
    uint64_t x[COMPANION_NUMBERS];
} companion;

/* value: what the function returns. word: bits of the floats or doubles (or the indices) written, n of them;
 * what is not written stays 0. The sweep's axis stands apart: its last bits are the compiler's. */
typedef struct companion_answer {
    int value;
    int n;
    uint64_t word[27];
    uint32_t axis[3];
} companion_answer;

#define COMPANION_MESH 7     /* triangles of the indexed mesh */
#define COMPANION_CAPACITY 4 /* how many indices are asked for */

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
    return which != COMPANION_PLANE_BOX && which != COMPANION_SWEEP;
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
