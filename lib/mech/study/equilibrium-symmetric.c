/* equilibrium-symmetric.c -- places that need no solving: every coordinate 0, or half a turn of an angle.
 *
 * Where no formula gives the rests and parameters have no values, those that a symmetry of the scene provides can
 * still be proved: the equations are put in and decided, or solved for multipliers. Of many coordinates 0 alone is tried. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "mech/study/equilibrium-search.h"
#include "normal/prove/decide.h"

enum { MOST_COORDINATES = 6, WORK_AT_A_PLACE = 1500 };

/* Whether all equations of a LIST are proved to hold. */
static bool
equations_hold(const qdot_rest *r, qdot_expr there)
{
    bool hold = there != QDOT_NIL;

    for (uint32_t i = 0; hold && i < qdot_expr_count(r->pool, there); i++)
        hold = qdot_is_zero(r->pool, qdot_expr_arg(r->pool, there, i), &r->facts);
    return hold;
}

/* Keep the place `known` if the equations hold there, with multipliers where they have some. */
static qdot_status
try_place(qdot_rest *r, qdot_expr known)
{
    qdot_simultaneous_branch b = {.known = known};
    const qdot_expr there = qdot_simultaneous_put(r->pool, r->system.equations, known);
    const bool multipliers = r->system.places < r->system.unknowns.n;
    const bool hold = !multipliers && equations_hold(r, there);
    const qdot_status status = qdot_pool_check(r->pool);

    if (status != QDOT_OK) /* the equations are singular at this place, which is therefore skipped */
        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    b.equations = multipliers ? there : qdot_list(r->pool, 0, NULL);
    if (multipliers) {
        r->system.work = WORK_AT_A_PLACE;
        return qdot_vec_push(&r->system.todo, b);
    }
    return hold ? qdot_simultaneous_emit(&r->system, &b) : QDOT_OK;
}

qdot_status
qdot_rest_symmetric(qdot_rest *r)
{
    qdot_pool *pool = r->pool;
    const size_t n = r->system.places;
    const bool many = n > MOST_COORDINATES;
    unsigned angles = 0;
    qdot_expr *at;
    qdot_status status = QDOT_OK;

    if (n == 0 || r->searched < r->system.unknowns.n)
        return QDOT_OK;
    at = qdot_calloc(n, sizeof *at);
    if (at == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n && !many; i++)
        if (qdot_is_angle(pool, r->system.equations, r->system.unknowns.at[i], &r->facts))
            angles |= 1u << i;
    for (unsigned half = 0; half <= angles && status == QDOT_OK; half++) {
        qdot_expr known;

        if ((half & ~angles) != 0)
            continue;
        for (size_t i = 0; i < n; i++)
            at[i] = qdot_rel(pool, QDOT_EQ, r->system.unknowns.at[i],
                             !many && half >> i & 1 ? QDOT_PI : QDOT_ZERO);
        known = qdot_list(pool, (uint32_t)n, at);
        status = qdot_pool_check(pool);
        if (status == QDOT_OK)
            status = try_place(r, known);
    }
    qdot_free(at);
    return status == QDOT_OK ? qdot_rest_solve(r) : status;
}
