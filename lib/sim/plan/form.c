/* form.c -- compares the costs of several forms of the equations of motion and chooses the cheapest. */
#include "sim/plan/form.h"

#include "base/memory.h"
#include "ode/taylor.h"
#include "sim/form/blocks.h"
#include "sim/form/bordered.h"
#include "sim/form/canonical.h"
#include "sim/form/derived.h"
#include "sim/form/eliminated.h"
#include "sim/form/motion-of-residual.h"
#include "sim/form/motion-series.h"
#include "sim/form/residual.h"
#include "sim/form/tree-series.h"
#include "sim/model/switch.h"
#include "sim/plan/cost.h"

/* Hamilton's equations are used if they need at most this fraction of the series products of other forms. */
static const double canonical_saves = 0.85;

static void
take_form(qdot_plan *p, qdot_form form, const qdot_ode_cost *cost)
{
    p->form = form;
    p->expansions = *cost;
    p->cost = qdot_cost_steps(cost);
}

/* --- M q'' = f ------------------------------------------------------------------------ */

/* Fail if a constant block of the mass matrix M has no inverse. */
static qdot_status
check_constant_blocks(const qdot_plan *p)
{
    qdot_blocks blocks;
    const qdot_status status = qdot_blocks_init(&blocks, p, false);

    qdot_blocks_clear(&blocks);
    return status;
}

qdot_status
qdot_plan_measure(qdot_plan *p)
{
    qdot_ode_cost cost;
    qdot_work work;

    QDOT_TRY(qdot_plan_make_motion(p));
    QDOT_TRY(check_constant_blocks(p));
    work = qdot_motion_series_work(p);
    p->convolutions_derived = work.convolutions;
    cost = qdot_cost_explicit(&work);
    take_form(p, QDOT_FORM_EXPLICIT, &cost);
    return QDOT_OK;
}

/* --- measuring d'Alembert's residual -------------------------------------------------- */

typedef struct {
    qdot_residual *residual;
    qdot_form form;
    qdot_ode_cost cost;
    qdot_work work;
    double convolutions;
    size_t nodes; /* for QDOT_FORM_TREE: number of nodes of the tree */
    bool is_path;
} candidate;

/* By its program, or along its tree if that is cheaper and there may be one: lanes and
 * numbers of many digits have programs only. */
static qdot_status
measure_residual_form(const qdot_plan *p, bool may_be_tree, candidate *c)
{
    qdot_residual *r = c->residual;
    qdot_tree_series *tree;
    qdot_ode_cost along;
    qdot_work work;

    QDOT_TRY(qdot_motion_of_residual(p, r, &r->motion));
    c->work = qdot_motion_series_work_of_residual(p, &r->motion, r->masses);
    c->form = QDOT_FORM_RESIDUAL;
    c->cost = qdot_cost_implicit(&c->work);
    c->convolutions = r->motion.program.convolutions;
    if (!may_be_tree)
        return QDOT_OK;
    QDOT_TRY(qdot_residual_programs(r));
    QDOT_TRY(qdot_tree_series_new(p, r, false, &tree));
    if (!tree)
        return QDOT_OK;
    work = qdot_tree_series_work(tree);
    along = qdot_cost_tree(&work);
    if (qdot_cost_steps(&along) < qdot_cost_steps(&c->cost)) {
        c->form = QDOT_FORM_TREE;
        c->cost = along;
        c->nodes = (size_t)work.nodes;
        c->is_path = qdot_tree_series_is_path(tree);
    }
    qdot_tree_series_free(tree);
    return QDOT_OK;
}

/* Whether the residual is cheaper: numbers of many digits spend all on convolutions; lanes
 * know no forces that hold velocities there. */
static bool
is_cheaper(const qdot_plan *p, const candidate *c, const qdot_run_request *request)
{
    if (request->digits > 0)
        return c->convolutions < p->convolutions_derived;
    if (request->lanes) {
        const qdot_work work = qdot_motion_series_work(p);
        const qdot_ode_cost own = qdot_cost_lanes(&c->work), other = qdot_cost_lanes(&work);

        return !p->indefinite && qdot_cost_steps(&own) < qdot_cost_steps(&other);
    }
    return qdot_cost_steps(&c->cost) < p->cost;
}

/* Whether there may be a cheaper form than M q'' = f: not where M is diagonal or constant.
 * d'Alembert's is made of the scene, which switches, and of constant masses. */
static bool
has_alternative_forms(const qdot_plan *p)
{
    if ((p->mode && p->mode->atoms.n > 0) || p->share || p->n_states > 0)
        return false;
    for (size_t k = 0; k < p->structure.blocks; k++)
        if (p->blocks[k].n > 1 && !p->blocks[k].constant)
            return true;
    return false;
}

