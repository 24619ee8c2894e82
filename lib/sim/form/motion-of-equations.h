/* motion-of-equations.h -- M q'' = f as the program of a motion (series/motion.h).
 *
 *     a block of one     q'' is an output of the plan's tape
 *     any other          E_i = sum_j M_ij a_j - f_i
 *     with constraints   E_i = sum_j M_ij a_j - sum_c A_ci lambda_c - f_i,
 *                        E_c = sum_j A_cj a_j - gamma_c,
 *                        all in one block; the unknowns are q'' and -lambda; of the tape
 *                        plan->bordered where there is one
 *     momenta kept       q' is an output (sim/plan/routh.h)
 *
 * The equations are explicit (series/motion.h).
 *
 * Tests  tests/sim/form/test_motion.c
 */
#ifndef QDOT_SIM_MOTION_OF_EQUATIONS_H
#define QDOT_SIM_MOTION_OF_EQUATIONS_H

#include "series/motion.h"
#include "sim/model/equations.h"

/* Inputs are those of the plan's tape; rows of its outputs are the program's outputs. The plan is
 * not kept. Errors: those of the tape's series and of constants; QDOT_ENOMEM; the motion is
 * then empty. */
QDOT_MUST_CHECK qdot_status qdot_motion_of_equations(const qdot_plan *plan,
                                                     qdot_motion *motion);

/* The motion for members of an ensemble: parameters that are coordinates of the plan (plan->n_states)
 * are numbers. Inputs are q, q' of the other coordinates, t, these parameters, momenta that are
 * kept. */
QDOT_MUST_CHECK qdot_status qdot_motion_of_members(const qdot_plan *plan, qdot_motion *motion);

#endif
