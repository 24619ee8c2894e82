/* doubts.h -- what a step of a lane shows that a run alone has to be asked about.
 *
 * A force may act for less than the step (sim/bind/pulses.h), as a run alone finds out when it has
 * ended; or a row of the constraints' slopes is about to vanish, near a cusp or a crossing
 * (sim/error/constraint-corners.h).
 *
 * Tests  tests/sim/ensemble/test_ensemble-doubts.c, tests/script/sweeps/sweep-lanes.sh
 */
#ifndef QDOT_SIM_ENSEMBLE_DOUBTS_H
#define QDOT_SIM_ENSEMBLE_DOUBTS_H

#include "sim/bind/pulses.h"

/* The inspection of the steps of one ensemble member, to decide whether it must be repeated as a single run. */
typedef struct qdot_ensemble_doubts qdot_ensemble_doubts;

/* Make the inspection for a plan, borrowed; *doubts is NULL if there is nothing to inspect. Errors:
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_doubts_new(const qdot_plan *plan,
                                                     qdot_ensemble_doubts **doubts);
void qdot_ensemble_doubts_free(qdot_ensemble_doubts *doubts);
/* Call before the first step of an ensemble member. Error: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_doubts_begin(qdot_ensemble_doubts *doubts);
/* Whether the step {.a, .b, .tol, .from, .to, .read, .user} is such a one. Errors: QDOT_EINTR, those of
 * .read. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_doubts_look(qdot_ensemble_doubts *doubts,
                                                      qdot_pulses_step *step, bool *doubtful);

#endif
