/* residual-adjoint.h -- d'Alembert's residual by one sweep back through its functions.
 *
 *     R_i = sum_f dd_f/dq_i F_f + dV/dq_i - Q_i
 *
 * A place on link k of an arm in space depends on k coordinates, and so do the entries of the link's rotation: N^2 / 2
 * slopes. But as expressions they share what lies further in, rotation k is rotation k - 1 times one more, and are N
 * operations in all. So are the R_i, with F and V as weights of the functions (expr/adjoint). M is needed as numbers at
 * order 0 only: its columns are R for the accelerations d'' of one coordinate at a time (mass-columns.h).
 *
 * Source  Griewank & Walther, Evaluating Derivatives (2008), ch. 3: derivatives by all symbols for the work of the function.
 * Tests   tests/sim/form/test_residual-adjoint.c
 */
#ifndef QDOT_SIM_RESIDUAL_ADJOINT_H
#define QDOT_SIM_RESIDUAL_ADJOINT_H

#include "sim/form/residual.h"

/* Of a scene for a plan without M. *residual NULL: the form does not apply: those of qdot_mech_dalembert, places or a
 * potential that hold t, functions that expr/adjoint cannot pass, or no series. */
QDOT_MUST_CHECK qdot_status qdot_residual_adjoint_new(qdot_scene *scene, const qdot_plan *plan,
                                                      qdot_residual **residual);

#endif
