/* check_voxels - compares another program's voxels with the exact set, and says how wrong each difference is
 *
 *   build/check_voxels mesh.obj other.binvox
 *
 * A missing voxel touches the mesh but isn't set: shown with how far the box could shrink on all sides and
 * still touch (0: it touches by its border only). An extra voxel is set but doesn't touch: shown with its
 * distance from the nearest triangle. Exit status: 0 the same set, 1 a difference, 2 an error.
 */
#include "program.h"
#include "mesh_stats.h"
#include "solid.h"
#include "solid_parts.h"

typedef struct options {
    const char *mesh;
    const char *other;
    unsigned    flags;
    int         has_size;
    double      size[3];
    int         has_origin;
    double      origin[3];
    int         solid;
    int         show;
} options;

static const char usage[] =
    "usage: check_voxels mesh other.binvox [options]\n"
    "\n"
    "  mesh            " PROGRAM_MESHES "\n"
    "  other.binvox    the voxels to check; its header places the grid\n"
    "  --closed, --half-open, --open, --thin\n"
    "                  the exact set to compare with (default: --closed, every voxel that the mesh touches)\n"
    "  --solid         the voxels whose centre is inside, as voxelize --solid sets them\n"
    "  --solid=flood   the exact set with its inside filled by a flood from outside\n"
    "  --size X,Y,Z    the voxels' size, where the header's rounded one isn't meant; the first voxel's\n"
    "                  corner is then a whole number of voxels from --origin, the nearest to the header's\n"
    "  --origin X,Y,Z  a corner of the grid's voxels, with --size (default: 0,0,0)\n"
    "  --show N        how many missing and how many extra voxels to list (default: 5)\n"
    "  --help          this text\n"
    "\n"
    "exit status: 0 the same set, 1 a difference, 2 an error\n";

static int read_option(options *o, const char *name, const char *value, char *error) {
    int ok;
    if (program_rule(name, &o->flags)) {
        return 1;
    }
    if (strcmp(name, "--solid") == 0 || strcmp(name, "--solid=flood") == 0) {
        o->solid = name[7] == 0 ? 1 : 2;
        return 1;
    }
    if (strcmp(name, "--size") != 0 && strcmp(name, "--origin") != 0 && strcmp(name, "--show") != 0) {
        snprintf(error, MESH_ERROR, "unknown option '%.100s'", name);
        return 0;
    }
    if (!value) {
        snprintf(error, MESH_ERROR, "%s needs a value", name);
        return 0;
    }
    if (strcmp(name, "--size") == 0) {
        o->has_size = 1;
        ok = program_triple(value, o->size) && o->size[0] > 0 && o->size[1] > 0 && o->size[2] > 0;
    } else if (strcmp(name, "--origin") == 0) {
        o->has_origin = 1;
        ok = program_triple(value, o->origin);
    } else {
        ok = program_int(value, 0, INT_MAX, &o->show);
    }
    snprintf(error, MESH_ERROR, "%s: '%.100s' is not such a value", name, value);
    return ok ? 2 : 0;
}

static int read_options(options *o, int argc, char **argv, char *error) {
    int i = 1;
    memset(o, 0, sizeof *o);
    o->show = 5;
    while (i < argc) {
        if (argv[i][0] == '-' && argv[i][1] != 0) {
            int used = read_option(o, argv[i], i + 1 < argc ? argv[i + 1] : NULL, error);
            if (used == 0) {
                return 0;
            }
            i += used;
            continue;
        }
        if (o->other) {
            snprintf(error, MESH_ERROR, "'%.100s' is one argument too many", argv[i]);
            return 0;
        }
        *(o->mesh ? &o->other : &o->mesh) = argv[i];
        i += 1;
    }
    snprintf(error, MESH_ERROR, !o->other ? "a mesh and a binvox file are needed" : "--origin needs --size");
    return o->other && (o->has_size || !o->has_origin);
}

