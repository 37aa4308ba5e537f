/* voxel_io.h - voxels to and from files: binvox (both ways), MagicaVoxel .vox, NumPy .npy, .nrrd, VTK .vti, and .obj
 * or .stl of the exposed faces
 *
 * The voxels are the bits of tribox_grid_fill over a tribox_grid. Each writer returns 1, or 0 with a
 * sentence in `error`. A file appears under its name when it is complete, and not before.
 */
#ifndef EXAMPLES_VOXEL_IO_H
#define EXAMPLES_VOXEL_IO_H
#include "mesh_io.h"
#if defined(__unix__) || defined(__APPLE__)
#include <sys/stat.h>
#endif

/* ---- 1. Bits --------------------------------------------------------------------------------- */

typedef struct voxels {
    tribox_grid grid;
    size_t      n[3];           /* hi - lo */
    size_t      row_words;
    size_t      words;
    uint64_t   *bits;
} voxels;

/* Derived sizes and cleared bits for a grid. Returns 1, or 0 if there is no such array. */
static inline int voxels_make(voxels *out, const tribox_grid *grid, char *error) {
    int a;
    out->grid = *grid;
    for (a = 0; a < 3; a++) {
        out->n[a] = (size_t)((int64_t)grid->hi[a] - grid->lo[a]);
    }
    out->row_words = (out->n[0] + 63) / 64;
    out->words = tribox_grid_words(grid);
    out->bits = out->words ? (uint64_t *)calloc(out->words, sizeof *out->bits) : NULL;
    if (!out->bits) {
        snprintf(error, MESH_ERROR, "a grid of %lu x %lu x %lu voxels takes %.1f GB: %s",
                 (unsigned long)out->n[0], (unsigned long)out->n[1], (unsigned long)out->n[2],
                 (double)out->row_words * (double)out->n[1] * (double)out->n[2] * 8e-9,
                 out->words ? "out of memory" : "no array can hold it");
        return 0;
    }
    return 1;
}

static inline void voxels_free(voxels *v) {
    free(v->bits);
    v->bits = NULL;
}

/* The words of a row; y and z count from 0 here, as all indices in this file do. */
static inline uint64_t *voxels_row(const voxels *v, size_t y, size_t z) {
    return v->bits + (z * v->n[1] + y) * v->row_words;
}

static inline int voxels_get(const voxels *v, size_t x, size_t y, size_t z) {
    if (x >= v->n[0] || y >= v->n[1] || z >= v->n[2]) {        /* "-1" is a large number */
        return 0;
    }
    return (int)(voxels_row(v, y, z)[x >> 6] >> (x & 63) & 1);
}

/* Where voxel number i begins on axis a, rounded. */
static inline double voxels_border(const voxels *v, int a, size_t i) {
    return v->grid.origin[a] + ((double)v->grid.lo[a] + (double)i) * v->grid.size[a];
}

static inline int voxels_ones(uint64_t word) {
    int count = 0;
    while (word) {
        word &= word - 1;
        count += 1;
    }
    return count;
}

/* The lowest bit's place in a word that isn't 0. */
static inline size_t voxels_lowest(uint64_t word) {
#if defined(__GNUC__)
    return (size_t)__builtin_ctzll(word);
#else
    size_t at = 0;
    for (; !(word & 1); word >>= 1) {
        at += 1;
    }
    return at;
#endif
}

static inline size_t voxels_count(const voxels *v) {
    size_t count = 0;
    size_t i;
    for (i = 0; i < v->words; i++) {
        count += (size_t)voxels_ones(v->bits[i]);
    }
    return count;
}

/* Which mesh axis points up. Pictures and MagicaVoxel have z up: upright axis a is mesh axis axis[a],
   turned if flip[a]. */
typedef struct upright {
    int axis[3];
    int flip[3];
} upright;

static inline upright upright_make(char up) {
    static const upright x_up = {{1, 2, 0}, {0, 0, 0}};
    static const upright y_up = {{0, 2, 1}, {0, 1, 0}};
    static const upright z_up = {{0, 1, 2}, {0, 0, 0}};
    return up == 'x' ? x_up : up == 'y' ? y_up : z_up;
}

/* ---- 2. Files -------------------------------------------------------------------------------- */

static inline int voxels_fail(const char *path, const char *what, char *error) {
    snprintf(error, MESH_ERROR, "%.200s: %.200s", path, what);
    return 0;
}

/* A name beside the target for what is being written. Returns 0 if the target is no file to be replaced: "-" is the
   standard output, and a device takes what comes. */
static inline int voxels_part(const char *path, char *out, size_t room) {
    int used = snprintf(out, room, "%s.part", path);
    return used > 0 && (size_t)used < room && strcmp(path, "-") != 0 && strncmp(path, "/dev/", 5) != 0;
}

