/* export-scene.c -- describes the motion of a scene for export: its equations as tapes (lists of operations) with common
 * inputs. */
#include "lang/declare/export-scene.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/declare/export-given.h"
#include "lang/declare/export-massless.h"
#include "lang/declare/export-start.h"
#include "lang/session/bind.h"
#include "lang/session/values.h"
#include "sim/model/switch.h"

enum {
    LONGEST = 80, /* longest text of a switching surface, in bytes */
    MOST_OPERATIONS = 200000,
    MOST_SLOPES = 24 /* largest number of coordinates for which the Jacobian is exported */
};

typedef qdot_vec(qdot_expr) expressions;
typedef qdot_vec(qdot_export_name) names;

/* The data collected while a scene is exported. */
typedef struct {
    qdot_session *session;
    qdot_scene *scene;
    qdot_export_system x;
    expressions inputs, parameters;
    qdot_switches switches;
    qdot_given_functions given; /* undefined functions to which the user has given a value */
    expressions held; /* [m] constraints as left - right, on the present sides of switches */
    expressions equations, slopes, velocities, energy, positions, events, u;
    qdot_vec(qdot_event) acts; /* the events with the quantities that they set and the new values */
    qdot_vec(expressions) effects; /* these new values as exported expressions */
    qdot_vec(int) orders;
    qdot_vec(qdot_export_surface) surface;
    qdot_vec(char *) texts; /* texts of the switching surfaces and of the ends of domains */
    names q, lambda, values;
    qdot_vec(double) start;
    bool massless; /* a massless coordinate exists that is no state: its start velocity may follow from its equation */
    qdot_vec(qdot_export_event) event;
    qdot_vec(size_t) targets; /* the symbols that all events set */
} description;

/* --- expressions to be exported --------------------------------------------------------- */

static qdot_status
append_bound_expression(description *d, expressions *to, qdot_expr e)
{
    e = qdot_export_bound(d->session, qdot_scene_with_rates(d->scene, e));
    QDOT_TRY(qdot_pool_check(d->session->pool));
    return qdot_vec_push(to, e);
}

/* Append the expression e with each switch, such as sign(u), replaced by a symbol for its present side. What reads the rate
 * of a first-order state reads its right side, which may jump. */
static qdot_status
append_without_switches(description *d, expressions *to, qdot_expr e)
{
    qdot_expr frozen;

    e = qdot_export_bound(d->session, qdot_scene_with_rates(d->scene, e));
    QDOT_TRY(qdot_pool_check(d->session->pool));
    QDOT_TRY(qdot_switches_freeze(&d->switches, NULL, NULL, 1, &e, &frozen));
    return qdot_vec_push(to, frozen);
}

/* Store a text until the description is cleared. On failure the text is cleared. */
static qdot_status
store_text(description *d, qdot_text *text)
{
    qdot_status status = qdot_text_status(text);

    if (status == QDOT_OK)
        status = qdot_vec_push(&d->texts, text->at);
    if (status != QDOT_OK)
        qdot_text_clear(text);
    return status;
}

static const char *
get_symbol_name(const qdot_session *s, qdot_expr symbol)
{
    return qdot_expr_symbol(s->pool, symbol)->name;
}

static qdot_expr
derivative_of_coordinate(const description *d, size_t i, unsigned order)
{
    return qdot_symbol_jet(d->session->pool, d->scene->coordinates.at[i], order);
}

/* Export u for each switching surface u = 0, then the terms of T - V that switch there. */
static qdot_status
export_switches(description *d)
{
    const qdot_run_request request = {
        .n_values = d->given.heads.n,
        .symbols = d->given.heads.at,
        .values = d->given.bodies.at};
    qdot_pool *pool = d->session->pool;

    QDOT_TRY(qdot_switches_find(d->scene, &request, &d->switches));
    d->x.s = d->switches.surfaces.n;
    for (size_t i = 0; i < d->x.s; i++) {
        const qdot_surface *from = &d->switches.surfaces.at[i];
        const unsigned holds = qdot_expr_node(pool, from->u)->holds;
        qdot_text text = {0};

        if (holds & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
            return qdot_fail(QDOT_EINVAL, "the equations switch by an acceleration or a multiplier, "
                                          "which cannot be exported");
        QDOT_TRY(append_without_switches(d, &d->u, from->u));
        QDOT_TRY(qdot_print(pool, from->u, QDOT_PLAIN, &text));
        qdot_text_truncate(&text, text.n < LONGEST ? text.n : LONGEST);
        qdot_text_add(&text, from->steps ? " is an integer" : " = 0");
        QDOT_TRY(store_text(d, &text));
        QDOT_TRY(qdot_vec_push(
            &d->surface,
            ((qdot_export_surface){text.at, from->steps,
                                   (holds & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY)) != 0})));
    }
    if (d->switches.level != QDOT_NIL)
        QDOT_TRY(append_without_switches(d, &d->u, d->switches.level));
    d->x.surface = d->surface.at;
    d->x.switches.blocks = 2;
    d->x.switches.block[0] = (qdot_export_block){"u", d->x.s, 0};
    d->x.switches.block[1] = (qdot_export_block){"level", d->u.n - d->x.s, 0};
    return QDOT_OK;
}

