/* substitute.h -- the values of parameters and functions put into an expression,
 * exactly. */
#ifndef QDOT_SIM_SUBSTITUTE_H
#define QDOT_SIM_SUBSTITUTE_H

#include "expr/expr.h"

/* e with symbols[i] replaced by values[i]. A symbol that is an application of an
 * undefined function to its declared arguments, x(s, t), gives the function: every
 * x(a, b) and every derivative of it becomes that of the value. Any kind of
 * expression. Errors, kept by the pool: QDOT_EINVAL where functions are defined by
 * each other in a circle. */
qdot_expr qdot_substitute(qdot_pool *pool, qdot_expr e, size_t n,
                          const qdot_expr *symbols, const qdot_expr *values);

#endif
