/* condition.c -- treats equations and inequalities as values and as conditions. */
#include "lang/language/condition.h"

#include "expr/build.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/walk.h"

qdot_status
qdot_condition_relation(qdot_pool *pool, const char *op, qdot_expr a, qdot_expr b,
                        qdot_expr *value)
{
    const qdot_rel_op kind = op[1] == '\0' ? QDOT_LT : QDOT_LE;

    if (op[0] == '=') {
        *value = qdot_value_equation(pool, a, b);
        return qdot_value_kind_check(pool, *value);
    }
    if (!qdot_expr_is_scalar(pool, a) || !qdot_expr_is_scalar(pool, b))
        return qdot_fail(
            QDOT_ETYPE, "`%s` compares numbers, not %s", op,
            qdot_value_kind_words(pool, qdot_expr_is_scalar(pool, a) ? b : a));
    *value = op[0] == '<' ? qdot_rel(pool, kind, a, b) : qdot_rel(pool, kind, b, a);
    return qdot_value_kind_check(pool, *value);
}

bool
qdot_condition_is(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);

    return e == QDOT_TRUE || e == QDOT_FALSE || kind == QDOT_REL || kind == QDOT_LOGIC;
}

static qdot_expr
decide_number_equation(qdot_pool *pool, qdot_expr node, void *user)
{
    qdot_expr a, b;

    (void)user;
    if (qdot_expr_kind(pool, node) != QDOT_REL || qdot_expr_node(pool, node)->op != QDOT_EQ)
        return QDOT_NIL;
    a = qdot_expr_arg(pool, node, 0);
    b = qdot_expr_arg(pool, node, 1);
    if (a == b)
        return QDOT_TRUE;
    return qdot_expr_kind(pool, a) == QDOT_NUM && qdot_expr_kind(pool, b) == QDOT_NUM
               ? QDOT_FALSE
               : QDOT_NIL;
}

qdot_expr
qdot_condition_decide(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_map(pool, e, decide_number_equation, NULL);
}
