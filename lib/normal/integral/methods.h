/* methods.h -- the methods of integration, each for a class of integrands.
 *
 * Each gives an antiderivative, or nil: another class, or not found. None of them is trusted: antiderivative.c
 * differentiates what comes out.
 *
 * Tests  tests/normal/integral/test_antiderivative.c
 */
#ifndef QDOT_INTEGRAL_METHODS_H
#define QDOT_INTEGRAL_METHODS_H

#include "normal/integral/reading.h"

/* Rational functions of exp(k x + c): over the exponential. */
qdot_expr qdot_exponential_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x);

/* Rational functions of x times powers of exp(u), u rational in x (exponential.c). */
qdot_expr qdot_exponential_rational_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x);

/* Rational functions of x and roots of (a x + b)/(c x + d): over the root of highest order. */
qdot_expr qdot_linear_root_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x, int depth);

/* Rational functions of x and y = sqrt(a x^2 + b x + c) (quadratic-root.c). */
qdot_expr qdot_quadratic_root_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x);

/* Functions of sines and cosines of one angle that hold roots, over the sine or the cosine (wave-root.c). */
qdot_expr qdot_wave_root_integrate(qdot_integral_task *t, qdot_expr e, qdot_expr x, int depth);

/* Sums of x^n exp(a x) cos(b x), products of these, powers of constants included (waves.c). */
qdot_expr qdot_waves_integrate(qdot_integral_task *t, qdot_expr e, qdot_expr x);

/* Polynomials times exp(a x^2 + b x + c), by the error function (gauss.c). */
qdot_expr qdot_gauss_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x);

/* f(u) u' over u, for every part u of the term (substitution.c). */
qdot_expr qdot_substitution_integrate(qdot_integral_task *t, qdot_expr term, qdot_expr x, int depth);

/* Logarithms, inverse functions and error functions times what can be integrated: by parts (parts.c). */
qdot_expr qdot_parts_integrate(qdot_integral_task *t, qdot_expr term, qdot_expr x, int depth);

/* du/dx where it is free of x; nil: u is not linear in x. */
qdot_expr qdot_integral_slope(qdot_pool *pool, qdot_expr u, qdot_expr x);

/* Split a product into factors free of x and the rest. */
void qdot_integral_split(qdot_pool *pool, qdot_expr term, qdot_expr x, qdot_expr *free, qdot_expr *rest);

#endif
