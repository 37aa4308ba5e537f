/* baseline.h - the opponents, written here from the papers and tuned in good faith.
 *
 * All of them compute in plain floating point and may be wrong close to touching. They are what programs use
 * today, so they are what tribox.h is timed against.
 *
 *   [AM01] Akenine-Moller, Fast 3D triangle-box overlap testing, JGT 6(1), 2001
 *   [SS10] Schwarz and Seidel, Fast parallel surface and solid voxelization on GPUs, ACM TOG 29(6), 2010
 */
#ifndef BASELINE_H
#define BASELINE_H

#include <math.h>

/* A test that is called instead of inlined pays for passing its arguments; the opponents never do. */
#if defined(__GNUC__) || defined(__clang__)
#define BASELINE_FN static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define BASELINE_FN static __forceinline
#else
#define BASELINE_FN static inline
#endif

/* ---- One box: [AM01] ----------------------------------------------------------------------------------- */

#define SAT_REAL       float
#define SAT_ABS        fabsf
#define SAT_NAME(name) baseline_sat_##name
#include "baseline_sat.h"

#define SAT_REAL       double
#define SAT_ABS        fabs
#define SAT_NAME(name) baseline_sat64_##name
#include "baseline_sat.h"

/* The shared cross products with the three coordinates in the lanes of a register: how far intrinsics would
 * take it. */
#if defined(__SSE2__)
#define BASELINE_SSE 1
#include <emmintrin.h>

BASELINE_FN __m128 baseline_load3(const float v[3])
{
    return _mm_movelh_ps(_mm_castpd_ps(_mm_load_sd((const double *)(const void *)v)), _mm_load_ss(v + 2));
}

BASELINE_FN __m128 baseline_yzx(__m128 v)
{
    return _mm_shuffle_ps(v, v, _MM_SHUFFLE(3, 0, 2, 1));
}

/* a x b, its lanes one place behind: (z, x, y). */
BASELINE_FN __m128 baseline_cross_zxy(__m128 a, __m128 b)
{
    return _mm_sub_ps(_mm_mul_ps(a, baseline_yzx(b)), _mm_mul_ps(baseline_yzx(a), b));
}

/* The gap along e x (unit vectors), lanes as in the cross product, given n/2 - (a x b). */
BASELINE_FN __m128 baseline_gap_sse(__m128 middle, __m128 e, __m128 half, __m128 half_yzx, __m128 sign)
{
    __m128 size = _mm_andnot_ps(sign, e);
    __m128 radius = _mm_add_ps(_mm_mul_ps(half, baseline_yzx(size)), _mm_mul_ps(half_yzx, size));
    return _mm_sub_ps(_mm_andnot_ps(sign, middle), radius);
}

BASELINE_FN int baseline_sat_sse(const float v0[3], const float v1[3], const float v2[3],
                                 const float box_min[3], const float box_max[3])
{
    const __m128 sign = _mm_set1_ps(-0.0f);
    __m128 top = baseline_load3(box_max);
    __m128 centre = _mm_mul_ps(_mm_set1_ps(0.5f), _mm_add_ps(baseline_load3(box_min), top));
    __m128 half = _mm_sub_ps(top, centre);
    __m128 half_yzx = baseline_yzx(half);
    __m128 a = _mm_sub_ps(baseline_load3(v0), centre);
    __m128 b = _mm_sub_ps(baseline_load3(v1), centre);
    __m128 c = _mm_sub_ps(baseline_load3(v2), centre);
    __m128 low = _mm_min_ps(_mm_min_ps(a, b), c);
    __m128 high = _mm_max_ps(_mm_max_ps(a, b), c);
    __m128 faces = _mm_sub_ps(_mm_max_ps(low, _mm_xor_ps(high, sign)), half);
    __m128 ab = baseline_cross_zxy(a, b);
    __m128 bc = baseline_cross_zxy(b, c);
    __m128 ca = baseline_cross_zxy(c, a);
    __m128 n = _mm_add_ps(_mm_add_ps(ab, bc), ca);
    __m128 m = _mm_mul_ps(_mm_set1_ps(0.5f), n);
    __m128 g0 = baseline_gap_sse(_mm_sub_ps(m, ab), _mm_sub_ps(b, a), half, half_yzx, sign);
    __m128 g1 = baseline_gap_sse(_mm_sub_ps(m, bc), _mm_sub_ps(c, b), half, half_yzx, sign);
    __m128 g2 = baseline_gap_sse(_mm_sub_ps(m, ca), _mm_sub_ps(a, c), half, half_yzx, sign);
    __m128 edges = _mm_sub_ps(_mm_max_ps(_mm_max_ps(g0, g1), g2), _mm_andnot_ps(sign, m));
    __m128 n_xyz = baseline_yzx(n);
    __m128 d = _mm_mul_ps(n_xyz, a);
    __m128 r = _mm_mul_ps(_mm_andnot_ps(sign, n_xyz), half);
    __m128 d_sum = _mm_add_ss(_mm_add_ss(d, _mm_shuffle_ps(d, d, 1)), _mm_movehl_ps(d, d));
    __m128 r_sum = _mm_add_ss(_mm_add_ss(r, _mm_shuffle_ps(r, r, 1)), _mm_movehl_ps(r, r));
    __m128 plane = _mm_sub_ss(_mm_andnot_ps(sign, d_sum), r_sum);
    int apart = _mm_movemask_ps(_mm_cmpgt_ps(_mm_max_ps(faces, edges), _mm_setzero_ps())) & 7;
    return !(apart | _mm_comigt_ss(plane, _mm_setzero_ps()));
}
#endif

#endif /* BASELINE_H */
