/* watch-new.c -- makes a watch: its tapes and arrays. */
#include <string.h>

#include "sim/watch/watch-parts.h"
#include "sim/watch/watch.h"

const qdot_tape *
qdot_watch_tape(const qdot_watch *w)
{
    return w->tape;
}

void
qdot_watch_is_bound(qdot_watch *w, size_t i, size_t coordinate, double bound)
{
    w->coordinate[i] = coordinate;
    w->bound[i] = bound;
    w->smooth[i] = false;
    w->all_bounds = true;
    for (size_t k = 0; k < w->m; k++)
        w->all_bounds = w->all_bounds && w->coordinate[k] != SIZE_MAX;
}

void
qdot_watch_free(qdot_watch *w)
{
    if (!w)
        return;
    qdot_tape_free(w->tape);
    qdot_tape_free(w->sizes);
    qdot_tape_free(w->plain);
    qdot_tape_two_free(w->two);
    qdot_free(w->state_two);
    qdot_watch_clear_flat(w);
    qdot_watch_clear_turns(w);
    qdot_free(w->jumps.at);
    qdot_free(w->smooth);
    qdot_polynomial_bounds_clear(&w->bounds);
    qdot_free(w->coordinate);
    qdot_free(w->bound);
    qdot_free(w->in);
    qdot_free(w->roots.at);
    qdot_free(w->first);
    qdot_free(w->live);
    qdot_free(w);
}

/* Allocate all arrays: numbers in one block, signs in another, flags in a third. */
static qdot_status
watch_make_room(qdot_watch *w)
{
    size_t m = w->m, n = w->n, work = qdot_tape_work(w->tape);
    size_t inputs = qdot_tape_inputs(w->tape);

    if (qdot_tape_work(w->sizes) > work)
        work = qdot_tape_work(w->sizes);
    double *at = qdot_calloc(inputs + 3 * 2 * n + 1 + 2 * work + 19 * m + 3 * QDOT_WATCH_NODES * m +
                                 (QDOT_WATCH_DEEPEST + 2) * m + m,
                             sizeof *at);
    int *signs = qdot_calloc(9 * m + 1, sizeof *signs);
    bool *flags = qdot_calloc(19 * m + 1, sizeof *flags);

    w->in = at;
    w->first = signs;
    w->live = flags;
    w->coordinate = qdot_malloc((m + 1) * sizeof *w->coordinate);
    w->bound = qdot_calloc(m + 1, sizeof *w->bound);
    if (!at || !signs || !flags || !w->coordinate || !w->bound)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m; i++)
        w->coordinate[i] = SIZE_MAX;
    w->y = w->in + inputs;
    w->z = w->y + 2 * n;
    w->end = w->z + 2 * n;
    w->work = w->end + 2 * n + 1;
    w->g = w->work + 2 * work; /* qdot_rounding_bounds needs as much */
    w->moved = w->g + m;
    w->raw = w->moved + m;
    w->noise = w->raw + m;
    w->first_noise = w->noise + m;
    w->size = w->first_noise + m;
    w->clear = w->size + m;
    w->final = w->clear + m;
    w->start.g0 = w->final + m;
    w->now.g0 = w->start.g0 + m;
    w->samples = w->now.g0 + m;
    w->extrema = w->samples + QDOT_WATCH_NODES * m;
    w->fitted = w->extrema + QDOT_WATCH_NODES * m;
    w->ends = w->fitted + QDOT_WATCH_NODES * m;
    w->fine_end = w->ends + (QDOT_WATCH_DEEPEST + 2) * m;
    w->start.offset = w->fine_end + m;
    w->now.offset = w->start.offset + m;
    w->most = w->now.offset + m;
    w->faded_since = w->most + m;
    w->settled = w->faded_since + m;
    w->hidden = w->settled + m;
    w->start.apart = w->hidden + m;
    w->now.apart = w->start.apart + m;
    w->gap = w->now.apart + m;
    for (size_t i = 0; i < m; i++)
        w->settled[i] = NAN;
    w->start.sign = signs + m;
    w->now.sign = signs + 2 * m;
    w->n_extrema = signs + 3 * m;
    w->n_fitted = signs + 4 * m;
    w->faded = signs + 5 * m;
    w->leaves = signs + 6 * m;
    w->hides = signs + 7 * m;
    w->meets = signs + 8 * m;
    w->fresh = flags + m;
    w->start.on = flags + 2 * m;
    w->now.on = flags + 3 * m;
    w->slow = flags + 4 * m;
    w->grazed = flags + 5 * m;
    w->start.blurred = flags + 6 * m;
    w->now.blurred = flags + 7 * m;
    w->start.sharp = flags + 8 * m;
    w->now.sharp = flags + 9 * m;
    w->wants = flags + 10 * m;
    w->may_fade = flags + 11 * m;
    w->fading = flags + 12 * m;
    w->deep = flags + 13 * m;
    w->may_be_flat = flags + 14 * m;
    w->may_hide = flags + 15 * m;
    w->start.joined = flags + 16 * m;
    w->now.joined = flags + 17 * m;
    w->beside = flags + 18 * m;
    return QDOT_OK;
}

qdot_status
qdot_watch_new(const qdot_plan *plan, size_t m, const qdot_expr *g, bool shaken,
               double tol, qdot_watch **watch)
{
    qdot_watch *w = qdot_calloc(1, sizeof *w);
    qdot_status status;

    *watch = NULL;
    if (!w)
        return QDOT_ENOMEM;
    w->plan = plan;
    w->kernels = qdot_series_kernels_get();
    w->m = m;
    w->n = plan->n;
    w->tol = tol;
    w->nodes = QDOT_WATCH_LEAST_NODES;
    status = qdot_watch_lower(w, g, shaken);
    if (status == QDOT_OK)
        status = watch_make_room(w);
    if (status == QDOT_OK)
        status = qdot_watch_find_jumps(w);
    if (status == QDOT_OK)
        status = qdot_polynomial_bounds_init(&w->bounds, w->tape, 2 * w->n);
    if (status != QDOT_OK) {
        qdot_watch_free(w);
        return status;
    }
    *watch = w;
    return QDOT_OK;
}
