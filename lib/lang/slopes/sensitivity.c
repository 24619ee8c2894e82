/* sensitivity.c -- the statement `sensitivity EXPR of NAME, ...`. */
#include "lang/answer/answer.h"
#include "lang/answer/digits.h"
#include "lang/commands/handlers.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/runs/own-run.h"
#include "lang/slopes/trial.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"

/* --- the slopes ------------------------------------------------------------------------------ */

static qdot_status
slope_answer(qdot_session *session, const char *of, const char *by, qdot_expr slope)
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
        status = slope_answer(s->session, of, s->names.at[k].label, slope[k]);
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
sensitivity_carry_out(qdot_cursor *c, qdot_slopes *slopes, qdot_text *text)
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
    if (!qdot_expr_is_scalar(c->session->pool, e))
        return qdot_fail(QDOT_ETYPE, "only a number has slopes: one component at a time");
    QDOT_TRY(qdot_trial_at_end(c->session, &e));
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
        const qdot_expr end = qdot_own_run_needed(c, QDOT_ZERO);

        /* without a time, whoever needs a run says that there is none */
        if (end != QDOT_NIL)
            status = qdot_own_run_make(c->session, NULL, QDOT_ZERO, end, NULL, NULL);
        if (status != QDOT_OK)
            c->error_at = start->start;
    }
    if (status == QDOT_OK)
        status = sensitivity_carry_out(c, &slopes, &text);
    qdot_text_clear(&text);
    qdot_slopes_free(&slopes);
    qdot_own_run_drop(c->session);
    return status;
}
