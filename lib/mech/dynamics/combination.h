/* combination.h -- quantities that are combinations of the momenta.
 *
 *     E(q, q', t) = sum xi_i(q, t) p_i + K(q, t),   p_i = dL/dq_i',   xi_i = a_i + b_i t + sum_j c_ij q_j
 *
 * By Lagrange's equations dE/dt = sum xi_i' p_i + xi_i (dL/dq_i + Q_i + R_i) + K', without accelerations. That is worth
 * much where dL/dq' is not linear in q', as of two charges to the order 1/c^2 (Darwin): M(q, q') is long there, and q''
 * far longer. The numbers a, b, c follow from dE/dq' = M xi at random points; then that equation is proved.
 *
 * Source  L. D. Landau, E. M. Lifshitz, The Classical Theory of Fields, sec. 65 (Darwin's Lagrangian)
 * Tests   tests/mech/dynamics/test_rate.c, tests/script/prove/darwin.lag
 */
#ifndef QDOT_MECH_COMBINATION_H
#define QDOT_MECH_COMBINATION_H

#include "mech/scene/scene.h"

/* Whether E is such a combination (*is), with xi [n] for the n coordinates of the scene and *K. Only looked for where M
 * holds velocities. */
QDOT_MUST_CHECK qdot_status qdot_combination_of_momenta(qdot_scene *s, qdot_expr E, qdot_expr *xi, qdot_expr *K, bool *is);

#endif
