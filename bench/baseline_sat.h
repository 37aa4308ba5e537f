/* baseline_sat.h - the separating axis test of [AM01] in plain floating point: the bounding box first,
 * min/max form.
 *
 * Included once per type by baseline.h, with SAT_REAL (float or double), SAT_ABS and SAT_NAME set. The forms
 * differ only in where they branch. Which is fastest depends on the compiler and on how predictable the
 * answers are, so the bench runs all and compares with the fastest.
 */

BASELINE_FN SAT_REAL SAT_NAME(min)(SAT_REAL a, SAT_REAL b)
{
    return a < b ? a : b;
}

BASELINE_FN SAT_REAL SAT_NAME(max)(SAT_REAL a, SAT_REAL b)
{
    return a > b ? a : b;
}

/* Box and triangle apart along a coordinate axis. */
BASELINE_FN int SAT_NAME(face_parts)(SAT_REAL a, SAT_REAL b, SAT_REAL c, SAT_REAL low, SAT_REAL high)
{
    return SAT_NAME(min)(SAT_NAME(min)(a, b), c) > high || SAT_NAME(max)(SAT_NAME(max)(a, b), c) < low;
}

/* The gap between box and triangle along the axis (0, -ec, eb), positive when it separates. (pb,pc) and
 * (qb,qc) are two corners, one of them on the edge e: the edge's ends project to one value. (hb,hc) is half
 * the box. */
BASELINE_FN SAT_REAL SAT_NAME(edge_gap)(SAT_REAL eb, SAT_REAL ec, SAT_REAL pb, SAT_REAL pc, SAT_REAL qb,
                                        SAT_REAL qc, SAT_REAL hb, SAT_REAL hc)
{
    SAT_REAL p = eb * pc - ec * pb;
    SAT_REAL q = eb * qc - ec * qb;
    SAT_REAL radius = hb * SAT_ABS(ec) + hc * SAT_ABS(eb);
    return SAT_NAME(max)(SAT_NAME(min)(p, q), -SAT_NAME(max)(p, q)) - radius;
}

/* The largest gap along the three axes that one coordinate axis forms with the edges. */
BASELINE_FN SAT_REAL SAT_NAME(edge_gaps)(SAT_REAL ab, SAT_REAL ac, SAT_REAL bb, SAT_REAL bc, SAT_REAL cb,
                                         SAT_REAL cc, SAT_REAL hb, SAT_REAL hc)
{
    SAT_REAL g0 = SAT_NAME(edge_gap)(bb - ab, bc - ac, ab, ac, cb, cc, hb, hc);
    SAT_REAL g1 = SAT_NAME(edge_gap)(cb - bb, cc - bc, bb, bc, ab, ac, hb, hc);
    SAT_REAL g2 = SAT_NAME(edge_gap)(ab - cb, ac - cc, cb, cc, bb, bc, hb, hc);
    return SAT_NAME(max)(SAT_NAME(max)(g0, g1), g2);
}

/* The triangle relative to the box's centre, and half the box. */
typedef struct SAT_NAME(frame) {
    SAT_REAL a[3], b[3], c[3], half[3];
} SAT_NAME(frame);

BASELINE_FN void SAT_NAME(centre)(SAT_NAME(frame) *f, const SAT_REAL v0[3], const SAT_REAL v1[3],
                                  const SAT_REAL v2[3], const SAT_REAL box_min[3], const SAT_REAL box_max[3])
{
    int k;
    for (k = 0; k < 3; k++) {
        SAT_REAL centre = (SAT_REAL)0.5 * (box_min[k] + box_max[k]);
        f->half[k] = box_max[k] - centre;
        f->a[k] = v0[k] - centre;
        f->b[k] = v1[k] - centre;
        f->c[k] = v2[k] - centre;
    }
}

/* The largest gap along the coordinate axes. */
BASELINE_FN SAT_REAL SAT_NAME(face_gap)(const SAT_NAME(frame) *f)
{
    SAT_REAL gap = -f->half[0];
    int k;
    for (k = 0; k < 3; k++) {
        SAT_REAL low = SAT_NAME(min)(SAT_NAME(min)(f->a[k], f->b[k]), f->c[k]);
        SAT_REAL high = SAT_NAME(max)(SAT_NAME(max)(f->a[k], f->b[k]), f->c[k]);
        gap = SAT_NAME(max)(gap, SAT_NAME(max)(low, -high) - f->half[k]);
    }
    return gap;
}

