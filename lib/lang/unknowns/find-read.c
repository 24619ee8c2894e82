/* find-read.c -- reads `find`: its unknowns, its conditions, the run that they are of. */
#include "lang/unknowns/find-parts.h"

#include <math.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/commands/set.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/runs/own-run.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "sim/model/simple-zeros.h"

void
qdot_find_free(qdot_find *f)
{
    for (size_t i = 0; i < f->unknowns.n; i++)
        qdot_free(f->unknowns.at[i].label);
    for (; f->pushed > 0; f->pushed--)
        qdot_names_pop(f->c->session->names);
    qdot_free(f->unknowns.at);
    qdot_free(f->guess.at);
    qdot_free(f->low.at);
    qdot_free(f->high.at);
    qdot_free(f->conditions.at);
    qdot_run_options_free(&f->run);
}

/* --- unknowns ---------------------------------------------------------------------------- */

/* Whether the name stands behind `such`. */
static bool
such_names(const qdot_cursor *c, const char *name)
{
    const qdot_token *at = qdot_cursor_find_word(c, "such");

    for (; at->kind != QDOT_TOKEN_END; at++)
        if (at->kind == QDOT_TOKEN_NAME && strcmp(at->text, name) == 0)
            return true;
    return false;
}

/* A name that is declared nowhere, and used by the conditions: bound to a symbol of its own. */
static qdot_status
read_own(qdot_cursor *c, qdot_find *f, qdot_slope_name *x)
{
    const char *name;

    *x = (qdot_slope_name){.place = c->at};
    QDOT_TRY(qdot_read_name(c, &name));
    x->label = qdot_strdup(name);
    x->symbol = qdot_symbol_get(c->session->pool, QDOT_FORMAL, name);
    if (x->label == NULL || x->symbol == QDOT_NIL)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_names_push(c->session->names, name, x->symbol));
    f->pushed++;
    return QDOT_OK;
}

static qdot_status
read_symbol(qdot_cursor *c, qdot_find *f, qdot_slope_name *x)
{
    qdot_cursor look = *c;
    const char *name;

    *x = (qdot_slope_name){.place = c->at};
    if (c->at->kind != QDOT_TOKEN_NAME)
        return qdot_cursor_expected(c, "an initial value, a parameter or a time: `find "
                                       "theta' = 0..5 such that ...`");
    if (qdot_read_name(&look, &name) == QDOT_OK &&
        qdot_names_find(c->session->names, name) == NULL &&
        qdot_cursor_is_op(&look, "=") && such_names(c, name))
        return read_own(c, f, x);
    return qdot_slope_name_read(c, x);
}

static qdot_status
read_bound(qdot_cursor *c, double *value)
{
    const qdot_token *start = c->at;
    qdot_expr e;

    QDOT_TRY(qdot_read_side(c, &e));
    c->error_at = start->start;
    QDOT_TRY(qdot_session_number(c->session, e, value, NULL));
    return isfinite(*value) ? QDOT_OK
                            : qdot_fail(QDOT_EDOMAIN, "a guess is a finite number");
}

/* `= A..B`, or `= GUESS`. */
static qdot_status
read_guess(qdot_cursor *c, qdot_find *f)
{
    const qdot_token *start;
    double low, high = INFINITY, guess;

    QDOT_TRY(qdot_cursor_expect_op(c, "="));
    start = c->at;
    QDOT_TRY(read_bound(c, &low));
    guess = low;
    if (qdot_cursor_accept_op(c, "..")) {
        QDOT_TRY(read_bound(c, &high));
        guess = low + (high - low) / 2;
        c->error_at = start->start;
        if (!(low < high))
            return qdot_fail(QDOT_EINVAL, "nothing lies between %.10g and %.10g", low,
                             high);
    } else {
        low = -INFINITY;
    }
    QDOT_TRY(qdot_vec_push(&f->guess, guess));
    QDOT_TRY(qdot_vec_push(&f->low, low));
    return qdot_vec_push(&f->high, high);
}

static qdot_status
read_unknowns(qdot_cursor *c, qdot_find *f)
{
    do {
        qdot_slope_name x;
        const qdot_status status = read_symbol(c, f, &x);

        QDOT_TRY(qdot_slope_names_take(c, &f->unknowns, &x, status));
        QDOT_TRY(read_guess(c, f));
    } while (qdot_cursor_accept_op(c, ","));
    return QDOT_OK;
}

/* --- conditions ---------------------------------------------------------------------------- */

static bool
ends(const qdot_cursor *c)
{
    return qdot_cursor_is_end(c) || qdot_cursor_is_word(c, "run") ||
           qdot_cursor_is_word(c, "as");
}

