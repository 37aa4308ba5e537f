/* verify: every entry of tribox.h against exact answers, on millions of hard cases.
 *
 *   build/verify [thousands of one-box cases] [seed] [processes]
 *
 * The judge is separating axes in GMP integers; one case in eight is also clipped in GMP rationals, and the
 * two must agree. The companions have judges and second methods of their own (companions_exact.h), and their
 * times, corners and weights are compared bit by bit. For the class "flip", and for companions, two adjacent
 * floating-point numbers are found by bisection of one coordinate between which the exact answer changes, and
 * both are asked. A broken judge (verify_exact.h and companions_exact.h list how it is broken) is run beside
 * the true one on some cases: each way must come to light, however few cases were asked for, else the cases
 * would not reveal such a header.
 * Needs GMP and POSIX; the program prints its seed, what it asked, and every wrong answer as hex floats. The last
 * line counts the rows of its table: "N passed, N failed".
 */
#define _DEFAULT_SOURCE
#include "companions_answers.h"
#include "verify_cases.h"
#include "verify_companions.h"
#include "verify_solid.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ROW_FLIP = CASES, ROW_WALK, ROW_FILL, ROW_SOLID, ROW_LOCATE, ROW_COMPANION, ROWS = ROW_COMPANION + COMPANIONS };

static const char *row_name(int row)
{
    static const char *const more[ROW_COMPANION - CASES] = {"flip", "grid walks (rows)", "fills (voxels)", "solids (rows)",
                                                            "locate"};
    return row < CASES           ? case_names[row]
           : row < ROW_COMPANION ? more[row - CASES]
                                 : companion_names[row - ROW_COMPANION];
}

/* what the processes count, in shared memory */
typedef struct tally {
    uint64_t asked[ROWS];    /* questions: one triangle, one box, all rules */
    uint64_t answers[ROWS];  /* answers of the header compared */
    uint64_t overlap[ROWS];  /* questions whose closed answer is 1 */
    uint64_t touching[ROWS]; /* questions where some axis has an exact contact */
    uint64_t both[ROWS];     /* questions answered by both methods */
    uint64_t wrong[ROWS];
    uint64_t disagree[ROWS];
    uint64_t mutant_tried[EXACT_MUTANTS];
    uint64_t mutant_caught[EXACT_MUTANTS];
    uint64_t companion_mutant_tried[COMPANION_MUTANTS];
    uint64_t companion_mutant_caught[COMPANION_MUTANTS];
} tally;

typedef struct run {
    exact_judge x;
    exact_judge other;
    companion_work work;
    crossing_judge solid;
    dice d;
    tally *count;
    uint64_t seed;
    int row;
    int printed;
    int mutant;           /* a broken judge that every question is put to; 0: one at random, now and then */
    int companion_mutant; /* likewise of the companions */
} run;

/* ---- reports ---------------------------------------------------------------------------------- */

static void print_question(const question *ask)
{
    static const char *const kinds[3] = {"box_min box_max", "p size", "origin size"};
    int i;
    for (i = 0; i < 15; ++i) {
        printf("%s%a", i % 3 == 0 ? "\n    " : ", ", ask->x[i]);
    }
    printf("\n    (v0 v1 v2 %s)", kinds[ask->kind]);
    if (ask->kind == ASK_GRID) {
        printf(" voxels %d..%d, %d..%d, %d..%d", ask->index[0], ask->last[0], ask->index[1], ask->last[1],
               ask->index[2], ask->last[2]);
    }
    printf("\n");
}

static void report(run *r, const char *what, unsigned flags, long long got, long long want,
                   const question *ask)
{
    ++r->count->wrong[r->row];
    if (r->printed < 10) {
        ++r->printed;
        printf("WRONG %s flags %u: got %lld, exact %lld; class %s, seed %llu", what, flags, got, want,
               row_name(r->row), (unsigned long long)r->seed);
        print_question(ask);
        fflush(stdout);
    }
}

static void expect(run *r, const char *what, unsigned flags, int got, int want, const question *ask)
{
    ++r->count->answers[r->row];
    if (got != want) {
        report(r, what, flags, got, want, ask);
    }
}

/* ---- truth ------------------------------------------------------------------------------------ */

/* the mask of rules, cross-checked now and then */
static unsigned truth(run *r, const question *ask)
{
    unsigned rules = exact_axes(&r->x, ask);
    ++r->count->asked[r->row];
    r->count->overlap[r->row] += rules & 1u << RULE_CLOSED ? 1 : 0;
    r->count->touching[r->row] += r->x.touching ? 1 : 0;
    if (dice_once_in(&r->d, 8)) {
        unsigned clipped = exact_clip(&r->other, ask);
        ++r->count->both[r->row];
        if (clipped != rules) {
            ++r->count->disagree[r->row];
            printf("METHODS DISAGREE: axes %x, clipping %x, seed %llu", rules, clipped,
                   (unsigned long long)r->seed);
            print_question(ask);
        }
    }
    if (dice_once_in(&r->d, 8) || r->mutant != 0) {
        int mutant = r->mutant != 0 ? r->mutant : dice_between(&r->d, 1, EXACT_MUTANTS - 1);
        ++r->count->mutant_tried[mutant];
        if (exact_axes_mutant(&r->other, ask, mutant) != rules) {
            ++r->count->mutant_caught[mutant];
        }
    }
    return rules;
}

static int truth_of(unsigned rules, unsigned flags, int kind)
{
    if (kind == ASK_BOX && (flags & TRIBOX_THIN) != 0) {
        return (int)(rules >> RULE_CLOSED & 1u);
    }
    return (int)(rules >> rule_of(flags) & 1u);
}

/* ---- the header's answers --------------------------------------------------------------------- */

static void narrow(float out[15], const double x[15])
{
    int i;
    for (i = 0; i < 15; ++i) {
        out[i] = (float)x[i];
    }
}

static int all_floats(const double *x, int n)
{
    int i;
    for (i = 0; i < n; ++i) {
        if (!is_float(x[i])) {
            return 0;
        }
    }
    return 1;
}

