/* Whatever a mesh file holds, the readers and the programs behind them neither crash nor overrun nor take more
 * memory than a small multiple of its size: small files of every format, damaged in thousands of ways, always the
 * same ones. For the sanitizers:
 *
 *   make mesh-mutants MUTANT_MESHES=10000
 *
 * build/mutated_meshes COUNT FOLDER; with a third argument only the mutant of that number, whose file stays in
 * FOLDER.
 */
#include "examples/mesh_stats.h"
#include "examples/solid_parts.h"
#include "tests/test.h"

enum { SEEDS = 24, MOST = 8192, MOST_BITS = 1 << 16 };

typedef struct file {
    const char   *name;
    size_t        size;
    unsigned char bytes[MOST];
} file;

static file seed[SEEDS];
static int seeds;
static uint64_t state;

static uint32_t pick(uint32_t below) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (uint32_t)((state * 0x2545f4914f6cdd1du) >> 32) % below;
}

/* ---- 1. The whole files: a pyramid, in every format and dialect ----------------------------------- */

static file *begin(const char *name) {
    seed[seeds].name = name;
    seeds += 1;
    return &seed[seeds - 1];
}

static void put(file *f, const void *bytes, size_t size) {
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

static void put_text(file *f, const char *text) {
    put(f, text, strlen(text));
}

static void put_number(file *f, uint64_t bits, int size, int big) {
    int i;
    for (i = 0; i < size; i++) {
        unsigned char byte = (unsigned char)(bits >> 8 * (big ? size - 1 - i : i));
        put(f, &byte, 1);
    }
}

static void put_float(file *f, float x, int big) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    put_number(f, bits, 4, big);
}

static void put_double(file *f, double x, int big) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    put_number(f, bits, 8, big);
}

