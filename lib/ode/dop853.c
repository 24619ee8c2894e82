/* dop853.c -- the method dop853: its stages, error estimate and interpolation, from sums of dop853.def. */
#include "ode/dop853.h"

#include <math.h>
#include <string.h>

#include "ode/scale.h"

enum { rows = 16, degree = 7 };

static double
ratio_of_errors(double e5, double e3)
{
    double size = sqrt(e5 * e5 + 0.01 * e3 * e3);

    if (!isfinite(size))
        return INFINITY;
    return size > 0 ? e5 * (e5 / size) : 0;
}

/* A term of a sum over the stages. A coefficient is not a double: what its rounding takes
 * away, the same part of every step, goes into `low`. Without it the end errors at tol
 * 1e-15 were two to eight times larger. */
#define TERM(j, a)                                                                       \
    sum += (a) * k[(j) * n + i];                                                         \
    low += (double)(a##L - (long double)(a)) * k[(j) * n + i];

/* Evaluate stage `row` of the method at the state y + h * (sum of the terms). */
#define EVALUATE(row, c, terms)                                                          \
    for (size_t i = 0; i < n; i++) {                                                     \
        double sum = -0.0, low = -0.0;                                                   \
                                                                                         \
        terms trial[i] = y[i] + (carry[i] + h * (sum + low));                            \
    }                                                                                    \
    QDOT_TRY(qdot_ode_stepper_rhs(s, t + (c) * h, trial, k + (row) * n));

/* Compute the increment, into s->z, and the new state, into s->trial, from the stages k_0 ... k_11; returns its error ratio. */
static double
finish_step(qdot_ode_stepper *s, double h)
{
    const size_t n = s->system->n;
    const double *k = s->stages, *y = s->y, unit = fabs(h) / s->tol;
    double *restrict trial = s->trial, *restrict z = s->z, e5 = 0, e3 = 0;

    for (size_t i = 0; i < n; i++) {
        double sum = -0.0, low = -0.0, size;
#define A(j, a) TERM(j, a)
#define WEIGHTS(terms) terms
#include "ode/dop853.def"
#define A(j, a) +(a) * k[(j) * n + i]
#define ERROR5(terms) double fifth = fabs(terms) * unit;
#define THIRD(terms) double third = fabs(sum - (terms)) * unit;
#include "ode/dop853.def"

        z[i] = h * (sum + low);
        trial[i] = y[i] + (s->carry[i] + z[i]);
        if (!isfinite(trial[i]))
            return INFINITY;
        size = qdot_ode_size(s->system->scales, i, fmax(fabs(y[i]), fabs(trial[i])));
        fifth /= size;
        third /= size;
        if (!(fifth <= e5))
            e5 = fifth;
        if (!(third <= e3))
            e3 = third;
    }
    return ratio_of_errors(e5, e3);
}

static qdot_status
dop853_step(qdot_ode_stepper *s, double t, double h, double *ratio)
{
    const size_t n = s->system->n;
    const double *y = s->y, *carry = s->carry;
    double *restrict trial = s->trial, *k = s->stages;

    memcpy(k, s->dydt, n * sizeof *k);
#define A(j, a) TERM(j, a)
#define STAGE(row, c, terms) EVALUATE(row, c, terms)
#include "ode/dop853.def"

    *ratio = finish_step(s, h);
    return QDOT_OK;
}

static qdot_status
prepare_interpolation(qdot_ode_stepper *s, double t, double h, double *F)
{
    const size_t n = s->system->n;
    const double *y = s->y, *carry = s->carry;
    double *restrict trial = s->trial, *k = s->stages;

    memcpy(k + 12 * n, s->trial_dydt, n * sizeof *k);
#define A(j, a) TERM(j, a)
#define DENSE_STAGE(row, c, terms) EVALUATE(row, c, terms)
#include "ode/dop853.def"

    for (size_t i = 0; i < n; i++) {
        F[i] = s->z[i];
        F[n + i] = h * k[i] - s->z[i];
        F[2 * n + i] = 2 * s->z[i] - h * (k[i] + k[12 * n + i]);
#define A(j, a) +(a) * k[(j) * n + i]
#define DENSE(p, terms) F[(p) * n + i] = h * (terms);
#include "ode/dop853.def"
    }
    return QDOT_OK;
}

static void
interpolate_state(size_t n, const double *F, const double *y0, double x, double *y)
{
    for (size_t i = 0; i < n; i++) {
        double p = F[6 * n + i] * x;

        for (size_t row = 6; row-- > 0;)
            p = (p + F[row * n + i]) * (row % 2 ? 1 - x : x);
        y[i] = y0[i] + p;
    }
}

const qdot_ode_kernel qdot_dop853 = {
    .stages = rows, .powers = degree, .step = dop853_step, .dense = prepare_interpolation, .at = interpolate_state};
