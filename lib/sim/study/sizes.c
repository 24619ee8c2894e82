/* sizes.c -- finds the largest magnitudes of expressions along a run, at equidistant times. */
#include "sim/study/sizes.h"

#include <math.h>

#include "base/memory.h"

/* Sizes are called far apart if one is smaller than this fraction of the largest, or of 1. */
static const double apart = 1e-2;

/* A value is known if it exceeds this many times its error. */
static const double known = 10;

enum { TIMES = 17 };

qdot_status
qdot_sizes_along(qdot_run *run, size_t n, const qdot_expr *e, double *size)
{
    const qdot_run_report *report = qdot_run_get_report(run);
    double t[TIMES], *value = qdot_calloc(2 * n * TIMES + 1, sizeof *value), *error = value + n * TIMES;
    qdot_status status = value != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (int k = 0; k < TIMES; k++)
        t[k] = k + 1 == TIMES ? report->t1 : report->t0 + (report->t1 - report->t0) * k / (TIMES - 1);
    if (status == QDOT_OK)
        status = qdot_run_values(run, n, e, TIMES, t, value, error);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        size[i] = 0;
        for (size_t k = 0; k < TIMES; k++)
            if (!(fabs(value[k * n + i]) < known * error[k * n + i]))
                size[i] = fmax(size[i], fabs(value[k * n + i]));
    }
    qdot_free(value);
    return status;
}

bool
qdot_sizes_are_apart(size_t n, const double *size)
{
    double least = 1, most = 1;

    for (size_t i = 0; i < n; i++) {
        least = size[i] > 0 ? fmin(least, size[i]) : least;
        most = fmax(most, size[i]);
    }
    return least <= apart * most;
}
