/* slopes.c -- the directions of differentiation, and a run of the equations of motion with their variational equations. */
#include "lang/slopes/slopes.h"

#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/commands/set.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"
#include "lang/slopes/start-slopes.h"
#include "sim/model/substitute.h"
#include "sim/run/slides.h"
#include "sim/study/sizes.h"

/* A run with slopes goes beyond the last time that it is needed at by so much of the whole, since errors at
 * its end may be unknown; its end is that of the run within so much of the values. */
static const double beyond = 0.001, apart = 1e-6;

const char qdot_slopes_run[] = "the slopes";

/* --- the names by which derivatives are taken ------------------------------------------- */

qdot_status
qdot_slope_name_find(qdot_record *r, const qdot_filled *part, qdot_slope_name *x)
{
    qdot_text text = {0};

    *x = (qdot_slope_name){.place = part->from};
    QDOT_TRY(qdot_set_find_symbol(r, part, &x->symbol));
    qdot_token_text(r->cursor.session, part->from, part->to, &text);
    x->label = text.at;
    return qdot_text_status(&text);
}

qdot_status
qdot_slope_names_take(qdot_cursor *c, qdot_slope_names *names, const qdot_slope_name *x,
                      qdot_status read)
{
    if (read == QDOT_OK)
        read = qdot_vec_push(names, *x);
    if (read != QDOT_OK) {
        qdot_free(x->label);
        return read;
    }
    for (size_t i = 0; i + 1 < names->n; i++)
        if (names->at[i].symbol == x->symbol) {
            c->error_at = x->place->start;
            return qdot_fail(QDOT_EINVAL, "%s is named twice", x->label);
        }
    return QDOT_OK;
}

qdot_status
qdot_slopes_find(qdot_record *r, const char *before, qdot_slopes *s)
{
    s->session = r->cursor.session;
    for (const qdot_filled *part = qdot_record_hole(r, before, "NAME");
         part != NULL && strcmp(part->node->before, before) == 0; part = qdot_record_next(r, part, "NAME")) {
        qdot_slope_name x;
        const qdot_status status = qdot_slope_name_find(r, part, &x);

        QDOT_TRY(qdot_slope_names_take(&r->cursor, &s->names, &x, status));
    }
    return QDOT_OK;
}

/* --- how each name changes parameters and start ----------------------------------------- */

qdot_status
qdot_slope_names_put(qdot_session *session, size_t n, const qdot_slope_name *names,
                     const qdot_expr *values)
{
    for (size_t i = 0; i < n; i++) {
        const qdot_expr symbol = names[i].symbol;

        if (qdot_expr_is_class(session->pool, symbol, QDOT_PARAM))
            QDOT_TRY(qdot_session_in_domain(session, symbol, values[i]));
        QDOT_TRY(qdot_session_put(session, symbol, values[i]));
    }
    return QDOT_OK;
}

bool
qdot_slopes_is_parameter(const qdot_slopes *s, size_t k)
{
    return !qdot_session_is_start(s->session->pool, s->names.at[k].symbol);
}

/* What the session says of a symbol, where that follows the free parameter and is at its value what the
 * run had; else what the run had. */
static qdot_expr
value_with_free_parameter(qdot_session *session, const qdot_conditions *of, qdot_expr said, qdot_expr parameter,
                          qdot_expr had)
{
    qdot_pool *pool = session->pool;
    const qdot_expr now = qdot_session_bind(session, said);

    if (now == QDOT_NIL || !qdot_expr_contains(pool, now, parameter))
        return now == QDOT_NIL ? now : had;
    return qdot_substitute(pool, now, of->symbols.n, of->symbols.at, of->values.at) == had
               ? now
               : had;
}

/* All parameter values [of->symbols.n] as functions of p, number `own`, which is set to itself in
 * the session. */
