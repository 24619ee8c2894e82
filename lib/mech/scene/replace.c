/* scene-replace.c -- one symbol of a scene by another expression.
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

static void
replace_all(const replacement *r, size_t n, qdot_expr *e)
{
    for (size_t i = 0; i < n; i++)
        replace(r, &e[i]);
}

static void
replace_terms(const replacement *r, size_t n, qdot_term *terms)
{
    for (size_t i = 0; i < n; i++)
        replace(r, &terms[i].e);
}

static void
replace_links(const replacement *r, size_t n, qdot_link *links)
{
    for (size_t i = 0; i < n; i++) {
        replace_all(r, 2, links[i].at);
        replace(r, &links[i].stiffness);
        replace(r, &links[i].rest);
    }
}

static void
replace_masses(const replacement *r, qdot_scene *s)
{
    for (size_t i = 0; i < s->particles.n; i++) {
        replace(r, &s->particles.at[i].mass);
        replace(r, &s->particles.at[i].position);
    }
    for (size_t i = 0; i < s->bodies.n; i++) {
        qdot_body *b = &s->bodies.at[i];

        replace(r, &b->mass);
        replace(r, &b->position);
        replace(r, &b->rotation);
        replace(r, &b->inertia);
        replace(r, &b->angle);
    }
}

static void
replace_actions(const replacement *r, qdot_scene *s)
{
    for (size_t i = 0; i < s->forces.n; i++) {
        replace(r, &s->forces.at[i].force);
        replace(r, &s->forces.at[i].point);
    }
    for (size_t i = 0; i < s->torques.n; i++)
        replace(r, &s->torques.at[i].torque);
    for (size_t i = 0; i < s->constraints.n; i++) {
        replace(r, &s->constraints.at[i].f);
        replace(r, &s->constraints.at[i].left);
        replace(r, &s->constraints.at[i].right);
    }
}

qdot_status
qdot_scene_replace(qdot_scene *s, qdot_expr from, qdot_expr to)
{
    replacement r = {s->pool, from, to};

    replace_masses(&r, s);
    replace_links(&r, s->springs.n, s->springs.at);
    replace_links(&r, s->dampers.n, s->dampers.at);
    replace_actions(&r, s);
    replace_terms(&r, s->gravities.n, s->gravities.at);
    replace_terms(&r, s->potentials.n, s->potentials.at);
    replace_terms(&r, s->dissipations.n, s->dissipations.at);
    for (size_t i = 0; i < s->assumed.n; i++)
        replace(&r, &s->assumed.at[i].relation);
    replace_all(&r, s->conditions.n, s->conditions.at);
    replace_all(&r, s->relations.n, s->relations.at);
    replace(&r, &s->lagrangian);
    s->version++;
    return qdot_pool_check(s->pool);
}
