/* failure.c -- explains a failed run by a coordinate whose acceleration grows without bound. */
#include "sim/error/failure.h"

#include <math.h>

#include "ode/scale.h"

/* A singularity ahead explains a failure if it is nearer than this fraction of the run's duration. */
static const double nothing = 1e-6;

qdot_status
qdot_failure_explain(const qdot_plan *plan, const qdot_ode_system *system, double t,
                     const double *y, double length, qdot_text *reason)
{
    const size_t n = plan->n;
    double *slope = qdot_calloc(2 * n, sizeof *slope), left = INFINITY;
    size_t worst = n;

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