static inline FILE *voxels_create(const char *path, char *error) {
    char part[4096];
    FILE *file;
    errno = 0;
    if (strcmp(path, "-") == 0) {
#if defined(_WIN32)
        _setmode(_fileno(stdout), _O_BINARY);
#endif
        return stdout;
    }
    file = fopen(voxels_part(path, part, sizeof part) ? part : path, "wb");
    if (!file) {
        voxels_fail(path, errno ? strerror(errno) : "cannot be written", error);
    }
    return file;
}

/* A full disk shows at the latest when the file is closed. Then, and only then, it gets its name. */
static inline int voxels_close(FILE *file, const char *path, char *error) {
    char part[4096];
    int replace = voxels_part(path, part, sizeof part);
    int bad = fflush(file) != 0 || ferror(file);
    int cause = errno;
    bad = (file == stdout ? 0 : fclose(file) != 0) || bad;
    if (bad) {
        cause = cause ? cause : errno;
        if (replace) {
            remove(part);
        }
        return voxels_fail(path, cause ? strerror(cause) : "write error", error);
    }
#if defined(_WIN32)
    remove(path);       /* rename does not replace there */
#endif
    if (replace && rename(part, path) != 0) {
        cause = errno;
        remove(part);
        return voxels_fail(path, strerror(cause), error);
    }
    return 1;
}

/* Are these two names of one file? */
static inline int voxels_same_file(const char *path, const char *other) {
#if defined(__unix__) || defined(__APPLE__)
    struct stat a;
    struct stat b;
    if (stat(path, &a) == 0 && stat(other, &b) == 0) {
        return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
    }
#endif
    return strcmp(path, other) == 0;
}

/* Can the file be written? Asked before any work: a folder that is not there, or may not be written; the mesh that is
 * read, by whatever name. */
static inline int voxels_check(const char *path, const char *mesh_path, char *error) {
    char part[4096];
    FILE *file;
    if (strcmp(path, "-") != 0 && voxels_same_file(path, mesh_path)) {
        return voxels_fail(path, "this is the mesh: it would be overwritten", error);
    }
    if (!voxels_part(path, part, sizeof part)) {
        return 1;
    }
    file = fopen(path, "rb");       /* a folder can be opened, but not read */
    if (file) {
        int is_folder = fgetc(file) == EOF && ferror(file);
        fclose(file);
        if (is_folder) {
            return voxels_fail(path, "this is a folder", error);
        }
    }
    errno = 0;
    file = fopen(part, "wb");
    if (!file) {
        return voxels_fail(path, errno ? strerror(errno) : "cannot be written", error);
    }
    fclose(file);
    remove(part);
    return 1;
}

/* ---- 3. binvox ------------------------------------------------------------------------------- */

/* binvox: text header, then pairs (value, count) of bytes; y runs fastest, then z, then x. Voxel (i,j,k)
   of the cube with d voxels a side is translate + (i,j,k) * scale / d. */
typedef struct binvox_run {
    FILE    *file;
    int      value;
    uint64_t length;
} binvox_run;

static inline void binvox_flush(binvox_run *run) {
    while (run->length > 0) {
        int count = run->length < 255 ? (int)run->length : 255;
        fputc(run->value, run->file);
        fputc(count, run->file);
        run->length -= (uint64_t)count;
    }
}

static inline void binvox_add(binvox_run *run, int value, uint64_t count) {
    if (value != run->value) {
        binvox_flush(run);
        run->value = value;
    }
    run->length += count;
}

/* The cube's side: all readers take cubes, and scale / d must give back the voxel's size exactly. */
static inline size_t binvox_side(const voxels *v) {
    size_t d = v->n[0] > v->n[1] ? v->n[0] : v->n[1];
    size_t least = d > v->n[2] ? d : v->n[2];
    double size = v->grid.size[0];
    for (d = least; d < least + 64; d++) {
        volatile double scale = size * (double)d;      /* rounded to double also on x87 */
        volatile double again = scale / (double)d;
        if (again == size) {
            return d;
        }
    }
    return least;
}

