/* The companions of doubles: floats taken as doubles have the same answers; times a power of two, into the
 * integers' range and out of the filter's, every answer stays what it is; and the store of limbs is large
 * enough for the worst numbers there are. */
#include "tribox.h"

#include "question.h"

#include <float.h>

typedef struct f64_case {
    double v[3][3];
    double lo[3];
    double hi[3];
    double o[3];
    double w[3];
} f64_case;

/* Lattice points, or floats of 24 bits. */
static void any_case(f64_case *c)
{
    const int lattice = random_below(2);
    int       k;
    int       j;

    for (k = 0; k < 3; k++) {
        double x[7];
        for (j = 0; j < 7; j++) {
            x[j] = lattice ? random_below(9) - 4 : rounded_to_float(random_signed());
        }
        c->v[0][k] = x[0];
        c->v[1][k] = x[1];
        c->v[2][k] = x[2];
        c->lo[k] = x[3] < x[4] ? x[3] : x[4];
        c->hi[k] = x[3] < x[4] ? x[4] : x[3];
        c->o[k] = x[5];
        c->w[k] = x[6];
    }
}

static void scale_case(f64_case *c, double scale)
{
    double *x = c->v[0];
    int     i;

    for (i = 0; i < 21; i++) {
        x[i] *= scale;
    }
}

static void narrow3(float out[3], const double x[3])
{
    int k;

    for (k = 0; k < 3; k++) {
        out[k] = (float)x[k];
    }
}

/* Every answer and output of a case, in a row. */
typedef struct f64_answer {
    int    n[6];
    double t[3];
    double weights[3];
    double polygon[9][3];
} f64_answer;

static void ask_case(const f64_case *c, f64_answer *a)
{
    tribox_mesh_f64 mesh;
    uint32_t        found;

    memset(a, 0, sizeof *a);
    a->n[0] = tribox_box_box_f64(c->lo, c->hi, c->v[0], c->v[1]);
    a->n[1] = tribox_segment_box_f64(c->v[0], c->o, c->lo, c->hi);
    a->n[2] = tribox_ray_box_f64(c->o, c->w, -3, 3, c->lo, c->hi, &a->t[0], &a->t[1]);
    a->n[3] = tribox_ray_triangle_f64(c->o, c->w, -3, 3, c->v[0], c->v[1], c->v[2], &a->t[2]);
    a->n[4] = tribox_clip_f64(c->v[0], c->v[1], c->v[2], c->lo, c->hi, a->polygon);
    tribox_closest_f64(c->v[0], c->v[1], c->v[2], c->o, a->weights);
    mesh.positions = c->v[0];
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    a->n[5] = (int)tribox_mesh_query_f64(&mesh, c->lo, c->hi, &found, 1);
}

/* Is the float at or above (below) the double, and not more than an ulp away? */
static int rounds_to(double x, float f, int up)
{
    const double g = (double)f;
    const double step = g > 0 ? g * 1.2e-7 : g * -1.2e-7;

    return up ? g >= x && g - step <= x : g <= x && g + step >= x;
}

/* The answer for floats is that for the same numbers as doubles, and its outputs are the same, rounded. */
static void floats_as_doubles_have_the_same_answers(void)
{
    int i;

    random_seed(81);
    for (i = 0; i < TEST_LOOPS(20000); i++) {
        f64_case   c;
        f64_answer a;
        float      v[3][3];
        float      lo[3];
        float      hi[3];
        float      o[3];
        float      w[3];
        float      t[3] = {0, 0, 0};
        float      weights[3];
        float      polygon[9][3];
        int        k;
        any_case(&c);
        ask_case(&c, &a);
        narrow3(v[0], c.v[0]);
        narrow3(v[1], c.v[1]);
        narrow3(v[2], c.v[2]);
        narrow3(lo, c.lo);
        narrow3(hi, c.hi);
        narrow3(o, c.o);
        narrow3(w, c.w);
        CHECK(tribox_box_box(lo, hi, v[0], v[1]) == a.n[0]);
        CHECK(tribox_segment_box(v[0], o, lo, hi) == a.n[1]);
        CHECK(tribox_ray_box(o, w, -3, 3, lo, hi, &t[0], &t[1]) == a.n[2]);
        CHECK(!a.n[2] || (rounds_to(a.t[0], t[0], 0) && rounds_to(a.t[1], t[1], 1)));
        CHECK(tribox_ray_triangle(o, w, -3, 3, v[0], v[1], v[2], &t[2]) == a.n[3]);
        CHECK(!a.n[3] || rounds_to(a.t[2], t[2], 0));
        CHECK(tribox_clip(v[0], v[1], v[2], lo, hi, polygon) <= a.n[4]);
        tribox_closest(v[0], v[1], v[2], o, weights);
        for (k = 0; k < 3; k++) {
            CHECK(weights[k] <= (float)a.weights[k] && weights[k] >= (float)a.weights[k]);
        }
        CHECK(a.n[5] == tribox_overlap(v[0], v[1], v[2], lo, hi));
        CHECK((a.n[4] > 0) == a.n[5]);
    }
}

/* Times a power of two nothing changes but coordinates, which are multiplied: 2^40 stays in the filter's
 * range, the others are asked in integers. */
