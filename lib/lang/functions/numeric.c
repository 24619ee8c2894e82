/* numeric.c -- constants by their digits, alone and beside symbols. */
#include "lang/functions/numeric.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/value-kind.h"
#include "normal/prove/decide.h"
#include "tape/constant.h"

enum { MOST_DIGITS = 100000, LEAST_EXPONENT = -100000, DIGITS = 16, PASSES = 4 };

/* The arguments of the call. */
typedef struct {
    qdot_session *session;
    int digits;
    bool plain; /* the digits were not said */
    qdot_status status;
} order;

/* --- a constant ---------------------------------------------------------------------- */

/* e, a constant, in x; 0 where that is proved. */
static qdot_status
real_of(qdot_pool *pool, qdot_expr e, mpfr_ptr x)
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
    status = qdot_print(pool, e, QDOT_PLAIN, &text);
    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "%.120s%s could not be told from 0",
                           qdot_text_str(&text), text.n > 120 ? "..." : "");
    qdot_text_clear(&text);
    return status;
}

/* A bound of |x - text|; x itself may be off by |x| 2^(3 - its precision). */
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
    mpfr_mul_2si(slack, x, 3 - (long)mpfr_get_prec(x), MPFR_RNDA);
    mpfr_abs(slack, slack, MPFR_RNDU);
    mpfr_add(y, y, slack, MPFR_RNDU);
    error = mpfr_get_d(y, MPFR_RNDU);
    mpfr_clear(y);
    mpfr_clear(slack);
    return error;
}

/* x to so many digits, an exact number, and what that is off by. */
static qdot_status
round_to(qdot_pool *pool, mpfr_srcptr x, int digits, qdot_expr *value, double *error)
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
    qdot_text_format(&text, "%s0.%se%ld", minus ? "-" : "", d + minus, (long)exponent);
    mpfr_free_str(d);
    if (exponent > DBL_MAX_10_EXP || exponent < LEAST_EXPONENT) {
        qdot_text_clear(&text);
        return qdot_fail(QDOT_ELIMIT, "a number near 10^%ld is not written in digits",
                         (long)exponent - 1);
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

/* A constant as a decimal number of so many digits; and what that is off by. */
static qdot_status
decimal(qdot_pool *pool, qdot_expr e, int digits, qdot_expr *value, double *error)
{
    qdot_status status;
    mpfr_t x;

    mpfr_init2(x, (mpfr_prec_t)(3.33 * digits) + 64);
    status = real_of(pool, e, x);
    if (status == QDOT_OK)
        status = round_to(pool, x, digits, value, error);
    if (status == QDOT_OK && *value == e)
        *error = 0;
    mpfr_clear(x);
    return status;
}

/* A constant as a number with its error. */
static qdot_status
number(qdot_session *session, qdot_expr e, const order *o, qdot_measured *m)
{
    *m = (qdot_measured){.digits = o->digits, .plain = o->plain};
    QDOT_TRY(decimal(session->pool, e, o->digits, &m->exact, &m->error));
    return qdot_session_number(session, m->exact, &m->value, NULL);
}

/* What is made of numbers with errors, to so many digits of its own. */
static qdot_status
shortened(qdot_session *session, qdot_expr e, const order *o, qdot_measured *m)
{
    qdot_expr exact = qdot_measured_as_rationals(session, e);
    double error;

    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_session_number(session, e, &m->value, &error));
    QDOT_TRY(number(session, exact, o, m));
    m->error += error;
    return QDOT_OK;
}

/* --- beside symbols ------------------------------------------------------------------ */

typedef struct {
    qdot_pool *pool;
    qdot_walk *walk; /* the value of a node: with decimals for what is constant */
    int digits;
} writer;

static qdot_expr
known(const writer *w, qdot_expr e)
{
    return (qdot_expr)qdot_walk_get(w->walk, e);
}

static bool
is_number(const writer *w, qdot_expr e)
{
    return qdot_expr_is_scalar(w->pool, e) && qdot_constant_is(w->pool, e) &&
           e != QDOT_TRUE && e != QDOT_FALSE;
}

static qdot_status
written(const writer *w, qdot_expr e, qdot_expr *value)
{
    double error;

    QDOT_TRY(qdot_value_kind_check(w->pool, e));
    return decimal(w->pool, e, w->digits, value, &error);
}

