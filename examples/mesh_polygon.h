/* mesh_polygon.h - cuts a polygon of any shape into triangles; every turn is told exactly
 *
 * Corners are projected along the axis of the polygon's largest area. A polygon whose every diagonal from its
 * first corner lies inside becomes a fan, as a convex one does; any other is cut by ears: a corner whose
 * triangle holds no other corner is cut off, again and again. Corners may touch one another, so that a hole may
 * be joined to the outline by a double edge. Cost: the square of the corners, at worst.
 */
#ifndef EXAMPLES_MESH_POLYGON_H
#define EXAMPLES_MESH_POLYGON_H
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#define POLYGON_MOST 65536      /* corners; more would take minutes */

typedef double polygon_point[2];

/* ---- 1. Turns ---------------------------------------------------------------------------------- */

/* Adds b to an exact sum of n doubles that do not overlap, least first; it has n + 1 then. */
static inline int polygon_grow(double *sum, int n, double b) {
    int i;
    for (i = 0; i < n; i++) {
        volatile double total = sum[i] + b;
        volatile double virtual_b = total - sum[i];
        volatile double rest = (sum[i] - (total - virtual_b)) + (b - virtual_b);
        sum[i] = rest;
        b = total;
    }
    sum[n] = b;
    return n + 1;
}

/* x * y as a head and a tail, by halves of 26 bits [Dekker 1971]; |x|, |y| <= 1. */
static inline int polygon_add_product(double *sum, int n, double x, double y) {
    volatile double x_split = 134217729.0 * x;
    volatile double y_split = 134217729.0 * y;
    volatile double x_high = x_split - (x_split - x);
    volatile double y_high = y_split - (y_split - y);
    volatile double x_low = x - x_high;
    volatile double y_low = y - y_high;
    volatile double head = x * y;
    volatile double tail = x_low * y_low - (((head - x_high * y_high) - x_low * y_high) - x_high * y_low);
    n = polygon_grow(sum, n, tail);
    return polygon_grow(sum, n, head);
}

/* The way a, b, c turns: 1 left, -1 right, 0 straight on. Exact where the coordinates, scaled so that the
 * largest of the polygon is below 1, are multiples of 2^-500. */
static inline int polygon_turn(const double *a, const double *b, const double *c) {
    const double left = (a[0] - c[0]) * (b[1] - c[1]);
    const double right = (a[1] - c[1]) * (b[0] - c[0]);
    const double turn = left - right;
    const double error = 4e-16 * (fabs(left) + fabs(right)) + 1e-290;  /* 3 units in the last place of each */
    double sum[16];
    int n = 0;
    if (turn > error || turn < -error) {
        return turn > 0 ? 1 : -1;
    }
    n = polygon_add_product(sum, n, a[0], b[1]);
    n = polygon_add_product(sum, n, -a[1], b[0]);
    n = polygon_add_product(sum, n, b[0], c[1]);
    n = polygon_add_product(sum, n, -b[1], c[0]);
    n = polygon_add_product(sum, n, c[0], a[1]);
    n = polygon_add_product(sum, n, -c[1], a[0]);
    while (n > 0 && sum[n - 1] == 0) {
        n -= 1;
    }
    return n == 0 ? 0 : sum[n - 1] > 0 ? 1 : -1;
}

static inline int polygon_same(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1];
}

/* ---- 2. The plane ------------------------------------------------------------------------------- */

/* The corners as seen along the axis of the largest area, scaled by a power of two below 1, and turned over if
 * need be so that the area is positive. Returns 0 if the polygon has no area or a corner is not finite. */