static qdot_status
values_with_free_parameter(qdot_session *session, const qdot_conditions *of, qdot_expr p, size_t own, qdot_expr *values)
{
    for (size_t i = 0; i < of->symbols.n; i++) {
        const qdot_expr given = qdot_session_value_set(session, of->symbols.at[i]);

        values[i] = i == own            ? p
                    : given == QDOT_NIL ? of->values.at[i]
                                        : value_with_free_parameter(session, of, given, p, of->values.at[i]);
    }
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_slopes_free_values(qdot_session *session, const qdot_conditions *of, qdot_expr p,
                        qdot_expr *values)
{
    const size_t own = qdot_expr_place(of->symbols.n, of->symbols.at, p);
    qdot_trial trial;
    qdot_status status = QDOT_OK;

    if (own == of->symbols.n)
        return qdot_fail(QDOT_EUNSET, "%s has no value in the run",
                         qdot_expr_symbol(session->pool, p)->name);
    QDOT_TRY(qdot_trial_begin(&trial, session));
    qdot_session_set(session, p, p, &status);
    if (status == QDOT_OK)
        status = values_with_free_parameter(session, of, p, own, values);
    qdot_trial_end(&trial);
    return status;
}

/* Let parameter k vary, and find how the start depends on it. */
static qdot_status
let_parameter_vary(qdot_slopes *s, size_t k)
{
    qdot_session *session = s->session;
    qdot_pool *pool = session->pool;
    const qdot_conditions *of = s->conditions;
    const qdot_expr p = s->names.at[k].symbol;
    const size_t n = session->scene->coordinates.n,
                 own = qdot_expr_place(of->symbols.n, of->symbols.at, p);
    qdot_expr *values = s->values + k * of->symbols.n, *start = s->start + 2 * k * n;
    qdot_trial trial;
    qdot_status status = QDOT_OK;

    if (own == of->symbols.n)
        return qdot_fail(QDOT_EUNSET, "%s has no value in the run", s->names.at[k].label);
    QDOT_TRY(qdot_trial_begin(&trial, session));
    qdot_session_set(session, p, p, &status);
    if (status == QDOT_OK)
        status = values_with_free_parameter(session, of, p, own, values);
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++) {
        const qdot_expr jet =
            qdot_symbol_jet(pool, session->scene->coordinates.at[i % n], i >= n);
        const qdot_expr given = qdot_session_value_started(session, jet);

        if (given == QDOT_NIL)
            continue;
        start[i] = qdot_diff(pool,
                             value_with_free_parameter(session, of, given, p,
                                                       (i < n ? of->q0.at : of->v0.at)[i % n]),
                             p);
        start[i] = start[i] == QDOT_NIL ? start[i]
                                        : qdot_substitute(pool, start[i], of->symbols.n,
                                                          of->symbols.at, of->values.at);
    }
    if (status == QDOT_OK)
        status = qdot_start_slopes(session, &(qdot_start_slopes_of){of, p, values}, start);
    qdot_trial_end(&trial);
    QDOT_TRY(status);
    s->by[k].parameter = p;
    s->by[k].values = values;
    return qdot_pool_check(pool);
}

static qdot_status
find_directions(qdot_slopes *s)
{
    qdot_pool *pool = s->session->pool;
    const size_t n = s->session->scene->coordinates.n, m = s->conditions->symbols.n;

    s->by = qdot_calloc(s->names.n + 1, sizeof *s->by);
    s->values = qdot_calloc(s->names.n * m + 1, sizeof *s->values);
    s->start = qdot_calloc(s->names.n * 2 * n + 1, sizeof *s->start);
    if (!s->by || !s->values || !s->start)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < s->names.n; k++) {
        qdot_expr *start = s->start + 2 * k * n;

        for (size_t i = 0; i < 2 * n; i++)
            start[i] = s->names.at[k].symbol ==
                               qdot_symbol_jet(
                                   pool, s->session->scene->coordinates.at[i % n], i >= n)
                           ? QDOT_ONE
                           : QDOT_ZERO;
        s->by[k] = (qdot_variation_by){
            .name = s->names.at[k].label, .parameter = QDOT_NIL, .start = start};
        if (qdot_slopes_is_parameter(s, k))
            QDOT_TRY(let_parameter_vary(s, k));
        else
            QDOT_TRY(qdot_start_slopes(s->session, &(qdot_start_slopes_of){s->conditions, s->names.at[k].symbol, NULL}, start));
    }
    return qdot_pool_check(pool);
}

