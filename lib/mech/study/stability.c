/* stability.c -- prepares the facts about a scene by which the stability of all its equilibria is judged. */
#include "mech/study/stability.h"

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/integrated.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/constraint.h"

static bool
velocities_have_kinks(qdot_scene *s)
{
    qdot_walk w;
    bool found = false;

    for (size_t i = 0; i < s->coordinates.n && !found; i++) {
        if (qdot_walk_begin(s->pool, qdot_mech_equation(s, s->coordinates.at[i]), &w) !=
            QDOT_OK)
            return true;
        for (size_t k = 0; k < w.n && !found; k++)
            found = qdot_expr_kind(s->pool, w.at[k]) == QDOT_FUN &&
                    qdot_stability_has_kink(qdot_expr_node(s->pool, w.at[k])->op) &&
                    (qdot_mech_holds(s, w.at[k]) & QDOT_HAS_VELOCITY) != 0;
        qdot_walk_end(&w);
    }
    return found;
}

bool
qdot_stability_is_told(const qdot_judge *judge, size_t i)
{
    qdot_scene *s = judge->s;
    bool told = qdot_expr_contains(s->pool, judge->at_rest, s->coordinates.at[i]);

    for (size_t k = 0; k < s->constraints.n && !told; k++)
        told = s->constraints.at[k].kind == QDOT_VELOCITY &&
               qdot_constraint_slope(s, k, i) != QDOT_ZERO;
    return told;
}

qdot_status
qdot_judge_place(qdot_judge *judge, qdot_equilibrium *e)
{
    e->stability = QDOT_STABILITY_UNDECIDED;
    e->stable_when = QDOT_NIL;
    if (!judge->holonomic || (judge->timed && judge->law == QDOT_ENERGY_UNKNOWN))
        return QDOT_OK;
    if (judge->friction != QDOT_NIL && !e->numeric) {
        bool judged;

        QDOT_TRY(qdot_stability_judge_held(judge, e, &judged));
        if (judged)
            return QDOT_OK;
    }
    if (e->numeric) {
        if (judge->numbers == NULL)
            QDOT_TRY(qdot_stability_numbers_new(judge, &judge->numbers));
        return qdot_stability_judge_numbers(judge, judge->numbers, e);
    }
    return qdot_stability_judge_exact(judge, e);
}

/* --- facts about the scene -------------------------------------------------------------- */

qdot_status
qdot_judge_new(qdot_scene *s, qdot_expr at_rest, qdot_binder bind, void *user,
               qdot_judge **out)
{
    qdot_judge *judge = qdot_calloc(1, sizeof *judge);
    qdot_status status = QDOT_OK;

    *out = NULL;
    if (judge == NULL)
        return QDOT_ENOMEM;
    *judge = (qdot_judge){
        .s = s, .bind = bind, .user = user, .at_rest = at_rest, .holonomic = true};
    for (size_t k = 0; k < s->constraints.n; k++)
        judge->timed = judge->timed ||
                       (qdot_mech_holds(s, s->constraints.at[k].f) & QDOT_HAS_TIME) != 0;
    status = qdot_mech_is_holonomic(s, &judge->holonomic);
    for (size_t i = 0; i < s->coordinates.n && judge->holonomic && status == QDOT_OK; i++)
        judge->timed = judge->timed ||
                       (qdot_mech_holds(s, qdot_mech_equation(s, s->coordinates.at[i])) &
                        QDOT_HAS_TIME) != 0;
    if (judge->holonomic && status == QDOT_OK) {
        judge->velocity_kink = velocities_have_kinks(s);
        status = qdot_energy_law_of(s, &judge->law);
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(s->pool);
    if (status != QDOT_OK) {
        qdot_free(judge);
        return status;
    }
    *out = judge;
    return QDOT_OK;
}

void
qdot_judge_free(qdot_judge *judge)
{
    if (judge == NULL)
        return;
    qdot_stability_numbers_free(judge->numbers);
    qdot_free(judge);
}
