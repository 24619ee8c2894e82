/* slopes.c -- the run with its variational equations, and what its numbers give by the chain rule. */
#include "lang/runs/slopes.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/walk.h"
#include "lang/commands/set.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/runs.h"
#include "sim/model/substitute.h"
#include "sim/study/extremum.h"

/* The name of the run with slopes. */
static const char slopes_name[] = "the slopes";

/* --- names ------------------------------------------------------------------------------ */

static qdot_status
read_name(qdot_cursor *c, qdot_slope_name *x)
{
    qdot_cursor look = *c;
    const qdot_name *known = NULL;
    qdot_text text = {0};
    const char *name;

    *x = (qdot_slope_name){.place = c->at};
    if (c->at->kind != QDOT_TOKEN_NAME)
        return qdot_cursor_expected(c, "a parameter or an initial value: `of m, theta`");
    if (qdot_read_name(&look, &name) == QDOT_OK)
        known = qdot_names_find(c->session->names, name);
    QDOT_TRY(known != NULL && known->kind == QDOT_NAME_COORD
                 ? qdot_set_read_jet(c, &x->symbol)
                 : qdot_set_read_parameter(c, &x->symbol));
    qdot_token_text(c->session, x->place, c->at, &text);
    x->label = text.at;
    return qdot_text_status(&text);
}

qdot_status
qdot_slopes_read(qdot_cursor *c, qdot_slopes *s)
{
    s->session = c->session;
    do {
        qdot_slope_name x;
        qdot_status status = read_name(c, &x);

        if (status == QDOT_OK)
            status = qdot_vec_push(&s->names, x);
        if (status != QDOT_OK) {
            qdot_free(x.label);
            return status;
        }
        for (size_t i = 0; i + 1 < s->names.n; i++)
            if (s->names.at[i].symbol == x.symbol) {
                c->error_at = x.place->start;
                return qdot_fail(QDOT_EINVAL, "%s stands here twice", x.label);
            }
    } while (qdot_cursor_accept_op(c, ","));
    return QDOT_OK;
}

/* --- what each name moves --------------------------------------------------------------- */

static bool
is_parameter(const qdot_slopes *s, size_t k)
{
    return !qdot_expr_is_class(s->session->pool, s->names.at[k].symbol, QDOT_COORD);
}

/* What the session says of a symbol, where that follows the free parameter and is at its value what the
 * run had; else what the run had. */
static qdot_expr
free_value(const qdot_slopes *s, qdot_expr said, qdot_expr parameter, qdot_expr had)
{
    const qdot_conditions *of = s->conditions;
    qdot_pool *pool = s->session->pool;
    const qdot_expr now = qdot_session_bind(s->session, said);

    if (now == QDOT_NIL || !qdot_expr_contains(pool, now, parameter))
        return now == QDOT_NIL ? now : had;
    return qdot_substitute(pool, now, of->symbols.n, of->symbols.at, of->values.at) == had
               ? now
               : had;
}

/* The symbol's place in a list; n: none. */
static size_t
place_of(size_t n, const qdot_expr *list, qdot_expr symbol)
{
    size_t i = 0;

    while (i < n && list[i] != symbol)
        i++;
    return i;
}

/* Parameters with the k-th free, and how the start follows it. */
static qdot_status
free_parameter(qdot_slopes *s, size_t k)
{
    qdot_session *session = s->session;
    qdot_pool *pool = session->pool;
    const qdot_conditions *of = s->conditions;
    const qdot_expr p = s->names.at[k].symbol;
    const size_t n = session->scene->coordinates.n,
                 own = place_of(of->symbols.n, of->symbols.at, p);
    qdot_expr *values = s->values + k * of->symbols.n, *start = s->start + 2 * k * n;
    qdot_kept_values kept;
    qdot_status status = QDOT_OK;

    if (own == of->symbols.n)
        return qdot_fail(QDOT_EUNSET, "%s has no value in the run", s->names.at[k].label);
    QDOT_TRY(qdot_session_keep_values(session, &kept));
    qdot_session_set(session, p, p, &status);
    for (size_t i = 0; i < of->symbols.n && status == QDOT_OK; i++) {
        const size_t at =
            place_of(session->set_symbols.n, session->set_symbols.at, of->symbols.at[i]);

        values[i] = i == own ? p
                    : at == session->set_symbols.n
                        ? of->values.at[i]
                        : free_value(s, session->set_values.at[at], p, of->values.at[i]);
    }
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++) {
        const qdot_expr jet =
            qdot_symbol_jet(pool, session->scene->coordinates.at[i % n], i >= n);
        const size_t at =
            place_of(session->start_symbols.n, session->start_symbols.at, jet);

        if (at == session->start_symbols.n)
            continue;
        start[i] = qdot_diff(pool,
                             free_value(s, session->start_values.at[at], p,
                                        (i < n ? of->q0.at : of->v0.at)[i % n]),
                             p);
        start[i] = start[i] == QDOT_NIL ? start[i]
                                        : qdot_substitute(pool, start[i], of->symbols.n,
                                                          of->symbols.at, of->values.at);
    }
    qdot_session_restore_values(session, &kept);
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
        if (is_parameter(s, k))
            QDOT_TRY(free_parameter(s, k));
    }
    return qdot_pool_check(pool);
}

