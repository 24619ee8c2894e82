/* noether.h -- conserved quantities: cyclic momenta, the energy, linear Noether symmetries.
 *
 * For a transformation q_i -> q_i + e xi_i, t -> t + e tau with
 *
 *     xi_i = a_i + b_i t + sum_j c_ij q_j,   tau constant   (translations, boosts, rotations)
 *
 * under which L changes by a total derivative only,
 *
 *     sum xi_i dL/dq_i + xi_i' dL/dq_i' + tau dL/dt = dK/dt,
 *
 * and along which neither the forces that are not in V nor the constraints' reactions do work,
 * sum (xi_i - tau q_i') (Q_i + R_i) = 0, the quantity
 *
 *     sum p_i xi_i - tau h - K
 *
 * is conserved. Such a K exists if the Euler-Lagrange expression of the left side vanishes; that
 * is linear in a, b, c, tau, and all its solutions over Q(parameters) are found
 * (normal/solve/null-space.h). Every condition is then proved for each of them by the zero
 * decision; solutions without proof are dropped.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 13.7; Olver, Applications of Lie Groups to
 *         Differential Equations, 4.4 (divergence symmetries).
 * Tests   tests/mech/study/test_noether.c
 */
#ifndef QDOT_MECH_NOETHER_H
#define QDOT_MECH_NOETHER_H

#include "mech/scene/things.h"

/* A LIST: cyclic momenta that are conserved, in the order of the coordinates; the energy if it
 * is; then the other symmetries'. Linearly independent. Past 16 coordinates only the first two
 * kinds are looked for. Nil on failure; the pool keeps the cause. */
qdot_expr qdot_noether_conserved(qdot_scene *s);

#endif
