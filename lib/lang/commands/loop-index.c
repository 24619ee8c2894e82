/* loop-index.c -- finds where the index of a `for` loop occurs in the repeated statement. */
#include "lang/commands/loop-index.h"

#include <stdlib.h>
#include <string.h>

#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/commands/statement-form.h"
#include "lang/functions/quantity.h"
#include "lang/language/token-text.h"
#include "lang/session/names.h"
#include "lang/session/runs.h"
#include "lang/session/values.h"
#include "lang/source/source.h"
#include "mech/scene/things.h"

/* --- where a declared symbol occurs ------------------------------------------------------- */

static bool
is_in_any(const qdot_session *s, size_t n, const qdot_expr *list, qdot_expr symbol)
{
    for (size_t i = 0; i < n; i++)
        if (qdot_expr_contains(s->pool, list[i], symbol))
            return true;
    return false;
}

/* Whether a declaration, a parameter value or a start value contains the symbol. */
static bool
is_in_scene(const qdot_session *s, qdot_expr symbol)
{
    for (size_t i = 0; i < s->scene->events.n; i++) {
        const qdot_event *event = &s->scene->events.at[i];

        if (is_in_any(s, event->values.n, event->values.at, symbol) ||
            is_in_any(s, event->targets.n, event->targets.at, symbol) ||
            qdot_expr_contains(s->pool, event->left, symbol) ||
            qdot_expr_contains(s->pool, event->right, symbol))
            return true;
    }
    return is_in_any(s, s->values->set_values.n, s->values->set_values.at, symbol) ||
           is_in_any(s, s->values->start_values.n, s->values->start_values.at, symbol) ||
           qdot_scene_contains(s->scene, symbol);
}

static bool
is_in_domains(const qdot_session *s, qdot_expr symbol)
{
    for (size_t i = 0; i < s->scene->coordinates.n; i++) {
        const qdot_symbol *q = qdot_expr_symbol(s->pool, s->scene->coordinates.at[i]);

        if ((q->lo != QDOT_NIL && qdot_expr_contains(s->pool, q->lo, symbol)) ||
            (q->hi != QDOT_NIL && qdot_expr_contains(s->pool, q->hi, symbol)))
            return true;
    }
    return false;
}

bool
qdot_loop_index_is_read(const qdot_session *s, qdot_expr symbol)
{
    const char *name = qdot_expr_symbol(s->pool, symbol)->name;
    const qdot_name *known;

    if (!qdot_expr_is_class(s->pool, symbol, QDOT_PARAM) || is_in_scene(s, symbol) || is_in_domains(s, symbol))
        return true;
    for (size_t i = 0; (known = qdot_names_at(s->names, i)) != NULL; i++) {
        if (known->kind == QDOT_NAME_VALUE && known->value != QDOT_NIL && qdot_expr_contains(s->pool, known->value, symbol))
            return true;
        for (const qdot_token *k = known->kind == QDOT_NAME_FUNCTION ? known->body->from : NULL;
             k != NULL && k < known->body->to; k++)
            if (qdot_token_is_word(k, name))
                return true;
    }
    return false;
}

/* Whether a name other than the index is defined by an expression that contains this symbol. */
static bool
stands_for(const qdot_session *s, const char *name, qdot_expr symbol)
{
    const qdot_name *known = qdot_names_find(s->names, name);
    const size_t length = strlen(name);

    if (known != NULL && known->kind == QDOT_NAME_FUNCTION)
        return true; /* the function's text may contain any name */
    if (known != NULL)
        return known->value != QDOT_NIL && qdot_expr_contains(s->pool, known->value, symbol);
    for (size_t i = 0; (known = qdot_names_at(s->names, i)) != NULL; i++)
        if (strncmp(known->name, name, length) == 0 && known->name[length] == '[' &&
            known->value != QDOT_NIL && qdot_expr_contains(s->pool, known->value, symbol))
            return true;
    return (qdot_quantity_find(name) != NULL || qdot_scene_has_label(s->scene, name)) &&
           is_in_scene(s, symbol);
}

/* Whether the statement at `first`, in [first, to), depends on the declared symbol by more than its
 * text: it asks of the scene or makes runs. */
