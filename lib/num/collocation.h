/* collocation.h -- methods of collocation: Gauss, Radau IIA, and Lobatto IIIA.
 *
 * The solution of y' = f(t, y) over a step from t to t + h is a polynomial u of degree s with
 *
 *     u(t) = y,   u'(t + c_i h) = f(t + c_i h, u(t + c_i h)),   i = 0 .. s-1,
 *
 * that is, with L_j the polynomial of degree s-1 that is 1 at c_j and 0 at the other nodes,
 *
 *     u(t + x h) = y + h sum_j w_j(x) f_j,   w_j(x) = int_0^x L_j,
 *     a_ij = w_j(c_i),   b_j = w_j(1).
 *
 * Gauss:     c_i are the zeros of P_s(2c - 1),               order 2s
 * Radau IIA: c_i are the zeros of P_s(2c - 1) - P_(s-1)(2c - 1), order 2s - 1; the last one is 1
 * Lobatto IIIA: those of P_s(2c - 1) - P_(s-2)(2c - 1),      order 2s - 2; 0 and 1 are among them
 *
 * in ascending order, P_s Legendre's polynomial. Numbers are sums of two doubles, right to about
 * 26 digits; .hi alone is the number rounded to a double.
 *
 * Source  Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), IV.5;
 *         Hairer, Norsett & Wanner I, 2nd ed. (1993), II.7.
 * Tests   tests/num/test_collocation.c
 */
#ifndef QDOT_NUM_COLLOCATION_H
#define QDOT_NUM_COLLOCATION_H

#include "num/two.h"

enum { QDOT_COLLOCATION_MOST = 8 }; /* largest number of stages */

typedef struct {
    int stages, order;
    qdot_two c[QDOT_COLLOCATION_MOST];
    qdot_two b[QDOT_COLLOCATION_MOST];
    qdot_two a[QDOT_COLLOCATION_MOST][QDOT_COLLOCATION_MOST]; /* a[i][j]: weight of the derivative at stage j in stage i */
    /* Lagrange's polynomials of the nodes: L_j(x) = sum_k l[j][k] x^k, k below the number of stages */
    qdot_two l[QDOT_COLLOCATION_MOST][QDOT_COLLOCATION_MOST];
} qdot_collocation;

/* Fill in Gauss's method; the caller must check that 1 <= stages <= QDOT_COLLOCATION_MOST. */
void qdot_collocation_gauss(int stages, qdot_collocation *m);
void qdot_collocation_radau(int stages, qdot_collocation *m);
void qdot_collocation_lobatto(int stages, qdot_collocation *m); /* fill in Lobatto's method; stages >= 2 */

/* Find the weights w [stages] of the stages for interpolation at x. */
void qdot_collocation_weights(const qdot_collocation *m, qdot_two x, qdot_two *w);

#endif
