/* slabs_mpi - one mesh, several machines, one file
 *
 *   mpirun -n 4 build/slabs_mpi [mesh] [resolution] [file.binvox]     default: the teapot, 256, build/slabs_mpi.binvox
 *
 * Each rank fills a slab of the grid's layers z: a region cut smaller, whose words are a part of the whole array. The
 * slabs are written side by side into file.binvox.bits. A .binvox runs along y, then z, and along x last, so each rank then
 * reads back its share of all rows, a range of x, runs it through the run-length code, and writes it behind those of the ranks
 * before. Runs end with each x, so that the file is the same, byte by byte, from any number of ranks. In the end rank 0
 * reads the file and compares it with a fill of its own. Prints:
 *
 *   grid      256 x 160 x 126, 4 ranks
 *   fill      ... s in the slowest rank, ... triangles
 *   file      ... bytes
 *   check     the same as one process
 *
 * Exit status: 0 the same, 1 not the same, 2 an error. make mpi runs it with 1, 2 and 4 ranks.
 */
#include <mpi.h>

#include "program.h"
#include "voxel_io.h"

typedef struct job {
    int         rank;
    int         ranks;
    mesh mesh;
    voxels      whole;          /* its bits are not kept: only sizes */
    const char *path;
    char        part_path[1024];        /* the file until it is complete */
    char        bits_path[1024];
} job;

static size_t share(const job *j, int rank, size_t n) {
    return (size_t)((uint64_t)n * (uint64_t)rank / (uint64_t)j->ranks);
}

