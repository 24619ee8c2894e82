/* rewrite.h -- replaces functions by other functions, for proofs only: the result is longer.
 *
 *     acos v = pi/2 - asin v,   asinh v = log(v + sqrt(v^2 + 1)),
 *     acosh v = log(v + sqrt(v^2 - 1)),   atanh v = log((1 + v)/(1 - v))/2,
 *     max(x, y) = (x + y + |x - y|)/2,   min(x, y) = (x + y - |x - y|)/2,
 *     b^x = exp(x log b) for b > 0 and x not a number,
 *     sinh(c log u) = (w - 1/w)/2 with w = u^c,   cosh, tanh likewise,
 *     mod(x, y) = x - y floor(x/y),   floor(x + k) = floor(x) + k for integers k,
 *     and if exp is asked for, sinh, cosh, tanh by exp.
 *
 * Each an equality wherever its left side is defined.
 */
#ifndef QDOT_NORMAL_REWRITE_H
#define QDOT_NORMAL_REWRITE_H

#include "expr/id.h"

/* The expression e with functions rewritten by the rules of this file, children first; nil on failure. */
qdot_expr qdot_rewrite(qdot_pool *pool, qdot_expr e, bool exponentials);

/* The function max(x, y, ...) or min written by absolute values; nil on failure. */
qdot_expr qdot_rewrite_extreme(qdot_pool *pool, qdot_expr e);

/* Whether an exponential occurs in e, or would occur after the rewriting. */
bool qdot_rewrite_has_exp(const qdot_pool *pool, qdot_expr e);

#endif
