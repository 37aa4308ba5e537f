/* How far are the filters' values from the exact ones, as a part of their bounds? Hill climbing from random
 * questions, in every rounding mode, against rationals (GMP). What tests/proofs prove from above, this looks
 * at from below: it fails where a value is beyond its bound, and prints the worst that it found.
 *
 *   build/errors [thousands of questions for each line, three times as many for a fill] [seed] */
#include "tribox_errors.h"

#include <fenv.h>
#include <gmp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ONE_BOX, PREPARED, PREPARED_FLOAT, OCTANTS, WALK, PLACES, FILL_BOXES, FILL_EDGES, FILL_PLANE };
enum { VALUES = 11 };
#if TRIBOX_SIMD
enum { KINDS = 9 };
#else
enum { KINDS = 6 };
#endif

static const char *const kind_names[9] = {"one box, double", "prepared, double", "prepared, float",
                                          "octants", "grid walk", "places and rests", "fill, index boxes",
                                          "fill, row edges", "fill, row plane"};

/* v0, v1, v2, then box_min and box_max, or p and size, or origin and size */
typedef struct numbers {
    double x[15];
    int    index[3];    /* of the walk's voxel; rows of a fill */
    int    lo[3];       /* a fill's region */
    int    n[3];
    int    thin;
} numbers;

/* What the header computed. bound 0: no value. */
typedef struct computed {
    double value[VALUES];
    double bound[VALUES];
    double slope[VALUES][3];    /* a prepared condition's scaled normal */
    int    index[3];            /* the voxel asked about */
    tbx_clip clip;
} computed;

static uint64_t random_state = 1;

static uint64_t random_bits(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return random_state * 0x2545f4914f6cdd1du;
}

static int random_below(int n)
{
    return (int)((random_bits() >> 33) % (uint64_t)n);
}

static double random_signed(void)
{
    return (double)(int64_t)random_bits() / 9223372036854775808.0;
}

/* ---- the header's values, in the rounding mode of the moment ------------------------------------------- */

__attribute__((noinline)) static void one_box(computed *r, const numbers *q)
{
    tbx_values values;
    tbx_axis axis[3];
    int k;

    if (!tbx_all_usual(q->x, q->x + 3, q->x + 6, q->x + 9, q->x + 12) ||
        !tbx_clip_box(&r->clip, q->x, q->x + 3, q->x + 6, q->x + 9, q->x + 12, 0)) {
        return;
    }
    for (k = 0; k < 3; k++) {
        tbx_axis_set(&axis[k], q->x[k], q->x[3 + k], q->x[6 + k], r->clip.lo[k], r->clip.hi[k]);
    }
    tbx_filter(&values, axis);
    for (k = 0; k < 4; k++) {
        r->value[k] = values.value[k];
        r->bound[k] = values.bound[k];
    }
}

/* Condition i, 3k..3k+2 those of lane k, as the test in float has it. */
static double lane_value(const tribox_tri *tri, const float q[3], int i, double slope[3])
{
    const int k = i / 3;
    const int j = k < 3 ? i % 3 : i == 9 ? 0 : 1;
    const int b = k < 3 ? (k + 1) % 3 : 0;
    const int c = k < 3 ? (k + 2) % 3 : 1;
    const double u = j == 1 ? -1.0 : j == 0 ? 1.0 : 0.0;    /* the one between is minus the others' sum */
    const double v = j == 1 ? -1.0 : j == 2 ? 1.0 : 0.0;
    const float one = 1.0f;
    const float first = tri->n_e_b[0][k] * q[b] +
                        (tri->n_e_c[0][k] * q[c] + (tri->n_z[k] * q[2] + tri->d_e[0][k]));
    const float second = tri->n_e_b[1][k] * q[b] + (tri->n_e_c[1][k] * q[c] + tri->d_e[1][k]);

    slope[0] = slope[1] = slope[2] = 0.0;
    slope[b] = u * (double)tri->n_e_b[0][k] + v * (double)tri->n_e_b[1][k];
    slope[c] = u * (double)tri->n_e_c[0][k] + v * (double)tri->n_e_c[1][k];
    slope[2] += u * (double)tri->n_z[k];
    return (double)((j == 0 ? first : j == 2 ? second : tri->d_e[2][k] - (first + second)) - one);
}

/* as_float: prepared from floats if the numbers are, else from doubles; octants: the upper of all */
__attribute__((noinline)) static void prepared(computed *r, const numbers *x, int as_float, int octants)
{
    const double count = octants + 1;
    tribox_tri tri;
    float q[3];
    int i;
    int k;

    if (as_float) {
        tribox_tri_init_f64(&tri, x->x, x->x + 3, x->x + 6, x->x + 12, x->thin ? TRIBOX_THIN : 0u);
    } else {
        double v[3][3];
        memcpy(v, x->x, sizeof v);
        tbx_tri_init(&tri, (const double(*)[3])v, x->x + 12, x->thin ? TRIBOX_THIN : 0u);
    }
    if (!tri.hidden.in_range) {
        return;
    }
    for (k = 0; k < 3; k++) {
        const double p = x->x[9 + k];
        if (p + octants * tri.size[k] > tri.t_max[k] || tbx_face_sign(&p, &tri.size[k], (int)count, &tri.t_min[k]) < 0) {
            return;     /* the bound holds where the faces do */
        }
        q[k] = as_float ? (float)p - tri.ref[k] : (float)(p - (double)tri.ref[k]);
        q[k] = octants ? q[k] + tri.hidden.step[k] : q[k];
    }
    for (i = 0; i < VALUES; i++) {
        const int axis = i / 3;
        const double *from = x->x + 3 * (i % 3);
        const double *to = x->x + 3 * ((i + 1) % 3);
        const int b = (axis + 1) % 3;
        const int c = (axis + 2) % 3;
        r->value[i] = lane_value(&tri, q, i, r->slope[i]);
        for (k = 0; k < 3; k++) {
            r->bound[i] = r->slope[i][k] != 0.0 ? 1.0 : r->bound[i];
        }
        if (i < 9 && !((from[b] < to[b] || from[b] > to[b]) && (from[c] < to[c] || from[c] > to[c]))) {
            r->bound[i] = 0.0;      /* along an axis: it has 2 added */
        }
    }
}