/* Export the constraint functions, which must be 0, and how often each is differentiated until it contains q''. */
static qdot_status
export_constraints(description *d)
{
    static const int orders[] = {
        [QDOT_HOLONOMIC] = 2, [QDOT_VELOCITY] = 1, [QDOT_ACCELERATION] = 0};
    qdot_dof dof;

    for (size_t k = 0; k < d->x.m; k++) {
        QDOT_TRY(append_without_switches(d, &d->held, d->scene->constraints.at[k].f));
        QDOT_TRY(qdot_vec_push(&d->orders, orders[d->scene->constraints.at[k].kind]));
    }
    d->x.orders = d->orders.at;
    if (d->x.m == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_mech_dof(d->scene, &dof));
    for (size_t k = 0; k < dof.constraints; k++)
        if (!dof.is_independent[k]) {
            (void)qdot_fail(QDOT_EINVAL,
                            "constraint %.100s is not independent of those before it, as those of "
                            "an exported scene have to be", d->scene->constraints.at[k].name);
            return qdot_hint("dof tells which constraints follow from others: remove them");
        }
    return QDOT_OK;
}

/* Constraint k = 0, differentiated in time until it is linear in q''. */
static qdot_expr
constraint_on_accelerations(const description *d, size_t k)
{
    qdot_expr f = d->held.at[k];

    for (int i = 0; i < d->orders.at[k]; i++)
        f = qdot_ddt(d->session->pool, f);
    return f;
}

/* Export M and f of the equations M q'' = f; equations of massless coordinates are differentiated (export-massless.h). */
static qdot_status
export_mass_matrix_and_forces(description *d)
{
    const size_t n = d->x.n;
    qdot_expr *rows = qdot_calloc(n * n + n + 1, sizeof *rows);
    qdot_status status = rows != NULL ? qdot_export_massless(d->scene, rows, rows + n * n, &d->massless) : QDOT_ENOMEM;

    for (size_t i = 0; i < n * n + n && status == QDOT_OK; i++)
        status = append_without_switches(d, &d->equations, rows[i]);
    qdot_free(rows);
    return status;
}

/* Export M and f of the equations of motion, then A and gamma of the constraints A q'' = gamma, row by row. */
static qdot_status
export_equations(description *d)
{
    const size_t n = d->x.n, m = d->x.m;
    qdot_pool *pool = d->session->pool;
    expressions at_rest = {0};
    qdot_status status;

    QDOT_TRY(export_mass_matrix_and_forces(d));
    for (size_t k = 0; k < m; k++) {
        qdot_expr linear = constraint_on_accelerations(d, k);

        QDOT_TRY(qdot_pool_check(pool));
        for (size_t i = 0; i < n; i++)
            QDOT_TRY(append_bound_expression(d, &d->equations, qdot_diff(pool, linear, derivative_of_coordinate(d, i, 2))));
    }
    status = QDOT_OK;
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++)
        status = qdot_vec_push(&at_rest, i < n ? derivative_of_coordinate(d, i, 2) : QDOT_ZERO);
    for (size_t k = 0; k < m && status == QDOT_OK; k++) {
        qdot_expr rest = qdot_subs(pool, constraint_on_accelerations(d, k), n, at_rest.at, at_rest.at + n);

        status = append_bound_expression(d, &d->equations, qdot_neg(pool, rest));
    }
    qdot_free(at_rest.at);
    d->x.equations.blocks = m > 0 ? 4 : 2;
    d->x.equations.block[0] = (qdot_export_block){"M", n, n};
    d->x.equations.block[1] = (qdot_export_block){"f", n, 0};
    d->x.equations.block[2] = (qdot_export_block){"A", m, n};
    d->x.equations.block[3] = (qdot_export_block){"gamma", m, 0};
    return status;
}

