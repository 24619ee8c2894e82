/* solve-factors.h -- an expression as a product.
 *
 * Tests  tests/normal/solve/test_solve.c
 */
#ifndef QDOT_NORMAL_SOLVE_FACTORS_H
#define QDOT_NORMAL_SOLVE_FACTORS_H

#include "expr/id.h"

/* The factors of f's numerator, each once, numbers left out: f = 0 where one of them
 * is. A LIST; f itself alone where it cannot be factored. */
qdot_expr qdot_solve_factors(qdot_pool *pool, qdot_expr f);

/* The expression e as a product of irreducible factors of its numerator and denominator. */
qdot_expr qdot_solve_product(qdot_pool *pool, qdot_expr e);

#endif