/* The walk bounds voxels, i >= floor(t), i <= floor(t): its conditions are width * (i + 1 - t) >= 0 and width * (t - i) >= 0. */
__attribute__((noinline)) static void walked(computed *r, const numbers *q)
{
    static const int group_axis[3] = {2, 1, 0};
    static const int bounded[3] = {0, 0, 1};
    static const int rows[3] = {1, 2, 2};
    tbx_frame f;
    tbx_part all;
    tbx_walk w;
    tribox_grid grid;
    double v[3][3];
    int at[3];
    int group;
    int i;
    int k;

    for (k = 0; k < 3; k++) {
        grid.origin[k] = q->x[9 + k];
        grid.size[k] = q->x[12 + k];
        grid.lo[k] = -1000;
        grid.hi[k] = 1000;
    }
    for (i = 0; i < 9; i++) {
        v[i / 3][i % 3] = q->x[i];
    }
    grid.flags = q->thin ? TRIBOX_THIN : 0u;
    if (!tbx_frame_init(&f, &grid)) {
        return;
    }
    tbx_part_all(&all, &grid);
    if (!tbx_walk_box(&w, &f, v, tbx_corners_kind(v), &all)) {
        return;
    }
    tbx_walk_set_out(&w);
    for (k = 0; k < 3; k++) {
        at[k] = (int)(w.first[k] + q->index[k] % (w.last[k] - w.first[k] + 1));
        r->index[k] = grid.lo[k] + at[k];
    }
    for (group = 0; group < 3; group++) {
        const tbx_lines *l = &w.group[group];
        const int b = bounded[group];
        const int row = rows[group];
        if (!w.uses[group] || !w.light || l->error > 0.0625) {
            continue;
        }
        for (i = 0; i < 3; i++) {
            const double width = fabs(v[(i + 1) % 3][row] - v[i][row]) * grid.size[b];
            const double lower = l->at_lo[i] + l->slope[i] * (double)at[row] - 1.0;
            const double upper = l->at_hi[i] + l->slope[i] * (double)at[row] - 1.0;
            const int id = 3 * group_axis[group] + i;
            if (fabs(lower) < 1e15 || fabs(upper) < 1e15) {
                r->value[id] = width * (fabs(lower) < 1e15 ? (double)(at[b] + 1) - lower : upper - (double)at[b]);
                r->bound[id] = width * l->error;
            }
        }
    }
    if (w.uses[3] && w.light) {
        w.z = at[2];
        tbx_walk_plane_to_layer(&w);
        if (w.group[3].error <= 0.0625) {
            const double width = fabs(w.n[0]) * grid.size[0] * grid.size[1] * grid.size[2];
            const double lower = w.group[3].at_lo[0] + w.group[3].slope[0] * (double)at[1] - 1.0;
            const double upper = w.group[3].at_hi[0] + w.group[3].slope[0] * (double)at[1] - 1.0;
            const int below = w.n_sign[0] > 0 ? 9 : 10;
            r->value[below] = width * ((double)(at[0] + 1) - lower);
            r->value[19 - below] = width * (upper - (double)at[0]);
            r->bound[9] = r->bound[10] = width * w.group[3].error;
        }
    }
}

static void grid_of(tribox_grid *grid, const numbers *q)
{
    int k;

    memset(grid, 0, sizeof *grid);
    for (k = 0; k < 3; k++) {
        grid->origin[k] = q->x[9 + k];
        grid->size[k] = q->x[12 + k];
        grid->lo[k] = q->lo[k];
        grid->hi[k] = q->lo[k] + q->n[k];
    }
}

#if TRIBOX_SIMD
enum { ROWS_ASKED = 2 };

/* What the header computed of a triangle's way through the fill. */
typedef struct filled {
    int    boxed;               /* the grid's numbers are in range; what follows of the box holds */
    int    unsure;
    int    first[3];            /* TBX_MARGIN added */
    int    last[3];
    int    end[3];
    float  face[3][2][2];       /* of each axis: low and high, by shift_down and shift_up */
    int    placed;              /* the box fits the rows, which are sure so far; all below holds */
    int    at[3];
    int    rows[3];             /* up to the region's end */
    int    start[3];
    int    row[3][ROWS_ASKED];  /* in the planes xy, xz, yz */
    int    flat[3];             /* edges bound from both sides */
    int    bounds_side[3][3][2];            /* edge, plane, lo and hi */
    float  bound[3][3][ROWS_ASKED][2][2];   /* and row, least and most; row: as above */
    tbx_lane_bounds bounds[3];
    int    has_plane;
    float  plane[ROWS_ASKED][2][2];         /* in row y = row[0], z = row[1] */
    float  plane_error;
} filled;

/* The axes that a plane's edges bound, and those of its rows. */
static const int bounded_axis[3] = {0, 0, 1};
static const int row_axis[3] = {1, 2, 2};

__attribute__((noinline)) static void fill_boxes(filled *r, tbx_quick *quick, const numbers *q)
{
    tbx_target target;
    tbx_points v[3];
    tbx_boxes box;
    tribox_grid grid;
    int c;
    int k;

    memset(r, 0, sizeof *r);
    memset(&target, 0, sizeof target);
    grid_of(&grid, q);
    grid.flags = q->thin ? TRIBOX_THIN : 0u;
    if (!tbx_grid_valid(&grid)) {
        return;
    }
    tbx_quick_init(quick, &grid, &target, 0);
    if (!quick->on) {
        return;
    }
    for (c = 0; c < 3; c++) {
        v[c].x = tbx_wide_all((float)q->x[3 * c]);
        v[c].y = tbx_wide_all((float)q->x[3 * c + 1]);
        v[c].z = tbx_wide_all((float)q->x[3 * c + 2]);
    }
    quick->step[0] = quick->step[1] = quick->step[2] = 0.0f;    /* bounds of rounding alone */
    quick->lattice = 0;
    box.cut = box.lattice = box.unsure = tbx_wide_int(0);
    tbx_box_axis(quick, 0, v[0].x, v[1].x, v[2].x, &box);
    tbx_box_axis(quick, 1, v[0].y, v[1].y, v[2].y, &box);
    tbx_box_axis(quick, 2, v[0].z, v[1].z, v[2].z, &box);
    r->boxed = 1;
    r->unsure = box.unsure[0] != 0;
    for (k = 0; k < 3; k++) {
        float least = (float)q->x[k];
        float most = (float)q->x[k];
        for (c = 1; c < 3; c++) {
            const float x = (float)q->x[3 * c + k];
            least = x < least ? x : least;
            most = x > most ? x : most;
        }
        least *= quick->inverse[k + 1];
        most *= quick->inverse[k + 1];
        r->face[k][0][0] = least + quick->shift_down[k];
        r->face[k][0][1] = least + quick->shift_up[k];
        r->face[k][1][0] = most + quick->shift_down[k];
        r->face[k][1][1] = most + quick->shift_up[k];
        r->first[k] = box.first[k][0];
        r->last[k] = box.last[k][0];
        r->end[k] = quick->end[k];
    }
}

