/* progress.h -- how far long work is, for a person who waits.
 *
 * A program that wants to show it opens a progress in its thread. Work that goes on in this thread
 * then tells where it is; threads of its own tell nothing. Integration loops call
 * qdot_progress_at at each step: without a progress this costs one test, with one a count, and the
 * clock is read some twenty times a second.
 *
 * Tests  tests/base/test_progress.c, tests/src/test_prompt.c
 */
#ifndef QDOT_BASE_PROGRESS_H
#define QDOT_BASE_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct qdot_progress {
    const char *what; /* what is being computed: "run", "dop853, tol 1e-09" */
    double t0, t1, t; /* start, end and present value of the variable that advances, such as the time */
    double speed;     /* steps a second; 0: not known yet */
    double left;      /* estimated seconds that remain; NaN: not known yet */
    /* called when the computation has lasted half a second and then a few times a second; may show a line */
    void (*show)(const struct qdot_progress *progress);
    /* called before other output is written, if a line was shown */
    void (*clear)(void);

    /* fields used by base/progress.c only */
    char text[80], within[80];
    uint64_t steps, pause,
        until; /* steps since `what` began; steps between looks at the clock; the step of the next look */
    double begun, opened, last; /* times in seconds: when this part and the whole work began; when a line was last shown */
    bool shown;
} qdot_progress;

/* The progress shown for this thread; NULL: none. */
extern _Thread_local qdot_progress *qdot_progress_open;

/* Begin to show progress of work on t0..t1, named by the printf format. */
void qdot_progress_begin(double t0, double t1, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* What begins from now on, until the line is taken away, is part of this (printf), and is called
 * so. */
void qdot_progress_within(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Read the clock, and show the progress if that is due. */
void qdot_progress_look(qdot_progress *progress);

/* Report that a step has reached t. */
static inline void
qdot_progress_at(double t)
{
    qdot_progress *progress = qdot_progress_open;

    if (progress && ++progress->steps >= progress->until) {
        progress->t = t;
        qdot_progress_look(progress);
    }
}

/* Remove the progress line if there is one; the next is shown after the usual delay. */
void qdot_progress_clear(void);

#endif
