/* linear-motion.h -- the motion about an equilibrium, to first order. Internal to mech/.
 *
 * With q = q0 + x, x = N y in the tangent space of the constraints, which are holonomic or that in
 * disguise (qdot_mech_is_holonomic: then H is symmetric there whichever multiple of dF/dt they are),
 *
 *     M y'' + Gamma y' + H y = 0,   H = d(left - right)/dq at rest, multipliers held.
 *
 * The equation of a state, E = z' - a q' - b q - c z = 0, is of first order. With z = w + a q, which leaves no q' in
 * it, E' + E = 0 takes its place: so M stays regular and symmetric, and beside the roots s of the motion there is -1, once
 * for each state, which decides no stability.
 */
#ifndef QDOT_MECH_LINEAR_MOTION_H
#define QDOT_MECH_LINEAR_MOTION_H

#include "mech/scene/things.h"
#include "mech/linear/rest.h"
#include "normal/field/facts.h"

typedef struct {
    size_t n;
    qdot_expr *M, *Gamma, *H; /* [n x n] matrices of M y'' + Gamma y' + H y = 0 */
    qdot_expr *N;             /* [coordinates x n] displacement of each coordinate is N y */
    size_t *which;            /* [n] index of the coordinate whose displacement is y_a */
    size_t rank;              /* rank of the constraints' Jacobian at the equilibrium */
    qdot_expr *pivot;         /* [rank] pivots of the elimination: N is valid where none of them is 0 */
    bool exact;               /* the equations of motion are linear: nothing is neglected */
    bool damped;              /* Gamma is defined; false: it was set to 0, as for a force |v| v at v = 0 */
} qdot_linear_motion;

/* About the equilibrium `equations`, which exists under the conditions `exists` (a LIST; nil:
 * none). Owned by the caller. */
QDOT_MUST_CHECK qdot_status qdot_linear_motion_about(qdot_scene *s, qdot_expr equations,
                                                     qdot_expr exists,
                                                     qdot_linear_motion *out);
void qdot_linear_motion_clear(qdot_linear_motion *m);

/* Of an undamped motion with symmetric H: put in unknowns without mass, a point between springs, from their own equations
 * H_aa y_a + sum H_ab y_b = 0 (static condensation), so that as many are left as there are oscillations. *left: the
 * coordinate of one without mass whose equation does not determine it; SIZE_MAX: none. Allocates. */
QDOT_MUST_CHECK qdot_status qdot_linear_motion_condense(qdot_scene *s, const qdot_facts *facts,
                                                        qdot_linear_motion *m, size_t *left);

/* Collect the facts of a scene together with the conditions under which an equilibrium exists. own:
 * to be freed. */
QDOT_MUST_CHECK qdot_status qdot_rest_facts(qdot_scene *s, qdot_expr exists,
                                            qdot_facts *facts, qdot_expr **own);

/* The residual left - right of the equation of motion of coordinate i. Nil: the pool keeps the failure. */
qdot_expr qdot_motion_residual(qdot_scene *s, size_t i);

/* The expression e at rest, with the values of an equilibrium substituted; not simplified. */
qdot_expr qdot_rest_value(qdot_scene *s, qdot_expr equations, qdot_expr e);

#endif
