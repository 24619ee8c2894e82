/* loop.c -- `for` loops: steps through the values of their indices. */
#include "lang/commands/loop.h"

#include <inttypes.h>

#include "base/interrupt.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/held.h"
#include "lang/session/names.h"
#include "lang/syntax/loop-clause.h"

/* Symbols that a value must not contain if a loop is to assign it to a parameter or coordinate. */
static const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
                               QDOT_HAS_TIME | QDOT_HAS_MOMENTUM | QDOT_HAS_MULTIPLIER |
                               QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA;

/* Bind the loop index to its present value. */
static qdot_status
bind_index(qdot_loop *loop, qdot_loop_index *index)
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
unbind_index(qdot_loop *loop, qdot_loop_index *index)
{
    qdot_names_pop(loop->session->names);
    if (index->held)
        qdot_held_end(loop->session);
    index->held = false;
}

static void
free_index(qdot_loop_index *index)
{
    qdot_free(index->name);
    qdot_free(index->values.at);
}

/* Evaluate the values of a loop index given as a list, [1, 2, 5]. */
static qdot_status
evaluate_list_of_values(qdot_loop *loop, const qdot_filled *values, qdot_loop_index *index)
{
    qdot_pool *pool = loop->session->pool;
    qdot_expr list;

    if (values->n > 1)
        return qdot_record_expected(loop->record, loop->record->compiled.at[values->first].to, "the end of the statement");
    QDOT_TRY(qdot_record_side(loop->record, values, 0, &list));
    if (qdot_expr_kind(pool, list) != QDOT_LIST) {
        qdot_record_blame(loop->record, values);
        return qdot_fail(QDOT_ETYPE, "an index runs over a list `[1, 2, 5]` or a range");
    }
    index->listed = true;
    for (uint32_t i = 0; i < qdot_expr_count(pool, list); i++)
        QDOT_TRY(qdot_vec_push(&index->values, qdot_expr_arg(pool, list, i)));
    return QDOT_OK;
}

/* Evaluate the two ends of a loop index given as a range a..b. */
static qdot_status
read_range(qdot_loop *loop, const qdot_filled *values, qdot_loop_index *index)
{
    qdot_expr from, to;

    QDOT_TRY(qdot_record_item(loop->record, values, 0, &from));
    if (values->n == 1)
        return qdot_loop_clause_need_range(loop->record, values);
    QDOT_TRY(qdot_record_item(loop->record, values, 1, &to));
    qdot_record_blame(loop->record, values);
    QDOT_TRY(qdot_session_integer(loop->session, from, &index->at));
    QDOT_TRY(qdot_session_integer(loop->session, to, &index->last));
    if (index->at <= index->last && (uint64_t)index->last - (uint64_t)index->at >= QDOT_LOOP_PASSES) {
        (void)qdot_fail(QDOT_ELIMIT, "a loop of %" PRIu64 " passes: more than %d",
                        (uint64_t)index->last - (uint64_t)index->at + 1, QDOT_LOOP_PASSES);
        return qdot_hint("a function of k needs no member for each: a(k) = ...");
    }
    return QDOT_OK;
}

/* Evaluate the values of the loop index whose name this part is; *empty: there are none. */
static qdot_status
read_index(qdot_loop *loop, const qdot_filled *name, qdot_loop_index *index, bool *empty)
{
    const qdot_filled *values = name + 2; /* the values stand after `=` */

    index->name = qdot_strdup(name->from->text);
    if (index->name == NULL)
        return QDOT_ENOMEM;
    index->behind = values + 1;
    QDOT_TRY(qdot_loop_clause_is_list(values) ? evaluate_list_of_values(loop, values, index) : read_range(loop, values, index));
    *empty = index->listed ? index->values.n == 0 : index->at > index->last;
    return QDOT_OK;
}

/* Advance the innermost loop index that has a value left; *more: there is one. */
static qdot_status
advance_indices(qdot_loop *loop, bool *more)
{
    *more = false;
    while (loop->indices.n > 0) {
        qdot_loop_index *index = &loop->indices.at[loop->indices.n - 1];

        unbind_index(loop, index);
        if (index->listed ? index->next + 1 < index->values.n : index->at < index->last) {
            qdot_status status;

            index->next++;
            index->at++;
            status = bind_index(loop, index);
            if (status == QDOT_OK) {
                *more = true;
                return QDOT_OK;
            }
            free_index(index);
            loop->indices.n--;
            return status;
        }
        free_index(index);
        loop->indices.n--;
    }
    return QDOT_OK;
}

/* Bind the loop indices not yet bound to their first values. */
static qdot_status
bind_remaining_indices(qdot_loop *loop, bool *more)
{
    for (*more = true;;) {
        const qdot_filled *name = loop->clause;
        qdot_loop_index index = {0};
        bool empty = false;
        qdot_status status = qdot_interrupt_check();

        if (loop->indices.n > 0)
            name = loop->indices.at[loop->indices.n - 1].behind;
        if (status == QDOT_OK && name == loop->end)
            return QDOT_OK;
        if (status == QDOT_OK)
            status = read_index(loop, name + (loop->indices.n > 0), &index, &empty); /* behind a comma */
        if (status == QDOT_OK && !empty)
            status = bind_index(loop, &index);
        if (status == QDOT_OK && !empty) {
            status = qdot_vec_push(&loop->indices, index);
            if (status == QDOT_OK)
                continue;
            unbind_index(loop, &index);
        }
        free_index(&index);
        QDOT_TRY(status);
        QDOT_TRY(advance_indices(loop, more)); /* empty range: go to the next value of the outer index */
        if (!*more)
            return QDOT_OK;
    }
}

/* After a failure end the loop; otherwise errors are again shown where the record says. */
static qdot_status
end_loop_on_failure(qdot_loop *loop, qdot_status status, size_t place)
{
    if (status != QDOT_OK)
        qdot_loop_end(loop);
    else
        loop->record->cursor.error_at = place;
    return status;
}

qdot_status
qdot_loop_begin(qdot_loop *loop, qdot_record *record, const qdot_filled *clause, const qdot_filled *end, bool *more)
{
    qdot_session *session = record->cursor.session;
    const size_t place = record->cursor.error_at;

    record->cursor.error_at = clause->from->start;
    if (session->evaluation->loops++ == 0)
        session->evaluation->partial_sums.n = 0;
    *loop = (qdot_loop){.session = session, .record = record, .clause = clause, .end = end, .open = true};
    return end_loop_on_failure(loop, bind_remaining_indices(loop, more), place);
}

qdot_status
qdot_loop_next(qdot_loop *loop, bool *more)
{
    const size_t place = loop->record->cursor.error_at;
    qdot_status status = qdot_interrupt_check();

    loop->record->cursor.error_at = loop->clause->from->start;
    if (status == QDOT_OK)
        status = advance_indices(loop, more);
    if (status == QDOT_OK && *more)
        status = bind_remaining_indices(loop, more);
    return end_loop_on_failure(loop, status, place);
}

void
qdot_loop_end(qdot_loop *loop)
{
    while (loop->indices.n > 0) {
        unbind_index(loop, &loop->indices.at[loop->indices.n - 1]);
        free_index(&loop->indices.at[--loop->indices.n]);
    }
    qdot_free(loop->indices.at);
    loop->indices.at = NULL;
    loop->indices.capacity = 0;
    if (loop->open)
        loop->session->evaluation->loops--;
    loop->open = false;
}
