/* piecewise.h -- antiderivatives of what has kinks or steps: of each piece by itself, joined so that nothing jumps.
 *
 * Where g(x) changes its sign at r_1 < ... < r_n, abs(g), sign(g), max, min and if are smooth between these places. With
 * F_k an antiderivative of what e is between r_k and r_(k+1),
 *
 *     F = F_k + C_k  for r_k < x < r_(k+1),   C_0 = 0,   C_k = C_(k-1) + F_(k-1)(r_k) - F_k(r_k).
 *
 * Where F_k is infinite at r_k, so is the integral, and C_k = 0. The places are numbers, or there is one, where g is linear in x.
 *
 * Steps: with u = s x + c, N = floor(u), V = u - N, e = h(V, N) and H an antiderivative of h by V for N fixed,
 *
 *     s F = S(N) + H(V, N) - H(0, N),   S(N + 1) - S(N) = H(1, N) - H(0, N),   S(0) = 0,
 *
 * S a polynomial. mod(u, m) is m V of floor(u/m), abs(sin(u)) is sin(mod(u, pi)). If u is not linear, f(u) u' is
 * integrated over u.
 *
 * Tests   tests/normal/integral/test_piecewise.c, tests/script/integrals/continuous.lag
 */
#ifndef QDOT_INTEGRAL_PIECEWISE_H
#define QDOT_INTEGRAL_PIECEWISE_H

#include "normal/field/facts.h"

/* An antiderivative of e by x that does not jump where e is finite; nil: none is known, or the pool failed. */
typedef qdot_expr qdot_piece_find(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts);

/* Whether e holds floor or mod of x; kinks: abs, sign, max, min or if of x. */
bool qdot_piecewise_steps(qdot_pool *pool, qdot_expr e, qdot_expr x);
bool qdot_piecewise_kinks(qdot_pool *pool, qdot_expr e, qdot_expr x);

/* Whether e, kinks and steps apart, is continuous for all x: no divisor vanishes, no root or logarithm leaves its domain. */
bool qdot_piecewise_finite(qdot_pool *pool, qdot_expr e, qdot_expr x);

/* F with the value `at` for x, and what is then decided of the choices if(RELATION, a, b) between numbers. */
qdot_expr qdot_piecewise_at(qdot_pool *pool, qdot_expr F, qdot_expr x, qdot_expr at, const qdot_facts *facts);

/* The antiderivative of e, which holds steps (first) or kinks (second), the pieces by `find`; nil: not found. */
qdot_expr qdot_steps_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts, qdot_piece_find *find);
qdot_expr qdot_kinks_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts, qdot_piece_find *find);

/* e with abs(sin(u)) written sin(mod(u, pi)), abs(cos(u)) likewise, and so max and min of which one is a sine more than the other. */
qdot_expr qdot_piecewise_waves(qdot_pool *pool, qdot_expr e, qdot_expr x);

#endif
