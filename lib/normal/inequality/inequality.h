/* inequality.h -- is e > 0 (or e >= 0) under conditions? Reduced to algebraic inequalities, which
 * cells.h decides.
 *
 * Substitutions, each an equality or an enlargement of the domain:
 *
 *     floor(u) = u - y, mod(u, m) = m y, 0 <= y < 1;   max, min by absolute values;
 *     |u| = u where u >= 0 and -u where u <= 0;   if(c, a, b): a where c holds, b where it does not;
 *     sin, cos of a base angle by t = tan of its half;   sinh, cosh, exp of a base by E = exp > 0;
 *     asin, acos, atan, atan2, sign and pi: symbols within their bounds;
 *     any other function: a symbol with the sign that its node has.
 *
 * A symbol so bounded does not depend on its argument. If that loses too much and there is one
 * symbol x: from a point a where e is known not to be negative e increases away from a on each
 * side, by the sign of its derivative, which is the same question again, a few times: exp(x) >= 1
 * + x, sin(x) < x for x > 0.
 *
 * Tests  tests/normal/inequality/test_less.c
 */
#ifndef QDOT_NORMAL_INEQUALITY_H
#define QDOT_NORMAL_INEQUALITY_H

#include "normal/field/facts.h"

/* *proved: 0 < e (strict) or 0 <= e. Else *at, if not nil: a point at which that is false, a LIST of
 * equations symbol = rational for all symbols of e and of the conditions; facts->defined is not
 * used. Errors: QDOT_ENOMEM,
 * QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_inequality(qdot_pool *pool, qdot_expr e, bool strict,
                                            const qdot_facts *facts, bool *proved,
                                            qdot_expr *at);

#endif
