/* conservation.c -- how energy and momenta change.
 *
 * By Lagrange's equations
 *
 *     dh/dt = -dL/dt - sum dL/dz z' + sum (Q_i + R_i) q_i'
 *
 * over the states z, functions of time for L,
 * with Q what is applied beside V and R the reactions, so h is conserved when dL/dt and
 * the power of Q vanish and every constraint works at no power: f (q, t) = 0 at -lambda
 * df/dt, f(q, q', t) = 0 at lambda sum df/dq' q', f(q'') at lambda sum df/dq'' q'. Where L jumps
 * at a time, as that of a stiffness switched then, dL/dt is infinite though it is 0 before and after.
 */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/combination.h"
#include "mech/dynamics/energy.h"
#include "mech/dynamics/ostrogradsky.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/rate.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "mech/scene/constraint.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

/* The rate of the energy but for constraints, -dL/dt + sum Q q', with Q the applied forces that are not in V. */
static qdot_expr
applied_power(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr power = QDOT_ZERO;
    bool has;

    if (!qdot_lagrangian_has(s, QDOT_T, &has))
        return QDOT_NIL;
    if (has)
        power = qdot_neg(pool, qdot_lagrangian_slope(s, QDOT_T));
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const bool state = qdot_scene_state_of(s, s->coordinates.at[i]) != NULL;
        qdot_expr Q = state ? qdot_neg(pool, qdot_lagrangian_slope(s, s->coordinates.at[i])) : qdot_force_total(s, i, false, true);

        power = qdot_add(pool, power, qdot_mul(pool, Q, qdot_mech_jet(s, i, 1)));
    }
    return power;
}

static qdot_expr
constraint_power(qdot_scene *s, size_t k)
{
    qdot_pool *pool = s->pool;
    qdot_expr power = QDOT_ZERO;

    if (s->constraints.at[k].kind == QDOT_HOLONOMIC)
        return qdot_diff(pool, s->constraints.at[k].f, QDOT_T);
    for (size_t i = 0; i < s->coordinates.n; i++)
        power = qdot_add(
            pool, power,
            qdot_mul(pool, qdot_constraint_slope(s, k, i), qdot_mech_jet(s, i, 1)));
    return power;
}

/* The rate dh/dt of the energy h, which may contain symbols of multipliers. */
static qdot_expr
energy_rate(qdot_scene *s)
{
    qdot_expr rate = applied_power(s);

    for (size_t k = 0; k < s->constraints.n; k++) {
        qdot_expr power = constraint_power(s, k);

        if (s->constraints.at[k].kind == QDOT_HOLONOMIC)
            power = qdot_neg(s->pool, power); /* since the constraint holds, q' df/dq = -df/dt */
        rate = qdot_add(s->pool, rate,
                        qdot_mul(s->pool, s->constraints.at[k].multiplier, power));
    }
    return rate;
}

/* The rate dp_i/dt of a momentum, which may contain symbols of multipliers. */
static qdot_expr
momentum_rate(qdot_scene *s, size_t i)
{
    qdot_pool *pool = s->pool;

    return qdot_sum(pool, 3,
                    (qdot_expr[]){qdot_lagrangian_slope(s, s->coordinates.at[i]),
                                  qdot_force_total(s, i, false, true),
                                  qdot_constraint_reaction(s, i)});
}

static bool
is_free_of_velocities(qdot_scene *s, qdot_expr e)
{
    return e != QDOT_NIL && (qdot_mech_holds(s, e) & (QDOT_HAS_VELOCITY |
                                                      QDOT_HAS_ACCELERATION)) == 0;
}

/* E less a quantity whose rate needs no accelerations: what is left, free of velocities; else
 * nil. */
static qdot_expr
difference_without_velocities(qdot_scene *s, qdot_expr E, qdot_expr known)
{
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr rest = E == known ? QDOT_ZERO : qdot_sub(s->pool, E, known);

    if (is_free_of_velocities(s, rest))
        return rest;
    rest = qdot_simplify(s->pool, rest, &facts);
    return is_free_of_velocities(s, rest) ? rest : QDOT_NIL;
}

