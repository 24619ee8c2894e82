/* unresolved-forces.h -- finds forces that act for less than a step, so that the run missed them.
 *
 * The length of a step depends on the equations at its start. A force like exp(-10^6 (t - 3)^2),
 * or that of a thin wall, is negligible there with all its derivatives: the step passes over it,
 * and so may those of a companion. Steps by series check the arguments of exponentials and what
 * is divided by (series/near.h); other methods do not. If there are such functions (tape/disc.h),
 * and their argument, or the logarithm of a divisor, may change by 10 or more in a step, the outputs
 * of the plan's tape are sampled at 16 or 64 points of the step, and discs
 * (sim/course/polynomial-bounds.h) bound them between; if the bound is too large the step is split.
 * The difference between the parts and the polynomial of the whole step, summed up, is what the
 * step missed.
 *
 * Tests  tests/script/hidden-forces.lag
 */
#ifndef QDOT_SIM_UNRESOLVED_FORCES_H
#define QDOT_SIM_UNRESOLVED_FORCES_H

#include "sim/course/course.h"

/* Whether a step missed a force, by more than ten tolerances of the integral of its size over the
 * step, and more than a hundredth of the tolerance; *t: about where. Stiff methods are not
 * checked: their steps may pass over what has died out. Errors: QDOT_ENOMEM, QDOT_EINTR; states
 * that cannot be read are skipped. */
QDOT_MUST_CHECK qdot_status qdot_unresolved_forces_find(const qdot_course *course,
                                                        bool *found, double *t);

#endif
