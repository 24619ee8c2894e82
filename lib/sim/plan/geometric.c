/* geometric.c -- looks whether momenta are q' times constants, and forces free of q'. */
#include "sim/plan/geometric.h"

#include "ode/geometric/geometric.h"
#include "tape/constant.h"

/* The first coordinate whose row of M is no row of numbers; n: none. */
static size_t
varying_mass(const qdot_plan *p)
{
    size_t i = 0;

    while (i < p->n * p->n && qdot_constant_is(p->pool, p->M[i]))
        i++;
    return i / p->n;
}

/* The first coordinate whose force holds velocities; n: none. */
static size_t
velocity_force(const qdot_plan *p)
{
    size_t i = 0;

    while (i < p->n && !(qdot_expr_node(p->pool, p->f[i])->holds & QDOT_HAS_VELOCITY))
        i++;
    return i;
}

static qdot_status
refuse(const qdot_plan *p, const char *why, const char *name)
{
    qdot_fail(QDOT_ENOTBUILT, "%s %s%s", p->method->name, why, name);
    return qdot_hint("method taylor");
}

qdot_status
qdot_plan_check_geometric(qdot_plan *p, qdot_scene *scene)
{
    size_t i;

    if (!p->method->geometric)
        return QDOT_OK;
    if (scene->constraints.n > 0)
        return refuse(p, "is for scenes without constraints", "");
    i = varying_mass(p);
    if (i < p->n)
        return refuse(p, "needs constant masses, but the mass matrix varies in the row of ",
                      p->names[i]);
    i = velocity_force(p);
    if (i < p->n && p->method->geometric->separable)
        return refuse(p, "needs forces without velocities, but there are some along ", p->names[i]);
    p->halves = true;
    return QDOT_OK;
}
