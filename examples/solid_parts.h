/* solid_parts.h - the exact solid of a mesh (tribox_grid_fill_solid), of its parts one by one, and its open rows
 *
 * A part is a set of triangles that hang together by corners at the same place. By edges would tear a part at a
 * T-junction, so parts that touch in one corner stay one: parity fills them as well, unless they overlap elsewhere.
 * Models are often made of closed
 * parts that overlap, and parity would leave out what two of them share; filled one by one and joined they are what
 * is meant. A part of opposite winding that lies wholly in another is its cavity, and both are filled together.
 */
#ifndef EXAMPLES_SOLID_PARTS_H
#define EXAMPLES_SOLID_PARTS_H
#include "progress.h"
#include "voxel_io.h"

/* Flips the voxels of a region inside `count` triangles of the mesh, those that `indices` list. */
static inline void solid_exact(const tribox_grid *grid, const mesh *m, const uint32_t *indices, size_t count,
                               uint64_t *bits) {
    tribox_mesh view = mesh_view(m);
    tribox_mesh_f64 exact = mesh_view_f64(m);
    view.indices = exact.indices = indices;
    view.triangles = exact.triangles = count;
    if (m->exact) {
        tribox_grid_fill_solid_f64(grid, &exact, bits);
    } else {
        tribox_grid_fill_solid(grid, &view, bits);
    }
}

/* Rows that are crossed an odd number of times: there the mesh is open. Told by a column of voxels beyond the
 * mesh, at the region's end in +x. The first few are returned as y, z. */
enum { SOLID_SHOWN = 3 };

static inline size_t solid_open_rows(const voxels *v, const mesh *m, int out_row[SOLID_SHOWN][2]) {
    char ignored[MESH_ERROR];
    voxels beyond;
    tribox_grid column = v->grid;
    size_t open = 0;
    size_t row;
    column.lo[0] = v->grid.hi[0];
    column.hi[0] = v->grid.hi[0] + 1;
    if (!voxels_make(&beyond, &column, ignored)) {
        return 0;
    }
    solid_exact(&column, m, m->indices, m->triangles, beyond.bits);
    for (row = 0; row < beyond.words; row++) {
        if (beyond.bits[row] & 1) {
            if (open < SOLID_SHOWN) {
                out_row[open][0] = column.lo[1] + (int)(row % beyond.n[1]);
                out_row[open][1] = column.lo[2] + (int)(row / beyond.n[1]);
            }
            open++;
        }
    }
    voxels_free(&beyond);
    return open;
}

/* ---- Parts ------------------------------------------------------------------------------------------------- */

typedef struct solid_part {
    size_t first;           /* of its triangles in the sorted index list */
    size_t triangles;
    double volume;          /* six times it, with the sign of the winding */
    double min[3];
    double max[3];
    size_t outer;           /* the part whose cavity it is; itself if it is none */
} solid_part;

typedef struct solid_parts {
    uint32_t   *indices;    /* of all triangles, part by part */
    solid_part *part;
    size_t      parts;
} solid_parts;

typedef struct solid_place {
    double x[3];
    size_t vertex;
} solid_place;

static inline int solid_compare_places(const void *a, const void *b) {
    const solid_place *p = (const solid_place *)a;
    const solid_place *q = (const solid_place *)b;
    int k;
    for (k = 0; k < 3; k++) {
        if (p->x[k] < q->x[k] || p->x[k] > q->x[k]) {
            return p->x[k] < q->x[k] ? -1 : 1;
        }
    }
    return 0;
}

