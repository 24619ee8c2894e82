/* separation-split.c -- sums and products of a function of one coordinate and a function of the others. */
#include "mech/hamilton/separation-split.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/integral/antiderivative.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

bool
qdot_split_is_other(const qdot_split *x, qdot_expr e)
{
    return !qdot_expr_contains(x->pool, e, x->q) && !qdot_expr_contains(x->pool, e, x->p);
}

bool
qdot_split_is_own(const qdot_split *x, qdot_expr e)
{
    return !qdot_expr_contains_any(x->pool, e, x->n, x->oq) && !qdot_expr_contains_any(x->pool, e, x->n, x->op);
}

/* Whether all derivatives by (q or p) and (an other q or p) are proved to be 0. */
static bool
is_unmixed(const qdot_split *x, qdot_expr e)
{
    for (int k = 0; k < 2; k++) {
        const qdot_expr slope = qdot_diff(x->pool, e, k == 0 ? x->q : x->p);

        for (size_t i = 0; i < 2 * x->n; i++) {
            const qdot_expr by = i < x->n ? x->oq[i] : x->op[i - x->n];

            if (slope == QDOT_NIL)
                return false;
            if (qdot_expr_contains(x->pool, slope, by) && !qdot_is_zero(x->pool, qdot_diff(x->pool, slope, by), x->facts))
                return false;
        }
    }
    return true;
}

/* Add the terms of e that are unmixed to *own and *other; return the rest. */
static qdot_expr
split_terms(const qdot_split *x, qdot_expr e, qdot_expr *own, qdot_expr *other)
{
    const bool several = qdot_expr_kind(x->pool, e) == QDOT_SUM;
    const uint32_t n = several ? qdot_expr_count(x->pool, e) : 2;
    qdot_expr mixed = QDOT_ZERO;

    if (several)
        *own = qdot_add(x->pool, *own, qdot_expr_arg(x->pool, e, 0));
    for (uint32_t i = 1; i < n; i += 2) {
        const qdot_expr term = several ? qdot_mul(x->pool, qdot_expr_arg(x->pool, e, i), qdot_expr_arg(x->pool, e, i + 1)) : e;

        if (qdot_split_is_own(x, term))
            *own = qdot_add(x->pool, *own, term);
        else if (qdot_split_is_other(x, term))
            *other = qdot_add(x->pool, *other, term);
        else
            mixed = qdot_add(x->pool, mixed, term);
    }
    return mixed;
}

/* Numbers at which an expression is looked at, most often regular. */
static qdot_expr
place(qdot_pool *pool, int k)
{
    static const int top[] = {0, 2, 1, 1}, below[] = {1, 1, 2, 3};

    return qdot_expr_ratio(pool, top[k], below[k]);
}

/* e with numbers for some symbols; nil: it is not defined at any of them. */
static qdot_expr
at_numbers(const qdot_split *x, qdot_expr e, size_t n, const qdot_expr *symbols)
{
    for (int k = 0; k < 4; k++) {
        qdot_expr at = e;

        for (size_t i = 0; i < n && at != QDOT_NIL; i++)
            at = qdot_subs(x->pool, at, 1, &symbols[i], (qdot_expr[]){place(x->pool, k)});
        if (at != QDOT_NIL)
            return at;
        if (qdot_grave(qdot_pool_check(x->pool)) != QDOT_OK)
            break;
    }
    return QDOT_NIL;
}

/* The part of e, unmixed and free of p, that holds q. */
static qdot_expr
own_part(const qdot_split *x, qdot_expr e)
{
    const qdot_expr slope = qdot_simplify(x->pool, qdot_diff(x->pool, e, x->q), x->facts);
    qdot_expr own = slope != QDOT_NIL && qdot_split_is_own(x, slope) ? qdot_antiderivative(x->pool, slope, x->q, x->facts) : QDOT_NIL;

    return own != QDOT_NIL ? qdot_simplify(x->pool, own, x->facts) : at_numbers(x, e, x->n, x->oq);
}

/* Split the unmixed e whose terms are mixed: the terms with p, then q's part of what has no momentum, then what is left. */
static bool
split_whole(const qdot_split *x, qdot_expr e, qdot_expr *own, qdot_expr *other)
{
    qdot_pool *pool = x->pool;
    qdot_expr still = e, moving, rest;

    for (size_t i = 0; i < x->n; i++)
        still = qdot_subs(pool, still, 1, &x->op[i], (qdot_expr[]){QDOT_ZERO});
    moving = still;
    still = qdot_subs(pool, still, 1, &x->p, (qdot_expr[]){QDOT_ZERO});
    moving = qdot_simplify(pool, qdot_sub(pool, moving, still), x->facts);
    if (moving == QDOT_NIL || !qdot_split_is_own(x, moving))
        return false;
    if (!qdot_split_is_other(x, still))
        moving = qdot_add(pool, moving, own_part(x, still));
    if (moving == QDOT_NIL)
        return false;
    rest = qdot_simplify(pool, qdot_sub(pool, e, moving), x->facts);
    if (rest == QDOT_NIL || !qdot_split_is_other(x, rest))
        rest = at_numbers(x, qdot_sub(pool, e, moving), 2, (qdot_expr[]){x->q, x->p});
    *own = qdot_add(pool, *own, moving);
    *other = qdot_add(pool, *other, rest);
    return *own != QDOT_NIL && *other != QDOT_NIL && qdot_split_is_own(x, *own) && qdot_split_is_other(x, *other);
}

bool
qdot_split_sum(const qdot_split *x, qdot_expr e, qdot_expr *own, qdot_expr *other)
{
    qdot_expr rest;

    *own = *other = QDOT_ZERO;
    e = qdot_expand(x->pool, e);
    if (e == QDOT_NIL)
        return false;
    rest = split_terms(x, e, own, other);
    if (rest == QDOT_ZERO)
        return true;
    rest = qdot_expand(x->pool, qdot_simplify(x->pool, rest, x->facts));
    if (rest == QDOT_NIL)
        return false;
    rest = split_terms(x, rest, own, other);
    return rest == QDOT_ZERO || (rest != QDOT_NIL && is_unmixed(x, rest) && split_whole(x, rest, own, other));
}

qdot_expr
qdot_split_factor(const qdot_split *x, qdot_expr e)
{
    qdot_pool *pool = x->pool;
    qdot_expr own = QDOT_ONE, rest;

    if (e == QDOT_NIL)
        return e;
    if (qdot_split_is_own(x, e) || qdot_split_is_other(x, e))
        return qdot_split_is_own(x, e) ? e : QDOT_ONE;
    for (uint32_t i = 1; qdot_expr_kind(pool, e) == QDOT_PROD && i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr factor = qdot_pow(pool, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, i + 1));

        if (!qdot_split_is_own(x, factor) && !qdot_split_is_other(x, factor))
            own = QDOT_NIL;
        else if (own != QDOT_NIL && !qdot_split_is_other(x, factor))
            own = qdot_mul(pool, own, factor);
    }
    if (own != QDOT_NIL && qdot_expr_kind(pool, e) == QDOT_PROD)
        return own;
    own = at_numbers(x, e, x->n, x->oq);
    if (own == QDOT_NIL || own == QDOT_ZERO)
        return QDOT_NIL;
    rest = qdot_simplify(pool, qdot_div(pool, e, own), x->facts);
    return rest != QDOT_NIL && qdot_split_is_other(x, rest) ? qdot_simplify(pool, own, x->facts) : QDOT_NIL;
}
