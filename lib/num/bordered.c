/* bordered.c -- rows of full length, whatever n + m is: the compiler makes vectors of them. */
#include "num/bordered.h"

#include <math.h>

enum { most = QDOT_BORDERED_MOST };

/* Row k becomes what unknown k is by the others; they lose it. */
static void
exchange(size_t all, double (*K)[most], size_t k)
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

bool
qdot_bordered_invert(size_t n, size_t m, double (*K)[QDOT_BORDERED_MOST], double least)
{
    double whole[most];

    for (size_t k = 0; k < n; k++) {
        if (!(K[k][k] > 0 && K[k][k] < INFINITY))
            return false;
        exchange(n + m, K, k);
    }
    for (size_t k = n; k < n + m; k++)
        whole[k] = -K[k][k];
    for (size_t k = n; k < n + m; k++) {
        if (!(-K[k][k] > least * whole[k] && whole[k] < INFINITY))
            return false;
        exchange(n + m, K, k);
    }
    return true;
}
