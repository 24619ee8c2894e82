/* companion.c -- repeats a run slightly disturbed, as its companion run, and compares the two. */
#include "sim/error/companion.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
#include "expr/walk.h"
#include "num/two.h"
#include "ode/companion.h"
#include "ode/scale.h"
#include "sim/course/chatter.h"
#include "sim/course/reader.h"
#include "sim/model/massless.h"
#include "sim/model/still.h"
#include "tape/rounding.h"
#include "tape/shake.h"

/* The time at which the companion ends: the end of the run, or the requested end if an event
 * stopped the run. */
static double
end_time_of_companion(const qdot_run *run)
{
    return run->course.stopped_by != SIZE_MAX
               ? qdot_shake_double(run->t1, run->t1_side)
               : run->course.tr.t[run->course.tr.count - 1];
}

/* --- comparing run and companion ----------------------------------------------------- */

/* A last piece of the run shorter than this, relative to t, may be caused by rounding of t. */
static const double no_length = 8 * DBL_EPSILON;

/* Whether the last piece of a run has no duration, as at a switch where the motion would slide. */
static bool
last_piece_is_empty(const qdot_trajectory *tr)
{
    const qdot_trajectory_piece *last = tr->pieces.at + tr->pieces.n - 1;
    const double end = tr->t[tr->count - 1];

    return tr->pieces.n > 1 && !last->jumped
           && fabs(end - tr->t[last->first]) <= no_length * fabs(end);
}

/* A last piece without length decides nothing: moved a little the companion may go on there,
 * or end before it, and one that has it may be the companion's. */
static bool
have_same_pieces(const qdot_course *run, const qdot_course *other)
{
    const qdot_trajectory *a = &run->tr, *b = &other->tr;
    const size_t n = a->pieces.n - (last_piece_is_empty(a) ? 1 : 0);

    if (b->pieces.n < n || b->pieces.n > a->pieces.n + (last_piece_is_empty(b) ? 1 : 0))
        return false;
    for (size_t i = 0; i < n; i++)
        if (a->pieces.at[i].mode != b->pieces.at[i].mode)
            return false;
    return true;
}

bool
qdot_run_comparable(const qdot_run *run)
{
    return !run->hidden && run->has_companion && have_same_pieces(&run->course, &run->companion)
           && (!run->has_twin || have_same_pieces(&run->course, &run->twin));
}

/* Pieces of two runs begin at the same time if the times differ by less than this part of the time elapsed. */
static const double near_enough = 1e-3;

/* The time from which on a course is another one than the run: its piece there has other equations, or begins at another
 * time. NaN: it is the same. */
static double
time_of_separation(const qdot_course *run, const qdot_course *other)
{
    const qdot_trajectory *a = &run->tr, *b = &other->tr;
    const size_t n = a->pieces.n < b->pieces.n ? a->pieces.n : b->pieces.n;
    const double direction = a->t[a->count - 1] < a->t[0] ? -1 : 1;

    if (have_same_pieces(run, other))
        return NAN;
    for (size_t i = 0; i < n; i++) {
        const double t = a->t[a->pieces.at[i].first], theirs = b->t[b->pieces.at[i].first];

        if (a->pieces.at[i].mode != b->pieces.at[i].mode || fabs(t - theirs) > near_enough * fabs(t - a->t[0]))
            return direction * (theirs - t) < 0 ? theirs : t;
    }
    return a->pieces.n > n ? a->t[a->pieces.at[n].first] : b->t[b->pieces.at[n].first];
}

double
qdot_run_time_of_parting(const qdot_run *run)
{
    const double first = run->has_companion ? time_of_separation(&run->course, &run->companion) : NAN,
                 second = run->has_twin ? time_of_separation(&run->course, &run->twin) : NAN;

    return run->t1 < run->t0 ? fmax(first, second) : fmin(first, second);
}

