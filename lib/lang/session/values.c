/* values.c -- stores the values given by `set`, `start` and `scale`. */
#include "lang/session/values.h"

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

void
qdot_session_set(qdot_session *session, qdot_expr symbol, qdot_expr value,
                 qdot_status *status)
{
    qdot_values *values = session->values;

    for (size_t i = 0; i < values->set_symbols.n; i++)
        if (values->set_symbols.at[i] == symbol ||
            (qdot_expr_kind(session->pool, symbol) == QDOT_UFUN &&
             qdot_expr_kind(session->pool, values->set_symbols.at[i]) == QDOT_UFUN &&
             qdot_expr_node(session->pool, symbol)->op ==
                 qdot_expr_node(session->pool, values->set_symbols.at[i])->op)) {
            values->set_symbols.at[i] = symbol;
            values->set_values.at[i] = value;
            return;
        }
    if (*status == QDOT_OK)
        *status = qdot_vec_push(&values->set_symbols, symbol);
    if (*status == QDOT_OK) {
        *status = qdot_vec_push(&values->set_values, value);
        if (*status != QDOT_OK)
            values->set_symbols.n--;
    }
}

qdot_expr
qdot_session_value_set(const qdot_session *session, qdot_expr symbol)
{
    const qdot_values *values = session->values;
    const size_t at = qdot_expr_place(values->set_symbols.n, values->set_symbols.at, symbol);

    return at < values->set_symbols.n ? values->set_values.at[at] : QDOT_NIL;
}

qdot_expr
qdot_session_value_started(const qdot_session *session, qdot_expr symbol)
{
    const qdot_values *values = session->values;
    const size_t at = qdot_expr_place(values->start_symbols.n, values->start_symbols.at, symbol);

    return at < values->start_symbols.n ? values->start_values.at[at] : QDOT_NIL;
}

bool
qdot_session_is_start(const qdot_pool *pool, qdot_expr symbol)
{
    return qdot_expr_is_class(pool, symbol, QDOT_COORD) || qdot_expr_is_class(pool, symbol, QDOT_MOMENTUM);
}

/* Take out the start value of the velocity that a momentum determines, or of the momentum of a velocity. */
static void
remove_other_of_pair(qdot_session *session, qdot_expr jet)
{
    const qdot_symbol *s = qdot_expr_symbol(session->pool, jet);

    if (s->class == QDOT_MOMENTUM || s->order == 1)
        qdot_session_start_forget(session, s->class == QDOT_MOMENTUM ? qdot_symbol_jet(session->pool, s->base, 1)
                                                                     : qdot_symbol_of(session->pool, QDOT_MOMENTUM, s->base));
}

void
qdot_session_start_forget(qdot_session *session, qdot_expr symbol)
{
    qdot_values *values = session->values;
    const size_t at = qdot_expr_place(values->start_symbols.n, values->start_symbols.at, symbol);

    if (at == values->start_symbols.n)
        return;
    for (size_t i = at; i + 1 < values->start_symbols.n; i++) {
        values->start_symbols.at[i] = values->start_symbols.at[i + 1];
        values->start_values.at[i] = values->start_values.at[i + 1];
    }
    values->start_symbols.n--;
    values->start_values.n--;
}

qdot_status
qdot_session_start(qdot_session *session, qdot_expr jet, qdot_expr value)
{
    qdot_values *values = session->values;

    size_t at;

    remove_other_of_pair(session, jet);
    at = qdot_expr_place(values->start_symbols.n, values->start_symbols.at, jet);
    if (at < values->start_symbols.n) {
        values->start_values.at[at] = value;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_vec_push(&values->start_symbols, jet));
    if (qdot_vec_push(&values->start_values, value) != QDOT_OK) {
        values->start_symbols.n--;
        return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

qdot_status
qdot_session_put(qdot_session *session, qdot_expr symbol, qdot_expr value)
{
    qdot_status status = QDOT_OK;

    if (qdot_session_is_start(session->pool, symbol))
        return qdot_session_start(session, symbol, value);
    qdot_session_set(session, symbol, value, &status);
    return status;
}
