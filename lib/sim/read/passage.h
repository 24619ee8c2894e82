/* passage.h -- the extrema of an expression up to a singular place that is passed exactly.
 *
 * There e, in the coordinates given, jumps, or has a corner: from either side it is smooth up to
 * the place, but near it directions are rounding alone. With the sign s of the distance changed
 * beyond the place (mech/coordinates/chart.h) e is smooth through it. A polynomial through values on
 * both sides, none nearer than a tenth of the interval's half, is e up to the place.
 *
 * Tests  tests/script/constraints/charts.lag
 */
#ifndef QDOT_SIM_PASSAGE_H
#define QDOT_SIM_PASSAGE_H

#include "sim/read/in-chart.h"

typedef struct {
    double beyond; /* the interval that is covered reaches from the singularity to this time */
    double most, least, error;
} qdot_passage;

/* The extrema of e between the time of stretch k of a run in a chart, at which a place is passed,
 * and p->beyond, which is set: towards t, at most half way. before: of the stretch that ends there.
 * *found: whether there is such a polynomial; else the range is left as it is. Errors: of values. */
QDOT_MUST_CHECK qdot_status qdot_passage_extrema(qdot_run *run, qdot_expr e, size_t k, bool before,
                                                 double t, qdot_passage *p, bool *found);

/* The index of the stretch of angles that begins at t, if a singularity is passed there; SIZE_MAX: none. */
size_t qdot_passage_at(const qdot_run *run, double t);

#endif
