/* trace.h -- points of a curve, dense enough that no corner is seen where there is none.
 *
 * A curve is (x, y) or (x, y, z) as a function of a parameter s. Segments are halved, round by
 * round, until at every point the next segment turns by less than 3.4 degrees as it is seen in
 * the figure, or both are shorter than 0.2 mm, or there are 20,001 points.
 *
 * Tests  tests/show/test_trace.c
 */
#ifndef QDOT_SHOW_TRACE_H
#define QDOT_SHOW_TRACE_H

#include "show/figure.h"

/* The function to trace: from s [n] it computes the components [axes * n], all values of one before
 * the next. */
typedef struct {
    size_t axes; /* number of components, 2 or 3 */
    qdot_status (*values)(void *user, size_t n, const double *s, double *values);
    void *user;
    bool jumps; /* interrupt the line where it jumps across the visible range */
} qdot_trace_source;

/* The points of the curve, in the order of s; all arrays [n], owned. */
typedef struct {
    size_t n;
    double *s, *at[3]; /* [n] parameter of the curve, and coordinates; at[2] is NULL for a plane curve */
} qdot_trace;

enum { QDOT_TRACE_MOST = 20001 };

/* Begin with the points at the parameter values s [n], which are copied. */
QDOT_MUST_CHECK qdot_status qdot_trace_begin(const qdot_trace_source *source, size_t n,
                                              const double *s, qdot_trace *points);
/* Add points to a sampled curve wherever the figure needs more to show it smooth. */
QDOT_MUST_CHECK qdot_status qdot_trace_refine(const qdot_trace_source *source,
                                               const qdot_figure_view *view,
                                               qdot_trace *points);
void qdot_trace_clear(qdot_trace *points);

#endif
