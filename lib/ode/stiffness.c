/* stiffness.c -- detects stiffness: whether states sampled over hundreds of steps lie on a parabola in time. */
#include "ode/stiffness.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "ode/scale.h"

/* The numbers of steps between successive samples of the state, 4000 in total; at first an eighth of these. */
static const int waits[QDOT_ODE_STIFF_PLACES] = {1, 397, 512, 331, 467, 389, 541, 443, 491, 429};
static const int eager = 8, windows_eager = 2;

/* The number of steps before the first sample is taken: shorter runs need no test. */
static const int first_wait = 100;

/* The deviation from a parabola, relative to its range, up to which a component counts as smooth. */
static const double share = 1e-2;

static const double work_default = 5e9;

/* With an explicit method, h times the fastest rate is at least this if stability limits h; the
 * step of differences. */
static const double least_bound = 0.1, difference = 1e-7;

/* Only after this many steps may the run be judged by them alone; earlier they may be short by chance. */
static const uint64_t patient = 1000000;

void
qdot_ode_stiffness_clear(qdot_ode_stiffness *s)
{
    qdot_free(s->y);
    *s = (qdot_ode_stiffness){0};
}

/* Whether component i of the samples lies on the parabola through the first, middle and last of them. */
static bool
component_is_smooth(const qdot_ode_stiffness *s, size_t i, const qdot_ode_stiff_step *at)
{
    enum { LAST = QDOT_ODE_STIFF_PLACES - 1, MIDDLE = LAST / 2 };
    const size_t n = at->n;
    const double *y = s->y + i, a = y[0], b = y[MIDDLE * n], c = y[LAST * n];
    const double T = s->t[LAST] - s->t[0], m = (s->t[MIDDLE] - s->t[0]) / T;
    const double curved = ((b - a) / m - (c - a)) / (m - 1);
    const double noise = at->noise * qdot_ode_size(at->scales, i, b);
    double low = a, high = a;

    for (size_t k = 1; k <= LAST; k++) {
        low = fmin(low, y[k * n]);
        high = fmax(high, y[k * n]);
    }
    for (size_t k = 1; k < LAST; k++) {
        const double x = (s->t[k] - s->t[0]) / T, by = a + x * (c - a) + curved * x * (x - 1);

        if (!(fabs(y[k * n] - by) <= share * (high - low) + noise))
            return false;
    }
    return true;
}

static bool
all_components_are_smooth(const qdot_ode_stiffness *s, const qdot_ode_stiff_step *at)
{
    for (size_t i = 0; i < at->n; i++)
        if (!component_is_smooth(s, i, at))
            return false;
    return true;
}

/* Estimate |df/dy| by differences of size `by` in both directions, in units of the components'
 * sizes; room [3n]. */
static qdot_status
estimate_largest_derivative(const qdot_ode_stiff_step *at, double by, double *room, double *slope)
{
    const qdot_ode_system *system = at->system;
    const size_t n = at->n;
    double *y = room, *f = y + n, *moved = f + n, sum = 0;

    memcpy(y, at->y, n * sizeof *y);
    QDOT_TRY(system->rhs(at->t, y, f, system->user));
    for (size_t k = 0; k < 2 * n; k++) {
        const size_t j = k / 2;

        y[j] += (k % 2 ? -by : by) * qdot_ode_size(at->scales, j, y[j]);
        QDOT_TRY(system->rhs(at->t, y, moved, system->user));
        y[j] = at->y[j];
        for (size_t i = 0; i < n; i++)
            sum += pow((moved[i] - f[i]) / (by * qdot_ode_size(at->scales, i, y[i])), 2);
    }
    *slope = sqrt(0.5 * sum);
    return QDOT_OK;
}

/* Whether stability may bound steps of length h: h |df/dy| is no less than h by the fastest rate. Slopes are
 * taken from near by to as far as steps may err: a motion that is held in a layer narrower than that jumps
 * from side to side of it. */
