/* companion-ways.c -- the methods of companion runs (for error estimates), their starts, and their cost limits. */
#include <math.h>
#include <stdint.h>

#include "ode/companion.h"
#include "ode/scale.h"
#include "ode/step-decisions.h"
#include "ode/taylor.h"

static const double unit = 0x1p-53;

/* Rounding error of a velocity computed from a conserved momentum, in units of 2^-53. */
static const double derived = 4;

/* The cost allowed for each companion, relative to the run. The rest of QDOT_COMPANION_MOST is for
 * the horizon. */
static const double shares[] = {1.55, 1.3};

/* Of QDOT_COMPANION_LEAST: what a way may take before it leads anywhere, so that the others have the
 * rest. Beside a stiff method there are more of them, of which the finer one begins with a dear step (bsimp
 * 4e5 in friction of tanh(1e6 v)); series are for scenes that are not stiff, where they cost little; radau is
 * all that a multistep method has. */
static const double at_first = 0.8, at_first_stiff = 0.25, at_first_multistep = 0.75;
static const double beside_stiff = 0.4;

/* The smallest error stated is 2u sqrt(steps), u = 2^-53, in which the square root counts at most this. */
static const double most_floor = 32;

/* Nearer to its companion_tol a stiff method of ours meets the rounding of most scenes, and its steps
 * become many; a coarse run is this far above it, so as not to share the run's rounding. */
static const double above_rounding = 10, beyond_rounding = 10;

/* The factors by which the tolerances of companion runs are coarser or finer than that of the run. */
static const double coarser = 4, finer[] = {16, 32};

/* What both companions by Taylor series should cost, of the work of the run, and which powers of their
 * ratio of tolerances (method.h) are tried for that. */
static const double foreseen = 2.8, powers[] = {1, 0.75, 0.5};

/* Where the rounding of terms bounds the steps, those of a companion are not the run's: a drift that is
 * made by the rounding of the same coefficients again and again would be common to both. */
static const double term_shares[] = {0.75, 1.5};

bool
qdot_companion_is_by_series(const qdot_ode_method *method)
{
    return !(method->stiff && method->kernel);
}

const qdot_ode_method *
qdot_companion_method(const qdot_ode_system *system, const qdot_ode_method *method)
{
    return qdot_ode_method_find(system->series && qdot_companion_is_by_series(method) ? "taylor"
                                : method->stiff                                       ? "radau"
                                                                                      : method->partner);
}

/* The work of a run by Taylor series with tolerance tol, up to a factor that does not depend on tol. */
static double
taylor_work(const qdot_ode_series *series, double tol, int more)
{
    const int p = qdot_ode_taylor_order(series, tol, false, more);

    return qdot_ode_expansion_work(series, p) * exp(-log(qdot_step_aim(tol, false)) / p);
}

/* For a run by Taylor series with tolerance tol: the tightest of these tolerances that both
 * companions can afford. */
static double
find_affordable_tolerance(const qdot_ode_series *series, const qdot_ode_method *taylor, double tol)
{
    const double most = foreseen * taylor_work(series, tol, 0);
    double theirs = tol, work;

    for (size_t k = 0; k < sizeof powers / sizeof *powers; k++) {
        theirs = fmax(pow(taylor->companion_ratio, powers[k]) * tol, taylor->companion_tol);
        work = taylor_work(series, theirs, qdot_companion_orders(0)) + taylor_work(series, theirs, qdot_companion_orders(1));
        if (work <= most)
            break;
    }
    return theirs;
}

double
qdot_companion_tolerance(const qdot_ode_system *system, const qdot_ode_method *method,
                         double tol)
{
    const qdot_ode_method *partner = qdot_companion_method(system, method);
    bool same = partner == method;

    if (same && partner->series)
        return find_affordable_tolerance(system->series, partner, tol);
    if (partner->series)
        return fmax(fmin(partner->companion_ratio, method->companion_ratio) * tol,
                    partner->companion_tol);
    if (same && method->companion_tol > tol / 4)
        return 10 * fmax(tol, method->companion_tol);
    return fmax(method->companion_ratio * tol, (method->stiff ? partner : method)->companion_tol);
}

qdot_companion_way
qdot_companion_way_from(qdot_companion_way way, size_t number, const qdot_ode_system *system,
                        const qdot_ode_method *method, double tol, qdot_companion_plan *plan)
{
    const bool gets_finer =
        method->stiff && !method->multistep
        && tol / finer[1] >= (method->kernel ? above_rounding : 1) * method->companion_tol;
    qdot_ode_system plain = *system;

    plain.series = NULL;
    *plan = (qdot_companion_plan){0};
    if (way == QDOT_COMPANION_SERIES && (!system->series || !qdot_companion_is_by_series(method)))
        way = QDOT_COMPANION_PARTNER;
    if (way == QDOT_COMPANION_PARTNER && (method->stiff ? method->kernel && gets_finer : system->series != NULL))
        way = QDOT_COMPANION_FINER;
    if (way == QDOT_COMPANION_FINER && !gets_finer)
        way = QDOT_COMPANION_COARSE;
    if (way == QDOT_COMPANION_SERIES) {
        plan->method = qdot_companion_method(system, method);
        plan->tol = qdot_companion_tolerance(system, method, tol);
    } else if (way == QDOT_COMPANION_PARTNER) {
        plan->method = qdot_companion_method(&plain, method);
        plan->tol = qdot_companion_tolerance(&plain, method, tol);
    } else if (way == QDOT_COMPANION_FINER) {
        plan->method = method;
        plan->tol = tol / finer[number];
    } else if (way == QDOT_COMPANION_COARSE) {
        plan->method = method;
        plan->tol = fmin(1, fmax(coarser * tol, beyond_rounding * method->companion_tol));
    }
    return way;
}