static void powers_of_two_change_nothing(void)
{
    static const int exponents[4] = {40, 900, -300, -900};
    int              i;

    random_seed(82);
    for (i = 0; i < TEST_LOOPS(3000); i++) {
        const double scale = power_of_two(exponents[i % 4]);
        f64_case     c;
        f64_answer   a;
        f64_answer   b;
        int          k;
        any_case(&c);
        ask_case(&c, &a);
        scale_case(&c, scale);
        ask_case(&c, &b);
        for (k = 0; k < 3 * a.n[4]; k++) {
            a.polygon[k / 3][k % 3] *= scale;
        }
        CHECK(memcmp(&a, &b, sizeof a) == 0);
    }
}

/* Subnormals, to the last bit: 3, 5 and 7 units of the least double. */
static void subnormals_are_numbers(void)
{
    const double unit = DBL_MIN * DBL_EPSILON;
    const double lo[3] = {3 * unit, 0, 0};
    const double hi[3] = {5 * unit, 1, 1};
    const double o[3] = {0, 0.5, 0.5};
    const double w[3] = {7 * unit, 0, 0};
    const double beside[3] = {-unit, 2, 2};
    double       t0 = 0;
    double       t1 = 0;

    CHECK(tribox_ray_box_f64(o, w, 0, 1, lo, hi, &t0, &t1));
    CHECK(t0 * 7 <= 3 && t0 > 0.42857 && t1 * 7 >= 5 && t1 < 0.71429);
    CHECK(!tribox_box_box_f64(lo, hi, o, o) && tribox_box_box_f64(lo, hi, lo, lo));
    CHECK(!tribox_segment_box_f64(o, beside, lo, hi));
}

enum { WORST = 32768 };

static tbx_limb worst_store[WORST];

static void worst_begin(tbx_calc *c)
{
    memset(worst_store, 0xa5, sizeof worst_store);
    c->exact = 1;
    c->unsure = 0;
    c->used = 0;
    c->store = worst_store;
}

/* Bytes of the store that were written. */
static size_t worst_end(void)
{
    tbx_limb fresh;
    size_t   n = WORST;

    memset(&fresh, 0xa5, sizeof fresh);
    while (n > 0 && worst_store[n - 1] == fresh) {
        n--;
    }
    return n * sizeof fresh;
}

/* From 2^-1074 to 2^1024, with all bits in between; as bits, where a program may read subnormals as zero. */
static double worst_number(void)
{
    const uint64_t most = UINT64_C(0x7fefffffffffffff) - random_bits() % (UINT64_C(1) << 50);
    const uint64_t least = (uint64_t)(1 + random_below(1000));
    const uint64_t bits = (random_below(2) ? most : least) | (random_bits() >> 63) << 63;
    double         x;

    memcpy(&x, &bits, sizeof x);
    return x;
}

/* No run in integers writes more than the 12 KiB that the header keeps for it. */
static void the_store_holds_the_worst_numbers(void)
{
    size_t most = 0;
    int    i;
    int    k;

    random_seed(83);
    for (i = 0; i < TEST_LOOPS(2000); i++) {
        tbx_calc     c;
        tbx_nearest  nearest;
        tbx_shot     shot;
        tbx_cut      cut;
        tbx_polygon  polygon;
        tbx_fraction t;
        double       x[21];
        int64_t      weights[3] = {0, 0, 0};
        int64_t      corners[9][3];
        size_t       written;
        int          verdict;
        for (k = 0; k < 21; k++) {
            x[k] = worst_number();
        }
        tbx_read(nearest.v[0], x, 9, TBX_DOUBLE);
        tbx_read(nearest.q, x + 9, 3, TBX_DOUBLE);
        worst_begin(&c);
        tbx_nearest_run(&c, &nearest, TBX_DOUBLE, 1, weights);
        written = worst_end();
        most = written > most ? written : most;
        tbx_read(shot.v[0], x, 9, TBX_DOUBLE);
        tbx_ray_read(&shot.ray, x + 9, x + 12, x + 15, TBX_DOUBLE);
        worst_begin(&c);
        verdict = tbx_shot_run(&c, &shot, &t);
        if (verdict == TBX_HIT) {
            (void)tbx_fraction_round(&c, &t, TBX_DOUBLE, TBX_DOWN);
        }
        written = worst_end();
        most = written > most ? written : most;
        for (k = 0; k < 3; k++) {
            double low = x[9 + k] < x[12 + k] ? x[9 + k] : x[12 + k];
            double high = x[9 + k] < x[12 + k] ? x[12 + k] : x[9 + k];
            tbx_read(&cut.face[0][k], &low, 1, TBX_DOUBLE);
            tbx_read(&cut.face[1][k], &high, 1, TBX_DOUBLE);
        }
        tbx_read(cut.v[0], x, 9, TBX_DOUBLE);
        worst_begin(&cut.calc);
        tbx_cut_run(&cut, &polygon);
        (void)tbx_cut_round(&cut, &polygon, TBX_DOUBLE, corners);
        written = worst_end();
        most = written > most ? written : most;
    }
    if (most > 12288) {
        printf("the store needs %lu bytes\n", (unsigned long)most);
    }
    CHECK(most <= 12288);
    CHECK(most > 6000);
}

int main(void)
{
    RUN(floats_as_doubles_have_the_same_answers);
    RUN(powers_of_two_change_nothing);
    RUN(subnormals_are_numbers);
    RUN(the_store_holds_the_worst_numbers);
    return test_report("test_companions_f64");
}
