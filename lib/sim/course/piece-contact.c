/* piece-contact.c -- contacts that last: where one begins, and whether a change of the state leaves
 * it. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "ode/scale.h"
#include "sim/course/piece.h"
#include "sim/model/contact.h"

/* Two velocities count as equal up to this. */
static const double alike = 1e-9;
/* The operations of `then` may round it by so many times the rounding of velocities. */
static const double roundings = 32;
/* The speed of a trial impact. */
static const double trial = 1e-3;
/* A contact may begin where the bounces to come are no higher than this part of the place: its rounding hides them. */
static const double least_height = DBL_EPSILON / 8;
/* The same of a place that moves with time: where it is at a root, rounding of that hides. */
static const double least_moving = 0x1p10 * DBL_EPSILON;
/* The same for methods without series, from which a state within a step is known only to that part of its size. The
 * search of a step tells heights above a sixth of that from rounding. */
static const double least_in_doubles = 0x1p16 * DBL_EPSILON;
/* A multistep method begins anew behind each bounce, with short steps of low order: its own error there hides heights
 * below so many times its tolerance. */
static const double multistep_tolerances = 64;
/* A companion is to rest where the run does: it may leave out bounces so many times as high as the run has. */
static const double led = 16;
/* Four times the least height, beside the place, at which the top of a flight is seen to be off the wall. */
static const double apart = 64 * DBL_EPSILON;
/* The motion does not rest where entering the contact would change a component by more than this part of it. */
static const double fastest = 1e-4;
/* A bounce is not low if it begins with more than this part of the largest speed so far. */
static const double slow = 1e-2;

/* --- how fast the motion leaves a surface ---------------------------------------------- */

qdot_status
qdot_piece_rate(qdot_piece *x, size_t i, double *rate, double *noise)
{
    const size_t n = x->n / 2;
    double *rates = qdot_malloc((3 * x->n + 1) * sizeof *rates), *fast = rates + x->n,
           *low = fast + x->n;
    qdot_status status = rates ? qdot_piece_rates(x, x->mode, rates) : QDOT_ENOMEM;

    *rate = *noise = 0;
    if (status == QDOT_OK) {
        qdot_piece_low(x, low);
        memcpy(fast, x->largest + n, n * sizeof *fast);
        for (size_t k = n; k < x->n; k++)
            fast[k] = fabs(rates[k]);
        status = qdot_watch_rate(qdot_piece_watch(x), x->start.t, x->start.y, low, rates, fast, i,
                                 rate, noise);
    }
    qdot_free(rates);
    return status;
}

qdot_status
qdot_piece_way(qdot_piece *x, size_t i, int *way)
{
    double rate, noise;

    *way = 0;
    QDOT_TRY(qdot_piece_rate(x, i, &rate, &noise));
    if (fabs(rate) > noise)
        *way = rate * x->direction > 0 ? 1 : -1;
    return QDOT_OK;
}

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
 * 0 ... 1 times that speed, its *share, and leaves the place where it is. */
static qdot_status
is_impact(qdot_piece *x, const qdot_staged_event *e, const double *d, double size, double speed,
          double *share, bool *yes)
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
    *share = speed > 0 ? back / speed - 1 : 0;
    qdot_free(old);
    return qdot_grave(status);
}

static qdot_status
is_smooth_wall(qdot_piece *x, size_t event, size_t mode, size_t free, double *share, bool *yes)
{
    const qdot_staged_event *e = &x->c->stage->events.at[event];
    double *d = qdot_malloc((x->n + 1) * sizeof *d), size;
    qdot_status status = d ? direction(x, mode, free, d, &size) : QDOT_ENOMEM;

    *yes = status == QDOT_OK && size > 0 && isfinite(size);
    if (*yes)
        status = is_impact(x, e, d, size, 0, share, yes);
    if (status == QDOT_OK && *yes)
        status = is_impact(x, e, d, size, trial, share, yes);
    qdot_free(d);
    return qdot_grave(status);
}

/* --- where one begins ----------------------------------------------------------------- */

/* The bounces that are left out where a contact begins, and how the start is moved onto it. */
typedef struct {
    double off[2]; /* u, u' of the start before that */
    double pull;   /* u'' without the contact, against u' */
    double share;  /* the part of |u'| that an impact leaves */
    double size;   /* of the terms of u */
    double moved;  /* by how much the start changes, relative to max(1, |component|) */
    double *along; /* [n] M^-1 du/dq of u = 1, then the slopes of u [n] */
} skipped;

