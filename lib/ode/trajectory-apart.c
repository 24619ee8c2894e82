/* trajectory-apart.c -- trajectories of systems with decoupled parts: one trajectory (track) for each part. */
#include "base/memory.h"
#include "ode/apart.h"
#include "ode/trajectory.h"

/* Make the points of the whole system: those of the finest track (part), with the other tracks read at these times. */
static qdot_status
merge_tracks(qdot_trajectory *tr, const qdot_ode_system *system)
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

/* Integrate the trajectory of part k to the time that the earlier parts have reached. */
static qdot_status
integrate_track(qdot_trajectory *tr, size_t k, const qdot_ode_part *part,
                const qdot_ode_options *options, const double *y0, double *room)
{
    qdot_ode_options own = qdot_ode_part_options(part, options, room + part->system->n);
    qdot_status status;

    qdot_ode_part_gather(part, y0, room);
    status = qdot_trajectory_run(tr->tracks + k, part->system, tr->method, &own, tr->t[0],
                                 tr->result.t, room);
    qdot_ode_part_add(&tr->result, &tr->tracks[k].result);
    qdot_ode_part_end(&tr->result, &tr->tracks[k].result);
    return status;
}

qdot_status
qdot_trajectory_record_apart(qdot_trajectory *tr, const qdot_ode_system *system,
                             const qdot_ode_options *options, double t1)
{
    double *room = qdot_malloc(2 * system->n * sizeof *room);
    qdot_status status, ended = QDOT_OK;
    qdot_error failure = {0};

    tr->result = (qdot_ode_result){.outcome = QDOT_ODE_DONE, .t = t1, .stats = tr->result.stats};
    tr->tracks = qdot_calloc(system->n_parts, sizeof *tr->tracks);
    status = room && tr->tracks ? QDOT_OK : QDOT_ENOMEM;
    tr->n_tracks = tr->tracks ? system->n_parts : 0;
    for (size_t k = 0; k < system->n_parts && status == QDOT_OK; k++) {
        status = integrate_track(tr, k, system->parts + k, options, tr->y, room);
        if (status != QDOT_OK && status != QDOT_ENOMEM) {
            ended = status;
            failure = *qdot_last_error();
            status = QDOT_OK;
        }
    }
    qdot_free(room);
    if (status == QDOT_OK)
        status = merge_tracks(tr, system);
    if (status != QDOT_OK || ended == QDOT_OK)
        return status;
    qdot_fail_again(&failure);
    return ended;
}
