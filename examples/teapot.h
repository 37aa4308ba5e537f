/* teapot.h - the Utah teapot, tessellated from its published control points
 *
 * Martin Newell's teapot of 1975 in its usual form: 32 bicubic Bezier patches, z up, the spout along +x.
 * Rim, body, lid and bottom are quarter turns of profile curves, with 0.56 (at the knob 0.5625) for the
 * circle; spout and handle are halves mirrored at y = 0. As published it isn't closed: a ring of 0.1 is
 * open between lid and rim, the spout is open at its tip, and spout and handle end inside the body.
 * `closed` adds flat caps there, which makes three closed surfaces that pass through each other.
 */
#ifndef EXAMPLES_TEAPOT_H
#define EXAMPLES_TEAPOT_H
#include "mesh_io.h"

typedef struct teapot_ring {
    double radius;
    double z;
    double circle;      /* the handles of a quarter circle stand at circle * radius */
} teapot_ring;

enum { TEAPOT_PROFILES = 6, TEAPOT_HALVES = 4, TEAPOT_PATCHES = 4 * TEAPOT_PROFILES + 2 * TEAPOT_HALVES };

/* Control point j of the curve i of patch `patch`: patches 0..23 are quarter turns, 24..31 halves. */
static inline void teapot_control_point(int patch, int i, int j, double out_point[3]) {
    static const teapot_ring profiles[TEAPOT_PROFILES][4] = {
        {{1.4, 2.4, .56}, {1.3375, 2.53125, .56}, {1.4375, 2.53125, .56}, {1.5, 2.4, .56}},     /* rim */
        {{1.5, 2.4, .56}, {1.75, 1.875, .56}, {2, 1.35, .56}, {2, .9, .56}},     /* body */
        {{2, .9, .56}, {2, .45, .56}, {1.5, .225, .56}, {1.5, .15, .56}},
        {{0, 3.15, .56}, {.8, 3.15, .5625}, {0, 2.85, .56}, {.2, 2.7, .56}},     /* lid */
        {{.2, 2.7, .56}, {.4, 2.55, .56}, {1.3, 2.55, .56}, {1.3, 2.4, .56}},
        {{1.5, .15, .56}, {1.5, .075, .56}, {1.425, 0, .56}, {0, 0, .56}}};     /* bottom */
    /* handle and spout on the side of y <= 0 */
    static const double halves[TEAPOT_HALVES][4][4][3] = {
        {{{-1.6, 0, 2.025}, {-1.6, -.3, 2.025}, {-1.5, -.3, 2.25}, {-1.5, 0, 2.25}},
         {{-2.3, 0, 2.025}, {-2.3, -.3, 2.025}, {-2.5, -.3, 2.25}, {-2.5, 0, 2.25}},
         {{-2.7, 0, 2.025}, {-2.7, -.3, 2.025}, {-3, -.3, 2.25}, {-3, 0, 2.25}},
         {{-2.7, 0, 1.8}, {-2.7, -.3, 1.8}, {-3, -.3, 1.8}, {-3, 0, 1.8}}},
        {{{-2.7, 0, 1.8}, {-2.7, -.3, 1.8}, {-3, -.3, 1.8}, {-3, 0, 1.8}},
         {{-2.7, 0, 1.575}, {-2.7, -.3, 1.575}, {-3, -.3, 1.35}, {-3, 0, 1.35}},
         {{-2.5, 0, 1.125}, {-2.5, -.3, 1.125}, {-2.65, -.3, .9375}, {-2.65, 0, .9375}},
         {{-2, 0, .9}, {-2, -.3, .9}, {-1.9, -.3, .6}, {-1.9, 0, .6}}},
        {{{1.7, 0, 1.425}, {1.7, -.66, 1.425}, {1.7, -.66, .6}, {1.7, 0, .6}},
         {{2.6, 0, 1.425}, {2.6, -.66, 1.425}, {3.1, -.66, .825}, {3.1, 0, .825}},
         {{2.3, 0, 2.1}, {2.3, -.25, 2.1}, {2.4, -.25, 2.025}, {2.4, 0, 2.025}},
         {{2.7, 0, 2.4}, {2.7, -.25, 2.4}, {3.3, -.25, 2.4}, {3.3, 0, 2.4}}},
        {{{2.7, 0, 2.4}, {2.7, -.25, 2.4}, {3.3, -.25, 2.4}, {3.3, 0, 2.4}},
         {{2.8, 0, 2.475}, {2.8, -.25, 2.475}, {3.525, -.25, 2.49375}, {3.525, 0, 2.49375}},
         {{2.9, 0, 2.475}, {2.9, -.15, 2.475}, {3.45, -.15, 2.5125}, {3.45, 0, 2.5125}},
         {{2.8, 0, 2.4}, {2.8, -.15, 2.4}, {3.2, -.15, 2.4}, {3.2, 0, 2.4}}}};
    static const int turns[5] = {1, 0, -1, 0, 1};       /* cosines of quarter turns */
    if (patch >= 4 * TEAPOT_PROFILES) {
        int half = patch - 4 * TEAPOT_PROFILES;
        memcpy(out_point, halves[half / 2][i][j], 3 * sizeof(double));
        out_point[1] *= half % 2 ? -1 : 1;
    } else {
        teapot_ring ring = profiles[patch / 4][i];
        double along = j == 0 ? 1 : j == 1 ? 1 : j == 2 ? ring.circle : 0;
        double across = j == 0 ? 0 : j == 1 ? ring.circle : 1;
        int c = turns[patch % 4];
        int s = turns[patch % 4 + 1];
        out_point[0] = ring.radius * (along * c + across * s);
        out_point[1] = ring.radius * (along * -s + across * c);
        out_point[2] = ring.z;
    }
}