/* How large the terms of u have been: what u is changed by if each component of q is by its largest size so far. */
static double
size_of_place(const qdot_piece *x, const skipped *s)
{
    const size_t n = x->n / 2;
    double size = 0;

    for (size_t i = 0; i < n; i++)
        size += fabs(s->along[n + i]) * x->largest[i];
    return size;
}

/* How high the next flight is; how long it and all that follow take: flights of 2 |u'|/pull, each shorter by `share`. */
static double
height(const skipped *s)
{
    return fabs(s->off[0]) + (s->off[1] != 0 ? s->off[1] * s->off[1] / (2 * s->pull) : 0);
}

static double
duration(const skipped *s)
{
    return s->off[1] != 0 ? 2 * fabs(s->off[1]) / (s->pull * fmax(0, 1 - s->share)) : 0;
}

/* The start moves along s->along until the row of that order of the surface is kept: an impulse of the contact, so that
 * what other forces conserve stays. */
static qdot_status
move_onto(qdot_piece *x, size_t surface, int order, skipped *s)
{
    const size_t n = x->n / 2;
    double *slopes = s->along + n, *y = x->start.y + (size_t)order * n;

    QDOT_TRY(qdot_sliding_rows_value(&qdot_piece_mode(x)->held, n, x->start.t, x->start.y, surface, order,
                                     &s->off[order], slopes));
    for (size_t i = 0; i < n && isfinite(s->pull); i++) {
        const double by = s->off[order] * s->along[i];

        s->moved = fmax(s->moved, fabs(by) / fmax(1, fabs(y[i])));
        y[i] -= by;
    }
    return QDOT_OK;
}

/* Fill s->along and s->pull by d [n], q'' of the contact less that without. */
static qdot_status
find_pull(qdot_piece *x, size_t surface, const double *d, skipped *s)
{
    const size_t n = x->n / 2;
    double value, rise = 0;

    QDOT_TRY(qdot_sliding_rows_value(&qdot_piece_mode(x)->held, n, x->start.t, x->start.y, surface, 1, &value,
                                     s->along + n));
    for (size_t i = 0; i < n; i++) {
        rise += s->along[n + i] * d[i];
        s->size += fabs(s->along[n + i] * x->start.y[i]);
    }
    for (size_t i = 0; i < n; i++)
        s->along[i] = d[i] / rise;
    s->pull = rise != 0 ? fabs(rise) : INFINITY;
    return QDOT_OK;
}

/* Enter the contact, in x->side and x->start.y; what that leaves out. */
static qdot_status
enter(qdot_piece *x, size_t surface, skipped *s, bool *can)
{
    const size_t free = x->mode;
    double *d = qdot_malloc((x->n + 1) * sizeof *d), size = 0, rest = 0;
    qdot_status status;

    *can = false;
    if (!d)
        return QDOT_ENOMEM;
    x->side[surface] = QDOT_SIDE_SLIDES;
    status = qdot_piece_enter(x);
    if (status == QDOT_OK)
        status = direction(x, x->mode, free, d, &size);
    if (status == QDOT_OK && size > 0 && isfinite(size))
        status = find_pull(x, surface, d, s);
    for (int order = 0; order < 2 && status == QDOT_OK && s->pull > 0; order++)
        status = move_onto(x, surface, order, s);
    if (status == QDOT_OK)
        status = qdot_sliding_rows_keep(&qdot_piece_mode(x)->held, x->n / 2, x->start.t, x->start.y, &rest);
    s->moved = fmax(s->moved, rest);
    if (status == QDOT_OK && isfinite(s->moved))
        status = is_smooth_wall(x, x->c->stage->switches.surfaces.at[surface].event, x->mode, free, &s->share,
                                can);
    x->mode = free;
    qdot_free(d);
    return qdot_grave(status);
}

/* The height of bounces that a contact may leave out, beside the place. Where something switches between two of them, as
 * at the top of a flight, a piece starts there, which must see that it is off the wall: so the flights before were higher
 * than this. */
static double
lowest(const qdot_piece *x, size_t surface)
{
    const qdot_piece_repeat *own =
        qdot_piece_repeat_of(x, QDOT_WATCH_EVENT, x->c->stage->switches.surfaces.at[surface].event);

    for (size_t i = 0; i < x->repeats.n && own && own->ratio < 1; i++)
        if (x->repeats.at[i].kind == QDOT_WATCH_SURFACE && fabs(own->last - x->repeats.at[i].last) < own->interval)
            return apart / (1 - own->ratio);
    return qdot_contacts_moves(&x->c->stage->switches, surface) ? least_moving : least_height;
}

