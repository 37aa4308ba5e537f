/* One function per reported bug, named after its issue; the numbers are those of the report. How to add one stands
 * in tests/README.md.
 *
 * Infinities come from bits, through memory: under -ffast-math a compiler takes no float constant, parameter or
 * result for infinite. `make platforms` builds this file with the compilers and flags of each report. */
#include "tribox.h"

#include <fenv.h>
#include <string.h>

#include "question.h"

#define INFINITE 0x7f800000u

/* x, with every 999 replaced by +infinity and -999 by -infinity */
TEST_FN void with_infinities(float *out, const float *x, int count)
{
    int i;

    for (i = 0; i < count; i++) {
        const uint32_t bits = x[i] < 0 ? INFINITE | 0x80000000u : INFINITE;
        memcpy(out + i, x + i, sizeof *out);
        if (x[i] == 999.0f || x[i] == -999.0f) {
            memcpy(out + i, &bits, sizeof bits);
        }
    }
}

static uint32_t bits_of(const float *x)
{
    uint32_t bits;

    memcpy(&bits, x, sizeof bits);
    return bits;
}

/* Issue 10: clang 19 and 22 with -ffast-math take float parameters for neither NaN nor infinite. A triangle with an
 * infinite corner is no set of points, whoever is asked. */
static void issue_10_a_triangle_with_an_infinite_corner_is_no_set(void)
{
    static const float given[9] = {999, 0, 0, 1, 0, 0, 0, 1, 0};
    const float  lo[3] = {0, 0, 0};
    const float  hi[3] = {1, 1, 1};
    const float  velocity[3] = {0, 0, 1};
    const float  nearby[3] = {0, 0, 1};
    float        t[9];
    float        polygon[9][3];
    float        times[2];
    float        three[3];
    tribox_mesh  mesh;
    tribox_grid  grid;
    unsigned     flags;
    int          a;

    with_infinities(t, given, 9);
    mesh.positions = t;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    for (flags = 0; flags < 8; flags++) {
        tribox_tri tri;
        CHECK(tribox_overlap_rule(t, t + 3, t + 6, lo, hi, flags) == 0);
        tribox_tri_init(&tri, t, t + 3, t + 6, hi, flags);
        CHECK(tribox_tri_test(&tri, lo) == 0);
        CHECK(tribox_tri_octants(&tri, lo) == 0);
        for (a = 0; a < 3; a++) {
            grid.origin[a] = 0;
            grid.size[a] = 0.25;
            grid.lo[a] = 0;
            grid.hi[a] = 4;
        }
        grid.flags = flags;
        CHECK(tribox_grid_spans(&grid, t, t + 3, t + 6, NULL, NULL) == 0);
    }
    CHECK(tribox_overlap(t, t + 3, t + 6, lo, hi) == 0);
    CHECK(tribox_mesh_query(&mesh, lo, hi, NULL, 0) == 0);
    CHECK(tribox_clip(t, t + 3, t + 6, lo, hi, polygon) == 0);
    CHECK(tribox_sweep(t, t + 3, t + 6, lo, hi, velocity, times, times + 1, three) == 0);
    tribox_closest(t, t + 3, t + 6, nearby, three);
    CHECK(three[0] == 1.0f && three[1] == 0.0f && three[2] == 0.0f);
}

/* Issue 10: the same, where it overwrote the stack. */
static void issue_10_infinite_corners_do_not_overwrite_the_stack(void)
{
    static const float given[9] = {999, 3, 2, 1, 1, 1, 3, 4, 1};
    const float  q[3] = {3, 3, 0};
    const float  lo[3] = {1, 1, 1};
    const float  hi[3] = {3, 2, 2};
    const float  velocity[3] = {1, 1, 2};
    float        t[9];
    float        polygon[9][3];
    float        times[2];
    float        three[3];

    with_infinities(t, given, 9);
    tribox_closest(t, t + 3, t + 6, q, three);
    CHECK(three[0] == 1.0f && three[1] == 0.0f && three[2] == 0.0f);
    CHECK(tribox_sweep(t, t + 3, t + 6, lo, hi, velocity, times, times + 1, three) == 0);
    CHECK(tribox_clip(t, t + 3, t + 6, lo, hi, polygon) == 0);
    CHECK(tribox_ray_triangle(q, velocity, 0, 8, t, t + 3, t + 6, times) == 0);
}

