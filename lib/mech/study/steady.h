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

#include "mech/scene/saved.h"
#include "mech/study/equilibrium.h"

/* The parameter that stands for a rate while the equilibria of the turning scene are found. */
qdot_expr qdot_steady_rate(qdot_pool *pool, qdot_expr rate);

/* *out is cleared by the caller; each has an equation q' = q' for every cyclic coordinate, whose rate is free; where places are
 * found in numbers, with the values that `bind` gives to the rates. unknown: a rate q' that is solved for instead of the
 * coordinates, which are then free, or nil. With velocity constraints, where a cyclic coordinate's momentum is not conserved, and for an
 * unknown rate, the equations are those of mech/study/steady-reduced.h. QDOT_EINVAL: there is no free rate, or `unknown` is none. The scene is as
 * before. */
QDOT_MUST_CHECK qdot_status qdot_steady_find(qdot_scene *s, qdot_expr unknown, qdot_binder bind, void *user, qdot_equilibria *out);

/* --- in coordinates that turn along ---- */

/* The scene while it is written in coordinates that turn along. */
typedef struct {
    qdot_pool *pool;
    size_t n;
    qdot_expr *q, *rate, *w; /* [n] cyclic coordinates, q', and the parameters, or values, that stand for these */
    qdot_scene_saved saved;
} qdot_turning;

/* Write the scene in coordinates that turn along with the rates that `place` names, equations q = value, q' = value, of which
 * q' = q' leaves a rate free; nil: with every rate that can be constant. *at: the equations of the coordinates in these. Then
 * qdot_turning_end brings the scene back, also after a failure. QDOT_EINVAL: a rate is none of a steady motion. */
QDOT_MUST_CHECK qdot_status qdot_turning_begin(qdot_scene *s, qdot_expr place, qdot_turning *x, qdot_expr *at);
void qdot_turning_end(qdot_scene *s, qdot_turning *x);
/* The expression e with the symbols that stood for constant velocities replaced by these, q'. After qdot_turning_end, too. Nil of nil. */
qdot_expr qdot_turning_with_rates(const qdot_turning *x, qdot_expr e);
void qdot_turning_clear(qdot_turning *x);

#endif
