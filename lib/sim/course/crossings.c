/* crossings.c -- finds the roots of a function along a stored run. */
#include "sim/course/crossings.h"

#include <math.h>

#include "sim/model/repeated-zeros.h"
#include "sim/watch/watch.h"

typedef struct {
    const qdot_course *c;
    qdot_repeated zeros; /* smooth functions with the zeros of g (repeated-zeros.h) */
    const double *limits;
    double direction;
    qdot_trajectory_cursor *cursor;
    qdot_watch **watches; /* [modes] root finders; each is made when its mode is met */
    size_t piece;
    int sign;   /* sign of the function g since the last root */
    int before; /* that at the end of the piece before, which tells whether a zero at the start of the
                   next is a root; 0: unknown, or the state jumped */
    qdot_crossings *out;
    double lost; /* time from which roots are unknown because of rounding; NaN: all are known */
} search;

static qdot_status
read_stored_state(double t, double *y, void *user)
{
    const search *s = user;

    return qdot_trajectory_read_piece(s->cursor, s->piece, t, y);
}

static qdot_status
record_root(search *s, const qdot_root *root)
{
    const double t = root->t;
    const qdot_trajectory *tr = &s->c->tr;
    const double *const limits = s->limits;
    const bool to_end = limits[1] == tr->t[tr->count - 1];
    const int along = s->direction > 0 ? qdot_root_way(root) : -qdot_root_way(root),
              way = s->zeros.touches ? 0 : along;

    if (s->direction * (t - limits[0]) < 0
        || (to_end ? s->direction * (t - limits[1]) > 0 : s->direction * (t - limits[1]) >= 0))
        return QDOT_OK;
    return qdot_vec_push(s->out, ((qdot_crossing){t, -s->direction * root->late, s->piece, way}));
}

/* Find the roots of g in the step from stored point k; `last`: the next piece starts from another state. */
static qdot_status
search_step(search *s, qdot_watch *w, size_t k, bool last)
{
    const qdot_trajectory *tr = &s->c->tr;
    const qdot_root *roots;
    size_t n;

    const qdot_status status =
        qdot_watch_step(w, tr->t[k + 1], tr->y + (k + 1) * tr->n, last, NULL, &roots, &n);

    if (status == QDOT_EFAILED) { /* ignore this failure: only rounding is left to be searched */
        s->lost = tr->t[k];
        return QDOT_OK;
    }
    QDOT_TRY(status);
    if (qdot_watch_first(w)[0] != 0)
        s->sign = qdot_watch_first(w)[0];
    for (size_t i = 0; i < n; i++) {
        s->sign = roots[i].stays ? 0 : roots[i].way != 0 ? roots[i].way : s->sign;
        if (!roots[i].pole)
            QDOT_TRY(record_root(s, &roots[i]));
    }
    return QDOT_OK;
}

static qdot_status
search_piece_for_roots(search *s)
{
    const qdot_trajectory *tr = &s->c->tr;
    const size_t mode = tr->pieces.at[s->piece].mode;
    const size_t last = qdot_trajectory_last_of(tr, s->piece);
    const bool final = s->piece + 1 == tr->pieces.n,
               jumps = !final && tr->pieces.at[s->piece + 1].jumped;
    const qdot_watch_reader reader = {read_stored_state, NULL, s, true, qdot_course_systems(s->c) + mode,
                                      NULL};
    size_t k = tr->pieces.at[s->piece].first;
    qdot_watch *w = s->watches[mode];
    bool on;

    while (k + 1 < last && s->direction * (tr->t[k + 1] - s->limits[0]) < 0) {
        k++;
        s->before = 0;
    }
    if (k >= last || s->direction * (tr->t[k] - s->limits[1]) > 0)
        return QDOT_OK;
    if (w == NULL) {
        QDOT_TRY(qdot_watch_new(s->c->stage->modes.at[mode]->plan, 1, &s->zeros.u, s->c->shaken,
                                s->c->touch_tol, &s->watches[mode]));
        w = s->watches[mode];
        qdot_watch_may_be_flat(w, 0);
        QDOT_TRY(qdot_watch_turns(w, 0, s->zeros.turn, s->zeros.half));
    }
    qdot_watch_may_fade(w, 0, !qdot_sliding_is(&s->c->stage->switches, s->c->stage->modes.at[mode]->side));
    QDOT_TRY(qdot_watch_begin(w, &reader, tr->t[k], tr->y + k * tr->n,
                              &(qdot_watch_known){0, false, &s->before, NULL, NULL, NULL, 0}, &on));
    s->sign = 0;
    for (; k < last; k++) {
        if (s->direction * (tr->t[k] - s->limits[1]) > 0)
            return QDOT_OK;
        QDOT_TRY(search_step(s, w, k, k + 1 == last && (final || jumps)));
        if (!isnan(s->lost))
            return QDOT_OK;
        qdot_watch_take(w);
        s->lost = qdot_watch_faded_since(w, 0);
        if (!isnan(s->lost))
            return QDOT_OK;
    }
    s->before = jumps ? 0 : s->sign;
    return QDOT_OK;
}

qdot_status
qdot_crossings_find(const qdot_course *c, qdot_expr g, const double *limits, qdot_crossings *out, double *lost)
{
    const qdot_trajectory *tr = &c->tr;
    const qdot_plan *plan = c->stage->modes.at[0]->plan;
    search s = {.c = c, .limits = limits, .out = out, .lost = NAN};
    qdot_status status;

    s.direction = qdot_trajectory_is_backward(tr) ? -1 : 1;
    QDOT_TRY(qdot_watched_zeros(plan->pool, qdot_plan_substitute(plan, g), &s.zeros));
    s.watches = qdot_calloc(c->systems.n + 1, sizeof *s.watches);
    status = s.watches ? qdot_trajectory_open(tr, qdot_course_systems(c), &s.cursor) : QDOT_ENOMEM;
    for (; s.piece < tr->pieces.n && status == QDOT_OK && isnan(s.lost); s.piece++)
        status = search_piece_for_roots(&s);
    while (!isnan(s.lost) && out->n > 0 && s.direction * (out->at[out->n - 1].t - s.lost) >= 0)
        out->n--;
    *lost = s.lost;
    qdot_trajectory_close(s.cursor);
    for (size_t i = 0; i < c->systems.n && s.watches; i++)
        qdot_watch_free(s.watches[i]);
    qdot_free(s.watches);
    return status;
}
