/* parts.c -- splits T and V into the parts of each particle, body, field, spring. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/quantity.h"
#include "mech/geometry/metric.h"
#include "mech/scene/access.h"
#include "normal/form/common.h"

/* Twice the rotational energy of a body, w.I w; in space in the body's axes, in which I is given. */
static qdot_expr
twice_rotational_energy(qdot_scene *s, const qdot_body *b)
{
    qdot_pool *pool = s->pool;
    qdot_expr w = qdot_scene_spin(s, b->name);

    if (b->angle != QDOT_NIL)
        return qdot_mul(pool, b->inertia, qdot_pow_int(pool, w, 2));
    w = qdot_mech_tidy(s, qdot_value_mul(pool, qdot_transpose(pool, b->rotation), w));
    return qdot_dot(pool, w, qdot_value_mul(pool, b->inertia, w));
}

bool
qdot_mech_kinetic_part(qdot_scene *s, size_t k, qdot_energy_part *part)
{
    qdot_pool *pool = s->pool;
    qdot_expr T;
    qdot_massive m;

    if (k >= s->particles.n + s->bodies.n)
        return false;
    m = qdot_scene_massive(s, k);
    T = qdot_mul(pool, m.mass, qdot_common_out(pool, qdot_mech_speed2(s, m.position)));
    T = qdot_mul(pool, QDOT_HALF, T);
    if (m.body)
        T = qdot_add(pool, T, qdot_mul(pool, QDOT_HALF, twice_rotational_energy(s, m.body)));
    *part = (qdot_energy_part){.kind = "kinetic energy", .name = m.name, .value = T};
    return true;
}

/* The potential -m g.r of a particle or body, where g is the sum of all gravity fields. */
static qdot_expr
gravity_potential(qdot_scene *s, const qdot_massive *m)
{
    qdot_pool *pool = s->pool;
    qdot_expr height = QDOT_ZERO;

    for (size_t g = 0; g < s->gravities.n; g++)
        height = qdot_sub(pool, height,
                          qdot_mech_dot(pool, s->gravities.at[g].e, m->position));
    return qdot_mul(pool, m->mass, qdot_common_out(pool, qdot_mech_tidy(s, height)));
}

bool
qdot_mech_potential_part(qdot_scene *s, size_t k, qdot_energy_part *part)
{
    const size_t heavy = s->gravities.n > 0 ? s->particles.n + s->bodies.n : 0;

    if (k < heavy) {
        const qdot_massive m = qdot_scene_massive(s, k);

        *part =
            (qdot_energy_part){.kind = "gravity", .name = m.name, .value = gravity_potential(s, &m)};
        return true;
    }
    k -= heavy;
    if (k < s->potentials.n) {
        const qdot_term *term = &s->potentials.at[k];

        *part = (qdot_energy_part){
            .kind = "potential", .name = term->name, .value = qdot_mech_tidy(s, term->e)};
        return true;
    }
    k -= s->potentials.n;
    if (k >= s->springs.n)
        return false;
    *part = (qdot_energy_part){.kind = "spring",
                               .name = s->springs.at[k].name,
                               .value = qdot_mech_tidy(s, qdot_spring_potential(s, k))};
    return true;
}
