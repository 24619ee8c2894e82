/* rest-continuation.c -- starts curves of equilibria, and adds curves known only by exact formulas. */
#include "sim/branches/rest-continuation.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/study/equilibrium-set.h"
#include "sim/branches/branch-points.h"
#include "sim/branches/rest-bifurcation.h"

/* Parts of the range of p at which equilibria are looked for: its ends, and some that are no special
 * values. */
static const double parts[] = {0, 1, 0.4871, 0.2363, 0.7639, 0.0013, 0.9989};
enum { PARTS = sizeof parts / sizeof *parts };

/* STEPS: points on an exact curve between two special values of p, denser near both ends. Starts
 * closer than `same` are one. */
enum { STEPS = 64 };
static const double same = 1e-6;
/* Fractions of an interval of p at which an exactly known curve is compared with the numerical ones. */
static const double inner[] = {0.4871, 0.2113, 0.8312, 0.0371, 0.9573};
enum { INNER = sizeof inner / sizeof *inner };
/* Intervals of p narrower than this fraction of its range are not searched. */
static const double narrow = 1e-12;

/* A list of points from which curves are followed: at [count * m], owned. */
typedef struct {
    double *at;
    size_t count, m;
    size_t plain; /* number of those points, the first ones, that were found at fixed fractions of the range of p */
} starts;

static qdot_status
append_start_points(starts *s, const double *y, size_t count)
{
    double *all = qdot_realloc(s->at, (s->count + count + 1) * s->m * sizeof *all);

    if (all == NULL)
        return QDOT_ENOMEM;
    s->at = all;
    memcpy(all + s->count * s->m, y, count * s->m * sizeof *y);
    s->count += count;
    return QDOT_OK;
}

/* --- points to start from -------------------------------------------------------------------- */

/* Add the equilibria of the exact set at p; `existing`: only those whose conditions of existence hold there. */
static qdot_status
append_exact_equilibria(const qdot_equilibrium_set *set, double p, bool existing, double *y, starts *to)
{
    const size_t n = set->c->n;

    for (size_t k = 0; k < set->member.n; k++) {
        bool exists, finite = true;

        y[n] = p;
        QDOT_TRY(qdot_equilibrium_set_place(set, k, y, &exists));
        for (size_t i = 0; i < n; i++)
            finite = finite && isfinite(y[i]);
        if (finite && !set->member.at[k].corner && (exists || !existing))
            QDOT_TRY(append_start_points(to, y, 1));
    }
    return QDOT_OK;
}

/* Add the equilibria that a numerical search at the parameter value p finds. */
static qdot_status
append_searched_equilibria(qdot_equilibrium_curve *c, double p, starts *to)
{
    double *some;
    size_t n;
    qdot_status status;

    QDOT_TRY(qdot_equilibrium_curve_starts(c, p, &some, &n));
    status = append_start_points(to, some, n);
    qdot_free(some);
    return status;
}

/* Equilibria at some values of p: known exactly where the set is complete, else searched for; and one of each member
 * of the set in each cell. */
static qdot_status
find_start_points(qdot_equilibrium_curve *c, const qdot_equilibrium_set *set, double *y, starts *to)
{
    const double least = set->wall.at[0], most = set->wall.at[set->wall.n - 1];

    for (size_t k = 0; k < PARTS; k++) {
        const double p = k == 1 ? most : least + parts[k] * (most - least);

        QDOT_TRY(set->complete ? append_exact_equilibria(set, p, false, y, to) : append_searched_equilibria(c, p, to));
    }
    to->plain = to->count;
    for (size_t k = 1; k < set->wall.n; k++) {
        const double lo = set->wall.at[k - 1], hi = set->wall.at[k], p = lo + (hi - lo) / 2;

        QDOT_TRY(append_exact_equilibria(set, p, true, y, to));
        if (!set->complete && set->wall.n > 2 && hi - lo > narrow * (most - least))
            QDOT_TRY(append_searched_equilibria(c, p, to));
    }
    return QDOT_OK;
}

/* The size of each unknown: 1 of angles; else how far the places, those of one p on the average, are
 * apart, or from 0. */
