/* elliptic-forms.h -- antiderivatives that are elliptic integrals (expr/elliptic.h).
 *
 *     c/sqrt(P + Q sin(v)^2) = d/dx  c F(v, -Q/P)/(sqrt(P) v'),   c sqrt(P + Q sin(v)^2) = d/dx  c sqrt(P) E(v, -Q/P)/v',
 *     c/((N + M sin(v)^2) sqrt(P + Q sin(v)^2)) = d/dx  c Pi(-M/N, v, -Q/P)/(N sqrt(P) v')
 *
 *     c/sqrt(P + Q sin(v)^2) = d/dx  c F(asin(sin(v) sqrt(-Q/P)), -P/Q)/(sqrt(-Q) v')   if -Q > P, where cos(v) > 0
 *
 * for v linear in x and P > 0; a + b cos(u) is (a + b) - 2 b sin(u/2)^2, a + b sin(u) the same of u - pi/2. With
 * sin(v) = x sqrt(-B/A), of A > 0, B < 0, C > 0:
 *
 *     c/(sqrt(A + B x^2) sqrt(C + D x^2)) = d/dx  c F(v, A D/(B C))/sqrt(-B C),
 *     c sqrt(C + D x^2)/sqrt(A + B x^2) = d/dx  c sqrt(C) E(v, A D/(B C))/sqrt(-B)
 *
 * Source  Byrd & Friedman, Handbook of elliptic integrals, 282, 284, 289, 290
 * Tests   tests/normal/calculus/test_elliptic-forms.c
 */
#ifndef QDOT_NORMAL_ELLIPTIC_FORMS_H
#define QDOT_NORMAL_ELLIPTIC_FORMS_H

#include "normal/field/facts.h"

/* An elliptic integral with the derivative e by the symbol x, which is proved; nil: e is none of the forms, or it was not
 * proved (then the pool has no failure of its own). */
qdot_expr qdot_elliptic_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts);

#endif
