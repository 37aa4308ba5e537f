/* voxelize - a mesh file into voxels: .binvox, MagicaVoxel .vox, .npy, .nrrd, .vti, a shaded .png, or .obj or .stl
 * of the exposed faces
 *
 *   build/voxelize teapot 128 -o teapot.vox -o teapot.png
 *
 * The work is three calls of tribox.h: tribox_grid_fit frames the mesh, tribox_grid_words tells the memory,
 * tribox_grid_fill sets every voxel that the mesh touches; where a coordinate of the file is no float, the same in
 * double. `build/voxelize --help` lists the options.
 */
#include "program.h"
#include "mesh_stats.h"
#include "render.h"
#include "solid.h"
#include "solid_parts.h"

enum { MAX_OUTPUTS = 16, BATCH = 65536, BATCHES = 64 };

typedef struct options {
    const char *mesh;
    int         resolution;             /* 0: not given */
    unsigned    flags;
    int         has_size;
    double      size[3];
    int         has_origin;
    double      origin[3];
    int         solid;                  /* one of SOLID_ */
    int         surface;
    char        up;                     /* 0: as the format has it */
    char        format[MAX_OUTPUTS];    /* of each output: the first letter that tells it, see formats[] */
    const char *output[MAX_OUTPUTS];
    int         outputs;
    int         plain_format;           /* of "-o -"; -1: not given */
} options;

enum { SOLID_NONE, SOLID_EXACT, SOLID_PARTS, SOLID_FLOOD };

static FILE *say;       /* where the report goes: standard error if an output goes to the standard output */

static const char usage[] =
    "usage: voxelize [mesh] [resolution] [options]\n"
    "\n"
    "  mesh            " PROGRAM_MESHES " (default: teapot)\n"
    "  resolution      voxels along the mesh's longest side, 1 to 65536 (default: 128)\n"
    "  -o FILE         write FILE; the name's ending chooses the format; may be repeated:\n"
    "                    .binvox  binary voxels, cubic voxels only\n"
    "                    .vox     MagicaVoxel; grids over 256 a side become several models in one scene\n"
    "                    .npy     a NumPy array of bool, indexed [z, y, x]\n"
    "                    .nrrd    NRRD, with size and origin\n"
    "                    .vti     VTK image data, a cell for each voxel\n"
    "                    .png     a shaded picture\n"
    "                    .obj     the exposed faces, a closed mesh of squares\n"
    "                    .stl     the same as triangles\n"
    "                  \"-o -\" writes to the standard output, as --format has it\n"
    "  --format NAME   binvox, vox, npy, nrrd, vti, png, obj or stl: the format of \"-o -\"\n"
    "  --closed        voxels are closed boxes: all that the mesh touches are set (default)\n"
    "  --half-open     voxels are [min, max): of a face on a grid plane only the upper layer is set\n"
    "  --open          voxels without their borders: a face on a grid plane sets nothing\n"
    "  --thin          6-separating: about half as many voxels, still no way through across faces\n"
    "  --size X,Y,Z    voxel size in the mesh's units, instead of a resolution; one number for cubes\n"
    "  --origin X,Y,Z  a corner of the grid's voxels, with --size (default: 0,0,0)\n"
    "  --solid         the voxels whose centre is inside, by the parity of crossings, exactly; where the mesh is\n"
    "                  open, rows of voxels may leak, and a warning names the first\n"
    "  --solid=parts   each connected part by itself, joined: for models of closed parts that overlap\n"
    "  --solid=flood   the surface and all that a flood from outside does not reach: for meshes with small holes\n"
    "  --surface       the surface, too, with --solid or --solid=parts\n"
    "  --up AXIS       x, y or z: what is up in .vox and .png (default: y for OBJ, PLY and glTF, else z)\n"
    "  --help, -h      this text;  --version   the version;  --   what follows are names\n"
    "\n"
    "A value may follow after \"=\" as well: --size=0.5. Exit status: 0, or 2 for a wrong command, mesh or name, or 1\n"
    "where an output could not be written to its end. A file appears under its name when it is complete.\n"
    "\n"
    "Every voxel is decided exactly: no tolerance, no rounding, the same bits on every machine.\n";

