/* plan.c -- makes a run's plan: derives M and f, chooses the integration method and the form of equations. */
#include "sim/plan/plan.h"

#include <string.h>

#include "base/spelling.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/integrated.h"
#include "mech/scene/scene.h"
#include "ode/leading.h"
#include "series/program.h"
#include "sim/form/motion-of-constraints.h"
#include "sim/form/residual.h"
#include "sim/form/tables.h"
#include "sim/model/constraints.h"
#include "sim/model/delay.h"
#include "sim/model/massless.h"
#include "sim/model/parameter-states.h"
#include "sim/model/sliding.h"
#include "sim/model/switch.h"
#include "sim/plan/form.h"
#include "sim/plan/geometric.h"
#include "sim/plan/parts.h"
#include "sim/plan/routh.h"
#include "sim/plan/tree-alone.h"

/* The method that `auto` is, and where the equations switch and so have no series: see
 * ode/method.h for when each fits. */
static const char default_method[] = "taylor", switching_method[] = "rk8pd";

/* --- checking the scene, deriving M and f ------------------------------------------- */

qdot_status
qdot_plan_check(const qdot_scene *scene)
{
    if (scene->coordinates.n == 0) {
        qdot_fail(QDOT_EINVAL, "the scene has no coordinates");
        return qdot_hint("coord theta");
    }
    if (scene->lagrangian == QDOT_NIL && scene->particles.n == 0
        && scene->bodies.n == 0 && scene->states.n < scene->coordinates.n) {
        qdot_fail(QDOT_EINVAL, "the scene has no masses");
        return qdot_hint("particle bob mass m at (x, y)");
    }
    return qdot_scene_check_states(scene);
}

static qdot_status
find_method(qdot_plan *p, const char *name)
{
    qdot_text names = {0};
    qdot_spelling nearest;

    p->chosen = !name || strcmp(name, "auto") == 0;
    p->method = qdot_ode_method_find(p->chosen ? default_method : name);
    if (p->method)
        return QDOT_OK;
    qdot_spelling_begin(&nearest, name);
    for (size_t i = 0; i < qdot_ode_method_count(); i++) {
        qdot_text_format(&names, ", %s", qdot_ode_method_at(i)->name);
        qdot_spelling_offer(&nearest, qdot_ode_method_at(i)->name);
    }
    qdot_fail(QDOT_ENAME, "there is no method %.100s", name);
    if (nearest.best != NULL)
        qdot_hint("did you mean `%s`?", nearest.best);
    else
        qdot_hint("auto%s", qdot_text_str(&names));
    qdot_text_clear(&names);
    return QDOT_ENAME;
}

static qdot_status
copy_values(qdot_plan *p, const qdot_run_request *request)
{
    size_t n = request->n_values;

    p->symbols = qdot_calloc(n + 1, sizeof *p->symbols);
    p->values = qdot_calloc(n + 1, sizeof *p->values);
    if (!p->symbols || !p->values)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        p->symbols[i] = request->symbols[i];
        p->values[i] = request->values[i];
    }
    p->n_values = n;
    return QDOT_OK;
}

/* For a constraint used as mu f = 0: its multiplier lambda' becomes an input, and lambda = mu lambda'. */
static qdot_status
name_multiplier(qdot_plan *p, qdot_scene *scene, size_t k)
{
    const qdot_expr lambda = scene->constraints.at[k].multiplier;
    qdot_text name = {0};
    qdot_expr mu, own;

    p->multipliers[k] = p->scaled[k] = lambda;
    if (qdot_integrated_rate(scene, k, &mu) == QDOT_NIL || mu == QDOT_ONE)
        return qdot_pool_check(p->pool);
    qdot_text_format(&name, "%s'", qdot_expr_symbol(p->pool, lambda)->name);
    QDOT_TRY(qdot_text_status(&name));
    own = qdot_symbol_get(p->pool, QDOT_MULTIPLIER, qdot_text_str(&name));
    qdot_text_clear(&name);
    p->scaled[k] = qdot_mul(p->pool, qdot_plan_substitute(p, mu), own);
    p->inputs[3 * p->n + 1 + k] = own;
    p->rescaled = true;
    return qdot_pool_check(p->pool);
}