/* Row i of the equations of motion: f + A^T lambda - M q'' for i < n, else gamma - A q'' of a constraint. */
static qdot_expr
equation_residual(const description *d, size_t i)
{
    const size_t n = d->x.n, m = d->x.m;
    const qdot_expr *M = d->equations.at, *f = M + n * n, *A = f + n, *gamma = A + m * n;
    qdot_pool *pool = d->session->pool;
    qdot_expr sum = i < n ? f[i] : gamma[i - n];

    for (size_t j = 0; j < n; j++) {
        qdot_expr factor = i < n ? M[i * n + j] : A[(i - n) * n + j];

        sum = qdot_sub(pool, sum, qdot_mul(pool, factor, derivative_of_coordinate(d, j, 2)));
    }
    for (size_t k = 0; k < m && i < n; k++)
        sum = qdot_add(pool, sum, qdot_mul(pool, A[k * n + i],
                                           d->scene->constraints.at[k].multiplier));
    return sum;
}

/* Of a scene with first-order states, export the velocities: of states their rates. */
static qdot_status
export_velocities(description *d)
{
    for (size_t i = 0; i < d->x.n && d->scene->states.n > 0; i++)
        QDOT_TRY(append_without_switches(d, &d->velocities, derivative_of_coordinate(d, i, 1)));
    d->x.velocities.blocks = 1;
    d->x.velocities.block[0] = (qdot_export_block){"velocity", d->x.n, 0};
    return QDOT_OK;
}

/* Append the derivatives of e, an exported expression, by q and q'. */
static qdot_status
append_slopes(description *d, qdot_expr e)
{
    QDOT_TRY(qdot_pool_check(d->session->pool));
    for (size_t j = 0; j < 2 * d->x.n; j++)
        QDOT_TRY(append_bound_expression(
            d, &d->slopes, qdot_diff(d->session->pool, e, derivative_of_coordinate(d, j % d->x.n, j >= d->x.n))));
    return QDOT_OK;
}

static qdot_status
export_jacobian(description *d)
{
    const size_t n = d->x.n, rows = n + d->x.m;

    if (n > MOST_SLOPES)
        return qdot_answer_notice(d->session,
                                  "no Jacobian is written for more than %d coordinates",
                                  MOST_SLOPES);
    for (size_t i = 0; i < rows; i++)
        QDOT_TRY(append_slopes(d, equation_residual(d, i)));
    for (size_t i = 0; i < d->velocities.n; i++)
        QDOT_TRY(append_slopes(d, d->velocities.at[i]));
    d->x.slopes.blocks = 2;
    d->x.slopes.block[0] = (qdot_export_block){"R", rows, 2 * n};
    d->x.slopes.block[1] = (qdot_export_block){"J", d->velocities.n, 2 * n};
    return QDOT_OK;
}

static qdot_status
export_energy(description *d)
{
    d->x.energy.blocks = 1;
    d->x.energy.block[0] = (qdot_export_block){NULL, 0, 0};
    return append_bound_expression(d, &d->energy, qdot_mech_numeric_energy(d->scene));
}

/* Export f of each position constraint f = 0, then for all constraints what must vanish on velocities, df/dt or f. */
static qdot_status
export_constraint_levels(description *d)
{
    const size_t m = d->x.m;
    bool some = false;

    for (size_t k = 0; k < m; k++)
        some = some || d->orders.at[k] > 0;
    for (int order = 2; order >= 1 && some; order--)
        for (size_t k = 0; k < m; k++) {
            qdot_expr f = d->orders.at[k] < order ? QDOT_ZERO : d->held.at[k];

            QDOT_TRY(append_bound_expression(d, &d->positions,
                                             d->orders.at[k] > order ? qdot_ddt(d->session->pool, f) : f));
        }
    d->x.positions.blocks = 2;
    d->x.positions.block[0] = (qdot_export_block){"f", m, 0};
    d->x.positions.block[1] = (qdot_export_block){"df", m, 0};
    return QDOT_OK;
}

