/* piece.c -- integrates one piece of a run and searches every step for events, bounds and switches. */
#include "sim/course/piece.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "num/past.h"
#include "ode/taylor.h"

/* --- reading within a step ----------------------------------------------------------- */

static qdot_status
read_state_from_series(double t, double *y, void *user)
{
    const qdot_piece *x = user;
    const qdot_ode_expanded *s = x->expanded;

    qdot_ode_taylor_evaluate(x->reader.system, s->order, s->t, s->unit, t, s->y, y);
    return QDOT_OK;
}

static qdot_status
read_double_double_from_series(double t, qdot_two *y, void *user)
{
    const qdot_piece *x = user;

    qdot_ode_taylor_evaluate_two(x->reader.system, x->expanded, t, 0, y);
    return QDOT_OK;
}

static qdot_status
read_state_in_step(double t, double *y, void *user)
{
    const qdot_piece *x = user;
    const uint64_t before = qdot_trajectory_evaluations(x->cursor);
    qdot_course *c = x->c;

    QDOT_TRY(qdot_trajectory_read(x->cursor, t, y));
    c->looked += qdot_trajectory_evaluations(x->cursor) - before;
    if (c->most_looked > 0 && c->looked > c->most_looked)
        return qdot_fail(QDOT_ELIMIT,
                         "stopped at t = %.6g after %llu evaluations within steps, to find "
                         "events there",
                         t, (unsigned long long)c->most_looked);
    return QDOT_OK;
}

static bool
uses_series(const qdot_piece *x)
{
    return (x->now ? x->now : x->method)->series;
}

/* Read the state at t within the step, for a run that changes between methods with and without series. */
static qdot_status
read_state_by_either_method(double t, double *y, void *user)
{
    return uses_series(user) ? read_state_from_series(t, y, user) : read_state_in_step(t, y, user);
}

/* --- events and surfaces within a step ----------------------------------------------- */

/* The direction of a root as t grows: 1 rising, -1 falling, 0 a touch of 0 without crossing. */
static int
direction_of_root(qdot_piece *x, const qdot_root *root)
{
    const qdot_watched *w = &qdot_piece_mode(x)->watched[root->function];
    int way;

    if (w->kind == QDOT_WATCH_EVENT && x->c->stage->events.at[w->index].undoing)
        return qdot_piece_is_undone(x, root, &way) ? way : 0;
    if (w->kind == QDOT_WATCH_EVENT && x->c->stage->events.at[w->index].touches)
        return 0;
    return x->direction > 0 ? qdot_root_way(root) : -qdot_root_way(root);
}

/* Whether the motion only touches a surface of places: if the equations jump there, with what they are on the other side
 * it might go on as well. */
static bool
touches_position_surface(const qdot_piece *x, const qdot_watched *w, const qdot_root *root)
{
    return root->way == 0 && root->within == 0 && w->kind == QDOT_WATCH_SURFACE && w->inside != 0
           && w->index < qdot_switches_own(&x->c->stage->switches) && qdot_piece_is_of_places(x, w->index);
}

bool
qdot_piece_is_occurrence(qdot_piece *x, const qdot_root *root)
{
    const qdot_watched *w = &qdot_piece_mode(x)->watched[root->function];
    int way;

    if (w->kind == QDOT_WATCH_EVENT && x->c->stage->events.at[w->index].undoing)
        return !root->pole && qdot_piece_is_undone(x, root, &way);
    way = direction_of_root(x, root);
    if (w->kind == QDOT_WATCH_EVENT)
        return !root->pole && (x->c->stage->events.at[w->index].way == 0 ||
                               x->c->stage->events.at[w->index].way == way);
    if (root->jump)
        return !(root->stays && qdot_piece_mode(x)->side[w->index] == QDOT_SIDE_SLIDES);
    return (root->way != 0 && root->way != w->inside && !root->stays) || touches_position_surface(x, w, root);
}

static bool
has_action(const qdot_piece *x, const qdot_root *root)
{
    const qdot_watched *w = &qdot_piece_mode(x)->watched[root->function];

    return w->kind != QDOT_WATCH_EVENT || qdot_staged_event_acts(&x->c->stage->events.at[w->index]);
}

static bool
ends_piece(const qdot_root *root, void *user)
{
    return qdot_piece_is_occurrence(user, root) && has_action(user, root);
}

