/* trajectory-read.c -- finds stored points of a run, and computes states between them. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/between.h"
#include "ode/leading.h"
#include "ode/stepper.h"
#include "ode/step-decisions.h"
#include "ode/taylor.h"
#include "ode/trajectory.h"

struct qdot_trajectory_cursor {
    const qdot_trajectory *tr;
    const qdot_ode_system *systems; /* [modes] the systems of equations that the pieces of the run use, by mode */
    const qdot_ode_system *system;  /* the system of equations of the present piece */
    size_t piece;
    bool series;         /* whether the step that begins at point `at` is a Taylor step */
    int order;           /* order of the Taylor step that begins at point `at` */
    qdot_ode_stepper *s; /* stepper of a one-step method; NULL: none */
    size_t at;           /* index of the stored point before the time read last */
    qdot_between between; /* polynomial of the present step, for methods of low order */
    bool fresh;          /* whether the stepper or the series has been started at point `at` */
    double *F;           /* polynomial of a half step, for one-step methods of our own */
    bool known;          /* whether it has been tried to compute F for the present step */
    bool second;         /* F belongs to the second half of the step */
    bool good;           /* whether F was computed with success */
    /* Used for a run in decoupled parts: */
    qdot_trajectory_cursor **tracks; /* [tr->n_tracks] a cursor for the trajectory of each part */
    double *own;                     /* [n] the state of one part */
};

/* Whether time a is at or before time b in the direction of the run. */
static bool
is_at_or_before(const qdot_trajectory *tr, double a, double b)
{
    return tr->t[0] <= tr->t[tr->count - 1] ? a <= b : a >= b;
}

size_t
qdot_trajectory_locate(const qdot_trajectory *tr, double t, size_t near)
{
    size_t low = 0, high = tr->count; /* indices of points such that t[low] is at or before t, and t[high] after t */

    if (near < tr->count && is_at_or_before(tr, tr->t[near], t)) {
        low = near;
        for (size_t k = near + 1; k < near + 3; k++) {
            if (k >= tr->count || !is_at_or_before(tr, tr->t[k], t)) {
                high = k < tr->count ? k : tr->count;
                break;
            }
            low = k;
        }
    }
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;

        if (is_at_or_before(tr, tr->t[middle], t))
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The values of the variable by which the run was integrated (usually t) at the stored points. */
static const double *
integration_variable(const qdot_trajectory *tr)
{
    return tr->s ? tr->s : tr->t;
}

static qdot_status
open_stepper(qdot_trajectory_cursor *c)
{
    const qdot_ode_method *method = c->tr->method;

    if (!method->kernel)
        method = qdot_ode_method_find(method->partner);
    else if (!(c->F = qdot_calloc(method->kernel->powers * c->tr->n, sizeof *c->F)))
        return QDOT_ENOMEM;
    return qdot_ode_stepper_new(c->system, method, c->tr->tol, &c->s);
}

/* Use the equations of the given piece of the run from now on. */
static qdot_status
enter_piece(qdot_trajectory_cursor *c, size_t piece)
{
    const size_t first = c->tr->pieces.at[piece].first;
    const qdot_ode_system *system = c->systems + c->tr->pieces.at[piece].mode;

    c->piece = piece;
    if (system->following && !c->tr->entered) /* the system may have been used for another solution since */
        QDOT_TRY(system->following->enter(
            integration_variable(c->tr)[first], c->tr->y + first * c->tr->n,
            c->tr->leading ? c->tr->low + first * c->tr->n : NULL,
            system->following->user));
    if (system == c->system)
        return QDOT_OK;
    c->system = system;
    c->fresh = c->known = false;
    c->series = c->tr->method->series;
    if (system->series && (c->series || c->tr->turns.n > 0))
        c->order =
            qdot_ode_taylor_order(system->series, c->tr->tol, c->tr->leading,
                                  c->tr->order_more);
    if (c->series)
        return QDOT_OK;
    qdot_ode_stepper_free(c->s);
    qdot_free(c->F);
    qdot_free(c->between.P);
    c->between.P = NULL;
    c->s = NULL;
    c->F = NULL;
    return open_stepper(c);
}

/* Open a cursor for the trajectory of each decoupled part; runs in decoupled parts have a single piece. */
static qdot_status
open_tracks(qdot_trajectory_cursor *c)
{
    const qdot_trajectory *tr = c->tr;

    c->system = c->systems + tr->pieces.at[0].mode;
    c->own = qdot_calloc(tr->n, sizeof *c->own);
    c->tracks = qdot_calloc(tr->n_tracks, sizeof *c->tracks);
    if (!c->own || !c->tracks)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < tr->n_tracks; k++)
        QDOT_TRY(qdot_trajectory_open(tr->tracks + k, c->system->parts[k].system,
                                      &c->tracks[k]));
    return QDOT_OK;
}

