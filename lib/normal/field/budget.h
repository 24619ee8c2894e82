/* budget.h -- a bound of the constructor calls of one task, within the bound of its caller.
 *
 * Tests  tests/normal/integral/test_antiderivative.c
 */
#ifndef QDOT_NORMAL_BUDGET_H
#define QDOT_NORMAL_BUDGET_H

#include "expr/id.h"

typedef struct {
    uint64_t before, granted;
} qdot_budget;

/* Grant the pool `work` constructor calls, or what is left to it where that is less. */
qdot_budget qdot_budget_begin(qdot_pool *pool, uint64_t work);
/* Back to the bound of the caller, less what was used; where that was without bound, it is so again. */
void qdot_budget_end(qdot_pool *pool, const qdot_budget *b);

#endif
