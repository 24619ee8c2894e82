/* equilibrium-ranges.c -- lists a region of equilibria in one free coordinate as intervals. */
#include "expr/build.h"
#include "expr/node.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-bands.h"
#include "mech/study/equilibrium-search.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"

/* The only coordinate in the conditions; nil if there is none or several. */
static qdot_expr
free_coordinate(const qdot_rest *r, qdot_expr conditions)
{
    qdot_expr found = QDOT_NIL;

    for (size_t i = 0; conditions != QDOT_NIL && i < r->s->coordinates.n; i++)
        if (qdot_expr_contains(r->pool, conditions, r->s->coordinates.at[i])) {
            if (found != QDOT_NIL)
                return QDOT_NIL;
            found = r->s->coordinates.at[i];
        }
    return found;
}

static qdot_status
append_interval(qdot_rest *r, const qdot_equilibrium *all, qdot_expr u, qdot_expr exists,
                const qdot_band *band, bool touched)
{
    qdot_pool *pool = r->pool;
    qdot_equilibrium one = {.equations = all->equations, .exists = exists, .touched = touched};
    qdot_expr ends[2];
    size_t n = 0;

    if (band->lo != QDOT_NIL && band->lo == band->hi) { /* the interval is a single point */
        qdot_expr at = qdot_rel(pool, QDOT_EQ, u, band->lo),
                  others = qdot_subs(pool, all->equations, 1, &u, &band->lo);

        if (others != QDOT_NIL)
            one.equations = qdot_list_appended(pool, qdot_list(pool, 1, &at),
                                               qdot_expr_count(pool, others),
                                               qdot_expr_args(pool, others));
    } else {
        if (band->lo != QDOT_NIL)
            ends[n++] = qdot_rel(pool, band->lo_open ? QDOT_LT : QDOT_LE, band->lo, u);
        if (band->hi != QDOT_NIL)
            ends[n++] = qdot_rel(pool, band->hi_open ? QDOT_LT : QDOT_LE, u, band->hi);
        one.range = n == 0 ? QDOT_NIL : qdot_list(pool, (uint32_t)n, ends);
        one.numeric_range = band->numeric;
    }
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_vec_push(&r->found, one);
}

/* Append a region with one free coordinate as intervals; *done: that was possible. */
static qdot_status
list_region_as_intervals(qdot_rest *r, const qdot_equilibrium *all, bool *done)
{
    qdot_pool *pool = r->pool;
    qdot_expr u = free_coordinate(r, all->exists), in[QDOT_CONDITIONS_MOST], exists = QDOT_NIL,
              room[QDOT_CONDITIONS_MOST];
    qdot_facts facts;
    size_t n = 0;
    qdot_bands bands;
    qdot_status status;

    *done = false;
    if (all->numeric || u == QDOT_NIL || qdot_expr_count(pool, all->exists) > QDOT_CONDITIONS_MOST)
        return QDOT_OK;
    for (uint32_t i = 0; i < qdot_expr_count(pool, all->exists); i++) {
        qdot_expr one = qdot_expr_arg(pool, all->exists, i);

        if (qdot_expr_kind(pool, one) != QDOT_REL || qdot_expr_node(pool, one)->op == QDOT_EQ)
            return QDOT_OK;
        if (qdot_expr_contains(pool, one, u))
            in[n++] = one;
        else
            exists = qdot_conditions_and(pool, exists, one);
    }
    facts = qdot_facts_and(pool, &r->facts, exists, room);
    status = qdot_bands_find(pool, u, n, in, &facts, &bands, done);
    if (status == QDOT_EDOMAIN) { /* a condition is undefined somewhere: leave the region as it is */
        *done = false;
        status = QDOT_OK;
    }
    if (bands.touched && r->s->coordinates.n > 1)
        *done = false;
    for (size_t i = 0; i < bands.at.n && *done; i++) /* do not list a point known in decimals among exact intervals */
        *done = !bands.at.at[i].numeric || bands.at.at[i].lo != bands.at.at[i].hi;
    if (*done && bands.also != QDOT_NIL)
        exists = qdot_conditions_all(pool, exists, bands.also);
    if (exists == QDOT_FALSE)
        bands.at.n = 0;
    for (size_t i = 0; i < bands.at.n && *done && status == QDOT_OK; i++)
        status = append_interval(r, all, u, exists, &bands.at.at[i], bands.touched);
    if (*done && bands.whole && status == QDOT_OK)
        status = append_interval(r, all, u, exists, &(qdot_band){0}, bands.touched);
    qdot_bands_clear(&bands);
    return status;
}

qdot_status
qdot_rest_ranges(qdot_rest *r)
{
    size_t n = r->found.n;
    qdot_equilibrium *before = r->found.at;
    qdot_status status = QDOT_OK;

    r->found.at = NULL;
    r->found.n = r->found.capacity = 0;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        bool done;

        status = list_region_as_intervals(r, &before[i], &done);
        if (status == QDOT_OK && !done)
            status = qdot_vec_push(&r->found, before[i]);
    }
    qdot_free(before);
    return status == QDOT_OK ? qdot_pool_check(r->pool) : status;
}
