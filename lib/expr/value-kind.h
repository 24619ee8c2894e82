/* value-kind.h -- checks the result of a constructor, and names kinds of values. */
#ifndef QDOT_EXPR_VALUE_KIND_H
#define QDOT_EXPR_VALUE_KIND_H

#include "expr/id.h"

/* Call after a constructor: returns QDOT_OK, or the failure of the pool if the value is nil. */
QDOT_MUST_CHECK qdot_status qdot_value_kind_check(qdot_pool *pool, qdot_expr value);
/* The kind of the value e in a user's words: "a vector", "an equation" ... */
const char *qdot_value_kind_words(const qdot_pool *pool, qdot_expr e);
/* Set *value to `made`, the result of a constructor; fails as qdot_value_kind_check does. */
QDOT_MUST_CHECK qdot_status qdot_value_kind_give(qdot_pool *pool, qdot_expr made,
                                                 qdot_expr *value);
bool qdot_value_kind_is_equation(const qdot_pool *pool, qdot_expr e);
/* Whether e is a LIST of equations, with at least one. */
bool qdot_value_kind_are_equations(const qdot_pool *pool, qdot_expr e);
/* Left minus right side of an equation; other expressions unchanged. */
qdot_expr qdot_value_kind_difference(qdot_pool *pool, qdot_expr e);
/* Fail with `message`, whose %s becomes the kind of x, unless x is a symbol. */
QDOT_MUST_CHECK qdot_status qdot_value_kind_need_symbol(qdot_pool *pool, qdot_expr x,
                                                        const char *message);

#endif
