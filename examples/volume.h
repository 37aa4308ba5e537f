/* volume.h - arrays of numbers in space, as other programs write them: .npy, .nrrd, .mha, .vti, .vox,
 * .binvox, bits
 *
 *   volume v;
 *   if (!volume_read(&v, "out.vti", NULL, error)) { ... }
 *   volume_set(&v, VOLUME_ABOVE, 0, &voxels, error);      the voxels with a number above 0
 *
 * The format is told by the name's ending. A file that cannot be read gives one sentence; no size that it
 * claims is believed before the bytes are seen to be there.
 */
#ifndef EXAMPLES_VOLUME_H
#define EXAMPLES_VOLUME_H
#include "inflate.h"
#include "voxel_io.h"

/* The numbers' type: how many bits, and of what kind. */
typedef struct volume_type {
    char kind;                  /* 'i' signed, 'u' unsigned, 'f' floating point, 'l' and 'm' bits, lowest or highest first */
    int  bytes;                 /* 0: eight numbers in a byte */
} volume_type;

enum { VOLUME_NOWHERE, VOLUME_CORNER, VOLUME_SAMPLE };      /* what `origin` is: unknown, of the first cell, sample 0 */
enum { VOLUME_ABOVE, VOLUME_BELOW };

typedef struct volume {
    const char    *format;
    size_t         n[3];        /* along x, y, z */
    size_t         stride[3];   /* from one number to the next along each axis, in numbers */
    int            placed;      /* VOLUME_CORNER, ... */
    int            free_order;  /* the format doesn't say which index is x */
    double         origin[3];
    double         size[3];
    int            first[3];    /* number of the first voxel: index 0 lies at origin + first*size */
    volume_type    type;
    int            big_endian;
    unsigned char *bytes;       /* all numbers, one behind the other; NULL: the format has bits only, */
    voxels         bits;        /* these */
} volume;

static inline void volume_free(volume *v) {
    free(v->bytes);
    v->bytes = NULL;
    voxels_free(&v->bits);
}

/* ---- 1. Numbers ---------------------------------------------------------------------------------- */

static inline double volume_number(const unsigned char *p, volume_type type, int big_endian) {
    uint64_t bits = 0;
    float f;
    double d;
    uint32_t low;
    int i;
    for (i = 0; i < type.bytes; i++) {
        bits |= (uint64_t)p[big_endian ? type.bytes - 1 - i : i] << (8 * i);
    }
    if (type.kind == 'f' && type.bytes == 4) {
        low = (uint32_t)bits;
        memcpy(&f, &low, sizeof f);
        return (double)f;
    }
    if (type.kind == 'f') {
        memcpy(&d, &bits, sizeof d);
        return d;
    }
    if (type.kind == 'i' && type.bytes < 8 && bits >> (8 * type.bytes - 1)) {
        return (double)(int64_t)(bits | ~(uint64_t)0 << (8 * type.bytes));
    }
    return type.kind == 'i' ? (double)(int64_t)bits : (double)bits;
}

static inline double volume_get(const volume *v, size_t x, size_t y, size_t z) {
    size_t at = x * v->stride[0] + y * v->stride[1] + z * v->stride[2];
    if (!v->bytes) {
        return voxels_get(&v->bits, x, y, z);
    }
    if (v->type.bytes == 0) {
        return v->bytes[at / 8] >> (v->type.kind == 'l' ? at % 8 : 7 - at % 8) & 1;
    }
    return volume_number(v->bytes + at * (size_t)v->type.bytes, v->type, v->big_endian);
}

static inline size_t volume_count(const volume *v) {
    return v->n[0] * v->n[1] * v->n[2];
}

/* How many bytes `count` numbers take. */
static inline size_t volume_size(volume_type type, size_t count) {
    return type.bytes ? count * (size_t)type.bytes : (count + 7) / 8;
}

/* x runs fastest, then y, then z; or the other way round. */
static inline void volume_order(volume *v, int x_fastest) {
    int fast = x_fastest ? 0 : 2;
    v->stride[fast] = 1;
    v->stride[1] = v->n[fast];
    v->stride[2 - fast] = v->n[fast] * v->n[1];
}

/* Takes another reading of the array's indices: what was x is z. */
static inline void volume_turn(volume *v) {
    size_t n = v->n[0];
    size_t stride = v->stride[0];
    v->n[0] = v->n[2];
    v->n[2] = n;
    v->stride[0] = v->stride[2];
    v->stride[2] = stride;
}

