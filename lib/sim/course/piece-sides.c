/* piece-sides.c -- checks by its first step that a piece stays on the assumed side of each switch. */
#include "sim/course/piece.h"

/* Whether the present side of the surface lies between two thresholds of u: a step of floor(u) or a layer. */
static bool
is_between_thresholds(const qdot_piece *x, size_t surface)
{
    const qdot_surface *s = &x->c->stage->switches.surfaces.at[surface];

    return s->steps || s->layer > 0;
}

/* Whether the function of a surface stays on its side; `first` is its sign just after the start. */
static bool
stays_on_side(const qdot_piece *x, const qdot_watched *w, int first)
{
    const qdot_surface *s = &x->c->stage->switches.surfaces.at[w->index];
    const bool slides = qdot_piece_mode(x)->side[w->index] == QDOT_SIDE_SLIDES;

    if (s->puck > 0 && qdot_piece_mode(x)->side[w->index] == 1)
        return true; /* a sliding disc may start from rest */
    return first == w->inside
           || (first == 0 && ((w->inside == 1 && is_between_thresholds(x, w->index)) || slides));
}

/* The side of a surface to which the motion went after the start, if it left the present side. */
static int64_t
side_after_start(const qdot_piece *x, const qdot_watched *w, int first)
{
    return is_between_thresholds(x, w->index) || x->c->stage->switches.surfaces.at[w->index].puck > 0 || qdot_piece_mode(x)->side[w->index] == QDOT_SIDE_SLIDES
               ? w->beyond
               : first;
}

qdot_status
qdot_piece_doubt_side(qdot_piece *x, const qdot_watched *w, int first)
{
    const int64_t now = qdot_piece_mode(x)->side[w->index];
    qdot_piece_doubt d = {.surface = w->index, .n = 2, .sides = {now}};

    for (size_t i = 0; i < x->doubts.n; i++)
        if (x->doubts.at[i].surface == w->index)
            return QDOT_OK;
    if (is_between_thresholds(x, w->index) || x->c->stage->switches.surfaces.at[w->index].contact
        || x->c->stage->switches.surfaces.at[w->index].puck > 0) {
        d.sides[1] = side_after_start(x, w, first);
    } else {
        const int64_t others[] = {1, -1, QDOT_SIDE_SLIDES, 0};

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

        if (w->kind != QDOT_WATCH_SURFACE || stays_on_side(x, w, first[i]))
            continue;
        *well = false;
        x->side[w->index] = side_after_start(x, w, first[i]);
        QDOT_TRY(qdot_piece_doubt_side(x, w, first[i]));
    }
    return QDOT_OK;
}

static bool
is_crossed_at_start(const qdot_piece *x, size_t surface)
{
    for (size_t k = 0; k < x->crossed.n; k++)
        if (x->crossed.at[k] == surface)
            return true;
    return false;
}

/* Whether watched function i leaves open that other sides of the surfaces than those of the mode also fit. */
static bool
allows_other_sides(const qdot_piece *x, size_t i)
{
    const qdot_watched *w = &qdot_piece_mode(x)->watched[i];

    return w->kind == QDOT_WATCH_SURFACE && x->functions_on[i]
           && x->c->stage->switches.surfaces.at[w->index].puck == 0
           && !is_crossed_at_start(x, w->index)
           && (w->velocity || qdot_watch_slow(qdot_piece_watch(x))[i]
               || qdot_watch_first(qdot_piece_watch(x))[i] == 0);
}

bool
qdot_piece_is_open(const qdot_piece *x)
{
    for (size_t i = 0; i < qdot_piece_mode(x)->m; i++)
        if (allows_other_sides(x, i))
            return true;
    return false;
}

qdot_status
qdot_piece_doubt_open(qdot_piece *x)
{
    const qdot_mode *m = qdot_piece_mode(x);

    x->doubts.n = 0;
    for (size_t i = 0; i < m->m; i++)
        if (allows_other_sides(x, i))
            QDOT_TRY(qdot_piece_doubt_side(x, &m->watched[i], -m->watched[i].inside));
    return QDOT_OK;
}
