/* number.h -- the value of an expression at a point, in MPFR: independent of lib/normal.
 *
 * Undefined functions stand for u -> exp(u/2) + u^3, so that derivatives and arguments fit.
 */
#ifndef QDOT_TESTS_NORMAL_NUMBER_H
#define QDOT_TESTS_NORMAL_NUMBER_H

#include <stdlib.h>
#include <string.h>

#include <mpfr.h>

#include "expr/expr.h"
#include "expr/walk.h"

/* A number for a symbol: the k-th point. Known domains: (0, pi), (0, oo), (-1, 1),
 * (1, oo). */
static void
number_of_symbol(const qdot_pool *pool, qdot_expr e, unsigned k, mpfr_t x)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, e);
    uint64_t hash = 5381 + 7919ul * k;
    double u;

    if (e == QDOT_PI) {
        mpfr_const_pi(x, MPFR_RNDN);
        return;
    }
    for (const char *c = s->name; *c != '\0'; c++)
        hash = hash * 33 + (unsigned char)*c;
    hash ^= hash >> 13;
    u = (double)(hash * 2654435761ul % 1000003) / 1000003.0;
    if (s->lo == QDOT_ZERO && s->hi == QDOT_PI)
        u = 0.05 + 3.0 * u;
    else if (s->lo == QDOT_MINUS_ONE && s->hi == QDOT_ONE)
        u = 1.96 * u - 0.98;
    else if (s->lo == QDOT_ONE)
        u = 1.05 + 2.5 * u;
    else if (s->lo == QDOT_ZERO)
        u = 0.1 + 2.5 * u;
    else
        u = 4.0 * u - 2.0;
    mpfr_set_d(x, u, MPFR_RNDN);
}

static void
number_of_ufun(const qdot_pool *pool, qdot_expr e, const mpfr_t u, mpfr_t x)
{
    int64_t order = 0;
    mpfr_t power;

    (void)qdot_expr_to_int(pool, qdot_expr_arg(pool, e, 1), &order);
    mpfr_init2(power, mpfr_get_prec(x));
    mpfr_div_ui(x, u, 2, MPFR_RNDN);
    mpfr_exp(x, x, MPFR_RNDN);
    mpfr_div_2si(x, x, (mpfr_exp_t)order, MPFR_RNDN);
    if (order <= 3) {
        mpfr_pow_ui(power, u, (unsigned)(3 - order), MPFR_RNDN);
        mpfr_mul_ui(power, power, order == 0 ? 1 : order == 1 ? 3 : 6, MPFR_RNDN);
        mpfr_add(x, x, power, MPFR_RNDN);
    }
    mpfr_clear(power);
}

/* Whether u is 0 (or an integer) but for rounding, so that it may be on either side of it. */
static bool
number_is_close(const mpfr_t u, bool whole)
{
    bool close;
    mpfr_t d;

    mpfr_init2(d, mpfr_get_prec(u));
    if (whole)
        mpfr_rint(d, u, MPFR_RNDN);
    else
        mpfr_set_zero(d, 1);
    mpfr_sub(d, u, d, MPFR_RNDN);
    close = !mpfr_zero_p(d) && mpfr_get_exp(d) < -(mpfr_exp_t)(mpfr_get_prec(u) / 2);
    mpfr_clear(d);
    return close;
}

/* NaN where it is not defined in the reals, or jumps too near. */
static void
number_of_function(unsigned op, const mpfr_t u, const mpfr_t v, mpfr_t x)
{
    static const struct {
        unsigned op;
        int (*f)(mpfr_t, const mpfr_t, mpfr_rnd_t);
    } table[] = {
        {QDOT_SIN, mpfr_sin},     {QDOT_COS, mpfr_cos},     {QDOT_TAN, mpfr_tan},
        {QDOT_SEC, mpfr_sec},     {QDOT_CSC, mpfr_csc},     {QDOT_COT, mpfr_cot},
        {QDOT_ASIN, mpfr_asin},   {QDOT_ACOS, mpfr_acos},   {QDOT_ATAN, mpfr_atan},
        {QDOT_SINH, mpfr_sinh},   {QDOT_COSH, mpfr_cosh},   {QDOT_TANH, mpfr_tanh},
        {QDOT_ASINH, mpfr_asinh}, {QDOT_ACOSH, mpfr_acosh}, {QDOT_ATANH, mpfr_atanh},
        {QDOT_EXP, mpfr_exp},     {QDOT_LOG, mpfr_log}};

    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (table[i].op == op) {
            table[i].f(x, u, MPFR_RNDN);
            return;
        }
    if (mpfr_nan_p(u) || mpfr_nan_p(v)) {
        mpfr_set_nan(x);
        return;
    }
    if ((op == QDOT_SIGN || op == QDOT_FLOOR) && number_is_close(u, op == QDOT_FLOOR)) {
        mpfr_set_nan(x);
        return;
    }
    switch (op) {
    case QDOT_ABS: mpfr_abs(x, u, MPFR_RNDN); break;
    case QDOT_SIGN: mpfr_set_si(x, mpfr_sgn(u), MPFR_RNDN); break;
    case QDOT_FLOOR: mpfr_floor(x, u); break;
    case QDOT_ATAN2: mpfr_atan2(x, u, v, MPFR_RNDN); break;
    case QDOT_MIN: mpfr_min(x, u, v, MPFR_RNDN); break;
    case QDOT_MAX: mpfr_max(x, u, v, MPFR_RNDN); break;
    case QDOT_MOD: /* u - v floor(u/v) */
        mpfr_div(x, u, v, MPFR_RNDN);
        mpfr_floor(x, x);
        mpfr_mul(x, x, v, MPFR_RNDN);
        mpfr_sub(x, u, x, MPFR_RNDN);
        break;
    default: mpfr_set_nan(x);
    }
}

