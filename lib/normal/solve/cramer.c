/* cramer.c -- Cramer's rule for linear systems whose entries are expressions. */
#include "normal/solve/cramer.h"

#include "expr/build.h"
#include "expr/tensor.h"

qdot_expr
qdot_cramer_determinant(qdot_pool *pool, uint32_t n, const qdot_expr *A)
{
    return n == 1 ? A[0] : qdot_det(pool, qdot_matrix(pool, n, n, A));
}

qdot_status
qdot_cramer(qdot_pool *pool, uint32_t n, const qdot_expr *A, const qdot_expr *b,
            qdot_expr *x)
{
    qdot_expr below = qdot_cramer_determinant(pool, n, A);

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr put[QDOT_CRAMER_MOST * QDOT_CRAMER_MOST];

        for (uint32_t k = 0; k < n * n; k++)
            put[k] = k % n == i ? b[k / n] : A[k];
        x[i] = qdot_div(pool, qdot_cramer_determinant(pool, n, put), below);
    }
    return qdot_pool_check(pool);
}
