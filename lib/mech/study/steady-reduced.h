/* steady-reduced.h -- steady motions by their equations in independent velocities: with velocity constraints, and for unknown
 * rates. Internal to mech/study.
 *
 * The velocity constraints give q' = N(q) u, with u the velocities of some coordinates. The equations of motion along them,
 *
 *     N^T M N u' + R(q, u) = 0,   R = N^T (M N' u - f),
 *
 * may not hold some coordinates, although the constraints do: as a rolling disc's place and heading. In a steady motion the
 * coordinates that they do hold rest, the other independent velocities are constant, and R = 0 relates both. It is solved for the
 * resting coordinates, else for a rate, or for the rates that are asked for.
 *
 * Stability: in the linear motion det of [lambda 1, -N; dR/dq, lambda N^T M N + dR/du] has lambda = 0 for each free rate; of
 * one resting coordinate a quadratic is left.
 *
 * Source  Neimark & Fufaev, Dynamics of Nonholonomic Systems, VI (1972); Routh, Advanced Part, 5.
 * Tests   tests/script/linear/steady-rates.lag, steady-rolling.lag
 */
#ifndef QDOT_MECH_STEADY_REDUCED_H
#define QDOT_MECH_STEADY_REDUCED_H

#include "mech/linear/rest.h"
#include "mech/scene/things.h"

/* Find them; unknown: a LIST of the rates q' to be solved for, nil: choose. *out is cleared by the caller. QDOT_EINVAL: no rate is
 * free, or an unknown one is none of these; QDOT_EFAILED: not solved; QDOT_ENOTBUILT: several equations, holonomic constraints. */
QDOT_MUST_CHECK qdot_status qdot_steady_reduced(qdot_scene *s, qdot_expr unknown, qdot_equilibria *out);

#endif
