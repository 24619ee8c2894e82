/* quotient.h -- f/M, what the terms of f share with M cancelled: -2 r r' theta' - g r sin
 * over r^2 is -(2 r' theta' + g sin)/r, one division and no factor r, where a product in
 * front of a sum would keep both.
 *
 * Tests  tests/sim/test_equations.c
 */
#ifndef QDOT_SIM_QUOTIENT_H
#define QDOT_SIM_QUOTIENT_H

#include "expr/expr.h"

/* Nil: the pool keeps the failure. */
qdot_expr qdot_quotient(qdot_pool *pool, qdot_expr f, qdot_expr M);

#endif