/* Export the end of a coordinate's domain as an event that stops the run. */
static qdot_status
export_domain_end(description *d, const char *name, qdot_expr distance)
{
    qdot_text text = {0};

    QDOT_TRY(append_bound_expression(d, &d->events, distance));
    qdot_text_format(&text, "%s leaves its domain", name);
    QDOT_TRY(store_text(d, &text));
    return qdot_vec_push(&d->event,
                         ((qdot_export_event){
                             .name = text.at, .way = d->x.t1 < d->x.t0 ? 1 : -1, .stop = true}));
}

static qdot_status
export_domain_ends(description *d)
{
    qdot_pool *pool = d->session->pool;

    for (size_t i = 0; i < d->x.n; i++) {
        const qdot_symbol q = *qdot_expr_symbol(pool, d->scene->coordinates.at[i]);

        if (q.lo != QDOT_NIL)
            QDOT_TRY(export_domain_end(d, q.name, qdot_sub(pool, derivative_of_coordinate(d, i, 0), q.lo)));
        if (q.hi != QDOT_NIL)
            QDOT_TRY(export_domain_end(d, q.name, qdot_sub(pool, q.hi, derivative_of_coordinate(d, i, 0))));
    }
    return QDOT_OK;
}

static qdot_status
export_events(description *d)
{
    const qdot_scene *s = d->scene;

    for (size_t i = 0; i < s->events.n; i++) {
        const qdot_event *e = &s->events.at[i];
        expressions effect = {0};
        qdot_event act = {0};
        qdot_status status = append_bound_expression(d, &d->events, qdot_sub(s->pool, e->left, e->right));

        if (status == QDOT_OK && e->targets.n > 0)
            status = qdot_export_event_with_massless(d->scene, e, &act);
        for (size_t k = 0; k < act.values.n && status == QDOT_OK; k++)
            status = append_bound_expression(d, &effect, act.values.at[k]);
        if (status == QDOT_OK)
            status = qdot_vec_push(&d->acts, act);
        if (status != QDOT_OK) {
            qdot_free(act.targets.at);
            qdot_free(act.values.at);
        }
        if (status == QDOT_OK)
            status = qdot_vec_push(&d->effects, effect);
        if (status != QDOT_OK) {
            qdot_free(effect.at);
            return status;
        }
    }
    return QDOT_OK;
}

/* --- names and numbers -------------------------------------------------------------------- */

static qdot_status
add_parameter(description *d, qdot_expr symbol)
{
    double value;

    for (size_t i = 0; i < d->parameters.n; i++)
        if (d->parameters.at[i] == symbol)
            return QDOT_OK;
    QDOT_TRY(qdot_export_value_of(d->session, symbol, &value));
    QDOT_TRY(qdot_vec_push(&d->parameters, symbol));
    return qdot_vec_push(&d->values, ((qdot_export_name){get_symbol_name(d->session, symbol), value}));
}

/* Find the parameters that occur in the expressions of the list. */
static qdot_status
find_parameters(description *d, const expressions *list)
{
    qdot_pool *pool = d->session->pool;
    qdot_expr all = qdot_list(pool, (uint32_t)list->n, list->at);
    qdot_expr atoms = all == QDOT_NIL ? QDOT_NIL : qdot_expr_atoms(pool, all, false);

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr atom = qdot_expr_arg(pool, atoms, i);

        if (qdot_expr_is_class(pool, atom, QDOT_PARAM))
            QDOT_TRY(add_parameter(d, atom));
    }
    return QDOT_OK;
}

static qdot_status
find_all_parameters(description *d)
{
    const qdot_scene *s = d->scene;

    QDOT_TRY(find_parameters(d, &d->equations));
    QDOT_TRY(find_parameters(d, &d->velocities));
    QDOT_TRY(find_parameters(d, &d->energy));
    QDOT_TRY(find_parameters(d, &d->positions));
    QDOT_TRY(find_parameters(d, &d->events));
    QDOT_TRY(find_parameters(d, &d->u));
    for (size_t i = 0; i < d->effects.n; i++)
        QDOT_TRY(find_parameters(d, &d->effects.at[i]));
    for (size_t i = 0; i < d->acts.n; i++)
        for (size_t k = 0; k < d->acts.at[i].targets.n; k++)
            if (qdot_expr_is_class(s->pool, d->acts.at[i].targets.at[k], QDOT_PARAM))
                QDOT_TRY(add_parameter(d, d->acts.at[i].targets.at[k]));
    d->x.k = d->parameters.n;
    d->x.parameters = d->values.at;
    return QDOT_OK;
}