/* Companions of a run in two doubles share the rounding of the states that are looked at: by how much that
 * moves the root, in its blur. */
static qdot_status
add_rounding_to_error(qdot_piece *x, const qdot_root *root, qdot_occurrence *o)
{
    const qdot_ode_system *system = &x->c->systems.at[x->mode];
    double *y = qdot_malloc(3 * x->n * sizeof *y), *rates = y + x->n, *size = rates + x->n, rate = 0, noise = 0;
    qdot_status status = y ? x->reader.read(root->t, y, x->reader.user) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = system->rhs(root->t, y, rates, system->user);
    for (size_t i = 0; i < x->n && status == QDOT_OK; i++)
        size[i] = fabs(y[i]);
    if (status == QDOT_OK)
        status = qdot_watch_rate(qdot_piece_watch(x), root->t, y, NULL, rates, size, root->function, &rate, &noise);
    if (status == QDOT_OK && rate != 0)
        o->blur = fmax(o->blur, fabs(noise / rate));
    qdot_free(y);
    return status;
}

qdot_status
qdot_piece_record(qdot_piece *x, const qdot_root *root)
{
    const qdot_watched *w = &qdot_piece_mode(x)->watched[root->function];
    qdot_occurrence o = {w->index, root->t, direction_of_root(x, root),
                         root->within, root->bend, (root->way == 0 || root->stays ? root->blur : 0) + root->moved + root->flat};

    if (w->kind != QDOT_WATCH_EVENT || root->rests)
        return QDOT_OK;
    if (x->options->leading && root->way != 0)
        QDOT_TRY(add_rounding_to_error(x, root, &o));
    return qdot_vec_push(&x->c->occurrences, o);
}

qdot_status
qdot_piece_meet(qdot_piece *x, const qdot_root *root)
{
    if (!qdot_piece_is_occurrence(x, root))
        return QDOT_OK;
    QDOT_TRY(qdot_piece_record(x, root));
    if (qdot_piece_mode(x)->watched[root->function].kind == QDOT_WATCH_EVENT)
        x->c->occurrences.at[x->c->occurrences.n - 1].blur = root->blur + root->moved;
    return qdot_vec_push(&x->roots, *root);
}

/* Judge after the first step whether the piece can continue with the sides it has assumed. */
static qdot_status
check_assumed_sides(qdot_piece *x)
{
    if (x->search == QDOT_SIDES_KNOWN)
        return QDOT_OK;
    QDOT_TRY(qdot_piece_leaves_well(x, &x->well));
    if (!x->well || x->search == QDOT_SIDES_COMPARED || qdot_piece_is_open(x))
        x->intent = QDOT_PIECE_RETRIED;
    return QDOT_OK;
}

/* End the piece at t0 if the function u of a surface was 0 until this step and no longer is. */
static qdot_status
watch_surfaces_left(qdot_piece *x, double t0)
{
    const int *first = qdot_watch_first(qdot_piece_watch(x));
    const qdot_mode *m = qdot_piece_mode(x);

    for (size_t i = 0; i < m->m; i++) {
        if (m->watched[i].kind != QDOT_WATCH_SURFACE || m->watched[i].inside != 0
            || first[i] == 0)
            continue;
        x->intent = QDOT_PIECE_ENDS;
        x->t_act = t0;
        QDOT_TRY(qdot_vec_push(
            &x->roots,
            ((qdot_root){.function = i, .t = t0, .way = first[i], .exact = true})));
    }
    return QDOT_OK;
}

/* Switches within this fraction of their time of each other count as simultaneous: rounding
 * separates them. */
static const double same_time = 4 * DBL_EPSILON;

static bool
is_surface_root(const qdot_piece *x, const qdot_root *root)
{
    return qdot_piece_mode(x)->watched[root->function].kind == QDOT_WATCH_SURFACE;
}

/* The end of the piece that root k of [n] ends: the last simultaneous switch, if no other root
 * lies between. */
static double
end_of_simultaneous_switches(qdot_piece *x, const qdot_root *roots, size_t n, size_t k)
{
    double t = roots[k].t;

    if (!is_surface_root(x, &roots[k]))
        return t;
    for (size_t i = k + 1; i < n && fabs(roots[i].t - roots[k].t) <= same_time * fabs(t)
                           && is_surface_root(x, &roots[i]);
         i++)
        if (qdot_piece_is_occurrence(x, &roots[i]))
            t = roots[i].t;
    return t;
}