static void
find_typical_sizes(const qdot_equilibrium_curve *c, const double *at, size_t count, double *size)
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

/* --- curves known by formulas ------------------------------------------------------------------ */

/* Remove the points that lie on exact solution k from the list of points that are on no curve yet. */
static qdot_status
remove_points_on_solution(qdot_branch_search *s, const qdot_equilibrium_set *set, size_t k, double *y)
{
    const size_t m = set->c->n + 1;
    size_t kept = 0;

    for (size_t i = 0; i < s->all->left.n; i += m) {
        double *one = s->all->left.at + i;
        bool exists;

        y[m - 1] = one[m - 1];
        QDOT_TRY(qdot_equilibrium_set_place(set, k, y, &exists));
        if (exists && qdot_path_distance(s->x, one, y) < same)
            continue;
        memmove(s->all->left.at + kept, one, m * sizeof *one);
        kept += m;
    }
    s->all->left.n = kept;
    return QDOT_OK;
}

/* The limit y of exact solution k as p approaches an end of its interval. */
typedef struct {
    double *y;     /* [n + 1] the limit */
    bool finite;   /* finite limit; false: it grows without bound, as far as known */
    double error;  /* estimated error of each unknown */
} limit;

/* The limit of exact solution k at end w of interval i, from values at p ever closer to it, whose
 * differences must shrink. */
static qdot_status
find_limit(qdot_branch_search *s, const qdot_equilibrium_set *set, size_t k, size_t i, size_t w, limit *to)
{
    const size_t n = set->c->n;
    const double p = set->wall.at[w], width = set->wall.at[i + 1] - set->wall.at[i], inward = w == i ? 1 : -1,
                 least = fmax(1e-11 * width, 32 * DBL_EPSILON * fabs(p)),
                 step[] = {fmin(65536 * least, width / 4), fmin(256 * least, width / 16), least};
    double *room = qdot_calloc(2 * (n + 1), sizeof *room), *far = room, *near = room ? room + (n + 1) : NULL;
    double change[2] = {0};
    bool exists, finite = room != NULL;
    qdot_status status = room ? QDOT_OK : QDOT_ENOMEM;

    for (int j = 0; j < 3 && status == QDOT_OK; j++) {
        near[n] = p + inward * step[j];
        status = qdot_equilibrium_set_place(set, k, near, &exists);
        for (size_t q = 0; q < n; q++) {
            finite = finite && isfinite(near[q]);
            if (j > 0)
                change[j - 1] = fmax(change[j - 1], fabs(near[q] - far[q]) / s->all->size[q]);
        }
        memcpy(far, near, (n + 1) * sizeof *far);
    }
    to->finite = finite && (change[1] < fmin(0.6 * change[0], 0.05) || change[1] < 1e-9);
    to->error = 4 * change[1] + 1e-9;
    if (status == QDOT_OK) {
        to->y[n] = p; /* use the value at p itself if it equals the limit */
        status = qdot_equilibrium_set_place(set, k, to->y, &exists);
        for (size_t q = 0; q < n; q++)
            if (!(fabs(to->y[q] - near[q]) <= to->error * s->all->size[q]))
                to->y[q] = near[q];
    }
    qdot_free(room);
    return status;
}

/* Whether exact solution k is continuous from parameter interval i to the next. y [2 (n + 1)]: work space. */
static qdot_status
is_continuous(qdot_branch_search *s, const qdot_equilibrium_set *set, size_t k, size_t i, double *y, bool *yes)
{
    limit left = {.y = y}, right = {.y = y + set->c->n + 1};

    QDOT_TRY(find_limit(s, set, k, i, i + 1, &left));
    QDOT_TRY(find_limit(s, set, k, i + 1, i + 1, &right));
    *yes = left.finite && right.finite;
    for (size_t q = 0; q < set->c->n; q++)
        *yes = *yes && fabs(left.y[q] - right.y[q]) <= fmax(left.error, right.error) * s->all->size[q];
    return QDOT_OK;
}

