/* piece-contact.c -- contacts that last: where one begins, and whether a change of the state leaves
 * it. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "sim/model/contact.h"
#include "sim/course/piece.h"

/* Two velocities count as equal up to this. */
static const double alike = 1e-9;
/* The operations of `then` may round it by so many times the rounding of velocities. */
static const double roundings = 32;
/* The speed of a trial impact. */
static const double trial = 1e-3;
/* What a contact may leave out: the height of the bounces to come, beside the place. Lower ones are lost in its
 * rounding. */
static const double least_height = DBL_EPSILON / 8;
/* Four times the height of a flight whose apex is told from the place. */
static const double apart = 64 * DBL_EPSILON;
/* A speed above this is none of rest. */
static const double fastest = 1e-4;

/* --- whether the event is an impact on a smooth wall ---------------------------------- */

/* The direction M^-1 du/dq [n] times the reaction at the start: q'' of the mode less that without
 * the contact, `free`; *size its length. */
static qdot_status
direction(qdot_piece *x, size_t mode, size_t free, double *d, double *size)
{
    const size_t n = x->n / 2;
    double *rates = qdot_malloc(2 * x->n * sizeof *rates);
    qdot_status status = rates ? QDOT_OK : QDOT_ENOMEM;

    *size = 0;
    if (status == QDOT_OK)
        status = qdot_piece_rates(x, mode, rates);
    if (status == QDOT_OK)
        status = qdot_piece_rates(x, free, rates + x->n);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        d[i] = rates[n + i] - rates[x->n + n + i];
        *size = hypot(*size, d[i]);
    }
    qdot_free(rates);
    return status;
}

/* Whether `then` at the start with its velocities less `speed` d/|d| gives them back, turned about by
 * 0 ... 1 times that speed, and leaves the place where it is. */
