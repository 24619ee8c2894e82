/* positive.h -- the shortest condition for an expression to be positive.
 *
 * e is factored; factors whose sign is known (from declared domains, or from conditions that hold
 * already) are dropped:
 *
 *     m*R*(g - R*Omega^2) > 0   is   g > R*Omega^2   for m, R > 0.
 *
 * Tests  tests/normal/solve/test_solve.c
 */
#ifndef QDOT_NORMAL_POSITIVE_H
#define QDOT_NORMAL_POSITIVE_H

#include "normal/field/facts.h"

/* QDOT_TRUE, QDOT_FALSE (e is nowhere positive), or a REL `0 < rest`, its sides without minus
 * signs. known [n]: scalars that are positive already. facts may be NULL. Nil on failure. */
qdot_expr qdot_positive(qdot_pool *pool, qdot_expr e, const qdot_facts *facts, size_t n,
                        const qdot_expr *known);

/* The same without a factor left out that may be 0: `0 < rest` where e > 0, `0 <= rest` where e >= 0, wherever e is
 * defined. TRUE, FALSE: as they are of both. */
qdot_expr qdot_positive_exact(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);
/* QDOT_TRUE, QDOT_FALSE (e is 0), or `0 < |rest|`, where e is not 0 - as far as it is defined: rest is the product of
 * those factors of its numerator, each once, that may be 0. */
qdot_expr qdot_nonzero(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

/* The relation 0 < e with the negative terms of e moved to the left side. */
qdot_expr qdot_positive_without_minus(qdot_pool *pool, qdot_expr e);

/* The expression e - b that a relation b < e or b <= e states to be positive (or not negative). */
qdot_expr qdot_positive_of(qdot_pool *pool, qdot_expr relation);

#endif
