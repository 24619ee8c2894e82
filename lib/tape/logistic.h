/* logistic.h -- quotients of exponentials in a form that stays finite.
 *
 * 1/cosh(u)^2, 1/(1 + e^u), e^u/(1 + e^u)^2, sinh(u)/cosh(u)^3 are plain numbers for every u, but cosh
 * and e^u are infinite in doubles beyond 709. With l(d) = log(1 + e^d), which is near |d| at most, and
 *
 *     (c_1 e^v + c_2 e^w)^-n = (c_1 c_2)^(-n/2) e^(-n (v + w)/2) e^(-n/2 (l(d) + l(-d))),
 *     d = w - v + log(c_2/c_1),   c_1 c_2 > 0,   e^d = e^l(d)/e^l(-d),
 *
 * they are e^(-a l(d) - b l(-d)), a, b >= 0: what stands over and under is taken together before e^ is.
 * So each has its relative precision however small it is. cosh(u) is (e^-u + e^u)/2; sinh(u)^k over
 * cosh(u)^n is tanh(u)^k cosh(u)^(k - n). A sum of more is a factor and what stays finite,
 *
 *     sum c_ab cosh(u)^a sinh(u)^b = cosh(u)^N sum c_ab tanh(u)^b cosh(u)^(a + b - N)
 *     sum c_i e^(k_i u) = (e^(k u) + e^(K u)) sum c_i e^(k_i u)/(e^(k u) + e^(K u)),   k <= k_i <= K,
 *
 * and so are logarithms, log(c_1 e^v + c_2 e^w) = log(c_1) + v + l(d), or, if neither v nor w is 0,
 * (log(c_1 c_2) + v + w + l(d) + l(-d))/2.
 *
 * l(d) is written log(1 + e^d), held since e^(k log a) would be a^k; lower.c makes
 * an operation of it.
 *
 * Tests  tests/tape/test_logistic.c, tests/script/rests/far-sides.lag
 */
#ifndef QDOT_TAPE_LOGISTIC_H
#define QDOT_TAPE_LOGISTIC_H

#include "expr/walk.h"

/* Whether an expression contains exp, cosh or sinh, of which it may have quotients or logarithms. */
bool qdot_logistic_occurs(const qdot_walk *w);

/* The expression e, its quotients rewritten so that they do not overflow. Nil: a failure of the pool. */
qdot_expr qdot_logistic_form(qdot_pool *pool, qdot_expr e);

/* The argument d if e has the form log(1 + e^d); otherwise nil. */
qdot_expr qdot_logistic_argument(const qdot_pool *pool, qdot_expr e);

#endif
