/* substitute.h -- substitutes values of parameters and functions in an expression, exactly. */
#ifndef QDOT_SIM_SUBSTITUTE_H
#define QDOT_SIM_SUBSTITUTE_H

#include "expr/id.h"

/* e with symbols[i] replaced by values[i]. If a symbol is an undefined function of its declared
 * arguments, x(s, t), the value defines the function: every x(a, b) and every derivative of it is
 * replaced by that of the value. e may be any kind of expression. Errors, kept by the pool:
 * QDOT_EINVAL if functions are defined by each other in a circle. */
qdot_expr qdot_substitute(qdot_pool *pool, qdot_expr e, size_t n,
                          const qdot_expr *symbols, const qdot_expr *values);

#endif
