/* free-request.c -- makes the request of a run whose parameter values and start depend on unknowns. */
#include "lang/slopes/free-request.h"

#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/runs/request.h"
#include "lang/session/bind.h"
#include "lang/session/speeds.h"
#include "lang/session/start-kind.h"
#include "lang/session/start-speeds.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"

/* Set parameter values and start of the request; parameters that are unknowns keep their symbols as values. */
static qdot_status
fill_free_request(qdot_session *session, size_t k, const qdot_expr *unknowns, const qdot_run_request *had,
                  qdot_expr *values, qdot_expr *start, bool *named)
{
    const size_t n = session->scene->coordinates.n;
    bool by_speeds = qdot_session_starts_by_speeds(session);

    for (size_t i = 0; i < k; i++)
        by_speeds |= qdot_session_is_speed(session, unknowns[i]);
    for (size_t i = 0; i < had->n_values; i++) {
        const qdot_expr given = qdot_session_value_set(session, had->symbols[i]);

        values[i] = given == QDOT_NIL ? had->values[i] : qdot_session_bind(session, given);
    }
    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_expr jet =
            qdot_symbol_jet(session->pool, session->scene->coordinates.at[i % n], i >= n);
        const qdot_expr given = qdot_session_value_started(session, jet);
        const bool unknown = qdot_expr_place(k, unknowns, jet) < k;

        named[i] = unknown || (by_speeds && i >= n) || given != QDOT_NIL;
        start[i] = unknown ? jet : given == QDOT_NIL ? QDOT_ZERO : qdot_session_bind(session, given);
    }
    QDOT_TRY(qdot_pool_check(session->pool));
    return by_speeds ? qdot_session_start_velocities(session, k, unknowns, start, had->t0, start + n) : QDOT_OK;
}

/* Where momenta are given or unknown, the velocities that follow from them. */
static qdot_status
fill_velocities_of_momenta(qdot_session *session, size_t k, const qdot_expr *unknowns, const qdot_run_request *had,
                           qdot_expr *start, bool *named)
{
    const size_t n = session->scene->coordinates.n;
    const qdot_start_by_momenta of = {
        .q0 = start, .v0 = start + n, .v_named = named + n, .t0 = had->t0, .k = k, .unknowns = unknowns};
    bool momenta = qdot_session_starts_by_momenta(session), in_numbers;

    for (size_t i = 0; i < k; i++)
        momenta |= qdot_expr_is_class(session->pool, unknowns[i], QDOT_MOMENTUM);
    return momenta ? qdot_start_by_momenta_solve(session, &of, &in_numbers) : QDOT_OK;
}

qdot_status
qdot_free_request(qdot_session *session, size_t k, const qdot_expr *unknowns,
                  const qdot_run_request *had, qdot_expr *values, qdot_expr *start, bool *named,
                  qdot_run_request *free)
{
    const size_t n = session->scene->coordinates.n;
    qdot_trial trial;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_trial_begin(&trial, session));
    for (size_t i = 0; i < k && status == QDOT_OK; i++)
        if (qdot_expr_is_class(session->pool, unknowns[i], QDOT_PARAM))
            qdot_session_set(session, unknowns[i], unknowns[i], &status);
    if (status == QDOT_OK)
        status = fill_free_request(session, k, unknowns, had, values, start, named);
    if (status == QDOT_OK)
        status = fill_velocities_of_momenta(session, k, unknowns, had, start, named);
    qdot_trial_end(&trial);
    *free = *had;
    free->values = values;
    free->q0 = start;
    free->v0 = start + n;
    free->q_named = named;
    free->v_named = named + n;
    free->scales = NULL;
    return status;
}
