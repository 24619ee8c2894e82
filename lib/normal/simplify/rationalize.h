/* rationalize.h -- removes square roots from denominators: 1/(2 - sqrt(2)) is (2 + sqrt(2))/2.
 *
 * Tests  tests/normal/solve/test_solve.c
 */
#ifndef QDOT_NORMAL_RATIONALIZE_H
#define QDOT_NORMAL_RATIONALIZE_H

#include "normal/field/facts.h"

/* e, a scalar, simplified; with rational denominators where that is no longer. */
qdot_expr qdot_rationalize(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
