/* ostrogradsky.h -- Lagrangians L(q, q', q'', ..., t) of second and higher derivatives.
 *
 *     p_k  = sum_{j >= k} (-d/dt)^(j - k) dL/dq^(j),       k = 1 ... s, s the highest derivative of q in L
 *     h    = sum_q sum_k p_k q^(k) - L
 *     sum_k (-1)^(k + 1) (d/dt)^k dL/dq^(k) = Q            of order 2 s in q
 *
 * p_1 = p[q] goes with q, p_2 = p[q'] with q'. For runs the equations are solved for the derivatives q^(2s), and the
 * coordinates u = q'', q'''' ... (qdot_higher of mech/scene/things.h) make a system of second order of them, q'' = u,
 * u'' = ..., in which every M_ij is 1 or 0. Expressions hold the coordinates u, but print as q'', q'''.
 *
 * Nil on failure; the pool keeps the cause. QDOT_ESINGULAR: the equations do not determine the highest derivatives;
 * QDOT_ENOTBUILT: the equation of one coordinate holds too high derivatives of another.
 *
 * Source  Ostrogradsky (1850); Whittaker, Analytical Dynamics, 110; Pais & Uhlenbeck, Phys. Rev. 79 (1950) 145.
 * Tests   tests/mech/dynamics/test_ostrogradsky.c
 */
#ifndef QDOT_MECH_OSTROGRADSKY_H
#define QDOT_MECH_OSTROGRADSKY_H

#include "mech/scene/things.h"

/* What is applied along coordinate i of the scene: q'' = u_2, u_2'' = u_4, ..., and the equation solved for its highest
 * derivative at the last. */
qdot_expr qdot_ostrogradsky_force(qdot_scene *s, size_t i);
/* The momentum p_k of q; q is a coordinate or, then of k more, one of its derivatives: of q' p_2. */
qdot_expr qdot_ostrogradsky_momentum(qdot_scene *s, qdot_expr q);
/* All of them, in the order of the scene's coordinates, q'' standing for p_2, q'''' for p_3: LIST. */
qdot_expr qdot_ostrogradsky_momenta(qdot_scene *s);
/* The symbol p[q^(k - 1)] that goes with the scene's coordinate q in that list. */
qdot_expr qdot_ostrogradsky_symbol(qdot_scene *s, qdot_expr q);
/* Whether e is a function of the variables of Hamilton's function: of q, q' ... q^(s - 1), momenta and t. */
bool qdot_ostrogradsky_is_canonical(qdot_scene *s, qdot_expr e);
qdot_expr qdot_ostrogradsky_energy(qdot_scene *s);
/* Whether h is proved conserved: no force is applied, and dL/dt = 0. */
bool qdot_ostrogradsky_conserves(qdot_scene *s);
/* The equation of q, LIST of all; solved for the highest derivative: q^(2s), LIST of all. */
qdot_expr qdot_ostrogradsky_equation(qdot_scene *s, qdot_expr q);
qdot_expr qdot_ostrogradsky_equations(qdot_scene *s);
qdot_expr qdot_ostrogradsky_accel(qdot_scene *s, qdot_expr q);
qdot_expr qdot_ostrogradsky_accels(qdot_scene *s);

#endif
