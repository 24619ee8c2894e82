/* tree-alone.c -- decides whether the equations along the tree suffice, so that M and f need not be derived. */
#include "sim/plan/tree-alone.h"

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "ode/leading.h"
#include "sim/form/derived.h"
#include "sim/form/motion-of-residual.h"
#include "sim/form/motion-series.h"
#include "sim/form/residual-adjoint.h"
#include "sim/form/residual-energy.h"
#include "sim/form/residual-tree.h"
#include "sim/form/tree-series.h"
#include "sim/model/sliding.h"
#include "sim/model/switch.h"
#include "sim/plan/cost.h"
#include "sim/plan/routh.h"
#include "tape/disc.h"

static bool
may_use_tree_alone(const qdot_plan *p, const qdot_scene *scene, const qdot_run_request *request)
{
    return p->mode && p->mode->atoms.n == 0 && !qdot_sliding_is(p->mode, p->side)
           && qdot_switches_are_many(scene) && p->n_states == 0
           && scene->constraints.n == 0 && request->digits == 0 && p->method->series
           && !qdot_plan_needs_jacobian(p)
           && (request->tol > QDOT_ODE_LEADING_TOL || (p->n >= QDOT_MANY_COORDINATES && qdot_switches_are_spatial(scene)));
}

/* Mark pairs of coordinates that M may couple: of one node, or of a node and one of its ancestors;
 * pattern [n x n]. */
static void
find_mass_pattern(const qdot_residual_tree *t, size_t n, bool *pattern)
{
    for (size_t node = 0; node < t->nodes; node++)
        for (size_t above = node;;) {
            size_t next = SIZE_MAX;

            for (size_t a = 0; a < t->unknowns[node]; a++)
                for (size_t b = 0; b < t->unknowns[above]; b++) {
                    const size_t i = t->coordinate[node * t->c + a];
                    const size_t j = t->coordinate[above * t->c + b];

                    pattern[i * n + j] = pattern[j * n + i] = true;
                }
            for (size_t e = above * t->m; e < (above + 1) * t->m; e++)
                if (t->parent[e] != UINT32_MAX)
                    next = t->parent[e] / t->m;
            if (next == SIZE_MAX)
                break;
            above = next;
        }
}

/* Find a lower bound of the computing cost of steps by M q'' = f, if M has `entries` entries off the diagonal. */
static double
least_cost_of_steps(size_t n, size_t entries)
{
    const qdot_ode_cost least = qdot_cost_least(n, (double)entries);

    return qdot_cost_steps(&least);
}

/* Whether M is constant: no partial derivative of a position depends on the motion. */
static bool
is_mass_matrix_constant(const qdot_plan *p)
{
    const qdot_residual *r = p->residual;

    for (size_t k = 0; k < r->n_slopes; k++) {
        const qdot_expr slope = qdot_diff(p->pool, r->difference[r->slopes[k].function],
                                          p->inputs[r->slopes[k].coordinate]);

        if (slope == QDOT_NIL || qdot_expr_node(p->pool, slope)->holds & QDOT_HAS_COORD)
            return false;
    }
    return true;
}

/* *suits: M is one coupled block, and no coordinate of it should be eliminated first. A coordinate
 * should be if it does not appear in h and is coupled with few others. */
static qdot_status
check_mass_structure(qdot_plan *p, const bool *pattern, bool *suits, double *least)
{
    const size_t n = p->n;
    size_t entries = 0;

    QDOT_TRY(qdot_structure_find(pattern, n, &p->structure));
    *suits = p->structure.blocks == 1 && !is_mass_matrix_constant(p);
    for (size_t i = 0; i < n; i++) {
        size_t coupled = 0;

        for (size_t j = 0; j < n; j++)
            coupled += j != i && pattern[i * n + j];
        entries += coupled;
        *suits = *suits && (coupled >= QDOT_ROUTH_COUPLED || !p->residual->absent[i]);
    }
    *least = least_cost_of_steps(n, entries);
    return QDOT_OK;
}

static qdot_status
find_mass_structure(qdot_plan *p, const qdot_residual_tree *tree, bool *suits, double *least)
{
    bool *pattern = qdot_calloc(p->n * p->n, sizeof *pattern);
    qdot_status status;

    *suits = false;
    if (!pattern)
        return QDOT_ENOMEM;
    find_mass_pattern(tree, p->n, pattern);
    status = check_mass_structure(p, pattern, suits, least);
    qdot_free(pattern);
    if (status != QDOT_OK || !*suits)
        return status;
    p->blocks = qdot_calloc(1, sizeof *p->blocks);
    if (!p->blocks)
        return QDOT_ENOMEM;
    *p->blocks = (qdot_plan_block){.n = p->n, .index = p->structure.index};
    return QDOT_OK;
}

