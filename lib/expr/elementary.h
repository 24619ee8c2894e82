/* elementary.h -- which function a node is.
 *
 * Tests   tests/expr/test_function.c
 */
#ifndef QDOT_EXPR_ELEMENTARY_H
#define QDOT_EXPR_ELEMENTARY_H

#include "expr/expr.h"

/* Whether e is that function of something. */
bool qdot_expr_is_function(const qdot_pool *pool, qdot_expr e, qdot_fun_id id);

#endif
