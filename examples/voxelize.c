/* voxelize - a mesh file into voxels: .binvox, MagicaVoxel .vox, a shaded .png, or .obj of the exposed faces
 *
 *   build/voxelize teapot 128 -o teapot.vox -o teapot.png
 *
 * The work is three calls of tribox.h: tribox_grid_fit frames the mesh, tribox_grid_words tells the memory,
 * tribox_grid_fill sets every voxel that the mesh touches. `build/voxelize --help` lists the options.
 */
#include "program.h"
#include "mesh_stats.h"
#include "render.h"
#include "solid.h"

enum { MAX_OUTPUTS = 16, BATCH = 65536 };

typedef struct options {
    const char *mesh;
    int         resolution;             /* 0: not given */
    unsigned    flags;
    int         has_size;
    double      size[3];
    int         has_origin;
    double      origin[3];
    int         solid;
    char        up;                     /* 0: as the format has it */
    const char *output[MAX_OUTPUTS];
    int         outputs;
} options;

static const char usage[] =
    "usage: voxelize [mesh] [resolution] [options]\n"
    "\n"
    "  mesh            " PROGRAM_MESHES " (default: teapot)\n"
    "  resolution      voxels along the mesh's longest side, 1 to 65536 (default: 128)\n"
    "  -o FILE         write FILE; the name's ending chooses the format; may be repeated:\n"
    "                    .binvox  binary voxels, cubic voxels only\n"
    "                    .vox     MagicaVoxel; grids over 256 a side become several models in one scene\n"
    "                    .png     a shaded picture\n"
    "                    .obj     the exposed faces, a closed mesh of squares\n"
    "  --closed        voxels are closed boxes: all that the mesh touches are set (default)\n"
    "  --half-open     voxels are [min, max): of a face on a grid plane only the upper layer is set\n"
    "  --open          voxels without their borders: a face on a grid plane sets nothing\n"
    "  --thin          6-separating: about half as many voxels, still no way through across faces\n"
    "  --size X,Y,Z    voxel size in the mesh's units, instead of a resolution; one number for cubes\n"
    "  --origin X,Y,Z  a corner of the grid's voxels, with --size (default: 0,0,0)\n"
    "  --solid         fill the inside too: all that a flood from outside does not reach\n"
    "  --up AXIS       x, y or z: what is up in .vox and .png (default: y for OBJ and PLY, else z)\n"
    "  --help          this text\n"
    "\n"
    "Every voxel is decided exactly: no tolerance, no rounding, the same bits on every machine.\n";

static int known_output(const char *path) {
    return mesh_name_ends(path, ".binvox") || mesh_name_ends(path, ".vox") || mesh_name_ends(path, ".png")
        || mesh_name_ends(path, ".obj");
}

