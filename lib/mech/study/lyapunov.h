/* lyapunov.h -- decides whether some energy of a scene never grows. Internal to mech/.
 *
 * Let Q_i be the forces declared in addition to L, and F_i = Q_i at q' = 0. If dF_i/dq_j =
 * dF_j/dq_i, there is a potential U near each place, F = -dU/dq, and
 *
 *     E = sum q' dL/dq' - L + U,   dE/dt = -dL/dt + sum q'_i (Q_i - F_i):
 *
 * constraints between coordinates alone do no work. E is conserved (KEPT) if dE/dt is 0, and
 * dissipated (USED) if dE/dt is proved never positive. E has a minimum if M is positive definite
 * (velocities) and so is the Hessian of E at rest (coordinates), H of mech/linear/linear-motion.h.
 *
 * Source  Merkin, Introduction to the Theory of Stability, 3 (Lagrange, Dirichlet) and 6 (Kelvin, Chetaev).
 */
#ifndef QDOT_MECH_LYAPUNOV_H
#define QDOT_MECH_LYAPUNOV_H

#include "mech/scene/things.h"

typedef enum { QDOT_ENERGY_UNKNOWN, QDOT_ENERGY_KEPT, QDOT_ENERGY_USED } qdot_energy_law;

QDOT_MUST_CHECK qdot_status qdot_energy_law_of(qdot_scene *s, qdot_energy_law *law);

#endif
