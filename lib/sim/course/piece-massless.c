/* piece-massless.c -- coordinates without mass where a piece goes on by other equations.
 *
 * Their equations f_w = 0 (sim/model/massless.h) determine velocities, or positions. Where f_w jumps these take the
 * values that it asks for behind the switch, and nothing else moves: places with damping, the velocities of masses.
 *
 * A position that jumps by d moves with a velocity of d times infinity for that moment. A switch of velocities must be on
 * the side of this velocity: dry friction holds a slider, unless the jump is the way that its side says. Then it has
 * slipped, whatever it does next: other sides are tried from there.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "sim/course/piece.h"
#include "sim/model/constrained.h"
#include "sim/model/massless.h"

/* Changes smaller than this, relative to the sizes of components, are rounding. */
static const double rounding = 64 * DBL_EPSILON;
/* Positions that move by less than this do not jump: projected states err by the tolerance. */
static const double least_jump = 1e-9;
/* The velocity that represents a jump of length 1. */
static const double very_fast = 0x1p60;

bool
qdot_piece_has_massless(const qdot_piece *x)
{
    return qdot_piece_mode(x)->plan->n_massless > 0;
}

bool
qdot_piece_holds_massless(const qdot_piece *x, size_t surface)
{
    const qdot_plan *p = qdot_piece_mode(x)->plan;

    for (size_t i = 0; i < p->n && p->massless; i++)
        if (p->massless[i]
            && qdot_expr_contains(x->c->stage->switches.pool, x->c->stage->switches.surfaces.at[surface].u, p->inputs[i]))
            return true;
    return false;
}

/* Mark q [n], q' [n] that the equations of the mode leave undetermined: they keep their values.
 * *some: positions are determined. */
static void
mark_kept_components(const qdot_plan *p, bool *kept, bool *some)
{
    *some = false;
    for (size_t i = 0; i < p->n; i++) {
        const bool massless = p->massless[i];

        kept[i] = !massless || qdot_massless_kind(p, i) != QDOT_HOLONOMIC;
        kept[p->n + i] = !massless;
        *some = *some || !kept[i];
    }
}

/* Write jumps from the positions `old` to the present ones into y [2n] as huge velocities; true: there is one. */
static bool
write_jump_velocities(const qdot_piece *x, const double *old, double *y)
{
    const size_t n = x->n / 2;
    bool some = false;

    memcpy(y, x->start.y, x->n * sizeof *y);
    for (size_t i = 0; i < n; i++) {
        const double by = x->start.y[i] - old[i];

        if (fabs(by) <= fmax(least_jump, 100 * x->options->tol) * fmax(x->largest[i], fabs(x->start.y[i])))
            continue;
        y[n + i] = by * very_fast;
        some = true;
    }
    return some;
}

/* Whether u' stays 0 during the jump y [2n] for a surface along which the motion slides; a surface
 * of positions never hinders. */
static qdot_status
slides_through_jump(const qdot_piece *x, size_t surface, const double *y, bool *keeps)
{
    double value;

    if (qdot_piece_is_of_places(x, surface))
        return QDOT_OK;
    QDOT_TRY(qdot_sliding_rows_value(&qdot_piece_mode(x)->held, x->n / 2, x->start.t, y, surface, 1, &value, NULL));
    *keeps = fabs(value) < least_jump * very_fast;
    return QDOT_OK;
}

/* Whether the positions that jump from old [2n], if any, go the way that switches of velocities say; fast [2n], g [2m] and
 * signs [m] are room. */
static qdot_status
check_jump_directions(qdot_piece *x, const double *old, double *fast, double *g, int *signs, bool *can)
{
    const qdot_mode *m = qdot_piece_mode(x);
    bool decided = false;

    if (!write_jump_velocities(x, old, fast))
        return QDOT_OK;
    QDOT_TRY(qdot_watch_look(qdot_piece_watch(x), x->start.t, x->start.y, NULL, signs, g, NULL));
    QDOT_TRY(qdot_watch_look(qdot_piece_watch(x), x->start.t, fast, NULL, signs, g + m->m, NULL));
    for (size_t i = 0; i < m->m; i++) {
        const qdot_watched *w = &m->watched[i];
        bool fits = true;

        if (w->kind != QDOT_WATCH_SURFACE || !w->velocity)
            continue;
        if (m->side[w->index] == QDOT_SIDE_SLIDES)
            QDOT_TRY(slides_through_jump(x, w->index, fast, &fits));
        else
            fits = g[i] == g[m->m + i] || signs[i] == w->inside;
        decided = decided || g[i] != g[m->m + i];
        if (!fits)
            QDOT_TRY(qdot_piece_doubt_side(x, w, -w->inside));
        *can = *can && fits;
    }
    if (*can && decided) {
        x->tried.n = x->start.slipped ? x->tried.n : 0; /* sides of switches that were rejected before may fit the new state */
        x->start.slipped = true;
        memcpy(x->bare, x->start.y, x->n * sizeof *x->bare);
    }
    return QDOT_OK;
}

/* Set x->jumps for the watched functions whose values differ from those at old [2n]; g [2m], signs
 * [m] are work space. */
