/* quotient.h -- f/M with common factors of M and all terms of f cancelled: -2 r r' theta' - g r
 * sin over r^2 is -(2 r' theta' + g sin)/r, one division and no factor r.
 *
 * Tests  tests/sim/model/test_equations.c
 */
#ifndef QDOT_SIM_QUOTIENT_H
#define QDOT_SIM_QUOTIENT_H

#include "expr/id.h"

/* The quotient f/M, with common factors cancelled. Nil: the pool keeps the failure. */
qdot_expr qdot_quotient(qdot_pool *pool, qdot_expr f, qdot_expr M);

#endif
