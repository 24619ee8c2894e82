/* stage-events.c -- the events of a run with parameter values inserted; their inverses for a run
 * backwards in time. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "sim/course/stage.h"
#include "sim/model/massless.h"
#include "sim/model/repeated-zeros.h"
#include "sim/model/undone.h"
#include "sim/plan/plan.h"

void
qdot_staged_event_clear(qdot_staged_event *e)
{
    if (e->undoing) {
        if (e->undoing->forward)
            qdot_staged_event_clear(e->undoing->forward);
        qdot_free(e->undoing->forward);
        qdot_tape_free(e->undoing->rates);
    }
    qdot_free(e->undoing);
    qdot_free(e->name);
    qdot_free(e->targets);
    qdot_tape_free(e->then);
}

/* Find whether setting component k of the state by an event may violate constraints. */
static qdot_status
may_violate_constraints(const qdot_scene *scene, const qdot_plan *p, size_t k, qdot_staged_event *e)
{
    const bool parameter = k >= p->n - p->n_states && k < p->n;

    e->velocities |= !parameter;
    e->positions |= k < p->n - p->n_states;
    for (size_t i = 0; parameter && i < scene->constraints.n; i++) {
        const qdot_expr f = qdot_plan_substitute(p, scene->constraints.at[i].f);

        QDOT_TRY(qdot_pool_check(p->pool));
        if (qdot_expr_contains(p->pool, f, p->inputs[k]))
            e->positions = e->velocities = true;
    }
    /* equations of massless coordinates are treated like constraints */
    for (size_t i = 0; parameter && p->massless && i < p->n - p->n_states; i++)
        if (p->massless[i] && qdot_expr_contains(p->pool, p->f[i], p->inputs[k])) {
            e->velocities = true;
            e->positions = e->positions || qdot_massless_kind(p, i) == QDOT_HOLONOMIC;
        }
    return QDOT_OK;
}

/* Prepare the changes made by an event: its `then` sets targets [n] to values [n]. */
static qdot_status
prepare_changes(const qdot_scene *scene, const qdot_plan *p, size_t n, const qdot_expr *targets, const qdot_expr *values,
                qdot_staged_event *e)
{
    bool changes = false;

    e->changes = n;
    e->targets = qdot_calloc(n + 1, sizeof *e->targets);
    if (!e->targets)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        e->targets[i] = qdot_expr_place(2 * p->n, p->inputs, targets[i]);
        e->accelerations |=
            (qdot_expr_node(p->pool, values[i])->holds & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)) != 0;
        QDOT_TRY(may_violate_constraints(scene, p, e->targets[i], e));
        changes |= values[i] != targets[i];
    }
    if (!changes) { /* if nothing changes, as in x' = x', the event is only recorded */
        e->changes = 0;
        e->positions = e->velocities = false;
        return QDOT_OK;
    }
    return n > 0 ? qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, n, values, &e->then) : QDOT_OK;
}

/* |u| has a kink at its zeros, which no polynomial shows, and u^2 hardly shows them: u is looked at. So is what has
 * the zeros of a function that jumps. */
static qdot_status
simplify_zeros(qdot_pool *pool, qdot_staged_event *e)
{
    qdot_repeated zeros;

    QDOT_TRY(qdot_watched_zeros(pool, e->function, &zeros));
    e->function = zeros.u;
    e->touches = zeros.touches;
    e->turn = zeros.turn;
    e->half = zeros.half;
    return QDOT_OK;
}

/* --- events of runs backwards in time ------------------------------------------------ */

static qdot_status
make_rate_tape(const qdot_plan *p, qdot_expr g, qdot_staged_undoing *u)
{
    qdot_expr *out = qdot_calloc(p->n + 2, sizeof *out);
    qdot_status status = QDOT_OK;

    if (!out)
        return QDOT_ENOMEM;
    out[0] = qdot_ddt(p->pool, g);
    out[1] = qdot_expr_node(p->pool, g)->holds & QDOT_HAS_VELOCITY ? QDOT_ZERO : qdot_ddt(p->pool, out[0]);
    for (size_t i = 0; i < p->n; i++)
        out[2 + i] = qdot_diff(p->pool, g, p->inputs[i]);
    status = qdot_pool_check(p->pool);
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, p->n + 2, out, &u->rates);
    qdot_free(out);
    return status;
}

