/* event-time.c -- finds when the events of a run occurred. */
#include "lang/session/event-time.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"

bool
qdot_event_is(const qdot_session *session, const char *run, const char *name)
{
    if (qdot_scene_find_event(session->scene, name) != NULL)
        return true;
    for (size_t i = session->runs->n; i-- > 0;)
        if (run == NULL || strcmp(session->runs->at[i].name, run) == 0)
            return session->runs->at[i].run != NULL &&
                   qdot_run_has_event(session->runs->at[i].run, name);
    return false;
}

int
qdot_event_digits(const qdot_run *run, const qdot_run_occurrence *o)
{
    return o->exact == QDOT_NIL ? 0 : qdot_run_get_report(run)->digits;
}

/* Fail because occurrence k is not among the n known ones; say since when it is unknown whether the
 * event occurs. */
static qdot_status
report_unknown_occurrence(const qdot_named_run *named, const char *name, int64_t k, size_t n)
{
    const qdot_run_faded *list;
    size_t count;

    QDOT_TRY(qdot_run_faded_events(named->run, &list, &count));
    (void)qdot_fail(QDOT_EDOMAIN, "%s[%" PRId64 "]: the event occurred %zu time%s in %s", name, k, n, n == 1 ? "" : "s",
                    named->name);
    for (size_t i = 0; i < count; i++) {
        char when[96];

        if (strcmp(list[i].event, name) != 0)
            continue;
        snprintf(when, sizeof when, list[i].touched ? "about t = %.6g its sides touch within rounding"
                                                    : "from t = %.6g on its sides are equal within their errors",
                 list[i].from);
        (void)qdot_fail(QDOT_EDOMAIN, "%s[%" PRId64 "]: %zu occurrence%s of the event %s known in %s: %s", name, k, n,
                        n == 1 ? "" : "s", n == 1 ? "is" : "are", named->name, when);
        break;
    }
    return qdot_hint("`events` lists them");
}

qdot_status
qdot_event_time(qdot_session *session, const char *run, const char *name, int64_t k,
                qdot_expr *value)
{
    const qdot_run_occurrence *list;
    qdot_vec(qdot_expr) all = {0};
    qdot_named_run *named;
    qdot_status status;
    size_t n;

    QDOT_TRY(qdot_runs_read(session, run, &named));
    if (!qdot_run_has_event(named->run, name)) {
        (void)qdot_fail(QDOT_ENAME, "the run %.100s knows no event `%.100s`", named->name,
                        name);
        return qdot_hint("an event is declared before the run");
    }
    status = qdot_run_occurrences(named->run, &list, &n);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        if (strcmp(list[i].event, name) != 0)
            continue;
        status = qdot_vec_push(
            &all, qdot_measured_add(session, (qdot_measured){.value = list[i].t,
                                                             .error = list[i].error,
                                                             .digits = qdot_event_digits(
                                                                 named->run, &list[i]),
                                                             .exact = list[i].exact,
                                                             .origin = {.kind = QDOT_ORIGIN_EVENT,
                                                                        .run = run,
                                                                        .event = list[i].event}}));
    }
    if (status == QDOT_OK && k == 0) {
        *value = qdot_list(session->pool, (uint32_t)all.n, all.at);
    } else if (status == QDOT_OK && (k < 1 || (size_t)k > all.n)) {
        status = report_unknown_occurrence(named, name, k, all.n);
    } else if (status == QDOT_OK) {
        *value = all.at[k - 1];
    }
    qdot_free(all.at);
    return status == QDOT_OK ? qdot_pool_check(session->pool) : status;
}
