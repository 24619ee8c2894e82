/* piece-enter.c -- makes the mode that a piece enters, and checks that it can be entered. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "ode/companion.h"
#include "series/taylor.h"
#include "sim/course/piece.h"
#include "sim/model/constraints.h"

qdot_status
qdot_piece_enter(qdot_piece *x)
{
    qdot_course *c = x->c;
    const qdot_mode *m;
    bool made;

    QDOT_TRY(qdot_stage_mode(c->stage, x->side, &x->mode));
    while (c->binds.n <= x->mode) {
        QDOT_TRY(qdot_vec_push(&c->binds, NULL));
        QDOT_TRY(qdot_vec_push(&c->systems, (qdot_ode_system){0}));
        QDOT_TRY(qdot_vec_push(&c->watches, NULL));
    }
    m = qdot_piece_mode(x);
    if (!c->binds.at[x->mode])
        QDOT_TRY(qdot_bind_new(m->plan, c->shaken, &c->binds.at[x->mode]));
    QDOT_TRY(qdot_bind_remember(c->binds.at[x->mode], c->history));
    QDOT_TRY(qdot_bind_scale(c->binds.at[x->mode], c->stage->scales));
    made = m->m > 0 && !c->watches.at[x->mode];
    if (made) {
        QDOT_TRY(qdot_watch_new(m->plan, m->m, m->functions, c->shaken, c->touch_tol, &c->watches.at[x->mode]));
        QDOT_TRY(qdot_bind_add_knots(c->binds.at[x->mode], qdot_watch_tape(c->watches.at[x->mode])));
    }
    c->systems.at[x->mode] = qdot_bind_system(c->binds.at[x->mode]);
    if (c->no_series)
        c->systems.at[x->mode].series = NULL;
    if (!made)
        return QDOT_OK;
    for (size_t i = 0; i < m->m; i++)
        if (m->watched[i].kind == QDOT_WATCH_DOMAIN)
            qdot_watch_is_bound(c->watches.at[x->mode], i, m->watched[i].coordinate,
                                m->watched[i].bound);
    for (size_t i = 0; i < c->stage->events.n; i++) {
        qdot_watch_may_be_flat(c->watches.at[x->mode], i);
        QDOT_TRY(qdot_watch_turns(c->watches.at[x->mode], i, c->stage->events.at[i].turn,
                                  c->stage->events.at[i].half));
    }
    return QDOT_OK;
}

/* A start state that is on no surface u = 0 within this, relative to max(1, |component|), is not near it. */
static const double away = 1e-9;

/* The largest speed at which friction is regularised: of discs that come to rest, twice their
 * radius; of layers. */
static double
largest_layer_width(const qdot_piece *x)
{
    double most = 0;

    for (size_t i = 0; i < x->c->stage->switches.pucks.n; i++)
        most = fmax(most, 2 * x->c->stage->switches.pucks.at[i].radius);
    for (size_t i = 0; i < x->c->stage->switches.surfaces.n; i++)
        most = fmax(most, 2 * x->c->stage->switches.surfaces.at[i].layer);
    return most;
}

qdot_status
qdot_piece_keep(qdot_piece *x, bool *near)
{
    double moved = 0;

    QDOT_TRY(qdot_sliding_rows_keep(&qdot_piece_mode(x)->held, x->n / 2, x->start.t, x->start.y,
                                    &moved));
    if (near)
        *near = moved <= fmax(away, largest_layer_width(x));
    return QDOT_OK;
}

/* --- quantities at the start of a piece ---------------------------------------------- */

bool
qdot_piece_just_noted(const qdot_piece *x, size_t event)
{
    for (size_t i = x->c->occurrences.n; i-- > 0;) {
        const qdot_occurrence *o = &x->c->occurrences.at[i];

        if (fabs(o->t - x->t_act) > 16 * DBL_EPSILON * fabs(x->t_act))
            return false;
        if (o->event == event)
            return true;
    }
    return false;
}

