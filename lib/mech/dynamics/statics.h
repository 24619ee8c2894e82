/* statics.h -- scenes without masses: forces, springs and constraints in equilibrium,
 *
 *     Q_i + sum_k lambda_k df_k/dq_i = 0,   i = 1 .. n.
 *
 * With as many independent constraints as coordinates, a truss for example, these determine the multipliers; with more
 * the scene is statically indeterminate, with fewer it can move and is at rest at its equilibria only.
 *
 * Tests   tests/mech/dynamics/test_statics.c, tests/script/derive/statics.lag
 */
#ifndef QDOT_MECH_STATICS_H
#define QDOT_MECH_STATICS_H

#include "mech/scene/scene.h"

/* Whether nothing in the scene has mass, and no Lagrangian is stated. */
bool qdot_statics_applies(const qdot_scene *s);
/* Whether something acts or constrains, so that there are equations of equilibrium. */
bool qdot_statics_acts(const qdot_scene *s);
/* lambda of constraint k, simplified. Nil on failure: QDOT_EINVAL unless the scene is statically determinate. */
qdot_expr qdot_statics_multiplier(qdot_scene *s, size_t k);

#endif
