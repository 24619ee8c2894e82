/* list.c -- appends members to a list, and finds whether it has one. */
#include "expr/list.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/node.h"

qdot_expr
qdot_list_appended(qdot_pool *pool, qdot_expr list, size_t n, const qdot_expr *more)
{
    uint32_t old = list == QDOT_NIL ? 0 : qdot_expr_count(pool, list);
    qdot_expr *all = qdot_malloc((old + n + 1) * sizeof *all);

    if (all == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < old; i++)
        all[i] = qdot_expr_arg(pool, list, i);
    for (size_t i = 0; i < n; i++)
        all[old + i] = more[i];
    list = qdot_list(pool, (uint32_t)(old + n), all);
    qdot_free(all);
    return list;
}

bool
qdot_list_has(const qdot_pool *pool, qdot_expr list, qdot_expr e)
{
    for (uint32_t i = 0; list != QDOT_NIL && i < qdot_expr_count(pool, list); i++)
        if (qdot_expr_arg(pool, list, i) == e)
            return true;
    return false;
}
