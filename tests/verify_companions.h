/* Hard questions to the companions for verify.c and the fuzzers' seeds: rays through edges and corners, boxes
 * that come into contact at simple times, points as near to an edge as to a corner, and their neighbours.
 */
#ifndef VERIFY_COMPANIONS_H
#define VERIFY_COMPANIONS_H

#include "companions_exact.h"
#include "verify_cases.h"

/* the numbers of a question as bit patterns, rounded to its format */
static inline void companion_write(companion *c, const double x[COMPANION_NUMBERS])
{
    int i;
    for (i = 0; i < COMPANION_NUMBERS; ++i) {
        if (c->f64) {
            memcpy(&c->x[i], &x[i], sizeof x[i]);
        } else {
            float f = is_finite(x[i]) ? (float)number_fit(x[i], 0) : (float)x[i];
            uint32_t word;
            memcpy(&word, &f, sizeof word);
            c->x[i] = word;
        }
    }
}

/* a small eighth, a power of two, or anything */
static inline double companion_moment(dice *d)
{
    switch (dice_below(d, 4)) {
    case 0:
        return (double)dice_between(d, -8, 16) / 8.0;
    case 1:
        return power_of_two(dice_between(d, -20, 20));
    case 2:
        return dice_unit(d);
    default:
        return 3.0 * dice_signed(d);
    }
}

/* a direction: lattice, along axes, along an edge or the normal of the triangle, any; of any length */
static inline void companion_direction(dice *d, const double v[9], double w[3])
{
    int how = dice_below(d, 8);
    int i = dice_below(d, 3);
    int k;
    for (k = 0; k < 3; ++k) {
        w[k] = how == 0   ? (double)dice_between(d, -3, 3)
               : how == 1 ? dice_signed(d) * (double)dice_below(d, 2)
               : how == 2 ? v[3 * ((i + 1) % 3) + k] - v[3 * i + k]
               : how == 3 ? (v[3 + k] - v[k]) * (double)dice_between(d, -2, 2) +
                                (v[6 + k] - v[k]) * (double)dice_between(d, -2, 2)
                          : dice_signed(d);
    }
    if (how == 4) {
        shape_normal(v, w);
    }
    if (dice_once_in(d, 4)) {
        double length = power_of_two(dice_between(d, -30, 30));
        for (k = 0; k < 3; ++k) {
            w[k] *= length;
        }
    }
}

/* the ends of t around the moment at which something happens */
static inline void companion_ends(dice *d, double at, double *t_min, double *t_max)
{
    const double infinite = bits_double(UINT64_C(0x7ff) << 52);
    int how = dice_below(d, 6);
    *t_min = how == 0 ? -infinite : how == 1 ? at : how == 2 ? at - dice_unit(d) : 0.0;
    *t_max = dice_once_in(d, 3) ? infinite : dice_once_in(d, 3) ? at : at + 2.0 * dice_signed(d);
    if (dice_once_in(d, 8)) {
        *t_max = *t_min;
    }
}

/* a point of the box: a corner, a point of an edge or face, inside, or just outside */
static inline void companion_box_point(dice *d, const double box[6], double out[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        int how = dice_below(d, 6);
        double t = dice_once_in(d, 2) ? dice_unit(d) : (double)dice_between(d, 0, 8) / 8.0;
        out[k] = how < 2 ? box[3 * how + k] : box[k] + t * (box[3 + k] - box[k]);
        if (how == 5 && dice_once_in(d, 4)) {
            out[k] = box[3 + k] + t * (box[3 + k] - box[k]);
        }
    }
}

/* a line through a point: origin, direction and ends */
static inline void companion_line(dice *d, const double point[3], double x[COMPANION_NUMBERS])
{
    double at = companion_moment(d);
    int k;
    companion_direction(d, x, x + COMPANION_W);
    for (k = 0; k < 3; ++k) {
        x[COMPANION_W + k] = number_fit(x[COMPANION_W + k], 0);
        x[COMPANION_O + k] = point[k] - at * x[COMPANION_W + k];
    }
    companion_ends(d, at, x + COMPANION_T0, x + COMPANION_T1);
}

