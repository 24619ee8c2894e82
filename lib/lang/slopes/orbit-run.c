/* orbit-run.c -- finds, among the runs of a session, one that is a periodic orbit. */
#include "lang/slopes/orbit-run.h"

#include <math.h>

#include "expr/symbol.h"
#include "lang/session/runs.h"
#include "sim/study/floquet.h"

/* A run whose end is within its error of its start, and not farther than this, is taken for one of an orbit that no run
 * in doubles follows round: whoever uses it finds that. */
static const double inexact = 0.1;

static bool
is_complete_run_of_scene(const qdot_session *session, const qdot_named_run *named)
{
    return named->conditions != NULL &&
           named->conditions->version == session->scene->version &&
           qdot_run_get_report(named->run)->status == QDOT_RUN_DONE;
}

static bool
is_same_after_period(const qdot_named_run *named, double off)
{
    return off <= fmin(inexact, qdot_run_get_report(named->run)->scaled_error);
}

/* Give a hint how to find a periodic orbit, with a coordinate of this scene. */
static qdot_status
hint_at_finding_orbit(const qdot_session *session)
{
    return qdot_hint("find %.80s = 1, T = 2 such that returns after T",
                     qdot_expr_symbol(session->pool, session->scene->coordinates.at[0])->name);
}

qdot_status
qdot_orbit_run_find(qdot_session *session, qdot_named_run **orbit)
{
    double first = NAN;
    qdot_expr at = QDOT_NIL;
    qdot_named_run *latest;

    QDOT_TRY(qdot_runs_find(session, NULL, &latest));
    for (size_t i = session->runs->n; i-- > 0;) {
        double off;
        qdot_expr where;

        if (!is_complete_run_of_scene(session, &session->runs->at[i]))
            continue;
        QDOT_TRY(
            qdot_floquet_return(session->scene, session->runs->at[i].run, &off, &where));
        if (off <= QDOT_FLOQUET_CLOSED) {
            *orbit = &session->runs->at[i];
            return QDOT_OK;
        }
        if (at == QDOT_NIL) {
            first = off;
            at = where;
            latest = &session->runs->at[i];
        }
    }
    *orbit = latest;
    if (at == QDOT_NIL)
        (void)qdot_fail(QDOT_EINVAL, "no run of this scene is whole");
    else if (is_same_after_period(latest, first))
        return QDOT_OK;
    else
        (void)qdot_fail(QDOT_EINVAL,
                        "no run ends where it began: %.80s is %.3g off in %.80s",
                        latest->name, first, qdot_expr_symbol(session->pool, at)->name);
    return hint_at_finding_orbit(session);
}

qdot_status
qdot_orbit_run_named(qdot_session *session, const char *name, qdot_named_run **orbit)
{
    double off;
    qdot_expr where;

    QDOT_TRY(qdot_runs_find(session, name, orbit));
    if (!is_complete_run_of_scene(session, *orbit))
        return qdot_fail(QDOT_EINVAL, "%s is not a whole run of this scene", name);
    QDOT_TRY(qdot_floquet_return(session->scene, (*orbit)->run, &off, &where));
    if (off <= QDOT_FLOQUET_CLOSED || is_same_after_period(*orbit, off))
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "%s does not end where it began: it is %.3g off", name, off);
    return hint_at_finding_orbit(session);
}
