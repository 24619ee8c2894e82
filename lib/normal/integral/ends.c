/* ends.c -- values at the ends of a range: by substitution. */
#include "normal/integral/ends.h"

#include "expr/calculus.h"
#include "expr/walk.h"

bool
qdot_end_is_infinite(qdot_pool *pool, qdot_expr at)
{
    (void)pool, (void)at;
    return false;
}

qdot_status
qdot_end_value(qdot_pool *pool, qdot_expr F, qdot_expr x, qdot_expr at, int side, const qdot_facts *facts, qdot_end *end)
{
    (void)side, (void)facts;
    *end = (qdot_end){QDOT_END_UNKNOWN, QDOT_NIL};
    end->value = qdot_subs(pool, F, 1, &x, &at);
    if (end->value != QDOT_NIL)
        end->kind = QDOT_END_VALUE;
    return qdot_grave(qdot_pool_check(pool));
}
