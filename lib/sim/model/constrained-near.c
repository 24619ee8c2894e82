/* constrained-near.c -- measures how near constraints are to being dependent on each other at a state. */
#include <math.h>

#include "sim/model/constrained-parts.h"
#include "sim/model/constrained.h"

bool
qdot_constrained_near(qdot_constrained *h, double t, const double *y, bool *rows)
{
    static const double near = 1e-3;
    qdot_constrained_level *all = h->at[QDOT_ACCELERATION];
    size_t failed;
    qdot_status status;

    qdot_constrained_load(h, t, y);
    qdot_constrained_metric(h, all);
    status = qdot_saddle_factor_fully(&all->saddle, &failed);
    if (status == QDOT_EINTR)
        return false;
    if (status == QDOT_OK ? all->saddle.rank == 0 || all->saddle.quality > near
                          : failed < h->plan->n)
        return false;
    return qdot_constrained_dependent(h->c, &all->saddle, all->row, near, rows);
}

double
qdot_constrained_remains(qdot_constrained *h, double t, const double *y, size_t *row)
{
    qdot_constrained_level *all = h->at[QDOT_ACCELERATION];
    double least = INFINITY;

    qdot_constrained_load(h, t, y);
    qdot_constrained_metric(h, all);
    (void)qdot_saddle_faded(&all->saddle); /* called for its side effect: it records the largest pivot */
    for (size_t k = 0; k < all->m; k++) {
        const double left = qdot_saddle_remains(&all->saddle, k);

        if (left < least) {
            least = left;
            *row = all->row ? all->row[k] : k;
        }
    }
    return least;
}

double
qdot_constrained_independence(qdot_constrained *h, double t, const double *y)
{
    qdot_constrained_level *all = h->at[QDOT_ACCELERATION];

    qdot_constrained_load(h, t, y);
    qdot_constrained_metric(h, all);
    return qdot_saddle_independence(&all->saddle);
}
