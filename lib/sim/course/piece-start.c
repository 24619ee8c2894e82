/* piece-start.c -- where a piece starts: bounds that are passed, contacts that last and events that occur at once. */
#include "sim/course/piece.h"

#include <float.h>
#include <math.h>

const qdot_watched *
qdot_piece_bound_at_start(qdot_piece *x)
{
    const int *first = qdot_watch_first(qdot_piece_watch(x));
    const qdot_mode *m = qdot_piece_mode(x);

    for (size_t i = 0; i < m->m; i++)
        if (m->watched[i].kind == QDOT_WATCH_DOMAIN && x->functions_on[i] &&
            first[i] == -m->watched[i].inside)
            return &m->watched[i];
    return NULL;
}

/* If the run ends within this fraction of t after the start of a piece, a watched function cannot leave 0. */
static const double no_time = 64 * DBL_EPSILON;

/* Whether the motion stays on the zero of event i with a `then`: it leaves it so slowly that rounding
 * decides when, and to the side `way`, to which the event occurs. */
static bool
stays_at_zero(const qdot_piece *x, size_t i, int way)
{
    const qdot_watched *w =
        i < x->c->stage->events.n ? &qdot_piece_mode(x)->watched[i] : NULL;

    return w && way != 0 && x->c->stage->events.at[w->index].then && !x->c->stage->back && x->functions_on[i]
           && fabs(x->t1 - x->start.t) > no_time * fabs(x->t1) && qdot_watch_slow(qdot_piece_watch(x))[i]
           && qdot_watch_first(qdot_piece_watch(x))[i] == way && !qdot_piece_has_crossed_flatly(x, i);
}

bool
qdot_piece_stays_in_contact(qdot_piece *x)
{
    const bool begins = x->c->tr.count == 1;

    for (size_t k = 0; k < x->fired.n; k++)
        if (stays_at_zero(x, x->fired.at[k].function, x->fired.at[k].way)) {
            x->resting = qdot_piece_mode(x)->watched[x->fired.at[k].function].index;
            x->resting_way = qdot_root_way(&x->fired.at[k]);
            return true;
        }
    for (size_t i = 0; i < x->c->stage->events.n; i++)
        if ((begins || ((x->start.jumped || x->left[i] == 0) && x->touching[i]))
            && stays_at_zero(x, i, qdot_piece_way_asked(x, i))) {
            x->resting = i;
            x->resting_way = (int)x->direction * x->c->stage->events.at[i].way;
            return true;
        }
    return false;
}

/* The piece ends where it starts, by an event, whose function is 0 there but for rounding of the places: in two doubles
 * that is more than rounding of the function. */
static qdot_status
end_piece_at_start(qdot_piece *x, double t0, const qdot_root *root)
{
    qdot_root met = *root;

    x->intent = QDOT_PIECE_ENDS;
    x->t_act = t0;
    if (x->reader.read_two)
        QDOT_TRY(qdot_watch_noise_of(qdot_piece_watch(x), t0, x->start.y, x->largest, root->function, &met.residual));
    QDOT_TRY(qdot_piece_record(x, root));
    return qdot_vec_push(&x->roots, met);
}

/* Whether the piece ends at once by event i, `root` of which is where it starts. Behind a change of the state: an event
 * with an action whose zero was reached at the start, or held until then, and is left at once because another event has
 * changed the state: bodies that touch, or roots that only rounding separates. A zero onto which the change has put the
 * motion does not count. Where a run starts: impacts on what it touches. */
static qdot_status
occurs_at_start(qdot_piece *x, size_t i, const qdot_root *root, bool *acts)
{
    const qdot_staged_event *e = &x->c->stage->events.at[i];
    int way;

    *acts = false;
    if (!x->start.jumped && x->c->tr.count == 1)
        return e->undoing ? qdot_piece_undone_at_start(x, i, acts) : qdot_piece_meets_at_start(x, i, acts);
    if (!x->start.jumped) {
        *acts = qdot_piece_meets_again(x, i) && qdot_piece_is_occurrence(x, root);
        return QDOT_OK;
    }
    if (!qdot_staged_event_acts(e) || !x->untouched[i] || !x->touching[i] || root->way == 0
        || (e->way == 0 && x->left[i] == 0) || !qdot_piece_is_occurrence(x, root))
        return QDOT_OK;
    /* the sign before a rising or falling event may be wrong by rounding: take the opposite sign */
    if (root->way == x->left[i] && (e->way == 0 || qdot_piece_just_noted(x, i)))
        return QDOT_OK;
    QDOT_TRY(qdot_piece_way(x, i, &way));
    *acts = way != 0;
    return QDOT_OK;
}

qdot_status
qdot_piece_events_at_start(qdot_piece *x, double t0)
{
    for (size_t k = 0; k < x->pushed.n; k++) {
        const qdot_surface *contact = &x->c->stage->switches.surfaces.at[x->pushed.at[k]];

        QDOT_TRY(end_piece_at_start(x, t0, &(qdot_root){.function = contact->event,
                                                 .t = t0,
                                                 .way = -contact->reaction,
                                                 .exact = true,
                                                 .late = x->start.late}));
    }
    for (size_t i = 0; i < x->c->stage->events.n && x->pushed.n == 0; i++) {
        const qdot_root root = {.function = i,
                                .t = t0,
                                .way = qdot_watch_first(qdot_piece_watch(x))[i],
                                .exact = true,
                                .turned = qdot_watch_is_turned(qdot_piece_watch(x), t0, x->start.y, i),
                                .late = x->start.late};
        bool acts;

        QDOT_TRY(occurs_at_start(x, i, &root, &acts));
        if (acts)
            QDOT_TRY(end_piece_at_start(x, t0, &root));
    }
    return QDOT_OK;
}
