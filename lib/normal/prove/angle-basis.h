/* angle-basis.h -- writes angles and logarithms by as few of them as possible.
 *
 * A field treats atan(x) and asin(x/sqrt(x^2 + 1)) as independent; in a sum the step of angles
 * (zero.h) finds that they cancel, but not in a product. So relations
 *
 *     A = c1 B1 + c2 B2 + ... + q pi,   c, q small fractions,
 *
 * are guessed from values at points, each is proved, and A is replaced everywhere.
 *
 * Tests   tests/script/prove/identities-inverse.inc, tests/normal/prove/test_verdicts.c
 */
#ifndef QDOT_NORMAL_ANGLE_BASIS_H
#define QDOT_NORMAL_ANGLE_BASIS_H

#include "normal/field/facts.h"

/* Rewrite e[n] in place, *changed. facts: for the points and for the proofs, may be NULL. Errors:
 * QDOT_ENOMEM, QDOT_EINTR; the pool may keep a failure. */
QDOT_MUST_CHECK qdot_status qdot_angle_basis(qdot_pool *pool, size_t n, qdot_expr *e,
                                             const qdot_facts *facts, bool *changed);

#endif
