/* motion-of-residual.h -- d'Alembert's residual as the program of a motion (series/motion.h).
 *
 *     E_i = sum_f dd_f/dq_i F_f - Q_i,   x_f'' = x_parent'' + d_f'',
 *                                        F_f = sum w x'' + sum of F over the children
 *
 * (residual.h). Rows d lead by 2, their second rates are d''; unknowns are q'', which no row holds.
 *
 * Tests  tests/sim/form/test_motion.c
 */
#ifndef QDOT_SIM_MOTION_OF_RESIDUAL_H
#define QDOT_SIM_MOTION_OF_RESIDUAL_H

#include "series/motion.h"
#include "sim/form/residual.h"

/* Of a plan and its residual, not kept. Inputs are q, q', t; a block of coordinates is one of
 * the motion. Errors: those of series; QDOT_ENOMEM; the motion is then empty. */
QDOT_MUST_CHECK qdot_status qdot_motion_of_residual(const qdot_plan *plan,
                                                    const qdot_residual *residual,
                                                    qdot_motion *motion);

#endif