/* The height of the highest bounces that the run, which this companion accompanies, has left out there. */
static double
skipped_in_run(const qdot_piece *x, size_t surface)
{
    double most = 0;

    for (size_t k = 0; k < x->c->leader->chatters.n; k++)
        if (x->c->leader->chatters.at[k].surface == surface && !x->c->leader->chatters.at[k].steady)
            most = fmax(most, x->c->leader->chatters.at[k].place);
    return most;
}

/* The height below which a method without series does not tell a bounce from its own error. */
static double
least_told(const qdot_piece *x, const skipped *s)
{
    const size_t n = x->n / 2;
    double size = 0;

    for (size_t i = 0; i < n && x->method->multistep; i++)
        size += fabs(s->along[n + i]) * qdot_ode_size(x->c->stage->scales, i, x->start.y[i]);
    return least_in_doubles * s->size + multistep_tolerances * x->options->tol * size;
}

/* Whether the bounces to come, within the time `left`, may be left out: where the place hides them; for a companion,
 * where the run has left out such ones; for a method without series, where it does not tell the next one from rounding. */
static bool
may_rest(const qdot_piece *x, size_t surface, double left, const skipped *s)
{
    const bool by_points = !x->reader.read_two && !x->c->leader;
    const double place = size_of_place(x, s);

    if (s->moved <= fastest
        && (by_points && left == 0 ? height(s) <= least_height * place /* the motion does not leave it */
                                   : isfinite(left) && s->moved * left <= lowest(x, surface) * place))
        return true;
    return (x->c->leader || by_points) && isfinite(duration(s))
           && height(s) <= (by_points ? least_told(x, s) : led * skipped_in_run(x, surface));
}

static qdot_status
note_error(qdot_piece *x, qdot_course_chatter chatter, const skipped *s)
{
    chatter.along = qdot_malloc((x->n + 1) * sizeof *chatter.along);
    if (!chatter.along)
        return QDOT_ENOMEM;
    memcpy(chatter.along, s->along, x->n * sizeof *s->along);
    if (qdot_vec_push(&x->c->chatters, chatter) == QDOT_OK)
        return QDOT_OK;
    qdot_free(chatter.along);
    return QDOT_ENOMEM;
}

/* What rests on a place that moves is where that is at a rounding of t before or later, in all companions alike; this
 * counts as an error until the run ends, for it goes on when the contact is left. */
static qdot_status
note_rounding(qdot_piece *x, size_t surface, const skipped *s)
{
    const size_t n = x->n / 2;
    const double by = DBL_EPSILON * fmax(fabs(x->start.t), fabs(x->t1));
    double *rates = qdot_malloc((x->n + 1) * sizeof *rates), speed = 0, pull = fabs(s->pull);
    qdot_status status = rates ? qdot_piece_rates(x, x->mode, rates) : QDOT_ENOMEM;

    for (size_t k = 0; k < x->c->chatters.n; k++)
        if (x->c->chatters.at[k].surface == surface && x->c->chatters.at[k].steady) {
            qdot_free(rates);
            return status;
        }
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        speed += fabs(s->along[n + i]) * x->largest[n + i];
        pull += fabs(s->along[n + i] * rates[n + i]);
    }
    qdot_free(rates);
    QDOT_TRY(status);
    return note_error(x,
                      (qdot_course_chatter){.surface = surface, .t = x->start.t, .end = x->t1,
                                            .place = by * (speed + pull), .speed = by * pull,
                                            .mode = {x->mode, x->mode, x->mode}, .ended = true, .steady = true},
                      s);
}

/* The bounces left out count as an error of the motion until they would have ended. */
static qdot_status
note_skipped(qdot_piece *x, size_t surface, const skipped *s)
{
    qdot_course_chatter chatter = {.surface = surface, .t = x->start.t, .place = height(s),
                                   .speed = fabs(s->off[1]),
                                   .unsure = s->off[1] != 0 ? fabs(s->off[0] / s->off[1]) : 0,
                                   .mode = {x->mode, x->mode, x->mode}, .ended = true};

    if (qdot_contacts_moves(&x->c->stage->switches, surface) && isfinite(s->pull))
        QDOT_TRY(note_rounding(x, surface, s));
    chatter.end = x->start.t + x->direction * fmin(duration(s), fabs(x->t1 - x->start.t));
    return chatter.end == chatter.t ? QDOT_OK : note_error(x, chatter, s);
}

