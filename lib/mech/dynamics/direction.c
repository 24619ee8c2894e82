/* direction.c -- each |u| that is divided by, one after another. */
#include "mech/dynamics/direction.h"

#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/walk.h"

enum { MOST_DIRECTIONS = 64 };

/* |u| and 1/|u| as symbols. */
typedef struct {
    qdot_expr length, u;       /* |u|, u */
    qdot_expr symbol, inverse; /* for |u|, 1/|u| */
} direction;

/* Whether factor k of a product is an odd negative power of |u|. */
static bool
is_odd_inverse(const qdot_pool *pool, qdot_expr product, uint32_t k, long *power)
{
    return qdot_expr_is_function(pool, qdot_expr_arg(pool, product, k), QDOT_ABS)
           && qdot_expr_to_int(pool, qdot_expr_arg(pool, product, k + 1), power) && *power < 0
           && *power % 2 != 0;
}

/* An |u| of a velocity that e divides by, other than those tried [n]; nil: none. */
static qdot_expr
find_length(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *tried)
{
    qdot_expr found = QDOT_NIL;
    long power;
    qdot_walk walk;

    if (qdot_walk_begin(pool, e, &walk) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < walk.n && found == QDOT_NIL; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD
                             && k + 1 < qdot_expr_count(pool, walk.at[i]);
             k += 2) {
            const qdot_expr length = qdot_expr_arg(pool, walk.at[i], k);
            bool known = false;

            for (size_t j = 0; j < n; j++)
                known = known || tried[j] == length;
            if (!known && is_odd_inverse(pool, walk.at[i], k, &power)
                && (qdot_expr_node(pool, length)->holds & QDOT_HAS_VELOCITY) != 0)
                found = length;
        }
    qdot_walk_end(&walk);
    return found;
}

/* |u| and its odd inverse powers by the symbols: |u|^-3 is (1/|u|) u^-2. */
static qdot_expr
put_symbols(qdot_pool *pool, qdot_expr node, void *user)
{
    const direction *d = user;
    long power;

    if (node == d->length)
        return d->symbol;
    if (qdot_expr_kind(pool, node) != QDOT_PROD)
        return QDOT_NIL;
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, node); k += 2)
        if (qdot_expr_arg(pool, node, k) == d->length && is_odd_inverse(pool, node, k, &power)) {
            qdot_expr rest = qdot_mul(pool, node, qdot_pow_int(pool, d->length, -power));

            rest = qdot_mul(pool, rest, qdot_pow_int(pool, d->u, power + 1));
            return qdot_mul(pool, d->inverse, qdot_walk_map(pool, rest, put_symbols, user));
        }
    return QDOT_NIL;
}

/* Whether e holds a negative power of w. */
static bool
divides(qdot_pool *pool, qdot_expr e, qdot_expr w)
{
    bool found = false;
    qdot_walk walk;

    if (qdot_walk_begin(pool, e, &walk) != QDOT_OK) {
        qdot_pool_fail(pool);
        return true;
    }
    for (size_t i = 0; i < walk.n; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD
                             && k + 1 < qdot_expr_count(pool, walk.at[i]);
             k += 2)
            found = found
                    || (qdot_expr_arg(pool, walk.at[i], k) == w
                        && qdot_expr_is_negative(pool, qdot_expr_arg(pool, walk.at[i], k + 1)));
    qdot_walk_end(&walk);
    return found;
}

/* B of C = B u, where u = a (v - v0) is linear in v; nil: there is none. With w = v - v0 every term of C holds
 * the factor w. */
static qdot_expr
divide_by(qdot_pool *pool, qdot_expr C, qdot_expr u, qdot_expr v)
{
    const qdot_expr a = qdot_diff(pool, u, v), w = qdot_symbol_get(pool, QDOT_FORMAL, "direction w");
    qdot_expr v0, shifted, B, back;

    if (qdot_pool_failed(pool) || a == QDOT_ZERO || qdot_expr_contains(pool, a, v))
        return QDOT_NIL;
    v0 = qdot_expand(pool, qdot_sub(pool, v, qdot_div(pool, u, a)));
    if (qdot_pool_failed(pool) || qdot_expr_contains(pool, v0, v))
        return QDOT_NIL;
    shifted = qdot_add(pool, v0, w);
    B = qdot_expand(pool, qdot_subs(pool, C, 1, &v, &shifted));
    B = qdot_expand(pool, qdot_div(pool, B, w));
    if (qdot_pool_failed(pool) || divides(pool, B, w))
        return QDOT_NIL;
    back = qdot_sub(pool, v, v0);
    return qdot_div(pool, qdot_subs(pool, B, 1, &w, &back), a);
}

/* The same, in the first velocity of u that allows it. */
static qdot_expr
divide(qdot_pool *pool, qdot_expr C, qdot_expr u)
{
    qdot_expr B = QDOT_NIL;
    qdot_walk walk;

    if (qdot_walk_begin(pool, u, &walk) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < walk.n && B == QDOT_NIL && !qdot_pool_failed(pool); i++)
        if (qdot_expr_kind(pool, walk.at[i]) == QDOT_SYM
            && (qdot_expr_node(pool, walk.at[i])->holds & QDOT_HAS_VELOCITY) != 0)
            B = divide_by(pool, C, u, walk.at[i]);
    qdot_walk_end(&walk);
    return B;
}

/* e with C/|u| as B sign(u); e itself if it is not of that form. */
static qdot_expr
read_one(qdot_pool *pool, qdot_expr e, qdot_expr length)
{
    direction d = {.length = length,
                   .u = qdot_expr_arg(pool, length, 0),
                   .symbol = qdot_symbol_get(pool, QDOT_FORMAL, "direction length"),
                   .inverse = qdot_symbol_get(pool, QDOT_FORMAL, "direction inverse")};
    const qdot_expr all = qdot_walk_map(pool, e, put_symbols, &d), zero = QDOT_ZERO;
    const qdot_expr C = all == QDOT_NIL ? QDOT_NIL : qdot_diff(pool, all, d.inverse);
    qdot_expr B, rest;

    if (qdot_pool_failed(pool) || qdot_expr_contains(pool, C, d.inverse))
        return e;
    B = divide(pool, C, d.u);
    if (qdot_pool_failed(pool) || B == QDOT_NIL)
        return e;
    rest = qdot_subs(pool, all, 1, &d.inverse, &zero);
    rest = qdot_add(pool, rest, qdot_mul(pool, B, qdot_fun1(pool, QDOT_SIGN, d.u)));
    return qdot_subs(pool, rest, 1, &d.symbol, &length);
}

qdot_expr
qdot_directions_as_signs(qdot_pool *pool, qdot_expr e)
{
    qdot_expr tried[MOST_DIRECTIONS];

    for (size_t n = 0; n < MOST_DIRECTIONS; n++) {
        if (qdot_pool_failed(pool) || (qdot_expr_node(pool, e)->holds & QDOT_HAS_FUN) == 0)
            break;
        tried[n] = find_length(pool, e, n, tried);
        if (tried[n] == QDOT_NIL)
            break;
        e = read_one(pool, e, tried[n]);
    }
    return qdot_pool_failed(pool) ? QDOT_NIL : e;
}