static qdot_status
name_coordinates(qdot_plan *p, qdot_scene *scene, const qdot_run_request *request)
{
    size_t n = p->n, m = scene->constraints.n;

    const size_t own = p->mode ? qdot_switches_own(p->mode) : 0;

    p->n_sides = p->mode ? own + p->mode->n_puck_symbols : 0;
    p->inputs = qdot_calloc(3 * n + 1 + m + p->n_sides, sizeof *p->inputs);
    p->names = qdot_calloc(n, sizeof *p->names);
    p->multipliers = qdot_calloc(m + 1, sizeof *p->multipliers);
    p->scaled = qdot_calloc(m + 1, sizeof *p->scaled);
    if (!p->inputs || !p->names || !p->multipliers || !p->scaled)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        qdot_expr q = qdot_parameter_states_coordinate(scene, request, i);

        p->inputs[i] = q;
        p->inputs[n + i] = qdot_symbol_jet(p->pool, q, 1);
        p->inputs[2 * n + 1 + i] = qdot_symbol_jet(p->pool, q, 2);
        p->names[i] = qdot_strdup(qdot_expr_symbol(p->pool, q)->name);
        if (!p->names[i])
            return QDOT_ENOMEM;
    }
    p->inputs[2 * n] = QDOT_T;
    for (size_t k = 0; k < m; k++) {
        p->inputs[3 * n + 1 + k] = scene->constraints.at[k].multiplier;
        QDOT_TRY(name_multiplier(p, scene, k));
    }
    for (size_t i = 0; i < own; i++)
        p->inputs[3 * n + 1 + m + i] = p->mode->surfaces.at[i].side;
    for (size_t i = 0; p->mode && i < p->mode->pucks.n; i++) {
        const qdot_puck *puck = &p->mode->pucks.at[i];
        qdot_expr *in = p->inputs + 3 * n + 1 + m + own + puck->first;

        memcpy(in, puck->share, puck->k * sizeof *in);
        in[puck->k] = puck->inverse;
    }
    return qdot_pool_check(p->pool);
}

/* Derive M and f of M q'' = f for the scene, with parameter values inserted. */
static qdot_status
derive_equations(qdot_plan *p, qdot_scene *scene)
{
    const size_t n = p->n, m = n - p->n_states;
    qdot_expr M = qdot_mech_numeric_mass(scene), f = qdot_mech_numeric_forcing(scene);

    p->M = qdot_calloc(n * n, sizeof *p->M);
    p->f = qdot_calloc(n, sizeof *p->f);
    if (!p->M || !p->f)
        return QDOT_ENOMEM;
    if (M != QDOT_NIL && f != QDOT_NIL) {
        M = qdot_plan_substitute(p, M);
        f = qdot_plan_substitute(p, f);
    }
    QDOT_TRY(qdot_pool_check(p->pool));
    for (size_t i = 0; i < n; i++) {
        p->f[i] = i < m ? qdot_expr_arg(p->pool, f, (uint32_t)i) : QDOT_ZERO;
        for (size_t j = 0; j < n; j++)
            p->M[i * n + j] = i < m && j < m
                                  ? qdot_expr_arg(p->pool, M, (uint32_t)(i * m + j))
                              : i == j ? QDOT_ONE
                                       : QDOT_ZERO;
    }
    if (p->mode)
        QDOT_TRY(qdot_sliding_freeze(p, scene));
    p->indefinite = scene->lagrangian != QDOT_NIL;
    for (size_t i = 0; i < scene->potentials.n; i++)
        if (qdot_expr_node(p->pool, scene->potentials.at[i].e)->holds & QDOT_HAS_VELOCITY)
            p->indefinite = true;
    return QDOT_OK;
}

/* --- Taylor series and constraints -------------------------------------------------- */

/* Refuse the method of Taylor series if the equations switch. */
static qdot_status
check_series_possible(qdot_plan *p, const char *hindrance)
{
    p->smooth = !hindrance;
    if (!p->method->series || p->smooth)
        return QDOT_OK;
    if (p->chosen) {
        p->method = qdot_ode_method_find(switching_method);
        return QDOT_OK;
    }
    qdot_fail(QDOT_ENOTBUILT, "not built yet: method %s where the equations switch (%s)",
              p->method->name, hindrance);
    return qdot_hint("method rk8pd");
}

