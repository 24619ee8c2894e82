/* phase-space.c -- a scene that states H alone, as the Lagrangian scene of its phase space. */
#include "mech/hamilton/phase-space.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"
#include "mech/hamilton/phase-constraints.h"
#include "mech/scene/constraint.h"

/* Solve for the multipliers of the constraints. */
static qdot_status
eliminate_constraints(qdot_scene *s, qdot_phase_space *x)
{
    const size_t m = s->constraints.n;
    qdot_expr *lambda = qdot_calloc(m + 1, sizeof *lambda);
    qdot_status status = lambda == NULL ? QDOT_ENOMEM : m == 0 ? QDOT_OK : qdot_phase_constraints_multipliers(s, lambda);

    x->eliminated.n = 0;
    for (size_t k = 0; k < m && status == QDOT_OK; k++) {
        const qdot_constraint *c = &s->constraints.at[k];

        status = qdot_vec_push(&x->eliminated, ((qdot_eliminated){
            .position = c->kind == QDOT_HOLONOMIC ? c->f : QDOT_NIL,
            .rate = qdot_phase_space_inward(s, qdot_phase_constraints_rate(s, k)),
            .multiplier = qdot_phase_space_inward(s, lambda[k])}));
    }
    qdot_free(lambda);
    return status == QDOT_OK ? qdot_pool_check(s->pool) : status;
}

/* What acts along the coordinate q: applied forces and reactions, in q and p. */
static qdot_expr
find_force(qdot_scene *s, const qdot_phase_space *x, qdot_expr q)
{
    const size_t i = qdot_expr_place(s->coordinates.n, s->coordinates.at, q);
    qdot_expr Q = qdot_add(s->pool, qdot_mech_force(s, q), qdot_constraint_reaction(s, i));

    for (size_t k = 0; k < x->eliminated.n && Q != QDOT_NIL; k++)
        Q = qdot_subs(s->pool, Q, 1, &s->constraints.at[k].multiplier, &x->eliminated.at[k].multiplier);
    return qdot_phase_space_inward(s, qdot_hamilton_in_momenta(s, Q));
}

/* Find L and the forces of the phase space. */
static qdot_status
find_phase_space(qdot_scene *s, qdot_phase_space *x, uint32_t n, const qdot_expr *q)
{
    qdot_pool *pool = s->pool;

    x->of = 0;
    x->torques.n = 0;
    QDOT_TRY(eliminate_constraints(s, x));
    x->L = qdot_neg(pool, qdot_phase_space_inward(s, s->hamiltonian));
    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr P = qdot_phase_space_coordinate(s, q[i]), Q = find_force(s, x, q[i]);

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

/* Keep the scene as it was in x->before, and put in what is different in its phase space. */
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
    s->eliminated.at = x->eliminated.at;
    s->eliminated.n = x->eliminated.n;
    s->constraints.n = 0;
    s->lagrangian = x->L;
    return qdot_pool_check(s->pool);
}

/* Refuse beside constraints linear motion, which needs them in its equations, and events that change the state, which would leave
 * them. */
static qdot_status
refuse_with_constraints(const qdot_scene *s, bool states)
{
    if (s->constraints.n == 0)
        return QDOT_OK;
    if (states)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: rest and linear motion with constraints by an H from which no Lagrangian follows");
    for (size_t i = 0; i < s->events.n; i++)
        for (size_t k = 0; k < s->events.at[i].targets.n; k++)
            if (!qdot_expr_is_class(s->pool, s->events.at[i].targets.at[k], QDOT_PARAM))
                return qdot_fail(QDOT_ENOTBUILT, "not built yet: event %s, which changes the state, beside constraints and an H from which "
                                                 "no Lagrangian follows", s->events.at[i].name);
    return QDOT_OK;
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
    QDOT_TRY(refuse_with_constraints(s, states));
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
    s->constraints.n = x->before.constraints.n;
    s->eliminated = x->before.eliminated;
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
    qdot_free(x->eliminated.at);
    *x = (qdot_phase_space){0};
}