static inline int volume_grid(const volume *v, tribox_grid *out, char *error) {
    int a;
    memset(out, 0, sizeof *out);
    for (a = 0; a < 3; a++) {
        out->origin[a] = v->origin[a];
        out->size[a] = v->placed ? v->size[a] : 1;
        out->lo[a] = v->first[a];
        out->hi[a] = v->first[a] + (int)v->n[a];        /* both are below 2^30 */
    }
    if (v->placed && (!(fabs(v->origin[0]) + fabs(v->origin[1]) + fabs(v->origin[2]) <= DBL_MAX)
                      || !(v->size[0] > 0 && v->size[1] > 0 && v->size[2] > 0)
                      || !(v->size[0] + v->size[1] + v->size[2] <= DBL_MAX))) {
        snprintf(error, MESH_ERROR, "the file's origin must be finite, and its spacing finite and above 0");
        return 0;
    }
    return 1;
}

/* The voxels whose number is above, or below, a level; NaN is neither. */
static inline int volume_set(const volume *v, int side, double level, voxels *out, char *error) {
    tribox_grid grid;
    size_t x;
    size_t y;
    size_t z;
    if (!volume_grid(v, &grid, error) || !voxels_make(out, &grid, error)) {
        return 0;
    }
    for (z = 0; z < v->n[2]; z++) {
        for (y = 0; y < v->n[1]; y++) {
            uint64_t *row = voxels_row(out, y, z);
            for (x = 0; x < v->n[0]; x++) {
                double value = volume_get(v, x, y, z);
                row[x >> 6] |= (uint64_t)(side == VOLUME_ABOVE ? value > level : value < level) << (x & 63);
            }
        }
    }
    return 1;
}

/* The least and the greatest number. */
static inline void volume_range(const volume *v, double *least, double *greatest) {
    size_t x;
    size_t y;
    size_t z;
    *least = HUGE_VAL;
    *greatest = -HUGE_VAL;
    for (z = 0; z < v->n[2]; z++) {
        for (y = 0; y < v->n[1]; y++) {
            for (x = 0; x < v->n[0]; x++) {
                double value = volume_get(v, x, y, z);
                *least = value < *least ? value : *least;
                *greatest = value > *greatest ? value : *greatest;
            }
        }
    }
}

/* ---- 2. What all readers need ---------------------------------------------------------------------- */

/* A file in memory; zero bytes follow the last. */
typedef struct volume_file {
    const char    *path;
    unsigned char *data;
    size_t         size;
    char          *error;
} volume_file;

static inline int volume_fail(const volume_file *f, const char *what) {
    return voxels_fail(f->path, what, f->error);
}

/* Are the sides from 1 on, and does their product have any chance to be a number of bytes? */
static inline int volume_check_sides(const volume_file *f, const size_t n[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        if (n[a] < 1 || n[a] > 1 << 20) {
            return volume_fail(f, "each side must be from 1 to 1048576 voxels");
        }
    }
    return (double)n[0] * (double)n[1] * (double)n[2] < 1e15 ? 1 : volume_fail(f, "too many voxels");
}

/* Takes the numbers from the bytes data[at..]: as they are, or compressed. Nothing is read past the file's
   end. */
static inline int volume_take(volume *v, const volume_file *f, size_t at, int compressed) {
    size_t bytes = volume_size(v->type, volume_count(v));
    size_t left = at <= f->size ? f->size - at : 0;
    if (compressed ? bytes / 1040 > left : bytes > left) {      /* deflate makes no more than 1032 bytes of one */
        return volume_fail(f, "the file is too short for the voxels that it promises");
    }
    v->bytes = (unsigned char *)malloc(bytes);
    if (!v->bytes) {
        return volume_fail(f, "out of memory");
    }
    if (!compressed) {
        memcpy(v->bytes, f->data + at, bytes);
        return 1;
    }
    return inflate_all(f->data + at, left, v->bytes, bytes)
               ? 1 : volume_fail(f, "the compressed numbers are damaged, or not as many as promised");
}

