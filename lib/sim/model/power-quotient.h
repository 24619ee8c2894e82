/* power-quotient.h -- rewrites the force of a spring: (r - c)/r becomes 1 - c/r.
 *
 * (c + k b^p)/b^p becomes k + c b^-p, which saves two products if it is a factor of several
 * forces. It is kept as one value (qdot_hold). The last bits change: for series under loose
 * tolerances.
 *
 * Tests   tests/sim/form/test_bordered.c
 */
#ifndef QDOT_SIM_POWER_QUOTIENT_H
#define QDOT_SIM_POWER_QUOTIENT_H

#include "expr/id.h"

/* Rewrite e: each (c + k b^p)/b^p becomes k + c b^-p. Nil: failed, the pool keeps the failure. */
qdot_expr qdot_power_quotient(qdot_pool *pool, qdot_expr e);

#endif