static inline size_t solid_root(size_t *parent, size_t i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static inline size_t solid_vertex(const mesh *m, size_t t, size_t c) {
    return m->indices ? m->indices[3 * t + c] : 3 * t + c;
}

/* Joins vertices of one place, and the corners of each triangle. Finite numbers only: NaN would not sort. */
static inline int solid_join(const mesh *m, size_t *parent, char *finite) {
    solid_place *place = (solid_place *)malloc(3 * m->triangles * sizeof *place);
    size_t places = 0;
    size_t t;
    size_t i;
    if (!place) {
        return 0;
    }
    for (t = 0; t < m->triangles; t++) {
        double x[3][3];
        finite[t] = 1;
        for (i = 0; i < 9; i++) {
            if (i % 3 == 0) {
                mesh_corner_f64(m, t, i / 3, x[i / 3]);
            }
            finite[t] = (char)(finite[t] && fabs(x[i / 3][i % 3]) <= 1.7e308);
        }
        for (i = 0; i < 3 && finite[t]; i++) {
            memcpy(place[places].x, x[i], sizeof x[i]);
            place[places++].vertex = solid_vertex(m, t, i);
            parent[solid_root(parent, solid_vertex(m, t, i))] = solid_root(parent, solid_vertex(m, t, 0));
        }
    }
    qsort(place, places, sizeof *place, solid_compare_places);
    for (i = 1; i < places; i++) {
        if (solid_compare_places(&place[i - 1], &place[i]) == 0) {
            parent[solid_root(parent, place[i].vertex)] = solid_root(parent, place[i - 1].vertex);
        }
    }
    free(place);
    return 1;
}

static inline void solid_measure(solid_part *p, const mesh *m, const uint32_t *indices) {
    size_t i;
    int pass;
    int k;
    mesh part = *m;
    part.indices = (uint32_t *)(uintptr_t)indices;
    p->volume = 0;
    p->outer = 0;
    for (k = 0; k < 3; k++) {
        p->min[k] = HUGE_VAL;
        p->max[k] = -HUGE_VAL;
    }
    for (pass = 0; pass < 2; pass++) { /* bounds; then the volume about their corner, so that no digits are lost */
        for (i = p->first; i < p->first + p->triangles; i++) {
            double v[3][3];
            int c;
            for (c = 0; c < 3; c++) {
                mesh_corner_f64(&part, i, (size_t)c, v[c]);
                for (k = 0; k < 3; k++) {
                    p->min[k] = v[c][k] < p->min[k] ? v[c][k] : p->min[k];
                    p->max[k] = v[c][k] > p->max[k] ? v[c][k] : p->max[k];
                    v[c][k] -= p->min[k];
                }
            }
            for (k = 0; k < 3 && pass == 1; k++) {
                const int b = (k + 1) % 3;
                const int d = (k + 2) % 3;
                p->volume += v[0][k] * (v[1][b] * v[2][d] - v[1][d] * v[2][b]);
            }
        }
    }
}

/* Does `outer` hold every corner of `inner`, and is it wound the other way? */
static inline int solid_is_cavity(const mesh *m, const solid_parts *s, const solid_part *inner,
                                  const solid_part *outer) {
    tribox_mesh view = mesh_view(m);
    tribox_mesh_f64 exact = mesh_view_f64(m);
    mesh part = *m;
    size_t i;
    int k;
    if ((inner->volume > 0) == (outer->volume > 0) || fabs(inner->volume) >= fabs(outer->volume)) {
        return 0;
    }
    for (k = 0; k < 3; k++) {
        if (inner->min[k] < outer->min[k] || inner->max[k] > outer->max[k]) {
            return 0;
        }
    }
    part.indices = s->indices;
    view.indices = exact.indices = s->indices + 3 * outer->first;
    view.triangles = exact.triangles = outer->triangles;
    for (i = 0; i < 3 * inner->triangles; i++) {
        double point[3];
        mesh_corner_f64(&part, inner->first + i / 3, i % 3, point);
        if (!(m->exact ? tribox_mesh_contains_f64(&exact, point) : tribox_mesh_contains(&view, point))) {
            return 0;
        }
    }
    return 1;
}

/* Sorts triangles by part, and finds the cavities. Returns 1, or 0 if memory is short. */
static inline int solid_find_parts(solid_parts *s, const mesh *m) {
    size_t vertices = m->indices ? m->vertices : 3 * m->triangles;
    size_t *parent = (size_t *)malloc((vertices + 1) * sizeof *parent);
    size_t *number = (size_t *)calloc(vertices + 1, sizeof *number);
    char *finite = (char *)malloc(m->triangles + 1);
    size_t i;
    size_t j;
    int ok;
    s->indices = (uint32_t *)malloc((3 * m->triangles + 1) * sizeof *s->indices);
    s->part = NULL;
    s->parts = 0;
    for (i = 0; parent && i < vertices; i++) {
        parent[i] = i;
    }
    ok = parent && number && finite && s->indices && solid_join(m, parent, finite);
    for (i = 0; ok && i < m->triangles; i++) { /* number the parts from 1 */
        size_t root = solid_root(parent, solid_vertex(m, i, 0));
        if (finite[i] && number[root] == 0) {
            number[root] = ++s->parts;
        }
    }
    s->part = ok ? (solid_part *)calloc(s->parts + 1, sizeof *s->part) : NULL;
    ok = s->part != NULL;
    for (i = 0; ok && i < m->triangles; i++) {
        if (finite[i]) {
            s->part[number[solid_root(parent, solid_vertex(m, i, 0))] - 1].triangles++;
        }
    }
    for (i = 1; ok && i < s->parts; i++) {
        s->part[i].first = s->part[i - 1].first + s->part[i - 1].triangles;
    }
    for (i = 0; ok && i < m->triangles; i++) {
        if (finite[i]) {
            solid_part *p = &s->part[number[solid_root(parent, solid_vertex(m, i, 0))] - 1];
            for (j = 0; j < 3; j++) {
                s->indices[3 * (p->first + p->outer) + j] = (uint32_t)solid_vertex(m, i, j);
            }
            p->outer++; /* for now how many are placed */
        }
    }
    for (i = 0; ok && i < s->parts; i++) {
        solid_measure(&s->part[i], m, s->indices);
    }
    for (i = 0; ok && i < s->parts; i++) { /* the smallest part that holds it */
        size_t best = i;
        for (j = 0; j < s->parts; j++) {
            if (j != i && (best == i || fabs(s->part[j].volume) < fabs(s->part[best].volume)) &&
                solid_is_cavity(m, s, &s->part[i], &s->part[j])) {
                best = j;
            }
        }
        s->part[i].outer = best;
    }
    free(parent);
    free(number);
    free(finite);
    return ok;
}

/* The rows and layers of the region that a part's bounds meet, one more on each side. */
static inline void solid_cut(tribox_grid *cut, const voxels *v, const solid_part *p) {
    int k;
    for (k = 1; k < 3; k++) {
        double lo = floor((p->min[k] - v->grid.origin[k]) / v->grid.size[k]) - 1;
        double hi = floor((p->max[k] - v->grid.origin[k]) / v->grid.size[k]) + 2;
        cut->lo[k] = lo > cut->lo[k] ? lo < cut->hi[k] ? (int)lo : cut->hi[k] : cut->lo[k];
        cut->hi[k] = hi < cut->hi[k] ? hi > cut->lo[k] ? (int)hi : cut->lo[k] : cut->hi[k];
    }
}

/* Joins the solids of all parts into v. Returns 1, or 0 if memory is short. */
static inline int solid_by_parts(voxels *v, const mesh *m, size_t *out_parts, size_t *out_cavities) {
    solid_parts s;
    uint64_t *bits = (uint64_t *)malloc((v->words + 1) * sizeof *bits);
    int ok = solid_find_parts(&s, m) && bits;
    progress shown = progress_begin("solid");
    size_t i;
    size_t j;
    *out_parts = *out_cavities = 0;
    for (i = 0; ok && i < s.parts; i++) {
        tribox_grid cut = v->grid;
        size_t words;
        size_t y;
        size_t z;
        progress_show(&shown, (double)i, (double)s.parts);
        if (s.part[i].outer != i) {
            *out_cavities += 1;
            continue;
        }
        *out_parts += 1;
        solid_cut(&cut, v, &s.part[i]);
        words = tribox_grid_words(&cut);
        memset(bits, 0, words * sizeof *bits);
        for (j = 0; j < s.parts && words != 0; j++) {
            if (s.part[j].outer == i) {
                solid_exact(&cut, m, s.indices + 3 * s.part[j].first, s.part[j].triangles, bits);
            }
        }
        for (j = 0; j < words; j++) {
            y = (size_t)(cut.lo[1] - v->grid.lo[1]) + j / v->row_words % (size_t)(cut.hi[1] - cut.lo[1]);
            z = (size_t)(cut.lo[2] - v->grid.lo[2]) + j / v->row_words / (size_t)(cut.hi[1] - cut.lo[1]);
            v->bits[(z * v->n[1] + y) * v->row_words + j % v->row_words] |= bits[j];
        }
    }
    progress_end(&shown);
    free(bits);
    free(s.indices);
    free(s.part);
    return ok;
}

#endif /* EXAMPLES_SOLID_PARTS_H */
