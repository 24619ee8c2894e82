/* declare.c -- carries out definitions: NAME = EXPR, or that of a function. */
#include "lang/declare/declare.h"

#include <string.h>

#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/commands/warnings.h"
#include "lang/language/function.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/evaluation.h"
#include "lang/session/measured.h"
#include "lang/source/source.h"
#include "lang/syntax/outline.h"

/* Give a declared name the place of the token `start`. */
static void
set_declared_at(const qdot_cursor *c, const qdot_token *start, qdot_name *entry)
{
    entry->file = c->source->name;
    qdot_source_locate(c->source, start->start, &entry->line, &entry->column);
}

qdot_status
qdot_declare_name(qdot_cursor *c, const qdot_token *start, const qdot_definition *definition, qdot_name *entry)
{
    bool again = qdot_names_find(c->session->names, entry->name) != NULL;

    c->error_at = start->start;
    set_declared_at(c, start, entry);
    QDOT_TRY(qdot_warnings_anew(c->session, entry));
    QDOT_TRY(qdot_names_declare(c->session->names, entry));
    return again ? QDOT_OK : qdot_warnings_definition(c, definition, entry);
}

/* --- NAME = EXPR -------------------------------------------------------------------- */

/* If the unknown name in a definition is the one that is being defined, add a hint about that to the error. */
static qdot_status
hint_at_self_reference(const qdot_cursor *c, const qdot_definition *d, qdot_status status)
{
    const char *name = d->name->text;
    bool family;

    if (status != QDOT_ENAME || qdot_names_find(c->session->names, name) != NULL ||
        !qdot_definition_recurs_at(d, c->error_at, &family))
        return status;
    return family ? qdot_hint("what a family begins with is defined first: %s[0] = ...", name)
                  : qdot_hint("`%s` is just being defined: it has no meaning before that", name);
}

static qdot_status
define_function(qdot_cursor *c, const qdot_definition *d)
{
    const qdot_token *start = d->name;
    qdot_name entry;
    qdot_status status = qdot_function_read(c, &entry);
    const qdot_name *old = qdot_names_find(c->session->names, start->text);

    if (status == QDOT_OK && old != NULL && old->kind == QDOT_NAME_UFUN) {
        c->error_at = start->start;
        (void)qdot_fail(QDOT_ENAME, "`%s` was declared as an undefined function at %s:%u",
                        start->text, old->file, old->line);
        status = qdot_hint("set %s(...) = ... gives it a value for numbers", start->text);
    }
    if (status == QDOT_OK)
        status = qdot_declare_name(c, start, d, &entry);
    qdot_function_body_release(entry.body);
    return status;
}

/* The text of the right side. If it reads a run in a loop, with the values of the indices, since it may
 * be written down (lang/declare/session-file). */
static qdot_status
store_definition_text(qdot_cursor *c, const qdot_token *right, qdot_expr value, qdot_function_body **body)
{
    qdot_source *source = NULL;
    qdot_text text = {0};
    qdot_status status;
    size_t at;

    if (c->session->evaluation->loops == 0 || !qdot_measured_occurs(c->session, value)) {
        *body = qdot_function_body_new(c->source, right, c->at);
        return *body != NULL ? QDOT_OK : QDOT_ENOMEM;
    }
    qdot_token_text(c->session, right, c->at, &text);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_source_new("a definition", qdot_text_str(&text), text.n, &source, &at);
    if (status == QDOT_OK) {
        *body = qdot_function_body_new(source, source->tokens.at,
                                       source->tokens.at + source->tokens.n - 1);
        status = *body != NULL ? QDOT_OK : QDOT_ENOMEM;
    }
    qdot_source_free(source);
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_declare_definition(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_definition d;
    qdot_name entry = {.kind = QDOT_NAME_VALUE};
    const char *name;
    const qdot_name *old;
    qdot_status status;

    if (!qdot_definition_find(start, qdot_outline_end(start), &d))
        return qdot_cursor_expected(c, "a definition");
    if (d.call)
        return define_function(c, &d);
    QDOT_TRY(qdot_read_name(c, &name));
    entry.name = (char *)name;
    if (c->at != d.equals) /* as in a [1] = 3: a name has no blank before its index */
        return qdot_cursor_expected(c, "`=`");
    c->at = d.equals + 1;
    QDOT_TRY(hint_at_self_reference(c, &d, qdot_read_named(c, &entry.value, &entry.over)));
    QDOT_TRY(qdot_cursor_expect_end(c));
    old = qdot_names_find(c->session->names, name);
    c->error_at = start->start;
    if (old != NULL && (old->kind == QDOT_NAME_PARAM || old->kind == QDOT_NAME_COORD)) {
        bool param = old->kind == QDOT_NAME_PARAM;

        (void)qdot_fail(QDOT_ENAME, "`%s` was declared as a %s at %s:%u", name,
                        param ? "parameter" : "coordinate", old->file, old->line);
        return qdot_hint(param ? "set %s = ... gives it a value"
                               : "start %s = ... gives its initial value",
                         name);
    }
    QDOT_TRY(store_definition_text(c, d.equals + 1, entry.value, &entry.body));
    status = qdot_declare_name(c, start, &d, &entry);
    qdot_function_body_release(entry.body);
    return status;
}
