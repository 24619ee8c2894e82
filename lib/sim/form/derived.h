/* derived.h -- the derived form of the equations, q'' = M^-1 f, of a plan; plans freed.
 *
 * Tests  tests/sim/form/test_taylor.c
 */
#ifndef QDOT_SIM_DERIVED_H
#define QDOT_SIM_DERIVED_H

#include "sim/model/equations.h"

/* Make plan->motion, the Taylor series program, the last part of a plan. Errors: qdot_motion_of_equations. */
QDOT_MUST_CHECK qdot_status qdot_plan_make_motion(qdot_plan *plan);
/* Make plan->motion for the members of an ensemble (qdot_motion_of_members). */
QDOT_MUST_CHECK qdot_status qdot_plan_make_motion_of_members(qdot_plan *plan);
/* Free plan->bordered (the system for q'' and multipliers) and its program, which the plan does not use. */
void qdot_plan_drop_bordered(qdot_plan *plan);

/* Operations of the equations it integrates, evaluated once: of M and f, or of what the tree
 * reads; *calls (NULL: not wanted) of them of elementary functions. */
size_t qdot_plan_operations(const qdot_plan *plan, size_t *calls);

/* Whether time occurs in the equations: in M or f, in a constraint, or in an applied force. */
bool qdot_plan_is_driven(const qdot_plan *plan);

/* Release one reference to a plan; the last one frees the plan with all its equations. */
void qdot_plan_free(qdot_plan *plan);

#endif