static bool
is_sliding_mode(const qdot_mode *m, size_t surface)
{
    return m->side[surface] == QDOT_SIDE_SLIDES;
}

/* Carry the values of watched functions to the next piece: events and domains keep their indices,
 * surfaces are matched. */
void
qdot_piece_carry(qdot_piece *x)
{
    const qdot_mode *old = x->c->stage->modes.at[x->start.from], *next = qdot_piece_mode(x);
    size_t events = x->c->stage->events.n;

    for (size_t i = 0; i < next->m; i++) {
        x->before[i] = x->start.jumped || i >= events || qdot_piece_just_noted(x, i)
                               || (x->start.followed && x->jumps[i])
                           ? 0
                           : x->signs[i];
        x->residual[i] = -1;
    }
    for (size_t i = 0; i < next->m; i++) { /* while the motion slid along a surface, its u was held at 0 */
        const qdot_watched *w = &next->watched[i];

        if (w->kind == QDOT_WATCH_SURFACE && x->c->stage->switches.surfaces.at[w->index].puck > 0) {
            /* a disc's motion leaves the friction cone exactly where it reaches it */
            if (is_sliding_mode(old, w->index) && w->beyond == QDOT_SIDE_SLIDES
                && next->side[w->index] == QDOT_SIDE_CREEPS && !x->start.jumped) {
                x->residual[i] = 0;
                x->put_aside = true;
            }
            continue;
        }
        if (w->kind == QDOT_WATCH_SURFACE && is_sliding_mode(old, w->index) && !is_sliding_mode(next, w->index)
            && !x->start.jumped && x->c->stage->switches.surfaces.at[w->index].layer == 0) {
            x->residual[i] = 0;
            x->put_aside = true;
        }
    }
    /* after slipping the body sticks: the friction force begins at its limit */
    for (size_t i = 0; i < next->m && x->start.slipped; i++)
        if (next->watched[i].kind == QDOT_WATCH_SURFACE && is_sliding_mode(next, next->watched[i].index))
            x->residual[i] = 0;
    for (size_t i = 0; i < x->c->stage->switches.surfaces.n; i++)
        /* the end of a lasting contact is not an occurrence of the event */
        if (x->c->stage->switches.surfaces.at[i].contact && is_sliding_mode(old, i))
            x->before[x->c->stage->switches.surfaces.at[i].event] = 0;
    for (size_t k = 0; k < x->fired.n; k++) {
        const qdot_root *root = &x->fired.at[k];
        const qdot_watched *w = &old->watched[root->function];

        if (w->kind != QDOT_WATCH_SURFACE) { /* an event, which has been counted already */
            x->before[root->function] = 0;
            x->residual[root->function] = root->residual;
            continue;
        }
        for (size_t i = 0; i < next->m && qdot_piece_has_massless(x); i++)
            if (next->watched[i].kind == QDOT_WATCH_SURFACE && next->watched[i].index == w->index
                /* where sliding begins, the friction force begins at its limit */
                && is_sliding_mode(next, w->index) && !is_sliding_mode(old, w->index))
                x->residual[i] = 0;
        for (size_t i = 0; i < next->m; i++)
            if (next->watched[i].kind == QDOT_WATCH_SURFACE &&
                x->c->stage->switches.surfaces.at[w->index].puck == 0 &&
                next->watched[i].index == w->index && !is_sliding_mode(old, w->index) &&
                !is_sliding_mode(next, w->index) &&
                (next->watched[i].beyond == old->side[w->index] ||
                 old->side[w->index] == next->side[w->index]))
                x->residual[i] = root->residual;
    }
}

/* The start of a piece may be moved by less than this, relative to its components' sizes. */
static const double most_aside = 1e-9;

/* The sizes [n] of the state's components at the start of the piece: the largest so far, or |t|
 * times the rate. */
