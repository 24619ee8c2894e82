/* common.h -- takes common factors out of sums. */
#ifndef QDOT_NORMAL_COMMON_H
#define QDOT_NORMAL_COMMON_H

#include "expr/id.h"

/* A sum with the factors that all its terms share in front, where that is shorter; a product of a
 * fraction and a sum with other numbers in it as that sum, each term with its own. The form of T,
 * of equations, of Hamilton's function. */
qdot_expr qdot_common_out(qdot_pool *pool, qdot_expr e);

#endif