/* Find scales of the state from the run, if the sizes of its components differ much, and of the directions. */
static qdot_status
find_scales(qdot_slopes *s)
{
    qdot_session *session = s->session;
    const size_t n = session->scene->coordinates.n;
    qdot_expr *jets = qdot_calloc(2 * n + 1, sizeof *jets);
    qdot_status status;

    s->scales = qdot_calloc(2 * n + 1, sizeof *s->scales);
    status = jets != NULL && s->scales != NULL ? QDOT_OK : QDOT_ENOMEM;
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++)
        jets[i] = qdot_symbol_jet(session->pool, session->scene->coordinates.at[i % n], i >= n);
    if (status == QDOT_OK)
        status = qdot_sizes_along(s->run, 2 * n, jets, s->scales);
    if (status == QDOT_OK && qdot_sizes_are_apart(2 * n, s->scales))
        s->request.scales = s->scales;
    for (size_t k = 0; k < s->names.n && status == QDOT_OK; k++) {
        const size_t i = qdot_expr_place(2 * n, jets, s->names.at[k].symbol),
                     own = qdot_expr_place(s->conditions->symbols.n, s->conditions->symbols.at, s->names.at[k].symbol);

        if (i < 2 * n && s->request.scales != NULL)
            s->by[k].scale = s->scales[i];
        else if (i == 2 * n && own < s->conditions->symbols.n)
            status = qdot_session_number(session, s->conditions->values.at[own], &s->by[k].scale, NULL);
        s->by[k].scale = fabs(s->by[k].scale);
    }
    qdot_free(jets);
    return status;
}

/* Find the start of the run after its projection onto the constraints. */
static qdot_status
find_start(qdot_slopes *s, const char *name)
{
    qdot_session *session = s->session;
    const size_t n = session->scene->coordinates.n;
    qdot_measured m;

    s->settled = qdot_calloc(2 * n + 1, sizeof *s->settled);
    if (!s->settled)
        return QDOT_ENOMEM;
    if (session->scene->constraints.n == 0)
        return QDOT_OK;
    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_expr jet =
            qdot_symbol_jet(session->pool, session->scene->coordinates.at[i % n], i >= n);

        QDOT_TRY(qdot_runs_measure_one(session, name, jet, s->conditions->t0, &m));
        s->settled[i] =
            m.digits > 0 ? m.exact : qdot_measured_rational(session->pool, m.value);
    }
    s->request.q0 = s->settled;
    s->request.v0 = s->settled + n;
    return qdot_pool_check(session->pool);
}

/* --- the run with derivatives ------------------------------------------------------------- */

static qdot_status
find_run(qdot_slopes *s, const char *name)
{
    const qdot_run_report *report;
    qdot_named_run *named;

    QDOT_TRY(qdot_runs_find(s->session, name, &named));
    report = qdot_run_get_report(named->run);
    if (report->status == QDOT_RUN_FAILED)
        return qdot_fail(QDOT_EINVAL, "the run %.100s failed: it has no slopes",
                         named->name);
    if (named->conditions->version != s->session->scene->version) {
        (void)qdot_fail(QDOT_EINVAL, "the scene has changed since %.100s", named->name);
        return qdot_hint("make the run once more before: %.200s", named->text);
    }
    s->conditions = named->conditions;
    s->run = named->run;
    s->request = qdot_conditions_request(named->conditions);
    s->request.method = report->method;
    s->request.tol = report->tol;
    s->request.digits = report->digits;
    s->request.treatment = report->treatment;
    if (report->status == QDOT_RUN_STOPPED)
        s->request.t1 = qdot_measured_rational(s->session->pool, report->t1);
    return qdot_pool_check(s->session->pool);
}

