/* equilibrium-proved.c -- all places of rest in numbers, by exclusion: of few unknowns.
 *
 * Coordinates are searched in their declared domains, a turn of an angle, else everywhere; multipliers
 * everywhere (normal/solve/zeros.h). */
#include <math.h>

#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/study/equilibrium-search.h"
#include "normal/solve/zeros.h"

enum { MOST = 4 };

/* budgets[n]: the work allowed for finding all equilibria with n unknowns by exclusion, before random starts are tried. */
static const uint64_t budgets[MOST + 1] = {0, 20000, 60000, 120000, 80000};

static bool
domain_end_is_constant(const qdot_pool *pool, qdot_expr e)
{
    return e == QDOT_NIL ||
           (qdot_expr_node(pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN) == 0;
}

qdot_expr
qdot_rest_domain_end(const qdot_rest *rest, size_t k, int which)
{
    const qdot_symbol *q = qdot_expr_symbol(rest->pool, rest->system.unknowns.at[k]);
    qdot_expr end = which == 0 ? q->lo : q->hi;

    return end == QDOT_NIL || rest->bind == NULL ? end : rest->bind(rest->user, end);
}

qdot_window
qdot_rest_window(const qdot_rest *rest, size_t k, qdot_expr equations)
{
    qdot_expr u = rest->system.unknowns.at[k];
    const qdot_symbol *q = qdot_expr_symbol(rest->pool, u);
    qdot_window w = {.lo = qdot_rest_domain_end(rest, k, 0),
                     .hi = qdot_rest_domain_end(rest, k, 1),
                     .lo_open = q->lo_open,
                     .hi_open = q->hi_open};
    bool angle = k < rest->system.places && (w.lo == QDOT_NIL || w.hi == QDOT_NIL) &&
                 qdot_is_angle(rest->pool, equations, u, &rest->facts);

    return angle ? qdot_window_turn(rest->pool, w) : w;
}

/* Find where the k-th unknown is searched for; false: the ends of its domain are not known as numbers. */
static bool
find_unknown_range(const qdot_rest *rest, size_t k, qdot_expr equations, qdot_zeros_range *range)
{
    qdot_window w;

    *range = (qdot_zeros_range){.group = k >= rest->system.places};
    if (k >= rest->system.places)
        return true;
    w = qdot_rest_window(rest, k, equations);
    range->turn = w.turn;
    if (w.turn)
        return true;
    range->lo = w.lo;
    range->hi = w.hi;
    range->lo_open = w.lo_open;
    range->hi_open = w.hi_open;
    return domain_end_is_constant(rest->pool, range->lo) && domain_end_is_constant(rest->pool, range->hi);
}

bool
qdot_rest_is_sharp(size_t n, const double *at, const double *radius)
{
    for (size_t k = 0; k < n; k++)
        if (!(radius[k] <= 1e-12 * fmax(1, fabs(at[k]))))
            return false;
    return true;
}

qdot_status
qdot_rest_exclude(qdot_rest *rest, const qdot_expr *r, qdot_places *out)
{
    size_t n = rest->searched;
    qdot_expr equations = qdot_list(rest->pool, (uint32_t)n, r);
    qdot_zeros_range range[MOST];
    qdot_zeros zeros;
    qdot_status status;

    QDOT_TRY(qdot_pool_check(rest->pool));
    if (n == 0 || n > MOST)
        return QDOT_OK;
    for (size_t k = 0; k < n; k++)
        if (!find_unknown_range(rest, k, equations, &range[k]))
            return QDOT_OK;
    QDOT_TRY(qdot_pool_check(rest->pool));
    status =
        qdot_zeros_find(rest->pool, n, r, rest->system.unknowns.at, range, budgets[n], &zeros);
    if (status == QDOT_ETYPE || status == QDOT_EDOMAIN) /* equations that the search for zeros cannot handle */
        return QDOT_OK;
    QDOT_TRY(status);
    out->complete = zeros.complete && zeros.count <= QDOT_PLACES_MOST;
    for (size_t i = 0; i < zeros.count && out->n < QDOT_PLACES_MOST; i++) {
        if (!qdot_rest_is_sharp(n, zeros.at + i * n, zeros.radius + i * n)) {
            out->complete = false;
            continue;
        }
        for (size_t k = 0; k < n; k++)
            out->at[out->n * n + k] = zeros.at[i * n + k];
        out->n++;
    }
    qdot_zeros_clear(&zeros);
    return QDOT_OK;
}
