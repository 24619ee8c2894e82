/* course.c -- the loop over pieces, and what is done between them. */
#include "sim/course.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "ode/taylor.h"

/* One thing may happen so often within a 1e-9 of the time of the run. */
enum { MOST_REPEATS = 4 };
static const double accumulation = 1e-9;

/* What comes next. */
typedef enum { GO_ON, RETRY, ACT } intent;

/* How often a thing happened since. */
typedef struct {
    qdot_watched_kind kind;
    size_t index, n;
    double since;
} repeat;

typedef struct {
    qdot_course *c;
    const qdot_ode_options *options;
    const qdot_ode_method *method;
    double t1, direction;
    size_t n;       /* of y */
    size_t mode;    /* of the piece */
    long *side;     /* [surfaces] */
    bool *on;       /* [surfaces] the piece starts on it */
    bool *functions_on; /* [functions] likewise */
    int *before;    /* [functions] */
    int *signs;     /* [functions] of the mode before, where its piece ended */
    double *residual; /* [functions] */
    bool first_step;
    bool far;       /* the step needed no look */

    /* What the step at hand showed. */
    intent intent;
    double t_act;
    double *y_act;                /* [n] the state there, of methods without series */
    bool broken_off;              /* by us, so that it is no failure */
    qdot_vec(qdot_root) roots;    /* that occur at t_act */
    qdot_vec(qdot_root) fired;    /* those that ended the piece before */
    size_t noted;                 /* occurrences before this step */

    /* Reading within the step. */
    qdot_watch_reader reader;
    const qdot_ode_expanded *expanded;
    qdot_trajectory step;         /* its two ends */
    qdot_trajectory_cursor *cursor;
    double *y; /* [n] scratch */
    size_t resting; /* the event of a contact that lasts */

    /* Sides tried from one point: [tries x surfaces]. */
    qdot_vec(long) tried;
    /* Times at which things happened, by kind and index. */
    qdot_vec(repeat) repeats;
} course;

static const qdot_mode *
mode_of(const course *x)
{
    return x->c->stage->modes.at[x->mode];
}

static qdot_watch *
watch_of(const course *x)
{
    return x->c->watches.at[x->mode];
}

/* --- reading within a step ----------------------------------------------------------- */

static qdot_status
read_series(double t, double *y, void *user)
{
    const course *x = user;
    const qdot_ode_expanded *s = x->expanded;

    qdot_ode_taylor_evaluate(x->reader.system, s->order, s->t, s->unit, t, s->y, y);
    return QDOT_OK;
}

static qdot_status
read_step(double t, double *y, void *user)
{
    const course *x = user;

    return qdot_trajectory_read(x->cursor, t, y);
}

/* --- what a step holds --------------------------------------------------------------- */

static bool
is_occurrence(const course *x, const qdot_root *root)
{
    const qdot_watched *w = &mode_of(x)->watched[root->function];
    int way = x->direction > 0 ? root->way : -root->way;

    if (w->kind == QDOT_WATCH_EVENT)
        return x->c->stage->events.at[w->index].way == 0
               || x->c->stage->events.at[w->index].way == way;
    return root->way != 0 && root->way != w->inside;
}

static bool
is_action(const course *x, const qdot_root *root)
{
    const qdot_watched *w = &mode_of(x)->watched[root->function];
    const qdot_staged_event *e = &x->c->stage->events.at[w->index];

    return w->kind != QDOT_WATCH_EVENT || e->stop || e->then;
}

static qdot_status
note(course *x, const qdot_root *root)
{
    const qdot_watched *w = &mode_of(x)->watched[root->function];
    qdot_occurrence o = {w->index, root->t, x->direction > 0 ? root->way : -root->way};

    return w->kind == QDOT_WATCH_EVENT ? qdot_vec_push(&x->c->occurrences, o) : QDOT_OK;
}

/* Whether the piece leaves the surfaces it starts on towards its own side. */
static bool
leaves_well(course *x)
{
    const int *first = qdot_watch_first(watch_of(x));
    const qdot_mode *m = mode_of(x);
    bool well = true;

    for (size_t i = 0; i < m->m; i++) {
        const qdot_watched *w = &m->watched[i];

        if (w->kind != QDOT_WATCH_SURFACE || !x->functions_on[i] || first[i] == 0
            || first[i] == w->inside)
            continue;
        well = false;
        x->side[w->index] = w->beyond;
    }
    return well;
}

