/* export-scene.c -- expressions of a motion, lowered to tapes with common inputs. */
#include "lang/declare/export-scene.h"

#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "sim/model/substitute.h"

enum {
    MOST_OPERATIONS = 200000,
    MOST_SLOPES = 24 /* coordinates up to which the Jacobian is written */
};

typedef qdot_vec(qdot_expr) expressions;
typedef qdot_vec(qdot_export_name) names;

/* What is exported, while it is made. */
typedef struct {
    qdot_session *session;
    qdot_scene *scene;
    qdot_export_system x;
    expressions inputs, parameters;
    expressions equations, slopes, energy, positions, events;
    qdot_vec(expressions) effects; /* of each event */
    names q, lambda, values;
    qdot_vec(double) start;
    qdot_vec(qdot_export_event) event;
    qdot_vec(size_t) targets; /* of all events */
} description;

/* --- expressions ------------------------------------------------------------------------ */

/* e with the functions that have a value replaced by it; parameters stay. */
static qdot_expr
bound(qdot_session *s, qdot_expr e)
{
    expressions heads = {0}, bodies = {0};

    for (size_t i = 0; i < s->set_symbols.n && e != QDOT_NIL; i++)
        if (qdot_expr_kind(s->pool, s->set_symbols.at[i]) == QDOT_UFUN &&
            (qdot_vec_push(&heads, s->set_symbols.at[i]) != QDOT_OK ||
             qdot_vec_push(&bodies, s->set_values.at[i]) != QDOT_OK))
            e = qdot_pool_fail(s->pool);
    if (heads.n > 0 && e != QDOT_NIL)
        e = qdot_substitute(s->pool, e, heads.n, heads.at, bodies.at);
    qdot_free(heads.at);
    qdot_free(bodies.at);
    return e;
}

static qdot_status
push(description *d, expressions *to, qdot_expr e)
{
    e = bound(d->session, e);
    QDOT_TRY(qdot_pool_check(d->session->pool));
    return qdot_vec_push(to, e);
}

static qdot_expr
jet(const description *d, size_t i, unsigned order)
{
    return qdot_symbol_jet(d->session->pool, d->scene->coordinates.at[i], order);
}

/* The k-th constraint differentiated until it is linear in q''. */
static qdot_expr
accelerated(const description *d, size_t k)
{
    static const unsigned orders[] = {
        [QDOT_HOLONOMIC] = 2, [QDOT_VELOCITY] = 1, [QDOT_ACCELERATION] = 0};
    const qdot_constraint *c = &d->scene->constraints.at[k];
    qdot_expr f = c->f;

    for (unsigned i = 0; i < orders[c->kind]; i++)
        f = qdot_ddt(d->session->pool, f);
    return f;
}

/* M, f, then A and gamma, row by row. */
static qdot_status
equations(description *d)
{
    const size_t n = d->x.n, m = d->x.m;
    qdot_pool *pool = d->session->pool;
    qdot_expr M = qdot_mech_numeric_mass(d->scene), f = qdot_mech_numeric_forcing(d->scene);
    expressions at_rest = {0};
    qdot_status status;

    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < n * n; i++)
        QDOT_TRY(push(d, &d->equations, qdot_expr_arg(pool, M, (uint32_t)i)));
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(push(d, &d->equations, qdot_expr_arg(pool, f, (uint32_t)i)));
    for (size_t k = 0; k < m; k++) {
        qdot_expr linear = accelerated(d, k);

        QDOT_TRY(qdot_pool_check(pool));
        for (size_t i = 0; i < n; i++)
            QDOT_TRY(push(d, &d->equations, qdot_diff(pool, linear, jet(d, i, 2))));
    }
    status = QDOT_OK;
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++)
        status = qdot_vec_push(&at_rest, i < n ? jet(d, i, 2) : QDOT_ZERO);
    for (size_t k = 0; k < m && status == QDOT_OK; k++) {
        qdot_expr rest = qdot_subs(pool, accelerated(d, k), n, at_rest.at, at_rest.at + n);

        status = push(d, &d->equations, qdot_neg(pool, rest));
    }
    qdot_free(at_rest.at);
    d->x.equations.blocks = m > 0 ? 4 : 2;
    d->x.equations.block[0] = (qdot_export_block){"M", n, n};
    d->x.equations.block[1] = (qdot_export_block){"f", n, 0};
    d->x.equations.block[2] = (qdot_export_block){"A", m, n};
    d->x.equations.block[3] = (qdot_export_block){"gamma", m, 0};
    return status;
}

