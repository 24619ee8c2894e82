/* run-options.c -- reads the options of a run. */
#include "lang/runs/run-options.h"

#include <inttypes.h>
#include <limits.h>

#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/commands/set.h"
#include "lang/commands/value-check.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/held.h"
#include "lang/session/values.h"

/* Append the tokens [from, to) to the text of the run's options. */
static void
add_option_text(const qdot_cursor *c, const qdot_token *from, const qdot_token *to,
                qdot_run_options *o)
{
    if (from == to)
        return;
    if (o->text.n > 0)
        qdot_text_char(&o->text, ' ');
    qdot_token_text(c->session, from, to, &o->text);
}

/* Append ` with l = 1`: the values of parameters and coordinates that loops set at present. */
static qdot_status
add_values_set_by_loops(qdot_cursor *c, qdot_run_options *o)
{
    qdot_session *session = c->session;

    QDOT_TRY(qdot_held_check(session));
    for (size_t i = 0; i < session->evaluation->held.n; i++) {
        const qdot_held *held = &session->evaluation->held.at[i];

        QDOT_TRY(qdot_pairs_push(&o->with, c->at, held->symbol, held->value));
        qdot_text_format(&o->text, "%s%s = ", i > 0 || o->with.symbols.n > 1 ? ", " : " with ",
                         qdot_expr_symbol(session->pool, held->symbol)->name);
        QDOT_TRY(qdot_print(session->pool, held->value, QDOT_PLAIN, &o->text));
    }
    return session->evaluation->held.n > 0 ? qdot_value_check(c, &o->with) : QDOT_OK;
}

/* Read one pair NAME = VALUE of the option `with`: a parameter, a coordinate or a velocity. */
static qdot_status
read_with_pair(qdot_record *r, const qdot_filled *part, qdot_pairs *with)
{
    qdot_expr symbol, value;

    QDOT_TRY(qdot_set_find_symbol(r, part, &symbol));
    /* if a run has a name, its value of any parameter can be read later, as first.n */
    if (qdot_record_word(r, "as") == NULL && !qdot_set_is_read(r, part, symbol))
        QDOT_TRY(qdot_answer_notice(r->cursor.session, "nothing in the run depends on %.100s",
                                    qdot_expr_symbol(r->cursor.session->pool, symbol)->name));
    QDOT_TRY(qdot_set_find_constant(r, qdot_record_next(r, part, "VALUE"), symbol, &value));
    qdot_record_blame(r, part);
    QDOT_TRY(qdot_session_in_domain(r->cursor.session, symbol, value));
    return qdot_pairs_push(with, part->from, symbol, value);
}

/* Read the values of a list NAME = VALUE, ... that begins with the part `first`. */
static qdot_status
read_with_list(qdot_record *r, const qdot_filled *first, const qdot_filled *to, qdot_pairs *with)
{
    for (const qdot_filled *part = first; part < to; part += 4) { /* each pair has four parts: NAME, `=`, VALUE, `,` */
        QDOT_TRY(read_with_pair(r, part, with));
        if (part + 3 >= to || !qdot_filled_is(part + 3, ","))
            break;
    }
    return qdot_value_check(&r->cursor, with);
}

static qdot_status
read_tolerance(qdot_record *r, const qdot_filled *part, qdot_run_options *o)
{
    QDOT_TRY(qdot_record_number(r, part, &o->tol));
    if (o->tol > 0 && o->tol < 1)
        return QDOT_OK;
    qdot_record_blame(r, part);
    return qdot_fail(QDOT_EINVAL, "a tolerance lies between 0 and 1");
}

/* Read how drift off the constraints is treated: project, baumgarte or none. */
static qdot_status
read_constraint_treatment(qdot_record *r, const qdot_filled *word, qdot_run_options *o)
{
    if (r->cursor.session->scene->constraints.n == 0) {
        qdot_record_blame(r, word);
        (void)qdot_fail(QDOT_EINVAL, "the scene has no constraints");
        return qdot_hint("constraint NAME: A = B");
    }
    o->treatment = qdot_filled_is(word + 1, "project")     ? QDOT_RUN_PROJECT
                   : qdot_filled_is(word + 1, "baumgarte") ? QDOT_RUN_BAUMGARTE
                                                           : QDOT_RUN_NONE;
    return QDOT_OK;
}

