/* equilibrium-members.c -- turns solutions of the equations of rest into equilibria. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-bands.h"
#include "mech/study/equilibrium-search.h"
#include "mech/linear/linear-motion.h"
#include "normal/simplify/positive.h"
#include "normal/solve/condition-forms.h"
#include "normal/solve/solve.h"

/* largest number of equilibria; largest number of operations in conditions that contain roots */
enum { MOST_PLACES = 1024, LARGEST_ROOTS = 60 };

/* Whether a shift of u leaves the equations of motion unchanged, so that all members of a family
 * are equivalent. */
bool
qdot_rest_moves_alike(void *scene, qdot_expr u, qdot_expr period)
{
    qdot_scene *s = scene;
    qdot_facts facts = qdot_scene_facts(s);

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr gap = qdot_motion_residual(s, i);

        if (gap == QDOT_NIL || !qdot_is_period(s->pool, gap, u, period, &facts))
            return false;
    }
    for (size_t k = 0; k < s->constraints.n; k++)
        if (!qdot_is_period(s->pool, s->constraints.at[k].f, u, period, &facts))
            return false;
    return true;
}

/* Sides of jumps that nothing determines may have any value that the conditions leave: where there is one, the
 * conditions on them are met. *conditions: FALSE where there is none. */
static qdot_status
choose_undetermined_signs(qdot_rest *r, qdot_expr *conditions)
{
    qdot_pool *pool = r->pool;

    for (size_t i = r->searched; i < r->system.unknowns.n && *conditions != QDOT_FALSE; i++) {
        qdot_expr side = r->system.unknowns.at[i], on[QDOT_CONDITIONS_MOST], others = QDOT_NIL;
        uint32_t n = *conditions == QDOT_NIL ? 0 : qdot_expr_count(pool, *conditions);
        qdot_bands bands;
        size_t count = 0;
        bool found;
        qdot_status status;

        for (uint32_t k = 0; k < n; k++) {
            qdot_expr one = qdot_expr_arg(pool, *conditions, k);

            if (qdot_expr_contains(pool, one, side) && count < QDOT_CONDITIONS_MOST)
                on[count++] = one;
            else
                others = qdot_conditions_and(pool, others, one);
        }
        if (count == 0)
            continue;
        status = qdot_bands_find(pool, side, count, on, &r->facts, &bands, &found);
        if (status == QDOT_OK && !found)
            r->system.complete = false;
        *conditions = !found || (bands.at.n == 0 && !bands.whole)
                          ? QDOT_FALSE
                          : qdot_conditions_all(pool, others, bands.also);
        qdot_bands_clear(&bands);
        QDOT_TRY(status);
    }
    return qdot_pool_check(pool);
}

/* The value of a coordinate to which the relation a = b of two conditions a <= b and b <= a narrows a region, as an equation;
 * nil: no condition has an opposite one, or a - b is not linear in a coordinate. */
static qdot_expr
narrowing_equation(const qdot_rest *r, qdot_expr conditions)
{
    qdot_pool *pool = r->pool;
    const uint32_t n = conditions == QDOT_NIL || conditions == QDOT_FALSE ? 0 : qdot_expr_count(pool, conditions);

    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = i + 1; k < n; k++) {
            qdot_expr one = qdot_expr_arg(pool, conditions, i), other = qdot_expr_arg(pool, conditions, k), gap;

            if (qdot_expr_kind(pool, one) != QDOT_REL || qdot_expr_node(pool, one)->op != QDOT_LE ||
                qdot_expr_kind(pool, other) != QDOT_REL || qdot_expr_node(pool, other)->op != QDOT_LE)
                continue;
            gap = qdot_positive_of(pool, one);
            if (qdot_expand(pool, qdot_add(pool, gap, qdot_positive_of(pool, other))) != QDOT_ZERO)
                continue;
            for (size_t c = 0; c < r->s->coordinates.n; c++) {
                qdot_expr u = r->s->coordinates.at[c], slope = qdot_diff(pool, gap, u), zero = QDOT_ZERO;

                if (slope == QDOT_NIL || slope == QDOT_ZERO || qdot_expr_rational(pool, slope) == NULL)
                    continue;
                gap = qdot_subs(pool, gap, 1, &u, &zero);
                return qdot_rel(pool, QDOT_EQ, u, qdot_neg(pool, qdot_div(pool, gap, slope)));
            }
        }
    return QDOT_NIL;
}

