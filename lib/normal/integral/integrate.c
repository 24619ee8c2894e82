/* integrate.c -- chooses the method for an integrand: constants in front, sums apart, then by the functions that occur. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/integral/circular.h"
#include "normal/integral/methods.h"
#include "normal/integral/rational.h"

void
qdot_integral_split(qdot_pool *pool, qdot_expr term, qdot_expr x, qdot_expr *free, qdot_expr *rest)
{
    *free = QDOT_ONE;
    *rest = term;
    if (qdot_expr_kind(pool, term) != QDOT_PROD)
        return;
    *free = qdot_expr_arg(pool, term, 0);
    *rest = QDOT_ONE;
    for (uint32_t i = 1; i < qdot_expr_count(pool, term); i += 2) {
        qdot_expr factor = qdot_pow(pool, qdot_expr_arg(pool, term, i), qdot_expr_arg(pool, term, i + 1));
        qdot_expr *to = qdot_expr_contains(pool, factor, x) ? rest : free;

        *to = qdot_mul(pool, *to, factor);
    }
}

qdot_expr
qdot_integral_slope(qdot_pool *pool, qdot_expr u, qdot_expr x)
{
    const qdot_expr slope = qdot_diff(pool, u, x);

    return slope == QDOT_NIL || qdot_expr_contains(pool, slope, x) ? QDOT_NIL : slope;
}

/* --- the table ----------------------------------------------------------------------- */

/* The integral of f(u) du; nil if the table does not have it. */
static qdot_expr
integral_of_function(qdot_integral_task *t, qdot_fun_id id, qdot_expr u)
{
    qdot_pool *pool = t->pool;

    switch (id) {
    case QDOT_SIN: return qdot_neg(pool, qdot_fun1(pool, QDOT_COS, u));
    case QDOT_COS: return qdot_fun1(pool, QDOT_SIN, u);
    case QDOT_EXP: return qdot_fun1(pool, QDOT_EXP, u);
    case QDOT_SINH: return qdot_fun1(pool, QDOT_COSH, u);
    case QDOT_COSH: return qdot_fun1(pool, QDOT_SINH, u);
    case QDOT_TANH: return qdot_fun1(pool, QDOT_LOG, qdot_fun1(pool, QDOT_COSH, u));
    case QDOT_TAN: return qdot_neg(pool, qdot_integral_log(t, qdot_fun1(pool, QDOT_COS, u)));
    case QDOT_COT: return qdot_integral_log(t, qdot_fun1(pool, QDOT_SIN, u));
    case QDOT_ABS: return qdot_mul(pool, QDOT_HALF, qdot_mul(pool, u, qdot_fun1(pool, QDOT_ABS, u)));
    case QDOT_SIGN: return qdot_fun1(pool, QDOT_ABS, u);
    default: return QDOT_NIL;
    }
}

/* The integral of a derivative of an undefined function in its only argument that moves. */
static qdot_expr
integral_of_derivative(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    uint32_t n = qdot_expr_count(pool, e) / 2, at = n, orders[8];
    qdot_expr args[8], slope;

    if (n == 0 || n > 8)
        return QDOT_NIL;
    for (uint32_t i = 0; i < n; i++) {
        int64_t order;

        args[i] = qdot_expr_arg(pool, e, i);
        if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, e, n + i), &order))
            return QDOT_NIL;
        orders[i] = (uint32_t)order;
        if (qdot_expr_contains(pool, args[i], x)) {
            if (at != n)
                return QDOT_NIL;
            at = i;
        }
    }
    if (at == n || orders[at] == 0)
        return QDOT_NIL;
    slope = qdot_integral_slope(pool, args[at], x);
    if (slope == QDOT_NIL)
        return QDOT_NIL;
    orders[at]--;
    return qdot_div(pool, qdot_ufun_apply(pool, qdot_expr_node(pool, e)->op, args, orders), slope);
}

/* The integral of a power or function of something linear in x. */
static qdot_expr
integral_of_table(qdot_integral_task *t, qdot_expr base, qdot_expr exponent, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    bool function = qdot_expr_kind(pool, base) == QDOT_FUN && exponent == QDOT_ONE && qdot_expr_count(pool, base) == 1;
    qdot_expr u = function ? qdot_expr_arg(pool, base, 0) : base, slope, F;

    if (qdot_expr_kind(pool, base) == QDOT_UFUN && exponent == QDOT_ONE)
        return integral_of_derivative(pool, base, x);
    if (qdot_expr_contains(pool, exponent, x)) { /* b^u with u linear */
        if (qdot_expr_contains(pool, base, x))
            return QDOT_NIL;
        slope = qdot_mul(pool, qdot_diff(pool, exponent, x), qdot_fun1(pool, QDOT_LOG, base));
        if (slope == QDOT_NIL || slope == QDOT_ZERO || qdot_expr_contains(pool, slope, x))
            return QDOT_NIL;
        return qdot_div(pool, qdot_pow(pool, base, exponent), slope);
    }
    slope = qdot_integral_slope(pool, u, x);
    if (slope == QDOT_NIL || slope == QDOT_ZERO)
        return QDOT_NIL;
    if (function) {
        F = integral_of_function(t, (qdot_fun_id)qdot_expr_node(pool, base)->op, u);
    } else if (exponent == QDOT_MINUS_ONE) {
        F = qdot_integral_log(t, u);
    } else {
        exponent = qdot_add(pool, exponent, QDOT_ONE);
        F = qdot_div(pool, qdot_pow(pool, u, exponent), exponent);
    }
    return F == QDOT_NIL ? F : qdot_div(pool, F, slope);
}

