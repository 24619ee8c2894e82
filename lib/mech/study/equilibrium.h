/* equilibrium.h -- the equilibria of a scene and their stability.
 *
 * At rest, q' = q'' = 0, Lagrange's equations and the constraints read
 *
 *     G_i(q, lambda) = 0,   f_k(q) = 0.
 *
 * They are solved for one unknown after another, factor by factor, in all combinations
 * (normal/solve/solve.h); the multipliers are unknowns like the coordinates. A coordinate that
 * occurs in none of them is free and left out. If they depend on time, they must hold at all
 * times. If exact solution fails, places are searched numerically, provided that every parameter
 * has a value; each place found so is proved to be an equilibrium (normal/solve/isolate.h). Where forces
 * jump see equilibrium-corners.c; what is not searched there, equilibrium-kinks.c, makes the list incomplete.
 *
 * Stability. Linearised about a place, in the constraints' tangent space,
 *
 *     M y'' + Gamma y' + H y = 0
 *
 * (mech/linear/linear-motion.h). Every statement is proved:
 *
 *     stable     an energy that never grows (mech/study/lyapunov.h) has a strict minimum there: M
 *     and
 *                H positive definite, or the lowest terms of the potential (stability-degenerate.c),
 *                or one degree of freedom whose force points back on either side;
 *                or all roots of det(M s^2 + Gamma s + H) have negative real parts; or the
 *                equations are linear and the next holds; or nothing can move
 *     unstable   one of the roots has a positive real part: H falls in some direction without gyroscopic
 *                terms, or a condition of Hurwitz is broken; or one degree of freedom whose force points
 *                away on one side and whose energy does not grow
 *     by friction    see mech/study/stability-friction.c: places in a band are stable, or stable where the
 *                    coordinates without friction are
 *     to first order   the linear motion stays near, of the whole nothing is known
 *     undecided  else, always with velocity constraints
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 6.1-6.2; Merkin, Introduction to the Theory of
 *         Stability, 3 and 6 (Lagrange, Dirichlet, Kelvin).
 * Tests   tests/mech/study/test_equilibrium.c, test_stability.c
 */
#ifndef QDOT_MECH_EQUILIBRIUM_H
#define QDOT_MECH_EQUILIBRIUM_H

#include "mech/scene/things.h"
#include "mech/linear/rest.h"

/* *out cleared by the caller. QDOT_EUNSET names a parameter if nothing is found without numbers, QDOT_EFAILED
 * if nothing can be said. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_find(qdot_scene *s, qdot_binder bind,
                                                  void *user, qdot_equilibria *out);

/* Find equilibria up to the first that is not unstable; all if there is none. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_first(qdot_scene *s, qdot_binder bind,
                                                   void *user, qdot_equilibria *out);
/* Judge the stability of one->equations, an equilibrium that exists where one->exists holds, into *one. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_judge(qdot_scene *s, qdot_binder bind, void *user, qdot_equilibrium *one);
void qdot_equilibria_clear(qdot_equilibria *e);

#endif
