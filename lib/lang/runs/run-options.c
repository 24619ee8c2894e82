/* run-options.c -- reads the options of a run. */
#include "lang/runs/run-options.h"

#include <limits.h>

#include "lang/commands/set.h"
#include "lang/commands/value-check.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/held.h"

/* NAME = VALUE of a parameter or of a coordinate or velocity. */
static qdot_status
read_with(qdot_cursor *c, qdot_pairs *with)
{
    do {
        const qdot_token *start = c->at;
        qdot_cursor look = *c;
        qdot_expr symbol, value;
        const char *name;
        const qdot_name *known = NULL;

        if (c->at->kind == QDOT_TOKEN_NAME && qdot_read_name(&look, &name) == QDOT_OK)
            known = qdot_names_find(c->session->names, name);
        if (known != NULL && known->kind == QDOT_NAME_COORD)
            QDOT_TRY(qdot_set_read_jet(c, &symbol));
        else
            QDOT_TRY(qdot_set_read_parameter(c, &symbol));
        QDOT_TRY(qdot_set_read_constant(c, &value));
        c->error_at = start->start;
        QDOT_TRY(qdot_session_in_domain(c->session, symbol, value));
        QDOT_TRY(qdot_pairs_push(with, start, symbol, value));
    } while (qdot_cursor_accept_op(c, ","));
    return qdot_value_check(c, with);
}

static qdot_status
run_read_tolerance(qdot_cursor *c, qdot_run_options *o)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_cursor_once(c, "tol", o->tol_given));
    o->tol_given = true;
    QDOT_TRY(qdot_read_number(c, &o->tol));
    if (o->tol > 0 && o->tol < 1)
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_EINVAL, "a tolerance lies between 0 and 1");
}

/* project, baumgarte or none: how drift off the constraints is treated. */
static qdot_status
read_treatment(qdot_cursor *c, qdot_run_options *o)
{
    static const struct {
        const char *word;
        qdot_run_treatment treatment;
    } words[] = {{"project", QDOT_RUN_PROJECT},
                 {"baumgarte", QDOT_RUN_BAUMGARTE},
                 {"none", QDOT_RUN_NONE}};

    if (c->session->scene->constraints.n == 0) {
        c->error_at = c->at[-1].start;
        (void)qdot_fail(QDOT_EINVAL, "the scene has no constraints");
        return qdot_hint("constraint NAME: A = B");
    }
    QDOT_TRY(qdot_cursor_once(c, "constraints", o->treatment_given));
    o->treatment_given = true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (qdot_cursor_accept_word(c, words[i].word)) {
            o->treatment = words[i].treatment;
            return QDOT_OK;
        }
    return qdot_cursor_expected(c, "`project`, `baumgarte` or `none`");
}

static qdot_status
read_digits(qdot_cursor *c, qdot_run_options *o)
{
    const qdot_token *start = c->at++;

    QDOT_TRY(qdot_cursor_once(c, "digits", o->digits != 0));
    QDOT_TRY(qdot_read_integer(c, &o->digits));
    c->error_at = start->start;
    if (o->digits >= 1 && o->digits <= INT_MAX)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "%ld digits cannot be asked for", o->digits);
    return qdot_hint("digits 30");
}

/* What the tokens [from, to) say, behind what was said before. */
static void
add_text(const qdot_cursor *c, const qdot_token *from, const qdot_token *to,
         qdot_run_options *o)
{
    if (from == to)
        return;
    if (o->text.n > 0)
        qdot_text_char(&o->text, ' ');
    qdot_token_text(c->session, from, to, &o->text);
}

/* What loops hold is said as `with l = 1`. */
static qdot_status
add_held(qdot_cursor *c, qdot_run_options *o)
{
    qdot_session *session = c->session;

    QDOT_TRY(qdot_held_check(session));
    for (size_t i = 0; i < session->held.n; i++) {
        const qdot_held *held = &session->held.at[i];

        QDOT_TRY(qdot_pairs_push(&o->with, c->at, held->symbol, held->value));
        qdot_text_format(&o->text, "%s%s = ", i > 0 || o->with.symbols.n > 1 ? ", " : " with ",
                         qdot_expr_symbol(session->pool, held->symbol)->name);
        QDOT_TRY(qdot_print(session->pool, held->value, QDOT_PLAIN, &o->text));
    }
    return session->held.n > 0 ? qdot_value_check(c, &o->with) : QDOT_OK;
}

