/* clock.h -- CPU time, and time as it passes. */
#ifndef QDOT_BASE_CLOCK_H
#define QDOT_BASE_CLOCK_H

#include <time.h>

/* CPU time of this thread, in seconds. */
static inline double
qdot_cpu_now(void)
{
    struct timespec now;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Time as it passes, in seconds from some moment. */
static inline double
qdot_wall_now(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
