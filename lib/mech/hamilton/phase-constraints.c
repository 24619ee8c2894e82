/* phase-constraints.c -- the multipliers of constraints beside an H from which no Lagrangian follows. */
#include "mech/hamilton/phase-constraints.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"
#include "mech/hamilton/phase-symbols.h"
#include "mech/scene/access.h"
#include "mech/scene/constraint.h"
#include "normal/solve/linear.h"

qdot_expr
qdot_phase_constraints_rate(qdot_scene *s, size_t k)
{
    const qdot_constraint *c = &s->constraints.at[k];

    return qdot_hamilton_in_momenta(s, c->kind == QDOT_HOLONOMIC ? qdot_ddt(s->pool, c->f) : c->f);
}

/* The derivative of g(q, p, t) along the motion, which holds the multipliers. */
static qdot_expr
rate_along_motion(qdot_scene *s, qdot_expr g)
{
    qdot_pool *pool = s->pool;

    g = qdot_phase_space_outward(s, qdot_ddt(pool, qdot_phase_space_inward(s, g)));
    for (size_t i = 0; i < s->coordinates.n && g != QDOT_NIL; i++) {
        const qdot_expr q = s->coordinates.at[i], rate = qdot_symbol_jet(pool, qdot_symbol_of(pool, QDOT_MOMENTUM, q), 1);
        qdot_expr sum;

        if (!qdot_expr_contains(pool, g, rate))
            continue;
        sum = qdot_sub(pool, qdot_add(pool, qdot_mech_force(s, q), qdot_constraint_reaction(s, i)),
                       qdot_diff(pool, s->hamiltonian, q));
        g = qdot_subs(pool, g, 1, &rate, &sum);
    }
    return qdot_hamilton_in_momenta(s, g);
}

/* The system a lambda = -b, by rows. */
static qdot_status
write_system(qdot_scene *s, qdot_expr *a, qdot_expr *b)
{
    const size_t m = s->constraints.n;
    qdot_pool *pool = s->pool;

    for (size_t k = 0; k < m; k++) {
        qdot_expr rest;

        if (s->constraints.at[k].kind == QDOT_ACCELERATION)
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: motion with constraints of accelerations by an H from which no Lagrangian follows");
        rest = rate_along_motion(s, qdot_phase_constraints_rate(s, k));
        for (size_t l = 0; l < m; l++) {
            const qdot_expr lambda = s->constraints.at[l].multiplier, zero = QDOT_ZERO;

            a[k * m + l] = qdot_diff(pool, rest, lambda);
            rest = qdot_subs(pool, rest, 1, &lambda, &zero);
        }
        b[k] = qdot_neg(pool, rest);
    }
    return qdot_pool_check(pool);
}

/* Refuse rates that jump: a state that slides along the jump moves by other multipliers. */
static qdot_status
refuse_unsuitable_rates(qdot_scene *s)
{
    const uint32_t state = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_MOMENTUM | QDOT_HAS_TIME;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr q = s->coordinates.at[i], Q = qdot_mech_force(s, q);
        const qdot_expr rates[] = {Q, qdot_diff(s->pool, s->hamiltonian, q),
                                   qdot_diff(s->pool, s->hamiltonian, qdot_symbol_of(s->pool, QDOT_MOMENTUM, q))};

        QDOT_TRY(qdot_pool_check(s->pool));
        for (size_t k = 0; k < sizeof rates / sizeof *rates; k++) {
            bool jumps;

            QDOT_TRY(qdot_jumps(s->pool, rates[k], state, &jumps));
            if (jumps)
                return qdot_fail(QDOT_ENOTBUILT, "not built yet: constraints beside an H from which no Lagrangian follows, where rates jump");
        }
    }
    return QDOT_OK;
}

qdot_status
qdot_phase_constraints_multipliers(qdot_scene *s, qdot_expr *lambda)
{
    const uint32_t m = (uint32_t)s->constraints.n;
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr *a = qdot_calloc((size_t)m * m + m + 1, sizeof *a);
    uint32_t pivot;
    qdot_status status = a == NULL ? QDOT_ENOMEM : refuse_unsuitable_rates(s);

    if (status == QDOT_OK)
        status = write_system(s, a, a + (size_t)m * m);
    if (status == QDOT_OK)
        status = qdot_solve_linear(s->pool, m, a, a + (size_t)m * m, lambda, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        status = qdot_fail(QDOT_ESINGULAR, "lambda[%.200s] is not determined: constraints repeat each other, or q' along one does not "
                                           "depend on the momenta", s->constraints.at[pivot].name);
    qdot_free(a);
    return status;
}

qdot_expr
qdot_phase_constraints_put(qdot_scene *s, qdot_expr e)
{
    qdot_expr *lambda;

    if (e == QDOT_NIL || !qdot_phase_space_needed(s))
        return e;
    e = qdot_phase_space_outward(s, e);
    if (!(qdot_mech_holds(s, e) & QDOT_HAS_MULTIPLIER))
        return e;
    lambda = qdot_calloc(s->constraints.n + 1, sizeof *lambda);
    if (lambda == NULL || qdot_phase_constraints_multipliers(s, lambda) != QDOT_OK)
        qdot_pool_fail(s->pool);
    for (size_t k = 0; k < s->constraints.n && !qdot_pool_failed(s->pool); k++)
        e = qdot_subs(s->pool, e, 1, &s->constraints.at[k].multiplier, &lambda[k]);
    qdot_free(lambda);
    return qdot_pool_failed(s->pool) ? QDOT_NIL : e;
}