/* As the rows of a group do it, its lanes being copies of one triangle. */
__attribute__((noinline)) static void fill_rows(filled *r, const tbx_quick *quick, const numbers *q)
{
    tbx_rows rows;
    const tbx_row_lines *lines[3];
    tbx_group g;
    tribox_mesh mesh;
    tbx_source source;
    float x[9];
    int count[3];
    int i;
    int j;
    int k;

    if (!r->boxed || r->unsure) {
        return;
    }
    for (k = 0; k < 3; k++) {
        r->at[k] = r->first[k] - TBX_MARGIN;
        count[k] = r->last[k] - r->first[k] + 1;
        if (r->last[k] < TBX_MARGIN || r->first[k] > r->end[k] || r->first[k] <= 0 ||
            r->last[k] > r->end[k] + TBX_MARGIN || count[k] > TBX_ROWS) {
            return;
        }
        r->start[k] = r->at[k] < 0 ? -r->at[k] : 0;
        r->rows[k] = count[k] < q->n[k] - r->at[k] ? count[k] : q->n[k] - r->at[k];
    }
    for (i = 0; i < 9; i++) {
        x[i] = (float)q->x[i];
    }
    mesh.positions = x;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    memset(&g, 0, sizeof g);
    for (k = 0; k < 3; k++) {
        g.box[0][k] = r->at[k];
    }
    g.box[0][3] = (count[0] - 1) | (count[1] - 1) << 8 | (count[2] - 1) << 16;
    g.n = 1;
    tbx_group_pad(&g);
    source = tbx_source_float(&mesh);
    tbx_rows_set(&rows, quick, &g, &source);
    if (rows.unsure[0] != 0) {
        return;
    }
    lines[0] = &rows.x_of_y;
    lines[1] = &rows.x_of_z;
    lines[2] = &rows.y_of_z;
    r->placed = 1;
    for (k = 0; k < 3; k++) {
        const tbx_row_lines *l = lines[k];
        const int b = bounded_axis[k];
        tbx_lane_bounds_set(&r->bounds[k], l, 0, r->rows[row_axis[k]], r->start[b], r->rows[b]);
        for (i = 0; i < 3; i++) {
            /* NOWHERE is further away than any bound, and than its error */
            r->bounds_side[i][k][0] = l->lo_least[i][0] > -32768.0f || l->lo_slope[i][0] != 0.0f;
            r->bounds_side[i][k][1] = l->hi_most[i][0] < 32768.0f || l->hi_slope[i][0] != 0.0f;
            r->flat[k] |= r->bounds_side[i][k][0] && r->bounds_side[i][k][1];
        }
        for (j = 0; j < ROWS_ASKED; j++) {
            const int row = (q->index[j] + k * q->index[2]) % r->rows[row_axis[k]];
            r->row[k][j] = row;
            for (i = 0; i < 3; i++) {
                const float lo = l->lo_slope[i][0] * (float)row;
                const float hi = l->hi_slope[i][0] * (float)row;
                r->bound[i][k][j][0][0] = l->lo_least[i][0] + lo;
                r->bound[i][k][j][0][1] = l->lo_most[i][0] + lo;
                r->bound[i][k][j][1][0] = l->hi_least[i][0] + hi;
                r->bound[i][k][j][1][1] = l->hi_most[i][0] + hi;
            }
        }
    }
    r->has_plane = rows.hi_least[0] < 65536.0f;
    for (j = 0; j < ROWS_ASKED && r->has_plane; j++) {
        const float middle = rows.at[0] + (float)r->row[1][j] * rows.slope_z[0];
        const float step = (float)r->row[0][j] * rows.slope_y[0];
        r->plane[j][0][0] = middle + rows.lo_least[0] + step;
        r->plane[j][0][1] = middle + rows.lo_most[0] + step;
        r->plane[j][1][0] = middle + rows.hi_least[0] + step;
        r->plane[j][1][1] = middle + rows.hi_most[0] + step;
    }
}
#endif

/* ---- the exact values ---------------------------------------------------------------------------------- */

static mpq_t v[3][3], low[3], extent[3], w[3], t, u, sum, largest, n[3], half_n[3];
#if TRIBOX_SIMD
static mpq_t size_of[3], factor, spread, middle;
#endif

static void exact_init(void)
{
    int i;

    for (i = 0; i < 9; i++) {
        mpq_init(v[i / 3][i % 3]);
    }
    for (i = 0; i < 3; i++) {
        mpq_inits(low[i], extent[i], w[i], n[i], half_n[i], (void *)0);
    }
    mpq_inits(t, u, sum, largest, (void *)0);
#if TRIBOX_SIMD
    mpq_inits(size_of[0], size_of[1], size_of[2], factor, spread, middle, (void *)0);
#endif
}

/* (v_j - v_i) . k */
static void edge(mpq_t r, int i, int j, int k)
{
    mpq_sub(r, v[j][k], v[i][k]);
}

static void exact_normal(void)
{
    int a;

    for (a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        edge(t, 0, 1, b);
        edge(u, 1, 2, c);
        mpq_mul(n[a], t, u);
        edge(t, 0, 1, c);
        edge(u, 1, 2, b);
        mpq_mul(t, t, u);
        mpq_sub(n[a], n[a], t);
    }
}

/* w of condition id, and sum = w.(centre - v_i) + the support of w: sum |w| h, or max |w| h */
static void exact_condition(int id, int thin)
{
    const int i = id < 9 ? id % 3 : 0;
    int k;

    for (k = 0; k < 3; k++) {
        mpq_set_si(w[k], 0, 1);
    }
    if (id < 9) {
        const int a = id / 3;
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        edge(w[b], i, (i + 1) % 3, c);
        edge(w[c], i, (i + 1) % 3, b);
        mpq_neg(w[mpq_sgn(n[a]) >= 0 ? b : c], w[mpq_sgn(n[a]) >= 0 ? b : c]);
    } else {
        for (k = 0; k < 3; k++) {
            mpq_set(w[k], n[k]);
            if (id == 10) {
                mpq_neg(w[k], w[k]);
            }
        }
    }
    mpq_set_si(sum, 0, 1);
    mpq_set_si(largest, 0, 1);
    for (k = 0; k < 3; k++) {
        mpq_div_2exp(t, extent[k], 1);
        mpq_add(u, low[k], t);
        mpq_sub(u, u, v[i][k]);
        mpq_mul(u, u, w[k]);
        mpq_add(sum, sum, u);
        mpq_mul(t, t, w[k]);
        mpq_abs(t, t);
        if (!thin) {
            mpq_add(sum, sum, t);
        } else if (mpq_cmp(t, largest) > 0) {
            mpq_set(largest, t);
        }
    }
    mpq_add(sum, sum, largest);
}

/* sum = half the filter's value k, of the box low, extent: the least of r_i + |n/2| - |n/2 - c_i| with
 * c_i = w_i x w_i+1 about the box's centre, r_i = |e_b| h_c + |e_c| h_b; or |n|.h - |n.(centre - v0)| */
