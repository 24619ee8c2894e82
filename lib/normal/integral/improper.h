/* improper.h -- integrals from 0 to infinity of functions without an elementary antiderivative, from tables.
 *
 * For k, a > 0 (k below as well), each times what is free of x:
 *
 *     sin(k x)/x                 pi/2                    sin(k x^2), cos(k x^2)      sqrt(pi/(8 k))
 *     (sin(k x)/x)^2             pi k/2                  (1 - cos(k x))/x^2          pi k/2
 *     cos(k x)/(x^2 + a^2)       pi exp(-a k)/(2 a)      x sin(k x)/(x^2 + a^2)      pi exp(-a k)/2
 *     cos(k x)/(x^2 + a^2)^2     pi (1 + a k) exp(-a k)/(4 a^3)     x sin(k x)/(x^2 + a^2)^2     pi k exp(-a k)/(4 a)
 *     sin(k x)/sqrt(x), cos(k x)/sqrt(x)            sqrt(pi/(2 k))
 *     sin(k x)/x^(3/2), (1 - cos(k x))/x^(3/2)      sqrt(2 pi k)
 *     cos(k x)/(x^4 + p x^2 + q), q > 0:
 *         4 q > p^2               pi exp(-k w) (u cos(k u) + w sin(k u))/(4 u w c),   c = sqrt(q), 4 u^2 = 2 c - p, 4 w^2 = 2 c + p
 *         p > 0, p^2 > 4 q        pi (exp(-k u)/u - exp(-k w)/w)/(2 d),   d = sqrt(p^2 - 4 q), 2 u^2 = p - d, 2 w^2 = p + d
 *       and with x sin(k x), x^2 cos(k x), x^3 sin(k x) over it: derivatives of these by k
 *     exp(-a x) sin(k x)/x       atan(k/a)               (exp(-a x) - exp(-b x))/x   log(b/a)
 *     exp(-a x^2) cos(k x)       sqrt(pi/a) exp(-k^2/(4 a))/2
 *     x^n/(exp(k x) - 1)         |B| (2 pi/k)^(n + 1)/(2 (n + 1)),   n = 1, 3, 5 ..., B the Bernoulli number of n + 1
 *     x^n/(exp(k x) + 1)         the same times 1 - 2^-n
 *
 * Over the whole line twice that, where the integrand is even.
 *
 * Source  Gradshteyn & Ryzhik, 3.411, 3.434, 3.691, 3.721, 3.723, 3.727, 3.729, 3.741, 3.761, 3.782, 3.821, 3.896, 3.941
 * Tests   tests/script/integrals/improper.lag; bench/integrals, against mpmath
 */
#ifndef QDOT_INTEGRAL_IMPROPER_H
#define QDOT_INTEGRAL_IMPROPER_H

#include "normal/field/facts.h"

/* *value: the integral of e over x from 0 to infinity, or over the whole line; nil: the tables do not have it. Errors:
 * QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_improper(qdot_pool *pool, qdot_expr e, qdot_expr x, bool whole_line, const qdot_facts *facts,
                                          qdot_expr *value);

#endif
