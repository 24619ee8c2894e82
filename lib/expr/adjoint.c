/* adjoint.c -- reverse accumulation of derivatives through the nodes of expressions. */
#include "expr/adjoint.h"

#include <string.h>

#include "expr/build.h"
#include "expr/pool.h"
#include "expr/walk.h"

/* One summand of the adjoint of a node; `next` is the index + 1 of another one, 0: none. */
typedef struct {
    qdot_expr term;
    uint32_t next;
} summand;

typedef struct {
    qdot_pool *pool;
    qdot_walk w; /* the value of a node: index + 1 of the newest summand of its adjoint, 0: none */
    qdot_vec(summand) summands;
    qdot_vec(qdot_expr) terms;
    uint32_t touches; /* bits of the symbols */
    bool possible;
} accumulation;

static bool
may_vary(const accumulation *a, qdot_expr e)
{
    return (NODE(a->pool, e)->touches & a->touches) != 0;
}

static void
add_summand(accumulation *a, qdot_expr node, qdot_expr term)
{
    const summand s = {term, (uint32_t)qdot_walk_get(&a->w, node)};

    if (qdot_vec_push(&a->summands, s) != QDOT_OK)
        qdot_pool_fail(a->pool);
    else
        qdot_walk_set(&a->w, node, a->summands.n);
}

/* The adjoint of a node, of which all users have been passed. */
static qdot_expr
adjoint_of_node(accumulation *a, qdot_expr node)
{
    a->terms.n = 0;
    for (uint32_t k = (uint32_t)qdot_walk_get(&a->w, node); k != 0; k = a->summands.at[k - 1].next)
        if (qdot_vec_push(&a->terms, a->summands.at[k - 1].term) != QDOT_OK)
            return qdot_pool_fail(a->pool);
    return qdot_hold(a->pool, qdot_sum(a->pool, a->terms.n, a->terms.at));
}

/* Pass the adjoint of a sum or product on to its terms or to the bases of its factors. */
static void
pass_to_pairs(accumulation *a, qdot_expr node, qdot_expr adjoint)
{
    qdot_pool *pool = a->pool;
    const bool sum = NODE(pool, node)->kind == QDOT_SUM;
    const uint32_t n = NODE(pool, node)->n;

    for (uint32_t i = 1; i < n && !FAILED(pool); i += 2) {
        const qdot_expr part = ARGS(pool, node)[i], factor = ARGS(pool, node)[i + 1];

        if (!sum && may_vary(a, factor))
            a->possible = false;
        if (may_vary(a, part))
            add_summand(a, part,
                        sum ? qdot_mul(pool, factor, adjoint) : qdot_product_derived(pool, node, i, adjoint));
    }
}

static void
pass_to_arguments(accumulation *a, qdot_expr node, qdot_expr adjoint)
{
    qdot_pool *pool = a->pool;
    const qdot_fun_id id = NODE(pool, node)->op;
    const uint32_t n = NODE(pool, node)->n;
    qdot_expr args[4];

    if (n > 4 || id == QDOT_MIN || id == QDOT_MAX || id == QDOT_IF) {
        a->possible = false;
        return;
    }
    memcpy(args, ARGS(pool, node), n * sizeof *args);
    for (uint32_t i = 0; i < n && !FAILED(pool); i++)
        if (may_vary(a, args[i]))
            add_summand(a, args[i],
                        id == QDOT_HOLD ? adjoint
                                        : qdot_mul(pool, adjoint, qdot_fun_derivative(pool, id, n, args, i)));
}

static void
accumulate(accumulation *a)
{
    for (size_t i = a->w.n; i-- > 0 && a->possible && !FAILED(a->pool);) {
        const qdot_expr node = a->w.at[i];
        const qdot_kind kind = NODE(a->pool, node)->kind;
        qdot_expr adjoint;

        if (a->w.value[i] == 0 || !may_vary(a, node) || kind == QDOT_SYM)
            continue;
        adjoint = adjoint_of_node(a, node);
        if (kind == QDOT_SUM || kind == QDOT_PROD)
            pass_to_pairs(a, node, adjoint);
        else if (kind == QDOT_FUN)
            pass_to_arguments(a, node, adjoint);
        else
            a->possible = false;
    }
}

qdot_status
qdot_adjoint(qdot_pool *pool, size_t n, const qdot_expr *f, const qdot_expr *w, size_t m, const qdot_expr *x,
             qdot_expr *out, bool *possible)
{
    accumulation a = {.pool = pool, .possible = true};

    *possible = false;
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_walk_begin_n(pool, n, f, &a.w));
    for (size_t i = 0; i < m; i++)
        a.touches |= NODE(pool, x[i])->touches;
    for (size_t r = 0; r < n; r++)
        if (may_vary(&a, f[r]) && w[r] != QDOT_ZERO)
            add_summand(&a, f[r], w[r]);
    accumulate(&a);
    for (size_t i = 0; i < m && !FAILED(pool); i++)
        out[i] = qdot_walk_index(&a.w, x[i]) == SIZE_MAX ? QDOT_ZERO : adjoint_of_node(&a, x[i]);
    *possible = a.possible;
    qdot_walk_end(&a.w);
    qdot_free(a.summands.at);
    qdot_free(a.terms.at);
    return qdot_pool_check(pool);
}
