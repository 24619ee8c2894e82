/* routh.h -- Routh's elimination for numbers: momenta that are kept in place of the
 * velocities of cyclic coordinates.
 *
 * Where q_c does not stand in L and nothing is applied along it, p_c = dL/dq_c' keeps its
 * value. With M by cyclic (c) and other (s) coordinates and p_c = M_cc q_c' + M_cs q_s' + b:
 *
 *     q_c' = M_cc^-1 (p_c - b - M_cs q_s')
 *     (M_ss - M_sc M_cc^-1 M_cs) q_s'' = f_s - M_sc M_cc^-1 f_c,   q_c' put in,
 *
 * so q_c'' is not needed, q_c stands nowhere, and q_c is a quadrature. In Kepler's problem
 * r'' = p^2/(m^2 r^3) - k/(m r^2), theta' = p/(m r^2) take 2.5 convolutions an order, not 5.
 * Elimination goes pivot by pivot, short ones first; the equations are taken where they are
 * cheaper by count than those with all velocities, and where nothing cancels at the start:
 * a fast top's p_phi - p_psi cos(theta) is small beside its terms, and near the tolerance
 * that a double can hold the velocities themselves are carried.
 *
 * The momentum is found where a solution begins, to twice the precision of a double, and
 * does not change along it (sim/model/momenta.h).
 *
 * Source  Routh, Stability of a Given State of Motion (1877), ch. IV; Goldstein 8.3.
 * Tests   tests/sim/plan/test_routh.c
 */
#ifndef QDOT_SIM_ROUTH_H
#define QDOT_SIM_ROUTH_H

#include "sim/model/equations.h"

/* A coordinate is eliminated only if M couples it with fewer others than this: elimination fills M with entries. */
enum { QDOT_ROUTH_COUPLED = 6 };

/* Into plan->reduced; NULL where nothing is cyclic or nothing is gained, or by a clock. The plan is made
 * but for this, without constraints. */
QDOT_MUST_CHECK qdot_status qdot_routh_reduce(qdot_plan *plan, qdot_scene *scene,
                                              const qdot_run_request *request);

#endif