/* for the nearest point: near the border between a corner's, an edge's and the face's region */
static inline void companion_near(dice *d, double x[COMPANION_NUMBERS])
{
    double n[3], point[3], out[3];
    int how = dice_below(d, 4);
    int i = dice_below(d, 3);
    int k;
    double up = dice_once_in(d, 3) ? 0.0 : companion_moment(d);
    double away = dice_once_in(d, 2) ? 0.0 : companion_moment(d);
    shape_normal(x, n);
    shape_point(d, x, dice_between(d, 1, 3), point);
    for (k = 0; k < 3; ++k) { /* edge x normal: in the plane, across edge i */
        int b = (k + 1) % 3;
        int c = (k + 2) % 3;
        int j = (i + 1) % 3;
        out[k] = (x[3 * j + b] - x[3 * i + b]) * n[c] - (x[3 * j + c] - x[3 * i + c]) * n[b];
    }
    for (k = 0; k < 3; ++k) {
        double from = how == 0 ? point[k] : x[3 * i + k];
        x[COMPANION_O + k] = how == 3 ? 2.0 * dice_signed(d) : from + up * n[k] + away * out[k];
    }
}

static inline void companion_boxes(dice *d, double x[COMPANION_NUMBERS])
{
    int k;
    for (k = 0; k < 3; ++k) {
        double *w = x + COMPANION_W + k;
        double *o = x + COMPANION_O + k;
        *w = x[COMPANION_LO + k] - dice_unit(d);
        *o = *w + 2.0 * dice_unit(d);
        if (dice_once_in(d, 2)) {
            *w = x[COMPANION_HI + k];
            *o = *w + dice_unit(d);
        } else if (dice_once_in(d, 4)) {
            *o = x[COMPANION_LO + k];
        }
        if (dice_once_in(d, 16)) {
            *o = *w;
        }
    }
}

static inline void companion_plane(dice *d, double x[COMPANION_NUMBERS])
{
    double sum = 0.0;
    int k;
    int how = dice_below(d, 4);
    int a = dice_below(d, 3);
    companion_direction(d, x, x + COMPANION_W);
    for (k = 0; k < 3; ++k) {
        if (how == 0) {
            x[COMPANION_W + k] = (double)dice_between(d, -3, 3);
        } else if (how == 1) { /* a face's plane */
            x[COMPANION_W + k] = k == a ? power_of_two(dice_between(d, -3, 3)) : 0.0;
        }
        x[COMPANION_W + k] = number_fit(x[COMPANION_W + k], 0);
        sum += x[COMPANION_W + k] * x[(dice_once_in(d, 2) ? COMPANION_LO : COMPANION_HI) + k];
    }
    x[COMPANION_T0] = -sum;
}

static inline void companion_octant(dice *d, companion *c, double x[COMPANION_NUMBERS])
{
    question ask;
    int k;
    memset(&ask, 0, sizeof ask);
    memcpy(ask.x, x, sizeof ask.x);
    case_as_tri(&ask, c->f64);
    memcpy(x, ask.x, sizeof ask.x);
    for (k = 0; k < 3; ++k) {
        double *p = x + COMPANION_LO + k;
        double size = x[COMPANION_HI + k];
        if (is_finite(*p) && is_finite(size) && dice_once_in(d, 2) && is_finite(*p - size)) {
            *p -= size;
        }
        if (c->f64 && dice_once_in(d, 3)) { /* p + size is no double, but rounds to a corner */
            x[COMPANION_HI + k] = dice_unit(d) * power_of_two(-dice_below(d, 40));
            *p = x[3 * dice_below(d, 3) + k] - (double)dice_between(d, 1, 2) * x[COMPANION_HI + k];
        }
        x[COMPANION_W + k] = dice_unit(d);
    }
    c->flags = dice_once_in(d, 8) ? (unsigned)dice_below(d, 16) : 1u << dice_below(d, 4) >> 1;
}

/* ---- contact ---------------------------------------------------------------------------------- */

