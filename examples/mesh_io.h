/* mesh_io.h - reads a triangle mesh from an OBJ, STL (binary, ASCII) or PLY (ASCII, binary of both byte
 * orders) file
 *
 *   mesh m;
 *   char error[MESH_ERROR];
 *   if (!mesh_read(&m, "model.ply", error)) { fprintf(stderr, "%s\n", error); exit(2); }
 *   tribox_mesh view = mesh_view(&m);
 *   ...
 *   mesh_free(&m);
 *
 * The format is told by the content, not by the name. Polygons become fans. A bad file gives one sentence
 * with the line or the byte; nothing a file holds makes the reader crash, and the memory it takes is a
 * small multiple of the file's size: no number in a file is believed before the bytes it speaks of are
 * seen to be there.
 */
#ifndef EXAMPLES_MESH_IO_H
#define EXAMPLES_MESH_IO_H
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
    float      *positions;      /* x,y,z of each vertex */
    size_t      vertices;
    uint32_t   *indices;        /* 3 per triangle; NULL means 0,1,2, 3,4,5, ... */
    size_t      triangles;
    size_t      skipped;        /* faces with fewer than three corners */
    const char *format;         /* "OBJ", "binary STL", ... */
} mesh;

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
    size_t               vertex_room;
    size_t               index_room;
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

