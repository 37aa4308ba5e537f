/* mesh_io.h - reads a triangle mesh from an OBJ, STL (binary, ASCII), PLY (ASCII, binary of both byte orders),
 * OFF or glTF 2.0 (text, binary) file
 *
 *   mesh m;
 *   char error[MESH_ERROR];
 *   if (!mesh_read(&m, "model.ply", error)) { fprintf(stderr, "%s\n", error); exit(2); }
 *   tribox_mesh view = mesh_view(&m);
 *   ...
 *   mesh_free(&m);
 *
 * The format is told by the content, not by the name. Polygons are cut into triangles, concave ones too. A bad
 * file gives one sentence with the line or the byte, and what was read in spite of a fault gives a warning; nothing
 * a file holds makes the reader crash, and the memory it takes is a small multiple of the file's size: no number in
 * a file is believed before the bytes it speaks of are seen to be there.
 *
 * No digit is lost: where a coordinate of the file is no float, `exact` has all positions as doubles. A decimal of
 * a text stands for a float if it is what printing that float with as many digits gives: 0.1 does, 5411932.7 and
 * 0.1234567891 do not.
 */
#ifndef EXAMPLES_MESH_IO_H
#define EXAMPLES_MESH_IO_H
#include "mesh_polygon.h"
#include "tribox.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#endif

#define MESH_ERROR 512

typedef struct mesh {
    float      *positions;      /* x,y,z of each vertex, rounded to float */
    double     *exact;          /* the same as doubles; NULL if the floats are exact */
    size_t      vertices;
    uint32_t   *indices;        /* 3 per triangle; NULL means 0,1,2, 3,4,5, ... */
    size_t      triangles;
    size_t      skipped;        /* faces with fewer than three corners */
    uint32_t   *vertex_colours; /* 0xrrggbb, sRGB, of the first `vertices_coloured` vertices; NULL if there are none */
    size_t      vertices_coloured;
    uint32_t   *face_colours;   /* the same of triangles: what their material says */
    size_t      faces_coloured;
    const char *format;         /* "OBJ", "binary STL", ... */
    size_t      warnings;       /* what was odd in the file, and the first of it as a sentence */
    char        warning[MESH_ERROR];
} mesh;

/* A polygon of more than three corners: the triangles of its fan, from `triangle` on, hold its corners. */
typedef struct mesh_polygon {
    size_t triangle;
    size_t corners;
    size_t place;               /* line or byte, for errors */
} mesh_polygon;

/* The file and the place reached in it; what it gave so far is in `out`. */
typedef struct mesh_reader {
    const char          *path;
    char                *error;
    mesh                *out;
    const unsigned char *data;              /* one zero byte follows the last */
    size_t               size;
    size_t               at;
    size_t               line;              /* from 1 */
    int                  binary;            /* errors name the byte instead of the line */
    int                  continued;         /* a backslash before a newline joins two lines */
    int                  zero_is_blank;     /* a zero byte parts words */
    size_t               vertex_room;
    size_t               index_room;
    size_t               vertex_colour_room;
    size_t               face_colour_room;
    int                  has_material;      /* from here on triangles have a colour */
    uint32_t             material;
    size_t               polygon_room;
    mesh_polygon        *polygons;
    size_t               polygon_count;
    size_t               corners;           /* of the polygon being read: how many, its first and its last */
    uint32_t             first;
    uint32_t             last;
    uint32_t             largest;           /* largest vertex index seen, and where */
    size_t               largest_place;
} mesh_reader;

/* ---- 1. Errors and memory -------------------------------------------------------------------- */

static inline int mesh_fail_at(mesh_reader *r, size_t place, const char *format, ...) {
    va_list args;
    int used = snprintf(r->error, MESH_ERROR, r->binary ? "%.200s: byte %lu: " : "%.200s: line %lu: ",
                        r->path, (unsigned long)place);
    va_start(args, format);
    if (used > 0 && used < MESH_ERROR) {
        vsnprintf(r->error + used, (size_t)(MESH_ERROR - used), format, args);
    }
    va_end(args);
    return 0;
}

static inline size_t mesh_place(const mesh_reader *r) {
    return r->binary ? r->at : r->line;
}

static inline int mesh_fail_file(mesh_reader *r, const char *what) {
    snprintf(r->error, MESH_ERROR, "%.200s: %.200s", r->path, what);
    return 0;
}

/* Something odd that does not keep the mesh from being read. */
static inline void mesh_warn(mesh_reader *r, size_t place, const char *format, ...) {
    va_list args;
    int used;
    r->out->warnings += 1;
    if (r->out->warnings > 1) {
        return;
    }
    used = snprintf(r->out->warning, MESH_ERROR, r->binary ? "%.200s: byte %lu: " : "%.200s: line %lu: ", r->path,
                    (unsigned long)place);
    va_start(args, format);
    if (used > 0 && used < MESH_ERROR) {
        vsnprintf(r->out->warning + used, (size_t)(MESH_ERROR - used), format, args);
    }
    va_end(args);
}

/* Makes room for `more` items after `used`; the room doubles, so that adding one at a time stays linear. */
static inline int mesh_reserve(mesh_reader *r, void **items, size_t *room, size_t used, size_t more,
                               size_t item_size) {
    size_t wanted = *room;
    void *grown;
    if (more <= *room - used) {
        return 1;
    }
    if (more > SIZE_MAX / 2 / item_size - used) {
        return mesh_fail_file(r, "out of memory");
    }
    wanted = used + more > 2 * used ? used + more : 2 * used;
    wanted = wanted < 64 ? 64 : wanted;
    grown = realloc(*items, wanted * item_size);
    if (!grown) {
        return mesh_fail_file(r, "out of memory");
    }
    *items = grown;
    *room = wanted;
    return 1;
}

static inline int mesh_add_vertex(mesh_reader *r, const double position[3]) {
    void *items = r->out->exact;
    if (r->out->vertices >= UINT32_MAX) {
        return mesh_fail_at(r, mesh_place(r), "more than 4294967295 vertices");
    }
    if (!mesh_reserve(r, &items, &r->vertex_room, r->out->vertices, 1, 3 * sizeof(double))) {
        return 0;
    }
    r->out->exact = (double *)items;
    memcpy(r->out->exact + 3 * r->out->vertices, position, 3 * sizeof(double));
    r->out->vertices += 1;
    return 1;
}

/* The colours of a list up to number `count`: those that were left out are white. */
static inline int mesh_add_colour(mesh_reader *r, uint32_t **colours, size_t *coloured, size_t *room, size_t count,
                                  uint32_t colour) {
    void *items = *colours;
    if (!mesh_reserve(r, &items, room, *coloured, count - *coloured, sizeof(uint32_t))) {
        return 0;
    }
    *colours = (uint32_t *)items;
    for (; *coloured < count; *coloured += 1) {
        (*colours)[*coloured] = *coloured + 1 < count ? 0xffffffu : colour;
    }
    return 1;
}

/* The colour of the vertex added last. */
static inline int mesh_colour_vertex(mesh_reader *r, uint32_t colour) {
    mesh *m = r->out;
    return mesh_add_colour(r, &m->vertex_colours, &m->vertices_coloured, &r->vertex_colour_room, m->vertices, colour);
}

/* Parts of 1, of 255 or of what a type holds, as 0xrrggbb. */
static inline uint32_t mesh_colour(const double rgb[3], double most) {
    uint32_t colour = 0;
    int i;
    for (i = 0; i < 3; i++) {
        double part = rgb[i] / most;
        colour = colour << 8 | (uint32_t)(part > 0 ? part < 1 ? 255 * part + 0.5 : 255 : 0);
    }
    return colour;
}