/* A domain's bound that the piece starts on and does not leave inwards. */
static const qdot_watched *
leaves_domain(course *x)
{
    const int *first = qdot_watch_first(watch_of(x));
    const qdot_mode *m = mode_of(x);

    for (size_t i = 0; i < m->m; i++)
        if (m->watched[i].kind == QDOT_WATCH_DOMAIN && x->functions_on[i]
            && first[i] == -m->watched[i].inside)
            return &m->watched[i];
    return NULL;
}

/* Whether what ended the piece before has been answered: an event with `then` that is met
 * again at once, within rounding, in its own direction is a contact that lasts. */
static bool
leaves_event(course *x)
{
    const int *first = qdot_watch_first(watch_of(x));
    const bool *slow = qdot_watch_slow(watch_of(x));

    for (size_t k = 0; k < x->fired.n; k++) {
        size_t i = x->fired.at[k].function;
        const qdot_watched *w = i < x->c->stage->events.n ? &mode_of(x)->watched[i] : NULL;

        if (w && x->c->stage->events.at[w->index].then && x->functions_on[i] && slow[i]
            && first[i] != 0 && first[i] == x->fired.at[k].way) {
            x->resting = w->index;
            return false;
        }
    }
    return true;
}

static qdot_status
say_resting(course *x, double t)
{
    snprintf(x->c->reason, sizeof x->c->reason,
             "stopped at t = %.15g: behind the event %.100s the motion does not leave it: "
             "a contact that lasts is no event",
             t, x->c->stage->events.at[x->resting].name);
    x->t_act = t;
    x->intent = ACT;
    return QDOT_OK;
}

/* The roots of the step: noted up to the first that ends the piece. */
static qdot_status
take_roots(course *x, double t0, const qdot_root *roots, size_t n)
{
    x->roots.n = 0;
    x->c->occurrences.n = x->noted;
    x->intent = GO_ON;
    if (x->first_step) {
        const qdot_watched *w = leaves_domain(x);

        if (w) {
            qdot_root root = {(size_t)(w - mode_of(x)->watched), t0, -w->inside, 0};

            x->intent = ACT;
            x->t_act = t0;
            return qdot_vec_push(&x->roots, root);
        }
        if (!leaves_well(x)) {
            x->intent = RETRY;
            return QDOT_OK;
        }
        if (!leaves_event(x))
            return say_resting(x, t0);
    }
    for (size_t i = 0; i < n; i++) {
        if (!is_occurrence(x, &roots[i]))
            continue;
        if (x->intent == ACT && roots[i].t != x->t_act)
            break;
        if (x->intent != ACT && is_action(x, &roots[i])) {
            x->intent = ACT;
            x->t_act = roots[i].t;
            for (; x->c->occurrences.n > x->noted
                   && x->c->occurrences.at[x->c->occurrences.n - 1].t == x->t_act;
                 x->c->occurrences.n--) /* they are noted again, in order */
                ;
            for (size_t k = 0; k < i; k++)
                if (roots[k].t == x->t_act && is_occurrence(x, &roots[k])) {
                    QDOT_TRY(note(x, &roots[k]));
                    QDOT_TRY(qdot_vec_push(&x->roots, roots[k]));
                }
        }
        QDOT_TRY(note(x, &roots[i]));
        if (x->intent == ACT)
            QDOT_TRY(qdot_vec_push(&x->roots, roots[i]));
    }
    return QDOT_OK;
}

/* A bound that is passed at t_act: the piece ends a double before. */
static void
stay_inside(course *x, double t0)
{
    for (size_t i = 0; i < x->roots.n; i++)
        if (mode_of(x)->watched[x->roots.at[i].function].kind == QDOT_WATCH_DOMAIN
            && x->t_act != t0)
            x->t_act = nextafter(x->t_act, -x->direction * INFINITY);
}

/* Ends an integration that is gone on with otherwise. */
static qdot_status
break_off(course *x)
{
    x->broken_off = true;
    return qdot_fail(QDOT_ELIMIT, "the piece is over");
}

