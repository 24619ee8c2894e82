/* list.h -- a list and more members; whether it has a member.
 *
 * Tests   tests/expr/test_list.c
 */
#ifndef QDOT_EXPR_LIST_H
#define QDOT_EXPR_LIST_H

#include "expr/id.h"

/* A list with the members of `list` (nil: none), then more [n]. On failure nil, and the pool has failed. */
qdot_expr qdot_list_appended(qdot_pool *pool, qdot_expr list, size_t n, const qdot_expr *more);
/* Whether e is a member of the list (nil: none). */
bool qdot_list_has(const qdot_pool *pool, qdot_expr list, qdot_expr e);

#endif
