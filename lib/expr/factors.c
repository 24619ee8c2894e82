/* factors.c -- notes what matrices were made of, ascending by their ids. */
#include "expr/factors.h"

#include "base/scope.h"
#include "expr/pool.h"

static bool
is_square(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_MAT && NODE(pool, e)->n == (uint32_t)NODE(pool, e)->op * NODE(pool, e)->op;
}

qdot_expr
qdot_factors_note(qdot_pool *pool, qdot_expr matrix, qdot_expr a, qdot_expr b)
{
    const size_t n = pool->factors.n;
    qdot_scope *scope;

    if (matrix == QDOT_NIL || !is_square(pool, matrix) || !is_square(pool, a) || a >= matrix || b >= matrix ||
        (n > 0 && pool->factors.at[n - 1].matrix >= matrix))
        return matrix;
    scope = qdot_scope_pause(); /* not recorded in the present scope, because the pool outlives the scope */
    if (qdot_vec_push(&pool->factors, ((qdot_factors){matrix, a, b})) != QDOT_OK)
        matrix = qdot_pool_fail(pool);
    qdot_scope_resume(scope);
    return matrix;
}

bool
qdot_factors_of(const qdot_pool *pool, qdot_expr matrix, qdot_expr *a, qdot_expr *b)
{
    const qdot_factors *at = pool->factors.at;
    size_t lo = 0, hi = pool->factors.n;

    while (lo < hi) {
        const size_t mid = lo + (hi - lo) / 2;

        if (at[mid].matrix < matrix)
            lo = mid + 1;
        else
            hi = mid;
    }
    *a = *b = QDOT_NIL;
    if (lo == pool->factors.n || at[lo].matrix != matrix)
        return false;
    *a = at[lo].a;
    *b = at[lo].b;
    return true;
}
