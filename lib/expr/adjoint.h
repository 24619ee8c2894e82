/* adjoint.h -- the derivatives of a sum of many functions by all symbols at once.
 *
 *     out_i = sum_r w_r df_r/dx_i
 *
 * Each node's adjoint is the sum over its users of theirs times the derivative of the user by the node, from the roots down
 * (reverse accumulation): work and size are those of the functions, however many symbols there are. Adjoints stand as held
 * sums (expr/elementary), so that they are not multiplied out.
 *
 * Source  Griewank & Walther, Evaluating Derivatives (2008), ch. 3.
 * Tests   tests/expr/test_adjoint.c: against qdot_diff
 */
#ifndef QDOT_EXPR_ADJOINT_H
#define QDOT_EXPR_ADJOINT_H

#include "expr/id.h"

/* For scalars f [n], weights w [n], which are not differentiated, and symbols x [m]; out [m]. *possible: false where some
 * f depends on a symbol by an integral, an undefined function, max, min, `if` or a power with a varying exponent; out is
 * not defined then. Errors: those that the pool keeps. */
QDOT_MUST_CHECK qdot_status qdot_adjoint(qdot_pool *pool, size_t n, const qdot_expr *f, const qdot_expr *w, size_t m,
                                         const qdot_expr *x, qdot_expr *out, bool *possible);

#endif
