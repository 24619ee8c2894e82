/* steps.c -- inspects the steps of vector lanes for states at given times, events and bounds. */
#include "sim/ensemble/steps.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/taylor.h"
#include "sim/ensemble/doubts.h"
#include "sim/model/repeated-zeros.h"
#include "sim/watch/watch.h"

enum { L = QDOT_LANES, STRIDE = QDOT_SERIES_MOST + 8 };

/* A vector lane: its member, the results observed so far, and its present step as a system of equations. */
typedef struct {
    size_t member;
    bool begun; /* `watch` has been started for this member */
    size_t passed, next;       /* number of requested times before the step; number of them up to the step's end */
    bool doubtful;             /* the step shows something that vector lanes cannot compute reliably */
    qdot_vec(qdot_root) roots; /* roots of event functions in the step */
    double *end;               /* [2N] state at the end of the step */
    double *x;                 /* [2N x STRIDE] Taylor coefficients of the step */
    double *y;                 /* [2N] state at the start of the step */
    qdot_ode_series series;
    qdot_ode_system system;
    qdot_ode_expanded step;
    qdot_watch *watch;         /* finds events; NULL: no events */
    qdot_ensemble_doubts *doubts; /* further checks of each step; NULL: none */
} lane;

struct qdot_ensemble_steps {
    qdot_ensemble_steps_of of;
    size_t n, varied, N;  /* number of coordinates; of varied parameters; their sum */
    size_t stride;        /* distance of two rows of the system's Taylor coefficients, in groups of lanes */
    size_t asked;         /* number of occurrences stored for a member, over all events */
    qdot_repeated *zeros; /* [events] smooth functions with the same zeros as the events' */
    size_t *first;        /* [events] index of the first stored occurrence of each event */
    lane lanes[L];
    size_t members;
    double *seen;         /* [members x times x (2n + varied)] states at the requested times */
    double *occurred;     /* [members x asked] times of the occurrences */
    size_t *count;        /* [members x events] number of occurrences so far */
    double *sizes;        /* [members x 2n] largest magnitudes of the state */
    size_t *passed;       /* [members] number of requested times already reached */
    bool *doubtful;       /* [members] must be repeated as a single run */
    qdot_ensemble_starts *starts; /* [members] starts of all steps; NULL: not stored */
};

/* --- making the lanes ----------------------------------------------------------------- */

static void
clear_steps(qdot_ensemble_steps *s)
{
    for (size_t m = 0; s->starts && m < s->members; m++)
        qdot_free(s->starts[m].at);
    qdot_free(s->starts);
    s->starts = NULL;
    qdot_free(s->seen);
    qdot_free(s->occurred);
    qdot_free(s->count);
    qdot_free(s->sizes);
    qdot_free(s->passed);
    qdot_free(s->doubtful);
    s->seen = s->occurred = s->sizes = NULL;
    s->count = s->passed = NULL;
    s->doubtful = NULL;
}

void
qdot_ensemble_steps_free(qdot_ensemble_steps *s)
{
    if (!s)
        return;
    clear_steps(s);
    for (size_t l = 0; l < L; l++) {
        qdot_free(s->lanes[l].roots.at);
        qdot_free(s->lanes[l].end);
        qdot_free(s->lanes[l].x);
        qdot_watch_free(s->lanes[l].watch);
        qdot_ensemble_doubts_free(s->lanes[l].doubts);
    }
    qdot_free(s->first);
    qdot_free(s->zeros);
    qdot_free(s);
}

static qdot_status
make_lane(const qdot_ensemble_steps *s, const qdot_expr *g, lane *a)
{
    const size_t n = 2 * s->N, events = s->of.watching->n_events;

    a->end = qdot_calloc(2 * n, sizeof *a->end);
    a->x = qdot_calloc(n * STRIDE, sizeof *a->x);
    if (!a->end || !a->x)
        return QDOT_ENOMEM;
    a->y = a->end + n;
    a->member = SIZE_MAX;
    a->series = (qdot_ode_series){.most = QDOT_SERIES_MOST, .x = a->x, .stride = STRIDE};
    a->system = (qdot_ode_system){.n = n, .series = &a->series};
    if (!s->of.moved) /* only for the runs themselves: companion runs begin from shifted states */
        QDOT_TRY(qdot_ensemble_doubts_new(s->of.plan, &a->doubts));
    if (events)
        QDOT_TRY(qdot_watch_new(s->of.plan, events, g, s->of.shaken, s->of.tol, &a->watch));
    for (size_t i = 0; i < events; i++)
        QDOT_TRY(qdot_watch_turns(a->watch, i, s->zeros[i].turn, s->zeros[i].half));
    return QDOT_OK;
}