static bool
tree_may_hide_forces(const qdot_residual *r)
{
    return qdot_disc_may_hide(r->places, QDOT_HIDES_EXPONENTIALS)
           || (r->forces && qdot_disc_may_hide(r->forces, QDOT_HIDES_EXPONENTIALS));
}

static qdot_status
decide_by_cost(qdot_plan *p, const qdot_residual_tree *tree, bool *taken)
{
    qdot_tree_series *series;
    qdot_work work;
    double least;

    *taken = false;
    QDOT_TRY(find_mass_structure(p, tree, taken, &least));
    if (!*taken)
        return QDOT_OK;
    QDOT_TRY(qdot_residual_programs(p->residual));
    QDOT_TRY(qdot_tree_series_new(p, p->residual, false, &series));
    *taken = series != NULL;
    if (!series)
        return QDOT_OK;
    work = qdot_tree_series_work(series);
    p->form = QDOT_FORM_TREE;
    p->tree_nodes = (size_t)work.nodes;
    p->tree_is_path = qdot_tree_series_is_path(series);
    p->convolutions_residual = qdot_tree_series_convolutions(series);
    p->expansions = qdot_cost_tree(&work);
    p->cost = qdot_cost_steps(&p->expansions);
    *taken = p->cost < least;
    qdot_tree_series_free(series);
    return QDOT_OK;
}

/* One block of all coordinates: which of them M couples is not asked. */
static qdot_status
make_one_block(qdot_plan *p)
{
    bool *pattern = qdot_malloc(p->n * p->n * sizeof *pattern);
    qdot_status status;

    if (!pattern)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < p->n * p->n; i++)
        pattern[i] = true;
    status = qdot_structure_find(pattern, p->n, &p->structure);
    qdot_free(pattern);
    p->blocks = qdot_calloc(1, sizeof *p->blocks);
    if (status != QDOT_OK || !p->blocks)
        return status == QDOT_OK ? QDOT_ENOMEM : status;
    *p->blocks = (qdot_plan_block){.n = p->n, .index = p->structure.index};
    return QDOT_OK;
}

/* Take the form without slopes for bodies that turn in space, if it applies. */
static qdot_status
take_adjoint(qdot_plan *p, qdot_scene *scene, bool *taken)
{
    qdot_residual *r;
    qdot_work work;

    QDOT_TRY(qdot_residual_adjoint_new(scene, p, &r));
    p->residual = r;
    if (!r || tree_may_hide_forces(r))
        return QDOT_OK;
    QDOT_TRY(qdot_residual_add_energy(scene, p, r));
    QDOT_TRY(make_one_block(p));
    QDOT_TRY(qdot_motion_of_residual(p, r, &r->motion));
    work = qdot_motion_series_work_of_residual(p, &r->motion, r->adjoint);
    p->form = QDOT_FORM_RESIDUAL;
    p->convolutions_residual = r->motion.program.convolutions;
    p->expansions = qdot_cost_implicit(&work);
    p->cost = qdot_cost_steps(&p->expansions);
    *taken = true;
    return QDOT_OK;
}

static void
drop_what_was_found(qdot_plan *p)
{
    qdot_residual_free(p->residual);
    p->residual = NULL;
    qdot_structure_clear(&p->structure);
    qdot_free(p->blocks);
    p->blocks = NULL;
    p->form = QDOT_FORM_NONE;
    p->tree_nodes = 0;
    p->convolutions_residual = 0;
}

static qdot_status
find_tree(qdot_plan *p, qdot_scene *scene, bool *taken)
{
    qdot_residual_tree *tree = NULL;
    qdot_status status;

    QDOT_TRY(qdot_residual_new(scene, p, &p->residual));
    if (!p->residual)
        return QDOT_OK;
    status = tree_may_hide_forces(p->residual) ? QDOT_OK : qdot_residual_tree_new(p->residual, p->n, &tree);
    if (tree)
        status = qdot_residual_add_energy(scene, p, p->residual);
    if (tree && status == QDOT_OK && p->residual->energy)
        status = decide_by_cost(p, tree, taken);
    qdot_residual_tree_free(tree);
    return status;
}

qdot_status
qdot_tree_alone_find(qdot_plan *p, qdot_scene *scene, const qdot_run_request *request)
{
    bool taken = false;
    qdot_status status;

    if (!may_use_tree_alone(p, scene, request))
        return QDOT_OK;
    status = qdot_switches_are_spatial(scene) ? take_adjoint(p, scene, &taken) : find_tree(p, scene, &taken);
    if (status == QDOT_OK && taken)
        p->smooth = true;
    else
        drop_what_was_found(p);
    return status;
}
