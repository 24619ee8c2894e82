/* sweep-lanes-members.c -- decides which sweeps can run in vector lanes; computes the members'
 * start and parameters. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/sweeps/sweep-lanes-parts.h"

#include <stdlib.h>
#include <string.h>

#include "expr/constant.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"
#include "sim/ensemble/path.h"
#include "sim/model/substitute.h"

/* A run (member) of a sweep with more steps than this is repeated as a single run, which may use a better method. */
enum { MOST_STEPS = 20000 };

/* The number of runs (members) made at a time if all their steps are stored. */
enum { KEPT_TOGETHER = 32 };

/* Under this tolerance the method's error may be less than that of rounding. Then one companion does not
 * tell enough. */
static const double least_tol = 3e-11;

/* Above this one the distances of single times of events may be small by chance, too: by one companion,
 * of 10,600 times of a pendulum and of Kepler's motion at 1e-6 53 were further off than told, by up to
 * 190 times, by two at 1.01e-6 10, by up to 1.23. */
static const double most_tol = 1e-9;

void
qdot_sweep_lanes_free(qdot_sweep_lanes *x)
{
    if (x == NULL)
        return;
    for (size_t k = 0; x->reasons && k < x->s->members.axes.members; k++)
        qdot_free(x->reasons[k]);
    qdot_free(x->reasons);
    qdot_free(x->made);
    qdot_run_free(x->run);
    qdot_ensemble_free(x->ensemble);
    qdot_free(x->bounds.at);
    qdot_free(x->events.at);
    qdot_free(x->names.at);
    qdot_free(x->columns);
    qdot_tape_free(x->tape);
    qdot_free(x->in);
    qdot_free(x->work);
    qdot_free(x->out);
    qdot_free(x->varied.at);
    qdot_free(x->axis.at);
    qdot_free(x);
}

/* --- columns that lanes can compute ----------------------------------------------------- */

/* Whether column i is the time NAME[K] of an event of the scene; *k: its number K. */
static const qdot_event *
event_time_of_column(const qdot_sweep *s, size_t i, int64_t *k)
{
    const char *name = qdot_compiled_member_of(s->columns.at.at[i], k);

    return name != NULL && *k >= 1 && *k <= 1000 ? qdot_scene_find_event(s->c->session->scene, name) : NULL;
}

static qdot_status
set_event_column(qdot_sweep_lanes *x, const qdot_event *e, int64_t k, qdot_sweep_lanes_column *to)
{
    qdot_pool *pool = x->s->c->session->pool;
    size_t i = 0;

    while (i < x->events.n && strcmp(x->names.at[i], e->name) != 0)
        i++;
    if (i == x->events.n) {
        QDOT_TRY(qdot_vec_push(&x->names, e->name));
        QDOT_TRY(qdot_vec_push(&x->events, ((qdot_ensemble_event){
                                               .function = qdot_sub(pool, e->left, e->right),
                                               .way = e->way})));
    }
    if (x->events.at[i].count < (size_t)k)
        x->events.at[i].count = (size_t)k;
    *to = (qdot_sweep_lanes_column){.kind = QDOT_LANES_EVENT, .event = i, .k = (size_t)k - 1};
    return qdot_pool_check(pool);
}

