/* rates.c -- first and second time derivatives of expressions along a motion. */
#include "sim/model/rates.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

typedef struct {
    qdot_expr e, first, second;
} rates;

typedef struct {
    qdot_pool *pool;
    const qdot_walk *w;
    rates *of;  /* [w->n] first and second rate of each node */
    bool gains; /* set if an exponent was not a positive integer */
} differentiation;

static rates
rates_of_node(const differentiation *d, qdot_expr e)
{
    return d->of[qdot_walk_index(d->w, e)];
}

static rates
rates_hold(qdot_pool *pool, rates r)
{
    r.first = qdot_hold(pool, r.first);
    r.second = qdot_hold(pool, r.second);
    return r;
}

static qdot_expr
multiply(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return qdot_mul(pool, a, b);
}

static qdot_expr
multiply_by_integer(qdot_pool *pool, int64_t n, qdot_expr a)
{
    return qdot_mul(pool, qdot_expr_int(pool, n), a);
}

static rates
rates_of_symbol(qdot_pool *pool, qdot_expr e)
{
    rates r = {e, QDOT_ZERO, QDOT_ZERO};

    const qdot_symbol *s = qdot_expr_symbol(pool, e);

    if (s->class == QDOT_TIME)
        r.first = QDOT_ONE;
    else if (s->class == QDOT_COORD && s->order == 0)
        r.first = qdot_symbol_jet(pool, e, 1);
    return r;
}

static rates
rates_of_sum(const differentiation *d, qdot_expr e)
{
    qdot_pool *pool = d->pool;
    rates r = {e, QDOT_ZERO, QDOT_ZERO};

    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        const rates part = rates_of_node(d, qdot_expr_arg(pool, e, i));
        const qdot_expr factor = qdot_expr_arg(pool, e, i + 1);

        r.first = qdot_add(pool, r.first, multiply(pool, factor, part.first));
        r.second = qdot_add(pool, r.second, multiply(pool, factor, part.second));
    }
    return rates_hold(pool, r);
}

static rates
rates_of_two_factors(qdot_pool *pool, rates a, rates b)
{
    rates r = {multiply(pool, a.e, b.e), QDOT_ZERO, QDOT_ZERO};

    r.first = qdot_add(pool, multiply(pool, a.first, b.e), multiply(pool, a.e, b.first));
    r.second = qdot_add(pool, multiply_by_integer(pool, 2, multiply(pool, a.first, b.first)),
                        qdot_add(pool, multiply(pool, a.second, b.e),
                                 multiply(pool, a.e, b.second)));
    return rates_hold(pool, r);
}

/* The time derivatives of P = b^r: P'' = (r b'' P + (r - 1) b' P')/b; for roots the divisor is P itself. */
static rates
rates_of_power(differentiation *d, rates b, qdot_expr r)
{
    qdot_pool *pool = d->pool;
    rates p = {qdot_pow(pool, b.e, r), QDOT_ZERO, QDOT_ZERO};
    const qdot_expr P = qdot_hold(pool, p.e);
    qdot_expr over;
    int64_t n;

    if (qdot_expr_to_int(pool, r, &n) && n > 0) {
        rates whole = b;

        for (; n > 1 && !qdot_pool_failed(pool); n--)
            whole = rates_of_two_factors(pool, whole, b);
        return whole;
    }
    d->gains = true;
    if (b.first == QDOT_ZERO && b.second == QDOT_ZERO)
        return p;
    if (r == QDOT_HALF) {
        p.first = qdot_hold(pool, qdot_div(pool, multiply(pool, r, b.first), P));
        p.second = qdot_sub(pool, multiply(pool, r, b.second), qdot_pow_int(pool, p.first, 2));
        p.second = qdot_div(pool, qdot_hold(pool, p.second), P);
        return rates_hold(pool, p);
    }
    over = qdot_hold(pool, b.e);
    p.first = qdot_hold(pool, qdot_div(pool, multiply(pool, r, multiply(pool, b.first, P)), over));
    p.second = qdot_add(pool, multiply(pool, r, multiply(pool, b.second, P)),
                        multiply(pool, qdot_sub(pool, r, QDOT_ONE), multiply(pool, b.first, p.first)));
    p.second = qdot_div(pool, qdot_hold(pool, p.second), over);
    return rates_hold(pool, p);
}

static bool
rates_of_product(differentiation *d, qdot_expr e, rates *to)
{
    qdot_pool *pool = d->pool;
    rates r = {qdot_expr_arg(pool, e, 0), QDOT_ZERO, QDOT_ZERO};

    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr exponent = qdot_expr_arg(pool, e, i + 1);

        if (qdot_expr_kind(pool, exponent) != QDOT_NUM)
            return false;
        r = rates_of_two_factors(pool, r, rates_of_power(d, rates_of_node(d, qdot_expr_arg(pool, e, i)), exponent));
    }
    *to = (rates){e, r.first, r.second};
    return true;
}

/* The time derivatives of f = sine or cosine of u: f'' = f_u u'' - f u'^2. */
static bool
rates_of_function(const differentiation *d, qdot_expr e, rates *to)
{
    qdot_pool *pool = d->pool;
    const uint32_t f = qdot_expr_node(pool, e)->op;
    const qdot_expr argument = qdot_expr_arg(pool, e, 0);
    const rates u = rates_of_node(d, argument);
    qdot_expr slope;

    if (f == QDOT_HOLD) {
        *to = (rates){e, u.first, u.second};
        return true;
    }
    if (f != QDOT_SIN && f != QDOT_COS)
        return false;
    slope = f == QDOT_SIN ? qdot_fun1(pool, QDOT_COS, argument)
                          : qdot_neg(pool, qdot_fun1(pool, QDOT_SIN, argument));
    to->e = e;
    to->first = multiply(pool, slope, u.first);
    to->second = qdot_sub(pool, multiply(pool, slope, u.second),
                          multiply(pool, e, qdot_pow_int(pool, u.first, 2)));
    *to = rates_hold(pool, *to);
    return true;
}

static bool
find_rates_of_node(differentiation *d, qdot_expr e, rates *to)
{
    switch (qdot_expr_kind(d->pool, e)) {
    case QDOT_NUM: *to = (rates){e, QDOT_ZERO, QDOT_ZERO}; return true;
    case QDOT_SYM: *to = rates_of_symbol(d->pool, e); return true;
    case QDOT_SUM: *to = rates_of_sum(d, e); return true;
    case QDOT_PROD: return rates_of_product(d, e, to);
    case QDOT_FUN: return rates_of_function(d, e, to);
    default: return false;
    }
}

qdot_status
qdot_rates_second(qdot_pool *pool, qdot_expr e, qdot_expr *second)
{
    qdot_walk w;
    differentiation d = {.pool = pool, .w = &w};
    bool known = true;

    *second = QDOT_NIL;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    d.of = qdot_calloc(w.n + 1, sizeof *d.of);
    for (size_t i = 0; d.of && i < w.n && known && !qdot_pool_failed(pool); i++)
        known = find_rates_of_node(&d, w.at[i], d.of + i);
    if (d.of && known && d.gains && !qdot_pool_failed(pool))
        *second = rates_of_node(&d, e).second;
    qdot_walk_end(&w);
    qdot_free(d.of);
    return d.of ? qdot_pool_check(pool) : QDOT_ENOMEM;
}
