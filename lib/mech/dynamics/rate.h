/* rate.h -- rates along the motion: expressions with accelerations and multipliers put in.
 *
 *     dE/dt = dE/dt|_q + sum dE/dq q' + sum dE/dq' q''(q, q', t)
 *
 * with q'' and lambda as Lagrange's equations and the constraints make them. For the energy and the generalized momenta
 * these equations give the rate without solving for q'' (mech/dynamics/conservation.c).
 *
 * Tests   tests/mech/dynamics/test_rate.c, tests/script/derive/rate.lag
 */
#ifndef QDOT_MECH_RATE_H
#define QDOT_MECH_RATE_H

#include "mech/scene/scene.h"

/* The scalar e with accelerations and multipliers replaced by their solutions; e itself if it holds none. Nil on
 * failure: as of qdot_mech_accel; QDOT_EINVAL: the constraints are redundant, so that a multiplier has no value. */
qdot_expr qdot_rate_on_motion(qdot_scene *s, qdot_expr e);
/* dE/dt along the motion for a scalar E of q, q', q'', t and multipliers, or of q, t and momenta p[q], simplified; 0 where the constraints prove it. */
qdot_expr qdot_rate_of(qdot_scene *s, qdot_expr E);
/* e with q' = dH/dp of a stated H. */
qdot_expr qdot_rate_in_momenta(qdot_scene *s, qdot_expr e);

#endif