/* Fill the constraints of the plan (sim/model/constraints.h). */
static qdot_status
make_constraints(qdot_plan *p, qdot_scene *scene, const qdot_run_request *request)
{
    const char *hindrance;

    QDOT_TRY(qdot_constraints_new(scene, p, &p->constraints));
    p->m = p->constraints->m - p->n_massless;
    p->tape = p->constraints->equations;
    p->constraints->equations = NULL;
    p->treatment = request->treatment;
    hindrance = qdot_program_hindrance(p->tape);
    if (!hindrance)
        hindrance = qdot_program_hindrance(p->constraints->positions);
    QDOT_TRY(check_series_possible(p, hindrance));
    /* a multistep method cannot continue from a state that a projection has moved */
    if (p->method->multistep && p->treatment == QDOT_RUN_PROJECT)
        p->treatment = QDOT_RUN_BAUMGARTE;
    if (!p->smooth)
        return QDOT_OK;
    QDOT_TRY(qdot_motion_of_constraints(p));
    return request->lanes ? qdot_plan_make_lanes(p) : qdot_plan_choose_constrained(p, request);
}

/* Refuse ensembles with an uncertain start, as companion runs of their members start at exact values. */
static qdot_status
check_start_is_exact(const qdot_run_request *request)
{
    return request->lanes && request->apart != NULL
               ? qdot_fail(QDOT_ENOTBUILT, "not built yet: ensembles from a start with an error")
               : QDOT_OK;
}

/* Refuse coordinates without mass where ensembles, the method or `digits` cannot treat them. `digits` takes first-order states
 * through events and switches, but no other coordinate without mass. */
static qdot_status
check_massless(const qdot_plan *p, const qdot_scene *scene, const qdot_run_request *request)
{
    const bool jumps = p->n_sides > 0 || p->n_states > 0 || scene->events.n > 0, digits = request->digits > 0;

    if (p->n_massless == 0 || (!(digits && jumps) && !request->lanes && !p->method->geometric))
        return QDOT_OK;
    for (size_t i = 0; i < scene->coordinates.n; i++) {
        if (!p->massless[i] || (digits && qdot_scene_state_of(scene, scene->coordinates.at[i]) != NULL))
            continue;
        qdot_fail(QDOT_ENOTBUILT, "not built yet: %s where no mass moves with a coordinate (%s)",
                  digits           ? "digits with events or switches"
                  : request->lanes ? "ensembles"
                                   : p->method->name,
                  p->names[i]);
        return qdot_hint("method taylor, radau, dop853");
    }
    return QDOT_OK;
}

/* Find whether the equations, in the tapes that the plan has so far, read a coordinate at an earlier time; refuse then what
 * is not built for delays. */
static qdot_status
check_delays(qdot_plan *p, const qdot_scene *scene, const qdot_run_request *request)
{
    const qdot_tape *tapes[QDOT_PLAN_TAPES];
    const char *what = NULL;
    qdot_knots knots = {0};
    qdot_status status = QDOT_OK;

    qdot_plan_tapes(p, tapes);
    p->delayed = qdot_scene_has_delays(scene);
    for (size_t k = 0; k < QDOT_PLAN_TAPES; k++)
        p->delayed |= qdot_delay_reads(tapes[k]);
    if (!p->delayed)
        return QDOT_OK;
    if (request->digits > 0)
        what = "digits";
    else if (request->lanes)
        what = "ensembles";
    else if (!p->smooth)
        what = "equations that switch";
    if (what)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: delays with %s", what);
    if (!p->method->series) {
        qdot_fail(QDOT_ENOTBUILT, "not built yet: delays by method %s", p->method->name);
        return qdot_hint("method taylor");
    }
    p->leading = false;
    for (size_t k = 0; k < QDOT_PLAN_TAPES && status == QDOT_OK; k++)
        if (tapes[k])
            status = qdot_delay_find_knots(tapes[k], 2 * p->n, &knots);
    qdot_free(knots.at);
    return status;
}

/* --- plans of ensembles and runs ---------------------------------------------------- */

