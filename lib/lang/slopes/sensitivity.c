/* sensitivity.c -- the statement `sensitivity EXPR of NAME, ...`: derivatives of results of runs by parameters and start
 * values. */
#include "expr/build.h"
#include "expr/node.h"
#include "lang/answer/answer.h"
#include "lang/answer/digits.h"
#include "lang/language/token-text.h"
#include "lang/runs/run-options.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "lang/slopes/slopes.h"
#include "lang/syntax/record-times.h"

static qdot_status carry_out_sensitivity(qdot_record *r);

QDOT_STATEMENT(sensitivity) = {
    .word = "sensitivity",
    .group = QDOT_NUMBERS,
    .usage = "sensitivity EXPR of NAME, ...",
    .summary = "derivatives of a number of a run by parameters and initial values (theta, theta'), each with its "
               "error, by the variational equations",
    .example = "sensitivity value(theta, 20) of m, L, theta",
    .handler = carry_out_sensitivity,
};

/* --- computing the slopes -------------------------------------------------------------------- */

/* The slope of e by a name, whose label `of` e has: in the unit of e/symbol. */
static qdot_status
answer_sensitivity(qdot_session *session, const char *of, qdot_expr e, const qdot_slope_name *by, qdot_expr slope)
{
    const qdot_expr quotient = qdot_div(session->pool, e, by->symbol);
    const int digits = qdot_digits_of(session, slope);
    qdot_text name = {0};
    double value, error;
    qdot_status status;

    qdot_text_format(&name, "d(%s)/d(%s)", of, by->label);
    status = qdot_text_status(&name);
    if (status == QDOT_OK && digits > 0) {
        status = qdot_digits_answer(session, qdot_text_str(&name), slope, digits);
    } else if (status == QDOT_OK) {
        status = qdot_session_number(session, slope, &value, &error);
        if (status == QDOT_OK)
            status = qdot_answer_quantity(session, qdot_text_str(&name), quotient, value, error);
    }
    qdot_text_clear(&name);
    return status;
}

/* Answer all sensitivities of the expression e; all are computed before the first one is printed. */
static qdot_status
answer_sensitivities(qdot_slopes *s, const char *of, qdot_expr e, size_t first)
{
    qdot_expr *slope = qdot_calloc(s->names.n + 1, sizeof *slope);
    qdot_status status = slope ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < s->names.n && status == QDOT_OK; k++)
        status = qdot_slopes_of(s, e, first, k, slope + k);
    for (size_t k = 0; k < s->names.n && status == QDOT_OK; k++)
        status = answer_sensitivity(s->session, of, e, &s->names.at[k], slope[k]);
    qdot_free(slope);
    return status;
}

/* The run from which the results in e come, among the session's results from index `first` on; NULL: the latest. */
static const char *
find_run_of_results(const qdot_session *session, size_t first)
{
    for (size_t i = first; i < session->measured->n; i++)
        if (session->measured->at[i].origin.run != NULL)
            return session->measured->at[i].origin.run;
    return NULL;
}

/* Compute the sensitivities, then print the answers. */
static qdot_status
compute_and_answer(qdot_record *r, qdot_slopes *slopes, qdot_text *text)
{
    const qdot_filled *part = qdot_record_hole(r, NULL, "EXPR");
    qdot_session *session = r->cursor.session;
    const size_t first = session->measured->n;
    qdot_expr e;

    QDOT_TRY(qdot_record_value(r, part, &e));
    QDOT_TRY(qdot_slopes_find(r, "of", slopes));
    r->cursor.error_at = r->start->start;
    if (!qdot_expr_is_scalar(session->pool, e))
        return qdot_fail(QDOT_ETYPE, "only a number has slopes: one component at a time");
    QDOT_TRY(qdot_slopes_at_end(session, &e));
    qdot_token_text(session, part->from, part->to, text);
    QDOT_TRY(qdot_text_status(text));
    QDOT_TRY(qdot_slopes_make(slopes, find_run_of_results(session, first), e, first));
    return answer_sensitivities(slopes, qdot_text_str(text), e, first);
}

/* If the session has no run, make one with default options up to the latest time that the statement reads. */
static qdot_status
make_run_if_none(qdot_record *r, qdot_trial *trial)
{
    const qdot_run_options bare = {.tol = 1e-12};
    const qdot_expr end =
        trial->session->runs->n > 0 ? QDOT_NIL : qdot_record_farthest_time(r, r->start, QDOT_ZERO);
    qdot_status status;

    if (end == QDOT_NIL) /* without a time in the statement no run can be made; an error is reported where one is needed */
        return QDOT_OK;
    status = qdot_run_options_try(trial, &bare, QDOT_ZERO, end);
    if (status != QDOT_OK)
        r->cursor.error_at = r->start->start;
    return status;
}

static qdot_status
carry_out_sensitivity(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_slopes slopes = {0};
    qdot_text text = {0};
    qdot_trial trial;
    qdot_status status;

    QDOT_TRY(qdot_trial_begin(&trial, session));
    status = make_run_if_none(r, &trial);
    if (status == QDOT_OK)
        status = compute_and_answer(r, &slopes, &text);
    qdot_text_clear(&text);
    qdot_slopes_free(&slopes);
    qdot_trial_end(&trial);
    return status;
}
