/* steady-reduced.h -- steady motions by their equations in independent velocities: with velocity constraints, forces along
 * cyclic coordinates, first-order unknowns, and for unknown rates. Internal to mech/study.
 *
 * The constraints give q' = N(q) u, with u the velocities of some coordinates. The equations of motion along them,
 *
 *     N^T M N u' + R(q, u, z) = 0,   R = N^T (M N' u - f),   z' = g(q, u, z),
 *
 * may not hold some coordinates, although the constraints do: as a rolling disc's place and heading. In a steady motion the
 * coordinates that they do hold rest, the other independent velocities and z are constant: R = 0 and g = 0 relate them. These are
 * solved for the resting coordinates and z, else for rates, or for the rate that is asked for; where a divisor of the solutions
 * vanishes, once more. Stability: steady-parts.h.
 *
 * Source  Neimark & Fufaev, Dynamics of Nonholonomic Systems, VI (1972); Routh, Advanced Part, 5.
 * Tests   tests/script/linear/steady-rates.lag, steady-rolling.lag, steady-sleigh.lag
 */
#ifndef QDOT_MECH_STEADY_REDUCED_H
#define QDOT_MECH_STEADY_REDUCED_H

#include "mech/linear/rest.h"
#include "mech/scene/things.h"

/* Find them; unknown: the rate q' to be solved for, nil: choose. *out is cleared by the caller. QDOT_EINVAL: no rate is
 * free, or the unknown one is none of these; QDOT_EFAILED: not solved; QDOT_ENOTBUILT: many equations, constraints of
 * accelerations or that move. */
QDOT_MUST_CHECK qdot_status qdot_steady_reduced(qdot_scene *s, qdot_expr unknown, qdot_equilibria *out);

/* Whether the stability of a motion given by formulas is open, or known under conditions. */
static inline bool
qdot_steady_is_open(const qdot_equilibrium *e)
{
    return !e->numeric && e->range == QDOT_NIL && (e->stability != QDOT_STABLE || e->stable_when != QDOT_NIL) &&
           !qdot_equilibrium_is_unstable(e);
}
/* Judge those motions of *all whose stability is open by their linear motion, where that decides. */
QDOT_MUST_CHECK qdot_status qdot_steady_judge_linear(qdot_scene *s, qdot_equilibria *all);

#endif
