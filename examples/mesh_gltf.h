/* mesh_gltf.h - reads the triangles of a glTF 2.0 file, text or binary: included by mesh_io.h
 *
 * Buffers stand in the file (the binary chunk, data URIs) or in files beside it. The nodes of the scene, or of all
 * scenes' roots if none is named, place the meshes by their matrices. Points and lines are left out. What is packed
 * (Draco, meshopt) or sparse is named in the error.
 */
#ifndef EXAMPLES_MESH_GLTF_H
#define EXAMPLES_MESH_GLTF_H
#include "mesh_io.h"

/* ---- 1. JSON ----------------------------------------------------------------------------------- */

enum { JSON_DEPTH = 64 };

/* A value: an object ('{', its children keys and values in turn), an array ('['), a string ('"', between its
 * quotes) or anything else ('0'). Node 0 is the whole; `end` is the number of the first node behind this one. */
typedef struct json_node {
    char        kind;
    const char *text;
    size_t      length;
    size_t      end;
} json_node;

typedef struct json {
    json_node *nodes;
    size_t     count;
    size_t     room;
} json;

static inline void json_skip_blanks(mesh_reader *r) {
    while (r->at < r->size && (r->data[r->at] == ' ' || r->data[r->at] == '\t' || r->data[r->at] == '\n'
                               || r->data[r->at] == '\r')) {
        r->at += 1;
    }
}

static inline int json_fail(mesh_reader *r) {
    return mesh_fail_at(r, r->at, r->at < r->size ? "this is no JSON" : "the file ends within its JSON");
}

static inline int json_string(mesh_reader *r, json_node *node) {
    r->at += 1;
    node->text = (const char *)r->data + r->at;
    while (r->at < r->size && r->data[r->at] != '"') {
        r->at += r->data[r->at] == '\\' && r->at + 1 < r->size ? 2 : 1;
    }
    if (r->at >= r->size) {
        return json_fail(r);
    }
    node->length = (size_t)((const char *)r->data + r->at - node->text);
    r->at += 1;
    return 1;
}

static inline int json_read(mesh_reader *r, json *j, int depth);

/* The members of an object or array, after its opening bracket. */
static inline int json_members(mesh_reader *r, json *j, char close, int depth) {
    json_skip_blanks(r);
    if (r->at < r->size && r->data[r->at] == (unsigned char)close) {
        r->at += 1;
        return 1;
    }
    for (;;) {
        if (close == '}') {
            json_skip_blanks(r);
            if (r->at >= r->size || r->data[r->at] != '"' || !json_read(r, j, depth)) {
                return json_fail(r);
            }
            json_skip_blanks(r);
            if (r->at >= r->size || r->data[r->at] != ':') {
                return json_fail(r);
            }
            r->at += 1;
        }
        if (!json_read(r, j, depth)) {
            return 0;
        }
        json_skip_blanks(r);
        if (r->at >= r->size || (r->data[r->at] != ',' && r->data[r->at] != (unsigned char)close)) {
            return json_fail(r);
        }
        r->at += 1;
        if (r->data[r->at - 1] == (unsigned char)close) {
            return 1;
        }
    }
}

static inline int json_read(mesh_reader *r, json *j, int depth) {
    void *items = j->nodes;
    size_t at = j->count;
    json_node node = {'0', NULL, 0, 0};
    json_skip_blanks(r);
    if (depth == 0 || r->at >= r->size) {
        return json_fail(r);
    }
    if (!mesh_reserve(r, &items, &j->room, j->count, 1, sizeof node)) {
        return 0;
    }
    j->nodes = (json_node *)items;
    j->count += 1;
    node.text = (const char *)r->data + r->at;
    if (r->data[r->at] == '{' || r->data[r->at] == '[') {
        node.kind = (char)r->data[r->at];
        r->at += 1;
        if (!json_members(r, j, node.kind == '{' ? '}' : ']', depth - 1)) {
            return 0;
        }
    } else if (r->data[r->at] == '"') {
        node.kind = '"';
        if (!json_string(r, &node)) {
            return 0;
        }
    } else {
        while (r->at < r->size && (r->data[r->at] == '-' || r->data[r->at] == '+' || r->data[r->at] == '.'
                                   || (r->data[r->at] >= '0' && r->data[r->at] <= '9')
                                   || (r->data[r->at] >= 'A' && r->data[r->at] <= 'Z')
                                   || (r->data[r->at] >= 'a' && r->data[r->at] <= 'z'))) {
            r->at += 1;
            node.length += 1;
        }
        if (node.length == 0) {
            return json_fail(r);
        }
    }
    node.end = j->count;
    j->nodes[at] = node;
    return 1;
}

