/* check_voxels - is another program's voxelizer right? Its file against the exact set, by its own convention
 *
 *   build/check_voxels mesh.obj other.binvox                   as the file's header says, closed boxes
 *   build/check_voxels mesh.obj other.mha --like itk           as ITK lays its grid and counts faces
 *   build/check_voxels mesh.obj other.npy --size .1 --origin 1,2,3 --guess
 *
 * Each difference is shown with its box, how far it is from touching, the triangle that decides, and a line
 * of C for a unit test; their totals by kind say what is wrong: rounding, a shift by half a voxel, one side
 * of grid planes, lost triangles, streaks. Exit status: 0 the same set, 1 a difference, 2 no answer.
 */
#include "program.h"
#include "difference.h"
#include "guess.h"
#include "volume.h"

typedef struct options {
    const char       *mesh;
    const char       *other;
    const convention *like;
    int               has_rule;
    unsigned          flags;
    int               guess;
    int               json;
    int               has_size;
    double            size[3];
    int               has_origin;
    double            origin[3];
    int               has_dims;
    double            dims[3];
    int               has_level;
    int               side;
    double            level;
    int               solid;
    int               turned;
    char              up;
    int               show;
} options;

static const char usage[] =
    "usage: check_voxels mesh voxels [options]\n"
    "\n"
    "  mesh            " PROGRAM_MESHES "\n"
    "  voxels          the voxels to check: a .binvox, .vox, .npy, .nrrd, .vti or .mha file; anything else with\n"
    "                  --dims: a byte a voxel, or a bit, lowest first, or the words of tribox_grid_fill\n"
    "  --like NAME     the convention of another program: where its voxels lie, what sets them, which faces\n"
    "                  count; --like list names them (default: as the header says, boxes touched)\n"
    "  --guess         try all conventions, say which fits best, and compare with that\n"
    "  --closed, --half-open, --open, --thin\n"
    "                  the rule of boxes (default: the convention's; --closed: every voxel that the mesh touches)\n"
    "  --solid         the voxels whose middle is inside, as voxelize --solid sets them\n"
    "  --solid=flood   the touched ones, and their inside filled by a flood from outside\n"
    "  --size X,Y,Z    the voxels' size, where the file has none, or where its rounded one isn't meant; the first\n"
    "                  voxel is then a whole number of voxels from --origin, the nearest to the file's\n"
    "  --origin X,Y,Z  the file's origin if it has none: where its first voxel lies (default: 0,0,0)\n"
    "  --dims X,Y,Z    the sides of a file without a header; x runs fastest\n"
    "  --order xyz     the array is indexed [x][y][z] (default: zyx, as voxelize writes .npy)\n"
    "  --above L, --below L\n"
    "                  set is what is above, or below, L (default: above 0)\n"
    "  --up AXIS       what a .vox file has upwards: x, y or z (default: as voxelize's)\n"
    "  --show N        how many differences to list (default: 5)\n"
    "  --json          for machines\n"
    "  --help, --version\n"
    "\n"
    "exit status: 0 the same set, 1 a difference, 2 no answer\n";

/* ---- 1. Options ----------------------------------------------------------------------------------- */

static int read_number(const char *text, double *out) {
    char *end;
    *out = strtod(text, &end);
    return end != text && *end == 0 && fabs(*out) <= DBL_MAX;
}

static int read_flag(options *o, const char *name) {
    if (program_rule(name, &o->flags)) {
        o->has_rule = 1;
    } else if (strcmp(name, "--solid") == 0 || strcmp(name, "--solid=flood") == 0) {
        o->solid = name[7] == 0 ? 1 : 2;
    } else if (strcmp(name, "--guess") == 0) {
        o->guess = 1;
    } else if (strcmp(name, "--json") == 0) {
        o->json = 1;
    } else {
        return 0;
    }
    return 1;
}

static int is_positive(const double x[3]) {
    return x[0] > 0 && x[1] > 0 && x[2] > 0;
}