/* c e, e a product or none: what is constant of it as one number. */
static qdot_status
product(const writer *w, qdot_expr c, qdot_expr e, qdot_expr *value)
{
    qdot_pool *pool = w->pool;
    qdot_expr rest = QDOT_ONE;

    if (qdot_expr_kind(pool, e) != QDOT_PROD) {
        rest = known(w, e);
    } else {
        c = qdot_mul(pool, c, qdot_expr_arg(pool, e, 0));
        for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
            qdot_expr b = qdot_expr_arg(pool, e, i), x = qdot_expr_arg(pool, e, i + 1);

            if (is_number(w, b) && is_number(w, x))
                c = qdot_mul(pool, c, qdot_pow(pool, b, x));
            else
                rest = qdot_mul(pool, rest,
                                qdot_pow(pool, known(w, b),
                                         qdot_expr_rational(pool, x) ? x : known(w, x)));
        }
    }
    QDOT_TRY(written(w, c, &c));
    *value = qdot_mul(pool, c, rest);
    return QDOT_OK;
}

static qdot_status
sum(const writer *w, qdot_expr e, qdot_expr *value)
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
        QDOT_TRY(product(w, c, t, &term));
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
    case QDOT_SUM: return sum(w, e, value);
    case QDOT_PROD: return product(w, QDOT_ONE, e, value);
    default: *value = qdot_walk_rebuild(w->pool, w->walk, e); return QDOT_OK;
    }
}

/* e with decimals for all that is constant of it. */
static qdot_status
with_decimals(qdot_pool *pool, qdot_expr e, int digits, qdot_expr *value)
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
    *value = status == QDOT_OK ? known(&w, e) : QDOT_NIL;
    qdot_walk_end(&walk);
    return status;
}

/* Again while that makes constants anew: sqrt(2.5*m) is written sqrt(2.5)*sqrt(m). */
static qdot_status
beside_symbols(qdot_pool *pool, qdot_expr e, int digits, qdot_expr *value)
{
    *value = e;
    for (int pass = 0; pass < PASSES; pass++) {
        qdot_expr before = *value;

        QDOT_TRY(with_decimals(pool, before, digits, value));
        if (*value == before)
            break;
    }
    return QDOT_OK;
}

/* --- the function -------------------------------------------------------------------- */

/* A number, or a vector or list of numbers alone: not of lists or equations. */
static bool
is_flat(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);
    bool flat = kind == QDOT_VEC || kind == QDOT_LIST;

    for (uint32_t i = 0; flat && i < qdot_expr_count(pool, e); i++)
        flat = qdot_expr_is_scalar(pool, qdot_expr_arg(pool, e, i));
    return flat || qdot_expr_is_scalar(pool, e);
}

static qdot_expr
numbered(qdot_pool *pool, qdot_expr e, void *user)
{
    order *o = user;
    qdot_measured m = {0};

    (void)pool;
    if (o->status != QDOT_OK || (o->plain && qdot_measured_occurs(o->session, e)))
        return e;
    o->status = qdot_measured_occurs(o->session, e) ? shortened(o->session, e, o, &m)
                                                    : number(o->session, e, o, &m);
    return o->status == QDOT_OK ? qdot_measured_add(o->session, m) : e;
}

qdot_status
qdot_numeric(qdot_session *session, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    qdot_expr e = qdot_session_bind(session, args[0]), exact;
    order o = {.session = session, .plain = n == 1};
    long digits = DIGITS;

    QDOT_TRY(qdot_value_kind_check(pool, e));
    if (n == 2) {
        QDOT_TRY(qdot_session_integer(session, args[1], &digits));
        if (digits < 1 || digits > MOST_DIGITS)
            return qdot_fail(QDOT_EDOMAIN, "%ld digits: from 1 to %d can be asked for", digits,
                             MOST_DIGITS);
    }
    if (qdot_expr_is_class(pool, e, QDOT_WORDS))
        return qdot_fail(QDOT_ETYPE, "numeric takes numbers, not a text");
    exact = qdot_measured_as_rationals(session, e);
    QDOT_TRY(qdot_value_kind_check(pool, exact));
    if (exact == e && !(qdot_constant_is(pool, e) && is_flat(pool, e)))
        return beside_symbols(pool, e, (int)digits, value);
    if (!qdot_constant_is(pool, exact) || !is_flat(pool, e))
        return qdot_fail(QDOT_ETYPE, "a number of a run beside what has no value");
    o.digits = (int)digits;
    *value = qdot_value_map(pool, e, numbered, &o);
    QDOT_TRY(o.status);
    return qdot_value_kind_check(pool, *value);
}
