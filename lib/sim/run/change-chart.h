/* change-chart.h -- a run once more in other coordinates, where those given became singular.
 *
 * A run that failed, that began at a singular place, whose error is unknown, or that rounding held
 * far above its tolerance, is made anew in the coordinates of mech/coordinates/chart.h, if it came near a
 * singular place of coordinates that can be replaced. The new one takes its place if it arrives,
 * with a smaller error.
 *
 * Tests  tests/script/constraints/charts.lag
 */
#ifndef QDOT_SIM_CHANGE_CHART_H
#define QDOT_SIM_CHANGE_CHART_H

#include "sim/run/change-over.h"

/* Replace *run (NULL: it could not begin, with `began`), and say so in a notice. Returns `began`
 * where nothing was replaced, with the error as it was. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_run_change_chart(qdot_scene *scene,
                                                  const qdot_run_request *request,
                                                  const qdot_run_maker *by,
                                                  qdot_status began, qdot_run **run);

#endif