static qdot_status
look_at_expanded(qdot_ode_expanded *step, void *user)
{
    course *x = user;
    const qdot_root *roots;
    size_t n;

    x->far = !x->first_step
             && qdot_watch_is_far(watch_of(x), step->t_end, x->reader.system->series,
                                  step->order, step->unit);
    if (x->far) {
        x->intent = GO_ON; /* of a longer step that was not taken */
        x->c->occurrences.n = x->noted;
        return QDOT_OK;
    }
    x->expanded = step;
    QDOT_TRY(read_series(step->t_end, x->y, x));
    QDOT_TRY(qdot_watch_step(watch_of(x), &x->reader, step->t_end, x->y,
                             step->t_end == x->t1, x->reader.system->series, step->order,
                             step->unit, &roots, &n));
    QDOT_TRY(take_roots(x, step->t, roots, n));
    if (x->intent == ACT)
        stay_inside(x, step->t);
    if (x->intent == RETRY || (x->intent == ACT && x->t_act == step->t))
        return break_off(x);
    if (x->intent == ACT)
        step->t_end = x->t_act;
    return QDOT_OK;
}

/* Without a series: from the ends of the step. */
static qdot_status
look_at_step(course *x, double t, const double *y)
{
    const qdot_root *roots;
    size_t n;

    x->step.t[1] = t;
    memcpy(x->step.y + x->n, y, x->n * sizeof *y);
    qdot_trajectory_renew(x->cursor);
    QDOT_TRY(qdot_watch_step(watch_of(x), &x->reader, t, y, t == x->t1, NULL, 0, 0,
                             &roots, &n));
    QDOT_TRY(take_roots(x, x->step.t[0], roots, n));
    if (x->intent == RETRY)
        return break_off(x);
    if (x->intent == ACT) {
        stay_inside(x, x->step.t[0]);
        return qdot_trajectory_read(x->cursor, x->t_act, x->y_act);
    }
    x->step.t[0] = t;
    memcpy(x->step.y, y, x->n * sizeof *y);
    return QDOT_OK;
}

static qdot_status
accepted(double t, const double *y, bool *stop, void *user)
{
    course *x = user;

    if (x->options->accepted)
        QDOT_TRY(x->options->accepted(t, y, stop, x->options->user));
    if (mode_of(x)->m == 0)
        return QDOT_OK;
    if (!x->method->series)
        QDOT_TRY(look_at_step(x, t, y));
    x->first_step = false;
    if (x->far) {
        qdot_watch_pass(watch_of(x), t, y);
        return QDOT_OK;
    }
    if (x->intent == ACT) {
        *stop = true;
        return QDOT_OK;
    }
    x->noted = x->c->occurrences.n;
    qdot_watch_take(watch_of(x));
    return QDOT_OK;
}

/* --- pieces -------------------------------------------------------------------------- */

