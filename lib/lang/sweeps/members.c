/* members.c -- reads the parameters that a sweep varies, and makes its runs (members). */
#include "lang/sweeps/members.h"

#include "lang/session/bind.h"
#include "lang/session/values.h"

/* --- reading the statement -------------------------------------------------------------- */

qdot_status
qdot_members_find(qdot_record *r, qdot_members *m)
{
    const qdot_filled *run = qdot_record_word(r, "run"), *colon = run;

    while (!qdot_filled_is(colon, ":"))
        colon++;
    QDOT_TRY(qdot_sweep_axes_find(r, qdot_record_hole(r, NULL, "NAME"), run, &m->axes));
    QDOT_TRY(qdot_run_options_find(r, run + 1, colon, &m->run));
    for (size_t i = 0; i < m->axes.at.n; i++)
        for (size_t k = 0; k < m->run.with.symbols.n; k++)
            if (m->run.with.symbols.at[k] == m->axes.at.at[i].symbol) {
                qdot_record_blame(r, m->axes.at.at[i].place);
                return qdot_fail(QDOT_EINVAL, "%s is swept, and has a value behind `with`",
                                 m->axes.at.at[i].label);
            }
    return QDOT_OK;
}

void
qdot_members_free(qdot_members *m)
{
    qdot_sweep_axes_free(&m->axes);
    qdot_run_options_free(&m->run);
}

/* --- the run of one member -------------------------------------------------------------- */

/* Set the i-th swept parameter to its value in run (member) k of the sweep. */
static qdot_status
set_swept_parameter(qdot_session *session, const qdot_members *m, size_t k, size_t i, double *number)
{
    const qdot_expr value = qdot_sweep_axes_value(session, &m->axes, k, i);

    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_session_number(session, value, number, NULL));
    return qdot_session_put(session, m->axes.at.at[i].symbol, value);
}

qdot_status
qdot_members_set(qdot_session *session, const qdot_members *m, size_t k, double *swept)
{
    for (size_t i = 0; i < m->axes.at.n; i++)
        QDOT_TRY(set_swept_parameter(session, m, k, i, &swept[i]));
    return qdot_run_options_put(session, &m->run); /* the columns need these values, too, as they may contain the parameters */
}

/* Make run (member) k of a sweep up to `to`, and call `use` on it; meanwhile it is the latest run of the session. */
static qdot_status
make_member_run(qdot_cursor *c, const qdot_members *m, size_t k, qdot_expr to, double *swept,
                qdot_member_use use, void *user)
{
    qdot_trial trial;
    qdot_status status;

    QDOT_TRY(qdot_trial_begin(&trial, c->session));
    status = qdot_members_set(c->session, m, k, swept);
    if (status == QDOT_OK)
        status = qdot_run_options_try(&trial, &m->run, m->run.from, to);
    if (status == QDOT_OK)
        status = use(c, trial.run, trial.end, user);
    qdot_trial_end(&trial);
    return status;
}

qdot_status
qdot_members_run(qdot_cursor *c, const qdot_members *m, size_t k, double *swept,
                 qdot_member_use use, void *user)
{
    return make_member_run(c, m, k, m->run.to, swept, use, user);
}

qdot_status
qdot_members_begin(qdot_cursor *c, const qdot_members *m, size_t k, double *swept,
                   qdot_member_use use, void *user)
{
    return make_member_run(c, m, k, m->run.from, swept, use, user);
}