static qdot_status
make_step_inspection(qdot_ensemble_steps *s)
{
    const qdot_ensemble_watching *w = s->of.watching;
    qdot_expr *g = qdot_calloc(w->n_events + 1, sizeof *g);
    qdot_status status = QDOT_OK;

    s->first = qdot_calloc(w->n_events + 1, sizeof *s->first);
    s->zeros = qdot_calloc(w->n_events + 1, sizeof *s->zeros);
    if (!g || !s->first || !s->zeros)
        status = QDOT_ENOMEM;
    for (size_t i = 0; i < w->n_events && status == QDOT_OK; i++) {
        status = qdot_watched_zeros(s->of.plan->pool, qdot_plan_substitute(s->of.plan, w->events[i].function),
                                    &s->zeros[i]);
        g[i] = s->zeros[i].u;
        s->first[i] = s->asked;
        s->asked += w->events[i].count;
    }
    for (size_t l = 0; l < L && status == QDOT_OK; l++)
        status = make_lane(s, g, s->lanes + l);
    qdot_free(g);
    return status;
}

qdot_status
qdot_ensemble_steps_new(const qdot_ensemble_steps_of *of, qdot_ensemble_steps **steps)
{
    qdot_ensemble_steps *s = qdot_calloc(1, sizeof *s);
    qdot_status status;

    *steps = NULL;
    if (!s)
        return QDOT_ENOMEM;
    s->of = *of;
    s->N = of->plan->n;
    s->varied = of->plan->n_states;
    s->n = s->N - s->varied;
    status = make_step_inspection(s);
    if (status == QDOT_OK)
        *steps = s;
    else
        qdot_ensemble_steps_free(s);
    return status;
}

qdot_status
qdot_ensemble_steps_begin(qdot_ensemble_steps *s, size_t members)
{
    const size_t width = 2 * s->n + s->varied;

    clear_steps(s);
    s->members = members;
    s->seen = qdot_calloc(members * s->of.n_times * width + 1, sizeof *s->seen);
    s->occurred = qdot_calloc(members * s->asked + 1, sizeof *s->occurred);
    s->count = qdot_calloc(members * s->of.watching->n_events + 1, sizeof *s->count);
    s->sizes = qdot_calloc(members * 2 * s->n + 1, sizeof *s->sizes);
    s->passed = qdot_calloc(members + 1, sizeof *s->passed);
    s->doubtful = qdot_calloc(members + 1, sizeof *s->doubtful);
    if (s->of.watching->keep) {
        s->starts = qdot_calloc(members + 1, sizeof *s->starts);
        if (!s->starts)
            return QDOT_ENOMEM;
    }
    if (!s->seen || !s->occurred || !s->count || !s->sizes || !s->passed || !s->doubtful)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < members * s->asked; i++)
        s->occurred[i] = NAN;
    for (size_t l = 0; l < L; l++)
        s->lanes[l].member = SIZE_MAX;
    return QDOT_OK;
}

/* --- inspecting a step ---------------------------------------------------------------- */

/* The state at time t by the step's series, even and odd orders apart: components by fours, none of which
 * waits for another. */
static void
read_state(const qdot_ensemble_steps *s, const qdot_batch_step *step, double t, double *to)
{
    enum { SIDE_BY_SIDE = 4 };
    const double at = (t - step->t) / step->unit, square = at * at;
    const size_t n = 2 * s->n, row = s->stride * L;
    const int odd = (step->order - 1) | 1; /* the highest odd order below p, at which the summation starts */

    for (size_t i = 0; i < n + s->varied; i++)
        to[i] = step->y[i * L];
    for (size_t i = 0; i < n; i += SIDE_BY_SIDE) {
        const size_t count = n - i < SIDE_BY_SIDE ? n - i : SIDE_BY_SIDE;
        double sum[SIDE_BY_SIDE] = {0}, even[SIDE_BY_SIDE] = {0};

        for (size_t j = 0; j < count && odd < step->order; j++)
            even[j] = step->x[(i + j) * row + (size_t)step->order * L];
        for (int k = odd; k > 0; k -= 2)
            for (size_t j = 0; j < count; j++) {
                const double *x = step->x + (i + j) * row + (size_t)k * L;

                sum[j] = sum[j] * square + x[0];
                even[j] = even[j] * square + (k > 1 ? x[-L] : 0);
            }
        for (size_t j = 0; j < count; j++)
            to[i + j] += sum[j] * at + even[j];
    }
}

/* Evaluate the state at t within the step of a lane, for the root finder. */
static qdot_status
read_lane_state(double t, double *y, void *user)
{
    const lane *a = user;

    qdot_ode_taylor_evaluate(&a->system, a->step.order, a->step.t, a->step.unit, t, a->y, y);
    return QDOT_OK;
}

