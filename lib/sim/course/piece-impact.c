/* piece-impact.c -- tests whether the `then` of an event is an impact on a smooth wall while other
 * contacts last. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "sim/course/piece-impact.h"
#include "sim/model/contact.h"

/* Two velocities count as equal if they differ relatively by no more than this. */
static const double alike = 1e-9;
/* Values set by an event's `then` may err by this multiple of the rounding errors of the velocities. */
static const double roundings = 32;
/* The speed of a trial impact, relative to the speed of the motion (or to 1, if that is larger). */
static const double trial = 1e-3;

static double
vector_length(size_t n, const double *d)
{
    double length = 0;

    for (size_t i = 0; i < n; i++)
        length = hypot(length, d[i]);
    return length;
}

static double
dot(size_t n, const double *a, const double *b)
{
    double sum = 0;

    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Find q'' of the present mode minus q'' of the mode `other`, into d [n]. */
static qdot_status
find_acceleration_difference(qdot_piece *x, size_t other, double *d, double *size)
{
    const size_t n = x->n / 2;
    double *rates = qdot_malloc(2 * x->n * sizeof *rates), most = 0;
    qdot_status status = rates ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_piece_rates(x, x->mode, rates);
    if (status == QDOT_OK)
        status = qdot_piece_rates(x, other, rates + x->n);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        d[i] = rates[n + i] - rates[x->n + n + i];
        most = fmax(most, fmax(fabs(rates[n + i]), fabs(rates[x->n + n + i])));
    }
    if (status == QDOT_OK && vector_length(n, d) > roundings * DBL_EPSILON * most)
        *size = vector_length(n, d);
    qdot_free(rates);
    return status;
}

qdot_status
qdot_piece_reaction(qdot_piece *x, size_t surface, double *d, double *size)
{
    const size_t mode = x->mode;
    size_t without;
    qdot_status status;

    *size = 0;
    x->side[surface] = 0;
    status = qdot_piece_enter(x);
    without = x->mode;
    x->side[surface] = QDOT_SIDE_SLIDES;
    x->mode = mode;
    return status == QDOT_OK ? find_acceleration_difference(x, without, d, size) : status;
}

/* A trial impact: the `then` of a contact applied with a velocity reduced by `speed` along `aside`
 * [n], and the change of velocities. */
typedef struct {
    const double *slopes; /* [n] gradient du/dq of the contact's distance u */
    double *old, *y;      /* [2n] states before and after the impact */
    double rate;          /* du/dt before the impact */
} blow;

static qdot_status
apply_trial_impact(qdot_piece *x, size_t surface, const double *aside, double speed, blow *b)
{
    const qdot_surface *s = &x->c->stage->switches.surfaces.at[surface];
    const size_t n = x->n / 2;

    memcpy(b->old, x->start.y, x->n * sizeof *b->old);
    for (size_t i = 0; i < n; i++)
        b->old[n + i] -= speed * aside[i];
    b->rate = -speed * dot(n, b->slopes, aside);
    memcpy(b->y, b->old, x->n * sizeof *b->y);
    return qdot_piece_change(x, &x->c->stage->events.at[s->event], x->start.t, b->old, NULL, b->y, NULL);
}

/* Whether it leaves the place where it is; and by how much it changes velocities at most, *most, which are as
 * large as *size. */
static bool
changes_only_velocities(const qdot_piece *x, const blow *b, double *most, double *size)
{
    const size_t n = x->n / 2;
    bool yes = true;

    *most = 0;
    *size = 1;
    for (size_t i = 0; i < n; i++) {
        yes = yes && fabs(b->y[i] - b->old[i]) <= roundings * DBL_EPSILON * fmax(fabs(b->old[i]), x->largest[i]);
        *most = fmax(*most, fabs(b->y[n + i] - b->old[n + i]));
        *size = fmax(*size, fabs(b->old[n + i]));
    }
    return yes;
}

/* The change of velocities by which an impact on that surface makes du/dt larger by 1, along [n], from one whose velocity
 * is off by `aside`; *share: the part of |du/dt| that it leaves. *yes: it turns du/dt about, leaves a motion without it as
 * it is, and the place, too. */
static qdot_status
find_impulse(qdot_piece *x, size_t surface, const double *slopes, const double *aside, double *along,
             double *share, bool *yes)
{
    const size_t n = x->n / 2;
    double *room = qdot_malloc(2 * x->n * sizeof *room), most, size, speed = trial, back = 0;
    blow b = {.slopes = slopes, .old = room, .y = room + x->n};
    qdot_status status = room ? apply_trial_impact(x, surface, aside, 0, &b) : QDOT_ENOMEM;

    *yes = status == QDOT_OK && changes_only_velocities(x, &b, &most, &size) && most <= roundings * DBL_EPSILON * size;
    if (*yes) {
        speed = trial * size;
        status = apply_trial_impact(x, surface, aside, speed / vector_length(n, aside), &b);
        *yes = status == QDOT_OK && changes_only_velocities(x, &b, &most, &size);
    }
    for (size_t i = 0; i < n && *yes; i++) {
        along[i] = b.y[n + i] - b.old[n + i];
        back += slopes[i] * along[i];
    }
    if (*yes) {
        *share = -back / b.rate - 1;
        *yes = *share >= -1e-6 - alike * size / speed && *share <= 1 + 1e-6 + alike * size / speed;
    }
    for (size_t i = 0; i < n && *yes; i++)
        along[i] /= back;
    qdot_free(room);
    return status;
}

/* M along [n] of the equations of a mode without what the contacts do, compared with the slopes of u: whether it is along
 * them. No mode with constraints, or whose equations are solved for q'', tells that. */
