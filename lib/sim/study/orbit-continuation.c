/* orbit-continuation.c -- begins at one orbit; how curves of orbits end. */
#include "sim/study/orbit-continuation.h"

#include <math.h>

#include "base/memory.h"
#include "sim/study/orbit-bifurcation.h"

/* A curve whose period has grown so many times, and goes on to do nothing else, leads to an orbit without one. */
static const double long_period = 2, mostly = 0.5;

/* Between points from and to of a branch, both at an end of it. */
static bool
grows(const qdot_path *x, const qdot_branch *b, size_t from, size_t to)
{
    const size_t T = 2 * (x->coordinates / 2);
    const double *y = b->y + from * x->width, *z = b->y + to * x->width;
    double least = INFINITY;

    for (size_t k = 0; k < b->n; k++)
        least = fmin(least, b->y[k * x->width + T]);
    return z[T] > long_period * least &&
           sqrt(x->weight[T]) * (z[T] - y[T]) > mostly * qdot_path_distance(x, y, z);
}

/* Ends at which the period grows without a bound. */
static void
name_ends(const qdot_path *x, qdot_continuation *all)
{
    for (size_t i = 0; i < all->branches.n; i++) {
        qdot_branch *b = &all->branches.at[i];

        for (size_t side = 0; side < 2 && b->n > 3; side++)
            if ((b->end[side] == QDOT_END_LOST || b->end[side] == QDOT_END_BLURRED ||
                 b->end[side] == QDOT_END_FAR) &&
                grows(x, b, side == 0 ? 2 : b->n - 3, side == 0 ? 0 : b->n - 1))
                b->end[side] = QDOT_END_PERIOD;
    }
}

static qdot_status
check_range(const qdot_orbit_path *x, double p)
{
    const qdot_orbit_of *of = &x->of;

    if (p >= of->least && p <= of->most)
        return QDOT_OK;
    return qdot_fail(QDOT_EINVAL, "the orbit has %s = %.10g, outside the range %.10g..%.10g",
                     of->parameter == QDOT_NIL ? "energy"
                                               : qdot_expr_symbol(of->scene->pool, of->parameter)->name,
                     p, of->least, of->most);
}

qdot_status
qdot_orbit_continuation_find(const qdot_orbit_of *of, qdot_continuation *out)
{
    const size_t most = qdot_orbit_path_most(of->scene->coordinates.n);
    qdot_orbit_path x = {0};
    qdot_branch_search s = {
        .x = &x.path, .find = qdot_orbit_bifurcation_find, .user = &x, .all = out};
    double *y = qdot_calloc(most, sizeof *y);
    qdot_status status = QDOT_ENOMEM;

    *out = (qdot_continuation){0};
    out->size = qdot_calloc(most, sizeof *out->size);
    if (y != NULL && out->size != NULL)
        status = qdot_orbit_path_begin(&x, of, out->size, y);
    if (status == QDOT_OK)
        status = check_range(&x, y[x.path.n]);
    if (status == QDOT_OK) {
        out->n = x.path.n;
        out->coordinates = x.path.coordinates;
        out->width = x.path.width;
        out->conserved = x.conserved;
        status = qdot_continuation_follow(&s, y, 1);
    }
    status = qdot_continuation_finish(&s, status);
    if (status == QDOT_OK && !x.driven) /* the drive makes the period */
        name_ends(&x.path, out);
    if (status == QDOT_OK && out->branches.n == 0 && !out->interrupted)
        status = qdot_fail(QDOT_EFAILED,
                           "no orbit near the run can be followed: it is not isolated (another "
                           "quantity is conserved), or unstable beyond what runs can tell");
    qdot_free(y);
    qdot_orbit_path_end(&x);
    return status;
}