qdot_status
qdot_run_options_read(qdot_cursor *c, const qdot_token *start, qdot_run_options *o)
{
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "tol")) {
            QDOT_TRY(run_read_tolerance(c, o));
        } else if (qdot_cursor_is_word(c, "digits")) {
            QDOT_TRY(read_digits(c, o));
        } else if (qdot_cursor_accept_word(c, "method")) {
            QDOT_TRY(qdot_cursor_once(c, "method", o->method != NULL));
            if (c->at->kind != QDOT_TOKEN_NAME)
                return qdot_cursor_expected(c, "the name of a method");
            o->method_at = c->at;
            o->method = c->at++->text;
        } else if (qdot_cursor_accept_word(c, "constraints")) {
            QDOT_TRY(read_treatment(c, o));
        } else if (qdot_cursor_accept_word(c, "as")) {
            add_text(c, start, c->at - 1, o);
            QDOT_TRY(qdot_cursor_once(c, "as", o->name != NULL));
            QDOT_TRY(qdot_read_name(c, &o->name));
            start = c->at;
        } else if (qdot_cursor_accept_word(c, "with")) {
            QDOT_TRY(read_with(c, &o->with));
        } else {
            return qdot_cursor_expected(
                c, "`tol`, `digits`, `method`, `with`, `constraints` or `as`");
        }
    }
    add_text(c, start, c->at, o);
    QDOT_TRY(add_held(c, o));
    if (o->tol_given && o->digits > 0) {
        c->error_at = c->at->start;
        qdot_fail(QDOT_EINVAL, "`digits` sets the tolerance itself: no `tol` beside it");
        return qdot_hint("digits %ld", o->digits);
    }
    return QDOT_OK;
}

/* --- of a record ------------------------------------------------------------------------ */

/* NAME = VALUE of a parameter or of a coordinate or velocity. */
static qdot_status
with_find_one(qdot_record *r, const qdot_filled *part, qdot_pairs *with)
{
    const qdot_name *known;
    qdot_expr symbol, value;
    const char *name;

    QDOT_TRY(qdot_record_name(r, part, &name));
    known = qdot_names_find(r->cursor.session->names, name);
    if (known != NULL && known->kind == QDOT_NAME_COORD)
        QDOT_TRY(qdot_set_find_jet(r, part, &symbol));
    else
        QDOT_TRY(qdot_set_find_parameter(r, part, &symbol));
    QDOT_TRY(qdot_set_find_constant(r, qdot_record_next(r, part, "VALUE"), &value));
    qdot_record_blame(r, part);
    QDOT_TRY(qdot_session_in_domain(r->cursor.session, symbol, value));
    return qdot_pairs_push(with, part->from, symbol, value);
}

/* Those of the list that begins with `first`. */
static qdot_status
with_find(qdot_record *r, const qdot_filled *first, const qdot_filled *to, qdot_pairs *with)
{
    for (const qdot_filled *part = first; part < to; part += 4) { /* NAME = VALUE , */
        QDOT_TRY(with_find_one(r, part, with));
        if (part + 3 >= to || !qdot_filled_is(part + 3, ","))
            break;
    }
    return qdot_value_check(&r->cursor, with);
}

static qdot_status
tolerance_find(qdot_record *r, const qdot_filled *part, qdot_run_options *o)
{
    o->tol_given = true;
    QDOT_TRY(qdot_record_number(r, part, &o->tol));
    if (o->tol > 0 && o->tol < 1)
        return QDOT_OK;
    qdot_record_blame(r, part);
    return qdot_fail(QDOT_EINVAL, "a tolerance lies between 0 and 1");
}

/* project, baumgarte or none: how drift off the constraints is treated. */
static qdot_status
treatment_find(qdot_record *r, const qdot_filled *word, qdot_run_options *o)
{
    if (r->cursor.session->scene->constraints.n == 0) {
        qdot_record_blame(r, word);
        (void)qdot_fail(QDOT_EINVAL, "the scene has no constraints");
        return qdot_hint("constraint NAME: A = B");
    }
    o->treatment_given = true;
    o->treatment = qdot_filled_is(word + 1, "project")     ? QDOT_RUN_PROJECT
                   : qdot_filled_is(word + 1, "baumgarte") ? QDOT_RUN_BAUMGARTE
                                                           : QDOT_RUN_NONE;
    return QDOT_OK;
}

