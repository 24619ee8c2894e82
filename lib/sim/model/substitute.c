/* substitute.c -- substitutes values: first for functions until none is left, then for symbols. */
#include "sim/model/substitute.h"

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "sim/model/delay.h"

enum { MOST_NESTING = 64 };

typedef struct {
    size_t n;
    const qdot_expr *symbols, *values;
} table;

/* The value given for the user-defined function that `node` applies, or that of a delayed coordinate; nil if there is none. */
static qdot_expr
function_value(qdot_pool *pool, const table *t, qdot_expr node)
{
    const qdot_expr delayed = qdot_ufun_delayed(pool, qdot_expr_node(pool, node)->op);

    if (delayed != QDOT_NIL)
        return qdot_delay_value(pool, delayed, qdot_expr_arg(pool, node, 1) != QDOT_ZERO);
    for (size_t i = 0; i < t->n; i++)
        if (qdot_expr_kind(pool, t->symbols[i]) == QDOT_UFUN
            && qdot_expr_node(pool, t->symbols[i])->op == qdot_expr_node(pool, node)->op)
            return t->values[i];
    return QDOT_NIL;
}

/* The derivative, of the orders in `node`, of the value given for a function, at the node's arguments. */
static qdot_expr
apply_derivative(qdot_pool *pool, qdot_expr node, void *user)
{
    const table *t = user;
    qdot_expr value, formals, *from, *to;
    uint32_t arity;

    if (qdot_expr_kind(pool, node) != QDOT_UFUN)
        return QDOT_NIL;
    value = function_value(pool, t, node);
    if (value == QDOT_NIL)
        return QDOT_NIL;
    arity = qdot_ufun_get(pool, qdot_expr_node(pool, node)->op)->arity;
    formals = qdot_ufun_get(pool, qdot_expr_node(pool, node)->op)->formals;
    from = qdot_malloc(2 * (size_t)arity * sizeof *from);
    if (!from)
        return qdot_pool_fail(pool);
    to = from + arity;
    for (uint32_t i = 0; i < arity; i++) {
        int64_t order = 0;

        from[i] = qdot_expr_arg(pool, formals, i);
        to[i] = qdot_expr_arg(pool, node, i);
        qdot_expr_to_int(pool, qdot_expr_arg(pool, node, arity + i), &order);
        if (order > 0 && qdot_ufun_delayed(pool, qdot_expr_node(pool, node)->op) != QDOT_NIL)
            order--; /* a delayed velocity has a value of its own */
        for (int64_t k = 0; k < order; k++)
            value = qdot_diff(pool, value, from[i]);
    }
    value = qdot_subs(pool, value, arity, from, to);
    qdot_free(from);
    return value;
}

qdot_expr
qdot_substitute(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *symbols,
                const qdot_expr *values)
{
    const uint32_t constant = 1u << QDOT_CONST | QDOT_HAS_FUN;
    table t = {n, symbols, values};
    bool functions = e != QDOT_NIL && (qdot_expr_node(pool, e)->holds & QDOT_HAS_UFUN) != 0;
    qdot_expr *from, before;
    size_t count = 0;

    if (e != QDOT_NIL && (qdot_expr_node(pool, e)->holds & ~constant) == 0)
        return e; /* a constant contains nothing to be substituted */
    for (size_t i = 0; i < n; i++)
        functions |= qdot_expr_kind(pool, symbols[i]) == QDOT_UFUN;
    for (int round = 0; functions && e != QDOT_NIL; round++) {
        before = e;
        e = qdot_walk_map(pool, e, apply_derivative, &t);
        if (e == before)
            break;
        if (round == MOST_NESTING) {
            qdot_fail(QDOT_EINVAL,
                      "the functions that were set are defined by each other in a circle");
            return qdot_pool_fail(pool);
        }
    }
    from = qdot_malloc(2 * (n + 1) * sizeof *from);
    if (!from)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < n; i++)
        if (qdot_expr_kind(pool, symbols[i]) != QDOT_UFUN) {
            from[count] = symbols[i];
            from[n + 1 + count++] = values[i];
        }
    if (count > 0)
        e = qdot_subs(pool, e, count, from, from + n + 1);
    qdot_free(from);
    return e;
}