static qdot_status
find_component_sizes(qdot_piece *x, double *size)
{
    QDOT_TRY(qdot_piece_rates(x, x->mode, size));
    for (size_t i = 0; i < x->n; i++)
        size[i] = fmax(x->largest[i], fabs(x->start.t) * fabs(size[i]));
    return QDOT_OK;
}

qdot_status
qdot_piece_widen_residuals(qdot_piece *x)
{
    const double *g;

    if (!x->put_aside)
        return QDOT_OK;
    QDOT_TRY(find_component_sizes(x, x->y));
    for (size_t i = 0; i < qdot_piece_mode(x)->m; i++) {
        double off, noise;

        /* move positions onto their surfaces, except positions of massless coordinates */
        if (!(x->residual[i] >= 0) || !(qdot_piece_mode(x)->watched[i].velocity || qdot_piece_has_massless(x)))
            continue;
        QDOT_TRY(qdot_watch_measure(qdot_piece_watch(x), &x->reader, x->start.t, x->start.y, &g));
        off = fabs(g[i]);
        QDOT_TRY(qdot_watch_noise_of(qdot_piece_watch(x), x->start.t, x->start.y, x->y, i, &noise));
        if (off <= noise * (most_aside / (4 * DBL_EPSILON)))
            x->residual[i] = fmax(x->residual[i], off);
    }
    return QDOT_OK;
}

/* --- corners of constraints ---------------------------------------------------------- */

/* If the residual in the constraints of the new side is larger than this, the state does not satisfy those of both sides. */
static const double corner = 1e-6;

/* If constraints switch, the state at the end of the piece before must keep those of the new
 * side. At a corner the velocity does not, and the equations do not determine how it changes. */
