/* companion.h -- the second and third run by which errors of a run are known (ode/companion.h), each
 * a course of its own.
 *
 * Tests  tests/script/inner-times.sh, event-ends.sh
 */
#ifndef QDOT_SIM_COMPANION_H
#define QDOT_SIM_COMPANION_H

#include "sim/course/run-state.h"

/* The trajectories of two companions, moved to opposite sides, over all that the run covers;
 * where they end early errors are unknown. QDOT_OK without them, too: has_companion tells. */
QDOT_MUST_CHECK qdot_status qdot_run_twin(qdot_run *run);

/* The error of the end state of a run that has pieces; NaN with run->doubt where the two
 * runs met different events. difference [2n], from zeros: that of each component. */
QDOT_MUST_CHECK qdot_status qdot_run_end_error(qdot_run *run, double *error,
                                               double *difference);

/* Whether both runs went through the same pieces and saw what is in them, so that states
 * compare. */
bool qdot_run_comparable(const qdot_run *run);

/* Whether the companions come as far as t, or ended as the run did. */
bool qdot_run_covered(const qdot_run *run, double t);

#endif
