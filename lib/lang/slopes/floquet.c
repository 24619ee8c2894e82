/* floquet.c -- the statement `floquet`: the multipliers of a periodic orbit. */
#include "sim/study/floquet.h"

#include <math.h>
#include <stdio.h>

#include "lang/answer/answer.h"
#include "lang/answer/number-text.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"

/* How far a run may be from its start, beside max(scale, |value|), and count as an orbit. */
static const double closed = 1e-7;

static bool
is_whole(const qdot_session *session, const qdot_named_run *named)
{
    return named->conditions != NULL &&
           named->conditions->version == session->scene->version &&
           qdot_run_get_report(named->run)->status == QDOT_RUN_DONE;
}

/* The latest run that ends where it began. */
static qdot_status
find_orbit(qdot_session *session, qdot_named_run **orbit)
{
    double first = NAN;
    qdot_expr at = QDOT_NIL;
    qdot_named_run *latest;

    QDOT_TRY(qdot_runs_find(session, NULL, &latest));
    for (size_t i = session->runs.n; i-- > 0;) {
        double off;
        qdot_expr where;

        if (!is_whole(session, &session->runs.at[i]))
            continue;
        QDOT_TRY(
            qdot_floquet_return(session->scene, session->runs.at[i].run, &off, &where));
        if (off <= closed) {
            *orbit = &session->runs.at[i];
            return QDOT_OK;
        }
        if (at == QDOT_NIL) {
            first = off;
            at = where;
            latest = &session->runs.at[i];
        }
    }
    if (at == QDOT_NIL)
        (void)qdot_fail(QDOT_EINVAL, "no run of this scene is whole");
    else
        (void)qdot_fail(QDOT_EINVAL,
                        "no run ends where it began: %.80s is %.3g off in %.80s",
                        latest->name, first, qdot_expr_symbol(session->pool, at)->name);
    return qdot_hint("find x = 1, T = 2 such that returns after T");
}

static qdot_status
find_named(qdot_cursor *c, qdot_named_run **orbit)
{
    const qdot_token *start = c->at;
    const char *name;
    double off;
    qdot_expr where;

    QDOT_TRY(qdot_read_name(c, &name));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    QDOT_TRY(qdot_runs_find(c->session, name, orbit));
    if (!is_whole(c->session, *orbit))
        return qdot_fail(QDOT_EINVAL, "%s is not a whole run of this scene", name);
    QDOT_TRY(qdot_floquet_return(c->session->scene, (*orbit)->run, &off, &where));
    if (off <= closed)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "%s does not end where it began: it is %.3g off", name,
                    off);
    return qdot_hint("find x = 1, T = 2 such that returns after T");
}

/* re + im*i with one error; JSON: [re, im]. */
static qdot_status
answer_complex(qdot_session *session, const char *name, double re, double im,
               double error)
{
    qdot_text value = {0}, bound = {0};
    qdot_status status;

    if (session->json) {
        qdot_text_char(&value, '[');
        qdot_number_text_json(&value, re);
        qdot_text_char(&value, ',');
        qdot_number_text_json(&value, im);
        qdot_text_char(&value, ']');
        qdot_number_text_json(&bound, error);
    } else {
        qdot_number_text(&value, re, error);
        qdot_text_add(&value, im < 0 ? " - " : " + ");
        qdot_number_text(&value, fabs(im), error);
        qdot_text_add(&value, "*i");
        if (isnan(error)) {
            qdot_text_add(&value, " (error unknown)");
        } else {
            qdot_text_add(&value, " ± ");
            qdot_number_text_bound(&value, error);
        }
    }
    status = qdot_answer_numerals(session, name, false, &value, &bound);
    qdot_text_clear(&value);
    qdot_text_clear(&bound);
    return status;
}

static qdot_status
tell(qdot_session *session, const char *run, const qdot_floquet *x)
{
    static const char *const verdicts[] = {[QDOT_FLOQUET_STABLE] = "stable",
                                           [QDOT_FLOQUET_UNSTABLE] = "unstable",
                                           [QDOT_FLOQUET_UNDECIDED] = "undecided"};
    qdot_text text = {0};

    for (size_t k = 0; k < x->n; k++) {
        char name[40];

        snprintf(name, sizeof name, "floquet[%zu]", k + 1);
        if (x->im[k] == 0)
            QDOT_TRY(qdot_answer_number(session, name, x->re[k], x->error[k]));
        else
            QDOT_TRY(answer_complex(session, name, x->re[k], x->im[k], x->error[k]));
    }
    qdot_text_format(&text, "%s: %s", run, verdicts[x->verdict]);
    if (x->verdict == QDOT_FLOQUET_STABLE)
        qdot_text_add(&text, x->asymptotic
                                 ? ", neighbouring motions come to it"
                                 : " in linear order, multipliers on the unit circle");
    if (x->verdict == QDOT_FLOQUET_UNSTABLE)
        qdot_text_add(&text, ", a multiplier beyond the unit circle");
    if (x->verdict == QDOT_FLOQUET_UNDECIDED)
        qdot_text_add(&text,
                      ", multipliers too near to the unit circle or to each other");
    qdot_text_char(&text, '\n');
    return qdot_answer_written(session, "floquet", QDOT_OK, &text);
}

qdot_status
qdot_floquet_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_named_run *orbit = NULL;
    qdot_run_request request;
    qdot_floquet x = {0};
    qdot_status status;

    if (!qdot_cursor_is_end(c)) {
        QDOT_TRY(find_named(c, &orbit));
    } else {
        c->error_at = start->start;
        QDOT_TRY(find_orbit(c->session, &orbit));
    }
    request = qdot_conditions_request(orbit->conditions);
    request.tol = qdot_run_get_report(orbit->run)->tol;
    request.method = qdot_run_get_report(orbit->run)->method;
    request.treatment = qdot_run_get_report(orbit->run)->treatment;
    status = qdot_floquet_find(c->session->scene, orbit->run, &request, &x);
    if (status == QDOT_OK)
        status = tell(c->session, orbit->name, &x);
    qdot_floquet_clear(&x);
    return status;
}
