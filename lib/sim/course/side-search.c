/* side-search.c -- finds the sides of a piece that starts on surfaces.
 *
 * A side is right if the motion with its equations leaves to it: u > 0 after the start with the
 * equations of side 1, u < 0 with those of -1, u = 0 with those of 0; for a floor side k if u
 * rises from k or stays, k - 1 if it falls; that it slides if its share is between -1 and 1. The first
 * step in a mode shows it. Wrong sides are
 * replaced by those to which the motion went; if these were tried before, all combinations of the
 * surfaces in doubt are tried.
 *
 * A crossing has only one continuation. So has a start if u contains no velocity and du/dt is not
 * 0, because du/dt is then the same on both sides. Otherwise other sides may be right as well,
 * and each is tried.
 */
#include "sim/course/piece.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/node.h"
#include "expr/symbol.h"

/* The most surfaces whose sides are uncertain at the same time: 4^4 combinations. */
enum { MOST_DOUBTS = 4 };

/* --- texts of failures --------------------------------------------------------------- */

/* End the run as failed at a surface; c->reason becomes `before`, the surface's description, `behind`. */
static void
fail_at_surface(qdot_piece *x, size_t surface, const char *before, const char *behind)
{
    const qdot_mode *m = qdot_piece_mode(x);
    int64_t side = m->side[surface];

    /* for a switch floor(u): the integer u at which the piece starts */
    for (size_t i = 0; i < m->m; i++)
        if (m->watched[i].kind == QDOT_WATCH_SURFACE && m->watched[i].index == surface
            && x->functions_on[i])
            side = m->side[surface] + (m->watched[i].inside < 0);
    qdot_piece_stop_at(x, surface, side, before, behind);
}

bool
qdot_piece_is_of_the_past(const qdot_piece *x, size_t surface)
{
    const qdot_switches *s = &x->c->stage->switches;

    return x->c->history != NULL && surface < qdot_switches_own(s) &&
           !(qdot_expr_node(s->pool, s->surfaces.at[surface].u)->holds & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY));
}

/* The surface of the first disc about to come to rest; 0 if there is no such disc. */
static size_t
surface_of_resting_disc(const qdot_piece *x)
{
    const qdot_switches *s = &x->c->stage->switches;

    for (size_t i = 0; i < s->pucks.n; i++)
        if (x->side[s->pucks.at[i].surface] == QDOT_SIDE_SLIDES)
            return s->pucks.at[i].surface;
    return 0;
}

static void
report_cannot_slide(qdot_piece *x)
{
    char why[200];
    const size_t surface = x->doubts.n > 0 ? x->doubts.at[0].surface : surface_of_resting_disc(x);

    if (x->c->stage->switches.surfaces.at[surface].puck > 0) {
        fail_at_surface(x, surface, "the motion cannot be followed at", x->hindrance);
        return;
    }
    if (qdot_piece_is_of_the_past(x, surface)) {
        fail_at_surface(x, surface, "the motion cannot be followed at", QDOT_PIECE_PAST_SWITCHES);
        return;
    }
    snprintf(why, sizeof why, ", where the equations switch: both sides lead back to it%s",
             x->hindrance);
    fail_at_surface(x, surface, "the motion would slide along", why);
}

static void
report_ambiguous_sides(qdot_piece *x, size_t surface)
{
    fail_at_surface(x, surface, "on",
                    ", where the equations switch, the motion may continue in more than one way, and "
                    "they do not say which");
}

/* --- the search for the right sides -------------------------------------------------- */

/* Whether the present sides have been tried from this start already; either way they are marked as tried. */
static qdot_status
mark_sides_tried(qdot_piece *x, bool *again)
{
    size_t surfaces = x->c->stage->switches.surfaces.n;

    *again = false;
    for (size_t k = 0; k + surfaces <= x->tried.n && surfaces > 0; k += surfaces)
        *again =
            *again || memcmp(x->tried.at + k, x->side, surfaces * sizeof *x->side) == 0;
    for (size_t i = 0; i < surfaces && !*again; i++)
        QDOT_TRY(qdot_vec_push(&x->tried, x->side[i]));
    return QDOT_OK;
}