static inline int binvox_write(const char *path, const voxels *v, char *error) {
    size_t d = binvox_side(v);
    uint64_t *column = (uint64_t *)malloc(v->n[1] * v->n[2] * sizeof *column);
    FILE *file = column ? voxels_create(path, error) : NULL;
    binvox_run run;
    size_t x;
    size_t y;
    size_t z;
    if (!column) {
        return voxels_fail(path, "out of memory", error);
    }
    if (!file) {
        free(column);
        return 0;
    }
    run.file = file;
    run.value = 0;
    run.length = 0;
    fprintf(file, "#binvox 1\ndim %lu %lu %lu\n", (unsigned long)d, (unsigned long)d, (unsigned long)d);
    fprintf(file, "translate %.17g %.17g %.17g\n", voxels_border(v, 0, 0), voxels_border(v, 1, 0),
            voxels_border(v, 2, 0));
    fprintf(file, "scale %.17g\ndata\n", v->grid.size[0] * (double)d);
    for (x = 0; x < v->n[0]; x++) {
        for (z = 0; z < v->n[2]; z++) {
            for (y = 0; y < v->n[1]; y++) {
                size_t at = z * v->n[1] + y;
                if (x % 64 == 0) {      /* x is the slowest: 64 layers at once are copied out of the rows */
                    column[at] = v->bits[at * v->row_words + x / 64];
                }
                binvox_add(&run, (int)(column[at] >> (x & 63) & 1), 1);
            }
            binvox_add(&run, 0, d - v->n[1]);
        }
        binvox_add(&run, 0, (uint64_t)(d - v->n[2]) * d);
    }
    binvox_add(&run, 0, (uint64_t)(d - v->n[0]) * d * d);
    binvox_flush(&run);
    free(column);
    return voxels_close(file, path, error);
}

static inline int binvox_read_header(mesh_reader *r, size_t dim[3], double translate[3], double *scale) {
    mesh_word word;
    int seen = 0;
    int a;
    if (!mesh_next_word(r, &word) || !mesh_word_is(word, "#binvox")) {
        return mesh_fail_at(r, 1, "a binvox file begins with '#binvox 1'");
    }
    while (mesh_next_line(r)) {
        mesh_next_word(r, &word);
        if (mesh_word_is(word, "data")) {
            mesh_next_line(r);
            return seen & 1 ? 1 : mesh_fail_at(r, r->line, "the header has no dim line");
        }
        if (mesh_word_is(word, "dim")) {
            for (a = 0; a < 3; a++) {
                int64_t value;
                mesh_next_word(r, &word);
                if (mesh_word_integer(word, &value) != word.length || word.length == 0 || value < 1
                    || value > 1 << 20) {
                    return mesh_fail_word(r, word, "dimension from 1 to 1048576");
                }
                dim[a == 0 ? 0 : 3 - a] = (size_t)value;       /* in the file: x, z, y */
            }
            seen |= 1;
        } else if (mesh_word_is(word, "translate") || mesh_word_is(word, "scale")) {
            int is_scale = mesh_word_is(word, "scale");
            for (a = 0; a < (is_scale ? 1 : 3); a++) {
                mesh_next_word(r, &word);
                if (!mesh_word_double(r, word, is_scale ? scale : &translate[a])) {
                    return 0;
                }
            }
        }
    }
    return mesh_fail_at(r, r->line, "a line 'data' expected, found the end of the file");
}

/* Sets `count` voxels from `at` on in the file's order. */
static inline void binvox_set(voxels *v, uint64_t at, size_t count) {
    for (; count > 0; count--, at++) {
        size_t y = (size_t)(at % v->n[1]);
        size_t z = (size_t)(at / v->n[1] % v->n[2]);
        size_t x = (size_t)(at / v->n[1] / v->n[2]);
        voxels_row(v, y, z)[x >> 6] |= (uint64_t)1 << (x & 63);
    }
}

static inline int binvox_read_runs(mesh_reader *r, voxels *v) {
    uint64_t total = (uint64_t)v->n[0] * v->n[1] * v->n[2];
    uint64_t at = 0;
    for (; r->at + 1 < r->size && at < total; r->at += 2) {
        size_t count = r->data[r->at + 1];
        if (count > total - at) {
            return mesh_fail_at(r, r->at, "a run of %lu voxels, but %lu are left", (unsigned long)count,
                                (unsigned long)(total - at));
        }
        if (r->data[r->at] > 1) {
            return mesh_fail_at(r, r->at, "a voxel is 0 or 1, not %d", r->data[r->at]);
        }
        if (r->data[r->at] == 1) {
            binvox_set(v, at, count);
        }
        at += count;
    }
    return at == total ? 1 : mesh_fail_at(r, r->at, "the file ends after %lu of %lu voxels",
                                          (unsigned long)at, (unsigned long)total);
}

