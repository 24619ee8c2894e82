/* constraint.h -- gradients, reactions and derivatives of constraints. Internal to mech/. */
#ifndef QDOT_MECH_CONSTRAINT_H
#define QDOT_MECH_CONSTRAINT_H

#include "mech/scene/scene.h"

/* The gradient of a constraint: df/dq, df/dq' or df/dq'', by its kind. */
qdot_expr qdot_constraint_slope(qdot_scene *s, size_t constraint, size_t i);
/* The constraints' terms on the right of equation i. */
qdot_expr qdot_constraint_reaction(qdot_scene *s, size_t i);
/* The scene's relations and its constraints with their derivatives, for proofs on the
 * constraints' manifold. *relations owned by the caller. */
QDOT_MUST_CHECK qdot_status qdot_constraint_facts(qdot_scene *s, qdot_expr **relations,
                                                  qdot_facts *facts);

#endif
