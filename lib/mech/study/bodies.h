/* bodies.h -- momentum, angular momentum, inertia and energy of a particle, a body or the scene.
 *
 *     p   = m r'
 *     L_P = (r - P) x m r' + A I A^T w
 *     J_P = A I A^T + m (|d|^2 1 - d d^T),   d = r - P
 *     E   = 1/2 m r'^2 + 1/2 w.A I A^T w - m g.r
 *
 * with mass m at r, the body's axes the columns of A, its inertia I about the centre in these axes, its spin w and the
 * uniform fields g. P is a place, which may move: L_P is made of the velocities r' in the frame of the scene, not of
 * those relative to P. All components are along the axes of space. In the plane L and J are numbers.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 1.2, 5.1 and 5.3.
 * Tests   tests/mech/study/test_bodies.c, tests/script/derive/bodies.lag
 */
#ifndef QDOT_MECH_BODIES_H
#define QDOT_MECH_BODIES_H

#include "mech/scene/things.h"

/* label: a particle or body; NULL: the sum over the scene, QDOT_EINVAL where it has neither. about: P, as many components
 * as positions have; nil: the origin. Simplified; nil on failure, the pool keeps the cause. QDOT_EDOMAIN on a line. */
qdot_expr qdot_bodies_momentum(qdot_scene *s, const char *label);
qdot_expr qdot_bodies_angular_momentum(qdot_scene *s, const char *label, qdot_expr about);
/* about: nil: its own centre. */
qdot_expr qdot_bodies_inertia(qdot_scene *s, const char *label, qdot_expr about);
/* Kinetic energy, and potential energy in the fields of gravity; no part of springs and potentials. */
qdot_expr qdot_bodies_energy(qdot_scene *s, const char *label);

#endif
