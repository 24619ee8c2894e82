/* leading.h -- steps by Taylor series whose first orders are sums of two doubles.
 *
 * With s = (t' - t)/unit, t' - t a sum of two doubles as well,
 *
 *     y' = y + sum_{k=1..m} X_k s^k + sum_{k=m+1..p} x_k s^k,
 *
 * the first sum in two doubles, the second in doubles. m is the least order, up to
 * QDOT_ODE_LEADING_MOST, behind which rounding does not count beside what a step may err,
 *
 *     max_i |x_ik s^k|/max(1, |y_i|) 2^-52 <= eps   for k > m,
 *     max_i |X_im - x_im| s^m/max(1, |y_i|) <= 4 eps:
 *
 * what doubles have really lost there, where terms of the equations cancel.
 * What then is left of rounding is of the size of the series' own error, which is no longer
 * held above 10^-17: eps = tol^(5/4).
 *
 * Tests  tests/ode/test_leading.c
 */
#ifndef QDOT_ODE_LEADING_H
#define QDOT_ODE_LEADING_H

#include <stdbool.h>

#include "ode/run.h"

/* For tolerances up to this one: what a double holds is no longer enough. */
#define QDOT_ODE_LEADING_TOL 1.0001e-14

/* Whether `system` has it, for a run under tol by a method with series. */
bool qdot_ode_has_leading(const qdot_ode_system *system, const qdot_ode_method *method,
                          double tol);

/* A step from `at` by h + h_low, order p, whose series x of system->series, in that unit, is
 * there. eps: what it may err by. */
typedef struct {
    const qdot_ode_system *system;
    qdot_ode_place at;
    double h, h_low, unit, eps;
    const double *scale; /* [n] 1/max(1, |y|) */
    int p;
} qdot_ode_leading_step;

/* Find the first orders, and replace next, next_carry [n], the end of the step in doubles,
 * by it in two, but for what system->following has. Failures as those of its find. */
QDOT_MUST_CHECK qdot_status qdot_ode_leading_advance(const qdot_ode_leading_step *step,
                                                     double *next, double *next_carry);

/* The state y [n] at t in a step of h from `at`, expanded to order p under tol by
 * qdot_ode_taylor_expand. What follows is left as the series has it. Failures as above,
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ode_leading_read(const qdot_ode_system *system, int p,
                                                  double tol, const qdot_ode_place *at,
                                                  double h, double t, double *y);

#endif
