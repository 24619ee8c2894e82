/* taylor-series.c -- the order of a run, and the series of one of its steps. */
#include "ode/taylor.h"

#include "num/series.h"
#include "ode/taylor-numbers.h"

enum { least_order = 6 };

/* Digits (natural ones) that an order is chosen for at least where it runs as machine code: of
 * a step of few orders most is what every step takes, more than `cost`, which is of kernels,
 * knows (doc/methods.md). */
static const double least_digits = 16;

int
qdot_ode_taylor_order(const qdot_ode_series *series, double tol, int more)
{
    const double *c = series->cost;
    double L = -log(qdot_step_aim(tol)), least = INFINITY;
    int best = least_order;

    if (series->write)
        L = fmax(L, least_digits);
    for (int p = least_order; p <= series->most; p++) {
        double cost = (c[0] + c[1] * p + c[2] * p * p) * exp(L / p);

        if (cost < least) {
            least = cost;
            best = p;
        }
    }
    best += more;
    return best < series->most ? best : series->most;
}

void
qdot_ode_taylor_evaluate(const qdot_ode_system *system, int p, double t0, double h,
                         double t, const double *y0, double *y)
{
    const qdot_ode_series *series = system->series;
    double s = (t - t0) / qdot_step_unit(h);

    qdot_series_kernels_get()->tails(system->n, series->x, series->stride, p, s, y, NULL);
    for (size_t i = 0; i < system->n; i++)
        y[i] = y0[i] + s * (series->x[i * series->stride + 1] + y[i]);
}

qdot_status
qdot_ode_taylor_expand(const qdot_ode_system *system, int p, double t0, double h,
                       const double *y0)
{
    const qdot_ode_series *series = system->series;

    QDOT_TRY(series->begin(t0, y0, qdot_step_unit(h), series->user));
    return series->extend(p, series->user);
}
