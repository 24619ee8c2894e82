/* loop.c -- `for` loops: steps through the values of their indices. */
#include "lang/commands/loop.h"

#include "base/interrupt.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/language/read.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/held.h"
#include "lang/session/names.h"

/* Properties that a loop value must not have if it is to be assigned to a parameter or coordinate. */
static const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
                               QDOT_HAS_TIME | QDOT_HAS_MOMENTUM | QDOT_HAS_MULTIPLIER |
                               QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA;

/* Bind the loop index to its present value. */
static qdot_status
loop_bind(qdot_loop *loop, qdot_loop_index *index)
{
    qdot_session *session = loop->session;
    const qdot_name *known = qdot_names_find(session->names, index->name);
    const qdot_expr value = index->listed ? index->values.at[index->next]
                                          : qdot_expr_int(session->pool, index->at);

    QDOT_TRY(qdot_pool_check(session->pool));
    index->held = known != NULL &&
                  (known->kind == QDOT_NAME_PARAM || known->kind == QDOT_NAME_COORD) &&
                  qdot_expr_is_scalar(session->pool, value) &&
                  !(qdot_expr_node(session->pool, value)->holds & moving);
    if (index->held)
        QDOT_TRY(qdot_held_begin(session, known->value, value));
    if (qdot_names_push(session->names, index->name, value) == QDOT_OK)
        return QDOT_OK;
    if (index->held)
        qdot_held_end(session);
    return qdot_last_error()->status;
}

static void
unbind(qdot_loop *loop, qdot_loop_index *index)
{
    qdot_names_pop(loop->session->names);
    if (index->held)
        qdot_held_end(loop->session);
    index->held = false;
}

static void
drop_index(qdot_loop_index *index)
{
    qdot_free(index->name);
    qdot_free(index->values.at);
}

/* Read `NAME = a..b` or `NAME = [...]` at the cursor; *empty: the range has no values. */
static qdot_status
read_index(qdot_loop *loop, qdot_cursor *c, qdot_loop_index *index, bool *empty)
{
    if (c->at->kind != QDOT_TOKEN_NAME)
        return qdot_cursor_expected(c, "an index and its range: `k = 1..3`");
    index->name = qdot_strdup(c->at->text);
    if (index->name == NULL)
        return QDOT_ENOMEM;
    c->at++;
    QDOT_TRY(qdot_cursor_expect_op(c, "="));
    if (qdot_cursor_is_op(c, "[")) {
        const qdot_token *start = c->at;
        qdot_expr list;

        QDOT_TRY(qdot_read_side(c, &list));
        if (qdot_expr_kind(loop->session->pool, list) != QDOT_LIST) {
            c->error_at = start->start;
            return qdot_fail(QDOT_ETYPE,
                             "an index runs over a list `[1, 2, 5]` or a range");
        }
        index->listed = true;
        for (uint32_t i = 0; i < qdot_expr_count(loop->session->pool, list); i++)
            QDOT_TRY(qdot_vec_push(&index->values,
                                   qdot_expr_arg(loop->session->pool, list, i)));
        *empty = index->values.n == 0;
    } else {
        const qdot_token *start = c->at;
        qdot_expr from, to;

        if (qdot_read_range(c, &from, &to) != QDOT_OK)
            return qdot_last_error()->hint[0] == '\0' &&
                           qdot_last_error()->status == QDOT_ESYNTAX
                       ? qdot_hint("as in for k = 1..3, or for k = [1, 2, 5]")
                       : qdot_last_error()->status;
        c->error_at = start->start;
        QDOT_TRY(qdot_session_integer(loop->session, from, &index->at));
        QDOT_TRY(qdot_session_integer(loop->session, to, &index->last));
        *empty = index->at > index->last;
        if (!*empty &&
            (unsigned long)index->last - (unsigned long)index->at >= QDOT_LOOP_PASSES) {
            (void)qdot_fail(QDOT_ELIMIT, "a loop of %lu passes: more than %d",
                            (unsigned long)index->last - (unsigned long)index->at + 1,
                            QDOT_LOOP_PASSES);
            return qdot_hint("a function of k needs no member for each: a(k) = ...");
        }
    }
    index->behind = c->at;
    return QDOT_OK;
}