qdot_status
qdot_trajectory_open(const qdot_trajectory *tr, const qdot_ode_system *system,
                     qdot_trajectory_cursor **out)
{
    qdot_trajectory_cursor *c;
    qdot_status status;

    *out = NULL;
    if (tr->count == 0)
        return qdot_fail(QDOT_EDOMAIN, "there is no run to look at");
    c = qdot_calloc(1, sizeof *c);
    if (!c)
        return QDOT_ENOMEM;
    c->tr = tr;
    c->systems = system;
    status = tr->n_tracks > 0 ? open_tracks(c) : enter_piece(c, 0);
    if (status != QDOT_OK) {
        qdot_trajectory_close(c);
        return status;
    }
    *out = c;
    return QDOT_OK;
}

void
qdot_trajectory_close(qdot_trajectory_cursor *c)
{
    if (!c)
        return;
    for (size_t k = 0; c->tracks && k < c->tr->n_tracks; k++)
        qdot_trajectory_close(c->tracks[k]);
    qdot_free(c->tracks);
    qdot_free(c->own);
    qdot_ode_stepper_free(c->s);
    qdot_free(c->F);
    qdot_free(c->between.P);
    qdot_free(c);
}

/* Step from the stored point to t in as few steps as the tolerance allows; the last one leaves
 * the state in s->trial without being accepted, so that the next query can start here too. */
static qdot_status
walk_to_time(qdot_trajectory_cursor *c, double t)
{
    enum { most = 2000 }; /* largest number of steps inside one step of the run: only near a singularity are there many */
    qdot_ode_stepper *s = c->s;
    double now = integration_variable(c->tr)[c->at], h = t - now;

    for (int tries = 0;; tries++) {
        double ratio, factor = 0.25;
        bool last = fabs(h) >= fabs(t - now);
        qdot_status status;

        if (last)
            h = t - now;
        status = qdot_ode_stepper_try(s, now, h, &ratio);
        if (status != QDOT_OK && status != QDOT_EDOMAIN && status != QDOT_ESINGULAR)
            return status;
        if (status == QDOT_OK) {
            if (ratio <= 1 && last)
                return QDOT_OK;
            factor = 0.9 * pow(ratio, -1 / qdot_ode_stepper_error_power(s));
            factor = fmin(5, fmax(0.2, factor));
            if (ratio <= 1) {
                qdot_ode_stepper_accept(s);
                c->fresh = false;
                now += h;
            }
        }
        h *= factor;
        if (tries == most)
            return qdot_fail(QDOT_EFAILED,
                             "the state at t = %.17g cannot be found from the run: steps there "
                             "come down to %.2g", t, fabs(h));
        if (fabs(h) < 4 * DBL_EPSILON * fabs(now) || fabs(h) < DBL_MIN)
            return qdot_fail(QDOT_EFAILED,
                             "the state at t = %.17g cannot be found from the run", t);
    }
}

/* Read the state at t from the Taylor series about the stored point. */
static qdot_status
read_series(qdot_trajectory_cursor *c, double t, double *y)
{
    const qdot_trajectory *tr = c->tr;
    const double *y0 = tr->y + c->at * tr->n;
    const double *at = integration_variable(tr) + c->at, t0 = at[0], h = at[1] - t0;

    if (!c->fresh)
        QDOT_TRY(qdot_ode_taylor_expand(c->system, c->order, t0, h, y0));
    c->fresh = true;
    if (tr->leading)
        return qdot_ode_leading_read(c->system, c->order, tr->tol,
                                     &(qdot_ode_place){t0, c->at == 0 ? tr->t0_low : 0, y0,
                                                       tr->low + c->at * tr->n},
                                     h, t, y);
    qdot_ode_taylor_evaluate(c->system, c->order, t0, h, t, y0, y);
    return QDOT_OK;
}

/* The polynomial of half the step: from its beginning, or back from its end; of the whole one
 * where steps cannot be taken back. */
