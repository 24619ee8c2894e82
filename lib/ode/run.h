/* run.h -- what an integration is told, and what it tells. */
#ifndef QDOT_ODE_RUN_H
#define QDOT_ODE_RUN_H

#include <stdbool.h>
#include <stdint.h>

#include "base/status.h"
#include "ode/method.h"
#include "ode/system.h"

/* What a run did. */
typedef struct {
    uint64_t steps;          /* accepted */
    uint64_t rejected;       /* tried and not taken, for whatever reason */
    uint64_t evaluations;    /* of f */
    uint64_t jacobians;      /* of df/dy */
    uint64_t factorisations; /* LU, inside the method; for msbdf a lower bound (GSL does
                                not tell); a step of bsimp broken off counts in full */
    uint64_t projections;    /* steps whose end system->project moved */
    double cpu;              /* seconds of this thread */
} qdot_ode_stats;

/* A step about to be tried by Taylor series: from (t, y [n]) to t_end; the solution at
 * t + unit s is sum_k x_ik s^k, k <= order, of system->series. */
typedef struct {
    double t, t_end, unit;
    int order;
    const double *y;
} qdot_ode_expanded;

/* All fields may be 0 / NULL for their defaults. */
typedef struct {
    double tol;         /* 1e-16 .. 1; default 1e-12 */
    double h_fixed;     /* > 0: steps of (at most) this size, their error not looked at */
    double h_first;     /* > 0: the size to try first */
    uint64_t max_steps; /* tried; default 50 million */
    /* After every accepted step, not for the initial state. Set *stop to end the run
     * here. QDOT_EDOMAIN: the step is taken back and smaller ones are tried, as when f is
     * undefined; any other failure takes the step back and ends the run with it. */
    qdot_status (*accepted)(double t, const double *y, bool *stop, void *user);
    void *user; /* borrowed, for `accepted` and `expanded` */
    /* Of taylor.h only: before a step is tried, its series being there. t_end may be
     * brought nearer. It counts once `accepted` is called for that end. Failures as those
     * of `accepted`. */
    qdot_status (*expanded)(qdot_ode_expanded *step, void *user);
    /* Of taylor.h only: what the initial state is beyond y [n], borrowed, and t1 beyond
     * itself (the end state is that of the sum); orders more than the tolerance asks
     * for. */
    const double *carry;
    double t1_low;
    int order_more;
    /* Of taylor.h only: the first orders of every step in two doubles (leading.h), which the
     * system has; what t0 is beyond itself; where it is to be shown, while `accepted` runs,
     * what the state is beyond y; and [n] what the end state is. */
    bool leading;
    double t0_low;
    const double **beyond;
    double *end_low;
    /* This goes on with the solution entered last (system->following). */
    bool goes_on;
    /* Of a system of parts: `accepted` is called for each, with what is its own. Else such a
     * system whose steps are looked at is integrated as a whole. */
    bool apart;
} qdot_ode_options;

typedef enum {
    QDOT_ODE_DONE,    /* t1 was reached */
    QDOT_ODE_STOPPED, /* `accepted` said so */
    QDOT_ODE_FAILED   /* the reason says where and why; the state is the last good one */
} qdot_ode_outcome;

typedef struct {
    qdot_ode_outcome outcome;
    double t; /* where the state is: t1 exactly when done */
    qdot_ode_stats stats;
    char reason[512]; /* of a failure; else "" */
} qdot_ode_result;

/* What every integration of system begins with: the solution through y [n] at t is entered,
 * unless the options say that it goes on. Failures become QDOT_EFAILED, with the time. */
QDOT_MUST_CHECK qdot_status qdot_ode_enter(const qdot_ode_system *system,
                                           const qdot_ode_options *options, double t,
                                           const double *y);

#endif
