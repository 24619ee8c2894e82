/* elementary.h -- which function a node is, and where functions occur.
 *
 * Tests   tests/expr/test_function.c
 */
#ifndef QDOT_EXPR_ELEMENTARY_H
#define QDOT_EXPR_ELEMENTARY_H

#include "expr/expr.h"

/* Whether e is that function of something. */
bool qdot_expr_is_function(const qdot_pool *pool, qdot_expr e, qdot_fun_id id);

/* The first node of e, children before parents, that is one of the functions ids [n] and holds x (nil: any). Nil: there
 * is none, or the pool failed. */
qdot_expr qdot_expr_find_function(qdot_pool *pool, qdot_expr e, size_t n, const qdot_fun_id *ids, qdot_expr x);

#endif
