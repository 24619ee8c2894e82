/* modes.c -- the statement `modes`: frequencies and amplitudes of small oscillations about an equilibrium or
 * a steady motion. */
#include <math.h>
#include <stdio.h>

#include "base/number-text.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/functions/equilibria.h"
#include "lang/session/bind.h"
#include "lang/session/history.h"
#include "lang/session/output.h"
#include "lang/session/phase.h"
#include "lang/session/units.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_modes(qdot_record *r);

QDOT_STATEMENT(modes) = {
    .word = "modes",
    .group = QDOT_ASKING,
    .usage = "modes [at EQUILIBRIUM]",
    .summary = "normal modes about an equilibrium or a steady motion: frequencies and amplitudes",
    .example = "modes at equilibria[2]",
    .alone = true,
    .linear = true,
    .handler = carry_out_modes,
};

/* Append a number found numerically. */
static qdot_status
append_number(qdot_session *session, qdot_expr value, qdot_text *line)
{
    double x;

    QDOT_TRY(qdot_session_number(session, value, &x, NULL));
    qdot_number_text(line, x, 1e-13 * fabs(x));
    return QDOT_OK;
}

/* Print an exact value as an expression, or a number found numerically, of a complex amplitude [re, im]; in JSON without an
 * error. */
static qdot_status
answer_frequency_or_amplitude(qdot_session *session, bool numeric, const char *name, qdot_expr value)
{
    const bool pair = qdot_expr_kind(session->pool, value) == QDOT_LIST;
    qdot_text line = {0};
    double x;
    qdot_status status = QDOT_OK;

    if (!numeric || (pair && session->output->json))
        return qdot_answer_expr(session, name, value);
    if (session->output->json) {
        QDOT_TRY(qdot_session_number(session, value, &x, NULL));
        return qdot_answer_number(session, name, x, NAN);
    }
    qdot_text_format(&line, pair ? "%s = [" : "%s = ", name);
    for (uint32_t k = 0; pair && k < 2 && status == QDOT_OK; k++) {
        qdot_text_add(&line, k == 0 ? "" : ", ");
        status = append_number(session, qdot_expr_arg(session->pool, value, k), &line);
    }
    if (!pair)
        status = append_number(session, value, &line);
    qdot_text_add(&line, pair ? "]" : "");
    if (session->output->unit != NULL)
        qdot_text_format(&line, " [%s]", session->output->unit);
    return qdot_answer_written(session, name, status, &line);
}

static qdot_status
answer_modes(qdot_session *session, const qdot_modes *modes)
{
    size_t n = session->scene->coordinates.n;

    for (size_t k = 0; k < modes->n; k++) {
        char name[400];
        qdot_status status;

        snprintf(name, sizeof name, "modes[%zu]", k + 1);
        if (qdot_units_on(session) &&
            (modes->numeric || session->output->json || qdot_expr_is_constant(session->pool, modes->frequency[k])))
            session->output->unit = "rad/s";
        status = answer_frequency_or_amplitude(session, modes->numeric, name, modes->frequency[k]);
        session->output->unit = NULL;
        QDOT_TRY(status);
        for (size_t i = 0; i < n; i++) {
            snprintf(
                name, sizeof name, "modes[%zu, %.300s]", k + 1,
                qdot_expr_symbol(session->pool, session->scene->coordinates.at[i])->name);
            QDOT_TRY(
                answer_frequency_or_amplitude(session, modes->numeric, name, modes->amplitude[k * n + i]));
        }
    }
    return QDOT_OK;
}

/* Read the equations after `at` that give the equilibrium, as a LIST. */
static qdot_status
read_equilibrium(qdot_record *r, const qdot_filled *place, qdot_expr *at)
{
    qdot_pool *pool = r->cursor.session->pool;
    bool equations;

    QDOT_TRY(qdot_record_value(r, place, at));
    if (qdot_expr_kind(pool, *at) == QDOT_REL)
        *at = qdot_list(pool, 1, at);
    QDOT_TRY(qdot_pool_check(pool));
    equations = qdot_expr_kind(pool, *at) == QDOT_LIST;
    for (uint32_t i = 0; equations && i < qdot_expr_count(pool, *at); i++)
        equations = qdot_expr_kind(pool, qdot_expr_arg(pool, *at, i)) == QDOT_REL;
    if (equations)
        return QDOT_OK;
    qdot_record_blame(r, place);
    (void)qdot_fail(QDOT_ETYPE, "modes are asked at a list of equations");
    return qdot_hint("modes at equilibria[1]");
}

static qdot_status
carry_out_modes(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *place = qdot_record_hole(r, "at", NULL);
    qdot_expr at = QDOT_NIL, value;
    qdot_modes modes;
    qdot_status status;

    if (place != NULL)
        QDOT_TRY(read_equilibrium(r, place, &at));
    r->cursor.error_at = r->start[-1].start; /* errors point at the word `modes` */
    QDOT_TRY(qdot_equilibria_modes_at(session, at, &modes));
    value = qdot_list(session->pool, (uint32_t)modes.n, modes.frequency);
    status = qdot_pool_check(session->pool);
    if (status == QDOT_OK)
        status = qdot_vec_push(&session->history->values, value);
    session->history->modes_at = at;
    session->history->modes_version = qdot_phase_version(session);
    if (status == QDOT_OK)
        status = answer_modes(session, &modes);
    qdot_modes_clear(&modes);
    return status;
}