static void judge_box(run *r, const question *ask, unsigned rules)
{
    const double *x = ask->x;
    float f[15];
    unsigned flags;
    int narrowable = all_floats(x, 15);
    if (narrowable) {
        narrow(f, x);
        expect(r, "tribox_overlap", 0, tribox_overlap(f, f + 3, f + 6, f + 9, f + 12),
               truth_of(rules, 0, ASK_BOX), ask);
    }
    expect(r, "tribox_overlap_f64", 0, tribox_overlap_f64(x, x + 3, x + 6, x + 9, x + 12),
           truth_of(rules, 0, ASK_BOX), ask);
    for (flags = 0; flags < 5; ++flags) {
        unsigned more = flags | (dice_once_in(&r->d, 8) ? 0xfffffff8u : 0u);
        int want = truth_of(rules, flags, ASK_BOX);
        expect(r, "tribox_overlap_rule_f64", more,
               tribox_overlap_rule_f64(x, x + 3, x + 6, x + 9, x + 12, more), want, ask);
        if (narrowable) {
            expect(r, "tribox_overlap_rule", more, tribox_overlap_rule(f, f + 3, f + 6, f + 9, f + 12, more),
                   want, ask);
        }
    }
}

static void judge_tri(run *r, const question *ask, unsigned rules)
{
    const double *x = ask->x;
    float f[15];
    unsigned flags;
    int narrow_set = all_floats(x, 9) && all_floats(x + 12, 3);
    int narrow_p = all_floats(x + 9, 3);
    narrow(f, x);
    for (flags = 0; flags < 5; ++flags) {
        tribox_tri tri;
        unsigned more = flags == 4 ? 4u | (unsigned)dice_below(&r->d, 4) : flags;
        int want = truth_of(rules, more, ASK_TRI);
        tribox_tri_init_f64(&tri, x, x + 3, x + 6, x + 12, more);
        expect(r, "tribox_tri_init_f64, _test_f64", more, tribox_tri_test_f64(&tri, x + 9), want, ask);
        if (narrow_p) {
            expect(r, "tribox_tri_init_f64, _test", more, tribox_tri_test(&tri, f + 9), want, ask);
        }
        if (narrow_set) {
            tribox_tri_init(&tri, f, f + 3, f + 6, f + 12, more);
            expect(r, "tribox_tri_init, _test_f64", more, tribox_tri_test_f64(&tri, x + 9), want, ask);
            if (narrow_p) {
                expect(r, "tribox_tri_init, _test", more, tribox_tri_test(&tri, f + 9), want, ask);
            }
        }
    }
}

static void question_grid(const question *ask, unsigned flags, tribox_grid *grid)
{
    int i;
    for (i = 0; i < 3; ++i) {
        grid->origin[i] = ask->x[9 + i];
        grid->size[i] = ask->x[12 + i];
        grid->lo[i] = ask->index[i];
        grid->hi[i] = ask->last[i] + 1;
    }
    grid->flags = flags;
}

static void judge_voxel(run *r, const question *ask, unsigned rules)
{
    const double *x = ask->x;
    unsigned flags;
    for (flags = 0; flags < 5; ++flags) {
        tribox_grid grid;
        int want = truth_of(rules, flags, ASK_GRID);
        question_grid(ask, flags, &grid);
        expect(r, "tribox_grid_spans_f64", flags,
               (int)tribox_grid_spans_f64(&grid, x, x + 3, x + 6, NULL, NULL), want, ask);
        if (all_floats(x, 9)) {
            float f[15];
            narrow(f, x);
            expect(r, "tribox_grid_spans", flags, (int)tribox_grid_spans(&grid, f, f + 3, f + 6, NULL, NULL),
                   want, ask);
        }
    }
}

static void judge(run *r, const question *ask)
{
    unsigned rules = truth(r, ask);
    if (ask->kind == ASK_BOX) {
        judge_box(r, ask, rules);
    } else if (ask->kind == ASK_TRI) {
        judge_tri(r, ask, rules);
    } else {
        judge_voxel(r, ask, rules);
    }
}

/* ---- single questions ------------------------------------------------------------------------- */

/* format of number i of a question: a grid's numbers are doubles, whatever the triangle's are */
static int number_format(const question *ask, int i, int f64)
{
    return f64 || (ask->kind == ASK_GRID && i >= 9);
}

static void make_question(run *r, int which, int f64, question *ask)
{
    int kind = dice_below(&r->d, 3);
    memset(ask, 0, sizeof *ask);
    case_make(&r->d, which, f64, ask->x);
    if (kind == ASK_TRI) {
        case_as_tri(ask, f64);
    } else if (kind == ASK_GRID) {
        case_as_grid(&r->d, ask);
    }
}

/* Moves one number until the answer under one rule changes, then closes in on the two adjacent numbers
 * between which it does. Each is judged under all rules. Returns 0 if no change was found. */
static int flip(run *r, question *ask, int f64)
{
    unsigned rule = 1u << dice_below(&r->d, RULES);
    int i = dice_below(&r->d, 15);
    int wide = number_format(ask, i, f64);
    unsigned here = exact_axes(&r->x, ask) & rule;
    double from = ask->x[i];
    int64_t a = number_key(from, wide);
    int64_t b = a;
    int tries;
    if (!is_finite(from)) {
        return 0;
    }
    for (tries = 0; tries < 12; ++tries) {
        double reach = power_of_two(2 * tries - 16) * (dice_once_in(&r->d, 2) ? 1.0 : -1.0);
        ask->x[i] = number_fit(from + reach, wide);
        if (is_finite(ask->x[i]) && (exact_axes(&r->x, ask) & rule) != here) {
            b = number_key(ask->x[i], wide);
            break;
        }
    }
    if (a == b) {
        return 0;
    }
    while (b - a > 1 || a - b > 1) {
        int64_t m = a / 2 + b / 2 + (a % 2 + b % 2) / 2;
        ask->x[i] = key_number(m, wide);
        if ((exact_axes(&r->x, ask) & rule) == here) {
            a = m;
        } else {
            b = m;
        }
    }
    ask->x[i] = key_number(a, wide);
    judge(r, ask);
    ask->x[i] = key_number(b, wide);
    judge(r, ask);
    return 1;
}

static void single_questions(run *r, long cases)
{
    question ask;
    while (cases > 0) {
        int which = dice_below(&r->d, CASES);
        int f64 = dice_once_in(&r->d, 2);
        if (which == CASE_RANDOM && !dice_once_in(&r->d, 4)) {
            which = CASE_CONTACT;
        }
        make_question(r, which, f64, &ask);
        if (which != CASE_SPECIAL && which != CASE_BITS && dice_once_in(&r->d, 4)) {
            r->row = ROW_FLIP;
            if (flip(r, &ask, f64)) {
                cases -= 2;
            }
        } else {
            r->row = which;
            judge(r, &ask);
            --cases;
        }
    }
}

