/* derived.h -- the derived form of the equations, q'' = M^-1 f: what a step by its series costs.
 *
 * Tests  tests/sim/test_taylor.c
 */
#ifndef QDOT_SIM_DERIVED_H
#define QDOT_SIM_DERIVED_H

#include "ode/taylor.h"
#include "sim/model/equations.h"

/* What steps cost at a middling tolerance, as machine code where there is to be some
 * (qdot_ode_taylor_cost). */
double qdot_plan_cost(const qdot_ode_series *series);
/* plan->motion, of a plan that is complete but for it. Errors: those of qdot_motion_of_equations. */
QDOT_MUST_CHECK qdot_status qdot_plan_make_motion(qdot_plan *plan);
/* That, the convolutions and that cost of the derived form of a plan with a tape, as it will run and by
 * kernels, put into it. */
QDOT_MUST_CHECK qdot_status qdot_plan_measure(qdot_plan *plan);

/* Operations of the equations it integrates, evaluated once: of M and f, or of what the tree
 * reads; *calls (NULL: not wanted) of them of elementary functions. */
size_t qdot_plan_operations(const qdot_plan *plan, size_t *calls);

/* Take a use of a plan away; with the last one free it, with all the forms that it holds. */
void qdot_plan_free(qdot_plan *plan);

#endif
