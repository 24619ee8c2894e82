/* kinks.h -- kinks of |u|, max and min that cancel.
 *
 *     max(a, b) = (a + b + |a - b|)/2,   min(a, b) = (a + b - |a - b|)/2
 *
 * Written so, what has a kink at one place in two terms has it in none where these cancel: max(x, 0) - max(-x, 0) = x,
 * |x| + 2 min(x, 0) = x; and |u| is +-u where u has one sign though it holds another absolute value, as x - |x| <= 0:
 * min(x, |x|) = x. Derivatives are taken of that form: those of the terms, each with a value of its own at the kink, do
 * not add up to the derivative of the sum there.
 *
 * Tests  tests/script/prove/kinks-that-cancel.lag
 */
#ifndef QDOT_NORMAL_KINKS_H
#define QDOT_NORMAL_KINKS_H

#include "expr/id.h"

/* The expression e without kinks that cancel each other; e itself if there are none. Nil on failure. */
qdot_expr qdot_kinks_cancel(qdot_pool *pool, qdot_expr e);

#endif
