/* polynomial.h -- polynomials in one variable; coefficients are expressions free of it, in normal form.
 *
 * Numbers of coefficients are small: a polynomial of a degree beyond QDOT_POLY_MOST has degree -2, and so has
 * whatever is computed of it (overflow).
 *
 * Tests  tests/normal/integral/test_antiderivative.c
 */
#ifndef QDOT_INTEGRAL_POLYNOMIAL_H
#define QDOT_INTEGRAL_POLYNOMIAL_H

#include "normal/integral/task.h"

enum { QDOT_POLY_MOST = 32 };

/* sum of c[i] x^i for i = 0 ... degree; c[degree] is not 0; degree -1: zero, -2: too large. */
typedef struct {
    int degree;
    qdot_expr c[QDOT_POLY_MOST + 1];
} qdot_poly;

qdot_poly qdot_poly_constant(qdot_integral_task *t, qdot_expr c);
qdot_poly qdot_poly_linear(qdot_integral_task *t, qdot_expr a, qdot_expr b); /* a x + b */
qdot_poly qdot_poly_monomial(qdot_expr c, int n); /* c x^n, c in normal form and not 0 */
/* The coefficient of x^i. */
qdot_expr qdot_poly_coefficient(const qdot_poly *p, int i);
/* e as a polynomial in x; degree -2: it is none. */
qdot_poly qdot_poly_read(qdot_integral_task *t, qdot_expr e, qdot_expr x);
/* e, a polynomial in V, as lo + hi V with `square` for V^2; false: it is none. */
bool qdot_poly_read_root(qdot_integral_task *t, qdot_expr e, qdot_expr V, qdot_expr square, qdot_expr *lo, qdot_expr *hi);
qdot_expr qdot_poly_expr(qdot_integral_task *t, const qdot_poly *p, qdot_expr x);

qdot_poly qdot_poly_add(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b);
qdot_poly qdot_poly_sub(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b);
qdot_poly qdot_poly_mul(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b);
qdot_poly qdot_poly_scale(qdot_integral_task *t, const qdot_poly *a, qdot_expr c);
qdot_poly qdot_poly_power(qdot_integral_task *t, const qdot_poly *a, int64_t n);
qdot_poly qdot_poly_diff(qdot_integral_task *t, const qdot_poly *a);
/* The integral with constant 0. */
qdot_poly qdot_poly_integral(qdot_integral_task *t, const qdot_poly *a);
/* a = quotient b + rest. */
void qdot_poly_divide(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b, qdot_poly *quotient,
                      qdot_poly *rest);
/* s a = c modulo m, degree of s below that of m; degree -2: a is not invertible modulo m. */
qdot_poly qdot_poly_quotient_mod(qdot_integral_task *t, const qdot_poly *c, const qdot_poly *a,
                                 const qdot_poly *m);
qdot_expr qdot_poly_at(qdot_integral_task *t, const qdot_poly *a, qdot_expr x);

#endif
