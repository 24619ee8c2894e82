/* stretches.h -- divides a range of several courses at the points of all.
 *
 * Within a stretch each course is on one step of one piece. Where not all courses are known, the
 * range is cut. A range of no length is one stretch for each piece that begins or ends there.
 *
 * Tests  tests/script/sweeps/several-ranges.lag
 */
#ifndef QDOT_SIM_STRETCHES_H
#define QDOT_SIM_STRETCHES_H

#include "sim/course/course.h"

typedef struct {
    size_t n;
    const qdot_course *const *courses; /* [n] the stored runs (courses); borrowed */
    double from, to;
    qdot_vec(double) times; /* times at which the intervals begin and end, ascending */
    size_t next;
    double a, b;    /* the present interval a ... b, in the direction of the time range */
    bool odd[2];    /* at a, at b: the equations of some run switch while its state is continuous */
    size_t *pieces; /* [n] for each run, the index of the piece that contains the interval */
} qdot_stretches;

/* Prepare to go through the intervals between stored points in from ... to. QDOT_ENOMEM; clear s in any case. */
QDOT_MUST_CHECK qdot_status qdot_stretches_init(qdot_stretches *s, size_t n,
                                                const qdot_course *const *courses,
                                                double from, double to);
void qdot_stretches_clear(qdot_stretches *s);

/* Go to the first interval between stored points, or to the next one; false if none is left. */
bool qdot_stretches_next(qdot_stretches *s);

#endif
