/* memory-failure.h -- tells a handler that memory allocation failed; tests can make an allocation fail. */
#ifndef QDOT_BASE_MEMORY_FAILURE_H
#define QDOT_BASE_MEMORY_FAILURE_H

#include <stdbool.h>

/* Whether an allocation failed since it was asked last, in any thread. Where that was not passed on, a part of an
 * answer may be lost. */
bool qdot_memory_ran_out(void);

/* For tests: the n-th allocation from now (n = 0: the next) fails and no other (qdot_memory_fail_at: it and all after
 * it); n < 0: none. Returns how many were still to come before the failure asked for last; negative if that one failed,
 * or none was asked for. */
int64_t qdot_memory_fail_once_at(int64_t n);

/* For tests: `who` is called before the n-th allocation from now (n = 0: the next), by the thread that allocates, and
 * may ask to be called again; n < 0: nothing is called. Only one `who` can be set: qdot_memory_press_at sets it too. */
void qdot_memory_visit_at(int64_t n, void (*who)(void));

#endif
