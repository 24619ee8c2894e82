/* closed-sum.h -- sums of very many terms by formula.
 *
 *     sum k^p, p = 0, 1 ... 200          Faulhaber's formula
 *     sum r^(alpha k + beta)             (rho^a - rho^(b+1))/(1 - rho) r^beta, rho = r^alpha
 *
 * and linear combinations of these with coefficients free of k. A symbolic rho is generic: not 1.
 * Tests: tests/script/solve/long-sums.lag, tests/bad/solve/sum-too-long.lag
 */
#ifndef QDOT_NORMAL_CLOSED_SUM_H
#define QDOT_NORMAL_CLOSED_SUM_H

#include "expr/id.h"

/* Sums with more terms than this are not added term by term: a formula is needed. */
enum { QDOT_SUM_TERMS = 1000000 };

/* Find the sum of the scalar e over k = first..last by a formula. QDOT_EFAILED: no formula is known. */
QDOT_MUST_CHECK qdot_status qdot_closed_sum(qdot_pool *pool, qdot_expr e, qdot_expr k, int64_t first,
                                            int64_t last, qdot_expr *value);

#endif
