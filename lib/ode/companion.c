/* companion.c -- one or two further runs from which the error of a run is estimated. */
#include "ode/companion.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "ode/scale.h"
#include "ode/taylor-numbers.h"

static const double unit = 0x1p-53;

/* The smallest error stated is 2u sqrt(steps), u = 2^-53; the root counts at most this. */
static const double most_floor = 32;

/* Rounding error of a velocity that is computed from a conserved momentum, in units of 2^-53. */
static const double derived = 4;

/* A companion's own error, as a part of its distance from the run, where the companions agree. */
static const double most_share = 0.25;

/* How much coarser or finer than the run these ways are. */
static const double coarser = 4, finer[] = {4, 8};

/* Differences before the end raise the error to at most this many times the one at the end. */
static const double most_between = 30;

/* Times at which states are compared before the end, as parts of the run. They are irregular, so
 * that no period of the motion hits all of them at the same phase. */
static const double places[] = {0.5131, 0.5573, 0.6217, 0.6749, 0.7271,
                                0.7853, 0.8311, 0.8929, 0.9467};
enum { PLACES = sizeof places / sizeof places[0] };

/* One companion. */
typedef struct {
    const qdot_companion *of;
    qdot_ode_system system;
    size_t number; /* 0, 1 */
    double t0;
    double *start; /* [n] the moved y0 */
    double *low;   /* [n] low-order part: the start is start + low */
    double *now;   /* [n] low-order part of y, where that is known */
    double *y;     /* [n] the state it has reached */
    double *own;   /* [PLACES x n] its states at the times between */
    size_t reached; /* the first `reached` of these times are done */
    qdot_companion_way way;
    double tol;           /* of that way */
    double spent;         /* work on the ways before */
    qdot_ode_meter meter; /* on this one */
    qdot_ode_result result;
    bool running;  /* on `thread` */
    bool finished; /* result is valid */
    pthread_t thread;
} follower;

struct qdot_companion {
    size_t n;
    const double *scales; /* of the system (scale.h) */
    const qdot_ode_method *run; /* its method */
    const qdot_ode_meter *meter;
    double tol, t1, t1_low, t0_low; /* of the run */
    bool leading, alternates;
    size_t samples; /* 0 or PLACES */
    double times[PLACES];
    double *shown; /* [PLACES x n] states of the run at `times` */
    size_t n_shown;
    atomic_bool leave; /* companions are to stop: the run ended at another time */
    double share; /* factor by which the second companion's distance counts */
    double floor; /* the smallest error that is stated */
    follower at[2];
    size_t count;
};

bool
qdot_companion_is_by_series(const qdot_ode_method *method)
{
    return !(method->stiff && method->kernel);
}

const qdot_ode_method *
qdot_companion_method(const qdot_ode_system *system, const qdot_ode_method *method)
{
    return qdot_ode_method_find(system->series && qdot_companion_is_by_series(method)
                                    ? "taylor" : method->partner);
}

double
qdot_companion_tolerance(const qdot_ode_system *system, const qdot_ode_method *method,
                         double tol)
{
    const qdot_ode_method *partner = qdot_companion_method(system, method);
    bool same = partner == method;

    if (partner->series)
        return fmax(fmin(partner->companion_ratio, method->companion_ratio) * tol,
                    partner->companion_tol);
    if (same && method->companion_tol > tol / 4)
        return 10 * fmax(tol, method->companion_tol);
    return fmax(method->companion_ratio * tol, method->companion_tol);
}

qdot_companion_way
qdot_companion_way_from(qdot_companion_way way, size_t number, const qdot_ode_system *system,
                        const qdot_ode_method *method, double tol, qdot_companion_plan *plan)
{
    qdot_ode_system plain = *system;

    plain.series = NULL;
    *plan = (qdot_companion_plan){0};
    if (way == QDOT_COMPANION_SERIES && (!system->series || !qdot_companion_is_by_series(method)))
        way = QDOT_COMPANION_PARTNER;
    if (way == QDOT_COMPANION_PARTNER && system->series && !method->stiff)
        way = QDOT_COMPANION_FINER;
    if (way == QDOT_COMPANION_FINER && (!method->stiff || tol / finer[1] < method->companion_tol))
        way = QDOT_COMPANION_COARSE;
    if (way == QDOT_COMPANION_SERIES) {
        plan->method = qdot_companion_method(system, method);
        plan->tol = qdot_companion_tolerance(system, method, tol);
    } else if (way == QDOT_COMPANION_PARTNER) {
        plan->method = qdot_companion_method(&plain, method);
        plan->tol = qdot_companion_tolerance(&plain, method, tol);
    } else if (way == QDOT_COMPANION_FINER) {
        plan->method = method;
        plan->tol = tol / finer[number];
    } else if (way == QDOT_COMPANION_COARSE) {
        plan->method = method;
        plan->tol = fmin(1, coarser * fmax(tol, method->companion_tol));
    }
    return way;
}