/* ---- grid walks ------------------------------------------------------------------------------- */

#define WALK_SPANS 4096

typedef struct spans {
    int n;
    int overflow;
    int at[WALK_SPANS][4]; /* x0 x1 y z */
} spans;

static void take_span(void *user, int x0, int x1, int y, int z)
{
    spans *s = (spans *)user;
    if (s->n == WALK_SPANS) {
        s->overflow = 1;
        return;
    }
    s->at[s->n][0] = x0;
    s->at[s->n][1] = x1;
    s->at[s->n][2] = y;
    s->at[s->n][3] = z;
    ++s->n;
}

static int clamp_index(const mpz_t index)
{
    if (!mpz_fits_sint_p(index)) {
        return mpz_sgn(index) < 0 ? INT32_MIN : INT32_MAX;
    }
    return (int)mpz_get_si(index);
}

static int clamp_add(int a, long long b)
{
    long long sum = (long long)a + b;
    return sum < INT32_MIN ? INT32_MIN : sum > INT32_MAX ? INT32_MAX : (int)sum;
}

/* a triangle and a grid in one of several styles; `ask` holds numbers and no voxel yet */
static void make_walk(run *r, question *ask, int f64)
{
    static const double steps[5] = {0.1, 1.0 / 3.0, 0.3, 0.25, 1.0};
    dice *d = &r->d;
    double *x = ask->x;
    int style = dice_below(d, 10);
    double reach = (double)dice_between(d, 1, 6);
    int i;
    memset(ask, 0, sizeof *ask);
    ask->kind = ASK_GRID;
    for (i = 0; i < 3; ++i) { /* non-cubic, about one unit a voxel */
        x[9 + i] = dice_signed(d);
        x[12 + i] = 0.5 + dice_unit(d);
    }
    shape_triangle(d, x, reach);
    if (style == 1 || style == 2) { /* corners on grid points, up to rounding */
        for (i = 0; i < 3; ++i) {
            x[12 + i] = dice_once_in(d, 2) ? steps[dice_below(d, 5)] : nearest_float(steps[dice_below(d, 5)]);
            x[9 + i] = style == 1 ? 0.0 : number_fit(dice_signed(d) * 1e3, f64);
        }
        for (i = 0; i < 9; ++i) {
            x[i] = x[9 + i % 3] + (double)dice_between(d, -6, 6) * x[12 + i % 3];
        }
    } else if (style == 3) { /* aligned with a unit grid, 45-degree edges among them */
        for (i = 0; i < 3; ++i) {
            x[9 + i] = (double)dice_between(d, -3, 3);
            x[12 + i] = dice_once_in(d, 4) ? 0.5 : 1.0;
        }
        for (i = 0; i < 9; ++i) {
            x[i] = (double)dice_between(d, -12, 12) / 2.0;
        }
        shape_aligned(d, x);
    } else if (style == 4) {
        shape_degenerate(d, x);
    } else if (style == 5) { /* far indices */
        for (i = 0; i < 3; ++i) {
            int index = dice_once_in(d, 2) ? dice_between(d, 2147483600, 2147483646)
                                           : -dice_between(d, 1, 2147483647);
            x[9 + i] -= (double)index * x[12 + i];
        }
    } else if (style == 6) { /* huge, and almost parallel to an axis */
        int a = dice_below(d, 3);
        for (i = 0; i < 9; ++i) {
            x[i] = 1e6 * dice_signed(d);
        }
        for (i = 0; i < 3; ++i) {
            x[3 * i + a] = dice_signed(d) * (dice_once_in(d, 2) ? 1.0 : 1e-6);
        }
    } else if (style == 7) { /* a few voxels */
        for (i = 0; i < 9; ++i) {
            x[i] *= 0.3;
        }
    } else if (style == 8) {
        shape_sliver(d, x, f64);
    } else if (style == 9) {
        int e = f64 ? dice_between(d, -1074, 1010) : dice_between(d, -149, 120);
        scale_all(x, power_of_two(e));
    }
    for (i = 0; i < 9; ++i) {
        x[i] = number_fit(x[i], f64);
        if (dice_once_in(d, 24)) {
            x[i] = number_step(x[i], dice_between(d, -1, 1), f64);
        }
    }
    for (i = 12; i < 15; ++i) {
        if (sign_of_double(x[i]) <= 0) {
            x[i] = 0x1p-1074;
        }
    }
}

/* A region around a point of the triangle, at most `most` long in y and z: its index box cut somewhere, and
 * one more voxel around it. In x it may be as long as can be. */
static int make_region(run *r, question *ask, int most)
{
    dice *d = &r->d;
    mpz_t index;
    double at[3];
    int i, k, ok = 1;
    mpz_init(index);
    shape_point(d, ask->x, 3, at);
    for (k = 0; k < 3 && ok; ++k) {
        double lo = ask->x[k];
        double hi = ask->x[k];
        int first, last, here, reach;
        for (i = 1; i < 3; ++i) {
            lo = ask->x[3 * i + k] < lo ? ask->x[3 * i + k] : lo;
            hi = ask->x[3 * i + k] > hi ? ask->x[3 * i + k] : hi;
        }
        ok = exact_index(&r->x, lo, ask->x[9 + k], ask->x[12 + k], index);
        first = clamp_add(clamp_index(index), -2);
        ok = ok && exact_index(&r->x, hi, ask->x[9 + k], ask->x[12 + k], index);
        last = clamp_add(clamp_index(index), 1);
        ok = ok && exact_index(&r->x, at[k], ask->x[9 + k], ask->x[12 + k], index);
        here = clamp_index(index);
        reach = dice_between(d, 1, most / 2);
        if (k == 0 && dice_once_in(d, 3)) {
            reach = dice_once_in(d, 2) ? 2147483647 : 1 << dice_between(d, 4, 30);
        }
        if (first < clamp_add(here, -reach)) {
            first = clamp_add(here, -reach);
        }
        if (last > clamp_add(here, reach)) {
            last = clamp_add(here, reach);
        }
        if (dice_once_in(d, 3) && (long long)last - first < 64) {
            first = clamp_add(first, dice_between(d, 0, 2));
            last = clamp_add(last, -dice_between(d, 0, 2));
        }
        if (last == INT32_MAX) {
            --last;
        }
        ask->index[k] = first;
        ask->last[k] = last;
        ok = ok && first <= last;
    }
    mpz_clear(index);
    return ok;
}