static bool
reaches_time(const qdot_course *c, double t)
{
    const qdot_trajectory *tr = &c->tr;
    double start = tr->t[0], end = tr->t[tr->count - 1];

    return tr->result.outcome != QDOT_ODE_FAILED
           || (start < end ? t <= end : start > end ? t >= end : t == end);
}

bool
qdot_run_covered(const qdot_run *run, double t)
{
    return run->has_companion && reaches_time(&run->companion, t)
           && (!run->has_twin || reaches_time(&run->twin, t));
}

/* --- making the companion ------------------------------------------------------------ */

/* The fraction of the run's work after which the progress of a companion run is judged. */
static const double of_whole = 0.1;

/* Move y + low [2n], where a companion starts, by `by` times the error of the start: what run->apart has for this
 * companion. */
static void
shift_by_given_error(const qdot_run *run, size_t number, double by, double *y, double *low)
{
    const size_t n = 2 * run->plan->n;

    for (size_t i = 0; i < n && run->apart != NULL; i++)
        y[i] = qdot_two_rounded_sum(y[i], low[i] + by * run->apart[number * n + i], &low[i]);
}

/* A start onto its constraints. Where what coordinates without mass do decides a switch the first piece finds
 * these. */
static qdot_status
project_start(const qdot_run *run, const qdot_ode_system *system, double t0, double *y)
{
    const size_t n = 2 * run->plan->n;
    const bool finds = qdot_massless_switch(run->plan, &run->stage.switches);
    double *moved = qdot_malloc((n + 1) * sizeof *moved), by;
    qdot_status status = moved ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(moved, y, n * sizeof *moved);
        status = system->project(t0, moved, NULL, &by, system->user);
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        if (!finds || !run->plan->massless[i % (n / 2)])
            y[i] = moved[i];
    qdot_free(moved);
    return status;
}

/* Whether the function of an event is 0 at the start of the run, to within rounding. */
static qdot_status
starts_on_event(const qdot_run *run, const qdot_staged_event *e, double t0, bool *on)
{
    const size_t n = 2 * run->plan->n;
    qdot_reading of = {0};
    qdot_status status = qdot_reader_lower(run->plan, 1, &e->function, &of);
    double *in = NULL, g, noise;

    *on = false;
    if (status == QDOT_OK && !of.accelerations) {
        in = qdot_calloc(qdot_tape_inputs(of.tape) + 2 * qdot_tape_work(of.tape) + 1, sizeof *in);
        status = in ? QDOT_OK : QDOT_ENOMEM;
    }
    if (status == QDOT_OK && in) {
        double *work = in + qdot_tape_inputs(of.tape);

        memcpy(in, run->start, n * sizeof *in);
        in[n] = t0;
        qdot_tape_eval(of.tape, in, &g, work);
        qdot_rounding_bounds(of.tape, in, NULL, &noise, work);
        *on = fabs(g) <= noise;
    }
    qdot_free(in);
    qdot_tape_free(of.tape);
    return status;
}

/* Bodies that touch at the start, as the function of an event that acts has it, touch in the companion: where they stand is
 * not moved, for the crossing might be behind them and a blow be missed. */
static qdot_status
keep_contacts_touching(const qdot_run *run, double t0, double *y, double *low)
{
    const size_t n = 2 * run->plan->n;

    for (size_t k = 0; k < run->stage.events.n; k++) {
        const qdot_staged_event *e = &run->stage.events.at[k];
        bool on;

        if (!e->then || e->way == 0 || e->undoing)
            continue;
        QDOT_TRY(starts_on_event(run, e, t0, &on));
        for (size_t i = 0; i < n && on; i++)
            if (qdot_expr_contains(run->plan->pool, e->function, run->plan->inputs[i])) {
                y[i] = run->start[i];
                low[i] = run->start_low[i];
            }
    }
    return QDOT_OK;
}

/* How the start state of a companion run is shifted from that of the run. */
typedef enum {
    EACH,  /* each component of the state is shifted with its own sign */
    ALIKE, /* components of equal size are shifted alike, so that simultaneous events remain simultaneous */
    NOT,
    MOVES
} move;

