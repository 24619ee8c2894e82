/* extremum.c -- finds the time of an extremum of e: narrows a range about it by halving, then solves de/dt = 0. */
#include "sim/study/extremum.h"

#include <float.h>
#include <math.h>

/* The range is halved down to this fraction of it; ROUNDINGS: values count as equal within this
 * many rounding errors. */
static const double narrow = 1e-5;
enum { HALVINGS = 40, STEPS = 8, ROUNDINGS = 8 };

static qdot_status
extremum_value_at(const qdot_extremum *x, qdot_expr e, double t, double *value)
{
    return qdot_run_values(x->run, 1, &e, 1, &t, value, NULL);
}

/* Halve the range [from, to] about the extremum until it is narrow. */
static qdot_status
narrow_range(const qdot_extremum *x, double *from, double *to)
{
    const double whole = fabs(x->to - x->from);
    double best, value, error;

    QDOT_TRY(qdot_run_range(x->run, x->kind, x->e, *from, *to, &best, &error));
    for (int k = 0; k < HALVINGS && fabs(*to - *from) > narrow * whole; k++) {
        const double middle = *from + 0.5 * (*to - *from);
        const double way = x->kind == QDOT_RANGE_MAX ? 1 : -1;

        QDOT_TRY(qdot_run_range(x->run, x->kind, x->e, *from, middle, &value, &error));
        if (way * (best - value) <= ROUNDINGS * DBL_EPSILON * fmax(fabs(best), DBL_MIN))
            *to = middle;
        else
            *from = middle;
    }
    return QDOT_OK;
}

/* Whether the extremum lies at an end of the time range, e falling (or rising) from there into the range. */
static qdot_status
is_extremum_at_end(const qdot_extremum *x, double end, bool *is)
{
    const double inward = end == x->from ? x->to - x->from : x->from - x->to;
    const double way = x->kind == QDOT_RANGE_MAX ? 1 : -1;
    double rate;

    QDOT_TRY(extremum_value_at(x, x->rate, end, &rate));
    *is = way * rate * inward < 0;
    return QDOT_OK;
}

/* The time t, moved into the range if it lies outside. */
static double
clamp_to_range(const qdot_extremum *x, double t)
{
    return fmax(fmin(x->from, x->to), fmin(fmax(x->from, x->to), t));
}

qdot_status
qdot_extremum_time(const qdot_extremum *x, double *t)
{
    const double whole = fabs(x->to - x->from);
    double from = x->from, to = x->to, rate, bend, step = INFINITY;
    bool end;

    QDOT_TRY(narrow_range(x, &from, &to));
    for (int k = 0; k < 2; k++)
        if (k ? to == x->to : from == x->from) {
            *t = k ? to : from;
            QDOT_TRY(is_extremum_at_end(x, *t, &end));
            if (end)
                return QDOT_OK;
        }
    *t = from + 0.5 * (to - from);
    for (int k = 0; k < STEPS && fabs(step) > 1e-13 * whole; k++) {
        QDOT_TRY(extremum_value_at(x, x->rate, *t, &rate));
        QDOT_TRY(extremum_value_at(x, x->bend, *t, &bend));
        if (bend == 0 && rate != 0)
            break;
        step = clamp_to_range(x, rate == 0 ? *t : *t - rate / bend) - *t;
        if (!(fabs(*t + step - from - 0.5 * (to - from)) <= 100 * narrow * whole))
            break;
        *t += step;
    }
    if (fabs(step) <= 1e-9 * whole)
        return QDOT_OK;
    return qdot_fail(QDOT_EFAILED,
                     "the extremum near t = %.9g is a corner: it has no slope", *t);
}