/* Whether H is stated, and no Lagrangian was found. */
static bool
has_hamiltonian_alone(const qdot_scene *s)
{
    return s->hamiltonian != QDOT_NIL && s->lagrangian == QDOT_NIL;
}

bool
qdot_mech_lacks_mass(qdot_scene *s)
{
    const qdot_expr M = has_hamiltonian_alone(s) ? QDOT_NIL : qdot_mech_mass_matrix(s);
    const uint32_t n = (uint32_t)s->coordinates.n;

    for (uint32_t i = 0; i < n && M != QDOT_NIL; i++) {
        bool none = true;

        for (uint32_t j = 0; j < n && none; j++)
            none = qdot_expr_arg(s->pool, M, i * n + j) == QDOT_ZERO;
        if (none)
            return true;
    }
    return false;
}

/* dE/dt of E(q, p, t), sum dE/dq q' + dE/dp p' + dE/dt, written in velocities. Nil where E holds velocities too. */
static qdot_expr
rate_in_momenta(qdot_scene *s, qdot_expr E)
{
    qdot_pool *pool = s->pool;
    const size_t n = s->coordinates.n;
    qdot_expr rate, *from;
    size_t held = 0;

    if (!is_free_of_velocities(s, E))
        return QDOT_NIL;
    from = qdot_calloc(2 * n + 1, sizeof *from);
    if (from == NULL)
        return qdot_pool_fail(pool);
    rate = qdot_diff(pool, E, QDOT_T);
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        const qdot_expr q = s->coordinates.at[i], p = qdot_symbol_of(pool, QDOT_MOMENTUM, q);

        rate = qdot_add(pool, rate, qdot_mul(pool, qdot_diff(pool, E, q), qdot_mech_jet(s, i, 1)));
        if (!qdot_expr_contains(pool, E, p))
            continue;
        rate = qdot_add(pool, rate, qdot_mul(pool, qdot_diff(pool, E, p), momentum_rate(s, i)));
        from[held] = p;
        from[n + held++] = qdot_mech_momentum(s, q);
    }
    if (!qdot_pool_failed(pool))
        rate = qdot_subs(pool, rate, held, from, from + n);
    qdot_free(from);
    return qdot_pool_failed(pool) ? QDOT_NIL : rate;
}

/* dE/dt by Hamilton's equations, dE/dt + sum dE/dq dH/dp + dE/dp (Q + R - dH/dq) with reactions R, in momenta. Nil where E holds accelerations. */
static qdot_expr
rate_by_hamiltonian(qdot_scene *s, qdot_expr E)
{
    qdot_pool *pool = s->pool;
    qdot_expr rate;

    E = qdot_rate_in_momenta(s, E);
    if (!is_free_of_velocities(s, E))
        return QDOT_NIL;
    rate = qdot_diff(pool, E, QDOT_T);
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr q = s->coordinates.at[i], p = qdot_symbol_of(pool, QDOT_MOMENTUM, q);
        const qdot_expr force = qdot_sub(pool, qdot_add(pool, qdot_mech_force(s, q), qdot_constraint_reaction(s, i)),
                                         qdot_diff(pool, s->hamiltonian, q));

        rate = qdot_add(pool, rate, qdot_mul(pool, qdot_diff(pool, E, q), qdot_mech_jet(s, i, 1)));
        rate = qdot_add(pool, rate, qdot_mul(pool, qdot_diff(pool, E, p), force));
    }
    return qdot_rate_in_momenta(s, qdot_scene_with_rates(s, rate));
}

/* dE/dt of a combination of the momenta; nil where E is none. */
static qdot_expr
rate_of_combination(qdot_scene *s, qdot_expr E)
{
    qdot_pool *pool = s->pool;
    const size_t n = s->coordinates.n;
    qdot_expr *xi = qdot_calloc(n + 1, sizeof *xi), rate = QDOT_NIL, K;
    bool is = false;

    if (xi == NULL || qdot_combination_of_momenta(s, E, xi, &K, &is) != QDOT_OK)
        qdot_pool_fail(pool);
    if (is)
        rate = qdot_ddt(pool, K);
    for (size_t i = 0; i < n && is; i++) {
        rate = qdot_add(pool, rate, qdot_mul(pool, qdot_ddt(pool, xi[i]), qdot_mech_momentum(s, s->coordinates.at[i])));
        rate = qdot_add(pool, rate, qdot_mul(pool, xi[i], momentum_rate(s, i)));
    }
    qdot_free(xi);
    return rate;
}