/* The member `name` of an object; 0 (the whole, no member of anything) if it has none. */
static inline size_t json_get(const json *j, size_t object, const char *name) {
    size_t length = strlen(name);
    size_t i = object + 1;
    if (j->nodes[object].kind != '{') {
        return 0;
    }
    while (i < j->nodes[object].end) {
        size_t value = i + 1;
        if (j->nodes[i].length == length && memcmp(j->nodes[i].text, name, length) == 0) {
            return value;
        }
        i = j->nodes[value].end;
    }
    return 0;
}

/* Number `index` of an array; 0 if it is shorter. */
static inline size_t json_item(const json *j, size_t array, size_t index) {
    size_t i = array + 1;
    if (j->nodes[array].kind != '[' || array == 0) {
        return 0;
    }
    for (; i < j->nodes[array].end; i = j->nodes[i].end) {
        if (index == 0) {
            return i;
        }
        index -= 1;
    }
    return 0;
}

/* The number of a member; `otherwise` if there is none. */
static inline double json_number(const json *j, size_t object, const char *name, double otherwise) {
    size_t value = json_get(j, object, name);
    return value && j->nodes[value].kind == '0' ? strtod(j->nodes[value].text, NULL) : otherwise;
}

/* A member that is a whole number from 0: -1 if there is none, -2 if it is something else. */
static inline int64_t json_whole(const json *j, size_t object, const char *name) {
    double x;
    if (!json_get(j, object, name)) {
        return -1;
    }
    x = json_number(j, object, name, -2);
    return x >= 0 && x < 9007199254740992.0 && floor(x) == x ? (int64_t)x : -2;
}

static inline int json_is(const json *j, size_t node, const char *text) {
    return node != 0 && j->nodes[node].length == strlen(text)
        && memcmp(j->nodes[node].text, text, j->nodes[node].length) == 0;
}

/* ---- 2. Buffers --------------------------------------------------------------------------------- */

typedef struct gltf_buffer {
    const unsigned char *data;
    size_t               size;
    unsigned char       *owned;
} gltf_buffer;

/* Members of the whole that are asked by number: where each stands. */
typedef struct gltf_list {
    size_t *item;
    size_t  count;
} gltf_list;

enum { GLTF_BUFFERS, GLTF_VIEWS, GLTF_ACCESSORS, GLTF_MESHES, GLTF_NODES, GLTF_SCENES, GLTF_LISTS };

typedef struct gltf {
    mesh_reader *r;
    json         j;
    gltf_list    list[GLTF_LISTS];
    gltf_buffer *buffers;
    gltf_buffer  chunk;         /* of a binary file */
    unsigned char *visited;     /* nodes */
} gltf;

static inline int gltf_fail(gltf *g, const char *what, size_t number) {
    char sentence[160];
    snprintf(sentence, sizeof sentence, what, (unsigned long)number);
    return mesh_fail_file(g->r, sentence);
}

static inline int gltf_lists(gltf *g) {
    static const char *const names[GLTF_LISTS] = {"buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes"};
    int k;
    for (k = 0; k < GLTF_LISTS; k++) {
        size_t array = json_get(&g->j, 0, names[k]);
        size_t i;
        if (!array || g->j.nodes[array].kind != '[') {
            continue;
        }
        g->list[k].item = (size_t *)malloc((g->j.nodes[array].end - array) * sizeof(size_t));
        if (!g->list[k].item) {
            return mesh_fail_file(g->r, "out of memory");
        }
        for (i = array + 1; i < g->j.nodes[array].end; i = g->j.nodes[i].end) {
            g->list[k].item[g->list[k].count] = i;
            g->list[k].count += 1;
        }
    }
    return 1;
}

