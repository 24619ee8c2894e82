/* near.h -- how far a step may carry the argument of an exponential, or a denominator.
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
 * A quotient, too, may be nothing where a step begins and all there is where its denominator
 * comes near 0: w/(t^2 + w^2) of w = 1e-12 from t = -1. The series b(s) of what is divided by, or
 * of which a root, a power or a logarithm is taken, does show it: it is a parabola. A step ends
 * where b has fallen to QDOT_NEAR_LEFT of b_0, and again behind; the last steps are as short as the
 * quotient's own coefficients, seen by then, say. A quotient whose series converges at the end of
 * the step hides nothing, and a step that an order is chosen for ends before b falls so far.
 *
 * A table of data (num/samples.h) is a polynomial in pieces: a step ends where its argument u(s) passes a knot.
 *
 * Tests  tests/series/test_near.c, tests/script/events/far-away.lag, tests/script/contacts/narrow-forces.lag
 */
#ifndef QDOT_SERIES_NEAR_H
#define QDOT_SERIES_NEAR_H

#include <stdbool.h>

/* The threshold E above, without the digits of the numbers themselves: 20 more, in powers of e. */
#define QDOT_NEAR_BEYOND 20.0

/* The sum of |x_k| s^k over k >= 1 of a series with coefficients x [p + 1]. */
double qdot_near_sum(int p, const double *x, double s);

/* The largest change of u within a step, if u, with coefficient u_0, is the argument of an exponential. */
double qdot_near_limit(int p, double u0, double digits);

/* log2 of the longest step, at most log2_h (INFINITY: any), whose sum over the sizes, log2 |u_k|
 * at [1 ... p], is within the limit. */
double qdot_near_log2(int p, const double *log2_sizes, double limit, double log2_h);

/* So that the argument u [p + 1] of an exponential of doubles, so many times, is not carried too far:
 * as much of a step of s. */
double qdot_near_argument(int p, const double *u, double times, double s);

#define QDOT_NEAR_LEFT 0.125

/* Whether b [p + 1] may fall so far in a step of s, by the sizes of its terms alone: |b_0| and the sum
 * of the others. */
static inline bool
qdot_near_sizes_may_fall(double size, double sum)
{
    return size > 0 && !(sum <= (1 - QDOT_NEAR_LEFT) * size);
}
bool qdot_near_may_fall(int p, const double *b, double s);

/* Then as much of the step (INFINITY: any) as it does not fall so far in. Of a `root` of b all, if
 * b is negative there: what is undefined needs no search. */
double qdot_near_divisor(int p, const double *b, bool root, double s);

/* The length of a step, at most s, in which the argument u(s) = sum u_k s^k, k = 0 .. p, of a table of data goes from the piece
 * lo <= u < hi just into the next one: beyond the knot by more than the rounding error of u, so that the next step begins in
 * the next piece. s if u does not reach a knot within it. */
double qdot_near_knot(int p, const double *u, double lo, double hi, double s);

/* The shorter of two steps, the second of which is none below `least`. Exponentials are followed to
 * QDOT_NEAR_FINER of what divisors are: none of theirs hides a pole. */
static inline double
qdot_near_taken(double s, double near, double least)
{
    return near < least ? s : near < s ? near : s;
}
#define QDOT_NEAR_FINER 0x1p-20

/* Whether the series [p + 1] of a quotient has, at the end s of the step, terms as large as its first one. */
bool qdot_near_diverges(int p, const double *quotient, double s);

#endif
