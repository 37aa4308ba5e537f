/* The scalar code and the best instruction set give the same answers: this file is compiled twice, and the
 * halves' answers are compared byte by byte. SIMD_UNIT names this half's function; SIMD_MAIN marks the
 * half with main. */
#include "tribox.h"

#include "question.h"

enum { SIMD_ANSWERS = 1 << 16, SIMD_MESH = 37, SIMD_ROWS = 9 * 8 };

/* Fills `out` with the answers of every entry to seeded questions; both halves ask the same. */
void SIMD_UNIT(unsigned char *out);
void simd_scalar_answers(unsigned char *out);
void simd_best_answers(unsigned char *out);

static unsigned char simd_tri_answers(const question *q, unsigned flags)
{
    tribox_tri    t32;
    tribox_tri    t64;
    unsigned char r = 0;

    tribox_tri_init_f64(&t64, q->t.v[0], q->t.v[1], q->t.v[2], q->size, flags);
    r = (unsigned char)(tribox_tri_test_f64(&t64, q->lo) |
                        tribox_overlap_rule_f64(q->t.v[0], q->t.v[1], q->t.v[2], q->lo, q->hi, flags) << 1);
    if (q->triangle_is_float && q->lo_is_float && q->hi_is_float && q->size_is_float) {
        tribox_tri_init(&t32, q->ft[0], q->ft[1], q->ft[2], q->fsize, flags);
        r = (unsigned char)(r | tribox_tri_test(&t32, q->flo) << 2 |
                            tribox_overlap_rule(q->ft[0], q->ft[1], q->ft[2], q->flo, q->fhi, flags) << 3);
    }
    return r;
}

/* A fill of `triangles` triangles, so that every tail of a batch occurs, into a region of odd width. */
static void simd_fill_answers(unsigned char *out, int triangles, unsigned flags)
{
    tribox_grid grid = {{-0.3, 0.1, -0.25}, {0.1, 0.125, 0.3}, {-2, -3, -2}, {68, 6, 6}, 0};
    float       positions[9 * SIMD_MESH];
    uint64_t    bits[2 * SIMD_ROWS];
    tribox_mesh mesh;
    int         i;
    int         scale = 1 + random_below(20);

    grid.flags = flags;
    for (i = 0; i < 9 * triangles; i++) {
        positions[i] = i % 9 < 3 ? (float)(random_signed() * 2 + 1) :
                       positions[i - 3] + (float)(random_signed() * scale / 10);
    }
    for (i = 0; i < 2 * SIMD_ROWS; i++) {
        bits[i] = 0;
    }
    mesh.positions = positions;
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = (size_t)triangles;
    tribox_grid_fill(&grid, &mesh, bits);
    for (i = 0; i < 2 * SIMD_ROWS; i++) {
        int b;
        for (b = 0; b < 8; b++) {
            out[8 * i + b] = (unsigned char)(bits[i] >> (8 * b));
        }
    }
}

void SIMD_UNIT(unsigned char *out)
{
    int used = 0;
    int i = 0;

    random_seed(71);
    while (used < SIMD_ANSWERS / 2) {
        question q;
        int      k;
        question_make(&q, i % QUESTION_KINDS, i / QUESTION_KINDS & 1);
        i++;
        for (k = 0; k < 4 && q.has_box && q.has_voxel; k++) {
            out[used++] = simd_tri_answers(&q, every_rule[k]);
        }
    }
    for (i = 0; used + 16 * SIMD_ROWS <= SIMD_ANSWERS; i++) {
        simd_fill_answers(out + used, i % SIMD_MESH + 1, every_rule[i % 4]);
        used += 16 * SIMD_ROWS;
    }
    for (; used < SIMD_ANSWERS; used++) {
        out[used] = 0;
    }
}

#ifdef SIMD_MAIN

/* Both halves give the same bytes, and the bytes are not all alike. */
static void scalar_and_best_code_give_the_same_answers(void)
{
    static unsigned char scalar[SIMD_ANSWERS];
    static unsigned char best[SIMD_ANSWERS];
    long                 different = 0;
    long                 set = 0;
    int                  i;

    simd_scalar_answers(scalar);
    simd_best_answers(best);
    for (i = 0; i < SIMD_ANSWERS; i++) {
        different += scalar[i] != best[i];
        set += scalar[i] != 0;
    }
    CHECK(different == 0);
    CHECK(set > SIMD_ANSWERS / 10 && set < SIMD_ANSWERS);
}

int main(void)
{
    RUN(scalar_and_best_code_give_the_same_answers);
    return test_report("test_simd");
}

#endif
