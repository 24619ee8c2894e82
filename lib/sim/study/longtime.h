/* longtime.h -- how the error of the energy grows with time, by every method.
 *
 *     e(t) = (h(t) - h(t0)) / max(1, |h(t0)|)
 *
 * is measured at steps of a run that is not stored, and its root mean square e_k taken over windows
 * of time, each longer than the one before by a factor sqrt(2), up to the whole run. The growth s is
 * the slope of a straight line through (log t_k, log e_k),
 *
 *     |e| ~ t^s,
 *
 * fitted to the later half of the windows: 0 where a symplectic method's error is bounded, 1/2 for
 * rounding without a direction, 1 for truncation that goes one way. Its error is twice the standard
 * one, which is larger the more neighbouring residuals resemble each other:
 *
 *     (standard error)^2 = sum r^2/(n - 2) / sum (log t - mean)^2 * (1 + c)/(1 - c),
 *
 * c the correlation of neighbours (at least 0).
 *
 * The tolerance is that of the request, if there is one; else 1e-12, or the next of 1e-10, 1e-8 ...
 * 1e-4 at which the method's first steps foretell no more work than its budget (ode/meter.h).
 *
 * Source  Hairer, Lubich & Wanner, Geometric Numerical Integration, VIII.5, IX.8.
 * Tests   tests/sim/study/test_longtime.c
 */
#ifndef QDOT_SIM_LONGTIME_H
#define QDOT_SIM_LONGTIME_H

#include <stdint.h>

#include "ode/method.h"
#include "sim/run/run.h"
#include "sim/study/left-out.h"

enum { QDOT_LONGTIME_WINDOWS = 64 };

typedef struct {
    const char *method;
    double tol;
    uint64_t steps, evals;
    double cpu; /* CPU seconds of the run */
    size_t n;   /* number of time windows */
    double t[QDOT_LONGTIME_WINDOWS], error[QDOT_LONGTIME_WINDOWS]; /* end of each window, minus t0; rms energy error in it */
    double largest;              /* largest energy error |h - h0|, relative to max(1, |h0|) */
    double growth, growth_error; /* exponent s of the energy error ~ t^s, and its error; NaN: cannot be determined */
    char status[300];            /* "done", or "failed: " and the reason */
} qdot_longtime_row;

typedef struct {
    const char *method; /* name of the only method to run; NULL: all methods */
    double tol;         /* tolerance for all methods; 0: each has its own */
    double budget;      /* largest work of a run, in units of about 1 ns; 0: 1e10, or no limit for a single method */
    size_t n, capacity;
    qdot_longtime_row *rows;
    qdot_methods_left_out left_out;
    bool interrupted;
    /* What `auto` would take, of all methods: NULL where it was not asked; the tolerance, and whether
     * that is for a long run (sim/run/long-run.h). */
    const qdot_ode_method *chosen;
    double chosen_tol;
    bool chosen_long;
} qdot_longtime;

/* request: values, start and limits. Set method, tol, budget of *out, the rest 0; clear it in any
 * case. Errors: as qdot_run_new; QDOT_EFAILED: the energy is not conserved, or an event or switch may
 * divide the run. */
QDOT_MUST_CHECK qdot_status qdot_longtime_measure(qdot_scene *scene,
                                                  const qdot_run_request *request,
                                                  qdot_longtime *out);
void qdot_longtime_clear(qdot_longtime *l);

/* Fit a line to log y over log x [n]: its slope and the error of it; NaN for fewer than 4 points or
 * if a y is 0. */
void qdot_longtime_fit(size_t n, const double *x, const double *y, double *slope, double *error);

#endif
