/* replace.c -- all expressions of a scene by others.
 *
 * A function may be declared, and used, before the coordinate that is its argument.
 */
#include "expr/calculus.h"
#include "expr/walk.h"
#include "mech/scene/scene.h"

typedef struct {
    qdot_expr (*f)(qdot_expr e, void *user);
    void *user;
} mapping;

static void
map_expression(const mapping *m, qdot_expr *e)
{
    if (*e != QDOT_NIL)
        *e = m->f(*e, m->user);
}

/* Replace a field of every item of a list by its image under the map. */
#define MAP(list, field)                                                                 \
    do {                                                                                 \
        for (size_t i_ = 0; i_ < s->list.n; i_++)                                        \
            map_expression(&m, &s->list.at[i_] field);                                              \
    } while (0)

static void
map_all_expressions(qdot_scene *s, mapping m)
{
    MAP(particles, .mass);
    MAP(particles, .position);
    MAP(bodies, .mass);
    MAP(bodies, .position);
    MAP(bodies, .rotation);
    MAP(bodies, .inertia);
    MAP(bodies, .angle);
    MAP(springs, .at[0]);
    MAP(springs, .at[1]);
    MAP(springs, .stiffness);
    MAP(springs, .rest);
    MAP(dampers, .at[0]);
    MAP(dampers, .at[1]);
    MAP(dampers, .stiffness);
    MAP(dampers, .rest);
    MAP(forces, .force);
    MAP(forces, .point);
    MAP(torques, .torque);
    MAP(constraints, .f);
    MAP(constraints, .left);
    MAP(constraints, .right);
    MAP(gravities, .e);
    MAP(potentials, .e);
    MAP(dissipations, .e);
    MAP(states, .rate);
    MAP(assumed, .relation);
    MAP(conditions, );
    MAP(relations, );
    MAP(outputs, );
    map_expression(&m, &s->lagrangian);
    map_expression(&m, &s->higher_lagrangian);
    map_expression(&m, &s->hamiltonian);
}

qdot_status
qdot_scene_map(qdot_scene *s, qdot_expr (*f)(qdot_expr e, void *user), void *user)
{
    map_all_expressions(s, (mapping){f, user});
    qdot_scene_changed(s);
    return qdot_pool_check(s->pool);
}

typedef struct {
    qdot_pool *pool;
    qdot_expr symbol;
    bool found;
} search;

static qdot_expr
search_symbol_in_expression(qdot_expr e, void *user)
{
    search *x = user;

    x->found |= qdot_expr_contains(x->pool, e, x->symbol);
    return e;
}

bool
qdot_scene_contains(qdot_scene *s, qdot_expr symbol)
{
    search x = {s->pool, symbol, false};

    map_all_expressions(s, (mapping){search_symbol_in_expression, &x});
    return x.found;
}

typedef struct {
    qdot_pool *pool;
    qdot_expr from, to;
} replacement;

static qdot_expr
replace_in_expression(qdot_expr e, void *user)
{
    const replacement *r = user;

    return qdot_subs(r->pool, e, 1, &r->from, &r->to);
}

qdot_status
qdot_scene_replace(qdot_scene *s, qdot_expr from, qdot_expr to)
{
    return qdot_scene_map(s, replace_in_expression, &(replacement){s->pool, from, to});
}
