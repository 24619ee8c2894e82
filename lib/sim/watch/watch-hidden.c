/* watch-hidden.c -- crossings that rounding of the state makes.
 *
 * Bodies that touch and move alike: their distance g is what rounding has left of 0, at both ends of a step and between,
 * and so is the speed dg/dt with which they approach. A zero of g there is no crossing, and is passed over. Such bodies
 * touch from the start of a piece until g is more than that. On the side where they would be within each other they are
 * pushed together, however faint the force that does it was at first: a root at the start of that step says so. Where two
 * doubles show that they have been apart before, by less than rounding, they bounce there by an unknown height: the root is
 * where they are farthest apart, and the error of the run is unknown.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "sim/watch/watch-parts.h"
#include "sim/watch/watch.h"

void
qdot_watch_may_hide(qdot_watch *w, size_t i, bool may, int way, bool beside)
{
    w->beside[i] = beside;
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

/* So many times its rounding is what g of a method in doubles may have gathered of it over many steps. */
static const double gathered = 0x1p10;

/* Bodies that were apart by more than this part of their places before they were pushed together bounce: by
 * sqrt(2 a 1e-26) at an acceleration a, which is rounding. */
static const double least_apart = 0x1p-86;

/* The value of g_i at time t within the step; in two doubles, if `fine`, and then not less its offset. */
static qdot_status
value_within_step(qdot_watch *w, double t, size_t i, bool fine, double *g)
{
    w->fine = w->wants[i] = fine;
    QDOT_TRY(qdot_watch_value_at(w, t, w->g));
    w->fine = w->wants[i] = false;
    *g = w->g[i];
    return QDOT_OK;
}

/* Whether the bodies of g_i touch at the start of the step and move alike: found out where a piece begins, and so from then on
 * until they have been seen apart. Two doubles tell a low bounce from that, unless other contacts have taken part of the
 * velocities. */
static qdot_status
touch_at_start(qdot_watch *w, size_t i, bool fine, double *room, bool *is)
{
    *is = w->start.joined[i];
    if (w->t != w->begun)
        return QDOT_OK;
    w->start.apart[i] = 0;
    w->gap[i] = fmax(0, -w->start.g0[i] * w->meets[i]);
    memcpy(room, w->y, 2 * w->n * sizeof *room);
    return is_rounding_at(w, w->t, room, i, fine && !w->beside[i] ? 1 : gathered, room + 2 * w->n, room + 4 * w->n, is);
}

/* What 4 roundings of the largest places so far make of g_i, the larger of that at both ends of the step. */
static qdot_status
noise_of_step(qdot_watch *w, size_t i, double *sizes, double *noise)
{
    double end;

    for (size_t k = 0; k < w->n; k++) /* a rounding of t changes places by the velocity times it */
        sizes[k] = fmax(w->largest[k], fabs(w->end[2 * w->n]) * w->largest[w->n + k]);
    memcpy(sizes + w->n, w->largest + w->n, w->n * sizeof *sizes);
    QDOT_TRY(qdot_watch_noise_of(w, w->t, w->y, sizes, i, noise));
    QDOT_TRY(qdot_watch_noise_of(w, w->end[2 * w->n], w->end, sizes, i, &end));
    *noise = fmax(*noise, end);
    return QDOT_OK;
}

/* How bodies that touch at the start of the step leave what rounding may make of g_i. */
typedef struct {
    int side;       /* -1 apart, 1 into each other, 0 not in this step */
    double nearest; /* the time in the step at which they are apart farthest: from there on they are pushed together */
    double least;   /* g_i times the sign behind a crossing, there */
} leaving;

enum { PLACES = 16 };

static double
place_in_step(const qdot_watch *w, double k)
{
    return k >= PLACES ? w->end[2 * w->n] : w->t + (w->end[2 * w->n] - w->t) * k / PLACES;
}

