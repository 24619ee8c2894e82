/* slides.c -- the stretches of a run in which a surface was held, in words. */
#include "sim/run/slides.h"

#include "expr/print.h"

/* So many stretches are listed, the others counted. */
enum { MOST_LISTED = 3 };

static const qdot_mode *
mode_of(const qdot_run *run, size_t piece)
{
    return run->stage.modes.at[run->course.tr.pieces.at[piece].mode];
}

/* Whether piece k slides along a surface; its end that is a point only does not count. */
static bool
slides(const qdot_run *run, size_t k, size_t surface)
{
    const qdot_trajectory *tr = &run->course.tr;

    return k < tr->pieces.n && mode_of(run, k)->side[surface] == QDOT_SIDE_SLIDES
           && qdot_trajectory_last_of(tr, k) > tr->pieces.at[k].first;
}

/* "sticks at x' = 0" where only velocities are held, else "slides along u = 0". */
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

/* When a puck that came to rest in a piece which began at t has stopped; else t. */
static double
stopped_at(const qdot_run *run, size_t surface, double t)
{
    for (size_t i = run->course.rests.n; i-- > 0;)
        if (run->course.rests.at[i].surface == surface && run->course.rests.at[i].t == t)
            return run->course.rests.at[i].after;
    return t;
}

static qdot_status
tell(qdot_run *run, size_t surface)
{
    const qdot_trajectory *tr = &run->course.tr;
    size_t listed = 0, others = 0;
    double end = 0;
    qdot_text *to = NULL;

    for (size_t k = 0; k < tr->pieces.n; k++) {
        const double begin = stopped_at(run, surface, tr->t[tr->pieces.at[k].first]);

        if (!slides(run, k, surface))
            continue;
        while (slides(run, k + 1, surface))
            k++;
        end = tr->t[qdot_trajectory_last_of(tr, k)];
        if (!to) {
            to = qdot_run_next_notice(run);
            QDOT_TRY(name(run, surface, to));
        }
        if (listed < MOST_LISTED)
            qdot_text_format(to, "%s from t = %.10g to %.10g", listed > 0 ? "," : "", begin, end);
        else
            others++;
        listed++;
    }
    if (others > 0)
        qdot_text_format(to, ", and %zu more times, until t = %.10g", others, end);
    return to ? qdot_text_status(to) : QDOT_OK;
}

/* Whether the run slid along a surface that values are read by: the sides of others stand in no equation. */
static bool
is_read(const qdot_run *run, size_t surface)
{
    const qdot_surface *at = &run->stage.switches.surfaces.at[surface];
    bool slid = false;

    for (size_t k = 0; k < run->course.tr.pieces.n; k++)
        slid = slid || slides(run, k, surface);
    return slid && !at->contact && !(at->layer > 0); /* the powers of a layer are 0 at u = 0 */
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
            if (slides(run, k, i))
                return true;
    return false;
}
