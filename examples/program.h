/* program.h - what the example programs share: the command line, the mesh argument, the rule options */
#ifndef EXAMPLES_PROGRAM_H
#define EXAMPLES_PROGRAM_H
#include "mesh_exact.h"
#include "progress.h"
#include "teapot.h"

#include <limits.h>

#define PROGRAM_MESHES \
    "an OBJ, STL, PLY, OFF or glTF file, \"-\" for the standard input, or built in:\n" \
    "                  teapot, teapot-closed"

/* One whole number in [least, most]. Returns 1, or 0 if the text is something else. */
static inline int program_int(const char *text, int least, int most, int *out_value) {
    char *end;
    long value;
    errno = 0;
    value = strtol(text, &end, 10);
    *out_value = (int)value;
    return end != text && *end == 0 && errno == 0 && value >= least && value <= most;
}

/* "a,b,c", or "a" for all three; finite. Returns 1, or 0 if the text is something else. */
static inline int program_triple(const char *text, double out_value[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        char *end;
        out_value[a] = strtod(text, &end);
        if (end == text || !(fabs(out_value[a]) <= DBL_MAX)) {
            return 0;
        }
        if (a == 0 && *end == 0) {
            out_value[1] = out_value[0];
            out_value[2] = out_value[0];
            return 1;
        }
        if (*end != (a < 2 ? ',' : 0)) {
            return 0;
        }
        text = end + 1;
    }
    return 1;
}

/* --thin, --half-open or --open. Returns 1 and sets the flags, or 0 if the text is something else. */
static inline int program_rule(const char *text, unsigned *out_flags) {
    static const char *const names[] = {"--closed", "--half-open", "--open", NULL, "--thin"};
    unsigned flags;
    for (flags = 0; flags <= TRIBOX_THIN; flags++) {
        if (names[flags] && strcmp(text, names[flags]) == 0) {
            *out_flags = flags;
            return 1;
        }
    }
    return 0;
}

static inline const char *program_rule_name(unsigned flags) {
    return flags & TRIBOX_THIN ? "thin (6-separating)" : flags & TRIBOX_OPEN ? "conservative, open voxels"
         : flags & TRIBOX_HALF_OPEN ? "conservative, half-open voxels" : "conservative, closed voxels";
}

static inline int program_mesh(mesh *out, const char *name, char *error) {
    int closed = strcmp(name, "teapot-closed") == 0;
    int ok;
    if (progress_on_terminal()) {
        fprintf(stderr, "  reading %.60s\r", name);
        fflush(stderr);
    }
    ok = closed || strcmp(name, "teapot") == 0 ? teapot_make(out, 24, closed, error) : mesh_read(out, name, error);
    if (progress_on_terminal()) {
        fprintf(stderr, "%70s\r", "");
    }
    if (ok && out->warnings > 0) {
        fprintf(stderr, "warning: %s\n", out->warning);
    }
    if (ok && out->warnings > 1) {
        fprintf(stderr, "warning: %lu more of that kind or another\n", (unsigned long)(out->warnings - 1));
    }
    return ok;
}

/* The fewest digits, from six, that give the number back: as a float, or as a double. */
static inline const char *program_shortest(double x, int is_double, char out[32]) {
    int digits;
    for (digits = 6; digits < 17; digits++) {
        snprintf(out, 32, "%.*g", digits, x);
        if (is_double ? !(strtod(out, NULL) < x || strtod(out, NULL) > x)
                      : !((double)strtof(out, NULL) < x || (double)strtof(out, NULL) > x)) {
            return out;
        }
    }
    snprintf(out, 32, "%.17g", x);
    return out;
}

static inline int program_fails(const char *program, const char *error) {
    fflush(stdout);
    fprintf(stderr, "%s: %s\n", program, error);
    return 2;
}

/* --help, -h and --version. Returns 1 if the argument was one of these, and has been answered. */
static inline int program_answers(const char *argument, const char *name, const char *usage) {
    if (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0) {
        printf("%s%s", usage, usage[0] && usage[strlen(usage) - 1] == '\n' ? "" : "\n");
        return 1;
    }
    if (strcmp(argument, "--version") == 0) {
        printf("%s, tribox.h %s\n", name, TRIBOX_VERSION_STRING);
        return 1;
    }
    return 0;
}

/* For programs without options of their own: answers --help, -h and --version, refuses all else that begins with "-",
 * and takes "--" away, behind which everything is a name.
 *
 * Returns the exit status, or -1 to go on.
 */
static inline int program_arguments(const char *name, const char *usage, int *argc, char **argv) {
    char error[MESH_ERROR];
    int kept = 1;
    int names = 0;
    int i;
    for (i = 1; i < *argc; i++) {
        if (!names && program_answers(argv[i], name, usage)) {
            return 0;
        }
        if (!names && strcmp(argv[i], "--") == 0) {
            names = 1;
            continue;
        }
        if (!names && argv[i][0] == '-' && argv[i][1] != 0) {
            snprintf(error, sizeof error, "unknown option '%.100s'; %.300s", argv[i], usage);
            return program_fails(name, error);
        }
        argv[kept] = argv[i];
        kept += 1;
    }
    *argc = kept;
    return -1;
}

#endif /* EXAMPLES_PROGRAM_H */
