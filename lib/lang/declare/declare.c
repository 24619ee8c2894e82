/* declare.c -- names: param, coord, function, and NAME = EXPR.
 *
 * Every declaration is read to its end before the first of its names is declared; if one
 * of them cannot be, those before it are taken back.
 */
#include "lang/declare/declare.h"

#include <string.h>

#include "base/interrupt.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/commands/set.h"
#include "lang/commands/handlers.h"
#include "lang/commands/statement.h"
#include "lang/commands/value-check.h"
#include "lang/commands/warnings.h"
#include "lang/functions/builtin.h"
#include "lang/language/function.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/source/source.h"

/* --- lists of names with domains ---------------------------------------------------- */

typedef struct {
    const char *name;
    const qdot_token *start;
    qdot_expr lo, hi; /* nil: none */
    bool lo_open, hi_open;
    bool own;        /* the domain was said for this name or spread to it */
    qdot_expr value; /* nil: none */
} item;

typedef qdot_vec(item) items;

/* What a bound of a domain may not depend on. */
#define MOVING                                                                           \
    (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM |    \
     QDOT_HAS_MULTIPLIER | QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA | QDOT_HAS_TIME)

static bool
is_relation(const qdot_cursor *c, bool *less, bool *strict)
{
    static const struct {
        const char *op;
        bool less, strict;
    } ops[] = {
        {"<", true, true}, {"<=", true, false}, {">", false, true}, {">=", false, false}};

    for (size_t i = 0; i < sizeof ops / sizeof *ops; i++)
        if (qdot_cursor_is_op(c, ops[i].op)) {
            *less = ops[i].less;
            *strict = ops[i].strict;
            return true;
        }
    return false;
}

/* One bound: x < b gives hi, x > b gives lo. */
static qdot_status
set_bound(qdot_cursor *c, const qdot_token *at, item *x, qdot_expr bound, bool upper,
          bool strict)
{
    if (!qdot_expr_is_scalar(c->session->pool, bound) ||
        (qdot_expr_node(c->session->pool, bound)->holds & MOVING)) {
        c->error_at = at->start;
        return qdot_fail(QDOT_ETYPE,
                         "a bound is a number or an expression of parameters");
    }
    if ((upper ? x->hi : x->lo) != QDOT_NIL) {
        c->error_at = at->start;
        return qdot_fail(QDOT_EINVAL, "`%s` has two %s bounds", x->name,
                         upper ? "upper" : "lower");
    }
    if (upper) {
        x->hi = bound;
        x->hi_open = strict;
    } else {
        x->lo = bound;
        x->lo_open = strict;
    }
    x->own = true;
    return QDOT_OK;
}

/* Whether more of the item follows. */
static bool
is_more(const qdot_cursor *c)
{
    return !qdot_cursor_is_op(c, ",") && !qdot_cursor_is_op(c, "=") &&
           !qdot_cursor_is_end(c);
}

/* Whether a call of a function of the language stands here, `sqrt(2)`; its name is no name to declare. */
static bool
begins_with_call(const qdot_cursor *c)
{
    return c->at->kind == QDOT_TOKEN_NAME && qdot_token_is(&c->at[1], "(") &&
           qdot_names_find(c->session->names, c->at->text) == NULL &&
           qdot_builtin_find(c->at->text) != NULL;
}

/* Whether `LO <` stands before the name: a number, a sign, a bracket, a call, or a name that
 * is declared followed by one that is not. */
static bool
begins_with_bound(const qdot_cursor *c)
{
    qdot_cursor look = *c;
    const char *name;
    bool less, strict;

    if (c->at->kind != QDOT_TOKEN_NAME)
        return true;
    if (strcmp(c->at->text, "pi") == 0) { /* a bare pi is a name, which is refused */
        look.at++;
        return is_more(&look) && (!is_relation(&look, &less, &strict) ||
                                  look.at[1].kind == QDOT_TOKEN_NAME);
    }
    if (begins_with_call(c))
        return true;
    if (qdot_names_find(c->session->names, c->at->text) == NULL)
        return false;
    if (qdot_read_name(&look, &name) != QDOT_OK)
        return false;
    if (!is_relation(&look, &less, &strict))
        return is_more(&look);
    look.at++;
    return look.at->kind == QDOT_TOKEN_NAME && strcmp(look.at->text, "pi") != 0 &&
           qdot_names_find(c->session->names, look.at->text) == NULL;
}

