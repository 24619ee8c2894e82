/* power-quotient.h -- what a spring's force is divided by, once: (r - c)/r becomes 1 - c/r.
 *
 * A sum of a power and a number, c + k b^p, over that power, is k + c b^-p: two products less where
 * it is a factor of several forces. Its last bits are others, and it is one value (qdot_hold): for
 * series under loose tolerances.
 *
 * Tests   tests/sim/test_bordered.c
 */
#ifndef QDOT_SIM_POWER_QUOTIENT_H
#define QDOT_SIM_POWER_QUOTIENT_H

#include "expr/expr.h"

/* Everywhere in e. Nil: the pool keeps the failure. */
qdot_expr qdot_power_quotient(qdot_pool *pool, qdot_expr e);

#endif
