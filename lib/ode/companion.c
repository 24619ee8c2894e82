/* companion.c -- repeats a run once or twice from slightly disturbed starts (companion runs) to estimate its error. */
#include "ode/companion.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/process.h"
#include "ode/scale.h"

static const double unit = 0x1p-53;

/* A companion's own error, as a part of its distance from the run, where the companions agree; where they do not,
 * and the run is far from both. */
static const double most_share = 0.25, unlike_share = 3;

/* Of the work: what reading states before the end may take, the run's and both companions', which cost
 * about so many times a step of the run. */
static const double reading = 0.12, readings = 3.5;

/* Where a finer way was given up by its cost: the run is that many times farther from it than from the
 * coarse way, and than a tolerance, where the coarse one shows nothing of its error. Both go wrong alike
 * where they step over what a finer one sees; by less than that, the two distances differ by chance. */
static const double refutes = 10;

/* Errors of the run at earlier times raise the error estimate at the end by at most this factor. */
static const double most_between = 30;

/* Times at which states are compared before the end, as parts of the run. They are irregular, so
 * that no period of the motion hits all of them at the same phase. */
static const double places[] = {0.5131, 0.5573, 0.6217, 0.6749, 0.7271,
                                0.7853, 0.8311, 0.8929, 0.9467};
enum { PLACES = sizeof places / sizeof places[0] };

/* The state of one companion run, which repeats the run for an error estimate. */
typedef struct {
    const qdot_companion *of;
    qdot_ode_system system;
    size_t number; /* 0 for the first companion, 1 for the second */
    double t0;
    double *start; /* [n] start state of the companion: y0 moved by its rounding error */
    double *low;   /* [n] low-order part of the start state, which is start + low */
    double *y;     /* [n] the present state of the companion */
    double *own;   /* [PLACES x n] states of the companion at the comparison times */
    double *left;  /* [n] the state at t_left, where a more accurate method was given up */
    double t_left; /* time of the state `left`; equal to t0: there is none */
    qdot_trajectory *tr; /* where the companion's states are stored: the caller's trajectory, or `held` */
    qdot_trajectory held;
    qdot_companion_way way;
    double tol;           /* the tolerance of the companion's present method */
    double spent;         /* work of methods tried before, and of reading states */
    qdot_ode_meter meter; /* counts the work of the companion's present method */
    qdot_ode_result result;
    bool given_up; /* whether the companion was ended because of its cost */
    bool arrived;
    bool running;  /* whether the companion's thread is running */
    bool finished; /* whether the companion's thread has ended, so that `result` is valid */
    pthread_t thread;
    qdot_interrupt *interrupt; /* the flag of the thread that computes the run */
} follower;

struct qdot_companion {
    size_t n;
    const double *scales; /* [n] scales s_i of the system (scale.h) */
    const qdot_ode_method *run; /* the method of the run */
    const qdot_ode_meter *meter;
    double tol, t1, t1_low, t0_low; /* tolerance and times of the run: end, low parts of the exact end and start */
    bool leading, alternates;
    size_t samples;
    double times[PLACES];
    double *shown; /* [PLACES x n] states of the run at the comparison `times` */
    size_t n_shown;
    const qdot_trajectory *course; /* the stored run; NULL: not available */
    const qdot_ode_system *of_course;
    atomic_bool leave; /* set when the run ended early: companions must not go beyond t_end */
    double t_end;
    double floor; /* the smallest error that is stated for the run */
    double steps; /* number of steps of the run */
    follower at[2];
    size_t count, arrived;
};

static qdot_status
stop_at_end_of_run(double t, const double *y, bool *stop, void *user)
{
    const follower *f = user;
    const qdot_companion *c = f->of;

    (void)y;
    *stop = atomic_load_explicit(&c->leave, memory_order_acquire)
            && (c->t1 < f->t0 ? t <= c->t_end : t >= c->t_end);
    return QDOT_OK;
}

