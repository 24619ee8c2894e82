/* null-space.h -- linear relations between expressions, with coefficients free of motion.
 *
 * Of a matrix E [rows x n] all vectors c over Q(parameters) with
 *
 *     sum_j c_j E_ij = 0   for every row i, whatever q, q', q'', t and everything else
 *                          but the parameters are.
 *
 * The numerators over a common denominator are split into monomials of a field (field.h), the
 * coefficient of each of which must vanish; these, polynomials in the parameters, are eliminated
 * exactly.
 *
 * Tests  tests/normal/solve/test_solve.c
 */
#ifndef QDOT_NORMAL_NULL_SPACE_H
#define QDOT_NORMAL_NULL_SPACE_H

#include "expr/id.h"

/* E [rows*n] row-major. *basis [*m * n]: the vectors, one after another, owned by the caller
 * (qdot_free). Columns that come late are free (1 in one vector, 0 in the others) rather
 * than those that come early. Errors: QDOT_ELIMIT past the budget, QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_null_space(qdot_pool *pool, size_t rows, size_t n,
                                            const qdot_expr *E, qdot_expr **basis,
                                            size_t *m);

#endif