static const char *const formats[] = {"binvox", "vox", "npy", "nrrd", "vti", "png", "obj", "stl"};
enum { FORMATS = sizeof formats / sizeof formats[0] };

/* The number of a format, by its name or by the ending of a file's name; -1 if it is none. */
static int find_format(const char *name, int is_ending) {
    char ending[16];
    int i;
    for (i = 0; i < FORMATS; i++) {
        snprintf(ending, sizeof ending, ".%s", formats[i]);
        if (is_ending ? mesh_name_ends(name, ending) : strcmp(name, formats[i]) == 0) {
            return i;
        }
    }
    return -1;
}

static int read_output(options *o, const char *name, char *error) {
    int format = strcmp(name, "-") == 0 ? -1 : find_format(name, 1);
    if (o->outputs == MAX_OUTPUTS) {
        snprintf(error, MESH_ERROR, "more than %d outputs", MAX_OUTPUTS);
        return 0;
    }
    if (format < 0 && strcmp(name, "-") != 0 && strncmp(name, "/dev/", 5) != 0) {
        snprintf(error, MESH_ERROR, "-o: '%.100s' should end in .binvox, .vox, .npy, .nrrd, .vti, .png, .obj or .stl",
                 name);
        return 0;
    }
    o->output[o->outputs] = name;
    o->format[o->outputs] = (char)format;
    o->outputs += 1;
    return 2;
}

/* One option with its value. Returns how many arguments it took; 0 and a message if it is wrong. */
static int read_option(options *o, const char *name, const char *value, char *error) {
    if (program_rule(name, &o->flags)) {
        return 1;
    }
    if (strcmp(name, "--solid") == 0) {
        o->solid = SOLID_EXACT;
        return 1;
    }
    if (strcmp(name, "--surface") == 0) {
        o->surface = 1;
        return 1;
    }
    if (strcmp(name, "-o") != 0 && strcmp(name, "--size") != 0 && strcmp(name, "--origin") != 0
        && strcmp(name, "--up") != 0 && strcmp(name, "--format") != 0) {
        snprintf(error, MESH_ERROR, "unknown option '%.100s'", name);
        return 0;
    }
    if (!value) {
        snprintf(error, MESH_ERROR, "%s needs a value", name);
        return 0;
    }
    if (name[1] == 'o') {
        return read_output(o, value, error);
    }
    snprintf(error, MESH_ERROR, "%s: '%.100s' %s", name, value,
             name[2] == 's' ? "should be one or three numbers above 0, such as 0.5 or 1,1,0.5"
             : name[2] == 'o' ? "should be three numbers, such as 0,0,0.5"
             : name[2] == 'f' ? "should be binvox, vox, npy, nrrd, vti, png, obj or stl" : "should be x, y or z");
    if (name[2] == 'f') {
        o->plain_format = find_format(value, 0);
        return o->plain_format >= 0 ? 2 : 0;
    }
    if (name[2] == 's') {
        o->has_size = 1;
        return program_triple(value, o->size) && o->size[0] > 0 && o->size[1] > 0 && o->size[2] > 0 ? 2 : 0;
    }
    if (name[2] == 'o') {
        o->has_origin = 1;
        return program_triple(value, o->origin) ? 2 : 0;
    }
    o->up = value[0];
    return value[0] >= 'x' && value[0] <= 'z' && value[1] == 0 ? 2 : 0;
}

/* Before any work: can each output be written, is none of them the mesh, does its format take the voxels? */
static int check_outputs(const options *o, char *error) {
    int i;
    int k;
    for (i = 0; i < o->outputs; i++) {
        for (k = 0; k < i; k++) {
            if (strcmp(o->output[i], o->output[k]) == 0) {
                snprintf(error, MESH_ERROR, "%.200s is named twice", o->output[i]);
                return 0;
            }
        }
        if (o->format[i] == 0 && o->has_size && (o->size[0] < o->size[1] || o->size[0] > o->size[1]
                                                 || o->size[1] < o->size[2] || o->size[1] > o->size[2])) {
            return voxels_fail(o->output[i], "a binvox file holds cubic voxels only; take another format", error);
        }
        if (!voxels_check(o->output[i], o->mesh, error)) {
            return 0;
        }
    }
    return 1;
}