/* The time up to which the run is needed to differentiate one of its results; nil: the whole run. */
static qdot_expr
find_time_needed(qdot_slopes *s, const qdot_measured *m)
{
    qdot_pool *pool = s->session->pool;

    switch (m->origin.kind) {
    case QDOT_ORIGIN_VALUE:
        return qdot_session_bind(s->session,
                                 qdot_measured_as_rationals(s->session, m->origin.time));
    case QDOT_ORIGIN_RANGE:
        return qdot_measured_rational(
            pool, qdot_run_get_report(s->run)->t1 < qdot_run_get_report(s->run)->t0
                      ? fmin(m->origin.ends[0], m->origin.ends[1])
                      : fmax(m->origin.ends[0], m->origin.ends[1]));
    case QDOT_ORIGIN_EVENT:
        return m->digits > 0 ? m->exact : qdot_measured_rational(pool, m->value);
    default: return QDOT_NIL;
    }
}

typedef qdot_vec(size_t) indices;

/* Of the numbers measured from the first-th on the values and those over ranges: what other numbers may stand in. Few
 * of many, where events without end are measured too. */
static qdot_status
find_result_indices(const qdot_slopes *s, size_t first, indices *values)
{
    for (size_t i = first; i < s->session->measured->n; i++)
        if (s->session->measured->at[i].origin.kind == QDOT_ORIGIN_VALUE ||
            s->session->measured->at[i].origin.kind == QDOT_ORIGIN_RANGE)
            QDOT_TRY(qdot_vec_push(values, i));
    return QDOT_OK;
}

/* Whether the symbol occurs in e, or in the expressions and times from which the listed results were read. */
static bool
symbol_is_used(const qdot_slopes *s, qdot_expr e, const indices *values, qdot_expr symbol)
{
    const qdot_pool *pool = s->session->pool;
    bool used = qdot_expr_contains(pool, e, symbol);

    for (size_t i = 0; i < values->n && !used; i++) {
        const qdot_origin *of = &s->session->measured->at[values->at[i]].origin;

        if (of->kind == QDOT_ORIGIN_VALUE)
            used = qdot_expr_contains(pool, of->e, symbol) || qdot_expr_contains(pool, of->time, symbol);
        for (int end = 0; end < 2 && of->kind == QDOT_ORIGIN_RANGE && !used; end++)
            used = of->said[end] != QDOT_NIL && qdot_expr_contains(pool, of->said[end], symbol);
    }
    return used;
}

/* How far from its start the run is needed for the numbers measured from index `first` on;
 * infinite: all of it. */
static qdot_status
find_latest_needed_time(qdot_slopes *s, qdot_expr e, size_t first, const indices *values, double *furthest)
{
    const double t0 = qdot_run_get_report(s->run)->t0;

    *furthest = 0;
    for (size_t i = first; i < s->session->measured->n; i++) {
        const qdot_measured m = s->session->measured->at[i];
        qdot_expr time;
        double t;

        if (!symbol_is_used(s, e, values, m.symbol))
            continue;
        time = find_time_needed(s, &m);
        QDOT_TRY(qdot_pool_check(s->session->pool));
        if (time == QDOT_NIL) {
            *furthest = INFINITY;
            return QDOT_OK;
        }
        QDOT_TRY(qdot_session_number(s->session, time, &t, NULL));
        *furthest = fmax(*furthest, fabs(t - t0));
    }
    return QDOT_OK;
}

/* Shorten the run with variational equations to the last time that the numbers measured from index
 * `first` on need. */
