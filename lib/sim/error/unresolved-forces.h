/* unresolved-forces.h -- forces that act within less than a step, which no step has seen.
 *
 * A step is chosen by what its equations are where it begins. A force like
 * exp(-10^6 (t - 3)^2), or that of a wall as thin, is nothing there, and its series and differences
 * neither: the step goes over it, and so may those of a companion. Steps by series know the
 * arguments of exponentials and do not; others do. Only functions that fall off like an
 * exponential hide so; where there are any (tape/disc.h), and a step is so long that the
 * argument of one goes over 10 or more, the outputs of the plan's tape are looked at along
 * the run, between 16 or 64 points of each step by discs (sim/course/polynomial-bounds.h), part by part where
 * these leave something open. What a part shows beyond the
 * polynomial through the points of the whole step, summed up, is what the step did not see.
 *
 * Tests  tests/script/hidden-forces.lag
 */
#ifndef QDOT_SIM_UNRESOLVED_FORCES_H
#define QDOT_SIM_UNRESOLVED_FORCES_H

#include "sim/course/course.h"

/* Whether a step went over a force, by more than ten tolerances of the largest force and the
 * step, and more than a hundredth of the tolerance; *t: about where. Not of stiff methods,
 * whose steps may go over what has died out.
 * Errors: QDOT_ENOMEM, QDOT_EINTR; what cannot be read shows nothing. */
QDOT_MUST_CHECK qdot_status qdot_unresolved_forces_find(const qdot_course *course,
                                                        bool *found, double *t);

#endif