/* an integer vector whose length is one, too, in any order and direction */
static inline double contact_triple(dice *d, double out[3])
{
    static const signed char triples[8][4] = {{1, 0, 0, 1}, {3, 4, 0, 5}, {1, 2, 2, 3},   {2, 3, 6, 7},
                                              {4, 4, 7, 9}, {1, 4, 8, 9}, {5, 12, 0, 13}, {2, 6, 9, 11}};
    const signed char *t = triples[dice_below(d, 8)];
    const int turn = dice_below(d, 3);
    int k;
    for (k = 0; k < 3; ++k) {
        out[k] = (double)t[(k + turn) % 3] * (dice_once_in(d, 2) ? 1.0 : -1.0);
    }
    return (double)t[3];
}

/* a sphere about o that touches the point at a length that is an integer, or nearly, or not */
static inline void contact_ball(dice *d, const double point[3], double x[COMPANION_NUMBERS])
{
    double w[3];
    double length = contact_triple(d, w);
    double size = dice_once_in(d, 2) ? 1.0 : dice_once_in(d, 2) ? dice_unit(d) : power_of_two(dice_between(d, -9, 3));
    int k;
    if (dice_once_in(d, 4)) { /* along the triangle's normal */
        shape_normal(x, w);
        length = dice_unit(d) * 3.0;
    }
    for (k = 0; k < 3; ++k) {
        x[COMPANION_O + k] = point[k] + w[k] * size;
    }
    x[COMPANION_T0] = length * size;
    if (dice_once_in(d, 6)) {
        x[COMPANION_T0] = dice_once_in(d, 4) ? 0.0 : 2.0 * dice_unit(d);
    }
}

/* a line through or past the sphere: from w along box_min, t from box_max[0] to t_max */
static inline void contact_line(dice *d, double x[COMPANION_NUMBERS])
{
    double point[3], w[3], length = contact_triple(d, w);
    double at = companion_moment(d);
    const double radius = x[COMPANION_T0];
    int k;
    for (k = 0; k < 3; ++k) { /* a point of the sphere, if 1/length is exact, or near it */
        point[k] = x[COMPANION_O + k] + w[k] * (radius / length);
    }
    companion_direction(d, x, x + COMPANION_LO);
    if (dice_once_in(d, 3)) { /* across the way to the centre: the line grazes */
        double v[3];
        const int a = dice_below(d, 3);
        v[a] = 0.0;
        v[(a + 1) % 3] = w[(a + 2) % 3];
        v[(a + 2) % 3] = -w[(a + 1) % 3];
        memcpy(x + COMPANION_LO, v, sizeof v);
    }
    for (k = 0; k < 3; ++k) {
        x[COMPANION_LO + k] = number_fit(x[COMPANION_LO + k], 0);
        x[COMPANION_W + k] = point[k] - at * x[COMPANION_LO + k];
    }
    companion_ends(d, at, x + COMPANION_HI, x + COMPANION_T1);
}

/* where the region begins: such that the segment is in it, or nearly */
static inline void contact_place_region(dice *d, companion *c)
{
    double at[3];
    int k;
    for (k = 0; k < 3; ++k) {
        const double p = companion_number(c->x[(dice_once_in(d, 2) ? COMPANION_W : COMPANION_O) + k], 1);
        const double origin = companion_number(c->x[k], 1);
        const double size = companion_number(c->x[3 + k], 1);
        double i = 0.0;
        if (is_finite(p) && is_finite(origin) && is_finite(size) && sign_of_double(size) > 0) {
            i = (p / 2.0 - origin / 2.0) / size * 2.0;
        }
        at[k] = i > -8000000.0 && i < 8000000.0 ? i : 0.0;
        c->x[6 + k] = (uint64_t)(0x800000 + (int)at[k] - dice_between(d, 0, 4));
    }
}

