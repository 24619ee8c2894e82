/* piece-contact.c -- contacts that last: where one begins, and whether a change of the state leaves
 * it. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "ode/scale.h"
#include "sim/course/piece-impact.h"
#include "sim/model/contact.h"

/* Largest relative difference of positions taken as equal; also of velocities, for methods without series. */
static const double alike = 1e-9;
/* A contact may begin where the bounces to come are no higher than this part of the place: its rounding hides
 * them. */
static const double least_height = DBL_EPSILON / 8;
/* Bounces off a surface that moves with time may be left out up to this height: positions at roots are rounded, too. */
static const double least_moving = 0x1p10 * DBL_EPSILON;
/* This part for methods without series, from which a state within a step is known only to that part of its size. The
 * search of a step tells heights above a sixth of that from rounding. */
static const double least_in_doubles = 0x1p16 * DBL_EPSILON;
/* A multistep method begins anew behind each bounce, with short steps of low order: its own error there hides heights
 * below so many times its tolerance. */
static const double multistep_tolerances = 64;
/* A companion must rest where the run does: it may leave out bounces up to this many times as high
 * as the run may. */
static const double led = 16;
/* A flight must rise this high, relative to the positions, to be seen to leave the wall. */
static const double apart = 64 * DBL_EPSILON;
/* No lasting contact begins if it changes a component of the state by more than this, relative to its size. */
static const double fastest = 1e-4;
/* The rate u' at a contact, or a move of the start, counts as rounding if smaller than this fraction of its terms. */
static const double rounded = 32 * DBL_EPSILON;
/* A bounce is not low if its initial speed exceeds this fraction of the largest speed so far. */
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

/* --- how a lasting contact begins ----------------------------------------------------- */

/* The bounces left out when a lasting contact begins, and the move of the start state onto the contact. */
typedef struct {
    double off[2]; /* distance u from the contact, and u', in the original start state */
    double pull;   /* acceleration u'' towards the wall without contact force; 0: nothing presses against the wall */
    double share;  /* ratio of the speeds |du/dt| after and before an impact (restitution) */
    double size;   /* size of the terms of u (the distance from the contact) */
    double moved;  /* change of the start state, relative to max(1, |component|) */
    double *along; /* [n] M^-1 du/dq, scaled so that u changes by 1, then the gradient du/dq [n] */
} skipped;

/* The change of u if each coordinate changed by its largest value so far: the size of the terms of u. */
static double
size_of_terms(const qdot_piece *x, const skipped *s)
{
    const size_t n = x->n / 2;
    double size = 0;

    for (size_t i = 0; i < n; i++)
        size += fabs(s->along[n + i]) * x->largest[i];
    return size;
}

/* How high the next flight is; how long it and all that follow take: flights of 2 |u'|/pull, each shorter by
 * `share`. */
static double
bounce_height(const skipped *s)
{
    return fabs(s->off[0]) + (s->off[1] != 0 && s->pull > 0 ? s->off[1] * s->off[1] / (2 * s->pull) : 0);
}

static double
duration_of_bounces(const skipped *s)
{
    return s->off[1] != 0 && s->pull > 0 ? 2 * fabs(s->off[1]) / (s->pull * fmax(0, 1 - s->share)) : 0;
}

/* The start moves along s->along until the row of that order of the surface is kept: an impulse of the contact, so that
 * what other forces conserve stays. */
static qdot_status
move_onto_contact(qdot_piece *x, size_t surface, int order, skipped *s)
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

/* Fill s->along and s->pull from d [n], the difference of q'' with and without the contact; `size` is its length,
 * 0 if no force presses. */
static qdot_status
find_contact_acceleration(qdot_piece *x, size_t surface, const double *d, double size, skipped *s)
{
    const size_t n = x->n / 2;
    double value, rise = 0;

    QDOT_TRY(qdot_sliding_rows_value(&qdot_piece_mode(x)->held, n, x->start.t, x->start.y, surface, 1, &value,
                                     s->along + n));
    memcpy(s->along, size > 0 ? d : s->along + n, n * sizeof *d);
    for (size_t i = 0; i < n; i++) {
        rise += s->along[n + i] * s->along[i];
        s->size += fabs(s->along[n + i] * x->start.y[i]);
    }
    for (size_t i = 0; i < n; i++)
        s->along[i] /= rise;
    s->pull = size == 0 ? 0 : rise != 0 ? fabs(rise) : INFINITY;
    return QDOT_OK;
}

/* The contacts that last beside it, which the impulse of the event has pushed into: by theirs. None of them moves
 * another. */
