/* singular-places.h -- places that a run went over where constraints stop being independent.
 *
 * With q(t) the sine between a row of the constraints and those before it, the least of all
 * rows, the stored points are gone through, of few steps places within them too; about one
 * where it is least, by a quarter or more, the state is read between the points and q is
 * brought to its minimum by golden sections. It is told where that is below 1e-5, or a
 * hundred tolerances: a state carries its error past such a place, and meets it to no more.
 *
 * Tests  tests/script/flat-places.lag
 */
#ifndef QDOT_SIM_SINGULAR_PLACES_H
#define QDOT_SIM_SINGULAR_PLACES_H

#include "base/text.h"
#include "sim/course/course.h"

/* "constraints a and b stop being independent about t = 1.5 and 2.5; the run goes over it,
 * at the accuracy left there", a line for every set of constraints, or nothing. Errors:
 * QDOT_ENOMEM, QDOT_EINTR; those of reading the run. */
QDOT_MUST_CHECK qdot_status qdot_singular_places_tell(const qdot_course *course,
                                                      qdot_text *to);

#endif
