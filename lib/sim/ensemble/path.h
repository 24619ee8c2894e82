/* path.h -- a member of an ensemble as a run: values, extrema and means along its way.
 *
 * The starts of the steps of a member and of its two companions are the points of a run and of its
 * companions (sim/course/run-state.h), in which parameters that vary are further coordinates
 * (sim/model/parameter-states.h). Within a step its series is expanded again, to the order that it had in lanes.
 * So qdot_run_values and qdot_run_range read a member as they read a run alone, and their errors are
 * found alike. What else a report of a run tells is not known.
 *
 * Tests  tests/sim/ensemble/test_ensemble-path.c, tests/script/sweeps/sweep-lanes.sh
 */
#ifndef QDOT_SIM_ENSEMBLE_PATH_H
#define QDOT_SIM_ENSEMBLE_PATH_H

#include "sim/ensemble/ensemble.h"

/* An ensemble with the arguments of qdot_ensemble_new; all borrowed. */
typedef struct {
    const qdot_ensemble *ensemble;
    qdot_scene *scene;
    const qdot_run_request *request;
    size_t n_varied;
    const qdot_expr *varied;
} qdot_ensemble_path_of;

/* Make a run without points; release it with qdot_run_free. Errors: as qdot_plan_new, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_path_new(const qdot_ensemble_path_of *of, qdot_run **run);

/* After qdot_ensemble_run with `keep` of qdot_ensemble_watching and errors, by two companions: make
 * the run that of a member. *there: all three went the whole way; else the run is not to be read.
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_path_take(const qdot_ensemble *e, size_t member,
                                                    qdot_run *run, bool *there);

#endif
