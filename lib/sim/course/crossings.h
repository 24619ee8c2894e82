/* crossings.h -- the roots of a function along a course that is stored.
 *
 * Its steps are searched one by one as those of events are while a run is made (watch.h): no root is
 * missed. A motion that starts on a zero has none there.
 *
 * Tests  tests/script/studies/poincare.sh
 */
#ifndef QDOT_SIM_CROSSINGS_H
#define QDOT_SIM_CROSSINGS_H

#include "sim/course/course.h"

typedef struct {
    double t; /* first double at which the function has the new sign */
    double low; /* small correction: the root is at t + low */
    size_t piece;
    int way;  /* sign of the function's slope at the root: 1 rises, -1 falls, 0: it only touches 0 */
} qdot_crossing;

typedef qdot_vec(qdot_crossing) qdot_crossings;

/* Append the roots of g from limits[0] up to, but not at, limits[1], in the order of the course; an
 * end of the course is within. *lost: from then on they are not known, for g has decayed below the rounding of the
 * course or cannot be resolved; NaN: they all are. Errors: QDOT_EDOMAIN where g is undefined, those of reading,
 * QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_crossings_find(const qdot_course *c, qdot_expr g,
                                                const double *limits, qdot_crossings *out, double *lost);

#endif