static inline int gltf_base64(gltf *g, gltf_buffer *out, const char *text, size_t length) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint32_t bits = 0;
    int have = 0;
    size_t i;
    out->owned = (unsigned char *)malloc(length / 4 * 3 + 4);
    if (!out->owned) {
        return mesh_fail_file(g->r, "out of memory");
    }
    for (i = 0; i < length && text[i] != '='; i++) {
        const char *digit = text[i] ? strchr(digits, text[i]) : NULL;
        if (!digit) {
            return mesh_fail_at(g->r, (size_t)((const unsigned char *)text - g->r->data) + i, "a buffer's base64 ends");
        }
        bits = bits << 6 | (uint32_t)(digit - digits);
        have += 6;
        if (have >= 8) {
            have -= 8;
            out->owned[out->size] = (unsigned char)(bits >> have);
            out->size += 1;
        }
    }
    out->data = out->owned;
    return 1;
}

/* A buffer in a file beside this one; %20 and the like stand for the character of that number. */
static inline int gltf_beside(gltf *g, gltf_buffer *out, const char *uri, size_t length) {
    const char *slash = strrchr(g->r->path, '/');
    size_t folder = slash ? (size_t)(slash - g->r->path) + 1 : 0;
    char *path = (char *)malloc(folder + length + 1);
    size_t used = folder;
    size_t i;
    int ok = 1;
    if (!path) {
        return mesh_fail_file(g->r, "out of memory");
    }
    memcpy(path, g->r->path, folder);
    for (i = 0; i < length; i++) {
        char hex[3] = {0, 0, 0};
        path[used] = uri[i];
        if (uri[i] == '%' && i + 2 < length) {
            char *end;
            memcpy(hex, uri + i + 1, 2);
            path[used] = (char)strtol(hex, &end, 16);
            i += 2;
            ok = ok && end == hex + 2;
        }
        ok = ok && path[used] != 0 && path[used] != ':' && path[used] != '\\';
        used += 1;
    }
    path[used] = 0;
    if (!ok || path[folder] == '/' || strstr(path + folder, "..") || strcmp(g->r->path, "-") == 0) {
        free(path);
        return mesh_fail_file(g->r, "a buffer's name is that of no file beside this one");
    }
    out->owned = mesh_load_bytes(path, &out->size, g->r->error);
    out->data = out->owned;
    free(path);
    return out->owned != NULL;
}

static inline int gltf_load_buffers(gltf *g) {
    size_t i;
    g->buffers = (gltf_buffer *)calloc(g->list[GLTF_BUFFERS].count + 1, sizeof *g->buffers);
    if (!g->buffers) {
        return mesh_fail_file(g->r, "out of memory");
    }
    for (i = 0; i < g->list[GLTF_BUFFERS].count; i++) {
        size_t uri = json_get(&g->j, g->list[GLTF_BUFFERS].item[i], "uri");
        const char *text = uri ? g->j.nodes[uri].text : "";
        size_t length = uri ? g->j.nodes[uri].length : 0;
        const char *comma = length ? (const char *)memchr(text, ',', length) : NULL;
        int ok = 1;
        if (!uri) {
            g->buffers[i] = g->chunk;
        } else if (length > 5 && memcmp(text, "data:", 5) == 0 && comma) {
            ok = gltf_base64(g, &g->buffers[i], comma + 1, (size_t)(text + length - comma - 1));
        } else {
            ok = gltf_beside(g, &g->buffers[i], text, length);
        }
        if (!ok) {
            return 0;
        }
    }
    return 1;
}

/* ---- 3. Accessors ------------------------------------------------------------------------------- */

