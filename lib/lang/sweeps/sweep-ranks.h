/* sweep-ranks.h -- a sweep by several ranks (parallel/ranks.h).
 *
 * All of them begin it and make rows (parallel/workers.h). Rank 0 alone has the file of the rows, and
 * shares them at the end: so each rank goes on with the same table.
 *
 * Tests  tests/meta/ranks.test
 */
#ifndef QDOT_LANG_SWEEP_RANKS_H
#define QDOT_LANG_SWEEP_RANKS_H

#include "lang/sweeps/sweep-parts.h"

/* The number of worker processes in each MPI rank. */
size_t qdot_sweep_processes(const qdot_sweep *s);

/* The rows that are done, and how making them ended, become those of rank 0. Returns that status, with
 * its error. */
QDOT_MUST_CHECK qdot_status qdot_sweep_share_rows(qdot_sweep *s, qdot_status status);

#endif