static void exact_one_box(int k)
{
    int i;
    int a;

    for (a = 0; a < 3; a++) {
        mpq_abs(half_n[a], n[a]);
        mpq_div_2exp(half_n[a], half_n[a], 1);
    }
    if (k == 3) {
        mpq_set_si(sum, 0, 1);
        mpq_set_si(largest, 0, 1);
        for (a = 0; a < 3; a++) {
            mpq_mul(t, half_n[a], extent[a]);
            mpq_add(sum, sum, t);
            mpq_div_2exp(t, extent[a], 1);
            mpq_add(t, t, low[a]);
            mpq_sub(t, t, v[0][a]);
            mpq_mul(t, t, n[a]);
            mpq_add(largest, largest, t);
        }
        mpq_abs(largest, largest);
        mpq_sub(sum, sum, largest);
        return;
    }
    for (i = 0; i < 3; i++) {
        const int b = (k + 1) % 3;
        const int c = (k + 2) % 3;
        const int j = (i + 1) % 3;
        mpq_t from[2], to[2], value;
        mpq_inits(from[0], from[1], to[0], to[1], value, (void *)0);
        for (a = 0; a < 2; a++) {
            const int axis = a == 0 ? b : c;
            mpq_div_2exp(t, extent[axis], 1);
            mpq_add(t, t, low[axis]);
            mpq_sub(from[a], v[i][axis], t);
            mpq_sub(to[a], v[j][axis], t);
        }
        mpq_mul(value, from[0], to[1]);
        mpq_mul(t, from[1], to[0]);
        mpq_sub(value, value, t);           /* c_i */
        mpq_div_2exp(t, n[k], 1);
        mpq_sub(value, t, value);
        mpq_abs(value, value);
        mpq_neg(value, value);
        mpq_add(value, value, half_n[k]);
        edge(t, i, j, b);
        mpq_abs(t, t);
        mpq_mul(t, t, extent[c]);
        mpq_div_2exp(t, t, 1);
        mpq_add(value, value, t);
        edge(t, i, j, c);
        mpq_abs(t, t);
        mpq_mul(t, t, extent[b]);
        mpq_div_2exp(t, t, 1);
        mpq_add(value, value, t);
        if (i == 0 || mpq_cmp(value, sum) < 0) {
            mpq_set(sum, value);
        }
        mpq_clears(from[0], from[1], to[0], to[1], value, (void *)0);
    }
}

/* The power of two by which a prepared condition was scaled: its largest slope tells. */
static int scale_exponent(const double slope[3])
{
    int most = 0;
    int k;

    for (k = 1; k < 3; k++) {
        most = fabs(slope[k]) > fabs(slope[most]) ? k : most;
    }
    return (int)lround(log2(fabs(slope[most]) / fabs(mpq_get_d(w[most]))));
}

/* The largest |value - exact| / bound. */
static double worst_part(const computed *r, const numbers *q, int kind)
{
    double worst = 0.0;
    int i;
    int k;

    for (i = 0; i < 9; i++) {
        mpq_set_d(v[i / 3][i % 3], q->x[i]);
    }
    for (k = 0; k < 3; k++) {
        mpq_set_d(low[k], kind == ONE_BOX ? r->clip.lo[k] : q->x[9 + k]);
        mpq_set_d(extent[k], kind == ONE_BOX ? r->clip.hi[k] : q->x[12 + k]);
        if (kind == ONE_BOX) {
            mpq_sub(extent[k], extent[k], low[k]);
        } else if (kind == OCTANTS) {
            mpq_add(low[k], low[k], extent[k]);
        } else if (kind == WALK) {
            mpq_set_si(t, r->index[k], 1);
            mpq_mul(t, t, extent[k]);
            mpq_add(low[k], low[k], t);
        }
    }
    exact_normal();
    for (i = 0; i < VALUES; i++) {
        if (!(r->bound[i] > 0.0)) {
            continue;
        }
        if (kind == ONE_BOX) {
            exact_one_box(i);
            mpq_mul_2exp(sum, sum, 1);
        } else {
            exact_condition(i, q->thin);
        }
        if (kind == PREPARED || kind == PREPARED_FLOAT || kind == OCTANTS) {
            const int scale = scale_exponent(r->slope[i]);
            if (scale > 0) {
                mpq_mul_2exp(sum, sum, (mp_bitcnt_t)scale);
            } else {
                mpq_div_2exp(sum, sum, (mp_bitcnt_t)-scale);
            }
        }
        mpq_set_d(t, r->value[i]);
        mpq_sub(t, t, sum);
        mpq_set_d(u, r->bound[i]);
        mpq_div(t, t, u);
        worst = fabs(mpq_get_d(t)) > worst ? fabs(mpq_get_d(t)) : worst;
    }
    return worst;
}

#if TRIBOX_SIMD
static const double wrong = 1e9;    /* an answer, not just a bound */

/* low = v_0, v_1, v_2 = corners from the corner of voxel `from`, in the caller's unit */
static void exact_place(const numbers *q, const int from[3])
{
    int c;
    int k;

    for (k = 0; k < 3; k++) {
        mpq_set_d(size_of[k], q->x[12 + k]);
        mpq_set_si(t, from[k], 1);
        mpq_mul(t, t, size_of[k]);
        mpq_set_d(u, q->x[9 + k]);
        mpq_add(low[k], t, u);
        for (c = 0; c < 3; c++) {
            mpq_set_d(v[c][k], q->x[3 * c + k]);
            mpq_sub(v[c][k], v[c][k], low[k]);
        }
    }
}

/* |middle of least and most - exact / factor| / half of what is between them, factor > 0 */
static double part_of(float least, float most, mpq_t exact)
{
    if (!(least <= most)) {
        return wrong;
    }
    if (least < -FLT_MAX || most > FLT_MAX) {
        return 0.0;
    }
    mpq_set_d(t, (double)least);
    mpq_set_d(u, (double)most);
    mpq_sub(sum, u, t);
    mpq_mul(sum, sum, factor);      /* 2 factor * bound */
    mpq_add(t, t, u);
    mpq_mul(t, t, factor);
    mpq_sub(t, t, exact);
    mpq_sub(t, t, exact);           /* 2 factor * error */
    mpq_abs(t, t);
    if (mpq_sgn(t) == 0) {
        return 0.0;
    }
    return mpq_sgn(sum) == 0 ? wrong : mpq_get_d(t) / mpq_get_d(sum);
}

