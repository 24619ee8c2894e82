/* distance.h -- how far an expression of a run is off at a time, by two companions.
 *
 * With g along the run y and its companions y*_1, y*_2 (ode/companion.h),
 *
 *     d(t) = max_k |g(y(t)) - g(y*_k(t))|
 *     c(t) = max(|g(y*_1(t)) - g(y*_2(t))|, share d(t)),   share = 4 tol* / tol in [1/32, 1]
 *
 * is what is seen and what the companions themselves may be off by. All of these pass
 * through zero as g turns; so at one time they may be small by chance, and
 *
 *     error = bound(d(t), max c(s) over s in W),   W = W_- or W_+, where that is less
 *
 * (qdot_companion_bound)
 *
 * W_- and W_+ hold t and stored points of its piece before and after it, until the path of
 * the state, each component in units of its span over the run, has turned by 1/2: a
 * twelfth of a period of what oscillates. At most QDOT_DISTANCE_POINTS; one that a
 * neighbouring piece cuts short does not count where the other is whole.
 *
 * Tests  tests/script/inner-times.sh
 */
#ifndef QDOT_SIM_DISTANCE_H
#define QDOT_SIM_DISTANCE_H

#include "sim/course/reader.h"
#include "sim/course/report.h"

enum { QDOT_DISTANCE_POINTS = 24 };

typedef struct qdot_distance qdot_distance;

/* Of expressions [m], borrowed like the run, which must have its companion. Errors:
 * QDOT_ENOMEM, QDOT_EDOMAIN. */
QDOT_MUST_CHECK qdot_status qdot_distance_new(qdot_run *run, const qdot_reading *of,
                                              qdot_distance **out);
void qdot_distance_free(qdot_distance *d);

/* The error at t into out [m], values [m] being g there; NaN where a companion has none at t. */
QDOT_MUST_CHECK qdot_status qdot_distance_at(qdot_distance *d, double t,
                                             const double *values, double *out);

#endif
