/* construct.c -- makes relations, logical expressions, vectors, matrices and lists; rebuilds nodes
 * with new children. */
#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/pool.h"
#include "expr/walk.h"

#include <string.h>

qdot_expr
qdot_rel(qdot_pool *pool, qdot_rel_op op, qdot_expr a, qdot_expr b)
{
    const fmpq *x, *y;
    qdot_expr args[] = {a, b};

    if (a == QDOT_NIL || b == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    if (!qdot_pool_is_scalar(pool, a) || !qdot_pool_is_scalar(pool, b))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "only numbers can be compared");
    x = NUMBER(pool, a);
    y = NUMBER(pool, b);
    if (op != QDOT_EQ && x != NULL && y != NULL) {
        int d = qdot_rational_cmp(x, y);

        return d < 0 || (d == 0 && op == QDOT_LE) ? QDOT_TRUE : QDOT_FALSE;
    }
    return qdot_pool_intern(pool, QDOT_REL, (uint16_t)op, 2, args, 0);
}

static bool
is_truth_value(const qdot_pool *pool, qdot_expr e)
{
    return e == QDOT_TRUE || e == QDOT_FALSE || NODE(pool, e)->kind == QDOT_REL ||
           NODE(pool, e)->kind == QDOT_LOGIC;
}

/* Replace an equation between numbers, as an operand of and, or, not, by true or false. */
static qdot_expr
decide_equation(const qdot_pool *pool, qdot_expr e)
{
    const qdot_expr *side = ARGS(pool, e);

    if (NODE(pool, e)->kind != QDOT_REL || NODE(pool, e)->op != QDOT_EQ)
        return e;
    if (side[0] == side[1])
        return QDOT_TRUE;
    return NODE(pool, side[0])->kind == QDOT_NUM && NODE(pool, side[1])->kind == QDOT_NUM
               ? QDOT_FALSE
               : e;
}

qdot_expr
qdot_logic(qdot_pool *pool, qdot_logic_op op, uint32_t n, const qdot_expr *args)
{
    qdot_expr kept[16], first;
    uint32_t k = 0;

    if (FAILED(pool))
        return QDOT_NIL;
    for (uint32_t i = 0; i < n; i++) {
        if (args[i] == QDOT_NIL)
            return QDOT_NIL;
        if (!is_truth_value(pool, args[i]))
            return qdot_pool_refuse(pool, QDOT_ETYPE,
                                    "and, or, not join comparisons such as x > 0");
    }
    if (op == QDOT_NOT) {
        first = decide_equation(pool, args[0]);
        if (first == QDOT_TRUE || first == QDOT_FALSE)
            return first == QDOT_TRUE ? QDOT_FALSE : QDOT_TRUE;
        return qdot_pool_intern(pool, QDOT_LOGIC, op, 1, args, 0);
    }
    if (n > 16)
        return qdot_pool_intern(pool, QDOT_LOGIC, op, n, args, 0);
    for (uint32_t i = 0; i < n; i++) {
        first = decide_equation(pool, args[i]);
        if (first == (op == QDOT_AND ? QDOT_FALSE : QDOT_TRUE))
            return first;
        if (first != (op == QDOT_AND ? QDOT_TRUE : QDOT_FALSE))
            kept[k++] = first;
    }
    if (k == 0)
        return op == QDOT_AND ? QDOT_TRUE : QDOT_FALSE;
    return k == 1 ? kept[0] : qdot_pool_intern(pool, QDOT_LOGIC, op, k, kept, 0);
}

/* Check the entries of a vector or matrix: each a number, or an equation between numbers. */
static bool
check_entries(qdot_pool *pool, uint32_t n, const qdot_expr *e)
{
    if (FAILED(pool))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        if (e[i] == QDOT_NIL)
            return false;
        if (!qdot_pool_is_scalar(pool, e[i]) && !is_truth_value(pool, e[i])) {
            qdot_pool_refuse(pool, QDOT_ETYPE, "a component must be a number");
            return false;
        }
    }
    return true;
}

qdot_expr
qdot_vector(qdot_pool *pool, uint32_t n, const qdot_expr *components)
{
    if (!check_entries(pool, n, components))
        return QDOT_NIL;
    if (n < 2)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "a vector has 2 or more components");
    return qdot_pool_intern(pool, QDOT_VEC, 0, n, components, 0);
}

