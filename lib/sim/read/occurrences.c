/* occurrences.c -- the events of a run, with errors of their times estimated from its companion runs. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "ode/companion.h"
#include "sim/course/run-time.h"
#include "sim/digits/digits.h"
#include "sim/error/companion.h"
#include "sim/error/faded.h"
#include "sim/error/partner.h"
#include "sim/error/touches.h"
#include "sim/run/run.h"

bool
qdot_run_has_event(const qdot_run *run, const char *name)
{
    for (size_t i = 0; i < run->stage.events.n; i++)
        if (strcmp(run->stage.events.at[i].name, name) == 0)
            return true;
    return false;
}

/* The times of a course's occurrences event by event: those of event e are t[first[e]] to
 * t[first[e + 1] - 1], in their order. */
typedef struct {
    size_t *first; /* [events + 1] index of each event's first occurrence */
    double *t;
} by_event;

static qdot_status
sort_times_by_event(const qdot_course *c, size_t events, by_event *out)
{
    size_t n = c->occurrences.n, *next;

    out->first = qdot_calloc(2 * events + 2, sizeof *out->first);
    out->t = qdot_calloc(n + 1, sizeof *out->t);
    if (!out->first || !out->t)
        return QDOT_ENOMEM;
    next = out->first + events + 1;
    for (size_t i = 0; i < n; i++)
        out->first[c->occurrences.at[i].event + 1]++;
    for (size_t e = 0; e < events; e++) {
        out->first[e + 1] += out->first[e];
        next[e] = out->first[e];
    }
    for (size_t i = 0; i < n; i++)
        out->t[next[c->occurrences.at[i].event]++] = c->occurrences.at[i].t;
    return QDOT_OK;
}

/* Find the time of the companion's occurrence that corresponds to occurrence k of the run's event;
 * NaN: none. */
static double
corresponding_time(const by_event *own, const by_event *other, size_t event, size_t k)
{
    const double *of = other->t + other->first[event];
    const size_t i = qdot_partner_of(own->t + own->first[event],
                                     own->first[event + 1] - own->first[event], k, of,
                                     other->first[event + 1] - other->first[event]);

    return i == SIZE_MAX ? NAN : of[i];
}

/* Compare event times with companion runs'; widths [occurrences]: further uncertainty; `least`: least errors. */
static qdot_status
compare_event_times(qdot_run *run, const by_event *own, const by_event *others,
                    const double *widths, const double *least)
{
    size_t events = run->stage.events.n, n = run->course.occurrences.n;
    size_t companions = !run->has_companion ? 0 : run->has_twin ? 2 : 1;
    size_t *seen = qdot_calloc(events + 1, sizeof *seen);
    qdot_status status = seen ? QDOT_OK : QDOT_ENOMEM;

    run->occurrences.n = 0;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        const qdot_occurrence *o = &run->course.occurrences.at[i];
        size_t k = seen[o->event]++;
        double by = NAN, theirs[2];

        for (size_t j = 0; j < companions; j++)
            theirs[j] = corresponding_time(own, others + j, o->event, k);
        if (companions > 0)
            by = qdot_companion_bound_of(o->t, companions, theirs);
        if (by < least[i])
            by = least[i];
        status = qdot_vec_push(
            &run->occurrences,
            ((qdot_run_occurrence){run->stage.events.at[o->event].name, o->t,
                                   by + widths[i] + o->blur + DBL_EPSILON * fabs(o->t), o->way,
                                   QDOT_NIL}));
    }
    qdot_free(seen);
    return status;
}

/* Remove the occurrences and touches of an event after the time `from`, up to which they are known. */
static void
remove_occurrences_after(qdot_run *run, const char *event, double from)
{
    const double direction = run->t1 < run->t0 ? -1 : 1;
    size_t n = 0, n_faded = 0;

    for (size_t i = 0; i < run->occurrences.n; i++)
        if (strcmp(run->occurrences.at[i].event, event) != 0 || direction * (run->occurrences.at[i].t - from) < 0)
            run->occurrences.at[n++] = run->occurrences.at[i];
    run->occurrences.n = n;
    for (size_t i = 0; i < run->faded.n; i++)
        if (strcmp(run->faded.at[i].event, event) != 0 || direction * (run->faded.at[i].from - from) < 0)
            run->faded.at[n_faded++] = run->faded.at[i];
    run->faded.n = n_faded;
}

/* Fill run->faded. Where the function of an event stays within its error of 0 to the end of the run, occurrences there are
 * none that is known: they are left out. */