/* The moved start of the companion into y [2n] and, for a run in two doubles, low; a bound that
 * the start is on is kept. */
static qdot_status
begin_shifted(const qdot_run *run, const qdot_ode_system *system, size_t number, move how, double t0,
              double *y, double *low)
{
    const size_t n = 2 * run->plan->n;

    if (how == NOT) {
        memcpy(y, run->start, n * sizeof *y);
        memcpy(low, run->start_low, n * sizeof *low);
        shift_by_given_error(run, number, 1, y, low);
        return QDOT_OK;
    }
    QDOT_TRY(qdot_still_find(run->plan, system, t0, run->start, run->start_low, run->units));
    memcpy(low, run->start_low, n * sizeof *low);
    qdot_companion_beside(run->units, n, run->start, number, how == ALIKE, run->report.tol, y,
                          run->leading ? low : NULL);
    if (!run->leading)
        QDOT_TRY(keep_contacts_touching(run, t0, y, low));
    shift_by_given_error(run, number, 1, y, low);
    if (system->project) /* only shifts that the constraints allow */
        QDOT_TRY(project_start(run, system, t0, y));
    /* a start on a bound of a coordinate's domain must not be moved outside */
    if (qdot_domains_outside(&run->stage.domains, y)) {
        memcpy(y, run->start, n * sizeof *y);
        memcpy(low, run->start_low, n * sizeof *low);
        shift_by_given_error(run, number, -1, y, low);
    }
    return QDOT_OK;
}

/* Whether the course has as many events and the same switches as the run; `acting`: ignore events
 * that change nothing. */
static bool
has_same_events(const qdot_run *run, const qdot_course *c, bool acting)
{
    for (size_t i = 0; i < run->stage.events.n; i++) {
        const qdot_staged_event *e = run->stage.events.at + i;

        if ((!acting || qdot_staged_event_acts(e)) && qdot_course_count(&run->course, i) != qdot_course_count(c, i))
            return false;
    }
    return have_same_pieces(&run->course, c);
}

/* An empty course (data of a run) with the same settings as c. */
static qdot_course
empty_course_like(const qdot_course *c)
{
    return (qdot_course){.stage = c->stage,
                         .shaken = c->shaken,
                         .no_series = c->no_series,
                         .early = c->early,
                         .leader = c->leader,
                         .most_pieces = c->most_pieces,
                         .touch_tol = c->touch_tol};
}

static void
clear_course_results(qdot_course *c)
{
    const qdot_course empty = empty_course_like(c);

    qdot_course_clear(c);
    *c = empty;
}

void
qdot_run_drop_companions(qdot_run *run)
{
    clear_course_results(&run->companion);
    clear_course_results(&run->twin);
    run->has_companion = run->has_twin = false;
    if (run->way == QDOT_COMPANION_WAYS)
        run->way = QDOT_COMPANION_SERIES;
}

