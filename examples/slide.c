/* slide - a box that walks along a mesh, slides over its seams, and is never inside of it
 *
 *   build/slide [mesh] [steps]       default: the teapot, 240 steps
 *
 * A small character controller. Resting on a floor is touching it, and so is sliding along it, so every question is
 * asked of the box's interior: tribox_sweep_rule with TRIBOX_OPEN is stopped only by what the box would enter, not by
 * the seam between two triangles of a floor that it lies on. At a contact the box keeps what is left of its way, less
 * the part that points along the contact's axis into the triangle. Coordinates are rounded, so the place that is
 * reached is asked about again before the box is there; where it is a hair inside, or where it starts inside,
 * tribox_gap says which way is out and how far, as often as it takes. A place that cannot be left is not entered.
 *
 * Sweeps and gaps are of floats; a mesh whose coordinates are no floats is moved to the origin first, by whole
 * numbers.
 *
 * First come a flat floor of 32 triangles at two heights and bumpy ground far from the origin, then the mesh. Prints:
 *
 *   floor      at z = 0: 200 steps, 0 stops; at z = 0.1: 200 steps, 0 stops
 *   ground     at 5000: 400 steps, 0 places inside
 *   start      inside, out after 1 move, at ( 0.00,  0.00,  3.15)
 *   step   30  at ( 0.46,  0.58,  2.89), 17 contacts on the way
 *   ...
 *   places     240 steps, 0 inside the mesh
 */
#include "program.h"

enum { TRIES = 8, MOVES_OUT = 64 };

typedef struct walker {
    tribox_mesh mesh;
    float       lo[3];
    float       hi[3];
    uint32_t   *near;       /* room for every triangle */
    size_t      contacts;
} walker;

/* The triangles near the box on its way u. */
static size_t look_around(const walker *w, const float u[3]) {
    float lo[3];
    float hi[3];
    int a;
    for (a = 0; a < 3; a++) {
        lo[a] = nextafterf(w->lo[a] + (u[a] < 0 ? u[a] : 0), -INFINITY);
        hi[a] = nextafterf(w->hi[a] + (u[a] > 0 ? u[a] : 0), INFINITY);
    }
    return tribox_mesh_query(&w->mesh, lo, hi, w->near, w->mesh.triangles);
}

/* The first triangle that the box would enter on its way u: when, and along which axis. 0 if there is none. */
static int enters(const walker *w, const float u[3], float *out_t, float out_axis[3]) {
    const size_t count = look_around(w, u);
    int found = 0;
    size_t i;
    for (i = 0; i < count; i++) {
        const float *v[3];
        float axis[3];
        float t;
        mesh_corners(&w->mesh, w->near[i], v);
        if (tribox_sweep_rule(v[0], v[1], v[2], w->lo, w->hi, u, TRIBOX_OPEN, &t, NULL, axis) &&
            (!found || t < *out_t)) {
            *out_t = t;
            memcpy(out_axis, axis, sizeof axis);
            found = 1;
        }
    }
    return found;
}

/* How deep the box is in the triangle that it is deepest in, and the axis that leads out; 0 if it is in none. */
static double inside(const walker *w, float out_axis[3]) {
    static const float stay[3] = {0, 0, 0};
    const size_t count = look_around(w, stay);
    double deepest = 0;
    size_t i;
    for (i = 0; i < count; i++) {
        const float *v[3];
        float axis[3];
        double s;
        mesh_corners(&w->mesh, w->near[i], v);
        if (tribox_overlap_rule(v[0], v[1], v[2], w->lo, w->hi, TRIBOX_OPEN)) {
            s = tribox_gap(v[0], v[1], v[2], w->lo, w->hi, axis);
            if (s < deepest) {
                deepest = s;
                memcpy(out_axis, axis, sizeof axis);
            }
        }
    }
    return -deepest;
}

/* Out of what the box is in: by the depth, along the axis, each coordinate rounded on the way out. One triangle left
 * may be another entered, so it asks again. Returns the moves it took, or -1 if it gave up. */