/* Issue 10: framing a mesh whose only triangle has an infinite corner never came back. */
static void issue_10_framing_an_infinite_triangle_ends(void)
{
    static const float given[9] = {0, 0, 0, 1, 999, 0, 0, 1, -999};
    float       t[9];
    tribox_mesh mesh;
    tribox_grid grid;

    with_infinities(t, given, 9);
    mesh.positions = t;
    mesh.stride = 0;
    mesh.indices = NULL;
    mesh.triangles = 1;
    CHECK(tribox_grid_fit(&grid, &mesh, 100) == 0);
    CHECK(tribox_grid_words(&grid) == 0);
}

/* Issue 10: a half-space is a box. */
static void issue_10_an_infinite_size_is_a_half_space(void)
{
    static const float given[3] = {999, 999, 999};
    const float  t[9] = {5, 5, 5, 6, 5, 5, 5, 6, 7};
    const float  p[3] = {1, 1, 1};
    const float  beyond[3] = {1, 1, 8};
    float        size[3];
    unsigned     flags;

    with_infinities(size, given, 3);
    for (flags = 0; flags < 8; flags++) {
        tribox_tri tri;
        tribox_tri_init(&tri, t, t + 3, t + 6, size, flags);
        CHECK(tribox_tri_test(&tri, p) == 1);
        CHECK(tribox_tri_test(&tri, beyond) == 0);
    }
}

/* Issue 10: a ray has t up to infinity. It comes by value: who compiles with -ffinite-math-only cannot pass it, but
 * gcc and old clang can, and so can everyone whose own code is compiled without. */
static void issue_10_a_ray_without_end_meets_a_triangle(void)
{
#if !defined(__FINITE_MATH_ONLY__) || !__FINITE_MATH_ONLY__
    static const float given[1] = {999};
    const float  origin[3] = {0.25f, 0.25f, -1};
    const float  dir[3] = {0, 0, 1};
    const float  t[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    float        endless;
    float        at = -1;

    with_infinities(&endless, given, 1);
    CHECK(tribox_ray_triangle(origin, dir, 0, endless, t, t + 3, t + 6, &at) == 1);
    CHECK(at == 1.0f);
#endif
}

/* The processor's other modes, where this file knows how: 1 if it is set. */
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__SSE__))
static int issue_flush(int on)
{
    unsigned mode;

    __asm__ __volatile__("stmxcsr %0" : "=m"(mode));
    mode = on ? mode | 0x8040u : mode & ~0x8040u;
    __asm__ __volatile__("ldmxcsr %0" : : "m"(mode) : "memory");
    return 1;
}
#elif defined(__GNUC__) && defined(__aarch64__)
static int issue_flush(int on)
{
    uint64_t mode;

    __asm__ __volatile__("mrs %0, fpcr" : "=r"(mode));
    mode = on ? mode | (uint64_t)1 << 24 : mode & ~((uint64_t)1 << 24);
    __asm__ __volatile__("msr fpcr, %0" : : "r"(mode) : "memory");
    return 1;
}
#else
static int issue_flush(int on)
{
    return on - on;
}
#endif

#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
static void issue_precision(unsigned control) /* 0: 24 bits, 2: 53, 3: 64 */
{
    unsigned short word;

    __asm__ __volatile__("fnstcw %0" : "=m"(word));
    word = (unsigned short)((word & ~0x300u) | control << 8);
    __asm__ __volatile__("fldcw %0" : : "m"(word) : "memory");
}
#else
static void issue_precision(unsigned control)
{
    (void)control;
}
#endif

/* Issue 10: clang 19 and 22 turn a test of a float's bits into a comparison, which reads subnormals as zero where
 * the processor is told to. */
static void issue_10_subnormals_count_where_they_are_flushed(void)
{
    static const uint32_t tiny_bits = 71362; /* 1e-40 */
    static const uint64_t least_bits = 1;    /* 5e-324 */
    const float  origin[3] = {0, 0, 0};
    float        dir[3] = {0, 1, 1};
    float        lo[3] = {0, 1, 1};
    const float  hi[3] = {1, 2, 2};
    const double v[9] = {0, 0, 1, 2, 0, 2, 0, 2, 2};
    double       size[3] = {1, 1, 0};
    const double p[3] = {0, 0, 1};
    float        t[2] = {-1, -1};
    tribox_tri   tri;
    int          ray;
    int          thin_box;

    memcpy(dir, &tiny_bits, sizeof tiny_bits);
    memcpy(lo, &tiny_bits, sizeof tiny_bits);
    memcpy(size + 2, &least_bits, sizeof least_bits);
    issue_flush(1);
    ray = tribox_ray_box(origin, dir, 0, 8, lo, hi, t, t + 1);
    tribox_tri_init_f64(&tri, v, v + 3, v + 6, size, TRIBOX_HALF_OPEN);
    thin_box = tribox_tri_test_f64(&tri, p);
    issue_flush(0);
    CHECK(ray == 1);
    CHECK(bits_of(t) == 0x3f800000u && bits_of(t + 1) == 0x40000000u);
    CHECK(thin_box == 1);
}