/* Discard the results of a step that is searched again or was rejected. */
static void
discard_step_results(qdot_piece *x)
{
    x->c->occurrences.n = x->noted;
    x->c->faded.n = x->noted_faded;
}

/* Record the roots of the step, up to the first one that ends the piece. */
static qdot_status
record_roots(qdot_piece *x, double t0, const qdot_root *roots, size_t n)
{
    x->roots.n = 0;
    discard_step_results(x);
    x->intent = QDOT_PIECE_GOES_ON;
    if (x->first_step) {
        const qdot_watched *w = qdot_piece_bound_at_start(x);

        if (w) {
            qdot_root root = {.function = (size_t)(w - qdot_piece_mode(x)->watched),
                              .t = t0,
                              .way = -w->inside,
                              .exact = true};

            x->intent = QDOT_PIECE_ENDS;
            x->t_act = t0;
            return qdot_vec_push(&x->roots, root);
        }
        QDOT_TRY(check_assumed_sides(x));
        if (x->intent == QDOT_PIECE_RETRIED)
            return QDOT_OK;
        if (qdot_piece_stays_in_contact(x)) { /* end here: side-search.c decides how the motion continues */
            x->intent = QDOT_PIECE_RETRIED;
            return QDOT_OK;
        }
        QDOT_TRY(qdot_piece_events_at_start(x, t0));
    } else {
        QDOT_TRY(watch_surfaces_left(x, t0));
    }
    if (x->intent == QDOT_PIECE_ENDS)
        return QDOT_OK;
    for (size_t i = 0; i < n; i++) {
        if (x->intent == QDOT_PIECE_ENDS && x->direction * (roots[i].t - x->t_act) > 0)
            break;
        if (!qdot_piece_is_occurrence(x, &roots[i])) {
            QDOT_TRY(qdot_piece_pass_touch(x, &roots[i]));
            continue;
        }
        if (x->intent != QDOT_PIECE_ENDS && has_action(x, &roots[i])) {
            x->intent = QDOT_PIECE_ENDS;
            x->t_act = end_of_simultaneous_switches(x, roots, n, i);
            for (; x->c->occurrences.n > x->noted &&
                   x->c->occurrences.at[x->c->occurrences.n - 1].t == x->t_act;
                 x->c->occurrences.n--) /* removed here; they are recorded again, in their order */
                ;
            for (size_t k = 0; k < i; k++)
                if (roots[k].t == x->t_act && qdot_piece_is_occurrence(x, &roots[k])) {
                    QDOT_TRY(qdot_piece_record(x, &roots[k]));
                    QDOT_TRY(qdot_vec_push(&x->roots, roots[k]));
                }
        }
        QDOT_TRY(qdot_piece_doubt_root(x, &roots[i]));
        QDOT_TRY(qdot_piece_record(x, &roots[i]));
        if (x->intent == QDOT_PIECE_ENDS)
            QDOT_TRY(qdot_vec_push(&x->roots, roots[i]));
    }
    return QDOT_OK;
}

/* If the motion leaves a coordinate's domain at t_act, end the piece one double before that. */
static void
end_inside_domain(qdot_piece *x, double t0)
{
    for (size_t i = 0; i < x->roots.n; i++)
        if (qdot_piece_mode(x)->watched[x->roots.at[i].function].kind ==
                QDOT_WATCH_DOMAIN &&
            x->t_act != t0)
            x->t_act = nextafter(x->t_act, -x->direction * INFINITY);
}

/* A run is given up if the last LOOKED_AT parts of steps of a piece, beyond what any step may have, were so short that
 * most_to_come would follow: a function that jumps 1e9 times in a run is never searched to the end. */
enum { LOOKED_AT = 20000, ORDINARY_PARTS = 8 };
static const double most_to_come = 4e6;

static qdot_status
check_number_of_parts(qdot_piece *x, double t, size_t parts)
{
    const double passed = fabs(t - x->searched.since);
    const double to_come = LOOKED_AT * (fabs(x->t1 - t) / passed);

    x->searched.parts += parts > ORDINARY_PARTS ? parts - ORDINARY_PARTS : 0;
    if (x->searched.parts < LOOKED_AT)
        return QDOT_OK;
    x->searched.parts = 0;
    x->searched.since = t;
    if (to_come <= most_to_come) /* the comparison is false if time does not advance */
        return QDOT_OK;
    return qdot_fail(QDOT_ELIMIT,
                     "stopped at t = %.15g: an event or switch changes so fast that %d parts of "
                     "steps were searched within %.3g; %.1e more would follow until t = %.10g",
                     t, LOOKED_AT, passed, to_come, x->t1);
}

