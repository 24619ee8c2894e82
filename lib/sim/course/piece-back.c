/* piece-back.c -- events of a run that goes back in time: whether one has just occurred where its function is 0, and
 * what was before it (sim/model/undone.h).
 *
 * Where the state after the event is known, the one before it must meet the event the way that its statement says. Of
 * an event that only rises or falls the motion may also have crossed there the other way, without it: the event counts,
 * for only then does a run back go the way that a run has come. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "sim/course/piece.h"

/* A rate is 0 if it is below this many rounding errors of the velocities, a bounce if its height is
 * below this many of the positions. */
static const double roundings = 16;
/* Applied to the state found for before the event, the event must give the state behind it, up to this part of its
 * size. */
static const double alike = 1e-9;

typedef enum {
    PASSES, /* the event did not occur, and the motion continues */
    UNDONE,
    LOST,  /* the event may have occurred, but the state before it cannot be determined */
    RESTS, /* the motion may have been at rest at the event for an unknown time */
    NEVER  /* no motion arrives here forward in time: the event would have changed it */
} verdict;

/* The derivatives g' and g'' of the event's function g at a state [n], and rounding errors of g' and g. */
typedef struct {
    double rate, bend, noise, size;
} pace;

static qdot_status
find_event_derivatives(qdot_piece *x, const qdot_staged_event *e, double t, const double *y, pace *to)
{
    const qdot_plan *p = qdot_piece_mode(x)->plan;
    const size_t n = x->n / 2, inputs = qdot_plan_inputs(p);
    const qdot_tape *tape = e->undoing->rates;
    double *in = qdot_calloc(inputs + n + 2 + qdot_tape_work(tape), sizeof *in), *out = in + inputs;
    qdot_status status = in ? QDOT_OK : QDOT_ENOMEM;

    *to = (pace){0};
    if (status == QDOT_OK) {
        memcpy(in, y, x->n * sizeof *in);
        in[x->n] = t;
        status = qdot_bind_accelerations(&x->c->systems.at[x->mode], t, y, in + x->n + 1);
    }
    if (status == QDOT_OK) {
        qdot_tape_eval(tape, in, out, out + n + 2);
        to->rate = out[0];
        to->bend = out[1];
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        to->noise += roundings * DBL_EPSILON * fabs(out[2 + i]) * x->largest[n + i];
        to->size += roundings * DBL_EPSILON * fabs(out[2 + i]) * x->largest[i];
    }
    qdot_free(in);
    return status;
}

/* Whether a bounce that begins or ends with the rate g' is too low to be distinguished from rest. */
static bool
is_indistinguishable_from_rest(const pace *of)
{
    return fabs(of->rate) <= of->noise || (of->bend != 0 && of->rate * of->rate <= 2 * fabs(of->bend) * of->size);
}

/* The state y [n] before the event, from the state `behind` after it; *fits: the event maps y back
 * to `behind`. */
static qdot_status
find_state_before_event(qdot_piece *x, const qdot_staged_event *e, double t, const double *behind, double *y, bool *fits)
{
    const qdot_staged_event *forward = e->undoing->forward;
    double *again = qdot_malloc(x->n * sizeof *again);
    qdot_status status = again ? QDOT_OK : QDOT_ENOMEM;

    *fits = true;
    memcpy(y, behind, x->n * sizeof *y);
    if (status == QDOT_OK && e->then)
        status = qdot_piece_change(x, e, t, behind, NULL, y, NULL);
    if (status == QDOT_OK) {
        memcpy(again, y, x->n * sizeof *y);
        status = qdot_piece_change(x, forward, t, y, NULL, again, NULL);
    }
    for (size_t i = 0; i < x->n && status == QDOT_OK; i++)
        *fits = *fits && fabs(again[i] - behind[i]) <= alike * fmax(fmax(1, x->largest[i]), fabs(y[i]));
    qdot_free(again);
    return status;
}

/* Where the function of event e is 0, at a state y behind it that its own function crosses the way `plain` as t grows:
 * *way is that before the event. */
