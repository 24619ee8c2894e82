/* constrained-series.h -- Taylor coefficients of a motion under constraints, multipliers with them.
 *
 * With s = (t' - t)/unit, q = sum q_k s^k, q'' = sum a_k s^k, lambda = sum lambda_k s^k:
 *
 *     M_0 a_k - A_0^T lambda_k = f_k - sum_{j=1..k} (M_j a_{k-j} - A_j^T lambda_{k-j})
 *
 * and a constraint adds one row, in which nothing is differentiated:
 *
 *     holonomic     coefficient k + 2 of f is 0, times (k + 1)(k + 2)/unit^2
 *     velocity      coefficient k + 1 of f is 0, times (k + 1)/unit
 *     acceleration  coefficient k of f is 0
 *
 * These are affine in the newest coefficient, with slope A_0 times a_k: f is evaluated
 * with that coefficient taken as 0, and corrected when a_k is known. So the matrix
 * [M_0 A_0^T; A_0 0] is that of the index-1 equations, the same at every order: one
 * factorisation an expansion. Under Baumgarte's damping (sim/model/constrained.h) the rows gain lower
 * coefficients of f.
 *
 * Source  Nedialkov & Pryce, BIT 45 (2005) 561; 47 (2007) 121.
 * Tests   tests/sim/test_constraints.c
 */
#ifndef QDOT_SIM_CONSTRAINED_SERIES_H
#define QDOT_SIM_CONSTRAINED_SERIES_H

#include "ode/system.h"
#include "sim/form/work.h"
#include "sim/model/equations.h"

typedef struct qdot_constrained_series qdot_constrained_series;

/* Of a plan with constraints, borrowed. `shaken` as for qdot_bind_new. Errors:
 * QDOT_ENOTBUILT for equations that switch; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_constrained_series_new(const qdot_plan *plan,
                                                        bool shaken,
                                                        qdot_constrained_series **series);
void qdot_constrained_series_free(qdot_constrained_series *series);

/* Its callbacks; borrowed. */
const qdot_ode_series *qdot_constrained_series_get(const qdot_constrained_series *series);

/* What its expansions consist of. Convolutions an order; how often a matrix was factored. */
qdot_work qdot_constrained_series_work(const qdot_constrained_series *series);
double qdot_constrained_series_convolutions(const qdot_constrained_series *series);
size_t qdot_constrained_series_factored(const qdot_constrained_series *series);

#endif
