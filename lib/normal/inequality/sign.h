/* sign.h -- the sign of an expression, by its structure and, of its parts, by proof (inequality.h).
 *
 *     products: factor by factor;   sums: all terms of one sign;   acos(u): 1 - u;   log(u), acosh(u): u - 1
 *     c g(u) - c g(v), g monotonic (roots, log, asin, acos, atan, sinh ...): by u - v
 *
 *     A + c sqrt(B): by A^2 - c^2 B where the signs of A and c differ
 *     sum of c n_i log(u_i), n_i integers: by prod u_i^n_i - 1
 *     c g + r: by a condition 0 < g, where the number c and all of r have one sign
 *     a symbol: by a bound of its domain;   a polynomial: without the factors whose signs are known
 *
 * So the order of two roots of an equation is found, which differ in the argument of one function.
 *
 * Tests  tests/normal/inequality/test_sign.c
 */
#ifndef QDOT_NORMAL_SIGN_H
#define QDOT_NORMAL_SIGN_H

#include "normal/field/facts.h"

/* *sign = 1: 0 < e is proved, -1: e < 0 is; 0: neither. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_sign(qdot_pool *pool, qdot_expr e, const qdot_facts *facts, int *sign);

#endif
