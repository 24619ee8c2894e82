/* apart.c -- part by part, and put together again. */
#include "ode/apart.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

bool
qdot_ode_is_apart(const qdot_ode_system *system, const qdot_ode_options *options)
{
    return system->n_parts > 1
           && (options->apart || (!options->accepted && !options->expanded));
}

static void
gather(const qdot_ode_part *part, const double *y, double *own)
{
    for (size_t i = 0; i < part->system->n; i++)
        own[i] = y[part->index[i]];
}

static void
scatter(const qdot_ode_part *part, const double *own, double *y)
{
    for (size_t i = 0; i < part->system->n; i++)
        y[part->index[i]] = own[i];
}

/* What one of them is integrated with; carry [n] is room for its own, in the end for what its
 * end state is beyond y. */
static qdot_ode_options
options_of(const qdot_ode_part *part, const qdot_ode_options *whole, double *carry)
{
    qdot_ode_options own = *whole;

    own.expanded = NULL;
    if (whole->carry) {
        gather(part, whole->carry, carry);
        own.carry = carry;
    }
    own.beyond = NULL;
    own.end_low = whole->end_low ? carry : NULL;
    return own;
}

/* What the whole did, once a part has done its. */
static void
add_up(qdot_ode_result *whole, const qdot_ode_result *part)
{
    const qdot_ode_stats *more = &part->stats;
    qdot_ode_stats *sum = &whole->stats;

    sum->steps += more->steps;
    sum->rejected += more->rejected;
    sum->evaluations += more->evaluations;
    sum->jacobians += more->jacobians;
    sum->factorisations += more->factorisations;
    sum->projections += more->projections;
    sum->cpu += more->cpu;
}

/* Where a part ends early the whole does. */
static void
end_early(qdot_ode_result *whole, const qdot_ode_result *part)
{
    if (part->outcome == QDOT_ODE_DONE)
        return;
    whole->outcome = part->outcome;
    whole->t = part->t;
    memcpy(whole->reason, part->reason, sizeof whole->reason);
}

/* --- the end alone --------------------------------------------------------------------- */

/* All parts from y at t0 to where the first of them ends. */
typedef struct {
    const qdot_ode_system *system;
    const qdot_ode_method *method;
    const qdot_ode_options *options;
    double t0, t1;
    const double *start; /* [n] */
    double *y, *room;    /* [n], [2n] */
    qdot_ode_result *result;
} parts;

/* Part k as far as the whole goes by now. */
static qdot_status
run_part(const parts *p, size_t k, qdot_ode_result *result)
{
    const qdot_ode_part *part = p->system->parts + k;
    qdot_ode_options own = options_of(part, p->options, p->room + p->system->n);
    qdot_status status;

    if (p->result->t != p->t1)
        own.t1_low = 0;
    gather(part, p->start, p->room);
    status = qdot_ode_integrate(part->system, p->method, &own, p->t0, p->result->t,
                                p->room, result);
    scatter(part, p->room, p->y);
    if (p->options->end_low)
        scatter(part, own.end_low, p->options->end_low);
    add_up(p->result, result);
    return status;
}

static qdot_status
run_parts(const parts *p)
{
    qdot_ode_result r;
    qdot_error failure = {0};
    qdot_status ended = QDOT_OK;

    for (size_t k = 0; k < p->system->n_parts; k++) {
        qdot_status status = run_part(p, k, &r);

        if (r.outcome == QDOT_ODE_DONE)
            continue;
        end_early(p->result, &r);
        if (status != QDOT_OK) {
            ended = status;
            failure = *qdot_last_error();
        }
        if (ended == QDOT_EINTR || ended == QDOT_ENOMEM)
            break;
        for (size_t j = 0; j < k; j++) /* these went further */
            if (run_part(p, j, &r) != QDOT_OK && ended == QDOT_OK) {
                ended = QDOT_EFAILED;
                failure = *qdot_last_error();
            }
    }
    if (ended != QDOT_OK)
        qdot_fail_again(&failure);
    return ended;
}