/* The gap along the triangle's normal. */
BASELINE_FN SAT_REAL SAT_NAME(plane_gap)(const SAT_NAME(frame) *f)
{
    SAT_REAL ex = f->b[0] - f->a[0];
    SAT_REAL ey = f->b[1] - f->a[1];
    SAT_REAL ez = f->b[2] - f->a[2];
    SAT_REAL gx = f->c[0] - f->a[0];
    SAT_REAL gy = f->c[1] - f->a[1];
    SAT_REAL gz = f->c[2] - f->a[2];
    SAT_REAL nx = ey * gz - ez * gy;
    SAT_REAL ny = ez * gx - ex * gz;
    SAT_REAL nz = ex * gy - ey * gx;
    SAT_REAL distance = nx * f->a[0] + ny * f->a[1] + nz * f->a[2];
    SAT_REAL radius = SAT_ABS(nx) * f->half[0] + SAT_ABS(ny) * f->half[1] + SAT_ABS(nz) * f->half[2];
    return SAT_ABS(distance) - radius;
}

#define SAT_APART(k) SAT_NAME(face_parts)(v0[k], v1[k], v2[k], box_min[k], box_max[k])
#define SAT_EDGE(e, f, p, q, b, c)                                                                \
    (SAT_NAME(edge_gap)(t->f[b] - t->e[b], t->f[c] - t->e[c], t->p[b], t->p[c], t->q[b], t->q[c], \
                        t->half[b], t->half[c]) > 0)
#define SAT_EDGES(b_, c_) \
    SAT_NAME(edge_gaps)(t.a[b_], t.a[c_], t.b[b_], t.b[c_], t.c[b_], t.c[c_], t.half[b_], t.half[c_])

/* The plane and the edges, leaving at the first that separates. */
BASELINE_FN int SAT_NAME(centred_early)(const SAT_NAME(frame) *t)
{
    if (SAT_NAME(plane_gap)(t) > 0) {
        return 0;
    }
    return !(SAT_EDGE(a, b, a, c, 1, 2) || SAT_EDGE(b, c, b, a, 1, 2) || SAT_EDGE(c, a, c, b, 1, 2) ||
             SAT_EDGE(a, b, a, c, 2, 0) || SAT_EDGE(b, c, b, a, 2, 0) || SAT_EDGE(c, a, c, b, 2, 0) ||
             SAT_EDGE(a, b, a, c, 0, 1) || SAT_EDGE(b, c, b, a, 0, 1) || SAT_EDGE(c, a, c, b, 0, 1));
}

/* Leaves at the first separating axis. */
BASELINE_FN int SAT_NAME(early)(const SAT_REAL v0[3], const SAT_REAL v1[3], const SAT_REAL v2[3],
                                const SAT_REAL box_min[3], const SAT_REAL box_max[3])
{
    SAT_NAME(frame) t;
    if (SAT_APART(0) || SAT_APART(1) || SAT_APART(2)) {
        return 0;
    }
    SAT_NAME(centre)(&t, v0, v1, v2, box_min, box_max);
    return SAT_NAME(centred_early)(&t);
}

/* Leaves after the faces; the other ten axes are one sum without a branch. */
BASELINE_FN int SAT_NAME(faces_first)(const SAT_REAL v0[3], const SAT_REAL v1[3], const SAT_REAL v2[3],
                                      const SAT_REAL box_min[3], const SAT_REAL box_max[3])
{
    SAT_NAME(frame) t;
    SAT_REAL gap;
    if (SAT_APART(0) | SAT_APART(1) | SAT_APART(2)) {
        return 0;
    }
    SAT_NAME(centre)(&t, v0, v1, v2, box_min, box_max);
    gap = SAT_NAME(max)(SAT_EDGES(1, 2), SAT_EDGES(2, 0));
    return !(SAT_NAME(max)(SAT_NAME(max)(gap, SAT_EDGES(0, 1)), SAT_NAME(plane_gap)(&t)) > 0);
}

/* No branch at all. */
BASELINE_FN int SAT_NAME(branchless)(const SAT_REAL v0[3], const SAT_REAL v1[3], const SAT_REAL v2[3],
                                     const SAT_REAL box_min[3], const SAT_REAL box_max[3])
{
    SAT_NAME(frame) t;
    SAT_REAL gap;
    SAT_NAME(centre)(&t, v0, v1, v2, box_min, box_max);
    gap = SAT_NAME(max)(SAT_EDGES(1, 2), SAT_EDGES(2, 0));
    gap = SAT_NAME(max)(SAT_NAME(max)(gap, SAT_EDGES(0, 1)), SAT_NAME(plane_gap)(&t));
    return !(SAT_NAME(max)(gap, SAT_NAME(face_gap)(&t)) > 0);
}