/* Whether e depends only on what the joint run computes: it has no accelerations, multipliers or results of runs. */
static bool
depends_on_states_only(qdot_session *session, qdot_expr e)
{
    return !(qdot_expr_node(session->pool, e)->holds
             & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
           && !qdot_measured_occurs(session, e);
}

/* Read the columns as expressions e [columns]; `why` stays empty if runs in vector lanes can compute them all. */
static qdot_status
lanes_read_columns(qdot_sweep_lanes *x, qdot_expr *e, qdot_text *why)
{
    qdot_cursor own = *x->s->c;
    const size_t n = x->s->columns.at.n;

    x->columns = qdot_calloc(n + 1, sizeof *x->columns);
    if (x->columns == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        const qdot_event *event;
        qdot_status status;
        int64_t k;

        if ((event = event_time_of_column(x->s, i, &k)) != NULL) {
            QDOT_TRY(set_event_column(x, event, k, &x->columns[i]));
            QDOT_TRY(qdot_columns_note_unit(x->s->c->session, &x->s->columns, i, QDOT_T));
            continue;
        }
        if (qdot_columns_read_way(x->s->c->session, &x->s->columns, i)) {
            x->columns[i].kind = QDOT_LANES_WAY;
            x->ways++;
            continue;
        }
        status = qdot_columns_read(&own, &x->s->columns, i, &e[x->outputs]);
        if (status == QDOT_ENOMEM || status == QDOT_EINTR)
            return status;
        if (status != QDOT_OK || !depends_on_states_only(x->s->c->session, e[x->outputs])) {
            qdot_text_format(why, "%s reads more of a run than its states and the times of events",
                             x->s->table->labels[x->s->table->n_swept + i]);
            return qdot_text_status(why);
        }
        x->columns[i].output = x->outputs++;
    }
    return QDOT_OK;
}

static qdot_status
lower_columns_to_tape(qdot_sweep_lanes *x, qdot_expr *e)
{
    const qdot_plan *p = qdot_ensemble_plan(x->ensemble);

    for (size_t i = 0; i < x->outputs; i++)
        e[i] = qdot_plan_substitute(p, e[i]);
    QDOT_TRY(qdot_pool_check(p->pool));
    QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, x->outputs, e, &x->tape));
    x->in = qdot_calloc(2 * p->n + 1, sizeof *x->in);
    x->work = qdot_calloc(2 * qdot_tape_work(x->tape) + 1, sizeof *x->work);
    x->out = qdot_calloc(QDOT_ENSEMBLE_PASSES * x->outputs + 1, sizeof *x->out);
    return x->in && x->work && x->out ? QDOT_OK : QDOT_ENOMEM;
}

/* --- members in lanes ------------------------------------------------------------------- */

qdot_status
qdot_sweep_lanes_request(qdot_sweep *s, size_t k, double *swept, qdot_request *request)
{
    qdot_session *session = s->c->session;
    const qdot_members *m = &s->members;

    QDOT_TRY(qdot_members_set(session, m, k, swept));
    return qdot_run_options_fill(session, &m->run, m->run.from, m->run.to, request);
}

/* Whether a swept parameter occurs elsewhere than in the equations and the start, for example in time limits. */
static bool
is_used_outside_equations(const qdot_sweep *s, qdot_expr symbol)
{
    const qdot_session *session = s->c->session;
    const qdot_pool *pool = session->pool;

    if (qdot_expr_contains(pool, s->members.run.from, symbol)
        || qdot_expr_contains(pool, s->members.run.to, symbol))
        return true;
    for (size_t i = 0; i < session->values->set_values.n; i++)
        if (session->values->set_symbols.at[i] != symbol
            && qdot_expr_contains(pool, session->values->set_values.at[i], symbol))
            return true;
    for (size_t i = 0; i < session->scene->coordinates.n; i++) {
        const qdot_symbol *q = qdot_expr_symbol(pool, session->scene->coordinates.at[i]);

        if ((q->lo != QDOT_NIL && qdot_expr_contains(pool, q->lo, symbol))
            || (q->hi != QDOT_NIL && qdot_expr_contains(pool, q->hi, symbol)))
            return true;
    }
    return false;
}

static qdot_status
find_varied_parameters(qdot_sweep_lanes *x, qdot_text *why)
{
    const qdot_sweep_axes *axes = &x->s->members.axes;

    for (size_t i = 0; i < axes->at.n; i++) {
        const qdot_expr symbol = axes->at.at[i].symbol;

        if (qdot_session_is_start(x->s->c->session->pool, symbol))
            continue;
        if (is_used_outside_equations(x->s, symbol)) {
            qdot_text_format(why, "other values depend on %s", axes->at.at[i].label);
            return qdot_text_status(why);
        }
        QDOT_TRY(qdot_vec_push(&x->varied, symbol));
        QDOT_TRY(qdot_vec_push(&x->axis, i));
    }
    return QDOT_OK;
}

