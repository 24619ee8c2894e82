/* loop-index.c -- finds where the index of a `for` loop occurs in the repeated statement. */
#include "lang/commands/loop-index.h"

#include <string.h>

#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/functions/quantity.h"
#include "lang/language/token-text.h"
#include "lang/session/names.h"
#include "lang/session/runs.h"
#include "lang/session/values.h"
#include "lang/source/source.h"
#include "lang/syntax/match.h"
#include "lang/syntax/mention.h"
#include "lang/syntax/outline.h"
#include "mech/scene/things.h"

/* --- where a declared symbol occurs ------------------------------------------------------- */

/* Whether a declaration, a parameter value or a start value contains the symbol. */
static bool
occurs_in_scene(const qdot_session *s, qdot_expr symbol)
{
    for (size_t i = 0; i < s->scene->events.n; i++) {
        const qdot_event *event = &s->scene->events.at[i];

        if (qdot_expr_is_in_any(s->pool, symbol, event->values.n, event->values.at) ||
            qdot_expr_is_in_any(s->pool, symbol, event->targets.n, event->targets.at) ||
            qdot_expr_contains(s->pool, event->left, symbol) ||
            qdot_expr_contains(s->pool, event->right, symbol))
            return true;
    }
    return qdot_expr_is_in_any(s->pool, symbol, s->values->set_values.n, s->values->set_values.at) ||
           qdot_expr_is_in_any(s->pool, symbol, s->values->start_values.n, s->values->start_values.at) ||
           qdot_scene_contains(s->scene, symbol);
}

static bool
occurs_in_domains(const qdot_session *s, qdot_expr symbol)
{
    for (size_t i = 0; i < s->scene->coordinates.n; i++) {
        const qdot_symbol *q = qdot_expr_symbol(s->pool, s->scene->coordinates.at[i]);

        if (qdot_expr_contains(s->pool, q->lo, symbol) || qdot_expr_contains(s->pool, q->hi, symbol))
            return true;
    }
    return false;
}

bool
qdot_loop_index_is_read(const qdot_session *s, qdot_expr symbol)
{
    const char *name = qdot_expr_symbol(s->pool, symbol)->name;
    const qdot_name *known;

    if (!qdot_expr_is_class(s->pool, symbol, QDOT_PARAM) || occurs_in_scene(s, symbol) || occurs_in_domains(s, symbol))
        return true;
    for (size_t i = 0; (known = qdot_names_at(s->names, i)) != NULL; i++) {
        if (known->kind == QDOT_NAME_VALUE && known->value != QDOT_NIL && qdot_expr_contains(s->pool, known->value, symbol))
            return true;
        if (known->kind == QDOT_NAME_FUNCTION && qdot_mention_is_in(known->body->from, known->body->to, name))
            return true;
    }
    return false;
}

/* Whether a name other than the index is defined by an expression that contains this symbol. */
static bool
definition_contains_symbol(const qdot_session *s, const char *name, qdot_expr symbol)
{
    const qdot_name *known = qdot_names_find(s->names, name);

    if (known != NULL && known->kind == QDOT_NAME_FUNCTION)
        return true; /* the function's text may contain any name */
    if (known != NULL)
        return known->value != QDOT_NIL && qdot_expr_contains(s->pool, known->value, symbol);
    for (size_t i = 0; (known = qdot_names_at(s->names, i)) != NULL; i++)
        if (qdot_is_member_of(known->name, name) &&
            known->value != QDOT_NIL && qdot_expr_contains(s->pool, known->value, symbol))
            return true;
    return (qdot_quantity_find(name) != NULL || qdot_scene_has_label(s->scene, name)) &&
           occurs_in_scene(s, symbol);
}

/* Whether the statement depends on the declared symbol by more than its text: it asks of the scene or makes runs. */
static bool
depends_on_scene(const qdot_session *s, const qdot_statement *row, qdot_expr symbol)
{
    static const char *const runs[] = {"run", "plan", "race", "workprecision", "longtime", "lyapunov",
                                       "sweep", "find", "fit", "continue", "report", "plot"};

    if (row == NULL)
        return false;
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++)
        if (strcmp(row->word, runs[i]) == 0)
            return qdot_expr_is_class(s->pool, symbol, QDOT_COORD) || occurs_in_scene(s, symbol);
    return row->alone && qdot_statement_asks(row) && occurs_in_scene(s, symbol);
}

/* --- the `for` clause --------------------------------------------------------------------- */

/* The declared parameter or coordinate of that name; NULL if there is none. */
static const qdot_name *
find_declared_symbol(const qdot_session *s, const char *name)
{
    const qdot_name *known = qdot_names_find(s->names, name);

    return known != NULL && (known->kind == QDOT_NAME_PARAM || known->kind == QDOT_NAME_COORD)
               ? known
               : NULL;
}

/* Whether the name occurs in the tokens [from, to), or anything declared with it occurs in what these stand for. */
static bool
is_index_used(const qdot_session *s, const char *name, const qdot_token *from, const qdot_token *to)
{
    const qdot_name *known = find_declared_symbol(s, name);

    if (qdot_mention_is_in(from, to, name))
        return true;
    for (qdot_mention m = qdot_mention_in(from, to); known != NULL && qdot_mention_next(&m);) {
        if (m.begins && depends_on_scene(s, m.row, known->value))
            return true;
        if (m.row != NULL && qdot_statement_declares(m.row))
            continue;
        if (strcmp(m.name, "%") == 0 || definition_contains_symbol(s, m.name, known->value))
            return true;
    }
    return false;
}

