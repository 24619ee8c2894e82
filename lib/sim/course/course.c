/* course.c -- the loop over the pieces of a run: finds the mode of each piece and passes to the next. */
#include "sim/course/course.h"

#include <math.h>
#include <string.h>

#include "num/past.h"
#include "sim/course/piece.h"

/* Allocate arrays for the largest number of watched functions that any mode has. */
static qdot_status
allocate_piece_arrays(qdot_piece *x)
{
    size_t m = 2 * x->c->stage->switches.surfaces.n + x->c->stage->events.n +
               2 * x->c->stage->domains.n + 1;

    x->side = qdot_calloc(m, sizeof *x->side);
    x->functions_on = qdot_calloc(m, sizeof *x->functions_on);
    x->before = qdot_calloc(m, sizeof *x->before);
    x->residual = qdot_calloc(m, sizeof *x->residual);
    x->signs = qdot_calloc(m, sizeof *x->signs);
    x->left = qdot_calloc(m, sizeof *x->left);
    x->untouched = qdot_calloc(m, sizeof *x->untouched);
    x->touching = qdot_calloc(m, sizeof *x->touching);
    x->turned = qdot_calloc(m, sizeof *x->turned);
    x->jumps = qdot_calloc(m, sizeof *x->jumps);
    x->root = qdot_calloc(x->n, sizeof *x->root);
    x->thens = qdot_calloc(x->c->stage->events.n + 1, sizeof *x->thens);
    x->y = qdot_calloc(11 * x->n, sizeof *x->y);
    x->step = (qdot_trajectory){.n = x->n,
                                .count = 2,
                                .method = x->method,
                                .tol = x->options->tol,
                                .order_more = x->options->order_more,
                                .entered = true};
    x->step.t = qdot_calloc(2, sizeof *x->step.t);
    x->step.y = qdot_calloc(2 * x->n, sizeof *x->step.y);
    if (!x->side || !x->functions_on || !x->before || !x->residual ||
        !x->signs || !x->left || !x->untouched || !x->touching || !x->turned || !x->jumps || !x->root || !x->thens || !x->y || !x->step.t || !x->step.y)
        return QDOT_ENOMEM;
    x->y_act = x->y + x->n;
    x->start.y = x->y_act + x->n;
    x->rim = x->start.y + x->n;
    x->bare = x->rim + x->n;
    x->start.low = x->bare + 3 * x->n;
    x->start.low_of = x->start.low + x->n;
    x->end_low = x->start.low_of + x->n;
    x->largest = x->end_low + x->n;
    return qdot_vec_push(&x->step.pieces, (qdot_trajectory_piece){0});
}

/* Whether an event that ends the piece sets a new state (has a `then`). */
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

/* Whether the piece ends on surfaces that depend on positions, which the motion crosses with
 * unchanged velocity. */
static bool
crosses_position_surface(const qdot_piece *x)
{
    bool places = false;

    for (size_t i = 0; i < x->roots.n; i++) {
        const qdot_watched *w = &qdot_piece_mode(x)->watched[x->roots.at[i].function];

        if (w->kind == QDOT_WATCH_SURFACE && (w->velocity || w->inside == 0))
            return false;
        places |= w->kind == QDOT_WATCH_SURFACE;
    }
    return places;
}

/* Whether the state may jump at the end of this piece of the run: by an event, or coordinates
 * without mass by a switch. */
static bool
velocity_may_jump(const qdot_piece *x)
{
    bool switches = false;

    for (size_t i = 0; i < x->roots.n && qdot_piece_has_massless(x); i++)
        switches |= qdot_piece_mode(x)->watched[x->roots.at[i].function].kind == QDOT_WATCH_SURFACE;
    return switches || changes_state(x);
}

/* Record the state that an event set at the end of the run as the run's last point. */
static qdot_status
record_final_state(qdot_piece *x)
{
    QDOT_TRY(qdot_trajectory_begin_piece(&x->c->tr, x->mode, true, x->options, x->start.y));
    return qdot_trajectory_record(&x->c->tr, &x->c->systems.at[x->mode], x->options, x->start.t);
}

/* What rests where a piece starts; an event that is met there, *over: one that stops the run, is carried
 * out, and sides are decided anew if it changes the state. */
