/* solid.h -- the solid of uniform density that has the mass and the moments of a body.
 *
 *     disc       I = m r^2/2
 *     rectangle  I = m (a^2 + b^2)/3        a, b half its sides
 *     ellipsoid  A = m (b^2 + c^2)/5 ...    a, b, c its half axes: a^2 = 5 (B + C - A)/(2 m)
 *
 * Tests  tests/lang/figures/test_solid.c
 */
#ifndef QDOT_LANG_SOLID_H
#define QDOT_LANG_SOLID_H

#include <stddef.h>

#include "show/animation.h"

/* In the plane: a disc, unless something is fastened at one of the places arms [n][2] (in the body,
 * from its centre). Then a rectangle with its length towards the farthest, and just as long if its
 * moment allows that; a disc again if that place is on its rim. */
void qdot_solid_plane(double mass, double inertia, const double (*arms)[2], size_t n,
                      qdot_animation_body *b);

/* Find the solid of a body in space from its mass and inertia [9] about its centre, a symmetric matrix. */
void qdot_solid_space(double mass, const double inertia[9], qdot_animation_body *b);

#endif
