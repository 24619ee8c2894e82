/* orbit-run.c -- which run is a periodic orbit. */
#include "lang/slopes/orbit-run.h"

#include <math.h>

#include "lang/session/runs.h"
#include "sim/study/floquet.h"

/* How far a run may be from its start, beside max(scale, |value|), and count as an orbit. */
static const double closed = 1e-7;

static bool
is_whole(const qdot_session *session, const qdot_named_run *named)
{
    return named->conditions != NULL &&
           named->conditions->version == session->scene->version &&
           qdot_run_get_report(named->run)->status == QDOT_RUN_DONE;
}

/* A run that may be closed, and is not exact enough to be taken for an orbit. */
static qdot_status
refuse_inexact(const qdot_named_run *named, double off)
{
    (void)qdot_fail(QDOT_EINVAL, "%.80s ends %.2g off its start, which is within its error: too far for an orbit",
                    named->name, off);
    return qdot_hint("a smaller tol; where motions near the orbit grow too fast none helps");
}

static bool
is_within_error(const qdot_named_run *named, double off)
{
    return off <= qdot_run_get_report(named->run)->scaled_error;
}

qdot_status
qdot_orbit_run_find(qdot_session *session, qdot_named_run **orbit)
{
    double first = NAN;
    qdot_expr at = QDOT_NIL;
    qdot_named_run *latest;

    QDOT_TRY(qdot_runs_find(session, NULL, &latest));
    for (size_t i = session->runs.n; i-- > 0;) {
        double off;
        qdot_expr where;

        if (!is_whole(session, &session->runs.at[i]))
            continue;
        QDOT_TRY(
            qdot_floquet_return(session->scene, session->runs.at[i].run, &off, &where));
        if (off <= closed) {
            *orbit = &session->runs.at[i];
            return QDOT_OK;
        }
        if (at == QDOT_NIL) {
            first = off;
            at = where;
            latest = &session->runs.at[i];
        }
    }
    if (at == QDOT_NIL)
        (void)qdot_fail(QDOT_EINVAL, "no run of this scene is whole");
    else if (is_within_error(latest, first))
        return refuse_inexact(latest, first);
    else
        (void)qdot_fail(QDOT_EINVAL,
                        "no run ends where it began: %.80s is %.3g off in %.80s",
                        latest->name, first, qdot_expr_symbol(session->pool, at)->name);
    return qdot_hint("find x = 1, T = 2 such that returns after T");
}

qdot_status
qdot_orbit_run_named(qdot_session *session, const char *name, qdot_named_run **orbit)
{
    double off;
    qdot_expr where;

    QDOT_TRY(qdot_runs_find(session, name, orbit));
    if (!is_whole(session, *orbit))
        return qdot_fail(QDOT_EINVAL, "%s is not a whole run of this scene", name);
    QDOT_TRY(qdot_floquet_return(session->scene, (*orbit)->run, &off, &where));
    if (off <= closed)
        return QDOT_OK;
    if (is_within_error(*orbit, off))
        return refuse_inexact(*orbit, off);
    (void)qdot_fail(QDOT_EINVAL, "%s does not end where it began: it is %.3g off", name, off);
    return qdot_hint("find x = 1, T = 2 such that returns after T");
}