/* [LO <] NAME [< B] [> B] [= VALUE] */
static qdot_status
read_item(qdot_cursor *c, bool valued, item *x)
{
    qdot_status status = QDOT_OK;
    bool less, strict;

    if (c->at->kind != QDOT_TOKEN_NAME && c->at->kind != QDOT_TOKEN_NUMBER &&
        !qdot_cursor_is_op(c, "-") && !qdot_cursor_is_op(c, "+") &&
        !qdot_cursor_is_op(c, "sqrt") && !qdot_cursor_is_op(c, "("))
        return qdot_cursor_expected(c, "a name");
    if (begins_with_bound(c)) {
        const qdot_token *at = c->at;
        qdot_expr bound;

        QDOT_TRY(qdot_read_side(c, &bound));
        if (!is_relation(c, &less, &strict)) {
            c->at = at;
            return qdot_cursor_expected(c, "a name");
        }
        c->at++;
        x->name = "";
        QDOT_TRY(set_bound(c, at, x, bound, !less, strict));
    }
    x->start = c->at;
    QDOT_TRY(qdot_read_name(c, &x->name));
    while (is_relation(c, &less, &strict)) {
        const qdot_token *at = ++c->at;
        qdot_expr bound;

        QDOT_TRY(qdot_read_side(c, &bound));
        QDOT_TRY(set_bound(c, at, x, bound, less, strict));
    }
    if (qdot_cursor_is_op(c, "=")) {
        if (!valued) {
            c->error_at = c->at->start;
            (void)qdot_fail(QDOT_ESYNTAX, "a coordinate is declared without a value");
            return qdot_hint("start %s = ... gives its initial value", x->name);
        }
        c->at++;
        c->session->declares = false; /* numbers of runs as `set` takes them, with their errors */
        status = qdot_read_scalar(c, &x->value);
        c->session->declares = true;
        if (status == QDOT_OK)
            status = qdot_set_keep_measured(c->session, &x->value);
    }
    return status;
}

/* A sign also applies to the bare names before it: `param m, L > 0`. */
static void
spread(items *list)
{
    const item *last = &list->at[list->n - 1];

    if (!last->own || (last->lo != QDOT_NIL && last->hi != QDOT_NIL))
        return;
    for (size_t i = list->n - 1; i-- > 0;) {
        item *x = &list->at[i];

        if (x->own || x->value != QDOT_NIL)
            continue;
        x->lo = last->lo;
        x->hi = last->hi;
        x->lo_open = last->lo_open;
        x->hi_open = last->hi_open;
        x->own = true;
    }
}

/* What comes behind a parameter in its list may use it: `param a = 2, b = a^2`. */
static qdot_status
show_item(qdot_session *session, const item *x, size_t *shown)
{
    qdot_expr symbol;

    if (qdot_names_find(session->names, x->name) != NULL)
        return QDOT_OK;
    symbol = qdot_symbol_get(session->pool, QDOT_PARAM, x->name);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_names_push(session->names, x->name, symbol));
    ++*shown;
    return QDOT_OK;
}

static qdot_status
read_items(qdot_cursor *c, bool params, items *list)
{
    qdot_status status;
    size_t shown = 0;

    do {
        item x = {0};

        status = read_item(c, params, &x);
        if (status == QDOT_OK)
            status = qdot_vec_push(list, x);
        if (status == QDOT_OK && params)
            spread(list);
        c->error_at = status == QDOT_OK ? x.start->start : c->error_at;
        if (status == QDOT_OK && params)
            status = show_item(c->session, &x, &shown);
    } while (status == QDOT_OK && qdot_cursor_accept_op(c, ","));
    while (shown-- > 0)
        qdot_names_pop(c->session->names);
    if (status == QDOT_OK && c->at->kind == QDOT_TOKEN_NAME) { /* param a b */
        c->error_at = c->at->start;
        qdot_fail(QDOT_ESYNTAX, "expected `,` or the end of the statement, found `%.100s`",
                  c->at->text);
        return qdot_hint("a comma stands between names");
    }
    return status == QDOT_OK ? qdot_cursor_expect_end(c) : status;
}

/* --- declaring ---------------------------------------------------------------------- */

/* A declared name has the file and line of the token at `start`. */
static void
place(const qdot_cursor *c, const qdot_token *start, qdot_name *entry)
{
    uint32_t column;

    entry->file = c->source->name;
    qdot_source_locate(c->source, start->start, &entry->line, &column);
}

