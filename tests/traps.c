/* No function raises invalid, divide-by-zero or overflow, whatever it is asked: programs may unmask these, and
 * then each is a crash. The golden answers are looked at, too: a build of this checks what one of golden.c does.
 *
 *   traps [eighth | few] [mode]...      modes as golden.c's: up down zero daz ftz flush x87-24 x87-53
 *   traps -KIND INDEX [mode]      asks that one question with the exceptions unmasked, for a debugger
 *
 * Asks all golden questions (every function but tribox_sat, on ordinary, touching, extreme, subnormal, NaN and
 * infinite input) and some ordinary meshes and rays, and reads the flags after every answer; then, where no flag
 * was raised and the C library can, all of them again with the exceptions unmasked. Underflow, which is told in
 * LIMITS, is only counted. Prints how often each flag was raised and the first question of each kind. */
#define _GNU_SOURCE
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void traps_say(const char *what, unsigned long index);
#define GOLDEN_SAY(what, index, word) traps_say((what), (unsigned long)(index))
int golden_main(int argc, char **argv);
#define main golden_main
#include "golden.c"
#undef main

#ifdef FE_UNDERFLOW
#define TRAPS_MILD FE_UNDERFLOW
#else
#define TRAPS_MILD 0
#endif
#define TRAPS_FLAGS (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW)
#define TRAPS_KINDS 40

static struct {
    const char *what;
    unsigned long asked, invalid, division, overflow, underflow, first;
} traps_kind[TRAPS_KINDS];
static unsigned long traps_raised, traps_last;
static const char *traps_last_kind = "nothing";
static int traps_unmasked;

static void traps_say(const char *what, unsigned long index)
{
    int flags, i;
    traps_last = index;
    traps_last_kind = what;
    if (traps_unmasked) {
        return;
    }
    flags = fetestexcept(TRAPS_FLAGS | TRAPS_MILD);
    for (i = 0; i < TRAPS_KINDS - 1 && traps_kind[i].what != NULL; ++i) {
        if (strcmp(traps_kind[i].what, what) == 0) {
            break;
        }
    }
    traps_kind[i].what = what;
    traps_kind[i].asked++;
    if (flags != 0) {
        if ((flags & TRAPS_FLAGS) != 0) {
            if (traps_kind[i].invalid + traps_kind[i].division + traps_kind[i].overflow == 0) {
                traps_kind[i].first = index;
            }
            traps_raised++;
        }
        traps_kind[i].invalid += (flags & FE_INVALID) != 0;
        traps_kind[i].division += (flags & FE_DIVBYZERO) != 0;
        traps_kind[i].overflow += (flags & FE_OVERFLOW) != 0;
        traps_kind[i].underflow += (flags & TRAPS_MILD) != 0;
        feclearexcept(FE_ALL_EXCEPT);
    }
}

/* ---- what people do all day: meshes of small and large triangles, rays along axes, at several scales -------- */

enum { TRAPS_SIDE = 96, TRAPS_TRIANGLES = 300 };
static uint64_t traps_bits[TRAPS_SIDE * TRAPS_SIDE * 2];
static float traps_mesh[9 * TRAPS_TRIANGLES];

/* corners in the grid's region or somewhat around it, on whole numbers or not, a triangle of a few voxels or many */
static void traps_make_mesh(uint64_t seed, int scale)
{
    uint64_t state = seed;
    const int whole = (int)(seed & 1);
    const int reach = 1 << golden_between(&state, 0, 6);
    int i, k;
    for (i = 0; i < TRAPS_TRIANGLES; ++i) {
        int corner[3];
        for (k = 0; k < 3; ++k) {
            corner[k] = golden_between(&state, -8, TRAPS_SIDE + 8);
        }
        for (k = 0; k < 9; ++k) {
            int64_t m = ((int64_t)corner[k % 3] + golden_between(&state, -reach, reach)) * 4096;
            uint64_t bits;
            if (!whole) {
                m += golden_between(&state, -4096, 4096);
            }
            bits = golden_encode(m, scale - 12, 0);
            golden_floats(traps_mesh + 9 * i + k, &bits, 1);
        }
    }
}

