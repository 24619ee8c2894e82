/* bordered.c -- inverts a matrix ((M, A^T), (A, 0)); rows have a fixed length, so that the compiler can vectorise. */
#include "num/bordered.h"

#include <math.h>

enum { most = QDOT_BORDERED_MOST };

/* Solve row k for unknown k, and eliminate this unknown from the other rows. */
static void
exchange_pivot(size_t all, double (*K)[most], size_t k)
{
    const double inverse = 1 / K[k][k];

    K[k][k] = 1;
    for (size_t j = 0; j < most; j++)
        K[k][j] *= inverse;
    for (size_t i = 0; i < all; i++) {
        const double factor = K[i][k];

        if (i == k || factor == 0)
            continue;
        K[i][k] = 0;
        for (size_t j = 0; j < most; j++)
            K[i][j] -= factor * K[k][j];
    }
}

/* Invert S = A D^-1 A^T; false if a pivot shows that a row of A depends nearly on those before it. */
static bool
invert_schur(size_t m, double (*S)[most], double least)
{
    double whole[most];

    for (size_t k = 0; k < m; k++)
        whole[k] = S[k][k];
    for (size_t k = 0; k < m; k++) {
        if (!(S[k][k] > least * whole[k] && whole[k] < INFINITY))
            return false;
        exchange_pivot(m, S, k);
    }
    return true;
}

/* Invert by blocks: with W = D^-1 A^T and V = W S^-1,  K^-1 = [ D^-1 - V W^T   V ; V^T   -S^-1 ]. */
bool
qdot_bordered_invert_diagonal(size_t n, size_t m, double (*K)[QDOT_BORDERED_MOST],
                              double least)
{
    double S[most][most] = {{0}}, W[most][most], V[most][most], D[most];

    for (size_t i = 0; i < n; i++) {
        if (!(K[i][i] > 0 && K[i][i] < INFINITY))
            return false;
        D[i] = 1 / K[i][i];
        for (size_t k = 0; k < m; k++)
            W[k][i] = D[i] * K[n + k][i];
    }
    for (size_t k = 0; k < m; k++)
        for (size_t l = 0; l <= k; l++) {
            for (size_t i = 0; i < n; i++)
                S[k][l] += W[k][i] * K[n + l][i];
            S[l][k] = S[k][l];
        }
    if (!invert_schur(m, S, least))
        return false;
    for (size_t k = 0; k < m; k++)
        for (size_t i = 0; i < n; i++) {
            double sum = 0;

            for (size_t l = 0; l < m; l++)
                sum += S[k][l] * W[l][i];
            V[k][i] = K[i][n + k] = K[n + k][i] = sum;
        }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            double sum = i == j ? D[i] : 0;

            for (size_t k = 0; k < m; k++)
                sum -= V[k][i] * W[k][j];
            K[i][j] = sum;
        }
    for (size_t k = 0; k < m; k++)
        for (size_t l = 0; l < m; l++)
            K[n + k][n + l] = -S[k][l];
    return true;
}

bool
qdot_bordered_invert(size_t n, size_t m, double (*K)[QDOT_BORDERED_MOST], double least)
{
    double whole[most];

    for (size_t k = 0; k < n; k++) {
        if (!(K[k][k] > 0 && K[k][k] < INFINITY))
            return false;
        exchange_pivot(n + m, K, k);
    }
    for (size_t k = n; k < n + m; k++)
        whole[k] = -K[k][k];
    for (size_t k = n; k < n + m; k++) {
        if (!(-K[k][k] > least * whole[k] && whole[k] < INFINITY))
            return false;
        exchange_pivot(n + m, K, k);
    }
    return true;
}