static void
number_of_node(const qdot_pool *pool, const qdot_walk *w, mpfr_t *value, qdot_expr e,
               unsigned k, mpfr_t x)
{
    uint32_t n = qdot_expr_count(pool, e);
    mpfr_t y;
#define ARG(i) value[qdot_walk_index(w, qdot_expr_arg(pool, e, i))]

    mpfr_init2(y, mpfr_get_prec(x));
    switch (qdot_expr_kind(pool, e)) {
    case QDOT_NUM: {
        /* FLINT 3.6 knows GMP's types only if it was included behind GMP */
        char *digits = fmpq_get_str(NULL, 10, qdot_expr_rational(pool, e));
        mpq_t q;

        mpq_init(q);
        mpq_set_str(q, digits, 10);
        mpfr_set_q(x, q, MPFR_RNDN);
        mpq_clear(q);
        flint_free(digits);
        break;
    }
    case QDOT_SYM: number_of_symbol(pool, e, k, x); break;
    case QDOT_SUM:
        mpfr_set(x, ARG(0), MPFR_RNDN);
        for (uint32_t i = 1; i < n; i += 2) {
            mpfr_mul(y, ARG(i), ARG(i + 1), MPFR_RNDN);
            mpfr_add(x, x, y, MPFR_RNDN);
        }
        break;
    case QDOT_PROD:
        mpfr_set(x, ARG(0), MPFR_RNDN);
        for (uint32_t i = 1; i < n; i += 2) {
            mpfr_pow(y, ARG(i), ARG(i + 1), MPFR_RNDN);
            mpfr_mul(x, x, y, MPFR_RNDN);
        }
        break;
    case QDOT_REL:
        mpfr_sub(y, ARG(1), ARG(0), MPFR_RNDN);
        if (mpfr_nan_p(y) || number_is_close(y, false))
            mpfr_set_nan(x);
        else
            mpfr_set_si(x,
                        qdot_expr_node(pool, e)->op == QDOT_LT   ? mpfr_sgn(y) > 0
                        : qdot_expr_node(pool, e)->op == QDOT_LE ? mpfr_sgn(y) >= 0
                                                                 : mpfr_zero_p(y),
                        MPFR_RNDN);
        break;
    case QDOT_FUN:
        if (qdot_expr_node(pool, e)->op == QDOT_IF) {
            if (mpfr_nan_p(ARG(0)))
                mpfr_set_nan(x);
            else
                mpfr_set(x, mpfr_zero_p(ARG(0)) ? ARG(2) : ARG(1), MPFR_RNDN);
            break;
        }
        number_of_function(qdot_expr_node(pool, e)->op, ARG(0), ARG(n > 1), x);
        break;
    case QDOT_UFUN: number_of_ufun(pool, e, ARG(0), x); break;
    default: mpfr_set_nan(x);
    }
    mpfr_clear(y);
#undef ARG
}

/* l, r = the values of left and right at the k-th point. False where it fails. */
static bool
number_pair(const qdot_pool *pool, qdot_expr left, qdot_expr right, unsigned k, mpfr_t l,
            mpfr_t r)
{
    qdot_expr e[2] = {left, right};
    qdot_walk w;
    mpfr_t *value;

    if (qdot_walk_begin_n(pool, 2, e, &w) != QDOT_OK)
        return false;
    value = malloc((w.n + 1) * sizeof *value);
    for (size_t i = 0; i < w.n; i++) {
        mpfr_init2(value[i], mpfr_get_prec(l));
        number_of_node(pool, &w, value, w.at[i], k, value[i]);
    }
    mpfr_set(l, value[qdot_walk_index(&w, left)], MPFR_RNDN);
    mpfr_set(r, value[qdot_walk_index(&w, right)], MPFR_RNDN);
    for (size_t i = 0; i < w.n; i++)
        mpfr_clear(value[i]);
    free(value);
    qdot_walk_end(&w);
    return mpfr_number_p(l) && mpfr_number_p(r);
}

/* Compare at the k-th point: 1 they differ, 0 they agree as far as seen, -1 not defined. The
 * difference must stand at many times the digits: cosh(700)^2 - sinh(700)^2 is 0 at 1024 bits. */
__attribute__((unused)) static int
number_compare(const qdot_pool *pool, qdot_expr left, qdot_expr right, unsigned k)
{
    mpfr_t l, r, d[2];
    int result = 0;

    for (int i = 0; i < 2; i++) {
        mpfr_prec_t prec = i == 0 ? 512 : 8192;

        mpfr_inits2(prec, l, r, d[i], (mpfr_ptr)0);
        if (number_pair(pool, left, right, k, l, r))
            mpfr_sub(d[i], l, r, MPFR_RNDN);
        else
            result = -1;
        mpfr_clears(l, r, (mpfr_ptr)0);
    }
    if (result == 0 && !mpfr_zero_p(d[0]) && !mpfr_zero_p(d[1])) {
        mpfr_sub(d[0], d[0], d[1], MPFR_RNDN);
        result = mpfr_zero_p(d[0]) || mpfr_get_exp(d[0]) < mpfr_get_exp(d[1]) - 40;
    }
    mpfr_clears(d[0], d[1], (mpfr_ptr)0);
    return result;
}

#endif
