/* forms.h -- differential forms in coordinates: sums of f*dq_i, of f*wedge(dq_i, dq_j) and so on, all terms of one degree p.
 *
 *     d(f dq_I)       = sum_k (df/dq_k) dq_k ^ dq_I           over all coordinates of f, and t
 *     a ^ b           = (-1)^(pq) b ^ a
 *     i_X(dq_1 ^ ... ^ dq_p) = sum_k (-1)^(k - 1) X^k dq_1 ^ ... (without dq_k) ... ^ dq_p
 *     *(w_I dq_I)     = sum_K w^K sqrt|det g| e_K,J dq_J,     J the coordinates that are not in K
 *     L_X w           = d(i_X w) + i_X(dw)
 *
 * e is the sign of the permutation (K, J) of the coordinates in the order of the metric: t first, then as declared. So
 * a ^ *b = <a, b> vol, and ** = (-1)^(p(n - p)) s, s = -1 for a Lorentzian metric. A product of differentials is one symbol
 * (qdot_symbol_of with a LIST, in that order), so a form is a polynomial of first degree in such symbols: two forms are
 * compared, simplified and printed as other expressions are. A number is a form of degree 0.
 *
 * The coefficients are simplified. Nil on failure; the pool keeps the cause: QDOT_ETYPE where an argument is no form, or
 * the vector has another number of components than there are coordinates; QDOT_EINVAL for a form in coordinates that the
 * metric or the vector does not have; QDOT_ELIMIT for more than 63 coordinates.
 *
 * Source  Misner, Thorne, Wheeler, Gravitation, 4.1-4.6 and box 4.1; Frankel, The Geometry of Physics, 2.5-2.6, 4.2, 14.1.
 * Tests   tests/mech/geometry/test_forms.c
 */
#ifndef QDOT_MECH_FORMS_H
#define QDOT_MECH_FORMS_H

#include "mech/scene/things.h"

qdot_expr qdot_forms_exterior_derivative(qdot_scene *s, qdot_expr w);
qdot_expr qdot_forms_wedge(qdot_scene *s, qdot_expr a, qdot_expr b);
/* i_X w with the VEC X (a number for one coordinate), its components by the coordinates q [n]. */
qdot_expr qdot_forms_interior(qdot_scene *s, qdot_expr X, qdot_expr w, uint32_t n, const qdot_expr *q);
/* The Hodge dual with the metric of R, a position or a line element. */
qdot_expr qdot_forms_hodge(qdot_scene *s, qdot_expr w, qdot_expr R);
/* Whether w holds a product of differentials; the Lie derivative of a form along X. */
bool qdot_forms_has_product(const qdot_scene *s, qdot_expr w);
qdot_expr qdot_forms_lie(qdot_scene *s, qdot_expr w, qdot_expr X, uint32_t n, const qdot_expr *q);

/* --- replacements (forms-replace.c) ---
 *
 *     phi* (f dy_1 ^ ... ^ dy_p) = f(phi(x)) d(phi_1(x)) ^ ... ^ d(phi_p(x))            pullback by y = phi(x)
 *
 * e with from [n] replaced by to, all at once; a replaced differential is replaced in products, too. */
qdot_expr qdot_forms_subs(qdot_scene *s, qdot_expr e, size_t n, const qdot_expr *from, const qdot_expr *to);
/* The pullback of a form, or of a line element, by q_i = to_i, coordinates or t [n]. */
qdot_expr qdot_forms_pullback(qdot_scene *s, qdot_expr w, size_t n, const qdot_expr *q, const qdot_expr *to);

#endif
