/* antiderivative.h -- integrals that a table knows, and potentials of exact forms.
 *
 * A sum term by term; of a term the powers, exponentials, sines and cosines of something
 * linear in x, their products with powers of x (by parts), and what becomes one of these
 * when one of its parts is the variable: u in f(u) u'. The integral of 1/u is log(u), as
 * people write it, where u > 0. Not a decision: nil says that the
 * table does not know it.
 *
 * Tests  tests/normal/test_antiderivative.c: differentiated again, random and by hand
 */
#ifndef QDOT_NORMAL_ANTIDERIVATIVE_H
#define QDOT_NORMAL_ANTIDERIVATIVE_H

#include "normal/field/facts.h"

/* F with dF/dx = e, x a symbol; nil: not known, or the pool failed. */
qdot_expr qdot_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x,
                              const qdot_facts *facts);

/* F with dF/dx_i = a_i for i = 0 ... n - 1, proved; nil: not known, not exact, or the pool
 * failed. */
qdot_expr qdot_potential_of(qdot_pool *pool, size_t n, const qdot_expr *x,
                            const qdot_expr *a, const qdot_facts *facts);

#endif