typedef struct gltf_data {
    const unsigned char *at;
    size_t               count;
    size_t               stride;
    int                  type;          /* 5120 to 5126: i8, u8, i16, u16, -, u32, f32 */
    int                  normalized;
} gltf_data;

static inline size_t gltf_size(int type) {
    return type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
}

/* Finds the numbers of an accessor, `components` for each item; sees that they are there. */
static inline int gltf_access(gltf *g, int64_t number, size_t components, gltf_data *out) {
    const json *j = &g->j;
    size_t accessor;
    size_t view;
    int64_t index;
    int64_t offset;
    int64_t inner;
    int64_t count;
    int64_t stride;
    const gltf_buffer *buffer;
    double need;
    if (number < 0 || (uint64_t)number >= g->list[GLTF_ACCESSORS].count) {
        return mesh_fail_file(g->r, "a mesh names an accessor that is not there");
    }
    accessor = g->list[GLTF_ACCESSORS].item[number];
    if (json_get(j, accessor, "sparse")) {
        return gltf_fail(g, "accessor %lu is sparse, which this reader does not know", (size_t)number);
    }
    index = json_whole(j, accessor, "bufferView");
    if (index < 0 || (uint64_t)index >= g->list[GLTF_VIEWS].count) {
        return gltf_fail(g, "accessor %lu has no data of its own (packed by an extension?)", (size_t)number);
    }
    view = g->list[GLTF_VIEWS].item[index];
    index = json_whole(j, accessor, "componentType");
    out->type = index >= 5120 && index <= 5126 ? (int)index : 0;
    out->normalized = json_is(j, json_get(j, accessor, "normalized"), "true");
    count = json_whole(j, accessor, "count");
    index = json_whole(j, view, "buffer");
    if (out->type == 0 || out->type == 5124 || count < 0 || index < 0
        || (uint64_t)index >= g->list[GLTF_BUFFERS].count || json_get(j, view, "extensions")) {
        return gltf_fail(g, "accessor %lu cannot be read: its type, its count, or packed data", (size_t)number);
    }
    buffer = &g->buffers[index];
    offset = json_whole(j, view, "byteOffset");
    inner = json_whole(j, accessor, "byteOffset");
    stride = json_whole(j, view, "byteStride");
    offset = (offset > 0 ? offset : 0) + (inner > 0 ? inner : 0);
    out->stride = stride > 0 && stride < 65536 ? (size_t)stride : components * gltf_size(out->type);
    out->count = (size_t)count;
    need = (double)offset + (count > 0 ? (double)(count - 1) * (double)out->stride : 0.0)
        + (count > 0 ? (double)(components * gltf_size(out->type)) : 0.0);
    if (need > (double)buffer->size) {
        return gltf_fail(g, "accessor %lu reaches beyond its buffer", (size_t)number);
    }
    out->at = buffer->data ? buffer->data + offset : NULL;
    return 1;
}

static inline double gltf_component(const gltf_data *d, size_t item, size_t component) {
    const unsigned char *p = d->at + item * d->stride + component * gltf_size(d->type);
    uint32_t half = gltf_size(d->type) >= 2 ? (uint32_t)p[0] | (uint32_t)p[1] << 8 : 0;
    double x;
    switch (d->type) {
    case 5120: x = p[0] < 128 ? p[0] : (double)p[0] - 256; return d->normalized ? (x < -127 ? -1 : x / 127) : x;
    case 5121: x = p[0]; return d->normalized ? x / 255 : x;
    case 5122: x = half < 32768 ? half : (double)half - 65536; return d->normalized ? (x < -32767 ? -1 : x / 32767) : x;
    case 5123: x = half; return d->normalized ? x / 65535 : x;
    case 5125: return (double)mesh_u32(p, 0);
    default:   return (double)mesh_f32(p, 0);
    }
}

/* ---- 4. Meshes and nodes ------------------------------------------------------------------------- */

typedef double gltf_matrix[4][3];       /* columns: the images of x, y, z and of the origin */

