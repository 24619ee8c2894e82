/* orbit-continuation.c -- starts the continuation from one orbit, and finds how curves of orbits end. */
#include "sim/branches/orbit-continuation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/symbol.h"
#include "sim/branches/orbit-bifurcation.h"

/* A curve leads to an orbit of infinite period if its period has grown by the first factor and
 * mostly grows: the second is the least share of the change that must be growth. */
static const double long_period = 2, mostly = 0.5;

/* Orbits that close after more turns of the first are not followed; of those that close after the most turns these many
 * branches, from the first bifurcation on, of so many points. */
enum { MOST_TURNS = 4, MOST_DOUBLED = 4, MOST_POINTS = 500 };

/* Two branches have the same period doubling if their points differ by less than this, relative to
 * the sizes, plus their errors. */
static const double alike = 1e-6;

/* Whether the orbit's period grows without bound between points `from` and `to` of a branch, at one of its ends. */
static bool
period_grows(const qdot_path *x, const qdot_branch *b, size_t from, size_t to)
{
    const size_t T = 2 * (x->coordinates / 2);
    const double *y = b->y + from * x->width, *z = b->y + to * x->width;
    double least = INFINITY;

    for (size_t k = 0; k < b->n; k++)
        least = fmin(least, b->y[k * x->width + T]);
    return z[T] > long_period * least &&
           sqrt(x->weight[T]) * (z[T] - y[T]) > mostly * qdot_path_distance(x, y, z);
}

/* Mark the ends of branches at which the period grows without bound. */
static void
mark_ends_of_infinite_period(const qdot_path *x, qdot_continuation *all)
{
    for (size_t i = 0; i < all->branches.n; i++) {
        qdot_branch *b = &all->branches.at[i];

        for (size_t side = 0; side < 2 && b->n > 3; side++)
            if ((b->end[side] == QDOT_END_LOST || b->end[side] == QDOT_END_BLURRED ||
                 b->end[side] == QDOT_END_FAR) &&
                period_grows(x, b, side == 0 ? 2 : b->n - 3, side == 0 ? 0 : b->n - 1))
                b->end[side] = QDOT_END_PERIOD;
    }
}

static qdot_status
check_parameter_range(const qdot_orbit_path *x, double p)
{
    const qdot_orbit_of *of = &x->of;

    if (p >= of->least && p <= of->most)
        return QDOT_OK;
    return qdot_fail(QDOT_EINVAL, "the orbit has %s = %.10g, outside the range %.10g..%.10g",
                     of->parameter == QDOT_NIL ? "energy"
                                               : qdot_expr_symbol(of->scene->pool, of->parameter)->name,
                     p, of->least, of->most);
}

/* --- branches of doubled period ------------------------------------------------------------------ */

static qdot_status
start_continuation(qdot_orbit_path *x, const qdot_orbit_of *of, double **y, qdot_continuation *out)
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

/* Shorten rows y [width] of x to those of a path with fewer segments, by dropping the states
 * between later segments. */
static void
shorten_point_row(const qdot_path *x, const qdot_continuation *to, const double *y, double *out)
{
    memmove(out, y, to->n * sizeof *out); /* memmove, as rows are shortened in place */
    memmove(out + to->n, y + x->n, (to->width - to->n) * sizeof *out);
}

/* Whether y, rows of `to`, at which orbits of twice the period end, is that period doubling: of its first state, or of
 * the one after half of it. */
static bool
is_same_doubling(const qdot_path *once, const qdot_continuation *to, const qdot_bifurcation *d, const double *y)
{
    const size_t n = to->n, z = once->coordinates - 1;
    const double *const error = y + to->width;

    for (size_t k = 0; k < (once->half > 0 ? 2 : 1) && d->kind == QDOT_DOUBLING; k++) {
        double off = (fabs(y[n] - d->y[n]) - error[n] - d->error[n]) / to->size[n];

        for (size_t i = 0, j = k * once->half; i < z; i++, j++)
            off = fmax(off, (fabs(y[i] - d->y[j]) - error[i] - d->error[j]) / to->size[i]);
        if (off < alike)
            return true;
    }
    return false;
}

/* Move a bifurcation b of x to the list of `to` unless it is there already; *number: 1 + its index
 * in that list. */
static qdot_status
merge_bifurcation(const qdot_path *once, const qdot_path *x, qdot_bifurcation b, qdot_continuation *to,
                  size_t *number)
{
    const size_t w = to->width, T = once->coordinates - 1;
    double *const y = qdot_calloc(2 * w, sizeof *y);
    size_t i = b.kind == QDOT_HALVING ? 0 : to->bifurcations.n;
    qdot_status status = QDOT_OK;

    if (y == NULL)
        return QDOT_ENOMEM;
    shorten_point_row(x, to, b.y, y);
    shorten_point_row(x, to, b.error, y + w);
    while (i < to->bifurcations.n && !is_same_doubling(once, to, &to->bifurcations.at[i], y))
        i++;
    *number = i + 1;
    if (i < to->bifurcations.n) {
        to->bifurcations.at[i].reached = true;
        qdot_free(y);
        return QDOT_OK;
    }
    if (b.kind == QDOT_HALVING) { /* list it as a doubling: the orbit of half the period is on no branch */
        b.kind = QDOT_DOUBLING;
        b.reached = true;
        y[T] /= 2;
        y[w + T] /= 2;
    }
    b.y = y;
    b.error = y + w;
    status = qdot_vec_push(&to->bifurcations, b);
    if (status != QDOT_OK)
        qdot_free(y);
    return status;
}

/* Append the branches and bifurcations of `from` to `to`, where the first bifurcation of `from` is
 * number `at`. */
