/* slides.c -- describes when a motion stuck to a surface or slid along it. */
#include "sim/run/slides.h"

#include <math.h>

#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"

/* The most time spans that are listed; the others are counted. */
enum { MOST_LISTED = 3 };

/* A time span in which the motion was held on a surface. */
typedef struct {
    double begin, end;
    double unsure; /* additional uncertainty of `begin`, beyond that from companions */
} stretch;

typedef qdot_vec(stretch) stretches;

static const qdot_mode *
mode_of(const qdot_course *c, size_t piece)
{
    return c->stage->modes.at[c->tr.pieces.at[piece].mode];
}

/* Whether the motion slides along a surface in piece k, for more than one point. */
static bool
slides(const qdot_course *c, size_t k, size_t surface)
{
    const qdot_trajectory *tr = &c->tr;

    return k < tr->pieces.n && mode_of(c, k)->side[surface] == QDOT_SIDE_SLIDES
           && qdot_trajectory_last_of(tr, k) > tr->pieces.at[k].first;
}

/* When the motion has come to rest in a piece which began at t: a puck slows down within it, and the bounces that a
 * contact has left out would have ended later. */
static double
rested_at(const qdot_course *c, size_t surface, double t, double *unsure)
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

static qdot_status
list_stretches(const qdot_course *c, size_t surface, stretches *out)
{
    const qdot_trajectory *tr = &c->tr;

    for (size_t k = 0; k < tr->pieces.n; k++) {
        double unsure;
        const double begin = rested_at(c, surface, tr->t[tr->pieces.at[k].first], &unsure);

        if (!slides(c, k, surface))
            continue;
        while (slides(c, k + 1, surface))
            k++;
        QDOT_TRY(qdot_vec_push(out, ((stretch){begin, tr->t[qdot_trajectory_last_of(tr, k)], unsure})));
    }
    return QDOT_OK;
}

/* Append "sticks at x' = 0" if only velocities are held, else "slides along u = 0". */
static qdot_status
name(const qdot_run *run, size_t surface, qdot_text *to)
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
add_time(const qdot_run *run, double t, double error, qdot_text *to)
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

/* Remove contacts whose bounces would end only after the end of the run: no rest was reached. */
static void
leave_out_unended(const qdot_run *run, stretches *of)
{
    while (of->n > 0 && (run->t1 - of->at[of->n - 1].begin) * (run->t1 - run->t0) <= 0)
        of->n--;
}

/* List the spans of the run, then those of its companions, if it has any. */
static qdot_status
list_all(const qdot_run *run, size_t surface, stretches all[3])
{
    QDOT_TRY(list_stretches(&run->course, surface, &all[0]));
    if (run->has_companion)
        QDOT_TRY(list_stretches(&run->companion, surface, &all[1]));
    return run->has_twin ? list_stretches(&run->twin, surface, &all[2]) : QDOT_OK;
}

/* The largest difference between the times [n]; NaN for a single one. */
static double
slides_spread(const double *t, size_t n)
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
errors_of(const qdot_run *run, const stretches all[3], size_t k)
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
    return (stretch){own->begin == run->t0 || run->precise ? 0 : slides_spread(begins, n) + own->unsure,
                     own->end == run->t1 || run->precise ? 0 : slides_spread(ends, n), 0};
}

static qdot_status
tell_stretches(qdot_run *run, size_t surface, const stretches all[3])
{
    const size_t n = all[0].n, listed = n < MOST_LISTED ? n : MOST_LISTED;
    qdot_text *to;

    if (n == 0)
        return QDOT_OK;
    to = qdot_run_next_notice(run);
    QDOT_TRY(name(run, surface, to));
    for (size_t k = 0; k < listed; k++) {
        const stretch error = errors_of(run, all, k);

        qdot_text_add(to, k > 0 ? ", from t = " : " from t = ");
        add_time(run, all[0].at[k].begin, error.begin, to);
        qdot_text_add(to, " to ");
        add_time(run, all[0].at[k].end, error.end, to);
    }
    if (n > listed) {
        qdot_text_format(to, ", and %zu more times, until t = ", n - listed);
        add_time(run, all[0].at[n - 1].end, errors_of(run, all, n - 1).end, to);
    }
    return qdot_text_status(to);
}

static qdot_status
tell(qdot_run *run, size_t surface)
{
    stretches all[3] = {0};
    qdot_status status = list_all(run, surface, all);

    leave_out_unended(run, &all[0]);
    if (status == QDOT_OK)
        status = tell_stretches(run, surface, all);
    for (size_t i = 0; i < 3; i++)
        qdot_free(all[i].at);
    return status;
}

/* Whether the run slid along a surface whose side enters values; other sides occur in no equation. */
static bool
is_read(const qdot_run *run, size_t surface)
{
    const qdot_surface *at = &run->stage.switches.surfaces.at[surface];
    bool slid = false;

    for (size_t k = 0; k < run->course.tr.pieces.n; k++)
        slid = slid || slides(&run->course, k, surface);
    return slid && !at->contact && !(at->layer > 0); /* not for layers, whose powers are 0 at u = 0 */
}

/* Values are read by these sides. Where there are none the plan stays as it is: without switches other runs hold it
 * too (sim/plan/kept.h), which outlive the switches of this one. */
static qdot_status
keep_sides(qdot_run *run)
{
    const size_t surfaces = run->stage.switches.surfaces.n;
    long *side = qdot_calloc(surfaces + 1, sizeof *side);
    bool any = false;

    if (!side)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < surfaces; i++) {
        side[i] = is_read(run, i) ? QDOT_SIDE_SLIDES : QDOT_SIDE_OPEN;
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
    QDOT_TRY(keep_sides(run));
    for (size_t i = 0; i < run->stage.switches.surfaces.n; i++)
        QDOT_TRY(tell(run, i));
    return QDOT_OK;
}

bool
qdot_slides_in_contact(const qdot_run *run)
{
    for (size_t i = 0; i < run->stage.switches.surfaces.n; i++)
        for (size_t k = 0; k < run->course.tr.pieces.n && run->stage.switches.surfaces.at[i].contact; k++)
            if (slides(&run->course, k, i))
                return true;
    return false;
}