void
qdot_companion_meter(qdot_ode_meter *m, const qdot_ode_meter *run, const qdot_ode_method *method,
                     const qdot_ode_system *system, qdot_companion_way way, double spent)
{
    m->beside = run;
    m->factor = way == QDOT_COMPANION_SERIES && method->series ? QDOT_COMPANION_WORTH_FINER
                                                               : QDOT_COMPANION_WORTH;
    m->allowance = method->stiff ? QDOT_COMPANION_ALLOWANCE_STIFF : QDOT_COMPANION_ALLOWANCE;
    if (way == QDOT_COMPANION_COARSE)
        m->allowance = fmax(m->allowance, 3 * m->allowance - spent);
    m->whole_only = system->n_parts > 1 || way == QDOT_COMPANION_COARSE;
}

/* Signs without a pattern that a symmetric system could share (Knuth's multiplicative
 * hash of the index, bit 31). */
static bool
goes_up(size_t i, size_t number)
{
    return (uint32_t)(i + 1) * UINT32_C(2654435769) >> 31 == number % 2;
}

double
qdot_companion_aside(double tol, double size, size_t i, size_t number, double by)
{
    by *= QDOT_COMPANION_AIMS * qdot_step_aim(tol, true) * size;
    return goes_up(i, number) ? by : -by;
}

double
qdot_companion_moved(double y, double scale, size_t i, size_t number, double by)
{
    const bool up = goes_up(i, number);

    if (y == 0)
        return up ? unit * scale : -unit * scale;
    return y + by * (nextafter(y, up ? INFINITY : -INFINITY) - y);
}

double
qdot_companion_first_share(size_t number)
{
    return number ? 0.4142 : 0.618;
}

double
qdot_companion_far(uint64_t steps)
{
    return fmin(QDOT_COMPANION_FAR, fmax(1, floor(sqrt((double)steps))));
}

double
qdot_companion_floor(uint64_t steps)
{
    return 2 * unit * fmin(most_floor, fmax(1, sqrt((double)steps)));
}

static qdot_status
look(double t, const double *y, bool *stop, void *user)
{
    const follower *f = user;

    (void)t;
    (void)y;
    *stop = atomic_load_explicit(&f->of->leave, memory_order_relaxed);
    return QDOT_OK;
}

/* To t1 by one way. */
static void
run_by(follower *f, const qdot_companion_plan *by, double t1)
{
    const qdot_companion *c = f->of;
    const qdot_ode_method *now = NULL;
    qdot_ode_options options = {.tol = by->tol,
                                .first_share = qdot_companion_first_share(f->number),
                                .accepted = look,
                                .user = f,
                                .order_more = QDOT_COMPANION_ORDERS - 2 * (int)f->number,
                                .leading = c->leading,
                                .alternates = c->alternates,
                                .now = &now,
                                .end_low = c->leading ? f->now : NULL,
                                .meter = c->meter ? &f->meter : NULL,
                                .stiff_work = INFINITY, /* the meter bounds it */
                                .apart = true};
    double t = f->t0;
    qdot_ode_stats spent = f->result.stats;

    qdot_companion_meter(&f->meter, c->meter, c->run, &f->system, f->way, f->spent);
    qdot_ode_meter_begin(&f->meter, f->t0, c->t1);
    memcpy(f->y, f->start, c->n * sizeof *f->y);
    for (f->reached = 0;;) {
        bool last = t1 != c->t1 || f->reached == c->samples;
        double to = last ? t1 : c->times[f->reached];

        options.t1_low = to == c->t1 ? c->t1_low : 0;
        options.carry = t == f->t0 ? f->low : c->leading ? f->now : NULL;
        options.t0_low = t == f->t0 ? c->t0_low : 0;
        options.goes_on = t != f->t0;
        if (qdot_ode_integrate(&f->system, by->method, &options, t, to, f->y, &f->result)
            != QDOT_OK)
            f->result.outcome = QDOT_ODE_FAILED;
        qdot_ode_stats_add(&spent, &f->result.stats);
        if (last || f->result.outcome != QDOT_ODE_DONE)
            break;
        memcpy(f->own + f->reached++ * c->n, f->y, c->n * sizeof *f->y);
        t = to;
    }
    f->result.stats = spent;
}