/* order, maximality, region and count of the spans, whatever the triangle is */
static void check_form(run *r, const question *ask, unsigned flags, const spans *s, size_t count)
{
    size_t sum = 0;
    int i;
    for (i = 0; i < s->n; ++i) {
        const int *a = s->at[i];
        int inside = a[0] >= ask->index[0] && a[1] <= ask->last[0] && a[0] <= a[1] && a[2] >= ask->index[1] &&
                     a[2] <= ask->last[1] && a[3] >= ask->index[2] && a[3] <= ask->last[2];
        int ordered = 1;
        if (i > 0) {
            const int *b = s->at[i - 1];
            ordered = a[3] > b[3] || (a[3] == b[3] && a[2] > b[2]);
        }
        expect(r, "spans inside the region", flags, inside, 1, ask);
        expect(r, "spans ordered, one a row", flags, ordered, 1, ask);
        sum += (size_t)((unsigned)a[1] - (unsigned)a[0]) + 1;
    }
    ++r->count->answers[r->row];
    if (sum != count) {
        report(r, "voxels counted", flags, (long long)count, (long long)sum, ask);
    }
}

static int voxels_hit(run *r, const question *ask, unsigned rule, int x0, int x1, int y, int z)
{
    question part = *ask;
    part.index[0] = x0;
    part.last[0] = x1;
    part.index[1] = y;
    part.last[1] = y;
    part.index[2] = z;
    part.last[2] = z;
    return (int)(truth(r, &part) >> rule & 1u);
}

static void expect_voxel(run *r, const question *ask, unsigned flags, int got, int x, int y, int z)
{
    question part = *ask;
    int want = voxels_hit(r, ask, rule_of(flags), x, x, y, z);
    int k;
    for (k = 0; k < 3; ++k) {
        part.index[k] = k == 0 ? x : k == 1 ? y : z;
        part.last[k] = part.index[k];
    }
    expect(r, "voxel of tribox_grid_spans_f64", flags, got, want, &part);
}

/* No span in this row. Under the closed and half-open rules its voxels together are one box; else each is
 * asked. */
static void check_empty_row(run *r, const question *ask, unsigned flags, int y, int z)
{
    unsigned rule = rule_of(flags);
    int joined = rule != RULE_THIN;
    if (joined && !voxels_hit(r, ask, rule, ask->index[0], ask->last[0], y, z)) {
        ++r->count->answers[r->row];
        return;
    }
    if (rule == RULE_CLOSED || rule == RULE_HALF_OPEN) {
        report(r, "row of tribox_grid_spans_f64", flags, 0, 1, ask);
        printf("    row y %d z %d\n", y, z);
        return;
    }
    if ((long long)ask->last[0] - ask->index[0] < 64) {
        int x;
        for (x = ask->index[0]; x <= ask->last[0]; ++x) {
            expect_voxel(r, ask, flags, 0, x, y, z);
        }
    } else {
        int i;
        for (i = 0; i < 8; ++i) {
            expect_voxel(r, ask, flags, 0, clamp_add(ask->index[0], i), y, z);
            expect_voxel(r, ask, flags, 0, clamp_add(ask->last[0], -i), y, z);
        }
    }
}

/* A row's set is an interval under every rule, so a span is right if its ends are in and their neighbours are
 * not. */
static void check_rows(run *r, const question *ask, unsigned flags, const spans *s)
{
    int i = 0, y, z;
    for (z = ask->index[2]; z <= ask->last[2]; ++z) {
        for (y = ask->index[1]; y <= ask->last[1]; ++y) {
            const int *a = s->at[i];
            if (i == s->n || a[2] != y || a[3] != z) {
                check_empty_row(r, ask, flags, y, z);
                continue;
            }
            expect_voxel(r, ask, flags, 1, a[0], y, z);
            if (a[1] != a[0]) {
                expect_voxel(r, ask, flags, 1, a[1], y, z);
            }
            if (a[0] > ask->index[0]) {
                expect_voxel(r, ask, flags, 0, a[0] - 1, y, z);
            }
            if (a[1] < ask->last[0]) {
                expect_voxel(r, ask, flags, 0, a[1] + 1, y, z);
            }
            ++i;
        }
    }
}

static int same_spans(const spans *a, const spans *b)
{
    int i, k;
    if (a->n != b->n) {
        return 0;
    }
    for (i = 0; i < a->n; ++i) {
        for (k = 0; k < 4; ++k) {
            if (a->at[i][k] != b->at[i][k]) {
                return 0;
            }
        }
    }
    return 1;
}

static void walk(run *r, const question *ask, unsigned flags)
{
    static spans wide, narrowed;
    const double *x = ask->x;
    tribox_grid grid;
    size_t count;
    question_grid(ask, flags, &grid);
    wide.n = 0;
    wide.overflow = 0;
    count = tribox_grid_spans_f64(&grid, x, x + 3, x + 6, take_span, &wide);
    expect(r, "spans within the rows", flags, wide.overflow, 0, ask);
    if (all_floats(x, 9)) {
        float f[15];
        narrow(f, x);
        narrowed.n = 0;
        narrowed.overflow = 0;
        tribox_grid_spans(&grid, f, f + 3, f + 6, take_span, &narrowed);
        expect(r, "tribox_grid_spans and _f64 agree", flags, same_spans(&wide, &narrowed), 1, ask);
    }
    check_form(r, ask, flags, &wide, count);
    check_rows(r, ask, flags, &wide);
}

static void walks(run *r, long n)
{
    while (n-- > 0) {
        question ask;
        int f64 = dice_once_in(&r->d, 2);
        r->row = ROW_WALK;
        make_walk(r, &ask, f64);
        if (!make_region(r, &ask, dice_once_in(&r->d, 4) ? 40 : 12)) {
            continue;
        }
        walk(r, &ask, 1u << dice_below(&r->d, 4) >> 1);
    }
}

/* ---- fills and locate ------------------------------------------------------------------------- */

#define FILL_TRIANGLES 6
#define FILL_COPIES 48      /* so many that a fill takes them several at a time */
#define FILL_EDGE 48

/* marks voxels in bits of the test's own layout: one byte a voxel */
typedef struct marks {
    const question *ask;
    unsigned char at[FILL_EDGE][FILL_EDGE][FILL_EDGE];
} marks;

static void mark_span(void *user, int x0, int x1, int y, int z)
{
    marks *m = (marks *)user;
    int x;
    for (x = x0; x <= x1; ++x) {
        m->at[z - m->ask->index[2]][y - m->ask->index[1]][x - m->ask->index[0]] = 1;
    }
}