/* --- the choice ---------------------------------------------------------------------- */

static qdot_expr
integrate_what_was_read(qdot_integral_task *t, qdot_expr e, qdot_expr x, int depth)
{
    qdot_reading r;
    qdot_expr F = QDOT_NIL;

    if (!qdot_reading_make(t, e, x, &r))
        return QDOT_NIL;
    if (r.n == 0)
        return qdot_rational_over(t, e, x, x);
    F = qdot_circular_integrate(t, &r, x);
    if (F == QDOT_NIL)
        F = qdot_exponential_integrate(t, &r, x);
    if (F == QDOT_NIL)
        F = qdot_quadratic_root_integrate(t, &r, x);
    if (F == QDOT_NIL)
        F = qdot_linear_root_integrate(t, &r, x, depth);
    if (F == QDOT_NIL)
        F = qdot_gauss_integrate(t, &r, x);
    if (F == QDOT_NIL)
        F = qdot_exponential_rational_integrate(t, &r, x);
    return F;
}

/* Integrate a term whose factors all hold x. */
static qdot_expr
integrate_term(qdot_integral_task *t, qdot_expr e, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    bool power = qdot_expr_kind(pool, e) == QDOT_PROD && qdot_expr_count(pool, e) == 3 &&
                 qdot_expr_arg(pool, e, 0) == QDOT_ONE;
    qdot_expr F = integral_of_table(t, power ? qdot_expr_arg(pool, e, 1) : e,
                                    power ? qdot_expr_arg(pool, e, 2) : QDOT_ONE, x);

    if (F == QDOT_NIL)
        F = integrate_what_was_read(t, e, x, depth);
    if (F == QDOT_NIL)
        F = qdot_waves_integrate(t, e, x);
    if (F == QDOT_NIL && depth < QDOT_INTEGRAL_DEPTH)
        F = qdot_substitution_integrate(t, e, x, depth);
    if (F == QDOT_NIL && depth < QDOT_INTEGRAL_DEPTH)
        F = qdot_parts_integrate(t, e, x, depth);
    if (F == QDOT_NIL && !t->failed)
        F = qdot_wave_root_integrate(t, e, x, depth);
    return F;
}

/* Integrate a sum term by term; the terms for which nothing is found together. */
static qdot_expr
integrate_sum(qdot_integral_task *t, qdot_expr e, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr sum = QDOT_ZERO, left = QDOT_ZERO, F;
    uint32_t n = qdot_expr_count(pool, e), parts = 0;

    for (uint32_t i = 0; i < n; i += i == 0 ? 1 : 2) {
        /* the arguments of a sum are its constant c0, then pairs of term and coefficient */
        qdot_expr term = qdot_expr_arg(pool, e, i);

        if (i > 0)
            term = qdot_mul(pool, term, qdot_expr_arg(pool, e, i + 1));
        if (term == QDOT_ZERO)
            continue;
        F = qdot_integral_any(t, term, x, depth + 1);
        if (F == QDOT_NIL) {
            left = qdot_add(pool, left, term);
            parts++;
        } else {
            sum = qdot_add(pool, sum, F);
        }
    }
    if (left == QDOT_ZERO)
        return sum;
    F = parts > 1 ? integrate_term(t, left, x, depth) : QDOT_NIL;
    return F == QDOT_NIL ? F : qdot_add(pool, sum, F);
}

qdot_expr
qdot_integral_any(qdot_integral_task *t, qdot_expr e, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr free, rest, F = QDOT_NIL, expanded;

    if (e == QDOT_NIL || !qdot_integral_goes(t) || depth > QDOT_INTEGRAL_DEPTH)
        return QDOT_NIL;
    if (!qdot_expr_contains(pool, e, x))
        return qdot_mul(pool, e, x);
    qdot_integral_split(pool, e, x, &free, &rest);
    if (qdot_expr_kind(pool, rest) == QDOT_SUM) {
        F = integrate_sum(t, rest, x, depth);
    } else {
        F = integrate_term(t, rest, x, depth);
        if (F == QDOT_NIL && !t->failed) {
            expanded = qdot_expand(pool, rest);
            if (expanded != rest && expanded != QDOT_NIL && qdot_expr_kind(pool, expanded) == QDOT_SUM)
                F = integrate_sum(t, expanded, x, depth);
        }
    }
    return F == QDOT_NIL ? F : qdot_mul(pool, free, F);
}
