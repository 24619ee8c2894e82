/* loop.h -- the integral of a root out and back between two branch points, as the action variable has it.
 *
 *     loop = 2 int_lo^hi sqrt(f(x)) dx,   f > 0 inside; lo and hi are zeros or poles of odd order of f
 *
 * A substitution u(x) that is monotonic between the ends makes f (dx/du)^2 = Q H^2, Q a square-free polynomial in u and
 * H rational: u = x, x^2, exp kx, cos kx, sin kx, tan kx, tanh kx, sinh kx. The ends are zeros of Q. If Q has degree 2,
 *
 *     Q = A (d^2 - (u - m)^2),   loop sqrt(Q)/(u - s) = 2 pi (sqrt(A) (m - s) - sigma sqrt(-Q(s))),   sigma = sign(m - s),
 *
 * for a pole s of H, which lies outside of the range; derivatives by s give poles of higher order, and the terms of a
 * polynomial H are moments of a half circle. For s = h + iw, m = h: sqrt(-Q(s)) is -i sqrt(Q(s)), Q(s) real.
 *
 * Complete elliptic integrals, a^2 and b^2 the zeros of the square:
 *
 *     int_0^b sqrt((b^2 - u^2)(u^2 + a^2)) = sqrt(a^2 + b^2)/3 (a^2 K + (b^2 - a^2) E),   m = b^2/(a^2 + b^2)
 *     int_a^b sqrt((b^2 - u^2)(u^2 - a^2)) = b/3 ((a^2 + b^2) E - 2 a^2 K),               m = 1 - a^2/b^2
 *     int_0^a sqrt((a^2 - u^2)(b^2 - u^2)) = b/3 ((a^2 + b^2) E - (b^2 - a^2) K),         m = a^2/b^2
 *     loop of sqrt(c + b cos w)  = 8 sqrt(2|b|) (E - (1 - m) K),                          m = (c + |b|)/(2|b|)
 *
 * Source  Sommerfeld, Atombau und Spektrallinien (1919), note 6; Born, The Mechanics of the Atom (1925), appendix II;
 *         Byrd & Friedman, Handbook of Elliptic Integrals (1971), 213-219
 * Tests   tests/normal/integral/test_loop.c
 */
#ifndef QDOT_INTEGRAL_LOOP_H
#define QDOT_INTEGRAL_LOOP_H

#include "normal/field/facts.h"

/* The loop, exact; nil: not found, or the pool failed. That lo < hi, that f > 0 between and that these are branch
 * points is the caller's to know. */
qdot_expr qdot_loop(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts);

/* The integral of sqrt(f) over a full turn of x, f > 0 with the period 2 pi; nil: not found, or the pool failed. */
qdot_expr qdot_loop_turn(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_facts *facts);

#endif