double
qdot_companion_left(double work, double spent)
{
    return fmax(0, QDOT_COMPANION_MOST * work - spent);
}

void
qdot_companion_meter(qdot_ode_meter *m, const qdot_ode_meter *run,
                     const qdot_ode_system *system, const qdot_ode_method *method, qdot_companion_way way,
                     size_t number, double spent)
{
    m->beside = run;
    m->factor = shares[number];
    m->allowance = QDOT_COMPANION_LEAST;
    m->early_factor = way == QDOT_COMPANION_SERIES && method->stiff ? beside_stiff
                      : way == QDOT_COMPANION_PARTNER       ? shares[1]
                                                            : m->factor;
    m->early = at_first;
    if (way == QDOT_COMPANION_PARTNER)
        m->early = method->stiff && method->multistep ? at_first_multistep : at_first_stiff;
    else if (method->stiff && way != QDOT_COMPANION_FINER)
        m->early = at_first_stiff;
    m->early *= QDOT_COMPANION_LEAST;
    m->spent = spent;
    m->whole_only = system->n_parts > 1 || way == QDOT_COMPANION_COARSE;
}

/* Signs without a pattern that a symmetric system could share (Knuth's multiplicative
 * hash of the index, bit 31). */
static bool
is_shifted_up(size_t i, size_t number)
{
    return (uint32_t)(i + 1) * UINT32_C(2654435769) >> 31 == number % 2;
}

double
qdot_companion_unit(const double *scales, size_t n, const double *y, size_t i)
{
    const double scale = qdot_ode_scale(scales, i), beside = fabs(y[i < n / 2 ? i + n / 2 : i - n / 2]);

    return y[i] == 0 && beside > unit * scale ? fmin(scale, beside) : scale;
}

static double
shift_in_doubles(size_t number)
{
    return number == 0 ? 1 : QDOT_COMPANION_FAR;
}

/* The shift of component i (of that size, see scale.h) at the start of companion `number` of a run
 * in two doubles. */
static double
shift_of_component(double tol, double size, size_t i, size_t number)
{
    const double by = shift_in_doubles(number) * QDOT_COMPANION_AIMS * qdot_step_aim(tol, true) * size;

    return is_shifted_up(i, number) ? by : -by;
}

double
qdot_companion_moved(double y, double scale, size_t i, size_t number)
{
    const bool up = is_shifted_up(i, number);

    if (y == 0)
        return (up ? unit : -unit) * shift_in_doubles(number) * scale;
    return y + shift_in_doubles(number) * (nextafter(y, up ? INFINITY : -INFINITY) - y);
}

/* The first coordinate that has the same size as component i; if that is a velocity, the first such velocity. */
static size_t
first_of_same_size(size_t n, const double *y, size_t i)
{
    size_t k = i < n / 2 ? 0 : n / 2;

    while (fabs(y[k]) != fabs(y[i]))
        k++;
    return k;
}

bool
qdot_companion_has_alike(size_t n, const double *y)
{
    for (size_t i = 0; i < n; i++)
        if (first_of_same_size(n, y, i) != i)
            return true;
    return false;
}

void
qdot_companion_beside(const double *scales, size_t n, const double *y, size_t number, bool alike, double tol,
                      double *start, double *low)
{
    for (size_t i = 0; i < n; i++) {
        const size_t as = alike ? first_of_same_size(n, y, i) : i;
        const double in = qdot_companion_unit(scales, n, y, i), way = y[i] == y[as] ? 1 : -1;

        start[i] = low ? y[i] : way * qdot_companion_moved(way * y[i], in, as, number);
        if (low)
            low[i] += way * shift_of_component(tol, fmax(in, fabs(y[i])), as, number);
    }
}

int
qdot_companion_orders(size_t number)
{
    return number ? 1 : QDOT_COMPANION_ORDERS;
}

double
qdot_companion_term_tol(double tol, size_t number)
{
    return term_shares[number] * tol;
}

double
qdot_companion_first_share(size_t number)
{
    return number ? 0.4142 : 0.618;
}

double
qdot_companion_floor(const qdot_ode_system *system, bool leading, uint64_t steps)
{
    if (leading)
        return system->following ? derived * unit : unit;
    return 2 * unit * fmin(most_floor, fmax(1, sqrt((double)steps)));
}
