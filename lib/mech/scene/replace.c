/* replace.c -- all expressions of a scene by others.
 *
 * A function may be declared, and used, before the coordinate that is its argument.
 */
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
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
    for (int k = 0; k < 2; k++) {
        MAP(joints, .place[k]);
        MAP(joints, .axis[k]);
    }
    MAP(joints, .pitch);
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

bool
qdot_reads_coordinate(qdot_pool *pool, qdot_expr e, qdot_expr q)
{
    const qdot_expr atoms = e == QDOT_NIL ? QDOT_NIL : qdot_expr_atoms(pool, e, true);
    bool reads = false;

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms) && !reads; i++) {
        const qdot_expr atom = qdot_expr_arg(pool, atoms, i);
        const qdot_symbol *symbol = qdot_expr_symbol(pool, atom);

        reads = symbol ? atom == q || symbol->base == q : qdot_ufun_delayed(pool, qdot_expr_node(pool, atom)->op) == q;
    }
    return reads;
}

static qdot_expr
search_coordinate_in_expression(qdot_expr e, void *user)
{
    search *x = user;

    x->found = x->found || qdot_reads_coordinate(x->pool, e, x->symbol);
    return e;
}

bool
qdot_scene_reads(qdot_scene *s, qdot_expr q)
{
    search x = {s->pool, q, false};

    map_all_expressions(s, (mapping){search_coordinate_in_expression, &x});
    for (size_t i = 0; i < s->torques.n; i++)
        x.found = x.found || s->torques.at[i].coordinate == q;
    for (size_t i = 0; i < s->events.n; i++) {
        const qdot_event *e = &s->events.at[i];

        (void)search_coordinate_in_expression(e->left, &x);
        (void)search_coordinate_in_expression(e->right, &x);
        for (size_t k = 0; k < e->targets.n; k++) {
            (void)search_coordinate_in_expression(e->targets.at[k], &x);
            (void)search_coordinate_in_expression(e->values.at[k], &x);
        }
    }
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
