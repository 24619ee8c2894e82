/* circular.h -- rational functions of sin u and cos u, or of sinh u and cosh u, u = k x + const.
 *
 *     R odd in sin: over cos u;   odd in cos: over sin u;   R(-sin, -cos) = R: over T = tan u;
 *     any other R: over T = tan(u/2)
 *
 * and likewise for sinh, cosh, tanh. A primitive in T = tan v jumps where v passes an odd multiple of pi/2. It is
 * written without a jump:
 *
 *     log|p(T)| = log|p(T) cos^n v| - n log|cos v|,   n the degree of p,
 *     atan(a T + b) ~ v + atan((2ab cos 2v - K sin 2v)/((1 + a)^2 + b^2 + K cos 2v + 2ab sin 2v)),
 *
 * K = 1 - a^2 + b^2, a > 0, equal up to a constant between the jumps of the left side; the denominator is positive:
 * the two sides are arguments of z = cos v + i (a sin v + b cos v) = (A + B exp(-2iv)) exp(iv)/2 with A = 1 + a + ib,
 * B = 1 - a + ib and |A|^2 - |B|^2 = 4a > 0.
 *
 * Source  Jeffrey & Rich, ACM Trans. Math. Software 20 (1994) 124 (the need); Hardy (1916), VI.
 * Tests   tests/normal/integral/test_antiderivative.c
 */
#ifndef QDOT_INTEGRAL_CIRCULAR_H
#define QDOT_INTEGRAL_CIRCULAR_H

#include "normal/integral/rational.h"
#include "normal/integral/reading.h"

/* The antiderivative of what was read, whose generators are a sine and cosine of one angle; nil: it is of another kind,
 * or not found. */
qdot_expr qdot_circular_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x);

#endif