/* Returns 1; 0 for a value that is none; -1 for an unknown name. */
static int read_value(options *o, const char *name, const char *value) {
    if (strcmp(name, "--like") == 0) {
        o->like = value ? convention_named(value) : NULL;
        return o->like != NULL;
    }
    if (strcmp(name, "--size") == 0) {
        o->has_size = 1;
        return value && program_triple(value, o->size) && is_positive(o->size);
    }
    if (strcmp(name, "--origin") == 0) {
        o->has_origin = 1;
        return value && program_triple(value, o->origin);
    }
    if (strcmp(name, "--dims") == 0) {
        o->has_dims = 1;
        return value && program_triple(value, o->dims) && is_positive(o->dims);
    }
    if (strcmp(name, "--above") == 0 || strcmp(name, "--below") == 0) {
        o->has_level = 1;
        o->side = name[2] == 'a' ? VOLUME_ABOVE : VOLUME_BELOW;
        return value && read_number(value, &o->level);
    }
    if (strcmp(name, "--order") == 0) {
        o->turned = value && strcmp(value, "xyz") == 0;
        return value && (o->turned || strcmp(value, "zyx") == 0);
    }
    if (strcmp(name, "--up") == 0) {
        o->up = value ? value[0] : 0;
        return value && value[0] && strchr("xyz", value[0]) && value[1] == 0;
    }
    if (strcmp(name, "--show") == 0) {
        return value && program_int(value, 0, INT_MAX, &o->show);
    }
    return -1;
}

/* "--name value" or "--name=value". Returns how many arguments were used, 0 with a sentence. */
static int read_option(options *o, char *argument, const char *next, char *error) {
    char *equals = strchr(argument, '=');
    const char *value = equals ? equals + 1 : next;
    int ok;
    if (read_flag(o, argument)) {
        return 1;
    }
    if (equals) {
        *equals = 0;
    }
    ok = read_value(o, argument, value);
    if (ok < 0) {
        snprintf(error, MESH_ERROR, "unknown option '%.100s'", argument);
    } else if (!value) {
        snprintf(error, MESH_ERROR, "%s needs a value", argument);
    } else {
        snprintf(error, MESH_ERROR, "%s: '%.100s' is not such a value", argument, value);
    }
    return ok > 0 ? equals ? 1 : 2 : 0;
}

static int read_options(options *o, int argc, char **argv, char *error) {
    int names = 0;
    int i = 1;
    memset(o, 0, sizeof *o);
    o->show = 5;
    while (i < argc) {
        if (!names && strcmp(argv[i], "--") == 0) {
            names = 1;
            i += 1;
        } else if (!names && argv[i][0] == '-' && argv[i][1] != 0) {
            int used = read_option(o, argv[i], i + 1 < argc ? argv[i + 1] : NULL, error);
            if (used == 0) {
                return 0;
            }
            i += used;
        } else if (o->other) {
            snprintf(error, MESH_ERROR, "'%.100s' is one argument too many", argv[i]);
            return 0;
        } else {
            *(o->mesh ? &o->other : &o->mesh) = argv[i];
            i += 1;
        }
    }
    if (!o->other) {
        snprintf(error, MESH_ERROR, "a mesh and a file of voxels are needed");
        return 0;
    }
    if (o->has_origin && !o->has_size) {
        snprintf(error, MESH_ERROR, "--origin needs --size");
        return 0;
    }
    if (o->guess && (o->like || o->has_rule || o->solid)) {
        snprintf(error, MESH_ERROR, "--guess tries all conventions: give no other");
        return 0;
    }
    return 1;
}

static void list_conventions(void) {
    char text[160];
    int i;
    for (i = 0; i < CONVENTION_COUNT; i++) {
        printf("%-14s %s\n%15s%s\n", conventions[i].name, conventions[i].program, "",
               convention_says(&conventions[i], text));
    }
}

/* ---- 2. Place ------------------------------------------------------------------------------------- */

/* The file has a place: its first voxel is the nearest whole number of --size from --origin. */
static int place_near(volume *v, const options *o, char *error) {
    int a;
    for (a = 0; a < 3; a++) {
        double first = floor((v->origin[a] - o->origin[a]) / o->size[a] + 0.5);
        if (!(fabs(first) < 1e9)) {
            snprintf(error, MESH_ERROR,
                     "--size and --origin put the grid's first voxel at number %g along %c", first, 'x' + a);
            return 0;
        }
        v->first[a] = (int)first;
        v->origin[a] = o->origin[a];
        v->size[a] = o->size[a];
    }
    return 1;
}