/* f + A^T lambda - M q'' (row i < n), gamma - A q''. */
static qdot_expr
residual(const description *d, size_t i)
{
    const size_t n = d->x.n, m = d->x.m;
    const qdot_expr *M = d->equations.at, *f = M + n * n, *A = f + n, *gamma = A + m * n;
    qdot_pool *pool = d->session->pool;
    qdot_expr sum = i < n ? f[i] : gamma[i - n];

    for (size_t j = 0; j < n; j++) {
        qdot_expr factor = i < n ? M[i * n + j] : A[(i - n) * n + j];

        sum = qdot_sub(pool, sum, qdot_mul(pool, factor, jet(d, j, 2)));
    }
    for (size_t k = 0; k < m && i < n; k++)
        sum = qdot_add(pool, sum, qdot_mul(pool, A[k * n + i],
                                           d->scene->constraints.at[k].multiplier));
    return sum;
}

static qdot_status
slopes(description *d)
{
    const size_t n = d->x.n, rows = n + d->x.m;

    if (n > MOST_SLOPES)
        return qdot_answer_notice(d->session,
                                  "no Jacobian is written for more than %d coordinates",
                                  MOST_SLOPES);
    for (size_t i = 0; i < rows; i++) {
        qdot_expr r = residual(d, i);

        QDOT_TRY(qdot_pool_check(d->session->pool));
        for (size_t j = 0; j < 2 * n; j++)
            QDOT_TRY(push(d, &d->slopes,
                          qdot_diff(d->session->pool, r, jet(d, j % n, j >= n))));
    }
    d->x.slopes.blocks = 1;
    d->x.slopes.block[0] = (qdot_export_block){"R", rows, 2 * n};
    return QDOT_OK;
}

static qdot_status
energy(description *d)
{
    d->x.energy.blocks = 1;
    d->x.energy.block[0] = (qdot_export_block){NULL, 0, 0};
    return push(d, &d->energy, qdot_mech_numeric_energy(d->scene));
}

/* f of the constraints on positions, then df/dt, and f of those on velocities. */
static qdot_status
positions(description *d)
{
    const qdot_scene *s = d->scene;
    size_t first = 0, second = 0;

    for (size_t k = 0; k < s->constraints.n; k++)
        if (s->constraints.at[k].kind == QDOT_HOLONOMIC) {
            QDOT_TRY(push(d, &d->positions, s->constraints.at[k].f));
            first++;
        }
    for (size_t k = 0; k < s->constraints.n; k++) {
        const qdot_constraint *c = &s->constraints.at[k];

        if (c->kind == QDOT_ACCELERATION)
            continue;
        QDOT_TRY(push(d, &d->positions,
                      c->kind == QDOT_HOLONOMIC ? qdot_ddt(d->session->pool, c->f) : c->f));
        second++;
    }
    d->x.positions.blocks = 2;
    d->x.positions.block[0] = (qdot_export_block){"f", first, 0};
    d->x.positions.block[1] = (qdot_export_block){"df", second, 0};
    return QDOT_OK;
}

static qdot_status
events(description *d)
{
    const qdot_scene *s = d->scene;

    for (size_t i = 0; i < s->events.n; i++) {
        const qdot_event *e = &s->events.at[i];
        expressions effect = {0};
        qdot_status status = push(d, &d->events, qdot_sub(s->pool, e->left, e->right));

        for (size_t k = 0; k < e->values.n && status == QDOT_OK; k++)
            status = push(d, &effect, e->values.at[k]);
        if (status == QDOT_OK)
            status = qdot_vec_push(&d->effects, effect);
        if (status != QDOT_OK) {
            qdot_free(effect.at);
            return status;
        }
    }
    d->x.n_events = s->events.n;
    d->x.events.blocks = 1;
    d->x.events.block[0] = (qdot_export_block){"occurs", s->events.n, 0};
    return QDOT_OK;
}

/* --- names and numbers -------------------------------------------------------------------- */

static const char *
name_of(const qdot_session *s, qdot_expr symbol)
{
    return qdot_expr_symbol(s->pool, symbol)->name;
}