/* Search a step known as a Taylor series for roots; shorten the step if it has too many. */
static qdot_status
search_series_step(qdot_piece *x, qdot_ode_expanded *step, const qdot_root **roots, size_t *n)
{
    for (;;) {
        const size_t before = qdot_watch_looked_at(qdot_piece_watch(x));
        double reached;

        QDOT_TRY(read_state_from_series(step->t_end, x->y, x));
        QDOT_TRY(qdot_watch_step(qdot_piece_watch(x), step->t_end, x->y, step->t_end == x->t1,
                                 step, roots, n));
        QDOT_TRY(check_number_of_parts(x, step->t, qdot_watch_looked_at(qdot_piece_watch(x)) - before));
        reached = qdot_watch_reached(qdot_piece_watch(x));
        if (reached == step->t_end)
            return QDOT_OK;
        if ((double)*n * (x->t1 - step->t) / (reached - step->t) > qdot_piece_most_to_come)
            return qdot_fail(QDOT_ELIMIT,
                             "stopped at t = %.15g: events come %zu times within %.3g; %.1e more "
                             "would follow until t = %.10g",
                             step->t, *n, fabs(reached - step->t),
                             (double)*n * (x->t1 - step->t) / (reached - step->t), x->t1);
        step->t_end = step->t + (reached - step->t) / 2;
    }
}

/* Below this part of its size the rounding of a state is lost in doubles: companions, which take the same steps, share
 * it. */
static const double unseen = 0x1p-64;

/* The state at the root that ends the piece; with constraints, which the series leaves by its error and which hold at
 * doubles of t, at its end. Each companion is moved by its rounding, one either way. */
static void
read_state_at_root(qdot_piece *x)
{
    x->has_root = x->reader.read_two != NULL;
    if (!x->has_root)
        return;
    qdot_piece_find_delay(x);
    qdot_ode_taylor_evaluate_two(x->reader.system, x->expanded, x->t_act,
                                 x->reader.system->project ? 0 : -x->direction * x->late, x->root);
    qdot_ode_taylor_rounding_two(x->reader.system, x->expanded, x->t_act, x->y);
    for (size_t i = 0; i < x->n; i++)
        if (x->y[i] <= unseen * x->largest[i])
            x->root[i] = qdot_two_add_double(x->root[i], x->c->early * x->y[i]);
}

/* Look at a step that is offered with its series. It is shortened to end at what ends the piece; x->over: that
 * is where it starts, or other sides are to be tried. */
static qdot_status
inspect_series_step(qdot_piece *x, qdot_ode_expanded *step)
{
    const qdot_ode_series *s = x->c->systems.at[x->mode].series;
    const qdot_root *roots;
    size_t n;

    if (x->c->history)
        QDOT_TRY(qdot_past_add(x->c->history, step->t, step->unit, step->order, step->holds, s->x, s->stride));
    if (qdot_piece_mode(x)->m == 0)
        return QDOT_OK;
    x->far = !x->first_step &&
             qdot_watch_is_far(qdot_piece_watch(x), step);
    if (x->far) {
        x->intent = QDOT_PIECE_GOES_ON; /* discard what was found in a longer step, which was rejected */
        discard_step_results(x);
        return QDOT_OK;
    }
    x->expanded = step;
    QDOT_TRY(search_series_step(x, step, &roots, &n));
    QDOT_TRY(record_roots(x, step->t, roots, n));
    if (x->intent == QDOT_PIECE_ENDS)
        end_inside_domain(x, step->t);
    x->over = x->intent == QDOT_PIECE_RETRIED || (x->intent == QDOT_PIECE_ENDS && x->t_act == step->t);
    if (x->intent == QDOT_PIECE_ENDS && !x->over) {
        step->t_end = x->t_act;
        read_state_at_root(x);
    }
    return QDOT_OK;
}