qdot_status
qdot_plan_choose_form(qdot_plan *p, qdot_scene *scene, const qdot_run_request *request)
{
    candidate c = {0};
    qdot_status status;

    QDOT_TRY(qdot_plan_measure(p));
    if (!has_alternative_forms(p))
        return QDOT_OK;
    QDOT_TRY(qdot_residual_new(scene, p, &c.residual));
    if (!c.residual)
        return QDOT_OK;
    status = measure_residual_form(p, request->digits == 0 && !request->lanes, &c);
    if (status == QDOT_OK)
        p->convolutions_residual = c.convolutions;
    if (status == QDOT_OK && is_cheaper(p, &c, request)) {
        take_form(p, c.form, &c.cost);
        p->residual = c.residual;
        p->tree_nodes = c.nodes;
        p->tree_is_path = c.is_path;
        return QDOT_OK;
    }
    qdot_residual_free(c.residual);
    return status;
}

/* --- form for vector lanes -------------------------------------------------------------- */

qdot_status
qdot_plan_make_lanes(qdot_plan *p)
{
    const qdot_motion *motion;
    qdot_work work;

    if (!p->residual)
        QDOT_TRY(qdot_plan_make_motion_of_members(p));
    motion = p->residual ? &p->residual->motion : p->motion;
    work = qdot_work_of_motion(p, motion, p->residual ? p->residual->places : p->tape);
    p->expansions = qdot_cost_lanes(&work);
    return QDOT_OK;
}

/* --- forms for scenes with constraints ------------------------------------------------ */

/* Measure the cost of the form in which constraints are expanded in series; it is always possible. */
static qdot_status
measure_constrained_form(qdot_plan *p)
{
    qdot_motion_series *series;
    qdot_ode_cost cost;
    qdot_work work;

    QDOT_TRY(qdot_motion_series_of_constraints(p, false, &series));
    work = qdot_motion_series_work_of_constraints(series);
    p->convolutions_derived = work.convolutions;
    cost = qdot_cost_constrained(p, &work);
    take_form(p, QDOT_FORM_CONSTRAINED, &cost);
    qdot_motion_series_free(series);
    return QDOT_OK;
}

/* Choose the form with symbolically eliminated multipliers, if it is cheaper than the best form so far. */
static qdot_status
choose_eliminated_if_cheaper(qdot_plan *p, double tol, double *least)
{
    qdot_plan *e;
    qdot_ode_cost cost;
    qdot_work work;
    qdot_status status;
    double steps;

    QDOT_TRY(qdot_eliminated_make(p, tol, &e));
    if (!e)
        return QDOT_OK;
    status = qdot_plan_measure(e);
    if (status != QDOT_OK) {
        qdot_plan_free(e);
        return status;
    }
    work = qdot_motion_series_work(e);
    cost = qdot_cost_eliminated(p, &work);
    steps = qdot_cost_constrained_steps(p, &cost, tol);
    if (!(steps < *least)) {
        qdot_plan_free(e);
        return QDOT_OK;
    }
    take_form(p, QDOT_FORM_ELIMINATED, &cost);
    p->eliminated = e;
    *least = steps;
    return QDOT_OK;
}

/* Take the bordered form, in which machine code solves for multipliers, if its steps cost less than *least.
 * kernels: the cost before there is code. */
static qdot_status
choose_bordered_if_cheaper(qdot_plan *p, double tol, const qdot_ode_cost *kernels, double *least)
{
    qdot_ode_cost cost;
    qdot_work work;
    double steps;

    QDOT_TRY(qdot_bordered_make(p, tol, &p->bordered));
    if (!p->bordered)
        return QDOT_OK;
    QDOT_TRY(qdot_plan_make_motion(p));
    work = qdot_motion_series_work(p);
    cost = qdot_cost_bordered(&work, kernels);
    steps = qdot_cost_constrained_steps(p, &cost, tol);
    if (!(steps < *least)) {
        qdot_plan_drop_bordered(p);
        return QDOT_OK;
    }
    take_form(p, QDOT_FORM_BORDERED, &cost);
    qdot_plan_free(p->eliminated);
    p->eliminated = NULL;
    *least = steps;
    return QDOT_OK;
}

qdot_status
qdot_plan_choose_constrained(qdot_plan *p, const qdot_run_request *request)
{
    qdot_ode_cost own;
    double least;

    QDOT_TRY(measure_constrained_form(p));
    /* the eliminated and the bordered equations are too inexact for `digits`, and need M^-1, which massless coordinates lack */
    if (request->digits > 0 || p->n_massless > 0)
        return QDOT_OK;
    own = p->expansions;
    least = qdot_cost_constrained_steps(p, &own, request->tol);
    QDOT_TRY(choose_eliminated_if_cheaper(p, request->tol, &least));
    return choose_bordered_if_cheaper(p, request->tol, &own, &least);
}

/* --- Hamilton's equations for many digits ---------------------------------------------- */

qdot_status
qdot_plan_choose_canonical(qdot_plan *p, qdot_scene *scene)
{
    const double others =
        p->residual ? p->convolutions_residual : p->convolutions_derived;

    QDOT_TRY(qdot_canonical_new(scene, p, &p->canonical));
    if (p->canonical &&
        p->canonical->motion.program.convolutions > canonical_saves * others) {
        qdot_canonical_free(p->canonical);
        p->canonical = NULL;
    }
    return QDOT_OK;
}
