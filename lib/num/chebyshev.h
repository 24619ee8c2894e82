/* chebyshev.h -- polynomials in Chebyshev's basis, fitted to a smooth function on an interval.
 *
 *     p(x) = sum_{k < n} c_k T_k(x),   -1 <= x <= 1
 *
 * Fitted at the n zeros of T_n, which do not include the ends. The bound on the interval,
 * |p - c_0| <= sum_{k > 0} |c_k|, proves the number of roots: an interval on which it
 * shows |p| > 0 holds none, one on which it shows |p'| > 0 at most one; any other is
 * halved. (The polynomial meant has exactly these doubles as coefficients.)
 *
 * Source  Mason & Handscomb, Chebyshev Polynomials (2003), 2.4, 6.3; Clenshaw (1955).
 * Tests   tests/num/test_chebyshev.c
 */
#ifndef QDOT_NUM_CHEBYSHEV_H
#define QDOT_NUM_CHEBYSHEV_H

#include <stdbool.h>

enum { QDOT_CHEBYSHEV_MOST = 64 };

/* Chebyshev node number j of n = 8, 16, 32 or 64, descending in x. */
double qdot_chebyshev_node(int n, int j);

/* The point of the interval a ... b that corresponds to x in -1 ... 1. */
static inline double
qdot_chebyshev_place(double a, double b, double x)
{
    return 0.5 * (a + b) + 0.5 * (b - a) * x;
}

/* Find the coefficients c [n] of the Chebyshev series that has values [n] at the nodes. */
void qdot_chebyshev_fit(int n, const double *values, double *c);

double qdot_chebyshev_at(int n, const double *c, double x);

/* Find the Chebyshev coefficients d [n - 1] of the derivative of a series by x; n > 1. */
void qdot_chebyshev_derivative(int n, const double *c, double *d);

/* The integral of the series over -1 ... 1. */
double qdot_chebyshev_integral(int n, const double *c);

/* The coefficients on -1 ... 0 and on 0 ... 1: left [n], right [n]; n at most
 * QDOT_CHEBYSHEV_MOST. */
void qdot_chebyshev_halves(int n, const double *c, double *left, double *right);

/* The largest of the last coefficients, which vanish for a polynomial of lower degree; and the
 * largest of all. */
double qdot_chebyshev_tail(int n, const double *c);
double qdot_chebyshev_size(int n, const double *c);

/* The sum of |c_k| over k > 0, which bounds the distance of the polynomial from its mean coefficient c_0. */
double qdot_chebyshev_spread(int n, const double *c);

/* A bound of |p - c_0| on the ellipse with foci -1, 1 whose half axes add up to rho >= 1,
 *
 *     sum_{k > 0} |c_k| (rho^k + rho^-k)/2,
 *
 * for c fitted to values with errors `noise`: coefficients below that are left out. Infinite if
 * the last ones are not small: then p does not represent the function. */
double qdot_chebyshev_ellipse(int n, const double *c, double noise, double rho);

/* The sign of a series p on -1 ... 1 if bounds show that it is the same everywhere, else 0. */
int qdot_chebyshev_sign(int n, const double *c);

/* The root of a monotonic series between lo and hi, at which its signs differ. */
double qdot_chebyshev_root(int n, const double *c, double lo, double hi);

/* The x at which p changes its sign, ascending, into roots [n]; returns their number. Of several
 * within 2^-44 of one another an odd number counts as one, an even number as none. -1: they were not found,
 * since a coefficient is not finite, or so small a part of the others that halving ends in rounding. */
int qdot_chebyshev_crossings(int n, const double *c, double *roots);

#endif
