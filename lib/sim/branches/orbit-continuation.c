/* orbit-continuation.c -- begins at one orbit; how curves of orbits end. */
#include "sim/branches/orbit-continuation.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "sim/branches/orbit-bifurcation.h"

/* A curve whose period has grown so many times, and goes on to do nothing else, leads to an orbit without one. */
static const double long_period = 2, mostly = 0.5;

/* Orbits that close after more turns of the first are not followed; of those that close after the most turns these many
 * branches, from the first bifurcation on, of so many points. */
enum { MOST_TURNS = 4, MOST_DOUBLED = 4, MOST_POINTS = 500 };

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

/* --- period doubling ----------------------------------------------------------------------------- */

static qdot_status
open(qdot_orbit_path *x, const qdot_orbit_of *of, double **y, qdot_continuation *out)
{
    const size_t most = qdot_orbit_path_most(of->scene->coordinates.n);

    *out = (qdot_continuation){0};
    *y = qdot_calloc(most, sizeof **y);
    out->size = qdot_calloc(most, sizeof *out->size);
    if (*y == NULL || out->size == NULL)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_orbit_path_begin(x, of, out->size, *y));
    out->n = x->path.n;
    out->coordinates = x->path.coordinates;
    out->width = x->path.width;
    out->conserved = x->conserved;
    return QDOT_OK;
}

/* Rows [width] of x, for orbits in fewer segments: the states between later ones are left out. */
static void
shorten(const qdot_path *x, const qdot_continuation *to, const double *y, double *out)
{
    memmove(out, y, to->n * sizeof *out); /* merge() shortens in place */
    memmove(out + to->n, y + x->n, (to->width - to->n) * sizeof *out);
}

/* Move the branches and bifurcations of `from` to `to`; the first bifurcation is number `at` there. */
static qdot_status
merge(const qdot_path *x, qdot_continuation *from, size_t at, qdot_continuation *to)
{
    const size_t w = to->width, before = to->bifurcations.n;

    to->interrupted = to->interrupted || from->interrupted;
    for (size_t i = 1; i < from->bifurcations.n; i++) {
        qdot_bifurcation b = from->bifurcations.at[i];
        double *const y = qdot_calloc(2 * w, sizeof *y);

        if (y == NULL)
            return QDOT_ENOMEM;
        shorten(x, to, b.y, y);
        shorten(x, to, b.error, y + w);
        b.y = y;
        b.error = y + w;
        if (qdot_vec_push(&to->bifurcations, b) != QDOT_OK) {
            qdot_free(y);
            return QDOT_ENOMEM;
        }
    }
    for (size_t i = 0; i < from->branches.n; i++) {
        qdot_branch *const b = &from->branches.at[i];

        for (size_t k = 0; k < b->n; k++) {
            shorten(x, to, b->y + k * from->width, b->y + k * w); /* forwards: w is not larger */
            if (b->mark[k] > 0)
                b->mark[k] = b->mark[k] == 1 ? at + 1 : before + b->mark[k] - 1;
        }
        QDOT_TRY(qdot_vec_push(&to->branches, *b));
        *b = (qdot_branch){0};
    }
    return QDOT_OK;
}

static qdot_status double_all(const qdot_orbit_of *of, const qdot_orbit_path *x, size_t turns, size_t first,
                              qdot_continuation *out);

