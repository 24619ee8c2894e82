/* still.h -- coordinates that stay 0.
 *
 * A coordinate that starts at 0 and at rest stays there if its equation holds nothing else than itself:
 * of the set Z of these, for i in Z,
 *
 *     f_i = 0,  M_ij = 0 (j not in Z)    wherever q_k = q_k' = 0 for k in Z,
 *
 * as a bead on the axis of a turning hoop, or a body in a plane of symmetry. There 0 is exact, not
 * rounded, so the companions (ode/companion.h) are not moved in it, however unstable it is. Only where M
 * then depends on no coordinate: else the motion may meet a place where M is singular, which those moved
 * aside show; and not under constraints. Parameters that events set do not move either.
 *
 * Tests  tests/script/rests/stays.lag
 */
#ifndef QDOT_SIM_STILL_H
#define QDOT_SIM_STILL_H

#include "ode/system.h"
#include "sim/model/equations.h"

/* units [2n]: the scales of the system, 0 for coordinates that stay 0 and for states
 * (plan->n_states), and the velocities of these.
 *   y, low  [2n] the start and what is exact beyond it
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_still_find(const qdot_plan *plan, const qdot_ode_system *system,
                                            double t0, const double *y, const double *low,
                                            double *units);

#endif