bool
qdot_companion_leads_nowhere(const qdot_ode_method *method, bool failed,
                             const qdot_ode_meter *meter)
{
    if (method->stiff) /* whose work may be in a moment, as where a relaxation jumps */
        return failed || meter->over;
    return meter->over && !qdot_ode_meter_is_stuck(meter);
}

/* To t1 by the first way from f->way on that leads there. */
static void
run_ways(follower *f, double t1)
{
    const qdot_companion *c = f->of;
    qdot_companion_plan by;
    double work;

    for (;; f->way++) {
        f->way = qdot_companion_way_from(f->way, f->number, &f->system, c->run, c->tol, &by);
        if (f->way == QDOT_COMPANION_WAYS)
            return;
        f->tol = by.tol;
        run_by(f, &by, t1);
        if (f->result.outcome != QDOT_ODE_FAILED
            || !qdot_companion_leads_nowhere(c->run, true, &f->meter))
            return;
        (void)qdot_ode_meter_exceeds(&f->meter, &work);
        f->spent += work;
    }
}

static void
run_to(follower *f, double t1)
{
    f->result = (qdot_ode_result){0};
    f->way = QDOT_COMPANION_SERIES;
    f->spent = 0;
    run_ways(f, t1);
    f->finished = true;
}

static void *
thread_main(void *user)
{
    follower *f = user;

    run_to(f, f->of->t1);
    return NULL;
}

static void
release(qdot_companion *c)
{
    for (size_t k = 0; k < c->count; k++) {
        qdot_free(c->at[k].start);
        qdot_free(c->at[k].low);
        qdot_free(c->at[k].now);
        qdot_free(c->at[k].y);
        qdot_free(c->at[k].own);
    }
    qdot_free(c->shown);
    qdot_free(c);
}