static void traps_emit(void *user, int x0, int x1, int y, int z)
{
    *(int *)user += (x0 ^ x1 ^ y ^ z) & 1;
}

static int traps_ask_mesh(uint64_t seed, int scale)
{
    uint64_t one = golden_encode(1, scale, 1);
    tribox_grid grid;
    tribox_mesh mesh;
    uint32_t found[16];
    int odd = 0;
    int i, k;
    traps_make_mesh(seed, scale);
    mesh.positions = traps_mesh;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = TRAPS_TRIANGLES;
    for (k = 0; k < 3; ++k) {
        golden_doubles(grid.size + k, &one, 1);
        grid.origin[k] = 0;
        grid.lo[k] = 0;
        grid.hi[k] = TRAPS_SIDE;
    }
    grid.flags = (unsigned)(seed >> 1 & 7);
    tribox_grid_fill(&grid, &mesh, traps_bits);
    traps_say("a mesh: fill", (unsigned long)seed);
    for (i = 0; i < TRAPS_TRIANGLES; i += 7) {
        const float *v = traps_mesh + 9 * i;
        const float *w = traps_mesh + 9 * ((i + 1) % TRAPS_TRIANGLES);
        float t[2];
        float three[3];
        float polygon[9][3];
        float axis[3];
        float point[3];
        tribox_tri tri;
        tribox_grid_spans(&grid, v, v + 3, v + 6, traps_emit, &odd);
        traps_say("a mesh: spans", (unsigned long)seed);
        odd += (int)tribox_mesh_query(&mesh, v, v + 3, found, 16);
        traps_say("a mesh: query", (unsigned long)seed);
        for (k = 0; k < 3; ++k) { /* along an axis or a diagonal, and beside v0 */
            axis[k] = (seed >> k & 1) != 0 ? 1.0f : (seed >> (k + 3) & 1) != 0 ? -1.0f : 0.0f;
            point[k] = k == (int)(seed % 3) ? v[k] : w[k];
        }
        odd += tribox_ray_box(v, axis, 0, 1e9f, w, w + 3, t, t + 1);
        traps_say("a ray along an axis: box", (unsigned long)seed);
        odd += tribox_ray_triangle(v, axis, 0, 1e9f, w, w + 3, w + 6, t);
        traps_say("a ray along an axis: triangle", (unsigned long)seed);
        odd += tribox_segment_box(v, point, w, w + 3) + tribox_box_box(v, v + 3, w, w + 3);
        traps_say("a segment, a box", (unsigned long)seed);
        odd += tribox_sweep(v, v + 3, v + 6, w, w + 3, axis, t, t + 1, three);
        traps_say("a sweep", (unsigned long)seed);
        odd += tribox_clip(v, v + 3, v + 6, w, w + 3, polygon);
        tribox_closest(v, v + 3, v + 6, w, three);
        traps_say("clip, closest", (unsigned long)seed);
        tribox_tri_init(&tri, v, v + 3, v + 6, w, grid.flags);
        odd += tribox_tri_test(&tri, v) + (int)tribox_tri_octants(&tri, w);
        traps_say("a prepared triangle", (unsigned long)seed);
    }
    return odd + tribox_grid_fit(&grid, &mesh, 50);
}

/* 1 if the golden answers are right */
static int traps_all(void)
{
    static const int scales[8] = {0, 0, 0, -3, 10, 34, 57, -140};
    static volatile int odd; /* or the meshes need not be asked */
    uint64_t seed;
    int i;
    feclearexcept(FE_ALL_EXCEPT);
    for (seed = 0; seed < (golden_chunks == GOLDEN_CHUNKS ? 40 : 8); ++seed) {
        for (i = 0; i < 8; ++i) {
            odd += traps_ask_mesh(seed * 11 + (uint64_t)i, scales[i]);
        }
    }
    return golden_all() == golden_expected() && golden_first_wrong() == 0;
}

