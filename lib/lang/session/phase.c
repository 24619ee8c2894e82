/* phase.c -- statements about the motion of a scene that states H alone see its phase space. */
#include "lang/session/phase.h"

#include "expr/symbol.h"
#include "lang/session/evaluation.h"
#include "lang/session/values.h"

/* The symbol by which a start value is stored: p[q] is a coordinate in the phase space, else a momentum. */
static qdot_expr
symbol_of_start(const qdot_session *session, qdot_expr symbol, bool inward)
{
    const qdot_symbol *s = qdot_expr_symbol(session->pool, symbol);
    qdot_expr momentum;

    if (inward)
        return s->class == QDOT_MOMENTUM && s->order == 0 ? qdot_phase_space_coordinate(session->scene, s->base) : symbol;
    momentum = qdot_phase_space_momentum(session->scene, symbol);
    return momentum != QDOT_NIL ? momentum : symbol;
}

static void
rename_start_values(qdot_session *session, bool inward)
{
    qdot_values *values = session->values;

    for (size_t i = 0; i < values->start_symbols.n; i++)
        values->start_symbols.at[i] = symbol_of_start(session, values->start_symbols.at[i], inward);
    for (size_t i = 0; i < values->start_errors.n; i++)
        values->start_errors.at[i].symbol = symbol_of_start(session, values->start_errors.at[i].symbol, inward);
}

qdot_status
qdot_phase_begin(qdot_session *session, bool states)
{
    qdot_evaluation *e = session->evaluation;

    if (e->phase_depth++ > 0)
        return QDOT_OK;
    QDOT_TRY(qdot_phase_space_enter(session->scene, states, &e->phase_space));
    if (e->phase_space.entered)
        rename_start_values(session, true);
    return qdot_pool_check(session->pool);
}

void
qdot_phase_end(qdot_session *session)
{
    qdot_evaluation *e = session->evaluation;

    if (e->phase_depth == 0 || --e->phase_depth > 0) /* 0: a `reset` in between began a new session */
        return;
    if (e->phase_space.entered)
        rename_start_values(session, false);
    qdot_phase_space_leave(session->scene, &e->phase_space);
}

unsigned
qdot_phase_pause(qdot_session *session)
{
    const unsigned depth = session->evaluation->phase_depth;

    session->evaluation->phase_depth = depth > 0;
    qdot_phase_end(session);
    return depth;
}

qdot_status
qdot_phase_resume(qdot_session *session, unsigned paused)
{
    qdot_status status = paused > 0 ? qdot_phase_begin(session, false) : QDOT_OK;

    session->evaluation->phase_depth = paused;
    return status;
}

uint64_t
qdot_phase_version(const qdot_session *session)
{
    const qdot_phase_space *x = &session->evaluation->phase_space;

    return x->entered ? x->before.version : session->scene->version;
}

bool
qdot_phase_has(const qdot_session *session)
{
    return session->evaluation->phase_space.entered || qdot_phase_space_needed(session->scene);
}
