/* ball.c -- evaluates expressions in ball arithmetic, in one pass over their nodes. */
#include "normal/refute/ball.h"

#include <math.h>

#include "base/memory.h"
#include "expr/elliptic-ball.h"
#include "expr/exact.h"
#include "expr/function-ball.h"
#include "expr/integral-value.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"

/* --- functions in ball arithmetic -------------------------------------------------- */

/* Every domain error becomes an infinite or indeterminate ball, which is "not known"; so does the sign of what may
 * be 0. */
static void
evaluate_sign(arb_t y, const arb_t x)
{
    if (arb_is_positive(x))
        arb_one(y);
    else if (arb_is_negative(x))
        arb_set_si(y, -1);
    else if (arb_is_zero(x))
        arb_zero(y);
    else
        arb_indeterminate(y);
}

static size_t
ball_argument_index(const qdot_ball *b, qdot_expr e, uint32_t i)
{
    return qdot_walk_index(&b->walk, qdot_expr_arg(b->pool, e, i));
}

static bool
arguments_are_finite(const qdot_ball *b, qdot_expr e, uint32_t from)
{
    uint32_t n = qdot_expr_count(b->pool, e);

    for (uint32_t i = from; i < n; i++)
        if (b->known[ball_argument_index(b, e, i)] != 1)
            return false;
    return true;
}

/* Evaluate mod: x - y floor(x/y), which has the sign of y. */
static void
evaluate_mod(arb_t z, const arb_t x, const arb_t y, slong prec)
{
    arb_t quotient;

    arb_init(quotient);
    arb_div(quotient, x, y, prec);
    arb_floor(quotient, quotient, prec);
    arb_mul(quotient, quotient, y, prec);
    arb_sub(z, x, quotient, prec);
    arb_clear(quotient);
}

static bool
evaluate_function(qdot_ball *b, arb_t y, qdot_expr e, slong prec)
{
    uint32_t op = qdot_expr_node(b->pool, e)->op, n = qdot_expr_count(b->pool, e);

    if (op == QDOT_IF) {
        uint8_t truth = b->known[ball_argument_index(b, e, 0)];
        size_t branch;

        if (truth == 0)
            return false;
        branch = ball_argument_index(b, e, truth == 1 ? 1 : 2);
        arb_set(y, b->value + branch);
        return b->known[branch] == 1;
    }
    if (!arguments_are_finite(b, e, 0))
        return false;
    if (op == QDOT_SIGN) {
        evaluate_sign(y, b->value + ball_argument_index(b, e, 0));
    } else if (qdot_fun_ball_of(op) != NULL) {
        qdot_fun_ball_of(op)(y, b->value + ball_argument_index(b, e, 0), prec);
    } else if (op == QDOT_ATAN2) {
        arb_srcptr v = b->value + ball_argument_index(b, e, 0), u = b->value + ball_argument_index(b, e, 1);

        if (arb_contains_zero(v) && (arb_contains_zero(u) || (!arb_is_zero(v) && !arb_is_positive(u))))
            return false; /* give up: atan2 is undefined at the origin, and jumps from pi to -pi on the negative axis */
        arb_atan2(y, v, u, prec);
    } else if (qdot_is_elliptic(op)) {
        const arb_struct *x[3] = {NULL, NULL, NULL};

        for (uint32_t i = 0; i < n; i++)
            x[i] = b->value + ball_argument_index(b, e, i);
        qdot_elliptic_ball(y, op, n, x, prec);
    } else if (op == QDOT_LOOKUP) {
        qdot_lookup_ball(y, b->value + ball_argument_index(b, e, 0), b->value + ball_argument_index(b, e, 1));
    } else if (op == QDOT_MOD) {
        evaluate_mod(y, b->value + ball_argument_index(b, e, 0), b->value + ball_argument_index(b, e, 1), prec);
    } else if (op == QDOT_MIN || op == QDOT_MAX) {
        arb_set(y, b->value + ball_argument_index(b, e, 0));
        for (uint32_t i = 1; i < n; i++)
            (op == QDOT_MIN ? arb_min : arb_max)(y, y, b->value + ball_argument_index(b, e, i),
                                                 prec);
    } else {
        return false;
    }
    return true;
}

/* --- sums, products, relations ----------------------------------------------------- */

static bool
evaluate_sum(qdot_ball *b, arb_t y, qdot_expr e, slong prec)
{
    uint32_t n = qdot_expr_count(b->pool, e);

    if (!arguments_are_finite(b, e, 0))
        return false;
    arb_set_fmpq(y, qdot_expr_rational(b->pool, qdot_expr_arg(b->pool, e, 0)), prec);
    for (uint32_t i = 1; i < n; i += 2)
        arb_addmul(y, b->value + ball_argument_index(b, e, i), b->value + ball_argument_index(b, e, i + 1),
                   prec);
    return true;
}

