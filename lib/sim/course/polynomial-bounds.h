/* polynomial-bounds.h -- how far an expression may be from the polynomial through its values at a
 * few points of a stretch of time.
 *
 * Through its values at the n zeros of T_n on a ... b an analytic g has a polynomial p with
 *
 *     |g - p| <= 4 M rho^(1-n) / (rho - 1),   |g - g_c| <= M on the ellipse of rho,
 *
 * foci a and b, half axes adding up to rho (b - a)/2. M comes of the tape over discs
 * (tape/disc.h): those of its inputs - states, accelerations, multipliers - are had from
 * their own Chebyshev polynomials through the same points, t is known. So nothing hides
 * between the points that is larger than what this says, as far as the inputs are what
 * their polynomials are: steps are short enough for that, or the bound is infinite.
 *
 * Where discs have no bound - beyond what doubles hold, at switches - the same tape over intervals of
 * the real line (tape/interval.h) may have one of the values on a ... b.
 *
 * Source  Trefethen, Approximation Theory and Approximation Practice (2013), theorem 8.2,
 *         with 4 for the zeros of T_n (Mason & Handscomb 6.3: aliasing of those).
 * Tests   tests/script/narrow.lag
 */
#ifndef QDOT_SIM_POLYNOMIAL_BOUNDS_H
#define QDOT_SIM_POLYNOMIAL_BOUNDS_H

#include <stdbool.h>

#include "num/chebyshev.h"
#include "tape/interval.h"

typedef struct {
    const qdot_tape *tape; /* borrowed */
    size_t n_used, *used;  /* [n_used] inputs that it reads, but for t */
    size_t time;           /* the input that is t, */
    bool reads_time;       /* and whether it is read */
    bool resting;          /* nothing that is read changes by more than rounding on the stretch */
    double *values;        /* [n_used x QDOT_CHEBYSHEV_MOST] by node */
    double *fits;          /* likewise: coefficients */
    double *scale;         /* [n_used] the largest value in this step */
    double *centre, *radius;   /* [inputs] */
    double *out, *out_radius;  /* [outputs] of the last evaluation */
    double *miss;              /* [outputs] what _look found */
    double *work;
    qdot_interval *span, *box; /* [inputs] on the stretch; [outputs] what _enclose found */
    qdot_interval *span_work;
} qdot_polynomial_bounds;

/* For a tape whose input `time` is t. QDOT_ENOMEM; clear it in any case. */
QDOT_MUST_CHECK qdot_status qdot_polynomial_bounds_init(qdot_polynomial_bounds *h,
                                                        const qdot_tape *tape,
                                                        size_t time);
void qdot_polynomial_bounds_clear(qdot_polynomial_bounds *h);

/* A step begins: what rounding is depends on how large the inputs are in it. */
void qdot_polynomial_bounds_begin(qdot_polynomial_bounds *h);

/* The inputs [..] at node j of the stretch that is to be looked at. */
void qdot_polynomial_bounds_sample(qdot_polynomial_bounds *h, int j, const double *in);

/* All `nodes` of a ... b are there. h->miss [outputs]: how far the polynomials are from the
 * outputs at most; NaN: something there is not analytic.
 *   base  NULL, or [outputs] numbers: of (f - base)(b - a)/(t - a), f(a) being base, for those
 *         `quotients` [outputs] names */
void qdot_polynomial_bounds_look(qdot_polynomial_bounds *h, double a, double b, int nodes,
                                 const bool *quotients, const double *base);

/* Whether output i has a singularity within the part, or switches there, and the part is so small a
 * `part` of the step, or its inputs change so little on it, that a polynomial through its values is taken for the function: sin(x)/x, a
 * bound of which near 0 its formula does not give. */
bool qdot_polynomial_bounds_is_hollow(const qdot_polynomial_bounds *h, size_t i,
                                      double part);

/* Where a part is cut whose formula may be singular in its middle. */
#define QDOT_POLYNOMIAL_BOUNDS_BESIDE 0.4867

/* After _look: what rounding of the inputs makes of output 0 in the middle of the stretch, at most;
 * 0 where it is singular. */
double qdot_polynomial_bounds_rounding(qdot_polynomial_bounds *h, double a, double b);

/* After _look: whether the inputs are known, and then h->out -+ h->out_radius hold the outputs on
 * a ... b. */
bool qdot_polynomial_bounds_within(qdot_polynomial_bounds *h, double a, double b,
                                   int nodes);

/* All `nodes` of a ... b are there. h->box [outputs] hold the outputs on a ... b where they are
 * defined; infinite where no bound is known. */
void qdot_polynomial_bounds_enclose(qdot_polynomial_bounds *h, double a, double b,
                                    int nodes);

/* h->out -+ h->out_radius hold the outputs where each input i but t lies in centre -+ radius, which
 * stand in h->centre, h->radius, and t in a ... b. */
void qdot_polynomial_bounds_span(qdot_polynomial_bounds *h, double a, double b);

#endif
