/* held.c -- parameters and coordinates to which a loop assigns a value for one pass. */
#include "lang/session/held.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/phase.h"
#include "lang/session/units.h"
#include "lang/session/values.h"

/* --- values of `set` and `start` --------------------------------------------------------- */

qdot_status
qdot_held_begin(qdot_session *session, qdot_expr symbol, qdot_expr value)
{
    const bool starts = qdot_expr_is_class(session->pool, symbol, QDOT_COORD);
    const qdot_held held = {symbol, value, starts ? qdot_session_value_started(session, symbol) : qdot_session_value_set(session, symbol)};

    if (!qdot_expr_is_constant(session->pool, value))
        QDOT_TRY(qdot_units_join(session, symbol, value, "a value of %s is %s"));
    QDOT_TRY(qdot_vec_push(&session->evaluation->held, held));
    if (qdot_session_put(session, symbol, value) == QDOT_OK)
        return QDOT_OK;
    session->evaluation->held.n--;
    return QDOT_ENOMEM;
}

#define TAKE_OUT(list, i)                                                                \
    memmove(&(list).at[i], &(list).at[(i) + 1], (--(list).n - (i)) * sizeof *(list).at)

void
qdot_held_end(qdot_session *session)
{
    qdot_held held;
    bool starts;
    size_t n, i;

    if (session->evaluation->held.n == 0) /* the loop's value was removed by a `reset` within the loop */
        return;
    held = session->evaluation->held.at[--session->evaluation->held.n];
    starts = qdot_expr_is_class(session->pool, held.symbol, QDOT_COORD);
    n = starts ? session->values->start_symbols.n : session->values->set_symbols.n;
    i = qdot_expr_place(n, starts ? session->values->start_symbols.at : session->values->set_symbols.at, held.symbol);
    if (i == n) /* the symbol's value was removed by the statement, as `reset start` does */
        return;
    if (held.before != QDOT_NIL) {
        *(starts ? &session->values->start_values.at[i] : &session->values->set_values.at[i]) = held.before;
    } else if (starts) {
        TAKE_OUT(session->values->start_symbols, i);
        TAKE_OUT(session->values->start_values, i);
    } else {
        TAKE_OUT(session->values->set_symbols, i);
        TAKE_OUT(session->values->set_values, i);
    }
}

/* --- expressions with the values set by loops -------------------------------------------- */

qdot_expr
qdot_held_apply(qdot_session *session, qdot_expr e)
{
    for (size_t i = session->evaluation->held.n; i-- > 0 && e != QDOT_NIL;)
        e = qdot_subs(session->pool, e, 1, &session->evaluation->held.at[i].symbol,
                      &session->evaluation->held.at[i].value);
    return e;
}

qdot_expr
qdot_held_parameters(qdot_session *session, qdot_expr e)
{
    for (size_t i = session->evaluation->held.n; i-- > 0 && e != QDOT_NIL;)
        if (!qdot_expr_is_class(session->pool, session->evaluation->held.at[i].symbol, QDOT_COORD))
            e = qdot_subs(session->pool, e, 1, &session->evaluation->held.at[i].symbol,
                          &session->evaluation->held.at[i].value);
    return e;
}

bool
qdot_held_coordinate(const qdot_session *session)
{
    for (size_t i = 0; i < session->evaluation->held.n; i++)
        if (qdot_expr_is_class(session->pool, session->evaluation->held.at[i].symbol, QDOT_COORD))
            return true;
    return false;
}

qdot_status
qdot_held_check(qdot_session *session)
{
    for (size_t i = 0; i < session->evaluation->held.n; i++)
        QDOT_TRY(qdot_session_in_domain(session, session->evaluation->held.at[i].symbol,
                                        session->evaluation->held.at[i].value));
    return QDOT_OK;
}

/* --- the scene with the values set by loops ---------------------------------------------- */

static qdot_expr
insert_loop_values(qdot_expr e, void *user)
{
    return qdot_held_parameters(user, e);
}

qdot_status
qdot_held_scene_begin(qdot_session *session, qdot_scene_saved *kept)
{
    QDOT_TRY(qdot_scene_save(session->scene, kept));
    session->evaluation->declared = qdot_phase_version(session);
    return qdot_scene_map(session->scene, insert_loop_values, session);
}

void
qdot_held_scene_end(qdot_session *session, qdot_scene_saved *kept)
{
    qdot_scene_restore(session->scene, kept);
    session->evaluation->declared = 0;
}

uint64_t
qdot_held_version(const qdot_session *session)
{
    const uint64_t declared = session->evaluation->declared;

    return declared != 0 ? declared : qdot_phase_version(session);
}