/* A triangle of at most four voxels somewhere in the region, its corners at simple places of the grid, up to
 * rounding: what the fill's quick way for small triangles must get right. */
static void make_small(run *r, const question *ask, double v[9])
{
    dice *d = &r->d;
    const double steps[4] = {1.0, 2.0, 4.0, 16.0};
    const double step = steps[dice_below(d, 4)];
    int voxels = dice_between(d, 1, 4);
    int i, k;
    for (k = 0; k < 3; ++k) {
        int first = dice_between(d, ask->index[k] - 1, ask->last[k]);
        for (i = 0; i < 3; ++i) {
            double at = (double)dice_between(d, 0, voxels * (int)step) / step;
            if (dice_once_in(d, 8)) {
                at = (double)voxels * dice_unit(d);
            }
            at = ask->x[9 + k] + ((double)first + at) * ask->x[12 + k];
            v[3 * i + k] = number_fit(at, 0);
            if (dice_once_in(d, 8)) {
                v[3 * i + k] = number_step(v[3 * i + k], dice_between(d, -2, 2), 0);
            }
        }
    }
    if (dice_once_in(d, 8)) {
        shape_sliver(d, v, 0);
    } else if (dice_once_in(d, 4)) {
        shape_aligned(d, v);
    }
}

/* A mesh of a few triangles: the bits of its fill are those of the spans of each (which walks() judges
 * exactly), padding bits stay clear, and words around the array stay as they were. */
static void fill(run *r)
{
    static marks want;
    static uint64_t bits[FILL_EDGE * FILL_EDGE * 2 + 2];
    const uint64_t guard = UINT64_C(0x5555aaaa12345678);
    float positions[9 * FILL_TRIANGLES];
    uint32_t indices[3 * FILL_COPIES];
    question ask, next;
    tribox_grid grid;
    tribox_mesh mesh;
    size_t words;
    int n = dice_between(&r->d, 1, FILL_TRIANGLES);
    int i, k, x, y, z;
    unsigned flags = 1u << dice_below(&r->d, 4) >> 1;
    make_walk(r, &ask, 0);
    if (!make_region(r, &ask, 12) || (long long)ask.last[0] - ask.index[0] >= FILL_EDGE) {
        return;
    }
    question_grid(&ask, flags, &grid);
    memset(want.at, 0, sizeof want.at);
    want.ask = &ask;
    for (i = 0; i < n; ++i) {
        next = ask;
        if (dice_once_in(&r->d, 8)) {
            make_walk(r, &next, 0);
        } else if (i > 0) {
            make_small(r, &ask, next.x);
        }
        for (k = 0; k < 9; ++k) {
            positions[9 * i + k] = (float)number_fit(next.x[k], 0);
        }
        tribox_grid_spans(&grid, positions + 9 * i, positions + 9 * i + 3, positions + 9 * i + 6, mark_span,
                          &want);
    }
    mesh.positions = positions;
    mesh.stride = 0;
    for (i = 0; i < 3 * FILL_COPIES; ++i) {
        indices[i] = (uint32_t)(i % (3 * n));
    }
    mesh.indices = dice_below(&r->d, 4) ? indices : NULL;
    mesh.triangles = mesh.indices ? FILL_COPIES : (size_t)n;
    words = tribox_grid_words(&grid);
    expect(r, "tribox_grid_words", flags,
           words == (size_t)(ask.last[1] - ask.index[1] + 1) * (size_t)(ask.last[2] - ask.index[2] + 1) *
                        (size_t)((ask.last[0] - ask.index[0]) / 64 + 1),
           1, &ask);
    if (words > sizeof bits / sizeof bits[0] - 2) {
        return;
    }
    memset(bits, 0, sizeof bits);
    bits[0] = guard;
    bits[words + 1] = guard;
    tribox_grid_fill(&grid, &mesh, bits + 1);
    expect(r, "words around the array kept", flags, bits[0] == guard && bits[words + 1] == guard, 1, &ask);
    for (z = 0; z <= ask.last[2] - ask.index[2]; ++z) {
        for (y = 0; y <= ask.last[1] - ask.index[1]; ++y) {
            uint64_t word = bits[1 + z * (ask.last[1] - ask.index[1] + 1) + y];
            for (x = 0; x <= ask.last[0] - ask.index[0]; ++x) {
                int got =
                    tribox_grid_get(&grid, bits + 1, ask.index[0] + x, ask.index[1] + y, ask.index[2] + z);
                ++r->count->asked[r->row];
                expect(r, "voxel of tribox_grid_fill", flags, got, want.at[z][y][x], &ask);
                expect(r, "bit of tribox_grid_fill", flags, (int)(word >> x & 1u), want.at[z][y][x], &ask);
            }
            expect(r, "padding of tribox_grid_fill", flags, x < 64 && word >> x != 0, 0, &ask);
        }
    }
}

/* A mesh of a few triangles in a region: in each row the bits are those that GMP flips; padding stays, and words
 * around the array; doubles alike where there are none but floats. Points near corners and edges, too. */
static void solid_points(run *r, const double *v, const float *t, const question *ask)
{
    static const double no_step[3] = {0, 0, 0};
    static const int64_t no_half[3] = {0, 0, 0};
    tribox_mesh_f64 mesh;
    double point[3];
    int want, k;
    for (k = 0; k < 3; ++k) {
        double at = dice_once_in(&r->d, 2) ? v[3 * dice_below(&r->d, 3) + k] : 0.5 * v[k] + 0.5 * v[3 + k];
        point[k] = number_step(at, dice_between(&r->d, -1, 1), 1);
    }
    want = is_finite(point[0]) && is_finite(point[1]) && is_finite(point[2]) &&
           crossing_crosses(&r->solid, v, point, no_step, no_half);
    mesh.positions = v;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    expect(r, "tribox_mesh_contains_f64", 0, tribox_mesh_contains_f64(&mesh, point), want, ask);
    if (t != NULL) {
        expect(r, "tribox_ray_crosses", 0, tribox_ray_crosses(t, t + 3, t + 6, point), want, ask);
    }
}