static bool
evaluate_power(arb_t y, const arb_t base, const fmpq *x, const arb_t exponent, slong prec)
{
    if (x == NULL) {
        if (!arb_is_positive(base))
            return false;
        arb_pow(y, base, exponent, prec);
    } else if (fmpz_is_one(fmpq_denref(x))) {
        if (fmpq_sgn(x) < 0 && arb_contains_zero(base))
            return false;
        arb_pow_fmpz(y, base, fmpq_numref(x), prec);
    } else {
        if (!arb_is_nonnegative(base) || (fmpq_sgn(x) < 0 && arb_contains_zero(base)))
            return false;
        arb_pow_fmpq(y, base, x, prec);
    }
    return true;
}

static bool
evaluate_product(qdot_ball *b, arb_t y, qdot_expr e, slong prec)
{
    uint32_t n = qdot_expr_count(b->pool, e);
    bool known = arguments_are_finite(b, e, 0);
    arb_t factor;

    if (!known)
        return false;
    arb_init(factor);
    arb_set_fmpq(y, qdot_expr_rational(b->pool, qdot_expr_arg(b->pool, e, 0)), prec);
    for (uint32_t i = 1; i < n && known; i += 2) {
        known = evaluate_power(factor, b->value + ball_argument_index(b, e, i),
                               qdot_expr_rational(b->pool, qdot_expr_arg(b->pool, e, i + 1)),
                               b->value + ball_argument_index(b, e, i + 1), prec);
        arb_mul(y, y, factor, prec);
    }
    arb_clear(factor);
    return known;
}

static uint8_t
evaluate_relation(const qdot_ball *b, qdot_expr e)
{
    arb_srcptr l = b->value + ball_argument_index(b, e, 0), r = b->value + ball_argument_index(b, e, 1);

    if (!arguments_are_finite(b, e, 0))
        return 0;
    switch (qdot_expr_node(b->pool, e)->op) {
    case QDOT_EQ: return arb_eq(l, r) ? 1 : arb_ne(l, r) ? 2 : 0;
    case QDOT_LT: return arb_lt(l, r) ? 1 : arb_ge(l, r) ? 2 : 0;
    default: return arb_le(l, r) ? 1 : arb_gt(l, r) ? 2 : 0;
    }
}

static uint8_t
evaluate_logic(const qdot_ball *b, qdot_expr e)
{
    uint32_t n = qdot_expr_count(b->pool, e), op = qdot_expr_node(b->pool, e)->op;
    uint8_t all = op == QDOT_AND ? 1 : 2, decisive = op == QDOT_AND ? 2 : 1;

    if (op == QDOT_NOT) {
        uint8_t x = b->known[ball_argument_index(b, e, 0)];

        return x == 0 ? 0 : (uint8_t)(3 - x);
    }
    for (uint32_t i = 0; i < n; i++) {
        uint8_t x = b->known[ball_argument_index(b, e, i)];

        if (x == decisive)
            return decisive;
        if (x == 0)
            all = 0;
    }
    return all;
}

/* --- integrals --------------------------------------------------------------------- */