static int come_out(walker *w) {
    float axis[3];
    int moves;
    for (moves = 0; moves <= MOVES_OUT; moves++) {
        const double depth = inside(w, axis);
        int a;
        if (!(depth > 0)) {
            return moves;
        }
        for (a = 0; a < 3; a++) {
            const double way = depth * (double)axis[a];
            if (axis[a] < 0 || axis[a] > 0) {
                w->lo[a] = nextafterf((float)((double)w->lo[a] + way), axis[a] * INFINITY);
                w->hi[a] = nextafterf((float)((double)w->hi[a] + way), axis[a] * INFINITY);
            }
        }
    }
    return -1;
}

/* Takes the way u, rounded, unless the box would be inside of something. */
static int go(walker *w, const float u[3]) {
    const walker was = *w;
    float way[3];
    float axis[3];
    float t;
    int a;
    for (a = 0; a < 3; a++) {
        way[a] = (w->lo[a] + u[a]) - w->lo[a];
    }
    if (enters(w, way, &t, axis)) {
        return 0;
    }
    for (a = 0; a < 3; a++) {
        w->lo[a] += way[a];
        w->hi[a] += way[a];
    }
    if (come_out(w) < 0) {
        *w = was;
        return 0;
    }
    return 1;
}

/* One step: as much of u as there is room for. Returns 0 if the box could not take all of it, sliding included. */
static int step(walker *w, const float pull[3]) {
    float u[3];
    int tries;
    int a;
    memcpy(u, pull, sizeof u);
    for (tries = 0; tries < TRIES; tries++) {
        float part[3];
        float axis[3];
        float t;
        double into = 0;
        if (!enters(w, u, &t, axis)) {
            return go(w, u);
        }
        w->contacts++;
        for (a = 0; a < 3; a++) {
            part[a] = u[a] * t;
        }
        if (t > 0 && !go(w, part)) {
            memset(part, 0, sizeof part);
        }
        for (a = 0; a < 3; a++) {
            u[a] -= part[a];
            into += (double)u[a] * (double)axis[a];
        }
        for (a = 0; a < 3 && into < 0; a++) {
            u[a] = (float)((double)u[a] - into * (double)axis[a]);
        }
    }
    return 0;
}

static void place(walker *w, const float at[3], float half) {
    int a;
    for (a = 0; a < 3; a++) {
        w->lo[a] = a < 2 ? at[a] - half : at[a];
        w->hi[a] = w->lo[a] + 2 * half;
    }
}

/* Ground of so many squares, two triangles each: flat, or with bumps. */
enum { SQUARES = 4, POINTS = (SQUARES + 1) * (SQUARES + 1), FACES = 2 * SQUARES * SQUARES };

static void make_ground(tribox_mesh *out, float positions[3 * POINTS], uint32_t indices[3 * FACES], float at, float z,
                        float bump) {
    int i;
    for (i = 0; i < POINTS; i++) {
        const int x = i % (SQUARES + 1);
        const int y = i / (SQUARES + 1);
        positions[3 * i] = at + (float)x;
        positions[3 * i + 1] = at + (float)y;
        positions[3 * i + 2] = z + bump * (float)((7 * x + 5 * y * y) % 4);
    }
    for (i = 0; i < SQUARES * SQUARES; i++) {
        const uint32_t corner = (uint32_t)(i / SQUARES * (SQUARES + 1) + i % SQUARES);
        const uint32_t quad[6] = {corner, corner + 1, corner + SQUARES + 2, corner, corner + SQUARES + 2,
                                  corner + SQUARES + 1};
        memcpy(indices + 6 * i, quad, sizeof quad);
    }
    out->positions = positions;
    out->stride = 0;
    out->indices = indices;
    out->triangles = FACES;
}

