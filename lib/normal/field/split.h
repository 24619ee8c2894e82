/* split.h -- splits roots, absolute values and logarithms of products by the known signs of
 * factors. */
#ifndef QDOT_NORMAL_SPLIT_H
#define QDOT_NORMAL_SPLIT_H

#include "expr/id.h"

/* The power b^x, for a prepared base b and a rational x that is not an integer. */
qdot_expr qdot_split_power(qdot_pool *pool, qdot_expr b, qdot_expr x);
/* |b|, or log b, for a prepared base b. */
qdot_expr qdot_split_abs(qdot_pool *pool, qdot_expr b);
qdot_expr qdot_split_log(qdot_pool *pool, qdot_expr b);

#endif