static inline int polygon_project(const double *positions, const uint32_t *corner, size_t n, polygon_point *out) {
    double area[3] = {0, 0, 0};
    double most = 0;
    int exponent;
    int axis;
    size_t i;
    int k;
    for (i = 0; i < n; i++) {
        for (k = 0; k < 3; k++) {
            double size = fabs(positions[3 * (size_t)corner[i] + (size_t)k]);
            if (!(size <= 1.7976931348623157e308)) {
                return 0;
            }
            most = size > most ? size : most;
        }
    }
    frexp(most, &exponent);
    for (i = 0; i < n; i++) {
        const double *o = positions + 3 * (size_t)corner[0];
        const double *p = positions + 3 * (size_t)corner[i];
        const double *q = positions + 3 * (size_t)corner[i + 1 < n ? i + 1 : 0];
        for (k = 0; k < 3; k++) {
            int b = (k + 1) % 3;
            int c = (k + 2) % 3;
            double p_b = ldexp(p[b], -exponent) - ldexp(o[b], -exponent);
            double p_c = ldexp(p[c], -exponent) - ldexp(o[c], -exponent);
            double q_b = ldexp(q[b], -exponent) - ldexp(o[b], -exponent);
            double q_c = ldexp(q[c], -exponent) - ldexp(o[c], -exponent);
            area[k] += p_b * q_c - p_c * q_b;
        }
    }
    axis = fabs(area[0]) > fabs(area[1]) ? 0 : 1;
    axis = fabs(area[axis]) > fabs(area[2]) ? axis : 2;
    if (area[axis] == 0) {
        return 0;
    }
    for (i = 0; i < n; i++) {
        const double *p = positions + 3 * (size_t)corner[i];
        int b = (axis + (area[axis] > 0 ? 1 : 2)) % 3;
        int c = (axis + (area[axis] > 0 ? 2 : 1)) % 3;
        out[i][0] = ldexp(p[b], -exponent);
        out[i][1] = ldexp(p[c], -exponent);
    }
    return 1;
}

/* ---- 3. Fans ------------------------------------------------------------------------------------ */

/* Are all corners seen from corner `first` one after the other, within half a turn? Then a fan covers the
 * polygon, each point once. Two triangles cannot turn all the way round: a quad may fill more than half a turn. */
static inline int polygon_is_fan(polygon_point *p, size_t n, size_t first) {
    const double *o = p[first];
    const double *start = p[(first + 1) % n];
    size_t i;
    for (i = 1; i + 1 < n; i++) {
        const double *a = p[(first + i) % n];
        const double *b = p[(first + i + 1) % n];
        if (polygon_turn(o, a, b) < 0 || (n > 4 && polygon_turn(o, start, b) < 0)) {
            return 0;
        }
    }
    return 1;
}

static inline void polygon_fan(const uint32_t *corner, size_t n, size_t first, uint32_t *out) {
    size_t i;
    for (i = 1; i + 1 < n; i++) {
        *out++ = corner[first];
        *out++ = corner[(first + i) % n];
        *out++ = corner[(first + i + 1) % n];
    }
}

/* ---- 4. Crossings ------------------------------------------------------------------------------- */

/* Do the insides of the segments a b and c d meet in one point, crossing? */
static inline int polygon_cross(const double *a, const double *b, const double *c, const double *d) {
    double a_low = a[0] < b[0] ? a[0] : b[0];
    double a_high = a[0] < b[0] ? b[0] : a[0];
    double c_low = c[0] < d[0] ? c[0] : d[0];
    double c_high = c[0] < d[0] ? d[0] : c[0];
    return a_high >= c_low && c_high >= a_low && polygon_turn(a, b, c) * polygon_turn(a, b, d) < 0
        && polygon_turn(c, d, a) * polygon_turn(c, d, b) < 0;
}

static inline int polygon_crosses_itself(polygon_point *p, size_t n) {
    size_t i;
    size_t j;
    for (i = 0; i < n; i++) {
        for (j = i + 2; j < n; j++) {
            if (polygon_cross(p[i], p[i + 1 < n ? i + 1 : 0], p[j], p[j + 1 < n ? j + 1 : 0])) {
                return 1;
            }
        }
    }
    return 0;
}

/* ---- 5. Ears ------------------------------------------------------------------------------------ */

/* Does the triangle a, b, c, turning left, hold the point? Its border counts if `closed`. */
static inline int polygon_holds(const double *a, const double *b, const double *c, const double *q, int closed) {
    int least = closed ? 0 : 1;
    return polygon_turn(a, b, q) >= least && polygon_turn(b, c, q) >= least && polygon_turn(c, a, q) >= least;
}

/* Can corner i be cut off? strictness 2: no other corner in its closed triangle; 1: none inside it; 0: it lies
 * straight between its neighbours, or is the tip of a spike. */
static inline int polygon_is_ear(polygon_point *p, const size_t *next, size_t before, size_t i, int strictness) {
    const double *a = p[before];
    const double *b = p[i];
    const double *c = p[next[i]];
    int turn = polygon_turn(a, b, c);
    size_t j;
    if (turn <= 0) {
        return turn == 0 && strictness == 0;
    }
    for (j = next[next[i]]; j != before; j = next[j]) {
        if (!polygon_same(p[j], a) && !polygon_same(p[j], b) && !polygon_same(p[j], c)
            && polygon_holds(a, b, c, p[j], strictness == 2)) {
            return 0;
        }
    }
    return strictness > 0;
}

