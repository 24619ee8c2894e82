/* steady.h -- steady motions of a scene: the rates of its cyclic coordinates are constant, all other coordinates rest.
 *
 * In coordinates that turn along, q = q~ + w t for every cyclic q whose momentum is conserved, the scene does not depend on t,
 * and its equilibria are the steady motions of rates w. They are found and judged as those (mech/study/equilibrium.h), with w as
 * parameters that are written q'.
 *
 * Source  Routh, Advanced Part of the Dynamics of a System of Rigid Bodies, chapter 3; Goldstein, Poole, Safko, 8.5.
 * Tests   tests/script/linear/steady.lag
 */
#ifndef QDOT_MECH_STEADY_H
#define QDOT_MECH_STEADY_H

#include "mech/study/equilibrium.h"

/* *out is cleared by the caller; each has an equation q' = q' for every cyclic coordinate, whose rate is free. QDOT_EINVAL:
 * there is no cyclic coordinate with a conserved momentum. The scene is as before. */
QDOT_MUST_CHECK qdot_status qdot_steady_find(qdot_scene *s, qdot_binder bind, void *user, qdot_equilibria *out);

#endif
