/* cramer.c -- Cramer's rule over expressions. */
#include "normal/cramer.h"

/* By the first row. */
qdot_expr
qdot_cramer_determinant(qdot_pool *pool, uint32_t n, const qdot_expr *A)
{
    qdot_expr sum = QDOT_ZERO;

    if (n == 1)
        return A[0];
    for (uint32_t k = 0; k < n; k++) {
        qdot_expr minor[(QDOT_CRAMER_MOST - 1) * (QDOT_CRAMER_MOST - 1)], term;
        uint32_t at = 0;

        if (A[k] == QDOT_ZERO)
            continue;
        for (uint32_t i = 1; i < n; i++)
            for (uint32_t j = 0; j < n; j++)
                if (j != k)
                    minor[at++] = A[i * n + j];
        term = qdot_mul(pool, A[k], qdot_cramer_determinant(pool, n - 1, minor));
        sum = k % 2 ? qdot_sub(pool, sum, term) : qdot_add(pool, sum, term);
    }
    return sum;
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
