/* companion.c -- the second run, beside the first. */
#include "ode/companion.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"

static const double unit = 0x1p-53;

struct qdot_companion {
    qdot_ode_system system;
    const qdot_ode_method *method; /* the partner */
    double tol, t0, t1;
    double *start; /* [n] the moved y0 */
    double *y;     /* [n] where it is */
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

    memcpy(c->y, c->start, c->system.n * sizeof *c->y);
    if (qdot_ode_integrate(&c->system, c->method, &options, c->t0, t1, c->y,
                           &c->result) != QDOT_OK)
        c->result.outcome = QDOT_ODE_FAILED;
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
    qdot_free(c);
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
    for (size_t i = 0; i < system->n; i++)
        c->start[i] = moved(y0[i], i);
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
    release(c);
}
