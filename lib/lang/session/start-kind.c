/* start-kind.c -- in what the start of runs is given. */
#include "lang/session/start-kind.h"

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "lang/session/speeds.h"
#include "lang/session/values.h"
#include "mech/scene/scene.h"

bool
qdot_session_starts_by_momenta(const qdot_session *session)
{
    for (size_t i = 0; i < session->values->start_symbols.n; i++)
        if (qdot_expr_is_class(session->pool, session->values->start_symbols.at[i], QDOT_MOMENTUM))
            return true;
    return false;
}

bool
qdot_session_starts_by_speeds(const qdot_session *session)
{
    for (size_t i = 0; i < session->values->start_symbols.n; i++)
        if (qdot_session_is_speed(session, session->values->start_symbols.at[i]))
            return true;
    return false;
}

bool
qdot_session_starts_by_velocities(const qdot_session *session)
{
    for (size_t i = 0; i < session->values->start_symbols.n; i++) {
        const qdot_symbol *s = qdot_expr_symbol(session->pool, session->values->start_symbols.at[i]);

        if (s->class == QDOT_MOMENTUM || s->order == 1)
            return true;
    }
    return false;
}

qdot_status
qdot_session_goes_with_start(const qdot_session *session, qdot_expr symbol)
{
    const qdot_symbol *s = qdot_expr_symbol(session->pool, symbol);

    if (qdot_session_is_speed(session, symbol) && qdot_session_starts_by_velocities(session)) {
        (void)qdot_fail(QDOT_EINVAL, "the start gives velocities, and speeds determine all of them");
        return qdot_hint("`reset start`, then `start %.100s = ...`", s->name);
    }
    if ((s->class != QDOT_MOMENTUM && s->order != 1) || !qdot_session_starts_by_speeds(session))
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the start gives speeds, which determine all velocities");
    return qdot_hint("a speed in its place, or `reset start`");
}

void
qdot_session_start_forget_speeds(qdot_session *s)
{
    for (size_t i = s->values->start_symbols.n; i-- > 0;)
        if (qdot_session_is_speed(s, s->values->start_symbols.at[i]))
            qdot_session_start_forget(s, s->values->start_symbols.at[i]);
}

/* values [n]: what the speeds are at the start's coordinates and velocities. */
static void
find_values(qdot_session *s, const qdot_speeds *speeds, qdot_expr *value)
{
    const qdot_values *values = s->values;

    for (size_t k = 0; k < speeds->n; k++)
        value[k] = qdot_subs(s->pool, speeds->value[k], (uint32_t)values->start_symbols.n, values->start_symbols.at,
                             values->start_values.at);
}

qdot_status
qdot_session_start_by_speeds(qdot_session *s)
{
    const qdot_scene *scene = s->scene;
    qdot_speeds speeds;
    qdot_expr *value;
    qdot_status status;

    QDOT_TRY(qdot_session_speeds(s, &speeds));
    value = qdot_calloc(speeds.n + 1, sizeof *value);
    status = value == NULL ? QDOT_ENOMEM : QDOT_OK;
    if (status == QDOT_OK) {
        find_values(s, &speeds, value);
        status = qdot_pool_check(s->pool);
    }
    for (size_t k = 0; k < speeds.n && status == QDOT_OK; k++)
        status = qdot_session_start(s, speeds.symbol[k], value[k]);
    for (size_t i = 0; i < scene->coordinates.n && status == QDOT_OK; i++)
        qdot_session_start_forget(s, qdot_symbol_jet(s->pool, scene->coordinates.at[i], 1));
    qdot_free(value);
    qdot_free((void *)speeds.symbol);
    return status == QDOT_OK ? qdot_pool_check(s->pool) : status;
}
