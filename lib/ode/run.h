/* run.h -- options and results of an integration. */
#ifndef QDOT_ODE_RUN_H
#define QDOT_ODE_RUN_H

#include <stdbool.h>
#include <stdint.h>

#include "base/status.h"
#include "ode/method.h"
#include "ode/system.h"

/* Counts of steps and evaluations in an integration. */
typedef struct {
    uint64_t steps;          /* accepted steps */
    uint64_t rejected;       /* steps tried and rejected, for whatever reason */
    uint64_t evaluations;    /* evaluations of f */
    uint64_t jacobians;      /* evaluations of df/dy */
    uint64_t factorisations; /* LU, inside the method; for msbdf a lower bound (GSL does
                                not tell); a step of bsimp broken off counts in full */
    uint64_t projections;    /* steps whose end was moved onto the constraints by system->project */
    double raised;           /* by Taylor series and radau: the tolerance that rounding of the
                                equations left, where it is more than that asked for; else 0 */
    double cpu;              /* CPU seconds of this thread */
} qdot_ode_stats;

/* Add the counts of another part of the run to the sum. */
static inline void
qdot_ode_stats_add(qdot_ode_stats *sum, const qdot_ode_stats *more)
{
    sum->steps += more->steps;
    sum->rejected += more->rejected;
    sum->evaluations += more->evaluations;
    sum->jacobians += more->jacobians;
    sum->factorisations += more->factorisations;
    sum->projections += more->projections;
    sum->raised = more->raised > sum->raised ? more->raised : sum->raised;
    sum->cpu += more->cpu;
}

/* A step of Taylor series, from (t, y [n]) to t_end; the solution at t + unit s is
 * sum_k x_ik s^k, k <= order, of system->series. */
typedef struct {
    double t, t_end, unit;
    int order;
    const double *y;
    const double *carry; /* [n] exact state minus its double y; NULL: 0 */
    double holds; /* the time to which the coefficients allow a step, not before t_end; infinite: the series ends */
} qdot_ode_expanded;

typedef struct qdot_ode_meter qdot_ode_meter;

/* The options of an integration; any field may be 0 or NULL for its default. */
typedef struct {
    double tol;         /* tolerance, 1e-16 .. 1; default 1e-12 */
    double h_fixed;     /* > 0: steps of (at most) this length, whatever their error */
    double h_first;     /* > 0: length of the first step to try */
    double first_share; /* > 0: factor of the first step length that a method finds itself */
    uint64_t max_steps; /* largest number of steps tried; default 50 million */
    /* largest number of evaluations of f, for methods with difference quotients; default: no limit */
    uint64_t max_evaluations;
    qdot_ode_meter *meter; /* to which each step adds its work, and which may end the run (meter.h);
                              borrowed */
    double stiff_work; /* by explicit methods: the run ends if stability bounds its steps and so much
                          work is left (stiffness.h); default 5e9 */
    /* Called with the end of every step, before it is accepted, not for the initial state. Set *stop to end the run
     * there. QDOT_EDOMAIN: the step is rejected and smaller ones are tried, as if f were
     * undefined; any other failure rejects the step and ends the run. */
    qdot_status (*accepted)(double t, const double *y, bool *stop, void *user);
    void *user; /* passed to `accepted`; borrowed */
    bool at_doubles; /* steps that may be of any length end at doubles of t exactly, so that states
                        within them can be located to less than a double */
    double t1_low; /* exact end time minus its double t1; the run ends at the exact time; not for steps of constant length */
    /* taylor only: the exact initial state less y [n], borrowed; orders added to those that the
     * tolerance needs. */
    const double *carry;
    int order_more;
    double past;       /* taylor only: number of steps in earlier runs of this system (written.h) */
    double term_tol; /* taylor only: rounding errors of the series' terms below this do not count; default: tol */
    /* taylor only: whether the first orders of every step are in two doubles (leading.h), which
     * the system must support; the exact t0 less t0. */
    bool leading;
    bool judged; /* end a run with `leading` that finds it harmful with result.unfit (taylor.h) */
    double t0_low;
    /* Change from a stiff method, if it is a kernel, to Taylor series where these are faster, and back
     * (alternate.c); the method to begin with, NULL: the stiff one. */
    bool alternates;
    const qdot_ode_method *now;
    /* continue the solution that was begun last, instead of a new one (system->following) */
    bool goes_on;
    /* For a system of parts: call `accepted` for each part, with its components. Otherwise such a
     * system is integrated as a whole if `accepted` is set. */
    bool apart;
} qdot_ode_options;

typedef enum {
    QDOT_ODE_DONE,    /* the end time t1 was reached */
    QDOT_ODE_STOPPED, /* the callback `accepted` ended the run by setting *stop */
    QDOT_ODE_FAILED   /* the integration failed: `reason` says where and why; the state is the last good one */
} qdot_ode_outcome;

typedef struct {
    qdot_ode_outcome outcome;
    double t; /* time of the end state; exactly t1 if the run arrived there */
    bool unfit; /* it failed because first orders in two doubles make the steps worse */
    bool stiff; /* it failed because stability limits the step length (stiffness.h) */
    qdot_ode_stats stats;
    char reason[512]; /* why the integration failed; otherwise "" */
} qdot_ode_result;

/* The tolerance and the maximum number of steps given in the options, or their defaults. */
static inline double
qdot_ode_tolerance(const qdot_ode_options *options)
{
    return options->tol != 0 ? options->tol : 1e-12;
}

static inline uint64_t
qdot_ode_most_steps(const qdot_ode_options *options)
{
    return options->max_steps ? options->max_steps : 50000000;
}

/* Whether all x [n] are finite (0 * x is 0 for finite x, otherwise NaN). */
static inline bool
qdot_ode_all_finite(const double *x, size_t n)
{
    double sum = 0;

    for (size_t i = 0; i < n; i++)
        sum += 0 * x[i];
    return sum == 0;
}

/* QDOT_EINVAL, with the reason: a tolerance that no double can hold; limits or an initial state that are
 * not finite. */
QDOT_MUST_CHECK qdot_status qdot_ode_check_tolerance(double tol);
QDOT_MUST_CHECK qdot_status qdot_ode_check_limits(const qdot_ode_system *system, double t0,
                                                  double t1, const double *y);

/* QDOT_ELIMIT, with the hint, if a run from t0 that has come to t in so many steps would take more than `most` to t1. */
QDOT_MUST_CHECK qdot_status qdot_ode_check_pace(double t0, double t, double t1, size_t steps, double most,
                                                const char *hint);

/* Record in `result` that an integration ended at time t with the given status. */
void qdot_ode_end(qdot_ode_result *result, double t, qdot_status status);

/* Begin an integration: enter the solution through y [n] at t (system->following), unless
 * options->goes_on. Failures become QDOT_EFAILED, with the time. */
QDOT_MUST_CHECK qdot_status qdot_ode_enter(const qdot_ode_system *system,
                                           const qdot_ode_options *options, double t,
                                           const double *y);

#endif
