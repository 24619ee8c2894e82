/* reactions.h -- the forces of the constraints on each particle and body.
 *
 * Constraint f_k acts along its gradient: the generalized reaction on q_j is
 *
 *     R_j = sum_k lambda_k df_k/dq_j   (df/dq', df/dq'' by the constraint's kind).
 *
 * If some coordinates occur in the position of one particle only, the force on that particle is
 * the one along the directions dr/dq_j with
 *
 *     F . dr/dq_j = R_j   for each of these q_j:   F = J (J^T J)^-1 R,  J = dr/dq,
 *
 * which is lambda df/dr if the coordinates are Cartesian. On a body it is a force at its centre
 * of mass and a torque tau with F . dr/dq_j + tau . dw/dq_j' = R_j, w its spin, if these
 * determine both. For coordinates that several things share the answer is R_j itself: r(q) does
 * not determine how it is distributed over them.
 *
 * Tests  tests/script/constraints/reactions.lag, tests/script/mechanisms/mechanism-*.lag
 */
#ifndef QDOT_MECH_REACTIONS_H
#define QDOT_MECH_REACTIONS_H

#include "mech/scene/things.h"

typedef struct {
    const char *name;     /* label of the particle or body, borrowed; NULL: a coordinate */
    qdot_expr coordinate; /* the coordinate; nil: a particle or body */
    qdot_expr force; /* reaction: a force (scalar in one dimension), or a coordinate's generalized force */
    qdot_expr torque;     /* torque on a body: scalar in the plane, vector in space; else nil */
} qdot_reaction;

/* *list [*n], owned by the caller: particles, bodies, then coordinates, in the order of
 * their declaration; things on which no constraint acts are left out. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_mech_reactions(qdot_scene *s, qdot_reaction **list,
                                                size_t *n);

/* The forces and torques of the reactions as a LIST. */
qdot_expr qdot_mech_reaction_list(qdot_scene *s);

#endif
