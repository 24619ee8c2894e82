/* list.h -- a list and more members.
 *
 * Tests   tests/expr/test_list.c
 */
#ifndef QDOT_EXPR_LIST_H
#define QDOT_EXPR_LIST_H

#include "expr/id.h"

/* A list with the members of `list` (nil: none), then more [n]. On failure nil, and the pool has failed. */
qdot_expr qdot_list_appended(qdot_pool *pool, qdot_expr list, size_t n, const qdot_expr *more);

#endif
