/* in-chart.h -- expressions of the scene given, read along a run made in other coordinates.
 *
 * Tests  tests/script/constraints/charts.lag
 */
#ifndef QDOT_SIM_IN_CHART_H
#define QDOT_SIM_IN_CHART_H

#include "sim/run/chart-run.h"
#include "sim/run/run.h"

/* Expressions in the coordinates of the run; valid while signs (of distances, roots) and quarter turns are constant. */
typedef struct {
    qdot_run *run;
    size_t m;
    double t; /* a time for which the expressions are valid; so they are until the next change of the angles */
    qdot_expr *exprs;     /* [m] the expressions in the coordinates of the run */
    bool turns;           /* an expression contains an angle outside of sin and cos, or a sign */
    const int64_t *quarters; /* quarter turns from which the angles are counted; borrowed */
} qdot_in_chart;

/* Express exprs [m] for the stretch of time t. Start from {0}; errors: the pool's, of reading;
 * QDOT_EDOMAIN: one is beyond a root (mech/coordinates/chart.h). */
QDOT_MUST_CHECK qdot_status qdot_in_chart_express(qdot_in_chart *in, qdot_run *run,
                                                  size_t m, const qdot_expr *exprs,
                                                  double t);
/* Whether the expressions are valid at t, too: no change of the chart's angles lies between. */
bool qdot_in_chart_holds(const qdot_in_chart *in, double t);
void qdot_in_chart_clear(qdot_in_chart *in);

/* Evaluate expressions, with errors, that are written in the coordinates of the run itself. */
QDOT_MUST_CHECK qdot_status qdot_in_chart_values(qdot_run *run, size_t m, const qdot_expr *exprs,
                                                 const qdot_exact_times *times, double *values,
                                                 double *errors);

/* The end of the interval around `from` with constant chart, in the direction of `to`; `to` if nearer. */
double qdot_in_chart_end(const qdot_in_chart *in, double from, double to);

#endif