/* Everything of the mode with these sides. */
static qdot_status
enter_mode(course *x)
{
    qdot_course *c = x->c;
    const qdot_mode *m;

    QDOT_TRY(qdot_stage_mode(c->stage, x->side, &x->mode));
    while (c->binds.n <= x->mode) {
        QDOT_TRY(qdot_vec_push(&c->binds, NULL));
        QDOT_TRY(qdot_vec_push(&c->systems, (qdot_ode_system){0}));
        QDOT_TRY(qdot_vec_push(&c->watches, NULL));
    }
    m = mode_of(x);
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
make_room(course *x)
{
    size_t m = 2 * x->c->stage->switches.surfaces.n + x->c->stage->events.n
               + 2 * x->c->stage->domains.n + 1;

    x->side = qdot_calloc(m, sizeof *x->side);
    x->on = qdot_calloc(m, sizeof *x->on);
    x->functions_on = qdot_calloc(m, sizeof *x->functions_on);
    x->before = qdot_calloc(m, sizeof *x->before);
    x->residual = qdot_calloc(m, sizeof *x->residual);
    x->signs = qdot_calloc(m, sizeof *x->signs);
    x->y = qdot_calloc(2 * x->n, sizeof *x->y);
    x->step = (qdot_trajectory){.n = x->n, .count = 2, .method = x->method,
                                .tol = x->options->tol,
                                .order_more = x->options->order_more};
    x->step.t = qdot_calloc(2, sizeof *x->step.t);
    x->step.y = qdot_calloc(2 * x->n, sizeof *x->step.y);
    if (!x->side || !x->on || !x->functions_on || !x->before || !x->residual || !x->signs || !x->y
        || !x->step.t || !x->step.y)
        return QDOT_ENOMEM;
    x->y_act = x->y + x->n;
    return qdot_vec_push(&x->step.pieces, (qdot_trajectory_piece){0});
}

/* The watch at the start of a piece. */
static qdot_status
begin_watch(course *x, double t, const double *y)
{
    qdot_trajectory_close(x->cursor);
    x->cursor = NULL;
    x->reader = (qdot_watch_reader){x->method->series ? read_series : read_step, x,
                                    &x->c->systems.at[x->mode],
                                    qdot_bind_held(x->c->binds.at[x->mode])};
    if (mode_of(x)->m == 0)
        return QDOT_OK;
    if (!x->method->series) {
        x->step.t[0] = t;
        x->step.t[1] = t + x->direction;
        memcpy(x->step.y, y, x->n * sizeof *y);
        QDOT_TRY(qdot_trajectory_open(&x->step, x->reader.system, &x->cursor));
    }
    return qdot_watch_begin(watch_of(x), &x->reader, t, y,
                            x->c->shaken && x->c->tr.count == 1, x->before, x->residual,
                            x->functions_on);
}

/* Integrate a piece from y at t; the first one begins the trajectory. */
static qdot_status
integrate(course *x, double t, const double *y, bool jumped)
{
    qdot_course *c = x->c;
    qdot_ode_options options = *x->options;
    qdot_status status;
    const qdot_ode_system *system = &c->systems.at[x->mode];

    options.accepted = accepted;
    options.expanded =
        mode_of(x)->m > 0 && x->method->series ? look_at_expanded : NULL;
    options.user = x;
    if (c->tr.count > 1 || t != c->tr.t[0])
        options.carry = NULL;
    x->intent = GO_ON;
    x->broken_off = false;
    x->first_step = true;
    x->far = false;
    x->noted = c->occurrences.n;
    status = qdot_trajectory_resume(&c->tr, system, x->mode, jumped, &options, x->t1, y);
    if (x->broken_off) {
        c->tr.result.outcome = QDOT_ODE_STOPPED;
        c->tr.result.reason[0] = '\0';
        return QDOT_OK;
    }
    if (status == QDOT_OK && x->intent == ACT && !x->method->series)
        qdot_trajectory_shorten(&c->tr, x->t_act, x->y_act);
    return status;
}

/* --- what happens -------------------------------------------------------------------- */

static qdot_status
stop_because(course *x, bool failed)
{
    x->c->failed = failed;
    x->c->tr.result.outcome = failed ? QDOT_ODE_FAILED : QDOT_ODE_STOPPED;
    return QDOT_OK;
}

static void
say_left(course *x, const qdot_watched *w)
{
    const qdot_domain *d = &x->c->stage->domains.at[w->index];

    snprintf(x->c->reason, sizeof x->c->reason, "%.100s left its domain %.200s at t = "
                                                "%.15g",
             mode_of(x)->plan->names[d->coordinate], d->text, x->t_act);
}

/* The new values of an event, all from the old ones. */
static qdot_status
change(course *x, const qdot_staged_event *e, double t, const double *old, double *y)
{
    const qdot_plan *p = mode_of(x)->plan;
    const qdot_ode_system *system = x->reader.system;
    size_t inputs = qdot_plan_inputs(p);
    double *in = qdot_calloc(inputs + 2 * p->n + e->changes + 1 + qdot_tape_work(e->then),
                             sizeof *in);
    double *dydt = in ? in + inputs : NULL, *out = in ? dydt + 2 * p->n : NULL;
    qdot_status status = in ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(in, old, x->n * sizeof *in);
        in[x->n] = t;
        if (e->accelerations && x->reader.held)
            status = qdot_constrained_solve(x->reader.held, t, old, in + x->n + 1,
                                     in + x->n + 1 + p->n);
        else if (e->accelerations)
            status = system->rhs(t, old, dydt, system->user);
    }
    if (status == QDOT_OK) {
        if (e->accelerations && !x->reader.held)
            memcpy(in + x->n + 1, dydt + p->n, p->n * sizeof *in);
        qdot_tape_eval(e->then, in, out, out + e->changes + 1);
        for (size_t i = 0; i < e->changes; i++) {
            if (!isfinite(out[i]))
                status = qdot_fail(QDOT_EDOMAIN,
                                   "the event %.100s gives %.100s no value at t = %.15g",
                                   e->name,
                                   e->targets[i] < p->n ? p->names[e->targets[i]]
                                                        : "a velocity",
                                   t);
            y[e->targets[i]] = out[i];
        }
    }
    if (status == QDOT_OK && system->project) { /* what the constraints make of it */
        double by;

        status = system->project(t, y, NULL, &by, system->user);
    }
    qdot_free(in);
    return status;
}

