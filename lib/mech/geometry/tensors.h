/* tensors.h -- derivatives of tensor fields in coordinate components.
 *
 * A field is a VEC (contravariant, V^i), an expression linear in the differentials dq (a one-form w_i dq_i), a MAT
 * (twice covariant, T_ij), or a scalar. Components are along the coordinates, not along unit vectors. Everything is
 * simplified. Nil on failure; the pool keeps the cause: QDOT_ETYPE where components and coordinates do not fit.
 *
 * Source  Misner, Thorne, Wheeler, Gravitation, 9.6, 10.4 and exercise 21.8.
 * Tests   tests/mech/geometry/test_tensors.c
 */
#ifndef QDOT_MECH_TENSORS_H
#define QDOT_MECH_TENSORS_H

#include "mech/scene/things.h"

/* The covariant derivative with the metric of R. f: VEC of d_j f; V^i: MAT of d_j V^i + G^i_jk V^k in i, j; w_i: MAT
 * of d_j w_i - G^k_ij w_k in i, j; T_ij: LIST over i of MATs of d_k T_ij - G^a_ik T_aj - G^a_jk T_ia in j, k. */
qdot_expr qdot_tensors_covariant(qdot_scene *s, qdot_expr V, qdot_expr R);

/* The Lie derivative of V along the VEC X over the coordinates q [n]. f: X^k d_k f; V^i: the commutator of X and V; an
 * expression in dq, of any degree: X^k d_k of its coefficients, each dq_i replaced by d_k X^i dq_k in turn (forms of higher degree: forms.h); T_ij: X^k
 * d_k T_ij + T_kj d_i X^k + T_ik d_j X^k. */
qdot_expr qdot_tensors_lie(qdot_scene *s, qdot_expr V, qdot_expr X, uint32_t n, const qdot_expr *q);

/* The commutator [X, Y]^i = X^j d_j Y^i - Y^j d_j X^i of VECs over the coordinates q [n]. */
qdot_expr qdot_tensors_commutator(qdot_scene *s, qdot_expr X, qdot_expr Y, uint32_t n, const qdot_expr *q);

#endif
