/* system.h -- what the C library of Debian's emscripten lacks; each file of libqdot begins with it. */
#ifndef QDOT_BROWSER_SYSTEM_H
#define QDOT_BROWSER_SYSTEM_H

#include <stddef.h>
#include <time.h>

/* There are no clocks of the processor. One thread has it while it computes, so the time that passes is what it takes. */
#undef CLOCK_PROCESS_CPUTIME_ID
#undef CLOCK_THREAD_CPUTIME_ID
#define CLOCK_PROCESS_CPUTIME_ID CLOCK_MONOTONIC
#define CLOCK_THREAD_CPUTIME_ID CLOCK_MONOTONIC

void qsort_r(void *base, size_t n, size_t size, int (*compare)(const void *, const void *, void *), void *user);

#endif