/* The file has none: voxelize frames a mesh by its resolution alone. */
static int place_fitted(volume *v, const mesh *m, char *error) {
    tribox_mesh view = mesh_view(m);
    tribox_mesh_f64 exact = mesh_view_f64(m);
    size_t longest = v->n[0] > v->n[1] ? v->n[0] : v->n[1];
    tribox_grid grid;
    int turns;
    int a;
    longest = longest > v->n[2] ? longest : v->n[2];
    for (turns = 0; turns < 2; turns++) {
        if ((m->exact ? tribox_grid_fit_f64(&grid, &exact, (int)longest)
                      : tribox_grid_fit(&grid, &view, (int)longest))
            && (size_t)grid.hi[0] == v->n[0] && (size_t)grid.hi[1] == v->n[1]
            && (size_t)grid.hi[2] == v->n[2]) {
            v->placed = VOLUME_CORNER;
            for (a = 0; a < 3; a++) {
                v->origin[a] = grid.origin[a];
                v->size[a] = grid.size[a];
            }
            return 1;
        }
        if (!v->free_order) {
            break;
        }
        volume_turn(v);
    }
    snprintf(error, MESH_ERROR,
             "the file does not say where its voxels lie, and it is not as voxelize frames this mesh: "
             "give --size and --origin");
    return 0;
}

static int place(volume *v, const options *o, const mesh *m, char *error) {
    int a;
    if (!o->has_size) {
        return v->placed || place_fitted(v, m, error);
    }
    if (v->placed) {
        return place_near(v, o, error);
    }
    v->placed = VOLUME_CORNER;
    for (a = 0; a < 3; a++) {
        v->origin[a] = o->origin[a];
        v->size[a] = o->size[a];
    }
    return 1;
}

/* ---- 3. Text -------------------------------------------------------------------------------------- */

static void print_triple(const char *before, const double x[3], const char *after) {
    char text[3][32];
    printf("%s%s,%s,%s%s", before, program_shortest(x[0], 1, text[0]), program_shortest(x[1], 1, text[1]),
           program_shortest(x[2], 1, text[2]), after);
}

static void print_braces(const double x[3]) {
    print_triple("{", x, "}");
}

/* A line for a unit test: exact for every grid, as no corner is rounded. */
static void print_line_of_c(const differences *d, const difference *one) {
    const tribox_grid *g = &d->exact->grid;
    double lo[3];
    double hi[3];
    int at[3];
    int a;
    if (d->c->kind == CONVENTION_SAMPLES) {
        difference_box(d->exact, 1, one->at, lo, hi);
        printf("{ double q[3] = ");
        print_braces(lo);
        printf("; assert(tribox_mesh_contains_f64(&mesh, q) == %d); }", one->missing);
        return;
    }
    for (a = 0; a < 3; a++) {
        at[a] = g->lo[a] + (int)one->at[a];
    }
    printf("{ tribox_grid g = {");
    print_braces(g->origin);
    printf(", ");
    print_braces(g->size);
    printf(", {%d,%d,%d}, {%d,%d,%d}, %u}; double v[3][3] = {", at[0], at[1], at[2], at[0] + 1, at[1] + 1,
           at[2] + 1, d->c->flags);
    for (a = 0; a < 3; a++) {
        print_braces(one->by.v[a]);
        printf("%s", a < 2 ? ", " : "");
    }
    printf("}; assert(tribox_grid_spans_f64(&g, v[0], v[1], v[2], NULL, NULL) == %d); }", one->missing);
}

static void print_difference(const differences *d, const difference *one) {
    int sample = d->c->kind == CONVENTION_SAMPLES;
    double lo[3];
    double hi[3];
    difference_box(d->exact, sample, one->at, lo, hi);
    printf("  %s  %lu,%lu,%lu  ", one->missing ? "missing" : "extra  ", (unsigned long)one->at[0],
           (unsigned long)one->at[1], (unsigned long)one->at[2]);
    print_triple(sample ? "sample " : "box ", lo, "");
    if (!sample) {
        print_triple(" to ", hi, "");
    }
    if (one->by.triangle == SIZE_MAX) {
        printf(": no triangle\n");
        return;
    }
    printf(": %s%.9g voxels %s triangle %lu (%s)\n          ", one->by.exact ? "" : "about ",
           fabs(one->voxels),
           sample || one->voxels > 0 ? "from"
           : one->voxels < 0         ? "deep in"
                                     : "away, touches",
           (unsigned long)one->by.triangle, kind_names[one->kind]);
    print_line_of_c(d, one);
    printf("\n");
}

