/* scale.c -- `scale`: the sizes that tolerances and errors of coordinates are relative to. */
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/commands/pairs.h"
#include "lang/commands/set.h"
#include "lang/commands/handlers.h"
#include "lang/language/read.h"
#include "lang/session/bind.h"
#include "lang/session/scales.h"

/* q, q' or t, and its value. */
static qdot_status
scale_read_one(qdot_cursor *c, qdot_pairs *list)
{
    const qdot_token *start = c->at;
    qdot_expr symbol = QDOT_T, value = QDOT_NIL;

    if (qdot_cursor_is_word(c, "t"))
        c->at++;
    else
        QDOT_TRY(qdot_read_coordinate(c, &symbol));
    if (symbol != QDOT_T && qdot_expr_symbol(c->session->pool, symbol)->order > 1) {
        c->error_at = start->start;
        return qdot_fail(QDOT_EINVAL,
                         "a scale is that of a coordinate, a velocity or of t");
    }
    QDOT_TRY(qdot_set_read_constant(c, &value));
    c->error_at = start->start;
    QDOT_TRY(qdot_scales_check(c->session, symbol, value));
    return qdot_pairs_push(list, start, symbol, value);
}

qdot_status
qdot_scale_statement(qdot_cursor *c)
{
    qdot_pairs list = {0};
    qdot_status status;

    do {
        status = scale_read_one(c, &list);
    } while (status == QDOT_OK && qdot_cursor_accept_op(c, ","));
    if (status == QDOT_OK)
        status = qdot_cursor_expect_end(c);
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++)
        status = qdot_scales_set(c->session, list.symbols.at[i], list.values.at[i]);
    qdot_pairs_free(&list);
    return status;
}
