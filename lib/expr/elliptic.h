/* elliptic.h -- Legendre's elliptic integrals, in the parameter m = k^2.
 *
 *     F(phi, m) = int_0^phi dx/D,   E(phi, m) = int_0^phi D dx,   D = sqrt(1 - m sin(x)^2)
 *     Pi(n, phi, m) = int_0^phi dx/((1 - n sin(x)^2) D)
 *     K(m) = F(pi/2, m),   E(m) = E(pi/2, m),   Pi(n, m) = Pi(n, pi/2, m)
 *
 * They are real for m < 1 (E: m <= 1) and n < 1, otherwise while m sin(x)^2 < 1 and n sin(x)^2 < 1 up to phi.
 *
 * Source  Abramowitz & Stegun, chapter 17; NIST DLMF, 19.2 (definitions), 19.4 (derivatives), 19.6 (special values),
 *         19.25 (by Carlson's integrals)
 * Tests   tests/expr/test_elliptic.c
 */
#ifndef QDOT_EXPR_ELLIPTIC_H
#define QDOT_EXPR_ELLIPTIC_H

#include "expr/function.h"

/* Whether f is one of the elliptic integrals, or of Jacobi's functions (jacobi.h). */
bool qdot_is_elliptic(unsigned f);
/* A simpler expression for f(args); nil where there is none. QDOT_EDOMAIN: f is undefined there. */
qdot_expr qdot_elliptic_simplify(qdot_pool *pool, qdot_fun_id f, uint32_t n, const qdot_expr *args);
/* The partial derivative of f(args) with respect to args[i]. */
qdot_expr qdot_elliptic_derivative(qdot_pool *pool, qdot_fun_id f, uint32_t n, const qdot_expr *args, uint32_t i);
/* The coefficient of m^k in the series of K(m) or E(m) at m = 0, where their derivatives are written 0/0: (pi/2) c_k and
 * (pi/2) c_k/(1 - 2 k) with c_k = ((2 k)!/(4^k k!^2))^2; nil: f is another function. */
qdot_expr qdot_elliptic_coefficient(qdot_pool *pool, qdot_fun_id f, int64_t k);
/* The value of f at x [n] in double; NaN where it is undefined. */
double qdot_elliptic_double(unsigned f, uint32_t n, const double *x);

#endif
