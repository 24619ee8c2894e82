/* generic-null.h -- linear relations between expressions, from their values at random points. Internal to mech/.
 *
 * Of a matrix E [rows x columns] of expressions, all c with sum_j c_j E_ij = 0 for every row at every point. The points are
 * random, so a relation found here is not proved; where the exact way (normal/solve/null-space.h) is too long, it says what
 * to prove.
 *
 * Tests   tests/mech/study/test_noether.c, tests/script/prove/darwin.lag
 */
#ifndef QDOT_MECH_GENERIC_NULL_H
#define QDOT_MECH_GENERIC_NULL_H

#include "mech/dynamics/generic.h"

/* *basis [*count * columns], orthonormal, owned by the caller; `at` has the symbols with the same values at all points,
 * its seed is not used. Errors: those of qdot_generic_evaluate, QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_generic_null(const qdot_pool *pool, size_t rows, size_t columns, const qdot_expr *e,
                                              const qdot_generic_point *at, double **basis, size_t *count);
/* The relations with rational coefficients, whatever all symbols are, in reduced form: the first entry of each vector that is
 * not 0 is 1, and 0 in the others. *count is 0 if some coefficient is no fraction of small numbers. */
QDOT_MUST_CHECK qdot_status qdot_generic_null_exact(qdot_pool *pool, size_t rows, size_t columns, const qdot_expr *e,
                                                    qdot_expr **basis, size_t *count);

#endif