static inline int mesh_add_triangle(mesh_reader *r, uint32_t a, uint32_t b, uint32_t c) {
    void *items = r->out->indices;
    uint32_t *corner;
    if (!mesh_reserve(r, &items, &r->index_room, r->out->triangles, 1, 3 * sizeof(uint32_t))) {
        return 0;
    }
    r->out->indices = (uint32_t *)items;
    corner = r->out->indices + 3 * r->out->triangles;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    r->out->triangles += 1;
    return !r->has_material
        || mesh_add_colour(r, &r->out->face_colours, &r->out->faces_coloured, &r->face_colour_room, r->out->triangles,
                           r->material);
}

/* Vertices may follow the faces, so the largest index is kept for a check at the end. */
static inline void mesh_note_index(mesh_reader *r, uint32_t index) {
    if (index >= r->largest) {
        r->largest = index;
        r->largest_place = mesh_place(r);
    }
}

/* One more corner of the polygon that began when `corners` was set to 0: the fan grows by a triangle. */
static inline int mesh_add_corner(mesh_reader *r, uint32_t index) {
    mesh_note_index(r, index);
    if (r->corners >= 2 && !mesh_add_triangle(r, r->first, r->last, index)) {
        return 0;
    }
    if (r->corners == 0) {
        r->first = index;
    }
    r->last = index;
    r->corners += 1;
    return 1;
}

static inline int mesh_end_polygon(mesh_reader *r) {
    size_t corners = r->corners;
    void *items = r->polygons;
    mesh_polygon polygon;
    r->out->skipped += corners < 3 ? 1 : 0;
    r->corners = 0;
    if (corners <= 3) {
        return 1;
    }
    if (!mesh_reserve(r, &items, &r->polygon_room, r->polygon_count, 1, sizeof polygon)) {
        return 0;
    }
    polygon.triangle = r->out->triangles - (corners - 2);
    polygon.corners = corners;
    polygon.place = mesh_place(r);
    r->polygons = (mesh_polygon *)items;
    r->polygons[r->polygon_count] = polygon;
    r->polygon_count += 1;
    return 1;
}

/* Cuts one polygon anew, now that all vertices are known. */
static inline int mesh_cut_polygon(mesh_reader *r, const mesh_polygon *polygon, uint32_t *corner) {
    uint32_t *fan = r->out->indices + 3 * polygon->triangle;
    double spare[3];
    size_t i;
    int status;
    corner[0] = fan[0];
    corner[1] = fan[1];
    for (i = 2; i < polygon->corners; i++) {
        corner[i] = fan[3 * (i - 2) + 2];
    }
    status = polygon_cut(r->out->exact, corner, polygon->corners, fan, (uint32_t)r->out->vertices, spare);
    if (status == 0) {
        return mesh_fail_at(r, polygon->place, "a face of %lu corners crosses itself", (unsigned long)polygon->corners);
    }
    if (status < 0) {
        return mesh_fail_at(r, polygon->place, "a face of %lu corners: more than %lu, or out of memory",
                            (unsigned long)polygon->corners, (unsigned long)POLYGON_MOST);
    }
    if (status == 2) {
        mesh_warn(r, polygon->place, "a face of four corners crosses itself; it is cut where its edges meet");
        return mesh_add_vertex(r, spare);
    }
    return 1;
}

static inline int mesh_cut_polygons(mesh_reader *r) {
    uint32_t *corner = NULL;
    size_t most = 0;
    size_t i;
    int ok = 1;
    for (i = 0; i < r->polygon_count; i++) {
        most = r->polygons[i].corners > most ? r->polygons[i].corners : most;
    }
    if (most > 0) {
        corner = (uint32_t *)malloc(most * sizeof *corner);
        ok = corner ? 1 : mesh_fail_file(r, "out of memory");
    }
    for (i = 0; ok && i < r->polygon_count; i++) {
        ok = mesh_cut_polygon(r, &r->polygons[i], corner);
    }
    free(corner);
    return ok;
}

/* ---- 2. Words and numbers of text ------------------------------------------------------------ */

typedef struct mesh_word {
    const char *text;       /* not terminated by zero */
    size_t      length;
} mesh_word;

static inline int mesh_is_newline(const mesh_reader *r) {
    unsigned char c = r->data[r->at];
    return c == '\n' || (c == '\r' && r->data[r->at + 1] != '\n');
}

/* Length of the backslash and line end that stand here in a continued line; 0 if none does. */
static inline size_t mesh_joint(const mesh_reader *r) {
    const unsigned char *c = r->data + r->at;
    if (!r->continued || c[0] != '\\') {
        return 0;
    }
    return c[1] == '\n' ? 2 : c[1] == '\r' && c[2] == '\n' ? 3 : 0;
}

static inline int mesh_is_blank(const mesh_reader *r, unsigned char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || (c == 0 && r->zero_is_blank);
}

/* The next word of this line; 0 at its end. */
static inline int mesh_next_word(mesh_reader *r, mesh_word *word) {
    word->text = "";
    word->length = 0;
    while (r->at < r->size && !mesh_is_newline(r)) {
        unsigned char c = r->data[r->at];
        size_t joint = mesh_joint(r);
        if (joint) {
            r->line += 1;
        } else if (!mesh_is_blank(r, c)) {
            break;
        }
        r->at += joint ? joint : 1;
    }
    word->text = (const char *)r->data + r->at;
    while (r->at < r->size && r->data[r->at] != '\n' && !mesh_is_blank(r, r->data[r->at]) && !mesh_joint(r)) {
        r->at += 1;
        word->length += 1;
    }
    return word->length > 0;
}

/* To the start of the next line; 0 at the end of the file. */
static inline int mesh_next_line(mesh_reader *r) {
    while (r->at < r->size && !mesh_is_newline(r)) {
        size_t joint = mesh_joint(r);
        r->line += joint ? 1 : 0;
        r->at += joint ? joint : 1;
    }
    if (r->at < r->size) {
        r->at += 1;
        r->line += 1;
    }
    return r->at < r->size;
}

/* The next word of the file, on this line or a later one; 0 at the end of the file. */
static inline int mesh_next_word_anywhere(mesh_reader *r, mesh_word *word) {
    while (!mesh_next_word(r, word)) {
        if (r->at >= r->size) {
            return 0;
        }
        mesh_next_line(r);
    }
    return 1;
}

static inline int mesh_word_is(mesh_word word, const char *name) {
    size_t i;
    for (i = 0; i < word.length && name[i]; i++) {
        int c = word.text[i] >= 'A' && word.text[i] <= 'Z' ? word.text[i] - 'A' + 'a' : word.text[i];
        if (c != name[i]) {
            return 0;
        }
    }
    return i == word.length && !name[i];
}

static inline int mesh_fail_word(mesh_reader *r, mesh_word word, const char *wanted) {
    char shown[41];
    size_t i;
    size_t n = word.length < sizeof shown - 1 ? word.length : sizeof shown - 1;
    if (word.length == 0) {
        return mesh_fail_at(r, r->line, "%s expected, found the end of the %s", wanted,
                            r->at < r->size ? "line" : "file");
    }
    for (i = 0; i < n; i++) {
        shown[i] = word.text[i];
        if (word.text[i] < 32 || word.text[i] > 126) {
            shown[i] = '?';
        }
    }
    shown[n] = 0;
    return mesh_fail_at(r, r->line, "%s expected, found '%s'", wanted, shown);
}

/* What some programs write for NaN and infinity: 1.#QNAN, -1.#IND, 1.#INF00. */
static inline int mesh_word_special(mesh_word word, double *out) {
    size_t i = word.length > 0 && (word.text[0] == '-' || word.text[0] == '+') ? 1 : 0;
    if (word.length < i + 4 || word.text[i] != '1' || word.text[i + 1] != '.' || word.text[i + 2] != '#') {
        return 0;
    }
    *out = word.text[i + 3] == 'I' && word.length > i + 4 && word.text[i + 4] == 'N' && word.length > i + 5
        && word.text[i + 5] == 'F' ? HUGE_VAL : HUGE_VAL - HUGE_VAL;
    *out = word.text[0] == '-' ? -*out : *out;
    return 1;
}

