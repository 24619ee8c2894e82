/* ensemble-series.h -- the motions of an ensemble's members: a motion (series/motion.h) in lanes,
 * as a system of ode/batch.h.
 *
 * Stage by stage; K of every lane is factored at order 0,
 *
 *     M = L L^T,   [ M  A^T ] = L S L^T,  S = 1 for coordinates, -1 for constraints,
 *                  [ A   0  ]
 *
 * without pivoting, which M > 0 and independent constraints allow; higher orders multiply by its
 * inverse. A lane where that is not so has no accelerations. With constraints the ends of steps are
 * brought back to them (sim/model/constrained-lanes.h).
 *
 * Tests  tests/sim/ensemble/test_ensemble.c
 */
#ifndef QDOT_SIM_ENSEMBLE_SERIES_H
#define QDOT_SIM_ENSEMBLE_SERIES_H

#include "ode/batch.h"
#include "sim/model/equations.h"

typedef struct qdot_ensemble_series qdot_ensemble_series; /* must not be shared between threads */

/* A plan with a residual by it, others by M q'' = f with constraints: for series to *order, or if that
 * is 0 to the one that costs least under tol, which is put there; shaken as for qdot_bind_new. Plan
 * borrowed. Errors: QDOT_ENOTBUILT
 * (equations that switch), QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_series_new(const qdot_plan *plan, bool shaken,
                                                     double tol, int *order,
                                                     qdot_ensemble_series **series);
void qdot_ensemble_series_free(qdot_ensemble_series *series);

/* The callbacks of the members' series for the integrator (ode); `series` is their user pointer. */
qdot_ode_batch qdot_ensemble_series_system(qdot_ensemble_series *series);

#endif