/* Compute companion run 0 or 1 by the given plan into c; *has: whether that succeeded. */
static qdot_status
compute_companion_by_plan(qdot_run *run, size_t number, const qdot_companion_plan *by, qdot_ode_meter *meter,
                          qdot_course *c, bool *has, double *spent)
{
    qdot_ode_options options = {.tol = by->tol,
                                .first_share = qdot_companion_first_share(number),
                                .order_more = qdot_companion_orders(number),
                                .term_tol = qdot_companion_term_tol(run->report.tol, number),
                                .t1_low = end_time_of_companion(run) == run->t1 ? run->t1_low : 0,
                                .meter = meter,
                                .alternates = run->turns,
                                .stiff_work = INFINITY};
    double t0 = run->leading ? run->t0 : qdot_shake_double(run->t0, run->t0_side);
    size_t n = 2 * run->plan->n;
    qdot_course first = {0};
    qdot_ode_system system;
    double *y;
    qdot_status status;

    system = qdot_bind_system(run->course.binds.at[0]);
    y = qdot_malloc(2 * n * sizeof *y);
    if (!y)
        return QDOT_ENOMEM;
    if (run->leading) {
        options.leading = true;
        options.carry = y + n;
        options.t0_low = run->t0_low;
    }
    /* a start on a surface, moved to its other side, meets it once more: the second time
     * it stays on it; so may what touches. Where what is only seen differs the first one is as good for states. A
     * switch that is crossed here and not there is doubt of the run. */
    for (move how = EACH; how < MOVES; how++) {
        if (how == ALIKE && !qdot_companion_has_alike(n, run->start))
            continue; /* no components are of equal size: the start would be the same */
        if (how != EACH)
            options.carry = y + n;
        c->exact = how == NOT && run->course.exact;
        status = begin_shifted(run, &system, number, how, t0, y, y + n);
        if (status != QDOT_OK) {
            status = status == QDOT_ENOMEM ? status : QDOT_OK;
            *has = false;
            break;
        }
        qdot_progress_begin(t0, end_time_of_companion(run), "error of the run");
        qdot_ode_meter_begin(meter, t0, end_time_of_companion(run));
        status = qdot_course_run(c, by->method, &options, t0, end_time_of_companion(run), y);
        if (qdot_grave(status) != QDOT_OK)
            break;
        *has = c->tr.count > 0;
        if (!*has || has_same_events(run, c, false) || (!run->course.began_on && run->stage.events.n == 0) || how == NOT)
            break;
        if (first.tr.count == 0 && has_same_events(run, c, true)) {
            first = *c;
            *c = empty_course_like(c);
        } else {
            clear_course_results(c);
        }
        *spent += meter->work;
        meter->spent = *spent;
    }
    qdot_free(y);
    if (first.tr.count > 0 && qdot_grave(status) == QDOT_OK
        && !(*has && has_same_events(run, c, false))) {
        qdot_course_clear(c);
        *c = first;
        first = (qdot_course){0};
        *has = true;
    }
    qdot_course_clear(&first);
    return qdot_grave(status);
}

/* Whether an extremum counts as a touch by the tolerance. Where none does, none should in a companion,
 * which may see the same two crossings a little nearer to each other. */
static bool
has_touching_occurrence(const qdot_course *c)
{
    for (size_t i = 0; i < c->occurrences.n; i++)
        if (c->occurrences.at[i].within > 0)
            return true;
    return false;
}

static qdot_status
compute_companion(qdot_run *run, size_t number, qdot_course *c, bool *has)
{
    const qdot_ode_method *method = run->plan->method;
    const qdot_ode_system system = qdot_bind_system(run->course.binds.at[0]);
    qdot_ode_meter *meter = qdot_calloc(1, sizeof *meter);
    qdot_companion_way way = run->way;
    qdot_companion_plan by;
    double spent = 0;
    qdot_status status = QDOT_OK;

    if (!meter)
        return QDOT_ENOMEM;
    c->shaken = number == 0;
    c->early = number == 0 ? 1 : -1;
    c->leader = &run->course;
    c->touch_tol = has_touching_occurrence(&run->course) ? run->course.touch_tol : 0;
    /* limit the pieces: a companion moved off a surface on which the run rests might cross it endlessly */
    c->most_pieces = 2 * run->course.tr.pieces.n + 1000;
    for (;; way++) {
        way = qdot_companion_way_from(way, number, &system, method, run->report.tol, &by);
        if (way == QDOT_COMPANION_WAYS)
            break;
        qdot_companion_meter(meter, &run->meter, &system, method, way, number, spent);
        meter->early = fmax(meter->early, of_whole * run->meter.work);
        c->no_series = way == QDOT_COMPANION_PARTNER;
        clear_course_results(c);
        *has = false;
        status = compute_companion_by_plan(run, number, &by, meter, c, has, &spent);
        if (status != QDOT_OK
            || !qdot_companion_leads_nowhere(method,
                                             !*has || c->tr.result.outcome == QDOT_ODE_FAILED,
                                             meter))
            break;
        spent += meter->work;
    }
    run->report.estimate_work += spent + (way == QDOT_COMPANION_WAYS ? 0 : meter->work);
    run->of_point += meter->work / (double)(c->tr.count > 1 ? c->tr.count - 1 : 1);
    qdot_free(meter);
    return status;
}