static int floor_of(mpq_t x, mpq_t over, int least, int most)
{
    int r;

    mpq_div(x, x, over);
    mpz_fdiv_q(mpq_numref(x), mpq_numref(x), mpq_denref(x));
    r = mpz_cmp_si(mpq_numref(x), least) < 0 ? least
      : mpz_cmp_si(mpq_numref(x), most) > 0  ? most
                                             : (int)mpz_get_si(mpq_numref(x));
    mpz_set_ui(mpq_denref(x), 1);
    return r;
}

/* Index boxes, voxels counted from the region's minimum corner, TBX_MARGIN added. */
static double boxes_part(const filled *r, const numbers *q)
{
    double worst = 0.0;
    int from[3];
    int k;

    for (k = 0; k < 3; k++) {
        from[k] = q->lo[k] - TBX_MARGIN;
    }
    exact_place(q, from);
    for (k = 0; k < 3; k++) {
        int c;
        int side;
        mpq_set(factor, size_of[k]);
        for (side = 0; side < 2; side++) {
            const int far_out = r->end[k] + 1 + TBX_MARGIN;
            int index;
            mpq_set(middle, v[0][k]);
            for (c = 1; c < 3; c++) {
                if ((mpq_cmp(v[c][k], middle) < 0) == (side == 0)) {
                    mpq_set(middle, v[c][k]);
                }
            }
            mpq_set(w[0], middle);
            index = floor_of(w[0], factor, -1, far_out);
            if (index >= 0 && index < far_out) {
                const double part = part_of(r->face[k][side][0], r->face[k][side][1], middle);
                worst = part > worst ? part : worst;
            }
            /* off the region: also strictly, since no bound is met */
            if (side == 0 ? r->first[k] > r->end[k] && index <= r->end[k]
                          : r->last[k] < TBX_MARGIN && index >= TBX_MARGIN) {
                return wrong;
            }
            if (!r->unsure && index >= 0 && index < far_out &&
                index != (side == 0 ? r->first[k] : r->last[k])) {
                return wrong;
            }
        }
    }
    return worst;
}

/* middle and spread of edge i in a row of a plane, times factor. Returns the sign of d_r. */
static int exact_row_edge(int i, int plane, int row, int thin)
{
    const int b = bounded_axis[plane];
    const int r = row_axis[plane];
    const int j = (i + 1) % 3;
    int sign;

    edge(w[0], i, j, b);
    edge(w[1], i, j, r);
    sign = mpq_sgn(w[1]);
    mpq_set_si(t, 2 * row + 1, 2);
    mpq_canonicalize(t);
    mpq_mul(t, t, size_of[r]);
    mpq_sub(t, t, v[i][r]);
    mpq_mul(t, t, w[0]);
    mpq_mul(middle, v[i][b], w[1]);
    mpq_add(middle, middle, t);
    if (sign < 0) {
        mpq_neg(middle, middle);
    }
    mpq_abs(w[1], w[1]);
    mpq_mul(factor, w[1], size_of[b]);
    mpq_add(middle, middle, factor);        /* voxels are counted from 1 */
    mpq_abs(w[0], w[0]);
    mpq_mul(spread, w[0], size_of[r]);
    if (thin) {
        mpq_sub(spread, spread, factor);
        if (mpq_sgn(spread) < 0) {
            mpq_set_si(spread, 0, 1);
        }
    }
    mpq_div_2exp(spread, spread, 1);
    return sign;
}

/* What the edges bound together in a row: of a triangle that the header takes for a segment in that plane,
 * whose edges bound from both sides, no bound may cut off what the exact edges leave. */
static int flat_row_holds(const filled *r, int plane, int j, int area, int thin)
{
    const int b = bounded_axis[plane];
    const int row = r->row[plane][j];
    int first = r->start[b] + 1;
    int last = r->rows[b];
    int i;

    for (i = 0; i < 3; i++) {
        const int sign = exact_row_edge(i, plane, row, thin);
        if (sign != 0 && sign * area <= 0) {
            int at;
            mpq_sub(t, middle, spread);
            at = floor_of(t, factor, first, r->rows[b] + 1);
            first = at > first ? at : first;
        }
        if (sign != 0 && sign * area >= 0) {
            int at;
            mpq_add(t, middle, spread);
            at = floor_of(t, factor, 0, last);
            last = at < last ? at : last;
        }
    }
    return (int)r->bounds[plane].lo_least[row] <= first && (int)r->bounds[plane].lo_most[row] >= first &&
           (int)r->bounds[plane].hi_least[row] <= last && (int)r->bounds[plane].hi_most[row] >= last;
}

static double edges_part(const filled *r, const numbers *q)
{
    double worst = 0.0;
    int plane;
    int i;
    int j;
    int side;

    exact_normal();
    for (plane = 0; plane < 3; plane++) {
        const int area = plane == 1 ? -mpq_sgn(n[1]) : mpq_sgn(n[plane == 0 ? 2 : 0]);
        for (j = 0; j < ROWS_ASKED; j++) {
            if (r->flat[plane] && !flat_row_holds(r, plane, j, area, q->thin)) {
                return wrong;
            }
            for (i = 0; i < 3; i++) {
                for (side = 0; side < 2; side++) {
                    const float *bound = r->bound[i][plane][j][side];
                    double part;
                    int sign;
                    if (!r->bounds_side[i][plane][side]) {
                        continue;
                    }
                    sign = exact_row_edge(i, plane, r->row[plane][j], q->thin);
                    if (sign == 0 || (!r->flat[plane] && sign * area != (side == 0 ? -1 : 1))) {
                        return wrong;   /* the steps to d_r are monotone: its sign is right */
                    }
                    if (bound[0] <= 0.5f && bound[1] >= (float)r->rows[bounded_axis[plane]] + 1.5f) {
                        continue;       /* the whole box: d_r is below its error */
                    }
                    (side == 0 ? mpq_sub : mpq_add)(middle, middle, spread);
                    part = part_of(bound[0], bound[1], middle);
                    worst = part > worst ? part : worst;
                }
            }
        }
    }
    return worst;
}

