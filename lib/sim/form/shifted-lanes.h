/* shifted-lanes.h -- d'Alembert's residual over power series in lanes.
 *
 * As sim/form/shifted.h (and residual.h for the form), every number a group of lanes. For
 * scenes all of whose parameters are numbers and whose forces hold no velocity.
 *
 * Tests  tests/sim/test_ensemble.c
 */
#ifndef QDOT_SIM_SHIFTED_LANES_H
#define QDOT_SIM_SHIFTED_LANES_H

#include "ode/batch.h"
#include "sim/form/residual.h"

typedef struct qdot_shifted_lanes qdot_shifted_lanes;

/* Of a plan for lanes that has a residual; borrowed. For series to *order, or if that is 0 to the
 * one that costs least under tol, which is put there; shaken as for qdot_bind_new. */
QDOT_MUST_CHECK qdot_status qdot_shifted_lanes_new(const qdot_plan *plan, bool shaken, double tol,
                                                   int *order, qdot_shifted_lanes **lanes);
void qdot_shifted_lanes_free(qdot_shifted_lanes *lanes);

/* Its callbacks; `lanes` is their user. */
qdot_ode_batch qdot_shifted_lanes_system(qdot_shifted_lanes *lanes);

#endif
