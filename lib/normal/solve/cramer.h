/* cramer.h -- solves small linear systems whose entries are too long to be expanded. */
#ifndef QDOT_NORMAL_CRAMER_H
#define QDOT_NORMAL_CRAMER_H

#include "expr/id.h"

enum { QDOT_CRAMER_MOST = 3 };

/* x_i = det A_i / det A by Cramer's rule, A_i being A with b in column i, the entries kept as they
 * are: nothing is expanded, nothing cancelled but common factors. A [n*n] row-major, b [n], x [n],
 * n <= QDOT_CRAMER_MOST; A is taken to be regular. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_cramer(qdot_pool *pool, uint32_t n, const qdot_expr *A,
                                        const qdot_expr *b, qdot_expr *x);

/* The determinant of A without expanding its entries; nil: the pool failed. */
qdot_expr qdot_cramer_determinant(qdot_pool *pool, uint32_t n, const qdot_expr *A);

#endif