static void solid(run *r)
{
    static uint64_t bits[FILL_EDGE * FILL_EDGE * 2 + 2];
    static uint64_t doubles[FILL_EDGE * FILL_EDGE * 2 + 2];
    double v[9 * FILL_TRIANGLES];
    float positions[9 * FILL_TRIANGLES];
    question ask, next;
    tribox_grid grid;
    tribox_mesh mesh;
    tribox_mesh_f64 mesh_f64;
    size_t words;
    int64_t half[3];
    int n = dice_between(&r->d, 1, FILL_TRIANGLES);
    int f64 = dice_once_in(&r->d, 4);
    int rows, columns, i, k, x, y, z;
    make_walk(r, &ask, f64);
    if (!make_region(r, &ask, 8) || (long long)ask.last[0] - ask.index[0] >= FILL_EDGE) {
        return;
    }
    question_grid(&ask, 0, &grid);
    for (i = 0; i < n; ++i) {
        next = ask;
        if (dice_once_in(&r->d, 8)) {
            make_walk(r, &next, f64);
        } else if (i > 0) {
            make_small(r, &ask, next.x);
        }
        for (k = 0; k < 9; ++k) {
            v[9 * i + k] = number_fit(next.x[k], f64);
            if (dice_once_in(&r->d, 16)) { /* on a line of centres, up to rounding */
                double at =
                    ask.x[9 + k % 3] +
                    ((double)dice_between(&r->d, ask.index[k % 3], ask.last[k % 3]) + 0.5) * ask.x[12 + k % 3];
                v[9 * i + k] = is_finite(at) ? number_fit(at, f64) : v[9 * i + k];
            }
            positions[9 * i + k] = (float)number_fit(v[9 * i + k], 0);
        }
    }
    mesh.positions = positions;
    mesh_f64.positions = v;
    mesh.stride = mesh_f64.stride = 0;
    mesh.indices = mesh_f64.indices = NULL;
    mesh.triangles = mesh_f64.triangles = (size_t)n;
    words = tribox_grid_words(&grid);
    if (words > sizeof bits / sizeof bits[0] - 2) {
        return;
    }
    memset(bits, 0, sizeof bits);
    memset(doubles, 0, sizeof doubles);
    tribox_grid_fill_solid_f64(&grid, &mesh_f64, doubles + 1);
    if (f64) {
        memcpy(bits, doubles, sizeof bits);
    } else {
        tribox_grid_fill_solid(&grid, &mesh, bits + 1);
        expect(r, "tribox_grid_fill_solid_f64", 0, memcmp(bits, doubles, sizeof bits) == 0, 1, &ask);
    }
    expect(r, "words around the solid kept", 0, bits[0] == 0 && bits[words + 1] == 0, 1, &ask);
    columns = ask.last[0] - ask.index[0] + 1;
    rows = ask.last[1] - ask.index[1] + 1;
    for (z = 0; z <= ask.last[2] - ask.index[2] && words != 0; ++z) {
        for (y = 0; y < rows; ++y) {
            uint64_t want = 0;
            half[1] = 2 * (int64_t)(ask.index[1] + y) + 1;
            half[2] = 2 * (int64_t)(ask.index[2] + z) + 1;
            for (i = 0; i < n; ++i) {
                x = crossing_first(&r->solid, v + 9 * i, grid.origin, grid.size, half, grid.lo[0], columns);
                want ^= ((uint64_t)1 << columns) - ((uint64_t)1 << x);
            }
            ++r->count->asked[r->row];
            expect(r, "row of tribox_grid_fill_solid", 0, bits[1 + z * rows + y] == want, 1, &ask);
        }
    }
    for (i = 0; i < n; ++i) {
        solid_points(r, v + 9 * i, f64 ? NULL : positions + 9 * i, &ask);
    }
}

/* a point on or near a voxel's corner */
static void locate(run *r)
{
    mpz_t index;
    tribox_grid grid;
    question ask;
    double point[3];
    int want = 1, k, got, right = 1;
    int expected[3];
    int out[3] = {0, 0, 0};
    make_walk(r, &ask, 1);
    mpz_init(index);
    for (k = 0; k < 3; ++k) {
        double at = ask.x[9 + k] + (double)dice_between(&r->d, -9, 9) * ask.x[12 + k];
        point[k] = number_step(dice_once_in(&r->d, 3) ? ask.x[k] : at, dice_between(&r->d, -2, 2), 1);
        if (dice_once_in(&r->d, 64)) {
            point[k] = special_number(&r->d, 1);
        }
        if (!exact_index(&r->x, point[k], ask.x[9 + k], ask.x[12 + k], index)) {
            want = 0;
            expected[k] = 0;
        } else {
            expected[k] = clamp_index(index);
            want &= mpz_fits_sint_p(index) && expected[k] != INT32_MAX;
        }
        ask.index[k] = clamp_add(expected[k], -dice_between(&r->d, 0, 3));
        ask.last[k] = clamp_add(expected[k], dice_between(&r->d, -1, 3));
        if (ask.last[k] == INT32_MAX) {
            ask.last[k] = INT32_MAX - 1;
        }
        want &= ask.index[k] <= expected[k] && expected[k] <= ask.last[k];
        ask.x[k] = point[k];
    }
    mpz_clear(index);
    question_grid(&ask, 0, &grid);
    got = tribox_grid_locate(&grid, point, out);
    ++r->count->asked[r->row];
    expect(r, "tribox_grid_locate (point in v0)", 0, got, want, &ask);
    for (k = 0; k < 3 && want; ++k) {
        right &= out[k] == expected[k];
    }
    expect(r, "index of tribox_grid_locate (point in v0)", 0, right, 1, &ask);
}

/* ---- companions ------------------------------------------------------------------------------- */

static void print_companion(const companion *ask, const companion_answer *got, const companion_answer *want)
{
    int i;
    printf("    f64 %d flags %u", ask->f64, ask->flags);
    for (i = 0; i < COMPANION_NUMBERS; ++i) {
        printf("%s%a", i == COMPANION_T1 || i % 3 != 0 ? ", " : "\n    ",
               companion_number(ask->x[i], ask->f64));
    }
    printf("\n    (v0 v1 v2 box_min box_max w o t_min t_max)\n    got   %d:", got->value);
    for (i = 0; i < got->n; ++i) {
        printf(" %a", companion_number(got->word[i], ask->f64));
    }
    for (i = 0; i < 3; ++i) {
        printf(" %a", companion_number(got->axis[i], 0));
    }
    printf("\n    exact %d:", want->value);
    for (i = 0; i < want->n; ++i) {
        printf(" %a", companion_number(want->word[i], ask->f64));
    }
    printf("\n");
}