/* Set x->side to the k-th combination for the surfaces in doubt, beginning with the sides tried
 * first; *over: there is none. */
static qdot_status
set_side_combination(qdot_piece *x, size_t k, bool *over)
{
    size_t surfaces = x->c->stage->switches.surfaces.n;

    *over = x->doubts.n > MOST_DOUBTS;
    if (*over)
        return QDOT_OK;
    memcpy(x->side, x->tried.at, surfaces * sizeof *x->side);
    for (size_t i = 0; i < x->doubts.n; i++) {
        const qdot_piece_doubt *d = &x->doubts.at[i];

        x->side[d->surface] = d->sides[k % d->n];
        k /= d->n;
    }
    *over = k > 0;
    return qdot_piece_sides(x, x->tried.at);
}

/* Choose the next combination of sides that has not been tried from this start; *over: all have been. */
static qdot_status
choose_next_sides(qdot_piece *x, size_t *k, bool *over)
{
    bool again;

    *over = false;
    QDOT_TRY(mark_sides_tried(x, &again));
    while (again && !*over) {
        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(set_side_combination(x, (*k)++, over));
        if (!*over)
            QDOT_TRY(mark_sides_tried(x, &again));
    }
    return QDOT_OK;
}

/* Enter the mode with x->side; *can: where the motion would slide it may be that it cannot, and
 * x->hindrance says why. */
static qdot_status
enter_sides(qdot_piece *x, bool *can)
{
    const size_t n = x->n;
    double *kept;
    qdot_status status = qdot_piece_enter(x);

    *can = true;
    if (status == QDOT_OK) {
        QDOT_TRY(qdot_piece_pucks(x, can));
        if (!*can) {
            snprintf(x->hindrance, sizeof x->hindrance, ", but a force there drives it on");
            return QDOT_OK;
        }
    }
    if (status == QDOT_OK)
        QDOT_TRY(qdot_piece_follow_massless(x, can));
    if (!*can || !qdot_sliding_is(&x->c->stage->switches, x->side))
        return status;
    if (status != QDOT_OK) {
        *can = false;
        snprintf(x->hindrance, sizeof x->hindrance, ", but %.100s", qdot_last_error()->message);
        return qdot_grave(status);
    }
    kept = qdot_malloc(n * sizeof *kept);
    if (!kept)
        return QDOT_ENOMEM;
    memcpy(kept, x->start.y, n * sizeof *kept);
    status = qdot_piece_keep(x, can);
    if (!*can)
        memcpy(x->start.y, kept, n * sizeof *kept);
    qdot_free(kept);
    return status;
}

/* Copy the start of the piece to y [3n]: the state, its low part, and the state to which the low
 * part belongs. */
static void
save_start(const qdot_piece *x, double *y)
{
    memcpy(y, x->start.y, x->n * sizeof *y);
    memcpy(y + x->n, x->start.low, x->n * sizeof *y);
    memcpy(y + 2 * x->n, x->start.low_of, x->n * sizeof *y);
}

static void
restore_start(qdot_piece *x, const double *y)
{
    memcpy(x->start.y, y, x->n * sizeof *y);
    memcpy(x->start.low, y + x->n, x->n * sizeof *y);
    memcpy(x->start.low_of, y + 2 * x->n, x->n * sizeof *y);
}

/* Integrate this piece of the run with the sides x->side of the surfaces, perhaps only its first step. */
static qdot_status
integrate_on_sides(qdot_piece *x)
{
    QDOT_TRY(qdot_piece_begin(x));
    return qdot_piece_integrate(x);
}

