/* rest-continuation.c -- where curves of equilibria begin, and those that are known exactly alone. */
#include "sim/branches/rest-continuation.h"

#include <math.h>
#include <string.h>

#include "expr/symbol.h"
#include "mech/study/equilibrium-set.h"
#include "sim/branches/branch-points.h"
#include "sim/branches/rest-bifurcation.h"

/* Parts of the range of p at which equilibria are looked for: its ends, and some that are no special
 * values. */
static const double parts[] = {0, 1, 0.4871, 0.2363, 0.7639, 0.0013, 0.9989};
enum { PARTS = sizeof parts / sizeof *parts };

/* Steps over a cell of an exact curve, closer to its walls; places that are one. */
enum { STEPS = 64 };
static const double same = 1e-6;
/* Cells narrower than this part of the range of p are not searched. */
static const double narrow = 1e-12;

/* Places: at [count * m], owned. */
typedef struct {
    double *at;
    size_t count, m;
    size_t plain; /* the first of them, at the parts of the range */
} starts;

static qdot_status
starts_add(starts *s, const double *y, size_t count)
{
    double *all = qdot_realloc(s->at, (s->count + count + 1) * s->m * sizeof *all);

    if (all == NULL)
        return QDOT_ENOMEM;
    s->at = all;
    memcpy(all + s->count * s->m, y, count * s->m * sizeof *y);
    s->count += count;
    return QDOT_OK;
}

/* --- where to begin -------------------------------------------------------------------------- */

/* The members of the set at p. `existing`: of those whose conditions hold there. */
static qdot_status
add_members(const qdot_equilibrium_set *set, double p, bool existing, double *y, starts *to)
{
    const size_t n = set->c->n;

    for (size_t k = 0; k < set->member.n; k++) {
        bool exists, finite = true;

        y[n] = p;
        QDOT_TRY(qdot_equilibrium_set_place(set, k, y, &exists));
        for (size_t i = 0; i < n; i++)
            finite = finite && isfinite(y[i]);
        if (finite && !set->member.at[k].corner && (exists || !existing))
            QDOT_TRY(starts_add(to, y, 1));
    }
    return QDOT_OK;
}

/* Add the equilibria that a search at p finds. */
static qdot_status
add_searched(qdot_equilibrium_curve *c, double p, starts *to)
{
    double *some;
    size_t n;
    qdot_status status;

    QDOT_TRY(qdot_equilibrium_curve_starts(c, p, &some, &n));
    status = starts_add(to, some, n);
    qdot_free(some);
    return status;
}

/* Equilibria at some values of p: known exactly where the set is complete, else searched for; and one of each member
 * of the set in each cell. */
