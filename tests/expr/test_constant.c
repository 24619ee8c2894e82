/* test_constant.c -- constants: correctly rounded, or told why not. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include <mpfr.h>

#include "expr/build.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "tape/tape.h"

static double
constant(qdot_pool *pool, qdot_expr e)
{
    double x;

    if (qdot_constant_double(pool, e, &x) != QDOT_OK)
        fail_msg("%s", qdot_last_error()->message);
    return x;
}

static qdot_status
refused(qdot_pool *pool, qdot_expr e)
{
    double x = 1;
    qdot_status status = qdot_constant_double(pool, e, &x);

    assert_true(isnan(x) || status == QDOT_EDOMAIN);
    return status;
}

/* p/q against MPFR's one rounding. */
static void
rationals_round_to_nearest(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    mpfr_t x, divisor;

    (void)state;
    mpfr_init2(x, 53);
    mpfr_init2(divisor, 64);
    for (int64_t p = -500; p < 500; p += 7)
        for (int64_t q = 1; q < 1000; q += 31) {
            mpfr_set_si(x, p, MPFR_RNDN);
            mpfr_div_si(x, x, q, MPFR_RNDN);
            assert_true(constant(pool, qdot_expr_ratio(pool, p, q))
                        == mpfr_get_d(x, MPFR_RNDN));
        }
    /* up to what a double holds and beyond, with what it leaves */
    for (int64_t k = 0; k < 200; k++) {
        const int64_t p = ((INT64_C(1) << 57) - 1) / (k + 1) - 7 * k, q = 1000000000000 + 13 * k;
        double value, low;
        int side;

        assert_int_equal(
            qdot_constant_split(pool, qdot_expr_ratio(pool, p, q), &value, &side, &low), QDOT_OK);
        mpfr_set_prec(x, 300);
        mpfr_set_sj(x, p, MPFR_RNDN);
        mpfr_set_sj(divisor, q, MPFR_RNDN);
        mpfr_div(x, x, divisor, MPFR_RNDN);
        assert_true(value == mpfr_get_d(x, MPFR_RNDN));
        mpfr_sub_d(x, x, value, MPFR_RNDN);
        assert_true(low == mpfr_get_d(x, MPFR_RNDN));
        assert_int_equal(side, mpfr_sgn(x));
    }
    assert_true(constant(pool, qdot_expr_decimal(pool, "9.81", 4)) == 9.81);
    assert_true(constant(pool, qdot_expr_decimal(pool, "1e-310", 6)) == 1e-310);
    assert_true(constant(pool, qdot_expr_decimal(pool, "5e-324", 6)) == 5e-324);
    /* exactly between two doubles: to even */
    assert_true(constant(pool, qdot_expr_decimal(pool, "9007199254740993", 16))
                == 9007199254740992.0);
    mpfr_clears(x, divisor, (mpfr_ptr)NULL);
    qdot_pool_free(pool);
}

/* 2 pi sqrt(1900), and elementary functions of n/8. */
static void
functions_round_to_nearest(void **state)
{
    static const struct {
        qdot_fun_id id;
        int (*f)(mpfr_t, const mpfr_t, mpfr_rnd_t);
    } rows[] = {{QDOT_SIN, mpfr_sin},   {QDOT_COS, mpfr_cos},     {QDOT_TAN, mpfr_tan},
                {QDOT_EXP, mpfr_exp},   {QDOT_ATAN, mpfr_atan},   {QDOT_SINH, mpfr_sinh},
                {QDOT_COSH, mpfr_cosh}, {QDOT_TANH, mpfr_tanh},   {QDOT_ASINH, mpfr_asinh},
                {QDOT_SEC, mpfr_sec},   {QDOT_ASIN, mpfr_asin},   {QDOT_ACOS, mpfr_acos},
                {QDOT_ATANH, mpfr_atanh}, {QDOT_LOG, mpfr_log},
                {QDOT_ERF, mpfr_erf},   {QDOT_ERFC, mpfr_erfc}};
    qdot_pool *pool = qdot_pool_new();
    size_t compared = 0;
    mpfr_t x, y;
    qdot_expr e;

    (void)state;
    mpfr_init2(x, 300);
    mpfr_init2(y, 300);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (int64_t n = 1; n < 40; n++) {
            mpfr_set_d(x, (double)n / 8, MPFR_RNDN);
            rows[i].f(y, x, MPFR_RNDN);
            if (mpfr_nan_p(y) || mpfr_inf_p(y))
                continue;
            e = qdot_fun1(pool, rows[i].id, qdot_expr_ratio(pool, n, 8));
            assert_true(constant(pool, e) == mpfr_get_d(y, MPFR_RNDN));
            compared++;
        }
    assert_true(compared > 300);
    mpfr_const_pi(x, MPFR_RNDN);
    mpfr_set_si(y, 1900, MPFR_RNDN);
    mpfr_sqrt(y, y, MPFR_RNDN);
    mpfr_mul(x, x, y, MPFR_RNDN);
    mpfr_mul_si(x, x, 2, MPFR_RNDN);
    e = qdot_mul(pool, qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI),
                 qdot_sqrt(pool, qdot_expr_int(pool, 1900)));
    assert_true(constant(pool, e) == mpfr_get_d(x, MPFR_RNDN));
    mpfr_clear(x);
    mpfr_clear(y);
    qdot_pool_free(pool);
}

