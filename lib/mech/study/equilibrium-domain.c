/* equilibrium-domain.c -- where the energy and the forces have values, as they are written.
 *
 * Of x^2 (1 + log c) nothing is left at x = 0, and yet for c <= 0 there is no energy. So the conditions are those of
 * each part as it stands, with the values of a place put in. What only if(...) chooses need not be defined.
 * Parameters are generic: a place has no condition a != 0 of log(a^2) or 1/a. Such values are told with the list. */
#include "expr/build.h"
#include "expr/list.h"
#include "expr/node.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-search.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"

typedef qdot_expr conditions_of(qdot_pool *pool, qdot_expr f, qdot_expr x);

/* The set of conditions extended by those that `of` gives for e; `generic`: only by those on parameters alone. */
static qdot_expr
add_conditions(const qdot_rest *r, qdot_expr set, qdot_expr e, conditions_of *of, bool generic)
{
    qdot_pool *pool = r->pool;
    const qdot_expr all = e == QDOT_NIL ? QDOT_NIL : of(pool, e, QDOT_NIL);

    for (uint32_t i = 0; all != QDOT_NIL && all != QDOT_FALSE && i < qdot_expr_count(pool, all); i++) {
        const qdot_expr one = qdot_expr_arg(pool, all, i);

        if (!generic || qdot_is_generic(pool, one))
            set = qdot_conditions_and(pool, set, one);
    }
    return set;
}

qdot_status
qdot_rest_domain(qdot_rest *r)
{
    qdot_expr set = add_conditions(r, QDOT_NIL, r->energy, qdot_conditions_of_domain, false);

    r->system.domain = add_conditions(r, set, r->forces, qdot_conditions_of_domain, true);
    return qdot_pool_check(r->pool);
}

/* The set of conditions extended by the conditions that no divisor is 0. */
static qdot_expr
add_divisor_conditions(const qdot_rest *r, qdot_expr set)
{
    set = add_conditions(r, set, r->energy, qdot_conditions_of_divisors, false);
    return add_conditions(r, set, r->forces, qdot_conditions_of_divisors, true);
}

/* The set of conditions extended by the declared domains of the coordinates. */
static qdot_expr
add_domain_conditions(const qdot_rest *r, qdot_expr set)
{
    for (size_t i = 0; i < r->s->coordinates.n && set != QDOT_FALSE; i++) {
        const qdot_expr q = r->s->coordinates.at[i];
        const qdot_window w = qdot_solve_window(r->pool, q, false);

        set = qdot_conditions_all(r->pool, set, qdot_window_relations(r->pool, &w, q));
    }
    return set;
}

/* An expression that is 0 where a condition fails for special parameter values only; nil: it fails for generic ones, or
 * never. */
static qdot_expr
special_failure(qdot_pool *pool, qdot_expr condition, const qdot_facts *facts)
{
    qdot_facts generic = *facts, exact = *facts;
    const qdot_expr one = qdot_list(pool, 1, &condition);
    qdot_expr left, u;

    generic.exact = false;
    exact.exact = true;
    if (one == QDOT_NIL || qdot_conditions_at(pool, one, 0, NULL, NULL, &generic) != QDOT_NIL)
        return QDOT_NIL;
    left = qdot_conditions_at(pool, one, 0, NULL, NULL, &exact);
    if (left == QDOT_NIL || left == QDOT_FALSE)
        return QDOT_NIL;
    u = qdot_conditions_nonzero(pool, qdot_expr_count(pool, left) == 1 ? qdot_expr_arg(pool, left, 0) : condition);
    return u != QDOT_NIL ? u : qdot_sub(pool, qdot_expr_arg(pool, condition, 1), qdot_expr_arg(pool, condition, 0));
}

/* Add to the LIST expressions that are 0 where the k-th equilibrium is excluded by the given condition alone. */
static qdot_status
add_failures_at(const qdot_rest *r, size_t k, qdot_expr condition, qdot_expr *list)
{
    qdot_pool *pool = r->pool;
    const qdot_equilibrium *e = &r->found.at[k];
    qdot_expr room[QDOT_CONDITIONS_MOST], u = QDOT_NIL, all = QDOT_NIL;
    const qdot_facts facts = qdot_facts_and(pool, &r->facts, e->exists, room);
    qdot_status status;

    condition = qdot_simultaneous_put(pool, condition, e->equations);
    if (condition != QDOT_NIL)
        condition = qdot_solve_without_turns(pool, condition);
    if (condition != QDOT_NIL && qdot_expr_kind(pool, condition) == QDOT_REL && qdot_is_generic(pool, condition))
        u = special_failure(pool, condition, &facts);
    status = qdot_pool_check(pool);
    if (status == QDOT_OK && u != QDOT_NIL)
        status = qdot_rest_add_factors(pool, u, &all);
    for (uint32_t i = 0; status == QDOT_OK && all != QDOT_NIL && i < qdot_expr_count(pool, all); i++) {
        const qdot_expr one = qdot_expr_arg(pool, all, i);
        bool out = qdot_list_has(pool, *list, one);

        if (!out)
            status = qdot_rest_is_excluded(r, e->exists, one, &out);
        if (!out)
            *list = qdot_list_appended(pool, *list, 1, &one);
    }
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

qdot_status
qdot_rest_undefined(const qdot_rest *r, qdot_expr *everywhere, qdot_expr *special)
{
    qdot_pool *pool = r->pool;
    const qdot_expr set = add_domain_conditions(r, add_divisor_conditions(r, r->system.domain));
    qdot_expr others = *special;

    *everywhere = *special = QDOT_NIL;
    for (uint32_t i = 0; set != QDOT_NIL && set != QDOT_FALSE && i < qdot_expr_count(pool, set); i++)
        for (size_t k = 0; k < r->found.n; k++) {
            const qdot_expr condition = qdot_expr_arg(pool, set, i);

            if (!r->found.at[k].numeric)
                QDOT_TRY(add_failures_at(r, k, condition, qdot_is_generic(pool, condition) ? everywhere : &others));
        }
    for (uint32_t i = 0; others != QDOT_NIL && i < qdot_expr_count(pool, others); i++) {
        const qdot_expr one = qdot_expr_arg(pool, others, i);

        if (!qdot_list_has(pool, *everywhere, one))
            *special = qdot_list_appended(pool, *special, 1, &one);
    }
    return qdot_pool_check(pool);
}
