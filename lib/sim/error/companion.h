/* companion.h -- the two companions (ode/companion.h) that tell the errors of a run, each
 * integrated as a course of its own.
 *
 * Tests  tests/script/cases/inner-times.sh, event-ends.sh
 */
#ifndef QDOT_SIM_COMPANION_H
#define QDOT_SIM_COMPANION_H

#include "sim/course/run-state.h"

/* Integrate two companions, started to opposite sides, over the whole run; beyond the end of one
 * that ends early errors are unknown. QDOT_OK also if there are none: see has_companion. */
QDOT_MUST_CHECK qdot_status qdot_run_twin(qdot_run *run);

/* Free the companion runs (slightly disturbed repetitions) of a run. */
void qdot_run_drop_companions(qdot_run *run);

/* The errors of the end state of a run with pieces into its report; NaN with run->doubt if run and
 * companions met different events. difference [2n]: that of each component, where it is known. */
QDOT_MUST_CHECK qdot_status qdot_run_end_error(qdot_run *run, double *difference);

/* Whether run and companion went through the same pieces and missed no force, so that their
 * states can be compared. */
bool qdot_run_comparable(const qdot_run *run);

/* The time from which a companion run passed through other pieces than the run; NaN: none did. */
double qdot_run_time_of_parting(const qdot_run *run);

/* Whether the companion runs did not fail and reached the time t. */
bool qdot_run_covered(const qdot_run *run, double t);

#endif
