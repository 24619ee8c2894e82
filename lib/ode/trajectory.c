/* trajectory.c -- stores the points of a run for reading states between them. */
#include "ode/trajectory.h"

#include <string.h>

#include "base/memory.h"
#include "ode/apart.h"
#include "ode/meter.h"

static const size_t most_bytes = (size_t)2 << 30;

/* After each so many points the total is estimated: a run that would need a thousand times the
 * largest number allowed is stopped. */
enum { looks = 1 << 18 };
static const double hopeless = 5e10;

static void
clear_tracks(qdot_trajectory *tr)
{
    for (size_t k = 0; k < tr->n_tracks; k++)
        qdot_trajectory_clear(tr->tracks + k);
    qdot_free(tr->tracks);
    tr->tracks = NULL;
    tr->n_tracks = 0;
}

void
qdot_trajectory_clear(qdot_trajectory *tr)
{
    clear_tracks(tr);
    qdot_free(tr->t);
    qdot_free(tr->y);
    qdot_free(tr->low);
    qdot_free(tr->s);
    qdot_free(tr->pieces.at);
    qdot_free(tr->turns.at);
    *tr = (qdot_trajectory){0};
}

/* Initial capacity of arrays in doubles, so large that short runs rarely reallocate. */
enum { first_room = 512 };

static size_t
maximum(size_t wanted, size_t least)
{
    return wanted > least ? wanted : least;
}

/* Reserve memory for one more point of the trajectory. */
static qdot_status
trajectory_make_room(qdot_trajectory *tr, double t)
{
    const size_t wanted = tr->count + 1;

    if (wanted > most_bytes / sizeof(double) / (tr->n + 1)) {
        qdot_fail(QDOT_ELIMIT, "stopped at t = %.17g: the run takes more than 2 GB", t);
        return qdot_hint("a coarser tolerance or a shorter run needs fewer points");
    }
    if (wanted > tr->t_capacity)
        QDOT_TRY(qdot_grow(&tr->t, &tr->t_capacity, maximum(wanted, first_room / 8),
                           sizeof *tr->t));
    if (wanted * tr->n > tr->y_capacity)
        QDOT_TRY(qdot_grow(&tr->y, &tr->y_capacity, maximum(wanted * tr->n, first_room),
                           sizeof *tr->y));
    return QDOT_OK;
}

qdot_status
qdot_trajectory_store(qdot_trajectory *tr, double t, const double *y)
{
    const size_t n = tr->n;
    double *to;

    /* test the limit on stored points only when the capacity, a power of two, grows */
    if (tr->count == tr->t_capacity || (tr->count + 1) * n > tr->y_capacity)
        QDOT_TRY(trajectory_make_room(tr, t));
    to = tr->y + tr->count * n;
    tr->t[tr->count++] = t;
    for (size_t i = 0; i < n; i++)
        to[i] = y[i];
    return QDOT_OK;
}

/* Store the low part (exact state minus y) of the last point; NULL: 0. */
static qdot_status
store_low(qdot_trajectory *tr, const double *low)
{
    const size_t n = tr->n, at = (tr->count - 1) * n;

    if (at + n > tr->low_capacity)
        QDOT_TRY(qdot_grow(&tr->low, &tr->low_capacity, maximum(at + n, first_room),
                           sizeof *tr->low));
    for (size_t i = 0; i < n; i++)
        tr->low[at + i] = low ? low[i] : 0;
    return QDOT_OK;
}

qdot_status
qdot_trajectory_add(qdot_trajectory *tr, const qdot_ode_options *options, double t1, const qdot_ode_step *step)
{
    const qdot_ode_meter *meter = options->meter;

    /* do not stop a companion run (its meter has a run to compare with), which must go as far as its run */
    if (tr->count % looks == 0 && !(meter && meter->beside))
        QDOT_TRY(qdot_ode_check_pace(tr->t[0], step->t_end, t1, tr->count, hopeless,
                                     "at most 5e7 steps are taken: a shorter run, or other units of time"));
    if (step->method != qdot_trajectory_method_of(tr, tr->count - 1))
        QDOT_TRY(qdot_vec_push(&tr->turns, ((qdot_trajectory_turn){tr->count - 1, step->method})));
    QDOT_TRY(qdot_trajectory_store(tr, step->t_end, step->y_end));
    return tr->leading ? store_low(tr, step->low_end) : QDOT_OK;
}