static qdot_status
find_step_polynomial(qdot_trajectory_cursor *c, bool second)
{
    const qdot_trajectory *tr = c->tr;
    const size_t from = c->at + second;
    const double *at = integration_variable(tr);
    const double part = tr->method->kernel->forward ? 1 : 0.5;
    const double h = part * (at[c->at + 1 - second] - at[from]);
    size_t formulas = 1;
    double ratio;
    qdot_status status;

    /* try all formulas: if one has too large an error, the step was made with another */
    for (size_t k = 0; k < formulas; k++) {
        qdot_ode_stepper_start(c->s, tr->y + from * tr->n);
        status = qdot_ode_stepper_try(c->s, at[from], h, &ratio);
        if (status != QDOT_OK || ratio <= 1 || !c->s->method->kernel->another)
            break;
        formulas = c->s->method->kernel->another(c->s);
    }
    if (status == QDOT_OK && ratio <= 1)
        status = c->s->method->kernel->dense(c->s, at[from], h, c->F);
    c->fresh = false;
    c->known = true;
    c->second = second;
    c->good = status == QDOT_OK && ratio <= 1;
    return status == QDOT_EDOMAIN || status == QDOT_ESINGULAR ? QDOT_OK : status;
}

/* Read the state at t from the step's interpolating polynomial; c->good is false if there is none. */
static qdot_status
read_polynomial(qdot_trajectory_cursor *c, double t, double *y)
{
    const qdot_trajectory *tr = c->tr;
    const double start = integration_variable(tr)[c->at], end = integration_variable(tr)[c->at + 1];
    const bool forward = tr->method->kernel->forward;
    const bool second = !forward && fabs(t - start) > fabs(end - t);
    const double x = second ? (t - end) / (start - end) : (t - start) / (end - start);

    if (!c->known || c->second != second)
        QDOT_TRY(find_step_polynomial(c, second));
    if (c->good)
        c->s->method->kernel->at(tr->n, c->F, tr->y + (c->at + second) * tr->n,
                                     forward ? x : 2 * x, y);
    return QDOT_OK;
}

/* Compute those components that are functions of the others, at the state just read. */
static qdot_status
derive_components_at(const qdot_trajectory_cursor *c, double t, double *y)
{
    const qdot_ode_following *f = c->system->following;

    return f ? f->derive(t, y, f->user) : QDOT_OK;
}

qdot_status
qdot_trajectory_read_tracks(qdot_trajectory_cursor *c, double t, double *y)
{
    for (size_t k = 0; k < c->tr->n_tracks; k++) {
        const qdot_ode_part *part = c->system->parts + k;

        QDOT_TRY(qdot_trajectory_read(c->tracks[k], t, c->own));
        for (size_t i = 0; i < part->system->n; i++)
            y[part->index[i]] = c->own[i];
    }
    return QDOT_OK;
}

/* Compute the state at t within the step that begins at stored point c->at. */
static qdot_status
read_inside_step(qdot_trajectory_cursor *c, double t, double *y)
{
    if (c->tracks)
        return qdot_trajectory_read_tracks(c, t, y);
    if (c->series) {
        QDOT_TRY(read_series(c, t, y));
        return derive_components_at(c, t, y);
    }
    if (c->F) {
        QDOT_TRY(read_polynomial(c, t, y));
        if (c->good)
            return derive_components_at(c, t, y);
    }
    if (!c->fresh) {
        qdot_ode_stepper_start(c->s, c->tr->y + c->at * c->tr->n);
        c->between.known = false;
    }
    c->fresh = true;
    if (qdot_between_fits(c->tr->method)) {
        const double *t0 = integration_variable(c->tr) + c->at, h = t0[1] - *t0;
        bool done;
        QDOT_TRY(qdot_between_read(&c->between, c->s, *t0, h, c->tr->y + (c->at + 1) * c->tr->n,
                                   (t - *t0) / h, y, &done));
        if (done)
            return derive_components_at(c, t, y);
    }
    QDOT_TRY(walk_to_time(c, t));
    memcpy(y, c->s->trial, c->tr->n * sizeof *y);
    return QDOT_OK;
}

/* The same where t is a component: its root by Newton's steps, halving where they leave what is
 * left. */
