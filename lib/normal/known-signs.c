/* known-signs.c -- |u| and sign u where conditions say which sign u has. */
#include "expr/walk.h"
#include "normal/simplify.h"

/* What takes the place of a node with a sign; nil: nothing. */
static qdot_expr
known(qdot_pool *pool, qdot_expr node, void *user)
{
    uint32_t op = qdot_expr_node(pool, node)->op;
    qdot_decision above, below;
    qdot_expr u;

    if (qdot_expr_kind(pool, node) != QDOT_FUN || (op != QDOT_ABS && op != QDOT_SIGN))
        return QDOT_NIL;
    u = qdot_expr_arg(pool, node, 0);
    if (qdot_decide_less(pool, QDOT_ZERO, u, true, user, &above) != QDOT_OK ||
        qdot_decide_less(pool, u, QDOT_ZERO, true, user, &below) != QDOT_OK)
        return qdot_pool_fail(pool);
    if (above.verdict == QDOT_PROVED)
        return op == QDOT_ABS ? u : QDOT_ONE;
    if (below.verdict == QDOT_PROVED)
        return op == QDOT_ABS ? qdot_neg(pool, u) : QDOT_MINUS_ONE;
    return QDOT_NIL;
}

qdot_expr
qdot_known_signs(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    if (e == QDOT_NIL || facts == NULL || facts->n_conditions == 0)
        return e;
    return qdot_walk_map(pool, e, known, (void *)(uintptr_t)facts);
}