/* The double that a decimal means: the float that prints like it, if there is one, else the nearest double. */
static inline double mesh_decimal(const char *text, double wide) {
    const float narrow = strtof(text, NULL);
    char printed[40];
    size_t i = 0;
    int digits = 0;
    int zeros = 1;
    if ((double)narrow == wide || !(fabs(wide) < 1e30 && fabs(wide) > 1e-30)) {
        return wide;
    }
    i += text[0] == '-' || text[0] == '+' ? 1 : 0;
    for (; (text[i] >= '0' && text[i] <= '9') || text[i] == '.'; i++) {
        zeros = zeros && (text[i] == '0' || text[i] == '.');
        digits += text[i] != '.' && !zeros ? 1 : 0;
    }
    if (digits < 1 || digits > 9) {
        return wide;
    }
    snprintf(printed, sizeof printed, "%.*e", digits - 1, (double)narrow);
    return strtod(printed, NULL) == wide ? (double)narrow : wide;
}

/* The word as a number. strtod stops by itself at the blank or zero byte behind the word. In an OBJ a comment may
   follow at once. "3.1+e2" is how one program writes 3.1e+2. */
static inline int mesh_word_double(mesh_reader *r, mesh_word word, double *out) {
    char *end = NULL;
    char copy[64];
    size_t length = word.length;
    size_t i;
    for (i = 0; i < word.length && word.text[i] != '#'; i++) {
    }
    if (i > 0 && i < word.length && word.text[i - 1] != '.') {
        length = i;
    }
    if (length == 0 || mesh_word_special(word, out)) {
        return length > 0 ? 1 : mesh_fail_word(r, word, "number");
    }
    *out = strtod(word.text, &end);
    if (end == word.text + length) {
        return 1;
    }
    if (length < sizeof copy - 1 && end > word.text && end + 1 < word.text + length && (*end == '+' || *end == '-')
        && (end[1] == 'e' || end[1] == 'E')) {
        memcpy(copy, word.text, length);
        copy[length] = 0;
        i = (size_t)(end - word.text);
        copy[i + 1] = copy[i];
        copy[i] = 'e';
        *out = strtod(copy, &end);
        if (end == copy + length) {
            return 1;
        }
    }
    return mesh_fail_word(r, word, "number");
}

/* A coordinate: a float where the decimal stands for one. */
static inline int mesh_word_number(mesh_reader *r, mesh_word word, double *out) {
    if (!mesh_word_double(r, word, out)) {
        return 0;
    }
    *out = fabs(*out) <= DBL_MAX ? mesh_decimal(word.text, *out) : *out;
    return 1;
}

/* An integer at the start of the word; returns the characters read, 0 if there is none or it is far out of
   range. */
static inline size_t mesh_word_integer(mesh_word word, int64_t *out_value) {
    size_t i = word.length > 0 && (word.text[0] == '-' || word.text[0] == '+') ? 1 : 0;
    size_t digits = i;
    int64_t value = 0;
    for (; i < word.length && word.text[i] >= '0' && word.text[i] <= '9'; i++) {
        value = 10 * value + (word.text[i] - '0');
        if (value > ((int64_t)1 << 53)) {
            return 0;
        }
    }
    *out_value = word.length > 0 && word.text[0] == '-' ? -value : value;
    return i > digits ? i : 0;
}

/* Three numbers of this line, or of this one and the next; `least` of them must be there, the rest is 0. */
static inline int mesh_read_position(mesh_reader *r, int anywhere, int least) {
    double position[3] = {0, 0, 0};
    int a;
    for (a = 0; a < 3; a++) {
        mesh_word word;
        int found = anywhere ? mesh_next_word_anywhere(r, &word) : mesh_next_word(r, &word);
        if (a >= least && (!found || word.text[0] == '#')) {
            break;
        }
        if (!mesh_word_number(r, word, &position[a])) {
            return 0;
        }
    }
    return mesh_add_vertex(r, position);
}

static inline unsigned char *mesh_load_bytes(const char *path, size_t *out_size, char *error);

/* ---- 3. OBJ ---------------------------------------------------------------------------------- */

/* A corner "v", "v/vt", "v//vn" or "v/vt/vn". Positive indices count from 1, negative ones back from the
   last vertex. */
static inline int mesh_read_obj_corner(mesh_reader *r, mesh_word word) {
    int64_t index;
    size_t used = mesh_word_integer(word, &index);
    if (used == 0 || (used < word.length && word.text[used] != '/')) {
        return mesh_fail_word(r, word, "vertex index");
    }
    if (index < 0) {
        if ((uint64_t)-index > r->out->vertices) {
            return mesh_fail_at(r, r->line, "vertex index %ld, but only %lu vertices stand above",
                                (long)index, (unsigned long)r->out->vertices);
        }
        index += (int64_t)r->out->vertices + 1;
    }
    if (index == 0 || index > (int64_t)UINT32_MAX) {
        return mesh_fail_word(r, word, "vertex index from 1");
    }
    return mesh_add_corner(r, (uint32_t)(index - 1));
}

static inline int mesh_read_obj_face(mesh_reader *r) {
    mesh_word word;
    while (mesh_next_word(r, &word)) {
        mesh_word rest = word;
        while (rest.length > 0 && rest.text[0] != '#') {
            rest.text += 1;
            rest.length -= 1;
        }
        word.length -= rest.length;     /* a comment may follow at once */
        r->continued = rest.length == 0;
        if (word.length > 0 && !mesh_read_obj_corner(r, word)) {
            return 0;
        }
        if (rest.length > 0) {
            break;
        }
    }
    return mesh_end_polygon(r);
}

/* Three numbers behind a position are a colour, each from 0 to 1. */
static inline int obj_read_colour(mesh_reader *r) {
    double rgb[4];
    int count = 0;
    mesh_word word;
    while (count < 4 && mesh_next_word(r, &word) && word.text[0] != '#') {
        char *end;
        rgb[count] = strtod(word.text, &end);
        if (end != word.text + word.length) {
            return 1;
        }
        count += 1;
    }
    return count != 3 || mesh_colour_vertex(r, mesh_colour(rgb, 1));
}

/* Materials by their names' hashes: the texts that hold the names do not stay. */
typedef struct obj_material {
    uint64_t name;
    uint32_t colour;
} obj_material;

typedef struct obj_materials {
    obj_material *items;
    size_t        count;
    size_t        room;
} obj_materials;

/* The rest of the line as one number: the hash of Fowler, Noll and Vo. */
static inline uint64_t obj_name(mesh_reader *r) {
    uint64_t hash = 0xcbf29ce484222325u;
    mesh_word word;
    while (mesh_next_word(r, &word)) {
        size_t i;
        for (i = 0; i < word.length; i++) {
            hash = (hash ^ (unsigned char)word.text[i]) * 0x100000001b3u;
        }
        hash = (hash ^ ' ') * 0x100000001b3u;
    }
    return hash;
}

/* One line of a material library: a name, or a diffuse colour (Kd). */
static inline void obj_read_material(mesh_reader *m, obj_materials *list) {
    void *items = list->items;
    double rgb[3];
    mesh_word word;
    int i;
    mesh_next_word(m, &word);
    if (mesh_word_is(word, "newmtl") && mesh_reserve(m, &items, &list->room, list->count, 1, sizeof *list->items)) {
        list->items = (obj_material *)items;
        list->items[list->count].name = obj_name(m);
        list->items[list->count].colour = 0xffffffu;
        list->count += 1;
    }
    if (mesh_word_is(word, "kd") && list->count > 0) {
        for (i = 0; i < 3 && mesh_next_word(m, &word) && mesh_word_double(m, word, &rgb[i]); i++) {
        }
        list->items[list->count - 1].colour = i == 3 ? mesh_colour(rgb, 1) : 0xffffffu;
    }
}