static inline int binvox_parse(mesh_reader *r, voxels *v, char *error) {
    tribox_grid grid;
    size_t dim[3] = {0, 0, 0};
    double translate[3] = {0, 0, 0};
    double scale = 1;
    double promised;
    size_t longest;
    int a;
    if (!binvox_read_header(r, dim, translate, &scale)) {
        return 0;
    }
    r->binary = 1;
    promised = (double)dim[0] * (double)dim[1] * (double)dim[2];
    if (promised > 127.5 * (double)(r->size - r->at)) {
        return mesh_fail_at(r, r->at, "%.0f voxels promised, but the %lu bytes left hold no more than %.0f",
                            promised, (unsigned long)(r->size - r->at), 127.5 * (double)(r->size - r->at));
    }
    longest = dim[0] > dim[1] ? dim[0] : dim[1];
    longest = longest > dim[2] ? longest : dim[2];
    for (a = 0; a < 3; a++) {
        grid.origin[a] = translate[a];
        grid.size[a] = scale / (double)longest;
        grid.lo[a] = 0;
        grid.hi[a] = (int)dim[a];
        if (!(fabs(translate[a]) < HUGE_VAL) || !(grid.size[a] > 0 && grid.size[a] < HUGE_VAL)) {
            return mesh_fail_file(r, "translate and scale must be finite, scale above 0");
        }
    }
    grid.flags = 0;
    return voxels_make(v, &grid, error) && binvox_read_runs(r, v);
}

/* Reads a binvox file. Returns 1, or 0 with a sentence in `error` and nothing to free. */
static inline int binvox_read(const char *path, voxels *out, char *error) {
    mesh_reader r;
    unsigned char *bytes;
    int ok;
    memset(&r, 0, sizeof r);
    memset(out, 0, sizeof *out);
    r.path = path;
    r.error = error;
    r.line = 1;
    bytes = mesh_load_bytes(path, &r.size, error);
    if (!bytes) {
        return 0;
    }
    r.data = bytes;
    ok = binvox_parse(&r, out, error);
    free(bytes);
    if (!ok) {
        voxels_free(out);
    }
    return ok;
}

/* ---- 4. MagicaVoxel .vox --------------------------------------------------------------------- */

/* Of the largest model. Bigger grids become several models, placed by a scene graph: all of even size, so that
 * readers that centre a model by half its size, and those that round that down, agree. Places beyond VOX_FAR are
 * not shown by MagicaVoxel. */
enum { VOX_SIDE = 256, VOX_FAR = 1000 };

typedef struct vox_model {
    size_t lo[3];               /* upright */
    size_t n[3];
    size_t room[3];             /* its size in the file */
    size_t count;
} vox_model;

typedef struct vox_file {
    FILE         *file;
    const voxels *v;
    upright       turn;
    size_t        n[3];         /* upright */
    vox_model    *models;
    size_t        model_count;
    const unsigned char *index;     /* of each voxel's colour in the palette, from 1, x fastest; NULL: by height */
    const uint32_t *palette;        /* 255 of 0xrrggbb */
} vox_file;

static inline void vox_int(FILE *file, size_t value) {
    int i;
    for (i = 0; i < 4; i++) {
        fputc((int)(value >> (8 * i) & 255), file);
    }
}

static inline void vox_chunk(FILE *file, const char *name, size_t content, size_t children) {
    fputs(name, file);
    vox_int(file, content);
    vox_int(file, children);
}

/* Counts the model's voxels, or writes them where `file` is not NULL: x, y, z and a colour that climbs
   with z. */
static inline size_t vox_visit(const vox_file *f, const vox_model *model, FILE *file) {
    size_t lo[3];
    size_t hi[3];
    size_t at[3];
    size_t count = 0;
    int a;
    for (a = 0; a < 3; a++) {
        int axis = f->turn.axis[a];
        lo[axis] = f->turn.flip[a] ? f->n[a] - model->lo[a] - model->n[a] : model->lo[a];
        hi[axis] = lo[axis] + model->n[a];
    }
    for (at[2] = lo[2]; at[2] < hi[2]; at[2]++) {
        for (at[1] = lo[1]; at[1] < hi[1]; at[1]++) {
            const uint64_t *row = voxels_row(f->v, at[1], at[2]);
            for (at[0] = lo[0]; at[0] < hi[0]; at[0]++) {
                uint64_t rest = row[at[0] >> 6] >> (at[0] & 63);
                if (rest == 0) {
                    at[0] |= 63;        /* on to the next word */
                    continue;
                }
                at[0] += voxels_lowest(rest);
                if (at[0] >= hi[0]) {
                    break;
                }
                count += 1;
                for (a = 0; file && a < 3; a++) {
                    size_t place = at[f->turn.axis[a]];
                    place = f->turn.flip[a] ? f->n[a] - 1 - place : place;
                    fputc((int)(place - model->lo[a]), file);
                    if (a == 2) {
                        fputc(f->index ? f->index[(at[2] * f->v->n[1] + at[1]) * f->v->n[0] + at[0]]
                                       : (int)(1 + place * 254 / f->n[2]), file);
                    }
                }
            }
        }
    }
    return count;
}