static qdot_status
remove_unknown_occurrences(qdot_run *run)
{
    const qdot_course *c = &run->course;
    const double end = c->tr.count > 0 ? c->tr.t[c->tr.count - 1] : 0;

    run->faded.n = 0;
    for (size_t k = 0; k < c->faded.n; k++)
        if (c->faded.at[k].touched || c->faded.at[k].to != end)
            QDOT_TRY(qdot_vec_push(&run->faded,
                                   ((qdot_run_faded){run->stage.events.at[c->faded.at[k].event].name, c->faded.at[k].from,
                                                     c->faded.at[k].to, c->faded.at[k].touched})));
    for (size_t e = 0; e < run->stage.events.n; e++) {
        double from;

        QDOT_TRY(qdot_faded_find(run, e, &from));
        if (isnan(from))
            continue;
        remove_occurrences_after(run, run->stage.events.at[e].name, from);
        QDOT_TRY(qdot_vec_push(&run->faded, ((qdot_run_faded){run->stage.events.at[e].name, from, end, false})));
    }
    return QDOT_OK;
}

/* Fill run->occurrences, with errors of the times estimated from the companion runs. */
static qdot_status
find_time_errors(qdot_run *run)
{
    const qdot_course *courses[] = {&run->course, &run->companion, &run->twin};
    by_event sorted[3] = {{0}};
    const size_t n = run->course.occurrences.n;
    double *widths = qdot_calloc(2 * n + 1, sizeof *widths), *least = widths ? widths + n : NULL;
    qdot_status status = widths ? QDOT_OK : QDOT_ENOMEM;

    if (n > 0 && status == QDOT_OK)
        status = qdot_run_twin(run);
    for (size_t i = 0; i < 3 && status == QDOT_OK; i++)
        status = sort_times_by_event(courses[i], run->stage.events.n, sorted + i);
    for (size_t i = 0; i < run->stage.events.n && status == QDOT_OK; i++)
        status = qdot_touches_look(run, i, widths, NULL);
    /* companion runs by the same method take steps like those of the run, and agree with it more often */
    for (size_t i = 0; i < run->stage.events.n && status == QDOT_OK && run->plan->method->stiff; i++)
        status = qdot_touches_crossings(run, i, least);
    for (size_t i = 1; i < n && status == QDOT_OK; i++) /* of one instant */
        if (run->course.occurrences.at[i].t == run->course.occurrences.at[i - 1].t)
            least[i] = fmax(least[i], least[i - 1]);
    if (status == QDOT_OK)
        status = compare_event_times(run, sorted, sorted + 1, widths, least);
    if (status == QDOT_OK)
        status = remove_unknown_occurrences(run);
    qdot_free(widths);
    for (size_t i = 0; i < 3; i++) {
        qdot_free(sorted[i].first);
        qdot_free(sorted[i].t);
    }
    return status;
}

qdot_status
qdot_run_event_at_end(qdot_run *run, size_t k, const char **name, bool *undecided)
{
    *name = k < run->stage.events.n ? run->stage.events.at[k].name : NULL;
    *undecided = false;
    return *name && !run->precise ? qdot_touches_end(run, k, undecided) : QDOT_OK;
}

/* For a run that counts its times from an origin: convert the times of occurrences to t, with
 * rounding error. */
static void
convert_times_to_t(qdot_run *run)
{
    for (size_t i = 0; i < run->occurrences.n; i++) {
        qdot_run_occurrence *o = &run->occurrences.at[i];

        o->t = qdot_run_time_told(run, o->t);
        o->error += DBL_EPSILON * fabs(o->t);
    }
    for (size_t i = 0; i < run->faded.n; i++) {
        run->faded.at[i].from = qdot_run_time_told(run, run->faded.at[i].from);
        run->faded.at[i].to = qdot_run_time_told(run, run->faded.at[i].to);
    }
}

qdot_status
qdot_run_occurrences(qdot_run *run, const qdot_run_occurrence **list, size_t *n)
{
    if (!run->occurrence_errors) {
        QDOT_TRY(qdot_run_time_fail(run->origin, run->precise ? qdot_digits_occurrences(run) : find_time_errors(run)));
        if (run->origin != 0)
            convert_times_to_t(run);
    }
    run->occurrence_errors = true;
    *list = run->occurrences.at;
    *n = run->occurrences.n;
    return QDOT_OK;
}

qdot_status
qdot_run_faded_events(qdot_run *run, const qdot_run_faded **list, size_t *n)
{
    const qdot_run_occurrence *occurrences;

    QDOT_TRY(qdot_run_occurrences(run, &occurrences, n));
    *list = run->faded.at;
    *n = run->faded.n;
    return QDOT_OK;
}
