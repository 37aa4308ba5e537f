/* bench.h - what every bench shares: a clock, seeded numbers, interleaved runs, and how results are printed.
 *
 * Contenders take turns within every run, so a drifting clock frequency meets all of them alike. A ratio is
 * formed per run, between neighbours in time, and its median is reported beside the ratio of the best times.
 * Include this file before any system header: it asks for the POSIX clock.
 */
#ifndef BENCH_H
#define BENCH_H

#if !defined(_WIN32) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200809L /* -std=c99 hides clock_gettime otherwise */
#endif

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#else
#include <time.h>
#endif

/* The makefile passes these two; a build by hand says so instead of guessing. */
#ifndef BENCH_FLAGS
#define BENCH_FLAGS "flags not recorded"
#endif
#ifndef BENCH_COMMIT
#define BENCH_COMMIT "commit not recorded"
#endif

#if defined(__GNUC__) || defined(__clang__)
#define BENCH_NOINLINE __attribute__((noinline))
#elif defined(_MSC_VER)
#define BENCH_NOINLINE __declspec(noinline)
#else
#define BENCH_NOINLINE
#endif

/* Hides where a pointer came from: what is read through it can be neither hoisted out of a loop nor
 * vectorised. */
#if defined(__GNUC__) || defined(__clang__)
#define BENCH_HIDE(pointer) __asm__ volatile("" : "+r"(pointer))
#else
#define BENCH_HIDE(pointer) ((void)0)
#endif

/* ---- Options ------------------------------------------------------------------------------------------- */

typedef struct bench_options {
    int runs;         /* interleaved runs; 0 lets the bench choose */
    int quick;        /* fewer runs and smaller inputs */
    const char *only; /* print and run only the rows whose name contains this */
    const char *csv;  /* append the rows to this file */
    const char *mesh; /* bench_grid: only this mesh */
    int n;            /* bench_grid: only this resolution */
} bench_options;

static inline int bench_parse(int argc, char **argv, bench_options *options)
{
    int i;
    memset(options, 0, sizeof *options);
    for (i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(argv[i], "--quick") == 0) {
            options->quick = 1;
            continue;
        }
        if (value == NULL) {
            break;
        }
        if (strcmp(argv[i], "--runs") == 0) {
            options->runs = atoi(value);
        } else if (strcmp(argv[i], "--only") == 0) {
            options->only = value;
        } else if (strcmp(argv[i], "--csv") == 0) {
            options->csv = value;
        } else if (strcmp(argv[i], "--mesh") == 0) {
            options->mesh = value;
        } else if (strcmp(argv[i], "--n") == 0) {
            options->n = atoi(value);
        } else {
            break;
        }
        i++;
    }
    if (i < argc) {
        fprintf(stderr,
                "%s: do not understand '%s'\n"
                "usage: %s [--quick] [--runs N] [--only ROW] [--csv FILE] [--mesh NAME] [--n VOXELS]\n",
                argv[0], argv[i], argv[0]);
        return 0;
    }
    return 1;
}

/* ---- Clock and numbers --------------------------------------------------------------------------------- */

/* Seconds from a fixed, arbitrary start. */
static inline double bench_now(void)
{
#ifdef _WIN32
    LARGE_INTEGER ticks;
    LARGE_INTEGER per_second;
    QueryPerformanceCounter(&ticks);
    QueryPerformanceFrequency(&per_second);
    return (double)ticks.QuadPart / (double)per_second.QuadPart;
#else
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
#endif
}