static inline int gltf_is_identity(gltf_matrix m) {
    int i;
    int k;
    for (i = 0; i < 4; i++) {
        for (k = 0; k < 3; k++) {
            if (m[i][k] < (i == k) || m[i][k] > (i == k)) {
                return 0;
            }
        }
    }
    return 1;
}

static inline int gltf_positions(gltf *g, const gltf_data *d, gltf_matrix m) {
    int plain = gltf_is_identity(m);
    size_t i;
    for (i = 0; i < d->count; i++) {
        double p[3];
        double q[3];
        size_t k;
        for (k = 0; k < 3; k++) {
            p[k] = gltf_component(d, i, k);
        }
        for (k = 0; k < 3; k++) {
            q[k] = plain ? p[k] : m[0][k] * p[0] + m[1][k] * p[1] + m[2][k] * p[2] + m[3][k];
        }
        if (!mesh_add_vertex(g->r, q)) {
            return 0;
        }
    }
    return 1;
}

/* Triangles (mode 4), a strip (5) or a fan (6). */
static inline int gltf_triangles(gltf *g, const gltf_data *index, size_t count, size_t base, int64_t mode) {
    uint32_t corner[3] = {0, 0, 0};
    size_t i;
    for (i = 0; i < count; i++) {
        size_t vertex = index ? (size_t)gltf_component(index, i, 0) : i;
        size_t k = mode == 4 ? i % 3 : i < 2 ? i : 2;
        if (index && gltf_size(index->type) >= 1 && vertex >= (index->type == 5121 ? 255u : index->type == 5123 ? 65535u
                                                                                         : 4294967295u)) {
            return mesh_fail_file(g->r, "primitive restart in indices, which glTF forbids");
        }
        if (base + vertex >= UINT32_MAX) {
            return mesh_fail_file(g->r, "more than 4294967295 vertices");
        }
        corner[k] = (uint32_t)(base + vertex);
        mesh_note_index(g->r, corner[k]);
        if (k < 2) {
            continue;
        }
        if (!mesh_add_triangle(g->r, corner[0], corner[1], corner[2])) {
            return 0;
        }
        if (mode == 5) {
            corner[0] = corner[1];
        }
        if (mode != 4) {
            corner[1] = corner[2];
        }
    }
    return 1;
}

/* The base colour of a primitive's material; the file has it linear, as parts of 1. */
static inline void gltf_material(gltf *g, size_t primitive) {
    const json *j = &g->j;
    int64_t number = json_whole(j, primitive, "material");
    size_t material = number >= 0 ? json_item(j, json_get(j, 0, "materials"), (size_t)number) : 0;
    size_t metal = material ? json_get(j, material, "pbrMetallicRoughness") : 0;
    size_t factor = metal ? json_get(j, metal, "baseColorFactor") : 0;
    double rgb[3];
    size_t i;
    g->r->material = 0xffffffu;
    if (!factor) {
        return;
    }
    for (i = 0; i < 3; i++) {
        size_t item = json_item(j, factor, i);
        double light = item ? strtod(j->nodes[item].text, NULL) : 1;
        rgb[i] = light > 0.0031308 ? 1.055 * pow(light, 1 / 2.4) - 0.055 : 12.92 * light;
    }
    g->r->material = mesh_colour(rgb, 1);
    g->r->has_material = 1;
}

static inline int gltf_primitive(gltf *g, size_t primitive, gltf_matrix m) {
    const json *j = &g->j;
    size_t attributes = json_get(j, primitive, "attributes");
    size_t extensions = json_get(j, primitive, "extensions");
    int64_t mode = json_whole(j, primitive, "mode");
    size_t base = g->r->out->vertices;
    gltf_data positions;
    gltf_data indices;
    mode = mode == -1 ? 4 : mode;
    if (extensions && json_get(j, extensions, "KHR_draco_mesh_compression")) {
        return mesh_fail_file(g->r, "its meshes are packed by Draco: unpack them first");
    }
    if (mode < 4 || mode > 6 || !attributes || !json_get(j, attributes, "POSITION")) {
        return 1;
    }
    gltf_material(g, primitive);
    if (!gltf_access(g, json_whole(j, attributes, "POSITION"), 3, &positions) || !gltf_positions(g, &positions, m)) {
        return 0;
    }
    if (!json_get(j, primitive, "indices")) {
        return gltf_triangles(g, NULL, positions.count, base, mode);
    }
    if (!gltf_access(g, json_whole(j, primitive, "indices"), 1, &indices)) {
        return 0;
    }
    if (indices.type != 5121 && indices.type != 5123 && indices.type != 5125) {
        return mesh_fail_file(g->r, "indices of a type that glTF does not have");
    }
    return gltf_triangles(g, &indices, indices.count, base, mode);
}