/* The number that `set` gives a parameter; NaN: none. */
static qdot_status
value_of(qdot_session *s, qdot_expr parameter, double *value)
{
    *value = NAN;
    for (size_t i = 0; i < s->set_symbols.n; i++)
        if (s->set_symbols.at[i] == parameter)
            return qdot_session_number(s, parameter, value, NULL);
    return QDOT_OK;
}

static qdot_status
add_parameter(description *d, qdot_expr symbol)
{
    double value;

    for (size_t i = 0; i < d->parameters.n; i++)
        if (d->parameters.at[i] == symbol)
            return QDOT_OK;
    QDOT_TRY(value_of(d->session, symbol, &value));
    QDOT_TRY(qdot_vec_push(&d->parameters, symbol));
    return qdot_vec_push(&d->values, ((qdot_export_name){name_of(d->session, symbol), value}));
}

/* The parameters in these expressions. */
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
all_parameters(description *d)
{
    const qdot_scene *s = d->scene;

    QDOT_TRY(find_parameters(d, &d->equations));
    QDOT_TRY(find_parameters(d, &d->energy));
    QDOT_TRY(find_parameters(d, &d->positions));
    QDOT_TRY(find_parameters(d, &d->events));
    for (size_t i = 0; i < d->effects.n; i++)
        QDOT_TRY(find_parameters(d, &d->effects.at[i]));
    for (size_t i = 0; i < s->events.n; i++)
        for (size_t k = 0; k < s->events.at[i].targets.n; k++)
            if (qdot_expr_is_class(s->pool, s->events.at[i].targets.at[k], QDOT_PARAM))
                QDOT_TRY(add_parameter(d, s->events.at[i].targets.at[k]));
    d->x.k = d->parameters.n;
    d->x.parameters = d->values.at;
    return QDOT_OK;
}

/* t, q, q', q'', lambda, parameters. */
static qdot_status
all_inputs(description *d)
{
    QDOT_TRY(qdot_vec_push(&d->inputs, QDOT_T));
    for (unsigned order = 0; order < 3; order++)
        for (size_t i = 0; i < d->x.n; i++)
            QDOT_TRY(qdot_vec_push(&d->inputs, jet(d, i, order)));
    for (size_t k = 0; k < d->x.m; k++)
        QDOT_TRY(qdot_vec_push(&d->inputs, d->scene->constraints.at[k].multiplier));
    for (size_t i = 0; i < d->parameters.n; i++)
        QDOT_TRY(qdot_vec_push(&d->inputs, d->parameters.at[i]));
    return qdot_pool_check(d->session->pool);
}

static qdot_status
all_names(description *d)
{
    for (size_t i = 0; i < d->x.n; i++)
        QDOT_TRY(qdot_vec_push(
            &d->q, ((qdot_export_name){name_of(d->session, d->scene->coordinates.at[i]), NAN})));
    for (size_t k = 0; k < d->x.m; k++)
        QDOT_TRY(qdot_vec_push(
            &d->lambda,
            ((qdot_export_name){name_of(d->session, d->scene->constraints.at[k].multiplier), NAN})));
    d->x.q = d->q.at;
    d->x.lambda = d->lambda.at;
    return QDOT_OK;
}

/* Whether the run is one of these coordinates. */
static bool
is_of_scene(const description *d, const qdot_run_report *r)
{
    if (r->n - r->n_states != d->x.n)
        return false;
    for (size_t i = 0; i < d->x.n; i++)
        if (r->coordinates[i] != d->scene->coordinates.at[i])
            return false;
    return true;
}

static qdot_status
start_of_run(description *d, qdot_run *run)
{
    const qdot_run_report *r = qdot_run_get_report(run);
    expressions y = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < 2 * d->x.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&y, jet(d, i % d->x.n, i >= d->x.n));
    if (status == QDOT_OK)
        status = qdot_run_values(run, y.n, y.at, 1, &r->t0, d->start.at, NULL);
    qdot_free(y.at);
    d->x.t0 = r->t0;
    d->x.t1 = r->t1;
    d->x.tol = r->digits > 0 ? 1e-13 : r->tol;
    return status;
}

/* The value of `start`; 0: none, NaN: it has no number yet. */
static qdot_status
start_value(qdot_session *s, qdot_expr symbol, double *value)
{
    *value = 0;
    for (size_t i = 0; i < s->start_symbols.n; i++)
        if (s->start_symbols.at[i] == symbol) {
            qdot_status status = qdot_session_number(s, s->start_values.at[i], value, NULL);

            if (status != QDOT_EUNSET)
                return status;
            *value = NAN;
        }
    return QDOT_OK;
}