/* Advance the innermost loop index that has a value left. */
static qdot_status
advance(qdot_loop *loop, bool *more)
{
    *more = false;
    while (loop->indices.n > 0) {
        qdot_loop_index *index = &loop->indices.at[loop->indices.n - 1];

        unbind(loop, index);
        if (index->listed ? index->next + 1 < index->values.n : index->at < index->last) {
            qdot_status status;

            index->next++;
            index->at++;
            status = loop_bind(loop, index);
            if (status == QDOT_OK) {
                *more = true;
                return QDOT_OK;
            }
            drop_index(index);
            loop->indices.n--;
            return status;
        }
        drop_index(index);
        loop->indices.n--;
    }
    return QDOT_OK;
}

/* Bind the remaining indices to their first values. */
static qdot_status
descend(qdot_loop *loop, qdot_cursor *c, bool *more)
{
    for (*more = true;;) {
        qdot_loop_index index = {0};
        bool empty = false;
        qdot_status status = qdot_interrupt_check();

        if (status == QDOT_OK && loop->indices.n > 0) {
            c->at = loop->indices.at[loop->indices.n - 1].behind;
            if (!qdot_cursor_accept_op(c, ","))
                return c->at == loop->end ? QDOT_OK : qdot_cursor_expect_end(c);
        }
        if (status == QDOT_OK)
            status = read_index(loop, c, &index, &empty);
        if (status == QDOT_OK && !empty)
            status = loop_bind(loop, &index);
        if (status == QDOT_OK && !empty) {
            status = qdot_vec_push(&loop->indices, index);
            if (status == QDOT_OK)
                continue;
            unbind(loop, &index);
        }
        drop_index(&index);
        QDOT_TRY(status);
        QDOT_TRY(advance(loop, more)); /* empty range: go to the next value of the outer index */
        if (!*more)
            return QDOT_OK;
    }
}

static qdot_status
pass(qdot_loop *loop, qdot_status status, qdot_cursor *c)
{
    if (status != QDOT_OK) {
        loop->error_at = c->error_at;
        qdot_loop_end(loop);
    }
    return status;
}

qdot_status
qdot_loop_begin(qdot_loop *loop, const qdot_cursor *c, const qdot_token *end, bool *more)
{
    qdot_cursor own = *c;

    if (c->session->evaluation->loops++ == 0)
        c->session->evaluation->partial_sums.n = 0;
    *loop = (qdot_loop){
        .session = c->session, .source = c->source, .clause = c->at, .end = end, .open = true};
    own.error_at = c->at->start;
    return pass(loop, descend(loop, &own, more), &own);
}

qdot_status
qdot_loop_next(qdot_loop *loop, bool *more)
{
    qdot_cursor own = {.session = loop->session,
                       .source = loop->source,
                       .at = loop->clause,
                       .error_at = loop->clause->start};
    qdot_status status = qdot_interrupt_check();

    if (status == QDOT_OK)
        status = advance(loop, more);
    if (status == QDOT_OK && *more)
        status = descend(loop, &own, more);
    return pass(loop, status, &own);
}

void
qdot_loop_end(qdot_loop *loop)
{
    while (loop->indices.n > 0) {
        unbind(loop, &loop->indices.at[loop->indices.n - 1]);
        drop_index(&loop->indices.at[--loop->indices.n]);
    }
    qdot_free(loop->indices.at);
    loop->indices.at = NULL;
    loop->indices.capacity = 0;
    if (loop->open)
        loop->session->evaluation->loops--;
    loop->open = false;
}
