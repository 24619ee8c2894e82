/* describe.c -- prints a plan in words, for the statement `plan`. */
#include "expr/print.h"
#include "expr/symbol.h"
#include "ode/companion.h"
#include "ode/taylor.h"
#include "ode/written.h"
#include "sim/bind/bind.h"
#include "sim/course/stage.h"
#include "sim/form/derived.h"
#include "sim/form/eliminated.h"
#include "sim/form/residual.h"
#include "sim/model/constraints.h"
#include "sim/run/run.h"

/* The plan that is integrated: the reduced plan if there is one, otherwise p. */
static const qdot_plan *
integrated_plan(const qdot_plan *p)
{
    return p->reduced ? p->reduced : p;
}

/* List the coordinates whose momenta are conserved, in the description of a plan. */
static void
describe_kept_momenta(const qdot_plan *r, qdot_text *out)
{
    const bool one = r->n_kept == 1;

    qdot_text_add(out, "cyclic:");
    for (size_t k = 0; k < r->n_kept; k++)
        qdot_text_format(out, "%s %s", k ? "," : "", r->names[r->kept[k]]);
    qdot_text_format(out, ": %s and %s; %s\n",
                     one ? "its momentum is kept" : "their momenta are kept",
                     one ? "gives its velocity" : "give their velocities",
                     one ? "a quadrature, without an equation of its own"
                         : "quadratures, without equations of their own");
}

static void
describe_mass_matrix(const qdot_plan *p, qdot_text *out)
{
    const char *when = p->method->series ? "once a step" : "at every evaluation";
    const size_t n = p->n - p->n_kept - p->n_states; /* do not count parameters, each of which is a block of its own */
    const size_t blocks = p->structure.blocks - p->n_states;
    size_t single = 0, constant = 0, largest = 0;

    for (size_t k = 0; k < p->structure.blocks; k++) {
        single += p->blocks[k].n == 1;
        constant += p->blocks[k].constant;
        if (p->blocks[k].n > largest)
            largest = p->blocks[k].n;
    }
    if (p->n_kept > 0)
        describe_kept_momenta(p, out);
    if (blocks == 0)
        return;
    single -= p->n_states;
    qdot_text_format(out, "mass matrix%s: %zu x %zu, ",
                     p->n_kept > 0 ? " of the others" : "", n, n);
    if (single == blocks) {
        qdot_text_add(out, "diagonal: the accelerations are divisions, nothing is "
                           "factored\n");
        return;
    }
    if (blocks == 1)
        qdot_text_add(out, "full");
    else
        qdot_text_format(out, "%zu blocks that do not couple, the largest %zu x %zu",
                         blocks, largest, largest);
    if (p->tree_nodes > 0 && p->method->series) {
        qdot_text_format(out, "; not formed: eliminated once a step along a %s of %zu, %s\n",
                         p->tree_is_path ? "chain" : "tree", p->tree_nodes,
                         p->tree_is_path ? "eight pieces at once" : "from its leaves");
        return;
    }
    qdot_text_format(out, "; %s",
                     p->indefinite ? "LDL^T, it may be indefinite" : "Cholesky");
    if (constant + single == blocks)
        qdot_text_add(out, "; constant: factored once\n");
    else if (constant > 0)
        qdot_text_format(out,
                         "; %zu of the blocks constant and factored once, the others %s\n",
                         constant, when);
    else
        qdot_text_format(out, "; factored %s\n", when);
}

static void
describe_time_dependence(const qdot_plan *p, qdot_text *out)
{
    qdot_text_format(out, "time: %s in the equations\n",
                     qdot_plan_is_driven(p) ? "occurs" : "does not occur");
}