static int traps_report(const char *mode)
{
    unsigned long asked = 0;
    int i, right;
    traps_raised = 0;
    memset(traps_kind, 0, sizeof traps_kind);
    right = traps_all();
    for (i = 0; i < TRAPS_KINDS && traps_kind[i].what != NULL; ++i) {
        asked += traps_kind[i].asked;
        if (traps_kind[i].invalid + traps_kind[i].division + traps_kind[i].overflow != 0) {
            printf("  %s: of %lu questions %lu raise invalid, %lu divide-by-zero, %lu overflow; the first is %lu\n",
                   traps_kind[i].what, traps_kind[i].asked, traps_kind[i].invalid, traps_kind[i].division,
                   traps_kind[i].overflow, traps_kind[i].first);
        }
        if (traps_kind[i].underflow != 0) {
            printf("  %s: %lu raise underflow\n", traps_kind[i].what, traps_kind[i].underflow);
        }
    }
    printf("traps %-8s %lu of %lu questions raise what they should not, golden answers %s\n", mode, traps_raised,
           asked, right ? "ok" : "DIFFER");
    fflush(stdout);
    return traps_raised == 0 && right;
}

#if defined(__GLIBC__) && defined(__GNUC__) && !defined(TRAPS_NO_SIGNALS)
#include <signal.h>

static void traps_caught(int number)
{
    (void)number;
    printf("traps: SIGFPE after %s %lu\n", traps_last_kind, traps_last);
    fflush(stdout);
    _Exit(1);
}

/* once more, unmasked; a signal ends the program */
static int traps_unmask(void)
{
    signal(SIGFPE, traps_caught);
    feclearexcept(FE_ALL_EXCEPT);
    if (feenableexcept(TRAPS_FLAGS) == -1) {
        printf("traps: exceptions cannot be unmasked here\n");
        return 1;
    }
    traps_unmasked = 1;
    traps_all();
    fedisableexcept(TRAPS_FLAGS);
    printf("traps: none with the exceptions unmasked\n");
    return 1;
}

static void traps_ask_one(const char *kind, unsigned long index)
{
    const int hard = strncmp(kind, "hard ", 5) == 0;
    const char *what = hard ? kind + 5 : kind;
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(TRAPS_FLAGS);
    if (strcmp(what, "single") == 0) {
        golden_mix_single(GOLDEN_BASIS, index, hard);
    } else if (strcmp(what, "companion") == 0) {
        golden_mix_companion(GOLDEN_BASIS, index, hard);
    } else if (strncmp(what, "a ", 2) == 0 || strncmp(what, "clip", 4) == 0) {
        static const int scales[8] = {0, 0, 0, -3, 10, 34, 57, -140};
        int i;
        for (i = 0; i < 8; ++i) {
            traps_ask_mesh(index, scales[i]);
        }
    } else {
        golden_mix_grid(GOLDEN_BASIS, index, hard);
    }
    fedisableexcept(TRAPS_FLAGS);
}
#else
static int traps_unmask(void)
{
    return 1;
}

static void traps_ask_one(const char *kind, unsigned long index)
{
    printf("%s %lu: exceptions cannot be unmasked here\n", kind, index);
}
#endif

int main(int argc, char **argv)
{
    int i, ok;
    if (argc >= 3 && argv[1][0] == '-') {
        if (argc > 3) {
            golden_mode(argv[3]);
        }
        traps_ask_one(argv[1] + 1, strtoul(argv[2], NULL, 10));
        return 0;
    }
    golden_part(argc > 1 ? argv[1] : "");
    ok = traps_report("default");
    for (i = 1; i < argc; ++i) {
        if (golden_mode(argv[i])) {
            ok &= traps_report(argv[i]);
        } else if (i > 1 || !golden_part(argv[1])) {
            printf("traps %-8s not known here\n", argv[i]);
        }
    }
    if (ok) {
        ok = traps_unmask();
    }
    return ok ? 0 : 1;
}