static bool
depends_on_scene(const qdot_session *s, const qdot_token *first, qdot_expr symbol)
{
    static const char *const runs[] = {"run", "plan", "race", "workprecision", "longtime", "lyapunov",
                                       "sweep", "find", "fit", "continue", "report", "plot"};
    const qdot_statement *row =
        first->kind == QDOT_TOKEN_NAME ? qdot_statement_find(first->text) : NULL;

    if (row == NULL)
        return false;
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++)
        if (strcmp(row->word, runs[i]) == 0)
            return qdot_expr_is_class(s->pool, symbol, QDOT_COORD) || is_in_scene(s, symbol);
    return row->alone && qdot_statement_asks(row) && is_in_scene(s, symbol);
}

static bool
is_declaration(const qdot_token *first)
{
    const qdot_statement *row =
        first->kind == QDOT_TOKEN_NAME ? qdot_statement_find(first->text) : NULL;

    return row != NULL && qdot_statement_declares(row);
}

/* --- the `for` clause --------------------------------------------------------------------- */

/* The declared parameter or coordinate of that name; NULL if there is none. */
static const qdot_name *
declared(const qdot_session *s, const char *name)
{
    const qdot_name *known = qdot_names_find(s->names, name);

    return known != NULL && (known->kind == QDOT_NAME_PARAM || known->kind == QDOT_NAME_COORD)
               ? known
               : NULL;
}

static bool
is_used(const qdot_session *s, const char *name, const qdot_token *from, const qdot_token *to)
{
    const qdot_name *known = declared(s, name);
    const qdot_token *first = from;

    for (const qdot_token *k = from; k < to; k++)
        if (qdot_token_is_word(k, name))
            return true;
    for (const qdot_token *k = from; k < to && known != NULL; k++) {
        if (k == from || k[-1].kind == QDOT_TOKEN_END || qdot_token_is(k - 1, "{")) {
            first = k;
            if (depends_on_scene(s, k, known->value))
                return true;
        }
        if (qdot_token_is(k, "%") && !is_declaration(first))
            return true;
        if (k->kind == QDOT_TOKEN_NAME && !is_declaration(first) &&
            stands_for(s, k->text, known->value))
            return true;
    }
    return false;
}

/* The token after the pair NAME = VALUE of `with`: a comma, the next option or the end. */
static const qdot_token *
behind_pair(const qdot_token *k)
{
    static const char *const options[] = {"tol", "digits", "method", "constraints", "as", "with"};

    for (long depth = 0; k->kind != QDOT_TOKEN_END; k++) {
        depth += qdot_token_bracket(k);
        if (depth == 0 && qdot_token_is(k, ","))
            return k;
        for (size_t i = 0; i < sizeof options / sizeof *options && depth == 0; i++)
            if (qdot_token_is_word(k, options[i]))
                return k;
    }
    return k;
}

/* The latest time at which the tokens read the run, as in value(x, 5) and max(x, 0..5), if that is behind its end; else
 * NULL. */
static const qdot_token *
later_time(const qdot_named_run *run, const qdot_token *from, const qdot_token *to)
{
    double last = qdot_run_get_report(run->run)->t1;
    const qdot_token *found = NULL;

    for (const qdot_token *k = from + 1; k + 1 < to && qdot_run_get_report(run->run)->t0 < last; k++) {
        const bool is = k->kind == QDOT_TOKEN_NUMBER && qdot_token_is(k + 1, ")")
                        && (qdot_token_is(k - 1, ",") || qdot_token_is(k - 1, ".."));

        if (!is || strtod(k->text, NULL) <= last)
            continue;
        last = strtod(k->text, NULL);
        found = k;
    }
    return found;
}

/* The limits and options of a run, those of `with` without a value of this name; `end`: the token that is its end, NULL:
 * as it was. */
