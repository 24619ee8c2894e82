/* motion-of-constraints.h -- a motion under constraints as the program of a motion (series/motion.h),
 * constraints by their own coefficients.
 *
 *     coordinate     E_i = sum_j M_ij a_j + sum_c A_ci mu_c - f_i
 *     holonomic      E_c = f_c'' + 2 r f_c' + r^2 f_c
 *     velocity       E_c = f_c' + r f_c
 *     acceleration   E_c = sum_j A_cj a_j - gamma_c
 *
 * The unknowns are a = q'' and mu = -lambda, all in one block; r is 0, or the rate of Baumgarte's
 * damping (sim/model/constrained.h). Nothing is differentiated: f_c leads by two orders of q or one of
 * q', and is affine in the newest of them with the slope A_0. So K = [M A^T; A 0] is that of the
 * index-1 equations. Those of coordinates, the first, are explicit.
 *
 * Source  Nedialkov & Pryce, BIT 45 (2005) 561; 47 (2007) 121.
 * Tests   tests/sim/model/test_constraints.c
 */
#ifndef QDOT_SIM_MOTION_OF_CONSTRAINTS_H
#define QDOT_SIM_MOTION_OF_CONSTRAINTS_H

#include "sim/model/equations.h"

/* Fill plan->constraints->motion. Inputs are q, q', t. Errors: those of the tape's series; QDOT_ENOMEM;
 * the motion is then empty. */
QDOT_MUST_CHECK qdot_status qdot_motion_of_constraints(qdot_plan *plan);

#endif