static void print_kinds(const differences *d) {
    static const char *const says[KINDS] = {
        "on the border exactly: which faces count", "on the border, by a triangle in a grid plane: which side counts",
        "within 1e-6 voxels of touching: rounding", "gone where the grid is moved", "triangles that are lost",
        "streaks along an axis", "anything else", "not looked at"};
    int k;
    for (k = 0; k < KINDS; k++) {
        size_t missing = d->kind[1][k];
        size_t extra = d->kind[0][k];
        if (missing + extra > 0) {
            printf("  %-9s %lu missing, %lu extra: %s", kind_names[k], (unsigned long)missing,
                   (unsigned long)extra, says[k]);
            if (k == KIND_SHIFTED) {
                printf(" by %g,%g,%g voxels", 0.5 * d->shift[0], 0.5 * d->shift[1], 0.5 * d->shift[2]);
            }
            if (k == KIND_LOST) {
                printf(": %lu, the first is %lu", (unsigned long)d->lost, (unsigned long)d->first_lost);
            }
            printf("\n");
        }
    }
}

/* Names of the programs with this convention, parted by commas. */
static void convention_programs(const convention *c, char *out, size_t room) {
    size_t used = 0;
    int i;
    out[0] = 0;
    for (i = 0; i < CONVENTION_COUNT; i++) {
        if (convention_same(&conventions[i], c) && used + 40 < room) {
            used += (size_t)snprintf(out + used, room - used, "%s%s", used ? ", " : "", conventions[i].name);
        }
    }
}

static void print_fit(const char *before, const fit *f, const volume *v) {
    char names[160];
    char text[160];
    convention_programs(&f->c, names, sizeof names);
    printf("%s%lu of %lu as %s%s%s", before, (unsigned long)f->common,
           (unsigned long)(f->common + f->missing + f->extra), names, names[0] ? ": " : "",
           convention_says(&f->c, text));
    if (v->type.kind == 'f' || v->type.kind == 'i') {
        printf("; set is %s %g", f->below ? "below" : "above", f->level);
    }
    printf("%s\n", f->turned ? "; indexed [x][y][z]" : "");
}

/* The best, what sets the same voxels, and three that come next. */
static void print_guess(const fit *fits, int count, const volume *v) {
    size_t fewest = fits[0].missing + fits[0].extra;
    char names[160];
    int others = 0;
    int named = 0;
    int nexts = 0;
    int i;
    int k;
    print_fit("guess    ", &fits[0], v);
    for (i = 1; i < count && fits[i].missing + fits[i].extra == fewest; i++) {
        for (k = 0; k < i && !convention_same(&fits[k].c, &fits[i].c); k++) {
        }
        if (k < i) {
            continue;       /* the same, read from the file in another way */
        }
        convention_programs(&fits[i].c, names, sizeof names);
        others += names[0] == 0;
        if (names[0]) {
            printf("%s%s", named ? ", " : "         not told apart by this mesh: ", names);
            named = 1;
        }
    }
    if (named) {
        printf(others ? ", and %d without a name\n" : "\n", others);
    } else if (others) {
        printf("         not told apart by this mesh: %d without a program's name\n", others);
    }
    for (; i < count && nexts < 3; i++) {
        if (fits[i].missing + fits[i].extra > fewest) {
            print_fit("next     ", &fits[i], v);
            fewest = fits[i].missing + fits[i].extra;
            nexts += 1;
        }
    }
}

static void print_result(const options *o, const differences *d, const volume *v, size_t around) {
    const voxels *exact = d->exact;
    char text[160];
    char size[3][32];
    size_t shown;
    printf("grid     %lu x %lu x %lu voxels of %s x %s x %s, %s: %s\n", (unsigned long)exact->n[0],
           (unsigned long)exact->n[1], (unsigned long)exact->n[2],
           program_shortest(exact->grid.size[0], 1, size[0]),
           program_shortest(exact->grid.size[1], 1, size[1]),
           program_shortest(exact->grid.size[2], 1, size[2]), v->format, convention_says(d->c, text));
    printf("exact    %lu voxels\n", (unsigned long)voxels_count(exact));
    printf("other    %lu voxels\n", (unsigned long)voxels_count(d->given));
    for (shown = 0; shown < d->count && shown < (size_t)o->show; shown++) {
        print_difference(d, &d->list[shown]);
    }
    printf("missing  %lu\nextra    %lu\n", (unsigned long)d->missing, (unsigned long)d->extra);
    print_kinds(d);
    if (around) {
        printf("note     %lu voxels around the grid are touched too; the file has no room for them\n",
               (unsigned long)around);
    }
}

/* ---- 4. JSON -------------------------------------------------------------------------------------- */

static void report_string(const char *name, const char *text) {
    printf("\"%s\": \"", name);
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\') {
            printf("\\%c", c);
        } else if (c < 32) {
            printf("\\u%04x", c);
        } else {
            putchar(c);
        }
    }
    printf("\"");
}