/* Append the limit of exact solution k at end w of parameter interval i to the branch; *finite: it exists. */
static qdot_status
append_limit(qdot_branch_search *s, qdot_equilibrium_set *set, size_t k, size_t i, size_t w, qdot_stability verdict,
             double *y, qdot_branch *branch, bool *finite)
{
    limit at = {.y = y};

    QDOT_TRY(find_limit(s, set, k, i, w, &at));
    *finite = at.finite;
    return at.finite ? qdot_branch_add(s->x, branch, y, verdict, 0) : QDOT_OK;
}

/* Append points of exact solution k over interval i, including both ends, to the branch, and how it
 * ends there. */
static qdot_status
append_interval(qdot_branch_search *s, qdot_equilibrium_set *set, size_t k, size_t i, double *y, qdot_branch *branch)
{
    const size_t n = set->c->n;
    const double lo = set->wall.at[i], hi = set->wall.at[i + 1];
    qdot_stability verdict;
    bool exists, finite;

    QDOT_TRY(qdot_equilibrium_set_judge(set, k, lo + inner[0] * (hi - lo), &verdict));
    if (branch->n == 0) {
        QDOT_TRY(append_limit(s, set, k, i, i, verdict, y, branch, &finite));
        branch->end[0] = !finite ? QDOT_END_FAR : i == 0 ? QDOT_END_RANGE : QDOT_END_NO_REST;
    } else if (branch->stability[branch->n - 1] != verdict) {
        branch->stability[branch->n - 1] = QDOT_STABILITY_UNDECIDED;
    }
    for (int j = 1; j < STEPS; j++) {
        y[n] = lo + (hi - lo) * (1 - cos(M_PI * j / STEPS)) / 2;
        QDOT_TRY(qdot_equilibrium_set_place(set, k, y, &exists));
        if (exists)
            QDOT_TRY(qdot_branch_add(s->x, branch, y, verdict, 0));
    }
    QDOT_TRY(append_limit(s, set, k, i, i + 1, verdict, y, branch, &finite));
    branch->end[1] = !finite ? QDOT_END_FAR : i + 2 == set->wall.n ? QDOT_END_RANGE : QDOT_END_NO_REST;
    return QDOT_OK;
}

/* Whether another member lies so near y, a place of member k, that curves do not tell them apart. y: room for
 * [2 (n + 1)]. */
static qdot_status
has_close_solution(qdot_branch_search *s, const qdot_equilibrium_set *set, size_t k, double *y, bool *yes)
{
    const size_t n = set->c->n;
    double *other = y + n + 1;

    *yes = false;
    for (size_t l = 0; l < set->member.n && !*yes; l++) {
        bool exists, same_formula = true;

        for (uint32_t q = 0; q < n; q++)
            same_formula = same_formula && qdot_expr_arg(set->c->pool, set->member.at[l].value, q) ==
                                               qdot_expr_arg(set->c->pool, set->member.at[k].value, q);
        if (l == k || same_formula)
            continue;
        other[n] = y[n];
        QDOT_TRY(qdot_equilibrium_set_place(set, l, other, &exists));
        *yes = exists && qdot_path_distance(s->x, y, other) < 2 * same;
    }
    return QDOT_OK;
}

/* Whether member k is a place at rest in cell i that no curve holds yet: but for one place, where it may cross a curve.
 * Where that is in doubt, *whole becomes false. */
static qdot_status
is_missing_in_interval(qdot_branch_search *s, const qdot_equilibrium_set *set, size_t k, size_t i, double *y, bool *whole,
                       bool *yes)
{
    const qdot_equilibrium_member *one = &set->member.at[k];
    size_t exist = 0, inside = 0, known = 0, beside = 0;

    for (size_t j = 0; j < INNER; j++) {
        bool exists, knows = false, near = false;

        y[set->c->n] = set->wall.at[i] + inner[j] * (set->wall.at[i + 1] - set->wall.at[i]);
        QDOT_TRY(qdot_equilibrium_set_place(set, k, y, &exists));
        exist += exists;
        if (!exists || !qdot_path_is_inside(s->x, y))
            continue;
        inside++;
        if (!one->corner)
            QDOT_TRY(qdot_continuation_knows(s, y, &knows));
        if (knows)
            QDOT_TRY(has_close_solution(s, set, k, y, &near));
        known += knows;
        beside += near;
    }
    *yes = one->known && exist == INNER && inside == exist && known <= 1;
    *whole = *whole && (*yes || known == inside) && beside <= 1;
    return QDOT_OK;
}

