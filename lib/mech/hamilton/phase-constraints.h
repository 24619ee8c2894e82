/* phase-constraints.h -- constraints beside an H from which no Lagrangian follows.
 *
 *     q' = H_p,   p' = -H_q + Q + sum_k lambda_k G_k,     f_k = 0,   G_k = df_k/dq, or df_k/dq' of a velocity constraint
 *
 * What a constraint says of velocities, g_k = df_k/dt or f_k itself, is with q' = H_p a function g_k(q, p, t). Its derivative
 * along the motion is linear in the multipliers,
 *
 *     dg_k/dt = b_k + sum_l a_kl lambda_l = 0,     a = (dg/dp) G^T = G H_pp G^T for holonomic constraints,
 *
 * and they follow where a is regular. The motion with these lambda(q, p, t) keeps f_k and g_k at their values, so a start on
 * f_k = 0, g_k = 0 stays there.
 *
 * Source  Arnold, Kozlov, Neishtadt, Mathematical Aspects of Classical and Celestial Mechanics, 1.5.2.
 * Tests   tests/mech/hamilton/test_phase_space.c, tests/script/derive/hamiltonian-constraints.lag
 */
#ifndef QDOT_MECH_PHASE_CONSTRAINTS_H
#define QDOT_MECH_PHASE_CONSTRAINTS_H

#include "mech/scene/things.h"

/* lambda [m] of the scene's m constraints, in q, p[q], t. QDOT_ESINGULAR: they are not determined, as constraints repeat each
 * other or H is not curved along them; QDOT_ENOTBUILT: a constraint of accelerations, forces that hold multipliers, rates that jump. */
QDOT_MUST_CHECK qdot_status qdot_phase_constraints_multipliers(qdot_scene *s, qdot_expr *lambda);
/* What constraint k says of velocities, in q, p[q], t. */
qdot_expr qdot_phase_constraints_rate(qdot_scene *s, size_t k);

/* e in momenta p[q], with the scene's multipliers replaced by their values, where the scene states an H alone; else e. */
qdot_expr qdot_phase_constraints_put(qdot_scene *s, qdot_expr e);

#endif
