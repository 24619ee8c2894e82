/* fold-guess.c -- guesses a fold near a crossing from the cubic through four points of a curve. */
#include "sim/branches/fold-guess.h"

#include <math.h>
#include <string.h>

enum { POINTS = 4, HALVINGS = 60 };

/* Points are on one curve if the angle between their tangents is at most that with this cosine. */
static const double straight = 0.9;

/* The value at s of the cubic with values f_k at s = -3, -1, 1, 3. */
static double
evaluate_cubic(const double *f, size_t stride, double s)
{
    static const double at[POINTS] = {-3, -1, 1, 3};
    double sum = 0;

    for (int k = 0; k < POINTS; k++) {
        double part = f[(size_t)k * stride];

        for (int i = 0; i < POINTS; i++)
            if (i != k)
                part *= (s - at[i]) / (at[k] - at[i]);
        sum += part;
    }
    return sum;
}

/* The zero of a cubic between its outermost nodes, where its values have different signs. */
static double
zero_of_cubic(const double *f)
{
    double lo = -3, hi = 3;

    for (int k = 0; k < HALVINGS; k++) {
        const double middle = (lo + hi) / 2;

        if ((evaluate_cubic(f, 1, middle) > 0) == (f[0] > 0))
            lo = middle;
        else
            hi = middle;
    }
    return (lo + hi) / 2;
}

qdot_status
qdot_fold_guess(qdot_path *x, const qdot_path_point *a, const double *crossing, double h, double *y, bool *found)
{
    const size_t m = x->n + 1;
    double *places = qdot_malloc((POINTS * m + 1) * sizeof *places), slope[POINTS];
    qdot_path_point here = {0};
    qdot_status status = places ? qdot_path_point_begin(x, &here) : QDOT_ENOMEM;
    const double way = qdot_path_distance(x, a->y, crossing);

    *found = status == QDOT_OK;
    for (int k = 0; k < POINTS && *found; k++) {
        int steps;

        *found = qdot_path_go(x, a, way + (2 * k - 3) * h, &here, &steps) &&
                 qdot_path_product(x, a->t, here.t) > straight;
        slope[k] = here.t[x->n];
        memcpy(places + (size_t)k * m, here.y, m * sizeof *places);
    }
    *found = *found && slope[0] * slope[POINTS - 1] < 0;
    if (*found) {
        const double s = zero_of_cubic(slope);

        for (size_t i = 0; i < m; i++)
            y[i] = evaluate_cubic(places + i, m, s);
    }
    qdot_path_point_end(&here);
    qdot_free(places);
    return status == QDOT_OK ? x->failure : status;
}