/* Integrate the companion by one method to t1, or to beyond the time at which the run ended. */
static void
integrate_companion_by(follower *f, const qdot_companion_plan *by)
{
    const qdot_companion *c = f->of;
    const qdot_ode_options options = {.tol = by->tol,
                                      .first_share = qdot_companion_first_share(f->number),
                                      .accepted = stop_at_end_of_run,
                                      .user = f,
                                      .order_more = qdot_companion_orders(f->number),
                                      .term_tol = qdot_companion_term_tol(c->tol, f->number),
                                      .leading = c->leading,
                                      .alternates = c->alternates,
                                      .meter = &f->meter,
                                      /* no limit here: the meter bounds the work */
                                      .stiff_work = INFINITY,
                                      .apart = true,
                                      .carry = f->low,
                                      .t0_low = c->t0_low,
                                      .t1_low = c->t1_low};
    const qdot_ode_stats spent = f->result.stats;

    qdot_companion_meter(&f->meter, c->meter, &f->system, c->run, f->way, f->number,
                         f->spent);
    qdot_ode_meter_begin(&f->meter, f->t0, c->t1);
    if (qdot_trajectory_run(f->tr, &f->system, by->method, &options, f->t0, c->t1, f->start)
        != QDOT_OK)
        f->tr->result.outcome = QDOT_ODE_FAILED;
    f->result = f->tr->result;
    qdot_ode_stats_add(&f->result.stats, &spent);
    if (f->tr->count > 0)
        memcpy(f->y, f->tr->y + (f->tr->count - 1) * c->n, c->n * sizeof *f->y);
}

bool
qdot_companion_leads_nowhere(const qdot_ode_method *method, bool failed,
                             const qdot_ode_meter *meter)
{
    /* allow for a stiff method that most work may fall into a moment, as where a relaxation oscillation jumps */
    if (method->stiff)
        return failed || meter->over;
    return meter->over && !qdot_ode_meter_is_stuck(meter);
}

/* The way is given up: count its work, and keep where it was when it could first be seen to cost too much,
 * which does not depend on how fast the run came. */
static void
give_up_method(follower *f)
{
    const qdot_companion *c = f->of;
    const double *times = f->tr->t, direction = c->t1 < f->t0 ? -1 : 1;
    double work, t;

    (void)qdot_ode_meter_exceeds(&f->meter, &work);
    f->spent += work;
    if (f->way == QDOT_COMPANION_COARSE || f->tr->count < 2 || f->system.n_parts > 1)
        return;
    t = times[f->tr->count - 1];
    for (size_t k = 0; k < atomic_load(&f->meter.count); k++)
        if (f->meter.marks[k].work >= work) {
            t = direction * fmin(direction * t, direction * f->meter.marks[k].t);
            break;
        }
    if (direction * (t - f->t_left) > 0
        && qdot_trajectory_at(f->tr, &f->system, t, f->left) == QDOT_OK)
        f->t_left = t;
}

/* Integrate the companion by the first possible method, from f->way on. */
static void
integrate_companion(follower *f)
{
    const qdot_companion *c = f->of;
    qdot_companion_plan by;

    for (;; f->way++) {
        f->way = qdot_companion_way_from(f->way, f->number, &f->system, c->run, c->tol, &by);
        if (f->way == QDOT_COMPANION_WAYS)
            return;
        f->tol = by.tol;
        integrate_companion_by(f, &by);
        f->given_up = f->meter.over;
        if (f->result.outcome != QDOT_ODE_FAILED
            || !qdot_companion_leads_nowhere(c->run, true, &f->meter))
            return;
        give_up_method(f);
    }
}

static void
integrate_all_companions(follower *f)
{
    f->result = (qdot_ode_result){0};
    f->way = QDOT_COMPANION_SERIES;
    f->spent = 0;
    f->t_left = f->t0;
    integrate_companion(f);
    f->finished = true;
}

static void *
companion_thread(void *user)
{
    follower *f = user;

    qdot_interrupt_own = f->interrupt;
    integrate_all_companions(f);
    return NULL;
}

static void
release_companions(qdot_companion *c)
{
    for (size_t k = 0; k < c->count; k++) {
        qdot_free(c->at[k].start);
        qdot_free(c->at[k].low);
        qdot_trajectory_clear(&c->at[k].held);
        qdot_free(c->at[k].y);
        qdot_free(c->at[k].own);
        qdot_free(c->at[k].left);
    }
    qdot_free(c->shown);
    qdot_free(c);
}

/* The times between, as many as reading there is a small part of the work; none if the run is so short
 * that two of them would be the same double. */
static void
choose_comparison_times(qdot_companion *c, uint64_t steps)
{
    const double t0 = c->at[0].t0, work = c->meter ? c->meter->work : 0;
    const double left = reading * work + reading * QDOT_COMPANION_LEAST;
    const double each = readings * work / (double)(steps > 0 ? steps : 1);
    const size_t most = left < PLACES * each ? (size_t)(left / each) : PLACES;

    c->samples = c->at[0].system.series ? most : 0;
    for (size_t k = 0; k < c->samples; k++) {
        c->times[k] = t0 + places[(2 * k + 1) * PLACES / (2 * most)] * (c->t1 - t0);
        if (c->times[k] == (k ? c->times[k - 1] : t0) || c->times[k] == c->t1)
            c->samples = 0;
    }
}

