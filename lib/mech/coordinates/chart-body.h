/* chart-body.h -- bodies by the four parameters of Euler, e with |e|^2 = 1, as masses.
 *
 * Tests  tests/mech/coordinates/test_chart.c
 */
#ifndef QDOT_MECH_CHART_BODY_H
#define QDOT_MECH_CHART_BODY_H

#include "mech/scene/things.h"

/* Find the rotation matrix R(e), row by row: quadratic in the quaternion e [4], a rotation for |e| = 1. */
void qdot_chart_body_axes(qdot_pool *pool, const qdot_expr *e, qdot_expr *R);

/* Whether the rotation of some body is Rz Rx Rz (Euler angles) of the three coordinates index [3]. */
bool qdot_chart_body_fits(const qdot_scene *s, const size_t *index);

/* In `to`, a copy of s, replace the bodies whose axes are `rotation` by masses at their centre and
 * at the columns of R [9]; gravity becomes a potential of the bodies given. `why` [size] if a
 * force or torque acts on the material of one. Errors: of the scene. */
QDOT_MUST_CHECK qdot_status qdot_chart_body_replace(const qdot_scene *s, qdot_scene *to,
                                                    qdot_expr rotation,
                                                    const qdot_expr *R, char *why,
                                                    size_t size);

#endif
