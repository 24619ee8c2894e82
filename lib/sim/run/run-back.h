/* run-back.h -- what a run back in time has taken for granted.
 *
 * Tests  tests/script/events/backward.lag
 */
#ifndef QDOT_SIM_RUN_BACK_H
#define QDOT_SIM_RUN_BACK_H

#include "sim/course/run-state.h"

/* A notice of the events that were undone where the motion could also have crossed there the other way, without them.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_back_tell(qdot_run *run);

#endif
