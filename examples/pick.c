/* pick - which triangle is under the pointer? Rays through a mesh, drawn in letters
 *
 *   build/pick [mesh] [columns]       default: the teapot, 76 columns
 *
 * A ray first asks tribox_ray_box of the mesh's bounds, and of those of each block of 64 triangles that
 * follow each other; only then tribox_ray_triangle of the triangles. The nearer a point, the heavier its
 * letter. The ray through the middle is picked and printed:
 *
 *   picked triangle 8117 at t = 0.88, of 573 blocks and 704 triangles asked
 */
#include "program.h"

enum { BLOCK = 64 };

typedef struct bounds {
    float lo[3];
    float hi[3];
} bounds;

typedef struct scene {
    tribox_mesh mesh;
    bounds      all;
    bounds     *blocks;
    size_t      asked_blocks;
    size_t      asked_triangles;
} scene;

static void grow(bounds *b, const float x[3]) {
    int a;
    for (a = 0; a < 3; a++) {
        b->lo[a] = x[a] < b->lo[a] ? x[a] : b->lo[a];
        b->hi[a] = x[a] > b->hi[a] ? x[a] : b->hi[a];
    }
}

static int prepare(scene *s) {
    const bounds nothing = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    size_t t;
    int i;
    s->all = nothing;
    s->blocks = (bounds *)malloc((s->mesh.triangles / BLOCK + 1) * sizeof *s->blocks);
    for (t = 0; t < s->mesh.triangles && s->blocks; t++) {
        bounds *block = &s->blocks[t / BLOCK];
        const float *v[3];
        mesh_corners(&s->mesh, t, v);
        if (t % BLOCK == 0) {
            *block = nothing;
        }
        for (i = 0; i < 3; i++) {
            grow(block, v[i]);
            grow(&s->all, v[i]);
        }
    }
    return s->blocks != NULL;
}

/* The first triangle along the ray and where; the mesh's count if there is none. A t found ends the search
 * behind it. */
static size_t pick(scene *s, const float origin[3], const float dir[3], float *out_t) {
    size_t best = s->mesh.triangles;
    size_t b;
    size_t t;
    *out_t = FLT_MAX;
    if (!tribox_ray_box(origin, dir, 0, *out_t, s->all.lo, s->all.hi, NULL, NULL)) {
        return best;
    }
    for (b = 0; b * BLOCK < s->mesh.triangles; b++) {
        s->asked_blocks++;
        if (!tribox_ray_box(origin, dir, 0, *out_t, s->blocks[b].lo, s->blocks[b].hi, NULL, NULL)) {
            continue;
        }
        for (t = b * BLOCK; t < (b + 1) * BLOCK && t < s->mesh.triangles; t++) {
            const float *v[3];
            float at;
            s->asked_triangles++;
            mesh_corners(&s->mesh, t, v);
            if (tribox_ray_triangle(origin, dir, 0, *out_t, v[0], v[1], v[2], &at) && at < *out_t) {
                *out_t = at;
                best = t;
            }
        }
    }
    return best;
}

int main(int argc, char **argv) {
    static const char letters[] = "@%#*+=-:.";
    char error[MESH_ERROR] = "usage: pick [mesh] [columns from 8 to 400]";
    int asked;
    int columns = 76;
    double longest = 0;
    double middle[3];
    float origin[3];
    scene s;
    mesh m;
    int rows;
    int x;
    int y;
    int a;
    if ((asked = program_arguments("pick", error, &argc, argv)) >= 0) {
        return asked;
    }
    if (argc > 3 || (argc > 2 && !program_int(argv[2], 8, 400, &columns)) ||
        !program_mesh(&m, argc > 1 ? argv[1] : "teapot", error)) {
        return program_fails("pick", error);
    }
    s.mesh = mesh_view(&m);
    if (!prepare(&s)) {
        return program_fails("pick", "out of memory");
    }
    for (a = 0; a < 3; a++) {
        middle[a] = ((double)s.all.lo[a] + (double)s.all.hi[a]) / 2;
        longest = fmax(longest, (double)s.all.hi[a] - (double)s.all.lo[a]);
    }
    origin[0] = (float)middle[0];                       /* in front (-y) and above, looking along y */
    origin[1] = (float)(middle[1] - 2 * longest);
    origin[2] = (float)(middle[2] + longest);
    rows = columns * 2 / 5;
    for (y = 0; y < rows; y++) {
        for (x = 0; x < columns; x++) {
            float dir[3];
            float t;
            double right = (2.0 * x + 1) / columns - 1;
            double up = (rows - 2.0 * y - 1) / columns * 2;
            dir[0] = (float)(longest * right * 0.6);
            dir[1] = (float)(2 * longest + longest * up * 0.25);
            dir[2] = (float)(-longest + longest * up * 0.6);
            s.asked_blocks = s.asked_triangles = 0;
            if (pick(&s, origin, dir, &t) == s.mesh.triangles) {
                putchar(' ');
            } else {
                a = (int)(((double)t - 0.75) / 0.5 * 9);
                putchar(letters[a < 0 ? 0 : a > 8 ? 8 : a]);
            }
        }
        putchar('\n');
    }
    {
        float dir[3];
        float t;
        size_t found;
        for (a = 0; a < 3; a++) {
            dir[a] = (float)(middle[a] - (double)origin[a]);
        }
        s.asked_blocks = s.asked_triangles = 0;
        found = pick(&s, origin, dir, &t);
        if (found < s.mesh.triangles) {
            printf("picked triangle %lu at t = %.2f, ", (unsigned long)found, (double)t);
        } else {
            printf("nothing in the middle, ");
        }
        printf("of %lu blocks and %lu triangles asked\n", (unsigned long)s.asked_blocks,
               (unsigned long)s.asked_triangles);
    }
    free(s.blocks);
    mesh_free(&m);
    return 0;
}
