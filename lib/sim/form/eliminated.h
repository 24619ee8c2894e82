/* eliminated.h -- accelerations under few constraints, multipliers eliminated beforehand.
 *
 * Where M is diagonal and there are only a few constraints A q'' = gamma, lambda is made by
 * the tape itself, by L D L^T of S without pivots,
 *
 *     S = A M^-1 A^T,   S lambda = gamma - A M^-1 f,   q'' = M^-1 (f + A^T lambda)
 *
 * so that the motion has the series of an unconstrained one (sim/form/motion-series.h) and no
 * matrix is solved at any order. It takes more convolutions than constraints by their own
 * coefficients (sim/form/motion-of-constraints.h) and its rounding is that of an elimination without
 * a correction: it is for tolerances from QDOT_ELIMINATED_TOL on.
 *
 * Of a rod, a circle or a sphere S_kk = r f_k + c with numbers r and c. Where states are
 * projected f_k is 0, and S_kk = c: so a rod's division, its squares are gone. Left alone,
 * off the constraints, S stays what it is.
 *
 * d_k/S_kk, pivot over diagonal, is the squared sine between a row and those before it. At
 * a state where it is small the other series takes over.
 *
 * Tests  tests/sim/model/test_constraints.c
 */
#ifndef QDOT_SIM_ELIMINATED_H
#define QDOT_SIM_ELIMINATED_H

#include "sim/model/equations.h"

#define QDOT_ELIMINATED_TOL 1e-9

/* The equations of this form, of a plan with constraints, complete but for what sim/plan decides:
 * a plan of its own for plan->eliminated, without its motion; NULL where the form is not for the
 * plan or the tolerance. Errors: those of lowering. */
QDOT_MUST_CHECK qdot_status qdot_eliminated_make(const qdot_plan *plan, double tol,
                                                 qdot_plan **eliminated);

#endif