/* All ranks hear whether all are well. */
static int all_well(int well) {
    int all;
    MPI_Allreduce(&well, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    return all;
}

/* Words at once: counts are int. */
static int transfer(MPI_File file, int writes, size_t at, uint64_t *words, size_t count) {
    const size_t most = (size_t)1 << 27;
    int well = 1;
    while (count > 0 && well) {
        const size_t now = count < most ? count : most;
        const MPI_Offset offset = (MPI_Offset)(at * sizeof *words);
        well = (writes ? MPI_File_write_at(file, offset, words, (int)now, MPI_UINT64_T, MPI_STATUS_IGNORE)
                       : MPI_File_read_at(file, offset, words, (int)now, MPI_UINT64_T, MPI_STATUS_IGNORE)) == MPI_SUCCESS;
        at += now;
        words += now;
        count -= now;
    }
    return well;
}

/* Fills this rank's layers and writes their words to their place. */
static int write_slab(const job *j, char *error) {
    const size_t layer_words = j->whole.row_words * j->whole.n[1];
    const size_t first = share(j, j->rank, j->whole.n[2]);
    const size_t end = share(j, j->rank + 1, j->whole.n[2]);
    tribox_grid slab = j->whole.grid;
    uint64_t *bits = (uint64_t *)calloc((end - first) * layer_words + 1, sizeof *bits);
    double seconds;
    double slowest;
    MPI_File file;
    int well = bits != NULL;
    if (!all_well(well)) {
        free(bits);
        snprintf(error, MESH_ERROR, "out of memory");
        return 0;
    }
    slab.lo[2] = j->whole.grid.lo[2] + (int)first;
    slab.hi[2] = j->whole.grid.lo[2] + (int)end;
    MPI_Barrier(MPI_COMM_WORLD);
    seconds = MPI_Wtime();
    mesh_fill(&slab, &j->mesh, bits);
    seconds = MPI_Wtime() - seconds;
    MPI_Reduce(&seconds, &slowest, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    if (j->rank == 0) {
        printf("fill      %.3f s in the slowest rank, %lu triangles\n", slowest, (unsigned long)j->mesh.triangles);
    }
    well = MPI_File_open(MPI_COMM_WORLD, j->bits_path, MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file) ==
           MPI_SUCCESS;
    if (well) {
        well = transfer(file, 1, first * layer_words, bits, (end - first) * layer_words);
        well &= MPI_File_close(&file) == MPI_SUCCESS;
    }
    free(bits);
    if (!all_well(well)) {
        snprintf(error, MESH_ERROR, "%.400s: cannot be written", j->bits_path);
        return 0;
    }
    return 1;
}

/* Bytes of run-length code. */
typedef struct code {
    unsigned char *bytes;
    size_t         used;
    size_t         room;
    int            failed;
} code;

static void code_add(code *c, int value, uint64_t length) {
    while (length > 0) {
        const int count = length < 255 ? (int)length : 255;
        if (c->used + 2 > c->room) {
            const size_t room = 2 * c->room + 65536;
            unsigned char *bytes = (unsigned char *)realloc(c->bytes, room);
            if (!bytes) {
                c->failed = 1;
                return;
            }
            c->bytes = bytes;
            c->room = room;
        }
        c->bytes[c->used++] = (unsigned char)value;
        c->bytes[c->used++] = (unsigned char)count;
        length -= (uint64_t)count;
    }
}

/* The layers of one x: bit `bit` of word `at` of rows of `words` words. */
static void code_layer(code *c, const voxels *v, const uint64_t *rows, size_t words, size_t at, size_t bit, size_t d) {
    uint64_t length = 0;
    int value = 0;
    size_t y;
    size_t z;
    for (z = 0; z < v->n[2]; z++) {
        for (y = 0; y < d; y++) {
            const int next = y < v->n[1] ? (int)(rows[(z * v->n[1] + y) * words + at] >> bit & 1) : 0;
            if (next != value) {
                code_add(c, value, length);
                value = next;
                length = 0;
            }
            length++;
        }
    }
    if (value != 0) {
        code_add(c, value, length);
        length = 0;
    }
    code_add(c, 0, length + (uint64_t)(d - v->n[2]) * d);
}

/* Reads words first..end - 1 of every row, by a view of the file that leaves out all others. */
static int read_columns(const job *j, uint64_t *rows, size_t first, size_t end) {
    const size_t count = j->whole.n[1] * j->whole.n[2];
    MPI_Datatype view;
    MPI_File file;
    int well;
    if (MPI_File_open(MPI_COMM_WORLD, j->bits_path, MPI_MODE_RDONLY, MPI_INFO_NULL, &file) != MPI_SUCCESS) {
        return 0;
    }
    /* a rank without columns reads nothing, but a view has to have something */
    MPI_Type_vector((int)count, end > first ? (int)(end - first) : 1, (int)j->whole.row_words, MPI_UINT64_T, &view);
    MPI_Type_commit(&view);
    well = MPI_File_set_view(file, (MPI_Offset)(first * sizeof *rows), MPI_UINT64_T, view, "native", MPI_INFO_NULL) ==
           MPI_SUCCESS;
    well = well && transfer(file, 0, 0, rows, count * (end - first));
    MPI_Type_free(&view);
    return (MPI_File_close(&file) == MPI_SUCCESS) & well;
}

/* This rank's part of the file. Rank 0's begins with the header, the last one's ends with the cube's padding. */
static int write_part(const job *j, char *error) {
    const voxels *v = &j->whole;
    const size_t d = binvox_side(v);
    const size_t first = share(j, j->rank, v->row_words);
    const size_t end = share(j, j->rank + 1, v->row_words);
    uint64_t *rows = (uint64_t *)malloc((v->n[1] * v->n[2] * (end - first) + 1) * sizeof *rows);
    code c = {NULL, 0, 0, 0};
    char header[512];
    uint64_t bytes;
    uint64_t before = 0;
    uint64_t all_bytes = 0;
    MPI_File file;
    size_t x;
    int well = all_well(rows != NULL) && all_well(read_columns(j, rows, first, end));
    if (well) {
        int length = snprintf(header, sizeof header, "#binvox 1\ndim %lu %lu %lu\ntranslate %.17g %.17g %.17g\nscale %.17g\ndata\n",
                              (unsigned long)d, (unsigned long)d, (unsigned long)d, voxels_border(v, 0, 0),
                              voxels_border(v, 1, 0), voxels_border(v, 2, 0), v->grid.size[0] * (double)d);
        for (x = 64 * first; x < 64 * end && x < v->n[0]; x++) {
            code_layer(&c, v, rows, end - first, x / 64 - first, x % 64, d);
        }
        if (j->rank == j->ranks - 1) {
            for (x = v->n[0]; x < d; x++) {
                code_add(&c, 0, (uint64_t)d * d);
            }
        }
        bytes = c.used;
        MPI_Exscan(&bytes, &before, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
        before = (j->rank == 0 ? 0 : before) + (uint64_t)length;
        well = !c.failed && c.used <= INT_MAX &&
               MPI_File_open(MPI_COMM_WORLD, j->part_path, MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file) == MPI_SUCCESS;
        if (well) {
            well = MPI_File_set_size(file, 0) == MPI_SUCCESS;
            if (j->rank == 0) {
                well &= MPI_File_write_at(file, 0, header, length, MPI_BYTE, MPI_STATUS_IGNORE) == MPI_SUCCESS;
            }
            well &= MPI_File_write_at(file, (MPI_Offset)before, c.bytes, (int)c.used, MPI_BYTE, MPI_STATUS_IGNORE) ==
                    MPI_SUCCESS;
            well &= MPI_File_close(&file) == MPI_SUCCESS;
        }
        MPI_Reduce(&bytes, &all_bytes, 1, MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
        if (j->rank == 0) {
            printf("file      %lu bytes\n", (unsigned long)(all_bytes + (uint64_t)length));
        }
    }
    free(rows);
    free(c.bytes);
    well = all_well(well);
    if (!all_well(well && (j->rank != 0 || rename(j->part_path, j->path) == 0))) {
        snprintf(error, MESH_ERROR, "%.400s: cannot be written", j->path);
        return 0;
    }
    return 1;
}

/* Rank 0: is the file what one process fills? -1: it cannot be read. */
static int is_same(const job *j, char *error) {
    voxels one;
    voxels got;
    int same = -1;
    if (!voxels_make(&one, &j->whole.grid, error)) {
        return -1;
    }
    mesh_fill(&one.grid, &j->mesh, one.bits);
    if (binvox_read(j->path, &got, error)) {
        int x;
        int y;
        int z;
        same = 1;
        for (z = 0; z < (int)one.n[2]; z++) {
            for (y = 0; y < (int)one.n[1]; y++) {
                for (x = 0; x < (int)one.n[0]; x++) {
                    same &= tribox_grid_get(&one.grid, one.bits, x, y, z) == tribox_grid_get(&got.grid, got.bits, x, y, z);
                }
            }
        }
        free(got.bits);
    }
    free(one.bits);
    return same;
}

/* What all ranks are told: --help and its like, and what is refused, is rank 0's to print. */
static int asked(const job *j, const char *usage, int *argc, char **argv) {
    int answer = j->rank == 0 ? program_arguments("slabs_mpi", usage, argc, argv) : -1;
    MPI_Bcast(&answer, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return j->rank != 0 && answer < 0 ? program_arguments("slabs_mpi", usage, argc, argv) : answer;
}

static int run(job *j, int argc, char **argv, char *error) {
    int resolution = 256;
    char ignored[MESH_ERROR];
    mesh m;
    int same = 1;
    int ok;
    if (argc > 4 || (argc > 2 && !program_int(argv[2], 1, 100000, &resolution))) {
        return -1;
    }
    j->path = argc > 3 ? argv[3] : "build/slabs_mpi.binvox";
    snprintf(j->part_path, sizeof j->part_path, "%.1000s.part", j->path);
    snprintf(j->bits_path, sizeof j->bits_path, "%.1000s.bits", j->path);
    if (!all_well(j->rank != 0 || voxels_check(j->path, argc > 1 ? argv[1] : "teapot", error))) {
        return -1;
    }
    ok = all_well(program_mesh(&m, argc > 1 ? argv[1] : "teapot", error));
    if (!ok) {
        return -1;
    }
    j->mesh = m;
    ok = mesh_fit(&j->whole.grid, &m, resolution);
    if (!ok) {
        snprintf(error, MESH_ERROR, "the mesh is a single point, or too large to frame");
    } else {
        int k;
        for (k = 0; k < 3; k++) {
            j->whole.n[k] = (size_t)j->whole.grid.hi[k];
        }
        j->whole.row_words = (j->whole.n[0] + 63) / 64;
        if (j->rank == 0) {
            printf("grid      %d x %d x %d, %d ranks\n", j->whole.grid.hi[0], j->whole.grid.hi[1], j->whole.grid.hi[2],
                   j->ranks);
        }
        ok = write_slab(j, error) && write_part(j, error);
        if (ok && j->rank == 0) {
            MPI_File_delete(j->bits_path, MPI_INFO_NULL);
            same = is_same(j, ignored);
            printf("check     %s one process\n", same == 1 ? "the same as" : "NOT the same as");
        }
        MPI_Bcast(&same, 1, MPI_INT, 0, MPI_COMM_WORLD);
    }
    mesh_free(&m);
    return ok ? same == 1 : -1;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "usage: slabs_mpi [mesh] [resolution from 1 to 100000] [file.binvox]";
    job j;
    int answer;
    memset(&j, 0, sizeof j);
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &j.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &j.ranks);
    answer = asked(&j, error, &argc, argv);
    if (answer >= 0) {
        MPI_Finalize();
        return answer;
    }
    answer = run(&j, argc, argv, error);
    if (answer < 0 && j.rank == 0) {
        program_fails("slabs_mpi", error);
    }
    MPI_Finalize();
    return answer < 0 ? 2 : answer == 1 ? 0 : 1;
}