/* Make the request of an ensemble (runs made together) from that of one run, without start and varied parameters. */
static qdot_status
make_ensemble(qdot_sweep_lanes *x, qdot_request *of)
{
    qdot_scene *scene = x->s->c->session->scene;
    qdot_run_request r = of->request;
    qdot_vec(qdot_expr) symbols = {0}, values = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < r.n_values && status == QDOT_OK; i++) {
        bool own = false;

        for (size_t k = 0; k < x->varied.n; k++)
            own = own || r.symbols[i] == x->varied.at[k];
        if (own)
            continue;
        status = qdot_vec_push(&symbols, r.symbols[i]);
        if (status == QDOT_OK)
            status = qdot_vec_push(&values, r.values[i]);
    }
    r.n_values = symbols.n;
    r.symbols = symbols.at;
    r.values = values.at;
    r.q0 = r.v0 = NULL;
    r.q_named = r.v_named = NULL;
    if (status == QDOT_OK)
        status = qdot_ensemble_new(scene, &r, x->varied.n, x->varied.at, &x->ensemble);
    if (status == QDOT_OK && x->ways > 0)
        status = qdot_ensemble_path_new(&(qdot_ensemble_path_of){x->ensemble, scene, &r,
                                                                 x->varied.n, x->varied.at},
                                        &x->run);
    qdot_free(symbols.at);
    qdot_free(values.at);
    return status;
}

/* Forget varied parameters that nothing but starts read: e [outputs], the columns at the end. What the
 * others read is known when they are read. */
static bool
drop_unused_parameters(qdot_sweep_lanes *x, const qdot_expr *e)
{
    const qdot_pool *pool = x->s->c->session->pool;
    size_t n = 0;

    for (size_t k = 0; k < x->varied.n; k++) {
        const qdot_expr symbol = x->varied.at[k];
        bool read = x->ways > 0 || qdot_ensemble_reads(x->ensemble, k) || qdot_expr_is_in_any(pool, symbol, x->outputs, e);

        for (size_t i = 0; i < x->events.n; i++)
            read = read || qdot_expr_contains(pool, x->events.at[i].function, symbol);
        if (!read)
            continue;
        x->varied.at[n] = symbol;
        x->axis.at[n++] = x->axis.at[k];
    }
    if (n == x->varied.n)
        return false;
    x->varied.n = x->axis.n = n;
    return true;
}

/* Make the ensemble (runs made together in vector lanes) if the first run is suitable; otherwise `why` says why not. */
static qdot_status
prepare_ensemble(qdot_sweep_lanes *x, qdot_request *request, qdot_text *why)
{
    qdot_session *session = x->s->c->session;
    double *swept = qdot_calloc(x->s->members.axes.at.n + 1, sizeof *swept);
    qdot_expr *e = qdot_calloc(x->s->columns.at.n + 1, sizeof *e);
    qdot_status status = swept && e ? qdot_sweep_lanes_request(x->s, 0, swept, request) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = find_varied_parameters(x, why);
    if (status == QDOT_OK && why->n == 0)
        status = lanes_read_columns(x, e, why);
    if (status == QDOT_OK && why->n == 0)
        status = qdot_ensemble_fit(session->scene, &request->request, &x->bounds, why);
    if (status == QDOT_OK && why->n == 0)
        status = qdot_session_number(session, request->request.t1, &x->t1, NULL);
    if (status == QDOT_OK && why->n == 0)
        status = make_ensemble(x, request);
    if (status == QDOT_OK && why->n == 0 && drop_unused_parameters(x, e)) {
        qdot_ensemble_free(x->ensemble);
        status = make_ensemble(x, request);
    }
    if (status == QDOT_OK && why->n == 0)
        status = lower_columns_to_tape(x, e);
    if (status == QDOT_OK && why->n == 0) {
        const qdot_plan *p = qdot_ensemble_plan(x->ensemble);

        x->n = p->n - p->n_states;
        x->least = x->ways > 0 || request->request.tol < least_tol
                           || (x->events.n > 0 && request->request.tol > most_tol)
                       ? 2
                       : 1;
        for (size_t i = 0; i < x->events.n; i++)
            x->events.at[i].function = qdot_plan_substitute(p, x->events.at[i].function);
        status = qdot_pool_check(session->pool);
        x->watching = (qdot_ensemble_watching){.n_events = x->events.n,
                                               .n_bounds = x->bounds.n,
                                               .events = x->events.at,
                                               .bounds = x->bounds.at,
                                               .leave = x->outputs + x->ways == 0,
                                               .keep = x->ways > 0};
    }
    if (status == QDOT_OK && why->n == 0)
        status = qdot_ensemble_follow(x->ensemble, &x->watching, MOST_STEPS);
    if (status == QDOT_OK && why->n == 0)
        x->places = qdot_ensemble_places(x->ensemble);
    qdot_free(swept);
    qdot_free(e);
    return status;
}