/* The point at (u, v) of a patch, u across the four curves. At 0 and 1 the weights of the inner points are
   exactly 0, so patches that share a border get the same floats there. */
static inline void teapot_point(int patch, double u, double v, float out_point[3]) {
    double wu[4];
    double wv[4];
    double sum[3] = {0, 0, 0};
    int i;
    int j;
    int a;
    for (i = 0; i < 4; i++) {
        double choose = i == 0 || i == 3 ? 1 : 3;
        wu[i] = choose;
        wv[i] = choose;
        for (j = 0; j < 3; j++) {
            wu[i] *= j < i ? u : 1 - u;
            wv[i] *= j < i ? v : 1 - v;
        }
    }
    for (i = 0; i < 4; i++) {
        for (j = 0; j < 4; j++) {
            double point[3];
            teapot_control_point(patch, i, j, point);
            for (a = 0; a < 3; a++) {
                sum[a] += wu[i] * (wv[j] * point[a]);
            }
        }
    }
    for (a = 0; a < 3; a++) {
        out_point[a] = (float)sum[a] + 0.0f;        /* no -0.0f beside 0.0f where halves meet */
    }
}

/* A quadrilateral as two triangles, less those that have two corners in one place (at the poles of lid and
   bottom). */
static inline int teapot_add_quad(mesh_reader *r, float corner[4][3]) {
    uint32_t base = (uint32_t)r->out->vertices;
    uint32_t i;
    int ok = 1;
    for (i = 0; i < 4; i++) {
        double position[3];
        position[0] = (double)corner[i][0];
        position[1] = (double)corner[i][1];
        position[2] = (double)corner[i][2];
        ok = ok && mesh_add_vertex(r, position);
    }
    for (i = 1; i < 3; i++) {
        const float *b = corner[i];
        const float *c = corner[i + 1];
        if (memcmp(corner[0], b, 12) != 0 && memcmp(b, c, 12) != 0 && memcmp(corner[0], c, 12) != 0) {
            ok = ok && mesh_add_triangle(r, base, base + i, base + i + 1);
        }
    }
    return ok;
}

static inline int teapot_add_patch(mesh_reader *r, int patch, int n) {
    int i;
    int j;
    int k;
    for (i = 0; i < n; i++) {
        for (j = 0; j < n; j++) {
            float corner[4][3];
            for (k = 0; k < 4; k++) {       /* (0,0) (1,0) (1,1) (0,1) */
                teapot_point(patch, (double)(i + (k == 1 || k == 2)) / n, (double)(j + k / 2) / n, corner[k]);
            }
            if (!teapot_add_quad(r, corner)) {
                return 0;
            }
        }
    }
    return 1;
}

/* Closes the gap between the border u of one patch and the border `to_u` of another, or a point in the
   plane y = 0. */
static inline int teapot_add_cap(mesh_reader *r, int patch, double u, int to_patch, double to_u, int n) {
    int j;
    int k;
    for (j = 0; j < n; j++) {
        float corner[4][3];
        for (k = 0; k < 2; k++) {
            teapot_point(patch, u, (double)(j + k) / n, corner[k]);
            teapot_point(to_patch, to_u, to_patch == patch ? 0 : (double)(j + k) / n, corner[3 - k]);
        }
        if (!teapot_add_quad(r, corner)) {
            return 0;
        }
    }
    return 1;
}

/* The teapot with n x n quadrilaterals a patch. Returns 1, or 0 when memory is short. */
static inline int teapot_make(mesh *out, int n, int closed, char *error) {
    mesh_reader r;
    int patch;
    int ok = 1;
    memset(&r, 0, sizeof r);
    memset(out, 0, sizeof *out);
    r.path = "teapot";
    r.error = error;
    r.out = out;
    out->format = closed ? "the Utah teapot, closed by caps" : "the Utah teapot";
    for (patch = 0; ok && patch < TEAPOT_PATCHES; patch++) {
        int part = patch < 4 * TEAPOT_PROFILES ? -1 : (patch - 4 * TEAPOT_PROFILES) / 2;
        ok = teapot_add_patch(&r, patch, n);
        if (ok && closed && patch < 4) {
            ok = teapot_add_cap(&r, patch, 0, patch + 16, 1, n);        /* rim to lid */
        }
        /* parts 0 and 2 begin inside the body, 1 ends there, 3 at the tip */
        if (ok && closed && part >= 0) {
            ok = teapot_add_cap(&r, patch, part % 2, patch, part % 2, n);
        }
    }
    ok = ok && mesh_round(&r);
    if (!ok) {
        mesh_free(out);
    }
    return ok;
}

#endif /* EXAMPLES_TEAPOT_H */