/* Whether the motion leaves to `side` of a surface as well as to the sides found; a mode that
 * cannot be integrated does not count. */
static qdot_status
other_side_fits(qdot_piece *x, const int64_t *held, size_t surface, int64_t side, bool *too)
{
    const size_t surfaces = x->c->stage->switches.surfaces.n;
    qdot_status status;
    bool can;

    *too = false;
    memcpy(x->side, held, surfaces * sizeof *x->side);
    x->side[surface] = side;
    QDOT_TRY(qdot_piece_sides(x, held));
    if (qdot_piece_has_massless(x)) /* massless coordinates have taken the values of the sides found: undo that */
        restore_start(x, x->bare);
    status = enter_sides(x, &can);
    if (status == QDOT_OK && can) {
        qdot_piece_carry(x);
        status = integrate_on_sides(x);
        *too = status == QDOT_OK && x->intent == QDOT_PIECE_RETRIED && x->well
               && x->side[surface] == side;
    }
    return qdot_grave(status);
}

/* Whether u stays 0 with either of two sides of a surface, so that both give the same motion. */
static bool
give_same_motion(int64_t side, int64_t other)
{
    return (side == 0 && other == QDOT_SIDE_SLIDES) || (side == QDOT_SIDE_SLIDES && other == 0);
}

/* Whether the present sides, held [surfaces], are the only ones that fit; if not, c->reason is set. */
static qdot_status
check_sides_are_unique(qdot_piece *x, const int64_t *held)
{
    qdot_vec(qdot_piece_doubt) others = {0};
    qdot_status status = qdot_piece_doubt_open(x);

    for (size_t i = 0; i < x->doubts.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&others, x->doubts.at[i]);
    x->search = QDOT_SIDES_COMPARED;
    for (size_t i = 0; i < others.n && status == QDOT_OK; i++)
        for (size_t k = 1; k < others.at[i].n && status == QDOT_OK; k++) {
            const size_t surface = others.at[i].surface;
            bool too;

            if (give_same_motion(held[surface], others.at[i].sides[k]))
                continue;
            status = other_side_fits(x, held, surface, others.at[i].sides[k], &too);
            if (status == QDOT_OK && too && x->c->reason[0] == '\0')
                report_ambiguous_sides(x, surface);
        }
    qdot_free(others.at);
    return status;
}

/* Compare the sides found with alternatives, then integrate the piece with them. */
static qdot_status
integrate_with_found_sides(qdot_piece *x)
{
    const size_t surfaces = x->c->stage->switches.surfaces.n;
    int64_t *held = qdot_malloc((surfaces + 1) * sizeof *held);
    double *y = qdot_malloc((3 * x->n + 1) * sizeof *y);
    const bool massless = qdot_piece_has_massless(x), followed = x->start.followed;
    qdot_status status = held && y ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(held, x->side, surfaces * sizeof *held);
        save_start(x, y);
        status = check_sides_are_unique(x, held);
        memcpy(x->side, held, surfaces * sizeof *held);
        if (massless) {
            restore_start(x, y);
            x->start.followed = followed;
        }
    }
    qdot_free(held);
    qdot_free(y);
    if (status != QDOT_OK || x->c->reason[0] != '\0')
        return status;
    x->search = QDOT_SIDES_KNOWN;
    QDOT_TRY(qdot_piece_enter(x));
    qdot_piece_carry(x);
    return integrate_on_sides(x);
}

/* Whether a surface in doubt is one of places that the motion crosses, or one that it leaves after it has slid along it
 * as far as its share goes: it goes on to the side to which it led, tried first. */
static bool
is_side_decided(const qdot_piece *x, size_t surface)
{
    const qdot_surface *s = &x->c->stage->switches.surfaces.at[surface];
    const bool slid = x->c->stage->modes.at[x->start.from]->side[surface] == QDOT_SIDE_SLIDES;
    const int64_t first = x->tried.at[surface];
    bool crossed = false;

    for (size_t k = 0; k < x->crossed.n; k++)
        crossed |= x->crossed.at[k] == surface;
    return crossed && (first == 1 || first == -1) && (slid || qdot_piece_is_of_places(x, surface))
           && !s->contact && s->puck == 0 && s->layer == 0;
}