/* Describe the constraints, how they are solved, and how the state is kept on them. */
static void
describe_constraints(const qdot_plan *p, qdot_text *out)
{
    static const char *const kinds[] = {"holonomic", "of velocities", "of accelerations"};
    static const char *const treatments[] = {
        [QDOT_RUN_PROJECT] =
            ("projection of positions and velocities in the metric of M, "
             "after steps that end further from them than rounding"),
        [QDOT_RUN_BAUMGARTE] = "Baumgarte's damping, 5 per unit of time",
        [QDOT_RUN_NONE] = "none",
    };
    const qdot_constraints *c = p->constraints;
    const char *before = "";

    qdot_text_format(out, "mass matrix: %zu x %zu, %zu entries in its lower triangle\n",
                     p->n - p->n_states, p->n - p->n_states, c->n_masses - p->n_states);
    qdot_text_format(out, "constraints: %zu:", c->m);
    for (int kind = 0; kind < 3; kind++)
        if (c->count[kind] > 0) {
            qdot_text_format(out, "%s %zu %s", before, c->count[kind], kinds[kind]);
            before = ",";
        }
    qdot_text_format(out,
                     "; [M A^T; A 0] (q'', -lambda) = (f, gamma), %zu entries in A; by its "
                     "pattern, or by the null space of A, pivoted QR; "
                     "residual-corrected\n",
                     c->n_slopes);
    qdot_text_format(out, "drift: %s\n", treatments[p->treatment]);
    if (p->n_massless == 0)
        return;
    qdot_text_add(out, "without mass:");
    for (size_t i = 0, said = 0; i < p->n; i++)
        if (p->massless[i])
            qdot_text_format(out, "%s %s", said++ > 0 ? "," : "", p->names[i]);
    qdot_text_add(out, "; their equations are treated as constraints\n");
}

static void
describe_blocks(const qdot_plan *p, qdot_text *out)
{
    const size_t blocks = p->structure.blocks - p->n_states;

    if (blocks <= 1 || blocks == p->n - p->n_kept - p->n_states)
        return;
    for (size_t k = 0; k < p->structure.blocks; k++) {
        if (p->blocks[k].index[0] >= p->n - p->n_states)
            continue;
        qdot_text_add(out, "  block:");
        for (size_t i = 0; i < p->blocks[k].n; i++)
            qdot_text_format(out, "%s %s", i ? "," : "", p->names[p->blocks[k].index[i]]);
        qdot_text_char(out, '\n');
    }
}

/* Describe the machine code that expands the motion to order p, in a run with tolerance tol. */
static qdot_status
describe_machine_code(qdot_bind *bind, double tol, int p, qdot_text *out)
{
    const qdot_ode_system system = qdot_bind_system(bind);
    const qdot_ode_series *series = system.series;

    if (series->prepare)
        QDOT_TRY(series->prepare(p, series->user));
    if (series->code.write) {
        qdot_ode_written written = qdot_ode_written_begin(
            series, p, qdot_ode_taylor_highest(&system, tol, system.leading, 0), 0);

        QDOT_TRY(qdot_ode_written_now(&written));
    }
    qdot_bind_tell_code(bind, out);
    return QDOT_OK;
}

