/* state.c -- first-order unknowns: z' = rate. */
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"

/* The place of the state whose symbol is z; s->states.n: there is none. */
static size_t
place_of_state(const qdot_scene *s, qdot_expr z)
{
    size_t k = 0;

    while (k < s->states.n && s->states.at[k].z != z)
        k++;
    return k;
}

const qdot_state *
qdot_scene_state_of(const qdot_scene *s, qdot_expr z)
{
    const size_t k = place_of_state(s, z);

    return k < s->states.n ? &s->states.at[k] : NULL;
}

qdot_status
qdot_scene_refuse_states(const qdot_scene *s, qdot_expr e, const char *what, uint32_t from)
{
    for (size_t k = 0; k < s->states.n; k++)
        for (uint32_t order = from; order < 3; order++)
            if (qdot_expr_contains(s->pool, e, qdot_symbol_jet(s->pool, s->states.at[k].z, order))) {
                const char *name = qdot_expr_symbol(s->pool, s->states.at[k].z)->name;

                if (from > 0)
                    return qdot_fail(QDOT_ENOTBUILT, "not built yet: %s that holds the rate of a state, %s'", what, name);
                qdot_fail(QDOT_ENOTBUILT, "not built yet: %s that holds a state, %s", what, name);
                return qdot_hint("forces, potentials, springs, dampers, masses and events may hold one");
            }
    return QDOT_OK;
}

static qdot_status
check_rate(qdot_scene *s, qdot_expr rate)
{
    const uint32_t holds = qdot_mech_holds(s, rate);

    QDOT_TRY(qdot_pool_check(s->pool));
    if (!qdot_expr_is_scalar(s->pool, rate))
        return qdot_fail(QDOT_ETYPE, "the rate of a state must be a number, not a vector");
    if (holds & QDOT_HAS_ACCELERATION) {
        qdot_fail(QDOT_ENOTBUILT, "not built yet: a state whose rate holds accelerations");
        return qdot_hint("the forces that make the acceleration may stand there in its place");
    }
    if (holds & QDOT_HAS_MULTIPLIER)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: a state whose rate holds multipliers");
    if (holds & (QDOT_HAS_MOMENTUM | QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA))
        return qdot_fail(QDOT_EINVAL, "the rate of a state holds coordinates, velocities, states, parameters and t");
    return QDOT_OK;
}

/* The expression e with the rate of a state in place of z', if it is known. */
static qdot_expr
with_rate(const qdot_scene *s, qdot_expr e, const qdot_state *state)
{
    const qdot_expr velocity = qdot_symbol_jet(s->pool, state->z, 1);

    return state->rate == QDOT_NIL ? e : qdot_subs(s->pool, e, 1, &velocity, &state->rate);
}

qdot_expr
qdot_scene_with_rates(const qdot_scene *s, qdot_expr e)
{
    for (size_t k = 0; k < s->states.n && e != QDOT_NIL; k++)
        e = with_rate(s, e, &s->states.at[k]);
    return e;
}

qdot_status
qdot_scene_state(qdot_scene *s, qdot_expr z, qdot_expr rate)
{
    const size_t k = place_of_state(s, z);
    const char *name;

    QDOT_TRY(qdot_pool_check(s->pool));
    if (rate == QDOT_NIL) {
        QDOT_TRY(qdot_scene_coordinate(s, z));
        if (qdot_vec_push(&s->states, ((qdot_state){z, QDOT_NIL})) == QDOT_OK)
            return QDOT_OK;
        s->coordinates.n--;
        return QDOT_ENOMEM;
    }
    name = qdot_expr_symbol(s->pool, z)->name;
    if (k == s->states.n)
        return qdot_fail(QDOT_ENAME, "%s is no state", name);
    if (s->states.at[k].rate != QDOT_NIL)
        return qdot_fail(QDOT_ENAME, "the state %s has its rate already", name);
    QDOT_TRY(check_rate(s, rate));
    rate = qdot_scene_with_rates(s, rate);
    if (qdot_expr_contains(s->pool, rate, qdot_symbol_jet(s->pool, z, 1)))
        return qdot_fail(QDOT_EINVAL, "the rate of %s depends on itself", name);
    QDOT_TRY(qdot_pool_check(s->pool));
    s->states.at[k].rate = rate;
    for (size_t i = 0; i < s->states.n; i++)
        if (s->states.at[i].rate != QDOT_NIL)
            s->states.at[i].rate = with_rate(s, s->states.at[i].rate, &s->states.at[k]);
    qdot_scene_changed(s);
    return qdot_pool_check(s->pool);
}

qdot_status
qdot_scene_check_states(const qdot_scene *s)
{
    for (size_t k = 0; k < s->states.n; k++)
        if (s->states.at[k].rate == QDOT_NIL) {
            const char *name = qdot_expr_symbol(s->pool, s->states.at[k].z)->name;

            qdot_fail(QDOT_EINVAL, "the state %s has no rate", name);
            return qdot_hint("state %s' = ...", name);
        }
    return QDOT_OK;
}

qdot_status
qdot_scene_need_no_states(const qdot_scene *s, const char *what)
{
    if (s->states.n == 0)
        return QDOT_OK;
    return qdot_fail(QDOT_ENOTBUILT, "not built yet: %s of a scene with states", what);
}
