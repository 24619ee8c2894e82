/* equilibrium-members.c -- solutions of the equations at rest as places. */
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-bands.h"
#include "mech/study/equilibrium-search.h"
#include "mech/study/linear-motion.h"
#include "normal/solve/solve.h"

enum { MOST_PLACES = 1024 };

/* Whether the equations of motion too are the same after that shift of u: then all members of a family are alike. */
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
choose_sides(qdot_rest *r, qdot_expr *conditions)
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

static qdot_status
append_place(qdot_rest *r, qdot_expr values, qdot_expr conditions)
{
    qdot_pool *pool = r->pool;
    qdot_equilibrium e = {.equations = qdot_list(pool, 0, NULL),
                          .exists = qdot_conditions_generic(pool, conditions)};

    for (uint32_t i = 0; i < qdot_expr_count(pool, values); i++) {
        qdot_expr one = qdot_expr_arg(pool, values, i);

        if (!qdot_expr_is_class(pool, qdot_expr_arg(pool, one, 0), QDOT_FORMAL)) /* the side of a corner */
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

        status = choose_sides(r, &conditions);
        if (status == QDOT_OK && conditions != QDOT_FALSE)
            status = append_place(r, r->system.found.at[i].values, conditions);
    }
    r->system.found.n = 0;
    return status;
}