/* One option with its value. Returns how many arguments it took; 0 and a message if it is wrong. */
static int read_option(options *o, const char *name, const char *value, char *error) {
    if (program_rule(name, &o->flags)) {
        return 1;
    }
    if (strcmp(name, "--solid") == 0) {
        o->solid = 1;
        return 1;
    }
    if (strcmp(name, "-o") != 0 && strcmp(name, "--size") != 0 && strcmp(name, "--origin") != 0
        && strcmp(name, "--up") != 0) {
        snprintf(error, MESH_ERROR, "unknown option '%.100s'", name);
        return 0;
    }
    if (!value) {
        snprintf(error, MESH_ERROR, "%s needs a value", name);
        return 0;
    }
    snprintf(error, MESH_ERROR, "%s: '%.100s' %s", name, value,
             name[1] == 'o' ? "should end in .binvox, .vox, .png or .obj"
             : name[2] == 's' ? "should be one or three numbers above 0, such as 0.5 or 1,1,0.5"
             : name[2] == 'o' ? "should be three numbers, such as 0,0,0.5" : "should be x, y or z");
    if (name[1] == 'o') {
        if (o->outputs == MAX_OUTPUTS) {
            snprintf(error, MESH_ERROR, "more than %d outputs", MAX_OUTPUTS);
            return 0;
        }
        o->output[o->outputs] = value;
        o->outputs += 1;
        return known_output(value) ? 2 : 0;
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

static int read_options(options *o, int argc, char **argv, char *error) {
    int i = 1;
    memset(o, 0, sizeof *o);
    while (i < argc) {
        if (argv[i][0] == '-' && argv[i][1] != 0) {
            int used = read_option(o, argv[i], i + 1 < argc ? argv[i + 1] : NULL, error);
            if (used == 0) {
                return 0;
            }
            i += used;
            continue;
        }
        if (!o->mesh) {
            o->mesh = argv[i];
        } else if (o->resolution) {
            snprintf(error, MESH_ERROR, "'%.100s' is one argument too many", argv[i]);
            return 0;
        } else if (!program_int(argv[i], 1, 65536, &o->resolution)) {
            snprintf(error, MESH_ERROR, "resolution '%.100s' should be a number from 1 to 65536", argv[i]);
            return 0;
        }
        i += 1;
    }
    if (o->has_size && o->resolution) {
        snprintf(error, MESH_ERROR, "give a resolution or --size, not both");
        return 0;
    }
    if (o->has_origin && !o->has_size) {
        snprintf(error, MESH_ERROR, "--origin needs --size");
        return 0;
    }
    o->mesh = o->mesh ? o->mesh : "teapot";
    o->resolution = o->resolution ? o->resolution : 128;
    return 1;
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
static void fill(voxels *v, const tribox_mesh *whole) {
    double next = progress_seconds() + 2;
    size_t done;
    for (done = 0; done < whole->triangles; done += BATCH) {
        size_t rest = whole->triangles - done;
        tribox_mesh part = *whole;
        part.triangles = rest < BATCH ? rest : BATCH;
        if (part.indices) {
            part.indices += 3 * done;
        } else {
            part.positions = whole->positions + 9 * done;
        }
        tribox_grid_fill(&v->grid, &part, v->bits);
        if (progress_seconds() > next) {
            fprintf(stderr, "  %.0f %% of the triangles\n",
                    100 * (double)(done + part.triangles) / (double)whole->triangles);
            next = progress_seconds() + 2;
        }
    }
}

static int write_output(const char *path, const voxels *v, char up, char *error) {
    if (mesh_name_ends(path, ".binvox")) {
        const double *size = v->grid.size;
        if (size[0] != size[1] || size[1] != size[2]) {
            return voxels_fail(path, "a binvox file holds cubic voxels only; take .vox, .png or .obj", error);
        }
        return binvox_write(path, v, error);
    }
    if (mesh_name_ends(path, ".vox")) {
        return vox_write(path, v, upright_make(up), error);
    }
    return mesh_name_ends(path, ".png") ? render_write(path, v, up, error) : faces_write(path, v, error);
}

static void print_mesh(const mesh *m, const mesh_stats *stats, const options *o) {
    size_t open_edges;
    int a;
    printf("mesh      %s: %s, %lu triangles\n", o->mesh, m->format, (unsigned long)m->triangles);
    if (stats->nonfinite) {
        printf("          %lu triangles with a NaN or infinite corner are no set of points and set nothing\n",
               (unsigned long)stats->nonfinite);
    }
    if (stats->degenerate) {
        printf("          %lu triangles without area; they set the voxels of their segment or point\n",
               (unsigned long)stats->degenerate);
    }
    if (m->skipped) {
        printf("          %lu faces with fewer than three corners skipped\n", (unsigned long)m->skipped);
    }
    for (a = 0; a < 3; a++) {
        char least[32];
        char most[32];
        printf("%s%c %s to %s", a == 0 ? "          " : ", ", 'x' + a,
               program_shortest(stats->min[a], m->exact != NULL, least),
               program_shortest(stats->max[a], m->exact != NULL, most));
    }
    printf("\n");
    if ((o->solid || m->triangles < 200000) && mesh_open_edges(m, &open_edges)) {
        if (open_edges) {
            printf("          not closed: %lu edges belong to an odd number of triangles\n",
                   (unsigned long)open_edges);
        } else {
            printf("          closed: every edge belongs to an even number of triangles\n");
        }
    }
}

static void print_grid(const voxels *v) {
    printf("grid      %lu x %lu x %lu voxels of %g x %g x %g, %s, %.1f MB\n", (unsigned long)v->n[0],
           (unsigned long)v->n[1], (unsigned long)v->n[2], v->grid.size[0], v->grid.size[1], v->grid.size[2],
           program_rule_name(v->grid.flags), (double)v->words * 8e-6);
}

/* Fills, prints and writes. Returns the exit status. */
static int voxelize(const options *o, const mesh *m, const tribox_mesh *view, voxels *v, char *error) {
    char up = o->up ? o->up : strstr(m->format, "PLY") || strstr(m->format, "OBJ") ? 'y' : 'z';
    double start;
    size_t inside;
    int status = 0;
    int i;
    print_grid(v);
    fflush(stdout);
    start = progress_seconds();
    fill(v, view);
    printf("surface   %lu voxels in %.3f s\n", (unsigned long)voxels_count(v), progress_seconds() - start);
    if (o->solid) {
        start = progress_seconds();
        if (!solid_fill(v, &inside)) {
            snprintf(error, MESH_ERROR, "--solid: out of memory");
            return 2;
        }
        printf("inside    %lu voxels in %.3f s%s\n", (unsigned long)inside, progress_seconds() - start,
               inside ? "" : ": the mesh encloses nothing, or has a hole wider than a voxel");
    }
    for (i = 0; i < o->outputs && status == 0; i++) {
        fflush(stdout);
        status = write_output(o->output[i], v, up, error) ? 0 : 2;
        if (status == 0) {
            printf("wrote     %s\n", o->output[i]);
        }
    }
    return status;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "";
    options o;
    mesh m;
    mesh_stats stats;
    tribox_mesh view;
    tribox_grid grid;
    voxels v;
    int i;
    int status = 2;
    for (i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            fputs(usage, stdout);
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
    view = mesh_view(&m);
    stats = mesh_measure(&m);
    print_mesh(&m, &stats, &o);
    if (stats.nonfinite == m.triangles) {
        snprintf(error, MESH_ERROR, "%.200s: no triangle is finite", o.mesh);
    } else if (!o.has_size && !tribox_grid_fit(&grid, &view, o.resolution)) {
        snprintf(error, MESH_ERROR, "%.200s: the mesh is a single point, or too large to frame; give --size",
                 o.mesh);
    } else if (!o.has_size || frame_by_size(&grid, &o, &stats, error)) {
        grid.flags = o.flags;
        if (voxels_make(&v, &grid, error)) {
            status = voxelize(&o, &m, &view, &v, error);
            voxels_free(&v);
        }
    }
    mesh_free(&m);
    return status ? program_fails("voxelize", error) : 0;
}
