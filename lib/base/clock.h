/* clock.h -- CPU time and wall-clock time. */
#ifndef QDOT_BASE_CLOCK_H
#define QDOT_BASE_CLOCK_H

#include <time.h>

/* The CPU time of this thread, in seconds. */
static inline double
qdot_cpu_now(void)
{
    struct timespec now;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The wall-clock time in seconds, from an arbitrary origin. */
static inline double
qdot_wall_now(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
