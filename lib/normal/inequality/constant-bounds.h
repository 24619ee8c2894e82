/* constant-bounds.h -- inequalities with rational numbers in place of constants such as e, pi, sqrt(2), tan(1).
 *
 *     c + u > 0 follows from r + u > 0 for r <= c:    e - atan(a) > 0 from 2.718 - atan(a) > 0
 *
 * Tests  tests/script/solve/conditions-irrational-ends.lag
 */
#ifndef QDOT_NORMAL_CONSTANT_BOUNDS_H
#define QDOT_NORMAL_CONSTANT_BOUNDS_H

#include "expr/id.h"

/* The terms of a sum that are constants; 0 for other expressions. */
qdot_expr qdot_constant_terms(qdot_pool *pool, qdot_expr e);

/* The sum with a rational number just below in place of its constant terms, if these are no rational number already;
 * `coarse`: one of few digits. Nil: it has no such terms, or they have no value. */
qdot_expr qdot_with_less_constants(qdot_pool *pool, qdot_expr d, bool coarse);

/* Whether a function of numbers alone, as exp(pi/3), is in e. */
bool qdot_holds_constant_function(qdot_pool *pool, qdot_expr e);

/* A condition that follows from u < v or u <= v, without such functions; nil if there is none. */
qdot_expr qdot_weaker_condition(qdot_pool *pool, qdot_expr c);

#endif