/* Add exact solution k as a branch over each sequence of intervals marked in `missing`: there no
 * followed curve contains it. */
static qdot_status
add_missing_intervals(qdot_branch_search *s, qdot_equilibrium_set *set, size_t k, const bool *missing, double *y)
{
    const size_t cells = set->wall.n - 1;
    qdot_branch branch = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < cells && status == QDOT_OK; i++) {
        bool next = i + 1 < cells && missing[i] && missing[i + 1];

        if (!missing[i])
            continue;
        status = append_interval(s, set, k, i, y, &branch);
        if (status == QDOT_OK && next)
            status = is_continuous(s, set, k, i, y, &next);
        if (status != QDOT_OK || next)
            continue;
        status = qdot_vec_push(&s->all->branches, branch);
        if (status == QDOT_OK)
            branch = (qdot_branch){0};
        if (status == QDOT_OK)
            status = remove_points_on_solution(s, set, k, y);
    }
    qdot_branch_clear(&branch);
    return status;
}

/* Find the parameter intervals in which no curve contains exact solution k; *any: there is one at least. */
static qdot_status
find_missing_intervals(qdot_branch_search *s, const qdot_equilibrium_set *set, size_t k, double *y, bool *missing, bool *whole,
                       bool *any)
{
    *any = false;
    for (size_t i = 0; i + 1 < set->wall.n; i++) {
        QDOT_TRY(is_missing_in_interval(s, set, k, i, y, whole, &missing[i]));
        *any = *any || missing[i];
    }
    return QDOT_OK;
}

/* Add the missing intervals of exact solution k as branches; its stability changes only at ends of
 * intervals. */
static qdot_status
add_exact_solution(qdot_branch_search *s, qdot_equilibrium_set *set, size_t k, double *y, bool *whole)
{
    const size_t walls = set->wall.n;
    bool *missing = qdot_calloc(walls, sizeof *missing), any = false;
    qdot_status status = missing ? find_missing_intervals(s, set, k, y, missing, whole, &any) : QDOT_ENOMEM;

    if (status == QDOT_OK && any)
        status = qdot_equilibrium_set_add_verdicts(set, k);
    if (status == QDOT_OK && any && set->wall.n != walls) {
        qdot_free(missing);
        missing = qdot_calloc(set->wall.n, sizeof *missing);
        status = missing ? find_missing_intervals(s, set, k, y, missing, whole, &any) : QDOT_ENOMEM;
    }
    if (status == QDOT_OK && any)
        status = add_missing_intervals(s, set, k, missing, y);
    qdot_free(missing);
    return status;
}

/* Whether no branch ends at a point where an exact solution of the set continues. */
static bool
ends_only_at_interval_bounds(const qdot_branch_search *s, const qdot_equilibrium_set *set)
{
    const size_t n = set->c->n;

    for (size_t i = 0; i < s->all->branches.n; i++) {
        const qdot_branch *b = &s->all->branches.at[i];

        for (int side = 0; side < 2; side++) {
            const double p = b->y[(side == 0 ? 0 : b->n - 1) * (n + 1) + n];
            bool wall = b->end[side] != QDOT_END_LOST && b->end[side] != QDOT_END_FAR;

            if (b->end[side] == QDOT_END_STOPPED)
                return false;
            for (size_t k = 0; k < set->wall.n; k++)
                wall = wall || fabs(set->wall.at[k] - p) <= same * s->all->size[n];
            if (!wall)
                return false;
        }
    }
    return true;
}

/* Whether a branch passes through the value `at` of the parameter p. */
static bool
is_parameter_passed(const qdot_branch_search *s, double at)
{
    const size_t m = s->x->n + 1;

    for (size_t i = 0; i < s->all->branches.n; i++)
        for (size_t k = 1; k < s->all->branches.at[i].n; k++) {
            const double *y = s->all->branches.at[i].y + k * m;
            const bool on = y[m - 1] == at && k + 1 < s->all->branches.at[i].n;

            if ((y[-1] - at) * (y[on ? 2 * m - 1 : m - 1] - at) < 0)
                return true;
        }
    return false;
}