/* The node's own matrix, or that of its scale, rotation and translation. */
static inline void gltf_local(const json *j, size_t node, gltf_matrix out) {
    static const char *const names[3] = {"rotation", "scale", "translation"};
    static const double usual[3][4] = {{0, 0, 0, 1}, {1, 1, 1, 0}, {0, 0, 0, 0}};
    size_t matrix = json_get(j, node, "matrix");
    double v[3][4];
    size_t i;
    size_t k;
    for (i = 0; i < 3; i++) {
        size_t array = json_get(j, node, names[i]);
        for (k = 0; k < 4; k++) {
            size_t item = array ? json_item(j, array, k) : 0;
            v[i][k] = item ? strtod(j->nodes[item].text, NULL) : usual[i][k];
        }
    }
    for (i = 0; i < 4; i++) {
        for (k = 0; k < 3; k++) {
            size_t item = matrix ? json_item(j, matrix, 4 * i + k) : 0;
            double x = v[0][k];
            double rotated;
            if (i == 3) {
                rotated = v[2][k];
            } else if (i == k) {
                double b = v[0][(k + 1) % 3];
                double c = v[0][(k + 2) % 3];
                rotated = (1 - 2 * (b * b + c * c)) * v[1][i];
            } else {
                double other = v[0][3 - i - k];
                rotated = 2 * (x * v[0][i] + ((k + 3 - i) % 3 == 1 ? 1 : -1) * other * v[0][3]) * v[1][i];
            }
            out[i][k] = item ? strtod(j->nodes[item].text, NULL) : rotated;
        }
    }
}

static inline int gltf_node(gltf *g, size_t number, gltf_matrix parent, int depth) {
    const json *j = &g->j;
    gltf_matrix local;
    gltf_matrix m;
    size_t node;
    size_t children;
    size_t i;
    size_t k;
    int64_t index;
    if (number >= g->list[GLTF_NODES].count || g->visited[number] || depth == 0) {
        return gltf_fail(g, "node %lu is not there, has two parents, or stands too deep", number);
    }
    g->visited[number] = 1;
    node = g->list[GLTF_NODES].item[number];
    gltf_local(j, node, local);
    for (i = 0; i < 4; i++) {
        for (k = 0; k < 3; k++) {
            m[i][k] = parent[0][k] * local[i][0] + parent[1][k] * local[i][1] + parent[2][k] * local[i][2]
                + (i == 3 ? parent[3][k] : 0);
        }
    }
    index = json_whole(j, node, "mesh");
    if (index >= 0 && (uint64_t)index < g->list[GLTF_MESHES].count) {
        size_t primitives = json_get(j, g->list[GLTF_MESHES].item[index], "primitives");
        for (i = primitives + 1; primitives && i < j->nodes[primitives].end; i = j->nodes[i].end) {
            if (!gltf_primitive(g, i, m)) {
                return 0;
            }
        }
    }
    children = json_get(j, node, "children");
    for (i = children + 1; children && i < j->nodes[children].end; i = j->nodes[i].end) {
        double child = strtod(j->nodes[i].text, NULL);
        if (!gltf_node(g, child >= 0 && child < 4e9 ? (size_t)child : SIZE_MAX, m, depth - 1)) {
            return 0;
        }
    }
    return 1;
}