static inline void contact_segment(dice *d, companion *c, double x[COMPANION_NUMBERS])
{
    const int how = dice_below(d, 4); /* whole steps; tenths; anything; along a plane */
    double step[3];
    int k;
    for (k = 0; k < 3; ++k) {
        int i = dice_between(d, -3, 4);
        int j = dice_between(d, -3, 4);
        step[k] = how == 1 ? 0.1 : how == 2 ? dice_unit(d) + 0.01 : power_of_two(dice_between(d, -2, 2));
        x[k] = how == 2 ? dice_signed(d) : step[k] * (double)dice_between(d, -50, 50);
        x[3 + k] = step[k];
        x[COMPANION_W + k] = x[k] + step[k] * (double)i;
        x[COMPANION_O + k] = x[k] + step[k] * (double)j;
        if (!dice_once_in(d, 2)) {
            x[COMPANION_W + k] += step[k] * (double)dice_below(d, 8) / 8.0;
            x[COMPANION_O + k] += step[k] * (how == 2 ? dice_unit(d) : (double)dice_below(d, 8) / 8.0);
        }
        if (dice_once_in(d, how == 3 ? 2 : 6)) {
            x[COMPANION_O + k] = x[COMPANION_W + k];
        }
    }
    c->flags = dice_once_in(d, 8) ? (unsigned)dice_below(d, 16) : 1u << dice_below(d, 4) >> 1;
}

static inline void contact_make(dice *d, companion *c, double x[COMPANION_NUMBERS])
{
    double point[3], w[3], at;
    int k;
    c->flags = dice_once_in(d, 4) ? (unsigned)dice_below(d, 16) : dice_once_in(d, 4) ? 0u : 2u;
    shape_point(d, x, dice_between(d, 1, 3), point);
    switch (c->which) {
    case COMPANION_SWEEP_RULE:
    case COMPANION_SWEEP_BOX:
    case COMPANION_GAP:
        at = dice_once_in(d, 4) ? 0.0 : companion_moment(d);
        companion_direction(d, x, x + COMPANION_W);
        for (k = 0; k < 3; ++k) {
            if (c->which == COMPANION_SWEEP_BOX) { /* box b: beside box a, or across it */
                const double size = dice_once_in(d, 8) ? 0.0 : dice_unit(d);
                x[k] = dice_once_in(d, 3)   ? x[COMPANION_HI + k]
                       : dice_once_in(d, 2) ? x[COMPANION_LO + k]
                                            : x[COMPANION_LO + k] - size;
                x[3 + k] = x[k] + size;
            }
            x[COMPANION_LO + k] -= at * x[COMPANION_W + k];
            x[COMPANION_HI + k] -= at * x[COMPANION_W + k];
        }
        if (c->which == COMPANION_GAP && dice_once_in(d, 4)) { /* about a corner, T perhaps level: directions tie */
            const int level = dice_below(d, 6);
            for (k = 0; k < 3; ++k) {
                const double half = (double)dice_between(d, 0, 8) / 8.0;
                x[k] = number_fit(x[k], 0);
                x[COMPANION_LO + k] = x[k] - half;
                x[COMPANION_HI + k] = x[k] + half;
                if (k == level) {
                    x[3 + k] = x[6 + k] = x[k];
                }
            }
        }
        break;
    case COMPANION_GRID_SEGMENT:
        contact_segment(d, c, x);
        break;
    case COMPANION_SPHERE_SPHERE:
    case COMPANION_PLANE_SPHERE:
        contact_ball(d, point, x);
        at = contact_triple(d, w);
        for (k = 0; k < 3; ++k) {
            x[COMPANION_W + k] = point[k];
        }
        x[COMPANION_T1] = 0.0;
        if (c->which == COMPANION_PLANE_SPHERE) { /* n.c + d = radius |n| */
            x[COMPANION_T1] = x[COMPANION_T0] * at * (dice_once_in(d, 2) ? 1.0 : -1.0);
            for (k = 0; k < 3; ++k) {
                x[COMPANION_W + k] = w[k];
                x[COMPANION_T1] -= w[k] * x[COMPANION_O + k];
            }
        } else if (dice_once_in(d, 2)) { /* both have a part of it */
            x[COMPANION_T1] = x[COMPANION_T0] * 0.25;
            x[COMPANION_T0] *= 0.75;
        }
        break;
    case COMPANION_SPHERE_BOX:
        companion_box_point(d, x + COMPANION_LO, point);
        contact_ball(d, point, x);
        break;
    case COMPANION_SPHERE_TRIANGLE:
        contact_ball(d, point, x);
        break;
    default:
        contact_ball(d, point, x);
        contact_line(d, x);
        break;
    }
}