/* The index, in a state followed by parameters, of component i of a batch. */
static size_t
index_in_state(const qdot_ensemble_steps *s, size_t i)
{
    return i < s->n ? i : i < 2 * s->n ? i + s->varied : i - s->n;
}

/* Copy the Taylor coefficients of the step, and its start state, into the lane. */
static void
copy_series(const qdot_ensemble_steps *s, const qdot_batch_step *step, lane *a)
{
    for (size_t i = 0; i < 2 * s->n + s->varied; i++) {
        const double *from = step->x + i * s->stride * L;
        double *to = a->x + index_in_state(s, i) * STRIDE;

        a->y[index_in_state(s, i)] = to[0] = step->y[i * L];
        for (int k = 1; k <= step->order && i < 2 * s->n; k++)
            to[k] = from[(size_t)k * L];
    }
    a->step = (qdot_ode_expanded){step->t, step->t_end, step->unit, step->order, a->y, NULL, step->t_end};
}

/* Start the search for an ensemble member's events, at the start of the member. */
static qdot_status
begin_event_search(const qdot_ensemble_steps *s, lane *a)
{
    const qdot_watch_reader reader = {read_lane_state, NULL, a, false, &a->system, NULL};
    const size_t m = s->of.watching->n_events;
    int *before = qdot_calloc(m + 1, sizeof *before);
    bool *on = qdot_calloc(m + 1, sizeof *on);
    qdot_status status = before && on ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_watch_begin(a->watch, &reader, a->step.t, a->y,
                                  &(qdot_watch_known){s->of.moved, false, before, NULL, NULL, NULL, 0}, on);
    a->begun = true;
    qdot_free(before);
    qdot_free(on);
    return status;
}

/* Search the step for events; if that fails, the member is marked to be repeated as a single run. */
static qdot_status
search_events_in_step(const qdot_ensemble_steps *s, bool last, lane *a)
{
    const qdot_root *roots;
    size_t n = 0;
    qdot_status status = a->begun ? QDOT_OK : begin_event_search(s, a);

    a->roots.n = 0;
    if (status == QDOT_OK)
        status = qdot_watch_step(a->watch, a->step.t_end, a->end, last, &a->step, &roots, &n);
    if (qdot_grave(status) != QDOT_OK)
        return status;
    a->doubtful = a->doubtful || status != QDOT_OK;
    for (size_t k = 0; k < n && status == QDOT_OK; k++) {
        a->doubtful = a->doubtful || roots[k].way == 0 || roots[k].within > 0;
        QDOT_TRY(qdot_vec_push(&a->roots, roots[k]));
    }
    return QDOT_OK;
}

/* Whether a coordinate may come near a bound of its domain within the step. */
static bool
may_reach_bound(const qdot_ensemble_steps *s, const qdot_batch_step *step)
{
    const qdot_ensemble_watching *w = s->of.watching;
    const double h = fabs((step->t_end - step->t) / step->unit);

    for (size_t b = 0; b < w->n_bounds; b++) {
        const size_t i = w->bounds[b].coordinate;
        const double *x = step->x + i * s->stride * L;
        double span = 0;

        for (int k = step->order; k > 0; k--)
            span = (span + fabs(x[(size_t)k * L])) * h;
        if (!(fabs(step->y[i * L] - w->bounds[b].bound) > span))
            return true;
    }
    return false;
}

/* Inspect the step for what a lane cannot treat (sim/ensemble/doubts.h), and search it for events. */
static qdot_status
inspect_lane_step(const qdot_ensemble_steps *s, const qdot_batch_step *step, lane *a)
{
    qdot_pulses_step seen = {.a = step->t,
                             .b = step->t_end,
                             .tol = s->of.tol,
                             .from = a->y,
                             .to = a->end,
                             .read = read_lane_state,
                             .user = a};

    copy_series(s, step, a);
    QDOT_TRY(read_lane_state(step->t_end, a->end, a));
    if (a->doubts && !a->doubtful)
        QDOT_TRY(qdot_ensemble_doubts_look(a->doubts, &seen, &a->doubtful));
    return a->watch ? search_events_in_step(s, step->last, a) : QDOT_OK;
}

/* Put the lane at the start of its next member. */
static qdot_status
lane_enter_member(qdot_ensemble_steps *s, const qdot_batch_step *step, lane *a)
{
    a->member = step->member;
    a->begun = false;
    a->passed = 0;
    for (size_t i = 0; i < 2 * s->n; i++)
        s->sizes[step->member * 2 * s->n + i] = fabs(step->y[i * L]);
    return a->doubts ? qdot_ensemble_doubts_begin(a->doubts) : QDOT_OK;
}

