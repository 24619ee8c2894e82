/* failure.h -- explains why a run could not go on.
 *
 * A run that comes near a singularity ends with steps as small as doubles of t allow. Some
 * acceleration then grows without bound: for x'' = -c (t* - t)^-k, k >= 1, the time left until t*
 * is about |x'/x''|, negligible beside the length of the run. The reason then names the
 * coordinate, its position and its acceleration.
 *
 * Tests  tests/script/runs/bad-runs.sh
 */
#ifndef QDOT_SIM_FAILURE_H
#define QDOT_SIM_FAILURE_H

#include "base/text.h"
#include "ode/system.h"
#include "sim/model/equations.h"

/* A run of that length failed at t and y [2n]: append the explanation from the equations of
 * `system` to `reason`, or nothing if there is none. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_failure_explain(const qdot_plan *plan,
                                                 const qdot_ode_system *system, double t,
                                                 const double *y, double length,
                                                 qdot_text *reason);

#endif
