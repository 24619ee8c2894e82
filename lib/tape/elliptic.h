/* elliptic.h -- elliptic integrals and Jacobi's amplitude as operations of a tape, by arithmetic and geometric means.
 *
 *     a_0 = 1, b_0 = sqrt(1 - m);   a_n+1 = (a_n + b_n)/2,  b_n+1 = sqrt(a_n b_n),  c_n+1 = (a_n - b_n)/2,  c_0^2 = m
 *
 * converge to one limit M, the number of right digits doubling at each step:
 *
 *     K(m) = pi/(2 M),   E(m) = K(m) (1 - sum 2^(n-1) c_n^2)
 *     Pi(n, m) = pi/(4 M) (2 + n/(1 - n) sum Q_k),  Q_0 = 1, Q_k+1 = Q_k e_k/2,  e_k = (p_k^2 - a_k b_k)/(p_k^2 + a_k b_k),
 *                p_0^2 = 1 - n,  p_k+1 = (p_k^2 + a_k b_k)/(2 p_k)
 *     F(phi, m) = phi_N/(2^N M),  phi_n+1 = 2 phi_n - atan((a_n - b_n) s c/(a_n c^2 + b_n s^2)),  s, c = sin, cos(phi_n)
 *     E(phi, m) = E(m)/K(m) F(phi, m) + sum_(n>0) c_n sin(phi_n)
 *     am(u, m): phi_N = 2^N M u,  phi_n-1 = (phi_n + atan(c_n s/sqrt(a_n^2 c^2 + b_n^2 s^2)))/2
 *
 * All steps are smooth for m < 1 and n < 1, for every phi and u, also at m = 0, where the differential equations of K and E
 * are singular. So values, slopes, series and code of them are those of any other operations. Eight steps are made:
 * enough for 28 digits where 1e-16 < 1 - m < 1e16, and for 15 where 1 - m < 1e32; 40 of p_k, for the same range of 1 - n. There is no
 * number for m >= 1; K(1) is infinite.
 *
 * Source  Abramowitz & Stegun, 16.4, 17.6; NIST DLMF, 19.8(i), 22.20(ii); the steps with atan are Gauss' and Landen's
 *         tan(phi_n+1 - phi_n) = (b_n/a_n) tan(phi_n) and sin(2 phi_n-1 - phi_n) = (c_n/a_n) sin(phi_n) without jumps
 * Tests   tests/tape/test_elliptic.c
 */
#ifndef QDOT_TAPE_ELLIPTIC_H
#define QDOT_TAPE_ELLIPTIC_H

#include "expr/function.h"
#include "tape/code.h"

/* The operations of f(x), x [n] values of its arguments. False: f is none of these functions, or the incomplete integral of
 * the third kind, which has none. */
bool qdot_code_elliptic(qdot_code *code, qdot_fun_id f, uint32_t n, const qdot_value *x, qdot_value *y);

#endif