/* Cuts the grid into models and counts; empty ones are dropped. */
static inline int vox_cut(vox_file *f) {
    size_t parts[3];
    size_t i;
    int a;
    for (a = 0; a < 3; a++) {
        f->n[a] = f->v->n[f->turn.axis[a]];
        parts[a] = (f->n[a] + VOX_SIDE - 1) / VOX_SIDE;
    }
    f->model_count = 0;
    f->models = (vox_model *)malloc(parts[0] * parts[1] * parts[2] * sizeof *f->models);
    for (i = 0; f->models && i < parts[0] * parts[1] * parts[2]; i++) {
        vox_model *model = &f->models[f->model_count];
        model->lo[0] = i % parts[0] * VOX_SIDE;
        model->lo[1] = i / parts[0] % parts[1] * VOX_SIDE;
        model->lo[2] = i / parts[0] / parts[1] * VOX_SIDE;
        for (a = 0; a < 3; a++) {
            size_t rest = f->n[a] - model->lo[a];
            model->n[a] = rest < VOX_SIDE ? rest : VOX_SIDE;
            model->room[a] = model->n[a];
            if (parts[0] * parts[1] * parts[2] > 1) {
                model->room[a] += model->n[a] % 2;      /* one layer stays empty */
            }
        }
        model->count = vox_visit(f, model, NULL);
        f->model_count += model->count > 0 ? 1 : 0;
    }
    return f->models != NULL;
}

/* Does a part of the scene lie where it is not shown? The height counts if it stands on the ground. */
static inline int vox_is_far(const vox_file *f) {
    return f->n[0] / 2 > VOX_FAR || f->n[1] / 2 > VOX_FAR || f->n[2] > VOX_FAR;
}

/* A model's place is that of its middle; the whole stands centred on the ground, or if it is higher than VOX_FAR
   around 0. */
static inline int vox_place(const vox_file *f, const vox_model *model, char text[64]) {
    long at[3];
    int a;
    for (a = 0; a < 3; a++) {
        int centred = a < 2 || f->n[2] > VOX_FAR;
        at[a] = (long)(model->lo[a] + model->room[a] / 2) - (centred ? (long)(f->n[a] / 2) : 0);
    }
    return snprintf(text, 64, "%ld %ld %ld", at[0], at[1], at[2]);
}

/* A transform node with an empty name, its child, and in its single frame a translation, if any. */
static inline void vox_transform(FILE *file, size_t node, size_t child, size_t layer, const char *place) {
    size_t length = strlen(place);
    vox_chunk(file, "nTRN", 28 + (length ? 10 + length : 0), 0);
    vox_int(file, node);
    vox_int(file, 0);
    vox_int(file, child);
    vox_int(file, (size_t)-1);
    vox_int(file, layer);
    vox_int(file, 1);
    vox_int(file, length ? 1 : 0);
    if (length) {
        vox_int(file, 2);
        fputs("_t", file);
        vox_int(file, length);
        fputs(place, file);
    }
}

/* Node 0 moves nothing, node 1 groups, nodes 2 + 2i place the shapes 3 + 2i. */
static inline void vox_scene(const vox_file *f) {
    char place[64];
    size_t i;
    vox_transform(f->file, 0, 1, (size_t)-1, "");
    vox_chunk(f->file, "nGRP", 12 + 4 * f->model_count, 0);
    vox_int(f->file, 1);
    vox_int(f->file, 0);
    vox_int(f->file, f->model_count);
    for (i = 0; i < f->model_count; i++) {
        vox_int(f->file, 2 + 2 * i);
    }
    for (i = 0; i < f->model_count; i++) {
        vox_place(f, &f->models[i], place);
        vox_transform(f->file, 2 + 2 * i, 3 + 2 * i, 0, place);
        vox_chunk(f->file, "nSHP", 20, 0);
        vox_int(f->file, 3 + 2 * i);
        vox_int(f->file, 0);
        vox_int(f->file, 1);
        vox_int(f->file, i);
        vox_int(f->file, 0);
    }
}

/* The palette given, or colours from deep blue at the foot over green to sand at the top. */
static inline void vox_palette(const vox_file *f) {
    static const double stops[4][3] = {{38, 70, 120}, {42, 157, 143}, {233, 196, 106}, {244, 240, 225}};
    FILE *file = f->file;
    int i;
    int a;
    vox_chunk(file, "RGBA", 1024, 0);
    for (i = 0; i < 256; i++) {
        double at = i < 254 ? 3 * i / 254.0 : 2.999;
        int stop = (int)at;
        for (a = 0; a < 3; a++) {
            fputc(f->palette ? (int)(f->palette[i < 255 ? i : 254] >> (16 - 8 * a) & 255) : (int)(stops[stop][a] + (at - stop) * (stops[stop + 1][a] - stops[stop][a])), file);
        }
        fputc(255, file);
    }
}