static inline int mesh_add_vertex(mesh_reader *r, const float position[3]) {
    void *items = r->out->positions;
    if (r->out->vertices >= UINT32_MAX) {
        return mesh_fail_at(r, mesh_place(r), "more than 4294967295 vertices");
    }
    if (!mesh_reserve(r, &items, &r->vertex_room, r->out->vertices, 1, 3 * sizeof(float))) {
        return 0;
    }
    r->out->positions = (float *)items;
    memcpy(r->out->positions + 3 * r->out->vertices, position, 3 * sizeof(float));
    r->out->vertices += 1;
    return 1;
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
    return 1;
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

static inline void mesh_end_polygon(mesh_reader *r) {
    r->out->skipped += r->corners < 3 ? 1 : 0;
    r->corners = 0;
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

/* The next word of this line; 0 at its end. */
static inline int mesh_next_word(mesh_reader *r, mesh_word *word) {
    word->text = "";
    word->length = 0;
    while (r->at < r->size && !mesh_is_newline(r)) {
        unsigned char c = r->data[r->at];
        size_t joint = mesh_joint(r);
        if (joint) {
            r->line += 1;
        } else if (c != ' ' && c != '\t' && c != '\r' && c != '\v' && c != '\f') {
            break;
        }
        r->at += joint ? joint : 1;
    }
    word->text = (const char *)r->data + r->at;
    while (r->at < r->size && r->data[r->at] != ' ' && r->data[r->at] != '\t' && r->data[r->at] != '\n'
           && r->data[r->at] != '\r' && r->data[r->at] != '\v' && r->data[r->at] != '\f' && !mesh_joint(r)) {
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

/* The word as a number: the nearest float and the nearest double, each rounded once. strtof stops by
   itself at the blank or zero byte behind the word. */
static inline int mesh_word_number(mesh_reader *r, mesh_word word, float *out_float, double *out_double) {
    char *end = NULL;
    if (word.length > 0) {
        *out_float = strtof(word.text, &end);
    }
    if (word.length == 0 || end != word.text + word.length) {
        return mesh_fail_word(r, word, "number");
    }
    if (out_double) {
        *out_double = strtod(word.text, NULL);
    }
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

static inline int mesh_read_position(mesh_reader *r, int anywhere) {
    float position[3];
    int a;
    for (a = 0; a < 3; a++) {
        mesh_word word;
        if (anywhere) {
            mesh_next_word_anywhere(r, &word);
        } else {
            mesh_next_word(r, &word);
        }
        if (!mesh_word_number(r, word, &position[a], NULL)) {
            return 0;
        }
    }
    return mesh_add_vertex(r, position);
}

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

static inline int mesh_read_obj(mesh_reader *r) {
    r->out->format = "OBJ";
    r->continued = 1;
    do {
        mesh_word word;
        if (!mesh_next_word(r, &word)) {
            continue;
        }
        if (mesh_word_is(word, "v") && !mesh_read_position(r, 0)) {
            return 0;
        }
        if (mesh_word_is(word, "f")) {
            while (mesh_next_word(r, &word) && word.text[0] != '#') {
                if (!mesh_read_obj_corner(r, word)) {
                    return 0;
                }
            }
            mesh_end_polygon(r);
        }
    } while (mesh_next_line(r));
    if (r->out->vertices == 0 && r->out->triangles == 0) {
        return mesh_fail_file(r, "no vertex found: not an OBJ, STL or PLY file");
    }
    return 1;
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

static inline int mesh_read_stl_binary(mesh_reader *r) {
    size_t count;
    size_t t;
    int i;
    r->out->format = "binary STL";
    r->binary = 1;
    if (r->size < 84) {
        r->at = r->size;
        return mesh_fail_at(r, r->at, "the file ends within the 84 bytes of a binary STL's header");
    }
    count = mesh_u32(r->data + 80, 0);
    if (count > (r->size - 84) / 50) {
        return mesh_fail_at(r, 80, "%lu triangles promised, which takes %.0f bytes, but the file has %lu",
                            (unsigned long)count, 84 + 50.0 * (double)count, (unsigned long)r->size);
    }
    for (t = 0; t < count; t++) {
        for (i = 0; i < 3; i++) {
            const unsigned char *corner = r->data + 84 + 50 * t + 12 + 12 * (size_t)i;
            float position[3];
            position[0] = mesh_f32(corner, 0);
            position[1] = mesh_f32(corner + 4, 0);
            position[2] = mesh_f32(corner + 8, 0);
            if (!mesh_add_vertex(r, position)) {
                return 0;
            }
        }
    }
    r->out->triangles = count;
    return 1;
}

/* Reads one facet after the word "facet". The normal is not used, and may be what some programs write for
   NaN. */
static inline int mesh_read_stl_facet(mesh_reader *r) {
    static const char *const wanted[] = {"normal", NULL, NULL, NULL, "outer", "loop",
                                         "vertex", "vertex", "vertex", "endloop", "endfacet"};
    size_t i;
    for (i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        mesh_word word;
        mesh_next_word_anywhere(r, &word);
        if (wanted[i] && !mesh_word_is(word, wanted[i])) {
            return mesh_fail_word(r, word, wanted[i]);
        }
        if (wanted[i] && strcmp(wanted[i], "vertex") == 0 && !mesh_read_position(r, 1)) {
            return 0;
        }
    }
    r->out->triangles += 1;
    return 1;
}

static inline int mesh_read_stl_ascii(mesh_reader *r) {
    mesh_word word;
    int inside = 0;
    r->out->format = "ASCII STL";
    while (mesh_next_word_anywhere(r, &word)) {
        if (mesh_word_is(word, inside ? "endsolid" : "solid")) {
            inside = !inside;
            mesh_next_line(r);      /* the rest of the line is a name */
        } else if (!inside || !mesh_word_is(word, "facet")) {
            return mesh_fail_word(r, word, inside ? "facet or endsolid" : "solid");
        } else if (!mesh_read_stl_facet(r)) {
            return 0;
        }
    }
    return inside ? mesh_fail_word(r, word, "facet or endsolid") : 1;
}

/* A binary STL may begin with "solid" too: the size tells them apart, then a zero byte in the header. */
static inline int mesh_stl_is_binary(const mesh_reader *r) {
    size_t head = r->size < 84 ? r->size : 84;
    if (r->size >= 84 && (double)r->size == 84 + 50.0 * (double)mesh_u32(r->data + 80, 0)) {
        return 1;
    }
    return memchr(r->data, 0, head) != NULL;
}

/* ---- 5. PLY ---------------------------------------------------------------------------------- */

enum { PLY_I8, PLY_U8, PLY_I16, PLY_U16, PLY_I32, PLY_U32, PLY_F32, PLY_F64, PLY_NO_TYPE };
/* What a property is read for. */
enum { PLY_OTHER, PLY_X, PLY_Y, PLY_Z, PLY_FACE, PLY_STRIP };

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
} ply_header;

typedef struct ply_number {
    float  as_float;
    double as_double;
} ply_number;

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
    int64_t rows;
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
        if (!mesh_next_word(r, &word)) {
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
            ok = mesh_fail_word(r, word, "element, property, comment or end_header");
        }
        if (!ok) {
            return 0;
        }
    }
    return mesh_fail_at(r, r->line, "end_header expected, found the end of the file");
}

static inline int ply_binary_number(mesh_reader *r, const ply_header *h, int type, ply_number *out) {
    unsigned char b[8];
    size_t size = ply_size(type);
    size_t i;
    uint64_t bits = 0;
    uint32_t low;
    if (size > r->size - r->at) {
        return mesh_fail_at(r, r->at, "the file ends within a value");
    }
    for (i = 0; i < size; i++) {        /* least byte first */
        b[i] = r->data[r->at + (h->big_endian ? size - 1 - i : i)];
        bits |= (uint64_t)b[i] << (8 * i);
    }
    low = (uint32_t)bits;
    switch (type) {
    case PLY_I8:  out->as_double = low < 0x80 ? low : (double)low - 256; break;
    case PLY_I16: out->as_double = low < 0x8000 ? low : (double)low - 65536; break;
    case PLY_I32: out->as_double = low < 0x80000000u ? low : (double)low - 4294967296.0; break;
    case PLY_F32: memcpy(&out->as_float, &low, sizeof low); out->as_double = (double)out->as_float; break;
    case PLY_F64: memcpy(&out->as_double, &bits, sizeof bits); break;
    default:       out->as_double = low; break;
    }
    if (type != PLY_F32) {
        out->as_float = out->as_double > (double)FLT_MAX ? HUGE_VALF
                      : out->as_double < -(double)FLT_MAX ? -HUGE_VALF : (float)out->as_double;
    }
    r->at += size;
    return 1;
}

static inline int ply_read_number(mesh_reader *r, const ply_header *h, int type, ply_number *out) {
    mesh_word word;
    if (r->binary) {
        return ply_binary_number(r, h, type, out);
    }
    mesh_next_word_anywhere(r, &word);
    return mesh_word_number(r, word, &out->as_float, &out->as_double);
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
    ply_number number = {0, 0};
    uint64_t count;
    uint64_t i;
    size_t place = mesh_place(r);
    if (!ply_read_number(r, h, property->count_type, &number)) {
        return 0;
    }
    if (!(number.as_double >= 0 && number.as_double <= 4294967295.0)
        || number.as_double != (double)(uint64_t)number.as_double) {
        return mesh_fail_at(r, r->binary ? place : r->line, "a list of %g values", number.as_double);
    }
    count = (uint64_t)number.as_double;
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
        if (!(number.as_double >= (strip ? -1 : 0) && number.as_double < 4294967295.0)
            || number.as_double != floor(number.as_double)) {
            return mesh_fail_at(r, r->binary ? place : r->line, "vertex index %g", number.as_double);
        }
        if (strip ? !ply_add_strip_corner(r, number.as_double)
                  : !mesh_add_corner(r, (uint32_t)number.as_double)) {
            return 0;
        }
    }
    if (property->role == PLY_FACE) {
        mesh_end_polygon(r);
    }
    return 1;
}

static inline int ply_read_row(mesh_reader *r, const ply_header *h, const ply_element *element,
                               int is_vertex) {
    float position[3] = {0, 0, 0};
    size_t i;
    for (i = 0; i < element->properties; i++) {
        const ply_property *property = &h->properties[element->first + i];
        ply_number number = {0, 0};
        if (property->count_type != PLY_NO_TYPE ? !ply_read_list(r, h, property)
                                                 : !ply_read_number(r, h, property->type, &number)) {
            return 0;
        }
        if (property->role >= PLY_X && property->role <= PLY_Z) {
            position[property->role - PLY_X] = number.as_float;
        }
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

static inline int mesh_read_ply(mesh_reader *r) {
    ply_header h = {0, NULL, 0, 0, NULL, 0, 0};
    size_t i;
    int faces = 0;
    int ok = ply_read_header(r, &h);
    r->binary = ok && strcmp(r->out->format, "ASCII PLY") != 0;
    for (i = 0; ok && i < h.element_count; i++) {
        ok = ply_read_rows(r, &h, &h.elements[i]);
    }
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

/* ---- 6. Whole files -------------------------------------------------------------------------- */

static inline void mesh_free(mesh *m) {
    free(m->positions);
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

static inline int mesh_parse(mesh_reader *r) {
    const unsigned char *d = r->data;
    mesh_word first;
    mesh_next_word(r, &first);
    r->at = 0;
    if (r->size == 0) {
        return mesh_fail_file(r, "the file is empty");
    }
    if (r->size >= 4 && memcmp(d, "ply", 3) == 0 && (d[3] == '\n' || d[3] == '\r' || d[3] == ' ')) {
        return mesh_read_ply(r);
    }
    if (mesh_name_ends(r->path, ".obj")) {
        return mesh_read_obj(r);
    }
    if (mesh_name_ends(r->path, ".stl") || mesh_word_is(first, "solid")) {
        return mesh_stl_is_binary(r) ? mesh_read_stl_binary(r) : mesh_read_stl_ascii(r);
    }
    if (r->size >= 84 && (double)r->size == 84 + 50.0 * (double)mesh_u32(d + 80, 0)) {
        return mesh_read_stl_binary(r);
    }
    if (mesh_name_ends(r->path, ".ply")) {
        return mesh_fail_at(r, 1, "a PLY file begins with the line 'ply'");
    }
    return mesh_read_obj(r);
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
        ok = mesh_fail_at(&r, r.largest_place, "vertex number %lu (from 0), but the file has %lu vertices",
                          (unsigned long)r.largest, (unsigned long)out->vertices);
    }
    if (ok && out->triangles == 0) {
        ok = mesh_fail_file(&r, "no triangles");
    }
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

static inline tribox_mesh mesh_view(const mesh *m) {
    tribox_mesh view;
    view.positions = m->positions;
    view.stride = 0;
    view.indices = m->indices;
    view.triangles = m->triangles;
    return view;
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

#endif /* EXAMPLES_MESH_IO_H */