static qdot_status
shorten_run(qdot_slopes *s, qdot_expr e, size_t first)
{
    const qdot_run_report *report = qdot_run_get_report(s->run);
    const double whole = report->t1 - report->t0;
    indices values = {0};
    double furthest = 0, length;
    qdot_status status = find_result_indices(s, first, &values);

    if (status == QDOT_OK)
        status = find_latest_needed_time(s, e, first, &values, &furthest);
    qdot_free(values.at);
    QDOT_TRY(status);
    length = furthest + beyond * fabs(whole);
    if (furthest > 0 && length < fabs(whole))
        s->request.t1 =
            qdot_measured_rational(s->session->pool, report->t0 + copysign(length, whole));
    return qdot_pool_check(s->session->pool);
}

/* Whether two values of a coordinate agree within their errors, so that both may come from the same motion. */
static bool
agree_within_errors(const double *value, const double *error)
{
    const double size = fmax(fabs(value[0]), fabs(value[1])), off = error[0] + error[1];

    return fabs(value[0] - value[1]) <= apart * size + (isnan(off) ? apart : 100 * off);
}

/* Both runs end at one place: where a run slides, rests, or has gone on in other coordinates, that with
 * slopes may not. */
static qdot_status
compare_ends(qdot_slopes *s, qdot_run *run)
{
    const qdot_scene *scene = s->session->scene;
    const double t = qdot_run_get_report(run)->t1;
    double value[2], error[2];

    for (size_t i = 0; i < scene->coordinates.n; i++) {
        const qdot_expr q = scene->coordinates.at[i];

        QDOT_TRY(qdot_run_values(s->run, 1, &q, 1, &t, value, error));
        QDOT_TRY(qdot_run_values(run, 1, &q, 1, &t, value + 1, error + 1));
        if (!agree_within_errors(value, error))
            return qdot_fail(QDOT_EFAILED,
                             "the run with slopes goes another way: %.80s = %.6g at t = "
                             "%.6g, not %.6g",
                             qdot_expr_symbol(scene->pool, q)->name, value[1], t,
                             value[0]);
    }
    return QDOT_OK;
}

qdot_status
qdot_slopes_make(qdot_slopes *s, const char *name, qdot_expr e, size_t first)
{
    qdot_run_request request;
    qdot_run *run = NULL;
    qdot_status status;

    QDOT_TRY(find_run(s, name));
    QDOT_TRY(shorten_run(s, e, first));
    QDOT_TRY(find_directions(s));
    QDOT_TRY(find_start(s, name));
    QDOT_TRY(find_scales(s));
    QDOT_TRY(qdot_variation_make(s->session->scene, &s->request, s->names.n, s->by, true,
                                 &s->variation));
    request = qdot_variation_request(&s->variation);
    status = qdot_run_new(s->variation.scene, &request, &run);
    if (status != QDOT_OK) {
        qdot_run_free(run);
        return status;
    }
    QDOT_TRY(qdot_runs_keep(s->session, qdot_slopes_run, "", &request, run));
    if (qdot_run_get_report(run)->status == QDOT_RUN_FAILED)
        return qdot_fail(QDOT_EFAILED,
                         qdot_slides_in_contact(s->run)
                             ? "not built yet: slopes through a contact that lasts: %.300s"
                             : "the run with slopes failed: %.300s",
                         qdot_run_get_report(run)->reason);
    QDOT_TRY(qdot_variation_check_start(&s->variation, run));
    return compare_ends(s, run);
}

void
qdot_slopes_free(qdot_slopes *s)
{
    qdot_session *session = s->session;

    if (session && session->runs->n > 0 &&
        strcmp(session->runs->at[session->runs->n - 1].name, qdot_slopes_run) == 0)
        qdot_named_run_release(&session->runs->at[--session->runs->n]);
    qdot_variation_clear(&s->variation);
    for (size_t i = 0; i < s->names.n; i++)
        qdot_free(s->names.at[i].label);
    qdot_free(s->names.at);
    qdot_free(s->by);
    qdot_free(s->values);
    qdot_free(s->start);
    qdot_free(s->settled);
    qdot_free(s->scales);
    *s = (qdot_slopes){0};
}