/* No sides fit by the first step, which may be lost in the rounding of what decides: where what is known of the
 * crossing decides, go on by that. *decided: it does. */
static qdot_status
take_side_by_crossing(qdot_piece *x, bool *decided)
{
    const size_t surfaces = x->c->stage->switches.surfaces.n;
    bool can;

    *decided = x->doubts.n > 0 && !x->start.jumped && x->tried.n >= surfaces;
    for (size_t i = 0; i < x->doubts.n && *decided; i++)
        *decided = is_side_decided(x, x->doubts.at[i].surface);
    if (!*decided)
        return QDOT_OK;
    memcpy(x->side, x->tried.at, surfaces * sizeof *x->side);
    restore_start(x, x->bare);
    QDOT_TRY(enter_sides(x, &can));
    *decided = can;
    if (!can)
        return QDOT_OK;
    QDOT_TRY(qdot_piece_cross(x));
    if (x->c->reason[0] != '\0')
        return QDOT_OK;
    x->search = QDOT_SIDES_KNOWN;
    return integrate_on_sides(x);
}

/* The next end of a step that is further away than what rounding makes of a breaking point. */
static double
next_end(const qdot_piece *x)
{
    static const double near = 1e-9;
    const qdot_ode_system *system = &x->c->systems.at[x->mode];
    double end = x->start.t;

    for (int k = 0; k < 8 && fabs(end - x->start.t) <= near * fmax(1, fabs(x->start.t)) && end != x->t1; k++)
        end = qdot_ode_until(system, end, x->t1);
    return end;
}

/* Whether the equations of the present mode and of the one before, at the start, are the same, so that it is of no
 * consequence that the time of the change is known up to rounding only. */
static qdot_status
is_change_continuous(const qdot_piece *x, bool *is)
{
    static const double same = 1e-9;
    double *rates = qdot_malloc((2 * x->n + 1) * sizeof *rates);
    qdot_status status = rates ? qdot_piece_rates(x, x->start.from, rates) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_piece_rates(x, x->mode, rates + x->n);
    *is = status == QDOT_OK;
    for (size_t i = 0; i < x->n && *is; i++)
        *is = fabs(rates[i] - rates[x->n + i]) <= same * fmax(1, fabs(rates[i]));
    qdot_free(rates);
    return qdot_grave(status);
}

/* Whether the equations jump where u of a surface, a function of delayed values, was 0 and leaves 0: the time of that is known up to
 * rounding only, which no companion run shows. c->reason is then set. */
static qdot_status
refuse_jump_of_the_past(qdot_piece *x)
{
    const int64_t *from = x->c->stage->modes.at[x->start.from]->side;
    bool is = true;

    for (size_t i = 0; i < x->c->stage->switches.surfaces.n && is; i++)
        if (qdot_piece_is_of_the_past(x, i) && from[i] == 0 && x->side[i] != 0 && !x->c->stage->switches.surfaces.at[i].steps) {
            QDOT_TRY(is_change_continuous(x, &is));
            if (!is)
                fail_at_surface(x, i, "the motion cannot be followed at", QDOT_PIECE_PAST_SWITCHES);
        }
    return QDOT_OK;
}

/* No sides fit by the first step, as u, a function of delayed values, was 0 up to a breaking point: what u is behind that is known.
 * *decided: it is not 0, and the equations change continuously. */