/* Whether a pair NAME = VALUE of the option `with` begins at this part of the statement. */
static bool
begins_value_of_with(const qdot_filled *part)
{
    return part->name != NULL && strcmp(part->node->before, "with") == 0;
}

/* Append the limits and options of a run, `with` without a value of this name; `end`: the token that is its end, NULL:
 * as it was. */
static void
append_run_without_value(const qdot_record *run, const char *name, const qdot_token *end, qdot_text *out)
{
    qdot_session *s = run->cursor.session;
    const qdot_filled *part = &run->parts.at[1], *last = run->parts.at + run->parts.n;
    const char *before = " with ";

    for (; part < last; part++) {
        if (qdot_filled_is(part, "with")) {
            before = " with ";
        } else if (begins_value_of_with(part)) {
            if (strcmp(part->name->text, name) != 0 || part->to != part->name + 1) {
                qdot_text_add(out, before);
                qdot_token_text(s, part->from, part[2].to, out);
                before = ", ";
            }
            part += 2;
            part += part + 1 < last && qdot_filled_is(part + 1, ",");
        } else {
            const qdot_filled *first = part;

            qdot_text_char(out, ' ');
            if (end != NULL && part->n == 2 && qdot_filled_is(part, "T0..T1")) {
                qdot_token_text(s, part->from, run->compiled.at[part->first + 1].from, out);
                qdot_token_text(s, end, end + 1, out);
                continue;
            }
            while (part + 1 < last && !qdot_filled_is(part + 1, "with"))
                part++;
            qdot_token_text(s, first->from, part->to, out);
        }
    }
}

/* Append the limits and options of the run, without a value of this name, with an end not before what the tokens
 * [from, to) read. */
static qdot_status
append_run_of_pass(qdot_session *s, const qdot_named_run *latest, const char *name, const qdot_token *from, const qdot_token *to,
        qdot_text *out)
{
    const qdot_run_report *report = qdot_run_get_report(latest->run);
    const qdot_token *end = report->t0 < report->t1 ? qdot_mention_time(from, to, report->t1) : NULL;
    qdot_source *source = NULL;
    qdot_record run = {0};
    qdot_cursor c = {.session = s};
    size_t at;
    qdot_status status = qdot_source_new("a run", latest->text, strlen(latest->text), &source, &at);

    if (status == QDOT_OK) {
        c.source = source;
        c.at = source->tokens.at;
        status = qdot_match_operands(&c, qdot_statement_find("run"), &run);
    }
    if (status == QDOT_OK)
        append_run_without_value(&run, name, end, out);
    qdot_record_free(&run);
    qdot_source_free(source);
    return status;
}

/* Fail because the loop index that the part names occurs in none of the tokens [from, to). */
static qdot_status
refuse_unused_index(qdot_record *r, const qdot_filled *clause, const qdot_filled *behind, const qdot_filled *index,
                    const qdot_token *from, const qdot_token *to)
{
    qdot_session *s = r->cursor.session;
    const char *name = index->from->text;
    const qdot_name *known = find_declared_symbol(s, name);
    const qdot_named_run *latest = s->runs->n > 0 ? &s->runs->at[s->runs->n - 1] : NULL;
    qdot_text text = {0};
    qdot_status status;

    qdot_record_blame(r, index);
    if (latest == NULL || known == NULL ||
        (!qdot_expr_is_class(s->pool, known->value, QDOT_COORD) && !occurs_in_scene(s, known->value))) {
        (void)qdot_fail(QDOT_EINVAL, "the index `%.200s` occurs nowhere in what is repeated", name);
        return qdot_hint("as in print %s^2 for %s = 1..3", name, name);
    }
    qdot_text_add(&text, "{ run");
    status = append_run_of_pass(s, latest, name, from, to, &text);
    if (status != QDOT_OK) {
        qdot_text_clear(&text);
        return status;
    }
    for (const qdot_token *first = from, *last; first < to; first = last + 1) {
        last = qdot_outline_end(first);
        last = last < to ? last : to;
        qdot_text_add(&text, first < last ? "; " : "");
        qdot_token_text(s, first, last, &text);
    }
    qdot_text_add(&text, " } for ");
    qdot_token_text(s, clause->from, behind[-1].to, &text);
    (void)qdot_fail(QDOT_EINVAL, "the index `%.200s` occurs nowhere in what is repeated: `%.200s` has one "
                                 "value of it", name, latest->name);
    (void)qdot_hint("%s", qdot_text_status(&text) == QDOT_OK ? qdot_text_str(&text) : "");
    qdot_text_clear(&text);
    return QDOT_EINVAL;
}

qdot_status
qdot_loop_index_check(qdot_record *r, const qdot_filled *clause, const qdot_filled *end, const qdot_token *from,
                      const qdot_token *to, bool block)
{
    const qdot_session *s = r->cursor.session;

    for (const qdot_filled *index = clause; index < end; index += 4) { /* NAME, `=`, A..B and a comma */
        const char *name = index->from->text;

        if (!is_index_used(s, name, from, to) && !is_index_used(s, name, index[2].from, end[-1].to) &&
            !(block && find_declared_symbol(s, name) == NULL))
            return refuse_unused_index(r, clause, end, index, from, to);
    }
    return QDOT_OK;
}