static qdot_status
starts(description *d)
{
    qdot_session *s = d->session;

    for (size_t i = 0; i < 2 * d->x.n; i++)
        QDOT_TRY(qdot_vec_push(&d->start, 0));
    d->x.start = d->start.at;
    if (s->runs.n > 0) {
        qdot_run *run = s->runs.at[s->runs.n - 1].run;

        if (is_of_scene(d, qdot_run_get_report(run)))
            return start_of_run(d, run);
    }
    d->x.t1 = 10;
    d->x.tol = 1e-12;
    for (size_t i = 0; i < 2 * d->x.n; i++)
        QDOT_TRY(start_value(s, jet(d, i % d->x.n, i >= d->x.n), &d->start.at[i]));
    return QDOT_OK;
}

/* --- tapes -------------------------------------------------------------------------------- */

static qdot_status
lower(const description *d, const expressions *e, const qdot_tape **tape)
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

/* Which element of y or which parameter an event sets. */
static size_t
target(const description *d, qdot_expr symbol)
{
    for (size_t i = 0; i < 2 * d->x.n; i++)
        if (jet(d, i % d->x.n, i >= d->x.n) == symbol)
            return i;
    for (size_t i = 0; i < d->parameters.n; i++)
        if (d->parameters.at[i] == symbol)
            return 2 * d->x.n + i;
    return SIZE_MAX;
}

static qdot_status
lower_events(description *d)
{
    const qdot_scene *s = d->scene;
    size_t next = 0;

    for (size_t i = 0; i < s->events.n; i++)
        for (size_t k = 0; k < s->events.at[i].targets.n; k++)
            QDOT_TRY(qdot_vec_push(&d->targets, target(d, s->events.at[i].targets.at[k])));
    for (size_t i = 0; i < s->events.n; i++) {
        const qdot_event *from = &s->events.at[i];
        qdot_export_event e = {.name = from->name,
                               .way = from->way,
                               .stop = from->stop,
                               .n_targets = from->targets.n,
                               .targets = d->targets.at + next};

        next += e.n_targets;
        QDOT_TRY(qdot_vec_push(&d->event, e));
        QDOT_TRY(lower(d, &d->effects.at[i], &d->event.at[i].effect));
    }
    d->x.event = d->event.at;
    return QDOT_OK;
}

static qdot_status
lower_all(description *d)
{
    QDOT_TRY(lower(d, &d->equations, &d->x.equations.tape));
    QDOT_TRY(lower(d, &d->slopes, &d->x.slopes.tape));
    QDOT_TRY(lower(d, &d->energy, &d->x.energy.tape));
    QDOT_TRY(lower(d, &d->positions, &d->x.positions.tape));
    QDOT_TRY(lower(d, &d->events, &d->x.events.tape));
    return lower_events(d);
}

static void
clear(description *d)
{
    expressions *const lists[] = {&d->inputs, &d->parameters, &d->equations, &d->slopes,
                                  &d->energy, &d->positions, &d->events};
    const qdot_export_function *const functions[] = {&d->x.equations, &d->x.slopes, &d->x.energy,
                                                     &d->x.positions, &d->x.events};

    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        qdot_free(lists[i]->at);
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        qdot_tape_free((qdot_tape *)functions[i]->tape);
    for (size_t i = 0; i < d->effects.n; i++)
        qdot_free(d->effects.at[i].at);
    for (size_t i = 0; i < d->event.n; i++)
        qdot_tape_free((qdot_tape *)d->event.at[i].effect);
    qdot_free(d->effects.at);
    qdot_free(d->event.at);
    qdot_free(d->targets.at);
    qdot_free(d->q.at);
    qdot_free(d->lambda.at);
    qdot_free(d->values.at);
    qdot_free(d->start.at);
}

static qdot_status
describe(description *d)
{
    QDOT_TRY(equations(d));
    QDOT_TRY(slopes(d));
    QDOT_TRY(energy(d));
    if (d->x.m > 0)
        QDOT_TRY(positions(d));
    QDOT_TRY(events(d));
    QDOT_TRY(all_parameters(d));
    QDOT_TRY(all_inputs(d));
    QDOT_TRY(all_names(d));
    QDOT_TRY(starts(d));
    return lower_all(d);
}

