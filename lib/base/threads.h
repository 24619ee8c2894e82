/* threads.h -- whether this process may begin threads to be faster.
 *
 * Where other processes work beside it on all processors (base/workers.h), they would only be in each
 * other's way.
 *
 * Tests  tests/base/test_workers.c
 */
#ifndef QDOT_BASE_THREADS_H
#define QDOT_BASE_THREADS_H

#include <stdbool.h>

/* Of the process. */
extern bool qdot_threads_are_taken;

#endif