/* Make the trajectory of the companion run over the whole time of the run. */
static qdot_status
make_first_companion(qdot_run *run)
{
    if (run->has_companion || run->course.tr.count == 0)
        return QDOT_OK;
    return compute_companion(run, 0, &run->companion, &run->has_companion);
}

qdot_status
qdot_run_twin(qdot_run *run)
{
    QDOT_TRY(make_first_companion(run));
    if (!run->has_companion || run->has_twin)
        return QDOT_OK;
    QDOT_TRY(compute_companion(run, 1, &run->twin, &run->has_twin));
    if (run->has_twin && !reaches_time(&run->twin, run->course.tr.t[run->course.tr.count - 1])) {
        /* the second companion run was given up: use only the first one */
        clear_course_results(&run->twin);
        run->has_twin = false;
        run->way = QDOT_COMPANION_WAYS;
    }
    return QDOT_OK;
}

/* --- the error of the run ------------------------------------------------------------ */

/* Record how the pieces of the companion run differ from those of the run, as a reason to distrust the run. */
static qdot_status
record_difference_of_pieces(qdot_run *run, const qdot_course *c)
{
    char text[300];

    for (size_t i = 0; i < run->stage.events.n; i++) {
        size_t a = qdot_course_count(&run->course, i), b = qdot_course_count(c, i);

        if (a == b)
            continue;
        snprintf(text, sizeof text,
                 "the second run met the event %.100s %zu times, this one %zu times",
                 run->stage.events.at[i].name, b, a);
        return qdot_run_say_doubt(run, text);
    }
    return qdot_run_say_doubt(run, "the second run went through other events or switches");
}

/* A piece ends just after its root, in all runs alike: add the motion by the other system in that
 * time to floor [n], for each end of a piece. */
static qdot_status
add_effect_of_delays(const qdot_course *c, double *floor)
{
    const qdot_trajectory *tr = &c->tr;
    double *before = qdot_malloc(2 * tr->n * sizeof *before), *behind = before + tr->n;
    qdot_status status = before ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < c->ends.n && status == QDOT_OK; k++) {
        const qdot_course_end *end = c->ends.at + k;
        const size_t first =
            end->piece + 1 < tr->pieces.n ? tr->pieces.at[end->piece + 1].first : 0;
        const qdot_ode_system *old = qdot_course_systems(c) + tr->pieces.at[end->piece].mode;
        const qdot_ode_system *next;

        if (end->late == 0 || first == 0 || (k > 0 && end[-1].piece == end->piece))
            continue;
        next = qdot_course_systems(c) + tr->pieces.at[end->piece + 1].mode;
        if (old->rhs(end->t, tr->y + (first - 1) * tr->n, before, old->user) != QDOT_OK
            || next->rhs(end->t, tr->y + first * tr->n, behind, next->user) != QDOT_OK)
            continue; /* leave out this part of the error bound: the equations are undefined there */
        for (size_t i = 0; i < tr->n; i++)
            floor[i] += end->late * fabs(behind[i] - before[i]);
    }
    qdot_free(before);
    return status;
}

/* The state y [n] of a companion at the end of the run, or, if an event stopped both, at its own
 * end *t. *known: the states can be compared. */
