/* equilibrium-twice.c -- removes equilibria that belong to a family listed elsewhere. */
#include "expr/calculus.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-search.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"

/* Whether d is a whole number of turns. */
static bool
is_turns(const qdot_rest *r, qdot_expr d)
{
    const fmpq *c;

    d = qdot_simplify(r->pool, d, &r->facts);
    if (d == QDOT_NIL || qdot_expr_kind(r->pool, d) != QDOT_PROD ||
        qdot_expr_count(r->pool, d) != 3 || qdot_expr_arg(r->pool, d, 1) != QDOT_PI ||
        qdot_expr_arg(r->pool, d, 2) != QDOT_ONE)
        return false;
    c = qdot_expr_rational(r->pool, qdot_expr_arg(r->pool, d, 0));
    return fmpz_is_one(fmpq_denref(c)) && fmpz_is_even(fmpq_numref(c));
}

/* Whether the coordinate has a declared end: its members are then listed one by one. */
static bool
has_domain(const qdot_rest *r, qdot_expr u)
{
    const qdot_symbol *x = qdot_expr_symbol(r->pool, u);

    return x->lo != QDOT_NIL || x->hi != QDOT_NIL;
}

/* Whether the conditions are proved to hold at the place `one`, where that exists. */
static bool
hold_at(const qdot_rest *r, qdot_expr conditions, const qdot_equilibrium *one)
{
    qdot_expr room[QDOT_CONDITIONS_MOST], there = qdot_rest_put(r, conditions, one->equations);
    qdot_facts facts = qdot_facts_and(r->pool, &r->facts, one->exists, room);

    if (there == QDOT_NIL && qdot_pool_check(r->pool) == QDOT_EDOMAIN)
        return false;
    return qdot_conditions_at(r->pool, there, 0, NULL, NULL, &facts) == QDOT_NIL &&
           !qdot_pool_failed(r->pool);
}

/* Whether the place `one` lies in the family `all` (or is it, full turns away), where that exists. */
static bool
lies_in(const qdot_rest *r, const qdot_equilibrium *one, const qdot_equilibrium *all,
        qdot_expr equations)
{
    qdot_pool *pool = r->pool;
    uint32_t m = qdot_expr_count(pool, all->equations);
    bool inside = m <= qdot_expr_count(pool, one->equations);

    for (uint32_t k = 0; k < m && inside; k++) {
        qdot_expr u = qdot_expr_arg(pool, qdot_expr_arg(pool, all->equations, k), 0),
                  v = qdot_expr_arg(pool, qdot_expr_arg(pool, all->equations, k), 1),
                  there = qdot_rest_put(r, u, one->equations), d;

        d = qdot_sub(pool, there, qdot_rest_put(r, v, one->equations));
        if (d == QDOT_NIL) { /* the family has no member there */
            if (qdot_pool_check(pool) != QDOT_EDOMAIN)
                (void)qdot_pool_fail(pool);
            return false;
        }
        inside = d != QDOT_NIL && there != u &&
                 (d == QDOT_ZERO ||
                  (qdot_mech_holds(r->s, d) != 0 && qdot_is_zero(pool, d, &r->facts)) ||
                  (!has_domain(r, u) && is_turns(r, d) && qdot_rest_is_angle(r, u, equations)));
    }
    if (inside && all->exists != QDOT_NIL && all->exists != one->exists)
        inside = hold_at(r, all->exists, one);
    return inside;
}

qdot_status
qdot_rest_leave_out_twice(qdot_rest *r, qdot_expr equations)
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
                     lies_in(r, &r->found.at[i], &r->found.at[j], equations);
    for (size_t i = 0; i < r->found.n; i++)
        if (!out[i])
            r->found.at[kept++] = r->found.at[i];
    r->found.n = kept;
    qdot_free(out);
    return qdot_pool_check(r->pool);
}
