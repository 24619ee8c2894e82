/* equilibrium-twice.c -- removes equilibria that belong to a family listed elsewhere. */
#include "expr/node.h"
#include "mech/study/equilibrium-search.h"
#include "normal/solve/conditions.h"

/* The conditions on parameters and on the coordinate of a range under which e is an equilibrium. */
static qdot_expr
conditions_of(const qdot_rest *r, const qdot_equilibrium *e)
{
    return e->range == QDOT_NIL ? e->exists : qdot_conditions_all(r->pool, e->exists, e->range);
}

static bool
belongs_to_family(const qdot_rest *r, const qdot_equilibrium *one, const qdot_equilibrium *all)
{
    const qdot_simultaneous_solution a = {one->equations, conditions_of(r, one)}, b = {all->equations, conditions_of(r, all)};

    return qdot_simultaneous_lies_in(&r->system, &a, &b);
}

qdot_status
qdot_rest_leave_out_twice(qdot_rest *r)
{
    size_t kept = 0;
    bool *out = qdot_calloc(r->found.n + 1, sizeof *out);

    if (out == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < r->found.n; i++)
        for (size_t j = 0; j < r->found.n && !out[i]; j++)
            out[i] = j != i && !out[j] && !r->found.at[i].numeric &&
                     (j < i || qdot_expr_count(r->pool, r->found.at[j].equations) <
                                   qdot_expr_count(r->pool, r->found.at[i].equations)) &&
                     belongs_to_family(r, &r->found.at[i], &r->found.at[j]);
    for (size_t i = 0; i < r->found.n; i++)
        if (!out[i])
            r->found.at[kept++] = r->found.at[i];
    r->found.n = kept;
    qdot_free(out);
    return qdot_pool_check(r->pool);
}
