/* alternate.c -- the controller of a method for stiff equations and Taylor series in turns, whichever goes faster.
 *
 * Steps of the method go on while they bring the run on by more, for the same work, than a step by
 * series would: every LOOKS steps the length h of that step is found (taylor.h). With the works w_s
 * of an expansion and w of what the method has done over the last LOOKS steps, which came as far as d,
 *
 *     h/w_s > gain d/w
 *
 * must hold without a break until the method has spent `patience` expansions more: by then it would
 * have paid to change. Series go on until stability bounds their steps (stiffness.h), or
 * they come to be slower than the method was; then the patience is doubled, so that a motion in which
 * the two take turns costs little more than by the method alone. The turns are of one integration: time goes on, the state is
 * the one at hand, and each step that is offered tells its method.
 *
 * Tests  tests/ode/test_alternate.c, tests/script/methods/stiff-turns.lag
 */
#include <math.h>

#include "base/memory.h"
#include "ode/meter.h"
#include "ode/step.h"
#include "ode/taylor.h"

/* The number of steps between two comparisons of speed, while the stiff method is used and while series are. */
enum { looks = 32, looks_at_series = 512 };

/* The factor by which series must be faster before the method is changed; the work to wait for that, in expansions. */
static const double gain = 4, first_patience = 1000;

/* Change from series to the stiff method only if at least this much work (in about ns) remains. */
static const double worth_changing = 3e6;

typedef struct {
    const qdot_ode_system *system;
    const qdot_ode_options *options; /* the options that the caller gave for the whole run */
    qdot_ode_options own;            /* those of a part */
    const qdot_ode_method *stiff, *series;
    qdot_ode_controller part; /* steps of the method in use, the stiff one or Taylor series */
    qdot_ode_step step;       /* its step that is offered */
    const qdot_ode_method *now;
    double *y;                /* [n] the state at a change */
    qdot_ode_result *result;
    qdot_ode_stats before; /* the counts of the parts that have ended */
    qdot_ode_meter own_meter, *meter; /* if the caller has none; the one in use */
    double t1;
    double expansion; /* work of one Taylor expansion (unit: meter.h) */
    double patience;  /* work during which series must win before the method changes */
    uint64_t steps;   /* steps taken since the method was last changed */
    double t, work;   /* time and work at the last comparison */
    double won_since; /* work at the first of the latest comparisons in a row that series won; NaN: they did not win the last */
    double won_at;    /* the time t of that first comparison */
    double pace;      /* progress in t per unit of work that the stiff method has made since `won_at` */
    bool over;        /* this part of the run ends, because the method is to be changed */
} turns;

/* End this part if series have been faster for long enough and enough work is left to make a change worthwhile. */
static qdot_status
compare_with_series(turns *a, double t, const double *y)
{
    const double pace = fabs(t - a->t) / (a->meter->work - a->work);
    double h = 0;

    a->t = t;
    a->work = a->meter->work;
    QDOT_TRY(qdot_ode_taylor_first_step(a->system, a->options, t, a->t1, y, &h));
    if (!(h > gain * pace * a->expansion) || isinf(h)) {
        a->won_since = NAN;
        return QDOT_OK;
    }
    if (isnan(a->won_since)) {
        a->won_since = a->work;
        a->won_at = t;
    }
    a->over = a->work - a->won_since >= a->patience && fabs(a->t1 - t) > a->patience * pace;
    a->pace = fabs(t - a->won_at) / (a->work - a->won_since);
    return QDOT_OK;
}

/* End this part if Taylor series have become slower than the stiff method was. */
static void
compare_with_stiff_method(turns *a, double t)
{
    const double pace = fabs(t - a->t) / (a->meter->work - a->work);

    a->over = pace < a->pace && fabs(a->t1 - t) > a->patience * pace;
    a->t = t;
    a->work = a->meter->work;
}

/* Begin a part at (t, y), by the method in use. */
static qdot_status
begin_part(turns *a, double t, const double *y)
{
    a->steps = 0;
    a->t = t;
    a->work = a->meter->work;
    a->won_since = NAN;
    a->over = false;
    return qdot_ode_controller_open(&a->part, a->system, a->now, &a->own, t, a->t1, y);
}

/* End the part in use, and count what it did. */
static void
end_part(turns *a)
{
    qdot_ode_controller_close(&a->part, QDOT_OK, false);
    qdot_ode_stats_add(&a->before, &a->part.result.stats);
}

