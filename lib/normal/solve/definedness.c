/* definedness.c -- where an expression is defined, as a set of conditions. */
#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/solve/conditions.h"

/* --- where a function is defined ------------------------------------------------------ */

/* The set with lo <= u <= hi, or lo < u < hi if `open`; a nil end adds nothing. */
static qdot_expr
conditions_add_bounds(qdot_pool *pool, qdot_expr set, qdot_expr u, qdot_expr lo, qdot_expr hi, bool open)
{
    qdot_rel_op op = open ? QDOT_LT : QDOT_LE;

    if (lo != QDOT_NIL)
        set = qdot_conditions_and(pool, set, qdot_rel(pool, op, lo, u));
    if (hi != QDOT_NIL)
        set = qdot_conditions_and(pool, set, qdot_rel(pool, op, u, hi));
    return set;
}

static qdot_expr
conditions_of_function(qdot_pool *pool, qdot_expr set, qdot_expr node)
{
    qdot_expr u = qdot_expr_count(pool, node) == 0 ? QDOT_NIL : qdot_expr_arg(pool, node, 0);

    switch (qdot_expr_node(pool, node)->op) {
    case QDOT_LOG:
        return conditions_add_bounds(pool, set, u, QDOT_ZERO, QDOT_NIL, true);
    case QDOT_ASIN:
    case QDOT_ACOS:
        return conditions_add_bounds(pool, set, u, QDOT_MINUS_ONE, QDOT_ONE, false);
    case QDOT_ATANH:
        return conditions_add_bounds(pool, set, u, QDOT_MINUS_ONE, QDOT_ONE, true);
    case QDOT_ACOSH:
        return conditions_add_bounds(pool, set, u, QDOT_ONE, QDOT_NIL, false);
    default:
        return set;
    }
}

/* The set, and that bases of powers with exponents that are no integers are not negative, or positive where the exponent
 * may be negative. */
static qdot_expr
conditions_of_powers(qdot_pool *pool, qdot_expr set, qdot_expr product, qdot_expr x)
{
    for (uint32_t i = 1; i < qdot_expr_count(pool, product); i += 2) {
        qdot_expr base = qdot_expr_arg(pool, product, i),
                  exponent = qdot_expr_arg(pool, product, i + 1);
        const fmpq *q = qdot_expr_rational(pool, exponent);

        if ((x != QDOT_NIL && !qdot_expr_contains(pool, base, x)) ||
            (q != NULL && fmpz_is_one(fmpq_denref(q))))
            continue;
        set = conditions_add_bounds(pool, set, base, QDOT_ZERO, QDOT_NIL, q == NULL || fmpq_sgn(q) < 0);
    }
    return set;
}

/* A function that adds to the set the conditions of one node of f; of factors only those that
 * contain x (nil: all). */
typedef qdot_expr conditions_of_part(qdot_pool *pool, qdot_expr set, qdot_expr part, qdot_expr x);

static qdot_expr
conditions_of_parts(qdot_pool *pool, qdot_expr f, qdot_expr x, conditions_of_part *of_part)
{
    qdot_expr set = QDOT_NIL;
    qdot_walk w;

    if (qdot_walk_begin(pool, f, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n; i++)
        if (x == QDOT_NIL || qdot_expr_contains(pool, w.at[i], x))
            set = of_part(pool, set, w.at[i], x);
    qdot_walk_end(&w);
    return set;
}

qdot_expr
qdot_conditions_of_function(qdot_pool *pool, qdot_expr function)
{
    return conditions_of_function(pool, QDOT_NIL, function);
}

static qdot_expr
domain_of_part(qdot_pool *pool, qdot_expr set, qdot_expr part, qdot_expr x)
{
    if (qdot_expr_kind(pool, part) == QDOT_FUN)
        return conditions_of_function(pool, set, part);
    return qdot_expr_kind(pool, part) == QDOT_PROD ? conditions_of_powers(pool, set, part, x) : set;
}

qdot_expr
qdot_conditions_of_domain(qdot_pool *pool, qdot_expr f, qdot_expr x)
{
    return conditions_of_parts(pool, f, x, domain_of_part);
}

/* --- where it is divided -------------------------------------------------------------- */

static qdot_expr
conditions_of_pole(qdot_pool *pool, qdot_expr set, qdot_expr node)
{
    qdot_expr u = qdot_expr_count(pool, node) == 0 ? QDOT_NIL : qdot_expr_arg(pool, node, 0);

    switch (qdot_expr_node(pool, node)->op) {
    case QDOT_TAN:
    case QDOT_SEC: return qdot_conditions_and_nonzero(pool, set, qdot_fun1(pool, QDOT_COS, u));
    case QDOT_COT:
    case QDOT_CSC: return qdot_conditions_and_nonzero(pool, set, qdot_fun1(pool, QDOT_SIN, u));
    default: return set;
    }
}

static qdot_expr
divisors_of_part(qdot_pool *pool, qdot_expr set, qdot_expr part, qdot_expr x)
{
    if (qdot_expr_kind(pool, part) == QDOT_FUN)
        return conditions_of_pole(pool, set, part);
    if (qdot_expr_kind(pool, part) != QDOT_PROD)
        return set;
    for (uint32_t k = 1; k < qdot_expr_count(pool, part); k += 2) {
        qdot_expr base = qdot_expr_arg(pool, part, k);
        const fmpq *q = qdot_expr_rational(pool, qdot_expr_arg(pool, part, k + 1));

        if (q != NULL && fmpq_sgn(q) < 0 && (x == QDOT_NIL || qdot_expr_contains(pool, base, x)))
            set = qdot_conditions_and_nonzero(pool, set, base);
    }
    return set;
}

qdot_expr
qdot_conditions_of_divisors(qdot_pool *pool, qdot_expr f, qdot_expr x)
{
    return conditions_of_parts(pool, f, x, divisors_of_part);
}
