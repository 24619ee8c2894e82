/* equilibrium-folds.c -- where curves of equilibria turn, by exclusion: F(u, p) = 0, det F_u(u, p) = 0. */
#include <math.h>

#include "expr/calculus.h"
#include "expr/exact.h"
#include "mech/study/equilibrium-set.h"
#include "normal/solve/cramer.h"
#include "normal/solve/zeros.h"

enum { MOST = 3, MOST_WALLS = 12 }; /* largest number of unknowns besides p; largest number of special values of p */

/* budgets[n]: the work allowed for a search in n unknowns and p. */
static const uint64_t budgets[MOST + 1] = {0, 30000, 40000, 40000};

static qdot_expr
jacobian_determinant(const qdot_equilibrium_curve *c)
{
    qdot_expr A[MOST * MOST];

    for (size_t i = 0; i < c->n; i++)
        for (size_t j = 0; j < c->n; j++)
            A[i * c->n + j] = qdot_diff(c->pool, c->F[i], c->unknown[j]);
    return qdot_cramer_determinant(c->pool, (uint32_t)c->n, A);
}

/* An end of the range of p as an expression if it is finite; nil for an infinite one. */
static qdot_expr
fold_range_end(qdot_pool *pool, double end)
{
    return isinf(end) ? QDOT_NIL : qdot_expr_of_double(pool, end);
}

qdot_status
qdot_equilibrium_set_add_folds(qdot_equilibrium_set *set)
{
    const qdot_equilibrium_curve *c = set->c;
    const size_t n = c->n, before = set->wall.n;
    const double least = set->wall.at[0], most = set->wall.at[before - 1];
    qdot_expr F[MOST + 1];
    qdot_zeros_range range[MOST + 1];
    qdot_zeros zeros;
    qdot_status status;

    if (n > MOST || c->moving)
        return QDOT_OK;
    for (size_t i = 0; i < n; i++) {
        F[i] = c->F[i];
        range[i] = (qdot_zeros_range){.lo = fold_range_end(c->pool, c->lo[i]),
                                      .hi = fold_range_end(c->pool, c->hi[i]),
                                      .turn = c->angle[i],
                                      .group = i >= c->coordinates};
    }
    F[n] = jacobian_determinant(c);
    range[n] = (qdot_zeros_range){.lo = fold_range_end(c->pool, least), .hi = fold_range_end(c->pool, most)};
    QDOT_TRY(qdot_pool_check(c->pool));
    status = qdot_zeros_find(c->pool, n + 1, F, c->unknown, range, budgets[n], &zeros);
    if (status == QDOT_ETYPE || status == QDOT_EDOMAIN) /* equations that the search for zeros cannot handle */
        return QDOT_OK;
    QDOT_TRY(status);
    for (size_t i = 0; i < zeros.count && set->wall.n < before + MOST_WALLS && status == QDOT_OK; i++)
        status = qdot_vec_push(&set->wall, zeros.at[i * (n + 1) + n]);
    for (size_t i = 0; i < zeros.doubts && set->wall.n < before + MOST_WALLS && status == QDOT_OK; i++)
        status = qdot_vec_push(&set->wall, zeros.doubt[i * (n + 1) + n]);
    qdot_zeros_clear(&zeros);
    qdot_equilibrium_set_sort_walls(set);
    return status;
}
