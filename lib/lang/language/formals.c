/* formals.c -- formal arguments of functions. */
#include "lang/language/formals.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/session/names.h"

qdot_status
qdot_formals_read_names(qdot_cursor *c, const qdot_token ***names, size_t *n)
{
    qdot_vec(const qdot_token *) list = {0};
    qdot_status status;

    status = qdot_cursor_expect_op(c, "(");
    if (status != QDOT_OK)
        status = qdot_hint("its arguments are written in ( ): as in function x(s), y(s, t)");

    while (status == QDOT_OK) {
        if (c->at->kind != QDOT_TOKEN_NAME) {
            status = qdot_cursor_expected(c, "the name of an argument");
            break;
        }
        for (size_t i = 0; i < list.n && status == QDOT_OK; i++)
            if (strcmp(list.at[i]->text, c->at->text) == 0) {
                c->error_at = c->at->start;
                status = qdot_fail(QDOT_ENAME, "the argument `%s` is named twice",
                                   c->at->text);
            }
        if (status == QDOT_OK)
            status = qdot_vec_push(&list, c->at);
        if (status != QDOT_OK)
            break;
        c->at++;
        if (!qdot_cursor_accept_op(c, ",")) {
            status = qdot_cursor_expect_op(c, ")");
            break;
        }
    }
    if (status != QDOT_OK) {
        qdot_free(list.at);
        list.at = NULL;
        list.n = 0;
    }
    *names = list.at;
    *n = list.n;
    return status;
}

/* The symbol of an argument; an argument t is the time itself, because that name is reserved. */
static qdot_expr
symbol_of_argument(qdot_pool *pool, const qdot_token *name)
{
    return strcmp(name->text, "t") == 0 ? QDOT_T
                                        : qdot_symbol_get(pool, QDOT_FORMAL, name->text);
}

qdot_status
qdot_formals_read(qdot_cursor *c, qdot_expr *formals, const qdot_token ***names,
                  size_t *n)
{
    qdot_vec(qdot_expr) symbols = {0};
    qdot_status status = qdot_formals_read_names(c, names, n);

    for (size_t i = 0; i < *n && status == QDOT_OK; i++)
        status = qdot_vec_push(&symbols, symbol_of_argument(c->session->pool, (*names)[i]));
    if (status == QDOT_OK) {
        *formals = qdot_list(c->session->pool, (uint32_t)symbols.n, symbols.at);
        status = qdot_pool_check(c->session->pool);
    }
    qdot_free(symbols.at);
    return status;
}

qdot_status
qdot_formals_enter(qdot_session *session, qdot_formals *f)
{
    for (size_t i = 0; i < f->n; i++) {
        const qdot_expr formal = qdot_expr_arg(session->pool, f->list, (uint32_t)i);

        if (formal == QDOT_T)
            continue;
        QDOT_TRY(qdot_names_push(session->names, f->names[i]->text, formal));
        f->entered++;
    }
    return QDOT_OK;
}

void
qdot_formals_leave(qdot_session *session, qdot_formals *f)
{
    for (; f->entered > 0; f->entered--)
        qdot_names_pop(session->names);
    qdot_free(f->names);
    f->names = NULL;
}