/* Search a step for roots from the states at its ends, for methods without series. */
static qdot_status
inspect_step_ends(qdot_piece *x, double t, const double *y)
{
    const qdot_root *roots;
    size_t n;

    x->far = false;
    x->step.t[1] = t;
    memcpy(x->step.y + x->n, y, x->n * sizeof *y);
    qdot_trajectory_renew(x->cursor);
    QDOT_TRY(qdot_watch_step(qdot_piece_watch(x), t, y, t == x->t1, NULL, &roots, &n));
    QDOT_TRY(record_roots(x, x->step.t[0], roots, n));
    x->over = x->intent == QDOT_PIECE_RETRIED;
    if (x->intent == QDOT_PIECE_ENDS) {
        end_inside_domain(x, x->step.t[0]);
        return qdot_trajectory_read(x->cursor, x->t_act, x->y_act);
    }
    return QDOT_OK;
}

/* Check constraints on accelerations, unless they are enforced by projecting the state after each step. */
static qdot_status
check_accelerations(const qdot_piece *x, double t, const double *y)
{
    const qdot_ode_system *system = &x->c->systems.at[x->mode];
    qdot_constrained *held = system->n_parts == 0 ? qdot_bind_held(system->user) : NULL;

    if (!held || (system->project && !x->method->multistep))
        return QDOT_OK;
    return qdot_constrained_check_accelerations(held, t, y);
}

/* Look at the end of a step that was taken; *stop: the caller wants the run to end there. */
static qdot_status
inspect_end_of_step(qdot_piece *x, const qdot_ode_step *step, bool *stop)
{
    const double t = step->t_end, *y = step->y_end;

    if (x->first_step)
        memset(x->end_low, 0, x->n * sizeof *x->end_low);
    QDOT_TRY(check_accelerations(x, t, y));
    qdot_past_reach(x->c->history, t);
    if (x->options->accepted)
        QDOT_TRY(x->options->accepted(t, y, stop, x->options->user));
    if (qdot_piece_mode(x)->m == 0)
        return QDOT_OK;
    for (size_t i = 0; i < x->n; i++)
        x->largest[i] = fmax(x->largest[i], fabs(y[i]));
    if (!step->series)
        QDOT_TRY(inspect_step_ends(x, t, y));
    if (x->over)
        return QDOT_OK;
    x->first_step = false;
    if (x->intent == QDOT_PIECE_ENDS && !x->far) {
        *stop = true;
        return QDOT_OK;
    }
    if (!x->method->series) { /* the next step starts from the state just accepted */
        x->step.t[0] = t;
        memcpy(x->step.y, y, x->n * sizeof *y);
    }
    if (x->far) {
        qdot_watch_pass(qdot_piece_watch(x), t, y);
        return QDOT_OK;
    }
    qdot_watch_take(qdot_piece_watch(x));
    return qdot_piece_take_faded(x, t);
}

/* Look at the end of a step, and store it. */
static qdot_status
judge_step(qdot_piece *x, const qdot_ode_options *options, const qdot_ode_step *step, bool *stop)
{
    QDOT_TRY(inspect_end_of_step(x, step, stop));
    return x->over ? QDOT_OK : qdot_trajectory_add(&x->c->tr, options, x->t1, step);
}

/* --- integrating a piece -------------------------------------------------------------- */

/* Start to watch the functions of the mode (events, bounds, surfaces) at the start of a piece. */
qdot_status
qdot_piece_begin(qdot_piece *x)
{
    const double t = x->start.t, *y = x->start.y;
    const qdot_ode_following *following = x->c->systems.at[x->mode].following;
    const bool by_series_alone = x->method->series && !x->options->alternates && !following;

    qdot_trajectory_close(x->cursor);
    x->cursor = NULL;
    x->reader = (qdot_watch_reader){x->options->alternates ? read_state_by_either_method
                                    : x->method->series    ? read_state_from_series
                                                           : read_state_in_step,
                                    by_series_alone ? read_double_double_from_series : NULL, x, true,
                                    &x->c->systems.at[x->mode], ends_piece};
    if (qdot_piece_mode(x)->m == 0)
        return QDOT_OK;
    if (following)
        QDOT_TRY(following->enter(t, y, NULL, following->user));
    if (!x->method->series) {
        x->step.t[0] = t;
        x->step.t[1] = t + x->direction;
        memcpy(x->step.y, y, x->n * sizeof *y);
        QDOT_TRY(qdot_trajectory_open(&x->step, x->reader.system, &x->cursor));
    }
    QDOT_TRY(qdot_piece_widen_residuals(x));
    qdot_piece_let_fade(x);
    qdot_piece_low(x, x->y);
    QDOT_TRY(qdot_watch_begin(
        qdot_piece_watch(x), &x->reader, t, y,
        &(qdot_watch_known){x->c->shaken && x->c->tr.count == 1,
                            x->c->tr.count == 1 && !x->start.jumped && x->c->exact, x->before, x->residual, x->y, x->largest,
                            !x->start.on_root                                  ? 0
                            : x->start.jumped || qdot_piece_has_massless(x) ? x->c->stage->events.n
                                                                            : qdot_piece_mode(x)->m},
        x->functions_on));
    for (size_t i = 0; i < qdot_piece_mode(x)->m && x->c->tr.count == 1; i++)
        x->c->began_on |= x->functions_on[i];
    return QDOT_OK;
}