static inline double vox_bytes(const vox_file *f) {
    double bytes = 12 + 1024;
    char place[64];
    size_t i;
    if (f->model_count > 1) {
        bytes += 12 + 28 + 12 + 12;
    }
    for (i = 0; i < f->model_count; i++) {
        bytes += 12 + 12 + 12 + 4 + 4 * (double)f->models[i].count;
        if (f->model_count == 1) {
            break;
        }
        bytes += 4 + 12 + 28 + 10 + vox_place(f, &f->models[i], place) + 12 + 20;
    }
    return bytes;
}

static inline int vox_write_models(vox_file *f, const char *path, char *error) {
    double bytes = vox_bytes(f);
    size_t i;
    if (bytes > 2147483647) {
        return voxels_fail(path, "a .vox file holds no more than 2 GB, about 500 million voxels", error);
    }
    f->file = voxels_create(path, error);
    if (!f->file) {
        return 0;
    }
    fputs("VOX ", f->file);
    vox_int(f->file, 150);
    vox_chunk(f->file, "MAIN", 0, (size_t)bytes);
    for (i = 0; i < f->model_count; i++) {
        const vox_model *model = &f->models[i];
        vox_chunk(f->file, "SIZE", 12, 0);
        vox_int(f->file, model->room[0]);
        vox_int(f->file, model->room[1]);
        vox_int(f->file, model->room[2]);
        vox_chunk(f->file, "XYZI", 4 + 4 * model->count, 0);
        vox_int(f->file, model->count);
        vox_visit(f, model, f->file);
    }
    if (f->model_count > 1) {       /* one model needs no scene */
        vox_scene(f);
    }
    vox_palette(f);
    return voxels_close(f->file, path, error);
}

/* `index` and `palette` as in vox_file, or NULL for colours by height. */
static inline int vox_write_coloured(const char *path, const voxels *v, upright turn, const unsigned char *index,
                                     const uint32_t *palette, char *error) {
    vox_file f;
    int ok;
    memset(&f, 0, sizeof f);
    f.v = v;
    f.turn = turn;
    f.index = index;
    f.palette = palette;
    ok = vox_cut(&f);
    if (ok && vox_is_far(&f)) {
        fprintf(stderr, "warning: %.200s: the scene reaches beyond %d voxels from its middle, where MagicaVoxel shows "
                        "nothing; it is placed around 0\n", path, VOX_FAR);
    }
    ok = ok ? vox_write_models(&f, path, error) : voxels_fail(path, "out of memory", error);
    free(f.models);
    return ok;
}

static inline int vox_write(const char *path, const voxels *v, upright turn, char *error) {
    return vox_write_coloured(path, v, turn, NULL, NULL, error);
}

/* ---- 5. OBJ of the exposed faces ------------------------------------------------------------- */

/* Corners are numbered from 1 as they are met; only two layers of corners are alive at a time. */
typedef struct faces {
    FILE         *file;
    const voxels *v;
    int           print_corners;        /* the first of two equal walks; the second prints the faces */
    uint32_t     *number[2];            /* of the corners below and above the layer; 0: not met yet */
    size_t        corners;
    size_t        quads;
} faces;

static inline size_t faces_corner(faces *f, const size_t at[3], size_t layer) {
    uint32_t *number = f->number[at[2] - layer] + at[1] * (f->v->n[0] + 1) + at[0];
    if (*number == 0) {
        f->corners += 1;
        *number = (uint32_t)f->corners;
        if (f->print_corners) {
            fprintf(f->file, "v %.9g %.9g %.9g\n", voxels_border(f->v, 0, at[0]),
                    voxels_border(f->v, 1, at[1]), voxels_border(f->v, 2, at[2]));
        }
    }
    return *number;
}