/* splitmix64: a full-period counter, mixed; any seed is a good one. */
static inline uint64_t bench_random(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Uniform in [lo, hi). */
static inline float bench_uniform(uint64_t *state, float lo, float hi)
{
    return lo + (hi - lo) * ((float)(bench_random(state) >> 40) * (1.0f / 16777216.0f));
}

static inline int bench_below(uint64_t *state, int n)
{
    return (int)(bench_random(state) % (uint64_t)n);
}

static inline uint64_t bench_count_bits(const uint64_t *words, size_t count)
{
    uint64_t sum = 0;
    size_t i;
    for (i = 0; i < count; i++) {
        uint64_t word = words[i];
        for (; word != 0; word &= word - 1) {
            sum++;
        }
    }
    return sum;
}

/* malloc that ends the bench with a message: a bench has no use for a half-built input. */
static inline void *bench_alloc(size_t bytes)
{
    void *memory = malloc(bytes > 0 ? bytes : 1);
    if (memory == NULL) {
        fprintf(stderr, "out of memory: %lu bytes\n", (unsigned long)bytes);
        exit(1);
    }
    return memory;
}

/* ---- Where this was measured --------------------------------------------------------------------------- */

static inline const char *bench_isa(void)
{
#if defined(__AVX512F__)
    return "AVX-512";
#elif defined(__AVX2__)
    return "AVX2";
#elif defined(__AVX__)
    return "AVX";
#elif defined(__SSE4_1__)
    return "SSE4.1";
#elif defined(__SSE2__) || defined(_M_X64)
    return "SSE2";
#elif defined(__ARM_NEON)
    return "NEON";
#else
    return "scalar";
#endif
}

static inline const char *bench_compiler(void)
{
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "gcc " __VERSION__;
#elif defined(_MSC_VER)
    return "MSVC";
#else
    return "unknown compiler";
#endif
}

static inline void bench_cpu(char *name, size_t capacity)
{
    const char *found = NULL;
#ifdef _WIN32
    found = getenv("PROCESSOR_IDENTIFIER");
#else
    static char line[256];
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file != NULL && found == NULL && fgets(line, sizeof line, file) != NULL) {
        char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon != NULL) {
            colon[strcspn(colon, "\n")] = '\0';
            found = colon + 2;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
#endif
    snprintf(name, capacity, "%s", found != NULL ? found : "unknown CPU");
}

static inline void bench_header(const char *title)
{
    char cpu[128];
    bench_cpu(cpu, sizeof cpu);
    printf("# %s\n# %s, %s; %s; %s; commit %s\n", title, cpu, bench_isa(), bench_compiler(), BENCH_FLAGS,
           BENCH_COMMIT);
}

/* ---- Rows ---------------------------------------------------------------------------------------------- */

enum { BENCH_MAX_RUNS = 256 };

enum {
    BENCH_REFERENCE,
    BENCH_RIVAL,
    BENCH_OURS,
    BENCH_NOTE
}; /* NOTE: timed and printed, never compared with */

/* One contender: run() does the whole job once and returns the sum of its answers. When given, prepare()
 * comes before it and count() replaces its sum; neither is timed. */
typedef struct bench_row {
    const char *name;
    int role;
    uint64_t (*run)(void *context);
    void (*prepare)(void *context);
    uint64_t (*count)(void *context);
    uint64_t sum;
    int again; /* 0: a rival out of the race, timed once */
    double best;
    double median;
    double seconds[BENCH_MAX_RUNS];
} bench_row;

static inline bench_row *bench_add(bench_row *rows, int *count, const char *name, int role,
                                   uint64_t (*run)(void *context))
{
    bench_row *row = &rows[(*count)++];
    row->name = name;
    row->role = role;
    row->run = run;
    row->prepare = NULL;
    row->count = NULL;
    row->sum = 0;
    return row;
}

static inline int bench_compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline double bench_median(const double *values, int count)
{
    double sorted[BENCH_MAX_RUNS];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, bench_compare_doubles);
    return count % 2 ? sorted[count / 2] : 0.5 * (sorted[count / 2 - 1] + sorted[count / 2]);
}

static inline double bench_once(bench_row *row, void *context)
{
    uint64_t sum;
    double start;
    double seconds;
    if (row->prepare != NULL) {
        row->prepare(context);
    }
    start = bench_now();
    sum = row->run(context);
    seconds = bench_now() - start;
    row->sum = row->count != NULL ? row->sum : sum;
    return seconds;
}

/* A first round, which warms caches and predictors. Rivals it shows to be out of the race, three times slower
 * than another, keep this one time and are not run again. Returns the time that the rows still to be run
 * took. */
static inline double bench_warm(bench_row *rows, int count, void *context)
{
    double fastest = 1e30;
    double total = 0;
    int i;
    int run;
    for (i = 0; i < count; i++) {
        double start = bench_now();
        double seconds = bench_once(&rows[i], context);
        rows[i].seconds[0] = seconds;
        rows[i].best = bench_now() - start;
        if (rows[i].count != NULL) {
            rows[i].sum = rows[i].count(context);
        }
        fastest = rows[i].role == BENCH_RIVAL && seconds < fastest ? seconds : fastest;
    }
    for (i = 0; i < count; i++) {
        rows[i].again =
            rows[i].role != BENCH_RIVAL || rows[i].seconds[0] < 0.1 || rows[i].seconds[0] <= 3 * fastest;
        total += rows[i].again ? rows[i].best : 0;
        for (run = 1; run < BENCH_MAX_RUNS; run++) {
            rows[i].seconds[run] = rows[i].seconds[0];
        }
    }
    return total;
}

/* Times every row once per run, in turn, as many of the wanted runs as fit into the budget of seconds, but
 * three in any case. Returns the runs made. */