/* Takes the numbers from text, parted by blanks. */
static inline int volume_take_text(volume *v, const volume_file *f, size_t at) {
    size_t count = volume_count(v);
    const char *text = (const char *)f->data + (at < f->size ? at : f->size);
    double *numbers;
    size_t i;
    if (count > f->size) {
        return volume_fail(f, "the file is too short for the voxels that it promises");
    }
    numbers = (double *)malloc(count * sizeof *numbers);
    v->bytes = (unsigned char *)numbers;
    for (i = 0; numbers && i < count; i++) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text) {
            return volume_fail(f, "a number expected among the voxels");
        }
        text = end;
    }
    v->type.kind = 'f';
    v->type.bytes = 8;
    i = 1;
    v->big_endian = *(const unsigned char *)&i != 1;
    return numbers ? 1 : volume_fail(f, "out of memory");
}

/* The file that a header names; it has to lie in the header's folder. */
static inline int volume_open_beside(const volume_file *header, const char *name, volume_file *out) {
    char path[4096];
    const char *slash = strrchr(header->path, '/');
    int folder = slash ? (int)(slash - header->path) + 1 : 0;
    int used;
    memset(out, 0, sizeof *out);
    out->path = header->path;
    out->error = header->error;
    name += strncmp(name, "./", 2) == 0 ? 2 : 0;
    if (strchr(name, '/') || strchr(name, '\\') || name[0] == '.' || name[0] == '-') {
        return volume_fail(header, "the numbers' own file must lie beside the header");
    }
    used = snprintf(path, sizeof path, "%.*s%s", folder, header->path, name);
    out->data =
        used > 0 && (size_t)used < sizeof path ? mesh_load_bytes(path, &out->size, header->error) : NULL;
    return out->data != NULL;
}

/* ---- 3. NumPy ---------------------------------------------------------------------------------------- */

static inline int npy_type(const char *text, volume *v) {
    v->big_endian = text[0] == '>';
    v->type.kind = text[1] == 'b' ? 'u' : text[1];
    v->type.bytes = text[2] - '0';
    return strchr("iufb", text[1]) && text[1] && strchr("1248", text[2]) && text[2] && text[3] == '\''
           && (v->type.kind != 'f' || v->type.bytes >= 4);
}

/* An array [z][y][x], as voxelize writes it, or [x][y][z]: the format does not say. */
static inline int npy_read(volume *v, const volume_file *f) {
    char header[4096];
    size_t length;
    size_t start = f->size > 12 && f->data[6] > 1 ? 12 : 10;
    const char *type;
    const char *order;
    const char *shape;
    unsigned long side[3];
    int a;
    if (f->size < 16 || memcmp(f->data, "\x93NUMPY", 6) != 0) {
        return volume_fail(f, "a .npy file begins with \\x93NUMPY");
    }
    length = (size_t)f->data[8] | (size_t)f->data[9] << 8;
    if (length >= sizeof header || start + length > f->size) {
        return volume_fail(f, "the header is cut");
    }
    memcpy(header, f->data + start, length);
    header[length] = 0;
    type = strstr(header, "'descr': '");
    order = strstr(header, "'fortran_order': ");
    shape = strstr(header, "'shape': (");
    if (!type || !order || !shape
        || sscanf(shape + 10, "%lu, %lu, %lu)", &side[0], &side[1], &side[2]) != 3) {
        return volume_fail(f, "an array of three dimensions expected");
    }
    if (!npy_type(type + 10, v)) {
        return volume_fail(f, "an array of bools, integers or floats expected");
    }
    for (a = 0; a < 3; a++) {
        v->n[a] = side[2 - a];
    }
    if (!volume_check_sides(f, v->n)) {
        return 0;
    }
    v->format = "NumPy";
    v->free_order = 1;
    volume_order(v, order[17] != 'T');
    return volume_take(v, f, start + length, 0);
}

/* ---- 4. Bits and bytes without a header ------------------------------------------------------------- */

/* `n` comes from the command line. What the bytes are is told by how many there are: one a voxel, the rows of
   tribox_grid_fill (64-bit words, little-endian), or eight voxels in a byte. */
static inline int raw_read(volume *v, const volume_file *f) {
    size_t count = volume_count(v);
    size_t row = (v->n[0] + 63) / 64 * 64;
    if (!volume_check_sides(f, v->n)) {
        return 0;
    }
    v->format = "raw";
    volume_order(v, 1);
    v->type.kind = 'u';
    v->type.bytes = 1;
    if (f->size != count) {
        v->type.kind = 'l';
        v->type.bytes = 0;
        if (f->size == row * v->n[1] * v->n[2] / 8) {
            v->stride[1] = row;
            v->stride[2] = row * v->n[1];
        } else if (f->size != (count + 7) / 8) {
            return volume_fail(f,
                               "neither a byte nor a bit for each voxel of --dims, nor rows of 64-bit words");
        }
    }
    v->bytes = (unsigned char *)malloc(f->size + 1);
    if (!v->bytes) {
        return volume_fail(f, "out of memory");
    }
    memcpy(v->bytes, f->data, f->size);
    return 1;
}