/* Places the file's voxels on the grid that --size and --origin name. */
static int place_by_size(voxels *other, const options *o, char *error) {
    tribox_grid *g = &other->grid;
    int a;
    for (a = 0; a < 3; a++) {
        double lo = floor((g->origin[a] - o->origin[a]) / o->size[a] + 0.5);
        if (!(fabs(lo) < 1e9)) {
            snprintf(error, MESH_ERROR,
                     "--size and --origin put the grid's first voxel at number %g along %c", lo,
                     'x' + a);
            return 0;
        }
        g->origin[a] = o->origin[a];
        g->size[a] = o->size[a];
        g->hi[a] = (int)lo + g->hi[a];
        g->lo[a] = (int)lo;
    }
    return 1;
}

/* ---- 1. Distances ---------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp(double x, double lo, double hi) {
    return x < lo ? lo : x > hi ? hi : x;
}

/* Squared distance of the segments p + s*d, q + t*e, with s and t in [0, 1]. */
static double segment_distance2(const double p[3], const double d[3], const double q[3], const double e[3]) {
    double r[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    double dd = dot(d, d);
    double ee = dot(e, e);
    double de = dot(d, e);
    double det = dd * ee - de * de;
    double s = det > 0 ? clamp((de * dot(e, r) - ee * dot(d, r)) / det, 0, 1) : 0;
    double t = ee > 0 ? clamp((dot(e, r) + s * de) / ee, 0, 1) : 0;
    int a;
    s = dd > 0 ? clamp((t * de - dot(d, r)) / dd, 0, 1) : 0;
    for (a = 0; a < 3; a++) {
        r[a] += s * d[a] - t * e[a];
    }
    return dot(r, r);
}

/* Squared distance of a point from the triangle's inside; infinite if it isn't above the inside. */
static double face_distance2(const double q[3], double v[3][3]) {
    double e[3];
    double f[3];
    double n[3];
    double r[3];
    double nn;
    double u;
    double w;
    int a;
    for (a = 0; a < 3; a++) {
        e[a] = v[1][a] - v[0][a];
        f[a] = v[2][a] - v[0][a];
        r[a] = q[a] - v[0][a];
    }
    for (a = 0; a < 3; a++) {
        n[a] = e[(a + 1) % 3] * f[(a + 2) % 3] - e[(a + 2) % 3] * f[(a + 1) % 3];
    }
    nn = dot(n, n);
    u = dot(e, e) * dot(r, f) - dot(e, f) * dot(r, e);
    w = dot(f, f) * dot(r, e) - dot(e, f) * dot(r, f);
    if (!(nn > 0) || u < 0 || w < 0 || u + w > nn) {
        return HUGE_VAL;
    }
    return dot(n, r) * dot(n, r) / nn;
}

/* Squared distance of a triangle and a box that are apart: between a corner and a face or two edges. */
static double apart_distance2(double v[3][3], const double lo[3], const double hi[3]) {
    double least = HUGE_VAL;
    int i;
    int k;
    int a;
    for (i = 0; i < 3; i++) {
        double out2 = 0;
        double d[3];
        for (a = 0; a < 3; a++) {
            double out = v[i][a] - clamp(v[i][a], lo[a], hi[a]);
            out2 += out * out;
            d[a] = v[(i + 1) % 3][a] - v[i][a];
        }
        least = fmin(least, out2);
        for (k = 0; k < 12; k++) {      /* edge k of the box runs along axis k / 4 */
            int b = (k / 4 + 1) % 3;
            int c = (k / 4 + 2) % 3;
            double q[3];
            double e[3] = {0, 0, 0};
            q[k / 4] = lo[k / 4];
            q[b] = k & 1 ? hi[b] : lo[b];
            q[c] = k & 2 ? hi[c] : lo[c];
            e[k / 4] = hi[k / 4] - lo[k / 4];
            least = fmin(least, segment_distance2(v[i], d, q, e));
        }
    }
    for (k = 0; k < 8; k++) {
        double q[3] = {k & 1 ? hi[0] : lo[0], k & 2 ? hi[1] : lo[1], k & 4 ? hi[2] : lo[2]};
        least = fmin(least, face_distance2(q, v));
    }
    return least;
}

/* Squared distance of the box from a triangle's bounding box: nearer the triangle can't be. */
static double bounds_distance2(double v[3][3], const double lo[3], const double hi[3]) {
    double sum = 0;
    int a;
    for (a = 0; a < 3; a++) {
        double min = fmin(v[0][a], fmin(v[1][a], v[2][a]));
        double max = fmax(v[0][a], fmax(v[1][a], v[2][a]));
        double out = fmax(0, fmax(min - hi[a], lo[a] - max));
        sum += out * out;
    }
    return sum;
}

typedef struct nearest {
    double distance;        /* to the nearest triangle; 0: one touches */
    double depth;           /* how far the box can shrink on each side and still be touched; -1: it isn't */
    size_t triangle;
} nearest;

/* By halving: how far the box can shrink with this triangle still touching it. */
static double shrink_depth(double v[3][3], const double lo[3], const double hi[3], double known) {
    double most = 0.5 * fmin(hi[0] - lo[0], fmin(hi[1] - lo[1], hi[2] - lo[2]));
    double least = known > 0 ? known : 0;
    double in[2][3];
    double depth = least;
    int step;
    int a;
    for (step = 0; step < 40; step++) {
        for (a = 0; a < 3; a++) {
            in[0][a] = lo[a] + depth;
            in[1][a] = hi[a] - depth;
        }
        if (tribox_overlap_f64(v[0], v[1], v[2], in[0], in[1])) {
            least = depth;
        } else if (step == 0) {
            return known;       /* an earlier triangle reaches deeper */
        } else {
            most = depth;
        }
        depth = 0.5 * (least + most);
    }
    return least;
}

static nearest find_nearest(const tribox_mesh *m, const double lo[3], const double hi[3]) {
    nearest best = {HUGE_VAL, -1, 0};
    size_t t;
    int i;
    int a;
    for (t = 0; t < m->triangles; t++) {
        const float *corner[3];
        double v[3][3];
        double distance;
        mesh_corners(m, t, corner);
        for (i = 0; i < 3; i++) {
            for (a = 0; a < 3; a++) {
                v[i][a] = (double)corner[i][a];
            }
        }
        if (!mesh_is_finite(v[0]) || !mesh_is_finite(v[1]) || !mesh_is_finite(v[2])
            || !(bounds_distance2(v, lo, hi) <= best.distance * best.distance)) {
            continue;
        }
        if (tribox_overlap_f64(v[0], v[1], v[2], lo, hi)) {
            best.depth = shrink_depth(v, lo, hi, best.depth);
            distance = 0;
        } else {
            distance = sqrt(apart_distance2(v, lo, hi));
        }
        if (distance < best.distance) {
            best.distance = distance;
            best.triangle = t;
        }
    }
    return best;
}

/* ---- 2. Comparison --------------------------------------------------------------------------- */

/* Prints a voxel of the file and what the mesh does near it. */
static void show(const char *what, const voxels *other, const tribox_mesh *m, const size_t at[3]) {
    double lo[3];
    double hi[3];
    nearest near;
    int a;
    for (a = 0; a < 3; a++) {
        double i = (double)other->grid.lo[a] + (double)at[a];
        lo[a] = other->grid.origin[a] + i * other->grid.size[a];
        hi[a] = other->grid.origin[a] + (i + 1) * other->grid.size[a];
    }
    near = find_nearest(m, lo, hi);
    printf("  %s  %lu,%lu,%lu  box %.9g,%.9g,%.9g to %.9g,%.9g,%.9g: ", what, (unsigned long)at[0],
           (unsigned long)at[1], (unsigned long)at[2], lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
    if (near.distance > 0) {
        printf("%.6g from triangle %lu\n", near.distance, (unsigned long)near.triangle);
    } else {
        printf("distance 0, touches triangle %lu, reaches %.6g inside\n", (unsigned long)near.triangle,
               near.depth < 0 ? 0 : near.depth);
    }
}

/* Counts voxels that are in `a` and not in `b`, two sets over the file's grid, and shows the first few. */
static size_t differ(const char *what, const voxels *a, const voxels *b, const tribox_mesh *m,
                     int show_most) {
    size_t count = 0;
    size_t at[3];
    for (at[2] = 0; at[2] < a->n[2]; at[2]++) {
        for (at[1] = 0; at[1] < a->n[1]; at[1]++) {
            const uint64_t *in = voxels_row(a, at[1], at[2]);
            const uint64_t *out = voxels_row(b, at[1], at[2]);
            size_t word;
            for (word = 0; word < a->row_words; word++) {
                uint64_t rest = in[word] & ~out[word];
                for (; rest; rest &= rest - 1) {
                    count += 1;
                    if (count <= (size_t)show_most) {
                        at[0] = 64 * word + voxels_lowest(rest);
                        show(what, a, m, at);
                    }
                }
            }
        }
    }
    return count;
}

/* Voxels that the mesh touches in the layer around the file's grid. */
static size_t count_around(const voxels *v, const tribox_mesh *m) {
    tribox_grid wide = v->grid;
    voxels around;
    char ignored[MESH_ERROR];
    size_t count = 0;
    size_t y;
    size_t z;
    int a;
    for (a = 0; a < 3; a++) {
        wide.lo[a] -= 1;
        wide.hi[a] += 1;
    }
    if (!voxels_make(&around, &wide, ignored)) {
        return 0;
    }
    tribox_grid_fill(&wide, m, around.bits);
    for (z = 0; z < around.n[2]; z++) {
        for (y = 0; y < around.n[1]; y++) {
            int inner = z > 0 && y > 0 && z + 1 < around.n[2] && y + 1 < around.n[1];
            size_t x;
            for (x = 0; x < around.n[0]; x += inner ? around.n[0] - 1 : 1) {
                count += (size_t)voxels_get(&around, x, y, z);
            }
        }
    }
    voxels_free(&around);
    return count;
}

static int compare(const options *o, const tribox_mesh *m, voxels *other, char *error) {
    voxels exact;
    size_t inside = 0;
    size_t missing;
    size_t extra;
    size_t around;
    other->grid.flags = o->flags;
    if (!voxels_make(&exact, &other->grid, error)) {
        return 2;
    }
    if (o->solid == 1) {
        tribox_grid_fill_solid(&exact.grid, m, exact.bits);
    } else {
        tribox_grid_fill(&exact.grid, m, exact.bits);
    }
    if (o->solid == 2 && !solid_fill(&exact, &inside)) {
        voxels_free(&exact);
        snprintf(error, MESH_ERROR, "--solid: out of memory");
        return 2;
    }
    printf("grid     %lu x %lu x %lu voxels of %.9g x %.9g x %.9g, %s%s\n", (unsigned long)other->n[0],
           (unsigned long)other->n[1], (unsigned long)other->n[2], other->grid.size[0], other->grid.size[1],
           other->grid.size[2], program_rule_name(o->flags), o->solid == 1 ? ", centres inside" : o->solid ? ", inside filled" : "");
    printf("exact    %lu voxels\n", (unsigned long)voxels_count(&exact));
    printf("other    %lu voxels\n", (unsigned long)voxels_count(other));
    missing = differ("missing", &exact, other, m, o->show);
    extra = differ("extra  ", other, &exact, m, o->show);
    around = count_around(other, m);
    printf("missing  %lu\nextra    %lu\n", (unsigned long)missing, (unsigned long)extra);
    if (around) {
        printf("note     %lu voxels around the grid are touched too; the file has no room for them\n",
               (unsigned long)around);
    }
    voxels_free(&exact);
    return missing || extra ? 1 : 0;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "";
    options o;
    mesh m;
    voxels other;
    tribox_mesh view;
    int status = 2;
    int i;
    for (i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            fputs(usage, stdout);
            return 0;
        }
    }
    if (!read_options(&o, argc, argv, error)) {
        program_fails("check_voxels", error);
        fputs("try: check_voxels --help\n", stderr);
        return 2;
    }
    if (!program_mesh(&m, o.mesh, error)) {
        return program_fails("check_voxels", error);
    }
    view = mesh_view(&m);
    if (binvox_read(o.other, &other, error)) {
        if (!o.has_size || place_by_size(&other, &o, error)) {
            status = compare(&o, &view, &other, error);
        }
        voxels_free(&other);
    }
    mesh_free(&m);
    return status == 2 ? program_fails("check_voxels", error) : status;
}