/* A mesh or a resolution. */
static int read_name(options *o, const char *argument, char *error) {
    if (!o->mesh) {
        o->mesh = argument;
        return 1;
    }
    if (o->resolution) {
        snprintf(error, MESH_ERROR, "'%.100s' is one argument too many", argument);
        return 0;
    }
    if (!program_int(argument, 1, 65536, &o->resolution)) {
        snprintf(error, MESH_ERROR, "resolution '%.100s' should be a number from 1 to 65536", argument);
        return 0;
    }
    return 1;
}

/* "-o" or "--size=1": the value follows, or stands behind "=". Returns how many arguments that took. */
static int read_argument(options *o, char **argv, int i, int argc, char *error) {
    char name[64];
    const char *equals = argv[i][1] == '-' ? strchr(argv[i], '=') : NULL;
    int used;
    if (strncmp(argv[i], "--solid=", 8) == 0) {
        o->solid = strcmp(equals, "=parts") == 0 ? SOLID_PARTS : strcmp(equals, "=flood") == 0 ? SOLID_FLOOD : SOLID_NONE;
        snprintf(error, MESH_ERROR, "--solid: '%.100s' should be parts or flood", equals + 1);
        return o->solid != SOLID_NONE;
    }
    if (!equals || (size_t)(equals - argv[i]) >= sizeof name) {
        return read_option(o, argv[i], i + 1 < argc ? argv[i + 1] : NULL, error);
    }
    memcpy(name, argv[i], (size_t)(equals - argv[i]));
    name[equals - argv[i]] = 0;
    used = read_option(o, name, equals + 1, error);
    if (used == 1) {
        snprintf(error, MESH_ERROR, "%s takes no value", name);
    }
    return used == 2 ? 1 : 0;
}

static int read_options(options *o, int argc, char **argv, char *error) {
    int i = 1;
    int names = 0;
    memset(o, 0, sizeof *o);
    o->plain_format = -1;
    while (i < argc) {
        int used = 1;
        if (!names && strcmp(argv[i], "--") == 0) {
            names = 1;
        } else if (!names && argv[i][0] == '-' && argv[i][1] != 0) {
            used = read_argument(o, argv, i, argc, error);
        } else {
            used = read_name(o, argv[i], error);
        }
        if (used == 0) {
            return 0;
        }
        i += used;
    }
    if (o->has_size && o->resolution) {
        snprintf(error, MESH_ERROR, "give a resolution or --size, not both");
        return 0;
    }
    if (o->surface && !o->solid) {
        snprintf(error, MESH_ERROR, "--surface goes with --solid: without it the surface is all there is");
        return 0;
    }
    if (o->has_origin && !o->has_size) {
        snprintf(error, MESH_ERROR, "--origin needs --size");
        return 0;
    }
    o->mesh = o->mesh ? o->mesh : "teapot";
    o->resolution = o->resolution ? o->resolution : 128;
    for (i = 0; i < o->outputs; i++) {
        if (o->format[i] < 0) {
            o->format[i] = (char)o->plain_format;
        }
        if (o->format[i] < 0) {
            snprintf(error, MESH_ERROR, "-o %.100s needs --format", o->output[i]);
            return 0;
        }
    }
    return check_outputs(o, error);
}

/* The region of a grid with given voxels: the mesh's bounding box and a voxel more on each side. */
static int frame_by_size(tribox_grid *grid, const options *o, const mesh_stats *stats, char *error) {
    int a;
    for (a = 0; a < 3; a++) {
        double lo = floor((stats->min[a] - o->origin[a]) / o->size[a]) - 1;
        double hi = floor((stats->max[a] - o->origin[a]) / o->size[a]) + 2;
        if (!(lo > -2147483000.0 && hi < 2147483000.0)) {
            snprintf(error, MESH_ERROR, "--size %g on a mesh from %g to %g: too many voxels along %c",
                     o->size[a], stats->min[a], stats->max[a], 'x' + a);
            return 0;
        }
        grid->origin[a] = o->origin[a];
        grid->size[a] = o->size[a];
        grid->lo[a] = (int)lo;
        grid->hi[a] = (int)hi;
    }
    return 1;
}

