/* tensor.h -- arithmetic on values of any kind: scalars, vectors, matrices, lists, equations.
 *
 * Wrong kinds or sizes: QDOT_ETYPE with a message for users.
 */
#ifndef QDOT_EXPR_TENSOR_H
#define QDOT_EXPR_TENSOR_H

#include "expr/id.h"

qdot_expr qdot_value_add(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_value_sub(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_value_neg(qdot_pool *pool, qdot_expr a);
qdot_expr qdot_value_mul(qdot_pool *pool, qdot_expr a, qdot_expr b); /* number*x, matrix*vector, matrix*matrix */
qdot_expr qdot_value_div(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_value_pow(qdot_pool *pool, qdot_expr a, qdot_expr b); /* scalar powers; M^n for square M, n >= 0 */
/* a = b; between vectors and matrices component by component: a VEC of equations. */
qdot_expr qdot_value_equation(qdot_pool *pool, qdot_expr a, qdot_expr b);

qdot_expr qdot_dot(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_cross(qdot_pool *pool, qdot_expr a, qdot_expr b); /* cross product; of plane vectors the scalar a1 b2 - a2 b1 */
qdot_expr qdot_norm(qdot_pool *pool, qdot_expr a);
qdot_expr qdot_transpose(qdot_pool *pool, qdot_expr a);
qdot_expr qdot_trace(qdot_pool *pool, qdot_expr a);
qdot_expr qdot_det(qdot_pool *pool, qdot_expr a);     /* computed without fractions if possible */
qdot_expr qdot_inverse(qdot_pool *pool, qdot_expr a); /* inverse as adjugate / det; fails with QDOT_ESINGULAR for det = 0 */
/* The i-th entry of a value, counted from 1; QDOT_EDOMAIN, with the allowed range, if there is none. */
qdot_expr qdot_entry(qdot_pool *pool, qdot_expr a, int64_t i);
qdot_expr qdot_entry2(qdot_pool *pool, qdot_expr a, int64_t i, int64_t j);

/* Apply f to every scalar inside a value (vector, matrix, list, relation or logical expression). */
qdot_expr qdot_value_map(qdot_pool *pool, qdot_expr e,
                         qdot_expr (*f)(qdot_pool *pool, qdot_expr scalar, void *user),
                         void *user);

#endif