static qdot_status
stability_may_limit_steps(const qdot_ode_stiff_step *at, double h, bool *may)
{
    double *room, slope = 0;
    qdot_status status = QDOT_OK;

    *may = true;
    if (!at->system)
        return QDOT_OK;
    room = qdot_malloc(3 * at->n * sizeof *room);
    if (!room)
        return QDOT_ENOMEM;
    *may = false;
    for (double by = difference; status == QDOT_OK && !*may && by <= fmax(difference, at->noise); by *= 10) {
        status = estimate_largest_derivative(at, by, room, &slope);
        *may = status != QDOT_OK || !(h * slope < least_bound);
    }
    qdot_free(room);
    return qdot_grave(status);
}

/* The number of steps from sample k - 1 to sample k of the state. */
static int
steps_to_sample(const qdot_ode_stiffness *s, size_t k)
{
    return (s->windows < windows_eager || s->high) && k > 0 ? waits[k] / eager : waits[k];
}

static int
steps_of_window(const qdot_ode_stiffness *s)
{
    int sum = 0;

    for (size_t k = 1; k < QDOT_ODE_STIFF_PLACES; k++)
        sum += steps_to_sample(s, k);
    return sum;
}

/* Store a sample of the state; *enough: there are now enough samples for a judgement. */
static qdot_status
store_sample(qdot_ode_stiffness *s, const qdot_ode_stiff_step *at, bool *enough)
{
    if (!s->y)
        s->y = qdot_malloc(QDOT_ODE_STIFF_PLACES * at->n * sizeof *s->y);
    if (!s->y)
        return QDOT_ENOMEM;
    memcpy(s->y + s->count * at->n, at->y, at->n * sizeof *s->y);
    s->t[s->count++] = at->t;
    *enough = s->count == QDOT_ODE_STIFF_PLACES;
    s->wait = steps_to_sample(s, *enough ? 0 : s->count);
    return QDOT_OK;
}

/* Steps of length h to t1, if they go on to grow as they did from the first half of the window to the second:
 * h exp(k n) after n of them. */
static double
estimate_steps_left(const qdot_ode_stiffness *s, double h, double t1)
{
    enum { LAST = QDOT_ODE_STIFF_PLACES - 1, MIDDLE = LAST / 2 };
    const double so = fabs((t1 - s->t[LAST]) / h);
    int first = 0, second = 0;
    double growth, k;

    for (size_t i = 1; i <= LAST; i++)
        *(i <= MIDDLE ? &first : &second) += steps_to_sample(s, i);
    growth = fabs((s->t[LAST] - s->t[MIDDLE]) * first / ((s->t[MIDDLE] - s->t[0]) * second));
    k = 2 * log(growth) / (first + second);
    return k > 0 ? log1p(k * so) / k : so;
}

bool
qdot_ode_stiffness_is_due(qdot_ode_stiffness *s)
{
    if (s->wait == 0)
        s->wait = first_wait;
    return --s->wait <= 0;
}

qdot_status
qdot_ode_stiffness_look(qdot_ode_stiffness *s, const qdot_ode_stiff_step *at,
                        const qdot_ode_options *options, bool *stiff)
{
    const double worth = options->stiff_work > 0 ? options->stiff_work : work_default;
    double step, left;
    bool enough;

    s->high = at->high;
    QDOT_TRY(store_sample(s, at, &enough));
    if (!enough)
        return QDOT_OK;
    step = (at->t - s->t[0]) / steps_of_window(s);
    left = estimate_steps_left(s, step, at->t1);
    *stiff = !at->implicit && left * at->work > worth && all_components_are_smooth(s, at);
    if (*stiff)
        QDOT_TRY(stability_may_limit_steps(at, fabs(step), stiff));
    s->count = 0;
    s->steps += (uint64_t)steps_of_window(s);
    s->windows++;
    if (s->steps >= patient && left > (double)at->most && !*stiff)
        return qdot_fail(QDOT_ELIMIT,
                         "stopped at t = %.4g: steps of %.1g, of which %.0e are left, are more than "
                         "a run may take (%.0e)",
                         at->t, fabs(step), left, (double)at->most);
    if (!*stiff)
        return QDOT_OK;
    return qdot_fail(QDOT_ELIMIT,
                     "stopped at t = %.4g: the scene is stiff there: stability allows steps of "
                     "%.1g, of which %.0e are left; method radau needs few",
                     at->t, fabs(step), left);
}
