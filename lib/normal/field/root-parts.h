/* root-parts.h -- splits an expression into its parts with different products of roots.
 *
 *     e = sum_k a_k R_k,    R_k different products of roots b^(1/2), b^(1/3) ... of moving bases,
 *                           a_k free of them
 *
 * Square roots of different polynomials without a common factor, and their products, are
 * independent over the rational functions (Besicovitch, J. London Math. Soc. 15 (1940) 3): e
 * vanishes if every a_k does, and the denominator of an a_k belongs to one R_k, not to all of
 * them.
 *
 * Tests  tests/script/mechanisms/three-bodies.lag, tests/normal/solve/test_solve.c (linear relations)
 */
#ifndef QDOT_NORMAL_ROOT_PARTS_H
#define QDOT_NORMAL_ROOT_PARTS_H

#include "base/memory.h"
#include "expr/id.h"

/* A matrix by rows of n coefficients, and the product of roots R_k that belongs to each row. */
typedef struct {
    size_t n;
    qdot_vec(qdot_expr) entries, roots;
} qdot_root_parts;

/* Expressions with at least this many roots of different sums are split. */
enum { QDOT_ROOTS_MANY = 3 };

/* Whether e contains at least QDOT_ROOTS_MANY roots of different sums. */
bool qdot_root_parts_many(qdot_pool *pool, qdot_expr e);

/* Add the rows into which E [n] splits: itself if it has one part. Two forms of one base count as
 * two bases, unless E is prepared (normal/field/prepare.h). Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_root_parts_add(qdot_pool *pool, qdot_root_parts *parts,
                                                const qdot_expr *E);
void qdot_root_parts_clear(qdot_root_parts *parts);

#endif