/* List all inputs of the tapes: t, q, q', q'', lambda, parameters, sides of switching surfaces. */
static qdot_status
list_all_inputs(description *d)
{
    QDOT_TRY(qdot_vec_push(&d->inputs, QDOT_T));
    for (unsigned order = 0; order < 3; order++)
        for (size_t i = 0; i < d->x.n; i++)
            QDOT_TRY(qdot_vec_push(&d->inputs, derivative_of_coordinate(d, i, order)));
    for (size_t k = 0; k < d->x.m; k++)
        QDOT_TRY(qdot_vec_push(&d->inputs, d->scene->constraints.at[k].multiplier));
    for (size_t i = 0; i < d->parameters.n; i++)
        QDOT_TRY(qdot_vec_push(&d->inputs, d->parameters.at[i]));
    for (size_t i = 0; i < d->x.s; i++)
        QDOT_TRY(qdot_vec_push(&d->inputs, d->switches.surfaces.at[i].side));
    return qdot_pool_check(d->session->pool);
}

static qdot_status
list_all_names(description *d)
{
    for (size_t i = 0; i < d->x.n; i++)
        QDOT_TRY(qdot_vec_push(
            &d->q, ((qdot_export_name){get_symbol_name(d->session, d->scene->coordinates.at[i]), NAN})));
    for (size_t k = 0; k < d->x.m; k++)
        QDOT_TRY(qdot_vec_push(
            &d->lambda,
            ((qdot_export_name){get_symbol_name(d->session, d->scene->constraints.at[k].multiplier), NAN})));
    d->x.q = d->q.at;
    d->x.lambda = d->lambda.at;
    return QDOT_OK;
}

static qdot_status
export_start(description *d)
{
    for (size_t i = 0; i < 2 * d->x.n; i++)
        QDOT_TRY(qdot_vec_push(&d->start, 0));
    d->x.start = d->start.at;
    return qdot_export_start(d->session, d->massless,
                             &(qdot_export_started){&d->x, d->start.at, d->parameters.at, d->values.at});
}

/* --- lowering to tapes -------------------------------------------------------------------- */

static qdot_status
lower_to_tape(const description *d, const expressions *e, const qdot_tape **tape)
{
    qdot_tape *made;

    if (e->n == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_tape_new(d->session->pool, d->inputs.n, d->inputs.at, e->n, e->at, &made));
    *tape = made;
    if (qdot_tape_operations(made) > MOST_OPERATIONS)
        return qdot_fail(QDOT_ELIMIT, "%zu operations are too many to export: more than %d",
                         qdot_tape_operations(made), MOST_OPERATIONS);
    return QDOT_OK;
}

/* The index of what an event sets: an element of the state y, or a parameter. */
static size_t
index_of_event_target(const description *d, qdot_expr symbol)
{
    for (size_t i = 0; i < 2 * d->x.n; i++)
        if (derivative_of_coordinate(d, i % d->x.n, i >= d->x.n) == symbol)
            return i;
    for (size_t i = 0; i < d->parameters.n; i++)
        if (d->parameters.at[i] == symbol)
            return 2 * d->x.n + i;
    return SIZE_MAX;
}

static qdot_status
lower_events_to_tapes(description *d)
{
    const qdot_scene *s = d->scene;
    size_t next = 0;

    for (size_t i = 0; i < d->acts.n; i++)
        for (size_t k = 0; k < d->acts.at[i].targets.n; k++)
            QDOT_TRY(qdot_vec_push(&d->targets, index_of_event_target(d, d->acts.at[i].targets.at[k])));
    for (size_t i = 0; i < s->events.n; i++) {
        const qdot_event *from = &s->events.at[i];
        qdot_export_event e = {.name = from->name,
                               .way = from->way,
                               .stop = from->stop,
                               .n_targets = d->acts.at[i].targets.n,
                               .targets = d->targets.at + next};

        next += e.n_targets;
        QDOT_TRY(qdot_vec_push(&d->event, e));
        QDOT_TRY(lower_to_tape(d, &d->effects.at[i], &d->event.at[i].effect));
    }
    return QDOT_OK;
}

