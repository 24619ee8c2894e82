/* standstill.c -- finds where a run is at rest, by the rates of change of the state at its stored points. */
#include "sim/error/standstill.h"

#include <math.h>

#include "sim/form/derived.h"

/* The motion counts as at rest if its rates of change are below this fraction of their largest values. */
static const double little = 1e-2;

/* The largest number of stored points that are inspected. */
enum { MOST = 4096 };

/* The rates dy/dt [n] at stored point k of a run that has one piece; false if undefined. */
static bool
find_rates_at_point(const qdot_run *run, size_t k, double *f)
{
    const qdot_trajectory *tr = &run->course.tr;
    const qdot_ode_system *system =
        qdot_course_systems(&run->course) + tr->pieces.at[0].mode;

    return system->rhs(tr->t[k], tr->y + k * tr->n, f, system->user) == QDOT_OK;
}

qdot_status
qdot_standstill_find(const qdot_run *run, double *t)
{
    const qdot_trajectory *tr = &run->course.tr;
    const size_t n = tr->n, stride = tr->count / MOST + 1;
    const double way = run->t1 < run->t0 ? -1 : 1;
    double least = little, *f, *most;

    *t = NAN;
    if (tr->pieces.n != 1 || qdot_plan_is_driven(run->plan))
        return QDOT_OK;
    if (!(f = qdot_calloc(2 * n, sizeof *f)))
        return QDOT_ENOMEM;
    most = f + n;
    for (size_t k = 0; k < tr->count; k += stride) {
        if (!find_rates_at_point(run, k, f))
            continue;
        for (size_t i = 0; i < n; i++)
            most[i] = fmax(most[i], fabs(f[i]));
    }
    for (size_t k = 0; k < tr->count; k += stride) {
        double largest = 0;

        if (way * (tr->t[k] - run->report.horizon) > 0)
            break;
        if (!find_rates_at_point(run, k, f))
            continue;
        for (size_t i = 0; i < n; i++)
            if (most[i] > 0)
                largest = fmax(largest, fabs(f[i]) / most[i]);
        if (largest < least) {
            least = largest;
            *t = tr->t[k];
        }
    }
    qdot_free(f);
    return QDOT_OK;
}