qdot_status
qdot_declare_name(qdot_cursor *c, const qdot_token *start, qdot_name *entry)
{
    bool again = qdot_names_find(c->session->names, entry->name) != NULL;

    c->error_at = start->start;
    place(c, start, entry);
    QDOT_TRY(qdot_warnings_anew(c->session, entry));
    QDOT_TRY(qdot_names_declare(c->session->names, entry));
    return again ? QDOT_OK : qdot_warnings_definition(c, start, entry);
}

static bool
same_domain(const qdot_symbol *s, const item *x)
{
    return s->lo == x->lo && s->hi == x->hi &&
           (x->lo == QDOT_NIL || s->lo_open == x->lo_open) &&
           (x->hi == QDOT_NIL || s->hi_open == x->hi_open);
}

/* Declare one name; *fresh: it was not there before. */
static qdot_status
declare_item(qdot_cursor *c, qdot_name_kind kind, const item *x, bool *fresh)
{
    qdot_session *session = c->session;
    const qdot_name *old = qdot_names_find(session->names, x->name);
    qdot_class class = kind == QDOT_NAME_PARAM ? QDOT_PARAM : QDOT_COORD;
    qdot_name entry = {.name = (char *)x->name, .kind = kind};

    *fresh = false;
    c->error_at = x->start->start;
    entry.value = qdot_symbol_get(session->pool, class, x->name);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (old != NULL && old->kind == QDOT_NAME_PARAM && kind == QDOT_NAME_PARAM) {
        if (x->own && !same_domain(qdot_expr_symbol(session->pool, old->value), x))
            return qdot_fail(QDOT_ENAME, "`%s` was declared with another domain at %s:%u",
                             x->name, old->file, old->line);
    } else {
        QDOT_TRY(qdot_declare_name(c, x->start, &entry));
        *fresh = true;
        if (x->own)
            qdot_symbol_domain(session->pool, entry.value, x->lo, x->lo_open, x->hi,
                               x->hi_open);
        else
            qdot_symbol_domain(session->pool, entry.value, QDOT_NIL, false, QDOT_NIL,
                               false);
        QDOT_TRY(qdot_declare_meet_functions(session, x->name, entry.value));
    }
    if (kind == QDOT_NAME_COORD)
        return qdot_scene_coordinate(session->scene, entry.value);
    return QDOT_OK;
}

static qdot_status
declare_items(qdot_cursor *c, qdot_name_kind kind, const items *list)
{
    qdot_vec(const char *) fresh = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < list->n && status == QDOT_OK; i++) {
        bool is_fresh;

        status = declare_item(c, kind, &list->at[i], &is_fresh);
        if (is_fresh && qdot_vec_push(&fresh, list->at[i].name) != QDOT_OK)
            status = QDOT_ENOMEM;
    }
    if (status != QDOT_OK && kind == QDOT_NAME_PARAM)
        while (fresh.n > 0)
            qdot_names_remove(c->session->names, fresh.at[--fresh.n]);
    qdot_free(fresh.at);
    return status;
}

/* That every name of a coord statement is free is seen first: a scene keeps its
 * coordinates. */
static qdot_status
check_coordinates(qdot_cursor *c, const items *list)
{
    for (size_t i = 0; i < list->n; i++) {
        const item *x = &list->at[i];
        const qdot_name *old = qdot_names_find(c->session->names, x->name);

        c->error_at = x->start->start;
        QDOT_TRY(qdot_interrupt_check());
        if (old != NULL)
            return qdot_fail(QDOT_ENAME, "`%s` was declared before, at %s:%u", x->name,
                             old->file, old->line);
        for (size_t k = 0; k < i; k++)
            if (strcmp(list->at[k].name, x->name) == 0)
                return qdot_fail(QDOT_ENAME, "`%s` stands here twice", x->name);
    }
    return QDOT_OK;
}

/* Values that parameters get anew. */
static qdot_status
check_values(qdot_cursor *c, const items *list)
{
    qdot_pairs values = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < list->n && status == QDOT_OK; i++) {
        const item *x = &list->at[i];
        const qdot_name *old = qdot_names_find(c->session->names, x->name);

        if (x->value != QDOT_NIL && old != NULL && old->kind == QDOT_NAME_PARAM)
            status = qdot_pairs_push(&values, x->start, old->value, x->value);
    }
    if (status == QDOT_OK)
        status = qdot_value_check(c, &values);
    qdot_pairs_free(&values);
    return status;
}