/* ---- 5. MagicaVoxel ---------------------------------------------------------------------------------- */

/* Where a model stands: the translation of the last transform node before its shape, in a scene that only
   moves. */
typedef struct vox_scan {
    const volume_file *f;
    upright            turn;
    int                lo[3];       /* upright, of all models that were met */
    int                hi[3];
    int                models;
    voxels            *out;         /* the second pass sets bits */
} vox_scan;

static inline int vox_model_at(const vox_scan *s, int number, int place[3]);

/* One voxel of a model, in the scene's upright coordinates. */
static inline void vox_take(vox_scan *s, const int at[3]) {
    size_t mesh_at[3];
    int a;
    for (a = 0; a < 3; a++) {
        int n = s->hi[a] - s->lo[a];
        int i = at[a] - s->lo[a];
        mesh_at[s->turn.axis[a]] = (size_t)(s->turn.flip[a] ? n - 1 - i : i);
    }
    voxels_row(s->out, mesh_at[1], mesh_at[2])[mesh_at[0] >> 6] |= (uint64_t)1 << (mesh_at[0] & 63);
}

/* Walks the chunks: sizes and voxels of the models. */
static inline int vox_walk(vox_scan *s) {
    const unsigned char *d = s->f->data;
    int size[3] = {0, 0, 0};
    int place[3] = {0, 0, 0};
    size_t at = 20;
    size_t i;
    int a;
    s->models = 0;
    while (at + 12 <= s->f->size) {
        size_t bytes = mesh_u32(d + at + 4, 0);
        const unsigned char *content = d + at + 12;
        if (bytes > s->f->size - at - 12) {
            return volume_fail(s->f, "a chunk is longer than the file");
        }
        if (memcmp(d + at, "SIZE", 4) == 0 && bytes >= 12) {
            for (a = 0; a < 3; a++) {
                uint32_t side = mesh_u32(content + 4 * a, 0);
                if (side < 1 || side > 65536) {
                    return volume_fail(s->f, "a model's side must be from 1 to 65536");
                }
                size[a] = (int)side;
            }
            vox_model_at(s, s->models, place);
            for (a = 0; a < 3; a++) {
                place[a] -= size[a] / 2;        /* a model stands by its middle */
                s->lo[a] = s->models == 0 && !s->out ? place[a] : place[a] < s->lo[a] ? place[a] : s->lo[a];
                s->hi[a] = s->models == 0 && !s->out ? place[a] + size[a]
                         : place[a] + size[a] > s->hi[a] ? place[a] + size[a] : s->hi[a];
            }
            s->models += 1;
        }
        if (s->out && memcmp(d + at, "XYZI", 4) == 0 && bytes >= 4) {
            for (i = 4; i + 4 <= bytes; i += 4) {
                int voxel[3];
                for (a = 0; a < 3; a++) {
                    if (content[i + (size_t)a] >= size[a]) {
                        return volume_fail(s->f, "a voxel lies outside of its model");
                    }
                    voxel[a] = place[a] + content[i + (size_t)a];
                }
                vox_take(s, voxel);
            }
        }
        at += 12 + bytes;
    }
    return s->models > 0 ? 1 : volume_fail(s->f, "no model in the file");
}

/* The translation "_t" of the transform node that holds the shape of model `number`; 0,0,0 without a
   scene. */
static inline int vox_model_at(const vox_scan *s, int number, int place[3]) {
    const unsigned char *d = s->f->data;
    int last[3] = {0, 0, 0};
    size_t at = 20;
    memset(place, 0, 3 * sizeof *place);
    for (; at + 12 <= s->f->size; at += 12 + mesh_u32(d + at + 4, 0)) {
        size_t end = at + 12 + mesh_u32(d + at + 4, 0);
        size_t k;
        if (end > s->f->size) {
            return 0;
        }
        if (memcmp(d + at, "nTRN", 4) == 0) {
            memset(last, 0, sizeof last);
            for (k = at + 12; k + 6 <= end; k++) {
                if (memcmp(d + k, "\2\0\0\0_t", 6) == 0) {
                    sscanf((const char *)d + k + 10, "%7d %7d %7d", &last[0], &last[1], &last[2]);
                }
            }
        }
        if (memcmp(d + at, "nSHP", 4) == 0 && end - at >= 32
            && mesh_u32(d + at + 24, 0) == (uint32_t)number) {
            memcpy(place, last, sizeof last);
            return 1;
        }
    }
    return 0;
}

