/* absent.h -- coordinates that do not stand in a function, by what a few places say.
 *
 * A function of (q, q', t) that changes with q_i depends on it. One that did not change may: it is
 * asked by a proof then, which takes long.
 *
 * Tests  tests/sim/test_tree-alone.c
 */
#ifndef QDOT_SIM_ABSENT_H
#define QDOT_SIM_ABSENT_H

#include "tape/tape.h"

/* absent [n]: whether the tape, one output of q [n], q' [n], t, was the same wherever q_i was.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_absent_find(const qdot_tape *tape, size_t n, bool *absent);

#endif
