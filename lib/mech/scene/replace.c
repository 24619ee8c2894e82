/* replace.c -- one symbol of a scene by another expression.
 *
 * A function may be declared, and used, before the coordinate that is its argument.
 */
#include "expr/calculus.h"
#include "mech/scene/scene.h"

typedef struct {
    qdot_pool *pool;
    qdot_expr from, to;
} replacement;

static void
replace(const replacement *r, qdot_expr *e)
{
    if (*e != QDOT_NIL)
        *e = qdot_subs(r->pool, *e, 1, &r->from, &r->to);
}

/* In a field of every item. */
#define REPLACE(list, field)                                                             \
    do {                                                                                 \
        for (size_t i_ = 0; i_ < s->list.n; i_++)                                        \
            replace(&r, &s->list.at[i_] field);                                          \
    } while (0)

qdot_status
qdot_scene_replace(qdot_scene *s, qdot_expr from, qdot_expr to)
{
    const replacement r = {s->pool, from, to};

    REPLACE(particles, .mass);
    REPLACE(particles, .position);
    REPLACE(bodies, .mass);
    REPLACE(bodies, .position);
    REPLACE(bodies, .rotation);
    REPLACE(bodies, .inertia);
    REPLACE(bodies, .angle);
    REPLACE(springs, .at[0]);
    REPLACE(springs, .at[1]);
    REPLACE(springs, .stiffness);
    REPLACE(springs, .rest);
    REPLACE(dampers, .at[0]);
    REPLACE(dampers, .at[1]);
    REPLACE(dampers, .stiffness);
    REPLACE(dampers, .rest);
    REPLACE(forces, .force);
    REPLACE(forces, .point);
    REPLACE(torques, .torque);
    REPLACE(constraints, .f);
    REPLACE(constraints, .left);
    REPLACE(constraints, .right);
    REPLACE(gravities, .e);
    REPLACE(potentials, .e);
    REPLACE(dissipations, .e);
    REPLACE(assumed, .relation);
    REPLACE(conditions, );
    REPLACE(relations, );
    replace(&r, &s->lagrangian);
    s->version++;
    return qdot_pool_check(s->pool);
}
