/* elliptic-ball.h -- Legendre's elliptic integrals and Jacobi's am and dn in balls: enclosures, never rounded.
 *
 * Source  Arb's acb_elliptic; am by Landen's transformation (jacobi.h)
 * Tests   tests/expr/test_elliptic.c
 */
#ifndef QDOT_EXPR_ELLIPTIC_BALL_H
#define QDOT_EXPR_ELLIPTIC_BALL_H

#include "expr/elliptic.h"
#include "num/arb.h"

/* y = f(x[0] ... x[n-1]); indeterminate where it is not known that f is defined there. */
void qdot_elliptic_ball(arb_t y, unsigned f, uint32_t n, const arb_struct *const *x, slong bits);

#endif
