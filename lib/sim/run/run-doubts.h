/* run-doubts.h -- signs, after a run, that its error is unknown or its events are to be searched
 * again, whatever its companions agree on.
 *
 * Tests  tests/script/contacts/hidden-forces.lag, passed-over.lag, grazing.lag
 */
#ifndef QDOT_SIM_RUN_DOUBTS_H
#define QDOT_SIM_RUN_DOUBTS_H

#include "sim/course/run-state.h"

/* A force that acts for less than a step, a cusp of a constraint, an acting event of which rounding hides whether it rises or falls, forces that
 * underflow where they matter: then run->hidden is set, the error NaN, and run->doubt says why. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_run_doubt_places(qdot_run *run);

/* The state at which a run comes to a singularity: its error is NaN, that of states before is known as ever. Errors:
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_doubt_end(qdot_run *run);

/* Make the error unknown if the energy was not kept as steps under the tolerance would keep it; the drifts are
 * measured. */
QDOT_MUST_CHECK qdot_status qdot_run_doubt_energy(qdot_run *run, double tol);

/* Lower *tol, that for touches, if the run is so exact that a touch of an event is seen to be none
 * (sim/error/touches.h). */
QDOT_MUST_CHECK qdot_status qdot_run_decide_touches(qdot_run *run, double *tol);

#endif
