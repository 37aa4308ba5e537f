/* program.h - what the example programs share: numbers from the command line, the mesh argument, the rule
   options */
#ifndef EXAMPLES_PROGRAM_H
#define EXAMPLES_PROGRAM_H
#include "teapot.h"

#include <limits.h>
#include <time.h>

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
    int ok = closed || strcmp(name, "teapot") == 0 ? teapot_make(out, 24, closed, error) : mesh_read(out, name, error);
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

static inline double program_cpu_seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

#endif /* EXAMPLES_PROGRAM_H */
