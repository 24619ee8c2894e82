/* minimal.h -- rewrites a scene with holonomic constraints in minimal coordinates.
 *
 * The constraints are solved one after another, each after substituting the solutions before it:
 *
 *     c x + g = 0, c free of motion       x = -g/c
 *     s ((x - a)^2 + (y - b)^2 - l^2) = 0  x = a + l sin u, y = b - l cos u, u a new angle
 *     s ((x - a)^2 + (y - b)^2 + (z - c)^2 - l^2) = 0
 *                                         x = a + l sin u cos v, y = b + l sin u sin v,
 *                                         z = c - l cos u, two; z, of the three, that which
 *                                         starts nearest to the centre, far from the poles
 *
 * where c, s, l contain no coordinates, and a, b, c of a centre and g none of x, y, z. A velocity
 * constraint that is holonomic in disguise is F = F at the start, by its integral. There is
 * no such form with other constraints, velocity or acceleration constraints, or a generalized
 * force on a coordinate that would be eliminated.
 *
 * Tests  tests/script/studies/race.sh
 */
#ifndef QDOT_MECH_MINIMAL_H
#define QDOT_MECH_MINIMAL_H

#include "mech/scene/things.h"

typedef struct {
    qdot_scene *scene; /* the scene in minimal coordinates, owned; NULL: none found, see `reason` */
    char reason[160];
    size_t n;          /* number of coordinates of the given scene */
    qdot_expr *given;  /* [n] the given coordinates in terms of the new ones */
    size_t fresh;      /* number of new angles: the last coordinates of `scene` */
    qdot_expr *angle;  /* [fresh] the new angles in terms of the given coordinates */
} qdot_minimal;

/* Of an expression in coordinates and parameters at the start: about how large it is, and its exact
 * value, in which parameters may stand. */
typedef struct {
    double (*size)(qdot_expr e, void *user);
    qdot_expr (*value)(qdot_expr e, void *user);
    void *user;
} qdot_minimal_start;

/* Find minimal coordinates of the scene; that a scene has none is no error. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_minimal_make(qdot_scene *s, const qdot_minimal_start *start,
                                              qdot_minimal *minimal);
void qdot_minimal_clear(qdot_minimal *minimal);

#endif
