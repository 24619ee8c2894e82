/* bodies.c -- momentum, angular momentum, inertia and energy of a particle, a body or the scene. */
#include "mech/study/bodies.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/body.h"

/* The inertia about the centre along the axes of space, A I A^T; in the plane I. */
static qdot_expr
inertia_in_space(qdot_pool *pool, const qdot_body *b)
{
    if (b->angle != QDOT_NIL)
        return b->inertia;
    return qdot_value_mul(pool, qdot_value_mul(pool, b->rotation, b->inertia), qdot_transpose(pool, b->rotation));
}

static qdot_expr
tidy_component(qdot_pool *pool, qdot_expr e, void *scene)
{
    (void)pool;
    return qdot_mech_tidy(scene, e);
}

/* A I A^T w, from the spin A^T w along the body's axes, which is short; in the plane I w. */
static qdot_expr
momentum_of_spin(qdot_scene *s, const qdot_body *b)
{
    qdot_pool *pool = s->pool;
    qdot_expr w = qdot_body_spin(s, b);

    if (b->angle != QDOT_NIL)
        return qdot_mul(pool, b->inertia, w);
    w = qdot_value_map(pool, qdot_value_mul(pool, qdot_transpose(pool, b->rotation), w), tidy_component, s);
    return qdot_value_mul(pool, b->rotation, qdot_value_mul(pool, b->inertia, w));
}

static qdot_expr
momentum_of(qdot_scene *s, const qdot_massive *one, qdot_expr about)
{
    (void)about;
    return qdot_value_mul(s->pool, one->mass, qdot_ddt(s->pool, one->position));
}

static qdot_expr
angular_momentum_of(qdot_scene *s, const qdot_massive *one, qdot_expr about)
{
    qdot_pool *pool = s->pool;
    qdot_expr arm = about == QDOT_NIL ? one->position : qdot_value_sub(pool, one->position, about);
    qdot_expr L = qdot_value_mul(pool, one->mass, qdot_cross(pool, arm, qdot_ddt(pool, one->position)));

    return one->body == NULL ? L : qdot_value_add(pool, L, momentum_of_spin(s, one->body));
}

static qdot_expr
inertia_of(qdot_scene *s, const qdot_massive *one, qdot_expr about)
{
    qdot_pool *pool = s->pool;
    qdot_expr d = qdot_value_sub(pool, one->position, about == QDOT_NIL ? one->position : about);
    qdot_expr J = qdot_body_steiner(pool, one->mass, d);

    return one->body == NULL ? J : qdot_value_add(pool, inertia_in_space(pool, one->body), J);
}

/* The sum of one function over the scene, or its value for what has the label. */
static qdot_expr
sum_over(qdot_scene *s, qdot_expr (*of)(qdot_scene *, const qdot_massive *, qdot_expr), const char *label, qdot_expr about)
{
    qdot_pool *pool = s->pool;
    qdot_expr sum = QDOT_NIL;

    for (size_t k = 0; k < s->particles.n + s->bodies.n && !qdot_pool_failed(pool); k++) {
        const qdot_massive one = qdot_scene_massive(s, k);
        qdot_expr term;

        if (label != NULL && !qdot_label_is(one.name, label))
            continue;
        term = of(s, &one, about);
        sum = sum == QDOT_NIL ? term : qdot_value_add(pool, sum, term);
    }
    return qdot_value_map(pool, sum, tidy_component, s);
}

/* Whether the scene has masses, in a plane or in space, and P is a place there. */
static bool
needs_moments(qdot_scene *s, const char *what, qdot_expr about)
{
    const uint32_t dimension = qdot_scene_dimension(s);

    if (!qdot_mech_needs_particles(s, what))
        return false;
    if (dimension == 1)
        qdot_mech_fail(s, QDOT_EDOMAIN, "on a line there is no %s", what);
    else if (about != QDOT_NIL && qdot_mech_dimension(s->pool, about) != dimension)
        qdot_mech_fail(s, QDOT_ETYPE, "the place P has %u components here", dimension);
    return !qdot_pool_failed(s->pool);
}

qdot_expr
qdot_bodies_momentum(qdot_scene *s, const char *label)
{
    return qdot_mech_needs_particles(s, "momentum") ? sum_over(s, momentum_of, label, QDOT_NIL) : QDOT_NIL;
}

qdot_expr
qdot_bodies_angular_momentum(qdot_scene *s, const char *label, qdot_expr about)
{
    return needs_moments(s, "angular momentum", about) ? sum_over(s, angular_momentum_of, label, about) : QDOT_NIL;
}

qdot_expr
qdot_bodies_inertia(qdot_scene *s, const char *label, qdot_expr about)
{
    return needs_moments(s, "moment of inertia", about) ? sum_over(s, inertia_of, label, about) : QDOT_NIL;
}

qdot_expr
qdot_bodies_energy(qdot_scene *s, const char *label)
{
    qdot_expr energy = QDOT_NIL;
    qdot_energy_part part;

    for (size_t k = 0; qdot_mech_kinetic_part(s, k, &part) && energy == QDOT_NIL; k++)
        if (qdot_label_is(part.name, label)) {
            energy = part.value;
            if (s->gravities.n > 0 && qdot_mech_potential_part(s, k, &part))
                energy = qdot_add(s->pool, energy, part.value);
        }
    return energy;
}