static qdot_status
lower_all_to_tapes(description *d)
{
    QDOT_TRY(lower_to_tape(d, &d->equations, &d->x.equations.tape));
    QDOT_TRY(lower_to_tape(d, &d->slopes, &d->x.slopes.tape));
    QDOT_TRY(lower_to_tape(d, &d->velocities, &d->x.velocities.tape));
    QDOT_TRY(lower_to_tape(d, &d->energy, &d->x.energy.tape));
    QDOT_TRY(lower_to_tape(d, &d->positions, &d->x.positions.tape));
    QDOT_TRY(lower_to_tape(d, &d->u, &d->x.switches.tape));
    QDOT_TRY(lower_events_to_tapes(d));
    QDOT_TRY(export_domain_ends(d));
    d->x.event = d->event.at;
    d->x.n_events = d->event.n;
    d->x.events.blocks = 1;
    d->x.events.block[0] = (qdot_export_block){"occurs", d->event.n, 0};
    return lower_to_tape(d, &d->events, &d->x.events.tape);
}

static void
free_description(description *d)
{
    expressions *const lists[] = {&d->inputs, &d->parameters, &d->equations, &d->slopes, &d->velocities,
                                  &d->energy, &d->positions,  &d->events,    &d->u,      &d->held};
    const qdot_export_function *const functions[] = {&d->x.equations, &d->x.slopes,   &d->x.velocities, &d->x.energy,
                                                     &d->x.positions, &d->x.switches, &d->x.events};

    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        qdot_free(lists[i]->at);
    qdot_given_functions_clear(&d->given);
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        qdot_tape_free((qdot_tape *)functions[i]->tape);
    for (size_t i = 0; i < d->effects.n; i++)
        qdot_free(d->effects.at[i].at);
    for (size_t i = 0; i < d->event.n; i++)
        qdot_tape_free((qdot_tape *)d->event.at[i].effect);
    for (size_t i = 0; i < d->acts.n; i++) {
        qdot_free(d->acts.at[i].targets.at);
        qdot_free(d->acts.at[i].values.at);
    }
    for (size_t i = 0; i < d->texts.n; i++)
        qdot_free(d->texts.at[i]);
    qdot_switches_clear(&d->switches);
    qdot_free(d->texts.at);
    qdot_free(d->orders.at);
    qdot_free(d->surface.at);
    qdot_free(d->acts.at);
    qdot_free(d->effects.at);
    qdot_free(d->event.at);
    qdot_free(d->targets.at);
    qdot_free(d->q.at);
    qdot_free(d->lambda.at);
    qdot_free(d->values.at);
    qdot_free(d->start.at);
}

static qdot_status
describe_scene(description *d)
{
    QDOT_TRY(qdot_given_functions_find(d->session, &d->given));
    QDOT_TRY(export_switches(d));
    QDOT_TRY(export_constraints(d));
    QDOT_TRY(export_equations(d));
    QDOT_TRY(export_velocities(d));
    QDOT_TRY(export_jacobian(d));
    QDOT_TRY(export_energy(d));
    QDOT_TRY(export_constraint_levels(d));
    QDOT_TRY(export_events(d));
    QDOT_TRY(find_all_parameters(d));
    QDOT_TRY(list_all_inputs(d));
    QDOT_TRY(list_all_names(d));
    QDOT_TRY(export_start(d));
    return lower_all_to_tapes(d);
}

qdot_status
qdot_export_scene(qdot_session *session, const char *file, const qdot_export_language *language,
                  qdot_text *out)
{
    description d = {.session = session,
                     .scene = session->scene,
                     .x = {.file = file,
                           .n = session->scene->coordinates.n,
                           .m = session->scene->constraints.n}};
    qdot_text origin = {0};
    qdot_status status;

    if (d.x.n == 0) {
        (void)qdot_fail(QDOT_EINVAL, "there is nothing to export: no coordinate is declared");
        return qdot_hint("coord theta");
    }
    status = qdot_scene_print(d.scene, &origin);
    if (status == QDOT_OK)
        status = qdot_text_status(&origin);
    if (status == QDOT_OK)
        status = describe_scene(&d);
    d.x.origin = qdot_text_str(&origin);
    if (status == QDOT_OK)
        status = qdot_export_system_write(&d.x, language, out);
    free_description(&d);
    qdot_text_clear(&origin);
    return status;
}