/* From the bifurcation, number `at` of out, the orbits that close after two turns. */
static qdot_status
follow_double(const qdot_orbit_of *of, const qdot_orbit_path *once, size_t turns, size_t at, qdot_continuation *out)
{
    const size_t z = 2 * once->n, start = z + 1 + once->conserved;
    const double *const from = out->bifurcations.at[at].y;
    qdot_orbit_of doubled = *of;
    qdot_orbit_path x = {0};
    qdot_continuation found;
    qdot_branch_search s = {.x = &x.path, .find = qdot_orbit_bifurcation_find, .user = &x, .all = &found};
    qdot_bifurcation b = out->bifurcations.at[at];
    double *y = NULL;
    qdot_status status;

    doubled.z = from;
    doubled.p = from[once->path.n];
    doubled.T = 2 * from[z];
    doubled.segments = 2 * once->K;
    s.most_points = 2 * turns < MOST_TURNS ? 0 : MOST_POINTS;
    b.y = NULL;
    status = open(&x, &doubled, &y, &found);
    if (status == QDOT_OK) {
        b.y = qdot_calloc(2 * x.path.width + x.path.n + 1, sizeof *b.y);
        status = b.y ? QDOT_OK : QDOT_ENOMEM;
    }
    if (status == QDOT_OK) {
        memcpy(b.y, from, once->path.n * sizeof *y);
        b.y[z] = doubled.T;
        memcpy(b.y + once->path.n, from, z * sizeof *y);
        memcpy(b.y + once->path.n + z, from + start, (once->K - 1) * z * sizeof *y);
        b.y[x.path.n] = doubled.p;
        b.error = b.y + x.path.width;
        status = qdot_vec_push(&found.bifurcations, b);
    }
    if (status != QDOT_OK)
        qdot_free(b.y);
    if (status == QDOT_OK)
        status = qdot_orbit_bifurcation_double(&x, b.y, b.error + x.path.width);
    if (status == QDOT_OK)
        status = qdot_continuation_arm(&s, 0, b.error + x.path.width, 2 * turns < MOST_TURNS);
    status = qdot_continuation_finish(&s, status);
    if (status == QDOT_OK && !x.driven)
        name_ends(&x.path, &found);
    if (status == QDOT_OK)
        status = double_all(&doubled, &x, 2 * turns, 1, &found);
    if (status == QDOT_OK)
        status = merge(&x.path, &found, at, out);
    qdot_continuation_clear(&found);
    qdot_free(y);
    qdot_orbit_path_end(&x);
    return status;
}

/* Of all period doublings from number `first` on. */
static qdot_status
double_all(const qdot_orbit_of *of, const qdot_orbit_path *x, size_t turns, size_t first, qdot_continuation *out)
{
    const size_t n = out->bifurcations.n, most = 2 * turns < MOST_TURNS ? n : turns < MOST_TURNS ? MOST_DOUBLED : 0;
    qdot_status status = QDOT_OK;
    size_t done = 0;

    for (size_t i = first; i < n && done < most && status == QDOT_OK && !out->interrupted; i++) {
        if (out->bifurcations.at[i].kind != QDOT_DOUBLING || 2 * x->K > QDOT_FLOW_MOST_SEGMENTS)
            continue;
        status = qdot_grave(follow_double(of, x, turns, i, out));
        done++;
    }
    return status;
}

/* --- all ------------------------------------------------------------------------------------------ */

qdot_status
qdot_orbit_continuation_find(const qdot_orbit_of *of, qdot_continuation *out)
{
    qdot_orbit_path x = {0};
    qdot_branch_search s = {
        .x = &x.path, .find = qdot_orbit_bifurcation_find, .user = &x, .all = out};
    double *y = NULL;
    qdot_status status = open(&x, of, &y, out);

    if (status == QDOT_OK)
        status = check_range(&x, y[x.path.n]);
    if (status == QDOT_OK)
        status = qdot_continuation_follow(&s, y, 1);
    status = qdot_continuation_finish(&s, status);
    if (status == QDOT_OK && !x.driven) /* the drive makes the period */
        name_ends(&x.path, out);
    if (status == QDOT_OK)
        status = double_all(of, &x, 1, 0, out);
    if (status == QDOT_OK && out->branches.n == 0 && !out->interrupted)
        status = qdot_fail(QDOT_EFAILED,
                           "no orbit near the run can be followed: it is not isolated (another "
                           "quantity is conserved), or unstable beyond what runs can tell");
    qdot_free(y);
    qdot_orbit_path_end(&x);
    return status;
}
