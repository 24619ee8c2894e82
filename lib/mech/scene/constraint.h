/* constraint.h -- gradients, reactions and derivatives of constraints. Internal to mech/. */
#ifndef QDOT_MECH_CONSTRAINT_H
#define QDOT_MECH_CONSTRAINT_H

#include "mech/scene/scene.h"

/* The gradient of a constraint f = 0: df/dq, df/dq' or df/dq'' if f is of positions, velocities or accelerations. */
qdot_expr qdot_constraint_slope(qdot_scene *s, size_t constraint, size_t i);
/* The terms with Lagrange multipliers on the right side of the equation of motion of coordinate i. */
qdot_expr qdot_constraint_reaction(qdot_scene *s, size_t i);
/* The scene's relations and its constraints with their derivatives, for proofs on the
 * constraints' manifold. *relations owned by the caller. */
QDOT_MUST_CHECK qdot_status qdot_constraint_facts(qdot_scene *s, qdot_expr **relations,
                                                  qdot_facts *facts);

#endif
