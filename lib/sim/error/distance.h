/* distance.h -- the error of an expression at a time of a run, from two companions.
 *
 * With g along the run y and its companions y*_1, y*_2 (ode/companion.h),
 *
 *     d(t) = |g(y(t)) - (2 g(y*_1(t)) + g(y*_2(t)))/3|
 *     c(t) = 2/3 max(|g(y*_1(t)) - g(y*_2(t))|, share d(t)),   share = 4 tol* / tol in [1/32, 1]
 *
 * are the distance from the middle of the companions and an estimate of their own error. Both pass through zero
 * as g oscillates; so at one time they may be small by chance, and
 *
 *     error = bound(d(t), max c(s) over s in W),   W = W_- or W_+, whichever gives less
 *
 * (qdot_companion_bound)
 *
 * W_- and W_+ contain t and the stored points of its piece before and after it, until the path of
 * the state, each component in units of its span over the run, has turned by 1/2: a twelfth of a
 * period of an oscillation. Left out is what has died out by t: c(s) k >= 3 points away that is (2 k)^3
 * times all that is nearer than the third; and what lies in a jump that one of them does a little before the
 * other: it is 32 times all that is nearer. At most QDOT_DISTANCE_POINTS; a window cut short by the end of the
 * piece is not used if the other is whole.
 *
 * Where that is far more than c(t) and than a small part of g(t), g may be singular at a stored point, as 1/y is at a bounce:
 * then c(s) is at most 2/3 |g(y(t) + y*_1(s) - y*_2(s)) - g(y(t))|, and alike for the share of d.
 *
 * Added is what oscillations that a stiff method has gone over may make of g (oscillations.h).
 *
 * Tests  tests/script/cases/inner-times.sh, tests/script/solve/value-poles.sh
 */
#ifndef QDOT_SIM_DISTANCE_H
#define QDOT_SIM_DISTANCE_H

#include "sim/course/reader.h"
#include "sim/course/report.h"

enum { QDOT_DISTANCE_POINTS = 24 };

typedef struct qdot_distance qdot_distance;

/* For expressions [m], borrowed like the run, which must have its companion. Errors:
 * QDOT_ENOMEM, QDOT_EDOMAIN. */
QDOT_MUST_CHECK qdot_status qdot_distance_new(qdot_run *run, const qdot_reading *of,
                                              qdot_distance **out);
void qdot_distance_free(qdot_distance *d);

/* The error at t into out [m]; values [m] are those of g there. NaN if a companion does not reach
 * t. */
QDOT_MUST_CHECK qdot_status qdot_distance_at(qdot_distance *d, double t,
                                             const double *values, double *out);

#endif
