/* decimal.c -- decimals for constants, by themselves and in expressions with symbols. */
#include "normal/calculus/decimal.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <mpfr.h>

#include "base/text.h"
#include "expr/build.h"
#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"

enum { LEAST_EXPONENT = -100000, PASSES = 4 };

/* --- numbers for constants ----------------------------------------------------------- */

/* Evaluate the constant e as x; exactly 0 if that is proved. */
static qdot_status
evaluate_constant(qdot_pool *pool, qdot_expr e, mpfr_ptr x)
{
    qdot_decision seen = {.verdict = QDOT_UNDECIDED};
    qdot_text text = {0};
    qdot_status status;

    QDOT_TRY(qdot_constant_real(pool, e, x));
    if (!mpfr_zero_p(x) || e == QDOT_ZERO)
        return QDOT_OK;
    QDOT_TRY(qdot_decide_equal(pool, e, QDOT_ZERO, NULL, &seen));
    if (seen.verdict == QDOT_PROVED)
        return QDOT_OK;
    /* Values of data are rational numbers with short denominators: if so many bits of one are 0, it is 0. */
    if (qdot_expr_find_function(pool, e, 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL) != QDOT_NIL)
        return qdot_pool_check(pool);
    status = qdot_print(pool, e, QDOT_PLAIN, &text);
    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "%.120s%s cannot be distinguished from 0",
                           qdot_text_str(&text), text.n > 120 ? "..." : "");
    qdot_text_clear(&text);
    return status;
}

/* A bound of |x - text|, allowing an error of |x| 2^(3 - precision) of x itself. */
static double
text_distance(mpfr_srcptr x, const char *text)
{
    double error;
    mpfr_t y, slack;

    mpfr_init2(y, mpfr_get_prec(x));
    mpfr_init2(slack, 64);
    mpfr_set_str(y, text, 10, MPFR_RNDN);
    mpfr_sub(y, y, x, MPFR_RNDA);
    mpfr_abs(y, y, MPFR_RNDU);
    mpfr_mul_2si(slack, x, 3 - (mpfr_exp_t)mpfr_get_prec(x), MPFR_RNDA);
    mpfr_abs(slack, slack, MPFR_RNDU);
    mpfr_add(y, y, slack, MPFR_RNDU);
    error = mpfr_get_d(y, MPFR_RNDU);
    mpfr_clear(y);
    mpfr_clear(slack);
    return error;
}

/* Round x to `digits` digits: *value is the exact decimal, *error its distance from x. */
static qdot_status
round_to_digits(qdot_pool *pool, mpfr_srcptr x, int digits, qdot_expr *value, double *error)
{
    qdot_text text = {0};
    mpfr_exp_t exponent;
    char *d;
    bool minus;

    *error = 0;
    *value = QDOT_ZERO;
    if (mpfr_zero_p(x))
        return QDOT_OK;
    d = mpfr_get_str(NULL, &exponent, 10, (size_t)digits, x, MPFR_RNDN);
    if (d == NULL)
        return QDOT_ENOMEM;
    minus = *d == '-';
    qdot_text_format(&text, "%s0.%se%" PRId64, minus ? "-" : "", d + minus, (int64_t)exponent);
    mpfr_free_str(d);
    if (exponent > DBL_MAX_10_EXP || exponent < LEAST_EXPONENT) {
        qdot_text_clear(&text);
        return qdot_fail(QDOT_ELIMIT, "a number near 10^%" PRId64 " is not written in digits",
                         (int64_t)exponent - 1);
    }
    *value = QDOT_NIL;
    if (qdot_text_status(&text) == QDOT_OK) {
        *error = text_distance(x, qdot_text_str(&text));
        *value = qdot_expr_decimal(pool, qdot_text_str(&text) + minus, text.n - minus);
    }
    if (minus && *value != QDOT_NIL)
        *value = qdot_neg(pool, *value);
    qdot_text_clear(&text);
    return qdot_value_kind_check(pool, *value);
}

qdot_status
qdot_decimal(qdot_pool *pool, qdot_expr e, int digits, qdot_expr *value, double *error)
{
    qdot_status status;
    mpfr_t x;

    mpfr_init2(x, (mpfr_prec_t)(3.33 * digits) + 64);
    status = evaluate_constant(pool, e, x);
    if (status == QDOT_OK)
        status = round_to_digits(pool, x, digits, value, error);
    if (status == QDOT_OK && *value == e)
        *error = 0;
    mpfr_clear(x);
    return status;
}

