/* companion.c -- the second run, beside the first. */
#include "ode/companion.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"

static const double unit = 0x1p-53;

/* Where in a run the times between lie; without a pattern that a period could share. */
static const double places[] = {0.5131, 0.5573, 0.6217, 0.6749, 0.7271,
                                0.7853, 0.8311, 0.8929, 0.9467};
enum { PLACES = sizeof places / sizeof places[0] };

struct qdot_companion {
    qdot_ode_system system;
    const qdot_ode_method *method; /* the partner */
    double tol, t0, t1;
    double *start; /* [n] the moved y0 */
    double *y;     /* [n] where it is */
    size_t samples;          /* 0 or PLACES */
    double times[PLACES];
    double *own, *shown;     /* [PLACES x n] the states of both runs there */
    size_t reached, n_shown; /* how many of each there are, from the first */
    qdot_ode_result result;
    bool running;      /* on `thread` */
    bool finished;     /* result is valid */
    atomic_bool leave; /* the run ended elsewhere */
    pthread_t thread;
};

double
qdot_companion_tolerance(const qdot_ode_method *method, double tol)
{
    bool same = strcmp(method->partner, method->name) == 0;

    if (same && !method->series && method->companion_tol > tol / 4)
        return 10 * fmax(tol, method->companion_tol);
    return fmax(method->companion_ratio * tol, method->companion_tol);
}

/* Signs without a pattern that a symmetric system could share (Knuth's multiplicative
 * hash of the index, bit 31). */
static double
moved(double y, size_t i)
{
    double sign = (uint32_t)(i + 1) * UINT32_C(2654435769) >> 31 ? -1 : 1;
    double x = y + sign * unit * fmax(1, fabs(y));

    return x != y ? x : nextafter(y, sign * INFINITY);
}

static qdot_status
look(double t, const double *y, bool *stop, void *user)
{
    qdot_companion *c = user;

    (void)t;
    (void)y;
    *stop = atomic_load_explicit(&c->leave, memory_order_relaxed);
    return QDOT_OK;
}

static void
run_to(qdot_companion *c, double t1)
{
    qdot_ode_options options = {.tol = c->tol,
                                .accepted = look,
                                .user = c,
                                .order_more = QDOT_COMPANION_ORDERS};
    double t = c->t0;
    qdot_ode_stats spent = {0};

    memcpy(c->y, c->start, c->system.n * sizeof *c->y);
    for (c->reached = 0;;) {
        bool last = t1 != c->t1 || c->reached == c->samples;
        double to = last ? t1 : c->times[c->reached];

        if (qdot_ode_integrate(&c->system, c->method, &options, t, to, c->y, &c->result)
            != QDOT_OK)
            c->result.outcome = QDOT_ODE_FAILED;
        spent.steps += c->result.stats.steps;
        spent.rejected += c->result.stats.rejected;
        spent.evaluations += c->result.stats.evaluations;
        spent.jacobians += c->result.stats.jacobians;
        spent.factorisations += c->result.stats.factorisations;
        spent.cpu += c->result.stats.cpu;
        if (last || c->result.outcome != QDOT_ODE_DONE)
            break;
        memcpy(c->own + c->reached++ * c->system.n, c->y, c->system.n * sizeof *c->y);
        t = to;
    }
    c->result.stats = spent;
    c->finished = true;
}

static void *
thread_main(void *user)
{
    qdot_companion *c = user;

    run_to(c, c->t1);
    return NULL;
}

static void
release(qdot_companion *c)
{
    qdot_free(c->start);
    qdot_free(c->y);
    qdot_free(c->own);
    qdot_free(c->shown);
    qdot_free(c);
}

/* None where the run is too short for them to differ. */
static bool
choose_times(qdot_companion *c)
{
    size_t n = c->system.n;

    c->own = qdot_calloc(PLACES * n, sizeof *c->own);
    c->shown = qdot_calloc(PLACES * n, sizeof *c->shown);
    c->samples = PLACES;
    for (size_t k = 0; k < PLACES; k++) {
        c->times[k] = c->t0 + places[k] * (c->t1 - c->t0);
        if (c->times[k] == (k ? c->times[k - 1] : c->t0) || c->times[k] == c->t1)
            c->samples = 0;
    }
    return c->own && c->shown;
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
    memcpy(c->shown + k * c->system.n, y, c->system.n * sizeof *y);
    c->n_shown = k + 1;
}

/* The median over the times between of the largest error at each. */
static double
median_between(const qdot_companion *c)
{
    double errors[PLACES];
    size_t n = c->system.n;

    for (size_t k = 0; k < PLACES; k++) {
        double worst = 0;
        size_t at = k;

        for (size_t i = 0; i < n; i++) {
            double y = c->shown[k * n + i];

            worst = fmax(worst, fabs(y - c->own[k * n + i]) / fmax(1, fabs(y)));
        }
        for (; at > 0 && errors[at - 1] > worst; at--)
            errors[at] = errors[at - 1];
        errors[at] = worst;
    }
    return errors[PLACES / 2];
}

qdot_status
qdot_companion_start(const qdot_ode_system *system, const qdot_ode_method *method,
                     double tol, double t0, double t1, const double *y0, bool threaded,
                     qdot_companion **out)
{
    qdot_companion *c = qdot_calloc(1, sizeof *c);

    *out = NULL;
    if (!c)
        return QDOT_ENOMEM;
    c->system = *system;
    c->method = qdot_ode_method_find(method->partner);
    c->tol = qdot_companion_tolerance(method, tol);
    c->t0 = t0;
    c->t1 = t1;
    c->start = qdot_malloc(system->n * sizeof *c->start);
    c->y = qdot_malloc(system->n * sizeof *c->y);
    if (!c->start || !c->y) {
        release(c);
        return QDOT_ENOMEM;
    }
    if (c->method->series && !choose_times(c)) {
        release(c);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < system->n; i++)
        c->start[i] = moved(y0[i], i);
    if (system->project) { /* only along what solutions may do */
        double by;
        qdot_status status = system->project(t0, c->start, NULL, &by, system->user);

        if (status != QDOT_OK) {
            release(c);
            return status;
        }
    }
    atomic_init(&c->leave, false);
    c->running = threaded && pthread_create(&c->thread, NULL, thread_main, c) == 0;
    *out = c;
    return QDOT_OK;
}

void
qdot_companion_finish(qdot_companion *c, double t_end, const double *y,
                      double *difference, qdot_companion_estimate *out)
{
    /* the neighbour of t1 stands for t1 */
    bool whole = fabs(t_end - c->t1) <= 4 * unit * fabs(c->t1);

    if (c->running) {
        if (!whole)
            atomic_store(&c->leave, true);
        pthread_join(c->thread, NULL);
        atomic_store(&c->leave, false);
    }
    if (!whole || !c->finished)
        run_to(c, whole ? c->t1 : t_end);
    *out = (qdot_companion_estimate){
        .known = c->result.outcome == QDOT_ODE_DONE,
        .error = c->result.outcome == QDOT_ODE_DONE ? unit : NAN,
        .tol = c->tol,
        .result = c->result,
    };
    for (size_t i = 0; i < c->system.n; i++) {
        double d = out->known ? fabs(y[i] - c->y[i]) : NAN;

        if (difference)
            difference[i] = d;
        if (out->known)
            out->error = fmax(out->error, d / fmax(1, fabs(y[i])));
    }
    if (out->known && whole && c->n_shown == PLACES && c->reached == PLACES)
        out->error = fmax(out->error, median_between(c));
    release(c);
}
