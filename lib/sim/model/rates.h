/* rates.h -- d^2 e/dt^2 where nothing accelerates, node by node.
 *
 * Differentiated as a whole, P = b^r leaves powers r - 1 and r - 2 of b beside each other, of
 * whose series nothing is shared. Here the rates of every node are made of the rates of its
 * parts and of itself,
 *
 *     P' = r b' P/b,   P'' = (r b'' P + (r - 1) b' P')/b;   r = 1/2: P'' = (b''/2 - P'^2)/P
 *
 * and each is one value (qdot_hold). For numbers only.
 *
 * Source  Griewank & Walther, Evaluating Derivatives, 2nd ed., 13.2 (forward mode, second
 *         order).
 * Tests   tests/sim/test_bordered.c
 */
#ifndef QDOT_SIM_RATES_H
#define QDOT_SIM_RATES_H

#include "expr/expr.h"

/* Of e in t and coordinates, q' being constant. Nil without a failure of the pool where there
 * is nothing to gain, e having no power but whole positive ones, and where e has functions but
 * sine and cosine. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_rates_second(qdot_pool *pool, qdot_expr e,
                                              qdot_expr *second);

#endif
