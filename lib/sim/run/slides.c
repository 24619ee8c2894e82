/* slides.c -- describes when a motion stuck to a surface or slid along it. */
#include "sim/run/slides.h"

#include <math.h>

#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"

/* The largest number of time spans that are listed; further ones are only counted. */
enum { MOST_LISTED = 3 };

/* A time span in which the motion was held on a switching surface or contact. */
typedef struct {
    double begin, end;
    double unsure, unsure_end; /* uncertainties of `begin` and `end` beyond those estimated by the companion runs */
} stretch;

typedef qdot_vec(stretch) stretches;

static const qdot_mode *
mode_of_piece(const qdot_course *c, size_t piece)
{
    return c->stage->modes.at[c->tr.pieces.at[piece].mode];
}

/* Whether the motion slides along a surface in piece k of the run, at more than one stored point. */
static bool
slides_in_piece(const qdot_course *c, size_t k, size_t surface)
{
    const qdot_trajectory *tr = &c->tr;

    return k < tr->pieces.n && mode_of_piece(c, k)->side[surface] == QDOT_SIDE_SLIDES
           && qdot_trajectory_last_of(tr, k) > tr->pieces.at[k].first;
}

/* When the motion has come to rest in a piece which began at t: a puck slows down within it, and the bounces that a
 * contact has left out would have ended later. */
static double
time_of_rest(const qdot_course *c, size_t surface, double t, double *unsure)
{
    *unsure = 0;
    for (size_t i = c->rests.n; i-- > 0;)
        if (c->rests.at[i].surface == surface && c->rests.at[i].t == t)
            return c->rests.at[i].after;
    for (size_t i = c->chatters.n; i-- > 0 && c->stage->switches.surfaces.at[surface].contact;)
        if (c->chatters.at[i].surface == surface && c->chatters.at[i].t == t && !c->chatters.at[i].steady) {
            *unsure = c->chatters.at[i].unsure;
            return c->chatters.at[i].end;
        }
    return t;
}

/* How far from the root of a surface a piece may have ended at t: the ends of the companions are as far, alike. */
static double
error_of_switch(const qdot_course *c, double t)
{
    double most = 0;

    for (size_t i = 0; i < c->ends.n; i++)
        if (c->ends.at[i].t == t && c->ends.at[i].what.kind == QDOT_WATCH_SURFACE)
            most = fmax(most, c->ends.at[i].late);
    return most;
}

static qdot_status
list_time_spans(const qdot_course *c, size_t surface, stretches *out)
{
    const qdot_trajectory *tr = &c->tr;

    for (size_t k = 0; k < tr->pieces.n; k++) {
        const double from = tr->t[tr->pieces.at[k].first];
        double unsure, to;
        const double begin = time_of_rest(c, surface, from, &unsure);

        if (!slides_in_piece(c, k, surface))
            continue;
        while (slides_in_piece(c, k + 1, surface))
            k++;
        to = tr->t[qdot_trajectory_last_of(tr, k)];
        QDOT_TRY(qdot_vec_push(out, ((stretch){begin, to, unsure + error_of_switch(c, from), error_of_switch(c, to)})));
    }
    return QDOT_OK;
}

/* Append "sticks at x' = 0" if only velocities are held on the surface, else "slides along u = 0". */
static qdot_status
describe_sliding(const qdot_run *run, size_t surface, qdot_text *to)
{
    const qdot_switches *s = &run->stage.switches;
    const qdot_expr u = s->surfaces.at[surface].u;

    if (s->surfaces.at[surface].contact)
        qdot_text_format(to, "rests on %s: ",
                         run->stage.events.at[s->surfaces.at[surface].event].name);
    else
        qdot_text_add(to, s->surfaces.at[surface].puck == 0
                                  && qdot_expr_node(s->pool, u)->holds & QDOT_HAS_COORD ? "slides along "
                                                                             : "sticks at ");
    return qdot_stage_describe(&run->stage, surface, 0, to);
}

/* A time, and its error where it is not right to the ten digits that are shown; a 0 stands for those of the run's
 * length. */
static void
append_time(const qdot_run *run, double t, double error, qdot_text *to)
{
    const double unit = pow(10, floor(log10(fabs(t != 0 ? t : run->t1 - run->t0))) - 9);

    qdot_text_format(to, "%.10g", t);
    if (isnan(error))
        qdot_text_add(to, " (error unknown)");
    else if (error > unit / 20) {
        const double digit = pow(10, floor(log10(error + unit / 2)));

        qdot_text_format(to, " ± %.1g", ceil((error + unit / 2) / digit) * digit);
    }
}

/* Remove contacts whose bounces end only after the end of the run: the motion did not come to rest on them. */
static void
remove_unreached_contacts(const qdot_run *run, stretches *of)
{
    while (of->n > 0 && (run->t1 - of->at[of->n - 1].begin) * (run->t1 - run->t0) <= 0)
        of->n--;
}