qdot_expr
qdot_matrix(qdot_pool *pool, uint32_t rows, uint32_t columns, const qdot_expr *e)
{
    if (rows == 0 || columns == 0 || columns > UINT16_MAX)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "a matrix of %u rows and %u columns",
                                rows, columns);
    if (!check_entries(pool, rows * columns, e))
        return QDOT_NIL;
    return qdot_pool_intern(pool, QDOT_MAT, (uint16_t)columns, rows * columns, e, 0);
}

qdot_expr
qdot_list(qdot_pool *pool, uint32_t n, const qdot_expr *members)
{
    return qdot_pool_intern(pool, QDOT_LIST, 0, n, members, 0);
}

static qdot_expr
rebuild_sum_or_product(qdot_pool *pool, qdot_kind kind, uint32_t n, const qdot_expr *args)
{
    uint32_t k = (n - 1) / 2 + 1;
    qdot_expr few[32], *parts = k > 32 ? qdot_malloc(k * sizeof *parts) : few, e;

    if (parts == NULL)
        return qdot_pool_fail(pool);
    parts[0] = args[0];
    for (uint32_t i = 1; i < k; i++)
        parts[i] = kind == QDOT_SUM ? qdot_mul(pool, args[2 * i], args[2 * i - 1])
                                    : qdot_pow(pool, args[2 * i - 1], args[2 * i]);
    e = kind == QDOT_SUM ? qdot_sum(pool, k, parts) : qdot_product(pool, k, parts);
    if (parts != few)
        qdot_free(parts);
    return e;
}

qdot_expr
qdot_rebuild(qdot_pool *pool, qdot_expr e, const qdot_expr *args)
{
    qdot_node node = *NODE(pool, e);
    qdot_expr few[64], *own = few, result;
    bool same = true;
    uint32_t n =
        node.kind == QDOT_UFUN ? node.n / 2 : node.n; /* the last n/2 entries of a UFUN are orders of derivatives */

    for (uint32_t i = 0; i < n; i++) {
        if (args[i] == QDOT_NIL)
            return QDOT_NIL;
        same &= args[i] == ARGS(pool, e)[i];
    }
    if (same)
        return e;
    if (node.n > 64 && (own = qdot_malloc(node.n * sizeof *own)) == NULL)
        return qdot_pool_fail(pool);
    memcpy(own, ARGS(pool, e), node.n * sizeof *own);
    memcpy(own, args, n * sizeof *own);
    switch (node.kind) {
    case QDOT_SUM:
    case QDOT_PROD: result = rebuild_sum_or_product(pool, node.kind, node.n, own); break;
    case QDOT_FUN: result = qdot_fun(pool, node.op, node.n, own); break;
    case QDOT_REL: result = qdot_rel(pool, node.op, own[0], own[1]); break;
    case QDOT_LOGIC: result = qdot_logic(pool, node.op, node.n, own); break;
    case QDOT_INTEGRAL: result = qdot_integral_rebuild(pool, e, own); break;
    case QDOT_VEC: result = qdot_vector(pool, node.n, own); break;
    case QDOT_MAT: result = qdot_matrix(pool, node.n / node.op, node.op, own); break;
    case QDOT_UFUN:
        for (uint32_t i = 0; i < node.n / 2; i++)
            if (!qdot_pool_is_scalar(pool, own[i]))
                qdot_pool_refuse(pool, QDOT_ETYPE, "an argument of %s must be a number",
                                 pool->ufuns.at[node.op].name);
        result = qdot_pool_intern(pool, node.kind, node.op, node.n, own, 0);
        break;
    default: result = qdot_pool_intern(pool, node.kind, node.op, node.n, own, node.sign);
    }
    if (own != few)
        qdot_free(own);
    return result;
}

static qdot_expr
release_node(qdot_pool *pool, qdot_expr node, void *user)
{
    (void)user;
    return qdot_expr_is_function(pool, node, QDOT_HOLD) ? qdot_expr_arg(pool, node, 0) : node;
}

qdot_expr
qdot_released(qdot_pool *pool, qdot_expr e)
{
    qdot_expr before = QDOT_NIL;

    while (e != before && e != QDOT_NIL) { /* hold(-x) is -hold(x) when it is built again: no node to replace */
        before = e;
        e = qdot_walk_replace(pool, e, QDOT_FUN, release_node, NULL);
    }
    return e;
}