/* Step over the conditions; they are read when there is a run. */
static qdot_status
find_conditions(qdot_cursor *c, qdot_find *f)
{
    do {
        qdot_find_condition x = {.from = c->at,
                                 .returns = qdot_cursor_is_word(c, "returns")};
        int depth = 0;

        while (depth > 0 ? !qdot_cursor_is_end(c)
                         : !ends(c) && !qdot_token_is(c->at, ",") &&
                               !qdot_cursor_is_word(c, "and"))
            depth += qdot_token_bracket(c->at++);
        if (c->at == x.from)
            return qdot_cursor_expected(
                c, "a condition: `value(theta, 3) = 0` or `returns after T`");
        x.to = c->at;
        f->returns = f->returns || x.returns;
        QDOT_TRY(qdot_vec_push(&f->conditions, x));
    } while (qdot_cursor_accept_op(c, ",") || qdot_cursor_accept_word(c, "and"));
    return QDOT_OK;
}

/* Behind the conditions: `run T0..T1 [options]`, or `as NAME`. */
static qdot_status
read_run(qdot_cursor *c, qdot_find *f)
{
    const qdot_token *start = c->at;
    qdot_named_run *named;

    if (qdot_cursor_accept_word(c, "run")) {
        f->run_at = start;
        QDOT_TRY(qdot_read_range(c, &f->run.from, &f->run.to));
        QDOT_TRY(qdot_run_options_read(c, start, &f->run));
        c->error_at = start->start;
        return f->run.digits == 0
                   ? QDOT_OK
                   : qdot_fail(QDOT_ENOTBUILT, "not built yet: find with `digits`");
    }
    if (qdot_cursor_accept_word(c, "as"))
        QDOT_TRY(qdot_read_name(c, &f->run.name));
    QDOT_TRY(qdot_cursor_expect_end(c));
    if (c->session->runs.n == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_runs_find(c->session, NULL, &named));
    if (named->conditions->version != c->session->scene->version)
        return QDOT_OK;
    f->latest = qdot_run_get_report(named->run);
    f->latest_from = named->conditions->t0;
    f->latest_to = named->conditions->t1;
    f->run.tol = f->latest->tol;
    f->run.treatment = f->latest->treatment;
    if (f->latest->digits > 0) {
        f->run.tol = 1e-12;
        return qdot_answer_notice(c->session, "%s has %d digits; what is found has those of doubles", named->name,
                                  f->latest->digits);
    }
    f->run.method = f->latest->method;
    return QDOT_OK;
}

/* --- limits ---------------------------------------------------------------------------------- */

/* T of `returns after T`. */
static qdot_status
read_period(const qdot_find *f, const qdot_find_condition *x, qdot_expr *T)
{
    qdot_cursor own = *f->c;
    qdot_status status = QDOT_OK;

    own.at = x->from + 1;
    if (!qdot_cursor_accept_word(&own, "after"))
        status = qdot_cursor_expected(&own, "`after` and a time: `returns after T`");
    if (status == QDOT_OK)
        status = qdot_read_scalar(&own, T);
    if (status == QDOT_OK && own.at != x->to)
        status = qdot_cursor_expected(&own, "`,`, `and` or the end of the condition");
    f->c->error_at = own.error_at;
    return status;
}

/* A period that is an unknown by itself stays above a quarter of its guess: after no time all returns. */
static qdot_status
bound_period(qdot_find *f)
{
    for (size_t i = 0; i < f->conditions.n; i++) {
        qdot_expr T;

        if (!f->conditions.at[i].returns)
            continue;
        QDOT_TRY(read_period(f, &f->conditions.at[i], &T));
        for (size_t k = 0; k < f->unknowns.n; k++)
            if (f->unknowns.at[k].symbol == T && isinf(f->low.at[k])) {
                const double least = f->guess.at[k] / 4;

                f->low.at[k] = least > 0 ? least : -INFINITY;
                f->high.at[k] = least < 0 ? least : INFINITY;
            }
    }
    return QDOT_OK;
}

/* Whether a condition names an event. */
static bool
names_event(const qdot_find *f)
{
    const qdot_scene *scene = f->c->session->scene;
    const qdot_token *at = f->conditions.at[0].from,
                     *to = f->conditions.at[f->conditions.n - 1].to;

    for (; at < to; at++)
        if (at->kind == QDOT_TOKEN_NAME && qdot_scene_find_event(scene, at->text) != NULL)
            return true;
    return false;
}

/* The later of two times, from a time on; nil is none. */
static qdot_status
later(qdot_session *session, qdot_expr from, qdot_expr *time, qdot_expr other)
{
    double t[3];

    if (other == QDOT_NIL || *time == QDOT_NIL) {
        *time = *time == QDOT_NIL ? other : *time;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_session_number(session, from, &t[0], NULL));
    QDOT_TRY(qdot_session_number(session, *time, &t[1], NULL));
    QDOT_TRY(qdot_session_number(session, other, &t[2], NULL));
    if (fabs(t[2] - t[0]) > fabs(t[1] - t[0]))
        *time = other;
    return QDOT_OK;
}