/* Walks over the ground, pulled down all the while. Counts the steps that fell short, and places inside. */
static void walk_ground(float at, float z, float bump, int steps, int *out_stops, int *out_inside) {
    float positions[3 * POINTS];
    uint32_t indices[3 * FACES];
    uint32_t near[FACES];
    float axis[3];
    float start[3];
    walker w;
    int i;
    make_ground(&w.mesh, positions, indices, at, z, bump);
    w.near = near;
    w.contacts = 0;
    start[0] = start[1] = at + 0.25f;
    start[2] = z + 4 * bump;
    place(&w, start, 0.125f);
    *out_stops = *out_inside = 0;
    for (i = 0; i < steps; i++) {
        const float side = i / (steps / 4) % 2 ? -1.0f : 1.0f;
        const float pull[3] = {side * 0.0611f, side * 0.0427f, -0.031f};
        const float was[2] = {w.lo[0], w.lo[1]};
        const int all = step(&w, pull);
        *out_stops += !all || fabsf(w.lo[0] - was[0]) < 0.06f || fabsf(w.lo[1] - was[1]) < 0.04f;
        *out_inside += inside(&w, axis) > 0;
    }
}

/* The box half sunk into the highest vertex. */
static void place_on_top(walker *w, float half) {
    float top[3] = {0, 0, -FLT_MAX};
    size_t t;
    int i;
    for (t = 0; t < w->mesh.triangles; t++) {
        const float *v[3];
        mesh_corners(&w->mesh, t, v);
        for (i = 0; i < 3; i++) {
            if (v[i][2] > top[2]) {
                memcpy(top, v[i], sizeof top);
            }
        }
    }
    top[2] -= half / 4;
    place(w, top, half);
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: slide [mesh] [steps from 1 to 100000]";
    const float pull[3] = {64.0f / 4096, 80.0f / 4096, -72.0f / 4096};
    int asked;
    int steps = 240;
    int stops[2];
    int wrong[3];
    int places = 0;
    float axis[3];
    walker w;
    mesh loaded;
    int moves;
    int i;
    if ((asked = program_arguments("slide", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 3 || (argc > 2 && !program_int(argv[2], 1, 100000, &steps)) ||
        !program_mesh(&loaded, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("slide", error);
    }
    walk_ground(0, 0, 0, 200, &stops[0], &wrong[0]);
    walk_ground(0, 0.1f, 0, 200, &stops[1], &wrong[1]);
    printf("floor      at z = 0: 200 steps, %d stops; at z = 0.1: 200 steps, %d stops\n", stops[0], stops[1]);
    walk_ground(5000, 0, 0.07f, 400, &i, &wrong[2]);
    printf("ground     at 5000: 400 steps, %d places inside\n", wrong[2]);
    mesh_to_floats(&loaded);
    w.mesh = mesh_view(&loaded);
    w.contacts = 0;
    w.near = (uint32_t *)malloc((w.mesh.triangles + 1) * sizeof *w.near);
    if (!w.near) {
        return program_fails("slide", "out of memory");
    }
    place_on_top(&w, 256.0f / 4096);
    moves = come_out(&w);
    printf("start      inside, %s after %d move%s, at (%5.2f, %5.2f, %5.2f)\n", moves < 0 ? "still in" : "out",
           abs(moves), moves == 1 ? "" : "s", (double)(w.lo[0] + w.hi[0]) / 2, (double)(w.lo[1] + w.hi[1]) / 2,
           (double)w.lo[2]);
    for (i = 1; i <= steps; i++) {
        step(&w, pull);
        places += inside(&w, axis) > 0;
        if (i % 30 == 0) {
            printf("step %4d  at (%5.2f, %5.2f, %5.2f), %lu contacts on the way\n", i,
                   (double)(w.lo[0] + w.hi[0]) / 2, (double)(w.lo[1] + w.hi[1]) / 2, (double)w.lo[2],
                   (unsigned long)w.contacts);
        }
    }
    printf("places     %d steps, %d inside the mesh\n", steps, places);
    free(w.near);
    mesh_free(&loaded);
    return places != 0 || moves < 0 || stops[0] + stops[1] + wrong[0] + wrong[1] + wrong[2] != 0;
}
