/* integrated.h -- velocity constraints that are holonomic in disguise, by their integrals. Internal
 * to mech/ and sim/.
 *
 * Where mu f = dF/dt, the rows dF/dq_i replace df/dq_i' = (dF/dq_i)/mu. They say the same where mu
 * is finite, and more where f vanishes whatever the velocities (1/mu = 0): a gear's constraint
 * sin(c) (c' + r p') = 0 is c' + r p' = 0 at c = 0 too. F is used where its slopes are finite
 * wherever f has a value; y x' - x y' = 0 stays as it is, since x/y has no slopes at y = 0.
 *
 * The reaction lambda df/dq_i' of the declared constraint is (lambda/mu) dF/dq_i.
 */
#ifndef QDOT_MECH_INTEGRATED_H
#define QDOT_MECH_INTEGRATED_H

#include "mech/scene/scene.h"

/* The integral F of constraint k, and mu with dF/dt = mu f; nil and 1 if none is used. The pool
 * keeps a failure. */
qdot_expr qdot_integrated_of(qdot_scene *s, size_t k, qdot_expr *mu);
/* dF/dq_i of constraint k if F is used, otherwise df/dq_i, df/dq_i' or df/dq_i'' by its kind; nil
 * on failure. */
qdot_expr qdot_integrated_slope(qdot_scene *s, size_t k, size_t i);
/* What runs keep of constraint k: f, mu = 1; or dF/dt = mu f, where the slopes of f may vanish
 * together somewhere, so that lambda of f is mu times that of dF/dt. Nil on failure. */
qdot_expr qdot_integrated_rate(qdot_scene *s, size_t k, qdot_expr *mu);
/* Whether the constraints hold the motion on surfaces in space that stand still or move as the
 * declared holonomic ones do: none is of accelerations, those of velocities are integrable
 * together and free of t (mech/dynamics/integrable.h). */
QDOT_MUST_CHECK qdot_status qdot_mech_is_holonomic(qdot_scene *s, bool *yes);

#endif
