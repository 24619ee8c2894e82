/* together.h -- arguments that hold functions, each by the same base angles.
 *
 * By itself cos(2 x) in an argument is normal, and so is cos(x)^2; side by side they are not. So the
 * arguments of all functions are values of one field.
 *
 * Tests   tests/normal/test_decide.c, tests/script/identities-angles.inc
 */
#ifndef QDOT_NORMAL_TOGETHER_H
#define QDOT_NORMAL_TOGETHER_H

#include "expr/expr.h"

/* Rewrite e[n], prepared, in place; *changed. Errors: QDOT_ENOMEM, QDOT_EINTR; the pool may keep a
 * failure. */
QDOT_MUST_CHECK qdot_status qdot_together(qdot_pool *pool, size_t n, qdot_expr *e,
                                          bool *changed);

#endif
