/* term-magnitude.h -- the sum of the magnitudes of an expression's terms.
 *
 *     |e| <= sum |c_k t_k|   of a sum  e = sum c_k t_k;   |e| of anything else
 *     |e| <= min(1, that of a)   of a sine  e = sin(a)
 *
 * DBL_EPSILON times that is the error of evaluating e in doubles if its terms cancel: T + V of a
 * run whose energy is 0.
 */
#ifndef QDOT_SIM_TERM_MAGNITUDE_H
#define QDOT_SIM_TERM_MAGNITUDE_H

#include "expr/id.h"

/* The sum of the magnitudes of a sum's terms, as an expression; nil for nil. */
qdot_expr qdot_term_magnitude(qdot_pool *pool, qdot_expr e);

#endif
