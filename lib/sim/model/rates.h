/* rates.h -- d^2 e/dt^2 with accelerations 0, node by node.
 *
 * Symbolic differentiation of P = b^r leaves powers r - 1 and r - 2 of b, whose series share
 * nothing. Here the rates of every node are made from those of its operands and from its own
 * value,
 *
 *     P' = r b' P/b,   P'' = (r b'' P + (r - 1) b' P')/b;   r = 1/2: P'' = (b''/2 - P'^2)/P
 *
 * and each is one value (qdot_hold). For numbers only.
 *
 * Source  Griewank & Walther, Evaluating Derivatives, 2nd ed., 13.2 (forward mode, second
 *         order).
 * Tests   tests/sim/form/test_bordered.c
 */
#ifndef QDOT_SIM_RATES_H
#define QDOT_SIM_RATES_H

#include "expr/id.h"

/* For e in t and coordinates, with constant q'. Nil without a failure of the pool if nothing is
 * gained (all powers in e are positive integers), or if e has functions other than sine and
 * cosine. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_rates_second(qdot_pool *pool, qdot_expr e,
                                              qdot_expr *second);

#endif