/* List the time spans of the run, then those of its companion runs, if it has any. */
static qdot_status
list_spans_of_all_runs(const qdot_run *run, size_t surface, stretches all[3])
{
    QDOT_TRY(list_time_spans(&run->course, surface, &all[0]));
    if (run->has_companion)
        QDOT_TRY(list_time_spans(&run->companion, surface, &all[1]));
    return run->has_twin ? list_time_spans(&run->twin, surface, &all[2]) : QDOT_OK;
}

/* The largest difference between the times t [n]; NaN for a single one. */
static double
spread_of_times(const double *t, size_t n)
{
    double most = n > 1 ? 0 : NAN;

    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < i; k++)
            most = fmax(most, fabs(t[i] - t[k]));
    return most;
}

/* The errors of the begin and the end of stretch k, by the companions; those of the run's own limits are 0. With `digits`
 * each has been found again in all digits. */
static stretch
find_span_errors(const qdot_run *run, const stretches all[3], size_t k)
{
    const bool there[] = {true, run->has_companion, run->has_twin};
    const stretch *own = &all[0].at[k];
    double begins[3], ends[3];
    size_t n = 0;

    for (size_t i = 0; i < 3; i++) {
        if (!there[i] || all[i].n < all[0].n)
            continue;
        begins[n] = all[i].at[k].begin;
        ends[n++] = all[i].at[k].end;
    }
    return (stretch){own->begin == run->t0 || run->precise ? 0 : spread_of_times(begins, n) + own->unsure,
                     own->end == run->t1 || run->precise ? 0 : spread_of_times(ends, n) + own->unsure_end, 0, 0};
}

static qdot_status
describe_time_spans(qdot_run *run, size_t surface, const stretches all[3])
{
    const size_t n = all[0].n, listed = n < MOST_LISTED ? n : MOST_LISTED;
    qdot_text *to;

    if (n == 0)
        return QDOT_OK;
    to = qdot_run_next_notice(run);
    QDOT_TRY(describe_sliding(run, surface, to));
    for (size_t k = 0; k < listed; k++) {
        const stretch error = find_span_errors(run, all, k);

        qdot_text_add(to, k > 0 ? ", from t = " : " from t = ");
        append_time(run, all[0].at[k].begin, error.begin, to);
        qdot_text_add(to, " to ");
        append_time(run, all[0].at[k].end, error.end, to);
    }
    if (n > listed) {
        qdot_text_format(to, ", and %zu more times, until t = ", n - listed);
        append_time(run, all[0].at[n - 1].end, find_span_errors(run, all, n - 1).end, to);
    }
    return qdot_text_status(to);
}

static qdot_status
add_notice_for_surface(qdot_run *run, size_t surface)
{
    stretches all[3] = {0};
    qdot_status status = list_spans_of_all_runs(run, surface, all);

    remove_unreached_contacts(run, &all[0]);
    if (status == QDOT_OK)
        status = describe_time_spans(run, surface, all);
    for (size_t i = 0; i < 3; i++)
        qdot_free(all[i].at);
    return status;
}

/* Whether the run slid along a surface whose side enters values; that of a contact enters no equation. */
static bool
affects_values(const qdot_run *run, size_t surface)
{
    const qdot_surface *at = &run->stage.switches.surfaces.at[surface];
    bool slid = false;

    for (size_t k = 0; k < run->course.tr.pieces.n; k++)
        slid = slid || slides_in_piece(&run->course, k, surface);
    return slid && !at->contact && !(at->layer > 0); /* not for layers: there the power is 0 at u = 0 */
}

/* Values are read by these sides. Where there are none the plan stays as it is: without switches other runs hold it
 * too (sim/plan/kept.h), which outlive the switches of this one. */
static qdot_status
keep_read_sides(qdot_run *run)
{
    const size_t surfaces = run->stage.switches.surfaces.n;
    int64_t *side = qdot_calloc(surfaces + 1, sizeof *side);
    bool any = false;

    if (!side)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < surfaces; i++) {
        side[i] = affects_values(run, i) ? QDOT_SIDE_SLIDES : QDOT_SIDE_OPEN;
        any = any || side[i] == QDOT_SIDE_SLIDES;
    }
    if (!any) {
        qdot_free(side);
        return QDOT_OK;
    }
    qdot_free(run->plan->read_side);
    run->plan->read_side = side;
    run->plan->read_switches = &run->stage.switches;
    return QDOT_OK;
}

qdot_status
qdot_slides_tell(qdot_run *run)
{
    bool any = false;

    for (size_t i = 0; i < run->stage.modes.n; i++)
        any = any || qdot_sliding_is(&run->stage.switches, run->stage.modes.at[i]->side);
    if (!any)
        return QDOT_OK;
    QDOT_TRY(keep_read_sides(run));
    for (size_t i = 0; i < run->stage.switches.surfaces.n; i++)
        QDOT_TRY(add_notice_for_surface(run, i));
    return QDOT_OK;
}

bool
qdot_slides_in_contact(const qdot_run *run)
{
    for (size_t i = 0; i < run->stage.switches.surfaces.n; i++)
        for (size_t k = 0; k < run->course.tr.pieces.n && run->stage.switches.surfaces.at[i].contact; k++)
            if (slides_in_piece(&run->course, k, i))
                return true;
    return false;
}
