/* failure.c -- explains a failed run by a coordinate whose acceleration grows without bound. */
#include "sim/error/failure.h"

#include <math.h>

#include "base/memory.h"
#include "num/samples.h"
#include "ode/scale.h"
#include "sim/form/tables.h"

/* A singularity ahead explains a failure if it is nearer than this fraction of the run's duration. */
static const double nothing = 1e-6;

/* Append a table of data that ends there. */
static qdot_status
explain_by_data(const qdot_plan *plan, double t, const double *y, qdot_text *reason)
{
    double *in = qdot_calloc(3 * plan->n + 1, sizeof *in), handle, at, lo, hi;
    const char *name;

    if (!in)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < 2 * plan->n; i++)
        in[i] = y[i];
    in[2 * plan->n] = t;
    if (qdot_tables_ended(plan, in, &handle, &at) && qdot_samples_range(handle, &lo, &hi)) {
        name = qdot_tables_name(plan, handle);
        qdot_text_format(reason, "; the data%s%.100s go from %.10g to %.10g", name ? " of " : "", name ? name : "", lo, hi);
    }
    qdot_free(in);
    return qdot_text_status(reason);
}

qdot_status
qdot_failure_explain(const qdot_plan *plan, const qdot_ode_system *system, double t,
                     const double *y, double length, qdot_text *reason)
{
    const size_t n = plan->n;
    double *slope, left = INFINITY;
    size_t worst = n;

    QDOT_TRY(explain_by_data(plan, t, y, reason));
    slope = qdot_calloc(2 * n, sizeof *slope);
    if (!slope)
        return QDOT_ENOMEM;
    if (system->rhs(t, y, slope, system->user) == QDOT_OK)
        for (size_t i = 0; i < n; i++) {
            const double a = fabs(slope[n + i]);
            const double v = qdot_ode_size(system->scales, n + i, y[n + i]);

            if (a > 0 && v / a < left) {
                left = v / a;
                worst = i;
            }
        }
    if (worst < n && left < nothing * fabs(length))
        qdot_text_format(reason, "; a singularity: %s = %.6g there, %s'' = %.3g",
                         plan->names[worst], y[worst], plan->names[worst],
                         slope[n + worst]);
    qdot_free(slope);
    return qdot_text_status(reason);
}
