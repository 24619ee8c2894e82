/* pole.h -- curves that run to infinity, and the part of them that a figure shows.
 *
 * A curve with a pole, as tan(x), has values of any size near it, and its ends say nothing of the rest. What is shown
 * is the range q05..q95 in which nine tenths of the curve lie, by its parameter, and half of that range on both sides.
 *
 * Tests  tests/script/figures/poles.sh
 */
#ifndef QDOT_SHOW_POLE_H
#define QDOT_SHOW_POLE_H

#include "show/trace.h"

/* Find the part of the ordinate to show of a curve in the plane; shown->set is false if all of it is to be shown. A
 * value far beyond the rest belongs to a pole if it goes on growing where the curve is looked at ever closer; a narrow
 * peak does not. Errors: QDOT_ENOMEM, those of the source. */
QDOT_MUST_CHECK qdot_status qdot_pole_find(const qdot_trace_source *source, const qdot_trace *points,
                                           qdot_figure_range *shown);

#endif
