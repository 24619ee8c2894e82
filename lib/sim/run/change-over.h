/* change-over.h -- what `auto` does where a scene is stiff (ode/stiffness.h).
 *
 * A run whose steps stability bounded, and whose method was the choice of `auto`, is made once more
 * by radau, which is no worse where nothing is stiff, so that it stays with it to the end. If that is far off, it is made by series
 * after all, unless that would take long. If both fail the first run stays.
 *
 * Tests  tests/script/methods/stiff-auto.lag
 */
#ifndef QDOT_SIM_CHANGE_OVER_H
#define QDOT_SIM_CHANGE_OVER_H

#include "sim/course/report.h"
#include "sim/model/request.h"

/* Callbacks that make runs (qdot_run_new), read them (qdot_run_values) and free them. */
typedef struct {
    qdot_status (*make)(qdot_scene *scene, const qdot_run_request *request,
                        qdot_run **run);
    qdot_status (*values)(qdot_run *run, size_t m, const qdot_expr *exprs, size_t k,
                          const double *times, double *values, double *errors);
    void (*free)(qdot_run *run);
} qdot_run_maker;

/* If *run is stiff, replace it by a run with an implicit method, with a notice. Errors:
 * QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_run_change_over(qdot_scene *scene,
                                                 const qdot_run_request *request,
                                                 const qdot_run_maker *by,
                                                 qdot_run **run);

#endif
