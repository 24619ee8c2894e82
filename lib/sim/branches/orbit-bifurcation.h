/* orbit-bifurcation.h -- points of a curve of orbits at which it turns, crosses another, or at which multipliers pass
 * the unit circle: zeros of functions of the arclength s from a point before them.
 *
 *     fold               dp/ds
 *     crossing           the determinant (path.h), by a polynomial through places on both sides: the zero itself
 *                        is where corrections are singular
 *     period doubling    prod (mu_k + 1)
 *     torus              prod_{i<j} (mu_i mu_j - 1) over the multipliers that are not 1 by themselves
 *     krein collision    where h is conserved, multipliers come as mu, 1/mu: two pairs meet on the unit circle; by
 *                        halving, from what is beyond it
 *
 * Each is found by the fine runs and by the coarse ones (orbit-path.h): the difference is its error, with what is left of
 * the bracket. Directions at a crossing are those of bifurcation.h, second derivatives by differences of F'.
 *
 * Tests   tests/sim/branches/test_orbits.c
 */
#ifndef QDOT_SIM_ORBIT_BIFURCATION_H
#define QDOT_SIM_ORBIT_BIFURCATION_H

#include "sim/branches/bifurcation.h"
#include "sim/branches/orbit-path.h"

/* Locate a bifurcation of orbits; x is the qdot_orbit_path, passed as the finder's user pointer. */
QDOT_MUST_CHECK qdot_status qdot_orbit_bifurcation_find(void *x, const qdot_bifurcation_bracket *in,
                                                        qdot_bifurcation *out, double *other,
                                                        qdot_bifurcation_answer *answer);
/* The direction t [n + 1] of the curve of orbits that close after two turns only, at y, an orbit that is gone round twice,
 * a multiplier of which is -1 in one turn: what F_y has to 0 beside the tangent of its own curve. */
QDOT_MUST_CHECK qdot_status qdot_orbit_bifurcation_double(qdot_orbit_path *x, const double *y, double *t);

#endif
