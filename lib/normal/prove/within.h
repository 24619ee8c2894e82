/* within.h -- replaces inverse functions of their own functions within their range:
 *
 *     acos(cos(x)) = x for 0 <= x <= pi, likewise asin and atan; atan2(p sin(x), p cos(x)) = x, p > 0,
 *
 * if the declared domain of x lies in that range.
 *
 * Tests  tests/normal/prove/test_decide.c, tests/script/prove/identities-cases.inc
 */
#ifndef QDOT_NORMAL_WITHIN_H
#define QDOT_NORMAL_WITHIN_H

#include "expr/id.h"

/* The expression e with inverse functions such as asin(sin(x)) replaced by the angle x; nil on failure. */
qdot_expr qdot_within_values(qdot_pool *pool, qdot_expr e);

#endif