static qdot_status
stop_resting_bodies(qdot_piece *x, bool anew, bool *over)
{
    for (;;) {
        QDOT_TRY(qdot_piece_stop_pucks(x, anew));
        x->roots.n = 0;
        QDOT_TRY(qdot_piece_stop_in_layers(x));
        QDOT_TRY(qdot_piece_stop_chatter(x, anew));
        if (x->roots.n == 0)
            return QDOT_OK;
        x->start.jumped = false;
        QDOT_TRY(qdot_piece_act(x, over));
        if (*over || !x->start.jumped)
            return QDOT_OK;
        QDOT_TRY(qdot_piece_sides(x, NULL));
        anew = true;
    }
}

/* Integrate the pieces of the run one after another from the state y0 [n] at x->start.t. */
static qdot_status
integrate_pieces(qdot_piece *x, const double *y0)
{
    qdot_course *c = x->c;
    double *y = x->start.y;
    bool over = false;
    qdot_status status;

    memcpy(y, y0, x->n * sizeof *y);
    for (size_t i = 0; i < x->n; i++)
        x->largest[i] = fabs(y[i]);
    if (x->options->carry) {
        memcpy(x->start.low_of, y, x->n * sizeof *y);
        memcpy(x->start.low, x->options->carry, x->n * sizeof *y);
    }
    status = qdot_piece_sides(x, NULL);
    if (status == QDOT_OK)
        status = qdot_piece_enter(x);
    x->start.from = x->mode;
    if (status == QDOT_OK) /* record the start, from which the course continues */
        status = qdot_trajectory_run(&c->tr, &c->systems.at[x->mode], x->method, x->options,
                                     x->start.t, x->start.t, y0);
    if (status == QDOT_OK)
        status = stop_resting_bodies(x, true, &over);
    if (status == QDOT_OK && qdot_piece_stop_nowhere(x))
        over = true;
    while (status == QDOT_OK && !over) {
        status = qdot_piece_search(x);
        if (status == QDOT_OK && c->reason[0] != '\0')
            qdot_piece_stop(x, true);
        if (status == QDOT_OK && c->tr.count > 0)
            qdot_piece_start_at_end(x);
        if (status != QDOT_OK || x->intent != QDOT_PIECE_ENDS || c->reason[0] != '\0') {
            if (status == QDOT_OK && x->start.t == x->t1) {
                x->start.from = x->mode;
                x->start.jumped = qdot_piece_end_in_layers(x);
                status = c->reason[0] == '\0' ? qdot_piece_end_behind(x) : QDOT_OK;
                if (status == QDOT_OK && x->start.jumped)
                    status = record_final_state(x);
            }
            break;
        }
        if (c->most_pieces > 0 && c->tr.pieces.n > c->most_pieces) {
            qdot_piece_stop(x, true);
            break;
        }
        x->start.from = x->mode;
        x->start.jumped = x->start.anew = false;
        qdot_piece_find_delay(x);
        if ((velocity_may_jump(x) || crosses_position_surface(x)) && x->has_root)
            status = qdot_piece_go_to_root(x);
        if (changes_state(x))
            (void)qdot_piece_end_in_layers(x);
        if (status == QDOT_OK)
            status = qdot_piece_keep(x, NULL);
        if (status == QDOT_OK && velocity_may_jump(x) && !x->has_root)
            status = qdot_piece_make_up(x, x->mode, SIZE_MAX);
        if (status == QDOT_OK)
            status = qdot_piece_act(x, &over);
        if (status == QDOT_OK && !over)
            status = qdot_piece_sides(x, x->start.jumped || x->start.anew ? NULL : qdot_piece_mode(x)->side);
        if (status == QDOT_OK && !over)
            status = stop_resting_bodies(x, x->start.jumped, &over);
        if (status == QDOT_OK && over && x->start.jumped)
            status = record_final_state(x);
        if (status == QDOT_OK && over)
            c->tr.result.outcome = c->failed ? QDOT_ODE_FAILED : QDOT_ODE_STOPPED;
        if (status == QDOT_OK && x->start.t == x->t1 && !over)
            status = qdot_piece_end_behind(x);
        if (x->start.t == x->t1 && !over) {
            if (x->start.jumped && status == QDOT_OK)
                status = record_final_state(x);
            c->tr.result.outcome = QDOT_ODE_DONE;
            break;
        }
    }
    return status;
}