/* --- constants in expressions with symbols ------------------------------------------- */

typedef struct {
    qdot_pool *pool;
    qdot_walk *walk; /* walk.value: the node with all constant parts replaced by decimals */
    int digits;
} writer;

static qdot_expr
replaced_node(const writer *w, qdot_expr e)
{
    return (qdot_expr)qdot_walk_get(w->walk, e);
}

static bool
is_number(const writer *w, qdot_expr e)
{
    return qdot_expr_is_scalar(w->pool, e) && qdot_expr_is_constant(w->pool, e) &&
           e != QDOT_TRUE && e != QDOT_FALSE;
}

static qdot_status
written(const writer *w, qdot_expr e, qdot_expr *value)
{
    double error;

    QDOT_TRY(qdot_value_kind_check(w->pool, e));
    return qdot_decimal(w->pool, e, w->digits, value, &error);
}

/* Find the product c e with all its constant factors merged into one number. */
static qdot_status
decimal_product(const writer *w, qdot_expr c, qdot_expr e, qdot_expr *value)
{
    qdot_pool *pool = w->pool;
    qdot_expr rest = QDOT_ONE;

    if (qdot_expr_kind(pool, e) != QDOT_PROD) {
        rest = replaced_node(w, e);
    } else {
        c = qdot_mul(pool, c, qdot_expr_arg(pool, e, 0));
        for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
            qdot_expr b = qdot_expr_arg(pool, e, i), x = qdot_expr_arg(pool, e, i + 1);

            if (is_number(w, b) && is_number(w, x))
                c = qdot_mul(pool, c, qdot_pow(pool, b, x));
            else
                rest = qdot_mul(pool, rest,
                                qdot_pow(pool, replaced_node(w, b),
                                         qdot_expr_rational(pool, x) ? x : replaced_node(w, x)));
        }
    }
    QDOT_TRY(written(w, c, &c));
    *value = qdot_mul(pool, c, rest);
    return QDOT_OK;
}

static qdot_status
decimal_sum(const writer *w, qdot_expr e, qdot_expr *value)
{
    qdot_pool *pool = w->pool;
    qdot_expr constant = qdot_expr_arg(pool, e, 0), term;

    *value = QDOT_ZERO;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        qdot_expr t = qdot_expr_arg(pool, e, i), c = qdot_expr_arg(pool, e, i + 1);

        if (is_number(w, t)) {
            constant = qdot_add(pool, constant, qdot_mul(pool, c, t));
            continue;
        }
        QDOT_TRY(decimal_product(w, c, t, &term));
        *value = qdot_add(pool, *value, term);
    }
    QDOT_TRY(written(w, constant, &constant));
    *value = qdot_add(pool, *value, constant);
    return QDOT_OK;
}

static qdot_status
node(const writer *w, qdot_expr e, qdot_expr *value)
{
    if (is_number(w, e))
        return written(w, e, value);
    switch (qdot_expr_kind(w->pool, e)) {
    case QDOT_SUM: return decimal_sum(w, e, value);
    case QDOT_PROD: return decimal_product(w, QDOT_ONE, e, value);
    default: *value = qdot_walk_rebuild(w->pool, w->walk, e); return QDOT_OK;
    }
}

/* Write e with every constant subexpression replaced by a decimal. */
static qdot_status
replace_constants_by_decimals(qdot_pool *pool, qdot_expr e, int digits, qdot_expr *value)
{
    qdot_walk walk;
    writer w = {pool, &walk, digits};
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_walk_begin(pool, e, &walk));
    for (size_t i = 0; i < walk.n && status == QDOT_OK; i++) {
        qdot_expr to = QDOT_NIL;

        status = node(&w, walk.at[i], &to);
        if (status == QDOT_OK)
            status = qdot_value_kind_check(pool, to);
        qdot_walk_set(&walk, walk.at[i], to);
    }
    *value = status == QDOT_OK ? replaced_node(&w, e) : QDOT_NIL;
    qdot_walk_end(&walk);
    return status;
}

qdot_status
qdot_decimals_beside_symbols(qdot_pool *pool, qdot_expr e, int digits, qdot_expr *value)
{
    *value = e;
    /* repeat if this made new constants: sqrt(2.5*m) becomes sqrt(2.5)*sqrt(m) */
    for (int pass = 0; pass < PASSES; pass++) {
        qdot_expr before = *value;

        QDOT_TRY(replace_constants_by_decimals(pool, before, digits, value));
        if (*value == before)
            break;
    }
    return QDOT_OK;
}