/* Parameters with their values; a value outside its domain takes all back. */
static qdot_status
declare_params(qdot_cursor *c, const items *list)
{
    qdot_session *session = c->session;
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < list->n; i++) {
        const item *x = &list->at[i];
        const qdot_name *old = qdot_names_find(session->names, x->name);
        double number, bound;

        c->error_at = x->start->start;
        if (x->value != QDOT_NIL && old != NULL && old->kind == QDOT_NAME_PARAM)
            QDOT_TRY(qdot_session_in_domain(session, old->value, x->value));
        if (x->value == QDOT_NIL || !x->own ||
            qdot_session_number(session, x->value, &number, NULL) != QDOT_OK)
            continue;
        c->error_at = x->start->start;
        if ((x->lo != QDOT_NIL &&
             qdot_session_number(session, x->lo, &bound, NULL) == QDOT_OK &&
             (number < bound || (x->lo_open && number == bound))) ||
            (x->hi != QDOT_NIL &&
             qdot_session_number(session, x->hi, &bound, NULL) == QDOT_OK &&
             (number > bound || (x->hi_open && number == bound))))
            return qdot_fail(QDOT_EDOMAIN, "%s = %.10g is outside its own domain",
                             x->name, number);
    }
    QDOT_TRY(check_values(c, list));
    QDOT_TRY(declare_items(c, QDOT_NAME_PARAM, list));
    for (size_t i = 0; i < list->n && status == QDOT_OK; i++)
        if (list->at[i].value != QDOT_NIL)
            qdot_session_set(session,
                             qdot_names_find(session->names, list->at[i].name)->value,
                             list->at[i].value, &status);
    return status;
}

qdot_status
qdot_declare_param(qdot_cursor *c)
{
    items list = {0};
    qdot_status status = read_items(c, true, &list);

    if (status == QDOT_OK)
        status = declare_params(c, &list);
    qdot_free(list.at);
    return status;
}

qdot_status
qdot_declare_coord(qdot_cursor *c)
{
    items list = {0};
    qdot_status status = read_items(c, false, &list);

    if (status == QDOT_OK)
        status = check_coordinates(c, &list);
    if (status == QDOT_OK)
        status = declare_items(c, QDOT_NAME_COORD, &list);
    qdot_free(list.at);
    return status;
}

/* --- NAME = EXPR -------------------------------------------------------------------- */

/* An unknown name on the right that is the one being defined: say so. */
static qdot_status
tell_circle(qdot_cursor *c, const qdot_token *start, qdot_status status)
{
    if (status == QDOT_ENAME && strlen(start->text) <= c->source->length - c->error_at &&
        c->error_at > start->start &&
        qdot_names_find(c->session->names, start->text) == NULL) {
        for (const qdot_token *k = start + 1; k->kind != QDOT_TOKEN_END; k++)
            if (k->start == c->error_at && k->kind == QDOT_TOKEN_NAME &&
                strcmp(k->text, start->text) == 0)
                return k[1].kind == QDOT_TOKEN_OPERATOR && strcmp(k[1].text, "[") == 0
                           ? qdot_hint("what a family begins with is defined first: "
                                       "%s[0] = ...",
                                       start->text)
                           : qdot_hint("`%s` is just being defined: it has no meaning "
                                       "before that",
                                       start->text);
    }
    return status;
}

static qdot_status
define_function(qdot_cursor *c)
{
    const qdot_token *start = c->at;
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
        status = qdot_declare_name(c, start, &entry);
    qdot_function_body_release(entry.body);
    return status;
}

/* The text of the right side. If it reads a run in a loop, with the values of the indices, since it may
 * be written down (lang/declare/session-file). */
static qdot_status
keep_text(qdot_cursor *c, const qdot_token *right, qdot_expr value, qdot_function_body **body)
{
    qdot_source *source = NULL;
    qdot_text text = {0};
    qdot_status status;
    size_t at;

    if (c->session->loops == 0 || !qdot_measured_occurs(c->session, value)) {
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
    const qdot_token *start = c->at, *right;
    qdot_name entry = {.kind = QDOT_NAME_VALUE};
    const char *name;
    const qdot_name *old;
    qdot_status status;

    if (start[1].kind == QDOT_TOKEN_OPERATOR && strcmp(start[1].text, "(") == 0)
        return define_function(c);
    QDOT_TRY(qdot_read_name(c, &name));
    entry.name = (char *)name;
    QDOT_TRY(qdot_cursor_expect_op(c, "="));
    right = c->at;
    QDOT_TRY(tell_circle(c, start, qdot_read_named(c, &entry.value, &entry.over)));
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
    QDOT_TRY(keep_text(c, right, entry.value, &entry.body));
    status = qdot_declare_name(c, start, &entry);
    qdot_function_body_release(entry.body);
    return status;
}
