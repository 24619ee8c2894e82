/* course.c -- the loop over pieces: the mode of each, and how one is left for the next. */
#include "sim/course/course.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "sim/course/piece.h"
#include "sim/model/constraints.h"

/* --- pieces -------------------------------------------------------------------------- */

qdot_status
qdot_piece_enter(qdot_piece *x)
{
    qdot_course *c = x->c;
    const qdot_mode *m;

    QDOT_TRY(qdot_stage_mode(c->stage, x->side, &x->mode));
    while (c->binds.n <= x->mode) {
        QDOT_TRY(qdot_vec_push(&c->binds, NULL));
        QDOT_TRY(qdot_vec_push(&c->systems, (qdot_ode_system){0}));
        QDOT_TRY(qdot_vec_push(&c->watches, NULL));
    }
    m = qdot_piece_mode(x);
    if (!c->binds.at[x->mode])
        QDOT_TRY(qdot_bind_new(m->plan, c->shaken, &c->binds.at[x->mode]));
    c->systems.at[x->mode] = qdot_bind_system(c->binds.at[x->mode]);
    if (c->no_series)
        c->systems.at[x->mode].series = NULL;
    if (m->m == 0 || c->watches.at[x->mode])
        return QDOT_OK;
    QDOT_TRY(qdot_watch_new(m->plan, m->m, m->functions, c->shaken, c->touch_tol,
                            &c->watches.at[x->mode]));
    for (size_t i = 0; i < m->m; i++)
        if (m->watched[i].kind == QDOT_WATCH_DOMAIN)
            qdot_watch_is_bound(c->watches.at[x->mode], i, m->watched[i].coordinate,
                                m->watched[i].bound);
    return QDOT_OK;
}

/* Room by the number of functions, which the modes share. */
static qdot_status
make_room(qdot_piece *x)
{
    size_t m = 2 * x->c->stage->switches.surfaces.n + x->c->stage->events.n +
               2 * x->c->stage->domains.n + 1;

    x->side = qdot_calloc(m, sizeof *x->side);
    x->functions_on = qdot_calloc(m, sizeof *x->functions_on);
    x->before = qdot_calloc(m, sizeof *x->before);
    x->residual = qdot_calloc(m, sizeof *x->residual);
    x->signs = qdot_calloc(m, sizeof *x->signs);
    x->y = qdot_calloc(2 * x->n, sizeof *x->y);
    x->step = (qdot_trajectory){.n = x->n,
                                .count = 2,
                                .method = x->method,
                                .tol = x->options->tol,
                                .order_more = x->options->order_more,
                                .entered = true};
    x->step.t = qdot_calloc(2, sizeof *x->step.t);
    x->step.y = qdot_calloc(2 * x->n, sizeof *x->step.y);
    if (!x->side || !x->functions_on || !x->before || !x->residual ||
        !x->signs || !x->y || !x->step.t || !x->step.y)
        return QDOT_ENOMEM;
    x->y_act = x->y + x->n;
    return qdot_vec_push(&x->step.pieces, (qdot_trajectory_piece){0});
}
/* --- what is known where a piece starts ---------------------------------------------- */

/* Whether an event has been counted a double or so before the piece ended. */
static bool
just_noted(const qdot_piece *x, size_t event)
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

/* Events and domains keep their places; a surface's functions are of the one that is on the
 * same place. */
void
qdot_piece_carry(qdot_piece *x, size_t from, bool jumped)
{
    const qdot_mode *old = x->c->stage->modes.at[from], *next = qdot_piece_mode(x);
    size_t events = x->c->stage->events.n;

    for (size_t i = 0; i < next->m; i++) {
        x->before[i] = jumped || i >= events || just_noted(x, i) ? 0 : x->signs[i];
        x->residual[i] = -1;
    }
    for (size_t k = 0; k < x->fired.n; k++) {
        const qdot_root *root = &x->fired.at[k];
        const qdot_watched *w = &old->watched[root->function];

        if (w->kind != QDOT_WATCH_SURFACE) { /* it has been counted */
            x->before[root->function] = 0;
            x->residual[root->function] = root->residual;
            continue;
        }
        for (size_t i = 0; i < next->m; i++)
            if (next->watched[i].kind == QDOT_WATCH_SURFACE &&
                next->watched[i].index == w->index &&
                (next->watched[i].beyond == old->side[w->index] ||
                 old->side[w->index] == next->side[w->index]))
                x->residual[i] = root->residual;
    }
}

