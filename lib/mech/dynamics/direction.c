/* direction.c -- friction along u/|u| written with sign(u): in a force divided by |u|, C/|u| becomes B sign(u). */
#include "mech/dynamics/direction.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

enum { MOST_DIRECTIONS = 64 };

/* One magnitude |u|, with the symbols that replace it and 1/|u| while a force is rewritten. */
typedef struct {
    qdot_expr length, u;       /* the magnitude |u|, and u itself */
    qdot_expr symbol, inverse; /* temporary symbols for |u| and 1/|u| */
} direction;

bool
qdot_is_inverse_magnitude(const qdot_pool *pool, qdot_expr product, uint32_t k, int64_t *power)
{
    return qdot_expr_is_function(pool, qdot_expr_arg(pool, product, k), QDOT_ABS)
           && qdot_expr_to_int(pool, qdot_expr_arg(pool, product, k + 1), power) && *power < 0
           && *power % 2 != 0;
}

/* The first |u| whose odd negative power is a factor in one of e [m], where u holds a velocity and |u| is not among
 * tried [n]; nil if there is none. */
static qdot_expr
find_speed_power(qdot_pool *pool, size_t m, const qdot_expr *e, size_t n, const qdot_expr *tried)
{
    qdot_expr found = QDOT_NIL;
    int64_t power;
    qdot_walk walk;

    if (qdot_walk_begin_n(pool, m, e, &walk) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < walk.n && found == QDOT_NIL; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD
                             && k + 1 < qdot_expr_count(pool, walk.at[i]);
             k += 2) {
            const qdot_expr length = qdot_expr_arg(pool, walk.at[i], k);
            bool known = false;

            for (size_t j = 0; j < n; j++)
                known = known || tried[j] == length;
            if (!known && qdot_is_inverse_magnitude(pool, walk.at[i], k, &power)
                && (qdot_expr_node(pool, length)->holds & QDOT_HAS_VELOCITY) != 0)
                found = length;
        }
    qdot_walk_end(&walk);
    return found;
}

/* A node with the symbol for |u| in place of |u|, and that for 1/|u| in its odd negative powers: |u|^-3 = (1/|u|) u^-2.
 * Nil: it holds none itself (qdot_walk_map then looks into its children). */
static qdot_expr
replace_magnitude(qdot_pool *pool, qdot_expr node, void *user)
{
    const direction *d = user;
    int64_t power;

    if (node == d->length)
        return d->symbol;
    if (qdot_expr_kind(pool, node) != QDOT_PROD)
        return QDOT_NIL;
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, node); k += 2)
        if (qdot_expr_arg(pool, node, k) == d->length && qdot_is_inverse_magnitude(pool, node, k, &power)) {
            qdot_expr rest = qdot_mul(pool, node, qdot_pow_int(pool, d->length, -power));

            rest = qdot_mul(pool, rest, qdot_pow_int(pool, d->u, power + 1));
            return qdot_mul(pool, d->inverse, qdot_walk_map(pool, rest, replace_magnitude, user));
        }
    return QDOT_NIL;
}

/* Whether a negative power of w is a factor anywhere in e. True also on failure: the pool keeps it. */
static bool
has_negative_power(qdot_pool *pool, qdot_expr e, qdot_expr w)
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

/* B, where C = B u and u = a (v - v0) is linear in v. It is found with w = v - v0: each term of the expanded C must
 * have the factor w. Nil if u is not linear in v or C is no multiple of u. */
static qdot_expr
divide_by_linear(qdot_pool *pool, qdot_expr C, qdot_expr u, qdot_expr v)
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
    if (qdot_pool_failed(pool) || has_negative_power(pool, B, w))
        return QDOT_NIL;
    back = qdot_sub(pool, v, v0);
    return qdot_div(pool, qdot_subs(pool, B, 1, &w, &back), a);
}

/* The quotient B = C/u, by division with respect to a velocity in which u is linear; nil: no velocity gives a quotient. */
static qdot_expr
divide_by_velocity(qdot_pool *pool, qdot_expr C, qdot_expr u)
{
    qdot_expr B = QDOT_NIL;
    qdot_walk walk;

    if (qdot_walk_begin(pool, u, &walk) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < walk.n && B == QDOT_NIL && !qdot_pool_failed(pool); i++)
        if (qdot_expr_kind(pool, walk.at[i]) == QDOT_SYM
            && (qdot_expr_node(pool, walk.at[i])->holds & QDOT_HAS_VELOCITY) != 0)
            B = divide_by_linear(pool, C, u, walk.at[i]);
    qdot_walk_end(&walk);
    return B;
}

/* e with B sign(u) for C/|u|, where |u| is `length`; e itself if e does not divide by |u| or C is no multiple of
 * u. */
static qdot_expr
replace_one_direction(qdot_pool *pool, qdot_expr e, qdot_expr length)
{
    direction d = {.length = length,
                   .u = qdot_expr_arg(pool, length, 0),
                   .symbol = qdot_symbol_get(pool, QDOT_FORMAL, "direction length"),
                   .inverse = qdot_symbol_get(pool, QDOT_FORMAL, "direction inverse")};
    const qdot_expr all = qdot_walk_map(pool, e, replace_magnitude, &d), zero = QDOT_ZERO;
    const qdot_expr C = all == QDOT_NIL ? QDOT_NIL : qdot_diff(pool, all, d.inverse);
    qdot_expr B, rest;

    if (qdot_pool_failed(pool) || qdot_expr_contains(pool, C, d.inverse))
        return e;
    B = divide_by_velocity(pool, C, d.u);
    if (qdot_pool_failed(pool) || B == QDOT_NIL)
        return e;
    rest = qdot_subs(pool, all, 1, &d.inverse, &zero);
    rest = qdot_add(pool, rest, qdot_mul(pool, B, qdot_fun1(pool, QDOT_SIGN, d.u)));
    return qdot_subs(pool, rest, 1, &d.symbol, &length);
}

static qdot_expr
replace_all_directions(qdot_pool *pool, qdot_expr e)
{
    qdot_expr tried[MOST_DIRECTIONS];

    for (size_t n = 0; n < MOST_DIRECTIONS && !qdot_pool_failed(pool); n++) {
        tried[n] = find_speed_power(pool, 1, &e, n, tried);
        if (tried[n] == QDOT_NIL)
            break;
        e = replace_one_direction(pool, e, tried[n]);
    }
    return qdot_pool_failed(pool) ? QDOT_NIL : e;
}

void
qdot_directions_as_signs(qdot_pool *pool, size_t n, qdot_expr *e)
{
    if (qdot_pool_failed(pool) || find_speed_power(pool, n, e, 0, NULL) == QDOT_NIL)
        return; /* nothing to do: most scenes contain no such power */
    for (size_t i = 0; i < n; i++)
        e[i] = replace_all_directions(pool, e[i]);
}