/* A definite integral without symbols, enclosed once: to some digits, whatever precision is asked for. */
static bool
evaluate_integral(qdot_ball *b, arb_t y, size_t i, qdot_expr e)
{
    enum { BITS = 160 };
    bool proved = false;

    if (b->known[i] == 1)
        return true;
    if (!qdot_integral_is_definite(b->pool, e) || (qdot_expr_node(b->pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN) != 0 ||
        !arguments_are_finite(b, e, 1))
        return false;
    return qdot_integral_value(y, b->pool, qdot_expr_arg(b->pool, e, 0), b->value + ball_argument_index(b, e, 1),
                               b->value + ball_argument_index(b, e, 2), BITS, &proved) == QDOT_OK &&
           proved;
}

/* --- evaluation of all nodes ------------------------------------------------------- */

qdot_status
qdot_ball_begin(qdot_ball *b, qdot_pool *pool, size_t n, const qdot_expr *e)
{
    b->pool = pool;
    QDOT_TRY(qdot_walk_begin_n(pool, n, e, &b->walk));
    b->value = qdot_malloc((b->walk.n + 1) * sizeof *b->value);
    b->known = qdot_calloc(b->walk.n + 1, 1);
    if (b->value == NULL || b->known == NULL) {
        qdot_walk_end(&b->walk);
        qdot_free(b->value);
        qdot_free(b->known);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < b->walk.n; i++)
        arb_init(b->value + i);
    return QDOT_OK;
}

void
qdot_ball_end(qdot_ball *b)
{
    for (size_t i = 0; i < b->walk.n; i++)
        arb_clear(b->value + i);
    qdot_free(b->value);
    qdot_free(b->known);
    qdot_walk_end(&b->walk);
}

void
qdot_ball_eval(qdot_ball *b, slong prec,
               bool (*of)(void *user, qdot_expr atom, arb_t value, slong prec),
               void *user)
{
    for (size_t i = 0; i < b->walk.n; i++) {
        qdot_expr e = b->walk.at[i];
        arb_ptr y = b->value + i;
        bool known = false;

        switch (qdot_expr_kind(b->pool, e)) {
        case QDOT_NUM:
            arb_set_fmpq(y, qdot_expr_rational(b->pool, e), prec);
            known = true;
            break;
        case QDOT_SYM:
            if (e == QDOT_TRUE || e == QDOT_FALSE) {
                b->known[i] = e == QDOT_TRUE ? 1 : 2;
                continue;
            }
            known = e == QDOT_PI || (of && of(user, e, y, prec));
            if (e == QDOT_PI)
                arb_const_pi(y, prec);
            break;
        case QDOT_UFUN: known = of && of(user, e, y, prec); break;
        case QDOT_SUM: known = evaluate_sum(b, y, e, prec); break;
        case QDOT_PROD: known = evaluate_product(b, y, e, prec); break;
        case QDOT_FUN: known = evaluate_function(b, y, e, prec); break;
        case QDOT_INTEGRAL: known = evaluate_integral(b, y, i, e); break;
        case QDOT_REL: b->known[i] = evaluate_relation(b, e); continue;
        case QDOT_LOGIC: b->known[i] = evaluate_logic(b, e); continue;
        default: break;
        }
        b->known[i] = known && arb_is_finite(y);
    }
}

arb_srcptr
qdot_ball_get(const qdot_ball *b, qdot_expr e)
{
    size_t i = qdot_walk_index(&b->walk, e);

    return i == SIZE_MAX || b->known[i] != 1 ? NULL : b->value + i;
}

int
qdot_ball_truth(const qdot_ball *b, qdot_expr e)
{
    size_t i = qdot_walk_index(&b->walk, e);

    return i == SIZE_MAX ? 0 : b->known[i];
}

bool
qdot_ball_double(qdot_pool *pool, qdot_expr e,
                 bool (*of)(void *user, qdot_expr atom, arb_t value, slong prec),
                 void *user, double *x)
{
    qdot_ball ball;
    arb_srcptr value;

    if (e == QDOT_NIL || qdot_ball_begin(&ball, pool, 1, &e) != QDOT_OK)
        return false;
    qdot_ball_eval(&ball, 64, of, user);
    value = qdot_ball_get(&ball, e);
    if (value != NULL)
        *x = arf_get_d(arb_midref(value), ARF_RND_NEAR);
    qdot_ball_end(&ball);
    return value != NULL;
}

qdot_interval
qdot_ball_bounds(qdot_pool *pool, qdot_expr e)
{
    enum { BITS = 128 };
    qdot_interval bounds = qdot_interval_whole;
    qdot_ball ball;
    arb_srcptr v;

    if (qdot_ball_begin(&ball, pool, 1, &e) != QDOT_OK)
        return bounds;
    qdot_ball_eval(&ball, BITS, NULL, NULL);
    v = qdot_ball_get(&ball, e);
    if (v != NULL) {
        arf_t end;

        arf_init(end);
        arb_get_lbound_arf(end, v, BITS);
        bounds.lo = arf_get_d(end, ARF_RND_FLOOR);
        arb_get_ubound_arf(end, v, BITS);
        bounds.hi = arf_get_d(end, ARF_RND_CEIL);
        arf_clear(end);
    }
    qdot_ball_end(&ball);
    return bounds;
}

qdot_interval
qdot_ball_domain(qdot_pool *pool, qdot_expr symbol)
{
    const qdot_expr lo = qdot_expr_symbol(pool, symbol)->lo, hi = qdot_expr_symbol(pool, symbol)->hi;

    return (qdot_interval){lo == QDOT_NIL ? -INFINITY : qdot_ball_bounds(pool, lo).lo,
                           hi == QDOT_NIL ? INFINITY : qdot_ball_bounds(pool, hi).hi};
}