/* sin(1)^2 + cos(1)^2 - 1 is 0; exp(-60) + 1 - 1 keeps its digits. */
static void
cancellation_costs_no_digits(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr s = qdot_fun1(pool, QDOT_SIN, QDOT_ONE), c = qdot_fun1(pool, QDOT_COS, QDOT_ONE);
    qdot_expr zero = qdot_sub(pool, qdot_add(pool, qdot_pow_int(pool, s, 2),
                                             qdot_pow_int(pool, c, 2)), QDOT_ONE);
    qdot_expr tiny, big = qdot_fun1(pool, QDOT_EXP, qdot_expr_int(pool, -600));

    (void)state;
    if (zero != QDOT_ZERO) {
        assert_true(constant(pool, zero) == 0.0);
        assert_true(constant(pool, qdot_sqrt(pool, zero)) == 0.0);
    }
    /* sqrt(1 + e) - 1, e = exp(-600): e/2 to all digits */
    tiny = qdot_sub(pool, qdot_sqrt(pool, qdot_add(pool, QDOT_ONE, big)), QDOT_ONE);
    assert_true(fabs(constant(pool, tiny) / (0.5 * exp(-600.0)) - 1) < 1e-12);
    qdot_pool_free(pool);
}

static void
jumps_and_choices_are_decided(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr ten_pi = qdot_mul(pool, qdot_expr_int(pool, 10), QDOT_PI), two[2], three[3];

    (void)state;
    assert_true(constant(pool, qdot_fun1(pool, QDOT_FLOOR, ten_pi)) == 31);
    two[0] = ten_pi;
    two[1] = qdot_expr_int(pool, 4);
    assert_true(fabs(constant(pool, qdot_fun(pool, QDOT_MOD, 2, two)) - fmod(10 * M_PI, 4))
                < 1e-14);
    assert_true(constant(pool, qdot_fun(pool, QDOT_MIN, 2, two)) == 4);
    three[0] = qdot_rel(pool, QDOT_LT, QDOT_PI, two[1]);
    three[1] = QDOT_PI;
    three[2] = QDOT_ONE;
    assert_true(constant(pool, qdot_fun(pool, QDOT_IF, 3, three)) == M_PI);
    two[0] = QDOT_ONE;
    two[1] = QDOT_MINUS_ONE;
    assert_true(fabs(constant(pool, qdot_fun(pool, QDOT_ATAN2, 2, two)) - 3 * M_PI / 4)
                < 1e-15);
    qdot_pool_free(pool);
}

static void
what_has_no_value_is_told(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr m = qdot_symbol_get(pool, QDOT_PARAM, "m");

    (void)state;
    assert_int_equal(refused(pool, qdot_add(pool, m, QDOT_ONE)), QDOT_EUNSET);
    assert_string_equal(qdot_last_error()->message, "parameter m has no value");
    assert_int_equal(refused(pool, qdot_sqrt(pool, qdot_sub(pool, qdot_expr_int(pool, 3),
                                                            QDOT_PI))), QDOT_EDOMAIN);
    assert_non_null(strstr(qdot_last_error()->message, "not real"));
    assert_int_equal(refused(pool, qdot_fun1(pool, QDOT_EXP, qdot_expr_int(pool, 1000))),
                     QDOT_EDOMAIN);
    assert_int_equal(refused(pool, QDOT_NIL), QDOT_EINVAL);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rationals_round_to_nearest),
        cmocka_unit_test(functions_round_to_nearest),
        cmocka_unit_test(cancellation_costs_no_digits),
        cmocka_unit_test(jumps_and_choices_are_decided),
        cmocka_unit_test(what_has_no_value_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