/* The face of a voxel on the given side (0 or 1) of axis a, counterclockwise from outside. */
static inline void faces_quad(faces *f, const size_t voxel[3], int a, int side) {
    static const int walk[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    size_t corner[4];
    int i;
    for (i = 0; i < 4; i++) {
        size_t at[3];
        at[a] = voxel[a] + (size_t)side;
        at[(a + 1) % 3] = voxel[(a + 1) % 3] + (size_t)walk[i][side ? 0 : 1];
        at[(a + 2) % 3] = voxel[(a + 2) % 3] + (size_t)walk[i][side ? 1 : 0];
        corner[i] = faces_corner(f, at, voxel[2]);
    }
    f->quads += 1;
    if (!f->print_corners) {
        fprintf(f->file, "f %lu %lu %lu %lu\n", (unsigned long)corner[0], (unsigned long)corner[1],
                (unsigned long)corner[2], (unsigned long)corner[3]);
    }
}

static inline void faces_walk(faces *f) {
    size_t plane = (f->v->n[0] + 1) * (f->v->n[1] + 1) * sizeof(uint32_t);
    size_t at[3];
    int a;
    f->corners = 0;
    f->quads = 0;
    memset(f->number[1], 0, plane);
    for (at[2] = 0; at[2] < f->v->n[2]; at[2]++) {
        uint32_t *below = f->number[0];
        f->number[0] = f->number[1];
        f->number[1] = below;
        memset(below, 0, plane);
        for (at[1] = 0; at[1] < f->v->n[1]; at[1]++) {
            for (at[0] = 0; at[0] < f->v->n[0]; at[0]++) {
                if (!voxels_get(f->v, at[0], at[1], at[2])) {
                    continue;
                }
                for (a = 0; a < 3; a++) {
                    size_t next[3];
                    memcpy(next, at, sizeof next);
                    next[a] = at[a] - 1;
                    if (!voxels_get(f->v, next[0], next[1], next[2])) {
                        faces_quad(f, at, a, 0);
                    }
                    next[a] = at[a] + 1;
                    if (!voxels_get(f->v, next[0], next[1], next[2])) {
                        faces_quad(f, at, a, 1);
                    }
                }
            }
        }
    }
}

static inline int faces_write(const char *path, const voxels *v, char *error) {
    size_t plane = (v->n[0] + 1) * (v->n[1] + 1) * sizeof(uint32_t);
    uint32_t *numbers = (uint32_t *)malloc(2 * plane);
    faces f;
    if (!numbers) {
        return voxels_fail(path, "out of memory", error);
    }
    memset(&f, 0, sizeof f);
    f.v = v;
    f.number[0] = numbers;
    f.number[1] = numbers + plane / sizeof *numbers;
    f.file = voxels_create(path, error);
    if (f.file) {
        f.print_corners = 1;
        fputs("# exposed faces of the voxels\n", f.file);
        faces_walk(&f);
        f.print_corners = 0;
        faces_walk(&f);
    }
    free(numbers);
    return f.file ? voxels_close(f.file, path, error) : 0;
}

/* ---- 6. STL of the exposed faces --------------------------------------------------------------- */

static inline void stl_u32(FILE *file, uint32_t value) {
    int i;
    for (i = 0; i < 4; i++) {
        fputc((int)(value >> (8 * i) & 255), file);
    }
}

static inline void stl_corner(FILE *file, const voxels *v, const size_t at[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        float x = (float)voxels_border(v, a, at[a]);
        uint32_t bits;
        memcpy(&bits, &x, sizeof bits);
        stl_u32(file, bits);
    }
}

/* The face of a voxel on the given side of axis a, as two triangles, counterclockwise from outside. */
static inline void stl_quad(FILE *file, const voxels *v, const size_t voxel[3], int a, int side) {
    static const int walk[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    int i;
    int k;
    for (i = 0; i < 6; i++) {
        size_t at[3];
        for (k = 0; i % 3 == 0 && k < 3; k++) {
            stl_u32(file, k == a ? (side ? 0x3f800000u : 0xbf800000u) : 0);
        }
        at[a] = voxel[a] + (size_t)side;
        at[(a + 1) % 3] = voxel[(a + 1) % 3] + (size_t)walk[i][side ? 0 : 1];
        at[(a + 2) % 3] = voxel[(a + 2) % 3] + (size_t)walk[i][side ? 1 : 0];
        stl_corner(file, v, at);
        if (i % 3 == 2) {
            fputc(0, file);
            fputc(0, file);
        }
    }
}

/* Writes the exposed faces where `file` is not NULL. Returns how many there are. */
static inline size_t stl_walk(FILE *file, const voxels *v) {
    size_t at[3];
    size_t count = 0;
    int a;
    int side;
    for (at[2] = 0; at[2] < v->n[2]; at[2]++) {
        for (at[1] = 0; at[1] < v->n[1]; at[1]++) {
            for (at[0] = 0; at[0] < v->n[0]; at[0]++) {
                if (!voxels_get(v, at[0], at[1], at[2])) {
                    continue;
                }
                for (a = 0; a < 3; a++) {
                    for (side = 0; side < 2; side++) {
                        size_t next[3];
                        memcpy(next, at, sizeof next);
                        next[a] = side ? at[a] + 1 : at[a] - 1;
                        if (!voxels_get(v, next[0], next[1], next[2])) {
                            count += 1;
                            if (file) {
                                stl_quad(file, v, at, a, side);
                            }
                        }
                    }
                }
            }
        }
    }
    return count;
}

static inline int stl_write(const char *path, const voxels *v, char *error) {
    size_t quads = stl_walk(NULL, v);
    FILE *file;
    if (quads > UINT32_MAX / 2) {
        return voxels_fail(path, "more faces than an STL file can count", error);
    }
    file = voxels_create(path, error);
    if (!file) {
        return 0;
    }
    fprintf(file, "%-80s", "exposed faces of voxels");
    stl_u32(file, (uint32_t)(2 * quads));
    stl_walk(file, v);
    return voxels_close(file, path, error);
}

/* ---- 7. Arrays: a byte a voxel, x fastest, then y, then z -------------------------------------- */

static inline void array_bytes(FILE *file, const voxels *v) {
    size_t x;
    size_t y;
    size_t z;
    for (z = 0; z < v->n[2]; z++) {
        for (y = 0; y < v->n[1]; y++) {
            const uint64_t *row = voxels_row(v, y, z);
            for (x = 0; x < v->n[0]; x++) {
                fputc((int)(row[x >> 6] >> (x & 63) & 1), file);
            }
        }
    }
}

/* NumPy: an array of bool, indexed [z][y][x]. */
static inline int npy_write(const char *path, const voxels *v, char *error) {
    char header[128];
    FILE *file = voxels_create(path, error);
    int used;
    if (!file) {
        return 0;
    }
    used = snprintf(header, sizeof header, "{'descr': '|b1', 'fortran_order': False, 'shape': (%lu, %lu, %lu), }",
                    (unsigned long)v->n[2], (unsigned long)v->n[1], (unsigned long)v->n[0]);
    fwrite("\x93NUMPY\x01\x00\x76\x00", 1, 10, file);       /* version 1, 118 bytes of header: 128 in all */
    fprintf(file, "%s%*s\n", header, 117 - used, "");
    array_bytes(file, v);
    return voxels_close(file, path, error);
}

/* NRRD: its origin is the middle of the first voxel. */
static inline int nrrd_write(const char *path, const voxels *v, char *error) {
    const double *size = v->grid.size;
    FILE *file = voxels_create(path, error);
    if (!file) {
        return 0;
    }
    fprintf(file, "NRRD0004\n# voxels that the mesh touches\ntype: uint8\ndimension: 3\nsizes: %lu %lu %lu\n",
            (unsigned long)v->n[0], (unsigned long)v->n[1], (unsigned long)v->n[2]);
    fprintf(file, "encoding: raw\nspace dimension: 3\ncenterings: cell cell cell\nkinds: domain domain domain\n");
    fprintf(file, "space directions: (%.17g,0,0) (0,%.17g,0) (0,0,%.17g)\n", size[0], size[1], size[2]);
    fprintf(file, "space origin: (%.17g,%.17g,%.17g)\n\n", voxels_border(v, 0, 0) + 0.5 * size[0],
            voxels_border(v, 1, 0) + 0.5 * size[1], voxels_border(v, 2, 0) + 0.5 * size[2]);
    array_bytes(file, v);
    return voxels_close(file, path, error);
}

/* VTK image data: a cell for each voxel. */
static inline int vti_write(const char *path, const voxels *v, char *error) {
    const double *size = v->grid.size;
    const uint64_t bytes = (uint64_t)v->n[0] * v->n[1] * v->n[2];
    FILE *file = voxels_create(path, error);
    int i;
    if (!file) {
        return 0;
    }
    fprintf(file, "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                  "header_type=\"UInt64\">\n");
    fprintf(file, "  <ImageData WholeExtent=\"0 %lu 0 %lu 0 %lu\" Origin=\"%.17g %.17g %.17g\" "
                  "Spacing=\"%.17g %.17g %.17g\">\n", (unsigned long)v->n[0], (unsigned long)v->n[1],
            (unsigned long)v->n[2], voxels_border(v, 0, 0), voxels_border(v, 1, 0), voxels_border(v, 2, 0), size[0],
            size[1], size[2]);
    fprintf(file, "    <Piece Extent=\"0 %lu 0 %lu 0 %lu\">\n      <CellData Scalars=\"set\">\n", (unsigned long)v->n[0],
            (unsigned long)v->n[1], (unsigned long)v->n[2]);
    fprintf(file, "        <DataArray type=\"UInt8\" Name=\"set\" format=\"appended\" offset=\"0\"/>\n"
                  "      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_");
    for (i = 0; i < 8; i++) {
        fputc((int)(bytes >> (8 * i) & 255), file);
    }
    array_bytes(file, v);
    fprintf(file, "\n  </AppendedData>\n</VTKFile>\n");
    return voxels_close(file, path, error);
}

#endif /* EXAMPLES_VOXEL_IO_H */
