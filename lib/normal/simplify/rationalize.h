/* rationalize.h -- removes square roots from denominators: 1/(2 - sqrt(2)) is (2 + sqrt(2))/2.
 *
 * Tests  tests/normal/solve/test_solve.c
 */
#ifndef QDOT_NORMAL_RATIONALIZE_H
#define QDOT_NORMAL_RATIONALIZE_H

#include "normal/field/facts.h"

/* The scalar e simplified, with rational denominators if that is not longer. */
qdot_expr qdot_rationalize(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