static qdot_status
merge_branches(const qdot_path *once, const qdot_path *x, qdot_continuation *from, size_t at, qdot_continuation *to)
{
    size_t *number = qdot_calloc(from->bifurcations.n, sizeof *number);
    qdot_status status = number ? QDOT_OK : QDOT_ENOMEM;

    to->interrupted = to->interrupted || from->interrupted;
    for (size_t i = 1; i < from->bifurcations.n && status == QDOT_OK; i++)
        status = merge_bifurcation(once, x, from->bifurcations.at[i], to, &number[i]);
    for (size_t i = 0; i < from->branches.n && status == QDOT_OK; i++) {
        qdot_branch *const b = &from->branches.at[i];

        number[0] = at + 1;
        for (size_t k = 0; k < b->n; k++) {
            /* copy in this order, as the shortened rows never overlap later ones */
            shorten_point_row(x, to, b->y + k * from->width, b->y + k * to->width);
            b->mark[k] = b->mark[k] > 0 ? number[b->mark[k] - 1] : 0;
        }
        status = qdot_vec_push(&to->branches, *b);
        if (status == QDOT_OK)
            *b = (qdot_branch){0};
    }
    qdot_free(number);
    return status;
}

static qdot_status follow_all_doublings(const qdot_orbit_of *of, const qdot_orbit_path *x, size_t turns, size_t first,
                                        qdot_continuation *out);

/* Follow the orbits of doubled period from the bifurcation with index `at` in `out`. */
static qdot_status
follow_doubled_orbits(const qdot_orbit_of *of, const qdot_orbit_path *once, size_t turns, size_t at, qdot_continuation *out)
{
    const size_t z = 2 * once->n, start = z + 1 + once->conserved;
    const double *const from = out->bifurcations.at[at].y;
    qdot_orbit_of doubled = *of;
    qdot_orbit_path x = {0};
    qdot_continuation found;
    qdot_branch_search s = {.x = &x.path, .find = qdot_orbit_bifurcation_find, .user = &x, .all = &found};
    qdot_bifurcation b = {.kind = QDOT_HALVING};
    double *y = NULL;
    qdot_status status;

    doubled.z = from;
    doubled.p = from[once->path.n];
    doubled.T = 2 * from[z];
    doubled.segments = 2 * once->K;
    s.most_points = 2 * turns < MOST_TURNS ? 0 : MOST_POINTS;
    status = start_continuation(&x, &doubled, &y, &found);
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
        mark_ends_of_infinite_period(&x.path, &found);
    if (status == QDOT_OK)
        status = follow_all_doublings(&doubled, &x, 2 * turns, 1, &found);
    if (status == QDOT_OK && found.branches.n == 0 && !found.interrupted)
        status = qdot_fail(QDOT_EFAILED, "none is found within the range");
    if (status == QDOT_OK) {
        out->bifurcations.at[at].reached = true;
        status = merge_branches(&once->path, &x.path, &found, at, out);
    }
    qdot_continuation_clear(&found);
    qdot_free(y);
    qdot_orbit_path_end(&x);
    return status;
}

/* Follow the branches of doubled period at all period doublings from bifurcation `first` on. */
static qdot_status
follow_all_doublings(const qdot_orbit_of *of, const qdot_orbit_path *x, size_t turns, size_t first, qdot_continuation *out)
{
    const size_t n = out->bifurcations.n, most = 2 * turns < MOST_TURNS ? n : turns < MOST_TURNS ? MOST_DOUBLED : 0;
    qdot_status status = QDOT_OK;
    size_t done = 0;

    for (size_t i = first; i < n && done < most && status == QDOT_OK && !out->interrupted; i++) {
        qdot_bifurcation *b = &out->bifurcations.at[i];

        if (b->kind != QDOT_DOUBLING || b->reached)
            continue;
        status = 2 * x->K > QDOT_FLOW_MOST_SEGMENTS
                     ? qdot_fail(QDOT_EFAILED, "they would need more than %d segments", QDOT_FLOW_MOST_SEGMENTS)
                     : follow_doubled_orbits(of, x, turns, i, out);
        b = &out->bifurcations.at[i];
        if (status != QDOT_OK)
            snprintf(b->reason, sizeof b->reason, "%.150s", qdot_last_error()->message);
        status = qdot_grave(status);
        done++;
    }
    return status;
}

/* --- the whole continuation ----------------------------------------------------------------------- */

qdot_status
qdot_orbit_continuation_find(const qdot_orbit_of *of, qdot_continuation *out)
{
    qdot_orbit_path x = {0};
    qdot_branch_search s = {
        .x = &x.path, .find = qdot_orbit_bifurcation_find, .user = &x, .all = out};
    double *y = NULL;
    qdot_status status = start_continuation(&x, of, &y, out);

    if (status == QDOT_OK)
        status = check_parameter_range(&x, y[x.path.n]);
    if (status == QDOT_OK)
        status = qdot_continuation_follow(&s, y, 1);
    status = qdot_continuation_finish(&s, status);
    if (status == QDOT_OK && !x.driven) /* the period does not grow if a drive determines it */
        mark_ends_of_infinite_period(&x.path, out);
    if (status == QDOT_OK)
        status = follow_all_doublings(of, &x, 1, 0, out);
    if (status == QDOT_OK && out->branches.n == 0 && !out->interrupted)
        status = qdot_fail(QDOT_EFAILED,
                           "no orbit near the run can be followed: it is not isolated (another "
                           "quantity is conserved), or unstable beyond what runs can tell");
    qdot_free(y);
    qdot_orbit_path_end(&x);
    return status;
}
