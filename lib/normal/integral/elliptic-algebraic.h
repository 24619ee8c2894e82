/* elliptic-algebraic.h -- integrals of 1/sqrt(P), P a cubic or a quartic, by Legendre's F.
 *
 * A cubic lead (x - r)((x - p)^2 + q^2), lead > 0, with A^2 = (r - p)^2 + q^2:
 *
 *     F(acos((A + r - x)/(A - r + x)), (A + p - r)/(2 A))/sqrt(lead A)
 *
 * Real zeros a > b > c > d, m = (b - c)(a - d)/((a - c)(b - d)) where P > 0 for large x, else 1 - m, g = 2/sqrt((a - c)(b - d)):
 *
 *     g F(asin(s), ...),   s^2 = (b - d)(x - a)/((a - d)(x - b)) above a,   (b - d)(x - c)/((b - c)(x - d)) between c and b,
 *     and where -P > 0:   s^2 = (a - c)(x - b)/((a - b)(x - c)) between b and a,   (a - c)(x - d)/((c - d)(a - x)) between d and c;
 *
 * a cubic is the case of d to minus infinity. P = A x^4 + B x^2 + C with the zeros u, v of A w^2 + B w + C:
 *
 *     no real u:       F(2 atan(x/h), (1 - B/(2 A h^2))/2)/(2 h sqrt(A)),   h^4 = C/A
 *     u < v < 0 < A:   F(atan(x/sqrt(-v)), 1 - v/u)/sqrt(-A u)
 *     A, u < 0 < v:    F(asin(x/sqrt(v)), v/u)/sqrt(A u)
 *     0 < u < v, A:    F(asin(x/sqrt(u)), u/v)/sqrt(A v)  where x^2 < u
 *
 * Each is proved by differentiation. Where P > 0 in several ranges, the domain of x must say which one is meant.
 *
 * Source  Byrd & Friedman, Handbook of elliptic integrals (1971), 219, 221, 225, 231 to 241, 250 to 258, 263
 * Tests   tests/normal/integral/test_elliptic-algebraic.c, tests/script/integrals/elliptic-roots.lag
 */
#ifndef QDOT_INTEGRAL_ELLIPTIC_ALGEBRAIC_H
#define QDOT_INTEGRAL_ELLIPTIC_ALGEBRAIC_H

#include "normal/field/facts.h"

/* An antiderivative of e = c/sqrt(P), proved; nil: e is something else, the zeros or their order are not known, or the pool
 * failed. */
qdot_expr qdot_elliptic_algebraic(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts);

#endif