static inline int gltf_scene(gltf *g) {
    const json *j = &g->j;
    gltf_matrix identity = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    int64_t number = json_whole(j, 0, "scene");
    size_t roots = 0;
    size_t i;
    number = number >= 0 ? number : 0;
    g->visited = (unsigned char *)calloc(g->list[GLTF_NODES].count + 1, 1);
    if (!g->visited) {
        return mesh_fail_file(g->r, "out of memory");
    }
    if ((uint64_t)number < g->list[GLTF_SCENES].count) {
        roots = json_get(j, g->list[GLTF_SCENES].item[number], "nodes");
    }
    for (i = roots + 1; roots && i < j->nodes[roots].end; i = j->nodes[i].end) {
        double root = strtod(j->nodes[i].text, NULL);
        if (!gltf_node(g, root >= 0 && root < 4e9 ? (size_t)root : SIZE_MAX, identity, JSON_DEPTH)) {
            return 0;
        }
    }
    for (i = 0; !roots && i < g->list[GLTF_MESHES].count; i++) {      /* no scene: the meshes as they are */
        size_t primitives = json_get(j, g->list[GLTF_MESHES].item[i], "primitives");
        size_t p;
        for (p = primitives + 1; primitives && p < j->nodes[primitives].end; p = j->nodes[p].end) {
            if (!gltf_primitive(g, p, identity)) {
                return 0;
            }
        }
    }
    return 1;
}

/* ---- 5. The file --------------------------------------------------------------------------------- */

/* Leaves the reader at the JSON, which ends at its size, and finds the binary chunk. */
static inline int gltf_chunks(gltf *g) {
    mesh_reader *r = g->r;
    size_t length;
    if (r->size < 20 || mesh_u32(r->data + 4, 0) != 2) {
        return mesh_fail_at(r, 4, "a binary glTF file of version 2 is wanted");
    }
    length = mesh_u32(r->data + 12, 0);
    if (length > r->size - 20 || memcmp(r->data + 16, "JSON", 4) != 0) {
        return mesh_fail_at(r, 12, "the first chunk should be JSON, and end within the file");
    }
    if (r->size - 20 - length >= 8) {
        const unsigned char *chunk = r->data + 20 + length;
        size_t size = mesh_u32(chunk, 0);
        size_t most = r->size - 20 - length - 8;
        g->chunk.data = chunk + 8;
        g->chunk.size = size < most ? size : most;
    }
    r->at = 20;
    r->size = 20 + length;
    return 1;
}

static inline void gltf_free(gltf *g) {
    size_t i;
    for (i = 0; g->buffers && i < g->list[GLTF_BUFFERS].count; i++) {
        free(g->buffers[i].owned);
    }
    for (i = 0; i < GLTF_LISTS; i++) {
        free(g->list[i].item);
    }
    free(g->buffers);
    free(g->visited);
    free(g->j.nodes);
}

static inline int mesh_read_gltf(mesh_reader *r) {
    gltf g;
    size_t asset;
    int binary = r->size >= 4 && memcmp(r->data, "glTF", 4) == 0;
    int ok;
    memset(&g, 0, sizeof g);
    g.r = r;
    r->binary = 1;
    r->out->format = binary ? "binary glTF" : "glTF";
    ok = (!binary || gltf_chunks(&g)) && json_read(r, &g.j, JSON_DEPTH);
    asset = ok ? json_get(&g.j, 0, "asset") : 0;
    if (ok && (!asset || !json_get(&g.j, asset, "version"))) {
        ok = mesh_fail_file(r, "JSON, but not glTF: it has no asset.version");
    } else if (ok && strtod(g.j.nodes[json_get(&g.j, asset, "version")].text, NULL) < 2) {
        ok = mesh_fail_file(r, "this is glTF 1.0: convert it to 2.0");
    }
    ok = ok && gltf_lists(&g) && gltf_load_buffers(&g) && gltf_scene(&g);
    gltf_free(&g);
    return ok;
}

#endif /* EXAMPLES_MESH_GLTF_H */