const double *
qdot_companion_places(size_t *count)
{
    *count = PLACES;
    return places;
}

const double *
qdot_companion_times(const qdot_companion *c, size_t *count)
{
    *count = c->samples;
    return c->times;
}

void
qdot_companion_show_course(qdot_companion *c, const qdot_trajectory *tr, const qdot_ode_system *system)
{
    c->course = tr;
    c->of_course = system;
}

void
qdot_companion_show(qdot_companion *c, size_t k, const double *y)
{
    memcpy(c->shown + k * c->n, y, c->n * sizeof *y);
    c->n_shown = k + 1;
}

/* The scaled distance of two states: max_i |a_i - b_i| / max(s_i, min(|a_i|, |b_i|)). */
static double
scaled_distance(const qdot_companion *c, const double *scales, const double *a, const double *b)
{
    double worst = 0;

    for (size_t i = 0; i < c->n; i++)
        worst = fmax(worst, fabs(a[i] - b[i])
                                / qdot_ode_size(scales, i, fmin(fabs(a[i]), fabs(b[i]))));
    return worst;
}

double
qdot_companion_bound(double apart, double own)
{
    return (1 + most_share) * apart + unlike_share * fmin(apart, own) + own;
}

double
qdot_companion_apart(double x, size_t count, const double *theirs)
{
    return fabs(count == 2 ? (QDOT_COMPANION_FAR * (theirs[0] - x) + (theirs[1] - x)) / (QDOT_COMPANION_FAR + 1)
                           : theirs[0] - x);
}

double
qdot_companion_own(const double *theirs)
{
    return fabs(theirs[1] - theirs[0]) * QDOT_COMPANION_SHARE;
}

double
qdot_companion_bound_of(double x, size_t count, const double *theirs)
{
    const double apart = qdot_companion_apart(x, count, theirs);

    return qdot_companion_bound(apart, count == 2 ? qdot_companion_own(theirs) : QDOT_COMPANION_ALONE * apart);
}

/* Error bound of the run's state y, relative to these scales, from the companions' states at time k
 * (SIZE_MAX: at the end). */
static double
error_bound_at(const qdot_companion *c, const double *scales, const double *y, size_t k)
{
    double worst = 0;

    for (size_t i = 0; i < c->n; i++) {
        double theirs[2], least = fabs(y[i]);

        for (size_t j = 0; j < c->arrived; j++) {
            theirs[j] = k == SIZE_MAX ? c->at[j].y[i] : c->at[j].own[k * c->n + i];
            least = fmin(least, fabs(theirs[j]));
        }
        worst = fmax(worst, qdot_companion_bound_of(y[i], c->arrived, theirs)
                                / qdot_ode_size(scales, i, least));
    }
    return worst;
}

/* The median of the run's error bounds at the comparison times before the end. */
static double
median_error_before_end(const qdot_companion *c, const double *scales)
{
    double errors[PLACES];

    for (size_t k = 0; k < c->samples; k++) {
        double worst = error_bound_at(c, scales, c->shown + k * c->n, k);
        size_t at = k;

        for (; at > 0 && errors[at - 1] > worst; at--)
            errors[at] = errors[at - 1];
        errors[at] = worst;
    }
    return errors[c->samples / 2];
}

static qdot_status
prepare_companion(qdot_companion *c, const qdot_companion_request *request, size_t number)
{
    follower *f = c->at + number;

    c->count = number + 1;
    *f = (follower){.of = c,
                    .system = number ? *request->twin : *request->system,
                    .number = number,
                    .t0 = request->t0};
    f->start = qdot_malloc(c->n * sizeof *f->start);
    f->low = qdot_calloc(c->n, sizeof *f->low);
    f->y = qdot_malloc(c->n * sizeof *f->y);
    f->own = qdot_malloc(PLACES * c->n * sizeof *f->own);
    f->left = qdot_malloc(c->n * sizeof *f->left);
    f->tr = request->kept[number] ? request->kept[number] : &f->held;
    if (!f->start || !f->low || !f->y || !f->own || !f->left)
        return QDOT_ENOMEM;
    if (request->carry)
        memcpy(f->low, request->carry, c->n * sizeof *f->low);
    qdot_companion_beside(request->units ? request->units : c->scales, c->n, request->y0, number, false,
                          request->tol, f->start,
                          c->leading ? f->low : NULL);
    if (f->system.project) { /* move the start state only in directions that the constraints allow */
        double by;

        QDOT_TRY(f->system.project(f->t0, f->start, f->low, &by, f->system.user));
    }
    return QDOT_OK;
}

