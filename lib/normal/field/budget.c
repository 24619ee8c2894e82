/* budget.c -- bounds the work of a task within that of its caller. */
#include "normal/field/budget.h"

qdot_budget
qdot_budget_begin(qdot_pool *pool, uint64_t work)
{
    qdot_budget b = {qdot_pool_budget(pool, work), work};

    if (b.before < work) {
        b.granted = b.before;
        (void)qdot_pool_budget(pool, b.before);
    }
    return b;
}

void
qdot_budget_end(qdot_pool *pool, const qdot_budget *b)
{
    const uint64_t left = qdot_pool_budget(pool, b->before);

    if (b->before != UINT64_MAX)
        (void)qdot_pool_budget(pool, b->before - (b->granted - left));
}