qdot_status
qdot_find_limits(const qdot_find *f, qdot_expr *from, qdot_expr *to)
{
    qdot_session *session = f->c->session;
    qdot_cursor look = *f->c;

    *from = f->run_at != NULL   ? f->run.from
            : f->latest != NULL ? f->latest_from
                                : QDOT_ZERO;
    *to = f->run_at != NULL && !f->returns ? f->run.to : QDOT_NIL;
    if (*to != QDOT_NIL)
        return QDOT_OK;
    for (size_t i = 0; i < f->conditions.n; i++) {
        qdot_expr T;

        if (!f->conditions.at[i].returns)
            continue;
        QDOT_TRY(read_period(f, &f->conditions.at[i], &T));
        QDOT_TRY(later(session, *from, to, qdot_add(session->pool, *from, T)));
    }
    if (f->returns)
        return qdot_pool_check(session->pool);
    look.at = f->conditions.at[0].from;
    *to = qdot_own_run_needed(&look, *from);
    if (f->latest != NULL && (*to == QDOT_NIL || names_event(f)))
        QDOT_TRY(later(session, *from, to, f->latest_to));
    if (*to != QDOT_NIL)
        return QDOT_OK;
    f->c->error_at = f->conditions.at[0].from->start;
    (void)qdot_fail(QDOT_EINVAL, "nothing says how long the run is");
    return qdot_hint("value(%.80s, 3) = 0, or `run 0..3` behind the conditions",
                     session->scene->coordinates.n > 0
                         ? qdot_expr_symbol(session->pool, session->scene->coordinates.at[0])->name
                         : "theta");
}

/* --- all of it ----------------------------------------------------------------------------- */

qdot_status
qdot_find_read(qdot_cursor *c, qdot_find *f)
{
    QDOT_TRY(read_unknowns(c, f));
    if (!qdot_cursor_accept_word(c, "such") || !qdot_cursor_accept_word(c, "that"))
        return qdot_cursor_expected(c, "`,`, or `such that` and a condition: `such that "
                                       "value(theta, 3) = 0`");
    QDOT_TRY(find_conditions(c, f));
    QDOT_TRY(read_run(c, f));
    return bound_period(f);
}

/* --- residuals ------------------------------------------------------------------------------- */

size_t
qdot_find_count(const qdot_find *f)
{
    size_t n = 0;

    for (size_t i = 0; i < f->conditions.n; i++)
        n += f->conditions.at[i].returns ? 2 * f->c->session->scene->coordinates.n : 1;
    return n;
}

/* q and q' after T less what they were. */
static qdot_status
return_residuals(const qdot_find *f, const qdot_find_condition *x, qdot_expr from,
                 qdot_expr *e)
{
    qdot_session *session = f->c->session;
    const size_t n = session->scene->coordinates.n;
    qdot_expr T;

    QDOT_TRY(read_period(f, x, &T));
    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_expr jet =
            qdot_symbol_jet(session->pool, session->scene->coordinates.at[i % n], i >= n);
        qdot_expr first, last;

        QDOT_TRY(qdot_trial_at_time(session, jet, from, &first));
        QDOT_TRY(
            qdot_trial_at_time(session, jet, qdot_add(session->pool, from, T), &last));
        e[i] = qdot_sub(session->pool, last, first);
    }
    return qdot_pool_check(session->pool);
}

static qdot_status
read_equation(qdot_cursor *own, const qdot_find_condition *x, qdot_expr *e)
{
    qdot_session *session = own->session;
    qdot_expr side[2], touching;

    QDOT_TRY(qdot_read_side(own, &side[0]));
    if (!qdot_cursor_accept_op(own, "=") && !qdot_cursor_accept_op(own, "=="))
        return qdot_cursor_expected(own, "`=`: a condition is an equation");
    QDOT_TRY(qdot_read_side(own, &side[1]));
    if (own->at != x->to)
        return qdot_cursor_expected(own,
                                    "`,`, `and`, `run T0..T1`, `as NAME` or the end");
    own->error_at = x->from->start;
    for (int i = 0; i < 2; i++) {
        if (!qdot_expr_is_scalar(session->pool, side[i]))
            return qdot_fail(QDOT_ETYPE, "a condition is between numbers");
        QDOT_TRY(qdot_trial_at_end(session, &side[i]));
    }
    /* the zero of u^9 is known to no more than the ninth root of a rounding, and u^1001 underflows beside it */
    *e = qdot_sub(session->pool, side[0], side[1]);
    touching = qdot_touching_zeros(session->pool, *e);
    *e = qdot_simple_zeros(session->pool, touching != QDOT_NIL ? touching : *e);
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_find_residuals(const qdot_find *f, qdot_expr from, qdot_expr *e)
{
    for (size_t i = 0; i < f->conditions.n; i++) {
        const qdot_find_condition *x = &f->conditions.at[i];
        qdot_cursor own = *f->c;
        qdot_status status;

        own.at = x->from;
        own.error_at = x->from->start;
        if (x->returns) {
            QDOT_TRY(return_residuals(f, x, from, e));
            e += 2 * own.session->scene->coordinates.n;
            continue;
        }
        status = read_equation(&own, x, e++);
        f->c->error_at = own.error_at;
        QDOT_TRY(status);
    }
    return QDOT_OK;
}