/* one question to the function, with the triangle and box of the class (verify_cases.h) */
static inline void companion_make(dice *d, int which, int class, companion *c)
{
    double x[COMPANION_NUMBERS], point[3];
    int lattice = class == CASE_LATTICE;
    int i, k;
    memset(c, 0, sizeof *c);
    c->which = which;
    c->f64 = !companion_has_float(which) || (companion_has_f64(which) && dice_once_in(d, 2));
    case_make(d, class, c->f64, x);
    for (i = COMPANION_W; i < COMPANION_NUMBERS; ++i) {
        x[i] = lattice ? (double)dice_between(d, -8, 8) : 2.0 * dice_signed(d);
    }
    switch (which) {
    case COMPANION_BOX_BOX:
        companion_boxes(d, x);
        break;
    case COMPANION_PLANE_BOX:
        companion_plane(d, x);
        break;
    case COMPANION_SEGMENT_BOX:
    case COMPANION_RAY_BOX:
        companion_box_point(d, x + COMPANION_LO, point);
        companion_line(d, point, x);
        for (k = 0; k < 3 && which == COMPANION_SEGMENT_BOX; ++k) { /* from there on, or to there */
            x[COMPANION_W + k] = dice_once_in(d, 2) ? point[k] : x[COMPANION_O + k] + x[COMPANION_W + k];
        }
        break;
    case COMPANION_RAY_TRIANGLE:
        shape_point(d, x, dice_between(d, 1, 3), point);
        companion_line(d, point, x);
        break;
    case COMPANION_SWEEP: {
        double at = dice_once_in(d, 4) ? 0.0 : companion_moment(d);
        companion_direction(d, x, x + COMPANION_W);
        for (k = 0; k < 3; ++k) {
            x[COMPANION_LO + k] -= at * x[COMPANION_W + k];
            x[COMPANION_HI + k] -= at * x[COMPANION_W + k];
        }
        break;
    }
    case COMPANION_CLIP:
        for (k = 0, i = dice_below(d, 6); k < 3 && i < 2; ++k) { /* more of the triangle inside, or all */
            x[COMPANION_LO + k] -= dice_unit(d) * (i == 0 ? 1.0 : 8.0);
            x[COMPANION_HI + k] += dice_unit(d) * (i == 0 ? 1.0 : 8.0);
        }
        break;
    case COMPANION_CLOSEST:
        if (!lattice) {
            companion_near(d, x);
        }
        break;
    case COMPANION_OCTANTS:
        companion_octant(d, c, x);
        break;
    default:
        if (which > COMPANION_QUERY) {
            contact_make(d, c, x);
        }
        break;
    }
    for (i = 0; i < COMPANION_NUMBERS; ++i) { /* neighbours of what was meant */
        if (class != CASE_BITS && dice_once_in(d, 48)) {
            x[i] = number_step(number_fit(x[i], c->f64), dice_between(d, -2, 2), c->f64);
        }
    }
    if (class == CASE_EXTREME && dice_once_in(d, 2)) { /* what was added of the same size as the rest */
        double size = power_of_two(c->f64 ? dice_between(d, -1060, 1000) : dice_between(d, -140, 120));
        for (i = COMPANION_W; i < COMPANION_T0 + (which >= COMPANION_SPHERE_SPHERE); ++i) {
            x[i] *= size;
        }
    } else if (class == CASE_BITS) {
        for (i = COMPANION_W; i < COMPANION_NUMBERS; ++i) {
            x[i] = any_bits(d, c->f64);
        }
    } else if (class == CASE_SPECIAL && dice_once_in(d, 2)) {
        x[dice_between(d, COMPANION_W, COMPANION_T1)] = special_number(d, c->f64);
    }
    companion_write(c, x);
    if (which == COMPANION_GRID_SEGMENT) {
        contact_place_region(d, c);
    }
}

#endif