qdot_status
qdot_companion_start(const qdot_companion_request *request, qdot_companion **out)
{
    qdot_companion *c = qdot_calloc(1, sizeof *c);
    qdot_status status;

    *out = NULL;
    if (!c)
        return QDOT_ENOMEM;
    c->n = request->system->n;
    c->scales = request->system->scales;
    c->run = request->method;
    c->tol = request->tol;
    c->meter = request->meter;
    c->t1 = request->t1;
    c->t1_low = request->t1_low;
    c->t0_low = request->t0_low;
    c->leading = request->leading;
    c->alternates = request->alternates;
    c->floor = unit;
    c->shown = qdot_malloc(PLACES * c->n * sizeof *c->shown);
    atomic_init(&c->leave, false);
    status = c->shown ? prepare_companion(c, request, 0) : QDOT_ENOMEM;
    if (status == QDOT_OK && request->twin)
        status = prepare_companion(c, request, 1);
    if (status != QDOT_OK) {
        release_companions(c);
        return status;
    }
    for (size_t k = 0; QDOT_MAY_THREAD && k < c->count && request->threaded; k++) {
        c->at[k].interrupt = qdot_interrupt_own;
        c->at[k].running =
            pthread_create(&c->at[k].thread, NULL, companion_thread, c->at + k) == 0;
    }
    *out = c;
    return QDOT_OK;
}

/* It arrived, before the run had, at a price that is too high beside that of the whole run: the
 * other ways. */
static void
judge_cost_of_companion(follower *f)
{
    double work;

    while (f->of->meter && f->way != QDOT_COMPANION_WAYS
           && f->result.outcome != QDOT_ODE_FAILED && qdot_ode_meter_exceeds(&f->meter, &work)) {
        give_up_method(f);
        f->way++;
        f->given_up = true;
        f->result.outcome = QDOT_ODE_FAILED;
        snprintf(f->result.reason, sizeof f->result.reason,
                 QDOT_ODE_METER_REASON, f->meter.factor);
        integrate_companion(f);
    }
}

/* Read the companion's state at the time at which the run ended, if that is earlier than t1. */
static void
read_end_of_companion(follower *f)
{
    const qdot_companion *c = f->of;

    if (qdot_trajectory_at(f->tr, &f->system, c->t_end, f->y) == QDOT_OK) {
        f->result.outcome = QDOT_ODE_DONE;
        f->result.t = c->t_end;
    } else {
        f->result.outcome = QDOT_ODE_FAILED;
    }
}

/* Whether the companion failed at a time beyond the end of the run, before it was told of that end. */
static bool
failed_after_end_of_run(const follower *f)
{
    const qdot_trajectory *tr = f->tr;
    const double way = f->of->t1 < f->t0 ? -1 : 1;

    return !f->given_up && tr->count > 0 && way * (tr->t[tr->count - 1] - f->of->t_end) >= 0;
}

/* Read the companion's states at the comparison times, if the run has given its own; true if all are available. */
static bool
read_states_before_end(follower *f)
{
    const qdot_companion *c = f->of;
    qdot_trajectory_cursor *cursor;
    qdot_status status;

    if (c->samples == 0 || c->n_shown < c->samples
        || qdot_trajectory_open(f->tr, &f->system, &cursor) != QDOT_OK)
        return false;
    status = QDOT_OK;
    for (size_t k = 0; k < c->samples && status == QDOT_OK; k++)
        status = qdot_trajectory_read(cursor, c->times[k], f->own + k * c->n);
    qdot_trajectory_close(cursor);
    return status == QDOT_OK;
}

