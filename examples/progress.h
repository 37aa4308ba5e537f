/* progress.h - wall time, and how far long work has come, on a terminal only */
#ifndef EXAMPLES_PROGRESS_H
#define EXAMPLES_PROGRESS_H
#include <stdio.h>
#include <time.h>
#if defined(__unix__) || defined(__APPLE__)
#include <sys/time.h>
#include <unistd.h>
#endif

/* Seconds since some moment, by the clock on the wall. */
static inline double progress_seconds(void) {
#if defined(__unix__) || defined(__APPLE__)
    struct timeval now;
    gettimeofday(&now, NULL);
    return (double)now.tv_sec + 1e-6 * (double)now.tv_usec;
#else
    return (double)clock() / CLOCKS_PER_SEC;        /* on Windows this is wall time */
#endif
}

static inline int progress_on_terminal(void) {
#if defined(__unix__) || defined(__APPLE__)
    return isatty(2);
#else
    return 0;
#endif
}

typedef struct progress {
    const char *what;
    int         shown;          /* a line stands there */
    int         on;             /* standard error is a terminal */
    double      next;
} progress;

static inline progress progress_begin(const char *what) {
    progress p;
    p.what = what;
    p.shown = 0;
    p.on = progress_on_terminal();
    p.next = p.on ? progress_seconds() + 0.5 : 0;
    return p;
}

/* Says so, four times a second at most, when work has taken half a second. */
static inline void progress_show(progress *p, double done, double all) {
    double now;
    if (!p->on) {
        return;
    }
    now = progress_seconds();
    if (now >= p->next) {
        fprintf(stderr, "\r  %s %3.0f %%", p->what, 100 * done / all);
        fflush(stderr);
        p->shown = 1;
        p->next = now + 0.25;
    }
}

/* Takes the line away again. */
static inline void progress_end(progress *p) {
    if (p->shown) {
        fprintf(stderr, "\r%40s\r", "");
        fflush(stderr);
    }
    p->shown = 0;
}

#endif /* EXAMPLES_PROGRESS_H */