static qdot_status
find_end_of_companion(qdot_run *run, const qdot_course *other, double *t, double *y, bool *known)
{
    const qdot_trajectory *b = &other->tr;
    qdot_trajectory_cursor *cursor = NULL;
    qdot_status status;

    *t = run->course.tr.t[run->course.tr.count - 1];
    *known = have_same_pieces(&run->course, other) && run->course.stopped_by == other->stopped_by;
    if (!*known)
        return record_difference_of_pieces(run, other);
    if (run->course.stopped_by != SIZE_MAX) {
        *t = b->t[b->count - 1];
        memcpy(y, b->y + (b->count - 1) * b->n, b->n * sizeof *y);
        return QDOT_OK;
    }
    status = qdot_trajectory_open(b, qdot_course_systems(other), &cursor);
    if (status == QDOT_OK)
        status = qdot_trajectory_read_piece(cursor, b->pieces.n - 1, *t, y);
    qdot_trajectory_close(cursor);
    *known = status == QDOT_OK;
    return qdot_grave(status);
}

qdot_status
qdot_run_end_apart(qdot_run *run, double *apart, bool *known)
{
    const qdot_trajectory *tr = &run->course.tr;
    const size_t n = tr->n;
    const qdot_course *others[] = {&run->companion, &run->twin};
    double t;

    *known = false;
    if (run->chart != NULL || run->precise != NULL || tr->count == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_run_twin(run));
    if (!qdot_run_comparable(run) || !qdot_run_covered(run, tr->t[tr->count - 1]))
        return QDOT_OK;
    *known = true;
    for (size_t c = 0; c < (run->has_twin ? 2u : 1u) && *known; c++) {
        *known = others[c]->stopped_by == run->course.stopped_by;
        if (*known)
            QDOT_TRY(find_end_of_companion(run, others[c], &t, apart + c * n, known));
        for (size_t i = 0; i < n && *known; i++)
            apart[c * n + i] -= tr->y[(tr->count - 1) * n + i];
    }
    for (size_t i = 0; i < n && !run->has_twin; i++) /* for one companion run: mirror the shift */
        apart[n + i] = -apart[i];
    return QDOT_OK;
}

qdot_status
qdot_run_end_error(qdot_run *run, double *difference)
{
    const qdot_trajectory *tr = &run->course.tr;
    const double *y = tr->y + (tr->count - 1) * tr->n, t = tr->t[tr->count - 1];
    double plain = qdot_companion_floor(qdot_course_systems(&run->course), run->leading,
                                        tr->result.stats.steps),
           scaled = plain;
    double ends[2] = {t, t}, *of;
    const size_t companions = run->has_twin ? 2 : 1;
    bool known = run->has_companion;
    qdot_status status;

    run->report.error = run->report.scaled_error = NAN;
    if (!known)
        return record_difference_of_pieces(run, &run->companion);
    of = qdot_calloc(3 * tr->n, sizeof *of); /* end states of both companion runs; effect of delayed events */
    status = of ? find_end_of_companion(run, &run->companion, ends, of, &known) : QDOT_ENOMEM;
    if (status == QDOT_OK && known && run->has_twin)
        status = find_end_of_companion(run, &run->twin, ends + 1, of + tr->n, &known);
    if (status == QDOT_OK && known)
        status = add_effect_of_delays(&run->course, of + 2 * tr->n);
    if (status == QDOT_OK && known)
        qdot_chatter_add_state(&run->course, t, y, of + 2 * tr->n);
    for (size_t i = 0; i < tr->n && status == QDOT_OK && known; i++) {
        const double size = qdot_ode_size(run->stage.scales, i, y[i]);
        const double theirs[] = {of[i], of[tr->n + i]};
        const double by = qdot_companion_bound_of(y[i], companions, theirs) + of[2 * tr->n + i];

        scaled = fmax(scaled, by / size);
        plain = fmax(plain, by / fmax(1, fabs(y[i])));
        difference[i] = fmax(by, 0x1p-53 * size);
    }
    if (status == QDOT_OK && known) {
        const double late =
            qdot_companion_bound_of(t, companions, ends) / fmax(1, fabs(t));

        run->report.error = fmax(plain, late);
        run->report.scaled_error = fmax(scaled, late);
    }
    qdot_free(of);
    return status;
}