/* If the conditions of a solution allow only one value of a coordinate, insert that value. */
static qdot_status
insert_only_value(qdot_rest *r, qdot_expr *values, qdot_expr *conditions)
{
    qdot_pool *pool = r->pool;
    qdot_expr one;

    while ((one = narrowing_equation(r, *conditions)) != QDOT_NIL) {
        qdot_expr u = qdot_expr_arg(pool, one, 0), value = qdot_expr_arg(pool, one, 1);

        *conditions = qdot_conditions_at(pool, *conditions, 1, &u, &value, &r->facts);
        *values = qdot_subs(pool, *values, 1, &u, &value);
        *values = *values == QDOT_NIL ? QDOT_NIL : qdot_list_appended(pool, *values, 1, &one);
        if (*values == QDOT_NIL && qdot_pool_check(pool) == QDOT_EDOMAIN)
            *conditions = QDOT_FALSE;
        if (*conditions == QDOT_FALSE)
            return QDOT_OK;
        QDOT_TRY(qdot_pool_check(pool));
    }
    return qdot_pool_check(pool);
}

/* The set of conditions without those with roots that follow from the others; these tell where the roots are defined. */
static qdot_expr
without_implied_roots(const qdot_rest *r, qdot_expr set)
{
    qdot_pool *pool = r->pool;

    if (set == QDOT_NIL || qdot_expr_count(pool, set) < 2 || qdot_expr_size(pool, set) > LARGEST_ROOTS)
        return set;
    for (uint32_t i = qdot_expr_count(pool, set); i-- > 0 && qdot_expr_count(pool, set) > 1;) {
        const qdot_expr one = qdot_expr_arg(pool, set, i),
                        others = qdot_conditions_less(pool, set, qdot_list(pool, 1, &one));
        qdot_expr room[QDOT_CONDITIONS_MOST];
        qdot_facts facts;

        if (qdot_expr_kind(pool, one) != QDOT_REL || !qdot_holds_root(pool, one))
            continue;
        facts = qdot_facts_and(pool, &r->facts, others, room);
        if (qdot_condition(pool, qdot_positive_of(pool, one), qdot_expr_node(pool, one)->op == QDOT_LT, &facts) == QDOT_TRUE)
            set = others;
    }
    return set;
}

static qdot_status
append_equilibrium(qdot_rest *r, qdot_expr values, qdot_expr conditions)
{
    qdot_pool *pool = r->pool;
    qdot_equilibrium e = {.equations = qdot_list(pool, 0, NULL)};

    QDOT_TRY(insert_only_value(r, &values, &conditions));
    if (conditions == QDOT_FALSE)
        return QDOT_OK;
    if (!r->facts.exact)
        conditions = qdot_conditions_generic(pool, conditions);
    e.exists = without_implied_roots(r, conditions);
    for (uint32_t i = 0; i < qdot_expr_count(pool, values); i++) {
        qdot_expr one = qdot_expr_arg(pool, values, i);

        /* leave out the symbols that stand for the sign of u at a corner u = 0 */
        if (!qdot_expr_is_class(pool, qdot_expr_arg(pool, one, 0), QDOT_FORMAL))
            e.equations = qdot_list_appended(pool, e.equations, 1, &one);
    }
    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < r->found.n; i++)
        if (r->found.at[i].equations == e.equations &&
            qdot_conditions_join(pool, &r->found.at[i].exists, e.exists, &r->facts))
            return qdot_pool_check(pool);
    if (r->found.n >= MOST_PLACES)
        return qdot_fail(QDOT_ELIMIT, "the scene has more than %d equilibria", MOST_PLACES);
    return qdot_vec_push(&r->found, e);
}

qdot_status
qdot_rest_solve(qdot_rest *r)
{
    qdot_status status = qdot_simultaneous_solve(&r->system);

    for (size_t i = 0; i < r->system.found.n && status == QDOT_OK; i++) {
        qdot_expr conditions = r->system.found.at[i].conditions;

        status = choose_undetermined_signs(r, &conditions);
        if (status == QDOT_OK && conditions != QDOT_FALSE)
            status = append_equilibrium(r, r->system.found.at[i].values, conditions);
    }
    r->system.found.n = 0;
    return status;
}