qdot_status
qdot_ode_apart_integrate(const qdot_ode_system *system, const qdot_ode_method *method,
                         const qdot_ode_options *options, double t0, double t1, double *y,
                         qdot_ode_result *result)
{
    double *start = qdot_malloc(3 * system->n * sizeof *start);
    parts p = {.system = system,
               .method = method,
               .options = options,
               .t0 = t0,
               .t1 = t1,
               .start = start,
               .y = y,
               .room = start ? start + system->n : NULL,
               .result = result};
    qdot_status status;

    *result = (qdot_ode_result){.outcome = QDOT_ODE_DONE, .t = t1};
    if (!start) {
        result->outcome = QDOT_ODE_FAILED;
        result->t = t0;
        memcpy(result->reason, qdot_last_error()->message, sizeof result->reason);
        return QDOT_ENOMEM;
    }
    memcpy(start, y, system->n * sizeof *y);
    status = run_parts(&p);
    qdot_free(start);
    return status;
}

/* --- all along it ---------------------------------------------------------------------- */

/* The points of the finest track, the others read there. */
static qdot_status
put_together(qdot_trajectory *tr, const qdot_ode_system *system)
{
    const double direction = tr->result.t < tr->t[0] ? -1 : 1;
    const qdot_trajectory *finest = tr->tracks;
    qdot_trajectory_cursor *cursor;
    double *y = qdot_malloc(tr->n * sizeof *y), last = tr->t[0];
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 1; k < tr->n_tracks; k++)
        if (tr->tracks[k].count > finest->count)
            finest = tr->tracks + k;
    if (status == QDOT_OK)
        status = qdot_trajectory_open(tr, system, &cursor);
    if (status != QDOT_OK) {
        qdot_free(y);
        return status;
    }
    for (size_t i = 1; last != tr->result.t && status == QDOT_OK; i++) {
        double t = i < finest->count ? finest->t[i] : tr->result.t;

        if (direction * (tr->result.t - t) < 0)
            t = tr->result.t;
        status = qdot_trajectory_read_tracks(cursor, t, y);
        if (status == QDOT_OK)
            status = qdot_trajectory_store(tr, t, y);
        last = t;
    }
    qdot_trajectory_close(cursor);
    qdot_free(y);
    return status;
}

/* The track of part k, as far as the whole goes by now. */
static qdot_status
run_track(qdot_trajectory *tr, size_t k, const qdot_ode_part *part,
          const qdot_ode_options *options, const double *y0, double *room)
{
    qdot_ode_options own = options_of(part, options, room + part->system->n);
    qdot_status status;

    gather(part, y0, room);
    status = qdot_trajectory_run(tr->tracks + k, part->system, tr->method, &own, tr->t[0],
                                 tr->result.t, room);
    add_up(&tr->result, &tr->tracks[k].result);
    end_early(&tr->result, &tr->tracks[k].result);
    return status;
}

qdot_status
qdot_ode_apart_record(qdot_trajectory *tr, const qdot_ode_system *system,
                      const qdot_ode_options *options, double t1, const double *y0)
{
    double *room = qdot_malloc(2 * system->n * sizeof *room);
    qdot_status status, ended = QDOT_OK;
    qdot_error failure = {0};

    tr->result = (qdot_ode_result){.outcome = QDOT_ODE_DONE, .t = t1};
    tr->tracks = qdot_calloc(system->n_parts, sizeof *tr->tracks);
    status = room && tr->tracks ? QDOT_OK : QDOT_ENOMEM;
    tr->n_tracks = tr->tracks ? system->n_parts : 0;
    for (size_t k = 0; k < system->n_parts && status == QDOT_OK; k++) {
        status = run_track(tr, k, system->parts + k, options, y0, room);
        if (status != QDOT_OK && status != QDOT_ENOMEM) {
            ended = status;
            failure = *qdot_last_error();
            status = QDOT_OK;
        }
    }
    qdot_free(room);
    if (status == QDOT_OK)
        status = put_together(tr, system);
    if (status != QDOT_OK || ended == QDOT_OK)
        return status;
    qdot_fail_again(&failure);
    return ended;
}
