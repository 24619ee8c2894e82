/* ensemble.h -- many runs of one scene, with their own starts and parameters, in lanes.
 *
 * The scene is derived and lowered once; the varying parameters are inputs of its tape. Members
 * run eight at a time (ode/batch.h), each with the result that it has alone, to rounding. The
 * error of a member is the distance of its end state from that of a companion under a tighter
 * tolerance, with inputs moved to their neighbours and constants rounded the other way
 * (ode/companion.h).
 *
 * Tests  tests/sim/test_ensemble.c
 */
#ifndef QDOT_SIM_ENSEMBLE_H
#define QDOT_SIM_ENSEMBLE_H

#include "sim/run/run.h"

typedef struct qdot_ensemble qdot_ensemble;

typedef struct {
    qdot_run_status status; /* QDOT_RUN_DONE or QDOT_RUN_FAILED */
    const char *reason;     /* NULL when done; valid until the next _run or _free */
    double t;               /* where it ended */
    size_t steps, rejected;
    double error; /* of the end state, over max(1, |value|); NaN: unknown or not requested */
} qdot_ensemble_result;

/* Prepare runs of `request`: its values, limits and tolerance; method "auto" or "taylor".
 * The starts are given to qdot_ensemble_run: q0 and v0 must be NULL.
 *   varied  [n_varied] parameters that each member has its own values of; they may not be
 *           among the request's values
 * Errors: as qdot_run_new before anything is integrated; QDOT_ENOTBUILT: constraints under another
 * treatment than projection, events that stop or change a run, equations that switch, coupled
 * coordinates of a stated Lagrangian or of potentials with velocities without constraints; QDOT_EINVAL: another method, starts given, a parameter given twice. The
 * scene may change afterwards. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_new(qdot_scene *scene,
                                              const qdot_run_request *request,
                                              size_t n_varied, const qdot_expr *varied,
                                              qdot_ensemble **ensemble);
void qdot_ensemble_free(qdot_ensemble *ensemble);

/* Run them.
 *   y           [members x 2n] q, q' at the start; then at the end
 *   parameters  [members x n_varied]
 *   results     [members]
 *   errors      whether companions are run, on a second thread, for `error`
 * If a member fails, or its start breaks the constraints, its result says so; that is no error of
 * the call. Errors: QDOT_EINVAL (a number that is not finite), QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_run(qdot_ensemble *ensemble, size_t members,
                                              double *y, const double *parameters,
                                              bool errors, qdot_ensemble_result *results);

#endif