static qdot_status
find_function_jumps(qdot_piece *x, const double *old, double *g, int *signs)
{
    const size_t m = qdot_piece_mode(x)->m;

    QDOT_TRY(qdot_watch_look(qdot_piece_watch(x), x->start.t, old, NULL, signs, g, NULL));
    QDOT_TRY(qdot_watch_look(qdot_piece_watch(x), x->start.t, x->start.y, NULL, signs, g + m, NULL));
    for (size_t i = 0; i < m; i++)
        x->jumps[i] = g[i] != g[m + i] || (x->start.slipped && x->jumps[i]);
    return QDOT_OK;
}

/* Note that the equations have no solution: mark each switch whose side has changed as uncertain. */
static qdot_status
doubt_changed_switches(qdot_piece *x)
{
    const qdot_mode *m = qdot_piece_mode(x);
    const int64_t *old = x->c->stage->modes.at[x->start.from]->side;

    for (size_t i = 0; i < m->m; i++)
        if (m->watched[i].kind == QDOT_WATCH_SURFACE && old[m->watched[i].index] != m->side[m->watched[i].index])
            QDOT_TRY(qdot_piece_doubt_side(x, &m->watched[i], -m->watched[i].inside));
    return QDOT_OK;
}

/* Move the start onto the equations of the mode; kept, low: [2n]. *can: whether a solution exists. */
static qdot_status
solve_massless_equations(qdot_piece *x, bool begins, const bool *kept, bool positions, double *low, bool *can)
{
    const qdot_ode_system *from = &x->c->systems.at[x->start.from];
    qdot_constrained *held = qdot_bind_held(x->c->binds.at[x->mode]);
    const size_t n = x->n / 2;
    double by;
    qdot_status status;

    qdot_piece_low(x, low);
    if (!begins && !x->has_root && from->project) /* remove the constraint error that a step of the integration method leaves */
        QDOT_TRY(from->project(x->start.t, x->start.y, low, &by, from->user));
    status = qdot_constrained_put(held, x->start.t, x->start.t_low, x->start.y, low, positions ? kept : NULL, kept + n,
                                  "a switch");
    *can = status == QDOT_OK;
    if (*can) {
        memcpy(x->start.low, low, x->n * sizeof *low);
        memcpy(x->start.low_of, x->start.y, x->n * sizeof *low);
    }
    return qdot_grave(status);
}

qdot_status
qdot_piece_follow_massless(qdot_piece *x, bool *can)
{
    const qdot_mode *m = qdot_piece_mode(x);
    const size_t n = x->n;
    const bool begins = x->start.t == x->c->tr.t[0]; /* the start of the run, where the user may have given the values */
    double *old;
    int *signs;
    bool *kept, positions;
    qdot_status status;

    *can = true;
    x->start.followed = x->start.slipped && !begins;
    if ((x->mode == x->start.from && !begins) || m->plan->n_massless == 0)
        return QDOT_OK;
    old = qdot_malloc((3 * n + 2 * m->m + 1) * sizeof *old);
    signs = qdot_malloc((m->m + 1) * sizeof *signs);
    kept = qdot_malloc((n + 1) * sizeof *kept);
    status = old && signs && kept ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        memcpy(old, x->start.y, n * sizeof *old);
        mark_kept_components(m->plan, kept, &positions);
        status = solve_massless_equations(x, begins, kept, positions, old + n, can);
    }
    if (status == QDOT_OK && !*can)
        status = doubt_changed_switches(x);
    else if (status == QDOT_OK && m->m > 0)
        status = check_jump_directions(x, old, old + n, old + 3 * n, signs, can);
    for (size_t i = 0; i < n && status == QDOT_OK && !begins; i++)
        x->start.followed |= fabs(x->start.y[i] - old[i]) > rounding * fmax(x->largest[i], fabs(x->start.y[i]));
    if (status == QDOT_OK && x->start.followed && m->m > 0)
        status = find_function_jumps(x, old, old + 3 * n, signs);
    if (status == QDOT_OK && !*can) {
        memcpy(x->start.y, old, n * sizeof *old);
        snprintf(x->hindrance, sizeof x->hindrance, ", and coordinates without mass have nowhere to go there");
    }
    qdot_free(old);
    qdot_free(signs);
    qdot_free(kept);
    return status;
}

/* Whether a surface's function u depends on time alone. */
static bool
depends_on_time(const qdot_piece *x, size_t surface)
{
    const qdot_switches *s = &x->c->stage->switches;

    return (qdot_expr_node(s->pool, s->surfaces.at[surface].u)->holds
            & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
           == 0;
}

qdot_status
qdot_piece_end_behind(qdot_piece *x)
{
    const size_t own = qdot_switches_own(&x->c->stage->switches);
    const int64_t *old = x->c->stage->modes.at[x->start.from]->side;
    bool switches = false, can;

    if (own == 0 || !qdot_piece_has_massless(x))
        return QDOT_OK;
    QDOT_TRY(qdot_piece_sides(x, NULL));
    for (size_t i = 0; i < own; i++) {
        x->side[i] = depends_on_time(x, i) ? x->side[i] : old[i];
        switches = switches || x->side[i] != old[i];
    }
    if (!switches)
        return QDOT_OK;
    QDOT_TRY(qdot_piece_enter(x));
    QDOT_TRY(qdot_piece_follow_massless(x, &can));
    x->start.jumped = x->start.jumped || x->start.followed;
    return QDOT_OK;
}
