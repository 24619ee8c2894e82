/* drift.h -- drift of conserved quantities along a run: h if it is proved conserved, cyclic
 * momenta. */
#ifndef QDOT_SIM_DRIFT_H
#define QDOT_SIM_DRIFT_H

#include "ode/trajectory.h"
#include "sim/course/report.h"
#include "sim/course/stage.h"
#include "sim/model/equations.h"

/* The drifts of a run. Start from {0}. */
typedef struct {
    size_t n;
    qdot_drift *at; /* [n] the drifts, energy first; names owned */
    bool energy;    /* at[0] is the energy */
} qdot_drifts;

/* Measure every known conserved quantity at all points of the run. A quantity that cannot be
 * evaluated is left out. stage: of the run; NULL: it has one mode and the scales 1. What a contact with a place that moves
 * changes is no drift. Where there are scales a drift of a quantity below 1 is relative to the largest sum of the sizes of
 * its terms. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_drifts_measure(qdot_scene *scene, const qdot_plan *plan,
                                                const qdot_trajectory *tr, const qdot_stage *stage,
                                                qdot_drifts *drifts);
void qdot_drifts_clear(qdot_drifts *drifts);

/* Let the energy, which was measured elsewhere, be all of it; its name is copied. Errors:
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_drifts_set(qdot_drifts *drifts, const qdot_drift *energy);

/* Whether the energy of a run by tolerance drifts by far more than its steps can make it,
 *
 *     |E - E_0| > 100 sum_k sum_i |E(y_k + tol max(1, |y_ki|) e_i) - E(y_k)|,  y_k all stored states,
 *
 * or one of these is within tol of the end of E's domain: then a step came within tol of a place where the
 * equations are singular, or went over it. Errors: as qdot_drifts_measure. */
QDOT_MUST_CHECK qdot_status qdot_drifts_contradict(const qdot_drifts *drifts,
                                                   const qdot_plan *plan,
                                                   const qdot_trajectory *tr, double tol,
                                                   bool *contradict);

#endif