/* --- corners of constraints ---------------------------------------------------------- */

/* Beyond it the constraints of two sides are not the same to a state. */
static const double corner = 1e-6;

/* Where constraints switch, the state that the last piece left must fulfil those of the new
 * side: on a corner the velocity does not, and nothing says what becomes of it. */
static qdot_status
turns_a_corner(qdot_piece *x, size_t from, double t, const double *y, bool *corners)
{
    qdot_constrained *held = qdot_bind_held(x->c->binds.at[x->mode]);
    const qdot_mode *old = x->c->stage->modes.at[from], *now = qdot_piece_mode(x);
    const double enough = corner + 100 * x->options->tol;
    const qdot_constraints_row *row;
    qdot_constrained_residual r;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    *corners = false;
    if (from == x->mode || !held)
        return QDOT_OK;
    r = qdot_constrained_measure(held, t, y);
    *corners = r.position > enough || r.velocity > enough;
    if (!*corners)
        return QDOT_OK;
    for (size_t i = 0; i < x->c->stage->switches.surfaces.n && text.n == 0; i++)
        if (old->side[i] != now->side[i])
            status = qdot_stage_describe(x->c->stage, i, now->side[i], &text);
    row = now->plan->constraints->rows +
          (r.position > enough ? r.worst_position : r.worst_velocity);
    snprintf(x->c->reason, sizeof x->c->reason,
             "stopped at t = %.15g: constraint %.60s %s where %.100s, and nothing says how the "
             "motion goes on",
             t, row->name,
             r.position > enough || row->kind != QDOT_HOLONOMIC ? "jumps" : "has a corner",
             qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* --- jumps of T - V ------------------------------------------------------------------ */

/* The level of a mode at a state moved by a part of component k. */
static double
level_at(const qdot_mode *m, double t, const double *y, size_t n, size_t k, double *in,
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

/* Whether a surface lies between two modes that moves with the state: across time alone
 * T - V may jump. */
static bool
is_wall(const qdot_piece *x, const qdot_mode *a, const qdot_mode *b)
{
    const qdot_switches *s = &x->c->stage->switches;

    for (size_t i = 0; i < s->surfaces.n; i++)
        if (a->side[i] != b->side[i]
            && (qdot_expr_node(s->pool, s->surfaces.at[i].u)->holds
                & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY)))
            return true;
    return false;
}

/* c->reason, where T - V is not the same on both sides of a surface, at (t, y): more than
 * moving the state a little makes of it. */
static qdot_status
check_level(qdot_piece *x, size_t from, double t, const double *y)
{
    const qdot_mode *a = x->c->stage->modes.at[from], *b = qdot_piece_mode(x);
    const size_t n = x->n;
    size_t work = 1;
    double *in, jump, least = 0;

    if (from == x->mode || !a->level || !b->level || !is_wall(x, a, b))
        return QDOT_OK;
    work += qdot_tape_work(a->level) + qdot_tape_work(b->level);
    in = qdot_calloc(n + 1 + work, sizeof *in);
    if (!in)
        return QDOT_ENOMEM;
    jump = level_at(b, t, y, n, SIZE_MAX, in, in + n + 1)
           - level_at(a, t, y, n, SIZE_MAX, in, in + n + 1);
    for (size_t k = 0; k <= n; k++)
        for (int side = 0; side < 2; side++) {
            const qdot_mode *m = side ? b : a;

            least += fabs(level_at(m, t, y, n, k, in, in + n + 1)
                          - level_at(m, t, y, n, SIZE_MAX, in, in + n + 1));
        }
    qdot_free(in);
    if (fabs(jump) > least)
        snprintf(x->c->reason, sizeof x->c->reason,
                 "stopped at t = %.15g: T - V jumps there by %.6g, which is an infinite "
                 "force: an event says what it does, as `event NAME: x = 0 then x' = ...`",
                 t, jump);
    return QDOT_OK;
}

/* A piece ends at the first double behind the root that ends it, in all courses alike: that is
 * late, and never early, which adds up. A companion goes on as if it had left before the root,
 * the other one as if later still: by half the time between doubles. In this time it goes by
 * one mode, and takes back what it went by the other; SIZE_MAX is none. */
static qdot_status
make_up(qdot_piece *x, size_t by, size_t instead_of, double t, double *y)
{
    const size_t modes[] = {by, instead_of};
    const size_t surfaces = x->c->stage->switches.surfaces.n;
    const double late = x->direction * x->c->early * 0x1p-53 * fabs(t);
    double *moved = qdot_malloc(2 * x->n * sizeof *moved), *rate = moved + x->n;
    long *sides = qdot_calloc(2 * surfaces + 1, sizeof *sides);
    qdot_status status = moved && sides ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        memcpy(moved, y, x->n * sizeof *y);
    for (size_t k = 0; k < 2 && status == QDOT_OK; k++) {
        const qdot_ode_system *system = x->c->systems.at + modes[k];

        if (modes[k] == SIZE_MAX)
            continue;
        status = system->rhs(t, y, rate, system->user);
        for (size_t i = 0; i < x->n && status == QDOT_OK; i++)
            moved[i] += (k == 0 ? late : -late) * rate[i];
    }
    if (status == QDOT_OK)
        status = qdot_stage_sides(x->c->stage, t, y, NULL, sides);
    if (status == QDOT_OK)
        status = qdot_stage_sides(x->c->stage, t, moved, NULL, sides + surfaces);
    if (status == QDOT_OK && memcmp(sides, sides + surfaces, surfaces * sizeof *sides) == 0)
        memcpy(y, moved, x->n * sizeof *y);
    qdot_free(moved);
    qdot_free(sides);
    return status == QDOT_ENOMEM || status == QDOT_EINTR ? status : QDOT_OK;
}

/* Whether a companion's state may be moved so: not along constraints. */
static bool
makes_up(const qdot_piece *x)
{
    return x->c->early != 0 && !x->c->systems.at[x->mode].project;
}

/* --- the whole ----------------------------------------------------------------------- */

qdot_status
qdot_piece_cross(qdot_piece *x, size_t from, double t, double *y, bool jumped, bool first)
{
    bool corners;

    QDOT_TRY(turns_a_corner(x, from, t, y, &corners));
    if (corners)
        return QDOT_OK;
    if (!jumped)
        QDOT_TRY(check_level(x, from, t, y));
    if (x->c->reason[0] != '\0')
        return QDOT_OK;
    qdot_piece_carry(x, from, jumped);
    if (first && (jumped || from != x->mode) && makes_up(x))
        QDOT_TRY(make_up(x, jumped ? SIZE_MAX : from, x->mode, t, y));
    return QDOT_OK;
}

/* Whether an event that ends the piece has a `then`. */
static bool
changes_state(const qdot_piece *x)
{
    for (size_t i = 0; i < x->roots.n; i++) {
        const qdot_watched *w = &qdot_piece_mode(x)->watched[x->roots.at[i].function];

        if (w->kind == QDOT_WATCH_EVENT && x->c->stage->events.at[w->index].then)
            return true;
    }
    return false;
}

static qdot_status
loop(qdot_piece *x, double t0, const double *y0)
{
    qdot_course *c = x->c;
    double *y = qdot_malloc(x->n * sizeof *y), t = t0;
    bool jumped = false, over = false;
    size_t from;
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_piece_sides(x, t0, y0, NULL);
    if (status == QDOT_OK)
        memcpy(y, y0, x->n * sizeof *y);
    if (status == QDOT_OK)
        status = qdot_piece_enter(x);
    from = x->mode;
    if (status == QDOT_OK) /* the start, to go on from */
        status = qdot_trajectory_run(&c->tr, &c->systems.at[x->mode], x->method,
                                     x->options, t0, t0, y0);
    while (status == QDOT_OK && !over) {
        status = qdot_piece_search(x, from, t, y, jumped);
        if (status == QDOT_OK && c->reason[0] != '\0')
            qdot_piece_stop(x, true);
        if (status != QDOT_OK || x->intent != QDOT_PIECE_ENDS || c->reason[0] != '\0')
            break;
        if (c->most_pieces > 0 && c->tr.pieces.n > c->most_pieces) {
            qdot_piece_stop(x, true);
            break;
        }
        from = x->mode;
        jumped = false;
        t = c->tr.t[c->tr.count - 1];
        memcpy(y, c->tr.y + (c->tr.count - 1) * x->n, x->n * sizeof *y);
        if (makes_up(x) && changes_state(x))
            status = make_up(x, x->mode, SIZE_MAX, t, y);
        if (status == QDOT_OK)
            status = qdot_piece_act(x, y, &over, &jumped);
        if (status == QDOT_OK && over && jumped)
            status = qdot_trajectory_resume(&c->tr, &c->systems.at[x->mode], x->mode,
                                            true, x->options, t, y);
        if (status == QDOT_OK && over)
            c->tr.result.outcome = c->failed ? QDOT_ODE_FAILED : QDOT_ODE_STOPPED;
        if (status == QDOT_OK && !over)
            status = qdot_piece_sides(x, t, y, jumped ? NULL : qdot_piece_mode(x)->side);
        if (t == x->t1 && !over) {
            if (jumped && status == QDOT_OK)
                status = qdot_trajectory_resume(&c->tr, &c->systems.at[x->mode], x->mode,
                                                true, x->options, t, y);
            c->tr.result.outcome = QDOT_ODE_DONE;
            break;
        }
    }
    qdot_free(y);
    return status;
}

qdot_status
qdot_course_run(qdot_course *c, const qdot_ode_method *method,
                const qdot_ode_options *options, double t0, double t1, const double *y)
{
    qdot_piece x = {.c = c,
                    .options = options,
                    .method = method,
                    .t1 = t1,
                    .direction = t1 < t0 ? -1 : 1,
                    .n = 2 * c->stage->modes.at[0]->plan->n};
    qdot_status status = make_room(&x);

    c->stopped_by = SIZE_MAX;
    if (status == QDOT_OK)
        status = loop(&x, t0, y);
    qdot_trajectory_close(x.cursor);
    qdot_trajectory_clear(&x.step);
    qdot_free(x.side);
    qdot_free(x.functions_on);
    qdot_free(x.before);
    qdot_free(x.residual);
    qdot_free(x.signs);
    qdot_free(x.fired.at);
    qdot_free(x.crossed.at);
    qdot_free(x.y);
    qdot_free(x.roots.at);
    qdot_free(x.tried.at);
    qdot_free(x.doubts.at);
    qdot_free(x.repeats.at);
    return status;
}

qdot_status
qdot_course_prepare(qdot_course *c)
{
    qdot_bind *bind = NULL;

    c->stopped_by = SIZE_MAX;
    if (c->tr.count > 0 && c->tr.pieces.n == 0)
        QDOT_TRY(qdot_vec_push(&c->tr.pieces, (qdot_trajectory_piece){0}));
    if (c->binds.n > 0)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&c->systems, (qdot_ode_system){0}));
    QDOT_TRY(qdot_vec_push(&c->watches, NULL));
    QDOT_TRY(qdot_bind_new(c->stage->modes.at[0]->plan, c->shaken, &bind));
    c->systems.at[0] = qdot_bind_system(bind);
    if (qdot_vec_push(&c->binds, bind) == QDOT_OK)
        return QDOT_OK;
    qdot_bind_free(bind);
    return QDOT_ENOMEM;
}

const qdot_ode_system *
qdot_course_systems(const qdot_course *c)
{
    return c->systems.at;
}

void
qdot_course_clear(qdot_course *c)
{
    qdot_trajectory_clear(&c->tr);
    for (size_t i = 0; i < c->binds.n; i++)
        qdot_bind_free(c->binds.at[i]);
    for (size_t i = 0; i < c->watches.n; i++)
        qdot_watch_free(c->watches.at[i]);
    qdot_free(c->binds.at);
    qdot_free(c->systems.at);
    qdot_free(c->watches.at);
    qdot_free(c->occurrences.at);
    qdot_free(c->ends.at);
    *c = (qdot_course){0};
}
