/* process.h -- which process this is among those that work together, and whether it may begin threads.
 *
 * mpirun starts several processes, the ranks 0, 1 ...; a program that it has not started is rank 0 of 1. Rank 0
 * alone is seen: others write to nowhere and draw nothing. Their messages: parallel/ranks.h.
 *
 * Tests  tests/meta/ranks.test, tests/parallel/test_workers.c
 */
#ifndef QDOT_BASE_PROCESS_H
#define QDOT_BASE_PROCESS_H

#include <stdbool.h>
#include <stddef.h>

/* Whether mpirun started this process, and whether as another rank than 0; valid from the start of
 * the program. */
bool qdot_ranks_are_there(void);
bool qdot_ranks_are_others(void);
/* The number of ranks, and the number of this one; 1 and 0 until qdot_rank_set sets them. */
size_t qdot_ranks_count(void);
size_t qdot_rank(void);
void qdot_rank_set(size_t rank, size_t count);

/* Whether this program may begin threads and processes; configure --disable-threads: not. */
#ifdef QDOT_ONE_THREAD
enum { QDOT_MAY_THREAD = 0 };
#else
enum { QDOT_MAY_THREAD = 1 };
#endif

/* Whether other processes work beside this one on all processors (parallel/workers.h): threads would only be in
 * each other's way; always without threads. */
extern bool qdot_threads_are_taken;

#endif