/* List expressions that are 0 at isolated values of p where energy or force is undefined on a branch. */
static qdot_status
list_undefined_parameters(qdot_branch_search *s, const qdot_equilibrium_set *set)
{
    qdot_pool *pool = set->c->pool;

    for (size_t i = 0; i < set->gap.n; i++) {
        const qdot_equilibrium_gap *one = &set->gap.at[i];

        if (is_parameter_passed(s, one->at) && !qdot_list_has(pool, s->all->undefined, one->what))
            s->all->undefined = qdot_list_appended(pool, s->all->undefined, 1, &one->what);
    }
    return qdot_pool_check(pool);
}

/* Draw the exact curves that are not followed: at corners, and of several equilibria that are one.
 * y: room for [2 (n + 1)]. */
static qdot_status
add_exact_curves(qdot_branch_search *s, qdot_equilibrium_set *set, double *y)
{
    bool whole = set->complete && ends_only_at_interval_bounds(s, set);

    for (size_t k = 0; k < set->member.n && !s->all->interrupted; k++)
        QDOT_TRY(add_exact_solution(s, set, k, y, &whole));
    s->all->complete = whole && !s->all->interrupted && s->all->left.n == 0;
    s->all->corners = !set->complete;
    s->all->families = set->families;
    return list_undefined_parameters(s, set);
}

/* --- the whole continuation -------------------------------------------------------------------- */

static qdot_status
follow_equilibrium_curves(qdot_equilibrium_curve *c, qdot_equilibrium_set *set, qdot_branch_search *s)
{
    starts from = {.m = c->n + 1};
    double *y = qdot_calloc(2 * (c->n + 1), sizeof *y);
    qdot_status status = y ? find_start_points(c, set, y, &from) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        find_typical_sizes(c, from.at, from.plain > 0 ? from.plain : from.count, s->all->size);
        s->all->size[c->n] = s->x->most - s->x->least;
        qdot_path_scale(s->x, s->all->size);
        status = qdot_continuation_follow(s, from.at, from.count);
    }
    if (status == QDOT_OK)
        status = add_exact_curves(s, set, y);
    qdot_free(from.at);
    qdot_free(y);
    return status;
}

qdot_status
qdot_rest_continuation_find(qdot_equilibrium_curve *c, double least, double most,
                            qdot_continuation *out)
{
    qdot_rest_path x = {0};
    qdot_rest_bifurcations b = {0};
    qdot_equilibrium_set set = {0};
    qdot_branch_search s = {
        .x = &x.path, .find = qdot_rest_bifurcation_find, .user = &b, .all = out};
    qdot_status status;

    *out = (qdot_continuation){.n = c->n, .coordinates = c->coordinates, .width = c->n + 1};
    out->size = qdot_calloc(c->n + 1, sizeof *out->size);
    if (out->size == NULL)
        return QDOT_ENOMEM;
    status = qdot_rest_path_begin(&x, c, least, most);
    if (status == QDOT_OK)
        status = qdot_rest_bifurcations_begin(&b, &x);
    if (status == QDOT_OK)
        status = qdot_equilibrium_set_begin(&set, c, least, most);
    if (status == QDOT_OK)
        status = follow_equilibrium_curves(c, &set, &s);
    status = qdot_continuation_finish(&s, status);
    if (out->interrupted && qdot_pool_check(c->pool) == QDOT_ENOMEM) /* the interruption is reported, not this failure */
        status = QDOT_ENOMEM;
    if (status == QDOT_OK && out->branches.n == 0 && !out->interrupted)
        status = qdot_fail(QDOT_EFAILED, out->complete ? "there is no equilibrium in this range, except at single values of %.100s"
                                                       : "no equilibrium was found that could be followed",
                           qdot_expr_symbol(c->pool, c->parameter)->name);
    qdot_equilibrium_set_end(&set);
    qdot_rest_bifurcations_end(&b);
    qdot_rest_path_end(&x);
    return status;
}
