/* rest-continuation.c -- where curves of equilibria begin. */
#include "sim/branches/rest-continuation.h"

#include <math.h>
#include <string.h>

#include "sim/branches/rest-bifurcation.h"

/* Parts of the range of p at which equilibria are looked for: its ends, and some that are no special
 * values. */
static const double parts[] = {0, 1, 0.4871, 0.2363, 0.7639, 0.0013, 0.9989};
enum { PARTS = sizeof parts / sizeof *parts };

/* Places at some values of p: at [count * (n + 1)], owned by the caller. */
static qdot_status
find_starts(qdot_equilibrium_curve *c, double least, double most, double **at, size_t *count)
{
    const size_t m = c->n + 1;

    for (size_t k = 0; k < PARTS; k++) {
        const double p = k == 1 ? most : least + parts[k] * (most - least);
        double *some, *all;
        size_t n;

        QDOT_TRY(qdot_equilibrium_curve_starts(c, p, &some, &n));
        all = qdot_realloc(*at, (*count + n + 1) * m * sizeof *all);
        if (all != NULL) {
            *at = all;
            memcpy(all + *count * m, some, n * m * sizeof *some);
            *count += n;
        }
        qdot_free(some);
        if (all == NULL)
            return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

/* The size of each unknown: 1 of angles; else how far the places, those of one p on the average, are
 * apart, or from 0. */
static void
places_find_sizes(const qdot_equilibrium_curve *c, const double *at, size_t count, double *size)
{
    const size_t m = c->n + 1;
    const double gaps = fmax(1, (double)count / PARTS - 1);

    for (size_t i = 0; i < c->n; i++) {
        double least = INFINITY, most = -INFINITY, large = 0;

        for (size_t k = 0; k < count; k++) {
            least = fmin(least, at[k * m + i]);
            most = fmax(most, at[k * m + i]);
            large = fmax(large, fabs(at[k * m + i]));
        }
        size[i] = most - least > 1e-3 * large ? (most - least) / gaps : large;
        if (c->angle[i] || !(size[i] > 1e-14))
            size[i] = 1;
    }
}

qdot_status
qdot_rest_continuation_find(qdot_equilibrium_curve *c, double least, double most,
                            qdot_continuation *out)
{
    qdot_rest_path x = {0};
    qdot_rest_bifurcations b = {0};
    qdot_branch_search s = {
        .x = &x.path, .find = qdot_rest_bifurcation_find, .user = &b, .all = out};
    double *at = NULL;
    size_t count = 0;
    qdot_status status;

    *out = (qdot_continuation){.n = c->n, .coordinates = c->coordinates, .width = c->n + 1};
    out->size = qdot_calloc(c->n + 1, sizeof *out->size);
    if (out->size == NULL)
        return QDOT_ENOMEM;
    status = qdot_rest_path_begin(&x, c, least, most);
    if (status == QDOT_OK)
        status = qdot_rest_bifurcations_begin(&b, &x);
    if (status == QDOT_OK)
        status = find_starts(c, least, most, &at, &count);
    if (status == QDOT_OK) {
        places_find_sizes(c, at, count, out->size);
        out->size[c->n] = most - least;
        qdot_path_scale(&x.path, out->size);
        status = qdot_continuation_follow(&s, at, count);
    }
    status = qdot_continuation_finish(&s, status);
    if (out->interrupted && qdot_pool_check(c->pool) == QDOT_ENOMEM) /* the interruption is told */
        status = QDOT_ENOMEM;
    if (status == QDOT_OK && out->branches.n == 0 && !out->interrupted)
        status = qdot_fail(QDOT_EFAILED, "no equilibrium was found that could be followed");
    qdot_free(at);
    qdot_rest_bifurcations_end(&b);
    qdot_rest_path_end(&x);
    return status;
}
