/* jacobi.h -- Jacobi's elliptic functions, in the parameter m = k^2 <= 1.
 *
 *     am(u, m) = phi where F(phi, m) = u;   sn = sin(am), cn = cos(am), dn = sqrt(1 - m sn^2) > 0
 *     am' = dn,  sn' = cn dn,  cn' = -sn dn,  dn' = -m sn cn
 *     d am/d m = (((1 - m) u - E(am, m)) dn + m sn cn)/(2 m (1 - m))
 *
 * am and dn are nodes of their own; sn and cn are stored as sin and cos of am, which print as jacobi_sn and jacobi_cn, so
 * that all that is known of sines and cosines holds for them. For numbers m > 1 sn, cn and dn are those of 1/m:
 *
 *     sn(u, m) = sn(k u, 1/m)/k,   cn(u, m) = dn(k u, 1/m),   dn(u, m) = cn(k u, 1/m),   k = sqrt(m)
 *
 * Source  NIST DLMF, 22.2, 22.5, 22.13, 22.16 (i), 22.17
 * Tests   tests/expr/test_elliptic.c
 */
#ifndef QDOT_EXPR_JACOBI_H
#define QDOT_EXPR_JACOBI_H

#include "expr/function.h"

/* 1 - m sn(u, m)^2, which is dn(u, m)^2. */
qdot_expr qdot_jacobi_dn_squared(qdot_pool *pool, qdot_expr u, qdot_expr m);

/* A simpler expression for f(args), args [2], always for sn and cn; nil where there is none. QDOT_EDOMAIN: am, and m is a
 * number > 1. */
qdot_expr qdot_jacobi_simplify(qdot_pool *pool, qdot_fun_id f, const qdot_expr *args);
/* The partial derivative of am or dn of args [2] with respect to args[i]. */
qdot_expr qdot_jacobi_derivative(qdot_pool *pool, qdot_fun_id f, const qdot_expr *args, uint32_t i);
/* f(x), x [2], in double; NAN where m > 1. */
double qdot_jacobi_double(unsigned f, const double *x);

#endif
