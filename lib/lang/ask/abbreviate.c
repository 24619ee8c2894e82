/* abbreviate.c -- prints a value with names for its repeated parts. */
#include "expr/abbreviate.h"
#include "expr/node.h"
#include "expr/symbol.h"

#include <string.h>

#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/ask/ask.h"
#include "lang/language/token-text.h"
#include "lang/session/history.h"
#include "lang/session/measured.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_abbreviate(qdot_record *r);

QDOT_STATEMENT(abbreviate) = {
    .word = "abbreviate",
    .group = QDOT_ASKING,
    .usage = "abbreviate EXPR",
    .summary = "the value with names for the parts that it repeats: first the parts, D1 = ..., then what "
               "they stand in; the names are not declared",
    .example = "abbreviate eom",
    .handler = carry_out_abbreviate,
};

typedef struct {
    const qdot_session *session;
    qdot_expr atoms; /* a LIST of the symbols and functions in the value */
} names_in_use;

static bool
is_name_in_use(const char *name, void *user)
{
    const names_in_use *n = user;
    const qdot_pool *pool = n->session->pool;

    for (uint32_t i = 0; i < qdot_expr_count(pool, n->atoms); i++) {
        const qdot_symbol *s = qdot_expr_symbol(pool, qdot_expr_arg(pool, n->atoms, i));

        if (s != NULL && strcmp(s->name, name) == 0)
            return true;
    }
    return qdot_cursor_knows(n->session, name);
}

/* Print the repeated parts, each with its name, then the value in terms of these names. */
static qdot_status
abbreviate_answer(qdot_session *session, const char *name, qdot_expr value, qdot_expr over)
{
    names_in_use taken = {session, qdot_expr_atoms(session->pool, value, false)};
    qdot_abbreviated a;
    qdot_status status;

    QDOT_TRY(qdot_pool_check(session->pool));
    status = qdot_abbreviate(session->pool, value, is_name_in_use, &taken, &a);
    for (size_t i = 0; i < a.parts.n && status == QDOT_OK; i++) {
        const qdot_expr symbol = a.symbols.at[i];

        status = qdot_answer_solved(session, qdot_expr_symbol(session->pool, symbol)->name,
                                    symbol, a.parts.at[i]);
    }
    if (status == QDOT_OK)
        status = qdot_ask_answer(session, name, a.whole, over);
    qdot_abbreviated_clear(&a);
    return status;
}

static qdot_status
carry_out_abbreviate(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *expression = qdot_record_hole(r, NULL, "EXPR");
    qdot_text name = {0};
    qdot_expr value, over;
    qdot_status status;

    QDOT_TRY(qdot_record_named(r, expression, &value, &over));
    r->cursor.error_at = r->start->start;
    qdot_token_text(session, expression->from, expression->to, &name);
    status = qdot_text_status(&name);
    if (status == QDOT_OK)
        status = qdot_session_remember(session, value, over);
    if (status == QDOT_OK && qdot_measured_occurs(session, value))
        status = qdot_ask_answer(session, qdot_text_str(&name), value, over);
    else if (status == QDOT_OK)
        status = abbreviate_answer(session, qdot_text_str(&name), value, over);
    qdot_text_clear(&name);
    return status;
}
