/* geometric.c -- tests whether geometric methods apply: constant M, and forces independent of velocities. */
#include "sim/plan/geometric.h"

#include "expr/node.h"
#include "expr/symbol.h"
#include "ode/geometric/geometric.h"
#include "sim/form/phase-space.h"

/* The first coordinate whose row of the mass matrix M is not constant; n if all are. */
static size_t
first_varying_mass(const qdot_plan *p)
{
    size_t i = 0;

    while (i < p->n * p->n && qdot_expr_is_constant(p->pool, p->M[i]))
        i++;
    return i / p->n;
}

/* The first coordinate whose force depends on velocities; n if none does. */
static size_t
first_velocity_force(const qdot_plan *p)
{
    size_t i = 0;

    while (i < p->n && !(qdot_expr_node(p->pool, p->f[i])->holds & QDOT_HAS_VELOCITY))
        i++;
    return i;
}

static qdot_status
fail_not_applicable(const qdot_plan *p, const char *why, const char *name, const char *instead)
{
    qdot_fail(QDOT_ENOTBUILT, "%s %s%s", p->method->name, why, name);
    return qdot_hint("method %s", instead);
}

/* Refuse constraints that the method does not support: it must know constraints, and they must be
 * on positions. */
static qdot_status
check_constraints(const qdot_plan *p, const qdot_scene *scene, qdot_run_treatment treatment)
{
    const bool holds = p->method->geometric->of_bonds > 0;

    for (size_t k = 0; k < scene->constraints.n; k++)
        if (scene->constraints.at[k].kind != QDOT_HOLONOMIC)
            return fail_not_applicable(p, holds ? "needs constraints on positions, but velocities are in "
                                   : "is for scenes without constraints, unlike ",
                                    scene->constraints.at[k].name, "taylor");
    if (scene->constraints.n > 0 && !holds)
        return fail_not_applicable(p, "is for scenes without constraints", "", "variational");
    if (scene->constraints.n > 0 && treatment != QDOT_RUN_PROJECT)
        return qdot_fail(QDOT_ENOTBUILT, "%s satisfies the constraints in every step: no drift has "
                                         "to be treated", p->method->name);
    return QDOT_OK;
}

qdot_status
qdot_plan_check_geometric(qdot_plan *p, qdot_scene *scene, qdot_run_treatment treatment)
{
    size_t i;

    if (!p->method->geometric)
        return QDOT_OK;
    QDOT_TRY(check_constraints(p, scene, treatment));
    if (p->method->geometric->separable) {
        i = first_varying_mass(p);
        if (i < p->n)
            return fail_not_applicable(p, "needs constant masses, but the mass matrix varies in the row of ",
                                       p->names[i], "gauss8");
        i = first_velocity_force(p);
        if (i < p->n)
            return fail_not_applicable(p, "needs forces without velocities, but there are some along ",
                                       p->names[i], "gauss8");
    } else {
        QDOT_TRY(qdot_phase_space_new(scene, p, &p->phase_space));
    }
    p->halves = !p->phase_space;
    return QDOT_OK;
}