/* The start as constraints left it. */
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

/* --- the run ------------------------------------------------------------------------------ */

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
    s->request.tol = report->tol;
    s->request.digits = report->digits;
    s->request.treatment = report->treatment;
    if (report->status == QDOT_RUN_STOPPED)
        s->request.t1 = qdot_measured_rational(s->session->pool, report->t1);
    return qdot_pool_check(s->session->pool);
}

qdot_status
qdot_slopes_make(qdot_slopes *s, const char *name)
{
    qdot_run_request request;
    qdot_run *run = NULL;
    qdot_status status;

    QDOT_TRY(find_run(s, name));
    QDOT_TRY(find_directions(s));
    QDOT_TRY(find_start(s, name));
    QDOT_TRY(qdot_variation_make(s->session->scene, &s->request, s->names.n, s->by,
                                 &s->variation));
    request = qdot_variation_request(&s->variation);
    status = qdot_run_new(s->variation.scene, &request, &run);
    if (status != QDOT_OK) {
        qdot_run_free(run);
        return status;
    }
    QDOT_TRY(qdot_runs_keep(s->session, slopes_name, "", &request, run));
    if (qdot_run_get_report(run)->status == QDOT_RUN_FAILED)
        return qdot_fail(QDOT_EFAILED, "the run with slopes failed: %.300s",
                         qdot_run_get_report(run)->reason);
    return qdot_variation_check_start(&s->variation, run);
}

void
qdot_slopes_free(qdot_slopes *s)
{
    qdot_session *session = s->session;

    if (session && session->runs.n > 0 &&
        strcmp(session->runs.at[session->runs.n - 1].name, slopes_name) == 0)
        qdot_named_run_release(&session->runs.at[--session->runs.n]);
    qdot_variation_clear(&s->variation);
    for (size_t i = 0; i < s->names.n; i++)
        qdot_free(s->names.at[i].label);
    qdot_free(s->names.at);
    qdot_free(s->by);
    qdot_free(s->values);
    qdot_free(s->start);
    qdot_free(s->settled);
    *s = (qdot_slopes){0};
}

/* --- numbers ------------------------------------------------------------------------------- */

/* An expression of the scene with slopes at a time, as a number. */
static qdot_status
at_time(qdot_slopes *s, qdot_expr e, qdot_expr time, qdot_expr *value)
{
    qdot_measured m = {0};

    QDOT_TRY(qdot_pool_check(s->session->pool));
    if (e == QDOT_ZERO) {
        *value = e;
        return QDOT_OK;
    }
    if (qdot_expr_node(s->session->pool, e)->holds & QDOT_HAS_MULTIPLIER)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of multipliers");
    QDOT_TRY(qdot_runs_measure_one(s->session, slopes_name, e, time, &m));
    *value = qdot_measured_add(s->session, m);
    return qdot_pool_check(s->session->pool);
}

/* D of what is e in the scene given; numbers of runs in e are constants of it. */
static qdot_expr
slope_along(const qdot_slopes *s, qdot_expr e, size_t k)
{
    return qdot_variation_of(&s->variation, qdot_measured_as_rationals(s->session, e), k);
}

/* value(e, time) */
static qdot_status
slope_of_value(qdot_slopes *s, const qdot_measured *m, size_t first, size_t k,
               qdot_expr *slope)
{
    qdot_pool *pool = s->session->pool;
    qdot_expr time, rate, sum = QDOT_ZERO;

    QDOT_TRY(at_time(s, slope_along(s, m->origin.e, k), m->origin.time, slope));
    QDOT_TRY(qdot_slopes_of(s, m->origin.time, first, k, &time));
    if (time != QDOT_ZERO) {
        rate = qdot_variation_rate(&s->variation,
                                   qdot_measured_as_rationals(s->session, m->origin.e));
        QDOT_TRY(at_time(s, rate, m->origin.time, &rate));
        sum = qdot_mul(pool, rate, time);
    }
    for (size_t i = first;
         i < s->session->measured.n && s->session->measured.at[i].symbol != m->symbol;
         i++) {
        const qdot_measured *inner = &s->session->measured.at[i];
        qdot_expr by, one;

        if (!qdot_expr_contains(pool, m->origin.e, inner->symbol))
            continue;
        by = qdot_measured_as_rationals(s->session,
                                        qdot_diff(pool, m->origin.e, inner->symbol));
        QDOT_TRY(at_time(s, by, m->origin.time, &by));
        QDOT_TRY(qdot_slopes_of(s, s->session->measured.at[i].symbol, first, k, &one));
        sum = qdot_add(pool, sum, qdot_mul(pool, by, one));
    }
    *slope = qdot_add(pool, *slope, sum);
    return qdot_pool_check(pool);
}