static double plane_part(const filled *r, const numbers *q)
{
    double worst = 0.0;
    int sign;
    int j;
    int k;
    int side;

    exact_normal();
    sign = mpq_sgn(n[0]);
    if (sign == 0) {
        return wrong;
    }
    for (k = 0; k < 3; k++) {
        mpq_mul(w[k], n[k], size_of[k]);
        mpq_abs(w[k], w[k]);
    }
    mpq_set(factor, w[0]);
    if (q->thin) {
        mpq_set(spread, mpq_cmp(w[1], w[2]) > 0 ? w[1] : w[2]);
        mpq_sub(spread, spread, w[0]);
        if (mpq_sgn(spread) < 0) {
            mpq_set_si(spread, 0, 1);
        }
    } else {
        mpq_add(spread, w[1], w[2]);
    }
    mpq_div_2exp(spread, spread, 1);
    for (j = 0; j < ROWS_ASKED; j++) {
        mpq_mul(middle, n[0], v[0][0]);
        for (k = 1; k < 3; k++) {
            mpq_set_si(t, 2 * r->row[k - 1][j] + 1, 2);
            mpq_canonicalize(t);
            mpq_mul(t, t, size_of[k]);
            mpq_sub(t, t, v[0][k]);
            mpq_mul(t, t, n[k]);
            mpq_sub(middle, middle, t);
        }
        if (sign < 0) {
            mpq_neg(middle, middle);
        }
        mpq_add(middle, middle, factor);        /* voxels are counted from 1 */
        mpq_sub(w[1], middle, spread);
        mpq_add(w[2], middle, spread);
        for (side = 0; side < 2; side++) {
            const double part = part_of(r->plane[j][side][0], r->plane[j][side][1], w[1 + side]);
            worst = part > worst ? part : worst;
        }
    }
    return worst;
}

static double ask_fill(const numbers *q, int kind, int mode)
{
    tbx_quick quick;
    filled r;
    int from[3];
    int k;

    fesetround(mode);
    fill_boxes(&r, &quick, q);
    if (kind != FILL_BOXES) {
        fill_rows(&r, &quick, q);
    }
    fesetround(FE_TONEAREST);
    if (kind == FILL_BOXES) {
        return r.boxed ? boxes_part(&r, q) : 0.0;
    }
    if (!r.placed || (kind == FILL_PLANE && !r.has_plane)) {
        return 0.0;
    }
    for (k = 0; k < 3; k++) {
        from[k] = q->lo[k] + r.at[k];
    }
    exact_place(q, from);
    return kind == FILL_EDGES ? edges_part(&r, q) : plane_part(&r, q);
}
#endif

/* ---- places and rests: decimals near the places of a grid ------------------------------------------------ */

enum { PIECES = (int)TBX_PIECES, SUMS = 26 };

/* Of each corner and axis what is left of its place, of each edge E, and D: by the walk, then by lanes. */
typedef struct placed {
    int    known;
    int    by_lanes;
    int    at[3];               /* the grid point asked about, in PIECES */
    double place[9];
    double rest[9];
    double whole[SUMS];
    double other[SUMS];
    double error[SUMS];         /* 0: no value */
} placed;

__attribute__((noinline)) static void places(placed *r, const numbers *q)
{
    tbx_frame f;
    tbx_part all;
    tbx_walk walk;
    tribox_grid grid;
    double corner[3][3];
    double p[3];
    int i;
    int k;

    memset(r, 0, sizeof *r);
    grid_of(&grid, q);
    for (i = 0; i < 9; i++) {
        corner[i / 3][i % 3] = q->x[i];
    }
    tbx_frame_init(&f, &grid);
    tbx_part_all(&all, &grid);
    if (!tbx_walk_box(&walk, &f, corner, tbx_corners_kind(corner), &all) || !tbx_walk_place(&walk)) {
        return;
    }
    r->known = 1;
    for (k = 0; k < 3; k++) {
        r->at[k] = PIECES * (int)(q->lo[k] + walk.whole[k] + 1 + q->index[k]);
        p[k] = (double)r->at[k];
        for (i = 0; i < 3; i++) {
            r->place[3 * i + k] = walk.place[i][k];
            r->rest[3 * i + k] = walk.rest[i][k];
        }
    }
    for (i = 0; i < 10; i++) {
        tbx_fine fine;
        if (i < 9) {
            tbx_fine_edge(&fine, &walk, i % 3, i / 3, p);
        } else {
            tbx_fine_plane(&fine, &walk, p);
        }
        r->whole[i] = fine.whole;
        r->other[i] = fine.rest;
        r->error[i] = fine.error;
    }
#if TRIBOX_SIMD
    if (walk.more[0] < 8 && walk.more[1] < 8 && walk.more[2] < 8) {
        static const tbx_target target;
        tbx_quick quick;
        tbx_precise_axis axis[3];
        tbx_precise_normal normal[3];
        tbx_precise_line line;
        tbx_mp unsure = tbx_pair_bits(0);
        int is_double = 0;
        for (i = 0; i < 9; i++) {
            is_double |= (double)(float)q->x[i] < q->x[i] || (double)(float)q->x[i] > q->x[i];
        }
        tbx_quick_init(&quick, &grid, &target, is_double);
        if (!quick.precise) {
            return;
        }
        for (k = 0; k < 3; k++) {
            for (i = 0; i < 3; i++) {
                axis[k].x[i] = tbx_pair_all(corner[i][k]);
            }
            tbx_precise_set(&axis[k], &quick, k, tbx_pair_all((double)(r->at[k] - PIECES * q->index[k])), &unsure);
        }
        if (unsure[0] != 0) {
            return;
        }
        for (i = 0; i < 9; i++) {
            const int a = i / 3;
            const int b = (a + 1) % 3;
            const int c = (a + 2) % 3;
            const int j = i % 3;
            int step;
            tbx_precise_edge(&line, &axis[b], &axis[c], j);
            if (j == 0) {
                normal[a].whole = normal[a].rest = tbx_pair_all(0.0);
            }
            normal[a].whole += line.whole;
            normal[a].rest += line.rest;
            for (step = 0; step < q->index[b]; step++) {
                line.whole -= (axis[c].place[j + 1] - axis[c].place[j]) * tbx_pair_all(PIECES);
                line.rest -= (axis[c].rest[j + 1] - axis[c].rest[j]) * tbx_pair_all(PIECES);
            }
            for (step = 0; step < q->index[c]; step++) {
                line.whole += (axis[b].place[j + 1] - axis[b].place[j]) * tbx_pair_all(PIECES);
                line.rest += (axis[b].rest[j + 1] - axis[b].rest[j]) * tbx_pair_all(PIECES);
            }
            r->whole[10 + i] = line.whole[0];
            r->other[10 + i] = line.rest[0];
            r->error[10 + i] = line.error[0];
        }
        tbx_precise_plane_at(&line, axis, normal);
        for (k = 0; k < 3; k++) {
            int step;
            for (step = 0; step < q->index[k]; step++) {
                line.whole -= normal[k].whole * tbx_pair_all(PIECES);
                line.rest -= normal[k].rest * tbx_pair_all(PIECES);
            }
        }
        r->whole[19] = line.whole[0];
        r->other[19] = line.rest[0];
        r->error[19] = line.error[0];
    }
#endif
}

/* |value - exact| / bound, the value a sum of two. */
static double part_of_sum(double whole, double other, double bound, mpq_t exact)
{
    mpq_set_d(t, whole);
    mpq_set_d(u, other);
    mpq_add(t, t, u);
    mpq_sub(t, t, exact);
    mpq_abs(t, t);
    return mpq_sgn(t) == 0 ? 0.0 : bound > 0.0 ? mpq_get_d(t) / bound : wrong;
}