/* ---- The same axes from three cross products ---- */

/* With a, b, c relative to the box's centre, the edge b - a puts the triangle on the axes (b - a) x (unit
 * vectors) at
 * -(a x b) and n - (a x b), where n = a x b + b x c + c x a is the normal: centre n/2 - a x b, half length
 * |n/2|. The plane's distance is n.a. Half the multiplications of the forms above, and absolute values in
 * place of min and max. */
BASELINE_FN SAT_REAL SAT_NAME(crossed_gaps)(SAT_REAL ab, SAT_REAL ac, SAT_REAL bb, SAT_REAL bc, SAT_REAL cb,
                                            SAT_REAL cc, SAT_REAL hb, SAT_REAL hc, SAT_REAL *out_normal)
{
    SAT_REAL a_b = ab * bc - ac * bb;
    SAT_REAL b_c = bb * cc - bc * cb;
    SAT_REAL c_a = cb * ac - cc * ab;
    SAT_REAL n = a_b + b_c + c_a;
    SAT_REAL m = (SAT_REAL)0.5 * n;
    SAT_REAL w = SAT_ABS(m);
    SAT_REAL g0 = SAT_ABS(m - a_b) - w - (hb * SAT_ABS(bc - ac) + hc * SAT_ABS(bb - ab));
    SAT_REAL g1 = SAT_ABS(m - b_c) - w - (hb * SAT_ABS(cc - bc) + hc * SAT_ABS(cb - bb));
    SAT_REAL g2 = SAT_ABS(m - c_a) - w - (hb * SAT_ABS(ac - cc) + hc * SAT_ABS(ab - cb));
    *out_normal = n;
    return SAT_NAME(max)(SAT_NAME(max)(g0, g1), g2);
}

#define SAT_CROSSED(b_, c_, n) \
    SAT_NAME(crossed_gaps)     \
    (t->a[b_], t->a[c_], t->b[b_], t->b[c_], t->c[b_], t->c[c_], t->half[b_], t->half[c_], n)

/* The largest gap along the normal and the nine edge axes. */
BASELINE_FN SAT_REAL SAT_NAME(crossed_gap)(const SAT_NAME(frame) *t)
{
    SAT_REAL n[3];
    SAT_REAL edges = SAT_NAME(max)(SAT_NAME(max)(SAT_CROSSED(1, 2, &n[0]), SAT_CROSSED(2, 0, &n[1])),
                                   SAT_CROSSED(0, 1, &n[2]));
    SAT_REAL distance = n[0] * t->a[0] + n[1] * t->a[1] + n[2] * t->a[2];
    SAT_REAL radius = SAT_ABS(n[0]) * t->half[0] + SAT_ABS(n[1]) * t->half[1] + SAT_ABS(n[2]) * t->half[2];
    return SAT_NAME(max)(edges, SAT_ABS(distance) - radius);
}

/* Leaves after the faces. */
BASELINE_FN int SAT_NAME(crossed)(const SAT_REAL v0[3], const SAT_REAL v1[3], const SAT_REAL v2[3],
                                  const SAT_REAL box_min[3], const SAT_REAL box_max[3])
{
    SAT_NAME(frame) t;
    if (SAT_APART(0) | SAT_APART(1) | SAT_APART(2)) {
        return 0;
    }
    SAT_NAME(centre)(&t, v0, v1, v2, box_min, box_max);
    return !(SAT_NAME(crossed_gap)(&t) > 0);
}

/* No branch at all. */
BASELINE_FN int SAT_NAME(crossed_branchless)(const SAT_REAL v0[3], const SAT_REAL v1[3], const SAT_REAL v2[3],
                                             const SAT_REAL box_min[3], const SAT_REAL box_max[3])
{
    SAT_NAME(frame) t;
    SAT_NAME(centre)(&t, v0, v1, v2, box_min, box_max);
    return !(SAT_NAME(max)(SAT_NAME(crossed_gap)(&t), SAT_NAME(face_gap)(&t)) > 0);
}

#undef SAT_CROSSED
#undef SAT_APART
#undef SAT_EDGE
#undef SAT_EDGES
#undef SAT_REAL
#undef SAT_ABS
#undef SAT_NAME