static qdot_status
slope_of_event(qdot_slopes *s, const qdot_measured *m, size_t k, qdot_expr *slope)
{
    qdot_pool *pool = s->session->pool;
    const qdot_event *event = qdot_scene_find_event(s->session->scene, m->origin.event);
    qdot_expr g, time, up, down;

    if (event == NULL)
        return qdot_fail(QDOT_ENAME, "there is no event %.100s any more",
                         m->origin.event);
    g = qdot_sub(pool, event->left, event->right);
    /* just before it, where it changes the state */
    time = m->digits > 0 ? m->exact
           : event->targets.n > 0
               ? qdot_measured_rational(pool, m->value - fmax(1, fabs(m->value)) * 4 *
                                                             DBL_EPSILON)
               : qdot_measured_rational(pool, m->value);
    QDOT_TRY(at_time(s, qdot_variation_of(&s->variation, g, k), time, &up));
    QDOT_TRY(at_time(s, qdot_variation_rate(&s->variation, g), time, &down));
    *slope = qdot_neg(pool, qdot_div(pool, up, down));
    return qdot_pool_check(pool);
}

/* max, min: De where e is largest or least. */
static qdot_status
slope_of_extremum(qdot_slopes *s, const qdot_measured *m, qdot_run *run, size_t k,
                  qdot_expr *slope)
{
    qdot_extremum x = {.run = run,
                       .kind = m->origin.range,
                       .from = m->origin.ends[0],
                       .to = m->origin.ends[1]};
    double t;

    x.e = qdot_substitute(s->session->pool, m->origin.e, s->request.n_values,
                          s->request.symbols, s->request.values);
    x.rate = qdot_variation_rate(&s->variation, m->origin.e);
    x.bend = qdot_variation_rate(&s->variation, x.rate);
    QDOT_TRY(qdot_pool_check(s->session->pool));
    QDOT_TRY(qdot_extremum_time(&x, &t));
    return at_time(s, slope_along(s, m->origin.e, k),
                   qdot_measured_rational(s->session->pool, t), slope);
}

static qdot_status
slope_of_range(qdot_slopes *s, const qdot_measured *m, size_t k, qdot_expr *slope)
{
    double value, error;
    qdot_named_run *named;
    qdot_expr e;

    if (m->origin.range == QDOT_RANGE_DRIFT)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of drift");
    QDOT_TRY(qdot_runs_find(s->session, slopes_name, &named));
    if (m->origin.range != QDOT_RANGE_MEAN)
        return slope_of_extremum(s, m, named->run, k, slope);
    e = slope_along(s, m->origin.e, k);
    QDOT_TRY(qdot_pool_check(s->session->pool));
    QDOT_TRY(qdot_run_range(named->run, QDOT_RANGE_MEAN, e, m->origin.ends[0],
                            m->origin.ends[1], &value, &error));
    *slope = qdot_measured_new(s->session, value, error);
    return qdot_pool_check(s->session->pool);
}

/* The slope of the i-th number measured. */
static qdot_status
slope_of_number(qdot_slopes *s, size_t i, size_t first, size_t k, qdot_expr *slope)
{
    const qdot_measured m = s->session->measured.at[i]; /* the list grows */
    qdot_named_run *named;

    if (i < first || m.origin.kind == QDOT_ORIGIN_OTHER)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of numbers other than "
                                         "value, max, min, mean and event times");
    if (m.origin.run != NULL) {
        QDOT_TRY(qdot_runs_find(s->session, m.origin.run, &named));
        if (named->run != s->run)
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of several runs");
    }
    switch (m.origin.kind) {
    case QDOT_ORIGIN_EVENT: return slope_of_event(s, &m, k, slope);
    case QDOT_ORIGIN_RANGE: return slope_of_range(s, &m, k, slope);
    default: return slope_of_value(s, &m, first, k, slope);
    }
}

qdot_status
qdot_slopes_of(qdot_slopes *s, qdot_expr e, size_t first, size_t k, qdot_expr *slope)
{
    const qdot_conditions *of = s->conditions;
    qdot_pool *pool = s->session->pool;
    const size_t n = s->session->measured.n;
    qdot_expr sum = QDOT_ZERO;

    if (qdot_member_any(s->session, e)) {
        (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of RUN.EXPR");
        return qdot_hint("value(RUN.x, T), max(RUN.x, A..B)");
    }
    if (s->by[k].parameter != QDOT_NIL) {
        sum = qdot_diff(
            pool,
            qdot_substitute(pool, e, of->symbols.n, of->symbols.at, s->by[k].values),
            s->by[k].parameter);
        sum = sum == QDOT_NIL ? sum
                              : qdot_substitute(pool, sum, of->symbols.n, of->symbols.at,
                                                of->values.at);
    }
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        const qdot_expr symbol = s->session->measured.at[i].symbol;
        qdot_expr one;

        if (!qdot_expr_contains(pool, e, symbol))
            continue;
        QDOT_TRY(slope_of_number(s, i, first, k, &one));
        sum = qdot_add(pool, sum, qdot_mul(pool, qdot_diff(pool, e, symbol), one));
    }
    *slope = sum;
    return qdot_pool_check(pool);
}
