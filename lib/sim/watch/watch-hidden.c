/* watch-hidden.c -- crossings that rounding of the state makes.
 *
 * Bodies that touch and move alike: their distance g is what rounding has left of 0, at both ends of a step and between,
 * and so is the speed dg/dt with which they approach. A zero of g there is no crossing, and is passed over. Where g is
 * more than that from some step on, and to the side where the bodies would be within each other, they are pushed together
 * there: a root at the start of that step says so.
 */
#include <math.h>
#include <string.h>

#include "sim/watch/watch-parts.h"
#include "sim/watch/watch.h"

void
qdot_watch_may_hide(qdot_watch *w, size_t i, bool may, int way)
{
    w->may_hide[i] = may && !w->accelerations;
    w->meets[i] = way;
}

/* Whether |g_i| and |dg_i/dt| at the state y [2n] are at most `times` what rounding of the largest places and velocities so
 * far makes of them. sizes [2n], rates [2n] are scratch. */
static qdot_status
is_rounding_at(qdot_watch *w, double t, const double *y, size_t i, double times, double *sizes, double *rates, bool *is)
{
    const size_t n = w->n;
    const bool blurred = w->now.blurred[i];
    double g, noise, rate;
    qdot_status status;

    for (size_t k = 0; k < n; k++) /* a rounding of t changes places by the velocity times it */
        sizes[k] = fmax(w->largest[k], fabs(t) * w->largest[n + k]);
    memcpy(sizes + n, w->largest + n, n * sizeof *sizes);
    memcpy(w->in, y, 2 * n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, w->raw));
    g = w->raw[i];
    QDOT_TRY(qdot_watch_noise_of(w, t, y, sizes, i, &noise));
    *is = fabs(g) <= times * noise;
    if (!*is)
        return QDOT_OK;
    QDOT_TRY(w->reader.system->rhs(t, y, rates, w->reader.system->user));
    memcpy(sizes, w->largest + n, n * sizeof *sizes);
    for (size_t k = n; k < 2 * n; k++)
        sizes[k] = fabs(rates[k]);
    w->now.blurred[i] = false; /* differences of values in doubles would be rounding */
    status = qdot_watch_rate(w, t, y, NULL, rates, sizes, i, &rate, &noise);
    w->now.blurred[i] = blurred;
    *is = fabs(rate) <= times * noise;
    return status;
}

/* The same at places of the whole step. */
static qdot_status
is_rounding_throughout(qdot_watch *w, size_t i, bool *is)
{
    enum { PLACES = 4 };
    double *y = qdot_malloc((6 * w->n + 1) * sizeof *y);
    const double t_end = w->end[2 * w->n];
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    *is = true;
    for (int k = 0; k <= PLACES && *is && status == QDOT_OK; k++) {
        const double t = k == PLACES ? t_end : w->t + (t_end - w->t) * k / PLACES;

        if (k == 0)
            memcpy(y, w->y, 2 * w->n * sizeof *y);
        else
            status = w->reader.read(t, y, w->reader.user);
        if (status == QDOT_OK)
            status = is_rounding_at(w, t, y, i, 1, y + 2 * w->n, y + 4 * w->n, is);
    }
    if (status == QDOT_EDOMAIN || status == QDOT_ESINGULAR) {
        *is = false;
        status = QDOT_OK;
    }
    qdot_free(y);
    return status;
}

qdot_status
qdot_watch_is_hidden(qdot_watch *w, size_t i, bool *hidden)
{
    const bool fine = w->fine, steady = w->steady;
    bool *wants;
    qdot_status status;

    *hidden = false;
    if (!w->may_hide[i] || !w->largest)
        return QDOT_OK;
    if (w->hides[i] == QDOT_WATCH_UNKNOWN) {
        wants = qdot_malloc((w->m + 1) * sizeof *wants);
        if (!wants)
            return QDOT_ENOMEM;
        memcpy(wants, w->wants, w->m * sizeof *wants);
        w->fine = false;
        status = is_rounding_throughout(w, i, hidden);
        memcpy(w->wants, wants, w->m * sizeof *wants);
        w->fine = fine;
        w->steady = steady;
        qdot_free(wants);
        QDOT_TRY(status);
        w->hides[i] = *hidden;
    }
    *hidden = w->hides[i] == true;
    return QDOT_OK;
}

qdot_status
qdot_watch_drop_hidden(qdot_watch *w, bool *any)
{
    *any = false;
    for (size_t i = 0; i < w->m; i++) {
        bool hidden = false;

        if (w->live[i])
            QDOT_TRY(qdot_watch_is_hidden(w, i, &hidden));
        w->live[i] = w->live[i] && !hidden;
        *any = *any || w->live[i];
    }
    return QDOT_OK;
}

/* A function that leaves its rounding is at most this part of its largest value, or of that at the end of the step: one of
 * more is not looked at. */
static const double little = 0x1p-10;

/* So many times its rounding is what g may have gathered of it over many steps. */
static const double gathered = 0x1p10;

/* Whether rounding is all of g_i at the start of the step, but no longer at its end, where it has the sign behind a
 * crossing. In the first step of a piece too: rounding may have left the bodies within each other by the blow before it. */
static qdot_status
is_pushed(qdot_watch *w, size_t i, bool *is)
{
    const double g = w->start.g0[i], t_end = w->end[2 * w->n];
    const int sign = qdot_watch_sign(w->final[i]);
    double *room;
    bool stays = false;
    qdot_status status;

    *is = false;
    if (!w->may_hide[i] || !w->largest || sign != w->meets[i] || qdot_watch_sign(g) == -sign
        || fabs(g) > little * fmax(w->most[i], fabs(w->final[i])))
        return QDOT_OK;
    room = qdot_malloc((6 * w->n + 1) * sizeof *room);
    if (!room)
        return QDOT_ENOMEM;
    memcpy(room, w->y, 2 * w->n * sizeof *room);
    status = is_rounding_at(w, w->t, room, i, gathered, room + 2 * w->n, room + 4 * w->n, is);
    memcpy(room, w->end, 2 * w->n * sizeof *room);
    if (status == QDOT_OK && *is)
        status = is_rounding_at(w, t_end, room, i, gathered, room + 2 * w->n, room + 4 * w->n, &stays);
    *is = *is && !stays;
    qdot_free(room);
    return status;
}

qdot_status
qdot_watch_claim_hidden(qdot_watch *w)
{
    for (size_t i = 0; i < w->m; i++) {
        bool is;

        QDOT_TRY(is_pushed(w, i, &is));
        if (is)
            QDOT_TRY(qdot_watch_push(w, (qdot_root){.function = i,
                                                    .t = w->t,
                                                    .way = w->meets[i],
                                                    .residual = fabs(w->start.g0[i]),
                                                    .rests = true,
                                                    .exact = true}));
    }
    return QDOT_OK;
}
