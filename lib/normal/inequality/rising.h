/* rising.h -- inequalities without the functions around their unknowns that rise.
 *
 *     asinh(u) > 0 where u > 0,   log(u) > 0 and acosh(u) > 0 where u > 1,   sqrt(u) > c where u > c^2, c >= 0
 *
 * Tests  tests/normal/inequality/test_less.c
 */
#ifndef QDOT_NORMAL_RISING_H
#define QDOT_NORMAL_RISING_H

#include "expr/id.h"

/* What is positive (`strict`; else: not negative) wherever e is, and the other way round, provided that e is defined; e itself
 * where there is nothing to take away. */
qdot_expr qdot_without_rising(qdot_pool *pool, qdot_expr e, bool strict);

/* Whether e is a product with a factor u^(n/2), n odd: sqrt(u), 1/sqrt(u), u^(3/2) ... */
bool qdot_has_square_root(const qdot_pool *pool, qdot_expr e);

#endif