/* Cuts ears off until three corners are left. Returns 0 if no ear is found: then the polygon crosses itself. */
static inline int polygon_cut_ears(polygon_point *p, const uint32_t *corner, size_t n, size_t *next,
                                   uint32_t *out) {
    size_t before = n - 1;
    size_t left = n;
    size_t tried = 0;
    size_t i;
    int strictness = 2;
    for (i = 0; i < n; i++) {
        next[i] = i + 1 < n ? i + 1 : 0;
    }
    while (left > 2) {
        i = next[before];
        if (left == 3 || polygon_is_ear(p, next, before, i, strictness)) {
            *out++ = corner[before];
            *out++ = corner[i];
            *out++ = corner[next[i]];
            next[before] = next[i];
            left -= 1;
            tried = 0;
            strictness = 2;
            before = next[before];      /* not the same corner again and again: slivers */
            continue;
        }
        before = i;
        tried += 1;
        if (tried == left) {
            tried = 0;
            strictness -= 1;
            if (strictness < 0) {
                return 0;
            }
        }
    }
    return 1;
}

/* ---- 6. Any polygon ------------------------------------------------------------------------------ */

/* Where the edges a b and c d of a quad that crosses itself do so, on a b. */
static inline void polygon_crossing(const double *positions, const uint32_t edge[2], const double *a,
                                    const double *b, const double *c, const double *d, double out[3]) {
    const double *from = positions + 3 * (size_t)edge[0];
    const double *to = positions + 3 * (size_t)edge[1];
    const double at_a = (a[0] - c[0]) * (d[1] - c[1]) - (a[1] - c[1]) * (d[0] - c[0]);
    const double at_b = (b[0] - c[0]) * (d[1] - c[1]) - (b[1] - c[1]) * (d[0] - c[0]);
    double t = at_a / (at_a - at_b);
    int k;
    t = t >= 0 && t <= 1 ? t : 0.5;
    for (k = 0; k < 3; k++) {
        out[k] = from[k] + t * (to[k] - from[k]);
    }
}

/* Cuts a polygon into n - 2 triangles.
 *
 *   positions   of all vertices, x, y, z
 *   corner      the polygon's n >= 3 vertices, in order, either way round
 *   out         3*(n - 2) vertices
 *   spare       the number of a vertex that may be added; its position is written to out_spare
 *
 * Returns 1; 2 if the added vertex is used (a quad that crosses itself becomes two triangles that meet there: what
 * an even-odd fill covers); 0 if the polygon crosses itself; -1 if memory is short or it has over POLYGON_MOST
 * corners. A polygon without area, or with a corner that is not finite, becomes a fan.
 */
static inline int polygon_cut(const double *positions, const uint32_t *corner, size_t n, uint32_t *out,
                              uint32_t spare, double out_spare[3]) {
    polygon_point few[4];
    polygon_point *p = few;
    size_t *next = NULL;
    int status = 1;
    if (n > POLYGON_MOST) {
        return -1;
    }
    if (n > 4) {
        p = (polygon_point *)malloc(n * sizeof *p);
        next = (size_t *)malloc(n * sizeof *next);
    }
    if (!p || (n > 4 && !next)) {
        status = -1;
    } else if (n == 3 || !polygon_project(positions, corner, n, p) || polygon_is_fan(p, n, 0)) {
        polygon_fan(corner, n, 0, out);
    } else if (n == 4 && polygon_is_fan(p, n, 1)) {
        polygon_fan(corner, n, 1, out);
    } else if (n == 4) {
        size_t i = polygon_cross(p[0], p[1], p[2], p[3]) ? 0 : 1;      /* edges i and i + 2 cross, or touch */
        uint32_t edge[2];
        edge[0] = corner[i];
        edge[1] = corner[i + 1];
        polygon_crossing(positions, edge, p[i], p[i + 1], p[i + 2], p[(i + 3) % 4], out_spare);
        out[0] = spare;
        out[1] = corner[i + 1];
        out[2] = corner[i + 2];
        out[3] = spare;
        out[4] = corner[(i + 3) % 4];
        out[5] = corner[i];
        status = 2;
    } else if (polygon_crosses_itself(p, n) || !polygon_cut_ears(p, corner, n, next, out)) {
        status = 0;
    }
    if (n > 4) {
        free(p);
        free(next);
    }
    return status;
}

#endif /* EXAMPLES_MESH_POLYGON_H */