static double ask_places(const numbers *q, int mode)
{
    placed r;
    double worst = 0.0;
    int i;
    int k;

    fesetround(mode);
    places(&r, q);
    fesetround(FE_TONEAREST);
    if (!r.known) {
        return 0.0;
    }
    for (i = 0; i < 9; i++) {       /* v in PIECES, from its place, then from the point asked about */
        mpq_t *x = &v[i / 3][i % 3];
        double part;
        mpq_set_d(*x, q->x[i]);
        mpq_set_d(t, q->x[9 + i % 3]);
        mpq_sub(*x, *x, t);
        mpq_set_d(t, q->x[12 + i % 3]);
        mpq_div(*x, *x, t);
        mpq_set_si(t, PIECES, 1);
        mpq_mul(*x, *x, t);
        part = part_of_sum(r.place[i], r.rest[i], fabs(r.rest[i]) * TBX_REST_ERROR, *x);
        worst = part > worst ? part : worst;
        mpq_set_si(t, r.at[i % 3], 1);
        mpq_sub(*x, *x, t);
    }
    mpq_set_si(sum, 0, 1);          /* D */
    for (i = 0; i < 9; i++) {
        const int a = i / 3;
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        const int from = i % 3;
        const int to = (from + 1) % 3;
        mpq_mul(largest, v[from][b], v[to][c]);
        mpq_mul(t, v[from][c], v[to][b]);
        mpq_sub(largest, largest, t);
        mpq_mul(t, largest, v[0][a]);
        mpq_add(sum, sum, t);
        for (k = 0; k <= 10; k += 10) {
            if (r.error[i + k] > 0.0) {
                const double part = part_of_sum(r.whole[i + k], r.other[i + k], r.error[i + k], largest);
                worst = part > worst ? part : worst;
            }
        }
    }
    for (k = 9; k < 20; k += 10) {
        if (r.error[k] > 0.0) {
            const double part = part_of_sum(r.whole[k], r.other[k], r.error[k], sum);
            worst = part > worst ? part : worst;
        }
    }
    return worst;
}

/* Decimals, near the places of a grid or not; floats or doubles; a grid with an origin of its own now and then. */
static void any_places(numbers *q)
{
    static const double sizes[4] = {0.1, 0.05, 1.0 / 3.0, 0.7};
    const double size = sizes[random_below(4)];
    const double off = random_below(2) == 0 ? 0.0 : random_below(2) == 0 ? 1e4 + 0.1 : 100.0 * random_signed();
    const int wide = 1 + random_below(8);
    const int pieces = random_below(2) == 0 ? PIECES : random_below(2) == 0 ? 4 : 1;
    const int as_float = random_below(2);
    int c;
    int k;

    for (k = 0; k < 3; k++) {
        const int first = random_below(2) == 0 ? 0 : random_below(2000) - 1000;
        q->x[9 + k] = off;
        q->x[12 + k] = random_below(4) == 0 ? sizes[random_below(4)] : size;
        q->lo[k] = -10000;
        q->n[k] = 20000;
        q->index[k] = random_below(wide < 8 ? wide : 7);
        for (c = 0; c < 3; c++) {
            const double at = first + (double)(random_below(wide * PIECES + 1) / pieces * pieces) / PIECES;
            q->x[3 * c + k] = off + at * q->x[12 + k];
            if (random_below(8) == 0) {
                q->x[3 * c + k] += random_signed() * q->x[12 + k] * ldexp(1.0, -random_below(50));
            }
            if (as_float) {
                q->x[3 * c + k] = (double)(float)q->x[3 * c + k];
            }
        }
    }
}

static void change_places(numbers *q)
{
    const int i = random_below(9);

    if (random_below(4) == 0) {
        q->x[i] = q->x[(i + 3) % 9];
    } else if (random_below(3) == 0) {
        q->x[i] = nextafter(q->x[i], random_below(2) == 0 ? 1e30 : -1e30);
    } else if (random_below(2) == 0) {
        q->x[i] = (double)(float)q->x[i];
    } else {
        q->x[i] += random_signed() * q->x[12 + i % 3] * ldexp(1.0, -random_below(50));
    }
    if (random_below(4) == 0) {
        q->index[i % 3] = random_below(7);
    }
}

static double ask(const numbers *q, int kind, int mode)
{
    computed r;

    if (kind == PLACES) {
        return ask_places(q, mode);
    }

#if TRIBOX_SIMD
    if (kind >= FILL_BOXES) {
        return ask_fill(q, kind, mode);
    }
#endif

    memset(&r, 0, sizeof r);
    fesetround(mode);
    if (kind == ONE_BOX) {
        one_box(&r, q);
    } else if (kind == WALK) {
        walked(&r, q);
    } else {
        prepared(&r, q, kind != PREPARED, kind == OCTANTS);
    }
    fesetround(FE_TONEAREST);
    return worst_part(&r, q, kind);
}

/* ---- the search ---------------------------------------------------------------------------------------- */

/* The float test is asked floats, octants of any triangle about a float p. */
static double as_asked(int kind, int i, double x)
{
    return kind == PREPARED_FLOAT || (kind == OCTANTS && i >= 9 && i < 12) ? (double)(float)x : x;
}

#if TRIBOX_SIMD
/* A triangle in a box of up to 64 voxels a side, in a region anywhere; its shape now and then a sliver, one
 * in a projection only, a segment there, small, or with an edge along an axis or nearly so. Some regions are
 * far from the grid's origin and near 0, where floats are closest together. */
