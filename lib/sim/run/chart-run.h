/* chart-run.h -- a run made in other coordinates (mech/coordinates/chart.h) and read in those given.
 *
 * An angle outside of sin and cos is continued along the run: it is followed from the start in
 * steps of less than 0.8, and counted from a number of quarter turns that stays the same over a
 * stretch of time, in which the angle is within 2.8 of it. So are the signs of distances, which
 * change where a singular place is passed exactly, and those of roots.
 *
 * Tests  tests/script/constraints/charts.lag
 */
#ifndef QDOT_SIM_CHART_RUN_H
#define QDOT_SIM_CHART_RUN_H

#include <stdint.h>

#include "mech/coordinates/chart.h"
#include "mech/coordinates/collision.h"
#include "sim/course/run-state.h"
#include "sim/run/change-over.h"

/* A time from which angles are counted from given numbers of quarter turns; signs of distances, roots are constant. */
typedef struct {
    double t;
    uint64_t passed; /* bits: the signs whose singular place is passed exactly at t */
    size_t quarters; /* index in qdot_run_chart.quarters of the first number of quarter turns; signs follow */
} qdot_chart_stretch;

typedef struct qdot_run_chart {
    qdot_chart chart;         /* its scene is that of the run, without a collision; else it may be one in
                                 which nothing is moved */
    qdot_collision collision; /* a regularised collision; if it has a scene, that is the scene of the run */
    qdot_expr energy;       /* energy in the given scene, which equals collision.energy; nil: none */
    size_t n;               /* number of coordinates of the given scene */
    qdot_expr *coordinates; /* [n] coordinates of the given scene */
    double *angles;         /* [moved] angles at the start, as given */
    double *end;   /* [2n] end state in the given coordinates; NaN: undefined there */
    bool at_place;         /* the run starts at a singular place */
    bool followed; /* `stretches` has been computed */
    bool crosses;  /* a square root w with w^2 = P passed a place where this surface crosses itself */
    bool changes;  /* the sign of a distance has changed at a singular place that was passed exactly */
    qdot_vec(qdot_chart_stretch) stretches; /* time intervals with constant signs and quarter turns, in the order of the run */
    qdot_vec(int64_t) quarters;
} qdot_run_chart;

void qdot_run_chart_free(qdot_run_chart *x);

/* An expression of the given scene written in the coordinates of the run (as qdot_chart_express). */
qdot_expr qdot_run_chart_express(const qdot_run_chart *x, qdot_expr e, const int64_t *quarters,
                                 bool *turns);

/* Follow the angles, and the signs of distances and roots, along the run, unless that was done before. */
QDOT_MUST_CHECK qdot_status qdot_run_chart_follow(qdot_run *run);

/* The quarters [moved], and the signs behind them, for the stretch of time t; follows the run if that was not done yet, and
 * limits the comparison with companions to the stretch. */
QDOT_MUST_CHECK qdot_status qdot_run_chart_quarters(qdot_run *run, double t,
                                                    const int64_t **quarters);

/* Limit the comparison with companion runs to the whole run, except for a start at a singularity. */
void qdot_run_chart_limit(qdot_run *run);

/* Put the end state in the given coordinates, with its error, into the report of a run made in others. */
QDOT_MUST_CHECK qdot_status qdot_run_chart_report(qdot_run *run,
                                                  const qdot_run_maker *by);

#endif
