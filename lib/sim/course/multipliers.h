/* multipliers.h -- drift off the constraints along a run, and the multipliers at its end.
 *
 * Tests  tests/sim/model/test_constraints.c
 */
#ifndef QDOT_SIM_MULTIPLIERS_H
#define QDOT_SIM_MULTIPLIERS_H

#include "ode/trajectory.h"
#include "sim/bind/bind.h"
#include "sim/course/report.h"

typedef struct {
    double position, velocity; /* the largest residuals at stored points; NaN: no such constraints
                                   */
    double *lambda;            /* [m] multipliers at the end of the run */
    double *error;             /* [m] absolute errors of the multipliers; NaN: unknown */
    size_t independent;        /* rank of the constraint Jacobian */
} qdot_multipliers;

/* Measure a finished run; binds by mode. Does nothing without constraints. After Ctrl-C only the
 * values at the end are computed, residuals are NaN. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_multipliers_measure(qdot_bind *const *binds,
                                                     const qdot_trajectory *tr,
                                                     qdot_multipliers *b);
/* The errors of the multipliers at the end, from those of the state:
 *     error_k = sum_i |dlambda_k/dy_i| difference_i,   difference [2n]
 * by central differences. Does nothing without constraints. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_multipliers_errors(qdot_bind *const *binds,
                                                    const qdot_trajectory *tr,
                                                    const double *difference,
                                                    qdot_multipliers *b);
void qdot_multipliers_clear(qdot_multipliers *b);

/* Copy the measured residuals and multipliers into a report. */
void qdot_multipliers_report(const qdot_multipliers *b, const qdot_plan *plan,
                             qdot_run_report *r);

#endif
