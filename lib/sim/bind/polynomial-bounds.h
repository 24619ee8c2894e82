/* polynomial-bounds.h -- bounds for the distance of an expression from the polynomial through its
 * values at a few points of a stretch of time.
 *
 * Through its values at the n zeros of T_n on a ... b an analytic g has a polynomial p with
 *
 *     |g - p| <= 4 M rho^(1-n) / (rho - 1),   |g - g_c| <= M on the ellipse of rho,
 *
 * with foci a and b and half axes that add up to rho (b - a)/2. M is found by evaluating the tape
 * over discs (tape/disc.h). The discs of its inputs - states, accelerations, multipliers - follow
 * from their own Chebyshev polynomials through the same points; t is known. So the bound holds as
 * far as the inputs equal their polynomials: steps are short enough for that, or the bound is
 * infinite.
 *
 * If discs give no bound (overflow, switches), the same tape over intervals of the real line
 * (tape/interval.h) may bound the values on a ... b.
 *
 * Source  Trefethen, Approximation Theory and Approximation Practice (2013), theorem 8.2,
 *         with 4 for the zeros of T_n (Mason & Handscomb 6.3: aliasing of those).
 * Tests   tests/script/prove/narrow.lag
 */
#ifndef QDOT_SIM_POLYNOMIAL_BOUNDS_H
#define QDOT_SIM_POLYNOMIAL_BOUNDS_H

#include <stdbool.h>

#include "num/chebyshev.h"
#include "ode/run.h"
#include "tape/interval.h"

typedef struct {
    const qdot_tape *tape; /* the functions whose bounds are sought; borrowed */
    size_t n_used, *used;  /* [n_used] inputs that the tape reads, except t */
    size_t time;           /* index of the input t */
    bool reads_time;       /* whether the tape reads t */
    bool resting;          /* no input that is read changes by more than rounding on the stretch
                               */
    double *values;        /* [n_used x QDOT_CHEBYSHEV_MOST] values of the inputs at the nodes */
    double *fits;          /* [n_used x QDOT_CHEBYSHEV_MOST] Chebyshev coefficients of the inputs */
    double *scale;         /* [n_used] largest value of each input in this step */
    double *centre, *radius;   /* [inputs] discs that contain each input */
    double *out, *out_radius;  /* [outputs] values and error radii of the outputs, of the last evaluation */
    double *miss; /* [outputs] bounds of |output - its interpolating polynomial|, set by qdot_polynomial_bounds_look */
    double *work;
    qdot_interval *span, *box; /* [inputs] on the stretch; [outputs] intervals found by _enclose
                                   */
    qdot_interval *span_work;
} qdot_polynomial_bounds;

/* Prepare bounds for a tape whose input number `time` is t. QDOT_ENOMEM; clear h in any case. */
QDOT_MUST_CHECK qdot_status qdot_polynomial_bounds_init(qdot_polynomial_bounds *h,
                                                        const qdot_tape *tape,
                                                        size_t time);
void qdot_polynomial_bounds_clear(qdot_polynomial_bounds *h);

/* Begin a step: the size of the inputs in it, at least least [inputs] (NULL: 0), decides how large rounding
 * is. */
void qdot_polynomial_bounds_begin(qdot_polynomial_bounds *h, const double *least);

/* Store the inputs at Chebyshev node j of the next time interval. */
void qdot_polynomial_bounds_sample(qdot_polynomial_bounds *h, int j, const double *in);

/* After all `nodes` of a ... b are stored: h->miss [outputs] bounds the distance of each output
 * from its polynomial; NaN: it is not analytic there.
 *   base  NULL, or [outputs] f(a): outputs marked in `quotients` [outputs] are taken as
 *         (f - base)(b - a)/(t - a) */
void qdot_polynomial_bounds_look(qdot_polynomial_bounds *h, double a, double b, int nodes,
                                 const bool *quotients, const double *base);

/* Whether output i has no bound on the stretch (a singularity or switch) but its polynomial is
 * taken for it, because the stretch is so small a `part` of the step, or its inputs change so
 * little: the formula sin(x)/x gives no bound near 0. */
bool qdot_polynomial_bounds_is_hollow(const qdot_polynomial_bounds *h, size_t i,
                                      double part);

/* The fraction at which an interval is cut, if its middle (0.5) may be a singular point of the formula. */
#define QDOT_POLYNOMIAL_BOUNDS_BESIDE 0.4867

/* After _look: a bound for the effect of rounding of the inputs on output 0 in the middle of the
 * stretch; 0 if it is singular there. */
double qdot_polynomial_bounds_rounding(qdot_polynomial_bounds *h, double a, double b);

/* After _look: whether the inputs are bounded; then h->out -+ h->out_radius contain the outputs
 * on a ... b. */
bool qdot_polynomial_bounds_within(qdot_polynomial_bounds *h, double a, double b,
                                   int nodes);

/* After all `nodes` of a ... b are stored: h->box [outputs] contain the outputs on a ... b where
 * they are defined; infinite if no bound is known. */
void qdot_polynomial_bounds_enclose(qdot_polynomial_bounds *h, double a, double b,
                                    int nodes);

/* h->out -+ h->out_radius contain the outputs if each input i except t lies in h->centre[i] -+
 * h->radius[i] and t in a ... b. */
void qdot_polynomial_bounds_span(qdot_polynomial_bounds *h, double a, double b);

/* h->out -+ h->out_radius contain the outputs for the states of a step, from the series that was computed
 * for it: each term lies between 0 and its value at the end. */
void qdot_polynomial_bounds_series(qdot_polynomial_bounds *h, const qdot_ode_series *series,
                                   const qdot_ode_expanded *step);
/* Compute intervals of the outputs for the same inputs, into h->box. */
void qdot_polynomial_bounds_box(qdot_polynomial_bounds *h);

#endif
