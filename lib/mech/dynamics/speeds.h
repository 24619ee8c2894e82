/* speeds.h -- equations of motion in quasi-velocities (Kane's speeds).
 *
 * Speeds u_k = E_k(q, q', t), linear in q', as many as there are degrees of freedom, and the constraints as velocities
 * determine
 *
 *     q_i' = sum_j b_ij(q, t) u_j + g_i(q, t),
 *
 * where b spans the velocities that the constraints allow. Lagrange's equations M q'' = f + A^T lambda projected on it,
 *
 *     sum_i b_ij (sum_l M_il q_l'' - f_i) = 0,   q'' = b u' + b' u + g',
 *
 * are one first-order equation for each speed, without multipliers. First-order unknowns z' = g of the scene keep theirs.
 *
 * Source  Kane, Levinson, Dynamics: Theory and Applications, 4.4 and 6.1; Neimark, Fufaev, Dynamics of Nonholonomic
 *         Systems, ch. III (Boltzmann, Hamel, Gibbs, Appell).
 * Tests   tests/mech/dynamics/test_speeds.c
 */
#ifndef QDOT_MECH_SPEEDS_H
#define QDOT_MECH_SPEEDS_H

#include "mech/scene/scene.h"

/* symbol [n]: what a speed is called, a symbol that has jets (class QDOT_COORD) but is no coordinate of the scene;
 * value [n]: E_k. Borrowed. */
typedef struct qdot_speeds {
    size_t n;
    const qdot_expr *symbol, *value;
} qdot_speeds;

/* QDOT_EINVAL: E, what the speed `name` stands for, is not linear in the velocities. */
QDOT_MUST_CHECK qdot_status qdot_speeds_check_linear(qdot_scene *s, qdot_expr E, const char *name);
/* Whether n speeds are as many as the scene needs, and its constraints are of positions or velocities. */
bool qdot_speeds_suffice(qdot_scene *s, size_t n);
/* The equations of the velocities, A q' = b with A [n * n], b [n], n coordinates: a row for each speed, E_k = u_k, and for
 * each independent constraint; for a first-order unknown z' = 0, as its rate is known from elsewhere. Errors as below, but
 * for velocities that are not determined. */
QDOT_MUST_CHECK qdot_status qdot_speeds_rows(qdot_scene *s, const qdot_speeds *speeds, qdot_expr *A, qdot_expr *b);
/* velocity [coordinates]: q_i' in q, u, t. QDOT_EINVAL: a speed is not linear in the velocities, their number is not that of
 * the degrees of freedom, or they do not determine the velocities; a constraint of accelerations. */
QDOT_MUST_CHECK qdot_status qdot_speeds_kinematics(qdot_scene *s, const qdot_speeds *speeds, qdot_expr *velocity);
/* equation [n]: sum_k m_jk u_k' = rest in q, u, t, simplified; velocity: from qdot_speeds_kinematics. */
QDOT_MUST_CHECK qdot_status qdot_speeds_equations(qdot_scene *s, const qdot_speeds *speeds, const qdot_expr *velocity,
                                                  qdot_expr *equation);
/* Both, kept until the scene changes or other speeds are asked about; borrowed. */
QDOT_MUST_CHECK qdot_status qdot_speeds_motion(qdot_scene *s, const qdot_speeds *speeds, const qdot_expr **velocity,
                                               const qdot_expr **equation);
/* rate [n]: u_k' in q, u, t, simplified, as the equations make it. QDOT_ESINGULAR: a speed moves no mass. */
QDOT_MUST_CHECK qdot_status qdot_speeds_rates(qdot_scene *s, const qdot_speeds *speeds, const qdot_expr *equation,
                                              qdot_expr *rate);
/* *states: the same motion as a scene of first-order unknowns, the coordinates and then the speeds, with the inputs of s; free
 * it with qdot_scene_free. */
QDOT_MUST_CHECK qdot_status qdot_speeds_scene(qdot_scene *s, const qdot_speeds *speeds, qdot_scene **states);

#endif