/* No times between are used if the run is so short that two of them would be the same double. */
static void
choose_times(qdot_companion *c, double t0)
{
    c->samples = PLACES;
    for (size_t k = 0; k < PLACES; k++) {
        c->times[k] = t0 + places[k] * (c->t1 - t0);
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
qdot_companion_show(qdot_companion *c, size_t k, const double *y)
{
    memcpy(c->shown + k * c->n, y, c->n * sizeof *y);
    c->n_shown = k + 1;
}

/* max |a - b| / max(s, min(|a|, |b|)) over components. */
static double
apart(const qdot_companion *c, const double *scales, const double *a, const double *b)
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
    return (1 + most_share) * apart + own;
}

/* Error bound of the run's state y, relative to these scales, from the companions' states at time k
 * (SIZE_MAX: at the end). The distance of the second companion counts by the factor `share`. */
static double
bound_at(const qdot_companion *c, const double *scales, const double *y, size_t k)
{
    const double *of[2];
    double worst = 0;

    for (size_t i = 0; i < c->count; i++) {
        of[i] = k == SIZE_MAX ? c->at[i].y : c->at[i].own + k * c->n;
        worst = fmax(worst, (i ? c->share : 1) * apart(c, scales, y, of[i]));
    }
    return qdot_companion_bound(worst,
                                c->count == 2 ? c->share * apart(c, scales, of[0], of[1]) : 0);
}

double
qdot_companion_bound_of(double x, size_t count, const double *theirs, double share)
{
    const double apart = fabs(theirs[0] - x);

    return count == 2 ? qdot_companion_bound(fmax(apart, share * fabs(theirs[1] - x)),
                                             share * fabs(theirs[1] - theirs[0]))
                      : qdot_companion_bound(apart, 0);
}

/* The median of the error bounds at the times between. */
static double
median_between(const qdot_companion *c, const double *scales)
{
    double errors[PLACES];

    for (size_t k = 0; k < PLACES; k++) {
        double worst = bound_at(c, scales, c->shown + k * c->n, k);
        size_t at = k;

        for (; at > 0 && errors[at - 1] > worst; at--)
            errors[at] = errors[at - 1];
        errors[at] = worst;
    }
    return errors[PLACES / 2];
}

static qdot_status
prepare(qdot_companion *c, const qdot_companion_request *request, size_t number)
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
    f->now = qdot_calloc(c->n, sizeof *f->now);
    if (!f->start || !f->low || !f->now || !f->y || !f->own)
        return QDOT_ENOMEM;
    if (request->carry)
        memcpy(f->low, request->carry, c->n * sizeof *f->low);
    for (size_t i = 0; i < c->n; i++) {
        const double y = request->y0[i], far = number ? QDOT_COMPANION_FAR : 1;

        if (c->leading)
            f->low[i] += qdot_companion_aside(request->tol, qdot_ode_size(c->scales, i, y), i,
                                              number, far);
        f->start[i] = c->leading ? y
                                 : qdot_companion_moved(y, qdot_ode_scale(c->scales, i), i,
                                                        number, far);
    }
    if (f->system.project) { /* only along what solutions may do */
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
    c->share = 1;
    c->floor = unit;
    c->shown = qdot_malloc(PLACES * c->n * sizeof *c->shown);
    if (request->system->series)
        choose_times(c, request->t0);
    atomic_init(&c->leave, false);
    status = c->shown ? prepare(c, request, 0) : QDOT_ENOMEM;
    if (status == QDOT_OK && request->twin)
        status = prepare(c, request, 1);
    if (status != QDOT_OK) {
        release(c);
        return status;
    }
    for (size_t k = 0; k < c->count && request->threaded; k++)
        c->at[k].running =
            pthread_create(&c->at[k].thread, NULL, thread_main, c->at + k) == 0;
    *out = c;
    return QDOT_OK;
}

/* It arrived, before the run had, at a price that is too high beside that of the whole run: the
 * other ways. */
static void
judge(follower *f, double t1)
{
    double work;

    while (f->of->meter && f->way != QDOT_COMPANION_WAYS
           && f->result.outcome == QDOT_ODE_DONE && qdot_ode_meter_exceeds(&f->meter, &work)) {
        f->spent += work;
        f->way++;
        f->result.outcome = QDOT_ODE_FAILED;
        snprintf(f->result.reason, sizeof f->result.reason,
                 "it would take more than %.2g times the work of this one", f->meter.factor);
        run_ways(f, t1);
    }
}

/* Its end, and whether it shows the states between, too. */
static bool
arrive(follower *f, bool whole, double t_end, qdot_companion_estimate *out)
{
    const qdot_companion *c = f->of;
    const double t1 = whole ? c->t1 : t_end;

    if (!whole || !f->finished)
        run_to(f, t1);
    judge(f, t1);
    if (f->number == 0 || out->result.outcome == QDOT_ODE_DONE)
        out->result = f->result;
    out->tol = fmax(out->tol, f->tol);
    if (f->way > out->way)
        out->way = f->way;
    out->known = out->known && f->result.outcome == QDOT_ODE_DONE;
    return whole && c->n_shown == PLACES && f->reached == PLACES;
}

void
qdot_companion_limit(qdot_companion *c, uint64_t steps)
{
    c->share = qdot_companion_far(steps) / QDOT_COMPANION_FAR;
    c->floor = !c->leading                    ? qdot_companion_floor(steps)
               : c->at[0].system.following ? derived * unit
                                           : unit;
}

/* The error of the end y relative to these scales; `between`: that of states before it, too. */
static double
error_of(const qdot_companion *c, const double *scales, const double *y, bool between)
{
    const double error = fmax(c->floor, bound_at(c, scales, y, SIZE_MAX));

    return between ? fmax(error, fmin(median_between(c, scales), most_between * error)) : error;
}

void
qdot_companion_finish(qdot_companion *c, double t_end, const double *y,
                      double *difference, qdot_companion_estimate *out)
{
    /* the neighbour of t1 stands for t1 */
    bool whole = fabs(t_end - c->t1) <= 4 * unit * fabs(c->t1), between = true;

    if (!whole)
        atomic_store(&c->leave, true);
    for (size_t k = 0; k < c->count; k++)
        if (c->at[k].running)
            pthread_join(c->at[k].thread, NULL);
    atomic_store(&c->leave, false);
    *out = (qdot_companion_estimate){.known = true};
    for (size_t k = 0; k < c->count; k++)
        between = arrive(c->at + k, whole, t_end, out) && between;
    out->error = out->known ? error_of(c, c->scales, y, between) : NAN;
    out->plain = out->known ? error_of(c, NULL, y, between) : NAN;
    for (size_t i = 0; i < c->n && difference; i++) {
        const double ends[] = {c->at[0].y[i], c->count == 2 ? c->at[1].y[i] : 0};

        difference[i] =
            out->known ? qdot_companion_bound_of(y[i], c->count, ends, c->share) : NAN;
    }
    release(c);
}
