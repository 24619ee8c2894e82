/* potential.c -- the potential energy V of gravity, potentials and springs. */

#include "mech/dynamics/potential.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/dynamics/kinematics.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"

qdot_expr
qdot_link_square(qdot_scene *s, bool damper, size_t k)
{
    qdot_derived *d = qdot_derived_get(s);
    qdot_expr **cache = damper ? &d->square_damper : &d->square_spring;
    const qdot_link *link = damper ? &s->dampers.at[k] : &s->springs.at[k];
    qdot_expr u;

    if (!qdot_derived_array(s, cache, damper ? s->dampers.n : s->springs.n))
        return QDOT_NIL;
    if ((*cache)[k] == QDOT_NIL) {
        u = qdot_value_sub(s->pool, link->at[0], link->at[1]);
        (*cache)[k] = qdot_mech_tidy(s, qdot_mech_dot(s->pool, u, u));
    }
    return (*cache)[k];
}

/* The potential k/2 (d - rest)^2 of a spring of length d; written without a root if rest = 0. */
qdot_expr
qdot_spring_potential(qdot_scene *s, size_t k)
{
    qdot_pool *pool = s->pool;
    const qdot_link *spring = &s->springs.at[k];
    qdot_expr square = qdot_link_square(s, false, k);

    if (spring->rest != QDOT_ZERO)
        square =
            qdot_pow_int(pool, qdot_sub(pool, qdot_sqrt(pool, square), spring->rest), 2);
    return qdot_mul(pool, QDOT_HALF, qdot_mul(pool, spring->stiffness, square));
}

qdot_expr
qdot_potential_with_velocities(qdot_scene *s)
{
    qdot_expr V = QDOT_ZERO;

    for (size_t i = 0; i < s->potentials.n; i++)
        if (qdot_mech_holds(s, s->potentials.at[i].e) & QDOT_HAS_VELOCITY)
            V = qdot_add(s->pool, V, s->potentials.at[i].e);
    return V;
}

qdot_expr
qdot_potential_but_gravity(qdot_scene *s)
{
    qdot_expr V = QDOT_ZERO;

    for (size_t i = 0; i < s->potentials.n; i++)
        V = qdot_add(s->pool, V, s->potentials.at[i].e);
    for (size_t i = 0; i < s->springs.n; i++)
        V = qdot_add(s->pool, V, qdot_spring_potential(s, i));
    return V;
}

qdot_expr
qdot_potential_raw(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr V = QDOT_ZERO;

    if (s->gravities.n) {
        qdot_kinematics *k = qdot_kinematics_get(s);
        const qdot_groups *place = k ? qdot_kinematics_place(s, k) : NULL;

        if (!place)
            return QDOT_NIL;
        V = qdot_neg(pool, qdot_kinematics_gravity(s, k, place));
    }
    return qdot_add(pool, V, qdot_potential_but_gravity(s));
}

qdot_expr
qdot_mech_potential(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);

    if (d->potential != QDOT_NIL)
        return d->potential;
    if (!qdot_mech_needs_particles(s, "V"))
        return QDOT_NIL;
    return d->potential = qdot_mech_tidy(s, qdot_potential_raw(s));
}
