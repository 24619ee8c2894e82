/* prepare.h -- prepares expressions for a field: brings the arguments of functions into normal
 * form.
 *
 * Two arguments that are equal become the same node, so that log(a*b - b*a + x) and
 * log(x) are one generator. Roots, absolute values and logarithms are split along the
 * factors of their argument as far as signs are known:
 *
 *     sqrt(4*x^2*y) = 2*abs(x)*sqrt(y),   sqrt(x*y) = sqrt(x)*sqrt(y) for x >= 0,
 *
 * and sin(asin(u) + v), exp(2*log(u)) ... are written without the inverse functions.
 * Every step is an equality wherever the expression before it is defined.
 */
#ifndef QDOT_NORMAL_PREPARE_H
#define QDOT_NORMAL_PREPARE_H

#include "expr/id.h"
#include "normal/field/map.h"

/* e prepared; e itself where that fails (the pool keeps QDOT_ENOMEM and QDOT_EINTR
 * only). */
qdot_expr qdot_prepare(qdot_pool *pool, qdot_expr e);

/* The same; *origins (not NULL) gets, for functions and bases of roots that were
 * rewritten, the node that stood there before. */
qdot_expr qdot_prepare_from(qdot_pool *pool, qdot_expr e, qdot_map *origins);

/* The flat normal form of a prepared scalar: expanded numerator over expanded
 * denominator, coprime; e itself past the budget. */
qdot_expr qdot_prepare_flat(qdot_pool *pool, qdot_expr e, int64_t work);

#endif
