/* antiderivative.h -- integrals from a table, and potentials of exact forms.
 *
 * A sum is integrated term by term. A term may be a power, exponential, sine or cosine of
 * something linear in x, its product with a power of x (by parts), or become one of these by the
 * substitution of u in f(u) u'. The integral of 1/u is written log(u), for u > 0. This is no
 * decision: nil means that the table does not have the integral.
 *
 * Tests  tests/normal/solve/test_antiderivative.c: differentiated again, random and by hand
 */
#ifndef QDOT_NORMAL_ANTIDERIVATIVE_H
#define QDOT_NORMAL_ANTIDERIVATIVE_H

#include "normal/field/facts.h"

/* The antiderivative F with dF/dx = e, x a symbol; nil if none is known or the pool failed. */
qdot_expr qdot_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x,
                              const qdot_facts *facts);

/* F with dF/dx_i = a_i for i = 0 ... n - 1, proved; nil: not known, not exact, or the pool
 * failed. */
qdot_expr qdot_potential_of(qdot_pool *pool, size_t n, const qdot_expr *x,
                            const qdot_expr *a, const qdot_facts *facts);

#endif