/* Store the start of a step of an ensemble member, unless it is stored already. */
static qdot_status
store_step_start(const qdot_ensemble_steps *s, const qdot_batch_step *step)
{
    const size_t width = 2 * s->n + s->varied;
    qdot_ensemble_starts *starts = s->starts + step->member;

    if (starts->n > 0 && starts->at[starts->n - width - 1] == step->t)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(starts, step->t));
    for (size_t i = 0; i < width; i++)
        QDOT_TRY(qdot_vec_push(starts, step->y[i * L]));
    return QDOT_OK;
}

static qdot_status
inspect_tried_step(const qdot_batch_step *step, void *user)
{
    qdot_ensemble_steps *s = user;
    lane *a = s->lanes + step->lane;
    const size_t width = 2 * s->n + s->varied;
    double *sizes = s->sizes + step->member * 2 * s->n;

    if (a->member != step->member)
        QDOT_TRY(lane_enter_member(s, step, a));
    if (s->starts)
        QDOT_TRY(store_step_start(s, step));
    a->next = a->passed;
    a->step.t_end = step->t_end;
    while (a->next < s->of.n_times
           && (s->of.backward ? s->of.times[a->next] >= step->t_end
                              : s->of.times[a->next] <= step->t_end)) {
        read_state(s, step, s->of.times[a->next],
                   s->seen + (step->member * s->of.n_times + a->next) * width);
        a->next++;
    }
    a->doubtful = may_reach_bound(s, step);
    for (size_t i = 0; i < 2 * s->n; i++) {
        const double size = fabs(step->y[i * L]);

        if (size > sizes[i])
            sizes[i] = size;
    }
    return a->watch || a->doubts ? inspect_lane_step(s, step, a) : QDOT_OK;
}

/* Count the events found in the step; returns whether all events requested of this member have occurred. */
static bool
count_events(qdot_ensemble_steps *s, lane *a)
{
    const qdot_ensemble_watching *w = s->of.watching;
    size_t *count = s->count + a->member * w->n_events;
    bool all = w->n_events > 0;

    for (size_t k = 0; k < a->roots.n; k++) {
        const qdot_root *root = a->roots.at + k;
        const qdot_ensemble_event *e = w->events + root->function;
        const int way = s->zeros[root->function].touches ? 0
                        : s->of.backward                  ? -qdot_root_way(root)
                                                          : qdot_root_way(root);

        if (root->pole || (e->way != 0 && e->way != way))
            continue;
        if (count[root->function] < e->count)
            s->occurred[a->member * s->asked + s->first[root->function] + count[root->function]]
                = root->t;
        count[root->function]++;
    }
    for (size_t i = 0; i < w->n_events; i++)
        all = all && count[i] >= w->events[i].count;
    return all;
}

static bool
finish_accepted_step(size_t l, void *user)
{
    qdot_ensemble_steps *s = user;
    lane *a = s->lanes + l;

    a->passed = s->passed[a->member] = a->next;
    s->doubtful[a->member] = s->doubtful[a->member] || a->doubtful;
    if (s->doubtful[a->member])
        return true; /* stop here: the member will be repeated as a single run */
    if (!a->watch)
        return false;
    qdot_watch_take(a->watch);
    return count_events(s, a) && s->of.watching->leave;
}

void
qdot_ensemble_steps_look(qdot_ensemble_steps *s, qdot_ode_batch *system)
{
    system->tried = inspect_tried_step;
    system->taken = finish_accepted_step;
    system->looker = s;
    s->stride = system->stride;
}

/* --- results of a member --------------------------------------------------------------- */

size_t
qdot_ensemble_steps_passed(const qdot_ensemble_steps *s, size_t member)
{
    return s->passed[member];
}

const qdot_ensemble_starts *
qdot_ensemble_steps_starts(const qdot_ensemble_steps *s, size_t member)
{
    return s->starts + member;
}

double *
qdot_ensemble_steps_state(const qdot_ensemble_steps *s, size_t member, size_t time)
{
    return s->seen + (member * s->of.n_times + time) * (2 * s->n + s->varied);
}

double
qdot_ensemble_steps_event(const qdot_ensemble_steps *s, size_t member, size_t event, size_t k)
{
    return s->occurred[member * s->asked + s->first[event] + k];
}

size_t
qdot_ensemble_steps_count(const qdot_ensemble_steps *s, size_t member, size_t event)
{
    return s->count[member * s->of.watching->n_events + event];
}

const double *
qdot_ensemble_steps_sizes(const qdot_ensemble_steps *s, size_t member)
{
    return s->sizes + member * 2 * s->n;
}

bool
qdot_ensemble_steps_doubtful(const qdot_ensemble_steps *s, size_t member)
{
    return s->doubtful[member];
}