/* Models may lie anywhere, so that few bytes can ask for any number of voxels: 5 GB, rows padded, are enough. */
#ifndef VOX_MOST_BITS
#define VOX_MOST_BITS 4e10
#endif

/* `up` is the mesh's axis that points up, 'x', 'y' or 'z'. */
static inline int vox_read(volume *v, const volume_file *f, char up) {
    tribox_grid grid;
    vox_scan s;
    size_t n[3];
    int a;
    memset(&s, 0, sizeof s);
    s.f = f;
    s.turn = upright_make(up);
    if (f->size < 20 || memcmp(f->data, "VOX ", 4) != 0) {
        return volume_fail(f, "a .vox file begins with 'VOX '");
    }
    if (!vox_walk(&s)) {
        return 0;
    }
    memset(&grid, 0, sizeof grid);
    for (a = 0; a < 3; a++) {
        n[s.turn.axis[a]] = (size_t)((int64_t)s.hi[a] - s.lo[a]);
    }
    if (!volume_check_sides(f, n)) {
        return 0;
    }
    for (a = 0; a < 3; a++) {
        v->n[a] = n[a];
        grid.size[a] = 1;
        grid.hi[a] = (int)n[a];
    }
    if ((double)((n[0] + 63) / 64 * 64) * (double)n[1] * (double)n[2] > VOX_MOST_BITS) {
        return volume_fail(f, "its models are too far apart");
    }
    if (!voxels_make(&v->bits, &grid, f->error)) {
        return 0;
    }
    s.out = &v->bits;
    v->format = "MagicaVoxel";
    return vox_walk(&s);
}

#include "volume_headers.h"

/* ---- 8. Any of them ---------------------------------------------------------------------------------- */

static inline int volume_read_binvox(volume *v, const char *path, char *error) {
    int a;
    if (!binvox_read(path, &v->bits, error)) {
        return 0;
    }
    v->format = "binvox";
    v->placed = VOLUME_CORNER;
    for (a = 0; a < 3; a++) {
        v->n[a] = v->bits.n[a];
        v->origin[a] = v->bits.grid.origin[a];
        v->size[a] = v->bits.grid.size[a];
    }
    return 1;
}

/* A file's bytes, which end with two zero bytes that `size` does not count; `path` names the format, and
   errors. */
static inline int volume_read_memory(volume *v, const char *path, unsigned char *data, size_t size,
                                     const size_t dims[3], char up, char *error) {
    volume_file f;
    int ok;
    memset(v, 0, sizeof *v);
    f.path = path;
    f.data = data;
    f.size = size;
    f.error = error;
    if (dims) {
        memcpy(v->n, dims, sizeof v->n);
        ok = raw_read(v, &f);
    } else if (mesh_name_ends(path, ".npy")) {
        ok = npy_read(v, &f);
    } else if (mesh_name_ends(path, ".nrrd") || mesh_name_ends(path, ".nhdr")) {
        ok = nrrd_read(v, &f);
    } else if (mesh_name_ends(path, ".mha") || mesh_name_ends(path, ".mhd")) {
        ok = mha_read(v, &f);
    } else if (mesh_name_ends(path, ".vti")) {
        ok = vti_read(v, &f);
    } else if (mesh_name_ends(path, ".vox")) {
        ok = vox_read(v, &f, up);
    } else {
        ok = volume_fail(&f,
                         "should end in .binvox, .vox, .npy, .nrrd, .vti or .mha; other files need --dims");
    }
    if (!ok) {
        volume_free(v);
    }
    return ok;
}

/* `dims` are the sides of a file without a header, else NULL; `up` as vox_read's. */
static inline int volume_read(volume *v, const char *path, const size_t dims[3], char up, char *error) {
    unsigned char *data;
    size_t size;
    int ok;
    memset(v, 0, sizeof *v);
    if (!dims && mesh_name_ends(path, ".binvox")) {
        return volume_read_binvox(v, path, error);
    }
    data = mesh_load_bytes(path, &size, error);
    ok = data && volume_read_memory(v, path, data, size, dims, up, error);
    free(data);
    return ok;
}

#endif /* EXAMPLES_VOLUME_H */
