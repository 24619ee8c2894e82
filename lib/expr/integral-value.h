/* integral-value.h -- the number of a definite integral.
 *
 * Between finite ends, where the integrand is analytic but for isolated places within, the value is enclosed: by
 * Gauss-Legendre rules on pieces, each with the bound that the size of the integrand on an ellipse around the piece
 * gives; where it is not analytic, by its range on shorter and shorter pieces. Where that does not converge (an infinite
 * end, a pole of a root at an end) the integral is found by a double exponential substitution,
 *
 *     x = (a + b)/2 + (b - a)/2 tanh(pi/2 sinh t),   x = a + exp(pi/2 sinh t),   x = sinh(pi/2 sinh t),
 *
 * and the trapezoidal rule, its step halved until two sums agree. Their difference is the error: an estimate, not a bound.
 * A narrow peak between the places of the sums is found by a second way: over the range in which the sums have terms, or
 * a wider one, the integral is enclosed, with the logarithm of the distance from an end as variable. If the sums are not in the enclosure,
 * that is the value; if none is found, there is no number.
 *
 * Source  Johansson, "Numerical integration in arbitrary-precision ball arithmetic", ICMS 2018 (acb_calc_integrate);
 *         Takahasi & Mori, "Double exponential formulas for numerical integration", Publ. RIMS 9 (1974) 721
 * Tests   tests/expr/test_integral.c
 */
#ifndef QDOT_EXPR_INTEGRAL_VALUE_H
#define QDOT_EXPR_INTEGRAL_VALUE_H

#include "expr/id.h"
#include "num/arb.h"

/* y = the integral of f, an integrand as it stands in a node, from a to b (infinite ones too); indeterminate where it
 * was not found. *proved: y is an enclosure; otherwise its radius is an estimate. Errors: QDOT_ENOMEM, QDOT_EINTR,
 * QDOT_ENOTBUILT. */
QDOT_MUST_CHECK qdot_status qdot_integral_value(arb_t y, const qdot_pool *pool, qdot_expr f, const arb_t a, const arb_t b,
                                                slong bits, bool *proved);

#endif