/* Whether the part in use is over: it was found to be slow, or failed because it is stiff. */
static bool
is_time_to_change(const turns *a)
{
    return a->part.result.stiff || (a->over && a->part.t != a->t1);
}

/* Go on from here by the other method. */
static qdot_status
change_method(turns *a)
{
    const double t = a->part.t;

    qdot_ode_controller_state(&a->part, a->y, NULL);
    end_part(a);
    if (a->now->series)
        a->patience *= 2;
    a->now = a->now->series ? a->stiff : a->series;
    a->own.goes_on = true;
    a->own.carry = NULL;
    return begin_part(a, t, a->y);
}

/* --- the controller ------------------------------------------------------------------ */

static qdot_status
alternating_open(const qdot_ode_system *system, const qdot_ode_method *method, const qdot_ode_options *options,
                 double t0, double t1, const double *y, qdot_ode_result *result, void **out)
{
    turns *a = qdot_calloc(1, sizeof *a);

    *out = a;
    if (!a)
        return QDOT_ENOMEM;
    a->system = system;
    a->options = options;
    a->own = *options;
    a->own.alternates = false;
    a->own.stiff_work = worth_changing;
    a->stiff = method;
    a->series = qdot_ode_method_find("taylor");
    a->now = options->now ? options->now : method;
    a->result = result;
    a->meter = a->own.meter = options->meter ? options->meter : &a->own_meter;
    a->t1 = t1;
    a->expansion = qdot_ode_expansion_work(
        system->series, qdot_ode_taylor_order(system->series, qdot_ode_tolerance(options), false, 0));
    a->patience = first_patience * a->expansion;
    a->y = qdot_malloc(system->n * sizeof *a->y);
    if (!a->y)
        return QDOT_ENOMEM;
    if (!options->meter)
        qdot_ode_meter_begin(a->meter, t0, t1);
    return begin_part(a, t0, y);
}

static qdot_status
alternating_offer(void *run, qdot_ode_step *step)
{
    turns *a = run;
    qdot_status status;

    do { /* a method may turn out to be slow behind its last step, or while it looks for the next */
        if (is_time_to_change(a))
            QDOT_TRY(change_method(a));
        status = qdot_ode_controller_offer(&a->part, &a->step);
    } while (status != QDOT_OK && a->part.result.stiff);
    *step = a->step;
    return status;
}

static qdot_status
alternating_take(void *run, qdot_ode_step *step, bool *taken)
{
    turns *a = run;
    const qdot_status status = qdot_ode_controller_take(&a->part, &a->step, taken);

    *step = a->step;
    return status;
}

/* Compare the methods now and then, before the step is accepted. */
static qdot_status
compare_methods(turns *a)
{
    if (++a->steps % (a->now->series ? looks_at_series : looks) != 0)
        return QDOT_OK;
    if (!a->now->series)
        return compare_with_series(a, a->step.t_end, a->step.y_end);
    compare_with_stiff_method(a, a->step.t_end);
    return QDOT_OK;
}

static qdot_status
alternating_accept(void *run)
{
    turns *a = run;
    const qdot_status compared = compare_methods(a);
    const qdot_status status = qdot_ode_controller_accept(&a->part, &a->step);

    if (a->part.result.stiff) /* the next `offer` changes the method */
        return QDOT_OK;
    return compared != QDOT_OK ? compared : status;
}

static qdot_status
alternating_refuse(void *run, qdot_status why)
{
    turns *a = run;
    const qdot_status status = qdot_ode_controller_refuse(&a->part, why);

    return a->part.result.stiff ? QDOT_OK : status;
}

static void
alternating_state(void *run, double *y, double *low)
{
    const turns *a = run;

    qdot_ode_controller_state(&a->part, y, low);
}

static void
alternating_close(void *run)
{
    turns *a = run;

    if (a->part.kind)
        end_part(a);
    a->result->unfit = a->part.result.unfit;
    a->result->stats = a->before;
    qdot_free(a->y);
    qdot_free(a);
}

const qdot_ode_control qdot_ode_alternating_steps = {.open = alternating_open,
                                                     .offer = alternating_offer,
                                                     .take = alternating_take,
                                                     .accept = alternating_accept,
                                                     .refuse = alternating_refuse,
                                                     .state = alternating_state,
                                                     .close = alternating_close};
