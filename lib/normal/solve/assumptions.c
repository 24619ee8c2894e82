/* assumptions.c -- parameter values and domains of unknowns that follow from the statement `assume`. */
#include "normal/solve/assumptions.h"

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/solve/conditions.h"
#include "normal/solve/special-values.h"

void
qdot_assumptions_clear(qdot_assumptions *a)
{
    qdot_free(a->from.at);
    qdot_free(a->to.at);
    qdot_free(a->others.at);
    *a = (qdot_assumptions){0};
}

qdot_expr
qdot_assumptions_put(qdot_pool *pool, const qdot_assumptions *a, qdot_expr e)
{
    return e == QDOT_NIL || a->from.n == 0 ? e : qdot_subs(pool, e, a->from.n, a->from.at, a->to.at);
}

/* Record the value of a parameter, and insert it into the values recorded before. */
static qdot_status
add_value(qdot_pool *pool, qdot_assumptions *a, qdot_expr parameter, qdot_expr value)
{
    for (size_t i = 0; i < a->to.n; i++)
        a->to.at[i] = qdot_subs(pool, a->to.at[i], 1, &parameter, &value);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_vec_push(&a->from, parameter));
    return qdot_vec_push(&a->to, value);
}

/* Record the value of a parameter at which the expression `zero` vanishes, if there is exactly one. */
static qdot_status
add_relation(qdot_pool *pool, qdot_assumptions *a, qdot_expr zero)
{
    qdot_special_values values = {0};
    qdot_expr from[QDOT_SPECIAL_TOGETHER], to[QDOT_SPECIAL_TOGETHER];
    qdot_status status;

    zero = qdot_assumptions_put(pool, a, zero);
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_special_values_add(pool, 1, &zero, QDOT_NIL, NULL, &values);
    if (status == QDOT_OK && values.at.n == 1 && values.open.n == 0 &&
        qdot_special_sides(pool, values.at.at[0], from, to) == 1)
        status = add_value(pool, a, from[0], to[0]);
    qdot_special_values_clear(&values);
    return status;
}

static bool
contains_unknown(const qdot_pool *pool, qdot_expr e, qdot_expr unknowns)
{
    bool holds = false;

    for (uint32_t i = 0; i < qdot_expr_count(pool, unknowns) && !holds; i++)
        holds = qdot_expr_contains(pool, e, qdot_expr_arg(pool, unknowns, i));
    return holds;
}

qdot_status
qdot_assumptions_read(qdot_pool *pool, const qdot_facts *facts, qdot_expr unknowns, qdot_assumptions *a)
{
    *a = (qdot_assumptions){.facts = *facts, .domain = QDOT_NIL};
    for (size_t i = 0; i < facts->n_relations; i++)
        if (qdot_is_generic(pool, facts->relations[i]))
            QDOT_TRY(add_relation(pool, a, facts->relations[i]));
    for (size_t i = 0; i < facts->n_conditions; i++) {
        const qdot_expr one = facts->conditions[i];

        if (contains_unknown(pool, one, unknowns))
            a->domain = qdot_conditions_and(pool, a->domain, qdot_assumptions_put(pool, a, one));
        else
            QDOT_TRY(qdot_vec_push(&a->others, one));
    }
    a->facts.conditions = a->others.at;
    a->facts.n_conditions = a->others.n;
    return qdot_pool_check(pool);
}
