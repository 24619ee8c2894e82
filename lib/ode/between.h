/* between.h -- a polynomial through a short step.
 *
 * A method of low order under a tight tolerance takes steps so short that the state between their ends
 * y0, y1 is known from few values: with x = (t - t0)/h the polynomial of degree 5 that has y and y' at
 * both ends and in the middle, where the partner of the method comes by half the step,
 *
 *     y(x) = y0 + sum_j P_j x^j,   j = 1 ... 5.
 *
 * It counts where the one of degree 4 without the slope in the middle differs from it by less than
 * four tolerances, of which it errs by a small part. Such a step is read, however often, for the price of that
 * half step and two evaluations; by steps of the partner each time for one of these.
 *
 * Tests  tests/ode/test_trajectory.c
 */
#ifndef QDOT_ODE_BETWEEN_H
#define QDOT_ODE_BETWEEN_H

#include "ode/stepper.h"

enum { QDOT_BETWEEN_DEGREE = 5 };

/* Whether steps of the method can be interpolated: its order is at most that of the polynomial. */
static inline bool
qdot_between_fits(const qdot_ode_method *method)
{
    return !method->kernel && method->order <= QDOT_BETWEEN_DEGREE + 1;
}

typedef struct {
    double *P; /* [(DEGREE + 1) x n] coefficients of the polynomial, then scratch [n]; allocated at first use */
    bool known, good; /* the polynomial was computed for the present step; and is accurate enough */
} qdot_between;

/* The state y [n] at the part x of the step from where `s`, of the partner, was started at t0, to y1 at
 * t0 + h; *done: else it was not found. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_between_read(qdot_between *b, qdot_ode_stepper *s, double t0,
                                              double h, const double *y1, double x, double *y,
                                              bool *done);

#endif
