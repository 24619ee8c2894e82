/* watch-noise.c -- estimates rounding errors of the watched functions. */
#include "sim/watch/watch-parts.h"
#include "sim/watch/watch.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "tape/rounding.h"

/* --- rounding at a state -------------------------------------------------------------- */

/* Find the change |g_i - g| if component k of the state y (2n: none) becomes `to`; 0 if undefined. */
static qdot_status
change_by_component(qdot_watch *w, double t, const double *y, size_t k, double to, size_t i, double g, double *change)
{
    qdot_status status;

    memcpy(w->in, y, 2 * w->n * sizeof *y);
    if (k < 2 * w->n)
        w->in[k] = to;
    status = qdot_watch_value(w, t, w->moved);
    *change = status == QDOT_OK ? fabs(w->moved[i] - g) : 0;
    return status == QDOT_EDOMAIN || status == QDOT_ESINGULAR ? QDOT_OK : status;
}

qdot_status
qdot_watch_noise(qdot_watch *w, double t, const double *y, double by, double least, size_t i,
                 double *noise)
{
    double g;

    *noise = 0;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, w->moved));
    g = w->moved[i];
    for (size_t k = 0; k <= 2 * w->n; k++) {
        double at = k < 2 * w->n ? y[k] : t,
               to = at + by * copysign(fmax(least, fabs(at)), at), change;

        if (k == 2 * w->n)
            to = qdot_watch_time_beside(w, t, to - t);
        if (to == at)
            continue;
        QDOT_TRY(change_by_component(w, k < 2 * w->n ? t : to, y, k, to, i, g, &change));
        *noise += change;
    }
    return QDOT_OK;
}

qdot_status
qdot_watch_operations(qdot_watch *w, double t, bool exact, size_t i, double *noise)
{
    QDOT_TRY(qdot_watch_value(w, t, w->moved)); /* also computes q'' */
    qdot_rounding_bounds(w->tape, w->in, NULL, w->raw, w->work);
    *noise = fmin(w->raw[i], QDOT_WATCH_MOST) * (exact ? qdot_tape_two_rounding(w->two) * 0x1p53 : 1);
    return QDOT_OK;
}

qdot_status
qdot_watch_operations_within(qdot_watch *w, const qdot_watch_part *p, bool exact, size_t i, double *noise)
{
    *noise = 0;
    for (int j = QDOT_WATCH_LEAST_NODES / 2 - 1; j <= QDOT_WATCH_LEAST_NODES / 2; j++) {
        const double t = qdot_watch_time(p, qdot_chebyshev_node(QDOT_WATCH_LEAST_NODES, j));
        double here;

        QDOT_TRY(w->reader.read(t, w->in, w->reader.user));
        QDOT_TRY(qdot_watch_operations(w, t, exact, i, &here));
        *noise = fmax(*noise, here);
    }
    return QDOT_OK;
}

qdot_status
qdot_watch_rounding(qdot_watch *w, double t, const double *y, size_t i, double *noise)
{
    double up, down;

    /* test changes to both sides, because rounding differs on the two sides of a kink */
    QDOT_TRY(qdot_watch_noise(w, t, y, 4 * DBL_EPSILON, 0, i, &up));
    QDOT_TRY(qdot_watch_noise(w, t, y, -4 * DBL_EPSILON, 0, i, &down));
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, w->moved)); /* also computes q'' */
    qdot_tape_eval(w->sizes, w->in, w->raw, w->work);
    *noise = fmax(up, down) + 4 * DBL_EPSILON * fmin(w->raw[i], QDOT_WATCH_MOST);
    qdot_rounding_bounds(w->tape, w->in, NULL, w->raw, w->work);
    if (4 * w->raw[i] > *noise && w->raw[i] < QDOT_WATCH_MOST)
        *noise = 4 * w->raw[i];
    return QDOT_OK;
}

qdot_status
qdot_watch_noise_of(qdot_watch *w, double t, const double *y, const double *by, size_t i, double *noise)
{
    double g;

    *noise = 0;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, w->moved));
    g = w->moved[i];
    for (size_t k = 0; k < 2 * w->n; k++) {
        const double h = 0x1p-20 * fmax(fabs(y[k]), by[k]);
        double change;

        if (by[k] == 0)
            continue;
        QDOT_TRY(change_by_component(w, t, y, k, y[k] + h, i, g, &change));
        *noise += change * (4 * DBL_EPSILON * by[k] / h);
    }
    return QDOT_OK;
}