static qdot_status
is_impact(qdot_piece *x, const qdot_staged_event *e, const double *d, double size, double speed,
          bool *yes)
{
    const size_t n = x->n / 2;
    double *old = qdot_malloc(2 * x->n * sizeof *old), *y = old + x->n, back = 0, aside = 0;
    double scale = 1;
    bool stays = true;
    qdot_status status = old ? QDOT_OK : QDOT_ENOMEM;

    *yes = false;
    if (status == QDOT_OK) {
        memcpy(old, x->start.y, x->n * sizeof *old);
        for (size_t i = 0; i < n; i++)
            old[n + i] -= speed * d[i] / size;
        memcpy(y, old, x->n * sizeof *y);
        status = qdot_piece_change(x, e, x->start.t, old, NULL, y, NULL);
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        back += (y[n + i] - old[n + i]) * d[i] / size;
        scale = fmax(scale, fabs(old[n + i]));
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        aside = fmax(aside, fabs(y[n + i] - old[n + i] - back * d[i] / size));
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        stays = stays && fabs(y[i] - old[i]) <= roundings * DBL_EPSILON * fmax(fabs(old[i]), x->largest[i]);
    *yes = stays && status == QDOT_OK && aside <= alike * speed + roundings * DBL_EPSILON * scale
           && back >= speed * (1 - 1e-6) - alike * scale
           && back <= 2 * speed * (1 + 1e-6) + alike * scale;
    qdot_free(old);
    return qdot_grave(status);
}

static qdot_status
is_smooth_wall(qdot_piece *x, size_t event, size_t mode, size_t free, bool *yes)
{
    const qdot_staged_event *e = &x->c->stage->events.at[event];
    double *d = qdot_malloc((x->n + 1) * sizeof *d), size;
    qdot_status status = d ? direction(x, mode, free, d, &size) : QDOT_ENOMEM;

    *yes = status == QDOT_OK && size > 0 && isfinite(size);
    if (*yes)
        status = is_impact(x, e, d, size, 0, yes);
    if (status == QDOT_OK && *yes)
        status = is_impact(x, e, d, size, trial, yes);
    qdot_free(d);
    return qdot_grave(status);
}

/* How large the terms of u have been: what u is changed by if each component of q is by its largest size so far. */
static qdot_status
size_of_place(qdot_piece *x, size_t surface, double *size)
{
    double *slopes = qdot_malloc((x->n + 1) * sizeof *slopes), u;
    const size_t free = x->mode;
    qdot_status status = slopes ? qdot_piece_enter(x) : QDOT_ENOMEM; /* the mode of the contact */

    *size = 0;
    if (status == QDOT_OK)
        status = qdot_sliding_rows_value(&qdot_piece_mode(x)->held, x->n / 2, x->start.t,
                                         x->start.y, surface, 0, &u, slopes);
    for (size_t i = 0; i < x->n / 2 && status == QDOT_OK; i++)
        *size += fabs(slopes[i]) * x->largest[i];
    x->mode = free;
    qdot_free(slopes);
    return status;
}

/* --- where one begins ----------------------------------------------------------------- */

/* The start moves along d [n], M^-1 du/dq times a number, until the row of that order of the surface is kept: an
 * impulse of the contact, so that what other forces conserve stays. *moved at least its largest change, relative
 * to max(1, |component|). */
static qdot_status
move_onto(qdot_piece *x, size_t surface, int order, const double *d, double *moved)
{
    const size_t n = x->n / 2;
    double *slopes = qdot_malloc((n + 1) * sizeof *slopes), *y = x->start.y + (size_t)order * n, value, rise = 0;
    qdot_status status = slopes ? qdot_sliding_rows_value(&qdot_piece_mode(x)->held, n, x->start.t, x->start.y,
                                                          surface, order, &value, slopes)
                                : QDOT_ENOMEM;

    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        rise += slopes[i] * d[i];
    for (size_t i = 0; i < n && status == QDOT_OK && rise != 0; i++) {
        const double by = value / rise * d[i];

        *moved = fmax(*moved, fabs(by) / fmax(1, fabs(y[i])));
        y[i] -= by;
    }
    qdot_free(slopes);
    return status;
}

/* Enter the contact at the start of the piece; *moved by how much that is off it. */
static qdot_status
enter(qdot_piece *x, size_t surface, double *moved, bool *can)
{
    const size_t free = x->mode, n = x->n;
    double *kept = qdot_malloc((2 * n + 1) * sizeof *kept), *d = kept + n, size = 0, rest = 0;
    qdot_status status = kept ? QDOT_OK : QDOT_ENOMEM;

    *can = false;
    if (!kept)
        return status;
    memcpy(kept, x->start.y, n * sizeof *kept);
    x->side[surface] = QDOT_SIDE_SLIDES;
    *moved = 0;
    status = qdot_piece_enter(x);
    if (status == QDOT_OK)
        status = direction(x, x->mode, free, d, &size);
    for (int order = 0; order < 2 && status == QDOT_OK && size > 0 && isfinite(size); order++)
        status = move_onto(x, surface, order, d, moved);
    if (status == QDOT_OK)
        status = qdot_sliding_rows_keep(&qdot_piece_mode(x)->held, n / 2, x->start.t, x->start.y, &rest);
    *moved = fmax(*moved, rest);
    if (status == QDOT_OK && isfinite(*moved))
        status = is_smooth_wall(x, x->c->stage->switches.surfaces.at[surface].event, x->mode, free,
                                can);
    if (status != QDOT_OK || !*can) {
        memcpy(x->start.y, kept, n * sizeof *kept);
        x->side[surface] = 0;
    }
    x->mode = free;
    qdot_free(kept);
    return qdot_grave(status);
}

/* That of the bounces to come on an event, beside the place. Where something switches between one and the next, as at an
 * apex, a piece starts there, which must see that it is off the wall: so the flights before were higher than this. */
static double
lowest(const qdot_piece *x, size_t event)
{
    const qdot_piece_repeat *own = NULL;

    for (size_t i = 0; i < x->repeats.n; i++)
        if (x->repeats.at[i].kind == QDOT_WATCH_EVENT && x->repeats.at[i].index == event)
            own = &x->repeats.at[i];
    for (size_t i = 0; i < x->repeats.n && own && own->ratio < 1; i++)
        if (x->repeats.at[i].kind == QDOT_WATCH_SURFACE && fabs(own->last - x->repeats.at[i].last) < own->interval)
            return apart / (1 - own->ratio);
    return least_height;
}

qdot_status
qdot_piece_rest(qdot_piece *x, size_t event, int way, double left, bool *lasts, bool *soon)
{
    const size_t surface = qdot_contacts_surface(&x->c->stage->switches, event, way);
    double *kept, moved = 0, noise = 0, height;
    qdot_status status;

    *lasts = *soon = false;
    if (surface == SIZE_MAX || x->side[surface] == QDOT_SIDE_SLIDES)
        return QDOT_OK;
    kept = qdot_malloc((x->n + 1) * sizeof *kept);
    if (!kept)
        return QDOT_ENOMEM;
    memcpy(kept, x->start.y, x->n * sizeof *kept);
    status = enter(x, surface, &moved, lasts);
    if (status == QDOT_OK && *lasts)
        status = size_of_place(x, surface, &noise);
    height = moved * left;
    if (status == QDOT_OK && *lasts
        && (moved > fastest || height > lowest(x, event) * noise)) {
        *lasts = false;
        *soon = moved <= fastest || left > 0;
        x->side[surface] = 0;
        memcpy(x->start.y, kept, x->n * sizeof *kept);
    }
    qdot_free(kept);
    return status;
}

/* --- where a run starts ---------------------------------------------------------------- */

/* Whether an event sets velocities, and nothing else. */
static bool
sets_velocities(const qdot_piece *x, const qdot_staged_event *e)
{
    bool only = e->then && !e->stop;

    for (size_t k = 0; k < e->changes; k++)
        only &= e->targets[k] >= x->n / 2;
    return only;
}

qdot_status
qdot_piece_meets_at_start(qdot_piece *x, size_t i, bool *meets)
{
    const qdot_staged_event *e = &x->c->stage->events.at[i];
    const int first = qdot_watch_first(qdot_piece_watch(x))[i];
    double *old;
    int way, behind = 0;
    qdot_status status;

    *meets = false;
    if (e->way == 0 || !x->functions_on[i] || first != (int)x->direction * e->way || !sets_velocities(x, e))
        return QDOT_OK;
    QDOT_TRY(qdot_piece_way(x, i, &way));
    if (way != first)
        return QDOT_OK;
    old = qdot_malloc(x->n * sizeof *old);
    if (!old)
        return QDOT_ENOMEM;
    memcpy(old, x->start.y, x->n * sizeof *old);
    status = qdot_piece_change(x, e, x->start.t, old, NULL, x->start.y, NULL);
    if (status == QDOT_OK)
        status = qdot_piece_way(x, i, &behind);
    *meets = status == QDOT_OK && behind != first;
    memcpy(x->start.y, old, x->n * sizeof *old);
    qdot_free(old);
    return qdot_grave(status);
}

bool
qdot_piece_meets_again(const qdot_piece *x, size_t i)
{
    const qdot_staged_event *e = &x->c->stage->events.at[i];
    const int way = (int)x->direction * e->way;

    return e->then && way != 0 && x->functions_on[i] && x->touching[i] && x->left[i] == -way
           && qdot_watch_first(qdot_piece_watch(x))[i] == way && x->signs[i] != -way && !qdot_piece_just_noted(x, i);
}

/* --- after a change ------------------------------------------------------------------- */

/* The contacts that a new state leaves end; c->reason if it is pushed into one. */
qdot_status
qdot_piece_keep_contacts(qdot_piece *x)
{
    const qdot_switches *s = &x->c->stage->switches;
    const qdot_sliding_rows *held = &qdot_piece_mode(x)->held;

    for (size_t i = qdot_switches_own(s); i < s->surfaces.n; i++) {
        double place, rate;

        if (x->side[i] != QDOT_SIDE_SLIDES || qdot_piece_mode(x)->side[i] != QDOT_SIDE_SLIDES)
            continue;
        QDOT_TRY(
            qdot_sliding_rows_value(held, x->n / 2, x->start.t, x->start.y, i, 0, &place, NULL));
        QDOT_TRY(
            qdot_sliding_rows_value(held, x->n / 2, x->start.t, x->start.y, i, 1, &rate, NULL));
        place *= s->surfaces.at[i].reaction;
        rate *= s->surfaces.at[i].reaction;
        if (fabs(place) <= alike && fabs(rate) <= alike)
            continue;
        x->side[i] = 0;
        if (place > alike || (fabs(place) <= alike && rate > 0))
            continue;
        snprintf(x->c->reason, sizeof x->c->reason,
                 "stopped at t = %.15g: an event pushes the motion into the contact at %.100s, and "
                 "nothing says what comes of it",
                 x->start.t, x->c->stage->events.at[s->surfaces.at[i].event].name);
    }
    return QDOT_OK;
}