/* Describe the Taylor series of a plan: the order, the form of the equations, the cost of an order. */
static qdot_status
describe_series(const qdot_plan *p, double tol, qdot_text *out)
{
    qdot_bind *bind;
    qdot_ode_system system;
    qdot_status status;
    int order;

    if (!p->method->series)
        return QDOT_OK;
    QDOT_TRY(qdot_bind_new(p, false, &bind));
    system = qdot_bind_system(bind);
    order = qdot_ode_taylor_order(system.series, tol, system.leading, 0);
    qdot_text_format(out, "order: %d, chosen by the cost of an expansion at tol %g\n", order, tol);

    qdot_text_add(out, "recurrences: ");
    status = describe_machine_code(bind, tol, order, out);
    qdot_text_char(out, '\n');
    if (system.leading)
        qdot_text_add(out, "rounding: state, parameters and the first orders as sums of two "
                           "doubles, where nothing divides the run\n");
    qdot_bind_free(bind);
    QDOT_TRY(status);
    if (p->eliminated)
        qdot_text_format(out,
                         "form: multipliers eliminated beforehand, %g convolutions an order; "
                         "where constraints come near each other, and under tolerances below "
                         "%g, the same matrix at every order\n",
                         p->eliminated->convolutions_derived, QDOT_ELIMINATED_TOL);
    else if (p->bordered)
        qdot_text_format(out,
                         "form: multipliers solved for beside the accelerations at every "
                         "order, inside the code; before it is written, where constraints "
                         "come near each other, and under tolerances below %g, constraints "
                         "by their own coefficients, %g convolutions an order\n",
                         QDOT_ELIMINATED_TOL, p->convolutions_derived);
    else if (p->constraints)
        qdot_text_format(out,
                         "form: the same matrix at every order, %g convolutions an order; "
                         "constraints by their own coefficients, nothing differentiated; "
                         "factored once a step\n",
                         p->convolutions_derived);
    else if (p->reduced)
        qdot_text_format(
            out,
            "form: M q'' = f of what is not cyclic, %g convolutions an order; of all "
            "coordinates it would take %g\n",
            p->reduced->convolutions_derived,
            p->residual ? p->convolutions_residual : p->convolutions_derived);
    else if (p->residual && !p->M)
        qdot_text_format(out,
                         "form: d'Alembert's residual, %g convolutions an order; M and f, of "
                         "which every pair of coordinates is an entry, are not derived\n",
                         p->convolutions_residual);
    else if (p->residual)
        qdot_text_format(
            out,
            "form: d'Alembert's residual, %g convolutions an order; M q'' = f "
            "would take %g\n",
            p->convolutions_residual, p->convolutions_derived);
    else if (p->convolutions_residual > 0)
        qdot_text_format(
            out,
            "form: M q'' = f, %g convolutions an order; d'Alembert's residual "
            "would take %g and more beside them\n",
            p->convolutions_derived, p->convolutions_residual);
    else
        qdot_text_format(out, "form: M q'' = f, %g convolutions an order\n",
                         p->convolutions_derived);
    return QDOT_OK;
}

static void
list_coordinate_names(const qdot_plan *p, qdot_text *out)
{
    for (size_t i = 0; i < p->n; i++)
        qdot_text_format(out, "%s %s", i ? "," : "", p->names[i]);
}

/* List the events, domains and switches that are searched for in every step. */
static void
describe_watched_functions(const qdot_stage *s, const qdot_plan *p, qdot_text *out)
{
    size_t found = 0;

    for (size_t i = 0; i < s->events.n; i++)
        qdot_text_format(out, "%s%s", found++ ? ", " : "events ", s->events.at[i].name);
    for (size_t i = 0; i < s->domains.n; i++)
        qdot_text_format(out, "%s%s", i ? ", " : found ? " and bounds of " : "bounds of ",
                         p->names[s->domains.at[i].coordinate]);
    found += s->domains.n;
    if (qdot_switches_own(&s->switches) > 0)
        qdot_text_format(out, "%sswitches", found ? " and " : "");
}

/* Describe the groups of decoupled coordinates that are integrated separately, or would be without events. */
static qdot_status
describe_parts(const qdot_stage *s, const qdot_plan *p, double tol, qdot_text *out)
{
    if (s->modes.at[0]->m > 0) {
        qdot_text_add(out, "decoupled parts, integrated together, as each step is searched for ");
        describe_watched_functions(s, p, out);
        qdot_text_char(out, ':');
        for (size_t k = 0; k < p->n_parts; k++) {
            qdot_text_add(out, k ? ";" : "");
            list_coordinate_names(p->parts[k], out);
        }
        qdot_text_char(out, '\n');
        return describe_series(p, tol, out);
    }
    qdot_text_add(out, "decoupled parts, each with its own steps:\n");
    for (size_t k = 0; k < p->n_parts; k++) {
        const qdot_plan *r = integrated_plan(p->parts[k]);

        qdot_text_add(out, " ");
        list_coordinate_names(p->parts[k], out);
        if (p->method->series) {
            qdot_ode_system system;
            qdot_bind *bind;
            qdot_status status;
            int order;

            QDOT_TRY(qdot_bind_new(p->parts[k], false, &bind));
            system = qdot_bind_system(bind);
            order = qdot_ode_taylor_order(system.series, tol, system.leading, 0);
            qdot_text_format(out, ": order %d, %g convolutions an order; ", order,
                             r->convolutions_derived);
            status = describe_machine_code(bind, tol, order, out);
            if (system.leading)
                qdot_text_add(out, "; first orders as sums of two doubles");
            qdot_bind_free(bind);
            QDOT_TRY(status);
        }
        if (r->n_kept > 0) {
            qdot_text_add(out, "; ");
            describe_kept_momenta(r, out);
        } else {
            qdot_text_char(out, '\n');
        }
    }
    return QDOT_OK;
}

