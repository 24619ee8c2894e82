/* massless-jump.c -- finds, from the equations of massless coordinates, the values that an event's
 * `then` does not set. */
#include "sim/model/massless-jump.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/solve/linear.h"

typedef struct {
    const qdot_scene *scene;
    const qdot_event *event;
    const qdot_massless_rows *rows;
    qdot_pool *pool;
    size_t n_from;
    qdot_expr *from, *to; /* [n_from] q, q' and parameters set by the event (from) are replaced by their values after it (to) */
    qdot_expr *R, *x;      /* [w] equations R = 0 of the massless coordinates, and their unknowns x */
    size_t *place;         /* [w] index of each unknown in (q, q') */
    qdot_expr *A, *b, *at; /* linear system A x = b: A [w x w], b [w], evaluation point [w] */
} jump;

static qdot_expr
value_after_event(const jump *j, qdot_expr e)
{
    return e == QDOT_NIL ? e : qdot_subs(j->pool, e, j->n_from, j->from, j->to);
}

/* Write A and b of A x = b, which are the first n equations R = 0, for the first n unknowns. */
static qdot_status
write_linear_system(const jump *j, size_t n)
{
    for (size_t c = 0; c < n; c++) {
        qdot_expr rest = j->R[c];

        for (size_t k = 0; k < n; k++) {
            const qdot_expr slope = qdot_diff(j->pool, j->R[c], j->x[k]),
                            zero = QDOT_ZERO;

            QDOT_TRY(qdot_pool_check(j->pool));
            for (size_t i = 0; i < n; i++)
                if (qdot_expr_contains(j->pool, slope, j->x[i]))
                    return qdot_fail(
                        QDOT_ENOTBUILT,
                        "not built yet: what follows after the event %.100s from an "
                        "equation that is "
                        "not linear in %.100s%s",
                        j->event->name,
                        qdot_expr_symbol(j->pool,
                                         j->scene->coordinates
                                             .at[j->place[i] % j->scene->coordinates.n])
                            ->name,
                        j->place[i] < j->scene->coordinates.n ? "" : "'");
            j->A[c * n + k] = value_after_event(j, slope);
            rest = rest == QDOT_NIL ? rest : qdot_subs(j->pool, rest, 1, &j->x[k], &zero);
        }
        j->b[c] = qdot_neg(j->pool, value_after_event(j, rest));
    }
    return qdot_pool_check(j->pool);
}

/* Solve the first n equations R = 0 for the first n unknowns. */
static qdot_status
solve_unknowns(const jump *j, size_t n)
{
    const qdot_facts facts = qdot_scene_facts(j->scene);
    bool same = true;
    uint32_t pivot;
    qdot_status status;

    for (size_t c = 0; c < n; c++)
        same = same && value_after_event(j, j->R[c]) == j->R[c];
    if (same)
        return qdot_pool_check(j->pool);
    QDOT_TRY(write_linear_system(j, n));
    status = qdot_solve_linear(j->pool, (uint32_t)n, j->A, j->b, j->at, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        return qdot_fail(status,
                         "after the event %.100s the equations of coordinates without "
                         "mass determine nothing",
                         j->event->name);
    QDOT_TRY(status);
    for (size_t c = 0; c < n; c++)
        j->to[j->place[c]] = j->at[c];
    return QDOT_OK;
}

static size_t
append_unknown(const jump *j, size_t n, qdot_expr R, size_t place)
{
    j->R[n] = R;
    j->place[n] = place;
    j->x[n] = j->from[place];
    return n + 1;
}

/* List q, q' and parameters with the values to which the event's `then` sets them, for later replacement. */
static void
insert_event_values(jump *j)
{
    const size_t n = j->scene->coordinates.n;
    const qdot_event *event = j->event;

    for (size_t i = 0; i < 2 * n; i++)
        j->from[i] = j->to[i] =
            qdot_symbol_jet(j->pool, j->scene->coordinates.at[i % n], i >= n);
    j->n_from = 2 * n;
    for (size_t k = 0; k < event->targets.n; k++) {
        size_t i = 0;

        while (i < 2 * n && j->from[i] != event->targets.at[k])
            i++;
        if (i == 2 * n)
            j->from[i = j->n_from++] = event->targets.at[k];
        j->to[i] = event->values.at[k];
    }
}

static qdot_status
find_values_after_event(jump *j)
{
    const qdot_massless_rows *rows = j->rows;
    const size_t n = j->scene->coordinates.n;
    size_t count = 0;

    insert_event_values(j);
    QDOT_TRY(qdot_pool_check(j->pool));
    for (size_t c = 0; c < rows->w; c++)
        if (rows->of_positions[c])
            count = append_unknown(j, count, rows->G[c], rows->coordinate[c]);
    QDOT_TRY(solve_unknowns(j, count));
    count = 0;
    for (size_t c = 0; c < rows->w; c++)
        count = append_unknown(
            j, count, rows->of_positions[c] ? qdot_ddt(j->pool, rows->G[c]) : rows->G[c],
            n + rows->coordinate[c]);
    QDOT_TRY(qdot_pool_check(j->pool));
    return solve_unknowns(j, count);
}

qdot_status
qdot_massless_jump(const qdot_scene *scene, const qdot_event *event,
                   const qdot_massless_rows *rows, qdot_expr *after)
{
    const size_t n = scene->coordinates.n, w = rows->w, most = 2 * n + event->targets.n;
    jump j = {.scene = scene, .event = event, .rows = rows, .pool = scene->pool};
    qdot_expr *room = qdot_calloc(2 * most + w * w + 4 * w + 1, sizeof *room);
    qdot_status status = QDOT_ENOMEM;

    j.place = qdot_calloc(w + 1, sizeof *j.place);
    if (room != NULL && j.place != NULL) {
        j.from = room;
        j.to = j.from + most;
        j.R = j.to + most;
        j.x = j.R + w;
        j.b = j.x + w;
        j.at = j.b + w;
        j.A = j.at + w;
        status = find_values_after_event(&j);
    }
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++)
        after[i] = j.to[i];
    qdot_free(room);
    qdot_free(j.place);
    return status;
}