/* Issue 10: Direct3D 9 leaves x87 at 24 bits; then a prepared triangle on a grid of tenths was set up for ever, and
 * most spans of doubles were wrong. (Where x87 is not used this is no question.) */
static void issue_10_x87_at_24_bits_changes_no_answer(void)
{
    const double size[3] = {0.1, 0.1, 0.1};
    tribox_grid  grid;
    int          a;
    int          i;
    int          wrong = 0;

    for (a = 0; a < 3; a++) {
        grid.origin[a] = -0.3;
        grid.size[a] = 0.1;
        grid.lo[a] = 0;
        grid.hi[a] = 12;
    }
    grid.flags = 0;
    random_seed(110);
    for (i = 0; i < TEST_LOOPS(2000); i++) {
        double     v[9];
        double     p[3];
        tribox_tri tri;
        size_t     count[2];
        int        touches[2];
        unsigned   octants[2];
        int        low;
        for (a = 0; a < 9; a++) {
            v[a] = random_below(12) * 0.1 - 0.3;
        }
        for (a = 0; a < 3; a++) {
            p[a] = random_below(12) * 0.1 - 0.3;
        }
        for (low = 0; low < 2; low++) {
            issue_precision(low ? 0 : 3);
            tribox_tri_init_f64(&tri, v, v + 3, v + 6, size, 0);
            touches[low] = tribox_tri_test_f64(&tri, p);
            octants[low] = tribox_tri_octants_f64(&tri, p);
            count[low] = tribox_grid_spans_f64(&grid, v, v + 3, v + 6, NULL, NULL);
            issue_precision(3);
        }
        wrong += touches[0] != touches[1] || octants[0] != octants[1] || count[0] != count[1];
    }
    CHECK(wrong == 0);
}

/* Issue 11: gcc -O2 -ffast-math summed in another order where the last digits decide. */
static void issue_11_octants_of_doubles_are_not_reassociated(void)
{
    static const double v[9] = {-0x1.3869999999999p+13, 0x1.b333333333335p+0, 0x1.3884666666666p+13,
                                -0x1.3869999999999p+13, 0x1.b333333333335p+0, 0x1.3883333333333p+13,
                                -0x1.3868cccccccccp+13, 0x1.b333333333335p+0, 0x1.3883333333333p+13};
    static const double size[3] = {0x1.99999999ap-5, 0x1.99999999999ap-5, 0x1.99999999ap-5};
    static const double p[3] = {-0x1.386a666666666p+13, 0x1.b333333333334p+0, 0x1.3884p+13};
    tribox_tri          tri;

    tribox_tri_init_f64(&tri, v, v + 3, v + 6, size, 0);
    CHECK(tribox_tri_octants_f64(&tri, p) == 2);
}

/* Issue 10: a ray along an axis divided by the zero components of its direction. tests/traps.c asks this of every
 * function; here is the smallest case. */
static void issue_10_a_ray_along_an_axis_raises_no_flag(void)
{
#if defined(FE_DIVBYZERO) && defined(FE_INVALID) && defined(FE_OVERFLOW)
    static const float zero = 0;
    const float        origin[3] = {0.5f, 0.5f, -1};
    const float        lo[3] = {0, 0, 0};
    const float        hi[3] = {1, 1, 1};
    float              dir[3] = {0, 0, 1};
    float              t[2];
    int                answer;
    int                flags;

    memcpy(dir, &zero, sizeof zero);
    feclearexcept(FE_ALL_EXCEPT);
    answer = tribox_ray_box(origin, dir, 0, 8, lo, hi, t, t + 1);
    flags = fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    CHECK(answer == 1);
    CHECK(flags == 0);
#endif
}

int main(void)
{
    RUN(issue_10_a_triangle_with_an_infinite_corner_is_no_set);
    RUN(issue_10_infinite_corners_do_not_overwrite_the_stack);
    RUN(issue_10_framing_an_infinite_triangle_ends);
    RUN(issue_10_an_infinite_size_is_a_half_space);
    RUN(issue_10_a_ray_without_end_meets_a_triangle);
    RUN(issue_10_subnormals_count_where_they_are_flushed);
    RUN(issue_10_x87_at_24_bits_changes_no_answer);
    RUN(issue_11_octants_of_doubles_are_not_reassociated);
    RUN(issue_10_a_ray_along_an_axis_raises_no_flag);
    return test_report("test_issues");
}
