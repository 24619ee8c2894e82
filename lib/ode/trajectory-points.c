/* trajectory-points.c -- changes the stored points of a run: shortens, subdivides, uses a component as time. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/trajectory.h"

void
qdot_trajectory_shorten(qdot_trajectory *tr, double t, const double *y)
{
    size_t last = tr->count - 1;

    if (last > tr->pieces.at[tr->pieces.n - 1].first && t == tr->t[last - 1]) {
        tr->count = last;
    } else {
        tr->t[last] = t;
        memcpy(tr->y + last * tr->n, y, tr->n * sizeof *y);
    }
    tr->result.t = t;
}

const qdot_ode_method *
qdot_trajectory_method_of(const qdot_trajectory *tr, size_t k)
{
    for (size_t i = tr->turns.n; i-- > 0;)
        if (tr->turns.at[i].first <= k)
            return tr->turns.at[i].method;
    return tr->method;
}

/* Append the points of one piece of the run to `to`, with each step divided into `parts` parts. */
static qdot_status
subdivide_piece(const qdot_trajectory *tr, qdot_trajectory_cursor *c, size_t piece,
                size_t parts, qdot_trajectory *to)
{
    const size_t last = qdot_trajectory_last_of(tr, piece);
    double *y = qdot_malloc((tr->n + 1) * sizeof *y);
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = tr->pieces.at[piece].first; k <= last && status == QDOT_OK; k++) {
        const double begin = tr->t[k], h = k < last ? tr->t[k + 1] - begin : 0;

        status = qdot_trajectory_store(to, begin, tr->y + k * tr->n);
        for (size_t j = 1; j < parts && k < last && status == QDOT_OK; j++) {
            const double t = begin + h * (double)j / (double)parts;

            status = qdot_trajectory_read_piece(c, piece, t, y);
            if (status == QDOT_OK)
                status = qdot_trajectory_store(to, t, y);
        }
    }
    qdot_free(y);
    return status;
}

qdot_status
qdot_trajectory_refine(qdot_trajectory *tr, const qdot_ode_system *system, size_t parts)
{
    qdot_trajectory to = {.n = tr->n};
    qdot_trajectory_cursor *c;
    size_t *first;
    qdot_status status;

    if (tr->n_tracks > 0 || tr->leading)
        return QDOT_OK;
    QDOT_TRY(qdot_trajectory_open(tr, system, &c));
    first = qdot_calloc(tr->pieces.n + 1, sizeof *first);
    status = first ? QDOT_OK : QDOT_ENOMEM;
    for (size_t i = 0; i < tr->pieces.n && status == QDOT_OK; i++) {
        first[i] = to.count;
        status = subdivide_piece(tr, c, i, parts, &to);
    }
    qdot_trajectory_close(c);
    if (status == QDOT_OK) {
        double *t = tr->t, *y = tr->y;

        tr->t = to.t;
        tr->y = to.y;
        tr->count = to.count;
        tr->t_capacity = to.t_capacity;
        tr->y_capacity = to.y_capacity;
        to.t = t;
        to.y = y;
        for (size_t i = 0; i < tr->turns.n; i++) {
            const size_t k = qdot_trajectory_piece_of(tr, tr->turns.at[i].first);

            tr->turns.at[i].first =
                first[k] + parts * (tr->turns.at[i].first - tr->pieces.at[k].first);
        }
        for (size_t i = 0; i < tr->pieces.n; i++)
            tr->pieces.at[i].first = first[i];
    }
    qdot_free(first);
    qdot_free(to.t);
    qdot_free(to.y);
    return status;
}

qdot_status
qdot_trajectory_by_clock(qdot_trajectory *tr, size_t clock)
{
    double *time = qdot_malloc((tr->count + 1) * sizeof *time);

    if (!time)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < tr->count; k++)
        time[k] = tr->y[k * tr->n + clock];
    tr->s = tr->t;
    tr->t = time;
    tr->t_capacity = tr->count;
    tr->clock = clock;
    return QDOT_OK;
}

size_t
qdot_trajectory_piece_of(const qdot_trajectory *tr, size_t k)
{
    size_t low = 0, high = tr->pieces.n;

    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;

        if (tr->pieces.at[middle].first <= k)
            low = middle;
        else
            high = middle;
    }
    return low;
}

size_t
qdot_trajectory_last_of(const qdot_trajectory *tr, size_t piece)
{
    return (piece + 1 < tr->pieces.n ? tr->pieces.at[piece + 1].first : tr->count) - 1;
}

void
qdot_trajectory_narrow(const qdot_trajectory *tr, double *low, double *high)
{
    *low = fmax(*low, fmin(tr->t[0], tr->t[tr->count - 1]));
    *high = fmin(*high, fmax(tr->t[0], tr->t[tr->count - 1]));
}

qdot_status
qdot_trajectory_at(const qdot_trajectory *tr, const qdot_ode_system *system, double t,
                   double *y)
{
    qdot_trajectory_cursor *c;
    qdot_status status;

    QDOT_TRY(qdot_trajectory_open(tr, system, &c));
    status = qdot_trajectory_read(c, t, y);
    qdot_trajectory_close(c);
    return status;
}
