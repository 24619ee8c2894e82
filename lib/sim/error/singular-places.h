/* singular-places.h -- finds places passed by a run where the constraints depend on each other.
 *
 * Let q(t) be the least sine between a row of the constraints and those before it. It is
 * evaluated at the stored points, and within the steps if these are few. About a point where it
 * is a quarter or more below its neighbours golden sections find the minimum on states read
 * between the points. A minimum below 1e-5, or below a hundred tolerances, is reported: because
 * of its error the run passes such a place at some distance.
 *
 * Tests  tests/script/rests/flat-places.lag
 */
#ifndef QDOT_SIM_SINGULAR_PLACES_H
#define QDOT_SIM_SINGULAR_PLACES_H

#include "base/text.h"
#include "sim/course/course.h"

/* Append "constraints a and b stop being independent about t = 1.5 and 2.5; the run goes over it,
 * at the accuracy left there", a line for every set of constraints, or nothing. Errors:
 * QDOT_ENOMEM, QDOT_EINTR; those of reading the run. */
QDOT_MUST_CHECK qdot_status qdot_singular_places_tell(const qdot_course *course,
                                                      qdot_text *to);

#endif
