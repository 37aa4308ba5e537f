/* slide - a box that slides along a mesh and never passes through it
 *
 *   build/slide [mesh] [steps]       default: the teapot, 240 steps
 *
 * The box starts in contact with the highest vertex, and a steady pull drags it down and aside. Each step
 * asks tribox_sweep of the triangles that tribox_mesh_query finds near the path. In the way is what the path
 * touches, save what it only leaves: where the last contact is at t = 0. Places are whole multiples of UNIT,
 * so a path that was asked about is the path that is taken, exactly; where it is blocked, the box goes as far
 * as it can and loses the part of its motion that points along the contact's axis into the triangle. At the
 * end of every step tribox_mesh_query is asked of the new place and has to find nothing. Prints:
 *
 *   start     in contact, at ( 0.00,  0.00,  3.15)
 *   step   30 at ( 0.48,  0.60,  2.87), 16 contacts on the way
 *   ...
 *   places    240 steps, 0 of them inside the mesh
 */
#include "program.h"

#define UNIT (1.0f / 4096)

typedef struct mover {
    tribox_mesh mesh;
    float       lo[3];
    float       hi[3];
    uint32_t   *near;       /* room for every triangle */
    size_t      contacts;
} mover;

/* The first triangle in the way of the box moving by u: returns 0 if there is none. */
static int blocked(const mover *m, const float u[3], float *out_t, float out_axis[3]) {
    float lo[3];
    float hi[3];
    size_t count;
    size_t i;
    int found = 0;
    int a;
    for (a = 0; a < 3; a++) {
        lo[a] = m->lo[a] + (u[a] < 0 ? u[a] : 0);
        hi[a] = m->hi[a] + (u[a] > 0 ? u[a] : 0);
    }
    *out_t = 2;
    count = tribox_mesh_query(&m->mesh, lo, hi, m->near, m->mesh.triangles);
    for (i = 0; i < count; i++) {
        const float *v[3];
        float axis[3];
        float t0;
        float t1;
        mesh_corners(&m->mesh, m->near[i], v);
        if (tribox_sweep(v[0], v[1], v[2], m->lo, m->hi, u, &t0, &t1, axis) && t1 > 0 && t0 < *out_t) {
            *out_t = t0;
            memcpy(out_axis, axis, sizeof axis);
            found = 1;
        }
    }
    return found;
}

static float to_unit(double x) {
    return (float)floor(x / (double)UNIT + 0.5) * UNIT;
}

static void go(mover *m, const float u[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        m->lo[a] += u[a];
        m->hi[a] += u[a];
    }
}

/* Takes what it can of the way u; u becomes what is left, less its part into the contact, plus a unit away
 * from it. */
static int move(mover *m, float u[3]) {
    float part[3];
    float axis[3];
    float other[3];
    float t;
    float other_t;
    double into = 0;
    int a;
    if (!blocked(m, u, &t, axis)) {
        go(m, u);
        return 1;
    }
    m->contacts++;
    for (a = 0; a < 3; a++) {
        part[a] = to_unit((double)u[a] * (double)t);
        into += ((double)u[a] - (double)part[a]) * (double)axis[a];
    }
    if (!blocked(m, part, &other_t, other)) {
        go(m, part);
    } else {
        part[0] = part[1] = part[2] = 0;        /* rounding brought it into contact: stay */
    }
    for (a = 0; a < 3; a++) {
        u[a] = to_unit((double)u[a] - (double)part[a] - (into < 0 ? into : 0) * (double)axis[a] +
                       2 * (double)axis[a] * (double)UNIT);
    }
    return 0;
}

static int touches(const mover *m) {
    return tribox_mesh_query(&m->mesh, m->lo, m->hi, NULL, 0) > 0;
}

/* The box above the highest vertex, resting on it. */
static void place_on_top(mover *m, float half) {
    float top[3] = {0, 0, -FLT_MAX};
    size_t t;
    int i;
    int a;
    for (t = 0; t < m->mesh.triangles; t++) {
        const float *v[3];
        mesh_corners(&m->mesh, t, v);
        for (i = 0; i < 3; i++) {
            if (v[i][2] > top[2]) {
                memcpy(top, v[i], sizeof top);
            }
        }
    }
    for (a = 0; a < 3; a++) {
        m->lo[a] = a < 2 ? top[a] - half : top[a];
        m->hi[a] = m->lo[a] + 2 * half;
    }
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: slide [mesh] [steps from 1 to 100000]";
    int asked;
    const float pull[3] = {64 * UNIT, 80 * UNIT, -72 * UNIT};
    int steps = 240;
    int inside = 0;
    mover m;
    mesh loaded;
    size_t i;
    int step;
    if ((asked = program_arguments("slide", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 3 || (argc > 2 && !program_int(argv[2], 1, 100000, &steps)) ||
        !program_mesh(&loaded, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("slide", error);
    }
    for (i = 0; i < 3 * loaded.vertices; i++) {
        loaded.positions[i] = to_unit((double)loaded.positions[i]);
    }
    m.mesh = mesh_view(&loaded);
    m.near = (uint32_t *)malloc((m.mesh.triangles + 1) * sizeof *m.near);
    if (!m.near) {
        return program_fails("slide", "out of memory");
    }
    place_on_top(&m, 256 * UNIT);
    m.contacts = 0;
    printf("start     %s, at (%5.2f, %5.2f, %5.2f)\n", touches(&m) ? "in contact" : "free",
           (double)(m.lo[0] + m.hi[0]) / 2, (double)(m.lo[1] + m.hi[1]) / 2, (double)m.lo[2]);
    for (step = 1; step <= steps; step++) {
        float u[3];
        int tries = 0;
        memcpy(u, pull, sizeof u);
        while (tries++ < 8 && !move(&m, u)) {
        }
        inside += touches(&m);
        if (step % 30 == 0) {
            printf("step %4d at (%5.2f, %5.2f, %5.2f), %lu contacts on the way\n", step,
                   (double)(m.lo[0] + m.hi[0]) / 2, (double)(m.lo[1] + m.hi[1]) / 2, (double)m.lo[2],
                   (unsigned long)m.contacts);
        }
    }
    printf("places    %d steps, %d of them inside the mesh\n", steps, inside);
    free(m.near);
    mesh_free(&loaded);
    return inside != 0;
}
