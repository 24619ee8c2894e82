/* piece-sides.c -- checks by its first step that a piece stays on the assumed side of each switch. */
#include "sim/course/piece.h"

/* Whether a side of the surface lies between two thresholds. */
static bool
is_step(const qdot_piece *x, size_t surface)
{
    const qdot_surface *s = &x->c->stage->switches.surfaces.at[surface];

    return s->steps || s->layer > 0;
}

/* Whether a function of a surface keeps its sign, judged by the sign just after the start. */
static bool
keeps(const qdot_piece *x, const qdot_watched *w, int first)
{
    const qdot_surface *s = &x->c->stage->switches.surfaces.at[w->index];
    const bool slides = qdot_piece_mode(x)->side[w->index] == QDOT_SIDE_SLIDES;

    if (s->puck > 0 && qdot_piece_mode(x)->side[w->index] == 1)
        return true; /* a sliding disc may start from rest */
    return first == w->inside
           || (first == 0 && ((w->inside == 1 && is_step(x, w->index)) || slides));
}

/* The side to which the motion went, if that is not the present one. */
static long
went_to(const qdot_piece *x, const qdot_watched *w, int first)
{
    return is_step(x, w->index) || x->c->stage->switches.surfaces.at[w->index].puck > 0 || qdot_piece_mode(x)->side[w->index] == QDOT_SIDE_SLIDES
               ? w->beyond
               : first;
}

qdot_status
qdot_piece_doubt_side(qdot_piece *x, const qdot_watched *w, int first)
{
    const long now = qdot_piece_mode(x)->side[w->index];
    qdot_piece_doubt d = {.surface = w->index, .n = 2, .sides = {now}};

    for (size_t i = 0; i < x->doubts.n; i++)
        if (x->doubts.at[i].surface == w->index)
            return QDOT_OK;
    if (is_step(x, w->index) || x->c->stage->switches.surfaces.at[w->index].contact
        || x->c->stage->switches.surfaces.at[w->index].puck > 0) {
        d.sides[1] = went_to(x, w, first);
    } else {
        const long others[] = {1, -1, QDOT_SIDE_SLIDES, 0};

        d.n = 1;
        for (size_t i = 0; i < sizeof others / sizeof *others; i++)
            if (others[i] != now)
                d.sides[d.n++] = others[i];
    }
    return qdot_vec_push(&x->doubts, d);
}

qdot_status
qdot_piece_leaves_well(qdot_piece *x, bool *well)
{
    const int *first = qdot_watch_first(qdot_piece_watch(x));
    const qdot_mode *m = qdot_piece_mode(x);

    *well = true;
    for (size_t i = 0; i < m->m; i++) {
        const qdot_watched *w = &m->watched[i];

        if (w->kind != QDOT_WATCH_SURFACE || keeps(x, w, first[i]))
            continue;
        *well = false;
        x->side[w->index] = went_to(x, w, first[i]);
        QDOT_TRY(qdot_piece_doubt_side(x, w, first[i]));
    }
    return QDOT_OK;
}

static bool
was_crossed(const qdot_piece *x, size_t surface)
{
    for (size_t k = 0; k < x->crossed.n; k++)
        if (x->crossed.at[k] == surface)
            return true;
    return false;
}

/* Whether function i leaves it undecided whether other sides than those of the mode also fit. */
static bool
is_open(const qdot_piece *x, size_t i)
{
    const qdot_watched *w = &qdot_piece_mode(x)->watched[i];

    return w->kind == QDOT_WATCH_SURFACE && x->functions_on[i]
           && x->c->stage->switches.surfaces.at[w->index].puck == 0
           && !was_crossed(x, w->index)
           && (w->velocity || qdot_watch_slow(qdot_piece_watch(x))[i]
               || qdot_watch_first(qdot_piece_watch(x))[i] == 0);
}

bool
qdot_piece_is_open(const qdot_piece *x)
{
    for (size_t i = 0; i < qdot_piece_mode(x)->m; i++)
        if (is_open(x, i))
            return true;
    return false;
}

qdot_status
qdot_piece_doubt_open(qdot_piece *x)
{
    const qdot_mode *m = qdot_piece_mode(x);

    x->doubts.n = 0;
    for (size_t i = 0; i < m->m; i++)
        if (is_open(x, i))
            QDOT_TRY(qdot_piece_doubt_side(x, &m->watched[i], -m->watched[i].inside));
    return QDOT_OK;
}