/* Finish the companion: find its state at the end, and (`whole`) whether its states at the comparison times are known. */
static bool
finish_companion(follower *f, bool whole, qdot_companion_estimate *out)
{
    const qdot_companion *c = f->of;
    double each;

    if (!f->finished)
        integrate_all_companions(f);
    judge_cost_of_companion(f);
    if (!whole && (f->result.outcome != QDOT_ODE_FAILED || failed_after_end_of_run(f)))
        read_end_of_companion(f);
    f->arrived = f->result.outcome == QDOT_ODE_DONE;
    if (f->number == 0 || (out->known && !f->given_up))
        out->result = f->result;
    out->tol = fmax(out->tol, f->tol);
    if (f->number == 0 || f->arrived)
        out->way = f->way > out->way ? f->way : out->way;
    /* the first companion is enough if the second would cost too much */
    out->known = (out->known && f->arrived) || (f->number > 0 && out->known && f->given_up);
    each = f->meter.work / (double)(f->tr->count > 1 ? f->tr->count - 1 : 1);
    out->work += f->spent + (f->way == QDOT_COMPANION_WAYS ? 0 : f->meter.work);
    out->of_point += each;
    /* if only the first companion gives the error at the end, it alone gives the errors of all values */
    out->kept[f->number] = f->tr->count > 1 && (f->number == 0 || f->arrived || !out->known);
    if (!f->arrived || !whole || !read_states_before_end(f))
        return f->number > 0 && f->given_up;
    out->work += each * (double)c->samples;
    return true;
}

void
qdot_companion_limit(qdot_companion *c, uint64_t steps)
{
    c->steps = (double)steps;
    choose_comparison_times(c, steps);
    c->floor = qdot_companion_floor(&c->at[0].system, c->leading, steps);
}

/* Whether a finer companion, given up because of its cost, had shown a larger error than the coarse one shows. */
static bool
is_refuted(const follower *f)
{
    const qdot_companion *c = f->of;
    double *own, *coarse, said, shown;
    bool read;

    if (!c->course || !f->arrived || f->way != QDOT_COMPANION_COARSE || f->t_left == f->t0)
        return false;
    own = qdot_malloc(2 * c->n * sizeof *own);
    if (!own)
        return false;
    coarse = own + c->n;
    read = qdot_trajectory_at(c->course, c->of_course, f->t_left, own) == QDOT_OK
           && qdot_trajectory_at(f->tr, &f->system, f->t_left, coarse) == QDOT_OK;
    shown = read ? scaled_distance(c, c->scales, own, f->left) : 0;
    said = read ? scaled_distance(c, c->scales, own, coarse) : 0;
    qdot_free(own);
    return shown > refutes * fmax(said, c->tol);
}

/* The error of the run's end state y relative to the given scales; `between`: including the states before it. */
static double
error_of_end_state(const qdot_companion *c, const double *scales, const double *y, bool between)
{
    const double error = fmax(c->floor, error_bound_at(c, scales, y, SIZE_MAX));

    return between ? fmax(error, fmin(median_error_before_end(c, scales), most_between * error)) : error;
}

void
qdot_companion_finish(qdot_companion *c, double t_end, const double *y,
                      double *difference, qdot_companion_estimate *out)
{
    /* a time within rounding errors of t1 counts as t1 */
    bool whole = fabs(t_end - c->t1) <= 4 * unit * fabs(c->t1), between = true;

    c->t_end = t_end;
    if (!whole)
        atomic_store_explicit(&c->leave, true, memory_order_release);
    for (size_t k = 0; k < c->count; k++)
        if (c->at[k].running)
            pthread_join(c->at[k].thread, NULL);
    *out = (qdot_companion_estimate){.known = true};
    for (size_t k = 0; k < c->count; k++)
        between = finish_companion(c->at + k, whole, out) && between;
    for (size_t k = 0; k < c->count && out->known; k++)
        if (is_refuted(c->at + k)) {
            out->known = out->kept[0] = out->kept[1] = false;
            snprintf(out->result.reason, sizeof out->result.reason,
                     "at t = %.2g, before it was ended because of its cost, it differed from this one",
                     c->at[k].t_left);
        }
    between = between && c->samples > 0;
    c->arrived = c->count == 2 && c->at[1].arrived ? 2 : 1;
    if (whole && c->n_shown > 0 && c->meter) /* add the work of reading the states of the run itself */
        out->work += c->meter->work / fmax(1, c->steps) * (double)c->n_shown;
    out->error = out->known ? error_of_end_state(c, c->scales, y, between) : NAN;
    out->plain = out->known ? error_of_end_state(c, NULL, y, between) : NAN;
    for (size_t i = 0; i < c->n && difference; i++) {
        const double ends[] = {c->at[0].y[i], c->count == 2 ? c->at[1].y[i] : 0};

        difference[i] =
            out->known ? qdot_companion_bound_of(y[i], c->arrived, ends) : NAN;
    }
    release_companions(c);
}
