/* drift.h -- drift of conserved quantities along a run: h if it is proved conserved, cyclic
 * momenta. */
#ifndef QDOT_SIM_DRIFT_H
#define QDOT_SIM_DRIFT_H

#include "ode/trajectory.h"
#include "sim/course/report.h"
#include "sim/model/equations.h"

/* Start from {0}. */
typedef struct {
    size_t n;
    qdot_drift *at; /* energy first; names owned */
    bool energy;    /* at[0] is the energy, */
    double terms;   /* whose terms have sizes that add up to so much at most; 0: not known */
} qdot_drifts;

/* Measure every known conserved quantity at all points of the run. A quantity that cannot be
 * evaluated is left out. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_drifts_measure(qdot_scene *scene, const qdot_plan *plan,
                                                const qdot_trajectory *tr,
                                                qdot_drifts *drifts);
void qdot_drifts_clear(qdot_drifts *drifts);

/* Whether the energy drifts by far more than so many steps under a tolerance can make it,
 *
 *     |E - E_0| > 100 tol steps max(1, sum of its terms' sizes):
 *
 * then a step went over a place where the equations are singular. */
bool qdot_drifts_contradict(const qdot_drifts *drifts, double tol, uint64_t steps);

#endif
