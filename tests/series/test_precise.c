/* test_precise.c -- series in MPFR against derivatives evaluated in balls: coefficient k
 * of e(t) is e^(k)(t)/k!. */
#include "tape/reference.h"
#include "tape/smooth.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/constant.h"
#include "series/precise.h"

enum { ORDERS = 6, BITS = 320 };

/* |a - b| <= 2^-280 max(1, |b|) */
static bool
near(mpfr_srcptr a, mpfr_srcptr b)
{
    mpfr_t d, most;
    bool good;

    mpfr_init2(d, 64);
    mpfr_init2(most, 64);
    mpfr_sub(d, a, b, MPFR_RNDN);
    mpfr_abs(d, d, MPFR_RNDN);
    mpfr_abs(most, b, MPFR_RNDU);
    if (mpfr_cmp_ui(most, 1) < 0)
        mpfr_set_ui(most, 1, MPFR_RNDN);
    mpfr_mul_2si(most, most, -280, MPFR_RNDN);
    good = mpfr_lessequal_p(d, most) != 0;
    mpfr_clear(d);
    mpfr_clear(most);
    return good;
}

static void
series_is_right(fixture *f, qdot_expr e, const char *what)
{
    qdot_expr input = QDOT_T, derivative = e, t0 = decimal(f, "0.1");
    qdot_expr factorial = QDOT_ONE;
    qdot_precise *series;
    qdot_tape *tape;
    mpfr_t expected;

    mpfr_init2(expected, BITS);
    assert_int_equal(qdot_tape_new(f->pool, 1, &input, 1, &e, &tape), QDOT_OK);
    assert_int_equal(qdot_precise_new(f->pool, tape, ORDERS, BITS, &series), QDOT_OK);
    for (int k = 0; k <= ORDERS; k++) {
        mpfr_ptr newest = qdot_precise_input(series, 0)[k];
        qdot_expr c = qdot_subs(f->pool, derivative, 1, &input, &t0);

        c = qdot_div(f->pool, c, factorial);
        assert_int_equal(qdot_constant_real(f->pool, c, expected), QDOT_OK);
        if (k == 0)
            assert_int_equal(qdot_constant_real(f->pool, t0, newest), QDOT_OK);
        else
            mpfr_set_ui(newest, k == 1, MPFR_RNDN);
        qdot_precise_order(series, k);
        if (!near(qdot_precise_output(series, 0)[k], expected))
            fail_msg("%s, order %d: %.17g, not %.17g", what, k,
                     mpfr_get_d(qdot_precise_output(series, 0)[k], MPFR_RNDN),
                     mpfr_get_d(expected, MPFR_RNDN));
        derivative = qdot_diff(f->pool, derivative, QDOT_T);
        factorial = qdot_mul(f->pool, factorial, qdot_expr_int(f->pool, k + 1));
    }
    mpfr_clear(expected);
    qdot_precise_free(series);
    qdot_tape_free(tape);
}

static void
every_function_has_its_series(void **state)
{
    (void)state;
    check_functions(series_is_right);
}

static void
arithmetic_has_its_series(void **state)
{
    fixture f;
    qdot_expr s, c, e;

    (void)state;
    begin(&f);
    s = qdot_fun1(f.pool, QDOT_SIN, f.u);
    c = qdot_fun1(f.pool, QDOT_EXP, f.x);
    series_is_right(&f, qdot_mul(f.pool, s, c), "product");
    series_is_right(&f, qdot_div(f.pool, s, c), "quotient");
    series_is_right(&f, qdot_pow_int(f.pool, s, 2), "square");
    series_is_right(&f, qdot_pow_int(f.pool, f.u, -3), "inverse cube");
    series_is_right(&f, qdot_pow(f.pool, f.u, decimal(&f, "0.5")), "root");
    series_is_right(&f, qdot_pow(f.pool, f.u, decimal(&f, "0.3")), "power");
    series_is_right(&f, qdot_pow(f.pool, f.u, f.x), "power to a power");
    e = qdot_add(f.pool, qdot_mul(f.pool, s, c), f.x);
    series_is_right(&f, qdot_sub(f.pool, e, qdot_mul(f.pool, c, c)), "sums");
    e = qdot_sub(f.pool, f.x, qdot_mul(f.pool, s, c));
    series_is_right(&f, qdot_mul(f.pool, decimal(&f, "-0.7"), e), "difference");
    series_is_right(&f, qdot_sub(f.pool, qdot_mul(f.pool, s, c), qdot_mul(f.pool, c, c)),
                    "difference of products");
    e = qdot_fun(f.pool, QDOT_ATAN2, 2, (qdot_expr[]){s, c});
    series_is_right(&f, e, "atan2");
    e = qdot_add(f.pool, qdot_mul(f.pool, QDOT_PI, f.x),
                 qdot_pow(f.pool, qdot_expr_int(f.pool, 2), decimal(&f, "0.5")));
    series_is_right(&f, e, "constants");
    qdot_pool_free(f.pool);
}

static void
what_switches_has_values_and_no_series(void **state)
{
    static const char *const expected[] = {"0.7", "1", "-0.7", "2.5", "1.8", "2"};
    fixture f;
    qdot_expr x, y, out[6];
    qdot_tape *tape;
    qdot_precise *p;

    (void)state;
    begin(&f);
    x = qdot_symbol_get(f.pool, QDOT_PARAM, "a");
    y = qdot_symbol_get(f.pool, QDOT_PARAM, "b");
    out[0] = qdot_fun1(f.pool, QDOT_ABS, x);
    out[1] = qdot_fun1(f.pool, QDOT_SIGN, y);
    out[2] = qdot_fun(f.pool, QDOT_MIN, 2, (qdot_expr[]){x, y});
    out[3] = qdot_fun(f.pool, QDOT_MAX, 2, (qdot_expr[]){x, y});
    out[4] = qdot_fun(f.pool, QDOT_MOD, 2, (qdot_expr[]){x, y});
    out[5] = qdot_fun1(f.pool, QDOT_FLOOR, y);
    assert_int_equal(qdot_tape_new(f.pool, 2, (qdot_expr[]){x, y}, 6, out, &tape),
                     QDOT_OK);
    assert_int_equal(qdot_precise_new(f.pool, tape, 1, BITS, &p), QDOT_ENOTBUILT);
    assert_non_null(strstr(qdot_last_error()->message, "abs"));
    assert_int_equal(qdot_precise_new(f.pool, tape, 0, BITS, &p), QDOT_OK);
    assert_int_equal(qdot_constant_real(f.pool, decimal(&f, "-0.7"),
                                        qdot_precise_input(p, 0)[0]),
                     QDOT_OK);
    assert_int_equal(
        qdot_constant_real(f.pool, decimal(&f, "2.5"), qdot_precise_input(p, 1)[0]),
        QDOT_OK);
    qdot_precise_order(p, 0);
    for (size_t i = 0; i < 6; i++) {
        mpfr_t e;

        mpfr_init2(e, BITS);
        assert_int_equal(mpfr_set_str(e, expected[i], 10, MPFR_RNDN), 0);
        if (!near(qdot_precise_output(p, i)[0], e))
            fail_msg("output %zu is not %s", i, expected[i]);
        mpfr_clear(e);
    }
    qdot_precise_free(p);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_has_its_series),
        cmocka_unit_test(arithmetic_has_its_series),
        cmocka_unit_test(what_switches_has_values_and_no_series),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