qdot_status
qdot_sweep_lanes_new(qdot_sweep *s, qdot_sweep_lanes **lanes, qdot_text *why)
{
    const size_t members = s->members.axes.members;
    qdot_request request = {0};
    qdot_trial trial;
    qdot_sweep_lanes *x;
    qdot_status status;

    *lanes = NULL;
    if (members < QDOT_SWEEP_LANES_LEAST) {
        qdot_text_format(why, "there are fewer than %d", QDOT_SWEEP_LANES_LEAST);
        return qdot_text_status(why);
    }
    x = qdot_calloc(1, sizeof *x);
    if (x == NULL)
        return QDOT_ENOMEM;
    x->s = s;
    x->made = qdot_calloc(members + 1, sizeof *x->made);
    x->reasons = qdot_calloc(members + 1, sizeof *x->reasons);
    status = x->made && x->reasons ? qdot_trial_begin(&trial, s->c->session) : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        status = prepare_ensemble(x, &request, why);
        qdot_trial_end(&trial);
    }
    qdot_request_free(&request);
    if (status == QDOT_OK && why->n == 0) {
        *lanes = x;
        return QDOT_OK;
    }
    qdot_sweep_lanes_free(x);
    if (status == QDOT_OK)
        return qdot_text_status(why);
    if (status == QDOT_ENOMEM || status == QDOT_EINTR)
        return status;
    qdot_text_add(why, qdot_last_error()->message); /* the reason; a single run would report more */
    if (qdot_pool_check(s->c->session->pool) == QDOT_ENOMEM) /* clear the pool's failure, so that it is not reported again */
        return QDOT_ENOMEM;
    return qdot_text_status(why);
}

/* Evaluate the start y [2n] and the parameters of run (member) k of the sweep as numbers. */
static qdot_status
evaluate_member(qdot_sweep_lanes *x, size_t k, double *y, double *parameters)
{
    qdot_session *session = x->s->c->session;
    double *swept = x->s->table->values + k * x->s->table->n;
    qdot_trial trial;
    qdot_request request = {0};
    qdot_status status;

    QDOT_TRY(qdot_trial_begin(&trial, session));
    status = qdot_sweep_lanes_request(x->s, k, swept, &request);
    if (status == QDOT_OK && x->varied.n > 0)
        status = qdot_request_masses(session, &request);
    for (size_t i = 0; i < x->n && status == QDOT_OK; i++) {
        status = qdot_constant_double(session->pool, request.request.q0[i], &y[i]);
        if (status == QDOT_OK)
            status = qdot_constant_double(session->pool, request.request.v0[i], &y[x->n + i]);
    }
    for (size_t i = 0; i < x->varied.n; i++)
        parameters[i] = swept[x->axis.at[i]];
    qdot_request_free(&request);
    qdot_trial_end(&trial);
    return status;
}

/* Starts and parameters of several runs (members) of a sweep as numbers, with the indices of their rows. */
typedef struct {
    size_t n, *row;
    double *y, *parameters; /* starts [n x 2 coordinates]; varied parameters [n x varied] */
    qdot_ensemble_result *results;
} members;

static void
free_members(members *o)
{
    qdot_free(o->row);
    qdot_free(o->y);
    qdot_free(o->parameters);
    qdot_free(o->results);
}