static qdot_status
keep_other_contacts(qdot_piece *x, size_t surface, double *d, skipped *s)
{
    const qdot_switches *switches = &x->c->stage->switches;
    double *along = qdot_malloc((x->n + 1) * sizeof *along), size;
    qdot_status status = along ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = qdot_switches_own(switches); i < switches->surfaces.n && status == QDOT_OK; i++) {
        skipped other = {.along = along};

        if (i == surface || x->side[i] != QDOT_SIDE_SLIDES || !switches->surfaces.at[i].contact)
            continue;
        status = qdot_piece_reaction(x, i, d, &size);
        if (status == QDOT_OK && size > 0 && isfinite(size))
            status = find_contact_acceleration(x, i, d, size, &other);
        if (status == QDOT_OK && size > 0 && isfinite(size))
            status = move_onto_contact(x, i, 1, &other);
        s->moved = fmax(s->moved, other.moved);
    }
    qdot_free(along);
    return status;
}

/* Enter the lasting contact: set x->side and move x->start.y onto it; record in s what is left out. */
static qdot_status
enter_contact(qdot_piece *x, size_t surface, skipped *s, bool *can)
{
    const size_t mode = x->mode;
    double *d = qdot_malloc((x->n + 1) * sizeof *d), size = 0, rest = 0;
    qdot_status status;

    *can = false;
    if (!d)
        return QDOT_ENOMEM;
    x->side[surface] = QDOT_SIDE_SLIDES;
    status = qdot_piece_enter(x);
    if (status == QDOT_OK)
        status = qdot_piece_reaction(x, surface, d, &size);
    if (status == QDOT_OK && isfinite(size))
        status = find_contact_acceleration(x, surface, d, size, s);
    for (int order = 0; order < 2 && status == QDOT_OK && isfinite(size); order++)
        status = move_onto_contact(x, surface, order, s);
    if (status == QDOT_OK && isfinite(s->moved))
        status = keep_other_contacts(x, surface, d, s);
    if (status == QDOT_OK)
        status = qdot_sliding_rows_keep(&qdot_piece_mode(x)->held, x->n / 2, x->start.t, x->start.y, &rest);
    s->moved = fmax(s->moved, rest);
    /* check that other contacts are still satisfied after the move */
    if (status == QDOT_OK && isfinite(s->moved) && rest <= fastest)
        status = qdot_piece_is_smooth_wall(x, surface, &s->share, can);
    x->mode = mode;
    qdot_free(d);
    return qdot_grave(status);
}

/* The height of bounces that a contact may leave out, beside the place. Where something switches between two of them, as
 * at the top of a flight, a piece starts there, which must see that it is off the wall: so the flights before were higher
 * than this. */
static double
lowest_visible_flight(const qdot_piece *x, size_t surface)
{
    const qdot_piece_repeat *own =
        qdot_piece_repeat_of(x, QDOT_WATCH_EVENT, x->c->stage->switches.surfaces.at[surface].event);

    for (size_t i = 0; i < x->repeats.n && own && own->ratio < 1; i++)
        if (x->repeats.at[i].kind == QDOT_WATCH_SURFACE && fabs(own->last - x->repeats.at[i].last) < own->interval)
            return apart / (1 - own->ratio);
    return qdot_contacts_moves(&x->c->stage->switches, surface) ? least_moving : least_height;
}

/* The height of the highest bounces at this surface that the main run has left out. */
static double
skipped_height_in_main_run(const qdot_piece *x, size_t surface)
{
    double most = 0;

    for (size_t k = 0; k < x->c->leader->chatters.n; k++)
        if (x->c->leader->chatters.at[k].surface == surface && !x->c->leader->chatters.at[k].steady)
            most = fmax(most, x->c->leader->chatters.at[k].place);
    return most;
}

/* The height below which a method without series cannot tell a bounce from its own errors. */
static double
least_visible_height(const qdot_piece *x, const skipped *s)
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
may_begin_contact(const qdot_piece *x, size_t surface, double left, const skipped *s)
{
    const bool by_points = !x->reader.read_two && !x->c->leader;
    const double place = size_of_terms(x, s);

    if (s->pull == 0) /* without pressure the body would move on; only a series shows that the contact force stays 0 */
        return x->reader.read_two && s->moved <= rounded;
    if (s->moved <= fastest
        && (by_points && left == 0 ? bounce_height(s) <= least_height * place /* the motion does not leave the surface */
                                   : isfinite(left) && s->moved * left <= lowest_visible_flight(x, surface) * place))
        return true;
    return (x->c->leader || by_points) && isfinite(duration_of_bounces(s))
           && bounce_height(s) <= (by_points ? least_visible_height(x, s) : led * skipped_height_in_main_run(x, surface));
}