/* Store the first point of a piece of the run, and the options that are kept with the run. */
static qdot_status
store_first_point(qdot_trajectory *tr, const qdot_ode_options *options, double t0,
                  const double *y)
{
    QDOT_TRY(qdot_trajectory_store(tr, t0, y));
    return tr->leading ? store_low(tr, options->carry) : QDOT_OK;
}

/* Let the caller look at a step that was taken, and store it. */
static qdot_status
observe_step(qdot_trajectory *tr, const qdot_ode_options *options, double t1, const qdot_ode_step *step, bool *stop)
{
    if (options->accepted)
        QDOT_TRY(options->accepted(step->t_end, step->y_end, stop, options->user));
    return qdot_trajectory_add(tr, options, t1, step);
}

qdot_status
qdot_trajectory_begin_piece(qdot_trajectory *tr, size_t mode, bool jumped, const qdot_ode_options *options,
                            const double *y0)
{
    const double t0 = tr->t[tr->count - 1];
    qdot_trajectory_piece piece = {.first = tr->count, .mode = mode, .jumped = jumped};
    qdot_status status;

    if (tr->pieces.at[tr->pieces.n - 1].first == tr->count - 1) {
        piece.first = --tr->count;
        piece.jumped |= tr->pieces.at[--tr->pieces.n].jumped;
    }
    clear_tracks(tr);
    status = qdot_vec_push(&tr->pieces, piece);
    if (status == QDOT_OK)
        status = store_first_point(tr, options, t0, y0);
    if (status != QDOT_OK)
        memcpy(tr->result.reason, qdot_last_error()->message, sizeof tr->result.reason);
    return status;
}

void
qdot_trajectory_end_piece(qdot_trajectory *tr, const qdot_ode_result *result)
{
    const qdot_ode_stats before = tr->result.stats;

    tr->result = *result;
    qdot_ode_stats_add(&tr->result.stats, &before);
}

qdot_status
qdot_trajectory_record(qdot_trajectory *tr, const qdot_ode_system *system, const qdot_ode_options *options, double t1)
{
    const size_t last = tr->count - 1;
    qdot_ode_options own = *options;
    qdot_ode_controller c;
    qdot_ode_step step;
    bool stop = false;
    qdot_status status;

    own.now = qdot_trajectory_method_now(tr);
    if (tr->pieces.n == 1 && qdot_ode_is_apart(system, options))
        return qdot_trajectory_record_apart(tr, system, options, t1);
    status = qdot_ode_controller_open(&c, system, tr->method, &own, tr->t[last], t1, tr->y + last * tr->n);
    while (status == QDOT_OK && c.t != t1 && !stop) {
        status = qdot_ode_controller_next(&c, &step);
        if (status == QDOT_OK)
            status = qdot_ode_controller_settle(&c, &step, observe_step(tr, options, t1, &step, &stop));
    }
    qdot_ode_controller_close(&c, status, stop);
    qdot_trajectory_end_piece(tr, &c.result);
    return status;
}

qdot_status
qdot_trajectory_run(qdot_trajectory *tr, const qdot_ode_system *system,
                    const qdot_ode_method *method, const qdot_ode_options *options,
                    double t0, double t1, const double *y0)
{
    static const qdot_ode_options defaults = {0};
    const qdot_trajectory_piece whole = {0};
    double *y = qdot_malloc(system->n * sizeof *y);
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    if (!options)
        options = &defaults;
    if (y) /* copy the start first, since y0 may be a stored point that is about to be removed */
        memcpy(y, y0, system->n * sizeof *y);
    qdot_trajectory_clear(tr);
    tr->n = system->n;
    tr->method = method;
    tr->tol = qdot_ode_tolerance(options);
    tr->order_more = options->order_more;
    tr->leading = options->leading;
    tr->t0_low = options->t0_low;
    tr->result = (qdot_ode_result){.outcome = QDOT_ODE_FAILED, .t = t0};
    if (status == QDOT_OK)
        status = qdot_vec_push(&tr->pieces, whole);
    if (status == QDOT_OK)
        status = store_first_point(tr, options, t0, y);
    qdot_free(y);
    if (status == QDOT_OK)
        return qdot_trajectory_record(tr, system, options, t1);
    memcpy(tr->result.reason, qdot_last_error()->message, sizeof tr->result.reason);
    return status;
}
