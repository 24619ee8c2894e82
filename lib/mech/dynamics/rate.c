/* rate.c -- dE/dt along the motion. */
#include "mech/dynamics/rate.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/statics.h"
#include "mech/scene/access.h"
#include "mech/scene/constraint.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

/* Add the replacement of a symbol to from, to [*n] if e contains the symbol. */
static void
add_if_contained(qdot_scene *s, qdot_expr e, qdot_expr symbol, qdot_expr (*solution)(qdot_scene *, size_t), size_t i,
                 qdot_expr *from, qdot_expr *to, size_t *n)
{
    if (!qdot_expr_contains(s->pool, e, symbol))
        return;
    from[*n] = symbol;
    to[(*n)++] = solution(s, i);
}

static qdot_expr
solved_acceleration(qdot_scene *s, size_t i)
{
    return qdot_mech_accel(s, s->coordinates.at[i]);
}

static qdot_expr
solved_multiplier(qdot_scene *s, size_t k)
{
    qdot_expr value = qdot_statics_applies(s) ? qdot_statics_multiplier(s, k) : qdot_mech_multiplier(s, k);

    if (value == QDOT_NIL && !qdot_pool_failed(s->pool))
        return qdot_mech_fail(s, QDOT_EINVAL, "lambda[%.200s] is not determined: constraints repeat each other",
                              s->constraints.at[k].name);
    return value;
}

qdot_expr
qdot_rate_on_motion(qdot_scene *s, qdot_expr e)
{
    const size_t most = s->coordinates.n + s->constraints.n;
    qdot_expr *from;
    size_t n = 0;

    e = qdot_scene_with_rates(s, e);
    if (e == QDOT_NIL || !(qdot_mech_holds(s, e) & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)))
        return e;
    from = qdot_calloc(2 * most + 1, sizeof *from);
    if (from == NULL)
        return qdot_pool_fail(s->pool);
    for (size_t i = 0; i < s->coordinates.n; i++)
        add_if_contained(s, e, qdot_mech_jet(s, i, 2), solved_acceleration, i, from, from + most, &n);
    for (size_t k = 0; k < s->constraints.n; k++)
        add_if_contained(s, e, s->constraints.at[k].multiplier, solved_multiplier, k, from, from + most, &n);
    e = qdot_pool_failed(s->pool) ? QDOT_NIL : qdot_subs(s->pool, e, n, from, from + most);
    qdot_free(from);
    return qdot_scene_with_rates(s, e);
}

qdot_expr
qdot_rate_in_momenta(qdot_scene *s, qdot_expr e)
{
    for (size_t i = 0; i < s->coordinates.n && e != QDOT_NIL; i++) {
        const qdot_expr v = qdot_mech_jet(s, i, 1),
                        rate = qdot_diff(s->pool, s->hamiltonian, qdot_symbol_of(s->pool, QDOT_MOMENTUM, s->coordinates.at[i]));

        if (!qdot_scene_state_of(s, s->coordinates.at[i]))
            e = qdot_subs(s->pool, e, 1, &v, &rate);
    }
    return e;
}

/* Whether e is proved to be 0, where the constraints hold. */
static bool
vanishes_on_constraints(qdot_scene *s, qdot_expr e)
{
    qdot_expr *relations = NULL;
    qdot_facts facts;
    bool zero = false;

    if (e == QDOT_NIL || e == QDOT_ZERO)
        return e == QDOT_ZERO;
    if (qdot_constraint_facts(s, &relations, &facts) == QDOT_OK) {
        for (size_t i = 0; s->hamiltonian != QDOT_NIL && s->lagrangian == QDOT_NIL && i < facts.n_relations; i++)
            relations[i] = qdot_rate_in_momenta(s, relations[i]);
        zero = qdot_is_zero(s->pool, e, &facts);
    }
    qdot_free(relations);
    return zero;
}

qdot_expr
qdot_rate_of(qdot_scene *s, qdot_expr E)
{
    qdot_pool *pool = s->pool;
    qdot_expr rate = QDOT_NIL;
    qdot_facts facts;

    E = qdot_rate_on_motion(s, E);
    if (E == QDOT_NIL)
        return E;
    if ((qdot_mech_holds(s, E) & (QDOT_HAS_VELOCITY | QDOT_HAS_MOMENTUM)) || s->hamiltonian != QDOT_NIL)
        rate = qdot_mech_rate(s, E);
    if (qdot_pool_failed(pool))
        return QDOT_NIL;
    if (vanishes_on_constraints(s, rate))
        return QDOT_ZERO;
    rate = qdot_rate_on_motion(s, rate == QDOT_NIL ? qdot_ddt(pool, E) : rate);
    if (vanishes_on_constraints(s, rate))
        return QDOT_ZERO;
    facts = qdot_scene_facts(s);
    return rate == QDOT_NIL ? rate : qdot_simplify(pool, rate, &facts);
}
