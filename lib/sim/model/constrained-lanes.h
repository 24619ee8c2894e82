/* constrained-lanes.h -- projects states in lanes onto the constraints, as
 * qdot_constrained_project does; every number is a group (num/batch.h).
 *
 *     [ M  A^T ] [ dq  ]   [  0 ]
 *     [ A   0  ] [ -nu ] = [ -f ]   until f = 0 within rounding, with M and A of the first state,
 *
 * then q' likewise. Lanes are independent: none changes a bit of another.
 *
 * Tests  tests/sim/ensemble/test_ensemble.c
 */
#ifndef QDOT_SIM_CONSTRAINED_LANES_H
#define QDOT_SIM_CONSTRAINED_LANES_H

#include "num/batch.h"
#include "sim/model/constraints.h"

typedef struct qdot_constrained_lanes qdot_constrained_lanes; /* must not be shared between threads */

/* Prepare the projection for a plan with constraints, borrowed; shaken as for qdot_bind_new.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_constrained_lanes_new(const qdot_plan *plan, bool shaken,
                                                       qdot_constrained_lanes **lanes);
void qdot_constrained_lanes_free(qdot_constrained_lanes *lanes);

/* Project y + carry: q [n groups], q' [n groups], the parameters of each lane (plan->n_states),
 * which keep their values and have no carry; t [a group]. moved [a group]: the largest change of
 * a component relative to max(1, |y_i|); NaN in a lane that does not converge or whose
 * constraints depend on each other. */
void qdot_constrained_lanes_project(qdot_constrained_lanes *lanes, const double *t, double *y,
                                    double *carry, double *moved);

#endif
