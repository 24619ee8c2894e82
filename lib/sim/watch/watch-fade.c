/* watch-fade.c -- detects watched functions that have decayed below the rounding error of the run. */
#include <float.h>
#include <math.h>

#include "ode/scale.h"
#include "sim/watch/watch-parts.h"
#include "sim/watch/watch.h"

/* A function counts as decayed if it is below this fraction of its largest magnitude so far. */
static const double decayed = 0x1p-20;

/* It has faded when it was within its rounding all through so many steps in a row: one that only crosses 0 is larger at
 * the end of the next step. */
enum { STEPS = 3 };

/* The rounding of a component of the state, relative to its size; so many times that must be exceeded by a function that
 * has faded before it is searched again, because roundings add up along the run. */
static const double rounding = DBL_EPSILON / 2, more = 32;

void
qdot_watch_may_fade(qdot_watch *w, size_t i, bool may)
{
    w->may_fade[i] = may;
}

/* Find how much the function g_i changes if each component of y [2n] is rounded relative to its scale. */
static qdot_status
find_rounding_level(qdot_watch *w, double t, const double *y, size_t i, double *floor)
{
    const double *scales = w->reader.system->scales;

    for (size_t k = 0; k < 2 * w->n; k++)
        w->z[k] = qdot_ode_size(scales, k, y[k]);
    QDOT_TRY(qdot_watch_noise_of(w, t, y, w->z, i, floor));
    *floor *= rounding / (4 * DBL_EPSILON) * (w->faded[i] >= STEPS ? more : 1);
    return QDOT_OK;
}

/* Whether g_i is non-zero but within its rounding error throughout the step that ends at (t, y). */
static qdot_status
is_within_rounding(qdot_watch *w, double t, const double *y, size_t i, bool *within)
{
    enum { PLACES = 4 };
    double floor, most = fabs(w->final[i]);

    *within = false;
    QDOT_TRY(find_rounding_level(w, t, y, i, &floor));
    if (most > floor)
        return QDOT_OK;
    for (int k = 1; k < PLACES && most <= floor; k++) {
        const double at = w->t + (t - w->t) * k / PLACES;

        QDOT_TRY(w->reader.read(at, w->in, w->reader.user));
        QDOT_TRY(qdot_watch_value(w, at, w->g));
        most = fmax(most, fabs(w->g[i]));
    }
    *within = most > 0 && most <= floor;
    return QDOT_OK;
}

qdot_status
qdot_watch_find_fading(qdot_watch *w, double t, const double *y)
{
    for (size_t i = 0; i < w->m; i++) {
        bool within = false;

        if (w->may_fade[i] && fabs(w->final[i]) <= decayed * w->most[i])
            QDOT_TRY(is_within_rounding(w, t, y, i, &within));
        w->fading[i] = within;
    }
    return QDOT_OK;
}

bool
qdot_watch_has_faded(const qdot_watch *w, size_t i)
{
    return w->fading[i] && w->faded[i] + 1 >= STEPS;
}

void
qdot_watch_take_fading(qdot_watch *w)
{
    for (size_t i = 0; i < w->m; i++) {
        w->most[i] = fmax(w->most[i], fabs(w->final[i]));
        if (w->fading[i] && w->faded[i]++ == 0)
            w->faded_since[i] = w->t;
        if (!w->fading[i])
            w->faded[i] = 0;
    }
}

double
qdot_watch_faded_since(const qdot_watch *w, size_t i)
{
    return w->faded[i] >= STEPS ? w->faded_since[i] : NAN;
}