/* List the surfaces at which the equations switch, and other reasons to divide the run. */
static qdot_status
describe_switches(const qdot_stage *s, qdot_text *out)
{
    for (size_t i = 0; i < qdot_switches_own(&s->switches); i++) {
        qdot_text_add(out, i ? ", " : "switches: located, a plan for each side; at ");
        if (s->switches.surfaces.at[i].steps)
            qdot_text_add(out, "whole ");
        QDOT_TRY(qdot_print(s->switches.pool, s->switches.surfaces.at[i].u, QDOT_PLAIN,
                            out));
        qdot_text_add(out, s->switches.surfaces.at[i].steps ? "" : " = 0");
    }
    qdot_text_add(out, qdot_switches_own(&s->switches) ? "\n" : "");
    for (size_t i = 0; i < s->events.n; i++)
        qdot_text_format(out, "%s%s", i ? ", " : "events: ", s->events.at[i].name);
    qdot_text_add(out, s->events.n ? "\n" : "");
    return QDOT_OK;
}

/* List the components of the state of a run: coordinates, and parameters that events set. */
static void
describe_coordinates(const qdot_plan *p, qdot_text *out)
{
    const size_t n = p->n - p->n_states;

    qdot_text_format(out, "coordinates: %zu:", n);
    for (size_t i = 0; i < p->n; i++) {
        if (i == n)
            qdot_text_add(out, "\nparameters that events set:");
        qdot_text_format(out, "%s %s", i != 0 && i != n ? "," : "", p->names[i]);
    }
}

static qdot_status
describe_plan(qdot_scene *scene, const qdot_run_request *request, qdot_text *out)
{
    qdot_stage stage = {0};
    qdot_status status = qdot_stage_begin(&stage, scene, request);
    const qdot_plan *p = status == QDOT_OK ? stage.modes.at[0]->plan : NULL;
    size_t operations, calls;

    if (!p) {
        qdot_stage_clear(&stage);
        return status;
    }
    describe_coordinates(p, out);
    qdot_text_add(out, p->constraints
                           ? "\nequations: M q'' = f + A^T lambda with the constraints, as "
                             "y = (q, q')\n"
                           : "\nequations: M(q, t) q'' = f(q, q', t), as y = (q, q')\n");
    if (p->constraints) {
        describe_constraints(p, out);
    } else {
        describe_mass_matrix(integrated_plan(p), out);
        describe_blocks(integrated_plan(p), out);
    }
    describe_time_dependence(p, out);
    operations = qdot_plan_operations(p, &calls);
    qdot_text_format(out,
                     "tape: %zu operations for %s, of them %zu call%s of elementary "
                     "functions\n",
                     operations, p->M ? "M and f" : "places, their slopes and forces", calls,
                     calls == 1 ? "" : "s");
    if (p->method->needs_jacobian)
        qdot_text_add(out, "jacobian: exact, by forward derivatives of the tape\n");
    qdot_text_format(out, "method: %s, %s: %s\n", p->method->name,
                     p->chosen ? "chosen" : "asked for", p->method->fits);
    if (p->n_parts > 0)
        status = describe_parts(&stage, p, request->tol, out);
    else
        status = describe_series(p, request->tol, out);
    qdot_text_format(out,
                     "error: two further runs by %s, at a tighter tolerance, on threads of "
                     "their own\n",
                     p->smooth && qdot_companion_is_by_series(p->method) ? "taylor"
                     : p->method->stiff                                  ? "radau"
                                                                         : p->method->partner);
    if (status == QDOT_OK)
        status = describe_switches(&stage, out);
    qdot_stage_clear(&stage);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}

qdot_status
qdot_run_plan(qdot_scene *scene, const qdot_run_request *request, qdot_text *out)
{
    qdot_parameter_states states = {0};
    qdot_status status;

    QDOT_TRY(qdot_parameter_states_init(&states, scene, request));
    status = describe_plan(scene, &states.request, out);
    qdot_parameter_states_clear(&states);
    return status;
}
