/* rational.h -- antiderivatives of rational functions.
 *
 *     int n/d dx = rest + sum c_i log|p_i(x)| + sum c_j atan p_j(x)
 *
 * Partial fractions over the factors of d over Q(parameters); Hermite's reduction lowers their powers without
 * finding roots; what is left over a square-free denominator gives logarithms and arcs, of real factors of degree 1
 * and 2. An irreducible x^4 + p x^2 + q and x^3 + c (in x - s), and a reciprocal x^4 + a x^3 + b x^2 + a k x + k^2, split
 * into such with roots of parameters; other irreducible denominators are integrated where their residues are roots of
 * quadratic equations, or their zeros roots of unity times one number. A denominator in x^k, whose numerator is x^(k-1) times such a one, is integrated
 * over x^k.
 *
 * All terms are continuous wherever n/d is: the p_j are polynomials, and so no atan jumps.
 *
 * Source  Bronstein, Symbolic Integration I (2005), 2.2; Hardy, The Integration of Functions (1916), III.
 * Tests   tests/normal/integral/test_antiderivative.c
 */
#ifndef QDOT_INTEGRAL_RATIONAL_H
#define QDOT_INTEGRAL_RATIONAL_H

#include "normal/integral/polynomial.h"

enum { QDOT_PRIMITIVE_TERMS = 24 };

/* rest + sum of c log|p(x)| (or c atan p(x), if `angle`). */
typedef struct {
    qdot_expr rest; /* a rational function of x */
    int n;
    struct {
        bool angle;
        qdot_expr c;
        qdot_poly p;
    } term[QDOT_PRIMITIVE_TERMS];
} qdot_primitive;

/* Add c log|p(x)|, or c atan p(x); false: no room, or p is too large. */
bool qdot_primitive_add(qdot_integral_task *t, qdot_primitive *out, bool angle, qdot_expr c, qdot_poly p);

/* Add the integral of n/f by the residues of its poles (residues.c): f irreducible, of higher degree than n. False: not found, and
 * then *out may hold a part. */
bool qdot_residues_integrate(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out);

/* The same where the roots of f are roots of unity times one number: f = x^n + c, or cyclotomic in x/r (cyclotomic.c). */
bool qdot_cyclotomic_integrate(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out);

/* Integrate e, rational in x; false: it is not, or no real factors of its denominator were found. */
bool qdot_rational_integrate(qdot_integral_task *t, qdot_expr e, qdot_expr x, qdot_primitive *out);

/* The antiderivative as an expression in x. */
qdot_expr qdot_rational_write(qdot_integral_task *t, const qdot_primitive *f, qdot_expr x);

/* n/prod f[i]^power[i] [count] = whole + sum over[i]/f[i]^power[i], the f[i] without common roots; false: too large. */
bool qdot_rational_fractions(qdot_integral_task *t, const qdot_poly *n, int count, const qdot_poly *f, const int64_t *power,
                             qdot_poly *whole, qdot_poly *over);

/* int e dw, e rational in the symbol w, with `is` in the place of w; nil: not found. */
qdot_expr qdot_rational_over(qdot_integral_task *t, qdot_expr e, qdot_expr w, qdot_expr is);

/* Sum of logarithms c_i log|u_i| [n], with c log|u| - c log|v| written c log|u/v|. */
qdot_expr qdot_rational_logs(qdot_integral_task *t, int n, qdot_expr *c, const qdot_expr *u);

#endif