/* Triangles in batches, so that long work can be seen to go on; the bits are those of one call. */
static void fill(voxels *v, const mesh *m, int inside) {
    progress p = progress_begin(inside ? "solid" : "filling");
    const size_t batch = m->triangles / BATCHES < BATCH ? m->triangles / BATCHES + 1 : BATCH;
    size_t done = 0;
    while (done < m->triangles) {
        size_t end = m->triangles - done < batch ? m->triangles : done + batch;
        mesh_fill_part(&v->grid, m, done, end, inside, v->bits);
        done = end;
        progress_show(&p, (double)done, (double)m->triangles);
    }
    progress_end(&p);
}

static int write_output(const char *path, int format, const voxels *v, char up, char *error) {
    switch (format) {
    case 0:  return binvox_write(path, v, error);
    case 1:  return vox_write(path, v, upright_make(up), error);
    case 2:  return npy_write(path, v, error);
    case 3:  return nrrd_write(path, v, error);
    case 4:  return vti_write(path, v, error);
    case 5:  return render_write(path, v, up, error);
    case 6:  return faces_write(path, v, error);
    default: return stl_write(path, v, error);
    }
}

static void print_mesh(const mesh *m, const mesh_stats *stats, const options *o) {
    size_t open_edges;
    int a;
    fprintf(say, "mesh      %s: %s, %lu triangles\n", o->mesh, m->format, (unsigned long)m->triangles);
    if (stats->nonfinite) {
        fprintf(say, "          %lu triangles with a NaN or infinite corner are no set of points and set nothing\n",
               (unsigned long)stats->nonfinite);
    }
    if (stats->degenerate) {
        fprintf(say, "          %lu triangles without area; they set the voxels of their segment or point\n",
               (unsigned long)stats->degenerate);
    }
    if (m->skipped) {
        fprintf(say, "          %lu faces with fewer than three corners skipped\n", (unsigned long)m->skipped);
    }
    for (a = 0; a < 3; a++) {
        char least[32];
        char most[32];
        fprintf(say, "%s%c %s to %s", a == 0 ? "          " : ", ", 'x' + a,
               program_shortest(stats->min[a], m->exact != NULL, least),
               program_shortest(stats->max[a], m->exact != NULL, most));
    }
    fprintf(say, "\n");
    if (m->exact) {
        fprintf(say, "          some coordinates are no floats: all is computed in double\n");
    }
    if ((o->solid || m->triangles < 200000) && mesh_open_edges(m, &open_edges)) {
        if (open_edges) {
            fprintf(say, "          not closed: %lu edges belong to an odd number of triangles\n",
                   (unsigned long)open_edges);
        } else {
            fprintf(say, "          closed: every edge belongs to an even number of triangles\n");
        }
    }
}

static void print_grid(const voxels *v) {
    fprintf(say, "grid      %lu x %lu x %lu voxels of %g x %g x %g, %s, %.1f MB\n", (unsigned long)v->n[0],
           (unsigned long)v->n[1], (unsigned long)v->n[2], v->grid.size[0], v->grid.size[1], v->grid.size[2],
           program_rule_name(v->grid.flags), (double)v->words * 8e-6);
}