static qdot_status
find_starts(qdot_equilibrium_curve *c, const qdot_equilibrium_set *set, double *y, starts *to)
{
    const double least = set->wall.at[0], most = set->wall.at[set->wall.n - 1];

    for (size_t k = 0; k < PARTS; k++) {
        const double p = k == 1 ? most : least + parts[k] * (most - least);

        QDOT_TRY(set->complete ? add_members(set, p, false, y, to) : add_searched(c, p, to));
    }
    to->plain = to->count;
    for (size_t k = 1; k < set->wall.n; k++) {
        const double lo = set->wall.at[k - 1], hi = set->wall.at[k], p = lo + (hi - lo) / 2;

        QDOT_TRY(add_members(set, p, true, y, to));
        if (!set->complete && set->wall.n > 2 && hi - lo > narrow * (most - least))
            QDOT_TRY(add_searched(c, p, to));
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

/* --- exact curves ------------------------------------------------------------------------------ */

/* Of the places from which no curve is followed leave out those of member k. */
static qdot_status
leave_out_member(qdot_branch_search *s, const qdot_equilibrium_set *set, size_t k, double *y)
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

/* Points of member k over cell i, both walls among them, to the branch. */
static qdot_status
add_cell(qdot_branch_search *s, qdot_equilibrium_set *set, size_t k, size_t i, double *y, qdot_branch *branch)
{
    const size_t n = set->c->n;
    const double lo = set->wall.at[i], hi = set->wall.at[i + 1];

    for (int j = branch->n > 0; j <= STEPS; j++) {
        qdot_stability verdict = QDOT_STABILITY_UNDECIDED;
        bool exists, finite = true;

        y[n] = j == STEPS ? hi : lo + (hi - lo) * (1 - cos(M_PI * j / STEPS)) / 2;
        QDOT_TRY(qdot_equilibrium_set_place(set, k, y, &exists));
        for (size_t q = 0; q < n; q++)
            finite = finite && isfinite(y[q]);
        if (!finite)
            continue;
        QDOT_TRY(qdot_equilibrium_set_judge(set, k, y[n], &verdict));
        QDOT_TRY(qdot_branch_add(s->x, branch, y, verdict, 0));
    }
    return QDOT_OK;
}

/* Whether member k is a place at rest in cell i that no curve holds yet. */
static qdot_status
is_missing(qdot_branch_search *s, const qdot_equilibrium_set *set, size_t k, size_t i, double *y, bool *yes)
{
    bool known = false;

    y[set->c->n] = set->wall.at[i] + (set->wall.at[i + 1] - set->wall.at[i]) / 2;
    QDOT_TRY(qdot_equilibrium_set_place(set, k, y, yes));
    *yes = *yes && qdot_path_is_inside(s->x, y);
    if (*yes && !set->member.at[k].corner)
        QDOT_TRY(qdot_continuation_knows(s, y, &known));
    *yes = *yes && !known;
    return QDOT_OK;
}

/* Add member k as a branch over each sequence of cells in which it lies on no curve that was followed. */
static qdot_status
draw_member(qdot_branch_search *s, qdot_equilibrium_set *set, size_t k, double *y)
{
    const size_t cells = set->wall.n - 1;
    qdot_branch branch = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < cells && status == QDOT_OK; i++) {
        bool here, next = false;

        status = is_missing(s, set, k, i, y, &here);
        if (status != QDOT_OK || !here)
            continue;
        if (branch.n == 0)
            branch.end[0] = i == 0 ? QDOT_END_RANGE : QDOT_END_NO_REST;
        status = add_cell(s, set, k, i, y, &branch);
        if (status == QDOT_OK && i + 1 < cells)
            status = is_missing(s, set, k, i + 1, y, &next);
        if (status != QDOT_OK || next)
            continue;
        branch.end[1] = i + 1 == cells ? QDOT_END_RANGE : QDOT_END_NO_REST;
        status = qdot_vec_push(&s->all->branches, branch);
        if (status == QDOT_OK)
            branch = (qdot_branch){0};
        if (status == QDOT_OK)
            status = leave_out_member(s, set, k, y);
    }
    qdot_branch_clear(&branch);
    return status;
}

/* Whether no branch ends where a member of the set goes on. */
static bool
ends_are_walls(const qdot_branch_search *s, const qdot_equilibrium_set *set)
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

/* Draw the exact curves that are not followed: at corners, and of several equilibria that are one. */
static qdot_status
draw_exact(qdot_branch_search *s, qdot_equilibrium_set *set, double *y)
{
    for (size_t k = 0; k < set->member.n && !s->all->interrupted; k++)
        QDOT_TRY(draw_member(s, set, k, y));
    s->all->complete = set->complete && !s->all->interrupted && s->all->left.n == 0 && ends_are_walls(s, set);
    s->all->corners = !set->complete;
    s->all->families = set->families;
    return QDOT_OK;
}

/* --- all --------------------------------------------------------------------------------------- */

static qdot_status
follow_all(qdot_equilibrium_curve *c, qdot_equilibrium_set *set, qdot_branch_search *s)
{
    starts from = {.m = c->n + 1};
    double *y = qdot_calloc(c->n + 1, sizeof *y);
    qdot_status status = y ? find_starts(c, set, y, &from) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        places_find_sizes(c, from.at, from.plain > 0 ? from.plain : from.count, s->all->size);
        s->all->size[c->n] = s->x->most - s->x->least;
        qdot_path_scale(s->x, s->all->size);
        status = qdot_continuation_follow(s, from.at, from.count);
    }
    if (status == QDOT_OK)
        status = draw_exact(s, set, y);
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
        status = follow_all(c, &set, &s);
    status = qdot_continuation_finish(&s, status);
    if (out->interrupted && qdot_pool_check(c->pool) == QDOT_ENOMEM) /* the interruption is told */
        status = QDOT_ENOMEM;
    if (status == QDOT_OK && out->branches.n == 0 && !out->interrupted)
        status = qdot_fail(QDOT_EFAILED, out->complete ? "there is no equilibrium in this range, but at single values of %.100s"
                                                       : "no equilibrium was found that could be followed",
                           qdot_expr_symbol(c->pool, c->parameter)->name);
    qdot_equilibrium_set_end(&set);
    qdot_rest_bifurcations_end(&b);
    qdot_rest_path_end(&x);
    return status;
}
