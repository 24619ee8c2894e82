/* trial.c -- a run at given values of unknowns. */
#include "lang/slopes/trial.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/runs/own-run.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/momenta.h"
#include "lang/session/runs.h"

qdot_status
qdot_trial_put(qdot_session *session, size_t n, const qdot_slope_name *unknowns,
               const qdot_expr *values)
{
    for (size_t i = 0; i < n; i++) {
        const qdot_expr symbol = unknowns[i].symbol;

        if (qdot_expr_is_class(session->pool, symbol, QDOT_PARAM))
            QDOT_TRY(qdot_session_in_domain(session, symbol, values[i]));
        QDOT_TRY(qdot_session_put(session, symbol, values[i]));
    }
    return QDOT_OK;
}

qdot_status
qdot_trial_open(qdot_trial *t, const qdot_expr *values)
{
    qdot_session *session = t->session;

    QDOT_TRY(qdot_session_keep_values(session, &t->kept));
    t->open = true;
    t->first = session->measured->n;
    QDOT_TRY(qdot_trial_put(session, t->n, t->unknowns, values));
    return qdot_own_run_make(session, t->options, t->from, t->to, &t->run, &t->end);
}

void
qdot_trial_close(qdot_trial *t)
{
    qdot_session *session = t->session;

    if (!t->open)
        return;
    if (t->slopes.session != NULL)
        qdot_slopes_free(&t->slopes);
    qdot_own_run_drop(session);
    session->measured->n = t->first;
    qdot_session_restore_values(session, &t->kept);
    t->open = false;
    t->run = NULL;
}

/* --- results of the run as numbers --------------------------------------------------------- */

qdot_status
qdot_trial_at_time(qdot_session *session, qdot_expr e, qdot_expr time, qdot_expr *number)
{
    qdot_measured m;

    QDOT_TRY(qdot_runs_measure_one(session, NULL, qdot_measured_as_rationals(session, e),
                                   time, &m));
    m.origin = (qdot_origin){.kind = QDOT_ORIGIN_VALUE, .e = e, .time = time};
    *number = qdot_measured_add(session, m);
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_trial_at_end(qdot_session *session, qdot_expr *e)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
                            QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER;
    qdot_named_run *named;

    *e = qdot_momenta_to_velocities(session, *e);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (!(qdot_expr_node(session->pool, *e)->holds & moving))
        return QDOT_OK;
    QDOT_TRY(qdot_runs_find(session, NULL, &named));
    if (qdot_run_get_report(named->run)->status == QDOT_RUN_STOPPED) {
        (void)qdot_fail(QDOT_EINVAL, "the run ended at an event: its end moves too");
        return qdot_hint("value(x, EVENT[1])");
    }
    return qdot_trial_at_time(session, *e, named->conditions->t1, e);
}

qdot_status
qdot_trial_numbers(qdot_trial *t, size_t m, const qdot_expr *e, double *value,
                   double *error)
{
    for (size_t i = 0; i < m; i++)
        QDOT_TRY(qdot_session_number(t->session, e[i], &value[i], &error[i]));
    return QDOT_OK;
}

/* --- derivatives of the results ------------------------------------------------------------ */

static qdot_status
name_directions(qdot_trial *t)
{
    t->slopes.session = t->session;
    for (size_t k = 0; k < t->n; k++) {
        qdot_slope_name x = t->unknowns[k];
        qdot_status status;

        x.label = qdot_strdup(x.label);
        status = x.label ? qdot_vec_push(&t->slopes.names, x) : QDOT_ENOMEM;
        if (status != QDOT_OK) {
            qdot_free(x.label);
            return status;
        }
    }
    return QDOT_OK;
}

qdot_status
qdot_trial_vary(qdot_trial *t, size_t m, const qdot_expr *e)
{
    if (t->slopes.session != NULL) /* of an earlier call */
        qdot_slopes_free(&t->slopes);
    QDOT_TRY(name_directions(t));
    return qdot_slopes_make(
        &t->slopes, NULL,
        m == 0 ? QDOT_ZERO : qdot_list(t->session->pool, (uint32_t)m, e), t->first);
}

/* Replace the results of other runs in e by constants. */
static qdot_status
hold_others(const qdot_trial *t, qdot_expr *e)
{
    qdot_session *session = t->session;
    qdot_named_run *named;

    for (size_t i = t->first; i < session->measured->n; i++) {
        const qdot_measured *m = &session->measured->at[i];
        qdot_expr number;

        if (m->origin.run == NULL)
            continue;
        QDOT_TRY(qdot_runs_find(session, m->origin.run, &named));
        if (named->run == t->run)
            continue;
        number =
            m->digits > 0 ? m->exact : qdot_measured_rational(session->pool, m->value);
        *e = qdot_subs(session->pool, *e, 1, &m->symbol, &number);
    }
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_trial_slopes(qdot_trial *t, size_t m, const qdot_expr *e, double *slope,
                  double *error)
{
    qdot_status status = QDOT_OK;
    qdot_expr *held = qdot_calloc(m + 1, sizeof *held);

    if (held == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m && status == QDOT_OK; i++) {
        held[i] = e[i];
        status = hold_others(t, &held[i]);
    }
    if (status == QDOT_OK)
        status = qdot_trial_vary(t, m, held);
    for (size_t i = 0; i < m * t->n && status == QDOT_OK; i++) {
        qdot_expr one;

        status = qdot_slopes_of(&t->slopes, held[i / t->n], t->first, i % t->n, &one);
        if (status == QDOT_OK)
            status = qdot_session_number(t->session, one, &slope[i],
                                         error != NULL ? &error[i] : NULL);
    }
    qdot_free(held);
    return status;
}
