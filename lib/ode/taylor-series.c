/* taylor-series.c -- the order of a run by Taylor series, and the series of each step. */
#include "ode/taylor.h"

#include "num/series.h"
#include "ode/companion.h"
#include "ode/step-decisions.h"

/* The lowest order; how many of the highest orders are left to companion runs (companion.h). */
enum { least_order = 6, of_companions = QDOT_COMPANION_ORDERS + 1 };

/* Stability limits for orders from 6 on: 10 z, where |sum_{k=0..p} (iz)^k/k!| <= 1 + 1e-6 up to z. */
static const unsigned char stable[] = {
    5,   17,  33,  12,  14,  19,  33,  50,  26,  28,  35,  49,  65,  42,  45,
    51,  65,  81,  60,  62,  68,  81,  97,  112, 79,  85,  97,  113, 128, 97,
    102, 113, 128, 144, 115, 120, 129, 144, 160, 133, 137, 145, 160};

double
qdot_ode_taylor_stable(int p)
{
    const int i = p - least_order, last = (int)(sizeof stable / sizeof *stable) - 1;

    return 0.1 * stable[i < 0 ? 0 : i > last ? last : i];
}

static double
cost_of_expansion(const qdot_ode_cost *cost, int p)
{
    const bool written = cost->code[0] > 0;
    const double *c = written ? cost->code : cost->kernels;
    const int more = written && p > cost->narrow ? p - cost->narrow : 0;

    return c[0] + c[1] * p + c[2] * p * p +
           (cost->wider > 0 ? cost->wider * ((more + cost->of_vector - 1) / cost->of_vector) : 0);
}

/* The order whose expansions cost least for a time as long as the radius of convergence. */
static int
find_cheapest_order(const qdot_ode_cost *model, int most, double tol, bool leading)
{
    double L = -log(qdot_step_aim(tol, leading)), least = INFINITY;
    const bool more_digits = model->code[0] > 0 && L < model->digits;
    const bool by_stability = more_digits && model->by_stability;
    int best = least_order;

    if (more_digits)
        L = model->digits;
    for (int p = least_order; p <= most - of_companions; p++) {
        double cost = cost_of_expansion(model, p) * exp(L / p);

        if (by_stability)
            cost *= p / qdot_ode_taylor_stable(p);
        if (cost < least) {
            least = cost;
            best = p;
        }
    }
    return best;
}

int
qdot_ode_taylor_order(const qdot_ode_series *series, double tol, bool leading, int more)
{
    const int best = find_cheapest_order(&series->cost, series->most, tol, leading) + more;

    return best < series->most ? best : series->most;
}

int
qdot_ode_taylor_highest(const qdot_ode_system *system, double tol, bool leading, int more)
{
    const qdot_ode_method *method = qdot_ode_method_find("taylor");
    const int own = qdot_ode_taylor_order(system->series, tol, leading, more);
    int theirs;

    if (more == 0)
        tol = qdot_companion_tolerance(system, method, tol);
    theirs = qdot_ode_taylor_order(system->series, tol, leading, QDOT_COMPANION_ORDERS);
    return own > theirs ? own : theirs;
}

double
qdot_ode_taylor_cost(const qdot_ode_cost *cost, int most, double tol)
{
    const int p = find_cheapest_order(cost, most, tol, false);

    return cost_of_expansion(cost, p) * exp(-log(qdot_step_aim(tol, false)) / p);
}

double
qdot_ode_taylor_least_term(const qdot_ode_series *series, size_t n, int p, double s,
                           const double *scale, int *cut)
{
    double power = 1, before = INFINITY, least = INFINITY;

    for (int k = 1; k <= p; k++) {
        double now = 0;

        power *= s;
        for (size_t i = 0; i < n; i++)
            now = fmax(now,
                       fabs(series->x[i * series->stride + (size_t)k]) * power * scale[i]);
        if (k > 4 && fmax(before, now) < least) {
            least = fmax(before, now);
            *cut = k;
        }
        before = now;
    }
    return least;
}

/* Whether the coefficients of order p of all n components are 0. */
static bool
coefficients_are_zero(const qdot_ode_series *series, size_t n, int p)
{
    for (size_t i = 0; i < n; i++)
        if (series->x[i * series->stride + (size_t)p] != 0)
            return false;
    return true;
}

int
qdot_ode_taylor_last_order(const qdot_ode_system *system, int p)
{
    while (p > 2 && coefficients_are_zero(system->series, system->n, p))
        p--;
    return p;
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

void
qdot_ode_taylor_evaluate_two(const qdot_ode_system *system, const qdot_ode_expanded *step, double t,
                             double t_low, qdot_two *y)
{
    enum { of_two = QDOT_ODE_LEADING_MOST };
    const qdot_ode_series *series = system->series;
    const qdot_two_kernels *kernels = qdot_two_kernels_get();
    qdot_two s, powers[QDOT_ODE_LEADING_MOST + 1];
    double high[QDOT_SERIES_MOST + 8];

    s.hi = qdot_two_rounded_sum(t, -step->t, &s.lo);
    s.lo += t_low;
    s = qdot_two_scale(qdot_two_of(s.hi, s.lo), 1 / step->unit);
    kernels->powers(s, of_two, step->order > of_two ? step->order : of_two, powers, high);
    for (size_t i = 0; i < system->n; i++) {
        const double *x = series->x + i * series->stride;
        qdot_two first[QDOT_ODE_LEADING_MOST + 1];
        int last = step->order;

        while (last > of_two && x[last] == 0)
            last--;
        first[0] = qdot_two_of(step->y[i], step->carry ? step->carry[i] : 0);
        for (int k = 1; k <= of_two; k++)
            first[k] = (qdot_two){k <= step->order ? x[k] : 0, 0};
        y[i] = kernels->series(of_two, last, first, powers, x, high);
    }
}

void
qdot_ode_taylor_rounding_two(const qdot_ode_system *system, const qdot_ode_expanded *step, double t, double *rounding)
{
    const qdot_ode_series *series = system->series;
    const double s = fabs((t - step->t) / step->unit);

    for (size_t i = 0; i < system->n; i++) {
        const double *x = series->x + i * series->stride;
        double rest = 0;

        for (int k = step->order; k > QDOT_ODE_LEADING_MOST; k--)
            rest = s * (rest + fabs(x[k]));
        rounding[i] = DBL_EPSILON * rest * pow(s, QDOT_ODE_LEADING_MOST);
    }
}

qdot_status
qdot_ode_taylor_expand(const qdot_ode_system *system, int p, double t0, double h,
                       const double *y0)
{
    const qdot_ode_series *series = system->series;

    QDOT_TRY(series->begin(t0, y0, qdot_step_unit(h), series->user));
    return series->extend(p, series->user);
}