static qdot_status
take_side_ahead(qdot_piece *x, bool *decided)
{
    const size_t surfaces = x->c->stage->switches.surfaces.n;
    const double until = next_end(x);
    bool can;

    *decided = x->doubts.n > 0 && x->c->history != NULL && x->tried.n >= surfaces;
    if (!*decided)
        return QDOT_OK;
    memcpy(x->side, x->tried.at, surfaces * sizeof *x->side);
    for (size_t i = 0; i < x->doubts.n && *decided; i++) {
        const size_t surface = x->doubts.at[i].surface;
        int sign;

        QDOT_TRY(qdot_stage_sign_ahead(x->c->stage, surface, x->start.t, until, x->bare, x->side, &sign));
        x->side[surface] = sign;
        *decided = sign != 0;
    }
    if (!*decided)
        return QDOT_OK;
    restore_start(x, x->bare);
    QDOT_TRY(enter_sides(x, &can));
    *decided = can;
    if (can)
        QDOT_TRY(is_change_continuous(x, decided));
    if (!*decided)
        return QDOT_OK;
    x->search = QDOT_SIDES_KNOWN;
    return integrate_on_sides(x);
}

static qdot_status
search_sides(qdot_piece *x)
{
    size_t combinations = 0;

    x->tried.n = 0;
    x->doubts.n = 0;
    x->search = QDOT_SIDES_TRIED;
    x->hindrance[0] = '\0';
    x->put_aside = x->start.slipped = false;
    save_start(x, x->bare);
    for (;;) {
        bool over, can;

        QDOT_TRY(qdot_interrupt_check());
        restore_start(x, x->bare);
        QDOT_TRY(choose_next_sides(x, &combinations, &over));
        if (over) {
            bool decided;

            QDOT_TRY(take_side_ahead(x, &decided));
            if (!decided)
                QDOT_TRY(take_side_by_crossing(x, &decided));
            if (!decided)
                report_cannot_slide(x);
            return QDOT_OK;
        }
        QDOT_TRY(enter_sides(x, &can));
        if (!can)
            continue;
        QDOT_TRY(qdot_piece_cross(x));
        if (x->c->reason[0] != '\0')
            return QDOT_OK;
        QDOT_TRY(integrate_on_sides(x));
        if (x->intent != QDOT_PIECE_RETRIED || x->resting != SIZE_MAX)
            return QDOT_OK;
        if (x->well) {
            QDOT_TRY(refuse_jump_of_the_past(x));
            return x->c->reason[0] != '\0' ? QDOT_OK : integrate_with_found_sides(x);
        }
        QDOT_TRY(qdot_piece_sides(x, qdot_piece_mode(x)->side));
    }
}

/* Set c->reason: the motion stays in the contact x->resting, which was not declared as a lasting contact. */
static void
report_resting(qdot_piece *x)
{
    snprintf(x->c->reason, sizeof x->c->reason,
             "stopped at t = %.15g: %s the event %.100s the motion does not leave it: a contact that "
             "lasts is no event",
             x->start.t, x->fired.n > 0 ? "behind" : "starting on",
             x->c->stage->events.at[x->resting].name);
    x->intent = QDOT_PIECE_ENDS;
}

qdot_status
qdot_piece_search(qdot_piece *x)
{
    /* in each round one more contact may last */
    for (size_t k = 0; k <= x->c->stage->switches.contacts; k++) {
        bool lasts, soon;
        const size_t surfaces = x->c->stage->switches.surfaces.n;

        QDOT_TRY(search_sides(x));
        if (x->intent != QDOT_PIECE_RETRIED || x->resting == SIZE_MAX)
            return QDOT_OK;
        if (surfaces > 0)
            memcpy(x->side, qdot_piece_mode(x)->side, surfaces * sizeof *x->side);
        if (!qdot_piece_has_massless(x)) /* restore the start: undo the changes by the rejected piece */
            restore_start(x, x->bare);
        QDOT_TRY(qdot_piece_rest(x, x->resting, x->resting_way, 0, &lasts, &soon));
        if (!lasts)
            break;
    }
    report_resting(x);
    return QDOT_OK;
}