static qdot_status
find_leaving(qdot_watch *w, size_t i, bool fine, double noise, leaving *l)
{
    int farthest = 0;

    *l = (leaving){0, w->t, -w->gap[i]};
    for (int k = 1; k <= PLACES && l->side == 0; k++) {
        double g;

        QDOT_TRY(value_within_step(w, place_in_step(w, k), i, fine, &g));
        g *= w->meets[i];
        if (fabs(g) > noise)
            l->side = g > 0 ? 1 : -1;
        else if (g < l->least) {
            l->least = g;
            farthest = k;
        }
    }
    w->now.apart[i] = fmax(w->start.apart[i], -l->least - w->gap[i]);
    if (l->side <= 0)
        return QDOT_OK;
    for (double lo = fmax(farthest - 1, 0), hi = farthest + 1; hi - lo > 0x1p-20 && fine;) {
        const double third = (hi - lo) / 3;
        double a, b;

        QDOT_TRY(value_within_step(w, place_in_step(w, lo + third), i, fine, &a));
        QDOT_TRY(value_within_step(w, place_in_step(w, hi - third), i, fine, &b));
        if (w->meets[i] * a < w->meets[i] * b)
            hi -= third;
        else
            lo += third;
        l->nearest = place_in_step(w, hi);
        l->least = fmin(l->least, w->meets[i] * a);
    }
    return QDOT_OK;
}

static qdot_status
claim_function(qdot_watch *w, size_t i, double *room)
{
    const bool fine = qdot_watch_can_two(w, i);
    const double times = fine ? 1 : gathered;
    leaving how;
    double noise;
    bool joined, bounces;

    QDOT_TRY(touch_at_start(w, i, fine, room, &joined));
    w->now.joined[i] = false;
    if (!joined)
        return QDOT_OK;
    QDOT_TRY(noise_of_step(w, i, room, &noise));
    QDOT_TRY(find_leaving(w, i, fine, times * noise, &how));
    w->now.joined[i] = how.side == 0;
    if (how.side == 0 && fine)
        w->hides[i] = true;
    if (how.side < 0 || (how.side == 0 && !fine))
        return QDOT_OK;
    w->live[i] = false;
    if (how.side == 0)
        return QDOT_OK;
    w->now.apart[i] = fmax(w->now.apart[i], -how.least - w->gap[i]);
    bounces = fine && w->now.apart[i] > noise / (4 * DBL_EPSILON) * least_apart;
    return qdot_vec_push(&w->roots, ((qdot_root){.function = i,
                                                 .t = bounces ? how.nearest : w->t,
                                                 .way = w->meets[i],
                                                 .residual = fabs(w->start.g0[i]),
                                                 .several = bounces,
                                                 .rests = true,
                                                 .exact = true}));
}

qdot_status
qdot_watch_claim_hidden(qdot_watch *w)
{
    double *room = NULL;
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < w->m && status == QDOT_OK; i++) {
        if (!w->may_hide[i] || !w->largest || (w->t != w->begun && !w->start.joined[i]))
            continue;
        if (!room)
            room = qdot_malloc((6 * w->n + 1) * sizeof *room);
        status = room ? claim_function(w, i, room) : QDOT_ENOMEM;
        if (status == QDOT_EDOMAIN || status == QDOT_ESINGULAR)
            status = QDOT_OK;
    }
    qdot_free(room);
    return status;
}

/* Whether a root of g_i has been found in the step. */
static bool
has_root(const qdot_watch *w, size_t i)
{
    for (size_t k = 0; k < w->roots.n; k++)
        if (w->roots.at[k].function == i)
            return true;
    return false;
}

qdot_status
qdot_watch_doubt_missed(qdot_watch *w)
{
    const double t_end = w->end[2 * w->n];

    for (size_t i = 0; i < w->m; i++) {
        double noise;

        if (!w->may_hide[i] || !w->largest || !w->live[i] || w->start.sign[i] != -w->meets[i]
            || qdot_watch_sign(w->final[i]) != w->meets[i] || has_root(w, i))
            continue;
        QDOT_TRY(qdot_watch_noise_of(w, t_end, w->end, w->largest, i, &noise));
        if (fabs(w->final[i]) > noise)
            QDOT_TRY(qdot_vec_push(&w->roots, ((qdot_root){.function = i, .t = w->t, .blur = fabs(t_end - w->t)})));
    }
    return QDOT_OK;
}
