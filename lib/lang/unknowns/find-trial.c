/* find-trial.c -- one trial of the statement `find`: makes the run for given values of the unknowns, and evaluates the
 * conditions. */
#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "lang/session/speeds.h"
#include "lang/unknowns/find-trial.h"

/* a start value counts as moved by the constraints if it changes by more than this, which exceeds rounding */
static const double moved = 1e-9;

/* --- limits of the run ----------------------------------------------------------------------- */

static qdot_status
set_unknowns(qdot_find_trial *t, const double *u)
{
    qdot_pool *pool = t->f->c->session->pool;

    memcpy(t->at, u, t->f->unknowns.n * sizeof *u);
    for (size_t i = 0; i < t->f->unknowns.n; i++)
        t->values[i] = qdot_measured_rational(pool, u[i]);
    return qdot_pool_check(pool);
}

qdot_status
qdot_find_trial_limits(qdot_find_trial *t, const double *u)
{
    qdot_session *session = t->f->c->session;
    qdot_trial trial;
    qdot_status status;

    QDOT_TRY(set_unknowns(t, u));
    QDOT_TRY(qdot_trial_begin(&trial, session));
    status = qdot_slope_names_put(session, t->f->unknowns.n, t->f->unknowns.at, t->values);
    if (status == QDOT_OK)
        status = qdot_find_limits(t->f, &t->from, &t->to);
    if (status == QDOT_OK) {
        t->from = qdot_session_bind(session, t->from);
        t->to = qdot_session_bind(session, t->to);
        status = qdot_pool_check(session->pool);
    }
    qdot_trial_end(&trial);
    return status;
}

qdot_status
qdot_find_trial_length(const qdot_find_trial *t, double *length)
{
    double from, to;

    QDOT_TRY(qdot_session_number(t->f->c->session, t->from, &from, NULL));
    QDOT_TRY(qdot_session_number(t->f->c->session, t->to, &to, NULL));
    *length = fabs(to - from);
    return QDOT_OK;
}

/* --- the run --------------------------------------------------------------------------------- */

/* Fail if projection onto the constraints moved the unknowns, because no free start value could satisfy them. */
static qdot_status
check_start_not_moved(const qdot_find_trial *t)
{
    const qdot_session *session = t->f->c->session;
    const double t0 = qdot_run_get_report(t->trial.run)->t0;

    for (size_t i = 0; i < t->f->unknowns.n && session->scene->constraints.n > 0; i++) {
        const qdot_slope_name *one = &t->f->unknowns.at[i];
        double value;

        if (!qdot_expr_is_class(session->pool, one->symbol, QDOT_COORD) || qdot_session_is_speed(session, one->symbol))
            continue;
        QDOT_TRY(qdot_run_values(t->trial.run, 1, &one->symbol, 1, &t0, &value, NULL));
        if (!(fabs(value - t->at[i]) <= moved * fmax(1, fabs(value))))
            return qdot_fail(QDOT_EDOMAIN, "the constraints do not let %.100s start at %.10g beside what `start` names",
                             one->label, t->at[i]);
    }
    return QDOT_OK;
}

qdot_status
qdot_find_trial_open(qdot_find_trial *t, const double *u)
{
    const qdot_find *f = t->f;
    double length;

    if (t->trial.session != NULL && memcmp(t->at, u, f->unknowns.n * sizeof *u) == 0)
        return QDOT_OK;
    qdot_find_trial_close(t);
    QDOT_TRY(qdot_find_trial_limits(t, u));
    QDOT_TRY(qdot_find_trial_length(t, &length));
    QDOT_TRY(qdot_find_spend(&t->budget, length));
    QDOT_TRY(qdot_trial_begin(&t->trial, f->c->session));
    QDOT_TRY(qdot_slope_names_put(f->c->session, f->unknowns.n, f->unknowns.at, t->values));
    QDOT_TRY(qdot_run_options_try(&t->trial, &f->run, t->from, t->to));
    qdot_find_spent(&t->budget, t->trial.run, 1);
    QDOT_TRY(check_start_not_moved(t));
    QDOT_TRY(qdot_find_residuals(f, t->from, t->e));
    if (!t->sized)
        QDOT_TRY(qdot_find_sizes(f, t->trial.run, t->e, t->size));
    t->sized = true;
    return QDOT_OK;
}

void
qdot_find_trial_close(qdot_find_trial *t)
{
    if (t->slopes.session != NULL)
        qdot_slopes_free(&t->slopes);
    qdot_trial_end(&t->trial);
}

/* --- the residuals and their slopes ---------------------------------------------------------- */

qdot_status
qdot_find_trial_numbers(const qdot_find_trial *t, double *value, double *error)
{
    for (size_t i = 0; i < t->m; i++)
        QDOT_TRY(qdot_session_number(t->trial.session, t->e[i], &value[i], &error[i]));
    return QDOT_OK;
}

/* Make the run with its variational equations, up to the time that the numbers in e [m] need. */
static qdot_status
make_variational_run(qdot_find_trial *t, const qdot_expr *e)
{
    if (t->slopes.session != NULL) /* free the slopes of an earlier call */
        qdot_slopes_free(&t->slopes);
    t->slopes.session = t->trial.session;
    for (size_t k = 0; k < t->f->unknowns.n; k++) {
        qdot_slope_name x = t->f->unknowns.at[k];
        qdot_status status;

        x.label = qdot_strdup(x.label);
        status = x.label ? qdot_vec_push(&t->slopes.names, x) : QDOT_ENOMEM;
        if (status != QDOT_OK) {
            qdot_free(x.label);
            return status;
        }
    }
    return qdot_slopes_make(&t->slopes, NULL, qdot_list(t->trial.session->pool, (uint32_t)t->m, e),
                            t->trial.measured);
}

/* Replace results of other runs, and numbers that were there before the search, in the expression e by constants. */
static qdot_status
replace_other_results(const qdot_find_trial *t, qdot_expr *e)
{
    qdot_session *session = t->trial.session;
    qdot_named_run *named;

    for (size_t i = 0; i < session->measured->n; i++) {
        const qdot_measured *m = &session->measured->at[i];
        qdot_expr number;

        if (!qdot_expr_contains(session->pool, *e, m->symbol))
            continue;
        if (i >= t->trial.measured) {
            if (m->origin.run == NULL)
                continue;
            QDOT_TRY(qdot_runs_find(session, m->origin.run, &named));
            if (named->run == t->trial.run)
                continue;
        }
        number = m->digits > 0 ? m->exact : qdot_measured_rational(session->pool, m->value);
        *e = qdot_subs(session->pool, *e, 1, &m->symbol, &number);
    }
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_find_trial_slopes(qdot_find_trial *t, double *slope, double *error)
{
    const size_t n = t->f->unknowns.n;
    qdot_status status = QDOT_OK;
    qdot_expr *held = qdot_calloc(t->m + 1, sizeof *held);

    if (held == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < t->m && status == QDOT_OK; i++) {
        held[i] = t->e[i];
        status = replace_other_results(t, &held[i]);
    }
    if (status == QDOT_OK)
        status = make_variational_run(t, held);
    for (size_t i = 0; i < t->m * n && status == QDOT_OK; i++) {
        qdot_expr one;

        status = qdot_slopes_of(&t->slopes, held[i / n], t->trial.measured, i % n, &one);
        if (status == QDOT_OK)
            status = qdot_session_number(t->trial.session, one, &slope[i], &error[i]);
    }
    qdot_free(held);
    qdot_find_spent(&t->budget, t->trial.run, 1 + n);
    return status;
}