static void
clear_chatters(qdot_course *c)
{
    for (size_t i = 0; i < c->chatters.n; i++)
        qdot_free(c->chatters.at[i].along);
    c->chatters.n = 0;
}

const char *
qdot_course_cause(const char *reason)
{
    static const char begin[] = "stopped at t = ";
    const char *colon = strncmp(reason, begin, sizeof begin - 1) == 0 ? strchr(reason, ':') : NULL;

    return colon && colon[1] == ' ' ? colon + 2 : NULL;
}

qdot_status
qdot_course_begin_history(qdot_course *c, double t0, const double *y)
{
    const size_t n = c->stage->modes.at[0]->plan->n;
    qdot_status status;
    double *was;

    QDOT_TRY(qdot_course_remember(c, c->stage->modes.at[0]->plan));
    if (!c->history)
        return QDOT_OK;
    qdot_past_read(c->history);
    was = qdot_calloc(2 * n, sizeof *was);
    if (!was)
        return QDOT_ENOMEM;
    memcpy(was, y, n * sizeof *was);
    status = qdot_past_begin(c->history, t0, was);
    qdot_free(was);
    return status;
}

qdot_status
qdot_course_remember(qdot_course *c, const qdot_plan *plan)
{
    return plan->delayed && !c->history ? qdot_past_new(2 * plan->n, plan->inputs, &c->history) : QDOT_OK;
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
                    .n = 2 * c->stage->modes.at[0]->plan->n,
                    .start.t = t0};
    qdot_status status = allocate_piece_arrays(&x);

    if (status == QDOT_OK)
        status = qdot_course_begin_history(c, t0, y);

    /* clear the results of an earlier integration of this course */
    c->occurrences.n = c->faded.n = c->ends.n = c->rests.n = 0;
    clear_chatters(c);
    c->reason[0] = '\0';
    c->failed = c->began_on = false;
    c->stopped_by = SIZE_MAX;
    if (status == QDOT_OK)
        status = integrate_pieces(&x, y);
    qdot_trajectory_close(x.cursor);
    qdot_trajectory_clear(&x.step);
    qdot_free(x.side);
    qdot_free(x.functions_on);
    qdot_free(x.before);
    qdot_free(x.residual);
    qdot_free(x.signs);
    qdot_free(x.left);
    qdot_free(x.untouched);
    qdot_free(x.touching);
    qdot_free(x.turned);
    qdot_free(x.jumps);
    qdot_free(x.root);
    for (size_t i = 0; i < c->stage->events.n && x.thens; i++)
        qdot_tape_two_free(x.thens[i]);
    qdot_free(x.thens);
    qdot_free(x.fired.at);
    qdot_free(x.crossed.at);
    qdot_free(x.pushed.at);
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
    QDOT_TRY(qdot_course_remember(c, c->stage->modes.at[0]->plan));
    QDOT_TRY(qdot_bind_new(c->stage->modes.at[0]->plan, c->shaken, &bind));
    if (qdot_bind_remember(bind, c->history) == QDOT_OK && qdot_bind_scale(bind, c->stage->scales) == QDOT_OK
        && qdot_vec_push(&c->binds, bind) == QDOT_OK) {
        c->systems.at[0] = qdot_bind_system(bind);
        return QDOT_OK;
    }
    qdot_bind_free(bind);
    return QDOT_ENOMEM;
}

const qdot_ode_system *
qdot_course_systems(const qdot_course *c)
{
    return c->systems.at;
}

size_t
qdot_course_count(const qdot_course *c, size_t event)
{
    size_t n = 0;

    for (size_t i = 0; i < c->occurrences.n; i++)
        n += c->occurrences.at[i].event == event;
    return n;
}

void
qdot_course_clear(qdot_course *c)
{
    qdot_trajectory_clear(&c->tr);
    qdot_past_free(c->history);
    for (size_t i = 0; i < c->binds.n; i++)
        qdot_bind_free(c->binds.at[i]);
    for (size_t i = 0; i < c->watches.n; i++)
        qdot_watch_free(c->watches.at[i]);
    qdot_free(c->binds.at);
    qdot_free(c->systems.at);
    qdot_free(c->watches.at);
    qdot_free(c->occurrences.at);
    qdot_free(c->faded.at);
    qdot_free(c->ends.at);
    qdot_free(c->rests.at);
    clear_chatters(c);
    qdot_free(c->chatters.at);
    *c = (qdot_course){0};
}
