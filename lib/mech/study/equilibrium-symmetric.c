/* equilibrium-symmetric.c -- places that need no solving: every coordinate 0, or half a turn of an angle.
 *
 * Where no formula gives the rests and parameters have no values, those that a symmetry of the scene provides can
 * still be proved: the equations are put in and decided. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "mech/study/equilibrium-search.h"
#include "normal/prove/decide.h"

enum { MOST_COORDINATES = 6 };

/* Whether all equations at rest are proved to hold at given values. */
static bool
equations_hold_at(const qdot_rest *r, qdot_expr values)
{
    qdot_expr there = qdot_simultaneous_put(r->pool, r->system.equations, values);
    bool hold = there != QDOT_NIL;

    for (uint32_t i = 0; hold && i < qdot_expr_count(r->pool, there); i++)
        hold = qdot_is_zero(r->pool, qdot_expr_arg(r->pool, there, i), &r->facts);
    return hold;
}

qdot_status
qdot_rest_symmetric(qdot_rest *r)
{
    qdot_pool *pool = r->pool;
    size_t n = r->system.places;
    unsigned angles = 0;
    qdot_expr at[MOST_COORDINATES], none = qdot_list(pool, 0, NULL);

    if (n == 0 || n > MOST_COORDINATES || n < r->system.unknowns.n)
        return QDOT_OK;
    for (size_t i = 0; i < n; i++)
        if (qdot_is_angle(pool, r->system.equations, r->system.unknowns.at[i], &r->facts))
            angles |= 1u << i;
    for (unsigned half = 0; half < 1u << n; half++) {
        qdot_simultaneous_branch b = {.equations = none};
        qdot_status status;
        bool hold;

        if ((half & ~angles) != 0)
            continue;
        for (size_t i = 0; i < n; i++)
            at[i] = qdot_rel(pool, QDOT_EQ, r->system.unknowns.at[i], half >> i & 1 ? QDOT_PI : QDOT_ZERO);
        b.known = qdot_list(pool, (uint32_t)n, at);
        QDOT_TRY(qdot_pool_check(pool));
        hold = equations_hold_at(r, b.known);
        status = qdot_pool_check(pool);
        if (status == QDOT_EDOMAIN) /* the equations are singular at this place, which is therefore skipped */
            continue;
        QDOT_TRY(status);
        if (hold)
            QDOT_TRY(qdot_simultaneous_emit(&r->system, &b));
    }
    return qdot_rest_solve(r);
}
