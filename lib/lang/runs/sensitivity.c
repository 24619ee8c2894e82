/* sensitivity.c -- the statement `sensitivity EXPR of NAME, ...`. */
#include <math.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/answer/digits.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/runs/run-options.h"
#include "lang/runs/slopes.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"

/* --- a run for it, where there is none yet --------------------------------------------------- */

/* The name of that run. */
static const char run_name[] = "the run";

/* The time, or the end of the range A..B, at the cursor, if it is later than *latest. */
static void
read_time(qdot_cursor *c, qdot_expr *latest, double *t)
{
    qdot_expr e = QDOT_NIL;
    double x;
    qdot_status status = qdot_read_side(c, &e);

    if (status == QDOT_OK && qdot_cursor_accept_op(c, ".."))
        status = qdot_read_side(c, &e);
    if (status == QDOT_OK && qdot_session_number(c->session, e, &x, NULL) == QDOT_OK
        && fabs(x) > fabs(*t)) {
        *t = x;
        *latest = e;
    }
}

/* The latest time of `value(E, T)`, `max(E, A..B)` ... before `of`; nil: none. */
static qdot_expr
latest_time(const qdot_cursor *c)
{
    static const char *const words[] = {"value", "max", "min", "mean", "drift"};
    qdot_expr latest = QDOT_NIL;
    double t = 0;

    for (const qdot_token *at = c->at; at->kind != QDOT_TOKEN_END; at++) {
        const qdot_token *comma = NULL, *in = at + 2;
        bool is = false;

        for (size_t i = 0; i < sizeof words / sizeof *words; i++)
            is = is || (at->kind == QDOT_TOKEN_NAME && strcmp(at->text, words[i]) == 0);
        if (!is || !qdot_token_is(at + 1, "("))
            continue;
        for (int depth = 0; in->kind != QDOT_TOKEN_END && depth >= 0; in++) {
            comma = depth == 0 && qdot_token_is(in, ",") ? in : comma;
            depth += qdot_token_bracket(in);
        }
        if (comma != NULL) {
            qdot_cursor look = *c;

            look.at = comma + 1;
            read_time(&look, &latest, &t);
        }
    }
    return latest;
}

/* The run 0..T of the present values and start, for this statement alone. */
static qdot_status
make_run(qdot_cursor *c)
{
    const qdot_run_options options = {.tol = 1e-12};
    const qdot_expr end = latest_time(c);
    qdot_session *session = c->session;
    qdot_request request = {0};
    qdot_run *run = NULL;
    qdot_status status;

    if (end == QDOT_NIL)
        return QDOT_OK; /* whoever needs a run says that there is none */
    status = qdot_run_options_fill(session, &options, &request);
    if (status == QDOT_OK)
        status = qdot_request_limits(session, QDOT_ZERO, end, &request);
    if (status == QDOT_OK)
        status = qdot_request_explain(session, &request,
                                      qdot_run_new(session->scene, &request.request, &run));
    if (run != NULL && status == QDOT_OK)
        status = qdot_runs_keep(session, run_name, "", &request.request, run);
    else
        qdot_run_free(run);
    qdot_request_free(&request);
    return status;
}

static void
drop_run(qdot_session *session)
{
    if (session->runs.n > 0
        && strcmp(session->runs.at[session->runs.n - 1].name, run_name) == 0)
        qdot_named_run_release(&session->runs.at[--session->runs.n]);
}

/* --- the slopes ------------------------------------------------------------------------------ */

