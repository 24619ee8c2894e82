/* multiplier-forces.h -- forces that hold multipliers, such as friction in a constraint, -mu |lambda| sign(v).
 *
 * Where all forces that hold multipliers are set to 0 the constraints need the multipliers L(q, q', t). Those forces, if
 * they are linear in lambda and |lambda|, change them to
 *
 *     lambda_k = L_k + sum_j G_kj lambda_j + H_kj |lambda_j|
 *
 * (Newton's and Coulomb's laws together). Constraint by constraint, of which each only depends on those before it,
 *
 *     lambda = l / (1 - h sign(l)),   |lambda| = |l| / (1 - h sign(l)),   l = L/(1 - G),  h = H/(1 - G),
 *
 * which is the one solution as long as |h| < 1. Beyond, there is none or there are two (Painleve's paradox): the value
 * is then undefined, a root of -1. Of two constraints that depend on each other the signs are tried, and the solution is the only
 * one while the determinants for all signs are positive. On the sides v > 0 and v < 0 h differs; between them a motion that sticks has the mean of both
 * accelerations with v' = 0, as anything linear in the friction force.
 *
 * Source  Painleve, C. R. Acad. Sci. Paris 121 (1895) 112; Brogliato, Nonsmooth Mechanics, 3rd ed. 2016, 5.6.
 * Tests   tests/script/contacts/friction-multipliers.lag, tests/mech/dynamics/test_multiplier-forces.c
 */
#ifndef QDOT_MECH_MULTIPLIER_FORCES_H
#define QDOT_MECH_MULTIPLIER_FORCES_H

#include "mech/scene/scene.h"

/* The force e (a scalar or vector) with the values of multipliers put in; e itself if it holds none. Nil on failure: of
 * qdot_mech_multiplier; QDOT_ENOTBUILT if it is not linear in lambda and |lambda|, or if more than two constraints
 * act on each other's friction; QDOT_ESINGULAR. */
qdot_expr qdot_without_multipliers(qdot_scene *s, qdot_expr e);

/* Whether a force that was asked for is undefined where a multiplier has no value, or two. */
bool qdot_multipliers_are_bound(qdot_scene *s);

#endif
