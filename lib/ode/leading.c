/* leading.c -- decides which of the first orders of a Taylor series need two doubles, and sums the series with them. */
#include "ode/leading.h"

#include <math.h>

#include "base/memory.h"
#include "num/series.h"
#include "ode/scale.h"
#include "ode/step-decisions.h"

static bool
is_derived_component(const qdot_ode_system *system, size_t i)
{
    const qdot_ode_following *f = system->following;

    for (size_t k = 0; f && k < f->n; k++)
        if (f->index[k] == i)
            return true;
    return false;
}

/* The highest order of the series with a term whose rounding error matters; `power` holds s^k at order k. */
static int
highest_order_with_rounding(const qdot_ode_leading_step *step, const double *power)
{
    const qdot_ode_series *series = step->system->series;
    int m = 1;

    for (int k = 2; k <= QDOT_ODE_LEADING_MOST && k <= step->p; k++) {
        const double most = step->eps * 0x1p52 / fabs(power[k]);

        for (size_t i = 0; i < step->system->n && m < k; i++)
            if (!(fabs(series->x[i * series->stride + (size_t)k]) * step->scale[i] <= most))
                m = k;
    }
    return m;
}

/* Whether a single double was accurate enough for order k of the series. */
static bool
doubles_suffice(const qdot_ode_leading_step *step, int k, double power)
{
    const qdot_ode_series *series = step->system->series;
    const qdot_ode_leading *leading = step->system->leading;
    const double most = 4 * step->eps / power;

    for (size_t i = 0; i < step->system->n; i++)
        if (!(fabs(leading->x[i * leading->stride + (size_t)k].hi
                   - series->x[i * series->stride + (size_t)k])
                  * step->scale[i] <= most)
            && !is_derived_component(step->system, i))
            return false;
    return true;
}

/* Find how many first orders of the series need two doubles; `power` holds the powers s^k of the step s. */
static qdot_status
find_orders_in_two_doubles(const qdot_ode_leading_step *step, const double *power, int *m)
{
    const qdot_ode_leading *leading = step->system->leading;
    const int most =
        step->p <= QDOT_ODE_LEADING_MOST ? step->p - 1 : QDOT_ODE_LEADING_MOST;
    const int least = highest_order_with_rounding(step, power);

    QDOT_TRY(leading->begin(&step->at, step->unit, leading->user));
    for (*m = 1; *m <= most; ++*m) {
        QDOT_TRY(leading->next(*m, leading->user));
        if (*m >= least && doubles_suffice(step, *m, fabs(power[*m])))
            return QDOT_OK;
    }
    *m = most;
    return QDOT_OK;
}

qdot_status
qdot_ode_leading_advance(const qdot_ode_leading_step *step, double *next,
                         double *next_carry)
{
    const qdot_two_kernels *kernels = qdot_two_kernels_get();
    const qdot_ode_series *series = step->system->series;
    const qdot_ode_leading *leading = step->system->leading;
    const qdot_two s = qdot_two_of(step->h / step->unit, step->h_low / step->unit);
    double power[QDOT_SERIES_MOST + 1];
    qdot_two two[QDOT_ODE_LEADING_MOST + 1];
    int m;

    kernels->powers(s, QDOT_ODE_LEADING_MOST, step->p, two, power);
    QDOT_TRY(find_orders_in_two_doubles(step, power, &m));
    for (size_t i = 0; i < step->system->n; i++) {
        qdot_two sum;

        if (is_derived_component(step->system, i))
            continue;
        sum = kernels->series(m, step->p, leading->x + i * leading->stride, two,
                              series->x + i * series->stride, power);
        next[i] = sum.hi;
        next_carry[i] = sum.lo;
    }
    return QDOT_OK;
}

qdot_status
qdot_ode_leading_read(const qdot_ode_system *system, int p, double tol,
                      const qdot_ode_place *at, double h, double t, double *y)
{
    double *room = qdot_malloc(2 * system->n * sizeof *room);
    qdot_ode_leading_step step = {.system = system,
                                  .at = *at,
                                  .unit = qdot_step_unit(h),
                                  .eps = qdot_step_aim(tol, true),
                                  .scale = room,
                                  .p = p};
    qdot_status status;

    if (!room)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < system->n; i++) {
        room[i] = 1 / qdot_ode_size(system->scales, i, at->y[i]);
        y[i] = at->y[i];
    }
    step.h = qdot_two_rounded_sum(t, -at->t, &step.h_low);
    step.h_low -= at->t_low;
    status = qdot_ode_leading_advance(&step, y, room + system->n);
    qdot_free(room);
    return status;
}
