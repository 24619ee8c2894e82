/* balance.c -- scales rows and columns of a matrix in turn until their norms are similar. */
#include "num/balance.h"

#include <math.h>
#include <stdbool.h>

enum { MOST_ROUNDS = 100 };

void
qdot_balance(size_t n, const double *A, double *d)
{
    bool changed = true;

    for (size_t i = 0; i < n; i++)
        d[i] = 1;
    for (int round = 0; round < MOST_ROUNDS && changed; round++) {
        changed = false;
        for (size_t i = 0; i < n; i++) {
            double row = 0, column = 0;
            int power;

            for (size_t j = 0; j < n; j++)
                if (j != i) {
                    row += fabs(A[i * n + j]) * d[j] / d[i];
                    column += fabs(A[j * n + i]) * d[i] / d[j];
                }
            if (!(row > 0) || !(column > 0) || !isfinite(row / column))
                continue;
            power = (int)llround(0.5 * log2(row / column));
            if (power == 0)
                continue;
            d[i] = ldexp(d[i], power);
            changed = true;
        }
    }
}