static qdot_status
turns_at_constraint_corner(qdot_piece *x, bool *corners)
{
    qdot_constrained *held = qdot_bind_held(x->c->binds.at[x->mode]);
    const qdot_mode *old = x->c->stage->modes.at[x->start.from], *now = qdot_piece_mode(x);
    const double enough = corner + 100 * x->options->tol;
    const qdot_constraints_row *row;
    qdot_constrained_residual r;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    *corners = false;
    if (x->start.from == x->mode || !held)
        return QDOT_OK;
    r = qdot_constrained_measure(held, x->start.t, x->start.y);
    *corners = r.position > enough || r.velocity > enough;
    if (!*corners)
        return QDOT_OK;
    for (size_t i = 0; i < x->c->stage->switches.surfaces.n && text.n == 0; i++)
        if (old->side[i] != now->side[i])
            status = qdot_stage_describe(x->c->stage, i, now->side[i], &text);
    row = now->plan->constraints->rows +
          (r.position > enough ? r.worst_position : r.worst_velocity);
    snprintf(x->c->reason, sizeof x->c->reason,
             "stopped at t = %.15g: %s %.60s %s where %.100s, and it is not declared "
             "how the motion continues",
             x->start.t, row->multiplier == QDOT_NIL ? "the" : "constraint", row->name,
             r.position > enough || row->kind != QDOT_HOLONOMIC ? "jumps" : "has a corner",
             qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* --- jumps of T - V ------------------------------------------------------------------ */

/* Evaluate the level function of a mode at the state y with component k (SIZE_MAX: none) changed by a small part. */
static double
level_with_shift(const qdot_mode *m, double t, const double *y, size_t n, size_t k, double *in,
                 double *work)
{
    double level;

    memcpy(in, y, n * sizeof *in);
    in[n] = t;
    if (k != SIZE_MAX)
        in[k] += 0x1p-26 * fmax(1, fabs(in[k]));
    qdot_tape_eval(m->level, in, &level, work);
    return level;
}

/* Whether a surface between two modes depends on the state. The rim of a layer (sim/model/layer.h)
 * is none of them: there T - V jumps by what the layer leaves out. */
static bool
is_wall_between_modes(const qdot_piece *x, const qdot_mode *a, const qdot_mode *b)
{
    const qdot_switches *s = &x->c->stage->switches;

    for (size_t i = 0; i < s->surfaces.n; i++)
        if (a->side[i] != b->side[i]
            && !(s->surfaces.at[i].layer > 0 && (a->side[i] == 0) != (b->side[i] == 0))
            && (qdot_expr_node(s->pool, s->surfaces.at[i].u)->holds
                & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY)))
            return true;
    return false;
}

/* At a surface that depends on time alone T - V may jump, but not the momenta dL/dq', whose rates
 * dL/dq are finite: set c->reason if one jumps by more than differences of T - V err by. */
static void
check_momenta_are_continuous(qdot_piece *x, const qdot_mode *a, const qdot_mode *b, double *in)
{
    const size_t n = x->n / 2;
    const double *y = x->start.followed ? x->bare : x->start.y;

    for (size_t k = n; k < 2 * n && x->c->reason[0] == '\0'; k++) {
        double p[2], size = 0;

        for (int side = 0; side < 2; side++) {
            const qdot_mode *m = side ? b : a;
            const double here = level_with_shift(m, x->start.t, y, x->n, SIZE_MAX, in, in + x->n + 1);
            const double there = level_with_shift(m, x->start.t, y, x->n, k, in, in + x->n + 1);

            p[side] = (there - here) / (in[k] - y[k]);
            size = fmax(size, fmax(fabs(p[side]), fabs(here)));
        }
        if (fabs(p[1] - p[0]) > 1e-6 * size)
            snprintf(x->c->reason, sizeof x->c->reason,
                     "stopped at t = %.15g: the momentum of %s would jump there by %.6g, which is "
                     "an infinite force: an event says what it does, as `event NAME: t = %.6g "
                     "then %s' = ...`",
                     x->start.t, b->plan->names[k - n], p[1] - p[0], x->start.t,
                     b->plan->names[k - n]);
    }
}

/* Set c->reason if T - V jumps across a surface at (t, y) by more than a small change of the
 * state changes it, or a momentum across one in time. */
static qdot_status
check_level_is_continuous(qdot_piece *x)
{
    const qdot_mode *a = x->c->stage->modes.at[x->start.from], *b = qdot_piece_mode(x);
    const size_t n = x->n;
    const double t = x->start.t, *y = x->start.followed ? x->bare : x->start.y;
    size_t work = 1;
    double *in, jump, least = 0;

    if (x->start.from == x->mode || !a->level || !b->level)
        return QDOT_OK;
    work += qdot_tape_work(a->level) + qdot_tape_work(b->level);
    in = qdot_calloc(n + 1 + work, sizeof *in);
    if (!in)
        return QDOT_ENOMEM;
    if (!is_wall_between_modes(x, a, b)) {
        check_momenta_are_continuous(x, a, b, in);
        qdot_free(in);
        return QDOT_OK;
    }
    jump = level_with_shift(b, t, y, n, SIZE_MAX, in, in + n + 1)
           - level_with_shift(a, t, y, n, SIZE_MAX, in, in + n + 1);
    for (size_t k = 0; k <= n; k++)
        for (int side = 0; side < 2; side++) {
            const qdot_mode *m = side ? b : a;

            least += fabs(level_with_shift(m, t, y, n, k, in, in + n + 1)
                          - level_with_shift(m, t, y, n, SIZE_MAX, in, in + n + 1));
        }
    qdot_free(in);
    if (fabs(jump) > least)
        snprintf(x->c->reason, sizeof x->c->reason,
                 "stopped at t = %.15g: T - V jumps there by %.6g, which is an infinite "
                 "force: an event says what it does, as `event NAME: x = 0 then x' = ...`",
                 t, jump);
    return QDOT_OK;
}

/* Record the delay with which the end of the last piece was found, for each root there. */
static void
record_delay(qdot_piece *x)
{
    for (size_t k = x->c->ends.n; k-- > 0 && x->c->ends.at[k].piece + 1 == x->c->tr.pieces.n;)
        x->c->ends.at[k].late = fmax(x->c->ends.at[k].late, x->late);
}

void
qdot_piece_start_at_end(qdot_piece *x)
{
    const qdot_trajectory *tr = &x->c->tr;
    double *y = x->start.y;

    x->start.t = tr->t[tr->count - 1];
    x->start.late = x->start.t_low = 0;
    x->start.on_root = false;
    memcpy(y, tr->y + (tr->count - 1) * x->n, x->n * sizeof *y);
    memcpy(x->start.low_of, y, x->n * sizeof *y);
    memcpy(x->start.low, x->end_low, x->n * sizeof *y);
}

void
qdot_piece_low(const qdot_piece *x, double *low)
{
    for (size_t i = 0; i < x->n; i++)
        low[i] = x->start.y[i] == x->start.low_of[i] ? x->start.low[i] : 0;
}

/* Whether the piece ends because the motion reaches surface i. */
static bool
is_surface_reached(const qdot_piece *x, size_t i)
{
    const qdot_mode *m = qdot_piece_mode(x);
    bool met = false;

    for (size_t k = 0; k < x->crossed.n; k++)
        met |= x->crossed.at[k] == i;
    for (size_t k = 0; k < x->roots.n; k++)
        met |= m->watched[x->roots.at[k].function].kind == QDOT_WATCH_SURFACE
               && m->watched[x->roots.at[k].function].index == i;
    return met;
}

/* Whether in the state y [n] all other switches have the same sides as at the start of the piece. */
static qdot_status
keeps_other_sides(qdot_piece *x, const double *y, bool *alike)
{
    const size_t surfaces = x->c->stage->switches.surfaces.n;
    int64_t *sides = qdot_calloc(2 * surfaces + 1, sizeof *sides);
    qdot_status status = sides ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_stage_sides(x->c->stage, x->start.t, x->start.y, NULL, sides);
    if (status == QDOT_OK)
        status = qdot_stage_sides(x->c->stage, x->start.t, y, NULL, sides + surfaces);
    *alike = status == QDOT_OK;
    for (size_t i = 0; i < surfaces && *alike; i++)
        *alike = sides[i] == sides[surfaces + i] || is_surface_reached(x, i);
    qdot_free(sides);
    return status;
}

/* Move the start to a double-double state [n]; *moved: false if another switch would change its side. */
static qdot_status
move_start_to(qdot_piece *x, const qdot_two *state, bool *moved)
{
    double *y = qdot_malloc((x->n + 1) * sizeof *y);
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    *moved = false;
    for (size_t i = 0; i < x->n && y; i++)
        y[i] = state[i].hi;
    if (status == QDOT_OK)
        status = keeps_other_sides(x, y, moved);
    for (size_t i = 0; i < x->n && *moved; i++) {
        x->start.y[i] = x->start.low_of[i] = state[i].hi;
        x->start.low[i] = state[i].lo;
    }
    if (status == QDOT_OK && !*moved)
        record_delay(x);
    qdot_free(y);
    return status;
}

/* Move the start for a time `time` along the rates of change of a mode; add the result to moved [n]. */
static qdot_status
move_start_along_rates(qdot_piece *x, size_t mode, double time, qdot_two *moved)
{
    double *rate = qdot_malloc((x->n + 1) * sizeof *rate);
    qdot_status status = rate ? qdot_piece_rates(x, mode, rate) : QDOT_ENOMEM;

    for (size_t i = 0; i < x->n && status == QDOT_OK; i++)
        moved[i] = qdot_two_add_double(moved[i], time * rate[i]);
    qdot_free(rate);
    return status;
}

/* Where an event acts, a method that reads states in doubles rounds them, and so do its companions, alike: the state
 * `moved` [n] of a companion is moved by a rounding. That of places may be a drift over many events, for they are always
 * the same; it is up or down without a pattern, in one companion opposite to the other. That of velocities is drawn. */
static void
move_by_rounding_error(const qdot_piece *x, qdot_two *moved)
{
    const size_t places = x->n / 2;

    for (size_t i = 0; i < x->n; i++) {
        const double size = fabs(x->start.y[i]), by = nextafter(size, INFINITY) - size;
        const bool up = i < places ? qdot_companion_moved(1, 1, i, 0) > 1 : qdot_taylor_chance(x->start.t, i) < 0.5;

        if (size != 0)
            moved[i] = qdot_two_add_double(moved[i], (up ? by : -by) * x->c->early);
    }
}

qdot_status
qdot_piece_make_up(qdot_piece *x, size_t before, size_t behind)
{
    const double late = x->direction * fmax(0, x->late + x->c->early * x->blur);
    qdot_two *moved = qdot_malloc((x->n + 1) * sizeof *moved);
    double *low = qdot_malloc((x->n + 1) * sizeof *low);
    qdot_status status = moved && low ? QDOT_OK : QDOT_ENOMEM;
    bool done = false;

    if (status == QDOT_OK)
        qdot_piece_low(x, low);
    for (size_t i = 0; i < x->n && status == QDOT_OK; i++)
        moved[i] = (qdot_two){x->start.y[i], low[i]};
    if (status == QDOT_OK && before != SIZE_MAX)
        status = move_start_along_rates(x, before, -late, moved);
    if (status == QDOT_OK && behind != SIZE_MAX)
        status = move_start_along_rates(x, behind, late, moved);
    if (status == QDOT_OK && behind == SIZE_MAX && !x->has_root &&
        (!x->method->series || x->options->alternates) && !x->c->systems.at[x->mode].project)
        move_by_rounding_error(x, moved);
    if (status == QDOT_OK)
        status = move_start_to(x, moved, &done);
    if (status == QDOT_OK && behind == SIZE_MAX)
        x->start.on_root = done;
    if (status == QDOT_OK)
        x->start.late = done && behind != SIZE_MAX ? fabs(late) : 0;
    if (status == QDOT_OK)
        x->start.t_low = done && behind == SIZE_MAX ? -late : 0;
    qdot_free(moved);
    qdot_free(low);
    return qdot_grave(status);
}

qdot_status
qdot_piece_go_to_root(qdot_piece *x)
{
    const qdot_ode_system *system = &x->c->systems.at[x->mode];
    double by;

    QDOT_TRY(move_start_to(x, x->root, &x->start.on_root));
    if (!system->project) {
        x->start.t_low = x->start.on_root ? -x->direction * x->late : 0;
        return QDOT_OK;
    }
    if (x->start.on_root) {
        QDOT_TRY(system->project(x->start.t, x->start.y, x->start.low, &by, system->user));
        memcpy(x->start.low_of, x->start.y, x->n * sizeof *x->start.y);
    }
    return qdot_piece_make_up(x, x->mode, SIZE_MAX);
}

/* --- the whole transition ------------------------------------------------------------ */

qdot_status
qdot_piece_cross(qdot_piece *x)
{
    bool corners;

    QDOT_TRY(turns_at_constraint_corner(x, &corners));
    if (corners)
        return QDOT_OK;
    /* at the start of the run the motion may be on no definite side of a surface */
    if (!x->start.jumped && !(qdot_piece_has_massless(x) && x->start.t == x->c->tr.t[0]))
        QDOT_TRY(check_level_is_continuous(x));
    if (x->c->reason[0] != '\0')
        return QDOT_OK;
    QDOT_TRY(qdot_piece_check_layers(x));
    if (x->c->reason[0] != '\0')
        return QDOT_OK;
    qdot_piece_carry(x);
    if (x->start.jumped || x->start.from != x->mode)
        QDOT_TRY(qdot_piece_make_up(x, x->start.jumped || x->start.on_root ? SIZE_MAX : x->start.from,
                                    x->mode));
    QDOT_TRY(qdot_piece_keep(x, NULL));
    x->put_aside = true;
    return QDOT_OK;
}
