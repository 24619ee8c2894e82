/* chart-formulas.h -- the groups of chart.h by their formulas.
 *
 * Tests  tests/mech/test_chart.c
 */
#ifndef QDOT_MECH_CHART_FORMULAS_H
#define QDOT_MECH_CHART_FORMULAS_H

#include "mech/study/chart.h"

/* How many coordinates the group has. */
size_t qdot_chart_size(qdot_chart_kind kind);

/* What is 0 at its singular place, in the coordinates given. */
qdot_expr qdot_chart_distance(const qdot_scene *s, const qdot_chart_group *g);

/* Put the group into the chart: its new coordinates, what it is made of, its constraints. `sign`:
 * of its distance at the start. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_chart_add(qdot_chart *c, const qdot_chart_group *g, int sign);

#endif
