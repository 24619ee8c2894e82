/* value-kind.c -- checks a constructed value, and names its kind. */
#include "expr/value-kind.h"

#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"

qdot_status
qdot_value_kind_check(qdot_pool *pool, qdot_expr value)
{
    if (value != QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_fail(QDOT_EFAILED, "no value was found, and no reason is known");
}

const char *
qdot_value_kind_words(const qdot_pool *pool, qdot_expr e)
{
    switch (qdot_expr_kind(pool, e)) {
    case QDOT_VEC: return "a vector";
    case QDOT_MAT: return "a matrix";
    case QDOT_LIST: return "a list";
    case QDOT_REL:
        return qdot_expr_node(pool, e)->op == QDOT_EQ ? "an equation" : "an inequality";
    case QDOT_LOGIC: return "a condition";
    case QDOT_SYM:
        if (qdot_expr_is_class(pool, e, QDOT_WORDS))
            return "a text";
        /* fall through */
    default: return e == QDOT_TRUE || e == QDOT_FALSE ? "a condition" : "a number";
    }
}

qdot_status
qdot_value_kind_give(qdot_pool *pool, qdot_expr made, qdot_expr *value)
{
    *value = made;
    return qdot_value_kind_check(pool, made);
}

bool
qdot_value_kind_is_equation(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_REL && qdot_expr_node(pool, e)->op == QDOT_EQ;
}

bool
qdot_value_kind_are_equations(const qdot_pool *pool, qdot_expr e)
{
    const uint32_t n = qdot_expr_kind(pool, e) == QDOT_LIST ? qdot_expr_count(pool, e) : 0;

    for (uint32_t i = 0; i < n; i++)
        if (!qdot_value_kind_is_equation(pool, qdot_expr_arg(pool, e, i)))
            return false;
    return n > 0;
}

qdot_expr
qdot_value_kind_difference(qdot_pool *pool, qdot_expr e)
{
    return qdot_value_kind_is_equation(pool, e)
               ? qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1))
               : e;
}

qdot_status
qdot_value_kind_need_symbol(qdot_pool *pool, qdot_expr x, const char *message)
{
    return qdot_expr_kind(pool, x) == QDOT_SYM && x > QDOT_FALSE
               ? QDOT_OK
               : qdot_fail(QDOT_ETYPE, message, qdot_value_kind_words(pool, x));
}