static qdot_status
digits_find(qdot_record *r, const qdot_filled *word, qdot_run_options *o)
{
    QDOT_TRY(qdot_record_integer(r, word + 1, &o->digits));
    qdot_record_blame(r, word);
    if (o->digits >= 1 && o->digits <= INT_MAX)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "%ld digits cannot be asked for", o->digits);
    return qdot_hint("digits 30");
}

/* The option whose word is the part, before `to`. */
static qdot_status
option_find(qdot_record *r, const qdot_filled *word, const qdot_filled *to, qdot_run_options *o)
{
    if (qdot_filled_is(word, "tol"))
        return tolerance_find(r, word + 1, o);
    if (qdot_filled_is(word, "digits"))
        return digits_find(r, word, o);
    if (qdot_filled_is(word, "constraints"))
        return treatment_find(r, word, o);
    if (qdot_filled_is(word, "with"))
        return with_find(r, word + 1, to, &o->with);
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
        QDOT_TRY(option_find(r, part, to, o));
        if (qdot_filled_is(part, "as")) {
            add_text(&r->cursor, said->from, part->from, o);
            said = part + 2;
        }
    }
    if (said < to)
        add_text(&r->cursor, said->from, to[-1].to, o);
    return add_held(&r->cursor, o);
}

/* --- read by a cursor --------------------------------------------------------------------- */

/* The next `:` outside of brackets; NULL: there is none. */
static qdot_token *
find_colon(const qdot_cursor *c)
{
    const qdot_token *t = c->at;
    int depth = 0;

    for (; t->kind != QDOT_TOKEN_END && (depth > 0 || !qdot_token_is(t, ":")); t++)
        depth += qdot_token_bracket(t);
    return t->kind == QDOT_TOKEN_END ? NULL : (qdot_token *)t;
}

qdot_status
qdot_run_options_read_to_colon(qdot_cursor *c, const qdot_token *start, qdot_run_options *o)
{
    qdot_token *colon = find_colon(c);
    uint8_t kind;
    qdot_status status;

    if (colon == NULL) {
        while (!qdot_cursor_is_end(c))
            c->at++;
        (void)qdot_cursor_expected(c, "`:` and what is asked of each run");
        return qdot_hint("run 0..20 : max(theta), energy as curve");
    }
    kind = colon->kind;
    colon->kind = QDOT_TOKEN_END; /* meanwhile */
    status = qdot_read_range(c, &o->from, &o->to);
    if (status == QDOT_OK)
        status = qdot_run_options_read(c, start, o);
    colon->kind = kind;
    QDOT_TRY(status);
    c->at++;
    return QDOT_OK;
}

bool
qdot_run_options_name_start(const qdot_pool *pool, const qdot_run_options *o)
{
    for (size_t i = 0; i < o->with.symbols.n; i++)
        if (qdot_expr_is_class(pool, o->with.symbols.at[i], QDOT_COORD))
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
    qdot_kept_values kept;
    qdot_status status;

    QDOT_TRY(qdot_session_keep_values(session, &kept));
    status = qdot_run_options_put(session, o);
    if (status == QDOT_OK)
        status = qdot_request_fill(session, request);
    if (status == QDOT_OK)
        status = qdot_request_limits(session, from, to, request);
    qdot_session_restore_values(session, &kept);
    request->request.tol = o->tol;
    request->request.digits = (int)o->digits;
    request->request.method = o->method != NULL ? o->method : "auto";
    request->request.treatment = o->treatment;
    return status;
}

void
qdot_run_options_free(qdot_run_options *o)
{
    qdot_text_clear(&o->text);
    qdot_pairs_free(&o->with);
}

void
qdot_run_options_place(qdot_cursor *c, const qdot_run_options *o, qdot_status status)
{
    if ((status == QDOT_ENAME || status == QDOT_ENOTBUILT) && o->method_at != NULL)
        c->error_at = o->method_at->start;
}