/* A material library beside the file; one that cannot be read is a warning, not an error. */
static inline void obj_read_library(mesh_reader *r, obj_materials *list) {
    char path[4096];
    char error[MESH_ERROR];
    const char *slash = strrchr(r->path, '/');
    size_t folder = slash ? (size_t)(slash - r->path) + 1 : 0;
    mesh_reader m;
    mesh_word word;
    unsigned char *bytes;
    memset(&m, 0, sizeof m);
    if (!mesh_next_word(r, &word) || folder + word.length >= sizeof path || word.text[0] == '/'
        || strcmp(r->path, "-") == 0) {
        return;
    }
    memcpy(path, r->path, folder);
    memcpy(path + folder, word.text, word.length);
    path[folder + word.length] = 0;
    bytes = strstr(path + folder, "..") || strchr(path + folder, ':') ? NULL : mesh_load_bytes(path, &m.size, error);
    if (!bytes) {
        mesh_warn(r, r->line, "the materials of '%.100s' are not read", path + folder);
        return;
    }
    m.path = path;
    m.error = error;
    m.data = bytes;
    do {
        obj_read_material(&m, list);
    } while (mesh_next_line(&m));
    free(bytes);
}

static inline void obj_use_material(mesh_reader *r, const obj_materials *list) {
    uint64_t name = obj_name(r);
    size_t i;
    r->material = 0xffffffu;
    for (i = 0; i < list->count; i++) {
        if (list->items[i].name == name) {
            r->material = list->items[i].colour;
            r->has_material = 1;
        }
    }
}

/* A backslash joins lines of numbers only: comments and names may end in one. */
static inline int obj_read_lines(mesh_reader *r, obj_materials *list) {
    do {
        mesh_word word;
        r->continued = 0;
        if (!mesh_next_word(r, &word)) {
            continue;
        }
        r->continued = word.text[0] == 'v' || word.text[0] == 'f' || word.text[0] == 'V' || word.text[0] == 'F';
        if (mesh_word_is(word, "v") && (!mesh_read_position(r, 0, 2) || !obj_read_colour(r))) {
            return 0;
        }
        if (mesh_word_is(word, "mtllib")) {
            obj_read_library(r, list);
        }
        if (mesh_word_is(word, "usemtl")) {
            obj_use_material(r, list);
        }
        if ((mesh_word_is(word, "f") || mesh_word_is(word, "fo")) && !mesh_read_obj_face(r)) {
            return 0;
        }
    } while (mesh_next_line(r));
    return 1;
}

static inline int mesh_read_obj(mesh_reader *r) {
    obj_materials list = {NULL, 0, 0};
    int ok;
    r->out->format = "OBJ";
    ok = obj_read_lines(r, &list);
    free(list.items);
    if (ok && r->out->vertices == 0 && r->out->triangles == 0) {
        return mesh_fail_file(r, "no vertex found: not an OBJ, STL, PLY, OFF or glTF file");
    }
    return ok;
}

/* ---- 4. STL ---------------------------------------------------------------------------------- */