static void report_fit(const fit *f) {
    char text[160];
    printf("{");
    convention_programs(&f->c, text, sizeof text);
    report_string("programs", text);
    printf(", ");
    report_string("as", convention_says(&f->c, text));
    printf(", \"common\": %lu, \"missing\": %lu, \"extra\": %lu, \"order\": \"%s\", \"%s\": %.17g}",
           (unsigned long)f->common, (unsigned long)f->missing, (unsigned long)f->extra,
           f->turned ? "xyz" : "zyx", f->below ? "below" : "above", f->level);
}

static void report_difference(const differences *d, const difference *one) {
    int sample = d->c->kind == CONVENTION_SAMPLES;
    double lo[3];
    double hi[3];
    difference_box(d->exact, sample, one->at, lo, hi);
    printf("{\"voxel\": [%lu, %lu, %lu], \"missing\": %s, \"kind\": \"%s\", ", (unsigned long)one->at[0],
           (unsigned long)one->at[1], (unsigned long)one->at[2], one->missing ? "true" : "false",
           kind_names[one->kind]);
    printf("\"min\": [%.17g, %.17g, %.17g], \"max\": [%.17g, %.17g, %.17g], ", lo[0], lo[1], lo[2], hi[0],
           hi[1], hi[2]);
    if (one->by.triangle == SIZE_MAX) {
        printf("\"triangle\": null}");
        return;
    }
    printf("\"voxels\": %.17g, \"exact\": %s, \"triangle\": %lu}", one->voxels,
           one->by.exact ? "true" : "false", (unsigned long)one->by.triangle);
}

static void report_result(const options *o, const differences *d, const volume *v, const fit *fits,
                          int fit_count, size_t around) {
    const tribox_grid *g = &d->exact->grid;
    char text[160];
    size_t i;
    int k;
    printf("{");
    report_string("mesh", o->mesh);
    printf(", ");
    report_string("voxels", o->other);
    printf(", ");
    report_string("format", v->format);
    printf(", \"n\": [%lu, %lu, %lu], \"origin\": [%.17g, %.17g, %.17g], \"size\": [%.17g, %.17g, %.17g], ",
           (unsigned long)d->exact->n[0], (unsigned long)d->exact->n[1], (unsigned long)d->exact->n[2],
           g->origin[0] + g->lo[0] * g->size[0], g->origin[1] + g->lo[1] * g->size[1],
           g->origin[2] + g->lo[2] * g->size[2], g->size[0], g->size[1], g->size[2]);
    report_string("as", convention_says(d->c, text));
    printf(
        ", \"exact\": %lu, \"other\": %lu, \"missing\": %lu, \"extra\": %lu, \"around\": %lu, \"kinds\": {",
        (unsigned long)voxels_count(d->exact), (unsigned long)voxels_count(d->given),
        (unsigned long)d->missing, (unsigned long)d->extra, (unsigned long)around);
    for (k = 0; k < KINDS; k++) {
        printf("%s\"%s\": [%lu, %lu]", k ? ", " : "", kind_names[k], (unsigned long)d->kind[1][k],
               (unsigned long)d->kind[0][k]);
    }
    printf("}, \"lost_triangles\": %lu, \"guess\": [", (unsigned long)d->lost);
    for (k = 0; k < fit_count && k < 8; k++) {
        printf("%s", k ? ", " : "");
        report_fit(&fits[k]);
    }
    printf("], \"differences\": [");
    for (i = 0; i < d->count && i < (size_t)o->show; i++) {
        printf("%s", i ? ", " : "");
        report_difference(d, &d->list[i]);
    }
    printf("]}\n");
}

/* ---- 5. Comparison -------------------------------------------------------------------------------- */

/* Voxels that the mesh touches in the layer around the file's grid. */
static size_t count_around(const voxels *v, const mesh *m) {
    tribox_grid wide = v->grid;
    voxels around;
    char ignored[MESH_ERROR];
    size_t count = 0;
    size_t y;
    size_t z;
    int a;
    for (a = 0; a < 3; a++) {
        wide.lo[a] -= 1;
        wide.hi[a] += 1;
    }
    if (!voxels_make(&around, &wide, ignored) || !convention_plain(m, 0, &around, ignored)) {
        return 0;
    }
    for (z = 0; z < around.n[2]; z++) {
        for (y = 0; y < around.n[1]; y++) {
            int inner = z > 0 && y > 0 && z + 1 < around.n[2] && y + 1 < around.n[1];
            size_t x;
            for (x = 0; x < around.n[0]; x += inner ? around.n[0] - 1 : 1) {
                count += (size_t)voxels_get(&around, x, y, z);
            }
        }
    }
    voxels_free(&around);
    return count;
}

