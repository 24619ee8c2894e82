/* phase-space.c -- a scene that states H alone, as the Lagrangian scene of its phase space. */
#include "mech/hamilton/phase-space.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"

/* Find L and the applied forces of the phase space. */
static qdot_status
find_phase_space(qdot_scene *s, qdot_phase_space *x, uint32_t n, const qdot_expr *q)
{
    qdot_pool *pool = s->pool;

    x->of = 0;
    x->torques.n = 0;
    x->L = qdot_neg(pool, qdot_phase_space_inward(s, s->hamiltonian));
    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr P = qdot_phase_space_coordinate(s, q[i]);
        const qdot_expr Q = qdot_phase_space_inward(s, qdot_hamilton_in_momenta(s, qdot_mech_force(s, q[i])));

        QDOT_TRY(qdot_pool_check(pool));
        x->L = qdot_add(pool, x->L, qdot_mul(pool, P, qdot_symbol_jet(pool, q[i], 1)));
        if (Q != QDOT_ZERO)
            QDOT_TRY(qdot_vec_push(&x->torques, ((qdot_torque){.torque = Q, .coordinate = q[i], .force = true})));
    }
    QDOT_TRY(qdot_pool_check(pool));
    x->of = s->version;
    for (int i = 0; i < 2; i++) {
        qdot_scene_changed(s);
        x->version[i] = s->version;
    }
    return QDOT_OK;
}

/* q' = dH/dp and p' = -dH/dq + Q as the states of the scene. */
static qdot_status
add_states(qdot_scene *s, const qdot_phase_space *x, uint32_t n, const qdot_expr *q)
{
    qdot_pool *pool = s->pool;

    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr P = qdot_phase_space_coordinate(s, q[i]), p = qdot_symbol_of(pool, QDOT_MOMENTUM, q[i]);
        qdot_expr rate = qdot_neg(pool, qdot_diff(pool, s->hamiltonian, q[i]));

        for (size_t k = 0; k < x->torques.n; k++)
            if (x->torques.at[k].coordinate == q[i])
                rate = qdot_add(pool, rate, x->torques.at[k].torque);
        QDOT_TRY(qdot_vec_push(&s->states, ((qdot_state){q[i], qdot_phase_space_inward(s, qdot_diff(pool, s->hamiltonian, p))})));
        QDOT_TRY(qdot_vec_push(&s->states, ((qdot_state){P, qdot_phase_space_inward(s, rate)})));
    }
    s->hamiltonian = QDOT_NIL;
    return qdot_pool_check(pool);
}

/* The scene as it is, and of its arrays those that change. */
static qdot_status
turn_scene(qdot_scene *s, bool states, qdot_phase_space *x, uint32_t n, const qdot_expr *q)
{
    x->before = *s;
    for (uint32_t i = 0; i < n; i++)
        QDOT_TRY(qdot_vec_push(&s->coordinates, qdot_phase_space_coordinate(s, q[i])));
    s->dampers.n = s->dissipations.n = s->forces.n = 0;
    s->version = x->version[states];
    if (states) {
        s->torques.n = 0;
        return add_states(s, x, n, q);
    }
    s->torques.at = x->torques.at;
    s->torques.n = x->torques.n;
    s->torques.capacity = x->torques.capacity;
    s->lagrangian = x->L;
    return qdot_pool_check(s->pool);
}

qdot_status
qdot_phase_space_enter(qdot_scene *s, bool states, qdot_phase_space *x)
{
    const uint64_t version = s->version;
    uint32_t n;
    qdot_expr *q;
    qdot_status status = QDOT_OK;

    if (!qdot_phase_space_needed(s))
        return QDOT_OK;
    if (s->constraints.n > 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: motion with constraints by an H from which no Lagrangian follows");
    if (states)
        QDOT_TRY(qdot_scene_need_no_states(s, "the linear motion by H alone"));
    q = qdot_hamilton_moving(s, &n);
    if (q == NULL)
        return QDOT_ENOMEM;
    if (x->of != version)
        status = find_phase_space(s, x, n, q);
    s->version = version;
    if (status == QDOT_OK) {
        x->entered = true;
        status = turn_scene(s, states, x, n, q);
    }
    qdot_free(q);
    return status;
}

void
qdot_phase_space_leave(qdot_scene *s, qdot_phase_space *x)
{
    if (!x->entered)
        return;
    s->coordinates.n = x->before.coordinates.n;
    s->states.n = x->before.states.n;
    s->torques = x->before.torques;
    s->dampers.n = x->before.dampers.n;
    s->dissipations.n = x->before.dissipations.n;
    s->forces.n = x->before.forces.n;
    s->lagrangian = x->before.lagrangian;
    s->hamiltonian = x->before.hamiltonian;
    s->version = x->before.version;
    x->entered = false;
}

void
qdot_phase_space_clear(qdot_phase_space *x)
{
    qdot_free(x->torques.at);
    *x = (qdot_phase_space){0};
}