static void any_fill(numbers *q)
{
    static const double sizes[4] = {1.0, 0.1, 1.0 / 3.0, 0.7};
    const int like = random_below(4);
    const int place = random_below(6);
    const int shape = random_below(10);
    const double reach = ldexp(64.0, -random_below(6));
    const double small = shape == 0 ? ldexp(1.0, -random_below(30)) : 1.0;
    const double thinness = random_below(4) == 0 ? 0.0 : ldexp(random_signed(), -random_below(60));
    const double between = ldexp((double)random_below(65), -5) - 0.5;
    const int axis = random_below(3);
    int c;
    int k;

    for (k = 0; k < 3; k++) {
        const double side = (random_below(3) == 0 ? 2.0 + 62.0 * fabs(random_signed()) : reach) * small;
        const double size = sizes[random_below(2) == 0 ? like : random_below(4)];
        const int near_zero = place >= 3 && (random_below(3) == 0 || (k == axis && shape >= 3));
        double corner;
        q->x[12 + k] = size;
        q->lo[k] = random_below(2) == 0 ? 0 : random_below(place == 2 ? 200000 : 200) - 100;
        q->n[k] = 1 + random_below(random_below(8) == 0 ? 3000 : 130);
        q->x[9 + k] = place == 0 ? 0.0 : random_signed() * (place == 1 ? 4.0 : 1e5) * size;
        corner = q->x[9 + k] + (q->lo[k] - 8.0 + (q->n[k] + 8) * fabs(random_signed())) * size;
        if (near_zero) {
            q->lo[k] = place == 3 ? q->lo[k] : random_below(200000) - 100000;
            q->x[9 + k] = (random_signed() * 8.0 - q->n[k] / 2 - q->lo[k]) * size;
            corner = random_below(2) == 0 ? -0.25 * side * size : 0.0;
        }
        for (c = 0; c < 3; c++) {
            q->x[3 * c + k] = corner + side * size * fabs(random_signed());
        }
        if (shape <= 2 || (shape <= 4 && k != axis)) {
            q->x[6 + k] = q->x[k] + between * (q->x[3 + k] - q->x[k]) +
                          side * size * thinness * random_signed();
        } else if (shape == 5 && k == axis) {
            q->x[3 + k] = q->x[k] + side * size * thinness;
        } else if ((shape == 6 || shape == 7) && k == axis) {
            for (c = 0; c < 3; c++) {
                q->x[3 * c + k] = corner * (shape - 6) + side * size * thinness * random_signed();
            }
        } else if (shape == 8 && k != axis) {
            q->x[3 + k] = q->x[k] + side * size * thinness * random_signed();
        }
        for (c = 0; c < 3; c++) {
            q->x[3 * c + k] = (double)(float)q->x[3 * c + k];
        }
        q->index[k] = random_below(TBX_ROWS);
    }
    q->thin = random_below(4) == 0;
}

static void change_fill(numbers *q)
{
    const int i = random_below(9);

    if (random_below(8) == 0) {
        q->x[i] = q->x[(i + 3) % 9];
    } else if (random_below(4) == 0) {
        q->x[i] = (double)nextafterf((float)q->x[i], random_below(2) == 0 ? FLT_MAX : -FLT_MAX);
    } else {
        q->x[i] += random_signed() * q->x[12 + i % 3] * ldexp(64.0, -random_below(60));
        q->x[i] = (double)(float)q->x[i];
    }
    if (random_below(4) == 0) {
        q->index[random_below(3)] = random_below(TBX_ROWS);
    }
    if (random_below(8) == 0) {
        q->x[9 + i % 3] += random_signed() * q->x[12 + i % 3] * ldexp(64.0, -random_below(55));
    }
    if (random_below(8) == 0) {
        q->x[12 + i % 3] *= 1.0 + random_signed() * ldexp(1.0, -2 - random_below(50));
    }
}
#endif

static void any_question(numbers *q, int kind)
{
    const double far_off = random_below(3) == 0 ? ldexp(random_signed(), random_below(12)) : 0.0;
    int i;

    memset(q, 0, sizeof *q);
    if (kind == PLACES) {
        any_places(q);
        return;
    }
#if TRIBOX_SIMD
    if (kind >= FILL_BOXES) {
        any_fill(q);
        return;
    }
#endif
    for (i = 0; i < 15; i++) {
        q->x[i] = as_asked(kind, i, as_asked(kind, i, random_signed()) + far_off);
    }
    for (i = 0; i < 3; i++) {
        if (kind == ONE_BOX) {
            const double a = q->x[9 + i];
            const double b = q->x[12 + i];
            q->x[9 + i] = a < b ? a : b;
            q->x[12 + i] = a < b ? b : a;
        } else {
            const double x = fabs(as_asked(kind, 12 + i, random_signed()));
            q->x[12 + i] = x / (kind == WALK ? 1 << random_below(6) : 1);
        }
        q->index[i] = random_below(1000);
    }
    q->thin = random_below(4) == 0;
}

static void change(numbers *q, int kind)
{
    const int i = random_below(15);
    const int as_float = kind == PREPARED_FLOAT || kind == OCTANTS;
    double x = q->x[i] + random_signed() * ldexp(1.0, -random_below(as_float ? 26 : 55));

    if (kind == PLACES) {
        change_places(q);
        return;
    }
#if TRIBOX_SIMD
    if (kind >= FILL_BOXES) {
        change_fill(q);
        return;
    }
#endif
    x = as_asked(kind, i, x);
    q->x[i] = i >= 12 && kind != ONE_BOX ? fabs(x) : x;
    if (random_below(4) == 0) {
        q->index[random_below(3)] = random_below(1000);
    }
}

static void print_question(const numbers *q)
{
    int i;

    for (i = 0; i < 15; i++) {
        printf("%a%s", q->x[i], i % 3 == 2 ? "\n" : ", ");
    }
    printf("index %d %d %d, lo %d %d %d, n %d %d %d, thin %d\n", q->index[0], q->index[1], q->index[2],
           q->lo[0], q->lo[1], q->lo[2], q->n[0], q->n[1], q->n[2], q->thin);
}

int main(int argc, char **argv)
{
    static const int modes[4] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    static const char *const mode_names[4] = {"to nearest", "up", "down", "to zero"};
    const long thousands = argc > 1 ? atol(argv[1]) : 40;
    int failed = 0;
    int kind;
    int mode;

    random_state = (argc > 2 ? strtoull(argv[2], NULL, 10) : 1) * 0x9e3779b97f4a7c15u | 1u;
    exact_init();
    for (kind = 0; kind < KINDS; kind++) {
        for (mode = 0; mode < 4; mode++) {
            double worst = 0.0;
            long   done;
            for (done = 0; done < (kind >= FILL_BOXES ? 3 : 1) * thousands; done++) {
                numbers best;
                double  part = 0.0;
                int     step;
                any_question(&best, kind);
                for (step = 0; step < 1000; step++) {
                    numbers next = best;
                    double  at;
                    /* half of a fill's questions are new: of segments there is more to ask than of parts */
                    if (part > 0.0 && (kind < FILL_BOXES || random_below(2) != 0)) {
                        change(&next, kind);
                    } else if (step > 0) {
                        any_question(&next, kind);
                    }
                    at = ask(&next, kind, modes[mode]);
                    if (at >= part) {
                        part = at;
                        best = next;
                    }
                }
                if (part > 1.0 && worst <= 1.0) {
                    print_question(&best);
                }
                worst = part > worst ? part : worst;
            }
            printf("%-18s rounded %-11s worst error %.4f of the bound\n", kind_names[kind], mode_names[mode],
                   worst);
            failed += !(worst > 0.0 && worst <= 1.0);
        }
    }
    printf("%d passed, %d failed\n", 4 * KINDS - failed, failed);
    return failed != 0;
}