static qdot_status
allocate_members(members *o, const qdot_sweep_lanes *x, size_t most)
{
    *o = (members){.row = qdot_calloc(most + 1, sizeof *o->row),
                   .y = qdot_calloc(most * 2 * x->n + 1, sizeof *o->y),
                   .parameters = qdot_calloc(most * x->varied.n + 1, sizeof *o->parameters),
                   .results = qdot_calloc(most + 1, sizeof *o->results)};
    return o->row && o->y && o->parameters && o->results ? QDOT_OK : QDOT_ENOMEM;
}

/* Make the runs, each with this number of companion runs; `again` collects those that need more companions. */
static qdot_status
run_members(qdot_sweep_lanes *x, size_t companions, members *o, members *again)
{
    const size_t width = 2 * x->n, varied = x->varied.n;
    double *starts = qdot_calloc(o->n * width + 1, sizeof *starts);
    qdot_status status = starts ? QDOT_OK : QDOT_ENOMEM;

    x->companions = companions;
    qdot_ensemble_companions(x->ensemble, companions);
    if (status == QDOT_OK) {
        memcpy(starts, o->y, o->n * width * sizeof *starts);
        status = qdot_ensemble_run(x->ensemble, o->n, o->y, o->parameters, true, o->results);
    }
    x->results = o->results;
    for (size_t m = 0; m < o->n && status == QDOT_OK; m++) {
        x->unsure = false;
        status = qdot_sweep_lanes_fill_row(x, m, o->row[m]);
        if (!x->unsure)
            continue;
        memcpy(again->y + again->n * width, starts + m * width, width * sizeof *starts);
        memcpy(again->parameters + again->n * varied, o->parameters + m * varied,
               varied * sizeof *starts);
        again->row[again->n++] = o->row[m];
    }
    qdot_free(starts);
    return status;
}

/* Make these runs [count] of the sweep together, side by side in the lanes of vector instructions. */
static qdot_status
run_in_lanes(qdot_sweep_lanes *x, const size_t *rows, size_t count)
{
    members first = {0}, again = {0};
    qdot_status status = allocate_members(&first, x, count);

    if (status == QDOT_OK)
        status = allocate_members(&again, x, count);
    for (size_t k = 0; k < count && status == QDOT_OK; k++) {
        status = evaluate_member(x, rows[k], first.y + first.n * 2 * x->n,
                                 first.parameters + first.n * x->varied.n);
        if (status == QDOT_OK)
            first.row[first.n++] = rows[k];
        else if (status != QDOT_ENOMEM && status != QDOT_EINTR)
            status = QDOT_OK; /* go on: the single runs report what is wrong with their values */
    }
    if (status == QDOT_OK && first.n > 0)
        status = run_members(x, x->least, &first, &again);
    if (status == QDOT_OK && again.n > 0)
        status = run_members(x, QDOT_ENSEMBLE_PASSES - 1, &again, NULL);
    free_members(&first);
    free_members(&again);
    return status;
}

qdot_status
qdot_sweep_lanes_run_rows(qdot_sweep_lanes *x, const size_t *rows, size_t count)
{
    const size_t most = x->ways > 0 ? KEPT_TOGETHER : count;

    for (size_t k = 0; k < count; k += most)
        QDOT_TRY(run_in_lanes(x, rows + k, count - k < most ? count - k : most));
    return QDOT_OK;
}

qdot_status
qdot_sweep_lanes_run(qdot_sweep_lanes *x, size_t first, size_t count)
{
    size_t *rows = qdot_calloc(count + 1, sizeof *rows), n = 0;
    qdot_status status = rows ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = first; k < first + count && rows != NULL; k++)
        if (!x->s->done[k])
            rows[n++] = k;
    if (status == QDOT_OK)
        status = qdot_sweep_lanes_run_rows(x, rows, n);
    qdot_free(rows);
    return status;
}

bool
qdot_sweep_lanes_made(qdot_sweep_lanes *x, size_t k, qdot_status *status)
{
    *status = QDOT_OK;
    if (!x->made[k])
        return false;
    if (x->reasons[k] != NULL) {
        *status = qdot_fail(QDOT_EDOMAIN, "%s", x->reasons[k]);
        qdot_hint("`events` lists them");
        qdot_free(x->reasons[k]);
        x->reasons[k] = NULL;
    }
    return true;
}