/* The convention that the options ask for, and how numbers are read. */
static convention wanted(options *o, const volume *v) {
    convention c = o->like ? *o->like : conventions[0];
    double least;
    double greatest;
    if (o->solid) {
        c.kind = o->solid == 1 ? CONVENTION_SAMPLES : CONVENTION_FILLED;
    }
    if (o->has_rule) {
        c.flags = o->flags;
    }
    if (v->placed == VOLUME_SAMPLE && (!o->like || strncmp(c.name, "ours", 4) == 0)) {
        c.shift = -1;       /* a sample is the middle of its voxel */
    }
    o->level = o->has_level ? o->level : c.level;
    if (c.below && !o->has_level) {
        volume_range(v, &least, &greatest);
        o->side = least < 0 ? VOLUME_BELOW : VOLUME_ABOVE;
    }
    return c;
}

static int compare(options *o, const mesh *m, volume *v, char *error) {
    fit *fits = NULL;
    int fit_count = 0;
    convention c;
    differences d;
    voxels given;
    voxels exact;
    tribox_grid file;
    size_t around;
    int status = 2;
    if (o->guess) {
        fits = (fit *)malloc(GUESS_ROOM * sizeof *fits);
        if (!fits || !guess_all(m, v, fits, &fit_count, error)) {
            free(fits);
            return 2;
        }
        c = fits[0].c;
        o->side = fits[0].below ? VOLUME_BELOW : VOLUME_ABOVE;
        o->level = fits[0].level;
        if (fits[0].turned) {
            volume_turn(v);
        }
    } else {
        c = wanted(o, v);
    }
    if (volume_grid(v, &file, error) && volume_set(v, o->side, o->level, &given, error)) {
        if (convention_set(m, &file, &c, &exact, error)) {
            if (differences_find(&d, m, &c, &file, &exact, &given, (size_t)o->show, error)) {
                around = c.kind == CONVENTION_TOUCHED ? count_around(&exact, m) : 0;
                if (o->json) {
                    report_result(o, &d, v, fits, fit_count, around);
                } else {
                    if (fits) {
                        print_guess(fits, fit_count, v);
                    }
                    print_result(o, &d, v, around);
                    if (convention_rounds(&file, c.shift)) {
                        printf("note     the boxes' corners, half a voxel from the file's origin, are "
                               "rounded\n");
                    }
                }
                status = d.missing + d.extra > 0 ? 1 : 0;
                differences_free(&d);
            }
            voxels_free(&exact);
        }
        voxels_free(&given);
    }
    free(fits);
    return status;
}

static int check(options *o, char *error) {
    size_t dims[3] = {0, 0, 0};
    mesh m;
    volume v;
    char up;
    int status = 2;
    int a;
    for (a = 0; a < 3 && o->has_dims; a++) {
        dims[a] = o->dims[a] <= 1 << 20 ? (size_t)o->dims[a] : 0;
    }
    if (!program_mesh(&m, o->mesh, error)) {
        return 2;
    }
    up = o->up ? o->up : strstr(m.format, "PLY") || strstr(m.format, "OBJ") ? 'y' : 'z';
    if (volume_read(&v, o->other, o->has_dims ? dims : NULL, up, error)) {
        if (v.free_order && o->turned) {
            volume_turn(&v);
        }
        if (place(&v, o, &m, error)) {
            status = compare(o, &m, &v, error);
        }
        volume_free(&v);
    }
    mesh_free(&m);
    return status;
}

int main(int argc, char **argv) {
    char error[MESH_ERROR] = "";
    options o;
    int status;
    int i;
    for (i = 1; i < argc; i++) {
        if (program_answers(argv[i], "check_voxels", usage)) {
            return 0;
        }
        if (strcmp(argv[i], "--like=list") == 0
            || (strcmp(argv[i], "--like") == 0 && i + 1 < argc && strcmp(argv[i + 1], "list") == 0)) {
            list_conventions();
            return 0;
        }
    }
    if (!read_options(&o, argc, argv, error)) {
        program_fails("check_voxels", error);
        fputs("try: check_voxels --help\n", stderr);
        return 2;
    }
    status = check(&o, error);
    return status == 2 ? program_fails("check_voxels", error) : status;
}