static qdot_status
read_at_time_component(qdot_trajectory_cursor *c, double t, double *y)
{
    enum { most = 200 };
    const qdot_trajectory *tr = c->tr;
    const double *time = tr->t + c->at;
    double a = tr->s[c->at], b = tr->s[c->at + 1];
    double s = a + (b - a) * ((t - time[0]) / (time[1] - time[0]));

    for (int tries = 0; tries < most; tries++) {
        double gap, next;

        QDOT_TRY(read_inside_step(c, s, y));
        gap = y[tr->clock] - t;
        if (gap == 0)
            break;
        *((gap > 0) == (time[1] > time[0]) ? &b : &a) = s;
        next = s - gap / y[tr->clock + tr->n / 2];
        if (!((next - a) * (b - next) > 0))
            next = a + 0.5 * (b - a);
        if (fabs(next - s) <= DBL_EPSILON * fabs(s) || next == a || next == b)
            break;
        s = next;
    }
    return QDOT_OK;
}

/* Compute the state at t, which lies in the step that begins at stored point k, or at that point. */
static qdot_status
read_from_point(qdot_trajectory_cursor *c, size_t k, double t, double *y)
{
    const qdot_trajectory *tr = c->tr;

    if (k != c->at)
        c->fresh = c->known = false;
    c->at = k;
    if (tr->turns.n > 0)
        c->series = qdot_trajectory_method_of(tr, k)->series;
    if (tr->t[k] == t) {
        memcpy(y, tr->y + k * tr->n, tr->n * sizeof *y);
        return QDOT_OK;
    }
    return tr->s ? read_at_time_component(c, t, y) : read_inside_step(c, t, y);
}

qdot_status
qdot_trajectory_read(qdot_trajectory_cursor *c, double t, double *y)
{
    const qdot_trajectory *tr = c->tr;
    double first = tr->t[0], last = tr->t[tr->count - 1];
    size_t k, piece;

    if (!(fmin(first, last) <= t && t <= fmax(first, last)))
        return qdot_fail(QDOT_EDOMAIN,
                         "t = %.15g is outside the run, which covers %.15g to %.15g", t,
                         first, last);
    k = qdot_trajectory_locate(tr, t, c->at);
    for (piece = c->piece; tr->pieces.at[piece].first > k; piece--)
        ;
    while (piece + 1 < tr->pieces.n && tr->pieces.at[piece + 1].first <= k)
        piece++;
    if (!c->tracks)
        QDOT_TRY(enter_piece(c, piece));
    return read_from_point(c, k, t, y);
}

qdot_status
qdot_trajectory_read_piece(qdot_trajectory_cursor *c, size_t piece, double t, double *y)
{
    const qdot_trajectory *tr = c->tr;
    size_t low = tr->pieces.at[piece].first;
    const size_t last = qdot_trajectory_last_of(tr, piece);

    if (!c->tracks)
        QDOT_TRY(enter_piece(c, piece));
    if (is_at_or_before(tr, t, tr->t[low]))
        return read_from_point(c, low, tr->t[low], y);
    if (is_at_or_before(tr, tr->t[last], t))
        return read_from_point(c, last, tr->t[last], y);
    if (c->at >= low && c->at < last && is_at_or_before(tr, tr->t[c->at], t)
        && !is_at_or_before(tr, tr->t[c->at + 1], t))
        return read_from_point(c, c->at, t, y);
    for (size_t high = last; high - low > 1;) {
        size_t middle = low + (high - low) / 2;

        if (is_at_or_before(tr, tr->t[middle], t))
            low = middle;
        else
            high = middle;
    }
    return read_from_point(c, low, t, y);
}

bool
qdot_trajectory_expanded(const qdot_trajectory_cursor *c, const qdot_ode_system **of,
                         qdot_ode_expanded *step)
{
    const qdot_trajectory *tr = c->tr;

    if (c->tracks || !c->series || tr->s || !c->fresh)
        return false;
    *of = c->system;
    *step = (qdot_ode_expanded){.t = tr->t[c->at],
                                .t_end = tr->t[c->at + 1],
                                .unit = qdot_step_unit(tr->t[c->at + 1] - tr->t[c->at]),
                                .order = c->order,
                                .y = tr->y + c->at * tr->n};
    return true;
}

uint64_t
qdot_trajectory_evaluations(const qdot_trajectory_cursor *c)
{
    return c->s ? c->s->evaluations : 0;
}

size_t
qdot_trajectory_mode_read(const qdot_trajectory_cursor *c)
{
    return c->tr->pieces.at[c->piece].mode;
}

void
qdot_trajectory_renew(qdot_trajectory_cursor *c)
{
    c->fresh = c->known = false;
}