/* What moves is taken at the end of the run. */
static qdot_status
at_end(qdot_session *session, qdot_expr *e)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
                            QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER;
    const qdot_run_report *report;
    qdot_named_run *named;
    qdot_measured m;

    if (!qdot_expr_is_scalar(session->pool, *e))
        return qdot_fail(QDOT_ETYPE, "only a number has slopes: one component at a time");
    if (!(qdot_expr_node(session->pool, *e)->holds & moving))
        return QDOT_OK;
    QDOT_TRY(qdot_runs_find(session, NULL, &named));
    report = qdot_run_get_report(named->run);
    if (report->status == QDOT_RUN_STOPPED) {
        (void)qdot_fail(QDOT_EINVAL, "the run ended at an event: its end moves too");
        return qdot_hint("value(x, EVENT[1])");
    }
    QDOT_TRY(qdot_runs_measure_one(session, NULL, qdot_measured_as_rationals(session, *e),
                                   named->conditions->t1, &m));
    m.origin =
        (qdot_origin){.kind = QDOT_ORIGIN_VALUE, .e = *e, .time = named->conditions->t1};
    *e = qdot_measured_add(session, m);
    return qdot_pool_check(session->pool);
}

static qdot_status
answer(qdot_session *session, const char *of, const char *by, qdot_expr slope)
{
    const int digits = qdot_digits_of(session, slope);
    qdot_text name = {0};
    double value, error;
    qdot_status status;

    qdot_text_format(&name, "d(%s)/d(%s)", of, by);
    status = qdot_text_status(&name);
    if (status == QDOT_OK && digits > 0) {
        status = qdot_digits_answer(session, qdot_text_str(&name), slope, digits);
    } else if (status == QDOT_OK) {
        status = qdot_session_number(session, slope, &value, &error);
        if (status == QDOT_OK)
            status = qdot_answer_number(session, qdot_text_str(&name), value, error);
    }
    qdot_text_clear(&name);
    return status;
}

/* All slopes are found before the first is told. */
static qdot_status
tell_slopes(qdot_slopes *s, const char *of, qdot_expr e, size_t first)
{
    qdot_expr *slope = qdot_calloc(s->names.n + 1, sizeof *slope);
    qdot_status status = slope ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < s->names.n && status == QDOT_OK; k++)
        status = qdot_slopes_of(s, e, first, k, slope + k);
    for (size_t k = 0; k < s->names.n && status == QDOT_OK; k++)
        status = answer(s->session, of, s->names.at[k].label, slope[k]);
    qdot_free(slope);
    return status;
}

/* The run that the numbers in e are of; NULL: the latest. */
static const char *
run_of(const qdot_session *session, size_t first)
{
    for (size_t i = first; i < session->measured.n; i++)
        if (session->measured.at[i].origin.run != NULL)
            return session->measured.at[i].origin.run;
    return NULL;
}

/* `EXPR of NAME, ...`, then the answers. */
static qdot_status
carry_out(qdot_cursor *c, qdot_slopes *slopes, qdot_text *text)
{
    const qdot_token *start = c->at, *end;
    const size_t first = c->session->measured.n;
    qdot_expr e;

    QDOT_TRY(qdot_read_side(c, &e));
    end = c->at;
    if (!qdot_cursor_accept_word(c, "of"))
        return qdot_cursor_expected(c, "`of` and what the slopes are by: `of m, theta`");
    QDOT_TRY(qdot_slopes_read(c, slopes));
    if (!qdot_cursor_is_end(c))
        return qdot_cursor_expected(c, "`,` or the end of the statement");
    c->error_at = start->start;
    QDOT_TRY(at_end(c->session, &e));
    qdot_token_text(c->session, start, end, text);
    QDOT_TRY(qdot_text_status(text));
    QDOT_TRY(qdot_slopes_make(slopes, run_of(c->session, first), e, first));
    return tell_slopes(slopes, qdot_text_str(text), e, first);
}

qdot_status
qdot_sensitivity_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_slopes slopes = {0};
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    if (c->session->runs.n == 0) {
        status = make_run(c);
        if (status != QDOT_OK)
            c->error_at = start->start;
    }
    if (status == QDOT_OK)
        status = carry_out(c, &slopes, &text);
    qdot_text_clear(&text);
    qdot_slopes_free(&slopes);
    drop_run(c->session);
    return status;
}
