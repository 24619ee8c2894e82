/* geometry.h -- the geometry of r(q) or of a line element: from ds^2 to curvature, and the vector
 * operators in the frame of its unit vectors.
 *
 * R is a position (VEC or scalar) or a quadratic form in dq; the coordinates q_1 ... q_n are those that
 * occur in it, in declared order (qdot_mech_metric_coordinates). g_ij = dr/dq_i . dr/dq_j.
 * Everything is simplified. Nil on failure; the pool keeps the cause. QDOT_EDOMAIN where g has no
 * inverse, QDOT_ETYPE where an operator needs another number of components.
 *
 * Source  do Carmo, Differential Geometry of Curves and Surfaces, 4.3; Misner, Thorne, Wheeler,
 *         Gravitation, box 8.6 (signs of riemann and ricci).
 * Tests   tests/mech/geometry/test_geometry.c
 */
#ifndef QDOT_MECH_GEOMETRY_H
#define QDOT_MECH_GEOMETRY_H

#include "mech/scene/things.h"

/* The Christoffel symbols G^i_jk = 1/2 g^il (d_j g_lk + d_k g_lj - d_l g_jk): a LIST over i of MATs in j, k. */
qdot_expr qdot_geometry_christoffel(qdot_scene *s, qdot_expr R);
/* R^i_jkl = d_k G^i_lj - d_l G^i_kj + G^i_km G^m_lj - G^i_lm G^m_kj: LIST over i of LISTs over j of
 * MATs in k, l. */
qdot_expr qdot_geometry_riemann(qdot_scene *s, qdot_expr R);
/* The Ricci tensor R_jl = R^i_jil as a MAT. */
qdot_expr qdot_geometry_ricci(qdot_scene *s, qdot_expr R);
/* The scalar curvature g^jl R_jl; twice Gauss' curvature for a surface: 2/a^2 on a sphere. */
qdot_expr qdot_geometry_scalar_curvature(qdot_scene *s, qdot_expr R);
/* Einstein's tensor R_jl - 1/2 g_jl R as a MAT. */
qdot_expr qdot_geometry_einstein(qdot_scene *s, qdot_expr R);
/* Weyl's tensor C^i_jkl, the part of riemann without traces, arranged as riemann; QDOT_ETYPE for less than 3 coordinates. */
qdot_expr qdot_geometry_weyl(qdot_scene *s, qdot_expr R);
/* Kretschmann's scalar R_ijkl R^ijkl. */
qdot_expr qdot_geometry_kretschmann(qdot_scene *s, qdot_expr R);
/* The equations of geodesics as a LIST: q_i'' + sum_jk G^i_jk q_j' q_k' = 0 with Christoffel symbols G. */
qdot_expr qdot_geometry_geodesic(qdot_scene *s, qdot_expr R);
/* The volume element sqrt(det g); sqrt(-det g) where det g < 0. */
qdot_expr qdot_geometry_volume_element(qdot_scene *s, qdot_expr R);
/* The scale factors h_i = sqrt(g_ii) as a LIST. */
qdot_expr qdot_geometry_scale_factors(qdot_scene *s, qdot_expr R);

/* Vector fields have components along the unit vectors e_i = (dr/dq_i)/h_i, which need not be orthogonal. */
/* The gradient h_i g^ij df/dq_j as a VEC (a scalar for one coordinate). */
qdot_expr qdot_geometry_gradient(qdot_scene *s, qdot_expr f, qdot_expr R);
/* The divergence (1/w) d_i (w F_i/h_i), w = sqrt(det g). */
qdot_expr qdot_geometry_divergence(qdot_scene *s, qdot_expr F, qdot_expr R);
/* Three coordinates: a VEC; two: the scalar across the surface. Of the ambient field: a left-handed
 * frame turns the sign. */
qdot_expr qdot_geometry_curl(qdot_scene *s, qdot_expr F, qdot_expr R);
/* The Laplacian (1/w) d_i (w g^ij d_j f), w = sqrt(det g). */
qdot_expr qdot_geometry_laplacian(qdot_scene *s, qdot_expr f, qdot_expr R);

#endif
