/* along.c -- values of expressions along runs; an expression may name several runs. */
#include "lang/session/along.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/momenta.h"
#include "lang/session/runs.h"

/* A column that names runs inside. Along one run it is measured as any other; along several that
 * all have digits it becomes *value, of numbers that each have theirs; else it is measured in
 * doubles. */
static qdot_status
evaluate_over_several_runs(qdot_session *session, const char *run, qdot_expr e, qdot_expr time,
                           qdot_measured *m, qdot_expr *value)
{
    double t, low;
    bool mixed;

    QDOT_TRY(qdot_member_resolve(session, &run, &e, &mixed));
    if (!mixed)
        return qdot_runs_measure_one(session, run, e, time, m);
    QDOT_TRY(qdot_member_exactly(session, run, e, time, value));
    if (*value != QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(qdot_session_split(session, time, &t, &low));
    return qdot_member_values(session, run, e,
                              &(qdot_samples){1, &t, &low, &m->value, &m->error});
}

static bool
any_refers_to_run(const qdot_session *session, const qdot_runs_columns *columns)
{
    for (size_t i = 0; i < columns->n; i++)
        if (qdot_member_any(session, columns->at[i]))
            return true;
    return false;
}

/* Record from which runs the numbers m come, to compute sensitivities (momenta written as velocities). */
static void
record_origins(qdot_session *session, const char *run, uint32_t n, const qdot_expr *args,
               qdot_expr time, qdot_measured *m)
{
    for (uint32_t i = 0; i < n; i++) {
        const bool scalar = qdot_expr_is_scalar(session->pool, args[i]);
        const uint32_t parts = scalar ? 1 : qdot_expr_count(session->pool, args[i]);

        for (uint32_t k = 0; k < parts; k++, m++)
            m->origin = (qdot_origin){
                .kind = QDOT_ORIGIN_VALUE,
                .e = qdot_momenta_to_velocities(
                    session, scalar ? args[i] : qdot_expr_arg(session->pool, args[i], k)),
                .time = time,
                .run = run};
    }
}

/* Measure the columns at a time: as numbers m [columns], or for several runs as expressions values
 * [columns], not nil. */
static qdot_status
evaluate_columns_at(qdot_session *session, const char *run, const qdot_runs_columns *columns,
                    qdot_expr time, qdot_measured *m, qdot_expr *values)
{
    if (!any_refers_to_run(session, columns))
        return qdot_runs_measure(session, run, columns, time, m);
    for (size_t i = 0; i < columns->n; i++)
        QDOT_TRY(evaluate_over_several_runs(session, run, columns->at[i], time, m + i, values + i));
    return QDOT_OK;
}

/* Evaluate e at time t, along the runs that e names, otherwise along `run`. */
static qdot_status
evaluate_at(qdot_session *session, const char *run, qdot_expr e, double t, double *value)
{
    qdot_named_run *named = NULL;
    double error;
    bool mixed;

    QDOT_TRY(qdot_member_resolve(session, &run, &e, &mixed));
    if (mixed)
        return qdot_member_values(session, run, e,
                                  &(qdot_samples){1, &t, NULL, value, &error});
    QDOT_TRY(qdot_runs_read(session, run, &named));
    return qdot_run_values_beyond(named->run, 1, &e, &(qdot_exact_times){1, &t, NULL}, value, &error);
}

/* What the numbers of runs that stand in e are off by, as it makes e at t: sum |de/dm| error
 * of m, added to *error. */
static qdot_status
add_propagated_error(qdot_session *session, const char *run, qdot_expr e, double t, double *error)
{
    const size_t n = session->measured->n;

    for (size_t i = 0; i < n; i++) {
        const qdot_measured m = session->measured->at[i];
        double slope = 0;
        qdot_expr d;

        if (!qdot_expr_contains(session->pool, e, m.symbol))
            continue;
        d = qdot_measured_as_rationals(session, qdot_diff(session->pool, e, m.symbol));
        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(evaluate_at(session, run, d, t, &slope));
        *error += slope == 0 ? 0 : fabs(slope) * m.error;
    }
    return QDOT_OK;
}

/* Add to the errors of all components of args [n] those due to errors of run results that occur in them. */
static qdot_status
add_propagated_errors(qdot_session *session, const char *run, uint32_t n, const qdot_expr *args,
                      qdot_expr time, qdot_measured *m)
{
    double t;

    QDOT_TRY(qdot_session_number(session, time, &t, NULL));
    for (uint32_t i = 0; i < n; i++) {
        const bool scalar = qdot_expr_is_scalar(session->pool, args[i]);
        const uint32_t parts = scalar ? 1 : qdot_expr_count(session->pool, args[i]);

        for (uint32_t k = 0; k < parts; k++, m++)
            QDOT_TRY(add_propagated_error(session, run,
                                          scalar ? args[i] : qdot_expr_arg(session->pool, args[i], k),
                                          t, &m->error));
    }
    return QDOT_OK;
}

qdot_status
qdot_along_value(qdot_session *session, const char *run, uint32_t n,
                 const qdot_expr *args, qdot_expr *value)
{
    qdot_runs_columns columns = {0};
    qdot_vec(qdot_expr) symbols = {0};
    qdot_measured *measured = NULL;
    qdot_expr *values = NULL;
    qdot_named_run *named = NULL;
    qdot_status status;

    if (n < 2) {
        (void)qdot_fail(QDOT_ETYPE, "`value` needs an expression and a time");
        return qdot_hint("value(theta, 20)");
    }
    QDOT_TRY(qdot_runs_read(session, run, &named));
    status = QDOT_OK;
    for (uint32_t i = 0; i + 1 < n && status == QDOT_OK; i++)
        status = qdot_runs_flatten(session, args[i], &columns);
    if (status == QDOT_OK) {
        measured = qdot_calloc(columns.n, sizeof *measured);
        values = qdot_calloc(columns.n, sizeof *values);
        status = measured == NULL || values == NULL ? QDOT_ENOMEM : QDOT_OK;
    }
    if (status == QDOT_OK)
        status = evaluate_columns_at(session, run, &columns, args[n - 1], measured, values);
    if (status == QDOT_OK)
        status = add_propagated_errors(session, run, n - 1, args, args[n - 1], measured);
    if (status == QDOT_OK && !any_refers_to_run(session, &columns))
        record_origins(session, run, n - 1, args, args[n - 1], measured);
    for (size_t i = 0; i < columns.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&symbols, values[i] != QDOT_NIL
                                             ? values[i]
                                             : qdot_measured_add(session, measured[i]));
    if (status == QDOT_OK) {
        *value = columns.n == 1
                     ? symbols.at[0]
                     : qdot_list(session->pool, (uint32_t)symbols.n, symbols.at);
        status = qdot_pool_check(session->pool);
    }
    qdot_free(measured);
    qdot_free(values);
    qdot_free(columns.at);
    qdot_free(symbols.at);
    return status;
}
