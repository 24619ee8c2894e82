/* test_definite.c -- definite integrals: values, kinks and steps inside, divergence, and what is not real. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/calculus.h"
#include "normal/integral/definite.h"
#include "normal/prove/decide.h"

static qdot_expr
place_read(const char *text)
{
    return strcmp(text, "inf") == 0    ? QDOT_INFINITY
           : strcmp(text, "-inf") == 0 ? qdot_neg(pool, QDOT_INFINITY)
                                       : text_read(pool, text);
}

static qdot_definite_answer
definite(const char *e, const char *lo, const char *hi)
{
    qdot_definite_answer answer;

    assert_int_equal(qdot_definite(pool, text_read(pool, e), text_read(pool, "x"), place_read(lo), place_read(hi), NULL, &answer),
                     QDOT_OK);
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
    return answer;
}

struct row {
    const char *e, *lo, *hi, *value;
};

static void
rows_hold(const struct row *row, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const qdot_definite_answer seen = definite(row[i].e, row[i].lo, row[i].hi);

        if (seen.kind != QDOT_DEFINITE_FOUND || !qdot_is_zero(pool, qdot_sub(pool, seen.value, text_read(pool, row[i].value)), NULL))
            fail_msg("%s from %s to %s is %s", row[i].e, row[i].lo, row[i].hi, row[i].value);
    }
}

static void
ends_are_limits(void **state)
{
    static const struct row rows[] = {
        {"x^2", "1", "3", "26/3"},
        {"x^2", "3", "1", "-26/3"},
        {"k*x", "a", "a", "0"},
        {"1/sqrt(a^2 - x^2)", "-a", "a", "pi"},
        {"sqrt(a + 2*b*x - x^2)", "b - sqrt(a + b^2)", "b + sqrt(a + b^2)", "pi/2*(a + b^2)"},
        {"log(x)", "0", "1", "-1"},
        {"exp(-a*x)", "0", "inf", "1/a"},
        {"1/(1 + x^2)", "-inf", "inf", "pi"},
        {"1/(2 + cos(x))", "0", "2*pi", "2*pi/sqrt(3)"}, /* the antiderivative by tan(x/2) jumps at pi */
        {"(x^2 - 1)/(x - 1)", "1", "2", "5/2"},
    };

    (void)state;
    rows_hold(rows, sizeof rows / sizeof *rows);
}

static void
kinks_and_steps_divide_the_range(void **state)
{
    static const struct row rows[] = {
        {"abs(x - a)", "0", "2*a", "a^2"},
        {"abs(sin(x))", "0", "3*pi", "6"},
        {"sign(x)*x^2", "-1", "2", "7/3"},
        {"floor(x)", "-1", "5/2", "1"},
        {"floor(x^2)", "0", "2", "5 - sqrt(2) - sqrt(3)"},
        {"x*floor(x^2)", "-2", "1", "-3"},
        {"floor(exp(x))", "0", "1", "2 - log(2)"},
        {"floor(3*sin(x))", "0", "pi", "2*pi - 2*asin(1/3) - 2*asin(2/3)"},
        {"floor(a*x)", "0", "3/a", "3/a"},
        {"floor(a*x)", "0", "2", "2*floor(2*a) - floor(2*a)*(floor(2*a) + 1)/(2*a)"}, /* any number of steps */
        {"x + k*floor(a*x)", "0", "1", "1/2 + k*(floor(a) - floor(a)*(floor(a) + 1)/(2*a))"},
    };

    (void)state;
    rows_hold(rows, sizeof rows / sizeof *rows);
}

static void
divergence_is_told(void **state)
{
    qdot_definite_answer seen = definite("1/x", "-1", "2");

    (void)state;
    assert_int_equal(seen.kind, QDOT_DEFINITE_DIVERGES);
    assert_int_equal(seen.at, QDOT_ZERO);
    assert_int_equal(definite("1/(x - a)^2", "0", "2*a").kind, QDOT_DEFINITE_DIVERGES);
    assert_int_equal(definite("1/x", "1", "inf").kind, QDOT_DEFINITE_DIVERGES);
    assert_int_equal(definite("sqrt(x)", "-1", "2").kind, QDOT_DEFINITE_UNDEFINED);
    assert_int_equal(definite("log(x)", "-2", "-1").kind, QDOT_DEFINITE_UNDEFINED);
}

static void
steps_without_number_are_summed(void **state)
{
    (void)state;
    assert_string_equal(shown(definite("floor(k*x)", "0", "1").value), "floor(k) - 1/2*(floor(k) + 1)*floor(k)/k");
    assert_string_equal(shown(definite("mod(x, 1)^2", "0", "3000").value), "1000");
    assert_string_equal(shown(definite("abs(x - k)", "0", "1").value), "1/2*((1 - k)*abs(k - 1) + k*abs(k))");
}

static qdot_expr
by_cases(const char *e, const char *lo, const char *hi)
{
    qdot_definite_answer answer;

    assert_int_equal(qdot_definite_by_cases(pool, text_read(pool, e), text_read(pool, "x"), place_read(lo), place_read(hi), NULL,
                                            &answer),
                     QDOT_OK);
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
    return answer.kind == QDOT_DEFINITE_FOUND ? answer.value : QDOT_NIL;
}

static void
signs_of_parameters_are_conditions(void **state)
{
    (void)state;
    assert_int_equal(definite("x^k", "0", "1").kind, QDOT_DEFINITE_NOT_FOUND);
    assert_string_equal(shown(by_cases("x^k", "0", "1")), "if(k > -1, 1/(k + 1), integral(x^k, x, 0, 1))");
    assert_string_equal(shown(by_cases("exp(k*x)", "0", "inf")), "if(k < 0, -1/k, integral(exp(k*x), x, 0, infinity))");
    assert_string_equal(shown(by_cases("sin(k*x)/x", "0", "inf")), "1/2*pi*sign(k)"); /* 0 at k = 0, too */
    assert_string_equal(shown(by_cases("1/x", "k", "2*k")), "if(k > 0, log(2), if(k < 0, log(2), 0))");
    assert_true(by_cases("sin(k*x)/(x^3 + x + 1)", "0", "inf") == QDOT_NIL);
}

static void
nothing_is_guessed(void **state)
{
    (void)state;
    assert_int_equal(definite("sin(x)/x", "0", "1").kind, QDOT_DEFINITE_NOT_FOUND);
    assert_int_equal(definite("1/x", "k", "1").kind, QDOT_DEFINITE_NOT_FOUND);      /* k may be negative */
    assert_int_equal(definite("sign(floor(a*x))", "0", "1").kind, QDOT_DEFINITE_NOT_FOUND);
    assert_int_equal(definite("sign(floor(2*x))", "0", "3/2").kind, QDOT_DEFINITE_NOT_FOUND);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(ends_are_limits, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(kinks_and_steps_divide_the_range, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(divergence_is_told, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(steps_without_number_are_summed, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(signs_of_parameters_are_conditions, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(nothing_is_guessed, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
