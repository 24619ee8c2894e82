/* hamilton.h -- Hamilton's function and Routh's; Poisson's bracket.
 *
 *     H(q, p, t) = sum p_i q_i' - L,            all velocities replaced by momenta
 *     R          = L - sum_c p_c q_c',          those of some coordinates c only
 *
 * They are Legendre transforms of L (legendre.h); a stated H is itself. Momenta are the symbols p[q].
 * Nil on failure; the pool keeps the cause.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 8.1 and 8.3, with the opposite sign of R.
 * Tests   tests/mech/hamilton/test_hamilton.c
 */
#ifndef QDOT_MECH_HAMILTON_H
#define QDOT_MECH_HAMILTON_H

#include "mech/scene/things.h"

qdot_expr qdot_hamilton_hamiltonian(qdot_scene *s);
/* A LIST of the coordinates in whose velocities L is linear, where some p = dL/dq' = b(q, t) is not 0: the terms b q' cancel in
 * H, and p - b = 0 is a primary constraint. Nil: there is none, or the pool keeps a failure. */
qdot_expr qdot_hamilton_linear(qdot_scene *s);
/* The Routhian for the coordinates q [n], without repetition; n = 0: for the cyclic ones. */
qdot_expr qdot_hamilton_routhian(qdot_scene *s, uint32_t n, const qdot_expr *q);

/* --- a scene that states H (hamilton-stated.c) ---
 *
 *     q' = dH/dp,    p' = -dH/dq + Q + sum lambda df/d(q, q')
 *
 * L = sum p q' - H is its Legendre transform where q' = dH/dp can be solved for p: QDOT_ESINGULAR, QDOT_EDOMAIN
 * where it cannot. */
QDOT_MUST_CHECK qdot_status qdot_hamilton_lagrangian(qdot_scene *s, qdot_expr *L);
/* QDOT_EINVAL if the scene states an H from which no Lagrangian follows. */
QDOT_MUST_CHECK qdot_status qdot_hamilton_need_lagrangian(qdot_scene *s);
/* Hamilton's equations of a coordinate, a LIST of two, or z' = rate of a state; of all, a LIST. The rate of p is the
 * symbol p[q]'. */
qdot_expr qdot_hamilton_equation(qdot_scene *s, qdot_expr q);
qdot_expr qdot_hamilton_equations(qdot_scene *s);

/* The coordinates that have momenta, all but states, which are functions of time for H. NULL: the pool keeps the failure. */
qdot_expr *qdot_hamilton_moving(const qdot_scene *s, uint32_t *n);

/* e with velocities written in terms of momenta; second function: e with momenta replaced by dL/dq'. */
qdot_expr qdot_hamilton_in_momenta(qdot_scene *s, qdot_expr e);
qdot_expr qdot_hamilton_in_velocities(qdot_scene *s, qdot_expr e);

/* Poisson's bracket sum (df/dq dg/dp - df/dp dg/dq) over all coordinates, f and g scalars; velocities
 * in them are replaced by momenta first. With constraints it is not Dirac's bracket.
 *
 * Source  Goldstein, Poole, Safko, 9.5. */
qdot_expr qdot_hamilton_poisson(qdot_scene *s, qdot_expr f, qdot_expr g);

#endif