qdot_status
qdot_export_scene(qdot_session *session, const char *file, qdot_export_language language,
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
        status = describe(&d);
    d.x.origin = qdot_text_str(&origin);
    if (status == QDOT_OK)
        status = qdot_export_system_write(&d.x, language, out);
    clear(&d);
    qdot_text_clear(&origin);
    return status;
}

/* --- expressions -------------------------------------------------------------------------- */

/* Its scalars; of equations left - right. */
static qdot_status
scalars(qdot_session *s, qdot_expr e, expressions *to)
{
    qdot_pool *pool = s->pool;
    qdot_kind kind = qdot_expr_kind(pool, e);

    if (kind == QDOT_REL && qdot_expr_node(pool, e)->op == QDOT_EQ)
        e = qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1));
    else if (!qdot_expr_is_scalar(pool, e))
        return qdot_fail(QDOT_ETYPE, "numbers, equations, and vectors, matrices, lists of these can be "
                                     "exported");
    e = bound(s, e);
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_vec_push(to, e);
}

/* Symbols in `list`, those without a value first. */
static qdot_status
find_arguments(qdot_session *s, const expressions *list, expressions *inputs, names *to)
{
    qdot_expr all = qdot_list(s->pool, (uint32_t)list->n, list->at);
    qdot_expr atoms = all == QDOT_NIL ? QDOT_NIL : qdot_expr_atoms(s->pool, all, false);

    QDOT_TRY(qdot_pool_check(s->pool));
    for (int with_value = 0; with_value < 2; with_value++)
        for (uint32_t i = 0; i < qdot_expr_count(s->pool, atoms); i++) {
            qdot_expr atom = qdot_expr_arg(s->pool, atoms, i);
            double value;

            if (qdot_expr_is_class(s->pool, atom, QDOT_CONST))
                continue;
            QDOT_TRY(value_of(s, atom, &value));
            if (isnan(value) != !with_value)
                continue;
            QDOT_TRY(qdot_vec_push(inputs, atom));
            QDOT_TRY(qdot_vec_push(to, ((qdot_export_name){name_of(s, atom), value})));
        }
    return QDOT_OK;
}

static qdot_export_block
shape_of(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);
    size_t n = qdot_expr_count(pool, e);

    if (kind == QDOT_MAT)
        return (qdot_export_block){"out", n / qdot_expr_node(pool, e)->op,
                                   qdot_expr_node(pool, e)->op};
    if (kind == QDOT_VEC || kind == QDOT_LIST)
        return (qdot_export_block){"out", n, 0};
    return (qdot_export_block){NULL, 0, 0};
}

qdot_status
qdot_export_value(qdot_session *session, const char *name, qdot_expr e, const char *file,
                  qdot_export_language language, qdot_text *out)
{
    qdot_pool *pool = session->pool;
    qdot_export_expression x = {.file = file, .origin = name};
    expressions inputs = {0}, outputs = {0};
    names arguments = {0};
    qdot_tape *tape = NULL;
    qdot_status status = QDOT_OK;

    e = qdot_measured_as_rationals(session, e);
    QDOT_TRY(qdot_pool_check(pool));
    x.value.blocks = 1;
    x.value.block[0] = shape_of(pool, e);
    if (x.value.block[0].array == NULL)
        status = scalars(session, e, &outputs);
    for (uint32_t i = 0;
         x.value.block[0].array != NULL && i < qdot_expr_count(pool, e) && status == QDOT_OK; i++)
        status = scalars(session, qdot_expr_arg(pool, e, i), &outputs);
    if (status == QDOT_OK && outputs.n == 0)
        status = qdot_fail(QDOT_EINVAL, "an empty list: there is nothing to export");
    if (status == QDOT_OK)
        status = find_arguments(session, &outputs, &inputs, &arguments);
    if (status == QDOT_OK)
        status = qdot_tape_new(pool, inputs.n, inputs.at, outputs.n, outputs.at, &tape);
    x.k = inputs.n;
    x.arguments = arguments.at;
    x.value.tape = tape;
    if (status == QDOT_OK)
        status = qdot_export_expression_write(&x, language, out);
    qdot_tape_free(tape);
    qdot_free(inputs.at);
    qdot_free(outputs.at);
    qdot_free(arguments.at);
    return status;
}