/* The exact solid, as a whole or by parts, and what leaks. Returns 0 if memory is short. */
static int fill_solid(const options *o, const mesh *m, voxels *v) {
    double start = progress_seconds();
    int row[SOLID_SHOWN][2];
    size_t parts;
    size_t cavities;
    size_t open;
    size_t i;
    if (o->solid == SOLID_EXACT) {
        fill(v, m, 1);
        fprintf(say, "solid     ");
    } else {
        if (!solid_by_parts(v, m, &parts, &cavities)) {
            return 0;
        }
        fprintf(say, "solid     %lu parts, %lu cavities in them: ", (unsigned long)parts, (unsigned long)cavities);
    }
    fprintf(say, "%lu voxels in %.3f s\n", (unsigned long)voxels_count(v), progress_seconds() - start);
    open = solid_open_rows(v, m, row);
    if (open > 0) {
        fprintf(say, "warning   the mesh is open: %lu rows along x are crossed an odd number of times, and set to their"
                " end: y,z =", (unsigned long)open);
        for (i = 0; i < open && i < SOLID_SHOWN; i++) {
            fprintf(say, " %d,%d", row[i][0], row[i][1]);
        }
        fprintf(say, "%s\n", open > SOLID_SHOWN ? ", ..." : "");
    }
    return 1;
}

/* Fills, prints and writes. Returns the exit status. */
static int voxelize(const options *o, const mesh *m, voxels *v, char *error) {
    char up = o->up ? o->up : strstr(m->format, "PLY") || strstr(m->format, "OBJ") || strstr(m->format, "glTF") ? 'y' : 'z';
    double start;
    size_t inside;
    int status = 0;
    int i;
    print_grid(v);
    fflush(say);
    if ((o->solid == SOLID_EXACT || o->solid == SOLID_PARTS) && !fill_solid(o, m, v)) {
        snprintf(error, MESH_ERROR, "--solid: out of memory");
        return 2;
    }
    if (o->solid == SOLID_NONE || o->solid == SOLID_FLOOD || o->surface) {
        start = progress_seconds();
        fill(v, m, 0);
        fprintf(say, "%s %lu voxels in %.3f s\n", o->solid == SOLID_NONE || o->solid == SOLID_FLOOD ? "surface  "
                : "with the surface", (unsigned long)voxels_count(v), progress_seconds() - start);
    }
    if (o->solid == SOLID_FLOOD) {
        start = progress_seconds();
        if (!solid_fill(v, &inside)) {
            snprintf(error, MESH_ERROR, "--solid: out of memory");
            return 2;
        }
        fprintf(say, "inside    %lu voxels in %.3f s%s\n", (unsigned long)inside, progress_seconds() - start,
               inside ? "" : ": the mesh encloses nothing, or has a hole wider than a voxel");
    }
    for (i = 0; i < o->outputs && status == 0; i++) {
        fflush(say);
        status = write_output(o->output[i], o->format[i], v, up, error) ? 0 : 1;
        if (status == 0) {
            fprintf(say, "wrote     %s\n", o->output[i]);
        }
    }
    return status;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "";
    options o;
    mesh m;
    mesh_stats stats;
    tribox_grid grid;
    voxels v;
    int i;
    int status = 2;
    for (i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        if (program_answers(argv[i], "voxelize", usage)) {
            return 0;
        }
    }
    if (!read_options(&o, argc, argv, error)) {
        program_fails("voxelize", error);
        fputs("try: voxelize --help\n", stderr);
        return 2;
    }
    if (!program_mesh(&m, o.mesh, error)) {
        return program_fails("voxelize", error);
    }
    say = stdout;
    for (i = 0; i < o.outputs; i++) {
        say = strcmp(o.output[i], "-") == 0 ? stderr : say;
    }
    stats = mesh_measure(&m);
    print_mesh(&m, &stats, &o);
    if (stats.nonfinite == m.triangles) {
        snprintf(error, MESH_ERROR, "%.200s: no triangle is finite", o.mesh);
    } else if (!o.has_size && !mesh_fit(&grid, &m, o.resolution)) {
        snprintf(error, MESH_ERROR, "%.200s: the mesh is a single point, or too large to frame; give --size",
                 o.mesh);
    } else if (!o.has_size || frame_by_size(&grid, &o, &stats, error)) {
        grid.flags = o.flags;
        if (voxels_make(&v, &grid, error)) {
            status = voxelize(&o, &m, &v, error);
            voxels_free(&v);
        }
    }
    mesh_free(&m);
    if (status) {
        program_fails("voxelize", error);
    }
    return status;
}