static qdot_status
append_chatter(qdot_piece *x, qdot_course_chatter chatter, const skipped *s)
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
record_rounding_of_contact(qdot_piece *x, size_t surface, const skipped *s)
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
    return append_chatter(x,
                          (qdot_course_chatter){.surface = surface, .t = x->start.t, .end = x->t1,
                                            .place = by * (speed + pull), .speed = by * pull,
                                            .mode = {x->mode, x->mode, x->mode}, .ended = true, .steady = true},
                          s);
}

/* Count the bounces that are left out as an error of the motion, until the time at which they would
 * have ended. */
static qdot_status
record_skipped_bounces(qdot_piece *x, size_t surface, const skipped *s)
{
    qdot_course_chatter chatter = {.surface = surface, .t = x->start.t, .place = bounce_height(s),
                                   .speed = fabs(s->off[1]),
                                   .unsure = s->off[1] != 0 ? fmin(fabs(s->off[0] / s->off[1]), duration_of_bounces(s)) : 0,
                                   .mode = {x->mode, x->mode, x->mode}, .ended = true};

    if (qdot_contacts_moves(&x->c->stage->switches, surface) && isfinite(s->pull))
        QDOT_TRY(record_rounding_of_contact(x, surface, s));
    chatter.end = x->start.t + x->direction * fmin(duration_of_bounces(s), fabs(x->t1 - x->start.t));
    return chatter.end == chatter.t ? QDOT_OK : append_chatter(x, chatter, s);
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
    status = enter_contact(x, surface, &s, lasts);
    if (status == QDOT_OK && *lasts && !may_begin_contact(x, surface, left, &s)) {
        *lasts = false;
        *soon = s.moved <= fastest || left > 0;
    }
    if (!*lasts) {
        x->side[surface] = 0;
        memcpy(x->start.y, kept, x->n * sizeof *kept);
    }
    if (status == QDOT_OK && *lasts)
        status = record_skipped_bounces(x, surface, &s);
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

/* Whether the event changes only velocities and does not stop the run. */
static bool
sets_only_velocities(const qdot_piece *x, const qdot_staged_event *e)
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
    if (e->way == 0 || !x->functions_on[i] || first != qdot_piece_way_asked(x, i) || !sets_only_velocities(x, e))
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

/* --- contacts after a change of the state --------------------------------------------- */

/* The rate of a contact that lasts where an event has changed velocities; *noise: what is left of it by rounding, and by
 * the error of a method without series. */
static qdot_status
find_separation_rate(const qdot_piece *x, size_t surface, double *rate, double *noise)
{
    const size_t n = x->n / 2;
    double *slopes = qdot_malloc((n + 1) * sizeof *slopes);
    qdot_status status = slopes ? QDOT_OK : QDOT_ENOMEM;

    *noise = 0;
    if (status == QDOT_OK)
        status = qdot_sliding_rows_value(&qdot_piece_mode(x)->held, n, x->start.t, x->start.y, surface, 1, rate,
                                         slopes);
    for (size_t k = 0; k < n && status == QDOT_OK; k++)
        *noise += rounded * fabs(slopes[k]) * x->largest[n + k];
    if (!x->reader.read_two)
        *noise = fmax(*noise, alike);
    qdot_free(slopes);
    return status;
}

qdot_status
qdot_piece_keep_contacts(qdot_piece *x)
{
    const qdot_switches *s = &x->c->stage->switches;
    const qdot_sliding_rows *held = &qdot_piece_mode(x)->held;

    x->pushed.n = 0;
    for (size_t i = qdot_switches_own(s); i < s->surfaces.n; i++) {
        const double reaction = s->surfaces.at[i].reaction;
        double place, rate, noise;

        if (x->side[i] != QDOT_SIDE_SLIDES || qdot_piece_mode(x)->side[i] != QDOT_SIDE_SLIDES)
            continue;
        QDOT_TRY(
            qdot_sliding_rows_value(held, x->n / 2, x->start.t, x->start.y, i, 0, &place, NULL));
        QDOT_TRY(find_separation_rate(x, i, &rate, &noise));
        place *= reaction;
        rate *= reaction;
        if (fabs(place) <= alike && fabs(rate) <= noise)
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
                 "it is not declared what happens then",
                 x->start.t, x->c->stage->events.at[s->surfaces.at[i].event].name);
    }
    return QDOT_OK;
}
