/* together.h -- writes the arguments of all functions by the same base angles.
 *
 * As the only argument cos(2 x) is in normal form, and so is cos(x)^2; together they are not. So
 * the arguments of all functions become values of one field.
 *
 * Tests   tests/normal/prove/test_decide.c, tests/script/prove/identities-angles.inc
 */
#ifndef QDOT_NORMAL_TOGETHER_H
#define QDOT_NORMAL_TOGETHER_H

#include "expr/id.h"

/* Rewrite e[n], prepared, in place; *changed. Errors: QDOT_ENOMEM, QDOT_EINTR; the pool may keep a
 * failure. */
QDOT_MUST_CHECK qdot_status qdot_together(qdot_pool *pool, size_t n, qdot_expr *e,
                                          bool *changed);

#endif
