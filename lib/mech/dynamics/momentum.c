/* momentum.c -- p_i = dL/dq_i' = sum_j M_ij q_j' + b_i - dV/dq_i'; cyclic coordinates.
 *
 * Where dL/dq_i = 0 Lagrange's equation reads p_i' = Q_i + R_i, with Q what is applied
 * beside V and R the reactions: p_i is conserved when both vanish.
 */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/energy.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "mech/scene/constraint.h"
#include "normal/prove/decide.h"

qdot_expr
qdot_mech_momentum(qdot_scene *s, qdot_expr q)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d;
    qdot_expr p, V;
    size_t i;

    if (!qdot_mech_index(s, q, &i))
        return QDOT_NIL;
    d = qdot_derived_get(s);
    if (!qdot_derived_array(s, &d->momentum, d->n))
        return QDOT_NIL;
    if (d->momentum[i] != QDOT_NIL)
        return d->momentum[i];
    if (qdot_mech_stated(s)) {
        p = qdot_diff(pool, s->lagrangian, qdot_mech_jet(s, i, 1));
        return d->momentum[i] = qdot_mech_tidy(s, p);
    }
    if (!qdot_mass_get(s))
        return QDOT_NIL;
    V = qdot_potential_with_velocities(s);
    p = qdot_sub(pool, d->b[i], qdot_diff(pool, V, qdot_mech_jet(s, i, 1)));
    for (size_t j = 0; j < d->n; j++)
        p = qdot_add(pool, p,
                     qdot_mul(pool, qdot_mass_entry(s, i, j), qdot_mech_jet(s, j, 1)));
    return d->momentum[i] = qdot_mech_tidy_whole(s, p);
}

bool
qdot_mech_holds_momentum_rate(qdot_scene *s, qdot_expr e)
{
    if (e == QDOT_NIL || !(qdot_mech_holds(s, e) & QDOT_HAS_MOMENTUM))
        return false;
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr p = qdot_symbol_of(s->pool, QDOT_MOMENTUM, s->coordinates.at[i]);

        if (qdot_expr_contains(s->pool, e, qdot_symbol_jet(s->pool, p, 1)))
            return true;
    }
    return false;
}

qdot_expr
qdot_mech_momenta(qdot_scene *s)
{
    return qdot_mech_each(s, s->coordinates.n, qdot_mech_momentum);
}

/* Find whether coordinate i is cyclic, with its momentum and rate; the result may also be undecided. */
static qdot_cyclic_known
find_cyclic(qdot_scene *s, size_t i)
{
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_cyclic_known c = {.known = true};

    if (qdot_scene_state_of(s, s->coordinates.at[i]) || !qdot_lagrangian_is_still(s, s->coordinates.at[i]))
        return c;
    c.momentum = qdot_mech_momentum(s, s->coordinates.at[i]);
    c.rate = qdot_add(s->pool, qdot_force_total(s, i, true, true), qdot_constraint_reaction(s, i));
    if (c.momentum != QDOT_NIL && !qdot_is_zero(s->pool, c.momentum, &facts)) {
        if (qdot_is_zero(s->pool, c.rate, &facts))
            c.rate = QDOT_NIL;
        c.is = true;
    }
    return c;
}

qdot_status
qdot_mech_cyclic_at(qdot_scene *s, size_t i, qdot_cyclic *c, bool *is)
{
    qdot_derived *d = qdot_derived_get(s);
    qdot_cyclic_known found;

    if (!d->cyclic)
        d->cyclic = qdot_calloc(d->n + 1, sizeof *d->cyclic);
    if (!d->cyclic)
        return QDOT_ENOMEM;
    found = d->cyclic[i];
    if (!found.known) {
        found = find_cyclic(s, i);
        QDOT_TRY(qdot_pool_check(s->pool));
        qdot_derived_get(s)->cyclic[i] = found;
    }
    *c = (qdot_cyclic){s->coordinates.at[i], found.momentum, found.rate};
    *is = found.is;
    return QDOT_OK;
}

qdot_status
qdot_mech_cyclic(qdot_scene *s, qdot_cyclic **list, size_t *n)
{
    qdot_vec(qdot_cyclic) found = {0};
    qdot_status status = qdot_pool_check(s->pool);

    for (size_t i = 0; i < s->coordinates.n && status == QDOT_OK; i++) {
        qdot_cyclic c;
        bool is;

        status = qdot_mech_cyclic_at(s, i, &c, &is);
        if (status == QDOT_OK && is)
            status = qdot_vec_push(&found, c);
    }
    if (status != QDOT_OK) {
        qdot_free(found.at);
        found.at = NULL;
        found.n = 0;
    }
    *list = found.at;
    *n = found.n;
    return status;
}

qdot_status
qdot_mech_applied_holds(qdot_scene *s, qdot_expr x, bool *holds)
{
    *holds = false;
    for (size_t i = 0; i < s->coordinates.n && !*holds; i++) {
        qdot_expr Q = qdot_add(s->pool, qdot_force_total(s, i, false, true),
                               qdot_constraint_reaction(s, i));

        QDOT_TRY(qdot_pool_check(s->pool));
        *holds = qdot_expr_contains(s->pool, Q, x);
    }
    return QDOT_OK;
}

/* Momenta are made of masses, places and what V says of velocities; they need not be derived to see whether x occurs. */
qdot_status
qdot_mech_rate_matters(qdot_scene *s, qdot_expr x, bool *matters)
{
    qdot_pool *pool = s->pool;
    const qdot_expr by_velocities = qdot_mech_stated(s) ? s->lagrangian : qdot_potential_with_velocities(s);

    *matters = false;
    for (size_t i = 0; i < s->particles.n; i++)
        *matters |= qdot_expr_is_in_any(pool, x, 2, (qdot_expr[]){s->particles.at[i].mass, s->particles.at[i].position});
    for (size_t i = 0; i < s->bodies.n; i++) {
        const qdot_body *b = &s->bodies.at[i];

        *matters |= qdot_expr_is_in_any(pool, x, 4, (qdot_expr[]){b->mass, b->inertia, b->position, b->rotation});
    }
    for (size_t i = 0; i < s->dampers.n; i++)
        *matters |= qdot_expr_is_in_any(pool, x, 2, s->dampers.at[i].at);
    for (size_t i = 0; i < s->coordinates.n && !*matters && by_velocities != QDOT_NIL; i++)
        *matters = qdot_expr_contains(pool, qdot_diff(pool, by_velocities, qdot_mech_jet(s, i, 1)), x);
    return qdot_pool_check(pool);
}