/* Whether an event with function g leaves g' unchanged when it sets the given targets. */
static bool
leaves_rate_unchanged(const qdot_plan *p, qdot_expr g, size_t n, const qdot_expr *targets)
{
    return !qdot_expr_contains_any(p->pool, qdot_ddt(p->pool, g), n, targets);
}

/* Change e, which has an event's function and `then`, into the event that undoes it (for a backward run). */
static qdot_status
make_inverse_event(const qdot_scene *scene, const qdot_plan *p, size_t n, const qdot_expr *targets, const qdot_expr *values,
                   qdot_staged_event *e)
{
    const qdot_expr g = e->function;
    qdot_staged_event *forward = qdot_calloc(1, sizeof *forward);
    qdot_undone undone = {0};
    qdot_status status;

    e->undoing = qdot_calloc(1, sizeof *e->undoing);
    if (!e->undoing || !forward) {
        qdot_free(forward);
        return QDOT_ENOMEM;
    }
    *forward = *e;
    forward->undoing = NULL;
    forward->name = qdot_strdup(e->name);
    e->undoing->forward = forward;
    e->targets = NULL;
    e->then = NULL;
    e->changes = 0;
    e->accelerations = e->positions = e->velocities = false;
    status = forward->name ? qdot_undone_find(p->pool, g, n, targets, values, &undone) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = make_rate_tape(p, g, e->undoing);
    if (status == QDOT_OK && !undone.why)
        status = prepare_changes(scene, p, n, targets, undone.values, e);
    e->undoing->why = undone.why;
    e->undoing->keeps_speed = leaves_rate_unchanged(p, g, n, targets);
    e->undoing->nowhere = undone.function == QDOT_NIL;
    e->undoing->moved = undone.function != g;
    if (undone.function != QDOT_NIL)
        e->function = undone.function;
    qdot_undone_clear(&undone);
    return status == QDOT_OK ? qdot_pool_check(p->pool) : status;
}

/* --- all events of a scene ----------------------------------------------------------- */

static qdot_status
prepare_event(const qdot_stage *s, const qdot_plan *p, const qdot_event *event, qdot_staged_event *e)
{
    const size_t n = event->targets.n;
    qdot_expr *targets = qdot_calloc(2 * n + 1, sizeof *targets), *values = targets + n;
    qdot_status status;

    if (!targets)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        targets[i] = qdot_plan_substitute(p, event->targets.at[i]);
        values[i] = qdot_plan_substitute(p, event->values.at[i]);
    }
    e->function = qdot_plan_substitute(p, qdot_sub(p->pool, event->left, event->right));
    e->name = qdot_strdup(event->name);
    status = e->name ? qdot_pool_check(p->pool) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = prepare_changes(s->scene, p, n, targets, values, e);
    if (status == QDOT_OK && s->back && e->then)
        status = make_inverse_event(s->scene, p, n, targets, values, e);
    if (status == QDOT_OK)
        status = simplify_zeros(p->pool, e);
    qdot_free(targets);
    return status;
}

qdot_status
qdot_stage_events(qdot_stage *s, const qdot_plan *p)
{
    for (size_t i = 0; i < s->scene->events.n; i++) {
        const qdot_event *event = &s->scene->events.at[i];
        qdot_staged_event e = {.way = event->way, .stop = event->stop};
        qdot_status status = prepare_event(s, p, event, &e);

        if (status == QDOT_OK)
            status = qdot_vec_push(&s->events, e);
        if (status != QDOT_OK) {
            qdot_staged_event_clear(&e);
            return status;
        }
    }
    return QDOT_OK;
}
