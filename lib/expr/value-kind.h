/* value-kind.h -- checks the result of a constructor, and names kinds of values. */
#ifndef QDOT_EXPR_VALUE_KIND_H
#define QDOT_EXPR_VALUE_KIND_H

#include "expr/id.h"

/* After a constructor: QDOT_OK, or the pool's failure if value is nil. */
QDOT_MUST_CHECK qdot_status qdot_value_kind_check(qdot_pool *pool, qdot_expr value);
/* "a vector", "an equation" ... in a user's words. */
const char *qdot_value_kind_words(const qdot_pool *pool, qdot_expr e);
/* *value = made, with the same check. */
QDOT_MUST_CHECK qdot_status qdot_value_kind_give(qdot_pool *pool, qdot_expr made,
                                                 qdot_expr *value);
bool qdot_value_kind_is_equation(const qdot_pool *pool, qdot_expr e);
/* Whether e is a LIST of equations, at least one. */
bool qdot_value_kind_are_equations(const qdot_pool *pool, qdot_expr e);
/* Left - right of an equation; else e itself. */
qdot_expr qdot_value_kind_difference(qdot_pool *pool, qdot_expr e);
/* Fails with the message, whose %s becomes the kind of x, if x is no symbol. */
QDOT_MUST_CHECK qdot_status qdot_value_kind_need_symbol(qdot_pool *pool, qdot_expr x,
                                                        const char *message);

#endif