/* Whether a thing happens ever faster. */
static qdot_status
accumulates(course *x, const qdot_watched *w, double t, bool *yes)
{
    double span = accumulation * fmax(fabs(t), fabs(x->t1 - x->c->tr.t[0]));
    repeat *r = NULL;

    *yes = false;
    for (size_t i = 0; i < x->repeats.n; i++)
        if (x->repeats.at[i].kind == w->kind && x->repeats.at[i].index == w->index)
            r = &x->repeats.at[i];
    if (!r) {
        repeat new = {w->kind, w->index, 1, t};

        return qdot_vec_push(&x->repeats, new);
    }
    if (fabs(t - r->since) > span) {
        r->since = t;
        r->n = 0;
    }
    *yes = ++r->n > MOST_REPEATS;
    return QDOT_OK;
}

static void
say_accumulated(course *x, const qdot_watched *w, double t)
{
    qdot_text text = {0};

    if (w->kind == QDOT_WATCH_EVENT)
        qdot_text_format(&text, "the event %.100s", x->c->stage->events.at[w->index].name);
    else if (qdot_stage_describe(x->c->stage, w->index, mode_of(x)->side[w->index], &text)
             != QDOT_OK)
        qdot_text_add(&text, "a switch of the equations");
    snprintf(x->c->reason, sizeof x->c->reason,
             "stopped at t = %.15g: %.200s comes ever faster there, without end", t,
             qdot_text_str(&text));
    qdot_text_clear(&text);
}

static void
say_sliding(course *x, double t)
{
    const qdot_mode *m = mode_of(x);
    qdot_text text = {0};

    for (size_t i = 0; i < m->m; i++)
        if (m->watched[i].kind == QDOT_WATCH_SURFACE && x->functions_on[i] && text.n == 0
            && qdot_stage_describe(x->c->stage, m->watched[i].index,
                                   m->side[m->watched[i].index]
                                       + (m->watched[i].inside < 0),
                                   &text)
                   != QDOT_OK)
            qdot_text_truncate(&text, 0);
    snprintf(x->c->reason, sizeof x->c->reason,
             "stopped at t = %.15g: the motion would slide along %.200s, where the "
             "equations switch: both sides lead back to it",
             t, text.n > 0 ? qdot_text_str(&text) : "a surface");
    qdot_text_clear(&text);
}

/* All that occurs at t_act, in order; y is the state there, and then the one behind.
 * *over: the run ends. */
static qdot_status
act(course *x, double *y, bool *over, bool *jumped)
{
    double *old = qdot_malloc(x->n * sizeof *old);
    qdot_status status = old ? QDOT_OK : QDOT_ENOMEM;
    const qdot_mode *m = mode_of(x);
    double t = x->t_act;

    if (old)
        memcpy(old, y, x->n * sizeof *y);
    x->fired.n = 0;
    for (size_t i = 0; i < x->roots.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&x->fired, x->roots.at[i]);
    if (status == QDOT_OK)
        status = qdot_watch_look(watch_of(x), &x->reader, t, y, x->signs);
    for (size_t i = 0; i < x->roots.n && status == QDOT_OK; i++) {
        const qdot_root *root = &x->roots.at[i];
        const qdot_watched *w = &m->watched[root->function];
        bool fast = false;

        if (w->kind == QDOT_WATCH_DOMAIN) {
            say_left(x, w);
            *over = true;
            status = stop_because(x, true);
            break;
        }
        if (w->kind == QDOT_WATCH_SURFACE) {
            x->side[w->index] = w->beyond;
        } else {
            const qdot_staged_event *e = &x->c->stage->events.at[w->index];

            if (e->then) {
                status = change(x, e, t, old, y);
                *jumped = true;
            }
            if (e->stop && status == QDOT_OK) {
                x->c->stopped_by = w->index;
                *over = true;
                status = stop_because(x, false);
            }
            if (!e->stop && !e->then)
                continue;
        }
        if (status == QDOT_OK)
            status = accumulates(x, w, t, &fast);
        if (fast && !*over) {
            say_accumulated(x, w, t);
            *over = true;
            status = stop_because(x, true);
        }
    }
    qdot_free(old);
    return status;
}

/* --- sides at the start of a piece --------------------------------------------------- */

/* The sides at a state that is new, or where a piece ended: those that the state is
 * clearly on, and for the others what x->side has. */
