/* digits.c -- prints numbers of runs that were made with the option `digits`: as many digits as are known. */
#include "lang/answer/digits.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "expr/build.h"
#include "expr/constant.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/output.h"

int
qdot_digits_of(qdot_session *session, qdot_expr e)
{
    int fewest = 0;

    if (!(qdot_expr_node(session->pool, e)->holds & QDOT_HAS_FORMAL))
        return 0;
    for (size_t i = 0; i < session->measured->n; i++) {
        const qdot_measured *m = &session->measured->at[i];

        if (!qdot_expr_contains(session->pool, e, m->symbol))
            continue;
        if (m->digits == 0)
            return 0;
        if (fewest == 0 || m->digits < fewest)
            fewest = m->digits;
    }
    return fewest;
}

/* --- a number in digits -------------------------------------------------------------- */

/* The number of digits of x that its error leaves meaningful. */
static int
count_meaningful_digits(mpfr_srcptr x, int digits, double error)
{
    double known, mantissa;
    mpfr_exp_t power;

    if (isnan(error)) /* error unknown: show no more digits than a double has */
        return digits < 16 ? digits : 16;
    if (error == 0 || mpfr_zero_p(x))
        return digits;
    mantissa = fabs(mpfr_get_d_2exp(&power, x, MPFR_RNDN));
    known = floor(log10(mantissa) + (double)power * log10(2)) - floor(log10(error)) + 1;
    return known < 1 ? 1 : known < digits ? (int)known : digits;
}

/* Write x, given by its digits as 0.d1 d2 ... 10^exponent. */
static void
write_number(const char *d, int64_t exponent, qdot_text *out)
{
    int64_t n;

    if (*d == '-')
        qdot_text_char(out, *d++);
    n = (int64_t)strlen(d);
    if (exponent > n || exponent < -4) {
        qdot_text_add_n(out, d, 1);
        if (n > 1) {
            qdot_text_char(out, '.');
            qdot_text_add(out, d + 1);
        }
        qdot_text_format(out, "e%" PRId64, exponent - 1);
    } else if (exponent > 0) {
        qdot_text_add_n(out, d, (size_t)exponent);
        if (exponent < n)
            qdot_text_char(out, '.');
        qdot_text_add(out, d + exponent);
    } else {
        qdot_text_add(out, "0.");
        for (int64_t i = exponent; i < 0; i++)
            qdot_text_char(out, '0');
        qdot_text_add(out, d);
    }
}

/* Drop trailing zeros after the decimal point of an exact number. */
static void
drop_trailing_zeros(char *d, int64_t exponent)
{
    size_t sign = *d == '-', n = strlen(d), least = sign + 1;

    if (exponent > 1 && sign + (size_t)exponent <= n)
        least = sign + (size_t)exponent;
    while (n > least && d[n - 1] == '0')
        d[--n] = '\0';
}

static qdot_status
write_real(mpfr_srcptr x, int digits, double error, bool shortly, qdot_text *out)
{
    mpfr_exp_t exponent;
    char *d;

    if (mpfr_zero_p(x)) {
        qdot_text_char(out, '0');
        return QDOT_OK;
    }
    d = mpfr_get_str(NULL, &exponent, 10, (size_t)count_meaningful_digits(x, digits, error), x,
                     MPFR_RNDN);
    if (d == NULL)
        return QDOT_ENOMEM;
    if (shortly)
        drop_trailing_zeros(d, (int64_t)exponent);
    write_number(d, (int64_t)exponent, out);
    mpfr_free_str(d);
    return QDOT_OK;
}

/* Whether e contains results of runs, and all of these runs were made without the option `digits`. */
static bool
is_from_double_runs(qdot_session *session, qdot_expr e)
{
    bool any = false;

    for (size_t i = 0; i < session->measured->n; i++) {
        const qdot_measured *m = &session->measured->at[i];

        if (!qdot_expr_contains(session->pool, e, m->symbol))
            continue;
        if (!m->plain)
            return false;
        any = true;
    }
    return any;
}

/* Evaluate e with many digits; results of runs enter as the exact rationals that they are. */
static qdot_status
evaluate_to_mpfr(qdot_session *session, qdot_expr e, mpfr_ptr x)
{
    e = qdot_measured_as_rationals(session, qdot_session_bind(session, e));
    QDOT_TRY(qdot_pool_check(session->pool));
    return qdot_constant_real(session->pool, e, x);
}

qdot_status
qdot_digits_number(qdot_session *session, qdot_expr e, int digits, double *error, qdot_text *out)
{
    const size_t before = out->n;
    mpfr_t x, printed;
    double rounding;
    qdot_status status;

    mpfr_init2(x, (mpfr_prec_t)(3.33 * digits) + 64);
    mpfr_init2(printed, mpfr_get_prec(x));
    status = evaluate_to_mpfr(session, e, x);
    if (status == QDOT_OK)
        status = write_real(x, digits, *error, *error == 0 && is_from_double_runs(session, e), out);
    if (status == QDOT_OK)
        status = qdot_text_status(out);
    if (status == QDOT_OK) {
        (void)mpfr_set_str(printed, qdot_text_str(out) + before, 10, MPFR_RNDN);
        mpfr_sub(printed, printed, x, MPFR_RNDA);
        rounding = fabs(mpfr_get_d(printed, MPFR_RNDA));
        if (*error > 0 && rounding > *error)
            *error += rounding;
    }
    mpfr_clear(printed);
    mpfr_clear(x);
    return status;
}

qdot_status
qdot_digits_text(qdot_session *session, qdot_expr e, int digits, double error,
                 qdot_text *out)
{
    return qdot_digits_number(session, e, digits, &error, out);
}

qdot_status
qdot_digits_difference(qdot_session *session, qdot_expr left, qdot_expr right,
                       double *difference)
{
    mpfr_t x;
    qdot_status status;

    mpfr_init2(x, 64);
    status = evaluate_to_mpfr(session, qdot_sub(session->pool, left, right), x);
    *difference = mpfr_get_d(x, MPFR_RNDN);
    mpfr_clear(x);
    return status;
}

/* --- printing answers with `digits` -------------------------------------------------- */

static qdot_status
append_member_with_error(qdot_session *session, qdot_expr e, int digits, qdot_numerals *x)
{
    const char *const quote = is_from_double_runs(session, e) ? "" : "\"";
    qdot_text number = {0};
    qdot_status status;
    double value, error;

    QDOT_TRY(qdot_session_number(session, e, &value, &error));
    status = qdot_digits_number(session, e, digits, &error, &number);
    qdot_text_format(&x->values, "%s%s%s%s", x->values.n > 0 ? "," : "", quote, qdot_text_str(&number), quote);
    qdot_text_add(&x->errors, x->errors.n > 0 ? "," : "");
    qdot_number_text_json(&x->errors, error);
    qdot_text_add(&x->text, x->text.n > 0 ? ", " : "");
    qdot_text_add(&x->text, qdot_text_str(&number));
    qdot_number_text_error(&x->text, error);
    qdot_text_clear(&number);
    return status;
}

qdot_status
qdot_digits_answer(qdot_session *session, const char *name, qdot_expr e, int digits)
{
    const bool several = !qdot_expr_is_scalar(session->pool, e);
    const uint32_t n = several ? qdot_expr_count(session->pool, e) : 1;
    qdot_numerals numerals = {0};
    qdot_status status = QDOT_OK;

    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        status = append_member_with_error(session, several ? qdot_expr_arg(session->pool, e, i) : e, digits, &numerals);
    return qdot_answer_numerals(session, name, several, status, &numerals);
}
