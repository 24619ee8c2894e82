/* least-move.c -- the smallest change that satisfies a few constraints: A D^-1 A^T by Cholesky, on
 * the stack. */
#include "num/least-move.h"

#include <math.h>

/* Rows of A whose squared sine to the rows before is smaller are left to a rank-revealing method. */
static const double independent = 1e-6;

bool
qdot_least_move_factor(qdot_least_move *s, const double *A, const double *D, size_t step)
{
    const size_t n = s->n, m = s->m;

    for (size_t i = 0; i < n; i++) {
        const double d = 1 / D[i * step];

        if (!(d > 0 && d < INFINITY))
            return false;
        for (size_t k = 0; k < m; k++)
            s->W[k * n + i] = d * A[k * n + i];
    }
    for (size_t k = 0; k < m; k++)
        for (size_t l = 0; l <= k; l++) {
            double sum = 0, whole;

            for (size_t i = 0; i < n; i++)
                sum += s->W[k * n + i] * A[l * n + i];
            whole = sum;
            for (size_t j = 0; j < l; j++)
                sum -= s->L[k][j] * s->L[l][j];
            if (l < k) {
                s->L[k][l] = sum * s->L[l][l];
                continue;
            }
            if (!(sum > independent * whole && sum < INFINITY))
                return false;
            s->L[k][k] = 1 / sqrt(sum);
        }
    return true;
}

void
qdot_least_move_solve(const qdot_least_move *s, double *c, double *x)
{
    const size_t n = s->n, m = s->m;

    for (size_t k = 0; k < m; k++) {
        for (size_t j = 0; j < k; j++)
            c[k] -= s->L[k][j] * c[j];
        c[k] *= s->L[k][k];
    }
    for (size_t k = m; k-- > 0;) {
        for (size_t j = k + 1; j < m; j++)
            c[k] -= s->L[j][k] * c[j];
        c[k] *= s->L[k][k];
    }
    for (size_t i = 0; i < n; i++) {
        double sum = 0;

        for (size_t k = 0; k < m; k++)
            sum += s->W[k * n + i] * c[k];
        x[i] = sum;
    }
}