static qdot_status
read_digits(qdot_record *r, const qdot_filled *word, qdot_run_options *o)
{
    QDOT_TRY(qdot_record_integer(r, word + 1, &o->digits));
    qdot_record_blame(r, word);
    if (o->digits >= 1 && o->digits <= INT_MAX)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "%" PRId64 " digits cannot be asked for", o->digits);
    return qdot_hint("digits 30");
}

/* Read the option whose word is this part of the statement; it ends before `to`. */
static qdot_status
read_option(qdot_record *r, const qdot_filled *word, const qdot_filled *to, qdot_run_options *o)
{
    if (qdot_filled_is(word, "tol"))
        return read_tolerance(r, word + 1, o);
    if (qdot_filled_is(word, "digits"))
        return read_digits(r, word, o);
    if (qdot_filled_is(word, "constraints"))
        return read_constraint_treatment(r, word, o);
    if (qdot_filled_is(word, "with"))
        return read_with_list(r, word + 1, to, &o->with);
    if (qdot_filled_is(word, "as"))
        return qdot_record_name(r, word + 1, &o->name);
    if (qdot_filled_is(word, "method")) {
        o->method_at = word[1].from;
        o->method = word[1].from->text;
    }
    return QDOT_OK;
}

qdot_status
qdot_run_options_find(qdot_record *r, const qdot_filled *from, const qdot_filled *to,
                      qdot_run_options *o)
{
    const qdot_filled *said = from;

    if (from < to && qdot_filled_is(from, "T0..T1"))
        QDOT_TRY(qdot_record_range(r, from, &o->from, &o->to));
    for (const qdot_filled *part = from; part < to; part++) {
        if (part->node->kind != QDOT_USAGE_WORD)
            continue;
        QDOT_TRY(read_option(r, part, to, o));
        if (qdot_filled_is(part, "as")) {
            add_option_text(&r->cursor, said->from, part->from, o);
            said = part + 2;
        }
    }
    if (said < to)
        add_option_text(&r->cursor, said->from, to[-1].to, o);
    return add_values_set_by_loops(&r->cursor, o);
}

bool
qdot_run_options_name_start(const qdot_pool *pool, const qdot_run_options *o)
{
    for (size_t i = 0; i < o->with.symbols.n; i++)
        if (qdot_session_is_start(pool, o->with.symbols.at[i]))
            return true;
    return false;
}

qdot_status
qdot_run_options_put(qdot_session *session, const qdot_run_options *o)
{
    for (size_t i = 0; i < o->with.symbols.n; i++)
        QDOT_TRY(qdot_session_put(session, o->with.symbols.at[i], o->with.values.at[i]));
    return QDOT_OK;
}

qdot_status
qdot_run_options_fill(qdot_session *session, const qdot_run_options *o, qdot_expr from,
                      qdot_expr to, qdot_request *request)
{
    qdot_trial trial;
    qdot_status status;

    QDOT_TRY(qdot_trial_begin(&trial, session));
    status = qdot_run_options_put(session, o);
    if (status == QDOT_OK)
        status = qdot_request_fill(session, request);
    if (status == QDOT_OK)
        status = qdot_request_limits(session, from, to, request);
    qdot_trial_end(&trial);
    if (status == QDOT_OK && o->digits > 0 && request->momenta_in_numbers)
        status = qdot_fail(QDOT_ENOTBUILT, "not built yet: digits of runs whose start gives momenta that no formula turns into velocities");
    request->request.tol = o->tol;
    request->request.digits = (int)o->digits;
    request->request.method = o->method != NULL ? o->method : "auto";
    request->request.treatment = o->treatment;
    return status;
}

qdot_status
qdot_run_options_try(qdot_trial *trial, const qdot_run_options *o, qdot_expr from, qdot_expr to)
{
    qdot_request request = {0};
    qdot_status status = qdot_run_options_fill(trial->session, o, from, to, &request);

    if (status == QDOT_OK)
        status = qdot_request_explain(trial->session, &request, qdot_trial_run(trial, &request.request));
    qdot_request_free(&request);
    return status;
}

void
qdot_run_options_free(qdot_run_options *o)
{
    qdot_text_clear(&o->text);
    qdot_pairs_free(&o->with);
}

void
qdot_run_options_place(qdot_cursor *c, const qdot_token *method, qdot_status status)
{
    if ((status == QDOT_ENAME || status == QDOT_ENOTBUILT) && method != NULL)
        c->error_at = method->start;
}
