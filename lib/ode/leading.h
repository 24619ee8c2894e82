/* leading.h -- steps by Taylor series whose first orders are sums of two doubles.
 *
 * With s = (t' - t)/unit, t' - t a sum of two doubles as well,
 *
 *     y' = y + sum_{k=1..m} X_k s^k + sum_{k=m+1..p} x_k s^k,
 *
 * the first sum in two doubles, the second in doubles. m is the least order, up to
 * QDOT_ODE_LEADING_MOST, beyond which rounding is negligible compared with the error of a step,
 *
 *     max_i |x_ik s^k|/max(s_i, |y_i|) 2^-52 <= eps   for k > m,
 *     max_i |X_im - x_im| s^m/max(s_i, |y_i|) <= 4 eps:
 *
 * The second condition is the accuracy that doubles really have at order m if terms of the
 * equations cancel. The remaining rounding is of the size of the series' own error, whose bound
 * eps = tol^(5/4) may then be below 10^-17.
 *
 * Tests  tests/ode/test_leading.c
 */
#ifndef QDOT_ODE_LEADING_H
#define QDOT_ODE_LEADING_H

#include <stdbool.h>

#include "ode/run.h"

/* First orders are computed in two doubles for tolerances up to this one, for which one double is not enough. */
#define QDOT_ODE_LEADING_TOL 1.0001e-14

/* A step from `at` by h + h_low, order p; its series x of system->series, in that unit, has been
 * computed. eps: the error that it aims at. */
typedef struct {
    const qdot_ode_system *system;
    qdot_ode_place at;
    double h, h_low, unit, eps;
    const double *scale; /* [n] 1/max(s_i, |y_i|) for each component, s_i the scales of scale.h */
    int p;
} qdot_ode_leading_step;

/* Compute the first orders, and replace next, next_carry [n], the end of the step in doubles, by
 * that in two doubles, except components that system->following derives. Failures as those of its
 * find. */
QDOT_MUST_CHECK qdot_status qdot_ode_leading_advance(const qdot_ode_leading_step *step,
                                                     double *next, double *next_carry);

/* The state y [n] at t in a step of h from `at`, expanded to order p under tol by
 * qdot_ode_taylor_expand. Derived components (system->following) are those of the series.
 * Failures as above, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ode_leading_read(const qdot_ode_system *system, int p,
                                                  double tol, const qdot_ode_place *at,
                                                  double h, double t, double *y);

#endif