/* Go along one step; *stop: the run ends there. */
static qdot_status
advance(qdot_piece *x, qdot_ode_controller *steps, const qdot_ode_options *options, bool *stop)
{
    qdot_status status = QDOT_OK;
    qdot_ode_step step;
    bool taken = true;

    QDOT_TRY(qdot_ode_controller_offer(steps, &step));
    x->now = step.method;
    if (step.series)
        status = inspect_series_step(x, step.series);
    if (status != QDOT_OK)
        return qdot_ode_controller_refuse(steps, status);
    if (!x->over)
        QDOT_TRY(qdot_ode_controller_take(steps, &step, &taken));
    if (x->over || !taken)
        return QDOT_OK;
    status = judge_step(x, options, &step, stop);
    return status == QDOT_OK && x->over ? QDOT_OK : qdot_ode_controller_settle(steps, &step, status);
}

/* Integrate from the last point until the piece is over. */
static qdot_status
go_through_steps(qdot_piece *x, const qdot_ode_system *system, const qdot_ode_options *options)
{
    const double t0 = x->c->tr.t[x->c->tr.count - 1];
    qdot_ode_controller steps;
    bool stop = false;
    qdot_status status = qdot_ode_controller_open(&steps, system, x->method, options, t0, x->t1, x->start.y);

    while (status == QDOT_OK && steps.t != x->t1 && !stop && !x->over)
        status = advance(x, &steps, options, &stop);
    qdot_ode_controller_close(&steps, status, stop || x->over);
    qdot_trajectory_end_piece(&x->c->tr, &steps.result);
    return status;
}

/* Integrate one piece; the first piece begins the trajectory. */
qdot_status
qdot_piece_integrate(qdot_piece *x)
{
    qdot_course *c = x->c;
    qdot_ode_options options = *x->options;
    const qdot_ode_system *system = &c->systems.at[x->mode];
    const bool looks = qdot_piece_mode(x)->m > 0 || x->options->accepted || c->history;

    options.now = qdot_trajectory_method_now(&c->tr);
    if (!options.leading) {
        qdot_piece_low(x, x->y);
        options.carry = x->y;
    }
    options.at_doubles = qdot_piece_mode(x)->m > 0;
    x->has_root = false;
    memset(x->end_low, 0, x->n * sizeof *x->end_low);
    if (x->reader.read_two) /* the low parts at the start: the piece may end there */
        qdot_piece_low(x, x->end_low);
    x->intent = QDOT_PIECE_GOES_ON;
    x->resting = SIZE_MAX;
    x->over = false;
    x->first_step = true;
    x->far = false;
    x->searched.since = x->start.t;
    x->searched.parts = 0;
    x->noted = c->occurrences.n;
    x->noted_faded = c->faded.n;
    qdot_past_restart(c->history, x->start.t);
    QDOT_TRY(qdot_trajectory_begin_piece(&c->tr, x->mode, x->start.jumped || x->start.followed, &options, x->start.y));
    if (!looks && system->n_parts > 1) /* its parts may go apart */
        return qdot_trajectory_record(&c->tr, system, &options, x->t1);
    QDOT_TRY(go_through_steps(x, system, &options));
    if (x->intent == QDOT_PIECE_ENDS && !x->over && !uses_series(x))
        qdot_trajectory_shorten(&c->tr, x->t_act, x->y_act);
    return QDOT_OK;
}
