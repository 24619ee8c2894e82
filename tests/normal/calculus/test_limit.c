/* test_limit.c -- limits: values, infinite ones, sides that differ, and what is not found. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "normal/calculus/limit.h"
#include "normal/prove/decide.h"

/* The limit of `text` as x tends to `at`: "inf", "-inf" or an expression. */
static qdot_limit_answer
limit_of(const char *text, const char *at, int side)
{
    const qdot_expr place = strcmp(at, "inf") == 0    ? QDOT_INFINITY
                            : strcmp(at, "-inf") == 0 ? qdot_neg(pool, QDOT_INFINITY)
                                                      : text_read(pool, at);
    qdot_limit_answer answer;

    assert_int_equal(qdot_limit(pool, NULL, text_read(pool, text), text_read(pool, "x"), place, side, &answer), QDOT_OK);
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
    return answer;
}

static void
limits_are_those_of_the_books(void **state)
{
    static const struct {
        const char *e, *at;
        int side;
        const char *limit;
    } rows[] = {
        {"sin(k*x)/x", "0", 0, "k"},
        {"(1 - cos(x))/x^2", "0", 0, "1/2"},
        {"(x^2 - a^2)/(x - a)", "a", 0, "2*a"},
        {"(exp(x) - 1 - x - x^2/2)/x^3", "0", 0, "1/6"},
        {"(1 + k/x)^x", "inf", 0, "exp(k)"},
        {"sqrt(x^2 + k*x) - x", "inf", 0, "k/2"},
        {"x*log(x)", "0", 1, "0"},
        {"x^5*exp(-a*x)", "inf", 0, "0"},
        {"exp(x - exp(-x))/exp(x)", "inf", 0, "1"},
        {"exp(x)*(exp(1/x - exp(-x)) - exp(1/x))", "inf", 0, "-1"},
        {"exp(exp(x - exp(-x)/(1 - 1/x))) - exp(exp(x))", "inf", 0, "-inf"},
        {"log(log(x))/log(x)", "inf", 0, "0"},
        {"1/x", "0", 1, "inf"},
        {"1/x", "0", -1, "-inf"},
        {"-1/x^2", "0", 0, "-inf"},
        {"abs(x)/x", "0", -1, "-1"},
        {"floor(x)", "3", -1, "2"},
        {"atan(x)", "-inf", 0, "-pi/2"},
        {"tanh(x)", "inf", 0, "1"},
        {"x*sin(1/x)", "0", 0, "0"},
        {"sqrt(x)", "0", 0, "0"},
        {"x + 3*sin(x)", "inf", 0, "inf"},
        {"x + floor(x)", "-inf", 0, "-inf"},
        /* the sign of a product of roots; of a sum with a root, s (s - b) with s = sqrt(a + b^2) */
        {"(x - b)/sqrt(a + 2*b*x - x^2)", "b - sqrt(a + b^2)", 1, "-inf"},
        {"(a + b*x)/sqrt(a + 2*b*x - x^2)", "b - sqrt(a + b^2)", 1, "inf"},
        {"atan((a + b*x)/sqrt(a + 2*b*x - x^2))", "b + sqrt(a + b^2)", -1, "pi/2"},
        /* the end of the domain of a function, in disguise */
        {"asin(x*sqrt(a + b)*sqrt(a + 2*b)/(a^2 + 3*a*b + 2*b^2))", "sqrt(a^2 + 3*a*b + 2*b^2)", -1, "pi/2"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const qdot_limit_answer seen = limit_of(rows[i].e, rows[i].at, rows[i].side);
        const char *wanted = rows[i].limit;

        if (strstr(wanted, "inf") != NULL) {
            if (seen.kind != QDOT_LIMIT_INFINITE || (seen.value == QDOT_INFINITY) != (*wanted == 'i'))
                fail_msg("%s at %s is %s", rows[i].e, rows[i].at, wanted);
            continue;
        }
        if (seen.kind != QDOT_LIMIT_VALUE || !qdot_is_zero(pool, qdot_sub(pool, seen.value, text_read(pool, wanted)), NULL))
            fail_msg("%s at %s is %s", rows[i].e, rows[i].at, wanted);
    }
}

static void
what_does_not_exist_is_told(void **state)
{
    qdot_limit_answer seen = limit_of("exp(1/x)", "0", 0);

    (void)state;
    assert_int_equal(seen.kind, QDOT_LIMIT_NONE);
    assert_int_equal(seen.left, QDOT_ZERO);
    assert_int_equal(seen.right, QDOT_INFINITY);
    seen = limit_of("abs(x)/x", "0", 0);
    assert_int_equal(seen.kind, QDOT_LIMIT_NONE);
    assert_int_equal(seen.left, QDOT_MINUS_ONE);
    assert_int_equal(limit_of("log(x)", "0", -1).kind, QDOT_LIMIT_UNDEFINED);
}

static void
nothing_is_guessed(void **state)
{
    (void)state;
    assert_int_equal(limit_of("sin(x)", "inf", 0).kind, QDOT_LIMIT_NOT_FOUND);
    assert_int_equal(limit_of("exp(k*x)", "inf", 0).kind, QDOT_LIMIT_NOT_FOUND); /* k has no sign */
    assert_int_equal(limit_of("x*sin(x)", "inf", 0).kind, QDOT_LIMIT_NOT_FOUND);
    assert_int_equal(limit_of("(k - x)/sqrt(a + 2*b*x - x^2)", "b - sqrt(a + b^2)", 1).kind, QDOT_LIMIT_NOT_FOUND);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(limits_are_those_of_the_books, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(what_does_not_exist_is_told, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(nothing_is_guessed, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
