/* radau-basis.h -- what Radau IIA's methods of 3, 5 and 7 stages have in numbers.
 *
 * With A the matrix of collocation (num/collocation.h), A^-1 is diagonal in its eigenvectors,
 *
 *     A^-1 = sum_k lambda_k u_k w_k^T,   w_k^T u_k = 1,
 *
 * one eigenvalue real and the others in pairs. With N(x) = prod (x - c_i) and mu = 1/lambda,
 *
 *     sum_k mu^k N^(k)(0) = 0,   u_i = sum_{k >= 1} mu^(k-1) N^(k)(c_i):
 *
 * the polynomial p whose values at the nodes are an eigenvector has mu p - int_0^x p = const N.
 *
 * Source  Hairer & Wanner, J. Comput. Appl. Math. 111 (1999) 93; the closed form by the line above.
 * Tests   tests/ode/test_radau.c
 */
#ifndef QDOT_ODE_RADAU_BASIS_H
#define QDOT_ODE_RADAU_BASIS_H

#include <stddef.h>

enum {
    QDOT_RADAU_MOST = 7,  /* largest number of stages */
    QDOT_RADAU_KINDS = 3, /* number of methods: 3, 5, 7 stages */
    QDOT_RADAU_SPACES = 4 /* largest number of eigenspaces of A^-1; k = 0 belongs to the real eigenvalue */
};

typedef struct {
    size_t stages, spaces;
    double c[QDOT_RADAU_MOST];
    double a[QDOT_RADAU_MOST][QDOT_RADAU_MOST], inverse[QDOT_RADAU_MOST][QDOT_RADAU_MOST];
    double first
        [QDOT_RADAU_MOST]; /* values of Lagrange polynomials at 0: p(0) = sum_i first[i] p(c_i) */
    double weight[QDOT_RADAU_MOST]; /* weights of barycentric interpolation at the nodes */
    double lambda_re[QDOT_RADAU_SPACES], lambda_im[QDOT_RADAU_SPACES];
    /* right eigenvectors u of A^-1, doubled for conjugate pairs, and left eigenvectors w */
    double right_re[QDOT_RADAU_SPACES][QDOT_RADAU_MOST],
        right_im[QDOT_RADAU_SPACES][QDOT_RADAU_MOST];
    double left_re[QDOT_RADAU_SPACES][QDOT_RADAU_MOST],
        left_im[QDOT_RADAU_SPACES][QDOT_RADAU_MOST];
} qdot_radau_basis;

/* The basis of the Radau method number `kind` < QDOT_RADAU_KINDS; static. */
const qdot_radau_basis *qdot_radau_basis_get(size_t kind);

/* Find weights w [stages] such that the polynomial with value 0 at 0 and z_i at c_i has the value sum_i w_i z_i at x. */
void qdot_radau_interpolate(const qdot_radau_basis *b, double x, double *w);

#endif