/* qdot_mech_rate, with the velocities of states in it. */
static qdot_expr
rate_without_accelerations(qdot_scene *s, qdot_expr E)
{
    qdot_expr rest;

    if (qdot_mech_holds(s, E) & QDOT_HAS_MOMENTUM)
        return s->higher.n > 0 ? QDOT_NIL : rate_in_momenta(s, E);
    if (is_free_of_velocities(s, E) && !qdot_mech_lacks_mass(s))
        return qdot_ddt(s->pool, E);
    rest = s->higher.n > 0 ? QDOT_NIL : difference_without_velocities(s, E, qdot_mech_energy(s));
    if (rest != QDOT_NIL)
        return qdot_add(s->pool, energy_rate(s), qdot_ddt(s->pool, rest));
    for (size_t i = 0; i < s->coordinates.n && !qdot_pool_failed(s->pool); i++) {
        rest = difference_without_velocities(s, E, qdot_mech_momentum(s, s->coordinates.at[i]));
        if (rest != QDOT_NIL)
            return qdot_add(s->pool, momentum_rate(s, i), qdot_ddt(s->pool, rest));
    }
    return s->higher.n > 0 || s->states.n > 0 ? QDOT_NIL : rate_of_combination(s, E);
}

qdot_expr
qdot_mech_rate(qdot_scene *s, qdot_expr E)
{
    E = qdot_scene_with_rates(s, E);
    if (E != QDOT_NIL && has_hamiltonian_alone(s))
        return rate_by_hamiltonian(s, E);
    return qdot_scene_with_rates(s, rate_without_accelerations(s, E));
}

qdot_status
qdot_mech_energy_conserved(qdot_scene *s, bool *conserved)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = qdot_derived_get(s);
    qdot_facts facts = qdot_scene_facts(s), on_manifold = facts;
    qdot_expr *relations = NULL, power;
    qdot_status status = qdot_pool_check(pool);

    QDOT_TRY(status);
    *conserved = d->conserved;
    if (d->conserved_known || (s->states.n > 0 && s->states.n == s->coordinates.n)) /* states alone have no energy */
        return QDOT_OK;
    if (s->higher.n > 0) {
        d->conserved_known = true;
        *conserved = d->conserved = qdot_ostrogradsky_conserves(s);
        return qdot_pool_check(pool);
    }
    if (s->constraints.n)
        status = qdot_constraint_facts(s, &relations, &on_manifold);
    if (status == QDOT_OK) {
        power = applied_power(s);
        *conserved = power != QDOT_NIL &&
                     (qdot_is_zero(pool, power, &facts) ||
                      (s->constraints.n && qdot_is_zero(pool, power, &on_manifold)));
        for (size_t k = 0; k < s->constraints.n && *conserved; k++) {
            qdot_expr f = s->constraints.at[k].f;

            /* If f is linear and homogeneous in q', its power is a multiple of f, which is 0. */
            power = constraint_power(s, k);
            *conserved = power != QDOT_NIL &&
                         (qdot_is_zero(pool, power, &facts) ||
                          qdot_is_zero(pool, qdot_sub(pool, power, f), &facts) ||
                          qdot_is_zero(pool, power, &on_manifold));
        }
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK && *conserved) {
        bool jumps = false;

        if (!qdot_lagrangian_has(s, QDOT_T, &jumps) || jumps)
            status = qdot_jumps(pool,
                                qdot_mech_stated(s) ? s->lagrangian
                                                    : qdot_sub(pool, qdot_mech_numeric_kinetic(s), qdot_potential_raw(s)),
                                QDOT_HAS_TIME, &jumps);
        *conserved = !jumps;
    }
    qdot_free(relations);
    if (status == QDOT_OK) {
        d = qdot_derived_get(s);
        d->conserved_known = true;
        d->conserved = *conserved;
    }
    return status;
}
