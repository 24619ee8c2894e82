/* fit.h -- whether the runs of a scene may be members of an ensemble, so that each is what it is
 * alone.
 *
 * Lanes go by Taylor series in doubles, in one chart, with one form of the equations. What a run alone
 * does beyond that - switches, events that act, another method, first orders in two doubles -
 * they do not.
 *
 * Tests  tests/script/sweeps/sweep-lanes.sh
 */
#ifndef QDOT_SIM_ENSEMBLE_FIT_H
#define QDOT_SIM_ENSEMBLE_FIT_H

#include "base/text.h"
#include "sim/model/request.h"
#include "sim/ensemble/steps.h"

typedef qdot_vec(qdot_ensemble_bound) qdot_ensemble_bounds;

/* For a request with its start, of one of the runs: `why` gets the reason against it, or nothing; bounds
 * the ends of the domains of coordinates. Errors: those of qdot_plan_new but QDOT_ENOTBUILT. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_fit(qdot_scene *scene, const qdot_run_request *request,
                                              qdot_ensemble_bounds *bounds, qdot_text *why);

#endif
