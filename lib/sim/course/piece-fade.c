/* piece-fade.c -- stops the search for events whose function has decayed below the rounding error
 * of the run. */
#include <float.h>
#include <math.h>

#include "sim/course/piece.h"
#include "sim/model/contact.h"

void
qdot_piece_let_fade(qdot_piece *x)
{
    const qdot_stage *s = x->c->stage;
    const qdot_mode *m = qdot_piece_mode(x);
    /* while the motion slides along a surface, u = 0 is held exactly: u does not decay into rounding */
    const bool held = qdot_sliding_is(&s->switches, x->side);

    for (size_t i = 0; i < m->m; i++) {
        const qdot_watched *w = &m->watched[i];

        const qdot_staged_event *e = w->kind == QDOT_WATCH_EVENT ? &s->events.at[w->index] : NULL;
        size_t contact;

        if (!e)
            continue;
        if (!e->then && !e->stop)
            qdot_watch_may_fade(qdot_piece_watch(x), i, !held && !x->options->leading);
        contact = e->way != 0 ? qdot_contacts_surface(&s->switches, w->index, e->way) : SIZE_MAX;
        qdot_watch_may_hide(qdot_piece_watch(x), i,
                            contact != SIZE_MAX && x->side[contact] != QDOT_SIDE_SLIDES && e->turn == QDOT_NIL
                                && !x->options->leading,
                            e->way, held);
    }
}

/* The latest time span in which rounding hides an event, if it began at `since`; else NULL. */
static qdot_course_faded *
hidden_span_since(qdot_course *c, size_t event, double since)
{
    for (size_t k = c->faded.n; k-- > 0;)
        if (c->faded.at[k].event == event && !c->faded.at[k].touched)
            return c->faded.at[k].from == since ? &c->faded.at[k] : NULL;
    return NULL;
}

/* Remove the occurrences of an event from the time `since` on: those zeros were caused by rounding. */
static void
remove_occurrences_since(qdot_piece *x, size_t event, double since)
{
    size_t n = 0, n_faded = 0;

    for (size_t k = 0; k < x->c->occurrences.n; k++)
        if (x->c->occurrences.at[k].event != event || x->direction * (x->c->occurrences.at[k].t - since) < 0)
            x->c->occurrences.at[n++] = x->c->occurrences.at[k];
    x->c->occurrences.n = n;
    for (size_t k = 0; k < x->c->faded.n; k++) {
        const qdot_course_faded *f = &x->c->faded.at[k];

        if (f->event != event || !f->touched || x->direction * (f->from - since) < 0)
            x->c->faded.at[n_faded++] = *f;
    }
    x->c->faded.n = n_faded;
}

/* Note that rounding hides whether event `event` occurs at the root. */
static qdot_status
append_hidden_occurrence(qdot_piece *x, size_t event, const qdot_root *root)
{
    const double blur = x->direction * root->blur;

    return qdot_vec_push(&x->c->faded, ((qdot_course_faded){event, root->t - blur, root->t + blur, true}));
}

qdot_status
qdot_piece_pass_touch(qdot_piece *x, const qdot_root *root)
{
    const qdot_watched *w = &qdot_piece_mode(x)->watched[root->function];

    if (root->way != 0 || root->pole || w->kind != QDOT_WATCH_EVENT)
        return QDOT_OK;
    if (root->within > 0) { /* a run with a tighter tolerance may find two crossings here, or none */
        x->c->passed_over = fmin(x->c->passed_over > 0 ? x->c->passed_over : INFINITY, root->within);
        return QDOT_OK;
    }
    return x->c->stage->events.at[w->index].undoing ? QDOT_OK : append_hidden_occurrence(x, w->index, root);
}

/* Whether a root lies within what rounding hides about the occurrence of the event before it; one within the tolerance of a
 * touch may be its other crossing, but no second touch. */
static bool
merges_with_earlier_occurrence(const qdot_piece *x, size_t event, const qdot_root *root)
{
    for (size_t k = x->c->occurrences.n; k-- > 0;) {
        const qdot_occurrence *o = &x->c->occurrences.at[k];
        const double apart = fabs(o->t - root->t);

        if (o->event == event)
            return (o->within == 0 || root->way == 0) && apart <= o->blur && apart > 16 * DBL_EPSILON * fabs(root->t);
    }
    return false;
}

qdot_status
qdot_piece_doubt_root(qdot_piece *x, const qdot_root *root)
{
    const qdot_watched *w = &qdot_piece_mode(x)->watched[root->function];
    const bool doubtful =
        w->kind == QDOT_WATCH_EVENT && (root->several || merges_with_earlier_occurrence(x, w->index, root));

    return doubtful ? append_hidden_occurrence(x, w->index, root) : QDOT_OK;
}

qdot_status
qdot_piece_take_faded(qdot_piece *x, double t)
{
    const qdot_mode *m = qdot_piece_mode(x);

    for (size_t i = 0; i < m->m && m->watched[i].kind == QDOT_WATCH_EVENT; i++) {
        const size_t event = m->watched[i].index;
        const double since = qdot_watch_faded_since(qdot_piece_watch(x), i);
        qdot_course_faded *known;

        if (isnan(since))
            continue;
        known = hidden_span_since(x->c, event, since);
        if (known) {
            known->to = t;
            continue;
        }
        remove_occurrences_since(x, event, since);
        QDOT_TRY(qdot_vec_push(&x->c->faded, ((qdot_course_faded){event, since, t, false})));
    }
    x->noted = x->c->occurrences.n;
    x->noted_faded = x->c->faded.n;
    return QDOT_OK;
}
