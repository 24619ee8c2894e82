/* defined.h -- conditions that hold wherever an expression is defined.
 *
 * Sides are compared where both are defined. There
 *
 *     b^(p/q): b >= 0 (b > 0 below a bar),   log u: u > 0,   asin u, acos u: -1 <= u <= 1,
 *     acosh u: u >= 1,   atanh u: -1 < u < 1,
 *
 * for every such node that is always evaluated (not inside an if). A condition gap > 0 is split:
 * for n/d > 0 into the factors of n d without those of known sign; for c (a^2 - x^2) >= 0 with c
 * > 0 into a - x and a + x. A root whose factor may be zero gives no condition: x^2 (y - 1) under
 * a root is |x| times the root of y - 1.
 *
 * Tests  tests/normal/prove/test_decide.c, tests/script/prove/identities-inverse.inc
 */
#ifndef QDOT_NORMAL_DEFINED_H
#define QDOT_NORMAL_DEFINED_H

#include "expr/id.h"

/* Receives a condition for e to be defined: gap >= 0 if `weak`, else gap > 0. */
typedef qdot_status (*qdot_defined_gap)(void *user, qdot_expr gap, bool weak);

/* Tell of each gap of e[n] that the nodes' signs do not know. Errors: QDOT_ENOMEM, QDOT_EINTR, what
 * `tell` returns; the pool may keep a failure. */
QDOT_MUST_CHECK qdot_status qdot_defined(qdot_pool *pool, size_t n, const qdot_expr *e,
                                         qdot_defined_gap tell, void *user);

/* Call `tell` for each of the simpler conditions into which gap >= 0 (or gap > 0) splits. */
QDOT_MUST_CHECK qdot_status qdot_defined_apart(qdot_pool *pool, qdot_expr gap, bool weak,
                                               qdot_defined_gap tell, void *user);

#endif
