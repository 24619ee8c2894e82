/* near.h -- how far a step may carry the argument of an exponential.
 *
 * e^u, tanh u and their like may be nothing where a step begins and all there is where it ends:
 * a Gaussian barrier, friction tanh(1000 v). Of e^-400 no coefficient is seen, so no series
 * shortens the step, and begin and end agree with the equations on both sides. So, with
 * u(s) = sum u_k s^k, a step of an expansion to order p goes no further than
 *
 *     sum_{k>=1} |u_k| s^k <= max((p + 1)/2, |u_0| - E),
 *
 * E being natural digits below which an exponential is nothing: the numbers' own and 20 more.
 * From far away it comes to where coefficients begin to be seen; there, by no more than what order
 * p follows e^u over. Of tanh, which is e^-2u off its limits, 2u is looked at.
 *
 * Tests  tests/series/test_near.c, tests/script/far-away.lag
 */
#ifndef QDOT_SERIES_NEAR_H
#define QDOT_SERIES_NEAR_H

/* E beyond the digits of the numbers. */
#define QDOT_NEAR_BEYOND 20.0

/* The bound above, u_0 being the argument of an exponential. */
double qdot_near_limit(int p, double u0, double digits);

/* log2 of the longest step, at most log2_h (INFINITY: any), whose sum over the sizes, log2 |u_k|
 * at [1 ... p], is within the limit. */
double qdot_near_log2(int p, const double *log2_sizes, double limit, double log2_h);

#endif
