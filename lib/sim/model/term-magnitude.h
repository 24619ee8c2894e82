/* term-magnitude.h -- how large the terms of an expression are, of which rounding is a part.
 *
 *     |e| <= sum |c_k t_k|   of a sum  e = sum c_k t_k;   |e| of anything else
 *
 * DBL_EPSILON times that is what evaluating e in doubles may be off by, where its terms
 * cancel: T + V of a run whose energy is 0.
 */
#ifndef QDOT_SIM_TERM_MAGNITUDE_H
#define QDOT_SIM_TERM_MAGNITUDE_H

#include "expr/expr.h"

/* That sum, as an expression; nil absorbs. */
qdot_expr qdot_term_magnitude(qdot_pool *pool, qdot_expr e);

#endif
