/* failure.h -- why a run could not go on, in words for a person.
 *
 * A run that comes near a singularity ends with steps as small as doubles of t allow. Then
 * some acceleration outgrows everything: at x'' = -c (t* - t)^-k, k >= 1, what is left until
 * t* is about |x'/x''|, which is nothing beside the run. The reason then says so, with the
 * coordinate, where it is and its acceleration.
 *
 * Tests  tests/script/bad-runs.sh
 */
#ifndef QDOT_SIM_FAILURE_H
#define QDOT_SIM_FAILURE_H

#include "base/text.h"
#include "ode/system.h"
#include "sim/model/equations.h"

/* Append to `reason` what the equations of `system` show at t and y [2n], a run of that
 * length having failed there. Nothing where they show nothing. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_failure_explain(const qdot_plan *plan,
                                                 const qdot_ode_system *system, double t,
                                                 const double *y, double length,
                                                 qdot_text *reason);

#endif
