/* chebyshev.h -- a smooth function on an interval as a polynomial in Chebyshev's basis.
 *
 *     p(x) = sum_{k < n} c_k T_k(x),   -1 <= x <= 1
 *
 * Fitted at the n zeros of T_n, which hold neither end. Its bound on the interval,
 * |p - c_0| <= sum_{k > 0} |c_k|, makes roots a matter of proof: an interval on which it
 * keeps |p| > 0 holds none, one on which it keeps |p'| > 0 at most one; any other is
 * halved. (The polynomial is the one that has the coefficients as doubles.)
 *
 * Source  Mason & Handscomb, Chebyshev Polynomials (2003), 2.4, 6.3; Clenshaw (1955).
 * Tests   tests/num/test_chebyshev.c
 */
#ifndef QDOT_NUM_CHEBYSHEV_H
#define QDOT_NUM_CHEBYSHEV_H

#include <stdbool.h>

enum { QDOT_CHEBYSHEV_MOST = 64 };

/* Node j of n, descending in x; n: 8, 16, 32 or 64. */
double qdot_chebyshev_node(int n, int j);

/* The point of a ... b that x is. */
static inline double
qdot_chebyshev_place(double a, double b, double x)
{
    return 0.5 * (a + b) + 0.5 * (b - a) * x;
}

/* c [n] of the polynomial through values [n] at the nodes. */
void qdot_chebyshev_fit(int n, const double *values, double *c);

double qdot_chebyshev_at(int n, const double *c, double x);

/* d [n - 1] of the derivative by x; n > 1. */
void qdot_chebyshev_derivative(int n, const double *c, double *d);

/* The integral over -1 ... 1. */
double qdot_chebyshev_integral(int n, const double *c);

/* c on -1 ... 0 and on 0 ... 1, into left [n] and right [n]; n at most QDOT_CHEBYSHEV_MOST. */
void qdot_chebyshev_halves(int n, const double *c, double *left, double *right);

/* The largest of the last coefficients that would vanish of a polynomial of lower degree,
 * and the largest of all. */
double qdot_chebyshev_tail(int n, const double *c);
double qdot_chebyshev_size(int n, const double *c);

/* sum_{k > 0} |c_k|, how far p goes from c_0 at most. */
double qdot_chebyshev_spread(int n, const double *c);

/* A bound of |p - c_0| on the ellipse with foci -1, 1 whose half axes add up to rho >= 1,
 *
 *     sum_{k > 0} |c_k| (rho^k + rho^-k)/2,
 *
 * c fitted to values that are off by `noise`: coefficients that are nothing else are left
 * out. Infinite where the last ones have not become small: p is not what was fitted. */
double qdot_chebyshev_ellipse(int n, const double *c, double noise, double rho);

/* Whether the bound shows that p has one sign throughout: it, else 0. */
int qdot_chebyshev_sign(int n, const double *c);

/* The x at which p changes its sign, ascending, into roots [n]; how many. Of several
 * within 2^-44 of one another an odd number counts once, an even one not. */
int qdot_chebyshev_crossings(int n, const double *c, double *roots);

#endif