static void companion_report(run *r, const char *what, const companion *ask, const companion_answer *got,
                             const companion_answer *want)
{
    if (r->printed < 10) {
        ++r->printed;
        printf("%s %s, seed %llu\n", what, companion_names[ask->which], (unsigned long long)r->seed);
        print_companion(ask, got, want);
        fflush(stdout);
    }
}

/* Outputs may be left out, and the others are the same then. */
static int companion_same_without(run *r, const companion *ask, const companion_answer *got)
{
    float x[COMPANION_NUMBERS];
    double y[COMPANION_NUMBERS];
    float t[2] = {0.0f, 0.0f};
    double u[2] = {0.0, 0.0};
    uint32_t word = 0;
    int which = dice_below(&r->d, 4);
    int value = got->value;
    int i;
    int same = 1;
    companion_floats(x, ask->x, COMPANION_NUMBERS);
    memcpy(y, ask->x, sizeof y);
    if (ask->which == COMPANION_RAY_BOX && ask->f64) {
        value = tribox_ray_box_f64(y + COMPANION_O, y + COMPANION_W, y[COMPANION_T0], y[COMPANION_T1],
                                   y + COMPANION_LO, y + COMPANION_HI, which & 1 ? u : NULL,
                                   which & 2 ? u + 1 : NULL);
    } else if (ask->which == COMPANION_RAY_BOX) {
        value = tribox_ray_box(x + COMPANION_O, x + COMPANION_W, x[COMPANION_T0], x[COMPANION_T1],
                               x + COMPANION_LO, x + COMPANION_HI, which & 1 ? t : NULL,
                               which & 2 ? t + 1 : NULL);
    } else if (ask->which == COMPANION_SWEEP) {
        value = tribox_sweep(x, x + 3, x + 6, x + COMPANION_LO, x + COMPANION_HI, x + COMPANION_W,
                             which & 1 ? t : NULL, which & 2 ? t + 1 : NULL, NULL);
    } else if (ask->which == COMPANION_RAY_TRIANGLE) {
        which = 0;
        value = ask->f64 ? tribox_ray_triangle_f64(y + COMPANION_O, y + COMPANION_W, y[COMPANION_T0],
                                                   y[COMPANION_T1], y, y + 3, y + 6, NULL)
                         : tribox_ray_triangle(x + COMPANION_O, x + COMPANION_W, x[COMPANION_T0],
                                               x[COMPANION_T1], x, x + 3, x + 6, NULL);
    } else {
        return 1;
    }
    for (i = 0; i < 2 && value; ++i) {
        uint64_t wide;
        memcpy(&word, t + i, sizeof word);
        memcpy(&wide, u + i, sizeof wide);
        same &= !(which >> i & 1) || got->word[i] == (ask->f64 ? wide : word);
    }
    return value == got->value && same;
}

static void companion_question(run *r, const companion *ask)
{
    companion_answer got, want, wrong;
    int mutant = dice_once_in(&r->d, 2) ? dice_between(&r->d, 1, COMPANION_MUTANTS - 1) : 0;
    int right;
    mutant = r->companion_mutant != 0 ? r->companion_mutant : mutant;
    mutant = companion_mutant_applies(ask->which, mutant) ? mutant : 0;
    companion_ask(ask, &got);
    companion_judge(&r->work, ask, WRONG_NOTHING, &want);
    right = companion_same(&got, &want);
    if (!companion_is_near(&r->work, ask->which, &got, &want)) {
        right = 0;
    }
    if (companion_moves(ask->which) && want.value) {
        r->count->touching[r->row] += mpq_equal(r->work.first, r->work.last) ? 1 : 0;
    }
    ++r->count->asked[r->row];
    r->count->answers[r->row] += 1 + (uint64_t)want.n;
    r->count->overlap[r->row] += want.value != 0 ? 1 : 0;
    right = right && companion_same_without(r, ask, &got);
    if (!right) {
        ++r->count->wrong[r->row];
        companion_report(r, "WRONG", ask, &got, &want);
    }
    if (dice_once_in(&r->d, 8)) {
        ++r->count->both[r->row];
        if (!companion_confirm(&r->work, ask, &want)) {
            ++r->count->disagree[r->row];
            companion_report(r, "METHODS DISAGREE:", ask, &got, &want);
        }
    }
    if (mutant != 0) {
        companion_judge(&r->work, ask, mutant, &wrong);
        ++r->count->companion_mutant_tried[mutant];
        if (!companion_same(&wrong, &want) ||
            (right && !companion_is_near(&r->work, ask->which, &got, &wrong))) {
            ++r->count->companion_mutant_caught[mutant];
        }
    }
}

static int companion_value(run *r, const companion *ask)
{
    companion_answer answer;
    companion_judge(&r->work, ask, WRONG_NOTHING, &answer);
    return answer.value;
}

/* Moves one number until the answer changes, closes in on the two neighbours between which it does, and asks
 * both. */
static void companion_flip(run *r, companion *ask)
{
    double x[COMPANION_NUMBERS];
    const int i = dice_below(&r->d, ask->which == COMPANION_OCTANTS ? COMPANION_W : COMPANION_NUMBERS);
    const int here = companion_value(r, ask);
    int64_t a, b;
    int k, tries;
    for (k = 0; k < COMPANION_NUMBERS; ++k) {
        x[k] = companion_number(ask->x[k], ask->f64);
    }
    if (!is_finite(x[i])) {
        return;
    }
    a = number_key(x[i], ask->f64);
    b = a;
    for (tries = 0; tries < 12 && a == b; ++tries) {
        double reach = power_of_two(2 * tries - 16) * (dice_once_in(&r->d, 2) ? 1.0 : -1.0);
        x[i] = number_fit(key_number(a, ask->f64) + reach, ask->f64);
        companion_write(ask, x);
        if (is_finite(x[i]) && companion_value(r, ask) != here) {
            b = number_key(x[i], ask->f64);
        }
    }
    if (a == b) {
        return;
    }
    while (b - a > 1 || a - b > 1) {
        int64_t m = a / 2 + b / 2 + (a % 2 + b % 2) / 2;
        x[i] = key_number(m, ask->f64);
        companion_write(ask, x);
        if (companion_value(r, ask) == here) {
            a = m;
        } else {
            b = m;
        }
    }
    for (k = 0; k < 2; ++k) {
        x[i] = key_number(k == 0 ? a : b, ask->f64);
        companion_write(ask, x);
        companion_question(r, ask);
    }
}