static qdot_status
find_sides(course *x, double t, const double *y, bool all)
{
    size_t surfaces = x->c->stage->switches.surfaces.n;
    long *found = qdot_calloc(surfaces + 1, sizeof *found);
    qdot_status status = found ? qdot_stage_sides(x->c->stage, t, y, found, x->on)
                               : QDOT_ENOMEM;

    for (size_t i = 0; i < surfaces && status == QDOT_OK; i++)
        if (all)
            x->side[i] = found[i];
    qdot_free(found);
    return status;
}

/* Whether these sides were tried from here; they are now. */
static qdot_status
try_sides(course *x, bool *again)
{
    size_t surfaces = x->c->stage->switches.surfaces.n;

    *again = false;
    for (size_t k = 0; k + surfaces <= x->tried.n && surfaces > 0; k += surfaces)
        *again = *again
                 || memcmp(x->tried.at + k, x->side, surfaces * sizeof *x->side) == 0;
    for (size_t i = 0; i < surfaces && !*again; i++)
        QDOT_TRY(qdot_vec_push(&x->tried, x->side[i]));
    return QDOT_OK;
}

/* Whether an event has been counted a double or so before the piece ended. */
static bool
just_noted(const course *x, size_t event)
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

/* What is known of the functions where the last piece ended, by those of the next: events
 * and domains keep their places; a surface's are of the one that is on the same place. */
static void
carry(course *x, size_t from, bool jumped)
{
    const qdot_mode *old = x->c->stage->modes.at[from], *new = mode_of(x);
    size_t events = x->c->stage->events.n;

    for (size_t i = 0; i < new->m; i++) {
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
        for (size_t i = 0; i < new->m; i++)
            if (new->watched[i].kind == QDOT_WATCH_SURFACE
                && new->watched[i].index == w->index
                && (new->watched[i].beyond == old->side[w->index]
                    || old->side[w->index] == new->side[w->index]))
                x->residual[i] = root->residual;
    }
}

/* --- the whole ----------------------------------------------------------------------- */

/* From y at t, which is the last point, through one piece that leaves well. */
static qdot_status
one_piece(course *x, size_t from, double t, const double *y, bool jumped)
{
    bool again;

    x->tried.n = 0;
    for (;;) {
        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(try_sides(x, &again));
        if (again) {
            say_sliding(x, t);
            return stop_because(x, true);
        }
        QDOT_TRY(enter_mode(x));
        carry(x, from, jumped);
        QDOT_TRY(begin_watch(x, t, y));
        QDOT_TRY(integrate(x, t, y, jumped));
        if (x->intent != RETRY)
            return QDOT_OK;
    }
}

static qdot_status
loop(course *x, double t0, const double *y0)
{
    qdot_course *c = x->c;
    double *y = qdot_malloc(x->n * sizeof *y), t = t0;
    bool jumped = false, over = false;
    size_t from;
    qdot_status status = y ? find_sides(x, t0, y0, true) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        memcpy(y, y0, x->n * sizeof *y);
    if (status == QDOT_OK)
        status = enter_mode(x);
    from = x->mode;
    if (status == QDOT_OK) /* the start, to go on from */
        status = qdot_trajectory_run(&c->tr, &c->systems.at[x->mode], x->method,
                                     x->options, t0, t0, y0);
    while (status == QDOT_OK && !over) {
        status = one_piece(x, from, t, y, jumped);
        if (status == QDOT_OK && c->reason[0] != '\0')
            status = stop_because(x, true);
        if (status != QDOT_OK || x->intent != ACT || c->reason[0] != '\0')
            break;
        from = x->mode;
        jumped = false;
        t = c->tr.t[c->tr.count - 1];
        memcpy(y, c->tr.y + (c->tr.count - 1) * x->n, x->n * sizeof *y);
        status = act(x, y, &over, &jumped);
        if (status == QDOT_OK && over && jumped)
            status = qdot_trajectory_resume(&c->tr, &c->systems.at[x->mode], x->mode,
                                            true, x->options, t, y);
        if (status == QDOT_OK && over)
            c->tr.result.outcome = c->failed ? QDOT_ODE_FAILED : QDOT_ODE_STOPPED;
        if (status == QDOT_OK && !over)
            status = find_sides(x, t, y, jumped);
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
    course x = {.c = c,
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
    qdot_free(x.on);
    qdot_free(x.functions_on);
    qdot_free(x.before);
    qdot_free(x.residual);
    qdot_free(x.signs);
    qdot_free(x.fired.at);
    qdot_free(x.y);
    qdot_free(x.roots.at);
    qdot_free(x.tried.at);
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
    *c = (qdot_course){0};
}