/* Whether M couples coordinates and need not be positive definite. */
static bool
is_indefinite(const qdot_plan *p)
{
    bool coupled = false;

    for (size_t b = 0; b < p->structure.blocks; b++)
        coupled |= p->blocks[b].n > 1;
    return coupled && p->indefinite;
}

/* Momenta that are kept, where lanes can do that: with none whose velocities may cancel, of which a
 * plan without a start does not know; else d'Alembert's residual, or M q'' = f. */
static qdot_status
choose_for_lanes(qdot_plan *p, qdot_scene *scene, const qdot_run_request *request)
{
    if (p->n_states == 0)
        QDOT_TRY(qdot_routh_reduce(p, scene, request));
    if (p->reduced && !p->reduced->subtracts && !is_indefinite(p->reduced))
        return qdot_plan_make_lanes(p->reduced);
    qdot_plan_free(p->reduced);
    p->reduced = NULL;
    if (p->residual)
        return qdot_plan_make_lanes(p);
    if (is_indefinite(p))
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: ensembles of a stated Lagrangian whose coordinates "
                         "couple");
    QDOT_TRY(qdot_plan_lower_for_series(p));
    return qdot_plan_make_lanes(p);
}

static qdot_status
make_plan(qdot_plan *p, qdot_scene *scene, const qdot_run_request *request)
{
    QDOT_TRY(find_method(p, request->method));
    QDOT_TRY(copy_values(p, request));
    QDOT_TRY(name_coordinates(p, scene, request));
    QDOT_TRY(qdot_tree_alone_find(p, scene, request));
    if (p->residual)
        return check_delays(p, scene, request);
    QDOT_TRY(derive_equations(p, scene));
    QDOT_TRY(qdot_massless_find(scene, p));
    QDOT_TRY(check_massless(p, scene, request));
    QDOT_TRY(check_start_is_exact(request));
    QDOT_TRY(qdot_plan_check_geometric(p, scene, request->treatment));
    if (scene->constraints.n + p->n_massless > 0) {
        QDOT_TRY(make_constraints(p, scene, request));
        return check_delays(p, scene, request);
    }
    QDOT_TRY(qdot_plan_structure(p, NULL));
    QDOT_TRY(qdot_plan_lower(p, 2 * p->n + 1, 0, NULL));
    QDOT_TRY(check_series_possible(p, qdot_program_hindrance(p->tape)));
    p->leading = p->smooth && p->method->series && request->tol <= QDOT_ODE_LEADING_TOL;
    if (p->smooth)
        QDOT_TRY(qdot_plan_choose_form(p, scene, request));
    QDOT_TRY(check_delays(p, scene, request));
    if (p->delayed)
        return QDOT_OK;
    if (request->digits > 0)
        return qdot_plan_choose_canonical(p, scene);
    if (request->lanes)
        return choose_for_lanes(p, scene, request);
    if (qdot_plan_needs_jacobian(p) || p->share || p->method->geometric)
        return QDOT_OK;
    QDOT_TRY(qdot_routh_reduce(p, scene, request));
    /* if events set parameters, which affect all equations, do not divide these */
    return p->n_states > 0 ? QDOT_OK : qdot_parts_find(p, scene, request);
}

qdot_status
qdot_plan_new(qdot_scene *scene, const qdot_run_request *request, qdot_plan **plan)
{
    return qdot_plan_in_mode(scene, request, NULL, NULL, plan);
}

qdot_status
qdot_plan_in_mode(qdot_scene *scene, const qdot_run_request *request,
                  const qdot_switches *switches, const int64_t *side, qdot_plan **plan)
{
    qdot_plan *p;
    qdot_status status;

    *plan = NULL;
    QDOT_TRY(qdot_plan_check(scene));
    p = qdot_calloc(1, sizeof *p);
    if (!p)
        return QDOT_ENOMEM;
    p->pool = scene->pool;
    p->n = qdot_parameter_states_coordinates(scene, request);
    p->n_states = request->n_states;
    p->mode = switches;
    p->side = side;
    status = make_plan(p, scene, request);
    p->mode = NULL;
    p->side = NULL;
    if (status != QDOT_OK) {
        qdot_plan_free(p);
        p = NULL;
    }
    *plan = p;
    return status;
}