static void
add_run_without(qdot_session *s, const qdot_token *k, const char *name, const qdot_token *end, qdot_text *out)
{
    const qdot_token *from = k;

    while (end != NULL && !qdot_token_is(k, "..") && k->kind != QDOT_TOKEN_END)
        k++;
    if (end != NULL && qdot_token_is(k, "..")) {
        qdot_text_char(out, ' ');
        qdot_token_text(s, from, k + 1, out);
        qdot_token_text(s, end, end + 1, out);
        from = k = behind_pair(k);
    } else {
        k = from;
    }
    while (k->kind != QDOT_TOKEN_END) {
        const char *before = " with ";
        const qdot_token *next = k + 1;

        if (!qdot_token_is_word(k, "with")) {
            k++;
            continue;
        }
        qdot_text_add(out, from < k ? " " : "");
        qdot_token_text(s, from, k, out);
        for (bool more = true; more;) {
            const qdot_token *pair = next;

            next = behind_pair(pair);
            if (!qdot_token_is_word(pair, name) || !qdot_token_is(pair + 1, "=")) {
                qdot_text_add(out, before);
                qdot_token_text(s, pair, next, out);
                before = ", ";
            }
            more = qdot_token_is(next, ",");
            next += more;
        }
        from = k = next;
    }
    qdot_text_add(out, from < k ? " " : "");
    qdot_token_text(s, from, k, out);
}

/* Fail: the index at k occurs in none of the tokens [from, to). */
static qdot_status
fail_unused(qdot_cursor *c, const qdot_token *k, const qdot_token *from, const qdot_token *to,
            const qdot_token *end)
{
    qdot_session *s = c->session;
    const qdot_name *known = declared(s, k->text);
    const qdot_named_run *latest = s->runs->n > 0 ? &s->runs->at[s->runs->n - 1] : NULL;
    qdot_source *run = NULL;
    qdot_text text = {0};
    qdot_status status;
    size_t at;

    c->error_at = k->start;
    if (latest == NULL || known == NULL ||
        (!qdot_expr_is_class(s->pool, known->value, QDOT_COORD) && !is_in_scene(s, known->value))) {
        (void)qdot_fail(QDOT_EINVAL, "the index `%.200s` occurs nowhere in what is repeated", k->text);
        return qdot_hint("as in print %s^2 for %s = 1..3", k->text, k->text);
    }
    status = qdot_source_new("a run", latest->text, strlen(latest->text), &run, &at);
    if (status != QDOT_OK) {
        qdot_source_free(run);
        return status;
    }
    qdot_text_add(&text, "{ run");
    /* then append the tokens of the run that belong to this iteration */
    add_run_without(s, run->tokens.at, k->text, later_time(latest, from, to), &text);
    qdot_source_free(run);
    for (const qdot_token *first = from, *last; first < to; first = last + 1) {
        for (last = first; last < to && last->kind != QDOT_TOKEN_END;)
            last++;
        qdot_text_add(&text, first < last ? "; " : "");
        qdot_token_text(s, first, last, &text);
    }
    qdot_text_add(&text, " } for ");
    qdot_token_text(s, c->at, end, &text);
    (void)qdot_fail(QDOT_EINVAL, "the index `%.200s` occurs nowhere in what is repeated: `%.200s` has one "
                                 "value of it", k->text, latest->name);
    (void)qdot_hint("%s", qdot_text_status(&text) == QDOT_OK ? qdot_text_str(&text) : "");
    qdot_text_clear(&text);
    return QDOT_EINVAL;
}

qdot_status
qdot_loop_index_check(qdot_cursor *c, const qdot_token *from, const qdot_token *to, const qdot_token *end,
                      bool block)
{
    const qdot_token *clause = c->at;
    long depth = 0;

    if (end == NULL)
        for (end = clause; end->kind != QDOT_TOKEN_END;)
            end++;
    for (const qdot_token *k = clause; k < end; k++) {
        depth += qdot_token_bracket(k);
        if (depth != 0 || k->kind != QDOT_TOKEN_NAME || !qdot_token_is(k + 1, "=") ||
            (k > clause && !qdot_token_is(k - 1, ",")) || is_used(c->session, k->text, from, to) ||
            is_used(c->session, k->text, k + 2, end) ||
            (block && declared(c->session, k->text) == NULL))
            continue;
        return fail_unused(c, k, from, to, end);
    }
    return QDOT_OK;
}