qdot_status
qdot_piece_rest(qdot_piece *x, size_t event, int way, double left, bool *lasts, bool *soon)
{
    const size_t surface = qdot_contacts_surface(&x->c->stage->switches, event, way);
    double *kept;
    skipped s = {0};
    qdot_status status;

    *lasts = *soon = false;
    if (surface == SIZE_MAX || x->side[surface] == QDOT_SIDE_SLIDES)
        return QDOT_OK;
    kept = qdot_calloc(2 * x->n + 1, sizeof *kept);
    if (!kept)
        return QDOT_ENOMEM;
    s.along = kept + x->n;
    memcpy(kept, x->start.y, x->n * sizeof *kept);
    status = enter(x, surface, &s, lasts);
    if (status == QDOT_OK && *lasts && !may_rest(x, surface, left, &s)) {
        *lasts = false;
        *soon = s.moved <= fastest || left > 0;
    }
    if (!*lasts) {
        x->side[surface] = 0;
        memcpy(x->start.y, kept, x->n * sizeof *kept);
    }
    if (status == QDOT_OK && *lasts)
        status = note_skipped(x, surface, &s);
    qdot_free(kept);
    return status;
}

qdot_status
qdot_piece_may_be_low(qdot_piece *x, size_t event, int way, bool *may)
{
    double rate, noise;

    *may = false;
    if (x->reader.read_two || qdot_contacts_surface(&x->c->stage->switches, event, way) == SIZE_MAX)
        return QDOT_OK;
    QDOT_TRY(qdot_piece_rate(x, event, &rate, &noise));
    *may = x->method->multistep || fabs(rate) <= noise * (slow / (4 * DBL_EPSILON));
    return QDOT_OK;
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

int
qdot_piece_way_asked(const qdot_piece *x, size_t i)
{
    const int way = (int)x->direction * x->c->stage->events.at[i].way;

    return qdot_watch_is_turned(qdot_piece_watch(x), x->start.t, x->start.y, i) ? -way : way;
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
    if (e->way == 0 || !x->functions_on[i] || first != qdot_piece_way_asked(x, i) || !sets_velocities(x, e))
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
    const int way = e->undoing ? qdot_watch_first(qdot_piece_watch(x))[i] : qdot_piece_way_asked(x, i);

    return e->then && way != 0 && x->functions_on[i] && x->touching[i] && x->left[i] == -way
           && qdot_watch_first(qdot_piece_watch(x))[i] == way && x->signs[i] != -way && !qdot_piece_just_noted(x, i);
}

/* --- after a change ------------------------------------------------------------------- */

qdot_status
qdot_piece_keep_contacts(qdot_piece *x)
{
    const qdot_switches *s = &x->c->stage->switches;
    const qdot_sliding_rows *held = &qdot_piece_mode(x)->held;

    x->pushed.n = 0;
    for (size_t i = qdot_switches_own(s); i < s->surfaces.n; i++) {
        const double reaction = s->surfaces.at[i].reaction;
        double place, rate;

        if (x->side[i] != QDOT_SIDE_SLIDES || qdot_piece_mode(x)->side[i] != QDOT_SIDE_SLIDES)
            continue;
        QDOT_TRY(
            qdot_sliding_rows_value(held, x->n / 2, x->start.t, x->start.y, i, 0, &place, NULL));
        QDOT_TRY(
            qdot_sliding_rows_value(held, x->n / 2, x->start.t, x->start.y, i, 1, &rate, NULL));
        place *= reaction;
        rate *= reaction;
        if (fabs(place) <= alike && fabs(rate) <= alike)
            continue;
        x->side[i] = 0;
        if (place > alike || (fabs(place) <= alike && rate > 0))
            continue;
        if (place >= -alike) {
            QDOT_TRY(qdot_vec_push(&x->pushed, i));
            continue;
        }
        snprintf(x->c->reason, sizeof x->c->reason,
                 "stopped at t = %.15g: an event pushes the motion into the contact at %.100s, and "
                 "nothing says what comes of it",
                 x->start.t, x->c->stage->events.at[s->surfaces.at[i].event].name);
    }
    return QDOT_OK;
}
