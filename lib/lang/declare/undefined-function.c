/* undefined-function.c -- the statement `function`: declares functions without a definition. */
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/pool.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/declare/declare.h"
#include "lang/session/history.h"
#include "lang/session/values.h"
#include "lang/syntax/record.h"
#include "mech/scene/scene.h"

static qdot_status declare_functions(qdot_record *r);

QDOT_STATEMENT(function) = {
    .word = "function",
    .group = QDOT_DECLARING,
    .usage = "function NAME(ARGUMENTS), ...",
    .summary = "declare undefined functions; the bare name means the function at these arguments",
    .example = "function x(s), y(s, t)",
    .handler = declare_functions,
};

/* --- declaring undefined functions -------------------------------------------------- */

/* The symbol that an argument in `function x(s, t)` means: a declared one, the time,
 * else a symbol of its own. */
static qdot_expr
symbol_of_argument(qdot_session *session, const char *name)
{
    const qdot_name *known = qdot_names_find(session->names, name);

    if (strcmp(name, "t") == 0)
        return QDOT_T;
    if (known != NULL && qdot_expr_kind(session->pool, known->value) == QDOT_SYM)
        return known->value;
    return qdot_symbol_get(session->pool, QDOT_FORMAL, name);
}

qdot_status
qdot_declare_undefined(qdot_cursor *c, const qdot_token *start, const char *name, size_t n, const char *const *arguments,
                       qdot_function_body *data)
{
    qdot_pool *pool = c->session->pool;
    qdot_name entry = {.name = (char *)name, .kind = QDOT_NAME_UFUN, .body = data};
    const qdot_name *old = qdot_names_find(c->session->names, name);
    qdot_vec(qdot_expr) formals = {0};
    qdot_status status = QDOT_OK;

    if (data == NULL && old != NULL && old->kind == QDOT_NAME_UFUN && old->body != NULL) {
        c->error_at = start->start;
        (void)qdot_fail(QDOT_ENAME, "`%s` has its values from a table, since %s:%u", name, old->file, old->line);
        return qdot_hint("another name, or no `function`: `data` declares one");
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = qdot_vec_push(&formals, symbol_of_argument(c->session, arguments[i]));
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_ufun_declare(pool, name, (uint32_t)n, formals.at, &entry.ufun);
    if (status == QDOT_OK) {
        entry.value = qdot_ufun_apply(pool, entry.ufun, formals.at, NULL);
        entry.formals = qdot_list(pool, (uint32_t)n, formals.at);
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK)
        status = qdot_declare_name(c, start, NULL, &entry);
    qdot_free(formals.at);
    return status;
}

/* Declare the undefined function in a part of the statement such as NAME(u, v), and return its name. */
static qdot_status
declare_function_of_part(qdot_record *r, const qdot_filled *part, const char **name)
{
    qdot_vec(const char *) arguments = {0};
    qdot_formals f;
    qdot_status status;

    QDOT_TRY(qdot_record_name(r, part, name));
    status = qdot_record_formals(r, part, &f);
    for (size_t i = 0; i < f.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&arguments, f.names[i]->text);
    if (status == QDOT_OK)
        status = qdot_declare_undefined(&r->cursor, part->from, *name, arguments.n, arguments.at, NULL);
    qdot_free(arguments.at);
    qdot_formals_leave(r->cursor.session, &f);
    return status;
}

static qdot_status
declare_functions(qdot_record *r)
{
    const char *const hole = "NAME(ARGUMENTS)";
    qdot_vec(const char *) done = {0};
    qdot_status status = QDOT_OK;

    for (const qdot_filled *part = qdot_record_hole(r, NULL, hole); part != NULL && status == QDOT_OK;
         part = qdot_record_next(r, part, hole)) {
        const char *name;

        status = declare_function_of_part(r, part, &name);
        if (status == QDOT_OK)
            status = qdot_vec_push(&done, name);
    }
    if (status != QDOT_OK)
        while (done.n > 0)
            qdot_names_remove(r->cursor.session->names, done.at[--done.n]);
    qdot_free(done.at);
    return status;
}

/* --- arguments declared after the function ------------------------------------------ */

/* formals with the symbol of its own for NAME replaced by `symbol`; the same LIST if
 * there is none. */
static qdot_expr
declared_argument_list(qdot_pool *pool, qdot_expr formals, const char *name, qdot_expr symbol)
{
    qdot_expr own = qdot_symbol_get(pool, QDOT_FORMAL, name);

    return qdot_subs(pool, formals, 1, &own, &symbol);
}

/* `own`, the symbol that stood for the argument, by the declared one, in every value named, asked
 * or set and in the scene. */
static qdot_status
replace_argument_symbol(qdot_session *session, qdot_expr own, qdot_expr symbol)
{
    qdot_pool *pool = session->pool;
    const qdot_name *one;

    for (size_t i = 0; (one = qdot_names_at(session->names, i)) != NULL; i++) {
        qdot_expr value = one->value;

        if (value == QDOT_NIL)
            continue;
        value = qdot_subs(pool, value, 1, &own, &symbol);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(qdot_names_update(session->names, one->name, value, one->formals));
    }
    for (size_t i = 0; i < session->history->values.n; i++)
        session->history->values.at[i] =
            qdot_subs(pool, session->history->values.at[i], 1, &own, &symbol);
    for (size_t i = 0; i < session->values->set_symbols.n; i++) {
        session->values->set_symbols.at[i] =
            qdot_subs(pool, session->values->set_symbols.at[i], 1, &own, &symbol);
        session->values->set_values.at[i] =
            qdot_subs(pool, session->values->set_values.at[i], 1, &own, &symbol);
    }
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_scene_replace(session->scene, own, symbol);
}

qdot_status
qdot_declare_meet_functions(qdot_session *session, const char *name, qdot_expr symbol)
{
    qdot_vec(const char *) met = {0};
    qdot_status status = QDOT_OK;
    const qdot_name *one;

    if (session->pool->ufuns.n == 0)
        return QDOT_OK;
    for (size_t i = 0;
         status == QDOT_OK && (one = qdot_names_at(session->names, i)) != NULL; i++)
        if (one->kind == QDOT_NAME_UFUN &&
            declared_argument_list(session->pool, one->formals, name, symbol) != one->formals)
            status = qdot_vec_push(&met, one->name);
    if (status == QDOT_OK)
        status = qdot_pool_check(session->pool);
    for (size_t i = 0; i < met.n && status == QDOT_OK; i++) {
        const qdot_name *entry = qdot_names_find(session->names, met.at[i]);
        qdot_expr formals = declared_argument_list(session->pool, entry->formals, name, symbol);

        status = qdot_pool_check(session->pool);
        if (status == QDOT_OK)
            status = qdot_ufun_redeclare(session->pool, entry->ufun, formals);
        if (status == QDOT_OK)
            status = qdot_names_update(session->names, met.at[i], entry->value, formals);
    }
    if (status == QDOT_OK && met.n > 0)
        status = replace_argument_symbol(
            session, qdot_symbol_get(session->pool, QDOT_FORMAL, name), symbol);
    qdot_free(met.at);
    return status;
}
