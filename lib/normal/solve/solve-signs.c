/* solve-signs.c -- equations with |u(x)| and sign u(x): one case for each sign of u, and u = 0. */
#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/solve/solve.h"

typedef qdot_vec(qdot_root) root_list;

typedef struct {
    qdot_pool *pool;
    qdot_expr f, x, u;
    const qdot_facts *facts;
    root_list roots;
} by_sign;

/* The innermost u of an abs u or sign u in f that holds x; nil: none. */
qdot_expr
qdot_solve_sign(qdot_pool *pool, qdot_expr f, qdot_expr x)
{
    qdot_expr u = QDOT_NIL;
    qdot_walk w;

    if (qdot_walk_begin(pool, f, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && u == QDOT_NIL; i++) {
        uint32_t op = qdot_expr_node(pool, w.at[i])->op;

        if (qdot_expr_kind(pool, w.at[i]) == QDOT_FUN &&
            (op == QDOT_ABS || op == QDOT_SIGN) &&
            qdot_expr_contains(pool, qdot_expr_arg(pool, w.at[i], 0), x))
            u = qdot_expr_arg(pool, w.at[i], 0);
    }
    qdot_walk_end(&w);
    return u;
}

/* A root on the border of the cases, u = 0, counts where f itself is defined and 0. */
static bool
holds(by_sign *s, qdot_expr value)
{
    qdot_expr at = qdot_subs(s->pool, s->f, 1, &s->x, &value);

    if (at == QDOT_NIL && qdot_pool_check(s->pool) == QDOT_EDOMAIN)
        return false;
    return at != QDOT_NIL && qdot_is_zero(s->pool, at, s->facts);
}

/* A root of the case in which `side` u is positive. */
static qdot_status
add(by_sign *s, qdot_root root, qdot_expr side)
{
    qdot_expr there =
        qdot_mul(s->pool, side, qdot_subs(s->pool, s->u, 1, &s->x, &root.value));
    qdot_expr when = QDOT_TRUE;

    QDOT_TRY(qdot_pool_check(s->pool));
    if (!qdot_is_zero(s->pool, there, s->facts))
        when = qdot_positive(s->pool, there, s->facts, 0, NULL);
    else if (!holds(s, root.value))
        when = QDOT_FALSE;
    for (size_t i = 0; i < s->roots.n; i++)
        if (s->roots.at[i].value == root.value)
            when = QDOT_FALSE;
    if (when != QDOT_FALSE && when != QDOT_NIL)
        root.condition = qdot_solve_both(s->pool, root.condition, when);
    QDOT_TRY(qdot_pool_check(s->pool));
    return when == QDOT_FALSE ? QDOT_OK : qdot_vec_push(&s->roots, root);
}

static qdot_status
one_case(by_sign *s, long sign, bool *complete)
{
    qdot_expr side = qdot_expr_int(s->pool, sign);
    qdot_expr from[2] = {qdot_fun1(s->pool, QDOT_ABS, s->u),
                         qdot_fun1(s->pool, QDOT_SIGN, s->u)};
    qdot_expr to[2] = {qdot_mul(s->pool, side, s->u), side};
    qdot_expr f = qdot_subs(s->pool, s->f, 2, from, to);
    qdot_status status = qdot_pool_check(s->pool);
    qdot_root *roots = NULL;
    bool all = false;
    size_t n = 0;

    if (status == QDOT_OK)
        status = qdot_solve(s->pool, f, s->x, s->facts, &roots, &n, &all);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = add(s, roots[i], side);
    *complete = *complete && all;
    qdot_free(roots);
    return status;
}

/* u = 0 itself, where neither case may reach. */
static qdot_status
between(by_sign *s, bool *complete)
{
    qdot_root *roots = NULL;
    bool all = false;
    size_t n = 0;
    qdot_status status = qdot_solve(s->pool, s->u, s->x, s->facts, &roots, &n, &all);

    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = add(s, roots[i], QDOT_ONE);
    *complete = *complete && all;
    qdot_free(roots);
    return status;
}

qdot_status
qdot_solve_by_sign(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_facts *facts,
                   qdot_root **roots, size_t *n, bool *complete)
{
    by_sign s = {
        .pool = pool, .f = f, .x = x, .u = qdot_solve_sign(pool, f, x), .facts = facts};
    qdot_status status;

    *complete = true;
    status = one_case(&s, 1, complete);
    if (status == QDOT_OK)
        status = one_case(&s, -1, complete);
    if (status == QDOT_OK)
        status = between(&s, complete);
    if (status == QDOT_OK)
        status = qdot_solve_sort(pool, s.roots.n, s.roots.at);
    if (status != QDOT_OK) {
        qdot_free(s.roots.at);
        return status;
    }
    *roots = s.roots.at;
    *n = s.roots.n;
    return QDOT_OK;
}