static inline int bench_measure(bench_row *rows, int count, int runs, double budget, void *context)
{
    double fitting = budget / bench_warm(rows, count, context);
    int least = runs < 3 ? runs : 3;
    int run;
    int i;
    runs = runs < BENCH_MAX_RUNS ? runs : BENCH_MAX_RUNS;
    runs = fitting > runs ? runs : fitting < least ? least : (int)fitting;
    for (run = 0; run < runs; run++) {
        for (i = 0; i < count; i++) {
            if (rows[i].again) {
                rows[i].seconds[run] = bench_once(&rows[i], context);
            }
        }
    }
    for (i = 0; i < count; i++) {
        rows[i].median = bench_median(rows[i].seconds, runs);
        rows[i].best = rows[i].seconds[0];
        for (run = 1; run < runs; run++) {
            rows[i].best = rows[i].seconds[run] < rows[i].best ? rows[i].seconds[run] : rows[i].best;
        }
    }
    return runs;
}

/* The fastest rival by median: the one a ratio is honest against. NULL without rivals. */
static inline const bench_row *bench_rival(const bench_row *rows, int count)
{
    const bench_row *fastest = NULL;
    int i;
    for (i = 0; i < count; i++) {
        if (rows[i].role == BENCH_RIVAL && (fastest == NULL || rows[i].median < fastest->median)) {
            fastest = &rows[i];
        }
    }
    return fastest;
}

/* Median over the runs of a's time in units of b's. */
static inline double bench_ratio(const bench_row *a, const bench_row *b, int runs)
{
    double ratios[BENCH_MAX_RUNS];
    int run;
    for (run = 0; run < runs; run++) {
        ratios[run] = a->seconds[run] / b->seconds[run];
    }
    return bench_median(ratios, runs);
}

static inline void bench_csv(const bench_options *options, const char *title, const bench_row *row,
                             double unit, double ratio_best, double ratio_median)
{
    FILE *file;
    if (options->csv == NULL) {
        return;
    }
    file = fopen(options->csv, "a");
    if (file == NULL) {
        fprintf(stderr, "cannot append to %s\n", options->csv);
        exit(1);
    }
    fseek(file, 0, SEEK_END);
    if (ftell(file) == 0) {
        fprintf(
            file,
            "compiler,flags,isa,commit,table,row,best,median,best / fastest rival,median / fastest rival\n");
    }
    fprintf(file, "\"%s\",\"%s\",\"%s\",%s,\"%s\",\"%s\",%.4f,%.4f,", bench_compiler(), BENCH_FLAGS,
            bench_isa(), BENCH_COMMIT, title, row->name, row->best * unit, row->median * unit);
    if (ratio_median > 0) {
        fprintf(file, "%.3f,%.3f\n", ratio_best, ratio_median);
    } else {
        fprintf(file, ",\n");
    }
    fclose(file);
}

/* Drops the rows that --only leaves out; returns how many are left. */
static inline int bench_keep(const bench_options *options, bench_row *rows, int count)
{
    int kept = 0;
    int i;
    for (i = 0; i < count; i++) {
        if (options->only == NULL || strstr(rows[i].name, options->only) != NULL) {
            rows[kept++] = rows[i];
        }
    }
    return kept;
}

static inline int bench_runs(const bench_options *options, int runs)
{
    return options->runs > 0 ? options->runs : options->quick ? (runs + 4) / 5 : runs;
}

/* Measures and prints one table: nanoseconds per operation, and each row in units of the fastest rival.
 * Returns how many rows --only left. */
static inline int bench_table(const bench_options *options, const char *title, bench_row *rows, int count,
                              int runs, double operations, void *context)
{
    const bench_row *rival;
    double unit = 1e9 / operations;
    int i;
    count = bench_keep(options, rows, count);
    runs = bench_measure(rows, count, bench_runs(options, runs), 10.0, context);
    rival = bench_rival(rows, count);
    printf("\n%s, %d runs\n%-34s %9s %9s %14s   %s\n", title, runs, "  ns per operation", "best", "median",
           "x fastest rival", "sum of answers");
    for (i = 0; i < count; i++) {
        double ratio_best = 0;
        double ratio_median = 0;
        printf("  %-32s %9.2f %9.2f ", rows[i].name, rows[i].best * unit, rows[i].median * unit);
        if (rival != NULL && rows[i].role != BENCH_REFERENCE) {
            ratio_best = rows[i].best / rival->best;
            ratio_median = bench_ratio(&rows[i], rival, runs);
            printf("%6.2f %6.2f", ratio_best, ratio_median);
        } else {
            printf("%13s", "");
        }
        printf("%s  %llu\n", &rows[i] == rival ? " <- " : "    ", (unsigned long long)rows[i].sum);
        bench_csv(options, title, &rows[i], unit, ratio_best, ratio_median);
    }
    fflush(stdout);
    return count;
}

#endif /* BENCH_H */
