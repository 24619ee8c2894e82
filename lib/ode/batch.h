/* batch.h -- many runs of one system by Taylor series, eight at a time.
 *
 * Each lane (num/batch.h) carries a member of the ensemble: its own time, step, unit and
 * end. All lanes are expanded together to one order; each then goes as far as its own
 * series allows, by the rules of ode/taylor.h, and a lane that has arrived, or cannot go
 * on, takes the next member. So a member's run equals that of the member alone, to rounding,
 * whatever the other lanes do.
 *
 * If the upper half of a series is 0 the polynomial may be the exact solution: the first such
 * step goes an irrational part of the way, so that it cannot be a period, and only the next one
 * all of it.
 *
 * Tests  tests/sim/ensemble/test_ensemble.c
 */
#ifndef QDOT_ODE_BATCH_H
#define QDOT_ODE_BATCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "num/batch.h"

/* A step that a member will try: its solution at t + unit s is sum_k x_ik s^k, k <= order, with
 * x_ik = x[(i stride + k) QDOT_LANES]. */
typedef struct {
    size_t lane, member;
    double t, t_end, unit;
    int order;
    bool last;       /* whether t_end is the end of this solution's run */
    const double *x; /* Taylor coefficients of the lane, stored as in the system's x */
    const double *y; /* component y_i at t is y[i QDOT_LANES] */
} qdot_batch_step;

/* As qdot_ode_series, every number a group of lanes. A lane where f is undefined gets
 * coefficients of order 1 that are not finite. */
typedef struct {
    size_t n;        /* number of components of y */
    size_t checked;  /* dy_i/dt = y_{checked + i} for i below it: their defect is not checked, and
                        the carry of the others enters order 1 */
    size_t still;    /* number of last components that are constant: their coefficients of order 1
                        and above are 0 */
    const double *x; /* coefficient x_ik of the solution in lane l is x[(i stride + k) QDOT_LANES + l] */
    size_t stride;
    /* Called when lane `lane` begins to compute solution `member`: load its parameters. NULL: nothing to load. */
    void (*take)(size_t lane, size_t member, void *user);
    /* Compute orders 0 and 1 of the series through y [n groups] at times t, with the given units of time. */
    void (*begin)(const double *t, const double *y, const double *unit, void *user);
    /* Compute orders 2 ... p of the series from the orders below them. */
    void (*extend)(int p, void *user);
    /* Project y + carry [n groups], each lane at its t [a group], as qdot_ode_system.project
     * does; moved [a group] as there, NaN in a lane in which that fails. NULL: no projection. */
    void (*project)(const double *t, double *y, double *carry, double *moved, void *user);
    /* As qdot_ode_series.near, of all lanes, into near [a group]; an s that is a NaN is none. NULL
     * likewise. */
    void (*near)(int p, const double *s, const double *least, double *near, void *user);
    /* Look at a step, before it is confirmed; the last one that was looked at is taken, and the
     * member ends there if `taken` says so. NULL: nobody looks. Errors of `tried` end the run. */
    qdot_status (*tried)(const qdot_batch_step *step, void *user);
    bool (*taken)(size_t lane, void *user);
    void *user;        /* passed to the callbacks above; borrowed */
    void *looker;      /* passed to `tried` and `taken`; borrowed */
} qdot_ode_batch;

typedef enum {
    QDOT_BATCH_DONE,
    QDOT_BATCH_UNDEFINED,
    QDOT_BATCH_STUCK,
    QDOT_BATCH_LIMIT,
    QDOT_BATCH_LEFT
} qdot_batch_outcome;

typedef struct {
    qdot_batch_outcome outcome; /* arrived; f undefined at the start; no step small enough;
                                   too many steps; ended by `taken` */
    double t;                   /* time at which the solution ended */
    size_t steps, rejected;
} qdot_batch_result;

typedef struct {
    size_t members;
    int order;
    double tol, term_tol; /* tolerances as in qdot_ode_options: 1e-16 to 1 */
    const double *t0, *t1; /* [members] start and end times; t1 < t0 means to integrate backwards */
    double t1_low;         /* the exact t1 minus its double, the same for all members */
    uint64_t most_steps;   /* largest number of steps tried by one member; 0: 50 million */
    double *y;             /* [members x n] input: start states; output: end states */
    qdot_batch_result *results; /* [members] how each solution ended */
    size_t expansions;          /* output: number of expansions; one made for all lanes together counts once */
} qdot_batch_run;

/* Run all members. Errors: QDOT_EINVAL (order, tol, times or starts not finite), QDOT_ENOMEM,
 * QDOT_EINTR (members that did not arrive are unchanged). The failure of a member is no error of
 * the batch: its result says so. */
QDOT_MUST_CHECK qdot_status qdot_ode_batch_run(const qdot_ode_batch *system,
                                               qdot_batch_run *run);

#endif
