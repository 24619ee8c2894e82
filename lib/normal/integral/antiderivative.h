/* antiderivative.h -- antiderivatives, and potentials of exact forms.
 *
 * integrate.h has the methods. Whatever they find is differentiated, and answered only if that is proved to be the
 * integrand. The integral of 1/u is log|u|, written log(u) where u > 0 is known. This is no decision: nil means that
 * no antiderivative was found.
 *
 * Tests  tests/normal/integral/test_antiderivative.c: differentiated again, random and by hand
 */
#ifndef QDOT_NORMAL_ANTIDERIVATIVE_H
#define QDOT_NORMAL_ANTIDERIVATIVE_H

#include "normal/field/facts.h"

/* The antiderivative F with dF/dx = e, x a symbol, whatever the values of parameters; nil if none is known or the pool
 * failed. */
qdot_expr qdot_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x,
                              const qdot_facts *facts);

/* The same; where the form depends on the sign of a parameter, if(CONDITION, F, G). Special values of parameters, for
 * which a divisor vanishes, are left out. */
qdot_expr qdot_antiderivative_by_cases(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts);

/* The same of a sum term by term where the whole is not found; what is not found stands as an integral (expr/integral.h). Nil
 * only where the pool failed. */
qdot_expr qdot_antiderivative_or_integral(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts);

/* F with dF/dx_i = a_i for i = 0 ... n - 1, proved; nil: not known, not exact, or the pool
 * failed. */
qdot_expr qdot_potential_of(qdot_pool *pool, size_t n, const qdot_expr *x,
                            const qdot_expr *a, const qdot_facts *facts);

#endif
