/* chart-start.h -- converts the start state of a run to other coordinates. */
#ifndef QDOT_SIM_CHART_START_H
#define QDOT_SIM_CHART_START_H

#include "sim/model/request.h"
#include "sim/run/chart-run.h"

/* The value at the request's start of e, an expression in coordinates and velocities of s: an exact constant. */
qdot_expr qdot_chart_at_start(const qdot_scene *s, const qdot_run_request *request,
                              qdot_expr e);

/* Find the value of the expression e at the start, and its sign, 1 or -1. Errors: as qdot_constant_double. */
QDOT_MUST_CHECK qdot_status qdot_chart_start_sign(const qdot_scene *s,
                                            const qdot_run_request *request, qdot_expr e,
                                            int *sign, double *value);

/* The chart of these groups (qdot_chart_make) for a run of s: x->chart.scene NULL where there is
 * none. Free *out in any case. */
QDOT_MUST_CHECK qdot_status qdot_run_chart_new(qdot_scene *s,
                                               const qdot_run_request *request,
                                               const qdot_chart_groups *groups,
                                               const int *sign, bool open,
                                               qdot_run_chart **out);

/* The open chart of all its groups; with no groups x->chart.scene is NULL, and nothing is moved. Free
 * *out in any case. */
QDOT_MUST_CHECK qdot_status qdot_run_chart_open(qdot_scene *s,
                                                const qdot_run_request *request,
                                                qdot_run_chart **out);

#endif