static inline uint32_t mesh_u32(const unsigned char *p, int big_endian) {
    return big_endian ? (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3]
                      : (uint32_t)p[3] << 24 | (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
}

static inline float mesh_f32(const unsigned char *p, int big_endian) {
    uint32_t bits = mesh_u32(p, big_endian);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* How many triangles a binary STL has. The count in its header is wrong in many files; the size decides, unless
   bytes follow that are no triangles. */
static inline size_t mesh_stl_count(mesh_reader *r) {
    size_t said = mesh_u32(r->data + 80, 0);
    size_t room = (r->size - 84) / 50;
    if (said == room && said * 50 == r->size - 84) {
        return said;
    }
    if (said == 0 || said == 0xffffffffu || (said < room && (r->size - 84) % 50 == 0)) {
        mesh_warn(r, 80, "the header counts %lu triangles, the file's size says %lu; %lu are read", (unsigned long)said,
                  (unsigned long)room, (unsigned long)room);
        return room;
    }
    if (said <= room) {
        mesh_warn(r, 84 + 50 * said, "%lu bytes follow the %lu triangles that the header counts",
                  (unsigned long)(r->size - 84 - 50 * said), (unsigned long)said);
    }
    return said;
}

static inline int mesh_read_stl_binary(mesh_reader *r) {
    size_t count;
    size_t t;
    int i;
    int a;
    r->out->format = "binary STL";
    r->binary = 1;
    if (r->size < 84) {
        r->at = r->size;
        return mesh_fail_at(r, r->at, "the file ends within the 84 bytes of a binary STL's header");
    }
    count = mesh_stl_count(r);
    if (count > (r->size - 84) / 50) {
        return mesh_fail_at(r, 80, "%lu triangles promised, which takes %.0f bytes, but the file has %lu",
                            (unsigned long)count, 84 + 50.0 * (double)count, (unsigned long)r->size);
    }
    for (t = 0; t < count; t++) {
        for (i = 0; i < 3; i++) {
            const unsigned char *corner = r->data + 84 + 50 * t + 12 + 12 * (size_t)i;
            double position[3];
            for (a = 0; a < 3; a++) {
                position[a] = (double)mesh_f32(corner + 4 * a, 0);
            }
            if (!mesh_add_vertex(r, position)) {
                return 0;
            }
        }
    }
    r->out->triangles = count;
    return 1;
}

/* Reads one facet after the word "facet". What follows on its line is a normal, of any form, and not used; the
   loop may stand on that line, too, and have more than three corners. */
static inline int mesh_read_stl_facet(mesh_reader *r) {
    mesh_word word;
    while (mesh_next_word(r, &word) && !mesh_word_is(word, "outer")) {
    }
    if (word.length == 0) {
        mesh_next_word_anywhere(r, &word);
    }
    if (!mesh_word_is(word, "outer")) {
        return mesh_fail_word(r, word, "outer");
    }
    mesh_next_word_anywhere(r, &word);
    if (!mesh_word_is(word, "loop")) {
        return mesh_fail_word(r, word, "loop");
    }
    mesh_next_word_anywhere(r, &word);
    while (r->corners < 3 || !mesh_word_is(word, "endloop")) {
        if (!mesh_word_is(word, "vertex")) {
            return mesh_fail_word(r, word, r->corners < 3 ? "vertex" : "vertex or endloop");
        }
        if (!mesh_read_position(r, 1, 3) || !mesh_add_corner(r, (uint32_t)(r->out->vertices - 1))) {
            return 0;
        }
        mesh_next_word_anywhere(r, &word);
    }
    if (!mesh_end_polygon(r)) {
        return 0;
    }
    mesh_next_word_anywhere(r, &word);
    return mesh_word_is(word, "endfacet") ? 1 : mesh_fail_word(r, word, "endfacet");
}

/* Words that may follow a facet on its line, or stand on lines of their own, are no facet's. After the last solid
   anything may stand. */
static inline int mesh_read_stl_ascii(mesh_reader *r) {
    mesh_word word;
    int inside = 0;
    size_t line = 0;                /* of the last endfacet */
    r->out->format = "ASCII STL";
    r->zero_is_blank = 1;
    while (mesh_next_word_anywhere(r, &word)) {
        if (!inside && mesh_word_is(word, "solid")) {
            inside = 1;
            mesh_next_line(r);      /* the rest of the line is a name */
        } else if (!inside && line > 0) {
            mesh_next_line(r);
        } else if (inside && mesh_word_is(word, "facet")) {
            if (!mesh_read_stl_facet(r)) {
                return 0;
            }
            line = r->line;
        } else if (inside && (mesh_word_is(word, "endsolid") || mesh_word_is(word, "end"))) {
            inside = 0;
            line = line > 0 ? line : r->line;
            mesh_next_line(r);
        } else if (inside && (mesh_word_is(word, "color") || mesh_word_is(word, "colour") || word.text[0] == '#'
                              || word.text[0] == 26 || line == r->line)) {
            mesh_next_line(r);
        } else {
            return mesh_fail_word(r, word, inside ? "facet or endsolid" : "solid");
        }
    }
    if (inside && line == 0) {
        return mesh_fail_word(r, word, "facet or endsolid");
    }
    return 1;
}

/* Does the word stand at the start of a line, blanks aside, in the first bytes? */
static inline int mesh_line_begins(const mesh_reader *r, const char *name) {
    size_t most = r->size < 4096 ? r->size : 4096;
    size_t length = strlen(name);
    size_t i;
    for (i = 0; i + length < most; i++) {
        size_t j = i;
        if (r->data[i] != '\n' && r->data[i] != '\r') {
            continue;
        }
        while (j + length < most && (r->data[j] <= ' ')) {
            j += 1;
        }
        if (j + length < most && memcmp(r->data + j, name, length) == 0) {
            return 1;
        }
    }
    return 0;
}

/* A binary STL may begin with "solid" too: the size tells them apart, then lines that begin with "facet", then the
   first word, then a zero byte in the header. */
static inline int mesh_stl_is_binary(const mesh_reader *r, int starts_solid) {
    size_t head = r->size < 84 ? r->size : 84;
    if (r->size >= 84 && (double)r->size == 84 + 50.0 * (double)mesh_u32(r->data + 80, 0)) {
        return 1;
    }
    return !mesh_line_begins(r, "facet") && !mesh_line_begins(r, "FACET")
        && (!starts_solid || memchr(r->data, 0, head) != NULL);
}

/* ---- 5. PLY ---------------------------------------------------------------------------------- */

enum { PLY_I8, PLY_U8, PLY_I16, PLY_U16, PLY_I32, PLY_U32, PLY_F32, PLY_F64, PLY_NO_TYPE };
/* What a property is read for. */
enum { PLY_OTHER, PLY_X, PLY_Y, PLY_Z, PLY_RED, PLY_GREEN, PLY_BLUE, PLY_FACE, PLY_STRIP };

typedef struct ply_property {
    int type;
    int count_type;                 /* PLY_NO_TYPE: one value; else a list whose count has this type */
    int role;
} ply_property;

typedef struct ply_element {
    mesh_word name;
    uint64_t  rows;
    size_t    first;                /* its properties */
    size_t    properties;
} ply_element;

typedef struct ply_header {
    int           big_endian;
    ply_element  *elements;
    size_t        element_count;
    size_t        element_room;
    ply_property *properties;
    size_t        property_count;
    size_t        property_room;
    int           by_lines;         /* ASCII: a row begins on a line of its own */
} ply_header;

static inline size_t ply_size(int type) {
    return type >= PLY_F64 ? 8 : type >= PLY_I32 ? 4 : type >= PLY_I16 ? 2 : 1;
}

static inline int ply_type(mesh_word word) {
    static const char *const names[][2] = {{"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},
                                           {"ushort", "uint16"}, {"int", "int32"}, {"uint", "uint32"},
                                           {"float", "float32"}, {"double", "float64"}};
    int type = 0;
    while (type < PLY_NO_TYPE && !mesh_word_is(word, names[type][0]) && !mesh_word_is(word, names[type][1])) {
        type += 1;
    }
    return type;
}

static inline int ply_role(mesh_word element, mesh_word name, int is_list) {
    if (mesh_word_is(element, "vertex") && !is_list && name.length == 1) {
        return *name.text == 'x' ? PLY_X : *name.text == 'y' ? PLY_Y : *name.text == 'z' ? PLY_Z : PLY_OTHER;
    }
    if (mesh_word_is(element, "vertex") && !is_list) {
        return mesh_word_is(name, "red") ? PLY_RED : mesh_word_is(name, "green") ? PLY_GREEN
             : mesh_word_is(name, "blue") ? PLY_BLUE : PLY_OTHER;
    }
    if (is_list && (mesh_word_is(name, "vertex_indices") || mesh_word_is(name, "vertex_index"))) {
        return mesh_word_is(element, "face") ? PLY_FACE
             : mesh_word_is(element, "tristrips") ? PLY_STRIP : PLY_OTHER;
    }
    return PLY_OTHER;
}

static inline int ply_read_property(mesh_reader *r, ply_header *h) {
    ply_property property = {PLY_NO_TYPE, PLY_NO_TYPE, PLY_OTHER};
    void *items = h->properties;
    mesh_word word;
    if (h->element_count == 0) {
        return mesh_fail_at(r, r->line, "property before any element");
    }
    mesh_next_word(r, &word);
    if (mesh_word_is(word, "list")) {
        mesh_next_word(r, &word);
        property.count_type = ply_type(word);
        if (property.count_type >= PLY_F32) {
            return mesh_fail_word(r, word, "integer type of a list's count");
        }
        mesh_next_word(r, &word);
    }
    property.type = ply_type(word);
    if (property.type == PLY_NO_TYPE) {
        return mesh_fail_word(r, word, "property type");
    }
    if (!mesh_next_word(r, &word)) {
        return mesh_fail_word(r, word, "property name");
    }
    property.role = ply_role(h->elements[h->element_count - 1].name, word,
                             property.count_type != PLY_NO_TYPE);
    if (!mesh_reserve(r, &items, &h->property_room, h->property_count, 1, sizeof property)) {
        return 0;
    }
    h->properties = (ply_property *)items;
    h->properties[h->property_count] = property;
    h->property_count += 1;
    h->elements[h->element_count - 1].properties += 1;
    return 1;
}

static inline int ply_read_element(mesh_reader *r, ply_header *h) {
    ply_element element;
    void *items = h->elements;
    mesh_word word;
    int64_t rows = 0;
    if (!mesh_next_word(r, &element.name)) {
        return mesh_fail_word(r, element.name, "element name");
    }
    mesh_next_word(r, &word);
    if (mesh_word_integer(word, &rows) != word.length || word.length == 0 || rows < 0) {
        return mesh_fail_word(r, word, "element count");
    }
    element.rows = (uint64_t)rows;
    element.first = h->property_count;
    element.properties = 0;
    if (!mesh_reserve(r, &items, &h->element_room, h->element_count, 1, sizeof element)) {
        return 0;
    }
    h->elements = (ply_element *)items;
    h->elements[h->element_count] = element;
    h->element_count += 1;
    return 1;
}

static inline int ply_read_format(mesh_reader *r, ply_header *h) {
    mesh_word word;
    mesh_next_word(r, &word);
    h->big_endian = mesh_word_is(word, "binary_big_endian");
    r->out->format = h->big_endian ? "binary PLY (big endian)"
                   : mesh_word_is(word, "binary_little_endian") ? "binary PLY (little endian)"
                   : mesh_word_is(word, "ascii") ? "ASCII PLY" : NULL;
    return r->out->format ? 1 : mesh_fail_word(r, word, "ascii, binary_little_endian or binary_big_endian");
}

static inline int ply_read_header(mesh_reader *r, ply_header *h) {
    mesh_word word;
    r->out->format = NULL;
    while (mesh_next_line(r)) {
        int ok = 1;
        if (!mesh_next_word(r, &word) || mesh_word_is(word, "ply")) {
            continue;
        }
        if (mesh_word_is(word, "end_header")) {
            mesh_next_line(r);
            return r->out->format ? 1 : mesh_fail_at(r, r->line, "the header has no format line");
        }
        if (mesh_word_is(word, "format")) {
            ok = ply_read_format(r, h);
        } else if (mesh_word_is(word, "element")) {
            ok = ply_read_element(r, h);
        } else if (mesh_word_is(word, "property")) {
            ok = ply_read_property(r, h);
        } else if (!mesh_word_is(word, "comment") && !mesh_word_is(word, "obj_info")) {
            mesh_warn(r, r->line, "a header line that is none of PLY's is ignored");
        }
        if (!ok) {
            return 0;
        }
    }
    return mesh_fail_at(r, r->line, "end_header expected, found the end of the file");
}

static inline int ply_binary_number(mesh_reader *r, const ply_header *h, int type, double *out) {
    unsigned char b[8];
    size_t size = ply_size(type);
    size_t i;
    uint64_t bits = 0;
    uint32_t low;
    float single;
    if (size > r->size - r->at) {
        return mesh_fail_at(r, r->at, "the file ends within a value");
    }
    for (i = 0; i < size; i++) {        /* least byte first */
        b[i] = r->data[r->at + (h->big_endian ? size - 1 - i : i)];
        bits |= (uint64_t)b[i] << (8 * i);
    }
    low = (uint32_t)bits;
    switch (type) {
    case PLY_I8:  *out = low < 0x80 ? low : (double)low - 256; break;
    case PLY_I16: *out = low < 0x8000 ? low : (double)low - 65536; break;
    case PLY_I32: *out = low < 0x80000000u ? low : (double)low - 4294967296.0; break;
    case PLY_F32: memcpy(&single, &low, sizeof low); *out = (double)single; break;
    case PLY_F64: memcpy(out, &bits, sizeof bits); break;
    default:      *out = low; break;
    }
    r->at += size;
    return 1;
}

/* In text a float is the nearest one, and a double too is as the decimal has it. */
static inline int ply_read_number(mesh_reader *r, const ply_header *h, int type, double *out) {
    mesh_word word;
    if (r->binary) {
        return ply_binary_number(r, h, type, out);
    }
    mesh_next_word_anywhere(r, &word);
    if (!mesh_word_number(r, word, out)) {
        return 0;
    }
    if (type == PLY_F32 || type == PLY_F64) {
        char *end;
        double plain = type == PLY_F32 ? (double)strtof(word.text, &end) : strtod(word.text, &end);
        *out = end == word.text + word.length ? plain : *out;
    }
    return 1;
}

/* One index of a strip: -1 starts a new one, and every second triangle is turned over. */
static inline int ply_add_strip_corner(mesh_reader *r, double index) {
    int odd = r->corners % 2 == 1;
    uint32_t vertex;
    if (index < 0) {
        r->corners = 0;
        return 1;
    }
    vertex = (uint32_t)index;
    mesh_note_index(r, vertex);
    if (r->corners >= 2 && !mesh_add_triangle(r, odd ? r->last : r->first, odd ? r->first : r->last,
                                              vertex)) {
        return 0;
    }
    r->first = r->last;
    r->last = vertex;
    r->corners += 1;
    return 1;
}

static inline int ply_read_list(mesh_reader *r, const ply_header *h, const ply_property *property) {
    double number = 0;
    uint64_t count;
    uint64_t i;
    size_t place = mesh_place(r);
    if (!ply_read_number(r, h, property->count_type, &number)) {
        return 0;
    }
    if (!(number >= 0 && number <= 4294967295.0)
        || number != (double)(uint64_t)number) {
        return mesh_fail_at(r, r->binary ? place : r->line, "a list of %g values", number);
    }
    count = (uint64_t)number;
    r->corners = 0;
    for (i = 0; i < count; i++) {
        int strip = property->role == PLY_STRIP;
        place = r->at;
        if (!ply_read_number(r, h, property->type, &number)) {
            return 0;
        }
        if (property->role == PLY_OTHER) {
            continue;
        }
        if (!(number >= (strip ? -1 : 0) && number < 4294967295.0)
            || number != floor(number)) {
            return mesh_fail_at(r, r->binary ? place : r->line, "vertex index %g", number);
        }
        if (strip ? !ply_add_strip_corner(r, number)
                  : !mesh_add_corner(r, (uint32_t)number)) {
            return 0;
        }
    }
    return property->role == PLY_FACE ? mesh_end_polygon(r) : 1;
}

static inline int ply_read_row(mesh_reader *r, const ply_header *h, const ply_element *element,
                               int is_vertex) {
    double position[3] = {0, 0, 0};
    double rgb[3] = {0, 0, 0};
    double most = 0;
    size_t i;
    for (i = 0; i < element->properties; i++) {
        const ply_property *property = &h->properties[element->first + i];
        double number = 0;
        if (property->count_type != PLY_NO_TYPE ? !ply_read_list(r, h, property)
                                                 : !ply_read_number(r, h, property->type, &number)) {
            return 0;
        }
        if (property->role >= PLY_X && property->role <= PLY_Z) {
            position[property->role - PLY_X] = number;
        }
        if (property->role >= PLY_RED && property->role <= PLY_BLUE) {
            rgb[property->role - PLY_RED] = number;
            most = property->type >= PLY_F32 ? 1 : property->type <= PLY_U8 ? 255 : 65535;
        }
    }
    if (h->by_lines && element->properties > 0) {
        mesh_next_line(r);      /* values beyond the declared ones are no row's */
    }
    if (is_vertex && most > 0) {
        return mesh_add_vertex(r, position) && mesh_colour_vertex(r, mesh_colour(rgb, most));
    }
    return is_vertex ? mesh_add_vertex(r, position) : 1;
}

/* Whether the rows can be there: the least bytes that they take are compared with those that are left. */
static inline int ply_check_rows(mesh_reader *r, const ply_header *h, const ply_element *element) {
    double row = 0;
    size_t i;
    for (i = 0; i < element->properties; i++) {
        const ply_property *p = &h->properties[element->first + i];
        row += !r->binary ? 2 : (double)ply_size(p->count_type != PLY_NO_TYPE ? p->count_type : p->type);
    }
    if ((double)element->rows * row > (double)(r->size - r->at) + 1) {
        return mesh_fail_at(r, mesh_place(r),
                            "%.0f rows of '%.*s' promised, at least %.0f bytes, but %lu are left",
                            (double)element->rows, element->name.length < 40 ? (int)element->name.length : 40,
                            element->name.text, (double)element->rows * row,
                            (unsigned long)(r->size - r->at));
    }
    return 1;
}

static inline int ply_read_rows(mesh_reader *r, const ply_header *h, const ply_element *element) {
    int is_vertex = mesh_word_is(element->name, "vertex");
    unsigned roles = 0;
    uint64_t row;
    size_t i;
    for (i = 0; i < element->properties; i++) {
        roles |= 1u << h->properties[element->first + i].role;
    }
    if (is_vertex && (~roles & (1u << PLY_X | 1u << PLY_Y | 1u << PLY_Z))) {
        return mesh_fail_at(r, mesh_place(r), "the element 'vertex' lacks one of the properties x, y, z");
    }
    if (!ply_check_rows(r, h, element)) {
        return 0;
    }
    for (row = 0; element->properties > 0 && row < element->rows; row++) {
        if (!ply_read_row(r, h, element, is_vertex)) {
            return 0;
        }
    }
    return 1;
}

static inline int ply_read_elements(mesh_reader *r, const ply_header *h) {
    size_t i;
    int ok = 1;
    for (i = 0; ok && i < h->element_count; i++) {
        ok = ply_read_rows(r, h, &h->elements[i]);
    }
    return ok;
}

/* A text's rows stand on lines of their own; if it ends too early by that, several may stand on one. */
static inline int ply_read_body(mesh_reader *r, ply_header *h) {
    const mesh_reader before = *r;
    const mesh empty = *r->out;
    char error[MESH_ERROR];
    int ok = ply_read_elements(r, h);
    if (ok || !h->by_lines || r->at < r->size) {
        return ok;
    }
    memcpy(error, r->error, sizeof error);
    r->at = before.at;
    r->line = before.line;
    r->corners = 0;
    r->polygon_count = 0;
    r->largest = 0;
    r->out->vertices = 0;
    r->out->triangles = 0;
    r->out->skipped = 0;
    r->out->warnings = empty.warnings;
    r->out->vertices_coloured = 0;
    h->by_lines = 0;
    ok = ply_read_elements(r, h);
    if (!ok) {
        memcpy(r->error, error, sizeof error);      /* the first fault is the one to tell */
    }
    return ok;
}

static inline int mesh_read_ply(mesh_reader *r) {
    ply_header h = {0, NULL, 0, 0, NULL, 0, 0, 0};
    size_t i;
    int faces = 0;
    int ok = ply_read_header(r, &h);
    r->binary = ok && strcmp(r->out->format, "ASCII PLY") != 0;
    h.by_lines = ok && !r->binary;
    ok = ok && ply_read_body(r, &h);
    for (i = 0; i < h.property_count; i++) {
        faces |= h.properties[i].role >= PLY_FACE;
    }
    if (ok && !faces) {
        ok = mesh_fail_file(r, "no list vertex_indices in an element 'face' or 'tristrips': "
                               "points without triangles");
    }
    free(h.elements);
    free(h.properties);
    return ok;
}

/* ---- 6. OFF ---------------------------------------------------------------------------------- */

/* The next word that is no comment's, on this line or a later one. */
static inline int off_next_word(mesh_reader *r, mesh_word *word) {
    while (mesh_next_word_anywhere(r, word)) {
        if (word->text[0] != '#') {
            return 1;
        }
        mesh_next_line(r);
    }
    return 0;
}

static inline int off_read_count(mesh_reader *r, const char *what, uint64_t *out) {
    mesh_word word;
    int64_t count;
    off_next_word(r, &word);
    if (word.length == 0 || mesh_word_integer(word, &count) != word.length || count < 0) {
        return mesh_fail_word(r, word, what);
    }
    *out = (uint64_t)count;
    if ((double)*out > (double)(r->size - r->at)) {
        return mesh_fail_at(r, r->line, "%.0f promised, but only %lu bytes are left", (double)count,
                            (unsigned long)(r->size - r->at));
    }
    return 1;
}

static inline int off_read_face(mesh_reader *r) {
    uint64_t corners;
    if (!off_read_count(r, "number of a face's corners", &corners)) {
        return 0;
    }
    for (; corners > 0; corners--) {
        mesh_word word;
        int64_t index;
        off_next_word(r, &word);
        if (word.length == 0 || mesh_word_integer(word, &index) != word.length || index < 0 || index >= UINT32_MAX) {
            return mesh_fail_word(r, word, "vertex index from 0");
        }
        if (!mesh_add_corner(r, (uint32_t)index)) {
            return 0;
        }
    }
    if (!mesh_end_polygon(r)) {
        return 0;
    }
    mesh_next_line(r);      /* what follows is a colour */
    return 1;
}

/* OFF, with a normal, a colour or a texture coordinate behind each vertex: NOFF, COFF, STOFF and so on. */
static inline int mesh_read_off(mesh_reader *r) {
    mesh_word word;
    uint64_t vertices;
    uint64_t faces;
    uint64_t edges;
    off_next_word(r, &word);
    r->out->format = "OFF";
    if (word.text[0] == '4' || word.text[0] == 'n') {
        return mesh_fail_at(r, r->line, "an OFF file of more than three dimensions");
    }
    while (mesh_next_word(r, &word) && word.text[0] != '#') {
        if (mesh_word_is(word, "binary")) {
            return mesh_fail_at(r, r->line, "a binary OFF file: write it as text");
        }
        r->at -= word.length;       /* the counts may stand on the first line */
        break;
    }
    if (!off_read_count(r, "number of vertices", &vertices) || !off_read_count(r, "number of faces", &faces)
        || !off_read_count(r, "number of edges", &edges)) {
        return 0;
    }
    for (; vertices > 0; vertices--) {
        mesh_word first;
        if (!off_next_word(r, &first)) {
            return mesh_fail_word(r, first, "number");
        }
        r->at -= first.length;
        if (!mesh_read_position(r, 0, 3)) {
            return 0;
        }
        mesh_next_line(r);
    }
    for (; faces > 0; faces--) {
        if (!off_read_face(r)) {
            return 0;
        }
    }
    return 1;
}

/* ---- 7. Whole files -------------------------------------------------------------------------- */

static inline void mesh_free(mesh *m) {
    free(m->positions);
    free(m->exact);
    free(m->vertex_colours);
    free(m->face_colours);
    free(m->indices);
    memset(m, 0, sizeof *m);
}

static inline unsigned char *mesh_load_stream(FILE *file, mesh_reader *r) {
    void *bytes = NULL;
    size_t room = 0;
    size_t got = 1;
    int ok = 1;
    errno = 0;
    while (ok && got > 0) {
        ok = mesh_reserve(r, &bytes, &room, r->size, 65536, 1);
        if (ok) {
            got = fread((unsigned char *)bytes + r->size, 1, room - r->size - 2, file);
            r->size += got;
        }
    }
    if (ok && ferror(file)) {
        ok = mesh_fail_file(r, errno ? strerror(errno) : "read error");
    }
    if (!ok) {
        free(bytes);
        return NULL;
    }
    memset((unsigned char *)bytes + r->size, 0, 2);
    return (unsigned char *)bytes;
}

/* All bytes of a file, "-" being the standard input, and two zero bytes. Returns NULL with a sentence in
   `error`. */
static inline unsigned char *mesh_load_bytes(const char *path, size_t *out_size, char *error) {
    unsigned char *bytes = NULL;
    mesh_reader r;
    memset(&r, 0, sizeof r);
    r.path = path;
    r.error = error;
    if (strcmp(path, "-") == 0) {
#if defined(_WIN32)
        _setmode(_fileno(stdin), _O_BINARY);
#endif
        bytes = mesh_load_stream(stdin, &r);
    } else {
        FILE *file = fopen(path, "rb");
        if (file) {
            bytes = mesh_load_stream(file, &r);
            fclose(file);
        } else {
            mesh_fail_file(&r, strerror(errno));
        }
    }
    *out_size = r.size;
    return bytes;
}

static inline int mesh_read_gltf(mesh_reader *r);

static inline int mesh_name_ends(const char *path, const char *ending) {
    size_t length = strlen(path);
    size_t tail = strlen(ending);
    mesh_word word;
    if (length < tail) {
        return 0;
    }
    word.text = path + length - tail;
    word.length = tail;
    return mesh_word_is(word, ending);
}

/* A format that is no mesh text or is packed; NULL if it is none of these. */
static inline const char *mesh_foreign(const unsigned char *d, size_t size) {
    static const struct {
        const char *start;
        const char *sentence;
    } known[] = {
        {"\037\213", "this is a gzip file: unpack it first (gunzip)"},
        {"PK\003\004", "this is a zip archive (3MF, USDZ, ...): unpack it, and convert the mesh inside to OBJ, STL or PLY"},
        {"BZh", "this is a bzip2 file: unpack it first (bunzip2)"},
        {"\375" "7zXZ", "this is an xz file: unpack it first (unxz)"},
        {"(\265/\375", "this is a zstd file: unpack it first (unzstd)"},
        {"\377\376", "this text is UTF-16: save it as UTF-8 or ASCII"},
        {"\376\377", "this text is UTF-16: save it as UTF-8 or ASCII"},
        {"ISO-10303-21", "this is a STEP file, which holds surfaces and no triangles: export it as STL, OBJ or PLY"},
        {"Kaydara FBX Binary", "this is an FBX file: convert it to glTF, OBJ or PLY"},
        {"#VRML", "this is a VRML file: convert it to glTF, OBJ or PLY"},
        {"DRACO", "this is a Draco file: decode it to PLY or OBJ"},
    };
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; i++) {
        size_t length = strlen(known[i].start);
        if (known[i].sentence && size >= length && memcmp(d, known[i].start, length) == 0) {
            return known[i].sentence;
        }
    }
    if (size > 5 && memcmp(d, "<", 1) == 0) {
        size_t most = size < 2048 ? size : 2048;
        for (i = 0; i + 8 < most; i++) {
            if (memcmp(d + i, "<COLLADA", 8) == 0) {
                return "this is a COLLADA (DAE) file: convert it to glTF, OBJ or PLY";
            }
        }
        return "this is an XML file (X3D, 3MF's model, ...): convert it to glTF, OBJ or PLY";
    }
    return NULL;
}

static inline int mesh_word_ends(mesh_word word, const char *ending) {
    size_t tail = strlen(ending);
    mesh_word last;
    if (word.length < tail) {
        return 0;
    }
    last.text = word.text + (word.length - tail);
    last.length = tail;
    return mesh_word_is(last, ending);
}

static inline int mesh_parse(mesh_reader *r) {
    const unsigned char *d = r->data;
    const char *foreign;
    mesh_word first;
    size_t start;
    if (r->size >= 3 && memcmp(d, "\357\273\277", 3) == 0) {      /* a byte order mark */
        r->data += 3;
        r->size -= 3;
        d = r->data;
    }
    mesh_next_word_anywhere(r, &first);
    start = r->at - first.length;
    if (r->size == 0) {
        return mesh_fail_file(r, "the file is empty");
    }
    foreign = mesh_foreign(d, r->size);
    if (foreign) {
        return mesh_fail_file(r, foreign);
    }
    if (mesh_word_is(first, "ply")) {
        return mesh_read_ply(r);
    }
    r->at = 0;
    r->line = 1;
    if ((r->size >= 4 && memcmp(d, "glTF", 4) == 0) || d[start] == '{') {
        return mesh_read_gltf(r);
    }
    if (off_next_word(r, &first) && mesh_word_ends(first, "off") && first.length <= 7) {     /* comments may stand above */
        r->at = 0;
        r->line = 1;
        return mesh_read_off(r);
    }
    r->at = 0;
    r->line = 1;
    mesh_next_word_anywhere(r, &first);
    r->at = 0;
    r->line = 1;
    if (mesh_name_ends(r->path, ".obj")) {
        return mesh_read_obj(r);
    }
    if (mesh_name_ends(r->path, ".stl") || mesh_word_is(first, "solid")) {
        return mesh_stl_is_binary(r, mesh_word_is(first, "solid")) ? mesh_read_stl_binary(r) : mesh_read_stl_ascii(r);
    }
    if (r->size >= 84 && (double)r->size >= 84 + 50.0 * (double)mesh_u32(d + 80, 0) && memchr(d, 0, 84) != NULL) {
        return mesh_read_stl_binary(r);
    }
    if (mesh_name_ends(r->path, ".ply")) {
        return mesh_fail_at(r, 1, "a PLY file begins with the line 'ply'");
    }
    return mesh_read_obj(r);
}

/* The floats of the positions; the doubles stay only where they hold more. */
static inline int mesh_round(mesh_reader *r) {
    mesh *m = r->out;
    size_t n = 3 * m->vertices;
    size_t i;
    int same = 1;
    m->positions = (float *)malloc(n * sizeof(float) + 1);
    if (!m->positions) {
        return mesh_fail_file(r, "out of memory");
    }
    for (i = 0; i < n; i++) {
        double x = m->exact[i];
        m->positions[i] = x > (double)FLT_MAX ? HUGE_VALF : x < -(double)FLT_MAX ? -HUGE_VALF : (float)x;
        same = same && !((double)m->positions[i] < x || (double)m->positions[i] > x);
    }
    if (same) {
        free(m->exact);
        m->exact = NULL;
    }
    return 1;
}

/* Reads a mesh that stands in memory, with two zero bytes behind its end; `path` is its name in errors,
 * and its ending may help to tell the format. `error` has room for MESH_ERROR characters.
 *
 * Returns 1, or 0 with one sentence in `error` and an empty mesh.
 */
static inline int mesh_read_memory(mesh *out, const char *path, const unsigned char *data, size_t size,
                                   char *error) {
    mesh_reader r;
    int ok;
    memset(&r, 0, sizeof r);
    memset(out, 0, sizeof *out);
    r.path = path;
    r.error = error;
    r.out = out;
    r.data = data;
    r.size = size;
    r.line = 1;
    ok = mesh_parse(&r);
    if (ok && out->indices && r.largest >= out->vertices) {
        int from = strcmp(out->format, "OBJ") == 0;     /* where the file begins to count */
        ok = mesh_fail_at(&r, r.largest_place, "vertex number %lu (from %d), but the file has %lu vertices",
                          (unsigned long)r.largest + (unsigned long)from, from, (unsigned long)out->vertices);
    }
    if (ok && out->triangles == 0) {
        ok = mesh_fail_file(&r, "no triangles");
    }
    ok = ok && mesh_cut_polygons(&r) && mesh_round(&r);
    free(r.polygons);
    if (!ok) {
        mesh_free(out);
    }
    return ok;
}

/* Reads a mesh file, or with "-" the standard input; the rest as mesh_read_memory. */
static inline int mesh_read(mesh *out, const char *path, char *error) {
    unsigned char *bytes;
    size_t size;
    int ok;
    memset(out, 0, sizeof *out);
    bytes = mesh_load_bytes(path, &size, error);
    ok = bytes && mesh_read_memory(out, path, bytes, size, error);
    free(bytes);
    return ok;
}

static inline tribox_mesh_f64 mesh_view_f64(const mesh *m) {
    tribox_mesh_f64 view;
    view.positions = m->exact;
    view.stride = 0;
    view.indices = m->indices;
    view.triangles = m->triangles;
    return view;
}

static inline tribox_mesh mesh_view(const mesh *m) {
    tribox_mesh view;
    view.positions = m->positions;
    view.stride = 0;
    view.indices = m->indices;
    view.triangles = m->triangles;
    return view;
}

/* Corner i of triangle t, as exactly as the file has it. */
static inline void mesh_corner_f64(const mesh *m, size_t t, size_t i, double out[3]) {
    size_t vertex = m->indices ? m->indices[3 * t + i] : 3 * t + i;
    size_t k;
    for (k = 0; k < 3; k++) {
        out[k] = m->exact ? m->exact[3 * vertex + k] : (double)m->positions[3 * vertex + k];
    }
}

/* The three corners of triangle t. */
static inline void mesh_corners(const tribox_mesh *m, size_t t, const float *out_corner[3]) {
    size_t stride = m->stride ? m->stride : 3 * sizeof(float);
    size_t i;
    for (i = 0; i < 3; i++) {
        size_t vertex = m->indices ? m->indices[3 * t + i] : 3 * t + i;
        out_corner[i] = (const float *)(const void *)((const char *)m->positions + vertex * stride);
    }
}

#include "mesh_gltf.h"

#endif /* EXAMPLES_MESH_IO_H */
