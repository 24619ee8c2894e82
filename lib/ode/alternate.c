/* alternate.c -- changes between a stiff method and Taylor series within one integration. */
#include "ode/alternate.h"

#include <math.h>

#include "ode/meter.h"
#include "ode/taylor.h"
#include "ode/whole.h"

/* The number of steps between two comparisons of speed, while the stiff method is used and while series are. */
enum { looks = 32, looks_at_series = 512 };

/* The factor by which series must be faster before the method is changed; the work to wait for that, in expansions. */
static const double gain = 4, first_patience = 1000;

/* Change from series to the stiff method only if at least this much work (in about ns) remains. */
static const double worth_changing = 3e6;

typedef struct {
    const qdot_ode_system *system;
    const qdot_ode_options *options; /* the options that the caller gave for the whole run */
    const qdot_ode_method *now;      /* the method in use: the stiff one or Taylor series */
    qdot_ode_meter *meter;
    double t1;
    double expansion; /* work of one Taylor expansion (unit: meter.h) */
    double patience;  /* work during which series must win before the method changes */
    uint64_t steps;   /* steps taken since the method was last changed */
    double t, work;   /* time and work at the last comparison */
    double won_since; /* work at the first of the latest comparisons in a row that series won; NaN: they did not win the last */
    double won_at;    /* the time t of that first comparison */
    double pace;      /* progress in t per unit of work that the stiff method has made since `won_at` */
    bool over;        /* this part of the run ended because the method is to be changed */
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

static qdot_status
step_accepted(double t, const double *y, bool *stop, void *user)
{
    turns *a = user;

    if (a->options->now)
        *a->options->now = a->now;
    if (a->options->accepted)
        QDOT_TRY(a->options->accepted(t, y, stop, a->options->user));
    if (*stop || ++a->steps % (a->now->series ? looks_at_series : looks) != 0)
        return QDOT_OK;
    if (a->now->series)
        compare_with_stiff_method(a, t);
    else
        QDOT_TRY(compare_with_series(a, t, y));
    *stop = a->over;
    return QDOT_OK;
}

static qdot_status
step_expanded(qdot_ode_expanded *step, void *user)
{
    turns *a = user;

    if (a->options->now)
        *a->options->now = a->now;
    return a->options->expanded(step, a->options->user);
}

bool
qdot_ode_alternates(const qdot_ode_system *system, const qdot_ode_method *method,
                    const qdot_ode_options *options)
{
    return options->alternates && method->stiff && method->kernel && system->series;
}

/* Integrate with one method from y at t, until the run ends or the method is to be changed; *more: it is. */
static qdot_status
integrate_with_one_method(turns *a, double t, bool first, double *y, qdot_ode_result *result, bool *more)
{
    qdot_ode_options own = *a->options;
    qdot_status status;

    own.alternates = false;
    own.now = NULL;
    own.accepted = step_accepted;
    own.expanded = a->options->expanded ? step_expanded : NULL;
    own.user = a;
    own.meter = a->meter;
    own.stiff_work = worth_changing;
    own.goes_on = a->options->goes_on || !first;
    own.carry = first ? a->options->carry : NULL;
    a->steps = 0;
    a->t = t;
    a->work = a->meter->work;
    a->won_since = NAN;
    a->over = false;
    status = qdot_ode_whole_integrate(a->system, a->now, &own, t, a->t1, y, result);
    *more = (status == QDOT_OK && a->over && result->t != a->t1) || result->stiff;
    if (!*more)
        return status;
    result->stiff = false;
    result->outcome = QDOT_ODE_DONE;
    result->reason[0] = '\0';
    return QDOT_OK;
}

qdot_status
qdot_ode_alternate_integrate(const qdot_ode_system *system, const qdot_ode_method *method,
                             const qdot_ode_options *options, double t0, double t1, double *y,
                             qdot_ode_result *result)
{
    const qdot_ode_method *series = qdot_ode_method_find("taylor");
    const int p =
        qdot_ode_taylor_order(system->series, qdot_ode_tolerance(options), false, 0);
    qdot_ode_meter meter = {0};
    turns a = {.system = system,
               .options = options,
               .now = options->now && *options->now ? *options->now : method,
               .meter = options->meter ? options->meter : &meter,
               .t1 = t1,
               .expansion = qdot_ode_expansion_work(system->series, p)};
    qdot_ode_stats sum = {0};
    double t = t0;
    bool more = true;
    qdot_status status = QDOT_OK;

    if (!options->meter)
        qdot_ode_meter_begin(&meter, t0, t1);
    a.patience = first_patience * a.expansion;
    while (more && status == QDOT_OK) {
        status = integrate_with_one_method(&a, t, t == t0, y, result, &more);
        qdot_ode_stats_add(&sum, &result->stats);
        t = result->t;
        if (more && a.now->series)
            a.patience *= 2;
        if (more)
            a.now = a.now->series ? method : series;
    }
    result->stats = sum;
    return status;
}
