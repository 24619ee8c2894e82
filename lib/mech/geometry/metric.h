/* metric.h -- the line element ds^2 = sum g_ij dq_i dq_j of a place, g_ij = dr/dq_i . dr/dq_j.
 *
 * R is a position r(q, t) (VEC or scalar) or a quadratic form in dq. Nil on failure; the pool keeps the cause.
 *
 * Tests  tests/mech/dynamics/test_scenes.c, tests/mech/geometry/test_geometry.c
 */
#ifndef QDOT_MECH_METRIC_H
#define QDOT_MECH_METRIC_H

#include "mech/scene/things.h"

qdot_expr qdot_mech_ds2(qdot_scene *s, qdot_expr R); /* line element ds^2, in terms of dq and dt */
qdot_expr qdot_mech_speed2(qdot_scene *s, qdot_expr R); /* (ds/dt)^2, in q' */
qdot_expr qdot_mech_metric(qdot_scene *s, qdot_expr R); /* g_ij as a MAT over the coordinates of R */
/* The coordinates of a metric as a LIST, in declared order: those in R, or whose differentials are in R; t comes
 * first where dt is in R. */
qdot_expr qdot_mech_metric_coordinates(qdot_scene *s, qdot_expr R);

#endif
