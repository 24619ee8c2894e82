/* build.h -- canonical constructors: sums, products, powers, relations, vectors, matrices, lists.
 *
 * Tests  tests/expr/test_sum.c, tests/expr/test_product.c, tests/expr/test_list.c
 */
#ifndef QDOT_EXPR_BUILD_H
#define QDOT_EXPR_BUILD_H

#include <stddef.h>

#include "expr/id.h"

qdot_expr qdot_add(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_sub(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_neg(qdot_pool *pool, qdot_expr a);
qdot_expr qdot_mul(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_div(qdot_pool *pool, qdot_expr a, qdot_expr b); /* fails with QDOT_EDOMAIN for b = 0 */
qdot_expr qdot_pow(qdot_pool *pool, qdot_expr a, qdot_expr b); /* 0^-1, (-1)^(1/2): fails with QDOT_EDOMAIN */
qdot_expr qdot_pow_int(qdot_pool *pool, qdot_expr a, int64_t n);
qdot_expr qdot_sqrt(qdot_pool *pool, qdot_expr a);
qdot_expr qdot_sum(qdot_pool *pool, size_t n, const qdot_expr *terms);     /* n = 0: returns 0 */
qdot_expr qdot_product(qdot_pool *pool, size_t n, const qdot_expr *factors); /* n = 0: returns 1 */

/* --- other constructors (arithmetic of vectors and matrices: expr/tensor.h) ------------- */

/* Between scalars; numbers are decided at once (QDOT_TRUE, QDOT_FALSE), except EQ, which stays
 * an equation. */
qdot_expr qdot_rel(qdot_pool *pool, qdot_rel_op op, qdot_expr a, qdot_expr b);
qdot_expr qdot_logic(qdot_pool *pool, qdot_logic_op op, uint32_t n, const qdot_expr *args);
qdot_expr qdot_vector(qdot_pool *pool, uint32_t n, const qdot_expr *components);
qdot_expr qdot_matrix(qdot_pool *pool, uint32_t rows, uint32_t columns,
                      const qdot_expr *entries);
qdot_expr qdot_list(qdot_pool *pool, uint32_t n, const qdot_expr *members);
/* The expression of the same kind and operator as e but with other arguments, in canonical form. */
qdot_expr qdot_rebuild(qdot_pool *pool, qdot_expr e, const qdot_expr *args);

#endif
