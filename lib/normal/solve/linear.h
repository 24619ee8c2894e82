/* linear.h -- linear systems of equations. */
#ifndef QDOT_NORMAL_LINEAR_H
#define QDOT_NORMAL_LINEAR_H

#include "normal/field/facts.h"

/* Solve the n x n linear system A x = b symbolically, block by block, fraction-free, zero pivots
 * recognised by the normal form; small blocks whose expanded solution would be longer than the
 * given entries, by Cramer's rule (cramer.h). QDOT_ESINGULAR: *pivot is the column without a
 * pivot. QDOT_ELIMIT past the budget: the message says how large. A [n*n] row-major, b [n], x
 * [n]. */
QDOT_MUST_CHECK qdot_status qdot_solve_linear(qdot_pool *pool, uint32_t n,
                                              const qdot_expr *A, const qdot_expr *b,
                                              qdot_expr *x, uint32_t *pivot,
                                              const qdot_facts *facts);

#endif
