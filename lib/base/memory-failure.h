/* memory-failure.h -- that an allocation failed: heard by who answers, brought about by tests. */
#ifndef QDOT_BASE_MEMORY_FAILURE_H
#define QDOT_BASE_MEMORY_FAILURE_H

#include <stdbool.h>

/* Whether an allocation failed since it was asked last, in any thread. Where that was not passed on, a part of an
 * answer may be lost. */
bool qdot_memory_ran_out(void);

/* For tests: the n-th allocation from now (n = 0: the next) fails and no other (memory.h has: it and all after it);
 * n < 0: none. How many were left before the one that was to fail until now; negative: it failed, or none was to. */
long qdot_memory_fail_once_at(long n);

/* For tests: `who` is called before the n-th allocation from now (n = 0: the next), by the thread that allocates, and
 * may ask to be called again; n < 0: not. One `who` at a time, memory.h's Ctrl-C being one. */
void qdot_memory_visit_at(long n, void (*who)(void));

#endif
