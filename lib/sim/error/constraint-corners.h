/* constraint-corners.h -- cusps of constraints, from which the equations of motion say nothing.
 *
 * At a cusp, as of y^2 = x^3 at 0, the slopes of a constraint vanish and the curve turns back. Steps
 * in doubles come out of it one way or another, off the constraint by what counts as 0. Where a
 * curve crosses itself the slopes vanish too, but the motion goes straight on, and so does the
 * series.
 *
 * Between the points of a run at which a row of A has shrunk least about a minimum, its direction
 * of motion is compared: a corner is passed at full speed, while a motion that only comes near such a
 * place and turns round stands still there.
 *
 * Tests  tests/script/events/passed-over.lag
 */
#ifndef QDOT_SIM_CONSTRAINT_CORNERS_H
#define QDOT_SIM_CONSTRAINT_CORNERS_H

#include "sim/course/course.h"

/* The first corner that the run went over: *found, its time *t and its constraint *row. Errors:
 * QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_constraint_corners_find(const qdot_course *course, bool *found,
                                                         double *t, size_t *row);

#endif