static qdot_status
is_along_gradient(qdot_piece *x, const double *along, const double *slopes, bool *yes)
{
    const size_t n = x->n / 2, mode = x->mode;
    const qdot_plan *p;
    int64_t *side = qdot_calloc(x->c->stage->switches.surfaces.n + 1, sizeof *side);
    double *room = NULL, most = 0, off = 0;
    qdot_tape *masses = NULL;
    qdot_status status = side ? QDOT_OK : QDOT_ENOMEM;

    *yes = false;
    if (status == QDOT_OK) {
        memcpy(side, x->side, x->c->stage->switches.surfaces.n * sizeof *side);
        for (size_t i = qdot_switches_own(&x->c->stage->switches); i < x->c->stage->switches.surfaces.n; i++)
            x->side[i] = x->c->stage->switches.surfaces.at[i].contact ? 0 : x->side[i];
        status = qdot_piece_enter(x);
    }
    p = qdot_piece_mode(x)->plan;
    if (status == QDOT_OK && p->M && p->m == 0 && !qdot_sliding_is(&x->c->stage->switches, x->side))
        status = qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, n * n, p->M, &masses);
    if (masses)
        room = qdot_malloc((2 * n + 1 + n * n + qdot_tape_work(masses) + 1) * sizeof *room);
    if (masses && !room)
        status = QDOT_ENOMEM;
    if (room) {
        double *M = room + 2 * n + 1, part = 0;

        memcpy(room, x->start.y, x->n * sizeof *room);
        room[2 * n] = x->start.t;
        qdot_tape_eval(masses, room, M, M + n * n);
        for (size_t i = 0; i < n; i++) /* scale `along` so that its product with the gradient is 1 */
            part += dot(n, M + i * n, along) * along[i];
        for (size_t i = 0; i < n; i++) {
            most = fmax(most, fabs(part * slopes[i]));
            off = fmax(off, fabs(dot(n, M + i * n, along) - part * slopes[i]));
        }
        *yes = off <= alike * most;
    }
    if (side)
        memcpy(x->side, side, x->c->stage->switches.surfaces.n * sizeof *side);
    x->mode = mode;
    qdot_free(side);
    qdot_free(room);
    qdot_tape_free(masses);
    return status;
}

/* Subtract from d [n] its components along the k orthonormal vectors e [k x n]. */
static void
remove_components(size_t n, size_t k, const double *e, double *d)
{
    for (size_t pass = 0; pass < 2; pass++)
        for (size_t j = 0; j < k; j++) {
            const double part = dot(n, e + j * n, d);

            for (size_t i = 0; i < n; i++)
                d[i] -= part * e[j * n + i];
        }
}

/* The impulse direction of a contact that lasts in the present mode, as find_impulse; *size: of its
 * reaction d [n]. */
static qdot_status
find_impulse_in_mode(qdot_piece *x, size_t surface, double *d, double *size, double *slopes,
                     double *along, double *share, bool *yes)
{
    const size_t n = x->n / 2;
    double rate;
    qdot_status status = qdot_piece_reaction(x, surface, d, size);

    *yes = false;
    if (status == QDOT_OK)
        status = qdot_sliding_rows_value(&qdot_piece_mode(x)->held, n, x->start.t, x->start.y, surface, 1,
                                         &rate, slopes);
    if (status == QDOT_OK && isfinite(*size) && (*size > 0 || qdot_piece_mode(x)->plan->m == 0))
        status = find_impulse(x, surface, slopes, *size > 0 ? d : slopes, along, share, yes);
    return status;
}

qdot_status
qdot_piece_is_smooth_wall(qdot_piece *x, size_t surface, double *share, bool *yes)
{
    const size_t n = x->n / 2, surfaces = x->c->stage->switches.surfaces.n;
    double *room = qdot_malloc(((surfaces + 4) * n + 1) * sizeof *room), size = 0;
    double *d = room, *along = d + n, *slopes = along + n, *other = slopes + n, *e = other + n, of_other, rest;
    size_t k = 0;
    qdot_status status = room ? QDOT_OK : QDOT_ENOMEM;

    *yes = false;
    if (status == QDOT_OK)
        status = find_impulse_in_mode(x, surface, d, &size, slopes, along, share, yes);
    if (status == QDOT_OK && *yes && size == 0) { /* no force presses the body against the wall */
        status = is_along_gradient(x, along, slopes, yes);
        qdot_free(room);
        return qdot_grave(status);
    }
    for (size_t i = qdot_switches_own(&x->c->stage->switches); i < surfaces && status == QDOT_OK && *yes; i++) {
        bool impact = true;
        double part;

        if (x->side[i] != QDOT_SIDE_SLIDES || !x->c->stage->switches.surfaces.at[i].contact)
            continue;
        if (i != surface)
            status = find_impulse_in_mode(x, i, other, &of_other, slopes, e + k * n, &rest, &impact);
        else
            memcpy(e + k * n, along, n * sizeof *along);
        if (status != QDOT_OK || !impact)
            continue;
        part = vector_length(n, e + k * n);
        for (size_t j = 0; j < n; j++)
            e[k * n + j] /= part;
        remove_components(n, k, e, e + k * n);
        part = vector_length(n, e + k * n);
        for (size_t j = 0; j < n; j++)
            e[k * n + j] /= part;
        k += part > alike;
    }
    if (status == QDOT_OK && *yes) {
        remove_components(n, k, e, d);
        *yes = vector_length(n, d) <= alike * size;
    }
    qdot_free(room);
    return qdot_grave(status);
}