qdot_status
qdot_watch_noise_of_time(qdot_watch *w, double t, const double *y, size_t i, double *noise)
{
    const double h = 0x1p-20 * t;
    double g;

    *noise = 0;
    if (h == 0)
        return QDOT_OK;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, w->moved));
    g = w->moved[i];
    QDOT_TRY(change_by_component(w, qdot_watch_time_beside(w, t, h), y, 2 * w->n, 0, i, g, noise));
    *noise *= 4 * DBL_EPSILON / 0x1p-20;
    return QDOT_OK;
}

qdot_status
qdot_watch_noise_two(qdot_watch *w, double t, const double *y, size_t i, double *noise)
{
    double by[2 * QDOT_WATCH_NODES], *room = NULL, *change = by;
    qdot_status status;

    if (2 * w->n > sizeof by / sizeof *by && !(change = room = qdot_malloc(2 * w->n * sizeof *room)))
        return QDOT_ENOMEM;
    /* The state is exact where the step starts; positions are as uncertain as velocities since the piece
     * began. */
    for (size_t k = 0; k < 2 * w->n; k++)
        change[k] = fabs(y[k] - w->y[k]);
    for (size_t k = 0; k < w->n && w->largest; k++)
        change[k] = fmax(change[k],
                         fmin(w->largest[k], w->largest[w->n + k] * fabs(t - w->begun)));
    status = qdot_watch_noise_of(w, t, y, change, i, noise);
    qdot_free(room);
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    qdot_tape_eval(w->sizes, w->in, w->moved, w->work);
    *noise += qdot_tape_two_rounding(w->two) * fmin(w->moved[i], QDOT_WATCH_MOST);
    return status;
}

/* --- rounding within an interval ------------------------------------------------------ */

/* The largest |g_i| at the nodes at which the step was sampled first. */
static double
largest_sampled_value(const qdot_watch *w, size_t i)
{
    double largest = 0;

    for (int j = 0; j < QDOT_WATCH_LEAST_NODES; j++)
        largest = fmax(largest, fabs(w->samples[i * QDOT_WATCH_NODES + (size_t)j]));
    return largest;
}

/* The rounding of all g, but those of t alone in two doubles, at time t and the state in w->z, where that is less than noise [m], or this is
 * NaN. Beside rounding of the state there is that of the series, no more than that of g at the end of the step or at
 * the nodes of the part. */
static qdot_status
reduce_noise_estimate(qdot_watch *w, double t, double *noise)
{
    for (size_t i = 0; i < w->m; i++) {
        double here;

        if (!w->live[i] || w->deep[i] || (w->clock[i] && qdot_watch_is_fine(w, i)))
            continue;
        if (qdot_watch_is_fine(w, i)) {
            QDOT_TRY(qdot_watch_noise_two(w, t, w->z, i, &here));
            noise[i] = fmax(noise[i], here);
            continue;
        }
        QDOT_TRY(qdot_watch_rounding(w, t, w->z, i, &here));
        noise[i] = fmin(noise[i],
                        here + 4 * DBL_EPSILON * fmin(fabs(w->final[i]), largest_sampled_value(w, i)));
    }
    return QDOT_OK;
}

/* Where 64 nodes are not enough rounding may be all there is. It is found at the start of the step and
 * both ends of the part: a jump or a pole beside one of them makes it large there. */
qdot_status
qdot_watch_find_noise(qdot_watch *w, const qdot_watch_part *p)
{
    size_t any = 0;
    qdot_status status;

    while (!w->live[any])
        any++;
    if (!isnan(w->noise[any]))
        return QDOT_OK;
    if (isnan(w->first_noise[any])) {
        const bool fine = w->fine;

        memcpy(w->z, w->y, 2 * w->n * sizeof *w->z);
        w->fine = false;
        status = reduce_noise_estimate(w, w->t, w->first_noise);
        w->fine = fine;
        QDOT_TRY(status);
    }
    for (size_t i = 0; i < w->m; i++) {
        w->noise[i] = qdot_watch_is_fine(w, i) || w->deep[i] ? 0 : w->first_noise[i];
        /* the rounding error of a function of t alone does not grow along the step */
        if (w->live[i] && !w->deep[i] && w->clock[i] && qdot_watch_is_fine(w, i))
            QDOT_TRY(qdot_watch_operations_within(w, p, true, i, w->noise + i));
        if (!w->live[i] || !w->deep[i])
            continue;
        QDOT_TRY(qdot_watch_noise_deep(w, p, i, w->noise + i));
        QDOT_TRY(qdot_watch_operations_within(w, p, false, i, w->hidden + i));
    }
    if (p->a != w->t) {
        QDOT_TRY(w->reader.read(p->a, w->z, w->reader.user));
        QDOT_TRY(reduce_noise_estimate(w, p->a, w->noise));
    }
    QDOT_TRY(w->reader.read(p->b, w->z, w->reader.user));
    return reduce_noise_estimate(w, p->b, w->noise);
}