static void companion_once(run *r, int which)
{
    companion ask;
    int class = dice_below(&r->d, CASES);
    r->row = ROW_COMPANION + which;
    companion_make(&r->d, which, class, &ask);
    if (class != CASE_SPECIAL && class != CASE_BITS && which != COMPANION_CLOSEST &&
        which != COMPANION_GRID_SEGMENT && dice_once_in(&r->d, 16)) {
        companion_flip(r, &ask);
    } else {
        companion_question(r, &ask);
    }
}

static void companions(run *r, int n)
{
    while (n-- > 0) {
        int which = dice_below(&r->d, COMPANIONS + 3);
        which = which < COMPANIONS        ? which
                : which == COMPANIONS + 2 ? COMPANION_GAP
                                          : COMPANION_SWEEP; /* more of these: they have 13 axes */
        companion_once(r, which);
    }
}

/* ---- the whole -------------------------------------------------------------------------------- */

static void work(run *r, long thousands)
{
    long i;
    for (i = 0; i < thousands; ++i) { /* mixed, so that a short run sees everything too */
        int k;
        single_questions(r, 1000);
        walks(r, 12);
        for (k = 0; k < 20; ++k) {
            r->row = ROW_FILL;
            fill(r);
        }
        for (k = 0; k < 20; ++k) {
            r->row = ROW_SOLID;
            solid(r);
        }
        for (k = 0; k < 200; ++k) {
            r->row = ROW_LOCATE;
            locate(r);
        }
        companions(r, 800);
    }
}

#define INSIST 200000 /* the rarest broken judge comes to light once in 300 questions */

/* A short run may put few questions to a broken judge. Those that it did not reveal are asked on, of the functions
 * that they concern, until they are or INSIST questions did not: so what was not caught is never mere chance. */
static void insist(run *r)
{
    int mutant, which, n;
    for (mutant = 1; mutant < EXACT_MUTANTS; ++mutant) {
        r->mutant = mutant;
        for (n = 0; n < INSIST && r->count->mutant_caught[mutant] == 0; ++n) {
            single_questions(r, 1);
        }
    }
    r->mutant = 0;
    for (mutant = 1; mutant < COMPANION_MUTANTS; ++mutant) {
        r->companion_mutant = mutant;
        for (n = 0; n < INSIST && r->count->companion_mutant_caught[mutant] == 0;) {
            which = dice_below(&r->d, COMPANIONS);
            if (companion_mutant_applies(which, mutant)) {
                companion_once(r, which);
                ++n;
            }
        }
    }
    r->companion_mutant = 0;
}

static int print_mutant(const char *name, uint64_t caught, uint64_t tried)
{
    printf("  %-20s %8llu of %8llu%s\n", name, (unsigned long long)caught, (unsigned long long)tried,
           caught == 0 ? "  NOT CAUGHT" : "");
    return caught == 0;
}

/* the rows that are not as they should be */
static int print_table(const tally *t)
{
    int bad = 0;
    uint64_t asked = 0, answers = 0;
    int i;
    printf("%-20s %10s %10s %10s %10s %10s %6s\n", "class", "questions", "answers", "overlap", "touching",
           "two ways", "wrong");
    for (i = 0; i < ROWS; ++i) {
        printf("%-20s %10llu %10llu %10llu %10llu %10llu %6llu\n", row_name(i),
               (unsigned long long)t->asked[i], (unsigned long long)t->answers[i],
               (unsigned long long)t->overlap[i], (unsigned long long)t->touching[i],
               (unsigned long long)t->both[i],
               (unsigned long long)(t->wrong[i] + t->disagree[i]));
        bad += t->wrong[i] + t->disagree[i] != 0;
        asked += t->asked[i];
        answers += t->answers[i];
    }
    printf("%-20s %10llu %10llu\n", "total", (unsigned long long)asked, (unsigned long long)answers);
    printf("judges broken on purpose, and cases that reveal it:\n");
    for (i = 1; i < EXACT_MUTANTS; ++i) {
        bad += print_mutant(exact_mutant_names[i], t->mutant_caught[i], t->mutant_tried[i]);
    }
    for (i = 1; i < COMPANION_MUTANTS; ++i) {
        bad += print_mutant(companion_mutant_names[i], t->companion_mutant_caught[i],
                            t->companion_mutant_tried[i]);
    }
    return bad;
}

static void begin(run *r, tally *count, uint64_t seed, int process)
{
    exact_init(&r->x);
    exact_init(&r->other);
    crossing_init(&r->solid);
    companion_init(&r->work);
    r->count = count;
    r->seed = seed;
    r->d.state = seed * UINT64_C(0x2545f4914f6cdd1d) + (uint64_t)process * UINT64_C(0xd1342543de82ef95);
}

int main(int argc, char **argv)
{
    static run last;
    long thousands = argc > 1 ? atol(argv[1]) : 100;
    uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 0) : 1;
    int processes = argc > 3 ? atoi(argv[3]) : 1;
    int i, status, crashed = 0;
    int bad;
    tally *counts = (tally *)mmap(NULL, sizeof(tally) * (size_t)processes, PROT_READ | PROT_WRITE,
                                  MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (counts == MAP_FAILED) {
        perror("mmap");
        return 2;
    }
    printf("verify: seed %llu, %ld thousand single questions, %d processes\n", (unsigned long long)seed,
           thousands, processes);
    fflush(stdout);
    for (i = 0; i < processes; ++i) {
        pid_t child = fork();
        if (child < 0) {
            perror("fork");
            return 2;
        }
        if (child == 0) {
            static run r;
            begin(&r, counts + i, seed, i);
            work(&r, thousands / processes + (i < thousands % processes));
            fflush(stdout);
            _exit(0);
        }
    }
    while (wait(&status) > 0) {
        crashed |= !WIFEXITED(status) || WEXITSTATUS(status) != 0;
    }
    for (i = 1; i < processes; ++i) {
        size_t k;
        for (k = 0; k < sizeof(tally) / sizeof(uint64_t); ++k) {
            ((uint64_t *)(void *)counts)[k] += ((uint64_t *)(void *)(counts + i))[k];
        }
    }
    begin(&last, counts, seed, processes);
    insist(&last);
    bad = print_table(counts);
    printf("verify: %s\n", crashed ? "CRASHED" : bad != 0 ? "FAILED" : "every answer is exact");
    bad += crashed;
    printf("%d passed, %d failed\n", ROWS + EXACT_MUTANTS + COMPANION_MUTANTS - 2 + crashed - bad, bad);
    return bad != 0;
}