static qdot_status
judge_event_backwards(qdot_piece *x, const qdot_staged_event *e, double t, const double *y, int plain, int *way, verdict *is)
{
    const qdot_staged_undoing *u = e->undoing;
    double *before;
    pace a, b;
    bool fits;
    qdot_status status;

    *way = e->way;
    *is = LOST;
    if (u->why) {
        if (u->keeps_speed && e->way != 0 && plain != e->way)
            *is = PASSES;
        return QDOT_OK;
    }
    before = qdot_malloc(x->n * sizeof *before);
    status = before ? find_state_before_event(x, e, t, y, before, &fits) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = find_event_derivatives(x, e, t, before, &a);
    if (status == QDOT_OK)
        status = find_event_derivatives(x, e, t, y, &b);
    qdot_free(before);
    QDOT_TRY(status);
    *way = fabs(a.rate) <= a.noise ? 0 : a.rate > 0 ? 1 : -1;
    if (!u->moved && !u->keeps_speed && is_indistinguishable_from_rest(&a) && is_indistinguishable_from_rest(&b)
        && (e->way != 0 ? a.bend * e->way > 0 : a.bend * *way >= 0))
        *is = RESTS;
    else if (e->way == 0 || *way == e->way)
        *is = fits ? UNDONE : LOST;
    else
        *is = plain == e->way && !u->moved ? NEVER : PASSES;
    return QDOT_OK;
}

static int
direction_of_root(const qdot_piece *x, const qdot_root *root)
{
    return (int)x->direction * qdot_root_way(root);
}

bool
qdot_piece_is_undone(qdot_piece *x, const qdot_root *root, int *way)
{
    const qdot_staged_event *e = &x->c->stage->events.at[qdot_piece_mode(x)->watched[root->function].index];
    double *y = qdot_malloc(x->n * sizeof *y);
    verdict is = UNDONE;
    qdot_status status = y ? x->reader.read(root->t, y, x->reader.user) : QDOT_ENOMEM;

    *way = e->way;
    if (status == QDOT_OK)
        status = judge_event_backwards(x, e, root->t, y, direction_of_root(x, root), way, &is);
    qdot_free(y);
    return status != QDOT_OK || is != PASSES; /* ignore a failure here: it is reported when the event is carried out */
}

qdot_status
qdot_piece_undone_at_start(qdot_piece *x, size_t i, bool *acts)
{
    const qdot_staged_event *e = &x->c->stage->events.at[i];
    const int first = qdot_watch_first(qdot_piece_watch(x))[i];
    verdict is;
    int way;

    *acts = false;
    if (!x->functions_on[i])
        return QDOT_OK;
    QDOT_TRY(judge_event_backwards(x, e, x->start.t, x->start.y, (int)x->direction * first, &way, &is));
    *acts = is == RESTS || (is == UNDONE && e->way != 0 && first != 0 && !e->undoing->keeps_speed);
    return QDOT_OK;
}

qdot_status
qdot_piece_check_undone(qdot_piece *x, const qdot_root *root)
{
    static const char *const words[] = {
        [LOST] = "what was before the event %.100s cannot be known: %s",
        [RESTS] = "the motion may have rested on %.100s for any time before, and by which bounces it came to that "
                  "cannot be known%s",
        [NEVER] = "no motion comes here: the event %.100s would have changed it%s",
    };
    const qdot_staged_event *e = &x->c->stage->events.at[qdot_piece_mode(x)->watched[root->function].index];
    verdict is;
    int way, at;

    QDOT_TRY(judge_event_backwards(x, e, x->t_act, x->start.y, direction_of_root(x, root), &way, &is));
    if (is != LOST && is != RESTS && is != NEVER)
        return QDOT_OK;
    while (x->c->occurrences.n > 0 && x->c->occurrences.at[x->c->occurrences.n - 1].t == x->t_act)
        x->c->occurrences.n--; /* remove the occurrences at this time: it is not known whether they took place */
    at = snprintf(x->c->reason, sizeof x->c->reason, "stopped at t = %.15g: ", x->t_act);
    snprintf(x->c->reason + at, sizeof x->c->reason - (size_t)at, words[is], e->name,
             is != LOST         ? ""
             : e->undoing->why  ? e->undoing->why
                                : "the constraints take part in what it does");
    return QDOT_OK;
}

bool
qdot_piece_stop_nowhere(qdot_piece *x)
{
    for (size_t i = 0; i < x->c->stage->events.n; i++) {
        const qdot_staged_event *e = &x->c->stage->events.at[i];

        if (!e->undoing || !e->undoing->nowhere)
            continue;
        snprintf(x->c->reason, sizeof x->c->reason,
                 "stopped at t = %.15g: when the event %.100s was, back in time, cannot be known: %s", x->start.t,
                 e->name, e->undoing->why);
        qdot_piece_stop(x, true);
        return true;
    }
    return false;
}
