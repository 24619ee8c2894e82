/* absent.h -- coordinates that a function does not seem to depend on, tested at a few points.
 *
 * A function of (q, q', t) that changes with q_i depends on it. If it did not change it may still
 * depend on it: only then is a proof attempted, which takes long.
 *
 * Tests  tests/sim/plan/test_tree-alone.c
 */
#ifndef QDOT_SIM_ABSENT_H
#define QDOT_SIM_ABSENT_H

#include "tape/tape.h"

/* absent [n]: whether the tape, one output of q [n], q' [n], t, did not change when q_i did.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_absent_find(const qdot_tape *tape, size_t n, bool *absent);

#endif