static const float corner[5][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 2}};
static const int side[6][3] = {{3, 2, 1}, {3, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

static void make_obj(void) {
    file *f = begin("a.obj");
    put_text(f, "mtllib a.mtl\n# a comment\nv 0 0 0\nv 2 0 0\nv 2 2 0 1.0\nv 0 2 0\nv 1 1 2\nvt 0 0\nvn 0 0 1\n"
                "o pyramid\nusemtl red one\nf 4 3 2 1\nf 1/1 2/1 5/1\nusemtl blue\nf 2//1 3//1 5//1\nf 3/1/1 4/1/1 5/1/1\n"
                "f 4 1 5 # the last\n");
    f = begin("a.obj");
    put_text(f, "v 0 0 0 1 0 0\r\nv 2.5e0 0 0 0 1 0\r\nv 2 \\\r\n 2 0\r\nv 0 2\r\nv 5411932.7 1.#QNAN 3.1+e2\r\n"
                "f -2 -3 \\\r\n -4 -5\r\nf -5 -4 -1\r\n");
    f = begin("a.obj");
    put_text(f, "v 0 0 .5\nv 8 0 .5\nv 8 8 .5\nv 0 8 .5\nv 0 0 .5\nv 2 2 .5\nv 2 6 .5\nv 6 6 .5\nv 6 2 .5\nv 2 2 .5\n"
                "f 1 2 3 4 5 6 7 8 9 10\nf 1 2 9 8 3 4\nf 1 3 2 4\nf 1 1 1 1 1\n");
    f = begin("a.mtl");
    put_text(f, "newmtl red one\nKd 1 0 0\nnewmtl blue\nKd 0 0 .5\n");
}

static void make_stl(void) {
    file *f = begin("a.stl");
    int t;
    int i;
    put_text(f, "solid a pyramid\n");
    for (t = 0; t < 6; t++) {
        put_text(f, " facet normal 0 0 -1.#IND\n  outer loop\n");
        for (i = 0; i < 3; i++) {
            char line[64];
            snprintf(line, sizeof line, "   vertex %g %g %g\n", (double)corner[side[t][i]][0],
                     (double)corner[side[t][i]][1], (double)corner[side[t][i]][2]);
            put_text(f, line);
        }
        put_text(f, "  endloop\n endfacet\n");
    }
    put_text(f, "endsolid a pyramid\n");
    f = begin("a.stl");
    put_text(f, "solid b\ncolor 1 0 0\nfacet normal\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 2 2 0\nvertex 0 2 0\n"
                "endloop\nendfacet 7\nend solid\n\032");
    f = begin("a");
    for (t = 0; t < 80; t++) {
        put(f, "", 1);
    }
    put_number(f, 6, 4, 0);
    for (t = 0; t < 6; t++) {
        for (i = 0; i < 12; i++) {
            put_float(f, i < 3 ? 0 : corner[side[t][i / 3 - 1]][i % 3], 0);
        }
        put_number(f, 0, 2, 0);
    }
    f = begin("a.stl");         /* the same by another name */
    f->size = seed[seeds - 2].size;
    memcpy(f->bytes, seed[seeds - 2].bytes, f->size);
}

static void make_ply(int big, const char *format, int wide, const char *element) {
    file *f = begin("a.ply");
    char head[512];
    int text = strcmp(format, "ascii") == 0;
    int i;
    snprintf(head, sizeof head, "ply\nformat %s 1.0\ncomment a pyramid\nelement vertex 5\nproperty uchar red\n"
             "property uchar green\nproperty uchar blue\nproperty %s x\nproperty %s y\nproperty %s z\n"
             "property list uchar short extra\nelement %s 1\nproperty list %s int vertex_indices\nend_header\n", format,
             wide ? "double" : "float", wide ? "double" : "float", wide ? "double" : "float", element,
             wide ? "uint" : "uchar");
    put_text(f, head);
    for (i = 0; i < 5; i++) {
        const float *c = corner[i];
        int a;
        if (text) {
            snprintf(head, sizeof head, "255 0 0 %g %g %.3f 1 7\n", (double)c[0], (double)c[1], (double)c[2]);
            put_text(f, head);
            continue;
        }
        put_number(f, 0x0000ff, 3, big);
        for (a = 0; a < 3; a++) {
            if (wide) {
                put_double(f, (double)c[a] + 0.1, big);
            } else {
                put_float(f, c[a], big);
            }
        }
        put_number(f, 1, 1, big);
        put_number(f, 7, 2, big);
    }
    if (text) {
        put_text(f, strcmp(element, "face") == 0 ? "5 0 1 2 4 3\n" : "7 0 1 2 -1 2 3 4\n");
        return;
    }
    put_number(f, 4, wide ? 4 : 1, big);
    for (i = 0; i < 4; i++) {
        put_number(f, (uint64_t)i, 4, big);
    }
}

static void make_off(void) {
    file *f = begin("a.off");
    put_text(f, "OFF\n# a comment\n4 1 4\n0 0 .5\n8 8 .5\n0 3 .5\n-8 8 .5\n4 1 2 3 0 255 0 0\n");
    f = begin("a.off");
    put_text(f, "COFF 3 2 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n3 2 1 0 0.5 0.5 0.5\n");
}

static const char *gltf_text(char *out, size_t room, const char *uri) {
    snprintf(out, room, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":[1],"
             "\"translation\":[10,0,0],\"rotation\":[0,0,0.7071,0.7071],\"scale\":[1,2,3]},{\"mesh\":0,\"matrix\":"
             "[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,0,1]}],\"meshes\":[{\"primitives\":[{\"mode\":1,\"attributes\":{\"POSITION\":0}},"
             "{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0},{\"mode\":5,\"attributes\":{\"POSITION\":0}}]}],"
             "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0,1,1]}}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
             "{\"bufferView\":1,\"byteOffset\":0,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36,\"byteStride\":12},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}],"
             "\"buffers\":[{\"byteLength\":42%s}]}", uri);
    return out;
}

static void put_buffer(file *f) {
    static const int first[3] = {0, 1, 3};
    int i;
    for (i = 0; i < 9; i++) {
        put_float(f, corner[first[i / 3]][i % 3], 0);
    }
    put_number(f, 0x000200010000u, 6, 0);
}

static void make_gltf(void) {
    char text[2048];
    file *f = begin("a.gltf");
    put_text(f, gltf_text(text, sizeof text, ",\"uri\":\"data:application/octet-stream;base64,"
                                        "AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAAEAAAAAAAAABAAIA\""));
    f = begin("a.gltf");
    put_text(f, gltf_text(text, sizeof text, ",\"uri\":\"a%2ebin\""));
    f = begin("a.bin");
    put_buffer(f);
    gltf_text(text, sizeof text, "");
    while (strlen(text) % 4) {
        strcat(text, " ");
    }
    f = begin("a.glb");
    put_text(f, "glTF");
    put_number(f, 2, 4, 0);
    put_number(f, 20 + strlen(text) + 8 + 44, 4, 0);
    put_number(f, strlen(text), 4, 0);
    put_text(f, "JSON");
    put_text(f, text);
    put_number(f, 44, 4, 0);
    put(f, "BIN", 4);
    put_buffer(f);
    put_number(f, 0, 2, 0);
}

static void make_all(void) {
    make_obj();
    make_stl();
    make_ply(0, "ascii", 0, "face");
    make_ply(0, "ascii", 1, "tristrips");
    make_ply(0, "binary_little_endian", 0, "face");
    make_ply(0, "binary_little_endian", 1, "face");
    make_ply(1, "binary_big_endian", 1, "tristrips");
    make_off();
    make_gltf();
}

/* ---- 2. Damage -------------------------------------------------------------------------------------- */

static void cut(file *f, size_t at, size_t count) {
    memmove(f->bytes + at, f->bytes + at + count, f->size - at - count);
    f->size -= count;
}

static void insert(file *f, size_t at, const unsigned char *bytes, size_t count) {
    if (f->size + count <= MOST) {
        memmove(f->bytes + at + count, f->bytes + at, f->size - at);
        memcpy(f->bytes + at, bytes, count);
        f->size += count;
    }
}

/* A number of the text becomes one that programs trip over. */
static void damage_number(file *f) {
    static const char *const odd[] = {"-1", "0", "4294967295", "4294967296", "2147483648", "-2147483649", "1e999", "nan", "-inf",
                                      "9007199254740993", "18446744073709551616", "1e-320", "3.1+e2", "1.#IND", "65536", "255",
                                      "0.5", "-0", "1e308", "0x10", "2147483647", "5126", "5125", "5121", ".", "1e"};
    size_t at = pick((uint32_t)f->size);
    size_t end;
    const char *text = odd[pick(sizeof odd / sizeof odd[0])];
    while (at < f->size && !(f->bytes[at] >= '0' && f->bytes[at] <= '9')) {
        at += 1;
    }
    for (end = at; end < f->size && f->bytes[end] >= '0' && f->bytes[end] <= '9'; end++) {
    }
    cut(f, at, end - at);
    insert(f, at, (const unsigned char *)text, strlen(text));
}

/* One, two, four or eight bytes become a number at the end of its type's range. */
static void damage_binary(file *f) {
    static const uint64_t odd[] = {0, 1, 0x7f, 0x80, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0x80000000u, 0xffffffffu, 0x7f800000, 0x7fc00000,
                                   0xff7fffffu, 0x00000001, UINT64_MAX, 0x7ff0000000000000u, 0x7fefffffffffffffu};
    size_t size = (size_t)1 << pick(4);
    uint64_t bits = odd[pick(sizeof odd / sizeof odd[0])];
    size_t at;
    size_t i;
    if (f->size <= size) {
        return;
    }
    at = pick((uint32_t)(f->size - size));
    for (i = 0; i < size; i++) {
        f->bytes[at + i] = (unsigned char)(bits >> 8 * i);
    }
}

static void damage(file *f) {
    size_t at = pick((uint32_t)f->size);
    size_t count = 1 + pick(pick(4) ? 8 : 200);
    const file *other = &seed[pick((uint32_t)seeds)];
    size_t from = pick((uint32_t)other->size);
    unsigned char piece[256];
    switch (pick(8)) {
    case 0: f->bytes[at] ^= (unsigned char)(1u << pick(8)); break;
    case 1: f->bytes[at] = (unsigned char)pick(256); break;
    case 2: cut(f, at, count < f->size - at ? count : f->size - at); break;
    case 3:
        count = count < f->size - at ? count : f->size - at;
        memcpy(piece, f->bytes + at, count);
        insert(f, pick((uint32_t)f->size), piece, count);
        break;
    case 4: insert(f, at, other->bytes + from, count < other->size - from ? count : other->size - from); break;
    case 5: damage_binary(f); break;
    case 6: f->size = pick(8) ? f->size : at; break;
    default: damage_number(f); break;
    }
}

/* ---- 3. Reading ------------------------------------------------------------------------------------- */

static void save(const char *folder, const file *f) {
    char path[512];
    FILE *out;
    snprintf(path, sizeof path, "%s/%s", folder, f->name);
    out = fopen(path, "wb");
    if (!out || fwrite(f->bytes, 1, f->size, out) != f->size || fclose(out)) {
        perror(path);
        exit(2);
    }
}

/* Every corner is there, and the mesh can be framed and filled, on the surface and inside. */
static void use(const mesh *m) {
    static uint64_t bits[MOST_BITS];
    tribox_mesh view = mesh_view(m);
    tribox_mesh_f64 exact = mesh_view_f64(m);
    mesh_stats stats = mesh_measure(m);
    tribox_grid grid;
    size_t edges;
    CHECK(m->triangles > 0 && m->format && m->positions);
    CHECK(m->vertices_coloured <= m->vertices && m->faces_coloured <= m->triangles);
    CHECK(stats.nonfinite <= m->triangles && mesh_open_edges(m, &edges));
    if (!(m->exact ? tribox_grid_fit_f64(&grid, &exact, 8) : tribox_grid_fit(&grid, &view, 8))) {
        return;
    }
    grid.flags = 0;
    memset(bits, 0, sizeof bits);
    CHECK(tribox_grid_words(&grid) <= MOST_BITS);
    if (m->exact) {
        tribox_grid_fill_f64(&grid, &exact, bits);
    } else {
        tribox_grid_fill(&grid, &view, bits);
    }
    solid_exact(&grid, m, m->indices, m->triangles, bits);
}

static char said[MESH_ERROR];      /* the last error */

static int read_mutant(const char *folder, const file *f) {
    char path[512];
    char *error = said;
    mesh m;
    error[0] = 0;
    snprintf(path, sizeof path, "%s/%s", folder, f->name);
    if (!mesh_read(&m, path, error)) {
        CHECK(error[0] != 0 && !m.positions && !m.exact && !m.indices);
        return 0;
    }
    use(&m);
    mesh_free(&m);
    return 1;
}

/* Mutant 0 of each seed is the seed itself. The two files that others name are damaged, too, and the files that
   name them then read. */
static int one(const char *folder, long number) {
    static file f;
    int which = (int)(number % seeds);
    const char *reader = strcmp(seed[which].name, "a.mtl") == 0 ? "a.obj"
                       : strcmp(seed[which].name, "a.bin") == 0 ? "a.gltf" : NULL;
    int times;
    int i;
    state = 0x9e3779b97f4a7c15u * (uint64_t)(number + 1);
    f = seed[which];
    for (times = number < seeds ? 0 : 1 + (int)pick(pick(3) ? 2 : 12); times > 0 && f.size > 0; times--) {
        damage(&f);
    }
    save(folder, &f);
    if (reader) {
        for (i = 0; i < seeds; i++) {
            if (strcmp(seed[i].name, reader) == 0 && (strcmp(reader, "a.obj") == 0 ? i == 0 : strcmp(seed[i - 1].name, reader) == 0)) {
                save(folder, &seed[i]);
                i = read_mutant(folder, &seed[i]);
                save(folder, &seed[which]);
                return i;
            }
        }
    }
    return read_mutant(folder, &f);
}

int main(int argc, char **argv) {
    long count = argc > 1 ? strtol(argv[1], NULL, 10) : 1000;
    const char *folder = argc > 2 ? argv[2] : "build";
    long only = argc > 3 ? strtol(argv[3], NULL, 10) : -1;
    long read = 0;
    long i;
    int k;
    make_all();
    for (k = 0; k < seeds; k++) {
        save(folder, &seed[k]);
    }
    for (i = only < 0 ? 0 : only; i < (only < 0 ? count : only + 1); i++) {
        int ok = one(folder, i);
        CHECK(i >= seeds || ok);
        read += ok;
        if (test_failed_checks) {
            printf("mutant %ld of %s\n%s\n", i, seed[i % seeds].name, said);
            return 1;
        }
    }
    printf("mesh mutants: %ld files of %d kinds, %ld of them read\n1 passed, 0 failed\n", count, seeds, read);
    return 0;
}
